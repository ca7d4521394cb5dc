//! The objections of a target in words.

use super::options::{block, option_span, said_by_profile};
use vcutc_backend_api::backend::{Backend, BackendIssue, Fault, MachineMismatch};
use vcutc_backend_api::ir::{Action, MachineKind, Maker, OpId, Program};
use vcutc_backend_api::protocol::PROGRAM_PREFIX;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{CheckedJob, Machine};
use vcutc_machine::{Model, usual_home};

/// What a target objects to, in words.
pub(super) fn objection(
    job: &CheckedJob,
    backend: &dyn Backend,
    program: &Program,
    issue: &BackendIssue,
    drivers: &[&str],
) -> Diagnostic {
    let target = backend.id();
    let machine = job
        .machine
        .as_ref()
        .map_or(job.name_span, |machine| machine.head_span);
    match issue {
        BackendIssue::WrongMachine { mismatch, drives } => {
            wrong_machine(job, target, (*mismatch, drives), drivers)
        }
        BackendIssue::MissingMachineField { field, why } => Diagnostic::new(
            Code::MissingMachineField,
            format!("target `{target}` needs the machine's `{field}`"),
            machine,
            format!("no `{field}` here"),
        )
        .note(*why)
        .help(add_field(field, job.machine.as_ref())),
        BackendIssue::OptionConflict { key, why } => option_conflict(job, backend, (key, why), machine),
        BackendIssue::Profile { key, why } => {
            let profile = block(job.machine.as_ref(), target).and_then(|block| block.profile.as_ref());
            unfit_profile(target, key, why, profile.map_or(machine, |profile| profile.span))
        }
        BackendIssue::Unsupported { op, what } => Diagnostic::new(
            Code::Unsupported,
            format!("target `{target}` cannot express this: {what}"),
            place_of(job, program, *op),
            "needed by this operation",
        )
        .help("choose another target, or move this to a separate job"),
        BackendIssue::Failed(fault) => {
            let place = fault.op.map_or(job.name_span, |op| place_of(job, program, op));
            failed(target, fault, place)
        }
        BackendIssue::OutOfRange {
            op,
            what,
            value,
            allowed,
            range: _,
        } => {
            let place = match op {
                Some(op) => {
                    speed_span(job, program, *op, what).unwrap_or_else(|| place_of(job, program, *op))
                }
                None => machine_span(job.machine.as_ref(), what).unwrap_or(machine),
            };
            out_of_range(target, what, (value, allowed), place)
        }
    }
}

/// An option that does not fit the others, or the machine: where the block, its profile or nothing gives it.
fn option_conflict(
    job: &CheckedJob,
    backend: &dyn Backend,
    (key, why): (&str, &str),
    machine: Span,
) -> Diagnostic {
    let target = backend.id();
    let block = block(job.machine.as_ref(), target);
    match (
        block.and_then(|block| option_span(block, key)),
        block.and_then(|block| said_by_profile(block, key)),
    ) {
        (None, Some(profile)) => unfit_profile(target, key, why, profile),
        (Some(given), _) => Diagnostic::new(
            Code::BadOption,
            format!("option `{key}` does not fit: {why}"),
            given,
            "this option",
        ),
        (None, None) => unfit_default(backend, key, why, machine),
    }
}

/// A value of a program that the target cannot write, and where it comes from.
fn out_of_range(target: &str, what: &str, (value, allowed): (&str, &str), place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::TargetRange,
        format!("target `{target}` does not take {what} {value}"),
        place,
        format!("{value} comes from here"),
    )
    .note(format!("{what} may be {allowed}"))
    .help(format!("change the job so that {what} is {allowed}"))
}

/// An outside program that wrote another program than the one it was given.
pub(crate) fn departed(target: &str, notes: &[String], place: Span) -> Diagnostic {
    let fault = Fault {
        op: None,
        what: "wrote something other than the program it was given, or reads it back differently".to_owned(),
        said: Vec::new(),
    };
    let diagnostic = failed(target, &fault, place);
    notes.iter().fold(diagnostic, Diagnostic::note)
}

