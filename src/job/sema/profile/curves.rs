//! A profile drawn piece by piece: every piece begins where the one before ended.

use super::{Piece, Trace, data, drawing};
use crate::sema::dimension::Dimension;
use crate::sema::eval::Scope;
use crate::sema::fields::curve_words;
use crate::sema::part::{self, Part};
use crate::sema::point::point;
use crate::sema::quantity::mm;
use crate::sema::report::{Checked, Reported, Reports};
use crate::sema::session::Session;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::{Curve as Shape, CurveError, Point2};
use vcutc_syntax::ast::{ArcBy, Curve, Entry, Point};

/// The polyline of a chain of pieces.
pub(super) fn trace(pieces: &[Piece<'_>], scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Trace> {
    let mut drawing = Drawing {
        scope,
        trace: Trace::default(),
        pen: Pen::Up,
        fault: None,
    };
    for piece in pieces {
        drawing.trace.begin(piece.span);
        if let Err(reported) = drawing.draw(piece, session) {
            drawing.fault = Some(reported);
        }
    }
    match drawing.fault {
        Some(reported) => Err(reported),
        None => Ok(drawing.trace),
    }
}

/// Where the next piece begins.
#[derive(Clone, Copy)]
enum Pen {
    /// Nothing has been drawn yet.
    Up,
    At(Point2),
    /// At a point that could not be worked out.
    Lost(Reported),
}

struct Drawing<'s> {
    scope: Scope<'s>,
    trace: Trace,
    pen: Pen,
    fault: Option<Reported>,
}

