//! What the planner has to say when there is no plan.

use super::MOST_CUTS;
use super::optimum::Bound;
use super::parameters::VcutParameters;
use super::refusal::{Ladder, Offer, Refused};
use super::wider::wider_scallops;
use crate::asked::{Residual, RoughVcut};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_job::{Auto, CheckedJob, Sourced};

pub(super) fn nothing_to_cut(
    job: &CheckedJob,
    asked: &RoughVcut,
    parameters: &VcutParameters,
    clearance: &Profile,
) -> Refused {
    let lowest = clearance.lowest().z + parameters.drop.to_mm();
    let depth = job.stock.height.to_mm() - lowest;
    let message = "this operation leaves nothing to cut";
    let mut diagnostic = Diagnostic::new(
        Code::NothingToCut,
        message,
        asked.setup.head_span,
        "no tip fits between part and stock",
    )
    .and(
        job.profile_span,
        format!(
            "the lowest tip that clears the part lies at z {} mm",
            show(lowest)
        ),
    )
    .and(
        job.stock_span,
        format!("the stock ends at z {} mm", show(job.stock.height.to_mm())),
    );
    diagnostic.notes.extend(beyond_the_stock(parameters));
    if depth <= 0.0 {
        return diagnostic
            .help("make the stock higher or the part lower, or reduce `allowance`")
            .into();
    }
    let layer = show(grid::down(depth));
    let whole = show(parameters.layer.to_mm());
    let note = if depth < parameters.layer.to_mm() {
        let depth = show(depth);
        format!("the depth of {depth} mm is less than one layer of {whole} mm, and tips are not raised")
    } else {
        format!(
            "no tip of a whole layer of {whole} mm has anything above it that is still to be cut, and tips are not raised"
        )
    };
    Refused {
        diagnostic: diagnostic.note(note),
        ladders: vec![raised_tips(asked), thinner_layers(asked, depth)],
        resort: Offer::openings(asked),
        otherwise: Some(format!(
            "set `residual = lift`, or use a `layer` of at most {layer} mm"
        )),
    }
}

fn raised_tips(asked: &RoughVcut) -> Ladder {
    let Some(span) = asked.residual.span else {
        return Vec::new();
    };
    let with = |residual: Residual| {
        let mut changed = asked.clone();
        changed.residual.value = Auto::Given(residual);
        Offer {
            title: format!("let tips be raised: `residual = {}`", residual.word()),
            edits: vec![(span, residual.word().to_owned())],
            changed,
        }
    };
    vec![with(Residual::Mixed), with(Residual::Lift)]
}

/// Layers that fit into a depth: its whole, and parts of it.
fn thinner_layers(asked: &RoughVcut, depth: f64) -> Ladder {
    let Some(span) = asked.layer.span else {
        return Vec::new();
    };
    let layers = [1.0, 0.5, 0.25].map(|share| grid::down(depth * share));
    layers
        .into_iter()
        .filter(|&layer| layer > 0.0)
        .map(|layer| {
            let mut changed = asked.clone();
            changed.layer.value = Auto::Given(Length::mm(layer));
            let text = format!("{} mm", show(layer));
            Offer {
                title: format!("use a `layer` of {text}"),
                edits: vec![(span, text)],
                changed,
            }
        })
        .collect()
}

pub(super) fn too_many_cuts(asked: &RoughVcut, parameters: &VcutParameters, count: usize) -> Refused {
    let size = |length: Length| match length.to_mm() {
        mm if mm < 0.01 => format!("{} um", show(mm * 1000.0)),
        mm => format!("{} mm", show(mm)),
    };
    let spans = [
        (asked.layer.span, format!("layers of {}", size(parameters.layer))),
        (asked.step.span, format!("steps of {}", size(parameters.step))),
    ];
    let mut labels = spans.into_iter().filter_map(|(span, label)| Some((span?, label)));
    let (span, label) = labels.next().unwrap_or_else(|| {
        let label = format!(
            "layers of {} and steps of {} over this stock",
            size(parameters.layer),
            size(parameters.step)
        );
        (asked.setup.head_span, label)
    });
    let message = if count > MOST_CUTS {
        format!("this operation would take up to {count} cuts, a program may have {MOST_CUTS}")
    } else {
        format!(
            "the {count} cuts of this operation lie too close together to be planned, or are too many with those of the others"
        )
    };
    let mut diagnostic = Diagnostic::new(Code::TooManyCuts, message, span, label);
    for (span, label) in labels {
        diagnostic = diagnostic.and(span, label);
    }
    let Small {
        label,
        ladders,
        otherwise,
    } = what_is_small(asked, parameters, count);
    if let Some((span, label)) = label {
        diagnostic = diagnostic.and(span, label);
    }
    Refused {
        diagnostic,
        ladders,
        resort: Offer::openings(asked),
        otherwise: Some(otherwise.to_owned()),
    }
}

