//! Text with the colours of a terminal as HTML: the sequences that the renderer of diagnostics writes (ECMA-48, "select graphic
//! rendition") become spans with a class for each colour, and all others vanish.

use crate::html::Html;

/// What letters look like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Look {
    is_bold: bool,
    /// Number of the colour, of the first sixteen.
    colour: Option<u8>,
}

/// The text as HTML, line by line as it is.
pub(super) fn html(text: &str) -> Html {
    let mut html = Html::default();
    let mut look = Look::default();
    let mut pieces = text.split('\u{1b}');
    html += shown(pieces.next().unwrap_or_default(), look);
    for piece in pieces {
        let (sequence, rest) = sequence(piece);
        if let Some(codes) = sequence {
            look = look.after(codes);
        }
        html += shown(rest, look);
    }
    html
}

/// The numbers of a sequence that changes the look, and what comes after any sequence.
fn sequence(piece: &str) -> (Option<&str>, &str) {
    let Some(body) = piece.strip_prefix('[') else {
        return (None, piece);
    };
    match body.find(|letter: char| ('\u{40}'..='\u{7e}').contains(&letter)) {
        Some(end) => {
            let (codes, rest) = body.split_at(end);
            (
                rest.starts_with('m').then_some(codes),
                rest.get(1..).unwrap_or_default(),
            )
        }
        None => (None, ""),
    }
}

impl Look {
    fn after(self, codes: &str) -> Self {
        let mut look = self;
        let mut codes = codes.split(';').map(|code| code.parse::<u8>().unwrap_or(0));
        while let Some(code) = codes.next() {
            look = match code {
                0 => Self::default(),
                1 => Self {
                    is_bold: true,
                    ..look
                },
                22 => Self {
                    is_bold: false,
                    ..look
                },
                30..=37 => look.in_colour(code - 30),
                90..=97 => look.in_colour(code - 82),
                // A colour of 256. Our messages have none of red, green and blue.
                38 => match (codes.next(), codes.next()) {
                    (Some(5), Some(number)) => look.in_colour(nearest(number)),
                    (_, _) => look,
                },
                39 => Self { colour: None, ..look },
                _ => look,
            };
        }
        look
    }

    const fn in_colour(self, number: u8) -> Self {
        Self {
            colour: Some(number),
            ..self
        }
    }
}

/// The one of the first sixteen colours that is most like one of 256: those of the cube by what red, green and blue they have.
fn nearest(number: u8) -> u8 {
    match number {
        0..=15 => number,
        16..=231 => {
            let number = number - 16;
            let parts = [number / 36, number / 6 % 6, number % 6];
            let most = parts.into_iter().max().unwrap_or(0);
            let bit = |part: u8, value: u8| if part > 0 && part * 2 > most { value } else { 0 };
            let colour = bit(parts[0], 1) + bit(parts[1], 2) + bit(parts[2], 4);
            if most > 3 { colour + 8 } else { colour }
        }
        232..=243 => 8,
        244..=255 => 7,
    }
}

/// A stretch of one look, its lines as they are.
fn shown(text: &str, look: Look) -> Html {
    if text.is_empty() {
        return Html::default();
    }
    let text = Html::lines(text);
    let colour = look.colour.map(usize::from);
    match (look.colour, look.is_bold) {
        (None, false) => text,
        (None, true) => html!(in "<b>{text}</b>", text = text),
        (Some(_), false) => html!(in "<span class=\"c{colour}\">{text}</span>", colour = colour, text = text),
        (Some(_), true) => html!(in "<b class=\"c{colour}\">{text}</b>", colour = colour, text = text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn html(text: &str) -> String {
        super::html(text).into_text()
    }

    #[test]
    fn colours_become_spans_and_lines_stay() {
        let text = "\u{1b}[1;31merror[VC0203]\u{1b}[0m\u{1b}[1m: a < b\u{1b}[0m\n  \u{1b}[38;5;246m2 │\u{1b}[0m  x\n";
        assert_eq!(
            html(text),
            "<b class=\"c1\">error[VC0203]</b><b>: a &lt; b</b>\n  <span class=\"c7\">2 │</span>  x\n"
        );
    }

    #[test]
    fn nothing_else_of_a_terminal_is_left() {
        assert_eq!(html("a\u{1b}[2Kb\u{1b}c\u{1b}[3"), "abc");
        assert_eq!(
            html("\u{1b}[91m<script>\u{1b}[39m\u{7}"),
            "<span class=\"c9\">&lt;script&gt;</span> "
        );
        assert_eq!(nearest(196), 9);
        assert_eq!(nearest(34), 2);
        assert_eq!(nearest(27), 12);
    }
}
