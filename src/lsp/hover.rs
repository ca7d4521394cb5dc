//! What is shown beside the word under the cursor: its value, the value chosen for `auto`, and what the language reference
//! says about it, with the formula it enters.

use super::analysis::Analysis;
use super::chosen::{Chosen, chosen};
use super::manual::{self, Table};
use super::names::{definition_at, sites_at};
use super::sites::{Kind, Path, Place, Site, sites};
use vcutc_backend_api::backend::{Backend, OptionKind};
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_job::sema::study::{Definition, Meaning};
use vcutc_job::sema::vocabulary::{self, walk};
use vcutc_machine::catalogue;
use vcutc_syntax::ast::{Ast, Block, Entry, Expr, HeadPart, Item};
use vcutc_syntax::lexical::{TokenKind, tokens};

/// What there is to say about a place.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Reported {
    pub(super) span: Span,
    /// Markdown.
    pub(super) text: String,
}

/// What there is to say about a byte of a file.
pub(super) fn hover(
    analysis: &Analysis,
    path: &str,
    offset: usize,
    targets: &[&'static dyn Backend],
) -> Option<Reported> {
    if let Some(reported) = keyword(analysis, path, offset) {
        return Some(reported);
    }
    let sites = sites_at(analysis, path, offset);
    let inner = sites
        .iter()
        .rev()
        .find(|site| !matches!(site.kind, Kind::Value(_)));
    let Some(inner) = inner else {
        // Between the parts of a calculation.
        return whole_value(analysis, &sites);
    };
    let text = match inner.kind {
        Kind::Definition(..) | Kind::Reference(_) => match definition_at(analysis, path, offset) {
            Some(definition) => name(analysis, definition),
            None => word_of_target(inner, analysis, targets)?,
        },
        Kind::Auto => auto(analysis, path, inner)?,
        Kind::Field(field) => self::field(analysis, field, inner, targets)?,
        Kind::Word => word(analysis, inner)?,
        Kind::Number(number) => values(analysis, number)?,
        Kind::Unit(unit) => self::unit(unit)?,
        Kind::Function(function) => call(analysis, function, &sites)?,
        Kind::Label(function) => label(analysis, function, inner.span)?,
        Kind::Block => block(inner.place, analysis.sources.slice(inner.span), targets)?,
        Kind::HeadWord => head_word(inner.place.block, analysis.sources.slice(inner.span))?,
        Kind::JobName => figures(analysis, path)?,
        Kind::Path(kind, written) => file(analysis, kind, written, inner),
        Kind::Formula | Kind::Variable => manual_of_formula(inner.place)?,
        Kind::Value(_) => return None,
    };
    Some(Reported {
        span: inner.span,
        text,
    })
}

/// A word of the language that is not a site of the tree: `let`, `use`, `job`, `tips`, `body`, `row`, and what pieces of a profile are made of.
fn keyword(analysis: &Analysis, path: &str, offset: usize) -> Option<Reported> {
    let (file, ast) = analysis.file(path)?;
    let text = analysis.sources.get(file)?.text.as_str();
    let token = tokens(text)
        .take_while(|token| token.start <= offset)
        .filter(|token| token.kind == TokenKind::Word && offset <= token.end)
        .last()?;
    let span = Span::of_bytes(file, token.start..token.end);
    let is_site = |site: &Site<'_>| !matches!(site.kind, Kind::Value(_)) && site.span == span;
    if sites(ast, analysis.study.operations).iter().any(is_site) {
        return None;
    }
    let pieces = if is_in_a_region(ast, span) {
        Table::Loops
    } else {
        Table::Pieces
    };
    let text = keyword_explained(text.get(token.start..token.end)?, pieces)?;
    Some(Reported { span, text })
}

fn is_in_a_region(ast: &Ast, place: Span) -> bool {
    ast.items.iter().any(|item| {
        let Item::Block(block) = item else {
            return false;
        };
        let is_region =
            matches!(block.head.first().map(|head| &head.node), Some(HeadPart::Word(word)) if word == "region");
        is_region && block.span.start <= place.start && place.end <= block.span.end
    })
}

/// What the reference says about a word that means the same everywhere, but for the pieces of profiles and regions.
fn keyword_explained(word: &str, pieces: Table<'_>) -> Option<String> {
    let row = match word {
        "job" | "use" | "let" => return manual::about(word),
        "tips" => manual::row(Table::Fields("rough vcut"), word),
        "body" => manual::row(Table::Fields("blade"), word),
        "row" => manual::row(Table::Fields("nurbs"), word),
        _ => manual::row(pieces, word)
            .or_else(|| manual::row(Table::Joints, word))
            .or_else(|| manual::row(Table::Sources, word))
            .or_else(|| manual::row(Table::Files, word))
            .or_else(|| manual::row(Table::Loops, word)),
    };
    Some(format!("`{word}`: {}", row?.text()))
}

/// A word after the first one of a head: a kind of operation, of machine or of blade.
fn head_word(block: &str, word: &str) -> Option<String> {
    let table = match block {
        "machine" => Some(Table::Machines),
        "blade" => Some(Table::Blades),
        _ => None,
    };
    match table.and_then(|table| manual::row(table, word)) {
        Some(row) => Some(format!("`{word}`: {}", row.text())),
        None => manual::about(block),
    }
}

/// The name of a value in a call, with what the call means and what the value is worth here.
fn label(analysis: &Analysis, function: &str, name: Span) -> Option<String> {
    let word = analysis.sources.slice(name);
    let mut forms = manual::rows(Table::Calls).filter(|row| row.explains(function));
    let is_named = |row: &manual::Row| row.head().contains(&format!("{word} = "));
    let row = forms.clone().find(is_named).or_else(|| forms.next())?;
    let worth = argument(analysis, name).and_then(|value| values(analysis, value));
    let worth = worth.map_or(String::new(), |worth| format!("\n\nHere {worth}"));
    Some(format!(
        "`{word}` of `{function}`\n\n{}: {}{worth}",
        row.head(),
        row.text()
    ))
}

/// The value after a name in a call.
fn argument(analysis: &Analysis, name: Span) -> Option<&Spanned<Expr>> {
    let file = analysis.study.files.iter().find(|file| file.id == name.file)?;
    sites(&file.ast, analysis.study.operations)
        .into_iter()
        .find_map(|site| {
            let Kind::Value(value) = site.kind else {
                return None;
            };
            walk(value).find_map(|part| match &part.node {
                Expr::Call { arguments, .. } => arguments.iter().find_map(|argument| {
                    let is_it = argument.name.as_ref().is_some_and(|known| known.span == name);
                    is_it.then_some(&argument.value)
                }),
                Expr::Number { .. }
                | Expr::Text(_)
                | Expr::Name(_)
                | Expr::Negate(_)
                | Expr::Binary { .. }
                | Expr::Tuple(_) => None,
            })
        })
}

/// The words of an expression and what it comes to.
fn values(analysis: &Analysis, expr: &Spanned<Expr>) -> Option<String> {
    let value = analysis.study.evaluator().value(expr)?;
    Some(format!("`{}`, {}", value.texts(expr).join("` = `"), value.kind()))
}

fn whole_value(analysis: &Analysis, sites: &[Site<'_>]) -> Option<Reported> {
    let (span, value) = sites.iter().rev().find_map(|site| {
        let Kind::Value(value) = site.kind else {
            return None;
        };
        Some((site.span, value))
    })?;
    let text = values(analysis, value)?;
    Some(Reported { span, text })
}

/// A name with what it stands for.
fn name(analysis: &Analysis, definition: &Definition) -> String {
    let name = &definition.name.node;
    let file = analysis.sources.name(definition.name.span.file);
    let whole = whole_definition(analysis, definition.name.span);
    let shown = whole.map_or("", |span| analysis.sources.slice(span));
    let what = match definition.meaning {
        Meaning::Value(Some(value)) => {
            let expr = let_value(analysis, definition.name.span);
            let texts = expr.map_or_else(|| vec![value.text()], |expr| value.texts(expr));
            format!("`{name}` = `{}`, {}", texts.join("` = `"), value.kind())
        }
        Meaning::Value(None) => format!("`{name}`, a value that could not be worked out"),
        Meaning::Blade(kind) => format!("`{name}`, {}", kind.words()),
        Meaning::Region => format!("`{name}`, a region"),
        Meaning::Machine => format!("`{name}`, a machine"),
    };
    format!("{what}\n\n```vcut\n{shown}\n```\n\nDefined in {file}")
}

/// The item or block in which a name is defined.
fn whole_definition(analysis: &Analysis, name: Span) -> Option<Span> {
    let file = analysis.study.files.iter().find(|file| file.id == name.file)?;
    file.ast.items.iter().find_map(|item| match item {
        Item::Let { name: own, span, .. } if own.span == name => Some(*span),
        Item::Block(Block { head, span, .. }) if head.iter().any(|part| part.span == name) => Some(*span),
        Item::Let { .. } | Item::Block(_) | Item::Job { .. } | Item::Use { .. } => None,
    })
}

fn let_value(analysis: &Analysis, name: Span) -> Option<&Spanned<Expr>> {
    let file = analysis.study.files.iter().find(|file| file.id == name.file)?;
    file.ast.items.iter().find_map(|item| match item {
        Item::Let { name: own, value, .. } if own.span == name => Some(value),
        Item::Let { .. } | Item::Block(_) | Item::Job { .. } | Item::Use { .. } => None,
    })
}

/// The value chosen for `auto`, or that it is not known yet.
fn auto(analysis: &Analysis, path: &str, site: &Site<'_>) -> Option<String> {
    let rule = site
        .place
        .field
        .and_then(|field| manual::row(Table::Auto(site.place.block), field.name))
        .map(manual::Row::text);
    let found = match chosen(analysis, path, site) {
        Chosen::As { value, why } => {
            let why = if why.is_empty() {
                String::new()
            } else {
                format!("\n\n{why}")
            };
            format!("`auto` is `{value}`{why}")
        }
        Chosen::Unknown => {
            "`auto`: its value is known once the job has no errors and has been planned".to_owned()
        }
    };
    let rule = rule.map_or(String::new(), |rule| format!("\n\nChosen as: {rule}"));
    Some(found + &rule)
}

/// What a field is for, the formula it enters, and what it is worth here.
fn field(
    analysis: &Analysis,
    field: &str,
    site: &Site<'_>,
    targets: &[&'static dyn Backend],
) -> Option<String> {
    let block = site.place.block;
    if let Some(target) = targets.iter().find(|target| target.id() == block) {
        return option(*target, field);
    }
    let text = explained(block, field)?;
    let worth = field_value(analysis, site.span).and_then(|value| values(analysis, value));
    let worth = worth.map_or(String::new(), |worth| format!("\n\nHere {worth}"));
    Some(format!("**{field}** of `{block}`\n\n{text}{worth}"))
}

/// What the reference says about a field, and the formula that it enters.
pub(super) fn explained(block: &str, field: &str) -> Option<String> {
    let text = manual::row(Table::Fields(block), field)
        .map(manual::Row::text)
        .or_else(|| manual::about(block))?;
    let formula = manual::row(Table::Formulas, field).filter(|_| enters_formulas(block));
    let formula = formula.map_or(String::new(), |row| format!("\n\nEnters {}", row.text()));
    Some(text + &formula)
}

fn enters_formulas(block: &str) -> bool {
    matches!(block, "stock" | "blade" | "rough vcut" | "limits" | "feed")
}

/// The value after the name of a field at that place.
fn field_value(analysis: &Analysis, name: Span) -> Option<&Spanned<Expr>> {
    let file = analysis.study.files.iter().find(|file| file.id == name.file)?;
    let mut open: Vec<&Entry> = file
        .ast
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Block(block) => Some(block.entries.iter()),
            Item::Let { .. } | Item::Job { .. } | Item::Use { .. } => None,
        })
        .flatten()
        .collect();
    while let Some(entry) = open.pop() {
        match entry {
            Entry::Field { name: own, value, .. } | Entry::Limit { name: own, value, .. } => {
                if own.span == name {
                    return Some(value);
                }
            }
            Entry::Block(inner) => open.extend(&inner.entries),
            Entry::Station { entries, .. } | Entry::SurfaceFile { options: entries, .. } => {
                open.extend(entries);
            }
            Entry::Formula { .. } | Entry::Curve { .. } | Entry::Row { .. } | Entry::ControlRow { .. } => {}
        }
    }
    None
}

/// A word that a field takes.
fn word(analysis: &Analysis, site: &Site<'_>) -> Option<String> {
    let word = analysis.sources.slice(site.span);
    if word == "pi" {
        return Some("`pi` = `3.14159`, a pure number".to_owned());
    }
    let field = site.place.field?;
    let text = word_explained(site.place.block, field.name, word)?;
    Some(format!("`{word}` of **{}**\n\n{text}", field.name))
}

/// What the reference says about a word that a field takes: first about the word, then about the field.
pub(super) fn word_explained(block: &str, field: &str, word: &str) -> Option<String> {
    let of_field = explained(block, field)?;
    let residual = manual::row(Table::Residuals, word).filter(|_| field == "residual");
    let of_word = match residual {
        Some(row) => Some(format!("such a cut is {}", row.text())),
        None => manual::clause(&of_field, word).map(str::to_owned),
    };
    let of_word = of_word.map_or(String::new(), |text| format!("`{word}`: {text}\n\n"));
    Some(of_word + &of_field)
}

fn unit(unit: &str) -> Option<String> {
    let (kind, one) = vocabulary::unit_in_words(unit)?;
    let spoken = vocabulary::unit_spoken(unit)?;
    // A unit in which values are shown anyway has nothing to be converted to.
    let own = format!("1 {unit}");
    Some(if one == own {
        format!("`{unit}`: {spoken}, {kind}")
    } else {
        format!("`{unit}`: {spoken}\n\n`{own}` = `{one}`, {kind}")
    })
}

/// A function with its rule, or a call that a field of a machine takes.
fn call(analysis: &Analysis, function: &str, sites: &[Site<'_>]) -> Option<String> {
    let row = manual::row(Table::Functions, function).or_else(|| manual::row(Table::Calls, function))?;
    let form = vocabulary::functions().find(|(name, _)| *name == function);
    let form = form.map_or(String::new(), |(_, example)| format!(", such as `{example}`"));
    let worth =
        whole_value(analysis, sites).map_or(String::new(), |reported| format!("\n\nHere {}", reported.text));
    let takes = manual::row(Table::Functions, function).map_or("", |_| "takes ");
    Some(format!("`{function}`{form}: {takes}{}{worth}", row.text()))
}

fn block(place: Place<'_>, word: &str, targets: &[&'static dyn Backend]) -> Option<String> {
    if let Some(target) = targets.iter().find(|target| target.id() == word) {
        return Some(format!("Options of the target **{word}**: {}", target.summary()));
    }
    match place.field {
        Some(field) => explained(place.block, field.name).or_else(|| Some(format!("`{}`", field.sample()))),
        None => match manual::row(Table::Sources, word) {
            Some(row) => Some(format!("`{word}`: {}", row.text())),
            None => manual::about(place.block),
        },
    }
}

fn option(target: &'static dyn Backend, key: &str) -> Option<String> {
    let spec = target.options().iter().find(|option| option.key == key)?;
    let takes = match spec.kind {
        OptionKind::Integer { min, max, default } => {
            format!("A whole number from {min} to {max}. Default: {default}")
        }
        OptionKind::Length { min, max, default } => format!(
            "A length from {} mm to {} mm. Default: {} mm",
            min.to_mm(),
            max.to_mm(),
            default.to_mm()
        ),
        OptionKind::Lines => "Lines of text in quotes".to_owned(),
        OptionKind::Text => "A text in quotes".to_owned(),
        OptionKind::Choice { of } => format!("One of {}; the first is the default", of.join(", ")),
    };
    Some(format!(
        "**{key}** of `{}`\n\n{}\n\n{takes}",
        target.id(),
        spec.help
    ))
}

/// A word that is an option's value.
fn word_of_target(site: &Site<'_>, analysis: &Analysis, targets: &[&'static dyn Backend]) -> Option<String> {
    let target = targets.iter().find(|target| target.id() == site.place.block)?;
    let word = analysis.sources.slice(site.span);
    if word == "default" {
        return manual::about(word);
    }
    let takes = |kind: OptionKind| match kind {
        OptionKind::Choice { of } => of.contains(&word),
        OptionKind::Integer { .. } | OptionKind::Length { .. } | OptionKind::Lines | OptionKind::Text => {
            false
        }
    };
    let spec = target.options().iter().find(|option| takes(option.kind))?;
    option(*target, spec.key)
}

