//! What is wrong with a drawing, in words.

use crate::sema::fields::Fields;
use crate::sema::quantity::mm;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{FileId, SourceMap, Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::{CurveError, Point2};
use vcutc_geometry::import::drawing::{
    Chain, Drawing, Gap, Outline, OutlineError, Overlap, Place, SideError,
};

/// Most layers or chains that are listed.
const MOST_LISTED: usize = 12;

/// What a drawing is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum View {
    /// A profile, in x and z.
    Profile,
    /// A region, in x and y.
    Plan,
}

impl View {
    /// A layer that such a drawing may have.
    const fn layer(self) -> &'static str {
        match self {
            Self::Profile => "SKIN",
            Self::Plan => "SEAT",
        }
    }

    /// A point of the workpiece.
    fn shown(self, at: Point2) -> String {
        let (x, up) = (mm(at.x), mm(at.z));
        match self {
            Self::Profile => format!("x = {x}, z = {up}"),
            Self::Plan => format!("({x}, {up})"),
        }
    }
}

/// A drawing and the piece of the job that names it.
#[derive(Clone, Copy)]
pub(crate) struct NamedDrawing<'a> {
    pub(crate) path: &'a Spanned<String>,
    pub(crate) file: FileId,
    pub(crate) fields: &'a Fields<'a>,
    pub(crate) drawing: &'a Drawing,
    pub(crate) layer: Option<&'a Spanned<String>>,
    pub(crate) view: View,
    pub(crate) sources: &'a SourceMap,
}

