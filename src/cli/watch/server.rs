//! The report in a browser: a server for this machine alone, with a page that is loaded again when the job
//! has changed.
//!
//! It listens on 127.0.0.1, answers `GET` and `HEAD` of two addresses, and reads no file: all it can give away is the page. Requests
//! are bounded in length and time, and so is how many are answered at once. A page asks `/changes` with its version and learns
//! of the next one by an event of the server ([HTML], section 9.2).
//!
//! [HTML]: https://html.spec.whatwg.org/multipage/server-sent-events.html

use super::request::{Asked, Extent, LONGEST_HEAD, Refused, Request, head, read};
use std::io::{self, ErrorKind, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Most requests that are answered at once: a page takes one all the time.
const MOST_AT_ONCE: usize = 24;
/// How long a request may take to arrive, and a piece of an answer to be taken.
const PATIENCE: Duration = Duration::from_secs(5);
/// How much input is read that was not asked for.
#[derive(Clone, Copy)]
struct Drained {
    /// Most pieces of a KiB.
    most: usize,
    /// How long each may take to arrive.
    each: Duration,
}

const ANSWERED: Drained = Drained {
    most: 64,
    each: Duration::from_millis(200),
};
/// Those that find no place are seen off one after the other, so none may take long.
const BUSY: Drained = Drained {
    most: 2,
    each: Duration::from_millis(50),
};
/// How often a page that waits for changes learns that nothing has changed, which shows whether it is still there.
const SIGN_OF_LIFE: Duration = Duration::from_secs(10);

/// The page and its version.
struct Shown {
    count: u64,
    page: Arc<String>,
}

/// What threads share.
struct Shared {
    /// What sets the versions of this run apart from those of another one.
    run: u64,
    port: u16,
    shown: Mutex<Shown>,
    changed: Condvar,
    answering: AtomicUsize,
}

/// A server at work.
pub(super) struct Server {
    shared: Arc<Shared>,
    address: String,
}

impl Server {
    /// Begins to listen; port 0 lets the system choose one.
    pub(super) fn start(port: u16) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let port = listener.local_addr()?.port();
        let run = SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .map_or(0, |time| time.as_secs());
        let shared = Arc::new(Shared {
            run,
            port,
            shown: Mutex::new(Shown {
                count: 0,
                page: Arc::default(),
            }),
            changed: Condvar::new(),
            answering: AtomicUsize::new(0),
        });
        let for_thread = Arc::clone(&shared);
        thread::spawn(move || listen(&listener, &for_thread));
        Ok(Self {
            shared,
            address: format!("http://127.0.0.1:{port}/"),
        })
    }

    /// Where a browser finds it.
    pub(super) fn address(&self) -> &str {
        &self.address
    }

    /// Shows the page that `make` makes for its version, and notifies all pages that wait for it.
    pub(super) fn show(&self, make: impl FnOnce(String) -> String) {
        let count = self.shared.shown().count + 1;
        let page = Arc::new(make(self.shared.version(count)));
        *self.shared.shown() = Shown { count, page };
        self.shared.changed.notify_all();
    }
}

impl Shared {
    fn shown(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn version(&self, count: u64) -> String {
        format!("{}-{count}", self.run)
    }

    /// Waits until the page is of another version, for a while. Returns that version.
    fn other_than(&self, version: &str) -> Option<String> {
        let is_the_same = |shown: &mut Shown| self.version(shown.count) == version;
        let (shown, _) = self
            .changed
            .wait_timeout_while(self.shown(), SIGN_OF_LIFE, is_the_same)
            .unwrap_or_else(PoisonError::into_inner);
        let current = self.version(shown.count);
        (current != version).then_some(current)
    }
}

/// Counts a request that is being answered, as long as it is.
struct Place<'s>(&'s AtomicUsize);

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

