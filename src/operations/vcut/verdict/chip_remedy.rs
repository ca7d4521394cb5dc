//! Which change frees all chips of a job.

use super::attempts::Attempts;
use crate::asked::Residual;
use crate::plan::PlannedVcut;
use crate::plan::parameters::{self, Swung};
use crate::plan::refusal::Offer;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_geometry::grid;
use vcutc_job::Auto;
use vcutc_job::operation::WorksThere;

/// A change that fixes a job.
pub(super) enum Remedy {
    /// Another step for the layer asked for.
    Step(Length),
    /// The step that the compiler chooses.
    OpenStep,
    /// The largest layer of those that were tried and work.
    Layer(Length),
    /// `residual = mixed`.
    ResidualMixed,
    /// What is given of the cuts left to the compiler.
    Opened(Box<Offer>),
}

/// How often the gap between a layer that works and one that does not is halved.
const HALVINGS: usize = 6;

/// A gap that is no wider than this share of the layer is not halved.
const NEAR_ENOUGH: f64 = 0.005;

/// What is tried below the least layer of closed form, as shares of it.
const SMALLER: [f64; 3] = [0.9, 0.75, 0.5];

/// The first change that makes the job prove: `residual = mixed` where the lattice itself fits the blade, else another
/// step, else a smaller layer, else what the compiler chooses of all.
pub(super) fn remedy(
    attempts: &mut Attempts<'_>,
    vcut: &PlannedVcut,
    works_there: &mut WorksThere<'_>,
) -> Option<Remedy> {
    let asked = &vcut.asked;
    if vcut.strategy != Residual::Mixed
        && vcut.parameters.lattice_fits()
        && attempts.prove(|asked| asked.residual.value = Auto::Given(Residual::Mixed))
    {
        return Some(Remedy::ResidualMixed);
    }
    if let Auto::Given(_) = asked.step.value {
        if let Some(step) = another_step(vcut)
            && attempts.prove(|asked| asked.step.value = Auto::Given(step))
        {
            return Some(Remedy::Step(step));
        }
        if attempts.prove(|asked| asked.step.value = Auto::Auto) {
            return Some(Remedy::OpenStep);
        }
    }
    match layer_that_works(attempts, vcut, works_there) {
        Some(layer) => Some(Remedy::Layer(layer)),
        None => attempts
            .opened(asked)
            .map(|offer| Remedy::Opened(Box::new(offer))),
    }
}

/// A layer below the planned one that makes the job prove and that the machine follows, the largest of those that were tried.
fn layer_that_works(
    attempts: &mut Attempts<'_>,
    vcut: &PlannedVcut,
    works_there: &mut WorksThere<'_>,
) -> Option<Length> {
    let span = vcut.asked.layer.span;
    let follows = |&layer: &Length| span.is_none_or(|span| works_there(&[(span, written(layer))]));
    layers_that_prove(attempts, vcut).into_iter().rev().find(follows)
}

/// A layer as the job writes it.
pub(super) fn written(layer: Length) -> String {
    format!("{} mm", show(layer.to_mm()))
}

/// Layers below the planned one that make the job prove, each larger than the one before: first by closed form, then between
/// one that works and the next one that does not.
fn layers_that_prove(attempts: &mut Attempts<'_>, vcut: &PlannedVcut) -> Vec<Length> {
    let mut proves = |layer: Length| attempts.prove(|asked| asked.layer.value = Auto::Given(layer));
    let mut too_large = vcut.parameters.layer;
    let first = candidates(vcut).into_iter().find(|&layer| {
        let works = proves(layer);
        if !works {
            too_large = layer;
        }
        works
    });
    let Some(mut works) = first else {
        return Vec::new();
    };
    let mut found = vec![works];
    for _ in 0..HALVINGS {
        let between = in_hundredths((works + too_large) / 2.0);
        if too_large - works <= too_large * NEAR_ENOUGH || between <= works {
            break;
        }
        if proves(between) {
            found.push(between);
            works = between;
        } else {
            too_large = between;
        }
    }
    found
}

/// Layers of closed form below the planned one and shares of the least of them, the largest first.
fn candidates(vcut: &PlannedVcut) -> Vec<Length> {
    let (asked, found) = (&vcut.asked, &vcut.parameters);
    let closed_forms = parameters::largest_layers(asked, found, &parameters::open_lattices(asked));
    let below = |layer: Length| in_hundredths(layer.min(found.layer));
    let mut layers: Vec<Length> = closed_forms.into_iter().map(below).collect();
    let least = layers.last().copied().unwrap_or(found.layer);
    layers.extend(SMALLER.map(|share| in_hundredths(least * share)));
    layers.retain(|&layer| layer > Length::ZERO);
    layers.dedup();
    layers
}

/// To a hundredth of a millimetre, downwards.
fn in_hundredths(layer: Length) -> Length {
    Length::mm(grid::down(layer.to_mm() * 0.1) * 10.0)
}

/// The widest step of the planned layer that the blade reaches at the planned swing, other than the given one.
fn another_step(vcut: &PlannedVcut) -> Option<Length> {
    let found = &vcut.parameters;
    let swung = Swung::new(&vcut.asked, found.lattice, found.swing)?;
    let (step, _) = swung.widest_fitting_step(found.layer)?;
    (step != found.step).then_some(step)
}
