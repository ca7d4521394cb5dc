//! The grid that tips lie on: a micrometre, which is what programs print.

/// Grid points in a millimetre.
const PER_MM: f64 = 1000.0;

/// Spacing of the grid, in mm.
pub const SPACING: f64 = 1.0 / PER_MM;

/// A value this close to a grid point is on it (rounding of products like 0.3 * 1000).
const ON_GRID: f64 = 1e-6;

/// The grid point nearest to a coordinate in mm.
#[must_use]
pub fn nearest(mm: f64) -> f64 {
    (mm * PER_MM).round() / PER_MM
}

/// The lowest grid point not below a coordinate in mm.
#[must_use]
pub fn up(mm: f64) -> f64 {
    // Zero comes out of `ceil` with a minus.
    (mm * PER_MM - ON_GRID).ceil() / PER_MM + 0.0
}

/// The highest grid point not above a coordinate in mm.
#[must_use]
pub fn down(mm: f64) -> f64 {
    (mm * PER_MM + ON_GRID).floor() / PER_MM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_each_way_and_leaves_grid_points_alone() {
        assert_eq!([nearest(1.2344), up(1.2344), down(1.2344)], [1.234, 1.235, 1.234]);
        assert_eq!(
            [nearest(-1.2346), up(-1.2346), down(-1.2346)],
            [-1.235, -1.234, -1.235]
        );
        for point in [0.3, 0.7, 8.29, 1024.001] {
            assert_eq!([nearest(point), up(point), down(point)], [point; 3]);
        }
    }
}
