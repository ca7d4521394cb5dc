//! Whether the tool stands upright all along: a milling tool that leans by itself leaves no V to be cut in its place.
//!
//! Which of the tool's axes it turns about is not said in the program, and turns about it mean nothing for milling. So one of
//! its three axes has to be upright, and stay so: between two passes the tool may only turn about the way up.

use super::axes::{Axis, Direction, Sense};
use super::complaints;
use super::milling::{Milling, Move};
use super::runs::{Kind, stretches};
use super::types::SAME;
use super::{Axes, Blank};
use vcutc_backend_api::geometry::Orientation;
use vcutc_diagnostics::Diagnostic;

/// Cosine of the largest lean that is taken for rounding: a tenth of a degree.
const UPRIGHT: f64 = 1.0 - 1.5e-6;

/// The first motion below the blank's top with a tool that leans, and where it last stood upright.
pub(super) fn leaning(milling: &Milling, axes: Axes, blank: Blank, tolerance: f64) -> Option<Diagnostic> {
    let top = blank.corner[2] + blank.height - SAME;
    let mut upright: Option<(&Move, UprightAxis)> = None;
    let below = stretches(milling, axes, tolerance)
        .filter(|stretch| stretch.lowest() < top && stretch.kind == Kind::Along);
    for stretch in below {
        let said = stretch.said;
        let Some(attitude) = said.attitude else { continue };
        match (upright_axis(attitude, axes.up), upright) {
            (None, earlier) => {
                return Some(complaints::leans(
                    said.place,
                    earlier.map(|(earlier, _)| earlier.place),
                ));
            }
            (Some(found), Some((earlier, known))) if found != known => {
                return Some(complaints::leans(said.place, Some(earlier.place)));
            }
            (Some(found), _) => upright = Some((said, found)),
        }
    }
    None
}

/// The axis of the tool that points up or down.
#[derive(Clone, Copy, PartialEq, Eq)]
struct UprightAxis {
    axis: Axis,
    sense: Sense,
}

fn upright_axis(attitude: Orientation, up: Direction) -> Option<UprightAxis> {
    let [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]] = attitude.matrix();
    let tool = [
        (Axis::X, [xx, xy, xz]),
        (Axis::Y, [yx, yy, yz]),
        (Axis::Z, [zx, zy, zz]),
    ];
    tool.into_iter().find_map(|(axis, direction)| {
        let rise = up.of(direction);
        let sense = if rise > 0.0 {
            Sense::Positive
        } else {
            Sense::Negative
        };
        (rise.abs() > UPRIGHT).then_some(UprightAxis { axis, sense })
    })
}
