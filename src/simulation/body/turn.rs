//! Ways on which the blade turns.

use super::TOUCH;
use super::section::{Near, Section};
use super::stage::{Axis, Cylinder, Way};
use vcutc_backend_api::geometry::Orientation;

/// A straight way of the tip on which the blade turns about one axis.
#[derive(Clone, Copy)]
pub(super) struct Turning {
    pub(super) from: Orientation,
    pub(super) to: Orientation,
    pub(super) way: Way,
}

/// A share of a way.
#[derive(Clone, Copy)]
struct Span {
    from: f64,
    to: f64,
}

impl Span {
    fn middle(self) -> f64 {
        f64::midpoint(self.from, self.to)
    }

    fn halves(self) -> [Self; 2] {
        let middle = self.middle();
        [Self { to: middle, ..self }, Self { from: middle, ..self }]
    }
}

/// A body that comes no farther into the work than this while the blade turns may not be found, in mm.
const RESOLUTION: f64 = 0.01;

/// Spans are halved no more often than this.
const MOST_HALVINGS: u32 = 20;

/// Where the axis may rise less than that, a span is halved unseen: what is grown so much proves nothing.
const LEAST_RISE: f64 = 0.1;

impl Turning {
    /// A place where one of some cylinders enters the section; none is proven to, but for [`RESOLUTION`].
    pub(super) fn entry(&self, stages: &[Cylinder], section: &mut Section<'_>) -> Option<Near> {
        let turn = self.from.angle_to(self.to).to_rad();
        let mut open = vec![(Span { from: 0.0, to: 1.0 }, MOST_HALVINGS)];
        while let Some((span, halvings)) = open.pop() {
            let half_turn = turn * (span.to - span.from) / 2.0;
            let axis = Axis::of(self.from.towards(self.to, span.middle()));
            let way = self.way.part(span.from, span.to);
            // No point of the axis gets farther from where it is in the middle than the angle times its distance.
            let least_rise = axis.rise() - half_turn;
            let low = stages
                .iter()
                .map(|stage| stage.below(section.ceiling.highest(), way.lowest(), least_rise));
            let low: Vec<Cylinder> = low.collect();
            let farthest = low.iter().map(|stage| stage.reach()).fold(0.0, f64::max);
            let moved = farthest * half_turn;
            let grown: Vec<Cylinder> = low.iter().map(|stage| stage.grown(moved)).collect();
            if least_rise > LEAST_RISE && section.nearest(&grown, axis, way, -TOUCH).is_none() {
                continue;
            }
            let middle = self.way.part(span.middle(), span.middle());
            if let Some(near) = section.nearest(&low, axis, middle, -TOUCH) {
                return Some(near);
            }
            if moved > RESOLUTION && halvings > 0 {
                open.extend(span.halves().map(|half| (half, halvings - 1)));
            }
        }
        None
    }
}
