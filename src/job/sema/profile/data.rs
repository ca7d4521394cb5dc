//! Points from files: `points "file.csv"` and `airfoil "file.dat"`.
//!
//! The files are read by plain line readers, so they may hold a million lines. They go into the source map too, so
//! that a line that cannot be understood can be shown.

use super::repairs;
use crate::sema::eval::Scope;
use crate::sema::field_ranges::{COORDINATE, SCALE, SIZE};
use crate::sema::fields::{BlockSpec, Fields, Inner, Place, Takes, value};
use crate::sema::files::{Relative, not_loaded, text_of};
use crate::sema::read::{Reader, words_of};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{FileId, Span, Spanned, join_path};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::{LARGEST_COORDINATE, Point2};
use vcutc_geometry::import::{self, DataError, Side};
use vcutc_syntax::ast::Entry;

pub(crate) const POINTS: BlockSpec = BlockSpec {
    title: "`points`",
    fields: &[
        value("unit", "mm").takes(Takes::Words(|| words_of(FILE_UNITS))),
        value("x", "0 mm").within(COORDINATE),
        value("z", "0 mm").within(COORDINATE),
        value("scale", "1").within(SCALE),
    ],
    inner: Inner::Refused,
};

pub(crate) const AIRFOIL: BlockSpec = BlockSpec {
    title: "`airfoil`",
    fields: &[
        value("side", "upper")
            .required()
            .takes(Takes::Words(|| words_of(SIDES))),
        value("chord", "300 mm").required().within(SIZE),
        value("x", "0 mm").within(COORDINATE),
        value("z", "10 mm").within(COORDINATE),
        value("flip", "none").takes(Takes::Words(|| words_of(FLIPS))),
    ],
    inner: Inner::Refused,
};

/// Units of a file of points, in mm.
const FILE_UNITS: &[(&str, f64)] = &[("mm", 1.0), ("in", 25.4), ("m", 1000.0)];

const SIDES: &[(&str, Side)] = &[("upper", Side::Upper), ("lower", Side::Lower)];

/// Which way an airfoil points.
#[derive(Clone, Copy)]
enum Flip {
    /// Leading edge at the left.
    None,
    /// Leading edge at the right.
    X,
}

const FLIPS: &[(&str, Flip)] = &[("none", Flip::None), ("x", Flip::X)];

/// The place of a piece as that of a block.
pub(crate) const fn place_of(path: &Spanned<String>, piece: Span) -> Place {
    Place {
        head: path.span,
        whole: piece,
    }
}

