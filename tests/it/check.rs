//! Jobs that mean something, and jobs that do not: each of the latter names the codes it expects in its first line,
//! and its snapshot shows it together with what people get to see.

use crate::repository::expected_codes;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use vcutc::diagnostics::render::{ColorChoice, render};
use vcutc::diagnostics::source::{Entry, LoadError, Loader, SourceMap};
use vcutc::diagnostics::{Code, Diagnostic, Fix, fix};
use vcutc::job::CheckedJob;
use vcutc::job::search::SearchEffort;
use vcutc::job::sema::{Choices, Typed, check};

/// The files of a folder, with one of them changed.
struct Folder {
    path: PathBuf,
    changed: Option<(String, String)>,
}

impl Loader for Folder {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        match &self.changed {
            Some((changed, text)) if changed == path => Ok(text.clone().into_bytes()),
            _ => fs::read(self.path.join(path)).map_err(|_| LoadError::NotFound),
        }
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        let entries = fs::read_dir(self.path.join(folder))
            .into_iter()
            .flatten()
            .flatten();
        let mut found: Vec<Entry> = entries
            .map(|entry| {
                let name = entry.file_name().to_string_lossy().into_owned();
                match entry.file_type().unwrap().is_dir() {
                    true => Entry::Folder(name),
                    false => Entry::File(name),
                }
            })
            .collect();
        found.sort();
        found
    }
}

/// The result of checking a file.
struct Outcome {
    sources: SourceMap,
    diagnostics: Vec<Diagnostic>,
    job: Option<CheckedJob>,
}

impl Outcome {
    fn codes(&self) -> Vec<&'static str> {
        self.diagnostics
            .iter()
            .map(|diagnostic| diagnostic.code.number())
            .collect()
    }

    fn rendered(&self) -> String {
        render(&self.diagnostics, &self.sources, ColorChoice::Plain)
    }
}

/// A case: a job file, whose first lines may read `// expect: CODES`, `// set: name=value` and `// machine: NAME`.
struct Case {
    folder: PathBuf,
    name: String,
    text: String,
}

impl Case {
    fn read(path: &Path) -> Self {
        Self {
            folder: path.parent().unwrap().to_owned(),
            name: path.file_name().unwrap().to_string_lossy().into_owned(),
            text: String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned(),
        }
    }

    fn expected(&self) -> Vec<&str> {
        expected_codes(&self.text)
    }

    fn overrides(&self) -> Vec<String> {
        let lines = self.text.lines().filter_map(|line| line.strip_prefix("// set: "));
        lines.map(str::to_owned).collect()
    }

    fn machine(&self) -> Option<&str> {
        self.text
            .lines()
            .find_map(|line| line.strip_prefix("// machine: "))
    }

    fn check(&self, changed: Option<(String, String)>) -> Outcome {
        let loader = Folder {
            path: self.folder.clone(),
            changed,
        };
        let mut sources = SourceMap::default();
        let mut diagnostics = Vec::new();
        let (_, job) = check(
            &self.name,
            &loader,
            Choices {
                operations: vcutc::registry::OPERATIONS,
                overrides: &self.overrides(),
                machine: self.machine(),
                options: Typed::default(),
                effort: SearchEffort::Normal,
                surfaces: None,
            },
            &mut sources,
            &mut diagnostics,
        )
        .unwrap();
        Outcome {
            sources,
            diagnostics,
            job,
        }
    }

    /// The outcome after a fix has been made.
    fn check_fixed(&self, before: &Outcome, fix: &Fix) -> Outcome {
        let file = fix.edits[0].span.file;
        let source = before.sources.get(file).unwrap();
        let fixed = fix::apply(&source.text, file, &fix.edits).expect("the fix fits the text");
        self.check(Some((source.name.clone(), fixed)))
    }
}

#[test]
fn right_jobs_check() {
    insta::glob!("../check/ok", "*.vcut", |path| {
        let outcome = Case::read(path).check(None);
        assert_eq!(outcome.rendered(), "", "{}", path.display());
        assert!(outcome.job.is_some(), "{}", path.display());
    });
}

/// A job that sets every field: what comes out of each is in the snapshot.
#[test]
fn every_field_reaches_the_checked_job() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/check/ok/everything.vcut");
    let job = Case::read(&path).check(None).job.unwrap();
    let shown = format!("{:#?}", (job.name, job.stock, job.operations, job.machine));
    insta::assert_snapshot!(without_places(&shown));
}

