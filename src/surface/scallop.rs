//! What discs leave between their tracks, and how far apart tracks may be.
//!
//! A disc that leads only sweeps an ellipse of half axes R and `R sin(lead)`, with its lowest point at the contact. Two of them
//! side by side on a part that is a circle across the feed meet over the middle between them, by symmetry; what stands there
//! above the part is exact. For other postures and parts the parabolas of both give it to second order:
//! `ae^2/8 (1/rho - k)`, with the radius rho of what is swept and the part's curvature k across the feed, positive where the
//! part is hollow.

use crate::posture::Lean;
use vcutc_backend_api::units::{Angle, Length};

/// Steps of the search for a step: enough for all digits.
const HALVINGS: u32 = 60;

/// Curvatures below this, in 1/mm, are those of a plane.
const FLAT: f64 = 1e-12;

/// What stands between two tracks of a disc that leads only, on a part with this curvature across the feed, in 1/mm, with tracks
/// so far apart along the part. None where the two swaths do not meet, or would meet beyond the rims.
#[must_use]
pub fn scallop(radius: Length, lead: Angle, curvature: f64, step: Length) -> Option<Length> {
    let (r, step, rise) = (radius.to_mm(), step.to_mm(), lead.sin());
    if !(r > 0.0 && step >= 0.0 && rise > 0.0 && curvature.is_finite()) {
        return None;
    }
    if curvature.abs() < FLAT {
        let rest = r * r - step * step / 4.0;
        return (rest >= 0.0).then(|| Length::mm(rise * (r - rest.sqrt())));
    }
    // From the middle of the circle, negative for a trough: the contact at `part` along the normal, `half` beside the middle.
    let part = -1.0 / curvature;
    let (sine, cosine) = libm::sincos(step / (2.0 * part));
    if step > core::f64::consts::PI * part.abs() {
        return None;
    }
    // The line through the middle at `m = part + h`: `(m sine)^2 + ((m cosine - part)/rise - R)^2 = R^2`, for h, so that
    // nothing cancels: a h^2 + 2 b h + c = 0.
    let sine_of_half = libm::sin(step / (4.0 * part));
    let low = -2.0 * part * sine_of_half * sine_of_half / rise;
    let a = sine * sine + cosine * cosine / (rise * rise);
    let b = part * sine * sine + cosine / rise * (low - r);
    let c = part * part * sine * sine + low * (low - 2.0 * r);
    let root = b * b - a * c;
    // The lower branch of the ellipse: the root nearer to 0, which is real while the rims reach the middle.
    if root < 0.0 {
        return None;
    }
    let below = -b + root.sqrt();
    (below > 0.0).then(|| Length::mm(c / below))
}

/// What stands between two tracks, to second order. Below 0 where the swath gouges beside its contact. None without a swath that
/// is curved, see [`Lean::swept_radius`].
#[must_use]
pub fn second_order(radius: Length, lean: Lean, curvature: f64, step: Length) -> Option<Length> {
    let swept = lean.swept_radius(radius)?.to_mm();
    let step = step.to_mm();
    Some(Length::mm(step * step / 8.0 * (1.0 / swept - curvature)))
}

/// What a disc that leans in no direction leaves on a ridge of this radius: facets.
#[must_use]
pub fn facets(ridge: Length, step: Length) -> Length {
    let r = ridge.to_mm();
    // r (1/cos(h) - 1) without cancelling.
    let half = step.to_mm() / (2.0 * r);
    let sine = libm::sin(half / 2.0);
    Length::mm(r * 2.0 * sine * sine / libm::cos(half))
}