/// Points of a CSV file, moved and stretched into the workpiece frame.
pub(super) fn points(
    path: &Spanned<String>,
    options: &[Entry],
    piece: Span,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Vec<Point2>> {
    let fields = Fields::sort(&POINTS, place_of(path, piece), options, session);
    let file = load(path, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let unit = reader.choice(&fields, "unit", FILE_UNITS);
    let x = reader.defaulted(&fields, "x", Length::ZERO);
    let z = reader.defaulted(&fields, "z", Length::ZERO);
    let scale = reader.defaulted(&fields, "scale", 1.0);
    let raw = read(file?, path, import::csv, session)?;
    let factor = unit?.map_or(1.0, |unit| unit.value) * scale?.value;
    let (x, z) = (x?.value.to_mm(), z?.value.to_mm());
    let points = raw.into_iter().map(|point| Point2 {
        x: point.x * factor + x,
        z: point.z * factor + z,
    });
    in_range(points.collect(), path, session)
}

/// One side of an airfoil, put into the workpiece frame.
pub(super) fn airfoil(
    path: &Spanned<String>,
    options: &[Entry],
    piece: Span,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Vec<Point2>> {
    let fields = Fields::sort(&AIRFOIL, place_of(path, piece), options, session);
    let file = load_airfoil(path, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let side = fields
        .required_value("side", reader.reports)
        .and_then(|expr| reader.word("side", expr, SIDES));
    let chord = reader.required::<Length>(&fields, "chord");
    let x = reader.defaulted(&fields, "x", Length::ZERO);
    let z = reader.defaulted(&fields, "z", Length::ZERO);
    let flip = reader.choice(&fields, "flip", FLIPS);
    let file = file?;
    let airfoil = read(file, path, import::airfoil, session)?;
    let (side, chord) = (side?.value, chord?.value);
    repairs::report(
        &airfoil.repairs,
        &repairs::Taken {
            file,
            path,
            side,
            chord,
        },
        session,
    )?;
    let side = match side {
        Side::Upper => airfoil.upper,
        Side::Lower => airfoil.lower,
    };
    let (chord, x, z) = (chord.to_mm(), x?.value.to_mm(), z?.value.to_mm());
    let flip = flip?.map_or(Flip::None, |flip| flip.value);
    let mut points: Vec<Point2> = side
        .into_iter()
        .map(|point| Point2 {
            x: x + chord
                * match flip {
                    Flip::None => point.x,
                    Flip::X => 1.0 - point.x,
                },
            z: z + chord * point.z,
        })
        .collect();
    // The next piece continues at the right end.
    match flip {
        Flip::None => {}
        Flip::X => points.reverse(),
    }
    in_range(points, path, session)
}

/// Loads a data file.
fn load(path: &Spanned<String>, session: &mut Session<'_>) -> Checked<FileId> {
    let (resolved, bytes) = bytes_of(path, session)?;
    as_text(&resolved, bytes, path, session)
}

/// Loads a file of airfoil coordinates, whose title may be in an older code page.
fn load_airfoil(path: &Spanned<String>, session: &mut Session<'_>) -> Checked<FileId> {
    let (resolved, bytes) = bytes_of(path, session)?;
    match import::airfoil_text(bytes) {
        Ok(text) => Ok(session.sources.add(resolved, text)),
        Err(bytes) => as_text(&resolved, bytes, path, session),
    }
}

/// The bytes of a data file, and its path from where the job's own is relative to.
pub(crate) fn bytes_of(path: &Spanned<String>, session: &mut Session<'_>) -> Checked<(String, Vec<u8>)> {
    let resolved = join_path(session.sources.name(path.span.file), &path.node);
    match session.loader.load(&resolved) {
        Ok(bytes) => Ok((resolved, bytes)),
        Err(error) => {
            let diagnostic = not_loaded(&path.span, &resolved, Relative::ToItsFile, &error, session);
            Err(session.reports.push(diagnostic))
        }
    }
}

/// A data file's text as a source of the run.
pub(crate) fn as_text(
    resolved: &str,
    bytes: Vec<u8>,
    path: &Spanned<String>,
    session: &mut Session<'_>,
) -> Checked<FileId> {
    match text_of(session, resolved, bytes, Some(path.span)) {
        (file, None) => Ok(file),
        (_, Some(reported)) => Err(reported),
    }
}

/// Reads a data file.
fn read<T>(
    file: FileId,
    path: &Spanned<String>,
    reader: fn(&str) -> Result<T, DataError>,
    session: &mut Session<'_>,
) -> Checked<T> {
    let text = session.sources.get(file).map_or("", |file| file.text.as_str());
    reader(text).map_err(|error| session.reports.push(bad_data(error, file, path)))
}

/// The diagnostic for a place in a data file that cannot be read.
pub(crate) fn bad_data(error: DataError, file: FileId, path: &Spanned<String>) -> Diagnostic {
    let span = Span {
        file,
        start: error.start,
        end: error.end,
    };
    Diagnostic::new(
        Code::BadData,
        format!("`{}` has an error", path.node),
        span,
        error.message,
    )
    .and(path.span, "the file is named here")
    .help("correct this place in the file")
}

/// Points that are of a size that can mean something.
fn in_range(points: Vec<Point2>, path: &Spanned<String>, session: &mut Session<'_>) -> Checked<Vec<Point2>> {
    let is_good = |point: &Point2| point.x.abs() <= LARGEST_COORDINATE && point.z.abs() <= LARGEST_COORDINATE;
    let Some(bad) = points.iter().find(|point| !is_good(point)) else {
        return Ok(points);
    };
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        "the file has a point out of range",
        path.span,
        format!(
            "a point comes to lie at x = {:.3e} mm, z = {:.3e} mm",
            bad.x, bad.z
        ),
    );
    Err(session.reports.push(diagnostic.help("check `unit` and `scale`")))
}
