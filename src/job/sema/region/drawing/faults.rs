//! What is wrong with a drawing of a region, in words.

use crate::sema::fields::Fields;
use crate::sema::profile::drawing::{NamedDrawing, joining};
use crate::sema::quantity::mm;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::import::drawing::{Chain, Gap, Loops, OpenError, OutlineError, SideName};

/// Most open chains that are listed.
const MOST_LISTED: usize = 12;

/// A layer of open sides beside all layers.
pub(super) fn open_without_layer(open: &Spanned<String>, fields: &Fields<'_>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::MissingField,
        "`open` needs `layer`",
        open.span,
        "the whole drawing would include these lines",
    );
    fields.offer(
        diagnostic,
        "name the layer of the loops, like",
        "layer = \"SEAT\"",
    )
}

/// Some lines do not close. `closes` says whether all do over wider gaps.
pub(super) fn open_chains(
    named: &NamedDrawing<'_>,
    loops: usize,
    chains: &[Chain],
    nearest: Option<Gap>,
    closes: &dyn Fn(Length) -> bool,
) -> Diagnostic {
    let closed = match loops {
        0 => "no loop".to_owned(),
        1 => "one loop".to_owned(),
        several => format!("{several} loops"),
    };
    let subject = named.subject();
    let message = match (chains, nearest) {
        ([_], Some(gap)) => format!(
            "{subject} has {closed} and one open chain: it ends at {}, {} from its beginning",
            named.shown(gap.from),
            mm(gap.size().to_mm())
        ),
        (several, Some(gap)) => format!(
            "{subject} has {closed} and {} open chains: the nearest two ends are {} apart, at {}",
            several.len(),
            mm(gap.size().to_mm()),
            named.shown(gap.from)
        ),
        (several, None) => format!("{subject} has {closed} and {} open chains", several.len()),
    };
    let mut diagnostic = Diagnostic::new(
        Code::RegionTangled,
        message,
        named.place(),
        "a region takes closed loops only",
    );
    if let Some(gap) = nearest {
        let [one, other] = gap.strokes;
        diagnostic = if one == other {
            diagnostic.and(named.stroke(one), "does not close")
        } else {
            diagnostic
                .and(named.stroke(one), "one side of the gap")
                .and(named.stroke(other), "the other side of the gap")
        };
    }
    if chains.len() > 1 {
        for chain in chains.iter().take(MOST_LISTED) {
            diagnostic = diagnostic.note(named.chain(chain));
        }
        let more = chains.len().saturating_sub(MOST_LISTED);
        if more > 0 {
            diagnostic = diagnostic.note(format!("and {more} more"));
        }
    }
    let wider = nearest.and_then(joining).filter(|wider| closes(*wider));
    let diagnostic = match wider {
        Some(wider) => diagnostic.help(format!(
            "close the gap in the drawing, or join over it with `tolerance = {}`",
            mm(wider.to_mm())
        )),
        None => diagnostic.help("close the loops in the drawing, or move other lines to another layer"),
    };
    named.with_layers(diagnostic)
}

/// The layer of open sides marks none, or something else.
pub(super) fn no_open_side(
    named: &NamedDrawing<'_>,
    marks: &NamedDrawing<'_>,
    error: OpenError,
    loops: &Loops,
    tolerance: Length,
) -> Box<Diagnostic> {
    let subject = marks.subject();
    let kind = |stroke: usize| {
        let drawn = marks.drawing.strokes.get(stroke);
        drawn.map_or("line", |drawn| drawn.kind)
    };
    let fault =
        |message: String, label: &str| Diagnostic::new(Code::RegionTangled, message, marks.place(), label);
    Box::new(match error {
        OpenError::Strokes(OutlineError::Nothing) => Diagnostic::new(
            Code::NothingDrawn,
            format!("there is no line in {subject}"),
            marks.place(),
            "marks no side",
        )
        .help("draw a line over each open side from end to end, or delete `open`"),
        OpenError::Strokes(error) => return marks.no_outline(error, tolerance),
        OpenError::Curved { stroke } => fault(
            format!("a curve in {subject} marks an open side"),
            "open sides are straight",
        )
        .and(marks.stroke(stroke), format!("this {}", kind(stroke)))
        .help("mark straight sides only, each by a line from end to end"),
        OpenError::Uncovered { stroke, line, side } => {
            let [from, to] = line.map(|end| marks.shown(end));
            let what = format!("the {} in {subject} from {from} to {to}", kind(stroke));
            match side.and_then(|side| way_of(loops, side)) {
                Some((owner, ends)) => {
                    let [from, to] = ends.map(|end| marks.shown(end));
                    fault(
                        format!("{what} covers only a part of a side"),
                        "marks whole sides",
                    )
                    .and(marks.stroke(stroke), "this line")
                    .and(
                        named.stroke(owner),
                        format!("this side leads from {from} to {to}"),
                    )
                    .help("draw the line from end to end, or end the side where it stops being open")
                }
                None => fault(format!("{what} lies on no side"), "marks sides of the loops")
                    .and(marks.stroke(stroke), "this line")
                    .help(format!(
                        "draw it from end to end over straight sides, within {}; or delete it",
                        mm(tolerance.to_mm())
                    )),
            }
        }
        OpenError::TooMany => fault(
            format!("{subject} has too many lines to compare with all sides"),
            "marks open sides",
        )
        .help("draw one line over each open side"),
    })
}

/// The stroke that drew a side, and the ends of the side.
fn way_of(loops: &Loops, (ring, place): SideName) -> Option<(usize, [vcutc_geometry::curve::Point2; 2])> {
    let piece = loops.rings.get(ring)?.get(place)?;
    Some((piece.stroke, [piece.way.from, piece.way.to]))
}
