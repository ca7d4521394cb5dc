//! Legal ranges of values, in the unit that people use for them.

use super::dimension::Dimension;
use crate::number::number;
use core::ops::{Bound, RangeBounds};

/// A range of values of one dimension, in its usual unit (mm, deg, mm/s, deg/s, s, kg).
#[derive(Clone, Copy, Debug)]
pub struct Range {
    pub dimension: Dimension,
    low: Bound<f64>,
    high: Bound<f64>,
}

impl Range {
    pub const fn new(dimension: Dimension, low: Bound<f64>, high: Bound<f64>) -> Self {
        Self { dimension, low, high }
    }

    /// With both ends.
    pub const fn closed(dimension: Dimension, low: f64, high: f64) -> Self {
        Self::new(dimension, Bound::Included(low), Bound::Included(high))
    }

    /// Above zero, up to an end.
    pub const fn positive(dimension: Dimension, high: f64) -> Self {
        Self::new(dimension, Bound::Excluded(0.0), Bound::Included(high))
    }

    /// All values of a dimension.
    pub const fn all(dimension: Dimension) -> Self {
        Self::new(dimension, Bound::Unbounded, Bound::Unbounded)
    }

    /// Whether a value in mm, rad, s, kg lies within.
    pub fn holds(self, value: f64) -> bool {
        // Ends are converted, not the value, so that `90 deg` is exactly the end at 90 deg.
        let unit = self.dimension.unit_size();
        let end = |bound: Bound<f64>| bound.map(|end| end * unit);
        (end(self.low), end(self.high)).contains(&value)
    }

    /// Whether a number of the usual unit lies within.
    pub fn holds_number(self, number: f64) -> bool {
        (self.low, self.high).contains(&number)
    }

    /// In words: `greater than 0 deg and at most 90 deg`.
    pub fn words(self) -> String {
        let low = match self.low {
            Bound::Excluded(end) => Some(("greater than", end)),
            Bound::Included(end) => Some(("at least", end)),
            Bound::Unbounded => None,
        };
        let high = match self.high {
            Bound::Excluded(end) => Some(("less than", end)),
            Bound::Included(end) => Some(("at most", end)),
            Bound::Unbounded => None,
        };
        let ends = [low, high].into_iter().flatten();
        let words = ends.map(|(relation, end)| format!("{relation} {}", self.end(end)));
        words.collect::<Vec<_>>().join(" and ")
    }

    /// An end with its unit; ends of many thousand mm are easier to read in m.
    fn end(self, end: f64) -> String {
        let long = end.abs() >= 10_000.0;
        match self.dimension {
            Dimension::LENGTH if long => format!("{} m", number(end / 1000.0)),
            Dimension::SPEED if long => format!("{} m/s", number(end / 1000.0)),
            dimension => dimension.show(end),
        }
    }
}
