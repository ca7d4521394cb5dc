//! Straight down into a hole that is open already.

use super::room::Room;
use super::{Entry, Kind, Leg, Run};
use vcutc_geometry::grid;
use vcutc_job::Hole;
use vcutc_region::order::begun_near;
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// In how many parts the pieces of a closed pass are cut to find a place of it to which a way is free.
const PARTS: u32 = 8;

/// What the tool keeps from the side of a hole, in mm: points are rounded.
const ROUNDING: f64 = 1e-3;

/// Shorter ways from the hole to the pass are none, in mm.
const SHORTEST: f64 = 0.1;

/// A run that begins in a hole, with the shortest free straight way to its pass; none where no way is free.
pub(super) fn enter(pass: &Pass, kind: Kind, hole: Hole, room: Room<'_>) -> Option<Run> {
    let on_grid = |length: vcutc_backend_api::units::Length| grid::nearest(length.to_mm());
    let middle = Place::new(on_grid(hole.x), on_grid(hole.y));
    let slack = (hole.radius.to_mm() - room.radius - ROUNDING).max(0.0);
    let (at, landing) = landings(pass, middle).into_iter().find_map(|landing| {
        let away = landing.distance(middle);
        let at = if away <= slack {
            landing
        } else {
            middle.lerp(landing, slack / away)
        };
        let is_there = at.distance(landing) < SHORTEST;
        let is_free = is_there || room.is_free(Piece::line(at, landing));
        is_free.then_some((if is_there && away <= slack { landing } else { at }, landing))
    })?;
    let way = begun_near(pass, Some(landing));
    let link = Leg {
        piece: Piece::line(at, landing),
        kind: Kind::Link,
    };
    let link = (at != landing).then_some(link);
    let legs = way.pieces.iter().map(|piece| Leg { piece: *piece, kind });
    Some(Run {
        entry: Entry::Hole { at },
        legs: link.into_iter().chain(legs).collect(),
    })
}

/// Where a pass may begin, the nearest first.
fn landings(pass: &Pass, middle: Place) -> Vec<Place> {
    let ends = pass.pieces.first().zip(pass.pieces.last());
    let mut places = match ends {
        Some((first, last)) if !pass.is_closed() => vec![first.from, last.to],
        _ => {
            let shares = (0..PARTS).map(|part| f64::from(part) / f64::from(PARTS));
            let along = pass
                .pieces
                .iter()
                .flat_map(|piece| shares.clone().map(|share| piece.at(share)));
            let nearest = begun_near(pass, Some(middle));
            let nearest = nearest.pieces.first().map(|piece| piece.from);
            along.chain(nearest).collect()
        }
    };
    places.sort_by(|one, other| middle.distance(*one).total_cmp(&middle.distance(*other)));
    places
}
