//! Two paths of a tool over one blank, seen from the front, the right and above: that of a milling program, and that of the
//! V-cuts made of it [Cui fig. 12].
//!
//! The view is a parallel projection. Lines are drawn whole, also where the blank hides them.

pub use super::sheet::Heading;

use super::chart;
use super::palette::{BLUE, VERMILION};
use super::projection::{View, corners};
use super::scale::round_step;
use super::sheet::{self, Entry, Room, WIDTH};
use super::svg::{Anchor, Svg};
use super::trace::{Trace, number};

/// What is drawn, from plain numbers in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paths<'a> {
    /// Title and subtitle.
    pub heading: Heading<'a>,
    /// Width, depth and height of the blank, whose lowest corner is the origin.
    pub blank: [f64; 3],
    /// What the V-cuts leave of it, in the x-z plane from side to side.
    pub contour: &'a [[f64; 2]],
    /// The path of the milling tool, in pieces.
    pub milling: &'a [Vec<[f64; 3]>],
    /// The path of the blade's tip.
    pub cutting: &'a [[f64; 3]],
    /// The blade at the start of every flank: its tip and the end of its edge along the axis.
    pub blades: &'a [[[f64; 3]; 2]],
}

/// Lines thinner than this cannot be told apart; where there are more corners, no blades are drawn.
const MOST_BLADES: usize = 400;
/// Most corners of a path that are drawn.
const MOST_CORNERS: usize = 40_000;
/// The highest view.
const HIGHEST: f64 = 560.0;

const MILLING: &str = "fill=\"none\" stroke=\"#d55e00\" stroke-width=\"0.9\" stroke-linejoin=\"round\"";
const CUTTING: &str = "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.3\" stroke-linejoin=\"round\"";
const BLADE: &str = "fill=\"none\" stroke=\"#56b4e9\" stroke-width=\"1\"";
const REMAINS: &str = "fill=\"#e4dcc3\" stroke=\"#9c8a5c\" stroke-width=\"1\" stroke-linejoin=\"round\"";
const EDGES: &str = "fill=\"none\" stroke=\"#9c8a5c\" stroke-dasharray=\"4 4\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(paths: &Paths<'_>) -> String {
    let room = Room::of(paths.heading.ids).of_width(WIDTH);
    let milled = paths.milling.iter().flatten();
    let everything = milled
        .chain(paths.cutting)
        .chain(paths.blades.iter().flatten())
        .copied();
    let everything = || corners(paths.blank).into_iter().chain(everything.clone());
    let size = [room.across(), HIGHEST];
    let height = View::of(everything(), [room.left, 0.0], size).height;
    let bottom = room.top + height;
    let view = View::of(everything(), [room.left, bottom], size);
    let mut svg = sheet::sheet(
        paths.heading,
        room,
        &description(paths),
        bottom + 30.0,
        &legend(paths),
    );
    remains(&mut svg, paths, &view);
    if paths.blades.len() <= MOST_BLADES {
        let blades = paths.blades.iter().map(|blade| blade.map(|point| view.at(point)));
        svg.path(Trace::pieces(blades).text(), BLADE);
    }
    let at = |&point: &[f64; 3]| view.at(point);
    svg.open(paths.cutting.iter().take(MOST_CORNERS).map(at), CUTTING);
    let milling = paths
        .milling
        .iter()
        .map(|piece| piece.iter().take(MOST_CORNERS).map(at));
    svg.path(Trace::pieces(milling).text(), MILLING);
    names(&mut svg, paths, &view);
    let step = round_step(paths.blank[0] / (room.across() / 70.0).floor()).size;
    let words = format!("{} mm in x", number(step));
    chart::bar(&mut svg, [room.right, bottom + 20.0], view.along_x(step), &words);
    svg.finish()
}

/// What is left of the blank, and the edges of what it was.
fn remains(svg: &mut Svg, paths: &Paths<'_>, view: &View) {
    let [width, depth, height] = paths.blank;
    let face = |y: f64| {
        let surface = paths.contour.iter().map(move |&[x, z]| [x, y, z]);
        let outline = surface.chain([[width, y, 0.0], [0.0, y, 0.0]]);
        outline.map(|point| view.at(point)).collect::<Vec<_>>()
    };
    svg.closed(face(depth), REMAINS);
    let mut strips = Trace::default();
    for pair in paths.contour.windows(2) {
        if let [[x0, z0], [x1, z1]] = *pair {
            let strip = [[x0, 0.0, z0], [x1, 0.0, z1], [x1, depth, z1], [x0, depth, z0]];
            strips.closed(strip.map(|point| view.at(point)));
        }
    }
    svg.path(strips.text(), REMAINS);
    let last = paths.contour.last().map_or(height, |&[_, z]| z);
    let end = [[0.0, 0.0], [depth, 0.0], [depth, last], [0.0, last]].map(|[y, z]| view.at([width, y, z]));
    svg.closed(end, REMAINS);
    svg.closed(face(0.0), REMAINS);
    let corners = corners(paths.blank).map(|corner| view.at(corner));
    let mut edges = Trace::default();
    for front in [0, 2] {
        edges.closed([0, 1, 5, 4].map(|corner| corners[corner + front]));
    }
    for left in [0, 1, 5, 4] {
        edges.open([corners[left], corners[left + 2]]);
    }
    svg.path(edges.text(), EDGES);
}

/// The names of the axes at the blank.
fn names(svg: &mut Svg, paths: &Paths<'_>, view: &View) {
    let [width, depth, height] = paths.blank;
    let names = [
        ("x", [width / 2.0, 0.0, 0.0], [0.0, 18.0]),
        ("y", [width, depth / 2.0, 0.0], [14.0, 18.0]),
        ("z", [0.0, 0.0, height / 4.0], [-14.0, 5.0]),
    ];
    for (name, place, [aside, down]) in names {
        let [x, y] = view.at(place);
        let italic = "font-style=\"italic\"";
        svg.text([x + aside, y + down], Anchor::Middle, italic, name);
    }
}

fn legend(paths: &Paths<'_>) -> Vec<Entry> {
    let line = |colour| format!("stroke=\"{colour}\" stroke-width=\"2\"");
    vec![
        Entry::line(line(VERMILION), "milling program"),
        Entry::line(line(BLUE), "tip of the blade"),
        if paths.blades.len() <= MOST_BLADES {
            Entry::line(BLADE, "edge where a flank begins")
        } else {
            let words = format!("more than {MOST_BLADES} flanks: edges are not drawn");
            Entry::area("fill=\"none\"", words)
        },
        Entry::area("fill=\"#e4dcc3\" stroke=\"#9c8a5c\"", "what is left"),
    ]
}

fn description(paths: &Paths<'_>) -> String {
    let [width, depth, height] = paths.blank;
    let corners: usize = paths.milling.iter().map(Vec::len).sum();
    format!(
        "{}. A blank {width:.1} mm wide, {depth:.1} mm deep and {height:.1} mm high, seen from the front and above, with the \
         path of a milling program of {corners} points and the path of the blade's tip of {} points.",
        paths.heading.subtitle,
        paths.cutting.len()
    )
}
