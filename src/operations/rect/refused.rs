//! Why there is no plan, in the user's words.

use crate::asked::RoughRect;
use crate::plan::LEAST_LAYER;
use crate::plan::blades::WidthBound;
use crate::plan::refusal::{Closed, Exceeded, Over, Refusal, SizeField};
use crate::words;
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::grid;
use vcutc_job::{Auto, Sourced};

/// A refusal as it is reported.
pub(crate) fn diagnostic(asked: &RoughRect, refusal: &Refusal) -> Diagnostic {
    match refusal {
        Refusal::Nothing => nothing(asked),
        Refusal::NoEdge { rake, half_apex } => no_edge(asked, *rake, *half_apex),
        Refusal::TooMany { strips } => Diagnostic::new(
            Code::TooManyCuts,
            format!("about {strips:.0} strips are too many to plan"),
            place(asked, asked.step.span.or(asked.layer.span)),
            "of strips so small",
        )
        .help("use larger layers or steps"),
        Refusal::TooWide { widest, limit, bound } => too_wide(asked, *widest, *limit, *bound),
        Refusal::TooDeepForSlits {
            layer,
            through,
            needed,
            edge,
            most,
        } => too_deep(asked, (*layer, *through), (*needed, *edge), *most),
        Refusal::TooHighForSlit {
            x,
            bottom,
            top,
            needed,
            edge,
        } => too_high(asked, *x, [*bottom, *top], [*needed, *edge]),
        Refusal::TooThick { layer, chip, depth } => too_thick(asked, *layer, *chip, *depth),
        Refusal::SlitInPart { x, bottom, entry } => slit_in_part(asked, *x, *bottom, *entry),
        Refusal::Closed(closed) => self::closed(asked, closed),
        Refusal::NoColumns { through } => no_columns(asked, *through),
        Refusal::Scallop {
            left,
            limit,
            left_out,
            works,
        } => {
            let diagnostic = scallop(asked, *left, *limit, *works);
            match words::left_out(asked, *left_out) {
                Some(note) => diagnostic.note(note),
                None => diagnostic,
            }
        }
        Refusal::Over(limit) => over(asked, *limit),
        Refusal::Bounds { field, least, most } => bounds(asked, *field, *least, *most),
    }
}

fn no_edge(asked: &RoughRect, rake: Angle, half_apex: Angle) -> Diagnostic {
    Diagnostic::new(
            Code::RakeTooFlat,
            format!(
                "the edge of `{}` does not lead into the material: half its apex angle is {} deg, the rake is {} deg",
                asked.blade.name,
                show(half_apex.to_deg()),
                show(rake.to_deg())
            ),
            place(asked, asked.setup.rake.span),
            "this rake",
        )
        .help("use a rake that is larger than half the apex angle")
}

fn too_high(
    asked: &RoughRect,
    x: Length,
    [bottom, top]: [Length; 2],
    [needed, edge]: [Length; 2],
) -> Diagnostic {
    Diagnostic::new(
        Code::BladesTooSmall,
        format!(
            "a slit at x {} mm from z {} mm down to {} mm needs {} mm of edge, `{}` has {} mm",
            mm(x),
            mm(top),
            mm(bottom),
            mm(needed),
            asked.blade.name,
            mm(edge)
        ),
        place(asked, asked.blade.cutting_length.span),
        "the edge of the straight blade",
    )
    .help("use a longer blade")
}

fn slit_in_part(asked: &RoughRect, x: Length, bottom: Length, entry: Length) -> Diagnostic {
    Diagnostic::new(
        Code::Overcut,
        format!(
            "a slit at x {} mm down to z {} mm would enter the part or its allowance by {} mm",
            mm(x),
            mm(bottom),
            mm(entry)
        ),
        asked.setup.head_span,
        "a slit of this operation",
    )
    .help("use a thinner blade, or a smaller `standoff`")
}

fn no_columns(asked: &RoughRect, through: u32) -> Diagnostic {
    Diagnostic::new(
            Code::LimitsConflict,
            format!("slits through {through} layers need columns that stay where they are, and `residual = shift` has none"),
            place(asked, asked.through.span),
            "through several layers",
        )
        .and(place(asked, asked.residual.span), "strips in other places in each layer")
        .help("use `through = 1`, or another `residual`")
}

fn bounds(asked: &RoughRect, field: SizeField, least: Length, most: Length) -> Diagnostic {
    let (name, bounds) = match field {
        SizeField::Layer => ("layer", asked.limits.layer),
        SizeField::Step => ("step", asked.limits.step),
    };
    Diagnostic::new(
        Code::LimitsConflict,
        format!(
            "`{name}` is at least {} mm, and the blades do at most {} mm",
            mm(least),
            mm(most)
        ),
        limit_place(asked, bounds.least),
        "this bound",
    )
    .help(format!("take a bound of at most {} mm", down(most)))
}

