//! The corners of the upper side of a surface by where they lie.

use crate::surface::Surface;

/// Corners are on the upper side up to this, in mm: what rounding makes of a height.
const SAME: f64 = 1e-6;

/// Corners of a window that are taken; of more, every second one and so on.
const MOST: usize = 200;

/// Most squares of a plan.
const MOST_SQUARES: f64 = 1e6;

/// Corners in squares over the plan.
pub(super) struct Crowd {
    /// Row by row of squares.
    corners: Vec<[f64; 3]>,
    /// Where the corners of a square start; one more at the end.
    starts: Vec<usize>,
    counts: [usize; 2],
    size: [f64; 2],
}

impl Crowd {
    /// Of the corners that no triangle lies over, in squares of about this side, in mm.
    pub(super) fn new(surface: &Surface, side: f64) -> Self {
        let size = surface.size();
        let side = side.max((size[0] * size[1] / MOST_SQUARES).sqrt());
        let counts = size.map(|length| (length / side).ceil().max(1.0) as usize);
        let mut crowd = Self {
            corners: Vec::new(),
            starts: Vec::new(),
            counts,
            size,
        };
        let is_upper = |at: &[f64; 3]| {
            surface
                .height(at[0], at[1])
                .is_some_and(|top| at[2] >= top - SAME)
        };
        let corners = surface.mesh().corners().iter().map(|corner| corner.to_array());
        let mut corners: Vec<[f64; 3]> = corners.filter(is_upper).collect();
        // Of several at one place one counts.
        corners.dedup_by(|one, other| one[0] == other[0] && one[1] == other[1]);
        // Stable: within a square they stay in the order of the mesh.
        corners.sort_by_key(|at| crowd.square([at[0], at[1]]));
        let squares = corners.iter().map(|at| crowd.square([at[0], at[1]]));
        let mut starts = vec![0; counts[0] * counts[1] + 1];
        for square in squares {
            if let Some(start) = starts.get_mut(square + 1) {
                *start += 1;
            }
        }
        for number in 1..starts.len() {
            starts[number] += starts[number - 1];
        }
        crowd.corners = corners;
        crowd.starts = starts;
        crowd
    }

    fn column(&self, axis: usize, at: f64) -> usize {
        // Casting is to the nearest number there is.
        ((at / self.size[axis] * self.counts[axis] as f64) as usize).min(self.counts[axis] - 1)
    }

    fn square(&self, [x, y]: [f64; 2]) -> usize {
        self.column(1, y) * self.counts[0] + self.column(0, x)
    }

    /// The corners within a window, by its least and its greatest corner.
    pub(super) fn within(&self, [low, high]: [[f64; 2]; 2]) -> Vec<[f64; 3]> {
        let is_inside = |at: &&[f64; 3]| {
            [0, 1]
                .iter()
                .all(|&axis| low[axis] <= at[axis] && at[axis] <= high[axis])
        };
        let mut found = Vec::new();
        for row in self.column(1, low[1])..=self.column(1, high[1]) {
            let squares = [low[0], high[0]].map(|x| row * self.counts[0] + self.column(0, x));
            let from = self.starts.get(squares[0]).copied().unwrap_or_default();
            let to = self.starts.get(squares[1] + 1).copied().unwrap_or(from);
            let run = self.corners.get(from..to).unwrap_or_default();
            found.extend(run.iter().filter(is_inside).copied());
        }
        let apart = found.len().div_ceil(MOST).max(1);
        if apart > 1 {
            found = found.into_iter().step_by(apart).collect();
        }
        found
    }
}
