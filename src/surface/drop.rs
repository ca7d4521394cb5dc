//! How far a leaning disc comes down on a surface.
//!
//! A face of radius R whose axis leans by `tau` towards the heading `h` covers an ellipse of the plan, with half axes
//! `R cos tau` along `h` and R across. There its height is linear: `z = Cz - tan(tau) p` at a distance p along `h` from the
//! centre. In the coordinates `(p / cos tau, q, z + tan(tau) p)` it is a level round plate of radius R, and triangles stay
//! triangles. So the lowest height of the centre that clears a triangle is the greatest third coordinate over its part in a
//! circle. It is reached at a corner, where a side meets the rim, or where the rim touches the facet at its steepest
//! ([`plate`]). Cylinders on the disc have closed forms in the same coordinates ([`stage`]). All heights are exact up to
//! rounding; the surface counts as its triangles.
//!
//! A plane above each bin of the surface says which bins cannot matter ([`ceiling`]).

mod ceiling;
mod plate;
mod stage;
mod view;

use crate::disc::{Axis, Disc, Stage};
use crate::surface::{Cell, Surface};
use ceiling::Ceilings;
pub(crate) use ceiling::Roofed;
use plate::Plate;
use stage::Cylinder;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;

/// What of a disc meets the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Its face with the edge.
    Face,
    /// A stage of its body, from 0.
    Stage(usize),
}

/// A disc that came down on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// The height of the centre of its face.
    pub height: Length,
    /// Where the disc touches the surface. Of several places one.
    pub touch: Point3,
    /// What touches it.
    pub part: Part,
}

/// A surface that discs come down on.
#[derive(Clone, Debug)]
pub struct Dropper<'s> {
    surface: &'s Surface,
    ceilings: Ceilings,
    /// Its greatest height, in mm.
    highest: f64,
}

impl<'s> Dropper<'s> {
    /// Looks once at all triangles.
    #[must_use]
    pub fn new(surface: &'s Surface) -> Self {
        let heights = surface.mesh().corners().iter().map(|corner| corner.z);
        let highest = heights.fold(f64::NEG_INFINITY, f64::max);
        Self {
            surface,
            ceilings: Ceilings::new(surface),
            highest,
        }
    }

    /// The surface.
    #[must_use]
    pub const fn surface(&self) -> &'s Surface {
        self.surface
    }

    /// The lowest height at which the face of a disc clears the surface, with its centre over a place of the plan, in mm.
    /// The place may lie beyond the plan. None where the face lies over nothing.
    #[must_use]
    pub fn face(&self, radius: Length, place: [f64; 2], axis: Axis) -> Option<Rest> {
        let mut search = Search::new();
        self.bring(&Plate::face(radius.to_mm(), place, axis), Part::Face, &mut search);
        search.rest
    }

    /// The lowest height at which a disc with its body clears the surface, with its centre over a place of the plan, in mm.
    /// The place may lie beyond the plan. None where it lies over nothing.
    #[must_use]
    pub fn disc(&self, disc: &Disc, place: [f64; 2], axis: Axis) -> Option<Rest> {
        let mut search = Search::new();
        self.bring(
            &Plate::face(disc.radius().to_mm(), place, axis),
            Part::Face,
            &mut search,
        );
        for (index, stage) in disc.stages().iter().enumerate() {
            self.bring_stage(
                &Cylinder::new(*stage, place, axis),
                Part::Stage(index),
                &mut search,
            );
        }
        search.rest
    }

    /// The lowest height of the centre of a disc at which one of its stages clears the surface, if it is above a height.
    pub(crate) fn stage(
        &self,
        stage: Stage,
        index: usize,
        place: [f64; 2],
        axis: Axis,
        above: f64,
    ) -> Option<Rest> {
        let mut search = Search {
            rest: None,
            floor: above,
        };
        self.bring_stage(
            &Cylinder::new(stage, place, axis),
            Part::Stage(index),
            &mut search,
        );
        search.rest
    }

    /// A bin with a plane above what lies in it; none without triangles.
    pub(crate) fn roofed(&self, cell: Cell) -> Option<Roofed> {
        self.ceilings.over(cell)
    }

    fn bring_stage(&self, cylinder: &Cylinder, part: Part, search: &mut Search) {
        // What stands too high over its lower end cannot matter.
        let cylinder = cylinder.below(self.highest, search.height());
        self.bring(&cylinder, part, search);
    }

    /// Raises a body until it clears the triangles below it.
    fn bring(&self, body: &impl Body, part: Part, search: &mut Search) {
        let bins = self.surface.bins();
        let [first, last] = bins.touched(body.bounds());
        // The bin that may ask for most comes first, so that most others need no look.
        let mut best: Option<(Cell, f64)> = None;
        for row in first.row..=last.row {
            for column in first.column..=last.column {
                let cell = Cell { column, row };
                if let Some(most) = self.most(body, cell)
                    && best.is_none_or(|(_, before)| most > before)
                {
                    best = Some((cell, most));
                }
            }
        }
        let Some((best, _)) = best.filter(|(_, most)| *most > search.height()) else {
            return;
        };
        self.look(best, body, part, search);
        for row in first.row..=last.row {
            for column in first.column..=last.column {
                let cell = Cell { column, row };
                if cell != best && self.most(body, cell).is_some_and(|most| most > search.height()) {
                    self.look(cell, body, part, search);
                }
            }
        }
    }

    fn most(&self, body: &impl Body, cell: Cell) -> Option<f64> {
        self.ceilings.over(cell).and_then(|bin| body.most(bin))
    }

    fn look(&self, cell: Cell, body: &impl Body, part: Part, search: &mut Search) {
        for &number in self.surface.bins().triangles(cell) {
            let face = self.surface.triangle(number);
            if let Some((height, touch)) = body.clear(face, search.height()) {
                search.rest = Some(Rest {
                    height: Length::mm(height),
                    touch,
                    part,
                });
            }
        }
    }
}

/// The highest that was asked for so far.
#[derive(Debug)]
struct Search {
    rest: Option<Rest>,
    /// What is not above this does not matter, in mm.
    floor: f64,
}

impl Search {
    const fn new() -> Self {
        Self {
            rest: None,
            floor: f64::NEG_INFINITY,
        }
    }

    fn height(&self) -> f64 {
        self.rest.map_or(self.floor, |rest| rest.height.to_mm())
    }
}

/// What comes down.
trait Body {
    /// The box in plan that it lies in: least x and y, greatest x and y.
    fn bounds(&self) -> [f64; 4];

    /// Nothing within a bin makes the centre go higher than this; none if the body is not over the bin.
    fn most(&self, bin: Roofed) -> Option<f64>;

    /// The lowest height of the centre that clears a triangle, and where it touches it; none if that is not above a height.
    fn clear(&self, face: [Point3; 3], above: f64) -> Option<(f64, Point3)>;
}

#[cfg(test)]
mod tests;
