//! A way with bounds of jerk: a seven-segment profile that is proven to keep the bounds of all axes.
//!
//! The jerk of an axis is `q' u''' + 3 q'' u' u'' + q''' u'^3`. With a rate of at most `V`, an acceleration of at most `A` and
//! a jerk of at most `J` along the way, every axis keeps its bounds where
//!
//! - `|q'| V <= v`,
//! - `|q'| A + |q''| V^2 <= a`,
//! - `|q'| J + 3 |q''| V A + |q'''| V^3 <= j`,
//!
//! whatever the phase between them. The derivatives are the largest of where the profile needs them: for gathering speed on
//! the first stretch of the way, for braking on the last one, each no longer than the ramp itself; for the constant rate
//! between them, where `A = J = 0`, on all of it. A profile found so can be run, and is an upper bound of the least time;
//! without axes it is the least time. The time without bounds of jerk ([`super::phase`]) bounds it from below.
//!
//! Among these profiles the best is searched, and found within a hundredth:
//!
//! - What `A` leaves to jerk, `J(A)`, is the least of falling straight lines. Gathering `V` takes `V / A + A / J`, which is
//!   convex in `A`, as long as `A^2 <= V J`, and `2 sqrt(V / J)`, which grows with `A`, from there on. So the time has one
//!   valley, and a golden section comes to its bottom.
//! - A higher `V` leaves less to `A` and `J`, has more to gather and needs a longer stretch, so both ramps together take a time
//!   `R(V)` that never falls with `V`, and `V R(V)`, twice the way they need, grows. The whole takes `1 / V + R(V) / 2`: between
//!   two rates at least `1 / V` of the higher with `R` of the lower. Spans of rates are halved, the one with the lowest such
//!   bound first, until nothing is left that could be faster by more than that hundredth.

use super::profile::Bounds;
use super::track::{Part, Slopes};

/// By how much, of its own time, another ride can be faster than the one that is found.
pub(super) const NEAR: f64 = 0.01;
/// How often the highest rate is halved until one can be reached at all.
const MOST_HALVINGS: i32 = 64;
/// Steps of the golden section: they leave less than a ten-thousandth of the accelerations it begins with.
const SECTIONS: u32 = 20;
/// What a step of a golden section leaves, `(sqrt(5) - 1) / 2`.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The largest derivatives of the axes on a stretch.
type Largest<const N: usize> = [Slopes; N];

/// A way with what its axes do on ever longer stretches of it.
pub(super) struct Way<'a, const N: usize> {
    axes: &'a [Bounds; N],
    /// Of the part that is done.
    path: Bounds,
    /// From the start: how far, and the largest derivatives up to there.
    rise: Vec<(f64, Largest<N>)>,
    /// The same from the end.
    fall: Vec<(f64, Largest<N>)>,
}

/// An end of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Where speed is gathered.
    Start,
    /// Where it is braked.
    Finish,
}

/// How speed is gathered, or braked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    /// In s.
    pub(super) time: f64,
    /// Bounds of the part that is done, which the ramp makes the most of.
    pub(super) bounds: Bounds,
}

/// A way from rest to rest: a ramp, a constant rate, a ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ride {
    /// In s.
    pub(super) time: f64,
    /// Of the part that is done, between the ramps.
    pub(super) rate: f64,
    pub(super) rising: Ramp,
    pub(super) falling: Ramp,
}

/// Rates from that of a ride up to another.
struct Span {
    slowest: Ride,
    highest: f64,
}

impl Span {
    /// A time, in s, that no ride at one of the rates goes below.
    fn least(&self) -> f64 {
        let Ride { rising, falling, .. } = self.slowest;
        1.0 / self.highest + f64::midpoint(rising.time, falling.time)
    }
}

