//! Inverse kinematics of each robot of the catalogue on 10^5 random poses: exact, and the same as another author's. Here
//! because it takes optimised code; `tests/it/kinematics.rs` does the same on fewer poses.

use std::sync::atomic::{AtomicUsize, Ordering};
use vcutc_benches::opw_peer::{FINGERPRINT, Random, Robot, compare, fingerprint};

/// Random poses of each robot.
const POSES: usize = 100_000;

#[test]
fn inverse_kinematics_agree_with_another_authors() {
    let robots = Robot::all();
    assert_eq!(robots.len(), 33);
    let next = AtomicUsize::new(0);
    let work = || {
        while let Some((seed, robot)) = {
            let number = next.fetch_add(1, Ordering::Relaxed);
            robots.get(number).map(|robot| (1000 + number as u64, robot))
        } {
            let tally = compare(robot, POSES, &mut Random(seed));
            let name = robot.name;
            assert!(tally.apart < 1e-9 && tally.turned < 1e-12, "{name}: {tally:?}");
            println!("{name}: {tally:?}");
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(work);
        }
    });
}

/// Vector instructions give what the unoptimised tests of the compiler got without.
#[test]
fn answers_have_the_same_bits_however_they_are_compiled() {
    assert_eq!(fingerprint(), FINGERPRINT);
}
