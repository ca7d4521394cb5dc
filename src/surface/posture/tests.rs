//! Postures: against their definition, and numbers worked out elsewhere.

use super::*;
use crate::drop::Dropper;
use crate::testkit::{FIXED, sampled, surface_over};
use proptest::prelude::*;

fn lean(lead: f64, side: f64) -> Lean {
    Lean {
        lead: Angle::deg(lead),
        side: Angle::deg(side),
    }
}

fn assert_near(value: f64, expected: f64, within: f64) {
    assert!((value - expected).abs() <= within, "{value} for {expected}");
}

#[test]
fn radii_of_what_is_swept() {
    let radius = Length::mm(25.0);
    let swept = |lead, side| lean(lead, side).swept_radius(radius).unwrap().to_mm();
    assert_near(swept(5.0, 0.0), 286.842831, 1e-6);
    assert_near(swept(5.0, 3.0), 181.287554, 1e-6);
    assert_near(swept(4.0, -8.0), 32.432447, 1e-6);
    assert_eq!(lean(0.0, 0.0).swept_radius(radius), None);
}

#[test]
fn strips_pass_beside_the_hub() {
    let radius = Length::mm(25.0);
    for (lead, side, tilt, swept, rim) in [
        (3.0, 2.035999, 3.625121, 270.90, 0.694951),
        (5.0, 3.418057, f64::NAN, 161.87, 1.157552),
    ] {
        let lean = lean(lead, side);
        assert_near(lean.beside(radius).to_mm(), 14.0, 1e-4);
        assert_near(lean.swept_radius(radius).unwrap().to_mm(), swept, 5e-3);
        assert_near(lean.rim(radius).to_mm(), rim, 1e-5);
        if !tilt.is_nan() {
            assert_near(lean.tilt().to_deg(), tilt, 1e-6);
        }
    }
    // Hub of 12, air 1, strips of 8: the near edge of the strip passes it.
    assert_near(lean(3.0, 2.799287).beside(radius).to_mm() - 4.0, 13.0, 1e-5);
    // How high the rim stands beside a disc that leads only.
    for (lead, rim) in [(3.0, 1.308399), (5.0, 2.178894), (8.0, 3.479328)] {
        assert_near(lean(lead, 0.0).rim(radius).to_mm(), rim, 1e-6);
    }
}

proptest! {
    /// On a plane the exact drop puts the disc where the posture says, and it touches at the contact.
    #[test]
    fn a_posture_on_a_plane_is_where_the_disc_comes_to_rest(
        slope in prop::array::uniform2(-0.5..0.5f64), turn in 0.0..6.3f64, lead in 0.5..12.0f64, side in -10.0..10.0f64,
    ) {
        let height = |x: f64, y: f64| 50.0 + slope[0] * x + slope[1] * y;
        let surface = surface_over(&sampled(200.0, 200.0, [1, 1], &height), FIXED, 200.0, 200.0);
        let place = Point3::new(100.0, 100.0, height(100.0, 100.0));
        let feed = [libm::cos(turn), libm::sin(turn)];
        let contact = Contact::new(place, [-slope[0], -slope[1], 1.0], feed).unwrap();
        let (radius, lean) = (Length::mm(25.0), lean(lead, side));
        let pose = contact.pose(radius, lean).unwrap();
        let rest = Dropper::new(&surface).face(radius, [pose.centre.x, pose.centre.y], pose.axis).unwrap();
        prop_assert!((rest.height.to_mm() - pose.centre.z).abs() < 1e-9);
        prop_assert!(rest.touch.distance(place).to_mm() < 1e-6);
        // The tilt is the angle to the normal; the contact lies as far beside the centre as the lean says.
        let along = dot(pose.axis.to_array(), contact.normal());
        prop_assert!((libm::acos(along) - lean.tilt().to_rad()).abs() < 1e-7);
        let out: [f64; 3] = core::array::from_fn(|i| place.to_array()[i] - pose.centre.to_array()[i]);
        prop_assert!((dot(out, contact.left()) - lean.beside(radius).to_mm()).abs() < 1e-9);
        // The frame has the centre's contact on its x, and z into the part.
        let matrix = contact.frame(&pose).unwrap().orientation.matrix();
        for (row, (out, axis)) in matrix.iter().zip(out.iter().zip(pose.axis.to_array())) {
            prop_assert!((row[0] * 25.0 - out).abs() < 1e-9 && (row[2] + axis).abs() < 1e-9);
        }
        // The feed keeps to its plane.
        let moves = contact.feed();
        prop_assert!((moves[0] * feed[1] - moves[1] * feed[0]).abs() < 1e-12 && moves[0] * feed[0] + moves[1] * feed[1] > 0.0);
    }
}

#[test]
fn what_has_no_direction_is_not_a_contact() {
    let place = Point3::new(0.0, 0.0, 0.0);
    assert_eq!(Contact::new(place, [0.0, 0.0, -1.0], [1.0, 0.0]), None);
    assert_eq!(Contact::new(place, [1.0, 0.0, 0.0], [1.0, 0.0]), None);
    assert_eq!(Contact::new(place, [0.0, 0.0, 1.0], [0.0, 0.0]), None);
    assert_eq!(Contact::new(place, [f64::NAN, 0.0, 1.0], [1.0, 0.0]), None);
    let flat = Contact::new(place, [0.0, 0.0, 1.0], [1.0, 0.0]).unwrap();
    assert_eq!(flat.axis(lean(95.0, 0.0)), None);
    // A face on the tangent plane touches in front.
    let pose = flat.pose(Length::mm(25.0), lean(0.0, 0.0)).unwrap();
    assert_eq!(pose.centre, Point3::new(-25.0, 0.0, 0.0));
}
