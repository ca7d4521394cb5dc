//! `rough vcut { ... }`: V-shaped roughing.

mod fitted;
mod follow;
mod limits_block;
#[cfg(test)]
mod tests;
mod tips;

pub(crate) use follow::NARROWEST_ALONG;

use crate::asked::{
    Avoid, Compensate, Formulas, Lattice, Objective, Redundant, Residual, RoughVcut, Sequence,
};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::Diagnostic;
use vcutc_job::Order;
use vcutc_job::follow::{Family, Follow};
use vcutc_job::operation::Operation;
use vcutc_job::sema::field_ranges::{DISTANCE, OVERLAP, SIZE, SWING};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Takes, block, points, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::read::{Reader, default, words_of};
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup;
use vcutc_job::sema::written::Written;

/// Its fields.
pub const SPEC: BlockSpec = BlockSpec {
    title: "`rough vcut`",
    fields: &[
        setup::BLADE,
        points("tips", "(10 mm, 40 mm) (16 mm, 40 mm)"),
        value("lattice", "auto")
            .takes(Takes::Words(|| words_of(Lattice::WORDS)))
            .or_auto(),
        setup::RAKE_FIELD,
        value("swing", "auto").within(SWING).or_auto(),
        value("layer", "auto").within(SIZE).or_auto(),
        value("step", "auto").within(SIZE).or_auto(),
        value("overlap", "auto").within(OVERLAP).or_auto(),
        value("objective", "time").takes(Takes::Words(|| words_of(Objective::WORDS))),
        value("model", "exact").takes(Takes::Words(|| words_of(Formulas::WORDS))),
        block("limits", "{ swing <= 50 deg, scallop <= 10 mm }").takes(Takes::Fields(&limits_block::LIMITS)),
        value("allowance", "0.5 mm").within(DISTANCE),
        value("residual", "auto")
            .takes(Takes::Words(|| words_of(Residual::WORDS)))
            .or_auto(),
        value("redundant", "auto")
            .takes(Takes::Words(|| words_of(Redundant::WORDS)))
            .or_auto(),
        value("avoid", "lift").takes(Takes::Words(|| words_of(Avoid::WORDS))),
        value("order", "auto")
            .takes(Takes::Words(|| words_of(Order::WORDS)))
            .or_auto(),
        value("sequence", "auto")
            .takes(Takes::Words(|| words_of(Sequence::WORDS)))
            .or_auto(),
        setup::DIRECTION,
        setup::FEED,
        setup::CLEARANCE,
        setup::EXTENSION,
        setup::RUN_OUT_FIELD,
        value("standoff", "auto").within(DISTANCE).or_auto(),
        value("follow", "spine").takes(Takes::Words(|| words_of(Follow::WORDS))),
        value("compensate", "forces").takes(Takes::Words(|| words_of(Compensate::WORDS))),
    ],
    inner: Inner::Refused,
};

/// `rough vcut`.
#[derive(Clone, Copy, Debug)]
pub struct Vcut;

impl Kind for Vcut {
    fn head(&self) -> &'static str {
        "rough vcut"
    }

    fn mistaken_for(&self) -> &'static [&'static str] {
        &["roughing", "vcuts", "v_cut"]
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn example(&self, blade: &str) -> String {
        format!(
            "rough vcut {{\n  blade = {blade}\n  lattice = orthogonal\n  rake = 60 deg\n  \
             feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  clearance = 10 mm\n}}"
        )
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        let operation = check(written, session)?;
        Ok(Box::new(operation))
    }
}

/// What an operation asks for that does not go with how its cuts follow the part.
pub(crate) fn beside_level(operation: &RoughVcut) -> Option<Diagnostic> {
    follow::misfit(operation).or_else(|| fitted::beside_fitted(operation))
}

fn check(written: Written<'_>, session: &mut Session<'_>) -> Checked<RoughVcut> {
    let Written {
        block,
        place,
        scope,
        stock,
        ..
    } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let given = tips::check(&fields, stock, scope, session);
    // Blocks within first: they need the session, of which the reader holds a part.
    let limits = fields
        .block("limits")
        .and_then(|inner| limits_block::check(inner, scope, session));
    let setup = setup::check(&fields, written, session);
    let blade = setup::blade("blade", &fields, written, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let lattice = reader.auto_choice(&fields, "lattice", Lattice::WORDS);
    let swing = reader.auto(&fields, "swing");
    let layer = reader.auto(&fields, "layer");
    let step = reader.auto(&fields, "step");
    let overlap = reader.auto(&fields, "overlap");
    let objective = reader.choice(&fields, "objective", Objective::WORDS);
    let formulas = reader.choice(&fields, "model", Formulas::WORDS);
    let allowance = reader.defaulted(&fields, "allowance", Length::ZERO);
    let residual = reader.auto_choice(&fields, "residual", Residual::WORDS);
    let redundant = reader.auto_choice(&fields, "redundant", Redundant::WORDS);
    let avoid = reader.choice(&fields, "avoid", Avoid::WORDS);
    let order = reader.auto_choice(&fields, "order", Order::WORDS);
    let sequence = reader.auto_choice(&fields, "sequence", Sequence::WORDS);
    let standoff = reader.auto(&fields, "standoff");
    let follow = reader.choice(&fields, "follow", Follow::WORDS);
    let compensate = reader.choice(&fields, "compensate", Compensate::WORDS);
    let follow = follow?.unwrap_or(default(Follow::Straight));
    let operation = RoughVcut {
        setup: setup?,
        blade: blade?,
        tips: None,
        lattice: lattice?,
        swing: swing?,
        layer: layer?,
        step: step?,
        overlap: overlap?,
        objective: objective?.unwrap_or(default(Objective::Time)),
        formulas: formulas?.unwrap_or(default(Formulas::Exact)),
        limits: limits?,
        allowance: allowance?,
        residual: residual?,
        redundant: redundant?,
        avoid: avoid?.unwrap_or(default(Avoid::Lift)),
        order: order?,
        sequence: sequence?,
        standoff: standoff?,
        follow,
        family: follow.value.family().unwrap_or(Family::Straight),
        compensate: compensate?.unwrap_or(default(Compensate::Nothing)),
        along: None,
    };
    if let Some(refused) = beside_level(&operation) {
        return Err(session.reports.push(refused));
    }
    match given? {
        Some(given) => tips::over(given, operation, &fields, &mut session.reports),
        None => Ok(operation),
    }
}
