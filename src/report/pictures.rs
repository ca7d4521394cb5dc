//! The pictures of a report, each from the result of a job: plain numbers for the modules of `picture`.
//!
//! Chips and the machined contour are those of the proof: the program's cuts are replayed, and each chip is what the surface
//! before it loses.

mod blade;
mod by_forces;
mod clock;
mod joints;
mod machined;
mod passes;
mod paths;
mod plan_maps;
mod process;
mod sections;
mod strips;
mod time;
mod torques;
mod tracks;
mod wave;
mod ways;

pub use blade::blade;
pub use by_forces::by_forces;
pub use joints::{joints, joints_twice};
pub use passes::{figures as pocket_figures, ground, passes};
pub use paths::paths;
pub use plan_maps::{ClassMap, Curved, SurfaceMap, class, curvature, finished, residual, surface, tilt};
pub use process::process;
pub use sections::SurfaceSections;
pub use time::time;
pub use torques::torques;
pub use tracks::{DiscTracks, has_tracks, tracks};
pub use wave::wave;

use super::Material;
use machined::{By, Machined, Taken, machined};
use strips::Rectangles;
use vcutc_backend_api::words::counted;
use vcutc_geometry::curve::Point2;
use vcutc_job::follow::Guide;
use vcutc_job::planned::{CutShape, PlannedTip};
use vcutc_picture::{Prefix, contour, correlation, deviation, lattice};
use vcutc_process::verdict;
use vcutc_simulation::contour::{SAMPLES, Sampled, sampled};

/// The lattice: tips by origin, flanks, layers (`picture::lattice`).
#[must_use]
pub fn lattice(material: &Material<'_>, ids: Prefix) -> String {
    let Machined { chips, surfaces, .. } = machined(material);
    let vees: Vec<[[f64; 2]; 3]> = chips.iter().filter_map(vee).collect();
    let strips = Rectangles::of(material.plan);
    let part = &material.plan.profile;
    let bounds = material
        .plan
        .operations
        .iter()
        .map(|planned| planned.bound().part);
    let bounds: Vec<Vec<[f64; 2]>> = bounds
        .filter(|bound| *bound != part)
        .map(|bound| pairs(bound.points()))
        .collect();
    let bounds: Vec<&[[f64; 2]]> = bounds.iter().map(Vec::as_slice).collect();
    lattice::draw(&lattice::Lattice {
        heading: lattice::Heading {
            ids,
            title: &titled(material, "lattice"),
            subtitle: &laid_out(material),
        },
        stock: stock(material),
        part: &pairs(material.plan.profile.points()),
        bounds: &bounds,
        tips: &strips.tips,
        vees: &vees,
        strips: strips.shown(),
        surfaces: &surfaces,
        layers: &layers(material),
    })
}

/// The title of a picture of the section. Over a part that changes along y, sections are about its shadow.
fn titled(material: &Material<'_>, what: &str) -> String {
    let part = &material.job.part;
    let shadow = match (part.surface(), part.guide()) {
        (Some(_), Some(Guide::Spine(_))) => ", over the shadow of the part along the spine of the cuts",
        (Some(_), Some(Guide::Columns(columns))) if columns.is_fan() => {
            ", over the lower ends of the lines that cover the part"
        }
        (Some(_), Some(Guide::Columns(_))) => ", over the lower ends of the curves that cover the part",
        (Some(_), None) => ", over the shadow of the part",
        (None, _) => "",
    };
    format!("{}: {what}{shadow}", material.plan.name)
}

/// What stays on the part, in words.
#[must_use]
pub fn scallops(material: &Material<'_>) -> String {
    let report = &material.compiled.report;
    let of = match material.job.part.surface() {
        Some(_) => "above its shadow",
        None => "on the part",
    };
    format!(
        "highest scallop {:.2} mm, {:.2} mm on average; {:.2} mm² stay {of}",
        report.scallop.height.to_mm(),
        report.mean_scallop.to_mm(),
        report.residual.to_mm2()
    )
}

/// The machined contour, chips and scallops above the part (`picture::contour`).
#[must_use]
pub fn contour(material: &Material<'_>, ids: Prefix) -> String {
    let Machined {
        contour: machined,
        chips,
        surfaces,
    } = machined(material);
    let report = &material.compiled.report;
    let subtitle = scallops(material);
    contour::draw(&contour::Contour {
        heading: contour::Heading {
            ids,
            title: &titled(material, "machined contour"),
            subtitle: &subtitle,
        },
        stock: stock(material),
        part: &pairs(material.plan.profile.points()),
        machined: &machined,
        chips: &chips.into_iter().map(|chip| chip.shown).collect::<Vec<_>>(),
        surfaces: &surfaces,
        highest: contour::Highest {
            peak: pair(report.scallop.peak),
            height: report.scallop.height.to_mm(),
        },
    })
}

/// How far the machined contour stands off the part, along the whole profile (`picture::deviation`).
#[must_use]
pub fn deviation(material: &Material<'_>, ids: Prefix) -> String {
    let report = &material.compiled.report;
    // With the corners, so that no tooth is missed between two of the points.
    let mut points = corners(material);
    points.extend(sampled(&points));
    points.sort_by(|a, b| a.x.total_cmp(&b.x));
    let subtitle = deviations(material);
    deviation::draw(&deviation::Deviation {
        heading: deviation::Heading {
            ids,
            title: &titled(material, "deviation along the profile"),
            subtitle: &subtitle,
        },
        curve: &distances(&points, material),
        largest: [report.scallop.peak.x, report.scallop.height.to_mm()],
        hollow: report
            .hollow()
            .map(|hollow| [hollow.peak.x, hollow.height.to_mm()]),
        mean: report.mean_scallop.to_mm(),
        limit: limit(material),
    })
}

