//! Programs of walls, uneven Vs and single flanks, replayed.

use super::{Bound, CutFault, Replay, replay};
use crate::cross_section::CrossSection;
use crate::report::{Report, report};
use crate::surface::wall_tests::{Material, is_possible};
use crate::surface::{Side, Surface, Vee};
use crate::timing::timing;
use core::num::NonZeroU32;
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, FeedId, Flank, Op, OperationId, OrientationId, Program, Site};
use vcutc_backend_api::testkit::Recipe;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

/// Swings in degrees.
const SWINGS: [f64; 4] = [0.0, 3.0, 34.16, 50.0];

/// A cut: its tip and the swings of its left and its right flank.
type Swung = (Point2, Option<usize>, Option<usize>);

const fn at(x: f64, z: f64) -> Point2 {
    Point2 { x, z }
}

fn program(cuts: &[Swung]) -> VerifiedProgram {
    let flanks = |&(number, (tip, left, right)): &(u32, Swung)| {
        let flanks = [(Flank::Left, left), (Flank::Right, right)];
        flanks.map(|(flank, swing)| Some((number, tip, flank, swing?)))
    };
    let cuts: Vec<(u32, Swung)> = (1..).zip(cuts.iter().copied()).collect();
    of_passes(cuts.iter().flat_map(flanks).flatten())
}

/// As [`program`], but the left flanks of all Vs come first.
fn program_by_layer(cuts: &[Swung]) -> VerifiedProgram {
    let cuts = || (1..).zip(cuts.iter().copied());
    let firsts = cuts().filter_map(|(number, (tip, left, right))| {
        right?;
        Some((number, tip, Flank::Left, left?))
    });
    let lasts = cuts().filter_map(|(number, (tip, left, right))| {
        let (flank, swing) = right.map_or((Flank::Left, left), |right| (Flank::Right, Some(right)));
        Some((number, tip, flank, swing?))
    });
    of_passes(firsts.chain(lasts))
}

/// A program of one layer without a machine, with a blade of 80 mm and a stock of 100 x 50 x 40 mm.
fn of_passes(passes: impl Iterator<Item = (u32, Point2, Flank, usize)>) -> VerifiedProgram {
    let mut program = Recipe {
        layers: 0,
        ..Recipe::default()
    }
    .program();
    program.cell = None;
    program.stock.width = Length::mm(100.0);
    program.stock.depth = Length::mm(50.0);
    program.stock.height = Length::mm(40.0);
    program.blades[0].straight_mut().unwrap().cutting_length = Length::mm(80.0);
    program.ops.clear();
    program.orientations = Vec::new();
    for swing in SWINGS {
        let postures = Recipe {
            swing: Angle::deg(swing),
            ..Recipe::default()
        }
        .program()
        .orientations;
        // Left and right flank, both forward.
        program.orientations.extend([postures[0], postures[2]]);
    }
    for (number, tip, flank, swing) in passes {
        pass(&mut program, number, tip, flank, swing);
    }
    verify(program).unwrap()
}

/// A flank from the front to the back.
fn pass(program: &mut Program, number: u32, tip: Point2, flank: Flank, swing: usize) {
    let site = Site::Cut {
        operation: OperationId(0),
        layer: NonZeroU32::MIN,
        cut: NonZeroU32::new(number).unwrap(),
    };
    let place = |y, z| Point3::new(tip.x, y, z);
    let held = 2 * swing + usize::from(flank == Flank::Right);
    let orientation = OrientationId(held.try_into().unwrap());
    let feed = FeedId(0);
    let actions = [
        Action::AxisTravel {
            to: place(-60.0, 60.0),
            orientation,
        },
        Action::Approach {
            to: place(-60.0, tip.z),
            feed,
        },
        Action::Cut {
            flank,
            to: place(110.0, tip.z),
            feed,
        },
        Action::Retract {
            to: place(110.0, 60.0),
            feed,
        },
    ];
    program.ops.extend(actions.map(|action| Op { action, site }));
}

fn slope(swing: usize) -> f64 {
    match SWINGS[swing] {
        0.0 => f64::INFINITY,
        degrees => 1.0 / Angle::deg(degrees).tan(),
    }
}

fn vee((tip, left, right): Swung) -> Vee {
    Vee {
        tip,
        left: left.map(slope),
        right: right.map(slope),
    }
}

fn flat(z: f64) -> Profile {
    Profile::new(vec![at(0.0, z), at(100.0, z)]).unwrap()
}

const fn bound(part: &Profile) -> Bound<'_> {
    Bound {
        drop: Length::ZERO,
        ..Bound::of(part)
    }
}

/// Replayed with a part far below.
fn replayed(cuts: &[Swung]) -> Replay {
    replay(&program(cuts), &[bound(&flat(0.5))])
}

fn near(corners: impl Iterator<Item = Point2>, expected: &[(f64, f64)]) {
    let corners: Vec<_> = corners.map(|corner| (corner.x, corner.z)).collect();
    let is_near = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).abs() < 1e-9 && (a.1 - b.1).abs() < 1e-9;
    assert!(
        corners.len() == expected.len() && corners.iter().zip(expected).all(is_near),
        "{corners:?}"
    );
}

