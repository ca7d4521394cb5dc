//! The little of HTML that the page needs: texts that cannot break out, and tables.

pub(crate) use vcutc_picture::escaped;

/// A column of a table.
#[derive(Clone, Copy)]
pub(super) enum Column {
    Words(&'static str),
    /// Of numbers, which stand to the right.
    Numbers(&'static str),
    /// Of sentences: on a narrow screen they have a line of their own.
    Sentences(&'static str),
}

impl Column {
    /// Its class and its name.
    const fn head(self) -> (&'static str, &'static str) {
        match self {
            Self::Words(name) => ("", name),
            Self::Numbers(name) => (" class=\"n\"", name),
            Self::Sentences(name) => (" class=\"t\"", name),
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
pub(super) fn near(text: &str) -> String {
    format!("<span class=\"near\">{text}</span>")
}

/// A table. Cells are HTML; who puts text into them escapes it. Its frame can be reached by the keyboard, because a long one
/// scrolls by itself.
pub(super) fn table(
    caption: &str,
    columns: &[Column],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> String {
    let folds = columns.len() >= FOLDED || columns.iter().any(|column| column.is_of_sentences());
    let mut table = format!(
        "<div class=\"wide{}\" role=\"region\" aria-label=\"{caption}\" tabindex=\"0\">\n<table>\n\
         <caption>{caption}</caption>\n<thead><tr>",
        if folds { " folds" } else { "" }
    );
    for column in columns {
        let (class, name) = column.head();
        table += &format!("<th scope=\"col\"{class}>{name}</th>");
    }
    table += "</tr></thead>\n<tbody>\n";
    for row in rows {
        table += "<tr>";
        for (place, (cell, column)) in row.iter().zip(columns).enumerate() {
            let (class, name) = column.head();
            table += &match place {
                0 => format!("<th scope=\"row\"{class}>{cell}</th>"),
                _ if folds => format!("<td{class} data-name=\"{name}\">{cell}</td>"),
                _ => format!("<td{class}>{cell}</td>"),
            };
        }
        table += "</tr>\n";
    }
    table + "</tbody>\n</table>\n</div>\n"
}

pub(super) fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", unbroken(text))
}

/// A text as HTML in which no line ends between a number and its unit.
pub(crate) fn unbroken(text: &str) -> String {
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
    html
}

/// Names with what there is to say of each, as plain text: a list of terms.
pub(super) fn terms<'a>(lines: impl IntoIterator<Item = (&'a str, &'a str)>) -> String {
    let rows: String = lines
        .into_iter()
        .map(|(name, text)| {
            format!(
                "<div><dt>{}</dt><dd>{}</dd></div>\n",
                escaped(name),
                unbroken(text)
            )
        })
        .collect();
    format!("<dl class=\"terms\">\n{rows}</dl>\n")
}

/// A share of one as a percentage, `12.3 %`.
pub(super) fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stay_with_their_units() {
        assert_eq!(
            unbroken("at most 8 min 08.4 s; A6 83.4 %, 5 cuts <of> 3 mm."),
            "at most 8\u{a0}min 08.4\u{a0}s; A6 83.4\u{a0}%, 5 cuts &lt;of&gt; 3\u{a0}mm."
        );
        assert_eq!(unbroken(""), "");
        assert_eq!(unbroken("3 "), "3 ");
    }

    #[test]
    fn tables_have_heads_for_columns_and_rows() {
        let columns = [Column::Words("axis"), Column::Numbers("deg")];
        let text = table("Axes", &columns, [vec!["A1".to_owned(), "3".to_owned()]]);
        assert!(text.contains("<th scope=\"col\" class=\"n\">deg</th>"), "{text}");
        assert!(
            text.contains("<th scope=\"row\">A1</th><td class=\"n\">3</td>"),
            "{text}"
        );
    }
}
