//! The blade in the hand: shank, edge, flat and the axes of its frame, from the side and against the feed.
//!
//! Both views show the blade over the work at swing 0, leaning along the feed by its rake. From the side (from +x of the work, so
//! that +y runs to the right) the blade is seen in its plane; against the feed (from -y, so that +x runs to the right) it is seen
//! on edge, and beside it, dashed, as the swing leans it for the two flanks. `docs/process.md` has the formulas.

use super::chart::FRAME;
use super::palette::{BLUE, GREEN, INK, VERMILION};
use super::sheet::{self, HALO, PHONE_WIDTH, WIDTH};
use super::svg::{Anchor, Svg};
use super::trace::number;
use super::{Point, Setting};
use vcutc_backend_api::ir::Edges;

pub use super::sheet::Heading;

/// A blade, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blade<'a> {
    /// What the picture says of itself.
    pub heading: Heading<'a>,
    /// Angle between tool axis and feed.
    pub rake: f64,
    /// Half the angle of the apex.
    pub half_apex: f64,
    /// On which sides it cuts: `x_t` points to the one that leads on a feed along +y.
    pub edges: Edges,
}

/// Length of the edge, of the whole blade, and of the blade with its shank.
const EDGE: f64 = 110.0;
const BODY: f64 = 150.0;
const WHOLE: f64 = 235.0;
/// Length of an axis.
const AXIS: f64 = 70.0;
/// Half the thickness of the blade on edge, and half the width of its shank.
const HALF_THICKNESS: f64 = 3.0;
const HALF_SHANK: f64 = 9.0;
/// The lean of the dashed blades: any swing will do.
const SHOWN_SWING: f64 = 30.0 * core::f64::consts::PI / 180.0;
/// The narrowest blade that can be seen, in rad.
const NARROWEST: f64 = 0.09;

/// The axes `x_t` and `z_t` at swing 0, on a feed along +y, as (y, z) of the work; `y_t` is (0, 0), as it points along +x.
fn axes(rake: f64) -> [[f64; 2]; 2] {
    let (sine, cosine) = (libm::sin(rake), libm::cos(rake));
    [[sine, -cosine], [-cosine, -sine]]
}

/// Draws it.
#[must_use]
pub fn draw(blade: &Blade<'_>) -> String {
    let description = "Two views of the blade over the work. From the side: the shank above, the tip below, the tool axis z from \
                       the shank out through the tip, x in the blade's plane towards the edge that leads when the feed is along \
                       plus y. Against the feed: y square to the flat, along plus x of the work.";
    let heading = blade.heading;
    // The size, and where the tips are: beside each other, or one below the other on a telephone. A page has the words that stand
    // above the views elsewhere.
    let (size, side_tip, front_tip) = match heading.ids.setting {
        Setting::Alone => ([WIDTH, 445.0], [190.0, 330.0], [540.0, 330.0]),
        Setting::Page => ([WIDTH, 385.0], [190.0, 270.0], [540.0, 270.0]),
        Setting::Phone => ([PHONE_WIDTH, 765.0], [158.0, 270.0], [200.0, 650.0]),
    };
    let mut svg = Svg::new(size, 15, heading.ids, heading.title, description);
    sheet::words(&mut svg, heading);
    side(&mut svg, blade, side_tip);
    front(&mut svg, blade, front_tip);
    svg.finish()
}

const FLAT: &str = "fill=\"#dfe7ee\" stroke=\"#2b2a27\"";
const SHANK: &str = "fill=\"#b9b3a3\" stroke=\"#2b2a27\"";
const SHARP: &str = "stroke=\"#d55e00\" stroke-width=\"4\" stroke-linecap=\"round\" fill=\"none\"";
const LEANT: &str = "fill=\"none\" stroke=\"#8a857a\" stroke-dasharray=\"5 4\"";

fn side(svg: &mut Svg, blade: &Blade<'_>, tip: Point) {
    let [x, z] = axes(blade.rake);
    // A place in the blade's plane: along x_t, and from the tip towards the shank.
    let at = |across: f64, up: f64| {
        [
            tip[0] + across * x[0] - up * z[0],
            tip[1] - (across * x[1] - up * z[1]),
        ]
    };
    let across =
        |half: f64, from: f64, to: f64| [at(half, from), at(half, to), at(-half, to), at(-half, from)];
    ground(svg, tip, [tip[0] - 130.0, tip[0] + 210.0]);
    let half = EDGE * libm::tan(blade.half_apex.max(NARROWEST));
    let shank = half.min(HALF_SHANK);
    svg.closed([tip].into_iter().chain(across(half, EDGE, BODY)), FLAT);
    svg.closed(across(shank, BODY, WHOLE), SHANK);
    svg.open([tip, at(half, EDGE)], SHARP);
    let back = match blade.edges {
        Edges::Double => {
            svg.open([tip, at(-half, EDGE)], SHARP);
            "edge for -y"
        }
        Edges::Single => "blunt back",
    };
    svg.arrow(tip, at(AXIS, 0.0), VERMILION);
    svg.arrow(tip, at(0.0, -AXIS), BLUE);
    svg.towards_the_eye(tip, GREEN);
    let words = [
        (at(AXIS + 3.0, 0.0), Anchor::Start, "tool x"),
        (at(6.0, -AXIS - 5.0), Anchor::Start, "tool z"),
        ([tip[0] - 32.0, tip[1] + 22.0], Anchor::End, "tool y, to you"),
        (at(half + 10.0, EDGE * 0.75), Anchor::Start, "leading edge"),
        (at(-half - 4.0, EDGE * 0.7), Anchor::End, back),
        (at(-half - 10.0, BODY), Anchor::End, "flat, to you"),
        (at(shank + 10.0, WHOLE - 20.0), Anchor::Start, "shank"),
    ];
    for (place, anchor, words) in words {
        label(svg, place, anchor, words);
    }
    rake(svg, blade.rake, tip);
    caption(svg, tip, "from the side, +y to the right");
}