#[test]
fn a_v_with_a_wall_comes_free_and_uses_the_edge_that_geometry_says() {
    let replay = replayed(&[(at(30.0, 10.0), Some(0), Some(2))]);
    assert_eq!(replay.findings, super::Findings::default());
    let run = 30.0 * Angle::deg(34.16).tan();
    let expected = [
        (0.0, 40.0),
        (30.0, 40.0),
        (30.0, 10.0),
        (30.0 + run, 40.0),
        (100.0, 40.0),
    ];
    near(replay.surface.corners(), &expected);
    let recipe = Recipe::default();
    let half_apex = recipe.program().blades[0].straight().unwrap().half_apex;
    // The flank that leans needs more [Cui 2].
    let edge = 30.0 / (Angle::deg(34.16).cos() * (recipe.rake - half_apex).sin());
    assert!((replay.longest_edge.to_mm() - edge).abs() < 1e-9);
    assert_eq!(replay.layers, [(OperationId(0), 1)]);
    let wall = replayed(&[(at(30.0, 10.0), Some(0), None)]).longest_edge;
    assert!((wall.to_mm() - 30.0 / (recipe.rake - half_apex).sin()).abs() < 1e-9);
}

#[test]
fn a_single_flank_comes_free_from_a_wall_and_not_from_within() {
    let wall = (at(30.0, 10.0), Some(0), Some(2));
    let freed = replayed(&[wall, (at(30.0, 10.0), Some(2), None)]);
    assert_eq!(freed.findings, super::Findings::default());
    let run = 30.0 * Angle::deg(34.16).tan();
    let expected = [
        (0.0, 40.0),
        (30.0 - run, 40.0),
        (30.0, 10.0),
        (30.0 + run, 40.0),
        (100.0, 40.0),
    ];
    near(freed.surface.corners(), &expected);
    for swing in [0, 2] {
        let stuck = replayed(&[wall, (at(10.0, 10.0), Some(swing), None)]);
        let (count, finding) = stuck.findings.not_freed.unwrap();
        let CutFault::NotFreed { needed, available } = finding.fault else {
            panic!("{finding:?}")
        };
        assert_eq!((count, finding.cut.get(), finding.tip), (1, 2, at(10.0, 10.0)));
        assert!(needed.to_mm() == f64::INFINITY && available == Length::mm(80.0));
        near(
            stuck.surface.corners(),
            &[
                (0.0, 40.0),
                (30.0, 40.0),
                (30.0, 10.0),
                (30.0 + run, 40.0),
                (100.0, 40.0),
            ],
        );
    }
}

#[test]
fn what_enters_the_part_is_found_with_walls_single_flanks_and_slits() {
    let part = flat(13.0);
    for (left, right) in [
        (Some(0), Some(2)),
        (Some(2), Some(0)),
        (Some(2), None),
        (None, Some(2)),
        (Some(0), None),
        (None, Some(0)),
        (Some(0), Some(0)),
    ] {
        for (z, depth) in [(10.0, Some(3.0)), (13.0, None)] {
            let cuts = [(at(60.0, 13.0), Some(2), Some(2)), (at(30.0, z), left, right)];
            let found = replay(&program(&cuts), &[bound(&part)]).findings.overcut;
            let found = found.map(|finding| (finding.cut.get(), finding.fault));
            let expected = depth.map(|depth| {
                let (at, depth) = (at(30.0, z), Length::mm(depth));
                (2, CutFault::Overcut { at, depth })
            });
            assert_eq!(found, expected, "{left:?} {right:?}");
        }
    }
}

/// Distance from a point to the nearest of many points of a polyline.
fn sampled_distance(point: Point2, points: &[Point2]) -> f64 {
    points
        .iter()
        .map(|p| p.distance(point))
        .fold(f64::INFINITY, f64::min)
}

/// Points of a polyline, at most so far apart.
fn dense(line: &[Point2], apart: f64) -> Vec<Point2> {
    let pieces = line.windows(2).flat_map(|pair| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a count of samples"
        )]
        let count = (pair[0].distance(pair[1]) / apart).ceil().max(1.0) as u32;
        (0..=count).map(move |i| pair[0].lerp(pair[1], f64::from(i) / f64::from(count)))
    });
    pieces.collect()
}

fn reported(cuts: &[Swung], part: &Profile) -> (Report, Vec<Point2>) {
    let program = program(cuts);
    let replay = replay(&program, &[bound(part)]);
    let corners = replay.surface.corners().collect();
    let report = report(replay, program.program().stock, part, timing(&program));
    (report, corners)
}

