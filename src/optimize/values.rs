//! What other values of an operation save: each limit a tenth wider, each feed and each size of a blade a tenth larger, and each
//! given choice left to the compiler.
//!
//! A change is made in the text, exactly as an editor would make it, and the job is compiled with it: what is reported is the time
//! of the whole program, with all proofs and on the job's machine. So this needs nothing of an operation but its text.

use super::bounds::place;
use vcutc_backend_api::units::Duration;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{SourceMap, Span, Spanned};
use vcutc_driver::{Compiled, Request, changed};
use vcutc_job::operation::Operation;
use vcutc_syntax::ast::{Block, Entry, Expr, Item, Relation};
use vcutc_syntax::parse;

/// Another value, and what it saves.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherValue {
    pub kind: ValueKind,
    /// As the job has it: `engagement <= 150 deg`.
    pub words: String,
    /// Where: `rib.vcut:17:14`.
    pub place: String,
    /// The other value: `165 deg`.
    pub other: String,
    /// The time of the job then.
    pub time: Duration,
    /// By which share of its time the job is shorter.
    pub share: f64,
}

/// What a value is to its operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// A limit: a wider one may leave more.
    Limit,
    /// A speed or a size of a blade, or a choice that the compiler can make.
    Other,
}

/// What other values save.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OtherValues {
    /// Those that save something, the most first.
    pub found: Vec<OtherValue>,
    /// Those that were not tried, because the program is so long.
    pub not_tried: Vec<String>,
}

/// Savings below this share are not listed.
const LEAST_SHARE: f64 = 0.002;

/// By how much values change, as a share.
const CHANGE: f64 = 0.1;

/// How many ops all programs of changes may have together.
const OPS_OF_CHANGES: usize = 200_000;

/// Fields of blades with sizes of which more may be cut at once.
const SIZES: [&str; 5] = ["cutting_length", "radius", "height", "depth", "width"];

/// The block of an operation with its speeds.
const FEED: &str = "feed";

/// The job that values are changed in.
#[derive(Clone, Copy)]
pub(super) struct Subject<'j> {
    pub(super) request: Request<'j>,
    pub(super) sources: &'j SourceMap,
    pub(super) compiled: &'j Compiled,
}

impl Subject<'_> {
    /// The time of the job as it is.
    pub(super) fn time(self) -> Duration {
        time_of(self.compiled)
    }

    /// The time of the job with a text in place of another one; none where it does not compile then.
    pub(super) fn time_with(self, span: Span, text: &str) -> Option<Duration> {
        let outcome = changed(self.request, self.sources, &[(span, text.to_owned())])?;
        outcome.compiled.as_ref().map(time_of)
    }

    /// How many programs as long as the job's there is room for.
    pub(super) fn room(self) -> usize {
        OPS_OF_CHANGES / self.compiled.program.verified().program().ops.len().max(1)
    }
}

fn time_of(compiled: &Compiled) -> Duration {
    compiled.report.times.all.total()
}

impl OtherValues {
    /// Of an operation, without the values that have been seen in others: two may share a blade.
    pub(super) fn of(operation: &dyn Operation, subject: Subject<'_>, seen: &mut Vec<Span>) -> Self {
        let now = subject.time();
        let mut changes = changes_of(operation, subject.sources);
        changes.retain(|change| !seen.contains(&change.span));
        seen.extend(changes.iter().map(|change| change.span));
        let (tried, left) = changes.split_at(changes.len().min(subject.room()));
        let save = |change: &Change| {
            let time = subject.time_with(change.span, &change.other)?;
            let share = 1.0 - time / now;
            (share > LEAST_SHARE).then(|| OtherValue {
                kind: change.kind,
                words: change.words.clone(),
                place: place(subject.sources, change.span),
                other: change.other.clone(),
                time,
                share,
            })
        };
        let mut found: Vec<OtherValue> = tried.iter().filter_map(save).collect();
        found.sort_by(|one, other| other.share.total_cmp(&one.share));
        Self {
            found,
            not_tried: left.iter().map(|change| change.words.clone()).collect(),
        }
    }
}

/// A change of one value.
struct Change {
    kind: ValueKind,
    words: String,
    /// Where the value is.
    span: Span,
    /// What to write there.
    other: String,
}

