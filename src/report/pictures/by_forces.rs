//! How far the forces of blades push cuts off, along the profile.

use crate::Material;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_driver::dynamics::cut_by_cut;
use vcutc_driver::summary;
use vcutc_dynamics::cuts::Face;
use vcutc_dynamics::deviation::each::CutDeviation;
use vcutc_dynamics::deviation::figures::{DeviationFigures, OperationDeviation, ShiftFigure};
use vcutc_picture::{Prefix, by_forces};

/// The deviation of each cut by the forces of its blade (`picture::by_forces`); none where that is not known, and for regions,
/// which have no profile.
#[must_use]
pub fn by_forces<const PLACES: usize>(
    material: &Material<'_>,
    ids: [Prefix; PLACES],
) -> Option<[String; PLACES]> {
    let mut figures = material.compiled.dynamics.deviation.clone()?;
    if summary::is_of_regions(material.plan) {
        return None;
    }
    let planned = &material.plan.operations;
    figures.operations.retain(|of| {
        let planned = planned.get(usize::from(of.operation));
        planned.is_some_and(|planned| !summary::is_of_a_region(&**planned))
    });
    if figures.operations.is_empty() {
        return None;
    }
    let program = material.compiled.program.verified().program();
    let each = cut_by_cut(material.job, material.compiled, &figures)?;
    let cuts: Option<Vec<by_forces::Cut>> = each.iter().map(|cut| shown(cut, program)).collect();
    let (cuts, most, limits) = (cuts?, most(&figures, program), limits(&figures));
    let title = format!("{}: deviation by the forces of the blade", material.plan.name);
    let model = material
        .job
        .machine
        .as_ref()
        .map_or("", |machine| machine.model.name.as_str());
    let subtitle = format!("{model}; stiffness {}", figures.stiffness.word());
    Some(ids.map(|ids| {
        by_forces::draw(&by_forces::ByForces {
            heading: by_forces::Heading {
                ids,
                title: &title,
                subtitle: &subtitle,
            },
            width: material.plan.stock.width.to_mm(),
            cuts: &cuts,
            most: &most,
            limits: &limits,
        })
    }))
}

fn shown(cut: &CutDeviation, program: &Program) -> Option<by_forces::Cut> {
    Some(by_forces::Cut {
        x: place(program, cut.op)?,
        face: match cut.face {
            Face::Left => by_forces::Face::Left,
            Face::Right => by_forces::Face::Right,
            Face::Upright => by_forces::Face::Upright,
        },
        // A cut that is pushed one way alone counts from zero: where it enters, nothing pushes.
        range: [-cut.into_part, cut.into_waste],
    })
}

/// The x of a cut's tip in the middle of its way, in mm.
fn place(program: &Program, op: OpId) -> Option<f64> {
    let line = program.segment(op)?.line()?;
    Some(line.from.tip.x.midpoint(line.to.tip.x))
}

/// The most into the waste and into the part, with its x.
fn most(figures: &DeviationFigures, program: &Program) -> Vec<[f64; 2]> {
    let worst = |side: fn(&OperationDeviation) -> &ShiftFigure, sign: f64| {
        let all = figures.operations.iter().map(side);
        let worst = all.max_by(|one, other| one.most.total_cmp(&other.most))?;
        Some([place(program, OpId(worst.at.op))?, sign * worst.most])
    };
    let both = [worst(|of| &of.into_waste, 1.0), worst(|of| &of.into_part, -1.0)];
    both.into_iter()
        .flatten()
        .filter(|[_, most]| *most != 0.0)
        .collect()
}

/// The limits of the operations, each once.
fn limits(figures: &DeviationFigures) -> Vec<f64> {
    let mut limits: Vec<f64> = figures.operations.iter().filter_map(|of| of.limit).collect();
    limits.sort_by(f64::total_cmp);
    limits.dedup();
    limits
}