fn listen(listener: &TcpListener, shared: &Arc<Shared>) {
    for stream in listener.incoming() {
        // A connection that failed before it began is the other side's affair; without a pause a lack of handles would be asked
        // about again and again.
        let Ok(mut stream) = stream else {
            thread::sleep(Duration::from_millis(50));
            continue;
        };
        let is_full = shared.answering.fetch_add(1, Ordering::SeqCst) >= MOST_AT_ONCE;
        let shared = Arc::clone(shared);
        if is_full {
            let _place = Place(&shared.answering);
            let _ = stream.set_write_timeout(Some(BUSY.each));
            let _ = refuse(&mut stream, Refused::Busy).and_then(|()| drain(&mut stream, BUSY));
            continue;
        }
        thread::spawn(move || {
            let _place = Place(&shared.answering);
            // A browser that has gone away wants no answer.
            let _ = answer(stream, &shared);
        });
    }
}

fn answer(mut stream: TcpStream, shared: &Shared) -> io::Result<()> {
    stream.set_write_timeout(Some(PATIENCE))?;
    let request = match request(&mut stream)? {
        Ok(head) => read(&head, shared.port),
        Err(refused) => Err(refused),
    };
    match request {
        Err(refused) => refuse(&mut stream, refused)?,
        Ok(Request {
            asked: Asked::Page,
            extent,
        }) => page(&mut stream, extent, shared)?,
        Ok(Request {
            asked: Asked::Changes { version },
            extent,
        }) => changes(&mut stream, extent, &version, shared)?,
    }
    drain(&mut stream, ANSWERED)
}

/// Lets the other side read its answer: a connection that is closed with bytes unread is reset, and the answer with it.
fn drain(stream: &mut TcpStream, drained: Drained) -> io::Result<()> {
    stream.shutdown(Shutdown::Write)?;
    stream.set_read_timeout(Some(drained.each))?;
    let mut rest = [0; 1024];
    for _ in 0..drained.most {
        if stream.read(&mut rest)? == 0 {
            break;
        }
    }
    Ok(())
}

/// The head of a request, as far as it comes in time.
fn request(stream: &mut TcpStream) -> io::Result<Result<String, Refused>> {
    let end = Instant::now() + PATIENCE;
    let mut head = Vec::new();
    let mut piece = [0; 1024];
    loop {
        let left = end.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Ok(Err(Refused::Late));
        }
        if head.len() > LONGEST_HEAD {
            return Ok(Err(Refused::TooLong));
        }
        stream.set_read_timeout(Some(left))?;
        let length = match stream.read(&mut piece) {
            Ok(length) => length,
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                return Ok(Err(Refused::Late));
            }
            Err(error) => return Err(error),
        };
        head.extend_from_slice(piece.get(..length).unwrap_or_default());
        if let Some(at) = head.windows(4).position(|bytes| bytes == b"\r\n\r\n") {
            if at > LONGEST_HEAD {
                return Ok(Err(Refused::TooLong));
            }
            head.truncate(at);
            return Ok(String::from_utf8(head).map_err(|_| Refused::Malformed));
        }
        if length == 0 {
            return Ok(Err(Refused::Malformed));
        }
    }
}

fn refuse(stream: &mut TcpStream, refused: Refused) -> io::Result<()> {
    let body = format!("{}\n", refused.status());
    let head = head(refused.status(), "text/plain; charset=utf-8", Some(body.len()));
    stream.write_all((head + &body).as_bytes())
}

fn page(stream: &mut TcpStream, extent: Extent, shared: &Shared) -> io::Result<()> {
    let page = Arc::clone(&shared.shown().page);
    stream.write_all(head("200 OK", "text/html; charset=utf-8", Some(page.len())).as_bytes())?;
    match extent {
        Extent::Whole => stream.write_all(page.as_bytes()),
        Extent::Head => Ok(()),
    }
}

fn changes(stream: &mut TcpStream, extent: Extent, version: &str, shared: &Shared) -> io::Result<()> {
    stream.write_all(head("200 OK", "text/event-stream", None).as_bytes())?;
    match extent {
        Extent::Head => return Ok(()),
        Extent::Whole => {}
    }
    loop {
        if let Some(next) = shared.other_than(version) {
            return stream.write_all(format!("data: {next}\n\n").as_bytes());
        }
        stream.write_all(b":\n\n")?;
    }
}
