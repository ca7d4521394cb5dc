//! What a job leaves open falls back where its machine does not follow: to other routes, then to narrower swings.
//!
//! The candidates are a sequence, since what was refused decides what comes next. Those that do not look promising are not
//! planned; how many plans are put to the machine is bounded by [`Size::FALLBACKS`].

use crate::budget::{Budget, Size};
use crate::trial::looks_promising;
use vcutc_backend_api::units::Angle;
use vcutc_cancellation::Wanted;
use vcutc_job::operation::Swing;
use vcutc_job::search::{Lack, Narrowed, RouteSet, SearchSpace};
use vcutc_job::{CheckedJob, Order, PlannedJob};
use vcutc_motion::path::Violation;
use vcutc_motion::solve::{Changes, Unreachable, Unreached};
use vcutc_motion::trouble::Failing;

/// Narrower swings that are tried for a faster route, where a slower one is already followed.
const MOST_FOR_A_FASTER_ROUTE: usize = 2;

/// By which factor swings are narrowed while a promising one is searched for.
const NARROWER: f64 = 0.95;

/// The narrowest swing that is looked at.
const NARROWEST: Angle = Angle::deg(10.0);

/// The plan that a job makes of itself, where its machine does not follow it and another one was taken.
#[derive(Clone, Debug)]
pub struct NotFollowed {
    pub plan: PlannedJob,
    /// What keeps the machine from it.
    pub unreachable: Unreachable,
}

/// What was tried for a job, and what is tried next.
pub struct Fallback<'j> {
    job: &'j CheckedJob,
    space: SearchSpace,
    budget: Budget,
    /// What was refused first.
    first: Option<Box<NotFollowed>>,
    /// Narrower swings that were tried for the route of the first plan.
    for_a_faster_route: usize,
}

impl<'j> Fallback<'j> {
    #[must_use]
    pub fn new(job: &'j CheckedJob, wanted: &Wanted) -> Self {
        Self {
            job,
            space: SearchSpace::along(RouteSet::Full),
            budget: Budget::new(Size::FALLBACKS, wanted),
            first: None,
            for_a_faster_route: 0,
        }
    }

    /// What the machine refused first, if it refused anything.
    #[must_use]
    pub fn into_first(self) -> Option<Box<NotFollowed>> {
        self.first
    }

    /// What is considered now.
    #[must_use]
    pub const fn space(&self) -> SearchSpace {
        self.space
    }

    /// Goes on to a narrower swing with which the machine may follow the first plan's route, where a slower route was taken.
    /// None where no swing is open, the first plan is not one of routes, or enough was tried.
    pub fn narrow_for_a_faster_route(&mut self) -> Option<SearchSpace> {
        let first = self.first.as_ref()?;
        let is_tried = self.for_a_faster_route >= MOST_FOR_A_FASTER_ROUTE || self.budget.is_out_of_cuts();
        if is_tried || self.budget.wanted.is_needless() {
            return None;
        }
        let failing = first.unreachable.trouble.hardest()?;
        let is_begin = self.for_a_faster_route == 0;
        if is_begin && (self.space.routes == RouteSet::Full || self.space.swing.is_some()) {
            return None;
        }
        let order = first.plan.operations.first()?.order();
        let space = self.narrower_swing(&first.plan, failing, &[order])?;
        self.for_a_faster_route += 1;
        self.space = space;
        Some(space)
    }

    /// Whether what the machine refuses now is what the job's message reports: beyond it, the compiler helped itself.
    #[must_use]
    pub const fn is_usual(&self) -> bool {
        self.space.swing.is_none() && is_by_point(self.space.routes)
    }

    /// How hard the machine is tried: less where routes come next whose refusal is the one that is reported.
    #[must_use]
    pub fn changes(&self, plan: &PlannedJob) -> Changes {
        match self.space.routes.narrower_than(plan) {
            Some(routes) if is_by_point(routes) => Changes::InTheAirOrElse,
            Some(_) | None => Changes::InTheAir,
        }
    }

