//! Rims against the numbers of the field and against circles sampled in space.

use super::*;
use proptest::prelude::*;

fn rim(lead: f64) -> Rim {
    Rim::new(Point2::new(0.0, 0.0), Length::mm(25.0), Angle::deg(lead))
}

#[test]
fn a_disc_of_25_mm_is_as_deep_as_published() {
    for (lead, lowest, overhang, fall) in [(3.0, -1.3084, 24.9657, 1.0467), (5.0, -2.1789, 24.9049, 1.7431)] {
        let rim = rim(lead);
        assert!((rim.lowest().z - lowest).abs() < 5e-5);
        assert!((rim.overhang().to_mm() - overhang).abs() < 5e-5);
        // The floor of a strip of 10 mm falls from the rim to its open side.
        assert!((rim.height(25.0) - rim.height(15.0) - fall).abs() < 5e-5);
    }
    // The floor at the slit of a strip half a millimetre within the rim.
    assert!((rim(3.0).height(24.5) + 0.260).abs() < 5e-4);
    // Ripples between passes 10 mm apart.
    assert!((rim(3.0).height(5.0) - rim(3.0).height(0.0) - 0.0264).abs() < 5e-5);
    // Against a flank of slope 0.1.
    assert!((rim(3.0).touching(0.1).x - 22.1499).abs() < 5e-5);
    assert!((rim(3.0).flank(0.1) + 2.8217).abs() < 5e-5);
}

