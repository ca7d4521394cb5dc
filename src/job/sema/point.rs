//! Points `(x, z)` of profiles and of tips, and places `(x, y)` of regions.

use super::dimension::Dimension;
use super::eval::Scope;
use super::report::{Checked, Reports};
use vcutc_diagnostics::source::Spanned;
use vcutc_geometry::curve::Point2;
use vcutc_region::place::Place;
use vcutc_syntax::ast::{Expr, Point};

/// A point, in mm.
pub fn point(point: &Point, scope: &Scope<'_>, reports: &mut Reports) -> Checked<Point2> {
    let [x, z] = coordinates(point, ["the x of a point", "the z of a point"], scope, reports)?;
    Ok(Point2::new(x, z))
}

/// A place of the plan, in mm.
pub fn place(point: &Point, scope: &Scope<'_>, reports: &mut Reports) -> Checked<Place> {
    let [x, y] = coordinates(point, ["the x of a point", "the y of a point"], scope, reports)?;
    Ok(Place::new(x, y))
}

fn coordinates(
    point: &Point,
    takers: [&str; 2],
    scope: &Scope<'_>,
    reports: &mut Reports,
) -> Checked<[f64; 2]> {
    let mut coordinate = |expr: &Spanned<Expr>, taker: &str| {
        scope.expect(expr, Dimension::LENGTH, taker, Some("10 mm"), reports)
    };
    let first = coordinate(&point.first, takers[0]);
    let second = coordinate(&point.second, takers[1]);
    Ok([first?, second?])
}
