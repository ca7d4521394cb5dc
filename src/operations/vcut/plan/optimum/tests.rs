//! Checks against published numbers, against search on a grid, and against another author's optimiser.

use super::formulas::{Keeping, Model, Tooth};
use super::published::table_1;
use super::{Bound, Extension, Infeasible, Optimum, Problem, Range, Work, sensitivities, solve};
use crate::asked::{Formulas, Lattice, Objective};
use crate::plan::blade_reach::{needed_reach, scallop_bound};
use crate::plan::time_model::TimeModel;
use proptest::prelude::*;
use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Duration, Length, Speed};
use vcutc_geometry::number::{Interval, Slopes};

mod line;

fn solved(formulas: Formulas, lattice: Lattice) -> Optimum {
    solve(&table_1(formulas, lattice)).unwrap()
}

fn assert_near(optimum: &Optimum, [swing, layer, step, time]: [f64; 4]) {
    let found = [
        optimum.swing.to_deg(),
        optimum.layer.to_mm(),
        optimum.step.to_mm(),
        optimum.time.to_s(),
    ];
    for (found, expected) in found.into_iter().zip([swing, layer, step, time]) {
        assert!((found / expected - 1.0).abs() < 1e-5, "{optimum:?}");
    }
}

#[test]
fn the_papers_optimum() {
    // Table 1: h 4.40, s 5.97, alpha 34.16, T 40.3 % below 515.3 s, delta 9.29.
    let optimum = solved(Formulas::Paper, Lattice::Orthogonal);
    assert_near(&optimum, [34.1550, 4.39838, 5.96818, 307.59922]);
    assert!((optimum.scallop.to_mm() - 9.29).abs() < 0.005, "{optimum:?}");
}

#[test]
fn the_exact_optima_of_the_papers_job() {
    let orthogonal = solved(Formulas::Exact, Lattice::Orthogonal);
    assert_near(&orthogonal, [35.57091, 6.484948, 4.637788, 261.491687]);
    assert!((orthogonal.overlap - 0.5).abs() < 1e-12, "{orthogonal:?}");
    let interlaced = solved(Formulas::Exact, Lattice::Interlaced);
    assert_near(&interlaced, [50.0, 5.0, 11.917536, 169.342765]);
}

/// Parameters, and what they come to by the formulas of the planner rather than those of the solver.
#[derive(Clone, Copy, Debug)]
struct Point {
    lattice: Lattice,
    swing: Angle,
    layer: Length,
    step: Length,
}

impl Point {
    fn of(optimum: &Optimum) -> Self {
        Self {
            lattice: optimum.lattice,
            swing: optimum.swing,
            layer: optimum.layer,
            step: optimum.step,
        }
    }

    fn reach(&self, problem: &Problem) -> Length {
        match (problem.formulas, self.lattice) {
            (Formulas::Paper, Lattice::Orthogonal) => self.layer * 1.5,
            (Formulas::Paper, Lattice::Interlaced | Lattice::Fitted) => self.layer,
            (Formulas::Paper, Lattice::Free) => self.layer * 2.0,
            (Formulas::Exact, _) => needed_reach(self.lattice, self.layer, self.step, 1.0 / self.swing.tan()),
        }
    }

    fn edge(&self, problem: &Problem) -> Length {
        let lead = problem.work.rake - problem.work.half_apex;
        self.reach(problem) / (self.swing.cos() * lead.sin())
    }

    fn extension(&self, problem: &Problem) -> Length {
        let work = &problem.work;
        match work.extension {
            Extension::Fixed(length) => length,
            Extension::EdgeInUse => self.edge(problem) * (work.rake - work.half_apex).cos(),
            Extension::Leaning { edge, run_out } => {
                let teeth = self.layer + self.step / (2.0 * self.swing.tan());
                let body = work.cutting_length * (work.half_apex.sin() / work.rake.sin())
                    + teeth * (work.rake.cos() / work.rake.sin() / self.swing.cos());
                body.max(edge) + run_out
            }
        }
    }

    fn time(&self, problem: &Problem) -> f64 {
        let work = &problem.work;
        let model = TimeModel {
            width: work.width,
            depth: work.depth,
            area: work.area,
            clearance: work.clearance,
            extension: self.extension(problem),
            rake: work.rake,
            cut_feed: work.cut_feed,
            travel_feed: work.travel_feed,
            reorient_rate: work.reorient_rate,
        };
        model.estimate(self.swing, self.layer, self.step).to_s()
    }

