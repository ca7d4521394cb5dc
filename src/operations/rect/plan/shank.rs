//! The body of the straight blade above its edge, which slits carry along what stands beside them.
//!
//! A slit whose body would meet what stands is not cut, and neither are the strips that need it: they stay, with all below them
//! (avoidance by lifting [Yu 2019]). A body that is not stated is not looked at.

use super::blades::TOUCH;
use super::ground::Ground;
use super::layout::{Layout, Piece};
use super::terrain::Terrain;
use super::{PlannedRect, Slit, Stage};
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{BodyStage, Stock};
use vcutc_simulation::body;

/// The stages of the body, and how slits hold the blade.
#[derive(Clone, Debug, PartialEq)]
pub struct Shank {
    /// From the edge up.
    pub stages: Vec<BodyStage>,
    /// On ways towards +y. On the way back the lean along the feed is another one, which does not show in the section.
    pub held: Orientation,
    /// How far slits run out beyond the stock, in mm.
    pub extension: f64,
}

impl Shank {
    /// The slits of a plan on which it meets what stands when they are cut.
    pub(crate) fn meets(&self, plan: &PlannedRect, ground: &Ground<'_>, stock: Stock) -> Vec<Slit> {
        let mut standing = ground.before();
        let mut met = Vec::new();
        for stage in &plan.stages {
            match stage {
                Stage::Slits { slits, .. } => {
                    let blocked = slits.iter().filter(|slit| !self.clears(**slit, &standing, stock));
                    met.extend(blocked.copied());
                }
                Stage::Strips { strips, .. } => {
                    for strip in strips {
                        standing.lower(strip.left, strip.right, ground.stands(strip.floor));
                    }
                }
            }
        }
        met
    }

    fn clears(&self, slit: Slit, standing: &Terrain, stock: Stock) -> bool {
        let widest = self.stages.iter().map(|stage| stage.radius.to_mm());
        let reach = widest.fold(0.0, f64::max);
        let beside = standing.corners(slit.x - reach, slit.x + reach);
        let (front, back) = (-self.extension, stock.depth.to_mm() + self.extension);
        let way = [front, back].map(|y| Point3::new(slit.x, y, slit.bottom));
        body::clears(&self.stages, self.held, way, stock, &beside)
    }
}

/// A layout without the strips that these slits free, and without all below them.
pub(crate) fn without(layout: &Layout, slits: &[Slit], ground: &Ground<'_>) -> Layout {
    let needs = |piece: &Piece| {
        let ends = [piece.extent.left, piece.extent.right];
        let bottom = ground.slit_bottom(piece.extent.floor);
        let is_its = |slit: &Slit| {
            ends.iter().any(|end| (end - slit.x).abs() <= TOUCH) && bottom <= slit.bottom + TOUCH
        };
        slits.iter().any(is_its)
    };
    let mut kept: Vec<Piece> = Vec::with_capacity(layout.pieces.len());
    let mut stays: Vec<Piece> = Vec::new();
    for &piece in &layout.pieces {
        if needs(&piece) || stays.iter().any(|above| above.is_over(&piece)) {
            stays.push(piece);
        } else {
            kept.push(piece);
        }
    }
    Layout {
        levels: layout.levels.clone(),
        pieces: kept,
    }
}