/// What of an operation makes so many cuts of it.
struct Small {
    label: Option<(Span, &'static str)>,
    ladders: Vec<Ladder>,
    otherwise: &'static str,
}

/// What the job states that is small: a layer or a step, a limit that the layer came up against, or else the limit on scallop.
fn what_is_small(asked: &RoughVcut, parameters: &VcutParameters, count: usize) -> Small {
    let is_given = |value: &Auto<Length>| matches!(value, Auto::Given(_));
    let opened = match (is_given(&asked.layer.value), is_given(&asked.step.value)) {
        (true, true) => Some("use a larger `layer` and `step`, or leave both `auto`"),
        (true, false) => Some("use a larger `layer`, or leave it `auto`"),
        (false, true) => Some("use a larger `step`, or leave it `auto`"),
        (false, false) => None,
    };
    if let Some(otherwise) = opened {
        return Small {
            label: None,
            ladders: vec![open_layer_and_step(asked)],
            otherwise,
        };
    }
    let limited = SMALL_LIMITS.into_iter().find_map(|small| {
        let (bound, _, place, _) = small;
        let limit = place(&mut asked.clone()).copied()?;
        parameters.binding.contains(&bound).then_some((limit, small))
    });
    match (limited, asked.limits.scallop) {
        (Some((limit, (_, name, place, otherwise))), _) => Small {
            label: limit.span.map(|span| (span, "the layer follows from this limit")),
            ladders: vec![wider_limits(asked, name, place, count)],
            otherwise,
        },
        (None, Some(limit)) => Small {
            label: Some((
                limit.span.unwrap_or(asked.setup.head_span),
                "the layer follows from this limit",
            )),
            ladders: vec![wider_scallops(asked, asked.allowance.value + parameters.drop)],
            otherwise: "use a larger `scallop`: what allowance and standoff leave of it decides the layer",
        },
        (None, None) => Small {
            label: None,
            ladders: Vec::new(),
            otherwise: "use a longer blade or a smaller stock",
        },
    }
}

/// Where an operation has a limit on a length.
type Place = fn(&mut RoughVcut) -> Option<&mut Sourced<Length>>;

/// Limits that hold the layer from above, where each stands, and what to do about it.
const SMALL_LIMITS: [(Bound, &str, Place, &str); 3] = [
    (
        Bound::LayerMost,
        "layer",
        |asked| asked.limits.layer.most.as_mut(),
        "use a larger limit on `layer`",
    ),
    (
        Bound::StepMost,
        "step",
        |asked| asked.limits.step.most.as_mut(),
        "use a larger limit on `step`",
    ),
    (
        Bound::Edge,
        "edge",
        |asked| asked.limits.edge.as_mut(),
        "use a larger limit on `edge`",
    ),
];

/// How many cuts are aimed at where limits make too many: as many as are still compared with others.
const USUAL_CUTS: f64 = 5_000.0;

/// Larger limits on a length than the job's, from one with which there are likely to be few enough cuts to be sure: layer and
/// step grow with it, so cuts become fewer by its square.
fn wider_limits(asked: &RoughVcut, name: &str, place: Place, count: usize) -> Ladder {
    let least = (count as f64 / USUAL_CUTS).sqrt().max(1.0);
    let wider = |times: f64| {
        let mut changed = asked.clone();
        let limit = place(&mut changed)?;
        let wide = limit.value.to_mm() * least * times;
        let digits = libm::pow(10.0, 1.0 - libm::floor(libm::log10(wide)));
        limit.value = Length::mm(grid::up((wide * digits).ceil() / digits));
        let (span, text) = (limit.span?, format!("{} mm", show(limit.value.to_mm())));
        Some(Offer {
            title: format!("use `{name} <= {text}`"),
            edits: vec![(span, text)],
            changed,
        })
    };
    [1.0, 2.0, 4.0, 8.0, 16.0, 32.0]
        .into_iter()
        .filter_map(wider)
        .collect()
}

/// The step, the layer, or both as the compiler chooses them: whichever of them is far too small.
fn open_layer_and_step(asked: &RoughVcut) -> Ladder {
    let step = match asked.step.value {
        Auto::Given(_) => asked.step.span,
        Auto::Auto => None,
    };
    let layer = match asked.layer.value {
        Auto::Given(_) => asked.layer.span,
        Auto::Auto => None,
    };
    let open = |(layer, step): (Option<Span>, Option<Span>)| {
        let mut changed = asked.clone();
        let mut edits = Vec::new();
        if let Some(span) = layer {
            changed.layer.value = Auto::Auto;
            edits.push((span, "auto".to_owned()));
        }
        if let Some(span) = step {
            changed.step.value = Auto::Auto;
            edits.push((span, "auto".to_owned()));
        }
        let names = match (layer, step) {
            (Some(_), Some(_)) => "`layer = auto` and `step = auto`",
            (Some(_), None) => "`layer = auto`",
            (None, Some(_)) => "`step = auto`",
            (None, None) => return None,
        };
        Some(Offer {
            title: format!("let the compiler choose: {names}"),
            edits,
            changed,
        })
    };
    let mut ladder: Ladder = [(None, step), (layer, None), (layer, step)]
        .into_iter()
        .filter_map(open)
        .collect();
    ladder.dedup_by(|later, earlier| later.edits == earlier.edits);
    ladder
}

/// Why tips along a spine lie no lower, where they go on down beyond the stock.
#[must_use]
pub fn beyond_the_stock(parameters: &VcutParameters) -> Option<String> {
    (parameters.lowest > Length::mm(0.1)).then(|| {
        format!(
            "beyond the stock cuts go on down by up to {} mm, with an extension of {} mm, and no tip goes below the bottom of the \
             stock; a shorter `extension` or a smaller `run_out` lets them lie lower",
            show(parameters.lowest.to_mm()),
            show(parameters.extension.to_mm())
        )
    })
}
