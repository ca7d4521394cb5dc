//! Axis moves against dense sampling.

use super::*;
use crate::path::chain::{Chain, evenly};
use vcutc_machine::kinematics::samples;

const STOCK: Block = Block {
    low: DVec3::ZERO,
    high: DVec3::new(600.0, 400.0, 300.0),
};

/// Tip, and the end of the shank with something of width.
const BLADE: [DVec3; 4] = [
    DVec3::ZERO,
    DVec3::new(-20.0, 0.0, -60.0),
    DVec3::new(20.0, 0.0, -60.0),
    DVec3::new(0.0, 0.0, -150.0),
];

/// The same blade below a stage of a body, which is wider.
fn solids() -> Vec<Solid> {
    let ends = [-90.0, -150.0].map(|z| DVec3::new(0.0, 0.0, z));
    vec![
        Solid::Hull(BLADE.to_vec()),
        Solid::Cylinder { ends, radius: 70.0 },
    ]
}

/// Points of each of them, in T: those of the rims of the stage are close to one another.
fn points() -> [Vec<DVec3>; 2] {
    let rims = (0..360).flat_map(|degrees| {
        let (sine, cosine) = libm::sincos(f64::from(degrees).to_radians());
        [-90.0, -150.0].map(|z| DVec3::new(70.0 * cosine, 70.0 * sine, z))
    });
    [BLADE.to_vec(), rims.collect()]
}

/// Axis values within their ranges that hold the blade down over the stock or beside it.
fn near_the_stock(dice: &mut Dice, rig: &Rig<'_>) -> Joints {
    loop {
        let blade = Pose {
            rotation: dice.rotation(0.8) * DMat3::from_cols(DVec3::Y, DVec3::X, -DVec3::Z),
            position: DVec3::new(
                dice.between(-200.0, 800.0),
                dice.between(-200.0, 600.0),
                dice.between(230.0, 550.0),
            ),
        };
        let solutions = rig.mechanism.all(&rig.flange_in_root(&blade));
        let in_range = |joints: &Joints| {
            let mut axes = joints.iter().zip(rig.axes);
            axes.all(|(value, axis)| (axis.min..axis.max).contains(value))
        };
        if let Some(found) = solutions.iter().find(|solution| in_range(&solution.joints)) {
            return found.joints;
        }
    }
}

