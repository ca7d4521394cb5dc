//! What keeps a machine from a program, when it cannot carry it out: the [`Trouble`].
//!
//! A motion that no branch carries is reported by itself, on the branch that fails least. Where every motion is carried by some
//! branch but no branch carries all that must be made on one, that is reported.

use super::path::{Breach, Course, Look, Refuted, Violation, prove, worst};
use super::runs::{Split, Station, StationKind, split};
use super::stray::Stray;
use super::survey::{ENOUGH_TOO_FAST, Extent, Failure, Survey, moved};
use super::sweep::Sweep;
use super::way::Obstacle;
use super::ways::{OnBranch, Refused, axis_without_turn};
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::ir::{OpId, Site};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::segments::Path;
use vcutc_machine::kinematics::Joints;

/// What keeps a machine from a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trouble {
    /// A motion that no branch carries.
    Motion {
        /// How the branch fails that fails least.
        failing: Failing,
        /// How many other cuts hold motions that no branch carries.
        other_cuts: Count,
        /// The motion that lacks most on the same branch, if it is another one.
        hardest: Option<Failing>,
    },
    /// Motions that must be made on one branch, each of which one carries, but none carries all.
    NoCommonBranch {
        /// The first motion that the branch which fails least does not carry.
        failing: Failing,
        /// A branch that carries that motion, and where it fails itself.
        other: Failing,
    },
    /// An axis move that leads the blade below the top of the stock.
    Way {
        op: OpId,
        leads: Leads,
        /// Where the blade is too low.
        obstacle: Obstacle,
    },
    /// A motion that sweeps the blade through the work.
    Sweep(Sweep),
    /// A piece of a chain on which the axes hold the blade otherwise than the program.
    Stray(Stray),
    /// A machine that is nowhere: without a motion to any pose that it can take.
    Nowhere,
}

impl Trouble {
    /// The op that is reported first; none of a machine that reaches nothing.
    #[must_use]
    pub const fn op(&self) -> Option<OpId> {
        match self {
            Self::Motion { failing, .. } | Self::NoCommonBranch { failing, .. } => Some(failing.op),
            Self::Way { op, .. } | Self::Sweep(Sweep { op, .. }) | Self::Stray(Stray { op, .. }) => Some(*op),
            Self::Nowhere => None,
        }
    }

    /// The motion that is reported first, where single motions fail.
    #[must_use]
    pub const fn failing(&self) -> Option<&Failing> {
        match self {
            Self::Motion { failing, .. } | Self::NoCommonBranch { failing, .. } => Some(failing),
            Self::Way { .. } | Self::Sweep(_) | Self::Stray(_) | Self::Nowhere => None,
        }
    }

    /// The motion that lacks most, where single motions fail.
    #[must_use]
    pub const fn hardest(&self) -> Option<&Failing> {
        match self {
            Self::Motion {
                hardest: Some(hardest),
                ..
            } => Some(hardest),
            Self::Motion { .. } | Self::NoCommonBranch { .. } => self.failing(),
            Self::Way { .. } | Self::Sweep(_) | Self::Stray(_) | Self::Nowhere => None,
        }
    }
}

/// A number of cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    Exactly(usize),
    /// So many were found before the search was ended.
    AtLeast(usize),
}

/// A motion that a branch does not carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failing {
    pub op: OpId,
    pub branch: Option<Branch>,
    /// Where it fails first, and why.
    pub breach: Breach,
    /// Where on the same motion it fails most, as sampled.
    pub worst: Breach,
}

/// Where an axis move leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leads {
    /// From home or from another pose to a pose.
    ToPose,
    ToHome,
    /// To where the blade is changed.
    ToChange,
}

