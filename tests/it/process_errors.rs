//! Jobs that mean something but cannot be cut, or that the target cannot say.
//!
//! The first line of a job names the codes it expects, further ones what is claimed about it: `// mended by: A -> B` says
//! that with B in place of every A nothing is wrong any more, `// still wrong: A -> B` that the same code comes again.
//! Its snapshot shows it together with what people get to see.

use crate::pipeline::{Files, all_diagnostics, compile, fixed, numbers, rendered};
use crate::repository::expected_codes;
use std::fs;
use std::path::Path;
use vcutc::diagnostics::{Code, Diagnostic, Severity};
use vcutc::driver::Outcome;

const JOB: &str = "job.vcut";

/// Where the job lies, and what it uses.
fn folder(path: &Path) -> &Path {
    path.parent().unwrap()
}

struct Case {
    files: Files,
    text: String,
}

impl Case {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        Self {
            files: Files::of(folder(path)).with(JOB, text.clone()),
            text,
        }
    }

    fn expected(&self) -> Vec<&str> {
        expected_codes(&self.text)
    }

    /// Replacements that a claim is about.
    fn claims<'c>(&'c self, claim: &'c str) -> impl Iterator<Item = (&'c str, &'c str)> {
        let lines = self.text.lines().filter_map(move |line| line.strip_prefix(claim));
        lines.map(|line| line.split_once(" -> ").expect("a claim reads `A -> B`"))
    }

    /// The job without its header, with a replacement made.
    fn changed(&self, (from, to): (&str, &str)) -> Self {
        let lines = self.text.lines().filter(|line| !line.starts_with("//"));
        let body = lines.collect::<Vec<_>>().join("\n") + "\n";
        assert!(body.contains(from), "nothing reads {from}");
        let text = body.replace(from, to);
        Self {
            files: self.files.clone().with(JOB, text.clone()),
            text,
        }
    }

    fn run(&self) -> (Outcome, Vec<Diagnostic>) {
        run(&self.files)
    }
}

fn run(files: &Files) -> (Outcome, Vec<Diagnostic>) {
    let outcome = compile(JOB, files);
    let diagnostics = all_diagnostics(&outcome);
    (outcome, diagnostics)
}

/// Without the warnings that much stays, and that rates are not known, where a job is about something else: small jobs of a few
/// cuts leave much, and some need a robot whose rates are not stated.
fn of_interest(case: &Case, mut diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let beside = [Code::MuchStays, Code::RatesNotChecked];
    diagnostics.retain(|one| !beside.contains(&one.code) || case.expected().contains(&one.code.number()));
    diagnostics
}

/// In one test, because to compile the jobs takes most of its time.
#[test]
fn jobs_that_cannot_be_cut_are_explained() {
    let mut surprises = Vec::new();
    insta::glob!("../process/err", "*.vcut", |path| {
        let case = Case::read(path);
        let (outcome, diagnostics) = case.run();
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(format!("{}\n{}", case.text, rendered(&diagnostics, &outcome)));
        });
        fixes_mend(path, &case, &outcome, &diagnostics);
        let codes = numbers(&of_interest(&case, diagnostics));
        if codes.iter().any(|code| !case.expected().contains(code)) || codes.is_empty() {
            surprises.push(format!("{}: {codes:?}", path.display()));
        }
    });
    assert!(surprises.is_empty(), "{surprises:#?}");
}

/// Every fix that is offered leaves one fault less of its kind.
fn fixes_mend(path: &Path, case: &Case, outcome: &Outcome, diagnostics: &[Diagnostic]) {
    for diagnostic in diagnostics {
        for fix in &diagnostic.fixes {
            let (after, left) = run(&fixed(&case.files, outcome, fix));
            let of_its_kind =
                |all: &[Diagnostic]| all.iter().filter(|other| other.code == diagnostic.code).count();
            let errors = |all: &[Diagnostic]| {
                all.iter()
                    .filter(|other| other.severity() == Severity::Error)
                    .count()
            };
            assert!(
                of_its_kind(&left) < of_its_kind(diagnostics) && errors(&left) <= errors(diagnostics),
                "{}: {}\n{}",
                path.display(),
                fix.title,
                rendered(&left, &after)
            );
        }
    }
}

#[test]
fn what_the_help_says_works() {
    insta::glob!("../process/err", "*.vcut", |path| {
        let case = Case::read(path);
        for claim in case.claims("// mended by: ") {
            let (outcome, diagnostics) = case.changed(claim).run();
            let messages = rendered(&of_interest(&case, diagnostics), &outcome);
            assert_eq!(messages, "", "{} with {claim:?}", path.display());
        }
        for claim in case.claims("// still wrong: ") {
            let (_, diagnostics) = case.changed(claim).run();
            assert_eq!(
                numbers(&of_interest(&case, diagnostics)),
                case.expected(),
                "{} with {claim:?}",
                path.display()
            );
        }
    });
}
