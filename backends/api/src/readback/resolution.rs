//! How coarse a dialect may print at most. Within its resolution numbers are the same, so a resolution without bounds would make every
//! program read back as every other.

use super::Resolution;
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// The coarsest resolution.
pub const COARSEST: Resolution = Resolution {
    length: Length::mm(0.01),
    attitude: Angle::deg(0.1),
    axis: Angle::deg(0.1),
    speed: Speed::mm_per_s(1.0),
    rate: AngularSpeed::deg_per_s(1.0),
    per_minute: 1.0,
    time: Duration::s(0.01),
};

impl Resolution {
    /// Which of its values is not a number, below zero or above that of [`COARSEST`], and that one in words.
    ///
    /// # Errors
    /// The key with what it may be.
    pub fn is_sound(&self) -> Result<(), &'static str> {
        let of = |resolution: &Self| {
            [
                resolution.length.to_mm(),
                resolution.attitude.to_rad(),
                resolution.axis.to_rad(),
                resolution.speed.to_mm_per_s(),
                resolution.rate.to_rad_per_s(),
                resolution.per_minute,
                resolution.time.to_s(),
            ]
        };
        let words = [
            "`length` is 0 to 0.01 mm",
            "`attitude` is 0 to 0.1 deg",
            "`axis` is 0 to 0.1 deg",
            "`speed` is 0 to 1 mm/s",
            "`rate` is 0 to 1 deg/s",
            "`per_minute` is 0 to 1 a minute",
            "`time` is 0 to 0.01 s",
        ];
        // A resolution printed with few digits may be that of the cap and a rounding above it.
        const ROUNDING: f64 = 1.0 + 1e-9;
        let mut values = of(self).into_iter().zip(of(&COARSEST)).zip(words);
        let unsound = values.find(|((value, cap), _)| !(0.0..=cap * ROUNDING).contains(value));
        unsound.map_or(Ok(()), |(_, words)| Err(words))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coarsest_is_sound_and_nothing_coarser() {
        assert_eq!(COARSEST.is_sound(), Ok(()));
        let coarser = [
            Resolution {
                length: Length::mm(0.011),
                ..COARSEST
            },
            Resolution {
                attitude: Angle::deg(0.11),
                ..COARSEST
            },
            Resolution {
                axis: Angle::deg(0.11),
                ..COARSEST
            },
            Resolution {
                speed: Speed::mm_per_s(1.1),
                ..COARSEST
            },
            Resolution {
                rate: AngularSpeed::deg_per_s(1.1),
                ..COARSEST
            },
            Resolution {
                per_minute: 1.1,
                ..COARSEST
            },
            Resolution {
                time: Duration::s(0.011),
                ..COARSEST
            },
            Resolution {
                length: Length::mm(-0.001),
                ..COARSEST
            },
            Resolution {
                per_minute: f64::NAN,
                ..COARSEST
            },
        ];
        for resolution in coarser {
            assert!(resolution.is_sound().is_err(), "{resolution:?}");
        }
    }
}
