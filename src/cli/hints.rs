//! Hints after success: looked for once the program is written, for about as long as it took to compile.

use super::console::Console;
use super::snapshot::Made;
use crate::driver::Outcome;
use crate::hints::{Hint, hints};
use crate::wanted::Wanted;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// The search for hints may take this long, or as long as the job took to compile. It decides which hints there are, not what
/// they say.
const PATIENCE: Duration = Duration::from_secs(1);

/// Tells what would make a job faster that its machine made slow.
pub(super) fn tell(outcome: &Outcome, made: &Made, timings: &[(&'static str, Duration)], console: &Console) {
    // Who compares wants to know what differs.
    if !console.tells_more() || made.differences.is_some() || !made.diagnostics.is_empty() {
        return;
    }
    let compiling: Duration = timings.iter().map(|(_, time)| *time).sum();
    for hint in found_within(outcome, PATIENCE.max(compiling)) {
        console.hint(&hint, &outcome.sources);
    }
}

/// The hints that are found in that time.
fn found_within(outcome: &Outcome, patience: Duration) -> Vec<Hint> {
    let (Some(job), Some(compiled)) = (&outcome.job, &outcome.compiled) else {
        return Vec::new();
    };
    let (wanted, interest) = Wanted::while_held();
    let (done, is_done) = mpsc::channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            if is_done.recv_timeout(patience) == Err(RecvTimeoutError::Timeout) {
                drop(interest);
            }
        });
        let found = hints(job, compiled, &wanted);
        drop(done);
        found
    })
}
