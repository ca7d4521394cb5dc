//! Reading airfoil files: layouts, sides, scaling, and what is refused.

use super::*;
use proptest::prelude::*;

const CLARK_Y: &str = include_str!("../../../../tests/data/airfoils/clarky.dat");
const CLARK_Y_LEDNICER: &str = include_str!("../../../../tests/data/airfoils/clarky-lednicer.dat");
const GOE_417A: &str = include_str!("../../../../tests/data/airfoils/goe417a.dat");
const GOE_417A_LEDNICER: &str = include_str!("../../../../tests/data/airfoils/goe417a-lednicer.dat");
const NACA_2412: &str = include_str!("../../../../tests/data/airfoils/naca2412.dat");
const RAE_2822: &str = include_str!("../../../../tests/data/airfoils/rae2822.dat");
const S_1223: &str = include_str!("../../../../tests/data/airfoils/s1223.dat");

fn height(side: &[Point2], x: f64) -> f64 {
    let pair = side
        .windows(2)
        .find(|p| p[0].x <= x && x <= p[1].x)
        .expect("within the side");
    pair[0].lerp(pair[1], (x - pair[0].x) / (pair[1].x - pair[0].x)).z
}

fn assert_sound(foil: &Airfoil) {
    for side in [&foil.upper, &foil.lower] {
        assert!(side.windows(2).all(|p| p[0].x < p[1].x));
        assert!(side[0].x < 0.001 && side.last().unwrap().x > 0.999);
    }
    for i in 1..100 {
        let x = f64::from(i) / 100.0;
        assert!(
            height(&foil.upper, x) >= height(&foil.lower, x) - 1e-9,
            "{} {x}",
            foil.title
        );
    }
}

#[test]
fn real_files_read_with_all_their_points() {
    for (text, title, upper, lower) in [
        (CLARK_Y, "CLARK Y AIRFOIL", 61, 61),
        (NACA_2412, "NAca 2412 By Naca.exe D. LEDNICER", 35, 35),
        (RAE_2822, "RAE 2822 AIRFOIL", 65, 65),
        (GOE_417A, "GOE 417A (GEW. PLATTE) AIRFOIL", 16, 16),
        (S_1223, "S1223HiRes", 157, 144),
    ] {
        let foil = airfoil(text).unwrap();
        assert_sound(&foil);
        assert_eq!(foil.title, title);
        assert_eq!((foil.upper.len(), foil.lower.len()), (upper, lower), "{title}");
    }
}

#[test]
fn a_lower_side_above_zero_is_still_the_lower_side() {
    let foil = airfoil(GOE_417A).unwrap();
    assert!((height(&foil.upper, 0.4) - 0.0735).abs() < 1e-12);
    assert!((height(&foil.lower, 0.4) - 0.0445).abs() < 1e-12);
}

#[test]
fn both_layouts_give_the_same_airfoil() {
    assert_eq!(airfoil(CLARK_Y_LEDNICER), airfoil(CLARK_Y));
    assert_eq!(airfoil(GOE_417A_LEDNICER), airfoil(GOE_417A));
}

#[test]
fn comments_and_the_grid_of_ises_are_passed_over() {
    let expected = airfoil(CLARK_Y);
    let (title, points) = CLARK_Y.split_once('\n').unwrap();
    for text in [
        format!("# by hand\n{title}\n{points}"),
        format!("{title}\n# x  z\n{points}  # end\n"),
        format!("{title}\n -2.0 3.0 -2.5 3.0\n{points}"),
        format!("{title}\n-2.0, 3.0, -2.5, 3.0, 1\n{points}"),
    ] {
        assert_eq!(airfoil(&text), expected);
    }
    let among = points.replacen('\n', "\n1.0 2.0 3.0 4.0\n", 3);
    assert!(airfoil(&format!("{title}\n{among}")).is_err());
}

#[test]
fn lines_may_end_in_any_way_and_rubbish_may_follow() {
    let expected = airfoil(CLARK_Y);
    for text in [
        CLARK_Y.replace('\n', "\r\n"),
        CLARK_Y.replace('\n', "\r"),
        CLARK_Y.replace("0 ", "0\t"),
        format!("{CLARK_Y}\n\n   \n\u{1a}"),
        format!("\n\n{CLARK_Y}end of file"),
    ] {
        assert_eq!(airfoil(&text), expected);
    }
}

