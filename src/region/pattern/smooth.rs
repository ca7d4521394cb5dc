//! Inward corners as arcs.
//!
//! An arc touches both pieces that meet in a corner: its centre is where both, moved in by its radius, cross. It takes at most
//! half of each piece, so that corners do not get in each other's way.
//!
//! How round a corner may be is exact where the pass before has a corner between the same straight walls. Elsewhere places around
//! the corner are tried, and the radius is lessened until all of them are cut.

use super::cover_of_sine;
use crate::curve::{Curve, crossings};
use crate::distance::Walls;
use crate::offset::{Kind, Origin, Way};
use crate::piece::Piece;
use crate::place::Place;
use core::f64::consts::SQRT_2;

/// Corners that turn by less, in rad, do not count.
const STRAIGHT: f64 = 1e-6;

/// Arcs of a smaller radius, in mm, are left out, and so are pieces shorter than that.
const LEAST: f64 = 1e-6;

/// How often the radius of an arc beside an arc is halved in the search for the largest one.
const HALVINGS: u32 = 24;

/// How often the radius of a corner that leaves something is lessened, before it stays sharp, and to which share.
const TRIALS: u32 = 10;
const SHARPER: f64 = 0.75;

/// Places around a corner are tried in boxes that are halved until they are as small as this part of the tool's radius.
const FINENESS: f64 = 32.0;

/// What bounds the radius of corners; lengths in mm.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    pub(super) radius: f64,
    pub(super) step: f64,
    pub(super) most: f64,
}

/// An arc in a corner.
#[derive(Clone, Copy)]
struct Fillet {
    from: Place,
    to: Place,
    sweep: f64,
}

impl Fillet {
    fn radius(self) -> f64 {
        let piece = Piece::arc(self.from, self.to, self.sweep);
        piece.radius().unwrap_or(0.0)
    }
}

/// The level before, as it is cut.
pub(super) struct Before {
    cut: Walls,
    /// Between what its corners lie.
    corners: Vec<(Origin, Origin)>,
}

impl Before {
    /// The passes of a level, and its ways before their corners were rounded.
    pub(super) fn of<'a>(
        pieces: impl IntoIterator<Item = Piece>,
        ways: impl IntoIterator<Item = &'a Way>,
    ) -> Self {
        let mut corners: Vec<(Origin, Origin)> = ways
            .into_iter()
            .flat_map(|way| way.origins.iter().zip(way.origins.iter().cycle().skip(1)))
            .map(|(&one, &next)| (one, next))
            .collect();
        corners.sort_unstable();
        Self {
            cut: Walls::of_pieces(pieces.into_iter().enumerate()),
            corners,
        }
    }
}

/// The pieces of a way at a distance from the walls with its inward corners rounded.
pub(super) fn smoothed(way: &Way, distance: f64, rule: Rule, before: &Before, walls: &Walls) -> Vec<Piece> {
    if way.kind == Kind::Tie {
        return way.pieces.clone();
    }
    let curves: Vec<Curve> = way.pieces.iter().map(|&piece| Curve::of(piece)).collect();
    let next = curves.iter().cycle().skip(1);
    let origins = way.origins.iter().zip(way.origins.iter().cycle().skip(1));
    let trial = Trial {
        rule,
        before,
        walls,
        inside: distance - rule.step,
    };
    let mut fillets: Vec<Option<Fillet>> = curves
        .iter()
        .zip(next)
        .zip(origins)
        .map(|((one, next), (&first, &second))| {
            let is_straight = one.piece.is_line() && next.piece.is_line();
            if is_straight && before.corners.binary_search(&(first, second)).is_ok() {
                fillet(one, next, rule)
            } else {
                trial.fillet(one, next)
            }
        })
        .collect();
    if !way.is_closed()
        && let Some(last) = fillets.last_mut()
    {
        *last = None;
    }
    let before = fillets.iter().cycle().skip(fillets.len().saturating_sub(1));
    let mut pieces = Vec::with_capacity(2 * curves.len());
    for ((curve, before), after) in curves.iter().zip(before).zip(&fillets) {
        let from = before.map_or(curve.piece.from, |fillet| fillet.to);
        let to = after.map_or(curve.piece.to, |fillet| fillet.from);
        let is_whole = before.is_none() && after.is_none();
        if is_whole {
            pieces.push(curve.piece);
        } else if from.distance(to) > LEAST {
            pieces.push(curve.part(from, to));
        }
        if let Some(fillet) = after {
            pieces.push(Piece::arc(fillet.from, fillet.to, fillet.sweep));
        }
    }
    join(&mut pieces, way.is_closed());
    pieces
}

