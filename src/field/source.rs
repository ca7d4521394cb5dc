//! Truncated line sources along pieces of the medial axis.
//!
//! Along the axis the distance R to the nearest wall changes by `dR/dl = -cos theta`, with the angle theta from the axis
//! to the ray that meets the wall squarely. A source that is driven with the phase `k (Rmax - R)` therefore sends its
//! plane wave along those rays, and fronts of neighbouring pieces join. Rmax shifts all phases alike; it is left out
//! here, so the phase far away is `k d`, with the distance d to the wall.

use crate::complex::Complex;
use crate::hankel::hankel;
use crate::tail::{legendre, steady, steady_slope, tail, tail_with_slope};
use core::f64::consts::PI;
use vcutc_region::place::Place;

/// Sources with a lesser sine of the angle to their beam send nothing: the beam goes along the source.
const LEAST_SINE: f64 = 1e-6;

/// A straight piece of the medial axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where it begins.
    pub from: Place,
    /// Where it ends.
    pub to: Place,
    /// Distance from its beginning to the nearest wall, in mm.
    pub from_radius: f64,
    /// Distance from its end to the nearest wall, in mm.
    pub to_radius: f64,
}

impl Segment {
    /// Its length, in mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }
}

/// What all sources of a field have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Distance of neighbouring zero lines, half of a wave, in mm.
    pub step: f64,
    /// Height of the plane of the field over the sources, in mm, above 0: it rounds the corners of the lines.
    pub lift: f64,
    /// Length of the ray, in mm, at which gain and phase of the field are exact: `yref = reference * sin theta`.
    pub reference: f64,
}

impl Tuning {
    /// The wave number `k = pi / step` (Yang et al., eq. 15), in 1/mm.
    #[must_use]
    pub fn wave_number(&self) -> f64 {
        PI / self.step
    }

    /// The driving function of an endless source for a beam of this sine, without its phase along the source:
    /// `4 i exp(-i ky yref) / H0(ky yref)` (Ahrens 2012, 3.79).
    ///
    /// With `yref` in proportion to the sine the gain is `sqrt(reference / t)` at the length t of every ray, so it is
    /// continuous where two beams meet.
    fn gain(&self, sine: f64) -> Complex {
        let argument = self.wave_number() * self.reference * sine * sine;
        let field = hankel(argument);
        let phase = Complex::turn(-argument) * field.conjugate();
        Complex::I * phase.times(4.0 / (field.magnitude() * field.magnitude()))
    }
}

/// A line source of a length, driven with `exp(-i kx t)` at t from its beginning, in its own frame.
///
/// With `psi(t) = kx t + k r(t)`, stationary at `t_s = x - rho kx / ky`, and `u(t) = sign(t - t_s) sqrt(psi - psi_s)` the
/// field is, exactly, `exp(-i psi_s) / (2 pi)` times the integral of `exp(-i u^2) / sqrt(2 ky rho + u^2)` over u: for
/// `w = k + kx (t - x - q) / (r + r_s)`, with `q = rho kx / ky` and `r_s = rho k / ky`, both `u = (t - t_s) sqrt(w / (r + r_s))`
/// and `w (r + r_s) = 2 ky rho + u^2` hold, and nothing cancels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    length: f64,
    k: f64,
    kx: f64,
    ky: f64,
    /// The drive at its end.
    end_drive: Complex,
}

/// The wave from an end of a source to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wave {
    /// Distance of the place.
    r: f64,
    /// `exp(-i k r)`.
    turn: Complex,
}

impl Wave {
    pub(crate) fn new(k: f64, r: f64) -> Self {
        Self {
            r,
            turn: Complex::turn(-k * r),
        }
    }
}

/// An end of a line source, seen from a place.
struct End {
    wave: Wave,
    /// The wave with the drive of the end: `exp(-i psi)`.
    phase: Complex,
    /// How far it is ahead of the place along the source.
    ahead: f64,
    /// The Fresnel argument.
    u: f64,
    /// Whether what lies beyond is added or taken away.
    sign: f64,
}

impl Line {
    /// The source of a length, in mm, with the wave number k and that along the source, in 1/mm. None where the length is not
    /// above 0, or the wave goes along the source.
    #[must_use]
    pub fn new(length: f64, k: f64, kx: f64) -> Option<Self> {
        let square = (k - kx) * (k + kx);
        (length > 0.0 && square > LEAST_SINE * LEAST_SINE * k * k).then(|| Self {
            length,
            k,
            kx,
            ky: square.sqrt(),
            end_drive: Complex::turn(-kx * length),
        })
    }

