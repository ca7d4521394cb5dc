//! Joints of chains: random ways off the pieces within the blend, with the axes from the inverse kinematics.

use super::*;
use vcutc_machine::kinematics::samples;

/// The axes at a joint, before anything is known of what they do around it.
fn standing(start: &Joints, end: &Joints) -> Proof {
    Proof {
        start: *start,
        end: *end,
        low: *end,
        high: *end,
        rate: [0.0; 6],
        clearance: Clearance::UNLIMITED,
        solves: 0,
    }
}

/// A course that begins where another ends.
fn going_on(dice: &mut Dice, before: &Course, longest: f64) -> Course {
    let from = before.to;
    let length = dice.between(1.0, longest);
    let to = Pose {
        rotation: dice.rotation(0.6) * from.rotation,
        position: from.position + dice.direction() * length,
    };
    let duration = length / dice.between(20.0, 600.0);
    Course {
        from,
        to,
        arc: None,
        duration,
    }
}

fn length(course: &Course) -> f64 {
    course.arc.map_or_else(
        || course.from.position.distance(course.to.position),
        |arc| arc.length().to_mm(),
    )
}

/// How a course turns the blade, as a vector in the work.
fn spin(course: &Course) -> DVec3 {
    let turned = DQuat::from_mat3(&(course.to.rotation * course.from.rotation.transpose()));
    let (axis, angle) = turned.to_axis_angle();
    if angle > PI {
        -axis * (2.0 * PI - angle)
    } else {
        axis * angle
    }
}

/// Where the tip is, and how fast it moves there.
fn tip(course: &Course, s: f64) -> (DVec3, DVec3) {
    let (here, h) = (blade_at(course, s).position, 1e-6);
    let ahead = blade_at(course, s + h).position;
    (here, (ahead - here) / (h * course.duration))
}

fn rotated(by: DVec3) -> DMat3 {
    if by.length() < 1e-12 {
        DMat3::IDENTITY
    } else {
        DMat3::from_quat(DQuat::from_scaled_axis(by))
    }
}

/// How both courses turn the blade in the zone of their joint, away from it.
fn turned(through: &Through<'_>) -> [DVec3; 2] {
    let of = |course: &Course| spin(course) * (through.blend / length(course)).min(1.0);
    [-of(through.before), of(through.after)]
}

/// Up to this blend, and this far from singular poses, no joint is refused that turns the blade by less than this.
const MOST_BLEND: f64 = 0.5;
const FAR: Clearance = Clearance {
    wrist: 0.3,
    elbow: 0.4,
    shoulder: 200.0,
};
const FAR_TURN: f64 = 0.02;

/// How far axes go and how fast they are at most around a joint, among random ways.
struct Found {
    away: f64,
    rate: f64,
}

fn check(
    dice: &mut Dice,
    rig: &Rig<'_>,
    through: &Through<'_>,
    branch: Branch,
    at: &Joints,
    proof: &Proof,
) -> Found {
    let courses = [through.before, through.after];
    let shares = courses.map(|course| (through.blend / length(course)).min(1.0));
    let turns = turned(through);
    let mut found = Found { away: 0.0, rate: 0.0 };
    for number in 0..400 {
        let places = [
            1.0 - shares[0] * dice.between(0.0, 1.0),
            shares[1] * dice.between(0.0, 1.0),
        ];
        let tips: [(DVec3, DVec3); 2] = core::array::from_fn(|i| tip(courses[i], places[i]));
        let (point, _) = tips[number % 2];
        let mix = |dice: &mut Dice, one: DVec3, other: DVec3| {
            let (all, share) = (dice.between(0.0, 1.0), dice.between(0.0, 1.0));
            (one * share + other * (1.0 - share)) * all
        };
        let pose = Pose {
            position: point + dice.direction() * (through.blend * dice.between(0.0, 1.0)),
            rotation: rotated(mix(dice, turns[0], turns[1])) * through.before.to.rotation,
        };
        let solve = |pose: &Pose, near: &Joints| {
            rig.mechanism
                .on_branch(&rig.flange_in_root(pose), branch, near)
                .unwrap()
        };
        let here = solve(&pose, at);
        let velocity = mix(dice, tips[0].1, tips[1].1);
        let spins = [0, 1].map(|i| spin(courses[i]) / courses[i].duration);
        let spun = mix(dice, spins[0], spins[1]);
        let step = 1e-6;
        let next = solve(
            &Pose {
                position: pose.position + velocity * step,
                rotation: rotated(spun * step) * pose.rotation,
            },
            &here,
        );
        for axis in 0..6 {
            assert!(
                proof.low[axis] <= here[axis] && here[axis] <= proof.high[axis],
                "{number}, axis {axis}: {} not in {} to {}",
                here[axis],
                proof.low[axis],
                proof.high[axis]
            );
            let rate = (next[axis] - here[axis]).abs() / step;
            assert!(
                rate <= proof.rate[axis] + 1e-3,
                "{number}, axis {axis}: {rate} {}",
                proof.rate[axis]
            );
            found.away = found.away.max((here[axis] - at[axis]).abs());
            found.rate = found.rate.max(rate);
        }
    }
    found
}

