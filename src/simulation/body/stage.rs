//! A stage of a body as the blade is held, cut off where it cannot come near the work.

use super::shadow::{Ellipse, Shadow};
use super::slant::Slant;
use crate::course::Way;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{BodyStage, Stage, Stock};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

/// Nothing of a body is longer, in mm.
const LONGEST: Length = Length::mm(100_000.0);

/// A stage of a body: a cylinder about the blade's axis, seen from the tip. In mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cylinder {
    from: f64,
    to: f64,
    radius: f64,
}

impl Cylinder {
    /// The stages of a body.
    pub(super) fn all(body: &[BodyStage]) -> Vec<Self> {
        let stages = Stage::all(body, LONGEST);
        stages.into_iter().map(Self::from).collect()
    }

    /// A cylinder that all points no farther than this from it lie in. With a negative number, the one of its points that lie so deep
    /// in it; where there are none, the nearest that there is to that: a disc in its middle, or its axis.
    pub(super) fn grown(self, by: f64) -> Self {
        let middle = f64::midpoint(self.from, self.to);
        Self {
            from: (self.from - by).min(middle),
            to: (self.to + by).max(middle),
            radius: (self.radius + by).max(0.0),
        }
    }

    /// The farthest that any of its points is from the tip.
    pub(super) fn reach(self) -> f64 {
        libm::hypot(self.to, self.radius)
    }

    /// What of it may come as low as a height, with the tip no lower than this and the axis rising at least so much; its lower
    /// end stays.
    pub(super) fn below(self, height: f64, lowest_tip: f64, rise: f64) -> Self {
        if rise <= 0.0 {
            return self;
        }
        let end = (height - lowest_tip + self.radius) / rise;
        Self {
            to: self.to.min(self.from.max(end)),
            ..self
        }
    }

    /// What of it comes over the stock, seen along x and z, on a way of the tip; none where all of it passes before or behind.
    fn over_stock(self, axis: Axis, way: Way, stock: Stock) -> Option<Self> {
        let [_, y, _] = axis.0;
        let half = self.radius * (1.0 - y * y).max(0.0).sqrt();
        let near = way.from.y.min(way.to.y) - half;
        let far = way.from.y.max(way.to.y) + half;
        // Discs with y from `near + s y` to `far + s y` touch the stock from 0 to its depth.
        let (enters, leaves) = (-far, stock.depth.to_mm() - near);
        let (from, to) = if y.abs() * self.reach() < 1e-9 {
            if enters > 0.0 || leaves < 0.0 {
                return None;
            }
            (self.from, self.to)
        } else {
            let ends = [enters / y, leaves / y];
            let [first, second] = if y > 0.0 { ends } else { [ends[1], ends[0]] };
            (self.from.max(first), self.to.min(second))
        };
        (from <= to).then_some(Self { from, to, ..self })
    }

    /// How far any of its points is from the tip along y at most.
    pub(super) fn reach_along(self, axis: Axis) -> f64 {
        let [_, y, _] = axis.0;
        self.to * y.abs() + self.radius
    }

    /// What it covers of the section on a way of the tip with the blade held like this: all of it that comes over the stock
    /// at some place of the way, seen along a slant.
    pub(super) fn shadow(self, axis: Axis, way: Way, stock: Stock, slant: Slant) -> Option<Shadow> {
        let over = self.over_stock(axis, way, stock)?;
        let [x, y, z] = axis.0;
        let rise = z - slant.slope * y;
        let above = |tip: Point3| tip.z - slant.height(tip.y);
        let start = Point2::new(way.from.x + over.from * x, above(way.from) + over.from * rise);
        let length = over.to - over.from;
        let along = [
            Point2::new(length * x, length * rise),
            Point2::new(way.to.x - way.from.x, above(way.to) - above(way.from)),
        ];
        let ellipse = Ellipse::of_disc(over.radius, axis.0, slant.slope);
        Some(Shadow::new(ellipse, start, along))
    }
}

impl From<Stage> for Cylinder {
    fn from(stage: Stage) -> Self {
        let [from, to] = stage.heights.map(Length::to_mm);
        let radius = stage.radius.to_mm();
        Self { from, to, radius }
    }
}

/// The unit vector from the tip to the shank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis(pub(super) [f64; 3]);

impl Axis {
    pub(super) fn of(held: Orientation) -> Self {
        let m = held.matrix();
        Self([-m[0][2], -m[1][2], -m[2][2]])
    }

    /// How much it rises for each millimetre.
    pub(super) const fn rise(self) -> f64 {
        let [_, _, z] = self.0;
        z
    }
}