/// How far all of some points are beyond the best of the stock's faces, where that is least on the move; in mm.
fn outside(rig: &Rig<'_>, from: &Joints, to: &Joints, solid: &[DVec3]) -> f64 {
    (0..=1500)
        .map(|k| {
            let joints = core::array::from_fn(|i| from[i] + (to[i] - from[i]) * f64::from(k) / 1500.0);
            let blade = rig.blade_in_work(&joints);
            let points = solid.iter().map(|&point| blade.rotation * point + blade.position);
            let beyond = |depth: fn(DVec3) -> DVec3| -> f64 {
                let least = points.clone().map(depth).reduce(DVec3::min);
                least.unwrap().max_element()
            };
            beyond(|point| point - STOCK.high).max(beyond(|point| STOCK.low - point))
        })
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn moves_of_all_axes_stay_out_of_the_stock_as_sampled() {
    for model in [kuka(), beside(), rods()] {
        let rig = rig(&model);
        let mut dice = Dice(21);
        let (solids, points) = (solids(), points());
        let (mut proven, mut refused, mut refuted, mut by_the_body) = (0, 0, 0, 0);
        for number in 0..200 {
            let (from, to) = (near_the_stock(&mut dice, &rig), near_the_stock(&mut dice, &rig));
            let each = points.each_ref().map(|points| outside(&rig, &from, &to, points));
            let outside = each[0].min(each[1]);
            if are_axes_refuted(&rig, &from, &to, &solids, &STOCK) {
                assert!(prove_axes(&rig, &from, &to, &solids, &STOCK).is_err());
                refuted += 1;
            }
            match prove_axes(&rig, &from, &to, &solids, &STOCK) {
                Ok(()) => {
                    assert!(outside >= -1e-3, "{}, move {number}: {outside} mm", model.name);
                    proven += 1;
                }
                Err(breach) => {
                    assert!(
                        outside < 0.1,
                        "{}, move {number}: {breach:?} but {outside} mm",
                        model.name
                    );
                    refused += 1;
                    match breach.what {
                        AxesViolation::Stock { solid, .. } => {
                            assert!(each[solid] < 0.0, "{}, move {number}", model.name);
                            by_the_body += solid;
                        }
                        AxesViolation::Unproven { solid, .. } => by_the_body += solid,
                        AxesViolation::Limit { .. } => {}
                    }
                }
            }
        }
        assert!(proven > 40 && refused > 15, "{proven} and {refused}");
        assert!(by_the_body > 0, "{by_the_body} of {refused}");
        assert!(refuted > 10, "{refuted} of {refused} are seen sooner");
    }
}

/// A bar that leans over an edge of the stock, 7 mm away from it, is beyond no face. It is proven once all of it is above the top or
/// beside the stock, of a round one with its skin.
#[test]
fn solids_are_outside_where_all_of_each_is_beyond_one_face() {
    let model = kuka();
    let rig = rig(&model);
    let still = [0.0, -FRAC_PI_2, FRAC_PI_2, 0.0, 0.5, 0.0];
    let work_in_blade = rig.blade_in_work(&still).inverse();
    let ends = |by: DVec3| {
        let ends = [DVec3::new(-20.0, 200.0, 290.0), DVec3::new(20.0, 200.0, 330.0)];
        ends.map(|end| work_in_blade.rotation * (end + by) + work_in_blade.position)
    };
    let found = |solid: Solid| {
        let proof = prove_axes(&rig, &still, &still, &[solid], &STOCK);
        proof.map_err(|breach| match breach.what {
            AxesViolation::Unproven { lowest, .. } => (false, lowest.z),
            AxesViolation::Stock { lowest, .. } => (true, lowest.z),
            AxesViolation::Limit { .. } => panic!("{breach:?}"),
        })
    };
    let flat = |x: f64, z: f64| found(Solid::Hull(ends(DVec3::new(x, 0.0, z)).to_vec()));
    let round = |x: f64, z: f64| {
        let ends = ends(DVec3::new(x, 0.0, z));
        found(Solid::Cylinder { ends, radius: 1.0 })
    };
    let is_beside = |proof: Result<(), (bool, f64)>, lowest: f64| {
        proof.is_err_and(|(is_inside, z)| !is_inside && (z - lowest).abs() < 1e-6)
    };
    // Skins reach beyond ends at 45 degrees by so much.
    let skin = 0.5_f64.sqrt();
    assert!(is_beside(flat(0.0, 0.0), 290.0));
    assert!(is_beside(round(0.0, 0.0), 290.0 - skin));
    assert!(is_beside(flat(0.0, 9.999), 299.999));
    assert_eq!(flat(0.0, 10.001), Ok(()));
    assert!(is_beside(round(0.0, 9.999 + skin), 299.999));
    assert_eq!(round(0.0, 10.001 + skin), Ok(()));
    assert!(flat(-19.999, 0.0).is_err());
    assert_eq!(flat(-20.001, 0.0), Ok(()));
    assert!(round(-19.999 - skin, 0.0).is_err());
    assert_eq!(round(-20.001 - skin, 0.0), Ok(()));
    // Farther down it goes through the edge.
    assert!(flat(0.0, -15.0).is_err_and(|(is_inside, _)| is_inside));
    assert!(round(0.0, -15.0).is_err_and(|(is_inside, _)| is_inside));
}

#[test]
fn points_are_carried_as_forward_kinematics_says() {
    let mut general = beside();
    general.mechanism = Mechanism::Serial(samples::ur10e());
    let names = catalogue::names().filter(|name| name.starts_with("generic/"));
    let machines = names.map(|name| catalogue::find(name).unwrap());
    for model in machines.chain([kuka(), beside(), rods(), general]) {
        let mut dice = Dice(22);
        for _ in 0..20 {
            let (from, to) = (
                random_joints(&mut dice, &model.axes),
                random_joints(&mut dice, &model.axes),
            );
            let point = dice.direction() * 300.0;
            // A span of the move's middle third.
            let along = evenly(&from, &to, 0.5, 1.0 / 6.0);
            let carried = Chain::of(&model.mechanism).point_in_root(&along, point);
            for s in [1.0 / 3.0, 0.41, 0.5, 0.6, 2.0 / 3.0] {
                let joints = core::array::from_fn(|i| from[i] + s * (to[i] - from[i]));
                let flange = model.mechanism.flange_in_root(&joints);
                let expected = flange.rotation * point + flange.position;
                for (i, coordinate) in carried.iter().enumerate() {
                    let value = coordinate.value();
                    assert!(
                        value.low - 1e-9 <= expected[i] && expected[i] <= value.high + 1e-9,
                        "{}",
                        model.name
                    );
                }
            }
            let here = Chain::of(&model.mechanism).point_in_root(&evenly(&from, &from, 0.5, 0.5), point);
            assert!(
                here.iter().all(|coordinate| coordinate.value().width() < 1e-8),
                "{}",
                model.name
            );
        }
    }
}

#[test]
fn both_ends_have_to_be_within_the_limits() {
    let model = kuka();
    let rig = rig(&model);
    let home = [0.0, -FRAC_PI_2, FRAC_PI_2, 0.0, 0.0, 0.0];
    let mut beyond = home;
    beyond[4] = -2.2;
    let far = Block {
        low: DVec3::splat(-9e5),
        high: DVec3::splat(-8e5),
    };
    assert_eq!(prove_axes(&rig, &home, &home, &solids(), &far), Ok(()));
    let what = AxesViolation::Limit { axis: 4, value: -2.2 };
    let breach = prove_axes(&rig, &home, &beyond, &solids(), &far);
    assert_eq!(breach, Err(AxesBreach { at: 1.0, what }));
}
