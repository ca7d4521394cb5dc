//! The joints of an arm as springs: how much each turns for a torque about it.

use crate::chain::JOINTS;
use vcutc_geometry::number::Interval;
use vcutc_machine::elasticity::Elasticity;

/// Springs at the controller's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Springs([Spring; JOINTS]);

/// How much an axis turns for each Nm, in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring {
    /// With the stiffness as stated.
    pub(crate) stated: f64,
    /// By how much it may differ from that.
    pub(crate) off: Interval,
}

impl Spring {
    /// Whatever it may be.
    pub(crate) fn any(self) -> Interval {
        Interval::exactly(self.stated) + self.off
    }
}

impl From<&Elasticity> for Springs {
    fn from(elasticity: &Elasticity) -> Self {
        Self(core::array::from_fn(|axis| {
            let (stiffness, spread) = (elasticity.stiffness[axis], elasticity.spread[axis]);
            let stated = 1.0 / stiffness;
            let [soft, stiff] = [1.0 - spread, 1.0 + spread].map(|share| stated / share - stated);
            Spring {
                stated,
                // Wider than its own rounding.
                off: Interval {
                    low: stiff,
                    high: soft,
                } + Interval::around(0.0, 4.0 * f64::EPSILON * stated),
            }
        }))
    }
}

impl Springs {
    #[cfg(test)]
    pub(crate) const fn of(springs: [Spring; JOINTS]) -> Self {
        Self(springs)
    }

    pub(crate) const fn each(&self) -> &[Spring; JOINTS] {
        &self.0
    }

    /// The axis whose spring yields most for what each turns by, and its share.
    pub(crate) fn softest(turned: [f64; JOINTS]) -> (usize, f64) {
        let whole: f64 = turned.iter().map(|part| part.abs()).sum();
        let largest = |(best, most): (usize, f64), (axis, part): (usize, &f64)| {
            if part.abs() > most {
                (axis, part.abs())
            } else {
                (best, most)
            }
        };
        let (axis, most) = turned.iter().enumerate().fold((0, 0.0), largest);
        (axis, if whole > 0.0 { most / whole } else { 0.0 })
    }
}
