//! The slits of a straight blade as a program states them.

use crate::chains::{ChainPiece, pieces};
use crate::from_above::{level, place_of};
use core::num::NonZeroU32;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{OperationId, Program, Straight, ToolId};
use vcutc_backend_api::segments::LinearSegment;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::plate::{Reach, Stroke};

/// Heights and places this close are one, in mm.
const SAME: f64 = 1e-6;

/// The shortest way that has a direction, in mm.
const LEAST: f64 = 1e-6;

/// How upright the plane of a blade is that stands upright, as the height of its normal.
const UPRIGHT: f64 = 1e-9;

/// What a blade does on a move.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// It goes level.
    Along(Stroke),
    /// It goes straight down or up: all that it passes lies within where it is at the lower end, as a stroke from its back to its front.
    Down(Stroke),
    /// It is above the walls.
    Above,
    /// Something else.
    Otherwise,
}

/// A move of a blade in the work.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    pub layer: NonZeroU32,
    pub cut: NonZeroU32,
    pub motion: Motion,
    /// Where it begins.
    pub at: Place,
    /// The height of the lower end of the tip's way, in mm.
    pub floor: f64,
    /// How far the plane of the blade may leave its way, in mm.
    pub slack: f64,
    /// The edge that is in the work, in mm.
    pub edge: f64,
    /// The cosine of the largest angle between the axis of the blade and the vertical.
    pub least_upright: f64,
}

/// The moves of a blade of an operation, in the order of the program. Walls reach up to `top`, in mm.
#[must_use]
pub fn stated(program: &Program, of: (OperationId, ToolId), blade: Straight, top: f64) -> Vec<Stated> {
    let (operation, tool) = of;
    let pieces = pieces(program, operation).filter(|piece| piece.tool == tool);
    let moves = pieces.map(|piece| {
        let ChainPiece {
            layer,
            cut,
            line,
            held,
            ..
        } = piece;
        let floor = line.from.tip.z.min(line.to.tip.z);
        let height = (top - floor).max(0.0);
        let way = level(&line).filter(|way| way.from != way.to);
        let poses = held.map(|held| Pose::of(held, blade, height));
        let mut stated = Stated {
            layer,
            cut,
            motion: Motion::Otherwise,
            at: place_of(line.from.tip),
            floor,
            slack: 0.0,
            edge: poses.iter().map(|pose| pose.edge).fold(0.0, f64::max),
            least_upright: poses.iter().map(|pose| pose.upright).fold(1.0, f64::min),
        };
        let is_upright = poses.iter().all(|pose| pose.normal_up.abs() <= UPRIGHT);
        let half = blade.thickness.to_mm() / 2.0;
        if floor >= top - SAME {
            stated.motion = Motion::Above;
        } else if !is_upright {
            return stated;
        } else if let Some(way) = way {
            let turn = held[0].rotation_to(held[1]);
            if let Some((stroke, slack)) = along(way, poses, half, turn) {
                stated.slack = slack;
                stated.motion = Motion::Along(stroke);
            }
        } else if is_vertical(&line) && line.from.orientation == line.to.orientation {
            let [pose, _] = poses;
            stated.motion = Motion::Down(pose.standing(stated.at, half));
        }
        stated
    });
    moves.collect()
}

