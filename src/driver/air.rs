//! From the result of a job to its air cut: the program that cuts is compiled and proven first, then lifted,
//! and the result takes its place.

use super::{Compiled, Finished, Outcome, Stage, internal, motions_broken, paced, rules_broken};
use crate::air_cut::{least_gap, least_lift, lifted};
use crate::checks::{Bodies, Carried, Checks};
use crate::dynamics::{self, Dynamics};
use crate::summary::air::{AirFigures, Mover, summary};
use crate::summary::times::figures as time_figures;
use vcutc_backend_api::ir::{Head, Program, Purpose};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::CheckedJob;
use vcutc_job::sema::units;
use vcutc_motion::figures as reach_figures;
use vcutc_motion::solve::{Changes, LEAST_CLEARANCE, Reached, Unreached, solve};
use vcutc_motion::verdict as reach_verdict;
use vcutc_simulation::timing::times;

/// Nothing in a cell is higher, in mm.
const HIGHEST: f64 = 10_000.0;

/// What is said of a height that none can be.
const OUT_OF_RANGE: &str = "a height must be greater than 0 mm and at most 10 m";

/// How often the way between a height that is carried out and one that is not is halved.
const HALVINGS: u32 = 7;

/// Heights that are offered are multiples of this, in mm, but for the least.
const OFFERED: f64 = 10.0;

/// The height of an air cut as people write it, with its unit.
///
/// # Errors
/// What to write instead.
pub fn air_cut_height(text: &str) -> Result<Length, String> {
    let trimmed = text.trim();
    let end = trimmed.find(|c: char| c.is_alphabetic()).unwrap_or(trimmed.len());
    let (number, unit) = trimmed.split_at(end);
    let number = number.trim().parse::<f64>().ok();
    if let (Some(number), true) = (number, unit.is_empty()) {
        return Err(match number > 0.0 {
            true => format!("a height needs a unit: write `{}mm`", show(number)),
            false => OUT_OF_RANGE.to_owned(),
        });
    }
    let found = number.and_then(|number| units::quantity(number, unit));
    let one = units::quantity(1.0, "mm");
    match (found, one) {
        (Some(found), Some(one)) if found.dimension == one.dimension => {
            if found.value > 0.0 && found.value <= HIGHEST {
                Ok(Length::mm(found.value))
            } else {
                Err(OUT_OF_RANGE.to_owned())
            }
        }
        _ => Err("write a length with its unit, such as 100mm".to_owned()),
    }
}

/// Puts the air cut in the place of an outcome's program. An outcome without a program stays as it is; where there is no air
/// cut at that height the outcome says why, and has no program any more.
pub fn into_air_cut(outcome: &mut Outcome, lift: Length, progress: &mut dyn FnMut(Stage)) {
    let Some(compiled) = outcome.compiled.take() else {
        return;
    };
    let Some(job) = &outcome.job else { return };
    match air_cut(job, compiled, lift, progress) {
        Ok(compiled) => outcome.compiled = Some(compiled),
        Err(diagnostic) => outcome.diagnostics.push(*diagnostic),
    }
}

fn air_cut(
    job: &CheckedJob,
    compiled: Compiled,
    lift: Length,
    progress: &mut dyn FnMut(Stage),
) -> Result<Compiled, Box<Diagnostic>> {
    let cutting = compiled.program.verified().program();
    let least = least_lift(cutting, clearance(job));
    if lift < least {
        return Err(Box::new(too_low(job, lift, least)));
    }
    progress(Stage::Reaching);
    let lifted = Lifted {
        job,
        cutting,
        lift,
        least,
    };
    let program = lifted.reached()?;
    let mut air = compiled_air_cut(job, &compiled, program);
    // Torques above limits are reported for the cuts: an air cut goes the same ways, higher up.
    dynamics::add_torques_in_air(job, &mut air);
    Ok(air)
}

/// The widest clearance that the job keeps from its stock.
fn clearance(job: &CheckedJob) -> Length {
    let operations = job.operations.iter();
    let all = operations.map(|operation| operation.setup().clearance.value);
    all.fold(Length::ZERO, Length::max)
}

/// A program on its way up.
struct Lifted<'l> {
    job: &'l CheckedJob,
    cutting: &'l Program,
    lift: Length,
    least: Length,
}

