//! The slit along walls that go on into each other: where it begins and ends, and how the blade is held.

use super::{Begin, Joint, Knife, Misfit, OFF, Run, Slit, SlitPiece, is_hollow};
use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::plate::{Reach, Stroke};
use core::cmp::Ordering;
use core::f64::consts::FRAC_PI_2;

/// How much nearer to a wall than it keeps a blade may come by rounding, in mm.
const ROUNDING: f64 = 1e-7;

/// How often a place between is halved to find where a way ends.
const HALVINGS: u32 = 40;

/// At how many places of a way room is looked for.
const LOOKED_AT: u32 = 16;

/// Shorter pieces are left out, in mm.
const SHORTEST: f64 = 1e-3;

/// How far beyond a corner that points into the region a slit goes at most, in thicknesses: at corners of the part below 6 deg slits do
/// not meet, and a crusher parts what is between them.
const FARTHEST: f64 = 10.0;

/// The sine of the least angle at which a slit leaves through an open side: at flatter ones the way out is over three times as long.
const FLATTEST: f64 = 0.3;

/// The slits along a run of walls: one, or two where the blade has to turn between two corners and there is no line to do it on.
///
/// # Errors
/// The blade does not follow some wall.
pub(super) fn slit(run: &Run<'_>, knife: Knife, walls: &Walls) -> Result<Vec<Slit>, Misfit> {
    let hollow = run.edges.first().is_some_and(|(_, edge)| is_hollow(edge.piece));
    let ways = if hollow {
        beside_hollow(run, knife)?
    } else {
        run.edges
            .iter()
            .map(|(_, edge)| beside(edge.piece, knife))
            .collect()
    };
    let closed = run.joints.map(|joint| joint == Joint::Closed);
    let upright = [FRAC_PI_2 - knife.half_apex, FRAC_PI_2 + knife.half_apex];
    let room = Room { knife, walls };
    if hollow || closed == [false; 2] {
        return room.slits(vec![held(&ways, [FRAC_PI_2; 2])], run);
    }
    // Square to its way wherever it can; else as it has to be at a corner from there on.
    let at_ends = [0, 1].map(|end| if closed[end] { upright[end] } else { FRAC_PI_2 });
    let square = turned_on_lines(&ways, at_ends).map(|pieces| room.slits(vec![pieces], run));
    match square {
        Some(Ok(slits)) => Ok(slits),
        Some(Err(_)) | None => {
            let groups = match closed {
                [true, true] => between_corners(ways, upright),
                [true, false] => vec![held(&ways, [upright[0]; 2])],
                [false, _] => vec![held(&ways, [upright[1]; 2])],
            };
            room.slits(groups, run)
        }
    }
}

/// Pieces along which the blade turns in its plane on the first and on the last line; none without a line.
fn turned_on_lines(ways: &[Piece], [begins, ends]: [f64; 2]) -> Option<Vec<SlitPiece>> {
    let first = ways.iter().position(|way| way.is_line())?;
    let last = ways.iter().rposition(|way| way.is_line())?;
    let rakes = |place: usize| match (place.cmp(&first), place.cmp(&last)) {
        (Ordering::Less, _) => [begins; 2],
        (_, Ordering::Greater) => [ends; 2],
        (Ordering::Equal, Ordering::Equal) => [begins, ends],
        (Ordering::Equal, Ordering::Less) => [begins, FRAC_PI_2],
        (Ordering::Greater, Ordering::Equal) => [FRAC_PI_2, ends],
        (Ordering::Greater, Ordering::Less) => [FRAC_PI_2; 2],
    };
    Some(held_each(ways, rakes))
}

/// The way of the tip along a wall that is straight, or bulges into the region.
fn beside(wall: Piece, knife: Knife) -> Piece {
    match wall.radius() {
        None => {
            let aside = wall.direction(0.0).left().times(knife.standoff());
            Piece::line(wall.from.plus(aside), wall.to.plus(aside))
        }
        Some(radius) => {
            let way = radius + knife.standoff();
            let knife = knife.on_arc(part_of(wall, way));
            about(wall, radius + knife.standoff())
        }
    }
}

/// The ways of the tip along hollow arcs that go on into each other: at one distance from all of them.
fn beside_hollow(run: &Run<'_>, knife: Knife) -> Result<Vec<Piece>, Misfit> {
    let arcs = run
        .edges
        .iter()
        .filter_map(|(number, edge)| Some((*number, edge.piece, edge.piece.radius()?)));
    let tightest = arcs.clone().min_by(|(.., one), (.., other)| one.total_cmp(other));
    let Some((edge, wall, radius)) = tightest else {
        return Ok(Vec::new());
    };
    let tight = Misfit::Tight { edge, radius };
    let way = knife.radius_within(radius).ok_or(tight)?;
    let shortest = arcs
        .clone()
        .map(|(_, wall, _)| part_of(wall, way))
        .fold(part_of(wall, way), f64::min);
    let far = radius - knife.on_arc(shortest).radius_within(radius).ok_or(tight)?;
    Ok(arcs.map(|(_, wall, radius)| about(wall, radius - far)).collect())
}

