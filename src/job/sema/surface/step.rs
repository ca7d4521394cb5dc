//! `step "wing.stp"`: the B-spline surfaces of a STEP file.
//!
//! The file states its own unit. If the job states one as well, it must be the same.

use super::content::{Content, Loaded, MESH_UNITS, Misread, Named, broken, partly_read, without_unit};
use super::nurbs;
use crate::Sourced;
use crate::sema::fields::{BlockSpec, Fields, Inner, Takes, value};
use crate::sema::frame;
use crate::sema::part::Part;
use crate::sema::quantity::{mm, number};
use crate::sema::read::words_of;
use crate::sema::report::{Checked, Reported};
use crate::sema::session::Session;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::import::{Advice, ReadStep, Remarks, Step, StepError};
use vcutc_surface::patch;

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`step`",
    fields: &[
        value("unit", "mm").takes(Takes::Words(|| words_of(MESH_UNITS))),
        value("place", frame::PLACE).takes(Takes::Calls(frame::PLACES)),
    ],
    inner: Inner::Refused,
};

/// Units whose ratio differs from 1 by less are the same.
const SAME_UNIT: f64 = 1e-9;

/// Why there are no surfaces.
enum Fault {
    Misread(StepError),
    NoUnit,
    /// The file states another one than the job, in mm.
    OtherUnit(f64),
}

impl From<StepError> for Fault {
    fn from(error: StepError) -> Self {
        Self::Misread(error)
    }
}

/// The triangles of a file's surfaces.
pub(super) fn content(
    named: &Named<'_>,
    unit: Option<Sourced<f64>>,
    fields: &Fields<'_>,
    loaded: Loaded,
    session: &mut Session<'_>,
) -> Checked<Content> {
    let path = named.path;
    let Loaded {
        path: resolved,
        bytes,
        hash,
    } = loaded;
    let ReadStep { surfaces, remarks } = match read(&bytes, unit) {
        Ok(found) => found,
        Err(Fault::Misread(error)) => {
            return Err(broken(misread(error, path), path, &resolved, bytes, session));
        }
        Err(Fault::NoUnit) => {
            let says = ("the file does not state the unit of its lengths", None);
            return Err(without_unit(path, says, fields, session));
        }
        Err(Fault::OtherUnit(size)) => return Err(other_unit(size, unit, path, session)),
    };
    session.sources.add(resolved, hash);
    if let Some(diagnostic) = remarked(&remarks, path) {
        session.reports.push(diagnostic);
    }
    match patch::several(&surfaces, Part::SURFACE_TOLERANCE) {
        Ok(mesh) => Ok(Content {
            mesh,
            unit: 1.0,
            tolerance: Part::SURFACE_TOLERANCE,
        }),
        Err(error) => Err(session.reports.push(nurbs::impossible(error, named.head()))),
    }
}

/// A mesh by the name of its file.
pub(super) fn a_mesh(named: &Named<'_>) -> Diagnostic {
    let path = named.path;
    let diagnostic = Diagnostic::new(
        Code::BadMesh,
        format!("`{}` is a mesh, not a STEP file", path.node),
        path.span,
        "a file of triangles by its name",
    );
    diagnostic.fix("write `mesh`", named.kind.span, "mesh")
}

fn read(bytes: &[u8], stated: Option<Sourced<f64>>) -> Result<ReadStep, Fault> {
    let mut step = Step::scan(bytes)?;
    let own = step.unit()?.map(Length::to_mm);
    let unit = match (own, stated) {
        (Some(own), Some(stated)) if (own / stated.value - 1.0).abs() > SAME_UNIT => {
            return Err(Fault::OtherUnit(own));
        }
        (Some(own), _) => own,
        (None, Some(stated)) => stated.value,
        (None, None) => return Err(Fault::NoUnit),
    };
    Ok(step.surfaces(Length::mm(unit))?)
}

fn misread(error: StepError, path: &Spanned<String>) -> Misread {
    let refused = |help: &'static str| {
        (
            Code::ImpossibleSurface,
            format!("`{}` is not read as a surface", path.node),
            help,
        )
    };
    let (code, headline, help) = match error.advice {
        Advice::Repair => (
            Code::BadMesh,
            format!("`{}` has an error", path.node),
            "correct this place in the file, or export it again",
        ),
        Advice::Untrim => refused(
            "untrim the face in the CAD system, so that its edges are the border of its surface, or export the part as STL and read it by `mesh`",
        ),
        Advice::OnlySplines => refused(
            "export only the faces on top of the part, as B-spline surfaces, or export the part as STL and read it by `mesh`",
        ),
        Advice::Alone => refused(
            "export the part alone, not as a component of an assembly; `place` moves it to where it belongs",
        ),
        Advice::Mesh => refused("export the part as STL and read it by `mesh`"),
    };
    Misread {
        error: error.place,
        code,
        headline,
        help,
    }
}

fn other_unit(
    own: f64,
    stated: Option<Sourced<f64>>,
    path: &Spanned<String>,
    session: &mut Session<'_>,
) -> Reported {
    let mut units = MESH_UNITS.iter();
    let word = units
        .find(|(_, size)| (size / own - 1.0).abs() <= SAME_UNIT)
        .map(|(word, _)| *word);
    let stated = stated.and_then(|stated| stated.span).unwrap_or(path.span);
    let shown = word.map_or_else(|| format!("units of {}", mm(own)), str::to_owned);
    let diagnostic = Diagnostic::new(
        Code::MeshWithoutUnit,
        format!("`{}` states another unit than the job", path.node),
        stated,
        format!("the file is in {shown}"),
    )
    .note("a STEP file states the unit of its lengths, so `unit` can be left out");
    session.reports.push(match word {
        Some(word) => diagnostic.fix("take the unit of the file", stated, word),
        None => diagnostic.help("delete `unit`"),
    })
}

/// What of a file is not taken.
fn remarked(remarks: &Remarks, path: &Spanned<String>) -> Option<Diagnostic> {
    let skipped = remarks.passed_over.iter();
    let notes: Vec<String> = skipped
        .map(|(name, count)| format!("{name}: {}, skipped", number(*count as f64)))
        .collect();
    partly_read(
        path,
        "skipped",
        "more is in it than faces on B-spline surfaces",
        notes,
    )
    .map(|diagnostic| diagnostic.help("export only the faces on top of the part"))
}
