//! The little of SVG that pictures here need.

use super::palette::INK;
use super::scale::Scale;
use super::trace::{Trace, number};
use super::{Point, Prefix, Setting};
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
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// The mark of a single point: a path around (0, 0), no wider and higher than 20, drawn once in each paint. Light under dark
/// stands out on every ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Mark {
    pub(super) path: &'static str,
    pub(super) paints: &'static [&'static str],
}

const CIRCLE: &str = "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z";

impl Mark {
    pub(super) const RING: Self = Self {
        path: "M-7 0a7 7 0 1 0 14 0a7 7 0 1 0 -14 0Z",
        paints: &[
            "fill=\"none\" stroke=\"#ffffff\" stroke-width=\"6\"",
            "fill=\"none\" stroke=\"#2b2a27\" stroke-width=\"2.5\"",
        ],
    };
    pub(super) const CROSS: Self = Self {
        path: "M-7 -7l14 14m0 -14l-14 14",
        paints: &[
            "fill=\"none\" stroke-linecap=\"round\" stroke=\"#ffffff\" stroke-width=\"7\"",
            "fill=\"none\" stroke-linecap=\"round\" stroke=\"#c2185b\" stroke-width=\"3.5\"",
        ],
    };
    pub(super) const DISC: Self = Self {
        path: CIRCLE,
        paints: &["fill=\"#0072b2\" stroke=\"#ffffff\" stroke-width=\"1.5\""],
    };
    pub(super) const HOLLOW: Self = Self {
        path: CIRCLE,
        paints: &["fill=\"#ffffff\" stroke=\"#d55e00\" stroke-width=\"2\""],
    };
    pub(super) const ORIGIN: Self = Self {
        path: CIRCLE,
        paints: &["fill=\"#2b2a27\" stroke=\"#ffffff\" stroke-width=\"1.5\""],
    };
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
        let (ids, title, description) = (ids.ids, escaped(title), escaped(description));
        svg.line(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\" role=\"img\" aria-labelledby=\"{ids}title {ids}description\" font-family=\"sans-serif\" \
             font-size=\"{font}\">\n  <title id=\"{ids}title\">{title}</title>\n  \
             <desc id=\"{ids}description\">{description}</desc>\n  \
             <rect width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"#fbfaf7\"/>"
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

    fn line(&mut self, markup: &str) {
        self.text.push_str(markup);
        self.text.push('\n');
    }

    /// A rectangle; `paint` holds its attributes.
    pub(super) fn rect(&mut self, area: [f64; 4], paint: &str) {
        let [x, y, width, height] = area.map(number);
        self.line(&format!(
            "  <rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {paint}/>"
        ));
    }

    /// A path of rectangles, if there are any: many of one paint are one element.
    pub(super) fn rects(&mut self, rects: &[[f64; 4]], paint: &str) {
        let mut path = String::new();
        for rect in rects {
            let [x, y, width, height] = rect.map(number);
            // Writing to a string cannot fail.
            let _ = write!(path, "M{x} {y}h{width}v{height}h-{width}z");
        }
        self.path(&path, paint);
    }

    /// A path, unless it is empty.
    pub(super) fn path(&mut self, path: &str, paint: &str) {
        if !path.is_empty() {
            self.line(&format!("  <path d=\"{path}\" {paint}/>"));
        }
    }

    /// A line through points.
    pub(super) fn open(&mut self, points: impl IntoIterator<Item = Point>, paint: &str) {
        self.path(Trace::through(points).text(), paint);
    }

    /// A polygon.
    pub(super) fn closed(&mut self, points: impl IntoIterator<Item = Point>, paint: &str) {
        self.path(Trace::around(points).text(), paint);
    }

    /// A mark at a point.
    pub(super) fn mark(&mut self, at: Point, mark: Mark) {
        let [x, y] = at.map(number);
        for paint in mark.paints {
            let path = mark.path;
            self.line(&format!(
                "  <path transform=\"translate({x} {y})\" d=\"{path}\" {paint}/>"
            ));
        }
    }

    /// An arrow, with its head at the end.
    pub(super) fn arrow(&mut self, from: Point, to: Point, colour: &str) {
        let line = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\"");
        self.open([from, behind([from, to], [9.0, 0.0])], &line);
        self.closed(head([from, to]), &format!("fill=\"{colour}\""));
    }

    /// An axis that points out of the picture.
    pub(super) fn towards_the_eye(&mut self, at: Point, colour: &str) {
        let [x, y] = at.map(number);
        self.line(&format!(
            "  <circle cx=\"{x}\" cy=\"{y}\" r=\"7.5\" fill=\"#fbfaf7\" stroke=\"{colour}\" stroke-width=\"2.5\"/>"
        ));
        self.line(&format!(
            "  <circle cx=\"{x}\" cy=\"{y}\" r=\"2.5\" fill=\"{colour}\"/>"
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
        let layers = escaped(&layers.join(" "));
        self.unseen(area, &format!("data-cursor=\"layers\" data-layers=\"{layers}\""));
    }

    fn unseen(&mut self, area: [f64; 4], data: &str) {
        match self.setting {
            Setting::Alone => {}
            Setting::Page | Setting::Phone => {
                self.rect(area, &format!("fill=\"none\" pointer-events=\"none\" {data}"));
            }
        }
    }

    /// A text; `style` holds further attributes.
    pub(super) fn text(&mut self, at: Point, anchor: Anchor, style: &str, text: &str) {
        self.coloured(at, anchor, INK, style, text);
    }

    /// A text that is turned to run upwards, around its middle.
    pub(super) fn upwards(&mut self, [x, y]: Point, text: &str) {
        let turned = format!("transform=\"rotate(-90 {} {})\"", number(x), number(y));
        self.text([x, y], Anchor::Middle, &turned, text);
    }

    /// A text in a colour, unless it is empty.
    pub(super) fn coloured(&mut self, at: Point, anchor: Anchor, colour: &str, style: &str, text: &str) {
        if text.is_empty() {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let space = if style.is_empty() { "" } else { " " };
        let ([x, y], text) = (at.map(number), escaped(text));
        self.line(&format!(
            "  <text x=\"{x}\" y=\"{y}\"{anchor} fill=\"{colour}\"{space}{style}>{text}</text>"
        ));
    }

    /// The whole text.
    pub(super) fn finish(mut self) -> String {
        self.line("</svg>");
        self.text
    }
}

/// The corners of the head of an arrow that leads from a point to another one, its tip first.
pub(super) fn head(arrow: [Point; 2]) -> [Point; 3] {
    let [_, tip] = arrow;
    [tip, behind(arrow, [11.0, 5.5]), behind(arrow, [11.0, -5.5])]
}

/// A place so far before the end of an arrow, and so far beside it.
fn behind([from, to]: [Point; 2], [along, across]: [f64; 2]) -> Point {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
    let [x, y] = [x / length, y / length];
    [to[0] - along * x - across * y, to[1] - along * y + across * x]
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
    fn names_cannot_break_the_markup() {
        assert_eq!(escaped("a<b> & \"c\"\u{0}"), "a&lt;b&gt; &amp; &quot;c&quot; ");
    }
}
