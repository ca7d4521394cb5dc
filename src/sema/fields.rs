//! The fields of a block, sorted by name.
//!
//! Which fields a block has is a table ([`BlockSpec`]). Sorting the entries into it finds everything that does not
//! depend on values: unknown names, fields given twice, things that belong elsewhere. Reading a field then finds the
//! rest. A field whose fault has been reported is remembered as such, and reading it stays quiet.

use super::names::did_you_mean;
use super::report::{Checked, Reported, Reports};
use super::session::Session;
use crate::diag::suggest::nearest;
use crate::diag::{Code, Diagnostic};
use crate::source::{SourceMap, Span, Spanned};
use crate::syntax::ast::{Block, Curve, Entry, Expr, HeadPart, Relation};
use std::collections::BTreeMap;

/// What kind of entry a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `name = value`.
    Value,
    /// `name { ... }`.
    Block,
    /// `name <= value`.
    Limit,
}

/// A field that a block can have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FieldSpec {
    /// Its name.
    pub(crate) name: &'static str,
    /// What kind of entry it is.
    pub(crate) form: Form,
    /// A typical value; for a block with its braces.
    pub(crate) typical: &'static str,
}

impl FieldSpec {
    /// The whole field with its typical value.
    fn sample(&self) -> String {
        match self.form {
            Form::Value => format!("{} = {}", self.name, self.typical),
            Form::Block => format!("{} {}", self.name, self.typical),
            Form::Limit => format!("{} <= {}", self.name, self.typical),
        }
    }
}

/// A field of the form `name = value`.
pub(crate) const fn value(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec {
        name,
        form: Form::Value,
        typical,
    }
}

/// A field of the form `name { ... }`.
pub(crate) const fn block(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec {
        name,
        form: Form::Block,
        typical,
    }
}

/// A field of the form `name <= value`.
pub(crate) const fn limit(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec {
        name,
        form: Form::Limit,
        typical,
    }
}

/// A kind of block.
#[derive(Debug)]
pub(crate) struct BlockSpec {
    /// What it is called in a sentence, such as `` `rough vcut` ``.
    pub(crate) title: &'static str,
    /// Its fields, in the order in which people write them.
    pub(crate) fields: &'static [FieldSpec],
    /// What becomes of inner blocks that are no fields.
    pub(crate) inner: Inner,
}

/// What becomes of inner blocks that are no fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inner {
    /// They are unknown.
    Refused,
    /// They are options for a target.
    TargetOptions,
}

/// Where a block stands, as far as its fields need to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Its head: where to point when something is missing.
    pub(crate) head: Span,
    /// All of it, up to the closing brace.
    pub(crate) whole: Span,
}

/// What was found of a field.
#[derive(Clone, Copy)]
enum Slot<'a> {
    Value(&'a Spanned<Expr>),
    Block(&'a Block),
    Spoiled(Reported),
}

/// The fields of one block.
pub(crate) struct Fields<'a> {
    spec: &'static BlockSpec,
    place: Place,
    slots: BTreeMap<&'static str, (Slot<'a>, Span)>,
    /// Inner blocks that are options for targets.
    pub(crate) targets: Vec<&'a Block>,
    insertion: Insertion,
    damage: Option<Reported>,
}

impl<'a> Fields<'a> {
    /// Sorts the entries of a block.
    pub(crate) fn sort(
        spec: &'static BlockSpec,
        place: Place,
        entries: &'a [Entry],
        session: &mut Session<'_>,
    ) -> Self {
        let mut fields = Self {
            spec,
            place,
            slots: BTreeMap::new(),
            targets: Vec::new(),
            insertion: Insertion::before_end_of(place.whole, session.sources),
            damage: session.damage_at(place.whole),
        };
        for entry in entries {
            fields.sort_entry(entry, &mut session.reports);
        }
        fields
    }

    fn sort_entry(&mut self, entry: &'a Entry, reports: &mut Reports) {
        match entry {
            Entry::Field { name, value, span } => {
                self.put(
                    name,
                    Form::Value,
                    Slot::Value(value),
                    *span,
                    Some(value.span),
                    reports,
                );
            }
            Entry::Limit {
                name,
                relation,
                value,
                span,
            } => {
                let slot = match relation.node {
                    Relation::AtMost => Slot::Value(value),
                    Relation::AtLeast => Slot::Spoiled(self.wrong_relation(name, relation.span, reports)),
                };
                self.put(name, Form::Limit, slot, *span, Some(value.span), reports);
            }
            Entry::Block(inner) => self.sort_block(inner, reports),
            Entry::Formula { span, .. } => {
                reports.push(self.belongs_in_profile("a formula", *span));
            }
            Entry::Curve { curve, span } => {
                reports.push(self.belongs_in_profile(curve_words(curve), *span));
            }
        }
    }

