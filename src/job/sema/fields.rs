//! The fields of a block, sorted by name.
//!
//! Which fields a block has is a table ([`BlockSpec`]). Sorting the entries into it finds everything that does not
//! depend on values: unknown names, fields given twice, things that belong elsewhere. Reading a field then finds the
//! rest. A field whose fault has been reported is remembered as such, and reading it stays quiet.

use super::report::{Checked, Reported, Reports};
use super::session::Session;
use std::collections::BTreeMap;
use vcutc_diagnostics::schema::dimension::Dimension;
use vcutc_diagnostics::schema::faults::{self, did_you_mean};
pub use vcutc_diagnostics::schema::field::{
    BlockSpec, FieldSpec, Form, Inner, Takes, block, bounds, limit, points, value,
};
use vcutc_diagnostics::schema::range::Range;
use vcutc_diagnostics::source::{SourceMap, Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Block, Curve, Entry, Expr, HeadPart, Point, Relation};

/// How an entry is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Written {
    /// `name = value`.
    Value,
    /// `name { ... }`.
    Block,
    /// `name <= value` or `name >= value`.
    Limit(Relation),
    /// `name (x, z) (x, z) ...`.
    Points,
}

impl Written {
    /// Whether a field of this form is written so.
    const fn fits(self, form: Form) -> bool {
        match (form, self) {
            (Form::Value, Self::Value)
            | (Form::Block, Self::Block)
            | (Form::Limit, Self::Limit(Relation::AtMost))
            | (Form::Bounds, Self::Limit(Relation::AtMost | Relation::AtLeast))
            | (Form::Points, Self::Points) => true,
            (Form::Value | Form::Block | Form::Limit | Form::Bounds | Form::Points, _) => false,
        }
    }
}

/// The places of a block that its fields need.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its head: where to point when something is missing.
    pub head: Span,
    /// All of it, up to the closing brace.
    pub whole: Span,
}

/// What was found of a field.
#[derive(Clone, Copy)]
enum Slot<'a> {
    Value(&'a Spanned<Expr>),
    Block(&'a Block),
    Points(&'a [Point]),
    Spoiled(Reported),
}

/// An inner block of what is named in its head.
#[derive(Clone, Copy)]
pub struct NamedBlock<'a> {
    pub name: Spanned<&'a str>,
    pub block: &'a Block,
}

/// A row of control points.
#[derive(Clone, Copy)]
pub struct ControlRow<'a> {
    pub word: Span,
    pub points: &'a [Spanned<Expr>],
}

/// The fields of one block.
pub struct Fields<'a> {
    spec: &'static BlockSpec,
    place: Place,
    slots: BTreeMap<&'static str, (Slot<'a>, Span)>,
    /// Bounds from below, which may be beside those from above.
    least: BTreeMap<&'static str, (Slot<'a>, Span)>,
    /// Inner blocks that are options for targets.
    pub targets: Vec<&'a Block>,
    /// Inner blocks of what a second word names, such as `tool dagger { ... }`.
    pub named: Vec<NamedBlock<'a>>,
    /// Rows of control points, if the block has such.
    pub rows: Vec<ControlRow<'a>>,
    insertion: Insertion,
    damage: Option<Reported>,
    /// Fields that an unknown one perhaps is.
    misspelt: BTreeMap<&'static str, Reported>,
}

impl<'a> Fields<'a> {
    /// Sorts the entries of a block.
    pub fn sort(
        spec: &'static BlockSpec,
        place: Place,
        entries: &'a [Entry],
        session: &mut Session<'_>,
    ) -> Self {
        let mut fields = Self {
            spec,
            place,
            slots: BTreeMap::new(),
            least: BTreeMap::new(),
            targets: Vec::new(),
            named: Vec::new(),
            rows: Vec::new(),
            insertion: Insertion::before_end_of(place.whole, session.sources),
            damage: session.damage_at(place.whole),
            misspelt: BTreeMap::new(),
        };
        for entry in entries {
            fields.sort_entry(entry, &mut session.reports);
        }
        fields
    }

