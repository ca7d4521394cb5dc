//! Ways to cut an operation, written down as programs of their own and measured.

use super::Contender;
use crate::asked::{Objective, RoughVcut};
use crate::plan::decision::Standing;
use crate::plan::parameters::widest_swing;
use crate::plan::redundant::{Allowed, without_redundant};
use crate::plan::removable::Removable;
use crate::plan::{LaidOut, PlannedVcut, Work};
use vcutc_backend_api::units::{Area, Duration, Length};
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_cancellation::Wanted;
use vcutc_geometry::columns::Columns;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::offset::offset_up;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::Spine;
use vcutc_job::PlannedOperation;
use vcutc_job::follow::Along;
use vcutc_job::operation::Ground;
use vcutc_job::search::{OnMachine, RouteSet, SearchEffort};
use vcutc_job::{CheckedJob, PlanningJob};
use vcutc_process::lower::alone;
use vcutc_simulation::body;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::prove::{Bound, ColumnsBound, Made, replay_on};
use vcutc_simulation::report::area_under;
use vcutc_simulation::surface::Surface;
use vcutc_simulation::timing::{timing, total};

/// What may stay of what is to go before it is worth a word, as a share.
pub const LITTLE: f64 = 0.1;

/// How closely the most that is left is known.
pub(super) const MEASURED_TO: Length = Length::mm(1e-3);

/// What a plan comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Figures {
    pub(super) time: Duration,
    pub(super) cuts: usize,
    /// The most that is left: the machined contour's largest distance from the part.
    pub(super) height: Length,
    /// The longest edge in use.
    pub(super) edge: Length,
}

impl Figures {
    /// What an objective makes small: seconds, cuts, or millimetres.
    pub(super) const fn merit(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Time => self.time.to_s(),
            Objective::Cuts => self.cuts as f64,
            Objective::Scallop => self.height.to_mm(),
            Objective::BladeLoad => self.edge.to_mm(),
        }
    }
}

/// A job, and the work as one of its operations finds it.
pub(super) struct Bench<'j> {
    pub(super) job: PlanningJob<'j>,
    /// What the operations decided so far leave of the stock.
    before: Surface,
    /// Most cuts that the operation may have.
    pub(super) cuts_left: usize,
    /// The part with the operation's allowance.
    bound: Profile,
    pub(super) removable: Removable,
    pub(super) latitude: RouteSet,
    /// How hard the best is searched for.
    pub(super) effort: SearchEffort,
    /// What the machine makes of a program; none where plans are compared without it.
    pub(super) followed: Option<OnMachine>,
    /// Plans that are not wanted any more are not made.
    pub(super) wanted: Wanted,
}

impl<'j> Bench<'j> {
    pub(super) fn new(asked: &RoughVcut, ground: Ground<'j>) -> Self {
        let job = ground.job;
        Self {
            bound: bound(&job, asked),
            removable: Removable::new(&job.profile, asked),
            effort: job.effort,
            job,
            before: ground.before,
            cuts_left: ground.cuts_left,
            latitude: ground.space.routes,
            followed: None,
            wanted: ground.wanted,
        }
    }

    /// The same, with plans compared as the machine carries them out.
    pub(super) fn on_machine(self, followed: Option<OnMachine>) -> Self {
        Self { followed, ..self }
    }

    /// The same, searched with another effort.
    pub(super) fn with_effort(&self, effort: SearchEffort) -> Self {
        Self {
            effort,
            ..self.for_whom(&self.wanted)
        }
    }

    /// The same work for someone else.
    pub(super) fn for_whom(&self, wanted: &Wanted) -> Self {
        Self {
            job: self.job.clone(),
            before: self.before.clone(),
            cuts_left: self.cuts_left,
            bound: self.bound.clone(),
            removable: self.removable.clone(),
            latitude: self.latitude,
            effort: self.effort,
            followed: self.followed,
            wanted: wanted.clone(),
        }
    }

