//! LinuxCNC's interpreter, `rs274`, as it comes with the Debian package linuxcnc-uspace.

use super::canon::{self, Canon, KINEMATICS};
use super::chain::chained;
use super::compare::{Deed, End, Tolerance, compare, deeds};
use super::is_there;
use crate::pipeline::{Files, compile_on, emit_for};
use crate::repository::root;
use crate::shop::{Pairing, compiled_for, compiling, has_words_for};
use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Stdio};
use vcutc::registry;
use vcutc_backend_api::backend::{OptionValue, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::{Orientation, Zyx};
use vcutc_backend_api::ir::{Cell, OpId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::units::{Angle, Length};

/// The configuration of a machine with switchable kinematics: two M codes of its own, as the sample configurations of
/// LinuxCNC have them (`remap_subs/428remap.ngc`).
const CONFIGURATION: &str = "\
[DISPLAY]
PROGRAM_PREFIX = .
[RS274NGC]
SUBROUTINE_PATH = .
REMAP = M428 modalgroup=10 ngc=kinematics_of_axes
REMAP = M429 modalgroup=10 ngc=kinematics_of_the_tip
";

/// The length of the blade, in mm. A program that relies on words from before its `G43` shows itself by it.
const BLADE: f64 = 160.0;

/// That blade and one of 130 mm; `rs274` counts in inches.
const TOOL_TABLE: &str = "T1 P1 Z6.299213\nT2 P2 Z5.118110\n";

/// The subroutine that one of the M codes calls.
fn choice_of_kinematics(name: &str, number: u32) -> String {
    format!("o<{name}> sub\nM68 E{KINEMATICS} Q{number}\nM66 E0 L0\no<{name}> endsub\nM2\n")
}

/// Whether the interpreter is installed.
fn is_installed() -> bool {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("nothing.ngc"), "M2\n").unwrap();
    let mut command = Command::new("rs274");
    command
        .args(["-g", "nothing.ngc"])
        .current_dir(&folder)
        .env("HOME", folder.path());
    is_there("rs274", &mut command, "Debian package linuxcnc-uspace")
}

/// What the interpreter makes of files, of which the first is the main program.
fn carry_out(files: &[(String, Vec<u8>)]) -> Result<Vec<Canon>, String> {
    carry_out_with(TOOL_TABLE, files)
}

/// A line for each place of a cell up to the last that holds a tool: `rs274` says which line of the table a
/// change takes, not which place that is. It counts in inches.
fn tool_table(cell: &Cell) -> String {
    let in_places = (1..).zip(cell.tools.iter()).map(|(number, (_, tool))| {
        let length = tool.frame.frame.origin.z / 25.4;
        (tool.place.unwrap_or(number), length)
    });
    let lengths: BTreeMap<u32, f64> = in_places.collect();
    let last = lengths.keys().last().copied().unwrap_or_default();
    let line = |number| {
        let length = lengths.get(&number).copied().unwrap_or_default();
        format!("T{number} P{number} Z{length:.6}\n")
    };
    (1..=last).map(line).collect()
}

/// The same with a table of tools.
fn carry_out_with(tools: &str, files: &[(String, Vec<u8>)]) -> Result<Vec<Canon>, String> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    write("machine.ini", CONFIGURATION.as_bytes());
    write("tool.tbl", tools.as_bytes());
    for (number, name) in [(0, "kinematics_of_axes"), (1, "kinematics_of_the_tip")] {
        write(
            &format!("{name}.ngc"),
            choice_of_kinematics(name, number).as_bytes(),
        );
    }
    for (name, text) in files {
        write(name, text);
    }
    let output = Command::new("rs274")
        .args(["-i", "machine.ini", "-t", "tool.tbl", "-g", &files[0].0])
        .current_dir(&folder)
        // It keeps its tools in a file there, which runs at the same time would share.
        .env("HOME", folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        canon::read(&said)
    } else {
        let last: Vec<&str> = said.lines().rev().take(3).collect();
        let errors = String::from_utf8_lossy(&output.stderr);
        Err(format!("rs274 stops: {}\nafter {last:#?}", errors.trim()))
    }
}

