//! The stages from the plan on, along the routes that a job may take.
//!
//! The fastest routes and the widest swings ask the most of a machine. Where it does not follow, even with slower turns
//! ([`reaching`]), plans are compared on the machine, and then fewer routes and narrower swings are planned ([`Fallback`]). Plans are
//! compared on the machine also where slower turns cost time. Slower routes come before narrower swings, since they leave the
//! lattice as it is. But a narrower swing may let the machine follow the faster route, and cost less than the slower one: that is
//! compiled too, and the faster is taken.

use super::reaching::{CarriedOut, Slowed};
use super::refusal::{NotCarriedOut, Refused};
use super::{Compiled, Finished, Run, Stage, axis_moves, compiled, internal, reaching, rules_broken};
use vcutc_backend_api::units::Duration;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Diagnostic, has_errors};
use vcutc_job::operation::Aim;
use vcutc_job::search::SearchSpace;
use vcutc_job::{CheckedJob, PlannedJob};
use vcutc_motion::ceiling;
use vcutc_motion::solve::{Changes, Unreached};
use vcutc_process::plan;
use vcutc_process::verdict::{self, Proven};
use vcutc_remedy::fallback::Fallback;
use vcutc_remedy::farther_out;

/// Slower turns make a program slow where they take this share of its time.
const SLOW: f64 = 0.01;

/// How far a job came.
pub(super) enum Ended<'j> {
    /// It cannot be planned, is not sound, or its machine does not carry it out, along whatever route.
    Refused(Refused<'j>),
    Compiled(Made),
    /// The answer is not wanted any more.
    Cancelled,
}

/// A plan that the machine follows.
pub(super) struct Made {
    pub(super) plan: Box<PlannedJob>,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) compiled: Box<Compiled>,
    /// None where the machine follows all turns at the rate that the job states.
    pub(super) slowed: Option<Box<Slowed>>,
}

impl Made {
    pub(super) fn time(&self) -> Duration {
        self.compiled.report.times.all.total()
    }
}

/// Compiles a checked job.
pub(super) fn along_its_routes<'j>(
    job: &'j CheckedJob,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Ended<'j> {
    let fallback = Fallback::new(job, run.wanted);
    progress(Stage::Planning);
    let first = run.memory.choose(job, fallback.space(), run.wanted);
    if run.wanted.is_needless() {
        return Ended::Cancelled;
    }
    let search = Search {
        job,
        sources,
        fallback,
        settled: None,
        run,
        progress,
    };
    match first {
        Ok(plan) => search.followed(plan),
        Err(why) => Ended::Refused(Refused::Unplanned(why)),
    }
}

struct Search<'j, 's, 'r> {
    job: &'j CheckedJob,
    sources: &'s SourceMap,
    fallback: Fallback<'j>,
    /// Limits that the first plan of a swing chose hold for all others, as if the job had set them.
    settled: Option<CheckedJob>,
    run: &'s mut Run<'r>,
    progress: &'s mut dyn FnMut(Stage),
}

/// A plan with nothing wrong, as far as the operations see it.
struct Sound {
    plan: PlannedJob,
    proven: Proven,
    warnings: Vec<Diagnostic>,
}