#[test]
fn a_hollow_beside_a_wall_is_reported() {
    // The part has a hollow that no cut reaches, under a floor between two walls.
    let part = Profile::new(vec![
        at(0.0, 20.0),
        at(45.0, 20.0),
        at(45.5, 2.0),
        at(46.0, 20.0),
        at(100.0, 20.0),
    ])
    .unwrap();
    let cuts = [
        (at(0.0, 21.0), None, Some(3)),
        (at(25.0, 21.0), Some(3), Some(3)),
        (at(40.0, 21.0), Some(0), Some(3)),
        (at(60.0, 21.0), Some(3), Some(0)),
        (at(75.0, 21.0), Some(3), Some(3)),
        (at(100.0, 21.0), Some(3), None),
    ];
    let (report, corners) = reported(&cuts, &part);
    assert!(corners.windows(2).any(|pair| pair[0].x == pair[1].x));
    let points = dense(&corners, 0.005);
    let deepest = dense(part.points(), 0.05)
        .into_iter()
        .map(|point| sampled_distance(point, &points))
        .fold(0.0, f64::max);
    assert!(
        (report.deepest.height.to_mm() - deepest).abs() < 0.01,
        "{deepest} {:?}",
        report.deepest
    );
    assert_eq!(report.deepest.peak, at(45.5, 2.0));
    assert_eq!(report.hollow(), Some(report.deepest));
}

fn a_cut() -> impl Strategy<Value = Swung> {
    let swing = || prop::option::weighted(0.8, 0..SWINGS.len());
    let x = prop_oneof![(0..=20_u32).prop_map(|x| f64::from(x) * 5.0), 0.0..100.0_f64];
    (x, (1..=7_u32), swing(), swing()).prop_map(|(x, z, left, right)| {
        let left = if right.is_none() { left.or(Some(0)) } else { left };
        (at(x, f64::from(z) * 5.0), left, right)
    })
}

/// Those of some cuts that nothing blocks, and what slicing polygons along them leaves.
fn possible(cuts: Vec<Swung>) -> (Vec<Swung>, Material) {
    let mut section = CrossSection::new(Surface::flat(100.0, 40.0));
    let mut material = Material::block(100.0, 40.0);
    let (mut kept, mut slits) = (Vec::new(), Vec::new());
    for cut in cuts {
        if is_possible(section.surface(), vee(cut)) {
            section.release(vee(cut));
            material.cut_beside(vee(cut), &mut slits);
            kept.push(cut);
        }
    }
    (kept, material)
}

proptest! {
    #[test]
    fn a_replay_leaves_what_slicing_polygons_leaves(cuts in prop::collection::vec(a_cut(), 1..20)) {
        let (cuts, material) = possible(cuts);
        let replay = replayed(&cuts);
        prop_assert_eq!(replay.findings.blocked, None);
        let apart = Material::below(&replay.surface).differs_by(&material);
        prop_assert!(apart < 1e-3, "{apart} of {cuts:?}");
        let by_layer = super::replay(&program_by_layer(&cuts), &[bound(&flat(0.5))]);
        prop_assert!(by_layer.surface.corners().eq(replay.surface.corners()));
        prop_assert_eq!(by_layer.layers, replay.layers);
    }

    /// The largest distance of either contour from the other, against points of both.
    #[test]
    fn deviations_are_those_of_many_points(
        cuts in prop::collection::vec(a_cut(), 1..8),
        heights in prop::collection::vec(0.5..4.0_f64, 6),
    ) {
        let (cuts, _) = possible(cuts);
        let points = (0_u32..).zip(&heights).map(|(i, &z)| at(f64::from(i) * 20.0, z)).collect();
        let part = Profile::new(points).unwrap();
        let (report, corners) = reported(&cuts, &part);
        let (surface, below) = (dense(&corners, 0.25), dense(part.points(), 0.25));
        let far = |from: &[Point2], to: &[Point2]| {
            from.iter().map(|&point| sampled_distance(point, to)).fold(0.0, f64::max)
        };
        let (scallop, deepest) = (far(&surface, &below), far(&below, &surface));
        prop_assert!((report.scallop.height.to_mm() - scallop).abs() < 0.2, "{scallop} {:?}", report.scallop);
        prop_assert!((report.deepest.height.to_mm() - deepest).abs() < 0.2, "{deepest} {:?}", report.deepest);
        let largest = scallop.max(deepest);
        prop_assert!((report.largest_deviation().to_mm() - largest).abs() < 0.2);
        if (deepest - scallop).abs() > 0.6 {
            prop_assert_eq!(report.hollow().is_some(), deepest > scallop);
        }
    }
}

/// A flank of the right side only, from the left side of the stock.
#[test]
fn a_single_flank_comes_free_from_the_side_of_the_stock() {
    let replay = replayed(&[(at(0.0, 20.0), None, Some(2)), (at(100.0, 20.0), Some(2), None)]);
    assert_eq!(replay.findings, super::Findings::default());
    let run = 20.0 * Angle::deg(34.16).tan();
    near(
        replay.surface.corners(),
        &[(0.0, 20.0), (run, 40.0), (100.0 - run, 40.0), (100.0, 20.0)],
    );
    assert_eq!(
        vee((at(0.0, 0.0), None, Some(0))),
        Vee::one(at(0.0, 0.0), Side::Right, f64::INFINITY)
    );
}
