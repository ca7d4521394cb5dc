//! One gantry and four controls: the commands that the page of the examples shows turn its block into one for each.

use super::{folder, names, vcutc};
use crate::repository::{read, root};
use std::path::Path;

/// The commands of the page that compile for a gantry, without the name of the compiler.
fn commands() -> Vec<Vec<String>> {
    let page = read("examples/README.md");
    let commands = page.lines().filter_map(|line| line.strip_prefix("$ vcutc "));
    commands
        .map(|command| command.split(' ').map(|word| word.replace('\'', "")).collect())
        .collect()
}

/// Runs a command of the page in the repository, with another folder for what it writes.
fn written(command: &[String], output: &Path) -> (Option<i32>, String) {
    let (rest, _) = command.split_at(command.iter().position(|word| word == "-o").unwrap());
    let mut args: Vec<&str> = rest.iter().map(String::as_str).collect();
    args.extend(["-q", "-o", output.to_str().unwrap()]);
    let run = vcutc(root(), &args);
    (run.code, run.stderr)
}

#[test]
fn commands_of_the_examples_page_compile_for_every_control() {
    let commands = commands();
    let controls = [
        ("linuxcnc", "fairing.ngc", "M429"),
        ("sinumerik", "FAIRING.MPF", "TRAORI"),
        ("fanuc", "FAIRING.nc", "G43.4"),
        ("heidenhain", "FAIRING.H", "FUNCTION TCPM"),
    ];
    assert_eq!(commands.len(), controls.len());
    for (command, (control, file, word)) in commands.iter().zip(controls) {
        assert_eq!(command.last(), Some(&format!("out/{control}")));
        let output = folder();
        assert_eq!(written(command, output.path()), (Some(0), String::new()));
        let Ok(text) = std::fs::read_to_string(output.path().join(file)) else {
            panic!("{control}: {:?}", names(output.path()));
        };
        assert!(text.contains(word), "{control}");
    }
}

/// Each option of the commands is needed: without it the control lacks something, or is given what it has no use for.
#[test]
fn no_option_of_these_commands_can_be_left_out() {
    for command in &commands()[1..] {
        let given = command.iter().enumerate().filter(|(_, word)| *word == "--option");
        for (at, _) in given.filter(|(at, _)| !command[at + 1].starts_with("dialect")) {
            let mut without = command.clone();
            let left_out = without.drain(at..at + 2).collect::<Vec<_>>();
            let output = folder();
            let (code, stderr) = written(&without, output.path());
            assert_eq!(code, Some(1), "{left_out:?}");
            assert!(stderr.contains("VC0604"), "{stderr}");
        }
    }
}
