//! Slits along the walls of a region, by a straight blade that stands in the plane of its way.
//!
//! Where walls go on into each other the blade goes on along them; at corners it ends, is lifted, and begins
//! again:
//!
//! | Wall | The tip | What stays at its foot |
//! | --- | --- | --- |
//! | straight | beside the wall, half the thickness of the blade away | nothing |
//! | an arc that bulges into the region | as far away from it; the blade's ends swing away from the wall | nothing |
//! | a hollow arc of the radius rho | about its centre, at the radius `sqrt(rho^2 - a^2)` less half the thickness: at the top the corners of the blade, `a` ahead of the tip and `a` after it, touch the wall | `rho - sqrt(rho^2 - a^2)` |
//!
//! Towards an inward corner, or a hollow arc, the leading edge stands upright, and away from one the trailing edge does: so nothing
//! of the blade is beyond its tip. Hollow arcs that go on into each other are one slit, at the distance that the tightest of them
//! asks for; the blade is square to its way there, so beside corners at their ends it leaves what its reach is.

use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::plate::Reach;
use crate::region::{Edge, Loop, Region, Side};
use core::f64::consts::FRAC_PI_2;

mod room;

/// A straight blade at a depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knife {
    /// Half the angle between its edges, in rad.
    pub half_apex: f64,
    /// Half its thickness, in mm.
    pub half: f64,
    /// How far its side keeps from walls, in mm; positive.
    pub keep: f64,
    /// How high the walls are over its tip, in mm.
    pub height: f64,
    /// How far it runs out beyond open sides, in mm.
    pub run_out: f64,
    /// How far points of programs may be off by rounding, in mm.
    pub grid: f64,
}

/// A slit: a way at depth without a stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Slit {
    /// Its lines and arcs, at least one, each beginning where the one before it ends, in its direction.
    pub pieces: Vec<SlitPiece>,
    pub begins: Begin,
}

/// A line or an arc of a slit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlitPiece {
    pub way: Piece,
    /// The angle between blade and way where it begins and where it ends, in rad.
    pub rakes: [f64; 2],
}

/// Where a slit begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begin {
    /// Within the material.
    Within,
    /// Beyond an open side, clear of the material.
    Beside,
}

/// Why a blade does not follow the walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Misfit {
    /// A hollow arc in which the blade has no room at the top of the wall.
    Tight {
        /// Which of [`Region::edges`].
        edge: usize,
        /// Its radius, in mm.
        radius: f64,
    },
    /// A wall that is too short, or too near to another one.
    NoRoom {
        /// Which of [`Region::edges`].
        edge: usize,
        /// A place of it.
        at: Place,
    },
}

impl Knife {
    fn reach(&self, rake: f64) -> Reach {
        Reach::at(rake, self.half_apex, self.height)
    }

    /// How far the tip keeps from walls that are not hollow.
    fn standoff(&self) -> f64 {
        self.half + self.keep
    }

    /// How much the walls may turn where a slit goes through, in rad: ahead of its tip the blade is off by half a micrometre then.
    fn kink(&self) -> f64 {
        (OFF / self.reach(FRAC_PI_2 + self.half_apex).behind).min(TANGENT)
    }

    /// The radius of the tip's way along a hollow arc; none where the blade has no room in it.
    #[must_use]
    pub fn radius_within(&self, hollow: f64) -> Option<f64> {
        let (free, along) = (hollow - self.keep, self.reach(FRAC_PI_2).ahead);
        let radius = libm::sqrt((free * free - along * along).max(0.0)) - self.half;
        (free > along && radius > LEAST_RADIUS).then_some(radius)
    }

    /// The same blade, kept so much farther from the wall that it may be turned out of the direction of its way by what rounding does
    /// to an arc of this length.
    fn on_arc(&self, length: f64) -> Self {
        let reach = self.reach(FRAC_PI_2 + self.half_apex).behind;
        Self {
            keep: self.keep + 4.0 * self.grid * reach / length,
            ..*self
        }
    }

    /// The least radius of a hollow arc, in mm, at whose foot the side of the blade is within `far` of the wall; none where `far` is at
    /// most what the blade keeps.
    #[must_use]
    pub fn least_radius(&self, far: f64) -> Option<f64> {
        let along = self.reach(FRAC_PI_2).ahead;
        let (keep, more) = (self.keep, far - self.keep);
        (more > 0.0).then(|| (along * along + far * far - keep * keep) / (2.0 * more))
    }

    /// How high the walls of a hollow arc of a radius may be, in mm, so that at their foot the side of the blade is within `far` of them.
    #[must_use]
    pub fn most_height(&self, radius: f64, far: f64) -> f64 {
        let (free, tip) = (radius - self.keep, radius - far);
        libm::sqrt((free * free - tip * tip).max(0.0)) / libm::tan(self.half_apex)
    }
}

