//! How a part bends: the greatest curvature at each place, and the class of the place.
//!
//! What is hollow counts for a disc, which needs a tilt of `asin(R k)` in a hollow of the curvature `k` [Yang 9, 10]. So the map has the
//! greater of both principal curvatures.

use super::{Quantity, SurfaceMap, Values, laid_out};
use crate::Material;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_job::BladeRef;
use vcutc_picture::Prefix;
use vcutc_picture::class_map::{self, COLOURS};
use vcutc_picture::plan_map::Heading;
use vcutc_surface::bend::Bend;
use vcutc_surface::class::Class;
use vcutc_surface::map::{Cells, Map};

/// The maps of how a part bends, computed once.
#[derive(Clone, Debug)]
pub struct Curved {
    /// The greatest curvature at each place.
    pub curvature: SurfaceMap,
    /// The class of each place.
    pub class: ClassMap,
}

/// The classes of a part over its plan.
#[derive(Clone, Debug)]
pub struct ClassMap {
    title: String,
    size: [f64; 2],
    cells: Cells,
    /// The number of the class of each cell, in the order of [`Class::ALL`].
    classes: Vec<Option<u32>>,
}

/// Curvatures are computed in 1/mm and shown in 1/m, without what rounding adds.
fn per_metre(curvature: f64) -> f64 {
    rounded(1000.0 * curvature, 1e6)
}

impl Curved {
    /// None of a profile, and where no place has a curvature.
    #[must_use]
    pub fn of(material: &Material<'_>) -> Option<Self> {
        let part = &material.job.part;
        let (size, cells) = laid_out(part.surface()?);
        let bends = part.bends(cells)?;
        Some(Self {
            curvature: SurfaceMap::of_curvature(material, &bends, cells, size)?,
            class: ClassMap {
                title: format!("{}: class of the part", material.plan.name),
                size,
                cells,
                classes: bends
                    .iter()
                    .map(|bend| bend.map(|bend| number(bend.class())))
                    .collect(),
            },
        })
    }
}

/// The number of a class in the order of [`Class::ALL`].
const fn number(class: Class) -> u32 {
    match class {
        Class::Dome => 0,
        Class::Ridge => 1,
        Class::Flat => 2,
        Class::Saddle => 3,
        Class::Trough => 4,
        Class::Bowl => 5,
    }
}

impl SurfaceMap {
    fn of_curvature(
        material: &Material<'_>,
        bends: &[Option<Bend>],
        cells: Cells,
        size: [f64; 2],
    ) -> Option<Self> {
        let values = bends.iter().map(|bend| bend.map(|bend| bend.greatest()));
        let map = Map::of_middles(values.collect(), cells, size)?;
        let note = if map.highest.height > 0.0 {
            let radius = rounded(1.0 / map.highest.height, 10.0);
            format!("smallest hollow radius {} mm", show(radius))
        } else {
            "nowhere hollow".to_owned()
        };
        Some(Self {
            title: format!("{}: greatest curvature of the part", material.plan.name),
            what: "greatest curvature of the part",
            quantity: Quantity::Curvature,
            size,
            cells,
            values: Values::of(&map, per_metre),
            limit: disc_radius(material)
                .map(|radius| ("curvature of the disc", per_metre(1.0 / radius.to_mm()))),
            note: Some(note),
        })
    }
}

/// The radius of the disc that finishes the surface, if one does.
fn disc_radius(material: &Material<'_>) -> Option<Length> {
    let tracked = material.compiled.report.tracked.last()?;
    let planned = material.plan.operation(tracked.operation)?;
    let blades = planned.asked().blades();
    blades.into_iter().find_map(|blade| match blade {
        BladeRef::Disc(disc) => Some(disc.radius.value),
        BladeRef::Straight(_) | BladeRef::Crusher(_) => None,
    })
}

impl ClassMap {
    /// How much of the plan each class takes up, in words.
    #[must_use]
    pub fn figures(&self) -> String {
        let known = self.classes.iter().flatten().count().max(1);
        let shares = Class::ALL.into_iter().rev().filter_map(|class| {
            let own = Some(number(class));
            let count = self.classes.iter().filter(|class| **class == own).count();
            (count > 0).then_some((class.word(), count))
        });
        let shares: Vec<(&str, usize)> = shares.collect();
        match shares.as_slice() {
            [(word, _)] => format!("{word} everywhere"),
            _ => {
                let percent = |count: usize| 100.0 * count as f64 / known as f64;
                let words = shares
                    .iter()
                    .map(|(word, count)| format!("{word} {:.1} %", percent(*count)));
                words.collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// Writes it as SVG.
    #[must_use]
    pub fn draw(&self, ids: Prefix) -> String {
        let figures = self.figures();
        class_map::draw(&class_map::ClassMap {
            heading: Heading {
                ids,
                title: &self.title,
                subtitle: &figures,
            },
            words: Class::ALL.map(Class::word),
            figures: &figures,
            size: self.size,
            cells: [self.cells.columns, self.cells.rows],
            classes: &self.classes,
        })
    }

    /// What it shows.
    pub(crate) const fn what() -> &'static str {
        "class of the part"
    }

    /// The classes with their colours.
    pub(crate) fn legend() -> [(&'static str, &'static str); COLOURS.len()] {
        core::array::from_fn(|number| (COLOURS[number], Class::ALL[number].word()))
    }

    /// The number of the class of each cell.
    pub(crate) fn classes(&self) -> &[Option<u32>] {
        &self.classes
    }
}
