//! Passes over regions for pictures: the first layer of each operation, as a program states it.

use super::reaching;
use super::stated::layers;
use vcutc_backend_api::ir::{OperationId, Program, Shape};
use vcutc_backend_api::units::Length;
use vcutc_job::PlannedJob;
use vcutc_region::coverage::{Square, Tool, coverage};
use vcutc_region::engagement::engagement;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::Side;

/// The passes of one operation.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    pub walls: Vec<Piece>,
    /// Sides without a wall.
    pub open: Vec<Piece>,
    /// Stretches of passes, each with the angle of the rim in the material, in rad.
    pub stretches: Vec<(Piece, f64)>,
    /// Where ways at the floor begin.
    pub entries: Vec<Place>,
    /// What stays uncut.
    pub uncut: Vec<Square>,
}

/// The passes over regions of a program, operation by operation.
#[must_use]
pub fn shown(plan: &PlannedJob, program: &Program) -> Vec<Shown> {
    let numbered = (0..).map(OperationId).zip(&plan.operations);
    let shown = numbered.filter_map(|(operation, planned)| {
        let held = planned.clearing()?;
        let layers = layers(program, operation);
        let layer = layers.first()?;
        let Shape::Crusher(crusher) = program.blade(layer.tool)?.shape else {
            return None;
        };
        let radius = crusher.radius.to_mm();
        let tool = Tool {
            radius,
            keep: (crusher.radius + held.allowance + program.blend)
                .to_mm()
                .max(radius),
        };
        let of = |side: Side| {
            let edges = held.region.edges().filter(move |edge| edge.side == side);
            edges.map(|edge| edge.piece).collect()
        };
        let passes = layer.flat();
        let profiles =
            engagement(&held.region, passes, radius).map_or_else(|_| Vec::new(), |found| found.profiles);
        let mut stretches = Vec::new();
        for (pass, profile) in passes.iter().zip(&profiles) {
            let mut begun = 0.0;
            let mut at = 0;
            for stretch in profile {
                while at < stretch.piece {
                    begun += pass.pieces.get(at).map_or(0.0, |piece| piece.length());
                    at += 1;
                }
                let Some(piece) = pass.pieces.get(at) else {
                    continue;
                };
                let [from, to] = stretch
                    .way
                    .map(|way| ((way - begun) / piece.length()).clamp(0.0, 1.0));
                stretches.push((piece.part(from, to), stretch.angles[1]));
            }
        }
        let left = coverage(&held.region, passes, reaching(tool));
        Some(Shown {
            walls: of(Side::Wall),
            open: of(Side::Open),
            stretches,
            entries: passes
                .iter()
                .filter_map(|pass| Some(pass.pieces.first()?.from))
                .collect(),
            uncut: left.map_or_else(
                |_| Vec::new(),
                |left| {
                    left.spots
                        .into_iter()
                        .filter(|spot| spot.area >= SEEN)
                        .flat_map(|spot| spot.squares)
                        .collect()
                },
            ),
        })
    });
    shown.collect()
}

/// Smaller places are not seen in a picture, in mm2.
const SEEN: f64 = 0.01;

/// Points of a piece, close enough for a picture.
#[must_use]
pub fn points(piece: Piece, apart: Length) -> Vec<Place> {
    let count = match piece.radius() {
        None => 1,
        // A picture has no more points than it has places.
        Some(_) => libm::ceil(piece.length() / apart.to_mm()).clamp(2.0, 500.0) as u32,
    };
    (0..=count)
        .map(|k| piece.at(f64::from(k) / f64::from(count)))
        .collect()
}
