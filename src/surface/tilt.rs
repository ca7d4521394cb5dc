//! The least tilt at which a disc clears a part, by the part's curvature.
//!
//! A disc at a total tilt T is, at every azimuth, a plane section of the ball of radius `R/sin T` that touches the tangent plane
//! at the contact. So if no normal curvature along the surface under the disc is above `sin T/R`, the ball, and with it the
//! disc, stays clear: for `F = |X - O|^2/2` along a geodesic from the contact, with O the middle of the ball, `F' = 0` there
//! and `F'' = 1 + k (X - O).n >= 0`. [Yang 9, 10] is that with the curvature at the contact alone, which proves nothing about
//! the rest of the disc, up to 2R behind. With the greatest curvature under the disc it is a proof.
//!
//! On a paraboloid with the second form `II` in the axes of the contact's azimuth and square to it, the disc is clear exactly
//! when `sin T >= R lmax(D II D)`, with `D = diag(cos T, 1)`: seen along the disc's own axis, the rim is a circle there. It
//! never asks for more than [Yang 10].

use crate::curvature::Curvature;
use crate::posture::{Contact, Lean};
use vcutc_backend_api::units::{Angle, Length};

/// Halvings of a quarter turn: to the last digit.
const HALVINGS: u32 = 60;

/// The least tilt for a greatest normal curvature, in 1/mm: [Yang 10], for all classes of surfaces. It is 0 where nothing is hollow.
/// None where the part is hollow with a radius below that of the disc.
///
/// It is proof of a posture if the curvature is the greatest of the surface under the disc.
#[must_use]
pub fn by_greatest_curvature(radius: Length, curvature: f64) -> Option<Angle> {
    let sine = radius.to_mm() * curvature;
    // Comparisons with NaN are false.
    (sine <= 1.0).then(|| Angle::rad(libm::asin(sine.max(0.0))))
}

/// The least tilt, of a disc whose contact lies at an azimuth, for the paraboloid of the second form at the contact: along that
/// azimuth, twist, and square to it, in 1/mm. None if no tilt clears it.
#[must_use]
pub fn on_paraboloid(radius: Length, [along, twist, across]: [f64; 3]) -> Option<Angle> {
    let r = radius.to_mm();
    // The right side does not grow with the tilt: what `D` shrinks counts less.
    let is_clear = |tilt: f64| {
        let (sine, cosine) = libm::sincos(tilt);
        let [a, b, c] = [along * cosine * cosine, twist * cosine, across];
        let largest = f64::midpoint(a, c) + libm::hypot((a - c) / 2.0, b);
        sine >= r * largest
    };
    if is_clear(0.0) {
        return Some(Angle::ZERO);
    }
    let (mut low, mut high) = (0.0, core::f64::consts::FRAC_PI_2);
    if !is_clear(high) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if is_clear(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(Angle::rad(high))
}

/// The least lead, without side tilt, for the paraboloid of a surface at a contact. None if no lead clears it.
#[must_use]
pub fn least_lead(radius: Length, contact: &Contact, curvature: &Curvature) -> Option<Angle> {
    on_paraboloid(radius, curvature.in_direction(contact.feed())?)
}

/// Whether a posture clears the paraboloid of a surface at its contact. None if the surface has no direction there.
#[must_use]
pub fn clears(radius: Length, contact: &Contact, curvature: &Curvature, lean: Lean) -> Option<bool> {
    let (sine, cosine) = libm::sincos(lean.azimuth().to_rad());
    let (feed, left) = (contact.feed(), contact.left());
    let azimuth = core::array::from_fn(|i| cosine * feed[i] + sine * left[i]);
    let least = on_paraboloid(radius, curvature.in_direction(azimuth)?);
    Some(least.is_some_and(|least| lean.tilt().to_rad() >= least.to_rad()))
}

#[cfg(test)]
mod tests;
