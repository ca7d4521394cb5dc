//! Turns against quaternions.

use super::{Axis, Turn};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use vcutc_geometry::number::Interval;

const OWN: [DVec3; 6] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
];

proptest! {
    #[test]
    fn vectors_turn_as_quaternions_turn_them(
        angle in -7.0..7.0,
        vector in prop::array::uniform3(-2.0..2.0),
        askew in prop::array::uniform3(0.1..1.0),
    ) {
        let askew = DVec3::from_array(askew).normalize();
        for direction in OWN.into_iter().chain([askew, -askew]) {
            let (axis, turn) = (Axis::new(direction), Turn::by(angle));
            let quaternion = DQuat::from_axis_angle(direction, angle);
            let out = quaternion * DVec3::from_array(vector);
            let back = quaternion.inverse() * DVec3::from_array(vector);
            for (found, wanted) in [
                (turn.out(axis, vector), out),
                (turn.back(axis, vector), back),
                (turn.back_plain(axis, vector), back),
            ] {
                prop_assert!((DVec3::from_array(found) - wanted).length() < 1e-14, "{direction}");
            }
            // Enclosures hold it.
            let enclosed = Turn { sine: Interval::exactly(turn.sine), cosine: Interval::exactly(turn.cosine) };
            for found in [enclosed.back(axis, vector.map(Interval::exactly)), enclosed.back_plain(axis, vector)] {
                for (found, wanted) in found.into_iter().zip(back.to_array()) {
                    prop_assert!(found.low - 1e-14 <= wanted && wanted <= found.high + 1e-14);
                }
            }
        }
    }
}
