//! Entities: from groups to shapes.
//!
//! ARC, CIRCLE, polylines and INSERT are given in a system of their own, whose z axis is the extrusion direction (groups
//! 210, 220, 230); for a direction straight down x runs backwards in it (the arbitrary axis algorithm of the DXF
//! Reference). LINE, ELLIPSE and SPLINE are given in the world.

use super::super::DataError;
use super::super::drawing::{Shape, Why, sincos_degrees};
use super::facing::{Facing, is_level, placed};
use super::fields::Fields;
use super::groups::{Group, Groups};
use super::types::{Content, Entity};
use super::{insert, polyline, spline};
use crate::point::Point2;
use core::f64::consts::TAU;

/// Takes the entity whose name is the group at hand. None for what draws nothing: the ends of lists of attributes, and
/// windows of sheets.
pub(super) fn take<'t>(name: Group, groups: &mut Groups<'t>) -> Result<Option<Entity<'t>>, DataError> {
    let fields = Fields::take(name, groups)?;
    if matches!(fields.kind, "SEQEND" | "VIEWPORT") {
        return Ok(None);
    }
    // A polyline of the old kind continues with its corners, whatever becomes of it.
    let corners = match fields.kind {
        "POLYLINE" => polyline::take_corners(groups)?,
        _ => Vec::new(),
    };
    let content = if fields.whole(67)? == 1 {
        Content::Unread(Why::Paper)
    } else if fields.whole(60)? == 1 {
        Content::Unread(Why::Hidden)
    } else {
        content(&fields, &corners)?
    };
    Ok(Some(Entity {
        kind: fields.kind,
        place: fields.place,
        layer: fields.layer(),
        content,
    }))
}

fn content<'t>(fields: &Fields<'t>, corners: &[Fields<'t>]) -> Result<Content<'t>, DataError> {
    match fields.kind {
        "LINE" => line(fields),
        "ARC" => arc(fields),
        "CIRCLE" => circle(fields),
        "ELLIPSE" => ellipse(fields),
        "LWPOLYLINE" => polyline::light(fields),
        "POLYLINE" => polyline::heavy(fields, corners),
        "SPLINE" => spline::spline(fields),
        "INSERT" => insert::read(fields),
        _ => Ok(Content::Unread(Why::Kind)),
    }
}

fn line<'t>(fields: &Fields<'_>) -> Result<Content<'t>, DataError> {
    let ends = vec![fields.point(10)?, fields.point(11)?];
    if !is_level([fields.number_or(30, 0.0)?, fields.number_or(31, 0.0)?]) {
        return Ok(Content::Unread(Why::Tilted));
    }
    Ok(Content::Stroke("LINE", vec![Shape::Polyline(ends)]))
}

/// A radius, which is above 0.
fn radius(fields: &Fields<'_>) -> Result<f64, DataError> {
    let radius = fields.required(40)?;
    if radius > 0.0 {
        Ok(radius)
    } else {
        Err(fields.error(format!("the radius of this {} is not above 0", fields.kind)))
    }
}

fn circle<'t>(fields: &Fields<'_>) -> Result<Content<'t>, DataError> {
    let shapes = Shape::circle(fields.point(10)?, radius(fields)?);
    placed(fields, "CIRCLE", shapes)
}

/// An arc goes from its start angle to its end angle to the left.
fn arc<'t>(fields: &Fields<'_>) -> Result<Content<'t>, DataError> {
    let (center, radius) = (fields.point(10)?, radius(fields)?);
    let (start, end) = (fields.required(50)?, fields.required(51)?);
    let sweep = (end - start).rem_euclid(360.0);
    if sweep <= 0.0 {
        return placed(fields, "ARC", Shape::circle(center, radius));
    }
    let at = |degrees: f64| {
        let (sin, cos) = sincos_degrees(degrees);
        Point2::new(center.x + radius * cos, center.z + radius * sin)
    };
    let arc = |from: f64, sweep: f64| Shape::Arc {
        from: at(from),
        to: at(from + sweep),
        sweep: sweep.to_radians(),
    };
    // In two, so that the ends of an arc that is nearly a circle stay apart.
    let half = sweep / 2.0;
    let shapes = vec![arc(start, half), arc(start + half, half)];
    placed(fields, "ARC", shapes)
}

/// An ellipse by its longer half-axis, the ratio of the shorter one, and parameters in rad. Seen from below the shorter
/// axis lies to the right of the longer one.
fn ellipse<'t>(fields: &Fields<'_>) -> Result<Content<'t>, DataError> {
    let (center, major) = (fields.point(10)?, fields.point(11)?);
    let ratio = fields.required(40)?;
    let (start, end) = (fields.number_or(41, 0.0)?, fields.number_or(42, TAU)?);
    if !is_level([0.0, fields.number_or(31, 0.0)?]) {
        return Ok(Content::Unread(Why::Tilted));
    }
    let side = match Facing::of(fields)? {
        Facing::Up => ratio,
        Facing::Down => -ratio,
        Facing::Tilted => return Ok(Content::Unread(Why::Tilted)),
    };
    let is_sound = ratio > 0.0 && ratio <= 1e6 && libm::hypot(major.x, major.z) > 0.0;
    if !is_sound {
        return Err(fields.error("the half-axes of this ELLIPSE are not above 0"));
    }
    // A whole turn is written with as many digits as a program has.
    let turn = (end - start).rem_euclid(TAU);
    let is_whole = !(1e-6..=TAU - 1e-6).contains(&turn);
    let ellipse = Shape::Ellipse {
        center,
        half: [major, Point2::new(-major.z * side, major.x * side)],
        start,
        sweep: if is_whole { TAU } else { turn },
    };
    Ok(Content::Stroke("ELLIPSE", vec![ellipse]))
}
