//! What the passes themselves say of the part and of the blade.
//!
//! The part is taken to lie below the passes that show in the machined contour: those that no other V cuts away. A straight line
//! between two of them is nowhere steeper than a flank, for else one would lie in the V of the other; so no V enters what is
//! below such a polyline.

use super::types::Pass;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_simulation::surface::{Side, Surface, Vee};
use vcutc_vcut::plan::blade_reach::Flanks;

/// How much the polyline is lowered below what it may be, in mm: its points are rounded to the grid, and with them its slopes.
const ROUNDING: f64 = 2.0 * grid::SPACING;

/// The polyline through the lowest passes over a blank of that width, lowered by what the thickness of the blade takes.
pub(super) fn profile(passes: &[Pass], slope: f64, drop: Length, width: f64) -> Vec<Point2> {
    let mut lowest: Vec<Point2> = passes
        .iter()
        .map(|pass| Point2 { x: pass.x, z: pass.z })
        .collect();
    lowest.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z)));
    lowest.dedup_by(|later, kept| later.x - kept.x < grid::SPACING / 2.0);
    let shown = visible(&lowest, slope);
    let lower = |z: f64| grid::down((z - drop.to_mm() - ROUNDING).max(0.0));
    let mut points: Vec<Point2> = shown
        .iter()
        .map(|point| Point2 {
            z: lower(point.z),
            ..*point
        })
        .collect();
    if let (Some(&first), Some(&last)) = (points.first(), points.last()) {
        if first.x > 0.0 {
            points.insert(0, Point2 { x: 0.0, ..first });
        }
        if last.x < width {
            points.push(Point2 { x: width, ..last });
        }
    }
    straight_on(points)
}

/// The points, given from left to right, that lie in the V of no other.
fn visible(points: &[Point2], slope: f64) -> Vec<Point2> {
    // A point lies in the V of one left of it where the least `z - slope x` so far is less than its own, and likewise from the
    // right.
    let touch = 1e-9;
    let mut from_right = vec![f64::INFINITY; points.len()];
    let mut least = f64::INFINITY;
    for (slot, point) in from_right.iter_mut().zip(points).rev() {
        *slot = least;
        least = least.min(point.z + slope * point.x);
    }
    let mut least = f64::INFINITY;
    let mut shown = Vec::new();
    for (point, right) in points.iter().zip(from_right) {
        let (rising, falling) = (point.z - slope * point.x, point.z + slope * point.x);
        if rising <= least + touch && falling <= right + touch {
            shown.push(*point);
        }
        least = least.min(rising);
    }
    shown
}

/// Points without those that lie on the straight line between their neighbours.
fn straight_on(points: Vec<Point2>) -> Vec<Point2> {
    let mut kept: Vec<Point2> = Vec::with_capacity(points.len());
    for point in points {
        while let [.., a, b] = kept.as_slice()
            && ((b.x - a.x) * (point.z - a.z) - (point.x - a.x) * (b.z - a.z)).abs() < 1e-9
        {
            kept.pop();
        }
        kept.push(point);
    }
    kept
}

/// The shortest edge that frees every chip, cut in this order.
pub(super) fn least_edge(passes: &[Pass], flanks: &Flanks, [width, height]: [f64; 2]) -> Length {
    let mut surface = Surface::flat(width, height);
    let mut reach = 0.0_f64;
    for pass in passes {
        let vee = Vee::even(Point2 { x: pass.x, z: pass.z }, flanks.slope);
        if surface.covers(vee.tip) {
            for side in [Side::Left, Side::Right] {
                reach = reach.max(surface.flank(vee, side).reach);
            }
            surface.release(vee);
        }
    }
    // A hair more, so that rounding leaves no chip.
    Length::mm(grid::up(reach * flanks.edge_per_reach + grid::SPACING / 2.0))
}
