//! What the compiler is doing just now, and how long each stage took.
//!
//! Most jobs are done before anybody could read a word, so a progress line appears only when a run takes longer than
//! [`PATIENCE`], with the time that has passed. Where standard error is not a terminal, `--verbose` prints a line for every
//! stage that takes longer than [`LONG`]. Both are drawn by a thread of its own; the pipeline only says which stage begins.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, Write};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};
use vcutc_driver::Stage;

/// How long a run may take before a progress line appears.
const PATIENCE: Duration = Duration::from_secs(1);
/// How long help with a refusal may take before the line says what the job is refused for.
const PATIENCE_WITH_A_REFUSAL: Duration = Duration::from_millis(300);
/// How long a stage may take before a line that stays is printed for it.
const LONG: Duration = Duration::from_secs(5);
/// How often the progress line moves.
const TICK: Duration = Duration::from_millis(100);

/// How a run is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Following {
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
            line.send(Event::Stage(stage));
        }
    }

    /// The job is refused, and help is looked for.
    pub(super) fn refused(&self, headline: &str) {
        if let Some(line) = &self.line {
            line.send(Event::Refused(headline.to_owned()));
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

/// What the line shows.
enum Event {
    Stage(Stage),
    /// The job is refused, with this headline.
    Refused(String),
}

/// The line on the terminal; vanishes when dropped.
struct ProgressLine {
    events: Option<Sender<Event>>,
    thread: Option<JoinHandle<()>>,
}

impl ProgressLine {
    fn start(follow: fn(&Receiver<Event>)) -> Self {
        let (events, receiver) = mpsc::channel();
        Self {
            events: Some(events),
            thread: Some(thread::spawn(move || follow(&receiver))),
        }
    }

    fn send(&self, event: Event) {
        if let Some(events) = &self.events {
            // Without a line there is nothing to show it on.
            let _ = events.send(event);
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        // The closed channel ends the thread, which clears the line before it goes.
        self.events = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn draw(events: &Receiver<Event>) {
    let start = Instant::now();
    let mut shown = Shown {
        stage: Stage::Reading,
        headline: None,
    };
    if wait_patiently(events, &mut shown).is_none() {
        return;
    }
    let line = ProgressBar::new_spinner().with_elapsed(start.elapsed());
    // The template is ours and right; a spinner without the time would do too.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} ({elapsed})") {
        line.set_style(style);
    }
    line.enable_steady_tick(TICK);
    line.set_message(shown.words());
    while let Ok(event) = events.recv() {
        shown.take(event);
        line.set_message(shown.words());
    }
    line.finish_and_clear();
}

/// A line for every stage that takes long, as soon as it has.
fn print(events: &Receiver<Event>) {
    let start = Instant::now();
    let mut shown = Shown {
        stage: Stage::Reading,
        headline: None,
    };
    let mut is_printed = false;
    loop {
        let next = if is_printed {
            events.recv().map_err(|_| RecvTimeoutError::Disconnected)
        } else {
            events.recv_timeout(LONG)
        };
        match next {
            Ok(event) => {
                shown.take(event);
                is_printed = false;
            }
            Err(RecvTimeoutError::Timeout) => {
                let passed = start.elapsed().as_secs();
                // The answer still comes when standard error is closed.
                let _ = writeln!(io::stderr(), "{} ({passed} s so far)", shown.words());
                is_printed = true;
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// What the line says.
struct Shown {
    stage: Stage,
    /// What the job is refused for.
    headline: Option<String>,
}

/// Most letters of a headline on the line: it must not break.
const MOST_LETTERS: usize = 60;

impl Shown {
    fn take(&mut self, event: Event) {
        match event {
            Event::Stage(stage) => self.stage = stage,
            Event::Refused(headline) => {
                let mut short: String = headline.chars().take(MOST_LETTERS).collect();
                if short.len() < headline.len() {
                    short.push_str("...");
                }
                self.headline = Some(short);
            }
        }
    }

    fn words(&self) -> String {
        let stage = words(self.stage);
        match &self.headline {
            Some(headline) => format!("error: {headline}; {stage}"),
            None => stage.to_owned(),
        }
    }
}

/// Waits until patience ends; none when the run ends before. The wait is shorter once the job is refused.
fn wait_patiently(events: &Receiver<Event>, shown: &mut Shown) -> Option<()> {
    let start = Instant::now();
    let mut until = start + PATIENCE;
    loop {
        match events.recv_timeout(until.saturating_duration_since(Instant::now())) {
            Ok(event) => {
                if matches!(event, Event::Refused(_)) {
                    until = until.min(Instant::now() + PATIENCE_WITH_A_REFUSAL);
                }
                shown.take(event);
            }
            Err(RecvTimeoutError::Timeout) => return Some(()),
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
        Stage::Helping => "helping",
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
        Stage::Helping => "looking for a fix",
        Stage::Optimising => "solving for other parameters",
        Stage::Emitting => "writing the program",
        Stage::Verifying => "comparing the program with the job",
    }
}
