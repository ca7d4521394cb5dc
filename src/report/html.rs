//! HTML from templates: files in `src/report/templates`, copied into the program, with `{name}` where something goes.
//!
//! What goes there is distinguished by its type: [`Html`] is taken as it is, texts are escaped. `html!` is read when the compiler is
//! built, so a template that lacks a value, or a value without a place, does not compile.

use core::ops::{Add, AddAssign};
use std::borrow::Cow;
use vcutc_picture::escaped;

/// A piece of HTML.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Html(String);

/// Fills in a template: a file, or after `in` a few words of markup.
macro_rules! html {
    (in $template:literal $(, $name:ident = $value:expr)* $(,)?) => {
        $crate::html::Html::trusted(format!($template $(, $name = $crate::html::Markup::markup(&$value))*))
    };
    ($template:literal $(, $name:ident = $value:expr)* $(,)?) => {
        $crate::html::Html::trusted(format!(
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/templates/", $template))
            $(, $name = $crate::html::Markup::markup(&$value))*
        ))
    };
}

/// What can stand in a template.
pub(crate) trait Markup {
    /// As HTML.
    fn markup(&self) -> Cow<'_, str>;
}

impl Markup for Html {
    fn markup(&self) -> Cow<'_, str> {
        Cow::Borrowed(&self.0)
    }
}

impl Markup for str {
    fn markup(&self) -> Cow<'_, str> {
        Cow::Owned(escaped(self))
    }
}

impl Markup for String {
    fn markup(&self) -> Cow<'_, str> {
        self.as_str().markup()
    }
}

impl Markup for usize {
    fn markup(&self) -> Cow<'_, str> {
        Cow::Owned(self.to_string())
    }
}

impl<T: Markup + ?Sized> Markup for &T {
    fn markup(&self) -> Cow<'_, str> {
        (*self).markup()
    }
}

/// What may be missing: nothing then.
impl<T: Markup> Markup for Option<T> {
    fn markup(&self) -> Cow<'_, str> {
        self.as_ref().map_or(Cow::Borrowed(""), T::markup)
    }
}

impl Html {
    /// A text that is HTML already: a template, a picture, style or script.
    pub(crate) fn trusted(html: impl Into<String>) -> Self {
        Self(html.into())
    }

    /// A text.
    pub(crate) fn text(text: &str) -> Self {
        Self(escaped(text))
    }

    /// A text of several lines: what is escaped has none.
    pub(crate) fn lines(text: &str) -> Self {
        let lines: Vec<String> = text.split('\n').map(escaped).collect();
        Self(lines.join("\n"))
    }

    /// The HTML.
    pub(crate) fn into_text(self) -> String {
        self.0
    }
}

impl<T: Markup> FromIterator<T> for Html {
    fn from_iter<I: IntoIterator<Item = T>>(pieces: I) -> Self {
        let mut whole = String::new();
        for piece in pieces {
            whole += &piece.markup();
        }
        Self(whole)
    }
}

impl Add for Html {
    type Output = Self;

    fn add(mut self, next: Self) -> Self {
        self += next;
        self
    }
}

impl AddAssign for Html {
    fn add_assign(&mut self, next: Self) {
        self.0 += &next.0;
    }
}

