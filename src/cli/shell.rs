//! `vcutc completions SHELL` and `vcutc man`: what shells and manuals know of the command line, made from its arguments.

use super::Exit;
use super::args::Arguments;
use super::console::{Console, Failure};
use super::os_words::os_words;
use super::output::{Destination, Output};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::Path;
use vcutc_backend_api::bundle::Sink;

/// The name under which people call the compiler.
const NAME: &str = "vcutc";

/// Prints the script of a shell.
pub(super) fn completions(shell: Shell, console: &Console) -> Exit {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), NAME, &mut script);
    console.document(&String::from_utf8_lossy(&script))
}

/// Writes the page of the compiler and one for each of its commands, all or none.
pub(super) fn manual(folder: &Path, console: &Console) -> Exit {
    let mut root = Arguments::command();
    root.build();
    let mut output = Output::to(&Destination::Folder(folder.to_owned()));
    let commands = root
        .get_subcommands()
        .filter(|command| !command.is_hide_set() && command.get_name() != "help");
    let written = commands
        .map(|command| (format!("{NAME}-{}.1", command.get_name()), command.clone()))
        .chain([(format!("{NAME}.1"), root.clone())])
        .try_for_each(|(file, command)| page(&file, command, &mut output))
        .and_then(|()| output.publish());
    match written {
        Ok(placed) => {
            let body = serde_json::json!({ "files": placed.len() });
            let text = format!("wrote {} pages into {}\n", placed.len(), folder.display());
            console.note("manual", &text, body);
            Exit::Success
        }
        Err(reason) => console.failure(&Failure::new(reason)),
    }
}

fn page(file: &str, command: Command, output: &mut Output) -> Result<(), String> {
    let mut text = Vec::new();
    // Pages have no date: that of the build would make two builds of one version differ.
    Man::new(command)
        .render(&mut text)
        .map_err(|error| format!("cannot make {file}: {}", os_words(&error)))?;
    let taken = output.file(file).and_then(|()| output.write(&text));
    taken.map_err(|error| error.to_string())
}
