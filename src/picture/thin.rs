//! Curves of any number of points in no more than can be seen.
//!
//! A curve is looked at column by column. Of the points in a column are kept the first, the lowest, the highest and the last
//! one, as they are: drawn with lines between them the picture is the same, and no extreme is lost [Jugel 2014].

/// A curve under construction, from left to right.
#[derive(Debug)]
pub struct Thinned {
    left: f64,
    column_width: f64,
    kept: Vec<[f64; 2]>,
    column: Option<Column>,
}

/// The points that matter of one column, each with its number within the column.
#[derive(Clone, Copy, Debug)]
struct Column {
    number: f64,
    count: usize,
    first: [f64; 2],
    lowest: (usize, [f64; 2]),
    highest: (usize, [f64; 2]),
    last: [f64; 2],
}

impl Thinned {
    /// A curve from one x to a greater one, looked at in so many columns.
    #[must_use]
    pub fn new(left: f64, right: f64, columns: u32) -> Self {
        Self {
            left,
            column_width: (right - left).max(f64::MIN_POSITIVE) / f64::from(columns.max(1)),
            kept: Vec::new(),
            column: None,
        }
    }

    /// A whole curve.
    #[must_use]
    pub fn of(points: &[[f64; 2]], columns: u32) -> Vec<[f64; 2]> {
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Vec::new();
        };
        let mut thinned = Self::new(first[0], last[0], columns);
        for &point in points {
            thinned.push(point);
        }
        thinned.finish()
    }

    /// The next point.
    pub fn push(&mut self, point: [f64; 2]) {
        let number = ((point[0] - self.left) / self.column_width).floor();
        match &mut self.column {
            Some(column) if column.number == number => column.add(point),
            Some(_) | None => {
                self.close();
                self.column = Some(Column::new(number, point));
            }
        }
    }

    /// The points that are left, in their order.
    #[must_use]
    pub fn finish(mut self) -> Vec<[f64; 2]> {
        self.close();
        self.kept
    }

    fn close(&mut self) {
        if let Some(column) = self.column.take() {
            column.keep(&mut self.kept);
        }
    }
}

impl Column {
    const fn new(number: f64, point: [f64; 2]) -> Self {
        Self {
            number,
            count: 1,
            first: point,
            lowest: (0, point),
            highest: (0, point),
            last: point,
        }
    }

    fn add(&mut self, point: [f64; 2]) {
        if point[1] < self.lowest.1[1] {
            self.lowest = (self.count, point);
        }
        if point[1] > self.highest.1[1] {
            self.highest = (self.count, point);
        }
        self.last = point;
        self.count += 1;
    }

    fn keep(&self, kept: &mut Vec<[f64; 2]>) {
        let mut points = vec![
            (0, self.first),
            self.lowest,
            self.highest,
            (self.count - 1, self.last),
        ];
        points.sort_by_key(|(number, _)| *number);
        points.dedup_by_key(|(number, _)| *number);
        kept.extend(points.into_iter().map(|(_, point)| point));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn few_points_stay_as_they_are() {
        let points = [[0.0, 1.0], [0.0, 3.0], [5.0, -2.0], [9.0, 4.0]];
        assert_eq!(Thinned::of(&points, 10), points);
        assert_eq!(Thinned::of(&[], 10), [[0.0; 2]; 0]);
    }

    proptest! {
        #[test]
        fn no_extreme_is_lost(heights in prop::collection::vec(-5.0..5.0_f64, 1..3000), columns in 1..50_u32) {
            let points: Vec<[f64; 2]> = heights.iter().enumerate().map(|(i, &z)| [i as f64, z]).collect();
            let thinned = Thinned::of(&points, columns);
            prop_assert!(thinned.len() <= 4 * (columns as usize + 1));
            prop_assert!(thinned.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
            let extremes = |points: &[[f64; 2]]| points.iter().fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p[1]), high.max(p[1])]);
            prop_assert_eq!(extremes(&thinned), extremes(&points));
            prop_assert!(thinned.iter().all(|point| points.contains(point)));
            prop_assert_eq!((thinned[0], thinned[thinned.len() - 1]), (points[0], points[points.len() - 1]));
        }
    }
}
