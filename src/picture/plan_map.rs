//! A map over the plan of the stock: x across the cuts, y along them, each cell in the colour of its highest place.

use super::Point;
use super::chart::{Chart, Series, Shape};
use super::palette::INK;
use super::scale::{Step, round_step};
use super::sheet::Room;
use super::svg::{Along, Mark};
use super::tiles::{self, MOST_CLASSES, Tiles};
use super::trace::number;

pub use super::sheet::Heading;

/// What a map shows; lengths in mm, angles in degrees, curvatures in 1/m.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanMap<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// What its heights are, such as `height of the part`.
    pub what: &'a str,
    pub quantity: Quantity,
    /// The stock along x and y.
    pub size: [f64; 2],
    /// How many cells it has along x and y.
    pub cells: [u32; 2],
    /// The highest place of each cell, row by row from the least y, each from the least x; none of a cell without any.
    pub heights: &'a [Option<f64>],
    /// The highest place of all, and how high it is.
    pub highest: (Point, f64),
    /// The lowest one.
    pub lowest: (Point, f64),
    pub mean: f64,
    /// The limit that the job sets them, if it does.
    pub limit: Option<Limit<'a>>,
}

/// What the heights of a map stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Heights, in mm.
    Height,
    /// Angles, in degrees.
    Angle,
    /// Curvatures, in 1/m.
    Curvature,
}

impl Quantity {
    /// What its values are in.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Height => "mm",
            Self::Angle => "deg",
            Self::Curvature => "1/m",
        }
    }

    /// Where a cell is as the map shows it.
    const fn place(self) -> &'static str {
        match self {
            Self::Height => "at its highest place",
            Self::Angle => "where it is the largest",
            Self::Curvature => "at its middle",
        }
    }

    /// What is more than a limit.
    const fn above(self) -> &'static str {
        match self {
            Self::Height => "a place higher",
            Self::Angle => "an angle larger",
            Self::Curvature => "a curvature greater",
        }
    }
}

/// A limit on what a map shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit<'a> {
    /// What it is called, such as `scallop limit`.
    pub name: &'a str,
    pub value: f64,
}

/// Cells along the longer side of a map.
const CELLS: f64 = 120.0;
/// Cells along the shorter side of a long and narrow map.
const FEWEST: u32 = 24;
/// Cells that are nearer to each other than this along x have the same line around them: what stands between two cuts and is higher
/// than the limit.
const NEAR: usize = 8;
/// Heights that differ by less than this, in mm, are shown with a decimal more.
const FINE: f64 = 0.2;

/// How many cells a map of a stock of this size along x and y should have: they are about square, and as small as can be distinguished.
#[must_use]
pub fn cells(size: [f64; 2]) -> [u32; 2] {
    let longest = size[0].max(size[1]);
    size.map(|length| ((CELLS * length / longest).round() as u32).clamp(FEWEST, CELLS as u32))
}

impl PlanMap<'_> {
    fn decimals(&self) -> Decimals {
        Decimals::of([self.lowest.1, self.highest.1])
    }
}

/// Writes the map as SVG.
#[must_use]
pub fn draw(map: &PlanMap<'_>) -> String {
    let [columns, rows] = [0, 1].map(|axis| edges(map.size[axis], map.cells[axis]));
    let tiles = Tiles {
        columns: &columns,
        rows: &rows,
    };
    let classes = Classes::of(map);
    let mut series = coloured(map, tiles, classes);
    series.extend(
        map.limit
            .map(|limit| bound(map, tiles, limit))
            .into_iter()
            .flatten(),
    );
    series.extend(marks(map, classes));
    Chart {
        heading: map.heading,
        description: description(map),
        plot: tiles.plot(Room::of(map.heading.ids).beside(map.size[1])),
        labels: ["x across the cuts, mm", "y along the cuts, mm"],
        series,
        along: Some(Along::Width),
    }
    .draw()
}

