//! ABB's confdata: which of its ways to reach a pose an arm takes, in four whole numbers.
//!
//! It stands here and not in a backend because the compiler's own commands about single poses print it too.
//!
//! `[cf1, cf4, cf6, cfx]`: the quarter turns in which axes 1, 4 and 6 are, counted from 0 upwards and from -1 downwards, so
//! that they distinguish full turns as well; cfx with the weights 1, 2, 4: axis 5 negative; the wrist centre
//! behind the lower arm; behind axis 1 (RAPID reference, `confdata`). "Behind the lower arm" is meant as seen
//! in the frame that turns with axis 1, so that it is [`Elbow::Backward`] on both sides of axis 1.
//! visose/Robots agrees: it swaps the sense of the elbow in its kinematics and once more where it writes cfx.
//! The table of ABB's manual was not at hand; before relying on 4 to 7, compare with RobotStudio. Arms with
//! parallel rods, which cannot fold over, do not use cfx; what it says of their axis 5 and elbow is written
//! all the same.

use crate::ir::AxisValues;
use crate::motion::{Branch, Elbow, Shoulder, Wrist};
use core::f64::consts::FRAC_PI_2;

/// What is below a border between two quarters by no more than this, in rad, counts as on it: rounding.
const ROUNDING: f64 = 1e-9;

/// The most quarters that are counted either way.
const MOST_QUARTERS: f64 = 1e6;

/// `[cf1, cf4, cf6, cfx]` of an arm with six axes (rad) on a branch; none for branches that are not of such an arm, and for
/// axis values that are not angles.
#[must_use]
pub fn confdata(branch: Branch, axes: &AxisValues) -> Option<[i32; 4]> {
    let Branch::Arm {
        shoulder,
        elbow,
        wrist,
    } = branch
    else {
        return None;
    };
    let negative = match wrist {
        Wrist::Positive => 0,
        Wrist::Negative => 1,
    };
    let behind_lower_arm = match elbow {
        Elbow::Forward => 0,
        Elbow::Backward => 2,
    };
    let behind = match shoulder {
        Shoulder::Front => 0,
        Shoulder::Back => 4,
    };
    let [one, _, _, four, _, six] = axes.0.map(quarter);
    Some([one?, four?, six?, negative + behind_lower_arm + behind])
}

/// The quarter turn in which an angle is.
fn quarter(angle: f64) -> Option<i32> {
    let quarter = ((angle + ROUNDING) / FRAC_PI_2).floor();
    let is_counted = quarter.abs() <= MOST_QUARTERS;
    #[expect(clippy::cast_possible_truncation, reason = "an integer of at most a million")]
    is_counted.then_some(quarter as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn degrees(axes: [f64; 6]) -> AxisValues {
        AxisValues(axes.map(f64::to_radians))
    }

    const UP_FRONT: Branch = Branch::Arm {
        shoulder: Shoulder::Front,
        elbow: Elbow::Forward,
        wrist: Wrist::Positive,
    };

    /// The quarters as the RAPID reference lists them for a rotating axis.
    #[test]
    fn quarters_are_counted_up_from_0_and_down_from_minus_1() {
        for (angle, expected) in [
            (0.0, 0),
            (89.9, 0),
            (90.0, 1),
            (179.0, 1),
            (181.0, 2),
            (271.0, 3),
            (361.0, 4),
            (-0.1, -1),
            (-89.9, -1),
            (-90.1, -2),
            (-180.1, -3),
            (-361.0, -5),
        ] {
            let found = confdata(UP_FRONT, &degrees([angle, 0.0, 0.0, angle, 0.0, angle]));
            assert_eq!(found, Some([expected, expected, expected, 0]), "{angle}");
        }
    }

    #[test]
    fn every_way_has_a_cfx_of_its_own() {
        let mut found = Vec::new();
        for shoulder in [Shoulder::Front, Shoulder::Back] {
            for elbow in [Elbow::Forward, Elbow::Backward] {
                for wrist in [Wrist::Positive, Wrist::Negative] {
                    let branch = Branch::Arm {
                        shoulder,
                        elbow,
                        wrist,
                    };
                    found.extend(confdata(branch, &degrees([0.0; 6])).map(|[.., cfx]| cfx));
                }
            }
        }
        assert_eq!(found, [0, 1, 2, 3, 4, 5, 6, 7]);
    }

    #[test]
    fn no_confdata_without_an_angle_or_for_another_arm() {
        assert_eq!(confdata(UP_FRONT, &AxisValues([f64::NAN; 6])), None);
        assert_eq!(confdata(UP_FRONT, &AxisValues([f64::INFINITY; 6])), None);
        assert_eq!(confdata(Branch::Numbered(0), &degrees([0.0; 6])), None);
    }

    proptest! {
        /// An independent way of counting: as many steps of a quarter as it takes.
        #[test]
        fn quarters_count_steps(degrees_of_axis in -719.0..719.0_f64) {
            let mut steps = 0;
            let mut left = degrees_of_axis;
            while left >= 90.0 {
                left -= 90.0;
                steps += 1;
            }
            while left < 0.0 {
                left += 90.0;
                steps -= 1;
            }
            prop_assume!(left > 1e-6 && left < 90.0 - 1e-6);
            let found = confdata(UP_FRONT, &degrees([degrees_of_axis, 0.0, 0.0, 0.0, 0.0, 0.0]));
            prop_assert_eq!(found, Some([steps, 0, 0, 0]));
        }
    }
}
