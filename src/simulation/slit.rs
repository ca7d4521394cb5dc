//! How deep the slit that a single flank cuts enters the part.
//!
//! The proof of whole V-cuts ([`prove`](super::prove)) takes both flanks from one tip. A program that was changed
//! need not keep to that, so its cuts are looked at one by one: in the x-z plane the edge lies on a straight line from the
//! tip up, as far as it is long, and no point of that line may lie below the part.

use super::prove::Bound;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::Straight;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

/// A place in the part, and how far above it the part's contour lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    pub at: Point2,
    /// How deep, along z; positive.
    pub depth: Length,
}

/// Places along a cut that is not along y at which its slit is looked at.
const PLACES: u32 = 32;

/// Depth below which an entry is rounding, in mm: a nanometre.
const ROUNDING: f64 = 1e-6;

/// Where the edge of a blade lies in the x-z plane, seen from the tip to its end.
#[must_use]
pub fn edge(blade: Straight, held: Orientation) -> Point2 {
    let m = held.matrix();
    // Of the two edges the one that is farther along the flank counts.
    let [one, other] = blade.edge_ends().map(|[aside, _, up]| {
        let along = |row: usize| {
            let [x, _, z] = m.get(row).copied().unwrap_or_default();
            aside * x + up * z
        };
        Point2::new(along(0), along(2))
    });
    if one.z >= other.z { one } else { other }
}

/// The deepest entry into the part of an edge whose tip goes straight from one point to another.
#[must_use]
pub fn deepest(bound: &Bound<'_>, edge: Point2, from: Point3, to: Point3) -> Option<Entry> {
    let stays = (from.x - to.x).abs() <= ROUNDING && (from.z - to.z).abs() <= ROUNDING;
    let places = if stays { 0 } else { PLACES };
    let tips = (0..=places).map(|place| {
        let done = f64::from(place) / f64::from(PLACES);
        Point2::new(
            from.x + (to.x - from.x) * done,
            from.z + (to.z - from.z) * done - bound.drop.to_mm(),
        )
    });
    tips.filter_map(|tip| entry(bound, tip, edge))
        .max_by(|a, b| a.depth.total_cmp(&b.depth))
}

/// The part's contour and the edge are both straight between the contour's corners, so the deepest place is at one of
/// these, or at an end of the edge.
fn entry(bound: &Bound<'_>, tip: Point2, edge: Point2) -> Option<Entry> {
    let (start, end) = bound.part.span();
    let reach = tip.x + edge.x;
    let (left, right) = (tip.x.min(reach).max(start), tip.x.max(reach).min(end));
    if left > right {
        return None;
    }
    let height = |x: f64| {
        if edge.x.abs() < ROUNDING {
            tip.z
        } else {
            tip.z + edge.z * ((x - tip.x) / edge.x).clamp(0.0, 1.0)
        }
    };
    let points = bound.part.points();
    let first = points.partition_point(|point| point.x <= left);
    let last = points.partition_point(|point| point.x < right);
    let corners = points.get(first..last.max(first)).unwrap_or_default();
    let places = corners.iter().map(|corner| corner.x).chain([left, right]);
    let deepest = places
        .map(|x| Entry {
            at: Point2::new(x, height(x)),
            depth: Length::mm(bound.part.height(x) - height(x)),
        })
        .max_by(|a, b| a.depth.total_cmp(&b.depth))?;
    (deepest.depth.to_mm() > ROUNDING).then_some(deepest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use vcutc_geometry::profile::Profile;

    proptest! {
        #[test]
        fn the_deepest_place_is_no_less_deep_than_any_sampled_one(
            heights in prop::collection::vec(0.0..20.0_f64, 8),
            tip in (0.0..70.0_f64, 0.0..25.0_f64),
            edge in (-20.0..20.0_f64, 0.1..20.0_f64),
        ) {
            let points = (0_u32..).zip(&heights).map(|(i, &z)| Point2::new(10.0 * f64::from(i), z)).collect();
            let part = Profile::new(points).unwrap();
            let bound = Bound::of(&part);
            let from = Point3::new(tip.0, -5.0, tip.1);
            let found = deepest(&bound, Point2::new(edge.0, edge.1), from, Point3::new(tip.0, 55.0, tip.1));
            let found = found.map_or(0.0, |entry| entry.depth.to_mm());
            let sampled = (0..=1000_u32).filter_map(|i| {
                let share = f64::from(i) / 1000.0;
                let (x, z) = (tip.0 + edge.0 * share, tip.1 + edge.1 * share);
                (0.0..=70.0).contains(&x).then(|| part.height(x) - z)
            }).fold(0.0, f64::max);
            prop_assert!(found >= sampled - 1e-6, "{found} {sampled}");
            prop_assert!(found <= sampled + 0.2, "{found} {sampled}");
        }
    }

    /// A wall's edge stands straight above its tip, which alone can be in the part.
    #[test]
    fn an_upright_edge_is_as_deep_as_its_tip() {
        let part = Profile::new(vec![
            Point2::new(0.0, 10.0),
            Point2::new(40.0, 10.0),
            Point2::new(60.0, 30.0),
        ])
        .unwrap();
        let bound = Bound::of(&part);
        for (x, z, depth) in [
            (20.0, 8.0, Some(2.0)),
            (50.0, 15.0, Some(5.0)),
            (50.0, 20.0, None),
            (0.0, 9.0, Some(1.0)),
            (-1.0, 5.0, None),
        ] {
            let (from, to) = (Point3::new(x, -5.0, z), Point3::new(x, 55.0, z));
            let found = deepest(&bound, Point2::new(0.0, 20.0), from, to);
            assert_eq!(found.map(|entry| entry.depth.to_mm()), depth, "{x} {z}");
        }
    }

    #[test]
    fn a_cut_that_runs_down_is_as_deep_as_its_end() {
        let part = Profile::new(vec![Point2::new(0.0, 10.0), Point2::new(80.0, 10.0)]).unwrap();
        let bound = Bound {
            drop: Length::mm(0.5),
            ..Bound::of(&part)
        };
        let (from, to) = (Point3::new(40.0, -5.0, 12.0), Point3::new(40.0, 55.0, 8.0));
        let entry = deepest(&bound, Point2::new(5.0, 8.0), from, to).unwrap();
        assert!((entry.depth.to_mm() - 2.5).abs() < 1e-9);
    }
}
