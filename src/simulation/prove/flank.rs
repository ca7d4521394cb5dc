//! How the flanks of a straight blade lie.

use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Blade, Program, Straight, ToolId};
use vcutc_backend_api::units::Angle;
use vcutc_backend_api::verify::UPRIGHT;

/// How a posture's flank lies in the x-z plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlankGeometry {
    /// Rise over x; infinite for a wall.
    pub(super) slope: f64,
    /// Edge length per millimetre of height.
    pub(super) edge_per_height: f64,
}

/// How flanks lie in each of a program's orientations, cut with a blade; none with one that cuts no flanks.
pub(super) fn flanks(program: &Program, tool: ToolId) -> Vec<FlankGeometry> {
    let Some(blade) = program.blade(tool).and_then(Blade::straight) else {
        return Vec::new();
    };
    let orientations = program.orientations.iter();
    orientations.map(|held| flank(blade, *held)).collect()
}

fn flank(blade: Straight, held: Orientation) -> FlankGeometry {
    let m = held.matrix();
    // Tip to shank is -z_t: its slope in the x-z plane is the flank's, its angle to y the rake.
    let (x, y, z) = (-m[0][2], -m[1][2], -m[2][2]);
    let rake = Angle::rad(libm::acos(y.abs().min(1.0)));
    let cos_swing = z / libm::hypot(x, z);
    FlankGeometry {
        // Over a metre of height such a flank leans by a nanometre.
        slope: if x.abs() <= UPRIGHT {
            f64::INFINITY
        } else {
            z / x.abs()
        },
        edge_per_height: 1.0 / (cos_swing * (rake - blade.half_apex).sin()),
    }
}
