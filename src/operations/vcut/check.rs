//! `rough vcut { ... }`: V-shaped roughing.

mod fitted;
mod limits_block;
#[cfg(test)]
mod tests;
mod tips;

use crate::asked::{
    Avoid, Compensate, Formulas, Lattice, Objective, Redundant, Residual, RoughVcut, Sequence,
};
use crate::operation::NARROWEST_ALONG;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::follow::Follow;
use vcutc_job::operation::Operation;
use vcutc_job::sema::field_ranges::{DISTANCE, OVERLAP, SIZE, SWING};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, points, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, default, words_of};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup;
use vcutc_job::sema::written::Written;
use vcutc_job::{Auto, Order};

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`rough vcut`",
    fields: &[
        setup::BLADE,
        points("tips", "(10 mm, 40 mm) (16 mm, 40 mm)"),
        value("lattice", "auto")
            .takes(Takes::Words(|| words_of(Lattice::WORDS)))
            .or_auto(),
        setup::RAKE_FIELD,
        value("swing", "auto").within(SWING).or_auto(),
        value("layer", "auto").within(SIZE).or_auto(),
        value("step", "auto").within(SIZE).or_auto(),
        value("overlap", "auto").within(OVERLAP).or_auto(),
        value("objective", "time").takes(Takes::Words(|| words_of(Objective::WORDS))),
        value("model", "exact").takes(Takes::Words(|| words_of(Formulas::WORDS))),
        block("limits", "{ swing <= 50 deg, scallop <= 10 mm }").takes(Takes::Fields(&limits_block::LIMITS)),
        value("allowance", "0.5 mm").within(DISTANCE),
        value("residual", "auto")
            .takes(Takes::Words(|| words_of(Residual::WORDS)))
            .or_auto(),
        value("redundant", "auto")
            .takes(Takes::Words(|| words_of(Redundant::WORDS)))
            .or_auto(),
        value("avoid", "lift").takes(Takes::Words(|| words_of(Avoid::WORDS))),
        value("order", "auto")
            .takes(Takes::Words(|| words_of(Order::WORDS)))
            .or_auto(),
        value("sequence", "auto")
            .takes(Takes::Words(|| words_of(Sequence::WORDS)))
            .or_auto(),
        setup::DIRECTION,
        setup::FEED,
        setup::CLEARANCE,
        setup::EXTENSION,
        setup::RUN_OUT_FIELD,
        value("standoff", "auto").within(DISTANCE).or_auto(),
        value("follow", "spine").takes(Takes::Words(|| words_of(Follow::WORDS))),
        value("compensate", "forces").takes(Takes::Words(|| words_of(Compensate::WORDS))),
    ],
    inner: Inner::Refused,
};

/// `rough vcut`.
#[derive(Clone, Copy, Debug)]
pub struct Vcut;

impl Kind for Vcut {
    fn head(&self) -> &'static str {
        "rough vcut"
    }

    fn mistaken_for(&self) -> &'static [&'static str] {
        &["roughing", "vcuts", "v_cut"]
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn example(&self, blade: &str) -> String {
        format!(
            "rough vcut {{\n  blade = {blade}\n  lattice = orthogonal\n  rake = 60 deg\n  \
             feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  clearance = 10 mm\n}}"
        )
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        let operation = check(written, session)?;
        Ok(Box::new(operation))
    }
}

/// A value that only level cuts take, of an operation whose cuts follow a spine.
struct LevelOnly {
    field: &'static str,
    value: &'static str,
    span: Option<Span>,
    label: &'static str,
    /// What the other value does, and its word.
    instead: (&'static str, &'static str),
}

impl LevelOnly {
    fn refused(self, operation: &RoughVcut) -> Diagnostic {
        let Self { field, value, .. } = self;
        let head = operation.setup.head_span;
        let place = self.span.unwrap_or(head);
        let word = operation.follow.value.word();
        let (title, other) = self.instead;
        Diagnostic::new(
            Code::CannotFollow,
            format!("`{field} = {value}` does not go with `follow = {word}`"),
            place,
            self.label,
        )
        .and(
            operation.follow.span.unwrap_or(head),
            "these cuts rise and fall with the part",
        )
        .help(format!("delete `{field}`, or cut straight"))
        .fix(format!("{title}: `{other}`"), place, other)
    }
}

