//! Curvatures of smooth surfaces at a point.
//!
//! A curvature is positive where the part is hollow: the normal points out of the part, upwards. For parametric surfaces
//! `S(u, v)` the sign of the normal depends on the order of the parameters, so it is always turned upwards.
//!
//! [Yang 4 to 8] give normal curvatures, principal curvatures, Gaussian and mean curvature by both fundamental forms. The
//! roots of [Yang 5, 6] cancel where both principal curvatures are nearly equal. Here the second form is written in
//! two directions of length 1 that are square to each other, so that its eigenvalues are right everywhere.

use vcutc_backend_api::vector::{cross, dot};

/// The curvatures of a surface at a point, in 1/mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    normal: [f64; 3],
    /// Two tangents of length 1, square to each other.
    tangents: [[f64; 3]; 2],
    /// The second form in them: `[first, mixed, second]`.
    form: [f64; 3],
}

/// The derivatives of a parametric surface at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// By u.
    pub u: [f64; 3],
    /// By v.
    pub v: [f64; 3],
    /// By u twice.
    pub uu: [f64; 3],
    /// By both.
    pub uv: [f64; 3],
    /// By v twice.
    pub vv: [f64; 3],
}

/// A pair of vectors along the surface spans an area if that is at least this part of the product of their lengths.
const LEAST_SINE: f64 = 1e-9;

impl Curvature {
    /// Of a parametric surface. None where its tangent plane is not defined or stands upright.
    #[must_use]
    pub fn of(derivatives: &Derivatives) -> Option<Self> {
        let Derivatives { u, v, uu, uv, vv } = *derivatives;
        let along = dot(u, u).sqrt();
        let area = cross(u, v);
        let size = dot(area, area).sqrt();
        // Comparisons with NaN are false.
        let is_regular = along > 0.0 && size > LEAST_SINE * along * dot(v, v).sqrt();
        if !is_regular || area[2].abs() <= LEAST_SINE * size {
            return None;
        }
        let normal = area.map(|part| part / size * area[2].signum());
        let first = u.map(|part| part / along);
        let second = cross(normal, first);
        let [e, f, g] = [uu, uv, vv].map(|derivative| dot(derivative, normal));
        // u = along first; v = skew first + width second.
        let (skew, width) = (dot(v, first), dot(v, second));
        let a = e / (along * along);
        let b = (f / along - a * skew) / width;
        let c = (g - 2.0 * b * skew * width - a * skew * skew) / (width * width);
        let form = [a, b, c];
        form.iter().all(|part| part.is_finite()).then_some(Self {
            normal,
            tangents: [first, second],
            form,
        })
    }

    /// Of a surface `z(x, y)` by its derivatives: `[zx, zy]` and `[zxx, zxy, zyy]`.
    #[must_use]
    pub fn of_height(slope: [f64; 2], second: [f64; 3]) -> Option<Self> {
        Self::of(&Derivatives {
            u: [1.0, 0.0, slope[0]],
            v: [0.0, 1.0, slope[1]],
            uu: [0.0, 0.0, second[0]],
            uv: [0.0, 0.0, second[1]],
            vv: [0.0, 0.0, second[2]],
        })
    }

    /// The normal of length 1, upwards.
    #[must_use]
    pub const fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// The mean curvature, [Yang 8].
    #[must_use]
    pub const fn mean(&self) -> f64 {
        f64::midpoint(self.form[0], self.form[2])
    }

    /// The Gaussian curvature, [Yang 7].
    #[must_use]
    pub const fn gaussian(&self) -> f64 {
        self.form[0] * self.form[2] - self.form[1] * self.form[1]
    }

    /// The greatest and the least normal curvature, [Yang 5, 6].
    #[must_use]
    pub fn principal(&self) -> [f64; 2] {
        let half = libm::hypot((self.form[0] - self.form[2]) / 2.0, self.form[1]);
        [self.mean() + half, self.mean() - half]
    }

