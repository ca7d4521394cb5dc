//! Which change frees all chips of a job.

use super::attempts::Attempts;
use crate::job::{Auto, Residual};
use crate::plan::parameters::{self, Swung};
use crate::plan::refusal::Offer;
use crate::plan::{PlannedVcut, grid};
use vcutc_backend_api::units::Length;

/// A change that mends a job.
pub(super) enum Remedy {
    /// Another step for the layer asked for.
    Step(Length),
    /// The step that the compiler chooses.
    OpenStep,
    /// The largest layer.
    LargestLayer(Length),
    /// A smaller layer than closed form says: one that has been tried.
    SmallerLayer(Length),
    /// `residual = mixed`.
    ResidualMixed,
    /// All that is given of the cuts left to the compiler.
    AllOpen(Box<Offer>),
}

/// The first change that makes the job prove: `residual = mixed` where the lattice itself fits the blade, else another
/// step, else the largest layer by closed form, else smaller ones, else what the compiler chooses of all.
pub(super) fn remedy(attempts: &mut Attempts<'_>, vcut: &PlannedVcut) -> Option<Remedy> {
    let asked = &vcut.asked;
    if vcut.strategy != Residual::Mixed
        && vcut.parameters.lattice_fits()
        && attempts.prove(|asked| asked.residual.value = Auto::Given(Residual::Mixed))
    {
        return Some(Remedy::ResidualMixed);
    }
    let largest = match asked.step.value {
        Auto::Auto => parameters::largest_layer(asked, &vcut.parameters),
        Auto::Given(step) => {
            if let Some(step) = another_step(vcut)
                && attempts.prove(|asked| asked.step.value = Auto::Given(step))
            {
                return Some(Remedy::Step(step));
            }
            if attempts.prove(|asked| asked.step.value = Auto::Auto) {
                return Some(Remedy::OpenStep);
            }
            parameters::largest_layer_at(asked, &vcut.parameters, step).unwrap_or_default()
        }
    };
    let start = largest.min(vcut.parameters.layer).to_mm();
    let candidates = [1.0, 0.9, 0.75, 0.5].map(|share| grid::down(start * share * 0.1) * 10.0);
    let layer = candidates
        .into_iter()
        .filter(|&layer| layer > 0.0)
        .map(Length::mm)
        .find(|&layer| attempts.prove(|asked| asked.layer.value = Auto::Given(layer)));
    let Some(layer) = layer else {
        return attempts
            .all_open(asked)
            .map(|offer| Remedy::AllOpen(Box::new(offer)));
    };
    let is_largest = candidates
        .first()
        .is_some_and(|&first| layer == Length::mm(first));
    // At another swing, larger layers than this one may do.
    Some(match asked.swing.value {
        Auto::Given(_) if is_largest => Remedy::LargestLayer(layer),
        Auto::Given(_) | Auto::Auto => Remedy::SmallerLayer(layer),
    })
}

/// The widest step of the planned layer that the blade reaches at the planned swing, other than the given one.
fn another_step(vcut: &PlannedVcut) -> Option<Length> {
    let found = &vcut.parameters;
    let swung = Swung::new(&vcut.asked, found.lattice, found.swing)?;
    let (step, _) = swung.widest_fitting_step(found.layer)?;
    (step != found.step).then_some(step)
}
