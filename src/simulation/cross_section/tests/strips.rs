//! Single strips, and what may be wrong with them.

use super::super::Crack;
use super::*;
use crate::disc::{Hold, PassFault};
use crate::surface::{Single, Vee};

const WALL: f64 = f64::INFINITY;

/// A block of 60 x 40 of which the strip [0, 10] down to 30 is to be freed.
fn first_strip(bottom: f64, rim: f64) -> (CrossSection, crate::disc::PassOutcome) {
    let mut section = block(60.0, 40.0);
    section.slit(10.0, bottom);
    let outcome = free(
        &mut section,
        &wheel(),
        pass(at(rim - 25.0, 30.0), Side::Right, 0.0),
    );
    (section, outcome)
}

#[test]
fn a_strip_comes_free_at_its_slit() {
    // The centre is outside of the stock.
    let (mut section, outcome) = first_strip(30.0, 10.5);
    assert_eq!(outcome.faults, []);
    assert_eq!(outcome.freed.len(), 1);
    assert!((outcome.freed[0].area.to_mm2() - 100.0).abs() < 1e-9);
    let undercut = outcome.undercut.unwrap();
    assert_eq!((undercut.from, undercut.to), (10.0, 10.5));
    assert_eq!(
        corners(&mut section),
        [(0.0, 30.0), (10.0, 30.0), (10.0, 40.0), (60.0, 40.0)]
    );
    assert_eq!(section.cracks(), []);
}

#[test]
fn a_slit_that_is_a_micrometre_short_holds_the_strip() {
    let (mut section, outcome) = first_strip(30.001, 10.5);
    assert!(outcome.freed.is_empty());
    let [
        PassFault::Attached {
            stretch,
            hold: Hold::SlitShort { x, above },
        },
    ] = outcome.faults[..]
    else {
        panic!("{outcome:?}")
    };
    assert_eq!((stretch.from, stretch.to, x), (0.0, 10.5, 10.0));
    assert!((above.to_mm() - 0.001).abs() < 1e-9);
    assert_eq!(corners(&mut section), [(0.0, 40.0), (60.0, 40.0)]);
    // A deeper slit frees it afterwards.
    section.slit(10.0, 29.0);
    assert_eq!(section.surface().height(5.0), 30.0);
    assert_eq!(
        section.cracks(),
        [Crack {
            x: 10.0,
            bottom: 29.0
        }]
    );
}

#[test]
fn a_rim_that_is_a_micrometre_short_holds_the_strip() {
    let (mut section, outcome) = first_strip(30.0, 9.999);
    assert!(outcome.freed.is_empty());
    let [
        PassFault::Attached {
            hold: Hold::RimShort { x, by },
            ..
        },
    ] = outcome.faults[..]
    else {
        panic!("{outcome:?}")
    };
    assert_eq!(x, 10.0);
    assert!((by.to_mm() - 0.001).abs() < 1e-9);
    assert_eq!(section.surface().height(5.0), 40.0);
    // A rim that ends at the slit is enough.
    let (mut section, outcome) = first_strip(30.0, 10.0);
    assert_eq!((outcome.faults, section.surface().height(5.0)), (vec![], 30.0));
    assert_eq!(outcome.undercut, None);
}

#[test]
fn a_micrometre_decides_with_a_lead_too() {
    let leaning = |beyond: f64| DiscPass {
        centre: at(10.0 + beyond - 25.0, 30.0),
        lead: Angle::deg(3.0),
        ..beside(&wheel(), 10.0, 30.0, Side::Right)
    };
    let rim = leaning(0.5).rim(&wheel());
    for (short, is_free) in [(0.0, true), (0.001, false)] {
        let mut section = block(60.0, 40.0);
        section.slit(10.0, rim.height(10.0) + short);
        let outcome = free(&mut section, &wheel(), leaning(0.5));
        let is_short = |fault: &PassFault| {
            matches!(fault, PassFault::Attached { hold: Hold::SlitShort { x: 10.0, above }, .. }
                if (above.to_mm() - 0.001).abs() < 1e-9)
        };
        assert_eq!(outcome.freed.len(), usize::from(is_free), "{outcome:?}");
        assert_eq!(outcome.faults.iter().any(is_short), !is_free, "{outcome:?}");
        // A deeper slit frees it afterwards.
        section.slit(10.0, 29.0);
        assert!(section.surface().height(5.0) < 30.0);
    }
    let mut section = block(60.0, 40.0);
    section.slit(10.0, 20.0);
    let outcome = free(&mut section, &wheel(), leaning(-0.001));
    let is_short = |fault: &PassFault| {
        matches!(
            fault,
            PassFault::Attached {
                hold: Hold::RimShort { x: 10.0, .. },
                ..
            }
        )
    };
    assert!(
        outcome.freed.is_empty() && outcome.faults.iter().any(is_short),
        "{outcome:?}"
    );
}

