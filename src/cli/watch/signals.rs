//! What wakes a watch: the user who wants it to end, a run that is over, a file that has changed.

use super::stamps::{Asked, Pause, Stamps};
use crate::cli::console::Failure;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};
use vcutc_cancellation::Interest;

/// How long files must stay as they are before they are read.
const SETTLED: Duration = Duration::from_millis(10);
/// The same while one of them is missing: some editors take a file away before they put the new one in its place.
const SETTLED_WITHOUT_FILE: Duration = Duration::from_millis(400);
/// Files that keep changing are still read after so long.
const LONGEST_UNREST: Duration = Duration::from_secs(2);
/// After so long without an answer a change does not end a run any more: files that change all the time get
/// an answer, too.
const LONGEST_SILENCE: Duration = Duration::from_secs(30);

/// Something that does not come from files.
enum Event {
    /// The user wants to end.
    Interrupted,
    /// A run is over.
    Ended,
}

/// Ears for all that.
pub(super) struct Signals {
    events: Receiver<Event>,
    sender: Sender<Event>,
    is_busy: Arc<AtomicBool>,
}

/// Reports the end of a run when it is dropped, so that no run ends unnoticed.
pub(super) struct Bell {
    sender: Sender<Event>,
    is_busy: Arc<AtomicBool>,
}

/// What became of a run, seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Attended {
    /// The watch continues.
    Ended,
    /// The user wants to end.
    Interrupted,
}

/// What became of waiting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Woken {
    /// A file has changed, and all stay as they are.
    Changed,
    /// Nothing has changed in the time that was given.
    Due,
    /// The user wants to end.
    Interrupted,
}

impl Signals {
    /// Listens for Ctrl-C and for requests to end. The first one ends a run before it writes, or lets it finish writing, so that
    /// no file is left under a passing name; the second one ends at once.
    pub(super) fn listen() -> Result<Self, Failure> {
        let (sender, events) = mpsc::channel();
        let is_busy = Arc::new(AtomicBool::new(false));
        let busy = Arc::clone(&is_busy);
        let was_asked = AtomicBool::new(false);
        let interrupts = sender.clone();
        let on_signal = move || {
            let is_second = was_asked.swap(true, Ordering::SeqCst);
            let is_waiting = interrupts.send(Event::Interrupted).is_ok();
            if !is_waiting || (is_second && busy.load(Ordering::SeqCst)) {
                std::process::exit(130);
            }
        };
        ctrlc::set_handler(on_signal)
            .map_err(|error| Failure::new(format!("cannot listen for Ctrl-C: {error}")))?;
        Ok(Self {
            events,
            sender,
            is_busy,
        })
    }

    /// The bell of a run that begins.
    pub(super) fn bell(&self) -> Bell {
        self.is_busy.store(true, Ordering::SeqCst);
        Bell {
            sender: self.sender.clone(),
            is_busy: Arc::clone(&self.is_busy),
        }
    }

    /// Follows a run to its end. The interest in it is lost when a file that it asked for changes, unless the last answer is
    /// too long ago, and when the user wants to end.
    pub(super) fn attend(&self, interest: Interest, asked: &Asked, answered: Instant) -> Attended {
        let mut interest = Some(interest);
        let mut attended = Attended::Ended;
        let mut pause = Pause::new();
        loop {
            match self.events.recv_timeout(pause.length()) {
                Ok(Event::Ended) => return attended,
                Ok(Event::Interrupted) | Err(RecvTimeoutError::Disconnected) => {
                    interest = None;
                    attended = Attended::Interrupted;
                }
                Err(RecvTimeoutError::Timeout) => {
                    if interest.is_some() && may_be_given_up(answered.elapsed()) {
                        let stamps = asked.stamps();
                        interest = interest.filter(|_| pause.look(&stamps) == stamps);
                    }
                }
            }
        }
    }

    /// Waits for a change, at most for so long if that is given.
    pub(super) fn changed(&self, stamps: &Stamps, most: Option<Duration>) -> Woken {
        let start = Instant::now();
        let mut pause = Pause::new();
        loop {
            if self.is_interrupted_within(pause.length()) {
                return Woken::Interrupted;
            }
            let now = pause.look(stamps);
            if now != *stamps {
                return self.settled(stamps, now, pause);
            }
            if most.is_some_and(|most| start.elapsed() >= most) {
                return Woken::Due;
            }
        }
    }

    /// Waits until files that have changed stay as they are.
    fn settled(&self, before: &Stamps, first: Stamps, mut pause: Pause) -> Woken {
        let start = Instant::now();
        let mut last = first;
        let mut since = start;
        loop {
            if is_over(needed(before, &last), since.elapsed(), start.elapsed()) {
                return Woken::Changed;
            }
            if self.is_interrupted_within(pause.length()) {
                return Woken::Interrupted;
            }
            let now = pause.look(before);
            if now != last {
                last = now;
                since = Instant::now();
            }
        }
    }

    fn is_interrupted_within(&self, length: Duration) -> bool {
        match self.events.recv_timeout(length) {
            Ok(Event::Interrupted) | Err(RecvTimeoutError::Disconnected) => true,
            // No run is under way while a change is waited for.
            Ok(Event::Ended) | Err(RecvTimeoutError::Timeout) => false,
        }
    }
}

impl Drop for Bell {
    fn drop(&mut self) {
        self.is_busy.store(false, Ordering::SeqCst);
        // Without a receiver there is nothing to report to.
        let _ = self.sender.send(Event::Ended);
    }
}

/// Whether a run may be given up for a change, so long after the last answer.
fn may_be_given_up(silence: Duration) -> bool {
    silence < LONGEST_SILENCE
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
    use super::super::stamps::Recorder;
    use super::*;
    use crate::cli::files::Disk;
    use vcutc_diagnostics::source::Loader;

    #[test]
    fn files_are_read_when_they_rest_and_a_missing_one_is_waited_for() {
        let ms = Duration::from_millis;
        let folder = tempfile::tempdir().unwrap();
        let job = folder.path().join("rib.vcut");
        std::fs::write(&job, "one").unwrap();
        let name = job.to_str().unwrap();
        let (disk, asked) = (Disk::around(name), Asked::default());
        Recorder::new(&disk, &asked).load(name).unwrap();
        let before = asked.stamps();
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

    #[test]
    fn what_changes_all_the_time_is_answered_some_time() {
        assert!(may_be_given_up(Duration::ZERO));
        assert!(may_be_given_up(Duration::from_millis(29_999)));
        assert!(!may_be_given_up(Duration::from_secs(30)));
    }
}