/// The figures of the program, after the job's name.
fn figures(analysis: &Analysis, path: &str) -> Option<String> {
    if analysis.root != path {
        return manual::about("job");
    }
    let summary = analysis.planned().map(|planned| planned.summary.join("\n"));
    match summary.filter(|lines| !lines.is_empty()) {
        Some(lines) => Some(format!("```text\n{lines}\n```")),
        None => manual::about("job"),
    }
}

fn file(analysis: &Analysis, kind: Path, written: &str, site: &Site<'_>) -> String {
    if kind == Path::Model
        && let Some(text) = model(written)
    {
        return text;
    }
    let meant = super::names::file_meant(analysis, site.span.file, written);
    format!("The file `{meant}`")
}

/// A machine of the catalogue.
fn model(name: &str) -> Option<String> {
    let found = catalogue::summaries()
        .into_iter()
        .find(|summary| summary.name == name)?;
    let payload = found.payload.map(|kg| format!("payload {kg} kg"));
    let reach = found.reach.map(|mm| format!("reach of the wrist {mm:.0} mm"));
    let facts: Vec<String> = payload.into_iter().chain(reach).collect();
    let facts = if facts.is_empty() {
        String::new()
    } else {
        format!(": {}", facts.join(", "))
    };
    Some(format!(
        "**{}**{facts}\n\n`vcutc machines {name}` shows all of it",
        found.model
    ))
}

/// The block whose height a formula gives.
fn manual_of_formula(place: Place<'_>) -> Option<String> {
    manual::about(match place.block {
        "surface" => "surface",
        _ => "profile",
    })
}
