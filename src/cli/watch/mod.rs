//! `vcutc watch JOB`: the job is compiled again whenever one of its files changes.
//!
//! Its files are those that the compiler asked for, found or not. After a change it waits until they stay as they are for a
//! moment: editors save in several steps. Programs are written as `vcutc JOB --target` does; with `--serve` the report is
//! shown in a browser, which loads it anew by itself.

mod request;
mod server;
mod stamps;

use super::args::WatchArgs;
use super::compile::{Watched, judge_again};
use super::console::{Console, Failure};
use super::files::Disk;
use super::{Exit, Targets};
use crate::diag::render::{ColorChoice, render};
use crate::driver::Outcome;
use crate::memory::Memory;
use crate::report::page::{Served, served_errors, served_page};
use crate::source::Loader as _;
use serde::Serialize;
use server::Server;
use stamps::{Pause, Recorder, Stamps};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// How long files must stay as they are before they are read.
const SETTLED: Duration = Duration::from_millis(10);
/// The same while one of them is missing: some editors take a file away before they put the new one in its place.
const SETTLED_WITHOUT_FILE: Duration = Duration::from_millis(400);
/// Files that never stay as they are are read all the same after so long.
const LONGEST_UNREST: Duration = Duration::from_secs(2);

/// What is waited for, for programs.
#[derive(Serialize)]
struct Waiting<'a> {
    job: &'a str,
    files: usize,
    milliseconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    address: Option<&'a str>,
}

/// Watches a job until it is interrupted.
pub(super) fn watch(args: &WatchArgs, targets: &Targets, console: &Console) -> Exit {
    match prepare(args, targets).and_then(|watch| Ok((watch, Interrupt::listen()?))) {
        Ok((watch, interrupt)) => watch.run(&interrupt, console),
        Err(failure) => console.failure(&failure),
    }
}

fn prepare<'a>(args: &'a WatchArgs, targets: &'a Targets) -> Result<Watch<'a>, Failure> {
    if args.job == "-" || args.output.as_deref() == Some("-") {
        return Err(
            Failure::new("`vcutc watch` takes a job from a file and writes into a folder")
                .help("compile once for standard input and output: leave out `watch`"),
        );
    }
    // Later a file that vanishes is waited for; a name that was wrong from the beginning is not.
    let path = Path::new(&args.job);
    if !path.is_file() {
        let why = if path.exists() {
            "it is no file"
        } else {
            "there is no such file"
        };
        return Err(Failure::new(format!("cannot read the job {}: {why}", args.job)));
    }
    let watched = Watched::new(args, targets)?;
    let server = match args.serve {
        Some(port) => Some(Server::start(port).map_err(|error| no_server(port, &error))?),
        None => None,
    };
    Ok(Watch { watched, server })
}

fn no_server(port: u16, error: &std::io::Error) -> Failure {
    Failure::new(format!("cannot listen on 127.0.0.1:{port}: {error}"))
        .help("give another port with `--serve PORT`; with 0 the system chooses one")
}

/// The wish of the user to end.
struct Interrupt {
    asked: Receiver<()>,
    is_busy: Arc<AtomicBool>,
}

impl Interrupt {
    /// Listens for Ctrl-C and for requests to end. While a job is compiled the first one lets it be finished, so that no file is
    /// left under a passing name; the second one ends at once.
    fn listen() -> Result<Self, Failure> {
        let (sender, asked) = mpsc::channel();
        let is_busy = Arc::new(AtomicBool::new(false));
        let busy = Arc::clone(&is_busy);
        let was_asked = AtomicBool::new(false);
        let on_signal = move || {
            let is_second = was_asked.swap(true, Ordering::SeqCst);
            let is_waiting = sender.send(()).is_ok();
            if !is_waiting || (is_second && busy.load(Ordering::SeqCst)) {
                std::process::exit(130);
            }
        };
        ctrlc::set_handler(on_signal)
            .map_err(|error| Failure::new(format!("cannot listen for Ctrl-C: {error}")))?;
        Ok(Self { asked, is_busy })
    }

    /// Waits for so long. Returns whether the user wants to end.
    fn wait(&self, length: Duration) -> bool {
        match self.asked.recv_timeout(length) {
            Ok(()) | Err(RecvTimeoutError::Disconnected) => true,
            Err(RecvTimeoutError::Timeout) => false,
        }
    }
}

/// What became of waiting.
enum Woken {
    /// A file has changed, and all stay as they are.
    Changed,
    /// The user wants to end.
    Interrupted,
}

struct Watch<'a> {
    watched: Watched<'a>,
    server: Option<Server>,
}

