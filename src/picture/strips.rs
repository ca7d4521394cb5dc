//! Slits and strips of rectangular cutting within a picture of cuts: upright lines, and rectangles with the side that the disc
//! comes from.
//!
//! Seen along its feed, the edge of a disc that leads is an ellipse as wide as the disc. It is drawn at few strips only, and no
//! farther than the stock, for it is mostly wider than what it frees.

use super::palette::{EDGE, INK, SHADES};
use super::section::Section;
use super::sheet::{Entry, HALO, text_width};
use super::svg::{Anchor, Svg};
use super::trace::Trace;
use vcutc_backend_api::words::counted;

/// A slit. Lengths are in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slit {
    pub x: f64,
    /// The heights of its bottom and of the surface above it.
    pub z: [f64; 2],
}

/// A strip. Points are x and z in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Neighbouring layers are shaded differently.
    pub layer: u32,
    /// The number of its cut in the layer.
    pub number: u32,
    /// Its lower left corner.
    pub low: [f64; 2],
    /// Its upper right corner.
    pub high: [f64; 2],
    pub access: Access,
}

/// The side that the disc comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    Left,
    Right,
}

/// The edge of a disc, seen along its feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Its centre.
    pub centre: [f64; 2],
    /// Its half axes across and up, in mm.
    pub half: [f64; 2],
}

/// What a picture shows of rectangular cutting; nothing of other cuts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strips<'a> {
    pub slits: &'a [Slit],
    pub strips: &'a [Strip],
    /// The disc where it is drawn.
    pub discs: &'a [Disc],
}

const SLIT: &str = "stroke-linecap=\"butt\"";
const DISC: &str = "fill=\"#56b4e9\" fill-opacity=\"0.55\" stroke=\"#3d5a73\"";
const AXIS: &str = "fill=\"none\" stroke=\"#3d5a73\" stroke-dasharray=\"8 3 2 3\"";
const ACCESS: &str = "#3d5a73";

fn slit(width: f64) -> String {
    format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"{width:.2}\" {SLIT}")
}

fn shade(layer: u32) -> String {
    let shade = SHADES[usize::from(layer.is_multiple_of(2))];
    format!("fill=\"{shade}\" stroke=\"{EDGE}\" stroke-width=\"0.8\"")
}

impl Strips<'_> {
    /// The rectangles, below the part.
    pub(super) fn rectangles(&self, svg: &mut Svg, section: &Section) {
        for parity in [1, 0] {
            let of_layer = self.strips.iter().filter(|strip| strip.layer % 2 == parity);
            let areas: Vec<[f64; 4]> = of_layer.map(|strip| strip.area(section)).collect();
            if !areas.is_empty() {
                svg.rects(&areas, &shade(parity));
            }
        }
    }

    /// The slits, finer where there are many.
    pub(super) fn slits(&self, svg: &mut Svg, section: &Section) {
        let lines = self
            .slits
            .iter()
            .map(|slit| slit.z.map(|z| section.at([slit.x, z])));
        let width = (60.0 / (self.slits.len() as f64 + 1.0)).clamp(0.3, 1.8);
        svg.path(Trace::pieces(lines).text(), &slit(width));
    }

    /// The disc with its axis.
    pub(super) fn discs(&self, svg: &mut Svg, section: &Section) {
        for disc in self.discs {
            svg.closed(disc.outline(section), DISC);
        }
        let axes = self.discs.iter().filter_map(|disc| {
            let ([x, y], [left, right]) = (section.at(disc.centre), section.x.places);
            (left..=right)
                .contains(&x)
                .then(|| [[x, y + 8.0], [x, (y - 34.0).max(section.room.top)]])
        });
        svg.path(Trace::pieces(axes).text(), AXIS);
    }

    /// Numbers and sides of access, where there is room for them.
    pub(super) fn numbers(&self, svg: &mut Svg, section: &Section) {
        let mut arrows = Trace::default();
        for strip in self.strips {
            strip.arrow(&mut arrows, section);
        }
        svg.path(arrows.text(), &format!("fill=\"{ACCESS}\""));
        for strip in self.strips {
            strip.number(svg, section);
        }
    }

    /// What is in the picture, for its legend.
    pub(super) fn legend(&self, is_many: bool) -> Vec<Entry> {
        let mut legend = Vec::new();
        if !self.slits.is_empty() {
            legend.push(Entry::new(counted(self.slits.len(), "slit"), |svg, [x, y]| {
                svg.open([[x + 12.0, y - 8.0], [x + 12.0, y + 8.0]], &slit(1.8));
            }));
        }
        if is_many || self.strips.is_empty() {
            return legend;
        }
        legend.push(Entry::new(
            "strips by number; the disc comes from the arrow's side",
            |svg, [x, y]| {
                svg.rect([x, y - 8.0, 24.0, 16.0], &shade(2));
                let mut arrow = Trace::default();
                arrow.closed(pointing(Access::Left, [x + 1.0, y]));
                svg.path(arrow.text(), &format!("fill=\"{ACCESS}\""));
            },
        ));
        if !self.discs.is_empty() {
            legend.push(Entry::new("the disc at a strip of each layer", |svg, [x, y]| {
                let disc = around([x + 12.0, y], [12.0, 4.0], [x, x + 24.0]);
                svg.closed(disc, DISC);
            }));
        }
        legend
    }

    /// What is in the picture, in words; none of other cuts.
    pub(super) fn words(&self) -> Option<String> {
        let is_none = self.slits.is_empty() && self.strips.is_empty();
        (!is_none).then(|| {
            let strips = counted(self.strips.len(), "strip");
            format!("{} and {strips}", counted(self.slits.len(), "slit"))
        })
    }
}