    fn sort_entry(&mut self, entry: &'a Entry, reports: &mut Reports) {
        match entry {
            Entry::Field { name, value, span } => {
                let entry = Given::value(name, Written::Value, value, *span);
                self.put(entry, reports);
            }
            Entry::Limit {
                name,
                relation,
                value,
                span,
            } => {
                let entry = Given::value(name, Written::Limit(relation.node), value, *span);
                self.put(entry.related_at(relation.span), reports);
            }
            Entry::Block(inner) => self.sort_block(inner, reports),
            Entry::Row { row, points, span } => {
                let name = Spanned::new(row.node.word().to_owned(), row.span);
                self.put(Given::points(&name, points, *span), reports)
            }
            Entry::Formula { span, .. } => {
                reports.push(self.belongs_in_profile("a formula", *span));
            }
            Entry::Curve { curve, span } => {
                reports.push(self.belongs_in_profile(curve_words(curve), *span));
            }
            Entry::SurfaceFile { kind, span, .. } => {
                reports.push(self.belongs_in_surface(kind.node.word(), *span));
            }
            Entry::Station { span, .. } => {
                reports.push(self.belongs_in_surface("at", *span));
            }
            Entry::ControlRow { word, points, .. } => match self.spec.inner {
                Inner::Rows => self.rows.push(ControlRow { word: *word, points }),
                Inner::Refused | Inner::Machine { .. } => {
                    reports.push(self.belongs_in_surface("row", *word));
                }
            },
        }
    }

    fn sort_block(&mut self, inner: &'a Block, reports: &mut Reports) {
        if let ([first, second], Inner::Machine { named, .. }) = (inner.head.as_slice(), self.spec.inner)
            && let (HeadPart::Word(word), HeadPart::Word(name)) = (&first.node, &second.node)
            && word == named
        {
            let name = Spanned::new(name.as_str(), second.span);
            self.named.push(NamedBlock { name, block: inner });
            return;
        }
        let [head] = inner.head.as_slice() else {
            let span = head_span(inner);
            reports.push(unknown_block(self.spec, &inner.head_text(), span));
            return;
        };
        match &head.node {
            HeadPart::Word(word) => {
                let name = Spanned::new(word.clone(), head.span);
                let is_field = self.spec.field(word).is_some();
                if !is_field && self.spec.inner.takes_target_options() {
                    self.targets.push(inner);
                } else if is_field {
                    self.put(Given::block(&name, inner), reports);
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
    fn put(&mut self, given: Given<'_, 'a>, reports: &mut Reports) {
        let name = given.name;
        let Some(spec) = self.spec.field(&name.node) else {
            let (diagnostic, near) = self.unknown_field(name);
            let reported = reports.push(diagnostic);
            self.misspelt.extend(near.first().map(|&first| (first, reported)));
            return;
        };
        let slots = match given.written {
            Written::Value | Written::Block | Written::Points | Written::Limit(Relation::AtMost) => {
                &mut self.slots
            }
            Written::Limit(Relation::AtLeast) => &mut self.least,
        };
        if let Some((_, first)) = slots.get(spec.name) {
            reports.push(faults::twice(Code::FieldTwice, spec.name, name.span, *first));
            return;
        }
        let slot = if given.written.fits(spec.form) {
            given.slot
        } else {
            Slot::Spoiled(reports.push(given.wrong_form(spec)))
        };
        slots.insert(spec.name, (slot, name.span));
    }

    /// The value that a field is to be at least, if it is given.
    pub fn least(&self, name: &str) -> Checked<Option<&'a Spanned<Expr>>> {
        taken_value(self.least.get(name))
    }

    /// The value of a field, if it is given.
    pub fn value(&self, name: &str) -> Checked<Option<&'a Spanned<Expr>>> {
        taken_value(self.slots.get(name))
    }

    /// The value of a field that must be given.
    pub fn required_value(&self, name: &str, reports: &mut Reports) -> Checked<&'a Spanned<Expr>> {
        self.value(name)?.ok_or_else(|| self.missing(name, reports))
    }

    /// A field that is a block, if it is given.
    pub fn block(&self, name: &str) -> Checked<Option<&'a Block>> {
        match self.slots.get(name) {
            Some((Slot::Block(block), _)) => Ok(Some(block)),
            Some((Slot::Spoiled(reported), _)) => Err(*reported),
            Some((Slot::Value(_) | Slot::Points(_), _)) | None => Ok(None),
        }
    }

    /// A field that is a row of points, if it is given, and where it is.
    pub fn points(&self, name: &str) -> Checked<Option<(&'a [Point], Span)>> {
        match self.slots.get(name) {
            Some((Slot::Points(points), span)) => Ok(Some((points, *span))),
            Some((Slot::Spoiled(reported), _)) => Err(*reported),
            Some((Slot::Value(_) | Slot::Block(_), _)) | None => Ok(None),
        }
    }

    /// A field that is a row of points and must be given, and where it is.
    pub fn required_points(&self, name: &str, reports: &mut Reports) -> Checked<(&'a [Point], Span)> {
        self.points(name)?.ok_or_else(|| self.missing(name, reports))
    }

    /// The place of the name of a field, in whatever form it is given.
    pub fn place_of(&self, name: &str) -> Option<Span> {
        self.slots.get(name).map(|(_, span)| *span)
    }