/// A ride along a way that no other of its kind is faster than by more than [`NEAR`]; none where no rate was found that can be
/// reached.
pub(super) fn ride<const N: usize>(
    parts: &[Part<N>],
    axes: &[Bounds; N],
    rate: f64,
    path: Bounds,
) -> Option<Ride> {
    let way = Way::new(parts, axes, path);
    let highest = way.highest(rate)?;
    let mut best = (0..MOST_HALVINGS).find_map(|halvings| way.ride(highest * 0.5_f64.powi(halvings)))?;
    // Slower than that a ride takes longer without any ramps.
    let mut spans: Vec<Span> = way
        .ride(1.0 / best.time)
        .map(|slowest| Span { slowest, highest })
        .into_iter()
        .collect();
    while let Some(open) = most_promising(&spans, best.time) {
        let Span { slowest, highest, .. } = spans.swap_remove(open);
        let middle = (slowest.rate * highest).sqrt();
        spans.push(Span {
            slowest,
            highest: middle,
        });
        if let Some(ride) = way.ride(middle) {
            spans.push(Span {
                slowest: ride,
                highest,
            });
            if ride.time < best.time {
                best = ride;
            }
        }
    }
    Some(best)
}

/// The span that may hold the fastest ride of all, if it can be worth a look.
fn most_promising(spans: &[Span], time: f64) -> Option<usize> {
    let (index, span) = spans
        .iter()
        .enumerate()
        .min_by(|(_, one), (_, other)| one.least().total_cmp(&other.least()))?;
    (span.least() < time * (1.0 - NEAR)).then_some(index)
}

/// Ever longer stretches with the largest derivatives on them.
fn stretches<'p, const N: usize>(parts: impl Iterator<Item = &'p Part<N>>) -> Vec<(f64, Largest<N>)> {
    let mut done = 0.0;
    let mut largest = [Slopes::default(); N];
    parts
        .map(|part| {
            done += part.length;
            let half = part.length / 2.0;
            for (largest, slopes) in largest.iter_mut().zip(&part.axes) {
                // From the middle of the part to its ends, by Taylor's theorem.
                let third = slopes.third.abs();
                let second = slopes.second.abs() + half * third;
                let first = slopes.first.abs() + half * second;
                *largest = Slopes {
                    first: largest.first.max(first),
                    second: largest.second.max(second),
                    third: largest.third.max(third),
                };
            }
            (done, largest)
        })
        .collect()
}

impl<'a, const N: usize> Way<'a, N> {
    pub(super) fn new(parts: &[Part<N>], axes: &'a [Bounds; N], path: Bounds) -> Self {
        Self {
            axes,
            path,
            rise: stretches(parts.iter()),
            fall: stretches(parts.iter().rev()),
        }
    }

    /// The highest constant rate.
    pub(super) fn highest(&self, rate: f64) -> Option<f64> {
        let (_, largest) = self.rise.last()?;
        let each = largest.iter().zip(self.axes).map(|(slopes, bounds)| {
            let over =
                |bound: Option<f64>, slope: f64| bound.filter(|_| slope > 0.0).map(|bound| bound / slope);
            let by_rate = over(bounds.rate, slopes.first);
            let by_acceleration = over(bounds.acceleration, slopes.second).map(f64::sqrt);
            let by_jerk = over(bounds.jerk, slopes.third).map(libm::cbrt);
            [by_rate, by_acceleration, by_jerk]
                .into_iter()
                .flatten()
                .fold(rate, f64::min)
        });
        Some(each.fold(rate, f64::min))
    }

    /// The way at a constant rate between two ramps; none where these do not fit.
    fn ride(&self, rate: f64) -> Option<Ride> {
        let rising = self.ramp([0.0, rate], End::Start)?;
        let falling = self.ramp([0.0, rate], End::Finish)?;
        let ramps = rising.time + falling.time;
        let left = 1.0 - rate * ramps / 2.0;
        (left >= 0.0).then(|| Ride {
            time: ramps + left / rate,
            rate,
            rising,
            falling,
        })
    }

    /// How a rate is gathered from another: on the shortest stretch that is as long as the ramp it allows. A longer stretch
    /// allows no shorter ramp, so those that are shorter than the ramp just found can be passed over.
    pub(super) fn ramp(&self, [from, rate]: [f64; 2], end: End) -> Option<Ramp> {
        let mut rest = match end {
            End::Start => self.rise.as_slice(),
            End::Finish => self.fall.as_slice(),
        };
        while let [(length, largest), ..] = rest {
            let ramp = self.gathering([from, rate], largest)?;
            let way = (from + rate) * ramp.time / 2.0;
            if way <= *length {
                return Some(ramp);
            }
            rest = rest.get(rest.partition_point(|(length, _)| *length < way)..)?;
        }
        None
    }

