//! A paraboloid with slopes, by weighted least squares.
//!
//! `z = c0 + c1 u + c2 v + c3 u^2/2 + c4 u v + c5 v^2/2`, with `u` and `v` from the place in units of the reach, so that the normal
//! equations are well conditioned. Their inverse gives the standard errors of the second derivatives.

/// Coefficients.
const TERMS: usize = 6;

/// A pivot below this share of the largest diagonal entry says that the points lie on too few lines.
const LEAST_PIVOT: f64 = 1e-12;

/// A point and how much it counts.
pub(super) struct Point {
    pub(super) at: [f64; 3],
    pub(super) weight: f64,
}

type Matrix = [[f64; TERMS]; TERMS];

/// What fits best.
pub(super) struct Fit {
    terms: [f64; TERMS],
    inverse: Matrix,
    /// The mean square of what points are off, each with its weight.
    off: f64,
    /// What one point counts as, and how many such points there are.
    weight: f64,
    count: f64,
    reach: f64,
}

fn row(place: [f64; 2], reach: f64, at: [f64; 3]) -> [f64; TERMS] {
    let [u, v] = [0, 1].map(|axis| (at[axis] - place[axis]) / reach);
    [1.0, u, v, u * u / 2.0, u * v, v * v / 2.0]
}

fn product(a: &[f64; TERMS], b: &[f64; TERMS]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Fit {
    /// About a place. None where points do not determine it.
    pub(super) fn of(place: [f64; 2], reach: f64, points: &[Point]) -> Option<Self> {
        let base = points.first()?.at[2];
        let mut normal: Matrix = [[0.0; TERMS]; TERMS];
        let mut right = [0.0; TERMS];
        let (mut weights, mut squares) = (0.0, 0.0);
        for Point { at, weight } in points {
            let row = row(place, reach, *at);
            for (i, &left) in row.iter().enumerate() {
                for (j, &other) in row.iter().enumerate() {
                    normal[i][j] += weight * left * other;
                }
                right[i] += weight * left * (at[2] - base);
            }
            weights += weight;
            squares += weight * weight;
        }
        let inverse = inverted(normal)?;
        let terms: [f64; TERMS] = core::array::from_fn(|i| product(&inverse[i], &right));
        let off = points.iter().map(|Point { at, weight }| {
            let off = at[2] - base - product(&row(place, reach, *at), &terms);
            weight * off * off
        });
        let count = weights * weights / squares;
        Some(Self {
            terms,
            inverse,
            off: off.sum::<f64>() / weights,
            weight: squares / weights,
            count,
            reach,
        })
    }

    /// How far points are off it, as the root of the mean square.
    pub(super) fn scatter(&self) -> f64 {
        self.off.sqrt()
    }

    /// How it rises along x and y at the place.
    pub(super) fn slope(&self) -> [f64; 2] {
        [self.terms[1], self.terms[2]].map(|slope| slope / self.reach)
    }

    /// Its second derivatives: along x, mixed, along y.
    pub(super) fn second(&self) -> [f64; 3] {
        [self.terms[3], self.terms[4], self.terms[5]].map(|second| second / (self.reach * self.reach))
    }

    /// The standard error of the second derivative in a direction of length 1.
    pub(super) fn error(&self, [along, across]: [f64; 2]) -> f64 {
        let share = [along * along, 2.0 * along * across, across * across];
        let mut variance = 0.0;
        for (row, left) in self.inverse[3..].iter().zip(share) {
            for (entry, right) in row[3..].iter().zip(share) {
                variance += left * entry * right;
            }
        }
        let free = (self.count - TERMS as f64).max(1.0);
        (variance.max(0.0) * self.weight * self.off * self.count / free).sqrt() / (self.reach * self.reach)
    }
}

/// The inverse of a symmetric positive matrix, by elimination. None where it is singular.
fn inverted(mut matrix: Matrix) -> Option<Matrix> {
    let mut inverse: Matrix = core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))));
    let largest = (0..TERMS).map(|i| matrix[i][i]).fold(0.0, f64::max);
    for pivot in 0..TERMS {
        let size = matrix[pivot][pivot];
        // Comparisons with NaN are false.
        let is_regular = size > LEAST_PIVOT * largest;
        if !is_regular {
            return None;
        }
        matrix[pivot] = matrix[pivot].map(|entry| entry / size);
        inverse[pivot] = inverse[pivot].map(|entry| entry / size);
        let (own, own_inverse) = (matrix[pivot], inverse[pivot]);
        for i in (0..TERMS).filter(|&i| i != pivot) {
            let factor = matrix[i][pivot];
            for j in 0..TERMS {
                matrix[i][j] -= factor * own[j];
                inverse[i][j] -= factor * own_inverse[j];
            }
        }
    }
    Some(inverse)
}
