//! Small boxes, clipped by half planes.

use super::Square;
use crate::curve::Curve;
use crate::place::Place;
use crate::rounded::{part, parts_in_circle};

/// A convex polygon within a small circle.
pub(super) struct Scrap {
    corners: Vec<Place>,
    spare: Vec<Place>,
    middle: Place,
    /// Radius of the circle, in mm.
    size: f64,
}

impl Scrap {
    pub(super) const fn new() -> Self {
        Self {
            corners: Vec::new(),
            spare: Vec::new(),
            middle: Place::new(0.0, 0.0),
            size: 0.0,
        }
    }

    /// Begins with a whole box.
    pub(super) fn restart(&mut self, square: Square) {
        self.corners.clear();
        self.corners.extend(corners(square));
        self.middle = middle(square);
        self.size = half_diagonal(square);
    }

    /// Takes away what a piece has within `reach`, as far as a half plane can.
    pub(super) fn cut_within(&mut self, curve: &Curve, reach: f64) {
        let (middle, size) = (self.middle, self.size);
        if curve.is_beside(middle, -size) {
            let left = curve.left_of(middle);
            let away = gradient(curve, middle).times(left.signum());
            // From the hollow side the reach bulges towards the box, from the other it does not.
            let bulge = curve.bend * left.signum();
            let radius = reach - 1.0 / bulge;
            let loss = if bulge < 0.0 { sagitta(radius, size) } else { 0.0 };
            self.keep_beyond(away, reach - left.abs() - loss);
            return;
        }
        let foot = curve.nearest(middle);
        if foot.distance > 0.0 && size < reach {
            let away = middle.minus(foot.at).times(1.0 / foot.distance);
            self.keep_beyond(away, reach - foot.distance - sagitta(reach, size));
        }
    }

    /// Keeps what some pieces have within `reach`, and some more.
    pub(super) fn keep_within(&mut self, curves: &[&Curve], reach: f64) {
        if let &[curve] = curves
            && curve.is_beside(self.middle, -self.size)
        {
            self.keep_beside(curve, reach);
            return;
        }
        if let &[curve] = curves
            && !curve.is_beside(self.middle, self.size)
        {
            self.keep_around_ends(curve, reach);
            return;
        }
        let feet = curves.iter().map(|curve| curve.nearest(self.middle));
        let Some(foot) = feet.min_by(|a, b| a.distance.total_cmp(&b.distance)) else {
            return;
        };
        if foot.distance > 0.0 {
            let away = self.middle.minus(foot.at).times(1.0 / foot.distance);
            // What has the box within its reach goes no farther away from the nearest place than so much, and the reach ends so
            // much beyond.
            let mut most = f64::NEG_INFINITY;
            for curve in curves {
                parts_in_circle(curve, self.middle, reach + self.size, &mut |from, to| {
                    let part = Curve::of(part(curve.piece, from, to));
                    most = most.max(farthest(&part, away));
                });
            }
            self.keep_beyond(away.times(-1.0), away.dot(self.middle) - most - reach);
        }
    }

    /// Keeps what a piece has within `reach` that all of the box lies beside.
    fn keep_beside(&mut self, curve: &Curve, reach: f64) {
        let left = curve.left_of(self.middle);
        let back = gradient(curve, self.middle).times(-left.signum());
        // What lies on the hollow side is what a circle leaves outside of it.
        let bulge = curve.bend * left.signum();
        let radius = 1.0 / bulge - reach;
        if bulge > 0.0 && radius <= 0.0 {
            return;
        }
        let loss = if bulge > 0.0 {
            sagitta(radius, self.size)
        } else {
            0.0
        };
        self.keep_beyond(back, left.abs() - reach - loss);
    }

    /// Keeps what a piece has within `reach` of an end, if that is one end only. No place of the box is beside the piece.
    fn keep_around_ends(&mut self, curve: &Curve, reach: f64) {
        let [from, to] = [curve.piece.from, curve.piece.to].map(|end| (end.distance(self.middle), end));
        let (near, far) = if from.0 <= to.0 { (from, to) } else { (to, from) };
        if near.0 > 0.0 && far.0 > reach + self.size {
            let back = near.1.minus(self.middle).times(1.0 / near.0);
            self.keep_beyond(back, near.0 - reach);
        }
    }

    /// Keeps what lies to the left of an edge, and some more.
    pub(super) fn keep_left(&mut self, edge: &Curve) {
        let loss = if edge.bend < 0.0 {
            sagitta(-1.0 / edge.bend, self.size)
        } else {
            0.0
        };
        let left = edge.left_of(self.middle);
        self.keep_beyond(gradient(edge, self.middle), -left - loss);
    }

    /// Keeps the half plane `normal.(x - middle) >= least`.
    fn keep_beyond(&mut self, normal: Place, least: f64) {
        // In the centre of an arc there is no normal, and some bounds have no end.
        if !(normal.square().is_finite() && least.is_finite()) {
            return;
        }
        let height = |place: Place| normal.dot(place.minus(self.middle)) - least;
        self.spare.clear();
        let next = self.corners.iter().cycle().skip(1);
        for (&from, &to) in self.corners.iter().zip(next) {
            let (start, end) = (height(from), height(to));
            if start >= 0.0 {
                self.spare.push(from);
            }
            if (start >= 0.0) != (end >= 0.0) {
                self.spare.push(from.lerp(to, start / (start - end)));
            }
        }
        core::mem::swap(&mut self.corners, &mut self.spare);
    }

    pub(super) fn area(&self) -> f64 {
        let Some(&first) = self.corners.first() else {
            return 0.0;
        };
        let pairs = self.corners.windows(2);
        let crosses = pairs.map(|pair| match pair {
            &[from, to] => from.minus(first).cross(to.minus(first)),
            _ => 0.0,
        });
        (crosses.sum::<f64>() / 2.0).max(0.0)
    }
}

/// The direction in which the distance to the left of a piece grows fastest: a vector of length 1.
fn gradient(curve: &Curve, place: Place) -> Place {
    let normal = curve.normal.minus(place.minus(curve.middle).times(curve.bend));
    normal.times(1.0 / normal.square().sqrt())
}

/// How far a piece goes in a direction, from the origin.
fn farthest(curve: &Curve, direction: Place) -> f64 {
    let side = direction.left();
    let turning = [side, side.times(-1.0)].map(|along| curve.where_it_goes(along));
    let places = turning
        .into_iter()
        .flatten()
        .chain([curve.piece.from, curve.piece.to]);
    places
        .map(|place| direction.dot(place))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// How far a circle departs from its tangent within `half` to either side; without end where it does not go so far.
fn sagitta(radius: f64, half: f64) -> f64 {
    if half < radius {
        half * half / (radius + ((radius - half) * (radius + half)).sqrt())
    } else {
        f64::INFINITY
    }
}

pub(super) fn corners(square: Square) -> [Place; 4] {
    let (low, side) = (square.low, square.side);
    let high = Place::new(low.x + side, low.y + side);
    [low, Place::new(high.x, low.y), high, Place::new(low.x, high.y)]
}

pub(super) fn middle(square: Square) -> Place {
    let half = square.side / 2.0;
    square.low.plus(Place::new(half, half))
}

pub(super) fn half_diagonal(square: Square) -> f64 {
    square.side * core::f64::consts::FRAC_1_SQRT_2
}
