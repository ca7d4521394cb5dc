//! What a control does not take, found before anything is written.
//!
//! Of each kind of problem only the first is reported, with its op: a stock placed too far away would
//! otherwise be reported a million times. What is wrong with the options alone is in the module `demands`.

use crate::arcs::{self, WrittenArc};
use crate::axes::{NoWord, Word, printed, words};
use crate::chains;
use crate::controller::{Arcs, AxisPace, Controller, LARGEST_FEED};
use crate::demands;
use crate::job::Job;
use crate::options::{HOME_SPEED, PROGRAM_NUMBER, SPINDLE_AXIS, Settings};
use crate::pace::{self, Pace};
use crate::statement::FeedMode;
use crate::tools;
use vcutc_backend_api::backend::{BackendIssue, MachineMismatch};
use vcutc_backend_api::findings::{Findings, Number, driven_cell};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, AxisKind, AxisValues, Blade, Cell, MachineKind, OpId, PlacedFrame, Ready, Spindle, Switch, ToolId,
};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::script::{Part, Source};
use vcutc_backend_api::segments::{LinearSegment, Path};

/// Largest O number that is not kept for the builder's programs [F-30].
const LARGEST_O_NUMBER: u64 = 7999;

/// A speed is printed with a certain last decimal. It is refused below so many of its units, where rounding would change
/// it by more than a hundredth.
const SMALLEST_FEED_UNITS: f64 = 50.0;

const DRIVES: &str = "five-axis machines with linear axes X, Y, Z and rotary axes A, B or C";

const HOME_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "home",
    why: "the program begins and ends with an axis move to positions that the job states, so that it does not depend \
          on where the machine happens to stand",
};

/// What a program that can be said is written from.
pub(crate) struct Sayable<'p> {
    /// The machine.
    pub(crate) cell: &'p Cell,
    /// Its axes.
    pub(crate) words: Vec<Word>,
}

/// What the program is written from, or everything that stands in the way.
pub(crate) fn check<'p>(
    program: &'p ReachableProgram,
    settings: &Settings<'_>,
    parts: &[Part],
) -> Result<Sayable<'p>, Vec<BackendIssue>> {
    let cell = driven_cell(program, DRIVES, |cell| foreign(cell.kind))?;
    let words = match words(cell, settings.spindle_letter) {
        Ok(words) => words,
        Err(NoWord::Name) => {
            let (mismatch, drives) = (MachineMismatch::Arm, DRIVES);
            return Err(vec![BackendIssue::WrongMachine { mismatch, drives }]);
        }
        Err(NoWord::Spindle) => return Err(vec![spindle_without_letter()]),
        Err(NoWord::Taken(letter)) => return Err(vec![letter_taken(letter)]),
    };
    let mut found = Findings::beginning_with(demands::check(cell, settings));
    machine(cell, &program.program().blades, settings, &mut found);
    numbers(settings, parts, &mut found);
    let source = Source {
        reachable: program,
        cell,
    };
    ops(&Job::new(source, settings, &words), &mut found);
    found.result().map(|()| Sayable { cell, words })
}

/// What sets machines of a kind apart from those that G-code is for.
pub(crate) const fn foreign(kind: MachineKind) -> Option<MachineMismatch> {
    match kind {
        MachineKind::Robot => Some(MachineMismatch::Kind),
        MachineKind::FiveAxis => None,
    }
}

fn spindle_without_letter() -> BackendIssue {
    BackendIssue::OptionConflict {
        key: SPINDLE_AXIS,
        why: "the machine turns its blade with an orientable spindle, axis S, and S is a speed in G-code; say by which letter \
              the control moves the spindle as an axis, such as `spindle_axis = b` (M19 cannot turn it during a motion)"
            .to_owned(),
    }
}

fn letter_taken(letter: char) -> BackendIssue {
    BackendIssue::OptionConflict {
        key: SPINDLE_AXIS,
        why: format!("the machine has another axis {letter}"),
    }
}

fn machine(cell: &Cell, blades: &[Blade], settings: &Settings<'_>, found: &mut Findings) {
    let controller = settings.controller;
    if cell.home.is_none() {
        found.report("home", HOME_MISSING);
    }
    cell.tools
        .iter()
        .for_each(|(id, placed)| tool(cell, settings, (id, placed.frame), found));
    tools::are_distinct(cell, settings, found);
    if let Some(number) = cell.base.number {
        found.number("base number", number, 1..=controller.facts().work_offsets);
    }
    match cell.ultrasonic {
        Some(output) if settings.codes.on.is_empty() => {
            found.number("output number", output, controller.facts().signals.clone());
        }
        Some(_) | None => {}
    }
    found.generator(cell, blades);
    match cell.spindle {
        Some(Spindle::Output(output)) => spindle(output, controller, found),
        Some(Spindle::Own) | None => {}
    }
    match cell.ready {
        Ready::Input(input) if settings.codes.ready.is_empty() => {
            found.number("input number", input, controller.facts().signals.clone());
        }
        Ready::Input(_) => {}
        Ready::After(time) => found.wait(None, "time until ready", time),
    }
    if controller.facts().axis_pace != AxisPace::Rapid && cell.axes.iter().any(|axis| axis.rate.is_none()) {
        let issue = BackendIssue::OptionConflict {
            key: HOME_SPEED,
            why: "the machine's sheet does not state the rates of all its axes, so a part of them is not a speed; \
                  add `rate_mm_s` and `rate_deg_s` to the sheet"
                .to_owned(),
        };
        found.report("rates", issue);
    }
}

