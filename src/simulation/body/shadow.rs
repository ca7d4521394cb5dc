//! The lower edge of what a moving cylinder covers of the x-z plane, exactly.
//!
//! Seen along y, a disc of radius `r` square to the unit vector `u` is the ellipse whose farthest point in direction `n` is
//! `r sqrt(|n|^2 - (n . u)^2)` away from its middle; seen along `(0, 1, m)`, `n = (n_x, -m n_z, n_z)` takes the place of
//! `(n_x, 0, n_z)`, and `u_z - m u_y` that of `u_z`. A cylinder about `u` is that ellipse moved along `(u_x, u_z)`, and a way
//! of the blade moves it once more. The lower edge of the sum is convex: arcs of the ellipse, and between them the two
//! straight pieces in order of their slopes. So the point nearest above a straight piece of the section is where both have
//! the same slope, or at an end.

use vcutc_geometry::curve::Point2;

/// A disc seen along y: an ellipse about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ellipse {
    /// `r^2 (1 - u_x^2)`: the square of half its width.
    xx: f64,
    /// `-r^2 u_x u_z'`, with `u_z' = u_z - m u_y`.
    xz: f64,
    /// `r^2 (1 + m^2 - u_z'^2)`: the square of half its height.
    zz: f64,
    /// `r^2 |u_y + m u_z|`: the root of the determinant.
    area: f64,
}

impl Ellipse {
    /// Of a disc of that radius square to a unit vector, seen along y, or along a way that rises with it by a slope.
    pub(super) fn of_disc(radius: f64, [x, y, z]: [f64; 3], slope: f64) -> Self {
        let square = radius * radius;
        let lies = y + slope * z;
        Self {
            // Of a unit vector, so that nothing is lost where x or z is nearly 1.
            xx: square * (y * y + z * z),
            xz: -square * x * (z - slope * y),
            zz: square * (x * x * (1.0 + slope * slope) + lies * lies),
            area: square * lies.abs(),
        }
    }

    pub(super) fn half_width(self) -> f64 {
        self.xx.sqrt()
    }

    pub(super) fn half_height(self) -> f64 {
        self.zz.sqrt()
    }

    /// x of the point of the lower edge where its slope is this.
    fn at_slope(self, slope: f64) -> f64 {
        // The farthest point in direction (slope, -1).
        let along = self.xx * slope - self.xz;
        let far = (slope * along - self.xz * slope + self.zz).max(0.0).sqrt();
        if far > 0.0 { along / far } else { 0.0 }
    }

    /// Height of the lower edge; x beyond the ellipse counts as its end.
    fn lower(self, x: f64) -> f64 {
        if self.xx <= 0.0 {
            return -self.half_height();
        }
        let inside = (1.0 - x * x / self.xx).max(0.0).sqrt();
        (self.xz * x - self.area * self.half_width() * inside) / self.xx
    }
}

/// A straight piece that the ellipse is moved along, from left to right.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    x: f64,
    z: f64,
}

impl Piece {
    fn slope(self) -> f64 {
        self.z / self.x
    }
}

/// Pieces narrower than this are vertical, in mm: they shift no lower edge sideways.
const VERTICAL: f64 = 1e-12;

/// What a moving cylinder covers, seen along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shadow {
    ellipse: Ellipse,
    /// The middle of the ellipse at the left and, of what is vertical, lower end.
    start: Point2,
    /// In order of their slopes.
    pieces: [Option<Piece>; 2],
}

impl Shadow {
    /// An ellipse with its middle at `start`, moved along both vectors.
    pub(super) fn new(ellipse: Ellipse, start: Point2, along: [Point2; 2]) -> Self {
        let mut shadow = Self {
            ellipse,
            start,
            pieces: [None; 2],
        };
        for vector in along {
            shadow.extend(vector);
        }
        if let [Some(first), Some(second)] = shadow.pieces
            && first.slope() > second.slope()
        {
            shadow.pieces.reverse();
        }
        shadow
    }

    fn extend(&mut self, vector: Point2) {
        if vector.x.abs() < VERTICAL {
            self.start.z += vector.z.min(0.0);
            return;
        }
        let piece = if vector.x < 0.0 {
            self.start = Point2::new(self.start.x + vector.x, self.start.z + vector.z);
            Piece {
                x: -vector.x,
                z: -vector.z,
            }
        } else {
            Piece {
                x: vector.x,
                z: vector.z,
            }
        };
        if let Some(free) = self.pieces.iter_mut().find(|place| place.is_none()) {
            *free = Some(piece);
        }
    }

    fn pieces(&self) -> impl Iterator<Item = Piece> {
        self.pieces.into_iter().flatten()
    }

    /// From where to where it lies over x.
    pub(super) fn span(&self) -> (f64, f64) {
        let half = self.ellipse.half_width();
        let width: f64 = self.pieces().map(|piece| piece.x).sum();
        (self.start.x - half, self.start.x + width + half)
    }

    /// Height of its lower edge; x beyond its ends counts as the end.
    pub(super) fn lower(&self, x: f64) -> f64 {
        let mut start = self.start;
        for piece in self.pieces() {
            let slope = piece.slope();
            let begins = self.ellipse.at_slope(slope);
            let off = x - start.x;
            if off <= begins {
                break;
            }
            if off <= begins + piece.x {
                return start.z + self.ellipse.lower(begins) + slope * (off - begins);
            }
            start = Point2::new(start.x + piece.x, start.z + piece.z);
        }
        start.z + self.ellipse.lower(x - start.x)
    }

    /// x of the point of the lower edge where its slope is this.
    fn at_slope(&self, slope: f64) -> f64 {
        let before = self.pieces().filter(|piece| piece.slope() < slope);
        let passed: f64 = before.map(|piece| piece.x).sum();
        self.start.x + passed + self.ellipse.at_slope(slope)
    }

    /// Its lowest point.
    pub(super) fn lowest(&self) -> Point2 {
        let x = self.at_slope(0.0);
        Point2::new(x, self.lower(x))
    }

    /// The point of the lower edge that is the least above a polyline, and how far above it is (negative: below). None where
    /// it lies beside the polyline.
    pub(super) fn nearest_above(&self, line: &[Point2]) -> Option<(Point2, f64)> {
        let (left, right) = self.span();
        let pairs = line.iter().zip(line.iter().skip(1));
        let over = pairs.filter_map(|(from, to)| {
            let (low, high) = (from.x.max(left), to.x.min(right));
            if low > high || to.x <= from.x {
                return None;
            }
            let slope = (to.z - from.z) / (to.x - from.x);
            let x = self.at_slope(slope).clamp(low, high);
            let z = self.lower(x);
            Some((Point2::new(x, z), z - (from.z + slope * (x - from.x))))
        });
        over.min_by(|(_, a), (_, b)| a.total_cmp(b))
    }
}
