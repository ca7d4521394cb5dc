//! The two coordinates in which shapes are searched.
//!
//! Tangent `t`, share `rho` and aspect `u = rho t` each have a range, and any two decide the third. Taking the two with the
//! narrowest ranges as coordinates keeps the third from cutting a thin strip out of their rectangle: a given swing, a given
//! overlap, or a given layer and step (which fix `u`) are sides of the rectangle, never a curve across it.

use super::formulas::{Model, Shape, Tooth};
use vcutc_geometry::number::{Interval, Scalar};

/// Which two of the three are coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Plane {
    TangentShare,
    TangentAspect,
    ShareAspect,
}

/// The coordinates of a stretch of the reach's saw-tooth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    plane: Plane,
    /// Ranges of the coordinates.
    pub(super) sides: [Interval; 2],
    /// The range of the third.
    third: [f64; 2],
}

impl Chart {
    /// For the shapes of one stretch, if there are any.
    pub(super) fn new(model: &Model, tooth: Tooth) -> Option<Self> {
        let share = model.shares_of(tooth);
        let (tangent, aspect) = (model.ranges.tangent, model.ranges.aspect);
        let wide = |[low, high]: [f64; 2]| high / low;
        let plane = if wide(aspect) >= wide(tangent) && wide(aspect) >= wide(share) {
            Plane::TangentShare
        } else if wide(share) >= wide(tangent) {
            Plane::TangentAspect
        } else {
            Plane::ShareAspect
        };
        let (first, second, third) = match plane {
            Plane::TangentShare => (tangent, share, aspect),
            Plane::TangentAspect => (tangent, aspect, share),
            Plane::ShareAspect => (share, aspect, tangent),
        };
        let side = |[low, high]: [f64; 2]| Interval { low, high };
        [first, second, third]
            .iter()
            .all(|[low, high]| low <= high)
            .then(|| Self {
                plane,
                sides: [side(first), side(second)],
                third,
            })
    }

    /// The shape at two coordinates.
    pub(super) fn shape<N: Scalar>(&self, first: N, second: N) -> Shape<N> {
        match self.plane {
            Plane::TangentShare => Shape {
                tangent: first,
                share: second,
                aspect: first * second,
            },
            Plane::TangentAspect => Shape {
                tangent: first,
                share: second / first,
                aspect: second,
            },
            Plane::ShareAspect => Shape {
                tangent: second / first,
                share: first,
                aspect: second,
            },
        }
    }

    /// The coordinates of a shape.
    pub(super) const fn place(&self, shape: Shape<f64>) -> [f64; 2] {
        match self.plane {
            Plane::TangentShare => [shape.tangent, shape.share],
            Plane::TangentAspect => [shape.tangent, shape.aspect],
            Plane::ShareAspect => [shape.share, shape.aspect],
        }
    }

    /// By how much the third keeps its range, as shares of its ends.
    pub(super) fn slack<N: Scalar>(&self, shape: Shape<N>) -> [N; 2] {
        let third = match self.plane {
            Plane::TangentShare => shape.aspect,
            Plane::TangentAspect => shape.share,
            Plane::ShareAspect => shape.tangent,
        };
        let [low, high] = self.third;
        [third.times(1.0 / low).plus(-1.0), third.under(high).plus(-1.0)]
    }
}