/// A column of a table.
#[derive(Clone, Copy)]
pub(crate) enum Column {
    /// Of words.
    Words(&'static str),
    /// Of numbers, which stand to the right.
    Numbers(&'static str),
    /// Of sentences: on a narrow screen they have a line of their own.
    Sentences(&'static str),
}

impl Column {
    /// Its class and its name.
    fn head(self) -> (Html, &'static str) {
        match self {
            Self::Words(name) => (Html::default(), name),
            Self::Numbers(name) => (html!(in " class=\"n\""), name),
            Self::Sentences(name) => (html!(in " class=\"t\""), name),
        }
    }

    const fn is_of_sentences(self) -> bool {
        match self {
            Self::Sentences(_) => true,
            Self::Words(_) | Self::Numbers(_) => false,
        }
    }
}

/// From so many columns on a table is folded on a narrow screen: a row becomes a list of names and values.
const FOLDED: usize = 4;

/// A value that has come to its limit, or nearly: it is seen at once.
pub(crate) fn near(text: &str) -> Html {
    html!(in "<span class=\"near\">{text}</span>", text = text)
}

/// A table. Its frame can be reached by the keyboard, because a long one scrolls by itself.
pub(crate) fn table<T: Markup>(
    caption: &str,
    columns: &[Column],
    rows: impl IntoIterator<Item = Vec<T>>,
) -> Html {
    let folds = columns.len() >= FOLDED || columns.iter().any(|column| column.is_of_sentences());
    let head = |column: &Column| {
        let (class, name) = column.head();
        html!(in "<th scope=\"col\"{class}>{name}</th>", class = class, name = name)
    };
    let row = |cells: Vec<T>| {
        let cells = cells.iter().zip(columns).enumerate();
        let row: Html = cells
            .map(|(place, (held, column))| cell(place, held, *column, folds))
            .collect();
        html!(in "<tr>{row}</tr>\n", row = row)
    };
    html!(
        "table.html",
        folds = folds.then_some(" folds"),
        caption = caption,
        heads = columns.iter().map(head).collect::<Html>(),
        rows = rows.into_iter().map(row).collect::<Html>(),
    )
}

fn cell(place: usize, held: &impl Markup, column: Column, folds: bool) -> Html {
    let (class, name) = column.head();
    match place {
        0 => html!(in "<th scope=\"row\"{class}>{held}</th>", class = class, held = held),
        _ if folds => html!(
            in "<td{class} data-name=\"{name}\">{held}</td>",
            class = class,
            name = name,
            held = held
        ),
        _ => html!(in "<td{class}>{held}</td>", class = class, held = held),
    }
}

/// A paragraph of text.
pub(crate) fn paragraph(text: &str) -> Html {
    html!(in "<p>{text}</p>\n", text = unbroken(text))
}

/// A text as HTML in which no line ends between a number and its unit.
pub(crate) fn unbroken(text: &str) -> Html {
    const UNITS: [&str; 11] = [
        "%", "mm", "mm\u{b2}", "mm/s", "deg", "deg/s", "s", "min", "h", "kg", "ms",
    ];
    let escaped = escaped(text);
    let mut words = escaped.split(' ').peekable();
    let mut html = String::with_capacity(escaped.len() + 16);
    while let Some(word) = words.next() {
        html += word;
        let Some(next) = words.peek() else { break };
        let unit = next.trim_end_matches([',', ';', '.', ':', ')']);
        let is_number = word.ends_with(|letter: char| letter.is_ascii_digit());
        html.push(if is_number && UNITS.contains(&unit) {
            '\u{a0}'
        } else {
            ' '
        });
    }
    Html(html)
}

/// Names with what there is to say of each, as plain text: a list of terms.
pub(crate) fn terms<'a>(lines: impl IntoIterator<Item = (&'a str, &'a str)>) -> Html {
    let row = |(name, text)| {
        html!(
            in "<div><dt>{name}</dt><dd>{text}</dd></div>\n",
            name = name,
            text = unbroken(text)
        )
    };
    let rows: Html = lines.into_iter().map(row).collect();
    html!(in "<dl class=\"terms\">\n{rows}</dl>\n", rows = rows)
}

/// A share of one as a percentage, `12.3 %`.
pub(crate) fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

/// What stands between backquotes is set as what to write.
pub(crate) fn with_code(text: &str) -> Html {
    let parts = text.split('`').enumerate();
    let set = parts.map(|(number, part)| match number % 2 {
        0 => unbroken(part),
        _ => html!(in "<code>{part}</code>", part = part),
    });
    set.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_to_write_is_set_as_code() {
        assert_eq!(
            with_code("`a = 3 mm` saves 5 %, or `b`").into_text(),
            "<code>a = 3 mm</code> saves 5\u{a0}%, or <code>b</code>"
        );
        assert_eq!(with_code("nothing").into_text(), "nothing");
    }

    #[test]
    fn numbers_stay_with_their_units() {
        assert_eq!(
            unbroken("at most 8 min 08.4 s; A6 83.4 %, 5 cuts <of> 3 mm.").0,
            "at most 8\u{a0}min 08.4\u{a0}s; A6 83.4\u{a0}%, 5 cuts &lt;of&gt; 3\u{a0}mm."
        );
        assert_eq!(unbroken("").0, "");
        assert_eq!(unbroken("3 ").0, "3 ");
    }

    #[test]
    fn tables_have_heads_for_columns_and_rows() {
        let columns = [Column::Words("axis"), Column::Numbers("deg")];
        let text = table("Axes", &columns, [vec!["A1", "<3"]]).0;
        assert!(text.contains("<th scope=\"col\" class=\"n\">deg</th>"), "{text}");
        assert!(
            text.contains("<th scope=\"row\">A1</th><td class=\"n\">&lt;3</td>"),
            "{text}"
        );
    }
}
