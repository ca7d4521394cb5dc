//! Profiles from drawings: `dxf "file.dxf"` and `svg "file.svg"`.
//!
//! A reader of [`vcutc_geometry::import`] turns the file into strokes; here the options say which of them count, what their
//! unit is and where they lie, and what is wrong is put into words ([`faults`]).

mod faults;
mod unread;

use super::data::{as_text, bad_data, bytes_of, place_of};
use crate::sema::eval::Scope;
use crate::sema::field_ranges::{COORDINATE, JOINING, SCALE};
use crate::sema::fields::{BlockSpec, FieldSpec, Fields, Inner, Takes, value};
use crate::sema::part::{Part, Section};
use crate::sema::read::{Reader, words_of};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use faults::Told;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{FileId, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::import::drawing::{
    Affine, Drawing, Outline, OutlineError, Side, SideError, Unit, drawn_over, outline, side,
};
use vcutc_geometry::import::{self, DataError, NoText};
use vcutc_syntax::ast::Entry;

/// A format of drawings.
#[derive(Debug)]
pub(crate) struct Format {
    /// The fields behind the file.
    pub(crate) spec: BlockSpec,
    /// Units that the job may give, in mm.
    units: &'static [(&'static str, f64)],
    read: fn(&str, Option<&str>) -> Result<Drawing, DataError>,
    load: fn(&Spanned<String>, &mut Session<'_>) -> Checked<FileId>,
}

pub(crate) static DXF: Format = Format {
    spec: spec("`dxf`", DXF_FIELDS),
    units: DXF_UNITS,
    read: import::dxf,
    load: load_dxf,
};

pub(crate) static SVG: Format = Format {
    spec: spec("`svg`", SVG_FIELDS),
    units: SVG_UNITS,
    read: import::svg,
    load: load_svg,
};

