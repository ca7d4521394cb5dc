//! The lattice: where the tips of all cuts lie, how they came to be there, and the flanks that rise from them.

use super::Point;
use super::band::MANY;
use super::chart::FRAME;
use super::palette::{BLUE, EDGE, GREEN, ORANGE, PURPLE, SHADES, VERMILION};
use super::section::{BELOW, Section};
use super::sheet::{self, Entry};
use super::strips::Strips;
use super::svg::{Anchor, Svg};
use super::trace::Trace;
use std::collections::BTreeSet;
use vcutc_backend_api::words::counted;

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
    /// The Vs: where the left flank comes out, the tip, where the right one does. From a hundred on they are not drawn one by
    /// one.
    pub vees: &'a [[[f64; 2]; 3]],
    /// Slits and strips, of which the tips say how they came to be there only. They count as the Vs do.
    pub strips: Strips<'a>,
    /// The surface when each layer is cut, in their order, from left to right: what is drawn of many cuts.
    pub surfaces: &'a [Vec<[f64; 2]>],
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
    /// Where a disc stands on the part.
    Track,
}

/// More tips than can be told apart: those that fall onto one spot are drawn once.
const CROWDED: usize = 20_000;

const ORIGINS: [Origin; 5] = [
    Origin::Lattice,
    Origin::Lifted,
    Origin::Shifted,
    Origin::Relieved,
    Origin::Track,
];

impl Origin {
    const fn words(self) -> &'static str {
        match self {
            Self::Lattice => "on the lattice",
            Self::Lifted => "lifted",
            Self::Shifted => "shifted",
            Self::Relieved => "relieved",
            Self::Track => "tracks of a disc",
        }
    }

    const fn colour(self) -> &'static str {
        match self {
            Self::Lattice => BLUE,
            Self::Lifted => VERMILION,
            Self::Shifted => GREEN,
            Self::Relieved => PURPLE,
            Self::Track => ORANGE,
        }
    }

    /// How many of them there are.
    fn count(self, lattice: &Lattice<'_>) -> usize {
        lattice.tips.iter().filter(|tip| tip.origin == self).count()
    }

    /// Its mark, so large: a disc, a triangle, a square standing on a corner, a square, a triangle that points down.
    fn mark(self, trace: &mut Trace, [x, y]: Point, r: f64) {
        match self {
            Self::Lattice => trace.dot([x, y]),
            Self::Lifted => trace.closed([[x - r, y + r * 0.8], [x, y - r], [x + r, y + r * 0.8]]),
            Self::Shifted => trace.closed([[x - r, y], [x, y - r], [x + r, y], [x, y + r]]),
            Self::Relieved => {
                let r = r * 0.8;
                trace.closed([[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r]]);
            }
            Self::Track => trace.closed([[x - r, y - r * 0.8], [x, y + r], [x + r, y - r * 0.8]]),
        }
    }

    fn paint(self, r: f64) -> String {
        let colour = self.colour();
        match self {
            Self::Lattice => format!(
                "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{:.2}\" stroke-linecap=\"round\"",
                r * 1.7
            ),
            Self::Lifted | Self::Shifted | Self::Relieved | Self::Track => format!("fill=\"{colour}\""),
        }
    }
}

