//! What a proof finds wrong with a pocket, in words, with changes that were tried.

use crate::asked::ClearPocket;
use crate::decided::Planned;
use crate::plan::Entry;
use std::any::Any;
use vcutc_backend_api::units::{Area, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Auto;
use vcutc_job::operation::{Operation, Trials};
use vcutc_process::verdict::words::explained as in_words;
use vcutc_simulation::prove::{ClearingFault, CutFault, Finding};

/// Shares of the radius that are tried as step.
const STEPS: [f64; 5] = [1.0, 0.9, 0.8, 0.7, 0.6];

pub(crate) fn explained(asked: &ClearPocket, finding: Finding, trials: &mut dyn Trials) -> Diagnostic {
    let CutFault::Clearing(fault) = finding.fault else {
        return in_words(asked, finding);
    };
    match fault {
        ClearingFault::Uncut {
            area,
            places,
            widest,
            limit,
        } => {
            let found = uncut(asked, finding, (area, places, widest, limit));
            with_step(asked, found, trials)
        }
        ClearingFault::Thick { layer, limit } => Diagnostic::new(
            Code::LayerTooThick,
            format!(
                "{} mm of material at once at {}, and `{}` cuts {} mm",
                show(layer.to_mm()),
                place(finding),
                asked.crusher.name,
                show(limit.to_mm())
            ),
            asked.setup.head_span,
            "a layer of this operation",
        )
        .help("use thinner layers"),
        ClearingFault::Body { above, by } => Diagnostic::new(
            Code::BodyInWork,
            format!(
                "the body of `{}`, from {} mm above its edge, meets a wall by {} mm at {}",
                asked.crusher.name,
                show(above.to_mm()),
                show((by.to_mm() * 1e3).ceil() / 1e3),
                place(finding)
            ),
            asked.setup.head_span,
            "a pass of this operation",
        )
        .and(
            asked
                .crusher
                .body
                .as_ref()
                .map_or(asked.crusher.span, |body| body.span),
            "the body",
        )
        .help(format!(
            "use a tool whose body is slimmer than its edge down there, or `allowance = {} mm`",
            show(((asked.allowance.value + by).to_mm() * 1e3).ceil() / 1e3)
        )),
        ClearingFault::Undecided => Diagnostic::new(
            Code::PocketTooNarrow,
            format!(
                "the passes over `{}` are too many to prove what they clear",
                asked.region.name
            ),
            asked.region_span,
            "too large for this tool",
        )
        .help("use a wider tool, or clear the region in parts"),
        ClearingFault::Wall { .. }
        | ClearingFault::Floor { .. }
        | ClearingFault::Shank { .. }
        | ClearingFault::Attached { .. }
        | ClearingFault::Pillars { .. }
        | ClearingFault::Leans
        | ClearingFault::Unopened
        | ClearingFault::Engaged { .. } => in_words(asked, finding),
    }
}

fn uncut(
    asked: &ClearPocket,
    finding: Finding,
    (area, places, widest, limit): (Area, usize, Length, Area),
) -> Diagnostic {
    let stay = match places {
        1 => "1 place stays".to_owned(),
        places => format!("{places} places stay"),
    };
    let step = asked.step.span.unwrap_or(asked.setup.head_span);
    let limit_span = asked.limits.uncut.span;
    let diagnostic = Diagnostic::new(
        Code::PocketUncut,
        format!(
            "{stay} uncut in `{}`, {} mm2 in all, the widest {} mm, at {}; the limit is {} mm2",
            asked.region.name,
            show((area.to_mm2() * 10.0).ceil() / 10.0),
            show((widest.to_mm() * 100.0).ceil() / 100.0),
            place(finding),
            show(limit.to_mm2())
        ),
        step,
        "leaves core between passes",
    );
    match limit_span {
        Some(span) => diagnostic.and(span, "the limit"),
        None => diagnostic.note("without `limits` 1 mm2 may stay"),
    }
}

/// Offers the widest step that keeps all limits.
fn with_step(asked: &ClearPocket, diagnostic: Diagnostic, trials: &mut dyn Trials) -> Diagnostic {
    let radius = asked.crusher.radius.value.to_mm();
    let given = match asked.step.value {
        Auto::Given(step) => step.to_mm(),
        Auto::Auto => radius,
    };
    let steps = STEPS.map(|share| (share * radius * 1e3).floor() / 1e3);
    let found = steps.into_iter().filter(|step| *step < given).find(|&step| {
        trials.proves(&|operation: &mut dyn Operation| {
            let operation: &mut dyn Any = operation;
            if let Some(pocket) = operation.downcast_mut::<ClearPocket>() {
                pocket.step.value = Auto::Given(Length::mm(step));
            }
        })
    });
    let Some(step) = found else {
        return diagnostic.help("use a pattern with less between its passes, or a wider limit");
    };
    match asked.step.span {
        Some(span) => diagnostic.fix(
            format!("use a step of {} mm, which keeps all limits", show(step)),
            span,
            format!("{} mm", show(step)),
        ),
        None => diagnostic.help(format!("use `step = {} mm`, which keeps all limits", show(step))),
    }
}

/// `(12.5 mm, 40 mm)`.
fn place(finding: Finding) -> String {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    format!(
        "({} mm, {} mm)",
        round(finding.tip.x),
        round(finding.y.unwrap_or_default())
    )
}

/// Warns where no run begins in the hole that the job names.
pub(crate) fn of_the_hole(planned: &Planned) -> Option<Diagnostic> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let opening = asked.opening.filter(|_| !plan.uses_the_hole())?;
    let goes_down = plan.runs.iter().find_map(|run| match run.entry {
        Entry::Ramp { line } => Some(("a ramp", line.from)),
        Entry::Helix { helix } => Some(("a helix", helix.last)),
        Entry::Hole { .. } | Entry::Return { .. } | Entry::Open { .. } => None,
    });
    let why = match goes_down {
        None => "it comes in through an open side".to_owned(),
        Some((way, at)) => format!(
            "it goes down {way} at ({} mm, {} mm), to which no straight way leads from the hole",
            show((at.x * 100.0).round() / 100.0),
            show((at.y * 100.0).round() / 100.0)
        ),
    };
    let diagnostic = Diagnostic::new(
        Code::HoleUnused,
        format!(
            "`{}` goes into `{}` without the hole: {why}",
            asked.crusher.name, asked.region.name
        ),
        opening.span.unwrap_or(asked.setup.head_span),
        "not used",
    );
    Some(diagnostic.help(match goes_down {
        None => "delete `opening`",
        Some(_) => "delete `opening`, or name a hole from which a straight way leads to the first pass",
    }))
}