#[test]
fn the_title_may_be_missing() {
    for text in [RAE_2822, CLARK_Y_LEDNICER] {
        let (title, body) = text.split_once('\n').unwrap();
        let foil = airfoil(body).unwrap();
        assert_eq!(foil.title, "");
        assert_eq!(
            airfoil(text),
            Ok(Airfoil {
                title: title.trim().into(),
                ..foil
            })
        );
    }
}

#[test]
fn the_lower_side_may_come_first() {
    for text in [CLARK_Y, GOE_417A, S_1223] {
        let mut body: Vec<&str> = text.lines().collect();
        body[1..].reverse();
        assert_eq!(airfoil(&body.join("\n")), airfoil(text));
    }
}

#[test]
fn counts_that_do_not_add_up_do_no_harm_when_they_stand_apart() {
    let text = CLARK_Y_LEDNICER.replacen("61.       61.", "60.       61.", 1);
    assert_ne!(text, CLARK_Y_LEDNICER);
    assert_eq!(airfoil(&text), airfoil(CLARK_Y));
}

#[test]
fn around_the_nose_the_outer_points_count() {
    let foil = airfoil(
        "blunt\n1 0\n0.5 0.1\n0.01 0.03\n0.0 0.02\n0.02 0.01\n0.0 0.0\n0.0 -0.02\n0.01 -0.03\n0.5 -0.1\n1 0\n",
    )
    .unwrap();
    let raw = |side: &[Point2]| side.iter().map(|p| (p.x, p.z)).collect::<Vec<_>>();
    assert_eq!(
        raw(&foil.upper),
        [(0.0, 0.02), (0.01, 0.03), (0.5, 0.1), (1.0, 0.0)]
    );
    assert_eq!(
        raw(&foil.lower),
        [(0.0, -0.02), (0.01, -0.03), (0.5, -0.1), (1.0, 0.0)]
    );
}

#[test]
fn coarse_outlines_are_no_jumps() {
    let foil = airfoil("diamond\n1 0\n0.1 0.1\n0 0\n0.1 -0.1\n1 0\n").unwrap();
    assert_eq!((foil.upper.len(), foil.lower.len()), (3, 3));
    assert!(foil.upper[1].z > 0.0 && foil.lower[1].z < 0.0);
}

#[test]
fn faults_are_pointed_at() {
    for (text, place, words) in [
        ("title\n1 0\n0.5 O.1\n0 0\n", "0.5 O.1", "two numbers"),
        ("title\n1 0\n0.5 0.1 3\n0 0\n", "0.5 0.1 3", "two numbers"),
        ("title\n1 0\n0.5 0.1\nlower\n0 0\n", "lower", "two numbers"),
        ("title\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1.00", "1.00", "two numbers"),
        (
            "title\n1 0\n0.7 0.1\n0.5 0.1\n0 0\n",
            "1 0\n0.7 0.1\n0.5 0.1\n0 0",
            "side",
        ),
        ("title\n1 0\n0 1\n", "1 0\n0 1", "2 points are"),
        ("", "", "no point is"),
    ] {
        let error = airfoil(text).unwrap_err();
        assert_eq!(&text[error.start as usize..error.end as usize], place);
        assert!(error.message.contains(words), "{}", error.message);
    }
}

proptest! {
    #[test]
    fn any_text_gives_an_airfoil_or_a_place_in_it(text in "[-+., \t\n\r0-9eEaµ]{0,120}") {
        match airfoil(&text) {
            Ok(foil) => for side in [foil.upper, foil.lower] {
                prop_assert!(side.len() >= 2 && side.windows(2).all(|p| p[0].x < p[1].x));
            },
            Err(error) => prop_assert!(text.get(error.start as usize..error.end as usize).is_some()),
        }
    }

    /// Points in any order are refused or read, never anything but increasing x.
    #[test]
    fn any_points_give_an_airfoil_or_an_error(points in prop::collection::vec((0..6i32, -3..3i32), 0..30)) {
        let text: String = points.iter().map(|(x, z)| format!("{x} {z}\n")).collect();
        if let Ok(foil) = airfoil(&format!("title\n{text}")) {
            for side in [foil.upper, foil.lower] {
                prop_assert!(side.len() >= 2 && side.windows(2).all(|p| p[0].x < p[1].x));
            }
        }
    }
}
