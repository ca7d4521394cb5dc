//! Offsets of the five test pockets, with all that is proven of them in one table.

use super::*;
use crate::clearance::clearance;
use crate::engagement::engagement;
use crate::pattern::{Pattern, passes};

/// Changes of direction above 20 deg between pieces, in passes that close.
fn corners(passes: &[Pass]) -> usize {
    let sharp = |(one, next): (&Piece, &Piece)| {
        let (one, next) = (one.direction(1.0), next.direction(0.0));
        libm::atan2(one.cross(next), one.dot(next)).abs() > PI / 9.0
    };
    let count = |pass: &Pass| {
        let next = pass.pieces.iter().cycle().skip(1);
        let joints = pass.pieces.iter().zip(next);
        joints
            .take(pass.pieces.len() - usize::from(!pass.is_closed()))
            .filter(|&pair| sharp(pair))
            .count()
    };
    passes.iter().map(count).sum()
}

/// Lengths and corners as found by another program from buffers of the region. Pocket 1 is known within the pocket only, where its
/// passes do not run out.
#[test]
fn offsets_of_the_five_pockets_are_proven() {
    let mut sharp = 0;
    for (number, length) in [(1, 2119.3), (2, 1770.9), (3, 1729.3), (4, 1591.9), (5, 2185.4)] {
        let region = pocket(number);
        let passes = levels(&region, 5.0, 4.0);
        let found: f64 = passes.iter().map(Pass::length).sum();
        // A corridor as wide as two distances has a line without width, which may be kept; passes run out by 15 mm.
        let more = [18.0 * 15.0, 80.0, 0.0, 0.0, 0.0][number - 1];
        assert!(
            found > length - 0.5 && found < length + more + 0.5,
            "{number}: {found}"
        );
        sharp += corners(&passes);
        let left = coverage(&region, &passes, Tool::touching(5.0)).unwrap();
        assert_eq!((left.uncut, left.spots.len()), (0.0, 0));
        let clear = clearance(&region, &passes);
        assert!((clear.least.unwrap().distance - 5.0).abs() < 1e-6, "{clear:?}");
        assert!(clear.astray.is_empty());
        let order: Vec<Pass> = passes.into_iter().rev().collect();
        let rim = engagement(&region, &order, 5.0).unwrap();
        // The first pass of each basin cuts a slot. Beside earlier passes the rim works by acos(1 - 4 / 5), at corners more.
        let straight = libm::acos(0.2);
        assert!(
            rim.mean > 0.9 * straight && rim.mean < 1.15 * straight,
            "{number}: {}",
            rim.mean
        );
        assert!(
            rim.bound >= rim.largest && (rim.largest - PI).abs() < 1e-9,
            "{number}"
        );
        let wall = rim.profiles.last().unwrap();
        let largest = wall.iter().map(|stretch| stretch.bound).fold(0.0, f64::max);
        // Around an arc of 10 mm, beside one of 6 mm about the same centre: `10^2 + 5^2 + 2 * 10 * 5 cos = (6 + 5)^2`.
        let most = if number == 5 {
            libm::acos(-0.04) + 0.0175
        } else {
            PI
        };
        assert!(largest > straight && largest <= most, "{number}: {largest}");
    }
    assert_eq!(sharp, 142);
}

/// Passes as they are planned, 2 um off the walls: with sharp corners, with round ones and in rows.
#[test]
fn patterns_of_the_five_pockets_are_proven() {
    let planned = crate::pattern::Tool {
        radius: 5.0,
        standoff: 0.002,
        run_out: 0.0,
    };
    let tool = Tool {
        radius: 5.0,
        keep: 5.002,
    };
    // Sums of lengths of offsets, in mm, as another program finds them.
    for (pattern, length) in [
        (Pattern::Offset { step: 4.0 }, Some(9396.7)),
        (Pattern::Offset { step: 5.0 }, Some(7567.7)),
        (
            Pattern::Smooth {
                step: 4.0,
                corner: 5.0,
            },
            None,
        ),
        (
            Pattern::Smooth {
                step: 5.0,
                corner: 5.0,
            },
            None,
        ),
        (
            Pattern::Zigzag {
                step: 4.0,
                angle: 0.0,
            },
            None,
        ),
        (
            Pattern::Zigzag {
                step: 4.0,
                angle: PI / 2.0,
            },
            None,
        ),
        (
            Pattern::Zigzag {
                step: 4.0,
                angle: PI / 6.0,
            },
            None,
        ),
    ] {
        let mut sum = 0.0;
        for number in 1..=5 {
            let region = pocket(number);
            let passes = passes(&region, &planned, pattern).unwrap();
            sum += passes.iter().map(Pass::length).sum::<f64>();
            let left = coverage(&region, &passes, tool).unwrap();
            // Beyond the ends of open sides nothing goes along the edge of where the centre may go.
            let most = if number == 1 { 1e-3 } else { 0.0 };
            assert!(left.uncut <= most, "{pattern:?} {number}: {}", left.uncut);
            assert!(left.fringe <= 1e-6);
            let clear = clearance(&region, &passes);
            let least = clear.least.unwrap().distance;
            assert!(
                (least - 5.002).abs() < 1e-9 && clear.astray.is_empty(),
                "{clear:?}"
            );
        }
        // The least loops are gone, or smaller, 2 um farther in.
        assert!(
            length.is_none_or(|length| (sum - length).abs() < 2e-3 * length),
            "{pattern:?}: {sum}"
        );
    }
}
