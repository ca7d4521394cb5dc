//! What is said when no parameters keep all that a job asks for: which bounds conflict, where they stand, and the nearest
//! values that keep them by the model. The caller plans them before they are offered.

use super::complaints::check_given;
use super::said::{is_given, set};
use crate::asked::RoughVcut;
use crate::plan::optimum::{self, Bound, End, Problem};
use crate::plan::refusal::{Ladder, Offer, Refused};
use crate::plan::wider::wider_scallops;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{Auto, Sourced};

/// How much more than the nearest value may be needed, as shares of it: bounds that touch leave nothing to round, and plans
/// come to other values than the model.
const MARGINS: [f64; 8] = [0.0, 0.0005, 0.005, 0.02, 0.1, 0.25, 0.5, 0.75];

/// Values between the one that the job states and the nearest by the model, as shares of the way: the model's scallop bound is
/// often far above what plans leave, so much nearer values may do.
const BETWEEN: [f64; 9] = [0.01, 0.02, 0.04, 0.08, 0.15, 0.25, 0.4, 0.6, 0.8];

/// How many of the margins are tried on the nearest value by the blade's reach alone.
const MARGINS_BY_REACH: usize = 3;

/// Given values on the other side of the stated one, as shares of it: which ones work may change back and forth.
const BEYOND: [f64; 3] = [0.02, 0.05, 0.1];

/// Most larger limits on scallop that are looked at beside another change.
const MOST_WIDER: usize = 5;

/// A bound in the job's words.
struct Party {
    said: Said,
    /// What it asks for.
    words: String,
}

/// Where a bound is stated, in the order in which people would change it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Said {
    Operation,
    Blade,
    /// Nowhere: it lies in the nature of things.
    Nowhere,
}

impl Party {
    fn span(&self, asked: &RoughVcut, bound: Bound) -> Option<Span> {
        match self.said {
            Said::Operation => place(asked, bound),
            Said::Blade => Some(asked.blade.cutting_length.span.unwrap_or(asked.blade.span)),
            Said::Nowhere => None,
        }
    }
}

/// Values of a bound, as the model counts them.
struct Values {
    /// What the job states.
    stated: f64,
    /// The nearest that all other bounds allow.
    nearest: f64,
    /// The nearest that all other bounds but the scallop's allow, where that is nearer.
    by_reach: Option<f64>,
}

/// For each bound the values that may do, where there are any.
fn values(problem: &Problem, bounds: &[Bound]) -> Vec<Option<Values>> {
    let nearest = optimum::nearest(problem, bounds);
    let free = Bound::Scallop.dropped(problem);
    let is_of_scallop = bounds.contains(&Bound::Scallop) && optimum::any(&free).is_none();
    let by_reach = match is_of_scallop {
        true => optimum::nearest(&free, bounds),
        false => bounds.iter().map(|_| None).collect(),
    };
    let all = bounds.iter().zip(nearest).zip(by_reach);
    all.map(|((bound, nearest), by_reach)| {
        let (stated, nearest) = (bound.value(problem)?, nearest?);
        let is_nearer = |value: &f64| (stated - value) * (value - nearest) > 0.0;
        Some(Values {
            stated,
            nearest,
            by_reach: by_reach.filter(is_nearer),
        })
    })
    .collect()
}

