//! What can be written at the cursor: fields that a block still lacks, units that fit, words and names that a field takes,
//! machines of the catalogue, files beside the job.

use super::analysis::Analysis;
use super::context::{Context, Wanted, context};
use super::hover::explained;
use super::manual::{self, Table};
use super::offer::{Offer, Rank, offer, verbatim};
use super::paths;
use super::slots::{Owner, Slot};
use super::surroundings::BlockAround;
use super::values::{Begun, Place};
use lsp_types::CompletionItemKind;
use vcutc_backend_api::backend::Backend;
use vcutc_job::sema::kind::Operations;
use vcutc_job::sema::vocabulary::{self, BlockSpec, FieldSpec, Form, Need};
use vcutc_machine::catalogue;

/// What is offered, and the bytes that it replaces.
#[derive(Debug, PartialEq)]
pub(super) struct Offers {
    pub(super) replaces: core::ops::Range<usize>,
    pub(super) offers: Vec<Offer>,
}

/// What can be written at a byte of a text.
pub(super) fn completion(
    text: &str,
    offset: usize,
    analysis: &Analysis,
    targets: &[&'static dyn Backend],
    folder: &paths::Folder<'_>,
) -> Offers {
    let context = context(text, offset);
    let desk = Desk {
        analysis,
        targets,
        context: &context,
    };
    let offers = match &context.wanted {
        Wanted::Nothing => Vec::new(),
        Wanted::Entry => desk.entries(text),
        Wanted::Head(words) => head(words, desk.operations()),
        Wanted::Joint { piece, given } => joints(piece, given),
        Wanted::Point => vec![point()],
        Wanted::ControlPoint => vec![control_point()],
        Wanted::File => vec![file()],
        Wanted::Value(slot) => desk.place(slot).values(),
        Wanted::Unit(slot) => desk.place(slot).units(),
        Wanted::Label { slot, given } => desk.place(slot).labels(given),
        Wanted::Text(words) => {
            let typed = text.get(context.word.start..offset).unwrap_or_default();
            let named = paths::named_by(words, context.blocks.last().map(BlockAround::name));
            let files = named.map_or_else(Vec::new, |named| folder.offers(named, typed));
            texts(words).into_iter().chain(files).collect()
        }
    };
    Offers {
        replaces: context.word.clone(),
        offers,
    }
}

struct Desk<'a> {
    analysis: &'a Analysis,
    targets: &'a [&'static dyn Backend],
    context: &'a Context,
}

