//! Polylines with bulges, in the light form and in that of R12.
//!
//! The bulge of a corner is the tangent of a quarter of the angle through which the arc to the next corner turns, above 0
//! to the left.

use super::super::DataError;
use super::super::drawing::{Shape, Why};
use super::facing::{is_level, placed};
use super::fields::Fields;
use super::groups::Groups;
use super::types::Content;
use crate::point::Point2;

/// A corner, and the bulge of what follows it.
struct Corner {
    at: Point2,
    bulge: f64,
}

/// An LWPOLYLINE: its corners are repeated groups 10, 20 and 42.
pub(super) fn light<'t>(fields: &Fields<'_>) -> Result<Content<'t>, DataError> {
    let mut corners: Vec<Corner> = Vec::new();
    // An x whose y is still to come.
    let mut open = None;
    for (code, value) in fields.all() {
        match code {
            10 => open = Some(value.number()?),
            20 => {
                let z = value.number()?;
                let x = open.take();
                let x = x.ok_or_else(|| value.place.error("the y of a corner is here without its x"))?;
                corners.push(Corner {
                    at: Point2::new(x, z),
                    bulge: 0.0,
                });
            }
            42 => {
                let bulge = value.number()?;
                if let Some(corner) = corners.last_mut() {
                    corner.bulge = bulge;
                }
            }
            _ => {}
        }
    }
    if open.is_some() {
        return Err(fields.error("the last corner of this LWPOLYLINE lacks its y"));
    }
    let stated = fields.whole(90)?;
    if fields.get(90).is_some() && usize::try_from(stated) != Ok(corners.len()) {
        let message = format!(
            "this LWPOLYLINE says that it has {stated} corners, and has {}",
            corners.len()
        );
        return Err(fields.error(message));
    }
    shapes(fields, "LWPOLYLINE", &corners)
}

/// Takes the corners after a POLYLINE, up to its SEQEND.
pub(super) fn take_corners<'t>(groups: &mut Groups<'t>) -> Result<Vec<Fields<'t>>, DataError> {
    let mut corners = Vec::new();
    loop {
        let group = groups.take()?;
        match groups.value(group) {
            "VERTEX" => corners.push(Fields::take(group, groups)?),
            "SEQEND" => {
                Fields::take(group, groups)?;
                return Ok(corners);
            }
            _ => {
                return Err(group
                    .place
                    .error("a POLYLINE goes on with VERTEX, or ends with SEQEND"));
            }
        }
    }
}

/// Flags of a POLYLINE: it is a mesh of faces.
const MESHES: i64 = 16 | 64;
/// It lies in space, and has no bulges.
const IN_SPACE: i64 = 8;
/// Flag of a VERTEX: it controls a spline, and is not on the line.
const OF_THE_FRAME: i64 = 16;

/// A POLYLINE of R12.
pub(super) fn heavy<'t>(fields: &Fields<'_>, vertices: &[Fields<'_>]) -> Result<Content<'t>, DataError> {
    let flags = fields.whole(70)?;
    if flags & MESHES != 0 {
        return Ok(Content::Unread(Why::Kind));
    }
    let mut corners = Vec::new();
    let mut heights = Vec::new();
    for vertex in vertices {
        if vertex.whole(70)? & OF_THE_FRAME != 0 {
            continue;
        }
        let bulge = vertex.number_or(42, 0.0)?;
        corners.push(Corner {
            at: vertex.point(10)?,
            bulge: if flags & IN_SPACE == 0 { bulge } else { 0.0 },
        });
        heights.push(vertex.number_or(30, 0.0)?);
    }
    if flags & IN_SPACE != 0 && !is_level(heights) {
        return Ok(Content::Unread(Why::Tilted));
    }
    shapes(fields, "POLYLINE", &corners)
}

fn shapes<'t>(fields: &Fields<'_>, kind: &'static str, corners: &[Corner]) -> Result<Content<'t>, DataError> {
    let is_closed = fields.whole(70)? & 1 != 0;
    let next = corners
        .iter()
        .skip(1)
        .chain(corners.first().filter(|_| is_closed));
    let mut shapes: Vec<Shape> = Vec::new();
    for (corner, next) in corners.iter().zip(next) {
        if corner.at.distance(next.at) <= 0.0 {
            continue;
        }
        match (shapes.last_mut(), corner.bulge.abs() < 1e-12) {
            (Some(Shape::Polyline(points)), true) => points.push(next.at),
            (_, true) => shapes.push(Shape::Polyline(vec![corner.at, next.at])),
            (_, false) => shapes.push(Shape::Arc {
                from: corner.at,
                to: next.at,
                sweep: 4.0 * libm::atan(corner.bulge),
            }),
        }
    }
    if shapes.is_empty() {
        return Ok(Content::Unread(Why::NoExtent));
    }
    placed(fields, kind, shapes)
}