/// Bounds that cannot be kept together, with values of each that the others may allow.
pub(super) fn conflict(asked: &RoughVcut, problem: &Problem, bounds: &[Bound]) -> Refused {
    let mut parties: Vec<(Party, Bound)> = bounds.iter().map(|&bound| (party(asked, bound), bound)).collect();
    parties.sort_by_key(|(party, _)| party.said);
    // A given value can bind from below and from above.
    parties.dedup_by(|(later, _), (earlier, _)| later.words == earlier.words);
    let words: Vec<&str> = parties.iter().map(|(party, _)| party.words.as_str()).collect();
    let message = match words.as_slice() {
        [] => "no parameters satisfy all limits".to_owned(),
        [one] => format!("no parameters satisfy {one}"),
        [one, other] => format!("no parameters satisfy both {one} and {other}"),
        [first @ .., last] => format!("no parameters satisfy all of {} and {last}", first.join(", ")),
    };
    let mut places = parties
        .iter()
        .filter_map(|(party, bound)| Some((party.span(asked, *bound)?, party.words.clone())));
    let (span, label) = places
        .next()
        .unwrap_or_else(|| (asked.setup.head_span, "this operation".to_owned()));
    let mut diagnostic = Diagnostic::new(Code::LimitsConflict, message, span, label);
    for (span, label) in places {
        diagnostic = diagnostic.and(span, label);
    }
    let values = values(problem, bounds);
    let ladders = bounds.iter().zip(&values);
    Refused {
        diagnostic,
        ladders: ladders
            .filter_map(|(&bound, values)| values.as_ref().map(|values| ladder(asked, bound, values)))
            .collect(),
        resort: Offer::openings(asked),
        otherwise: Some(
            "relax several of these together, or set more of the parameters to `auto`".to_owned(),
        ),
    }
}

/// The nearest value of a bound with larger limits on scallop: on a steep part plans leave more than the model knows of.
fn with_wider_scallops(nearest: &Offer) -> Ladder {
    let wider = wider_scallops(&nearest.changed, Length::ZERO).into_iter();
    wider
        .take(MOST_WIDER)
        .map(|wider| {
            let values = wider.title.trim_start_matches("use ");
            Offer {
                title: format!("{} with {values}", nearest.title),
                edits: nearest.edits.iter().cloned().chain(wider.edits).collect(),
                changed: wider.changed,
            }
        })
        .collect()
}

/// Limits that leave less between them than a micrometre, or a thousandth of a degree.
pub(super) fn off_grid(asked: &RoughVcut) -> Diagnostic {
    Diagnostic::new(
        Code::LimitsConflict,
        "no layer and step in whole micrometres satisfy all limits",
        asked.setup.head_span,
        "the limits leave too little between them",
    )
    .help("widen one of the limits by a few micrometres")
}

/// Values for a bound that may work, the nearest to what the job states first, and where they go.
fn ladder(asked: &RoughVcut, bound: Bound, values: &Values) -> Ladder {
    let mut ladder: Ladder = Vec::new();
    for offer in numbers(asked, bound, values)
        .into_iter()
        .filter_map(|number| offer(asked, bound, number))
    {
        if ladder.iter().all(|other| other.edits != offer.edits) {
            ladder.push(offer);
        }
    }
    let by_model = in_units(bound, values.nearest, outwards(bound));
    let wider = match (bound, offer(asked, bound, by_model)) {
        (Bound::Scallop, _) | (_, None) => Vec::new(),
        (_, Some(nearest)) => with_wider_scallops(&nearest),
    };
    ladder.extend(wider);
    ladder
}

/// A number in the place of a bound; none where the job does not say it, or where it breaks the limit on a given value.
fn offer(asked: &RoughVcut, bound: Bound, number: f64) -> Option<Offer> {
    let mut changed = asked.clone();
    let span = set(&mut changed, bound, number)?;
    let mut complaints = Vec::new();
    check_given(&changed, &mut complaints);
    let text = format!("{}{}", show(number), unit(bound));
    complaints.is_empty().then(|| Offer {
        title: format!("use {}", relation(asked, bound, &text)),
        edits: vec![(span, text)],
        changed,
    })
}

