//! How coarse a dialect may print at most. Within its grain numbers are the same, so a grain without bounds would make every
//! program read back as every other.

use super::Grain;
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// The coarsest grain.
pub const COARSEST: Grain = Grain {
    length: Length::mm(0.01),
    attitude: Angle::deg(0.1),
    axis: Angle::deg(0.1),
    speed: Speed::mm_per_s(1.0),
    rate: AngularSpeed::deg_per_s(1.0),
    per_minute: 1.0,
    time: Duration::s(0.01),
};

impl Grain {
    /// Which of its values is not a number, below zero or above that of [`COARSEST`], and that one in words.
    ///
    /// # Errors
    /// The key with what it may be.
    pub fn is_sound(&self) -> Result<(), &'static str> {
        let of = |grain: &Self| {
            [
                grain.length.to_mm(),
                grain.attitude.to_rad(),
                grain.axis.to_rad(),
                grain.speed.to_mm_per_s(),
                grain.rate.to_rad_per_s(),
                grain.per_minute,
                grain.time.to_s(),
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
        // A grain printed with few digits may be that of the cap and a rounding above it.
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
            Grain {
                length: Length::mm(0.011),
                ..COARSEST
            },
            Grain {
                attitude: Angle::deg(0.11),
                ..COARSEST
            },
            Grain {
                axis: Angle::deg(0.11),
                ..COARSEST
            },
            Grain {
                speed: Speed::mm_per_s(1.1),
                ..COARSEST
            },
            Grain {
                rate: AngularSpeed::deg_per_s(1.1),
                ..COARSEST
            },
            Grain {
                per_minute: 1.1,
                ..COARSEST
            },
            Grain {
                time: Duration::s(0.011),
                ..COARSEST
            },
            Grain {
                length: Length::mm(-0.001),
                ..COARSEST
            },
            Grain {
                per_minute: f64::NAN,
                ..COARSEST
            },
        ];
        for grain in coarser {
            assert!(grain.is_sound().is_err(), "{grain:?}");
        }
    }
}
