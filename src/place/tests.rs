//! The search against judging every place of a coarse grid in another way.

use crate::score::{Score as PlaceScore, Scorer};
use crate::search::{Bounds, Criteria, search};
use crate::spot::Spot;
use core::f64::consts::TAU;
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::{Model, catalogue};
use vcutc_motion::axis_range::axis_margin;
use vcutc_motion::critical::clearance::clearance;
use vcutc_motion::critical::margin::{Judge, Score, singular_share};
use vcutc_motion::rig::Rig;

fn model() -> Model {
    catalogue::find("kuka/kr210_r3100_ultra").unwrap()
}

/// Blade down, leaning to either side, at the corners of a block.
fn poses() -> Vec<Pose> {
    let down = DMat3::from_cols(DVec3::Y, DVec3::X, -DVec3::Z);
    let mut poses = Vec::new();
    for lean in [-0.6, 0.6] {
        for x in [0.0, 300.0] {
            for y in [-40.0, 240.0] {
                for z in [20.0, 80.0] {
                    poses.push(Pose {
                        rotation: DMat3::from_rotation_y(lean) * down,
                        position: DVec3::new(x, y, z),
                    });
                }
            }
        }
    }
    poses
}

fn blade_in_flange() -> Pose {
    Pose {
        rotation: DMat3::IDENTITY,
        position: DVec3::new(0.0, 0.0, 310.0),
    }
}

fn judge(model: &Model) -> Judge<'_> {
    let (tool, anywhere) = (Frame::from(blade_in_flange()), upright(0.0, 0.0, 0.0));
    Judge::new(&Rig::new(model, tool, anywhere), poses())
}

/// By margins alone.
fn anywhere<'c, 'm>(judge: &'c Judge<'m>) -> Criteria<'c, 'm> {
    Criteria {
        rough: Scorer::by_margin(judge),
        fine: Scorer::by_margin(judge),
        admits: &|_| true,
    }
}

fn upright(x: f64, y: f64, z: f64) -> Frame {
    Frame {
        origin: Point3::new(x, y, z),
        orientation: Orientation::IDENTITY,
    }
}

/// The margin of a base from its definition: over branches, and over the turns of each axis, the largest of the smallest.
fn margin_by_definition(model: &Model, work_in_root: &Pose) -> Option<f64> {
    let flange = |pose: &Pose| *work_in_root * *pose * blade_in_flange().inverse();
    let on = |branch: Branch| -> Option<Vec<_>> {
        poses()
            .iter()
            .map(|pose| {
                let all = model.mechanism.all(&flange(pose));
                all.iter()
                    .find(|solution| solution.branch == branch)
                    .map(|s| s.joints)
            })
            .collect()
    };
    let first = model.mechanism.all(&flange(&poses()[0]));
    let margins = first.iter().filter_map(|start| {
        let joints = on(start.branch)?;
        let axes = (0..6).map(|axis| {
            let turns = (-3..=3).map(|turn| {
                // All poses within half a turn of the first.
                let start = start.joints[axis] + TAU * f64::from(turn);
                joints
                    .iter()
                    .map(|joints| joints[axis] + TAU * ((start - joints[axis]) / TAU).round())
                    .map(|angle| axis_margin(&model.axes[axis], angle, angle))
                    .fold(f64::INFINITY, f64::min)
            });
            turns.fold(f64::NEG_INFINITY, f64::max)
        });
        let singular = joints
            .iter()
            .map(|joints| singular_share(&clearance(&model.mechanism, joints)));
        Some(axes.chain(singular).fold(f64::INFINITY, f64::min))
    });
    margins.max_by(f64::total_cmp).filter(|&margin| margin >= 0.0)
}

