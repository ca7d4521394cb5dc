//! What pictures show of passes over a region.

use vcutc_job::operation::judged::{Stays, WhyItStays};
use vcutc_region::coverage::{Spot, Square, Tool, unreachable};
use vcutc_region::engagement::{engagement, on_pieces};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::region::Region;

/// Smaller places are not seen in a picture, in mm2.
const SEEN: f64 = 0.01;

/// Stretches of passes with the angle of the rim in the material, in rad; none where that is not known.
#[must_use]
pub fn stretches(region: &Region, passes: &[Pass], radius: f64) -> Vec<(Piece, f64)> {
    let Ok(found) = engagement(region, passes, radius) else {
        return Vec::new();
    };
    let mut stretches = Vec::new();
    for (pass, profile) in passes.iter().zip(&found.profiles) {
        for (stretch, piece, begun) in on_pieces(pass, profile) {
            let [from, to] = stretch
                .way
                .map(|way| ((way - begun) / piece.length()).clamp(0.0, 1.0));
            stretches.push((piece.part(from, to), stretch.angles[1]));
        }
    }
    stretches
}

/// Those places that a picture shows.
#[must_use]
pub fn seen(spots: Vec<Spot>) -> Vec<Square> {
    let spots = spots.into_iter().filter(is_seen);
    spots.flat_map(|spot| spot.squares).collect()
}

/// Whether a picture shows a place.
fn is_seen(spot: &Spot) -> bool {
    spot.area >= SEEN
}

/// The ground that stays, place by place: what is uncut, and what no tool reaches that keeps so far from the walls.
#[must_use]
pub fn stays(uncut: &[Spot], region: &Region, tool: Tool) -> Vec<Stays> {
    let beyond = unreachable(region, tool).map_or_else(|_| Vec::new(), |left| left.spots);
    let seen = |spots: &[Spot], why: WhyItStays| {
        let seen = spots.iter().filter(|spot| is_seen(spot)).cloned();
        seen.map(|spot| Stays { spot, why }).collect::<Vec<_>>()
    };
    [
        seen(uncut, WhyItStays::Uncut),
        seen(&beyond, WhyItStays::BeyondReach),
    ]
    .concat()
}
