//! The parameters of V-shaped roughing for people, with the place or the reason of each value.

use crate::asked::{Avoid, Formulas, OF_A_LATTICE, Objective, RoughVcut};
use crate::plan::PlannedVcut;
use crate::summary::{compared, skipped};
use vcutc_backend_api::ir::Edges;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::number::show;
use vcutc_job::description::{ParameterRow, ParameterTable, angle_text, length_text, rate_text, speed_text};
use vcutc_job::{Bounds, Sourced};

/// The tables: blade, cut, motion, and limits where there are any.
pub(crate) fn tables(planned: &PlannedVcut) -> Vec<ParameterTable> {
    let asked = &planned.asked;
    let mut tables = vec![
        ParameterTable {
            caption: "Blade",
            rows: blade(asked),
        },
        ParameterTable {
            caption: "Cut",
            rows: as_laid_out(asked, cut(asked, planned)),
        },
        ParameterTable {
            caption: "Motion",
            rows: without_lattice(asked, motion(asked, planned)),
        },
    ];
    let limits = limits(asked);
    if !limits.is_empty() {
        tables.push(ParameterTable {
            caption: "Limits",
            rows: limits,
        });
    }
    tables
}

fn blade(asked: &RoughVcut) -> Vec<ParameterRow> {
    let blade = &asked.blade;
    let edges = match blade.edges {
        Edges::Single => "single",
        Edges::Double => "double",
    };
    vec![
        ParameterRow::written("blade", format!("{}, {edges} edge", blade.name), blade.span),
        ParameterRow::of("cutting_length", blade.cutting_length, length_text),
        ParameterRow::of("half_apex", blade.half_apex, angle_text),
        ParameterRow::of("thickness", blade.thickness, length_text),
    ]
}

fn cut(asked: &RoughVcut, planned: &PlannedVcut) -> Vec<ParameterRow> {
    let best = best(asked, planned);
    let found = &planned.parameters;
    let mut rows = vec![
        ParameterRow::of("objective", asked.objective, |objective| {
            objective.word().to_owned()
        }),
        ParameterRow::of("model", asked.formulas, |formulas| formulas.word().to_owned()),
        ParameterRow::open(
            "lattice",
            &asked.lattice,
            found.lattice.word().to_owned(),
            decided(planned, "lattice").unwrap_or_else(|| best.clone()),
        ),
        ParameterRow::of("rake", asked.setup.rake, angle_text),
        ParameterRow::open("swing", &asked.swing, angle_text(found.swing), best.clone()),
        ParameterRow::open("layer", &asked.layer, length_text(found.layer), best.clone()),
        ParameterRow::open("step", &asked.step, length_text(found.step), best.clone()),
        ParameterRow::open("overlap", &asked.overlap, show(found.overlap), best),
        ParameterRow::of("allowance", asked.allowance, length_text),
        ParameterRow::open(
            "residual",
            &asked.residual,
            planned.strategy.word().to_owned(),
            decided(planned, "residual").unwrap_or_else(|| {
                "the strategy that leaves the part within its limits in the least time".to_owned()
            }),
        ),
    ];
    if let Some(skipped) = skipped(planned) {
        let word = planned.redundant().word().to_owned();
        rows.push(ParameterRow::open("redundant", &asked.redundant, word, skipped));
    }
    if asked.avoid.value == Avoid::Swing {
        rows.push(ParameterRow::of("avoid", asked.avoid, |avoid| {
            avoid.word().to_owned()
        }));
    }
    rows
}

/// Where tips are given, they stand for the rows of a lattice.
fn as_laid_out(asked: &RoughVcut, rows: Vec<ParameterRow>) -> Vec<ParameterRow> {
    let tips = asked.tips.as_ref();
    let given =
        tips.map(|tips| ParameterRow::written("tips", format!("{} given", tips.tips.len()), tips.span));
    given.into_iter().chain(without_lattice(asked, rows)).collect()
}

/// Rows that say something where tips are given.
fn without_lattice(asked: &RoughVcut, mut rows: Vec<ParameterRow>) -> Vec<ParameterRow> {
    if asked.tips.is_some() {
        rows.retain(|row| !OF_A_LATTICE.contains(&row.name));
    }
    rows
}

