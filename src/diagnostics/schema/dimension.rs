//! Dimensions: what kind of quantity a value is, as exponents of length, angle, time and mass.
//!
//! The plane angle counts as a dimension of its own (unlike in the SI), so that `rake = 60` and `sin(3 mm)` are
//! caught and degrees never mix with pure numbers.

use crate::number::number;
use core::f64::consts::PI;
use std::fmt::Write as _;

/// Exponents of the base dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// Of length.
    pub length: i8,
    /// Of angle.
    pub angle: i8,
    /// Of time.
    pub time: i8,
    /// Of mass.
    pub mass: i8,
}

impl Dimension {
    /// A pure number.
    pub const PURE: Self = Self::new(0, 0, 0, 0);
    /// A length.
    pub const LENGTH: Self = Self::new(1, 0, 0, 0);
    /// An angle.
    pub const ANGLE: Self = Self::new(0, 1, 0, 0);
    /// An area.
    pub const AREA: Self = Self::new(2, 0, 0, 0);
    /// A time.
    pub const TIME: Self = Self::new(0, 0, 1, 0);
    /// A mass.
    pub const MASS: Self = Self::new(0, 0, 0, 1);
    /// A speed.
    pub const SPEED: Self = Self::new(1, 0, -1, 0);
    /// A turning rate.
    pub const TURNING_RATE: Self = Self::new(0, 1, -1, 0);
    /// A force.
    pub const FORCE: Self = Self::new(1, 0, -2, 1);
    /// A force on each length of an edge.
    pub const EDGE_FORCE: Self = Self::new(0, 0, -2, 1);
    /// A force on each area of a chip.
    pub const CUTTING_PRESSURE: Self = Self::new(-1, 0, -2, 1);
    /// A moment of inertia.
    pub const INERTIA: Self = Self::new(2, 0, 0, 1);

    /// From the four exponents.
    pub const fn new(length: i8, angle: i8, time: i8, mass: i8) -> Self {
        Self {
            length,
            angle,
            time,
            mass,
        }
    }

    /// Each pair of exponents joined; none when one leaves the range of exponents.
    fn zip(self, other: Self, join: fn(i8, i8) -> Option<i8>) -> Option<Self> {
        Some(Self::new(
            join(self.length, other.length)?,
            join(self.angle, other.angle)?,
            join(self.time, other.time)?,
            join(self.mass, other.mass)?,
        ))
    }

    /// Of a product; none when an exponent becomes too large.
    pub fn times(self, other: Self) -> Option<Self> {
        self.zip(other, i8::checked_add)
    }

    /// Of a quotient; none when an exponent becomes too large.
    pub fn over(self, other: Self) -> Option<Self> {
        self.zip(other, i8::checked_sub)
    }

    /// Of a whole power; none when an exponent becomes too large.
    pub fn power(self, exponent: i8) -> Option<Self> {
        self.zip(Self::new(exponent, exponent, exponent, exponent), i8::checked_mul)
    }

    /// Of a square root; none when an exponent is odd.
    pub fn root(self) -> Option<Self> {
        let half = |exponent: i8, two: i8| (exponent % two == 0).then_some(exponent / two);
        self.zip(Self::new(2, 2, 2, 2), half)
    }

    /// In words, with article: `a length`.
    pub fn words(self) -> String {
        let name = match (self.length, self.angle, self.time, self.mass) {
            (0, 0, 0, 0) => "a pure number",
            (1, 0, 0, 0) => "a length",
            (2, 0, 0, 0) => "an area",
            (3, 0, 0, 0) => "a volume",
            (0, 1, 0, 0) => "an angle",
            (0, 0, 1, 0) => "a time",
            (0, 0, 0, 1) => "a mass",
            (1, 0, -1, 0) => "a speed",
            (0, 1, -1, 0) => "a turning rate",
            (1, 0, -2, 0) => "an acceleration",
            (1, 0, -2, 1) => "a force",
            (0, 0, -2, 1) => "a force per length",
            (2, 0, 0, 1) => "a moment of inertia",
            _ => return format!("a quantity in {}", self.unit()),
        };
        name.to_owned()
    }

