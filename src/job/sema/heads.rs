//! What the heads of blocks at the top of a file say.

use super::fields::head_span;
use super::machine;
use super::names::did_you_mean;
use vcutc_backend_api::ir::MachineKind;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Block, HeadPart};

/// A kind of block.
#[derive(Clone, Copy)]
pub(crate) enum Kind<'a> {
    /// `stock`.
    Stock,
    /// `profile`.
    Profile,
    /// `cell`.
    Cell,
    /// `blade NAME`.
    Blade(Spanned<&'a str>),
    /// `rough vcut`.
    RoughVcut,
    /// `machine NAME = robot "model"`.
    Machine(machine::Head<'a>),
}

/// First words of heads, and how a whole head looks.
pub(crate) const FORMS: &[(&str, &str)] = &[
    ("stock", "stock { ... }"),
    ("profile", "profile { ... }"),
    ("blade", "blade NAME { ... }"),
    ("rough", "rough vcut { ... }"),
    (
        "machine",
        "machine NAME = robot \"kuka/kr210_r3100_ultra\" { ... }",
    ),
    ("cell", "cell { machine = NAME }"),
];

/// What may follow `rough`.
pub(crate) const ROUGHINGS: &[&str] = &["vcut"];

/// Kinds of machine.
pub(crate) const MACHINES: &[(&str, MachineKind)] = &[
    ("robot", MachineKind::Robot),
    ("five_axis", MachineKind::FiveAxis),
];

/// The kind of a block.
pub(crate) fn classify(block: &Block) -> Result<Kind<'_>, Box<Diagnostic>> {
    let parts: Vec<(&HeadPart, Span)> = block.head.iter().map(|part| (&part.node, part.span)).collect();
    let Some(&(HeadPart::Word(first), at)) = parts.first() else {
        let diagnostic = Diagnostic::new(
            Code::UnknownBlock,
            "a block begins with a word that says what it is",
            head_span(block),
            "no such word",
        );
        return Err(Box::new(with_list(diagnostic)));
    };
    let rest = parts.get(1..).unwrap_or_default();
    match first.as_str() {
        "stock" => plain(Kind::Stock, first, rest),
        "profile" => plain(Kind::Profile, first, rest),
        "cell" => plain(Kind::Cell, first, rest),
        "blade" => blade(at, rest),
        "rough" => rough(at, rest),
        "machine" => machine(at, rest),
        _ => Err(Box::new(unknown(first, at))),
    }
}

fn form_of(first: &str) -> &'static str {
    FORMS
        .iter()
        .find(|(word, _)| *word == first)
        .map_or("", |(_, form)| form)
}

fn unknown(word: &str, at: Span) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        format!("there is no block `{word}`"),
        at,
        "not a block of the language",
    );
    if ROUGHINGS.contains(&word) || ["roughing", "vcuts", "v_cut"].contains(&word) {
        return diagnostic.fix("write `rough vcut`", at, "rough vcut");
    }
    let near = nearest(word, FORMS.iter().map(|(word, _)| *word));
    with_list(did_you_mean(diagnostic, at, &near))
}

fn with_list(diagnostic: Diagnostic) -> Diagnostic {
    let names: Vec<&str> = FORMS.iter().map(|(word, _)| *word).collect();
    diagnostic.note(format!(
        "a job contains `job`, `use`, `let` and the blocks {}",
        names.join(", ")
    ))
}

/// A head of one word.
fn plain<'a>(kind: Kind<'a>, first: &str, rest: &[(&HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    match rest.first() {
        None => Ok(kind),
        Some((_, at)) => Err(surplus(first, *at)),
    }
}

/// Something behind a head that is complete.
fn surplus(first: &str, at: Span) -> Box<Diagnostic> {
    let form = form_of(first);
    let diagnostic = Diagnostic::new(
        Code::Misplaced,
        format!("unexpected text after the head of `{first}`"),
        at,
        "does not belong here",
    );
    Box::new(diagnostic.help(format!("write `{form}`")))
}

/// A head that ends too early.
fn incomplete(first: &str, what: &str, at: Span) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(
        Code::MissingField,
        format!("`{first}` needs {what}"),
        at,
        format!("{what} is missing after this"),
    );
    Box::new(diagnostic.help(format!("write `{}`", form_of(first))))
}

fn blade<'a>(at: Span, rest: &[(&'a HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    match rest {
        [(HeadPart::Word(name), span)] => Ok(Kind::Blade(Spanned::new(name, *span))),
        [(HeadPart::Word(_), _), (_, span), ..] => Err(surplus("blade", *span)),
        _ => Err(incomplete("blade", "a name", at)),
    }
}

fn rough<'a>(at: Span, rest: &[(&'a HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    match rest {
        [(HeadPart::Word(kind), _), more @ ..] if ROUGHINGS.contains(&kind.as_str()) => match more {
            [] => Ok(Kind::RoughVcut),
            [(_, span), ..] => Err(surplus("rough", *span)),
        },
        [(HeadPart::Word(kind), span), ..] => {
            let diagnostic = Diagnostic::new(
                Code::UnknownBlock,
                format!("there is no operation `rough {kind}`"),
                *span,
                "not a kind of roughing",
            );
            let near = nearest(kind, ROUGHINGS.iter().copied());
            let diagnostic = did_you_mean(diagnostic, *span, &near);
            Err(Box::new(
                diagnostic.note(format!("kinds of roughing: {}", ROUGHINGS.join(", "))),
            ))
        }
        _ => Err(incomplete("rough", "a kind of roughing", at)),
    }
}

fn machine<'a>(at: Span, rest: &[(&'a HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    let (name, behind) = match rest {
        [(HeadPart::Word(name), span), behind @ ..] => (Spanned::new(name.as_str(), *span), behind),
        _ => return Err(incomplete("machine", "a name", at)),
    };
    let (kind, behind) = match behind {
        [(HeadPart::Equals, _), (HeadPart::Word(kind), span), behind @ ..] => {
            (Spanned::new(machine_kind(kind, *span)?, *span), behind)
        }
        _ => return Err(incomplete("machine", "what it is", name.span)),
    };
    match behind {
        [(HeadPart::Text(model), span)] => {
            let model = Spanned::new(model.as_str(), *span);
            Ok(Kind::Machine(machine::Head { name, kind, model }))
        }
        [(HeadPart::Text(_), _), (_, span), ..] => Err(surplus("machine", *span)),
        _ => Err(incomplete("machine", "its model", name.span)),
    }
}

fn machine_kind(kind: &str, at: Span) -> Result<MachineKind, Box<Diagnostic>> {
    if let Some((_, known)) = MACHINES.iter().find(|(word, _)| *word == kind) {
        return Ok(*known);
    }
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        format!("there is no machine of the kind `{kind}`"),
        at,
        "not a kind of machine",
    );
    let names: Vec<&str> = MACHINES.iter().map(|(word, _)| *word).collect();
    let near = nearest(kind, names.iter().copied());
    let diagnostic = did_you_mean(diagnostic, at, &near);
    Err(Box::new(
        diagnostic.note(format!("kinds of machine: {}", names.join(", "))),
    ))
}