impl Drawing<'_> {
    fn draw(&mut self, piece: &Piece<'_>, session: &mut Session<'_>) -> Checked<()> {
        match piece.curve {
            Curve::Start(start) => self.start(piece, start, session),
            Curve::Line { to } => self.line(piece, to, &mut session.reports),
            Curve::Arc { to, by } => self.arc(piece, to, by, session),
            Curve::Bezier { control, to } => self.through(piece, control, to, Shape::bezier, session),
            Curve::Spline { through, to } => self.through(piece, through, to, Shape::spline, session),
            Curve::Polyline { through, to } => self.through(piece, through, to, Shape::polyline, session),
            Curve::Open { .. } | Curve::Circle { .. } => Err(session.reports.push(of_regions(piece))),
            Curve::Points { path, options } => {
                self.must_be_first(piece, &mut session.reports)?;
                let points = data::points(path, options, piece.span, self.scope, session);
                self.place_data(points)
            }
            Curve::Airfoil { path, options } => {
                self.must_be_first(piece, &mut session.reports)?;
                let points = data::airfoil(path, options, piece.span, self.scope, session);
                self.place_data(points)
            }
            Curve::Dxf { path, options } => self.drawing(piece, &drawing::DXF, (path, options), session),
            Curve::Svg { path, options } => self.drawing(piece, &drawing::SVG, (path, options), session),
        }
    }

    fn must_be_first(&self, piece: &Piece<'_>, reports: &mut Reports) -> Checked<()> {
        let first = match (self.pen, self.trace.pieces.first()) {
            (Pen::Up, _) | (_, None) => return Ok(()),
            (Pen::At(_) | Pen::Lost(_), Some(first)) => first.span,
        };
        let words = curve_words(piece.curve);
        let diagnostic = Diagnostic::new(
            Code::Misplaced,
            format!("{words} can only begin a profile"),
            piece.span,
            "comes after another piece",
        )
        .and(first, "the profile begins here")
        .help(format!(
            "move {words} to the front, or draw this part with curves"
        ));
        Err(reports.push(diagnostic))
    }

    /// The outline of a drawing, with what drew each stretch of it.
    fn drawing(
        &mut self,
        piece: &Piece<'_>,
        format: &'static drawing::Format,
        (path, options): (&Spanned<String>, &[Entry]),
        session: &mut Session<'_>,
    ) -> Checked<()> {
        self.must_be_first(piece, &mut session.reports)?;
        match drawing::read(format, path, options, piece.span, self.scope, session) {
            Ok((section, stretches)) => {
                self.trace.drawn.push(part::Piece::Section(section));
                for (drawn, points) in stretches {
                    if let Some(last) = points.last() {
                        self.pen = Pen::At(*last);
                    }
                    self.trace.begin_drawn(piece.span, drawn);
                    self.trace.extend(points);
                }
                Ok(())
            }
            Err(reported) => {
                self.pen = Pen::Lost(reported);
                Err(reported)
            }
        }
    }

    fn place_data(&mut self, points: Checked<Vec<Point2>>) -> Checked<()> {
        match points {
            Ok(points) => {
                if let Some(last) = points.last() {
                    self.pen = Pen::At(*last);
                }
                self.trace.extend_by(points);
                Ok(())
            }
            Err(reported) => {
                self.pen = Pen::Lost(reported);
                Err(reported)
            }
        }
    }

    fn start(&mut self, piece: &Piece<'_>, start: &Point, session: &mut Session<'_>) -> Checked<()> {
        let place = point(start, &self.scope, &mut session.reports);
        self.must_be_first(piece, &mut session.reports)?;
        self.place_data(place.map(|place| vec![place]))
    }

    fn begin(&mut self, piece: &Piece<'_>, reports: &mut Reports) -> Checked<Point2> {
        match self.pen {
            Pen::At(place) => Ok(place),
            Pen::Lost(reported) => Err(reported),
            Pen::Up => {
                let diagnostic = Diagnostic::new(
                    Code::MissingField,
                    "the profile has no `start`",
                    piece.span,
                    format!("{} has no beginning", curve_words(piece.curve)),
                );
                let at = Span {
                    end: piece.span.start,
                    ..piece.span
                };
                let diagnostic =
                    diagnostic.fix("say where the profile starts", at, "start (0 mm, 10 mm)\n  ");
                Err(reports.push(diagnostic))
            }
        }
    }

    /// Ends a piece, whether or not it could be drawn.
    fn end(&mut self, to: Checked<Point2>) {
        self.pen = match to {
            Ok(place) => Pen::At(place),
            Err(reported) => Pen::Lost(reported),
        };
    }

    fn line(&mut self, piece: &Piece<'_>, to: &Point, reports: &mut Reports) -> Checked<()> {
        let from = self.begin(piece, reports);
        let end = point(to, &self.scope, reports);
        self.end(end);
        let shape = Shape::line(from?, end?);
        self.flatten(piece, shape, &[piece.span, to.span], reports)
    }

    fn arc(&mut self, piece: &Piece<'_>, to: &Point, by: &ArcBy, session: &mut Session<'_>) -> Checked<()> {
        let reports = &mut session.reports;
        let from = self.begin(piece, reports);
        let end = point(to, &self.scope, reports);
        let (shape, spans) = match by {
            ArcBy::Radius(radius) => {
                let length =
                    self.scope
                        .expect(radius, Dimension::LENGTH, "`radius`", Some("100 mm"), reports);
                self.end(end);
                (
                    Shape::arc_by_radius(from?, end?, Length::mm(length?)),
                    [to.span, radius.span],
                )
            }
            ArcBy::Center(center) => {
                let place = point(center, &self.scope, reports);
                self.end(end);
                (Shape::arc_by_center(from?, end?, place?), [to.span, center.span])
            }
            ArcBy::Through(through) => {
                let place = point(through, &self.scope, reports);
                self.end(end);
                (Shape::arc_through(from?, place?, end?), [through.span, to.span])
            }
        };
        self.flatten(
            piece,
            shape,
            &[piece.span, spans[0], spans[1]],
            &mut session.reports,
        )
    }

    /// A curve given by its start, points on the way and its end.
    fn through(
        &mut self,
        piece: &Piece<'_>,
        between: &[Point],
        to: &Point,
        make: fn(Vec<Point2>) -> Result<Shape, CurveError>,
        session: &mut Session<'_>,
    ) -> Checked<()> {
        let reports = &mut session.reports;
        let mut points = vec![self.begin(piece, reports)];
        points.extend(
            between
                .iter()
                .chain([to])
                .map(|place| point(place, &self.scope, reports)),
        );
        if let Some(end) = points.last() {
            self.end(*end);
        }
        let points: Vec<Point2> = points.into_iter().collect::<Checked<_>>()?;
        let spans: Vec<Span> = [piece.span]
            .into_iter()
            .chain(between.iter().chain([to]).map(|place| place.span))
            .collect();
        self.flatten(piece, make(points), &spans, reports)
    }

    /// Adds a curve's polyline. `spans` are the places of the points handed over, for faults that name one.
    fn flatten(
        &mut self,
        piece: &Piece<'_>,
        shape: Result<Shape, CurveError>,
        spans: &[Span],
        reports: &mut Reports,
    ) -> Checked<()> {
        let mut points = Vec::new();
        let outcome = shape.and_then(|shape| shape.flatten(Part::TOLERANCE, &mut points).map(|()| shape));
        match outcome {
            Ok(shape) => {
                self.trace.drawn.push(part::Piece::Curve(shape));
                self.trace.extend(points);
                Ok(())
            }
            Err(error) => Err(reports.push(impossible((piece.curve, piece.span), error, spans))),
        }
    }
}

