//! How the axes move along a way: their derivatives by the part of it that is done.

use super::chebyshev::{DEGREE, PARTS, POINTS, Weights};
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_machine::kinematics::Joints;

/// Derivatives of an axis value by the part of the way that is done, which goes from 0 to 1; in rad or mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Slopes {
    pub(super) first: f64,
    pub(super) second: f64,
    pub(super) third: f64,
}

/// A part of a way, along which so many things move: the axes, and for chains what else has bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part<const N: usize = MOST_AXES> {
    /// Its share of the way.
    pub(super) length: f64,
    /// The axes in its middle.
    pub(super) axes: [Slopes; N],
}

impl<const N: usize> Part<N> {
    /// The same with its way measured otherwise: all of it is so long.
    pub(super) fn over(self, length: f64) -> Self {
        Self {
            length: self.length * length,
            axes: self.axes.map(|slopes| Slopes {
                first: slopes.first / length,
                second: slopes.second / (length * length),
                third: slopes.third / (length * length * length),
            }),
        }
    }
}

/// How large the rest of a series may be, in rad or mm: it makes second derivatives wrong by a thousandth of a rad (a mm) at
/// most, where a way of that many rad would be.
const REST: f64 = 1e-8;
/// Shortest stretch that is divided further, as a share of the way.
const SHORTEST: f64 = 1.0 / 128.0;

/// The parts of a way along which `joints_at` gives the axes at a place, each angle within half a turn of those it is given.
/// None where it gives none.
pub(super) fn parts(
    weights: &Weights,
    start: &Joints,
    joints_at: impl Fn(f64, &Joints) -> Option<Joints>,
) -> Option<Vec<Part>> {
    let mut parts = Vec::with_capacity(PARTS);
    let mut near = *start;
    // Stretches still to do, the next one last.
    let mut left = vec![(0.0, 1.0)];
    while let Some((begin, end)) = left.pop() {
        let way: f64 = end - begin;
        let mut values = [[0.0; POINTS]; MOST_AXES];
        let mut joints = near;
        for (k, point) in weights.points.iter().enumerate() {
            joints = joints_at(begin + way * point, &joints)?;
            for (values, joint) in values.iter_mut().zip(joints) {
                values[k] = joint;
            }
        }
        let is_smooth = values
            .iter()
            .all(|values| weights.rest(values) <= REST * scale(values));
        if !is_smooth && way > SHORTEST {
            let middle = begin + way / 2.0;
            left.push((middle, end));
            left.push((begin, middle));
            continue;
        }
        near = joints;
        append(&mut parts, weights, way, &values);
    }
    Some(parts)
}

/// Numbers that are large have lost digits that small ones keep.
fn scale(values: &[f64; POINTS]) -> f64 {
    let moved = values[DEGREE] - values[0];
    values[0].abs().max(moved.abs()).max(1.0)
}

fn append(parts: &mut Vec<Part>, weights: &Weights, way: f64, values: &[[f64; POINTS]; MOST_AXES]) {
    let first = parts.len();
    let lengths = weights.ends.iter().zip(weights.ends.iter().skip(1));
    parts.extend(lengths.map(|(begin, end)| Part {
        length: way * (end - begin),
        axes: [Slopes::default(); MOST_AXES],
    }));
    for (axis, values) in values.iter().enumerate() {
        let found = weights.derivatives(values);
        for (part, [first, second, third]) in parts.iter_mut().skip(first).zip(found) {
            part.axes[axis] = Slopes {
                first: first / way,
                second: second / (way * way),
                third: third / (way * way * way),
            };
        }
    }
}
