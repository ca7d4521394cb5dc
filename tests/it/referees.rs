//! Programs before foreign judges.
//!
//! LinuxCNC's own interpreter carries out the G-code programs of all examples, and what it makes of them (its canonical
//! functions) is compared with the intermediate program, op by op, and so is what the machine is set to at
//! each of them: the kinematics, the blade, the mode of control. A grammar of RAPID by another author reads
//! the RAPID modules of the shortest example, and of all others every form of line: of those that differ in
//! nothing but digits the first.
//!
//! Both are installed by `.ci/run`. Where one is missing its tests are skipped and say so, unless `VCUTC_REFEREES` is
//! `required`.

mod canon;
mod chain;
mod compare;
mod rapidchecker;
mod rs274;

use std::io::Write;
use std::process::{Command, Stdio};

/// Whether a referee is there, by starting it. A referee that is missing fails the test where referees are required.
#[expect(
    clippy::explicit_write,
    reason = "the test harness keeps what `eprintln!` prints, as long as the test passes"
)]
pub(crate) fn is_there(what: &str, command: &mut Command, package: &str) -> bool {
    let started = command.stdin(Stdio::null()).output();
    if started.is_ok_and(|output| output.status.success()) {
        return true;
    }
    let is_required = std::env::var("VCUTC_REFEREES").is_ok_and(|value| value == "required");
    assert!(!is_required, "{what} is required and not installed: {package}");
    writeln!(std::io::stderr(), "skipped: {what} is not installed ({package})").unwrap();
    false
}
