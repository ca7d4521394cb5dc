//! `slit walls { ... }`: slitting the walls of a region with a straight blade.

use crate::asked::SlitWalls;
use crate::refused;
use vcutc_backend_api::ir::Edges;
use vcutc_backend_api::units::Length;
use vcutc_job::operation::Operation;
use vcutc_job::sema::dimension::Dimension;
use vcutc_job::sema::field_ranges::{DISTANCE, Range};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, limit, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, default};
use vcutc_job::sema::region::{beyond_stock, region};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::{self, inner_place};
use vcutc_job::sema::written::Written;
use vcutc_job::{Sourced, StraightBlade};

/// How much may stay at the foot of walls where the job does not say it: a judgement, from no source.
const RESIDUAL: Length = Length::mm(0.1);

/// Programs keep a hundredth of a millimetre from walls for rounding and for joints, so less cannot be promised.
const RESIDUALS: Range = Range::closed(Dimension::LENGTH, 0.02, 100.0);

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`slit walls`",
    fields: &[
        value("region", "seat").required().takes(Takes::Region),
        setup::BLADE,
        value("floor", "20 mm").required().within(DISTANCE),
        value("allowance", "0 mm").within(DISTANCE),
        block("limits", "{ residual <= 0.1 mm }").takes(Takes::Fields(&LIMITS)),
        setup::FEED_WITH_PLUNGE,
        setup::CLEARANCE,
        setup::RUN_OUT_FIELD,
    ],
    inner: Inner::Refused,
};

const LIMITS: BlockSpec = BlockSpec {
    title: "`limits` of `slit walls`",
    fields: &[limit("residual", "0.1 mm").within(RESIDUALS)],
    inner: Inner::Refused,
};

/// `slit walls`.
#[derive(Clone, Copy, Debug)]
pub struct Slit;

impl Kind for Slit {
    fn head(&self) -> &'static str {
        "slit walls"
    }

    /// Walls are cut into whatever the stock is.
    fn needs_part(&self) -> bool {
        false
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        Ok(Box::new(check(written, session)?))
    }
}

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<SlitWalls> {
    let Written {
        block, place, scope, ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let residual = residual(&fields, written, session);
    let setup = setup::check_with_plunge(&fields, written, session);
    let blade: Checked<StraightBlade> = setup::blade("blade", &fields, written, session);
    let region = region("region", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let floor = reader.required(&fields, "floor");
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let (setup, plunge_feed) = setup?;
    let (region, region_span) = region?;
    let asked = SlitWalls {
        plunge_feed,
        setup,
        blade: blade?,
        region,
        region_span,
        floor: floor?,
        allowance: allowance?,
        residual: residual?,
    };
    match fault(&asked, written) {
        Some(found) => Err(session.reports.push(found)),
        None => Ok(asked),
    }
}

/// What is wrong between the fields.
fn fault(asked: &SlitWalls, written: Written<'_>) -> Option<vcutc_diagnostics::Diagnostic> {
    if asked.blade.edges == Edges::Single {
        return Some(refused::one_edge(asked));
    }
    let stock = written.stock?;
    if asked.floor.value >= stock.node.height {
        return Some(refused::floor_above_stock(asked, stock));
    }
    beyond_stock(&asked.region, asked.region_span, stock)
}

fn residual(
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<Sourced<Length>> {
    let Some(inner) = fields.block("limits")? else {
        return Ok(default(RESIDUAL));
    };
    let fields = Fields::sort(&LIMITS, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(written.scope, &mut session.reports);
    reader.defaulted(&fields, "residual", RESIDUAL)
}