/// The widest step, along the part, that leaves no more than this between tracks of a disc that leads only, up to the radius of the
/// disc. None for a disc without lead, or a limit that is not above 0.
#[must_use]
pub fn widest_step(radius: Length, lead: Angle, curvature: f64, limit: Length) -> Option<Length> {
    let fits = |step: f64| {
        let left = scallop(radius, lead, curvature, Length::mm(step));
        left.is_some_and(|left| left.to_mm() <= limit.to_mm())
    };
    if limit.to_mm() <= 0.0 || !fits(0.0) {
        return None;
    }
    let (mut least, mut most) = (0.0, radius.to_mm());
    if fits(most) {
        return Some(radius);
    }
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(least, most);
        if fits(middle) {
            least = middle;
        } else {
            most = middle;
        }
    }
    Some(Length::mm(least))
}

/// How many tracks of a step cover an extent across them: the least number. In whole micrometres, so that steps that divide
/// the extent do. None for a step below a micrometre or a number of tracks beyond a million.
#[must_use]
pub fn tracks(extent: Length, step: Length) -> Option<u32> {
    count(extent, step, |extent, step| extent.div_ceil(step))
}

/// How many tracks [Yang 1] counts, from the first place at which the disc's side engages by a step:
/// `[(Ls + Ds/2 - ae)/ae] + 1`, rounded down, in whole micrometres.
#[must_use]
pub fn tracks_from_first_engagement(extent: Length, radius: Length, step: Length) -> Option<u32> {
    count(extent + radius, step, |extent, step| extent / step)
}

/// More tracks than these are a mistake.
const MOST_TRACKS: u64 = 1_000_000;

