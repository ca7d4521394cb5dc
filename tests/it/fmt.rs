//! The layout of the job files of this repository, and what formatting must not change: what the compiler makes of a job.

use crate::repository::{TextFile, files, root};
use std::fs;
use vcutc::diagnostics::source::{LoadError, Loader, SourceMap};
use vcutc::job::sema;
use vcutc::job::sema::Choices;
use vcutc::syntax::format::format;

/// The files of this repository as they are, or with job files in the layout.
#[derive(Clone, Copy, PartialEq)]
enum Repository {
    AsItIs,
    Formatted,
}

impl Loader for Repository {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        let bytes = fs::read(root().join(path)).map_err(|_| LoadError::NotFound)?;
        if *self == Self::AsItIs || !path.ends_with(".vcut") {
            return Ok(bytes);
        }
        let text = String::from_utf8(bytes.clone()).ok();
        Ok(text
            .and_then(|text| layout(&text))
            .map_or(bytes, String::into_bytes))
    }
}

/// The layout of a text without mistakes.
fn layout(text: &str) -> Option<String> {
    let file = SourceMap::default().add("t.vcut", text);
    format(file, text).ok()
}

/// Everything that `sema` made of a job, and the codes it reported, without places.
fn meaning(path: &str, loader: &dyn Loader) -> String {
    let (mut sources, mut diagnostics) = (SourceMap::default(), Vec::new());
    let checked = sema::check(
        path,
        loader,
        Choices {
            operations: vcutc::registry::OPERATIONS,
            ..Choices::default()
        },
        &mut sources,
        &mut diagnostics,
    );
    let job = checked.ok().map(|(_, job)| job);
    let codes: Vec<_> = diagnostics
        .iter()
        .map(|found| (found.code, found.message.as_str()))
        .collect();
    without_places(&format!("{job:?} {codes:?}"))
}

/// What stands as `3..9` is a place.
fn without_places(shown: &str) -> String {
    let mut pieces = shown.split("..");
    let mut rest = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let before = rest.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        rest.truncate(before);
        rest += piece.trim_start_matches(|c: char| c.is_ascii_digit());
    }
    rest
}

#[test]
fn the_examples_are_in_the_layout() {
    for file in files("examples", ".vcut")
        .into_iter()
        .chain(files("tests/jobs", ".vcut"))
    {
        // One of the examples shows mistakes.
        if let Some(layout) = layout(&file.text) {
            assert_eq!(file.text, layout, "{}: run `vcutc fmt`", file.path);
        }
    }
}

/// Job files of this repository whose text is right.
fn jobs() -> Vec<TextFile> {
    let folders = [
        "examples",
        "tests/check/ok",
        "tests/jobs",
        "tests/process",
        "tests/syntax/ok",
        "tests/verify",
    ];
    let all = folders.into_iter().flat_map(|folder| files(folder, ".vcut"));
    all.filter(|file| layout(&file.text).is_some()).collect()
}

#[test]
fn a_job_means_the_same_in_the_layout() {
    let jobs = jobs();
    assert!(jobs.len() > 80, "{}", jobs.len());
    for TextFile { path, .. } in jobs {
        let [plain, formatted] =
            [Repository::AsItIs, Repository::Formatted].map(|files| meaning(&path, &files));
        assert_eq!(plain, formatted, "{path}");
    }
}

#[test]
fn the_layout_of_every_job_is_its_own() {
    for TextFile { path, text } in jobs() {
        let once = layout(&text);
        assert_eq!(once.as_deref().and_then(layout), once, "{path}");
    }
}

/// Blocks of a page that show job text: they should look as people's own files will.
#[test]
fn whole_jobs_of_the_documentation_are_in_the_layout() {
    for page in ["README.md", "docs/language.md", "docs/fmt.md"] {
        let text = crate::repository::read(page);
        for block in text.split("```vcut\n").skip(1) {
            let block = block.split("```").next().unwrap();
            let is_whole = block.contains("job \"") && block.contains("stock {");
            if let Some(layout) = layout(block).filter(|_| is_whole) {
                assert_eq!(block, layout, "{page}");
            }
        }
    }
}
