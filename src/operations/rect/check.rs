//! `rough rect { ... }`: rectangular roughing.

use crate::asked::{Limits, Residual, RoughRect};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::Operation;
use vcutc_job::sema::both::both;
use vcutc_job::sema::dimension::Dimension;
use vcutc_job::sema::eval::Scope;
use vcutc_job::sema::field_ranges::{DISTANCE, LONGEST_TIME, MOST_CUTS, Range, SIZE};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, bounds, limit, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, default, words_of};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::{self, inner_place};
use vcutc_job::sema::written::Written;
use vcutc_job::{Auto, Bounds, Disc, Sourced, StraightBlade};
use vcutc_process::standoff;
use vcutc_syntax::ast::{Block, Expr};

/// How far the disc leans where the job does not say it: the usual angle of [Yu 2019] is 3 to 5 degrees.
const LEAD: Angle = Angle::deg(3.0);

/// How far its rim runs beyond a slit where the job does not say it: a judgement, so that a slit that is a little off is
/// still met.
const BEYOND: Length = Length::mm(0.5);

/// A disc that leans so far that it stands upright frees nothing.
const LEADS: Range = Range::new(
    Dimension::ANGLE,
    core::ops::Bound::Included(0.0),
    core::ops::Bound::Excluded(90.0),
);

/// Layers that a slit may go through.
const THROUGH: Range = Range::closed(Dimension::PURE, 1.0, 1000.0);

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`rough rect`",
    fields: &[
        setup::BLADE,
        value("disc", "wheel").required().takes(Takes::Blade("disc")),
        setup::RAKE_FIELD,
        value("lead", "3 deg").within(LEADS),
        value("layer", "auto").within(SIZE).or_auto(),
        value("step", "auto").within(SIZE).or_auto(),
        value("through", "auto").within(THROUGH).or_auto(),
        value("residual", "auto")
            .takes(Takes::Words(|| words_of(Residual::WORDS)))
            .or_auto(),
        block("limits", "{ scallop <= 10 mm, changes <= 20 }").takes(Takes::Fields(&LIMITS)),
        value("allowance", "0.5 mm").within(DISTANCE),
        value("down_to", "20 mm").within(DISTANCE),
        value("beyond", "0.5 mm").within(DISTANCE),
        setup::FEED_OF_TWO,
        setup::CLEARANCE,
        setup::RUN_OUT_FIELD,
        value("standoff", "auto").within(DISTANCE).or_auto(),
    ],
    inner: Inner::Refused,
};

const LIMITS: BlockSpec = BlockSpec {
    title: "`limits`",
    fields: &[
        bounds("layer", "6 mm").within(SIZE),
        bounds("step", "8 mm").within(SIZE),
        limit("scallop", "10 mm").within(SIZE),
        limit("changes", "20").within(MOST_CUTS),
        limit("time", "10 min").within(LONGEST_TIME),
        limit("cuts", "200").within(MOST_CUTS),
    ],
    inner: Inner::Refused,
};

/// `rough rect`.
#[derive(Clone, Copy, Debug)]
pub struct Rect;