/// A map in the classes of its colours, for a view of another kind with the same colours and words.
#[derive(Clone, Debug, PartialEq)]
pub struct Classed {
    /// The classes, from the least values on.
    pub classes: Vec<Class>,
    /// Where the first class begins.
    pub from: f64,
    /// How wide each class is.
    pub step: f64,
    /// The number of the class of each cell, in the order of the map.
    pub cells: Vec<Option<u32>>,
    /// With how many decimals values are shown.
    pub decimals: usize,
}

/// A class of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Class {
    /// Its colour, as `#` and six hexadecimal digits.
    pub colour: &'static str,
    /// From which value to which one, with the unit.
    pub words: String,
}

/// Divides a map into the classes in which it is drawn.
#[must_use]
pub fn classed(map: &PlanMap<'_>) -> Classed {
    let classes = Classes::of(map);
    let class = |class| Class {
        colour: tiles::colour(class, classes.count),
        words: classes.words(class),
    };
    Classed {
        classes: (0..classes.count).map(class).collect(),
        from: classes.first * classes.step.size,
        step: classes.step.size,
        cells: map
            .heights
            .iter()
            .map(|height| height.map(|height| classes.class(height)))
            .collect(),
        decimals: map.decimals().0,
    }
}

/// Where cells along a side begin and end.
pub(super) fn edges(length: f64, count: u32) -> Vec<f64> {
    let count = count.max(1);
    let edge = |number| length * f64::from(number) / f64::from(count);
    (0..=count).map(edge).collect()
}

/// Heights in classes between round ones.
#[derive(Clone, Copy)]
struct Classes {
    step: Step,
    /// The first class begins at so many steps.
    first: f64,
    count: u32,
    quantity: Quantity,
}

impl Classes {
    fn of(map: &PlanMap<'_>) -> Self {
        let heights = || map.heights.iter().flatten().copied();
        let [least, most] = [
            heights().reduce(f64::min).unwrap_or_default(),
            heights().reduce(f64::max).unwrap_or_default(),
        ];
        // Smaller differences than are shown share a colour.
        let thinnest = libm::pow(10.0, -(Decimals::of([least, most]).0 as f64));
        let mut wanted = ((most - least) / f64::from(MOST_CLASSES)).max(thinnest);
        loop {
            let step = round_step(wanted);
            let first = steps(least, step).floor();
            let count = (steps(most, step) - first).ceil().max(1.0);
            // Beyond the largest step there is none that fits.
            if count <= f64::from(MOST_CLASSES) || step.size < 0.99 * wanted {
                let count = (count as u32).min(MOST_CLASSES);
                return Self {
                    step,
                    first,
                    count,
                    quantity: map.quantity,
                };
            }
            wanted = step.size * 1.5;
        }
    }

    fn class(self, height: f64) -> u32 {
        // Casting is to the nearest number there is.
        ((steps(height, self.step) - self.first) as u32).min(self.count - 1)
    }

    fn words(self, class: u32) -> String {
        let [from, to] = [class, class + 1].map(|class| {
            let height = (self.first + f64::from(class)) * self.step.size;
            self.step.words(height)
        });
        format!("{from} to {to} {}", self.quantity.unit())
    }
}

/// A height in steps. One that rounding has brought below a border lies on it: what is nowhere left is 0 mm high.
fn steps(height: f64, step: Step) -> f64 {
    let steps = height / step.size;
    let nearest = steps.round();
    if (steps - nearest).abs() < 1e-6 {
        nearest
    } else {
        steps
    }
}

/// Cells by their classes, the highest first, as the legend has them.
fn coloured(map: &PlanMap<'_>, tiles: Tiles<'_>, classes: Classes) -> Vec<Series> {
    let class = |height: &Option<f64>| height.map(|height| classes.class(height));
    let mut boxes = tiles.by_class(&map.heights.iter().map(class).collect::<Vec<_>>());
    let series = (0..classes.count).rev().map(|class| {
        let boxes = boxes.remove(&Some(class)).unwrap_or_default();
        Series::new(Shape::Boxes(boxes), tiles::paint(class, classes.count)).named(classes.words(class))
    });
    series.collect()
}

