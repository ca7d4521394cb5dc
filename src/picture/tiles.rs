//! Maps of tiles: a plane seen from above in rectangles, each in the colour of its class.
//!
//! Colours are of the scale viridis, which grows in lightness all along: the order can be read without seeing colours.

use super::Point;
use super::chart::Plot;
use super::scale::Scale;
use super::sheet::Room;
use std::collections::BTreeMap;

/// Viridis [Smith, van der Walt 2015], nine colours of it.
const COLOURS: [&str; MOST_CLASSES as usize] = [
    "#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725",
];
/// Classes that have colours of their own.
pub(super) const MOST_CLASSES: u32 = 9;
/// The highest plot, and the shortest side: a long and narrow map is not drawn to scale.
const HIGHEST: f64 = 520.0;
const SHORTEST: f64 = 160.0;

/// Rectangles from and to along the lower axis, from and to along the left one.
pub(super) type Boxes = Vec<[f64; 4]>;

/// Tiles by their edges along both axes, in growing order.
#[derive(Clone, Copy)]
pub(super) struct Tiles<'a> {
    pub(super) columns: &'a [f64],
    pub(super) rows: &'a [f64],
}

impl Tiles<'_> {
    /// x to the right and y upwards, as large as a room allows.
    pub(super) fn plot(self, room: Room) -> Plot {
        let [xs, ys] = [self.columns, self.rows].map(|edges| {
            let [start, end] = [edges.first(), edges.last()].map(|end| end.copied().unwrap_or_default());
            [start, end.max(start + 1.0)]
        });
        let [width, height] = [xs, ys].map(|[start, end]| end - start);
        let scale = (room.across() / width).min(HIGHEST / height);
        let [width, height] = [width, height].map(|length| (length * scale).max(SHORTEST));
        Plot {
            x: Scale::new(xs, [room.left, room.left + width]),
            y: Scale::new(ys, [room.top + height, room.top]),
        }
    }

    /// The tiles of each class, of which there is one to a tile, row by row from the first, each from the first column. Runs of one
    /// class in a row are one rectangle, and so are equal runs of rows one above the other.
    pub(super) fn by_class(self, classes: &[Option<u32>]) -> BTreeMap<Option<u32>, Boxes> {
        let mut boxes: BTreeMap<Option<u32>, Boxes> = BTreeMap::new();
        let count = self.columns.len().saturating_sub(1).max(1);
        // The runs of the row below by their columns: class, and number among the rectangles of it.
        let mut below: BTreeMap<[usize; 2], (Option<u32>, usize)> = BTreeMap::new();
        for (classes, row) in classes.chunks(count).zip(self.rows.windows(2)) {
            let mut column = 0;
            let mut here = BTreeMap::new();
            for run in classes.chunk_by(|a, b| a == b) {
                let ends = [column, column + run.len()];
                column += run.len();
                let [left, right] = ends.map(|end| self.columns.get(end).copied());
                let (Some(&class), Some(left), Some(right), &[bottom, top]) = (run.first(), left, right, row)
                else {
                    continue;
                };
                let known = boxes.entry(class).or_default();
                let number = below.get(&ends).filter(|(other, _)| *other == class);
                let number = number.map_or(known.len(), |(_, number)| *number);
                match known.get_mut(number) {
                    Some(run_below) => run_below[3] = top,
                    None => known.push([left, right, bottom, top]),
                }
                here.insert(ends, (class, number));
            }
            below = here;
        }
        boxes
    }

    /// The lines between tiles that are in and tiles that are not: one of each to a tile, in the order of classes.
    pub(super) fn borders(self, is_in: &[bool]) -> Vec<[Point; 2]> {
        let [columns, rows] = [self.columns, self.rows].map(|edges| edges.len().saturating_sub(1));
        let at = |column: usize, row: usize| is_in.get(row * columns + column).copied().unwrap_or_default();
        let level = (1..rows).flat_map(|row| {
            let y = self.rows[row];
            let runs = runs(columns, move |column| at(column, row - 1) != at(column, row));
            runs.into_iter()
                .map(move |ends| ends.map(|end| [self.columns[end], y]))
        });
        let upright = (1..columns).flat_map(|column| {
            let x = self.columns[column];
            let runs = runs(rows, move |row| at(column - 1, row) != at(column, row));
            runs.into_iter()
                .map(move |ends| ends.map(|end| [x, self.rows[end]]))
        });
        level.chain(upright).collect()
    }
}

