//! Columns against closed forms, and Vs over them against what they cover.

use super::*;
use proptest::prelude::*;

fn profile(points: &[(f64, f64)]) -> Profile {
    Profile::new(points.iter().map(|&(x, z)| Point2::new(x, z)).collect()).unwrap()
}

/// The hyperbolic paraboloid `60 + (x - 300) (y - 500) / 3000` over 600 x 1000 mm.
fn hypar() -> Columns {
    let ways = [0.0, 300.0, 600.0].map(|x| (x, vec![0.0, (x - 300.0) / 3.0]));
    let front = profile(&[(0.0, 110.0), (600.0, 10.0)]);
    let back = profile(&[(0.0, 10.0), (600.0, 110.0)]);
    Columns::new(vec![0.0, 1000.0], vec![front, back], ways.to_vec()).unwrap()
}

#[test]
fn a_hypar_is_a_roof_over_its_lower_ends() {
    let fan = hypar();
    assert!(fan.is_fan());
    let shadow = fan.shadow();
    for (x, z) in [
        (0.0, 10.0),
        (150.0, 35.0),
        (300.0, 60.0),
        (450.0, 35.0),
        (600.0, 10.0),
    ] {
        assert!((shadow.height(x) - z).abs() < 1e-9, "{x}");
        for y in [0.0, 250.0, 1000.0] {
            let part = 60.0 + (x - 300.0) * (y - 500.0) / 3000.0;
            assert!((shadow.height(x) + fan.rise(x, y) - part).abs() < 1e-9, "{x} {y}");
            assert!((fan.cover([x, y]) - part).abs() < 1e-9, "{x} {y}");
        }
    }
    assert!((fan.shear() - 1.0 / 3.0).abs() < 1e-12);
    assert!((fan.steepest() - 0.1).abs() < 1e-12 && (fan.steepest_at_sides() - 0.1).abs() < 1e-12);
    // 30 mm beyond a side they fall by 3 mm, from their lower ends.
    let fall = fan.down_beyond(30.0);
    assert!(fall.iter().all(|fall| (fall - 3.0).abs() < 1e-9), "{fall:?}");
    // From x = 450 the lines get steeper to the right, and turn the other way beyond 300.
    let [left, right] = fan.opening(450.0);
    assert!(
        (left - 1.0 / 3.0).abs() < 1e-9 && right.abs() < 1e-9,
        "{left} {right}"
    );
    assert_eq!(fan.deviation(25.0), Deviation::default());
}

/// Along a crest of 3000 mm, seen at 25 mm: half the curvature times the square of that, and a little for the knots.
#[test]
fn curved_columns_bend_like_spines() {
    let knots: Vec<f64> = (0..=50).map(|number| 20.0 * f64::from(number)).collect();
    let crest = |y: f64| -(y - 500.0) * (y - 500.0) / 6000.0;
    let heights: Vec<f64> = knots.iter().map(|&y| crest(y)).collect();
    let level = || profile(&[(0.0, 90.0), (600.0, 90.0)]);
    let ways = vec![(0.0, heights.clone()), (600.0, heights)];
    let columns = Columns::new(knots.clone(), vec![level(); knots.len()], ways).unwrap();
    let Deviation { above, below } = columns.deviation(25.0);
    assert!((0.104..0.121).contains(&above), "{above}");
    // At a side the plane may be turned by half of the first bend over all of the first piece: 25 mm / 300.
    assert!((0.08..0.09).contains(&below), "{below}");
    let stations = columns.stations(200.0, [-30.0, 1030.0]);
    assert_eq!(stations.len(), knots.len());
    for pair in stations.windows(2) {
        let slope = (pair[1].rise - pair[0].rise) / (pair[1].y - pair[0].y);
        assert!((slope - f64::midpoint(pair[0].slope, pair[1].slope)).abs() < 0.004);
        assert_eq!(grid::nearest(pair[0].rise), pair[0].rise);
    }
}

#[test]
fn what_no_blade_follows_is_refused() {
    let level = || profile(&[(0.0, 0.0), (10.0, 0.0)]);
    let of = |knots: Vec<f64>, heights: Vec<f64>| {
        let covers = vec![level(); knots.len()];
        Columns::new(knots, covers, vec![(0.0, heights.clone()), (10.0, heights)]).err()
    };
    assert_eq!(of(vec![0.0, 50.0], vec![0.0, 5.0]), None);
    assert_eq!(of(vec![0.0, 50.0], vec![0.0]), Some(ColumnsError::Order));
    assert_eq!(of(vec![1.0, 50.0], vec![0.0, 5.0]), Some(ColumnsError::Order));
    assert_eq!(of(vec![0.0, 50.0], vec![0.0, 51.0]), Some(ColumnsError::Bends));
    assert_eq!(
        of(vec![0.0, 50.0, 100.0], vec![0.0, 0.0, 0.5]),
        Some(ColumnsError::Bends)
    );
    assert_eq!(of(vec![0.0, 50.0, 100.0], vec![0.0, 0.0, 0.3]), None);
    assert_eq!(
        of(vec![0.0, 50.0], vec![0.0, f64::NAN]),
        Some(ColumnsError::Bends)
    );
}

