//! Sections of a part that changes along y, with the contour that the cuts leave: the same in all of them, or where cuts have ways of their
//! own another one in each.

use super::{corners, pairs};
use crate::Material;
use vcutc_job::follow::Guide;
use vcutc_picture::Prefix;
use vcutc_picture::sections::{self, Heading, Roughed, Shown};
use vcutc_simulation::prove::Across;
use vcutc_surface::surface::Surface;

/// How many sections a page has at most: one for every fortieth of the depth, or some of those that finishing was looked at in.
const COUNT: u32 = 41;

/// Sections that are computed once and drawn in several places.
#[derive(Clone, Debug)]
pub struct SurfaceSections {
    title: String,
    subtitle: &'static str,
    stock: [f64; 2],
    left: Left,
    shown: Vec<Shown>,
}

/// What the cuts leave, from left to right.
#[derive(Clone, Debug)]
enum Left {
    /// The same at every y, over a shadow.
    Alike {
        machined: Vec<[f64; 2]>,
        shadow: Vec<[f64; 2]>,
    },
    /// One contour for each section.
    Own(Vec<Vec<[f64; 2]>>),
}

impl Left {
    /// At these places along y.
    fn of(material: &Material<'_>, places: impl Iterator<Item = f64>) -> Option<Self> {
        let part = &material.job.part;
        if !matches!(part.guide(), Some(Guide::Columns(_))) {
            return Some(Self::Alike {
                machined: pairs(&corners(material)),
                shadow: pairs(material.plan.profile.points()),
            });
        }
        let stock = material.job.stock;
        let machined = part.left_by(&corners(material), &material.compiled.report.columns, stock)?;
        let width = stock.width.to_mm();
        let contours = places.map(|y| Some(pairs(&machined.section(y, width)?)));
        Some(Self::Own(contours.collect::<Option<_>>()?))
    }
}

impl SurfaceSections {
    /// The sections of a part, from the front of the stock to its back; none of a part that is a profile.
    #[must_use]
    pub fn of(material: &Material<'_>) -> Option<Self> {
        let surface = material.job.part.levelled()?;
        let stock = material.plan.stock;
        let finished = material.compiled.report.tracked.last();
        let finished = finished.map_or(&[] as &[Across], |tracked| &tracked.across);
        let shown = if finished.is_empty() {
            let places =
                (0..COUNT).map(|number| stock.depth.to_mm() * f64::from(number) / f64::from(COUNT - 1));
            places
                .map(|y| shown(surface, y, Vec::new()))
                .collect::<Option<Vec<_>>>()?
        } else {
            let spine = material.job.part.spine();
            let chosen = evenly(finished.len()).filter_map(|number| finished.get(number));
            let places = chosen.map(|across| {
                let rise = spine.map_or(0.0, |spine| spine.rise(across.y));
                let lowered = across.machined.iter().map(|point| [point.x, point.z - rise]);
                shown(surface, across.y, lowered.collect())
            });
            places.collect::<Option<Vec<_>>>()?
        };
        Some(Self {
            title: format!("{}: sections of the part", material.plan.name),
            subtitle: match material.job.part.spine() {
                None => "what the cuts leave above the part",
                Some(_) => "what the cuts leave above the part, with the spine of the cuts taken off",
            },
            stock: [stock.width.to_mm(), stock.height.to_mm()],
            left: Left::of(material, shown.iter().map(|shown| shown.y))?,
            shown,
        })
    }

    /// The y of each section in mm.
    pub fn places(&self) -> impl Iterator<Item = f64> + '_ {
        self.shown.iter().map(|shown| shown.y)
    }

    /// The section that is shown at first, counted from 0: the one in the middle.
    #[must_use]
    pub const fn shown(&self) -> usize {
        self.shown.len() / 2
    }

    /// Whether the cuts leave the same at every y.
    #[must_use]
    pub const fn are_alike(&self) -> bool {
        matches!(self.left, Left::Alike { .. })
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
            roughed: match &self.left {
                Left::Alike { machined, shadow } => Roughed::Alike { machined, shadow },
                Left::Own(contours) => Roughed::Own(contours),
            },
            sections: &self.shown,
            shown: self.shown(),
        })
    }
}

/// As many of so many numbers as a page has, the first and the last among them.
fn evenly(of: usize) -> impl Iterator<Item = usize> {
    let count = of.min(COUNT as usize);
    let last = count.saturating_sub(1).max(1);
    (0..count).map(move |number| (number * (of - 1) + last / 2) / last)
}

/// The section of a part at a y, with what finishing leaves there.
fn shown(part: &Surface, y: f64, finished: Vec<[f64; 2]>) -> Option<Shown> {
    let part = pairs(part.section(y).ok()?.points());
    Some(Shown { y, part, finished })
}
