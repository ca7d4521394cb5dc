//! Whether the teeth of crushers meet a mode of the arm, in words.

use crate::Compiled;
use crate::cells::{hertz, nearest};
use crate::summary::row;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_dynamics::modes::meeting::Met;
use vcutc_dynamics::modes::teeth::Teeth;
use vcutc_job::CheckedJob;
use vcutc_motion::describe::site_words;

/// Compares the teeth of crushers with the modes of the arm where both are known, adds the result to the summary, and returns what there
/// is to warn of.
pub(crate) fn compare(job: &CheckedJob, compiled: &mut Compiled) -> Vec<Diagnostic> {
    let found = core::mem::take(&mut compiled.dynamics.teeth);
    let warned = found
        .iter()
        .filter_map(|teeth| warning(job, compiled, teeth))
        .collect();
    if !found.is_empty() {
        compiled.summary.push(row("teeth", &line(&found)));
    }
    warned
}

/// `of hog: 600 Hz at 18000 rev/min, 20 % or more away from all modes that move the blade towards a wall; at samples`.
fn line(found: &[Teeth]) -> String {
    let each = found.iter().map(|teeth| {
        let (rate, spin) = (hertz(teeth.rate), show(teeth.spin.round()));
        let away = match teeth.met {
            None => "20 % or more away from all modes that move the blade towards a wall".to_owned(),
            Some(met) => format!("near a mode of {} Hz", hertz(met.frequency)),
        };
        format!("of {}: {rate} Hz at {spin} rev/min, {away}", teeth.blade)
    });
    let each: Vec<String> = each.collect();
    format!("{}; at samples", each.join("; "))
}

fn warning(job: &CheckedJob, compiled: &Compiled, teeth: &Teeth) -> Option<Diagnostic> {
    let Met {
        op,
        frequency,
        share,
        lower,
        higher,
    } = teeth.met?;
    let operation = job.operations.get(usize::from(teeth.operation.0))?;
    let mut blades = operation.blades().into_iter();
    let blade = blades.find(|blade| blade.name() == teeth.blade)?;
    let program = compiled.program.verified().program();
    let place = site_words(program, program.op(op)?.site);
    let span = blade.spin().and_then(|spin| spin.span);
    let diagnostic = Diagnostic::new(
        Code::TeethMeetMode,
        format!(
            "{} teeth of `{}` come a second, and at {place} the arm swings by itself {} times a second",
            hertz(teeth.rate),
            teeth.blade,
            hertz(frequency),
        ),
        span.unwrap_or_else(|| blade.span()),
        format!(
            "this mode is {:.0} % of what the blade yields towards a wall",
            100.0 * share
        ),
    );
    Some(diagnostic.help(format!(
        "turn it at a spin that is 20 % away from all such modes of these cuts: {}",
        nearest(lower, higher, "rev/min")
    )))
}
