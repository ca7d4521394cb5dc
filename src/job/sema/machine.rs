//! `machine NAME = robot "model" { ... }`: the machine that carries the blade.

use super::arguments::calls;
use super::eval::Scope;
use super::field_ranges::{SHARE, SIGNAL, WAIT};
use super::fields::{BlockSpec, Fields, Inner, Place, Takes, block, limit, value};
use super::frame::{self, FRAME, required_frame};
use super::heads::Head;
use super::home::{self, JOINTS};
use super::load::{self, LOAD, LOADS};
use super::model;
use super::options;
use super::read::{Reader, default, optional, sourced, words_of};
use super::report::Checked;
use super::session::{Described, Session};
use super::setup::inner_place;
use super::tools;
use crate::{Gravity, Machine, Sourced};
use vcutc_backend_api::ir::Ready;
use vcutc_backend_api::units::Duration;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Block, Expr};

const OUTPUTS: &[(&str, &str)] = &[("output", "output(12)")];
const GRAVITY: &[(&str, Gravity)] = &[
    ("compensated", Gravity::Compensated),
    ("uncompensated", Gravity::Uncompensated),
];
const READY: &[(&str, &str)] = &[("input", "input(7)"), ("after", "after(0.5 s)")];

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`machine`",
    fields: &[
        value("tool", FRAME).required().takes(Takes::Calls(frame::CALLS)),
        value(
            "base",
            "frame(x = 1800 mm, y = 0 mm, z = 700 mm, a = 0 deg, b = 0 deg, c = 0 deg)",
        )
        .required()
        .takes(Takes::Calls(frame::CALLS)),
        value("load", LOAD).takes(Takes::Calls(LOADS)),
        value("home", JOINTS).takes(Takes::Calls(home::CALLS)),
        block(
            "change",
            "{ at = joints(90 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg), time = 60 s, by = hand }",
        )
        .takes(Takes::Fields(&tools::CHANGE)),
        value("ultrasonic", "output(12)").takes(Takes::Calls(OUTPUTS)),
        value("spindle", "output(13)").takes(Takes::Calls(OUTPUTS)),
        value("ready", "after(0.5 s)").takes(Takes::Calls(READY)),
        value("gravity", "compensated").takes(Takes::Words(|| words_of(GRAVITY))),
        block("limits", "{ torque <= 80 % }").takes(Takes::Fields(&LIMITS)),
    ],
    inner: Inner::Machine {
        named: tools::TOOL,
        spec: &tools::SPEC,
    },
};

const LIMITS: BlockSpec = BlockSpec {
    title: "`limits` of a machine",
    fields: &[limit("torque", "80 %").within(SHARE)],
    inner: Inner::Refused,
};

/// Time after which the generator counts as up, when the job does not say: a usual value, from no source. The language
/// reference asks users to measure theirs.
const SETTLED: Duration = Duration::s(0.5);

/// The machine.
pub(crate) fn check(
    head: &Head<'_>,
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Machine> {
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let targets = options::read(&fields.targets, scope, session);
    let model = model::resolve(head, session);
    let tools = tools::check(&fields, scope, session);
    let change = match (fields.block("change"), &model) {
        (Ok(block), Ok(described)) => {
            tools::change(block, (&described.model, head.model.span), scope, session)
        }
        (Err(reported), _) | (_, &Err(reported)) => Err(reported),
    };
    let torque_limit = torque_limit(fields.block("limits"), scope, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let base = required_frame(&fields, "base", &mut reader);
    let home = match (fields.value("home"), &model) {
        (Ok(None), _) => Ok(None),
        (Ok(Some(expr)), Ok(described)) => {
            home::read(home::HOME, expr, &described.model, head.model.span, &mut reader)
                .map(|home| Some(sourced(home, expr.span)))
        }
        (Err(reported), _) | (_, &Err(reported)) => Err(reported),
    };
    let ultrasonic = optional(&fields, "ultrasonic", &mut reader, output);
    let spindle = optional(&fields, "spindle", &mut reader, output);
    if let (Ok(Some(generator)), Ok(Some(drive))) = (&ultrasonic, &spindle)
        && generator.value == drive.value
    {
        return Err(reader.reports.push(one_output(generator, drive, place.head)));
    }
    let ready = optional(&fields, "ready", &mut reader, ready);
    let gravity = reader.choice(&fields, "gravity", GRAVITY);
    let Described { model, limits } = model?;
    let tools = tools?;
    load::check(&tools, &model, head.model.span, &mut session.reports)?;
    Ok(Machine {
        name: head.name.node.to_owned(),
        head_span: place.head,
        model,
        model_span: head.model.span,
        limit_spans: limits,
        tools,
        base: base?,
        home: home?,
        change: change?,
        ultrasonic: ultrasonic?,
        spindle: spindle?,
        ready: ready?.unwrap_or(default(Ready::After(SETTLED))),
        gravity: gravity?,
        torque_limit: torque_limit?,
        targets: targets?,
    })
}

fn torque_limit(
    block: Checked<Option<&Block>>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Sourced<f64>>> {
    let Some(block) = block? else {
        return Ok(None);
    };
    let fields = Fields::sort(&LIMITS, inner_place(block), &block.entries, session);
    Reader::new(scope, &mut session.reports).optional(&fields, "torque")
}

fn one_output(generator: &Sourced<u32>, drive: &Sourced<u32>, head: Span) -> Diagnostic {
    Diagnostic::new(
        Code::OutOfRange,
        format!("`ultrasonic` and `spindle` are both output {}", drive.value),
        drive.span.unwrap_or(head),
        "the drive of the spindle",
    )
    .and(generator.span.unwrap_or(head), "the generator")
    .help("give each of them the number of its own output")
}

fn output(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<u32> {
    let call = calls(field, expr, OUTPUTS, reader.reports)?;
    let number = call.single(reader.reports)?;
    reader.whole(number, SIGNAL, "the number of an output")
}

fn ready(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Ready> {
    let call = calls(field, expr, READY, reader.reports)?;
    let value = call.single(reader.reports)?;
    if call.function == "input" {
        return reader
            .whole(value, SIGNAL, "the number of an input")
            .map(Ready::Input);
    }
    let time = reader.within(value, WAIT, "`after`", Some("0.5 s"))?;
    Ok(Ready::After(Duration::s(time)))
}
