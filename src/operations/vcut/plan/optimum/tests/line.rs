//! What one coordinate decides, compared with the search over all shapes and with the planner's own formulas.

use super::super::formulas::Model;
use super::super::ground::Measure;
use super::super::line;
use super::super::published::table_1;
use super::super::search::{self, Goal};
use super::super::{Extension, Problem, Range, Work, solve};
use super::{Point, some_work};
use crate::asked::{Formulas, Lattice, Objective};
use proptest::prelude::*;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::number::{Interval, OnLine};

/// Problems whose least value one coordinate may decide: the paper's formulas with layer and step open.
fn problem_of_the_paper() -> impl Strategy<Value = Problem> {
    let how = (
        prop::sample::select(vec![Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free]),
        any::<bool>(),
        prop::option::weighted(0.5, 2.0..25.0_f64),
        some_work(),
    );
    let swing = (0.5..70.0_f64, 0.0..80.0_f64).prop_map(|(least, more)| (least, (least + more).min(88.0)));
    let limits = (0.0..0.4_f64, prop::option::weighted(0.3, 5.0..15.0_f64));
    (how, swing, limits).prop_map(
        |((lattice, fixed, scallop, work), swing, (overlap, edge))| Problem {
            lattices: vec![lattice],
            work: Work {
                extension: if fixed {
                    work.extension
                } else {
                    Extension::EdgeInUse
                },
                ..work
            },
            swing: Range {
                least: Angle::deg(swing.0),
                most: Angle::deg(swing.1),
            },
            overlap: Range {
                least: overlap,
                most: 0.9,
            },
            scallop: scallop.map(Length::mm),
            edge: edge.map(Length::mm),
            ..table_1(Formulas::Paper, lattice)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn what_one_coordinate_decides_the_search_finds_too(problem in problem_of_the_paper()) {
        let model = Model::new(&problem, problem.lattices[0]);
        for measure in [Measure::Time, Measure::Cuts] {
            if let Some(decided) = line::best(&model, measure) {
                let searched = search::best(&model, measure, Goal::Best).unwrap();
                prop_assert!(decided.value <= searched.value * (1.0 + 1e-12), "{decided:?} {searched:?}");
                prop_assert!(decided.value >= searched.value * (1.0 - 1e-7), "{decided:?} {searched:?}");
            }
        }
    }

    #[test]
    fn nothing_of_a_swing_costs_less_than_at_its_widest(
        problem in problem_of_the_paper(),
        at in 0.0..1.0_f64,
        share in 0.0..1.0_f64,
        thinner in 0.2..1.0_f64,
    ) {
        let model = Model::new(&problem, problem.lattices[0]);
        if model.is_least_at_widest() {
            let Range { least, most } = problem.swing;
            let swing = least + (most - least) * at;
            let widest = model.at_widest(swing.tan());
            // By the formulas of the planner: any thinner layer and narrower step.
            let share = (1.0 - problem.overlap.least) * share.max(0.01);
            let at = |layer: f64| Point {
                lattice: problem.lattices[0],
                swing,
                layer: Length::mm(layer),
                step: Length::mm(2.0 * share * layer * swing.tan()),
            };
            let point = at(thinner * (problem.longest_edge() / at(1.0).edge(&problem)));
            prop_assert!(widest.time <= point.time(&problem) * (1.0 + 1e-12), "{point:?}");
            prop_assert!(widest.cuts <= point.cuts(&problem) * (1.0 + 1e-12), "{point:?}");
        }
    }

    #[test]
    fn stretches_enclose_what_is_in_them(
        problem in problem_of_the_paper(),
        at in 0.02..3.0_f64,
        width in 0.0..0.8_f64,
        inside in 0.0..1.0_f64,
    ) {
        let model = Model::new(&problem, problem.lattices[0]);
        let side = Interval { low: at, high: at * (1.0 + width) };
        let place = (side.low + inside * (side.high - side.low)).min(side.high);
        let over = model.at_widest(OnLine::coordinate(0, side)).time;
        let here = model.at_widest(OnLine::coordinate(0, place)).time;
        let within = |over: Interval, here: f64| {
            let room = 1e-9 * (1.0 + here.abs());
            over.low - room <= here && here <= over.high + room
        };
        prop_assert!(within(over.value, here.value));
        prop_assert!(within(over.by[0], here.by[0]));
        prop_assert!(within(over.curve[0], here.curve[0]));
        // The derivatives are those of the function, away from kinks.
        let step = 1e-5 * place;
        let value = |place: f64| model.at_widest(place).time;
        let slope = (value(place + step) - value(place - step)) / (2.0 * step);
        let kinked = (value(place + step) - 2.0 * here.value + value(place - step)).abs() / (step * step)
            > 10.0 * (1.0 + here.curve[0].abs());
        prop_assert!(kinked || (slope - here.by[0]).abs() < 1e-5 * (1.0 + here.value / place), "{slope} {here:?}");
        let by = |place: f64| model.at_widest(OnLine::coordinate(0, place)).time.by[0];
        let curve = (by(place + step) - by(place - step)) / (2.0 * step);
        let size = 1.0 + (here.value / place + here.by[0].abs()) / place;
        prop_assert!(kinked || (curve - here.curve[0]).abs() < 1e-5 * size, "{curve} {here:?}");
    }
}

/// One coordinate decides the published problem, to all digits.
#[test]
fn the_papers_optimum_is_proven_to_twelve_digits() {
    for lattice in [Lattice::Orthogonal, Lattice::Free] {
        for objective in [Objective::Time, Objective::Cuts] {
            let mut problem = table_1(Formulas::Paper, lattice);
            problem.objective = objective;
            let optimum = solve(&problem).unwrap();
            assert!(optimum.gap <= 1e-12, "{optimum:?}");
        }
    }
}
