//! Drawings, DXF and SVG, and profiles from them: `dxf "file.dxf"` and `svg "file.svg"`.
//!
//! A reader of [`vcutc_geometry::import`] turns the file into strokes; here the options say which of them count, what their
//! unit is and where they lie, and what is wrong is put into words ([`faults`]). Regions take their loops from drawings in the
//! same way.

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
pub(crate) use faults::{NamedDrawing, View, joining};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{FileId, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::import::drawing::{
    Affine, Drawing, Outline, OutlineError, Side, SideError, Unit, drawn_over, outline, side,
};
use vcutc_geometry::import::{self, DataError, NoText};
use vcutc_syntax::ast::Entry;

/// A format of drawings, and the fields after such a file.
#[derive(Debug)]
pub(crate) struct Format {
    pub(crate) spec: BlockSpec,
    pub(crate) file: FileKind,
}

/// A kind of files.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FileKind {
    /// Units that the job may give, in mm.
    units: &'static [(&'static str, f64)],
    read: fn(&str, Option<&str>) -> Result<Drawing, DataError>,
    load: fn(&Spanned<String>, &mut Session<'_>) -> Checked<FileId>,
}

/// Files of DXF.
pub(crate) const DXF_FILE: FileKind = FileKind {
    units: DXF_UNITS,
    read: import::dxf,
    load: load_dxf,
};

/// Files of SVG.
pub(crate) const SVG_FILE: FileKind = FileKind {
    units: SVG_UNITS,
    read: import::svg,
    load: load_svg,
};

pub(crate) static DXF: Format = Format {
    spec: spec("`dxf`", DXF_FIELDS),
    file: DXF_FILE,
};

