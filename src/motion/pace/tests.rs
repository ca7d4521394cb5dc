//! Ways of known shape and of a real arm, timed in ways of their own.

use super::chebyshev::Weights;
use super::profile::Bounds;
use super::track::{Part, Slopes};
use super::{phase, smooth, track};
use crate::path::{Course, Followed};
use crate::rig::Rig;
use proptest::prelude::*;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_machine::catalogue;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::pose::Pose;

/// A way of two axes with their first three derivatives.
type Curve = fn(f64) -> [[f64; 3]; 2];

/// An arc of a circle of radius 100.
fn arc(u: f64) -> [[f64; 3]; 2] {
    let (s, c) = libm::sincos(2.0 * u);
    [
        [-200.0 * s, -400.0 * c, 800.0 * s],
        [200.0 * c, -400.0 * s, -800.0 * c],
    ]
}

/// Two axes of which one turns round on the way.
fn wave(u: f64) -> [[f64; 3]; 2] {
    let (s, c) = libm::sincos(5.0 * u);
    [[80.0 + 40.0 * u, 40.0, 0.0], [150.0 * c, -750.0 * s, -3750.0 * c]]
}

fn slopes([first, second, third]: [f64; 3]) -> Slopes {
    Slopes { first, second, third }
}

/// A curve in so many equal parts.
fn parts(curve: Curve, count: u32) -> Vec<Part> {
    let length = 1.0 / f64::from(count);
    (0..count)
        .map(|k| {
            let [one, other] = curve((f64::from(k) + 0.5) * length);
            let mut axes = [Slopes::default(); MOST_AXES];
            axes[0] = slopes(one);
            axes[1] = slopes(other);
            Part { length, axes }
        })
        .collect()
}

fn bounds(rate: f64, acceleration: f64) -> Bounds {
    Bounds {
        rate: Some(rate),
        acceleration: Some(acceleration),
        jerk: None,
    }
}

fn all(bounds: Bounds) -> [Bounds; MOST_AXES] {
    [bounds; MOST_AXES]
}

/// The same by brute force: the fastest chain of states over a fine mesh of the phase plane, where each step from one place to
/// the next is at constant acceleration and keeps the bounds at both of its ends. An upper bound that closes in from above.
fn by_mesh(curve: Curve, b: Bounds, most: f64, places: u32, rates: u32) -> f64 {
    let (rate, acceleration) = (b.rate.unwrap(), b.acceleration.unwrap());
    let length = 1.0 / f64::from(places);
    // Rates evenly, so that z is fine where it is small.
    let z = |j: u32| {
        let share = f64::from(j) / f64::from(rates);
        most * most * share * share
    };
    let keeps = |u: f64, z: f64, second: f64| {
        curve(u).iter().all(|[first, bend, _]| {
            first.abs() * z.sqrt() <= rate * (1.0 + 1e-9)
                && (first * second + bend * z).abs() <= acceleration * (1.0 + 1e-9)
        })
    };
    let size = usize::try_from(rates).unwrap() + 1;
    let mut best = vec![f64::INFINITY; size];
    best[0] = 0.0;
    for k in 0..places {
        let (here, there) = (f64::from(k) * length, f64::from(k + 1) * length);
        let mut next = vec![f64::INFINITY; size];
        for (i, &so_far) in (0..=rates).zip(&best) {
            if so_far.is_infinite() {
                continue;
            }
            for (j, entry) in (0..=rates).zip(&mut next) {
                if i == 0 && j == 0 {
                    continue;
                }
                let second = (z(j) - z(i)) / (2.0 * length);
                if keeps(here, z(i), second) && keeps(there, z(j), second) {
                    let time = so_far + 2.0 * length / (z(i).sqrt() + z(j).sqrt());
                    *entry = entry.min(time);
                }
            }
        }
        best = next;
    }
    best[0]
}

