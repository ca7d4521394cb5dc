//! Orders of passes of known regions.

use super::*;
use crate::pattern::{Pattern, Tool, passes};
use crate::region::Region;
use crate::testkit::{any_region, pocket, polygon, region};
use proptest::prelude::*;

const TOOL: Tool = Tool {
    radius: 5.0,
    standoff: 0.0,
    run_out: 2.0,
};

fn steps(region: &Region, pattern: Pattern) -> (Vec<Pass>, Vec<Step>) {
    let passes = passes(region, &TOOL, pattern).unwrap();
    let walls = Walls::of(region);
    let links = Links {
        walls: &walls,
        distance: 5.0,
        longest: 6.0,
    };
    let steps = inside_out(&passes, links).unwrap();
    (passes, steps)
}

/// Every pass once, whole, after all that lies deeper within it.
fn assert_order(passes: &[Pass], steps: &[Step]) {
    let mut numbers: Vec<usize> = steps.iter().map(|step| step.pass).collect();
    numbers.sort_unstable();
    assert_eq!(numbers, (0..passes.len()).collect::<Vec<_>>());
    for step in steps {
        let pass = &passes[step.pass];
        assert!((step.way.length() - pass.length()).abs() < 1e-6);
        assert_eq!(step.way.is_closed(), pass.is_closed());
        for pair in step.way.pieces.windows(2) {
            assert_eq!(pair[0].to, pair[1].from);
        }
    }
    for (at, pair) in steps.windows(2).enumerate() {
        if let Some(link) = pair[1].link {
            assert_eq!(link.from, pair[0].way.pieces.last().unwrap().to, "{at}");
            assert_eq!(link.to, pair[1].way.pieces[0].from);
            assert!(link.from.distance(link.to) <= 6.0);
        }
    }
}

#[test]
fn one_basin_is_cut_from_its_middle_outwards() {
    for pattern in [
        Pattern::Offset { step: 4.0 },
        Pattern::Smooth {
            step: 4.0,
            corner: 5.0,
        },
    ] {
        let (passes, steps) = steps(&pocket(3), pattern);
        assert_order(&passes, &steps);
        let levels: Vec<u32> = steps.iter().map(|step| step.way.level).collect();
        assert_eq!(levels, [8, 7, 6, 5, 4, 3, 2, 1, 0]);
        assert!(steps[0].link.is_none() && steps.iter().skip(1).all(|step| step.link.is_some()));
        assert!(steps.iter().all(|step| step.basin == 0));
    }
}

#[test]
fn two_basins_merge() {
    // Two squares with a corridor as wide as 2 (5 + 4).
    let dumbbell = region(&[polygon(&[
        (0.0, 0.0),
        (60.0, 0.0),
        (60.0, 21.0),
        (80.0, 21.0),
        (80.0, 10.0),
        (120.0, 10.0),
        (120.0, 50.0),
        (80.0, 50.0),
        (80.0, 40.0),
        (60.0, 40.0),
        (60.0, 60.0),
        (0.0, 60.0),
    ])]);
    let (passes, steps) = steps(&dumbbell, Pattern::Offset { step: 4.0 });
    assert_order(&passes, &steps);
    let levels: Vec<(usize, u32)> = steps.iter().map(|step| (step.basin, step.way.level)).collect();
    assert_eq!(
        levels,
        [
            (0, 6),
            (0, 5),
            (0, 4),
            (0, 3),
            (0, 2),
            (1, 3),
            (1, 2),
            (1, 1),
            (1, 0)
        ]
    );
    let lifts: Vec<usize> = (0..steps.len()).filter(|&at| steps[at].link.is_none()).collect();
    assert_eq!(lifts, [0, 5]);
}

#[test]
fn islands_and_open_sides() {
    let (round, ordered) = steps(&pocket(5), Pattern::Offset { step: 4.0 });
    assert_order(&round, &ordered);
    let levels: Vec<u32> = ordered.iter().map(|step| step.way.level).collect();
    assert!(levels.ends_with(&[2, 2, 1, 1, 0, 0]), "{levels:?}");
    let (open, ordered) = steps(&pocket(1), Pattern::Offset { step: 4.0 });
    assert_order(&open, &ordered);
    let levels: Vec<u32> = ordered.iter().map(|step| step.way.level).collect();
    assert_eq!(levels, [8, 7, 6, 5, 4, 3, 2, 1, 0]);
    // There and back.
    assert!(ordered.iter().skip(1).all(|step| step.link.is_some()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn what_lies_deeper_is_cut_before(region in any_region(), step in 2.0..5.0f64) {
        let Ok(passes) = passes(&region, &TOOL, Pattern::Offset { step }) else { return Ok(()) };
        let walls = Walls::of(&region);
        let links = Links { walls: &walls, distance: 5.0, longest: 6.0 };
        let steps = inside_out(&passes, links).unwrap();
        assert_order(&passes, &steps);
        // A closed pass comes after all passes of deeper levels that it encloses.
        for (at, outer) in steps.iter().enumerate() {
            let area: f64 = outer.way.pieces.iter().map(|piece| piece.twice_area()).sum();
            if !outer.way.is_closed() || area < 0.0 {
                continue;
            }
            for inner in &steps[at..] {
                let place = inner.way.pieces[0].at(0.4);
                let crossed = outer.way.pieces.iter().filter(|piece| toggles(piece, place)).count();
                prop_assert!(inner.way.level <= outer.way.level || crossed % 2 == 0);
            }
        }
    }
}
