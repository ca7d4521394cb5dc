//! The slits and passes of the first layer from above, for pictures.

use crate::asked::FreePocket;
use crate::proof::stated::layers;
use crate::proof::tools;
use vcutc_backend_api::ir::{OperationId, Program, Shape};
use vcutc_job::operation::judged::FromAbove;
use vcutc_process::from_above::reaching;
use vcutc_process::from_above::shown::{seen, stays, stretches};
use vcutc_region::coverage::{Tool, coverage};
use vcutc_region::region::Side;

/// The slits and passes of a program; none of one that has none.
pub(crate) fn from_above(asked: &FreePocket, operation: OperationId, program: &Program) -> Option<FromAbove> {
    let tools = tools(program, operation)?;
    let layers = layers(program, operation, tools);
    let layer = layers.first()?;
    let Shape::Disc(disc) = program.blade(tools.disc)?.shape else {
        return None;
    };
    let region = &asked.region.region;
    let keep = disc.radius + asked.allowance.value + program.blend;
    let tool = Tool {
        radius: disc.radius.to_mm(),
        keep: keep.to_mm(),
    };
    let of = |side: Side| {
        let edges = region.edges().filter(move |edge| edge.side == side);
        edges.map(|edge| edge.piece).collect()
    };
    let passes = layer.passes();
    let begins = passes.iter().filter_map(|pass| Some(pass.pieces.first()?.from));
    let bare = Tool {
        radius: tool.radius,
        keep: (disc.radius + asked.allowance.value).to_mm(),
    };
    let spots = coverage(region, passes, reaching(tool)).map_or_else(|_| Vec::new(), |left| left.spots);
    Some(FromAbove {
        stays: stays(&spots, region, bare),
        walls: of(Side::Wall),
        open: of(Side::Open),
        slits: layer.slits().to_vec(),
        stretches: stretches(region, passes, tool.radius),
        entries: begins.collect(),
        uncut: seen(spots),
    })
}
