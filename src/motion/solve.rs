//! The branch for a whole program, and with it the axes at the end of every op.
//!
//! Wanted is one branch of the inverse kinematics, and one turn of each axis, that carries the whole program with the largest
//! margin ([`super::demand`]). TipPose poses alone say for each branch what its margin is at most, cheaply; branches are then
//! proven in the order of these bounds, until a proven margin is no smaller than the bounds of all that are left. A branch whose
//! bound is larger is asked for the motions about its worst taught pose first: where these leave no more than the best branch
//! so far, it is not proven any further. So the two ways to flip a wrist, which share their first three axes and with them
//! mostly the margin, are not both proven.
//!
//! A program that a branch carries but for the rates of axes, by a factor of two at most, is refused: its speeds are the
//! user's to choose, and axis moves in the place of its travels would only hide that they are too high.
//!
//! Where no branch carries the program otherwise, it is taken apart wherever all axes could move at once in the air above the stock,
//! every branch is proven on every part, and the [`super::ladder`] says where to change. A `Travel` at which the branch
//! changes becomes an `AxisTravel`.
//!
//! Nothing depends on how many threads prove: proofs are joined in the order of the ops.

use super::axis_range::{best_margin, turn_to_middle};
use super::demand::Demand;
use super::ladder::{Stuck, climb};
use super::moves::paths;
use super::path::{Clearance, Proof};
use super::rig::Rig;
use super::rigs::{Rigs, Turn, turns};
use super::runs::{Split, Station, StationKind, split};
use super::stands::Stands;
use super::stray;
use super::survey::{Survey, middles, moved, opened};
use super::sweep;
use super::trouble::{self, Trouble};
use super::waypoints::waypoints;
use super::ways::{OnBranch, Ways};
use rayon::prelude::*;
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Action, Axis, AxisValues, OpId, Program, ToolId};
use vcutc_backend_api::motion::{Branch, Motion, MotionFault, MotionRule, ReachableProgram, Stretch};
use vcutc_backend_api::segments::Path;
use vcutc_backend_api::state::TipPose;
use vcutc_backend_api::units::{AngularSpeed, Duration};
use vcutc_backend_api::verify::{Fault, VerifiedProgram, verify};
use vcutc_cancellation::Wanted;
use vcutc_machine::Model;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// How near a singular pose an arm may come: a degree of axis 5, a degree of the elbow, 10 mm between wrist and axis 1. Nearer
/// than that a controller's own rounding decides what the axes do; how fast they must go near such a pose is bounded by
/// the rates, which usually are broken much earlier.
pub const LEAST_CLEARANCE: Clearance = Clearance {
    wrist: core::f64::consts::PI / 180.0,
    elbow: core::f64::consts::PI / 180.0,
    shoulder: 10.0,
};

/// A program that the machine can carry out.
#[derive(Debug)]
pub struct Reached {
    /// The program with the motion of the machine.
    pub program: ReachableProgram,
    /// What it asks of the machine.
    pub report: ReachReport,
}

impl Reached {
    /// What was found, apart from the program.
    #[must_use]
    pub fn found(&self) -> Found {
        Found {
            motion: self.program.motion().clone(),
            report: self.report.clone(),
        }
    }
}

/// How a machine carries out a program, apart from that program.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    motion: Motion,
    report: ReachReport,
}

/// What a program asks of its machine.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachReport {
    /// The branches, in order.
    pub stretches: Vec<Stretch>,
    /// The travels in whose place all axes move at once, because no branch carries the program without.
    pub changes: Vec<OpId>,
    /// The axes where the first motion to a pose ends.
    pub first: Joints,
    /// What all motions along courses ask together.
    pub demand: Demand,
    /// The smallest margin (see [`super::demand`]).
    pub margin: f64,
    /// What turns more slowly than the job allows; none where its axes follow all turns as they are stated.
    pub slower: Option<SlowerTurns>,
}

/// How many motions turn the blade more slowly than the job allows, because axes are too slow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlowerTurns {
    /// How many are slower.
    pub slower: usize,
    /// How many motions turn the blade.
    pub turning: usize,
    /// The lowest rate, and the first op that has it.
    pub lowest: (AngularSpeed, OpId),
    /// How much longer they take in all.
    pub longer: Duration,
    /// The axis, from 0, that was too slow for the rates of the job, and how fast it would have to move, in rad/s or mm/s.
    pub too_slow: (usize, f64),
}