/// Lets each piece begin where the one before it ends, where pieces between were left out.
fn join(pieces: &mut [Piece], is_closed: bool) {
    let mut end = pieces.last().filter(|_| is_closed).map(|piece| piece.to);
    for piece in pieces {
        piece.from = end.unwrap_or(piece.from);
        end = Some(piece.to);
    }
}

/// What corners are tried against.
struct Trial<'a> {
    rule: Rule,
    before: &'a Before,
    walls: &'a Walls,
    /// What lies nearer to the walls is the affair of the levels before.
    inside: f64,
}

impl Trial<'_> {
    /// The arc in a corner, as large as the places around it let it be.
    fn fillet(&self, one: &Curve, next: &Curve) -> Option<Fillet> {
        let mut rule = self.rule;
        let corner = one.piece.to;
        // What is left first lies straight out of the corner; what one arc leaves, the next one may leave too.
        let out = one.arrival.minus(next.ahead);
        let mut suspect = corner.plus(out.times(rule.radius / out.square().sqrt()));
        let mut near: Option<Near> = None;
        for _ in 0..TRIALS {
            let fillet = fillet(one, next, rule)?;
            let reach = rule.radius + corner.distance(fillet.from).max(corner.distance(fillet.to));
            let near = match near.take().filter(|near| near.reach >= reach) {
                Some(known) => near.insert(known),
                None => near.insert(self.near(corner, reach)),
            };
            let tried = Tried::new(self, near, [one, next], fillet);
            match tried.uncut(corner, reach, suspect) {
                None => return Some(fillet),
                Some(place) => suspect = place,
            }
            rule.most = fillet.radius().min(rule.most) * SHARPER;
        }
        None
    }

    /// What may cut places of a square around a corner.
    fn near(&self, corner: Place, reach: f64) -> Near {
        let around = |walls: &Walls, within: f64| {
            let mut curves = Vec::new();
            walls.around(corner, within, &mut |wall| curves.extend(walls.curve(wall)));
            curves
        };
        let aside = reach * SQRT_2;
        Near {
            reach,
            cut: around(&self.before.cut, aside + self.rule.radius),
            walls: around(self.walls, aside + self.inside.max(0.0)),
        }
    }
}

/// What lies near to a corner.
struct Near {
    /// How far the places around the corner go along both axes, in mm.
    reach: f64,
    /// Pieces of the level before.
    cut: Vec<Curve>,
    walls: Vec<Curve>,
}

/// An arc that is tried.
struct Tried<'a> {
    near: &'a Near,
    radius: f64,
    inside: f64,
    /// Steps below the radius leave that much to spare; without it boxes prove nothing in the end, and their middles stand for them.
    spare: f64,
    /// What the arc cuts off.
    gone: [Curve; 2],
    /// It, and what stays of both pieces beside it.
    kept: Vec<Curve>,
}

impl<'a> Tried<'a> {
    fn new(trial: &Trial, near: &'a Near, [one, next]: [&Curve; 2], fillet: Fillet) -> Self {
        let corner = one.piece.to;
        let kept = [
            Piece::arc(fillet.from, fillet.to, fillet.sweep),
            one.part(one.piece.from, fillet.from),
            next.part(fillet.to, next.piece.to),
        ];
        let kept = kept.into_iter().filter(|piece| piece.is_sound());
        let radius = trial.rule.radius;
        Self {
            near,
            radius,
            inside: trial.inside,
            spare: ((radius - trial.rule.step) / 2.0).max(0.0),
            gone: [one.part(fillet.from, corner), next.part(corner, fillet.to)].map(Curve::of),
            kept: kept.map(Curve::of).collect(),
        }
    }

    /// Whether a place is cut, or is not what the arc cuts off would cut, even when it is moved by so much: distances change no
    /// faster.
    fn is_cut(&self, place: Place, by: f64) -> bool {
        let Self {
            near, radius, inside, ..
        } = self;
        self.gone.iter().all(|curve| curve.distance(place) - by > *radius)
            || self
                .kept
                .iter()
                .any(|curve| curve.distance(place) + by <= *radius)
            || near.cut.iter().any(|curve| curve.distance(place) < radius - by)
            || near.walls.iter().any(|curve| curve.distance(place) < inside - by)
    }

