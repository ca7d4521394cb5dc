//! The sides of the stock in the plan, without those stretches through which a region is open.

use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::{Region, Side};

/// Places this close to a line lie on it, in mm; shorter stretches do not count.
const ON_IT: f64 = 1e-6;

/// What of the stock's sides has core right within it that is not of the region.
pub(super) fn closed(region: &Region, stock: Stock) -> Vec<Piece> {
    let [width, depth] = [stock.width, stock.depth].map(Length::to_mm);
    let corners = [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)].map(|(x, y)| Place::new(x, y));
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .flat_map(|(&from, &to)| without_open(region, from, to))
        .collect()
}

/// A side of the stock without its open stretches.
fn without_open(region: &Region, from: Place, to: Place) -> Vec<Piece> {
    let way = to.minus(from);
    let long = way.length();
    let ahead = way.times(1.0 / long);
    let along = |at: Place| at.minus(from).dot(ahead);
    let is_on_it = |at: &Place| at.minus(from).cross(ahead).abs() <= ON_IT;
    let open = region.edges().filter(|edge| edge.side == Side::Open);
    let on_it = open.filter(|edge| [edge.piece.from, edge.piece.to].iter().all(is_on_it));
    let mut gaps: Vec<[f64; 2]> = on_it
        .map(|edge| {
            let (a, b) = (along(edge.piece.from), along(edge.piece.to));
            [a.min(b), a.max(b)]
        })
        .collect();
    gaps.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let mut at = 0.0;
    let mut pieces = Vec::new();
    let mut push = |begin: f64, end: f64| {
        if end - begin > ON_IT {
            pieces.push(Piece::line(
                from.plus(ahead.times(begin)),
                from.plus(ahead.times(end)),
            ));
        }
    };
    for [begin, end] in gaps {
        push(at, begin);
        at = at.max(end);
    }
    push(at, long);
    pieces
}
