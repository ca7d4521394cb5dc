//! A limit on the scallop for operations that set none (`docs/process.md`, "The limit that is chosen").
//!
//! Fewer and larger cuts leave more. So with nothing to bound what stays, the fastest plan is the one that cuts least. A job
//! that leaves swing or layer open and sets no limit is to be cut down to the profile all the same: its limit is a share of
//! the mean depth of what is to go. Of a few shares the widest is taken under which at most a tenth of that stays.
//!
//! The resulting limit is a plain one, on a tenth of a millimetre. The operation is planned under it as if
//! the job had set it, so that writing it down gives the same program; or a faster one that leaves more,
//! where redundant Vs were kept to leave little.

use super::bench::{Bench, LITTLE};
use super::{Unplanned, within_limits};
use crate::asked::{ChosenScallop, Formulas, Lattice, Objective, Redundant, RoughVcut, WhyChosen};
use crate::plan::LaidOut;
use crate::plan::blade_reach::{self, Flanks};
use crate::plan::removable::{Removable, standoff};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, Sourced};

/// Limits as shares of the mean depth, the widest first. Teeth of a height hold half of it in the mean, so a fifth would leave a
/// tenth; tips that miss the part leave more, and less than the limit stays beside steep places.
const SHARES: [f64; 3] = [0.25, 0.17, 0.12];

/// Shares beyond those, where no plan keeps any of them: beside walls, or within limits on time and cuts.
const WIDER: [f64; 3] = [0.4, 0.64, 1.0];

/// The least room for teeth, in mm: finer surfaces are asked for, not guessed. A judgement, from no source.
const LEAST_TEETH: Length = Length::mm(1.0);

/// The swing that a limit is reckoned with where wider ones are open: the one of the largest chips [Cui 3].
const USUAL: Angle = Angle::deg(45.0);

/// Whether an operation needs a limit that it does not have.
fn is_needed(asked: &RoughVcut) -> bool {
    let is_open = asked.swing.value == Auto::Auto || asked.layer.value == Auto::Auto;
    let grows = match asked.objective.value {
        Objective::Time | Objective::Cuts => true,
        // These are held by other limits, without which there is no plan.
        Objective::Scallop | Objective::BladeLoad => false,
    };
    let is_searched = match asked.formulas.value {
        Formulas::Exact => true,
        Formulas::Paper => false,
    };
    is_open && grows && is_searched && asked.limits.scallop.is_none() && asked.tips.is_none()
}

/// The best operation within its limits, with a limit on the scallop chosen where it has none. `within` is the operation as it
/// is planned, perhaps held to narrower swings; the limit is reckoned from what the job asks.
pub(super) fn within_all_limits(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    within: &RoughVcut,
) -> Result<LaidOut, Unplanned> {
    if !is_needed(within) {
        return within_limits(bench, within);
    }
    let depths = Depths::of(bench, asked);
    let mut kept: Vec<LaidOut> = Vec::new();
    for limit in depths.limits(&SHARES) {
        let why = WhyChosen::LittleStays;
        let Some(laid) = sound_under(bench, within, (limit, depths.chosen(why))) else {
            break;
        };
        if depths.share_left(&laid) <= LITTLE {
            return Ok(laid);
        }
        // What is fast without its redundant Vs may leave more than what needs all.
        if let Some(all) = with_all(bench, within, (limit, depths.chosen(why)))
            && depths.share_left(&all) <= LITTLE
        {
            return Ok(all);
        }
        kept.push(laid);
    }
    if let Some(mut widest) = kept.into_iter().next() {
        widest.vcut.asked.limits.chosen = Some(depths.chosen(WhyChosen::MoreStays));
        return Ok(widest);
    }
    let why = WhyChosen::TightestKept;
    let mut wider = depths.limits(&WIDER).into_iter();
    let found = wider.find_map(|limit| sound_under(bench, within, (limit, depths.chosen(why))));
    found.map_or_else(|| within_limits(bench, within), Ok)
}

/// The best operation under a limit with all its Vs, if it has nothing wrong; none where it keeps them anyway. What it asks for says
/// so: planned again under that limit, it would leave more.
fn with_all(bench: &Bench<'_>, within: &RoughVcut, chosen: (Length, ChosenScallop)) -> Option<LaidOut> {
    if within.redundant.value != Auto::Auto {
        return None;
    }
    let mut keeping = within.clone();
    keeping.redundant.value = Auto::Given(Redundant::Keep);
    sound_under(bench, &keeping, chosen)
}

/// The best operation under a limit, if it has nothing wrong.
fn sound_under(
    bench: &Bench<'_>,
    within: &RoughVcut,
    (limit, chosen): (Length, ChosenScallop),
) -> Option<LaidOut> {
    let mut limited = within.clone();
    limited.limits.scallop = Some(Sourced {
        value: limit,
        span: None,
    });
    let laid = within_limits(bench, &limited).ok()?;
    let weighed = bench.judged(laid, &limited);
    weighed.standing.time()?;
    let mut laid = weighed.laid;
    laid.vcut.asked.limits.chosen = Some(chosen);
    Some(laid)
}

/// What limits are reckoned from.
struct Depths<'b> {
    removable: &'b Removable,
    /// In mm2, of what the operation finds.
    whole: f64,
    depth: Length,
    /// What stays whatever the cuts: allowance, and the standoff at a usual swing.
    always: Length,
    /// What the lattice of the largest layer leaves at that swing.
    coarsest: Length,
}

impl<'b> Depths<'b> {
    fn of(bench: &'b Bench<'_>, asked: &RoughVcut) -> Self {
        let removable = &bench.removable;
        let found: Vec<Point2> = bench.work().before.corners().collect();
        let widest = asked.limits.swing.most.map_or(USUAL, |most| most.value);
        let swing = asked.swing.value.or(if widest < USUAL { widest } else { USUAL });
        Self {
            whole: removable.under(&found).to_mm2(),
            depth: removable.depth_under(&found),
            removable,
            always: asked.allowance.value + standoff(asked) / swing.sin(),
            coarsest: coarsest(asked, swing),
        }
    }

    const fn chosen(&self, why: WhyChosen) -> ChosenScallop {
        ChosenScallop {
            depth: self.depth,
            why,
        }
    }

    /// Limits of these shares, on a tenth of a millimetre, each once.
    fn limits(&self, shares: &[f64]) -> Vec<Length> {
        let limit = |share: &f64| {
            let teeth = (self.depth * *share).min(self.coarsest).max(LEAST_TEETH);
            Length::mm(((self.always + teeth).to_mm() * 10.0).ceil() / 10.0)
        };
        let mut limits: Vec<Length> = shares.iter().map(limit).collect();
        limits.dedup();
        limits
    }

    /// How much stays of what is to go, as a share.
    fn share_left(&self, laid: &LaidOut) -> f64 {
        let corners: Vec<Point2> = laid.after.corners().collect();
        self.removable.under(&corners).to_mm2() / self.whole.max(f64::MIN_POSITIVE)
    }
}

/// What an orthogonal lattice leaves with the largest layer that the blade reaches [Cui 4, 12].
fn coarsest(asked: &RoughVcut, swing: Angle) -> Length {
    let blade = &asked.blade;
    let flanks = Flanks::new(
        blade.cutting_length.value,
        blade.half_apex.value,
        asked.setup.rake.value,
        swing,
    );
    let layer = blade_reach::largest_layer(Lattice::Orthogonal, 0.0, flanks.reach);
    let step = layer * (2.0 / flanks.slope);
    blade_reach::scallop_bound(Lattice::Orthogonal, layer, step, flanks.slope)
}
