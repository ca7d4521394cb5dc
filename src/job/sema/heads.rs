//! What the heads of blocks at the top of a file say.

use super::fields::head_span;
use super::kind::{Kind as OperationKind, Operations};
use super::names::did_you_mean;
use crate::BladeKind;
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
    /// `surface`.
    Surface,
    /// `region NAME`.
    Region(Spanned<&'a str>),
    /// `cell`.
    Cell,
    /// `blade NAME`, `blade NAME = disc`.
    Blade(BladeHead<'a>),
    /// An operation such as `rough vcut`.
    Operation(&'static dyn OperationKind),
    /// `machine NAME = robot "model"`.
    Machine(Head<'a>),
}

/// What the head of a blade's block says.
#[derive(Clone, Copy)]
pub(crate) struct BladeHead<'a> {
    pub(crate) name: Spanned<&'a str>,
    pub(crate) kind: BladeKind,
}

/// What the head of a machine's block says.
#[derive(Clone, Copy)]
pub(crate) struct Head<'a> {
    pub(crate) name: Spanned<&'a str>,
    pub(crate) kind: Spanned<MachineKind>,
    /// Its model.
    pub(crate) model: Spanned<&'a str>,
}

/// First words of heads, and how a whole head looks.
pub(crate) fn forms(operations: Operations) -> Vec<(&'static str, String)> {
    let form = |(word, form): (&'static str, &str)| (word, form.to_owned());
    let mut of_operations: Vec<(&'static str, String)> = operations
        .0
        .iter()
        .map(|kind| {
            let words = kind.words();
            (words[0], format!("{} {{ ... }}", kind.head()))
        })
        .collect();
    of_operations.dedup_by_key(|(word, _)| *word);
    let before = [
        ("stock", "stock { ... }"),
        ("profile", "profile { ... }"),
        ("surface", "surface { ... }"),
        ("region", "region NAME { ... }"),
        ("blade", "blade NAME { ... }"),
    ];
    let after = [
        (
            "machine",
            "machine NAME = robot \"kuka/kr210_r3100_ultra\" { ... }",
        ),
        ("cell", "cell { machine = NAME }"),
    ];
    let before = before.map(form).into_iter();
    before.chain(of_operations).chain(after.map(form)).collect()
}

/// What may follow the first word of an operation: `vcut` after `rough`.
pub(crate) fn second_words(first: &str, operations: Operations) -> Vec<&'static str> {
    let kinds = operations.0.iter().map(|kind| kind.words());
    kinds
        .filter(|words| words[0] == first)
        .map(|words| words[1])
        .collect()
}

/// Kinds of machine.
pub(crate) const MACHINES: &[(&str, MachineKind)] = &[
    ("robot", MachineKind::Robot),
    ("five_axis", MachineKind::FiveAxis),
];

/// The kind of a block.
pub(crate) fn classify(block: &Block, operations: Operations) -> Result<Kind<'_>, Box<Diagnostic>> {
    let parts: Vec<(&HeadPart, Span)> = block.head.iter().map(|part| (&part.node, part.span)).collect();
    let Some(&(HeadPart::Word(first), at)) = parts.first() else {
        let diagnostic = Diagnostic::new(
            Code::UnknownBlock,
            "a block begins with a word that says what it is",
            head_span(block),
            "no such word",
        );
        return Err(Box::new(with_list(diagnostic, operations)));
    };
    let rest = parts.get(1..).unwrap_or_default();
    match first.as_str() {
        "stock" => plain(Kind::Stock, first, rest),
        "profile" => plain(Kind::Profile, first, rest),
        "surface" => plain(Kind::Surface, first, rest),
        "cell" => plain(Kind::Cell, first, rest),
        "region" => region(at, rest),
        "blade" => blade(at, rest),
        "machine" => machine(at, rest),
        first if !second_words(first, operations).is_empty() => operation((first, at), rest, operations),
        _ => Err(Box::new(unknown(first, at, operations))),
    }
}

fn form_of(first: &str) -> String {
    let mut forms = forms(Operations::default()).into_iter();
    forms
        .find(|(word, _)| *word == first)
        .map_or_else(String::new, |(_, form)| form)
}

fn unknown(word: &str, at: Span, operations: Operations) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        format!("there is no block `{word}`"),
        at,
        "not a block of the language",
    );
    let meant = operations
        .0
        .iter()
        .find(|kind| kind.words()[1] == word || kind.mistaken_for().contains(&word));
    if let Some(kind) = meant {
        let head = kind.head();
        return diagnostic.fix(format!("write `{head}`"), at, head);
    }
    let forms = forms(operations);
    let near = nearest(word, forms.iter().map(|(word, _)| *word));
    with_list(did_you_mean(diagnostic, at, &near), operations)
}

fn with_list(diagnostic: Diagnostic, operations: Operations) -> Diagnostic {
    let names: Vec<&str> = forms(operations).iter().map(|(word, _)| *word).collect();
    diagnostic.note(format!(
        "a job contains `job`, `use`, `let` and the blocks {}",
        names.join(", ")
    ))
}

/// A head of one word.
fn plain<'a>(kind: Kind<'a>, first: &str, rest: &[(&HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    match rest.first() {
        None => Ok(kind),
        Some((_, at)) => Err(surplus(first, *at, &form_of(first))),
    }
}

/// Text after a complete head.
fn surplus(first: &str, at: Span, form: &str) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(
        Code::Misplaced,
        format!("unexpected text after the head of `{first}`"),
        at,
        "does not belong here",
    );
    Box::new(diagnostic.help(format!("write `{form}`")))
}