impl Desk<'_> {
    /// The fields of the innermost block, if it is one with a table.
    fn spec(&self) -> Option<&'static BlockSpec> {
        let mut blocks = self.context.blocks.iter();
        let outer = blocks.next()?;
        let mut spec = vocabulary::block(&outer.words(), self.operations());
        for inner in blocks {
            spec = spec.and_then(|spec| spec.block(inner.name(), inner.second()));
        }
        spec
    }

    fn innermost(&self) -> Option<&BlockAround> {
        self.context.blocks.last()
    }

    /// The fields after a file of a profile, of a surface or of a region.
    fn data_spec(&self) -> Option<&'static BlockSpec> {
        let (inner, around) = self.context.blocks.split_last()?;
        match shape(around)? {
            Around::Profile => vocabulary::data_file(inner.name()),
            Around::Surface => vocabulary::surface_file(inner.name()),
            Around::Region => vocabulary::region_file(inner.name()),
            Around::Loft | Around::Nurbs => None,
        }
    }

    /// The target whose options the innermost block holds.
    fn target(&self) -> Option<&'static dyn Backend> {
        let [outer, inner] = self.context.blocks.as_slice() else {
            return None;
        };
        let is_it = |target: &&&'static dyn Backend| target.id() == inner.name();
        self.targets
            .iter()
            .find(is_it)
            .copied()
            .filter(|_| outer.name() == "machine")
    }

    /// The block as the reference calls it.
    fn title(&self) -> String {
        let around = self
            .context
            .blocks
            .split_last()
            .and_then(|(_, around)| shape(around));
        if matches!(around, Some(Around::Region)) && self.data_spec().is_some() {
            return manual::DRAWING_OF_A_REGION.to_owned();
        }
        match self.innermost().map(BlockAround::name) {
            Some(name) => {
                let of_blade = self
                    .innermost()
                    .and_then(|block| vocabulary::kind_of_blade(&block.words()));
                let second = self.innermost().and_then(BlockAround::second);
                of_blade.map_or_else(|| self.of_operation(name, second), str::to_owned)
            }
            None => String::new(),
        }
    }

    /// The head of an operation that begins with these words; of other blocks the first word.
    fn of_operation(&self, first: &str, second: Option<&str>) -> String {
        let kind = self.operations().find(first, second);
        kind.map_or(first, |kind| kind.head()).to_owned()
    }

    const fn operations(&self) -> Operations {
        self.analysis.study.operations
    }

    fn entries(&self, text: &str) -> Vec<Offer> {
        let Some(innermost) = self.innermost() else {
            return items(text, self.operations());
        };
        if let Some(target) = self.target() {
            return options(target, &innermost.entries);
        }
        match shape(&self.context.blocks) {
            Some(Around::Profile) => return curves(),
            Some(Around::Surface) => return surfaces(),
            Some(Around::Region) => return loops(),
            Some(Around::Loft) => return vec![station()],
            Some(Around::Nurbs) => {
                let mut offers = self.fields(vocabulary::nurbs(), innermost);
                offers.push(control_row());
                return offers;
            }
            None => {}
        }
        let Some(spec) = self.data_spec().or_else(|| self.spec()) else {
            return Vec::new();
        };
        let mut offers = self.fields(spec, innermost);
        if spec.inner.takes_target_options() {
            let missing = self
                .targets
                .iter()
                .filter(|target| !innermost.entries.iter().any(|entry| entry == target.id()));
            offers.extend(missing.map(|target| Offer {
                snippet: format!("{} {{\n  $1\n\\}}", target.id()),
                detail: "options of a target".to_owned(),
                documentation: Some(target.summary().to_owned()),
                ..offer(target.id(), CompletionItemKind::MODULE, Rank::Possible)
            }));
        }
        offers
    }

    /// The fields that a block has not got yet.
    fn fields(&self, spec: &'static BlockSpec, block: &BlockAround) -> Vec<Offer> {
        let title = self.title();
        let word = block.name();
        let is_missing = |field: &&FieldSpec| {
            let count = block.entries.iter().filter(|entry| *entry == field.name).count();
            count < if field.form == Form::Bounds { 2 } else { 1 }
        };
        let missing: Vec<&FieldSpec> = spec.fields.iter().filter(is_missing).collect();
        let needed: Vec<&&FieldSpec> = missing
            .iter()
            .filter(|field| field.need == Need::Required)
            .collect();
        let mut offers: Vec<Offer> = missing.iter().map(|field| self.field(field, &title)).collect();
        if needed.len() > 1 {
            let lines: Vec<String> = (1..)
                .zip(&needed)
                .map(|(number, field)| field_snippet(field, number))
                .collect();
            offers.push(Offer {
                snippet: lines.join("\n"),
                detail: needed
                    .iter()
                    .map(|field| field.name)
                    .collect::<Vec<_>>()
                    .join(", "),
                ..offer(
                    &format!("all fields that {word} still needs"),
                    CompletionItemKind::SNIPPET,
                    Rank::Needed,
                )
            });
        }
        offers
    }

    fn field(&self, field: &FieldSpec, title: &str) -> Offer {
        let (detail, rank) = match field.need {
            Need::Required => ("required", Rank::Needed),
            Need::Optional => ("", Rank::Possible),
        };
        Offer {
            snippet: field_snippet(field, 1),
            detail: detail.to_owned(),
            documentation: explained(title, field.name),
            ..offer(field.name, CompletionItemKind::FIELD, rank)
        }
    }

    /// What a field of the innermost block is said to take.
    fn takes(&self, field: &str) -> Option<&'static FieldSpec> {
        let nurbs = matches!(shape(&self.context.blocks), Some(Around::Nurbs)).then(vocabulary::nurbs);
        let spec = nurbs.or_else(|| self.data_spec()).or_else(|| self.spec())?;
        spec.field(field)
    }

    /// What is known of the place of a value.
    fn place<'s>(&'s self, slot: &'s Slot) -> Place<'s> {
        let field = match &slot.owner {
            Owner::Field(name) => self.takes(name),
            Owner::Let | Owner::Coordinate | Owner::Formula(_) => None,
        };
        let head = self.context.blocks.first().map(|block| block.head.as_slice());
        let (machine, model) = match head {
            Some([first, _, _, kind, model]) if first == "machine" => {
                (vocabulary::machine_kind(kind), Some(model.trim_matches('"')))
            }
            Some(_) | None => (None, None),
        };
        Place {
            analysis: self.analysis,
            slot,
            field,
            target: self.target(),
            title: self.title(),
            machine,
            model,
            begun: if self.context.word.is_empty() {
                Begun::Nothing
            } else {
                Begun::Word
            },
        }
    }
}

