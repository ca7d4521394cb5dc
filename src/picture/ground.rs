//! Ground of a region of the plan that stays: between passes, and where no tool reaches, with the largest places numbered.

use super::Point;
use super::chart::{Chart, Series, Shape};
use super::palette::INK;
use super::sheet::Room;
use super::svg::{Along, Mark};
use super::tiles::{self, Tiles};
use super::trace::number;

pub use super::sheet::Heading;

/// What the picture shows; lengths in mm, areas in mm2.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The stock along x and y.
    pub size: [f64; 2],
    /// Walls, as lines.
    pub walls: &'a [Vec<Point>],
    /// Sides without a wall.
    pub open: &'a [Vec<Point>],
    /// The places, the largest first.
    pub places: &'a [Staying],
}

/// A place that stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Staying {
    /// Rectangles that cover it: from and to along x, from and to along y.
    pub boxes: Vec<[f64; 4]>,
    /// Its widest place.
    pub at: Point,
    pub area: f64,
    /// The diameter of the largest circle in it.
    pub width: f64,
    pub why: Why,
}

/// Why a place stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// No pass cuts it.
    Uncut,
    /// No tool of its radius gets there.
    BeyondReach,
}

/// So many places have numbers.
const NUMBERED: usize = 9;

/// Writes the picture as SVG.
#[must_use]
pub fn draw(ground: &Ground<'_>) -> String {
    let [columns, rows] = ground.size.map(|length| [0.0, length]);
    let tiles = Tiles {
        columns: &columns,
        rows: &rows,
    };
    Chart {
        heading: ground.heading,
        description: description(ground),
        plot: tiles.plot(Room::of(ground.heading.ids)),
        labels: ["x, mm", "y, mm"],
        series: series(ground),
        along: Some(Along::Width),
    }
    .draw()
}

fn series(ground: &Ground<'_>) -> Vec<Series> {
    let mut series = vec![Series::new(
        Shape::Polygon(tiles::outline(ground.size)),
        format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1\""),
    )];
    for (why, colour, words) in [
        (Why::BeyondReach, "#8a8577", "no tool of this radius reaches it"),
        (Why::Uncut, "#d4351c", "no pass cuts it"),
    ] {
        let boxes = of(ground, why).flat_map(|place| place.boxes.iter().copied());
        let boxes: Vec<[f64; 4]> = boxes.collect();
        if !boxes.is_empty() {
            series.push(Series::new(Shape::Boxes(boxes), format!("fill=\"{colour}\"")).named(words));
        }
    }
    let wall = format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.5\"");
    for (lines, words, paint) in [
        (
            ground.open,
            "open sides",
            format!("{wall} stroke-dasharray=\"8 5\""),
        ),
        (ground.walls, "walls", wall),
    ] {
        if !lines.is_empty() {
            series.push(Series::new(Shape::Ways(lines.to_vec()), paint).named(words));
        }
    }
    for (place, count) in ground.places.iter().take(NUMBERED).zip(1..) {
        let words = format!(
            "{count}: {} mm², {} mm wide, at x {} mm, y {} mm",
            number((place.area * 100.0).ceil() / 100.0),
            number((place.width * 100.0).ceil() / 100.0),
            number((place.at[0] * 10.0).round() / 10.0),
            number((place.at[1] * 10.0).round() / 10.0)
        );
        series.push(Series::mark(Mark::RING, place.at, Some(count.to_string())).named(words));
    }
    series
}

fn of<'g>(ground: &'g Ground<'_>, why: Why) -> impl Iterator<Item = &'g Staying> {
    ground.places.iter().filter(move |place| place.why == why)
}

/// The picture in words.
fn description(ground: &Ground<'_>) -> String {
    let sum = |why: Why| of(ground, why).map(|place| place.area).sum::<f64>();
    format!(
        "Regions of the plan with {} places that stay: {:.2} mm² that no pass cuts, {:.2} mm² that no tool of its radius reaches.",
        ground.places.len(),
        sum(Why::Uncut),
        sum(Why::BeyondReach)
    )
}