/// The numbers of a ladder, in the unit that people use.
fn numbers(asked: &RoughVcut, bound: Bound, values: &Values) -> Vec<f64> {
    let Values {
        stated,
        nearest,
        by_reach,
    } = *values;
    let direction = outwards(bound);
    let exact = |value: f64| in_units(bound, value, direction);
    let way = nearest - stated;
    let between = match bound {
        // The model knows these as well as it knows anything.
        Bound::Time | Bound::Cuts => Vec::new(),
        _ => BETWEEN.map(|share| stated + way * share).to_vec(),
    };
    let beyond = match is_given(asked, bound) && way.is_finite() {
        true => BEYOND
            .map(|share| stated - stated * share * way.signum())
            .to_vec(),
        false => Vec::new(),
    };
    let by_reach = by_reach.into_iter().flat_map(|value| {
        let margins = MARGINS.iter().take(MARGINS_BY_REACH);
        margins.map(move |margin| value * (1.0 + direction * margin))
    });
    let by_model = MARGINS.map(|margin| nearest * (1.0 + direction * margin));
    let mut all: Vec<(f64, f64)> = between
        .into_iter()
        .chain(beyond)
        .map(|value| (value, plain(exact(value), direction)))
        .chain(by_reach.chain(by_model).map(|value| (value, exact(value))))
        .filter(|&(_, number)| number > 0.0)
        .collect();
    all.sort_by(|(one, _), (other, _)| (one - stated).abs().total_cmp(&(other - stated).abs()));
    all.into_iter().map(|(_, number)| number).collect()
}

/// To three digits, outwards: values that are found by trying need no more.
fn plain(number: f64, direction: f64) -> f64 {
    if number <= 0.0 {
        return number;
    }
    let per_unit = libm::pow(10.0, 2.0 - libm::floor(libm::log10(number)));
    outwards_to(number, per_unit, direction)
}

/// In which direction a bound is relaxed.
const fn outwards(bound: Bound) -> f64 {
    match bound.end() {
        End::Least => -1.0,
        End::Most => 1.0,
    }
}

/// A bound's value in the unit that people use, rounded outwards so that it can be written.
fn in_units(bound: Bound, value: f64, direction: f64) -> f64 {
    let (value, per_unit) = match bound {
        Bound::SwingLeast | Bound::SwingMost => (Angle::rad(value).to_deg(), 100.0),
        Bound::LayerLeast
        | Bound::LayerMost
        | Bound::StepLeast
        | Bound::StepMost
        | Bound::Scallop
        | Bound::Edge => (value, 1000.0),
        Bound::OverlapLeast | Bound::OverlapMost => (value, 1000.0),
        Bound::Time => (value, 10.0),
        Bound::Cuts => (value, 1.0),
    };
    outwards_to(value, per_unit, direction)
}

/// Rounded to parts of a unit, outwards.
fn outwards_to(value: f64, per_unit: f64, direction: f64) -> f64 {
    let count = value * per_unit;
    let rounded = if direction < 0.0 {
        (count + 1e-6).floor()
    } else {
        (count - 1e-6).ceil()
    };
    rounded / per_unit
}

const fn unit(bound: Bound) -> &'static str {
    match bound {
        Bound::SwingLeast | Bound::SwingMost => " deg",
        Bound::LayerLeast
        | Bound::LayerMost
        | Bound::StepLeast
        | Bound::StepMost
        | Bound::Scallop
        | Bound::Edge => " mm",
        Bound::Time => " s",
        Bound::OverlapLeast | Bound::OverlapMost | Bound::Cuts => "",
    }
}

/// A bound as the job writes it, with another value.
fn relation(asked: &RoughVcut, bound: Bound, text: &str) -> String {
    let (name, least) = match bound {
        Bound::SwingLeast | Bound::SwingMost => ("swing", matches!(bound, Bound::SwingLeast)),
        Bound::LayerLeast | Bound::LayerMost => ("layer", matches!(bound, Bound::LayerLeast)),
        Bound::StepLeast | Bound::StepMost => ("step", matches!(bound, Bound::StepLeast)),
        Bound::OverlapLeast | Bound::OverlapMost => ("overlap", false),
        Bound::Scallop => ("scallop", false),
        Bound::Edge => ("edge", false),
        Bound::Time => ("time", false),
        Bound::Cuts => ("cuts", false),
    };
    let sign = match (is_given(asked, bound), least) {
        (true, true | false) => "=",
        (false, true) => ">=",
        (false, false) => "<=",
    };
    format!("`{name} {sign} {text}`")
}

