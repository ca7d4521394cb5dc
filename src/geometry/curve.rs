//! Curves of a profile, and their polylines.
//!
//! A [`Curve`] starts at its first point and ends at its last. [`Curve::flatten`] turns it into a polyline that
//! stays within a tolerance of it. The bound is proven for each kind:
//!
//! * **line, polyline**: exact;
//! * **arc**: the sagitta of every chord, `2 r sin^2(a/4)` for a chord over the angle `a`, is at most the tolerance;
//! * **Bezier curve** of degree `n` (and the cubics of a **spline**): a piece with control points `P_i` is at most
//!   `n (n-1)/8 max |P_i - 2 P_(i+1) + P_(i+2)|` off its chord. (The factor `n (n-1)` times the second differences
//!   bounds the second derivative, and a function is at most `max |f''| / 8` off its chord over the unit interval.)
//! * **elliptic arc**: half the longer axis times `h^2 / 8` for a chord over the parameter `h` (see `ellipse`);
//! * **B-spline**: cut into Bezier curves at its knots; rational ones by the hull of their control points (see
//!   `rational`).
//!
//! All bounds hold up to the rounding of the coordinates themselves.

mod arc;
mod bezier;
mod ellipse;
mod halving;
mod nurbs;
mod rational;
mod sample;
mod spline;

pub use super::point::{LARGEST_COORDINATE, Point2};
pub use nurbs::{Nurbs, NurbsError};
pub use sample::{MOST_SAMPLES, SampleError, sample};

use arc::Arc;
use bezier::Bezier;
use ellipse::EllipticArc;
use nurbs::Pieces;
use rational::Rational;
use vcutc_backend_api::units::{Angle, Length};

/// Most control points of a Bezier curve, its ends included.
pub const MOST_CONTROL_POINTS: usize = 64;

/// Most points that one curve may be flattened into.
pub const MOST_POINTS: usize = 2_000_000;

/// Points closer than this count as one, in mm. Far below any tolerance, far above rounding.
pub(super) const COINCIDENT: f64 = 1e-9;

/// Arcs that turn through less are straight, in rad.
const STRAIGHT: f64 = 1e-9;

/// Smallest tolerance that is honoured, in mm; smaller ones are raised to it.
const FINEST_TOLERANCE: f64 = 1e-9;

/// A piece of a profile, checked when it is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// Straight from corner to corner; at least two.
    Polyline(Vec<Point2>),
    Arc(Arc),
    Ellipse(EllipticArc),
    Bezier(Bezier),
    /// The Bezier curves of a spline, end to end; at least one.
    Spline(Vec<Bezier>),
    /// Those of a spline with weights.
    Rational(Vec<Rational>),
}

/// Why a curve cannot be made or flattened. An `index` counts the points in the order they were handed over, from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveError {
    /// A coordinate is not a number, or beyond [`LARGEST_COORDINATE`].
    OutOfRange {
        /// The point.
        index: usize,
    },
    /// A point lies on the one before it (or, of an arc, on its start).
    PointsCoincide {
        /// The later of the two.
        index: usize,
    },
    /// Fewer than two points.
    TooFewPoints,
    /// A Bezier curve with more than [`MOST_CONTROL_POINTS`].
    TooManyControlPoints,
    /// The radius does not reach from one end to the other.
    RadiusTooSmall {
        /// Half the chord.
        smallest: Length,
    },
    /// The centre of an arc is not as far from its start as from its end.
    CenterNotEquidistant {
        /// From centre to start.
        to_start: Length,
        /// From centre to end.
        to_end: Length,
    },
    /// The three points of an arc lie on one line.
    Collinear,
    /// The tolerance asks for more points than [`MOST_POINTS`] (fewer for Bezier curves of high degree).
    TooManyPoints,
}

impl Curve {
    /// A straight line.
    ///
    /// # Errors
    /// [`CurveError::OutOfRange`].
    pub fn line(from: Point2, to: Point2) -> Result<Self, CurveError> {
        Self::polyline(vec![from, to])
    }

