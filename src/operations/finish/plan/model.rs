//! Steps and side tilts by formulas, for a disc of radius `R` that leans by the lead `lam` along its feed and by the side
//! tilt `gam` to a side; `T` is the whole tilt, `cos T = cos lam cos gam`.
//!
//! The plan begins with these and goes on with the exact section. Angles in rad, lengths in mm. Radii, scallops and side tilts are
//! *(derived here)*.

/// Radius of the swath where it touches the part: `R sin^2 lam / sin^3 T`.
#[must_use]
pub fn effective_radius(radius: f64, lead: f64, side: f64) -> f64 {
    let (along, tilt) = (libm::sin(lead), sine_of_tilt(lead, side));
    radius * along * along / (tilt * tilt * tilt)
}

/// `sin T`, without loss for small tilts.
fn sine_of_tilt(lead: f64, side: f64) -> f64 {
    libm::hypot(libm::sin(lead), libm::cos(lead) * libm::sin(side))
}

/// Where the disc touches, beside its centre along the part: `R cos T cos lam sin gam / sin T`.
#[must_use]
pub fn contact_beside(radius: f64, lead: f64, side: f64) -> f64 {
    let upright = libm::cos(lead) * libm::cos(lead) * libm::cos(side);
    radius * upright * libm::sin(side) / sine_of_tilt(lead, side)
}

/// The step that leaves so much on a plane, without side tilt: exact; twice the radius where no step leaves more.
#[must_use]
pub fn plane_step(radius: f64, lead: f64, scallop: f64) -> f64 {
    let up = (radius - scallop / libm::sin(lead)).max(0.0);
    2.0 * (radius * radius - up * up).max(0.0).sqrt()
}

/// The step that leaves so much to second order; infinite where swaths fit the part.
#[must_use]
pub fn step(effective: f64, curvature: f64, scallop: f64) -> f64 {
    let bend = 1.0 / effective - curvature;
    if bend > 0.0 {
        (8.0 * scallop / bend).sqrt()
    } else {
        f64::INFINITY
    }
}

/// The least side tilt with which strips keep so far from the axis, if they reach so far from the contact towards it; none up to
/// the largest one.
#[must_use]
pub fn side_past_hub(radius: f64, lead: f64, clear: f64, reach: f64) -> Option<f64> {
    let passes = |side: f64| contact_beside(radius, lead, side) - reach >= clear;
    let (mut low, mut high) = (0.0, LARGEST_SIDE);
    if !passes(high) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if passes(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

/// 30 degrees.
const LARGEST_SIDE: f64 = core::f64::consts::FRAC_PI_6;

const HALVINGS: u32 = 50;

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::units::{Angle, Length};
    use vcutc_geometry::curve::Point2;
    use vcutc_simulation::rim::Rim;

    fn rad(degrees: f64) -> f64 {
        degrees.to_radians()
    }

    #[test]
    fn radii_and_tilts_are_those_of_the_field() {
        for (lead, side, radius) in [
            (5.0, 0.0, 286.842_831),
            (5.0, 3.0, 181.287_554),
            (4.0, -8.0, 32.432_447),
        ] {
            assert!((effective_radius(25.0, rad(lead), rad(side)) - radius).abs() < 1e-6);
        }
    }

    #[test]
    fn published_heights_come_back_as_their_steps() {
        // To second order, on level, hollow and arched parts.
        for (lead, curvature, apart, height) in [
            (5.0, 0.0, 10.0, 0.043_577_87),
            (5.0, 0.0, 20.0, 0.174_311_49),
            (3.0, 0.0, 10.0, 0.026_167_98),
            (5.0, -1.0 / 300.0, 10.0, 0.085_244_54),
            (5.0, 1.0 / 300.0, 10.0, 0.001_911_20),
            (10.0, 1.0 / 300.0, 10.0, 0.045_157_42),
            (5.0, 1.0 / 400.0, 12.0, 0.017_752_13),
            (5.0, -1.0 / 600.0, 12.0, 0.092_752_13),
        ] {
            let found = step(effective_radius(25.0, rad(lead), 0.0), curvature, height);
            assert!(
                (found - apart).abs() < 2e-5,
                "{lead} {curvature} {apart}: {found}"
            );
        }
        // Exactly, on a plane.
        for (lead, apart, height) in [
            (5.0, 10.0, 0.044_022_59),
            (5.0, 20.0, 0.181_904_63),
            (3.0, 10.0, 0.026_435_03),
            (5.0, 10.649_914, 0.05),
        ] {
            let found = plane_step(25.0, rad(lead), height);
            assert!((found - apart).abs() < 2e-6, "{lead} {apart}: {found}");
        }
    }

    #[test]
    fn side_tilts_past_a_hub_are_those_of_the_field() {
        for (hub, lead, step, side, effective) in [
            (8.0, 3.0, 10.0, 2.035_999, 270.90),
            (8.0, 5.0, 10.0, 3.418_057, 161.87),
            (12.0, 3.0, 8.0, 2.799_287, f64::NAN),
        ] {
            let found = side_past_hub(25.0, rad(lead), hub + 1.0, step / 2.0).unwrap();
            assert!((found.to_degrees() - side).abs() < 1e-4, "{}", found.to_degrees());
            if effective.is_finite() {
                let radius = effective_radius(25.0, rad(lead), rad(side));
                assert!((radius - effective).abs() < 5e-3, "{radius}");
            }
        }
        assert_eq!(side_past_hub(25.0, rad(3.0), 24.9, 5.0), None);
    }

    /// The same from the ellipse that the disc shows as: where it touches a level part, and how blunt it is there.
    #[test]
    fn formulas_are_those_of_the_ellipse() {
        for (lead, side) in [(3.0, 2.035_999), (5.0, 3.418_057), (4.0, 8.0), (12.0, 0.5)] {
            let centre = Point2::new(0.0, 0.0);
            let rim = Rim::rolled(centre, Length::mm(25.0), Angle::deg(lead), Angle::deg(-side));
            let beside = contact_beside(25.0, rad(lead), rad(side));
            assert!((rim.touching(0.0).x - beside).abs() < 1e-9, "{beside}");
            let effective = effective_radius(25.0, rad(lead), rad(side));
            assert!((rim.curvature_radius(0.0) / effective - 1.0).abs() < 1e-9);
        }
    }

    /// On the side of the strip it rises by 0.694951 mm at 3 deg and by 1.157552 mm at 5 deg, 10.984 mm beside the contact.
    #[test]
    fn side_tilt_lowers_the_rim_on_the_side_of_the_strip() {
        for (lead, side, rise, beside) in [
            (3.0, 2.035_999, 0.694_951, 10.984),
            (5.0, 3.418_057, 1.157_552, 10.956),
        ] {
            let centre = Point2::new(0.0, 0.0);
            let rim = Rim::rolled(centre, Length::mm(25.0), Angle::deg(lead), Angle::deg(-side));
            let [_, end] = rim.cover();
            assert!((rim.height(end) - rim.lowest().z - rise).abs() < 1e-6);
            assert!((end - rim.lowest().x - beside).abs() < 5e-4);
        }
    }
}
