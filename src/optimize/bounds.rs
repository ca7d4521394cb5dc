//! Bounds of the formulas' optimum that bind: where the job says them, and what relaxing them by a hundredth would buy.

use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::position::position;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_job::{Auto, Sourced};
use vcutc_vcut::asked::RoughVcut;
use vcutc_vcut::plan::optimum::{Bound, Optimum, Problem, Sensitivity, sensitivities};

/// A bound that binds, and what relaxing it would buy.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxed {
    pub bound: Bound,
    /// The bound in words: `scallop <= 10 mm`.
    pub words: String,
    /// Where the job says so: `rib.vcut:17:14`; none where nothing in the job does.
    pub place: Option<String>,
    /// Its value relaxed, with unit.
    pub relaxed: String,
    /// Time by the model that would be saved; negative where another objective takes more of it.
    pub saves: Duration,
    /// By how much the objective would fall, in its unit: s, mm or cuts.
    pub gain: f64,
    /// By which share the objective would fall.
    pub share: f64,
}

/// What relaxing each binding bound would buy, the most first.
pub(super) fn relaxed(
    problem: &Problem,
    best: &Optimum,
    asked: &RoughVcut,
    sources: &SourceMap,
) -> Vec<Relaxed> {
    // Below no overlap there is uncut material between Vs: no bound that can be relaxed.
    let can_be_relaxed =
        |sensitivity: &&Sensitivity| sensitivity.bound != Bound::OverlapLeast || sensitivity.relaxed >= 0.0;
    let mut found: Vec<Relaxed> = sensitivities(problem, best)
        .iter()
        .filter(can_be_relaxed)
        .map(|sensitivity| tell(problem, best, sensitivity, asked, sources))
        .collect();
    found.sort_by(|a, b| b.share.total_cmp(&a.share).then(a.bound.cmp(&b.bound)));
    found
}

fn tell(
    problem: &Problem,
    best: &Optimum,
    sensitivity: &Sensitivity,
    asked: &RoughVcut,
    sources: &SourceMap,
) -> Relaxed {
    let Sensitivity {
        bound,
        now,
        relaxed,
        then,
    } = sensitivity;
    let measure = |optimum: &Optimum| optimum.value(problem.objective);
    let before = measure(best);
    Relaxed {
        bound: *bound,
        words: format!("{} {}", name(*bound), value(*bound, *now)),
        place: written(*bound, asked).map(|span| place(sources, span)),
        relaxed: value(*bound, *relaxed),
        saves: best.time - then.time,
        gain: before - measure(then),
        share: if before > 0.0 {
            1.0 - measure(then) / before
        } else {
            0.0
        },
    }
}

/// `swing <=`.
#[must_use]
pub(super) fn name(bound: Bound) -> &'static str {
    match bound {
        Bound::SwingLeast => "swing >=",
        Bound::SwingMost => "swing <=",
        Bound::LayerLeast => "layer >=",
        Bound::LayerMost => "layer <=",
        Bound::StepLeast => "step >=",
        Bound::StepMost => "step <=",
        Bound::OverlapLeast => "overlap >=",
        Bound::OverlapMost => "overlap <=",
        Bound::Scallop => "scallop <=",
        Bound::Edge => "edge <=",
        Bound::Time => "time <=",
        Bound::Cuts => "cuts <=",
    }
}

/// A bound's value with its unit.
#[must_use]
pub(super) fn value(bound: Bound, value: f64) -> String {
    match bound {
        Bound::SwingLeast | Bound::SwingMost => format!("{} deg", show(Angle::rad(value).to_deg())),
        Bound::LayerLeast
        | Bound::LayerMost
        | Bound::StepLeast
        | Bound::StepMost
        | Bound::Scallop
        | Bound::Edge => format!("{} mm", show(value)),
        Bound::Time => format!("{} s", show(value)),
        Bound::OverlapLeast | Bound::OverlapMost => format!("{} %", show(100.0 * value)),
        Bound::Cuts => show(value),
    }
}

/// Where the job says a bound: the limit, or the value that is given.
pub(super) fn written(bound: Bound, asked: &RoughVcut) -> Option<Span> {
    let limits = &asked.limits;
    match bound {
        Bound::SwingLeast => given(&asked.swing).or(limits.swing.least.and_then(of)),
        Bound::SwingMost => given(&asked.swing).or(limits.swing.most.and_then(of)),
        Bound::LayerLeast => given(&asked.layer).or(limits.layer.least.and_then(of)),
        Bound::LayerMost => given(&asked.layer).or(limits.layer.most.and_then(of)),
        Bound::StepLeast => given(&asked.step).or(limits.step.least.and_then(of)),
        Bound::StepMost => given(&asked.step).or(limits.step.most.and_then(of)),
        Bound::OverlapLeast | Bound::OverlapMost => given(&asked.overlap),
        Bound::Scallop => limits.scallop.and_then(of),
        Bound::Edge => shorter_edge(asked).unwrap_or(asked.blade.cutting_length).span,
        Bound::Time => limits.time.and_then(of),
        Bound::Cuts => limits.cuts.and_then(of),
    }
}

/// The limit on the edge, where it asks for less than the blade has.
pub(super) fn shorter_edge(asked: &RoughVcut) -> Option<Sourced<Length>> {
    let limit = asked.limits.edge?;
    (limit.value < asked.blade.cutting_length.value).then_some(limit)
}

fn given<T>(field: &Sourced<Auto<T>>) -> Option<Span> {
    match field.value {
        Auto::Auto => None,
        Auto::Given(_) => field.span,
    }
}

fn of<T>(bound: Sourced<T>) -> Option<Span> {
    bound.span
}

/// `rib.vcut:17:14`.
pub(super) fn place(sources: &SourceMap, span: Span) -> String {
    let text = sources.get(span.file).map_or("", |file| file.text.as_str());
    let at = position(text, span.start);
    format!("{}:{}:{}", sources.name(span.file), at.line, at.column)
}
