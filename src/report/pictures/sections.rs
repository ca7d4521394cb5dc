//! Sections of a part that changes along y, with the contour that the cuts leave.

use super::{corners, pairs};
use crate::Material;
use vcutc_picture::Prefix;
use vcutc_picture::sections::{self, Heading};

/// How many sections a page has: one for every fortieth of the depth.
const COUNT: u32 = 41;

/// Sections that are computed once and drawn in several places.
#[derive(Clone, Debug)]
pub struct SurfaceSections {
    title: String,
    subtitle: &'static str,
    stock: [f64; 2],
    machined: Vec<[f64; 2]>,
    shadow: Vec<[f64; 2]>,
    parts: Vec<(f64, Vec<[f64; 2]>)>,
}

impl SurfaceSections {
    /// The sections of a part, from the front of the stock to its back; none of a part that is a profile.
    #[must_use]
    pub fn of(material: &Material<'_>) -> Option<Self> {
        let surface = material.job.part.levelled()?;
        let stock = material.plan.stock;
        let places = (0..COUNT).map(|number| stock.depth.to_mm() * f64::from(number) / f64::from(COUNT - 1));
        let parts = places.map(|y| Some((y, pairs(surface.section(y).ok()?.points()))));
        Some(Self {
            title: format!("{}: sections of the part", material.plan.name),
            subtitle: match material.job.part.spine() {
                None => "what the cuts leave above the part",
                Some(_) => "what the cuts leave above the part, with the spine of the cuts taken off",
            },
            stock: [stock.width.to_mm(), stock.height.to_mm()],
            machined: pairs(&corners(material)),
            shadow: pairs(material.plan.profile.points()),
            parts: parts.collect::<Option<Vec<_>>>()?,
        })
    }

    /// The y of each section in mm.
    pub fn places(&self) -> impl Iterator<Item = f64> + '_ {
        self.parts.iter().map(|(y, _)| *y)
    }

    /// The section that is shown at first, counted from 0: the one in the middle.
    #[must_use]
    pub const fn shown(&self) -> usize {
        self.parts.len() / 2
    }

    /// Writes them as SVG.
    #[must_use]
    pub fn draw(&self, ids: Prefix) -> String {
        sections::draw(&sections::Sections {
            heading: Heading {
                ids,
                title: &self.title,
                subtitle: self.subtitle,
            },
            stock: self.stock,
            machined: &self.machined,
            shadow: &self.shadow,
            parts: &self.parts,
            shown: self.shown(),
        })
    }
}