#[test]
fn the_fastest_way_is_that_of_brute_force() {
    for (curve, most, acceleration) in [
        (arc as Curve, 1.0, 100.0),
        (arc, 0.4, 400.0),
        (wave, 1.0, 100.0),
        (wave, 0.7, 300.0),
    ] {
        let b = bounds(120.0, acceleration);
        let found = phase::duration(&parts(curve, 400), &all(b), most, Bounds::default());
        let mesh = by_mesh(curve, b, most, 60, 400);
        // The mesh is an upper bound, by about one in its number of places.
        assert!(found <= mesh * 1.001 && found >= mesh * 0.97, "{found} {mesh}");
    }
}

#[test]
fn a_straight_way_of_one_axis_has_the_closed_form() {
    let straight = |_: f64| [[90.0, 0.0, 0.0], [-30.0, 0.0, 0.0]];
    for (rate, acceleration, most) in [(100.0, 50.0, 10.0), (20.0, 1000.0, 10.0), (1e6, 2e3, 1.5)] {
        let b = bounds(rate, acceleration);
        let closed = Bounds {
            rate: Some(most),
            ..Bounds::default()
        }
        .and(b.over(90.0));
        let expected = closed.duration(1.0).unwrap();
        for count in [3, 24, 100] {
            let found = phase::duration(&parts(straight, count), &all(b), most, Bounds::default());
            assert!((found - expected).abs() < 1e-9 * expected, "{found} {expected}");
        }
        // An acceleration of the path stands for one of an axis.
        let path = Bounds {
            acceleration: Some(acceleration / 90.0),
            ..Bounds::default()
        };
        let by_rate = Bounds {
            rate: Some(rate),
            ..Bounds::default()
        };
        let found = phase::duration(&parts(straight, 24), &all(by_rate), most, path);
        assert!((found - expected).abs() < 1e-9 * expected, "{found} {expected}");
    }
}

#[test]
fn finer_parts_change_little_and_nothing_is_exceeded() {
    for curve in [arc as Curve, wave] {
        let b = bounds(120.0, 200.0);
        let fine = phase::duration(&parts(curve, 20_000), &all(b), 1.0, Bounds::default());
        let mut last = f64::INFINITY;
        for count in [25, 100, 400] {
            let coarse = phase::duration(&parts(curve, count), &all(b), 1.0, Bounds::default());
            let error = (coarse / fine - 1.0).abs();
            assert!(error < 0.02 && error < last, "{count}: {coarse} {fine}");
            last = error;
        }
        assert!(last < 1e-4, "{last}");
        let parts = parts(curve, 2000);
        let mut before = 0.0;
        let steps = phase::steps(&parts, &all(b), 1.0, Bounds::default());
        for (part, step) in parts.iter().zip(&steps) {
            let second = (step.z - before) / (2.0 * part.length);
            let z = f64::midpoint(step.z, before);
            for slopes in &part.axes {
                let acceleration = slopes.first * second + slopes.second * z;
                assert!(acceleration.abs() <= 200.0 * 1.01, "{acceleration}");
                assert!(slopes.first.abs() * z.sqrt() <= 120.0 * (1.0 + 1e-6));
            }
            before = step.z;
        }
        assert!(before.abs() < 1e-9, "ends at rest");
    }
}

/// What a ride does at a time: the part that is done, its rate, acceleration and jerk, by adding up jerks.
fn ridden(ride: &smooth::Ride, mut look: impl FnMut([f64; 4])) {
    let step = ride.time / 40_000.0;
    // The acceleration of a ramp after a time, of a trapezoid.
    let ramp = |ramp: &smooth::Ramp, t: f64| {
        let jerk = ramp.bounds.jerk.unwrap();
        let most = ramp.bounds.acceleration.unwrap_or(f64::INFINITY);
        let peak = most.min((ride.rate * jerk).sqrt());
        let acceleration = peak.min(jerk * t).min(jerk * (ramp.time - t)).max(0.0);
        let change = if acceleration >= peak * (1.0 - 1e-12) {
            0.0
        } else if t < ramp.time / 2.0 {
            jerk
        } else {
            -jerk
        };
        (acceleration, change)
    };
    let (mut at, mut rate) = (0.0, 0.0);
    for k in 0..40_000_u32 {
        let t = (f64::from(k) + 0.5) * step;
        let (second, third) = if t < ride.rising.time {
            ramp(&ride.rising, t)
        } else if t > ride.time - ride.falling.time {
            let (second, third) = ramp(&ride.falling, ride.time - t);
            (-second, third)
        } else {
            (0.0, 0.0)
        };
        let next = rate + second * step;
        at += f64::midpoint(rate, next) * step;
        look([at, f64::midpoint(rate, next), second, third]);
        rate = next;
    }
    assert!((at - 1.0).abs() < 1e-3, "the way is gone: {at}");
    assert!(rate.abs() < 1e-3 * ride.rate, "and ends at rest: {rate}");
}