/// An outside program that did not do its work.
pub(crate) fn failed(target: &str, fault: &Fault, place: Span) -> Diagnostic {
    let message = format!("the program of target `{target}` {}", fault.what);
    let diagnostic = Diagnostic::new(Code::OutsideProgram, message, place, "asked to write this");
    let said = fault.said.iter();
    said.fold(diagnostic, |diagnostic, line| {
        diagnostic.note(format!("it says: {line}"))
    })
    .help(format!(
        "nothing was written; report this to the authors of `{PROGRAM_PREFIX}{target}`: the job is not at fault"
    ))
}

/// A program that no machine is to carry out.
pub(crate) fn without_machine(job: &CheckedJob, backend: &dyn Backend) -> Diagnostic {
    Diagnostic::new(
        Code::MissingMachine,
        format!("target `{}` needs a machine, this job has none", backend.id()),
        job.name_span,
        "no `machine` block in this job or the files it uses",
    )
    .help(
        "add a block such as `machine cell = robot \"kuka/kr210_r3100_ultra\" { ... }`, or `use` a file that has one",
    )
}

pub(crate) fn kind_words(model: Option<&Model>) -> &'static str {
    match model.map(Model::kind) {
        Some(MachineKind::FiveAxis) => "a machine with linear and rotary axes",
        Some(MachineKind::Robot) | None => "a robot",
    }
}

/// What a machine is, and by whom: `a robot by KUKA`.
pub(crate) fn by_maker(model: Option<&Model>) -> String {
    let kind = kind_words(model);
    match model.map(|model| model.maker) {
        Some(Maker::Abb) => format!("{kind} by ABB"),
        Some(Maker::Kuka) => format!("{kind} by KUKA"),
        Some(Maker::Other) | None => format!("{kind} whose maker is not stated"),
    }
}

/// A machine that the target does not drive.
fn wrong_machine(
    job: &CheckedJob,
    target: &str,
    (mismatch, drives): (MachineMismatch, &str),
    drivers: &[&str],
) -> Diagnostic {
    let machine = job.machine.as_ref();
    let span = machine.map_or(job.name_span, |machine| machine.model_span);
    let model = machine.map(|machine| machine.model.as_ref());
    let name = model.map_or("this machine", |model| &model.name);
    let kind = kind_words(model);
    let (is, label) = match (mismatch, model.map(|model| model.maker)) {
        (MachineMismatch::Kind, _) => (kind.to_owned(), "a machine of this kind"),
        (MachineMismatch::Maker, Some(Maker::Abb)) => (by_maker(model), "its controller is by ABB"),
        (MachineMismatch::Maker, Some(Maker::Kuka)) => (by_maker(model), "its controller is by KUKA"),
        (MachineMismatch::Maker, Some(Maker::Other) | None) => (
            by_maker(model),
            "its controller is not known to accept such programs",
        ),
        (MachineMismatch::Arm, _) => (
            format!("{kind} with other axes, or another wrist"),
            "this target's programs cannot state its configurations",
        ),
    };
    let message = format!("target `{target}` does not drive `{name}`, {is}");
    let diagnostic =
        Diagnostic::new(Code::WrongMachine, message, span, label).note(format!("`{target}` drives {drives}"));
    let others = drivers.iter().filter(|&&driver| driver != target);
    let others: Vec<String> = others.map(|driver| format!("`--target {driver}`")).collect();
    match (mismatch, model.map(|model| model.maker)) {
        (_, _) if !others.is_empty() => {
            diagnostic.help(format!("write {}, which drives it", others.join(" or ")))
        }
        (MachineMismatch::Maker, Some(Maker::Other)) => match drives.split(' ').next() {
            Some(maker @ ("KUKA" | "ABB")) => diagnostic.help(format!(
                "if it is one of these, state `manufacturer = \"{maker}\"` in the file that describes it"
            )),
            Some(_) | None => diagnostic.help("choose another machine, or a target that drives it"),
        },
        (_, _) => {
            diagnostic.help("choose a target that drives it (`vcutc targets` lists them), or another machine")
        }
    }
}

