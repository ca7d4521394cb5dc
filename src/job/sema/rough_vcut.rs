//! `rough vcut { ... }`: V-shaped roughing.

use super::eval::Scope;
use super::fields::{BlockSpec, Fields, Inner, Place, Takes, block, head_span, points, value};
use super::limits;
use super::names::Thing;
use super::range::{DISTANCE, OVERLAP, RAKE, SIZE, SPEED, SWING, TURNING_RATE};
use super::read::{Reader, default, looks_like, words_of};
use super::report::Checked;
use super::session::Session;
use super::tips;
use crate::{Blade, Direction, Formulas, Lattice, Objective, Order, Residual, RoughVcut, Sequence, Sourced};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{AngularSpeed, Length, Speed};
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Block, Expr};

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`rough vcut`",
    fields: &[
        value("blade", "dagger").required().takes(Takes::Blade),
        points("tips", "(10 mm, 40 mm) (16 mm, 40 mm)"),
        value("lattice", "auto")
            .takes(Takes::Words(|| words_of(Lattice::WORDS)))
            .or_auto(),
        value("rake", "60 deg").required().within(RAKE),
        value("swing", "auto").within(SWING).or_auto(),
        value("layer", "auto").within(SIZE).or_auto(),
        value("step", "auto").within(SIZE).or_auto(),
        value("overlap", "auto").within(OVERLAP).or_auto(),
        value("objective", "time").takes(Takes::Words(|| words_of(Objective::WORDS))),
        value("model", "exact").takes(Takes::Words(|| words_of(Formulas::WORDS))),
        block("limits", "{ swing <= 50 deg, scallop <= 10 mm }").takes(Takes::Fields(&limits::LIMITS)),
        value("allowance", "0.5 mm").within(DISTANCE),
        value("residual", "auto")
            .takes(Takes::Words(|| words_of(Residual::WORDS)))
            .or_auto(),
        value("order", "auto")
            .takes(Takes::Words(|| words_of(Order::WORDS)))
            .or_auto(),
        value("sequence", "auto")
            .takes(Takes::Words(|| words_of(Sequence::WORDS)))
            .or_auto(),
        value("direction", "alternate").takes(Takes::Words(|| words_of(Direction::WORDS))),
        block(
            "feed",
            "{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }",
        )
        .required()
        .takes(Takes::Fields(&FEED)),
        value("clearance", "10 mm").required().within(SIZE),
        value("extension", "auto").within(DISTANCE).or_auto(),
        value("run_out", "2 mm").within(DISTANCE),
        value("standoff", "auto").within(DISTANCE).or_auto(),
    ],
    inner: Inner::Refused,
};

const FEED: BlockSpec = BlockSpec {
    title: "`feed`",
    fields: &[
        value("cut", "200 mm/s").required().within(SPEED),
        value("travel", "200 mm/s").required().within(SPEED),
        value("reorient", "90 deg/s").required().within(TURNING_RATE),
    ],
    inner: Inner::Refused,
};

/// Air between the blade and the stock where it turns, when the job does not say: a usual value for the errors of stock and
/// robot together, from no source.
const RUN_OUT: Length = Length::mm(2.0);

