//! How far an arm comes.

use super::Model;
use crate::kinematics::Joints;
use core::f64::consts::TAU;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Axis, AxisKind};

/// How many values of an axis a reach is looked for over.
const SAMPLES: u32 = 24;

impl Model {
    /// How far from its first axis the flange of an arm comes, in mm: the farthest of a grid over the two axes that stretch it.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let values = |place: usize| {
            let axis = self.axes.get(place);
            (0..=SAMPLES).filter_map(move |step| axis.map(|axis| at(axis, step)))
        };
        let mut farthest = 0.0_f64;
        for second in values(1) {
            for third in values(2) {
                let joints: Joints = core::array::from_fn(|place| match place {
                    1 => second,
                    2 => third,
                    _ => 0.0,
                });
                let flange = Frame::from(self.mechanism.flange_in_root(&joints));
                farthest = farthest.max(libm::hypot(flange.origin.x, flange.origin.y));
            }
        }
        farthest
    }
}

/// A value within an axis's range; ranges of several turns say nothing beyond one.
fn at(axis: &Axis, step: u32) -> f64 {
    let (least, most) = match axis.kind {
        AxisKind::Rotary => (axis.min.max(-TAU / 2.0), axis.max.min(TAU / 2.0)),
        AxisKind::Linear => (axis.min, axis.max),
    };
    least + (most - least) * f64::from(step) / f64::from(SAMPLES)
}
