//! Ways on which the blade turns, or whose tip goes on an arc.

#[cfg(test)]
mod tests;

use super::TOUCH;
use super::section::{Near, Section};
use super::stage::{Axis, Cylinder};
use crate::course::{Course, Span};

/// A body that comes no farther into the work than this on such a way may not be found, in mm.
const RESOLUTION: f64 = 0.01;

/// Spans are halved no more often than this.
const MOST_HALVINGS: u32 = 20;

/// Where the axis may rise less than that, a span is halved unseen: what is grown so much proves nothing.
const LEAST_RISE: f64 = 0.1;

/// A place where one of some cylinders enters the section; none is proven to, but for [`RESOLUTION`].
pub(super) fn entry(course: &Course, stages: &[Cylinder], section: &mut Section<'_>) -> Option<Near> {
    let mut open = vec![(Span::WHOLE, MOST_HALVINGS)];
    while let Some((span, halvings)) = open.pop() {
        let stretch = course.stretch(span);
        let axis = Axis::of(stretch.held);
        // No point of the axis gets farther from where it is in the middle than the angle times its distance.
        let least_rise = axis.rise() - stretch.turned();
        let lowest = stretch.way.lowest() - stretch.tip_off;
        let low = stages
            .iter()
            .map(|stage| stage.below(section.highest(), lowest, least_rise));
        let low: Vec<Cylinder> = low.collect();
        let farthest = low.iter().map(|stage| stage.reach()).fold(0.0, f64::max);
        let off = stretch.off(farthest);
        let grown = grown_by(&low, off);
        if least_rise > LEAST_RISE && section.nearest(&grown, axis, stretch.way, -TOUCH).is_none() {
            continue;
        }
        let middle = course.middle(span);
        let there = grown_by(&low, middle.tip_off);
        if let Some(near) = section.nearest(&there, axis, middle.way, -TOUCH) {
            return Some(near);
        }
        if off - middle.tip_off > RESOLUTION && halvings > 0 {
            open.extend(span.halves().map(|half| (half, halvings - 1)));
        }
    }
    None
}

fn grown_by(stages: &[Cylinder], by: f64) -> Vec<Cylinder> {
    stages.iter().map(|stage| stage.grown(by)).collect()
}
