//! Why a job has no plan, in two steps: what there is to tell is known at once, and what helps takes plans to find out.

use super::Unplanned;
use super::bench::Bench;
use super::effort::Effort;
use super::offers;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_job::RoughVcut;

/// Whether the job compiles with these changes of its text, as far as those see who come after planning: the machine of the
/// job, and its target.
pub type WorksThere<'w> = dyn FnMut(&[(Span, String)]) -> bool + 'w;

/// What there is to tell of a job without a plan.
#[derive(Default)]
pub struct Complaints<'j> {
    all: Vec<Complaint<'j>>,
}

enum Complaint<'j> {
    /// Nothing can be tried.
    Known(Box<Diagnostic>),
    /// An operation for which changes can be tried.
    Sought(Box<Sought<'j>>),
}

struct Sought<'j> {
    bench: Bench<'j>,
    asked: RoughVcut,
    cuts_left: usize,
    unplanned: Unplanned,
}

impl<'j> Complaints<'j> {
    pub(super) const fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    pub(super) fn tell(&mut self, diagnostic: Diagnostic) {
        self.all.push(Complaint::Known(Box::new(diagnostic)));
    }

    pub(super) fn seek(
        &mut self,
        bench: Bench<'j>,
        asked: RoughVcut,
        cuts_left: usize,
        unplanned: Unplanned,
    ) {
        let sought = Sought {
            bench,
            asked,
            cuts_left,
            unplanned,
        };
        self.all.push(Complaint::Sought(Box::new(sought)));
    }

    /// What there is to tell, before anything is tried.
    #[must_use]
    pub fn at_once(&self) -> Vec<Diagnostic> {
        self.told(&Wanted::never(), &mut |_| false)
    }

    /// The same with changes that work, of those that were found while they were wanted.
    #[must_use]
    pub fn with_help(&self, wanted: &Wanted, works: &mut WorksThere<'_>) -> Vec<Diagnostic> {
        self.told(wanted, works)
    }

    fn told(&self, wanted: &Wanted, works: &mut WorksThere<'_>) -> Vec<Diagnostic> {
        let mut effort = Effort::OF_A_REFUSAL;
        let mut told = Vec::new();
        for complaint in &self.all {
            match complaint {
                Complaint::Known(diagnostic) => told.push((**diagnostic).clone()),
                Complaint::Sought(sought) => {
                    let bench = sought.bench.for_whom(wanted);
                    let case = offers::Case {
                        bench: &bench,
                        asked: &sought.asked,
                        cuts_left: sought.cuts_left,
                    };
                    told.extend(offers::told(case, sought.unplanned.clone(), &mut effort, works));
                }
            }
        }
        told
    }
}
