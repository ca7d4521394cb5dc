//! A job that is refused: what is reported at once, and then what helps.
//!
//! A refusal is known as soon as a plan, a proof or the machine has failed, and is reported then
//! ([`Patience::refused`]). Changes that help are looked for afterwards, for as long as they are wanted: each costs a plan, and
//! mostly a proof of the whole program. What is offered for a job with a machine has been compiled as the
//! text that results ([`super::trials`]).

use super::target::{self, Objection};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_job::operation::WorksThere;
use vcutc_motion::solve::{Unreachable, Unreached};
use vcutc_motion::verdict::{self as reach_verdict, Explained};
use vcutc_process::plan;
use vcutc_process::verdict::{self, Proven};

/// Who waits for an outcome, and for how long.
pub trait Patience {
    /// The job is refused. These are the diagnostics without the changes that help, which are looked for
    /// afterwards, while that is wanted.
    fn refused(&mut self, diagnostics: &[Diagnostic], sources: &SourceMap) -> Wanted;

    /// What to say of a search for help that ended because it was not wanted any more.
    fn cut_short(&self) -> Option<String>;

    /// The job is compiled, and its machine made it slow. Changes that save time are looked for afterwards, while that is wanted.
    fn slowed(&mut self) -> Wanted;
}

/// Who waits for as long as it takes. What is found then depends on the job alone.
#[derive(Clone, Copy, Debug)]
pub struct Unhurried;

impl Patience for Unhurried {
    fn refused(&mut self, _: &[Diagnostic], _: &SourceMap) -> Wanted {
        Wanted::ALWAYS
    }

    fn cut_short(&self) -> Option<String> {
        None
    }

    fn slowed(&mut self) -> Wanted {
        Wanted::ALWAYS
    }
}

/// Who wants to know whether a job compiles, and not what would help one that does not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unhelped;

impl Patience for Unhelped {
    fn refused(&mut self, _: &[Diagnostic], _: &SourceMap) -> Wanted {
        Wanted::never()
    }

    fn cut_short(&self) -> Option<String> {
        None
    }

    fn slowed(&mut self) -> Wanted {
        Wanted::never()
    }
}

/// Why a job is not compiled.
pub(super) enum Refused<'j> {
    /// There is no plan.
    Unplanned(plan::Refusal<'j>),
    /// The plan's program breaks a rule, which is a fault of the compiler.
    Broken(Box<PlannedJob>, Box<Diagnostic>),
    /// The cuts are not sound.
    Unsound(Box<PlannedJob>, Box<Proven>),
    /// The machine does not carry it out.
    Unreached(Box<NotCarriedOut>),
    /// The target of the machine does not take it.
    ByTarget(Box<NotTaken>),
}

/// A plan that the machine does not carry out.
pub(super) struct NotCarriedOut {
    pub(super) plan: PlannedJob,
    /// Further diagnostics.
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) unreached: Unreached,
    /// What to say of other plans that were tried.
    pub(super) cut_short: Option<String>,
}

/// A program that a target does not take.
pub(super) struct NotTaken {
    pub(super) plan: PlannedJob,
    /// Further diagnostics.
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) objections: Vec<Objection>,
}

impl Refused<'_> {
    /// What is reported before anything is tried.
    pub(super) fn at_once(&self, job: &CheckedJob) -> Vec<Diagnostic> {
        match self {
            Self::Unplanned(complaints) => complaints.at_once(),
            Self::Broken(_, internal) => vec![(**internal).clone()],
            Self::Unsound(plan, proven) => {
                verdict::diagnose_while(job, plan, proven, &Wanted::never(), &mut |_| false)
            }
            Self::Unreached(refused) => refused.in_words(job, |unreachable| {
                let explained = reach_verdict::explain(job, unreachable);
                explained.map(Explained::with_advice)
            }),
            Self::ByTarget(refused) => {
                let objections = refused.objections.iter();
                let objections = objections.map(|objection| objection.diagnostic.clone());
                refused.warnings.iter().cloned().chain(objections).collect()
            }
        }
    }

    /// The same with changes that help, as far as they are wanted.
    pub(super) fn with_help(
        &self,
        job: &CheckedJob,
        wanted: &Wanted,
        works: &mut WorksThere<'_>,
    ) -> Vec<Diagnostic> {
        match self {
            Self::Unplanned(complaints) => complaints.with_help(wanted, works),
            Self::Broken(..) => self.at_once(job),
            Self::Unsound(plan, proven) => verdict::diagnose_while(job, plan, proven, wanted, works),
            Self::Unreached(refused) => refused.in_words(job, |unreachable| {
                vcutc_remedy::diagnose(job, &refused.plan, unreachable, wanted, works)
            }),
            Self::ByTarget(refused) => {
                let objections = refused.objections.iter();
                let helped = objections.map(|objection| target::with_help(objection, works));
                refused.warnings.iter().cloned().chain(helped).collect()
            }
        }
    }

    /// The plan that was refused, if there is one.
    pub(super) fn into_plan(self) -> Option<PlannedJob> {
        match self {
            Self::Unplanned(_) => None,
            Self::Broken(plan, _) | Self::Unsound(plan, _) => Some(*plan),
            Self::Unreached(refused) => Some(refused.plan),
            Self::ByTarget(refused) => Some(refused.plan),
        }
    }
}

impl NotCarriedOut {
    fn in_words(
        &self,
        job: &CheckedJob,
        of_machine: impl FnOnce(&Unreachable) -> Option<Diagnostic>,
    ) -> Vec<Diagnostic> {
        let mut words = match &self.unreached {
            Unreached::Unreachable(unreachable) => of_machine(unreachable),
            Unreached::Rules(faults) => Some(super::internal(job, &super::rules_broken(faults))),
            Unreached::Motion(faults) => Some(super::internal(job, &super::motions_broken(faults))),
        };
        if let Some(words) = &mut words {
            words.notes.extend(self.cut_short.clone());
        }
        self.warnings.iter().cloned().chain(words).collect()
    }
}

/// Leaves out offers that do not work when the job is compiled as it then reads. A diagnostic that loses all of them gets what it
/// said at once.
pub(super) fn tried(
    diagnostics: Vec<Diagnostic>,
    at_once: &[Diagnostic],
    works: &mut WorksThere<'_>,
) -> Vec<Diagnostic> {
    let one = |mut diagnostic: Diagnostic| {
        let before = diagnostic.fixes.len();
        diagnostic.fixes.retain(|fix| {
            let edits = fix.edits.iter();
            let edits: Vec<_> = edits.map(|edit| (edit.span, edit.replacement.clone())).collect();
            works(&edits)
        });
        let is_same = |other: &&Diagnostic| {
            other.code == diagnostic.code && other.primary.span == diagnostic.primary.span
        };
        if before > 0
            && diagnostic.fixes.is_empty()
            && diagnostic.help.is_empty()
            && let Some(other) = at_once.iter().find(is_same)
        {
            diagnostic.help.clone_from(&other.help);
        }
        diagnostic
    };
    diagnostics.into_iter().map(one).collect()
}
