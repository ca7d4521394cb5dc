//! LinuxCNC's interpreter, `rs274`, as it comes with the Debian package linuxcnc-uspace.

use super::canon::{self, Canon};
use super::compare::{Deed, Tolerance, compare};
use super::is_there;
use std::fs;
use std::process::{Command, Stdio};
use vcutc_backend_api::ir::OpId;

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

/// The output that chooses the kinematics there.
const KINEMATICS: u32 = 3;

/// A blade of 160 mm; `rs274` counts in inches. A program that relies on words from before its `G43` shows itself by this
/// length.
const TOOL_TABLE: &str = "T1 P1 Z6.299213\n";

/// The subroutine behind one of the M codes.
fn choice_of_kinematics(name: &str, number: u32) -> String {
    format!("o<{name}> sub\nM68 E{KINEMATICS} Q{number}\nM66 E0 L0\no<{name}> endsub\nM2\n")
}

/// Whether the interpreter is installed.
fn is_installed() -> bool {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("nothing.ngc"), "M2\n").unwrap();
    let mut command = Command::new("rs274");
    command.args(["-g", "nothing.ngc"]).current_dir(&folder);
    is_there("rs274", &mut command, "Debian package linuxcnc-uspace")
}

/// What the interpreter makes of files, of which the first is the main program.
fn carry_out(files: &[(String, Vec<u8>)]) -> Result<Vec<Canon>, String> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    write("machine.ini", CONFIGURATION.as_bytes());
    write("tool.tbl", TOOL_TABLE.as_bytes());
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

/// A program written by hand in the way of the backend: home, tip control, a cut, a turn about the still tip.
const BY_HAND: &str = "\
G17 G21 G40 G80 G90 G94
G61.1
G93
G53 G1 X300. Y200. Z-200. A0. B0. F6.
M65 P3
G53 G1 X310. Y200. Z-200. A-30. B40. F6.
M429
G43 H1
M64 P3
G4 P0.8
G94
G1 X10. Y20. Z30. A-30. B40. F6000.
G1 Y120. F12000.
G93
G1 A30. B-40. F30.
G49
M428
G53 G1 X300. Y200. Z-200. A0. B0. F6.
M65 P3
M2
";

fn by_hand() -> Vec<(OpId, Deed)> {
    let home = [300.0, 200.0, -200.0, 0.0, 0.0, 0.0];
    // From (310, 200, -200), where the axes stand, to (10, 20, 30): 418.688 mm.
    let approach = (300.0_f64.powi(2) + 180.0_f64.powi(2) + 230.0_f64.powi(2)).sqrt() / 100.0;
    let deeds = [
        Deed::Axes(home),
        Deed::Axes([310.0, 200.0, -200.0, -30.0, 40.0, 0.0]),
        Deed::Switch(3, true),
        Deed::Wait(0.8),
        Deed::Straight([10.0, 20.0, 30.0, -30.0, 40.0, 0.0], approach),
        Deed::Straight([10.0, 120.0, 30.0, -30.0, 40.0, 0.0], 0.5),
        Deed::Straight([10.0, 120.0, 30.0, 30.0, -40.0, 0.0], 2.0),
        Deed::Axes(home),
        Deed::Switch(3, false),
    ];
    (0..).map(OpId).zip(deeds).collect()
}

fn judged(program: &str) -> Result<(), String> {
    let canon = carry_out(&[("by_hand.ngc".to_owned(), program.as_bytes().to_vec())])?;
    compare(&by_hand(), &canon, Tolerance::of_decimals(3, 4))
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
    ];
    for (from, to) in changes {
        let changed = BY_HAND.replacen(from, to, 1);
        assert_ne!(changed, BY_HAND);
        assert!(judged(&changed).is_err(), "{from} -> {to}");
    }
    for (dropped, line) in lines.iter().enumerate() {
        if [" F", "M64", "G4 ", "M2"].iter().any(|word| line.contains(word)) {
            let left = [&lines[..dropped], &lines[dropped + 1..]].concat().join("\n") + "\n";
            assert!(judged(&left).is_err(), "without {line}");
        }
    }
}
