//! How a machine holds its blades: `tool = frame(...)` for one, whichever it is, or a block `tool NAME { ... }` for each;
//! and how they are changed: `change { ... }`.

use super::eval::Scope;
use super::field_ranges::{TABLE_NUMBER, WAIT};
use super::fields::{BlockSpec, Fields, Inner, NamedBlock, Takes, value};
use super::frame::{self, FRAME, required_frame};
use super::home::{self, JOINTS};
use super::load::{self, LOAD, LOADS};
use super::names::Thing;
use super::read::{Reader, optional, words_of};
use super::report::Checked;
use super::session::Session;
use super::setup::inner_place;
use crate::{BladeRef, HeldChange, HeldTool, HeldTools, Machine};
use vcutc_backend_api::ir::{Change, Changer};
use vcutc_backend_api::units::Duration;
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_machine::Model;
use vcutc_syntax::ast::{Block, Expr};

/// The word before the name of a blade.
pub(crate) const TOOL: &str = "tool";

/// `tool NAME { ... }`.
pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`tool`",
    fields: &[
        value("frame", FRAME).required().takes(Takes::Calls(frame::CALLS)),
        value("load", LOAD).takes(Takes::Calls(LOADS)),
        value("place", "2").within(TABLE_NUMBER),
    ],
    inner: Inner::Refused,
};

/// `change { ... }`.
pub(crate) const CHANGE: BlockSpec = BlockSpec {
    title: "`change`",
    fields: &[
        value("at", JOINTS).required().takes(Takes::Calls(home::CALLS)),
        value("time", "10 s").required().within(WAIT),
        value("by", "hand")
            .required()
            .takes(Takes::Words(|| words_of(CHANGERS))),
    ],
    inner: Inner::Refused,
};

const CHANGERS: &[(&str, Changer)] = &[("program", Changer::Program), ("hand", Changer::Hand)];

/// All tools of a machine.
pub(crate) fn check(fields: &Fields<'_>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<HeldTools> {
    if fields.named.is_empty() {
        return whichever(fields, scope, session);
    }
    let held: Vec<Checked<HeldTool>> = fields
        .named
        .iter()
        .map(|named| one(*named, scope, session))
        .collect();
    for word in [TOOL, "load"] {
        if let Some(span) = fields.place_of(word) {
            return Err(session.reports.push(beside_blocks(word, span, &fields.named)));
        }
    }
    let held = held.into_iter().collect::<Checked<Vec<HeldTool>>>()?;
    if let Some(diagnostic) = twice(&held) {
        return Err(session.reports.push(diagnostic));
    }
    match HeldTools::of(held) {
        Some(tools) => Ok(tools),
        None => whichever(fields, scope, session),
    }
}

/// The tool that holds whichever blade the job uses.
fn whichever(fields: &Fields<'_>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<HeldTools> {
    let mut reader = Reader::new(scope, &mut session.reports);
    let frame = required_frame(fields, TOOL, &mut reader);
    let load = optional(fields, "load", &mut reader, load::read);
    Ok(HeldTools::one(HeldTool {
        blade: None,
        frame: frame?,
        load: load?,
        place: None,
    }))
}

