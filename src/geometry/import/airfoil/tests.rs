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
    let (read, expected) = (airfoil(&text).unwrap(), airfoil(CLARK_Y).unwrap());
    assert_eq!((&read.upper, &read.lower), (&expected.upper, &expected.lower));
    let stated = Altered::Counts {
        stated: 121.0,
        found: 122,
    };
    assert_eq!(altered(&read), [stated]);
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
fn coarse_outlines_are_not_jumps() {
    let foil = airfoil("diamond\n1 0\n0.1 0.1\n0 0\n0.1 -0.1\n1 0\n").unwrap();
    assert_eq!((foil.upper.len(), foil.lower.len()), (3, 3));
    assert!(foil.upper[1].z > 0.0 && foil.lower[1].z < 0.0);
}

#[test]
fn faults_are_pointed_at() {
    for (text, place, words) in [
        ("title\n1 0\n0.5 O.1\n0 0\n", "0.5 O.1", "two numbers"),
        ("title\n1 0\n0.5 0.1 3\n0 0\n", "0.5 0.1 3", "two numbers"),
        ("title\n1 0\n0.5 0.1\nx1 0.2\n0 0\n", "x1 0.2", "two numbers"),
        (
            "title\n1 0 0\n0.5 0.1 0\n0 0\n0.5 -0.1 0\n",
            "1 0 0",
            "two numbers",
        ),
        (
            "title\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n999. 999.\n1 0\n",
            "999. 999.",
            "2 elements",
        ),
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

/// The heights of a symmetric section of four digits with a sharp trailing edge (Abbott and von Doenhoff, eq. 6.2, with the
/// last coefficient that closes it).
fn half_thickness(x: f64) -> f64 {
    let powers = -0.1260 * x - 0.3516 * x * x + 0.2843 * x.powi(3) - 0.1036 * x.powi(4);
    0.6 * (0.2969 * x.sqrt() + powers)
}

/// Its points in the layout of Selig: 20 of each side, and the leading edge.
fn naca0012() -> Vec<(f64, f64)> {
    let stations: Vec<f64> = (1..=20).map(|i| (f64::from(i) / 20.0).powi(2)).collect();
    let upper = stations.iter().rev().map(|&x| (x, half_thickness(x)));
    let lower = stations.iter().map(|&x| (x, -half_thickness(x)));
    upper.chain([(0.0, 0.0)]).chain(lower).collect()
}

fn file(points: &[(f64, f64)]) -> String {
    let row = |(x, z): &(f64, f64)| format!("{x:.8} {z:.8}\n");
    format!("NACA 0012, sharp\n{}", points.iter().map(row).collect::<String>())
}

fn altered(foil: &Airfoil) -> Vec<Altered> {
    foil.repairs.iter().map(|repair| repair.altered).collect()
}

fn place<'a>(text: &'a str, repair: &Repair) -> &'a str {
    &text[repair.start as usize..repair.end as usize]
}

/// Both sides lie where the formula has them, but for what chords of straight lines and eight digits leave.
fn assert_as_the_formula(foil: &Airfoil, within: f64) {
    for (side, sign) in [(&foil.upper, 1.0), (&foil.lower, -1.0)] {
        assert!(side[0].x.abs() < 1e-7 && (side.last().unwrap().x - 1.0).abs() < 1e-7);
        for point in side {
            let formula = sign * half_thickness(point.x.clamp(0.0, 1.0));
            assert!((point.z - formula).abs() <= within, "{point:?} {formula}");
        }
    }
}

#[test]
fn a_clean_file_needs_no_repair() {
    let foil = airfoil(&file(&naca0012())).unwrap();
    assert_eq!(foil.repairs, []);
    assert_as_the_formula(&foil, 1e-7);
}

