//! The table in `docs/optimum.md`: the block of Cui et al. at the parameters of the paper and at the optima, each planned,
//! proven and simulated by the whole compiler.
//!
//! `UPDATE_DOCS=1 cargo test --test it optimum_table` rewrites it.

use crate::pipeline::{Files, compile, rendered};
use crate::published::{ARC, LEAD_DEG};
use crate::repository::{read, root};
use vcutc::driver::Outcome;
use vcutc::vcut::asked::{Formulas, Lattice};
use vcutc::vcut::plan::optimum::published::table_1;
use vcutc::vcut::plan::optimum::{Optimum, Problem, Range, solve};
use vcutc::vcut::plan::{PlannedVcut, blade_reach};
use vcutc_backend_api::units::{Angle, Length};

const PAGE: &str = "docs/optimum.md";
const BEGIN: &str = "<!-- table: written by tests/it/optimum_table.rs -->";
const END: &str = "<!-- end of table -->";

fn between<T>(least: T, most: T) -> Range<T> {
    Range { least, most }
}

/// The parameters that the paper begins with.
fn initial() -> Problem {
    let fixed = |value| between(Length::mm(value), Length::mm(value));
    Problem {
        swing: between(Angle::deg(45.0), Angle::deg(45.0)),
        layer: fixed(3.0),
        step: fixed(6.0),
        ..table_1(Formulas::Paper, Lattice::Orthogonal)
    }
}

/// A row of the table.
struct Row {
    name: &'static str,
    model: Optimum,
    outcome: Outcome,
}

impl Row {
    fn of(name: &'static str, problem: &Problem) -> Self {
        let model = solve(problem).unwrap();
        let outcome = planned(&model);
        assert_eq!(rendered(&outcome.diagnostics, &outcome), "", "{name}");
        Self { name, model, outcome }
    }

    /// Time by the model and of the plan in s, scallop bound and simulated scallop in mm.
    fn figures(&self) -> [f64; 4] {
        let report = &self.outcome.compiled.as_ref().unwrap().report;
        let model = &self.model;
        [
            model.time.to_s(),
            report.times.all.total().to_s(),
            model.scallop.to_mm(),
            report.scallop.height.to_mm(),
        ]
    }

    fn line(&self) -> String {
        let Self { name, model, outcome } = self;
        let [time, planned, bound, scallop] = self.figures();
        let report = &outcome.compiled.as_ref().unwrap().report;
        let freed = report.cuts();
        format!(
            "| {name} | {:.3} | {:.3} | {:.3} | {:.2} | {time:.1} | {planned:.1} | {:+.1} % | {:.1} | {} | {} | {bound:.2} | {scallop:.2} | {freed} of {freed} |\n",
            model.swing.to_deg(),
            model.layer.to_mm(),
            model.step.to_mm(),
            model.overlap.max(0.0),
            (time / planned - 1.0) * 100.0,
            model.cuts,
            report.cuts(),
            report.layers.len(),
        )
    }
}

/// The block cut with these parameters, the layer rounded down to the grid.
fn planned(model: &Optimum) -> Outcome {
    let lattice = model.lattice.word();
    // Two micrometres less leave room for rounding the step.
    let layer = ((model.layer.to_mm() * 1000.0).round() - 2.0) / 1000.0;
    // The blade is as long as its edge in use, so that it may run out as short as the paper's.
    let edge = (model.edge.to_mm() * 1000.0).ceil() / 1000.0;
    let extension = edge * LEAD_DEG.to_radians().cos() + 0.001;
    let text = format!(
        "job \"block\"
        stock {{ size = (85 mm, 50 mm, 50 mm) }}
        profile {{ {ARC} }}
        blade dagger {{ cutting_length = {edge} mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }}
        rough vcut {{
            blade = dagger, lattice = {lattice}, rake = 60 deg, residual = mixed, order = point, sequence = rows
            swing = {:.6} deg, layer = {layer:.3} mm, overlap = {:.9}, step = auto, extension = {extension} mm
            feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
            clearance = 10 mm
        }}",
        model.swing.to_deg(),
        model.overlap.max(0.0),
    );
    compile("block.vcut", &Files::default().with("block.vcut", text))
}

fn rows() -> Vec<Row> {
    let exact = |lattice| table_1(Formulas::Exact, lattice);
    vec![
        Row::of("paper, as it begins", &initial()),
        Row::of("paper, optimum", &table_1(Formulas::Paper, Lattice::Orthogonal)),
        Row::of("exact, orthogonal", &exact(Lattice::Orthogonal)),
        Row::of("exact, interlaced", &exact(Lattice::Interlaced)),
        Row::of("exact, free", &exact(Lattice::Free)),
    ]
}

#[test]
fn the_table_of_optima_is_current_and_the_papers() {
    let rows = rows();
    // What the model says, and by which share the plan may differ from it: whole cuts and layers.
    let published = [
        (515.3, 0.024),
        (307.6, 0.011),
        (261.6, 0.021),
        (169.6, 0.008),
        (546.8, 0.006),
    ];
    for (row, (published, share)) in rows.iter().zip(published) {
        let [model, planned, bound, simulated] = row.figures();
        assert!((model - published).abs() < 0.35, "{}: {model}", row.name);
        assert!((planned / model - 1.0).abs() < share, "{}: {planned}", row.name);
        assert!(simulated <= bound + 1e-3, "{}: {simulated} {bound}", row.name);
        // What the planner needs for the lattice it has planned is within the edge in use.
        let vcut = PlannedVcut::of(&*row.outcome.plan.as_ref().unwrap().operations[0]).unwrap();
        let p = &vcut.parameters;
        let needed = blade_reach::needed_reach(p.lattice, p.layer, p.step, p.flanks.slope);
        assert!(needed <= p.flanks.reach + Length::mm(1e-6), "{}", row.name);
    }
    let lines: String = rows.iter().map(Row::line).collect();
    keep(
        PAGE,
        BEGIN,
        &format!(
            "| Parameters | Swing, deg | Layer, mm | Step, mm | Overlap | Model, s | Planned, s | Model against plan | Cuts by the model | Cuts | Layers | Scallop bound, mm | Simulated, mm | Chips freed |\n\
            | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n\
            {lines}"
        ),
    );
}

/// Compares a table of a page with a fresh one, or rewrites it when asked to.
#[allow(
    clippy::disallowed_methods,
    reason = "the test writes a committed file when asked to"
)]
pub(crate) fn keep(page: &str, begin: &str, table: &str) {
    let text = read(page);
    let (before, rest) = text
        .split_once(begin)
        .expect("the page has a place for the table");
    let (_, after) = rest.split_once(END).expect("the table ends");
    let fresh = format!("{before}{begin}\n{table}{END}{after}");
    if std::env::var("UPDATE_DOCS").is_ok() {
        std::fs::write(root().join(page), &fresh).unwrap();
    } else {
        assert!(
            text == fresh,
            "{page} is out of date: run the test with UPDATE_DOCS=1 and commit it\n{table}"
        );
    }
}