/// All changes of an operation and its blades.
fn changes_of(operation: &dyn Operation, sources: &SourceMap) -> Vec<Change> {
    let mut changes = Vec::new();
    if let Some(block) = block_at(operation.setup().head_span, sources) {
        of_entries(&block.entries, sources, &mut changes);
    }
    for blade in operation.blades() {
        let block = block_at(blade.span(), sources);
        let fields = block.iter().flat_map(|block| &block.entries);
        changes.extend(fields.filter_map(|field| of_size(field, blade.name(), sources)));
    }
    changes
}

/// The block that a place is in.
fn block_at(place: Span, sources: &SourceMap) -> Option<Block> {
    let text = &sources.get(place.file)?.text;
    let items = parse(place.file, text, &mut Vec::new()).items;
    items.into_iter().find_map(|item| match item {
        Item::Block(block) => {
            (block.span.start <= place.start && place.end <= block.span.end).then_some(block)
        }
        Item::Job { .. } | Item::Use { .. } | Item::Let { .. } => None,
    })
}

fn of_entries(entries: &[Entry], sources: &SourceMap, changes: &mut Vec<Change>) {
    for entry in entries {
        match entry {
            Entry::Limit {
                name,
                relation,
                value,
                ..
            } => changes.extend(of_limit(name, relation.node, value, sources)),
            Entry::Field { name, value, .. } if !is_auto(value) => {
                changes.push(Change {
                    kind: ValueKind::Other,
                    words: format!("{} = {}", name.node, sources.slice(value.span)),
                    span: value.span,
                    other: "auto".to_owned(),
                });
            }
            Entry::Block(block) if block.head_text() == FEED => {
                changes.extend(
                    block
                        .entries
                        .iter()
                        .filter_map(|field| larger(field, "feed ", sources)),
                );
            }
            Entry::Block(block) => of_entries(&block.entries, sources, changes),
            Entry::Field { .. }
            | Entry::Formula { .. }
            | Entry::Curve { .. }
            | Entry::Row { .. }
            | Entry::ControlRow { .. }
            | Entry::SurfaceFile { .. }
            | Entry::Station { .. } => {}
        }
    }
}

fn of_limit(
    name: &Spanned<String>,
    relation: Relation,
    value: &Spanned<Expr>,
    sources: &SourceMap,
) -> Option<Change> {
    let (sign, factor) = match relation {
        Relation::AtMost => ("<=", 1.0 + CHANGE),
        Relation::AtLeast => (">=", 1.0 - CHANGE),
    };
    Some(Change {
        kind: ValueKind::Limit,
        words: format!("{} {sign} {}", name.node, sources.slice(value.span)),
        span: value.span,
        other: times(factor, value, sources)?,
    })
}

fn of_size(field: &Entry, blade: &str, sources: &SourceMap) -> Option<Change> {
    match field {
        Entry::Field { name, .. } if SIZES.contains(&name.node.as_str()) => {
            larger(field, &format!("{blade}: "), sources)
        }
        _ => None,
    }
}

/// A field with a larger value.
fn larger(field: &Entry, of: &str, sources: &SourceMap) -> Option<Change> {
    let Entry::Field { name, value, .. } = field else {
        return None;
    };
    Some(Change {
        kind: ValueKind::Other,
        words: format!("{of}{} = {}", name.node, sources.slice(value.span)),
        span: value.span,
        other: times(1.0 + CHANGE, value, sources)?,
    })
}

/// A value times a factor, as it is written; none of what cannot be multiplied.
fn times(factor: f64, value: &Spanned<Expr>, sources: &SourceMap) -> Option<String> {
    match &value.node {
        Expr::Number { value, unit } => {
            let unit = unit
                .as_ref()
                .map_or(String::new(), |unit| format!(" {}", unit.node));
            Some(show(value * factor) + &unit)
        }
        Expr::Name(_) | Expr::Call { .. } | Expr::Negate(_) | Expr::Binary { .. } if !is_auto(value) => {
            Some(format!("{} * ({})", show(factor), sources.slice(value.span)))
        }
        Expr::Name(_)
        | Expr::Call { .. }
        | Expr::Negate(_)
        | Expr::Binary { .. }
        | Expr::Text(_)
        | Expr::Tuple(_) => None,
    }
}

fn is_auto(value: &Spanned<Expr>) -> bool {
    matches!(&value.node, Expr::Name(name) if name == "auto")
}