/// Writes the picture as SVG.
#[must_use]
pub fn draw(lattice: &Lattice<'_>) -> String {
    let section = Section::of(lattice.stock, lattice.heading.ids);
    let bottom = section.bottom + BELOW;
    let (description, legend) = (description(lattice), legend(lattice));
    let mut svg = sheet::sheet(lattice.heading, section.room, &description, bottom, &legend);
    if lattice.is_many() {
        surfaces(&mut svg, lattice.surfaces, &section);
        section.below(&mut svg, lattice.part, PART);
    } else {
        section.stock(&mut svg, STAYS);
        lattice.strips.rectangles(&mut svg, &section);
        section.below(&mut svg, lattice.part, PART);
        let vees = lattice.vees.iter().map(|vee| vee.map(|point| section.at(point)));
        let width = (fineness(lattice, &section) * 0.28).max(0.2);
        let paint =
            format!("fill=\"none\" stroke=\"{VEE}\" stroke-width=\"{width:.2}\" stroke-linejoin=\"round\"");
        svg.path(Trace::pieces(vees).text(), &paint);
    }
    for bound in lattice.bounds {
        svg.open(section.curve(bound), BOUND);
    }
    section.stock(&mut svg, FRAME);
    lattice.strips.slits(&mut svg, &section);
    if !lattice.is_many() {
        lattice.strips.discs(&mut svg, &section);
        lattice.strips.numbers(&mut svg, &section);
    }
    tips(&mut svg, lattice, &section);
    layers(&mut svg, lattice, &section);
    section.axes(&mut svg);
    svg.finish()
}

pub(super) const PART: &str = "fill=\"#b7c6d3\" stroke=\"#3d5a73\" stroke-width=\"1.5\"";
const BOUND: &str = "fill=\"none\" stroke=\"#3d5a73\" stroke-dasharray=\"5 4\"";
const STAYS: &str = "fill=\"#f6f1e2\"";
const VEE: &str = "#9c8a5c";

fn description(lattice: &Lattice<'_>) -> String {
    let what = match lattice.strips.words() {
        Some(words) => {
            let others = lattice.tips.len().saturating_sub(lattice.strips.strips.len());
            match others {
                0 => format!("with {words}"),
                others => format!("with {words}, and the tips of {},", counted(others, "cut")),
            }
        }
        None => format!("with the tips of {}", counted(lattice.tips.len(), "cut")),
    };
    let counts: Vec<String> = origins(lattice).map(|(_, words)| words).collect();
    format!(
        "{}. Section of a stock {:.1} mm wide and {:.1} mm high {what} in {} above the part: {}.",
        lattice.heading.subtitle,
        lattice.stock[0],
        lattice.stock[1],
        counted(lattice.layers.len(), "layer"),
        counts.join(", ")
    )
}

/// The origins that tips have, with their numbers.
fn origins(lattice: &Lattice<'_>) -> impl Iterator<Item = (Origin, String)> {
    let counted = ORIGINS.into_iter().map(|origin| (origin, origin.count(lattice)));
    let had = counted.filter(|(_, count)| *count > 0);
    had.map(|(origin, count)| (origin, format!("{count} {}", origin.words())))
}

fn legend(lattice: &Lattice<'_>) -> Vec<Entry> {
    let mark = |(origin, words): (Origin, String)| {
        Entry::new(words, move |svg, [x, y]| {
            let mut trace = Trace::default();
            origin.mark(&mut trace, [x + 12.0, y], 5.0);
            svg.path(trace.text(), &origin.paint(5.0));
        })
    };
    let mut legend = lattice.strips.legend(lattice.is_many());
    legend.extend(origins(lattice).map(mark));
    if lattice.is_many() {
        legend.extend([shades(), Entry::area(STAYS, "stays")]);
    } else if !lattice.vees.is_empty() || lattice.strips == Strips::default() {
        let line = format!("stroke=\"{VEE}\" stroke-width=\"1.5\"");
        legend.push(Entry::line(line, "flanks, as far as they cut"));
    }
    legend.push(Entry::area(PART, "part"));
    if !lattice.bounds.is_empty() {
        legend.push(Entry::line(BOUND, "part with allowance"));
    }
    legend
}

impl Lattice<'_> {
    /// Whether chips are not drawn one by one.
    fn is_many(&self) -> bool {
        is_many(self.vees.len() + self.strips.strips.len())
    }
}

/// Whether so many cuts are drawn together, layer by layer.
pub(super) const fn is_many(cuts: usize) -> bool {
    cuts >= MANY
}

/// Layers in a legend.
pub(super) fn shades() -> Entry {
    let paint = format!("fill=\"{}\" stroke=\"{EDGE}\"", SHADES[1]);
    Entry::area(paint, "taken, layer by layer in two shades")
}

