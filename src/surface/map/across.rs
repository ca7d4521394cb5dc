//! Maps of what stays over a surface, from sections across it.

use super::{Cells, Grid, Map, TOUCH, Tally};
use core::ops::RangeInclusive;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::height_between;

/// What stays in a section across a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// Where along y, in mm.
    pub y: f64,
    /// How high material stands straight above the surface: x and height in mm, from left to right; it may step.
    pub heights: Vec<Point2>,
}

impl Standing {
    /// The sloping pieces of the heights.
    fn pieces(&self) -> impl Iterator<Item = [Point2; 2]> {
        let pairs = self.heights.iter().zip(self.heights.iter().skip(1));
        pairs
            .map(|(&left, &right)| [left, right])
            .filter(|[left, right]| left.x < right.x)
    }

    /// The heights between two places along x at which they may be the highest or the lowest.
    fn within(&self, from: f64, to: f64) -> impl Iterator<Item = Point2> {
        let touched = self
            .pieces()
            .filter(move |[left, right]| right.x > from + TOUCH && left.x < to - TOUCH);
        touched.flat_map(move |[left, right]| {
            [left.x.max(from), right.x.min(to)].map(|x| Point2::new(x, height_between(left, right, x)))
        })
    }

    /// The area below the heights, in mm2.
    fn area(&self) -> f64 {
        let areas = self
            .pieces()
            .map(|[left, right]| (right.x - left.x) * f64::midpoint(left.z, right.z));
        areas.sum()
    }
}

impl Map {
    /// A map over a plan of this size along x and y, in mm, from sections by growing y. A cell has the highest place of all sections
    /// that lie in it, and of those next to it where none lies on its border: what is higher in between is not known. None of fewer
    /// than two sections.
    #[must_use]
    pub fn of_sections(sections: &[Standing], cells: Cells, size: [f64; 2]) -> Option<Self> {
        let grid = Grid::new(cells, size);
        let mut tally = Tally::new(&grid);
        let [columns, rows] = grid.counts;
        let near = |row: usize| {
            let [low, high] = [row, row + 1].map(|number| grid.border(1, number));
            let before = sections.partition_point(|section| section.y <= low + TOUCH);
            let beyond = sections.partition_point(|section| section.y < high - TOUCH);
            before.saturating_sub(1)..=beyond
        };
        let near: Vec<RangeInclusive<usize>> = (0..rows).map(near).collect();
        for (number, section) in sections.iter().enumerate() {
            for column in 0..columns {
                let [from, to] = [column, column + 1].map(|number| grid.border(0, number));
                let points: Vec<Point2> = section.within(from, to).collect();
                let rows = (0..rows).zip(&near).filter(|(_, near)| near.contains(&number));
                for ((row, _), point) in rows.flat_map(|row| points.iter().map(move |point| (row, point))) {
                    tally.note([column, row], [point.x, section.y], point.z);
                }
            }
        }
        for pair in sections.windows(2) {
            let [one, other] = pair else { continue };
            let apart = other.y - one.y;
            tally.volume += apart * f64::midpoint(one.area(), other.area());
            tally.area += apart * size[0];
        }
        tally.map(Length::mm)
    }
}

#[cfg(test)]
mod tests;
