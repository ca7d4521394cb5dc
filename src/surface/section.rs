//! Sections of a surface by upright planes in any direction.
//!
//! A plane is given by its heading, an angle from x in plan, and its offset to the left of the origin seen along the heading.
//! In it, s counts along the heading from the foot of the origin. Tracks of section planes ([Yang fig. 4]) follow them.

use crate::envelope::Envelope;
use crate::shadow::Uncovered;
use crate::surface::{Plan, Surface, cut};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

/// Parts of a direction below this are rounding of an angle.
const ROUNDING: f64 = 1e-15;

/// Shorter ways over the plan, in mm, only touch it.
const SHORTEST: f64 = 1e-6;

/// An upright plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Upright {
    heading: [f64; 2],
    offset: f64,
}

impl Upright {
    /// The plane along a heading, measured from x towards y, at an offset to its left.
    #[must_use]
    pub fn new(heading: Angle, offset: Length) -> Self {
        let (sine, cosine) = libm::sincos(heading.to_rad());
        // Headings along x and y are exact.
        let exact = |part: f64| if part.abs() < ROUNDING { 0.0 } else { part };
        Self {
            heading: [exact(cosine), exact(sine)],
            offset: offset.to_mm(),
        }
    }

    /// Its direction in plan, of length 1.
    #[must_use]
    pub const fn heading(&self) -> [f64; 2] {
        self.heading
    }

    /// How far it lies to the left of the origin, in mm.
    #[must_use]
    pub const fn offset(&self) -> f64 {
        self.offset
    }

    /// The place in plan at a distance s along it, in mm.
    #[must_use]
    pub fn place(&self, s: f64) -> [f64; 2] {
        let ([x, y], d) = (self.heading, self.offset);
        [s * x - d * y, s * y + d * x]
    }

    /// A point by its distances along the plane and to its left.
    fn seen(&self, p: Point3) -> Point3 {
        let [x, y] = self.heading;
        Point3::new(p.x * x + p.y * y, p.y * x - p.x * y, p.z)
    }

    /// From where to where along it a plane passes a rectangle.
    fn within(&self, low: [f64; 2], high: [f64; 2]) -> Option<[f64; 2]> {
        let foot = self.place(0.0);
        let mut range = [f64::NEG_INFINITY, f64::INFINITY];
        for axis in [0, 1] {
            let (part, from) = (self.heading[axis], foot[axis]);
            if part == 0.0 {
                if !(low[axis]..=high[axis]).contains(&from) {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low[axis] - from) / part, (high[axis] - from) / part);
            range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
        }
        // Comparisons with NaN are false.
        (range[0] <= range[1] && range[0].is_finite() && range[1].is_finite()).then_some(range)
    }
}

/// The planes along a heading that divide a plan evenly, no farther apart than a step, from right to left. The first and the last
/// lie half their distance within the corners of the plan. None for a step below a micrometre, or more than a million planes.
#[must_use]
pub fn across(plan: Plan, heading: Angle, step: Length) -> Option<Vec<Upright>> {
    let at = Upright::new(heading, Length::ZERO);
    let (width, depth) = (plan.width.to_mm(), plan.depth.to_mm());
    let corners = [[0.0, 0.0], [width, 0.0], [0.0, depth], [width, depth]];
    let offsets = corners.map(|[x, y]| at.seen(Point3::new(x, y, 0.0)).y);
    let low = offsets.into_iter().fold(f64::INFINITY, f64::min);
    let high = offsets.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let count = crate::scallop::tracks(Length::mm(high - low), step)?.max(1);
    let plane = |k: u32| Upright {
        offset: low + (high - low) * (f64::from(k) + 0.5) / f64::from(count),
        ..at
    };
    Some((0..count).map(plane).collect())
}

/// The upper side of a surface in an upright plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The plane.
    pub plane: Upright,
    /// The height over each s, where the plane lies over the plan.
    pub profile: Profile,
}

impl Section {
    /// The point of the surface at a distance s along the plane, in mm; at the nearest one that it has.
    #[must_use]
    pub fn point(&self, s: f64) -> Point3 {
        let (from, to) = self.profile.span();
        let s = s.max(from).min(to);
        let [x, y] = self.plane.place(s);
        Point3::new(x, y, self.profile.height(s))
    }
}

impl Surface {
    /// The section by an upright plane. Exact up to rounding, and nowhere below the triangles; where it steps, places are right
    /// within 1e-8 mm. None where the plane misses the plan.
    ///
    /// # Errors
    /// If there is nothing over some range wider than the surface's `weld`, in s.
    pub fn section_by(&self, plane: Upright) -> Result<Option<Section>, Uncovered> {
        let Some([from, to]) = plane.within([0.0, 0.0], self.size()) else {
            return Ok(None);
        };
        if to - from < SHORTEST {
            return Ok(None);
        }
        let weld = self.accuracy().weld.to_mm();
        let mut envelope = Envelope::of(self.segments(plane).into_iter());
        if !envelope.holes(from, to, weld).is_empty() {
            // The plane runs along a crack, perhaps.
            for beside in [-weld, weld] {
                let offset = plane.offset + beside;
                let segments = self.segments(Upright { offset, ..plane });
                envelope = envelope.with(&Envelope::of(segments.into_iter()));
            }
        }
        let ranges = envelope.holes(from, to, weld);
        match envelope.profile(from, to) {
            Some(profile) if ranges.is_empty() => Ok(Some(Section { plane, profile })),
            _ => Err(Uncovered { ranges }),
        }
    }