/// Where the operation says a bound: a given value, or a limit.
fn place(asked: &RoughVcut, bound: Bound) -> Option<Span> {
    // Asked of the function that writes it, so that the two cannot differ.
    set(&mut asked.clone(), bound, 0.0)
}

/// What a bound asks for, and what states it.
fn party(asked: &RoughVcut, bound: Bound) -> Party {
    let said = if place(asked, bound).is_some() {
        Said::Operation
    } else {
        Said::Nowhere
    };
    let limits = &asked.limits;
    let deg = |value: Angle| format!("{} deg", show(value.to_deg()));
    let mm = |value: Length| format!("{} mm", show(value.to_mm()));
    let words = match bound {
        Bound::SwingLeast => side("swing", asked.swing.value, limits.swing.least, "at least", deg),
        Bound::SwingMost => side("swing", asked.swing.value, limits.swing.most, "at most", deg),
        Bound::LayerLeast => side("layer", asked.layer.value, limits.layer.least, "at least", mm),
        Bound::LayerMost => side("layer", asked.layer.value, limits.layer.most, "at most", mm),
        Bound::StepLeast => side("step", asked.step.value, limits.step.least, "at least", mm),
        Bound::StepMost => side("step", asked.step.value, limits.step.most, "at most", mm),
        Bound::OverlapLeast | Bound::OverlapMost => match asked.overlap.value {
            Auto::Given(overlap) => Some(format!("an overlap of {} %", show(overlap * 100.0))),
            Auto::Auto => None,
        },
        Bound::Scallop => limits
            .scallop
            .map(|limit| format!("a scallop of at most {}", mm(limit.value))),
        Bound::Edge => return edge(asked),
        Bound::Time => limits
            .time
            .map(|limit| format!("a time of at most {} s by the model", show(limit.value.to_s()))),
        Bound::Cuts => limits.cuts.map(|limit| match limit.value {
            most if most < 2.0 => "one cut at most by the model".to_owned(),
            most => format!("at most {} cuts by the model", show(most.floor())),
        }),
    };
    Party {
        said,
        words: words.unwrap_or_else(|| nature(bound).to_owned()),
    }
}

/// One side of a value that is given or limited.
fn side<T: Copy>(
    name: &str,
    value: Auto<T>,
    limit: Option<Sourced<T>>,
    relation: &str,
    text: impl Fn(T) -> String,
) -> Option<String> {
    match value {
        Auto::Given(value) => Some(format!("a {name} of {}", text(value))),
        Auto::Auto => limit.map(|limit| format!("a {name} of {relation} {}", text(limit.value))),
    }
}

/// What a bound is where the job says nothing.
const fn nature(bound: Bound) -> &'static str {
    match bound {
        Bound::SwingLeast => "a swing of at least 1 deg",
        Bound::SwingMost => "a swing of at most 89 deg",
        Bound::LayerLeast => "layers of at least a micrometre",
        Bound::LayerMost => "layers no deeper than the work",
        Bound::StepLeast => "steps of at least a micrometre",
        Bound::StepMost => "steps no wider than the stock",
        Bound::OverlapLeast => "Vs that leave no gap between them",
        Bound::OverlapMost => "an overlap of at most 95 %",
        Bound::Scallop => "a scallop of any height",
        Bound::Edge => "the blade's edge",
        Bound::Time => "a time of any length",
        Bound::Cuts => "any number of cuts",
    }
}

fn edge(asked: &RoughVcut) -> Party {
    let length = asked.blade.cutting_length.value;
    match asked.limits.edge {
        Some(limit) if limit.value < length => Party {
            said: Said::Operation,
            words: format!("at most {} mm of edge in use", show(limit.value.to_mm())),
        },
        Some(_) | None => Party {
            said: Said::Blade,
            words: format!("a blade with {} mm of edge", show(length.to_mm())),
        },
    }
}
