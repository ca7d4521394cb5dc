//! The profile with an allowance on top.
//!
//! The offset by a distance `a` is the upper boundary of the region below the profile, grown by a disc of radius `a`:
//! `P_a(x) = max over |t| <= a of P(x + t) + sqrt(a^2 - t^2)`, where x + t stays within the profile's span. It is the
//! upper envelope of one cap for each segment: the segment shifted along its normal, with a quarter disc or less
//! around either end.
//!
//! # Why one pass is enough
//!
//! Let `A` lie left of `B`, both segments of the profile, and `g_A`, `g_B` be their caps. Then `g_B - g_A` never
//! decreases with x: the heights that two points `q` of `A` and `r` of `B` reach are `q_z + h(x - q_x)` and
//! `r_z + h(x - r_x)` with the same concave `h(t) = sqrt(a^2 - t^2)`, and for `q_x <= r_x` and `x_1 <= x_2` concavity
//! gives `h(x_1 - q_x) + h(x_2 - r_x) >= h(x_2 - q_x) + h(x_1 - r_x)`. So the caps change places once at most, the
//! later one being higher to the right. Caps are taken in order; a new one removes those at the end of the envelope
//! that it covers from their start, then takes over from the last one where both cross. Every cap comes and goes
//! once. Grooves narrower than the disc, and segments shorter than its radius, need no care of their own.

mod cap;

use super::point::{LARGEST_COORDINATE, Point2};
use super::profile::{Profile, least_step};
use cap::Cap;
use vcutc_backend_api::units::Length;

/// How far above the true offset the result may be, in mm, measured along the normal.
const TOLERANCE: f64 = 1e-3;

/// Share of the tolerance that is spent on arcs; the rest is for rounding.
const SPENT: f64 = 0.9;

/// For spans above 1 km the tolerance grows with the span, as do the sizes of things. It bounds the number of points.
const TOLERANCE_SHARE: f64 = 1e-9;

/// Halvings that find where two caps cross: as many as a double has digits, and some more.
const HALVINGS: usize = 64;

/// A cap that forms the envelope from `start` to where the next one starts.
struct Stretch {
    cap: Cap,
    start: f64,
}

/// The profile raised by a distance measured along its normal: the upper boundary of everything that is nearer to the
/// part than `distance`, over the profile's span. The result is never below the true offset and at most 1 um above
/// it, along the normal (arcs at convex corners become tangent polygons; for spans above 1 km, one part in
/// 10^9 of the span). A distance of zero or less gives the profile itself; the largest is
/// the largest coordinate.
#[must_use]
pub fn offset_up(profile: &Profile, distance: Length) -> Profile {
    let radius = distance.to_mm().min(LARGEST_COORDINATE);
    if !(radius > 0.0 && distance.is_finite()) {
        return profile.clone();
    }
    let (start, end) = profile.span();
    let tolerance = SPENT * TOLERANCE.max(TOLERANCE_SHARE * (end - start));
    let stretches = envelope(profile, radius);
    let mut out = Outline::default();
    let ends = stretches.iter().skip(1).map(|next| next.start).chain([end]);
    for (stretch, to) in stretches.iter().zip(ends) {
        // Without the end: the next stretch starts there, and at a steep crossing it is the one that is not below.
        stretch
            .cap
            .outline(stretch.start, to, tolerance, &mut |point| out.push(point));
    }
    if let Some(last) = stretches.last() {
        out.push(last.cap.at(end));
    }
    Profile::from_ascending(out.ending_at(end))
}

/// The caps that form the upper envelope, from left to right.
fn envelope(profile: &Profile, radius: f64) -> Vec<Stretch> {
    let (span_start, span_end) = profile.span();
    let mut stretches: Vec<Stretch> = Vec::new();
    for segment in profile.segments() {
        let cap = Cap::over(segment, radius);
        // Where the new cap is known to be the higher one, if it ever is.
        let mut higher_from = cap.fully_raised_from().min(span_end);
        let start = loop {
            match stretches.last() {
                None => break Some(span_start),
                Some(last) if cap.height(last.start) >= last.cap.height(last.start) => {
                    higher_from = last.start;
                    stretches.pop();
                }
                Some(last) => break crossing(&last.cap, &cap, last.start, higher_from),
            }
        };
        if let Some(start) = start {
            stretches.push(Stretch { cap, start });
        }
    }
    stretches
}

/// Where `new` overtakes `old`, between a place where it is lower and one where it may be higher; none when it is
/// lower there too.
fn crossing(old: &Cap, new: &Cap, lower_at: f64, higher_at: f64) -> Option<f64> {
    let overtakes = |x: f64| new.height(x) >= old.height(x);
    if higher_at <= lower_at || !overtakes(higher_at) {
        return None;
    }
    let (mut low, mut high) = (lower_at, higher_at);
    for _ in 0..HALVINGS {
        let middle = low + (high - low) / 2.0;
        if overtakes(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

/// The polyline in the making.
#[derive(Default)]
struct Outline(Vec<Point2>);

impl Outline {
    /// Appends a point. Where x does not advance enough (next to a wall) it is moved right by the least step of a
    /// profile: a picometre.
    fn push(&mut self, point: Point2) {
        let Some(last) = self.0.last() else {
            self.0.push(point);
            return;
        };
        let least = least_step(point.x);
        if point.x - last.x >= least {
            self.0.push(point);
        } else if (point.z - last.z).abs() >= least {
            self.0.push(Point2::new(last.x + 2.0 * least, point.z));
        }
    }

    /// The points, the last one at exactly `end`.
    fn ending_at(mut self, end: f64) -> Vec<Point2> {
        if let Some(last) = self.0.pop() {
            while self.0.len() > 1 && self.0.last().is_some_and(|p| p.x > end - least_step(end)) {
                self.0.pop();
            }
            self.0.push(Point2::new(end, last.z));
        }
        self.0
    }
}

#[cfg(test)]
mod tests;