/// The length of the parts in which an arc is cut, about the centre of a wall.
fn part_of(wall: Piece, radius: f64) -> f64 {
    radius * wall.sweep.abs().min(FRAC_PI_2)
}

/// The arc about the centre of another one.
fn about(wall: Piece, radius: f64) -> Piece {
    let (Some(centre), Some(own)) = (wall.centre(), wall.radius()) else {
        return wall;
    };
    let moved = |at: Place| centre.plus(at.minus(centre).times(radius / own));
    Piece::arc(moved(wall.from), moved(wall.to), wall.sweep)
}

fn held(ways: &[Piece], rakes: [f64; 2]) -> Vec<SlitPiece> {
    held_each(ways, |_| rakes)
}

fn held_each(ways: &[Piece], rakes: impl Fn(usize) -> [f64; 2]) -> Vec<SlitPiece> {
    let ways = ways.iter().enumerate();
    ways.map(|(place, &way)| SlitPiece {
        way,
        rakes: rakes(place),
    })
    .collect()
}

/// Pieces from one inward corner to another: the blade turns in its plane along the longest line; without a line it is lifted halfway.
fn between_corners(ways: Vec<Piece>, [trailing, leading]: [f64; 2]) -> Vec<Vec<SlitPiece>> {
    let lines = ways.iter().enumerate().filter(|(_, way)| way.is_line());
    let longest = lines.max_by(|(_, one), (_, other)| one.length().total_cmp(&other.length()));
    if let Some((turns, _)) = longest {
        let rakes = |place: usize| match place.cmp(&turns) {
            Ordering::Less => [trailing; 2],
            Ordering::Equal => [trailing, leading],
            Ordering::Greater => [leading; 2],
        };
        return vec![held_each(&ways, rakes)];
    }
    let half = ways.iter().map(|way| way.length()).sum::<f64>() / 2.0;
    let mut gone = 0.0;
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for way in ways {
        let long = way.length();
        let share = ((half - gone) / long).clamp(0.0, 1.0);
        gone += long;
        if share > 0.0 {
            before.push(way.part(0.0, share));
        }
        if share < 1.0 {
            after.push(way.part(share, 1.0));
        }
    }
    vec![held(&before, [trailing; 2]), held(&after, [leading; 2])]
}

/// What there is to keep from.
struct Room<'w> {
    knife: Knife,
    walls: &'w Walls,
}

