//! Time against the scallop, the cuts or the edge: plans under a row of limits, and what the formulas say of these.

use super::against::Against;
use super::trials::{Came, Plan, Trials};
use vcutc_vcut::asked::{Lattice, Objective, RoughVcut};
use vcutc_vcut::plan::optimum::{self, Optimum, Problem};

/// What limits cost.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeOff {
    pub against: Against,
    /// The job's own limit, in mm or cuts.
    pub limit: Option<f64>,
    /// The job as it is, planned at programmed speeds.
    pub now: Came,
    /// The fastest plans for a row of other limits, by growing limit.
    pub points: Vec<Point>,
    /// What the formulas say of the same limits, for each lattice; lattices that cannot keep the other bounds are left out.
    pub curves: Vec<LatticeCurve>,
}

/// A limit, and its result.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// In mm or cuts.
    pub limit: f64,
    /// The fastest plan that was found within the limit, under this one or a tighter one.
    pub came: Came,
    /// The best parameters by the job's formulas.
    pub formula: Option<Optimum>,
}

/// The fastest parameters of one lattice, by the formulas.
#[derive(Clone, Debug, PartialEq)]
pub struct LatticeCurve {
    pub lattice: Lattice,
    /// Limits and times in s, by growing limit; at least one.
    pub points: Vec<[f64; 2]>,
}

/// By how much a plan may exceed a limit, in mm or cuts: as closely as what is left is measured.
const WITHIN: f64 = 1e-3;

/// What a trade-off is made from.
pub(super) struct Question<'q> {
    pub(super) against: Against,
    /// How many limits.
    pub(super) points: u32,
    /// The operation, with a limit that was chosen as if the job had set it.
    pub(super) asked: &'q RoughVcut,
    pub(super) problem: &'q Problem,
    pub(super) lattices: &'q [Lattice],
}

impl TradeOff {
    /// Plans the job under other limits as far as there is room, those nearest to its own first.
    pub(super) fn of(question: &Question<'_>, now: &Came, trials: &mut Trials<'_>) -> Self {
        let Question {
            against,
            points,
            asked,
            problem,
            lattices,
        } = *question;
        let limit = against.limit(asked);
        let own = limit.or_else(|| now.plan().map(|plan| against.of(plan)));
        let limits = own.map_or_else(Vec::new, |own| against.limits_about(own, points, asked));
        let formula = |limit: f64| best_under(question, problem, limit);
        let at_own = own.and_then(formula).map(|best| best.cuts);
        let mut found: Vec<Point> = Vec::new();
        for limit in nearest_first(&limits, own) {
            let best = formula(limit);
            let cuts = expected_cuts(now, best.as_ref().map(|best| best.cuts), at_own);
            let came = trials.came(cuts, |asked| {
                asked.objective.value = Objective::Time;
                against.put(asked, limit);
            });
            found.push(Point {
                limit,
                came: within(against, limit, came),
                formula: best,
            });
        }
        found.sort_by(|one, other| one.limit.total_cmp(&other.limit));
        let all = own.into_iter().chain(limits.iter().copied());
        let curves = curves(question, lattices, all.collect());
        Self {
            against,
            limit,
            now: now.clone(),
            points: best_of_all(against, now, found),
            curves,
        }
    }

    /// Plans of which none is both faster and within a tighter limit than another: what they come to, and their times in s.
    #[must_use]
    pub fn front(&self) -> Vec<[f64; 2]> {
        let plans = self.points.iter().filter_map(|point| point.came.plan());
        let mut places: Vec<[f64; 2]> = plans
            .chain(self.now.plan())
            .map(|plan| [self.against.of(plan), plan.time.to_s()])
            .collect();
        places.sort_by(|one, other| one[0].total_cmp(&other[0]).then(one[1].total_cmp(&other[1])));
        let mut front: Vec<[f64; 2]> = Vec::new();
        for place in places {
            if front.last().is_none_or(|last| place[1] < last[1]) {
                front.push(place);
            }
        }
        front
    }

