//! What the compiler is doing just now, and how long each stage took.
//!
//! Most jobs are done before anybody could read a word, so a progress line appears only when a run takes longer than
//! [`PATIENCE`], with the time that has passed. Where standard error is not a terminal, `--verbose` prints a line for every
//! stage that takes longer than [`LONG`]. Both are drawn by a thread of its own; the pipeline only says which stage begins.

use crate::driver::Stage;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, Write};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How long a run may take before a progress line appears.
const PATIENCE: Duration = Duration::from_secs(1);
/// How long a stage may take before a line that stays is printed for it.
const LONG: Duration = Duration::from_secs(5);
/// How often the progress line moves.
const TICK: Duration = Duration::from_millis(100);

/// How a run is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Following {
    /// Not at all.
    Silent,
    /// By a line on a terminal that vanishes at the end.
    PassingLine,
    /// By lines that stay.
    Lines,
}

/// Follows a run through its stages.
pub(super) struct Progress {
    line: Option<ProgressLine>,
    running: Option<(Stage, Instant)>,
    timings: Vec<(&'static str, Duration)>,
}

impl Progress {
    /// Follows a run.
    pub(super) fn start(following: Following) -> Self {
        let line = match following {
            Following::Silent => None,
            Following::PassingLine => Some(ProgressLine::start(draw)),
            Following::Lines => Some(ProgressLine::start(print)),
        };
        Self {
            line,
            running: None,
            timings: Vec::new(),
        }
    }

    /// A stage begins, and the one before it is over.
    pub(super) fn enter(&mut self, stage: Stage) {
        self.leave();
        self.running = Some((stage, Instant::now()));
        if let Some(line) = &self.line {
            line.show(stage);
        }
    }

    /// The run is over: the line vanishes. Returns the stages with the time each took.
    pub(super) fn finish(mut self) -> Vec<(&'static str, Duration)> {
        self.leave();
        self.timings
    }

    fn leave(&mut self) {
        let Some((stage, since)) = self.running.take() else {
            return;
        };
        // A plan that the machine does not follow sends the run back to an earlier stage.
        let stage = name(stage);
        match self.timings.iter_mut().find(|(earlier, _)| *earlier == stage) {
            Some((_, time)) => *time += since.elapsed(),
            None => self.timings.push((stage, since.elapsed())),
        }
    }
}

/// The line on the terminal; vanishes when dropped.
struct ProgressLine {
    stages: Option<Sender<Stage>>,
    thread: Option<JoinHandle<()>>,
}

impl ProgressLine {
    fn start(tell: fn(&Receiver<Stage>)) -> Self {
        let (stages, receiver) = mpsc::channel();
        Self {
            stages: Some(stages),
            thread: Some(thread::spawn(move || tell(&receiver))),
        }
    }

    fn show(&self, stage: Stage) {
        if let Some(stages) = &self.stages {
            // Without a line there is nothing to show it on.
            let _ = stages.send(stage);
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        // The closed channel ends the thread, which clears the line before it goes.
        self.stages = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn draw(stages: &Receiver<Stage>) {
    let start = Instant::now();
    let Some(stage) = wait_patiently(stages) else {
        return;
    };
    let line = ProgressBar::new_spinner().with_elapsed(start.elapsed());
    // The template is ours and right; a spinner without the time would do too.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} ({elapsed})") {
        line.set_style(style);
    }
    line.enable_steady_tick(TICK);
    line.set_message(words(stage));
    while let Ok(stage) = stages.recv() {
        line.set_message(words(stage));
    }
    line.finish_and_clear();
}

/// A line for every stage that takes long, as soon as it has.
fn print(stages: &Receiver<Stage>) {
    let start = Instant::now();
    let mut stage = Stage::Reading;
    let mut is_told = false;
    loop {
        let next = if is_told {
            stages.recv().map_err(|_| RecvTimeoutError::Disconnected)
        } else {
            stages.recv_timeout(LONG)
        };
        match next {
            Ok(next) => (stage, is_told) = (next, false),
            Err(RecvTimeoutError::Timeout) => {
                let passed = start.elapsed().as_secs();
                // Whoever stops reading has the answer to come all the same.
                let _ = writeln!(io::stderr(), "{} ({passed} s so far)", words(stage));
                is_told = true;
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// The stage at work when patience ends; none when the run ends before.
fn wait_patiently(stages: &Receiver<Stage>) -> Option<Stage> {
    let start = Instant::now();
    let mut stage = Stage::Reading;
    loop {
        match stages.recv_timeout(PATIENCE.saturating_sub(start.elapsed())) {
            Ok(next) => stage = next,
            Err(RecvTimeoutError::Timeout) => return Some(stage),
            Err(RecvTimeoutError::Disconnected) => return None,
        }
    }
}

const fn name(stage: Stage) -> &'static str {
    match stage {
        Stage::Reading => "reading",
        Stage::Planning => "planning",
        Stage::Proving => "proving",
        Stage::Reaching => "reaching",
        Stage::Placing => "placing",
        Stage::Optimising => "optimising",
        Stage::Emitting => "emitting",
        Stage::Verifying => "verifying",
    }
}

const fn words(stage: Stage) -> &'static str {
    match stage {
        Stage::Reading => "reading the job",
        Stage::Planning => "choosing the cuts",
        Stage::Proving => "proving that every chip comes free and no cut enters the part",
        Stage::Reaching => "proving that the machine reaches every pose at speed",
        Stage::Placing => "searching for the best place of the work",
        Stage::Optimising => "solving for other parameters",
        Stage::Emitting => "writing the program",
        Stage::Verifying => "comparing the program with the job",
    }
}