/// Why a program is not carried out.
#[derive(Debug)]
pub enum Unreached {
    /// The machine cannot.
    Unreachable(Box<Unreachable>),
    /// The program that came out breaks a rule, which is a fault of the compiler.
    Rules(Vec<Fault>),
    /// The motion that came out breaks a rule, which is a fault of the compiler.
    Motion(Vec<MotionFault>),
}

impl Unreached {
    /// What the machine cannot carry out; none of a fault of the compiler.
    #[must_use]
    pub fn unreachable(&self) -> Option<&Unreachable> {
        match self {
            Self::Unreachable(unreachable) => Some(unreachable),
            Self::Rules(_) | Self::Motion(_) => None,
        }
    }
}

/// A program that its machine cannot carry out.
#[derive(Clone, Debug, PartialEq)]
pub struct Unreachable {
    pub program: VerifiedProgram,
    /// What keeps the machine from it.
    pub trouble: Trouble,
}

/// Whether the branch may change on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Changes {
    /// In the air, where no branch carries the whole program.
    InTheAir,
    /// The same, for who has another program to try: the first run that no branch carries is the last to be looked at.
    InTheAirOrElse,
    /// Nowhere: what needs a change is refused. That is known much sooner, and is enough to ask whether another place or speed
    /// is better.
    Never,
}

/// Finds how a machine carries out a program, nowhere nearer to singular poses than `least`.
///
/// # Errors
/// Where and why it cannot.
pub fn solve(
    program: VerifiedProgram,
    model: &Model,
    least: &Clearance,
    changes: Changes,
) -> Result<Reached, Unreached> {
    solve_while(program, model, least, changes, &Wanted::ALWAYS)
}

/// As [`solve`] while the answer is wanted. What comes out afterwards is of no use ([`Wanted::answer`]).
///
/// # Errors
/// As for [`solve`].
pub fn solve_while(
    program: VerifiedProgram,
    model: &Model,
    least: &Clearance,
    changes: Changes,
    wanted: &Wanted,
) -> Result<Reached, Unreached> {
    let Some(cell) = &program.program().cell else {
        let what = MotionRule::Machine;
        return Err(Unreached::Motion(vec![MotionFault { op: None, what }]));
    };
    let rigs = Rigs::of(model, cell, program.program());
    let paths = paths(program.program());
    let mut solved: Option<Solved> = None;
    for turn in turns(program.program()) {
        let paths = turn.alone(&paths);
        let rig = rigs.with(turn.tool);
        let open = opened(&model.axes);
        let middle = middles(&model.axes);
        let survey = Survey {
            program: program.program(),
            paths: &paths,
            tool: turn.tool,
            open: Rig {
                axes: &open,
                ..rig.clone()
            },
            rig: rig.clone(),
            followed: Stands::of(rig, program.program(), &paths, &middle, wanted),
            middle,
            least: *least,
            wanted,
        };
        match surveyed(&survey, changes) {
            Ok(more) => {
                solved = Some(match solved {
                    Some(before) => before.and(more, &turn, &model.axes),
                    None => more,
                });
            }
            Err(trouble) => {
                return Err(Unreached::Unreachable(Box::new(Unreachable {
                    program,
                    trouble: *trouble,
                })));
            }
        }
    }
    match solved {
        Some(solved) => finish(program, &rigs, solved),
        None => Err(Unreached::Motion(Vec::new())),
    }
}

/// Finds how a machine carries out what it does with one blade at hand.
fn surveyed(survey: &Survey<'_>, changes: Changes) -> Result<Solved, Box<Trouble>> {
    let bounds = screen(survey);
    match on_one_branch(survey, &bounds) {
        Some(solved) => Ok(solved),
        // What is wrong with it takes its time to find out, too.
        None if survey.wanted.is_needless() => Err(Box::new(Trouble::Nowhere)),
        None => match trouble::too_fast(survey, &bounds) {
            Some(trouble) => Err(Box::new(trouble)),
            None => match changes {
                Changes::InTheAir | Changes::InTheAirOrElse => by_changes(survey, &bounds, changes),
                Changes::Never => Err(Box::new(trouble::first(survey, &bounds))),
            },
        },
    }
}

