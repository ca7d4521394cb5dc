//! Legal ranges of fields, in the unit that people use for them.

use super::dimension::Dimension;
use super::quantity::{number, with_unit};

/// Lower end of a range.
#[derive(Clone, Copy, Debug)]
pub enum Low {
    /// The end itself is not legal.
    Above(f64),
    /// The end itself is legal.
    AtLeast(f64),
}

/// Upper end of a range.
#[derive(Clone, Copy, Debug)]
pub enum High {
    /// The end itself is not legal.
    Below(f64),
    /// The end itself is legal.
    AtMost(f64),
}

/// A range of values of one dimension, in its usual unit (mm, deg, mm/s, deg/s, s, kg).
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// What the values are.
    pub dimension: Dimension,
    low: Low,
    high: High,
}

const fn range(dimension: Dimension, low: Low, high: High) -> Range {
    Range { dimension, low, high }
}

/// Nothing in a cell is longer than a hundred metres.
const LONGEST: f64 = 100_000.0;

/// Lengths of things that exist.
pub const SIZE: Range = range(Dimension::LENGTH, Low::Above(0.0), High::AtMost(LONGEST));
/// Lengths that may be nothing.
pub const DISTANCE: Range = range(Dimension::LENGTH, Low::AtLeast(0.0), High::AtMost(LONGEST));
pub const COORDINATE: Range = range(Dimension::LENGTH, Low::AtLeast(-LONGEST), High::AtMost(LONGEST));
/// Half the apex angle of a blade.
pub const HALF_APEX: Range = range(Dimension::ANGLE, Low::AtLeast(0.0), High::Below(90.0));
/// Rake: at 90 deg the blade stands square to the feed.
pub const RAKE: Range = range(Dimension::ANGLE, Low::Above(0.0), High::AtMost(90.0));
/// Swing: half the opening angle of a V. Swings are chosen to a thousandth of a degree; less than that is no V.
pub const SWING: Range = range(Dimension::ANGLE, Low::AtLeast(0.001), High::Below(90.0));
pub const FRAME_ANGLE: Range = range(Dimension::ANGLE, Low::AtLeast(-360.0), High::AtMost(360.0));
/// Parts of a quaternion. Whether all four make a rotation is looked at together.
pub const QUATERNION_PART: Range = range(Dimension::PURE, Low::AtLeast(-1000.0), High::AtMost(1000.0));
/// Angles of robot axes, which may turn more than once.
pub const AXIS_ANGLE: Range = range(Dimension::ANGLE, Low::AtLeast(-1080.0), High::AtMost(1080.0));
/// Speeds of the tip, up to 100 m/s.
pub const SPEED: Range = range(Dimension::SPEED, Low::Above(0.0), High::AtMost(100_000.0));
/// Rates of turning the blade.
pub const TURNING_RATE: Range = range(Dimension::TURNING_RATE, Low::Above(0.0), High::AtMost(10_000.0));
/// Overlap of neighbouring cuts.
pub const OVERLAP: Range = range(Dimension::PURE, Low::AtLeast(0.0), High::Below(1.0));
/// Waiting times, up to an hour.
pub const WAIT: Range = range(Dimension::TIME, Low::AtLeast(0.0), High::AtMost(3600.0));
/// Longest times of an operation, up to a year.
pub const LONGEST_TIME: Range = range(Dimension::TIME, Low::Above(0.0), High::AtMost(31_536_000.0));
/// Most cuts of an operation.
pub const MOST_CUTS: Range = range(Dimension::PURE, Low::AtLeast(1.0), High::AtMost(4_000_000.0));
/// Masses on a flange.
pub const MASS: Range = range(Dimension::MASS, Low::AtLeast(0.0), High::AtMost(10_000.0));
/// Factors by which a file's points are stretched.
pub const SCALE: Range = range(Dimension::PURE, Low::Above(0.0), High::AtMost(1e6));
/// Gaps between the lines of a drawing over which they are joined.
pub const JOINING: Range = range(Dimension::LENGTH, Low::Above(0.0), High::AtMost(10.0));
/// Numbers of inputs and outputs of a controller.
pub const SIGNAL: Range = range(Dimension::PURE, Low::AtLeast(1.0), High::AtMost(65_535.0));
/// Numbers of a controller's own tables, counted from 1.
pub const TABLE_NUMBER: Range = range(Dimension::PURE, Low::AtLeast(1.0), High::AtMost(9_999.0));

impl Range {
    /// Whether a value in mm, rad, s, kg lies within.
    pub fn holds(self, value: f64) -> bool {
        // Ends are converted, not the value, so that `90 deg` is exactly the end at 90 deg.
        let unit = self.dimension.unit_size();
        let above = match self.low {
            Low::Above(end) => value > end * unit,
            Low::AtLeast(end) => value >= end * unit,
        };
        let below = match self.high {
            High::Below(end) => value < end * unit,
            High::AtMost(end) => value <= end * unit,
        };
        above && below
    }

    /// In words: `greater than 0 deg and at most 90 deg`.
    pub fn words(self) -> String {
        let low = match self.low {
            Low::Above(end) => format!("greater than {}", self.end(end)),
            Low::AtLeast(end) => format!("at least {}", self.end(end)),
        };
        let high = match self.high {
            High::Below(end) => format!("less than {}", self.end(end)),
            High::AtMost(end) => format!("at most {}", self.end(end)),
        };
        format!("{low} and {high}")
    }

    /// An end with its unit; ends of many thousand mm are easier to read in m.
    fn end(self, end: f64) -> String {
        let long = end.abs() >= 10_000.0;
        match self.dimension {
            Dimension::LENGTH if long => format!("{} m", number(end / 1000.0)),
            Dimension::SPEED if long => format!("{} m/s", number(end / 1000.0)),
            dimension => with_unit(end, dimension),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::units::Angle;

    #[test]
    fn ends_belong_or_not() {
        assert!(RAKE.holds(Angle::deg(90.0).to_rad()));
        assert!(!RAKE.holds(Angle::deg(90.000_001).to_rad()));
        assert!(!RAKE.holds(0.0));
        assert!(!SWING.holds(Angle::deg(90.0).to_rad()));
        assert!(HALF_APEX.holds(0.0));
        assert!(!SIZE.holds(f64::NAN));
    }

    #[test]
    fn ranges_in_words() {
        assert_eq!(RAKE.words(), "greater than 0 deg and at most 90 deg");
        assert_eq!(OVERLAP.words(), "at least 0 and less than 1");
        assert_eq!(SIZE.words(), "greater than 0 mm and at most 100 m");
        assert_eq!(SPEED.words(), "greater than 0 mm/s and at most 100 m/s");
        assert_eq!(COORDINATE.words(), "at least -100 m and at most 100 m");
    }
}
