//! Finishing passes against the numbers of the field, and against surfaces that are cut point by point.

use super::*;
use crate::disc::{Hold, PassFault, SkinPass};
use crate::rim::{Drift, Rim};
use crate::surface::Vee;
use proptest::prelude::*;

fn over(centre: Point2, lead: f64, roll: f64) -> SkinPass {
    let rim = Rim::rolled(centre, Length::mm(25.0), Angle::deg(lead), Angle::deg(roll));
    SkinPass {
        centre,
        contact: rim.touching(libm::tan(f64::to_radians(roll))).x,
        lead: Angle::deg(lead),
        roll: Angle::deg(roll),
        drift: Drift::NONE,
        over_hub: Length::mm(100.0),
        clearance: Length::ZERO,
    }
}

/// Grooves of V cuts so far apart, with their bottoms at a height.
fn grooved(width: f64, top: f64, step: f64, bottom: f64) -> CrossSection {
    let mut surface = Surface::flat(width, top);
    let mut x = 0.0;
    while x <= width {
        surface.release(Vee::even(at(x, bottom), 2.0));
        x += step;
    }
    CrossSection::new(surface)
}

/// A groove frees only from `R sqrt(1 - (1 - h0 / (R sin lambda))^2)` on: at 5 deg and h0 0.5, 1.0 and 2.0 from 15.9352, 21.0247 and
/// 24.9156 mm.
#[test]
fn the_rim_comes_out_where_it_is_published() {
    let rim = over(at(0.0, 0.0), 5.0, 0.0).rim(&disc(25.0));
    for (high, out) in [(0.5, 15.9352), (1.0, 21.0247), (2.0, 24.9156)] {
        let [left, right] = rim.levels(rim.lowest().z + high);
        assert!(
            (right - out).abs() < 5e-5 && (left + out).abs() < 5e-5,
            "{left} {right}"
        );
    }
    for (lead, rise) in [(3.0, 1.308_399), (5.0, 2.178_894), (8.0, 3.479_328)] {
        let rim = over(at(0.0, 0.0), lead, 0.0).rim(&disc(25.0));
        assert!((rim.depth().to_mm() - rise).abs() < 5e-7);
    }
}

/// The scallop between tracks on a plane, `sin lambda (R - sqrt(R^2 - a^2 / 4))`: published for tracks 10 and 20 mm apart.
#[test]
fn tracks_on_a_plane_leave_the_published_scallop() {
    for (lead, apart, published) in [
        (5.0, 10.0, 0.044_022_59),
        (5.0, 20.0, 0.181_904_63),
        (3.0, 10.0, 0.026_435_03),
    ] {
        for roll in [0.0, 20.0] {
            // A plane of that slope, with its tracks so far apart along it.
            let (sine, cosine) = libm::sincos(f64::to_radians(roll));
            let rims =
                [0.0, apart].map(|along| over(at(along * cosine, along * sine), lead, roll).rim(&disc(25.0)));
            let mut highest = f64::NEG_INFINITY;
            for i in 0..=10_000_u32 {
                let x = rims[0].centre().x + apart * cosine * f64::from(i) / 10_000.0;
                let left = rims[0].height(x).min(rims[1].height(x));
                // Distance from the plane that touches both rims from below.
                let plane = rims[0].flank(sine / cosine) + x * sine / cosine;
                highest = highest.max((left - plane) * cosine);
            }
            assert!(
                (highest - published).abs() < 5e-5,
                "{lead} {apart} {roll}: {highest}"
            );
        }
    }
}

/// Grooves 20 mm beside the lowest place of the rim free what is between them if they end less than 0.523 mm above it: at 3 deg the
/// rim has risen so far there.
#[test]
fn a_strip_is_free_if_its_grooves_end_within_the_rise_of_the_rim() {
    let centre = at(50.0, 10.0 + 1.308_399);
    for (bottom, is_free) in [(10.52, true), (10.53, false)] {
        let mut section = grooved(100.0, 14.0, 10.0, bottom);
        let outcome = section.skim(&disc(25.0), &over(centre, 3.0, 0.0));
        if is_free {
            assert_eq!(outcome.faults, []);
            let [freed] = outcome.freed.as_slice() else {
                panic!("{:?}", outcome.freed)
            };
            assert!((freed.stretch.to - 70.0).abs() < 0.1 && (freed.stretch.from - 30.0).abs() < 0.1);
        } else {
            let [
                PassFault::Attached {
                    hold: Hold::Buried { missing },
                    ..
                },
            ] = outcome.faults.as_slice()
            else {
                panic!("{:?}", outcome.faults);
            };
            assert!(missing.to_mm() > 0.0);
            assert!(outcome.freed.is_empty());
        }
    }
}