#[test]
fn a_strip_without_a_slit_is_held_at_the_next_end() {
    let mut section = block(60.0, 40.0);
    section.slit(20.0, 30.0);
    let outcome = free(&mut section, &wheel(), beside(&wheel(), 10.0, 30.0, Side::Right));
    let [
        PassFault::Attached {
            hold: Hold::RimShort { x, .. },
            ..
        },
    ] = outcome.faults[..]
    else {
        panic!("{outcome:?}")
    };
    assert_eq!(x, 20.0);
}

/// No slit where the neighbour already lies at the floor: at the side of the stock, and at a wall.
#[test]
fn no_slit_is_cut_beside_a_wall() {
    for lead in [0.0, 3.0] {
        let mut section = block(20.0, 40.0);
        let bottom = 30.0 - 0.5;
        section.slit(10.0, bottom);
        let first = pass(at(10.5 - 25.0, 30.0), Side::Right, lead);
        assert_eq!(free(&mut section, &disc(25.0), first).faults, [], "{lead}");
        // The right strip has a wall on its left and the side of the stock on its right.
        let second = pass(at(20.5 - 25.0, 30.0), Side::Right, lead);
        let outcome = free(&mut section, &disc(25.0), second);
        assert_eq!(outcome.faults, []);
        assert!(section.surface().height(15.0) <= 30.0);
    }
}

#[test]
fn a_disc_larger_than_the_stock_frees_strip_by_strip() {
    let mut section = block(60.0, 40.0);
    let big = disc(60.0);
    for (x, side) in [
        (10.0, Side::Right),
        (20.0, Side::Right),
        (50.0, Side::Left),
        (40.0, Side::Left),
    ] {
        section.slit(x, 30.0);
        let outcome = free(&mut section, &big, beside(&big, x, 30.0, side));
        assert_eq!((outcome.freed.len(), outcome.faults), (1, vec![]), "{x}");
    }
    assert_eq!(
        corners(&mut section),
        [
            (0.0, 30.0),
            (20.0, 30.0),
            (20.0, 40.0),
            (40.0, 40.0),
            (40.0, 30.0),
            (60.0, 30.0)
        ]
    );
}

/// Beside a shank of 8 mm a disc of 25 mm frees strips of 15.5 mm.
#[test]
fn a_shank_leaves_room_for_strips_of_15_mm() {
    let mut disc = wheel();
    disc.width = None;
    for (step, depth) in [(15.5, None), (15.501, Some(10.0))] {
        let mut section = block(60.0, 40.0);
        section.slit(step, 30.0);
        section.slit(2.0 * step, 30.0);
        assert!(
            free(&mut section, &disc, beside(&disc, step, 30.0, Side::Right))
                .freed
                .len()
                == 1
        );
        let outcome = free(&mut section, &disc, beside(&disc, 2.0 * step, 30.0, Side::Right));
        let body = outcome.faults.iter().find_map(|fault| match fault {
            PassFault::Body { stage: 0, depth, at } => Some((depth.to_mm(), at.x)),
            _ => None,
        });
        assert_eq!(body.map(|(depth, _)| depth), depth, "{outcome:?}");
        assert_eq!(outcome.freed.len(), 1);
    }
}

