//! The lattice: where the tips of all cuts lie, how they came to be there, and the flanks that rise from them.

use super::section::{BELOW, Section};
use super::sheet::{self, BLUE, Entry, GREEN, INK, PURPLE, Swatch, VERMILION};
use super::svg::{Anchor, Svg};
use super::trace::Trace;
use std::collections::BTreeSet;

pub use super::sheet::Heading;

/// What a picture of a lattice shows. Lengths are in mm, points are x and z.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// Width and height of the stock.
    pub stock: [f64; 2],
    /// The part's profile, from left to right.
    pub part: &'a [[f64; 2]],
    /// The part with the allowance of each operation that has one.
    pub bounds: &'a [&'a [[f64; 2]]],
    /// The tips.
    pub tips: &'a [Tip],
    /// The Vs: where the left flank comes out, the tip, where the right one does. None are drawn when there are more than
    /// [`MOST_DRAWN`].
    pub vees: &'a [[[f64; 2]; 3]],
    /// The layers from the top: what they are called, and the height of their tips.
    pub layers: &'a [(String, f64)],
}

/// A tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    /// Where.
    pub at: [f64; 2],
    /// How it came to be there.
    pub origin: Origin,
}

/// How a tip came to be where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A point of the lattice.
    Lattice,
    /// Raised to clear the part.
    Lifted,
    /// Moved sideways to clear the part.
    Shifted,
    /// Raised because the blade does not reach the full depth at once.
    Relieved,
}

/// Most Vs, or chips, that are drawn one by one.
pub const MOST_DRAWN: usize = 20_000;

const ORIGINS: [Origin; 4] = [Origin::Lattice, Origin::Lifted, Origin::Shifted, Origin::Relieved];

impl Origin {
    const fn words(self) -> &'static str {
        match self {
            Self::Lattice => "on the lattice",
            Self::Lifted => "lifted",
            Self::Shifted => "shifted",
            Self::Relieved => "relieved",
        }
    }

    const fn colour(self) -> &'static str {
        match self {
            Self::Lattice => BLUE,
            Self::Lifted => VERMILION,
            Self::Shifted => GREEN,
            Self::Relieved => PURPLE,
        }
    }

    /// Its mark, so large: a disc, a triangle, a square standing on a corner, a square.
    fn mark(self, trace: &mut Trace, [x, y]: [f64; 2], r: f64) {
        match self {
            Self::Lattice => trace.dot([x, y]),
            Self::Lifted => trace.closed([[x - r, y + r * 0.8], [x, y - r], [x + r, y + r * 0.8]]),
            Self::Shifted => trace.closed([[x - r, y], [x, y - r], [x + r, y], [x, y + r]]),
            Self::Relieved => {
                let r = r * 0.8;
                trace.closed([[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r]]);
            }
        }
    }

    fn paint(self, r: f64) -> String {
        let colour = self.colour();
        match self {
            Self::Lattice => format!(
                "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{:.2}\" stroke-linecap=\"round\"",
                r * 1.7
            ),
            Self::Lifted | Self::Shifted | Self::Relieved => format!("fill=\"{colour}\""),
        }
    }
}

/// Writes the picture as SVG.
#[must_use]
pub fn draw(lattice: &Lattice<'_>) -> String {
    let section = Section::of(lattice.stock);
    let legend = legend(lattice);
    let mut svg = sheet::sheet(
        lattice.heading,
        &description(lattice),
        section.bottom + BELOW,
        &legend,
    );
    section.stock(&mut svg, "fill=\"#f6f1e2\"");
    svg.path(section.below(lattice.part).text(), PART);
    vees(&mut svg, lattice, &section);
    for bound in lattice.bounds {
        svg.path(Trace::through(section.curve(bound)).text(), BOUND);
    }
    section.stock(&mut svg, &format!("fill=\"none\" stroke=\"{INK}\""));
    tips(&mut svg, lattice, &section);
    layers(&mut svg, lattice, &section);
    section.axes(&mut svg);
    svg.finish()
}

pub(super) const PART: &str = "fill=\"#b7c6d3\" stroke=\"#3d5a73\" stroke-width=\"1.5\"";
const BOUND: &str = "fill=\"none\" stroke=\"#3d5a73\" stroke-dasharray=\"5 4\"";
const VEE: &str = "#9c8a5c";

