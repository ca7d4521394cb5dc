//! Passes over a region of the plan: walls, what the tool cuts and in which order, and what stays.

use super::Point;
use super::chart::{Chart, Series, Shape};
use super::palette::INK;
use super::sheet::Room;
use super::svg::{Along, Mark};
use super::tiles::{self, Tiles};
use super::trace::number;

pub use super::sheet::Heading;

/// What the picture shows; lengths in mm, angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Passes<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The stock along x and y.
    pub size: [f64; 2],
    /// Walls, as lines.
    pub walls: &'a [Vec<Point>],
    /// Sides without a wall.
    pub open: &'a [Vec<Point>],
    /// Slits along walls: the ways of the blade's tip.
    pub slits: &'a [Vec<Point>],
    /// Stretches of passes, each with the engagement of the tool there.
    pub stretches: &'a [Stretch],
    /// Where the tool goes down.
    pub entries: &'a [Point],
    /// What stays uncut: from and to along x, from and to along y.
    pub uncut: &'a [[f64; 4]],
}

/// A stretch of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    pub points: Vec<Point>,
    /// The angle of the tool's rim in the material.
    pub engagement: f64,
}

/// The colour of slits.
const SLIT: &str = "#d4351c";

/// The width of a class of engagement.
const CLASS: f64 = 30.0;
/// From no engagement to half the rim, and all above.
const CLASSES: u32 = 7;

/// Writes the picture as SVG.
#[must_use]
pub fn draw(passes: &Passes<'_>) -> String {
    let [columns, rows] = passes.size.map(|length| [0.0, length]);
    let tiles = Tiles {
        columns: &columns,
        rows: &rows,
    };
    Chart {
        heading: passes.heading,
        description: description(passes),
        plot: tiles.plot(Room::of(passes.heading.ids)),
        labels: ["x, mm", "y, mm"],
        series: series(passes),
        along: Some(Along::Width),
    }
    .draw()
}

fn series(passes: &Passes<'_>) -> Vec<Series> {
    let mut series = vec![Series::new(
        Shape::Polygon(tiles::outline(passes.size)),
        format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1\""),
    )];
    if !passes.uncut.is_empty() {
        series
            .push(Series::new(Shape::Boxes(passes.uncut.to_vec()), "fill=\"#d4351c\"").named("stays uncut"));
    }
    for class in 0..CLASSES {
        let lines = of_class(passes, class);
        if !lines.is_empty() {
            series.push(Series::new(Shape::Lines(lines), paint(class)).named(words(class)));
        }
    }
    let line = |lines: &[Vec<Point>], words: &str, stroke: String| {
        let lines = segments(lines.iter().map(Vec::as_slice));
        let paint = format!("fill=\"none\" {stroke}");
        (!lines.is_empty()).then(|| Series::new(Shape::Lines(lines), paint).named(words))
    };
    let wall = format!("stroke=\"{INK}\" stroke-width=\"2.5\"");
    series.extend(line(
        passes.open,
        "open sides",
        format!("{wall} stroke-dasharray=\"8 5\""),
    ));
    series.extend(line(passes.walls, "walls", wall));
    let slit = format!("stroke=\"{SLIT}\" stroke-width=\"1.5\"");
    series.extend(line(passes.slits, "slits along walls", slit));
    for (number, entry) in passes.entries.iter().enumerate() {
        let mark = Series::mark(Mark::RING, *entry, None);
        series.push(if number == 0 {
            mark.named("ways down")
        } else {
            mark
        });
    }
    series
}

fn segments<'p>(lines: impl Iterator<Item = &'p [Point]>) -> Vec<[Point; 2]> {
    let pairs = lines.flat_map(|points| points.iter().zip(points.iter().skip(1)));
    pairs.map(|(from, to)| [*from, *to]).collect()
}

fn class_of(stretch: &Stretch) -> u32 {
    // Casting is to the nearest number there is.
    ((stretch.engagement / CLASS) as u32).min(CLASSES - 1)
}

fn of_class(passes: &Passes<'_>, class: u32) -> Vec<[Point; 2]> {
    let stretches = passes
        .stretches
        .iter()
        .filter(|stretch| class_of(stretch) == class);
    segments(stretches.map(|stretch| stretch.points.as_slice()))
}

fn paint(class: u32) -> String {
    let colour = tiles::colour(class, CLASSES);
    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-linecap=\"round\"")
}

fn words(class: u32) -> String {
    let from = f64::from(class) * CLASS;
    if class + 1 == CLASSES {
        format!("{} deg of the rim in the material, or more", number(from))
    } else {
        format!(
            "{} to {} deg of the rim in the material",
            number(from),
            number(from + CLASS)
        )
    }
}

/// The picture in words.
fn description(passes: &Passes<'_>) -> String {
    let largest = passes.stretches.iter().map(|stretch| stretch.engagement);
    let entries = match passes.entries.len() {
        1 => "1 way down".to_owned(),
        count => format!("{count} ways down"),
    };
    let slits = match passes.slits.len() {
        0 => String::new(),
        1 => " 1 slit along walls.".to_owned(),
        count => format!(" {count} slits along walls."),
    };
    if passes.stretches.is_empty() {
        return format!("Walls of a region of the plan.{slits}");
    }
    format!(
        "Passes over a region of the plan, {entries}. At most {:.0} deg of the rim are in the material.{slits}",
        largest.fold(0.0, f64::max)
    )
}
