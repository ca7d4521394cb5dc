//! The README's tour, line by line: every command is run in a copy of the examples and ends as the page says.

use super::watch::Watch;
use super::{command, copy, folder, run};
use crate::repository::{read, root};

/// A line of a console block.
#[derive(Debug, PartialEq)]
struct Step {
    arguments: Vec<String>,
    /// How it ends: 0 unless a comment says something else.
    code: i32,
}

/// The commands of the quick start and of the tour.
fn steps(readme: &str) -> Vec<Step> {
    let (_, from_start) = readme
        .split_once("\n## Quick start\n")
        .expect("the README has a quick start");
    let (page, _) = from_start
        .split_once("\n## What errors look like\n")
        .expect("errors follow the tour");
    let blocks = page.split("```console\n").skip(1);
    blocks
        .flat_map(|block| block.split("```").next().unwrap_or_default().lines())
        .filter(|line| !line.starts_with("cargo test"))
        .map(step)
        .collect()
}

fn step(line: &str) -> Step {
    let (words, code) = match line.split_once("# exit status ") {
        Some((words, code)) => (words, code.trim().parse().expect("an exit status is a number")),
        None => (line, 0),
    };
    assert!(
        !words.contains(['"', '\'', '|', '#']),
        "nothing a shell would have to read: {line}"
    );
    let arguments = words
        .strip_prefix("vcutc ")
        .or_else(|| words.strip_prefix("cargo run --release -- "))
        .unwrap_or_else(|| panic!("only the compiler is run: {line}"));
    Step {
        arguments: arguments.split_whitespace().map(ToOwned::to_owned).collect(),
        code,
    }
}

#[test]
fn every_line_of_the_tour_ends_as_the_readme_says() {
    let steps = steps(&read("README.md"));
    assert!(
        steps.len() > 15,
        "{} steps: are they found where they are?",
        steps.len()
    );
    let workshop = folder();
    copy(&root().join("examples"), &workshop.path().join("examples"));
    let is_watch = |step: &&Step| step.arguments[0] == "watch";
    for Step { arguments, code } in steps.iter().filter(|step| !is_watch(step)) {
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let ended = run(command(workshop.path(), &words));
        assert_eq!(ended.code, Some(*code), "{}: {}", words.join(" "), ended.stderr);
        if let Some(output) = words.iter().position(|word| *word == "-o") {
            let place = workshop.path().join(words[output + 1]);
            assert!(place.exists(), "{}: nothing was written", words.join(" "));
        }
    }
    let watches: Vec<&Step> = steps.iter().filter(is_watch).collect();
    assert_eq!(watches.len(), 1, "one line of the tour goes on until it is ended");
    for Step { arguments, code } in watches {
        // The port of the page may be taken on the machine that runs the tests.
        let mut words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        assert_eq!(words.last(), Some(&"--serve"));
        words.push("0");
        let inside = folder();
        copy(&root().join("examples"), &inside.path().join("examples"));
        let watch = Watch::of(command(inside.path(), &words), inside);
        assert!(watch.address().starts_with("127.0.0.1:"));
        assert_eq!(watch.interrupt(), Some(*code));
    }
}

#[test]
fn lines_of_other_pages_are_read_as_they_are_meant() {
    let page = "\n## Quick start\n```console\ncargo test --workspace\n```\n```console\nvcutc check a.vcut   # exit status 1\n```\n\
                \n## What errors look like\n```console\nvcutc b\n```";
    let expected = Step {
        arguments: vec!["check".to_owned(), "a.vcut".to_owned()],
        code: 1,
    };
    assert_eq!(steps(page), [expected]);
}
