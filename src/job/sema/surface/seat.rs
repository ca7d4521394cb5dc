//! Where a mesh would lie on the stock: offered where it lies beside it, with what else may be the reason.

use super::{WELD, placed};
use crate::sema::field_ranges::COORDINATE;
use crate::sema::fields::Fields;
use crate::sema::part::SAME;
use crate::sema::quantity::{mm, number};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_surface::mesh::Mesh;
use vcutc_surface::surface::Placement;

/// What is offered is a multiple of these parts of a mm: the first where that does, the finer ones for a mesh as high as the
/// stock.
const PARTS_OF_A_MM: [f64; 3] = [1e3, 1e6, 1e9];
const PARTS_OF_A_DEGREE: f64 = 1e6;

/// A mesh of a file, in its place.
pub(super) struct Seat<'a> {
    pub(super) mesh: &'a Mesh,
    /// The word that names its kind of file.
    pub(super) word: &'a str,
    pub(super) placement: Placement,
    /// How near the mesh lies to what it stands for.
    pub(super) tolerance: Length,
    pub(super) units: &'a [(&'a str, f64)],
    pub(super) stock: Stock,
    pub(super) fields: &'a Fields<'a>,
    /// Where its place is stated.
    pub(super) given: Option<Span>,
}

/// The least and the greatest coordinates of a mesh.
#[derive(Clone, Copy)]
struct Extent {
    low: [f64; 3],
    high: [f64; 3],
}

impl Extent {
    fn size(self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.high[axis] - self.low[axis])
    }
}

/// A frame in the numbers with which a job states it.
#[derive(Clone, Copy)]
struct Stated {
    origin: Point3,
    /// About z, y and x, in deg.
    angles: [f64; 3],
}

impl Stated {
    fn frame(self) -> Frame {
        let [a, b, c] = self.angles.map(Angle::deg);
        Frame {
            origin: self.origin,
            orientation: Orientation::from_zyx(Zyx { a, b, c }),
        }
    }

    /// Whether its numbers are in range.
    fn is_allowed(self) -> bool {
        let mut parts = self.origin.to_array().into_iter();
        parts.all(|part| COORDINATE.holds(part))
    }

    fn text(self) -> String {
        let (Point3 { x, y, z }, [a, b, c]) = (self.origin, self.angles);
        format!("frame(x = {x} mm, y = {y} mm, z = {z} mm, a = {a} deg, b = {b} deg, c = {c} deg)")
    }
}

