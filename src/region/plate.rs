//! A flat blade that stands upright in the plan, seen from above: a rectangle about its way.
//!
//! The edges of a straight blade meet in its tip, so the higher over the tip, the farther it reaches ahead of the tip and behind
//! it. Walls are upright: what matters is the widest place, at the height of the top of the walls.

use crate::distance::{Nearest, Walls};
use crate::piece::Piece;
use crate::place::Place;
use core::f64::consts::FRAC_PI_2;

/// How far a blade reaches from its tip along its way, in mm, both at least 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    pub behind: f64,
    pub ahead: f64,
}

impl Reach {
    /// Of a blade that reaches no farther than its tip.
    pub const NONE: Self = Self {
        behind: 0.0,
        ahead: 0.0,
    };

    /// Of a blade with this half apex angle at this rake, in rad, between the tip and a height over it, in mm.
    ///
    /// At the height u the blade lies between `u cot(rake + half_apex)` and `u cot(rake - half_apex)` ahead of its tip.
    #[must_use]
    pub fn at(rake: f64, half_apex: f64, height: f64) -> Self {
        // The tangent of what is missing from a right angle.
        let ahead = |edge: f64| height * libm::tan(FRAC_PI_2 - edge);
        Self {
            behind: (-ahead(rake + half_apex)).max(0.0),
            ahead: ahead(rake - half_apex).max(0.0),
        }
    }
}

/// A blade on its way along a line or an arc, in the plane of its way throughout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The way of the tip.
    pub way: Piece,
    /// How far the blade reaches along it where it begins, and where it ends. Along an arc the larger of both counts.
    pub reaches: [Reach; 2],
    /// Half the thickness of the blade, in mm.
    pub half: f64,
}

impl Stroke {
    /// The blade at the beginning (0) of the way, at its end (1), or between: the rectangle that it covers, a side each.
    #[must_use]
    pub fn stand(&self, share: f64) -> [Piece; 4] {
        let at = self.way.at(share);
        let ahead = self.way.direction(share);
        let [from, to] = self.reaches;
        let between = |from: f64, to: f64| from + (to - from) * share;
        rectangle(
            at,
            ahead,
            [-between(from.behind, to.behind), between(from.ahead, to.ahead)],
            self.half,
        )
    }

    /// Lines and arcs among which is the boundary of all that the blade passes.
    ///
    /// Along a line: how far the blade reaches ahead is a convex function of the way, if it turns at a constant rate in its
    /// plane (the cotangent is convex where it is positive), and so is where its end is. So the ends of the way bound it.
    #[must_use]
    pub fn outline(&self) -> Vec<Piece> {
        match self.way.centre() {
            None => self.along_line().to_vec(),
            Some(centre) => self.along_arc(centre),
        }
    }

    fn along_line(&self) -> [Piece; 4] {
        let long = self.way.length();
        let [from, to] = self.reaches;
        let low = (-from.behind).min(long - to.behind);
        let high = from.ahead.max(long + to.ahead);
        rectangle(self.way.from, self.way.direction(0.0), [low, high], self.half)
    }

    /// Sides at both ends, and the ways of the corners and of the side towards the centre where it is nearest to it.
    fn along_arc(&self, centre: Place) -> Vec<Piece> {
        let reach = self.widest();
        let whole = Self {
            reaches: [reach; 2],
            ..*self
        };
        let mut outline: Vec<Piece> = [0.0, 1.0].iter().flat_map(|&share| whole.stand(share)).collect();
        let begin = self.way.from;
        let ahead = self.way.direction(0.0);
        let corners = [self.half, -self.half]
            .map(|aside| [0.0, -reach.behind, reach.ahead].map(|along| moved(begin, ahead, [along, aside])));
        for corner in corners.into_iter().flatten() {
            let end = turned(corner, centre, self.way.sweep);
            outline.push(Piece::arc(corner, end, self.way.sweep));
        }
        outline
    }

    fn widest(&self) -> Reach {
        let [from, to] = self.reaches;
        Reach {
            behind: from.behind.max(to.behind),
            ahead: from.ahead.max(to.ahead),
        }
    }

    /// Whether the blade passes a place.
    #[must_use]
    pub fn passes(&self, place: Place) -> bool {
        match self.way.centre() {
            None => {
                let sides = self.along_line();
                sides.iter().all(|side| {
                    let way = side.to.minus(side.from);
                    way.cross(place.minus(side.from)) >= 0.0
                })
            }
            Some(centre) => self.passes_on_arc(centre, place),
        }
    }

    /// Seen from the centre the blade is a rectangle that turns: a place is passed where it is in it at some time.
    fn passes_on_arc(&self, centre: Place, place: Place) -> bool {
        let from_centre = place.minus(centre);
        let far = from_centre.length();
        let radius = self.way.from.distance(centre);
        let reach = self.widest();
        // Seen along the way: how far ahead of the tip the place may lie, as an angle.
        let [low, high] =
            [-reach.behind, reach.ahead].map(|along| libm::asin((along / far).clamp(-1.0, 1.0)));
        let [near, wide] =
            [radius + self.half, radius - self.half].map(|side| libm::acos((side / far).clamp(-1.0, 1.0)));
        if far < radius - self.half {
            return false;
        }
        let turn = self.way.sweep.signum();
        let begin = self.way.from.minus(centre);
        let angle = turn * libm::atan2(begin.cross(from_centre), begin.dot(from_centre));
        let sweep = self.way.sweep.abs();
        [[near, wide], [-wide, -near]].iter().any(|[from, to]| {
            let (from, to) = (from.max(low), to.min(high));
            // The tip has turned by the place's angle less what the place is ahead.
            let times = [angle - to, angle - from];
            let round = core::f64::consts::TAU;
            from <= to
                && [-round, 0.0, round]
                    .iter()
                    .any(|by| times[0] + by <= sweep && times[1] + by >= 0.0)
        })
    }

    /// How near the blade comes to walls, and where; none without walls. A wall that is passed as a whole is at distance 0.
    #[must_use]
    pub fn nearest_to(&self, walls: &Walls) -> Option<(Place, Nearest)> {
        let near = self
            .outline()
            .into_iter()
            .filter_map(|side| walls.nearest_to(side));
        near.min_by(|(_, one), (_, other)| one.distance.total_cmp(&other.distance))
    }
}

/// A rectangle about a place, counter-clockwise: from its first to its last place along a direction, and to both sides of that.
fn rectangle(at: Place, ahead: Place, [from, to]: [f64; 2], half: f64) -> [Piece; 4] {
    let corner = |along: f64, aside: f64| moved(at, ahead, [along, aside]);
    let corners = [
        corner(from, -half),
        corner(to, -half),
        corner(to, half),
        corner(from, half),
    ];
    let [a, b, c, d] = corners;
    [(a, b), (b, c), (c, d), (d, a)].map(|(from, to)| Piece::line(from, to))
}

/// A place so far along a direction, and to the left of it.
fn moved(at: Place, ahead: Place, [along, aside]: [f64; 2]) -> Place {
    at.plus(ahead.times(along)).plus(ahead.left().times(aside))
}

/// A place turned about a centre.
fn turned(place: Place, centre: Place, angle: f64) -> Place {
    let (sin, cos) = libm::sincos(angle);
    let from = place.minus(centre);
    centre.plus(from.times(cos)).plus(from.left().times(sin))
}

#[cfg(test)]
mod tests;
