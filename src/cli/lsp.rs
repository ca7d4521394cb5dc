//! `vcutc lsp`: messages between standard input, the language server, and a thread that plans.
//!
//! Messages are taken in the order in which they come. When none waits, what has changed is checked and reported; when nothing
//! changes for a moment, a job that is right so far goes to the thread that plans, one at a time. A job whose text changes
//! meanwhile is planned no further.

use super::Targets;
use super::console::{Console, Failure};
use super::files::{list_folder, load_bounded, load_file, with_forward_slashes};
use super::patience::{HelpBudget, Waiting};
use serde_json::Value;
use std::collections::VecDeque;
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};
use vcutc_backend_api::backend::Backend;
use vcutc_diagnostics::source::{Entry, LoadError, Loader};
use vcutc_driver::memory::Memory;
use vcutc_lsp::wire::{self, Broken, Fault, Incoming};
use vcutc_lsp::{Done, Ending, Server, Task, Workspace};
use vcutc_registry::OPERATIONS;

/// How long no message, such as a change of a text, must have come before a job is planned. Requests do not
/// delay it.
const PAUSE: Duration = Duration::from_millis(250);

/// How long help with a refused job is looked for. Typing ends it sooner.
const HELP_BUDGET: HelpBudget = HelpBudget::Of(Duration::from_secs(5));

/// Something that the server has to look at.
enum Event {
    Message(Incoming),
    Broken(Broken),
    Planned(Box<Done>),
    /// What a job is refused for; help is still looked for.
    Refused(Box<Done>),
}

/// Whether a job is being planned.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Planner {
    Idle,
    Busy,
}

/// Serves an editor until it says good-bye. By the protocol the end is 0 if it did so as agreed, and else 1.
pub(super) fn serve(targets: &Targets, console: &Console) -> ExitCode {
    let (sender, events) = channel();
    let tasks = planner(targets.to_vec(), sender.clone());
    thread::spawn(move || read_all(&sender));
    let mut conversation = Conversation {
        server: Server::new(OPERATIONS, targets),
        waiting: VecDeque::new(),
        tasks,
        planner: Planner::Idle,
        last_message: Instant::now(),
        console,
    };
    match conversation.hold(&events) {
        Ok(Ending::Agreed) => ExitCode::SUCCESS,
        Ok(Ending::Abrupt) => ExitCode::from(1),
        Err(why) => {
            console.failure(&Failure::new(format!("the conversation cannot continue: {why}")));
            ExitCode::from(1)
        }
    }
}

/// Reads messages for as long as there are any.
fn read_all(events: &Sender<Event>) {
    let mut stream = BufReader::new(io::stdin());
    loop {
        let event = match wire::read(&mut stream) {
            Ok(message) => Event::Message(message),
            Err(broken) => Event::Broken(broken),
        };
        let is_last = matches!(event, Event::Broken(_));
        if events.send(event).is_err() || is_last {
            return;
        }
    }
}

/// A thread that plans what it is given.
fn planner(targets: Vec<&'static dyn Backend>, events: Sender<Event>) -> Sender<Task> {
    let (tasks, given) = channel::<Task>();
    thread::spawn(move || {
        let mut memory = Memory::of_some_runs();
        for task in given {
            let mut waiting = Waiting::unseen(HELP_BUDGET);
            let mut report = |refused: Done| {
                // A receiver that is gone gets nothing more.
                let _ = events.send(Event::Refused(Box::new(refused)));
            };
            let done = task.run_reporting(&Disk, &targets, &mut memory, (&mut waiting, &mut report));
            if events.send(Event::Planned(Box::new(done))).is_err() {
                return;
            }
        }
    });
    tasks
}

struct Conversation<'c> {
    server: Server,
    /// What has come in and is still to be looked at, the oldest first.
    waiting: VecDeque<Event>,
    tasks: Sender<Task>,
    planner: Planner,
    /// When the last message came.
    last_message: Instant,
    /// Standard error, which editors keep in a log.
    console: &'c Console,
}

