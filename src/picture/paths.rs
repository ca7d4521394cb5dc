//! Two paths of a tool over one blank, seen from the front, the right and above: that of a milling program, and that of the
//! V-cuts made of it [Cui fig. 12].
//!
//! The view is a parallel projection. Lines are drawn whole, also where the blank hides them.

pub use super::sheet::Heading;

use super::palette::{BLUE, INK, VERMILION};
use super::section::most_ticks;
use super::sheet::{self, Entry, LEFT, RIGHT, Room, TOP, WIDTH};
use super::svg::{Anchor, Svg, number};
use super::trace::Trace;

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
    let view = View::of(paths);
    let legend = legend(paths);
    let mut svg = sheet::sheet(
        paths.heading,
        Room::of(paths.heading.ids).of_width(WIDTH),
        &description(paths),
        view.bottom + 30.0,
        &legend,
    );
    remains(&mut svg, paths, &view);
    let mut blades = Trace::default();
    if paths.blades.len() <= MOST_BLADES {
        for blade in paths.blades {
            blades.open(blade.map(|point| view.at(point)));
        }
    }
    if !blades.is_empty() {
        svg.path(blades.text(), BLADE);
    }
    let cutting = paths.cutting.iter().take(MOST_CORNERS);
    svg.path(
        Trace::through(cutting.map(|&point| view.at(point))).text(),
        CUTTING,
    );
    let mut milling = Trace::default();
    for piece in paths.milling {
        milling.open(piece.iter().take(MOST_CORNERS).map(|&point| view.at(point)));
    }
    svg.path(milling.text(), MILLING);
    bar(&mut svg, paths, &view);
    svg.finish()
}

/// A parallel projection onto the sheet.
struct View {
    scale: f64,
    /// Where the least coordinates of the projection are.
    least: [f64; 2],
    bottom: f64,
}

/// The right of the view in the axes of the blank: turned by 30 deg from x towards y.
const RIGHTWARDS: [f64; 3] = [0.866_025, 0.5, 0.0];
/// The up of the view: 25 deg from above the level.
const UPWARDS: [f64; 3] = [-0.211_309, 0.366_000, 0.906_308];

fn projected(point: [f64; 3]) -> [f64; 2] {
    let along = |axis: [f64; 3]| axis.iter().zip(point).map(|(axis, value)| axis * value).sum();
    [along(RIGHTWARDS), along(UPWARDS)]
}

impl View {
    /// The largest view in which everything is seen.
    fn of(paths: &Paths<'_>) -> Self {
        let [width, depth, height] = paths.blank;
        let corners = [0.0, width].into_iter().flat_map(|x| {
            [0.0, depth]
                .into_iter()
                .flat_map(move |y| [0.0, height].map(|z| [x, y, z]))
        });
        let all = corners
            .chain(paths.milling.iter().flatten().copied())
            .chain(paths.cutting.iter().copied())
            .chain(paths.blades.iter().flatten().copied());
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in all.map(projected) {
            for ((least, most), value) in least.iter_mut().zip(&mut most).zip(place) {
                *least = least.min(value);
                *most = most.max(value);
            }
        }
        let size = [most[0] - least[0], most[1] - least[1]];
        let scale = ((RIGHT - LEFT) / size[0]).min(HIGHEST / size[1]);
        Self {
            scale,
            least,
            bottom: TOP + size[1] * scale,
        }
    }

    fn at(&self, point: [f64; 3]) -> [f64; 2] {
        let [right, up] = projected(point);
        [
            LEFT + (right - self.least[0]) * self.scale,
            self.bottom - (up - self.least[1]) * self.scale,
        ]
    }
}

/// What is left of the blank, and the edges of what it was.
fn remains(svg: &mut Svg, paths: &Paths<'_>, view: &View) {
    let [width, depth, height] = paths.blank;
    let face = |y: f64| {
        let ends = [[width, y, 0.0], [0.0, y, 0.0]];
        let surface = paths.contour.iter().map(move |&[x, z]| [x, y, z]);
        surface.chain(ends)
    };
    let mut back = Trace::default();
    back.closed(face(depth).map(|point| view.at(point)));
    svg.path(back.text(), REMAINS);
    let mut side = Trace::default();
    for pair in paths.contour.windows(2) {
        if let [[x0, z0], [x1, z1]] = *pair {
            let strip = [[x0, 0.0, z0], [x1, 0.0, z1], [x1, depth, z1], [x0, depth, z0]];
            side.closed(strip.map(|point| view.at(point)));
        }
    }
    svg.path(side.text(), REMAINS);
    let last = paths.contour.last().map_or(height, |&[_, z]| z);
    let end = [
        [width, 0.0, 0.0],
        [width, depth, 0.0],
        [width, depth, last],
        [width, 0.0, last],
    ];
    let mut right = Trace::default();
    right.closed(end.map(|point| view.at(point)));
    svg.path(right.text(), REMAINS);
    let mut front = Trace::default();
    front.closed(face(0.0).map(|point| view.at(point)));
    svg.path(front.text(), REMAINS);
    let mut edges = Trace::default();
    for y in [0.0, depth] {
        edges.closed(
            [
                [0.0, y, 0.0],
                [width, y, 0.0],
                [width, y, height],
                [0.0, y, height],
            ]
            .map(|point| view.at(point)),
        );
    }
    for (x, z) in [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)] {
        edges.open([[x, 0.0, z], [x, depth, z]].map(|point| view.at(point)));
    }
    svg.path(edges.text(), EDGES);
}

/// A bar along x for comparison, with the names of the axes at the blank.
fn bar(svg: &mut Svg, paths: &Paths<'_>, view: &View) {
    let [width, depth, height] = paths.blank;
    let names = [
        ("x", [width / 2.0, 0.0, 0.0], 18.0),
        ("y", [width, depth / 2.0, 0.0], 18.0),
        ("z", [0.0, 0.0, height / 4.0], 5.0),
    ];
    for (name, place, down) in names {
        let [x, y] = view.at(place);
        let aside = if name == "x" {
            0.0
        } else if name == "y" {
            14.0
        } else {
            -14.0
        };
        svg.text(
            (x + aside, y + down),
            Anchor::Middle,
            "font-style=\"italic\"",
            name,
        );
    }
    let step = super::scale::round_step(width / f64::from(most_ticks(RIGHT - LEFT, 70.0))).size();
    let (right, y) = (RIGHT, view.bottom + 20.0);
    let length = step * view.scale * RIGHTWARDS[0];
    let path = format!("M{} {}v-5m0 5h-{}v-5", number(right), number(y), number(length));
    svg.path(
        &path,
        &format!("stroke=\"{INK}\" stroke-width=\"2\" fill=\"none\""),
    );
    let words = format!("{} mm in x", number(step));
    svg.text((right - length - 9.0, y + 5.0), Anchor::End, "", &words);
}

fn legend(paths: &Paths<'_>) -> Vec<Entry> {
    let mut legend = vec![
        Entry::line(
            format!("stroke=\"{VERMILION}\" stroke-width=\"2\""),
            "milling program",
        ),
        Entry::line(
            format!("stroke=\"{BLUE}\" stroke-width=\"2\""),
            "tip of the blade",
        ),
    ];
    if paths.blades.len() <= MOST_BLADES {
        legend.push(Entry::line(BLADE, "edge where a flank begins"));
    } else {
        legend.push(Entry::area(
            "fill=\"none\"",
            format!("more than {MOST_BLADES} flanks: edges are not drawn"),
        ));
    }
    legend.push(Entry::area("fill=\"#e4dcc3\" stroke=\"#9c8a5c\"", "what is left"));
    legend
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
