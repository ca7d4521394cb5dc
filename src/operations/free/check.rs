//! `free pocket { ... }`: clearing a pocket with a straight blade and a disc.

use crate::asked::{FreePocket, Limits};
use crate::refused;
use vcutc_backend_api::ir::Edges;
use vcutc_backend_api::units::{Area, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_job::operation::Operation;
use vcutc_job::sema::dimension::Dimension;
use vcutc_job::sema::field_ranges::{DISTANCE, Range, SIZE};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, limit, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, default};
use vcutc_job::sema::region::{beyond_stock, region};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::{self, inner_place};
use vcutc_job::sema::written::Written;
use vcutc_job::{Auto, Disc, Sourced, StraightBlade};
use vcutc_process::verdict::floors;

/// How much ground may stay uncut where the job does not say it: a judgement, from no source.
const UNCUT: Area = Area::mm2(1.0);

/// How much may stay at the foot of walls where the job does not say it: a judgement, from no source.
const RESIDUAL: Length = Length::mm(0.1);

/// How long strips may be where the job does not say it: a judgement, from no source.
const CHIP: Length = Length::mm(150.0);

/// How many layers slits go through where the job does not say it.
const THROUGH: u32 = 1;

/// Shorter pieces take more slits than strips, and hold nothing.
const CHIPS: Range = Range::closed(Dimension::LENGTH, 20.0, 100_000.0);
const AREAS: Range = Range::closed(Dimension::AREA, 0.0, 1e10);
/// Programs keep a hundredth of a millimetre from walls for rounding and for joints, so less cannot be promised.
const RESIDUALS: Range = Range::closed(Dimension::LENGTH, 0.02, 100.0);
const LAYERS: Range = Range::closed(Dimension::PURE, 1.0, 1000.0);

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`free pocket`",
    fields: &[
        value("region", "bay").required().takes(Takes::Region),
        setup::BLADE,
        value("disc", "wheel").required().takes(Takes::Blade("disc")),
        value("floor", "20 mm").required().within(DISTANCE),
        value("step", "auto").within(SIZE).or_auto(),
        value("layer", "auto").within(SIZE).or_auto(),
        value("through", "1").within(LAYERS),
        value("chip", "150 mm").within(CHIPS),
        value("allowance", "0 mm").within(DISTANCE),
        block("limits", "{ uncut <= 1 mm2, pillars <= 150 mm2 }").takes(Takes::Fields(&LIMITS)),
        setup::FEED_TO_FREE,
        setup::CLEARANCE,
        setup::RUN_OUT_FIELD,
    ],
    inner: Inner::Refused,
};

const LIMITS: BlockSpec = BlockSpec {
    title: "`limits` of `free pocket`",
    fields: &[
        limit("uncut", "1 mm2").within(AREAS),
        limit("pillars", "150 mm2").within(AREAS),
        limit("residual", "0.1 mm").within(RESIDUALS),
    ],
    inner: Inner::Refused,
};

/// `free pocket`.
#[derive(Clone, Copy, Debug)]
pub struct Free;

impl Kind for Free {
    fn head(&self) -> &'static str {
        "free pocket"
    }

    /// A pocket is cut into whatever the stock is.
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

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<FreePocket> {
    let Written {
        block, place, scope, ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = limits(&fields, written, session);
    let setup = setup::check_to_free(&fields, written, session);
    let blade: Checked<StraightBlade> = setup::blade("blade", &fields, written, session);
    let disc: Checked<Disc> = setup::blade("disc", &fields, written, session);
    let region = region("region", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let floor = reader.required(&fields, "floor");
    let step = reader.auto(&fields, "step");
    let layer = reader.auto(&fields, "layer");
    let through = through(&fields, &mut reader);
    let chip = reader.defaulted(&fields, "chip", CHIP);
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let (setup, [free_feed, plunge_feed]) = setup?;
    let (region, region_span) = region?;
    let asked = FreePocket {
        setup,
        blade: blade?,
        disc: disc?,
        region,
        region_span,
        floor: floor?,
        step: step?,
        layer: layer?,
        through: through?,
        chip: chip?,
        allowance: allowance?,
        plunge_feed,
        free_feed,
        limits: limits?,
    };
    match fault(&asked, written) {
        Some(found) => Err(session.reports.push(found)),
        None => Ok(asked),
    }
}

/// What the fields contradict each other in.
fn fault(asked: &FreePocket, written: Written<'_>) -> Option<Diagnostic> {
    if asked.blade.edges == Edges::Single {
        return Some(refused::one_edge(asked));
    }
    if let Auto::Given(layer) = asked.layer.value
        && layer > asked.disc.depth.value
    {
        return Some(refused::too_thick(asked, layer));
    }
    let stock = written.stock?;
    if asked.floor.value >= stock.node.height {
        return Some(floors::above_the_stock(asked.floor, asked.setup.head_span, stock));
    }
    beyond_stock(&asked.region, asked.region_span, stock)
}

fn through(fields: &Fields<'_>, reader: &mut Reader<'_>) -> Checked<Sourced<u32>> {
    let Some(expr) = fields.value("through")? else {
        return Ok(default(THROUGH));
    };
    Ok(Sourced {
        value: reader.whole(expr, LAYERS, "`through`")?,
        span: Some(expr.span),
    })
}

fn limits(fields: &Fields<'_>, written: Written<'_>, session: &mut Session<'_>) -> Checked<Limits> {
    let Some(inner) = fields.block("limits")? else {
        return Ok(Limits {
            uncut: default(UNCUT),
            pillars: None,
            residual: default(RESIDUAL),
        });
    };
    let fields = Fields::sort(&LIMITS, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(written.scope, &mut session.reports);
    let uncut = reader.defaulted(&fields, "uncut", UNCUT);
    let pillars = reader.optional(&fields, "pillars");
    let residual = reader.defaulted(&fields, "residual", RESIDUAL);
    Ok(Limits {
        uncut: uncut?,
        pillars: pillars?,
        residual: residual?,
    })
}
