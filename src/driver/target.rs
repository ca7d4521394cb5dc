//! Between a job and a target: options compared with what the target takes, and the target's objections in words.

mod speeds;

pub(super) use speeds::with_help;

use super::{Compiled, Request};
use vcutc_backend_api::backend::{
    Backend, BackendIssue, Fault, MachineMismatch, OptionKind, OptionSpec, OptionValue, Options, Origin,
};
use vcutc_backend_api::ir::{Action, MachineKind, Maker, OpId, Program};
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::protocol::PROGRAM_PREFIX;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::{Capability, VerifiedProgram};
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{CheckedJob, GivenOption, GivenValue, Machine, TargetOptions};
use vcutc_machine::{Model, usual_home};

/// The option that a profile can set too.
const DECIMALS: &str = "decimals";

/// Blocks in the machine that are meant for a target that does not exist.
pub(super) fn unknown_targets(job: &CheckedJob, targets: &[&'static dyn Backend]) -> Vec<Diagnostic> {
    let known: Vec<&str> = targets.iter().map(|backend| backend.id()).collect();
    let blocks = job.machine.iter().flat_map(|machine| &machine.targets);
    blocks
        .filter(|block| !known.contains(&block.target.as_str()))
        .map(|block| unknown_target(block, &known))
        .collect()
}

fn unknown_target(block: &TargetOptions, known: &[&str]) -> Diagnostic {
    let message = format!(
        "a machine has no block `{}`, and there is no target of that name",
        block.target
    );
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        message,
        block.span,
        "neither a field nor a target",
    )
    .help(format!("targets are: {}", known.join(", ")));
    match nearest(&block.target, known.iter().copied()).first() {
        Some(near) => diagnostic.fix(format!("use `{near}`"), block.span, *near),
        None => diagnostic,
    }
}

/// What a target of the job's machine does not take.
pub(super) struct Objection {
    pub(super) diagnostic: Diagnostic,
    /// The speeds that decide it, and by which factor they are off.
    off: Option<speeds::Off>,
}

impl From<Diagnostic> for Objection {
    fn from(diagnostic: Diagnostic) -> Self {
        Self {
            diagnostic,
            off: None,
        }
    }
}

/// What the targets for which the job's machine has a block object to its program, so that it is known before anything is
/// written. A block may stand there before the machine's signals and home are known: what is missing of those is reported when the
/// program is written. Targets that are programs of their own are not run for it.
pub(super) fn objections(job: &CheckedJob, compiled: &Compiled, request: Request<'_>) -> Vec<Objection> {
    let Some(reached) = compiled.program.reached() else {
        return Vec::new();
    };
    let is_asked = |backend: &&&dyn Backend| {
        backend.origin() == Origin::Linked
            && block(job.machine.as_ref(), backend.id()).is_some()
            // A run for one target reports the objections of that target.
            && request.options.target.is_empty()
    };
    let program = reached.program.program();
    let mut all = Vec::new();
    for &backend in request.targets.iter().filter(is_asked) {
        let options = match options(job, backend) {
            Ok(options) => options,
            Err(diagnostics) => {
                all.extend(diagnostics.into_iter().map(Objection::from));
                continue;
            }
        };
        let mut issues = missing(backend, reached.program.verified());
        if issues.is_empty()
            && let Err(found) = backend.check(&reached.program, &options)
        {
            issues = found;
        }
        issues.retain(is_of_program);
        all.extend(issues.iter().map(|issue| Objection {
            diagnostic: objection(job, backend, program, issue, &[]),
            off: speeds::Off::of(job, program, issue),
        }));
    }
    all
}

/// Whether an objection is to the program, not to what the machine's block says of the machine.
const fn is_of_program(issue: &BackendIssue) -> bool {
    match issue {
        BackendIssue::OutOfRange { .. }
        | BackendIssue::Unsupported { .. }
        | BackendIssue::OptionConflict { .. }
        | BackendIssue::Profile { .. } => true,
        BackendIssue::WrongMachine { .. }
        | BackendIssue::MissingMachineField { .. }
        | BackendIssue::Failed(_) => false,
    }
}

/// The options of a backend as the job gives them.
pub(super) fn options(job: &CheckedJob, backend: &dyn Backend) -> Result<Options, Vec<Diagnostic>> {
    let specs = backend.options();
    let mut options = Options::defaults(specs);
    let Some(block) = block(job.machine.as_ref(), backend.id()) else {
        return Ok(options);
    };
    let mut diagnostics = Vec::new();
    // What the job gives itself is set over what its profile says, and that over the default.
    if let Some(profile) = &block.profile {
        diagnostics.extend(set_decimals(&mut options, specs, block, profile));
        options = options.with_profile(profile.node.clone());
    }
    for given in &block.given {
        match specs.iter().find(|spec| spec.key == given.key) {
            Some(spec) => {
                if let Err(allowed) = set(&mut options, spec, &given.value) {
                    diagnostics.push(bad_option(given, &allowed, spec));
                }
            }
            None => diagnostics.push(unknown_option(given, backend)),
        }
    }
    if diagnostics.is_empty() {
        Ok(options)
    } else {
        Err(diagnostics)
    }
}

