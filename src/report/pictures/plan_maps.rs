//! Maps over the plan of a part that changes along y: its height and how it bends, what the cuts leave above it, and how a disc leans over
//! it.

mod curved;

pub use curved::{ClassMap, Curved};

use super::{corners, limit};
use crate::Material;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::{rounded, show};
use vcutc_job::operation::judged::Tilts;
use vcutc_picture::Prefix;
use vcutc_picture::plan_map::{self, Classed, Decimals, Heading, Limit, PlanMap, Quantity};
use vcutc_surface::map::{Cells, Map, Standing};
use vcutc_surface::residual::Over;
use vcutc_surface::surface::Surface;

/// The height of the part (`picture::plan_map`); none of a part that is a profile.
#[must_use]
pub fn surface(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(SurfaceMap::of_part(material)?.draw(ids))
}

/// How high material stands above the part after all cuts (`picture::plan_map`); none of a part that is a profile.
#[must_use]
pub fn residual(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(SurfaceMap::of_residual(material)?.draw(ids))
}

/// How high material stands above the part after finishing, in sections across the tracks (`picture::plan_map`); none of a job without
/// tracks on a surface.
#[must_use]
pub fn finished(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(SurfaceMap::of_finished(material)?.draw(ids))
}

/// How far the axis of the disc leans from the normal of the part where it finishes it (`picture::plan_map`); none of a job without
/// tracks on a surface.
#[must_use]
pub fn tilt(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(SurfaceMap::of_tilt(material)?.draw(ids))
}

/// The greatest curvature of the part at each place (`picture::plan_map`); none of a part that is a profile.
#[must_use]
pub fn curvature(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(Curved::of(material)?.curvature.draw(ids))
}

/// The classes of the part (`picture::class_map`); none of a part that is a profile.
#[must_use]
pub fn class(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(Curved::of(material)?.class.draw(ids))
}

/// A map that is computed once and drawn in several places.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    title: String,
    what: &'static str,
    quantity: Quantity,
    size: [f64; 2],
    cells: Cells,
    values: Values,
    /// What limits the values, and the limit.
    limit: Option<(&'static str, f64)>,
    /// What there is to say of them in addition.
    note: Option<String>,
}

/// The values of a map as numbers: heights in mm, angles in degrees, curvatures in 1/m.
#[derive(Clone, Debug)]
struct Values {
    cells: Vec<Option<f64>>,
    highest: ([f64; 2], f64),
    lowest: ([f64; 2], f64),
    mean: f64,
}

impl Values {
    fn of<V: Copy>(map: &Map<V>, number: fn(V) -> f64) -> Self {
        let spot = |over: Over<V>| (over.place.map(Length::to_mm), number(over.height));
        Self {
            cells: map.cells.iter().map(|cell| cell.map(number)).collect(),
            highest: spot(map.highest),
            lowest: spot(map.lowest),
            mean: number(map.mean),
        }
    }
}

/// What the limit on the scallop is called.
const SCALLOP: &str = "scallop limit";

/// An angle in degrees, without what rounding adds: a tilt at its limit is not above it.
fn degrees(angle: Angle) -> f64 {
    rounded(angle.to_deg(), 1e6)
}

impl SurfaceMap {
    /// The height of the part. None of a profile, and where so many triangles lie over each other that it takes too long.
    #[must_use]
    pub fn of_part(material: &Material<'_>) -> Option<Self> {
        let surface = material.job.part.surface()?;
        let (size, cells) = laid_out(surface);
        Some(Self {
            title: format!("{}: height of the part", material.plan.name),
            what: "height of the part",
            quantity: Quantity::Height,
            size,
            cells,
            values: Values::of(&surface.heights(cells).ok()??, Length::to_mm),
            limit: None,
            note: None,
        })
    }

    /// What the cuts leave above the part. None where there is no map of its height.
    #[must_use]
    pub fn of_residual(material: &Material<'_>) -> Option<Self> {
        let surface = material.job.part.levelled()?;
        let (size, cells) = laid_out(surface);
        let machined = material.job.part.left_by(
            &corners(material),
            &material.compiled.report.columns,
            material.job.stock,
        )?;
        // What tracks on the surface take off, sections alone know.
        let is_finished = !material.compiled.report.tracked.is_empty();
        let (title, what) = if is_finished {
            (
                "material that roughing leaves above the part",
                "height of the material that roughing leaves above the part",
            )
        } else {
            (
                "material left above the part",
                "height of the material left above the part",
            )
        };
        Some(Self {
            title: format!("{}: {title}", material.plan.name),
            what,
            quantity: Quantity::Height,
            size,
            cells,
            values: Values::of(&surface.left_over(&machined, cells).ok()??, Length::to_mm),
            limit: limit(material).map(|limit| (SCALLOP, limit)),
            note: None,
        })
    }

