//! The field of several places side by side.
//!
//! The loops over eight lanes are plain and call nothing but what is free of branches, so the compiler turns them into vector
//! instructions, for the set that the processor is found to have. Which one it is does not show in the answers: nothing is
//! reordered or fused. The formulas are those of [`crate::source`] and [`crate::tail`].

use crate::complex::Complex;
use crate::domain::{Grid, Ground};
use crate::field::Field;
use crate::fresnel::{self, polynomial};
use crate::hankel;
use crate::source::Constants;
use crate::tail::{FAR, LAGUERRE, tail};
use core::array::from_fn;
use core::f64::consts::{FRAC_2_PI, PI};
use pulp::{Arch, NullaryFnOnce};
use vcutc_region::place::Place;

/// How many places are computed together.
const LANES: usize = 8;

/// From this a on the Fresnel integral serves near ends: to 2 % of the field, which is enough for signs on a grid.
const LOOSE: f64 = 1.0;

/// One number for each place.
type Lane = [f64; LANES];

/// The turned field at the points of a row that are open to lines, within 2 % where sources are near; zero elsewhere.
pub(crate) fn row(field: &Field, turn: Complex, grid: &Grid, row: usize, grounds: &[Ground]) -> Vec<Complex> {
    let sources: Vec<Constants> = field.sources().iter().map(|source| source.constants()).collect();
    let mut values = vec![Complex::ZERO; grounds.len()];
    let open = grounds
        .iter()
        .enumerate()
        .filter(|(_, ground)| ground.is_open_to_lines());
    let columns: Vec<usize> = open.map(|(column, _)| column).collect();
    for columns in columns.chunks(LANES) {
        // Lanes left over repeat the first place.
        let column = |lane: usize| columns.get(lane).or(columns.first()).copied().unwrap_or(0);
        let places: [Place; LANES] = from_fn(|lane| grid.place(column(lane), row));
        let [re, im] = Arch::new().dispatch(Sum {
            sources: &sources,
            places: &places,
        });
        for ((column, re), im) in columns.iter().zip(re).zip(im) {
            if let Some(value) = values.get_mut(*column) {
                *value = turn * Complex::new(re, im);
            }
        }
    }
    values
}

/// Real and imaginary parts of the field at all places.
struct Sum<'a> {
    sources: &'a [Constants],
    places: &'a [Place; LANES],
}

/// The wave from an end of a source: the distance, and cosine and sine of its phase.
#[derive(Clone, Copy)]
struct Wave {
    r: Lane,
    cos: Lane,
    sin: Lane,
}

impl NullaryFnOnce for Sum<'_> {
    type Output = [Lane; 2];

    #[inline(always)]
    fn call(self) -> [Lane; 2] {
        let mut sum = [[0.0; LANES]; 2];
        let mut last: Option<(Place, Wave)> = None;
        for source in self.sources {
            let first = match last {
                Some((end, wave)) if end == source.origin => wave,
                _ => wave(source, source.origin, self.places),
            };
            let end = wave(source, source.end, self.places);
            add(source, self.places, &[first, end], &mut sum);
            last = Some((source.end, end));
        }
        sum
    }
}

#[inline(always)]
fn wave(source: &Constants, end: Place, places: &[Place; LANES]) -> Wave {
    let mut r = [0.0; LANES];
    for lane in 0..LANES {
        let (x, y) = (places[lane].x - end.x, places[lane].y - end.y);
        r[lane] = (x * x + y * y + source.lift * source.lift).sqrt();
    }
    let mut phase = [0.0; LANES];
    for lane in 0..LANES {
        phase[lane] = -source.k * r[lane];
    }
    let [cos, sin] = turns(&phase);
    Wave { r, cos, sin }
}

/// Adds the field of a source.
#[inline(always)]
fn add(source: &Constants, places: &[Place; LANES], waves: &[Wave; 2], sum: &mut [Lane; 2]) {
    let Constants {
        origin,
        along,
        lift,
        length,
        k,
        kx,
        ky,
        ..
    } = *source;
    let (mut x, mut a) = ([0.0; LANES], [0.0; LANES]);
    let mut u = [[0.0; LANES]; 2];
    for lane in 0..LANES {
        let way = (places[lane].x - origin.x, places[lane].y - origin.y);
        x[lane] = along.x * way.0 + along.y * way.1;
        let y = along.x * way.1 - along.y * way.0;
        let rho = (y * y + lift * lift).sqrt();
        a[lane] = ky * rho;
        let (q, nearest) = (rho * kx / ky, rho * k / ky);
        for (end, t) in [0.0, length].into_iter().enumerate() {
            let ahead = t - x[lane];
            let both = waves[end].r[lane] + nearest;
            let w = k + kx * (ahead - q) / both;
            let w = if w > 0.0 { w } else { 0.0 };
            u[end][lane] = (ahead + q) * (w / both).sqrt();
        }
    }
    for (end, sign) in [1.0, -1.0].into_iter().enumerate() {
        let [re, im] = tails(&a, &u[end]);
        let drive = if end == 0 { source.drive } else { source.end_drive };
        for lane in 0..LANES {
            let side = if u[end][lane] < 0.0 { -sign } else { sign };
            let (cos, sin) = (waves[end].cos[lane], waves[end].sin[lane]);
            let turned = (drive.re * cos - drive.im * sin, drive.re * sin + drive.im * cos);
            sum[0][lane] += side * (turned.0 * re[lane] - turned.1 * im[lane]);
            sum[1][lane] += side * (turned.0 * im[lane] + turned.1 * re[lane]);
        }
    }
    beam(source, &x, &a, &u, sum);
}

