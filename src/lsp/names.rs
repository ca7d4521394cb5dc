//! Names: where they are defined and used, over all files of a job, and what renaming one comes to.

use super::analysis::{Analysis, OpenTexts, Overlay};
use super::sites::{Kind, Site, Words, sites};
use super::text::Text;
use crate::diag::Diagnostic;
use crate::sema::study::{Definition, Meaning};
use crate::sema::vocabulary::{self, RESERVED};
use crate::source::{FileId, Loader, Span};
use std::collections::{BTreeMap, BTreeSet};

/// A name in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    /// The name.
    pub(super) text: String,
    /// Where it stands.
    pub(super) span: Span,
}

/// The sites at a byte of a file, the innermost last. A place counts up to and with its end, so that a cursor behind a word is
/// at the word.
pub(super) fn sites_at<'a>(analysis: &'a Analysis, path: &str, offset: usize) -> Vec<Site<'a>> {
    let Some((_, ast)) = analysis.file(path) else {
        return Vec::new();
    };
    let mut found: Vec<Site<'a>> = sites(ast)
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
        (Words::OfTarget, Some(Meaning::Blade | Meaning::Machine)) => false,
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
        .flat_map(|file| sites(&file.ast))
        .filter_map(|site| named(analysis, &site))
        .filter(|found| found.text == name)
        .map(|found| found.span)
        .collect()
}

/// Places by the path of their file, each with the text of the file.
pub(super) type Places = BTreeMap<String, (Text, BTreeSet<(u32, u32)>)>;

/// All places of a name in several jobs that share the file in which it is defined.
pub(super) fn places(analyses: &[&Analysis], name: &str) -> Places {
    let mut places = Places::new();
    for analysis in analyses {
        for span in occurrences(analysis, name) {
            let Some(source) = analysis.sources.get(span.file) else {
                continue;
            };
            let file = places
                .entry(source.name.clone())
                .or_insert_with(|| (Text::new(&source.text), BTreeSet::new()));
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
            "`{new}` is no name: a name is letters, digits and `_`, and begins with no digit"
        ));
    }
    let curves = vocabulary::CURVES.iter().map(|(word, _)| *word);
    let taken = KEYWORDS
        .iter()
        .chain(RESERVED)
        .chain(vocabulary::JOINTS_OF_CURVES)
        .copied();
    if taken.chain(curves).any(|word| word == new) {
        return Some(format!("`{new}` has a meaning of its own in the language"));
    }
    analyses.iter().find_map(|analysis| clash(analysis, new))
}

/// What a name is already in the files of a job.
fn clash(analysis: &Analysis, new: &str) -> Option<String> {
    if let Some(known) = analysis.study.definition(new) {
        let file = analysis.sources.name(known.name.span.file);
        let what = match known.meaning {
            Meaning::Value(_) => "a value",
            Meaning::Blade => "a blade",
            Meaning::Machine => "a machine",
        };
        return Some(format!("`{new}` is {what} already, in {file}"));
    }
    analysis.study.files.iter().find_map(|file| {
        let is_it = |site: &Site<'_>| {
            matches!(site.kind, Kind::Reference(_) | Kind::Variable)
                && analysis.sources.slice(site.span) == new
        };
        let taken = sites(&file.ast).into_iter().any(|site| is_it(&site));
        taken.then(|| {
            let file = analysis.sources.name(file.id);
            format!("`{new}` is used in {file} already and would get another meaning")
        })
    })
}

/// Whether renaming leaves every job as it was: it is tried, and what there is to tell must stay the same.
pub(super) fn keeps_meaning(
    analyses: &[&Analysis],
    places: &Places,
    new: &str,
    open: &OpenTexts,
    below: &dyn Loader,
) -> bool {
    let mut changed = open.clone();
    for (path, (text, spans)) in places {
        changed.insert(path.clone(), Text::new(&renamed(text.as_str(), spans, new)));
    }
    let overlay = Overlay {
        open: &changed,
        below,
    };
    analyses.iter().all(|analysis| {
        let after = Analysis::of(&analysis.root, analysis.stamp, &overlay);
        after.is_some_and(|after| codes(&after.diagnostics) == codes(&analysis.diagnostics))
    })
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<&'static str> {
    diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code.number())
        .collect()
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

/// The file that a path in a text means, relative to the file it stands in.
pub(super) fn file_meant(analysis: &Analysis, file: FileId, written: &str) -> String {
    crate::source::join_path(analysis.sources.name(file), written)
}