    /// The fastest plan within a tighter limit than the job's, if it is faster than the job: the search missed it.
    pub(super) fn faster_within(&self) -> Option<(&Point, &Plan)> {
        let limit = self.limit?;
        let tighter = self.points.iter().filter(|point| point.limit < limit);
        let (point, plan) = tighter
            .filter_map(|point| Some((point, point.came.plan()?)))
            .min_by(|(_, one), (_, other)| one.time.total_cmp(&other.time))?;
        (plan.time < self.now.plan()?.time).then_some((point, plan))
    }
}

fn best_under(question: &Question<'_>, problem: &Problem, limit: f64) -> Option<Optimum> {
    let mut problem = problem.clone();
    problem.objective = Objective::Time;
    question.against.put_in(&mut problem, limit);
    optimum::solve(&problem).ok()
}

/// Limits by how far they are from the job's own, as factors; of two as far, the wider one, which has fewer cuts.
fn nearest_first(limits: &[f64], own: Option<f64>) -> Vec<f64> {
    let own = own.unwrap_or(1.0);
    let away = |limit: &f64| libm::fabs(libm::log(limit / own));
    let mut limits = limits.to_vec();
    limits.sort_by(|one, other| away(one).total_cmp(&away(other)).then(other.total_cmp(one)));
    limits
}

/// How many cuts a plan may have: as many more than the job's plan as the formulas say; without that plan, as many as they say.
fn expected_cuts(now: &Came, by_formula: Option<f64>, at_own: Option<f64>) -> f64 {
    let planned = now.plan().map(|plan| plan.cuts as f64);
    match (planned, by_formula, at_own) {
        (Some(planned), Some(cuts), Some(own)) if own > 0.0 => planned * cuts / own,
        (_, Some(cuts), _) => cuts,
        (Some(planned), None, _) => planned,
        (None, None, _) => f64::INFINITY,
    }
}

/// A plan that exceeds the limit that it was made for does not count.
fn within(against: Against, limit: f64, came: Came) -> Came {
    match came {
        Came::Planned(plan) if against.of(&plan) > limit + WITHIN => Came::Nothing,
        came => came,
    }
}

/// A plan for a tighter limit, and the job's own plan, also keep a wider limit. Points that save nothing are left out; those that were
/// not planned stay, because nothing is known of them.
fn best_of_all(against: Against, now: &Came, found: Vec<Point>) -> Vec<Point> {
    let mut known: Vec<Plan> = found
        .iter()
        .filter_map(|point| point.came.plan())
        .chain(now.plan())
        .cloned()
        .collect();
    known.sort_by(|one, other| one.time.total_cmp(&other.time));
    let kept = |limit: f64| known.iter().find(|plan| against.of(plan) <= limit + WITHIN);
    let mut points: Vec<Point> = Vec::new();
    for point in found {
        let came = match (point.came, kept(point.limit)) {
            (Came::TooLarge, _) => Came::TooLarge,
            (_, Some(plan)) => Came::Planned(Box::new(plan.clone())),
            (came @ (Came::Planned(_) | Came::Nothing), None) => came,
        };
        let is_faster = |plan: &Plan| {
            let before = points.iter().filter_map(|point| point.came.plan());
            let now = now.plan().filter(|now| against.of(now) <= point.limit + WITHIN);
            before.chain(now).all(|known| plan.time < known.time)
        };
        if came.plan().is_none_or(is_faster) {
            points.push(Point { came, ..point });
        }
    }
    points
}

fn curves(question: &Question<'_>, lattices: &[Lattice], mut limits: Vec<f64>) -> Vec<LatticeCurve> {
    limits.sort_by(f64::total_cmp);
    let curve = |&lattice: &Lattice| {
        let alone = Problem {
            lattices: vec![lattice],
            ..question.problem.clone()
        };
        let points: Vec<[f64; 2]> = limits
            .iter()
            .filter_map(|&limit| Some([limit, best_under(question, &alone, limit)?.time.to_s()]))
            .collect();
        (!points.is_empty()).then_some(LatticeCurve { lattice, points })
    };
    lattices.iter().filter_map(curve).collect()
}