/// Where runs of numbers up to a count that something holds for begin and end.
fn runs(count: usize, holds: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for number in (0..count).filter(|&number| holds(number)) {
        match runs.last_mut() {
            Some([_, end]) if *end == number => *end += 1,
            _ => runs.push([number, number + 1]),
        }
    }
    runs
}

/// The corners of a stock of this size along x and y.
pub(super) fn outline([width, depth]: [f64; 2]) -> Vec<Point> {
    vec![[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]]
}

/// The paint of a class out of so many: spread over the whole scale of colours, so that few classes differ well; without smoothing, so
/// that no seams show between tiles.
pub(super) fn paint(class: u32, count: u32) -> String {
    let colour = colour(class, count);
    format!("fill=\"{colour}\" shape-rendering=\"crispEdges\"")
}

/// The colour of one of so many classes.
pub(super) fn colour(class: u32, count: u32) -> &'static str {
    let last = MOST_CLASSES - 1;
    let index = (class * last)
        .checked_div(count.saturating_sub(1))
        .unwrap_or(last);
    COLOURS.get(index as usize).copied().unwrap_or("#fde725")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_tile_is_in_one_rectangle_of_its_class(
            columns in 1..9_usize, classes in prop::collection::vec(prop::option::weighted(0.8, 0..2_u32), 1..60),
        ) {
            let edges = |count: usize| (0..=count).map(|edge| edge as f64).collect::<Vec<_>>();
            let rows = classes.len() / columns;
            let classes = &classes[..rows * columns];
            let (xs, ys) = (edges(columns), edges(rows));
            let tiles = Tiles { columns: &xs, rows: &ys };
            let boxes = tiles.by_class(classes);
            for (tile, class) in classes.iter().enumerate() {
                let [x, y] = [tile % columns, tile / columns].map(|edge| edge as f64 + 0.5);
                let holds = |[left, right, bottom, top]: &[f64; 4]| *left < x && x < *right && *bottom < y && y < *top;
                let holding = |boxes: &Boxes| boxes.iter().filter(|one| holds(one)).count();
                prop_assert_eq!(boxes.get(class).map(holding), Some(1));
                prop_assert_eq!(boxes.values().map(holding).sum::<usize>(), 1);
            }
            let area: f64 = boxes.values().flatten().map(|[left, right, bottom, top]| (right - left) * (top - bottom)).sum();
            prop_assert_eq!(area, (rows * columns) as f64);
        }
    }

    #[test]
    fn borders_run_between_what_is_in_and_what_is_not() {
        let (columns, rows) = ([0.0, 10.0, 20.0, 30.0], [0.0, 1.0, 2.0]);
        let tiles = Tiles {
            columns: &columns,
            rows: &rows,
        };
        let (above, below) = ([true, true, true], [true, false, false]);
        let borders = tiles.borders(&[below, above].concat());
        assert_eq!(borders, [[[10.0, 1.0], [30.0, 1.0]], [[10.0, 0.0], [10.0, 1.0]]]);
        assert_eq!(tiles.borders(&[above, above].concat()), [[[0.0; 2]; 2]; 0]);
    }

    #[test]
    fn equal_rows_are_as_small_as_one() {
        let (columns, rows) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0]);
        let tiles = Tiles {
            columns: &columns,
            rows: &rows,
        };
        let row = [Some(1), Some(1), None];
        let boxes = tiles.by_class(&[row, row].concat());
        assert_eq!(boxes[&Some(1)], [[0.0, 2.0, 0.0, 2.0]]);
        assert_eq!(boxes[&None], [[2.0, 3.0, 0.0, 2.0]]);
    }
}
