//! The grammar of RAPID in the Python package rapidchecker, which also looks at layout.
//!
//! It is slow. The shortest program of the examples it sees as a whole; of the others, of lines that differ in nothing but
//! digits, the first: every form of line that they have, and not every line.

use super::is_there;
use crate::pipeline::emit_for;
use crate::shop::{Pairing, compiled, compiling};
use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Stdio};
use vcutc::registry;

/// The version that these tests were written against; `.ci/run` installs it.
const PACKAGE: &str = "Python package rapidchecker 0.1.5";

/// Whether it is installed.
fn is_installed() -> bool {
    let mut command = Command::new("python3");
    command.args(["-c", "import rapidchecker.cli"]);
    is_there("rapidchecker", &mut command, PACKAGE)
}

/// What it has to say about modules; nothing when it finds no fault.
fn complaints(modules: &[Module]) -> Result<(), String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in modules {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let output = Command::new("python3")
        .args(["-m", "rapidchecker"])
        .args(modules.iter().map(|(name, _)| name))
        .current_dir(&folder)
        // It reads files in the encoding of the environment.
        .env("PYTHONUTF8", "1")
        .env("COLUMNS", "200")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let said = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    if output.status.success() {
        Ok(())
    } else {
        Err(said.concat())
    }
}

/// A module without the statements and comments that differ from one before in nothing but digits: to a grammar they say
/// nothing new, and this one takes 15 ms a line. Targets of arcs go on on the next line.
fn shortened(module: &[u8]) -> Vec<u8> {
    let mut seen = BTreeSet::new();
    let text = str::from_utf8(module).unwrap();
    let mut kept = String::new();
    let mut statement = String::new();
    for line in text.split_inclusive('\n') {
        statement.push_str(line);
        if line.trim_end().ends_with(',') {
            continue;
        }
        let is_single = line.trim_end().ends_with(';') || line.trim_start().starts_with('!');
        if !is_single || seen.insert(shape(&statement)) {
            kept.push_str(&statement);
        }
        statement.clear();
    }
    (kept + &statement).into_bytes()
}

/// A line with one digit in place of each row of digits.
fn shape(line: &str) -> String {
    let mut shape = String::with_capacity(line.len());
    for letter in line.chars() {
        let letter = if letter.is_ascii_digit() { '0' } else { letter };
        if letter != '0' || !shape.ends_with('0') {
            shape.push(letter);
        }
    }
    shape
}

/// A file: its name and its text.
type Module = (String, Vec<u8>);

/// The modules of the examples on their ABB robot, with the name of the example.
fn programs() -> Vec<(String, Vec<Module>)> {
    let target = registry::backend("rapid").unwrap();
    let mut programs = Vec::new();
    for (name, pairings) in compiling() {
        for Pairing { machine, .. } in pairings.iter().filter(|pairing| pairing.target == target.id()) {
            let bundle = emit_for(target, compiled(*machine, &name)).unwrap();
            let is_module = |(name, _): &&Module| !name.ends_with(".pgf");
            let modules = bundle.files().iter().filter(is_module).cloned().collect();
            programs.push((name.clone(), modules));
        }
    }
    assert!(!programs.is_empty(), "no example is cut by an ABB robot");
    programs
}

#[test]
fn modules_of_examples_are_right() {
    if !is_installed() {
        return;
    }
    let programs = programs();
    for (name, modules) in &programs {
        let shortened: Vec<_> = modules
            .iter()
            .map(|(name, text)| (name.clone(), shortened(text)))
            .collect();
        assert_eq!(complaints(&shortened), Ok(()), "{name}");
    }
    let size = |modules: &[Module]| modules.iter().map(|(_, text)| text.len()).sum::<usize>();
    let (name, shortest) = programs.iter().min_by_key(|(_, modules)| size(modules)).unwrap();
    assert_eq!(complaints(shortest), Ok(()), "{name} as a whole");
}

const BY_HAND: &str = "\
MODULE by_hand
  ! A comment.
  PERS tooldata t_blade := [TRUE, [[0, 0, 310], [1, 0, 0, 0]], [14.5, [0, 0, 140], [1, 0, 0, 0], 0, 0, 0]];

  PROC main()
    ConfL \\On;
    MoveAbsJ [[0, 0, 0, 0, 45, 0], [9E+09, 9E+09, 9E+09, 9E+09, 9E+09, 9E+09]] \\NoEOffs, v100, fine, t_blade;
    SetDO \\Sync, do12, 1;
    WaitTime 0.8;
  ENDPROC
ENDMODULE
";

#[test]
fn a_module_written_by_hand_is_right() {
    if is_installed() {
        assert_eq!(complaints(&[("by_hand.mod".to_owned(), BY_HAND.into())]), Ok(()));
    }
}

#[test]
fn faults_of_grammar_are_found() {
    if !is_installed() {
        return;
    }
    for (from, to) in [
        ("fine, t_blade;", "fine, t_blade"),
        ("ENDPROC", "ENDPROG"),
        ("[0, 0, 310]", "[0, 0, 310"),
    ] {
        let changed = BY_HAND.replacen(from, to, 1);
        assert_ne!(changed, BY_HAND);
        assert!(
            complaints(&[("by_hand.mod".to_owned(), changed.into())]).is_err(),
            "{from} -> {to}"
        );
    }
}
