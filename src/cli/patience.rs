//! How long help with a refused job is waited for.
//!
//! The compiler reads no clock: a thread of its own drops the interest in help when the time is over. What was found by then is
//! reported, so the time decides which help lines appear, and nothing else.

use super::progress::Progress;
use std::cell::RefCell;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;
use vcutc_cancellation::{Interest, Wanted};
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Diagnostic, Severity};
use vcutc_driver::memory::Memory;
use vcutc_driver::{self as driver, Outcome, Patience, Request, RequestError, Run};

/// How long help is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HelpBudget {
    /// As long as the work takes, which is bounded: what is found depends on the job alone.
    Unlimited,
    /// So long.
    Of(Duration),
}

/// A number of seconds, as people write one: `5s`, `0.5 s`, `500ms`, or `none` for no limit.
pub(super) fn help_budget(text: &str) -> Result<HelpBudget, String> {
    let text = text.trim();
    if text == "none" {
        return Ok(HelpBudget::Unlimited);
    }
    let refuse = || "write a time such as `5s` or `500ms`, or `none` for no limit".to_owned();
    let (number, seconds) = if let Some(number) = text.strip_suffix("ms") {
        (number, 1e-3)
    } else if let Some(number) = text.strip_suffix('s') {
        (number, 1.0)
    } else {
        (text, 1.0)
    };
    let number: f64 = number.trim().parse().map_err(|_| refuse())?;
    Duration::try_from_secs_f64(number * seconds)
        .map(HelpBudget::Of)
        .map_err(|_| refuse())
}

/// The user who waits at a terminal or in an editor.
pub(super) struct Waiting<'p, 'q> {
    budget: HelpBudget,
    progress: Option<&'p RefCell<&'q mut Progress>>,
    timer: Option<Timer>,
}

impl Waiting<'_, '_> {
    /// Without anything to show meanwhile.
    pub(super) const fn unseen(budget: HelpBudget) -> Self {
        Self {
            budget,
            progress: None,
            timer: None,
        }
    }
}

impl Waiting<'_, '_> {
    /// For as long as the budget says, from now on.
    fn within_budget(&mut self) -> Wanted {
        match self.budget {
            HelpBudget::Unlimited => Wanted::ALWAYS,
            HelpBudget::Of(Duration::ZERO) => Wanted::never(),
            HelpBudget::Of(limit) => {
                let (wanted, interest) = Wanted::while_held();
                self.timer = Some(Timer::start(limit, interest));
                wanted
            }
        }
    }
}

impl Patience for Waiting<'_, '_> {
    fn refused(&mut self, diagnostics: &[Diagnostic], _: &SourceMap) -> Wanted {
        let first = diagnostics.iter().find(|one| one.severity() == Severity::Error);
        if let (Some(progress), Some(first)) = (self.progress, first) {
            progress.borrow().refused(&first.message);
        }
        self.within_budget()
    }

    fn slowed(&mut self) -> Wanted {
        self.within_budget()
    }

    fn cut_short(&self) -> Option<String> {
        match self.budget {
            HelpBudget::Unlimited | HelpBudget::Of(Duration::ZERO) => None,
            HelpBudget::Of(limit) => Some(format!(
                "the search for a fix ended after {} s; `vcutc check --help-budget {}s` searches longer",
                limit.as_secs_f64(),
                limit.as_secs_f64() * 10.0
            )),
        }
    }
}

/// Ends the interest in something after a while.
pub(super) struct Timer {
    /// When this goes, the thread does.
    _running: Sender<()>,
}

impl Timer {
    /// Starts it; the interest ends when the time is over, or with the timer.
    pub(super) fn start(limit: Duration, interest: Interest) -> Self {
        let (running, over): (Sender<()>, Receiver<()>) = channel();
        thread::spawn(move || {
            // Nothing is ever sent: this waits for the time, or for the end of the run.
            let _ = over.recv_timeout(limit);
            drop(interest);
        });
        Self { _running: running }
    }
}

/// Compiles a job for a user who waits for help only so long, and shows progress meanwhile.
pub(super) fn compile(
    request: Request<'_>,
    memory: &mut Memory,
    budget: HelpBudget,
    progress: &mut Progress,
) -> Result<Outcome, RequestError> {
    let shared = RefCell::new(progress);
    let mut waiting = Waiting {
        progress: Some(&shared),
        ..Waiting::unseen(budget)
    };
    let run = Run {
        memory,
        wanted: &Wanted::ALWAYS,
        patience: &mut waiting,
    };
    driver::compile_in(run, request, &mut |stage| shared.borrow_mut().enter(stage))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn budgets_are_read_as_people_write_them() {
        let of = |seconds: f64| Ok(HelpBudget::Of(Duration::from_secs_f64(seconds)));
        assert_eq!(help_budget("5s"), of(5.0));
        assert_eq!(help_budget("0.5 s"), of(0.5));
        assert_eq!(help_budget("500ms"), of(0.5));
        assert_eq!(help_budget("2"), of(2.0));
        assert_eq!(help_budget("0s"), of(0.0));
        assert_eq!(help_budget("none"), Ok(HelpBudget::Unlimited));
        for wrong in ["", "s", "-1s", "five", "1e400s"] {
            assert!(help_budget(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_search_without_time_does_not_begin() {
        let mut waiting = Waiting::unseen(HelpBudget::Of(Duration::ZERO));
        assert!(waiting.refused(&[], &SourceMap::default()).is_needless());
        let mut unlimited = Waiting::unseen(HelpBudget::Unlimited);
        assert!(!unlimited.refused(&[], &SourceMap::default()).is_needless());
    }
}