/// The line around what is higher than the limit: light under dark, to be seen on every colour.
fn bound(map: &PlanMap<'_>, tiles: Tiles<'_>, limit: Limit<'_>) -> [Series; 2] {
    let is_above = |height: &Option<f64>| height.is_some_and(|height| height > limit.value);
    let mut above: Vec<bool> = map.heights.iter().map(is_above).collect();
    let named = format!("{}, {} {}", limit.name, number(limit.value), map.quantity.unit());
    let words = match above.contains(&true) {
        true => format!("around all above the {named}"),
        false => format!("nothing above the {named}"),
    };
    for row in above.chunks_mut(map.cells[0].max(1) as usize) {
        close(row);
    }
    let lines = tiles.borders(&above);
    let paint = |colour: &str, width: f64| {
        format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"square\"")
    };
    [
        Series::new(Shape::Lines(lines.clone()), paint("#ffffff", 4.0)),
        Series::new(Shape::Lines(lines), paint(INK, 2.0)).named(words),
    ]
}

/// Adds what lies between cells of a row that are near to each other, or between one and the nearby end of the row.
fn close(row: &mut [bool]) {
    let mut from = 0;
    let ends: Vec<usize> = (0..row.len())
        .filter(|&cell| row[cell])
        .chain([row.len()])
        .collect();
    if ends.len() < 2 {
        return;
    }
    for end in ends {
        if end - from < NEAR {
            row[from..end].fill(true);
        }
        from = end + 1;
    }
}

/// The highest and the lowest place; and the mean, in the colour of its class. Where all are as high, no place is marked.
fn marks(map: &PlanMap<'_>, classes: Classes) -> Vec<Series> {
    let ((highest, most), (lowest, least)) = (map.highest, map.lowest);
    let (decimals, unit) = (map.decimals(), map.quantity.unit());
    let shown = |height| format!("{} {unit}", decimals.shown(height));
    let mean = tiles::paint(classes.class(map.mean), classes.count);
    if shown(most) == shown(least) {
        let everywhere = format!("{} everywhere", shown(map.mean));
        return vec![Series::new(Shape::Boxes(Vec::new()), mean).named(everywhere)];
    }
    vec![
        Series::mark(Mark::CROSS, highest, None).named(format!("most, {}", shown(most))),
        Series::new(Shape::Boxes(Vec::new()), mean).named(format!("mean, {}", shown(map.mean))),
        Series::mark(Mark::RING, lowest, None).named(format!("least, {}", shown(least))),
    ]
}

/// How many decimals of heights are shown.
#[derive(Clone, Copy, Debug)]
pub struct Decimals(usize);

impl Decimals {
    /// For heights from the least to the greatest.
    #[must_use]
    pub fn of([least, most]: [f64; 2]) -> Self {
        Self(if most - least < FINE { 3 } else { 2 })
    }

    /// A height, and never `-0.00`.
    #[must_use]
    pub fn shown(self, height: f64) -> String {
        let text = format!("{height:.0$}", self.0);
        match text.strip_prefix('-') {
            Some(positive) if positive.chars().all(|c| c == '0' || c == '.') => positive.to_owned(),
            Some(_) | None => text,
        }
    }
}

