//! What is said of parameters that contradict one another as they are given.

use crate::asked::{Objective, RoughVcut};
use crate::plan::refusal::{Ladder, Offer, Refused};
use crate::plan::wider::wider_scallops;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{Auto, Bounds, Sourced};

/// A rake at which the shank lies down where cuts along a spine fall.
pub(super) fn check_standing(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) {
    let Some(along) = &asked.along else { return };
    let rake = asked.setup.rake;
    let widest = super::widest_standing(rake.value, along.guide.steepest());
    let swing = match (asked.swing.value, widest) {
        (Auto::Auto, Some(_)) => return,
        (Auto::Given(swing), Some(widest)) if swing <= widest => return,
        (Auto::Auto, None) => None,
        (Auto::Given(swing), _) => Some(swing),
    };
    let steepest = Angle::rad(libm::atan(along.guide.steepest()));
    let held = swing.map_or_else(String::new, |swing| {
        format!(" and a swing of {} deg", show(swing.to_deg()))
    });
    let diagnostic = Diagnostic::new(
        Code::RakeTooFlat,
        format!(
            "with a rake of {} deg{held} the shank lies down where cuts fall",
            show(rake.value.to_deg())
        ),
        rake.span.unwrap_or(asked.setup.head_span),
        format!(
            "cuts that follow the part fall by up to {:.2} deg",
            steepest.to_deg()
        ),
    )
    .and(
        asked.follow.span.unwrap_or(asked.setup.head_span),
        "these cuts rise and fall with the part",
    );
    diagnostics.push(match widest {
        Some(widest) => diagnostic.help(format!(
            "use a `swing` of at most {} deg, a larger rake, or `follow = straight`",
            show(widest.to_deg())
        )),
        None => diagnostic.help("use a larger rake, or `follow = straight`"),
    });
}

pub(super) fn check_rake(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) {
    let (rake, half_apex) = (asked.setup.rake.value, asked.blade.half_apex.value);
    if rake > half_apex {
        return;
    }
    let span = asked.setup.rake.span.unwrap_or(asked.setup.head_span);
    diagnostics.push(
        Diagnostic::new(
            Code::RakeTooFlat,
            format!(
                "with a rake of {} deg the leading edge does not cut",
                show(rake.to_deg())
            ),
            span,
            format!(
                "the edge leads the feed by rake less half apex, {} deg",
                show((rake - half_apex).to_deg())
            ),
        )
        .and(
            asked.blade.half_apex.span.unwrap_or(asked.blade.span),
            format!("half the blade's apex angle is {} deg", show(half_apex.to_deg())),
        )
        .help(format!(
            "use a rake well above {} deg, such as {} deg",
            show(half_apex.to_deg()),
            show(usual_rake(half_apex).to_deg())
        ))
        .fix(
            "use a rake that cuts",
            span,
            format!("{} deg", show(usual_rake(half_apex).to_deg())),
        ),
    );
}

/// The rake of the paper, or for very blunt blades one halfway to upright.
fn usual_rake(half_apex: Angle) -> Angle {
    let paper = Angle::deg(60.0);
    paper.max((half_apex + Angle::deg(90.0)) / 2.0)
}

pub(super) fn standoff_too_small(asked: &RoughVcut, standoff: Length) -> Diagnostic {
    let span = asked.standoff.span.unwrap_or(asked.setup.head_span);
    vcutc_process::standoff::too_small(&asked.blade, standoff, span)
}

pub(super) fn extension_too_short(asked: &RoughVcut, extension: Length, least: Length) -> Diagnostic {
    let blade = &asked.blade;
    let span = asked.setup.extension().span.unwrap_or(asked.setup.head_span);
    let (extension, least) = (show(extension.to_mm()), show(least.to_mm()));
    Diagnostic::new(
        Code::ExtensionTooShort,
        format!("with an extension of {extension} mm the blade would turn within the work"),
        span,
        format!("the edge overhangs the work by {least} mm"),
    )
    .and(
        blade.cutting_length.span.unwrap_or(blade.span),
        format!("{} mm of edge", show(blade.cutting_length.value.to_mm())),
    )
    .help(format!("use at least {least} mm, or leave it `auto`"))
    .fix("let the compiler choose: `auto`", span, "auto")
}

