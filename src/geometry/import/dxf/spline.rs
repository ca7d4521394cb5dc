//! Splines: by control points, or by points to pass through.

use super::super::DataError;
use super::super::drawing::{Shape, Why};
use super::facing::is_level;
use super::fields::Fields;
use super::types::Content;
use crate::curve::{Curve, Nurbs, NurbsError, spline_cubics};
use crate::point::Point2;

/// The repeated groups of a SPLINE.
#[derive(Default)]
struct Lists {
    knots: Vec<f64>,
    weights: Vec<f64>,
    /// x, y and z of control points.
    control: [Vec<f64>; 3],
    /// x, y and z of points to pass through.
    fit: [Vec<f64>; 3],
    /// Whether the directions at the ends are given.
    has_tangents: bool,
}

impl Lists {
    fn of(fields: &Fields<'_>) -> Result<Self, DataError> {
        let mut lists = Self::default();
        for (code, value) in fields.all() {
            let list = match code {
                40 => &mut lists.knots,
                41 => &mut lists.weights,
                10 => &mut lists.control[0],
                20 => &mut lists.control[1],
                30 => &mut lists.control[2],
                11 => &mut lists.fit[0],
                21 => &mut lists.fit[1],
                31 => &mut lists.fit[2],
                12 | 13 => {
                    lists.has_tangents = true;
                    continue;
                }
                _ => continue,
            };
            list.push(value.number()?);
        }
        Ok(lists)
    }
}

pub(super) fn spline<'t>(fields: &Fields<'_>) -> Result<Content<'t>, DataError> {
    let lists = Lists::of(fields)?;
    for (code, what, count) in [
        (72, "knots", lists.knots.len()),
        (73, "control points", lists.control[0].len()),
        (74, "fit points", lists.fit[0].len()),
    ] {
        let stated = fields.whole(code)?;
        if fields.get(code).is_some() && usize::try_from(stated) != Ok(count) {
            return Err(fields.error(format!(
                "this SPLINE says that it has {stated} {what}, and has {count}"
            )));
        }
    }
    let by_fit = lists.control[0].is_empty();
    let given = if by_fit { &lists.fit } else { &lists.control };
    let points = points(fields, given)?;
    if !is_level(given[2].iter().copied()) {
        return Ok(Content::Unread(Why::Tilted));
    }
    if by_fit {
        through(fields, points, lists.has_tangents)
    } else {
        by_control(fields, points, lists)
    }
}

fn points(fields: &Fields<'_>, [x, z, _]: &[Vec<f64>; 3]) -> Result<Vec<Point2>, DataError> {
    if x.len() != z.len() {
        return Err(fields.error(format!(
            "the points of this SPLINE have {} x and {} y",
            x.len(),
            z.len()
        )));
    }
    Ok(x.iter().zip(z).map(|(&x, &z)| Point2::new(x, z)).collect())
}

fn by_control<'t>(fields: &Fields<'_>, control: Vec<Point2>, lists: Lists) -> Result<Content<'t>, DataError> {
    let degree = fields.get(71).map_or(Ok(3), |value| value.whole())?;
    let nurbs = Nurbs {
        degree: usize::try_from(degree).unwrap_or(0),
        knots: lists.knots,
        control,
        weights: lists.weights,
    };
    match Curve::nurbs(&nurbs) {
        Ok(_) => Ok(Content::Stroke("SPLINE", vec![Shape::Nurbs(nurbs)])),
        Err(error) => Err(fields.error(format!("this SPLINE is invalid: {}", why(error)))),
    }
}

/// Why a B-spline does not exist, in words.
fn why(error: NurbsError) -> String {
    match error {
        NurbsError::Degree { most } => format!("degrees go from 1 to {most}"),
        NurbsError::TooFewPoints { least } => format!("its degree takes {least} control points or more"),
        NurbsError::KnotCount { wanted } => format!("its points and its degree take {wanted} knots"),
        NurbsError::KnotsDecrease { index } => {
            format!("its knot number {} is smaller than the one before", index + 1)
        }
        NurbsError::KnotRepeats { index } => format!(
            "its knot number {} repeats so often that the curve falls apart",
            index + 1
        ),
        NurbsError::NoExtent => "all its knots are equal".to_owned(),
        NurbsError::WeightCount => "it has another number of weights than of control points".to_owned(),
        NurbsError::BadWeight { index } => {
            format!(
                "its weight number {} is not above 0, or a millionth of another one",
                index + 1
            )
        }
        NurbsError::Curve(_) => "its control points are out of range".to_owned(),
    }
}

/// A spline of which the file gives only points: programs draw their own curves through them.
fn through<'t>(
    fields: &Fields<'_>,
    mut points: Vec<Point2>,
    has_tangents: bool,
) -> Result<Content<'t>, DataError> {
    if has_tangents {
        return Err(fields.error(
            "this SPLINE has directions at its ends but no control points, so what it looks like between its fit \
             points depends on the program that draws it",
        ));
    }
    points.dedup_by(|next, last| last.distance(*next) <= 0.0);
    if points.len() < 2 {
        return Ok(Content::Unread(Why::NoExtent));
    }
    if fields.whole(70)? & 1 != 0 {
        return Err(fields.error(
            "this SPLINE is closed but has fit points only, so what it looks like depends on the program that draws it",
        ));
    }
    match spline_cubics(&points) {
        Ok(cubics) => Ok(Content::Fitted(
            "SPLINE",
            cubics.into_iter().map(Shape::Bezier).collect(),
        )),
        Err(_) => Err(fields.error("the fit points of this SPLINE are too close to each other")),
    }
}