    fn sort_block(&mut self, inner: &'a Block, reports: &mut Reports) {
        let [head] = inner.head.as_slice() else {
            let span = head_span(inner);
            reports.push(unknown_block(self.spec, "this", span));
            return;
        };
        match &head.node {
            HeadPart::Word(word) => {
                let name = Spanned::new(word.clone(), head.span);
                let is_field = self.spec.fields.iter().any(|field| field.name == *word);
                if !is_field && self.spec.inner == Inner::TargetOptions {
                    self.targets.push(inner);
                } else if is_field {
                    self.put(&name, Form::Block, Slot::Block(inner), inner.span, None, reports);
                } else {
                    reports.push(unknown_block(self.spec, word, head.span));
                }
            }
            HeadPart::Text(text) => {
                reports.push(unknown_block(self.spec, text, head.span));
            }
            HeadPart::Equals => {
                reports.push(unknown_block(self.spec, "=", head.span));
            }
        }
    }

    /// Puts an entry to its field.
    fn put(
        &mut self,
        name: &Spanned<String>,
        form: Form,
        slot: Slot<'a>,
        whole: Span,
        value: Option<Span>,
        reports: &mut Reports,
    ) {
        let Some(spec) = self.spec.fields.iter().find(|spec| spec.name == name.node) else {
            if !matches!(slot, Slot::Spoiled(_)) {
                reports.push(self.unknown_field(name));
            }
            return;
        };
        if let Some((_, first)) = self.slots.get(spec.name) {
            let diagnostic = Diagnostic::new(
                Code::FieldTwice,
                format!("`{}` is given twice", spec.name),
                name.span,
                "given here again",
            )
            .and(*first, "given here first")
            .help("take one of the two out");
            reports.push(diagnostic);
            return;
        }
        let slot = if spec.form == form {
            slot
        } else {
            Slot::Spoiled(reports.push(wrong_form(spec, form, name.span, whole, value)))
        };
        self.slots.insert(spec.name, (slot, name.span));
    }

    /// The value of a field, if it is given.
    pub(crate) fn value(&self, name: &str) -> Checked<Option<&'a Spanned<Expr>>> {
        match self.slots.get(name) {
            Some((Slot::Value(value), _)) => Ok(Some(value)),
            Some((Slot::Spoiled(reported), _)) => Err(*reported),
            Some((Slot::Block(_), _)) | None => Ok(None),
        }
    }

    /// The value of a field that must be given.
    pub(crate) fn required_value(&self, name: &str, reports: &mut Reports) -> Checked<&'a Spanned<Expr>> {
        self.value(name)?.ok_or_else(|| self.missing(name, reports))
    }

    /// A field that is a block, if it is given.
    pub(crate) fn block(&self, name: &str) -> Checked<Option<&'a Block>> {
        match self.slots.get(name) {
            Some((Slot::Block(block), _)) => Ok(Some(block)),
            Some((Slot::Spoiled(reported), _)) => Err(*reported),
            Some((Slot::Value(_), _)) | None => Ok(None),
        }
    }

    /// A field that is a block and must be given.
    pub(crate) fn required_block(&self, name: &str, reports: &mut Reports) -> Checked<&'a Block> {
        self.block(name)?.ok_or_else(|| self.missing(name, reports))
    }

    /// A typical value of a field.
    pub(crate) fn typical(&self, name: &str) -> Option<&'static str> {
        let spec = self.spec.fields.iter().find(|spec| spec.name == name);
        spec.map(|spec| spec.typical)
    }

    /// Reports a field that must be given and is not.
    fn missing(&self, name: &str, reports: &mut Reports) -> Reported {
        if let Some(reported) = self.damage {
            return reported;
        }
        let spec = self.spec.fields.iter().find(|spec| spec.name == name);
        let sample = spec.map_or_else(|| name.to_owned(), FieldSpec::sample);
        let diagnostic = Diagnostic::new(
            Code::MissingField,
            format!("{} needs `{name}`", self.spec.title),
            self.place.head,
            format!("`{name}` is missing here"),
        );
        let title = format!("add it, for example `{sample}`");
        reports.push(diagnostic.fix(title, self.insertion.at, self.insertion.text(&sample)))
    }

    fn unknown_field(&self, name: &Spanned<String>) -> Diagnostic {
        let diagnostic = Diagnostic::new(
            Code::UnknownField,
            format!("{} has no field `{}`", self.spec.title, name.node),
            name.span,
            "not a field of this block",
        );
        let near = nearest(&name.node, self.spec.fields.iter().map(|spec| spec.name));
        did_you_mean(diagnostic, name.span, &near).note(field_list(self.spec))
    }

    fn wrong_relation(&self, name: &Spanned<String>, relation: Span, reports: &mut Reports) -> Reported {
        if !self
            .spec
            .fields
            .iter()
            .any(|spec| spec.name == name.node && spec.form == Form::Limit)
        {
            return reports.push(self.unknown_field(name));
        }
        let diagnostic = Diagnostic::new(
            Code::Misplaced,
            format!("`{}` has an upper limit, not a lower one", name.node),
            relation,
            "`>=` does not belong here",
        );
        reports.push(diagnostic.fix("limit it from above", relation, "<="))
    }

    fn belongs_in_profile(&self, what: &str, span: Span) -> Diagnostic {
        Diagnostic::new(
            Code::Misplaced,
            format!("{what} does not belong in {}", self.spec.title),
            span,
            "describes the part's shape",
        )
        .help("move it into the `profile { ... }` block")
    }
}