/// A field with its typical value as a place to go on at.
fn field_snippet(field: &FieldSpec, number: usize) -> String {
    let joint = match field.form {
        Form::Value => " = ",
        Form::Block | Form::Points => " ",
        Form::Limit | Form::Bounds => " <= ",
    };
    format!("{}{joint}${{{number}:{}}}", field.name, verbatim(field.typical))
}

/// What can be at the top of a file. What a job has once only is not offered again.
fn items(text: &str, operations: Operations) -> Vec<Offer> {
    const ONCE: &[&str] = &["job", "stock", "profile", "surface", "cell"];
    // A part has one description.
    const EITHER: [&str; 2] = ["profile", "surface"];
    let is_there = |word: &str| {
        let mut lines = text.lines();
        lines.any(|line| line.split_whitespace().next() == Some(word))
    };
    vocabulary::items(operations)
        .filter(|(word, _)| !(ONCE.contains(word) && is_there(word)))
        .filter(|(word, _)| !(EITHER.contains(word) && EITHER.into_iter().any(is_there)))
        .map(|(word, form)| Offer {
            snippet: item_snippet(&form),
            documentation: manual::about(operations.find(word, None).map_or(word, |kind| kind.head())),
            detail: form,
            ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
        })
        .collect()
}

/// A form such as `blade NAME { ... }` with places for what is to be filled in.
fn item_snippet(form: &str) -> String {
    verbatim(form)
        .replace("{ ... \\}", "{\n  $0\n\\}")
        .replace("NAME", "${1:name}")
        .replace("PATH", "${1:shop/blades.vcut}")
        .replace("VALUE", "${2:85 mm}")
}

/// The next word of a head.
fn head(words: &[String], operations: Operations) -> Vec<Offer> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let next = match words.as_slice() {
        [first @ ("machine" | "blade"), _, "="] => vocabulary::head_words(first, operations),
        ["profile", "="] => return short_forms(),
        ["machine" | "blade"] => Vec::new(),
        [first] => vocabulary::head_words(first, operations),
        _ => Vec::new(),
    };
    next.iter()
        .map(|word| offer(word, CompletionItemKind::KEYWORD, Rank::Fitting))
        .collect()
}

/// The files that a profile in its short form can be.
fn short_forms() -> Vec<Offer> {
    let forms = vocabulary::short_forms();
    forms
        .map(|(word, form)| Offer {
            snippet: verbatim(&form),
            detail: form,
            documentation: manual::row(Table::Files, word).map(manual::Row::text),
            ..offer(word, CompletionItemKind::FUNCTION, Rank::Fitting)
        })
        .collect()
}

/// What the blocks around a place describe of a part.
enum Around {
    Profile,
    Surface,
    Loft,
    Nurbs,
    Region,
}

/// What the innermost of some blocks describes of a part; none if it is about something else.
fn shape(blocks: &[BlockAround]) -> Option<Around> {
    let (outermost, inner) = blocks.split_first()?;
    match (outermost.name(), inner) {
        ("profile", []) => Some(Around::Profile),
        ("surface", []) => Some(Around::Surface),
        ("surface", [loft]) if loft.name() == "loft" => Some(Around::Loft),
        ("surface", [nurbs]) if nurbs.name() == "nurbs" => Some(Around::Nurbs),
        ("region", []) => Some(Around::Region),
        ("region", [island]) if island.name() == "island" => Some(Around::Region),
        ("surface", [loft, _]) if loft.name() == "loft" => Some(Around::Profile),
        _ => None,
    }
}

/// What a surface can be.
fn surfaces() -> Vec<Offer> {
    let explained = |word: &str| manual::row(Table::Sources, word).map(manual::Row::text);
    let sources = vocabulary::SURFACES.iter().map(|(word, form)| Offer {
        snippet: verbatim(form),
        detail: (*form).to_owned(),
        documentation: explained(word),
        ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
    });
    let formula = Offer {
        snippet: "z(x, y) = $1".to_owned(),
        detail: "a formula for the height over x and y".to_owned(),
        documentation: explained("z"),
        ..offer("z(x, y)", CompletionItemKind::FUNCTION, Rank::Possible)
    };
    sources.chain([formula]).collect()
}