    /// Its field at `x` along the source from its beginning and `rho > 0` off its line, within 0.1 % of the endless source's.
    #[must_use]
    pub fn field(&self, x: f64, rho: f64) -> Complex {
        self.field_of(x, rho, self.waves(x, rho))
    }

    fn field_of(&self, x: f64, rho: f64, waves: [Wave; 2]) -> Complex {
        let a = self.ky * rho;
        let ends = self.ends(x, rho, waves);
        let mut value = Complex::ZERO;
        if is_beside(&ends) {
            value += Complex::turn(-self.kx * x - a) * endless(steady(a));
        }
        for end in &ends {
            value += end.phase * tail(a, end.u.abs()).times(end.sign);
        }
        value
    }

    /// The field and its derivatives by `x` and by `rho`.
    fn with_slopes_of(&self, x: f64, rho: f64, waves: [Wave; 2]) -> (Complex, [Complex; 2]) {
        let a = self.ky * rho;
        let ends = self.ends(x, rho, waves);
        // The derivative by a is that of all but exp(-i psi).
        let (mut value, mut by_a) = (Complex::ZERO, Complex::ZERO);
        if is_beside(&ends) {
            let front = Complex::turn(-self.kx * x - a);
            value += front * endless(steady(a));
            by_a += front * endless(steady_slope(a));
        }
        let mut by_u = [Complex::ZERO; 2];
        for (end, direction) in ends.iter().zip([-1.0, 1.0]) {
            let (part, slope) = tail_with_slope(a, end.u.abs());
            value += end.phase * part.times(end.sign);
            by_a += end.phase * slope.times(end.sign);
            // The integrand, and the derivatives of u.
            let root = (2.0 * a + end.u * end.u).sqrt();
            let kernel = end.phase.times(direction / (4.0 * PI * end.wave.r));
            let across = -self.ky * (end.ahead - rho * self.kx / self.ky) / (root * root);
            by_u[0] += -kernel;
            by_u[1] += kernel.times(across);
        }
        let along = by_u[0] - Complex::new(0.0, self.kx) * value;
        let across = by_u[1] + (by_a - Complex::I * value).times(self.ky);
        (value, [along, across])
    }

    fn waves(&self, x: f64, rho: f64) -> [Wave; 2] {
        [0.0, self.length].map(|t| Wave::new(self.k, ((t - x) * (t - x) + rho * rho).sqrt()))
    }

    fn ends(&self, x: f64, rho: f64, [first, last]: [Wave; 2]) -> [End; 2] {
        let (q, nearest) = (rho * self.kx / self.ky, rho * self.k / self.ky);
        let end = |wave: Wave, phase: Complex, ahead: f64, sign: f64| {
            // Above 0: w (r + r_s) = 2 ky rho + u^2.
            let sum = wave.r + nearest;
            let w = self.k + self.kx * (ahead - q) / sum;
            let u = (ahead + q) * (w.max(0.0) / sum).sqrt();
            let sign = if u < 0.0 { -sign } else { sign };
            End {
                wave,
                phase,
                ahead,
                u,
                sign,
            }
        };
        [
            end(first, first.turn, -x, 1.0),
            end(last, last.turn * self.end_drive, self.length - x, -1.0),
        ]
    }

    /// The same field by Gauss quadrature, to about 1e-9 of it: slow, for comparison.
    #[must_use]
    pub fn integral(&self, x: f64, rho: f64) -> Complex {
        // With t - x = rho sinh(s) the kernel dt / r becomes ds, without a peak at the foot.
        let position = |t: f64| libm::asinh((t - x) / rho);
        let (mut s, last) = (position(0.0), position(self.length));
        let mut sum = Complex::ZERO;
        while s < last {
            let r = rho * libm::cosh(s);
            let next = (s + (0.5 / (self.k * r)).min(0.2)).min(last);
            for (s, weight) in legendre(s, next) {
                let phase = self.kx * (x + rho * libm::sinh(s)) + self.k * rho * libm::cosh(s);
                sum += Complex::turn(-phase).times(weight);
            }
            s = next;
        }
        sum.times(1.0 / (4.0 * PI))
    }
}

/// Whether the beam's ray through a place leaves from the source.
fn is_beside([first, last]: &[End; 2]) -> bool {
    first.u < 0.0 && last.u >= 0.0
}