/// What a blade passes on a level way that turns it by this vector, in rad, and how far its plane may leave that; none where it turns out of
/// its plane and not with an arc.
///
/// Along a line the plane keeps its direction, so the blade passes a rectangle in that direction, as much wider as the ends of the
/// way lie beside each other. Along an arc it turns about the vertical at a constant rate, as the way does, so it is out of the way's
/// direction by no more than at its ends.
fn along(way: Piece, poses: [Pose; 2], half: f64, turn: [f64; 3]) -> Option<(Stroke, f64)> {
    let [begin, end] = poses;
    if way.is_line() {
        let out_of_plane = begin.normal.cross(end.normal).abs();
        let directed = way.direction(0.0);
        let ahead = begin.normal.left();
        let ahead = ahead.times(if ahead.dot(directed) < 0.0 { -1.0 } else { 1.0 });
        let aside = way.to.minus(way.from).dot(ahead.left());
        let middle = ahead.left().times(aside / 2.0);
        let long = way.to.minus(way.from).dot(ahead);
        let from = way.from.plus(middle);
        let stroke = Stroke {
            way: Piece::line(from, from.plus(ahead.times(long))),
            reaches: poses.map(|pose| pose.reach(ahead)),
            half: half + aside.abs() / 2.0,
        };
        let is_whole = long > 0.0 && begin.normal.dot(end.normal) > 0.0;
        let widest = stroke.reaches.map(|reach| reach.ahead.max(reach.behind));
        return is_whole.then(|| (stroke, out_of_plane * widest[0].max(widest[1])));
    }
    let is_about_the_vertical = libm::hypot(turn[0], turn[1]) <= UPRIGHT;
    let ways = [way.direction(0.0), way.direction(1.0)];
    let slack = |pose: Pose, ahead: Place| {
        let reach = pose.reach(ahead);
        reach.ahead.max(reach.behind) * pose.normal.dot(ahead).abs()
    };
    let stroke = Stroke {
        way,
        reaches: [begin.reach(ways[0]), end.reach(ways[1])],
        half,
    };
    is_about_the_vertical.then(|| (stroke, slack(begin, ways[0]).max(slack(end, ways[1]))))
}

/// How a blade is held, as far as the plan shows it.
#[derive(Clone, Copy, Debug)]
struct Pose {
    /// The normal of its plane in the plan.
    normal: Place,
    normal_up: f64,
    /// From the tip to both edges at the height of the walls, in the plan.
    edges: [Place; 2],
    /// The length of the longer one up to there.
    edge: f64,
    /// The cosine of the angle between its axis and the vertical.
    upright: f64,
}

impl Pose {
    fn of(held: Orientation, blade: Straight, height: f64) -> Self {
        let matrix = held.matrix();
        let axis = |column: usize| [matrix[0][column], matrix[1][column], matrix[2][column]];
        let [ahead, normal, down] = [axis(0), axis(1), axis(2)];
        let (sin, cos) = libm::sincos(blade.half_apex.to_rad());
        let edge = |side: f64| core::array::from_fn(|row| side * sin * ahead[row] - cos * down[row]);
        let edges: [[f64; 3]; 2] = [edge(1.0), edge(-1.0)];
        let long = edges.map(|[_, _, up]| if up > 0.0 { height / up } else { f64::INFINITY });
        Self {
            normal: Place::new(normal[0], normal[1]),
            normal_up: normal[2],
            edges: [0, 1].map(|side| Place::new(edges[side][0], edges[side][1]).times(long[side])),
            edge: long[0].max(long[1]),
            upright: -down[2],
        }
    }

    /// The blade with its tip at a place, as a stroke from its back to its front.
    fn standing(&self, tip: Place, half: f64) -> Stroke {
        let ahead = self.normal.left();
        let reach = self.reach(ahead);
        let [from, to] = [-reach.behind, reach.ahead.max(LEAST)].map(|along| tip.plus(ahead.times(along)));
        Stroke {
            way: Piece::line(from, to),
            reaches: [Reach::NONE; 2],
            half,
        }
    }

    fn reach(&self, ahead: Place) -> Reach {
        let along = self.edges.map(|edge| edge.dot(ahead));
        Reach {
            behind: (-along[0]).max(-along[1]).max(0.0),
            ahead: along[0].max(along[1]).max(0.0),
        }
    }
}

fn is_vertical(line: &LinearSegment) -> bool {
    let [from, to] = [line.from.tip, line.to.tip].map(place_of);
    line.via.is_none() && from.distance(to) <= SAME
}
