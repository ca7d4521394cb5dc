//! The elements that draw, as strokes in their own user units (y downwards).

use super::super::DataError;
use super::super::drawing::Shape;
use super::page::{length_or, user_units};
use super::path;
use super::scan::Scan;
use super::tree::{attribute, place};
use crate::point::Point2;
use core::f64::consts::{FRAC_PI_2, TAU};
use roxmltree::Node;

/// What an element draws: its name, and its strokes.
pub(super) type Drawn = (&'static str, Vec<Vec<Shape>>);

/// The strokes of an element; none when it is not a shape.
pub(super) fn strokes(node: Node<'_, '_>) -> Result<Option<Drawn>, DataError> {
    Ok(Some(match node.tag_name().name() {
        "path" => (
            "path",
            attribute(node, "d").map_or(Ok(Vec::new()), path::subpaths)?,
        ),
        "line" => ("line", line(node)?),
        "polyline" => ("polyline", corners(node, Ends::Open)?),
        "polygon" => ("polygon", corners(node, Ends::Joined)?),
        "rect" => ("rect", rect(node)?),
        "circle" => ("circle", circle(node)?),
        "ellipse" => ("ellipse", ellipse(node)?),
        _ => return Ok(None),
    }))
}

/// Whether the last corner leads back to the first.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    Open,
    Joined,
}

fn line(node: Node<'_, '_>) -> Result<Vec<Vec<Shape>>, DataError> {
    let end = |x, y| -> Result<Point2, DataError> {
        Ok(Point2::new(length_or(node, x, 0.0)?, length_or(node, y, 0.0)?))
    };
    Ok(vec![vec![Shape::Polyline(vec![
        end("x1", "y1")?,
        end("x2", "y2")?,
    ])]])
}

fn corners(node: Node<'_, '_>, ends: Ends) -> Result<Vec<Vec<Shape>>, DataError> {
    let mut points = Vec::new();
    if let Some(text) = attribute(node, "points") {
        let mut scan = Scan::new(text);
        while scan.peek().is_some() {
            points.push(Point2::new(scan.number()?, scan.number()?));
        }
    }
    if points.len() < 2 {
        return Ok(Vec::new());
    }
    if ends == Ends::Joined {
        points.extend(points.first().copied());
    }
    Ok(vec![vec![Shape::Polyline(points)]])
}

/// A size, which is not below 0; one of 0 draws nothing.
fn size(node: Node<'_, '_>, name: &str) -> Result<f64, DataError> {
    let size = length_or(node, name, 0.0)?;
    if size >= 0.0 {
        Ok(size)
    } else {
        Err(place(node).error(format!("the `{name}` of this element is below 0")))
    }
}

fn center(node: Node<'_, '_>) -> Result<Point2, DataError> {
    Ok(Point2::new(
        length_or(node, "cx", 0.0)?,
        length_or(node, "cy", 0.0)?,
    ))
}

fn circle(node: Node<'_, '_>) -> Result<Vec<Vec<Shape>>, DataError> {
    let (center, radius) = (center(node)?, size(node, "r")?);
    let is_there = radius > 0.0;
    Ok(is_there
        .then(|| Shape::circle(center, radius))
        .into_iter()
        .collect())
}

fn ellipse(node: Node<'_, '_>) -> Result<Vec<Vec<Shape>>, DataError> {
    let (center, rx, ry) = (center(node)?, size(node, "rx")?, size(node, "ry")?);
    if rx.min(ry) <= 0.0 {
        return Ok(Vec::new());
    }
    Ok(vec![vec![Shape::Ellipse {
        center,
        half: [Point2::new(rx, 0.0), Point2::new(0.0, ry)],
        start: 0.0,
        sweep: TAU,
    }]])
}

/// A rectangle, whose corners may be rounded by quarters of ellipses.
fn rect(node: Node<'_, '_>) -> Result<Vec<Vec<Shape>>, DataError> {
    let (x, y) = (length_or(node, "x", 0.0)?, length_or(node, "y", 0.0)?);
    let (width, height) = (size(node, "width")?, size(node, "height")?);
    if width.min(height) <= 0.0 {
        return Ok(Vec::new());
    }
    let radius = |name| match attribute(node, name) {
        Some(text) if text.text.trim() != "auto" => user_units(text).map(Some),
        Some(_) | None => Ok(None),
    };
    let (rx, ry) = (radius("rx")?, radius("ry")?);
    // One of them stands for both, and none is more than half a side.
    let (rx, ry) = (rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
    let (rx, ry) = (rx.clamp(0.0, width / 2.0), ry.clamp(0.0, height / 2.0));
    let (right, bottom) = (x + width, y + height);
    let at = Point2::new;
    if rx.min(ry) <= 0.0 {
        let corners = vec![at(x, y), at(right, y), at(right, bottom), at(x, bottom), at(x, y)];
        return Ok(vec![vec![Shape::Polyline(corners)]]);
    }
    let quarter = |cx: f64, cy: f64, start: f64| Shape::Ellipse {
        center: at(cx, cy),
        half: [at(rx, 0.0), at(0.0, ry)],
        start,
        sweep: FRAC_PI_2,
    };
    let side = |from, to| Shape::Polyline(vec![from, to]);
    Ok(vec![vec![
        side(at(x + rx, y), at(right - rx, y)),
        quarter(right - rx, y + ry, -FRAC_PI_2),
        side(at(right, y + ry), at(right, bottom - ry)),
        quarter(right - rx, bottom - ry, 0.0),
        side(at(right - rx, bottom), at(x + rx, bottom)),
        quarter(x + rx, bottom - ry, FRAC_PI_2),
        side(at(x, bottom - ry), at(x, y + ry)),
        quarter(x + rx, y + ry, 2.0 * FRAC_PI_2),
    ]])
}
