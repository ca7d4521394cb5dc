//! More material left standing than the limit allows: what to change, as far as it was tried and works.

use super::attempts::Attempts;
use crate::asked::{Avoid, Residual, RoughVcut};
use crate::plan::PlannedVcut;
use crate::plan::beyond_the_stock;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_geometry::grid;
use vcutc_job::Auto;
use vcutc_job::operation::Trials;
use vcutc_simulation::report::Report;

/// Most limits that are tried before giving up, and how much wider each is than the one before.
const MOST_LIMITS: usize = 8;
const WIDER: f64 = 1.1;

/// Narrower swings that are tried, as shares of the planned one.
const NARROWER: [f64; 6] = [0.8, 0.65, 0.5, 0.35, 0.25, 0.15];

/// Swings wider than this make Vs that are nearly flat.
const WIDE: Angle = Angle::deg(60.0);

/// Plans of more cuts than this take long enough that others like them are tried last.
const MANY: usize = 500;

/// A change of residual strategy and layer.
struct Change {
    residual: Option<(Residual, Span)>,
    layer: Option<(Length, Span)>,
}

/// What to change where more stays than the limit on scallop allows.
pub(crate) fn helped(
    mut over_limit: Diagnostic,
    vcut: &PlannedVcut,
    report: &Report,
    trials: &mut dyn Trials,
) -> Diagnostic {
    let asked = &vcut.asked;
    over_limit.notes.extend(beyond_the_stock(&vcut.parameters));
    let mut attempts = Attempts(trials);
    let change = match asked.tips {
        // Nothing moves given tips.
        Some(_) => None,
        None if vcut.cuts.len() > MANY => None,
        None => residual_and_layer(&mut attempts, vcut),
    };
    match change {
        Some(change) => change.offered(over_limit),
        None => {
            let offered = limit_or_swing(over_limit, &mut attempts, vcut, report.scallop.height);
            with_narrower_flanks(offered, &mut attempts, vcut)
        }
    }
}

/// With flanks that are narrower only where they must be, if that keeps the limit.
fn with_narrower_flanks(
    diagnostic: Diagnostic,
    attempts: &mut Attempts<'_>,
    vcut: &PlannedVcut,
) -> Diagnostic {
    let variant = vcut.asked.with_narrower_flanks();
    match variant.filter(|_| vcut.cuts.len() <= MANY) {
        Some(variant) if attempts.prove(|asked| asked.avoid.value = Avoid::Swing) => {
            diagnostic.fix_all(variant.advice, &variant.edits)
        }
        Some(_) | None => diagnostic,
    }
}

fn limit_span(asked: &RoughVcut) -> Option<Span> {
    asked.limits.scallop.and_then(|limit| limit.span)
}

impl Change {
    fn make(&self, asked: &mut RoughVcut) {
        if let Some((residual, _)) = self.residual {
            asked.residual.value = Auto::Given(residual);
        }
        if let Some((layer, _)) = self.layer {
            asked.layer.value = Auto::Given(layer);
        }
    }

    fn offered(&self, diagnostic: Diagnostic) -> Diagnostic {
        let residual = self.residual.map(|(residual, span)| (residual.word(), span));
        let layer = self
            .layer
            .map(|(layer, span)| (format!("{} mm", show(layer.to_mm())), span));
        let title = match (&residual, &layer) {
            (Some((word, _)), Some((layer, _))) => {
                format!("use `residual = {word}` with a `layer` of {layer}")
            }
            (Some((word, _)), None) => format!("use `residual = {word}`"),
            (None, Some((layer, _))) => format!("use a `layer` of {layer}"),
            (None, None) => return diagnostic,
        };
        let residual = residual.map(|(word, span)| (span, word.to_owned()));
        let layer = layer.map(|(layer, span)| (span, layer));
        let edits: Vec<(Span, String)> = residual.into_iter().chain(layer).collect();
        diagnostic.fix_all(title, &edits)
    }
}

/// A residual strategy and a layer in the place of those that the job gives, which keep the limit on scallop.
fn residual_and_layer(attempts: &mut Attempts<'_>, vcut: &PlannedVcut) -> Option<Change> {
    let asked = &vcut.asked;
    let mut residuals = vec![None];
    if let (Auto::Given(_), Some(span)) = (asked.residual.value, asked.residual.span) {
        residuals.extend([Residual::Mixed, Residual::Lift].map(|residual| Some((residual, span))));
    }
    let mut layers = vec![None];
    if let (Auto::Given(layer), Some(span)) = (asked.layer.value, asked.layer.span) {
        let smaller = [0.75, 0.5, 0.25].map(|share| grid::down(layer.to_mm() * share * 0.1) * 10.0);
        let smaller = smaller.into_iter().filter(|&layer| layer > 0.0);
        layers.extend(smaller.map(|layer| Some((Length::mm(layer), span))));
    }
    let changes = layers
        .iter()
        .flat_map(|&layer| residuals.iter().map(move |&residual| Change { residual, layer }));
    changes
        // The first one changes nothing.
        .skip(1)
        .find(|change| attempts.prove(|asked| change.make(asked)))
}

