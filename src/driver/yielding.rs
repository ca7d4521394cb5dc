//! How what a job leaves open yields to its machine: other routes, then narrower swings, until the machine follows.
//!
//! A program that fails as a whole is dear to refute. Whether the cuts of an order, or of a swing, can be followed at all, a
//! few telling motions say much sooner ([`TellingMotions`]): those that they rule out are not planned. How many plans are
//! proven is bounded by [`MOST_PLANS`], and for jobs of many cuts by [`MOST_CUTS_PUT`].

use vcutc_backend_api::units::Angle;
use vcutc_backend_api::verify::verify;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::PlannedJob;
use vcutc_job::operation::Swing;
use vcutc_job::search::{Lack, Narrowed, RouteSet, SearchSpace};
use vcutc_job::{CheckedJob, Order};
use vcutc_motion::path::Violation;
use vcutc_motion::place::motions::TellingMotions;
use vcutc_motion::rig::Rig;
use vcutc_motion::solve::{Changes, Unreachable, Unreached};
use vcutc_motion::trouble::Trouble;
use vcutc_process::lower;

/// Most plans that are put to the machine.
const MOST_PLANS: usize = 10;

/// Plans that are put to the machine however many cuts they have: every kind of route, and a narrower swing.
const LEAST_PLANS: usize = 4;

/// Most cuts of all plans together that are put to the machine, beyond [`LEAST_PLANS`].
const MOST_CUTS_PUT: usize = 1_500;

/// Narrower swings that are tried for a faster route, where a slower one is already followed.
const MOST_FOR_A_FASTER_ROUTE: usize = 2;

/// By which factor swings are narrowed while one is looked for whose telling motions are followed.
const NARROWER: f64 = 0.95;

/// The narrowest swing that is looked at.
const NARROWEST: Angle = Angle::deg(10.0);

/// The plan that a job makes of itself, where its machine does not follow it and another one was taken.
#[derive(Clone, Debug)]
pub struct Yielded {
    pub plan: PlannedJob,
    /// What keeps the machine from it.
    pub unreachable: Unreachable,
}

/// What was tried for a job, and what is tried next.
pub(super) struct Yielding<'j> {
    job: &'j CheckedJob,
    space: SearchSpace,
    plans: usize,
    /// The cuts of all plans so far.
    cuts: usize,
    ended: Ended,
    wanted: &'j Wanted,
    /// What was refused first.
    first: Option<Box<Yielded>>,
    /// Narrower swings that were tried for the route of the first plan.
    for_a_faster_route: usize,
}

/// Why nothing more is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ended {
    /// There is nothing left, or something more is tried.
    ByItself,
    /// So many plans are enough.
    AtTheBound,
}

impl<'j> Yielding<'j> {
    pub(super) const fn new(job: &'j CheckedJob, wanted: &'j Wanted) -> Self {
        Self {
            job,
            space: SearchSpace::along(RouteSet::Full),
            plans: 0,
            cuts: 0,
            ended: Ended::ByItself,
            wanted,
            first: None,
            for_a_faster_route: 0,
        }
    }

    /// What the machine refused first, if it refused anything.
    pub(super) fn into_first(self) -> Option<Box<Yielded>> {
        self.first
    }

    /// What is considered now.
    pub(super) const fn space(&self) -> SearchSpace {
        self.space
    }

    /// Goes on to a narrower swing with which the machine may follow the first plan's route, where a slower route came out.
    /// None where no swing is open, the first plan is not one of routes, or enough was tried.
    pub(super) fn narrow_for_a_faster_route(&mut self) -> Option<SearchSpace> {
        let first = self.first.as_ref()?;
        let is_tried = self.for_a_faster_route >= MOST_FOR_A_FASTER_ROUTE || self.cuts >= MOST_CUTS_PUT;
        if is_tried || self.wanted.is_needless() {
            return None;
        }
        let lack = match &first.unreachable.trouble {
            trouble @ (Trouble::Motion { .. } | Trouble::NoCommonBranch { .. }) => lack(trouble),
            Trouble::Way { .. } | Trouble::Sweep(_) | Trouble::Nowhere => return None,
        };
        let is_begin = self.for_a_faster_route == 0;
        if is_begin && (self.space.routes == RouteSet::Full || self.space.swing.is_some()) {
            return None;
        }
        let order = first.plan.operations.first()?.order();
        let space = self.narrower_swing(&first.plan, lack, &[order])?;
        self.for_a_faster_route += 1;
        self.space = space;
        Some(space)
    }

    /// Whether what the machine refuses now is what the job is told of: beyond it, the compiler helped itself.
    pub(super) const fn is_usual(&self) -> bool {
        self.space.swing.is_none()
            && match self.space.routes {
                RouteSet::Full | RouteSet::ByPoint | RouteSet::RowsByPoint => true,
                RouteSet::ByLayer | RouteSet::RowsByLayer => false,
            }
    }

    /// How hard the machine is tried: less where routes come next whose refusal is the one that is told.
    pub(super) fn changes(&self, plan: &PlannedJob) -> Changes {
        match self.space.routes.narrower_than(plan) {
            Some(RouteSet::Full | RouteSet::ByPoint | RouteSet::RowsByPoint) => Changes::InTheAirOrElse,
            Some(RouteSet::ByLayer | RouteSet::RowsByLayer) | None => Changes::InTheAir,
        }
    }

    /// What to say of a search that was ended by its bound; nothing of one that looked at all there is.
    pub(super) fn cut_short(&self) -> Option<String> {
        match self.ended {
            Ended::ByItself => None,
            Ended::AtTheBound => Some(format!(
                "{} plans with other routes or narrower swings were tried on the machine; the search ended there",
                self.plans
            )),
        }
    }