/// Narrower flanks along a spine.
fn narrower_along(operation: &RoughVcut) -> Diagnostic {
    let narrower = LevelOnly {
        field: "avoid",
        value: Avoid::Swing.word(),
        span: operation.avoid.span,
        label: "narrower flanks are cut straight only",
        instead: ("raise tips where Vs do not fit", Avoid::Lift.word()),
    };
    narrower.refused(operation)
}

/// Tips offset along a spine.
fn compensated_along(operation: &RoughVcut) -> Diagnostic {
    let compensated = LevelOnly {
        field: "compensate",
        value: Compensate::Forces.word(),
        span: operation.compensate.span,
        label: "only tips of level cuts are offset",
        instead: (
            "leave the tips where they are planned",
            Compensate::Nothing.word(),
        ),
    };
    compensated.refused(operation)
}

/// A swing with which a blade that is off its spine by a little spoils much of its flank.
fn too_narrow_along(operation: &RoughVcut, swing: Angle) -> Diagnostic {
    let head = operation.setup.head_span;
    let word = operation.follow.value.word();
    let (swing, least) = (show(swing.to_deg()), show(NARROWEST_ALONG.to_deg()));
    Diagnostic::new(
        Code::CannotFollow,
        format!("a swing of {swing} deg is too narrow for `follow = {word}`"),
        operation.swing.span.unwrap_or(head),
        format!("cuts that rise and fall take at least {least} deg"),
    )
    .and(
        operation.follow.span.unwrap_or(head),
        "these cuts rise and fall with the part",
    )
    .help(format!("use a `swing` of at least {least} deg, or cut straight"))
}

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<RoughVcut> {
    let Written {
        block,
        place,
        scope,
        stock,
        ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let given = tips::check(&fields, stock, scope, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = fields
        .block("limits")
        .and_then(|inner| limits_block::check(inner, scope, session));
    let setup = setup::check(&fields, written, session);
    let blade = setup::blade("blade", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let lattice = reader.auto_choice(&fields, "lattice", Lattice::WORDS);
    let swing = reader.auto(&fields, "swing");
    let layer = reader.auto(&fields, "layer");
    let step = reader.auto(&fields, "step");
    let overlap = reader.auto(&fields, "overlap");
    let objective = reader.choice(&fields, "objective", Objective::WORDS);
    let formulas = reader.choice(&fields, "model", Formulas::WORDS);
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let residual = reader.auto_choice(&fields, "residual", Residual::WORDS);
    let redundant = reader.auto_choice(&fields, "redundant", Redundant::WORDS);
    let avoid = reader.choice(&fields, "avoid", Avoid::WORDS);
    let order = reader.auto_choice(&fields, "order", Order::WORDS);
    let sequence = reader.auto_choice(&fields, "sequence", Sequence::WORDS);
    let standoff = reader.auto(&fields, "standoff");
    let follow = reader.choice(&fields, "follow", Follow::WORDS);
    let compensate = reader.choice(&fields, "compensate", Compensate::WORDS);
    let operation = RoughVcut {
        setup: setup?,
        blade: blade?,
        tips: None,
        lattice: lattice?,
        swing: swing?,
        layer: layer?,
        step: step?,
        overlap: overlap?,
        objective: objective?.unwrap_or(default(Objective::Time)),
        formulas: formulas?.unwrap_or(default(Formulas::Exact)),
        limits: limits?,
        allowance: allowance?,
        residual: residual?,
        redundant: redundant?,
        avoid: avoid?.unwrap_or(default(Avoid::Lift)),
        order: order?,
        sequence: sequence?,
        standoff: standoff?,
        follow: follow?.unwrap_or(default(Follow::Straight)),
        compensate: compensate?.unwrap_or(default(Compensate::Nothing)),
        along: None,
    };
    if operation.avoid.value == Avoid::Swing && operation.follow.value != Follow::Straight {
        return Err(session.reports.push(narrower_along(&operation)));
    }
    if let Auto::Given(swing) = operation.swing.value
        && swing < NARROWEST_ALONG
        && operation.follow.value != Follow::Straight
    {
        return Err(session.reports.push(too_narrow_along(&operation, swing)));
    }
    if operation.compensate.value == Compensate::Forces && operation.follow.value != Follow::Straight {
        return Err(session.reports.push(compensated_along(&operation)));
    }
    if let Some(refused) = fitted::beside_fitted(&operation) {
        return Err(session.reports.push(refused));
    }
    match given? {
        Some(given) => tips::over(given, operation, &fields, &mut session.reports),
        None => Ok(operation),
    }
}
