//! Regions from drawings: `dxf "tray.dxf" { layer = "SEAT" }` and the same of an SVG.
//!
//! All closed chains of a layer are the loops of the region. Lines of a second layer mark those of its straight sides that are
//! open.

mod faults;

use crate::sema::eval::Scope;
use crate::sema::fields::{FieldSpec, Fields, value};
use crate::sema::profile::data::place_of;
use crate::sema::profile::drawing::{
    DXF_FILE, DXF_UNIT, Format, NamedDrawing, Options, SVG_FILE, SVG_UNIT, View, fields, spec,
};
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use std::collections::BTreeSet;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::import::drawing::{
    Affine, Bow, Drawing, Loops, LoopsError, OutlineError, ROUND, SideName, drawn_over, loops, open_sides,
};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::{Edge, Loop, Side};
use vcutc_syntax::ast::{Curve, Entry};

pub(crate) static DXF: Format = Format {
    spec: spec("`dxf`", DXF_FIELDS),
    file: DXF_FILE,
};

pub(crate) static SVG: Format = Format {
    spec: spec("`svg`", SVG_FIELDS),
    file: SVG_FILE,
};

const DXF_FIELDS: &[FieldSpec] = &fields(LAYER, OPEN, DXF_UNIT, "y");
const SVG_FIELDS: &[FieldSpec] = &fields(LAYER, OPEN, SVG_UNIT, "y");

const LAYER: FieldSpec = value("layer", "\"SEAT\"");
const OPEN: FieldSpec = value("open", "\"SEAT_OPEN\"");

/// A drawing as a region names it.
#[derive(Clone, Copy)]
pub(super) struct Named<'a> {
    format: &'static Format,
    pub(super) path: &'a Spanned<String>,
    options: &'a [Entry],
    /// All of it.
    pub(super) piece: Span,
}

impl<'a> Named<'a> {
    /// The drawing that an entry names, if it does.
    pub(super) fn of(entry: &'a Entry) -> Option<Self> {
        let Entry::Curve { curve, span } = entry else {
            return None;
        };
        let (format, path, options) = match &**curve {
            Curve::Dxf { path, options } => (&DXF, path, options),
            Curve::Svg { path, options } => (&SVG, path, options),
            Curve::Start(_)
            | Curve::Line { .. }
            | Curve::Open { .. }
            | Curve::Circle { .. }
            | Curve::Arc { .. }
            | Curve::Bezier { .. }
            | Curve::Spline { .. }
            | Curve::Polyline { .. }
            | Curve::Points { .. }
            | Curve::Airfoil { .. } => return None,
        };
        Some(Self {
            format,
            path,
            options,
            piece: *span,
        })
    }

    /// The loops that it shows, with the place in the drawing that drew each edge.
    pub(super) fn read(
        self,
        scope: Scope<'_>,
        session: &mut Session<'_>,
    ) -> Checked<(Vec<Loop>, Vec<Vec<Span>>)> {
        let Self { format, path, .. } = self;
        let fields = Fields::sort(&format.spec, place_of(path, self.piece), self.options, session);
        let file = format.file.load(path, session);
        let mut reader = Reader {
            scope,
            reports: &mut session.reports,
        };
        let options = Options::read(&format.file, &fields, "y", &mut reader);
        let open = reader.text(&fields, "open");
        let (file, options, open) = (file?, options?, open?);
        if let (Some(open), None) = (&open, &options.layer) {
            return Err(session.reports.push(faults::open_without_layer(open, &fields)));
        }
        let drawing = format.file.read(file, options.layer.as_ref(), path, session)?;
        let marks = match &open {
            Some(layer) => Some(format.file.read(file, Some(layer), path, session)?),
            None => None,
        };
        let named = NamedDrawing {
            path,
            file,
            fields: &fields,
            drawing: &drawing,
            layer: options.layer.as_ref(),
            view: View::Plan,
            sources: &*session.sources,
        };
        let found = loops_of(&named, &options);
        let repeated = found.as_ref().map(|(_, loops)| loops.repeated.as_slice());
        let mut remarks = named.remarks(repeated.unwrap_or_default());
        let outcome = match (found, marks.as_ref()) {
            (Ok((map, loops)), Some(drawing)) => {
                let marks = NamedDrawing {
                    drawing,
                    layer: open.as_ref(),
                    ..named
                };
                remarks.extend(marks.remarks(&[]));
                let marked = marked_sides(&named, &marks, (&loops, map), &options);
                marked.map(|marked| (loops, marked))
            }
            (Ok((_, loops)), None) => Ok((loops, BTreeSet::new())),
            (Err(fault), _) => Err(fault),
        };
        session.reports.append(remarks);
        match outcome {
            Ok((loops, marked)) => {
                let places = loops.rings.iter().map(|ring| {
                    let place =
                        |piece: &vcutc_geometry::import::drawing::LoopPiece| named.stroke(piece.stroke);
                    ring.iter().map(place).collect()
                });
                Ok((edges(&loops, &marked), places.collect()))
            }
            Err(fault) => Err(session.reports.push(*fault)),
        }
    }
}

