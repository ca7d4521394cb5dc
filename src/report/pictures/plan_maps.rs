//! Maps over the plan of a part that changes along y: its height, and what the cuts leave above it.

use super::{corners, limit};
use crate::Material;
use vcutc_backend_api::units::Length;
use vcutc_picture::Prefix;
use vcutc_picture::plan_map::{self, Decimals, Heading, PlanMap};
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

/// A map that is computed once and drawn in several places.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    title: String,
    what: &'static str,
    size: [f64; 2],
    cells: Cells,
    map: Map,
    limit: Option<f64>,
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
            size,
            cells,
            map: surface.heights(cells).ok()??,
            limit: None,
        })
    }

    /// What the cuts leave above the part. None where there is no map of its height.
    #[must_use]
    pub fn of_residual(material: &Material<'_>) -> Option<Self> {
        let surface = material.job.part.levelled()?;
        let (size, cells) = laid_out(surface);
        let machined = material
            .job
            .part
            .left_by(&corners(material), material.job.stock)?;
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
            size,
            cells,
            map: surface.left_over(&machined, cells).ok()??,
            limit: limit(material),
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
            size,
            cells,
            map: Map::of_sections(&sections, cells, size)?,
            limit: planned.asked().scallop_limit().map(|limit| limit.value.to_mm()),
        })
    }

    /// The least, the mean and the greatest height, in words.
    #[must_use]
    pub fn figures(&self) -> String {
        let Map {
            lowest,
            mean,
            highest,
            ..
        } = &self.map;
        let decimals = Decimals::of([lowest.height, highest.height].map(Length::to_mm));
        let [least, mean, most] =
            [lowest.height, *mean, highest.height].map(|height| decimals.shown(height.to_mm()));
        format!("least {least} mm, mean {mean} mm, most {most} mm")
    }

    /// Writes it as SVG.
    #[must_use]
    pub fn draw(&self, ids: Prefix) -> String {
        let heights: Vec<Option<f64>> = self
            .map
            .cells
            .iter()
            .map(|cell| cell.map(Length::to_mm))
            .collect();
        let spot = |over: Over| (over.place.map(Length::to_mm), over.height.to_mm());
        plan_map::draw(&PlanMap {
            heading: Heading {
                ids,
                title: &self.title,
                subtitle: &self.figures(),
            },
            what: self.what,
            size: self.size,
            cells: [self.cells.columns, self.cells.rows],
            heights: &heights,
            highest: spot(self.map.highest),
            lowest: spot(self.map.lowest),
            mean: self.map.mean.to_mm(),
            limit: self.limit,
        })
    }
}

/// The size of the plan along x and y, in mm, and the cells over it.
fn laid_out(surface: &Surface) -> ([f64; 2], Cells) {
    let plan = surface.plan();
    let size = [plan.width, plan.depth].map(Length::to_mm);
    let [columns, rows] = plan_map::cells(size);
    (size, Cells { columns, rows })
}
