//! Tool frames that no mount gives: what can be known of how the blade is clamped without seeing it.
//!
//! Any turn of the blade about its own axis can be built, so nothing here judges which way edge and flat look: that is for people
//! to check in the hand, with the figure in `docs/language.md` and the lines at the head of every program. What is reported:
//!
//! - **A blade that points back at the flange.** The axis z of the frame leads from the shank out through the tip. Seen from the
//!   flange a tip lies out along it, or to the side of it where the holder is bent; it does not lie the other way, with the shank
//!   beyond the tip.
//! - **Radians with the unit of degrees.** `1.5708 deg` is a quarter turn in radians. Measured frames have such an angle to a
//!   ten-thousandth of a degree once in half a million.

use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{CheckedJob, Machine};

/// From here on the tip lies back along the frame's z axis: the cosine of 135 degrees. A holder bent by a right angle has about 0.
const BACK: f64 = -core::f64::consts::FRAC_1_SQRT_2;

/// How near to eighths of a turn in radians an angle in degrees may come before it is taken for one.
const SAME_DEGREES: f64 = 1e-4;

/// What is doubtful about the frame of the job's tool.
pub(super) fn doubts(job: &CheckedJob) -> Option<Diagnostic> {
    let machine = job.machine.as_ref()?;
    machine.tools.iter().find_map(|tool| {
        let frame = tool.frame.value.frame;
        let place = tool.frame.span.unwrap_or(job.name_span);
        back(place, machine, frame).or_else(|| radians(place, machine, frame))
    })
}

fn back(place: Span, machine: &Machine, frame: Frame) -> Option<Diagnostic> {
    let cosine = cosine(frame.origin, frame.orientation)?;
    (cosine < BACK).then(|| {
        Diagnostic::new(
            Code::ToolFrame,
            format!("the blade of `{}` points back at its flange", machine.name),
            place,
            "the z axis of this frame points from the tip towards the flange",
        )
        .note("z of a tool frame points from the shank out through the tip, so the shank would lie beyond the tip")
        .help("turn the frame by half a turn about its x axis, `c` by 180 deg, and look at the figure of `tool` in docs/language.md")
    })
}

/// Between the way from the flange to the tip and the frame's z axis; none for a tip in the flange.
fn cosine(tip: Point3, held: Orientation) -> Option<f64> {
    let m = held.matrix();
    let along = tip.x * m[0][2] + tip.y * m[1][2] + tip.z * m[2][2];
    let length = libm::sqrt(tip.x * tip.x + tip.y * tip.y + tip.z * tip.z);
    (length > 1.0).then(|| along / length)
}

fn radians(place: Span, machine: &Machine, frame: Frame) -> Option<Diagnostic> {
    let angles = frame.orientation.to_zyx();
    let named = [("a", angles.a), ("b", angles.b), ("c", angles.c)];
    named.into_iter().find_map(|(name, angle)| {
        let degrees = angle.to_deg();
        let meant = meant(degrees)?;
        Some(
            Diagnostic::new(
                Code::ToolFrame,
                format!(
                    "the tool of `{}` is turned by {degrees:.4} deg, which is {meant} deg in radians",
                    machine.name
                ),
                place,
                "this frame",
            )
            .help(format!("write `{name} = {meant} deg` if that is meant")),
        )
    })
}

/// The eighths of a turn whose radians these degrees are, in degrees.
fn meant(degrees: f64) -> Option<i32> {
    [45, 90, 135, 180]
        .into_iter()
        .flat_map(|eighths| [eighths, -eighths])
        .find(|&whole| {
            let radians = f64::from(whole).to_radians();
            (degrees - radians).abs() < SAME_DEGREES
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::geometry::Zyx;
    use vcutc_backend_api::units::Angle;

    fn turned(a: f64, b: f64, c: f64) -> Orientation {
        let [a, b, c] = [a, b, c].map(Angle::deg);
        Orientation::from_zyx(Zyx { a, b, c })
    }

    #[test]
    fn straight_and_bent_holders_do_not_point_back() {
        let tip = Point3::new(0.0, 0.0, 310.0);
        for a in [0.0, 37.0, 90.0, 180.0] {
            assert!(cosine(tip, turned(a, 0.0, 0.0)).unwrap() > 0.99);
        }
        // Bent by a right angle, the tip a little behind the middle of the flange.
        let bent = cosine(Point3::new(-10.0, 0.0, 150.0), turned(0.0, 90.0, 0.0)).unwrap();
        assert!(bent < 0.0 && bent > BACK, "{bent}");
    }

    #[test]
    fn a_frame_turned_upside_down_points_back() {
        let tip = Point3::new(12.0, -3.0, 310.0);
        assert!(cosine(tip, turned(0.0, 0.0, 180.0)).unwrap() < BACK);
        assert!(cosine(tip, turned(30.0, 180.0, 0.0)).unwrap() < BACK);
        // A tip in the flange says nothing.
        assert_eq!(cosine(Point3::new(0.0, 0.0, 0.0), turned(0.0, 0.0, 180.0)), None);
    }

    #[test]
    #[expect(clippy::approx_constant, reason = "as people round them")]
    fn radians_are_known_by_their_digits() {
        for (degrees, whole) in [
            (1.5708, Some(90)),
            (-1.570_796_3, Some(-90)),
            (3.1416, Some(180)),
            (0.7854, Some(45)),
            (1.57, None),
            (90.0, None),
            (0.0, None),
            (1.5712, None),
        ] {
            assert_eq!(meant(degrees), whole, "{degrees}");
        }
    }
}