/// Warns where the lines of a sound field are not the whole story.
pub(crate) fn of_field(planned: &Planned) -> Option<Diagnostic> {
    let asked = &planned.asked;
    let field = planned
        .plan
        .field
        .filter(|field| field.broken + field.extra > 0)?;
    let name = &asked.region.name;
    let ends = match field.broken {
        0 => format!("`pattern = field`: all {} lines go through `{name}`", field.lines),
        1 => format!(
            "`pattern = field`: 1 of {} lines ends within `{name}`",
            field.lines
        ),
        broken => format!(
            "`pattern = field`: {broken} of {} lines end within `{name}`",
            field.lines
        ),
    };
    let extra = match field.extra {
        0 => "nothing is left between them".to_owned(),
        1 => format!("1 extra pass clears {} mm2", show(field.cleared.to_mm2().round())),
        extra => format!(
            "{extra} extra passes clear {} mm2",
            show(field.cleared.to_mm2().round())
        ),
    };
    let diagnostic = Diagnostic::new(
        Code::FieldBroken,
        format!("{ends}; {extra}"),
        asked.pattern.span.unwrap_or(asked.setup.head_span),
        "the lines of the field as they are",
    );
    Some(diagnostic.help("use `pattern = sfs` for rounded passes that leave nothing"))
}
