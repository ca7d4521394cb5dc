//! The passes of the first layer from above, for pictures.

use crate::asked::ClearPocket;
use crate::proof::stated::layers;
use vcutc_backend_api::ir::{OperationId, Program, Shape};
use vcutc_job::operation::judged::FromAbove;
use vcutc_process::from_above::reaching;
use vcutc_process::from_above::shown::{seen, stays, stretches};
use vcutc_region::coverage::{Tool, coverage};
use vcutc_region::region::Side;

/// The passes of a program; none of one that has none.
pub(crate) fn from_above(
    asked: &ClearPocket,
    operation: OperationId,
    program: &Program,
) -> Option<FromAbove> {
    let layers = layers(program, operation);
    let layer = layers.first()?;
    let Shape::Crusher(crusher) = program.blade(layer.tool)?.shape else {
        return None;
    };
    let region = &asked.region.region;
    let radius = crusher.radius.to_mm();
    let keep = crusher.radius + asked.allowance.value + program.blend;
    let tool = Tool {
        radius,
        keep: keep.to_mm().max(radius),
    };
    let of = |side: Side| {
        let edges = region.edges().filter(move |edge| edge.side == side);
        edges.map(|edge| edge.piece).collect()
    };
    let passes = layer.flat();
    let begins = passes.iter().filter_map(|pass| Some(pass.pieces.first()?.from));
    let spots = coverage(region, passes, reaching(tool)).map_or_else(|_| Vec::new(), |left| left.spots);
    let bare = Tool {
        radius,
        keep: radius + asked.allowance.value.to_mm(),
    };
    Some(FromAbove {
        stays: stays(&spots, region, bare),
        walls: of(Side::Wall),
        open: of(Side::Open),
        slits: Vec::new(),
        stretches: stretches(region, passes, radius),
        entries: begins.collect(),
        uncut: seen(spots),
    })
}
