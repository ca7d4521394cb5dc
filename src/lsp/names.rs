//! Names: where they are defined and used, over all files of a job, and what renaming one comes to.

use super::analysis::{Analysis, OpenTexts};
use super::sites::{Kind, Site, Words, sites};
use super::text::{Encoding, Text};
use std::collections::{BTreeMap, BTreeSet};
use vcutc_diagnostics::Code;
use vcutc_diagnostics::overlay::Overlay;
use vcutc_diagnostics::source::{FileId, Loader, Span};
use vcutc_job::sema::kept_surfaces::Surfaces;
use vcutc_job::sema::study::{Definition, Meaning};
use vcutc_job::sema::vocabulary::{self, RESERVED};
use vcutc_syntax::lexical::{TokenKind, tokens};

/// A name in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) span: Span,
}

/// The sites at a byte of a file, the innermost last. A place counts up to and with its end, so that a cursor after a word is
/// at the word.
pub(super) fn sites_at<'a>(analysis: &'a Analysis, path: &str, offset: usize) -> Vec<Site<'a>> {
    let Some((_, ast)) = analysis.file(path) else {
        return Vec::new();
    };
    let mut found: Vec<Site<'a>> = sites(ast, analysis.study.operations)
        .into_iter()
        .filter(|site| site.span.start as usize <= offset && offset <= site.span.end as usize)
        .collect();
    // Of two that touch, the one that begins here; of two nested ones, the inner one.
    found.sort_by_key(|site| (site.span.start, core::cmp::Reverse(site.span.end)));
    found
}

/// The name at a byte of a file, if there is one.
pub(super) fn name_at(analysis: &Analysis, path: &str, offset: usize) -> Option<Name> {
    let sites = sites_at(analysis, path, offset);
    sites.iter().rev().find_map(|site| named(analysis, site))
}

/// The name that a site is.
fn named(analysis: &Analysis, site: &Site<'_>) -> Option<Name> {
    let text = match site.kind {
        Kind::Definition(_, name) => name,
        Kind::Reference(name) if is_reference(analysis, site, name) => name,
        Kind::Reference(_)
        | Kind::Block
        | Kind::HeadWord
        | Kind::JobName
        | Kind::Field(_)
        | Kind::Word
        | Kind::Auto
        | Kind::Number(_)
        | Kind::Unit(_)
        | Kind::Function(_)
        | Kind::Label(_)
        | Kind::Formula
        | Kind::Variable
        | Kind::Path(..)
        | Kind::Value(_) => return None,
    };
    Some(Name {
        text: text.to_owned(),
        span: site.span,
    })
}

/// Whether a bare word means a name: a word of a target does only if a `let` is called so.
fn is_reference(analysis: &Analysis, site: &Site<'_>, name: &str) -> bool {
    let meaning = analysis.study.definition(name).map(|known| known.meaning);
    match (site.place.words, meaning) {
        (_, None) => false,
        (Words::Names, Some(_)) | (Words::OfTarget, Some(Meaning::Value(_))) => true,
        (Words::OfTarget, Some(Meaning::Blade(_) | Meaning::Region | Meaning::Machine)) => false,
    }
}

/// The definition that the name at a byte of a file has.
pub(super) fn definition_at<'a>(analysis: &'a Analysis, path: &str, offset: usize) -> Option<&'a Definition> {
    let name = name_at(analysis, path, offset)?;
    analysis.study.definition(&name.text)
}

/// All places of a name in the files of a job.
pub(super) fn occurrences(analysis: &Analysis, name: &str) -> Vec<Span> {
    let files = analysis.study.files.iter();
    files
        .flat_map(|file| sites(&file.ast, analysis.study.operations))
        .filter_map(|site| named(analysis, &site))
        .filter(|found| found.text == name)
        .map(|found| found.span)
        .collect()
}

/// Places by the path of their file, each with the text of the file.
pub(super) type Places = BTreeMap<String, (Text, BTreeSet<(u32, u32)>)>;

/// All places of a name in several jobs that share the file in which it is defined.
pub(super) fn places(analyses: &[&Analysis], name: &str, encoding: Encoding) -> Places {
    let mut places = Places::new();
    for analysis in analyses {
        for span in occurrences(analysis, name) {
            let Some(source) = analysis.sources.get(span.file) else {
                continue;
            };
            let file = places
                .entry(source.name.clone())
                .or_insert_with(|| (Text::new(&source.text, encoding), BTreeSet::new()));
            file.1.insert((span.start, span.end));
        }
    }
    places
}

/// Why a name cannot be had.
pub(super) fn refused(analyses: &[&Analysis], old: &str, new: &str) -> Option<String> {
    const KEYWORDS: &[&str] = &["job", "use", "let", "default"];
    if new == old {
        return None;
    }
    if !vocabulary::is_name(new) {
        return Some(format!(
            "`{new}` is not a name: a name is letters, digits and `_`, and begins with no digit"
        ));
    }
    let curves = vocabulary::CURVES
        .iter()
        .chain(vocabulary::SIDES)
        .map(|(word, _)| *word);
    let taken = KEYWORDS
        .iter()
        .chain(RESERVED)
        .chain(vocabulary::JOINTS_OF_CURVES)
        .copied();
    if taken.chain(curves).any(|word| word == new) {
        return Some(format!("`{new}` is reserved by the language"));
    }
    analyses.iter().find_map(|analysis| clash(analysis, new))
}