/// Size of an arrow, and the height of the letters of a number.
const ARROW: f64 = 6.0;
const LETTERS: f64 = 12.0;

impl Strip {
    /// Left and upper edge, width and height in the picture.
    fn area(&self, section: &Section) -> [f64; 4] {
        let ([left, bottom], [right, top]) = (section.at(self.low), section.at(self.high));
        [left, top, right - left, bottom - top]
    }

    fn arrow(&self, arrows: &mut Trace, section: &Section) {
        let [left, top, width, height] = self.area(section);
        if width < 2.5 * ARROW || height < ARROW {
            return;
        }
        let x = match self.access {
            Access::Left => left + 1.0,
            Access::Right => left + width - 1.0,
        };
        arrows.closed(pointing(self.access, [x, top + height / 2.0]));
    }

    /// Above the middle, so that there is room for the mark of its origin.
    fn number(&self, svg: &mut Svg, section: &Section) {
        let [left, top, width, height] = self.area(section);
        let text = self.number.to_string();
        if width < text_width(&text) + 2.5 * ARROW || height < 2.0 * LETTERS {
            return;
        }
        let at = [left + width / 2.0, top + height / 2.0];
        let style = format!("font-size=\"{LETTERS}\" {HALO}");
        svg.text(at, Anchor::Middle, &style, &text);
    }
}

/// An arrow from a side into the strip beside it.
fn pointing(from: Access, [x, y]: [f64; 2]) -> [[f64; 2]; 3] {
    let tip = match from {
        Access::Left => x + ARROW * 1.3,
        Access::Right => x - ARROW * 1.3,
    };
    [[x, y - ARROW * 0.7], [tip, y], [x, y + ARROW * 0.7]]
}

impl Disc {
    /// No flatter than can be seen.
    fn outline(&self, section: &Section) -> Vec<[f64; 2]> {
        let half = [
            self.half[0] * section.x.per_unit(),
            (self.half[1] * section.z.per_unit().abs()).max(2.0),
        ];
        around(section.at(self.centre), half, section.x.places)
    }
}

/// An ellipse, as far as it lies between two places across.
fn around([x, y]: [f64; 2], half: [f64; 2], [left, right]: [f64; 2]) -> Vec<[f64; 2]> {
    let (from, to) = ((x - half[0]).max(left), (x + half[0]).min(right));
    let places = (0..=STEPS).map(|step| from + (to - from) * f64::from(step) / f64::from(STEPS));
    let height = |at: f64| {
        let share = (at - x) / half[0];
        half[1] * (1.0 - share * share).max(0.0).sqrt()
    };
    let upper = places.clone().map(|at| [at, y - height(at)]);
    let lower = places.rev().map(|at| [at, y + height(at)]);
    upper.chain(lower).collect()
}

/// Corners along an edge of a disc.
const STEPS: u32 = 32;

#[cfg(test)]
mod tests {
    use super::super::Prefix;
    use super::*;

    fn strip(low: [f64; 2], high: [f64; 2], access: Access) -> Strip {
        Strip {
            layer: 1,
            number: 7,
            low,
            high,
            access,
        }
    }

    #[test]
    fn arrows_point_into_their_strips() {
        let section = Section::of([100.0, 50.0], Prefix::NONE);
        for access in [Access::Left, Access::Right] {
            let strip = strip([20.0, 30.0], [30.0, 40.0], access);
            let [left, _, width, _] = strip.area(&section);
            let x = match access {
                Access::Left => left + 1.0,
                Access::Right => left + width - 1.0,
            };
            let [base, tip, _] = pointing(access, [x, 0.0]);
            let middle = left + width / 2.0;
            assert!((tip[0] - middle).abs() < (base[0] - middle).abs(), "{access:?}");
        }
    }

    #[test]
    fn discs_end_with_the_stock() {
        let section = Section::of([100.0, 50.0], Prefix::NONE);
        let [left, right] = section.x.places;
        let disc = Disc {
            centre: [10.0, 30.0],
            half: [25.0, 0.0],
        };
        let outline = disc.outline(&section);
        let xs = outline.iter().map(|at| at[0]);
        assert!((xs.clone().fold(f64::MAX, f64::min) - left).abs() < 1e-9);
        let most = xs.fold(f64::MIN, f64::max);
        assert!((most - section.at([35.0, 0.0])[0]).abs() < 1e-9 && most < right);
        let [_, y] = section.at(disc.centre);
        let flat = outline.iter().map(|at| (at[1] - y).abs()).fold(0.0, f64::max);
        assert!((flat - 2.0).abs() < 0.02, "{flat}");
    }
}