/// A limit that is kept, and a swing that keeps this one.
fn limit_or_swing(
    diagnostic: Diagnostic,
    attempts: &mut Attempts<'_>,
    vcut: &PlannedVcut,
    height: Length,
) -> Diagnostic {
    let asked = &vcut.asked;
    if vcut.cuts.len() > MANY && asked.tips.is_none() {
        // What is tried after this would hardly be cheaper than the plan that is refused.
        if let Some(offer) = attempts.opened(asked) {
            return diagnostic.fix_all(offer.title, &offer.edits);
        }
    }
    // Beside a V this wide hardly anything is steep enough to matter: the swing is what is likely to be wrong.
    if let Auto::Given(swing) = asked.swing.value
        && swing > WIDE
        && let Some(offered) = with_narrower_swing(&diagnostic, attempts, asked)
    {
        return offered;
    }
    let little_wider = wider_limit(attempts, asked, height);
    let mut diagnostic = match little_wider {
        Some(_) => diagnostic,
        None => diagnostic.note(
            "where the part is steeper than the flanks of the V, cuts cannot follow it whatever their size",
        ),
    };
    if let Some(limit) = little_wider.or_else(|| limit_that_is_kept(attempts, height)) {
        let value = format!("{} mm", show(limit.to_mm()));
        let title = format!("raise the limit: `scallop <= {value}`");
        diagnostic = match limit_span(asked) {
            Some(span) => diagnostic.fix(title, span, value),
            None => diagnostic.help(title),
        };
    }
    if let Some(offered) = with_narrower_swing(&diagnostic, attempts, asked) {
        return offered;
    }
    if asked.tips.is_none()
        && let Some(offer) = attempts.opened(asked)
    {
        diagnostic = diagnostic.fix_all(offer.title, &offer.edits);
    }
    match diagnostic.fixes.is_empty() {
        true => diagnostic.help(last_resort(asked)),
        false => diagnostic,
    }
}

/// What to do where nothing that was tried works, of what the job states.
fn last_resort(asked: &RoughVcut) -> &'static str {
    let is_given = |value: &Auto<Length>| matches!(value, Auto::Given(_));
    let is_layer_given = is_given(&asked.layer.value) || is_given(&asked.step.value);
    match (asked.swing.value, is_layer_given && asked.tips.is_none()) {
        (Auto::Given(_), _) => "use a smaller `swing`, whose steeper flanks follow the part more closely",
        (Auto::Auto, true) => {
            "raise the limit on `scallop`, or leave `layer` and `step` to the compiler: `auto`"
        }
        (Auto::Auto, false) => "raise the limit on `scallop`",
    }
}

/// The diagnostic with a narrower swing than the given one, if one keeps the limit.
fn with_narrower_swing(
    diagnostic: &Diagnostic,
    attempts: &mut Attempts<'_>,
    asked: &RoughVcut,
) -> Option<Diagnostic> {
    let (Auto::Given(swing), Some(span), None) = (asked.swing.value, asked.swing.span, &asked.tips) else {
        return None;
    };
    let narrower = swing_that_keeps_it(attempts, swing)?;
    let value = format!("{} deg", show(narrower.to_deg()));
    let title = format!("use a `swing` of {value}, whose steeper flanks follow the part more closely");
    Some(diagnostic.clone().fix(title, span, value))
}

fn swing_that_keeps_it(attempts: &mut Attempts<'_>, swing: Angle) -> Option<Angle> {
    NARROWER
        .into_iter()
        .map(|share| Angle::deg((swing.to_deg() * share).floor()))
        .filter(|narrower| narrower.to_deg() >= 2.0)
        .find(|&narrower| attempts.prove(|asked| asked.swing.value = Auto::Given(narrower)))
}

/// A scallop limit little above the one asked for: what is chosen for that one need not leave as much as this plan does.
fn wider_limit(attempts: &mut Attempts<'_>, asked: &RoughVcut, height: Length) -> Option<Length> {
    let given = asked.limits.scallop?.value;
    let factors = [WIDER, 1.5, 2.0].into_iter();
    factors
        .map(|factor| Length::mm((given.to_mm() * factor * 10.0).ceil() / 10.0))
        .filter(|&limit| limit < height)
        .find(|&limit| keeps(attempts, limit))
}

fn keeps(attempts: &mut Attempts<'_>, limit: Length) -> bool {
    attempts.prove(|asked| {
        if let Some(given) = &mut asked.limits.scallop {
            given.value = limit;
        }
    })
}

/// A scallop limit that the job keeps. Layers that follow from the limit grow with it, so the height that stays now need
/// not be one.
fn limit_that_is_kept(attempts: &mut Attempts<'_>, height: Length) -> Option<Length> {
    let mut limit = height;
    for _ in 0..MOST_LIMITS {
        // To a tenth of a millimetre, upwards.
        limit = Length::mm((limit.to_mm() * 10.0).ceil() / 10.0);
        if keeps(attempts, limit) {
            return Some(limit);
        }
        limit = limit * WIDER;
    }
    None
}
