//! Sections of a part that changes along y, one above the other: the part at each y, and the machined contour, which is the same at all.
//!
//! One section is shown. Those of the others are in the picture, too, not shown, each with its y as `data-y`: a page shows the one that
//! its slider points at.

use super::chart::FRAME;
use super::lattice::PART;
use super::palette::{INK, ORANGE};
use super::section::{BELOW, Section};
use super::sheet::{self, Entry};
use super::svg::Svg;
use super::thin::Thinned;
use super::trace::{Trace, number};

pub use super::sheet::Heading;

/// What the picture shows. Lengths are in mm, points are x and z.
#[derive(Clone, Debug, PartialEq)]
pub struct Sections<'a> {
    pub heading: Heading<'a>,
    /// Width and height of the stock.
    pub stock: [f64; 2],
    /// The machined contour, from left to right.
    pub machined: &'a [[f64; 2]],
    /// The part's shadow along y, from left to right.
    pub shadow: &'a [[f64; 2]],
    /// The part at each y, by growing y.
    pub parts: &'a [(f64, Vec<[f64; 2]>)],
    /// Which of them is shown, counted from 0.
    pub shown: usize,
}

const CONTOUR: &str = "stroke-width=\"1.6\" stroke-linejoin=\"round\"";
const SHADOW: &str = "stroke-width=\"1.2\" stroke-dasharray=\"6 4\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(sections: &Sections<'_>) -> String {
    let section = Section::of(sections.stock, sections.heading.ids);
    let bottom = section.bottom + BELOW;
    let (description, legend) = (description(sections), legend());
    let mut svg = sheet::sheet(sections.heading, section.room, &description, bottom, &legend);
    section.below(&mut svg, sections.machined, &format!("fill=\"{ORANGE}\""));
    for (number, (y, part)) in sections.parts.iter().enumerate() {
        let hidden = if number == sections.shown {
            ""
        } else {
            " display=\"none\""
        };
        at_y(&mut svg, &section, (*y, part), hidden);
    }
    let line = |paint: &str| format!("fill=\"none\" stroke=\"{INK}\" {paint}");
    svg.open(section.curve(sections.shadow), &line(SHADOW));
    svg.open(section.curve(sections.machined), &line(CONTOUR));
    section.stock(&mut svg, FRAME);
    section.axes(&mut svg);
    svg.finish()
}

/// The part at a y. Of many sections only as many points are kept as a screen shows.
fn at_y(svg: &mut Svg, section: &Section, (y, part): (f64, &[[f64; 2]]), hidden: &str) {
    let thinned = Thinned::of(part, section.room.columns());
    let curve: Vec<[f64; 2]> = thinned.into_iter().map(|point| section.at(point)).collect();
    let ends = [curve.last(), curve.first()].map(|end| end.map(|end| [end[0], section.bottom]));
    let outline = Trace::around(curve.iter().copied().chain(ends.into_iter().flatten()));
    let data = format!("{PART} data-y=\"{}\"{hidden}", number(y));
    svg.path(outline.text(), &data);
}

fn description(sections: &Sections<'_>) -> String {
    let [width, height] = sections.stock;
    let y = sections.parts.get(sections.shown).map_or(0.0, |(y, _)| *y);
    format!(
        "{}. Section at y {} mm of a stock {width:.1} mm wide and {height:.1} mm high with the part, its shadow along y and the \
         machined contour.",
        sections.heading.subtitle,
        number(y)
    )
}

fn legend() -> Vec<Entry> {
    let line = |paint: &str| format!("stroke=\"{INK}\" {paint}");
    vec![
        Entry::area(PART, "part at this y"),
        Entry::area(format!("fill=\"{ORANGE}\""), "stays above it"),
        Entry::line(line(CONTOUR), "machined contour, at every y"),
        Entry::line(line(SHADOW), "shadow of the part"),
    ]
}