fn nothing(asked: &RoughRect) -> Diagnostic {
    Diagnostic::new(
        Code::NothingToCut,
        "`rough rect` has nothing to cut: no strip is worth a pass above the part, its allowance and `down_to`",
        asked.setup.head_span,
        "this operation",
    )
    .help("check the heights of stock and part, `allowance` and `down_to`; if operations before have taken it all, leave this one out")
}

fn too_wide(asked: &RoughRect, widest: Length, limit: Length, bound: WidthBound) -> Diagnostic {
    let because = match bound {
        WidthBound::Disc => ("the widest strip that it takes", asked.disc.width.span),
        WidthBound::Body { stage } => {
            let stage = asked.disc.body.stages.get(stage);
            let span = stage.and_then(|stage| stage.radius.span);
            ("this stage of its body needs the room", span)
        }
    };
    let (label, span) = because;
    if limit <= Length::ZERO {
        return Diagnostic::new(
            Code::BladesTooSmall,
            format!(
                "`{}` frees no strip: {} mm of its radius are beyond the slit, and the rest is its body with 1 mm of air",
                asked.disc.name,
                mm(asked.beyond.value)
            ),
            place(asked, asked.beyond.span),
            "this operation",
        )
        .and(span.unwrap_or(asked.disc.body.span), label)
        .help("use a smaller `beyond`, or a disc with a thinner shank");
    }
    let diagnostic = Diagnostic::new(
        Code::BladesTooSmall,
        format!(
            "strips of {} mm are wider than `{}` frees: {} mm",
            mm(widest),
            asked.disc.name,
            mm(limit)
        ),
        place(asked, asked.step.span),
        "these strips",
    )
    .and(span.unwrap_or(asked.disc.body.span), label);
    match asked.step.value {
        Auto::Given(_) if limit > Length::ZERO => {
            diagnostic.help(format!("use a step of at most {} mm", mm(limit)))
        }
        Auto::Given(_) | Auto::Auto => diagnostic.help("use a larger disc, or one with a thinner shank"),
    }
}

fn too_thick(asked: &RoughRect, layer: Length, chip: Length, depth: Length) -> Diagnostic {
    let most = depth - (chip - layer);
    let takes = "the thickest chip that it takes";
    if most < LEAST_LAYER {
        let room = (depth - LEAST_LAYER).to_mm() / asked.disc.radius.value.to_mm();
        let steepest = Angle::rad(libm::asin(room.clamp(0.0, 1.0)));
        let steepest = Angle::deg((steepest.to_deg() * 1e3).floor() / 1e3);
        let advice = if room > 0.0 {
            format!(
                "use a lead of at most {} deg: the smaller it is, the thicker layers can be",
                show(steepest.to_deg())
            )
        } else {
            "use a disc that takes thicker chips".to_owned()
        };
        return Diagnostic::new(
            Code::BladesTooSmall,
            format!(
                "a lead of {} deg alone makes chips of {} mm, `{}` takes {} mm",
                show(asked.lead.value.to_deg()),
                mm(chip - layer),
                asked.disc.name,
                mm(depth)
            ),
            place(asked, asked.lead.span),
            "this lead",
        )
        .and(place(asked, asked.disc.depth.span), takes)
        .help(advice);
    }
    Diagnostic::new(
        Code::BladesTooSmall,
        format!(
            "layers of {} mm make chips of {} mm with this lead, `{}` takes {} mm",
            mm(layer),
            mm(chip),
            asked.disc.name,
            mm(depth)
        ),
        place(asked, asked.layer.span),
        "these layers",
    )
    .and(place(asked, asked.disc.depth.span), takes)
    .help(format!(
        "use layers of at most {} mm, or `layer = auto`",
        down(most)
    ))
}

/// The least that was planned, and what of it no layer and no step changes.
fn scallop(asked: &RoughRect, left: Length, limit: Length, works: Option<Length>) -> Diagnostic {
    let advice = match (asked.layer.value, asked.step.value, works.map(up)) {
        (Auto::Given(_), Auto::Given(_), Some(works)) => {
            format!("use smaller layers and steps, or a limit of {works} mm, which a plan keeps")
        }
        (_, _, Some(works)) => format!(
            "use a limit of {works} mm, which a plan keeps: the least of the layers and steps that were tried"
        ),
        (_, _, None) => "use smaller layers and steps, or allow more to stay".to_owned(),
    };
    let sink = asked.disc.radius.value * asked.lead.value.sin();
    let diagnostic = Diagnostic::new(
        Code::ScallopOverLimit,
        format!(
            "{} mm would stay on the part, the limit is {} mm",
            mm(left),
            mm(limit)
        ),
        limit_place(asked, asked.limits.scallop),
        "this limit",
    );
    let allowance = (asked.allowance.value > Length::ZERO)
        .then(|| format!("the allowance of {} mm", mm(asked.allowance.value)));
    let rise = (sink > Length::ZERO).then(|| {
        format!(
            "up to {} mm where the edge of the disc rises towards its rim, by its lead",
            mm(sink)
        )
    });
    let diagnostic = match (allowance, rise) {
        (Some(allowance), Some(rise)) => diagnostic.note(format!("of this: {allowance}, and {rise}")),
        (Some(one), None) | (None, Some(one)) => diagnostic.note(format!("of this: {one}")),
        (None, None) => diagnostic,
    };
    let diagnostic = if asked.down_to.value > Length::ZERO {
        diagnostic.note("what `down_to` leaves counts too: a job that cuts it otherwise needs no limit here")
    } else {
        diagnostic
    };
    diagnostic.help(advice)
}