/// The operation.
pub(crate) fn check(
    operation: &Block,
    place: Place,
    scope: Scope<'_>,
    blades: &[Checked<Blade>],
    stock: Option<Spanned<Stock>>,
    session: &mut Session<'_>,
) -> Checked<RoughVcut> {
    let fields = Fields::sort(&SPEC, place, &operation.entries, session);
    let given = tips::check(&fields, stock, scope, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = fields
        .block("limits")
        .and_then(|inner| limits::check(inner, scope, session));
    let feeds = fields
        .required_block("feed", &mut session.reports)
        .and_then(|inner| feeds(inner, scope, session));
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let blade = fields
        .required_value("blade", reader.reports)
        .and_then(|expr| find_blade(expr, blades, &mut reader));
    let lattice = reader.auto_choice(&fields, "lattice", Lattice::WORDS);
    let rake = reader.required(&fields, "rake", RAKE);
    let swing = reader.auto(&fields, "swing", SWING);
    let layer = reader.auto(&fields, "layer", SIZE);
    let step = reader.auto(&fields, "step", SIZE);
    let overlap = reader.auto(&fields, "overlap", OVERLAP);
    let objective = reader.choice(&fields, "objective", Objective::WORDS);
    let formulas = reader.choice(&fields, "model", Formulas::WORDS);
    let allowance = reader.defaulted(&fields, "allowance", DISTANCE, Length::ZERO);
    let residual = reader.auto_choice(&fields, "residual", Residual::WORDS);
    let order = reader.auto_choice(&fields, "order", Order::WORDS);
    let sequence = reader.auto_choice(&fields, "sequence", Sequence::WORDS);
    let direction = reader.choice(&fields, "direction", Direction::WORDS);
    let clearance = reader.required(&fields, "clearance", SIZE);
    let extension = reader.auto(&fields, "extension", DISTANCE);
    let run_out = reader.defaulted(&fields, "run_out", DISTANCE, RUN_OUT);
    let standoff = reader.auto(&fields, "standoff", DISTANCE);
    let feeds = feeds?;
    let operation = RoughVcut {
        head_span: place.head,
        tips: None,
        blade: blade?,
        lattice: lattice?,
        rake: rake?,
        swing: swing?,
        layer: layer?,
        step: step?,
        overlap: overlap?,
        objective: objective?.unwrap_or(default(Objective::Time)),
        formulas: formulas?.unwrap_or(default(Formulas::Exact)),
        limits: limits?,
        allowance: allowance?,
        residual: residual?,
        order: order?,
        sequence: sequence?,
        direction: direction?.unwrap_or(default(Direction::Alternate)),
        cut_feed: feeds.cut,
        travel_feed: feeds.travel,
        reorient_rate: feeds.reorient,
        clearance: clearance?,
        extension: extension?,
        run_out: run_out?,
        standoff: standoff?,
    };
    match given? {
        Some(given) => tips::over(given, operation, &fields, &mut session.reports),
        None => Ok(operation),
    }
}

/// The place of a block within the operation.
pub(super) fn inner_place(inner: &Block) -> Place {
    Place {
        head: head_span(inner),
        whole: inner.span,
    }
}

/// Speeds of the operation.
struct Feeds {
    cut: Sourced<Speed>,
    travel: Sourced<Speed>,
    reorient: Sourced<AngularSpeed>,
}

fn feeds(inner: &Block, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Feeds> {
    let fields = Fields::sort(&FEED, inner_place(inner), &inner.entries, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let cut = reader.required(&fields, "cut", SPEED);
    let travel = reader.required(&fields, "travel", SPEED);
    let reorient = reader.required(&fields, "reorient", TURNING_RATE);
    Ok(Feeds {
        cut: cut?,
        travel: travel?,
        reorient: reorient?,
    })
}

/// The blade that the operation names.
fn find_blade(expr: &Spanned<Expr>, blades: &[Checked<Blade>], reader: &mut Reader<'_>) -> Checked<Blade> {
    let names = reader.scope.names;
    let is_blade = |thing| matches!(thing, Thing::Blade(_));
    let Expr::Name(name) = &expr.node else {
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            format!(
                "`blade` takes the name of a blade, not {}",
                looks_like(&expr.node)
            ),
            expr.span,
            "expected the name of a blade here",
        );
        let diagnostic = match names.list(is_blade) {
            Some(list) => diagnostic.help(format!("the blades defined are {list}")),
            None => diagnostic.help("define one with `blade dagger { ... }` and write `blade = dagger`"),
        };
        return Err(reader.reports.push(diagnostic));
    };
    let blade = match names.get(name).map(|definition| definition.thing) {
        Some(Thing::Blade(index)) => blades.get(index),
        Some(Thing::Let(_) | Thing::Machine(_)) | None => None,
    };
    match blade {
        Some(blade) => blade.clone(),
        None => Err(names.not_a("blade", name, expr.span, is_blade, reader.reports)),
    }
}