/// The map in words.
fn description(map: &PlanMap<'_>) -> String {
    let (decimals, unit) = (map.decimals(), map.quantity.unit());
    let shown = |height| format!("{} {unit}", decimals.shown(height));
    let at = |[x, y]: Point, height: f64| format!("{} at x {x:.1} mm, y {y:.1} mm", shown(height));
    let limit = map.limit.map(|limit| {
        let cells = map.heights.iter().flatten().count().max(1);
        let above = map
            .heights
            .iter()
            .flatten()
            .filter(|height| **height > limit.value)
            .count();
        let share = above as f64 / cells as f64 * 100.0;
        format!(
            " {share:.1} percent of the cells have {} than the {} of {}.",
            map.quantity.above(),
            limit.name,
            shown(limit.value)
        )
    });
    format!(
        "The {} over the plan of the stock, of each cell {}: at most {}, at least {}, {} on average.{}",
        map.what,
        map.quantity.place(),
        at(map.highest.0, map.highest.1),
        at(map.lowest.0, map.lowest.1),
        shown(map.mean),
        limit.unwrap_or_default()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;

    fn map(cells: [u32; 2], heights: &[Option<f64>], limit: Option<f64>) -> PlanMap<'_> {
        PlanMap {
            heading: Heading {
                ids: Prefix::NONE,
                title: "<rib>: material left above the part",
                subtitle: "12.3 cm\u{b3} are left",
            },
            what: "material left above the part",
            quantity: Quantity::Height,
            size: [300.0, 200.0],
            cells,
            heights,
            highest: ([290.5, 190.0], 11.9),
            lowest: ([10.0, 20.0], -1e-12),
            mean: 4.2,
            limit: limit.map(|value| Limit {
                name: "scallop limit",
                value,
            }),
        }
    }

    #[test]
    fn a_map_looks_as_it_was_reviewed() {
        let height = |place: u32| {
            let (column, row) = (place % 12, place / 12);
            Some(f64::from(column) * 0.7 + f64::from(row) * 0.6)
        };
        let mut heights: Vec<Option<f64>> = (0..96).map(height).collect();
        heights[50] = None;
        insta::assert_snapshot!(draw(&map([12, 8], &heights, Some(6.5))));
    }

    #[test]
    fn any_map_is_drawn_within_its_picture() {
        for heights in [
            &[][..],
            &[None],
            &[Some(0.0)],
            &[Some(-1e9), Some(1e9)],
            &[Some(5.0), Some(5.0 + 1e-9), None, Some(5.0 - 1e-9)],
        ] {
            for cells in [[0, 0], [1, 1], [2, 2], [120, 3]] {
                let svg = draw(&map(cells, heights, Some(1.0)));
                assert!(
                    !svg.contains("NaN") && !svg.contains("inf") && !svg.contains("-0.00"),
                    "{svg}"
                );
                assert!(svg.ends_with("</svg>\n"));
            }
        }
    }

    #[test]
    fn a_height_falls_into_the_class_that_names_it() {
        let heights = [Some(-1e-12), None, Some(4.999_999_999), Some(17.3)];
        let classes = Classes::of(&map([2, 2], &heights, None));
        assert_eq!((classes.step.size, classes.count), (2.0, 9));
        for (height, words) in [
            (-1e-12, "0 to 2 mm"),
            (3.9, "2 to 4 mm"),
            (3.999_999_999, "4 to 6 mm"),
            (17.3, "16 to 18 mm"),
        ] {
            assert_eq!(classes.words(classes.class(height)), words);
        }
        let level = [Some(20.0), Some(20.0)];
        let classes = Classes::of(&map([2, 1], &level, None));
        assert_eq!(classes.words(classes.class(20.0)), "20.000 to 20.001 mm");
    }

    #[test]
    fn one_line_is_around_teeth_and_another_one_around_what_is_far() {
        let closed = |row: &str| {
            let mut row: Vec<bool> = row.chars().map(|cell| cell == 'x').collect();
            close(&mut row);
            row.into_iter()
                .map(|cell| if cell { 'x' } else { '.' })
                .collect::<String>()
        };
        for (row, wanted) in [
            ("..x.x.......xx........", "xxxxxxxxxxxxxx........"),
            ("........x........x.", "........x........xx"),
            ("......", "......"),
            ("", ""),
        ] {
            assert_eq!(closed(row), wanted);
        }
    }

    #[test]
    fn cells_are_about_square_and_of_no_more_than_can_be_told_apart() {
        assert_eq!(cells([300.0, 200.0]), [120, 80]);
        assert_eq!(cells([85.0, 85.0]), [120, 120]);
        assert_eq!(cells([30.0, 2000.0]), [24, 120]);
    }

    #[test]
    fn the_largest_map_stays_small() {
        // No two neighbours are of one class: no part is like that.
        let heights: Vec<Option<f64>> = (0..120 * 120)
            .map(|place| Some(f64::from((place + place / 120) % 2 * 8)))
            .collect();
        let mut noise = map([120, 120], &heights, Some(4.0));
        for ids in [Prefix::NONE, Prefix::new("page-"), Prefix::for_phones("phone-")] {
            noise.heading.ids = ids;
            let length = draw(&noise).len();
            assert!(length < 450_000, "{length}");
        }
    }
}
