//! Convex polygons in plan, and what is left of them without others.
//!
//! Borders of triangles are computed from the lesser of their ends on, so that neighbours have the same line between them, with
//! its sides exchanged. What lies beyond a line by less than [`SLACK`] counts as on it: cutting along neighbours leaves no
//! slivers.

use vcutc_backend_api::geometry::Point3;

/// The corners of a convex polygon in plan, in order, in mm.
pub(crate) type Region = Vec<[f64; 2]>;

/// What lies this near to a line in mm lies on it.
pub(crate) const SLACK: f64 = 1e-8;

/// All places on one side of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Half {
    /// Of length 1, pointing out.
    normal: [f64; 2],
    offset: f64,
}

impl Half {
    pub(crate) const fn new(normal: [f64; 2], offset: f64) -> Self {
        Self { normal, offset }
    }

    /// How far a place lies outside.
    pub(crate) fn beyond(self, place: [f64; 2]) -> f64 {
        self.normal[0] * place[0] + self.normal[1] * place[1] - self.offset
    }

    /// What it leaves out.
    const fn other(self) -> Self {
        Self {
            normal: [-self.normal[0], -self.normal[1]],
            offset: -self.offset,
        }
    }

    const fn grown(self, by: f64) -> Self {
        Self {
            offset: self.offset + by,
            ..self
        }
    }

    /// The side of the line between two places that a third one lies on.
    fn between(a: [f64; 2], b: [f64; 2], inner: [f64; 2]) -> Option<Self> {
        let is_first = a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
        let (a, b) = if is_first { (a, b) } else { (b, a) };
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = (dx * dx + dy * dy).sqrt();
        let normal = [dy / length, -dx / length];
        let half = Self::new(normal, normal[0] * a[0] + normal[1] * a[1]);
        let beyond = half.beyond(inner);
        // Upright triangles have no sides; NaN compares as false.
        if beyond > SLACK / 10.0 {
            Some(half.other())
        } else if beyond < -SLACK / 10.0 {
            Some(half)
        } else {
            None
        }
    }
}

/// The three sides of a triangle in plan; none of one that stands upright.
pub(crate) fn sides(face: [Point3; 3]) -> Option<[Half; 3]> {
    let [a, b, c] = face.map(|p| [p.x, p.y]);
    Some([
        Half::between(a, b, c)?,
        Half::between(b, c, a)?,
        Half::between(a, c, b)?,
    ])
}

/// Sides of a triangle in plan, moved out by `by`, and of the box around it, moved out as far: its corners grow by no more
/// than half again as much.
pub(crate) fn grown_sides(face: [Point3; 3], by: f64) -> Option<[Half; 7]> {
    let [a, b, c] = sides(face)?.map(|half| half.grown(by));
    let most = |part: fn(&Point3) -> f64| face.iter().map(part).fold(f64::NEG_INFINITY, f64::max) + by;
    let right = Half::new([1.0, 0.0], most(|p| p.x));
    let left = Half::new([-1.0, 0.0], most(|p| -p.x));
    let back = Half::new([0.0, 1.0], most(|p| p.y));
    let front = Half::new([0.0, -1.0], most(|p| -p.y));
    Some([a, b, c, right, left, back, front])
}

/// A rectangle.
pub(crate) fn rectangle([low, high]: [[f64; 2]; 2]) -> Region {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// What of a region lies in a half-plane.
pub(crate) fn within(region: &[[f64; 2]], half: Half) -> Region {
    let mut out = Region::with_capacity(region.len() + 1);
    let Some(mut last) = region.last().copied() else {
        return out;
    };
    let mut before = half.beyond(last);
    for &place in region {
        let here = half.beyond(place);
        if (before > 0.0) != (here > 0.0) {
            let share = before / (before - here);
            out.push([
                last[0] + (place[0] - last[0]) * share,
                last[1] + (place[1] - last[1]) * share,
            ]);
        }
        if here <= 0.0 {
            out.push(place);
        }
        (last, before) = (place, here);
    }
    out
}

/// What of regions lies outside of a common part of half-planes, in place of them.
pub(crate) fn subtract(regions: &mut Vec<Region>, cutter: &[Half]) {
    let count = regions.len();
    for place in 0..count {
        let Some(region) = regions.get_mut(place) else {
            break;
        };
        let misses = |half: &Half| region.iter().all(|&place| half.beyond(place) >= -SLACK);
        if cutter.iter().any(misses) {
            continue;
        }
        let mut rest = core::mem::take(region);
        for &half in cutter {
            if rest.iter().any(|&place| half.beyond(place) > SLACK) {
                let outside = within(&rest, half.other());
                rest = within(&rest, half);
                if outside.len() >= 3 {
                    regions.push(outside);
                }
                if rest.len() < 3 {
                    break;
                }
            }
        }
    }
    regions.retain(|region| !region.is_empty());
}

/// Its area, in mm2.
pub(crate) fn area(region: &[[f64; 2]]) -> f64 {
    fan(region).map(|triangle| twice_area(triangle).abs() / 2.0).sum()
}

/// The triangles that its first corner forms with its sides.
pub(crate) fn fan(region: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 3]> + '_ {
    let first = region.first().copied().unwrap_or_default();
    region
        .windows(2)
        .skip(1)
        .map(move |pair| [first, pair[0], pair[1]])
}

pub(crate) fn twice_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The mean of its corners: a place in it.
pub(crate) fn middle(region: &[[f64; 2]]) -> [f64; 2] {
    let count = region.len().max(1) as f64;
    [0, 1].map(|axis| region.iter().map(|place| place[axis]).sum::<f64>() / count)
}

/// Its least width, over the directions of its sides; the least one of all is among them.
pub(crate) fn width(region: &[[f64; 2]]) -> f64 {
    let Some(last) = region.last().filter(|_| region.len() >= 3) else {
        return 0.0;
    };
    let starts = core::iter::once(last).chain(region);
    starts
        .zip(region)
        .filter(|(a, b)| a != b)
        .map(|(a, b)| {
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = (dx * dx + dy * dy).sqrt();
            let far = |p: &[f64; 2]| twice_area([*a, *b, *p]).abs() / length;
            region.iter().map(far).fold(0.0, f64::max)
        })
        // None of a region all of whose corners are one place.
        .reduce(f64::min)
        .unwrap_or(0.0)
}
