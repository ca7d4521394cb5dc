//! The results of `vcutc optimize`, for people.

use super::bounds::{Relaxed, name, value};
use super::others;
use super::table::{seconds, table};
use super::trade_off::{Point, TradeOff};
use super::{
    Against, Came, Faster, FoundBy, Loosened, OperationOptimum, Optimisation, Plan, Planned, Role, Row,
    WiderLimits,
};
use std::fmt::Write;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::number::show;
use vcutc_vcut::asked::Objective;
use vcutc_vcut::plan::optimum::{Bound, Infeasible, Problem};
use vcutc_vcut::plan::parameters::VcutParameters;

#[must_use]
pub const fn objective(objective: Objective) -> &'static str {
    match objective {
        Objective::Time => "least time",
        Objective::Scallop => "least scallop",
        Objective::Cuts => "fewest cuts",
        Objective::BladeLoad => "least edge in use",
    }
}

/// Tables for people: for each operation the best parameters, what was planned, what binds, and the trade-off.
#[must_use]
pub fn text(optimisation: &Optimisation) -> String {
    let mut text = String::new();
    for operation in &optimisation.operations {
        if !text.is_empty() {
            text.push('\n');
        }
        text += &operation_text(&optimisation.job, operation, optimisation.scallop);
    }
    if !text.is_empty() && !optimisation.given.is_empty() {
        text.push('\n');
    }
    for given in &optimisation.given {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{}: operation {}: its {} tips are given ({}), so there is nothing to choose",
            optimisation.job, given.number, given.tips, given.place
        );
    }
    for part in others::texts(optimisation) {
        if !text.is_empty() {
            text.push('\n');
        }
        text += &part;
    }
    text
}

fn operation_text(job: &str, operation: &OperationOptimum, scallop: Length) -> String {
    let mut text = format!(
        "{job}: operation {} ({}), {}\n\n  cut with   {}\n  planned    {}\n",
        operation.number,
        operation.place,
        objective(operation.objective),
        cut_words(&operation.planned.parameters),
        planned_words(&operation.planned, scallop)
    );
    text += &found_text(&operation.planned);
    text += &wider_text(operation);
    for faster in &operation.faster {
        text += &faster_text(faster);
    }
    text += &trade_off_text(&operation.trade_off, operation.chosen_limit);
    text += &formulas_text(operation);
    text
}

/// What the formulas say, beside the plans.
fn formulas_text(operation: &OperationOptimum) -> String {
    let mut text = format!(
        "\n  By the formulas, {} by the {} ones:\n\n",
        objective(operation.objective),
        operation.formulas.word()
    );
    text += &table(
        &[
            "", "lattice", "model", "swing", "layer", "step", "overlap", "time", "cuts", "scallop", "edge",
        ],
        &operation.rows.iter().map(row_cells).collect::<Vec<_>>(),
    );
    if let Some(place) = &operation.lattice_given {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "\n  The lattice is given ({place}); the others are there for comparison."
        );
    }
    let chosen = proven_text(operation) + &binding_text(operation.objective, &operation.binding);
    if !chosen.is_empty() {
        text = text + "\n  Line *:\n" + &chosen;
    }
    text
}

/// What wider limits save, as planned.
fn wider_text(operation: &OperationOptimum) -> String {
    let Some(now) = operation.trade_off.now.plan() else {
        return String::new();
    };
    let mut lines: Vec<String> = Vec::new();
    if (now.time / operation.planned.time - 1.0).abs() > SAME_TIME {
        lines.push(format!(
            "counted    from {}, the time at programmed speeds",
            seconds(now.time)
        ));
    }
    let WiderLimits { found, not_planned } = &operation.wider;
    for (index, loosened) in found.iter().enumerate() {
        let head = if index == 0 { "binds" } else { "" };
        lines.push(format!("{head:<10} {}", loosened_words(operation, loosened)));
    }
    if found.is_empty() && not_planned.is_empty() {
        lines.push("binds      nothing: no limit that is a tenth wider saves more than 0.2 %".to_owned());
    }
    if !not_planned.is_empty() {
        let which = not_planned.join(", ");
        lines.push(format!(
            "not tried  a tenth wider, because of the many cuts: {which}"
        ));
    }
    lines.iter().map(|line| format!("  {line}\n")).collect()
}

/// From which difference on, as a share, times are two.
const SAME_TIME: f64 = 5e-4;