/// The block of a machine for a target.
fn block<'m>(machine: Option<&'m Machine>, target: &str) -> Option<&'m TargetOptions> {
    machine?.targets.iter().find(|block| block.target == target)
}

/// Sets the option `decimals` to what the profile says, where the target has that option. Where it has none, it is for the target
/// to say that it cannot follow.
fn set_decimals(
    options: &mut Options,
    specs: &'static [OptionSpec],
    block: &TargetOptions,
    profile: &Spanned<Profile>,
) -> Option<Diagnostic> {
    let spec = specs.iter().find(|spec| spec.key == DECIMALS)?;
    let decimals = profile.node.decimals?;
    let value = OptionValue::Integer(u32::from(decimals));
    let allowed = options.set(spec, value).err()?;
    if option_span(block, DECIMALS).is_some() {
        return None;
    }
    let message = format!(
        "target `{}` takes {allowed} for `{DECIMALS}`, and the profile says {decimals}",
        block.target
    );
    let diagnostic = Diagnostic::new(Code::BadOption, message, profile.span, "this profile");
    Some(diagnostic.help(format!(
        "give the block its own `{DECIMALS}`, which overrides the profile's"
    )))
}

fn set(options: &mut Options, spec: &OptionSpec, given: &GivenValue) -> Result<(), String> {
    // What cannot be converted is set to an empty list of lines, which `Options::set` refuses in the same words as a value
    // out of range. An option of lines would take it, so its refusal is worded below.
    let none = OptionValue::Lines(Vec::new());
    let value = match (spec.kind, given) {
        (OptionKind::Integer { .. }, GivenValue::Ratio(ratio)) => {
            whole(*ratio).map_or(none, OptionValue::Integer)
        }
        (OptionKind::Length { .. }, GivenValue::Length(length)) => OptionValue::Length(*length),
        (OptionKind::Lines, GivenValue::Texts(lines)) => OptionValue::Lines(lines.clone()),
        (OptionKind::Text, GivenValue::Texts(lines)) => match lines.as_slice() {
            [text] => OptionValue::Text(text.clone()),
            [] | [_, _, ..] => none,
        },
        (OptionKind::Choice { of }, GivenValue::Word(word)) => of
            .iter()
            .find(|known| *known == word)
            .map_or(none, |known| OptionValue::Choice(known)),
        (OptionKind::Lines, GivenValue::Ratio(_) | GivenValue::Length(_) | GivenValue::Word(_)) => {
            return Err("text in quotes".to_owned());
        }
        // What the profile or the target says is set already.
        (_, GivenValue::Default) => return Ok(()),
        (
            OptionKind::Integer { .. }
            | OptionKind::Length { .. }
            | OptionKind::Text
            | OptionKind::Choice { .. },
            GivenValue::Ratio(_) | GivenValue::Length(_) | GivenValue::Texts(_) | GivenValue::Word(_),
        ) => none,
    };
    options.set(spec, value)
}

/// A number without fraction that fits.
fn whole(ratio: f64) -> Option<u32> {
    let fits = ratio.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&ratio);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked on the line above"
    )]
    let number = ratio as u32;
    fits.then_some(number)
}

fn bad_option(given: &GivenOption, allowed: &str, spec: &OptionSpec) -> Diagnostic {
    let message = format!("option `{}` takes {allowed}", given.key);
    let diagnostic = Diagnostic::new(
        Code::BadOption,
        message,
        given.value_span,
        "this value does not fit",
    )
    .note(spec.help);
    match nearest_fitting(spec.kind, &given.value) {
        Some(value) => diagnostic.fix(format!("use `{value}`"), given.value_span, value),
        None => diagnostic,
    }
}

/// The value nearest to the one given that an option takes, as text.
fn nearest_fitting(kind: OptionKind, given: &GivenValue) -> Option<String> {
    match (kind, given) {
        (OptionKind::Integer { min, max, .. }, GivenValue::Ratio(ratio)) if ratio.is_finite() => {
            let (min, max) = (f64::from(min), f64::from(max));
            Some(format!("{:.0}", ratio.round().clamp(min, max)))
        }
        (OptionKind::Length { min, max, .. }, GivenValue::Length(length)) => {
            Some(format!("{} mm", length.max(min).min(max).to_mm()))
        }
        // A number that lacks its unit.
        (OptionKind::Length { min, max, .. }, GivenValue::Ratio(ratio)) if ratio.is_finite() => {
            Some(format!("{} mm", Length::mm(*ratio).max(min).min(max).to_mm()))
        }
        (OptionKind::Choice { of }, GivenValue::Word(word)) => nearest(word, of.iter().copied())
            .first()
            .or_else(|| of.first())
            .map(|word| (*word).to_owned()),
        (
            OptionKind::Integer { .. }
            | OptionKind::Length { .. }
            | OptionKind::Choice { .. }
            | OptionKind::Lines
            | OptionKind::Text,
            _,
        ) => None,
    }
}

