//! The wave of a sound field over a region, and its zero lines, which passes follow.

use super::Point;
use super::chart::{Chart, Series, Shape};
use super::palette::INK;
use super::sheet::Room;
use super::svg::Along;
use super::tiles::{self, Tiles};

pub use super::sheet::Heading;

/// What the picture shows; lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Wave<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The edges of its cells along x and along y, in growing order.
    pub edges: [&'a [f64]; 2],
    /// The height of the wave in each cell, row by row from the least y, each from the least x; none outside of the region.
    pub heights: &'a [Option<f64>],
    /// Its zero lines that passes follow.
    pub lines: &'a [Vec<Point>],
    /// Walls, as lines.
    pub walls: &'a [Vec<Point>],
}

/// Classes from trough to crest.
const CLASSES: u32 = 9;
/// The height from which on a crest is the highest class: the gain of a field is about 1 a few steps from its sources, and larger nearer to them.
const CREST: f64 = 2.0;

/// Writes the picture as SVG.
#[must_use]
pub fn draw(wave: &Wave<'_>) -> String {
    let [columns, rows] = wave.edges;
    let tiles = Tiles { columns, rows };
    let class = |height: &Option<f64>| {
        height.map(|height| {
            let share = (height / CREST + 1.0) / 2.0;
            // Casting is to the nearest number there is.
            ((share * f64::from(CLASSES)) as u32).min(CLASSES - 1)
        })
    };
    let mut boxes = tiles.by_class(&wave.heights.iter().map(class).collect::<Vec<_>>());
    let mut series: Vec<Series> = (0..CLASSES)
        .rev()
        .map(|class| {
            let found = boxes.remove(&Some(class)).unwrap_or_default();
            let series = Series::new(Shape::Boxes(found), tiles::paint(class, CLASSES));
            match class {
                0 => series.named("trough"),
                class if class + 1 == CLASSES => series.named("crest"),
                _ => series,
            }
        })
        .collect();
    series.push(line(wave.lines, "#ffffff", 2.0, "zero lines that passes follow"));
    series.push(line(wave.walls, INK, 2.5, "walls"));
    Chart {
        heading: wave.heading,
        description: format!(
            "The wave of a sound field over a region, from trough to crest, with {} zero lines that passes follow.",
            wave.lines.len()
        ),
        plot: tiles.plot(Room::of(wave.heading.ids)),
        labels: ["x across the cuts, mm", "y along the cuts, mm"],
        series,
        along: Some(Along::Width),
    }
    .draw()
}

fn line(lines: &[Vec<Point>], colour: &str, width: f64, words: &str) -> Series {
    let pairs = lines
        .iter()
        .flat_map(|points| points.iter().zip(points.iter().skip(1)));
    let segments = pairs.map(|(from, to)| [*from, *to]).collect();
    let paint =
        format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"");
    Series::new(Shape::Lines(segments), paint).named(words)
}
