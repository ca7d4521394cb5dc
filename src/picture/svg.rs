//! The little of SVG that pictures here need.

use super::palette::INK;
use super::scale::Scale;
use super::{Prefix, Setting};
use core::fmt::Write;

/// An SVG text under construction. Coordinates are written with two decimals, so that they are the same everywhere.
pub(super) struct Svg {
    text: String,
    setting: Setting,
}

/// What the pictures of a page share, so that a cursor in one is shown in the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Along {
    /// The time of the program, in s.
    Time,
    /// The width of the stock, in mm.
    Width,
}

/// Where a text stands against its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Svg {
    /// A picture of this size, with what it shows in words for those who do not see it, on a ground of its own: viewers
    /// with a dark page show it as it is.
    pub(super) fn new(
        [width, height]: [f64; 2],
        font: u32,
        ids: Prefix,
        title: &str,
        description: &str,
    ) -> Self {
        let mut svg = Self {
            text: String::new(),
            setting: ids.setting,
        };
        let (width, height) = (number(width), number(height));
        let ids = ids.ids;
        svg.line(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\" role=\"img\" aria-labelledby=\"{ids}title {ids}description\" font-family=\"sans-serif\" \
             font-size=\"{font}\">"
        ));
        svg.line(&format!("  <title id=\"{ids}title\">{}</title>", escaped(title)));
        svg.line(&format!(
            "  <desc id=\"{ids}description\">{}</desc>",
            escaped(description)
        ));
        svg.line(&format!(
            "  <rect width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"#fbfaf7\"/>"
        ));
        svg
    }

    /// Defines the pattern `url(#hatch)`: for what is out of bounds.
    pub(super) fn define_hatch(&mut self) {
        self.line(
            "  <defs><pattern id=\"hatch\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" \
             patternTransform=\"rotate(45)\"><rect width=\"7\" height=\"7\" fill=\"#e9e6df\"/>\
             <path d=\"M0 0V7\" stroke=\"#b9b3a3\" stroke-width=\"2\"/></pattern></defs>",
        );
    }

    /// A line of markup as it is.
    pub(super) fn line(&mut self, markup: &str) {
        self.text.push_str(markup);
        self.text.push('\n');
    }

    /// A rectangle; `paint` holds its attributes.
    pub(super) fn rect(&mut self, [x, y, width, height]: [f64; 4], paint: &str) {
        let [x, y, width, height] = [x, y, width, height].map(number);
        self.line(&format!(
            "  <rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {paint}/>"
        ));
    }

    /// Where the page draws its cursor, and what it stands for there; nothing in a picture that stands alone.
    pub(super) fn cursor(&mut self, along: Along, scale: &Scale, [top, bottom]: [f64; 2]) {
        let along = match along {
            Along::Time => "time",
            Along::Width => "x",
        };
        let ([from, to], [left, right]) = (scale.values, scale.places);
        let data = format!("data-cursor=\"{along}\" data-from=\"{from}\" data-to=\"{to}\"");
        self.unseen([left, top, right - left, bottom - top], &data);
    }

    /// A row that stands for layers, by their names; nothing in a picture that stands alone.
    pub(super) fn row_of_layers(&mut self, area: [f64; 4], layers: &[String]) {
        let data = format!(
            "data-cursor=\"layers\" data-layers=\"{}\"",
            escaped(&layers.join(" "))
        );
        self.unseen(area, &data);
    }

    fn unseen(&mut self, area: [f64; 4], data: &str) {
        match self.setting {
            Setting::Alone => {}
            Setting::Page | Setting::Phone => {
                self.rect(area, &format!("fill=\"none\" pointer-events=\"none\" {data}"));
            }
        }
    }

    /// A path of rectangles: many of one paint are one element.
    pub(super) fn rects(&mut self, rects: &[[f64; 4]], paint: &str) {
        let mut path = String::new();
        for rect in rects {
            let [x, y, width, height] = rect.map(number);
            // Writing to a string cannot fail.
            let _ = write!(path, "M{x} {y}h{width}v{height}h-{width}z");
        }
        self.path(&path, paint);
    }

    pub(super) fn path(&mut self, path: &str, paint: &str) {
        self.line(&format!("  <path d=\"{path}\" {paint}/>"));
    }

    /// A text; `style` holds further attributes.
    pub(super) fn text(&mut self, at: (f64, f64), anchor: Anchor, style: &str, text: &str) {
        self.coloured(at, anchor, INK, style, text);
    }

    /// A text in a colour.
    pub(super) fn coloured(
        &mut self,
        (x, y): (f64, f64),
        anchor: Anchor,
        colour: &str,
        style: &str,
        text: &str,
    ) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let space = if style.is_empty() { "" } else { " " };
        self.line(&format!(
            "  <text x=\"{}\" y=\"{}\"{anchor} fill=\"{colour}\"{space}{style}>{}</text>",
            number(x),
            number(y),
            escaped(text)
        ));
    }

    pub(super) fn finish(mut self) -> String {
        self.line("</svg>");
        self.text
    }
}

/// Two decimals, without those that are zero, and never `-0`.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".to_owned()
    } else {
        short.to_owned()
    }
}

/// A text as it stands between tags and within double quotes, of XML and of HTML.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // XML has no way to say these.
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        for (value, text) in [
            (0.0, "0"),
            (-0.001, "0"),
            (12.0, "12"),
            (1.5, "1.5"),
            (-0.126, "-0.13"),
            (100.0, "100"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn names_cannot_break_the_markup() {
        assert_eq!(escaped("a<b> & \"c\"\u{0}"), "a&lt;b&gt; &amp; &quot;c&quot; ");
    }
}