impl Lifted<'_> {
    fn reached(&self) -> Result<Finished, Box<Diagnostic>> {
        let program = self.verified(self.lift)?;
        let Some(machine) = &self.job.machine else {
            return Ok(Finished::WithoutMachine(Box::new(program)));
        };
        match solve(program, &machine.model, &LEAST_CLEARANCE, Changes::InTheAir) {
            Ok(reached) => Ok(Finished::Reached(Box::new(reached))),
            Err(unreached) => Err(Box::new(self.refused(&unreached))),
        }
    }

    fn verified(&self, lift: Length) -> Result<VerifiedProgram, Box<Diagnostic>> {
        verify(lifted(self.cutting, lift))
            .map_err(|faults| Box::new(internal(self.job, &rules_broken(&faults))))
    }

    /// Why the machine does not carry it out, and the least height if it carries that out.
    fn refused(&self, unreached: &Unreached) -> Diagnostic {
        let unreachable = match unreached {
            Unreached::Unreachable(unreachable) => unreachable,
            Unreached::Rules(faults) => return internal(self.job, &rules_broken(faults)),
            Unreached::Motion(faults) => return internal(self.job, &motions_broken(faults)),
        };
        let base = self.job.machine.as_ref().and_then(|machine| machine.base.span);
        let lift = show(self.lift.to_mm());
        let diagnostic = Diagnostic::new(
            Code::AirCut,
            format!("the machine cannot carry out the air cut {lift} mm above the program"),
            base.unwrap_or(self.job.name_span),
            "with the work in this place",
        );
        let diagnostic = match reach_verdict::explain(self.job, unreachable) {
            Some(why) => diagnostic.note(why.diagnostic.message),
            None => diagnostic,
        };
        let least = show(self.least.to_mm());
        if let Some(highest) = self.highest() {
            let highest = show(highest.to_mm());
            return diagnostic.help(format!("use `--air-cut {highest}mm`, which works"));
        }
        let diagnostic = if self.least < self.lift {
            diagnostic.note(format!(
                "nor {least} mm above it, the smallest height that keeps the blade clear of the stock"
            ))
        } else {
            diagnostic
        };
        diagnostic.help("run the program itself without stock, blade and generator, in manual mode")
    }

    /// The greatest height of those tried that the machine carries out, if it carries out the least.
    fn highest(&self) -> Option<Length> {
        if !self.is_carried_out(self.least) {
            return None;
        }
        let (mut works, mut fails) = (self.least, self.lift);
        for _ in 0..HALVINGS {
            let between = (works + fails) / 2.0;
            let between = Length::mm((between.to_mm() / OFFERED).floor() * OFFERED);
            if between <= works {
                break;
            }
            if self.is_carried_out(between) {
                works = between;
            } else {
                fails = between;
            }
        }
        Some(works)
    }

    fn is_carried_out(&self, lift: Length) -> bool {
        let (Ok(program), Some(machine)) = (self.verified(lift), &self.job.machine) else {
            return false;
        };
        lift < self.lift && solve(program, &machine.model, &LEAST_CLEARANCE, Changes::InTheAir).is_ok()
    }
}

fn too_low(job: &CheckedJob, lift: Length, least: Length) -> Diagnostic {
    Diagnostic::new(
        Code::AirCut,
        format!("an air cut {} mm above the program would meet the stock", show(lift.to_mm())),
        job.stock_span,
        "this stock",
    )
    .note("the lowest tip must pass above the stock by at least the job's `clearance` and half the blade's thickness")
    .help(format!("use `--air-cut {}mm`, or more", show(least.to_mm())))
}

/// The air cut of a compiled job.
fn compiled_air_cut(job: &CheckedJob, cutting: &Compiled, program: Finished) -> Compiled {
    let paced = paced(job, &program);
    let mut report = cutting.report.clone();
    report.times = times(program.verified(), &paced.times);
    let figures = program.reached().map(reach_figures::figures);
    let head = cutting.program.verified().program().head.as_ref();
    let head = head.map(|head| Head {
        time: report.times.all.total(),
        ..head.clone()
    });
    let program = program.headed(head);
    let summary = summary(
        &air_figures(cutting, &program),
        &report,
        paced.basis,
        figures.as_ref(),
    );
    let carried = job.machine.as_ref().zip(program.reached());
    let carried = carried.map(|(machine, reached)| Carried { machine, reached });
    Compiled {
        checks: Checks::of_air_cut(carried, paced.basis, Bodies::of(job)),
        parameters: cutting.parameters.clone(),
        not_followed: None,
        dynamics: Dynamics::default(),
        left_over: cutting.left_over,
        numbers: cutting.numbers.clone(),
        times: time_figures(&report, paced.basis),
        op_times: paced.times,
        summary,
        program,
        figures,
        report,
    }
}

fn air_figures(cutting: &Compiled, air: &Finished) -> AirFigures {
    let program = air.verified().program();
    let machine = match (air.reached(), cutting.program.reached()) {
        (None, _) | (_, None) => Mover::None,
        (Some(air), Some(cutting)) if branches(air).eq(branches(cutting)) => Mover::StandsAlike,
        (Some(_), Some(_)) => Mover::StandsOtherwise,
    };
    AirFigures {
        name: program.name.clone(),
        lift: match program.purpose {
            Purpose::AirCut { lift } => lift,
            Purpose::Work => Length::ZERO,
        },
        gap: least_gap(program),
        machine,
    }
}

/// The branches in order, whatever the ops at which they begin: the air cut has fewer ops.
fn branches(reached: &Reached) -> impl Iterator<Item = Branch> {
    reached.report.stretches.iter().map(|stretch| stretch.branch)
}