    /// Straight lines from point to point. Points may repeat.
    ///
    /// # Errors
    /// [`CurveError::OutOfRange`], [`CurveError::TooFewPoints`], [`CurveError::TooManyPoints`].
    pub fn polyline(points: Vec<Point2>) -> Result<Self, CurveError> {
        check_points(&points)?;
        Ok(Self {
            shape: Shape::Polyline(points),
        })
    }

    /// The shorter arc of a radius. A positive radius curves up over the chord (a hill), a negative one down (a
    /// hollow), whichever way it is travelled. Over a vertical chord a positive radius curves to the left of the way.
    ///
    /// # Errors
    /// [`CurveError::RadiusTooSmall`], [`CurveError::PointsCoincide`], [`CurveError::OutOfRange`] (index 2 is the
    /// radius).
    pub fn arc_by_radius(from: Point2, to: Point2, radius: Length) -> Result<Self, CurveError> {
        Ok(Self {
            shape: Shape::Arc(Arc::by_radius(from, to, radius.to_mm())?),
        })
    }

    /// The shorter arc about a centre that is equally far from both ends within 1 um. Of the two halves of a circle
    /// the one over the chord is meant.
    ///
    /// # Errors
    /// [`CurveError::CenterNotEquidistant`], [`CurveError::PointsCoincide`], [`CurveError::OutOfRange`] (index 2 is
    /// the centre).
    pub fn arc_by_center(from: Point2, to: Point2, center: Point2) -> Result<Self, CurveError> {
        Ok(Self {
            shape: Shape::Arc(Arc::by_center(from, to, center)?),
        })
    }

    /// The arc from one point through another to a third; it may be more than half a circle.
    ///
    /// # Errors
    /// [`CurveError::Collinear`] (within 1 nm), [`CurveError::PointsCoincide`], [`CurveError::OutOfRange`].
    pub fn arc_through(from: Point2, through: Point2, to: Point2) -> Result<Self, CurveError> {
        Ok(Self {
            shape: Shape::Arc(Arc::through(from, through, to)?),
        })
    }

    /// The arc that turns through an angle on its way, to the left where it is positive. An arc that turns through less
    /// than 1e-9 rad is a straight line.
    ///
    /// # Errors
    /// [`CurveError::PointsCoincide`], [`CurveError::OutOfRange`] (index 2 is an angle of a whole turn or more).
    pub fn arc_by_sweep(from: Point2, to: Point2, sweep: Angle) -> Result<Self, CurveError> {
        if sweep.to_rad().abs() < STRAIGHT {
            return Self::line(from, to);
        }
        Ok(Self {
            shape: Shape::Arc(Arc::by_sweep(from, to, sweep.to_rad())?),
        })
    }

    /// The angle that a circular arc turns through, to the left where it is positive; none of another curve.
    #[must_use]
    pub const fn sweep(&self) -> Option<Angle> {
        match &self.shape {
            Shape::Arc(arc) => Some(Angle::rad(arc.sweep())),
            _ => None,
        }
    }

    /// An arc of the ellipse `center + half[0] cos t + half[1] sin t`, from one parameter on over `sweep`, which is cut off
    /// at a whole turn. The half-diameters need not be its axes, but conjugate.
    ///
    /// # Errors
    /// [`CurveError::OutOfRange`].
    pub fn elliptic_arc(
        center: Point2,
        half: [Point2; 2],
        start: Angle,
        sweep: Angle,
    ) -> Result<Self, CurveError> {
        Ok(Self {
            shape: Shape::Ellipse(EllipticArc::new(center, half, start.to_rad(), sweep.to_rad())?),
        })
    }

    /// A B-spline of any degree, with any knots and weights.
    ///
    /// # Errors
    /// See [`NurbsError`].
    pub fn nurbs(nurbs: &Nurbs) -> Result<Self, NurbsError> {
        let shape = match nurbs.pieces()? {
            Pieces::Plain(pieces) => Shape::Spline(pieces),
            Pieces::Rational(pieces) => Shape::Rational(pieces),
        };
        Ok(Self { shape })
    }

