//! STEP: B-spline surfaces of exchange structures (ISO 10303-21) after AP203, AP214 and AP242.
//!
//! A CAD system writes a part as faces, which are parts of surfaces within edges. Faces on B-spline surfaces (with weights
//! or without) are read, if their edges are the borders of these surfaces; so are such surfaces without faces. A face that is
//! trimmed or lies on another kind of surface is refused by its number: a part is never read without its trims. So are
//! assemblies, whose parts are moved where they are used.
//!
//! Time and memory are bounded by the length of the file: an entity takes 16 bytes, and one at a time is read in full.

mod edge;
mod face;
mod file;
mod spline;
#[cfg(test)]
mod tests;
mod tokens;
mod unit;

use super::words::Word;
use super::{DataError, Remarks, fault};
use crate::patch::{MOST_CONTROL, Nurbs};
use core::ops::Range;
use file::{Entity, File, shown, with_article};
use std::collections::BTreeSet;
use vcutc_backend_api::units::Length;

/// Why a STEP file is not read.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// What is not read, and where.
    pub place: DataError,
    /// What to do.
    pub advice: Advice,
}

/// What to do about a file that is not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advice {
    /// The file is damaged.
    Repair,
    /// A face is to be all of its surface.
    Untrim,
    /// Only faces on B-spline surfaces are read.
    OnlySplines,
    /// The part is to be exported in its place.
    Alone,
    /// Only a mesh will do.
    Mesh,
}

/// A STEP file whose entities were found.
pub struct Step<'a> {
    file: File<'a>,
    sorted: Sorted,
}

/// The surfaces of a STEP file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadStep {
    /// The surfaces, in mm, in the order of the numbers of their faces.
    pub surfaces: Vec<Nurbs>,
    /// What was passed over.
    pub remarks: Remarks,
}

/// The entities that matter, by what they are.
#[derive(Debug, Default)]
struct Sorted {
    faces: Vec<Entity>,
    surfaces: Vec<Entity>,
    contexts: Vec<Entity>,
    /// The first surface that is not read, or part of one that is.
    other: Option<(Entity, String)>,
    /// Facets, which are passed over.
    remarks: Remarks,
    /// What moves geometry to where it is used.
    moving: Option<Entity>,
}

/// Reads entities one after the other, with what may still be spent on them.
struct Reading<'a> {
    file: File<'a>,
    /// Of the file, in mm.
    unit: f64,
    cells_left: usize,
    points_left: usize,
}

/// Cells that edges and borders are compared in, of all faces.
const MOST_CELLS: usize = 50_000_000;

/// Points of polylines along edges and borders, of all faces.
const MOST_POINTS: usize = 5_000_000;

impl<'a> Step<'a> {
    /// Finds the entities of a file.
    ///
    /// # Errors
    /// Another kind of file; brackets, texts and comments that do not end; two entities of one number.
    pub fn scan(bytes: &'a [u8]) -> Result<Self, StepError> {
        let file = File::scan(bytes)?;
        let sorted = Sorted::of(&file);
        Ok(Self { file, sorted })
    }

    /// The unit of its lengths, if it states one.
    ///
    /// # Errors
    /// Units of several lengths, and such as are not read.
    pub fn unit(&mut self) -> Result<Option<Length>, StepError> {
        let unit = unit::of_lengths(&mut self.file, &self.sorted.contexts)?;
        Ok(unit.map(Length::mm))
    }

