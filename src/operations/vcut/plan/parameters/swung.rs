//! Parameters that are tried: a lattice at a swing, and what layers and steps it can have. No limit but the blade's is asked
//! after here; the caller tries which of them a job allows.

use super::super::blade_reach;
use super::grid_forms::{fits, largest_fitting, open_overlaps, tips_per_step, widest_step};
use super::search::Chosen;
use super::{Flanks, VcutParameters, complete, drop_at, edge_overhang, flanks_at, resolve_standoff};
use crate::asked::{Lattice, RoughVcut};
use core::cell::OnceCell;
use vcutc_backend_api::units::{Angle, Length};

/// A lattice at a swing, with the edge that the operation may use.
pub struct Swung<'s> {
    asked: &'s RoughVcut,
    lattice: Lattice,
    swing: Angle,
    /// Slope and reach of the flanks.
    pub flanks: Flanks,
    standoff: Length,
    /// How far the edge lies over the work, computed when it is first needed.
    edge: OnceCell<Length>,
}

impl<'s> Swung<'s> {
    /// None where the standoff contradicts the blade.
    #[must_use]
    pub fn new(asked: &'s RoughVcut, lattice: Lattice, swing: Angle) -> Option<Self> {
        let mut diagnostics = Vec::new();
        let standoff = resolve_standoff(asked, &mut diagnostics);
        diagnostics.is_empty().then(|| Self {
            asked,
            lattice,
            swing,
            flanks: flanks_at(asked, swing),
            standoff,
            edge: OnceCell::new(),
        })
    }

    /// How much higher the tip runs than the V that may be made.
    #[must_use]
    pub fn drop(&self) -> Length {
        drop_at(self.asked, self.standoff, &self.flanks, self.swing)
    }

    /// How many columns there are in a step, those of all layers together.
    #[must_use]
    pub const fn tips_per_step(&self) -> f64 {
        tips_per_step(self.lattice)
    }

    /// The largest layer that the blade reaches at an overlap.
    #[must_use]
    pub fn layer_at_overlap(&self, overlap: f64) -> Length {
        let closed_form = blade_reach::largest_layer(self.lattice, overlap, self.flanks.reach_in_lattice());
        largest_fitting(self.lattice, closed_form, &self.flanks, |layer| {
            self.widest_step(layer, overlap)
        })
    }

    /// The largest layer that the blade reaches at any overlap.
    #[must_use]
    pub fn largest_layer(&self) -> Length {
        open_overlaps()
            .map(|overlap| self.layer_at_overlap(overlap))
            .fold(Length::ZERO, Length::max)
    }

    /// The largest layer that the blade reaches at a step, if there is any.
    #[must_use]
    pub fn layer_at_step(&self, step: Length) -> Option<Length> {
        let (slope, reach) = (self.flanks.slope, self.flanks.reach_in_lattice());
        let closed_form = blade_reach::largest_layer_at_step(self.lattice, step, slope, reach)?;
        let layer = largest_fitting(self.lattice, closed_form, &self.flanks, |_| step);
        fits(self.lattice, layer, step, &self.flanks).then_some(layer)
    }

    /// The layer at which Vs of a step just meet: of thinner ones strips would stay between them.
    #[must_use]
    pub fn least_layer(&self, step: Length) -> Length {
        step * (self.flanks.slope / 2.0)
    }

    /// The widest step of a layer at an overlap, on the grid.
    #[must_use]
    pub fn widest_step(&self, layer: Length, overlap: f64) -> Length {
        widest_step(self.lattice, layer, overlap, &self.flanks)
    }

    /// The widest step of a layer that the blade reaches, and the overlap that goes with it.
    #[must_use]
    pub fn widest_fitting_step(&self, layer: Length) -> Option<(Length, f64)> {
        open_overlaps()
            .map(|overlap| (self.widest_step(layer, overlap), overlap))
            .find(|&(step, _)| fits(self.lattice, layer, step, &self.flanks))
    }

    /// The share by which Vs overlap.
    #[must_use]
    pub fn overlap(&self, layer: Length, step: Length) -> f64 {
        (1.0 - self.least_layer(step) / layer).max(0.0)
    }

    /// All that follows from a layer and a step. None where the extension that is given is too short.
    #[must_use]
    pub fn parameters(&self, layer: Length, step: Length, overlap: f64) -> Option<VcutParameters> {
        let chosen = Chosen {
            lattice: self.lattice,
            swing: self.swing,
            layer,
            step,
            overlap,
            binding: Vec::new(),
        };
        let edge = *self.edge.get_or_init(|| edge_overhang(self.asked, self.swing));
        complete(self.asked, self.standoff, edge, chosen, &mut Vec::new())
    }
}
