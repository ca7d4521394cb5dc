//! What pictures have around their plot: headings above, a legend below.
//!
//! A sheet that stands alone is as wide as a page and a phone allow: letters of 15 in a width of 680 can still be read on a
//! screen of a third that is held close. In a page it is as wide as the page, with letters as large as the page's, and drawn once
//! more for telephones; the page has its words. Colours are those that people who do not tell red from green tell apart [Okabe 2008], and marks
//! differ in shape too.

use super::svg::{Anchor, Svg, number};
use super::{Prefix, Setting};

/// Width of a sheet that stands alone.
pub(super) const WIDTH: f64 = 680.0;
/// Width of a picture in a page, in CSS pixels: its letters are as large as the page's.
pub const PAGE_WIDTH: f64 = 1160.0;
/// Width of a picture in a page on a telephone, in CSS pixels.
pub const PHONE_WIDTH: f64 = 400.0;
/// Size of letters.
pub(super) const FONT: u32 = 15;
/// Left edge of what is plotted on a sheet that stands alone.
pub(super) const LEFT: f64 = 66.0;
/// Right edge of what is plotted on a sheet that stands alone.
pub(super) const RIGHT: f64 = 636.0;
/// Upper edge of what is plotted below a heading.
pub(super) const TOP: f64 = 92.0;
/// Room to the right of a plot.
pub(super) const MARGIN: f64 = WIDTH - RIGHT;

/// The room that a sheet has for its plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Room {
    /// Width of the sheet.
    pub(super) width: f64,
    /// Left edge of what is plotted.
    pub(super) left: f64,
    /// Right edge.
    pub(super) right: f64,
    /// Upper edge.
    pub(super) top: f64,
}

impl Room {
    /// The room where a picture is shown.
    pub(super) const fn of(ids: Prefix) -> Self {
        let (width, left, top) = match ids.setting {
            Setting::Alone => (WIDTH, LEFT, TOP),
            Setting::Page => (PAGE_WIDTH, LEFT, 22.0),
            Setting::Phone => (PHONE_WIDTH, 54.0, 22.0),
        };
        Self {
            width,
            left,
            right: width - MARGIN,
            top,
        }
    }

    /// The same on a sheet of another width.
    pub(super) const fn of_width(self, width: f64) -> Self {
        Self {
            width,
            right: width - MARGIN,
            ..self
        }
    }

    /// Width of the plot.
    pub(super) const fn across(&self) -> f64 {
        self.right - self.left
    }

    /// Columns that curves are looked at in: one to a unit.
    pub(super) const fn columns(&self) -> u32 {
        self.across() as u32
    }
}

/// Lets a text be read on anything.
pub(super) const HALO: &str =
    "stroke=\"#fbfaf7\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\"";

/// What a picture is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heading<'a> {
    /// What the ids of the picture begin with.
    pub ids: Prefix,
    /// What it shows, in a line.
    pub title: &'a str,
    /// What holds for the whole picture, in a line.
    pub subtitle: &'a str,
}

/// An entry of a legend.
pub(super) struct Entry {
    pub(super) swatch: Swatch,
    /// What it means.
    pub(super) words: String,
}

/// What an entry of a legend looks like; attributes of SVG.
pub(super) enum Swatch {
    Area(String),
    Line(String),
    /// A path around (0, 0), no wider and higher than 12.
    Mark(String, String),
}

impl Entry {
    pub(super) fn area(paint: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            swatch: Swatch::Area(paint.into()),
            words: words.into(),
        }
    }

    pub(super) fn line(paint: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            swatch: Swatch::Line(paint.into()),
            words: words.into(),
        }
    }

    /// Room that it takes in a row, by the usual width of letters.
    fn width(&self) -> f64 {
        34.0 + text_width(&self.words) + BETWEEN
    }
}

/// About how wide a text is, in the usual letters.
pub(super) fn text_width(text: &str) -> f64 {
    text.chars().count() as f64 * f64::from(FONT) * 0.57
}

/// Room between entries of a legend.
const BETWEEN: f64 = 22.0;
/// Distance of rows in a legend.
const ROW: f64 = 26.0;

/// Begins a sheet: its plot ends at `bottom`, and the legend stands below.
pub(super) fn sheet(
    heading: Heading<'_>,
    room: Room,
    description: &str,
    bottom: f64,
    legend: &[Entry],
) -> Svg {
    let indent = match heading.ids.setting {
        Setting::Alone | Setting::Page => 24.0,
        Setting::Phone => 8.0,
    };
    let rows = rows(legend, indent, room.width);
    let height = bottom + 18.0 + rows.len() as f64 * ROW;
    let mut svg = Svg::new(
        [room.width, height],
        FONT,
        heading.ids,
        heading.title,
        description,
    );
    match heading.ids.setting {
        Setting::Alone => words(&mut svg, heading),
        Setting::Page | Setting::Phone => {}
    }
    for (row, entries) in rows.iter().enumerate() {
        let y = bottom + ROW * (row as f64 + 0.5);
        let mut x = indent;
        for entry in *entries {
            swatch(&mut svg, (x, y), &entry.swatch);
            svg.text((x + 34.0, y + 5.0), Anchor::Start, "", &entry.words);
            x += entry.width();
        }
    }
    svg
}

/// Title and subtitle.
fn words(svg: &mut Svg, heading: Heading<'_>) {
    svg.text(
        (24.0, 32.0),
        Anchor::Start,
        "font-size=\"18\" font-weight=\"bold\"",
        &shortened(heading.title, 56),
    );
    svg.text(
        (24.0, 56.0),
        Anchor::Start,
        "font-size=\"14\"",
        &shortened(heading.subtitle, 76),
    );
}

/// Entries in rows that fit.
fn rows(legend: &[Entry], indent: f64, width: f64) -> Vec<&[Entry]> {
    let mut rows = Vec::new();
    let mut rest = legend;
    while !rest.is_empty() {
        // Behind the last entry of a row there need be no room.
        let mut x = indent - BETWEEN;
        let fitting = rest.iter().take_while(|entry| {
            x += entry.width();
            x <= width
        });
        let (row, later) = rest.split_at(fitting.count().max(1));
        rows.push(row);
        rest = later;
    }
    rows
}

fn swatch(svg: &mut Svg, (x, y): (f64, f64), swatch: &Swatch) {
    match swatch {
        Swatch::Area(paint) => svg.rect([x, y - 8.0, 24.0, 16.0], paint),
        Swatch::Line(paint) => svg.path(&format!("M{} {}h24", number(x), number(y)), paint),
        Swatch::Mark(path, paint) => svg.line(&format!(
            "  <path transform=\"translate({} {})\" d=\"{path}\" {paint}/>",
            number(x + 12.0),
            number(y)
        )),
    }
}

/// A text of at most so many letters.
fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let kept: String = text.chars().take(most.saturating_sub(1)).collect();
    format!("{}\u{2026}", kept.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legends_are_broken_where_they_are_full() {
        let entry = |letters: usize| Entry::area("", "x".repeat(letters));
        let legend = [entry(20), entry(30), entry(30), entry(200), entry(1)];
        let counts: Vec<usize> = rows(&legend, 24.0, WIDTH).iter().map(|row| row.len()).collect();
        assert_eq!(counts, [2, 1, 1, 1]);
    }

    #[test]
    fn long_titles_end_in_dots() {
        assert_eq!(shortened("honeycomb", 9), "honeycomb");
        assert_eq!(shortened("a honeycomb", 3), "a\u{2026}");
    }
}
