//! The blade in the hand: shank, edge, flat and the axes of its frame, from the side and against the feed.
//!
//! Both views show the blade over the work at swing 0, leaning along the feed by its rake. From the side (from +x of the work, so
//! that +y runs to the right) the blade is seen in its plane; against the feed (from -y, so that +x runs to the right) it is seen
//! on edge, and beside it, dashed, as the swing leans it for the two flanks. `docs/process.md` has the formulas.

use super::Setting;
use super::palette::{BLUE, GREEN, INK, VERMILION};
use super::sheet::{HALO, PHONE_WIDTH, WIDTH};
use super::svg::{Anchor, Svg, number};
use super::trace::Trace;

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
    /// What the side of the blade away from `x_t` is.
    pub back: Back,
}

/// The side of the blade that does not lead on a feed along +y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Back {
    /// An edge too.
    Edge,
    Blunt,
}

/// Where the two views are.
struct Layout {
    size: [f64; 2],
    /// Where the tip is, seen from the side.
    side: [f64; 2],
    /// Where it is, seen against the feed.
    front: [f64; 2],
}

impl Layout {
    /// Beside each other, or one below the other on a telephone. A page has the words that stand above the views elsewhere.
    const fn of(setting: Setting) -> Self {
        const HEADING: f64 = 60.0;
        match setting {
            Setting::Alone => Self {
                size: [WIDTH, 445.0],
                side: [190.0, 330.0],
                front: [540.0, 330.0],
            },
            Setting::Page => Self {
                size: [WIDTH, 445.0 - HEADING],
                side: [190.0, 330.0 - HEADING],
                front: [540.0, 330.0 - HEADING],
            },
            Setting::Phone => Self {
                size: [PHONE_WIDTH, 765.0],
                side: [158.0, 270.0],
                front: [200.0, 650.0],
            },
        }
    }
}

/// Length of the edge, of the whole blade, and of the blade with its shank.
const EDGE: f64 = 110.0;
const BODY: f64 = 150.0;
const WHOLE: f64 = 235.0;
/// Length of an axis.
const AXIS: f64 = 62.0;
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

#[must_use]
pub fn draw(blade: &Blade<'_>) -> String {
    let description = "Two views of the blade over the work. From the side: the shank above, the tip below, the tool axis z from \
                       the shank out through the tip, x in the blade's plane towards the edge that leads when the feed is along \
                       plus y. Against the feed: y square to the flat, along plus x of the work.";
    let layout = Layout::of(blade.heading.ids.setting);
    let mut svg = Svg::new(
        layout.size,
        15,
        blade.heading.ids,
        blade.heading.title,
        description,
    );
    match blade.heading.ids.setting {
        Setting::Alone => words(&mut svg, blade.heading),
        Setting::Page | Setting::Phone => {}
    }
    side(&mut svg, blade, layout.side);
    front(&mut svg, blade, layout.front);
    svg.finish()
}

fn words(svg: &mut Svg, heading: Heading<'_>) {
    let bold = "font-size=\"18\" font-weight=\"bold\"";
    svg.text((24.0, 32.0), Anchor::Start, bold, heading.title);
    svg.text((24.0, 56.0), Anchor::Start, "font-size=\"14\"", heading.subtitle);
}

fn side(svg: &mut Svg, blade: &Blade<'_>, tip: [f64; 2]) {
    let [x, z] = axes(blade.rake);
    // A place in the blade's plane: along x_t, and from the tip towards the shank.
    let at = |across: f64, up: f64| {
        [
            tip[0] + across * x[0] - up * z[0],
            tip[1] - (across * x[1] - up * z[1]),
        ]
    };
    ground(svg, tip, [tip[0] - 130.0, tip[0] + 210.0]);
    let half = EDGE * libm::tan(blade.half_apex.max(NARROWEST));
    let shank = half.min(HALF_SHANK);
    let body = [
        at(0.0, 0.0),
        at(half, EDGE),
        at(half, BODY),
        at(-half, BODY),
        at(-half, EDGE),
    ];
    closed(svg, &body, "fill=\"#dfe7ee\" stroke=\"#2b2a27\"");
    let held = [
        at(shank, BODY),
        at(shank, WHOLE),
        at(-shank, WHOLE),
        at(-shank, BODY),
    ];
    closed(svg, &held, "fill=\"#b9b3a3\" stroke=\"#2b2a27\"");
    let edge = format!("stroke=\"{VERMILION}\" stroke-width=\"4\" stroke-linecap=\"round\" fill=\"none\"");
    line(svg, at(0.0, 0.0), at(half, EDGE), &edge);
    let words = match blade.back {
        Back::Edge => {
            line(svg, at(0.0, 0.0), at(-half, EDGE), &edge);
            "edge for -y"
        }
        Back::Blunt => "blunt back",
    };
    arrow(svg, tip, at(AXIS, 0.0), VERMILION);
    arrow(svg, tip, at(0.0, -AXIS), BLUE);
    towards_the_eye(svg, tip);
    label(svg, at(AXIS + 10.0, 0.0), Anchor::Start, "tool x");
    label(svg, at(6.0, -AXIS - 12.0), Anchor::Start, "tool z");
    label(svg, [tip[0] - 32.0, tip[1] + 22.0], Anchor::End, "tool y, to you");
    label(svg, at(half + 10.0, EDGE * 0.75), Anchor::Start, "leading edge");
    label(svg, at(-half - 4.0, EDGE * 0.7), Anchor::End, words);
    label(svg, at(-half - 10.0, BODY), Anchor::End, "flat, to you");
    label(svg, at(shank + 10.0, WHOLE - 20.0), Anchor::Start, "shank");
    rake(svg, blade.rake, tip);
    let under = tip[1] + 96.0;
    svg.text(
        (tip[0], under),
        Anchor::Middle,
        "font-weight=\"bold\"",
        "from the side, +y to the right",
    );
}

