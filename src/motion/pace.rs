//! Pace: how long the machine takes for every op of a program.
//!
//! What emitted programs ask of a controller is followed. Every motion but those of chains begins and ends at rest: KRL without `C_DIS`, RAPID with
//! `fine`, G-code with `G61.1`, `G61` or `G60`; rounding
//! (`approximation`) is off unless asked for; a rounded corner takes less time than is computed here. Where an ABB program is given
//! [waypoints](vcutc_backend_api::motion::Waypoint) it stops at each of them.
//!
//! - **Straight motions and turns.** Tip and blade move together: both do the same part `u` of their way at any time, and the
//!   slower decides. The programmed feed and rate bound `u'`; so do the path's acceleration and jerk, over the way of the tip
//!   and the angle of the blade. Without numbers of the axes the profile is closed ([`profile`]). With their accelerations it
//!   is the fastest that the axes can follow ([`phase`]), with jerk one that is proven and close to it ([`smooth`]); how the
//!   axes move along the way comes from [`track`].
//! - **Chains** are gone from rest at their beginning to rest at their end ([`chain`]).
//! - **Axis moves** are synchronous: all axes do the same part of their way, so that the one that needs longest decides.
//! - **The rest** waits as long as it says.
//!
//! A sheet without accelerations leaves speeds alone: stopping and starting then take no time ([`Kept`]). Nothing is assumed that
//! a sheet does not say.

mod chain;
mod chebyshev;
mod phase;
mod profile;
mod smooth;
#[cfg(test)]
mod tests;
mod track;

use crate::moves::{numbered, paths};
use crate::path::{Course, Followed};
use crate::rigs::Rigs;
use chain::{Limits, Piece};
use chebyshev::Weights;
use profile::Bounds;
use rayon::prelude::*;
use track::Part;
use vcutc_backend_api::ir::{Action, Axis, Joint, MOST_AXES, Maker, OpId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_machine::Model;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::path_limits::PathLimits;
use vcutc_simulation::timing::op_times;

/// What of a machine the times of a program keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// Programmed speeds and highest rates of axes: starting and stopping take no time.
    Speeds,
    /// The accelerations that the machine's sheet states, too.
    Accelerations,
    /// The jerks that it states, too.
    Jerks,
}

/// What the times of a program are based on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Basis {
    /// What they keep.
    pub kept: Kept,
    /// How many axis moves have no time: the machine, where they begin, or the rate of an axis is not known.
    pub untimed: usize,
    /// How many straight motions and turns have their programmed time after all: the axes could not be followed along them.
    pub unfollowed: usize,
}

/// How long a program takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Paced {
    /// How long each op takes, in the order of the program; nothing for those whose time is not known.
    pub times: Vec<Duration>,
    /// What that is based on.
    pub basis: Basis,
}

/// The times of a program that no machine carries out: at programmed speeds.
#[must_use]
pub fn programmed(program: &VerifiedProgram) -> Paced {
    Paced {
        times: op_times(program),
        basis: Basis {
            kept: Kept::Speeds,
            untimed: (program.program().segments())
                .filter(|segment| segment.path().is_of_axes())
                .count(),
            unfollowed: 0,
        },
    }
}

/// The times of a program on its machine.
#[must_use]
pub fn paced(reached: &ReachableProgram, model: &Model) -> Paced {
    let mut paced = programmed(reached.verified());
    let Some(cell) = &reached.program().cell else {
        return paced;
    };
    let clock = Clock {
        reached,
        rigs: Rigs::of(model, cell, reached.program()),
        maker: cell.maker,
        axes: axis_bounds(&model.axes),
        path: model.path,
        weights: Weights::new(),
    };
    let paths = paths(reached.program());
    let known: Vec<Option<f64>> = paths
        .par_iter()
        .enumerate()
        .map(|(index, path)| clock.path(OpId(u32::try_from(index).ok()?), path))
        .collect();
    let known = clock.with_chains(&paths, known);
    paced.basis = Basis {
        kept: clock.kept(),
        untimed: 0,
        unfollowed: 0,
    };
    for ((path, known), time) in paths.iter().zip(known).zip(&mut paced.times) {
        match (path, known) {
            (Path::Still, _) => {}
            (_, Some(seconds)) => *time = Duration::s(seconds),
            (Path::Home | Path::Change | Path::Axes(_), None) => paced.basis.untimed += 1,
            (Path::Linear(_), None) => paced.basis.unfollowed += 1,
        }
    }
    paced
}

