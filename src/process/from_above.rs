//! Programs and stocks seen from above, as proofs about regions of the plan see them.

mod sides;

use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::Length;
use vcutc_region::distance::Walls;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::Region;
use vcutc_simulation::surface::Surface;

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

/// The sides of a stock through which a region is not open.
#[must_use]
pub fn closed_sides(region: &Region, stock: Stock) -> Walls {
    Walls::of_pieces(sides::closed(region, stock).into_iter().enumerate())
}
