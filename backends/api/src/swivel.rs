//! Turns as KUKA's controllers time them: swivel and twist apart.
//!
//! A controller takes the turn of a straight move apart into the **swivel** of the tool's direction, by the angle `s` between
//! its start and its end, and the **twist** `t` about that direction. Both run at the same time, each up to a rate of its own
//! (`$VEL.ORI1`, `$VEL.ORI2`), and the slower decides. The tool's direction is x of the tool, here the `x_t` of the blade.
//!
//! A turn by the angle `phi` at the rate `r` is to take `phi / r`, for which the axes were proven. So its rates are
//! `s r / phi` and `t r / phi`. Whatever the controller takes for the tool's direction, and whichever of the two rates it
//! limits which part by, no turn is faster than that: as quaternions the turn is the product of a half turn by `t / 2` about the
//! direction and by `s / 2` square to it, so that `cos(s / 2) cos(t / 2) = cos(phi / 2)` for every direction. Where another
//! direction makes one part smaller it makes the other part larger.
//!
//! A part that is nearly zero has no rate of zero, which controllers refuse, but [`LEAST_SHARE`] of the turn's rate.

use crate::geometry::Orientation;
use crate::units::{Angle, AngularSpeed, Duration};

/// What a rate of swivel or twist is at least, of the rate of the turn as a whole. If a controller took another axis for the
/// tool's direction, a turn would take ten times as long at most, and 0.995 of its time at least.
pub const LEAST_SHARE: f64 = 0.1;

/// Something of swivel and twist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart<T> {
    /// Of the swivel of the tool's direction.
    pub swivel: T,
    /// Of the twist about it.
    pub twist: T,
}

impl Apart<Angle> {
    /// How far a turn swivels and twists; each from 0 to 180 degrees.
    #[must_use]
    pub fn of(from: Orientation, to: Orientation) -> Self {
        // The turn as the blade sees it: conj(from) to.
        let [a, b, c, d] = from.quaternion();
        let [w, x, y, z] = to.quaternion();
        let part = [
            a * w + b * x + c * y + d * z,
            a * x - b * w - c * z + d * y,
            a * y + b * z - c * w - d * x,
            a * z - b * y + c * x - d * w,
        ];
        let [w, x, y, z] = part.map(f64::abs);
        Self {
            swivel: Angle::rad(2.0 * libm::atan2(libm::hypot(y, z), libm::hypot(w, x))),
            twist: Angle::rad(2.0 * libm::atan2(x, w)),
        }
    }

    /// How long both take at most.
    #[must_use]
    pub fn duration(self, rates: Apart<AngularSpeed>) -> Duration {
        (self.swivel / rates.swivel).max(self.twist / rates.twist)
    }
}

impl Apart<AngularSpeed> {
    /// The rates at which a turn takes its whole angle over a rate. A turn of no angle has that rate twice.
    #[must_use]
    pub fn rates(from: Orientation, to: Orientation, rate: AngularSpeed) -> Self {
        let parts = Apart::of(from, to);
        let whole = from.angle_to(to);
        let of = |part: Angle| {
            if whole > Angle::ZERO {
                rate * (part / whole).clamp(LEAST_SHARE, 1.0)
            } else {
                rate
            }
        };
        Self {
            swivel: of(parts.swivel),
            twist: of(parts.twist),
        }
    }

    /// The rate of a turn as a whole that is carried out at these.
    #[must_use]
    pub fn whole(self, from: Orientation, to: Orientation) -> AngularSpeed {
        let duration = Apart::of(from, to).duration(self);
        if duration > Duration::ZERO {
            from.angle_to(to) / duration
        } else {
            self.swivel.max(self.twist)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn orientation() -> impl Strategy<Value = Orientation> {
        let part = || -1.0..1.0_f64;
        (part(), part(), part(), part()).prop_filter_map("a rotation", |(w, x, y, z)| {
            Orientation::from_quaternion(w, x, y, z)
        })
    }

    /// How far a direction of the blade swings: by the columns of matrices.
    fn swing(from: Orientation, to: Orientation, column: usize) -> f64 {
        let (a, b) = (from.matrix(), to.matrix());
        let cosine: f64 = (0..3).map(|row| a[row][column] * b[row][column]).sum();
        libm::acos(cosine.clamp(-1.0, 1.0))
    }

    proptest! {
        #[test]
        fn a_turn_takes_its_time_and_no_other_direction_makes_it_shorter(
            from in orientation(),
            to in orientation(),
        ) {
            let whole = from.angle_to(to).to_rad();
            prop_assume!((0.01..3.1).contains(&whole));
            let parts = Apart::of(from, to);
            prop_assert!((parts.swivel.to_rad() - swing(from, to, 0)).abs() < 1e-6);
            let rate = AngularSpeed::deg_per_s(65.0);
            let rates = Apart::rates(from, to, rate);
            prop_assert!((parts.duration(rates) * 65.0_f64.to_radians()).to_s() - whole < 1e-9);
            prop_assert!((rates.whole(from, to) / rate - 1.0).abs() < 1e-9);
            for column in 0..3 {
                let swivel = swing(from, to, column);
                let cosine = libm::cos(whole / 2.0) / libm::cos(swivel / 2.0);
                let twist = 2.0 * libm::acos(cosine.clamp(-1.0, 1.0));
                let [a, b] = [rates.swivel, rates.twist].map(AngularSpeed::to_rad_per_s);
                let times = [(swivel / a).max(twist / b), (twist / a).max(swivel / b)];
                let proven = whole / rate.to_rad_per_s();
                prop_assert!(times.iter().all(|time| *time > 0.99 * proven), "{times:?} {proven}");
            }
        }
    }
}
