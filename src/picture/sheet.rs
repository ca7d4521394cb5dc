//! What pictures have around their plot: headings above, a legend below.
//!
//! A sheet that stands alone is as wide as a page and a phone allow: letters of 15 in a width of 680 can still be read on a
//! screen of a third that is held close. In a page it is as wide as the page, with letters as large as the page's, and drawn once
//! more for telephones; the page has its words. Colours are those that people who do not tell red from green tell apart [Okabe 2008], and marks
//! differ in shape too.

use super::svg::{Anchor, Mark, Svg, head};
use super::{Point, Prefix, Setting};

/// Width of a sheet that stands alone.
pub(super) const WIDTH: f64 = 680.0;
/// Width of a picture in a page, in CSS pixels: its letters are as large as the page's.
pub const PAGE_WIDTH: f64 = 1160.0;
/// Width of a picture in a page on a telephone, in CSS pixels.
pub const PHONE_WIDTH: f64 = 400.0;
/// Size of letters.
pub(super) const FONT: u32 = 15;
/// Room to the right of a plot.
pub(super) const MARGIN: f64 = 44.0;

/// The room that a sheet has for its plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Room {
    /// Width of the sheet.
    pub(super) width: f64,
    /// Left edge of words below and above the plot.
    pub(super) indent: f64,
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
        let (width, indent, left, top) = match ids.setting {
            Setting::Alone => (WIDTH, 24.0, 66.0, 92.0),
            Setting::Page => (PAGE_WIDTH, 24.0, 66.0, 22.0),
            Setting::Phone => (PHONE_WIDTH, 8.0, 54.0, 22.0),
        };
        Self {
            width,
            indent,
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

    /// With as much room to the left as a value of the left axis needs beside the label of that axis.
    pub(super) fn beside(self, value: f64) -> Self {
        let value = text_width(&format!("{value:.0}"));
        Self {
            left: self.left.max(BESIDE + value),
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

/// Room for the label of the left axis, and between it, the values and their axis.
const BESIDE: f64 = 36.0;

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

impl<'a> Heading<'a> {
    /// For a picture that stands alone.
    pub(super) const fn alone(title: &'a str, subtitle: &'a str) -> Self {
        Self {
            ids: Prefix::NONE,
            title,
            subtitle,
        }
    }
}

/// Draws what an entry looks like, within 24 by 16 to the right of a point and around its height.
type Swatch = Box<dyn Fn(&mut Svg, Point)>;

/// An entry of a legend.
pub(super) struct Entry {
    swatch: Swatch,
    /// What it means.
    words: String,
}

impl Entry {
    pub(super) fn new(words: impl Into<String>, swatch: impl Fn(&mut Svg, Point) + 'static) -> Self {
        Self {
            swatch: Box::new(swatch),
            words: words.into(),
        }
    }

    pub(super) fn area(paint: impl Into<String>, words: impl Into<String>) -> Self {
        let paint = paint.into();
        Self::new(words, move |svg, [x, y]| {
            svg.rect([x, y - 8.0, 24.0, 16.0], &paint)
        })
    }

    pub(super) fn line(paint: impl Into<String>, words: impl Into<String>) -> Self {
        let paint = paint.into();
        Self::new(words, move |svg, [x, y]| {
            svg.open([[x, y], [x + 24.0, y]], &paint)
        })
    }

    /// The head of an arrow that leads to the right.
    pub(super) fn head(paint: impl Into<String>, words: impl Into<String>) -> Self {
        let paint = paint.into();
        Self::new(words, move |svg, [x, y]| {
            svg.closed(head([[x, y], [x + 18.0, y]]), &paint);
        })
    }

    pub(super) fn mark(mark: Mark, words: impl Into<String>) -> Self {
        Self::new(words, move |svg, [x, y]| svg.mark([x + 12.0, y], mark))
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
    let rows = rows(legend, room.indent, room.width);
    let height = bottom + 18.0 + rows.len() as f64 * ROW;
    let size = [room.width, height];
    let mut svg = Svg::new(size, FONT, heading.ids, heading.title, description);
    words(&mut svg, heading);
    for (row, entries) in rows.iter().enumerate() {
        let y = bottom + ROW * (row as f64 + 0.5);
        let mut x = room.indent;
        for entry in *entries {
            (entry.swatch)(&mut svg, [x, y]);
            svg.text([x + 34.0, y + 5.0], Anchor::Start, "", &entry.words);
            x += entry.width();
        }
    }
    svg
}

/// Title and subtitle of a picture that stands alone.
pub(super) fn words(svg: &mut Svg, heading: Heading<'_>) {
    match heading.ids.setting {
        Setting::Alone => {
            let (title, subtitle) = (shortened(heading.title, 56), shortened(heading.subtitle, 76));
            let bold = "font-size=\"18\" font-weight=\"bold\"";
            svg.text([24.0, 32.0], Anchor::Start, bold, &title);
            svg.text([24.0, 56.0], Anchor::Start, "font-size=\"14\"", &subtitle);
        }
        Setting::Page | Setting::Phone => {}
    }
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
