//! The largest distance from a machined surface to a part, bounded.

use super::machined::Machined;
use crate::surface::Surface;
use core::cmp::Ordering;
use std::collections::BinaryHeap;
use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::height_between;

/// Distances that are computed.
const MOST_PROBES: usize = 20_000;

/// Triangles that are looked at for these.
const MOST_LOOKS: usize = 30_000_000;

/// Bounds this near to each other in mm are good enough.
const ENOUGH: f64 = 0.01;

/// A patch of the machined surface: a segment of its profile, and a range of y.
#[derive(Clone, Copy, Debug)]
struct Patch {
    ends: [Point2; 2],
    along: [f64; 2],
    /// No distance of it is above that.
    most: f64,
}

/// What was found so far, and at what expense.
#[derive(Debug, Default)]
struct Search {
    /// The largest distance.
    known: f64,
    probes: usize,
    looks: usize,
}

impl Search {
    fn distance(&mut self, surface: &Surface, point: Point3) -> f64 {
        let distance = surface.distance(point, &mut self.looks);
        self.probes += 1;
        self.known = self.known.max(distance);
        distance
    }

    const fn is_over(&self) -> bool {
        self.probes >= MOST_PROBES || self.looks >= MOST_LOOKS
    }

    fn patch(&mut self, surface: &Surface, ends: [Point2; 2], along: [f64; 2]) -> Patch {
        let middle = ends[0].lerp(ends[1], 0.5);
        let y = along[0] + (along[1] - along[0]) / 2.0;
        let radius = libm::hypot(ends[0].distance(ends[1]), along[1] - along[0]) / 2.0;
        let most = if self.is_over() {
            f64::INFINITY
        } else {
            self.distance(surface, Point3::new(middle.x, y, middle.z)) + radius
        };
        Patch { ends, along, most }
    }
}

impl PartialEq for Patch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Patch {}

impl PartialOrd for Patch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Patch {
    fn cmp(&self, other: &Self) -> Ordering {
        self.most
            .total_cmp(&other.most)
            .then(self.ends[0].x.total_cmp(&other.ends[0].x))
            .then(self.along[0].total_cmp(&other.along[0]))
            .then(self.ends[0].z.total_cmp(&other.ends[0].z))
    }
}

/// Bounds of the largest distance; the upper one is infinite where nothing is known. `start` is a place in plan (y as z) at
/// which it is probably large.
pub(super) fn farthest(surface: &Surface, machined: &Machined, start: Point2) -> [f64; 2] {
    let [width, depth] = surface.size();
    let segments = machined.clipped(0.0, width);
    let mut search = Search::default();
    let over = |[a, b]: &&[Point2; 2]| a.x <= start.x && start.x <= b.x && a.x < b.x;
    for &[a, b] in segments.iter().filter(over) {
        let height = height_between(a, b, start.x);
        search.distance(surface, Point3::new(start.x, start.z, height));
    }
    // The budget goes first to every segment, so that profiles with very many get no bound.
    let mut patches: BinaryHeap<Patch> = BinaryHeap::with_capacity(segments.len());
    for segment in segments {
        patches.push(search.patch(surface, segment, [0.0, depth]));
    }
    while let Some(patch) = patches.peek().copied() {
        if patch.most - search.known <= ENOUGH || search.is_over() {
            break;
        }
        patches.pop();
        let [from, to] = patch.along;
        let [a, b] = patch.ends;
        let halves = if a.distance(b) >= to - from {
            let middle = a.lerp(b, 0.5);
            [([a, middle], patch.along), ([middle, b], patch.along)]
        } else {
            let middle = from + (to - from) / 2.0;
            [([a, b], [from, middle]), ([a, b], [middle, to])]
        };
        for (ends, along) in halves {
            patches.push(search.patch(surface, ends, along));
        }
    }
    let most = patches.peek().map_or(0.0, |patch| patch.most);
    [search.known, most.max(search.known)]
}
