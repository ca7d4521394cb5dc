//! Where the tool goes into the blank without a pass: straight down, or from a place that nobody knows.
//!
//! V-cuts come from beside the blank, so a job has no such motion. What that means depends on the passes. Where those before it
//! have cut already, the motion is one through the air. Where a pass cuts later, nothing of the shape is missing, and the motion
//! is listed. Where none does, the job would leave standing what the program cuts, and the motion is refused. What has been cut
//! is measured on the surface that the V-cuts leave, the one by which they are planned.

use super::place::Blank;
use super::raster::{Pass, SAME};
use crate::geom::curve::Point2;
use crate::sim::surface::{Surface, Vee};
use crate::source::Span;

/// A motion that ends, or begins, below the top of the blank, in its axes from its corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plunge {
    /// Where it is said.
    pub place: Span,
    /// From where it leads.
    pub start: Start,
    /// Its lowest place, in mm.
    pub low: [f64; 3],
    /// How many passes come before it.
    pub before: usize,
}

impl Plunge {
    /// Whether it cuts nothing that another in the same place has not cut just before, as the way back up.
    pub(super) fn follows(&self, last: &Self) -> bool {
        let ([x, y, z], [x0, y0, z0]) = (self.low, last.low);
        (x - x0).abs() <= SAME && (y - y0).abs() <= SAME && z >= z0 - SAME
    }
}

/// From where a plunge leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// From above its lowest place, or from there upwards.
    Above,
    /// Nobody knows.
    Unknown,
}

/// Plunges into uncut material.
pub(super) struct Sorted {
    /// Where a pass cuts later.
    pub(super) cut_later: Vec<Plunge>,
    /// Where none does.
    pub(super) alone: Vec<Plunge>,
}

/// Sorts plunges, in the order of the program, by what the passes cut before them and behind them. `slope` is the rise of the
/// V-cuts' flanks over x.
pub(super) fn sorted(plunges: &[Plunge], passes: &[Pass], blank: Blank, slope: f64) -> Sorted {
    let mut sorted = Sorted {
        cut_later: Vec::new(),
        alone: Vec::new(),
    };
    if plunges.is_empty() {
        return sorted;
    }
    let mut surface = Surface::flat(blank.width, blank.height);
    let vee = |pass: &Pass| Vee {
        tip: Point2 { x: pass.x, z: pass.z },
        slope,
    };
    let stands = |surface: &mut Surface, plunge: &Plunge| {
        let [x, _, z] = plunge.low;
        surface.covers(Point2 { x, z: z + SAME })
    };
    let mut uncut: Vec<Plunge> = Vec::new();
    let mut done = 0;
    for plunge in plunges {
        for pass in passes.get(done..plunge.before).unwrap_or_default() {
            surface.release(vee(pass));
        }
        done = done.max(plunge.before);
        if stands(&mut surface, plunge) {
            uncut.push(*plunge);
        }
    }
    for pass in passes.get(done..).unwrap_or_default() {
        surface.release(vee(pass));
    }
    for plunge in uncut {
        if stands(&mut surface, &plunge) {
            sorted.alone.push(plunge);
        } else {
            sorted.cut_later.push(plunge);
        }
    }
    sorted
}