/// The groove of an operation before divides a strip. Its parts count together, up to the width that the disc takes.
#[test]
fn a_strip_with_a_groove_in_it_comes_free_at_once() {
    let outcome = |width: f64| {
        let mut section = block(60.0, 36.0);
        section.release(Vee::even(at(5.0, 29.0), 2.0));
        section.slit(10.0, 30.0);
        let disc = Disc {
            width: Some(Length::mm(width)),
            ..wheel()
        };
        let outcome = free(&mut section, &disc, beside(&disc, 10.0, 30.0, Side::Right));
        assert_eq!(section.surface().height(1.0), 30.0);
        outcome
    };
    // Up to the floor the groove is 1 mm wide.
    let both = outcome(10.0);
    assert_eq!((both.faults, both.freed.len()), (vec![], 2));
    let narrow = outcome(9.999).faults;
    let meets = |fault: &PassFault| matches!(fault, PassFault::Meets(stretch) if stretch.from == 0.0 && (stretch.to - 4.5).abs() < 1e-9);
    assert!(narrow.len() == 1 && narrow.iter().all(meets), "{narrow:?}");
}

#[test]
fn a_pocket_narrower_than_the_shank_is_closed() {
    // The narrower one is narrower than the radius of the shank, too.
    for half in [5.0, 3.0] {
        let (left, right) = (50.0 - half, 50.0 + half);
        let mut section = block(100.0, 40.0);
        for x in [left, right] {
            section.slit(x, 30.0);
        }
        let outcome = free(&mut section, &wheel(), beside(&wheel(), right, 30.0, Side::Right));
        // It is cut free, but neither the shank nor the rest of the rim has room.
        assert_eq!(outcome.freed.len(), 1);
        let deep = |fault: &PassFault| matches!(fault, PassFault::Body { stage: 0, depth, .. } if (depth.to_mm() - 10.0).abs() < 1e-9);
        assert!(outcome.faults.iter().any(deep), "{outcome:?}");
        let meets = |fault: &PassFault| matches!(fault, PassFault::Meets(stretch) if (stretch.from, stretch.to) == (right + 0.5 - 50.0, left));
        assert!(outcome.faults.iter().any(meets), "{outcome:?}");
    }
    // Without the other slit nothing is open.
    let mut section = block(100.0, 40.0);
    section.slit(55.0, 30.0);
    let outcome = free(&mut section, &wheel(), beside(&wheel(), 55.0, 30.0, Side::Right));
    let closed = |fault: &PassFault| {
        matches!(
            fault,
            PassFault::Attached {
                hold: Hold::Closed,
                ..
            }
        )
    };
    assert!(outcome.freed.is_empty() && outcome.faults.iter().any(closed));
}

#[test]
fn a_floor_exactly_on_the_part_is_clear() {
    for (floor, depth) in [(30.0, None), (29.999, Some(0.001))] {
        let part = level(60.0, 30.0);
        let guard = Guard::new(&part);
        let mut section = block(60.0, 40.0);
        assert_eq!(guard.below_slit(at(10.0, floor), 0.75).is_some(), depth.is_some());
        section.slit(10.0, floor);
        let outcome = section.pass(
            &disc(25.0),
            &beside(&disc(25.0), 10.0, floor, Side::Right),
            &guard,
        );
        let found = outcome.faults.iter().find_map(|fault| match fault {
            PassFault::EntersPart { depth, .. } => Some(depth.to_mm()),
            _ => None,
        });
        assert_eq!(found.is_some(), depth.is_some());
        assert!((found.unwrap_or(0.0) - depth.unwrap_or(0.0)).abs() < 1e-9);
    }
}

#[test]
fn a_leaning_rim_exactly_on_the_part_is_clear() {
    let part = Profile::new(vec![at(-40.0, 30.0), at(60.0, 30.0)]).unwrap();
    let sink = 25.0 * libm::sin(3_f64.to_radians());
    for (down, depth) in [(0.0, None), (0.001, Some(0.001))] {
        let leaning = DiscPass {
            centre: at(-14.5, 30.0 + sink - down),
            lead: Angle::deg(3.0),
            ..beside(&wheel(), 10.0, 30.0, Side::Right)
        };
        let found = Guard::new(&part).deepest(&leaning.rim(&wheel()));
        let found = found.map(|(_, depth)| depth);
        assert_eq!(found.is_some(), depth.is_some(), "{found:?}");
        assert!((found.unwrap_or(0.0) - depth.unwrap_or(0.0)).abs() < 1e-9);
    }
}

