//! The ways to stand through a program's runs, as the rungs of a [`Ladder`].

use super::axis_range::{turn_to_middle, turns};
use super::demand::Demand;
use super::ladder::{Cost, Ladder};
use super::path::Proof;
use super::runs::{Station, StationKind};
use super::survey::{Carried, Survey, moved, travel, turns_between};
use super::way::{Obstacle, clear, is_refuted};
use vcutc_backend_api::ir::{Axis, MOST_AXES};
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::Joints;

/// A run on a branch.
#[derive(Clone, Debug)]
pub(super) struct OnBranch {
    pub(super) branch: Branch,
    pub(super) carried: Carried,
    /// The course that leads to the run, where one does and the branch carries it.
    pub(super) joined: Option<Proof>,
}

/// A way to stand through a station.
#[derive(Clone, Debug)]
pub(super) struct Rung {
    /// The run on its branch, as a place among those of the station; none at home.
    pub(super) on: Option<usize>,
    /// The turns by which the axes are moved on.
    pub(super) by: Joints,
    pub(super) start: Joints,
    pub(super) end: Joints,
}

/// Two rungs between which the axes cannot move at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Refused {
    /// The station that the way leads to.
    pub(super) station: usize,
    pub(super) obstacle: Obstacle,
}

/// Most ways to stand on one branch through one station.
const MOST_TURNED: usize = 32;

/// All ways through all stations.
pub(super) struct Ways<'w> {
    survey: &'w Survey<'w>,
    stations: &'w [Station],
    carried: &'w [Vec<OnBranch>],
    rungs: Vec<Vec<Rung>>,
    costs: Vec<Vec<Cost>>,
    /// The axis move that was refused first.
    pub(super) refused: Option<Refused>,
}

impl<'w> Ways<'w> {
    /// Gathers the ways. `carried` has for each station the branches that carry it, in their order; nothing where axis values are given.
    pub(super) fn new(survey: &'w Survey<'w>, stations: &'w [Station], carried: &'w [Vec<OnBranch>]) -> Self {
        let axes = survey.rig.axes;
        let rungs: Vec<Vec<Rung>> = stations
            .iter()
            .zip(carried)
            .map(|(station, carried)| match station.kind {
                StationKind::Home(joints) | StationKind::Change(joints) => vec![standing(joints)],
                StationKind::Run(_) | StationKind::Joined(_) => (0..)
                    .zip(carried)
                    .flat_map(|(on, run)| rungs_of(on, &run.carried, axes))
                    .collect(),
            })
            .collect();
        let costs = rungs.iter().zip(carried).map(|(rungs, carried)| {
            rungs
                .iter()
                .map(|rung| match rung.on.and_then(|on| carried.get(on)) {
                    Some(run) => Cost {
                        margin: run.carried.demand.turned(&rung.by).margin(axes),
                        changes: 0,
                        travel: run.carried.travel,
                    },
                    None => FREE,
                })
                .collect()
        });
        Self {
            survey,
            stations,
            carried,
            costs: costs.collect(),
            rungs,
            refused: None,
        }
    }

    pub(super) fn rung(&self, station: usize, rung: usize) -> Option<&Rung> {
        self.rungs.get(station)?.get(rung)
    }

    /// The run that a rung stands for; none at home.
    pub(super) fn on(&self, station: usize, rung: usize) -> Option<&'w OnBranch> {
        let on = self.rung(station, rung)?.on?;
        self.carried.get(station)?.get(on)
    }

    /// What the course into a station asks of the machine, if it leads from the one rung to the other.
    pub(super) fn join(&self, station: usize, from: usize, to: usize) -> Option<Demand> {
        let (before, after) = (self.rung(station.checked_sub(1)?, from)?, self.rung(station, to)?);
        let (leaves, arrives) = (self.on(station - 1, from)?, self.on(station, to)?);
        if leaves.branch != arrives.branch {
            return None;
        }
        let proof = arrives.joined.as_ref()?;
        let axes = self.survey.rig.axes;
        let by = turns_between(axes, &proof.start, &before.end)?;
        let end = moved(&proof.end, &by);
        let same = turns_between(axes, &end, &after.start)? == [0.0; MOST_AXES];
        let demand = Demand::of(self.stations.get(station)?.entry(), proof).turned(&by);
        (same && demand.margin(axes) >= 0.0).then_some(demand)
    }
}

