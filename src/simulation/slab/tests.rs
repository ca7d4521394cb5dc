//! The rule against the section at many y, which is computed without it.

use super::*;
use proptest::prelude::*;

const STOCK: Walls = Walls {
    width: 60.0,
    height: 30.0,
};

/// Where tips may have knots, as shares of the depth.
const KNOTS: [f64; 5] = [0.0, 0.2, 0.35, 0.7, 1.0];

/// How high above its tip a flank comes out at a share of the depth, step by step: the surface is what all older Vs leave.
fn walked(older: &[Column], tip: &Column, side: Side, share: f64, knots: &[f64]) -> f64 {
    let at = |vee: &Column| vee.height([vee.x, share], knots);
    let tips: Vec<(f64, f64)> = older.iter().map(|vee| (vee.x, at(vee))).collect();
    let left = |x: f64| {
        let vees = tips.iter().map(|&(at, z)| z + tip.flank * (x - at).abs());
        vees.fold(STOCK.height, f64::min)
    };
    let step = 0.01;
    let start = at(tip);
    let mut aside = 0.0;
    loop {
        let x = match side {
            Side::Left => tip.x - aside,
            Side::Right => tip.x + aside,
        };
        let high = tip.flank * aside;
        if !(0.0..=STOCK.width).contains(&x) || start + high >= left(x) {
            return high;
        }
        aside += step;
    }
}

/// Where the tips of columns run, and how high at each knot.
type Places = Vec<(f64, [f64; 5])>;

fn places(count: usize) -> impl Strategy<Value = Places> {
    prop::collection::vec((0.0..60.0_f64, prop::array::uniform5(2.0..28.0_f64)), 1..count)
}

fn columns(places: &[(f64, [f64; 5])], slabs: usize) -> Vec<Column> {
    let column = |&(x, tips): &(f64, [f64; 5])| Column {
        x,
        tips: tips[..=slabs].into(),
        flank: 1.2,
    };
    places.iter().map(column).collect()
}

/// So many slabs of a stock as deep as all of them.
fn knots(slabs: usize) -> Vec<f64> {
    KNOTS[..=slabs].iter().map(|knot| knot / KNOTS[slabs]).collect()
}

fn out(older: &[Column]) -> Slabs {
    let mut slabs = Slabs::default();
    older.iter().for_each(|vee| slabs.release(vee.clone()));
    slabs
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_chip_that_the_rule_accepts_is_free_in_every_section(
        older in places(12), tip in places(2), slabs in 1..=4_usize, right: bool,
    ) {
        let side = if right { Side::Right } else { Side::Left };
        let (older, tip) = (columns(&older, slabs), columns(&tip, slabs));
        let bound = out(&older).reach(&tip[0], side, STOCK);
        let knots = knots(slabs);
        for section in 0..=40 {
            let walked = walked(&older, &tip[0], side, f64::from(section) / 40.0, &knots);
            // A step beyond the exit.
            prop_assert!(walked <= bound + 0.02, "{walked} {bound}");
        }
    }

    #[test]
    fn level_tips_reach_as_far_as_the_section_says(
        older in places(12), tip in places(2), slabs in 1..=4_usize, right: bool,
    ) {
        let side = if right { Side::Right } else { Side::Left };
        let level = |places: Places| places.into_iter().map(|(x, tips)| (x, [tips[0]; 5])).collect::<Places>();
        let (older, tip) = (columns(&level(older), slabs), columns(&level(tip), slabs));
        let bound = out(&older).reach(&tip[0], side, STOCK);
        let walked = walked(&older, &tip[0], side, 0.5, &knots(slabs));
        prop_assert!((walked - bound).abs() <= 0.02, "{walked} {bound}");
    }

    /// However older Vs are sorted and passed over, the reach is that of all of them in each slab.
    #[test]
    fn no_older_tip_is_forgotten(older in places(30), tip in places(2), slabs in 1..=4_usize, right: bool) {
        let side = if right { Side::Right } else { Side::Left };
        let (older, tip) = (columns(&older, slabs), columns(&tip, slabs));
        let tip = &tip[0];
        let beside = if right { STOCK.width - tip.x } else { tip.x };
        let reaches = (0..slabs).map(|slab| {
            let own = [tip.tips[slab], tip.tips[slab + 1]];
            let top = (STOCK.height - own[0].min(own[1])).min(tip.flank * beside);
            let each = older.iter().filter_map(|vee| {
                let aside = tip.flank * (vee.x - tip.x).abs();
                let above = [vee.tips[slab] - own[0], vee.tips[slab + 1] - own[1]];
                let is_beside = if right { vee.x >= tip.x } else { vee.x <= tip.x };
                if above.iter().all(|above| above + aside <= 0.0) {
                    Some(0.0)
                } else if is_beside && above.iter().all(|above| aside >= *above) {
                    Some((above[0].max(above[1]) + aside) / 2.0)
                } else {
                    None
                }
            });
            each.fold(top, f64::min).max(0.0)
        });
        let expected = reaches.fold(0.0, f64::max);
        let bound = out(&older).reach(tip, side, STOCK);
        prop_assert!((bound - expected).abs() < 1e-9, "{bound} {expected}");
    }

    #[test]
    fn columns_make_up_what_all_vs_leave(
        older in places(12), slabs in 1..=4_usize, looks in prop::collection::vec((0.0..60.0_f64, 0.0..1.0_f64), 30),
    ) {
        let older = columns(&older, slabs);
        let kept = out(&older).into_columns();
        let knots = knots(slabs);
        for (x, share) in looks {
            let least = |vees: &[Column]| vees.iter().map(|vee| vee.height([x, share], &knots)).fold(f64::INFINITY, f64::min);
            prop_assert!((least(&older) - least(&kept)).abs() < 1e-9);
        }
    }
}

/// As many random slabs as one may ask for, at once.
#[test]
fn many_slabs_are_never_judged_too_free() {
    let mut state = 7309_u64;
    let mut random = |low: f64, high: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
    };
    let knots = knots(4);
    let mut equal = 0;
    let cases = 25_000;
    for _ in 0..cases {
        let mut column = || Column {
            x: random(0.0, 60.0),
            tips: (0..5).map(|_| random(2.0, 28.0)).collect(),
            flank: 1.2,
        };
        let (older, tip) = ([column(), column(), column()], column());
        let bound = out(&older).reach(&tip, Side::Right, STOCK);
        let exact = |share: f64| {
            let at = |vee: &Column| vee.height([vee.x, share], &knots);
            let own = at(&tip);
            let top = (STOCK.height - own).min(tip.flank * (STOCK.width - tip.x));
            let each = older.iter().filter_map(|vee| {
                let (aside, above) = (tip.flank * (vee.x - tip.x).abs(), at(vee) - own);
                if above + aside <= 0.0 {
                    Some(0.0)
                } else {
                    (vee.x >= tip.x && aside >= above).then(|| (above + aside) / 2.0)
                }
            });
            each.fold(top, f64::min).max(0.0)
        };
        let sections = (0..=40).map(|section| exact(f64::from(section) / 40.0));
        let dense = sections.fold(0.0, f64::max);
        assert!(dense <= bound + 1e-9, "{dense} {bound}");
        equal += usize::from(bound - dense < 0.2);
    }
    // The rule is not far from exact.
    assert!(equal > cases * 3 / 4, "{equal}");
}