/// The output that runs a spindle has to be switched by a word of the control: `on_code` and `off_code` are the generator's.
fn spindle(output: u32, controller: &dyn Controller, found: &mut Findings) {
    if controller.switch(output, Switch::On).is_some() {
        found.number("output number", output, controller.facts().signals.clone());
    } else {
        let why = format!(
            "{} has no word of its own for output {output}, and `on_code` is the generator's; without `spindle` the machine turns the \
             blade by S and M3",
            controller.facts().name
        );
        found.report("spindle", BackendIssue::OptionConflict { key: "spindle", why });
    }
}

/// The control knows of the tool one length, along the spindle.
fn tool(cell: &Cell, settings: &Settings<'_>, (id, placed): (ToolId, PlacedFrame), found: &mut Findings) {
    let number = tools::number(cell, settings, id);
    let what = settings.facts().tool_number_name;
    found.number(what, number, 1..=settings.facts().most_tools);
    let Point3 { x, y, z } = placed.frame.origin;
    let half_a_unit = settings.common.lengths.half_unit();
    for (what, value) in [("tool X", x), ("tool Y", y)] {
        let unit = "mm";
        found.range(None, &Number { what, value, unit }, (-half_a_unit, half_a_unit));
    }
    length(None, "tool Z", z, settings, found);
}

fn length(op: Option<OpId>, what: &'static str, value: f64, settings: &Settings<'_>, found: &mut Findings) {
    let farthest = settings.controller.farthest(settings.common.lengths.decimals());
    let unit = "mm";
    found.range(op, &Number { what, value, unit }, (-farthest, farthest));
}

fn numbers(settings: &Settings<'_>, parts: &[Part], found: &mut Findings) {
    let last = u64::from(settings.program_number).saturating_add(parts.len() as u64);
    if settings.facts().numbers_programs && last > LARGEST_O_NUMBER {
        let issue = BackendIssue::OptionConflict {
            key: PROGRAM_NUMBER,
            why: format!(
                "the program and its parts would go up to O{last}, and O8000 and more are the builder's"
            ),
        };
        found.report("program number", issue);
    }
}

fn ops(job: &Job<'_>, found: &mut Findings) {
    let program = job.source.program();
    for segment in program.segments() {
        found.op(segment.id, &segment.op.action);
        match segment.path() {
            Path::Home | Path::Change | Path::Axes(_) => axes(job, segment.id, found),
            Path::Linear(line) => self::line(job, segment.id, (&segment.op.action, &line), found),
            Path::Still => {}
        }
    }
}

fn axes(job: &Job<'_>, op: OpId, found: &mut Findings) {
    let Some(to) = job.source.reachable.axes_after(op) else {
        return;
    };
    positions(job, op, &to, AxisKind::Linear, found);
    positions(job, op, &to, AxisKind::Rotary, found);
    let before = op.0.checked_sub(1).map(OpId);
    let before = before.and_then(|before| job.source.reachable.axes_after(before));
    for from in [before.as_ref(), None] {
        if let Some(pace) = pace::of_axes(job, from, &to) {
            feed(job, op, "speed of all axes", pace, found);
        }
    }
}

fn positions(job: &Job<'_>, op: OpId, axes: &AxisValues, kind: AxisKind, found: &mut Findings) {
    let settings = job.settings;
    let (what, unit, decimals) = match kind {
        AxisKind::Linear => ("axis position", "mm", settings.common.lengths.decimals()),
        AxisKind::Rotary => ("axis angle", "deg", settings.angles.decimals()),
    };
    let farthest = settings.controller.farthest(decimals);
    for &word in job.words.iter().filter(|word| word.kind == kind) {
        if let Some(value) = printed(word, axes) {
            found.range(Some(op), &Number { what, value, unit }, (-farthest, farthest));
        }
    }
}

fn line(job: &Job<'_>, op: OpId, (action, line): (&Action, &LinearSegment), found: &mut Findings) {
    let to = job.work_in_offset.in_offset(line.to.tip);
    for (what, value) in [("X", to.x), ("Y", to.y), ("Z", to.z)] {
        length(Some(op), what, value, job.settings, found);
    }
    let before = op.0.checked_sub(1).map(OpId);
    let before = before.and_then(|before| job.source.reachable.axes_after(before));
    let (Some(from), Some(to)) = (before, job.source.reachable.axes_after(op)) else {
        return;
    };
    positions(job, op, &to, AxisKind::Rotary, found);
    let pace = pace::of_line(job, line, &from, &to);
    chains::piece(job, op, (action, line), pace, found);
    centre(job, op, line, found);
    if let Some(pace) = pace {
        let what = match pace.mode {
            FeedMode::Tip => "tip speed",
            FeedMode::InverseTime | FeedMode::Rotary => "reorientation rate",
        };
        feed(job, op, what, pace, found);
    }
}

/// The centre of an arc, or the way to it.
fn centre(job: &Job<'_>, op: OpId, line: &LinearSegment, found: &mut Findings) {
    let Ok(Some(arc)) = arcs::written(job, line) else {
        return;
    };
    let said = match (arc, job.settings.facts().arcs) {
        (WrittenArc::About { centre, .. }, Arcs::AboutPole) => centre,
        (WrittenArc::About { offset, .. }, Arcs::InPlanes | Arcs::InAnyPlane) => offset,
        (WrittenArc::Through(point), _) => point.to_array(),
    };
    for value in said {
        length(Some(op), "centre of an arc", value, job.settings, found);
    }
}

fn feed(job: &Job<'_>, op: OpId, what: &'static str, pace: Pace, found: &mut Findings) {
    let unit = match pace.mode {
        FeedMode::Tip => "mm/min",
        FeedMode::InverseTime => "1/min",
        FeedMode::Rotary => "deg/min",
    };
    let smallest = SMALLEST_FEED_UNITS * job.settings.fine().unit();
    let value = pace.feed;
    found.range(Some(op), &Number { what, value, unit }, (smallest, LARGEST_FEED));
}
