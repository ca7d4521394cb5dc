//! Leads, against numbers found by sampling smooth surfaces, and against proofs by curvature.

use super::*;
use crate::curvature::Curvature;
use crate::surface::Surface;
use crate::testkit::{FIXED, sampled, surface_over};
use crate::tilt::{by_greatest_curvature, least_lead as by_paraboloid};
use proptest::prelude::*;

const R: Length = Length::mm(25.0);
const SIZE: f64 = 120.0;

fn surface(cells: u32, height: &dyn Fn(f64, f64) -> f64) -> Surface {
    surface_over(&sampled(SIZE, SIZE, [cells, cells], height), FIXED, SIZE, SIZE)
}

fn wish(lift: f64) -> Wish {
    Wish {
        radius: R,
        side: Angle::ZERO,
        least: Angle::ZERO,
        most: Angle::deg(60.0),
        lift: Length::mm(lift),
    }
}

/// At the middle of the plan, with the feed along x.
fn contact(height: &dyn Fn(f64, f64) -> f64, slope: [f64; 2]) -> Contact {
    let place = Point3::new(60.0, 60.0, height(60.0, 60.0));
    Contact::new(place, [-slope[0], -slope[1], 1.0], [1.0, 0.0]).unwrap()
}

#[test]
fn a_bump_at_the_heel_asks_for_a_lead_that_no_curvature_shows() {
    let bump = |x: f64, y: f64| libm::exp(-((x - 30.0) * (x - 30.0) + (y - 60.0) * (y - 60.0)) / 50.0);
    let surface = surface(240, &bump);
    let found = least_lead(&Dropper::new(&surface), &contact(&bump, [0.0; 2]), &wish(1e-5)).unwrap();
    assert!((found.lean.lead.to_deg() - 1.93567).abs() < 3e-3, "{found:?}");
    // A little less meets the bump.
    let lean = Lean {
        lead: Angle::deg(1.9),
        side: Angle::ZERO,
    };
    let lower = stand(&Dropper::new(&surface), &contact(&bump, [0.0; 2]), R, lean).unwrap();
    let touch = lower.touch.unwrap();
    assert!(libm::hypot(touch.x - 30.0, touch.y - 60.0) < 6.0, "{touch:?}");
}

#[test]
fn leads_of_known_surfaces() {
    // Depths of gouges grow with the square of what a lead lacks, so a small lift allows a little less.
    for (height, slope, expected) in [
        (
            (|x, y| (x - 60.0) * (y - 60.0) / 300.0) as fn(f64, f64) -> f64,
            [0.0, 0.0],
            4.76364,
        ),
        (|x, y| x * (y + 30.0) / 300.0, [0.3, 0.2], 4.13571),
        (|x, _| (x - 60.0) * (x - 60.0) / 600.0, [0.0, 0.0], 4.74737),
        (
            |_, y| 300.0 - libm::sqrt(9e4 - (y - 60.0) * (y - 60.0)),
            [0.0, 0.0],
            4.7802,
        ),
        (
            |x, y| -((x - 60.0) * (x - 60.0) + (y - 60.0) * (y - 60.0)) / 900.0,
            [0.0, 0.0],
            0.0,
        ),
    ] {
        let surface = surface(240, &height);
        let found = least_lead(&Dropper::new(&surface), &contact(&height, slope), &wish(3e-4)).unwrap();
        let lead = found.lean.lead.to_deg();
        assert!(
            lead < expected + 3e-3 && lead > expected - 0.1,
            "{lead} for {expected}"
        );
        assert!(found.lift.to_mm() <= 3e-4);
    }
}

#[test]
fn a_hollow_too_tight_for_the_disc_is_refused_with_its_place() {
    let trough = |_: f64, y: f64| (y - 60.0) * (y - 60.0) / 40.0;
    let surface = surface(120, &trough);
    let dropper = Dropper::new(&surface);
    let contact = contact(&trough, [0.0; 2]);
    let Err(NoLead::Lifted { standing }) = least_lead(&dropper, &contact, &wish(0.01)) else {
        panic!("no disc of 25 fits into a trough of 20");
    };
    assert!(standing.lift.to_mm() > 0.01 && standing.lean.lead.to_deg() > 59.0);
    for (least, most) in [(5.0, 4.0), (f64::NAN, 4.0), (0.0, f64::INFINITY)] {
        let (least, most) = (Angle::deg(least), Angle::deg(most));
        let wish = Wish {
            least,
            most,
            ..wish(0.01)
        };
        assert_eq!(least_lead(&dropper, &contact, &wish), Err(NoLead::Range));
    }
}

