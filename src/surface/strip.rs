//! The strips that a disc lifts off: where they come free, and how they pass the hub.
//!
//! A disc that leads only sweeps an ellipse of half axes R and `R sin(lead)` across the feed. It has risen by h at
//! `R sqrt(1 - (1 - h/(R sin(lead)))^2)` beside the contact. The strip above it is free where the rim comes out of the material: at the
//! bottom of a groove that roughing has left h above the part, at that distance or farther.
//!
//! With lead alone the contact lies in front of the centre, and all that is lifted runs at the hub. A side tilt puts it
//! `R cos(T) sin(azimuth)` beside the centre.

use crate::posture::Lean;
use vcutc_backend_api::units::{Angle, Length};

/// The least distance beside the contact at which grooves that end so high above the part free a strip. None if the rim does not rise
/// so high: grooves may end `R sin(lead)` above the part at most.
#[must_use]
pub fn free_from(radius: Length, lead: Angle, height: Length) -> Option<Length> {
    let rise = radius.to_mm() * lead.sin();
    let share = height.to_mm() / rise;
    // Comparisons with NaN are false.
    (rise > 0.0 && (0.0..=1.0).contains(&share)).then(|| radius * (share * (2.0 - share)).sqrt())
}

/// How high above the part grooves may end so that strips come free wherever the tracks lie between them. None of grooves farther apart
/// than the radius.
#[must_use]
pub fn highest_grooves(radius: Length, lead: Angle, spacing: Length) -> Option<Length> {
    // One of them lies within the outermost spacing of the rim on either side.
    let out = 1.0 - spacing.to_mm() / radius.to_mm();
    (0.0..=1.0)
        .contains(&out)
        .then(|| radius * (lead.sin() * (1.0 - (1.0 - out * out).sqrt())))
}

/// The least side tilt, to the left, that puts the contact so far beside the centre. None if none does.
#[must_use]
pub fn side_for(radius: Length, lead: Angle, beside: Length) -> Option<Angle> {
    // With x = sin^2(side) and c = cos^2(lead), k = (beside/R)^2: c^2 x^2 - c (c - k) x + k (1 - c) = 0.
    let share = beside.to_mm() / radius.to_mm();
    let cosine = lead.cos();
    let (c, k) = (cosine * cosine, share * share);
    let half = c * (c - k);
    let root = half * half - 4.0 * c * c * k * (1.0 - c);
    // Comparisons with NaN are false.
    if !(share >= 0.0 && half > 0.0 && root >= 0.0) {
        return None;
    }
    let x = 2.0 * k * (1.0 - c) / (half + root.sqrt());
    let side = Angle::rad(libm::asin(x.min(1.0).sqrt()));
    let lean = Lean { lead, side };
    (lean.tilt().to_rad() < core::f64::consts::FRAC_PI_2).then_some(side)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const R: Length = Length::mm(25.0);

    #[test]
    fn strips_come_free_at_grooves() {
        let five = Angle::deg(5.0);
        for (height, expected) in [(0.5, 15.9352), (1.0, 21.0247), (2.0, 24.9156)] {
            let from = free_from(R, five, Length::mm(height)).unwrap().to_mm();
            assert!((from - expected).abs() < 5e-5, "{from}");
        }
        assert_eq!(free_from(R, five, Length::mm(2.2)), None);
        assert_eq!(free_from(R, Angle::ZERO, Length::mm(0.1)), None);
        let highest = highest_grooves(R, five, Length::mm(8.0)).unwrap();
        assert!((highest.to_mm() - 0.581302).abs() < 1e-6, "{highest:?}");
        // A strip frees at the inner end of the outermost spacing then.
        let from = free_from(R, five, highest).unwrap();
        assert!((from.to_mm() - 17.0).abs() < 1e-9);
        assert_eq!(highest_grooves(R, five, Length::mm(26.0)), None);
    }

    #[test]
    fn strips_pass_the_hub() {
        for (lead, beside, expected) in [
            (3.0, 14.0, 2.035999),
            (5.0, 14.0, 3.418057),
            (3.0, 17.0, 2.799287),
        ] {
            let side = side_for(R, Angle::deg(lead), Length::mm(beside)).unwrap();
            assert!((side.to_deg() - expected).abs() < 1e-6, "{side:?}");
        }
        assert_eq!(side_for(R, Angle::deg(5.0), Length::mm(25.0)), None);
        assert_eq!(side_for(R, Angle::deg(5.0), Length::mm(f64::NAN)), None);
    }

    proptest! {
        #[test]
        fn the_contact_is_where_it_was_wished(lead in 0.5..15.0f64, share in 0.0..0.7f64) {
            let lead = Angle::deg(lead);
            let side = side_for(R, lead, R * share).unwrap();
            let beside = Lean { lead, side }.beside(R);
            prop_assert!((beside - R * share).to_mm().abs() < 1e-9);
        }
    }
}