fn count(extent: Length, step: Length, divide: fn(u64, u64) -> u64) -> Option<u32> {
    let micrometres = |length: Length| {
        let whole = (length.to_mm() * 1000.0).round();
        // Below 2^53 all whole numbers are there; NaN is in no range.
        (0.0..=9e15).contains(&whole).then_some(whole as u64)
    };
    let (extent, step) = (micrometres(extent)?, micrometres(step).filter(|&step| step > 0)?);
    let count = divide(extent, step);
    u32::try_from(count).ok().filter(|_| count <= MOST_TRACKS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const R: Length = Length::mm(25.0);

    fn assert_near(value: Option<Length>, expected: f64, within: f64) {
        let value = value.unwrap().to_mm();
        assert!((value - expected).abs() <= within, "{value} for {expected}");
    }

    #[test]
    fn known_scallops() {
        for (lead, curvature, step, exact, second) in [
            (5.0, 0.0, 10.0, 0.04402259, 0.04357787),
            (5.0, 0.0, 20.0, 0.18190463, 0.17431149),
            (3.0, 0.0, 10.0, 0.02643503, 0.02616798),
            (5.0, -1.0 / 300.0, 10.0, 0.08572150, 0.08524454),
            (5.0, 1.0 / 300.0, 10.0, 0.00235240, 0.00191120),
            (10.0, 1.0 / 300.0, 10.0, 0.04601545, 0.04515742),
            (5.0, 1.0 / 400.0, 12.0, 0.01867483, 0.01775213),
            (5.0, -1.0 / 600.0, 12.0, 0.09370524, 0.09275213),
        ] {
            let (angle, width) = (Angle::deg(lead), Length::mm(step));
            assert_near(scallop(R, angle, curvature, width), exact, 1e-8);
            let lean = Lean {
                lead: angle,
                side: Angle::ZERO,
            };
            assert_near(second_order(R, lean, curvature, width), second, 1e-8);
        }
        assert_near(
            Some(facets(Length::mm(300.0), Length::mm(10.0))),
            0.04167149,
            1e-8,
        );
        // Strips past the hub.
        let lean = Lean {
            lead: Angle::deg(3.0),
            side: Angle::deg(2.035999),
        };
        assert_near(second_order(R, lean, 0.0, Length::mm(10.0)), 0.046142, 1e-6);
    }

    #[test]
    fn parts_that_are_nearly_flat_are_like_flat_ones() {
        let at = |curvature| {
            scallop(R, Angle::deg(5.0), curvature, Length::mm(10.0))
                .unwrap()
                .to_mm()
        };
        for power in 6..12 {
            let curvature = libm::pow(10.0, -f64::from(power));
            let expected = at(0.0) - curvature * 12.5;
            assert!(
                (at(curvature) - expected).abs() < 0.01 * curvature + 1e-13,
                "{curvature}"
            );
        }
    }

    #[test]
    fn known_steps() {
        let step = |curvature, limit| widest_step(R, Angle::deg(5.0), curvature, Length::mm(limit));
        assert_near(step(0.0, 0.05), 10.649914, 1e-6);
        assert_near(step(1.0 / 400.0, 0.05), 18.9034, 1e-4);
        assert_near(step(-1.0 / 400.0, 0.05), 8.1576, 1e-4);
        // On a dome of 3 m: to second order, and exactly somewhat less.
        let lean = Lean {
            lead: Angle::deg(5.0),
            side: Angle::ZERO,
        };
        for (limit, width, count) in [(0.1, 14.4723, 105), (0.02, 6.4722, 235)] {
            let width = Length::mm(width);
            assert_near(second_order(R, lean, -1.0 / 3000.0, width), limit, 2e-6);
            assert_eq!(
                tracks_from_first_engagement(Length::mm(1500.0), R, width),
                Some(count)
            );
            let exact = step(-1.0 / 3000.0, limit).unwrap();
            assert!(exact < width && exact > width * 0.99, "{exact:?}");
        }
        assert_eq!(step(0.0, 0.0), None);
        assert_eq!(step(0.0, 100.0), Some(R));
        assert_eq!(widest_step(R, Angle::ZERO, 0.0, Length::mm(0.1)), None);
    }

    #[test]
    fn tracks_are_counted_in_whole_micrometres() {
        let mm = Length::mm;
        assert_eq!(tracks_from_first_engagement(mm(0.3), mm(0.05), mm(0.05)), Some(7));
        assert_eq!(
            tracks_from_first_engagement(mm(100.0), mm(25.0), mm(40.0)),
            Some(3)
        );
        assert_eq!(tracks(mm(100.0), mm(40.0)), Some(3));
        assert_eq!(tracks(mm(0.3), mm(0.05)), Some(6));
        for bad in [0.0, -1.0, f64::NAN, 1e-4] {
            assert_eq!(tracks(mm(100.0), mm(bad)), None);
        }
        assert_eq!(tracks(mm(f64::INFINITY), mm(1.0)), None);
        assert_eq!(tracks(mm(1e6), mm(0.001)), None);
    }

    proptest! {
        /// The place where the sampled rims of two discs come nearest to the line between them, seen along the feed.
        #[test]
        fn rims_meet_where_the_closed_form_says(lead in 2.0..15.0f64, curvature in -0.01..0.004f64, step in 1.0..15.0f64) {
            let lead = Angle::deg(lead);
            let found = scallop(R, lead, curvature, Length::mm(step)).unwrap().to_mm();
            // Contact on the part, its normal, and the rim about the centre above it.
            let half = step / 2.0;
            let (w, z, turn) = if curvature == 0.0 {
                (half, 0.0, 0.0)
            } else {
                let angle = half * curvature;
                (libm::sin(angle) / curvature, (1.0 - libm::cos(angle)) / curvature, angle)
            };
            // Points of the rim to the left of the contact; the part rises by `turn` there.
            let (sine, cosine) = libm::sincos(turn);
            let rim = |phi: f64| {
                let (across, up) = (-25.0 * libm::sin(phi), 25.0 * lead.sin() * (1.0 - libm::cos(phi)));
                [w + across * cosine - up * sine, z + across * sine + up * cosine]
            };
            let (mut low, mut high) = (0.0, core::f64::consts::FRAC_PI_2);
            for _ in 0..100 {
                let middle = f64::midpoint(low, high);
                if rim(middle)[0] > 0.0 { low = middle } else { high = middle }
            }
            prop_assert!((rim(low)[1] - found).abs() < 1e-9, "{} {found}", rim(low)[1]);
        }
    }
}
