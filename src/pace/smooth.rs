//! A way with bounds of jerk: a seven-segment profile that is proven to keep the bounds of all axes.
//!
//! The jerk of an axis is `q' u''' + 3 q'' u' u'' + q''' u'^3`. With a rate of at most `V`, an acceleration of at most `A` and
//! a jerk of at most `J` along the way, every axis keeps its bounds where
//!
//! - `|q'| V <= v`,
//! - `|q'| A + |q''| V^2 <= a`,
//! - `|q'| J + 3 |q''| V A + |q'''| V^3 <= j`,
//!
//! whatever the phase between them. So each `V` leaves an `A`, and both leave a `J`. The derivatives are the largest of
//! where the profile needs them: for gathering speed on the first stretch of the way, for braking on the last one, each no
//! longer than the ramp itself; for the constant rate between them, where `A = J = 0`, on all of it. The best `V` is
//! searched; for each the acceleration that is allowed may be left in part to jerk. A profile found so can be run, and is an
//! upper bound of the least time; without axes it is the least time. The time without bounds of jerk ([`super::phase`]) bounds
//! it from below.

use super::profile::Bounds;
use super::track::{Part, Slopes};
use vcutc_backend_api::ir::MOST_AXES;

/// From one rate that is tried to the next.
const STEP: f64 = 0.8;
/// Most rates that are tried until one can be reached at all.
const MOST_TRIES: u32 = 200;
/// How many more are tried then.
const MORE_TRIES: u32 = 5;
/// How often the best of them is refined.
const REFINEMENTS: u32 = 5;
/// Shares of the acceleration that are tried; what is left of it is left to jerk.
const SHARES: [f64; 3] = [1.0, 0.6, 0.35];

/// The largest derivatives of the axes on a stretch.
type Largest = [Slopes; MOST_AXES];

/// A way with what its axes do on ever longer stretches of it.
struct Way<'a> {
    axes: &'a [Bounds; MOST_AXES],
    /// Of the part that is done.
    path: Bounds,
    /// From the start: how far, and the largest derivatives up to there.
    rise: Vec<(f64, Largest)>,
    /// The same from the end.
    fall: Vec<(f64, Largest)>,
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

/// The fastest ride along a way that was found; none where no rate was found that can be reached.
pub(super) fn ride(parts: &[Part], axes: &[Bounds; MOST_AXES], rate: f64, path: Bounds) -> Option<Ride> {
    let way = Way {
        axes,
        path,
        rise: stretches(parts.iter()),
        fall: stretches(parts.iter().rev()),
    };
    let highest = way.highest(rate)?;
    let mut found: Option<Ride> = None;
    let mut more = MORE_TRIES;
    let mut tried = highest;
    for _ in 0..MOST_TRIES {
        if found.is_some_and(|found| cannot_win(tried, &found)) {
            break;
        }
        found = better(found, way.ride(tried));
        if found.is_some() {
            match more.checked_sub(1) {
                Some(fewer) => more = fewer,
                None => break,
            }
        }
        tried *= STEP;
    }
    let mut step = 1.0 / STEP - 1.0;
    for _ in 0..REFINEMENTS {
        step /= 2.5;
        let rate = found?.rate;
        for tried in [rate * (1.0 + step), rate / (1.0 + step)] {
            let tried = tried.min(highest);
            if !found.is_some_and(|found| cannot_win(tried, &found)) {
                found = better(found, way.ride(tried));
            }
        }
    }
    found
}

/// Whether a rate takes longer without any ramps.
fn cannot_win(rate: f64, found: &Ride) -> bool {
    rate * found.time <= 1.0
}

fn better(best: Option<Ride>, other: Option<Ride>) -> Option<Ride> {
    match (best, other) {
        (Some(best), Some(other)) if other.time < best.time => Some(other),
        (None, other) => other,
        (best, _) => best,
    }
}

/// Ever longer stretches with the largest derivatives on them.
fn stretches<'p>(parts: impl Iterator<Item = &'p Part>) -> Vec<(f64, Largest)> {
    let mut done = 0.0;
    let mut largest = [Slopes::default(); MOST_AXES];
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

impl Way<'_> {
    /// The highest constant rate.
    fn highest(&self, rate: f64) -> Option<f64> {
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
        let rising = self.ramp(rate, &self.rise)?;
        let falling = self.ramp(rate, &self.fall)?;
        let ramps = rising.time + falling.time;
        let left = 1.0 - rate * ramps / 2.0;
        (left >= 0.0).then(|| Ride {
            time: ramps + left / rate,
            rate,
            rising,
            falling,
        })
    }

    /// How a rate is gathered: on the shortest stretch that is as long as the ramp it allows. A longer stretch allows no
    /// shorter ramp, so those that are shorter than the ramp just found can be passed over.
    fn ramp(&self, rate: f64, stretches: &[(f64, Largest)]) -> Option<Ramp> {
        let mut rest = stretches;
        while let [(length, largest), ..] = rest {
            let ramp = self.gathering(rate, largest)?;
            let way = rate * ramp.time / 2.0;
            if way <= *length {
                return Some(ramp);
            }
            rest = rest.get(rest.partition_point(|(length, _)| *length < way)..)?;
        }
        None
    }

    fn gathering(&self, rate: f64, largest: &Largest) -> Option<Ramp> {
        let allowed = self.acceleration(rate, largest)?;
        // No more than what jerk alone gathers on the way to the rate.
        let gathered = self.jerk(rate, 0.0, largest)?.map(|jerk| (jerk * rate).sqrt());
        let most = match (allowed, gathered) {
            (Some(allowed), Some(gathered)) => Some(allowed.min(gathered)),
            (one, None) | (None, one) => one,
        };
        let ramps = SHARES.iter().filter_map(|share| {
            let acceleration = most.map(|most| most * share);
            let jerk = self.jerk(rate, acceleration.unwrap_or(0.0), largest)?;
            let bounds = Bounds {
                rate: Some(rate),
                acceleration,
                jerk,
            };
            let time = bounds.gathering(rate);
            Some(Ramp { time, bounds })
        });
        ramps.min_by(|one, other| one.time.total_cmp(&other.time))
    }

    /// The acceleration that a rate leaves, if any bounds it; nothing where it leaves none.
    #[expect(
        clippy::option_option,
        reason = "none at all, and none that bounds, are two answers"
    )]
    fn acceleration(&self, rate: f64, largest: &Largest) -> Option<Option<f64>> {
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
    fn jerk(&self, rate: f64, acceleration: f64, largest: &Largest) -> Option<Option<f64>> {
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
