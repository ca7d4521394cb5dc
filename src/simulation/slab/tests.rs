//! The rule against the section at many y, which is computed without it.

use super::*;
use proptest::prelude::*;

const STOCK: Walls = Walls {
    width: 60.0,
    height: 30.0,
};

/// How high above its tip a flank comes out at a share of the depth, step by step: the surface is what all older Vs leave.
fn walked(older: &[Ruling], tip: Ruling, side: Side, share: f64) -> f64 {
    let at = |ruling: &Ruling| ruling.ends[0] * (1.0 - share) + ruling.ends[1] * share;
    let left = |x: f64| {
        let vees = older.iter().map(|vee| at(vee) + vee.flank * (x - vee.x).abs());
        vees.fold(STOCK.height, f64::min)
    };
    let step = 0.01;
    let mut aside = 0.0;
    loop {
        let x = match side {
            Side::Left => tip.x - aside,
            Side::Right => tip.x + aside,
        };
        let high = tip.flank * aside;
        if !(0.0..=STOCK.width).contains(&x) || at(&tip) + high >= left(x) {
            return high;
        }
        aside += step;
    }
}

fn rulings(count: usize) -> impl Strategy<Value = Vec<Ruling>> {
    let one = (0.0..60.0_f64, 2.0..28.0_f64, 2.0..28.0_f64);
    prop::collection::vec(one, 1..count).prop_map(|places| {
        let ruling = |(x, front, back)| Ruling {
            x,
            ends: [front, back],
            flank: 1.2,
        };
        places.into_iter().map(ruling).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_chip_that_the_rule_accepts_is_free_in_every_section(older in rulings(12), tip in rulings(2), right: bool) {
        let side = if right { Side::Right } else { Side::Left };
        let mut columns = Columns::default();
        for vee in &older {
            columns.release(*vee);
        }
        let bound = columns.reach(tip[0], side, STOCK);
        for section in 0..=40 {
            let walked = walked(&older, tip[0], side, f64::from(section) / 40.0);
            // A step beyond the exit.
            prop_assert!(walked <= bound + 0.02, "{walked} {bound}");
        }
    }

    #[test]
    fn level_tips_reach_as_far_as_the_section_says(older in rulings(12), tip in rulings(2), right: bool) {
        let side = if right { Side::Right } else { Side::Left };
        let level = |vee: &Ruling| Ruling { ends: [vee.ends[0]; 2], ..*vee };
        let older: Vec<Ruling> = older.iter().map(level).collect();
        let tip = level(&tip[0]);
        let mut columns = Columns::default();
        for vee in &older {
            columns.release(*vee);
        }
        let bound = columns.reach(tip, side, STOCK);
        let walked = walked(&older, tip, side, 0.5);
        prop_assert!((walked - bound).abs() <= 0.02, "{walked} {bound}");
    }

    #[test]
    fn rulings_make_up_what_all_vs_leave(older in rulings(12), looks in prop::collection::vec((0.0..60.0_f64, 0.0..1.0_f64), 30)) {
        let mut columns = Columns::default();
        for vee in &older {
            columns.release(*vee);
        }
        let kept = columns.into_rulings();
        for (x, share) in looks {
            let least = |vees: &[Ruling]| vees.iter().map(|vee| vee.height([x, share], 1.0)).fold(f64::INFINITY, f64::min);
            prop_assert!((least(&older) - least(&kept)).abs() < 1e-9);
        }
    }
}