    fn cuts(&self, problem: &Problem) -> f64 {
        let (width, area) = (problem.work.width.to_mm(), problem.work.area.to_mm2());
        let layers = (area / (width * self.layer.to_mm()) - 0.5).max(1.0);
        (width / self.step.to_mm() + 0.5) * layers
    }

    fn scallop(&self, problem: &Problem) -> Length {
        let drop = problem.work.standoff / self.swing.sin();
        let slope = 1.0 / self.swing.tan();
        let between = match (problem.formulas, self.lattice) {
            // (2 - eps) h.
            (Formulas::Paper, Lattice::Interlaced) => self.layer + self.step * (0.5 * slope),
            (Formulas::Paper | Formulas::Exact, _) => {
                scallop_bound(self.lattice, self.layer, self.step, slope)
            }
        };
        problem.work.allowance + drop + between
    }

    fn overlap(&self) -> f64 {
        1.0 - self.step / (self.layer * (2.0 * self.swing.tan()))
    }

    /// What a bound is on.
    fn attained(&self, problem: &Problem, bound: Bound) -> f64 {
        match bound {
            Bound::SwingLeast | Bound::SwingMost => self.swing.to_rad(),
            Bound::LayerLeast | Bound::LayerMost => self.layer.to_mm(),
            Bound::StepLeast | Bound::StepMost => self.step.to_mm(),
            Bound::OverlapLeast | Bound::OverlapMost => self.overlap(),
            Bound::Scallop => self.scallop(problem).to_mm(),
            Bound::Edge => self.edge(problem).to_mm(),
            Bound::Time => self.time(problem),
            Bound::Cuts => self.cuts(problem),
        }
    }

    /// Whether it keeps all bounds but for that share of them.
    fn keeps(&self, problem: &Problem, share: f64) -> bool {
        Bound::ALL.into_iter().all(|bound| {
            let Some(value) = bound.value(problem) else {
                return true;
            };
            let attained = self.attained(problem, bound);
            match bound {
                Bound::SwingLeast | Bound::LayerLeast | Bound::StepLeast => attained >= value * (1.0 - share),
                Bound::OverlapLeast => attained >= value - share,
                Bound::OverlapMost => attained <= value + share,
                // Needed reach grants a nanometre where flanks pass tips.
                Bound::Edge => attained <= value * (1.0 + share) + 1e3 * share,
                Bound::SwingMost
                | Bound::LayerMost
                | Bound::StepMost
                | Bound::Scallop
                | Bound::Time
                | Bound::Cuts => attained <= value * (1.0 + share),
            }
        })
    }

    fn measure(&self, problem: &Problem) -> f64 {
        match problem.objective {
            Objective::Time => self.time(problem),
            Objective::Cuts => self.cuts(problem),
            Objective::Scallop => self.scallop(problem).to_mm(),
            Objective::BladeLoad => self.edge(problem).to_mm(),
        }
    }
}

/// Points all over the problem: swings and shares evenly and at the jumps of the reach, and layers from the least to the
/// largest, the largest that keeps the bounds among them.
fn grid(problem: &Problem) -> Vec<Point> {
    let swings = (0..=24).map(|i| {
        let part = f64::from(i) / 24.0;
        problem.swing.least + (problem.swing.most - problem.swing.least) * part
    });
    let (least, most) = (1.0 - problem.overlap.most, 1.0 - problem.overlap.least);
    let jumps = (2..=8)
        .map(|i| 1.0 / f64::from(i))
        .filter(|share| (least..=most).contains(share));
    let shares: Vec<f64> = (0..=20)
        .map(|i| least + (most - least) * f64::from(i) / 20.0)
        .chain(jumps)
        .collect();
    let mut points = Vec::new();
    for swing in swings {
        for &share in &shares {
            for &lattice in &problem.lattices {
                let at = |layer: f64| Point {
                    lattice,
                    swing,
                    layer: Length::mm(layer),
                    step: Length::mm(2.0 * share * layer * swing.tan()),
                };
                let (low, high) = (problem.layer.least.to_mm(), problem.layer.most.to_mm());
                let low = low.max(problem.step.least.to_mm() / (2.0 * share * swing.tan()));
                let high = high.min(problem.step.most.to_mm() / (2.0 * share * swing.tan()));
                // The model's own rule for jobs of less than a layer.
                let high = high.min(low.max(Model::new(problem, lattice).thickest));
                let layers = (0..=12).map(|i| low * libm::pow((high / low).max(1.0), f64::from(i) / 12.0));
                let mut kept: Vec<f64> = layers.filter(|&layer| at(layer).keeps(problem, 0.0)).collect();
                if let Some(&thick) = kept.last() {
                    let (mut works, mut fails) = (thick, high.max(thick));
                    for _ in 0..40 {
                        let middle = 0.5 * (works + fails);
                        if at(middle).keeps(problem, 0.0) {
                            works = middle
                        } else {
                            fails = middle
                        }
                    }
                    kept.push(works);
                }
                points.extend(kept.into_iter().map(at));
            }
        }
    }
    points
}