/// The smallest arc of a tip, in mm: on smaller ones the grid of programs is a hundredth of the radius.
const LEAST_RADIUS: f64 = 0.1;

/// Walls that turn by more, in rad, do not go on into each other.
const TANGENT: f64 = 1e-4;

/// How far a blade may be off where walls turn, in mm.
const OFF: f64 = 5e-4;

/// How a wall and the next one meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Joint {
    /// They go on into each other, and so does the blade.
    Through,
    /// At an inward corner, or at the end of a hollow arc: nothing of the blade may be beyond.
    Closed,
    /// At a corner that points into the region: the blade may go on beyond.
    Convex,
    /// One of them is an open side.
    Open,
}

/// Walls that go on into each other.
struct Run<'r> {
    /// With their numbers in the region.
    edges: Vec<(usize, &'r Edge)>,
    /// What is before and after them.
    joints: [Joint; 2],
    /// How much the walls turn there, in rad, positive to the left.
    turns: [f64; 2],
    /// The open sides there, if there are any.
    open: [Option<Piece>; 2],
}

/// The slits along all walls of a region, loop by loop.
///
/// # Errors
/// The blade does not follow some wall.
pub fn slits(region: &Region, knife: Knife) -> Result<Vec<Slit>, Misfit> {
    let walls = Walls::of(region);
    let mut first = 0;
    let mut slits = Vec::new();
    for ring in region.loops() {
        for run in runs(ring, first, knife.kink()) {
            slits.extend(room::slit(&run, knife, &walls)?);
        }
        first += ring.len();
    }
    Ok(slits)
}

/// The runs of walls of a loop, the first of whose edges has this number in the region. A slit goes through where walls turn by no more
/// than `kink`.
fn runs(ring: &Loop, first: usize, kink: f64) -> Vec<Run<'_>> {
    let count = ring.len();
    let edges: Vec<(usize, &Edge)> = (first..).zip(ring).collect();
    let next = edges.iter().cycle().skip(1);
    let met: Vec<(Joint, f64)> = edges
        .iter()
        .zip(next)
        .map(|(one, other)| joint(one.1, other.1, kink))
        .collect();
    // After which edge the first run begins: any, if the walls never end.
    let after = met.iter().position(|(joint, _)| *joint != Joint::Through);
    let begin = after.map_or(0, |after| after + 1);
    let is_endless = after.is_none();
    let order = (0..count).map(|place| (begin + place) % count.max(1));
    let mut runs: Vec<Run<'_>> = Vec::new();
    let mut open_run: Option<Run<'_>> = None;
    for place in order {
        let Some(&(number, edge)) = edges.get(place) else {
            continue;
        };
        let before = (place + count - 1) % count;
        let at = |place: usize| met.get(place).copied().unwrap_or((Joint::Closed, 0.0));
        if edge.side == Side::Open {
            continue;
        }
        let side = |place: usize| {
            let edge = edges.get(place).map(|(_, edge)| *edge);
            edge.filter(|edge| edge.side == Side::Open).map(|edge| edge.piece)
        };
        let run = open_run.get_or_insert_with(|| {
            let (joint, turn) = at(before);
            Run {
                edges: Vec::new(),
                joints: [joint; 2],
                turns: [turn; 2],
                open: [side(before), None],
            }
        });
        run.edges.push((number, edge));
        let (joint, turn) = at(place);
        if joint != Joint::Through {
            run.joints[1] = joint;
            run.turns[1] = turn;
            run.open[1] = side((place + 1) % count);
            runs.extend(open_run.take());
        }
    }
    if is_endless {
        runs.extend(open_run);
    }
    runs
}

fn joint(one: &Edge, next: &Edge, kink: f64) -> (Joint, f64) {
    let (out, on) = (one.piece.direction(1.0), next.piece.direction(0.0));
    let turn = libm::atan2(out.cross(on), out.dot(on));
    let joint = match (one.side, next.side) {
        (Side::Wall, Side::Wall) if turn.abs() <= kink => {
            if is_hollow(one.piece) == is_hollow(next.piece) {
                Joint::Through
            } else {
                Joint::Closed
            }
        }
        (Side::Wall, Side::Wall) if turn > 0.0 => Joint::Closed,
        (Side::Wall, Side::Wall) => Joint::Convex,
        _ => Joint::Open,
    };
    (joint, turn)
}

/// Whether the region lies on the side of an arc's centre.
fn is_hollow(wall: Piece) -> bool {
    wall.sweep > 0.0
}

#[cfg(test)]
mod tests;
