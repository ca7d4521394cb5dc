//! What is said when no parameters keep all that a job asks for: which bounds conflict, where they stand, and the nearest
//! value that works. The value has been tried before it is offered.

use super::search;
use super::{Resolution, show};
use crate::diag::{Code, Diagnostic};
use crate::job::{Auto, CheckedJob, Lattice, RoughVcut, Sourced};
use crate::plan::optimum::Bound;
use crate::source::Span;
use vcutc_backend_api::units::{Angle, Duration, Length};

/// How much more than the nearest value is tried, as shares of it: bounds that touch leave nothing to round.
const MARGINS: [f64; 5] = [0.0, 0.0005, 0.005, 0.02, 0.1];

/// A bound in the job's words.
struct Party {
    /// Where it stands; none when the job does not say it.
    span: Option<Span>,
    /// What it asks for.
    words: String,
}

/// Bounds that cannot be kept together, with the nearest value of each that the others allow.
pub(super) fn conflict(
    job: &CheckedJob,
    asked: &RoughVcut,
    resolution: &Resolution,
    bounds: &[Bound],
    nearest: &[Option<f64>],
) -> Diagnostic {
    let mut parties: Vec<Party> = bounds.iter().map(|bound| party(asked, *bound)).collect();
    // What the job says comes first: that is what can be changed.
    parties.sort_by_key(|party| party.span.is_none());
    let words: Vec<&str> = parties.iter().map(|party| party.words.as_str()).collect();
    let message = match words.as_slice() {
        [] => "no parameters keep all limits".to_owned(),
        [one] => format!("no parameters keep {one}"),
        [first @ .., last] => format!("no parameters keep both {} and {last}", first.join(", ")),
    };
    let mut places = parties
        .iter()
        .filter_map(|party| Some((party.span?, party.words.clone())));
    let (span, label) = places
        .next()
        .unwrap_or_else(|| (asked.head_span, "this operation".to_owned()));
    let mut diagnostic = Diagnostic::new(Code::LimitsConflict, message, span, label);
    for (span, label) in places {
        diagnostic = diagnostic.and(span, label);
    }
    for (bound, nearest) in bounds.iter().zip(nearest) {
        let offer = nearest.and_then(|nearest| offer(job, asked, resolution, *bound, nearest));
        if let Some((span, text)) = offer {
            let title = format!("use {}", relation(asked, *bound, &text));
            diagnostic = diagnostic.fix(title, span, text);
        }
    }
    if diagnostic.fixes.is_empty() {
        diagnostic = diagnostic.help("widen one of the two, or leave more of the parameters `auto`");
    }
    diagnostic
}

/// Limits that leave less between them than a micrometre, or a thousandth of a degree.
pub(super) fn off_grid(asked: &RoughVcut) -> Diagnostic {
    Diagnostic::new(
        Code::LimitsConflict,
        "no layer and step in whole micrometres keep all limits",
        asked.head_span,
        "the limits leave too little between them",
    )
    .help("widen one of the limits by a few micrometres")
}

/// A value for a bound that works, and where it goes.
fn offer(
    job: &CheckedJob,
    asked: &RoughVcut,
    resolution: &Resolution,
    bound: Bound,
    nearest: f64,
) -> Option<(Span, String)> {
    let direction = outwards(bound);
    MARGINS.into_iter().find_map(|margin| {
        let number = in_units(bound, nearest * (1.0 + direction * margin), direction);
        let mut changed = asked.clone();
        let span = set(&mut changed, bound, number)?;
        let lattices: Vec<Lattice> = search::lattices(&changed)
            .into_iter()
            .filter(|lattice| resolution.lattices.contains(lattice))
            .collect();
        search::choose(job, &changed, lattices, resolution.standoff).ok()?;
        Some((span, format!("{}{}", show(number), unit(bound))))
    })
}