/// A piece that only a region has.
fn of_regions(piece: &Piece<'_>) -> Diagnostic {
    let words = curve_words(piece.curve);
    Diagnostic::new(
        Code::Misplaced,
        format!("{words} does not belong in `profile`"),
        piece.span,
        "describes a region in the plan of the stock",
    )
    .help(
        "move it into a `region NAME { ... }` block, or draw this part of the profile with `line` and `arc`",
    )
}

/// The diagnostic for a curve that does not exist. `spans` are: all of the piece for its start, then its points.
pub(crate) fn impossible((curve, whole): (&Curve, Span), error: CurveError, spans: &[Span]) -> Diagnostic {
    let words = curve_words(curve);
    let last = spans.last().copied().unwrap_or(whole);
    let place = |index: usize| spans.get(index).copied().unwrap_or(whole);
    let fault = |message: String, span: Span, label: &str| {
        Diagnostic::new(Code::ImpossibleCurve, message, span, label)
    };
    match error {
        CurveError::RadiusTooSmall { smallest } => {
            // Rounded up, so that the number shown works.
            let smallest = libm::ceil(smallest.to_mm() * 1000.0) / 1000.0;
            fault(
                "the radius is too small to reach from one end of the arc to the other".to_owned(),
                last,
                "too small",
            )
            .help(format!("use a radius of at least {}", mm(smallest)))
        }
        CurveError::CenterNotEquidistant { to_start, to_end } => fault(
            "the centre of the arc is not equally far from both of its ends".to_owned(),
            last,
            "not the centre of any such arc",
        )
        .note(format!(
            "it is {} from the start and {} from the end",
            mm(to_start.to_mm()),
            mm(to_end.to_mm())
        ))
        .help("move the centre, or give the arc by `radius` or `through`"),
        CurveError::Collinear => fault(
            "no arc passes through three points on one line".to_owned(),
            place(1),
            "on the line between start and end",
        )
        .help("move this point off the line, or use `line`"),
        CurveError::PointsCoincide { index } => fault(
            format!("{words} passes the same point twice in a row"),
            place(index),
            "the same point as the one before",
        )
        .help("delete one of the two"),
        CurveError::TooFewPoints => fault(
            format!("{words} needs at least two points"),
            whole,
            "too few points",
        )
        .help("add where it ends with `to (x, z)`"),
        CurveError::TooManyControlPoints => fault(
            format!("{words} has too many control points"),
            whole,
            "more than 64 points, its ends included",
        )
        .help("split it into several curves, or use `spline`"),
        CurveError::OutOfRange { index } => fault(
            format!("{words} has a point out of range"),
            place(index),
            "beyond 1e9 mm",
        )
        .help("check the units of its coordinates"),
        CurveError::TooManyPoints => fault(
            format!("{words} is too large to follow within 1 um"),
            whole,
            "millions of points are not enough for it",
        )
        .help("check the units of its coordinates"),
    }
}
