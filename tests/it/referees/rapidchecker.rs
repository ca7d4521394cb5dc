//! The grammar of RAPID in the Python package rapidchecker, which also looks at layout.

use super::is_there;
use std::fs;
use std::process::{Command, Stdio};

/// The version that these tests were written against; `.ci/run` installs it.
const PACKAGE: &str = "Python package rapidchecker 0.1.5";

/// Whether it is installed.
fn is_installed() -> bool {
    let mut command = Command::new("python3");
    command.args(["-c", "import rapidchecker.cli"]);
    is_there("rapidchecker", &mut command, PACKAGE)
}

/// What it has to say about modules; nothing when it finds no fault.
fn complaints(modules: &[(String, Vec<u8>)]) -> Result<(), String> {
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
