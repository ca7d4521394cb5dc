//! `vcutc watch JOB`: the job is compiled again whenever one of its files changes.
//!
//! Its files are those that the compiler asked for, found or not. After a change it waits until they stay as they are for a
//! moment: editors save in several steps. A change while the job is being compiled ends that run: its result
//! is not needed any more. Programs are written as `vcutc JOB --target` does; with `--serve` the report is
//! shown in a browser, which loads it again by itself.

mod again;
mod request;
mod server;
mod signals;
mod stamps;

use super::args::WatchArgs;
use super::console::{Console, Failure};
use super::{Exit, Targets};
use again::{Came, Means, Seen, Watched};
use serde::Serialize;
use server::Server;
use signals::{Attended, Signals, Woken};
use stamps::{Asked, Stamps};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use vcutc_backend_api::words::counted;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::render::{ColorChoice, render};
use vcutc_driver::memory::Memory;
use vcutc_report::page::{Content, Further, Served, served_errors, served_page};

/// How long after a program could not be written that is tried again.
const FIRST_RETRY: Duration = Duration::from_secs(1);
/// Longest time between two tries; each is twice as long as the one before.
const LONGEST_RETRY: Duration = Duration::from_secs(30);

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
    match prepare(args, targets).and_then(|watch| Ok((watch, Signals::listen()?))) {
        Ok((watch, signals)) => watch.run(&signals, console),
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
            "it is not a file"
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
    Ok(Watch {
        watched,
        server,
        last: Mutex::default(),
    })
}

fn no_server(port: u16, error: &std::io::Error) -> Failure {
    Failure::new(format!("cannot listen on 127.0.0.1:{port}: {error}"))
        .help("give another port with `--serve PORT`; with 0 the system chooses one")
}

struct Watch<'a> {
    watched: Watched<'a>,
    server: Option<Server>,
    /// What the last run without errors showed.
    last: Mutex<Option<Content>>,
}

/// A run, and the files that it asked for.
struct Run {
    came: Came,
    attended: Attended,
    stamps: Stamps,
    time: Duration,
}

impl Watch<'_> {
    fn run(&self, signals: &Signals, console: &Console) -> Exit {
        let mut memory = Memory::of_some_runs();
        let mut answered = Instant::now();
        loop {
            console.clear_screen();
            let Run {
                came,
                attended,
                stamps,
                time,
            } = self.once(signals, answered, &mut memory, console);
            match &came {
                Came::Needless => {}
                Came::Reported | Came::Unwritten(_) => {
                    answered = Instant::now();
                    self.report_done(&stamps, time, console);
                }
            }
            if attended == Attended::Interrupted || console.is_unheard() {
                return Exit::Success;
            }
            match self.wait(came, &stamps, signals, console) {
                Attended::Ended => {}
                Attended::Interrupted => return Exit::Success,
            }
        }
    }

    /// Compiles the job and hands the page on, as long as its files stay as they are.
    fn once(&self, signals: &Signals, answered: Instant, memory: &mut Memory, console: &Console) -> Run {
        let start = Instant::now();
        let asked = Asked::default();
        let (wanted, interest) = Wanted::while_held();
        let (came, attended) = thread::scope(|scope| {
            let bell = signals.bell();
            let (asked, wanted) = (&asked, &wanted);
            let run = scope.spawn(move || {
                let _bell = bell;
                let means = Means {
                    asked,
                    memory,
                    wanted,
                    console,
                };
                self.watched.run(means, &|seen| self.show(seen))
            });
            let attended = signals.attend(interest, asked, answered);
            let came = run
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            (came, attended)
        });
        Run {
            came,
            attended,
            stamps: asked.stamps(),
            time: start.elapsed(),
        }
    }

    /// Waits for a change, and meanwhile tries to write what could not be written.
    fn wait(&self, came: Came, stamps: &Stamps, signals: &Signals, console: &Console) -> Attended {
        let mut came = came;
        let mut pause = FIRST_RETRY;
        loop {
            let most = match &came {
                Came::Reported => None,
                // What overtook it may have been taken back: it still needs an answer.
                Came::Needless => Some(Duration::ZERO),
                Came::Unwritten(_) => Some(pause),
            };
            match signals.changed(stamps, most) {
                Woken::Changed => return Attended::Ended,
                Woken::Interrupted => return Attended::Interrupted,
                Woken::Due => {}
            }
            let Came::Unwritten(unwritten) = came else {
                return Attended::Ended;
            };
            pause = (pause * 2).min(LONGEST_RETRY);
            let start = Instant::now();
            came = self
                .watched
                .write_again(unwritten, console, &|seen| self.show(seen));
            if let Came::Reported = &came {
                self.report_done(stamps, start.elapsed(), console);
            }
        }
    }

    fn show(&self, seen: &Seen<'_>) {
        let Some(server) = &self.server else { return };
        let job = self.watched.job();
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        server.show(|version| match seen {
            Seen::Unreadable(failure) => {
                let message = format!("{}\n", failure.message());
                served_errors(job, &message, last.as_ref(), &Served::new(version))
            }
            Seen::Outcome(outcome, trouble) => {
                let served = match trouble {
                    None => Served::new(version),
                    Some(failure) => Served::with_trouble(version, failure.message()),
                };
                match Content::of(outcome, Further::NOTHING) {
                    Some(content) => served_page(last.insert(content), &served),
                    None => {
                        let messages = render(&outcome.diagnostics, &outcome.sources, ColorChoice::Colored);
                        served_errors(job, &messages, last.as_ref(), &served)
                    }
                }
            }
        });
    }

    fn report_done(&self, stamps: &Stamps, time: Duration, console: &Console) {
        let address = self.server.as_ref().map(Server::address);
        let files = counted(stamps.count(), "file");
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
