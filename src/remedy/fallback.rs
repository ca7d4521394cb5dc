//! What a job leaves open falls back where its machine does not follow: to plans that are compared on the machine, to other routes,
//! then to narrower swings.
//!
//! The candidates are a sequence, since what was refused decides what comes next. Those that do not look promising are not
//! planned; how many plans are put to the machine is bounded by [`Size::FALLBACKS`].

use crate::budget::{Budget, Size};
use crate::trial::{looks_promising, on_machine};
use vcutc_backend_api::units::Angle;
use vcutc_cancellation::Wanted;
use vcutc_job::operation::Swing;
use vcutc_job::search::{Followed, Lack, Narrowed, OnMachine, RouteSet, SearchSpace};
use vcutc_job::{CheckedJob, Order, PlannedJob};
use vcutc_motion::path::Violation;
use vcutc_motion::solve::{Changes, Unreachable, Unreached};
use vcutc_motion::trouble::Failing;

/// Narrower swings that are tried for a faster route, where a slower one is already followed.
const MOST_FOR_A_FASTER_ROUTE: usize = 2;

/// By which factor swings are narrowed at least.
const NARROWER: f64 = 0.95;

/// A swing of at least this share of another one counts as the same.
const NEARLY: f64 = 0.995;

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
    /// Whether plans were compared on the machine.
    was_on_machine: bool,
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
            was_on_machine: false,
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
        self.space.swing.is_none() && self.space.machine.is_none() && is_by_point(self.space.routes)
    }

    /// How hard the machine is tried: less where routes come next whose refusal is the one that is reported.
    #[must_use]
    pub fn changes(&self, plan: &PlannedJob) -> Changes {
        match plan.routes_below(self.space.routes) {
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
        if let Some(unreachable) = unreachable {
            self.note(plan, unreachable);
        }
        self.budget.spend(plan.cuts());
        if self.budget.is_spent() {
            return false;
        }
        let next = self
            .on_machine(plan)
            .or_else(|| self.elsewhere(plan, unreachable));
        self.space = next.unwrap_or(self.space);
        next.is_some()
    }

    /// Notes what the machine refused, if that is the first.
    fn note(&mut self, plan: &PlannedJob, unreachable: &Unreachable) {
        if self.first.is_none() {
            self.first = Some(Box::new(NotFollowed {
                plan: plan.clone(),
                unreachable: unreachable.clone(),
            }));
        }
    }

    /// Goes on to plans that are compared on the machine, which makes this one slow.
    pub fn search_on_machine(&mut self, plan: &PlannedJob, refused: &Unreachable) -> Option<SearchSpace> {
        self.note(plan, refused);
        let space = self.on_machine(plan)?;
        self.space = space;
        Some(space)
    }

    /// All that is open, compared on the machine: once, and only after the best plan of all.
    fn on_machine(&mut self, plan: &PlannedJob) -> Option<SearchSpace> {
        if self.was_on_machine || self.space != SearchSpace::along(RouteSet::Full) {
            return None;
        }
        self.was_on_machine = true;
        let failing = self.first.as_ref()?.unreachable.trouble.hardest()?;
        let is_open = widest_open(plan).is_some() || plan.routes_below(RouteSet::Full).is_some();
        if !is_open {
            return None;
        }
        let machine = Some(Followed {
            by: OnMachine(on_machine),
            refused: widest_open(plan),
            lack: lack(failing),
        });
        let Some(now) = self.widest_now(plan) else {
            return Some(SearchSpace {
                machine,
                ..self.space
            });
        };
        let widest = self.widest_promising(plan, now, &[Order::Point, Order::Layer])?;
        let swing = (widest < now * NEARLY).then(|| self.narrowed(now, widest, failing));
        Some(SearchSpace {
            swing,
            machine,
            ..self.space
        })
    }

    /// Fewer routes, and then narrower swings; from the first plan on, where none that was compared on the machine is followed.
    fn elsewhere(&mut self, plan: &PlannedJob, unreachable: Option<&Unreachable>) -> Option<SearchSpace> {
        if self.space.machine.is_some() {
            self.space = SearchSpace::along(RouteSet::Full);
            let first = self.first.take()?;
            let next = self.elsewhere(&first.plan, Some(&first.unreachable));
            self.first = Some(first);
            return next;
        }
        self.other_routes(plan).or_else(|| {
            let failing = unreachable?.trouble.hardest()?;
            self.narrower_swing(plan, failing, &[Order::Point, Order::Layer])
        })
    }

    /// Fewer routes, but for those that do not look promising.
    fn other_routes(&self, plan: &PlannedJob) -> Option<SearchSpace> {
        let has_open_swing = self
            .job
            .operations
            .iter()
            .any(|operation| operation.swing() == Swing::Open);
        let mut next = plan.routes_below(self.space.routes);
        while let Some(routes) = next {
            let is_checked = has_open_swing || !is_by_point(routes);
            if !is_checked || looks_promising(&in_rows(plan, routes.order(), None)) {
                break;
            }
            next = plan.routes_below(routes);
        }
        next.map(|routes| SearchSpace { routes, ..self.space })
    }

    /// A narrower swing that looks promising in one of these orders.
    fn narrower_swing(&self, plan: &PlannedJob, failing: &Failing, orders: &[Order]) -> Option<SearchSpace> {
        let now = self.widest_now(plan)?;
        let swing = self.widest_promising(plan, now * NARROWER, orders)?;
        Some(SearchSpace {
            machine: None,
            routes: RouteSet::Full,
            swing: Some(self.narrowed(now, swing, failing)),
        })
    }

    /// The widest swing that is considered now.
    fn widest_now(&self, plan: &PlannedJob) -> Option<Angle> {
        let open = widest_open(plan)?;
        Some(self.space.swing.map_or(open, |swing| swing.widest.min(open)))
    }

    fn narrowed(&self, now: Angle, widest: Angle, failing: &Failing) -> Narrowed {
        Narrowed {
            widest,
            refused: self.space.swing.map_or(now, |swing| swing.refused),
            lack: self.space.swing.map_or(lack(failing), |swing| swing.lack),
        }
    }

    /// The widest swing up to this one that looks promising in one of these orders, to a tenth of a degree.
    fn widest_promising(&self, plan: &PlannedJob, most: Angle, orders: &[Order]) -> Option<Angle> {
        let is_promising = |swing: u32| {
            let mut orders = orders.iter();
            !self.budget.wanted.is_needless()
                && orders.any(|&order| looks_promising(&in_rows(plan, Some(order), Some(in_degrees(swing)))))
        };
        let [least, most] = [self.least_swing(), most].map(tenths);
        widest(is_promising, [least, most]).map(in_degrees)
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

/// The largest number from the first of these up to the second for which something holds, where it holds for all below that number;
/// elsewhere one for which it holds and for the next it does not. None where it is not found to hold for any.
fn widest(holds: impl Fn(u32) -> bool, [least, most]: [u32; 2]) -> Option<u32> {
    let mut yes = most;
    let mut no = most.saturating_add(1);
    while yes < least || !holds(yes) {
        if yes <= least {
            return None;
        }
        no = yes;
        yes = (yes * 9 / 10).max(least);
    }
    while no - yes > 1 {
        let middle = yes.midpoint(no);
        if holds(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
    Some(yes)
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

/// A swing in tenths of a degree, rounded down.
fn tenths(swing: Angle) -> u32 {
    // At most 900.
    (swing.to_deg() * 10.0) as u32
}

fn in_degrees(tenths: u32) -> Angle {
    Angle::deg(f64::from(tenths) / 10.0)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_swing_is_found_to_its_unit() {
        for least in [100, 300, 550] {
            for edge in 0..=600 {
                let found = widest(|swing| swing <= edge, [least, 600]);
                assert_eq!(found, (edge >= least).then_some(edge), "{least}");
            }
        }
        assert_eq!(widest(|_| false, [100, 600]), None);
        assert_eq!(widest(|_| true, [100, 600]), Some(600));
        assert_eq!(widest(|_| true, [100, 90]), None);
    }

    #[test]
    fn of_several_ranges_the_edge_of_one_is_found() {
        let holds = |swing: u32| (130..=180).contains(&swing) || (300..=420).contains(&swing);
        let found = widest(holds, [100, 600]).unwrap();
        assert!(holds(found) && !holds(found + 1), "{found}");
    }
}