impl<'j> Search<'j, '_, '_> {
    /// The first plan that the machine follows, or a faster one.
    fn followed(mut self, mut plan: PlannedJob) -> Ended<'j> {
        let mut refused: Option<Box<NotCarriedOut>> = None;
        loop {
            // Proofs of long programs take as long as their plans.
            if self.run.wanted.is_needless() {
                return Ended::Cancelled;
            }
            if self.settled.is_none() {
                self.settled = plan::settled(self.job, &plan);
            }
            let sound = match (self.proven(plan), refused.take()) {
                (Ok(sound), before) => {
                    refused = before;
                    sound
                }
                // What the machine did not follow was sound, and is what is reported.
                (Err(Refused::Unsound(..)), Some(before)) => return unreached(before),
                (Err(why), _) => return Ended::Refused(why),
            };
            if self.run.wanted.is_needless() {
                return Ended::Cancelled;
            }
            let changes = self.fallback.changes(&sound.plan);
            let this = match self.carried_out(sound, changes) {
                Ok(made) => return self.or_faster(made),
                Err(_) if self.run.wanted.is_needless() => return Ended::Cancelled,
                Err(this) => this,
            };
            let reported = match self.fall_back(this, refused) {
                Ok(reported) => reported,
                Err(last) => return unreached(last),
            };
            (self.progress)(Stage::Planning);
            let within = self.settled.as_ref().unwrap_or(self.job);
            let next = self
                .run
                .memory
                .choose(within, self.fallback.space(), self.run.wanted);
            plan = match next {
                _ if self.run.wanted.is_needless() => return Ended::Cancelled,
                Ok(next) => reaching::as_asked(next, self.job),
                Err(_) => return unreached(reported),
            };
            refused = Some(reported);
        }
    }

    /// Goes on to what is considered next, and gives what is reported if that fails too.
    ///
    /// # Errors
    /// What is reported, where nothing is left to consider.
    fn fall_back(
        &mut self,
        this: Box<NotCarriedOut>,
        before: Option<Box<NotCarriedOut>>,
    ) -> Result<Box<NotCarriedOut>, Box<NotCarriedOut>> {
        let within = self.settled.as_ref().unwrap_or(self.job);
        if let Some(roomier) = farther_out(within, &this.plan, &this.unreached) {
            self.settled = Some(roomier);
            return Ok(before.unwrap_or(this));
        }
        let is_usual = self.fallback.is_usual();
        let before_it = self.fallback.space();
        let goes_on = self.fallback.narrow(&this.plan, &this.unreached);
        // What little is left depends on the swing: with another one the limit is chosen again.
        let space = self.fallback.space();
        if (space.swing, space.machine) != (before_it.swing, before_it.machine) {
            self.settled = None;
        }
        let mut reported = match before {
            Some(usual) if !is_usual => usual,
            Some(_) | None => this,
        };
        if goes_on {
            return Ok(reported);
        }
        reported.cut_short = self.fallback.cut_short();
        Err(reported)
    }

    /// This plan, or a faster one with a narrower swing along the route that was left out.
    fn or_faster(mut self, mut best: Made) -> Ended<'j> {
        let mut operations = self.job.operations.iter();
        if operations.all(|operation| operation.aim() == Aim::Time) {
            // Limits that the compiler chose are kept: what leaves more on the part is not faster.
            let within = plan::settled(self.job, &best.plan).unwrap_or_else(|| self.job.clone());
            if let Some(found) = self.on_machine(&best, &within) {
                best = found;
            }
            while let Some(space) = self.fallback.narrow_for_a_faster_route() {
                match self.faster(best.time(), &within, space) {
                    Narrower::Faster(found) => {
                        best = found;
                        break;
                    }
                    Narrower::Slower => break,
                    Narrower::NotFollowed => {}
                }
            }
        }
        if self.run.wanted.is_needless() {
            return Ended::Cancelled;
        }
        best.compiled.not_followed = self.fallback.into_first();
        Ended::Compiled(best)
    }

    /// A faster plan of those that are compared on the machine, where slower turns make this one slow.
    fn on_machine(&mut self, best: &Made, within: &CheckedJob) -> Option<Made> {
        let slowed = best.slowed.as_ref()?;
        let slower = best.compiled.program.reached()?.report.slower?;
        if slower.longer < best.time() * SLOW {
            return None;
        }
        let space = self.fallback.search_on_machine(&best.plan, &slowed.unreachable)?;
        match self.faster(best.time(), within, space) {
            Narrower::Faster(found) => Some(found),
            Narrower::Slower | Narrower::NotFollowed => None,
        }
    }

    fn faster(&mut self, than: Duration, within: &CheckedJob, space: SearchSpace) -> Narrower {
        (self.progress)(Stage::Planning);
        let Ok(plan) = self.run.memory.choose(within, space, self.run.wanted) else {
            return Narrower::Slower;
        };
        if self.run.wanted.is_needless() {
            return Narrower::Slower;
        }
        let Ok(sound) = self.proven(reaching::as_asked(plan, self.job)) else {
            return Narrower::Slower;
        };
        if sound.proven.report.times.all.total() >= than {
            return Narrower::Slower;
        }
        match self.carried_out(sound, Changes::InTheAir) {
            Ok(made) if made.time() < than => Narrower::Faster(made),
            Ok(_) => Narrower::Slower,
            Err(_) => Narrower::NotFollowed,
        }
    }

    /// Proves a plan.
    fn proven(&mut self, plan: PlannedJob) -> Result<Sound, Refused<'j>> {
        (self.progress)(Stage::Proving);
        let proven = match verdict::prove(&plan, self.sources) {
            Ok(proven) => proven,
            Err(faults) => {
                let fault = internal(self.job, &rules_broken(&faults));
                return Err(Refused::Broken(Box::new(plan), Box::new(fault)));
            }
        };
        let warnings = verdict::diagnose_while(self.job, &plan, &proven, &Wanted::never(), &mut |_| false);
        if has_errors(&warnings) {
            return Err(Refused::Unsound(Box::new(plan), Box::new(proven)));
        }
        Ok(Sound {
            plan,
            proven,
            warnings,
        })
    }

    /// Whether a plan keeps its limits on time with slower turns too.
    fn keeps_limits(&self, plan: &PlannedJob, program: &Finished, slowed: &Slowed) -> bool {
        let program = program.verified().program();
        let longer = |operation| ceiling::longer_in(&slowed.stated, program, operation);
        verdict::limits_broken_by(self.job, plan, longer).is_empty()
    }

    /// Puts a plan to the machine.
    fn carried_out(&mut self, sound: Sound, changes: Changes) -> Result<Made, Box<NotCarriedOut>> {
        let Sound {
            plan,
            proven,
            mut warnings,
        } = sound;
        match reaching::reach(self.job, proven.program, changes, self.run, self.progress) {
            Ok(CarriedOut {
                program,
                slowed: Some(slowed),
            }) if !self.keeps_limits(&plan, &program, &slowed) => Err(Box::new(NotCarriedOut {
                plan,
                warnings,
                unreached: Unreached::Unreachable(Box::new(slowed.unreachable)),
                cut_short: None,
            })),
            Ok(CarriedOut { program, slowed }) => {
                let reached = program.reached();
                warnings.extend(reached.and_then(|reached| axis_moves::many(self.job, reached)));
                let compiled = compiled(self.job, program, &plan, proven.report, self.sources);
                Ok(Made {
                    plan: Box::new(plan),
                    warnings,
                    compiled: Box::new(compiled),
                    slowed,
                })
            }
            Err(unreached) => Err(Box::new(NotCarriedOut {
                plan,
                warnings,
                unreached,
                cut_short: None,
            })),
        }
    }
}

/// The result of a narrower swing.
enum Narrower {
    Faster(Made),
    /// It takes as long or longer, or there is no such plan.
    Slower,
    /// The machine does not follow it.
    NotFollowed,
}

fn unreached<'j>(refused: Box<NotCarriedOut>) -> Ended<'j> {
    Ended::Refused(Refused::Unreached(refused))
}
