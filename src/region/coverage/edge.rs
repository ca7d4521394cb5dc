//! The edge of where a tool's centre may go, and which parts of it passes follow.
//!
//! The centre may go where its distance from all walls is at least what it keeps. The edge of that is made of pieces beside the
//! walls and of arcs about their ends, less what other walls block. It is computed here from the walls, once more: the proof takes
//! nothing from the planner.

use super::Tool;
use crate::boxes::{Extent, Tree};
use crate::curve::Curve;
use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Edge as Side, Region, Side as Beyond};
use crate::rounded::{part, parts_within};
use core::f64::consts::PI;

/// By so much, in mm, a place may be too near to a wall and still count as one for the centre. It makes more ground reachable.
const SLACK: f64 = 1e-9;

/// Shorter parts, in mm, do not count.
const SHORTEST: f64 = 1e-9;

/// How far passes may be off the edge, in mm, and still follow it: the least that does is what counts. Programs have whole
/// micrometres, so ends are off by 0.71 um and places on arcs by some more.
const ASIDE: [f64; 4] = [1e-6, 1e-3, 2e-3, 5e-3];

/// The edge, in parts that no wall blocks.
pub(super) struct Edge {
    parts: Vec<Curve>,
}

impl Edge {
    pub(super) fn of(region: &Region, tool: Tool) -> Self {
        let walls = Walls::of(region);
        let curves: Vec<Curve> = walls.curves().map(|(_, curve)| *curve).collect();
        let mut parts = Vec::new();
        for ring in region.loops() {
            let next = ring.iter().cycle().skip(1);
            for (edge, next) in ring.iter().zip(next) {
                let mut keep = |piece: Option<Piece>| {
                    if let Some(piece) = piece.filter(|piece| piece.is_sound()) {
                        unblocked(&Curve::of(piece), &walls, &curves, tool, &mut parts);
                    }
                };
                keep(beside(edge, tool.keep));
                for piece in about_the_end(edge, next, tool.keep) {
                    keep(piece);
                }
            }
        }
        Self { parts }
    }

    pub(super) fn into_parts(self) -> Vec<Curve> {
        self.parts
    }

    /// The parts that no pass follows, and how far passes are off the others, in mm.
    pub(super) fn missed_by(&self, passes: &[Curve]) -> (Vec<Curve>, f64) {
        let extents: Vec<Extent> = passes.iter().map(Curve::extent).collect();
        let tree = Tree::of(&extents);
        let (mut missed, mut fringe) = (Vec::new(), 0.0_f64);
        for edge in &self.parts {
            let open = |aside: f64| {
                let mut followed = Vec::new();
                tree.meeting(edge.extent().grown(aside), &mut |pass| {
                    if let Some(pass) = passes.get(pass as usize) {
                        parts_within(edge, pass, aside, &mut |from, to| followed.push((from, to)));
                    }
                });
                without(edge, followed)
            };
            let [.., most] = ASIDE;
            let last = open(most);
            // Around what stays open in the end, more is open at first. What closes on its own is off the edge.
            let holds_some =
                |&(from, to): &(f64, f64)| last.iter().any(|&(start, end)| from <= start && end <= to);
            let mut tried = ASIDE.iter().map(|&aside| (open(aside), aside));
            let settled = tried.find(|(open, _)| open.iter().all(holds_some));
            let (open, aside) = settled.unwrap_or((Vec::new(), most));
            fringe = fringe.max(aside);
            missed.extend(
                open.iter()
                    .map(|&(from, to)| Curve::of(part(edge.piece, from, to))),
            );
        }
        (missed, fringe)
    }
}

/// What lies beside a wall, to its left. Of an arc that is hollow and too tight nothing; of one that just holds the tool its
/// centre, as a tiny arc.
fn beside(edge: &Side, keep: f64) -> Option<Piece> {
    if edge.side == Beyond::Open {
        return None;
    }
    let piece = edge.piece;
    if let Some((centre, radius)) = piece.centre().zip(piece.radius()) {
        let rest = radius - keep * piece.sweep.signum();
        let size = (rest > -SLACK).then(|| rest.max(SLACK) / radius)?;
        let [from, to] = [piece.from, piece.to].map(|end| centre.plus(end.minus(centre).times(size)));
        return Some(Piece::arc(from, to, piece.sweep));
    }
    let aside = piece.direction(0.5).left().times(keep);
    Some(Piece::line(piece.from.plus(aside), piece.to.plus(aside)))
}

/// The arc about the end of an edge, from beside it to beside the next one: where walls stand apart in the corner, or where one
/// ends at an open side, where it is half a circle.
fn about_the_end(edge: &Side, next: &Side, keep: f64) -> [Option<Piece>; 2] {
    let (arrival, ahead) = (edge.piece.direction(1.0), next.piece.direction(0.0));
    let at = edge.piece.to;
    let arc = |first: Place, turn: f64| {
        let (sin, cos) = libm::sincos(turn);
        let last = Place::new(first.x * cos - first.y * sin, first.x * sin + first.y * cos);
        Piece::arc(at.plus(first.times(keep)), at.plus(last.times(keep)), turn)
    };
    match (edge.side, next.side) {
        (Beyond::Wall, Beyond::Wall) => {
            let turn = libm::atan2(arrival.cross(ahead), arrival.dot(ahead));
            [(turn < 0.0).then(|| arc(arrival.left(), turn)), None]
        }
        (Beyond::Wall, Beyond::Open) => [Some(arc(arrival.left(), -PI)), None],
        (Beyond::Open, Beyond::Wall) => [Some(arc(ahead.left().times(-1.0), -PI)), None],
        (Beyond::Open, Beyond::Open) => [None, None],
    }
}

/// Adds the parts of a piece that keep their distance from all walls.
fn unblocked(piece: &Curve, walls: &Walls, curves: &[Curve], tool: Tool, parts: &mut Vec<Curve>) {
    // One wall that is near enough blocks a short piece.
    let half = piece.piece.length() / 2.0;
    if walls
        .nearer_than(piece.middle, tool.keep - SLACK - half)
        .is_some()
    {
        return;
    }
    let mut blocked = Vec::new();
    let extent = piece.extent();
    let middle = extent.middle();
    let reach = middle.distance(extent.high) + tool.keep;
    walls.around(middle, reach, &mut |wall| {
        if let Some(wall) = curves.get(wall) {
            parts_within(piece, wall, tool.keep - SLACK, &mut |from, to| {
                blocked.push((from, to))
            });
        }
    });
    let free = without(piece, blocked);
    parts.extend(
        free.iter()
            .map(|&(from, to)| Curve::of(part(piece.piece, from, to))),
    );
}

/// What parts leave of a piece, as shares of its way.
fn without(piece: &Curve, mut parts: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    parts.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let least = SHORTEST / piece.piece.length();
    let mut rest = Vec::new();
    let mut reached = 0.0;
    for (from, to) in parts.into_iter().chain([(1.0, 1.0)]) {
        if from > reached + least {
            rest.push((reached, from));
        }
        reached = to.max(reached);
    }
    rest
}