/// Says what is wrong with a station that has no way to stand.
pub(super) fn found(
    survey: &Survey<'_>,
    stations: &[Station],
    all_carried: &[Vec<OnBranch>],
    branches: &[Branch],
    stuck: usize,
) -> Trouble {
    let (Some(station), Some(carried)) = (stations.get(stuck), all_carried.get(stuck)) else {
        return Trouble::Nowhere;
    };
    if let Some(failing) = carried
        .iter()
        .find_map(|run| beyond_all_turns(survey, station, run))
    {
        return Trouble::Motion {
            failing,
            other_cuts: Count::Exactly(0),
            hardest: None,
        };
    }
    let failing = failures(survey, station, branches);
    // A run that some branch carries is not an obstacle.
    let all = (stations.iter().zip(all_carried).enumerate())
        .filter(|(_, (_, carried))| carried.is_empty())
        .flat_map(|(index, (other, _))| {
            if index == stuck {
                common(&failing)
            } else {
                common(&failures(survey, other, branches))
            }
        });
    let Some((branch, least)) = failing.iter().min_by_key(|(branch, failures)| {
        let kind = failures.first().map(|failure| rank(failure.breach.what));
        (failures.len(), kind, *branch)
    }) else {
        return out_of_reach(station);
    };
    let of = |failure: &Failure, branch: Branch| failing_on(survey, failure, branch);
    let by_no_branch = common(&failing);
    match least.iter().find(|failure| by_no_branch.contains(&failure.op)) {
        Some(failure) => Trouble::Motion {
            failing: of(failure, *branch),
            other_cuts: Count::Exactly(other_cuts(survey, all, failure.op)),
            hardest: hardest(survey, least, *branch, failure),
        },
        None => no_common_branch(station, &failing, *branch, least, of),
    }
}

/// What the branches that do not carry a station fail on; nothing at home.
fn failures(survey: &Survey<'_>, station: &Station, branches: &[Branch]) -> Vec<(Branch, Vec<Failure>)> {
    if station.stands().is_some() {
        return Vec::new();
    }
    let failing = |&branch: &Branch| Some((branch, survey.run(station, branch, Extent::Whole).err()?));
    branches.iter().filter_map(failing).collect()
}

/// How many failures are looked at for the hardest of them.
const MOST_WEIGHED: usize = 256;

/// Of the failures of a branch, the motion that lacks most, if it lacks notably more than the reported one.
fn hardest(survey: &Survey<'_>, failures: &[Failure], branch: Branch, reported: &Failure) -> Option<Failing> {
    let notably = 1.05 * lack(survey, &failing_on(survey, reported, branch));
    let (_, hardest) = weighed(survey, failures, branch).max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    Some(failing_on(survey, hardest, branch))
        .filter(|failing| failing.op != reported.op && lack(survey, failing) > notably)
}

/// How much some failures of a branch lack, by a rough look.
fn weighed<'f>(
    survey: &Survey<'_>,
    failures: &'f [Failure],
    branch: Branch,
) -> impl Iterator<Item = (f64, &'f Failure)> {
    let every = failures.len() / MOST_WEIGHED + 1;
    failures.iter().step_by(every).map(move |failure| {
        let failing = looked_at(survey, failure, branch, Look::Rough);
        (lack(survey, &failing), failure)
    })
}

/// How much is missing, so that failures can be compared: by the range, the rate or the distance that is had.
fn lack(survey: &Survey<'_>, failing: &Failing) -> f64 {
    let axis = |axis: usize| survey.rig.axes.get(axis);
    match failing.worst.what {
        Violation::OutOfReach => f64::INFINITY,
        Violation::Singular(_) => 1.0,
        Violation::Limit { axis: index, value } => axis(index).map_or(0.0, |axis| {
            (axis.min - value).max(value - axis.max) / (axis.max - axis.min).max(1e-9)
        }),
        Violation::Rate { axis: index, rate } => {
            let fastest = axis(index).and_then(|axis| axis.rate);
            fastest.map_or(0.0, |fastest| rate / fastest - 1.0)
        }
    }
}

/// Speeds that are too high by more than this factor are not reported as the cause.
const TOO_FAST: f64 = 2.0;

