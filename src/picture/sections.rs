//! Sections of a part that changes along y, drawn over each other: the part at each y, with what finishing leaves there, and the
//! contour of roughing, which is the same at every y or another one at each.
//!
//! One section is shown. Those of the others are in the picture, too, not shown, each with its number as `data-section` and its y as
//! `data-y`: a page shows the one that its slider points at.

use super::chart::FRAME;
use super::lattice::PART;
use super::palette::{BLUE, INK, ORANGE};
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
    /// What roughing leaves.
    pub roughed: Roughed<'a>,
    /// What is seen at each y, by growing y.
    pub sections: &'a [Shown],
    /// Which of them is shown, counted from 0.
    pub shown: usize,
}

/// What roughing leaves, from left to right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roughed<'a> {
    /// The same at every y.
    Alike {
        /// The machined contour.
        machined: &'a [[f64; 2]],
        /// The part's shadow along y.
        shadow: &'a [[f64; 2]],
    },
    /// A machined contour for each section.
    Own(&'a [Vec<[f64; 2]>]),
}

/// What is seen at a y, from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    pub y: f64,
    pub part: Vec<[f64; 2]>,
    /// The contour that finishing leaves; empty where nothing is finished.
    pub finished: Vec<[f64; 2]>,
}

const CONTOUR: &str = "stroke-width=\"1.6\" stroke-linejoin=\"round\"";
const SHADOW: &str = "stroke-width=\"1.2\" stroke-dasharray=\"6 4\"";

impl Sections<'_> {
    /// Whether a disc has finished the part.
    fn is_finished(&self) -> bool {
        self.sections.iter().any(|seen| !seen.finished.is_empty())
    }
}

/// Writes the picture as SVG.
#[must_use]
pub fn draw(sections: &Sections<'_>) -> String {
    let section = Section::of(sections.stock, sections.heading.ids);
    let bottom = section.bottom + BELOW;
    let (description, legend) = (description(sections), legend(sections));
    let mut svg = sheet::sheet(sections.heading, section.room, &description, bottom, &legend);
    let left = format!("fill=\"{ORANGE}\"");
    let line = |paint: &str| format!("fill=\"none\" stroke=\"{INK}\" {paint}");
    if let Roughed::Alike { machined, .. } = sections.roughed {
        section.below(&mut svg, machined, &left);
    }
    for (number, seen) in sections.sections.iter().enumerate() {
        let hidden = if number == sections.shown {
            ""
        } else {
            " display=\"none\""
        };
        let at = format!(
            "data-section=\"{number}\" data-y=\"{}\"{hidden}",
            self::number(seen.y)
        );
        let own = match sections.roughed {
            Roughed::Alike { .. } => None,
            Roughed::Own(contours) => contours.get(number),
        };
        if let Some(contour) = own {
            section.below(&mut svg, contour, &format!("{left} {at}"));
        }
        at_y(&mut svg, &section, seen, &at);
        if let Some(contour) = own {
            svg.open(section.curve(contour), &line(&format!("{CONTOUR} {at}")));
        }
    }
    if let Roughed::Alike { machined, shadow } = sections.roughed {
        svg.open(section.curve(shadow), &line(SHADOW));
        svg.open(section.curve(machined), &line(CONTOUR));
    }
    section.stock(&mut svg, FRAME);
    section.axes(&mut svg);
    svg.finish()
}

/// The part at a y, with what finishing leaves. Of many sections only as many points are kept as a screen shows.
fn at_y(svg: &mut Svg, section: &Section, seen: &Shown, at: &str) {
    let curve = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let thinned = Thinned::of(points, section.room.columns());
        thinned.into_iter().map(|point| section.at(point)).collect()
    };
    let part = curve(&seen.part);
    let ends = [part.last(), part.first()].map(|end| end.map(|end| [end[0], section.bottom]));
    let outline = Trace::around(part.iter().copied().chain(ends.into_iter().flatten()));
    svg.path(outline.text(), &format!("{PART} {at}"));
    if !seen.finished.is_empty() {
        svg.open(
            curve(&seen.finished),
            &format!("fill=\"none\" stroke=\"{BLUE}\" {CONTOUR} {at}"),
        );
    }
}

fn description(sections: &Sections<'_>) -> String {
    let [width, height] = sections.stock;
    let y = sections.sections.get(sections.shown).map_or(0.0, |seen| seen.y);
    let contours = if sections.is_finished() {
        "contours after roughing and after finishing"
    } else {
        "machined contour"
    };
    let shadow = match sections.roughed {
        Roughed::Alike { .. } => ", its shadow along y",
        Roughed::Own(_) => "",
    };
    format!(
        "{}. Section at y {} mm of a stock {width:.1} mm wide and {height:.1} mm high with the part{shadow} and the {contours}.",
        sections.heading.subtitle,
        number(y)
    )
}

fn legend(sections: &Sections<'_>) -> Vec<Entry> {
    let is_finished = sections.is_finished();
    let line = |colour: &str, paint: &str| format!("stroke=\"{colour}\" {paint}");
    let (stays, contour) = match (sections.roughed, is_finished) {
        (Roughed::Alike { .. }, true) => ("left by roughing", "contour after roughing, at every y"),
        (Roughed::Alike { .. }, false) => ("stays above it", "machined contour, at every y"),
        (Roughed::Own(_), true) => ("left by roughing", "contour after roughing, at this y"),
        (Roughed::Own(_), false) => ("stays above it", "machined contour, at this y"),
    };
    let mut legend = vec![
        Entry::area(PART, "part at this y"),
        Entry::area(format!("fill=\"{ORANGE}\""), stays),
        Entry::line(line(INK, CONTOUR), contour),
    ];
    if is_finished {
        legend.push(Entry::line(
            line(BLUE, CONTOUR),
            "contour after finishing, at this y",
        ));
    }
    if let Roughed::Alike { .. } = sections.roughed {
        legend.push(Entry::line(line(INK, SHADOW), "shadow of the part"));
    }
    legend
}
