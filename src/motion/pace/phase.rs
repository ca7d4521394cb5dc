//! The fastest way along a given path under bounds of the rates and accelerations of axes: time-optimal path
//! parametrisation.
//!
//! With `u` the part of the way that is done, an axis value is `q(u)`, its rate `q' u'` and its acceleration
//! `q' u'' + q'' u'^2`. In the phase plane of `u` and `z = u'^2`, where `dz/du = 2 u''`, both bounds are linear ([Bobrow 1985],
//! [Pham 2018]):
//!
//! - rate: `z <= (v / q')^2`,
//! - acceleration: `-a / |q'| - r z <= u'' <= a / |q'| - r z` with `r = q'' / q'`.
//!
//! On each part of the way `q'` and `q''` are taken as constant, those in its middle. Where the bounds of two axes exclude
//! each other `z` is too high, which gives a bound of `z` on the part. One pass from the end backwards finds the highest `z`
//! from which the rest can be braked; one forwards goes as fast as acceleration and that bound let it. Within a part both are
//! at constant acceleration, with a stretch at the highest rate between them where there is room, so that a ramp much shorter
//! than a part is timed as what it is. The error falls with the square of the length of parts; tests refine them.

use super::profile::Bounds;
use super::track::Part;

/// `-most <= u'' + lean z <= most`.
#[derive(Clone, Copy, Debug)]
struct Line {
    most: f64,
    lean: f64,
}

/// What bounds a part of the way.
#[derive(Clone, Copy, Debug)]
struct Segment<const N: usize> {
    length: f64,
    /// The highest `z`.
    cap: f64,
    /// Of the axes.
    lines: [Option<Line>; N],
    /// Of the path.
    along: Option<Line>,
}

/// Which way a pass goes.
#[derive(Clone, Copy, Debug)]
enum Pass {
    Forward,
    Backward,
}

/// A first derivative below this, in rad or mm a way, is none: the axis turns round.
const STILL: f64 = 1e-9;

/// How long a way takes from rest to rest, in s. `axes` bounds the axes, `path` the part that is done; `rate` is its highest
/// rate.
pub(super) fn duration<const N: usize>(
    parts: &[Part<N>],
    axes: &[Bounds; N],
    rate: f64,
    path: Bounds,
) -> f64 {
    let steps = steps(parts, axes, rate, path);
    steps.iter().map(|step| step.time).sum()
}

/// A part of the way as it is gone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// `z` at its end.
    pub(super) z: f64,
    /// In s.
    pub(super) time: f64,
}

/// The fastest way, part by part.
pub(super) fn steps<const N: usize>(
    parts: &[Part<N>],
    axes: &[Bounds; N],
    rate: f64,
    path: Bounds,
) -> Vec<Step> {
    let segments = parts.iter().map(|part| segment(part, axes, rate, path)).collect();
    // What bounds `z` changes evenly from part to part.
    gone(segments, f64::midpoint)
}

/// The fastest way where the bounds may change at once from one part to the next, as where pieces of a chain have speeds of
/// their own.
pub(super) fn steps_of_pieces<const N: usize>(parts: &[Part<N>], axes: &[Bounds; N]) -> Vec<Step> {
    let of_part = |part| segment(part, axes, f64::INFINITY, Bounds::default());
    gone(parts.iter().map(of_part).collect(), f64::min)
}

/// `between` gives the highest `z` where two parts meet, from that of either.
fn gone<const N: usize>(segments: Vec<Segment<N>>, between: fn(f64, f64) -> f64) -> Vec<Step> {
    let stoppable = stoppable(&segments, between);
    let mut z = 0.0;
    let step = |(segment, &most): (&Segment<N>, &f64)| {
        let up = segment.gain(z, Pass::Forward);
        let next = reached(z, up, segment.length, most);
        let time = segment.time(z, next, up);
        z = next;
        Step { z, time }
    };
    segments.iter().zip(stoppable.iter().skip(1)).map(step).collect()
}

/// The highest `z` at the ends of segments from which the rest of the way can be braked.
fn stoppable<const N: usize>(segments: &[Segment<N>], between: fn(f64, f64) -> f64) -> Vec<f64> {
    let mut z = 0.0;
    let mut highest = vec![z];
    for (index, segment) in segments.iter().enumerate().rev() {
        let before = index.checked_sub(1).and_then(|before| segments.get(before));
        let cap = before.map_or(0.0, |before| between(before.cap, segment.cap));
        z = reached(z, segment.gain(z, Pass::Backward), segment.length, cap);
        highest.push(z);
    }
    highest.reverse();
    highest
}