/// The field `-i/4 H0` of an endless source.
fn endless(field: Complex) -> Complex {
    Complex::new(0.0, -0.25) * field
}

/// What the field of a source is computed from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Constants {
    pub(crate) origin: Place,
    pub(crate) end: Place,
    pub(crate) along: Place,
    pub(crate) lift: f64,
    pub(crate) length: f64,
    pub(crate) k: f64,
    pub(crate) kx: f64,
    pub(crate) ky: f64,
    /// At the beginning and at the end.
    pub(crate) drive: Complex,
    pub(crate) end_drive: Complex,
}

/// A source in the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    origin: Place,
    end: Place,
    along: Place,
    line: Line,
    drive: Complex,
    lift: f64,
}

impl Source {
    /// The source along a piece of the axis; none of a piece without length, or whose beam goes along it.
    #[must_use]
    pub fn new(segment: &Segment, tuning: &Tuning) -> Option<Self> {
        let length = segment.length();
        let k = tuning.wave_number();
        // kx = -k dR/dl: the phase k (Rmax - R) along the source.
        let cosine = (segment.from_radius - segment.to_radius) / length;
        let line = Line::new(length, k, k * cosine)?;
        Some(Self {
            origin: segment.from,
            end: segment.to,
            along: segment.to.minus(segment.from).times(1.0 / length),
            line,
            drive: tuning.gain(line.ky / k) * Complex::turn(k * segment.from_radius),
            lift: tuning.lift,
        })
    }

    /// Its field at a place of the plan.
    #[must_use]
    pub fn field(&self, place: Place) -> Complex {
        self.field_after(place, &mut None)
    }

    /// Its field and the derivatives by both coordinates of the plan.
    #[must_use]
    pub fn with_gradient(&self, place: Place) -> (Complex, [Complex; 2]) {
        self.with_gradient_after(place, &mut None)
    }

    /// The field, with what is known of the end of the source before: it is often the beginning of this one.
    pub(crate) fn field_after(&self, place: Place, last: &mut Option<(Place, Wave)>) -> Complex {
        let (x, _, rho) = self.local(place);
        self.drive * self.line.field_of(x, rho, self.waves(place, last))
    }

    /// The field and its derivatives likewise.
    pub(crate) fn with_gradient_after(
        &self,
        place: Place,
        last: &mut Option<(Place, Wave)>,
    ) -> (Complex, [Complex; 2]) {
        let (x, y, rho) = self.local(place);
        let (value, [by_x, by_rho]) = self.line.with_slopes_of(x, rho, self.waves(place, last));
        let by_y = by_rho.times(y / rho);
        let left = self.along.left();
        let gradient = [
            by_x.times(self.along.x) + by_y.times(left.x),
            by_x.times(self.along.y) + by_y.times(left.y),
        ];
        (self.drive * value, gradient.map(|slope| self.drive * slope))
    }

    fn waves(&self, place: Place, last: &mut Option<(Place, Wave)>) -> [Wave; 2] {
        let wave = |end: Place| {
            let way = place.minus(end);
            Wave::new(self.line.k, (way.dot(way) + self.lift * self.lift).sqrt())
        };
        let first = match *last {
            Some((end, wave)) if end == self.origin => wave,
            _ => wave(self.origin),
        };
        let end = wave(self.end);
        *last = Some((self.end, end));
        [first, end]
    }

    /// Its field by Gauss quadrature: slow, for comparison.
    #[must_use]
    pub fn integral(&self, place: Place) -> Complex {
        let (x, _, rho) = self.local(place);
        self.drive * self.line.integral(x, rho)
    }

    /// Its numbers for many places at once.
    pub(crate) fn constants(&self) -> Constants {
        Constants {
            origin: self.origin,
            end: self.end,
            along: self.along,
            lift: self.lift,
            length: self.line.length,
            k: self.line.k,
            kx: self.line.kx,
            ky: self.line.ky,
            drive: self.drive,
            end_drive: self.drive * self.line.end_drive,
        }
    }

    /// Along the source, across it, and the distance from its line in space.
    fn local(&self, place: Place) -> (f64, f64, f64) {
        let way = place.minus(self.origin);
        let (x, y) = (self.along.dot(way), self.along.cross(way));
        (x, y, (y * y + self.lift * self.lift).sqrt())
    }
}

#[cfg(test)]
mod tests;
