//! The proof that the body of a blade, which is all of it above its edge, stays out of the work.
//!
//! A body is made of cylinders about the blade's axis ([`stage`]). The work is its cross-section swept along y, and a cut
//! leads through all of its depth, so a body meets material in a cut if and only if its shadow on the x-z plane ([`shadow`])
//! meets the section as it is before that cut. A shadow lies above the section where it lies above it over every x: that
//! is the clearance, measured along z.
//!
//! On straight ways through the air the same holds of those discs of a body that come over the stock; each counts whole
//! where any of it does. While the blade turns, or its tip goes on an arc, the way is cut into spans: the cylinders of the middle
//! of a span, grown by how far any of their points gets in half of it, contain all that the body covers meanwhile ([`turn`]).
//! Moves of all axes have no straight way; the proof of the machine's motions compares bodies with the whole stock in them.
//!
//! Where cuts follow a spine, the work is its section raised by the spine at every y. It lies below a plane that touches the spine
//! below the blade and is raised above it wherever the body is ([`slant`]); seen along that plane, all of this holds as before.

mod backbone;
mod section;
mod shadow;
mod slant;
mod stage;
#[cfg(test)]
mod tests;
mod turn;

use super::course::{Course, Way};
use super::prove::{Bound, Passes, accompanied};
use super::surface::Surface;
use backbone::Backbone;
use section::{Ceiling, Near, Section};
use slant::Slant;
use stage::{Axis, Cylinder};
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, BodyStage, CutKind, OpId, OperationId, Program, Site, Stage, Stock, ToolId,
};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_geometry::curve::Point2;

/// Depth below which contact is rounding: a nanometre.
const TOUCH: f64 = 1e-6;

/// How the bodies of a program's blades pass the work.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bodies {
    /// How many motions take a body into the work, and the worst of them: the deepest cut, or if only ways do, the deepest way.
    pub contact: Option<(usize, Contact)>,
    /// Where a body comes nearest above the work in a straight cut.
    pub nearest: Option<Passage>,
}

/// A body at its place nearest to the work in a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The motion.
    pub op: OpId,
    /// What of the job it serves.
    pub site: Site,
    pub operation: OperationId,
    /// The blade.
    pub tool: ToolId,
    /// What it cuts in that operation.
    pub kind: CutKind,
    /// The stage, counted from the edge.
    pub stage: usize,
    /// Where on the body.
    pub at: Point2,
    /// How far above the work that is, along z; negative within.
    pub clearance: Length,
}

/// A body that enters the work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where it goes deepest.
    pub passage: Passage,
    /// In what motion.
    pub during: During,
    /// How deep in the part or its allowance it comes in the same motion.
    pub in_part: Option<Length>,
}

/// The kinds of motions that bodies are looked at in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum During {
    Way,
    Cut,
}

/// Whether a program has a blade whose body is known.
#[must_use]
pub fn is_stated(program: &Program) -> bool {
    program.blades.iter().any(|blade| blade.body.is_some())
}

/// How the bodies of a program's blades pass the work. `bounds` are the operations' own, in order.
#[must_use]
pub fn bodies(verified: &VerifiedProgram, bounds: &[Bound<'_>]) -> Bodies {
    watched(verified, bounds, &mut |_| {})
}

/// Whether a body misses a section, given by its corners, while the tip goes along y from one place to another and the blade
/// is held like this.
#[must_use]
pub fn clears(
    body: &[BodyStage],
    held: Orientation,
    [from, to]: [Point3; 2],
    stock: Stock,
    section: &[Point2],
) -> bool {
    let way = Way { from, to };
    Cylinder::all(body).into_iter().all(|cylinder| {
        let nearest = cylinder
            .shadow(Axis::of(held), way, stock, Slant::default())
            .and_then(|shadow| shadow.nearest_above(section));
        nearest.is_none_or(|(_, gap)| gap >= -TOUCH)
    })
}

/// Where a stage, grown by `by` mm on all sides, enters the section of the stock; in x and z, in mm. The tip is at one place, the unit
/// vector points from it to the shank, and the section is given by its corners. A negative `by` shrinks the stage. Each disc of it
/// counts whole where any of it is over the stock.
#[must_use]
pub fn meets(
    stage: Stage,
    by: f64,
    (tip, axis): (Point3, [f64; 3]),
    stock: Stock,
    section: &[Point2],
) -> Option<Point2> {
    let way = Way { from: tip, to: tip };
    let cylinder = Cylinder::from(stage).grown(by);
    let shadow = cylinder.shadow(Axis(axis), way, stock, Slant::default())?;
    let (place, gap) = shadow.nearest_above(section)?;
    (gap < 0.0).then_some(place)
}

/// As [`bodies`], and shows every motion that takes a body into the work.
#[must_use]
pub fn watched(verified: &VerifiedProgram, bounds: &[Bound<'_>], watch: &mut dyn FnMut(Contact)) -> Bodies {
    let program = verified.program();
    if !is_stated(program) {
        return Bodies::default();
    }
    let mut watcher = Watcher::new(program, bounds, watch);
    let mut segments = program.segments();
    accompanied(verified, bounds, &mut |_, surface| {
        if let Some(segment) = segments.next() {
            watcher.motion(&segment, surface);
        }
    });
    watcher.found
}

struct Watcher<'p> {
    program: &'p Program,
    bounds: &'p [Bound<'p>],
    /// Of each blade.
    stages: Vec<Vec<Cylinder>>,
    ceiling: Ceiling,
    /// What the cuts follow, all alike.
    backbone: Option<Backbone<'p>>,
    found: Bodies,
    watch: &'p mut dyn FnMut(Contact),
}