#[test]
fn doubled_points_count_once() {
    let mut points = naca0012();
    points.insert(5, points[4]);
    points.insert(30, (points[29].0 + 2e-7, points[29].1));
    let text = file(&points);
    let foil = airfoil(&text).unwrap();
    assert_as_the_formula(&foil, 1e-6);
    let rows: Vec<&str> = text.lines().skip(1).collect();
    let [same, near] = foil.repairs.as_slice() else {
        panic!("{:?}", foil.repairs);
    };
    assert_eq!(same.altered, Altered::Doubled { count: 2, apart: 0.0 });
    assert_eq!(place(&text, same), [rows[4], rows[5]].join("\n"));
    let Altered::Doubled { count: 2, apart } = near.altered else {
        panic!("{near:?}");
    };
    assert!((apart - 2e-7).abs() < 1e-9);
    assert_eq!(place(&text, near), [rows[29], rows[30]].join("\n"));
}

#[test]
fn any_chord_is_scaled_to_one() {
    for (from, to) in [
        (0.0, 100.0),
        (0.00044, 1.0),
        (-3.5, 246.5),
        (0.0, 0.98),
        (-0.02, 1.0),
    ] {
        let moved: Vec<_> = naca0012()
            .iter()
            .map(|(x, z)| (from + x * (to - from), z * (to - from)))
            .collect();
        let text = file(&moved);
        let foil = airfoil(&text).unwrap();
        assert_as_the_formula(&foil, 1e-6);
        let [
            Altered::Chord {
                from: read, to: end, ..
            },
        ] = altered(&foil)[..]
        else {
            panic!("{:?}", foil.repairs);
        };
        assert!((read - from).abs() < 1e-7 && (end - to).abs() < 1e-7);
        assert_eq!(
            place(&text, &foil.repairs[0]),
            text.lines().nth(21).unwrap(),
            "the leading edge"
        );
    }
}

/// A chord that is hardly longer than 1 is left alone: the stock cuts it.
#[test]
fn a_chord_a_little_longer_than_one_stays() {
    let longer: Vec<_> = naca0012().iter().map(|(x, z)| (x * 1.00005, *z)).collect();
    let foil = airfoil(&file(&longer)).unwrap();
    assert_eq!(foil.repairs, []);
    assert!((foil.upper.last().unwrap().x - 1.00005).abs() < 1e-9);
}

#[test]
fn a_side_that_ends_early_is_led_on_as_it_ends() {
    let mut points = naca0012();
    let lost = points.pop().unwrap();
    let (before, last) = (points[points.len() - 2], points[points.len() - 1]);
    let text = file(&points);
    let foil = airfoil(&text).unwrap();
    let by = 1.0 - last.0;
    assert!(by > 0.02, "more than may be repaired");
    let [
        Altered::LedOn {
            side: Side::Lower,
            by: read,
        },
    ] = altered(&foil)[..]
    else {
        panic!("{:?}", foil.repairs);
    };
    assert!((read - by).abs() < 1e-7);
    assert!(foil.repairs[0].goes_too_far().is_some());
    let slope = (last.1 - before.1) / (last.0 - before.0);
    let end = foil.lower.last().unwrap();
    assert!((end.z - (last.1 + slope * by).min(0.0)).abs() < 1e-6);
    assert!((end.z - lost.1).abs() < 0.005);
    // A hundredth of the chord is within what is repaired.
    points.push((0.99, -half_thickness(0.99)));
    let foil = airfoil(&file(&points)).unwrap();
    assert!(foil.repairs[0].goes_too_far().is_none());
    assert_as_the_formula(&foil, 2e-4);
    assert!(foil.repairs[0].concerns(Side::Lower) && !foil.repairs[0].concerns(Side::Upper));
}

#[test]
fn a_side_that_begins_late_is_joined_to_the_leading_edge() {
    let points = naca0012();
    let (upper, lower) = points.split_at(21);
    let mut upper: Vec<_> = upper.to_vec();
    upper.reverse();
    // The layout of Lednicer, the lower side without the leading edge: it begins at x = 0.0025.
    let text = format!("{}\n{}", file(&upper), file(lower).split_once('\n').unwrap().1);
    let foil = airfoil(&text).unwrap();
    let [
        Altered::Joined {
            side: Side::Lower,
            by,
        },
    ] = altered(&foil)[..]
    else {
        panic!("{:?}", foil.repairs);
    };
    assert!((by - 0.0025).abs() < 1e-7);
    assert_as_the_formula(&foil, 1e-6);
}