    /// A Bezier curve given by all its control points, ends included.
    ///
    /// # Errors
    /// [`CurveError::TooManyControlPoints`], [`CurveError::TooFewPoints`], [`CurveError::OutOfRange`].
    pub fn bezier(control: Vec<Point2>) -> Result<Self, CurveError> {
        check_points(&control)?;
        if control.len() > MOST_CONTROL_POINTS {
            return Err(CurveError::TooManyControlPoints);
        }
        Ok(Self {
            shape: Shape::Bezier(Bezier::new(control)),
        })
    }

    /// The interpolating cubic spline through points: twice continuously differentiable over the chord length,
    /// without curvature at its ends. As it is parametrised by chord length, not by x, steep pieces do no harm.
    ///
    /// # Errors
    /// [`CurveError::PointsCoincide`], [`CurveError::TooFewPoints`], [`CurveError::OutOfRange`],
    /// [`CurveError::TooManyPoints`].
    pub fn spline(points: Vec<Point2>) -> Result<Self, CurveError> {
        check_points(&points)?;
        Ok(Self {
            shape: Shape::Spline(spline::interpolate(&points)?),
        })
    }

    #[must_use]
    pub fn start(&self) -> Point2 {
        let start = match &self.shape {
            Shape::Polyline(points) => points.first().copied(),
            Shape::Arc(arc) => Some(arc.from()),
            Shape::Ellipse(arc) => Some(arc.from()),
            Shape::Bezier(bezier) => Some(bezier.from()),
            Shape::Spline(pieces) => pieces.first().map(Bezier::from),
            Shape::Rational(pieces) => pieces.first().map(Rational::from),
        };
        // Never taken: there are points.
        start.unwrap_or(Point2::new(0.0, 0.0))
    }

    /// Appends the polyline of this curve to `out`, all points after the first. The curve stays within `tolerance`
    /// of the polyline (see the module documentation), and the end point is exact. Tolerances below 1e-9 mm are
    /// raised to that.
    ///
    /// # Errors
    /// [`CurveError::TooManyPoints`]; what is in `out` is then of no use.
    pub fn flatten(&self, tolerance: Length, out: &mut Vec<Point2>) -> Result<(), CurveError> {
        let tolerance = tolerance.to_mm().max(FINEST_TOLERANCE);
        match &self.shape {
            Shape::Polyline(points) => out.extend(points.iter().skip(1)),
            Shape::Arc(arc) => arc.flatten(tolerance, out)?,
            Shape::Ellipse(arc) => arc.flatten(tolerance, out)?,
            Shape::Bezier(bezier) => bezier.flatten(tolerance, MOST_POINTS, out)?,
            Shape::Spline(cubics) => {
                let before = out.len();
                for cubic in cubics {
                    let left = MOST_POINTS.saturating_sub(out.len() - before);
                    cubic.flatten(tolerance, left, out)?;
                }
            }
            Shape::Rational(pieces) => {
                let before = out.len();
                for piece in pieces {
                    let left = MOST_POINTS.saturating_sub(out.len() - before);
                    piece.flatten(tolerance, left, out)?;
                }
            }
        }
        Ok(())
    }
}

/// The control points of the cubics of [`Curve::spline`], end to end.
///
/// # Errors
/// As [`Curve::spline`].
pub fn spline_cubics(points: &[Point2]) -> Result<Vec<Vec<Point2>>, CurveError> {
    check_points(points)?;
    let cubics = spline::interpolate(points)?;
    Ok(cubics.into_iter().map(Bezier::into_control).collect())
}

/// What all lists of points must satisfy.
fn check_points(points: &[Point2]) -> Result<(), CurveError> {
    if points.len() < 2 {
        return Err(CurveError::TooFewPoints);
    }
    if points.len() > MOST_POINTS {
        return Err(CurveError::TooManyPoints);
    }
    match points.iter().position(|point| !point.is_in_range()) {
        Some(index) => Err(CurveError::OutOfRange { index }),
        None => Ok(()),
    }
}
