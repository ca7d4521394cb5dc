//! What a program asks of the drives of an arm: torques at places along it, at the programmed speeds.
//!
//! Between places nothing is proven. Rates and accelerations of the axes are found from the places before and after on the same
//! motion, so the torques of starting and stopping are not among them. On arcs the control slows down as the way bends, by how much
//! only it knows: there, as in moves of all axes, the weight alone is counted.

use crate::arm::{JOINTS, State};
use crate::arms::Arms;
use core::convert::Infallible;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_machine::kinematics::Joints;
use vcutc_motion::moves::paths;
use vcutc_motion::parts::even_time;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::trajectory::{Motion, Sample, Spacing, motions};

/// The torques of all axes in a place, in Nm, as the controller counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Torques {
    /// What the arm needs to stand still there.
    pub weight: [f64; JOINTS],
    /// What else it needs to move as it does.
    pub motion: [f64; JOINTS],
    /// What it needs against the forces of the blade, where these count.
    pub cutting: [f64; JOINTS],
}

impl Torques {
    /// All that an axis needs.
    #[must_use]
    pub fn of(&self, axis: usize) -> f64 {
        let part = |torques: &[f64; JOINTS]| torques.get(axis).copied().unwrap_or_default();
        part(&self.weight) + part(&self.motion) + part(&self.cutting)
    }
}

/// The most that an axis needs, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Most {
    pub op: OpId,
    /// How much of that op is done there, from 0 to 1; none where so little is needed that the place was not looked for.
    pub done: Option<f64>,
    pub torques: Torques,
    /// It needs nowhere more than this, either way; where only places are looked at, in none of them.
    pub most: f64,
}

/// A program on an arm of known weight.
#[derive(Debug)]
pub struct Drives<'m> {
    rigs: &'m Rigs<'m>,
    arms: &'m Arms,
    /// How long each op takes in s that goes straight; none of others, whose course in time is not known.
    durations: Vec<Option<f64>>,
}

impl<'m> Drives<'m> {
    #[must_use]
    pub fn of(rigs: &'m Rigs<'m>, arms: &'m Arms, program: &Program) -> Self {
        let durations = paths(program).iter().map(even_time).collect();
        Self {
            rigs,
            arms,
            durations,
        }
    }

    /// The most that each axis needs in places along the way; none of a program that moves nothing.
    #[must_use]
    pub(crate) fn most_in_places(&self, reached: &ReachableProgram) -> Option<[Most; JOINTS]> {
        let mut most: Option<[Most; JOINTS]> = None;
        let of_motion = |motion: Motion| {
            let places = self.places(&motion).into_iter();
            places
                .map(|(sample, torques)| {
                    core::array::from_fn(|axis| Most {
                        op: sample.op,
                        done: Some(sample.done),
                        torques,
                        most: torques.of(axis).abs(),
                    })
                })
                .reduce(larger)
        };
        let kept: Result<(), Infallible> = motions(reached, self.rigs, &Spacing::APART, of_motion, |found| {
            most = most.into_iter().chain(found).reduce(larger);
            Ok(())
        });
        let Ok(()) = kept;
        most
    }

    /// The torques at every place of a program, in order.
    ///
    /// # Errors
    /// What `take` returns.
    pub fn along<E>(
        &self,
        reached: &ReachableProgram,
        spacing: &Spacing,
        mut take: impl FnMut(&Sample, &Torques) -> Result<(), E>,
    ) -> Result<(), E> {
        let places = |motion: Motion| self.places(&motion);
        motions(reached, self.rigs, spacing, places, |places| {
            places
                .iter()
                .try_for_each(|(sample, torques)| take(sample, torques))
        })
    }

    fn places(&self, motion: &Motion) -> Vec<(Sample, Torques)> {
        let Some(op) = motion.samples.first().map(|sample| sample.op) else {
            return Vec::new();
        };
        let Some(arm) = self.arms.with(self.rigs.tool_during(op)) else {
            return Vec::new();
        };
        let time = self.durations.get(op.0 as usize).copied().flatten();
        // The samples of a motion are as far apart as its start is from the first one.
        let step = time.map(|time| time / motion.samples.len() as f64);
        let place = |(number, sample): (usize, &Sample)| {
            let turns = arm.turns(&sample.joints);
            let weight = arm.weight_after(&turns);
            let moving = step.zip(motion.start).map(|(step, start)| {
                let (rates, accelerations) = course(&start, &motion.samples, number, step);
                arm.torques(&State {
                    turns,
                    rates,
                    accelerations,
                })
            });
            let motion = moving.map_or([0.0; JOINTS], |all| {
                core::array::from_fn(|axis| all[axis] - weight[axis])
            });
            let cutting = [0.0; JOINTS];
            (
                *sample,
                Torques {
                    weight,
                    motion,
                    cutting,
                },
            )
        };
        motion.samples.iter().enumerate().map(place).collect()
    }
}

fn larger(one: [Most; JOINTS], other: [Most; JOINTS]) -> [Most; JOINTS] {
    core::array::from_fn(|axis| {
        if other[axis].most > one[axis].most {
            other[axis]
        } else {
            one[axis]
        }
    })
}

/// Rates and accelerations at a sample, by differences over its neighbours, `step` apart in s. At the end of a motion, those of the
/// sample before.
fn course(start: &Joints, samples: &[Sample], number: usize, step: f64) -> (Joints, Joints) {
    let middle = number.min(samples.len().saturating_sub(2));
    let at = |place: usize| match place.checked_sub(1) {
        None => *start,
        Some(place) => samples.get(place).map_or(*start, |sample| sample.joints),
    };
    // The start is the place before the first sample.
    let (before, here, after) = (at(middle), at(middle + 1), at(middle + 2));
    if samples.len() < 2 {
        return (
            core::array::from_fn(|axis| (here[axis] - before[axis]) / step),
            [0.0; JOINTS],
        );
    }
    (
        core::array::from_fn(|axis| (after[axis] - before[axis]) / (2.0 * step)),
        core::array::from_fn(|axis| (after[axis] - 2.0 * here[axis] + before[axis]) / (step * step)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_accelerations_are_those_of_a_parabola() {
        let joints = |time: f64| core::array::from_fn(|axis| axis as f64 + 2.0 * time + 3.0 * time * time);
        let samples: Vec<Sample> = (1..=4)
            .map(|place| Sample {
                op: OpId(0),
                done: f64::from(place) / 4.0,
                joints: joints(0.1 * f64::from(place)),
            })
            .collect();
        for (number, time) in [(0, 0.1), (1, 0.2), (2, 0.3), (3, 0.3)] {
            let (rates, accelerations) = course(&joints(0.0), &samples, number, 0.1);
            assert!((rates[2] - (2.0 + 6.0 * time)).abs() < 1e-12, "{number}");
            assert!((accelerations[5] - 6.0).abs() < 1e-10, "{number}");
        }
        let (rates, accelerations) = course(&joints(0.0), &samples[..1], 0, 0.1);
        assert!((rates[0] - 2.3).abs() < 1e-12);
        assert_eq!(accelerations, [0.0; JOINTS]);
    }
}