#[test]
fn a_strip_may_be_too_thick_or_too_wide() {
    assert_eq!(sizes(12.0, 30.0), "");
    assert_eq!(sizes(12.001, 30.0), "wide ");
    assert_eq!(sizes(12.0, 29.999), "thick ");
    assert_eq!(sizes(13.0, 29.0), "thick wide ");
}

fn sizes(width: f64, floor: f64) -> String {
    let mut section = block(60.0, 40.0);
    section.slit(width, floor);
    let outcome = free(
        &mut section,
        &wheel(),
        beside(&wheel(), width, floor, Side::Right),
    );
    assert_eq!(outcome.freed.len(), 1);
    let words = outcome.faults.iter().map(|fault| match fault {
        PassFault::TooThick { .. } => "thick ",
        PassFault::TooWide { .. } => "wide ",
        other => panic!("{other:?}"),
    });
    words.collect()
}

/// Two slits 0.4 um apart: a leaf stands between, and comes free with the strip if the rim continues beneath it.
#[test]
fn two_walls_less_than_a_micrometre_apart() {
    let mut section = block(60.0, 40.0);
    for x in [20.0, 20.0004] {
        section.slit(x, 30.0);
    }
    let mut other = section.clone();
    let outcome = free(
        &mut section,
        &disc(25.0),
        beside(&disc(25.0), 20.0, 30.0, Side::Right),
    );
    assert_eq!(outcome.faults, []);
    let freed: Vec<_> = outcome
        .freed
        .iter()
        .map(|freed| (freed.stretch.from, freed.stretch.to))
        .collect();
    assert_eq!(freed, [(0.0, 20.0), (20.0, 20.0004)]);
    assert_eq!(
        corners(&mut section),
        [(0.0, 30.0), (20.0004, 30.0), (20.0004, 40.0), (60.0, 40.0)]
    );
    // With a rim that ends in the first slit the leaf stands, until a pass from the other side takes it.
    let mut exact = beside(&disc(25.0), 19.5, 30.0, Side::Right);
    exact.beyond = Length::ZERO;
    assert_eq!(free(&mut other, &disc(25.0), exact).faults, []);
    let leaf = [(0.0, 30.0), (20.0, 30.0), (20.0, 40.0), (60.0, 40.0)];
    assert_eq!(corners(&mut other), leaf);
    let outcome = free(
        &mut other,
        &disc(40.0),
        beside(&disc(40.0), 20.0004, 30.0, Side::Left),
    );
    assert_eq!((outcome.freed.len(), outcome.faults), (2, vec![]));
    assert_eq!(corners(&mut other), [(0.0, 30.0), (60.0, 30.0)]);
}

/// Six strips of 10 mm with a lead of 3 deg: neighbours shave the floor.
#[test]
fn neighbouring_passes_shave_the_floor() {
    let mut section = block(70.0, 40.0);
    // Its shank passes over slivers.
    let mut disc = wheel();
    let deepest = pass(at(0.0, 0.0), Side::Right, 3.0).rim(&disc).depth();
    disc.depth = Some(Length::mm(10.0) + deepest);
    let mut shaved: f64 = 0.0;
    for strip in 1..=6_u32 {
        let x = 10.0 * f64::from(strip);
        let rim = pass(at(x - 24.5, 30.0), Side::Right, 3.0).rim(&disc);
        section.slit(x, rim.height(x));
        let before = section
            .surface()
            .height(x - 10.0 - 1e-5)
            .min(section.surface().heights(x - 10.0)[0]);
        if strip > 1 {
            shaved = shaved.max(before - rim.height(x - 10.0));
        }
        let outcome = free(&mut section, &disc, pass(at(x - 24.5, 30.0), Side::Right, 3.0));
        assert_eq!(outcome.faults, [], "{strip}");
        assert_eq!(outcome.freed.len(), 1);
    }
    let lowest = section
        .surface()
        .corners()
        .map(|corner| corner.z)
        .fold(f64::INFINITY, f64::min);
    assert!((lowest - 30.0 + 1.3084).abs() < 1e-3);
    assert!((section.surface().heights(60.0)[0] - 30.0 + 0.2604).abs() < 1e-3);
    let ripple = (0..=1000_u32)
        .map(|i| section.surface().height(15.0 + f64::from(i) / 100.0))
        .fold(f64::NEG_INFINITY, f64::max);
    assert!((ripple - lowest - 0.0264).abs() < 1.1e-3, "{}", ripple - lowest);
    assert!((shaved - 0.805).abs() < 0.01, "{shaved}");
}