/// What `z` becomes over a length, at most `cap`.
fn reached(z: f64, gain: Option<f64>, length: f64, cap: f64) -> f64 {
    gain.map_or(cap, |gain| (z + 2.0 * length * gain).clamp(0.0, cap.max(0.0)))
}

fn segment<const N: usize>(part: &Part<N>, axes: &[Bounds; N], rate: f64, path: Bounds) -> Segment<N> {
    let mut cap = rate * rate;
    let mut lines = [None; N];
    let along = path.acceleration.map(|most| Line { most, lean: 0.0 });
    for ((slopes, bounds), line) in part.axes.iter().zip(axes).zip(&mut lines) {
        let steep = slopes.first.abs();
        if let Some(rate) = bounds.rate.filter(|_| steep > STILL) {
            let most = rate / steep;
            cap = cap.min(most * most);
        }
        if let Some(acceleration) = bounds.acceleration {
            if steep > STILL {
                *line = Some(Line {
                    most: acceleration / steep,
                    lean: slopes.second / slopes.first,
                });
            } else if slopes.second.abs() > STILL {
                cap = cap.min(acceleration / slopes.second.abs());
            }
        }
    }
    let all = || lines.iter().chain([&along]).flatten();
    for one in all() {
        for other in all().filter(|other| other.lean > one.lean) {
            cap = cap.min((one.most + other.most) / (other.lean - one.lean));
        }
    }
    Segment {
        length: part.length,
        cap,
        lines,
        along,
    }
}

impl<const N: usize> Segment<N> {
    /// The highest constant acceleration with which the segment can be entered at `z`, or left, going backwards; none where
    /// nothing bounds it.
    fn gain(&self, z: f64, pass: Pass) -> Option<f64> {
        let gains = self.lines.iter().chain([&self.along]).flatten().map(|line| {
            let lean = match pass {
                Pass::Forward => line.lean,
                Pass::Backward => -line.lean,
            };
            // With what z is in the middle of the segment, or at most the cap.
            let at_cap = line.most - lean * self.cap;
            let slower = 1.0 + self.length * lean;
            if slower <= 0.0 {
                return at_cap;
            }
            let in_middle = (line.most - lean * z) / slower;
            if lean > 0.0 {
                in_middle.max(at_cap)
            } else {
                in_middle.min(at_cap)
            }
        });
        gains.min_by(f64::total_cmp)
    }

    /// How long it takes from `z` to `next`.
    fn time(&self, z: f64, next: f64, up: Option<f64>) -> f64 {
        let down = self.gain(next, Pass::Backward);
        let (from, to) = (z.sqrt(), next.sqrt());
        let peak = match (up, down) {
            (None, None) => self.cap,
            (Some(up), None) => z + 2.0 * up * self.length,
            (None, Some(down)) => next + 2.0 * down * self.length,
            (Some(up), Some(down)) if up + down > 0.0 => {
                (2.0 * up * down * self.length + down * z + up * next) / (up + down)
            }
            (Some(_), Some(_)) => z.max(next),
        };
        // At its ends the cap is between those of the segment and its neighbour.
        let peak = peak.min(self.cap).max(z).max(next);
        let top = peak.sqrt();
        let (rise, rising) = ramp(z, from, peak, top, up);
        let (fall, falling) = ramp(next, to, peak, top, down);
        let left = self.length - rise - fall;
        if left >= -self.length * 1e-9 && rise >= 0.0 && fall >= 0.0 {
            rising + falling + left.max(0.0) / top
        } else {
            // Forced to slow down or to speed up all along.
            2.0 * self.length / (from + to)
        }
    }
}

/// Way and time of a ramp between two rates, given with their squares.
fn ramp(z: f64, from: f64, peak: f64, top: f64, gain: Option<f64>) -> (f64, f64) {
    match gain {
        Some(gain) if peak > z => ((peak - z) / (2.0 * gain), (top - from) / gain),
        Some(_) | None => (0.0, 0.0),
    }
}