fn some_work() -> impl Strategy<Value = Work> {
    let sizes = (20.0..300.0_f64, 10.0..300.0_f64, 1.5..60.0_f64, 1.0..30.0_f64);
    let blade = (
        5.0..40.0_f64,
        2.0..15.0_f64,
        25.0..90.0_f64,
        0.0..0.5_f64,
        0.0..1.0_f64,
    );
    let speeds = (20.0..400.0_f64, 50.0..800.0_f64, 20.0..300.0_f64);
    let extension = prop_oneof![
        Just(Extension::EdgeInUse),
        (5.0..30.0_f64).prop_map(|length| Extension::Fixed(Length::mm(length))),
        (2.0..20.0_f64).prop_map(|edge| Extension::Leaning {
            edge: Length::mm(edge),
            run_out: Length::mm(2.0)
        }),
    ];
    (sizes, blade, speeds, extension).prop_map(|(sizes, blade, speeds, extension)| Work {
        width: Length::mm(sizes.0),
        depth: Length::mm(sizes.1),
        area: Area::mm2(sizes.0 * sizes.2),
        clearance: Length::mm(sizes.3),
        cutting_length: Length::mm(blade.0),
        half_apex: Angle::deg(blade.1),
        rake: Angle::deg(blade.2),
        allowance: Length::mm(blade.3),
        standoff: Length::mm(blade.4),
        extension,
        cut_feed: Speed::mm_per_s(speeds.0),
        travel_feed: Speed::mm_per_s(speeds.1),
        reorient_rate: AngularSpeed::deg_per_s(speeds.2),
    })
}

/// Ranges and limits of all kinds, often in conflict, and values that are given.
fn some_problem(objective: Objective) -> impl Strategy<Value = Problem> {
    let how = (
        prop::sample::select(vec![Formulas::Paper, Formulas::Exact]),
        prop::sample::select(vec![
            vec![Lattice::Orthogonal],
            vec![Lattice::Interlaced],
            vec![Lattice::Free],
            vec![Lattice::Orthogonal, Lattice::Interlaced],
        ]),
    );
    let swing = prop_oneof![
        3 => (2.0..30.0_f64, 0.0..58.0_f64).prop_map(|(least, more)| (least, least + more)),
        1 => (15.0..60.0_f64).prop_map(|given| (given, given)),
    ];
    let length = |open: f64| {
        prop_oneof![
            3 => Just((0.01, open)),
            1 => (0.5..8.0_f64).prop_map(|given| (given, given)),
            1 => (0.5..4.0_f64, 1.0..6.0_f64).prop_map(|(least, more)| (least, least + more)),
        ]
    };
    let overlap = prop_oneof![
        3 => Just((0.0, 0.9)),
        1 => prop::sample::select(vec![0.0, 0.1, 0.5, 0.75]).prop_map(|given| (given, given)),
    ];
    let limit = |range: core::ops::Range<f64>| prop::option::weighted(0.3, range);
    let ranges = (swing, length(50.0), length(80.0), overlap);
    let limits = (
        limit(3.0..15.0),
        limit(3.0..12.0),
        limit(50.0..2000.0),
        limit(20.0..500.0),
    );
    (how, some_work(), ranges, limits).prop_map(move |((formulas, lattices), work, ranges, limits)| {
        let lengths = |(least, most)| Range {
            least: Length::mm(least),
            most: Length::mm(most),
        };
        Problem {
            objective,
            formulas,
            lattices,
            work,
            swing: Range {
                least: Angle::deg(ranges.0.0),
                most: Angle::deg(ranges.0.1),
            },
            layer: lengths(ranges.1),
            step: lengths(ranges.2),
            overlap: Range {
                least: ranges.3.0,
                most: ranges.3.1,
            },
            scallop: limits.0.map(Length::mm),
            edge: limits.1.map(Length::mm),
            time: limits.2.map(Duration::s),
            cuts: limits.3,
        }
    })
}