    /// The shortest ramp from one rate up to another where the derivatives are no larger than these.
    fn gathering(&self, [from, rate]: [f64; 2], largest: &Largest<N>) -> Option<Ramp> {
        let allowed = self.acceleration(rate, largest)?;
        // No more than what jerk alone gathers on the way to the rate.
        let gain = rate - from;
        let gathered = self.jerk(rate, 0.0, largest)?.map(|jerk| (jerk * gain).sqrt());
        let with = |acceleration: Option<f64>| {
            let jerk = self.jerk(rate, acceleration.unwrap_or(0.0), largest)?;
            let bounds = Bounds {
                rate: Some(rate),
                acceleration,
                jerk,
            };
            let time = bounds.gathering(gain);
            Some(Ramp { time, bounds })
        };
        let most = [allowed, gathered].into_iter().flatten().reduce(f64::min);
        most.map_or_else(
            || with(None),
            |most| in_the_valley(most, |acceleration| with(Some(acceleration))),
        )
    }

    /// The acceleration that a rate leaves, if any bounds it; nothing where it leaves none.
    #[expect(
        clippy::option_option,
        reason = "none at all, and none that bounds, are two answers"
    )]
    fn acceleration(&self, rate: f64, largest: &Largest<N>) -> Option<Option<f64>> {
        let each = largest.iter().zip(self.axes).filter_map(|(slopes, bounds)| {
            Some((bounds.acceleration? - slopes.second * rate * rate, slopes.first))
        });
        least(each, self.path.acceleration)
    }

    /// The jerk that a rate and an acceleration leave, in the same way.
    #[expect(
        clippy::option_option,
        reason = "none at all, and none that bounds, are two answers"
    )]
    fn jerk(&self, rate: f64, acceleration: f64, largest: &Largest<N>) -> Option<Option<f64>> {
        let each = largest.iter().zip(self.axes).filter_map(|(slopes, bounds)| {
            let bent = 3.0 * slopes.second * rate * acceleration + slopes.third * rate * rate * rate;
            Some((bounds.jerk? - bent, slopes.first))
        });
        least(each, self.path.jerk)
    }
}

/// The least of what is left to each axis over how far it goes, and of a bound of its own.
#[expect(
    clippy::option_option,
    reason = "none at all, and none that bounds, are two answers"
)]
fn least(each: impl Iterator<Item = (f64, f64)>, own: Option<f64>) -> Option<Option<f64>> {
    let mut bound = own;
    for (left, slope) in each {
        if left <= 0.0 {
            return None;
        }
        if slope > 0.0 {
            let most = left / slope;
            bound = Some(bound.map_or(most, |bound| bound.min(most)));
        }
    }
    Some(bound)
}

/// The shortest of the ramps up to an acceleration, whose times have one valley; where there is none the acceleration is too
/// high.
fn in_the_valley(most: f64, ramp: impl Fn(f64) -> Option<Ramp>) -> Option<Ramp> {
    let at = |acceleration: f64| (acceleration, ramp(acceleration));
    let (mut low, mut high) = (0.0, most);
    let mut lower = at(high - GOLDEN * (high - low));
    let mut upper = at(low + GOLDEN * (high - low));
    for _ in 0..SECTIONS {
        if matches!((lower.1, upper.1), (Some(lower), Some(upper)) if upper.time < lower.time) {
            low = lower.0;
            lower = upper;
            upper = at(low + GOLDEN * (high - low));
        } else {
            high = upper.0;
            upper = lower;
            lower = at(high - GOLDEN * (high - low));
        }
    }
    let found = [lower.1, upper.1, ramp(most)].into_iter().flatten();
    found.min_by(|one, other| one.time.total_cmp(&other.time))
}