    /// The work as the operation finds it.
    pub(super) const fn work(&self) -> Work<'_> {
        Work {
            before: &self.before,
            bound: &self.bound,
            cuts_left: self.cuts_left,
        }
    }

    /// An operation without its redundant Vs; none where it needs all, where it leaves more than it may, or where what a V leaves depends
    /// on more than what is above it: beside narrower flanks, and on what stands steeper than its own.
    pub(super) fn thinned(&self, laid: &LaidOut) -> Option<LaidOut> {
        let (vcut, part): (_, &Profile) = (&laid.vcut, &self.job.profile);
        // A V along a column that takes nothing in one section may do so in another.
        if vcut.columns().is_some() {
            return None;
        }
        if vcut.narrowed().next().is_some() || !self.before.is_final_for(vcut.parameters.flanks.slope) {
            return None;
        }
        let allowed = self.allowed(laid)?;
        let vcut = without_redundant(vcut, allowed, part, &self.before, self.job.stock)?;
        let mut after = self.before.clone();
        vcut.cuts.iter().for_each(|cut| after.release(cut.vee()));
        self.clears_bodies(&vcut).then_some(LaidOut {
            vcut,
            after,
            strategies: laid.strategies,
        })
    }

    /// What else may stay, where redundant Vs are skipped: up to the limit on the scallop, and little of what
    /// is to go. None where an operation leaves more than it may as it is.
    fn allowed(&self, laid: &LaidOut) -> Option<Allowed> {
        let asked = &laid.vcut.asked;
        let [found, left] =
            [&self.before, &laid.after].map(|surface| surface.corners().collect::<Vec<Point2>>());
        let height = farthest(&left, &*self.job.profile).height;
        let limit = asked.limits.scallop.map(|limit| limit.value);
        if limit.is_some_and(|limit| height > limit + MEASURED_TO) {
            return None;
        }
        let [found, left] = [found, left].map(|contour| self.removable.under(&contour));
        let room = found * LITTLE - left;
        Some(Allowed {
            height: limit.unwrap_or(height + MEASURED_TO),
            area: room.max(Area::ZERO),
        })
    }

    /// Whether the body of the blade, where it is stated, stays out of the work.
    pub(super) fn clears_bodies(&self, vcut: &PlannedVcut) -> bool {
        if vcut.asked.blade.body.is_none() {
            return true;
        }
        let level = vcut.level();
        program(&self.job, &level).is_some_and(|program| {
            body::bodies(&program, &[bound_of(vcut, &level)])
                .contact
                .is_none()
        })
    }

    /// The result of an operation.
    pub(super) fn weigh(&self, laid: LaidOut) -> Contender {
        let vcut = &laid.vcut;
        let cuts = vcut.cuts.len();
        // Along a spine all sections are alike: what is right of a level cut, with as much more room, is right of it. Those
        // along columns stand for chains; a fan is proven as it is cut.
        let level = vcut.level();
        let Some(program) = program(&self.job, &level) else {
            return Contender {
                laid,
                standing: Standing::Impossible,
                figures: Figures {
                    time: Duration::ZERO,
                    cuts,
                    height: Length::ZERO,
                    edge: Length::ZERO,
                },
                residual: Area::ZERO,
            };
        };
        let replay = replay_on(self.before.clone(), &program, &[bound_of(vcut, &level)]);
        let failing = replay.findings.iter().map(|(count, _)| count).sum();
        let corners: Vec<_> = replay.surface.corners().collect();
        let part = self.job.profile.area_below(0.0, self.job.stock.width.to_mm());
        let height = farthest(&corners, &*self.job.profile).height;
        let (standing, time) = match failing {
            0 => self.timed_as(vcut, &program),
            _ => (Standing::Fails(failing), as_long_as_its_way(vcut, &program)),
        };
        Contender {
            laid,
            standing,
            figures: Figures {
                time,
                cuts,
                height,
                edge: replay.longest_edge,
            },
            residual: Area::mm2(area_under(&corners)) - part,
        }
    }

    /// The result of an operation, judged by the limits of what is asked for.
    pub(super) fn judged(&self, laid: LaidOut, asked: &RoughVcut) -> Contender {
        let limit = asked.limits.scallop.map(|limit| limit.value);
        self.weigh(laid).held_to(limit, asked)
    }

    /// How long an operation takes, and its result, on the machine where plans are compared on it; none where
    /// the compiler is at fault, which the proof of the whole then shows.
    pub(super) fn timed(&self, vcut: &PlannedVcut) -> Option<(Standing, Duration)> {
        let program = program(&self.job, &vcut.level())?;
        Some(self.timed_as(vcut, &program))
    }

    fn timed_as(&self, vcut: &PlannedVcut, level: &VerifiedProgram) -> (Standing, Duration) {
        let (Some(OnMachine(followed)), Some(machine)) = (self.followed, &self.job.machine) else {
            let time = as_long_as_its_way(vcut, level);
            return (Standing::Takes(time), time);
        };
        let carried_out = followed(machine, level.program()).and_then(|program| verify(program).ok());
        match carried_out {
            Some(carried_out) => {
                let time = as_long_as_its_way(vcut, &carried_out);
                (Standing::Takes(time), time)
            }
            None => (Standing::NotFollowed, as_long_as_its_way(vcut, level)),
        }
    }
}

