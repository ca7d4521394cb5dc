//! What the planner has to say when there is no plan.

use super::parameters::{VcutParameters, show};
use super::{MOST_CUTS, MOST_OPERATIONS, grid};
use crate::diag::{Code, Diagnostic};
use crate::geom::profile::Profile;
use crate::job::{Auto, CheckedJob, RoughVcut};
use vcutc_backend_api::units::Length;

pub(super) fn too_many_operations(asked: &RoughVcut, count: usize) -> Diagnostic {
    Diagnostic::new(
        Code::TooManyCuts,
        format!("this job has {count} operations, a job may have {MOST_OPERATIONS}"),
        asked.head_span,
        "the first one too many",
    )
    .help("split the job")
}

pub(super) fn nothing_to_cut(
    job: &CheckedJob,
    asked: &RoughVcut,
    parameters: &VcutParameters,
    clearance: &Profile,
) -> Diagnostic {
    let lowest = clearance.lowest().z + parameters.drop.to_mm();
    let depth = job.stock.height.to_mm() - lowest;
    let message = "this operation leaves nothing to cut";
    let diagnostic = Diagnostic::new(
        Code::NothingToCut,
        message,
        asked.head_span,
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
    if depth > 0.0 {
        diagnostic
            .note(format!(
                "the depth of {} mm is less than one layer of {} mm, and tips are not raised",
                show(depth),
                show(parameters.layer.to_mm())
            ))
            .help(format!(
                "set `residual = lift`, or use a `layer` of at most {} mm",
                show(grid::down(depth))
            ))
    } else {
        diagnostic.help("make the stock higher or the part lower, or reduce `allowance`")
    }
}

pub(super) fn too_many_cuts(asked: &RoughVcut, parameters: &VcutParameters, count: usize) -> Diagnostic {
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
        (asked.head_span, label)
    });
    let message = if count > MOST_CUTS {
        format!("this operation would take up to {count} cuts, a program may have {MOST_CUTS}")
    } else {
        format!(
            "the {count} cuts of this operation are too many beside others, or lie too close together to be planned"
        )
    };
    let mut diagnostic = Diagnostic::new(Code::TooManyCuts, message, span, label);
    for (span, label) in labels {
        diagnostic = diagnostic.and(span, label);
    }
    match (asked.layer.value, asked.step.value, asked.limits.scallop) {
        (Auto::Auto, _, Some(limit)) => {
            let least = show((asked.allowance.value + parameters.drop).to_mm());
            diagnostic
                .and(
                    limit.span.unwrap_or(asked.head_span),
                    "the layer follows from this limit",
                )
                .help(format!(
                    "set the limit well above {least} mm: what is left of it decides the layer"
                ))
        }
        (Auto::Auto, Auto::Auto, None) => diagnostic.help("use a longer blade or a smaller stock"),
        (Auto::Given(_), _, _) | (Auto::Auto, Auto::Given(_), None) => {
            diagnostic.help("use a larger `layer` and `step`, or leave both `auto`")
        }
    }
}
