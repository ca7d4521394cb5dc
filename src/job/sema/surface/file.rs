//! Files of surfaces: `mesh "fairing.stl" { unit = mm }`, `grid "heights.csv"`, and what they share with `step "wing.stp"`.
//!
//! A file of triangles may be binary and far larger than other files. Only its length and its hash become a source of the run;
//! its text does where it is text and a place in it has to be shown.

use super::content::{Content, Loaded, MESH_UNITS, Misread, Named, broken, partly_read, without_unit};
use super::seat::Seat;
use super::{Drawn, judge, placed, step};
use crate::Sourced;
use crate::sema::eval::Scope;
use crate::sema::fields::{BlockSpec, Fields, Inner, Takes, value};
use crate::sema::files::{Relative, not_loaded};
use crate::sema::frame;
use crate::sema::kept_surfaces::Asked;
use crate::sema::part::Part;
use crate::sema::profile::data::{as_text, bad_data, bytes_of, place_of};
use crate::sema::quantity::{mm, number};
use crate::sema::read::{Reader, words_of};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{LARGEST_MESH_FILE, Span, Spanned, join_path};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::import::{self, DataError, ReadMesh, Remarks};
use vcutc_surface::mesh::Mesh;
use vcutc_surface::surface::{Placement, SurfaceError};
use vcutc_syntax::ast::SurfaceFile;
use vcutc_syntax::fingerprint;

pub(crate) const MESH: BlockSpec = BlockSpec {
    title: "`mesh`",
    fields: &[
        value("unit", "mm")
            .required()
            .takes(Takes::Words(|| words_of(MESH_UNITS))),
        value("place", frame::PLACE).takes(Takes::Calls(frame::PLACES)),
    ],
    inner: Inner::Refused,
};

pub(crate) const GRID: BlockSpec = BlockSpec {
    title: "`grid`",
    fields: &[
        value("unit", "mm").takes(Takes::Words(|| words_of(GRID_UNITS))),
        value("place", frame::PLACE).takes(Takes::Calls(frame::PLACES)),
    ],
    inner: Inner::Refused,
};

/// Units of files of heights, in mm: those of points.
const GRID_UNITS: &[(&str, f64)] = &[("mm", 1.0), ("in", 25.4), ("m", 1000.0)];

/// Lines of an OBJ file that say nothing about the place of a triangle.
const WITHOUT_A_SHAPE: &[&str] = &["vn", "vt", "vp", "g", "o", "s", "mtllib", "usemtl"];

