//! In which order strips come out: always towards what stands, never over a crest.
//!
//! The disc comes from the open side of a strip. Its pass is sound if, before it,
//!
//! - nothing over the rest of its cover, up to a diameter away from the far slit, stands higher than its edge, but for slivers
//!   that its lead shaves;
//! - nothing stands under its body, the strip itself included;
//! - the part stays below its edge over all of the cover *(derived here)*.
//!
//! A strip that comes out lowers what stands and thereby only helps the others. So it does not matter which of those that can
//! be freed is taken first: what is left when none can is the same in any order. Layers are cut from the top, as a lower strip
//! never helps a higher one: it lies where that one's edge passes over already.

use super::Strip;
use super::blades::{Shaft, TOUCH, Wheel};
use super::ground::Ground;
use super::layout::Piece;
use super::terrain::Terrain;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::surface::Side;

/// What decides whether a strip can be freed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Access<'a> {
    pub(crate) ground: &'a Ground<'a>,
    pub(crate) wheel: &'a Wheel,
    pub(crate) bound: &'a Profile,
}

/// The result of ordering the strips of a layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Ordered {
    /// Those that come out, in order.
    pub(crate) strips: Vec<Strip>,
    /// Those that do not, from left to right.
    pub(crate) stuck: Vec<Piece>,
}

impl Access<'_> {
    /// Orders the strips of one layer, starting from a side. The terrain is what stands before, and then what is left.
    pub(crate) fn order(&self, layer: &[Piece], start: Side, terrain: &mut Terrain) -> Ordered {
        let mut strips = Vec::with_capacity(layer.len());
        let mut stuck = layer.to_vec();
        let mut open = start;
        let mut fruitless = 0;
        // Once from each side without a strip: there is none that can be freed.
        while fruitless < 2 && !stuck.is_empty() {
            let before = stuck.len();
            if open == Side::Right {
                stuck.reverse();
            }
            stuck.retain(|&piece| {
                // It came out with its neighbour.
                if self.ground.is_gone(piece.extent, terrain) {
                    return false;
                }
                let strip = self.free(piece, open, terrain);
                strips.extend(strip);
                strip.is_none()
            });
            if open == Side::Right {
                stuck.reverse();
            }
            fruitless = if stuck.len() < before { 0 } else { fruitless + 1 };
            open = open.opposite();
        }
        Ordered { strips, stuck }
    }

    /// Takes a strip out, if it comes free from a side.
    fn free(&self, piece: Piece, open: Side, terrain: &mut Terrain) -> Option<Strip> {
        let centre = self.on_grid(self.wheel.centre_over(piece.extent, open), open);
        let stands = self.ground.stands(piece.extent.floor);
        let is_free = self.is_uncovered(piece, terrain)
            && self.passes(piece, open, centre, terrain)
            && self
                .wheel
                .body
                .iter()
                .all(|&shaft| self.has_room(shaft, centre, terrain))
            && self.wheel.entry(self.bound, centre) <= TOUCH;
        let top = terrain.highest(piece.extent.left, piece.extent.right);
        is_free.then(|| {
            terrain.lower(piece.extent.left, piece.extent.right, stands);
            self.free_beyond(piece, open, terrain);
            Strip {
                layer: piece.layer,
                left: piece.extent.left,
                right: piece.extent.right,
                floor: piece.extent.floor,
                top: top.unwrap_or(piece.top),
                open,
                centre,
                origin: piece.origin,
            }
        })
    }

    /// Where a wall is closer to the far slit than the rim goes beyond it, what stands between comes out with the strip.
    fn free_beyond(&self, piece: Piece, open: Side, terrain: &mut Terrain) {
        let stands = self.ground.stands(piece.extent.floor);
        let far = match open {
            Side::Left => piece.extent.right,
            Side::Right => piece.extent.left,
        };
        let beyond = self.wheel.beyond.to_mm();
        if let Some(wall) = terrain.falls_beside(far, open.opposite(), beyond, stands) {
            terrain.lower(far.min(wall), far.max(wall), stands);
        }
    }

    /// The centre of the disc rounded so that its rim goes no less far beyond the slit, and its edge no lower.
    fn on_grid(&self, centre: Point2, open: Side) -> Point2 {
        let x = match open {
            Side::Left => self.ground.up(centre.x),
            Side::Right => self.ground.down(centre.x),
        };
        Point2::new(x, self.ground.up(centre.z))
    }

    /// Whether the strips above it are out.
    fn is_uncovered(&self, piece: Piece, terrain: &Terrain) -> bool {
        let standing = terrain.highest(piece.extent.left, piece.extent.right);
        standing.is_none_or(|height| height <= piece.top + TOUCH)
    }

    /// Whether the disc passes over all that its edge covers on the open side.
    fn passes(&self, piece: Piece, open: Side, centre: Point2, terrain: &Terrain) -> bool {
        let radius = self.wheel.radius.to_mm();
        let standing = match open {
            Side::Left => terrain.highest(centre.x - radius, piece.extent.left),
            Side::Right => terrain.highest(piece.extent.right, centre.x + radius),
        };
        standing.is_none_or(|height| height <= self.ground.stands(piece.extent.floor) + TOUCH)
    }

    /// Whether nothing stands under a stage of the body.
    fn has_room(&self, shaft: Shaft, centre: Point2, terrain: &Terrain) -> bool {
        // Rounding of the centre must not refuse a strip as wide as the body lets it be.
        let room = (shaft.radius + self.wheel.clearance).to_mm() - self.ground.spacing();
        let underside = centre.z + self.wheel.underside(shaft).to_mm();
        terrain
            .highest(centre.x - room, centre.x + room)
            .is_none_or(|height| height <= underside + TOUCH)
    }
}

/// The side from which the next layer is begun: where the last strip came out.
pub(crate) fn nearer_side(strips: &[Strip], width: f64) -> Side {
    match strips.last() {
        Some(last) if last.left + last.right > width => Side::Right,
        _ => Side::Left,
    }
}

/// Strips that are stuck side by side, from the first one on.
pub(crate) fn first_run(stuck: &[Piece]) -> Option<(f64, f64)> {
    let mut pieces = stuck.iter();
    let first = pieces.next()?.extent;
    let mut right = first.right;
    for piece in pieces {
        if piece.extent.left - right > TOUCH {
            break;
        }
        right = piece.extent.right;
    }
    Some((first.left, right))
}