impl Watch<'_> {
    fn run(&self, interrupt: &Interrupt, console: &Console) -> Exit {
        let mut memory = Memory::of_some_runs();
        loop {
            console.clear_screen();
            interrupt.is_busy.store(true, Ordering::SeqCst);
            let start = Instant::now();
            let stamps = self.once(&mut memory, console);
            interrupt.is_busy.store(false, Ordering::SeqCst);
            self.tell(&stamps, start.elapsed(), console);
            match changed(&stamps, interrupt) {
                Woken::Changed => {}
                Woken::Interrupted => return Exit::Success,
            }
        }
    }

    /// Compiles the job and hands the page on. Returns the files that were asked for.
    fn once(&self, memory: &mut Memory, console: &Console) -> Stamps {
        let disk = Disk::around(self.watched.job());
        let recorder = Recorder::new(&disk);
        let mut is_shown = false;
        judge_again(&self.watched, &recorder, memory, console, &mut |outcome| {
            is_shown = true;
            if let Some(server) = &self.server {
                server.show(|served| page(self.watched.job(), outcome, served));
            }
        });
        if let (false, Some(server), Err(reason)) = (is_shown, &self.server, disk.load(disk.job())) {
            let job = self.watched.job();
            let message = format!("cannot read the job {job}: {reason}\n");
            server.show(|served| served_errors(job, &message, served));
        }
        recorder.stamps()
    }

    fn tell(&self, stamps: &Stamps, time: Duration, console: &Console) {
        let address = self.server.as_ref().map(Server::address);
        let files = match stamps.count() {
            1 => "1 file".to_owned(),
            count => format!("{count} files"),
        };
        let milliseconds = time.as_secs_f64() * 1e3;
        let at = address.map_or(String::new(), |address| format!("; the report is at {address}"));
        let text = format!("done in {milliseconds:.0} ms, watching {files}{at} (Ctrl-C ends)\n");
        let job = self.watched.job();
        let body = Waiting {
            job,
            files: stamps.count(),
            milliseconds,
            address,
        };
        console.note("waiting", &text, body);
    }
}

/// The page of a job, or what is wrong with it.
fn page(job: &str, outcome: &Outcome, served: &Served) -> String {
    served_page(outcome, served).unwrap_or_else(|| {
        let messages = render(&outcome.diagnostics, &outcome.sources, ColorChoice::Plain);
        served_errors(job, &messages, served)
    })
}

/// Waits for a change.
fn changed(stamps: &Stamps, interrupt: &Interrupt) -> Woken {
    let mut pause = Pause::new();
    loop {
        if interrupt.wait(pause.length()) {
            return Woken::Interrupted;
        }
        let now = pause.look(stamps);
        if now != *stamps {
            return settled(stamps, now, pause, interrupt);
        }
    }
}

/// Waits until files that have changed stay as they are.
fn settled(before: &Stamps, first: Stamps, mut pause: Pause, interrupt: &Interrupt) -> Woken {
    let start = Instant::now();
    let mut last = first;
    let mut since = start;
    loop {
        if is_over(needed(before, &last), since.elapsed(), start.elapsed()) {
            return Woken::Changed;
        }
        if interrupt.wait(pause.length()) {
            return Woken::Interrupted;
        }
        let now = pause.look(before);
        if now != last {
            last = now;
            since = Instant::now();
        }
    }
}

/// How long files that are so now must stay so.
fn needed(before: &Stamps, now: &Stamps) -> Duration {
    if now.lacks_a_file_of(before) {
        SETTLED_WITHOUT_FILE
    } else {
        SETTLED
    }
}

/// Whether a change is over, of files that have been as they are for so long, so long after the change began.
fn is_over(needed: Duration, unchanged: Duration, unrest: Duration) -> bool {
    unchanged >= needed || unrest >= LONGEST_UNREST
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Loader;

    #[test]
    fn files_are_read_when_they_rest_and_a_missing_one_is_waited_for() {
        let ms = Duration::from_millis;
        let folder = tempfile::tempdir().unwrap();
        let job = folder.path().join("rib.vcut");
        std::fs::write(&job, "one").unwrap();
        let name = job.to_str().unwrap();
        let disk = Disk::around(name);
        let recorder = Recorder::new(&disk);
        recorder.load(name).unwrap();
        let before = recorder.stamps();
        std::fs::write(&job, "two and more").unwrap();
        assert_eq!(needed(&before, &before.now()), ms(10));
        std::fs::remove_file(&job).unwrap();
        assert_eq!(needed(&before, &before.now()), ms(400));

        assert!(!is_over(ms(10), ms(9), ms(1999)));
        assert!(is_over(ms(10), ms(10), ms(10)));
        assert!(!is_over(ms(400), ms(399), ms(399)));
        // Without rest, too, they are read some time.
        assert!(is_over(ms(400), ms(0), ms(2000)));
    }
}
