//! The torques of the machine's drives, as far as they are known.

use crate::summary::row;
use crate::{Compiled, compile_checked};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::Diagnostic;
use vcutc_dynamics::figures::TorqueFigures;
use vcutc_dynamics::verdict::{above_limit, is_within_limits, relief};
use vcutc_job::{CheckedJob, Machine};
use vcutc_motion::solve::Reached;
use vcutc_remedy::base_nearer;

/// How far the base is moved towards the arm where a drive is too weak, in mm.
const NEARER: [f64; 8] = [50.0, 100.0, 150.0, 200.0, 300.0, 400.0, 500.0, 700.0];

/// Computes the torques of a program, and adds them to what is known of it.
pub(crate) fn add(job: &CheckedJob, compiled: &mut Compiled) {
    let Some((machine, reached)) = carried(job, compiled) else {
        return;
    };
    let figures = TorqueFigures::of(&machine.model, &reached.program);
    let known = figures.as_ref().map(|_| ()).map_err(|why| *why);
    let line = figures.as_ref().ok().and_then(TorqueFigures::line);
    compiled.checks = compiled.checks.with_torques(known);
    compiled.summary.extend(line.map(|line| row("torques", &line)));
    compiled.torques = figures.ok();
}

/// What there is to say of torques above the limits of drives, with a place of the work that relieves them.
pub(crate) fn above_limits(job: &CheckedJob, compiled: &Compiled, wanted: &Wanted) -> Option<Diagnostic> {
    let machine = job.machine.as_ref()?;
    let diagnostic = above_limit(compiled.torques.as_ref()?, machine)?;
    let relieved = NEARER.into_iter().find_map(|by| {
        let change = base_nearer(job, by)?;
        let (_, there) = compile_checked(&change.job, wanted)?;
        let (machine, reached) = carried(&change.job, &there)?;
        let figures = TorqueFigures::of(&machine.model, &reached.program).ok()?;
        is_within_limits(&figures).then_some((change, figures))
    });
    Some(match relieved {
        Some((change, figures)) => {
            let title = format!("{}, where {}", change.advice, relief(&figures));
            if change.edits.is_empty() {
                diagnostic.help(title)
            } else {
                diagnostic.fix_all(title, &change.edits)
            }
        }
        None => diagnostic.help("use a lighter tool, lower speeds, or another place for the work"),
    })
}

fn carried<'a>(job: &'a CheckedJob, compiled: &'a Compiled) -> Option<(&'a Machine, &'a Reached)> {
    job.machine.as_ref().zip(compiled.program.reached())
}
