//! Places at which a surface jumps, within the reach of a disc that moves.

use super::member::Turn;
use vcutc_backend_api::geometry::Point3;

/// Sides of the polygon around what a disc reaches.
const SIDES: u32 = 32;

/// Directions all around, of length 1.
#[derive(Clone, Debug)]
pub(super) struct Outline(Vec<[f64; 2]>);

impl Outline {
    pub(super) fn new() -> Self {
        let turn = |k: u32| {
            let (sine, cosine) = libm::sincos(core::f64::consts::TAU * f64::from(k) / f64::from(SIDES));
            [cosine, sine]
        };
        Self((0..SIDES).map(turn).collect())
    }

    /// How deep the part of a polygon that a disc comes over lies in its plane, the greater of both ends of its move.
    pub(super) fn deepest(&self, turn: &Turn, mut polygon: Vec<Point3>) -> Option<f64> {
        for &direction in &self.0 {
            let reach = turn.reach(direction);
            let beyond = |p: &Point3| p.x * direction[0] + p.y * direction[1] - reach;
            if polygon.iter().any(|p| beyond(p) > 0.0) {
                polygon = within(&polygon, &beyond);
            }
        }
        polygon
            .into_iter()
            .map(|place| turn.depth(place))
            .reduce(f64::max)
    }
}

/// What of a polygon, or of a segment, is not beyond a line.
fn within(polygon: &[Point3], beyond: &dyn Fn(&Point3) -> f64) -> Vec<Point3> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    let Some(mut last) = polygon.last().copied() else {
        return out;
    };
    let mut before = beyond(&last);
    for &point in polygon {
        let here = beyond(&point);
        if (before > 0.0) != (here > 0.0) {
            let share = before / (before - here);
            let part = |a: f64, b: f64| a + (b - a) * share;
            out.push(Point3::new(
                part(last.x, point.x),
                part(last.y, point.y),
                part(last.z, point.z),
            ));
        }
        if here <= 0.0 {
            out.push(point);
        }
        (last, before) = (point, here);
    }
    out
}