/// Complains of given values outside of their limits.
pub(super) fn check_given(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) {
    let limits = &asked.limits;
    let given = [
        outside(asked, "swing", asked.swing, limits.swing, |swing: Angle| {
            (swing.to_deg(), "deg")
        }),
        outside(asked, "layer", asked.layer, limits.layer, |layer: Length| {
            (layer.to_mm(), "mm")
        }),
        outside(asked, "step", asked.step, limits.step, |step: Length| {
            (step.to_mm(), "mm")
        }),
    ];
    diagnostics.extend(given.into_iter().flatten());
}

/// A given value below or above what its limits allow.
fn outside<T: Copy + PartialOrd>(
    asked: &RoughVcut,
    name: &str,
    value: Sourced<Auto<T>>,
    bounds: Bounds<T>,
    in_units: impl Fn(T) -> (f64, &'static str),
) -> Option<Diagnostic> {
    let Auto::Given(given) = value.value else {
        return None;
    };
    let text = |value: T| {
        let (number, unit) = in_units(value);
        format!("{} {unit}", show(number))
    };
    let span = value.span.unwrap_or(asked.setup.head_span);
    let complaint = |limit: Sourced<T>, side: Side| {
        let (given, bound) = (text(given), text(limit.value));
        let (is, compared, at, change) = match side {
            Side::Below => ("below", "smaller", "at least", "lower"),
            Side::Above => ("above", "larger", "at most", "raise"),
        };
        Diagnostic::new(
            Code::OutOfRange,
            format!("a {name} of {given} is {is} its limit of {bound}"),
            span,
            format!("{compared} than the limit allows"),
        )
        .and(limit.span.unwrap_or(asked.setup.head_span), "the limit")
        .help(format!("use {at} {bound}, or {change} the limit"))
        .fix("use the limit", span, bound)
    };
    let below = bounds.least.filter(|least| given < least.value);
    let above = bounds.most.filter(|most| given > most.value);
    below
        .map(|least| complaint(least, Side::Below))
        .or_else(|| above.map(|most| complaint(most, Side::Above)))
}

/// On which side of a limit a value lies.
#[derive(Clone, Copy)]
enum Side {
    Below,
    Above,
}

/// A scallop limit that allowance and standoff alone exceed, whatever the layer.
pub(super) fn no_room_for_scallops(asked: &RoughVcut, drop: Length) -> Option<Refused> {
    let limit = asked.limits.scallop?;
    let stays = asked.allowance.value + drop;
    if limit.value > stays {
        return None;
    }
    let (least, limit_mm) = (show(stays.to_mm()), show(limit.value.to_mm()));
    let span = limit.span.unwrap_or(asked.setup.head_span);
    let message = format!("at least {least} mm stay on the part below the tips, the limit is {limit_mm} mm");
    let diagnostic = Diagnostic::new(Code::ScallopOverLimit, message, span, "the limit");
    let allowance = (asked.allowance.value > Length::ZERO)
        .then_some(asked.allowance.span)
        .flatten();
    let diagnostic = match allowance {
        Some(span) => diagnostic.and(span, "this stays on the part"),
        None => diagnostic,
    };
    let diagnostic = if drop > Length::ZERO {
        raised_by_standoff(diagnostic, asked, drop)
    } else {
        diagnostic
    };
    Some(Refused {
        diagnostic,
        ladders: vec![
            // Larger limits are kept by the plans that there are, so the first one mostly does.
            wider_scallops(asked, stays),
            wider_swings(asked, drop, limit.value - asked.allowance.value),
        ],
        resort: Offer::openings(asked),
        otherwise: Some(
            "use a larger `scallop`, a wider `swing`, a thinner blade or a smaller `allowance`".to_owned(),
        ),
    })
}

/// How far the standoff raises the tip depends on the swing as much as on the standoff itself, so a given swing is named with it.
fn raised_by_standoff(diagnostic: Diagnostic, asked: &RoughVcut, drop: Length) -> Diagnostic {
    let above = format!(
        "keeps its tip {} mm above the material that stays",
        show(drop.to_mm())
    );
    match (asked.swing.value, asked.swing.span) {
        (Auto::Given(swing), Some(span)) => {
            let standoff = show((drop * swing.sin()).to_mm());
            diagnostic
                .and(span, "the narrower the V, the higher its tip stays")
                .note(format!(
                    "at a swing of {} deg, the blade's standoff of {standoff} mm {above}",
                    show(swing.to_deg())
                ))
        }
        (Auto::Given(_) | Auto::Auto, _) => diagnostic.note(format!("the blade's standoff {above}")),
    }
}

/// Wider swings than a given one, at which the standoff raises the tip by less than what the limit leaves room for.
fn wider_swings(asked: &RoughVcut, drop: Length, room: Length) -> Ladder {
    let (Auto::Given(swing), Some(span)) = (asked.swing.value, asked.swing.span) else {
        return Vec::new();
    };
    let sine = (drop * swing.sin()) / room;
    if room <= Length::ZERO || !(0.0..1.0).contains(&sine) {
        return Vec::new();
    }
    let least = libm::asin(sine).to_degrees();
    let most = asked
        .limits
        .swing
        .most
        .map_or(WIDEST_OFFERED, |limit| limit.value.to_deg());
    WIDER_SWINGS
        .into_iter()
        .map(|times| (least * times).ceil())
        .filter(|&degrees| degrees > swing.to_deg() && degrees <= most.min(WIDEST_OFFERED))
        .map(|degrees| {
            let mut changed = asked.clone();
            changed.swing.value = Auto::Given(Angle::deg(degrees));
            let text = format!("{} deg", show(degrees));
            Offer {
                title: format!("use a `swing` of {text}"),
                edits: vec![(span, text)],
                changed,
            }
        })
        .collect()
}

/// By what the least swing that leaves any room is multiplied: such a one alone would leave room for layers of nothing.
const WIDER_SWINGS: [f64; 5] = [1.25, 1.5, 2.0, 3.0, 5.0];

/// Blades swung farther than this hardly cut a V, in deg.
const WIDEST_OFFERED: f64 = 80.0;

/// An objective that grows less and less with the layer, without anything that keeps the layer from vanishing. Longest times
/// hold it; planning decides which of these can be kept.
pub(super) fn nothing_holds_the_layer(asked: &RoughVcut, times: &[Duration]) -> Refused {
    let what = match asked.objective.value {
        Objective::Scallop => "the scallop",
        Objective::BladeLoad => "the length of edge in use",
        Objective::Time => "the time",
        Objective::Cuts => "the number of cuts",
    };
    let objective = asked.objective.span.unwrap_or(asked.setup.head_span);
    let diagnostic = Diagnostic::new(
        Code::NoLeastLayer,
        format!("the thinner the layer, the less {what}: nothing here bounds the layer"),
        objective,
        "needs a limit that bounds the layer",
    )
    .help("limit `time` or `cuts` from above, or `layer` or `step` from below");
    let end = |span: Span| Span {
        start: span.end,
        ..span
    };
    let offer = |&time: &Duration| {
        let limit = format!("time <= {} s", show(time.to_s()));
        let mut changed = asked.clone();
        changed.limits.time = Some(Sourced {
            value: time,
            span: None,
        });
        let (span, text) = match last_limit(asked) {
            Some(last) => (end(last), format!(", {limit}")),
            None => (end(objective), format!(" limits {{ {limit} }}")),
        };
        Offer {
            title: format!("add `{limit}`"),
            edits: vec![(span, text)],
            changed,
        }
    };
    Refused {
        diagnostic,
        ladders: vec![times.iter().map(offer).collect()],
        resort: Offer::openings(asked),
        otherwise: None,
    }
}

/// Where the last of the limits stands.
fn last_limit(asked: &RoughVcut) -> Option<Span> {
    let limits = &asked.limits;
    [
        limits.swing.least.and_then(|limit| limit.span),
        limits.swing.most.and_then(|limit| limit.span),
        limits.layer.most.and_then(|limit| limit.span),
        limits.step.most.and_then(|limit| limit.span),
        limits.scallop.and_then(|limit| limit.span),
        limits.edge.and_then(|limit| limit.span),
    ]
    .into_iter()
    .flatten()
    .max_by_key(|span| span.end)
}
