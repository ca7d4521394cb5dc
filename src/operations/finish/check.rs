//! `finish disc { ... }`: finishing with a disc.

use crate::asked::{FinishDisc, Limits, Sequence};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::Operation;
use vcutc_job::sema::dimension::Dimension;
use vcutc_job::sema::field_ranges::{DISTANCE, Range, SIZE};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, limit, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, words_of};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::{self, inner_place};
use vcutc_job::sema::written::Written;
use vcutc_job::{Auto, Disc, Sourced};

/// The least lead where the job does not say it: the usual angle of [Yu 2019] is 3 to 5 degrees.
const RELIEF: Angle = Angle::deg(3.0);

/// The greatest lead where the job does not say it: a judgement, from no source.
const STEEPEST: Angle = Angle::deg(15.0);

/// Without a lead the whole face of the disc rubs.
const LEADS: Range = Range::new(
    Dimension::ANGLE,
    core::ops::Bound::Excluded(0.0),
    core::ops::Bound::Excluded(90.0),
);

/// How far the disc may lean to a side: a judgement, from no source.
const SIDES: Range = Range::closed(Dimension::ANGLE, 0.0, 30.0);

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`finish disc`",
    fields: &[
        value("blade", "finisher").required().takes(Takes::Blade("disc")),
        value("step", "auto").within(SIZE).or_auto(),
        value("lead", "auto").within(LEADS).or_auto(),
        value("side", "auto").within(SIDES).or_auto(),
        value("relief", "3 deg").within(LEADS),
        value("over_hub", "0 mm").within(DISTANCE),
        block("limits", "{ scallop <= 0.1 mm, lead <= 12 deg }")
            .required()
            .takes(Takes::Fields(&LIMITS)),
        value("allowance", "0 mm").within(DISTANCE),
        value("sequence", "auto")
            .takes(Takes::Words(|| words_of(Sequence::WORDS)))
            .or_auto(),
        setup::DIRECTION,
        setup::FEED,
        setup::CLEARANCE,
        setup::RUN_OUT_FIELD,
    ],
    inner: Inner::Refused,
};

const LIMITS: BlockSpec = BlockSpec {
    title: "`limits` of `finish disc`",
    fields: &[
        limit("scallop", "0.1 mm").within(SIZE),
        limit("lead", "12 deg").within(LEADS),
    ],
    inner: Inner::Refused,
};

/// `finish disc`.
#[derive(Clone, Copy, Debug)]
pub struct Finish;

impl Kind for Finish {
    fn head(&self) -> &'static str {
        "finish disc"
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        Ok(Box::new(check(written, session)?))
    }
}

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<FinishDisc> {
    let Written {
        block, place, scope, ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = limits(&fields, written, session);
    let setup = setup::check_without_rake(&fields, written, session);
    let disc: Checked<Disc> = setup::blade("blade", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let step = reader.auto(&fields, "step");
    let lead = reader.auto(&fields, "lead");
    let side = reader.auto(&fields, "side");
    let sequence = reader.auto_choice(&fields, "sequence", Sequence::WORDS);
    let relief = reader.defaulted(&fields, "relief", RELIEF);
    let over_hub = reader.defaulted(&fields, "over_hub", Length::ZERO);
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let (limits, relief, lead, allowance) = (limits?, relief?, lead?, allowance?);
    if limits.scallop.value <= allowance.value {
        let diagnostic = below_allowance(limits.scallop, allowance, place.head);
        return Err(reader.reports.push(diagnostic));
    }
    if lead.value == Auto::Auto && relief.value > limits.lead.value {
        let diagnostic = Diagnostic::new(
            Code::LimitsConflict,
            format!(
                "`relief` is {} deg, and the lead is at most {} deg",
                show(relief.value.to_deg()),
                show(limits.lead.value.to_deg())
            ),
            limits.lead.span.or(relief.span).unwrap_or(place.head),
            "no lead is between them",
        )
        .help("use a smaller `relief`, or allow more lead");
        return Err(reader.reports.push(diagnostic));
    }
    Ok(FinishDisc {
        setup: setup?,
        disc: disc?,
        step: step?,
        lead,
        side: side?,
        sequence: sequence?,
        relief,
        over_hub: over_hub?,
        allowance,
        limits,
    })
}

fn below_allowance(scallop: Sourced<Length>, allowance: Sourced<Length>, head: Span) -> Diagnostic {
    let (most, least) = (show(scallop.value.to_mm()), show(allowance.value.to_mm()));
    Diagnostic::new(
        Code::LimitsConflict,
        format!("at most {most} mm may stay on the part, and the allowance of {least} mm has to"),
        scallop.span.unwrap_or(head),
        "what may stay, the allowance included",
    )
    .and(allowance.span.unwrap_or(head), "what has to stay")
    .help(format!(
        "allow more than the allowance, such as `scallop <= {} mm`",
        show(allowance.value.to_mm() + 0.1)
    ))
}

fn limits(fields: &Fields<'_>, written: Written<'_>, session: &mut Session<'_>) -> Checked<Limits> {
    let inner = fields.required_block("limits", &mut session.reports)?;
    let fields = Fields::sort(&LIMITS, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(written.scope, &mut session.reports);
    let scallop = reader.required(&fields, "scallop");
    let lead = reader.defaulted(&fields, "lead", STEEPEST);
    Ok(Limits {
        scallop: scallop?,
        lead: lead?,
    })
}