/// Adds what arrives on the ray of the beam, where it leaves from the source.
#[inline(always)]
fn beam(source: &Constants, x: &Lane, a: &Lane, u: &[Lane; 2], sum: &mut [Lane; 2]) {
    let mut share = [0.0; LANES];
    for lane in 0..LANES {
        share[lane] = if u[0][lane] < 0.0 && u[1][lane] >= 0.0 {
            1.0
        } else {
            0.0
        };
    }
    if share.iter().all(|share| *share == 0.0) {
        return;
    }
    let mut phase = [0.0; LANES];
    for lane in 0..LANES {
        phase[lane] = -source.kx * x[lane] - a[lane];
    }
    let [cos, sin] = turns(&phase);
    let drive = source.drive * Complex::new(0.0, -0.25);
    let mut envelopes = [[0.0; 2]; LANES];
    for lane in 0..LANES {
        envelopes[lane] = envelope(a[lane]);
    }
    for lane in 0..LANES {
        if a[lane] < hankel::LEAST {
            let Complex { re, im } = hankel::envelope(a[lane]);
            envelopes[lane] = [re, im];
        }
    }
    for lane in 0..LANES {
        let [re, im] = envelopes[lane];
        let scale = share[lane] / a[lane].sqrt();
        let turned = (
            drive.re * cos[lane] - drive.im * sin[lane],
            drive.re * sin[lane] + drive.im * cos[lane],
        );
        sum[0][lane] += scale * (turned.0 * re - turned.1 * im);
        sum[1][lane] += scale * (turned.0 * im + turned.1 * re);
    }
}

/// From the least argument on.
#[inline(always)]
fn envelope(a: f64) -> [f64; 2] {
    let variable = hankel::variable(a);
    [
        polynomial(&hankel::REAL, variable),
        polynomial(&hankel::IMAGINARY, variable),
    ]
}

/// What lies beyond the ends.
#[inline(always)]
fn tails(a: &Lane, u: &Lane) -> [Lane; 2] {
    let mut found = far(a, u);
    let (mut is_calm, mut is_near) = (false, false);
    for lane in 0..LANES {
        let is_beside = u[lane] * u[lane] < FAR;
        is_calm |= is_beside && a[lane] >= LOOSE;
        is_near |= is_beside && a[lane] < LOOSE;
    }
    if is_calm {
        let calm = calm(a, u);
        for lane in 0..LANES {
            let is_calm = u[lane] * u[lane] < FAR && a[lane] >= LOOSE;
            for part in 0..2 {
                found[part][lane] = if is_calm {
                    calm[part][lane]
                } else {
                    found[part][lane]
                };
            }
        }
    }
    if is_near {
        for lane in 0..LANES {
            if u[lane] * u[lane] < FAR && a[lane] < LOOSE {
                let tail = tail(a[lane], u[lane].abs());
                found[0][lane] = tail.re;
                found[1][lane] = tail.im;
            }
        }
    }
    found
}

#[inline(always)]
fn far(a: &Lane, u: &Lane) -> [Lane; 2] {
    let mut found = [[0.0; LANES]; 2];
    for lane in 0..LANES {
        let (one, other) = (u[lane] * u[lane], 2.0 * a[lane] + u[lane] * u[lane]);
        let (mut re, mut im) = (0.0, 0.0);
        for (y, weight) in LAGUERRE {
            let (real, imaginary) = (one * other - y * y, -y * (one + other));
            let magnitude = (real * real + imaginary * imaginary).sqrt();
            // Where this cancels, the end is beside and this is not taken.
            let half = magnitude + real;
            let root = (0.5 * (if half > 0.0 { half } else { 1.0 })).sqrt();
            re += weight * root / magnitude;
            im -= weight * imaginary / (2.0 * root * magnitude);
        }
        // Times -i / (4 pi).
        found[0][lane] = im / (4.0 * PI);
        found[1][lane] = -re / (4.0 * PI);
    }
    found
}