/// In which direction a bound is relaxed.
const fn outwards(bound: Bound) -> f64 {
    match bound {
        Bound::SwingLeast | Bound::LayerLeast | Bound::StepLeast | Bound::OverlapLeast => -1.0,
        Bound::SwingMost
        | Bound::LayerMost
        | Bound::StepMost
        | Bound::OverlapMost
        | Bound::Scallop
        | Bound::Edge
        | Bound::Time
        | Bound::Cuts => 1.0,
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

/// Writes a number, in the unit that people use, where the job says a bound; where that stands. None where the job does
/// not say it.
fn set(asked: &mut RoughVcut, bound: Bound, number: f64) -> Option<Span> {
    fn given<T>(value: &mut Sourced<Auto<T>>, limit: Option<&mut Sourced<T>>, number: T) -> Option<Span> {
        match (&mut value.value, limit) {
            (Auto::Given(given), _) => {
                *given = number;
                value.span
            }
            (Auto::Auto, Some(limit)) => written(Some(limit), number),
            (Auto::Auto, None) => None,
        }
    }
    fn written<T>(limit: Option<&mut Sourced<T>>, number: T) -> Option<Span> {
        let limit = limit?;
        limit.value = number;
        limit.span
    }
    let limits = &mut asked.limits;
    match bound {
        Bound::SwingLeast => given(&mut asked.swing, limits.swing.least.as_mut(), Angle::deg(number)),
        Bound::SwingMost => given(&mut asked.swing, limits.swing.most.as_mut(), Angle::deg(number)),
        Bound::LayerLeast => given(&mut asked.layer, limits.layer.least.as_mut(), Length::mm(number)),
        Bound::LayerMost => given(&mut asked.layer, limits.layer.most.as_mut(), Length::mm(number)),
        Bound::StepLeast => given(&mut asked.step, limits.step.least.as_mut(), Length::mm(number)),
        Bound::StepMost => given(&mut asked.step, limits.step.most.as_mut(), Length::mm(number)),
        Bound::OverlapLeast | Bound::OverlapMost => given(&mut asked.overlap, None, number),
        Bound::Scallop => written(limits.scallop.as_mut(), Length::mm(number)),
        Bound::Edge => written(limits.edge.as_mut(), Length::mm(number)),
        Bound::Time => written(limits.time.as_mut(), Duration::s(number)),
        Bound::Cuts => written(limits.cuts.as_mut(), number),
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

/// Whether a bound is that of a given value.
const fn is_given(asked: &RoughVcut, bound: Bound) -> bool {
    match bound {
        Bound::SwingLeast | Bound::SwingMost => matches!(asked.swing.value, Auto::Given(_)),
        Bound::LayerLeast | Bound::LayerMost => matches!(asked.layer.value, Auto::Given(_)),
        Bound::StepLeast | Bound::StepMost => matches!(asked.step.value, Auto::Given(_)),
        Bound::OverlapLeast | Bound::OverlapMost => matches!(asked.overlap.value, Auto::Given(_)),
        Bound::Scallop | Bound::Edge | Bound::Time | Bound::Cuts => false,
    }
}

/// Where a bound stands and what it asks for.
fn party(asked: &RoughVcut, bound: Bound) -> Party {
    let limits = &asked.limits;
    let deg = |angle: Angle| format!("{} deg", show(angle.to_deg()));
    let mm = |length: Length| format!("{} mm", show(length.to_mm()));
    let least = |name: &str, value: Option<(String, Option<Span>)>, otherwise: &str| match value {
        Some((text, span)) => Party {
            span,
            words: format!("a {name} of at least {text}"),
        },
        None => Party {
            span: None,
            words: otherwise.to_owned(),
        },
    };
    let most = |name: &str, value: Option<(String, Option<Span>)>, otherwise: &str| match value {
        Some((text, span)) => Party {
            span,
            words: format!("a {name} of at most {text}"),
        },
        None => Party {
            span: None,
            words: otherwise.to_owned(),
        },
    };
    let exactly = |name: &str, text: String, span: Option<Span>| Party {
        span,
        words: format!("a {name} of {text}"),
    };
    let angle = |limit: Option<Sourced<Angle>>| limit.map(|limit| (deg(limit.value), limit.span));
    let length = |limit: Option<Sourced<Length>>| limit.map(|limit| (mm(limit.value), limit.span));
    match (bound, asked.swing.value, asked.layer.value, asked.step.value) {
        (Bound::SwingLeast | Bound::SwingMost, Auto::Given(swing), _, _) => {
            exactly("swing", deg(swing), asked.swing.span)
        }
        (Bound::SwingLeast, Auto::Auto, _, _) => least("swing", angle(limits.swing.least), "a V that opens"),
        (Bound::SwingMost, Auto::Auto, _, _) => {
            most("swing", angle(limits.swing.most), "a V that is no plane")
        }
        (Bound::LayerLeast | Bound::LayerMost, _, Auto::Given(layer), _) => {
            exactly("layer", mm(layer), asked.layer.span)
        }
        (Bound::LayerLeast, _, Auto::Auto, _) => {
            least("layer", length(limits.layer.least), "a layer of a micrometre")
        }
        (Bound::LayerMost, _, Auto::Auto, _) => most(
            "layer",
            length(limits.layer.most),
            "a layer no deeper than the work",
        ),
        (Bound::StepLeast | Bound::StepMost, _, _, Auto::Given(step)) => {
            exactly("step", mm(step), asked.step.span)
        }
        (Bound::StepLeast, _, _, Auto::Auto) => {
            least("step", length(limits.step.least), "a step of a micrometre")
        }
        (Bound::StepMost, _, _, Auto::Auto) => {
            most("step", length(limits.step.most), "a step no wider than the stock")
        }
        (Bound::OverlapLeast | Bound::OverlapMost, ..) => overlap(asked, bound),
        (Bound::Scallop, ..) => match limits.scallop {
            Some(limit) => Party {
                span: limit.span,
                words: format!("a scallop of at most {}", mm(limit.value)),
            },
            None => Party {
                span: None,
                words: "a scallop of any height".to_owned(),
            },
        },
        (Bound::Edge, ..) => edge(asked),
        (Bound::Time, ..) => match limits.time {
            Some(limit) => Party {
                span: limit.span,
                words: format!("a time of at most {} s", show(limit.value.to_s())),
            },
            None => Party {
                span: None,
                words: "a time of any length".to_owned(),
            },
        },
        (Bound::Cuts, ..) => match limits.cuts {
            Some(limit) => Party {
                span: limit.span,
                words: format!("at most {} cuts", show(limit.value)),
            },
            None => Party {
                span: None,
                words: "any number of cuts".to_owned(),
            },
        },
    }
}

fn overlap(asked: &RoughVcut, bound: Bound) -> Party {
    match (asked.overlap.value, asked.step.value, bound) {
        (Auto::Given(overlap), Auto::Auto, _) => Party {
            span: asked.overlap.span,
            words: format!("an overlap of {} %", show(overlap * 100.0)),
        },
        (_, _, Bound::OverlapLeast) => Party {
            span: None,
            words: "Vs that leave no gap between them".to_owned(),
        },
        (_, _, _) => Party {
            span: None,
            words: "Vs that overlap by no more than 95 %".to_owned(),
        },
    }
}

fn edge(asked: &RoughVcut) -> Party {
    let blade = &asked.blade;
    let length = blade.cutting_length;
    match asked.limits.edge {
        Some(limit) if limit.value < length.value => Party {
            span: limit.span,
            words: format!("at most {} mm of edge in use", show(limit.value.to_mm())),
        },
        Some(_) | None => Party {
            span: Some(length.span.unwrap_or(blade.span)),
            words: format!("a blade with {} mm of edge", show(length.value.to_mm())),
        },
    }
}
