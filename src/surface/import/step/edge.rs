//! The loops of edges around the faces of STEP files (ISO 10303-42, clause 5.4), as polylines.
//!
//! An edge is the part of its curve between two vertices. A curve is followed by a polyline; the vertices must lie on it
//! at one place each, so that it is certain which part is meant.

use super::super::fault;
use super::file::{Instance, Reference, with_article};
use super::spline::impossible;
use super::{Advice, Reading, StepError, refused};
use crate::patch;
use crate::polyline::between;
use core::ops::Range;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;

/// How far polylines may lie off the curves that they follow, in mm.
pub(super) const FLATNESS: Length = Length::mm(0.001);

/// How far vertices may lie off the curves of their edges, in mm: the accuracy that CAD systems model with is finer.
const OFF_CURVE: f64 = 0.005;

/// Curves that are defined by others, one by the next.
const MOST_WRAPPED: usize = 4;

/// An edge as a face passes it.
pub(super) struct Edge {
    /// From its start to its end.
    pub(super) points: Vec<Point3>,
    /// Where the file has its curve.
    pub(super) range: Range<usize>,
}

impl<'a> Reading<'a> {
    /// The edges of a bound of a face, in the order in which they follow each other.
    pub(super) fn edges(&mut self, bound: &Reference) -> Result<Vec<Edge>, StepError> {
        let instance = self.file.named(bound)?;
        let record = match instance.simple("FACE_OUTER_BOUND") {
            Some(record) => record,
            None => instance.must_be("FACE_BOUND")?,
        };
        let around = record.at(1)?.reference()?;
        let instance = self.file.named(&around)?;
        if instance.simple("EDGE_LOOP").is_none() {
            let message = format!("the face is bounded by {}", with_article(&instance.kind()));
            return Err(refused(around.range, message, Advice::Untrim));
        }
        let listed = instance.must_be("EDGE_LOOP")?.at(1)?.list()?;
        let mut edges: Vec<Edge> = Vec::with_capacity(listed.len());
        for item in listed {
            let oriented = self.file.named(&item.reference()?)?;
            let record = oriented.must_be("ORIENTED_EDGE")?;
            let (edge, sense) = (record.at(3)?.reference()?, record.at(4)?);
            let mut edge = self.edge(&edge)?;
            if sense.is_word("F") {
                edge.points.reverse();
            }
            let before = edges.last().and_then(|edge| edge.points.last());
            if before.is_some_and(|end| {
                edge.points
                    .first()
                    .is_none_or(|start| end.distance(*start).to_mm() > 2.0 * OFF_CURVE)
            }) {
                return Err(fault(
                    item.word.range(),
                    "this edge does not begin where the one before ends",
                )
                .into());
            }
            self.take_points(edge.points.len(), bound)?;
            edges.push(edge);
        }
        Ok(edges)
    }

    fn edge(&mut self, reference: &Reference) -> Result<Edge, StepError> {
        let instance = self.file.named(reference)?;
        let record = instance.must_be("EDGE_CURVE")?;
        let vertices = [record.at(1)?.reference()?, record.at(2)?.reference()?];
        let curve = record.at(3)?.reference()?;
        let mut ends = [Point3::new(0.0, 0.0, 0.0); 2];
        for (end, vertex) in ends.iter_mut().zip(&vertices) {
            let vertex = self.file.named(vertex)?;
            *end = self.point(&vertex.must_be("VERTEX_POINT")?.at(1)?.reference()?)?;
        }
        let range = instance.range.clone();
        let points = match self.way(&curve, MOST_WRAPPED)? {
            Way::Straight => ends.to_vec(),
            Way::Along(points) => between(&points, ends, OFF_CURVE).ok_or_else(|| {
                let message = "the vertices of this edge do not lie on its curve, at one place each";
                refused(range.clone(), message, Advice::Untrim)
            })?,
        };
        Ok(Edge { points, range })
    }

    /// How the curve that is referred to goes.
    fn way(&mut self, reference: &Reference, wrapped_left: usize) -> Result<Way, StepError> {
        let instance = self.file.named(reference)?;
        if let Some(curve) = self.curve(&instance)? {
            let points = patch::polyline(&curve, FLATNESS).map_err(|error| impossible(error, &instance))?;
            return Ok(Way::Along(points));
        }
        if instance.simple("LINE").is_some() {
            // Between its vertices there is one straight way only.
            return Ok(Way::Straight);
        }
        if let Some(record) = instance.simple("POLYLINE") {
            let mut points = Vec::new();
            for item in record.at(1)?.list()? {
                points.push(self.point(&item.reference()?)?);
            }
            return Ok(Way::Along(points));
        }
        // The curve in space comes first in all of these.
        let wrappers = [
            "SURFACE_CURVE",
            "SEAM_CURVE",
            "INTERSECTION_CURVE",
            "TRIMMED_CURVE",
        ];
        let wrapper = wrappers.iter().find_map(|kind| instance.simple(kind));
        match (wrapper, wrapped_left.checked_sub(1)) {
            (Some(record), Some(left)) => self.way(&record.at(1)?.reference()?, left),
            (Some(_), None) => Err(fault(
                reference.range.clone(),
                "this curve is defined by too many others",
            )
            .into()),
            (None, _) => Err(unread(reference, &instance)),
        }
    }
}

fn unread(reference: &Reference, instance: &Instance<'_>) -> StepError {
    let message = format!(
        "this edge is {}, which is not compared with the border of the surface",
        with_article(&instance.kind())
    );
    refused(reference.range.clone(), message, Advice::Untrim)
}

/// How a curve goes.
enum Way {
    Straight,
    Along(Vec<Point3>),
}
