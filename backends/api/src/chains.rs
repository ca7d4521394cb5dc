//! What controllers do not take of chains, as far as it is the same for several.

use crate::arc::CircularArc;
use crate::backend::BackendIssue;
use crate::findings::{Findings, Number};
use crate::geometry::Point3;
use crate::ir::{Action, Joint, OpId, Program};
use crate::number::FixedDecimal;
use crate::vector::{length, minus};

/// Least and greatest blend, in mm. Controllers stop where there is nothing to round, whatever a program says; and none keeps
/// ways of a blade that may leave them further than this.
const BLENDS: (f64, f64) = (0.001, 50.0);

/// How far an arc through printed points may be from the arc that was proven, in units of the last decimal: a hundredth of a
/// millimetre as programs are printed by default. Arcs with a point well between their ends come to one or two.
const FARTHEST: f64 = 10.0;

/// Places at which the two are compared.
const SAMPLES: u32 = 32;

impl Findings {
    /// The blend of a program that has joints of chains which a robot passes without a stop.
    pub fn blend(&mut self, program: &Program, op: OpId) {
        let number = Number {
            what: "blend of a chain",
            value: program.blend.to_mm(),
            unit: "mm",
        };
        self.range(Some(op), &number, BLENDS);
    }

    /// An arc must be the same where its points are printed: where it begins, a point on it, where it ends.
    pub fn printed_arc(&mut self, op: OpId, points: [Point3; 3], lengths: FixedDecimal) {
        let exact = points.map(Point3::to_array);
        let printed = exact.map(|point| point.map(|value| lengths.rounded(value)));
        let [Some(should), Some(is)] = [exact, printed].map(CircularArc::through) else {
            let what = "an arc whose points lie on a line, or in one place, as they are printed";
            return self.report(what, BackendIssue::Unsupported { op, what });
        };
        let number = Number {
            what: "distance of an arc through printed points from the arc that was proven",
            value: apart(&is, &should),
            unit: "mm",
        };
        self.range(Some(op), &number, (0.0, FARTHEST * lengths.unit()));
    }
}

/// The greatest distance of two arcs where the same share of both is done, in mm.
fn apart(one: &CircularArc, other: &CircularArc) -> f64 {
    let points = one.points(SAMPLES).zip(other.points(SAMPLES));
    points.fold(0.0, |most: f64, (a, b)| most.max(length(minus(a, b))))
}

/// The first op that leads into the next one without a stop.
#[must_use]
pub fn first_joint(program: &Program) -> Option<OpId> {
    let mut ops = (0..).map(OpId).zip(&program.ops);
    let goes_on = |action: &Action| {
        matches!(
            action,
            Action::Follow {
                joint: Joint::Through,
                ..
            }
        )
    };
    ops.find(|(_, op)| goes_on(&op.action)).map(|(id, _)| id)
}

/// Whether a program follows arcs.
#[must_use]
pub fn has_arcs(program: &Program) -> bool {
    program.ops.iter().any(|op| op.action.via().is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(points: [[f64; 3]; 3]) -> Result<(), Vec<BackendIssue>> {
        let mut findings = Findings::default();
        findings.printed_arc(OpId(3), points.map(Point3::from), FixedDecimal::new(3));
        findings.result()
    }

    #[test]
    fn an_arc_whose_point_is_too_near_its_end_is_not_the_same_in_print() {
        let on = |angle: f64| {
            [
                100.0 * libm::cos(0.7 + angle),
                100.0 * libm::sin(0.7 + angle),
                0.0,
            ]
        };
        assert_eq!(found([0.0, 0.8, 1.6].map(on)), Ok(()));
        assert_eq!(found([0.0, 0.02, 0.04].map(on)), Ok(()));
        let near = found([0.0, 0.000_05, 1.6].map(on)).unwrap_err();
        assert!(
            matches!(
                near[..],
                [BackendIssue::OutOfRange {
                    op: Some(OpId(3)),
                    ..
                }]
            ),
            "{near:?}"
        );
        let one = found([0.0, 0.000_001, 1.6].map(on)).unwrap_err();
        assert!(matches!(one[..], [BackendIssue::Unsupported { .. }]), "{one:?}");
    }
}