/// `swing <= 50 deg (rib.vcut:17:24); 55 deg saves 3.4 s (5.50 %)`.
fn loosened_words(operation: &OperationOptimum, loosened: &Loosened) -> String {
    let Loosened {
        bound,
        words,
        place,
        loosened: wider,
        gain,
        share,
        ..
    } = loosened;
    let place = match (place, bound, operation.chosen_limit) {
        (Some(place), ..) => format!(" ({place})"),
        (None, Bound::Scallop, Some(_)) => " (chosen)".to_owned(),
        (None, ..) => String::new(),
    };
    format!(
        "{words}{place}; {wider} saves {} ({} %)",
        gained(operation.objective, *gain),
        percent(*share)
    )
}

/// `faster     with lattice = interlaced: 2 min 50.5 s for 54 cuts, 45 % less`.
fn faster_text(faster: &Faster) -> String {
    let Faster { change, plan, share } = faster;
    format!(
        "  faster     with {change}: {} for {}, {:.1} % less\n",
        seconds(plan.time),
        counted(plan.cuts, "cut"),
        share * 100.0
    )
}

fn trade_off_text(trade_off: &TradeOff, chosen: Option<Length>) -> String {
    let against = trade_off.against;
    let mut rows: Vec<(f64, Vec<String>)> = trade_off
        .points
        .iter()
        .map(|point| (point.limit, point_cells(trade_off, point)))
        .collect();
    if let Some(now) = trade_off.now.plan() {
        let limit = trade_off.limit;
        let is_chosen = against == Against::Scallop && chosen.is_some();
        let words = match limit {
            None => "none".to_owned(),
            Some(limit) if is_chosen => format!("chosen {}", against.shown(limit)),
            Some(limit) => against.shown(limit),
        };
        let cells = [vec!["*".to_owned(), words], plan_cells(now)].concat();
        rows.push((limit.unwrap_or(against.of(now)), cells));
    }
    rows.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let rows: Vec<Vec<String>> = rows.into_iter().map(|(_, cells)| cells).collect();
    let mut text = format!(
        "\n  Other limits on {}, planned at programmed speeds:\n\n",
        against.word()
    );
    text += &table(
        &[
            "", "limit", "time", "cuts", "leaves", "edge", "lattice", "swing", "layer", "step",
        ],
        &rows,
    );
    text
}

fn point_cells(trade_off: &TradeOff, point: &Point) -> Vec<String> {
    let head = vec![String::new(), trade_off.against.shown(point.limit)];
    let rest = match &point.came {
        Came::Planned(plan) => plan_cells(plan),
        Came::Nothing => vec!["no plan".to_owned()],
        Came::TooLarge => vec!["not planned".to_owned()],
    };
    [head, rest].concat()
}

fn plan_cells(plan: &Plan) -> Vec<String> {
    let parameters = &plan.parameters;
    vec![
        seconds(plan.time),
        plan.cuts.to_string(),
        format!("{:.2} mm", plan.leaves.to_mm()),
        format!("{:.2} mm", plan.edge.to_mm()),
        parameters.lattice.word().to_owned(),
        format!("{:.3} deg", parameters.swing.to_deg()),
        format!("{:.3} mm", parameters.layer.to_mm()),
        // A single tip has no step.
        if parameters.step > Length::ZERO {
            format!("{:.3} mm", parameters.step.to_mm())
        } else {
            "-".to_owned()
        },
    ]
}

/// `interlaced, swing 40 deg, layer 4.519 mm, step 7.584 mm`: what the job is cut with, which simulation may have found better
/// than the line with the mark.
fn cut_words(cut: &VcutParameters) -> String {
    format!(
        "{}, swing {:.3} deg, layer {:.3} mm, step {:.3} mm",
        cut.lattice.word(),
        cut.swing.to_deg(),
        cut.layer.to_mm(),
        cut.step.to_mm()
    )
}

/// `280.9 s for 95 cuts in 5 layers; the model says 4.2 % less; scallop 9.31 mm`.
fn planned_words(planned: &Planned, scallop: Length) -> String {
    let model = match planned.model_above() {
        Some(share) if share.abs() >= 5e-4 => {
            let way = if share > 0.0 { "more" } else { "less" };
            format!(
                "the formula for whole cuts and layers says {:.1} % {way}",
                share.abs() * 100.0
            )
        }
        Some(_) | None => "as the formula for whole cuts and layers says".to_owned(),
    };
    format!(
        "{} for {} in {}; {model}; simulated scallop of the job {:.2} mm",
        seconds(planned.time),
        counted(planned.cuts, "cut"),
        counted(planned.layers, "layer"),
        scallop.to_mm()
    )
}

