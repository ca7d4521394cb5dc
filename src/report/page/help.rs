//! What would make the job faster, where its machine made it slow: hints after success, each compiled, with what to write where.

use super::Subject;
use super::html::{escaped, unbroken};
use super::source::Listing;
use vcutc_driver::hints::Hint;

/// The block; nothing where nothing was found, or nothing was looked for.
pub(super) fn block(subject: Subject<'_>, listing: &Listing<'_>) -> String {
    let hints = subject.further.hints;
    if hints.is_empty() {
        return String::new();
    }
    let items: String = hints.iter().map(|hint| item(hint, listing)).collect();
    format!(
        "<section class=\"help\" id=\"help\" aria-labelledby=\"help-heading\">\n<h2 id=\"help-heading\">What would help</h2>\n\
         <p>The machine made this job slower than the process needs. Each change was compiled and proven by itself.</p>\n\
         <ul>\n{items}</ul>\n</section>\n"
    )
}

/// A change, which says what to write, and the lines that it changes.
fn item(hint: &Hint, listing: &Listing<'_>) -> String {
    let edits: Vec<String> = hint
        .fix
        .edits
        .iter()
        .map(|edit| {
            let place = listing.place(edit.span);
            let words = escaped(&place.words);
            let words = match place.link {
                Some(link) => format!("<a href=\"#{link}\">{words}</a>"),
                None => words,
            };
            let lead = if edit.span.bytes().is_empty() {
                "to be added after"
            } else {
                "now, at"
            };
            format!("<br>{lead} {words}: <code>{}</code>", escaped(&place.line))
        })
        .collect();
    format!(
        "<li>{}{}</li>\n",
        with_code(&unbroken(&hint.fix.title)),
        edits.concat()
    )
}

/// What stands between backquotes is set as what to write.
fn with_code(html: &str) -> String {
    let mut parts = html.split('`');
    let mut set = parts.next().unwrap_or_default().to_owned();
    while let Some(code) = parts.next() {
        set += &format!("<code>{code}</code>{}", parts.next().unwrap_or_default());
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_to_write_is_set_as_code() {
        assert_eq!(
            with_code("`a = 3 mm` saves 5 %, or `b`"),
            "<code>a = 3 mm</code> saves 5 %, or <code>b</code>"
        );
        assert_eq!(with_code("nothing"), "nothing");
    }
}