/// The angle between the feed and the shank, beyond the tip of the x axis.
fn rake(svg: &mut Svg, rake: f64, [x, y]: [f64; 2]) {
    let radius = 44.0;
    let end = [x + radius * libm::cos(rake), y - radius * libm::sin(rake)];
    let path = format!(
        "M{} {}A{radius} {radius} 0 0 0 {} {}",
        number(x + radius),
        number(y),
        number(end[0]),
        number(end[1])
    );
    svg.path(&path, &format!("stroke=\"{INK}\" fill=\"none\""));
    let half = rake / 2.0;
    let words = format!("rake {}\u{b0}", number(rake.to_degrees()));
    label(
        svg,
        [x + 54.0 * libm::cos(half), y - 50.0 * libm::sin(half)],
        Anchor::Start,
        &words,
    );
    arrow(svg, [x + 140.0, y - 14.0], [x + 196.0, y - 14.0], INK);
    label(svg, [x + 140.0, y - 34.0], Anchor::Start, "feed +y");
}

fn front(svg: &mut Svg, blade: &Blade<'_>, tip: [f64; 2]) {
    // Seen against the feed a blade that leans along it is shorter.
    let short = libm::sin(blade.rake);
    ground(svg, tip, [tip[0] - 100.0, tip[0] + 110.0]);
    for lean in [-SHOWN_SWING, SHOWN_SWING] {
        on_edge(
            svg,
            short,
            lean,
            tip,
            "fill=\"none\" stroke=\"#8a857a\" stroke-dasharray=\"5 4\"",
        );
    }
    on_edge(svg, short, 0.0, tip, "fill=\"#dfe7ee\" stroke=\"#2b2a27\"");
    arrow(svg, tip, [tip[0] + AXIS, tip[1]], GREEN);
    arrow(svg, tip, [tip[0], tip[1] + AXIS * short], BLUE);
    label(svg, [tip[0] + AXIS + 8.0, tip[1] - 14.0], Anchor::Start, "tool y");
    label(
        svg,
        [tip[0] + 8.0, tip[1] + AXIS * short + 4.0],
        Anchor::Start,
        "tool z",
    );
    let top = tip[1] - WHOLE * short;
    label(
        svg,
        [tip[0] - 12.0, top - 6.0],
        Anchor::End,
        "left flank: swing -",
    );
    label(svg, [tip[0] + 12.0, top - 6.0], Anchor::Start, "right flank: +");
    let under = tip[1] + 96.0;
    svg.text(
        (tip[0], under),
        Anchor::Middle,
        "font-weight=\"bold\"",
        "from -y, +x to the right",
    );
}

/// The blade on edge, leaning to the right by that angle.
fn on_edge(svg: &mut Svg, short: f64, lean: f64, tip: [f64; 2], paint: &str) {
    let (sine, cosine) = (libm::sin(lean), libm::cos(lean));
    let at = |across: f64, up: f64| {
        let up = up * short;
        [
            tip[0] + across * cosine + up * sine,
            tip[1] + across * sine - up * cosine,
        ]
    };
    let (thin, wide) = (HALF_THICKNESS, HALF_SHANK * 0.7);
    let outline = [
        at(-thin, 0.0),
        at(thin, 0.0),
        at(thin, BODY),
        at(wide, BODY),
        at(wide, WHOLE),
        at(-wide, WHOLE),
        at(-wide, BODY),
        at(-thin, BODY),
    ];
    closed(svg, &outline, paint);
}

/// The work under the tip.
fn ground(svg: &mut Svg, [_, y]: [f64; 2], [left, right]: [f64; 2]) {
    svg.rect([left, y, right - left, 8.0], "fill=\"#e9e6df\"");
    line(svg, [left, y], [right, y], "stroke=\"#b9b3a3\" fill=\"none\"");
}

fn closed(svg: &mut Svg, points: &[[f64; 2]], paint: &str) {
    let mut trace = Trace::default();
    trace.closed(points.iter().copied());
    svg.path(trace.text(), paint);
}

fn line(svg: &mut Svg, from: [f64; 2], to: [f64; 2], paint: &str) {
    let [a, b, c, d] = [from[0], from[1], to[0], to[1]].map(number);
    svg.path(&format!("M{a} {b}L{c} {d}"), paint);
}

fn arrow(svg: &mut Svg, from: [f64; 2], to: [f64; 2], colour: &str) {
    line(
        svg,
        from,
        to,
        &format!("stroke=\"{colour}\" stroke-width=\"3\" fill=\"none\""),
    );
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
    let (x, y) = (x / length, y / length);
    let corner = |along: f64, across: f64| [to[0] + along * x - across * y, to[1] + along * y + across * x];
    closed(
        svg,
        &[corner(9.0, 0.0), corner(-4.0, 6.0), corner(-4.0, -6.0)],
        &format!("fill=\"{colour}\""),
    );
}

/// An axis that points out of the picture.
fn towards_the_eye(svg: &mut Svg, [x, y]: [f64; 2]) {
    let (x, y) = (number(x), number(y));
    svg.line(&format!(
        "  <circle cx=\"{x}\" cy=\"{y}\" r=\"8\" fill=\"#fbfaf7\" stroke=\"{GREEN}\" stroke-width=\"3\"/>"
    ));
    svg.line(&format!(
        "  <circle cx=\"{x}\" cy=\"{y}\" r=\"2.5\" fill=\"{GREEN}\"/>"
    ));
}

fn label(svg: &mut Svg, [x, y]: [f64; 2], anchor: Anchor, words: &str) {
    svg.text((x, y + 5.0), anchor, HALO, words);
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::ir::{Edges, Flank};
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