pub(crate) static SVG: Format = Format {
    spec: spec("`svg`", SVG_FIELDS),
    file: SVG_FILE,
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

/// `unit = mm` of a DXF.
pub(crate) const DXF_UNIT: FieldSpec = value("unit", "mm").takes(Takes::Words(|| words_of(DXF_UNITS)));
/// `unit = mm` of an SVG.
pub(crate) const SVG_UNIT: FieldSpec = value("unit", "mm").takes(Takes::Words(|| words_of(SVG_UNITS)));

const DXF_FIELDS: &[FieldSpec] = &fields(SKIN, SIDE, DXF_UNIT, "z");
const SVG_FIELDS: &[FieldSpec] = &fields(SKIN, SIDE, SVG_UNIT, "z");

const SKIN: FieldSpec = value("layer", "\"SKIN\"");
const SIDE: FieldSpec = value("side", "upper").takes(Takes::Words(|| words_of(SIDES)));

/// The fields of a drawing: its layer, one of what it is drawn for, its unit, and where it lies; `up` is the name of its
/// coordinate that is not x.
pub(crate) const fn fields(
    layer: FieldSpec,
    own: FieldSpec,
    unit: FieldSpec,
    up: &'static str,
) -> [FieldSpec; 7] {
    [
        layer,
        own,
        value("tolerance", "0.01 mm").within(JOINING),
        unit,
        value("scale", "1").within(SCALE),
        value("x", "0 mm").within(COORDINATE),
        value(up, "0 mm").within(COORDINATE),
    ]
}

/// The table of such fields.
pub(crate) const fn spec(title: &'static str, fields: &'static [FieldSpec]) -> BlockSpec {
    BlockSpec {
        title,
        fields,
        inner: Inner::Refused,
    }
}

const SIDES: &[(&str, Side)] = &[("upper", Side::Upper), ("lower", Side::Lower)];

/// Ends of lines that are joined when the job does not say how far they may be apart.
const JOINED: Length = Length::mm(0.01);

/// What the job says of a drawing, whatever it is drawn for.
pub(crate) struct Options {
    pub(crate) layer: Option<Spanned<String>>,
    pub(crate) tolerance: Length,
    /// In mm.
    unit: Option<f64>,
    scale: f64,
    x: Length,
    up: Length,
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
    let file = format.file.load(path, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let options = Options::read(&format.file, &fields, "z", &mut reader);
    let side = reader.choice(&fields, "side", SIDES);
    let (file, options, side) = (file?, options?, side?.map(|side| side.value));
    let drawing = format.file.read(file, options.layer.as_ref(), path, session)?;
    let named = NamedDrawing {
        path,
        file,
        fields: &fields,
        drawing: &drawing,
        layer: options.layer.as_ref(),
        view: View::Profile,
        sources: &*session.sources,
    };
    let outline = profile_of(&named, &options, side);
    let repeated = outline.as_ref().map(|(_, outline)| outline.repeated.as_slice());
    let remarks = named.remarks(repeated.unwrap_or_default());
    session.reports.append(remarks);
    match outline {
        Ok((map, outline)) => {
            let stretches = stretches(&outline, &drawing, file);
            let section = Section {
                strokes: drawing.strokes,
                map,
                joined: options.tolerance,
                side,
            };
            Ok((section, stretches))
        }
        Err(diagnostic) => Err(session.reports.push(*diagnostic)),
    }
}

impl FileKind {
    /// Puts the text of a file among the sources of the run.
    pub(crate) fn load(&self, path: &Spanned<String>, session: &mut Session<'_>) -> Checked<FileId> {
        (self.load)(path, session)
    }

    /// What such a file shows on a layer, or on all of them.
    pub(crate) fn read(
        &self,
        file: FileId,
        layer: Option<&Spanned<String>>,
        path: &Spanned<String>,
        session: &mut Session<'_>,
    ) -> Checked<Drawing> {
        let text = session.sources.get(file).map_or("", |file| file.text.as_str());
        let drawing = (self.read)(text, layer.map(|layer| layer.node.as_str()));
        drawing.map_err(|error| session.reports.push(bad_data(error, file, path)))
    }
}

impl Options {
    /// Reads them; `up` is the field of the coordinate that is not x.
    pub(crate) fn read(
        file: &FileKind,
        fields: &Fields<'_>,
        up: &str,
        reader: &mut Reader<'_>,
    ) -> Checked<Self> {
        let layer = reader.text(fields, "layer");
        let tolerance = reader.defaulted(fields, "tolerance", JOINED);
        let unit = reader.choice(fields, "unit", file.units);
        let scale = reader.defaulted(fields, "scale", 1.0);
        let x = reader.defaulted(fields, "x", Length::ZERO);
        let up = reader.defaulted(fields, up, Length::ZERO);
        Ok(Self {
            layer: layer?,
            tolerance: tolerance?.value,
            unit: unit?.map(|unit| unit.value),
            scale: scale?.value,
            x: x?.value,
            up: up?.value,
        })
    }

    /// The map from a drawing to the workpiece. The drawing must have the layer, and something on it.
    pub(crate) fn map(&self, named: &NamedDrawing<'_>) -> Result<Affine, Box<Diagnostic>> {
        named.must_have_layer()?;
        if named.drawing.strokes.is_empty() {
            return Err(Box::new(named.nothing()));
        }
        let unit = match (self.unit, named.drawing.unit) {
            (Some(unit), _) | (None, Unit::Known(unit)) => unit,
            (None, Unit::Unsaid(place)) => return Err(Box::new(named.no_unit(place))),
        };
        let factor = unit * self.scale;
        Ok(Affine::shift(self.x.to_mm(), self.up.to_mm()).after(Affine::stretch(factor, factor)))
    }
}

/// The one chain that a drawing is, or the wanted side of it, with the map from the drawing to the workpiece.
fn profile_of(
    named: &NamedDrawing<'_>,
    options: &Options,
    wanted: Option<Side>,
) -> Result<(Affine, Outline), Box<Diagnostic>> {
    let map = options.map(named)?;
    let strokes = &named.drawing.strokes;
    // Lines drawn over each other are the cause of many faults that look like others.
    let twice =
        || drawn_over(strokes, map, Part::TOLERANCE, options.tolerance).map(|found| named.drawn_over(found));
    let whole = outline(strokes, map, Part::TOLERANCE, options.tolerance).map_err(|error| {
        let is_torn = matches!(error, OutlineError::Branch { .. } | OutlineError::Several { .. });
        let otherwise = named.no_outline(error, options.tolerance);
        is_torn.then(twice).flatten().unwrap_or(otherwise)
    })?;
    let outline = match wanted {
        None if whole.is_closed => Err(Box::new(named.which_side(&whole))),
        None if turns_back(&whole) => twice().map_or(Ok(whole), Err),
        None => Ok(whole),
        Some(wanted) => side(&whole, wanted, Part::TOLERANCE).map_err(|error| {
            let is_crossed = matches!(error, SideError::Crossed { .. } | SideError::NoArea);
            let otherwise = named.no_side(error, options.tolerance);
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
