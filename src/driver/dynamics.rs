//! What a program asks of the drives of its machine, and how far its forces bend it, as far as these are known.

use crate::summary::row;
use crate::{Compiled, Run, compile_checked};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{OperationId, Purpose};
use vcutc_backend_api::units::Length;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Diagnostic, Severity};
use vcutc_dynamics::arms::{Arms, Unknown};
use vcutc_dynamics::blade::PushedBlade;
use vcutc_dynamics::cuts::{Cuts, Known};
use vcutc_dynamics::deviation::Deviations;
use vcutc_dynamics::deviation::each::CutDeviation;
use vcutc_dynamics::deviation::figures::{Asked, DeviationFigures, millimetres};
use vcutc_dynamics::deviation::verdict::Needs;
use vcutc_dynamics::deviation::{self, verdict};
use vcutc_dynamics::figures::{Pushing, TorqueFigures};
use vcutc_dynamics::modes::cells::Cells;
use vcutc_dynamics::modes::figures::ModeFigures;
use vcutc_dynamics::modes::swings::Swings;
use vcutc_dynamics::modes::teeth::Teeth;
use vcutc_dynamics::places::Places;
use vcutc_dynamics::verdict::{above_limit, is_within_limits, not_checked, relief};
use vcutc_job::{BladeRef, CheckedJob, Gravity, Machine, Operation};
use vcutc_motion::rigs::Rigs;
use vcutc_motion::solve::Reached;
use vcutc_remedy::base_nearer;
use vcutc_simulation::prove::Compensation;
use vcutc_simulation::report::Report;

/// How far the base is moved towards the arm where a drive is too weak, in mm.
const NEARER: [f64; 8] = [50.0, 100.0, 150.0, 200.0, 300.0, 400.0, 500.0, 700.0];

/// The forces of a program, and what they do.
#[derive(Clone, Debug, Default)]
pub struct Dynamics {
    /// What it asks of the machine's drives, where that is known.
    pub torques: Option<TorqueFigures>,
    /// How far the forces of its blades push its cuts off, where that is known.
    pub deviation: Option<DeviationFigures>,
    /// How its arm swings by itself, where that is known.
    pub modes: Option<ModeFigures>,
    /// How the cells of the core meet that, where both are known.
    pub(crate) cells: Option<Vec<Cells>>,
    /// How the teeth of crushers do.
    pub(crate) teeth: Vec<Teeth>,
}

/// What was found of the torques and the deviations of a program, or why they are not known.
struct Found {
    torques: Result<TorqueFigures, Unknown>,
    deviation: Result<DeviationFigures, deviation::Unknown>,
    swings: Option<Swings>,
}

/// The torques of a program, and how far forces push its cuts off.
fn found(job: &CheckedJob, machine: &Machine, reached: &Reached, report: &Report) -> Found {
    let nothing = Found {
        torques: Err(Unknown::Masses),
        deviation: Err(deviation::Unknown::ClosedForm),
        swings: None,
    };
    let blades = pushed_blades(job);
    let cell_size = job.cell_size.map(|size| size.value);
    let found = cutting(job, machine, reached, report, |known, arms, cuts| Found {
        torques: torques(machine, known, arms, pushing(cuts)),
        swings: arms
            .ok()
            .and_then(|arms| Swings::of(known, arms, &blades, cell_size)),
        deviation: cuts.and_then(|cuts| deviation_of(job, machine, cuts, arms.ok())),
    });
    found.unwrap_or(nothing)
}

/// How far these cuts of a job are pushed off.
fn deviation_of(
    job: &CheckedJob,
    machine: &Machine,
    cuts: &Cuts<'_>,
    arms: Option<&Arms>,
) -> Result<DeviationFigures, deviation::Unknown> {
    let limits = job.operations.iter();
    let limits: Vec<_> = limits
        .map(|operation| operation.deviation_limit().map(|limit| limit.value))
        .collect();
    let asked = Asked {
        blades: &pushed_blades(job),
        limits: &limits,
        gravity: machine.gravity.map(|gravity| gravity.value),
    };
    DeviationFigures::of(cuts, arms, asked)
}

