//! An arm along one course, whichever way its axes are found.

use super::arm::{ArmBranch, Carrying};
use super::bounds::Stretch;
use super::course::{Flight, Span};
use super::serial;
use super::types::{Course, Violation};
use crate::rig::Rig;
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::opw::Opw;
use vcutc_machine::kinematics::serial::SerialArm;
use vcutc_machine::kinematics::{Joints, Mechanism, newton};

/// An arm on a branch that carries the blade along a course.
pub(super) struct ArmCourse<'m> {
    pub(super) flight: Flight,
    pub(super) solver: Solver<'m>,
}

/// How the axes are found, and how spans are proven.
#[derive(Clone, Copy)]
pub(super) enum Solver<'m> {
    /// By a closed form.
    ClosedForm(&'m Opw, ArmBranch),
    /// By iteration and the Jacobian.
    Numeric(&'m SerialArm),
}

impl<'m> ArmCourse<'m> {
    /// `None` for a course without a duration, beyond all machines, or a branch that the machine does not have.
    pub(super) fn new(rig: &Rig<'m>, course: &Course, branch: Branch) -> Option<Self> {
        let lasts = course.duration > 0.0 && course.duration.is_finite();
        let mut rig = rig.clone();
        let solver = match (rig.mechanism, ArmBranch::of(branch)) {
            (Mechanism::OrthoParallel(arm), Some(branch)) => Solver::ClosedForm(arm, branch),
            (Mechanism::Mounted(mounted), Some(branch)) => {
                // Seen from the arm's own foot and for its own flange it is any other arm.
                rig.work_in_root = mounted.foot_in_root.inverse() * rig.work_in_root;
                rig.flange_in_blade = rig.flange_in_blade * mounted.flange_in_hand.inverse();
                Solver::ClosedForm(&mounted.arm, branch)
            }
            (Mechanism::Serial(arm), None) => Solver::Numeric(arm),
            (Mechanism::OrthoParallel(_) | Mechanism::Mounted(_), None)
            | (Mechanism::Serial(_), Some(_))
            | (Mechanism::FiveAxis(_), _) => return None,
        };
        let flight = Flight::new(&rig, course).filter(|_| lasts)?;
        Some(Self { flight, solver })
    }

    /// The axes at a place of the course.
    pub(super) fn joints_at(&self, place: f64, near: &Joints) -> Option<Joints> {
        let flange = self.flight.flange_at(place);
        match self.solver {
            Solver::ClosedForm(arm, branch) => arm.on_branch(&flange, branch.into(), near),
            Solver::Numeric(arm) => newton::follow(arm, &flange, near),
        }
    }

    /// The start to go on from. Where kinematics finds no axis values, or others than the given ones, there is none.
    pub(super) fn begun(&self, start: &Joints) -> Option<Joints> {
        let begun = self.joints_at(0.0, start).filter(|begun| is_same(begun, start))?;
        match self.solver {
            Solver::ClosedForm(..) => Some(*start),
            // Its spans are proven from what the axes are before.
            Solver::Numeric(arm) => serial::verified(arm, &self.flight, 0.0, &begun),
        }
    }

    /// What the axes do on a span that they enter at `begin`, proven.
    pub(super) fn stretch(&self, span: Span, begin: &Joints) -> Result<Stretch, Violation> {
        match self.solver {
            Solver::ClosedForm(arm, branch) => {
                let mut carrying = Carrying::new(arm, branch, self.flight.shape());
                carrying.take(0, &self.flight);
                carrying.set(0, span);
                carrying.sweep();
                carrying.stretch(0)
            }
            Solver::Numeric(arm) => serial::stretch(arm, &self.flight, span, begin),
        }
    }
}

/// How far apart given and computed axis values at the start may be, in rad or mm.
const SAME_START: f64 = 1e-5;

fn is_same(one: &Joints, other: &Joints) -> bool {
    one.iter()
        .zip(other)
        .all(|(one, other)| (one - other).abs() <= SAME_START)
}
