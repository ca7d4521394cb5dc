//! The examples that people start from.

use crate::krl_text;
use crate::pipeline::{Files, all_diagnostics, compile, emit, fixed, numbers, told};
use crate::repository::{files, root};
use std::collections::BTreeSet;

/// The examples that are meant to fail, with the codes they show.
const FAILING: &[(&str, &[&str])] = &[
    ("broken.vcut", &["VC0102", "VC0201", "VC0203", "VC0205", "VC0209"]),
    ("out_of_reach.vcut", &["VC0510"]),
    ("too_deep.vcut", &["VC0401"]),
];

/// The jobs among the examples: what lies in their folder itself, without the files they use.
fn jobs() -> Vec<(String, String)> {
    let jobs = files("examples", ".vcut").into_iter().filter_map(|file| {
        let name = file.path.strip_prefix("examples/")?.to_owned();
        (!name.contains('/')).then_some((name, file.text))
    });
    jobs.collect()
}

fn folder() -> Files {
    Files::of(root().join("examples"))
}

#[test]
fn examples_say_what_they_are_and_what_they_show() {
    for (name, text) in jobs() {
        let mut lines = text.lines();
        let [first, second] = [lines.next(), lines.next()].map(Option::unwrap_or_default);
        assert!(first.starts_with("// ") && first.len() > 20, "{name}: {first}");
        assert!(second.starts_with("// Shows: "), "{name}: {second}");
    }
}

#[test]
fn examples_compile_and_say_what_was_planned() {
    for (name, _) in jobs() {
        if FAILING.iter().any(|(failing, _)| *failing == name) {
            continue;
        }
        let outcome = compile(&name, &folder());
        let messages = told(&all_diagnostics(&outcome), &outcome);
        assert_eq!(messages, "", "{name}");
        krl_text::check(&outcome, &emit(&outcome).unwrap());
    }
}

/// The files of the examples with an ABB arm in place of the large KUKA.
fn folder_with_abb() -> Files {
    let files = files("examples", ".vcut").into_iter();
    files.fold(folder(), |all, file| {
        let text = file
            .text
            .replace("kuka/kr210_r3100_ultra", "abb/irb6700_155_285")
            .replace(
                "joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)",
                "joints(0 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg)",
            );
        match file.path.strip_prefix("examples/") {
            Some(name) if text != file.text && text.contains("irb6700") => all.with(name, text),
            Some(_) | None => all,
        }
    })
}

#[test]
fn examples_are_within_reach_of_an_abb_too() {
    for (name, _) in jobs() {
        if FAILING.iter().any(|(failing, _)| *failing == name) {
            continue;
        }
        let outcome = compile(&name, &folder_with_abb());
        assert_eq!(told(&outcome.diagnostics, &outcome), "", "{name}");
    }
}

#[test]
fn examples_of_errors_fail_as_they_are_meant_to() {
    for &(name, codes) in FAILING {
        let outcome = compile(name, &folder());
        let found: BTreeSet<_> = numbers(&outcome.diagnostics).into_iter().collect();
        assert_eq!(found.into_iter().collect::<Vec<_>>(), codes, "{name}");
        assert!(outcome.compiled.is_none());
    }
}

#[test]
fn each_fix_of_the_example_out_of_reach_makes_it_compile() {
    let outcome = compile("out_of_reach.vcut", &folder());
    let fixes: Vec<_> = outcome
        .diagnostics
        .iter()
        .flat_map(|found| &found.fixes)
        .collect();
    assert!(fixes.len() >= 2, "{fixes:?}");
    for fix in fixes {
        let mended = fixed(&folder(), &outcome, fix);
        let after = compile("out_of_reach.vcut", &mended);
        assert_eq!(told(&all_diagnostics(&after), &after), "", "{}", fix.title);
        krl_text::check(&after, &emit(&after).unwrap());
    }
}
