//! One question to one process: bounded in time and in the size of the reply, whatever the program does.
//!
//! The three pipes are served by a thread each, so that a program which writes before it has read everything, or never reads,
//! does not block the compiler. The threads are not waited for: a child of the program that keeps a pipe open
//! must not keep the compiler.

use super::fault::{fault, last_lines};
use std::io::{self, ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};
use vcutc_backend_api::backend::Fault;

/// What a program may take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Time from its start to its end.
    pub(super) time: Duration,
    /// Bytes of its reply.
    pub(super) reply: usize,
}

/// So much of the end of standard error is kept, in bytes.
const MOST_SAID: usize = 4096;

/// How long what a program said is waited for when it has ended.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// How often a program that another process is just writing is started again.
const MOST_STARTS: u32 = 25;

/// Between two looks whether something has happened.
const PAUSE: Duration = Duration::from_millis(4);

/// What a pipe gave.
enum Heard {
    /// All of standard output.
    Reply(Vec<u8>),
    /// More on standard output than is read.
    TooMuch,
    /// The end of standard error.
    Said(Vec<u8>),
}

/// Starts a program, writes the question to its standard input, and returns what it wrote to its standard output.
///
/// # Errors
/// What the program did instead, with the end of what it wrote to standard error.
pub(super) fn ask(program: &Path, question: Vec<u8>, limits: Limits) -> Result<Vec<u8>, Fault> {
    let started = Instant::now();
    let mut child = start(program)?;
    let (sender, receiver) = channel();
    if let Some(mut stdin) = child.stdin.take() {
        // A program that does not read the question to its end may still answer.
        thread::spawn(move || stdin.write_all(&question));
    }
    if let Some(stdout) = child.stdout.take() {
        let sender = sender.clone();
        thread::spawn(move || sender.send(reply(stdout, limits.reply)));
    }
    if let Some(stderr) = child.stderr.take() {
        thread::spawn(move || sender.send(Heard::Said(end_of(stderr))));
    }
    let mut conversation = Conversation {
        child,
        receiver,
        said: Vec::new(),
        limits,
        started,
    };
    conversation.finish()
}

/// A program at work.
struct Conversation {
    child: Child,
    receiver: Receiver<Heard>,
    said: Vec<u8>,
    limits: Limits,
    started: Instant,
}

impl Conversation {
    fn finish(&mut self) -> Result<Vec<u8>, Fault> {
        let reply = self.reply();
        let end = match &reply {
            Ok(_) => self.end(),
            Err(_) => None,
        };
        // Whatever it did: what it has started may have outlived it.
        stop(&mut self.child);
        let what = match (reply, end) {
            (Ok(reply), Some(status)) if status.success() => return Ok(reply),
            (Ok(_), Some(status)) => match status.code() {
                Some(code) => format!("ended with exit status {code}"),
                None => format!("was stopped ({status})"),
            },
            (Ok(_), None) => self.late(),
            (Err(what), _) => what,
        };
        self.last_words();
        Err(Fault {
            said: last_lines(&self.said),
            ..fault(what)
        })
    }

    fn late(&self) -> String {
        let seconds = self.limits.time.as_secs();
        format!("did not finish within {seconds} s; `--backend-timeout` gives it more time")
    }

    fn left(&self) -> Duration {
        self.limits.time.saturating_sub(self.started.elapsed())
    }

    /// All of standard output.
    fn reply(&mut self) -> Result<Vec<u8>, String> {
        loop {
            match self.receiver.recv_timeout(self.left()) {
                Ok(Heard::Reply(reply)) => return Ok(reply),
                Ok(Heard::TooMuch) => {
                    return Err(format!("answers more than {} bytes", self.limits.reply));
                }
                Ok(Heard::Said(said)) => self.said = said,
                Err(_) => return Err(self.late()),
            }
        }
    }

    /// How it ended; none when its time is over first.
    fn end(&mut self) -> Option<ExitStatus> {
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) if self.left() > Duration::ZERO => thread::sleep(PAUSE),
                Ok(None) | Err(_) => return None,
            }
        }
    }

    fn last_words(&mut self) {
        if self.said.is_empty()
            && let Ok(Heard::Said(said)) = self.receiver.recv_timeout(LAST_WORDS)
        {
            self.said = said;
        }
    }
}

fn start(program: &Path) -> Result<Child, Fault> {
    let mut command = Command::new(program);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    apart(&mut command);
    let mut starts = 1;
    loop {
        match command.spawn() {
            Ok(child) => return Ok(child),
            Err(error) if error.kind() == ErrorKind::ExecutableFileBusy && starts < MOST_STARTS => {
                starts += 1;
                thread::sleep(PAUSE);
            }
            Err(error) => return Err(fault(not_started(program, &error))),
        }
    }
}

fn not_started(program: &Path, error: &io::Error) -> String {
    let advice = match error.kind() {
        ErrorKind::PermissionDenied => format!("; make it executable with `chmod +x {}`", program.display()),
        ErrorKind::NotFound => "; does the program in its first line (`#!`) exist?".to_owned(),
        _ => "; a script begins with a line such as `#!/usr/bin/env python3`".to_owned(),
    };
    format!("cannot be started: {error}{advice}")
}

/// With its own children in a group of processes, so that all of them can be stopped together.
#[cfg(unix)]
fn apart(command: &mut Command) {
    use std::os::unix::process::CommandExt;
    command.process_group(0);
}

#[cfg(not(unix))]
fn apart(_command: &mut Command) {}

/// Stops a program and, where there are groups of processes, its children, also those of a program that has ended: its
/// number stays that of the group as long as one of them is left. The standard library signals single processes only, so the
/// group is left to the command that every Unix has.
fn stop(child: &mut Child) {
    if cfg!(unix) {
        let group = format!("-{}", child.id());
        let mut kill = Command::new("kill");
        kill.args(["-KILL", "--", &group]);
        kill.stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        // Without that command the program itself is stopped below.
        let _ = kill.status();
    }
    let _ = child.kill();
    let _ = child.wait();
}

fn reply(stdout: impl Read, most: usize) -> Heard {
    let mut bytes = Vec::new();
    let limit = u64::try_from(most).unwrap_or(u64::MAX).saturating_add(1);
    // What came before an error is judged by its form, like any reply.
    let _ = stdout.take(limit).read_to_end(&mut bytes);
    if bytes.len() > most {
        Heard::TooMuch
    } else {
        Heard::Reply(bytes)
    }
}

/// The end of a stream that may have any length.
fn end_of(mut stream: impl Read) -> Vec<u8> {
    let mut kept = Vec::new();
    let mut chunk = [0; MOST_SAID];
    while let Ok(read @ 1..) = stream.read(&mut chunk) {
        kept.extend_from_slice(chunk.get(..read).unwrap_or_default());
        let surplus = kept.len().saturating_sub(MOST_SAID);
        kept.drain(..surplus);
    }
    kept
}