/// The part that a file describes.
pub(super) fn part(
    named: &Named<'_>,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Part> {
    let (spec, units) = match named.kind.node {
        SurfaceFile::Mesh => (&MESH, MESH_UNITS),
        SurfaceFile::Grid => (&GRID, GRID_UNITS),
        SurfaceFile::Step => (&step::SPEC, MESH_UNITS),
    };
    let fields = Fields::sort(spec, place_of(named.path, named.span), named.options, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let unit = reader.choice(&fields, "unit", units);
    let place = place(&fields, &mut reader);
    let (unit, frame) = (unit?, place?);
    let reported = session.reports.count();
    let loaded = loaded(named, unit, &fields, session)?;
    let asked = loaded.as_ref().map(|loaded| Asked {
        content: loaded.hash.clone(),
        kind: named.kind.node,
        ending: ending_of(&named.path.node),
        unit: unit.map(|unit| unit.value),
        place: frame,
        stock: stock.node,
    });
    let is_whole = session.damage_at(named.span).is_none();
    if let (Some(surfaces), Some(asked), Some(loaded), true) = (session.surfaces, &asked, &loaded, is_whole)
        && let Some(part) = surfaces.find(asked)
    {
        session.sources.add(loaded.path.clone(), loaded.hash.clone());
        return Ok(part);
    }
    let size = unit.map_or(1.0, |unit| unit.value);
    let (content, word, units) = match (named.kind.node, loaded) {
        // The unit of its numbers is beyond doubt.
        (SurfaceFile::Step, Some(loaded)) => (
            step::content(named, unit, &fields, loaded, session)?,
            "surface",
            [].as_slice(),
        ),
        (_, Some(loaded)) => {
            let mesh = triangles(named, size, loaded, session)?;
            (Content::exact(mesh, size), "mesh", units)
        }
        (_, None) => (Content::exact(heights(named, session)?, size), "grid", units),
    };
    let placement = Placement {
        frame,
        unit: Length::mm(content.unit),
    };
    let seat = Seat {
        mesh: &content.mesh,
        word,
        placement,
        tolerance: content.tolerance,
        units,
        stock: stock.node,
        fields: &fields,
        given: fields.value("place")?.map(|expr| expr.span),
    };
    if let Some(reported) = session.damage_at(named.span) {
        return Err(reported);
    }
    let part = seated(&seat, named.head(), stock, session)?;
    if let (Some(surfaces), Some(asked), true) =
        (session.surfaces, asked, session.reports.count() == reported)
    {
        surfaces.keep(asked, part.clone());
    }
    Ok(part)
}

/// The part that a mesh in its place makes of the stock.
fn seated(seat: &Seat<'_>, head: Span, stock: Spanned<Stock>, session: &mut Session<'_>) -> Checked<Part> {
    let offer = |diagnostic| seat.offer(diagnostic);
    match placed(seat.mesh, &seat.placement, seat.tolerance, stock.node) {
        Ok(surface) => {
            let drawn = Drawn {
                surface,
                profile: None,
                exact: None,
            };
            judge::part(drawn, head, stock, &offer, &mut session.reports)
        }
        Err(error) => Err(session.reports.push(match error {
            SurfaceError::Elsewhere { .. } => offer(judge::elsewhere(error, head, stock)),
            SurfaceError::BadPlan | SurfaceError::OutOfRange => super::not_made(error, head),
        })),
    }
}

/// The file of a mesh or of B-spline surfaces; none of a table of heights.
fn loaded(
    named: &Named<'_>,
    unit: Option<Sourced<f64>>,
    fields: &Fields<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Loaded>> {
    match (named.kind.node, unit) {
        (SurfaceFile::Grid, _) => return Ok(None),
        (SurfaceFile::Mesh, None) => {
            let note = "STL, OBJ and PLY files do not state one";
            let says = ("numbers without a unit", Some(note));
            return Err(without_unit(named.path, says, fields, session));
        }
        (SurfaceFile::Mesh, Some(_)) if reader_of(&named.path.node).is_none() => {
            return Err(session.reports.push(no_mesh(named)));
        }
        (SurfaceFile::Step, _) if is_mesh(&named.path.node) => {
            return Err(session.reports.push(step::a_mesh(named)));
        }
        (SurfaceFile::Mesh | SurfaceFile::Step, _) => {}
    }
    load(named.path, session).map(Some)
}

fn place(fields: &Fields<'_>, reader: &mut Reader<'_>) -> Checked<Frame> {
    match fields.value("place")? {
        Some(expr) => frame::plain("place", expr, reader),
        None => Ok(super::AT_THE_CORNER),
    }
}

type Read = fn(&[u8]) -> Result<ReadMesh, DataError>;

/// The reader of a file of triangles, by its ending.
fn reader_of(path: &str) -> Option<Read> {
    match ending_of(path).as_str() {
        "stl" => Some(import::stl),
        "obj" => Some(import::obj),
        "ply" => Some(import::ply),
        _ => None,
    }
}

/// The ending of a name in small letters; empty where it has none.
fn ending_of(path: &str) -> String {
    let ending = path
        .rsplit_once('.')
        .map(|(_, ending)| ending.to_ascii_lowercase());
    ending.unwrap_or_default()
}

/// Whether a file is a mesh by its ending.
pub(super) fn is_mesh(path: &str) -> bool {
    reader_of(path).is_some()
}

/// Whether a file is a STEP file by its ending.
fn is_step(path: &str) -> bool {
    matches!(ending_of(path).as_str(), "stp" | "step" | "p21")
}

/// Whether a file is a table by its ending.
fn is_table(path: &str) -> bool {
    matches!(ending_of(path).as_str(), "csv" | "tsv" | "txt" | "dat" | "xyz")
}

/// A name that does not end as those of meshes do.
fn no_mesh(named: &Named<'_>) -> Diagnostic {
    let path = named.path;
    let diagnostic = Diagnostic::new(
        Code::BadMesh,
        format!("`{}` is not a mesh in a form that the compiler reads", path.node),
        path.span,
        "not a file in STL, OBJ or PLY",
    )
    .note("the ending of the name says what a file holds: .stl, .obj, .ply");
    if is_table(&path.node) {
        let title = "if it is a table of x, y and z, write `grid`";
        diagnostic.fix(title, named.kind.span, "grid")
    } else if is_step(&path.node) {
        let title = "write `step` to read its B-spline surfaces";
        diagnostic.fix(title, named.kind.span, "step")
    } else {
        diagnostic.help("export the part as STL")
    }
}

/// The triangles of a file, in its own unit, which is so many mm.
fn triangles(named: &Named<'_>, unit: f64, loaded: Loaded, session: &mut Session<'_>) -> Checked<Mesh> {
    let path = named.path;
    let Some(read) = reader_of(&path.node) else {
        return Err(session.reports.push(no_mesh(named)));
    };
    let Loaded {
        path: resolved,
        bytes,
        hash,
    } = loaded;
    let ReadMesh { mesh, remarks } = match read(&bytes) {
        Ok(found) => found,
        Err(error) => {
            let misread = Misread {
                error,
                code: Code::BadMesh,
                headline: format!("`{}` has an error", path.node),
                help: "correct this place in the file, or export it again",
            };
            return Err(broken(misread, path, &resolved, bytes, session));
        }
    };
    session.sources.add(resolved, hash);
    if let Some(diagnostic) = remarked(&remarks, path, unit) {
        session.reports.push(diagnostic);
    }
    Ok(mesh)
}

fn load(path: &Spanned<String>, session: &mut Session<'_>) -> Checked<Loaded> {
    let resolved = join_path(session.sources.name(path.span.file), &path.node);
    match session.loader.load_data(&resolved, LARGEST_MESH_FILE) {
        Ok(bytes) => Ok(Loaded {
            path: resolved,
            hash: fingerprint::of_data(&bytes),
            bytes,
        }),
        Err(error) => {
            let diagnostic = not_loaded(&path.span, &resolved, Relative::ToItsFile, &error, session);
            Err(session.reports.push(diagnostic))
        }
    }
}

/// What of a file of triangles is not taken as it stands.
fn remarked(remarks: &Remarks, path: &Spanned<String>, unit: f64) -> Option<Diagnostic> {
    let mut notes = Vec::new();
    let bent = remarks.most_bent * unit;
    if remarks.bent > 0 && bent > Part::TOLERANCE.to_mm() {
        notes.push(format!(
            "polygons that are not plane: {}, by up to {}; taken as triangles about one of their corners",
            remarks.bent,
            mm(bent)
        ));
    }
    let skipped = remarks.passed_over.iter();
    for (name, count) in skipped.filter(|(name, _)| !WITHOUT_A_SHAPE.contains(&name.as_str())) {
        notes.push(format!("`{name}`: {}, skipped", number(*count as f64)));
    }
    partly_read(
        path,
        "skipped or interpreted",
        "more is in it than triangles",
        notes,
    )
    .map(|diagnostic| diagnostic.help("export the part as triangles, for example as STL"))
}

/// The heights of a file on a grid, in its own unit.
fn heights(named: &Named<'_>, session: &mut Session<'_>) -> Checked<Mesh> {
    let path = named.path;
    if reader_of(&path.node).is_some() {
        let diagnostic = Diagnostic::new(
            Code::BadData,
            format!("`{}` is a mesh, not heights on a grid", path.node),
            path.span,
            "a file of triangles by its name",
        );
        let diagnostic = diagnostic.fix("write `mesh`", named.kind.span, "mesh");
        return Err(session.reports.push(diagnostic));
    }
    let (resolved, bytes) = bytes_of(path, session)?;
    let file = as_text(&resolved, bytes, path, session)?;
    let text = session.sources.get(file).map_or("", |file| file.text.as_str());
    import::heights(text.as_bytes()).map_err(|error| session.reports.push(bad_data(error, file, path)))
}