impl Room<'_> {
    /// Slits along a run of walls, each group of pieces one, with their beginnings and ends.
    fn slits(&self, groups: Vec<Vec<SlitPiece>>, run: &Run<'_>) -> Result<Vec<Slit>, Misfit> {
        let number = |at: usize| run.edges.get(at).map_or(0, |(number, _)| *number);
        let last = groups.len().saturating_sub(1);
        let mut slits = Vec::with_capacity(groups.len());
        for (place, pieces) in groups.into_iter().enumerate() {
            let mut slit = Slit {
                pieces,
                begins: Begin::Within,
            };
            if place == 0 {
                self.begin(&mut slit, run, number(0))?;
            }
            if place == last {
                self.end(&mut slit, run, number(run.edges.len().saturating_sub(1)))?;
            }
            self.prove(&slit, run)?;
            slits.push(slit);
        }
        Ok(slits)
    }

    fn stroke(&self, piece: SlitPiece) -> Stroke {
        Stroke {
            way: piece.way,
            reaches: piece.rakes.map(|rake| self.knife.reach(rake)),
            half: self.knife.half,
        }
    }

    /// A place of a wall to which something comes nearer than the blade may; none where it keeps from all of them.
    fn met(&self, outline: impl IntoIterator<Item = Piece>) -> Option<Place> {
        let near = outline.into_iter().filter_map(|side| self.walls.nearest_to(side));
        let mut near = near.map(|(_, near)| near);
        let met = near.find(|near| near.distance < self.knife.keep - OFF - ROUNDING);
        met.map(|near| near.at)
    }

    /// Whether the blade keeps from all walls at a share of its way.
    fn is_free(&self, stroke: Stroke, share: f64) -> bool {
        self.met(stroke.stand(share)).is_none()
    }

    /// The share of a piece nearest to where it begins (0) or ends (1) at which the blade has room there; none where there is none. What of
    /// the blade lies towards the other end has to have room as well.
    fn farthest(&self, piece: SlitPiece, end: Towards) -> Option<f64> {
        let stroke = self.stroke(piece);
        let [begin, last] = stroke.reaches;
        let (own, near) = match end {
            Towards::Begin => (begin, Reach { ahead: 0.0, ..begin }),
            Towards::End => (last, Reach { behind: 0.0, ..last }),
        };
        let [whole, near] = [own, near].map(|reach| Stroke {
            reaches: [reach; 2],
            ..stroke
        });
        let mut blocked = None;
        for step in 0..=LOOKED_AT {
            let back = f64::from(step) / f64::from(LOOKED_AT);
            let at = match end {
                Towards::Begin => back,
                Towards::End => 1.0 - back,
            };
            if self.is_free(near, at) {
                let at = blocked.map_or(at, |blocked| self.halved(near, at, blocked));
                return self.is_free(whole, at).then_some(at);
            }
            blocked = Some(at);
        }
        None
    }

    /// The share nearest to one where the blade has no room, from another where it has.
    fn halved(&self, stroke: Stroke, mut free: f64, mut blocked: f64) -> f64 {
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(free, blocked);
            if self.is_free(stroke, middle) {
                free = middle;
            } else {
                blocked = middle;
            }
        }
        free
    }

    fn begin(&self, slit: &mut Slit, run: &Run<'_>, edge: usize) -> Result<(), Misfit> {
        let Some(first) = slit.pieces.first_mut() else {
            return Ok(());
        };
        let at = first.way.from;
        let ([joint, _], [turn, _], [open, _]) = (run.joints, run.turns, run.open);
        match joint {
            Joint::Through => {}
            Joint::Closed => {
                let from = self.farthest(*first, Towards::Begin);
                first.way = first.way.part(from.ok_or(Misfit::NoRoom { edge, at })?, 1.0);
            }
            Joint::Convex | Joint::Open => {
                let back = first.way.direction(0.0).times(-1.0);
                let far = self.beyond(at, back, (turn, open));
                let piece = SlitPiece {
                    way: Piece::line(at.plus(back.times(far)), at),
                    rakes: [first.rakes[0]; 2],
                };
                if self.is_worth_it(piece) {
                    slit.begins = open.map_or(Begin::Within, |_| Begin::Beside);
                    if first.way.is_line() {
                        first.way.from = piece.way.from;
                    } else {
                        slit.pieces.insert(0, piece);
                    }
                }
            }
        }
        Ok(())
    }

    fn end(&self, slit: &mut Slit, run: &Run<'_>, edge: usize) -> Result<(), Misfit> {
        let Some(last) = slit.pieces.last_mut() else {
            return Ok(());
        };
        let at = last.way.to;
        let ([_, joint], [_, turn], [_, open]) = (run.joints, run.turns, run.open);
        match joint {
            Joint::Through => {}
            Joint::Closed => {
                let to = self.farthest(*last, Towards::End);
                last.way = last.way.part(0.0, to.ok_or(Misfit::NoRoom { edge, at })?);
            }
            Joint::Convex | Joint::Open => {
                let on = last.way.direction(1.0);
                let far = self.beyond(at, on, (turn, open));
                let piece = SlitPiece {
                    way: Piece::line(at, at.plus(on.times(far))),
                    rakes: [last.rakes[1]; 2],
                };
                if self.is_worth_it(piece) {
                    if last.way.is_line() {
                        last.way.to = piece.way.to;
                    } else {
                        slit.pieces.push(piece);
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether the blade keeps from all walls all along: with a part of it ahead or behind it may meet others than its own.
    fn prove(&self, slit: &Slit, run: &Run<'_>) -> Result<(), Misfit> {
        for &piece in &slit.pieces {
            if let Some(at) = self.met(self.stroke(piece).outline()) {
                let edge = followed(run, piece.way.at(0.5));
                return Err(Misfit::NoRoom { edge, at });
            }
        }
        Ok(())
    }

    /// How far a slit goes on beyond its wall, so that it meets the next one, or is clear of the stock.
    fn beyond(&self, at: Place, on: Place, (turn, open): (f64, Option<Piece>)) -> f64 {
        let knife = self.knife;
        let Some(side) = open else {
            let meets = knife.standoff() * libm::tan(turn.abs() / 2.0);
            return meets.min(FARTHEST * 2.0 * knife.half.max(knife.keep));
        };
        // The region lies to the left of its sides.
        let out = side.direction(0.0).left().times(-1.0);
        let across = out.dot(on);
        if across < FLATTEST {
            return 0.0;
        }
        let reach = knife.reach(FRAC_PI_2 + knife.half_apex).behind;
        let far = out.dot(side.from.minus(at)).max(0.0);
        (far + knife.half + knife.run_out) / across + reach
    }

    /// Whether a way beyond a wall has some length, and the blade room all along.
    fn is_worth_it(&self, piece: SlitPiece) -> bool {
        piece.way.length() >= SHORTEST && self.met(self.stroke(piece).outline()).is_none()
    }
}

/// The wall of a run that is nearest to a place.
fn followed(run: &Run<'_>, at: Place) -> usize {
    let walls = Walls::of_pieces(run.edges.iter().map(|(number, edge)| (*number, edge.piece)));
    walls.nearest(at).map_or(0, |near| near.edge)
}

/// An end of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Towards {
    Begin,
    End,
}