const DXF_UNITS: &[(&str, f64)] = &[
    ("mm", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("in", 25.4),
    ("ft", 304.8),
];

const SVG_UNITS: &[(&str, f64)] = &[
    ("mm", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("in", 25.4),
    ("px", 25.4 / 96.0),
    ("pt", 25.4 / 72.0),
];

const DXF_FIELDS: &[FieldSpec] = &fields(|| words_of(DXF_UNITS));
const SVG_FIELDS: &[FieldSpec] = &fields(|| words_of(SVG_UNITS));

const fn fields(units: fn() -> Vec<&'static str>) -> [FieldSpec; 7] {
    [
        value("layer", "\"SKIN\""),
        value("side", "upper").takes(Takes::Words(|| words_of(SIDES))),
        value("tolerance", "0.01 mm").within(JOINING),
        value("unit", "mm").takes(Takes::Words(units)),
        value("scale", "1").within(SCALE),
        value("x", "0 mm").within(COORDINATE),
        value("z", "0 mm").within(COORDINATE),
    ]
}

const fn spec(title: &'static str, fields: &'static [FieldSpec]) -> BlockSpec {
    BlockSpec {
        title,
        fields,
        inner: Inner::Refused,
    }
}

const SIDES: &[(&str, Side)] = &[("upper", Side::Upper), ("lower", Side::Lower)];

/// Ends of lines that are joined when the job does not say how far they may be apart.
const JOINED: Length = Length::mm(0.01);

struct Options {
    layer: Option<Spanned<String>>,
    side: Option<Side>,
    tolerance: Length,
    /// In mm.
    unit: Option<f64>,
    scale: f64,
    x: Length,
    z: Length,
}

/// Points of an outline, with the place in the drawing that drew them.
pub(super) type Stretch = (Span, Vec<Point2>);

/// What a drawing shows, and its outline as stretches.
pub(super) fn read(
    format: &'static Format,
    path: &Spanned<String>,
    options: &[Entry],
    piece: Span,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<(Section, Vec<Stretch>)> {
    let fields = Fields::sort(&format.spec, place_of(path, piece), options, session);
    let file = (format.load)(path, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let options = read_options(format, &fields, &mut reader);
    let (file, options) = (file?, options?);
    let text = session.sources.get(file).map_or("", |file| file.text.as_str());
    let layer = options.layer.as_ref().map(|layer| layer.node.as_str());
    let drawing = (format.read)(text, layer);
    let drawing = drawing.map_err(|error| session.reports.push(bad_data(error, file, path)))?;
    let told = Told {
        path,
        file,
        fields: &fields,
        drawing: &drawing,
        layer: options.layer.as_ref(),
        sources: &*session.sources,
    };
    let outline = profile_of(&told, &options);
    let remarks = told.remarks(outline.as_ref().ok().map(|(_, outline)| outline));
    session.reports.append(remarks);
    match outline {
        Ok((map, outline)) => {
            let stretches = stretches(&outline, &drawing, file);
            let section = Section {
                strokes: drawing.strokes,
                map,
                joined: options.tolerance,
                side: options.side,
            };
            Ok((section, stretches))
        }
        Err(diagnostic) => Err(session.reports.push(*diagnostic)),
    }
}

fn read_options(format: &Format, fields: &Fields<'_>, reader: &mut Reader<'_>) -> Checked<Options> {
    let layer = reader.text(fields, "layer");
    let side = reader.choice(fields, "side", SIDES);
    let tolerance = reader.defaulted(fields, "tolerance", JOINED);
    let unit = reader.choice(fields, "unit", format.units);
    let scale = reader.defaulted(fields, "scale", 1.0);
    let x = reader.defaulted(fields, "x", Length::ZERO);
    let z = reader.defaulted(fields, "z", Length::ZERO);
    Ok(Options {
        layer: layer?,
        side: side?.map(|side| side.value),
        tolerance: tolerance?.value,
        unit: unit?.map(|unit| unit.value),
        scale: scale?.value,
        x: x?.value,
        z: z?.value,
    })
}

/// The one chain that a drawing is, or the wanted side of it, with the map from the drawing to the workpiece.
fn profile_of(told: &Told<'_>, options: &Options) -> Result<(Affine, Outline), Box<Diagnostic>> {
    told.must_have_layer()?;
    if told.drawing.strokes.is_empty() {
        return Err(Box::new(told.nothing()));
    }
    let unit = match (options.unit, told.drawing.unit) {
        (Some(unit), _) | (None, Unit::Known(unit)) => unit,
        (None, Unit::Unsaid(place)) => return Err(Box::new(told.no_unit(place))),
    };
    let factor = unit * options.scale;
    let map = Affine::shift(options.x.to_mm(), options.z.to_mm()).after(Affine::stretch(factor, factor));
    let strokes = &told.drawing.strokes;
    // Lines drawn over each other are the cause of many faults that look like others.
    let twice =
        || drawn_over(strokes, map, Part::TOLERANCE, options.tolerance).map(|found| told.drawn_over(found));
    let whole = outline(strokes, map, Part::TOLERANCE, options.tolerance).map_err(|error| {
        let is_torn = matches!(error, OutlineError::Branch { .. } | OutlineError::Several { .. });
        let otherwise = told.no_outline(error, options.tolerance);
        is_torn.then(twice).flatten().unwrap_or(otherwise)
    })?;
    let outline = match options.side {
        None if whole.is_closed => Err(Box::new(told.which_side(&whole))),
        None if turns_back(&whole) => twice().map_or(Ok(whole), Err),
        None => Ok(whole),
        Some(wanted) => side(&whole, wanted, Part::TOLERANCE).map_err(|error| {
            let is_crossed = matches!(error, SideError::Crossed { .. } | SideError::NoArea);
            let otherwise = told.no_side(error, options.tolerance);
            is_crossed.then(twice).flatten().unwrap_or(otherwise)
        }),
    };
    Ok((map, outline?))
}

/// Whether x falls somewhere on the way of an open outline.
fn turns_back(outline: &Outline) -> bool {
    outline.points.windows(2).any(|pair| pair[1].x < pair[0].x)
}

/// The points of an outline, parted where another stroke begins.
fn stretches(outline: &Outline, drawing: &Drawing, file: FileId) -> Vec<Stretch> {
    let span = |owner: usize| {
        let place = drawing.strokes.get(owner).map(|stroke| stroke.place);
        Span {
            file,
            start: place.map_or(0, |place| place.start),
            end: place.map_or(0, |place| place.end),
        }
    };
    let points: Vec<(usize, Point2)> = outline
        .owners
        .iter()
        .copied()
        .zip(outline.points.iter().copied())
        .collect();
    points
        .chunk_by(|one, next| one.0 == next.0)
        .map(|run| {
            let owner = run.first().map_or(0, |(owner, _)| *owner);
            (span(owner), run.iter().map(|(_, point)| *point).collect())
        })
        .collect()
}

/// Loads a DXF: text, in UTF-8 or in an old code page.
fn load_dxf(path: &Spanned<String>, session: &mut Session<'_>) -> Checked<FileId> {
    let (resolved, bytes) = bytes_of(path, session)?;
    let no_text = match import::dxf_text(bytes) {
        Ok(text) => return Ok(session.sources.add(resolved, text)),
        Err(no_text) => no_text,
    };
    let fault = |what: String, help: &str| {
        Diagnostic::new(
            Code::BadData,
            format!("`{}` {what}", path.node),
            path.span,
            "not a DXF in text form",
        )
        .help(help)
    };
    let diagnostic = match no_text {
        NoText::NotUtf8(bytes) => return as_text(&resolved, bytes, path, session),
        NoText::Binary => fault(
            "is a DXF in binary form".to_owned(),
            "save it as DXF in text form (ASCII)",
        ),
        NoText::Dwg => fault(
            "is a DWG, not a DXF".to_owned(),
            "save it as DXF in text form (ASCII)",
        ),
        NoText::CodePage(page) => fault(
            format!("is written in the code page `{page}`, which is not supported"),
            "save it as DXF of AutoCAD 2007 or later, which is UTF-8",
        ),
    };
    Err(session.reports.push(diagnostic))
}

/// Loads an SVG: text, not compressed.
fn load_svg(path: &Spanned<String>, session: &mut Session<'_>) -> Checked<FileId> {
    let (resolved, bytes) = bytes_of(path, session)?;
    // What gzip begins with.
    if bytes.starts_with(&[0x1f, 0x8b]) {
        let diagnostic = Diagnostic::new(
            Code::BadData,
            format!("`{}` is a compressed SVG", path.node),
            path.span,
            "not text",
        )
        .help("save it as plain SVG, or unpack it with gunzip");
        return Err(session.reports.push(diagnostic));
    }
    as_text(&resolved, bytes, path, session)
}