fn axis_bounds(axes: &[Axis]) -> [Bounds; MOST_AXES] {
    core::array::from_fn(|index| {
        axes.get(index).map_or_else(Bounds::default, |axis| Bounds {
            rate: axis.rate,
            acceleration: axis.acceleration,
            jerk: axis.jerk,
        })
    })
}

/// All that times depend on.
struct Clock<'r> {
    reached: &'r ReachableProgram,
    rigs: Rigs<'r>,
    maker: Maker,
    axes: [Bounds; MOST_AXES],
    path: PathLimits,
    weights: Weights,
}

impl Clock<'_> {
    fn kept(&self) -> Kept {
        let path = [
            Bounds {
                rate: None,
                acceleration: self.path.acceleration,
                jerk: self.path.jerk,
            },
            Bounds {
                rate: None,
                acceleration: self.path.turning_acceleration,
                jerk: self.path.turning_jerk,
            },
        ];
        let all = || self.axes.iter().chain(&path);
        if all().any(|bounds| bounds.jerk.is_some()) {
            Kept::Jerks
        } else if all().any(|bounds| bounds.acceleration.is_some()) {
            Kept::Accelerations
        } else {
            Kept::Speeds
        }
    }

    /// How long an op takes, in s.
    fn path(&self, op: OpId, path: &Path) -> Option<f64> {
        let start = self.reached.axes_before(op).map(|start| start.0);
        match path {
            Path::Still => None,
            Path::Home | Path::Change | Path::Axes(_) => {
                self.by_axes(&start?, &self.reached.axes_after(op)?.0)
            }
            Path::Linear(line) => match self.kept() {
                Kept::Speeds => Some(line.duration().to_s()),
                // With the whole of their chain.
                Kept::Accelerations | Kept::Jerks if self.joint(op).is_some() => None,
                Kept::Accelerations | Kept::Jerks => self.along(op, line, &start?),
            },
        }
    }

    /// All axes at once, each straight to its value.
    fn by_axes(&self, from: &Joints, to: &Joints) -> Option<f64> {
        let mut bounds = Bounds::default();
        for (axis, (from, to)) in self.axes.iter().zip(from.iter().zip(to)) {
            let way = (to - from).abs();
            if way > 0.0 {
                axis.rate?;
                bounds = bounds.and(axis.over(way));
            }
        }
        match bounds.rate {
            Some(_) => bounds.duration(1.0),
            None => Some(0.0),
        }
    }

    /// A straight motion or a turn, from stop to stop.
    fn along(&self, op: OpId, line: &LinearSegment, start: &Joints) -> Option<f64> {
        let moves_axes = |bounds: &Bounds| bounds.acceleration.is_some() || bounds.jerk.is_some();
        if !self.axes.iter().any(moves_axes) {
            return self
                .stops(op)
                .windows(2)
                .map(|ends| self.path_bounds(line, share(ends)).duration(1.0))
                .sum();
        }
        let end = self.reached.axes_after(op)?.0;
        let course = Course::of(self.reached.program(), line)?;
        let branch = self.reached.branch_after(op)?;
        let followed = Followed::new(self.rigs.during(op), &course, branch, [start, &end])?;
        let mut near = *start;
        let mut seconds = 0.0;
        for ends in self.stops(op).windows(2) {
            let share = share(ends);
            let begin = ends.first().copied().unwrap_or_default();
            let parts = track::parts(&self.weights, &near, |place, near| {
                followed.joints_at(begin + share * place, near)
            })?;
            seconds += self.portion(&parts, self.path_bounds(line, share))?;
            near = followed.joints_at(begin + share, &near)?;
        }
        Some(seconds)
    }

    /// How a piece of a chain ends; none for other ops.
    fn joint(&self, op: OpId) -> Option<Joint> {
        let Action::Follow { joint, .. } = self.reached.program().op(op)?.action else {
            return None;
        };
        Some(joint)
    }

    /// The times of ops with those of the pieces of chains, which have none so far where speed is gathered.
    fn with_chains(&self, paths: &[Path], mut known: Vec<Option<f64>>) -> Vec<Option<f64>> {
        match self.kept() {
            Kept::Speeds => return known,
            Kept::Accelerations | Kept::Jerks => {}
        }
        let mut chain: Vec<(OpId, &LinearSegment)> = Vec::new();
        let mut chains = Vec::new();
        for (op, path) in numbered(paths) {
            let (Some(joint), Some(line)) = (self.joint(op), path.line()) else {
                continue;
            };
            chain.push((op, line));
            match joint {
                Joint::Through => {}
                Joint::Stop => chains.push(core::mem::take(&mut chain)),
            }
        }
        let found: Vec<(OpId, Option<f64>)> = chains
            .into_par_iter()
            .flat_map_iter(|chain| {
                let times = self.chain(&chain);
                let ops = chain.into_iter().enumerate();
                ops.map(move |(index, (op, _))| {
                    (op, times.as_ref().and_then(|times| times.get(index).copied()))
                })
            })
            .collect();
        for (op, time) in found {
            if let Some(known) = known.get_mut(op.0 as usize) {
                *known = time;
            }
        }
        known
    }

    /// How long each piece of a chain takes, in s.
    fn chain(&self, chain: &[(OpId, &LinearSegment)]) -> Option<Vec<f64>> {
        let pieces: Option<Vec<Piece>> = chain.iter().map(|(op, line)| self.piece(*op, line)).collect();
        let program = self.reached.program();
        let limits = Limits {
            axes: program.cell.as_ref().map_or(&[], |cell| &cell.axes),
            tracks: chain::tracks(&self.axes, &self.path),
            blend: program.blend.to_mm(),
            kept: self.kept(),
        };
        chain::times(&pieces?, &limits)
    }

    fn piece(&self, op: OpId, line: &LinearSegment) -> Option<Piece> {
        let program = self.reached.program();
        let length = line.length().to_mm();
        let [from, to] = [line.from, line.to].map(|pose| program.orientation(pose.orientation));
        let spin = from?.rotation_to(to?).map(|turn| turn / length);
        let start = self.reached.axes_before(op)?.0;
        let end = self.reached.axes_after(op)?.0;
        let course = Course::of(program, line)?;
        let branch = self.reached.branch_after(op)?;
        let followed = Followed::new(self.rigs.during(op), &course, branch, [&start, &end])?;
        let parts = track::parts(&self.weights, &start, |place, near| {
            followed.joints_at(place, near)
        })?;
        Some(Piece {
            length,
            feed: line.feed?.to_mm_per_s(),
            rate: line.rate.map(|rate| rate.to_rad_per_s()),
            bend: line.arc().map_or(0.0, |arc| 1.0 / arc.radius().to_mm()),
            spin,
            parts: parts.into_iter().map(|part| part.over(length)).collect(),
        })
    }

    fn portion(&self, parts: &[Part], path: Bounds) -> Option<f64> {
        let rate = path.rate?;
        match self.kept() {
            Kept::Speeds | Kept::Accelerations => Some(phase::duration(parts, &self.axes, rate, path)),
            Kept::Jerks => smooth::ride(parts, &self.axes, rate, path).map(|ride| ride.time),
        }
    }

    /// Bounds of the part of a motion that is done, or of a share of the motion.
    fn path_bounds(&self, line: &LinearSegment, share: f64) -> Bounds {
        let tip = Bounds {
            rate: None,
            acceleration: self.path.acceleration,
            jerk: self.path.jerk,
        };
        let blade = Bounds {
            rate: None,
            acceleration: self.path.turning_acceleration,
            jerk: self.path.turning_jerk,
        };
        let programmed = Bounds {
            rate: Some(1.0 / (line.duration().to_s() * share)),
            ..Bounds::default()
        };
        programmed
            .and(tip.over(line.length().to_mm() * share))
            .and(blade.over(line.turn.to_rad() * share))
    }

    /// Where on the way of an op the machine stops, from 0 to 1.
    fn stops(&self, op: OpId) -> Vec<f64> {
        let waypoints = match self.maker {
            Maker::Abb => &self.reached.motion().waypoints[..],
            Maker::Kuka | Maker::Other => &[],
        };
        let first = waypoints.partition_point(|waypoint| waypoint.op < op);
        let own = waypoints
            .iter()
            .skip(first)
            .take_while(|waypoint| waypoint.op == op);
        let between = own.map(|waypoint| waypoint.done);
        core::iter::once(0.0)
            .chain(between)
            .chain(core::iter::once(1.0))
            .collect()
    }
}

/// How much of a motion lies between two stops.
fn share(ends: &[f64]) -> f64 {
    match ends {
        [begin, end] => end - begin,
        _ => 0.0,
    }
}
