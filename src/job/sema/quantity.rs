//! Quantities: a number with its dimension, stored in mm, rad, s and kg.

use super::dimension::Dimension;
use vcutc_backend_api::units::{
    Angle, AngularSpeed, Area, CuttingPressure, Duration, EdgeForce, Force, Length, Mass, Speed,
};
pub use vcutc_diagnostics::number::number;

/// A number with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// In mm, rad, s, kg and their products.
    pub value: f64,
    pub dimension: Dimension,
}

/// No quantity of a job is larger than this in mm, rad, s or kg: a million metres, or thirty years. Products of
/// several dimensions may be accordingly larger.
const LARGEST: f64 = 1e9;

impl Quantity {
    /// A value in the base units of its dimension.
    pub const fn new(value: f64, dimension: Dimension) -> Self {
        Self { value, dimension }
    }

    /// A pure number.
    pub const fn pure(value: f64) -> Self {
        Self::new(value, Dimension::PURE)
    }

    /// A length, in mm.
    pub const fn length(mm: f64) -> Self {
        Self::new(mm, Dimension::LENGTH)
    }

    /// Whether it is a number of a size that can mean something.
    pub fn is_sensible(self) -> bool {
        let Dimension {
            length,
            angle,
            time,
            mass,
        } = self.dimension;
        let degree: i32 = [length, angle, time, mass]
            .into_iter()
            .map(|e| i32::from(e.max(0)))
            .sum();
        self.value.is_finite() && self.value.abs() <= libm::pow(LARGEST, f64::from(degree.max(1)))
    }

    /// As people write it, to six digits: `34.16 deg`.
    pub fn text(self) -> String {
        self.dimension.show(self.value / self.dimension.unit_size())
    }
}

/// A length as people write it.
pub fn mm(value: f64) -> String {
    Quantity::length(value).text()
}

/// A place in mm to the nearest micrometre: what is finer says nothing to people.
pub fn to_um(value: f64) -> f64 {
    libm::round(value * 1000.0) / 1000.0 + 0.0
}

/// A type of the later stages that a quantity turns into.
pub trait Measured: Copy {
    /// What a value must be to become one.
    const DIMENSION: Dimension;

    /// From a value in mm, rad, s, kg.
    fn from_base(value: f64) -> Self;

    /// To a value in mm, rad, s, kg.
    fn to_base(self) -> f64;
}

macro_rules! measured {
    ($($type:ty, $dimension:ident, $make:expr, $take:expr;)+) => {
        $(impl Measured for $type {
            const DIMENSION: Dimension = Dimension::$dimension;
            fn from_base(value: f64) -> Self {
                $make(value)
            }
            fn to_base(self) -> f64 {
                $take(self)
            }
        })+
    };
}

measured! {
    f64, PURE, core::convert::identity, core::convert::identity;
    Length, LENGTH, Length::mm, Length::to_mm;
    Area, AREA, Area::mm2, Area::to_mm2;
    Angle, ANGLE, Angle::rad, Angle::to_rad;
    Duration, TIME, Duration::s, Duration::to_s;
    Mass, MASS, Mass::kg, Mass::to_kg;
    Force, FORCE, from_base_force, to_base_force;
    EdgeForce, EDGE_FORCE, from_base_edge_force, to_base_edge_force;
    CuttingPressure, CUTTING_PRESSURE, from_base_pressure, to_base_pressure;
    Speed, SPEED, Speed::mm_per_s, Speed::to_mm_per_s;
    AngularSpeed, TURNING_RATE, AngularSpeed::rad_per_s, AngularSpeed::to_rad_per_s;
}

/// One newton in kg mm/s2, one newton a millimetre in kg/s2, and one newton a square millimetre in kg/mm/s2.
const NEWTON: f64 = 1000.0;

const fn from_base_force(value: f64) -> Force {
    Force::n(value / NEWTON)
}

const fn to_base_force(force: Force) -> f64 {
    force.to_n() * NEWTON
}

const fn from_base_edge_force(value: f64) -> EdgeForce {
    EdgeForce::n_per_mm(value / NEWTON)
}

const fn to_base_edge_force(force: EdgeForce) -> f64 {
    force.to_n_per_mm() * NEWTON
}

const fn from_base_pressure(value: f64) -> CuttingPressure {
    CuttingPressure::n_per_mm2(value / NEWTON)
}

const fn to_base_pressure(pressure: CuttingPressure) -> f64 {
    pressure.to_n_per_mm2() * NEWTON
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_shown_in_the_units_of_the_trade() {
        assert_eq!(
            Quantity::new(core::f64::consts::FRAC_PI_2, Dimension::ANGLE).text(),
            "90 deg"
        );
        assert_eq!(Quantity::new(200.0, Dimension::SPEED).text(), "200 mm/s");
        assert_eq!(Quantity::pure(0.25).text(), "0.25");
    }

    #[test]
    fn absurd_sizes_are_distinguished() {
        assert!(Quantity::length(1e9).is_sensible());
        assert!(!Quantity::length(1.1e9).is_sensible());
        assert!(Quantity::new(1e12, Dimension::new(2, 0, 0, 0)).is_sensible());
        assert!(!Quantity::pure(f64::NAN).is_sensible());
        assert!(!Quantity::pure(f64::NEG_INFINITY).is_sensible());
    }
}
