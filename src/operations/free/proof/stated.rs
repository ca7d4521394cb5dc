//! The slits and the passes of each layer as a program states them.

use super::Tools;
use core::num::NonZeroU32;
use vcutc_backend_api::ir::{OperationId, Program};
use vcutc_process::chains::{ChainPiece, pieces};
use vcutc_process::from_above::{level, place_of};
use vcutc_process::slits::proof::ways;
use vcutc_process::slits::stated::{Stated, stated};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// Heights this close are one, in mm.
const LEVEL: f64 = 1e-6;

/// How upright a disc stands that does, as the cosine that it lacks.
const UPRIGHT: f64 = 1e-12;

/// The passes of a layer, and the slits that were there before.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    pub(crate) number: NonZeroU32,
    /// The first chain of it.
    pub(crate) cut: NonZeroU32,
    /// Where the disc does not stand upright, or leaves the floor.
    pub(crate) astray: Option<Place>,
    floor: f64,
    slits: Vec<Vec<Piece>>,
    passes: Vec<Pass>,
}

impl Layer {
    pub(crate) const fn floor(&self) -> f64 {
        self.floor
    }

    pub(crate) fn slits(&self) -> &[Vec<Piece>] {
        &self.slits
    }

    /// Chain by chain.
    pub(crate) fn passes(&self) -> &[Pass] {
        &self.passes
    }

    pub(crate) fn first(&self) -> Option<Place> {
        Some(self.passes.first()?.pieces.first()?.from)
    }

    /// Whether slits and passes of both are the same.
    pub(crate) fn is_alike(&self, other: &Self) -> bool {
        self.passes == other.passes && self.slits == other.slits
    }
}

/// The layers of an operation, in the order of the program.
pub(crate) fn layers(program: &Program, operation: OperationId, tools: Tools) -> Vec<Layer> {
    let all: Vec<ChainPiece> = pieces(program, operation).collect();
    let top = program.stock.height.to_mm();
    let straight = program.blade(tools.straight).and_then(|blade| blade.straight());
    let slits = straight.map(|straight| stated(program, (operation, tools.straight), straight, top));
    let slits: Vec<Stated> = slits.unwrap_or_default();
    let of_disc: Vec<ChainPiece> = all
        .iter()
        .filter(|piece| piece.tool == tools.disc)
        .cloned()
        .collect();
    let layers = of_disc.chunk_by(|one, next| one.layer == next.layer);
    let layers = layers.filter_map(|pieces| {
        let first = pieces.first()?;
        // What the straight blade cuts before the disc comes.
        let before = all.iter().filter(|piece| piece.tool == tools.straight);
        let before = before.take_while(|piece| piece.op < first.op).count();
        // Without slits nothing is parted.
        layer(pieces, slits.get(..before).unwrap_or_default())
    });
    layers.collect()
}

fn layer(pieces: &[ChainPiece], slits: &[Stated]) -> Option<Layer> {
    let first = pieces.first()?;
    let heights = pieces
        .iter()
        .flat_map(|piece| [piece.line.from.tip.z, piece.line.to.tip.z]);
    let floor = heights.fold(f64::INFINITY, f64::min);
    let mut layer = Layer {
        number: first.layer,
        cut: first.cut,
        astray: None,
        floor,
        slits: Vec::new(),
        passes: Vec::new(),
    };
    let deep: Vec<&Stated> = slits.iter().filter(|slit| slit.floor <= floor + LEVEL).collect();
    layer.slits = ways(deep.into_iter());
    for chain in pieces.chunk_by(|one, next| one.cut == next.cut) {
        let mut flat = Vec::with_capacity(chain.len());
        for piece in chain {
            let is_upright = piece
                .held
                .iter()
                .all(|held| held.matrix()[2][2] <= -1.0 + UPRIGHT);
            let way = level(&piece.line).filter(|_| (piece.line.from.tip.z - floor).abs() <= LEVEL);
            match way.filter(|_| is_upright) {
                Some(way) => flat.push(way),
                None => layer.astray = layer.astray.or(Some(place_of(piece.line.from.tip))),
            }
        }
        if !flat.is_empty() {
            layer.passes.push(Pass {
                level: 0,
                pieces: flat,
            });
        }
    }
    Some(layer)
}