    /// A field that is a block and must be given.
    pub fn required_block(&self, name: &str, reports: &mut Reports) -> Checked<&'a Block> {
        self.block(name)?.ok_or_else(|| self.missing(name, reports))
    }

    /// What the block is called in a sentence, such as `` `rough vcut` ``.
    pub const fn title(&self) -> &'static str {
        self.spec.title
    }

    /// The range of a field's values, which are of this dimension.
    pub fn range(&self, name: &str, dimension: Dimension) -> Range {
        let spec = self.spec.field(name);
        spec.map_or(Range::all(dimension), |spec| spec.range(dimension))
    }

    /// A typical value of a field.
    pub fn typical(&self, name: &str) -> Option<&'static str> {
        self.spec.field(name).map(|spec| spec.typical)
    }

    /// What was reported already that may be why a field is missing.
    pub fn quiet_about(&self, name: &str) -> Option<Reported> {
        // A job with `clearence` does not lack a `clearance` as well.
        self.damage.or_else(|| self.misspelt.get(name).copied())
    }

    /// Reports a field that must be given and is not.
    fn missing(&self, name: &str, reports: &mut Reports) -> Reported {
        if let Some(reported) = self.quiet_about(name) {
            return reported;
        }
        let spec = self.spec.field(name);
        let sample = spec.map_or_else(|| name.to_owned(), FieldSpec::sample);
        let diagnostic = faults::missing(Code::MissingField, self.spec.title, &[name], self.place.head);
        let title = format!("add it, for example `{sample}`");
        reports.push(diagnostic.fix(title, self.insertion.at, self.insertion.text(&sample)))
    }

    /// Offers to add a field with a value, which follows the lead of the title as it has to be written.
    pub fn offer(&self, diagnostic: Diagnostic, lead: &str, field: &str) -> Diagnostic {
        let text = self.insertion.text(field);
        diagnostic.fix(format!("{lead} `{}`", text.trim()), self.insertion.at, text)
    }

    fn unknown_field(&self, name: &Spanned<String>) -> (Diagnostic, Vec<&'static str>) {
        let fields: Vec<&str> = self.spec.fields.iter().map(|field| field.name).collect();
        let given = Spanned::new(name.node.as_str(), name.span);
        let (diagnostic, near) = faults::unknown(Code::UnknownField, self.spec.title, given, &fields);
        let diagnostic = match self.block_with(&name.node) {
            Some((block, sample)) => diagnostic.help(format!(
                "it is a field of `{block}`: write `{block} {{ {sample} }}`"
            )),
            None => diagnostic,
        };
        (diagnostic, near)
    }

    /// The block within this one that has a field of that name, and how it is written there.
    fn block_with(&self, name: &str) -> Option<(&'static str, String)> {
        let sample = |field: &FieldSpec| Some((field.name, field.inner()?.field(name)?.sample()));
        self.spec.fields.iter().find_map(sample)
    }

    fn belongs_in_surface(&self, word: &str, span: Span) -> Diagnostic {
        Diagnostic::new(
            Code::Misplaced,
            format!("`{word}` does not belong in {}", self.spec.title),
            span,
            "describes the part's shape",
        )
        .help("move it into the `surface { ... }` block")
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

/// The value in a slot, if there is one.
const fn taken_value<'a>(slot: Option<&(Slot<'a>, Span)>) -> Checked<Option<&'a Spanned<Expr>>> {
    match slot {
        Some((Slot::Value(value), _)) => Ok(Some(value)),
        Some((Slot::Spoiled(reported), _)) => Err(*reported),
        Some((Slot::Block(_) | Slot::Points(_), _)) | None => Ok(None),
    }
}

/// The head of a block, from its first word to the last.
pub fn head_span(block: &Block) -> Span {
    match (block.head.first(), block.head.last()) {
        (Some(first), Some(last)) => first.span.to(last.span),
        _ => block.span,
    }
}

fn unknown_block(spec: &BlockSpec, word: &str, span: Span) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        format!("{} has no block `{word}`", spec.title),
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
        diagnostic.help("close the block before this one starts, or delete it")
    } else {
        diagnostic.note(format!("its blocks are {}", inner.join(", ")))
    }
}

/// An entry that is to become a field.
struct Given<'n, 'a> {
    name: &'n Spanned<String>,
    written: Written,
    slot: Slot<'a>,
    whole: Span,
    /// What is between name and value.
    between: Option<Span>,
    relation: Option<Span>,
}

impl<'n, 'a> Given<'n, 'a> {
    const fn value(
        name: &'n Spanned<String>,
        written: Written,
        value: &'a Spanned<Expr>,
        whole: Span,
    ) -> Self {
        let between = Span {
            start: name.span.end,
            end: value.span.start,
            ..name.span
        };
        Self {
            name,
            written,
            slot: Slot::Value(value),
            whole,
            between: Some(between),
            relation: None,
        }
    }