/// Columns of 80 mm in three slabs over places 20 mm apart, covered at their knots.
fn columns(heights: &[([f64; 4], [f64; 4])]) -> Columns {
    let knots = vec![0.0, 20.0, 50.0, 80.0];
    let x = |number: usize| 20.0 * number as f64;
    let cover = |knot: usize| {
        let points = heights.iter().enumerate();
        let points = points.map(|(number, (cover, _))| Point2::new(x(number), cover[knot]));
        Profile::new(points.collect()).unwrap()
    };
    // The lengths of slabs times slopes that bend by less than a blade may.
    let way = |slopes: &[f64; 4]| {
        let mut way = vec![0.0];
        for (number, length) in [20.0, 30.0, 30.0].into_iter().enumerate() {
            let slope = slopes[0] + 0.007 * slopes[1..=number].iter().sum::<f64>();
            way.push(way[number] + length * slope);
        }
        way
    };
    let ways = heights.iter().enumerate();
    let ways = ways
        .map(|(number, (_, slopes))| (x(number), way(slopes)))
        .collect();
    Columns::new(knots, (0..4).map(cover).collect(), ways).unwrap()
}

fn shapes(most: usize) -> impl Strategy<Value = Vec<([f64; 4], [f64; 4])>> {
    let slope = -0.3..0.3_f64;
    let bend = -1.0..1.0_f64;
    let slopes = (slope, bend.clone(), bend.clone(), bend).prop_map(|(a, b, c, d)| [a, b, c, d]);
    prop::collection::vec((prop::array::uniform4(10.0..60.0_f64), slopes), 2..most)
}

proptest! {
    /// A V whose lower end lies above the section is clear of the part everywhere, and of a ball of the allowance around each place of it.
    #[test]
    fn what_is_above_the_section_is_clear(
        shapes in shapes(12), flank in 0.5..3.0_f64, share in 0.0..1.0_f64, allowance in 0.0..2.0_f64,
        looks in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64), 40),
    ) {
        let columns = columns(&shapes);
        let width = 20.0 * (shapes.len() - 1) as f64;
        let tip = width * share;
        let low = columns.section(flank, Length::mm(allowance)).height(tip);
        for (across, along, aside, before) in looks {
            let (px, py) = (width * across, 80.0 * along);
            let [dx, dy] = [aside * allowance, before * allowance];
            let (x, y) = (px + dx, py + dy);
            let rest = allowance * allowance - dx * dx - dy * dy;
            if rest < 0.0 || !(0.0..=width).contains(&x) || !(0.0..=80.0).contains(&y) {
                continue;
            }
            let ball = columns.cover([px, py]) + rest.sqrt();
            let vee = low + columns.rise(tip, y) + flank * (x - tip).abs();
            prop_assert!(vee >= ball - 1e-6, "{vee} {ball}");
        }
    }

    /// Seen from their lower ends, Vs lie below ones that open by as much less as is said.
    #[test]
    fn sections_of_a_v_lie_below_its_opening(
        shapes in shapes(8), share in 0.0..1.0_f64, looks in prop::collection::vec(0.0..1.0_f64, 30),
    ) {
        let width = 20.0 * (shapes.len() - 1) as f64;
        let columns = columns(&shapes);
        let tip = width * share;
        let opening = columns.opening(tip);
        for look in looks {
            let x = width * look;
            for y in [0.0, 30.0, 80.0] {
                let seen = columns.rise(tip, y) - columns.rise(x, y);
                prop_assert!(seen <= opening[usize::from(x > tip)] * (x - tip).abs() + 1e-9);
            }
        }
    }

    /// Without corners that hardly bend it a polyline is nowhere lower, and hardly higher.
    #[test]
    fn thinned_polylines_lie_above(steps in prop::collection::vec((0.01..3.0_f64, prop_oneof![Just(0.0), -0.01..0.01_f64, -3.0..3.0_f64]), 2..300)) {
        let mut place = Point2::new(0.0, 0.0);
        let mut points = vec![place];
        for (along, rise) in steps {
            place = Point2::new(place.x + along, place.z + rise);
            points.push(place);
        }
        let [whole, thin] = [points.clone(), thinned(&points)].map(|points| Profile::new(points).unwrap());
        prop_assert_eq!(whole.span(), thin.span());
        for point in points {
            let above = thin.height(point.x) - point.z;
            prop_assert!((-1e-7..=STRAIGHT + 1e-7).contains(&above), "{above}");
        }
    }
}
