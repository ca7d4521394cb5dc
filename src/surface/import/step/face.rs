//! Faces of STEP files that are all of their surface.
//!
//! A face is the part of a surface within its edges. It is taken only if its edges go along the border of the surface, all
//! around: both, followed by polylines, can then be walked within [`TRIMMED`] of each other (their Fréchet distance is no
//! larger), which bends one into the other without ever leaving that distance from the border. So both wind equally often
//! around each place farther from the border than that, and the face has all of these places. How edges are divided and
//! parametrised does not matter, nor where they begin or which way they turn. That is so in plan, where a part is a height;
//! a surface that folds back to within that distance of its own border is not.

use super::super::{DataError, fault};
use super::edge::{Edge, FLATNESS};
use super::file::{Entity, Reference, with_article};
use super::spline::impossible;
use super::{Advice, Reading, StepError, refused};
use crate::frechet::{Nearness, nearness};
use crate::patch::{self, Nurbs};
use crate::polyline::{nearest, rotated};
use core::ops::Range;
use vcutc_backend_api::geometry::Point3;

/// How far the edges of a face may lie off the border of its surface, in mm.
pub(super) const TRIMMED: f64 = 0.01;

impl<'a> Reading<'a> {
    /// The surface of a face, in mm, and its number.
    pub(super) fn face(&mut self, face: Entity) -> Result<(Nurbs, u64), StepError> {
        let instance = self.file.read(face)?;
        let record = match instance.simple("FACE_SURFACE") {
            Some(record) => record,
            None => instance.must_be("ADVANCED_FACE")?,
        };
        let (bounds, on) = (record.at(1)?, record.at(2)?.reference()?);
        let surface = self.file.named(&on)?;
        let Some(nurbs) = self.surface(&surface)? else {
            let message = format!(
                "the face #{} lies on {}, which is not read",
                face.id,
                with_article(&surface.kind())
            );
            return Err(refused(instance.range.clone(), message, Advice::OnlySplines));
        };
        let bound = match bounds.list()? {
            [bound] => bound.reference()?,
            [] => return Err(fault(bounds.word.range(), "this face has no bounds").into()),
            [_, ..] => {
                let message = format!("the face #{} has holes", face.id);
                return Err(refused(instance.range.clone(), message, Advice::Untrim));
            }
        };
        let border = patch::border(&nurbs, FLATNESS).map_err(|error| impossible(error, &surface))?;
        self.take_points(border.len(), &bound)?;
        let edges = self.edges(&bound)?;
        self.compare(&edges, &border, &bound, face.id)?;
        Ok((nurbs, on.id))
    }

    /// Checks that edges go once along a border.
    fn compare(
        &mut self,
        edges: &[Edge],
        border: &[Point3],
        bound: &Reference,
        face: u64,
    ) -> Result<(), StepError> {
        let trimmed = |range: Range<usize>, how: String| {
            refused(
                range,
                format!("the face #{face} is trimmed: {how}"),
                Advice::Untrim,
            )
        };
        if let Some((edge, off)) = self.farthest(edges, border, bound)?
            && off > TRIMMED
        {
            let how = format!("this edge is {:.3} mm off the border of the surface", off);
            return Err(trimmed(edge.range.clone(), how));
        }
        let around: Vec<Point3> = edges
            .iter()
            .flat_map(|edge| edge.points.iter().copied())
            .collect();
        let distance = TRIMMED - 2.0 * FLATNESS.to_mm();
        let turned = around.first().and_then(|&start| {
            let (place, _) = nearest(border, start)?;
            rotated(border, place)
        });
        let mut border = turned.unwrap_or_default();
        for _ in 0..2 {
            match nearness(&around, &border, distance, &mut self.cells_left) {
                Nearness::Near => return Ok(()),
                Nearness::Apart => {}
                Nearness::Unknown => return Err(self.too_much(bound)),
            }
            border.reverse();
        }
        let how = format!("its edges do not go all along the border of the surface, within {TRIMMED} mm");
        Err(trimmed(bound.range.clone(), how))
    }

    /// The edge that lies farthest off a border with one of its points, and how far in mm.
    fn farthest<'e>(
        &mut self,
        edges: &'e [Edge],
        border: &[Point3],
        bound: &Reference,
    ) -> Result<Option<(&'e Edge, f64)>, StepError> {
        let mut farthest: Option<(&Edge, f64)> = None;
        // The border goes on near where the point before was found.
        let mut segment = 0;
        for edge in edges {
            for &point in &edge.points {
                let mut found = near_to(border, segment, point);
                if found.is_none_or(|(_, off)| off > TRIMMED) {
                    self.cells_left = match self.cells_left.checked_sub(border.len()) {
                        Some(left) => left,
                        None => return Err(self.too_much(bound)),
                    };
                    found = nearest(border, point).map(|(place, off)| (place.segment, off));
                }
                let Some((at, off)) = found else { continue };
                segment = at;
                if farthest.is_none_or(|(_, most)| off > most) {
                    farthest = Some((edge, off));
                }
            }
        }
        Ok(farthest)
    }

    /// Counts points of polylines.
    pub(super) fn take_points(&mut self, points: usize, bound: &Reference) -> Result<(), StepError> {
        let left = self.points_left.checked_sub(points);
        self.points_left = left.ok_or_else(|| self.too_much(bound))?;
        Ok(())
    }

    fn too_much(&self, bound: &Reference) -> StepError {
        let message = "the edges of this face have too many places to compare with the border of its surface";
        refused(bound.range.clone(), message, Advice::Mesh)
    }
}

/// The segment nearest to a point among those around one, and their distance.
fn near_to(border: &[Point3], segment: usize, point: Point3) -> Option<(usize, f64)> {
    const AROUND: usize = 4;
    let start = segment.saturating_sub(AROUND);
    let end = (segment + AROUND + 2).min(border.len());
    let (place, off) = nearest(border.get(start..end)?, point)?;
    Some((start + place.segment, off))
}

impl From<DataError> for StepError {
    fn from(place: DataError) -> Self {
        Self {
            place,
            advice: Advice::Repair,
        }
    }
}