/// Whether the program of an example does what its intermediate program says, by the interpreter. The words of the dialect
/// that LinuxCNC has not are replaced before.
fn judge_examples(dialect: &str, words: &[(&str, &str)], within: Tolerance) {
    if !is_installed() {
        return;
    }
    let target = registry::backend("gcode").unwrap();
    let mut programs = 0;
    for (name, pairings) in compiling() {
        if !has_words_for(dialect, &name) {
            continue;
        }
        for Pairing { machine, .. } in pairings.iter().filter(|pairing| pairing.target == target.id()) {
            let outcome = compiled_for(dialect, *machine, &name);
            let bundle = emit_for(target, outcome).unwrap();
            let translated: Vec<_> = bundle
                .files()
                .iter()
                .map(|file| translated(file, words))
                .collect();
            let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
            let tools = tool_table(reached.program.program().cell.as_ref().unwrap());
            let judged = carry_out_with(&tools, &translated)
                .and_then(|canon| compare(&deeds(&reached.program), &canon, within));
            assert_eq!(judged, Ok(()), "{name} on {machine:?} for {dialect}");
            programs += 1;
        }
    }
    assert!(programs > 0, "no example is cut on a gantry");
}

/// A file with the words replaced that begin its lines.
fn translated((name, text): &(String, Vec<u8>), words: &[(&str, &str)]) -> (String, Vec<u8>) {
    let lines = str::from_utf8(text).unwrap().lines().map(|line| {
        let found = words
            .iter()
            .find_map(|(from, to)| Some((to, line.strip_prefix(from)?)));
        found.map_or_else(|| line.to_owned(), |(to, rest)| format!("{to}{rest}"))
    });
    (
        name.clone(),
        lines.map(|line| line + "\n").collect::<String>().into_bytes(),
    )
}

/// Its programs are for this interpreter: nothing is replaced.
#[test]
fn programs_for_linuxcnc_do_what_they_should() {
    judge_examples("linuxcnc", &[], Tolerance::of_decimals(3, 4, 2.0, BLADE));
}

/// A program that changes its blade does as well, and one of another change does not.
#[test]
fn changes_of_the_blade_are_carried_out() {
    if !is_installed() {
        return;
    }
    let files = Files::of(root().join("tests/jobs/two_tools"));
    let outcome = compile_on(Some("gantry"), "job.vcut", &files);
    let bundle = emit_for(registry::backend("gcode").unwrap(), &outcome).unwrap();
    let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
    let judged = |from: &str, to: &str| {
        let edited = |(name, text): &(String, Vec<u8>)| {
            let text = str::from_utf8(text).unwrap();
            assert!(text.contains(from), "{from}");
            (name.clone(), text.replace(from, to).into_bytes())
        };
        let files: Vec<_> = bundle.files().iter().map(edited).collect();
        let within = Tolerance::of_decimals(3, 4, 2.0, BLADE);
        carry_out(&files).and_then(|canon| compare(&deeds(&reached.program), &canon, within))
    };
    assert_eq!(judged("T2 M6", "T2 M6"), Ok(()));
    for (from, to) in [
        ("T2 M6\n", ""),
        ("T2 M6", "T1 M6"),
        ("T2 M6", "T3 M6"),
        ("T2 M6", "M0"),
        ("T2 M6", "T2 M6\nT2 M6"),
        ("G43 H2", "G43 H1"),
    ] {
        assert!(judged(from, to).is_err(), "{from} -> {to}");
    }
}