/// The part with an operation's allowance. Where the way rises, its ball is taken for one that is as high as the ellipse that it
/// makes across the cuts: over a slope `m` of the spine that is `sqrt(1 + m^2)` times as high as wide. Of columns what the lower ends
/// of their tips must stay above.
fn bound(job: &PlanningJob<'_>, asked: &RoughVcut) -> Profile {
    if let Some(columns) = asked.along.as_ref().and_then(|along| along.guide.columns()) {
        // No flank that may be chosen is flatter.
        let flattest = 1.0 / widest_swing(asked).tan();
        return columns.section(flattest, asked.allowance.value);
    }
    let steepness = asked.along.as_ref().map_or(1.0, Along::steepness);
    offset_up(&job.profile, asked.allowance.value * steepness)
}

/// What the level cuts of an operation must stay out of, with all the room that cuts along a spine need; where they stand for chains along
/// columns, just what these must.
fn bound_of<'v>(vcut: &'v PlannedVcut, level: &'v PlannedVcut) -> Bound<'v> {
    if let (Some(along), Some(columns)) = (&vcut.asked.along, vcut.columns()) {
        let bound = PlannedOperation::bound(vcut);
        let made = match columns.is_fan() {
            true => Made::AsChains,
            false => Made::Level(along.deviation(vcut.parameters.flanks.slope)),
        };
        let columns = bound.columns.map(|columns| ColumnsBound { made, ..columns });
        return Bound { columns, ..bound };
    }
    Bound {
        drop: level.parameters.drop,
        lower: level.parameters.flanks.lower,
        ..PlannedOperation::bound(level)
    }
}

/// An operation as a program of its own.
fn program(job: &CheckedJob, vcut: &PlannedVcut) -> Option<VerifiedProgram> {
    verify(alone(job, vcut)).ok()
}

/// How long an operation takes whose cuts were made level: along their spine or columns they take longer as these are longer.
fn as_long_as_its_way(vcut: &PlannedVcut, level: &VerifiedProgram) -> Duration {
    let columns = vcut.columns().filter(|columns| !columns.is_fan());
    let lengthening = vcut.spine().map(Spine::lengthening);
    match lengthening.or(columns.map(Columns::lengthening)) {
        None => total(level),
        Some(lengthening) => {
            let timing = timing(level).all;
            timing.total() + timing.cutting * (lengthening - 1.0)
        }
    }
}