fn motion(asked: &RoughVcut, planned: &PlannedVcut) -> Vec<ParameterRow> {
    let found = &planned.parameters;
    let direction = asked.setup.direction().value.word();
    // Where both are open, the order is decided with the sequence.
    let sequence = decided(planned, "sequence");
    let order = decided(planned, "order").or_else(|| sequence.clone());
    let fastest = || "the order of least time in which every chip comes free".to_owned();
    vec![
        ParameterRow::open(
            "order",
            &asked.order,
            planned.order.word().to_owned(),
            order.unwrap_or_else(fastest),
        ),
        ParameterRow::open(
            "sequence",
            &asked.sequence,
            planned.sequence.word().to_owned(),
            sequence.unwrap_or_else(fastest),
        ),
        ParameterRow::of("direction", asked.setup.direction(), |_| direction.to_owned()),
        ParameterRow::of("feed cut", asked.setup.cut_feed, speed_text),
        ParameterRow::of("feed travel", asked.setup.travel_feed, speed_text),
        ParameterRow::of("feed reorient", asked.setup.reorient_rate, rate_text),
        ParameterRow::of("clearance", asked.setup.clearance, length_text),
        ParameterRow::open(
            "extension",
            &asked.setup.extension(),
            length_text(found.extension),
            "the blade's overhang and the run-out",
        ),
        ParameterRow::of("run_out", asked.setup.run_out, length_text),
        ParameterRow::open(
            "standoff",
            &asked.standoff,
            length_text(found.standoff),
            "half the blade's thickness",
        ),
    ]
}

fn limits(asked: &RoughVcut) -> Vec<ParameterRow> {
    let limits = &asked.limits;
    let mut rows = bounds("swing", limits.swing, angle_text);
    rows.extend(bounds("layer", limits.layer, length_text));
    rows.extend(bounds("step", limits.step, length_text));
    let most = |name, limit: Option<Sourced<Length>>| {
        limit.map(|limit| ParameterRow::of(name, limit, |value| format!("at most {}", length_text(value))))
    };
    rows.extend(most("scallop", limits.scallop));
    rows.extend(most("edge", limits.edge));
    let time = |value: Duration| format!("at most {} s", show(value.to_s()));
    rows.extend(limits.time.map(|limit| ParameterRow::of("time", limit, time)));
    let cuts = |value: f64| format!("at most {}", show(value));
    rows.extend(limits.cuts.map(|limit| ParameterRow::of("cuts", limit, cuts)));
    rows
}

fn bounds<T: Copy>(name: &'static str, bounds: Bounds<T>, words: impl Fn(T) -> String) -> Vec<ParameterRow> {
    let row = |limit: Option<Sourced<T>>, which: &str| {
        limit.map(|limit| ParameterRow::of(name, limit, |value| format!("{which} {}", words(value))))
    };
    let (least, most) = (row(bounds.least, "at least"), row(bounds.most, "at most"));
    least.into_iter().chain(most).collect()
}

/// What was compared for a field that the job leaves open, in the words of the summary.
fn decided(planned: &PlannedVcut, field: &str) -> Option<String> {
    let decision = planned
        .decisions
        .iter()
        .find(|decision| decision.field == field)?;
    Some(compared(decision))
}

/// Why a parameter of the lattice came out as it did, and what keeps it from coming out better.
fn best(asked: &RoughVcut, planned: &PlannedVcut) -> String {
    let least = match asked.objective.value {
        Objective::Time => "the least time",
        Objective::Scallop => "the lowest scallops",
        Objective::Cuts => "the fewest cuts",
        Objective::BladeLoad => "the shortest edge in use",
    };
    let by = match (planned.is_found_by_simulation(), asked.formulas.value) {
        (true, Formulas::Paper | Formulas::Exact) => "as simulated",
        (false, Formulas::Paper) => "by the paper's formulas",
        (false, Formulas::Exact) => "by the exact formulas",
    };
    let bounds = planned.parameters.reasons(asked);
    if bounds.is_empty() {
        return format!("{least} within the limits, {by}");
    }
    format!("{least}, {by}; bound by {}", bounds.join(", "))
}