    /// Its surfaces, with lengths in this unit.
    ///
    /// # Errors
    /// Trimmed faces, faces on other surfaces, assemblies, and entities that are damaged.
    pub fn surfaces(self, unit: Length) -> Result<ReadStep, StepError> {
        let Self { file, sorted } = self;
        if let Some(moving) = sorted.moving {
            let message = "this moves a part to where it is used, as in assemblies";
            return Err(refused(moving.range(), message, Advice::Alone));
        }
        let mut reading = Reading {
            file,
            unit: unit.to_mm(),
            cells_left: MOST_CELLS,
            points_left: MOST_POINTS,
        };
        let mut remarks = sorted.remarks;
        let mut surfaces = Vec::new();
        let mut control = 0;
        let mut add = |surface: Nurbs, range: Range<usize>| {
            control += surface.control.len();
            surfaces.push(surface);
            if control > MOST_CONTROL {
                let message = format!("there are more than {MOST_CONTROL} control points up to here");
                return Err(fault(range, message));
            }
            Ok(())
        };
        let mut used = BTreeSet::new();
        for &face in &sorted.faces {
            let (surface, id) = reading.face(face)?;
            add(surface, face.range())?;
            used.insert(id);
        }
        if sorted.faces.is_empty() {
            if let Some((other, kind)) = &sorted.other {
                let message = format!("this is {}, which is not read", with_article(kind));
                return Err(refused(other.range(), message, Advice::OnlySplines));
            }
            for &entity in &sorted.surfaces {
                let instance = reading.file.read(entity)?;
                if let Some(surface) = reading.surface(&instance)? {
                    add(surface, entity.range())?;
                }
            }
        } else {
            let without_a_face = sorted
                .surfaces
                .iter()
                .filter(|surface| !used.contains(&surface.id));
            remarks.pass_over("surface without a face", without_a_face.count());
        }
        if surfaces.is_empty() {
            let message = "there is no B-spline surface in this file";
            return Err(refused(reading.file.whole(), message, Advice::Mesh));
        }
        Ok(ReadStep { surfaces, remarks })
    }
}

/// Facets instead of surfaces, after AP242.
const TESSELLATED: [&str; 5] = [
    "TRIANGULATED_FACE",
    "COMPLEX_TRIANGULATED_FACE",
    "TRIANGULATED_SURFACE_SET",
    "COMPLEX_TRIANGULATED_SURFACE_SET",
    "TESSELLATED_FACE",
];

/// Surfaces of other kinds, and parts of surfaces.
const OTHERS: [&str; 16] = [
    "PLANE",
    "CYLINDRICAL_SURFACE",
    "CONICAL_SURFACE",
    "SPHERICAL_SURFACE",
    "TOROIDAL_SURFACE",
    "DEGENERATE_TOROIDAL_SURFACE",
    "SURFACE_OF_LINEAR_EXTRUSION",
    "SURFACE_OF_REVOLUTION",
    "OFFSET_SURFACE",
    "RECTANGULAR_TRIMMED_SURFACE",
    "CURVE_BOUNDED_SURFACE",
    "RECTANGULAR_COMPOSITE_SURFACE",
    "SURFACE_REPLICA",
    "ORIENTED_FACE",
    "SUBFACE",
    "FACE",
];

/// What moves geometry.
const MOVING: [&str; 3] = [
    "MAPPED_ITEM",
    "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION",
    "SHAPE_REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION",
];

impl Sorted {
    fn of(file: &File<'_>) -> Self {
        let mut sorted = Self::default();
        for &entity in file.entities() {
            for keyword in file.keywords(entity) {
                sorted.take(entity, keyword);
            }
        }
        sorted
    }

    fn take(&mut self, entity: Entity, keyword: Word<'_>) {
        let is_one_of = |kinds: &[&str]| kinds.iter().any(|kind| keyword.is(kind));
        if keyword.is("ADVANCED_FACE") || keyword.is("FACE_SURFACE") {
            self.faces.push(entity);
        } else if spline::is_surface(keyword) {
            self.surfaces.push(entity);
        } else if keyword.is("GLOBAL_UNIT_ASSIGNED_CONTEXT") {
            self.contexts.push(entity);
        } else if is_one_of(&MOVING) {
            self.moving.get_or_insert(entity);
        } else if is_one_of(&TESSELLATED) {
            self.remarks.pass_over(&shown(keyword), 1);
            self.other.get_or_insert_with(|| (entity, shown(keyword)));
        } else if is_one_of(&OTHERS) {
            self.other.get_or_insert_with(|| (entity, shown(keyword)));
        }
    }
}

fn refused(range: Range<usize>, message: impl Into<String>, advice: Advice) -> StepError {
    StepError {
        place: fault(range, message),
        advice,
    }
}