#[test]
fn a_smooth_ride_keeps_the_bounds_of_all_axes() {
    for (curve, rate, acceleration, jerk) in [
        (arc as Curve, 120.0, 200.0, 2000.0),
        (wave, 120.0, 200.0, 2000.0),
        (wave, 60.0, 1000.0, 500.0),
        (arc, 500.0, 5000.0, 100_000.0),
    ] {
        let b = Bounds {
            jerk: Some(jerk),
            ..bounds(rate, acceleration)
        };
        let parts = parts(curve, 100);
        let ride = smooth::ride(&parts, &all(b), 1.0, Bounds::default()).unwrap();
        ridden(&ride, |[u, first, second, third]| {
            for [q1, q2, q3] in curve(u.min(1.0)) {
                assert!((q1 * first).abs() <= rate * 1.001);
                let found = q1 * second + q2 * first * first;
                assert!(found.abs() <= acceleration * 1.001, "{found}");
                let found = q1 * third + 3.0 * q2 * first * second + q3 * first * first * first;
                assert!(found.abs() <= jerk * 1.001, "{found} at {u}");
            }
        });
        let least = phase::duration(&parts, &all(b), 1.0, Bounds::default());
        assert!(ride.time >= least, "{} {least}", ride.time);
    }
}

#[test]
fn a_smooth_ride_of_one_straight_axis_has_the_closed_form() {
    let straight = |_: f64| [[90.0, 0.0, 0.0], [0.0; 3]];
    for (most, jerk) in [(10.0, 1000.0), (0.2, 1000.0), (10.0, 1e6)] {
        let b = Bounds {
            jerk: Some(jerk),
            ..bounds(100.0, 300.0)
        };
        let closed = b.over(90.0).and(Bounds {
            rate: Some(most),
            ..Bounds::default()
        });
        let expected = closed.duration(1.0).unwrap();
        let found = smooth::ride(&parts(straight, 24), &all(b), most, Bounds::default());
        let found = found.unwrap().time;
        assert!(
            found >= expected - 1e-9 && found <= expected * 1.002,
            "{found} {expected}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn wider_bounds_of_axes_never_take_longer(
        rate in 20.0..200.0_f64,
        acceleration in 20.0..2000.0_f64,
        jerk in 100.0..50_000.0_f64,
        by in 1.0..4.0_f64,
        is_wave in any::<bool>(),
    ) {
        let curve = if is_wave { wave as Curve } else { arc };
        let parts = parts(curve, 50);
        let quick = |b: Bounds| phase::duration(&parts, &all(b), 1.0, Bounds::default());
        let base = quick(bounds(rate, acceleration));
        prop_assert!(quick(bounds(rate * by, acceleration)) <= base * (1.0 + 1e-3));
        prop_assert!(quick(bounds(rate, acceleration * by)) <= base * (1.0 + 1e-3));
        // Without bounds that matter it is the programmed time.
        prop_assert!((quick(bounds(1e9, 1e12)) - 1.0).abs() < 1e-4);
        let gentle = |b: Bounds, jerk| {
            let b = Bounds { jerk: Some(jerk), ..b };
            smooth::ride(&parts, &all(b), 1.0, Bounds::default()).unwrap().time
        };
        let base = gentle(bounds(rate, acceleration), jerk);
        prop_assert!(base >= quick(bounds(rate, acceleration)) * (1.0 - 1e-3));
        prop_assert!(gentle(bounds(rate, acceleration * by), jerk) * (1.0 - smooth::NEAR) <= base);
        prop_assert!(gentle(bounds(rate, acceleration), jerk * by) * (1.0 - smooth::NEAR) <= base);
    }
}

/// The fastest seven-segment ride of a fine grid of rates and accelerations, each with all the jerk they leave, on the shortest
/// stretches that are long enough.
fn by_grid(parts: &[Part], b: Bounds) -> f64 {
    const RATES: u32 = 400;
    const ACCELERATIONS: u32 = 120;
    let (rate, most, jerk) = (b.rate.unwrap(), b.acceleration.unwrap(), b.jerk.unwrap());
    // First, second and third derivatives of both axes at most, on so many parts from one end.
    let largest = |parts: &mut dyn Iterator<Item = &Part>| {
        parts.fold([[0.0_f64; 3]; 2], |mut largest, part| {
            let half = part.length / 2.0;
            for (largest, slopes) in largest.iter_mut().zip(&part.axes) {
                let third = slopes.third.abs();
                let second = slopes.second.abs() + third * half;
                let first = slopes.first.abs() + second * half;
                *largest = [
                    largest[0].max(first),
                    largest[1].max(second),
                    largest[2].max(third),
                ];
            }
            largest
        })
    };
    let length = parts[0].length;
    let stretches = |backwards: bool| -> Vec<(f64, [[f64; 3]; 2])> {
        let table = (1..=parts.len()).map(|count| {
            if backwards {
                (count, largest(&mut parts.iter().rev().take(count)))
            } else {
                (count, largest(&mut parts.iter().take(count)))
            }
        });
        table
            .map(|(count, largest)| (f64::from(u32::try_from(count).unwrap()) * length, largest))
            .collect()
    };
    let [rise, fall] = [false, true].map(stretches);
    let ramp = |v: f64, stretches: &[(f64, [[f64; 3]; 2])]| {
        stretches.iter().find_map(|(long, axes)| {
            let quickest = (1..=ACCELERATIONS)
                .filter_map(|k| {
                    let room = axes.map(|[first, second, _]| (most - second * v * v) / first);
                    // Low ones as closely as high ones: with little jerk only those are of use.
                    let share = libm::pow(1000.0, f64::from(k) / f64::from(ACCELERATIONS)) / 1000.0;
                    let a = room[0].min(room[1]) * share;
                    let left = axes.map(|[q1, q2, q3]| (jerk - 3.0 * q2 * v * a - q3 * v * v * v) / q1);
                    let j = left[0].min(left[1]);
                    let is_full = a * a <= v * j;
                    let time = if is_full {
                        v / a + a / j
                    } else {
                        2.0 * (v / j).sqrt()
                    };
                    (a > 0.0 && j > 0.0).then_some(time)
                })
                .min_by(f64::total_cmp)?;
            (v * quickest / 2.0 <= *long).then_some(quickest)
        })
    };
    let all = largest(&mut parts.iter());
    let times = (1..=RATES).filter_map(|k| {
        // From a rate that is programmed down to a thousandth of it, evenly by factors.
        let v = libm::pow(1000.0, f64::from(k) / f64::from(RATES)) / 1000.0;
        let keeps = all
            .iter()
            .all(|[q1, q2, q3]| q1 * v <= rate && q2 * v * v <= most && q3 * v * v * v <= jerk);
        let ramps = ramp(v, &rise)? + ramp(v, &fall)?;
        (keeps && v * ramps <= 2.0).then(|| ramps + (1.0 - v * ramps / 2.0) / v)
    });
    times.min_by(f64::total_cmp).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn no_ride_of_a_grid_is_much_faster(
        rate in 20.0..200.0_f64,
        acceleration in 20.0..2000.0_f64,
        jerk in 100.0..50_000.0_f64,
        is_wave in any::<bool>(),
    ) {
        let parts = parts(if is_wave { wave as Curve } else { arc }, 50);
        let b = Bounds { jerk: Some(jerk), ..bounds(rate, acceleration) };
        let found = smooth::ride(&parts, &all(b), 1.0, Bounds::default()).unwrap().time;
        let grid = by_grid(&parts, b);
        prop_assert!(found * (1.0 - smooth::NEAR) <= grid, "{found} {grid}");
        // The rates of the grid are 1.7 % apart. Its accelerations are 6 % apart, where the time has its flat valley.
        prop_assert!(found >= grid * 0.97, "{found} {grid}");
    }
}

/// A cut of a metre by a real arm that is given accelerations: what the axes do is found by differences of the inverse
/// kinematics over time, not by derivatives along the way.
#[test]
fn an_arm_keeps_its_accelerations_all_along_a_cut() {
    let model = catalogue::find("kuka/kr210_r3100_ultra").unwrap();
    let origin = Frame {
        origin: Point3::new(0.0, 0.0, 0.0),
        orientation: Orientation::IDENTITY,
    };
    let rig = Rig::new(&model, origin, origin);
    let start: Joints = [0.3, -1.4, 1.5, 0.2, 0.9, -0.4];
    let from = rig.blade_in_work(&start);
    let mut to = Frame::from(from);
    to.origin = Point3::new(to.origin.x + 400.0, to.origin.y - 900.0, to.origin.z + 100.0);
    let to = Pose::from(to);
    let course = Course {
        arc: None,
        from,
        to,
        duration: 1.0,
    };
    let branch = rig
        .mechanism
        .all(&rig.flange_in_root(&from))
        .iter()
        .find(|way| (0..MOST_AXES).all(|axis| (way.joints[axis] - start[axis]).abs() < 1e-6))
        .unwrap()
        .branch;
    let followed = Followed::new(&rig, &course, branch, [&start, &start]).unwrap();
    let weights = Weights::new();
    let parts = track::parts(&weights, &start, |place, near| followed.joints_at(place, near)).unwrap();
    assert!((parts.iter().map(|part| part.length).sum::<f64>() - 1.0).abs() < 1e-12);
    let most: [f64; MOST_AXES] = [4.0, 4.0, 4.0, 6.0, 6.0, 8.0];
    let axes = most.map(|most| Bounds {
        rate: Some(3.0),
        acceleration: Some(most),
        jerk: None,
    });
    let steps = phase::steps(&parts, &axes, 0.6, Bounds::default());
    let time: f64 = steps.iter().map(|step| step.time).sum();
    assert!(time > 1.0 / 0.6 && time < 4.0, "{time}");
    // Places and times at the ends of parts, and the rate there.
    let (mut u, mut before) = (0.0, 0.0);
    let mut checked = 0;
    for (part, step) in parts.iter().zip(&steps) {
        let second = (step.z - before) / (2.0 * part.length);
        let rate = f64::midpoint(step.z, before).sqrt();
        // Parts with both a ramp and a constant rate have no one acceleration.
        let is_even = (step.time - 2.0 * part.length / (before.sqrt() + step.z.sqrt())).abs() < 1e-9;
        if is_even {
            let middle = u + part.length / 2.0;
            let h = 1e-3;
            let at = |t: f64| {
                followed
                    .joints_at(middle + rate * t + second * t * t / 2.0, &start)
                    .unwrap()
            };
            let (minus, here, plus) = (at(-h), at(0.0), at(h));
            for axis in 0..MOST_AXES {
                let acceleration = (plus[axis] - 2.0 * here[axis] + minus[axis]) / (h * h);
                assert!(
                    acceleration.abs() <= most[axis] * 1.01 + 1e-3,
                    "axis {axis} at {u}: {acceleration}"
                );
            }
            checked += 1;
        }
        u += part.length;
        before = step.z;
    }
    assert!(checked > 10, "{checked}");
}
