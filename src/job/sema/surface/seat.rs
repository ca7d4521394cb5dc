//! Where a mesh would lie on the stock: offered where it lies beside it.

use super::{WELD, placed};
use crate::sema::fields::Fields;
use crate::sema::quantity::mm;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_surface::mesh::Mesh;
use vcutc_surface::surface::Placement;

/// What is offered is a multiple of this: in mm, and in deg.
const PARTS_OF_A_MM: f64 = 1000.0;
const PARTS_OF_A_DEGREE: f64 = 1e6;

/// A mesh of a file, in its place.
pub(super) struct Seat<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) placement: Placement,
    pub(super) stock: Stock,
    pub(super) fields: &'a Fields<'a>,
    /// Where its place is stated.
    pub(super) given: Option<Span>,
}

impl Seat<'_> {
    /// Offers the place that seats the box around the mesh on the stock, where that is another one.
    pub(super) fn offer(&self, diagnostic: Diagnostic) -> Diagnostic {
        let Some([low, high]) = self.extent() else {
            return diagnostic;
        };
        let size = [high.x - low.x, high.y - low.y, high.z - low.z];
        let [width, depth, height] = self.sides();
        if size[0] < width - WELD.to_mm() || size[1] < depth - WELD.to_mm() {
            return diagnostic.help(format!(
                "the mesh measures {} by {} by {}, the stock {} by {} by {}: check `unit`, turn the mesh by `place`, \
                 or make the stock smaller",
                mm(size[0]),
                mm(size[1]),
                mm(size[2]),
                mm(width),
                mm(depth),
                mm(height)
            ));
        }
        let (frame, text) = self.seated(low, high);
        if frame.origin == self.placement.frame.origin {
            return diagnostic;
        }
        let title = format!("seat the mesh on the stock: `{text}`");
        if !self.does(frame) {
            return diagnostic.help(title);
        }
        match self.given {
            Some(span) => {
                let value = text.trim_start_matches("place = ").to_owned();
                diagnostic.fix(title, span, value)
            }
            None => self.fields.offer(diagnostic, title, &text),
        }
    }

    const fn sides(&self) -> [f64; 3] {
        [
            self.stock.width.to_mm(),
            self.stock.depth.to_mm(),
            self.stock.height.to_mm(),
        ]
    }

    /// The least and the greatest coordinates of the mesh in its place.
    fn extent(&self) -> Option<[Point3; 2]> {
        let Frame { origin, orientation } = self.placement.frame;
        let (rotation, unit) = (orientation.matrix(), self.placement.unit.to_mm());
        let corners = self.mesh.corners().iter().map(|corner| {
            let turned = rotation.map(|row| {
                let [x, y, z] = corner.to_array();
                (row[0] * x + row[1] * y + row[2] * z) * unit
            });
            [origin.x + turned[0], origin.y + turned[1], origin.z + turned[2]]
        });
        let ends = corners.fold(None, |ends: Option<[[f64; 3]; 2]>, corner| {
            let [low, high] = ends.unwrap_or([corner; 2]);
            Some([
                [0, 1, 2].map(|axis| low[axis].min(corner[axis])),
                [0, 1, 2].map(|axis| high[axis].max(corner[axis])),
            ])
        })?;
        Some(ends.map(Point3::from))
    }

    /// The frame in which the box lies over the stock, as far as it does not already, and how it is written.
    fn seated(&self, low: Point3, high: Point3) -> (Frame, String) {
        let Frame { origin, orientation } = self.placement.frame;
        let weld = WELD.to_mm();
        let [width, depth, height] = self.sides();
        let centred = |low: f64, high: f64, side: f64| {
            let covers = low <= weld / 2.0 && high >= side - weld / 2.0;
            if covers { 0.0 } else { (side - low - high) / 2.0 }
        };
        let lifted = if low.z >= 0.0 && high.z <= height {
            0.0
        } else {
            -low.z
        };
        let shift = [
            centred(low.x, high.x, width),
            centred(low.y, high.y, depth),
            lifted,
        ];
        let moved = |from: f64, by: f64| match by == 0.0 {
            true => from,
            false => rounded(from + by, PARTS_OF_A_MM),
        };
        let origin = Point3::new(
            moved(origin.x, shift[0]),
            moved(origin.y, shift[1]),
            moved(origin.z, shift[2]),
        );
        let zyx = orientation.to_zyx();
        let [a, b, c] = [zyx.a, zyx.b, zyx.c].map(|angle| rounded(angle.to_deg(), PARTS_OF_A_DEGREE));
        let frame = Frame {
            origin,
            orientation: Orientation::from_zyx(Zyx {
                a: Angle::deg(a),
                b: Angle::deg(b),
                c: Angle::deg(c),
            }),
        };
        let Point3 { x, y, z } = origin;
        let text = format!(
            "place = frame(x = {x} mm, y = {y} mm, z = {z} mm, a = {a} deg, b = {b} deg, c = {c} deg)"
        );
        (frame, text)
    }

    /// Whether the mesh covers the stock there and lies within it.
    fn does(&self, frame: Frame) -> bool {
        let placement = Placement {
            frame,
            ..self.placement
        };
        let Ok(surface) = placed(self.mesh, &placement, self.stock) else {
            return false;
        };
        let is_covered = surface.coverage().is_ok_and(|coverage| coverage.gaps.is_empty());
        let is_low = surface
            .highest()
            .is_some_and(|place| place.z <= self.stock.height.to_mm());
        is_covered && is_low && surface.lowest_below(Length::ZERO) == Ok(None)
    }
}

/// The nearest of so many parts of one; no zero is negative.
fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts + 0.0
}