impl Seat<'_> {
    /// Offers the place that seats the mesh on the stock, if one does, or else says what keeps it from lying there.
    pub(super) fn offer(&self, diagnostic: Diagnostic) -> Diagnostic {
        let Some((place, extent)) = self.seated() else {
            return diagnostic;
        };
        let size = extent.size();
        // Some of a part that is read too large may lie well on the stock, too.
        if let Some(help) = self.other_unit(size) {
            return diagnostic.help(help);
        }
        let is_another = place.origin != self.placement.frame.origin;
        if is_another && place.is_allowed() && self.does(place.frame()) {
            return self.offer_place(diagnostic, &place.text());
        }
        let sides = self.sides();
        if is_short(size, sides) {
            let check = if self.units.is_empty() {
                ""
            } else {
                "check `unit`, "
            };
            return diagnostic.help(format!(
                "the {} measures {}, the stock {}: {check}turn the {} by `place`, or make the stock smaller",
                self.word,
                by(size),
                by(sides),
                self.word
            ));
        }
        if place.is_allowed() {
            return diagnostic;
        }
        diagnostic.help(format!(
            "the {} lies farther from the origin of its file than a `place` reaches ({}): export it nearer to the origin",
            self.word,
            COORDINATE.words()
        ))
    }

    fn offer_place(&self, diagnostic: Diagnostic, value: &str) -> Diagnostic {
        match self.given {
            Some(span) => {
                let title = format!("seat the {} on the stock: `place = {value}`", self.word);
                diagnostic.fix(title, span, value)
            }
            None => {
                let lead = format!("seat the {} on the stock:", self.word);
                self.fields.offer(diagnostic, &lead, &format!("place = {value}"))
            }
        }
    }

    /// A part that does not fit the stock because it was read in a wrong unit: which one would do.
    fn other_unit(&self, size: [f64; 3]) -> Option<String> {
        let sides = self.sides();
        let fits = |size: [f64; 3]| !is_short(size, sides) && size[2] <= sides[2] + SAME;
        let stated = self.placement.unit.to_mm();
        if fits(size) {
            return None;
        }
        // Of those that do, the one in which the part is nearest to the stock.
        let scaled = |factor: f64| size.map(|side| side * factor);
        let (unit, factor) = self
            .units
            .iter()
            .map(|&(unit, length)| (unit, length / stated))
            .filter(|&(_, factor)| fits(scaled(factor)))
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        let change = if factor < 1.0 {
            format!("{} times smaller", number(1.0 / factor))
        } else {
            format!("{} times larger", number(factor))
        };
        Some(format!(
            "check `unit`: the {} measures {}, the stock {}; with `unit = {unit}` it is {change} and fits",
            self.word,
            by(size),
            by(sides)
        ))
    }

    const fn sides(&self) -> [f64; 3] {
        [
            self.stock.width.to_mm(),
            self.stock.depth.to_mm(),
            self.stock.height.to_mm(),
        ]
    }

    /// The extent of the mesh in a frame.
    fn extent(&self, Frame { origin, orientation }: Frame) -> Option<Extent> {
        let (rotation, unit) = (orientation.matrix(), self.placement.unit.to_mm());
        let corners = self.mesh.corners().iter().map(|corner| {
            let scaled = corner.to_array().map(|part| part * unit);
            let turned = rotation.map(|row| row[0] * scaled[0] + row[1] * scaled[1] + row[2] * scaled[2]);
            [origin.x + turned[0], origin.y + turned[1], origin.z + turned[2]]
        });
        corners.fold(None, |extent: Option<Extent>, corner| {
            let Extent { low, high } = extent.unwrap_or(Extent {
                low: corner,
                high: corner,
            });
            Some(Extent {
                low: [0, 1, 2].map(|axis| low[axis].min(corner[axis])),
                high: [0, 1, 2].map(|axis| high[axis].max(corner[axis])),
            })
        })
    }

    /// The frame in which the box around the mesh lies over the stock, as far as it does not already, and the extent that it
    /// has before it is moved there.
    fn seated(&self) -> Option<(Stated, Extent)> {
        let Frame { origin, orientation } = self.placement.frame;
        let zyx = orientation.to_zyx();
        let angles = [zyx.a, zyx.b, zyx.c].map(|angle| nearest(angle.to_deg(), PARTS_OF_A_DEGREE));
        // Rounded angles move it a little.
        let extent = self.extent(Stated { origin, angles }.frame())?;
        let [width, depth, height] = self.sides();
        let ends = |axis: usize| [extent.low[axis], extent.high[axis]];
        let origin = Point3::new(
            centred(origin.x, ends(0), width),
            centred(origin.y, ends(1), depth),
            lifted(origin.z, ends(2), height),
        );
        Some((Stated { origin, angles }, extent))
    }

    /// Whether the mesh covers the stock there and lies within it.
    fn does(&self, frame: Frame) -> bool {
        let placement = Placement {
            frame,
            ..self.placement
        };
        let Ok(surface) = placed(self.mesh, &placement, self.tolerance, self.stock) else {
            return false;
        };
        let is_covered = surface.coverage().is_ok_and(|coverage| coverage.gaps.is_empty());
        let is_low = surface
            .highest()
            .is_some_and(|place| place.z - self.stock.height.to_mm() <= SAME);
        is_covered && is_low && surface.lowest_below(Length::mm(-SAME)) == Ok(None)
    }
}

/// A coordinate of the origin that moves these ends over a side of the stock, where they do not cover it.
fn centred(origin: f64, [low, high]: [f64; 2], side: f64) -> f64 {
    let slack = WELD.to_mm() / 2.0;
    if low <= slack && high >= side - slack {
        return origin;
    }
    let moved = origin + (side - low - high) / 2.0;
    let covers = |parts: f64| {
        let by = nearest(moved, parts) - origin;
        low + by <= slack && high + by >= side - slack
    };
    let [coarse, ..] = PARTS_OF_A_MM;
    let parts = PARTS_OF_A_MM.into_iter().find(|&parts| covers(parts));
    nearest(moved, parts.unwrap_or(coarse))
}

/// The height of the origin that moves these ends into the height of the stock, where they do not lie within. It is rounded
/// up, so that nothing sinks below the stock.
fn lifted(origin: f64, [low, high]: [f64; 2], height: f64) -> f64 {
    if low >= -SAME && high <= height + SAME {
        return origin;
    }
    let up = |parts: f64| ((origin - low - SAME / 2.0) * parts).ceil() / parts + 0.0;
    let [coarse, ..] = PARTS_OF_A_MM;
    let parts = PARTS_OF_A_MM
        .into_iter()
        .find(|&parts| high + (up(parts) - origin) <= height + SAME);
    up(parts.unwrap_or(coarse))
}

/// Whether a box is narrower than the stock or less deep.
fn is_short(size: [f64; 3], sides: [f64; 3]) -> bool {
    let weld = WELD.to_mm();
    size[0] < sides[0] - weld || size[1] < sides[1] - weld
}

fn by([width, depth, height]: [f64; 3]) -> String {
    format!("{} by {} by {}", mm(width), mm(depth), mm(height))
}

/// The nearest of so many parts of one; no zero is negative.
fn nearest(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts + 0.0
}