/// The fields of a block, as a note.
fn field_list(spec: &BlockSpec) -> String {
    let names: Vec<&str> = spec.fields.iter().map(|spec| spec.name).collect();
    match names.as_slice() {
        [] => format!("{} has no fields", spec.title),
        [one] => format!("its only field is {one}"),
        several => format!("its fields are {}", several.join(", ")),
    }
}

/// The head of a block, from its first word to the last.
pub(crate) fn head_span(block: &Block) -> Span {
    match (block.head.first(), block.head.last()) {
        (Some(first), Some(last)) => first.span.to(last.span),
        _ => block.span,
    }
}

fn unknown_block(spec: &BlockSpec, word: &str, span: Span) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        format!("{} holds no block `{word}`", spec.title),
        span,
        "not a block of this block",
    );
    let inner: Vec<&str> = spec
        .fields
        .iter()
        .filter(|field| field.form == Form::Block)
        .map(|field| field.name)
        .collect();
    let near = nearest(word, inner.iter().copied());
    let diagnostic = did_you_mean(diagnostic, span, &near);
    if inner.is_empty() {
        diagnostic.help("close the block before this one starts, or take it out")
    } else {
        diagnostic.note(format!("its blocks are {}", inner.join(", ")))
    }
}

/// A field written in the form of another kind.
fn wrong_form(spec: &FieldSpec, written: Form, name: Span, whole: Span, value: Option<Span>) -> Diagnostic {
    let sample = spec.sample();
    let between = value.map(|value| Span {
        start: name.end,
        end: value.start,
        ..name
    });
    match (spec.form, written) {
        (Form::Limit, Form::Value) => {
            let diagnostic = Diagnostic::new(
                Code::Misplaced,
                format!("`{}` is a limit here, not a value", spec.name),
                between.unwrap_or(whole),
                "a limit is given with `<=`",
            );
            match between {
                Some(between) => diagnostic.fix("make it a limit", between, " <= "),
                None => diagnostic,
            }
        }
        (Form::Value, Form::Limit) => Diagnostic::new(
            Code::Misplaced,
            format!("`{}` is a value here, not a limit", spec.name),
            between.unwrap_or(whole),
            "a value is given with `=`",
        )
        .help(format!(
            "give a value like `{sample}`, or move this line into `limits {{ ... }}`"
        )),
        (Form::Block, _) => Diagnostic::new(
            Code::WrongKind,
            format!("`{}` is a block", spec.name),
            value.unwrap_or(whole),
            "braces with fields are wanted here",
        )
        .help(format!("write it like `{sample}`")),
        (Form::Value | Form::Limit, _) => Diagnostic::new(
            Code::WrongKind,
            format!("`{}` is a single value, not a block", spec.name),
            whole,
            "a value is wanted here",
        )
        .help(format!("write it like `{sample}`")),
    }
}

/// What a curve is called in a sentence.
pub(crate) const fn curve_words(curve: &Curve) -> &'static str {
    match curve {
        Curve::Start(_) => "`start`",
        Curve::Line { .. } => "`line`",
        Curve::Arc { .. } => "`arc`",
        Curve::Bezier { .. } => "`bezier`",
        Curve::Spline { .. } => "`spline`",
        Curve::Polyline { .. } => "`polyline`",
        Curve::Points { .. } => "`points`",
        Curve::Airfoil { .. } => "`airfoil`",
    }
}

/// Where and how a field is added to a block.
#[derive(Clone, Debug)]
struct Insertion {
    at: Span,
    before: &'static str,
    after: String,
}

impl Insertion {
    /// Just before the closing brace, in the manner of the block: on a line of its own when the brace has one.
    fn before_end_of(whole: Span, sources: &SourceMap) -> Self {
        let brace = whole.end.saturating_sub(1).max(whole.start);
        let at = Span {
            start: brace,
            end: brace,
            ..whole
        };
        let before = sources.slice(Span { end: brace, ..whole });
        let line = before.rsplit('\n').next().unwrap_or_default();
        let stands_alone = before.contains('\n') && line.bytes().all(|byte| byte == b' ' || byte == b'\t');
        if stands_alone {
            return Self {
                at,
                before: "  ",
                after: format!("\n{line}"),
            };
        }
        let gap = if line.ends_with([' ', '\t']) { "" } else { " " };
        Self {
            at,
            before: gap,
            after: " ".to_owned(),
        }
    }

    fn text(&self, sample: &str) -> String {
        format!("{}{sample}{}", self.before, self.after)
    }
}
