//! What came of optimising, for people.

use super::bounds::{Relaxed, name, value};
use super::others;
use super::table::{seconds, table};
use super::{Came, Faster, FoundBy, OperationOptimum, Optimisation, Planned, Role, Row};
use std::fmt::Write;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::number::show;
use vcutc_vcut::asked::Objective;
use vcutc_vcut::plan::optimum::{Bound, Infeasible, Optimum, Problem};
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
        "{job}: operation {} ({}), {} by the {} formulas\n\n",
        operation.number,
        operation.place,
        objective(operation.objective),
        operation.formulas.word()
    );
    text += &table(
        &[
            "",
            "lattice",
            "model",
            "swing",
            "layer",
            "step",
            "overlap",
            "formula time",
            "cuts",
            "scallop",
            "edge",
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
    let _ = write!(
        text,
        "\n  cut with   {}\n  planned    {}\n",
        cut_words(&operation.planned.parameters),
        planned_words(&operation.planned, scallop)
    );
    text += &line_text(&operation.planned);
    text += &proven_text(operation);
    text += &binding_text(operation.objective, &operation.binding);
    text += &operation.faster.as_ref().map_or(String::new(), faster_text);
    text +=
        "\n  Other limits of the scallop, planned at programmed speeds, and the times by the formula:\n\n";
    let points = operation
        .trade_off
        .points
        .iter()
        .zip(&operation.trade_off.planned);
    text += &table(
        &[
            "",
            "limit",
            "time",
            "cuts",
            "leaves",
            "lattice",
            "swing",
            "layer",
            "step",
            "formula time",
        ],
        &points
            .map(|(best, came)| point_cells(best, came, operation.chosen()))
            .collect::<Vec<_>>(),
    );
    text
}

/// `faster     interlaced: 2 min 50.5 s planned, 45 % less than the job; 2 min 49.3 s by the formula`.
fn faster_text(faster: &Faster) -> String {
    let (lattice, share) = (faster.lattice.word(), faster.share * 100.0);
    let formula = seconds(faster.time);
    match &faster.came {
        Came::Planned(plan) => format!(
            "  faster     {lattice}: {} planned, {share:.0} % less than the job; {formula} by the formula\n",
            seconds(plan.time)
        ),
        Came::Nothing | Came::FormulaOnly => format!(
            "  faster     {lattice}: {formula} by the formula only, not planned, {share:.0} % below the marked line\n"
        ),
    }
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

/// Of what the lines that follow speak, where the job is not cut with the marked line, and what bounds what it is cut with.
fn line_text(planned: &Planned) -> String {
    match &planned.found {
        FoundBy::Formulas => String::new(),
        FoundBy::Simulation { reasons } => {
            let reasons = if reasons.is_empty() {
                "nothing that was met".to_owned()
            } else {
                reasons.join(", ")
            };
            format!(
                "  found      by simulation, bound by {reasons}\n\n  About line * (optimum of the formula; the job is cut with the better plan above):\n\n"
            )
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
            gain(objective, relaxed),
            percent(relaxed.share)
        );
    }
    text
}

/// What is saved of the objective, with its unit.
fn gain(objective: Objective, relaxed: &Relaxed) -> String {
    match objective {
        Objective::Time => seconds(relaxed.saves),
        Objective::Scallop | Objective::BladeLoad => format!("{} mm", show(relaxed.gain)),
        Objective::Cuts => format!("{:.1} cuts", relaxed.gain),
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

fn point_cells(best: &Optimum, came: &Came, chosen: Option<&Optimum>) -> Vec<String> {
    let is_chosen = chosen.is_some_and(|chosen| chosen.lattice == best.lattice && alike(chosen, best));
    let mark = if is_chosen { "*" } else { "" };
    let millimetres = |length: Length| format!("{:.3} mm", length.to_mm());
    let (results, lattice, swing, layer, step) = match came {
        Came::Planned(plan) => (
            [
                seconds(plan.time),
                plan.cuts.to_string(),
                format!("{:.2} mm", plan.leaves.to_mm()),
            ],
            plan.parameters.lattice,
            plan.parameters.swing,
            plan.parameters.layer,
            plan.parameters.step,
        ),
        Came::Nothing | Came::FormulaOnly => {
            let word = if *came == Came::Nothing {
                "no plan"
            } else {
                "formula only"
            };
            let results = [word.to_owned(), format!("{:.1}", best.cuts), String::new()];
            (results, best.lattice, best.swing, best.layer, best.step)
        }
    };
    let head = [mark.to_owned(), format!("{:.2} mm", best.scallop.to_mm())];
    let rest = [
        lattice.word().to_owned(),
        format!("{:.3} deg", swing.to_deg()),
        millimetres(layer),
        millimetres(step),
        seconds(best.time),
    ];
    head.into_iter().chain(results).chain(rest).collect()
}

/// Scallop and time that are the same as far as they are printed.
fn alike(a: &Optimum, b: &Optimum) -> bool {
    (a.scallop - b.scallop).abs() < Length::mm(0.005) && (a.time - b.time).abs() < Duration::s(0.05)
}
