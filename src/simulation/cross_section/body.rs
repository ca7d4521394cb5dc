//! How the body of an upright disc passes the section.
//!
//! A stage of radius `r` from the height `t` on, on an axis that leans by the lead along the feed, begins at
//! `z_c + t cos gamma - sin gamma sqrt(r^2 - q^2)` at the distance `q` from the centre. Over its cover the rim goes first, and
//! takes the slivers below its centre off: there the body need only clear the height of the centre.

use super::TOUCH;
use crate::disc::{Disc, PassFault};
use crate::rim::{Drift, Line, Rim, axis};
use crate::surface::Surface;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;

/// A stage as it passes.
struct Stage {
    /// The lower edge of its lower end.
    edge: Rim,
    /// Where slivers below the centre are gone.
    cover: Option<[f64; 2]>,
    centre: Point2,
}

impl Stage {
    /// Its lower edge.
    fn height(&self, x: f64) -> f64 {
        let height = self.edge.height(x);
        if self.is_in_cover(x) {
            height.max(self.centre.z)
        } else {
            height
        }
    }

    fn is_in_cover(&self, x: f64) -> bool {
        self.cover
            .is_some_and(|[left, right]| (left..=right).contains(&x))
    }

    /// No point of its lower edge lies lower.
    fn lowest(&self) -> f64 {
        let [left, right] = self.edge.cover();
        let lowest = self.edge.lowest().z;
        if self.is_in_cover(left) && self.is_in_cover(right) {
            lowest.max(self.centre.z)
        } else {
            lowest
        }
    }

    /// The places on a straight piece of the section of which one is the farthest in: its ends, where both have one slope, and
    /// where the lower edge bends.
    fn places(&self, from: Point2, to: Point2) -> impl Iterator<Item = Point2> {
        let line = Line::through(from, to);
        let [left, right] = self.cover.unwrap_or([from.x, to.x]);
        let flank = self.edge.touching(line.slope).x;
        let [first, last] = self.edge.levels(self.centre.z);
        // Where the cover ends the lower edge may jump.
        let jumps = [left.next_down(), left, right, right.next_up()];
        let bends = jumps.into_iter().chain([flank, first, last]);
        let bends = bends.map(move |x| line.at(x.max(from.x).min(to.x)));
        [from, to].into_iter().chain(bends)
    }
}

/// How a disc stands while its body passes.
pub(super) struct Stand {
    /// The centre of its edge.
    pub(super) centre: Point2,
    pub(super) lead: Angle,
    pub(super) roll: Angle,
    /// How its way leads aside and up.
    pub(super) drift: Drift,
    /// Air around the body.
    pub(super) clearance: Length,
    /// Over what slivers below the centre are gone before the body comes.
    pub(super) cover: Option<[f64; 2]>,
}

/// Where each stage of the body is in the section.
pub(super) fn contacts(surface: &mut Surface, disc: &Disc, stand: &Stand, out: &mut Vec<PassFault>) {
    let top = surface.top();
    let [aside, along, up] = axis(stand.lead, stand.roll);
    for (number, stage) in disc.body.iter().enumerate() {
        let rise = stage.from.to_mm();
        // What lies farther along the way passes the section that much farther back on it.
        let Drift { right, climb } = stand.drift;
        let centre = Point2::new(
            stand.centre.x + rise * (aside - right * along),
            stand.centre.z + rise * (up - climb * along),
        );
        // What touches the clearance is clear.
        let radius = stage.radius + stand.clearance - Length::mm(TOUCH);
        let stage = Stage {
            edge: Rim::swept(centre, radius, [stand.lead, stand.roll], stand.drift),
            cover: stand.cover,
            centre: stand.centre,
        };
        if stage.lowest() >= top - TOUCH {
            continue;
        }
        if let Some((at, depth)) = stage_contact(surface, &stage) {
            out.push(PassFault::Body {
                stage: number,
                at,
                depth: Length::mm(depth),
            });
        }
    }
}

fn stage_contact(surface: &mut Surface, stage: &Stage) -> Option<(Point2, f64)> {
    let [left, right] = stage.edge.cover();
    let mut deepest: Option<(Point2, f64)> = None;
    let mut before: Option<Point2> = None;
    let lowest = stage.lowest();
    for corner in surface.stretch(left, right) {
        let from = before.replace(corner).unwrap_or(corner);
        if from.z.max(corner.z) <= lowest {
            continue;
        }
        for at in stage.places(from, corner) {
            let depth = at.z - stage.height(at.x);
            if depth > deepest.map_or(TOUCH, |(_, depth)| depth) {
                deepest = Some((at, depth));
            }
        }
    }
    deepest
}
