//! The largest distance from a machined surface to a part, bounded.

use super::machined::Machined;
use crate::surface::Surface;
use core::cmp::Ordering;
use std::collections::BinaryHeap;
use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::curve::Point2;

/// Distances that are computed.
const MOST_PROBES: usize = 20_000;

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

impl Patch {
    fn new(surface: &Surface, ends: [Point2; 2], along: [f64; 2], known: &mut f64) -> Self {
        let middle = ends[0].lerp(ends[1], 0.5);
        let y = along[0] + (along[1] - along[0]) / 2.0;
        let distance = surface.distance(Point3::new(middle.x, y, middle.z));
        *known = known.max(distance);
        let radius = libm::hypot(ends[0].distance(ends[1]), along[1] - along[0]) / 2.0;
        Self {
            ends,
            along,
            most: distance + radius,
        }
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

/// Bounds of the largest distance. `start` is a place in plan (y as z) at which it is probably large.
pub(super) fn farthest(surface: &Surface, machined: &Machined, start: Point2) -> [f64; 2] {
    let [width, depth] = surface.size();
    let segments = machined.clipped(0.0, width);
    let mut known: f64 = 0.0;
    let over = segments
        .iter()
        .filter(|[a, b]| a.x <= start.x && start.x <= b.x && a.x < b.x);
    for &[a, b] in over {
        let height = super::machined::height(a, b, start.x);
        known = known.max(surface.distance(Point3::new(start.x, start.z, height)));
    }
    let mut patches: BinaryHeap<Patch> = BinaryHeap::new();
    // Of a profile with very many segments only so many are looked at, each for all its neighbours: the bound of such a
    // group is that of one point plus the way to the others.
    let group = segments.len().div_ceil(MOST_PROBES / 4).max(1);
    let mut rest = 0.0_f64;
    for segments in segments.chunks(group) {
        let (Some(first), Some(last)) = (segments.first(), segments.last()) else {
            continue;
        };
        if let [segment] = segments {
            patches.push(Patch::new(surface, *segment, [0.0, depth], &mut known));
        } else {
            let whole = Patch::new(surface, [first[0], first[0]], [0.0, depth], &mut known);
            let way: f64 = segments.iter().map(|[a, b]| a.distance(*b)).sum();
            rest = rest.max(whole.most + way + first[0].distance(last[1]));
        }
    }
    let mut probes = patches.len();
    while let Some(patch) = patches.peek().copied() {
        if patch.most - known <= ENOUGH || probes >= MOST_PROBES {
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
            patches.push(Patch::new(surface, ends, along, &mut known));
            probes += 1;
        }
    }
    let most = patches.peek().map_or(0.0, |patch| patch.most);
    [known, most.max(rest).max(known)]
}