#[test]
fn the_best_place_is_no_worse_than_any_of_a_coarse_grid() {
    let model = model();
    let base = upright(1500.0, 0.0, 600.0);
    let bounds = Bounds {
        least: Spot {
            x: 1000,
            y: -600,
            z: 300,
            yaw: -300,
        },
        most: Spot {
            x: 2000,
            y: 600,
            z: 900,
            yaw: 300,
        },
    };
    let mut best = f64::NEG_INFINITY;
    for x in (1000..=2000).step_by(200) {
        for y in (-600..=600).step_by(200) {
            for z in (300..=900).step_by(200) {
                for yaw in (-300..=300).step_by(150) {
                    let work = Spot { x, y, z, yaw }.work_in_root(&base);
                    best = best.max(margin_by_definition(&model, &work).unwrap_or(best));
                }
            }
        }
    }
    assert!(best > 0.1, "the grid has places that reach all: {best}");
    let judge = judge(&model);
    let found = search(&anywhere(&judge), &base, &bounds);
    let winner = found[0];
    assert!(bounds.contain(winner.spot));
    let proven = margin_by_definition(&model, &winner.spot.work_in_root(&base)).unwrap();
    assert!((winner.score.room.margin - proven).abs() < 1e-9);
    assert!(proven >= best, "{proven} found, {best} on the grid");
}

#[test]
fn out_of_reach_everywhere_the_search_still_says_where_it_is_least_bad() {
    let model = model();
    let base = upright(9000.0, 0.0, 0.0);
    let bounds = Bounds {
        least: Spot {
            x: 8000,
            y: 0,
            z: 0,
            yaw: 0,
        },
        most: Spot {
            x: 9000,
            y: 0,
            z: 0,
            yaw: 0,
        },
    };
    let judge = judge(&model);
    let found = search(&anywhere(&judge), &base, &bounds);
    assert!(!found.is_empty() && found.iter().all(|place| place.score.reached().is_none()));
}

#[test]
fn the_search_is_the_same_on_any_number_of_threads() {
    let model = model();
    let base = upright(2600.0, 100.0, 600.0);
    let bounds = Bounds {
        least: Spot {
            x: 1300,
            y: -300,
            z: 500,
            yaw: -150,
        },
        most: Spot {
            x: 2700,
            y: 300,
            z: 700,
            yaw: 150,
        },
    };
    let judge = judge(&model);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| search(&anywhere(&judge), &base, &bounds))
    };
    let one = on(1);
    assert!(one[0].score.reached().is_some());
    assert_eq!(one, on(2));
    assert_eq!(one, on(7));
}

proptest! {
    #[test]
    fn a_base_has_the_margin_of_its_definition(
        x in 600.0..2600.0_f64, y in -900.0..900.0_f64, z in -200.0..1500.0_f64, yaw in -1.5..1.5_f64
    ) {
        let model = model();
        let work = Pose { rotation: DMat3::from_rotation_z(yaw), position: DVec3::new(x, y, z) };
        let score = judge(&model).score(&work);
        match (score.reached(), margin_by_definition(&model, &work)) {
            (Some(one), Some(other)) => prop_assert!((one - other).abs() < 1e-9, "{one} {other}"),
            (one, other) => prop_assert_eq!(one, other),
        }
    }
}

#[test]
fn fewer_missed_poses_are_better_than_any_margin() {
    let score = |missed, margin| Score { missed, margin };
    assert!(score(1, 0.0).better(&score(2, 0.9)).is_gt());
    assert!(score(1, 0.2).better(&score(1, 0.1)).is_gt());
    assert!(score(9, -5.0).better(&Score::WORST).is_gt());
}

#[test]
fn a_smaller_deviation_is_better_than_any_margin() {
    let score = |deviation: Option<f64>, margin| PlaceScore {
        room: Score { missed: 0, margin },
        deviation: deviation.map(Length::mm),
    };
    assert!(score(Some(0.02), 0.1).better(&score(Some(0.03), 0.5)).is_gt());
    assert!(score(Some(0.9), 0.1).better(&score(None, 0.09)).is_gt());
    assert!(score(Some(0.02), 0.4).better(&score(Some(0.02), 0.3)).is_gt());
    assert!(score(None, 0.05).better(&score(None, 0.04)).is_gt());
}

#[test]
fn a_spot_is_the_frame_it_prints() {
    let base = Frame {
        origin: Point3::new(1.0, 2.0, 3.0),
        orientation: Orientation::from_zyx(Zyx {
            a: Angle::deg(20.0),
            b: Angle::deg(10.0),
            c: Angle::deg(-70.0),
        }),
    };
    let spot = Spot {
        x: 1500,
        y: -20,
        z: 700,
        yaw: 333,
    };
    let (apart, turned) = spot.work_in_root(&base).apart(&Pose::from(spot.frame(&base)));
    assert!(apart < 1e-9 && turned < 1e-12, "{apart} {turned}");
}
