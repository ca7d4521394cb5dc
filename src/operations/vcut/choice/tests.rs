//! Random jobs along every route: the same surface, no cut before those it relies on, and the best of all taken.

mod chosen;
mod finest;

use crate::asked::{Lattice, Residual, Sequence};
use crate::plan::PlannedVcut;
use crate::plan::decision::Standing;
use crate::plan::route::{Heading, layers};
use crate::plan::tests::{a_job, all_auto};
use crate::samples::{operation, paper_job, planned};
use proptest::prelude::*;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::Code;
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, CheckedJob, Order, PlannedJob, Sourced};
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::{Proven, prove, replay, scallop_excess};
use vcutc_simulation::surface::{Side, Surface, Vee};

const ROUTES: [(Sequence, Order); 6] = [
    (Sequence::Rows, Order::Point),
    (Sequence::Rows, Order::Layer),
    (Sequence::Boustrophedon, Order::Point),
    (Sequence::Boustrophedon, Order::Layer),
    (Sequence::Nearest, Order::Point),
    (Sequence::Nearest, Order::Layer),
];

fn along(job: &CheckedJob, (sequence, order): (Sequence, Order)) -> Option<(PlannedJob, Proven)> {
    let mut job = job.clone();
    let asked = operation(&mut job);
    asked.sequence.value = Auto::Given(sequence);
    asked.order.value = Auto::Given(order);
    planned_and_proven(&job)
}

fn planned_and_proven(job: &CheckedJob) -> Option<(PlannedJob, Proven)> {
    let plan = plan_job(job).0?;
    let proven = prove(&plan, &SourceMap::default()).unwrap();
    Some((plan, proven))
}

fn vcut(plan: &PlannedJob) -> &PlannedVcut {
    planned(plan)
}

/// What a plan's cuts leave.
fn surface_after(plan: &PlannedJob) -> Vec<Point2> {
    let program =
        vcutc_backend_api::verify::verify(vcutc_process::lower::lower(plan, &SourceMap::default())).unwrap();
    replay(plan, &program).surface.corners().collect()
}

/// Compares every cut of a route with what the planner relied on: the surface that all layers above its own
/// leave. Where the cut is made, as far as its flanks go, the surface must not stand higher, and the flanks
/// must not need more.
fn relies_on_nothing_to_come(plan: &PlannedJob) -> Result<(), TestCaseError> {
    let vcut = vcut(plan);
    let vee = |index: usize| Vee::even(vcut.cuts[index].tip, vcut.parameters.flanks.slope);
    let mut planned = Vec::new();
    let mut above = Surface::untouched(plan.stock);
    for layer in layers(&vcut.cuts) {
        for index in layer.clone() {
            let runs = [Side::Left, Side::Right].map(|side| above.flank(vee(index), side));
            let [from, to] = runs.map(|run| run.exit.x);
            let corners: Vec<Point2> = above.corners_between(from, to).collect();
            planned.push((runs, corners));
        }
        layer.for_each(|index| above.release(vee(index)));
    }
    let mut now = Surface::untouched(plan.stock);
    let mut made = 0;
    for run in &vcut.runs {
        let mut order: Vec<usize> = run.cuts.clone().collect();
        if run.heading == Heading::Leftwards {
            order.reverse();
        }
        for &index in &order {
            let (runs, corners) = &planned[index];
            made += 1;
            for corner in corners {
                prop_assert!(now.height(corner.x) <= corner.z + 1e-6, "{index} {corner:?}");
            }
            if !now.covers(vee(index).tip) {
                now.release(vee(index));
                continue;
            }
            for (side, relied) in [Side::Left, Side::Right].into_iter().zip(runs) {
                let run = now.flank(vee(index), side);
                prop_assert!(run.reach <= relied.reach + 1e-6, "{index} {run:?} {relied:?}");
                prop_assert!(relied.blocked_at.is_some() || run.blocked_at.is_none());
            }
            now.release(vee(index));
        }
    }
    prop_assert_eq!(made, vcut.cuts.len());
    Ok(())
}

