//! The field beyond an end of a line source: an incomplete Hankel function.
//!
//! It is the integral of `exp(-i v^2) / (2 pi sqrt(2 a + v^2))` from `u >= 0` to infinity. Here it comes times `exp(i u^2)`,
//! so that only what changes slowly is left.

use crate::complex::Complex;
use crate::fresnel::{rest, whole};
use crate::hankel::{envelope, envelope_with_slope};
use core::f64::consts::PI;

/// From this u^2 on the end is far: Laguerre's quadrature.
pub(crate) const FAR: f64 = 6.0;

/// From this a on the Fresnel integral serves near ends as well.
pub(crate) const CALM: f64 = 4.0;

/// Laguerre's points and weights of order 3.
pub(crate) const LAGUERRE: [(f64, f64); 3] = [
    (0.415_774_556_783_479_1, 0.711_093_009_929_173),
    (2.294_280_360_279_042, 0.278_517_733_569_240_8),
    (6.289_945_082_937_479, 0.010_389_256_501_586_14),
];

/// The integral from `u >= 0` on, times `exp(i u^2)`.
pub(crate) fn tail(a: f64, u: f64) -> Complex {
    if u * u < FAR {
        return beside(a, u).0;
    }
    let mut sum = Complex::ZERO;
    for (y, weight) in LAGUERRE {
        sum += inverse_root(decaying(a, u, y)).times(weight);
    }
    LAGUERRE_FACTOR * sum
}

/// The same, and its derivative by a.
pub(crate) fn tail_with_slope(a: f64, u: f64) -> (Complex, Complex) {
    if u * u >= FAR { far(a, u) } else { beside(a, u) }
}

fn beside(a: f64, u: f64) -> (Complex, Complex) {
    if a >= CALM { calm(a, u) } else { near(a, u) }
}

const LAGUERRE_FACTOR: Complex = Complex::new(0.0, -1.0 / (4.0 * PI));

/// On the path `v^2 = u^2 - i y`, along which the wave only decays: `-i / (4 pi)` times the integral of
/// `exp(-y) / sqrt((u^2 - i y) (2 a + u^2 - i y))`. Within 3e-6 from `u^2 = 6` on.
fn far(a: f64, u: f64) -> (Complex, Complex) {
    let (mut sum, mut slope) = (Complex::ZERO, Complex::ZERO);
    for (y, weight) in LAGUERRE {
        let part = inverse_root(decaying(a, u, y)).times(weight);
        sum += part;
        // d/da 1/sqrt(p) = -1/p 1/sqrt(p), of p = 2 a + v^2.
        let p = 2.0 * a + u * u;
        slope += part * Complex::new(-p, -y).times(1.0 / (p * p + y * y));
    }
    (LAGUERRE_FACTOR * sum, LAGUERRE_FACTOR * slope)
}

/// `(u^2 - i y) (2 a + u^2 - i y)`.
fn decaying(a: f64, u: f64, y: f64) -> Complex {
    let (one, other) = (u * u, 2.0 * a + u * u);
    Complex::new(one * other - y * y, -y * (one + other))
}

/// `1 / sqrt(z)` for an angle of z from -pi to 0.
fn inverse_root(z: Complex) -> Complex {
    let magnitude = (z.re * z.re + z.im * z.im).sqrt();
    // The root's angle is -pi/2 to 0. One part by the sum that does not cancel, the other from the product of both.
    let (re, im) = if z.re >= 0.0 {
        let re = ((magnitude + z.re) / 2.0).sqrt();
        (re, z.im / (2.0 * re))
    } else {
        let im = -((magnitude - z.re) / 2.0).sqrt();
        (z.im / (2.0 * im), im)
    };
    Complex::new(re, -im).times(1.0 / magnitude)
}

/// Next to the end and close to the source's line: by quadrature to where the end is far. With `v = sqrt(2 a) sinh(s)` the
/// peak of the kernel is gone.
fn near(a: f64, u: f64) -> (Complex, Complex) {
    let width = (2.0 * a).sqrt();
    let last = libm::asinh(FAR.sqrt() / width);
    let mut s = libm::asinh(u / width);
    let (mut sum, mut slope) = (Complex::ZERO, Complex::ZERO);
    while s < last {
        let v = width * libm::sinh(s);
        // The phase changes by 2 v sqrt(2 a + v^2).
        let rate = 2.0 * v * (2.0 * a + v * v).sqrt();
        let next = (s + (1.0 / rate).min(0.6)).min(last);
        for (s, weight) in legendre(s, next) {
            let v = width * libm::sinh(s);
            let wave = Complex::turn(u * u - v * v).times(weight / (2.0 * PI));
            sum += wave;
            slope += wave.times(-1.0 / (2.0 * a + v * v));
        }
        s = next;
    }
    let (rest, rest_slope) = far(a, FAR.sqrt());
    let turn = Complex::turn(u * u - FAR);
    (sum + turn * rest, slope + turn * rest_slope)
}

/// By the Fresnel integral, with the endless source's field, less what the end adds to it.
fn calm(a: f64, u: f64) -> (Complex, Complex) {
    let correction = Correction::new(a, u);
    let rest = rest(u);
    let value = share(steady(a)) * rest - correction.value();
    (value, share(steady_slope(a)) * rest - correction.slope())
}

/// `H0(a) exp(i a)` as the factor of the Fresnel integral: times `-i/4 / (sqrt(pi) exp(-i pi/4))`.
fn share(field: Complex) -> Complex {
    Complex::new(0.0, -0.25) * whole().conjugate().times(1.0 / PI) * field
}

/// `H0(a) exp(i a)`.
pub(crate) fn steady(a: f64) -> Complex {
    envelope(a).times(1.0 / a.sqrt())
}