fn agree(model: &Model, ranges: &[Axis], branch_of: impl Fn(&Rig<'_>, &Joints) -> Branch, seed: u64) {
    let rig = rig(model);
    let mut dice = Dice(seed);
    let mut proven = 0;
    for number in 0..60 {
        let draw: Draw = if number % 2 == 0 { random_arc } else { random_move };
        let (before, _, start) = draw(&mut dice, &rig, ranges, 80.0, 0.6);
        let branch = branch_of(&rig, &start);
        let after = going_on(&mut dice, &before, 80.0);
        let blend = dice.between(0.02, MOST_BLEND);
        let Ok(proof) = prove(&rig, &before, branch, &start, &LEAST) else {
            continue;
        };
        let through = Through {
            before: &before,
            after: &after,
            blend,
        };
        let at_joint = standing(&proof.start, &proof.end);
        let around = match prove_through(&rig, &through, branch, &at_joint, &LEAST) {
            Ok(around) => around,
            Err(breach) => {
                let is_hard = matches!(rig.mechanism, Mechanism::Serial(_))
                    || prove(&rig, &before, branch, &start, &FAR).is_err()
                    || turned(&through).iter().any(|turn| turn.length() > FAR_TURN);
                assert!(is_hard, "{number}: {breach:?}, blend {blend}");
                continue;
            }
        };
        proven += 1;
        let found = check(&mut dice, &rig, &through, branch, &proof.end, &around);
        let wide = (0..6)
            .map(|axis| around.high[axis] - around.low[axis])
            .fold(0.0, f64::max);
        assert!(
            wide <= 10.0 * found.away + 1e-6,
            "{number}: {wide} {}",
            found.away
        );
        let rate = around.rate.iter().copied().fold(0.0, f64::max);
        assert!(rate <= 6.0 * found.rate + 0.01, "{number}: {rate} {}", found.rate);
    }
    assert!(proven >= 20, "{proven}");
}

#[test]
fn no_way_through_a_joint_leaves_the_bounds_of_an_arm() {
    for (number, model) in [kuka(), beside(), rods()].into_iter().enumerate() {
        let ranges = model.axes.clone();
        agree(&unbound(model), &ranges, branch_of, 41 + number as u64);
    }
}

#[test]
fn no_way_through_a_joint_leaves_the_bounds_of_an_arm_without_a_closed_form() {
    let mut model = unbound(kuka());
    model.mechanism = Mechanism::Serial(samples::ur10e());
    let range = |axis: &Axis| Axis {
        min: -3.0,
        max: 3.0,
        ..axis.clone()
    };
    let ranges: Vec<Axis> = model.axes.iter().map(range).collect();
    agree(&model, &ranges, |_, _| Branch::Numbered(0), 44);
}

/// A limit just within what random ways reach is broken, and one just outside of the bounds is kept.
#[test]
fn limits_are_kept_around_a_joint() {
    let model = unbound(kuka());
    let free = rig(&model);
    let mut dice = Dice(45);
    let (before, branch, start) = random_move(&mut dice, &free, &kuka().axes, 80.0, 0.3);
    let slow = Course {
        duration: 10.0,
        ..before
    };
    let after = going_on(&mut dice, &slow, 80.0);
    let through = Through {
        before: &slow,
        after: &after,
        blend: 0.3,
    };
    let proof = prove(&free, &slow, branch, &start, &LEAST).unwrap();
    let at_joint = standing(&proof.start, &proof.end);
    let around = prove_through(&free, &through, branch, &at_joint, &LEAST).unwrap();
    for axis in 0..6 {
        for (more, is_kept) in [(1e-6, true), (-1e-6, false)] {
            let mut limited = model.clone();
            limited.axes[axis].max = around.high[axis] + more;
            let limited = rig(&limited);
            let found = prove_through(&limited, &through, branch, &at_joint, &LEAST);
            assert_eq!(found.is_ok(), is_kept, "{axis} {more}");
            if let Err(breach) = found {
                assert!(matches!(breach.what, Violation::Limit { axis: which, .. } if which == axis));
            }
        }
    }
}
