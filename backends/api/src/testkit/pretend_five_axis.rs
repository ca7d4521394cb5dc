//! A pretend five-axis machine: a head with B carrying A, the arrangement that holds every posture of a V-cut.
//!
//! Axes X, Y, Z carry the point where the axes B and A meet, along x, y and z of the workpiece; the blade is [`ARM`] mm below
//! it and held as `Ry(B) Rx(A)` turns an upright blade that leads towards +y. So the tip is elsewhere than the axes say, as on
//! every real machine, and a backend that mixes the two up is found out.

use crate::geometry::{Frame, Orientation, Point3};
use crate::ir::{Axis, AxisKind, AxisValues};
use core::f64::consts::{FRAC_1_SQRT_2, PI};

/// From the point where B and A meet to the tip, in mm.
const ARM: f64 = 560.0;

/// The upright blade: x of T along +y, y along +x, z down.
const UPRIGHT: [f64; 4] = [0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0];

/// The axes of the machine, called X, Y, Z, B and A. Linear ones go as far as any dialect says.
#[must_use]
pub fn five_axes() -> Vec<Axis> {
    let axis = |name: &str, kind, far: f64, rate| Axis {
        name: name.to_owned(),
        kind,
        min: -far,
        max: far,
        rate: Some(rate),
        acceleration: None,
        jerk: None,
    };
    vec![
        axis("X", AxisKind::Linear, 200_000.0, 500.0),
        axis("Y", AxisKind::Linear, 200_000.0, 500.0),
        axis("Z", AxisKind::Linear, 200_000.0, 400.0),
        axis("B", AxisKind::Rotary, PI, 1.5),
        axis("A", AxisKind::Rotary, PI, 1.5),
    ]
}

/// The axes that hold the blade there.
pub(super) fn axes_at(tip: Point3, held: Orientation) -> AxisValues {
    let [out_x, out_y, out_z] = out_of_the_shank(held);
    let a = libm::atan2(out_y, libm::hypot(out_x, out_z));
    let b = libm::atan2(-out_x, -out_z);
    AxisValues([
        tip.x - ARM * out_x,
        tip.y - ARM * out_y,
        tip.z - ARM * out_z,
        b,
        a,
        0.0,
    ])
}

/// Where axis values of the machine hold the blade: frame T in the workpiece frame W.
pub(super) fn blade_in_work(axes: &AxisValues) -> Frame {
    let [x, y, z, b, a, _] = axes.0;
    let (sin_b, cos_b) = libm::sincos(b / 2.0);
    let (sin_a, cos_a) = libm::sincos(a / 2.0);
    // Ry(B) Rx(A).
    let [tw, tx, ty, tz] = [cos_b * cos_a, cos_b * sin_a, sin_b * cos_a, -sin_b * sin_a];
    let [uw, ux, uy, uz] = UPRIGHT;
    let orientation = Orientation::from_quaternion(
        tw * uw - tx * ux - ty * uy - tz * uz,
        tw * ux + tx * uw + ty * uz - tz * uy,
        tw * uy - tx * uz + ty * uw + tz * ux,
        tw * uz + tx * uy - ty * ux + tz * uw,
    )
    .unwrap_or(Orientation::IDENTITY);
    let [out_x, out_y, out_z] = out_of_the_shank(orientation);
    Frame {
        origin: Point3::new(x + ARM * out_x, y + ARM * out_y, z + ARM * out_z),
        orientation,
    }
}

/// z of the blade frame, seen from W.
fn out_of_the_shank(held: Orientation) -> [f64; 3] {
    held.matrix().map(|row| row[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The inverse is checked against turning about the axes one after the other.
        #[test]
        fn axes_and_poses_belong_together(
            tip in [-500.0..500.0_f64, -500.0..500.0, -500.0..500.0],
            b in -80.0..80.0_f64,
            a in -80.0..80.0_f64,
        ) {
            let (b, a) = (b.to_radians(), a.to_radians());
            let ((sin_b, cos_b), (sin_a, cos_a)) = (libm::sincos(b), libm::sincos(a));
            let axes = AxisValues([tip[0], tip[1], tip[2], b, a, 0.0]);
            let frame = blade_in_work(&axes);
            let out = out_of_the_shank(frame.orientation);
            // Ry(B) Rx(A) of the direction down.
            let expected = [-cos_a * sin_b, sin_a, -cos_a * cos_b];
            for (is, should) in out.into_iter().zip(expected) {
                prop_assert!((is - should).abs() < 1e-12);
            }
            for (is, should) in axes_at(frame.origin, frame.orientation).0.into_iter().zip(axes.0) {
                prop_assert!((is - should).abs() < 1e-9, "{is} {should}");
            }
        }
    }
}