impl Conversation<'_> {
    /// Holds it to its end.
    fn hold(&mut self, events: &Receiver<Event>) -> io::Result<Ending> {
        loop {
            self.waiting.extend(events.try_iter());
            let event = match self.waiting.pop_front() {
                Some(event) => event,
                None => {
                    send(&self.server.settle(&Disk))?;
                    match self.wait(events) {
                        Some(event) => event,
                        None => return Ok(Ending::Abrupt),
                    }
                }
            };
            match event {
                Event::Message(message) => send(&self.answers(message))?,
                Event::Planned(done) => {
                    self.planner = Planner::Idle;
                    send(&self.server.finish(*done))?;
                }
                Event::Refused(done) => send(&self.server.finish(*done))?,
                Event::Broken(Broken::Ended) => return Ok(Ending::Abrupt),
                Event::Broken(Broken::Astray(why)) => return Err(io::Error::other(why)),
            }
            if let Some(ending) = self.server.ending() {
                return Ok(ending);
            }
        }
    }

    /// What is to be said to a message. A request that the client has taken back meanwhile is not met.
    fn answers(&mut self, message: Incoming) -> Vec<Value> {
        if let Incoming::Request { id, .. } = &message {
            let is_taken_back = self.waiting.iter().any(|event| match event {
                Event::Message(later) => later.takes_back() == Some(id),
                Event::Broken(_) | Event::Planned(_) | Event::Refused(_) => false,
            });
            if is_taken_back {
                return vec![wire::refusal(id, Fault::RequestCancelled, "taken back")];
            }
        }
        if let Incoming::Malformed { why, .. } = &message {
            let failure = Failure::new(format!("a message of the editor cannot be read: {why}"));
            self.console.failure(&failure);
        }
        if let Incoming::Notification { .. } = &message {
            self.last_message = Instant::now();
        }
        self.server.handle(message, &Disk)
    }

    /// Waits for the next event; if none comes for a moment, a job is planned meanwhile, before others the one that was changed last.
    fn wait(&mut self, events: &Receiver<Event>) -> Option<Event> {
        match events.recv_timeout(PAUSE.saturating_sub(self.last_message.elapsed())) {
            Ok(event) => return Some(event),
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) => {}
        }
        match self.planner {
            Planner::Busy => self.server.put_off(),
            Planner::Idle => {
                if let Some(task) = self.server.task() {
                    self.planner = Planner::Busy;
                    self.tasks.send(task).ok()?;
                }
            }
        }
        events.recv().ok()
    }
}

fn send(messages: &[Value]) -> io::Result<()> {
    let mut stream = io::stdout().lock();
    for message in messages {
        wire::write(&mut stream, message)?;
    }
    stream.flush()
}

/// The files of this machine.
struct Disk;

impl Loader for Disk {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        load_file(Path::new(path))
    }

    fn load_data(&self, path: &str, most: u64) -> Result<Vec<u8>, LoadError> {
        load_bounded(Path::new(path), most)
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        list_folder(folder)
    }
}

/// Most job files that are looked through for the uses of a name.
const MOST_FILES: usize = 2000;

/// Most entries of folders that are looked at on the way.
const MOST_ENTRIES: usize = 50_000;

impl Workspace for Disk {
    fn job_files(&self, folders: &[String]) -> Vec<String> {
        let mut open: Vec<PathBuf> = folders.iter().rev().map(PathBuf::from).collect();
        let mut found = Vec::new();
        let mut looked_at = 0;
        while let Some(folder) = open.pop() {
            let Ok(entries) = std::fs::read_dir(&folder) else {
                continue;
            };
            for entry in entries.flatten() {
                looked_at += 1;
                if looked_at > MOST_ENTRIES || found.len() >= MOST_FILES {
                    break;
                }
                let (path, name) = (entry.path(), entry.file_name());
                let name = name.to_string_lossy();
                // A link may lead round in a circle; hidden and built folders hold no jobs.
                match entry.file_type() {
                    Ok(kind) if kind.is_dir() && !is_passed_over(&name) => open.push(path),
                    Ok(kind) if kind.is_file() && name.ends_with(".vcut") => {
                        found.extend(path.to_str().map(with_forward_slashes));
                    }
                    Ok(_) | Err(_) => {}
                }
            }
        }
        found.sort();
        found
    }
}

fn is_passed_over(folder: &str) -> bool {
    folder.starts_with('.') || matches!(folder, "target" | "node_modules")
}
