//! The ranges of values that the fields of a job take.

use super::dimension::Dimension;
use core::ops::Bound;
pub use vcutc_diagnostics::schema::range::Range;

/// Nothing in a cell is longer than a hundred metres.
const LONGEST: f64 = 100_000.0;

/// Lengths of things that exist.
pub const SIZE: Range = Range::positive(Dimension::LENGTH, LONGEST);
/// Lengths that may be nothing.
pub const DISTANCE: Range = Range::closed(Dimension::LENGTH, 0.0, LONGEST);
pub const COORDINATE: Range = Range::closed(Dimension::LENGTH, -LONGEST, LONGEST);
/// Half the apex angle of a blade.
pub const HALF_APEX: Range = Range::new(Dimension::ANGLE, Bound::Included(0.0), Bound::Excluded(90.0));
/// Rake: at 90 deg the blade is square to the feed.
pub const RAKE: Range = Range::positive(Dimension::ANGLE, 90.0);
/// Swing: half the opening angle of a V. Swings are chosen to a thousandth of a degree; less than that is not a V.
pub const SWING: Range = Range::new(Dimension::ANGLE, Bound::Included(0.001), Bound::Excluded(90.0));
pub const FRAME_ANGLE: Range = Range::closed(Dimension::ANGLE, -360.0, 360.0);
/// Parts of a quaternion. Whether all four make a rotation is checked together.
pub const QUATERNION_PART: Range = Range::closed(Dimension::PURE, -1000.0, 1000.0);
/// Angles of robot axes, which may turn more than once.
pub const AXIS_ANGLE: Range = Range::closed(Dimension::ANGLE, -1080.0, 1080.0);
/// Speeds of the tip, up to 100 m/s.
pub const SPEED: Range = Range::positive(Dimension::SPEED, 100_000.0);
/// Rates of turning the blade.
pub const TURNING_RATE: Range = Range::positive(Dimension::TURNING_RATE, 10_000.0);
/// Rates at which a disc or a crusher turns about its axis, up to 100 000 rev/min.
pub const SPIN: Range = Range::positive(Dimension::TURNING_RATE, 600_000.0);
/// The steepest way of a crusher down into the material.
pub const RAMP: Range = Range::new(Dimension::ANGLE, Bound::Excluded(0.0), Bound::Excluded(90.0));
/// Overlap of neighbouring cuts.
pub const OVERLAP: Range = Range::new(Dimension::PURE, Bound::Included(0.0), Bound::Excluded(1.0));
/// Waiting times, up to an hour.
pub const WAIT: Range = Range::closed(Dimension::TIME, 0.0, 3600.0);
/// Longest times of an operation, up to a year.
pub const LONGEST_TIME: Range = Range::positive(Dimension::TIME, 31_536_000.0);
/// Most cuts of an operation.
pub const MOST_CUTS: Range = Range::closed(Dimension::PURE, 1.0, 4_000_000.0);
/// Masses on a flange.
pub const MASS: Range = Range::closed(Dimension::MASS, 0.0, 10_000.0);
/// Forces at the tip of a blade.
pub const FORCE: Range = Range::closed(Dimension::FORCE, 0.0, 1e5);
/// Forces on each millimetre of an edge.
pub const EDGE_FORCE: Range = Range::closed(Dimension::EDGE_FORCE, 0.0, 1e4);
/// Forces on each square millimetre of a chip.
pub const CUTTING_PRESSURE: Range = Range::closed(Dimension::CUTTING_PRESSURE, 0.0, 1e5);
/// How many teeth a crusher has on its outside.
pub const TEETH: Range = Range::closed(Dimension::PURE, 1.0, 100.0);
/// Between the teeth of a crusher and its axis.
pub const HELIX: Range = Range::new(Dimension::ANGLE, Bound::Included(0.0), Bound::Excluded(90.0));
/// By which share of itself a measured value may be off, either way.
pub const SPREAD: Range = Range::new(Dimension::PURE, Bound::Included(0.0), Bound::Excluded(1.0));
/// Shares that a limit leaves of something.
pub const SHARE: Range = Range::new(Dimension::PURE, Bound::Excluded(0.0), Bound::Included(1.0));
/// Swings of a blade, upright ones too.
pub const SWING_OR_UPRIGHT: Range = Range::new(Dimension::ANGLE, Bound::Included(0.0), Bound::Excluded(90.0));
/// Factors by which forces grow.
pub const GROWTH: Range = Range::closed(Dimension::PURE, 1.0, 100.0);
/// Factors by which a file's points are stretched.
pub const SCALE: Range = Range::positive(Dimension::PURE, 1e6);
/// Gaps between the lines of a drawing over which they are joined.
pub const JOINING: Range = Range::positive(Dimension::LENGTH, 10.0);
/// Moments of inertia of loads.
pub const INERTIA: Range = Range::closed(Dimension::INERTIA, 0.0, 1e4);
/// Numbers of inputs and outputs of a controller.
pub const SIGNAL: Range = Range::closed(Dimension::PURE, 1.0, 65_535.0);
/// Numbers of a controller's own tables, counted from 1.
pub const TABLE_NUMBER: Range = Range::closed(Dimension::PURE, 1.0, 9_999.0);

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