impl<'p> Watcher<'p> {
    fn new(program: &'p Program, bounds: &'p [Bound<'p>], watch: &'p mut dyn FnMut(Contact)) -> Self {
        let blades = program.blades.iter();
        let stages = blades.map(|blade| Cylinder::all(blade.body.as_deref().unwrap_or_default()));
        Self {
            program,
            bounds,
            stages: stages.collect(),
            ceiling: Ceiling::of(program.stock),
            backbone: bounds
                .iter()
                .find_map(|bound| bound.spine)
                .map(|spine| Backbone::new(spine, program)),
            found: Bodies::default(),
            watch,
        }
    }

    fn motion(&mut self, segment: &Segment<'_>, surface: &mut Surface) {
        let course = Course::of(self.program, segment);
        let (Some(course), Some(operation)) = (course, segment.op.site.operation()) else {
            return;
        };
        let during = match segment.op.action {
            Action::Cut { .. } | Action::Follow { .. } => During::Cut,
            _ => During::Way,
        };
        if during == During::Cut && self.takes_skin_off(operation) {
            // Strips run over the body there; the proof of passes says how thick they may be, and what must not be in its way.
            return;
        }
        self.ceiling.grow_older(surface);
        let mut section = Section {
            stock: self.program.stock,
            surface,
            ceiling: &self.ceiling,
            backbone: self.backbone,
        };
        let Some(near) = self.nearest(&course, segment.before.tool, during, &mut section) else {
            return;
        };
        let passage = Passage {
            op: segment.id,
            site: segment.op.site,
            operation,
            tool: segment.before.tool,
            kind: self.program.cut_kind(operation, segment.before.tool),
            stage: near.stage,
            at: near.at,
            clearance: Length::mm(near.gap),
        };
        if near.gap < -TOUCH {
            let in_part = self.in_part((operation, segment.before.tool), near);
            self.note(Contact {
                passage,
                during,
                in_part,
            });
        } else if during == During::Cut {
            self.found.nearest = Some(passage);
        }
    }

    /// Whether what its cuts take is judged elsewhere, and with that how bodies pass it.
    fn takes_skin_off(&self, operation: OperationId) -> bool {
        let bound = self.bounds.get(usize::from(operation.0));
        matches!(
            bound.and_then(|bound| bound.passes),
            Some(Passes::Skin(_) | Passes::Tracks(_) | Passes::Region)
        )
    }

    /// Where the body comes nearest above the section: in a straight cut, if nearer than in any before; on other ways, if it
    /// enters.
    fn nearest(
        &self,
        course: &Course,
        tool: ToolId,
        during: During,
        section: &mut Section<'_>,
    ) -> Option<Near> {
        let stages = self.stages.get(usize::from(tool.0))?;
        let Some((way, held)) = course.straight() else {
            return turn::entry(course, stages, section);
        };
        let known = self
            .found
            .nearest
            .map_or(f64::INFINITY, |near| near.clearance.to_mm());
        let within = match during {
            During::Cut => known,
            During::Way => -TOUCH,
        };
        section.nearest(stages, Axis::of(held), way, within)
    }

    /// How deep in the part a body comes that enters the stock.
    fn in_part(&self, (operation, tool): (OperationId, ToolId), near: Near) -> Option<Length> {
        let cylinder = self.stages.get(usize::from(tool.0))?.get(near.stage)?;
        let part = self.bounds.get(usize::from(operation.0))?.part;
        let shadow = cylinder.shadow(near.axis, near.way, self.program.stock, near.slant)?;
        let (_, gap) = shadow.nearest_above(part.points())?;
        (gap < -TOUCH).then(|| Length::mm(-gap))
    }

    fn note(&mut self, contact: Contact) {
        (self.watch)(contact);
        let worse = |known: &Contact| {
            let rank = |contact: &Contact| (contact.during, -contact.passage.clearance.to_mm());
            let ((during, depth), (known_during, known_depth)) = (rank(&contact), rank(known));
            during > known_during || (during == known_during && depth > known_depth + TOUCH)
        };
        match &mut self.found.contact {
            Some((count, known)) => {
                *count += 1;
                if worse(known) {
                    *known = contact;
                }
            }
            None => self.found.contact = Some((1, contact)),
        }
    }
}