    /// A place around a corner that only what is cut off would cut, if there is one, looked for first in the smallest box about another.
    fn uncut(&self, corner: Place, reach: f64, suspect: Place) -> Option<Place> {
        let smallest = self.radius / FINENESS;
        let is_uncut = |middle: Place, half: f64| !self.is_cut(middle, (half * SQRT_2).min(self.spare));
        let (mut middle, mut half) = (corner, reach);
        while half > smallest {
            half /= 2.0;
            let aside = suspect.minus(middle);
            middle = middle.plus(Place::new(half.copysign(aside.x), half.copysign(aside.y)));
        }
        if is_uncut(middle, half) {
            return Some(middle);
        }
        let mut open = vec![(corner, reach)];
        while let Some((middle, half)) = open.pop() {
            if half <= smallest {
                if is_uncut(middle, half) {
                    return Some(middle);
                }
            // Boxes of which the corner itself is one are too large to be cut.
            } else if half >= reach / 2.0 || !self.is_cut(middle, half * SQRT_2) {
                let quarter = half / 2.0;
                let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
                let corners = corners.map(|(x, y)| middle.plus(Place::new(x, y).times(quarter)));
                open.extend(corners.map(|corner| (corner, quarter)));
            }
        }
        None
    }
}

/// The arc in the corner between two pieces, if it is one to the left and an arc has room.
fn fillet(one: &Curve, next: &Curve, rule: Rule) -> Option<Fillet> {
    let (arrival, ahead) = (one.arrival, next.ahead);
    let (cross, dot) = (arrival.cross(ahead), arrival.dot(ahead));
    if cross <= 0.0 || dot > 0.0 && cross < STRAIGHT {
        return None;
    }
    // The half angle is what is left of the turn: its sine is the cosine of half the turn.
    let sine = f64::midpoint(1.0, dot).max(0.0).sqrt();
    let most = rule.most.min(cover_of_sine(rule.radius, rule.step, sine));
    if most <= LEAST {
        return None;
    }
    if one.piece.is_line() && next.piece.is_line() {
        let cosine = f64::midpoint(1.0, -dot).max(0.0).sqrt();
        let shorter = one.piece.length().min(next.piece.length());
        let radius = most.min(shorter / 2.0 * sine / cosine);
        let leg = radius * cosine / sine;
        let corner = one.piece.to;
        return (radius > LEAST).then(|| Fillet {
            from: corner.minus(arrival.times(leg)),
            to: corner.plus(ahead.times(leg)),
            sweep: libm::atan2(cross, dot),
        });
    }
    let fits = |radius: f64| touching(one, next, radius);
    if let Some(fillet) = fits(most) {
        return Some(fillet);
    }
    let (mut low, mut high) = (0.0, most);
    let mut best = None;
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if middle <= LEAST {
            break;
        }
        match fits(middle) {
            Some(fillet) => {
                best = Some(fillet);
                low = middle;
            }
            None => high = middle,
        }
    }
    best
}

/// The arc of a radius that touches both pieces within the halves next to their corner.
fn touching(one: &Curve, next: &Curve, radius: f64) -> Option<Fillet> {
    let corner = one.piece.to;
    let (first, second) = (one.moved(radius, LEAST)?, next.moved(radius, LEAST)?);
    let centres = crossings(&first, &second).into_iter().flatten();
    let away = |place: &Place| place.distance(corner);
    let centre = centres.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let (from, to) = (one.foot(centre), next.foot(centre));
    // How far a place lies after the middle of a piece, in the direction that the piece has there.
    let after = |curve: &Curve, place: Place| place.minus(curve.middle).cross(curve.normal);
    let is_late = after(one, from) >= 0.0 && one.is_beside(from, 0.0);
    let is_early = after(next, to) <= 0.0 && next.is_beside(to, 0.0);
    if !is_late || !is_early {
        return None;
    }
    let (ahead, chord) = (one.direction(from), to.minus(from));
    let half = libm::atan2(ahead.cross(chord), ahead.dot(chord));
    (half > 0.0).then_some(Fillet {
        from,
        to,
        sweep: 2.0 * half,
    })
}
