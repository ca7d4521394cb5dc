//! Changes of a job's text, compiled before they are offered.
//!
//! What works for the planner need not be followed by the machine of the job, nor be taken by its target. So a change is made in
//! the text, exactly as an editor would make it, and the text is compiled as far as these two. How often that is done for one
//! refusal is bounded by a [`Budget`].

use super::compensation;
use super::routes::Ended;
use super::{Outcome, Request, Run, Unhurried, compile_unhelped, families, target};
use crate::memory::Memory;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::overlay::Overlay;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic, Edit, fix, has_errors};
use vcutc_job::PlannedJob;
use vcutc_job::sema;
use vcutc_remedy::{Budget, Edits, Size};

/// Changes of one refused job.
pub(super) struct Trials<'t> {
    request: Request<'t>,
    sources: &'t SourceMap,
    /// What is wrong with the job as it is.
    errors: Vec<(Code, String)>,
    budget: Budget,
    /// Changes that were compiled, and whether they work.
    known: Vec<(Edits, bool)>,
    machine: Machine,
}

/// Whether anybody comes after planning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Machine {
    /// The job has a machine.
    Here,
    /// What was planned and proven is all there is to try.
    None,
}

impl<'t> Trials<'t> {
    pub(super) fn of(
        request: Request<'t>,
        sources: &'t SourceMap,
        diagnostics: &[Diagnostic],
        machine: Machine,
        wanted: &Wanted,
    ) -> Self {
        Self {
            request,
            sources,
            errors: diagnostics.iter().map(named).collect(),
            budget: Budget::new(Size::TEXTS, wanted),
            known: Vec::new(),
            machine,
        }
    }

    /// Whether the job compiles with a change, or what is left of its errors was there before and does not hold all of them.
    pub(super) fn works(&mut self, edits: &[(Span, String)]) -> bool {
        match self.machine {
            Machine::None => return true,
            Machine::Here => {}
        }
        if let Some((_, works)) = self.known.iter().find(|(known, _)| known == edits) {
            return *works;
        }
        if self.budget.is_spent() {
            return false;
        }
        let (left, cuts) = self.compiled(edits).unzip();
        self.budget.spend(cuts.unwrap_or(0));
        if self.budget.wanted.is_needless() {
            return false;
        }
        let works = left.is_some_and(|left| self.is_better(&left));
        self.known.push((edits.to_vec(), works));
        works
    }

    fn is_better(&self, left: &[(Code, String)]) -> bool {
        left.len() < self.errors.len().max(1) && left.iter().all(|one| self.errors.contains(one))
    }

    /// The errors of the changed job, and how many cuts were planned to find them; none where it cannot be compiled at all.
    fn compiled(&self, edits: &[(Span, String)]) -> Option<(Vec<(Code, String)>, usize)> {
        let texts = edited(self.sources, edits)?;
        let loader = Overlay {
            texts: &texts,
            below: self.request.loader,
        };
        let choices = self.request.choices();
        let (mut sources, mut diagnostics) = (SourceMap::default(), Vec::new());
        let (_, job) = sema::check(
            self.request.path,
            &loader,
            choices,
            &mut sources,
            &mut diagnostics,
        )
        .ok()?;
        let job = job.filter(|_| !has_errors(&diagnostics))?;
        let mut run = Run {
            memory: &mut Memory::none(),
            wanted: &self.budget.wanted,
            patience: &mut Unhurried,
        };
        let chosen = families::decided(&job, &sources, &mut run, &mut |_| ());
        let (job, made) = chosen.map_or((job, None), |chosen| (chosen.decided.job, chosen.decided.made));
        let ended = compensation::ended(made, &job, &sources, &mut run, &mut |_| ());
        let (plan, left) = match ended {
            Ended::Compiled(made) => {
                let objections = target::objections(&job, &made.compiled, self.request);
                let left = objections
                    .iter()
                    .map(|objection| named(&objection.diagnostic))
                    .collect();
                (Some(*made.plan), left)
            }
            Ended::Refused(refused) => {
                let left = refused.at_once(&job).iter().map(named).collect();
                (refused.into_plan(), left)
            }
            Ended::Cancelled => return None,
        };
        Some((left, plan.as_ref().map_or(0, PlannedJob::cuts)))
    }
}

fn named(diagnostic: &Diagnostic) -> (Code, String) {
    (diagnostic.code, diagnostic.message.clone())
}

/// The job compiled with a change of its text, without help; none where the change does not fit the text or the job has errors then.
#[must_use]
pub fn changed(request: Request<'_>, sources: &SourceMap, edits: &[(Span, String)]) -> Option<Outcome> {
    let texts = edited(sources, edits)?;
    let loader = Overlay {
        texts: &texts,
        below: request.loader,
    };
    let outcome = compile_unhelped(Request {
        loader: &loader,
        ..request
    });
    outcome.ok().filter(|outcome| outcome.compiled.is_some())
}

/// The texts after a change, by the paths of their files.
fn edited(sources: &SourceMap, edits: &[(Span, String)]) -> Option<BTreeMap<String, String>> {
    let edits: Vec<Edit> = edits
        .iter()
        .map(|(span, replacement)| Edit {
            span: *span,
            replacement: replacement.clone(),
        })
        .collect();
    let files: BTreeSet<FileId> = edits.iter().map(|edit| edit.span.file).collect();
    files
        .into_iter()
        .map(|id| {
            let file = sources.get(id)?;
            Some((file.name.clone(), fix::apply(&file.text, id, &edits)?))
        })
        .collect()
}
