//! What the cuts leave: the part, the machined contour above it, the chips that were taken out, and the highest scallop.

use super::chart::FRAME;
use super::lattice::{PART, is_many, shades, surfaces};
use super::palette::{EDGE, INK, ORANGE, SHADES};
use super::section::{BELOW, Section};
use super::sheet::{self, Entry, HALO};
use super::svg::{Anchor, Svg};
use super::trace::Trace;

pub use super::sheet::Heading;

/// What a picture of a contour shows. Lengths are in mm, points are x and z.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// Width and height of the stock.
    pub stock: [f64; 2],
    /// The part's profile, from left to right.
    pub part: &'a [[f64; 2]],
    /// The machined contour, from left to right.
    pub machined: &'a [[f64; 2]],
    /// The chips in the order in which they come free. From a hundred on they are not drawn one by one.
    pub chips: &'a [Chip],
    /// The surface when each layer is cut, in their order, from left to right: what is drawn of many cuts.
    pub surfaces: &'a [Vec<[f64; 2]>],
    /// The highest scallop.
    pub highest: Highest,
}

/// What a V, a single flank or a pass of a disc takes out.
#[derive(Clone, Debug, PartialEq)]
pub struct Chip {
    /// The layer it belongs to: neighbouring layers are shaded differently.
    pub layer: u32,
    pub outline: Vec<[f64; 2]>,
}

/// The highest material on the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Highest {
    pub peak: [f64; 2],
    /// Its height: how far it is from the nearest point of the part.
    pub height: f64,
}

const HIGHEST: &str = "#a3005c";

/// The machined contour's line, finer where its teeth are many, so that it can be enlarged.
fn line(contour: &Contour<'_>) -> String {
    let teeth = (contour.machined.len() as f64 / 2.0).max(1.0);
    let width = (120.0 / teeth).clamp(0.3, 1.6);
    format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"{width:.2}\" stroke-linejoin=\"round\"")
}

/// Writes the picture as SVG.
#[must_use]
pub fn draw(contour: &Contour<'_>) -> String {
    let section = Section::of(contour.stock, contour.heading.ids);
    let bottom = section.bottom + BELOW;
    let (description, legend) = (description(contour), legend(contour));
    let mut svg = sheet::sheet(contour.heading, section.room, &description, bottom, &legend);
    chips(&mut svg, contour, &section);
    section.below(&mut svg, contour.machined, &format!("fill=\"{ORANGE}\""));
    section.below(&mut svg, contour.part, PART);
    svg.open(section.curve(contour.machined), &line(contour));
    section.stock(&mut svg, FRAME);
    highest(&mut svg, contour, &section);
    section.axes(&mut svg);
    svg.finish()
}

fn description(contour: &Contour<'_>) -> String {
    let Highest { peak, height } = contour.highest;
    format!(
        "{}. Section of a stock {:.1} mm wide and {:.1} mm high with the part, the machined contour and {} chips. The highest \
         scallop stands {height:.2} mm above the part at x {:.1} mm, z {:.1} mm.",
        contour.heading.subtitle,
        contour.stock[0],
        contour.stock[1],
        contour.chips.len(),
        peak[0],
        peak[1]
    )
}

fn legend(contour: &Contour<'_>) -> Vec<Entry> {
    let mut legend = Vec::new();
    if is_many(contour.chips.len()) {
        legend.push(shades());
    } else {
        let shade = |index: usize| format!("fill=\"{}\" stroke=\"{EDGE}\"", SHADES[index]);
        legend.push(Entry::area(shade(0), "chips of odd layers"));
        legend.push(Entry::area(shade(1), "of even layers"));
    }
    let highest = format!("stroke=\"{HIGHEST}\" stroke-width=\"3\"");
    legend.extend([
        Entry::area(format!("fill=\"{ORANGE}\""), "stays on the part"),
        Entry::line(line(contour), "machined contour"),
        Entry::area(PART, "part"),
        Entry::line(highest, "highest scallop"),
    ]);
    legend
}

/// Chips of odd and of even layers are a path each.
fn chips(svg: &mut Svg, contour: &Contour<'_>, section: &Section) {
    if is_many(contour.chips.len()) {
        surfaces(svg, contour.surfaces, section);
        return;
    }
    section.stock(svg, &format!("fill=\"{}\"", SHADES[0]));
    let mut layers = [Trace::default(), Trace::default()];
    for chip in contour.chips {
        let [odd, even] = &mut layers;
        let trace = if chip.layer % 2 == 1 { odd } else { even };
        trace.closed(chip.outline.iter().map(|&point| section.at(point)));
    }
    let width = (12.0 / (contour.chips.len() as f64 + 1.0).sqrt()).clamp(0.15, 0.8);
    for (trace, shade) in layers.iter().zip(SHADES) {
        let edge = format!("stroke=\"{EDGE}\" stroke-width=\"{width:.2}\" stroke-linejoin=\"round\"");
        svg.path(trace.text(), &format!("fill=\"{shade}\" {edge}"));
    }
}

/// The way from the part to the highest peak, and its length.
fn highest(svg: &mut Svg, contour: &Contour<'_>, section: &Section) {
    let Highest { peak, height } = contour.highest;
    if height <= 0.0 {
        return;
    }
    let [from, to] = [nearest(contour.part, peak), peak].map(|point| section.at(point));
    let paint = format!("stroke=\"{HIGHEST}\" stroke-width=\"3\" stroke-linecap=\"round\"");
    svg.open([from, to], &paint);
    let [left, right] = section.x.places;
    let (x, anchor) = match (to[0] - left) / (right - left) {
        share if share < 0.15 => (to[0].max(left + 6.0), Anchor::Start),
        share if share > 0.85 => (to[0].min(right - 6.0), Anchor::End),
        _ => (to[0], Anchor::Middle),
    };
    // At the top its words would be beside the sheet, or touch the subtitle.
    let y = match to[1] - 9.0 {
        above if above > section.room.top + 4.0 => above,
        _ => from[1] + 21.0,
    };
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.text([x, y], anchor, &bold, &format!("{height:.2} mm"));
}

/// The point of a polyline nearest to another.
fn nearest(line: &[[f64; 2]], point: [f64; 2]) -> [f64; 2] {
    let to_piece = |pair: &[[f64; 2]]| {
        let (from, way) = (pair[0], [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]]);
        let length = way[0] * way[0] + way[1] * way[1];
        let along = (point[0] - from[0]) * way[0] + (point[1] - from[1]) * way[1];
        let share = if length > 0.0 {
            (along / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        [from[0] + way[0] * share, from[1] + way[1] * share]
    };
    let squared =
        |to: [f64; 2]| (to[0] - point[0]) * (to[0] - point[0]) + (to[1] - point[1]) * (to[1] - point[1]);
    let feet = line.windows(2).map(to_piece);
    feet.min_by(|a, b| squared(*a).total_cmp(&squared(*b)))
        .unwrap_or(point)
}