/// A program that changes its blade and then follows a chain does as well, and one of another chain does not.
#[test]
fn chains_are_carried_out() {
    if !is_installed() {
        return;
    }
    let files = Files::of(root().join("tests/jobs/two_tools"));
    let outcome = compile_on(Some("gantry"), "job.vcut", &files);
    let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
    let lying = |a: f64, b: f64| {
        let mut program = reached.program.program().clone();
        if let Some(cell) = &mut program.cell {
            let [a, b, c] = [a, b, 0.0].map(Angle::deg);
            cell.base.frame.orientation = Orientation::from_zyx(Zyx { a, b, c });
        }
        chained(program, Length::mm(0.1))
    };
    let program = lying(0.0, 0.0);
    let target = registry::backend("gcode").unwrap();
    let mut options = Options::defaults(target.options());
    for (key, code) in [("tcp_on", "M429"), ("tcp_off", "M428")] {
        let spec = target.options().iter().find(|spec| spec.key == key).unwrap();
        options
            .set(spec, OptionValue::Lines(vec![code.to_owned()]))
            .unwrap();
    }
    let judged_as = |program: &ReachableProgram, from: &str, to: &str| {
        let mut bundle = Bundle::default();
        let emission = target.check(program, &options).unwrap();
        emission.write(&mut bundle).unwrap();
        let edited = |(name, text): &(String, Vec<u8>)| {
            let text = str::from_utf8(text).unwrap();
            assert!(text.contains(from), "{from} in {text}");
            (name.clone(), text.replacen(from, to, 1).into_bytes())
        };
        let files: Vec<_> = bundle.files().iter().map(edited).collect();
        let within = Tolerance::of_decimals(3, 4, 2.0, BLADE);
        carry_out(&files).and_then(|canon| compare(&deeds(program), &canon, within))
    };
    // The same arcs in all three planes, as the work lies on the machine.
    for (program, block, other) in [
        (lying(0.0, 0.0), "\nG19 G91.1 G3 X", "\nG19 G91.1 G2 X"),
        (lying(90.0, 0.0), "\nG18 G91.1 G3 X", "\nG18 G91.1 G2 X"),
        (lying(-90.0, 0.0), "\nG18 G91.1 G2 X", "\nG18 G91.1 G3 X"),
        (lying(0.0, 90.0), "\nG91.1 G2 X", "\nG91.1 G3 X"),
    ] {
        assert_eq!(judged_as(&program, block, block), Ok(()), "{block}");
        assert!(judged_as(&program, block, other).is_err(), "{other}");
    }
    let judged = |from: &str, to: &str| judged_as(&program, from, to);
    for (from, to) in [
        ("T2 M6", "T1 M6"),
        ("G43 H2", "G43 H1"),
        ("G64 P0.1 Q0", "G64 P0.2 Q0"),
        ("G64 P0.1 Q0", "G64 P0 Q0"),
        ("G64 P0.1 Q0\n", ""),
        ("G64 P0.1 Q0", "G61"),
        ("G61.1 G1", "G1"),
        ("G61.1 G1", "G61 G1"),
        ("G19 G91.1 G3", "G19 G91.1 G2"),
        ("G19 G91.1 G3", "G19 G91.1 G1"),
        ("G19 G91.1 G3", "G91.1 G3"),
        ("G19 G91.1 G3", "G18 G91.1 G3"),
        ("G19 G91.1 G3", "G19 G90.1 G3"),
        ("\nG2 X", "\nG3 X"),
        (" J0.000 K8.000", " J0.100 K8.000"),
        (" K8.000", " K8.010"),
        (" K8.000", ""),
    ] {
        assert!(judged(from, to).is_err(), "{from} -> {to}");
    }
}

/// Fanuc's words that LinuxCNC has not, with those that do the same there.
const FANUC: &[(&str, &str)] = &[
    // Tool-centre-point control: LinuxCNC has it as kinematics, beside the tool's length.
    ("G43.4 H1", "G43 H1\nM429"),
    ("G43.4 H2", "G43 H2\nM429"),
    ("G43.4 H4", "G43 H4\nM429"),
    ("G49", "M428\nG49"),
    // Exact stop, which G61 is not there.
    ("G61", "G61.1"),
    // A wait in seconds.
    ("G4 X", "G4 P"),
    // M codes of the builder, as the shop's options have them, for its output 3.
    ("M50", "M64 P3"),
    ("M51", "M65 P3"),
];

#[test]
fn programs_for_fanuc_do_what_they_should() {
    // Its G64 says no tolerance.
    judge_examples("fanuc", FANUC, Tolerance::of_decimals(3, 3, f64::INFINITY, BLADE));
}

/// A program written by hand in the way of the backend: home, tip control, a cut, a turn about the still tip.
const BY_HAND: &str = "\
M428
G49
G17 G21 G40 G80 G90 G94
G61.1
G93
G53 G1 X300. Y200. Z-200. A0. B0. F6.
M65 P3
G53 G1 X310. Y200. Z-200. A-30. B40. F6.
G43 H1
M429
M64 P3
G4 P0.8
G94
G64 P2 Q0
G1 X10. Y20. Z50. A-30. B40. F3600.
G61.1
G1 Z30. F4800.
G1 Y120. F12000.
G93
G1 A30. B-40. F30.
M428
G49
G53 G1 X300. Y200. Z-200. A0. B0. F6.
M65 P3
M2
";

