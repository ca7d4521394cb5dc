//! A page in the user's browser: that of the variable `BROWSER`, else the one that the system opens pages with.

use std::env;
use std::path::Path;
use std::process::{Command, Stdio};

/// Opens a file.
pub(super) fn open(page: &Path) -> Result<(), String> {
    let mut command = match env::var_os("BROWSER").filter(|browser| !browser.is_empty()) {
        Some(browser) => Command::new(browser),
        None => of_the_system(),
    };
    let status = command
        .arg(page)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|error| format!("{} cannot be run: {error}", command.get_program().display()))?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("{} failed", command.get_program().display()))
    }
}

fn of_the_system() -> Command {
    if cfg!(target_os = "macos") {
        Command::new("open")
    } else if cfg!(windows) {
        Command::new("explorer")
    } else {
        Command::new("xdg-open")
    }
}