/// Its derivative.
pub(crate) fn steady_slope(a: f64) -> Complex {
    let (value, slope) = envelope_with_slope(a);
    (slope - value.times(0.5 / a)).times(1.0 / a.sqrt())
}

/// What an end adds to the share of the Fresnel integral.
///
/// With `g = 1 / (2 pi sqrt(2 a + v^2))` and `g(u) - g(0) = -u^2 / (2 pi d)` it is, by parts, `-i c exp(-i u^2)` with
/// `c = u / (4 pi d)`, and once more by parts `-i c (1 + i q) exp(-i u^2)`. Summed as the geometric series `c / (i + q)` it
/// also serves where q, about `0.56 / a` beside the end, is not small.
struct Correction {
    /// `sqrt(2 a)` and `sqrt(2 a + u^2)`.
    near: f64,
    far: f64,
    c: f64,
    q: f64,
}

impl Correction {
    fn new(a: f64, u: f64) -> Self {
        let (near, far) = ((2.0 * a).sqrt(), (2.0 * a + u * u).sqrt());
        let c = u / (4.0 * PI * near * far * (near + far));
        let q =
            (far / (2.0 * near * near) + 1.0 / near + 2.0 / far + near / (far * far)) / (2.0 * (near + far));
        Self { near, far, c, q }
    }

    /// `1 / (q + i)`.
    fn inverse(&self) -> Complex {
        Complex::new(self.q, -1.0).times(1.0 / (1.0 + self.q * self.q))
    }

    fn value(&self) -> Complex {
        self.inverse().times(self.c)
    }

    /// The derivative by a: `c' / (q + i) - c q' / (q + i)^2`.
    fn slope(&self) -> Complex {
        let Self { near, far, c, q } = *self;
        let sum = near + far;
        // Of d = near far (near + far), over d, and of q, by the two roots.
        let d_by_far = (2.0 * far + near) / (far * sum);
        let d_by_near = (far + 2.0 * near) / (near * sum);
        let part_by_far = 0.5 / (near * near) - 2.0 / (far * far) - 2.0 * near / (far * far * far);
        let part_by_near = 1.0 / (far * far) - 1.0 / (near * near) - far / (near * near * near);
        let q_by_far = (part_by_far - 2.0 * q) / (2.0 * sum);
        let q_by_near = (part_by_near - 2.0 * q) / (2.0 * sum);
        let c_slope = -c * (d_by_far / far + d_by_near / near);
        let q_slope = q_by_far / far + q_by_near / near;
        self.inverse().times(c_slope) - self.inverse() * self.inverse().times(c * q_slope)
    }
}

/// Legendre's points and weights of order 5.
const LEGENDRE: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189),
    (-0.538_469_310_105_683, 0.478_628_670_499_366),
    (0.0, 0.568_888_888_888_889),
    (0.538_469_310_105_683, 0.478_628_670_499_366),
    (0.906_179_845_938_664, 0.236_926_885_056_189),
];

/// Places and weights of Gauss quadrature between two numbers.
pub(crate) fn legendre(from: f64, to: f64) -> [(f64, f64); 5] {
    let (middle, half) = (f64::midpoint(from, to), (to - from) / 2.0);
    LEGENDRE.map(|(point, weight)| (middle + half * point, half * weight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The integral itself, on the straight path from u into the lower half of the plane, on which the wave decays:
    /// `v = u + exp(-i pi/4) y`, by the midpoint rule.
    fn by_midpoints(a: f64, u: f64) -> Complex {
        let direction = Complex::turn(-PI / 4.0);
        let (count, width) = (60_000, 1e-4);
        let mut sum = Complex::ZERO;
        for index in 0..count {
            let y = (f64::from(index) + 0.5) * width;
            let v = Complex::new(u, 0.0) + direction.times(y);
            // i (v^2 - u^2), of which the real part is negative.
            let square = v * v;
            let exponent = Complex::I * (square - Complex::new(u * u, 0.0));
            let wave = Complex::turn(-exponent.im).times(libm::exp(-exponent.re));
            let root = inverse_root(square + Complex::new(2.0 * a, 0.0));
            sum += wave * root * direction.times(width / (2.0 * PI));
        }
        sum
    }

    #[test]
    fn known_roots() {
        for (re, im) in [(4.0, -0.0), (0.0, -2.0), (-3.0, -4.0), (3.0, -4.0), (-1e-9, -1.0)] {
            let root = inverse_root(Complex::new(re, im));
            let back = root * root * Complex::new(re, im);
            assert!((back - Complex::new(1.0, 0.0)).magnitude() < 1e-12, "{re} {im}");
            assert!(root.im >= 0.0 && root.re >= 0.0);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn tails_are_their_integrals(a in 0.05..60.0f64, u in 0.0..8.0f64) {
            let exact = by_midpoints(a, u);
            let off = (tail(a, u) - exact).magnitude();
            // Less than 0.1 % of the endless source's field, which is 1 / sqrt(8 pi a).
            let limit = if u * u >= FAR || a < CALM { 5e-6 } else { 1e-3 / (8.0 * PI * a).sqrt() };
            prop_assert!(off < limit, "{off} {limit}");
        }

        #[test]
        fn slopes_are_those_of_the_values(a in 0.1..60.0f64, u in 0.0..8.0f64) {
            let h = 1e-4 * a;
            prop_assume!((a - CALM).abs() > 2.0 * h);
            let (value, slope) = tail_with_slope(a, u);
            prop_assert!((value - tail(a, u)).magnitude() < 1e-12);
            let expected = (tail(a + h, u) - tail(a - h, u)).times(0.5 / h);
            prop_assert!((slope - expected).magnitude() < 1e-4 / a, "{slope:?} {expected:?}");
        }
    }
}