    /// Goes on to what is considered where the machine does not follow a plan. Without effect where there is nothing left.
    pub(super) fn narrow(&mut self, plan: &PlannedJob, unreached: &Unreached) -> bool {
        self.plans += 1;
        if let (None, Unreached::Unreachable(unreachable)) = (&self.first, unreached) {
            self.first = Some(Box::new(Yielded {
                plan: plan.clone(),
                unreachable: (**unreachable).clone(),
            }));
        }
        self.cuts += plan.cuts();
        let is_enough = self.plans >= LEAST_PLANS && self.cuts >= MOST_CUTS_PUT;
        if self.plans >= MOST_PLANS || is_enough || self.wanted.is_needless() {
            self.ended = Ended::AtTheBound;
            return false;
        }
        let next = self.other_routes(plan).or_else(|| match trouble(unreached)? {
            trouble @ (Trouble::Motion { .. } | Trouble::NoCommonBranch { .. }) => {
                self.narrower_swing(plan, lack(trouble), &[Order::Point, Order::Layer])
            }
            Trouble::Way { .. } | Trouble::Sweep(_) | Trouble::Nowhere => None,
        });
        self.space = next.unwrap_or(self.space);
        next.is_some()
    }

    /// Fewer routes, but for those whose telling motions are not followed.
    fn other_routes(&self, plan: &PlannedJob) -> Option<SearchSpace> {
        let has_open_swing = self
            .job
            .operations
            .iter()
            .any(|operation| operation.swing() == Swing::Open);
        let mut next = self.space.routes.narrower_than(plan);
        while let Some(routes) = next {
            let is_checked = has_open_swing
                || match routes {
                    RouteSet::Full | RouteSet::ByPoint | RouteSet::RowsByPoint => false,
                    RouteSet::ByLayer | RouteSet::RowsByLayer => true,
                };
            if !is_checked || self.is_followed(plan, routes.order(), None) {
                break;
            }
            next = routes.narrower_than(plan);
        }
        next.map(|routes| SearchSpace { routes, ..self.space })
    }

    /// The widest of some narrower swings whose telling motions are followed in one of these orders.
    fn narrower_swing(&self, plan: &PlannedJob, lack: Lack, orders: &[Order]) -> Option<SearchSpace> {
        let open = widest_open(plan)?;
        let now = self.space.swing.map_or(open, |swing| swing.widest.min(open));
        let least = self.least_swing();
        let mut swing = now;
        loop {
            swing = Angle::deg((swing.to_deg() * NARROWER * 10.0).floor() / 10.0);
            if swing < least || self.wanted.is_needless() {
                return None;
            }
            let mut orders = orders.iter();
            if orders.any(|&order| self.is_followed(plan, Some(order), Some(swing))) {
                break;
            }
        }
        Some(SearchSpace {
            routes: RouteSet::Full,
            swing: Some(Narrowed {
                widest: swing,
                refused: self.space.swing.map_or(now, |swing| swing.refused),
                lack: self.space.swing.map_or(lack, |swing| swing.lack),
            }),
        })
    }

    /// The narrowest swing that all open ones may be held to.
    fn least_swing(&self) -> Angle {
        let operations = self.job.operations.iter();
        let limits = operations.filter_map(|operation| operation.narrowest_swing());
        limits.fold(
            NARROWEST,
            |least, limit| if limit > least { limit } else { least },
        )
    }

    /// Whether the machine follows a plan's telling motions, in rows, with this order and with swings no wider than this
    /// where they are open.
    fn is_followed(&self, plan: &PlannedJob, order: Option<Order>, swing: Option<Angle>) -> bool {
        let Some(machine) = &self.job.machine else {
            return true;
        };
        let mut changed = plan.clone();
        for planned in &mut changed.operations {
            *planned = planned.in_rows(order, swing, plan.stock);
        }
        let Ok(program) = verify(lower::lower(&changed, &SourceMap::default())) else {
            return true;
        };
        let rig = Rig::new(&machine.model, machine.tool.value.frame, machine.base.value.frame);
        TellingMotions::of(program.program()).are_each_followed(&rig)
    }
}

/// The widest of the swings that the job leaves open.
fn widest_open(plan: &PlannedJob) -> Option<Angle> {
    let open = plan
        .operations
        .iter()
        .filter(|planned| planned.asked().swing() == Swing::Open);
    let swings = open.map(|planned| planned.swing());
    swings.reduce(|one, other| if other > one { other } else { one })
}

/// What the machine lacks, where it lacks most.
fn lack(trouble: &Trouble) -> Lack {
    let failing = match trouble {
        Trouble::Motion { failing, hardest, .. } => hardest.as_ref().unwrap_or(failing),
        Trouble::NoCommonBranch { failing, .. } => failing,
        Trouble::Way { .. } | Trouble::Sweep(_) | Trouble::Nowhere => return Lack::Reach,
    };
    match failing.worst.what {
        Violation::OutOfReach => Lack::Reach,
        Violation::Limit { axis, .. } => Lack::Range { axis },
        Violation::Rate { axis, rate } => Lack::Rate { axis, needed: rate },
        Violation::Singular(_) => Lack::Clearance,
    }
}

fn trouble(unreached: &Unreached) -> Option<&Trouble> {
    match unreached {
        Unreached::Unreachable(unreachable) => Some(&unreachable.trouble),
        Unreached::Rules(_) | Unreached::Motion(_) => None,
    }
}
