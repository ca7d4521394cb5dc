//! Programs and stocks seen from above, as proofs about regions of the plan see them.

pub mod shown;
mod sides;

use crate::lower::ROUNDING_ROOM;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::Length;
use vcutc_region::coverage::Tool;
use vcutc_region::distance::Walls;
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::Region;
use vcutc_simulation::surface::Surface;

/// A pocket that is less deep does not count, in mm: far below what a machine repeats.
pub const THINNEST: f64 = 0.01;

/// Heights this close are one, in mm.
const LEVEL: f64 = 1e-6;

/// How far a place may lie within a side of the stock by rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// The highest of a surface over a region and as far beside it as a tool reaches, in mm.
#[must_use]
pub fn highest(surface: &mut Surface, region: &Region, reach: f64) -> f64 {
    let bounds = region.bounds();
    surface.highest(bounds.low.x - reach, bounds.high.x + reach)
}

/// Most layers of a pocket.
const MOST_LAYERS: f64 = 10_000.0;

/// The floors of equal layers from a top down to a floor, each no thicker than this, in mm, from the top; none where they are too many.
#[must_use]
pub fn layers(top: f64, floor: f64, thickest: f64) -> Option<Vec<f64>> {
    let deep = top - floor;
    let count = libm::ceil(deep / thickest - 1e-9).max(1.0);
    if count > MOST_LAYERS {
        return None;
    }
    let layers = count as u32;
    let at = |layer: u32| top - deep * (f64::from(layer) / count);
    let floors = (1..=layers).map(|layer| if layer == layers { floor } else { at(layer) });
    Some(floors.collect())
}

/// A point in the plan.
#[must_use]
pub const fn place_of(point: Point3) -> Place {
    Place::new(point.x, point.y)
}

/// A way at one height in the plan; none of others.
#[must_use]
pub fn level(line: &LinearSegment) -> Option<Piece> {
    let [from, to] = [line.from.tip, line.to.tip];
    let is_level = [Some(to), line.via]
        .iter()
        .flatten()
        .all(|point| (point.z - from.z).abs() <= LEVEL);
    let [from, to] = [from, to].map(place_of);
    is_level.then(|| match line.via.map(place_of) {
        None => Piece::line(from, to),
        Some(via) => {
            let (first, second) = (via.minus(from), to.minus(via));
            // The angle of the arc is twice that between both chords (inscribed angles).
            Piece::arc(
                from,
                to,
                2.0 * libm::atan2(first.cross(second), first.dot(second)),
            )
        }
    })
}

/// Whether a place lies over a stock, not on its sides.
#[must_use]
pub fn is_over(stock: Stock, at: Place) -> bool {
    let within = |at: f64, length: Length| at > ROUNDING && at < length.to_mm() - ROUNDING;
    within(at.x, stock.width) && within(at.y, stock.depth)
}

/// The tool as far as it is asked to reach: what it reaches only from places at which passes have no room for their rounding is beyond
/// it. Where walls come together that is more than a fringe, and a corridor by so little wider than the tool is not gone into.
#[must_use]
pub const fn reaching(tool: Tool) -> Tool {
    Tool {
        keep: tool.keep + ROUNDING_ROOM.to_mm() + ROUNDING,
        ..tool
    }
}

/// How far a round tool enters the stock from beside it, other than through an open side, and where: ways beyond open sides have the
/// sides of the stock beside these for walls.
#[must_use]
pub fn beyond_a_side(region: &Region, stock: Stock, passes: &[Pass], radius: f64) -> Option<(f64, Place)> {
    let sides = closed_sides(region, stock);
    let mut deepest: Option<(f64, Place)> = None;
    for piece in passes.iter().flat_map(|pass| &pass.pieces) {
        let ends = [piece.from, piece.to];
        if ends.iter().all(|end| is_over(stock, *end)) {
            continue;
        }
        if let Some((at, near)) = sides.nearest_to(*piece) {
            let by = radius - near.distance;
            if by > ROUNDING && deepest.is_none_or(|(known, _)| by > known) {
                deepest = Some((by, at));
            }
        }
    }
    deepest
}

/// The sides of a stock through which a region is not open.
#[must_use]
pub fn closed_sides(region: &Region, stock: Stock) -> Walls {
    Walls::of_pieces(sides::closed(region, stock).into_iter().enumerate())
}
