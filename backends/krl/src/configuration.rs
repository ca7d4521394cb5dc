//! Status and turn: which of the ways to reach a pose is meant, as KRL says it.
//!
//! An arm reaches a pose in up to eight ways, and an axis that turns by more than a revolution reaches each of them in more
//! than one. `S` names the way and `T` the turn, both sums of bits:
//!
//! | bit | weight | of S | of T |
//! |---|---|---|---|
//! | 0 | 1 | the wrist centre has negative x in the frame that turns with A1 | A1 < 0 |
//! | 1 | 2 | A3 > phi: the wrist centre is in front of the line through axes 2 and 3 | A2 < 0 |
//! | 2 | 4 | A5 < 0 | A3 < 0 |
//! | 3 to 5 | 8 to 32 | not written | A4 < 0, A5 < 0, A6 < 0 |
//!
//! `phi` is the angle of A3 at which the arm is stretched, `-atan2(a2, c3)` in the lengths of its kinematics. The usual
//! home, 0, -90, 90, 0, 0, 0 deg, has S 2 and T 2.
//!
//! # At the borders
//!
//! With the wrist centre on axis 1, with A3 at phi and with A5 at zero two ways meet, and S would depend on
//! rounding. These are singular poses, from which a program keeps away. An axis at zero is not such a pose.
//! A1 is often there, and the bit in T of an axis within rounding of zero could be either; controllers are
//! reported to ignore the bits of axes within some 2 deg of zero [K-TURN], and an axis that cannot make a
//! revolution leaves them no choice. [`AT_ZERO`] keeps the text from depending on the last digits of a
//! computation.
//!
//! # Sources
//!
//! * Bits of S and of T: Beckhoff, TwinCAT TF5200 programming manual, "Status & Turn (IS, IT)"; bit 0 also robot-forum.com
//!   thread 7173, which quotes KUKA's expert manual.
//! * [K-ST] robot-forum.com thread 42877: `PTP` obeys S and T, `LIN` keeps the status of its start.
//! * [K-TURN] industrialmonitordirect.com, "KUKA PTP turn bit ignored at near zero A6 angles".

use vcutc_backend_api::ir::AxisValues;
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::readback::Configuration;
use vcutc_backend_api::status::kuka_status;

/// Status and turn of a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StatusAndTurn {
    /// `S`.
    pub(crate) status: u32,
    /// `T`.
    pub(crate) turn: u32,
}

/// An axis that is not further below zero than this, in rad, counts as not negative: 1e-9 of a degree.
const AT_ZERO: f64 = 2e-11;

impl StatusAndTurn {
    /// As readers compare it.
    pub(crate) fn configuration(self) -> Option<Configuration> {
        let [status, turn] = [self.status, self.turn].map(i32::try_from);
        Some(Configuration([status.ok()?, turn.ok()?, 0, 0]))
    }

    /// That of an arm on a branch with its axes there; none for a branch that is not of such an arm.
    pub(crate) fn of(branch: Branch, axes: AxisValues) -> Option<Self> {
        Some(Self {
            status: kuka_status(branch)?.into(),
            turn: turn(axes),
        })
    }
}

fn turn(axes: AxisValues) -> u32 {
    let weights = [1, 2, 4, 8, 16, 32];
    weights
        .into_iter()
        .zip(axes.0)
        .filter(|&(_, axis)| axis < -AT_ZERO)
        .map(|(weight, _)| weight)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::motion::{Elbow, Shoulder, Wrist};

    const HOME: [f64; 6] = [0.0, -90.0, 90.0, 0.0, 0.0, 0.0];

    fn degrees(axes: [f64; 6]) -> AxisValues {
        AxisValues(axes.map(f64::to_radians))
    }

    /// The value that the robot data states for the usual home.
    #[test]
    fn home_has_status_2_and_turn_2() {
        let branch = Branch::Arm {
            shoulder: Shoulder::Front,
            elbow: Elbow::Forward,
            wrist: Wrist::Positive,
        };
        let expected = StatusAndTurn { status: 2, turn: 2 };
        assert_eq!(StatusAndTurn::of(branch, degrees(HOME)), Some(expected));
    }

    #[test]
    fn a_zero_with_noise_is_not_a_negative_axis() {
        assert_eq!(turn(degrees([-1e-10, -0.0, 0.0, 1e-10, -1e-4, -350.0])), 48);
    }
}