#[inline(always)]
fn calm(a: &Lane, u: &Lane) -> [Lane; 2] {
    let mut found = [[0.0; LANES]; 2];
    // -i/4 / (sqrt(pi) exp(-i pi/4)).
    let factor = 0.25 / (2.0 * PI).sqrt();
    for lane in 0..LANES {
        let (a, u) = (a[lane], u[lane].abs());
        let [re, im] = envelope(a);
        let scale = factor / a.sqrt();
        let field = (scale * (re + im), scale * (im - re));
        let share = fresnel::MIDDLE / (u + fresnel::MIDDLE);
        let variable = 2.0 * share - 1.0;
        let rest = (
            share * polynomial(&fresnel::REAL, variable),
            share * polynomial(&fresnel::IMAGINARY, variable),
        );
        let (near, far) = ((2.0 * a).sqrt(), (2.0 * a + u * u).sqrt());
        let c = u / (4.0 * PI * near * far * (near + far));
        let q =
            (far / (2.0 * near * near) + 1.0 / near + 2.0 / far + near / (far * far)) / (2.0 * (near + far));
        let c = c / (1.0 + q * q);
        found[0][lane] = field.0 * rest.0 - field.1 * rest.1 - c * q;
        found[1][lane] = field.0 * rest.1 + field.1 * rest.0 + c;
    }
    found
}

/// Adding and subtracting it rounds to a whole number: 1.5 * 2^52.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Quarter turn, in two parts.
const QUARTER: (f64, f64) = (1.570_796_326_734_125_6, 6.077_100_506_506_192e-11);

/// Cosine and sine, by Taylor's series over an eighth of a turn on either side, to 1e-10; for angles up to 1e6.
#[inline(always)]
fn turns(angle: &Lane) -> [Lane; 2] {
    let mut found = [[0.0; LANES]; 2];
    for lane in 0..LANES {
        let count = angle[lane] * FRAC_2_PI + WHOLE - WHOLE;
        let x = angle[lane] - count * QUARTER.0 - count * QUARTER.1;
        let square = x * x;
        let sine = polynomial(&SINE, square) * x;
        let cosine = polynomial(&COSINE, square);
        // 0, 1, -1, 2 or -2 quarters.
        let quarters = count - 4.0 * (count * 0.25 + WHOLE - WHOLE);
        let is_odd = quarters * quarters == 1.0;
        let (first, second) = if is_odd { (-sine, cosine) } else { (cosine, sine) };
        let sign = if quarters == -1.0 || quarters * quarters == 4.0 {
            -1.0
        } else {
            1.0
        };
        found[0][lane] = sign * first;
        found[1][lane] = sign * second;
    }
    found
}

const SINE: [f64; 6] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
];

const COSINE: [f64; 7] = [
    1.0,
    -1.0 / 2.0,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Detail, axis};
    use crate::source::Tuning;
    use vcutc_region::testkit::pocket;

    #[test]
    fn turns_are_those_of_libm() {
        for step in -5000..5000 {
            let angle = f64::from(step) * 0.0137 + f64::from(step * step) * 1e-4;
            let [cos, sin] = turns(&[angle; LANES]);
            let off = (Complex::new(cos[3], sin[3]) - Complex::turn(angle)).magnitude();
            assert!(off < 1e-9, "{angle}: {off}");
        }
    }

    #[test]
    fn rows_are_the_field_place_by_place() {
        let region = pocket(3);
        let axis = axis(&region, Detail::True, 0.04).unwrap();
        for lift in [0.01, 0.2, 2.0] {
            let tuning = Tuning {
                step: 4.0,
                lift,
                reference: 12.0,
            };
            let field = Field::new(&axis.segments, &tuning).unwrap();
            let grid = Grid {
                origin: Place::new(-3.1, 30.2),
                pitch: 0.71,
                columns: 183,
                rows: 5,
            };
            let mut grounds = vec![Ground::Free; grid.columns];
            grounds[7] = Ground::Outside;
            let turn = field.turned_to(5.0);
            let (mut sum, mut most) = (0.0, 0.0_f64);
            for number in 0..grid.rows {
                let values = row(&field, turn, &grid, number, &grounds);
                for (column, value) in values.iter().enumerate() {
                    let exact = if column == 7 {
                        Complex::ZERO
                    } else {
                        turn * field.value(grid.place(column, number))
                    };
                    let off = (*value - exact).magnitude();
                    most = most.max(off);
                    sum += off / (183.0 * 5.0);
                }
            }
            assert!(most < 0.1 && sum < 0.005, "{lift}: {most} {sum}");
        }
    }
}
