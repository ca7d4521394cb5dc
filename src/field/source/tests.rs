//! Sources against published numbers, quadrature and differences.

use super::*;
use crate::hankel::far;
use proptest::prelude::*;

/// Waves of 8 mm.
const K: f64 = PI / 4.0;

fn line(length: f64, degrees: f64) -> Line {
    // The angle of the beam to the source, from square to it.
    let (sin, cos) = libm::sincos(degrees * PI / 180.0);
    let line = Line::new(length, K, K * sin).unwrap();
    assert!((line.ky - K * cos).abs() < 1e-12);
    line
}

/// The kernel itself, by the midpoint rule in t.
fn by_midpoints(line: &Line, x: f64, rho: f64) -> Complex {
    let count = 200_000;
    let width = line.length / f64::from(count);
    let mut sum = Complex::ZERO;
    for index in 0..count {
        let t = (f64::from(index) + 0.5) * width;
        let r = libm::hypot(t - x, rho);
        sum += Complex::turn(-line.kx * t - line.k * r).times(width / (4.0 * PI * r));
    }
    sum
}

#[test]
fn one_source_over_the_endless_one() {
    let line = line(60.0, 0.0);
    for ((x, y), ratio, turn) in [
        ((30.0, 20.0), 0.91056, 0.10411),
        ((3.0, 20.0), 0.68712, 0.27521),
        ((30.0, 4.0), 1.05083, 0.03146),
    ] {
        let endless = hankel(K * y) * Complex::new(0.0, -0.25);
        let quotient = line.integral(x, y) * endless.conjugate();
        let magnitude = quotient.magnitude() / (endless.magnitude() * endless.magnitude());
        assert!((magnitude - ratio).abs() < 6e-6, "{x} {y}: {magnitude}");
        assert!(
            (quotient.angle() - turn).abs() < 6e-6,
            "{x} {y}: {}",
            quotient.angle()
        );
    }
}

#[test]
fn direct_values() {
    for (degrees, (x, y), re, im) in [
        (0.0, (30.0, 20.0), -0.03581631, 0.02857111),
        (45.0, (40.0, 20.0), -0.05951988, -0.03574666),
    ] {
        let line = line(60.0, degrees);
        let exact = Complex::new(re, im);
        assert!(
            (line.integral(x, y) - exact).magnitude() < 1.5e-8,
            "{:?}",
            line.integral(x, y)
        );
        assert!((by_midpoints(&line, x, y) - exact).magnitude() < 1.5e-8);
        // The closed form that lines are drawn with.
        let off = (line.field(x, y) - exact).magnitude() / exact.magnitude();
        assert!(off < 0.0005, "{off}");
    }
}

/// A sequence that fills a square evenly (Roberts 2018).
fn spread(index: u32) -> (f64, f64) {
    let fraction = |x: f64| x - libm::floor(x);
    let index = f64::from(index);
    (
        fraction(0.5 + index * 0.754_877_666_246_693),
        fraction(0.5 + index * 0.569_840_290_998_053),
    )
}

/// The worst of 400 places each at distances of s/4 to s/2, to s, to 2 s, to 4 s; as a share of the endless field. With the
/// Fresnel integral and one term for every end these are 6.3, 2.8, 1.3 and 0.42 %.
#[test]
fn the_closed_form_is_near_the_integral() {
    let mut worst = [0.0_f64; 4];
    for (band, worst) in (0..).zip(&mut worst) {
        let least = libm::ldexp(1.0, band);
        for index in 0..400 {
            let (share, height) = spread(index);
            let line = line(60.0, [0.0, 20.0, 40.0, 60.0][index as usize % 4]);
            let (x, y) = (-10.0 + 80.0 * share, least * (1.0 + height));
            let scale = (hankel(line.ky * y) * Complex::new(0.0, -0.25)).magnitude();
            let off = (line.field(x, y) - line.integral(x, y)).magnitude() / scale;
            *worst = worst.max(off);
        }
    }
    assert!(worst.iter().all(|worst| *worst < 1e-3), "{worst:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn quadrature_agrees_with_the_kernel(length in 1.0..50.0f64, degrees in -80.0..80.0f64, x in -20.0..70.0f64, y in 0.5..40.0f64) {
        let line = line(length, degrees);
        let off = (line.integral(x, y) - by_midpoints(&line, x, y)).magnitude();
        prop_assert!(off < 1e-8, "{off}");
    }

    #[test]
    fn gradients_are_those_of_the_values(
        (x, y) in (-20.0..60.0f64, -30.0..30.0f64),
        (dx, dy) in (-40.0..40.0f64, 1.0..40.0f64),
        slope in -0.99..0.99f64,
        lift in 0.1..3.0f64,
    ) {
        let from = Place::new(3.0, 5.0);
        let segment = Segment {
            from,
            to: from.plus(Place::new(dx, dy)),
            from_radius: 50.0,
            to_radius: 50.0 + slope * libm::hypot(dx, dy),
        };
        let tuning = Tuning { step: 4.0, lift, reference: 20.0 };
        let source = Source::new(&segment, &tuning).unwrap();
        let (value, gradient) = source.with_gradient(Place::new(x, y));
        let scale = source.drive.magnitude() * 0.02;
        prop_assert!((value - source.field(Place::new(x, y))).magnitude() < 1e-9 * scale);
        let h = 1e-4;
        for (by, step) in gradient.into_iter().zip([Place::new(h, 0.0), Place::new(0.0, h)]) {
            let ahead = source.field(Place::new(x, y).plus(step));
            let back = source.field(Place::new(x, y).plus(step.times(-1.0)));
            let slope = (ahead - back).times(0.5 / h);
            prop_assert!((by - slope).magnitude() < 2e-3 * (1.0 + by.magnitude()), "{by:?} {slope:?}");
        }
    }
}

/// In a straight-legged corner the level sets are hyperbolas with this radius of the vertex.
#[test]
fn lifted_corners_have_known_radii() {
    for (degrees, simple, exact) in [
        (30.0, 1.1547, 1.1037),
        (45.0, 2.0, 1.8820),
        (60.0, 3.4641, 3.1434),
    ] {
        let (_, cos) = libm::sincos(degrees * PI / 180.0);
        let tan = libm::tan(degrees * PI / 180.0);
        let u = K * cos * 2.0;
        // Of the phase far away, and of the exact phase, whose slope is 2 / (pi u |H0|^2).
        assert!((2.0 * tan - simple).abs() < 5.1e-5);
        let field = hankel(u).magnitude();
        let radius = 2.0 * tan / (2.0 / (PI * u * field * field));
        assert!((radius - exact).abs() < 5.1e-5, "{radius}");
        assert!((far(u).magnitude() / field - 1.0).abs() < 0.05);
    }
}
