//! The pieces of strokes, as plain data that affine maps act upon.
//!
//! Lines, Bezier curves and B-splines are mapped by their points, ellipses by their half-diameters. An arc stays an arc
//! under moves, turns, mirrors and even scaling; stretched it becomes an ellipse.

use super::Affine;
use crate::curve::{Curve, CurveError, Nurbs, NurbsError, Point2};
use vcutc_backend_api::units::Angle;

/// Arcs that turn through less are straight when they are stretched: their centre is out of range. In rad.
const STRAIGHT: f64 = 1e-8;

/// A piece of a stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Straight lines from point to point.
    Polyline(Vec<Point2>),
    /// A circular arc by its ends and the angle it turns through, to the left where it is positive.
    Arc {
        /// Where it starts.
        from: Point2,
        to: Point2,
        /// The angle, in rad; less than a whole turn.
        sweep: f64,
    },
    /// An arc of the ellipse `center + half[0] cos t + half[1] sin t`.
    Ellipse {
        /// Its centre.
        center: Point2,
        /// Conjugate half-diameters.
        half: [Point2; 2],
        /// The parameter at which it starts, in rad.
        start: f64,
        /// How far it goes, in rad; a whole turn at most.
        sweep: f64,
    },
    /// A Bezier curve by its control points.
    Bezier(Vec<Point2>),
    /// A B-spline.
    Nurbs(Nurbs),
}

/// What is wrong with a shape that should be a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ShapeError {
    Curve(CurveError),
    Nurbs(NurbsError),
}

impl Shape {
    /// A whole circle, from its rightmost point round to it, as two arcs.
    pub(in super::super) fn circle(center: Point2, radius: f64) -> Vec<Self> {
        let right = Point2::new(center.x + radius, center.z);
        let left = Point2::new(center.x - radius, center.z);
        let half = |from, to| Self::Arc {
            from,
            to,
            sweep: core::f64::consts::PI,
        };
        vec![half(right, left), half(left, right)]
    }

    /// The shape after a map.
    #[must_use]
    pub fn mapped(self, map: Affine) -> Self {
        let all = |points: Vec<Point2>| points.into_iter().map(|point| map.point(point)).collect();
        match self {
            Self::Polyline(points) => Self::Polyline(all(points)),
            Self::Bezier(points) => Self::Bezier(all(points)),
            Self::Nurbs(nurbs) => Self::Nurbs(Nurbs {
                control: all(nurbs.control),
                ..nurbs
            }),
            Self::Ellipse {
                center,
                half,
                start,
                sweep,
            } => Self::Ellipse {
                center: map.point(center),
                half: half.map(|vector| map.vector(vector)),
                start,
                sweep,
            },
            Self::Arc { from, to, sweep } if map.is_similarity() => Self::Arc {
                from: map.point(from),
                to: map.point(to),
                sweep: if map.keeps_sense() { sweep } else { -sweep },
            },
            Self::Arc { from, to, sweep } => match center_of_arc(from, to, sweep) {
                Some(center) => as_ellipse(center, from, sweep).mapped(map),
                None => Self::Polyline(vec![map.point(from), map.point(to)]),
            },
        }
    }

    pub(super) fn curve(&self) -> Result<Curve, ShapeError> {
        let curve = match self {
            Self::Polyline(points) => Curve::polyline(points.clone()),
            Self::Arc { from, to, sweep } => Curve::arc_by_sweep(*from, *to, Angle::rad(*sweep)),
            Self::Ellipse {
                center,
                half,
                start,
                sweep,
            } => Curve::elliptic_arc(*center, *half, Angle::rad(*start), Angle::rad(*sweep)),
            Self::Bezier(points) => Curve::bezier(points.clone()),
            Self::Nurbs(nurbs) => return Curve::nurbs(nurbs).map_err(ShapeError::Nurbs),
        };
        curve.map_err(ShapeError::Curve)
    }
}

/// The centre of an arc: it lies on the bisector of the chord, half the chord over the tangent of half the angle to the
/// left. None for arcs that are as good as straight.
pub(super) fn center_of_arc(from: Point2, to: Point2, sweep: f64) -> Option<Point2> {
    if sweep.abs() < STRAIGHT {
        return None;
    }
    let chord = to.minus(from);
    let height = 0.5 / libm::tan(sweep / 2.0);
    let middle = from.lerp(to, 0.5);
    Some(Point2::new(
        middle.x - chord.z * height,
        middle.z + chord.x * height,
    ))
}

/// An arc as one of an ellipse.
fn as_ellipse(center: Point2, from: Point2, sweep: f64) -> Shape {
    let first = from.minus(center);
    Shape::Ellipse {
        center,
        half: [first, Point2::new(-first.z, first.x)],
        start: 0.0,
        sweep,
    }
}
