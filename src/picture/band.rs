//! A curve with more ups and downs than can be told apart, as the band between its lowest and its highest values.
//!
//! Between two teeth that stand side by side a line would fill the ground between them: what can be seen of many is how high
//! they are and how low the gaps.

use super::Point;

/// From how many cuts on their teeth, flanks and turns are not drawn one by one.
pub(super) const MANY: usize = 100;

/// What a curve lies between.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Band {
    /// The highest values, from left to right.
    pub(super) upper: Vec<Point>,
    /// The lowest values, at the same x.
    pub(super) lower: Vec<Point>,
}

impl Band {
    /// Around it.
    pub(super) fn outline(&self) -> Vec<Point> {
        self.upper
            .iter()
            .chain(self.lower.iter().rev())
            .copied()
            .collect()
    }

    /// The band of a curve over its whole width, looked at in so many columns of equal width. What a curve does from one
    /// point to the next counts in every column that it passes.
    pub(super) fn of(points: &[Point], columns: u32) -> Self {
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Self::default();
        };
        let (left, width) = (first[0], (last[0] - first[0]) / f64::from(columns.max(1)));
        if width <= 0.0 {
            return Self::default();
        }
        let mut extremes = vec![[f64::INFINITY, f64::NEG_INFINITY]; columns.max(1) as usize];
        let most = extremes.len() - 1;
        let column = |x: f64| (((x - left) / width) as usize).min(most);
        for pair in points.windows(2) {
            let &[from, to] = pair else { continue };
            for (number, [low, high]) in
                (column(from[0])..=column(to[0])).zip(extremes.iter_mut().skip(column(from[0])))
            {
                let edges = [number as f64, (number + 1) as f64].map(|edge| left + edge * width);
                let enters = if from[0] < edges[0] {
                    at(from, to, edges[0])
                } else {
                    from[1]
                };
                let leaves = if to[0] > edges[1] {
                    at(from, to, edges[1])
                } else {
                    to[1]
                };
                *low = low.min(enters).min(leaves);
                *high = high.max(enters).max(leaves);
            }
        }
        let middle = |number: usize| match number {
            0 => left,
            number if number == most => last[0],
            number => left + (number as f64 + 0.5) * width,
        };
        let numbered = extremes.iter().enumerate();
        let filled = numbered.filter(|(_, [low, high])| low <= high);
        let (upper, lower) = filled
            .map(|(number, [low, high])| ([middle(number), *high], [middle(number), *low]))
            .unzip();
        Self { upper, lower }
    }
}

/// The value of a straight piece that is not upright at an x within it.
fn at(from: Point, to: Point, x: f64) -> f64 {
    from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_band_of_teeth_is_as_high_as_they_are() {
        let teeth: Vec<[f64; 2]> = (0..=1000_u32)
            .map(|i| [f64::from(i), f64::from(i % 2) * 3.0])
            .collect();
        let band = Band::of(&teeth, 50);
        assert_eq!((band.upper.len(), band.lower.len()), (50, 50));
        assert!(band.upper.iter().all(|point| point[1] == 3.0));
        assert!(band.lower.iter().all(|point| point[1] == 0.0));
        assert_eq!((band.upper[0][0], band.upper[49][0]), (0.0, 1000.0));
        assert_eq!(Band::of(&[[1.0, 2.0]], 10), Band::default());
    }

    proptest! {
        /// Held against the curve at many places.
        #[test]
        fn a_curve_lies_within_its_band(heights in prop::collection::vec(-5.0..5.0_f64, 2..200), columns in 1..40_u32) {
            let points: Vec<[f64; 2]> = heights.iter().enumerate().map(|(i, &z)| [i as f64, z]).collect();
            let band = Band::of(&points, columns);
            let width = (points.len() - 1) as f64 / f64::from(columns);
            prop_assert_eq!(band.upper.len(), columns as usize);
            for piece in points.windows(2) {
                for step in 0..=8 {
                    let share = f64::from(step) / 8.0;
                    let [x, z] = [0, 1].map(|i| piece[0][i] + (piece[1][i] - piece[0][i]) * share);
                    let number = ((x / width) as usize).min(columns as usize - 1);
                    prop_assert!(z <= band.upper[number][1] + 1e-9 && z >= band.lower[number][1] - 1e-9);
                }
            }
            let most = |points: &[[f64; 2]]| points.iter().map(|p| p[1]).fold(f64::MIN, f64::max);
            prop_assert!((most(&band.upper) - most(&points)).abs() < 1e-9);
        }
    }
}
