//! The machined contour compared with the part: distances, and the correlation of both [Cui IV.B].

use super::prove::merge_heights;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Nearest;

/// A point of one contour, by its distance from the other: material left standing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scallop {
    /// Distance to the nearest point of the other.
    pub height: Length,
    pub peak: Point2,
}

/// Scallops are found to within this, in mm.
const SCALLOP_TOLERANCE: f64 = 1e-3;

/// The point of a polyline farthest from another.
///
/// Corners of the polyline come first. Between two of them the distance may still be larger, over the middle of a hollow. But
/// it is the distance from a segment, which is largest at an end of a stretch, where one segment is nearest to both ends;
/// and it never changes faster than the place, so on a stretch of length `l` between points `a` and `b` away it is at most
/// `(a + b + l) / 2`. Stretches where that is no more than what is known are left out, others are halved.
#[must_use]
pub fn farthest(corners: &[Point2], from: &impl Nearest) -> Scallop {
    let mut highest = Scallop {
        height: Length::ZERO,
        peak: Point2 { x: 0.0, z: 0.0 },
    };
    let look = |highest: &mut Scallop, peak: Point2| {
        let (segment, distance) = from.nearest_segment(peak);
        if distance > highest.height.to_mm() {
            *highest = Scallop {
                height: Length::mm(distance),
                peak,
            };
        }
        (peak, segment, distance)
    };
    let seen: Vec<_> = corners.iter().map(|&corner| look(&mut highest, corner)).collect();
    let mut stretches: Vec<_> = seen.iter().copied().zip(seen.iter().copied().skip(1)).collect();
    while let Some((a, b)) = stretches.pop() {
        let most = (a.2 + b.2 + a.0.distance(b.0)) / 2.0;
        if a.1 == b.1 || most <= highest.height.to_mm() + SCALLOP_TOLERANCE {
            continue;
        }
        let middle = look(&mut highest, a.0.lerp(b.0, 0.5));
        stretches.push((a, middle));
        stretches.push((middle, b));
    }
    highest
}

/// Points that contours are compared by [Cui IV.B].
pub const SAMPLES: u32 = 1000;

/// The points of a contour at [`SAMPLES`] evenly spaced x.
#[must_use]
pub fn sampled(corners: &[Point2]) -> Vec<Point2> {
    let points = grid(corners).into_iter().zip(resample(corners));
    points.map(|(Point2 { x, .. }, z)| Point2 { x, z }).collect()
}

/// Two contours at [`SAMPLES`] evenly spaced x each.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// Heights of one, in mm.
    pub one: Vec<f64>,
    /// Heights of the other, in mm.
    pub other: Vec<f64>,
}

impl Sampled {
    /// Samples two contours.
    #[must_use]
    pub fn of(one: &[Point2], other: &[Point2]) -> Self {
        Self {
            one: resample(one),
            other: resample(other),
        }
    }

    /// The normalised cross-correlation at every lag [Cui 15], from 1 - n to n - 1: the sum of products of the first contour's
    /// heights `lag` points on with the second's. Contours without height are alike.
    #[must_use]
    pub fn correlations(&self) -> Vec<f64> {
        let (a, b) = (&self.one, &self.other);
        let scale = (product(a, a) * product(b, b)).sqrt();
        let value = |product: f64| if scale > 0.0 { product / scale } else { 1.0 };
        let later_b = (1..b.len()).rev().map(|lag| product(a, tail(b, lag)));
        let later_a = (0..a.len()).map(|lag| product(tail(a, lag), b));
        later_b.chain(later_a).map(value).collect()
    }

    /// The largest value of the normalised cross-correlation over all lags; 1 means alike up to scale.
    #[must_use]
    pub fn correlation(&self) -> f64 {
        self.correlations().into_iter().fold(0.0, f64::max)
    }
}

fn product(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn tail(values: &[f64], from: usize) -> &[f64] {
    values.get(from..).unwrap_or_default()
}

/// Evenly spaced x over a polyline, at height zero.
fn grid(points: &[Point2]) -> Vec<Point2> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let step = (last.x - first.x) / f64::from(SAMPLES - 1);
    let inner = (0..SAMPLES - 1).map(|i| first.x + f64::from(i) * step);
    // The last one exactly, so that it is not beyond the end by rounding.
    let all = inner.chain([last.x]);
    all.map(|x| Point2 { x, z: 0.0 }).collect()
}

