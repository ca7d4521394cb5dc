//! The machines that come with the compiler, by name.

use super::Model;
use crate::kinematics::opw::{Coupling, Opw};
use crate::kinematics::{Joints, Mechanism};
use core::f64::consts::FRAC_PI_2;
use vcutc_backend_api::ir::{Axis, AxisKind, Maker};

/// The machine of that name.
#[must_use]
pub fn find(name: &str) -> Option<Model> {
    (name == "kuka/kr210_r3100_ultra").then(|| Model {
        name: name.to_owned(),
        maker: Maker::Kuka,
        axes: axes(
            [
                (-185.0, 185.0),
                (-140.0, -5.0),
                (-120.0, 155.0),
                (-350.0, 350.0),
                (-122.5, 122.5),
                (-350.0, 350.0),
            ],
            [105.0, 101.0, 107.0, 136.0, 129.0, 206.0],
        ),
        mechanism: Mechanism::OrthoParallel(Opw {
            a1: 350.0,
            a2: 41.0,
            b: 0.0,
            c1: 675.0,
            c2: 1350.0,
            c3: 1400.0,
            c4: 240.0,
            offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
            signs: [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
            coupling: Coupling::Serial,
        }),
    })
}

fn axes(limits: [(f64, f64); 6], rates: Joints) -> Vec<Axis> {
    (1..)
        .zip(limits.into_iter().zip(rates))
        .map(|(number, ((min, max), rate))| Axis {
            name: format!("A{number}"),
            kind: AxisKind::Rotary,
            min: f64::to_radians(min),
            max: f64::to_radians(max),
            rate: Some(rate.to_radians()),
            acceleration: None,
        })
        .collect()
}
