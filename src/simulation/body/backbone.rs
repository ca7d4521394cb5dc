//! How high the work stands along y, where the cuts that leave it follow a spine.

use super::slant::Slant;
use super::stage::{Axis, Cylinder};
use crate::course::Way;
use vcutc_backend_api::ir::Program;
use vcutc_geometry::spine::Spine;

/// The spine of the cuts of a program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Backbone<'s> {
    spine: &'s Spine,
    /// How far what is left may stand above the section on the spine.
    above: f64,
}

impl<'s> Backbone<'s> {
    pub(super) fn new(spine: &'s Spine, program: &Program) -> Self {
        Self {
            spine,
            above: spine.left_above(program.longest_edge(), program.blend),
        }
    }

    /// Of work that is nowhere above its section on the spine.
    #[cfg(test)]
    pub(super) const fn exact(spine: &'s Spine) -> Self {
        Self { spine, above: 0.0 }
    }

    /// The highest place of the work above its section.
    pub(super) fn highest(&self) -> f64 {
        self.spine.highest(0.0, self.spine.depth()) + self.above
    }

    /// The slant of the work below some cylinders on a way: along the spine in the middle of the way, raised above the
    /// spine wherever one of them may be.
    pub(super) fn slant(&self, stages: &[Cylinder], axis: Axis, way: Way) -> Slant {
        let spine = self.spine;
        let middle = f64::midpoint(way.from.y, way.to.y).clamp(0.0, spine.depth());
        let slope = spine.slope(middle);
        let reach = stages
            .iter()
            .map(|stage| stage.reach_along(axis))
            .fold(0.0, f64::max);
        let [from, to] = [way.from.y.min(way.to.y) - reach, way.from.y.max(way.to.y) + reach]
            .map(|y| y.clamp(0.0, spine.depth()));
        let line = |y: f64| spine.rise(middle) + slope * (y - middle);
        let within = spine.knots().iter().filter(|knot| from < knot.y && knot.y < to);
        let places = within.map(|knot| knot.y).chain([from, to]);
        let excess = places.map(|y| spine.rise(y) - line(y)).fold(0.0, f64::max);
        Slant::of(slope, line(0.0) + excess + self.above)
    }
}