fn too_deep(
    asked: &RoughRect,
    (layer, through): (Length, u32),
    (needed, edge): (Length, Length),
    most: Length,
) -> Diagnostic {
    let layers = match through {
        1 => format!("layers of {} mm", mm(layer)),
        _ => format!("slits through {through} layers of {} mm", mm(layer)),
    };
    Diagnostic::new(
        Code::BladesTooSmall,
        format!(
            "{layers} need {} mm of edge, `{}` has {} mm",
            mm(needed),
            asked.blade.name,
            mm(edge)
        ),
        place(asked, asked.layer.span.or(asked.through.span)),
        "slits so deep",
    )
    .and(
        place(asked, asked.blade.cutting_length.span),
        "the edge of the straight blade",
    )
    .help(format!(
        "use layers of at most {} mm, or `layer = auto`",
        down(most)
    ))
}

fn closed(asked: &RoughRect, closed: &Closed) -> Diagnostic {
    let below = match closed.strips {
        1 => "1 strip stays".to_owned(),
        strips => format!("{strips} strips stay"),
    };
    let diagnostic = Diagnostic::new(
        Code::NoAccess,
        format!(
            "layer {} is closed at x {} mm and x {} mm: `{}` cannot reach any strip between them; {below}",
            closed.layer,
            mm(closed.left),
            mm(closed.right),
            asked.disc.name
        ),
        asked.setup.head_span,
        "this operation needs an open side in every layer",
    )
    .note("a disc comes from the side: beside the first strip there has to be room for its shank");
    let Some(height) = closed.down_to else {
        return diagnostic.help("rough this part with `rough vcut`");
    };
    let text = format!("{} mm", mm(height));
    let advice = format!("stop above the valley with `down_to = {text}`, and cut the rest with `rough vcut`");
    diagnostic.fix_all(advice, &asked.setup.stated("down_to", asked.down_to.span, &text))
}

/// A limit on the whole that no plan keeps, and one that a plan keeps.
fn over(asked: &RoughRect, over: Over) -> Diagnostic {
    let limits = &asked.limits;
    let (message, span, works) = match over {
        Over::Changes(Exceeded { found, limit, works }) => (
            format!("the plan has {found} changes of blade, the limit is {limit}"),
            limits.changes.and_then(|limit| limit.span),
            works.map(|works| (works.to_string(), works.to_string())),
        ),
        Over::Cuts(Exceeded { found, limit, works }) => (
            format!("the plan has {found} slits and strips, the limit is {limit}"),
            limits.cuts.and_then(|limit| limit.span),
            works.map(|works| (works.to_string(), works.to_string())),
        ),
        Over::Time(Exceeded { found, limit, works }) => (
            format!(
                "the plan takes {}, the limit is {}",
                duration_words(found),
                duration_words(limit)
            ),
            limits.time.and_then(|limit| limit.span),
            works.map(time_limit),
        ),
    };
    let diagnostic = Diagnostic::new(Code::LimitsConflict, message, place(asked, span), "this limit").and(
        asked.setup.head_span,
        "no plan of this operation that was tried keeps it",
    );
    match (span, works) {
        (Some(span), Some((written, said))) => {
            let advice = format!("use a limit of {said}, which a plan keeps");
            diagnostic.fix(advice, span, written)
        }
        (Some(_), None) => diagnostic.help("take it out to see what else is in the way"),
        (None, _) => diagnostic,
    }
}

/// A limit on time, rounded up to what people like to write, and how a message says it: as it states other times, too.
fn time_limit(time: Duration) -> (String, String) {
    let seconds = (time.to_s() * 10.0).ceil() / 10.0;
    let written = format!("{} s", show(seconds));
    let stated = duration_words(Duration::s(seconds));
    let said = if stated == written {
        written.clone()
    } else {
        format!("{written} ({stated})")
    };
    (written, said)
}

fn limit_place<T>(asked: &RoughRect, limit: Option<Sourced<T>>) -> Span {
    place(asked, limit.and_then(|limit| limit.span))
}

fn place(asked: &RoughRect, span: Option<Span>) -> Span {
    span.unwrap_or(asked.setup.head_span)
}

/// On the grid of what is offered, and no more.
fn down(length: Length) -> String {
    show(grid::down(length.to_mm()))
}

/// The same, and no less.
fn up(length: Length) -> String {
    show(grid::up(length.to_mm()))
}

fn mm(length: Length) -> String {
    show(length.to_mm())
}
