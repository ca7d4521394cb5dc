//! Down along a circle, as a polygon of lines.
//!
//! A crusher does not cut at its centre: of the ground under it, its rim has to pass everything. Around a circle as wide as the tool the
//! centres lie opposite each other by its whole diameter, so no place stays under the tool all the way round, and none stands in the
//! middle. On a narrower one, a disc as wide as is missing to that is never passed by the rim. So the circle is as wide as the
//! tool where there is room, and narrower elsewhere.
//!
//! Not every control goes along a helix, nor along arcs in sloping planes, so it is a polygon whose corners lie on the circle: all of it is
//! farther from the walls than the circle.

use super::room::Room;
use core::f64::consts::{PI, TAU};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// A polygon round which the tool goes down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    pub centre: Place,
    /// The corner where it ends.
    pub last: Place,
    pub corners: u32,
}

/// The narrowest circle, in radii of the tool: on a narrower one, more than a quarter of the ground under the tool would never be passed
/// by its rim.
const NARROWEST: f64 = 0.5;

/// In how many steps circles become narrower.
const WIDTHS: u32 = 20;

/// In how many directions a middle is looked for.
const DIRECTIONS: u32 = 32;

/// How far away the middle lies at most, in radii of the tool.
const FARTHEST: f64 = 6.0;

/// How long sides are about, in mm, and how many there are.
const SIDE: f64 = 1.0;
const MOST_CORNERS: u32 = 16;
const FEWEST_CORNERS: u32 = 6;

/// How far the tool goes down along a side at least, in mm: points are rounded.
const LEAST_DROP: f64 = 0.01;

/// What is kept below the steepest way down: a share of it, and what rounding of both ends may add, in mm.
const CARE: f64 = 0.98;
const ROUNDING: f64 = 2e-3;

impl Helix {
    /// How wide it is, from its middle to its corners, in mm.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.centre.distance(self.last)
    }

    /// How long a side is, in mm.
    #[must_use]
    pub fn side(&self) -> f64 {
        2.0 * self.radius() * libm::sin(PI / f64::from(self.corners))
    }

    /// A corner, counted against the hands of a clock from the one where it ends.
    #[must_use]
    pub fn corner(&self, number: u32) -> Place {
        let number = number % self.corners;
        if number == 0 {
            return self.last;
        }
        let (sin, cos) = libm::sincos(TAU * f64::from(number) / f64::from(self.corners));
        let arm = self.last.minus(self.centre);
        self.centre.plus(arm.times(cos)).plus(arm.left().times(sin))
    }

    /// Along how many sides it goes down so far, in mm, no more steeply than `ramp`, in rad.
    #[must_use]
    pub fn sides_down(&self, drop: f64, ramp: f64) -> u32 {
        // The cast saturates, and a stock is at most 100 m high.
        libm::ceil(drop / drop_of(self.side(), ramp)).max(0.0) as u32
    }
}

/// How far down a side leads, in mm.
fn drop_of(side: f64, ramp: f64) -> f64 {
    side * libm::tan(ramp * CARE) - ROUNDING
}

/// The widest helix near a place from whose end a straight way leads there, and that way, if it has any length. Of equally wide ones it is
/// the one without a way; of those, the one whose middle is farthest from walls.
pub(super) fn near(first: Place, room: Room<'_>) -> Option<(Helix, Option<Piece>)> {
    (0..=WIDTHS).find_map(|step| {
        let share = 1.0 - (1.0 - NARROWEST) * f64::from(step) / f64::from(WIDTHS);
        around(first, share * room.radius, room)
    })
}

fn around(first: Place, wide: f64, room: Room<'_>) -> Option<(Helix, Option<Piece>)> {
    let sides = libm::floor(TAU * wide / SIDE / 2.0) as u32 * 2;
    let corners = sides.clamp(FEWEST_CORNERS, MOST_CORNERS);
    let side = 2.0 * wide * libm::sin(PI / f64::from(corners));
    if drop_of(side, room.ramp) < LEAST_DROP {
        return None;
    }
    let mut away = wide;
    while away <= FARTHEST * room.radius {
        let free = directions(first, room).filter_map(|to| {
            let centre = first.plus(to.times(away));
            let last = first.plus(to.times(away - wide));
            let to_wall = room.walls.distance(centre);
            let link = Piece::line(last, first);
            let has_room = to_wall >= room.keep + wide && (away <= wide || room.is_free(link));
            let helix = Helix {
                centre,
                last,
                corners,
            };
            has_room.then_some((to_wall, helix, (away > wide).then_some(link)))
        });
        // Where walls are missing all middles are as good; the first one is taken.
        let best = free.reduce(|best, other| if other.0 > best.0 { other } else { best });
        if let Some((_, helix, link)) = best {
            return Some((helix, link));
        }
        away += room.radius / 2.0;
    }
    None
}

/// Directions in which a middle may lie, of length 1: straight away from the nearest wall first.
fn directions(first: Place, room: Room<'_>) -> impl Iterator<Item = Place> {
    let nearest = room.walls.nearest(first);
    let inwards = nearest.filter(|near| near.distance > 0.0);
    let inwards = inwards.map(|near| first.minus(near.at).times(1.0 / near.distance));
    let others = (0..DIRECTIONS).map(|direction| {
        let (sin, cos) = libm::sincos(TAU * f64::from(direction) / f64::from(DIRECTIONS));
        Place::new(cos, sin)
    });
    inwards.into_iter().chain(others)
}