    /// What finishing leaves above the part, in sections across its tracks. None where none follow a surface.
    #[must_use]
    pub fn of_finished(material: &Material<'_>) -> Option<Self> {
        // No operation comes after tracks on a surface.
        let tracked = material.compiled.report.tracked.last()?;
        let surface = material.job.part.surface()?;
        let (size, cells) = laid_out(surface);
        let sections = tracked.across.iter().map(|across| {
            let part = surface.section(across.y).ok()?;
            Some(Standing {
                y: across.y,
                heights: part.standing(&across.machined),
            })
        });
        let sections: Vec<Standing> = sections.collect::<Option<_>>()?;
        let planned = material.plan.operation(tracked.operation)?;
        Some(Self {
            title: format!("{}: left above the part after finishing", material.plan.name),
            what: "height of the material that finishing leaves above the part",
            quantity: Quantity::Height,
            size,
            cells,
            values: Values::of(&Map::of_sections(&sections, cells, size)?, Length::to_mm),
            limit: planned
                .asked()
                .scallop_limit()
                .map(|limit| (SCALLOP, limit.value.to_mm())),
            note: None,
        })
    }

    /// The tilt of the disc on its tracks. None where none follow a surface, and where they have so many poses that it takes too long.
    #[must_use]
    pub fn of_tilt(material: &Material<'_>) -> Option<Self> {
        let Tilts { bands, limit } = material
            .plan
            .operations
            .iter()
            .find_map(|planned| planned.tilts())?;
        let (size, cells) = laid_out(material.job.part.surface()?);
        let limit = limit.map(|limit| {
            let name = if limit.tilt == limit.lead {
                "limit on the lead"
            } else {
                "limit on the lead, with the side tilt"
            };
            (name, degrees(limit.tilt))
        });
        Some(Self {
            title: format!("{}: tilt of the disc on its tracks", material.plan.name),
            what: "tilt of the disc from the normal of the part",
            quantity: Quantity::Angle,
            size,
            cells,
            values: Values::of(&Map::of_bands(&bands, cells, size).ok()??, degrees),
            limit,
            note: None,
        })
    }

    /// The least, the mean and the greatest value, in words; one of them where they are the same as shown.
    #[must_use]
    pub fn figures(&self) -> String {
        let Values {
            highest: (_, most),
            lowest: (_, least),
            mean,
            ..
        } = self.values;
        let decimals = Decimals::of([least, most]);
        let unit = self.quantity.unit();
        let [least, mean, most] = [least, mean, most].map(|value| decimals.shown(value));
        let figures = if least == most {
            format!("{mean} {unit} everywhere")
        } else {
            format!("least {least} {unit}, mean {mean} {unit}, most {most} {unit}")
        };
        match &self.note {
            Some(note) => format!("{figures}; {note}"),
            None => figures,
        }
    }

    /// The limit on the values, in words, if there is one.
    #[must_use]
    pub fn limit(&self) -> Option<String> {
        let (name, value) = self.limit?;
        Some(format!("{name}, {} {}", show(value), self.quantity.unit()))
    }

    /// Writes it as SVG.
    #[must_use]
    pub fn draw(&self, ids: Prefix) -> String {
        // The legend has the other figures.
        let subtitle = self.note.clone().unwrap_or_else(|| self.figures());
        plan_map::draw(&self.headed(ids, &subtitle))
    }

    /// Its values in the classes of its colours.
    pub(crate) fn classed(&self) -> Classed {
        plan_map::classed(&self.headed(Prefix::NONE, ""))
    }

    /// What its values are.
    pub(crate) const fn what(&self) -> &'static str {
        self.what
    }

    /// What they are in.
    pub(crate) const fn unit(&self) -> &'static str {
        self.quantity.unit()
    }

    /// The cells, all maps of a part have the same ones.
    pub(crate) const fn cells(&self) -> Cells {
        self.cells
    }

    /// The value of each cell.
    pub(crate) fn values(&self) -> &[Option<f64>] {
        &self.values.cells
    }

    fn headed<'a>(&'a self, ids: Prefix, subtitle: &'a str) -> PlanMap<'a> {
        PlanMap {
            heading: Heading {
                ids,
                title: &self.title,
                subtitle,
            },
            what: self.what,
            quantity: self.quantity,
            size: self.size,
            cells: [self.cells.columns, self.cells.rows],
            heights: &self.values.cells,
            highest: self.values.highest,
            lowest: self.values.lowest,
            mean: self.values.mean,
            limit: self.limit.map(|(name, value)| Limit { name, value }),
        }
    }
}

/// The size of the plan along x and y, in mm, and the cells over it.
fn laid_out(surface: &Surface) -> ([f64; 2], Cells) {
    let plan = surface.plan();
    let size = [plan.width, plan.depth].map(Length::to_mm);
    let [columns, rows] = plan_map::cells(size);
    (size, Cells { columns, rows })
}
