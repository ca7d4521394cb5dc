//! Points `(x, z)` of profiles and of tips.

use super::dimension::Dimension;
use super::eval::Scope;
use super::report::{Checked, Reports};
use vcutc_diagnostics::source::Spanned;
use vcutc_geometry::curve::Point2;
use vcutc_syntax::ast::{Expr, Point};

/// A point, in mm.
pub fn point(point: &Point, scope: &Scope<'_>, reports: &mut Reports) -> Checked<Point2> {
    let mut coordinate = |expr: &Spanned<Expr>, taker: &str| {
        scope.expect(expr, Dimension::LENGTH, taker, Some("10 mm"), reports)
    };
    let x = coordinate(&point.x, "the x of a point");
    let z = coordinate(&point.z, "the z of a point");
    Ok(Point2::new(x?, z?))
}
