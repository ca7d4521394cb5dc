//! `vcutc watch` as a process: jobs are edited while it runs, in the ways of editors, and its page is asked for.

use super::jobs::RIB;
use super::{command, folder, json_lines};
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
        Self::of(command(path, &arguments), folder)
    }

    /// A watch in a folder.
    pub(super) fn of(mut command: Command, folder: TempDir) -> Self {
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

    /// Waits for a run that reports this, until it is over, and returns its report. Runs before it are passed
    /// over: the system may let a file be seen half written.
    fn report(&self, wanted: &str) -> String {
        let mut report = self.until(wanted);
        if !wanted.contains("watching") {
            report.extend(self.until("watching"));
        }
        report.join("\n")
    }

    /// What a run reports to a program, until it is over.
    fn waiting(&self) -> String {
        self.until("\"kind\":\"waiting\"").join("\n")
    }

    /// The address under which it shows its page, when it has compiled for the first time.
    pub(crate) fn address(&self) -> String {
        let report = self.report("watching");
        let (_, rest) = report.split_once("http://").unwrap();
        rest.split('/').next().unwrap().to_owned()
    }

    fn program(&self) -> String {
        fs::read_to_string(self.path().join("out/rib.src")).unwrap()
    }

    pub(super) fn interrupt(mut self) -> Option<i32> {
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
    watch.report("watching 2 files");
    let first = watch.program();

    // A file that the job uses, written in place.
    fs::write(watch.path().join("size.vcut"), "let width = 44 mm\n").unwrap();
    watch.report("wrote");
    let second = watch.program();
    assert_ne!(first, second);

    // The same, renamed over it.
    fs::write(watch.path().join("size.new"), "let width = 40 mm\n").unwrap();
    fs::rename(watch.path().join("size.new"), watch.path().join("size.vcut")).unwrap();
    watch.report("wrote");
    assert_eq!(watch.program(), first);

    // A comment changes nothing, and nothing is written.
    fs::write(watch.path().join("size.vcut"), "let width = 40 mm // as ever\n").unwrap();
    let report = watch.report("unchanged");
    assert!(!report.contains("wrote"), "{report}");

    // A mistake leaves the program as it was, and fixing it is enough.
    fs::write(watch.path().join("size.vcut"), "let width = 44 mn\n").unwrap();
    watch.report("VC0204");
    assert_eq!(watch.program(), first);
    fs::write(watch.path().join("size.vcut"), "let width = 44 mm\n").unwrap();
    watch.report("wrote");
    assert_eq!(watch.program(), second);

    // A file that is gone is waited for; the job itself as well.
    for name in ["size.vcut", "rib.vcut"] {
        let path = watch.path().join(name);
        let text = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        watch.report("cannot read");
        fs::write(&path, text).unwrap();
        watch.report("no errors");
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
    watch.report("VC0101");
    let changes = asking.join().unwrap();
    let page = get(&address, "/");
    let second = version(&page);
    assert_ne!(second, first);
    assert!(
        changes.contains("text/event-stream") && changes.ends_with(&format!("data: {second}\n\n")),
        "{changes}"
    );
    assert!(
        page.contains("VC0101") && page.contains("&lt;") && !page.contains("44 <b>"),
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
    watch.report("cannot read the job");
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

    // All of them are notified of a change, and make room.
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
    // It is notified, though this side has not ended it.
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 408 "), "{answer}");
    assert!(get(&address, "/").starts_with("HTTP/1.1 200 "));
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let folder = folder();
    for (arguments, report) in [
        (["watch", "none.vcut"], "there is no such file"),
        (["watch", "."], "it is not a file"),
        (["watch", "-"], "takes a job from a file"),
    ] {
        let run = super::vcutc(folder.path(), &arguments);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(report), "{}", run.stderr);
    }
}

/// A file lies where the folder of the program should be.
#[test]
fn what_could_not_be_written_is_reported_and_tried_again() {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    fs::write(folder.path().join("out"), "in the way").unwrap();
    let arguments = [
        "watch",
        "rib.vcut",
        "--target",
        "krl",
        "-o",
        "out",
        "--serve",
        "0",
        "--message-format",
        "json",
    ];
    let watch = Watch::of(command(folder.path(), &arguments), folder);
    let report = watch.waiting();
    let lines = json_lines(&report);
    let kinds: Vec<&str> = lines.iter().map(|line| line["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["failure", "summary", "waiting"], "{report}");
    assert_eq!(lines[0]["message"], lines[1]["failure"]);
    assert_eq!(
        (&lines[1]["errors"], &lines[1]["files"]),
        (&0.into(), &serde_json::json!([]))
    );
    let address = lines[2]["address"].as_str().unwrap();
    let address = address.trim_start_matches("http://").trim_end_matches('/');
    let page = get(address, "/");
    assert!(page.contains("<p class=\"trouble\" role=\"alert\">"), "{page}");
    assert!(page.contains("<title>rib - vcutc report</title>"));

    // Nothing of the job changes.
    fs::remove_file(watch.path().join("out")).unwrap();
    let report = watch.waiting();
    let lines = json_lines(&report);
    assert_eq!(lines.len(), 2, "{report}");
    assert_eq!(lines[0]["files"].as_array().unwrap().len(), 2, "{report}");
    assert!(lines[0].get("failure").is_none(), "{report}");
    assert!(!watch.program().is_empty());
    assert!(!get(address, "/").contains("role=\"alert\""));
    assert_eq!(watch.interrupt(), Some(0));
}

#[test]
fn a_job_that_is_gone_has_a_summary_that_says_so() {
    let watch = Watch::start(&["--message-format", "json"]);
    watch.waiting();
    fs::remove_file(watch.path().join("rib.vcut")).unwrap();
    let report = watch.waiting();
    let lines = json_lines(&report);
    let kinds: Vec<&str> = lines.iter().map(|line| line["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["failure", "summary", "waiting"], "{report}");
    assert_eq!(
        lines[1]["failure"],
        "cannot read the job rib.vcut: there is no such file"
    );
}

/// A job that is made from what it would write is not written over, run after run.
#[test]
fn a_watch_writes_over_no_file_of_its_job() {
    let folder = folder();
    let text = RIB.replace(
        "  start (0 mm, 10 mm)\n  line  to (width, 16 mm)\n",
        "  points \"rib.dat\"\n",
    );
    assert_ne!(text, RIB);
    fs::write(folder.path().join("rib.vcut"), text).unwrap();
    let points = "x,z\n0,10\n40,16\n";
    fs::write(folder.path().join("rib.dat"), points).unwrap();
    let arguments = ["watch", "rib.vcut", "--target", "krl"];
    let watch = Watch::of(command(folder.path(), &arguments), folder);
    watch.report("is an input of the job");
    assert_eq!(fs::read_to_string(watch.path().join("rib.dat")).unwrap(), points);
}

/// The plan of the first text would take minutes.
#[test]
fn a_change_overtakes_the_run_under_way() {
    let folder = folder();
    let operation = RIB
        .split_once("rough vcut {")
        .and_then(|(_, rest)| rest.split_once("\n}\n"))
        .map(|(operation, _)| format!("rough vcut {{{operation}\n}}\n"))
        .unwrap();
    let fine = operation
        .replace("= 35 deg", "= auto")
        .replace("= 4 mm", "= auto")
        .replace("feed", "limits { scallop <= 1.5 mm }\n  feed");
    let slow = RIB
        .replace(&operation, &fine.repeat(10))
        .replace("let width = 40 mm", "let width = 400 mm")
        .replace(
            "  start (0 mm, 10 mm)\n  line  to (width, 16 mm)\n",
            "  z(x) = 18 mm + 8 mm * sin(x / 60 mm * 180 deg)\n",
        );
    fs::write(folder.path().join("rib.vcut"), slow).unwrap();
    let arguments = ["watch", "rib.vcut", "--target", "krl", "-o", "out"];
    let watch = Watch::of(command(folder.path(), &arguments), folder);
    // Long enough for the run to be in the middle of it; nothing is reported of it.
    thread::sleep(Duration::from_secs(2));
    fs::write(watch.path().join("rib.vcut"), RIB).unwrap();
    let report = watch.report("watching");
    assert!(
        report.contains("wrote ") && report.contains("rib.vcut: no errors"),
        "{report}"
    );
    assert_eq!(report.matches("rib.vcut: ").count(), 1, "{report}");
    assert_eq!(watch.interrupt(), Some(0));
}

#[test]
fn a_watch_without_a_listener_ends() {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    let mut child = command(folder.path(), &["watch", "rib.vcut"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains("watching") {
        line.clear();
        assert_ne!(stderr.read_line(&mut line).unwrap(), 0);
    }
    drop(stderr);
    fs::write(folder.path().join("rib.vcut"), RIB.replace("40 mm", "44 mm")).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
}
