//! How deep an upward V may go.
//!
//! A V with flanks of the slope `k` and its apex at (x, z) is the region `z' >= z + k |x' - x|`. It stays clear of the
//! part (`z' <= P(x')`) when its apex is at or above `F(x) = max over x' of P(x') - k |x - x'|`: the upper envelope of
//! downward cones standing on the profile. `F` is the smallest function that is nowhere below `P` and nowhere
//! steeper than `k`.
//!
//! One sweep to the right gives `max over x' <= x`, a sweep to the left over its result the whole: going from `x'` to
//! `x` by way of a third place never loses less than going straight.

use super::point::Point2;
use super::profile::{Profile, least_step};

/// The lowest height, for each x in the span of the profile, at which the apex of an upward V with flanks of the
/// given slope (dz/dx, positive) stays clear of the part. Exact up to rounding: a polyline, nowhere steeper than the
/// slope, nowhere below the profile. [`Profile::level_set`] and [`Profile::nearest_clear`] say where a tip may go at a
/// height.
///
/// A slope that is zero or less (or no number) is taken as zero: the answer is then the highest point everywhere.
#[must_use]
pub fn clearance(profile: &Profile, slope: f64) -> Profile {
    let slope = slope.max(0.0);
    let right = sweep(profile.points().iter().copied(), slope);
    // To sweep left is to sweep right in a mirror.
    let mirrored = sweep(right.into_iter().rev().map(mirror), slope);
    Profile::from_ascending(mirrored.into_iter().rev().map(mirror).collect())
}

const fn mirror(point: Point2) -> Point2 {
    Point2::new(-point.x, point.z)
}

/// `max over x' <= x of P(x') - slope (x - x')` as a polyline, for points with increasing x.
fn sweep(points: impl ExactSizeIterator<Item = Point2>, slope: f64) -> Vec<Point2> {
    let mut out: Vec<Point2> = Vec::with_capacity(points.len());
    // The corner of the profile before this one.
    let mut before: Option<Point2> = None;
    for corner in points {
        if let (Some(from), Some(&last)) = (before, out.last()) {
            let falling = last.z - slope * (corner.x - last.x);
            if corner.z < falling {
                out.push(Point2::new(corner.x, falling));
            } else {
                out.extend(emergence(from, corner, last.z, slope));
                out.push(corner);
            }
        } else {
            out.push(corner);
        }
        before = Some(corner);
    }
    out
}

/// Where a segment of the profile comes out of the cone that falls from the height `top` over its start; none when
/// it starts on the cone already. The segment ends at or above the cone.
///
/// Places too near the segment's ends are left out. Cone and segment together are convex, so the chord that comes
/// instead is above both.
fn emergence(from: Point2, to: Point2, top: f64, slope: f64) -> Option<Point2> {
    let buried = top - from.z;
    let width = to.x - from.x;
    let gain = to.z - from.z + slope * width;
    if !(buried > 0.0 && gain > 0.0) {
        return None;
    }
    let x = from.x + width * (buried / gain);
    let least = least_step(from.x.abs().max(to.x.abs()));
    (x - from.x >= least && to.x - x >= least).then(|| Point2::new(x, top - slope * (x - from.x)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn profile(heights: &[(f64, f64)]) -> Profile {
        let mut x = 0.0;
        let points = heights.iter().map(|&(step, z)| {
            x += step;
            Point2::new(x, z)
        });
        Profile::new(points.collect()).unwrap()
    }

    #[test]
    fn a_spike_casts_a_cone() {
        let spike = Profile::new(
            [(0.0, 0.0), (10.0, 0.0), (10.5, 8.0), (11.0, 0.0), (30.0, 0.0)]
                .map(|(x, z)| Point2::new(x, z))
                .to_vec(),
        )
        .unwrap();
        let clear = clearance(&spike, 1.0);
        let corners = [(0.0, 0.0), (2.5, 0.0), (10.5, 8.0), (18.5, 0.0), (30.0, 0.0)];
        for (x, z) in corners {
            assert!((clear.height(x) - z).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn no_slope_gives_the_highest_point() {
        for slope in [0.0, -1.0, f64::NAN] {
            let clear = clearance(&profile(&[(1.0, 2.0), (1.0, 5.0), (1.0, 3.0)]), slope);
            assert!(clear.points().iter().all(|p| (p.z - 5.0).abs() < 1e-12));
        }
    }

    proptest! {
        #[test]
        fn clearance_is_the_envelope_of_cones(
            heights in prop::collection::vec((0.01..8.0f64, -20.0..20.0f64), 2..40),
            slope in 0.05..10.0f64, shares in prop::collection::vec(0.0..1.0f64, 30),
        ) {
            let profile = profile(&heights);
            let clear = clearance(&profile, slope);
            let (start, end) = profile.span();
            prop_assert_eq!(clear.span(), (start, end));
            for pair in clear.points().windows(2) {
                prop_assert!(pair[0].x < pair[1].x);
                prop_assert!((pair[1].z - pair[0].z).abs() <= slope * (pair[1].x - pair[0].x) + 1e-9);
            }
            for share in shares {
                let x = start + (end - start) * share;
                // A maximum of linear pieces lies at their ends: at a corner or at x itself.
                let cones = profile.points().iter().map(|p| p.z - slope * (p.x - x).abs());
                let truth = cones.fold(profile.height(x), f64::max);
                prop_assert!((clear.height(x) - truth).abs() < 1e-9);
            }
        }

        #[test]
        fn level_sets_are_where_the_profile_is_low(
            heights in prop::collection::vec((0.01..8.0f64, (-8..8i32).prop_map(f64::from)), 2..300),
            z in prop_oneof![-9.0..9.0f64, (-8..8i32).prop_map(f64::from)],
            shares in prop::collection::vec(-0.1..1.1f64, 30),
        ) {
            let profile = profile(&heights);
            let set = profile.level_set(z);
            let (start, end) = profile.span();
            for pair in set.windows(2) {
                prop_assert!(pair[0].1 < pair[1].0);
                prop_assert!(profile.height((pair[0].1 + pair[1].0) / 2.0) > z);
            }
            for &(from, to) in &set {
                prop_assert!(from <= to && from >= start && to <= end);
                prop_assert!(profile.height(from) <= z && profile.height(to) <= z);
            }
            for share in shares {
                let x = start + (end - start) * share;
                let low = set.iter().any(|&(from, to)| from <= x && x <= to);
                if (start..=end).contains(&x) && (profile.height(x) - z).abs() > 1e-9 {
                    prop_assert_eq!(low, profile.height(x) < z);
                }
                // The nearest place, found from the whole set.
                let gap = |&(from, to): &(f64, f64)| (from - x).max(x - to).max(0.0);
                let nearest = set.iter().map(gap).fold(f64::INFINITY, f64::min);
                match profile.nearest_clear(x, z) {
                    Some(place) => {
                        prop_assert!(profile.height(place) <= z);
                        prop_assert!(((place - x).abs() - nearest).abs() < 1e-9, "{} {}", place, nearest);
                    }
                    None => prop_assert!(set.is_empty()),
                }
            }
        }
    }

    #[test]
    fn of_two_equally_near_places_the_left_one_is_taken() {
        let tent = profile(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0)]);
        assert_eq!(tent.nearest_clear(4.0, 1.0), Some(1.0));
        assert_eq!(tent.nearest_clear(4.5, 1.0), Some(7.0));
        assert_eq!(tent.nearest_clear(4.0, -1.0), None);
        assert_eq!(tent.nearest_clear(-3.0, 1.0), Some(0.0));
    }
}