    /// The second form along a direction and square to it (to its left, seen from outside): `[along, twist, across]`. Of the
    /// direction only its part in the tangent plane counts. None if it has none.
    ///
    /// The normal curvature of [Yang 4] is the first of them.
    #[must_use]
    pub fn in_direction(&self, direction: [f64; 3]) -> Option<[f64; 3]> {
        let [s, t] = self.tangents.map(|tangent| dot(direction, tangent));
        let length = libm::hypot(s, t);
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let (s, t) = (s / length, t / length);
        let [a, b, c] = self.form;
        Some([
            a * s * s + 2.0 * b * s * t + c * t * t,
            (c - a) * s * t + b * (s * s - t * t),
            a * t * t - 2.0 * b * s * t + c * s * s,
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn saddle(x: f64, y: f64) -> Curvature {
        Curvature::of_height([x / 400.0, -y / 600.0], [1.0 / 400.0, 0.0, -1.0 / 600.0]).unwrap()
    }

    #[test]
    fn known_surfaces() {
        let [most, least] = saddle(100.0, 50.0).principal();
        assert!((most - 2.275806881e-3).abs() < 1e-12 && (least + 1.600799333e-3).abs() < 1e-12);
        let hypar = Curvature::of_height([90.0 / 300.0, 60.0 / 300.0], [0.0, 1.0 / 300.0, 0.0]).unwrap();
        assert!((hypar.principal()[0] - 2.788048382e-3).abs() < 1e-12);
        assert!((hypar.mean() + 1.664992687e-4).abs() < 1e-13);
    }

    #[test]
    fn a_sphere_is_curved_alike_everywhere() {
        // Below its equator it is a bowl.
        for (a, b) in [(0.1, 0.2), (1.0, 0.4), (2.0, 1.2), (4.0, 0.05)] {
            let ((sa, ca), (sb, cb)) = (libm::sincos(a), libm::sincos(b));
            let r = 500.0;
            // S = r (sin b cos a, sin b sin a, -cos b)
            let derivatives = Derivatives {
                u: [-r * sb * sa, r * sb * ca, 0.0],
                v: [r * cb * ca, r * cb * sa, r * sb],
                uu: [-r * sb * ca, -r * sb * sa, 0.0],
                uv: [-r * cb * sa, r * cb * ca, 0.0],
                vv: [-r * sb * ca, -r * sb * sa, r * cb],
            };
            let [most, least] = Curvature::of(&derivatives).unwrap().principal();
            assert!(
                (most - 2e-3).abs() < 1e-16 && (least - 2e-3).abs() < 1e-16,
                "{most} {least}"
            );
        }
        assert_eq!(Curvature::of_height([f64::NAN, 0.0], [0.0; 3]), None);
        assert_eq!(Curvature::of_height([0.0; 2], [f64::INFINITY, 0.0, 0.0]), None);
    }

    proptest! {
        /// Exchanging the parameters changes nothing, and the curvature along a direction is that of a curve on the surface.
        #[test]
        fn curves_on_a_surface_bend_as_it_does(
            slope in prop::array::uniform2(-1.0..1.0f64), second in prop::array::uniform3(-0.01..0.01f64), turn in 0.0..6.3f64,
        ) {
            let here = Curvature::of_height(slope, second).unwrap();
            let swapped = Curvature::of(&Derivatives {
                u: [0.0, 1.0, slope[1]],
                v: [1.0, 0.0, slope[0]],
                uu: [0.0, 0.0, second[2]],
                uv: [0.0, 0.0, second[1]],
                vv: [0.0, 0.0, second[0]],
            })
            .unwrap();
            for (a, b) in here.principal().iter().zip(swapped.principal()) {
                prop_assert!((a - b).abs() < 1e-15);
            }
            let (sine, cosine) = libm::sincos(turn);
            let height = |x: f64, y: f64| {
                slope[0] * x + slope[1] * y + second[0] * x * x / 2.0 + second[1] * x * y + second[2] * y * y / 2.0
            };
            // The circle of curvature by three points of the surface over a line, tilted to the normal by Meusnier's theorem.
            let step = 1e-3;
            let point = |t: f64| [t * cosine, t * sine, height(t * cosine, t * sine)];
            let [p, q] = [point(-step), point(step)];
            let velocity: [f64; 3] = core::array::from_fn(|i| (q[i] - p[i]) / (2.0 * step));
            let bend: [f64; 3] = core::array::from_fn(|i| (q[i] + p[i]) / (step * step));
            let expected = dot(bend, here.normal()) / dot(velocity, velocity);
            let [along, _, across] = here.in_direction(velocity.map(|part| part * 7.0)).unwrap();
            prop_assert!((along - expected).abs() < 1e-7, "{along} {expected}");
            prop_assert!(((along + across) / 2.0 - here.mean()).abs() < 1e-15);
        }
    }
}