/// Heights of a polyline over its grid; at a wall that of its left side.
fn resample(points: &[Point2]) -> Vec<f64> {
    let grid = grid(points);
    let mut heights = Vec::with_capacity(grid.len());
    let mut next = 0;
    merge_heights(points, &grid, &mut |x, z, _| {
        if grid.get(next).is_some_and(|wanted| wanted.x <= x) {
            heights.push(z);
            next += 1;
        }
    });
    heights
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use vcutc_geometry::profile::Profile;

    fn polyline(heights: &[f64]) -> Vec<Point2> {
        (0_u32..)
            .zip(heights)
            .map(|(i, &z)| Point2 {
                x: f64::from(i) * 10.0,
                z,
            })
            .collect()
    }

    /// Distance of a point from a polyline, from every piece.
    fn distance(point: Point2, line: &[Point2]) -> f64 {
        let to_piece = |pair: &[Point2]| {
            let (a, b) = (pair[0], pair[1]);
            let (dx, dz) = (b.x - a.x, b.z - a.z);
            let t = (((point.x - a.x) * dx + (point.z - a.z) * dz) / (dx * dx + dz * dz)).clamp(0.0, 1.0);
            libm::hypot(point.x - a.x - t * dx, point.z - a.z - t * dz)
        };
        line.windows(2).map(to_piece).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_ground_of_a_narrow_hollow_is_far_from_the_surface() {
        let at = |x, z| Point2 { x, z };
        let part = [
            at(0.0, 10.0),
            at(49.0, 10.0),
            at(50.0, 0.0),
            at(51.0, 10.0),
            at(100.0, 10.0),
        ];
        let surface = [at(0.0, 12.0), at(100.0, 12.0)];
        let [part, surface] = [
            part,
            [
                surface[0],
                at(20.0, 12.0),
                at(30.0, 12.0),
                at(40.0, 12.0),
                surface[1],
            ],
        ]
        .map(|points| Profile::new(points.to_vec()).unwrap());
        let deepest = farthest(part.points(), &surface);
        assert_eq!((deepest.height.to_mm(), deepest.peak), (12.0, at(50.0, 0.0)));
        assert!((farthest(surface.points(), &part).height.to_mm() - libm::hypot(1.0, 2.0)).abs() < 2e-3);
    }

    /// The normalised cross-correlation by its definition [Cui 15]: points beyond the ends count as zero.
    fn by_definition(a: &[f64], b: &[f64], lag: i32) -> f64 {
        let at = |values: &[f64], i: i32| {
            usize::try_from(i)
                .ok()
                .and_then(|i| values.get(i).copied())
                .unwrap_or(0.0)
        };
        let sum =
            |a: &[f64], b: &[f64], lag: i32| -> f64 { (-50..100).map(|i| at(a, i + lag) * at(b, i)).sum() };
        sum(a, b, lag) / (sum(a, a, 0) * sum(b, b, 0)).sqrt()
    }

    proptest! {
        #[test]
        fn correlations_are_those_of_the_definition(pairs in prop::collection::vec((0.1..9.0_f64, 0.1..9.0_f64), 2..30)) {
            let (one, other): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
            let count = i32::try_from(one.len()).unwrap();
            let sampled = Sampled { one, other };
            let found = sampled.correlations();
            prop_assert_eq!(found.len(), 2 * sampled.one.len() - 1);
            for (lag, value) in (1 - count..count).zip(&found) {
                prop_assert!((value - by_definition(&sampled.one, &sampled.other, lag)).abs() < 1e-12);
            }
            prop_assert!(sampled.correlation() <= 1.0 + 1e-12);
            let alike = Sampled { one: sampled.one.clone(), other: sampled.one.clone() };
            prop_assert!((alike.correlation() - 1.0).abs() < 1e-12);
        }

        #[test]
        fn the_highest_point_is_found_between_corners_too(
            part in prop::collection::vec(0.0..40.0_f64, 6),
            above in prop::collection::vec(0.0..30.0_f64, 6),
        ) {
            let surface: Vec<f64> = part.iter().zip(&above).map(|(part, above)| part + above).collect();
            let (surface, part) = (polyline(&surface), polyline(&part));
            let found = farthest(&surface, &Profile::new(part.clone()).unwrap()).height.to_mm();
            // Every hundredth of each stretch.
            let places = surface.windows(2).flat_map(|pair| (0..=100_u32).map(|i| pair[0].lerp(pair[1], f64::from(i) / 100.0)));
            let sampled = places.map(|place| distance(place, &part)).fold(0.0, f64::max);
            prop_assert!(found >= sampled - SCALLOP_TOLERANCE && found <= sampled + 0.5, "{found} {sampled}");
        }
    }
}
