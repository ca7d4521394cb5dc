//! Equivalent tools as statements of APT: `CUTTER/d,r,e,f,alpha,beta,h`, which CATIA, NX and Vericut read.
//!
//! `d` is the diameter, `r` the radius of the corner, `e` and `f` the distance of the corner's centre from the axis and from the
//! tip, `alpha` the angle between the end and a plane square to the axis, `beta` that between the side and the axis, `h` the
//! height; lengths in mm, angles in deg. The end of a cone is its whole flank, as that of a drill: its sharp corner lies at the top.

use crate::{Equivalent, Solid};
use core::fmt::Write;
use vcutc_diagnostics::number::show;

/// The statement of a tool.
#[must_use]
pub fn cutter(solid: Solid) -> String {
    // In whole micrometres, as it is written: the diameter is twice what the corner is off the axis.
    let radius = (solid.radius().to_mm() * 1e3).round() / 1e3;
    let height = solid.height().to_mm();
    let (corner, end) = match solid {
        Solid::Cylinder { .. } => (0.0, 0.0),
        Solid::Cone { half_angle, .. } => (height, 90.0 - half_angle.to_deg()),
    };
    let numbers = [2.0 * radius, 0.0, radius, corner, end, 0.0, height];
    format!("CUTTER/{}", numbers.map(show).join(","))
}

/// The tools of a job, each with a comment.
#[must_use]
pub fn apt(job: &str, tools: &[Equivalent]) -> String {
    let mut text = format!("PARTNO {job}\nUNITS/MM\n");
    for tool in tools {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "$$ {}: stands for the blade {}, {}",
            tool.name,
            tool.blade,
            tool.role.source()
        );
        if let Some(note) = tool.role.note() {
            let _ = writeln!(text, "$$ {note}");
        }
        let _ = writeln!(text, "{}", cutter(tool.solid));
    }
    text.push_str("FINI\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::units::{Angle, Length};

    #[test]
    fn a_disc_crushes_up_to_its_depth() {
        let solid = Solid::Cylinder {
            radius: Length::mm(25.0),
            height: Length::mm(10.0),
        };
        assert_eq!(cutter(solid), "CUTTER/50,0,25,0,0,0,10");
    }

    /// From the tip the end rises by `alpha`, and meets the side at the corner: the angle and the corner say the same.
    #[test]
    fn a_cone_is_an_end_up_to_its_corner() {
        let solid = Solid::Cone {
            half_angle: Angle::deg(30.0),
            height: Length::mm(10.0),
        };
        assert_eq!(cutter(solid), "CUTTER/11.548,0,5.774,10,60,0,10");
        let rise = 5.773_502_7 * libm::tan(60_f64.to_radians());
        assert!((rise - 10.0).abs() < 1e-6);
    }
}
