//! Deviations above limits, and forces that were measured otherwise, in words.

use super::Unknown;
use super::figures::{DeviationFigures, Elsewhere, OperationDeviation, ShiftFigure, millimetres};
use crate::condition::Condition;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::number;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::forces::BladeForces;
use vcutc_job::{Machine, Sourced};
use vcutc_machine::masses::Backing;

/// Whether the stiffness is that of the machine itself.
const fn is_own(backing: Backing) -> bool {
    matches!(backing, Backing::Measured | Backing::Maker)
}

/// What is wrong with the deviations of an operation, where they are above its limit: an error where the stiffness is that of the
/// machine, and a warning where it is that of others.
#[must_use]
pub fn above_limit(
    figures: &DeviationFigures,
    operation: &OperationDeviation,
    limit: Sourced<Length>,
    head: Span,
) -> Option<Diagnostic> {
    let above = |side: &ShiftFigure| side.most > limit.value.to_mm();
    let sides = [("part", &operation.into_part), ("waste", &operation.into_waste)];
    let broken = sides.into_iter().filter(|(_, side)| above(side));
    let (into, worst) = broken.max_by(|(_, one), (_, other)| one.most.total_cmp(&other.most))?;
    let (code, indicative) = if is_own(figures.stiffness) {
        (Code::DeviationAboveLimit, String::new())
    } else {
        (
            Code::DeviationIndicative,
            format!(". Indicative: the stiffness is {}", figures.stiffness.word()),
        )
    };
    let diagnostic = Diagnostic::new(
        code,
        format!(
            "the blade yields by up to {} into the {into} at {}, but its limit is {} mm{indicative}",
            millimetres(worst.most),
            worst.at.words,
            number(limit.value.to_mm()),
        ),
        limit.span.unwrap_or(head),
        format!("{:.0} % of the push by {}", 100.0 * worst.share, worst.axis),
    );
    let kept = f64::max(operation.into_part.most, operation.into_waste.most);
    let kept = millimetres((kept * 100.0).ceil() / 100.0);
    let diagnostic = diagnostic
        .note(
            "to lower it, use smaller layers, move the work nearer to the arm, or use a shorter tool; thinner chips push a crusher \
             less, by a lower feed or a higher spin",
        );
    Some(match limit.span {
        Some(span) => diagnostic.fix(format!("`deviation <= {kept}` is kept"), span, kept),
        None => diagnostic,
    })
}

/// What of a job needs deviations that are known.
#[derive(Clone, Copy, Debug)]
pub struct Needs {
    code: Code,
    /// The consequence where they are not.
    what: &'static str,
    place: Span,
    label: &'static str,
    /// What does without them.
    instead: &'static str,
}

impl Needs {
    /// A limit on them.
    #[must_use]
    pub fn limit(limit: Sourced<Length>, head: Span) -> Self {
        Self {
            code: Code::LimitNotChecked,
            what: "`deviation` cannot be checked",
            place: limit.span.unwrap_or(head),
            label: "a limit that nothing checks",
            instead: "delete the limit",
        }
    }

    /// Tips that are to be offset against the forces.
    #[must_use]
    pub const fn compensation(place: Span) -> Self {
        Self {
            code: Code::NotCompensated,
            what: "the forces of the blade cannot be compensated",
            place,
            label: "asked for here",
            instead: "delete `compensate`",
        }
    }

    /// A place of the work that is to be chosen for them.
    #[must_use]
    pub const fn placement(place: Span) -> Self {
        Self {
            code: Code::LimitNotChecked,
            what: "no place can be chosen for its deviation",
            place,
            label: "this job",
            instead: "place it by the margin",
        }
    }

    fn fault(&self, why: &str) -> Diagnostic {
        Diagnostic::new(self.code, format!("{}: {why}", self.what), self.place, self.label)
    }
}

/// What needs deviations, which are not known.
#[must_use]
pub fn not_known(why: Unknown, needs: Needs, machine: &Machine) -> Diagnostic {
    let (name, place) = (&machine.model.name, machine.model_span);
    let instead = needs.instead;
    match why {
        Unknown::Forces => needs
            .fault("the blade of the operation states no forces")
            .help(format!(
                "measure them and state `forces {{ ... }}` in the blade, or {instead}"
            )),
        Unknown::Elasticity => needs
            .fault(&format!("`{name}` does not state how its joints yield"))
            .and(place, "no `[elasticity]`")
            .help(format!(
                "state `[elasticity]` in a sheet of your machine (docs/machines.md), or {instead}"
            )),
        Unknown::Weight => needs
            .fault("the weight of the arm counts, and its masses or its load are not known")
            .and(place, "with `gravity = uncompensated`")
            .help(format!(
                "state `load` in the machine and `[dynamics]` in its sheet, or {instead}"
            )),
        Unknown::Disc => needs
            .fault("for discs, only the torques are computed")
            .help(format!("{instead} instead")),
        Unknown::ClosedForm => needs
            .fault(&format!("`{name}` is not an arm with a spherical wrist"))
            .and(place, "the machine")
            .help(instead),
    }
}

/// The same of tips that are offset against the forces of the place that the job has now.
#[must_use]
pub fn compensated_elsewhere(needs: Needs) -> Diagnostic {
    let instead = needs.instead;
    needs
        .fault("the forces are compensated, and offsets of tips are those of one place")
        .help(format!(
            "delete `compensate` while the work is placed, or {instead}"
        ))
}

/// The same of a job without a machine.
#[must_use]
pub fn without_machine(needs: Needs) -> Diagnostic {
    let instead = needs.instead;
    needs
        .fault("the job has no machine")
        .help(format!("add the machine that carries the blade, or {instead}"))
}

/// A warning of cuts that are made otherwise than the forces were measured.
#[must_use]
pub fn elsewhere(found: &Elsewhere, forces: BladeForces<'_>) -> Diagnostic {
    Diagnostic::new(
        Code::ForcesElsewhere,
        format!(
            "the forces of `{}` were measured {}; {} is cut {}",
            found.blade,
            Condition::from(forces).words(),
            found.at.words,
            found.cut.words(),
        ),
        forces.statement().span,
        "used as they are",
    )
    .help("measure them as this cut is made")
}
