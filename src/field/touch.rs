//! Circles that touch the boundary at a given place and grow until they touch it elsewhere.
//!
//! Their centres are the medial axis: every edge sees its part of the axis as a function of the place on it, which closed
//! forms give for every other wall. Nothing is traced, so nothing gets lost on the way.

use crate::wall::{Bend, Boundary, Shape, angle};
use vcutc_region::place::Place;

/// Circles touch a wall that ends up to this far from the foot, in mm: at corners feet are the ends, up to rounding.
const ENDS: f64 = 1e-9;

/// Circles that grow from an open side do not meet it: it is met from this radius on, in mm.
const OFF_OPEN: f64 = 1e-9;

/// Walls on which a circle rolls without ever touching: the sine squared of half the angle to them is below this.
const ROLLS: f64 = 1e-9;

/// Of walls as near as this share one is taken, the same for all neighbouring places: first the own arc, whose centre is one
/// circle for all of its places, then by number.
const SAME_AS_OWN: f64 = 1e-9;
const SAME: f64 = 1e-13;

/// What stops a circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Touched {
    /// The arc from which it grows: its centre has come to that of the arc.
    Own,
    /// An open side, which its centre has come to.
    Open,
    /// A wall, by number; corners are counted after all walls.
    Wall(usize),
}

/// A circle in the region that touches the boundary at two places.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) centre: Place,
    pub(crate) radius: f64,
    pub(crate) touched: Touched,
}

/// The circle that touches the wall or corner numbered `own` at a place, with its centre in the direction of the normal
/// there. None where nothing stops it.
pub(crate) fn circle(boundary: &Boundary, own: usize, place: Place, normal: Place) -> Option<Circle> {
    let mut best = match boundary.walls.get(own) {
        Some(&Shape::Arc {
            radius,
            bend: Bend::Hollow,
            ..
        }) => Some((radius, Touched::Own)),
        _ => None,
    };
    for open in &boundary.open {
        offer(&mut best, to_crossing(open, place, normal), Touched::Open);
    }
    // What meets the own wall or corner is touched at the place itself, or nowhere.
    let count = boundary.walls.len();
    let own_corner = own
        .checked_sub(count)
        .and_then(|corner| boundary.corners.get(corner));
    let meets = |number: usize| own_corner.is_some_and(|corner| corner.walls.contains(&Some(number)));
    // A circle through the place touches only what lies within its diameter.
    let reach = |best: &Option<(f64, Touched)>| {
        best.map_or(f64::INFINITY, |(radius, _)| 2.0 * radius * (1.0 + SAME_AS_OWN))
    };
    let first = reach(&best);
    boundary.tree.around(place, first, &mut |number| {
        let number = number as usize;
        let radius = match (boundary.walls.get(number), number.checked_sub(count)) {
            (Some(wall), _) if number != own && !meets(number) => to_wall(wall, place, normal),
            (None, Some(corner)) if number != own => {
                let corner = boundary.corners.get(corner);
                let corner = corner.filter(|corner| !corner.walls.contains(&Some(own)));
                corner.and_then(|corner| to_point(corner.place, place, normal))
            }
            _ => None,
        };
        offer(&mut best, radius, Touched::Wall(number));
        reach(&best)
    });
    best.map(|(radius, touched)| Circle {
        centre: place.plus(normal.times(radius)),
        radius,
        touched,
    })
}

/// Takes a radius that is less than the best one; of equal ones that of the lower number.
fn offer(best: &mut Option<(f64, Touched)>, radius: Option<f64>, touched: Touched) {
    let Some(radius) = radius.filter(|radius| radius.is_finite()) else {
        return;
    };
    let is_better = best.is_none_or(|(least, before)| {
        let same = if before == Touched::Own { SAME_AS_OWN } else { SAME };
        let limit = if touched < before {
            least * (1.0 + same)
        } else {
            least * (1.0 - same)
        };
        radius < limit
    });
    if is_better {
        *best = Some((radius, touched));
    }
}

/// `|p + r n - q| = r`, for r.
fn to_point(point: Place, place: Place, normal: Place) -> Option<f64> {
    let way = point.minus(place);
    let ahead = 2.0 * normal.dot(way);
    (ahead > 0.0).then(|| way.dot(way) / ahead)
}

fn to_wall(wall: &Shape, place: Place, normal: Place) -> Option<f64> {
    match *wall {
        Shape::Line { from, along, length } => {
            let way = place.minus(from);
            let height = along.cross(way);
            // Towards the circle: (h + r n m) = r.
            let side = along.left().times(if height < 0.0 { -1.0 } else { 1.0 });
            let away = 1.0 - normal.dot(side);
            let radius = (away > ROLLS).then(|| height.abs() / away)?;
            let foot = along.dot(way) + radius * along.dot(normal);
            (-ENDS..=length + ENDS).contains(&foot).then_some(radius)
        }
        Shape::Arc {
            centre,
            radius: bow,
            middle,
            half,
            ..
        } => {
            let way = place.minus(centre);
            let distance = way.length();
            // |w|^2 - rho^2, and |w + r n| = rho + r or rho - r.
            let beyond = (distance - bow) * (distance + bow);
            let away = if beyond >= 0.0 {
                bow - normal.dot(way)
            } else {
                bow + normal.dot(way)
            };
            let radius = (away > ROLLS * bow).then(|| beyond.abs() / (2.0 * away))?;
            let towards = way.plus(normal.times(radius));
            let is_met = angle(middle, towards).abs() <= half + ENDS / bow;
            is_met.then_some(radius)
        }
    }
}

/// How far along the normal it meets an open side.
fn to_crossing(open: &Shape, place: Place, normal: Place) -> Option<f64> {
    match *open {
        Shape::Line { from, along, length } => {
            let rate = along.cross(normal);
            let radius = -along.cross(place.minus(from)) / rate;
            let foot = along.dot(place.minus(from)) + radius * along.dot(normal);
            (rate < 0.0 && radius >= 0.0 && (0.0..=length).contains(&foot)).then_some(radius)
        }
        Shape::Arc {
            centre,
            radius: bow,
            middle,
            half,
            ..
        } => {
            let way = place.minus(centre);
            let middle_way = -normal.dot(way);
            let root = middle_way * middle_way - (way.dot(way) - bow * bow);
            if root < 0.0 {
                return None;
            }
            [middle_way - root.sqrt(), middle_way + root.sqrt()]
                .into_iter()
                .find(|&radius| {
                    let towards = way.plus(normal.times(radius));
                    radius > OFF_OPEN && angle(middle, towards).abs() <= half
                })
        }
    }
}