/// What bounds the parameters that simulation found.
fn found_text(planned: &Planned) -> String {
    match &planned.found {
        FoundBy::Formulas => String::new(),
        FoundBy::Simulation { reasons } => {
            let reasons = if reasons.is_empty() {
                "nothing that was met".to_owned()
            } else {
                reasons.join(", ")
            };
            format!("  found      by simulation, bound by {reasons}\n")
        }
    }
}

/// How much better than the line the job is cut with others can be at most.
fn proven_text(operation: &OperationOptimum) -> String {
    operation.chosen().map_or(String::new(), |best| {
        format!(
            "  proven     by the formula nothing else on this lattice is better by more than {:.0e} of it\n",
            best.gap
        )
    })
}

fn binding_text(objective: Objective, binding: &[Relaxed]) -> String {
    let mut text = String::new();
    for (index, relaxed) in binding.iter().enumerate() {
        let head = if index == 0 { "binds" } else { "" };
        let place = relaxed
            .place
            .as_ref()
            .map_or(String::new(), |place| format!(" ({place})"));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {head:<10} {}{place}; {} would save {} ({} %) by the formula",
            relaxed.words,
            relaxed.relaxed,
            gained(objective, relaxed.gain),
            percent(relaxed.share)
        );
    }
    text
}

/// What is saved of the objective, with its unit.
fn gained(objective: Objective, gain: f64) -> String {
    match objective {
        Objective::Time => seconds(Duration::s(gain)),
        Objective::Scallop | Objective::BladeLoad => format!("{} mm", show(gain)),
        Objective::Cuts => format!("{gain:.1} cuts"),
    }
}

fn percent(share: f64) -> String {
    let text = format!("{:.2}", share * 100.0);
    if text == "-0.00" { "0.00".to_owned() } else { text }
}

fn row_cells(row: &Row) -> Vec<String> {
    let mark = match row.role {
        Role::Chosen => "*",
        Role::Other => "",
    };
    let head = [mark, row.lattice.word(), row.formulas.word()].map(str::to_owned);
    let rest = match &row.best {
        Ok(best) => vec![
            format!("{:.3} deg", best.swing.to_deg()),
            format!("{:.3} mm", best.layer.to_mm()),
            format!("{:.3} mm", best.step.to_mm()),
            show(best.overlap),
            seconds(best.time),
            format!("{:.1}", best.cuts),
            format!("{:.2} mm", best.scallop.to_mm()),
            format!("{:.2} mm", best.edge.to_mm()),
        ],
        Err(trouble) => vec![trouble.clone()],
    };
    head.into_iter().chain(rest).collect()
}

/// Why a lattice has no parameters: `none: scallop <= 4 mm and step >= 9 mm conflict; scallop <= 5.2 mm would do`.
#[must_use]
pub fn why_not(problem: &Problem, infeasible: &Infeasible) -> String {
    match infeasible {
        Infeasible::Conflict { bounds, nearest } => {
            let names: Vec<String> = bounds
                .iter()
                .map(|&bound| match bound.value(problem) {
                    Some(now) => format!("{} {}", name(bound), value(bound, now)),
                    None => name(bound).to_owned(),
                })
                .collect();
            let parties = match &names[..] {
                [] => "the limits".to_owned(),
                [one] => return format!("none: {one} cannot be satisfied{}", would_do(bounds, nearest)),
                [first @ .., last] => format!("{} and {last}", first.join(", ")),
            };
            format!("none: {parties} conflict{}", would_do(bounds, nearest))
        }
        Infeasible::Unbounded => "none: the objective falls with the layer without end".to_owned(),
    }
}

/// The nearest value of the first bound that has one.
fn would_do(bounds: &[Bound], nearest: &[Option<f64>]) -> String {
    let works = bounds.iter().zip(nearest).find_map(|(&bound, nearest)| {
        nearest.map(|nearest| format!("; {} {} would do", name(bound), value(bound, nearest)))
    });
    works.unwrap_or_default()
}