/// The tool of a blade.
fn one(named: NamedBlock<'_>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<HeldTool> {
    let NamedBlock { name, block } = named;
    let blade = blade(name, scope, session);
    let fields = Fields::sort(&SPEC, inner_place(block), &block.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let frame = required_frame(&fields, "frame", &mut reader);
    let load = optional(&fields, "load", &mut reader, load::read);
    let place = optional(&fields, "place", &mut reader, place);
    Ok(HeldTool {
        blade: Some(blade?),
        frame: frame?,
        load: load?,
        place: place?,
    })
}

fn blade(name: Spanned<&str>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Spanned<String>> {
    let is_blade = |thing| matches!(thing, Thing::Blade(_));
    match scope.names.get(name.node).map(|definition| definition.thing) {
        Some(Thing::Blade(_)) => Ok(Spanned::new(name.node.to_owned(), name.span)),
        Some(Thing::Let(_) | Thing::Region(_) | Thing::Machine(_)) | None => {
            Err(scope
                .names
                .not_a("blade", name.node, name.span, is_blade, &mut session.reports))
        }
    }
}

fn place(_: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<u32> {
    reader.whole(expr, TABLE_NUMBER, "the place of a tool")
}

/// A field of one tool beside blocks of several.
fn beside_blocks(word: &str, span: Span, named: &[NamedBlock<'_>]) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::Misplaced,
        format!("`{word}` does not go with blocks `tool NAME {{ ... }}`"),
        span,
        "for a machine with one blade",
    )
    .help(format!(
        "delete it, and give each block `tool` a `{}` of its own",
        match word {
            TOOL => "frame",
            word => word,
        }
    ));
    match named.first() {
        Some(first) => diagnostic.and(first.name.span, "a tool with its blade"),
        None => diagnostic,
    }
}

/// Two tools that cannot both be there: for one blade, in one place, or of one number.
fn twice(held: &[HeldTool]) -> Option<Diagnostic> {
    held.iter().enumerate().find_map(|(index, tool)| {
        let before = held.get(..index).unwrap_or_default();
        before.iter().find_map(|first| both(first, tool))
    })
}

fn both(first: &HeldTool, tool: &HeldTool) -> Option<Diagnostic> {
    if let (Some(one), Some(other)) = (&first.blade, &tool.blade)
        && one.node == other.node
    {
        return Some(faults::twice(
            Code::FieldTwice,
            &format!("tool {}", one.node),
            other.span,
            one.span,
        ));
    }
    let places = first.place.zip(tool.place);
    let numbers = first.frame.value.number.zip(tool.frame.value.number);
    let (what, spans) = match (places, numbers) {
        (Some((one, other)), _) if one.value == other.value => {
            (format!("place {}", one.value), [one.span, other.span])
        }
        (_, Some((one, other))) if one == other => {
            (format!("the number {one}"), [first.frame.span, tool.frame.span])
        }
        (_, _) => return None,
    };
    let [Some(one), Some(other)] = spans else {
        return None;
    };
    Some(
        Diagnostic::new(
            Code::SamePlace,
            format!("two tools have {what}"),
            other,
            "taken already",
        )
        .and(one, "by this tool")
        .help("give each tool a place and a number of its own"),
    )
}

/// How the blades are changed, if the machine says it.
pub(crate) fn change(
    block: Option<&Block>,
    (model, model_span): (&Model, Span),
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<HeldChange>> {
    let Some(block) = block else { return Ok(None) };
    let place = inner_place(block);
    let fields = Fields::sort(&CHANGE, place, &block.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let at = fields
        .required_value("at", reader.reports)
        .and_then(|expr| home::read("at", expr, model, model_span, &mut reader));
    let time = reader.required::<Duration>(&fields, "time");
    let by = fields
        .required_value("by", reader.reports)
        .and_then(|expr| reader.word("by", expr, CHANGERS));
    Ok(Some(HeldChange {
        change: Change {
            at: at?,
            time: time?.value,
            by: by?.value,
        },
        span: place.head,
    }))
}

/// The machine with the tools that a job needs, in the order in which its blades are first used.
pub(crate) fn used(mut machine: Machine, blades: &[BladeRef<'_>]) -> Result<Machine, Box<Diagnostic>> {
    let mut wanted: Vec<BladeRef<'_>> = Vec::new();
    for &blade in blades {
        if !wanted.iter().any(|known| known.name() == blade.name()) {
            wanted.push(blade);
        }
    }
    if let (None, [first, second, ..]) = (&machine.tools.first().blade, wanted.as_slice()) {
        return Err(Box::new(one_tool(&machine, *first, *second)));
    }
    let mut held = Vec::new();
    for blade in &wanted {
        match machine.tools.holding(blade.name()) {
            Some(tool) => held.push(tool.clone()),
            None => return Err(Box::new(without_tool(&machine, *blade))),
        }
    }
    if let Some(&blade) = wanted.iter().find(|blade| blade.spin().is_some())
        && machine.spindle().is_none()
    {
        return Err(Box::new(without_spindle(&machine, blade)));
    }
    if let [_, second, ..] = held.as_slice() {
        match &machine.change {
            None => return Err(Box::new(no_change(&machine, second))),
            Some(held_change) => {
                let lacking = match held_change.change.by {
                    Changer::Program => held.iter().find(|tool| tool.place.is_none()),
                    Changer::Hand => None,
                };
                if let Some(tool) = lacking {
                    return Err(Box::new(no_place(tool, held_change, &machine)));
                }
            }
        }
    }
    if let Some(tools) = HeldTools::of(held) {
        machine.tools = tools;
    }
    Ok(machine)
}

/// A machine with one tool for two blades.
fn one_tool(machine: &Machine, first: BladeRef<'_>, second: BladeRef<'_>) -> Diagnostic {
    Diagnostic::new(
        Code::BladeWithoutTool,
        format!(
            "the job uses blades `{}` and `{}`, but `{}` has one tool",
            first.name(), second.name(), machine.name
        ),
        machine.tools.first().frame.span.unwrap_or(machine.head_span),
        "the frame of one blade",
    )
    .and(second.span(), "the other blade")
    .help(format!(
        "write a block for each blade, `tool {} {{ frame = ... }}` and `tool {} {{ frame = ... }}`, and how they are changed, \
         `change {{ ... }}`",
        first.name(), second.name()
    ))
}

fn without_tool(machine: &Machine, blade: BladeRef<'_>) -> Diagnostic {
    Diagnostic::new(
        Code::BladeWithoutTool,
        format!("`{}` has no tool for blade `{}`", machine.name, blade.name()),
        machine.head_span,
        "its tools are for other blades",
    )
    .and(blade.span(), "the job uses this blade")
    .help(format!(
        "add `tool {} {{ frame = ... }}` with its measured frame",
        blade.name()
    ))
}

/// A robot with a blade that nothing spins.
fn without_spindle(machine: &Machine, blade: BladeRef<'_>) -> Diagnostic {
    let (name, kind) = (blade.name(), blade.kind().word());
    Diagnostic::new(
        Code::BladeWithoutTool,
        format!("`{}` does not say what spins {kind} `{name}`", machine.name),
        machine.head_span,
        "has no `spindle`",
    )
    .and(blade.span(), format!("this {kind} spins"))
    .help("add `spindle = output(13)` with the number of the output that runs its drive")
}

fn no_change(machine: &Machine, second: &HeldTool) -> Diagnostic {
    let name = second.blade.as_ref().map_or("", |blade| &blade.node);
    Diagnostic::new(
        Code::NoChange,
        format!("`{}` does not say how its blades are changed", machine.name),
        machine.head_span,
        format!("blade `{name}` has to be put in"),
    )
    .help("add `change { at = ..., time = 60 s, by = hand }`: where the axes are, how long it takes, and who does it")
}

fn no_place(tool: &HeldTool, change: &HeldChange, machine: &Machine) -> Diagnostic {
    let (name, span) = match &tool.blade {
        Some(blade) => (blade.node.as_str(), blade.span),
        None => ("", machine.head_span),
    };
    Diagnostic::new(
        Code::NoChange,
        format!("the tool of blade `{name}` has no place"),
        span,
        "a routine that changes blades needs their places",
    )
    .and(change.span, "changed by the program")
    .help("add `place = 1`, or the number that the routine of the cell knows it by")
}