/// The loops of a drawing, with the map from it to the workpiece.
fn loops_of(named: &NamedDrawing<'_>, options: &Options) -> Result<(Affine, Loops), Box<Diagnostic>> {
    let map = options.map(named)?;
    let strokes = &named.drawing.strokes;
    let tolerance = options.tolerance;
    match loops(strokes, map, tolerance) {
        Ok(found) => Ok((map, found)),
        Err(error) => {
            // Lines drawn over each other are the cause of many faults that look like others.
            let is_torn = matches!(
                error,
                LoopsError::Open { .. } | LoopsError::Strokes(OutlineError::Branch { .. })
            );
            let twice = is_torn
                .then(|| drawn_over(strokes, map, ROUND, tolerance))
                .flatten();
            Err(match (twice, error) {
                (Some(overlap), _) => named.drawn_over(overlap),
                (None, LoopsError::Strokes(error @ OutlineError::Branch { .. })) => {
                    let branches = named.no_outline(error, tolerance);
                    Box::new(branches.help("draw loops that touch in a point as one closed polyline each"))
                }
                (None, LoopsError::Strokes(error)) => named.no_outline(error, tolerance),
                (
                    None,
                    LoopsError::Open {
                        loops: closed,
                        chains,
                        nearest,
                    },
                ) => {
                    let closes = |wider| loops(strokes, map, wider).is_ok();
                    Box::new(faults::open_chains(named, closed, &chains, nearest, &closes))
                }
            })
        }
    }
}

/// The sides that another layer marks as open.
fn marked_sides(
    named: &NamedDrawing<'_>,
    marks: &NamedDrawing<'_>,
    (loops, map): (&Loops, Affine),
    options: &Options,
) -> Result<BTreeSet<SideName>, Box<Diagnostic>> {
    marks.must_have_layer()?;
    let Drawing { strokes, .. } = marks.drawing;
    match open_sides(loops, strokes, map, options.tolerance) {
        Ok(sides) => Ok(sides.into_iter().collect()),
        Err(error) => Err(faults::no_open_side(
            named,
            marks,
            error,
            loops,
            options.tolerance,
        )),
    }
}

fn edges(loops: &Loops, marked: &BTreeSet<SideName>) -> Vec<Loop> {
    let rings = loops.rings.iter().enumerate();
    let edge = |ring: usize, place: usize, way: Bow| Edge {
        piece: Piece::arc(in_plan(way.from), in_plan(way.to), way.sweep),
        side: if marked.contains(&(ring, place)) {
            Side::Open
        } else {
            Side::Wall
        },
    };
    let all = rings.map(|(ring, pieces)| {
        let pieces = pieces.iter().enumerate();
        pieces
            .map(|(place, piece)| edge(ring, place, piece.way))
            .collect()
    });
    all.collect()
}

/// A point of the plane of a drawing in the plan.
const fn in_plan(point: Point2) -> Place {
    Place::new(point.x, point.z)
}

#[cfg(test)]
mod tests;