impl NamedDrawing<'_> {
    /// The wanted layer must be one of the drawing's.
    pub(crate) fn must_have_layer(&self) -> Result<(), Box<Diagnostic>> {
        let Some(wanted) = self.layer else {
            return Ok(());
        };
        let folded = wanted.node.to_lowercase();
        let is_wanted = |name: &String| *name == wanted.node || name.to_lowercase() == folded;
        if self.drawing.layers.keys().any(is_wanted) {
            return Ok(());
        }
        let diagnostic = Diagnostic::new(
            Code::UnknownLayer,
            format!("there is no layer `{}` in `{}`", wanted.node, self.path.node),
            wanted.span,
            "not a layer of this drawing",
        );
        let names = self.drawing.layers.keys().map(String::as_str);
        let near = nearest(&wanted.node, names.take(1000));
        let quoted = |name: &str| format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""));
        let diagnostic = match near.as_slice() {
            [] => diagnostic,
            [one] => diagnostic.fix(format!("did you mean `{one}`?"), wanted.span, quoted(one)),
            several => {
                let names: Vec<String> = several.iter().map(|name| format!("`{name}`")).collect();
                diagnostic.help(format!("did you mean {}?", names.join(" or ")))
            }
        };
        Err(Box::new(match self.layers() {
            Some(list) => diagnostic.note(format!("its layers are {list}")),
            None => diagnostic.note("the drawing has no layers with names"),
        }))
    }

    /// The layers, each with the number of its lines.
    fn layers(&self) -> Option<String> {
        let layers = &self.drawing.layers;
        let line = |(name, count): (&String, &usize)| match count {
            0 => format!("`{name}` (no line)"),
            1 => format!("`{name}` (1 line)"),
            several => format!("`{name}` ({several} lines)"),
        };
        let mut listed: Vec<String> = layers.iter().take(MOST_LISTED).map(line).collect();
        let more = layers.len().saturating_sub(MOST_LISTED);
        if more > 0 {
            listed.push(format!("and {more} more"));
        }
        (!listed.is_empty()).then(|| listed.join(", "))
    }

    /// Layers may be the reason for too many or too few lines.
    pub(crate) fn with_layers(&self, diagnostic: Diagnostic) -> Diagnostic {
        match self.layers() {
            Some(list) if self.layer.is_none() && self.drawing.layers.len() > 1 => self.with_list(
                diagnostic.help(format!(
                    "say which layer the outline is on, like `layer = \"{}\"`",
                    self.view.layer()
                )),
                &list,
            ),
            Some(_) | None => diagnostic,
        }
    }

    /// A point of the workpiece.
    pub(crate) fn shown(&self, at: Point2) -> String {
        self.view.shown(at)
    }

    fn with_list(&self, diagnostic: Diagnostic, list: &str) -> Diagnostic {
        diagnostic.note(format!("the layers of `{}` are {list}", self.path.node))
    }

    /// Where to point in the job: at the layer, or else at the file.
    pub(crate) fn place(&self) -> Span {
        self.layer.map_or(self.path.span, |layer| layer.span)
    }

    /// What is spoken of.
    pub(crate) fn subject(&self) -> String {
        match self.layer {
            Some(layer) => format!("layer `{}` of `{}`", layer.node, self.path.node),
            None => format!("`{}`", self.path.node),
        }
    }

    pub(crate) fn span(&self, place: Place) -> Span {
        Span {
            file: self.file,
            start: place.start,
            end: place.end,
        }
    }

    pub(crate) fn stroke(&self, stroke: usize) -> Span {
        let place = self.drawing.strokes.get(stroke).map(|stroke| stroke.place);
        place.map_or(self.path.span, |place| self.span(place))
    }

    /// Nothing is drawn.
    pub(crate) fn nothing(&self) -> Diagnostic {
        let diagnostic = Diagnostic::new(
            Code::NothingDrawn,
            format!("there is no line in {}", self.subject()),
            self.place(),
            "nothing here that can be an outline",
        );
        let diagnostic = match self.layers() {
            Some(list) => self.with_list(diagnostic, &list),
            None => diagnostic,
        };
        diagnostic.help("name the layer of the outline, or draw it with lines, arcs, polylines and splines")
    }

    /// The file does not say its unit.
    pub(crate) fn no_unit(&self, place: Place) -> Diagnostic {
        let diagnostic = Diagnostic::new(
            Code::UnknownScale,
            format!("`{}` does not state its unit", self.path.node),
            self.path.span,
            "numbers without a unit",
        )
        .and(self.span(place), "no unit of length here");
        self.fields
            .offer(diagnostic, "state it, for example", "unit = mm")
    }

    /// The outline is closed, and nothing says which side counts.
    pub(crate) fn which_side(&self, outline: &Outline) -> Diagnostic {
        let (low, high) = outline
            .points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
                (low.min(point.x), high.max(point.x))
            });
        let diagnostic = Diagnostic::new(
            Code::MissingField,
            format!("the outline in {} is closed, so it needs a side", self.subject()),
            self.place(),
            format!("a ring from x = {} to x = {}", mm(low), mm(high)),
        );
        self.fields
            .offer(diagnostic, "use its upper side,", "side = upper")
    }

    /// The strokes are not a single chain.
    pub(crate) fn no_outline(&self, error: OutlineError, tolerance: Length) -> Box<Diagnostic> {
        let broken = |message: String, label: String| {
            Diagnostic::new(Code::BrokenOutline, message, self.place(), label)
        };
        Box::new(match error {
            OutlineError::Nothing => self.nothing(),
            OutlineError::Curve { stroke, error } => self.no_curve(stroke, error),
            OutlineError::Nurbs { stroke, error: _ } => Diagnostic::new(
                Code::ImpossibleCurve,
                format!("a spline of `{}` goes out of range", self.path.node),
                self.path.span,
                "named here",
            )
            .and(self.stroke(stroke), "this one")
            .help("check `unit` and `scale`"),
            OutlineError::TooManyPoints => Diagnostic::new(
                Code::ImpossibleCurve,
                format!("{} is too large to follow within 1 um", self.subject()),
                self.place(),
                "millions of points are not enough for it",
            )
            .help("check `unit` and `scale`"),
            OutlineError::Branch { at, strokes } => {
                let diagnostic = broken(
                    format!("the outline in {} branches at {}", self.subject(), self.shown(at)),
                    format!("{} lines meet there", strokes.len().max(2)),
                );
                let diagnostic = strokes.iter().take(3).fold(diagnostic, |diagnostic, &stroke| {
                    diagnostic.and(self.stroke(stroke), "one of them")
                });
                self.with_layers(diagnostic.help("delete the lines that are not part of the outline"))
            }
            OutlineError::Crowded { at } => broken(
                format!("too many lines of {} end near {}", self.subject(), self.shown(at)),
                format!(
                    "more ends within {} than can be distinguished",
                    mm(tolerance.to_mm())
                ),
            )
            .help("make `tolerance` smaller, or draw the outline in fewer lines"),
            OutlineError::Several { chains, nearest } => self.several(&chains, nearest),
        })
    }

    /// Two lines lie on each other.
    pub(crate) fn drawn_over(&self, overlap: Overlap) -> Box<Diagnostic> {
        let Overlap { from, to, strokes } = overlap;
        let message = format!(
            "a line of {} is drawn twice, from {} to {}",
            self.subject(),
            self.shown(from),
            self.shown(to)
        );
        let diagnostic = Diagnostic::new(
            Code::DrawnOver,
            message,
            self.place(),
            format!("lines lie on each other over {}", mm(from.distance(to))),
        );
        let [one, other] = strokes.map(|stroke| self.stroke(stroke));
        let diagnostic = if one == other {
            diagnostic.and(one, "this one leads back over itself")
        } else {
            diagnostic.and(one, "this one").and(other, "lies on this one")
        };
        Box::new(diagnostic.help(
            "delete one of the two, or end it where the other begins (OVERKILL in AutoCAD, \"detect duplicates\" elsewhere)",
        ))
    }

    fn no_curve(&self, stroke: usize, error: CurveError) -> Diagnostic {
        let kind = self
            .drawing
            .strokes
            .get(stroke)
            .map_or("line", |stroke| stroke.kind);
        let why = match error {
            CurveError::OutOfRange { .. } => "has a point out of range",
            CurveError::TooManyPoints => "is too large to follow within 1 um",
            CurveError::TooManyControlPoints => "has too many control points",
            CurveError::PointsCoincide { .. }
            | CurveError::TooFewPoints
            | CurveError::RadiusTooSmall { .. }
            | CurveError::CenterNotEquidistant { .. }
            | CurveError::Collinear => "is smaller than a picometre",
        };
        Diagnostic::new(
            Code::ImpossibleCurve,
            format!("a {kind} of `{}` {why}", self.path.node),
            self.path.span,
            "named here",
        )
        .and(self.stroke(stroke), "this one")
        .help("check `unit` and `scale`")
    }

    fn several(&self, chains: &[Chain], nearest: Option<Gap>) -> Diagnostic {
        let message = match nearest {
            Some(gap) if chains.len() == 2 => format!(
                "the outline in {} has a gap of {} at {}",
                self.subject(),
                mm(gap.size().to_mm()),
                self.shown(gap.from)
            ),
            Some(_) | None => format!("{} is {} separate lines, not one", self.subject(), chains.len()),
        };
        let label = match nearest {
            Some(gap) => format!(
                "ends at {} and {}, {} apart",
                self.shown(gap.from),
                self.shown(gap.to),
                mm(gap.size().to_mm())
            ),
            None => "none of them connects to another".to_owned(),
        };
        let mut diagnostic = Diagnostic::new(Code::BrokenOutline, message, self.place(), label);
        if let Some(gap) = nearest {
            diagnostic = diagnostic.and(self.stroke(gap.strokes[0]), "one side of the gap");
            if gap.strokes[0] != gap.strokes[1] {
                diagnostic = diagnostic.and(self.stroke(gap.strokes[1]), "the other side of the gap");
            }
        }
        for chain in chains.iter().take(MOST_LISTED) {
            diagnostic = diagnostic.note(self.chain(chain));
        }
        let more = chains.len().saturating_sub(MOST_LISTED);
        if more > 0 {
            diagnostic = diagnostic.note(format!("and {more} more"));
        }
        let diagnostic = match nearest.and_then(joining) {
            Some(tolerance) => diagnostic.help(format!(
                "close the gap in the drawing, or join over it with `tolerance = {}`",
                mm(tolerance.to_mm())
            )),
            None => diagnostic.help("delete the lines that are not part of the outline"),
        };
        self.with_layers(diagnostic)
    }

    pub(crate) fn chain(&self, chain: &Chain) -> String {
        let kind = self
            .drawing
            .strokes
            .get(chain.first)
            .map_or("line", |stroke| stroke.kind);
        let pieces = match chain.strokes {
            1 => kind.to_owned(),
            several => format!("{several} pieces, the first a {kind}"),
        };
        if chain.is_closed {
            format!("a ring through {}: {pieces}", self.shown(chain.from))
        } else {
            format!(
                "from {} to {}: {pieces}",
                self.shown(chain.from),
                self.shown(chain.to)
            )
        }
    }

    /// The outline has no such side.
    pub(crate) fn no_side(&self, error: SideError, tolerance: Length) -> Box<Diagnostic> {
        let subject = self.subject();
        Box::new(match error {
            SideError::Open(gap) => {
                let diagnostic = Diagnostic::new(
                    Code::BrokenOutline,
                    format!("the outline in {subject} is open, so it has no sides"),
                    self.place(),
                    format!(
                        "ends at {} and {}, {} apart",
                        self.shown(gap.from),
                        self.shown(gap.to),
                        mm(gap.size().to_mm())
                    ),
                );
                match joining(gap) {
                    Some(wider) => diagnostic.help(format!(
                        "close it in the drawing, or join over the gap with `tolerance = {}`; it is {} now",
                        mm(wider.to_mm()),
                        mm(tolerance.to_mm())
                    )),
                    None => diagnostic.help("delete `side`: an open outline is itself the profile"),
                }
            }
            SideError::NoExtent => Diagnostic::new(
                Code::BrokenOutline,
                format!("the outline in {subject} has no width"),
                self.place(),
                "all its points have the same x",
            )
            .help("check `unit` and `scale`, and that x runs across the cuts in the drawing"),
            SideError::NoArea => Diagnostic::new(
                Code::BrokenOutline,
                format!("the outline in {subject} has nothing between its sides"),
                self.place(),
                "both its sides are the same line",
            )
            .help("delete one of the two; an open outline needs no `side`"),
            SideError::Crossed { at, strokes } => self.crossed(at, strokes),
            SideError::Dense => Diagnostic::new(
                Code::BrokenOutline,
                format!("the outline in {subject} is too close to itself to have sides"),
                self.place(),
                "too many of its lines lie across each other",
            )
            .help("draw the side that the blade cuts as an open line, and delete `side`"),
        })
    }

    fn crossed(&self, at: Point2, strokes: [usize; 2]) -> Diagnostic {
        let diagnostic = Diagnostic::new(
            Code::BrokenOutline,
            format!(
                "the outline in {} meets itself at {}",
                self.subject(),
                self.shown(at)
            ),
            self.place(),
            "has no upper and no lower side",
        );
        let diagnostic = match strokes {
            [one, other] if self.stroke(one) == self.stroke(other) => {
                diagnostic.and(self.stroke(one), "this one crosses or touches itself")
            }
            [one, other] => diagnostic
                .and(self.stroke(one), "this one")
                .and(self.stroke(other), "crosses or touches this one"),
        };
        diagnostic.help("draw it as one line around the part that does not cross or touch itself")
    }
}

/// A tolerance that joins over a gap, if one of the drawing's own kind would: rounded up to a micrometre.
pub(crate) fn joining(gap: Gap) -> Option<Length> {
    /// Wider gaps are not slips of the drawing.
    const WIDEST: f64 = 1.0;
    let size = gap.size().to_mm();
    (size <= WIDEST).then(|| Length::mm(libm::ceil(size * 1000.0) / 1000.0))
}