/// A head that ends too early.
fn incomplete(first: &str, what: &str, at: Span, form: &str) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(
        Code::MissingField,
        format!("`{first}` needs {what}"),
        at,
        format!("{what} is missing after this"),
    );
    Box::new(diagnostic.help(format!("write `{form}`")))
}

fn region<'a>(at: Span, rest: &[(&'a HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    let form = form_of("region");
    match rest {
        [(HeadPart::Word(name), span)] => Ok(Kind::Region(Spanned::new(name.as_str(), *span))),
        [(HeadPart::Word(_), _), (_, span), ..] => Err(surplus("region", *span, &form)),
        _ => Err(incomplete("region", "a name", at, &form)),
    }
}

/// How the head of a blade looks that states its kind.
const OF_KIND: &str = "blade NAME = disc { ... }";

fn blade<'a>(at: Span, rest: &[(&'a HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    let form = form_of("blade");
    let (name, after) = match rest {
        [(HeadPart::Word(name), span), after @ ..] => (Spanned::new(name.as_str(), *span), after),
        _ => return Err(incomplete("blade", "a name", at, &form)),
    };
    let kind = match after {
        [] => BladeKind::Straight,
        [(HeadPart::Equals, _), (HeadPart::Word(kind), span)] => blade_kind(kind, *span)?,
        [(HeadPart::Equals, _), (HeadPart::Word(_), _), (_, span), ..] => {
            return Err(surplus("blade", *span, OF_KIND));
        }
        [(HeadPart::Equals, span), ..] => return Err(incomplete("blade", "a kind", *span, OF_KIND)),
        [(_, span), ..] => return Err(surplus("blade", *span, &form)),
    };
    Ok(Kind::Blade(BladeHead { name, kind }))
}

fn blade_kind(kind: &str, at: Span) -> Result<BladeKind, Box<Diagnostic>> {
    let known = BladeKind::WORDS.iter().find(|(word, _)| *word == kind);
    known.map(|(_, kind)| *kind).ok_or_else(|| {
        let names = BladeKind::WORDS.iter().map(|(word, _)| *word);
        Box::new(no_kind("blade", kind, at, &names.collect::<Vec<_>>()))
    })
}

fn operation<'a>(
    (first, at): (&str, Span),
    rest: &[(&'a HeadPart, Span)],
    operations: Operations,
) -> Result<Kind<'a>, Box<Diagnostic>> {
    let kinds = second_words(first, operations);
    // What the operations of this word are, together.
    let noun = match first {
        "rough" => "roughing",
        other => other,
    };
    let form = || {
        let kind = kinds.first().copied().unwrap_or_default();
        format!("{first} {kind} {{ ... }}")
    };
    match rest {
        [(HeadPart::Word(second), at), more @ ..] => {
            let found = operations
                .0
                .iter()
                .find(|kind| kind.words() == [first, second.as_str()]);
            match (found, more) {
                (Some(kind), []) => Ok(Kind::Operation(*kind)),
                (Some(_), [(_, span), ..]) => Err(surplus(first, *span, &form())),
                (None, _) => {
                    let diagnostic = Diagnostic::new(
                        Code::UnknownBlock,
                        format!("there is no operation `{first} {second}`"),
                        *at,
                        format!("not a kind of {noun}"),
                    );
                    let near = nearest(second, kinds.iter().copied());
                    let diagnostic = did_you_mean(diagnostic, *at, &near);
                    Err(Box::new(
                        diagnostic.note(format!("kinds of {noun}: {}", kinds.join(", "))),
                    ))
                }
            }
        }
        _ => Err(incomplete(first, &format!("a kind of {noun}"), at, &form())),
    }
}

fn machine<'a>(at: Span, rest: &[(&'a HeadPart, Span)]) -> Result<Kind<'a>, Box<Diagnostic>> {
    let (name, after) = match rest {
        [(HeadPart::Word(name), span), after @ ..] => (Spanned::new(name.as_str(), *span), after),
        _ => return Err(incomplete("machine", "a name", at, &form_of("machine"))),
    };
    let (kind, after) = match after {
        [(HeadPart::Equals, _), (HeadPart::Word(kind), span), after @ ..] => {
            (Spanned::new(machine_kind(kind, *span)?, *span), after)
        }
        _ => {
            return Err(incomplete(
                "machine",
                "what it is",
                name.span,
                &form_of("machine"),
            ));
        }
    };
    match after {
        [(HeadPart::Text(model), span)] => {
            let model = Spanned::new(model.as_str(), *span);
            Ok(Kind::Machine(Head { name, kind, model }))
        }
        [(HeadPart::Text(_), _), (_, span), ..] => Err(surplus("machine", *span, &form_of("machine"))),
        _ => Err(incomplete("machine", "its model", name.span, &form_of("machine"))),
    }
}

fn machine_kind(kind: &str, at: Span) -> Result<MachineKind, Box<Diagnostic>> {
    if let Some((_, known)) = MACHINES.iter().find(|(word, _)| *word == kind) {
        return Ok(*known);
    }
    let names: Vec<&str> = MACHINES.iter().map(|(word, _)| *word).collect();
    Err(Box::new(no_kind("machine", kind, at, &names)))
}

/// A word that is not one of the kinds of something.
fn no_kind(what: &str, kind: &str, at: Span, names: &[&str]) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        format!("there is no {what} of the kind `{kind}`"),
        at,
        format!("not a kind of {what}"),
    );
    let near = nearest(kind, names.iter().copied());
    let diagnostic = did_you_mean(diagnostic, at, &near);
    diagnostic.note(format!("kinds of {what}: {}", names.join(", ")))
}