/// The largest share by which a grid may come out lower, and why a problem is not solved.
fn check(problem: &Problem, share: f64) -> Result<(), TestCaseError> {
    let points = grid(problem);
    let best = points
        .iter()
        .map(|point| point.measure(problem))
        .fold(f64::INFINITY, f64::min);
    match solve(problem) {
        Ok(optimum) => {
            let point = Point::of(&optimum);
            prop_assert!(point.keeps(problem, 1e-9), "{optimum:?}");
            let measure = point.measure(problem);
            prop_assert!(
                best >= measure * (1.0 - share),
                "{best} beats {measure}: {optimum:?}"
            );
            prop_assert!(
                (optimum.time.to_s() / point.time(problem) - 1.0).abs() < 1e-9,
                "{optimum:?}"
            );
            prop_assert!(
                (optimum.cuts / point.cuts(problem) - 1.0).abs() < 1e-9,
                "{optimum:?}"
            );
            prop_assert!(
                (optimum.scallop / point.scallop(problem) - 1.0).abs() < 1e-9,
                "{optimum:?}"
            );
            prop_assert!(
                (optimum.edge / point.edge(problem) - 1.0).abs() < 1e-6,
                "{optimum:?}"
            );
            prop_assert!(!optimum.binding.is_empty(), "{optimum:?}");
            for bound in &optimum.binding {
                let value = bound.value(problem).unwrap();
                prop_assert!(
                    (bound.attained(&optimum) - value).abs() <= 1e-6 * value.abs().max(1.0),
                    "{bound:?}"
                );
            }
        }
        Err(Infeasible::Conflict { bounds, nearest }) => {
            prop_assert!(points.is_empty(), "{:?} keeps all bounds", points.first());
            prop_assert!(!bounds.is_empty());
            for (bound, nearest) in bounds.iter().zip(&nearest) {
                if let Some(nearest) = nearest {
                    let eased = bound.replaced(problem, *nearest);
                    prop_assert!(solve(&eased).is_ok(), "{bound:?} of {nearest} does not do");
                }
            }
        }
        Err(Infeasible::Unbounded) => prop_assert!(false, "unbounded"),
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_grid_beats_the_least_time(problem in some_problem(Objective::Time)) {
        check(&problem, 1e-9)?;
    }

    #[test]
    fn no_grid_beats_the_fewest_cuts(problem in some_problem(Objective::Cuts)) {
        check(&problem, 1e-9)?;
    }

    #[test]
    fn no_grid_beats_the_least_scallop_or_edge(mut problem in some_problem(Objective::Scallop), edge: bool, time in 50.0..2000.0_f64) {
        problem.time = Some(Duration::s(time));
        if edge {
            problem.objective = Objective::BladeLoad;
        }
        check(&problem, 1e-8)?;
    }

    #[test]
    fn boxes_enclose_what_is_in_them(problem in some_problem(Objective::Time), at in (0.0..1.0_f64, 0.0..1.0_f64), width in 0.0..0.3_f64, inside in (0.0..1.0_f64, 0.0..1.0_f64)) {
        let model = Model::new(&problem, problem.lattices[0]);
        let tooth = Tooth::Any;
        let side = |low: f64| Interval { low, high: low * (1.0 + width) };
        let sides = [side(0.1 + at.0), side(0.1 + at.1)];
        let shape = |tangent, share| super::formulas::Shape { tangent, share, aspect: tangent * share };
        let enclosed = model.outcome(super::formulas::Shape {
            tangent: Slopes::coordinate(0, sides[0]),
            share: Slopes::coordinate(1, sides[1]),
            aspect: Slopes::coordinate(0, sides[0]) * Slopes::coordinate(1, sides[1]),
        }, tooth, Keeping::Both);
        let place = [sides[0].low + inside.0 * (sides[0].high - sides[0].low), sides[1].low + inside.1 * (sides[1].high - sides[1].low)];
        let value = |place: [f64; 2]| model.outcome(shape(place[0], place[1]), tooth, Keeping::Both).time;
        let here = value(place);
        prop_assert!((enclosed.time.value.low..=enclosed.time.value.high).contains(&here));
        // Between two places of the box the slope is enclosed too.
        for along in 0..2 {
            let mut there = place;
            there[along] = 0.5 * (sides[along].low + sides[along].high);
            let run = there[along] - place[along];
            if run.abs() > 1e-4 {
                let slope = (value(there) - here) / run;
                let room = 1e-6 * slope.abs() + 1e-9 * here;
                prop_assert!(enclosed.time.by[along].low - room <= slope && slope <= enclosed.time.by[along].high + room);
            }
        }
    }
}

#[test]
fn thinner_layers_without_end_are_reported() {
    for objective in [Objective::Scallop, Objective::BladeLoad] {
        let mut problem = table_1(Formulas::Exact, Lattice::Orthogonal);
        problem.objective = objective;
        problem.layer.least = Length::mm(0.001);
        problem.step.least = Length::mm(0.001);
        assert_eq!(solve(&problem), Err(Infeasible::Unbounded));
        problem.time = Some(Duration::s(500.0));
        assert!(solve(&problem).unwrap().binding.contains(&Bound::Time));
    }
}

#[test]
fn a_conflict_names_the_pair_and_what_works() {
    let mut problem = table_1(Formulas::Exact, Lattice::Orthogonal);
    problem.time = Some(Duration::s(200.0));
    problem.scallop = None;
    let Err(Infeasible::Conflict { bounds, nearest }) = solve(&problem) else {
        panic!("200 s are too few");
    };
    assert_eq!(bounds, [Bound::Edge, Bound::Time]);
    // The least time without a scallop limit.
    assert!((nearest[1].unwrap() - 261.069_156).abs() < 1e-3, "{nearest:?}");
    assert!(nearest[0].unwrap() > 10.0, "{nearest:?}");
}

#[test]
fn a_corner_that_rounding_leaves_is_found_whatever_is_made_least() {
    for formulas in [Formulas::Paper, Formulas::Exact] {
        for lattice in [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free] {
            for objective in [Objective::Time, Objective::Cuts] {
                let mut problem = table_1(formulas, lattice);
                problem.objective = objective;
                problem.scallop = None;
                problem.swing.most = Angle::deg(40.0);
                problem.layer.least = Length::mm(3.0);
                problem.layer.most = Length::mm(3.0);
                problem.overlap = Range {
                    least: 0.0,
                    most: 0.0,
                };
                // As wide as the steepest swing without overlap makes it, and no less.
                problem.step.least = Length::mm(6.0 * Angle::deg(40.0).tan());
                let optimum = solve(&problem).unwrap();
                assert!((optimum.swing.to_deg() - 40.0).abs() < 1e-6, "{optimum:?}");
                assert!(optimum.gap <= 1e-6, "{optimum:?}");
            }
        }
    }
}

#[test]
fn nothing_is_left_unproven_of_the_papers_job() {
    for formulas in [Formulas::Paper, Formulas::Exact] {
        for lattice in [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free] {
            for objective in [
                Objective::Time,
                Objective::Cuts,
                Objective::Scallop,
                Objective::BladeLoad,
            ] {
                let mut problem = table_1(formulas, lattice);
                problem.objective = objective;
                problem.time = Some(Duration::s(600.0));
                let optimum = solve(&problem).unwrap();
                assert!(optimum.gap <= 1e-7, "{problem:?}: {optimum:?}");
            }
        }
    }
}

#[test]
fn relaxing_a_bound_pays() {
    let mut problem = table_1(Formulas::Exact, Lattice::Orthogonal);
    problem.lattices.push(Lattice::Interlaced);
    let optimum = solve(&problem).unwrap();
    assert_eq!(optimum.lattice, Lattice::Interlaced);
    let bought = sensitivities(&problem, &optimum);
    let bounds: Vec<Bound> = bought.iter().map(|sensitivity| sensitivity.bound).collect();
    assert_eq!(bounds, [Bound::SwingMost, Bound::OverlapLeast, Bound::Scallop]);
    assert!(
        bought
            .iter()
            .all(|s| s.then.time.to_s() <= optimum.time.to_s() * (1.0 + 1e-9)),
        "{bought:?}"
    );
    // A job with another lattice gets no hint of what a change of lattice would save.
    let orthogonal = solved(Formulas::Exact, Lattice::Orthogonal);
    let bought = sensitivities(&problem, &orthogonal);
    assert!(!bought.is_empty());
    for sensitivity in bought {
        assert_eq!(sensitivity.then.lattice, Lattice::Orthogonal);
        assert!(sensitivity.then.time > orthogonal.time * 0.97, "{sensitivity:?}");
    }
}

#[test]
fn hostile_values_end() {
    let hostile = [1e-300, 1e-12, 1e-3, 1.0, 1e3, 1e12, 1e300];
    for formulas in [Formulas::Paper, Formulas::Exact] {
        for value in hostile {
            for change in 0..8 {
                let mut problem = table_1(formulas, Lattice::Orthogonal);
                let length = Length::mm(value);
                match change {
                    0 => problem.work.width = length,
                    1 => problem.work.depth = length,
                    2 => problem.work.area = Area::mm2(value),
                    3 => problem.work.cutting_length = length,
                    4 => problem.work.half_apex = Angle::deg(60.0 - 59.0 * value.min(1.0)),
                    5 => {
                        problem.layer = Range {
                            least: length,
                            most: length,
                        }
                    }
                    6 => {
                        problem.step = Range {
                            least: length,
                            most: length,
                        }
                    }
                    _ => {
                        problem.swing = Range {
                            least: Angle::deg(1e-9),
                            most: Angle::deg(90.0 - 1e-9),
                        }
                    }
                }
                if let Ok(optimum) = solve(&problem) {
                    assert!(
                        optimum.layer.is_finite() && optimum.step.is_finite(),
                        "{problem:?} {optimum:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn another_optimiser_finds_nothing_better() {
    for formulas in [Formulas::Paper, Formulas::Exact] {
        for lattice in [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free] {
            let problem = table_1(formulas, lattice);
            let ours = solve(&problem).unwrap().time.to_s();
            let point = |x: &[f64]| Point {
                lattice,
                layer: Length::mm(x[0]),
                step: Length::mm(x[1]),
                swing: Angle::rad(x[2]),
            };
            let time = |x: &[f64], _: &mut ()| point(x).time(&problem);
            let reach = |x: &[f64], _: &mut ()| 10.0 - point(x).edge(&problem).to_mm();
            let scallop = |x: &[f64], _: &mut ()| 10.0 - point(x).scallop(&problem).to_mm();
            let gap = |x: &[f64], _: &mut ()| point(x).overlap();
            let limits: [&dyn cobyla::Func<()>; 3] = [&reach, &scallop, &gap];
            for start in [
                [3.0, 6.0, 0.785],
                [2.0, 2.0, 0.5],
                [4.0, 3.0, 0.3],
                [1.0, 1.0, 0.8],
                [5.0, 4.0, 0.6],
            ] {
                let sides = [(0.1, 50.0), (0.1, 85.0), (0.02, 50.0_f64.to_radians())];
                let stop = cobyla::StopTols {
                    ftol_rel: 1e-12,
                    ..Default::default()
                };
                let found = cobyla::minimize(
                    time,
                    &start,
                    &sides,
                    &limits,
                    (),
                    5000,
                    cobyla::RhoBeg::All(0.3),
                    Some(stop),
                );
                let (Ok((_, x, theirs)) | Err((_, x, theirs))) = found;
                if point(&x).keeps(&problem, 1e-9) {
                    assert!(
                        theirs >= ours * (1.0 - 1e-8),
                        "{formulas:?} {lattice:?}: {theirs} below {ours}"
                    );
                }
            }
        }
    }
}

/// A limit that is slack at the optimum changes nothing, over the widest range of swings too.
#[test]
fn a_slack_limit_on_time_changes_nothing() {
    let mut problem = table_1(Formulas::Exact, Lattice::Orthogonal);
    problem.lattices = vec![Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free];
    problem.swing = Range {
        least: Angle::deg(1.0),
        most: Angle::deg(89.0),
    };
    for scallop in [None, Some(Length::mm(10.0)), Some(Length::mm(4.0))] {
        problem.scallop = scallop;
        problem.time = None;
        let free = solve(&problem).unwrap();
        for share in [1.001, 1.3, 2.0, 10.0, 1000.0] {
            problem.time = Some(free.time * share);
            let limited = solve(&problem).unwrap();
            assert!(
                (limited.time / free.time - 1.0).abs() < 1e-6,
                "{scallop:?} {share}: {limited:?}"
            );
        }
    }
}
