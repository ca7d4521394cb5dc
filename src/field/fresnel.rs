//! The Fresnel integral of `exp(-i v^2)`.

use crate::complex::Complex;
use core::f64::consts::PI;

/// The argument at which the variable of the polynomials is in the middle of its range.
pub(crate) const MIDDLE: f64 = 2.0;

/// Real parts of the coefficients, see [`rest`].
pub(crate) const REAL: [f64; 15] = [
    5.364473151966e-2,
    2.200622103374e-1,
    3.660845080538e-1,
    2.428037625263e-1,
    -1.189397481047e-1,
    -2.787389247359e-1,
    -2.104890120802e-3,
    2.259855670493e-1,
    2.779310022734e-2,
    -1.495032730769e-1,
    -1.824370441616e-2,
    6.662614734892e-2,
    5.837607926943e-3,
    -1.390738237990e-2,
    -7.426434975475e-4,
];

/// Imaginary parts of the coefficients.
pub(crate) const IMAGINARY: [f64; 15] = [
    -4.828937407243e-1,
    -3.754140215241e-1,
    -9.750363021116e-2,
    2.352698859506e-1,
    2.851431613619e-1,
    -4.146594785213e-2,
    -2.647325371983e-1,
    -2.288202259490e-2,
    2.158072328804e-1,
    2.546830338487e-2,
    -1.465892135888e-1,
    -1.151306419901e-2,
    6.641548167253e-2,
    2.208364566051e-3,
    -1.397532058138e-2,
];

/// The integral of `exp(-i v^2)` over all numbers: `sqrt(pi) exp(-i pi/4)`.
#[must_use]
pub fn whole() -> Complex {
    let part = (PI / 2.0).sqrt();
    Complex::new(part, -part)
}

/// The integral of `exp(-i v^2)` from `u` to infinity, times `exp(i u^2)`, for `u >= 0`; within 1.2e-6.
///
/// Times `u + 2` it has no poles or oscillations and tends to `1 / 2i`, so a polynomial in `2 / (u + 2)` gives it:
/// Chebyshev's interpolation of `sqrt(pi)/2 exp(-i pi/4) erfcx(exp(i pi/4) u)`, exact at 0 so that [`fresnel`] does not
/// jump there.
#[must_use]
pub fn rest(u: f64) -> Complex {
    let share = MIDDLE / (u + MIDDLE);
    let variable = 2.0 * share - 1.0;
    Complex::new(polynomial(&REAL, variable), polynomial(&IMAGINARY, variable)).times(share)
}

/// The integral of `exp(-i v^2)` from 0 to `u`; within 1.2e-6.
#[must_use]
pub fn fresnel(u: f64) -> Complex {
    let magnitude = whole().times(0.5) - Complex::turn(-u * u) * rest(u.abs());
    if u < 0.0 { -magnitude } else { magnitude }
}

/// By Horner's rule, the lowest coefficient first.
#[inline(always)]
pub(crate) fn polynomial<const N: usize>(coefficients: &[f64; N], variable: f64) -> f64 {
    let mut sum = 0.0;
    for coefficient in coefficients.iter().rev() {
        sum = sum * variable + coefficient;
    }
    sum
}

/// The same, and its derivative.
pub(crate) fn polynomial_with_slope<const N: usize>(coefficients: &[f64; N], variable: f64) -> (f64, f64) {
    let (mut sum, mut slope) = (0.0, 0.0);
    for coefficient in coefficients.iter().rev() {
        slope = slope * variable + sum;
        sum = sum * variable + coefficient;
    }
    (sum, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The power series: `u^(2n+1) (-i)^n / (n! (2n+1))`.
    fn series(u: f64) -> Complex {
        let mut sum = Complex::ZERO;
        let mut term = Complex::new(u, 0.0);
        for n in 0..200 {
            let n = f64::from(n);
            sum += term.times(1.0 / (2.0 * n + 1.0));
            term = term * Complex::new(0.0, -u * u / (n + 1.0));
        }
        sum
    }

    #[test]
    fn agrees_with_its_series() {
        for step in -3000..=3000 {
            let u = f64::from(step) / 1000.0;
            let off = (fresnel(u) - series(u)).magnitude();
            assert!(off < 1.2e-6, "{u}: {off}");
        }
    }

    /// Past where the series keeps digits: the asymptotic expansion `1/2iu (1 - 1/(2iu^2) + 3/(2iu^2)^2 - ...)`.
    #[test]
    fn agrees_with_its_expansion() {
        for step in 0..2000 {
            let u = 4.0 + f64::from(step * step) / 1000.0;
            let mut term = Complex::new(0.0, -0.5 / u);
            let mut sum = Complex::ZERO;
            for n in 0..8 {
                sum += term;
                term = term * Complex::new(0.0, f64::from(2 * n + 1) / (2.0 * u * u));
            }
            let off = (rest(u) - sum).magnitude();
            assert!(off < 1.2e-6, "{u}: {off}");
        }
    }

    #[test]
    fn does_not_jump_at_zero() {
        assert!((rest(0.0) - whole().times(0.5)).magnitude() < 1e-11);
    }
}