impl Kind for Rect {
    fn head(&self) -> &'static str {
        "rough rect"
    }

    fn mistaken_for(&self) -> &'static [&'static str] {
        &["rectangular", "rectangle", "rects"]
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        let operation = check(written, session)?;
        Ok(Box::new(operation))
    }
}

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<RoughRect> {
    let Written {
        block, place, scope, ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = fields
        .block("limits")
        .and_then(|inner| limits(inner, scope, session));
    let setup = setup::check_of_two(&fields, written, session);
    let blade: Checked<StraightBlade> = setup::blade("blade", &fields, written, session);
    let disc: Checked<Disc> = setup::blade("disc", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let lead = reader.defaulted(&fields, "lead", LEAD);
    let layer = reader.auto(&fields, "layer");
    let step = reader.auto(&fields, "step");
    let through = through(&fields, &mut reader);
    let residual = reader.auto_choice(&fields, "residual", Residual::WORDS);
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let down_to = reader.defaulted(&fields, "down_to", Length::ZERO);
    let beyond = reader.defaulted(&fields, "beyond", BEYOND);
    let standoff = reader.auto(&fields, "standoff");
    let (setup, free_feed) = setup?;
    let (disc, beyond) = (disc?, beyond?);
    if beyond.value >= disc.radius.value {
        return Err(reader.reports.push(beyond_the_disc(beyond, &disc, written)));
    }
    let (blade, standoff, limits) = (blade?, standoff?, limits?);
    let (layer, step) = (layer?, step?);
    let wrong = [
        too_near(&blade, standoff, written),
        outside("layer", layer, &limits.layer),
        outside("step", step, &limits.step),
    ];
    let mut reported = None;
    for diagnostic in wrong.into_iter().flatten() {
        reported = Some(reader.reports.push(diagnostic));
    }
    if let Some(reported) = reported {
        return Err(reported);
    }
    Ok(RoughRect {
        setup,
        blade,
        disc,
        lead: lead?,
        free_feed,
        layer,
        step,
        through: through?,
        residual: residual?,
        beyond,
        down_to: down_to?,
        allowance: allowance?,
        standoff,
        limits,
    })
}

/// A standoff with which the sides of the straight blade would enter what stays.
fn too_near(blade: &StraightBlade, given: Sourced<Auto<Length>>, written: Written<'_>) -> Option<Diagnostic> {
    let Auto::Given(standoff) = given.value else {
        return None;
    };
    let span = given.span.unwrap_or(written.place.head);
    (standoff < standoff::least(blade)).then(|| standoff::too_small(blade, standoff, span))
}

/// A size that is given, and its limits do not allow.
fn outside(name: &str, given: Sourced<Auto<Length>>, bounds: &Bounds<Length>) -> Option<Diagnostic> {
    let (Auto::Given(size), Some(span)) = (given.value, given.span) else {
        return None;
    };
    let least = bounds.least.filter(|least| size < least.value);
    let most = bounds.most.filter(|most| size > most.value);
    let (limit, side, label, verb) = match (least, most) {
        (Some(least), _) => (least, "below", "smaller than the limit allows", "lower"),
        (None, Some(most)) => (most, "above", "larger than the limit allows", "raise"),
        (None, None) => return None,
    };
    let size = show(size.to_mm());
    let text = format!("{} mm", show(limit.value.to_mm()));
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!("a {name} of {size} mm is {side} its limit of {text}"),
        span,
        label,
    );
    let diagnostic = match limit.span {
        Some(limit) => diagnostic.and(limit, "the limit"),
        None => diagnostic,
    };
    Some(diagnostic.help(format!("use {text}, or {verb} the limit")).fix(
        format!("use the limit: `{text}`"),
        span,
        text,
    ))
}

/// `through = 2` or `through = auto`.
fn through(fields: &Fields<'_>, reader: &mut Reader<'_>) -> Checked<Sourced<Auto<u32>>> {
    let Some(expr) = fields.value("through")? else {
        return Ok(default(Auto::Auto));
    };
    let value = if is_auto(expr) {
        Auto::Auto
    } else {
        Auto::Given(reader.whole(expr, THROUGH, "`through`")?)
    };
    Ok(Sourced {
        value,
        span: Some(expr.span),
    })
}

fn is_auto(expr: &Spanned<Expr>) -> bool {
    matches!(&expr.node, Expr::Name(name) if name == "auto")
}

fn limits(inner: Option<&Block>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Limits> {
    let Some(inner) = inner else {
        return Ok(Limits::default());
    };
    let fields = Fields::sort(&LIMITS, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let layer = both(&fields, "layer", &mut reader);
    let step = both(&fields, "step", &mut reader);
    let scallop = reader.optional(&fields, "scallop");
    let changes = reader.optional(&fields, "changes");
    let cuts = reader.optional(&fields, "cuts");
    let time = reader.optional(&fields, "time");
    Ok(Limits {
        layer: layer?,
        step: step?,
        scallop: scallop?,
        changes: changes?,
        cuts: cuts?,
        time: time?,
    })
}

fn beyond_the_disc(beyond: Sourced<Length>, disc: &Disc, written: Written<'_>) -> Diagnostic {
    let radius = show(disc.radius.value.to_mm());
    Diagnostic::new(
        Code::OutOfRange,
        format!(
            "`beyond` is {} mm, the disc has a radius of {radius} mm",
            show(beyond.value.to_mm())
        ),
        beyond.span.unwrap_or(written.place.head),
        "its rim would run past the open side of the strip",
    )
    .and(disc.radius.span.unwrap_or(disc.span), "the radius of the edge")
    .help("use less, such as `beyond = 0.5 mm`")
}