proptest! {
    #[test]
    fn it_is_the_lower_edge_of_a_circle_in_space(
        (radius, lead, x, z) in (1.0..80.0_f64, 0.0..30.0_f64, -50.0..50.0_f64, -20.0..60.0_f64),
        slope in -3.0..3.0_f64,
    ) {
        let rim = Rim::new(Point2::new(x, z), Length::mm(radius), Angle::deg(lead));
        let lean = lead.to_radians();
        let points = (0..=20_000_u32).map(|i| {
            let turn = f64::from(i) / 20_000.0 * core::f64::consts::TAU;
            // The axis leans along y.
            let (sine, cosine) = libm::sincos(turn);
            (x + radius * cosine, z + radius * sine * libm::sin(lean))
        });
        let mut lowest = f64::INFINITY;
        for (at, height) in points {
            prop_assert!(height >= rim.height(at) - 1e-6);
            lowest = lowest.min(height - slope * (at - x));
        }
        prop_assert!((lowest - rim.flank(slope)).abs() < 1e-4 * radius);
        let touching = rim.touching(slope);
        prop_assert!((touching.z - slope * (touching.x - x) - rim.flank(slope)).abs() < 1e-9 * radius);
    }

    /// The same of one that drifts: its points, each moved along its way into the section through the centre. And how far along the way
    /// they lie.
    #[test]
    fn drifting_it_is_the_lower_edge_of_a_circle_that_is_swept(
        (radius, lead, roll) in (1.0..80.0_f64, -10.0..20.0_f64, -40.0..40.0_f64),
        right in -0.6..0.6_f64, climb in -0.6..0.6_f64, share in -0.99..0.99_f64,
    ) {
        let [x, y, z] = axis(Angle::deg(lead), Angle::deg(roll));
        let ahead = (right * x + y + climb * z) / (1.0 + right * right + climb * climb).sqrt();
        prop_assume!(ahead > 0.02);
        // Two directions square to the axis.
        let u = [z, 0.0, -x].map(|part| part / (x * x + z * z).sqrt());
        let v = [y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]];
        let centre = Point2::new(3.0, 5.0);
        let pass = crate::disc::SkinPass {
            centre,
            contact: 3.0,
            lead: Angle::deg(lead),
            roll: Angle::deg(roll),
            drift: Drift { right, climb },
            over_hub: Length::ZERO,
            clearance: Length::ZERO,
        };
        let disc = crate::disc::Disc { radius: Length::mm(radius), depth: None, width: None, body: Vec::new() };
        let rim = pass.rim(&disc);
        let [from, to] = rim.cover();
        let place = f64::midpoint(from, to) + share * (to - from) / 2.0;
        let mut nearest = (f64::INFINITY, [0.0; 2]);
        for i in 0..20_000_u32 {
            let (sine, cosine) = libm::sincos(f64::from(i) / 20_000.0 * core::f64::consts::TAU);
            let off: [f64; 3] = core::array::from_fn(|i| radius * (u[i] * cosine + v[i] * sine));
            let (at, height) = (3.0 + off[0] - right * off[1], 5.0 + off[2] - climb * off[1]);
            prop_assert!(height >= rim.height(at) - 1e-6, "{at} {height} {}", rim.height(at));
            // Of both points over the place the lower one.
            if (at - place).abs() < radius * 2e-3 && height < nearest.0 {
                nearest = (height, [off[1], at]);
            }
        }
        let (height, [along, at]) = nearest;
        prop_assert!((height - rim.height(at)).abs() < 1e-6 * radius);
        prop_assert!((along - pass.ahead(&disc, at)).abs() < 1e-5 * radius, "{along}");
    }

    /// The same of a disc that is rolled: its axis is turned about y after it leans.
    #[test]
    fn rolled_it_is_the_lower_edge_of_a_circle_in_space(
        (radius, lead, x, z) in (1.0..80.0_f64, 0.5..30.0_f64, -50.0..50.0_f64, -20.0..60.0_f64),
        roll in -60.0..60.0_f64,
        slope in -3.0..3.0_f64,
    ) {
        let rim = Rim::rolled(Point2::new(x, z), Length::mm(radius), Angle::deg(lead), Angle::deg(roll));
        let (lean, turned) = (lead.to_radians(), roll.to_radians());
        let points = (0..=20_000_u32).map(|i| {
            let (sine, cosine) = libm::sincos(f64::from(i) / 20_000.0 * core::f64::consts::TAU);
            let (across, up) = (radius * cosine, radius * sine * libm::sin(lean));
            (
                x + across * libm::cos(turned) - up * libm::sin(turned),
                z + across * libm::sin(turned) + up * libm::cos(turned),
            )
        });
        let mut lowest = f64::INFINITY;
        let [mut left, mut right] = [f64::INFINITY, f64::NEG_INFINITY];
        for (at, height) in points {
            prop_assert!(height >= rim.height(at) - 1e-6);
            lowest = lowest.min(height - slope * (at - x));
            (left, right) = (left.min(at), right.max(at));
        }
        let [from, to] = rim.cover();
        prop_assert!((left - from).abs() < 1e-4 * radius && (right - to).abs() < 1e-4 * radius);
        prop_assert!((lowest - rim.flank(slope)).abs() < 1e-4 * radius);
        let touching = rim.touching(slope);
        prop_assert!((touching.z - slope * (touching.x - x) - rim.flank(slope)).abs() < 1e-9 * radius);
        prop_assert!((rim.height(touching.x) - touching.z).abs() < 1e-6 * radius);
        // Where it stands on the part it is as blunt as `R / sin(lambda)` [Yang 9].
        let blunt = rim.curvature_radius(libm::tan(turned));
        prop_assert!((blunt * libm::sin(lean) / radius - 1.0).abs() < 1e-6, "{blunt}");
    }

    #[test]
    fn chords_are_above_it_by_no_more_than_asked(
        lead in 0.01..20.0_f64,
        (a, b) in (-25.0..25.0_f64, -25.0..25.0_f64),
        tolerance in 1e-4..1e-1_f64,
    ) {
        let (from, to) = (a.min(b), a.max(b));
        let rim = rim(lead);
        let mut chords = Vec::new();
        rim.chords(from, to, tolerance, &mut chords);
        prop_assert!(chords[0].x == from && chords[chords.len() - 1].x == to);
        for pair in chords.windows(2) {
            prop_assert!(pair[0].x < pair[1].x || from == to);
            for i in 0..=50_u32 {
                let at = pair[0].lerp(pair[1], f64::from(i) / 50.0);
                let above = rim.below(at);
                prop_assert!((-1e-9..=tolerance + 1e-9).contains(&above), "{above}");
            }
        }
    }

    #[test]
    fn a_line_is_above_it_between_its_crossings(
        lead in prop_oneof![Just(0.0), Just(1e-7), 0.01..20.0_f64],
        (u, v) in ((-25.0..25.0_f64, -4.0..2.0_f64), (-25.0..25.0_f64, -4.0..2.0_f64)),
        level in 0.0..1.0_f64,
    ) {
        prop_assume!((u.0 - v.0).abs() > 1e-6);
        let rim = rim(lead);
        let (from, to) = if u.0 < v.0 { (u, v) } else { (v, u) };
        let (from, to) = (Point2::new(from.0, from.1), Point2::new(to.0, to.1));
        let above = rim.above(from, to, level);
        for i in 0..=200_u32 {
            let at = from.lerp(to, f64::from(i) / 200.0);
            let is_above = rim.below(at) > level;
            let within = |by: f64| above.is_some_and(|above| (above.from - by..=above.to + by).contains(&at.x));
            let is_near = within(1e-9) != within(-1e-9) || (rim.below(at) - level).abs() < 1e-9;
            prop_assert!(is_above == within(0.0) || is_near, "{at:?} {above:?}");
        }
    }
}

/// A strip of 10 mm beside a rim that continues for half a millimetre, with a lead of 5 deg.
#[test]
fn a_strip_takes_few_chords() {
    let mut chords = Vec::new();
    rim(5.0).chords(14.5, 24.5, 1e-3, &mut chords);
    assert!((18..=24).contains(&chords.len()), "{}", chords.len());
}