/// A debug text without its spans, which say nothing about the meaning and change with every comma.
fn without_places(debug: &str) -> String {
    let mut kept = Vec::new();
    let mut skipping = None;
    for line in debug.lines() {
        let indent = line.len() - line.trim_start().len();
        match skipping {
            Some(start) if indent > start => {}
            Some(_) => skipping = None,
            None if line.contains("span: Some(") => skipping = Some(indent),
            None if line.contains("span: ") && !line.contains("span: None") => {}
            None => kept.push(line),
        }
    }
    kept.join("\n")
}

#[test]
fn wrong_jobs_are_explained() {
    let mut surprises = Vec::new();
    insta::glob!("../check/err", "*.vcut", |path| {
        let case = Case::read(path);
        let outcome = case.check(None);
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(format!("{}\n{}", case.text, outcome.rendered()));
        });
        let refused = vcutc::diagnostics::has_errors(&outcome.diagnostics);
        assert_eq!(outcome.job.is_none(), refused, "{}", path.display());
        if outcome.codes() != case.expected() {
            surprises.push(format!("{}: {:?}", path.display(), outcome.codes()));
        }
    });
    assert!(surprises.is_empty(), "{surprises:#?}");
}

/// Every fix that is offered takes away what it is offered for.
#[test]
fn fixes_mend_what_they_are_offered_for() {
    insta::glob!("../check/err", "*.vcut", |path| {
        let case = Case::read(path);
        let outcome = case.check(None);
        for diagnostic in &outcome.diagnostics {
            let same = |other: &&Diagnostic| other.code == diagnostic.code;
            let before = outcome.diagnostics.iter().filter(same).count();
            for fix in &diagnostic.fixes {
                let after = case.check_fixed(&outcome, fix);
                let left = after.diagnostics.iter().filter(same).count();
                assert!(
                    left < before,
                    "{}: {}\n{}",
                    path.display(),
                    fix.title,
                    after.rendered()
                );
            }
        }
    });
}

#[test]
fn every_code_of_text_and_meaning_has_a_failing_example() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/check/err");
    let mut shown = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "vcut") {
            let case = Case::read(&path);
            let number = &case.name[..6];
            assert!(
                case.expected().contains(&number),
                "{} does not expect {number}",
                path.display()
            );
            shown.insert(number.to_owned());
        }
    }
    let of_this_part = |code: &&Code| code.number() < "VC0300";
    let missing: Vec<&str> = Code::ALL
        .iter()
        .filter(of_this_part)
        .map(|code| code.number())
        .filter(|&code| !shown.contains(code))
        .collect();
    assert!(missing.is_empty(), "no failing example of {missing:?}");
}

/// The `vcut` examples of a page.
fn examples(page: &str) -> Vec<String> {
    let blocks = page.split("```vcut\n").skip(1);
    blocks
        .filter_map(|block| Some(block.split_once("```")?.0.to_owned()))
        .collect()
}

#[test]
fn examples_of_the_manual_read_as_they_stand() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let manual = fs::read_to_string(docs.join("language.md")).unwrap();
    let pages = Code::ALL
        .iter()
        .filter(|code| {
            ["VC02", "VC050"]
                .iter()
                .any(|group| code.number().starts_with(group))
        })
        .map(|code| code.page().to_owned());
    let mut count = 0;
    for page in pages.chain([manual]) {
        for example in examples(&page) {
            let mut sources = SourceMap::default();
            let mut diagnostics = Vec::new();
            let file = sources.add("example", example.clone());
            vcutc::syntax::parse(file, &example, &mut diagnostics);
            let rendered = render(&diagnostics, &sources, ColorChoice::Plain);
            assert_eq!(rendered, "", "{example}");
            count += 1;
        }
    }
    assert!(count >= 48 + 10, "{count} examples");
}

#[test]
fn the_first_example_of_the_manual_is_a_whole_job() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let manual = fs::read_to_string(docs.join("language.md")).unwrap();
    let text = examples(&manual).swap_remove(0);
    let case = Case {
        folder: docs,
        name: "example.vcut".to_owned(),
        text: text.clone(),
    };
    let outcome = case.check(Some(("example.vcut".to_owned(), text)));
    assert_eq!(outcome.rendered(), "");
    assert!(outcome.job.is_some());
}