/// What comes of a program and of the arm with each of its blades; none of a program without a cell. An air cut has no report of cuts.
pub(crate) fn carrying<T>(
    machine: &Machine,
    reached: &Reached,
    report: Option<&Report>,
    work: impl FnOnce(Known<'_>, Result<&Arms, Unknown>) -> T,
) -> Option<T> {
    let program = reached.program.program();
    let cell = program.cell.as_ref()?;
    let rigs = Rigs::of(&machine.model, cell, program);
    let known = Known {
        model: &machine.model,
        reached: &reached.program,
        rigs: &rigs,
        edges: report.map_or(&[], |report| &report.edges),
        compensations: report.map_or(&[], |report| &report.compensations),
    };
    let arms = Arms::of(&machine.model, cell);
    Some(work(known, arms.as_ref().map_err(|why| *why)))
}

/// The same with the cuts of a job by blades whose forces are known, or why there are none.
fn cutting<T>(
    job: &CheckedJob,
    machine: &Machine,
    reached: &Reached,
    report: &Report,
    work: impl FnOnce(Known<'_>, Result<&Arms, Unknown>, Result<&Cuts<'_>, deviation::Unknown>) -> T,
) -> Option<T> {
    let blades = pushed_blades(job);
    carrying(machine, reached, Some(report), |known, arms| {
        let cuts = if blades.is_empty() {
            Err(deviation::Unknown::Forces)
        } else {
            Cuts::of(known, &blades).ok_or(deviation::Unknown::ClosedForm)
        };
        work(known, arms, cuts.as_ref().map_err(|why| *why))
    })
}

/// How the tips of an operation are to be offset.
pub(crate) struct Offset {
    /// What takes out what its flanks yield.
    pub(crate) by: Compensation,
    /// How far its flanks may be pushed into the part at most, whatever stretches of the edge are in the material.
    pub(crate) into_part: Length,
}

/// Finds how the tips of an operation are to be offset.
///
/// # Errors
/// Why that is not known.
pub(crate) fn offset(
    job: &CheckedJob,
    machine: &Machine,
    reached: &Reached,
    report: &Report,
    operation: OperationId,
) -> Result<Offset, deviation::Unknown> {
    deviating(job, machine, reached, report, |deviations| {
        let into_part = deviations.into_part_with_any_edge(operation);
        Ok(Offset {
            by: deviations.compensation(operation)?,
            into_part: into_part.ok_or(deviation::Unknown::ClosedForm)?,
        })
    })?
}

/// What comes of the deviations of a program with this report.
///
/// # Errors
/// Why they are not known.
pub fn deviating<T>(
    job: &CheckedJob,
    machine: &Machine,
    reached: &Reached,
    report: &Report,
    work: impl FnOnce(&Deviations<'_>) -> T,
) -> Result<T, deviation::Unknown> {
    let is_weighed = machine.gravity.map(|gravity| gravity.value) == Some(Gravity::Uncompensated);
    let found = cutting(job, machine, reached, report, |_, arms, cuts| {
        let deviations = Deviations::of(cuts?, arms.ok()).ok_or(deviation::Unknown::Elasticity)?;
        if !deviations.have_cuts() {
            let mut unknown = job
                .operations
                .iter()
                .filter_map(|operation| unknown_part(&**operation));
            return Err(unknown.next().unwrap_or(deviation::Unknown::Disc));
        }
        if is_weighed && arms.is_err() {
            return Err(deviation::Unknown::Weight);
        }
        Ok(work(&deviations))
    });
    found.unwrap_or(Err(deviation::Unknown::ClosedForm))
}

/// How far the forces of its blades push the cuts of a program off, proven on all of them, with the weight of the arm where that
/// counts.
///
/// # Errors
/// Why that is not known.
pub fn deviation(
    job: &CheckedJob,
    machine: &Machine,
    reached: &Reached,
    report: &Report,
) -> Result<DeviationFigures, deviation::Unknown> {
    let found = cutting(job, machine, reached, report, |_, arms, cuts| {
        deviation_of(job, machine, cuts?, arms.ok())
    });
    found.unwrap_or(Err(deviation::Unknown::ClosedForm))
}

/// What pushes the blades of these cuts.
fn pushing<'c>(cuts: Result<&'c Cuts<'c>, deviation::Unknown>) -> Pushing<'c> {
    cuts.map_or(Pushing::NotKnown, Pushing::By)
}

/// What comes of the places along a program with this report. None where the torques of its machine are not known. In an air cut
/// nothing pushes the blade.
#[must_use]
pub fn in_places<T>(
    job: &CheckedJob,
    reached: &Reached,
    report: &Report,
    work: impl FnOnce(&Places<'_>) -> T,
) -> Option<T> {
    let machine = job.machine.as_ref()?;
    match reached.program.program().purpose {
        Purpose::Work => cutting(job, machine, reached, report, |known, arms, cuts| {
            Some(work(&Places::of(known, arms.ok()?, cuts.ok())))
        })?,
        Purpose::AirCut { .. } => carrying(machine, reached, None, |known, arms| {
            Some(work(&Places::of(known, arms.ok()?, None)))
        })?,
    }
}

/// How far each cut of the operations that these figures have is pushed off, proven on all of it. None where that is not known.
#[must_use]
pub fn cut_by_cut(
    job: &CheckedJob,
    compiled: &Compiled,
    figures: &DeviationFigures,
) -> Option<Vec<CutDeviation>> {
    let (machine, reached) = carried(job, compiled)?;
    cutting(job, machine, reached, &compiled.report, |_, arms, cuts| {
        figures.each(&Deviations::of(cuts.ok()?, arms.ok())?)
    })?
}

fn torques(
    machine: &Machine,
    known: Known<'_>,
    arms: Result<&Arms, Unknown>,
    pushing: Pushing<'_>,
) -> Result<TorqueFigures, Unknown> {
    let allowed = machine.torque_limit.map(|limit| limit.value);
    TorqueFigures::of(known, arms?, pushing, allowed)
}

/// Adds the torques of an air cut to what is known of it: no forces push its blades.
pub(crate) fn add_torques_in_air(job: &CheckedJob, compiled: &mut Compiled) {
    let Some((machine, reached)) = carried(job, compiled) else {
        return;
    };
    let figures = carrying(machine, reached, None, |known, arms| {
        torques(machine, known, arms, Pushing::Nothing)
    });
    add_torques(figures.unwrap_or(Err(Unknown::Masses)), compiled);
}

fn add_torques(figures: Result<TorqueFigures, Unknown>, compiled: &mut Compiled) {
    compiled.checks = compiled.checks.with_torques(figures.as_ref().map_err(|why| *why));
    let line = figures.as_ref().ok().and_then(TorqueFigures::line);
    compiled.summary.extend(line.map(|line| row("torques", &line)));
    compiled.dynamics.torques = figures.ok();
}

/// Computes the torques of a program and how far forces push its cuts off, and adds them to what is known of it. Returns the limits
/// that nothing can check.
pub(crate) fn add(job: &CheckedJob, compiled: &mut Compiled) -> Vec<Diagnostic> {
    let Some((machine, reached)) = carried(job, compiled) else {
        let limited = job.operations.iter();
        let limits = limited.filter_map(|operation| {
            let limit = operation.deviation_limit()?;
            let needs = Needs::limit(limit, operation.setup().head_span);
            Some(verdict::without_machine(needs))
        });
        return limits.collect();
    };
    let Found {
        torques,
        deviation,
        swings,
    } = found(job, machine, reached, &compiled.report);
    let of_torques = not_checked(&torques, machine);
    let unchecked = unchecked(job, machine, &deviation).into_iter().chain(of_torques);
    add_torques(torques, compiled);
    let known = deviation.as_ref().map_err(|why| *why).and_then(|figures| {
        let mut unknown = job
            .operations
            .iter()
            .filter_map(|operation| unknown_part(&**operation));
        match unknown.next() {
            None if figures.operations.len() < job.operations.len() => Err(deviation::Unknown::Forces),
            None => Ok(()),
            Some(why) => Err(why),
        }
    });
    let lines = deviation
        .as_ref()
        .map_or_else(|_| Vec::new(), DeviationFigures::lines);
    compiled.checks = compiled.checks.with_deviation(known);
    compiled
        .summary
        .extend(lines.iter().map(|(name, text)| row(name, text)));
    compiled.dynamics.deviation = deviation.ok();
    if let Some(swings) = swings {
        let modes = &swings.figures;
        let line = modes.as_ref().map(|modes| row("modes", &modes.line()));
        compiled.summary.extend(line);
        compiled.dynamics.modes = swings.figures;
        compiled.dynamics.cells = swings.cells;
        compiled.dynamics.teeth = swings.teeth;
    }
    unchecked.collect()
}

/// The blades of a job that state what pushes them, by their names.
#[must_use]
pub fn pushed_blades(job: &CheckedJob) -> BTreeMap<&str, PushedBlade<'_>> {
    let mut all: BTreeMap<&str, PushedBlade<'_>> = BTreeMap::new();
    for operation in &job.operations {
        let strip = operation.widest_strip();
        let blades = operation.blades().into_iter();
        for blade in blades.filter(|blade| blade.forces().is_some()) {
            let pushed = all.entry(blade.name()).or_insert(PushedBlade { blade, strip });
            pushed.strip = pushed.strip.zip(strip).map(|(one, other)| one.max(other));
        }
    }
    all
}

/// Why not all deviations of an operation are known, whatever the machine is, if that is so.
fn unknown_part(operation: &dyn Operation) -> Option<deviation::Unknown> {
    let blades = operation.blades();
    let is_disc = |blade: &BladeRef<'_>| matches!(blade, BladeRef::Disc(_));
    let forms = blades.iter().filter(|blade| !is_disc(blade));
    if forms.clone().any(|blade| blade.forces().is_none()) {
        return Some(deviation::Unknown::Forces);
    }
    blades.iter().any(is_disc).then_some(deviation::Unknown::Disc)
}

/// The limits of operations whose deviations are not known.
fn unchecked(
    job: &CheckedJob,
    machine: &Machine,
    figures: &Result<DeviationFigures, deviation::Unknown>,
) -> Vec<Diagnostic> {
    let limited = (0..).zip(&job.operations);
    let unknown = limited.filter_map(|(number, operation): (u16, _)| {
        let limit = operation.deviation_limit()?;
        let why = match figures {
            Ok(figures) if figures.of_operation(OperationId(number)).is_some() => return None,
            Ok(_) => unknown_part(&**operation).unwrap_or(deviation::Unknown::Forces),
            Err(why) => *why,
        };
        let needs = Needs::limit(limit, operation.setup().head_span);
        Some(verdict::not_known(why, needs, machine))
    });
    unknown.collect()
}

/// What there is to say of torques and deviations above their limits, and of forces that were measured otherwise.
pub(crate) fn verdicts(
    job: &CheckedJob,
    compiled: &Compiled,
    sources: &SourceMap,
    run: &mut Run<'_>,
) -> Vec<Diagnostic> {
    let mut all: Vec<Diagnostic> = above_limits(job, compiled, sources, run).into_iter().collect();
    let Some(figures) = &compiled.dynamics.deviation else {
        return all;
    };
    for of in &figures.operations {
        let limited = job.operations.get(usize::from(of.operation));
        let limited = limited.and_then(|operation| Some((operation, operation.deviation_limit()?)));
        let Some((operation, limit)) = limited else {
            continue;
        };
        let found = verdict::above_limit(figures, of, limit, operation.setup().head_span);
        all.extend(found.map(|diagnostic| {
            let wanted = run.patience.refused(core::slice::from_ref(&diagnostic), sources);
            match compensating(job, of.operation, limit.value, &wanted) {
                Some((title, edits)) => diagnostic.fix_all(title, &edits),
                None => diagnostic,
            }
        }));
    }
    let blades = pushed_blades(job);
    all.extend(figures.elsewhere.iter().filter_map(|found| {
        let forces = blades.get(found.blade.as_str())?.blade.forces()?;
        Some(verdict::elsewhere(found, forces))
    }));
    all
}

/// What to write where so that an operation keeps its limit of deviation by setting its tips off, with what comes of that; none where
/// that does not help.
fn compensating(
    job: &CheckedJob,
    number: u16,
    limit: Length,
    wanted: &Wanted,
) -> Option<(String, Vec<(Span, String)>)> {
    let variant = job.operations.get(usize::from(number))?.compensating()?;
    if wanted.is_needless() || variant.edits.is_empty() {
        return None;
    }
    let mut changed = job.clone();
    *changed.operations.get_mut(usize::from(number))? = variant.operation;
    let (_, there) = compile_checked(&changed, wanted)?;
    let (machine, reached) = carried(&changed, &there)?;
    let figures = found(&changed, machine, reached, &there.report).deviation.ok()?;
    let of = figures.operations.iter().find(|of| of.operation == number)?;
    let most = of.into_part.most.max(of.into_waste.most);
    (most <= limit.to_mm()).then(|| {
        let deeper = of.compensation.as_ref().map_or(0.0, |offsets| offsets.deeper);
        let title = format!(
            "{}, which leaves {} under load, and {} into the part where less pushes the blade",
            variant.advice,
            millimetres(most),
            millimetres(deeper),
        );
        (title, variant.edits)
    })
}

/// Torques above the limits of drives. Of an error a place of the work that relieves them is looked for, while that is wanted.
fn above_limits(
    job: &CheckedJob,
    compiled: &Compiled,
    sources: &SourceMap,
    run: &mut Run<'_>,
) -> Option<Diagnostic> {
    let machine = job.machine.as_ref()?;
    let diagnostic = above_limit(compiled.dynamics.torques.as_ref()?, machine)?;
    let advice = "use a lighter tool, lower speeds, or another place for the work";
    if diagnostic.severity() != Severity::Error {
        return Some(diagnostic.help(advice));
    }
    let wanted = run.patience.refused(core::slice::from_ref(&diagnostic), sources);
    let relieved = relieving(job, &wanted);
    Some(match relieved {
        Some((change, figures)) => {
            let title = format!("{}, where {}", change.advice, relief(&figures));
            if change.edits.is_empty() {
                diagnostic.help(title)
            } else {
                diagnostic.fix_all(title, &change.edits)
            }
        }
        None => {
            let diagnostic = diagnostic.help(advice);
            match run.patience.cut_short().filter(|_| wanted.is_needless()) {
                Some(words) => diagnostic.note(words),
                None => diagnostic,
            }
        }
    })
}

/// The nearest of some places of the work where no drive is too weak.
fn relieving(job: &CheckedJob, wanted: &Wanted) -> Option<(vcutc_remedy::Change, TorqueFigures)> {
    NEARER.into_iter().find_map(|by| {
        if wanted.is_needless() {
            return None;
        }
        let change = base_nearer(job, by)?;
        let (_, there) = compile_checked(&change.job, wanted)?;
        let (machine, reached) = carried(&change.job, &there)?;
        let report = &there.report;
        let figures = cutting(&change.job, machine, reached, report, |known, arms, cuts| {
            torques(machine, known, arms, pushing(cuts))
        });
        let figures = figures?.ok()?;
        is_within_limits(&figures).then_some((change, figures))
    })
}

pub(crate) fn carried<'a>(job: &'a CheckedJob, compiled: &'a Compiled) -> Option<(&'a Machine, &'a Reached)> {
    job.machine.as_ref().zip(compiled.program.reached())
}