/// Says which motion is too fast, if a branch carries the program but for that.
pub(super) fn too_fast(survey: &Survey<'_>, bounds: &[(Branch, Option<f64>)]) -> Option<Trouble> {
    let stations = split(survey.program, survey.paths, Split::AtAxisMoves);
    let is_more_than_fast = |refuted: Refuted| match refuted {
        Refuted::Pose => true,
        Refuted::TooFast(times) => times > TOO_FAST,
    };
    let all_too_fast = |branch: Branch| {
        let is_refuted = |station: &Station| survey.is_refuted(station, branch, is_more_than_fast);
        if stations.iter().any(is_refuted) {
            return None;
        }
        let mut failures = Vec::new();
        for station in &stations {
            if station.stands().is_some() {
                continue;
            }
            match survey.run(station, branch, Extent::OtherThanRates) {
                Ok(_) => {}
                Err(more) => failures.extend(more),
            }
            let is_rate = |failure: &Failure| matches!(failure.breach.what, Violation::Rate { .. });
            if !failures.iter().all(is_rate) {
                return None;
            }
        }
        let lacks = weighed(survey, &failures, branch).map(|(lack, _)| lack);
        let hardest = lacks.fold(0.0, f64::max);
        (hardest <= TOO_FAST - 1.0).then_some((branch, failures))
    };
    // The branch that leaves the most room at taught poses is the first to be asked, and mostly the only one: proving a long
    // program takes its time.
    let mut by_room: Vec<(Branch, f64)> = bounds
        .iter()
        .filter_map(|&(branch, bound)| Some((branch, bound?)))
        .collect();
    by_room.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let (branch, failures) = by_room
        .into_iter()
        .find_map(|(branch, _)| all_too_fast(branch))
        .filter(|(_, failures)| !failures.is_empty())?;
    let first = failures.first()?;
    let others = other_cuts(survey, failures.iter().map(|failure| failure.op), first.op);
    let other_cuts = if failures.len() < ENOUGH_TOO_FAST {
        Count::Exactly(others)
    } else {
        Count::AtLeast(others)
    };
    Some(Trouble::Motion {
        failing: failing_on(survey, first, branch),
        other_cuts,
        hardest: hardest(survey, &failures, branch, first),
    })
}

/// Says what the branch that gets farthest does not carry, without a look at what comes behind.
pub(super) fn first(survey: &Survey<'_>, bounds: &[(Branch, Option<f64>)]) -> Trouble {
    let stations = split(survey.program, survey.paths, Split::AtAxisMoves);
    let first_of = |branch: Branch| {
        let failures = stations
            .iter()
            .filter(|station| station.stands().is_none())
            .find_map(|station| survey.run(station, branch, Extent::FirstFailure).err())?;
        failures.first().map(|failure| (branch, *failure))
    };
    let farthest = bounds
        .iter()
        .filter_map(|&(branch, _)| first_of(branch))
        .max_by_key(|(branch, failure)| (failure.op, core::cmp::Reverse(*branch)));
    match farthest {
        Some((branch, failure)) => Trouble::Motion {
            failing: failing_on(survey, &failure, branch),
            other_cuts: Count::Exactly(0),
            hardest: None,
        },
        None => Trouble::Nowhere,
    }
}

/// A failure together with the worst of it.
fn failing_on(survey: &Survey<'_>, failure: &Failure, branch: Branch) -> Failing {
    looked_at(survey, failure, branch, Look::Close)
}

fn looked_at(survey: &Survey<'_>, failure: &Failure, branch: Branch, look: Look) -> Failing {
    let Failure { op, breach } = *failure;
    let line = survey.paths.get(op.0 as usize).and_then(Path::line);
    let worst = line.and_then(|line| {
        let start = survey.stand(line.from, branch)?;
        let course = Course::of(survey.program, line)?;
        Some(worst(&survey.open, &course, branch, &start, &breach, look))
    });
    Failing {
        op,
        branch: Some(branch),
        breach,
        worst: worst.unwrap_or(breach),
    }
}

fn no_common_branch(
    station: &Station,
    failing: &[(Branch, Vec<Failure>)],
    branch: Branch,
    least: &[Failure],
    of: impl Fn(&Failure, Branch) -> Failing,
) -> Trouble {
    let Some(first) = least.first() else {
        return out_of_reach(station);
    };
    let carrying = failing
        .iter()
        .filter(|(_, failures)| failures.iter().all(|failure| failure.op != first.op));
    let other = carrying
        .min_by_key(|(other, failures)| (failures.len(), *other))
        .and_then(|(other, failures)| failures.first().map(|failure| of(failure, *other)));
    match other {
        Some(other) => Trouble::NoCommonBranch {
            failing: of(first, branch),
            other,
        },
        None => Trouble::Motion {
            failing: of(first, branch),
            other_cuts: Count::Exactly(0),
            hardest: None,
        },
    }
}

