//! The sound field that passes of a pocket follow.

use super::ways::points;
use crate::Material;
use vcutc_field::axis::{Detail, axis};
use vcutc_field::field::Field;
use vcutc_field::lines::lines;
use vcutc_field::source::Tuning;
use vcutc_field::wave::surface;
use vcutc_job::{SoundField, Sources};
use vcutc_picture::Prefix;
use vcutc_picture::wave::{self, Heading, Wave};
use vcutc_region::piece::Piece;

/// Cells to a step: a wave is two steps long.
const CELLS: f64 = 6.0;

/// The axis of a region may be off its pieces by so much of a step, and the gain of a field is 1 so many steps from its sources: as
/// passes of a field have them.
const AXIS_OFF: f64 = 0.01;
const REFERENCE: f64 = 3.0;

/// The wave of the first pocket that is cleared along a sound field (`picture::wave`); none of a job without such a pocket.
#[must_use]
pub fn wave(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let planned = material.plan.operations.iter();
    let mut followed = planned.filter_map(|planned| planned.sound_field());
    let SoundField {
        region,
        step,
        lift,
        sources,
        radius,
    } = followed.next()?;
    let detail = match sources {
        Sources::OnAxis => Detail::True,
        Sources::Simplified => Detail::Simplified,
    };
    let step = step.to_mm();
    let tuning = Tuning {
        step,
        lift: lift.to_mm(),
        reference: REFERENCE * step,
    };
    let axis = axis(&region, detail, AXIS_OFF * step).ok()?;
    let field = Field::new(&axis.segments, &tuning).ok()?;
    let pitch = step / CELLS;
    let surface = surface(&region, &field, radius.to_mm(), pitch).ok()?;
    let grid = &surface.grid;
    let edge = |low: f64, number: usize| low + (number as f64 - 0.5) * pitch;
    let low = grid.place(0, 0);
    let columns: Vec<f64> = (0..=grid.columns).map(|column| edge(low.x, column)).collect();
    let rows: Vec<f64> = (0..=grid.rows).map(|row| edge(low.y, row)).collect();
    let drawn = lines(&region, &field, radius.to_mm()).ok()?;
    let along =
        |pieces: &[Piece]| -> Vec<[f64; 2]> { pieces.iter().flat_map(|piece| points(*piece)).collect() };
    let zero: Vec<Vec<[f64; 2]>> = drawn.iter().map(|line| along(&line.pass.pieces)).collect();
    let walls: Vec<Vec<[f64; 2]>> = region.edges().map(|edge| along(&[edge.piece])).collect();
    Some(wave::draw(&Wave {
        heading: Heading {
            ids,
            title: &format!("{}: sound field of the pocket", material.plan.name),
            subtitle: &format!(
                "{} zero lines, {step} mm apart, {} mm over {} sources",
                drawn.len(),
                lift.to_mm(),
                field.sources().len()
            ),
        },
        edges: [&columns, &rows],
        heights: &surface.heights,
        lines: &zero,
        walls: &walls,
    }))
}
