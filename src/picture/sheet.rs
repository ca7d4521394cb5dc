//! What pictures have around their plot: headings above, a legend below.
//!
//! Sheets are as wide as a page and a phone allow: letters of 15 in a width of 680 can still be read on a screen of a third
//! that is held close. Colours are those that people who do not tell red from green tell apart [Okabe, Ito 2008], and marks
//! differ in shape too.

use super::Prefix;
use super::svg::{Anchor, Svg, number};

/// Width of a sheet.
pub(super) const WIDTH: f64 = 680.0;
/// Size of letters.
pub(super) const FONT: u32 = 15;
/// Left edge of what is plotted.
pub(super) const LEFT: f64 = 66.0;
/// Right edge of what is plotted.
pub(super) const RIGHT: f64 = 636.0;
/// Upper edge of what is plotted.
pub(super) const TOP: f64 = 82.0;

/// The colour of letters and axes.
pub(super) const INK: &str = "#2b2a27";
/// Blue.
pub(super) const BLUE: &str = "#0072b2";
/// Vermilion.
pub(super) const VERMILION: &str = "#d55e00";
/// Green.
pub(super) const GREEN: &str = "#009e73";
/// Orange.
pub(super) const ORANGE: &str = "#e69f00";
/// Sky blue.
pub(super) const SKY: &str = "#56b4e9";
/// Purple.
pub(super) const PURPLE: &str = "#cc79a7";

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
    /// What it looks like.
    pub(super) swatch: Swatch,
    /// What it means.
    pub(super) words: String,
}

/// What an entry of a legend looks like; attributes of SVG.
pub(super) enum Swatch {
    /// An area.
    Area(String),
    /// A line.
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
        34.0 + text_width(&self.words) + 22.0
    }
}

/// About how wide a text is, in the usual letters.
pub(super) fn text_width(text: &str) -> f64 {
    text.chars().count() as f64 * f64::from(FONT) * 0.57
}

/// Distance of rows in a legend.
const ROW: f64 = 26.0;

/// Begins a sheet: its plot ends at `bottom`, and the legend stands below.
pub(super) fn sheet(heading: Heading<'_>, description: &str, bottom: f64, legend: &[Entry]) -> Svg {
    let rows = rows(legend);
    let height = bottom + 18.0 + rows.len() as f64 * ROW;
    let mut svg = Svg::new([WIDTH, height], FONT, heading.ids, heading.title, description);
    let title = shortened(heading.title, 56);
    svg.text(
        (24.0, 32.0),
        Anchor::Start,
        "font-size=\"18\" font-weight=\"bold\"",
        &title,
    );
    svg.text(
        (24.0, 56.0),
        Anchor::Start,
        "font-size=\"14\"",
        &shortened(heading.subtitle, 76),
    );
    for (row, entries) in rows.iter().enumerate() {
        let y = bottom + ROW * (row as f64 + 0.5);
        let mut x = 24.0;
        for entry in *entries {
            swatch(&mut svg, (x, y), &entry.swatch);
            svg.text((x + 34.0, y + 5.0), Anchor::Start, "", &entry.words);
            x += entry.width();
        }
    }
    svg
}

/// Entries in rows that fit.
fn rows(legend: &[Entry]) -> Vec<&[Entry]> {
    let mut rows = Vec::new();
    let mut rest = legend;
    while !rest.is_empty() {
        let mut x = 24.0;
        let fitting = rest.iter().take_while(|entry| {
            x += entry.width();
            x <= WIDTH
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
        let counts: Vec<usize> = rows(&legend).iter().map(|row| row.len()).collect();
        assert_eq!(counts, [2, 1, 1, 1]);
    }

    #[test]
    fn long_titles_end_in_dots() {
        assert_eq!(shortened("honeycomb", 9), "honeycomb");
        assert_eq!(shortened("a honeycomb", 3), "a\u{2026}");
    }
}
