//! Quantities as types: a length cannot be handed over where an angle is wanted.
//!
//! Each type holds one `f64` in the unit of `docs/ir.md` (mm, rad, s, kg) and is made and read through
//! functions that name their unit. Values come from the language's evaluator or from the verifier, which both
//! refuse what is not finite; arithmetic on such values stays finite because their magnitudes are bounded.

use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
use serde::{Deserialize, Serialize};

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $($(#[$unit_doc:meta])* $make:ident / $read:ident = $factor:expr;)+) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Serialize, Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[serde(transparent)]
        pub struct $name(f64);

        impl $name {
            /// Nothing of it.
            pub const ZERO: Self = Self(0.0);
            $(
                $(#[$unit_doc])*
                #[must_use]
                pub const fn $make(value: f64) -> Self {
                    Self(value * $factor)
                }
                $(#[$unit_doc])*
                #[must_use]
                pub const fn $read(self) -> f64 {
                    self.0 / $factor
                }
            )+
            /// The magnitude.
            #[must_use]
            pub const fn abs(self) -> Self {
                Self(self.0.abs())
            }
            /// The smaller of two.
            #[must_use]
            pub const fn min(self, other: Self) -> Self {
                Self(self.0.min(other.0))
            }
            /// The larger of two.
            #[must_use]
            pub const fn max(self, other: Self) -> Self {
                Self(self.0.max(other.0))
            }
            /// Whether the value is a number at all.
            #[must_use]
            pub const fn is_finite(self) -> bool {
                self.0.is_finite()
            }
            /// A total order (all values that reach here are finite).
            #[must_use]
            pub fn total_cmp(&self, other: &Self) -> core::cmp::Ordering {
                self.0.total_cmp(&other.0)
            }
        }
        impl Add for $name {
            type Output = Self;
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }
        impl AddAssign for $name {
            fn add_assign(&mut self, other: Self) {
                self.0 += other.0;
            }
        }
        impl Sub for $name {
            type Output = Self;
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }
        impl SubAssign for $name {
            fn sub_assign(&mut self, other: Self) {
                self.0 -= other.0;
            }
        }
        impl Neg for $name {
            type Output = Self;
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }
        impl Mul<f64> for $name {
            type Output = Self;
            fn mul(self, factor: f64) -> Self {
                Self(self.0 * factor)
            }
        }
        impl Mul<$name> for f64 {
            type Output = $name;
            fn mul(self, quantity: $name) -> $name {
                $name(self * quantity.0)
            }
        }
        impl Div<f64> for $name {
            type Output = Self;
            fn div(self, divisor: f64) -> Self {
                Self(self.0 / divisor)
            }
        }
        impl Div for $name {
            type Output = f64;
            fn div(self, other: Self) -> f64 {
                self.0 / other.0
            }
        }
        impl Sum for $name {
            fn sum<I: Iterator<Item = Self>>(values: I) -> Self {
                values.fold(Self::ZERO, Add::add)
            }
        }
    };
}

quantity! {
    /// A length; held in millimetres.
    Length,
    /// Millimetres.
    mm / to_mm = 1.0;
    /// Metres.
    m / to_m = 1000.0;
}
quantity! {
    /// A plane angle; held in radians.
    Angle,
    /// Radians.
    rad / to_rad = 1.0;
    /// Degrees.
    deg / to_deg = core::f64::consts::PI / 180.0;
}
quantity! {
    /// A speed of the tip; held in mm/s.
    Speed,
    /// Millimetres a second.
    mm_per_s / to_mm_per_s = 1.0;
    /// Metres a second.
    m_per_s / to_m_per_s = 1000.0;
}
quantity! {
    /// A rate of turning; held in rad/s.
    AngularSpeed,
    /// Radians a second.
    rad_per_s / to_rad_per_s = 1.0;
    /// Degrees a second.
    deg_per_s / to_deg_per_s = core::f64::consts::PI / 180.0;
    /// Turns a minute.
    rev_per_min / to_rev_per_min = core::f64::consts::TAU / 60.0;
}
quantity! {
    /// A time span; held in seconds.
    Duration,
    /// Seconds.
    s / to_s = 1.0;
}
quantity! {
    /// A mass; held in kilograms.
    Mass,
    /// Kilograms.
    kg / to_kg = 1.0;
}
quantity! {
    /// A force; held in newtons.
    Force,
    /// Newtons.
    n / to_n = 1.0;
}
quantity! {
    /// A force on each length of an edge; held in N/mm.
    EdgeForce,
    /// Newtons a millimetre.
    n_per_mm / to_n_per_mm = 1.0;
}
quantity! {
    /// A force on each area of a chip; held in N/mm2.
    CuttingPressure,
    /// Newtons a square millimetre.
    n_per_mm2 / to_n_per_mm2 = 1.0;
}
quantity! {
    /// An area in the x-z plane; held in mm2.
    Area,
    /// Square millimetres.
    mm2 / to_mm2 = 1.0;
}

impl Angle {
    /// Sine.
    #[must_use]
    pub fn sin(self) -> f64 {
        libm::sin(self.0)
    }
    /// Cosine.
    #[must_use]
    pub fn cos(self) -> f64 {
        libm::cos(self.0)
    }
    /// Tangent.
    #[must_use]
    pub fn tan(self) -> f64 {
        libm::tan(self.0)
    }
}

impl Div<Speed> for Length {
    type Output = Duration;
    fn div(self, speed: Speed) -> Duration {
        Duration(self.0 / speed.0)
    }
}
impl Div<AngularSpeed> for Angle {
    type Output = Duration;
    fn div(self, rate: AngularSpeed) -> Duration {
        Duration(self.0 / rate.0)
    }
}
impl Div<Duration> for Length {
    type Output = Speed;
    fn div(self, time: Duration) -> Speed {
        Speed(self.0 / time.0)
    }
}

impl Div<Duration> for Angle {
    type Output = AngularSpeed;
    fn div(self, time: Duration) -> AngularSpeed {
        AngularSpeed(self.0 / time.0)
    }
}