fn by_hand() -> Vec<(OpId, Deed)> {
    let home = [300.0, 200.0, -200.0, 0.0, 0.0, 0.0];
    let ending = |end| {
        move |from, to, seconds| Deed::Straight {
            from,
            to,
            seconds,
            end,
        }
    };
    let (through_air, straight) = (ending(End::Free), ending(End::Exact));
    // The kinematics of the tip begin 30 mm above the first point.
    let high = [10.0, 20.0, 80.0, -30.0, 40.0, 0.0];
    let above = [10.0, 20.0, 50.0, -30.0, 40.0, 0.0];
    let begin = [10.0, 20.0, 30.0, -30.0, 40.0, 0.0];
    let end = [10.0, 120.0, 30.0, -30.0, 40.0, 0.0];
    let turned = [10.0, 120.0, 30.0, 30.0, -40.0, 0.0];
    let deeds = [
        Deed::Axes(home),
        Deed::Axes([310.0, 200.0, -200.0, -30.0, 40.0, 0.0]),
        Deed::Switch(3, true),
        Deed::Wait(0.8),
        through_air(high, above, 0.5),
        straight(above, begin, 0.25),
        straight(begin, end, 0.5),
        straight(end, turned, 2.0),
        Deed::Axes(home),
        Deed::Switch(3, false),
    ];
    (0..).map(OpId).zip(deeds).collect()
}

fn judged(program: &str) -> Result<(), String> {
    let canon = carry_out(&[("by_hand.ngc".to_owned(), program.as_bytes().to_vec())])?;
    compare(&by_hand(), &canon, Tolerance::of_decimals(3, 4, 2.0, BLADE))
}

#[test]
fn a_program_written_by_hand_is_judged_right() {
    if is_installed() {
        assert_eq!(judged(BY_HAND), Ok(()));
    }
}

/// The judge is not a rubber stamp: whatever is changed is found.
#[test]
fn a_changed_program_is_judged_wrong() {
    if !is_installed() {
        return;
    }
    let lines: Vec<&str> = BY_HAND.lines().collect();
    let changes = [
        ("Y120.", "Y120.002"),
        ("A30. B-40.", "A30. B-40.001"),
        ("F12000.", "F11900."),
        ("F30.", "F29."),
        ("G4 P0.8", "G4 P0.9"),
        ("M64 P3", "M64 P2"),
        ("M64 P3", "M65 P3"),
        ("G61.1", "G43.4 H1"),
        ("X10. Y20.", "X10. X20."),
        // Tips as positions of the axes, positions of the axes as tips, the axes jumping by the length of a blade.
        ("M429\n", ""),
        ("M429", "M428"),
        ("M428", "M429"),
        ("M428\nG49\nG53", "G53"),
        ("G43 H1\n", ""),
        ("G43 H1\nM429", "M429\nG43 H1"),
        ("M428\nG49\nG53", "G49\nM428\nG53"),
        // Corners cut where the blade is at the work, or by more than the job allows.
        ("G61.1\nG93", "G64 P5\nG93"),
        ("G61.1\nG1 Z30.", "G1 Z30."),
        ("G61.1\nG1 Z30.", "G61\nG1 Z30."),
        ("G61.1\nG1 Z30. F4800.", "G61.1\nG1 Z30. F4800.\nG64 P2 Q0"),
        ("G64 P2 Q0", "G64 P5 Q0"),
        ("G64 P2 Q0", "G64"),
    ];
    let everywhere = [
        ("M428\n", ""),
        ("M429\n", ""),
        ("G61.1", "G64 P5"),
        ("G61.1\n", ""),
    ];
    for (from, to) in changes {
        let changed = BY_HAND.replacen(from, to, 1);
        assert_ne!(changed, BY_HAND);
        assert!(judged(&changed).is_err(), "{from} -> {to}");
    }
    for (from, to) in everywhere {
        let changed = BY_HAND.replace(from, to);
        assert!(judged(&changed).is_err(), "{from} -> {to} everywhere");
    }
    for (dropped, line) in lines.iter().enumerate() {
        if [" F", "M64", "G4 ", "M2", "M429", "G43", "G61.1"]
            .iter()
            .any(|word| line.contains(word))
        {
            let left = [&lines[..dropped], &lines[dropped + 1..]].concat().join("\n") + "\n";
            assert!(judged(&left).is_err(), "without {line}");
        }
    }
}