/// Joins what was found for a program to the same one: the same ops, postures, speeds and cell. That the machine is then where
/// each op ends is checked once more.
///
/// # Errors
/// When the motion is that of another program.
pub fn again(program: VerifiedProgram, model: &Model, found: Found) -> Result<Reached, Unreached> {
    let Some(cell) = program.program().cell.clone() else {
        return Err(Unreached::Motion(vec![MotionFault {
            op: None,
            what: MotionRule::Machine,
        }]));
    };
    let program = changed(program, &found.report.changes)?;
    let rigs = Rigs::of(model, &cell, program.program());
    joined_to(program, &rigs, found)
}

/// Checks the motion and joins it to the program.
fn finish(program: VerifiedProgram, rigs: &Rigs<'_>, solved: Solved) -> Result<Reached, Unreached> {
    let program = changed(program, &solved.report.changes)?;
    if let Some(trouble) = turned_otherwise(&program, rigs, &solved.ends) {
        return Err(Unreached::Unreachable(Box::new(Unreachable { program, trouble })));
    }
    let mut motion = Motion {
        ends: solved.ends.into_iter().map(AxisValues).collect(),
        stretches: solved.report.stretches.clone(),
        waypoints: Vec::new(),
    };
    motion.waypoints = waypoints(program.program(), rigs, &motion);
    let report = solved.report;
    joined_to(program, rigs, Found { motion, report })
}

/// A motion that sweeps the blade through the work, or turns it on a chain otherwise than the program says, where rotary axes are
/// interpolated. About one axis, as arms turn it, the extension of the cuts keeps it clear.
fn turned_otherwise(program: &VerifiedProgram, rigs: &Rigs<'_>, ends: &[Joints]) -> Option<Trouble> {
    match rigs.first().mechanism {
        Mechanism::FiveAxis(_) => {
            let strays = || stray::none(program, rigs, ends).err().map(Trouble::Stray);
            let sweeps = sweep::clear(program, rigs, ends).err();
            sweeps.map(Trouble::Sweep).or_else(strays)
        }
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => None,
    }
}

/// The program as it is carried out.
fn changed(program: VerifiedProgram, changes: &[OpId]) -> Result<VerifiedProgram, Unreached> {
    if changes.is_empty() {
        return Ok(program);
    }
    verify(with_changes(program.program(), changes)).map_err(Unreached::Rules)
}

fn joined_to(program: VerifiedProgram, rigs: &Rigs<'_>, found: Found) -> Result<Reached, Unreached> {
    let Found { motion, report } = found;
    let blade_in_work =
        |tool: ToolId, values: &AxisValues| Frame::from(rigs.with(tool).blade_in_work(&values.0));
    let program = ReachableProgram::assemble(program, motion, &blade_in_work).map_err(Unreached::Motion)?;
    Ok(Reached { program, report })
}

/// The program with axis moves in place of some of its travels.
fn with_changes(program: &Program, changes: &[OpId]) -> Program {
    let mut program = program.clone();
    for &id in changes {
        if let Some(op) = program.ops.get_mut(id.0 as usize)
            && let Action::Travel { to, orientation, .. } = op.action
        {
            op.action = Action::AxisTravel { to, orientation };
        }
    }
    program
}

/// The axes at the end of every op, before they are checked.
struct Solved {
    ends: Vec<Joints>,
    report: ReachReport,
}

impl Solved {
    /// The same with what was found for the turn of another blade, which comes next.
    fn and(mut self, more: Self, turn: &Turn, axes: &[Axis]) -> Self {
        self.ends.truncate(turn.ops.start);
        self.ends.extend(more.ends.into_iter().skip(turn.ops.start));
        let (report, more) = (&mut self.report, more.report);
        report.changes.extend(more.changes);
        // A turn that leads to no pose asks nothing of the machine.
        match (report.stretches.is_empty(), more.stretches.is_empty()) {
            (_, true) => {}
            (true, false) => (report.first, report.demand) = (more.first, more.demand),
            (false, false) => report.demand = report.demand.and(&more.demand),
        }
        for stretch in more.stretches {
            if report
                .stretches
                .last()
                .is_none_or(|last| last.branch != stretch.branch)
            {
                report.stretches.push(stretch);
            }
        }
        report.margin = report.demand.margin(axes);
        self
    }
}

/// A branch, and its margin at taught poses; none where it does not reach all of them.
type Bound = (Branch, Option<f64>);