    /// What triangles have in common with a plane, over s.
    fn segments(&self, plane: Upright) -> Vec<[Point2; 2]> {
        let mut segments = Vec::new();
        for number in self.along(plane) {
            let seen = self.triangle(number).map(|corner| plane.seen(corner));
            cut(seen, plane.offset, &mut segments);
        }
        segments
    }

    /// The triangles that a plane may meet, each once, in their order.
    fn along(&self, plane: Upright) -> Vec<u32> {
        let bins = self.bins();
        let [width, _] = self.size();
        let mut numbers = Vec::new();
        for row in 0..bins.rows() {
            let [low, high] = bins.bounds(crate::surface::Cell { column: 0, row });
            // A little more than the row, for the rounding of places.
            let (low, high) = (low[1] - SHORTEST, high[1] + SHORTEST);
            let Some(range) = plane.within([-SHORTEST, low], [width + SHORTEST, high]) else {
                continue;
            };
            let [a, b] = range.map(|s| plane.place(s)[0]);
            let bounds = [a.min(b) - SHORTEST, low, a.max(b) + SHORTEST, high];
            numbers.extend(bins.cells(bounds).flat_map(|cell| bins.triangles(cell)).copied());
        }
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testkit::{FIXED, sampled, sheets, surface_over, wavy};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sections_have_the_heights_of_the_surface(
            sheets in sheets(), heading in 0.0..360.0f64, offset in -80.0..120.0f64, share in 0.0..1.0f64,
        ) {
            let surface = surface_over(&sheets.over(wavy(100.0, 60.0)), FIXED, 100.0, 60.0);
            let plane = Upright::new(Angle::deg(heading), Length::mm(offset));
            let section = surface.section_by(plane).unwrap();
            // Whether any place of the line lies over the plan, by looking.
            let is_in = |[x, y]: [f64; 2], by: f64| {
                x >= by && x <= 100.0 - by && y >= by && y <= 60.0 - by
            };
            let places = || (-300..=300).map(|k| plane.place(f64::from(k) / 2.0));
            let Some(section) = section else {
                prop_assert!(!places().any(|place| is_in(place, 0.01)));
                return Ok(());
            };
            let (from, to) = section.profile.span();
            for place in [plane.place(from), plane.place(to)] {
                prop_assert!(is_in(place, -1e-9) && !is_in(place, 1e-9), "{place:?}");
            }
            let s = from + (to - from) * share;
            let point = section.point(s);
            let expected = surface.height(point.x, point.y).unwrap();
            // Where a sheet ends the last digit of a place decides.
            let beside = [-1e-6, 1e-6].map(|by| surface.height(point.x + by, point.y + by).unwrap());
            let is_near = |height: f64| (point.z - height).abs() < 1e-4;
            prop_assert!(is_near(expected) || beside.into_iter().any(is_near), "{point:?} {expected}");
        }
    }

    #[test]
    fn sections_along_y_are_those_of_the_surface_itself() {
        let surface = surface_over(&wavy(100.0, 60.0), FIXED, 100.0, 60.0);
        let section = surface
            .section_by(Upright::new(Angle::ZERO, Length::mm(12.5)))
            .unwrap()
            .unwrap();
        assert_eq!(section.profile, surface.section(12.5).unwrap());
        assert_eq!(
            surface.section_by(Upright::new(Angle::ZERO, Length::mm(60.5))),
            Ok(None)
        );
        assert_eq!(
            surface.section_by(Upright::new(Angle::ZERO, Length::mm(f64::NAN))),
            Ok(None)
        );
    }

    #[test]
    fn holes_are_refused_and_cracks_are_not() {
        let hole = |gap: f64| {
            let mesh = crate::testkit::rectangles([[0.0, 30.0, 1.0], [30.0 + gap, 60.0, 2.0]]);
            surface_over(&mesh, FIXED, 100.0, 60.0)
        };
        let along_y = Upright::new(Angle::deg(90.0), Length::mm(-50.0));
        assert!(hole(0.5).section_by(along_y).is_err());
        let section = hole(0.005).section_by(along_y).unwrap().unwrap();
        assert_eq!(section.point(45.0), Point3::new(50.0, 45.0, 2.0));
        let along_crack = Upright::new(Angle::ZERO, Length::mm(30.0025));
        assert_eq!(
            hole(0.005).section_by(along_crack).unwrap().unwrap().point(7.0).z,
            2.0
        );
    }

    #[test]
    fn planes_divide_the_plan_evenly() {
        let plan = Plan {
            width: Length::mm(100.0),
            depth: Length::mm(60.0),
        };
        let along_y = across(plan, Angle::deg(90.0), Length::mm(8.0)).unwrap();
        assert_eq!(along_y.len(), 13);
        let x = along_y.iter().map(|plane| plane.place(10.0)[0]);
        assert!(
            x.clone().is_sorted_by(|a, b| a > b),
            "from right to left of the heading"
        );
        let first = along_y[12].place(10.0);
        assert!((first[0] - 50.0 / 13.0).abs() < 1e-12 && (first[1] - 10.0).abs() < 1e-12);
        assert_eq!(across(plan, Angle::deg(30.0), Length::ZERO), None);
        let slanted = across(plan, Angle::deg(30.0), Length::mm(8.0)).unwrap();
        let surface = surface_over(&sampled(100.0, 60.0, [1, 1], &|_, _| 0.0), FIXED, 100.0, 60.0);
        assert!(
            slanted
                .iter()
                .all(|plane| surface.section_by(*plane).unwrap().is_some())
        );
    }
}