    const fn block(name: &'n Spanned<String>, inner: &'a Block) -> Self {
        Self {
            name,
            written: Written::Block,
            slot: Slot::Block(inner),
            whole: inner.span,
            between: None,
            relation: None,
        }
    }

    const fn points(name: &'n Spanned<String>, points: &'a [Point], whole: Span) -> Self {
        Self {
            name,
            written: Written::Points,
            slot: Slot::Points(points),
            whole,
            between: None,
            relation: None,
        }
    }

    const fn related_at(self, relation: Span) -> Self {
        Self {
            relation: Some(relation),
            ..self
        }
    }

    /// A field written in the form of another kind.
    fn wrong_form(&self, spec: &FieldSpec) -> Diagnostic {
        let sample = spec.sample();
        let place = self.between.unwrap_or(self.whole);
        match (spec.form, self.written) {
            (Form::Limit, Written::Limit(_)) => {
                let relation = self.relation.unwrap_or(place);
                Diagnostic::new(
                    Code::Misplaced,
                    format!("`{}` has an upper limit, not a lower one", spec.name),
                    relation,
                    "`>=` does not belong here",
                )
                .fix("limit it from above", relation, "<=")
            }
            (Form::Limit | Form::Bounds, Written::Value) => {
                let relations = match spec.form {
                    Form::Bounds => "`<=` or `>=`",
                    Form::Value | Form::Block | Form::Limit | Form::Points => "`<=`",
                };
                let diagnostic = Diagnostic::new(
                    Code::Misplaced,
                    format!("`{}` is a limit here, not a value", spec.name),
                    place,
                    format!("a limit is given with {relations}"),
                );
                match self.between {
                    Some(between) => diagnostic.fix("make it a limit", between, " <= "),
                    None => diagnostic,
                }
            }
            (Form::Value, Written::Limit(_)) => Diagnostic::new(
                Code::Misplaced,
                format!("`{}` is a value here, not a limit", spec.name),
                place,
                "a value is given with `=`",
            )
            .help(format!(
                "give a value like `{sample}`, or move this line into `limits {{ ... }}`"
            )),
            (Form::Points, _) => Diagnostic::new(
                Code::WrongKind,
                format!("`{}` is a list of points", spec.name),
                self.value_span().unwrap_or(self.whole),
                "expected points in round brackets here",
            )
            .help(format!("write it like `{sample}`")),
            (Form::Block, Written::Value | Written::Block | Written::Limit(_) | Written::Points) => {
                Diagnostic::new(
                    Code::WrongKind,
                    format!("`{}` is a block", spec.name),
                    self.value_span().unwrap_or(self.whole),
                    "expected braces with fields here",
                )
                .help(format!("write it like `{sample}`"))
            }
            (Form::Value | Form::Limit | Form::Bounds, _) => Diagnostic::new(
                Code::WrongKind,
                format!("`{}` is a single value, not a block", spec.name),
                self.whole,
                "expected a value here",
            )
            .help(format!("write it like `{sample}`")),
        }
    }

    const fn value_span(&self) -> Option<Span> {
        match self.slot {
            Slot::Value(value) => Some(value.span),
            Slot::Block(_) | Slot::Points(_) | Slot::Spoiled(_) => None,
        }
    }
}

/// What a curve is called in a sentence.
pub const fn curve_words(curve: &Curve) -> &'static str {
    match curve {
        Curve::Start(_) => "`start`",
        Curve::Line { .. } => "`line`",
        Curve::Arc { .. } => "`arc`",
        Curve::Bezier { .. } => "`bezier`",
        Curve::Spline { .. } => "`spline`",
        Curve::Polyline { .. } => "`polyline`",
        Curve::Open { .. } => "`open`",
        Curve::Circle { .. } => "`circle`",
        Curve::Points { .. } => "`points`",
        Curve::Airfoil { .. } => "`airfoil`",
        Curve::Dxf { .. } => "`dxf`",
        Curve::Svg { .. } => "`svg`",
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
    /// Just before the closing bracket, in the manner of the block: on a line of its own when the bracket has one, after a
    /// comma in the short form of a profile. A piece of a profile without options gets brackets of its own.
    fn before_end_of(whole: Span, sources: &SourceMap) -> Self {
        match sources.slice(whole).bytes().last() {
            Some(b'"') => {
                return Self {
                    at: whole.after(),
                    before: " { ",
                    after: " }".to_owned(),
                };
            }
            Some(b')') => {
                let at = whole.end.saturating_sub(1);
                return Self {
                    at: Span {
                        start: at,
                        end: at,
                        ..whole
                    },
                    before: ", ",
                    after: String::new(),
                };
            }
            _ => {}
        }
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
