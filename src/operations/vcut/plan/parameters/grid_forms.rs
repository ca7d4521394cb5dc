//! Layers and steps on the grid: the widest step of a layer, the largest layer of a blade, and whether the blade reaches
//! what they need when tips are rounded to the grid.

use super::super::blade_reach::{self, Flanks};
use super::VcutParameters;
use crate::asked::{Lattice, RoughVcut};
use vcutc_backend_api::units::Length;
use vcutc_geometry::grid;
use vcutc_job::Auto;

/// Whether a blade reaches what a lattice needs, wherever rounding puts its tips.
pub(super) fn fits(lattice: Lattice, layer: Length, step: Length, flanks: &Flanks) -> bool {
    let needed = |layer: Length, step: Length| blade_reach::needed_reach(lattice, layer, step, flanks.slope);
    let layers = around(layer + flanks.lower, grid::SPACING);
    let steps = around(step, grid::SPACING * tips_per_step(lattice));
    let worst = layers
        .iter()
        .flat_map(|&layer| steps.iter().map(move |&step| needed(layer, step)));
    worst.fold(Length::ZERO, Length::max) <= flanks.reach + Length::mm(1e-6)
}

/// The spacings that tips rounded to the grid really have: the value itself where it is a multiple of the unit, else up to a
/// grid spacing more or less.
fn around(value: Length, unit: f64) -> [Length; 3] {
    let multiple = value.to_mm() / unit;
    let off = if (multiple - multiple.round()).abs() < 1e-6 {
        0.0
    } else {
        grid::SPACING
    };
    [-off, 0.0, off].map(|off| (value + Length::mm(off)).max(Length::mm(grid::SPACING)))
}

/// Interlaced rows lie half a step apart, so half a step must be on the grid for all tips to be.
pub(super) const fn tips_per_step(lattice: Lattice) -> f64 {
    match lattice {
        Lattice::Interlaced => 2.0,
        Lattice::Orthogonal | Lattice::Free | Lattice::Fitted => 1.0,
    }
}

/// The largest layer on the grid, starting from a closed form, that fits with the step it gets: rounding may cost a few
/// spacings.
pub(super) fn largest_fitting(
    lattice: Lattice,
    closed_form: Length,
    flanks: &Flanks,
    step: impl Fn(Length) -> Length,
) -> Length {
    let mut layer = on_grid(closed_form);
    for _ in 0..1000 {
        if layer.to_mm() <= grid::SPACING || fits(lattice, layer, step(layer), flanks) {
            break;
        }
        layer = on_grid(layer - Length::mm(grid::SPACING));
    }
    layer
}

/// What of the scallop limit is left for the lattice: allowance and standoff stand on the part anyway.
pub(super) fn scallop_room(asked: &RoughVcut, drop: Length) -> Option<Length> {
    let limit = asked.limits.scallop?;
    Some(limit.value - asked.allowance.value - drop)
}

/// The overlaps at which a layer's reach is looked at when the overlap is open: every twentieth, where the closed forms of
/// the reach have their least values too.
pub(super) fn open_overlaps() -> impl Iterator<Item = f64> {
    (0..20).map(|twentieth| f64::from(twentieth) / 20.0)
}

/// The largest layers of closed form at the swing of these parameters, the largest first: on each of some lattices by what the
/// blade reaches, and by what the scallop bound leaves of that. The bound is often far above what a plan leaves, so a layer
/// that is too large for it may do. An open step follows from the layer, at any overlap that the job allows.
#[must_use]
pub fn largest_layers(asked: &RoughVcut, parameters: &VcutParameters, lattices: &[Lattice]) -> Vec<Length> {
    let room = scallop_room(asked, parameters.drop);
    let mut layers: Vec<Length> = lattices
        .iter()
        .flat_map(|&lattice| [None, room].map(|room| (lattice, room)))
        .filter_map(|(lattice, room)| match (asked.step.value, asked.overlap.value) {
            (Auto::Given(step), _) => at_step(&parameters.flanks, lattice, step, room),
            (Auto::Auto, Auto::Given(overlap)) => {
                Some(at_overlap(&parameters.flanks, lattice, overlap, room))
            }
            (Auto::Auto, Auto::Auto) => open_overlaps()
                .map(|overlap| at_overlap(&parameters.flanks, lattice, overlap, room))
                .max_by(Length::total_cmp),
        })
        .collect();
    layers.sort_by(|a, b| b.total_cmp(a));
    layers.dedup();
    layers
}

fn at_overlap(flanks: &Flanks, lattice: Lattice, overlap: f64, room: Option<Length>) -> Length {
    let by_reach = blade_reach::largest_layer(lattice, overlap, flanks.reach_in_lattice());
    let by_scallop =
        room.map(|room| blade_reach::largest_layer_for_scallop(lattice, overlap, flanks.slope, room));
    let closed_form = by_scallop.map_or(by_reach, |layer| layer.min(by_reach));
    largest_fitting(lattice, closed_form, flanks, |layer| {
        widest_step(lattice, layer, overlap, flanks)
    })
}

fn at_step(flanks: &Flanks, lattice: Lattice, step: Length, room: Option<Length>) -> Option<Length> {
    let reach = flanks.reach_in_lattice();
    let by_reach = blade_reach::largest_layer_at_step(lattice, step, flanks.slope, reach)?;
    let closed_form = match room {
        None => by_reach,
        Some(room) => {
            blade_reach::largest_layer_for_scallop_at_step(lattice, step, flanks.slope, room)?.min(by_reach)
        }
    };
    Some(largest_fitting(lattice, closed_form, flanks, |_| step))
}

/// Rounded down to the grid, and at least one spacing.
fn on_grid(layer: Length) -> Length {
    Length::mm(grid::down(layer.to_mm()).max(grid::SPACING))
}

/// A step this near to a grid step, in grid steps, is that one: 2 h tan(45 deg) comes out as 11.999 999 999 mm.
const ON_GRID: f64 = 1e-6;

/// The widest step at an overlap [Cui 7], on the grid. Rounded down, unless that hair makes flanks pass below the older
/// tips they are meant to pass through, which takes far more reach: interlaced lattices without overlap, and others at
/// overlaps like a half, are then rounded up.
pub(super) fn widest_step(lattice: Lattice, layer: Length, overlap: f64, flanks: &Flanks) -> Length {
    let unit = grid::SPACING * tips_per_step(lattice);
    let [_, _, layer] = around(layer, grid::SPACING);
    let ideal = 2.0 * (1.0 - overlap) * layer.to_mm() / flanks.slope / unit;
    let steps =
        [(ideal + ON_GRID).floor(), (ideal - ON_GRID).ceil()].map(|count| Length::mm(count.max(1.0) * unit));
    let [narrow, wide] = steps.map(|step| blade_reach::needed_reach(lattice, layer, step, flanks.slope));
    let jump = Length::mm(unit * (1.0 + flanks.slope));
    let [down, up] = steps;
    if narrow > wide + jump { up } else { down }
}