#[test]
fn sides_that_cross_run_in_the_middle() {
    // The lower side is lifted towards the trailing edge: by 0.004 there.
    let lift = |x: f64| if x > 0.6 { 0.01 * (x - 0.6) } else { 0.0 };
    let points: Vec<_> = naca0012()
        .iter()
        .enumerate()
        .map(|(row, (x, z))| (*x, if row > 20 { z + lift(*x) } else { *z }))
        .collect();
    let foil = airfoil(&file(&points)).unwrap();
    let [Altered::Crossed { from, by }] = altered(&foil)[..] else {
        panic!("{:?}", foil.repairs);
    };
    assert!((by - 0.004).abs() < 1e-7);
    assert!(foil.repairs[0].goes_too_far().is_none());
    let gap = |x: f64| 2.0 * half_thickness(x) - lift(x);
    assert!(gap(from - 0.05) > 0.0 && gap(from + 0.05) < 0.0, "{from}");
    for i in 0..=1000 {
        let x = f64::from(i) / 1000.0;
        let (upper, lower) = (height(&foil.upper, x), height(&foil.lower, x));
        assert!(upper >= lower - 1e-9, "{x}");
        if x > from {
            assert!((upper - lower).abs() < 1e-9, "{x}");
        }
    }
    let end = foil.upper.last().unwrap();
    assert!((end.z - 0.002).abs() < 1e-7);
}

/// Cut off, and not in a unit of its own: the sides are still apart where the points end.
#[test]
fn an_airfoil_that_is_cut_off_is_not_stretched() {
    let cut = |most: f64| -> Vec<_> { naca0012().into_iter().filter(|(x, _)| *x <= most).collect() };
    for most in [0.95, 0.7] {
        let foil = airfoil(&file(&cut(most))).unwrap();
        let too_far = foil.repairs.iter().find_map(Repair::goes_too_far);
        assert_eq!(too_far, Some(0.02), "{most}: {:?}", foil.repairs);
    }
    // Little is missing here, and there the edge is thin.
    for (end, half) in [(0.985, 0.008), (0.95, 0.002)] {
        let mut points = vec![(end, half)];
        points.extend(cut(0.95));
        points.push((end, -half));
        let foil = airfoil(&file(&points)).unwrap();
        let too_far = foil.repairs.iter().find_map(Repair::goes_too_far);
        assert_eq!(too_far, None, "{end}: {:?}", foil.repairs);
    }
    // Smaller as a whole, it is in another unit.
    let small: Vec<_> = naca0012().iter().map(|(x, z)| (x * 0.88, z * 0.88)).collect();
    let foil = airfoil(&file(&small)).unwrap();
    assert_eq!(foil.repairs.iter().find_map(Repair::goes_too_far), None);
}

#[test]
fn points_deep_inside_of_the_outline_are_not_passed_over() {
    let mut points = naca0012();
    points.insert(10, (points[9].0 + 0.02, points[9].1 - 0.05));
    let foil = airfoil(&file(&points)).unwrap();
    assert_eq!(foil.repairs.iter().find_map(Repair::goes_too_far), Some(0.02));
}

#[test]
fn points_inside_of_the_outline_are_listed() {
    let mut points = naca0012();
    points.insert(10, (points[9].0 + 0.02, points[9].1 - 0.01));
    let text = file(&points);
    let foil = airfoil(&text).unwrap();
    let [
        Altered::Inside {
            side: Side::Upper,
            count: 1,
            deep,
        },
    ] = altered(&foil)[..]
    else {
        panic!("{:?}", foil.repairs);
    };
    assert!(deep > 0.005 && deep < 0.02);
    assert_eq!(place(&text, &foil.repairs[0]), text.lines().nth(11).unwrap());
    assert_as_the_formula(&foil, 1e-7);
}

