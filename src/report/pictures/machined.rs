//! What the cuts make, as the proof replays them: chips in the order in which they come free, and the surface layer by layer.

use super::super::Material;
use super::{pair, pairs};
use vcutc_backend_api::ir::{Action, Op, Site};
use vcutc_geometry::curve::Point2;
use vcutc_picture::contour;
use vcutc_picture::thin::Thinned;
use vcutc_process::verdict;
use vcutc_simulation::cross_section;
use vcutc_simulation::prove;

/// What the cuts make.
pub(super) struct Machined {
    /// The machined contour, from left to right.
    pub(super) contour: Vec<[f64; 2]>,
    /// The chips in the order in which they come free.
    pub(super) chips: Vec<Taken>,
    /// The surface after each layer, or after every few layers of many.
    pub(super) surfaces: Vec<Vec<[f64; 2]>>,
}

/// A chip, and what has freed it.
pub(super) struct Taken {
    pub(super) shown: contour::Chip,
    pub(super) by: By,
}

/// What frees a chip.
pub(super) enum By {
    /// The flanks of a V, or one of them.
    Flanks,
    /// A pass of a disc, or another chain.
    Disc,
}

/// Most surfaces that are kept: more layers could not be distinguished.
const MOST_SURFACES: usize = 60;
/// Columns in which a surface is looked at.
const COLUMNS: u32 = 2400;

pub(super) fn machined(material: &Material<'_>) -> Machined {
    let program = material.compiled.program.verified();
    let layers = material.compiled.report.layers.len();
    let mut view = View {
        every: layers.div_ceil(MOST_SURFACES).max(1),
        chips: Vec::new(),
        surfaces: Vec::new(),
        at: None,
        passed: 0,
        before: None,
    };
    let ops = &program.program().ops;
    let mut last: Option<&Op> = None;
    let bounds = verdict::bounds(material.plan);
    let (taken, surface) = prove::watched(program, &bounds, &mut |op, surface, taken| {
        if let Some(op) = last {
            view.take(op, taken);
        }
        last = ops.get(op.0 as usize);
        view.go_on(last, || seen(surface.corners()));
    });
    if let Some(op) = last {
        view.take(op, taken);
    }
    view.surfaces.push(seen(surface.corners()));
    Machined {
        contour: surface.corners().map(pair).collect(),
        chips: view.chips,
        surfaces: view.surfaces,
    }
}

/// What is seen so far.
struct View {
    /// Every so many layers the surface is kept.
    every: usize,
    chips: Vec<Taken>,
    surfaces: Vec<Vec<[f64; 2]>>,
    /// The layer of the last chip.
    at: Option<u32>,
    /// Layers that are passed.
    passed: usize,
    /// The surface when that layer is left, while no other one has a chip.
    before: Option<Vec<[f64; 2]>>,
}

impl View {
    /// Before an op.
    fn go_on(&mut self, op: Option<&Op>, surface: impl FnOnce() -> Vec<[f64; 2]>) {
        let layer = op.and_then(layer);
        let leaves = self.at.is_some() && layer.is_some() && layer != self.at;
        if leaves && self.before.is_none() && (self.passed + 1).is_multiple_of(self.every) {
            self.before = Some(surface());
        }
    }

    /// After an op.
    fn take(&mut self, op: &Op, taken: Vec<cross_section::Taken>) {
        let Some(layer) = layer(op) else { return };
        for taken in taken {
            let chip = match taken {
                cross_section::Taken::Chip(chip) => chip,
                cross_section::Taken::Slit(_) => continue,
            };
            let is_new = self.at.replace(layer).is_some_and(|before| before != layer);
            let before = self.before.take();
            if is_new {
                self.passed += 1;
                self.surfaces.extend(before);
            }
            self.chips.push(Taken {
                shown: contour::Chip {
                    layer,
                    outline: pairs(&chip.outline()),
                },
                by: match op.action {
                    Action::Cut { .. } => By::Flanks,
                    _ => By::Disc,
                },
            });
        }
    }
}

fn layer(op: &Op) -> Option<u32> {
    match op.site {
        Site::Cut { layer, .. } => Some(layer.get()),
        Site::Program | Site::Operation(_) | Site::Layer { .. } => None,
    }
}

/// A surface, of no more points than can be seen.
fn seen(corners: impl Iterator<Item = Point2>) -> Vec<[f64; 2]> {
    let corners: Vec<[f64; 2]> = corners.map(pair).collect();
    Thinned::of(&corners, COLUMNS)
}
