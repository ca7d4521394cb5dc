//! `clear pocket { ... }`: clearing a pocket with a crusher.

mod opening;
mod pattern;

use crate::asked::{Axis, ClearPocket, Limits, Pattern, WayIn};
use crate::refused;
use vcutc_backend_api::units::{Area, Length};
use vcutc_job::operation::Operation;
use vcutc_job::sema::dimension::Dimension;
use vcutc_job::sema::field_ranges::{DISTANCE, Range, SIZE};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, limit, value};
use vcutc_job::sema::hole;
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, default, words_of};
use vcutc_job::sema::region::{beyond_stock, region};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::{self, inner_place};
use vcutc_job::sema::written::Written;
use vcutc_job::{Auto, Crusher};
use vcutc_process::verdict::floors;

/// How much ground may stay uncut where the job does not say it: a judgement, from no source.
const UNCUT: Area = Area::mm2(1.0);

const ANGLES: Range = Range::closed(Dimension::ANGLE, -180.0, 180.0);
const AREAS: Range = Range::closed(Dimension::AREA, 0.0, 1e10);
/// A pass in uncut ground has half the rim in the material.
const ENGAGEMENTS: Range = Range::positive(Dimension::ANGLE, 180.0);

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`clear pocket`",
    fields: &[
        value("region", "seat").required().takes(Takes::Region),
        value("blade", "hog").required().takes(Takes::Blade("crusher")),
        value("floor", "20 mm").required().within(DISTANCE),
        value("pattern", "auto")
            .takes(Takes::Words(|| words_of(Pattern::WORDS)))
            .or_auto(),
        value("step", "auto").within(SIZE).or_auto(),
        value("layer", "auto").within(SIZE).or_auto(),
        value("corners", "auto").within(DISTANCE).or_auto(),
        value("angle", "auto").within(ANGLES).or_auto(),
        value("lift", "auto").within(SIZE).or_auto(),
        value("axis", "exact").takes(Takes::Words(|| words_of(Axis::WORDS))),
        value("entry", "auto")
            .takes(Takes::Words(|| words_of(WayIn::WORDS)))
            .or_auto(),
        value("opening", hole::HOLE).takes(Takes::Calls(hole::CALLS)),
        value("allowance", "0 mm").within(DISTANCE),
        block("limits", "{ uncut <= 1 mm2, engagement <= 120 deg }").takes(Takes::Fields(&LIMITS)),
        setup::FEED_WITH_PLUNGE,
        setup::CLEARANCE,
        setup::RUN_OUT_FIELD,
    ],
    inner: Inner::Refused,
};

const LIMITS: BlockSpec = BlockSpec {
    title: "`limits` of `clear pocket`",
    fields: &[
        limit("uncut", "1 mm2").within(AREAS),
        limit("engagement", "120 deg").within(ENGAGEMENTS),
        limit("deviation", "0.2 mm").within(SIZE),
    ],
    inner: Inner::Refused,
};

/// `clear pocket`.
#[derive(Clone, Copy, Debug)]
pub struct Pocket;

impl Kind for Pocket {
    fn head(&self) -> &'static str {
        "clear pocket"
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

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<ClearPocket> {
    let Written {
        block, place, scope, ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = limits(&fields, written, session);
    let setup = setup::check_with_plunge(&fields, written, session);
    let crusher: Checked<Crusher> = setup::blade("blade", &fields, written, session);
    let region = region("region", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let floor = reader.required(&fields, "floor");
    let pattern = reader.auto_choice(&fields, "pattern", Pattern::WORDS);
    let step = reader.auto(&fields, "step");
    let layer = reader.auto(&fields, "layer");
    let corners = reader.auto(&fields, "corners");
    let angle = reader.auto(&fields, "angle");
    let lift = reader.auto(&fields, "lift");
    let axis = reader.choice(&fields, "axis", Axis::WORDS);
    let entry = reader.auto_choice(&fields, "entry", WayIn::WORDS);
    let opening = hole::read("opening", &fields, &mut reader);
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let (setup, plunge_feed) = setup?;
    let (region, region_span) = region?;
    let asked = ClearPocket {
        plunge_feed,
        setup,
        crusher: crusher?,
        region,
        region_span,
        floor: floor?,
        pattern: pattern?,
        step: step?,
        layer: layer?,
        corners: corners?,
        angle: angle?,
        lift: lift?,
        axis: axis?.unwrap_or(default(Axis::Exact)),
        entry: entry?,
        opening: opening?,
        allowance: allowance?,
        limits: limits?,
    };
    match fault(&asked, written) {
        Some(found) => Err(session.reports.push(found)),
        None => Ok(asked),
    }
}

/// What the fields contradict each other in.
fn fault(asked: &ClearPocket, written: Written<'_>) -> Option<vcutc_diagnostics::Diagnostic> {
    let crusher = &asked.crusher;
    if let Some(found) = pattern::field_of_another(asked) {
        return Some(found);
    }
    if let Auto::Given(step) = asked.step.value
        && step >= crusher.radius.value * 2.0
    {
        return Some(refused::step_too_wide(asked, step));
    }
    if let Auto::Given(layer) = asked.layer.value
        && layer > crusher.height.value
    {
        return Some(refused::too_thick(asked, layer));
    }
    let stock = written.stock?;
    if asked.floor.value >= stock.node.height {
        return Some(floors::above_the_stock(asked.floor, asked.setup.head_span, stock));
    }
    beyond_stock(&asked.region, asked.region_span, stock).or_else(|| opening::out_of_place(asked))
}

fn limits(fields: &Fields<'_>, written: Written<'_>, session: &mut Session<'_>) -> Checked<Limits> {
    let Some(inner) = fields.block("limits")? else {
        return Ok(Limits {
            uncut: default(UNCUT),
            engagement: None,
            deviation: None,
        });
    };
    let fields = Fields::sort(&LIMITS, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(written.scope, &mut session.reports);
    let uncut = reader.defaulted(&fields, "uncut", UNCUT);
    let engagement = reader.optional(&fields, "engagement");
    let deviation = reader.optional(&fields, "deviation");
    Ok(Limits {
        uncut: uncut?,
        engagement: engagement?,
        deviation: deviation?,
    })
}