/// Points on a straight trailing edge are no more inside than those at its ends.
#[test]
fn a_blunt_trailing_edge_with_points_on_it_is_as_it_should_be() {
    let blunt: Vec<_> = naca0012()
        .iter()
        .enumerate()
        .map(|(row, (x, z))| (*x, if row > 20 { z - 0.01 * x } else { z + 0.01 * x }))
        .collect();
    let mut closed = vec![(1.0, 0.0)];
    closed.extend(&blunt);
    closed.push((1.0, 0.0));
    let (open, closed) = (airfoil(&file(&blunt)).unwrap(), airfoil(&file(&closed)).unwrap());
    assert_eq!(open.repairs, []);
    assert_eq!(open, closed);
}

#[test]
fn headings_counts_and_third_columns_are_passed_over_and_said() {
    let clean = airfoil(&file(&naca0012())).unwrap();
    let points = naca0012();
    let with_zero: String = points
        .iter()
        .map(|(x, z)| format!("{x:.8} {z:.8} 0.0\n"))
        .collect();
    let halves = points.split_at(20);
    let rows = |points: &[(f64, f64)]| file(points).split_once('\n').unwrap().1.to_owned();
    for (text, expected) in [
        (
            format!("{}lower side\n{}", file(halves.0), rows(halves.1)),
            Altered::Words,
        ),
        (
            format!("title\n21 21\n{}", rows(&points)),
            Altered::Counts {
                stated: 42.0,
                found: 41,
            },
        ),
        (format!("title\n{with_zero}"), Altered::Column { value: 0.0 }),
        (
            format!("{}l.0000 O.0013\nof 1996\n", file(&points)),
            Altered::Trailing { count: 2 },
        ),
    ] {
        let foil = airfoil(&text).unwrap();
        assert_eq!(altered(&foil), [expected]);
        assert_eq!((&foil.upper, &foil.lower), (&clean.upper, &clean.lower));
    }
}

#[test]
fn other_programs_ways_to_write_are_not_repairs() {
    let points = naca0012();
    let clean = airfoil(&file(&points)).unwrap();
    let rows = |row: fn(&(f64, f64)) -> String| points.iter().map(row).collect::<String>();
    let plain = rows(|(x, z)| format!("{x:.8} {z:.8}\n"));
    for text in [
        format!("! by hand\n// twice\n% or thrice\ntitle\n{plain}"),
        format!("title\n{}", plain.replacen('\n', "  ! the trailing edge\n", 1)),
        rows(|(x, z)| format!("{x:.8};{z:.8}\n")),
        rows(|(x, z)| format!("{x:.8} {z:.8}\n").replace('.', ",")),
        rows(|(x, z)| format!("{:.8}D-01 {z:.8}d0\n", x * 10.0)),
        format!("title\n-2.0 3.0 -2.5 3.0\n{plain}999.0 999.0\n"),
    ] {
        let foil = airfoil(&text).unwrap();
        assert_eq!(foil.repairs, [], "{text}");
        assert_eq!(
            (foil.upper.len(), foil.lower.len()),
            (clean.upper.len(), clean.lower.len())
        );
        for (one, other) in foil.upper.iter().zip(&clean.upper) {
            assert!(one.distance(*other) < 1e-9, "{text}");
        }
    }
}

#[test]
fn titles_may_be_in_the_code_page_of_windows() {
    let text = file(&naca0012()).replace("NACA", "G\u{f6}ttingen");
    let bytes: Vec<u8> = text
        .chars()
        .map(|letter| u8::try_from(u32::from(letter)).unwrap())
        .collect();
    assert_eq!(airfoil_text(bytes), Ok(text.clone()));
    assert_eq!(airfoil_text(text.clone().into_bytes()), Ok(text));
    assert_eq!(airfoil_text(vec![0, 0xff, 0]), Err(vec![0, 0xff, 0]));
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
                prop_assert!(side[0].x <= 1e-9 && side[side.len() - 1].x >= 1.0 - 1e-9);
            }
        }
    }
}