/// Gives a job the swing, the layer and the step that it was planned with.
fn give(job: &mut CheckedJob, planned: &PlannedJob) {
    let parameters = vcut(planned).parameters.clone();
    let asked = operation(job);
    asked.swing.value = Auto::Given(parameters.swing);
    asked.layer.value = Auto::Given(parameters.layer);
    asked.step.value = Auto::Given(parameters.step);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn every_route_leaves_the_same_surface(mut job in a_job()) {
        operation(&mut job).residual.value = Auto::Given(Residual::Mixed);
        let Some((first, _)) = along(&job, ROUTES[0]) else { return Ok(()) };
        // Open parameters may be others along other routes.
        give(&mut job, &first);
        let Some((rows, proven)) = along(&job, ROUTES[0]) else { return Ok(()) };
        let corners = surface_after(&rows);
        for route in &ROUTES[1..] {
            let (plan, other) = along(&job, *route).unwrap();
            prop_assert_eq!(&vcut(&plan).cuts, &vcut(&rows).cuts);
            prop_assert_eq!(&other.findings, &proven.findings, "{:?}", route);
            prop_assert_eq!(&other.report.layers, &proven.report.layers);
            let others = surface_after(&plan);
            let mut one = Surface::untouched(rows.stock);
            for cut in &vcut(&rows).cuts {
                one.release(Vee::even(cut.tip, vcut(&rows).parameters.flanks.slope));
            }
            prop_assert!((other.report.removed.to_mm2() - proven.report.removed.to_mm2()).abs() < 1e-4);
            for corner in corners.iter().chain(&others) {
                prop_assert!((one.height(corner.x) - corner.z).abs() < 1e-5, "{:?} {:?}", route, corner);
            }
            relies_on_nothing_to_come(&plan)?;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn the_best_of_all_is_taken(mut job in a_job(), limit in prop::option::of(4.0..20.0_f64)) {
        let asked = operation(&mut job);
        asked.residual.value = Auto::Auto;
        asked.order.value = Auto::Auto;
        asked.sequence.value = Auto::Auto;
        asked.limits.scallop = limit.map(|limit| vcutc_job::Sourced { value: Length::mm(limit), span: None });
        let Some((first, _)) = planned_and_proven(&job) else { return Ok(()) };
        give(&mut job, &first);
        let Some((best, proven)) = planned_and_proven(&job) else { return Ok(()) };
        // Larger ones are not compared, and say so.
        prop_assume!(vcut(&best).cuts.len() <= super::MOST_CUTS_COMPARED);
        let taken = proven.report.times.all.total().to_s();
        let is_sound = |plan: &PlannedJob, proven: &Proven, highest: f64| {
            proven.findings.iter().count() == 0
                && proven.report.scallop.height.to_mm() <= highest
                && scallop_excess(plan, &proven.report).is_none()
        };
        // Without a limit, none may leave more than `mixed` or the lattice would.
        let mut inherent = f64::INFINITY;
        if limit.is_none() {
            operation(&mut job).residual.value = Auto::Given(Residual::Mixed);
            let (mixed, with_mixed) = along(&job, ROUTES[0]).unwrap();
            inherent = vcut(&mixed).parameters.scallop_bound(&vcut(&mixed).asked).max(with_mixed.report.scallop.height).to_mm() + 1e-3;
        }
        let mut any = false;
        for residual in [Residual::Mixed, Residual::Lift, Residual::Shift, Residual::Discard] {
            operation(&mut job).residual.value = Auto::Given(residual);
            for route in ROUTES {
                let Some((plan, other)) = along(&job, route) else { continue };
                if is_sound(&plan, &other, inherent) {
                    any = true;
                    let time = other.report.times.all.total().to_s();
                    let cut = vcut(&best);
                    prop_assert!(
                        taken <= time + 1e-9,
                        "{residual:?} {route:?} {time}, but {:?} {:?} {:?} {taken}", cut.strategy, cut.sequence, cut.order
                    );
                }
            }
        }
        prop_assert!(!any || is_sound(&best, &proven, inherent));
    }
}

/// Two hollows with a hill between them.
fn hollows() -> CheckedJob {
    let corners = [
        (0.0, 10.0),
        (15.0, 10.0),
        (38.0, 45.0),
        (47.0, 45.0),
        (70.0, 10.0),
        (85.0, 10.0),
    ];
    let mut job = paper_job(corners.map(|(x, z)| Point2 { x, z }).to_vec());
    let asked = operation(&mut job);
    asked.blade.cutting_length.value = Length::mm(20.0);
    asked.swing.value = Auto::Given(Angle::deg(30.0));
    job
}

#[test]
fn nearest_finishes_a_hollow_before_it_crosses_the_hill() {
    for order in [Order::Point, Order::Layer] {
        let (plan, proven) = along(&hollows(), (Sequence::Nearest, order)).unwrap();
        assert_eq!(proven.findings.iter().count(), 0);
        let vcut = vcut(&plan);
        let sides: Vec<bool> = vcut
            .runs
            .iter()
            .map(|run| vcut.cuts[run.cuts.start].tip.x < 42.5)
            .collect();
        let crossings = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let (rows, _) = along(&hollows(), (Sequence::Rows, order)).unwrap();
        assert!(vcut.runs.len() > self::vcut(&rows).runs.len());
        assert!(crossings <= 2, "{sides:?}");
    }
}

#[test]
fn boustrophedon_turns_round_and_stays_beside_the_work() {
    let mut job = hollows();
    job.part = vcutc_job::Part::through(vec![Point2 { x: 0.0, z: 5.0 }, Point2 { x: 85.0, z: 5.0 }]).unwrap();
    let (plan, proven) = along(&job, (Sequence::Boustrophedon, Order::Point)).unwrap();
    let runs = &vcut(&plan).runs;
    assert!(runs.len() > 2);
    for (index, run) in runs.iter().enumerate() {
        let expected = if index % 2 == 0 {
            Heading::Rightwards
        } else {
            Heading::Leftwards
        };
        assert_eq!(run.heading, expected);
        assert_eq!(run.way == crate::plan::Way::Over, index == 0, "{run:?}");
    }
    let (_, rows) = along(&job, (Sequence::Rows, Order::Point)).unwrap();
    assert!(proven.report.times.all.travel < rows.report.times.all.travel);
}

#[test]
fn large_operations_are_not_compared() {
    let mut job = paper_job(vec![Point2 { x: 0.0, z: 5.0 }, Point2 { x: 85.0, z: 5.0 }]);
    let asked = operation(&mut job);
    asked.layer.value = Auto::Given(Length::mm(0.15));
    asked.step.value = Auto::Given(Length::mm(1.0));
    asked.order.value = Auto::Auto;
    asked.sequence.value = Auto::Auto;
    let plan = plan_job(&job).0.unwrap();
    let vcut = vcut(&plan);
    assert!(vcut.cuts.len() > super::MOST_CUTS_COMPARED);
    assert_eq!(
        (vcut.sequence, vcut.order),
        (Sequence::Boustrophedon, Order::Point)
    );
    let standings: Vec<Standing> = vcut
        .decisions
        .iter()
        .map(|decision| decision.taken.standing)
        .collect();
    assert_eq!(standings, [Standing::NotCompared]);
}

/// The paper's block with a part like a hill, to be cut with everything left open within limits.
fn open_job(swing: f64, scallop: f64) -> CheckedJob {
    let corners = [(0.0, 10.0), (30.0, 22.0), (55.0, 22.0), (85.0, 10.0)];
    let mut job = paper_job(corners.map(|(x, z)| Point2 { x, z }).to_vec());
    leave_open(&mut job, swing, scallop);
    job
}

fn leave_open(job: &mut CheckedJob, swing: f64, scallop: f64) {
    let asked = operation(job);
    asked.swing.value = Auto::Auto;
    asked.layer.value = Auto::Auto;
    asked.step.value = Auto::Auto;
    asked.limits.swing.most = Some(Sourced {
        value: Angle::deg(swing),
        span: None,
    });
    asked.limits.scallop = Some(Sourced {
        value: Length::mm(scallop),
        span: None,
    });
}

fn time_if_sound(job: &CheckedJob) -> Option<f64> {
    let (plan, proven) = planned_and_proven(job)?;
    (proven.findings.iter().count() == 0 && scallop_excess(&plan, &proven.report).is_none())
        .then(|| proven.report.times.all.total().to_s())
}

/// A part, the widest swing, and what may be left of it.
struct Open {
    part: fn(f64) -> f64,
    swing: Option<f64>,
    scallop: Option<f64>,
}

fn hill(x: f64) -> f64 {
    (10.0 + 0.4 * x).min(22.0).min(10.0 + 0.4 * (85.0 - x))
}

/// A wall of 71 deg.
fn wall(x: f64) -> f64 {
    (30.0 - 3.0 * (x - 38.0)).clamp(10.0, 30.0)
}

fn gentle(x: f64) -> f64 {
    15.0 + 4.0 * libm::sin(x * core::f64::consts::TAU / 60.0)
}

fn hollow(x: f64) -> f64 {
    10.0 + (x - 42.5) * (x - 42.5) / 60.0
}

/// The paper's block with a part and everything left open within limits.
fn all_open(corners: Vec<Point2>, swing: Option<f64>, scallop: Option<f64>) -> CheckedJob {
    let mut job = paper_job(corners);
    let asked = operation(&mut job);
    asked.lattice.value = Auto::Auto;
    all_auto(asked);
    asked.limits.swing.most = swing.map(|most| Sourced {
        value: Angle::deg(most),
        span: None,
    });
    asked.limits.scallop = scallop.map(|most| Sourced {
        value: Length::mm(most),
        span: None,
    });
    job
}

impl Open {
    fn job(&self) -> CheckedJob {
        let corners = (0..=170)
            .map(|half| f64::from(half) / 2.0)
            .map(|x| Point2 { x, z: (self.part)(x) });
        all_open(corners.collect(), self.swing, self.scallop)
    }
}

/// The least time of a grid of swings, layers and overlaps on the lattice that is fastest on all of these parts, each planned
/// and proven, and which it was.
fn least_of_grid(open: &Open) -> Option<(f64, String)> {
    let mut least: Option<(f64, String)> = None;
    let overlaps: &[f64] = if open.scallop.is_some() {
        &[0.0, 0.3]
    } else {
        &[0.0]
    };
    for swing in [20.0, 25.0, 30.0, 40.0, 50.0] {
        for layer in [1.5, 2.0, 3.0, 4.0, 6.0, 8.0] {
            for &overlap in overlaps {
                if open.swing.is_some_and(|most| swing > most) {
                    continue;
                }
                let mut job = open.job();
                let asked = operation(&mut job);
                asked.lattice.value = Auto::Given(Lattice::Interlaced);
                asked.swing.value = Auto::Given(Angle::deg(swing));
                asked.layer.value = Auto::Given(Length::mm(layer));
                asked.overlap.value = Auto::Given(overlap);
                if let Some(time) = time_if_sound(&job)
                    && least.as_ref().is_none_or(|(least, _)| time < *least)
                {
                    least = Some((time, format!("swing {swing}, layer {layer}, overlap {overlap}")));
                }
            }
        }
    }
    least
}

#[test]
fn no_grid_beats_the_choice_by_much() {
    let jobs = [
        (hill as fn(f64) -> f64, Some(40.0), Some(5.0)),
        (wall, None, Some(6.0)),
        // Which tips happen to lie right at the wall decides here, and that changes with every step.
        (wall, Some(40.0), Some(3.0)),
        (gentle, None, Some(1.0)),
        (gentle, Some(30.0), Some(4.0)),
        (hollow, None, Some(6.0)),
    ];
    for (index, (part, swing, scallop)) in jobs.into_iter().enumerate() {
        let open = Open { part, swing, scallop };
        let (by_hand, how) = least_of_grid(&open).unwrap();
        let chosen = time_if_sound(&open.job()).unwrap_or_else(|| panic!("{index}: {how} works"));
        assert!(
            chosen <= by_hand * TOLERANCE,
            "{index}: {chosen} s, but {by_hand} s with {how}"
        );
    }
}

/// A block with a part, cut along one route, with a limit on scallop.
fn small_job(corners: &[(f64, f64)], scallop: f64) -> CheckedJob {
    let corners = corners.iter().map(|&(x, z)| Point2 { x, z });
    let mut job = all_open(corners.collect(), None, Some(scallop));
    let asked = operation(&mut job);
    asked.residual.value = Auto::Given(Residual::Mixed);
    asked.order.value = Auto::Given(Order::Point);
    asked.sequence.value = Auto::Given(Sequence::Boustrophedon);
    job
}

/// A wave, as corners; gentle ones are nowhere steeper than 25 deg.
fn a_wave() -> impl Strategy<Value = (Vec<(f64, f64)>, f64)> {
    let heights = (0.5..4.0_f64, 55.0..120.0_f64, 0.0..6.0_f64, 25.0..42.0_f64);
    (heights, 0.4..3.0_f64).prop_map(|((height, length, phase, middle), scallop)| {
        let z = |x: f64| middle + height * libm::sin(x / length * core::f64::consts::TAU + phase);
        let corners = (0..=85).map(f64::from).map(|x| (x, z(x)));
        (corners.collect(), scallop)
    })
}

/// A step with a steep wall.
fn a_step() -> impl Strategy<Value = (Vec<(f64, f64)>, f64)> {
    let shape = (10.0..30.0_f64, 5.0..18.0_f64, 20.0..60.0_f64, 65.0..88.0_f64);
    (shape, 0.17..0.4_f64).prop_map(|((low, height, at, steep), share)| {
        let width = height / libm::tan(steep.to_radians());
        let corners = [
            (0.0, low),
            (at, low),
            (at + width, low + height),
            (85.0, low + height),
        ];
        (corners.to_vec(), share * height + 0.5)
    })
}

/// How much longer than the best of a grid the choice may take on any part. Which tips happen to lie right at a wall no search of
/// bounded length finds out; what is to be seen here is that nothing is far off, or refused.
const OF_ANY: f64 = 1.5;

/// The least time of a coarse grid of explicit parameters on two lattices.
fn least_by_hand(job: &CheckedJob) -> Option<(f64, String)> {
    let mut least: Option<(f64, String)> = None;
    for lattice in [Lattice::Orthogonal, Lattice::Interlaced] {
        for swing in [6.0, 10.0, 20.0, 35.0, 50.0, 65.0, 78.0] {
            for layer in [1.5, 3.0, 6.0] {
                for overlap in [0.0, 0.45] {
                    let mut job = job.clone();
                    let asked = operation(&mut job);
                    asked.lattice.value = Auto::Given(lattice);
                    asked.swing.value = Auto::Given(Angle::deg(swing));
                    asked.layer.value = Auto::Given(Length::mm(layer));
                    asked.overlap.value = Auto::Given(overlap);
                    if let Some(time) = time_if_sound(&job)
                        && least.as_ref().is_none_or(|(least, _)| time < *least)
                    {
                        let how = format!("{lattice:?}, swing {swing}, layer {layer}, overlap {overlap}");
                        least = Some((time, how));
                    }
                }
            }
        }
    }
    least
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    #[test]
    fn by_hand_nothing_is_clearly_better((corners, scallop) in prop_oneof![a_wave(), a_step()]) {
        let job = small_job(&corners, scallop);
        let Some((by_hand, how)) = least_by_hand(&job) else { return Ok(()) };
        let chosen = time_if_sound(&job);
        prop_assert!(chosen.is_some(), "{} works", how);
        let chosen = chosen.unwrap_or_default();
        prop_assert!(chosen <= by_hand * OF_ANY, "{} s, but {} s with {}", chosen, by_hand, how);
    }
}

#[test]
fn a_limit_that_only_the_bound_breaks_is_not_a_conflict() {
    // No layer of at least 6 mm keeps 4 mm by the lattice's bound at 35 deg.
    let mut job = open_job(35.0, 5.0);
    operation(&mut job).limits.layer.least = Some(Sourced {
        value: Length::mm(5.0),
        span: None,
    });
    assert!(time_if_sound(&job).is_some());
}

#[test]
fn plans_are_held_to_the_limits_on_time_and_cuts() {
    let mut job = open_job(40.0, 6.0);
    let (plan, proven) = planned_and_proven(&job).unwrap();
    let (time, cuts) = (proven.report.times.all.total(), vcut(&plan).cuts.len());
    let limited = |job: &mut CheckedJob, seconds: f64, most: f64| {
        let limits = &mut operation(job).limits;
        limits.time = Some(Sourced {
            value: Duration::s(seconds),
            span: None,
        });
        limits.cuts = Some(Sourced {
            value: most,
            span: None,
        });
    };
    // What the model makes of the same parameters does not matter.
    limited(&mut job, time.to_s() + 2.0, cuts as f64);
    let (same, _) = planned_and_proven(&job).unwrap();
    assert_eq!(vcut(&same).cuts, vcut(&plan).cuts);
    limited(&mut job, time.to_s() / 2.0, cuts as f64);
    let (none, diagnostics) = plan_job(&job);
    assert!(none.is_none());
    let codes: Vec<Code> = diagnostics.iter().map(|one| one.code).collect();
    assert_eq!(codes, [Code::LimitsConflict]);
    assert!(
        diagnostics[0].message.contains("takes"),
        "{}",
        diagnostics[0].message
    );
}

#[test]
fn the_same_choice_comes_twice() {
    let job = open_job(40.0, 6.0);
    assert_eq!(plan_job(&job).0, plan_job(&job).0);
}

/// How much longer the choice may take than the best of a grid: it is a search.
const TOLERANCE: f64 = 1.05;