/// What to do about a field that the machine lacks.
fn add_field(field: &str, machine: Option<&Machine>) -> String {
    let line = format!("add `{field} = {}` to this block", example(field, machine));
    match field {
        "ultrasonic" => format!("{line}; 12 is an example: write the output that the generator is wired to"),
        "load" => {
            format!("{line}; these values are an example: weigh your tool, or let the controller measure it")
        }
        "home" => format!("{line}: a pose of this model, from which the way to the work must be clear"),
        _ => line,
    }
}

/// A value for a field of the machine.
fn example(field: &str, machine: Option<&Machine>) -> String {
    match (field, machine) {
        ("home", Some(machine)) => usual_home(&machine.model),
        ("home", None) => "joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)".to_owned(),
        ("ultrasonic", _) => "output(12)".to_owned(),
        ("load", _) => "load(mass = 12 kg, x = 0 mm, y = 0 mm, z = 100 mm)".to_owned(),
        ("tool" | "base", _) => {
            "frame(x = 0 mm, y = 0 mm, z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)".to_owned()
        }
        _ => "...".to_owned(),
    }
}

fn unfit_profile(target: &str, key: &str, why: &str, profile: Span) -> Diagnostic {
    Diagnostic::new(
        Code::BadOption,
        format!("target `{target}` cannot do what the profile's `{key}` asks: {why}"),
        profile,
        "this profile",
    )
}

/// What is said of an option that the machine's block does not give; of what is not an option of the target,
/// only why.
fn unfit_default(backend: &dyn Backend, key: &str, why: &str, machine: Span) -> Diagnostic {
    let message = format!("option `{key}` does not fit: {why}");
    let Some(spec) = backend.options().iter().find(|spec| spec.key == key) else {
        return Diagnostic::new(Code::BadOption, message, machine, "this machine");
    };
    let label = format!("no `{key}` in its block `{} {{ ... }}`", backend.id());
    Diagnostic::new(Code::BadOption, message, machine, label).note(format!("`{key}`: {}", spec.help))
}

/// Where the machine's value of that kind stands; kinds begin with a word for the field they come from.
fn machine_span(machine: Option<&Machine>, what: &str) -> Option<Span> {
    let machine = machine?;
    match what.split(' ').next()? {
        "tool" => machine.tools.first().frame.span,
        "base" => machine.base.span,
        "load" => machine.tools.first().load.and_then(|load| load.span),
        "home" => machine.home.and_then(|home| home.span),
        "output" => machine.ultrasonic.and_then(|output| output.span),
        "input" | "time" => machine.ready.span,
        _ => None,
    }
}

/// Where the speed of an op stands.
fn speed_span(job: &CheckedJob, program: &Program, op: OpId, what: &str) -> Option<Span> {
    let op = program.ops.get(op.0 as usize)?;
    let asked = job.operations.get(usize::from(op.site.operation()?.0))?.setup();
    match (what, op.action) {
        ("tip speed", Action::Cut { .. }) => asked.cut_feed.span,
        ("tip speed", Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. }) => {
            asked.travel_feed.span
        }
        ("reorientation rate", Action::Travel { .. } | Action::Turn { .. }) => asked.reorient_rate.span,
        _ => None,
    }
}

/// Where the job asks for an op: the operation it belongs to, or the job as a whole.
fn place_of(job: &CheckedJob, program: &Program, op: OpId) -> Span {
    let operation = program.ops.get(op.0 as usize).and_then(|op| op.site.operation());
    let asked = operation.and_then(|id| job.operations.get(usize::from(id.0)));
    asked.map_or(job.name_span, |asked| asked.setup().head_span)
}
