//! From what is asked to slits and strips in order.
//!
//! [`plan`] decides what is open (`automatic`), lays strips over the stock by residual strategy (`layout`, `mixed`), cuts slits
//! between them (`slits`) and puts the strips in an order in which the disc gets at each (`access`). Either it comes to a plan,
//! or it says with numbers what is in the way ([`refusal`]). Nothing is promised: the cuts are proven later, from the program.
//!
//! Coordinates are in mm in the x-z plane of the workpiece. With a lead the disc leaves an arc, not a line. Plans count with its
//! lowest point, the floor of the strip, and with its highest one over the strip, where slits end; so every figure of what stays
//! is at least what stays.

mod access;
mod automatic;
pub mod blades;
mod ground;
mod layout;
mod mixed;
pub mod model;
pub mod refusal;
pub mod shank;
pub mod slits;
mod terrain;
#[cfg(test)]
mod tests;
mod trial;

pub use automatic::{LEAST_LAYER, plan};

use crate::asked::Residual;
use blades::{Knife, Wheel};
use core::ops::RangeInclusive;
use model::{Counts, Pace};
use shank::Shank;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::Auto;
use vcutc_simulation::surface::Side;

/// What is to be roughed. Both profiles span the stock.
#[derive(Clone, Copy, Debug)]
pub struct Work<'w> {
    pub stock: Stock,
    /// The part as it is drawn: what stays is measured from it.
    pub part: &'w Profile,
    /// The part with its allowance: nothing goes below.
    pub bound: &'w Profile,
    /// What the operations before left of the stock, from side to side; two corners at one x are a wall.
    pub before: &'w [Point2],
    /// The allowance.
    pub allowance: Length,
}

/// What is asked of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Wish {
    /// Height of layers; positive. `auto` is the largest that both blades take.
    pub layer: Auto<Length>,
    /// Width of strips; positive. `auto` is the largest that the disc frees.
    pub step: Auto<Length>,
    /// How many layers slits go through; at least 1. `auto` is the fastest.
    pub through: Auto<u32>,
    /// `auto` is `mixed`.
    pub residual: Auto<Residual>,
    /// Nothing below is cut.
    pub down_to: Length,
    pub limits: Limits,
    pub rounding: Rounding,
    /// The smallest share of a layer or step that a strip at the part is cut for; see [`WORTH`].
    pub worth: f64,
}

/// The share of a layer that is worth a strip at the part. As for V-cuts a judgement, from no source.
pub const WORTH: f64 = 0.05;

/// Bounds on what is chosen, and on the result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    pub layer: Span,
    pub step: Span,
    /// The most material that may stay on the part.
    pub scallop: Option<Length>,
    pub changes: Option<u32>,
    /// Slits and strips together.
    pub cuts: Option<usize>,
    /// Time by the model.
    pub time: Option<Duration>,
}

/// Bounds from below and above.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Span {
    pub least: Option<Length>,
    pub most: Option<Length>,
}

/// Where places of cuts lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// Where formulas put them.
    Exact,
    /// On the grid that programs print, never nearer to the part.
    Grid,
}

/// What cuts, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Blades {
    pub knife: Knife,
    /// The body of the straight blade, if the job states it.
    pub shank: Option<Shank>,
    pub wheel: Wheel,
    pub pace: Pace,
}

/// Rectangular roughing with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRect {
    pub layer: Length,
    pub step: Length,
    /// How many layers slits go through.
    pub through: u32,
    /// As asked; `auto` has become `mixed`.
    pub residual: Residual,
    /// Heights of the layers from the top, in mm.
    pub levels: Vec<f64>,
    /// What the blades do, one after the other. No stage is empty, and every change of blade lies between two of them.
    pub stages: Vec<Stage>,
    /// Whether the body of the straight blade has room beside the slits.
    pub room: Room,
    /// The most that stays on the part.
    pub left: Length,
    /// What stays, from left to right; walls are two corners at one x.
    pub contour: Vec<Point2>,
    /// Its time by the model.
    pub time: Duration,
}

/// Whether the body of the straight blade has room beside slits; the best comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Room {
    /// It has, or nothing is known of it.
    Enough,
    /// It has without so many strips, which are left out.
    Without(usize),
    /// It meets what stands, and leaving out strips does not help.
    Lacking,
}

impl Room {
    /// How many strips are left out.
    #[must_use]
    pub const fn left_out(self) -> usize {
        match self {
            Self::Without(strips) => strips,
            Self::Enough | Self::Lacking => 0,
        }
    }
}

/// What one blade does before the other one comes.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// The straight blade cuts slits, to and fro.
    Slits {
        /// Counted from 1 at the top.
        layers: RangeInclusive<u32>,
        slits: Vec<Slit>,
    },
    /// The disc frees strips.
    Strips {
        layers: RangeInclusive<u32>,
        strips: Vec<Strip>,
    },
}

/// An upright slit along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slit {
    pub x: f64,
    /// Where the tip runs.
    pub bottom: f64,
    /// Up to where it cuts: the lower one of the surfaces beside it.
    pub uncut: f64,
    /// The higher one.
    pub top: f64,
}

/// A strip, and the pass that frees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Counted from 1 at the top.
    pub layer: u32,
    pub left: f64,
    pub right: f64,
    /// The lowest place that the edge of the disc may have anywhere.
    pub floor: f64,
    /// How high it stands before.
    pub top: f64,
    /// The side that the disc comes from.
    pub open: Side,
    /// Centre of the disc's edge.
    pub centre: Point2,
    pub origin: StripOrigin,
}

/// How a strip came to be where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StripOrigin {
    /// Of a whole layer.
    Layer,
    /// Raised onto the part.
    Lifted,
    /// A part of a column, up to the part.
    Shifted,
}

impl PlannedRect {
    /// How many slits, strips, changes and layers it has.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts {
            slits: self.slits().count(),
            strips: self.strips().count(),
            changes: self.stages.len().saturating_sub(1),
            layers: self.strips().map(|strip| strip.layer).max().unwrap_or(0),
        }
    }

    /// Its slits in order.
    pub fn slits(&self) -> impl Iterator<Item = &Slit> {
        self.stages.iter().flat_map(|stage| match stage {
            Stage::Slits { slits, .. } => slits.as_slice(),
            Stage::Strips { .. } => &[],
        })
    }

    /// Its strips in order.
    pub fn strips(&self) -> impl Iterator<Item = &Strip> {
        self.stages.iter().flat_map(|stage| match stage {
            Stage::Slits { .. } => &[],
            Stage::Strips { strips, .. } => strips.as_slice(),
        })
    }
}