    /// What to say of a search that was ended by its bound; nothing of one that looked at all there is.
    #[must_use]
    pub fn cut_short(&self) -> Option<String> {
        self.budget.is_spent().then(|| {
            format!(
                "{} plans with other routes or narrower swings were tried on the machine; the search ended there",
                self.budget.tries()
            )
        })
    }

    /// Goes on to what is considered where the machine does not follow a plan. Without effect where there is nothing left.
    pub fn narrow(&mut self, plan: &PlannedJob, unreached: &Unreached) -> bool {
        let unreachable = unreached.unreachable();
        if let (None, Some(unreachable)) = (&self.first, unreachable) {
            self.first = Some(Box::new(NotFollowed {
                plan: plan.clone(),
                unreachable: unreachable.clone(),
            }));
        }
        self.budget.spend(plan.cuts());
        if self.budget.is_spent() {
            return false;
        }
        let next = self.other_routes(plan).or_else(|| {
            let failing = unreachable?.trouble.hardest()?;
            self.narrower_swing(plan, failing, &[Order::Point, Order::Layer])
        });
        self.space = next.unwrap_or(self.space);
        next.is_some()
    }

    /// Fewer routes, but for those that do not look promising.
    fn other_routes(&self, plan: &PlannedJob) -> Option<SearchSpace> {
        let has_open_swing = self
            .job
            .operations
            .iter()
            .any(|operation| operation.swing() == Swing::Open);
        let mut next = self.space.routes.narrower_than(plan);
        while let Some(routes) = next {
            let is_checked = has_open_swing || !is_by_point(routes);
            if !is_checked || looks_promising(&in_rows(plan, routes.order(), None)) {
                break;
            }
            next = routes.narrower_than(plan);
        }
        next.map(|routes| SearchSpace { routes, ..self.space })
    }

    /// The widest of some narrower swings that looks promising in one of these orders.
    fn narrower_swing(&self, plan: &PlannedJob, failing: &Failing, orders: &[Order]) -> Option<SearchSpace> {
        let open = widest_open(plan)?;
        let now = self.space.swing.map_or(open, |swing| swing.widest.min(open));
        let least = self.least_swing();
        let mut swing = now;
        loop {
            swing = Angle::deg((swing.to_deg() * NARROWER * 10.0).floor() / 10.0);
            if swing < least || self.budget.wanted.is_needless() {
                return None;
            }
            let mut orders = orders.iter();
            if orders.any(|&order| looks_promising(&in_rows(plan, Some(order), Some(swing)))) {
                break;
            }
        }
        Some(SearchSpace {
            routes: RouteSet::Full,
            swing: Some(Narrowed {
                widest: swing,
                refused: self.space.swing.map_or(now, |swing| swing.refused),
                lack: self.space.swing.map_or(lack(failing), |swing| swing.lack),
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
}

/// Whether these routes lead from point to point, as those of a job that leaves them open.
const fn is_by_point(routes: RouteSet) -> bool {
    match routes {
        RouteSet::Full | RouteSet::ByPoint | RouteSet::RowsByPoint => true,
        RouteSet::ByLayer | RouteSet::RowsByLayer => false,
    }
}

/// A plan in rows, with this order and with swings no wider than this where they are open.
fn in_rows(plan: &PlannedJob, order: Option<Order>, swing: Option<Angle>) -> PlannedJob {
    let mut changed = plan.clone();
    for planned in &mut changed.operations {
        *planned = planned.in_rows(order, swing, plan.stock);
    }
    changed
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

/// What the machine lacks.
fn lack(failing: &Failing) -> Lack {
    match failing.worst.what {
        Violation::OutOfReach => Lack::Reach,
        Violation::Limit { axis, .. } => Lack::Range { axis },
        Violation::Rate { axis, rate } => Lack::Rate { axis, needed: rate },
        Violation::Singular(_) => Lack::Clearance,
    }
}