/// What each branch makes of the taught poses alone.
fn screen(survey: &Survey<'_>) -> Vec<Bound> {
    let taught: Vec<TipPose> = survey.paths.iter().filter_map(Path::target).collect();
    let seen = taught
        .par_chunks(SCREENED)
        .map(|poses| {
            let mut seen: BTreeMap<Branch, (usize, f64)> = BTreeMap::new();
            for &pose in poses {
                for solution in survey.stands(pose).iter() {
                    let margin = best_margin(survey.rig.axes, &solution.joints);
                    let entry = seen.entry(solution.branch).or_insert((0, f64::INFINITY));
                    entry.0 += usize::from(margin >= 0.0);
                    entry.1 = entry.1.min(margin);
                }
            }
            seen
        })
        .reduce(BTreeMap::new, |mut all, more| {
            for (branch, (count, margin)) in more {
                let entry = all.entry(branch).or_insert((0, f64::INFINITY));
                entry.0 += count;
                entry.1 = entry.1.min(margin);
            }
            all
        });
    seen.into_iter()
        .map(|(branch, (count, margin))| (branch, (count == taught.len()).then_some(margin)))
        .collect()
}

/// Poses that are screened at once.
const SCREENED: usize = 1024;

/// The branch that carries the whole program with the largest margin.
fn on_one_branch(survey: &Survey<'_>, bounds: &[Bound]) -> Option<Solved> {
    let stations = split(survey.program, survey.paths, Split::AtAxisMoves);
    let mut by_bound: Vec<(Branch, f64)> = bounds
        .iter()
        .filter_map(|&(branch, bound)| Some((branch, bound?)))
        .collect();
    // A stable sort: branches of the same bound stay in their order.
    by_bound.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut best: Option<Solved> = None;
    for (branch, bound) in by_bound {
        if let Some(best) = &best {
            if best.report.margin >= bound {
                break;
            }
            if leaves_no_more(survey, branch, best.report.margin) {
                continue;
            }
        }
        let Some(carried) = on_branch(survey, &stations, branch) else {
            continue;
        };
        let mut ways = Ways::new(survey, &stations, &carried);
        let Ok(way) = climb(&mut ways) else { continue };
        let solved = solved(survey, &stations, &ways, &way);
        if best
            .as_ref()
            .is_none_or(|best| solved.report.margin > best.report.margin)
        {
            best = Some(solved);
        }
    }
    best
}

/// Whether the motions to and from a branch's worst taught pose leave no more than a margin, or are not carried at all: no
/// program that has them leaves more.
fn leaves_no_more(survey: &Survey<'_>, branch: Branch, margin: f64) -> bool {
    let worst = (survey.paths.par_iter().enumerate())
        .filter_map(|(index, path)| {
            let stand = survey.stand(path.target()?, branch)?;
            Some((best_margin(survey.rig.axes, &stand), index))
        })
        .min_by(|(a, first), (b, second)| a.total_cmp(b).then(first.cmp(second)));
    let Some((_, index)) = worst else { return true };
    let (before, after) = survey.paths.split_at(index + 1);
    let to = before.last().and_then(Path::line);
    let from = after
        .iter()
        .find(|path| **path != Path::Still)
        .and_then(Path::line);
    to.into_iter().chain(from).any(|line| {
        survey
            .line(line, branch)
            .map_or(true, |proof| best_sweep(survey.rig.axes, &proof) <= margin)
    })
}

/// The margin of a motion, each axis on its best turn.
fn best_sweep(axes: &[Axis], proof: &Proof) -> f64 {
    let demand = Demand::of(OpId(0), proof);
    let by = core::array::from_fn(|index| match axes.get(index) {
        Some(axis) => turn_to_middle(axis, demand.low[index].value, demand.high[index].value),
        None => 0.0,
    });
    demand.turned(&by).margin(axes)
}

/// All stations on one branch; nothing if it fails on any.
fn on_branch(survey: &Survey<'_>, stations: &[Station], branch: Branch) -> Option<Vec<Vec<OnBranch>>> {
    stations
        .iter()
        .map(|station| match station.kind {
            StationKind::Home(_) | StationKind::Change(_) => Some(Vec::new()),
            StationKind::Run(_) | StationKind::Joined(_) => {
                let carried = survey.carried(station, branch)?;
                Some(vec![OnBranch {
                    branch,
                    carried,
                    joined: None,
                }])
            }
        })
        .collect()
}

