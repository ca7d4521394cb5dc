//! The command `vcutc`; see [`vcutc::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    vcutc::cli::run(&vcutc::registry::backends())
}