/// How far the contours are apart, in words.
#[must_use]
pub fn deviations(material: &Material<'_>) -> String {
    let report = &material.compiled.report;
    let scallop = format!(
        "highest scallop {:.2} mm, {:.2} mm on average",
        report.scallop.height.to_mm(),
        report.mean_scallop.to_mm()
    );
    match report.hollow() {
        Some(hollow) => format!(
            "{scallop}; deepest corner no cut reaches {:.2} mm",
            hollow.height.to_mm()
        ),
        None => scallop,
    }
}

/// The distance of the machined contour from the part, in mm, at 1000 evenly spaced x, in mm.
#[must_use]
pub fn deviation_curve(material: &Material<'_>) -> Vec<[f64; 2]> {
    distances(&sampled(&corners(material)), material)
}

/// Distances of points from the part, over their x.
fn distances(points: &[Point2], material: &Material<'_>) -> Vec<[f64; 2]> {
    let profile = &material.plan.profile;
    let distance = |&point: &Point2| [point.x, profile.nearest_distance(point)];
    points.iter().map(distance).collect()
}

/// The smallest limit of any operation to what stays on the part, in mm.
fn limit(material: &Material<'_>) -> Option<f64> {
    let (_, limit) = material.plan.scallop_limit()?;
    Some(limit.value.to_mm())
}

/// How machined contour and part correlate over the lag (`picture::correlation`) [Cui fig. 15].
#[must_use]
pub fn correlation(material: &Material<'_>, ids: Prefix) -> String {
    let profile = &material.plan.profile;
    let sampled = Sampled::of(&corners(material), profile.points());
    let subtitle = format!(
        "machined contour and part at {SAMPLES} points, {:.3} mm apart",
        stock(material)[0] / f64::from(SAMPLES - 1)
    );
    correlation::draw(&correlation::Correlation {
        heading: correlation::Heading {
            ids,
            title: &format!("{}: cross-correlation of the contours", material.plan.name),
            subtitle: &subtitle,
        },
        values: &sampled.correlations(),
    })
}

/// The machined contour, from left to right.
fn corners(material: &Material<'_>) -> Vec<Point2> {
    let program = material.compiled.program.verified();
    verdict::replay(material.plan, program)
        .surface
        .corners()
        .collect()
}

/// Where the left flank comes out, the tip, and where the right flank comes out: the ends of a chip's outline. None of a strip,
/// which no flanks rise from.
fn vee(chip: &Taken) -> Option<[[f64; 2]; 3]> {
    let (&[right, tip], &left) = match chip.by {
        By::Flanks => (chip.shown.outline.last_chunk()?, chip.shown.outline.first()?),
        By::Disc => return None,
    };
    Some([left, tip, right])
}

fn stock(material: &Material<'_>) -> [f64; 2] {
    let stock = material.plan.stock;
    [stock.width.to_mm(), stock.height.to_mm()]
}

fn pair(point: Point2) -> [f64; 2] {
    [point.x, point.z]
}

fn pairs(points: &[Point2]) -> Vec<[f64; 2]> {
    points.iter().copied().map(pair).collect()
}

/// Layers by number, those of several operations as `operation.layer`, at the height of their lowest tip or floor. Slits may
/// reach through more than their layer.
fn layers(material: &Material<'_>) -> Vec<(String, f64)> {
    let several = material.plan.operations.len() > 1;
    let mut layers = Vec::new();
    for (operation, planned) in (1_u32..).zip(&material.plan.operations) {
        for layer in planned.tips().chunk_by(|a, b| a.layer == b.layer) {
            let number = layer.first().map_or(0, |cut| cut.layer);
            let name = if several {
                format!("{operation}.{number}")
            } else {
                number.to_string()
            };
            // The tip of a disc is the centre of its edge, which a lead holds above the floor.
            let floor = |cut: &PlannedTip| match cut.shape {
                CutShape::Plain | CutShape::Narrowed { .. } => Some(cut.tip.z),
                CutShape::Slit { .. } => None,
                CutShape::Strip(strip) => Some(strip.low.z),
                CutShape::Track { contact, .. } => Some(contact.z),
            };
            let lowest = layer.iter().filter_map(floor).reduce(f64::min);
            let lowest = lowest.or_else(|| layer.iter().map(|cut| cut.tip.z).reduce(f64::min));
            let Some(lowest) = lowest else { continue };
            layers.push((name, lowest));
        }
    }
    layers
}

/// How the cuts are laid out, in words.
#[must_use]
pub fn laid_out(material: &Material<'_>) -> String {
    let report = &material.compiled.report;
    let (cuts, layers) = (report.cuts(), report.layers.len());
    let layers = counted(layers, "layer");
    match &material.plan.operations[..] {
        [planned] => {
            let [name, measures] = planned.layout();
            format!("{name}, {layers}; {measures}")
        }
        _ => format!(
            "{} in {layers} of {} operations",
            counted(cuts, "cut"),
            material.plan.operations.len()
        ),
    }
}
