//! Much of what is to go stays: a plan that keeps its limits may still cut little.
//!
//! What is to go is what lies above the part with allowance and standoff. Where the compiler chose what
//! stays, a tenth of it is much. Where the job says so itself, by a limit on the scallop, by its own swing and layer or by its
//! tips, that is the user's word, and only half is.

use super::attempts::changed;
use crate::asked::RoughVcut;
use crate::choice::LITTLE;
use crate::plan::PlannedVcut;
use crate::plan::refusal::Offer;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::planned::{Balance, Compile};
use vcutc_job::{Auto, Sourced};

/// What may stay where the job itself says what does, as a share.
const SAID: f64 = 0.5;

/// Tighter limits that are tried, as shares of the limit, or of what stays at most where there is none.
const TIGHTER: [f64; 2] = [0.6, 0.35];

/// A change is offered if it leaves no more than this share of what stays now.
const WORTH: f64 = 0.8;

/// Plans of more cuts are not changed on trial.
const MOST_CUTS: usize = 2_000;

/// Whether the compiler decides what stays.
fn is_chosen(asked: &RoughVcut) -> bool {
    let limits = &asked.limits;
    let is_open = asked.swing.value == Auto::Auto || asked.layer.value == Auto::Auto;
    limits.chosen.is_some() || (limits.scallop.is_none() && is_open && asked.tips.is_none())
}

/// A change of an operation.
type Change<'c> = dyn Fn(&mut RoughVcut) + 'c;

/// How much stays with a change, where that is worth offering.
type ShareWith<'s> = dyn Fn(&Change<'_>) -> Option<f64> + 's;

/// The warning, if much stays. What it offers was compiled.
pub(crate) fn much_stays(
    vcut: &PlannedVcut,
    balance: Balance<'_>,
    compile: &Compile<'_>,
) -> Option<Diagnostic> {
    let asked = &vcut.asked;
    let much = if is_chosen(asked) { LITTLE } else { SAID };
    let share = balance.share();
    if share <= much {
        return None;
    }
    let span = asked.limits.scallop.and_then(|limit| limit.span);
    let diagnostic = Diagnostic::new(
        Code::MuchStays,
        format!(
            "{} % of the material to cut away stays: {:.0} of {:.0} mm2",
            percent(share),
            balance.stays().to_mm2(),
            balance.whole.to_mm2()
        ),
        span.unwrap_or(asked.setup.head_span),
        cause(asked),
    )
    .note("the material to cut away is all that lies above the part, its allowance and the standoff");
    Some(if balance.report.cuts() > MOST_CUTS {
        diagnostic
    } else {
        let share_with = |change: &Change<'_>| {
            let (plan, report) = compile(&|operation| changed(operation, &change))?;
            let then = Balance::of(&plan, &report)?.share();
            (then < WORTH * share).then_some(then)
        };
        let now = asked
            .limits
            .scallop
            .map_or(balance.report.scallop.height, |limit| limit.value);
        with_what_leaves_less(diagnostic, asked, now, &share_with)
    })
}

/// What lets so much stay.
fn cause(asked: &RoughVcut) -> String {
    match (asked.limits.scallop, asked.limits.chosen) {
        (Some(limit), Some(_)) => format!(
            "no limit on scallop is set; the chosen one is {} mm",
            show(limit.value.to_mm())
        ),
        (Some(_), None) => "the limit allows it".to_owned(),
        (None, _) if asked.tips.is_some() => "these tips leave it".to_owned(),
        (None, _) => "no limit on scallop is set".to_owned(),
    }
}

/// In percent, as far as it distinguishes two plans.
fn percent(share: f64) -> String {
    format!("{:.0}", share * 100.0)
}

/// With a tighter limit that leaves less, or with all that is given left open.
fn with_what_leaves_less(
    diagnostic: Diagnostic,
    asked: &RoughVcut,
    now: Length,
    share_with: &ShareWith<'_>,
) -> Diagnostic {
    if asked.tips.is_some() {
        return diagnostic;
    }
    if let Some((limit, then)) = tighter_limit(asked, now, share_with) {
        let value = format!("{} mm", show(limit.to_mm()));
        let with = format!("with `scallop <= {value}`, {} % stays", percent(then));
        let given = asked.limits.scallop.and_then(|limit| limit.span);
        return match (given, place_of_new_limit(asked)) {
            (Some(span), _) => diagnostic.fix(with, span, value),
            (None, Some((at, before, after))) => diagnostic.fix(
                format!("{} % stays with a limit", percent(then)),
                at,
                format!("{before}{value}{after}"),
            ),
            (None, None) => diagnostic.help(with),
        };
    }
    let opened = Offer::openings(asked).pop();
    match opened.and_then(|offer| Some((share_with(&|asked| asked.clone_from(&offer.changed))?, offer))) {
        Some((then, offer)) => diagnostic.fix_all(
            format!("{}; {} % stays then", offer.title, percent(then)),
            &offer.edits,
        ),
        None => diagnostic,
    }
}

/// The widest limit tried that leaves little, or else the one that leaves the least, and what stays under it.
fn tighter_limit(asked: &RoughVcut, now: Length, share_with: &ShareWith<'_>) -> Option<(Length, f64)> {
    if asked.swing.value != Auto::Auto && asked.layer.value != Auto::Auto {
        return None;
    }
    let mut best: Option<(Length, f64)> = None;
    for tighter in TIGHTER {
        let limit = Length::mm((now.to_mm() * tighter * 10.0).ceil() / 10.0);
        let Some(then) = share_with(&|asked| {
            asked.limits.scallop = Some(Sourced {
                value: limit,
                span: asked.limits.scallop.and_then(|given| given.span),
            });
            asked.limits.chosen = None;
        }) else {
            break;
        };
        best = Some((limit, then));
        if then <= LITTLE {
            break;
        }
    }
    best
}

/// Where a limit on the scallop can be added, with what comes before and after its value.
fn place_of_new_limit(asked: &RoughVcut) -> Option<(Span, &'static str, &'static str)> {
    let limits = &asked.limits;
    let bounds = [limits.swing.least, limits.swing.most].map(|bound| bound?.span);
    let lengths = [
        limits.layer.least,
        limits.layer.most,
        limits.step.least,
        limits.step.most,
        limits.edge,
    ];
    let others = [
        limits.time.and_then(|limit| limit.span),
        limits.cuts.and_then(|limit| limit.span),
    ];
    let lengths = lengths.map(|bound| bound?.span);
    let given = bounds.into_iter().chain(lengths).chain(others);
    match given.flatten().max_by_key(|span| (span.file, span.end)) {
        Some(last) => Some((last.after(), ", scallop <= ", "")),
        None => Some((asked.setup.rake.span?.after(), "\n  limits { scallop <= ", " }")),
    }
}
