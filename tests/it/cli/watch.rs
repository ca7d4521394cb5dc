//! `vcutc watch` as a process: jobs are edited while it runs, in the ways of editors, and its page is asked for.

use super::jobs::RIB;
use super::{command, folder};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How long anything may take on a machine that has much else to do.
const LIMIT: Duration = Duration::from_secs(120);

/// A running watch, and the lines it has printed.
pub(crate) struct Watch {
    folder: TempDir,
    child: Child,
    lines: Receiver<String>,
}

impl Watch {
    pub(crate) fn start(more: &[&str]) -> Self {
        let folder = folder();
        let path = folder.path();
        fs::write(
            path.join("rib.vcut"),
            format!("use \"size.vcut\"\n{}", RIB.replace("let width = 40 mm\n", "")),
        )
        .unwrap();
        fs::write(path.join("size.vcut"), "let width = 40 mm\n").unwrap();
        let arguments = [&["watch", "rib.vcut", "--target", "krl", "-o", "out"], more].concat();
        let mut command = command(path, &arguments);
        let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
        let stderr = BufReader::new(child.stderr.take().unwrap());
        let (sender, lines) = channel();
        thread::spawn(move || {
            for line in stderr.lines().map_while(Result::ok) {
                let _ = sender.send(line);
            }
        });
        Self { folder, child, lines }
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The lines up to one that holds this.
    fn until(&self, wanted: &str) -> Vec<String> {
        let mut found = Vec::new();
        loop {
            let line = self.lines.recv_timeout(LIMIT);
            found.push(line.unwrap_or_else(|_| panic!("no {wanted:?} in {found:#?}")));
            if found.last().unwrap().contains(wanted) {
                return found;
            }
        }
    }

    /// Waits for a run that tells this, until it is over, and gives what it told. Runs before it are passed over: the system may
    /// let a file be seen half written.
    fn told(&self, wanted: &str) -> String {
        let mut told = self.until(wanted);
        if !wanted.contains("watching") {
            told.extend(self.until("watching"));
        }
        told.join("\n")
    }

    /// The address under which it shows its page, when it has compiled for the first time.
    pub(crate) fn address(&self) -> String {
        let told = self.told("watching");
        let (_, rest) = told.split_once("http://").unwrap();
        rest.split('/').next().unwrap().to_owned()
    }

    fn program(&self) -> String {
        fs::read_to_string(self.path().join("out/rib.src")).unwrap()
    }

    fn interrupt(mut self) -> Option<i32> {
        let id = self.child.id().to_string();
        let killed = Command::new("kill").args(["-INT", &id]).status().unwrap();
        assert!(killed.success());
        let start = Instant::now();
        while start.elapsed() < LIMIT {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            thread::sleep(Duration::from_millis(10));
        }
        panic!("the watch does not end");
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn programs_follow_their_job_and_its_files() {
    let watch = Watch::start(&[]);
    watch.told("watching 2 files");
    let first = watch.program();

    // A file that the job uses, written in place.
    fs::write(watch.path().join("size.vcut"), "let width = 44 mm\n").unwrap();
    watch.told("wrote");
    let second = watch.program();
    assert_ne!(first, second);

    // The same, renamed over it.
    fs::write(watch.path().join("size.new"), "let width = 40 mm\n").unwrap();
    fs::rename(watch.path().join("size.new"), watch.path().join("size.vcut")).unwrap();
    watch.told("wrote");
    assert_eq!(watch.program(), first);

    // A comment changes nothing, and nothing is written.
    fs::write(watch.path().join("size.vcut"), "let width = 40 mm // as ever\n").unwrap();
    let told = watch.told("unchanged");
    assert!(!told.contains("wrote"), "{told}");

    // A mistake leaves the program as it was, and its mending is enough.
    fs::write(watch.path().join("size.vcut"), "let width = 44 mn\n").unwrap();
    watch.told("VC0204");
    assert_eq!(watch.program(), first);
    fs::write(watch.path().join("size.vcut"), "let width = 44 mm\n").unwrap();
    watch.told("wrote");
    assert_eq!(watch.program(), second);

    // A file that is gone is waited for; the job itself as well.
    for name in ["size.vcut", "rib.vcut"] {
        let path = watch.path().join(name);
        let text = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        watch.told("cannot read");
        fs::write(&path, text).unwrap();
        watch.told("no errors");
    }
    assert_eq!(watch.interrupt(), Some(0));
}

/// What a server answers to these bytes.
fn answer(address: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(LIMIT)).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

fn get(address: &str, target: &str) -> String {
    answer(
        address,
        &format!("GET {target} HTTP/1.1\r\nHost: {address}\r\n\r\n"),
    )
}

/// The version in a page.
fn version(page: &str) -> &str {
    let (_, rest) = page
        .split_once("<meta name=\"vcutc-version\" content=\"")
        .unwrap();
    rest.split('"').next().unwrap()
}

#[test]
fn the_report_is_served_to_this_machine_and_follows_the_job() {
    let watch = Watch::start(&["--serve", "0"]);
    let address = watch.address();
    assert!(address.starts_with("127.0.0.1:"), "{address}");

    let page = get(&address, "/");
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n"), "{}", &page[..200]);
    assert!(page.contains("connect-src 'self'") && page.contains("<title>rib - vcutc report</title>"));
    let first = version(&page).to_owned();

    // It waits for the next version, which is the messages while the job has mistakes.
    let asking = {
        let (address, target) = (address.clone(), format!("/changes?{first}"));
        thread::spawn(move || get(&address, &target))
    };
    fs::write(watch.path().join("size.vcut"), "let width = 44 <b>\n").unwrap();
    watch.told("VC0101");
    let changes = asking.join().unwrap();
    let page = get(&address, "/");
    let second = version(&page);
    assert_ne!(second, first);
    assert!(
        changes.contains("text/event-stream") && changes.ends_with(&format!("data: {second}\n\n")),
        "{changes}"
    );
    assert!(
        page.contains("VC0101") && page.contains("&lt;b&gt;") && !page.contains("<b>"),
        "{page}"
    );

    for (request, status) in [
        (format!("HEAD / HTTP/1.1\r\nHost: {address}\r\n\r\n"), "200"),
        ("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n".to_owned(), "403"),
        ("GET / HTTP/1.1\r\n\r\n".to_owned(), "400"),
        (format!("POST / HTTP/1.1\r\nHost: {address}\r\n\r\n"), "405"),
        (
            format!("GET /rib.vcut HTTP/1.1\r\nHost: {address}\r\n\r\n"),
            "404",
        ),
        (
            format!(
                "GET / HTTP/1.1\r\nHost: {address}\r\nX: {}\r\n",
                "x".repeat(10_000)
            ),
            "431",
        ),
        (
            format!(
                "GET / HTTP/1.1\r\nHost: {address}\r\nX: {}\r\n\r\n",
                "x".repeat(8_300)
            ),
            "431",
        ),
    ] {
        let found = answer(&address, &request);
        assert!(
            found.starts_with(&format!("HTTP/1.1 {status} ")),
            "{request}: {found}"
        );
        let (head, body) = found.split_once("\r\n\r\n").unwrap();
        assert!(head.contains("frame-ancestors 'none'"), "{head}");
        assert!(!body.contains("rib"), "{body}");
    }

    // A job that is gone has no page.
    fs::remove_file(watch.path().join("rib.vcut")).unwrap();
    watch.told("cannot read the job");
    let start = Instant::now();
    while !get(&address, "/").contains("cannot read the job") {
        assert!(start.elapsed() < LIMIT);
        thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(watch.interrupt(), Some(0));
}

#[test]
fn so_many_requests_are_answered_at_once_and_no_more() {
    let watch = Watch::start(&["--serve", "0"]);
    let address = watch.address();
    let page = get(&address, "/");
    let request = format!(
        "GET /changes?{} HTTP/1.1\r\nHost: {address}\r\n\r\n",
        version(&page)
    );
    let mut waiting = Vec::new();
    while waiting.len() < 24 {
        let mut stream = TcpStream::connect(&address).unwrap();
        stream.set_read_timeout(Some(LIMIT)).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut first = [0; 12];
        stream.read_exact(&mut first).unwrap();
        match &first {
            b"HTTP/1.1 200" => waiting.push(stream),
            // The place of an answer before is given back a moment after that answer.
            b"HTTP/1.1 503" => thread::sleep(Duration::from_millis(20)),
            other => panic!("{:?}", String::from_utf8_lossy(other)),
        }
    }
    assert!(get(&address, "/").starts_with("HTTP/1.1 503 "));

    // All of them are told of a change, and make room.
    fs::write(watch.path().join("size.vcut"), "let width = 44 mm\n").unwrap();
    for mut stream in waiting {
        let mut rest = String::new();
        stream.read_to_string(&mut rest).unwrap();
        assert!(rest.contains("data: "), "{rest}");
    }
    let start = Instant::now();
    while !get(&address, "/").starts_with("HTTP/1.1 200 ") {
        assert!(start.elapsed() < LIMIT);
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_request_that_does_not_end_is_given_up() {
    let watch = Watch::start(&["--serve", "0"]);
    let address = watch.address();
    let mut stream = TcpStream::connect(&address).unwrap();
    stream.set_read_timeout(Some(LIMIT)).unwrap();
    stream.write_all(b"GET / HTTP/1.1\r\nHost: ").unwrap();
    // It is told so, though this side has not ended it.
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 431 "), "{answer}");
    assert!(get(&address, "/").starts_with("HTTP/1.1 200 "));
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let folder = folder();
    for (arguments, told) in [
        (["watch", "none.vcut"], "there is no such file"),
        (["watch", "."], "it is no file"),
        (["watch", "-"], "takes a job from a file"),
    ] {
        let run = super::vcutc(folder.path(), &arguments);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(told), "{}", run.stderr);
    }
}
