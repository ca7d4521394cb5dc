//! The passes of a layer as runs: from where the tool goes down to where it goes up.
//!
//! Passes are cut inside out, as [`vcutc_region::order`] has them. Where a short way at depth joins two of them they make one run.
//! Where none does, the tool is lifted, and goes down again on ground that is cleared, beside the next pass; only in a basin that
//! nothing is cleared of it has to go down into the material.

use super::entry::{self, Ways};
use super::room::Room;
use super::{Entry, Kind, Leg, Run};
use crate::refused::Why;
use vcutc_region::boxes::Extent;
use vcutc_region::curve::Curve;
use vcutc_region::distance::Walls;
use vcutc_region::order::{Links, Step, begun_near, inside_out};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// How many steps a way from pass to pass may be long: at a sharp corner the next one lies farther away.
const LONGEST_LINK: f64 = 3.0;

/// How many steps apart passes lie at most that are neighbours.
const NEIGHBOURS: f64 = 1.5;

/// Nearer to a wall than it should be a way may come by rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// The tool does not come down to shorter pieces, in mm: rounding may remove them.
const SHORTEST: f64 = 0.1;

/// The passes as runs, extra ones after all others.
///
/// # Errors
/// There are too many.
pub(super) fn runs(passes: &[Pass], extra: &[Pass], ways: Ways, room: Room<'_>) -> Result<Vec<Run>, Why> {
    let links = Links {
        walls: room.walls,
        distance: room.keep,
        longest: LONGEST_LINK * room.step,
    };
    let steps = inside_out(passes, links).map_err(|_| Why::TooLarge)?;
    let mut laid = Laid {
        ways,
        room,
        runs: Vec::new(),
        cut: Vec::new(),
    };
    for Step { way, link, .. } in steps {
        laid.add(&way, link)?;
    }
    for way in extra {
        laid.add(way, None)?;
    }
    Ok(laid.runs)
}

/// Runs while they grow.
struct Laid<'r> {
    ways: Ways,
    room: Room<'r>,
    runs: Vec<Run>,
    /// What is cut: each pass, and the box around it.
    cut: Vec<(Walls, Extent)>,
}

impl Laid<'_> {
    fn add(&mut self, pass: &Pass, link: Option<Piece>) -> Result<(), Why> {
        let kind = if self.is_beside_what_is_cut(pass) {
            Kind::Pass
        } else {
            Kind::Opening
        };
        let leg = |piece: &Piece| Leg { piece: *piece, kind };
        let note = noted(pass);
        let end = self.end();
        let link = link.filter(|link| end.is_some_and(|end| end.distance(link.from) <= ROUNDING));
        let returned = match link {
            Some(link) => {
                let legs = linked(link).chain(pass.pieces.iter().map(leg));
                end.map(|end| (end, legs.collect::<Vec<Leg>>()))
            }
            None => {
                let beside = self.back_beside(pass).filter(|_| kind == Kind::Pass);
                beside.map(|(at, link)| {
                    let way = begun_near(pass, Some(link.to));
                    (at, linked(link).chain(way.pieces.iter().map(leg)).collect())
                })
            }
        };
        match (returned, self.runs.last_mut()) {
            (Some((at, legs)), Some(run)) if end == Some(at) => run.legs.extend(legs),
            (Some((at, legs)), _) => self.runs.push(Run {
                entry: Entry::Return { at },
                legs,
            }),
            (None, _) => self.runs.push(entry::enter(pass, kind, self.ways, self.room)?),
        }
        self.cut.extend(note);
        Ok(())
    }

    /// Where the tool is.
    fn end(&self) -> Option<Place> {
        Some(self.runs.last()?.legs.last()?.piece.to)
    }

    fn is_beside_what_is_cut(&self, pass: &Pass) -> bool {
        let far = NEIGHBOURS * self.room.step;
        let extent = extent(pass).map(|extent| extent.grown(far));
        let near = self
            .cut
            .iter()
            .filter(|(_, other)| extent.is_some_and(|extent| extent.meets(*other)));
        near.into_iter().any(|(walls, _)| {
            let near = pass.pieces.iter().filter_map(|piece| walls.nearest_to(*piece));
            near.into_iter().any(|(_, near)| near.distance <= far)
        })
    }

    /// A place where the tool has been, with a short way from there to a pass.
    fn back_beside(&self, pass: &Pass) -> Option<(Place, Piece)> {
        let walls = Walls::of_pieces(pass.pieces.iter().copied().enumerate());
        let longest = LONGEST_LINK * self.room.step;
        let legs = self.runs.iter().flat_map(|run| &run.legs);
        let places = legs
            .filter(|leg| leg.piece.length() >= SHORTEST)
            .map(|leg| leg.piece.to);
        let ways = places.filter_map(|at| {
            let near = walls.nearest_within(at, longest)?;
            let way = Piece::line(at, landing(pass, near.at)?);
            Some((way.length(), at, way))
        });
        let mut ways: Vec<(f64, Place, Piece)> = ways.filter(|(long, ..)| *long <= longest).collect();
        ways.sort_by(|one, other| one.0.total_cmp(&other.0));
        let free = ways.into_iter().find(|(long, _, way)| {
            let near = self.room.walls.nearest_to(*way);
            let is_free = near.is_none_or(|(_, near)| near.distance >= self.room.keep - ROUNDING);
            *long > ROUNDING && is_free
        });
        free.map(|(_, at, way)| (at, way))
    }
}

/// Where a pass begins that is met there: anywhere on a closed one, at the nearer end of an open one.
fn landing(pass: &Pass, at: Place) -> Option<Place> {
    if pass.is_closed() {
        return Some(at);
    }
    let (first, last) = (pass.pieces.first()?.from, pass.pieces.last()?.to);
    let is_first = at.distance(first) <= at.distance(last);
    Some(if is_first { first } else { last })
}

/// A way from pass to pass, if it has any length.
fn linked(link: Piece) -> impl Iterator<Item = Leg> {
    let leg = Leg {
        piece: link,
        kind: Kind::Link,
    };
    (link.length() > ROUNDING).then_some(leg).into_iter()
}

fn extent(pass: &Pass) -> Option<Extent> {
    let extents = pass.pieces.iter().map(|piece| Curve::of(*piece).extent());
    extents.reduce(Extent::with)
}

/// A pass, to be compared with others.
fn noted(pass: &Pass) -> Option<(Walls, Extent)> {
    let walls = Walls::of_pieces(pass.pieces.iter().copied().enumerate());
    Some((walls, extent(pass)?))
}
