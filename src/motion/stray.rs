//! How far rotary axes lead the blade from the postures of a chain.
//!
//! On a piece of a chain the blade turns about one fixed axis ([`vcutc_backend_api::ir::Action::Follow`]), and that is what the
//! proof of the contour looks at. Rotary axes that go each at a constant rate ([`super::path::five_axis`]) lead from the same
//! posture to the same posture, but not through the same ones between. Where a single axis turns the blade, both ways are the
//! same: a C axis about the vertical, say. Elsewhere they are apart by about an eighth of the square of the turn.
//!
//! **Proof.** Let `R(s)` be the posture that the program states and `Q(s)` that of the axes, in the work. A point of the blade
//! at the distance `r` from the tip is off its place by `|(Q - R) p| <= r |Q - R|`, and for rotations that norm is the Frobenius
//! norm over the root of two. With `b` the angle of the turn and `w = sum |c_i|` that of the axes, `|R''| <= b^2` and
//! `|Q''| <= w^2` (Leibniz, as for the linear axes), so on a stretch `h` of the piece the distance exceeds the greater one at
//! both ends by no more than `r (b^2 + w^2) h^2 / 8`. Stretches are halved until that is less than [`FINE`].

use super::rig::Rig;
use super::rigs::Rigs;
use super::sweep::GRAZE;
use core::f64::consts::FRAC_1_SQRT_2;
use glam::DMat3;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Action, OpId, Program};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_machine::kinematics::Joints;

/// How far (mm) a point of the blade may be from where the program has it.
pub const LARGEST: f64 = GRAZE;
/// Stretches are not divided any further when points between their ends are off by no more than this beyond them, in mm.
const FINE: f64 = LARGEST / 10.0;

/// A piece of a chain on which the axes lead the blade from the postures of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stray {
    pub op: OpId,
    /// Where on the piece it is farthest off, from 0 to 1.
    pub at: f64,
    /// How far off a point of the blade is there.
    pub by: Length,
}

/// Proves that the blade is held along all chains as the program says, within [`LARGEST`] of each of its points. `ends` are
/// the axes at the end of every op, and the rig's rotary axes go evenly between them.
///
/// # Errors
/// The first piece on which it is not.
pub(super) fn none(program: &VerifiedProgram, rigs: &Rigs<'_>, ends: &[Joints]) -> Result<(), Stray> {
    let program = program.program();
    let pieces = program
        .segments()
        .filter(|segment| matches!(segment.op.action, Action::Follow { .. }));
    for segment in pieces {
        let Some(turn) = Turn::of(program, rigs.during(segment.id), ends, &segment) else {
            continue;
        };
        if let Some((at, by)) = turn.strays() {
            return Err(Stray {
                op: segment.id,
                at,
                by: Length::mm(by),
            });
        }
    }
    Ok(())
}

/// A piece on which the blade turns.
struct Turn<'t, 'm> {
    rig: &'t Rig<'m>,
    held: [Orientation; 2],
    axes: [Joints; 2],
    /// How far the points of the blade are from its tip at most, in mm.
    radius: f64,
}

impl<'t, 'm> Turn<'t, 'm> {
    fn of(program: &Program, rig: &'t Rig<'m>, ends: &[Joints], segment: &Segment<'_>) -> Option<Self> {
        let line = segment.line().filter(|line| line.turns())?;
        let index = segment.id.0 as usize;
        let hull = program.blade(segment.before.tool)?.hull();
        let farthest = |number: usize| hull.iter().map(|point| point[number].abs()).fold(0.0, f64::max);
        let half_width = libm::hypot(farthest(0), farthest(1));
        let height = farthest(2).max(-rig.flange_in_blade.position.z);
        Some(Self {
            rig,
            held: [
                program.orientation(line.from.orientation)?,
                program.orientation(line.to.orientation)?,
            ],
            axes: [*ends.get(index.checked_sub(1)?)?, *ends.get(index)?],
            radius: libm::hypot(half_width, height),
        })
    }

    /// Where a point of the blade is too far off, and how far, where it is farthest; none where none is.
    fn strays(&self) -> Option<(f64, f64)> {
        let bend = self.bend();
        let mut rest = vec![(0.0, 1.0)];
        while let Some((from, to)) = rest.pop() {
            let beyond = bend * (to - from) * (to - from) / 8.0;
            let off = self.off(from).max(self.off(to));
            if off > LARGEST || (beyond <= FINE && off + beyond > LARGEST) {
                return Some(self.farthest());
            }
            if off + beyond > LARGEST {
                let middle = f64::midpoint(from, to);
                rest.extend([(middle, to), (from, middle)]);
            }
        }
        None
    }

    /// How fast the distance of a point from its place bends at most, in mm a piece squared.
    fn bend(&self) -> f64 {
        let [from, to] = self.axes;
        let by_axes: f64 = from
            .iter()
            .zip(to)
            .skip(3)
            .map(|(from, to)| (to - from).abs())
            .sum();
        let [start, end] = self.held;
        let turn = start.angle_to(end).to_rad();
        self.radius * (by_axes * by_axes + turn * turn)
    }

    /// How far a point of the blade is from its place at most, at a place of the piece.
    fn off(&self, place: f64) -> f64 {
        let [start, end] = &self.axes;
        let joints = core::array::from_fn(|axis| start[axis] + (end[axis] - start[axis]) * place);
        let is = self.rig.blade_in_work(&joints).rotation;
        let [from, to] = self.held;
        let should = matrix(from.towards(to, place));
        let apart = (is - should).to_cols_array();
        let square: f64 = apart.iter().map(|part| part * part).sum();
        self.radius * FRAC_1_SQRT_2 * square.sqrt()
    }

    /// Where a point is farthest off, and how far, among samples: for people.
    fn farthest(&self) -> (f64, f64) {
        const SAMPLES: u32 = 256;
        (0..=SAMPLES)
            .map(|sample| f64::from(sample) / f64::from(SAMPLES))
            .map(|place| (place, self.off(place)))
            .fold((0.0, 0.0), |most, here| if here.1 > most.1 { here } else { most })
    }
}

fn matrix(orientation: Orientation) -> DMat3 {
    DMat3::from_cols_array_2d(&orientation.matrix()).transpose()
}

#[cfg(test)]
mod tests;
