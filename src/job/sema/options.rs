//! Options for targets, such as `krl { ... }` in a machine: evaluated here, compared with the target later.

use super::Typed;
use super::described;
use super::dimension::Dimension;
use super::eval::Scope;
use super::fields::{curve_words, head_span};
use super::files::Relative;
use super::names::Thing;
use super::overrides::Override;
use super::report::{Checked, Reported};
use super::session::Session;
use crate::{GivenOption, GivenValue, Machine, TargetOptions};
use std::collections::BTreeMap;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::source::{Span, Spanned, join_path};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_machine::habits;
use vcutc_syntax::ast::{Block, Entry, Expr};

/// The key of a file with the machine's habits. No target has an option of this name.
const PROFILE: &str = "profile";

/// The word that takes an option back.
const DEFAULT: &str = "default";

/// The options for all targets of a machine.
pub(crate) fn read(
    blocks: &[&Block],
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Vec<TargetOptions>> {
    let mut first: BTreeMap<String, Span> = BTreeMap::new();
    let mut targets = Vec::new();
    let mut fault = None;
    for block in blocks {
        let span = head_span(block);
        let target = session.sources.slice(span).to_owned();
        if let Some(first) = first.get(&target) {
            let diagnostic = Diagnostic::new(
                Code::FieldTwice,
                format!("the options for `{target}` are given twice"),
                span,
                "given again here",
            )
            .and(*first, "first given here")
            .help("put them into one block");
            fault = Some(session.reports.push(diagnostic));
            continue;
        }
        first.insert(target.clone(), span);
        match one(block, scope, session) {
            Ok((given, profile)) => targets.push(TargetOptions {
                target,
                span,
                given,
                profile,
            }),
            Err(reported) => fault = Some(reported),
        }
    }
    match fault {
        Some(reported) => Err(reported),
        None => Ok(targets),
    }
}

/// The options of one block, and its profile.
type Given = (Vec<GivenOption>, Option<Spanned<Profile>>);

fn one(block: &Block, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Given> {
    let mut first: BTreeMap<&str, Span> = BTreeMap::new();
    let mut options = Vec::new();
    let mut named = None;
    let mut fault = None;
    for entry in &block.entries {
        let done = match entry {
            Entry::Field { name, value, .. } => match first.insert(&name.node, name.span) {
                None if name.node == PROFILE => {
                    let beside = session.sources.name(value.span.file).to_owned();
                    profile(value, &beside, scope, session).map(|found| named = found)
                }
                None => option(name, value, scope, session).map(|option| options.push(option)),
                Some(earlier) => {
                    let fault = faults::twice(Code::FieldTwice, &name.node, name.span, earlier);
                    Err(session.reports.push(fault))
                }
            },
            Entry::Limit { span, .. } => Err(misplaced("a limit", *span, session)),
            Entry::Formula { span, .. } => Err(misplaced("a formula", *span, session)),
            Entry::Curve { curve, span } => Err(misplaced(curve_words(curve), *span, session)),
            Entry::SurfaceFile { kind, span, .. } => {
                Err(misplaced(&format!("`{}`", kind.node.word()), *span, session))
            }
            Entry::Station { span, .. } => Err(misplaced("`at`", *span, session)),
            Entry::ControlRow { word, .. } => Err(misplaced("`row`", *word, session)),
            Entry::Row { row, span, .. } => Err(misplaced(&format!("`{}`", row.node.word()), *span, session)),
            Entry::Block(inner) => Err(misplaced("a block", head_span(inner), session)),
        };
        if let Err(reported) = done {
            fault = Some(reported);
        }
    }
    match fault {
        Some(reported) => Err(reported),
        None => Ok((options, named)),
    }
}

/// The options of the command line.
#[derive(Clone, Copy)]
pub(crate) struct Said<'a> {
    /// What they are for, as given.
    pub(crate) typed: Typed<'a>,
    /// The options themselves, read.
    pub(crate) read: &'a [Override],
}

/// The machine with the options of the command line over those of its own block for the target.
pub(crate) fn over(
    mut machine: Machine,
    said: Said<'_>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Machine> {
    let Some(first) = said.read.first() else {
        return Ok(machine);
    };
    let target = said.typed.target;
    let own = machine.targets.iter().position(|block| block.target == target);
    let mut block = match own {
        Some(index) => machine.targets.remove(index),
        None => TargetOptions {
            target: target.to_owned(),
            span: first.name.span,
            given: Vec::new(),
            profile: None,
        },
    };
    let mut fault = None;
    for Override { name, value } in said.read {
        let done = if name.node == PROFILE {
            profile(value, said.typed.beside, scope, session).map(|profile| block.profile = profile)
        } else {
            option(name, value, scope, session).map(|option| {
                block.given.retain(|given| given.key != option.key);
                block.given.push(option);
            })
        };
        if let Err(reported) = done {
            fault = Some(reported);
        }
    }
    machine.targets.push(block);
    match fault {
        Some(reported) => Err(reported),
        None => Ok(machine),
    }
}

/// The habits in the file that a text names, relative to the folder of the file `beside`, or to the current folder for the empty
/// one; none for the word `default`.
fn profile(
    value: &Spanned<Expr>,
    beside: &str,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Spanned<Profile>>> {
    if word(&value.node, scope) == Some(DEFAULT) {
        return Ok(None);
    }
    let Expr::Text(name) = &value.node else {
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            "`profile` takes the name of a file in quotes",
            value.span,
            "this is not a text",
        );
        return Err(session
            .reports
            .push(diagnostic.help("write it as in `profile = \"gantry.toml\"`")));
    };
    let path = join_path(beside, name);
    if !session.profiles.contains_key(&path) {
        let relative = match beside {
            "" => Relative::ToTheCurrentFolder,
            _ => Relative::ToItsFile,
        };
        let profile = described::read(&path, relative, value.span, session, habits::parse);
        session.profiles.insert(path.clone(), profile);
    }
    let profile = session
        .profiles
        .get(&path)
        .cloned()
        .unwrap_or(Ok(Profile::default()))?;
    Ok(Some(Spanned::new(profile, value.span)))
}

fn misplaced(what: &str, span: Span, session: &mut Session<'_>) -> Reported {
    let diagnostic = Diagnostic::new(
        Code::Misplaced,
        format!("{what} is not an option of a target"),
        span,
        "options have the form `key = value`",
    );
    session
        .reports
        .push(diagnostic.help("delete it, or write it as `key = value`"))
}

fn option(
    name: &Spanned<String>,
    value: &Spanned<Expr>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<GivenOption> {
    Ok(GivenOption {
        key: name.node.clone(),
        key_span: name.span,
        value: given(name, value, scope, session)?,
        value_span: value.span,
    })
}

fn given(
    name: &Spanned<String>,
    value: &Spanned<Expr>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<GivenValue> {
    match word(&value.node, scope) {
        Some(DEFAULT) => return Ok(GivenValue::Default),
        Some(word) => return Ok(GivenValue::Word(word.to_owned())),
        None => {}
    }
    match &value.node {
        Expr::Text(text) => return Ok(GivenValue::Texts(vec![text.clone()])),
        Expr::Tuple(values) => return texts(values, session).map(GivenValue::Texts),
        Expr::Name(_) | Expr::Number { .. } | Expr::Call { .. } | Expr::Negate(_) | Expr::Binary { .. } => {}
    }
    let quantity = scope.evaluate(value, &mut session.reports)?;
    if quantity.dimension == Dimension::PURE {
        return Ok(GivenValue::Ratio(quantity.value));
    }
    if quantity.dimension == Dimension::LENGTH {
        return Ok(GivenValue::Length(Length::mm(quantity.value)));
    }
    let words = quantity.dimension.words();
    let diagnostic = Diagnostic::new(
        Code::WrongDimension,
        format!(
            "`{}` takes a length, a number, a text or a word, but this is {words}",
            name.node
        ),
        value.span,
        format!("this is {words}"),
    );
    Err(session
        .reports
        .push(diagnostic.help("see `vcutc targets` for the options of each target")))
}

/// A name that is not a `let`, and so a word of the target.
fn word<'e>(value: &'e Expr, scope: Scope<'_>) -> Option<&'e str> {
    let Expr::Name(word) = value else {
        return None;
    };
    let known = scope.names.get(word).map(|known| known.thing);
    (!matches!(known, Some(Thing::Let(_)))).then_some(word)
}

fn texts(values: &[Spanned<Expr>], session: &mut Session<'_>) -> Checked<Vec<String>> {
    let text = |value: &Spanned<Expr>| {
        if let Expr::Text(text) = &value.node {
            return Ok(text.clone());
        }
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            "a list of lines holds texts in quotes",
            value.span,
            "this is not a text",
        );
        Err(session
            .reports
            .push(diagnostic.help("write every line in quotes")))
    };
    let lines: Vec<Checked<String>> = values.iter().map(text).collect();
    lines.into_iter().collect()
}