/// What each layer takes: the area above its surface, the later ones over the earlier ones; and what stays below the last.
pub(super) fn surfaces(svg: &mut Svg, surfaces: &[Vec<Point>], section: &Section) {
    section.stock(svg, &format!("fill=\"{}\"", SHADES[0]));
    let later = surfaces.iter().zip(surfaces.iter().skip(1));
    for ((before, _), shade) in later.zip(SHADES.iter().cycle().skip(1)) {
        let paint = format!("fill=\"{shade}\" stroke=\"{EDGE}\" stroke-width=\"0.3\"");
        section.below(svg, before, &paint);
    }
    if let Some(last) = surfaces.last() {
        section.below(svg, last, STAYS);
    }
}

/// Lines and marks become finer where there are many; where they are drawn together, they do not touch.
fn fineness(lattice: &Lattice<'_>, section: &Section) -> f64 {
    let (width, tips) = (section.x.length(), lattice.tips.len().max(1) as f64);
    if lattice.is_many() {
        let each = width * lattice.layers.len().max(1) as f64 / tips;
        (each * 0.3).clamp(0.35, 3.0)
    } else {
        let each = (width * section.z.length() / tips).sqrt();
        (each / 6.0).clamp(0.4, 4.2)
    }
}

/// Tips of each origin are one path. Where there are more than can be told apart, those that fall onto one spot are one.
fn tips(svg: &mut Svg, lattice: &Lattice<'_>, section: &Section) {
    let crowded = lattice.tips.len() > CROWDED;
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
        svg.path(trace.text(), &origin.paint(r));
    }
}

/// Distance of names of layers.
const NAMES: f64 = 16.0;

/// Names of layers at the right side, each with a line to its height. Where there are more than there is room for, every
/// second, fifth, tenth ... is named, and the last.
fn layers(svg: &mut Svg, lattice: &Lattice<'_>, section: &Section) {
    let room = ((section.bottom - section.room.top + BELOW / 2.0) / NAMES).max(2.0) as usize;
    let count = lattice.layers.len();
    let every = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]
        .into_iter()
        .find(|every| count / every + 1 < room || count <= room && *every == 1)
        .unwrap_or(1000);
    let is_named = |number: usize| number == 1 || number == count || number.is_multiple_of(every);
    let mut names: Vec<(&str, f64)> = (1..)
        .zip(lattice.layers)
        .filter(|(number, _)| is_named(*number))
        .map(|(_, (name, z))| (name.as_str(), section.z.at(*z)))
        .collect();
    names.sort_by(|a, b| a.1.total_cmp(&b.1));
    let right = section.x.places[1];
    let mut lines = Trace::default();
    for ((name, y), place) in names.iter().zip(apart(&names, section.bottom + BELOW / 2.0)) {
        let [near, far] = [[right + 5.0, *y], [right + 13.0, place]];
        lines.open([[right, *y], near, far, [right + 15.0, place]]);
        svg.text([right + 17.0, place + 5.0], Anchor::Start, "", name);
    }
    svg.path(lines.text(), &format!("fill=\"none\" stroke=\"{VEE}\""));
}

/// Places for names as near to where they belong as they can be without touching, none below an end.
fn apart(names: &[(&str, f64)], end: f64) -> Vec<f64> {
    let mut places: Vec<f64> = Vec::with_capacity(names.len());
    for (_, y) in names {
        let free = places.last().map_or(f64::NEG_INFINITY, |place| place + NAMES);
        places.push(y.max(free));
    }
    let mut most = end;
    for place in places.iter_mut().rev() {
        *place = place.min(most);
        most = *place - NAMES;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_distance_and_their_order() {
        let names = [("1", 10.0), ("2", 12.0), ("3", 13.0), ("4", 100.0), ("5", 101.0)];
        assert_eq!(apart(&names, 110.0), [10.0, 26.0, 42.0, 94.0, 110.0]);
        assert_eq!(apart(&names, 500.0), [10.0, 26.0, 42.0, 100.0, 116.0]);
    }
}
