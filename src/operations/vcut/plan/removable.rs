//! What an operation is to take away: all that lies above the part, its allowance and its standoff.
//!
//! The job itself keeps the blade off the part by these two, both along the part's normal. So what lies below
//! them is not a fault of a plan, and what lies above them and stays is what the plan did not take.

use crate::asked::RoughVcut;
use vcutc_backend_api::units::{Area, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::offset::offset_up;
use vcutc_geometry::profile::Profile;

/// The least that one operation leaves, whatever its plan.
#[derive(Clone, Debug)]
pub struct Removable {
    kept: Profile,
    contour: Length,
}

impl Removable {
    /// Of an operation on this part.
    #[must_use]
    pub fn new(part: &Profile, asked: &RoughVcut) -> Self {
        Self {
            kept: offset_up(part, asked.allowance.value + standoff(asked)),
            contour: part.arc_length(),
        }
    }

    /// How much of what lies under a contour is to be taken away.
    #[must_use]
    pub fn under(&self, contour: &[Point2]) -> Area {
        Area::mm2(area_between(contour, &self.kept))
    }

    /// The same as a mean depth along the part.
    #[must_use]
    pub fn depth_under(&self, contour: &[Point2]) -> Length {
        Length::mm(self.under(contour).to_mm2() / self.contour.to_mm())
    }
}

/// The standoff that an operation comes to.
#[must_use]
pub fn standoff(asked: &RoughVcut) -> Length {
    asked.standoff.value.or(asked.blade.thickness.value / 2.0)
}

/// The area under a contour that lies above a profile, both over the same span.
fn area_between(contour: &[Point2], below: &Profile) -> f64 {
    let mut xs: Vec<f64> = contour
        .iter()
        .chain(below.points())
        .map(|point| point.x)
        .collect();
    xs.sort_by(f64::total_cmp);
    xs.dedup();
    let mut upper = Along::new(contour);
    let mut lower = Along::new(below.points());
    let gaps: Vec<(f64, f64)> = xs
        .into_iter()
        .map(|x| (x, upper.height(x) - lower.height(x)))
        .collect();
    gaps.iter().zip(gaps.iter().skip(1)).map(positive_strip).sum()
}

/// The part above zero of what lies between two places, the gap a straight line between them.
fn positive_strip((&(from, one), &(to, other)): (&(f64, f64), &(f64, f64))) -> f64 {
    let width = to - from;
    match (one > 0.0, other > 0.0) {
        (true, true) => width * (one + other) / 2.0,
        (true, false) => width * one / (one - other) * one / 2.0,
        (false, true) => width * other / (other - one) * other / 2.0,
        (false, false) => 0.0,
    }
}

/// A polyline asked for its heights from left to right.
struct Along<'p> {
    points: &'p [Point2],
    at: usize,
}

impl<'p> Along<'p> {
    const fn new(points: &'p [Point2]) -> Self {
        Self { points, at: 0 }
    }

    /// The height at a place right of all asked for before; beyond the ends, that of the end.
    fn height(&mut self, x: f64) -> f64 {
        while self.points.get(self.at + 1).is_some_and(|next| next.x < x) {
            self.at += 1;
        }
        match self.points.get(self.at..) {
            Some([from, to, ..]) if x > from.x => {
                let share = ((x - from.x) / (to.x - from.x)).min(1.0);
                from.z + (to.z - from.z) * share
            }
            Some([first, ..]) => first.z,
            Some([]) | None => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn line(heights: &[f64], width: f64) -> Vec<Point2> {
        let last = (heights.len() - 1) as f64;
        let place = |(index, &z): (usize, &f64)| Point2 {
            x: width * index as f64 / last,
            z,
        };
        heights.iter().enumerate().map(place).collect()
    }

    proptest! {
        #[test]
        fn areas_are_those_of_many_thin_strips(upper in prop::collection::vec(0.0..50.0_f64, 2..9), lower in prop::collection::vec(0.0..50.0_f64, 2..9)) {
            let (contour, below) = (line(&upper, 100.0), line(&lower, 100.0));
            let below = Profile::new(below).unwrap();
            let above = Profile::new(contour.clone()).unwrap();
            let strips = 20_000_u32;
            let by_strips: f64 = (0..strips)
                .map(|strip| (f64::from(strip) + 0.5) * 100.0 / f64::from(strips))
                .map(|x| (above.height(x) - below.height(x)).max(0.0) * 100.0 / f64::from(strips))
                .sum();
            prop_assert!((area_between(&contour, &below) - by_strips).abs() < 0.02, "{by_strips}");
        }
    }
}