/// The angle between the feed and the shank, beyond the tip of the x axis.
fn rake(svg: &mut Svg, rake: f64, [x, y]: Point) {
    let radius = 44.0;
    let towards =
        |angle: f64, [across, up]: [f64; 2]| [x + across * libm::cos(angle), y - up * libm::sin(angle)];
    let [from, to] = [0.0, rake].map(|angle| towards(angle, [radius; 2]).map(number));
    let arc = format!(
        "M{} {}A{radius} {radius} 0 0 0 {} {}",
        from[0], from[1], to[0], to[1]
    );
    svg.path(&arc, FRAME);
    let words = format!("rake {}\u{b0}", number(rake.to_degrees()));
    label(svg, towards(rake / 2.0, [54.0, 50.0]), Anchor::Start, &words);
    svg.arrow([x + 140.0, y - 14.0], [x + 205.0, y - 14.0], INK);
    label(svg, [x + 140.0, y - 34.0], Anchor::Start, "feed +y");
}

fn front(svg: &mut Svg, blade: &Blade<'_>, tip: Point) {
    // Seen against the feed a blade that leans along it is shorter.
    let short = libm::sin(blade.rake);
    ground(svg, tip, [tip[0] - 100.0, tip[0] + 110.0]);
    for (lean, paint) in [(-SHOWN_SWING, LEANT), (SHOWN_SWING, LEANT), (0.0, FLAT)] {
        on_edge(svg, short, lean, tip, paint);
    }
    let at = |right: f64, up: f64| [tip[0] + right, tip[1] - up];
    svg.arrow(tip, at(AXIS, 0.0), GREEN);
    svg.arrow(tip, at(0.0, -AXIS * short), BLUE);
    let top = WHOLE * short + 6.0;
    let words = [
        (at(AXIS + 1.0, 14.0), Anchor::Start, "tool y"),
        (at(8.0, 5.0 - AXIS * short), Anchor::Start, "tool z"),
        (at(-12.0, top), Anchor::End, "left flank: swing -"),
        (at(12.0, top), Anchor::Start, "right flank: +"),
    ];
    for (place, anchor, words) in words {
        label(svg, place, anchor, words);
    }
    caption(svg, tip, "from -y, +x to the right");
}

/// The blade on edge, leaning to the right by that angle.
fn on_edge(svg: &mut Svg, short: f64, lean: f64, tip: Point, paint: &str) {
    let (sine, cosine) = (libm::sin(lean), libm::cos(lean));
    let at = |[across, up]: [f64; 2]| {
        let up = up * short;
        [
            tip[0] + across * cosine + up * sine,
            tip[1] + across * sine - up * cosine,
        ]
    };
    let (thin, wide) = (HALF_THICKNESS, HALF_SHANK * 0.7);
    let right = [[thin, 0.0], [thin, BODY], [wide, BODY], [wide, WHOLE]];
    let left = right.into_iter().rev().map(|[across, up]| [-across, up]);
    svg.closed(right.into_iter().chain(left).map(at), paint);
}

/// The work under the tip.
fn ground(svg: &mut Svg, [_, y]: Point, [left, right]: [f64; 2]) {
    svg.rect([left, y, right - left, 8.0], "fill=\"#e9e6df\"");
    svg.open([[left, y], [right, y]], "stroke=\"#b9b3a3\" fill=\"none\"");
}

fn label(svg: &mut Svg, [x, y]: Point, anchor: Anchor, words: &str) {
    svg.text([x, y + 5.0], anchor, HALO, words);
}

/// What a view is, below it.
fn caption(svg: &mut Svg, [x, y]: Point, words: &str) {
    svg.text([x, y + 96.0], Anchor::Middle, "font-weight=\"bold\"", words);
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::ir::Flank;
    use vcutc_backend_api::units::Angle;
    use vcutc_process::posture::{Feed, Holder};

    /// The axes as the program holds the blade, by quaternions.
    #[test]
    fn the_axes_are_those_of_the_program() {
        for rake in [20.0, 60.0, 90.0] {
            let holder = Holder {
                swing: Angle::ZERO,
                rake: Angle::deg(rake),
                edges: Edges::Double,
            };
            let held = holder.cutting(Flank::Right, Feed::Forward).matrix();
            let [x, z] = axes(f64::to_radians(rake));
            let drawn = [[0.0, x[0], x[1]], [1.0, 0.0, 0.0], [0.0, z[0], z[1]]];
            for (column, axis) in drawn.iter().enumerate() {
                for (row, value) in axis.iter().enumerate() {
                    assert!((held[row][column] - value).abs() < 1e-12, "{rake} {row} {column}");
                }
            }
        }
    }
}
