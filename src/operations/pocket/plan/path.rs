//! From runs over the plan to paths in space: for each layer the way down, the passes at its floor, and the way up.

use super::helix::Helix;
use super::{Entry, Plan, Run};
use vcutc_backend_api::units::Angle;
use vcutc_process::pen::{Pace, Path, Pen};
use vcutc_region::piece::Piece;

/// The heights between which a layer lies, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// What is above it: the top of the stock, or the floor of the layer before.
    pub above: f64,
    pub floor: f64,
    pub place: LayerPlace,
}

/// Where a layer lies among others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerPlace {
    /// Nothing of the pocket is cleared yet.
    First,
    /// The one above it is cleared.
    Below,
}

/// Share of the steepest way down that is used: points are rounded.
const CARE: f64 = 0.98;

/// The paths of a layer. Each begins and ends at `top`, the height from which on the air is free, or beside the stock.
#[must_use]
pub fn paths(plan: &Plan, layer: Layer, top: f64, ramp: Angle) -> Vec<Path> {
    let runs = plan.runs.iter();
    runs.map(|run| path(run, layer, top, ramp)).collect()
}

fn path(run: &Run, layer: Layer, top: f64, ramp: Angle) -> Path {
    let mut pen = match run.entry {
        Entry::Ramp { line } => {
            let mut pen = Pen::at(line.from, top);
            go_down(&mut pen, line, layer, top, ramp);
            pen
        }
        Entry::Helix { helix } => round_down(helix, layer, top, ramp),
        Entry::Hole { at } | Entry::Return { at } => {
            let mut pen = Pen::at(at, top);
            pen.line(at, layer.floor, Pace::Travel);
            pen.stop();
            pen
        }
        Entry::Open { from } => Pen::at(from, layer.floor),
    };
    for leg in &run.legs {
        let pace = if leg.kind.is_slow() {
            Pace::Plunge
        } else {
            Pace::Cut
        };
        pen.piece(leg.piece, layer.floor, pace);
    }
    if let Some(last) = run.legs.last() {
        pen.stop();
        pen.line(last.piece.to, top, Pace::Travel);
    }
    pen.finish()
}

/// Down to and fro along a line, once to and fro at the floor, and to a stop where it began: there the layer before, if there is
/// one, has left the way down free. Above the first one a verifier knows no air within the box of the stock, so the tool goes to
/// and fro there too.
fn go_down(pen: &mut Pen, line: Piece, layer: Layer, top: f64, ramp: Angle) {
    let Layer { above, floor, place } = layer;
    match place {
        LayerPlace::First => back_and_forth(pen, line, [top, above], ramp, Pace::Travel),
        LayerPlace::Below => {
            pen.line(line.from, above, Pace::Travel);
            pen.stop();
        }
    }
    back_and_forth(pen, line, [above, floor], ramp, Pace::Plunge);
    for end in [line.to, line.from] {
        pen.line(end, floor, Pace::Plunge);
        pen.stop();
    }
}

/// Down round a polygon, and once round at the floor. Above the first layer the tool goes round too, as it goes to and fro.
fn round_down(helix: Helix, layer: Layer, top: f64, ramp: Angle) -> Pen {
    let Layer { above, floor, place } = layer;
    let sides = |drop: f64| helix.sides_down(drop, ramp.to_rad());
    let through_air = match place {
        LayerPlace::First => sides(top - above),
        LayerPlace::Below => 0,
    };
    let down = sides(above - floor);
    let (corners, all) = (helix.corners, through_air + down);
    // So that it ends at the last corner.
    let begin = (corners - all % corners) % corners;
    let mut pen = Pen::at(helix.corner(begin), top);
    match place {
        LayerPlace::First => {
            let share = |side: u32| f64::from(side) / f64::from(through_air);
            for side in 1..=through_air {
                let z = top + (above - top) * share(side);
                pen.line(helix.corner(begin + side), z, Pace::Travel);
            }
        }
        LayerPlace::Below => {
            pen.line(helix.corner(begin), above, Pace::Travel);
            pen.stop();
        }
    }
    for side in 1..=down {
        let z = above + (floor - above) * (f64::from(side) / f64::from(down));
        pen.line(helix.corner(begin + through_air + side), z, Pace::Plunge);
    }
    for side in 1..=corners {
        pen.line(helix.corner(side), floor, Pace::Plunge);
    }
    pen.stop();
    pen
}

/// How often the tool goes along a line, to and fro, to get down so far, in mm, no more steeply than `ramp`, in rad.
pub(super) fn ways_down(line: Piece, drop: f64, ramp: f64) -> u32 {
    let steepest = line.length() * libm::tan(ramp * CARE);
    // The cast saturates, and a stock is at most 100 m high.
    2 * libm::ceil(drop / (2.0 * steepest)).max(0.0) as u32
}

fn back_and_forth(pen: &mut Pen, line: Piece, [from, to]: [f64; 2], ramp: Angle, pace: Pace) {
    let ways = ways_down(line, from - to, ramp.to_rad());
    for way in 1..=ways {
        let end = if way % 2 == 1 { line.to } else { line.from };
        let share = f64::from(way) / f64::from(ways);
        pen.line(end, from + (to - from) * share, pace);
        pen.stop();
    }
}