/// What runs over the hub is judged by its thickness.
#[test]
fn thick_strips_do_not_pass_over_the_hub() {
    let centre = at(50.0, 10.0 + 1.308_399);
    let limit = |over_hub: f64| {
        let mut section = grooved(100.0, 13.0, 10.0, 10.5);
        let pass = SkinPass {
            over_hub: Length::mm(over_hub),
            ..over(centre, 3.0, 0.0)
        };
        let disc = Disc {
            width: None,
            ..wheel()
        };
        section.skim(&disc, &pass).faults
    };
    assert!(
        matches!(limit(1.0).as_slice(), [PassFault::OverBody { .. }, ..]),
        "{:?}",
        limit(1.0)
    );
    assert_eq!(limit(3.5), []);
}

proptest! {
    /// Random grooves, random tracks: every place is either as it was, or on the rim that took it, and what is taken is all that
    /// stands between two places at which the rim comes out.
    #[test]
    fn a_pass_takes_what_stands_between_places_where_its_rim_comes_out(
        cuts in prop::collection::vec((0.0..100.0_f64, 5.0..25.0_f64, 0.5..3.0_f64), 3..25),
        tracks in prop::collection::vec((0.0..100.0_f64, 12.0..26.0_f64, 0.5..8.0_f64, -40.0..40.0_f64), 1..6),
    ) {
        let mut surface = Surface::flat(100.0, 26.0);
        for (x, z, slope) in cuts {
            surface.release(Vee::even(at(x, z), slope));
        }
        let mut section = CrossSection::new(surface);
        let mut rims = Vec::new();
        let xs: Vec<f64> = (0..=4000_u32).map(|i| f64::from(i) / 40.0).collect();
        for (x, z, lead, roll) in tracks {
            let before: Vec<f64> = xs.iter().map(|&x| section.surface().height(x)).collect();
            let pass = over(at(x, z), lead, roll);
            let rim = pass.rim(&disc(25.0));
            let [left, right] = rim.cover();
            section.skim(&disc(25.0), &pass);
            // By the samples alone: runs above the rim that end below it, or at a side of the stock, within the cover.
            let stands = |i: usize| (left..=right).contains(&xs[i]) && before[i] > rim.height(xs[i]);
            let mut i = 0;
            while i < xs.len() {
                if !stands(i) {
                    i += 1;
                    continue;
                }
                let start = i;
                while i < xs.len() && stands(i) {
                    i += 1;
                }
                let ends_open = |at: usize, beyond: Option<usize>| match beyond {
                    None => true,
                    Some(beyond) => (left..=right).contains(&xs[beyond]) || at == beyond,
                };
                let is_free = ends_open(start, start.checked_sub(1)) && ends_open(i - 1, Some(i).filter(|&i| i < xs.len()));
                // Runs of few samples may touch the rim between them.
                if i - start < 8 {
                    continue;
                }
                let middle = start + (i - start) / 2;
                let after = section.surface().height(xs[middle]);
                if is_free {
                    prop_assert!(after <= rim.height(xs[middle]) + 2e-3, "{} {after}", xs[middle]);
                }
            }
            rims.push(rim);
            for (i, &x) in xs.iter().enumerate() {
                let after = section.surface().height(x);
                // Floors are chords no more than a micrometre above the rim, at its ends too.
                prop_assert!(after <= before[i] + 1e-3, "{x} {after} {}", before[i]);
                // What an earlier rim has cut below material that stood may come free too.
                let over = rims.iter().filter(|rim| (rim.cover()[0]..=rim.cover()[1]).contains(&x));
                let lowest = over.map(|rim| rim.height(x)).fold(before[i], f64::min);
                prop_assert!(after >= lowest - 1e-6, "{x}");
            }
        }
    }
}
