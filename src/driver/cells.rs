//! Whether the cells of the core meet a mode of the arm, in words.

use crate::Compiled;
use crate::summary::row;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_dynamics::modes::cells::Cells;
use vcutc_dynamics::modes::meeting::Met;
use vcutc_job::{CheckedJob, Sourced};
use vcutc_motion::describe::site_words;

/// Compares the cells of a job that states their size with the modes of its arm, adds the result to the
/// summary, and returns what there is to warn of.
pub(crate) fn compare(job: &CheckedJob, compiled: &mut Compiled) -> Vec<Diagnostic> {
    let Some(size) = job.cell_size else {
        return Vec::new();
    };
    let found = compiled.dynamics.cells.take();
    let warned = found.iter().flatten();
    let warned = warned
        .filter_map(|cells| warning(job, compiled, size, cells))
        .collect();
    compiled
        .summary
        .push(row("cells", &line(size.value, found.as_deref())));
    warned
}

/// `of 3.2 mm at 200 mm/s: 62.5 Hz, 20 % or more away from all modes that move the blade across its flank, at samples`.
fn line(size: Length, found: Option<&[Cells]>) -> String {
    let size = show(size.to_mm());
    let Some(found) = found else {
        return format!(
            "of {size} mm: not compared with the modes of the arm, as its masses, its load or its stiffness are not known"
        );
    };
    let each = found.iter().map(|cells| {
        let (rate, speed) = (hertz(cells.rate), show(cells.speed.to_mm_per_s()));
        match cells.met {
            None => format!(
                "{rate} Hz at {speed} mm/s, 20 % or more away from all modes that move the blade across its flank"
            ),
            Some(met) => format!("{rate} Hz at {speed} mm/s, near a mode of {} Hz", hertz(met.frequency)),
        }
    });
    let each: Vec<String> = each.collect();
    if each.is_empty() {
        return format!("of {size} mm: no straight blade cuts them");
    }
    format!("of {size} mm: {}; at samples", each.join("; "))
}

fn warning(
    job: &CheckedJob,
    compiled: &Compiled,
    size: Sourced<Length>,
    cells: &Cells,
) -> Option<Diagnostic> {
    let Met {
        op,
        frequency,
        share,
        lower,
        higher,
    } = cells.met?;
    let setup = job.operations.get(usize::from(cells.operation.0))?.setup();
    let program = compiled.program.verified().program();
    let place = site_words(program, program.op(op)?.site);
    let speed = show(cells.speed.to_mm_per_s());
    let diagnostic = Diagnostic::new(
        Code::CellsMeetMode,
        format!(
            "at {speed} mm/s the edge goes through {} cells a second, and at {place} the arm swings by itself {} times a second",
            hertz(cells.rate),
            hertz(frequency),
        ),
        setup.cut_feed.span.unwrap_or(setup.head_span),
        format!(
            "this mode is {:.0} % of what the blade yields across its flank",
            100.0 * share
        ),
    );
    let diagnostic = match size.span {
        Some(span) => diagnostic.and(span, "the cells"),
        None => diagnostic,
    };
    let nearest = nearest(lower, higher, "mm/s");
    Some(diagnostic.help(format!(
        "cut at a speed that is 20 % away from all such modes of these cuts: {nearest}"
    )))
}

/// `the nearest are 28 mm/s and 50 mm/s`.
pub(crate) fn nearest(lower: Option<f64>, higher: f64, unit: &str) -> String {
    let higher = show(higher);
    match lower {
        Some(lower) => format!("the nearest are {} {unit} and {higher} {unit}", show(lower)),
        None => format!("the nearest is {higher} {unit}"),
    }
}

/// To a tenth.
pub(crate) fn hertz(frequency: f64) -> String {
    show(rounded(frequency, 10.0))
}
