//! The Hankel function of the second kind and order 0: the field of an endless line source.

use crate::complex::Complex;
use crate::fresnel::{polynomial, polynomial_with_slope};
use core::f64::consts::PI;

/// The least argument of the polynomials.
pub(crate) const LEAST: f64 = 0.05;

/// Makes the variable of the polynomials run from 1 at [`LEAST`] to -1 at infinity.
pub(crate) const MIDDLE: f64 = 0.3;

/// Real parts of the coefficients, see [`envelope`].
pub(crate) const REAL: [f64; 15] = [
    4.102032345989e-1,
    -1.733277558842e-1,
    -1.382277956608e-2,
    -8.772518879594e-3,
    -8.248983677276e-3,
    -2.282388850927e-4,
    -3.417051338404e-3,
    2.557841234163e-3,
    -2.207817981705e-3,
    -4.464676484484e-3,
    1.354490883943e-3,
    5.182877786524e-3,
    -2.301661414094e-3,
    -2.508456302701e-3,
    1.069226314129e-3,
];

/// Imaginary parts of the coefficients.
pub(crate) const IMAGINARY: [f64; 15] = [
    5.895638378053e-1,
    -4.302677714878e-2,
    -6.133824608886e-2,
    -4.786403109087e-3,
    -1.446902733103e-2,
    -3.139738656902e-3,
    -4.333993427543e-3,
    -2.221962770030e-3,
    1.366744981724e-3,
    -1.099661076571e-3,
    -5.127919424886e-3,
    -2.698149992801e-4,
    5.052105562754e-3,
    -9.490434499281e-4,
    -2.016990654804e-3,
];

/// The variable of the polynomials.
#[inline(always)]
pub(crate) fn variable(a: f64) -> f64 {
    2.0 * (LEAST + MIDDLE) / (a + MIDDLE) - 1.0
}

/// `H0(a) exp(i a) sqrt(a)` for `a > 0`: what changes slowly in it; from 0.05 on within 5e-7.
///
/// It tends to `sqrt(2/pi) exp(i pi/4)` and is smooth in `1 / (a + 0.3)`: Chebyshev's interpolation of degree 14.
#[must_use]
pub fn envelope(a: f64) -> Complex {
    if a < LEAST {
        let value = Complex::new(libm::j0(a), -libm::y0(a));
        return value * Complex::turn(a).times(a.sqrt());
    }
    let variable = variable(a);
    Complex::new(polynomial(&REAL, variable), polynomial(&IMAGINARY, variable))
}

/// `H0(a)` for `a > 0`, within 5e-7 of its magnitude `sqrt(2 / (pi a))`, exact below 0.05.
#[must_use]
pub fn hankel(a: f64) -> Complex {
    envelope(a) * Complex::turn(-a).times(1.0 / a.sqrt())
}

/// The envelope and its derivative, from 0.05 on within 1e-4 of it.
#[must_use]
pub fn envelope_with_slope(a: f64) -> (Complex, Complex) {
    if a < LEAST {
        // (H0 exp(i a) sqrt(a))' = exp(i a) sqrt(a) (-H1 + i H0 + H0 / 2 a).
        let value = Complex::new(libm::j0(a), -libm::y0(a));
        let slope = Complex::new(-libm::j1(a), libm::y1(a)) + value * Complex::new(0.5 / a, 1.0);
        let turn = Complex::turn(a).times(a.sqrt());
        return (turn * value, turn * slope);
    }
    let variable = variable(a);
    let (re, re_slope) = polynomial_with_slope(&REAL, variable);
    let (im, im_slope) = polynomial_with_slope(&IMAGINARY, variable);
    let rate = -2.0 * (LEAST + MIDDLE) / ((a + MIDDLE) * (a + MIDDLE));
    (Complex::new(re, im), Complex::new(re_slope, im_slope).times(rate))
}

/// `H0(a)` far away: `sqrt(2 / (pi a)) exp(-i (a - pi/4))`.
#[must_use]
pub fn far(a: f64) -> Complex {
    Complex::turn(PI / 4.0 - a).times((2.0 / (PI * a)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_libm() {
        for step in 1..20_000 {
            let a = 1e-3 * f64::from(step) * (1.0 + 1e-3 * f64::from(step));
            let exact = Complex::new(libm::j0(a), -libm::y0(a));
            let off = (hankel(a) - exact).magnitude() * a.sqrt();
            assert!(off < 5e-7, "{a}: {off}");
        }
    }

    #[test]
    fn its_slope_is_that_of_its_values() {
        for step in 1..4000 {
            let a = 0.01 * f64::from(step);
            let (_, slope) = envelope_with_slope(a);
            let (bessel, turn) = (Complex::new(libm::j0(a), -libm::y0(a)), Complex::turn(a));
            let exact = Complex::new(-libm::j1(a), libm::y1(a)) + bessel * Complex::new(0.5 / a, 1.0);
            let off = (slope - turn * exact.times(a.sqrt())).magnitude();
            assert!(off < 1e-4 / a.min(1.0), "{a}: {off}");
        }
    }

    /// At distances of 1 to 16 mm and a wave of 8 mm the exact field is so far from the one far away.
    #[test]
    fn lines_near_the_source_are_shifted() {
        let k = PI / 4.0;
        for (y, shift) in [
            (1.0, 0.1506),
            (2.0, 0.0894),
            (4.0, 0.0485),
            (8.0, 0.0250),
            (16.0, 0.0126),
        ] {
            let turned = (hankel(k * y) * far(k * y).conjugate()).angle();
            assert!((turned / k - shift).abs() < 5.1e-5, "{y}: {}", turned / k);
            let approximation = 1.0 / (8.0 * k * k * y);
            assert!(y < 4.0 || (approximation / shift - 1.0).abs() < 0.05);
        }
    }
}
