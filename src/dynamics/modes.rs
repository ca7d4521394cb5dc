//! How an arm swings on its joints: its modes, each with its frequency.
//!
//! The control holds the motors in place, so the links swing on the springs of the joints: `M x'' + K x = 0` at the controller's axes, with
//! the mass matrix `M` of [Ha 2019], equations 20 to 22, and the stiffness `K`. What turns with the motors stands still and does not count.
//! `K` is diagonal, so `K^-1/2 M K^-1/2` is symmetric; its eigenvalues are `1 / w^2` of the modes.

pub mod cells;
pub mod figures;
pub mod meeting;
mod samples;
pub mod swings;
pub mod teeth;

use crate::arm::{Arm, State};
use crate::chain::JOINTS;
use crate::springs::Springs;
use core::array;
use core::f64::consts::TAU;
use nalgebra::{SMatrix, SymmetricEigen};
use vcutc_machine::kinematics::Joints;

/// Most steps of the search for eigenvalues; six of them take about a dozen.
const MOST_STEPS: usize = 1000;

/// An arm whose smallest eigenvalue is below this share of the largest has a joint that carries no mass.
const MASSLESS: f64 = 1e-13;

/// A way in which an arm swings by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// In Hz.
    pub frequency: f64,
    /// How far each of the controller's axes swings, in rad for an energy of 1/2 J; the largest of them is positive.
    pub swings: [f64; JOINTS],
}

impl Arm {
    /// How hard each axis is to move by itself and with each other: column by column the torques at the controller's axes for 1 rad/s2 of
    /// one of them, in kg m2.
    #[must_use]
    pub fn mass_matrix(&self, joints: &Joints) -> [[f64; JOINTS]; JOINTS] {
        let weightless = self.weightless();
        let turns = self.turns(joints);
        array::from_fn(|axis| {
            weightless.torques(&State {
                turns,
                rates: [0.0; JOINTS],
                accelerations: array::from_fn(|other| if other == axis { 1.0 } else { 0.0 }),
            })
        })
    }

    /// The modes of the arm on these springs, as they are stated, from the slowest on. None where masses are missing: a joint that moves
    /// none has no mode.
    #[must_use]
    pub(crate) fn modes(&self, joints: &Joints, springs: &Springs) -> Option<[Mode; JOINTS]> {
        let masses = self.mass_matrix(joints);
        let yields: [f64; JOINTS] = array::from_fn(|axis| libm::sqrt(springs.each()[axis].stated));
        let scaled = SMatrix::<f64, JOINTS, JOINTS>::from_fn(|row, column| {
            yields[row] * masses[column][row] * yields[column]
        });
        if !scaled.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let found = SymmetricEigen::try_new(scaled, f64::EPSILON, MOST_STEPS)?;
        let largest = found.eigenvalues.max();
        let mut order: [usize; JOINTS] = array::from_fn(|place| place);
        order.sort_by(|one, other| found.eigenvalues[*other].total_cmp(&found.eigenvalues[*one]));
        let modes = order.map(|place| {
            let eigenvalue = found.eigenvalues[place];
            let swings = array::from_fn(|axis| yields[axis] * found.eigenvectors[(axis, place)]);
            (eigenvalue > MASSLESS * largest).then(|| Mode {
                frequency: 1.0 / (TAU * libm::sqrt(eigenvalue)),
                swings: one_way(swings),
            })
        });
        let [a, b, c, d, e, f] = modes;
        Some([a?, b?, c?, d?, e?, f?])
    }
}

impl Mode {
    /// The axis whose spring yields most, and its share of the energy.
    pub(crate) fn softest(&self, springs: &Springs) -> (usize, f64) {
        let each = self.swings.iter().zip(springs.each());
        let mut energies = [0.0; JOINTS];
        for (energy, (swing, spring)) in energies.iter_mut().zip(each) {
            *energy = swing * swing / spring.stated;
        }
        Springs::softest(energies)
    }
}

/// Of a swing and its reverse the one whose largest part is positive.
fn one_way(swings: [f64; JOINTS]) -> [f64; JOINTS] {
    let larger = |most: f64, next: f64| if next.abs() > most.abs() { next } else { most };
    let sign = swings.into_iter().fold(0.0, larger).signum();
    swings.map(|swing| sign * swing)
}

#[cfg(test)]
pub(crate) mod tests;