const FREE: Cost = Cost {
    margin: f64::INFINITY,
    changes: 0,
    travel: 0.0,
};

fn standing(home: Joints) -> Rung {
    Rung {
        on: None,
        by: [0.0; MOST_AXES],
        start: home,
        end: home,
    }
}

/// The ways to stand on one branch: each axis on each turn on which it stays within its range.
fn rungs_of(on: usize, carried: &Carried, axes: &[Axis]) -> Vec<Rung> {
    let (Some(start), Some(end)) = (carried.ends.first(), carried.ends.last()) else {
        return Vec::new();
    };
    let mut all: Vec<Joints> = vec![[0.0; MOST_AXES]];
    for (index, axis) in axes.iter().enumerate().take(MOST_AXES) {
        let (low, high) = (carried.demand.low[index].value, carried.demand.high[index].value);
        let turns = turns(axis, low, high);
        all = all
            .iter()
            .flat_map(|by| {
                turns.iter().map(move |&turn| {
                    let mut by = *by;
                    by[index] = turn;
                    by
                })
            })
            .collect();
    }
    let margin = |by: &Joints| carried.demand.turned(by).margin(axes);
    if all.len() > MOST_TURNED {
        all.sort_by(|a, b| margin(b).total_cmp(&margin(a)));
        all.truncate(MOST_TURNED);
    }
    all.into_iter()
        .map(|by| Rung {
            on: Some(on),
            by,
            start: moved(start, &by),
            end: moved(end, &by),
        })
        .collect()
}

/// The axis that has no turn on which it stays within its range, with the value farthest outside on the best turn.
pub(super) fn axis_without_turn(carried: &Carried, axes: &[Axis]) -> Option<(usize, Joints)> {
    let mut by = [0.0; MOST_AXES];
    let mut misfit = None;
    for (index, axis) in axes.iter().enumerate().take(MOST_AXES) {
        let (low, high) = (carried.demand.low[index].value, carried.demand.high[index].value);
        match turns(axis, low, high).first() {
            Some(&turn) => by[index] = turn,
            None => {
                by[index] = turn_to_middle(axis, low, high);
                misfit = misfit.or(Some(index));
            }
        }
    }
    misfit.map(|axis| (axis, by))
}

impl Ladder for Ways<'_> {
    fn runs(&self) -> usize {
        self.stations.len()
    }

    fn rungs(&self, run: usize) -> &[Cost] {
        self.costs.get(run).map_or(&[], Vec::as_slice)
    }

    fn link(&self, run: usize, from: usize, to: usize) -> Option<Cost> {
        let axes = self.survey.rig.axes;
        let before = self.rung(run.checked_sub(1)?, from)?;
        let after = self.rung(run, to)?;
        let by_axes = |changes| Cost {
            margin: f64::INFINITY,
            changes,
            travel: travel(axes, &before.end, &after.start),
        };
        match self.stations.get(run)?.kind {
            StationKind::Home(_) | StationKind::Change(_) | StationKind::Run(_) => Some(by_axes(0)),
            StationKind::Joined(_) => match self.join(run, from, to) {
                Some(demand) => Some(Cost {
                    margin: demand.margin(axes),
                    ..by_axes(0)
                }),
                None => Some(by_axes(1)),
            },
        }
    }

    fn holds(&mut self, run: usize, from: usize, to: usize) -> bool {
        if self.join(run, from, to).is_some() {
            return true;
        }
        let before = run.checked_sub(1).and_then(|before| self.rung(before, from));
        let (Some(before), Some(after)) = (before, self.rung(run, to)) else {
            return false;
        };
        // The first one is reported with its place, all others only as being in the way.
        if self.refused.is_some() && is_refuted(self.survey, &before.end, &after.start) {
            return false;
        }
        match clear(self.survey, &before.end, &after.start) {
            Ok(()) => true,
            Err(obstacle) => {
                self.refused.get_or_insert(Refused {
                    station: run,
                    obstacle,
                });
                false
            }
        }
    }
}