/// The best way with changes of the branch in the air.
fn by_changes(survey: &Survey<'_>, bounds: &[Bound], changes: Changes) -> Result<Solved, Box<Trouble>> {
    let stations = split(survey.program, survey.paths, Split::AtDetours);
    let found = |carried: &[Vec<OnBranch>], stuck: usize| {
        let branches: Vec<Branch> = bounds.iter().map(|&(branch, _)| branch).collect();
        trouble::found(survey, &stations, carried, &branches, stuck)
    };
    let mut carried: Vec<Vec<OnBranch>> = Vec::with_capacity(stations.len());
    for some in stations.chunks(STATIONS_AT_ONCE) {
        if survey.wanted.is_needless() {
            return Err(Box::new(Trouble::Nowhere));
        }
        carried.par_extend(some.par_iter().map(|station| carrying(survey, station, bounds)));
        let stuck = (stations.iter().zip(&carried))
            .position(|(station, carrying)| carrying.is_empty() && station.stands().is_none());
        if let (Some(stuck), Changes::InTheAirOrElse) = (stuck, changes) {
            carried.truncate(stuck + 1);
            return Err(Box::new(found(&carried, stuck)));
        }
    }
    let mut ways = Ways::new(survey, &stations, &carried);
    match climb(&mut ways) {
        Ok(way) => Ok(solved(survey, &stations, &ways, &way)),
        Err(Stuck::At(station)) => Err(Box::new(found(&carried, station))),
        Err(Stuck::Refuted(station)) => Err(Box::new(trouble::on_the_way(&stations, ways.refused, station))),
    }
}

/// Stations whose branches are looked at side by side.
const STATIONS_AT_ONCE: usize = 32;

/// The branches that carry a station, in their order; none at home.
fn carrying(survey: &Survey<'_>, station: &Station, bounds: &[Bound]) -> Vec<OnBranch> {
    if station.stands().is_some() {
        return Vec::new();
    }
    let on_branch = |&(branch, _): &Bound| {
        Some(OnBranch {
            branch,
            carried: survey.carried(station, branch)?,
            joined: joined(survey, station, branch),
        })
    };
    bounds.iter().filter_map(on_branch).collect()
}

fn joined(survey: &Survey<'_>, station: &Station, branch: Branch) -> Option<Proof> {
    match &station.kind {
        StationKind::Home(_) | StationKind::Change(_) | StationKind::Run(_) => None,
        StationKind::Joined(line) => survey.line(line, branch).ok(),
    }
}

/// Puts together what a way up says of every op.
fn solved(survey: &Survey<'_>, stations: &[Station], ways: &Ways<'_>, way: &[usize]) -> Solved {
    let mut ends: Vec<Joints> = Vec::with_capacity(survey.paths.len());
    let mut changes = Vec::new();
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut demand: Option<Demand> = None;
    let mut first: Option<Joints> = None;
    let mut add = |more: Demand| {
        demand = Some(demand.as_ref().map_or(more, |demand| demand.and(&more)));
    };
    let mut from = 0;
    for (index, (station, &rung)) in stations.iter().zip(way).enumerate() {
        let Some(at) = ways.rung(index, rung) else {
            continue;
        };
        // Ops before the first station move nothing.
        ends.resize(station.ops.start, at.start);
        match ways.on(index, rung) {
            None => ends.resize(station.ops.end, at.start),
            Some(run) => {
                ends.extend(run.carried.ends.iter().map(|end| moved(end, &at.by)));
                add(run.carried.demand.turned(&at.by));
                first = first.or(Some(at.start));
                if stretches.last().is_none_or(|last| last.branch != run.branch) {
                    stretches.push(Stretch {
                        from: station.entry(),
                        branch: run.branch,
                    });
                }
            }
        }
        match (station.kind, ways.join(index, from, rung)) {
            (StationKind::Joined(_), Some(join)) => add(join),
            (StationKind::Joined(_), None) => changes.push(station.entry()),
            (StationKind::Home(_) | StationKind::Change(_) | StationKind::Run(_), _) => {}
        }
        from = rung;
    }
    let first = first.unwrap_or(survey.middle);
    let demand = demand.unwrap_or_else(|| Demand::standing(OpId(0), &first));
    let margin = demand.margin(survey.rig.axes);
    Solved {
        ends,
        report: ReachReport {
            stretches,
            changes,
            first,
            demand,
            margin,
            slower: None,
        },
    }
}