    /// The unit that people use for it: `mm`, `deg`, `mm/s`; empty for a pure number.
    pub fn unit(self) -> String {
        match self {
            Self::AREA => return "mm2".to_owned(),
            Self::FORCE => return "N".to_owned(),
            Self::EDGE_FORCE => return "N/mm".to_owned(),
            Self::CUTTING_PRESSURE => return "N/mm2".to_owned(),
            Self::INERTIA => return "kgm2".to_owned(),
            _ => {}
        }
        let powers = [
            ("mm", self.length),
            ("deg", self.angle),
            ("s", self.time),
            ("kg", self.mass),
        ];
        let mut above = String::new();
        let mut below = String::new();
        for (unit, exponent) in powers {
            let (side, separator) = match exponent {
                1.. if above.is_empty() => (&mut above, ""),
                1.. => (&mut above, "*"),
                _ => (&mut below, "/"),
            };
            // Writing to a String cannot fail.
            let _ = match exponent.unsigned_abs() {
                0 => Ok(()),
                1 => write!(side, "{separator}{unit}"),
                power => write!(side, "{separator}{unit}^{power}"),
            };
        }
        if above.is_empty() && !below.is_empty() {
            above.push('1');
        }
        above + &below
    }

    /// A number of these units, with the unit: `34.16 deg`.
    pub fn show(self, number_of_units: f64) -> String {
        let text = format!("{} {}", number(number_of_units), self.unit());
        text.trim_end().to_owned()
    }

    /// How much one of [`Self::unit`] is in the units in which values are stored (mm, rad, s, kg).
    pub fn unit_size(self) -> f64 {
        match self {
            // A newton is 1 kg m/s2.
            Self::FORCE | Self::EDGE_FORCE | Self::CUTTING_PRESSURE => return 1000.0,
            // A square metre is 1e6 mm2.
            Self::INERTIA => return 1e6,
            _ => {}
        }
        match self.angle {
            0 => 1.0,
            1 => PI / 180.0,
            exponent => libm::pow(PI / 180.0, f64::from(exponent)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn words_and_units() {
        assert_eq!(Dimension::LENGTH.words(), "a length");
        assert_eq!(Dimension::TURNING_RATE.unit(), "deg/s");
        assert_eq!(Dimension::new(1, 0, -2, 0).unit(), "mm/s^2");
        assert_eq!(Dimension::FORCE.unit(), "N");
        assert_eq!(
            Dimension::FORCE.over(Dimension::LENGTH),
            Some(Dimension::EDGE_FORCE)
        );
        assert_eq!(
            Dimension::FORCE.over(Dimension::AREA),
            Some(Dimension::CUTTING_PRESSURE)
        );
        assert_eq!(Dimension::new(0, 0, -1, 0).words(), "a quantity in 1/s");
        assert_eq!(Dimension::new(1, 1, -1, -2).unit(), "mm*deg/s/kg^2");
        assert_eq!(Dimension::PURE.unit(), "");
    }

    #[test]
    fn exponents_do_not_overflow() {
        let huge = Dimension::new(100, 0, 0, 0);
        assert_eq!(huge.times(huge), None);
        assert_eq!(huge.power(2), None);
        assert_eq!(Dimension::new(-100, 0, 0, 0).over(huge), None);
        assert_eq!(Dimension::LENGTH.root(), None);
        assert_eq!(
            Dimension::LENGTH
                .times(Dimension::LENGTH)
                .and_then(Dimension::root),
            Some(Dimension::LENGTH)
        );
    }

    /// Exponents as a plain vector of wide integers.
    fn vector(d: Dimension) -> [i32; 4] {
        [d.length, d.angle, d.time, d.mass].map(i32::from)
    }

    fn any_dimension() -> impl Strategy<Value = Dimension> {
        (any::<i8>(), any::<i8>(), any::<i8>(), any::<i8>())
            .prop_map(|(l, a, t, m)| Dimension::new(l, a, t, m))
    }

    fn narrow(wide: [i32; 4]) -> Option<[i32; 4]> {
        wide.iter().all(|&e| i8::try_from(e).is_ok()).then_some(wide)
    }

    proptest! {
        #[test]
        fn arithmetic_is_that_of_exponent_vectors(a in any_dimension(), b in any_dimension(), n in any::<i8>()) {
            let (va, vb) = (vector(a), vector(b));
            let sum = core::array::from_fn(|i| va[i] + vb[i]);
            let difference = core::array::from_fn(|i| va[i] - vb[i]);
            let multiple = va.map(|e| e * i32::from(n));
            prop_assert_eq!(a.times(b).map(vector), narrow(sum));
            prop_assert_eq!(a.over(b).map(vector), narrow(difference));
            prop_assert_eq!(a.power(n).map(vector), narrow(multiple));
            if let Some(root) = a.root() {
                prop_assert_eq!(vector(root).map(|e| 2 * e), va);
            } else {
                prop_assert!(va.iter().any(|e| e % 2 != 0));
            }
        }
    }
}
