//! Least tilts, against sampled discs over surfaces.

use super::*;
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;

const R: f64 = 25.0;

/// The least height of a sampled disc over a surface, without what is next to the contact, where it is 0. The disc touches the
/// surface at a place with a normal, the contact in front.
fn clearance(surface: &dyn Fn(f64, f64) -> f64, contact: &Contact, tilt: f64) -> f64 {
    let lean = Lean {
        lead: Angle::rad(tilt),
        side: Angle::ZERO,
    };
    let pose = contact.pose(Length::mm(R), lean).unwrap();
    let left = contact.left();
    let centre = pose.centre.to_array();
    let out: [f64; 3] = core::array::from_fn(|i| (contact.place.to_array()[i] - centre[i]) / R);
    let mut least = f64::INFINITY;
    for k in 1..720 {
        // Finer near the contact.
        let share = f64::from(k) / 720.0;
        let phi = core::f64::consts::TAU * share;
        let (sine, cosine) = libm::sincos(phi);
        for r in [1.0, 0.8, 0.5] {
            let at = |i: usize| centre[i] + R * r * (cosine * out[i] + sine * left[i]);
            // Relative to the height of the rim over the tangent plane, which is that of the curvature too.
            let scale = if r == 1.0 { 1.0 - cosine } else { 1.0 };
            least = least.min((at(2) - surface(at(0), at(1))) / scale);
        }
    }
    least
}

/// The least tilt, in degrees, by halving.
fn sampled_tilt(surface: &dyn Fn(f64, f64) -> f64, contact: &Contact) -> f64 {
    let (mut low, mut high) = (0.0, 1.5);
    if clearance(surface, contact, low) >= -1e-12 {
        return 0.0;
    }
    for _ in 0..40 {
        let middle = f64::midpoint(low, high);
        if clearance(surface, contact, middle) >= 0.0 {
            high = middle
        } else {
            low = middle
        }
    }
    high.to_degrees()
}

fn flat_contact(turn: f64) -> Contact {
    let feed = [libm::cos(turn), libm::sin(turn)];
    Contact::new(Point3::new(0.0, 0.0, 0.0), [0.0, 0.0, 1.0], feed).unwrap()
}

fn degrees(angle: Option<Angle>) -> f64 {
    angle.unwrap().to_deg()
}

#[test]
fn known_tilts() {
    let radius = Length::mm(R);
    let yang = |curvature| by_greatest_curvature(radius, curvature);
    let exact = |form| on_paraboloid(radius, form);
    for (value, expected) in [
        (yang(1.0 / 300.0), 4.78019),
        (exact([1.0 / 300.0, 0.0, 0.0]), 4.74737),
        (exact([0.0, 0.0, 1.0 / 300.0]), 4.78019),
        (yang(1.0 / 500.0), 2.86598),
        (exact([1.0 / 500.0, 0.0, 1.0 / 500.0]), 2.86598),
        (yang(1.0 / 60.0), 24.62432),
        (exact([1.0 / 60.0, 0.0, 1.0 / 60.0]), 24.62432),
        (exact([0.0, 1.0 / 300.0, 0.0]), 4.76364),
        (yang(1.0 / 400.0), 3.58332),
        (exact([1.0 / 400.0, 0.0, -1.0 / 600.0]), 3.56941),
        (exact([-1.0 / 600.0, 0.0, 1.0 / 400.0]), 3.58332),
        (yang(1.0 / 100.0), 14.47751),
        (exact([1.0 / 100.0, 0.0, 1.0 / 200.0]), 13.65458),
        (exact([1.0 / 20.0, 0.0, 0.0]), 42.61222),
        (exact([-0.01, 0.0, -0.01]), 0.0),
        (yang(-0.01), 0.0),
        (yang(2.275806881e-3), 3.261615),
    ] {
        assert!(
            (degrees(value) - expected).abs() < 1e-5,
            "{} for {expected}",
            degrees(value)
        );
    }
    assert_eq!(yang(1.0 / 20.0), None);
    assert_eq!(yang(f64::NAN), None);
    assert_eq!(exact([0.0, 0.0, 1.0 / 20.0]), None);
}

#[test]
fn the_curvature_at_the_contact_alone_is_not_enough() {
    let height = |x: f64, y: f64| x * y / 300.0;
    let curvature =
        |x: f64, y: f64| Curvature::of_height([y / 300.0, x / 300.0], [0.0, 1.0 / 300.0, 0.0]).unwrap();
    let here = curvature(60.0, 90.0);
    let contact = Contact::new(Point3::new(60.0, 90.0, 18.0), here.normal(), [1.0, 0.0]).unwrap();
    let radius = Length::mm(R);
    let at_contact = by_greatest_curvature(radius, here.principal()[0]).unwrap();
    assert!((at_contact.to_deg() - 3.99683).abs() < 1e-5);
    assert!(clearance(&height, &contact, at_contact.to_rad()) < 0.0);
    assert!((sampled_tilt(&height, &contact) - 4.13571).abs() < 3e-3);
    // The greatest one under the disc.
    let most = (0..=100)
        .flat_map(|i| (0..=100).map(move |j| (f64::from(i) - 100.0, f64::from(j) - 50.0)))
        .map(|(i, j)| curvature(60.0 + i / 2.0, 90.0 + j / 2.0).principal()[0])
        .fold(0.0, f64::max);
    let proven = by_greatest_curvature(radius, most).unwrap();
    assert!(proven.to_deg() > 4.13571 && proven.to_deg() < 4.6, "{proven:?}");
    assert!(clearance(&height, &contact, proven.to_rad()) >= 0.0);
}

proptest! {
    #[test]
    fn paraboloids_are_cleared_by_the_least_tilt_and_by_none_below(
        form in prop::array::uniform3(-0.012..0.012f64), turn in 0.0..6.3f64,
    ) {
        let curvature = Curvature::of_height([0.0; 2], form).unwrap();
        let contact = flat_contact(turn);
        let surface = |x: f64, y: f64| form[0] * x * x / 2.0 + form[1] * x * y + form[2] * y * y / 2.0;
        let found = degrees(least_lead(Length::mm(R), &contact, &curvature));
        let expected = sampled_tilt(&surface, &contact);
        prop_assert!((found - expected).abs() < 3e-3, "{found} {expected}");
        let yang = degrees(by_greatest_curvature(Length::mm(R), curvature.principal()[0]));
        prop_assert!(found <= yang + 1e-9);
        for (tilt, is_clear) in [(found + 0.001, true), (found - 0.001, false)] {
            let lean = Lean { lead: Angle::deg(tilt), side: Angle::ZERO };
            prop_assert!(tilt < 0.0 || clears(Length::mm(R), &contact, &curvature, lean) == Some(is_clear));
        }
    }
}