fn description(lattice: &Lattice<'_>) -> String {
    let counts = ORIGINS.map(|origin| (count(lattice, origin), origin.words()));
    let counts: Vec<String> = counts
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, words)| format!("{count} {words}"))
        .collect();
    format!(
        "{}. Section of a stock {:.1} mm wide and {:.1} mm high with the tips of {} {} in {} {} above the part: {}.",
        lattice.heading.subtitle,
        lattice.stock[0],
        lattice.stock[1],
        lattice.tips.len(),
        if lattice.tips.len() == 1 { "cut" } else { "cuts" },
        lattice.layers.len(),
        if lattice.layers.len() == 1 {
            "layer"
        } else {
            "layers"
        },
        counts.join(", ")
    )
}

fn count(lattice: &Lattice<'_>, origin: Origin) -> usize {
    lattice.tips.iter().filter(|tip| tip.origin == origin).count()
}

fn legend(lattice: &Lattice<'_>) -> Vec<Entry> {
    let mut legend = Vec::new();
    for origin in ORIGINS {
        let count = count(lattice, origin);
        if count > 0 {
            let mut mark = Trace::default();
            origin.mark(&mut mark, [0.0, 0.0], 5.0);
            legend.push(Entry {
                swatch: Swatch::Mark(mark.text().to_owned(), origin.paint(5.0)),
                words: format!("{count} {}", origin.words()),
            });
        }
    }
    if lattice.vees.len() <= MOST_DRAWN {
        legend.push(Entry::line(
            format!("stroke=\"{VEE}\" stroke-width=\"1.5\""),
            "flanks, as far as they cut",
        ));
    } else {
        legend.push(Entry::area(
            "fill=\"none\"",
            format!("more than {MOST_DRAWN} cuts: flanks are not drawn"),
        ));
    }
    legend.push(Entry::area(PART, "part"));
    if !lattice.bounds.is_empty() {
        legend.push(Entry::line(BOUND, "part with allowance"));
    }
    legend
}

/// Lines and marks become finer where there are many.
fn fineness(lattice: &Lattice<'_>, section: &Section) -> f64 {
    let area = (section.x.places[1] - section.x.places[0]) * (section.z.places[0] - section.z.places[1]);
    let each = (area / (lattice.tips.len().max(1) as f64)).sqrt();
    (each / 6.0).clamp(0.4, 4.2)
}

fn vees(svg: &mut Svg, lattice: &Lattice<'_>, section: &Section) {
    if lattice.vees.len() > MOST_DRAWN {
        return;
    }
    let mut trace = Trace::default();
    for vee in lattice.vees {
        trace.open(vee.map(|point| section.at(point)));
    }
    let width = (fineness(lattice, section) * 0.28).max(0.2);
    svg.path(
        trace.text(),
        &format!("fill=\"none\" stroke=\"{VEE}\" stroke-width=\"{width:.2}\" stroke-linejoin=\"round\""),
    );
}

/// Tips of each origin are one path. Where there are more than can be told apart, those that fall onto one spot are one.
fn tips(svg: &mut Svg, lattice: &Lattice<'_>, section: &Section) {
    let crowded = lattice.tips.len() > MOST_DRAWN;
    let r = fineness(lattice, section);
    for origin in ORIGINS {
        let mut trace = Trace::default();
        let mut taken = BTreeSet::new();
        for tip in lattice.tips.iter().filter(|tip| tip.origin == origin) {
            let at = section.at(tip.at);
            let spot = at.map(|place| (place / 2.0) as i32);
            if !crowded || taken.insert(spot) {
                origin.mark(&mut trace, at, r);
            }
        }
        if !trace.is_empty() {
            svg.path(trace.text(), &origin.paint(r));
        }
    }
}

/// Names of layers at the right side, as many as there is room for.
fn layers(svg: &mut Svg, lattice: &Lattice<'_>, section: &Section) {
    let mut free_from = f64::NEG_INFINITY;
    for (name, z) in lattice.layers {
        let y = section.z.at(*z);
        if y >= free_from {
            svg.text((section.x.places[1] + 8.0, y + 5.0), Anchor::Start, "", name);
            free_from = y + 17.0;
        }
    }
}
