//! The passes over a region as a program states them.

use core::num::NonZeroU32;
use vcutc_backend_api::ir::{OpId, OperationId, Program, ToolId};
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::Speed;
use vcutc_process::chains::{ChainPiece, pieces};
use vcutc_process::from_above::{level, place_of};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// Heights this close are one, in mm.
const LEVEL: f64 = 1e-6;

/// How upright a tool stands that does, as the cosine that it lacks.
const UPRIGHT: f64 = 1e-12;

/// How far the lines that stand for an arc that goes down may be off it, in mm.
const CHORD: f64 = 1e-3;

/// An op that moves the tool, and its programmed speed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Move {
    pub(crate) op: OpId,
    pub(crate) feed: Option<Speed>,
}

/// An op that moves the tool off the floor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sloping {
    pub(crate) op: OpId,
    /// How far down, in mm.
    pub(crate) lowest: f64,
}

/// The passes of a layer.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    pub(crate) number: NonZeroU32,
    /// The first chain of it.
    pub(crate) cut: NonZeroU32,
    pub(crate) tool: ToolId,
    /// Where the tool goes down the farthest first.
    pub(crate) lowest: Place,
    /// Where the tool does not stand upright, if anywhere.
    pub(crate) leaning: Option<Place>,
    /// How far what stands for ways down may be off them, in mm.
    pub(crate) slack: f64,
    /// What moves the tool down, up and above the floor.
    pub(crate) sloping_moves: Vec<Sloping>,
    floor: f64,
    /// What moves the tool along each piece of `flat`.
    moves: Vec<Vec<Move>>,
    flat: Vec<Pass>,
    sloping: Vec<Pass>,
}

impl Layer {
    /// How far down the tool goes, in mm.
    pub(crate) const fn floor(&self) -> f64 {
        self.floor
    }

    /// What runs along the floor, chain by chain.
    pub(crate) fn flat(&self) -> &[Pass] {
        &self.flat
    }

    /// What moves the tool along a piece of that.
    pub(crate) fn along(&self, pass: usize, piece: usize) -> Option<Move> {
        self.moves.get(pass)?.get(piece).copied()
    }

    /// All ways, those down and up among them.
    pub(crate) fn all(&self) -> Vec<Pass> {
        self.flat.iter().chain(&self.sloping).cloned().collect()
    }
}

/// The layers of an operation, in the order of the program.
pub(crate) fn layers(program: &Program, operation: OperationId) -> Vec<Layer> {
    let pieces: Vec<ChainPiece> = pieces(program, operation).collect();
    let layers = pieces.chunk_by(|one, next| one.layer == next.layer);
    layers.filter_map(layer).collect()
}

fn is_upright(piece: &ChainPiece) -> bool {
    piece
        .held
        .iter()
        .all(|held| held.matrix()[2][2] <= -1.0 + UPRIGHT)
}

fn layer(pieces: &[ChainPiece]) -> Option<Layer> {
    let first = pieces.first()?;
    let ends = pieces
        .iter()
        .flat_map(|piece| [piece.line.from.tip, piece.line.to.tip]);
    let lowest = ends.min_by(|one, other| one.z.total_cmp(&other.z))?;
    let mut layer = Layer {
        number: first.layer,
        cut: first.cut,
        tool: first.tool,
        lowest: place_of(lowest),
        leaning: None,
        slack: 0.0,
        sloping_moves: Vec::new(),
        floor: lowest.z,
        moves: Vec::new(),
        flat: Vec::new(),
        sloping: Vec::new(),
    };
    for chain in pieces.chunk_by(|one, next| one.cut == next.cut) {
        let mut flat = Vec::new();
        let mut moves = Vec::new();
        for piece in chain {
            if !is_upright(piece) && layer.leaning.is_none() {
                layer.leaning = Some(place_of(piece.line.from.tip));
            }
            match along_floor(&piece.line, layer.floor) {
                Some(level) => {
                    flat.push(level);
                    moves.push(Move {
                        op: piece.op,
                        feed: piece.line.feed,
                    });
                }
                None => {
                    layer.sloping_moves.push(Sloping {
                        op: piece.op,
                        lowest: piece.line.from.tip.z.min(piece.line.to.tip.z),
                    });
                    layer.slopes(&piece.line);
                }
            }
        }
        if !flat.is_empty() {
            layer.moves.push(moves);
            layer.flat.push(Pass {
                level: 0,
                pieces: flat,
            });
        }
    }
    Some(layer)
}

impl Layer {
    fn slopes(&mut self, line: &LinearSegment) {
        let pieces = sloping(line);
        if line.via.is_some() {
            self.slack = CHORD;
        }
        if !pieces.is_empty() {
            self.sloping.push(Pass { level: 0, pieces });
        }
    }
}

/// A piece along the floor, in the plan.
fn along_floor(line: &LinearSegment, floor: f64) -> Option<Piece> {
    level(line).filter(|_| (line.from.tip.z - floor).abs() <= LEVEL)
}

/// A way down or up as lines of the plan.
fn sloping(line: &LinearSegment) -> Vec<Piece> {
    let ends = [line.from.tip, line.to.tip].map(place_of);
    let places: Vec<Place> = match line.arc() {
        None => ends.to_vec(),
        Some(arc) => {
            let radius = arc.radius().to_mm();
            let widest = 2.0 * libm::acos((1.0 - CHORD / radius).clamp(-1.0, 1.0));
            // An arc of a program has less than a whole turn, so this is a few thousand at most for radii up to kilometres.
            let count = libm::ceil(arc.sweep().to_rad() / widest.max(1e-3)).max(1.0) as u32;
            let points =
                (0..=count).map(|k| arc.at(arc.sweep().to_rad() * (f64::from(k) / f64::from(count))));
            points.map(|[x, y, _]| Place::new(x, y)).collect()
        }
    };
    let pairs = places.iter().zip(places.iter().skip(1));
    pairs
        .filter(|(from, to)| from != to)
        .map(|(&from, &to)| Piece::line(from, to))
        .collect()
}
