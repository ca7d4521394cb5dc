//! A map over the plan of the stock, each cell in the colour of its class: kinds that have no order of size.
//!
//! What is raised is warm and what is hollow is blue, so that those who do not see red or green can separate both [Okabe 2008].

use super::chart::{Chart, Series, Shape};
use super::palette::{BLUE, ORANGE, PURPLE, SKY, VERMILION};
use super::plan_map::edges;
use super::sheet::{Heading, Room};
use super::svg::Along;
use super::tiles::Tiles;

/// The colour of a place that is flat.
const LEVEL: &str = "#dcd6c8";

/// The colours of classes, by their numbers: raised, raised one way, flat, both, hollow one way, hollow.
pub const COLOURS: [&str; 6] = [VERMILION, ORANGE, LEVEL, PURPLE, SKY, BLUE];

/// What a map of classes shows.
#[derive(Clone, Copy, Debug)]
pub struct ClassMap<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// What each of the classes is called.
    pub words: [&'a str; COLOURS.len()],
    /// How much of the plan each takes up, in words.
    pub figures: &'a str,
    /// The stock along x and y, in mm.
    pub size: [f64; 2],
    /// How many cells it has along x and y.
    pub cells: [u32; 2],
    /// The number of the class at the middle of each cell, row by row from the least y, each from the least x.
    pub classes: &'a [Option<u32>],
}

/// Writes the map as SVG.
#[must_use]
pub fn draw(map: &ClassMap<'_>) -> String {
    let [columns, rows] = [0, 1].map(|axis| edges(map.size[axis], map.cells[axis]));
    let tiles = Tiles {
        columns: &columns,
        rows: &rows,
    };
    let mut boxes = tiles.by_class(map.classes);
    let series = (0_u32..)
        .zip(map.words.into_iter().zip(COLOURS))
        .map(|(number, (word, colour))| {
            let boxes = boxes.remove(&Some(number)).unwrap_or_default();
            let paint = format!("fill=\"{colour}\" shape-rendering=\"crispEdges\"");
            Series::new(Shape::Boxes(boxes), paint).named(word)
        });
    let mut series: Vec<Series> = series.collect();
    // The most hollow first.
    series.reverse();
    Chart {
        heading: map.heading,
        description: format!(
            "The class of the part at the middle of each cell over the plan of the stock: {}.",
            map.figures
        ),
        plot: tiles.plot(Room::of(map.heading.ids).beside(map.size[1])),
        labels: ["x across the cuts, mm", "y along the cuts, mm"],
        series,
        along: Some(Along::Width),
    }
    .draw()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;

    #[test]
    fn every_cell_has_the_colour_of_its_class() {
        let classes: Vec<Option<u32>> = (0..6).map(Some).chain([None, Some(9)]).collect();
        let svg = draw(&ClassMap {
            heading: Heading {
                ids: Prefix::NONE,
                title: "<rib>: class of the part",
                subtitle: "saddle everywhere",
            },
            words: ["dome", "ridge", "flat", "saddle", "trough", "bowl"],
            figures: "saddle everywhere",
            size: [80.0, 50.0],
            cells: [8, 1],
            classes: &classes,
        });
        for colour in COLOURS {
            let path = format!("fill=\"{colour}\" shape-rendering=\"crispEdges\"");
            // In the plot and in the legend.
            assert_eq!(svg.matches(&path).count(), 2, "{colour}");
        }
        let places =
            ["bowl", "trough", "saddle", "flat", "ridge", "dome"].map(|word| svg.rfind(&format!(">{word}<")));
        assert!(
            places.iter().all(Option::is_some) && places.is_sorted(),
            "{places:?}"
        );
        assert!(!svg.contains("<rib>") && svg.ends_with("</svg>\n"));
    }
}
