//! Ways over a saddle-like patch, against the points at which the disc's edge passes a section.

use super::*;
use proptest::prelude::*;
use vcutc_backend_api::units::Length;
use vcutc_geometry::profile::Profile;
use vcutc_surface::posture::{Contact, Lean};

const RADIUS: f64 = 25.0;

/// A part with these curvatures across and along, and its slope.
fn height([across, along]: [f64; 2], x: f64, y: f64) -> f64 {
    20.0 + across * (x - 50.0) * (x - 50.0) / 2.0 + along * (y - 60.0) * (y - 60.0) / 2.0
}

fn poses(bends: [f64; 2], x: f64, lean: Lean, feed: Feed) -> Vec<Pose> {
    let places = (0..=240_u32).map(|k| f64::from(k) / 2.0);
    let mut poses: Vec<Pose> = places
        .map(|y| {
            let normal = [-bends[0] * (x - 50.0), -bends[1] * (y - 60.0), 1.0];
            let place = Point3::new(x, y, height(bends, x, y));
            let contact = Contact::new(place, normal, [0.0, feed.along(1.0)]).unwrap();
            contact.pose(Length::mm(RADIUS), lean).unwrap()
        })
        .collect();
    if feed == Feed::Backward {
        poses.reverse();
    }
    poses
}

/// Compares a pass with the points of the edge as they cross the section, each at a time of its own: the lowest of them over a place are
/// what the disc leaves there.
fn compare_with_points(bends: [f64; 2], x: f64, lean: Lean, feed: Feed) {
    let poses = poses(bends, x, lean, feed);
    let section = 60.0;
    let part = (0..=100_u32).map(|k| Point2::new(f64::from(k), height(bends, f64::from(k), section)));
    let part = Profile::new(part.collect()).unwrap();
    let disc = Disc {
        radius: Length::mm(RADIUS),
        depth: None,
        width: None,
        body: Vec::new(),
    };
    let skin = Skin {
        depth: Length::ZERO,
        width: Length::ZERO,
        over_hub: Length::ZERO,
        clearance: Length::ZERO,
    };
    let way = Way::new(poses.clone()).unwrap();
    let (pass, _) = way.pass(section, &disc, skin, &Guard::new(&part)).unwrap();
    assert!((pass.contact - x).abs() < 1.5, "{} {x}", pass.contact);
    let rim = pass.rim(&disc);
    // By the way: points of the edge that cross the section between two moments.
    let mut lowest = [f64::INFINITY; 16];
    for turn in (0..7200_u32).map(|k| f64::from(k) / 20.0).map(f64::to_radians) {
        let at = |pose: &Pose| {
            let [a, b, c] = pose.axis.to_array();
            let flat = libm::hypot(a, c);
            let u = [c / flat, 0.0, -a / flat];
            let v = [b * u[2] - c * u[1], c * u[0] - a * u[2], a * u[1] - b * u[0]];
            let (sine, cosine) = libm::sincos(turn);
            let centre = pose.centre.to_array();
            let point: [f64; 3] =
                core::array::from_fn(|i| centre[i] + RADIUS * (u[i] * cosine + v[i] * sine));
            point
        };
        for (from, to) in poses.iter().map(at).zip(poses.iter().skip(1).map(at)) {
            let done = (section - from[1]) / (to[1] - from[1]);
            if (0.0..1.0).contains(&done) {
                let (px, pz) = (
                    from[0] + (to[0] - from[0]) * done,
                    from[2] + (to[2] - from[2]) * done,
                );
                let place = px - x + 8.0;
                if (0.0..16.0).contains(&place) {
                    let above = pz - rim.height(px);
                    lowest[place as usize] = lowest[place as usize].min(above);
                }
            }
        }
    }
    for (place, above) in lowest.into_iter().enumerate() {
        // By the bend of the way over the distance between this point and the contact.
        let at = x + place as f64 - 7.5;
        let apart = (pass.ahead(&disc, at) - pass.ahead(&disc, pass.contact)).abs() + 0.5;
        let bend = bends[1].abs() * apart * apart;
        assert!(above.abs() < 0.001 + bend, "{above} at {place}, not {bend}");
    }
}

fn leaning(lead: f64, side: f64) -> Lean {
    Lean {
        lead: Angle::deg(lead),
        side: Angle::deg(side),
    }
}

const fn feed(is_forward: bool) -> Feed {
    if is_forward { Feed::Forward } else { Feed::Backward }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn a_pass_is_what_the_edge_leaves_in_a_section(
        across in -0.002..0.001f64, along in -0.0005..0.0005f64, x in 35.0..65.0f64,
        lead in 3.0..10.0f64, side in -3.0..3.0f64, is_forward: bool,
    ) {
        compare_with_points([across, along], x, leaning(lead, side), feed(is_forward));
    }

    /// On a flank across the tracks the axis turns about the way as the part falls off along it, and the disc gets aside.
    #[test]
    fn a_pass_on_a_flank_is_what_the_edge_leaves_in_a_section(
        across in -0.02..-0.01f64, along in -0.0005..0.0005f64, x in prop_oneof![15.0..30.0f64, 70.0..85.0f64],
        lead in 3.0..10.0f64, side in -3.0..3.0f64, is_forward: bool,
    ) {
        compare_with_points([across, along], x, leaning(lead, side), feed(is_forward));
    }
}

#[test]
fn what_turns_back_is_not_a_way() {
    let lean = Lean {
        lead: Angle::deg(5.0),
        side: Angle::ZERO,
    };
    let mut turning = poses([0.0; 2], 50.0, lean, Feed::Forward);
    assert!(Way::new(turning.clone()).is_some());
    assert_eq!(Way::new(vec![turning[0]]), None);
    turning.swap(10, 11);
    assert_eq!(Way::new(turning), None);
}

#[test]
fn leads_are_seen_from_the_way() {
    let lean = Lean {
        lead: Angle::deg(5.0),
        side: Angle::ZERO,
    };
    // The centre goes on a smaller circle than the contact, so that the way turns with it.
    let way = Way::new(poses([0.0, -0.0005], 50.0, lean, Feed::Backward)).unwrap();
    for lead in way.leads().unwrap() {
        assert!((lead.to_deg() - 5.0).abs() < 0.8, "{lead:?}");
    }
}
