//! What of a drawing is not taken as it stands: one warning, with a line for each kind.

use super::faults::NamedDrawing;
use vcutc_diagnostics::position::position;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::import::drawing::{Place, Unread, Why};

/// Most lines of one kind of remark.
const MOST_LINES: usize = 8;

impl NamedDrawing<'_> {
    /// The warning, if there is anything to report. `repeated` are the strokes that are drawn twice, as far
    /// as that is known.
    pub(crate) fn remarks(&self, repeated: &[usize]) -> Vec<Diagnostic> {
        let drawing = self.drawing;
        let mut notes = Vec::new();
        for unread in &drawing.unread {
            notes.push(format!(
                "{} {}: {}; the first in line {}",
                unread.count,
                unread.kind,
                unread.why.words(),
                self.line_of(unread.first)
            ));
        }
        if let Some(first) = repeated.first().and_then(|&stroke| drawing.strokes.get(stroke)) {
            notes.push(format!(
                "{} drawn over lines that are there already, and counted once; the first is the {} in line {}",
                repeated.len(),
                first.kind,
                self.line_of(first.place)
            ));
        }
        for remark in drawing.remarks.iter().take(MOST_LINES) {
            notes.push(format!("line {}: {}", self.line_of(remark.place), remark.message));
        }
        let more = drawing.remarks.len().saturating_sub(MOST_LINES);
        if more > 0 {
            notes.push(format!("and {more} more like this"));
        }
        if notes.is_empty() {
            return Vec::new();
        }
        let place = self.layer.map_or(self.path.span, |layer| layer.span);
        let on = self
            .layer
            .map_or_else(String::new, |layer| format!("layer `{}` of ", layer.node));
        let diagnostic = Diagnostic::new(
            Code::PartlyRead,
            format!("parts of {on}`{}` were skipped or interpreted", self.path.node),
            place,
            "more is drawn here than the outline",
        )
        .help("move what is not part of the outline to another layer, or delete it");
        let is_dark = |unread: &Unread| match unread.why {
            Why::Off | Why::Frozen => true,
            Why::Kind
            | Why::Tilted
            | Why::Paper
            | Why::Hidden
            | Why::NoExtent
            | Why::OtherFile
            | Why::NotApplied => false,
        };
        let diagnostic = if self.layer.is_none() && drawing.unread.iter().any(is_dark) {
            diagnostic.help("a named layer is read even if it is off or frozen")
        } else {
            diagnostic
        };
        vec![notes.into_iter().fold(diagnostic, Diagnostic::note)]
    }

    /// The line of a place in the drawing.
    fn line_of(&self, place: Place) -> usize {
        let text = self.sources.get(self.file).map_or("", |file| file.text.as_str());
        position(text, place.start).line
    }
}