#[test]
fn a_flank_from_a_slit_frees_what_is_beside_it() {
    let mut section = block(60.0, 40.0);
    section.slit(20.0, 10.0);
    // From the slit itself, and from the material left of it.
    for tip in [at(20.0, 25.0), at(15.0, 20.0)] {
        let mut section = section.clone();
        let vee = Vee::one(tip, Side::Right, 1.0);
        let Single::Frees(run) = section.single(vee) else {
            panic!()
        };
        assert_eq!(run.exit, at(35.0, 40.0));
        section.release(vee);
        assert_eq!(
            corners(&mut section),
            [
                (0.0, 40.0),
                (20.0, 40.0),
                (20.0, 25.0),
                (35.0, 40.0),
                (60.0, 40.0)
            ]
        );
        // The slit is still open below.
        assert_eq!(
            section.cracks(),
            [Crack {
                x: 20.0,
                bottom: 10.0
            }]
        );
    }
    // A slit that ends above the flank does not matter to it.
    for vee in [
        Vee::one(at(15.0, 4.0), Side::Right, 1.0),
        Vee::one(at(20.0, 25.0), Side::Left, WALL),
    ] {
        let mut section = section.clone();
        assert_eq!(section.single(vee), Single::Inside);
        section.release(vee);
        assert_eq!(corners(&mut section), [(0.0, 40.0), (60.0, 40.0)]);
    }
}

#[test]
fn a_v_whose_flank_ends_in_the_wall_of_a_strip_keeps_its_corner() {
    let (mut section, _) = first_strip(30.0, 10.5);
    // Its left flank comes out of the wall at 36, and keeps what stands above.
    section.release(Vee::even(at(12.0, 34.0), 1.0));
    let expected = [
        (0.0, 30.0),
        (10.0, 30.0),
        (10.0, 36.0),
        (12.0, 34.0),
        (18.0, 40.0),
        (60.0, 40.0),
    ];
    assert_eq!(corners(&mut section), expected);
    section.release(Vee::even(at(12.0, 29.0), 1.0).with(Side::Left, 0.75));
    assert_eq!(section.surface().heights(10.0), [30.0, 30.5]);
}

#[test]
fn slits_in_the_air_do_nothing() {
    let (mut section, _) = first_strip(30.0, 10.5);
    assert_eq!(section.slit(5.0, 30.0), None);
    assert_eq!(section.slit(5.0, 35.0), None);
    assert_eq!(section.slit(0.0, 5.0), None);
    // Along a wall the edge is in use on one side, and nothing is cut.
    assert_eq!(section.slit(10.0, 35.0).map(Length::to_mm), Some(5.0));
    assert_eq!(section.cracks(), []);
    assert_eq!(section.slit(10.0, 25.0).map(Length::to_mm), Some(15.0));
    assert_eq!(
        section.cracks(),
        [Crack {
            x: 10.0,
            bottom: 25.0
        }]
    );
}

/// A slit through two layers is still there below the wall that the upper strip leaves. What the rim of the next pass shaves on the
/// far side of it is as thick as it is, from either side.
#[test]
fn a_slit_below_a_wall_makes_no_sliver_as_high_as_the_wall() {
    let disc = wheel();
    for (side, slits) in [
        (Side::Left, [48.0, 36.0, 24.0]),
        (Side::Right, [12.0, 24.0, 36.0]),
    ] {
        let mut section = block(60.0, 40.0);
        for x in slits {
            section.slit(x, 22.0);
        }
        for x in slits {
            let centre = beside(&disc, x, 33.0, side).centre;
            let outcome = free(&mut section, &disc, pass(centre, side, 3.0));
            assert_eq!(outcome.faults, [], "{side:?} {x}");
            let heights = outcome.freed.iter().map(|freed| freed.stretch.height.to_mm());
            let strips = heights.filter(|&height| height > 25.0 * libm::sin(3_f64.to_radians()));
            assert_eq!(strips.count(), 1, "{side:?} {x}");
        }
    }
}