fn waves() -> impl Strategy<Value = [f64; 4]> {
    [0.5..3.0f64, 0.5..3.0f64, 0.0..6.3f64, 0.0..6.3f64]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A tilt by the greatest curvature under the disc is a proof; the paraboloid of the contact alone is
    /// not, and the drop never asks for more than the proof.
    #[test]
    fn a_proof_by_curvature_is_never_lifted([a, b, s, t] in waves(), turn in 0.0..6.3f64) {
        let height = move |x: f64, y: f64| a * libm::sin(x / 30.0 + s) + b * libm::cos((y + x / 2.0) / 35.0 + t);
        let curvature = |x: f64, y: f64| {
            let (p, q) = (x / 30.0 + s, (y + x / 2.0) / 35.0 + t);
            let (u, v) = (a * libm::sin(p) / 900.0, b * libm::cos(q) / 1225.0);
            let slope = [
                a * libm::cos(p) / 30.0 - b * libm::sin(q) / 70.0,
                -b * libm::sin(q) / 35.0,
            ];
            Curvature::of_height(slope, [-u - v / 4.0, -v / 2.0, -v]).unwrap()
        };
        let surface = surface(120, &height);
        let dropper = Dropper::new(&surface);
        let here = curvature(60.0, 60.0);
        let feed = [libm::cos(turn), libm::sin(turn)];
        let contact = Contact::new(Point3::new(60.0, 60.0, height(60.0, 60.0)), here.normal(), feed).unwrap();
        let grid = || (0..=104).map(|i| 8.0 + f64::from(i));
        let most = grid()
            .flat_map(|x| grid().map(move |y| (x, y)))
            .map(|(x, y)| curvature(x, y).principal()[0])
            .fold(0.0, f64::max);
        let proven = by_greatest_curvature(R, most * 1.01).unwrap();
        let lean = Lean { lead: proven, side: Angle::ZERO };
        let standing = stand(&dropper, &contact, R, lean).unwrap();
        // Facets lie above hollows by up to a quarter of the square of their size, times the curvature.
        let above = most / 4.0 + 1e-9;
        prop_assert!(standing.lift.to_mm() <= above, "{:?} {above}", standing.lift);
        let found = least_lead(&dropper, &contact, &wish(above)).unwrap();
        prop_assert!(found.lean.lead <= proven + Angle::deg(0.001));
        prop_assert!(by_paraboloid(R, &contact, &here).unwrap() <= proven);
    }

    #[test]
    fn smoothed_leads_are_the_least_above(
        steps in prop::collection::vec((0.1..5.0f64, 0.0..0.3f64), 2..30), rate in 0.001..0.1f64,
    ) {
        let mut s = 0.0;
        let along: Vec<Length> = steps.iter().map(|(step, _)| { s += step; Length::mm(s) }).collect();
        let leads: Vec<Angle> = steps.iter().map(|&(_, lead)| Angle::rad(lead)).collect();
        let smooth = smoothed(&along, &leads, Angle::rad(rate)).unwrap();
        for (place, lead) in along.iter().zip(&smooth) {
            let all = along.iter().zip(&leads);
            let expected = all
                .map(|(other, lead)| lead.to_rad() - rate * (*place - *other).to_mm().abs())
                .fold(0.0, f64::max);
            prop_assert!((lead.to_rad() - expected).abs() < 1e-12);
        }
    }
}

#[test]
fn tracks_that_do_not_ascend_are_refused() {
    let lengths = [1.0, 1.0].map(Length::mm);
    assert_eq!(smoothed(&lengths, &[Angle::ZERO; 2], Angle::deg(1.0)), None);
    assert_eq!(smoothed(&lengths, &[Angle::ZERO], Angle::deg(1.0)), None);
    assert_eq!(
        smoothed(&[Length::ZERO, Length::mm(1.0)], &[Angle::ZERO; 2], Angle::ZERO),
        None
    );
}
