//! The lattice: where the tips of all cuts lie, how they came to be there, and the flanks that rise from them.

use super::band::MANY;
use super::palette::{BLUE, GREEN, INK, PURPLE, VERMILION};
use super::section::{BELOW, Section};
use super::sheet::{self, Entry, Swatch};
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
    pub tips: &'a [Tip],
    /// The Vs: where the left flank comes out, the tip, where the right one does. From a hundred on they are not drawn one by
    /// one.
    pub vees: &'a [[[f64; 2]; 3]],
    /// The surface when each layer is cut, in their order: what is drawn of many cuts.
    pub surfaces: &'a [Surface],
    /// The layers from the top: what they are called, and the height of their tips.
    pub layers: &'a [(String, f64)],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    pub at: [f64; 2],
    /// How it came to be there.
    pub origin: Origin,
}

/// Neighbouring layers are shaded differently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    Light,
    Dark,
}

/// What the stock's surface is when a layer is cut, or several.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    pub shade: Shade,
    /// The surface, from left to right.
    pub contour: Vec<[f64; 2]>,
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

/// More tips than can be told apart: those that fall onto one spot are drawn once.
const CROWDED: usize = 20_000;

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
    let section = Section::of(lattice.stock, lattice.heading.ids);
    let legend = legend(lattice);
    let mut svg = sheet::sheet(
        lattice.heading,
        section.room,
        &description(lattice),
        section.bottom + BELOW,
        &legend,
    );
    if is_many(lattice.vees.len()) {
        surfaces(&mut svg, lattice.surfaces, &section);
        svg.path(section.below(lattice.part).text(), PART);
    } else {
        section.stock(&mut svg, "fill=\"#f6f1e2\"");
        svg.path(section.below(lattice.part).text(), PART);
        vees(&mut svg, lattice, &section);
    }
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
    if is_many(lattice.vees.len()) {
        legend.push(shades());
        legend.push(Entry::area("fill=\"#f6f1e2\"", "stays"));
    } else {
        legend.push(Entry::line(
            format!("stroke=\"{VEE}\" stroke-width=\"1.5\""),
            "flanks, as far as they cut",
        ));
    }
    legend.push(Entry::area(PART, "part"));
    if !lattice.bounds.is_empty() {
        legend.push(Entry::line(BOUND, "part with allowance"));
    }
    legend
}

/// Whether so many cuts are drawn together, layer by layer.
pub(super) const fn is_many(cuts: usize) -> bool {
    cuts >= MANY
}

/// What odd and even layers take.
pub(super) const SHADES: [&str; 2] = ["#f7f2e4", "#e8dec4"];
/// Outlines of chips.
pub(super) const EDGE: &str = "#8f7f57";

/// Layers in a legend.
pub(super) fn shades() -> Entry {
    let paint = format!("fill=\"{}\" stroke=\"{EDGE}\"", SHADES[1]);
    Entry::area(paint, "taken, layer by layer in two shades")
}

/// What each layer takes: the area above its surface, the later ones over the earlier ones; and what stays below the last.
pub(super) fn surfaces(svg: &mut Svg, surfaces: &[Surface], section: &Section) {
    section.stock(svg, &format!("fill=\"{}\"", shade(surfaces.first())));
    for pair in surfaces.windows(2) {
        if let [before, next] = pair {
            let paint = format!(
                "fill=\"{}\" stroke=\"{EDGE}\" stroke-width=\"0.3\"",
                shade(Some(next))
            );
            svg.path(section.below(&before.contour).text(), &paint);
        }
    }
    if let Some(last) = surfaces.last() {
        svg.path(section.below(&last.contour).text(), "fill=\"#f6f1e2\"");
    }
}

fn shade(surface: Option<&Surface>) -> &'static str {
    match surface.map(|surface| surface.shade) {
        Some(Shade::Dark) => SHADES[1],
        Some(Shade::Light) | None => SHADES[0],
    }
}

/// Lines and marks become finer where there are many; where they are drawn together, they do not touch.
fn fineness(lattice: &Lattice<'_>, section: &Section) -> f64 {
    if is_many(lattice.vees.len()) {
        let longest = lattice.layers.len().max(1);
        let each =
            (section.x.places[1] - section.x.places[0]) * longest as f64 / lattice.tips.len().max(1) as f64;
        return (each * 0.3).clamp(0.35, 3.0);
    }
    let area = (section.x.places[1] - section.x.places[0]) * (section.z.places[0] - section.z.places[1]);
    let each = (area / (lattice.tips.len().max(1) as f64)).sqrt();
    (each / 6.0).clamp(0.4, 4.2)
}

fn vees(svg: &mut Svg, lattice: &Lattice<'_>, section: &Section) {
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
        if !trace.is_empty() {
            svg.path(trace.text(), &origin.paint(r));
        }
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
        lines.open([
            [right, *y],
            [right + 5.0, *y],
            [right + 13.0, place],
            [right + 15.0, place],
        ]);
        svg.text((right + 17.0, place + 5.0), Anchor::Start, "", name);
    }
    if !lines.is_empty() {
        svg.path(lines.text(), &format!("fill=\"none\" stroke=\"{VEE}\""));
    }
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
