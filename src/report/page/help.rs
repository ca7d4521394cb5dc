//! What would make the job faster, where its machine made it slow: hints after success, each compiled, with what to write where.

use super::Subject;
use super::source::Listing;
use crate::html::{Html, with_code};
use vcutc_driver::hints::Hint;

/// The block; nothing where nothing was found, or nothing was looked for.
pub(super) fn block(subject: Subject<'_>, listing: &Listing<'_>) -> Html {
    let hints = subject.further.hints;
    if hints.is_empty() {
        return Html::default();
    }
    let items: Html = hints.iter().map(|hint| item(hint, listing)).collect();
    html!("help.html", items = items)
}

/// A change, which says what to write, and the lines that it changes.
fn item(hint: &Hint, listing: &Listing<'_>) -> Html {
    let edits = hint.fix.edits.iter().map(|edit| {
        let lead = match edit.span.bytes().is_empty() {
            true => "to be added after",
            false => "now, at",
        };
        let place = listing.place(edit.span);
        html!(
            in "<br>{lead} {place}: <code>{line}</code>",
            lead = lead,
            place = place.linked(),
            line = place.line
        )
    });
    html!(
        in "<li>{title}{edits}</li>\n",
        title = with_code(&hint.fix.title),
        edits = edits.collect::<Html>()
    )
}