fn out_of_reach(station: &Station) -> Trouble {
    let breach = Breach {
        at: 1.0,
        what: Violation::OutOfReach,
    };
    Trouble::Motion {
        failing: Failing {
            op: station.entry(),
            branch: None,
            breach,
            worst: breach,
        },
        other_cuts: Count::Exactly(0),
        hardest: None,
    }
}

/// Of several branches that fail equally often the one is reported whose failure is the easiest to mend.
const fn rank(violation: Violation) -> u8 {
    match violation {
        Violation::Rate { .. } => 0,
        Violation::Limit { .. } => 1,
        Violation::Singular(_) => 2,
        Violation::OutOfReach => 3,
    }
}

/// The ops that all branches fail on.
fn common(failing: &[(Branch, Vec<Failure>)]) -> BTreeSet<OpId> {
    let mut counts: BTreeMap<OpId, usize> = BTreeMap::new();
    for (_, failures) in failing {
        for failure in failures {
            *counts.entry(failure.op).or_default() += 1;
        }
    }
    counts.retain(|_, count| *count == failing.len());
    counts.into_keys().collect()
}

/// How many cuts, other than that of `op`, some failing ops belong to.
fn other_cuts(survey: &Survey<'_>, failing: impl Iterator<Item = OpId>, op: OpId) -> usize {
    let site = |op: OpId| survey.program.op(op).map(|op| op.site);
    let own = site(op);
    let cuts: BTreeSet<(u16, u32, u32)> = failing
        .filter_map(|op| match site(op) {
            here @ Some(Site::Cut {
                operation,
                layer,
                cut,
            }) if here != own => Some((operation.0, layer.get(), cut.get())),
            Some(Site::Cut { .. } | Site::Program | Site::Operation(_) | Site::Layer { .. }) | None => None,
        })
        .collect();
    cuts.len()
}

/// Where a run leaves the range of an axis on every turn.
fn beyond_all_turns(survey: &Survey<'_>, station: &Station, run: &OnBranch) -> Option<Failing> {
    let axes = survey.rig.axes;
    let (index, by) = axis_without_turn(&run.carried, axes)?;
    let axis = axes.get(index)?;
    let demand = run.carried.demand.turned(&by);
    let (low, high) = (demand.low[index], demand.high[index]);
    let worst = if axis.min - low.value > high.value - axis.max {
        low
    } else {
        high
    };
    let farthest = Breach {
        at: 1.0,
        what: Violation::Limit {
            axis: index,
            value: worst.value,
        },
    };
    let first = proven_breach(survey, station, run, &by, worst.op);
    Some(Failing {
        op: worst.op,
        branch: Some(run.branch),
        breach: first.unwrap_or(farthest),
        worst: farthest,
    })
}

/// Where a motion leaves the ranges of the axes as they are, begun where the run has brought them.
fn proven_breach(
    survey: &Survey<'_>,
    station: &Station,
    run: &OnBranch,
    by: &Joints,
    op: OpId,
) -> Option<Breach> {
    let index = op.0 as usize;
    let line = survey.paths.get(index)?.line()?;
    let before = index.checked_sub(station.ops.start + 1)?;
    let start = moved(run.carried.ends.get(before)?, by);
    let course = Course::of(survey.program, line)?;
    prove(&survey.rig, &course, run.branch, &start, &survey.least).err()
}

/// Says what is wrong with an axis move.
pub(super) fn on_the_way(stations: &[Station], refused: Option<Refused>, stuck: usize) -> Trouble {
    let station = refused.map_or(stuck, |refused| refused.station);
    match (stations.get(station), refused) {
        (Some(station), Some(refused)) => Trouble::Way {
            op: station.entry(),
            leads: match station.kind {
                StationKind::Home(_) => Leads::ToHome,
                StationKind::Change(_) => Leads::ToChange,
                StationKind::Run(_) | StationKind::Joined(_) => Leads::ToPose,
            },
            obstacle: refused.obstacle,
        },
        (Some(_) | None, _) => Trouble::Nowhere,
    }
}