fn unknown_option(given: &GivenOption, backend: &dyn Backend) -> Diagnostic {
    let keys: Vec<&str> = backend.options().iter().map(|spec| spec.key).collect();
    let message = format!("target `{}` has no option `{}`", backend.id(), given.key);
    let diagnostic = Diagnostic::new(Code::UnknownOption, message, given.key_span, "no such option")
        .help(format!("its options are: {}", keys.join(", ")));
    match nearest(&given.key, keys.iter().copied()).first() {
        Some(near) => diagnostic.fix(format!("use `{near}`"), given.key_span, *near),
        None => diagnostic,
    }
}

/// What the program needs and the target does not have at all; of a machine that it does not drive, that
/// alone is reported.
pub(super) fn missing(backend: &dyn Backend, program: &VerifiedProgram) -> Vec<BackendIssue> {
    let cell = program.program().cell.as_ref();
    if cell.is_some_and(|cell| backend.mismatch(cell.kind, cell.maker).is_some()) {
        return Vec::new();
    }
    let missing = program.needs().missing_from(backend.capabilities());
    missing
        .map(|capability| BackendIssue::Unsupported {
            op: needing(program, capability),
            what: capability.words(),
        })
        .collect()
}

/// The first op that needs something, as far as it is reported: after a change of the blade, what comes next of an operation.
fn needing(program: &VerifiedProgram, capability: Capability) -> OpId {
    let mut ops = program.ops();
    let found = match capability {
        Capability::ToolChange => {
            let _ = ops.find(|(_, op)| matches!(op.action, Action::ToolChange { .. }));
            ops.find(|(_, op)| op.site.operation().is_some())
        }
        Capability::Chain => ops.find(|(_, op)| matches!(op.action, Action::Follow { .. })),
        Capability::Spindle => ops.find(|(_, op)| matches!(op.action, Action::Spin { .. })),
        Capability::LinearMove
        | Capability::JointMove
        | Capability::StillTipTurn
        | Capability::Output
        | Capability::AwaitInput
        | Capability::Dwell => ops.next(),
    };
    found.map_or(OpId(0), |(id, _)| id)
}

/// A target's objections in words.
pub(super) fn diagnose(
    job: &CheckedJob,
    backend: &dyn Backend,
    program: &Program,
    issues: &[BackendIssue],
    drivers: &[&str],
) -> Vec<Diagnostic> {
    issues
        .iter()
        .map(|issue| objection(job, backend, program, issue, drivers))
        .collect()
}

/// The targets of this build that drive the machine of a job, as far as they say by themselves.
pub(super) fn drivers(job: &CheckedJob, targets: &[&'static dyn Backend]) -> Vec<&'static str> {
    let Some(machine) = &job.machine else {
        return Vec::new();
    };
    let (kind, maker) = (machine.model.kind(), machine.model.maker);
    let drivers = targets
        .iter()
        .filter(|backend| backend.origin() == Origin::Linked && backend.mismatch(kind, maker).is_none());
    drivers.map(|backend| backend.id()).collect()
}

fn objection(
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
        BackendIssue::OptionConflict { key, why } => {
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
        } => Diagnostic::new(
            Code::TargetRange,
            format!("target `{target}` does not take {what} {value}"),
            match op {
                Some(op) => {
                    speed_span(job, program, *op, what).unwrap_or_else(|| place_of(job, program, *op))
                }
                None => machine_span(job.machine.as_ref(), what).unwrap_or(machine),
            },
            format!("{value} comes from here"),
        )
        .note(format!("{what} may be {allowed}"))
        .help(format!("change the job so that {what} is {allowed}")),
    }
}

/// An outside program that wrote another program than the one it was given.
pub(super) fn departed(target: &str, notes: &[String], place: Span) -> Diagnostic {
    let fault = Fault {
        op: None,
        what: "wrote something other than the program it was given, or reads it back differently".to_owned(),
        said: Vec::new(),
    };
    let diagnostic = failed(target, &fault, place);
    notes.iter().fold(diagnostic, Diagnostic::note)
}

/// An outside program that did not do its work.
pub(super) fn failed(target: &str, fault: &Fault, place: Span) -> Diagnostic {
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
pub(super) fn without_machine(job: &CheckedJob, backend: &dyn Backend) -> Diagnostic {
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

pub(super) fn kind_words(model: Option<&Model>) -> &'static str {
    match model.map(Model::kind) {
        Some(MachineKind::FiveAxis) => "a machine with linear and rotary axes",
        Some(MachineKind::Robot) | None => "a robot",
    }
}

/// What a machine is, and by whom: `a robot by KUKA`.
pub(super) fn by_maker(model: Option<&Model>) -> String {
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

/// Where an option has a value of its own.
fn option_span(block: &TargetOptions, key: &str) -> Option<Span> {
    let mut given = block.given.iter();
    given
        .find(|given| given.key == key && given.value != GivenValue::Default)
        .map(|given| given.value_span)
}

/// Where a profile is named that sets an option.
fn said_by_profile(block: &TargetOptions, key: &str) -> Option<Span> {
    let profile = block.profile.as_ref()?;
    (key == DECIMALS && profile.node.decimals.is_some()).then_some(profile.span)
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