fn control_row() -> Offer {
    let (word, form) = vocabulary::CONTROL_ROW;
    Offer {
        snippet: verbatim(form),
        detail: form.to_owned(),
        documentation: manual::row(Table::Fields("nurbs"), word).map(manual::Row::text),
        ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
    }
}

fn station() -> Offer {
    let (word, form) = vocabulary::STATION;
    Offer {
        snippet: verbatim(form),
        detail: form.to_owned(),
        documentation: manual::row(Table::Sources, word).map(manual::Row::text),
        ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
    }
}

fn curves() -> Vec<Offer> {
    let pieces = vocabulary::CURVES.iter().map(|(word, form)| Offer {
        snippet: verbatim(form),
        detail: (*form).to_owned(),
        documentation: manual::row(Table::Pieces, word)
            .or_else(|| manual::row(Table::Files, word))
            .map(manual::Row::text),
        ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
    });
    let formula = Offer {
        snippet: "z(x) = $1".to_owned(),
        detail: "a formula for the height over x".to_owned(),
        ..offer("z(x)", CompletionItemKind::FUNCTION, Rank::Possible)
    };
    pieces.chain([formula]).collect()
}

/// The pieces of a region.
fn loops() -> Vec<Offer> {
    let pieces = vocabulary::LOOPS.iter().map(|(word, form)| Offer {
        snippet: verbatim(form),
        detail: (*form).to_owned(),
        documentation: manual::row(Table::Loops, word).map(manual::Row::text),
        ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
    });
    pieces.collect()
}

/// The words that a piece lacks next.
fn joints(piece: &str, given: &[String]) -> Vec<Offer> {
    let words: &[&str] = match (piece, given) {
        ("circle", []) => &["radius"],
        (_, []) => &["to"],
        ("arc", [_]) => &["radius", "center", "through"],
        _ => &[],
    };
    let mut offers: Vec<Offer> = words
        .iter()
        .map(|word| Offer {
            documentation: manual::row(Table::Joints, word).map(manual::Row::text),
            ..offer(word, CompletionItemKind::KEYWORD, Rank::Fitting)
        })
        .collect();
    if given.is_empty() && matches!(piece, "bezier" | "spline" | "polyline") {
        offers.push(point());
    }
    offers
}

fn point() -> Offer {
    Offer {
        snippet: "(${1:10 mm}, ${2:10 mm})".to_owned(),
        detail: "a point: along x, height".to_owned(),
        ..offer("(x, z)", CompletionItemKind::SNIPPET, Rank::Fitting)
    }
}

fn control_point() -> Offer {
    Offer {
        snippet: "(${1:10 mm}, ${2:10 mm}, ${3:10 mm})".to_owned(),
        detail: "a control point: along x, along y, height".to_owned(),
        ..offer("(x, y, z)", CompletionItemKind::SNIPPET, Rank::Fitting)
    }
}

/// The path of a file, with its quotes.
fn file() -> Offer {
    Offer {
        snippet: "\"$1\"".to_owned(),
        detail: "the path of a file, relative to this one".to_owned(),
        ..offer("\"...\"", CompletionItemKind::FILE, Rank::Fitting)
    }
}

/// Texts in quotes: the machines of the catalogue.
fn texts(words: &[String]) -> Vec<Offer> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let ["machine", _, "=", kind] = words.as_slice() else {
        return Vec::new();
    };
    let wanted = vocabulary::machine_kind(kind);
    catalogue::summaries()
        .into_iter()
        .filter(|summary| wanted.is_none_or(|wanted| summary.kind == wanted))
        .map(|summary| {
            let payload = summary.payload.map_or(String::new(), |kg| format!(", {kg} kg"));
            Offer {
                detail: format!("{}{payload}", summary.model),
                ..offer(summary.name, CompletionItemKind::CONSTANT, Rank::Fitting)
            }
        })
        .collect()
}

/// The options of a target that are not given yet.
fn options(target: &'static dyn Backend, given: &[String]) -> Vec<Offer> {
    let missing = target
        .options()
        .iter()
        .filter(|option| !given.iter().any(|key| key == option.key));
    missing
        .map(|option| Offer {
            snippet: format!("{} = $1", option.key),
            documentation: Some(option.help.to_owned()),
            ..offer(option.key, CompletionItemKind::FIELD, Rank::Fitting)
        })
        .collect()
}