/// What a name is already in the files of a job.
fn clash(analysis: &Analysis, new: &str) -> Option<String> {
    if let Some(known) = analysis.study.definition(new) {
        let file = analysis.sources.name(known.name.span.file);
        let what = match known.meaning {
            Meaning::Value(_) => "a value",
            Meaning::Blade(_) => "a blade",
            Meaning::Region => "a region",
            Meaning::Machine => "a machine",
        };
        return Some(format!("`{new}` is {what} already, in {file}"));
    }
    analysis.study.files.iter().find_map(|file| {
        let is_it = |site: &Site<'_>| {
            matches!(site.kind, Kind::Reference(_) | Kind::Variable)
                && analysis.sources.slice(site.span) == new
        };
        let taken = sites(&file.ast, analysis.study.operations)
            .into_iter()
            .any(|site| is_it(&site));
        taken.then(|| {
            let file = analysis.sources.name(file.id);
            format!("`{new}` is used in {file} already and would get another meaning")
        })
    })
}

/// Why a name cannot be replaced by another: renaming must leave every job that sees it as it was. It is tried, and what there
/// is to report must stay the same, file by file. Jobs with mistakes are allowed, unless the name is in a part of them
/// that cannot be read.
pub(super) fn changes_meaning(
    analyses: &[&Analysis],
    places: &Places,
    (old, new): (&str, &str),
    open: &OpenTexts,
    below: &dyn Loader,
) -> Option<String> {
    if let Some(why) = analyses.iter().find_map(|analysis| unread(analysis, old)) {
        return Some(why);
    }
    let mut changed = open.clone();
    for (path, (text, spans)) in places {
        let text = Text::new(&renamed(text.as_str(), spans, new), Encoding::default());
        changed.insert(path.clone(), text);
    }
    let overlay = Overlay {
        texts: &changed,
        below,
    };
    let surfaces = Surfaces::default();
    analyses.iter().find_map(|before| {
        let known = (before.study.operations, &surfaces);
        let Some(after) = Analysis::of(&before.root, before.stamp, &overlay, known) else {
            return Some(format!("{} cannot be read any more", before.root));
        };
        let (reported_before, reported_after) = (reported(before), reported(&after));
        let more = surplus(&reported_after, &reported_before);
        let less = surplus(&surely_reported(reported_before), &reported_after);
        let appears = more.map(|(place, message)| format!("with `{new}` for `{old}`, {place} would be wrong: {message}"));
        appears.or_else(|| {
            let (place, message) = less?;
            Some(format!(
                "with `{new}` for `{old}`, {place} would get another meaning: this would no longer be wrong there: {message}"
            ))
        })
    })
}

/// Where a name is in a part of a text that cannot be read, so that it is unknown whether it is the name.
fn unread(analysis: &Analysis, name: &str) -> Option<String> {
    analysis.study.files.iter().find_map(|file| {
        let source = analysis.sources.get(file.id)?;
        let known: BTreeSet<u32> = sites(&file.ast, analysis.study.operations)
            .iter()
            .map(|site| site.span.start)
            .collect();
        let token = tokens(&source.text).find(|token| {
            let is_known = u32::try_from(token.start).is_ok_and(|start| known.contains(&start));
            token.kind == TokenKind::Word
                && source.text.get(token.start..token.end) == Some(name)
                && !is_known
        })?;
        Some(format!(
            "`{name}` is also in {}:{}, in a part that cannot be read: fix that first",
            source.name,
            token.line + 1
        ))
    })
}

/// All diagnostics: by file and code, each with the line and the message.
type Reported = BTreeMap<(String, &'static str), Vec<(usize, String)>>;

/// Without guesses: of unknown names in a job that cannot be read to its end, only those are reported that are
/// like a known one, so renaming that one takes the message away and nothing else.
fn surely_reported(mut reported: Reported) -> Reported {
    let is_unread = reported.keys().any(|(_, code)| code.starts_with("VC01"));
    reported.retain(|(_, code), _| !(is_unread && *code == Code::UnknownName.number()));
    reported
}

fn reported(analysis: &Analysis) -> Reported {
    let mut reported = Reported::new();
    for diagnostic in &analysis.diagnostics {
        let span = diagnostic.primary.span;
        let text = analysis
            .sources
            .get(span.file)
            .map_or("", |file| file.text.as_str());
        let before = text.get(..span.start as usize).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let file = analysis.sources.name(span.file).to_owned();
        let of_code = reported.entry((file, diagnostic.code.number())).or_default();
        of_code.push((line, diagnostic.message.clone()));
    }
    reported
}

/// The first thing that is reported more often here than there, with its place.
fn surplus(here: &Reported, there: &Reported) -> Option<(String, String)> {
    here.iter().find_map(|(key, found)| {
        let others = there.get(key).map_or(&[][..], Vec::as_slice);
        if found.len() <= others.len() {
            return None;
        }
        // One that was not there before, as far as that can be said; lines do not move.
        let is_new = |(line, _): &&(usize, String)| others.iter().all(|(other, _)| other != line);
        let (line, message) = found.iter().find(is_new).or(found.last())?;
        Some((format!("{}:{line}", key.0), message.clone()))
    })
}

fn renamed(text: &str, spans: &BTreeSet<(u32, u32)>, new: &str) -> String {
    let mut result = String::new();
    let mut done = 0;
    for &(start, end) in spans {
        result.push_str(text.get(done..start as usize).unwrap_or_default());
        result.push_str(new);
        done = end as usize;
    }
    result + text.get(done..).unwrap_or_default()
}

/// The file that a path in a text means, relative to the file it is in.
pub(super) fn file_meant(analysis: &Analysis, file: FileId, written: &str) -> String {
    vcutc_diagnostics::source::join_path(analysis.sources.name(file), written)
}
