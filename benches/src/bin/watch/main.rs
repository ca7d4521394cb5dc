//! How long it takes from a saved file to new programs: `vcutc watch JOB --target krl` as a process, each example, by kind of edit.
//!
//! `cargo run --release --bin watch -- target/release/vcutc` prints the table of `docs/benchmarks.md`. The examples are copied; a
//! number in a copy is changed again and again, never twice to the same value, so that no answer of before is the whole
//! answer. The clock runs from the moment before the file is written to the line that says that all is done; beside it
//! stands the time of the processors (on Linux), which says more on a machine with other work.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// How often each edit is made.
const ROUNDS: u32 = 9;

/// How long the files rest between two edits: people are slower.
const PAUSE: Duration = Duration::from_millis(120);

/// How long anything may take.
const LIMIT: Duration = Duration::from_secs(60);

/// A change of a number.
struct Edit {
    kind: &'static str,
    /// In the job's own file where none is named.
    file: Option<&'static str>,
    /// What stands before the number, once in the file.
    before: &'static str,
    /// What is added to the number each time.
    by: f64,
}

/// An example, and what is changed about its profile.
struct Example {
    job: &'static str,
    profile: [&'static str; 2],
    /// A speed, and the file that holds it.
    speed: (Option<&'static str>, &'static str, f64),
    /// An option of the target, and the file that holds it.
    option: Option<(Option<&'static str>, &'static str, f64)>,
}

const IN_SPEEDS: (Option<&str>, &str, f64) = (Some("shop/speeds.vcut"), "let cutting     = ", -0.125);
const IN_CELLS: Option<(Option<&str>, &str, f64)> =
    Some((Some("shop/cells.vcut"), "lines_per_part = ", 10.0));

const fn example(job: &'static str, profile: [&'static str; 2]) -> Example {
    Example {
        job,
        profile,
        speed: IN_SPEEDS,
        option: IN_CELLS,
    }
}

const EXAMPLES: [Example; 9] = [
    Example {
        speed: (None, "feed      { cut = ", -1.0),
        option: None,
        ..example("block_cui", ["start (0 mm, ", "arc   to (85 mm, "])
    },
    example("fairing", ["start  (0 mm, ", "(140 mm, "]),
    example("imprint", ["let depth = ", "let depth = "]),
    example("rib_dxf", ["allowance = ", "allowance = "]),
    example("slat_s1223", ["chord = chord, z = ", "let chord = "]),
    example("spoiler_clarky", ["let web   = ", "let chord = "]),
    example("spoiler_naca2412", ["chord = chord, z = ", "let chord = "]),
    example("spoiler_rae2822", ["chord = chord, z = ", "let chord = "]),
    Example {
        option: None,
        ..example("wavy_panel", ["{ z(x) = ", "let height = "])
    },
];

/// Kinds of edits, in the order of the columns.
const KINDS: [&str; 5] = ["comment", "target", "machine", "speed", "profile"];

impl Example {
    fn edits(&self) -> Vec<Edit> {
        let edit = |kind, (file, before, by)| Edit {
            kind,
            file,
            before,
            by,
        };
        let own = |kind, before, by| edit(kind, (None, before, by));
        let machine = match self.option {
            Some((file, ..)) => edit("machine", (file, "load       = load(mass = ", 0.01)),
            None if self.job == "block_cui" => own("machine", "ready      = input(", 1.0),
            None => own("machine", "ultrasonic = output(", 1.0),
        };
        let mut edits = vec![
            own("comment", "// edited ", 1.0),
            machine,
            edit("speed", self.speed),
        ];
        edits.extend(self.option.map(|option| edit("target", option)));
        let [first, second] = self.profile;
        edits.push(own("profile", first, 0.125));
        if second != first {
            edits.push(own("profile", second, 0.125));
        }
        edits
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let compiler = PathBuf::from(arguments.next().expect("usage: watch <path of vcutc> [example]"));
    let compiler = fs::canonicalize(compiler).expect("the compiler is there");
    let only = arguments.next();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let folder = std::env::temp_dir().join(format!("vcutc-watch-{}", std::process::id()));
    println!("| example | cold | {} |", KINDS.join(" | "));
    println!("| --- | --- |{}", " --- |".repeat(KINDS.len()));
    for example in &EXAMPLES {
        if only.as_deref().is_none_or(|only| only == example.job) {
            let _ = fs::remove_dir_all(&folder);
            copy(&examples, &folder);
            row(&compiler, &folder, example);
        }
    }
    let _ = fs::remove_dir_all(&folder);
}

/// Copies jobs and the files that they use.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder can be made");
    for entry in fs::read_dir(from).expect("the examples are there").flatten() {
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).expect("files can be copied");
        }
    }
}

fn row(compiler: &Path, folder: &Path, example: &Example) {
    let job = folder.join(format!("{}.vcut", example.job));
    let text = fs::read_to_string(&job).expect("the example is there");
    fs::write(&job, format!("// edited 0\n{text}")).expect("files can be written");
    let mut times: BTreeMap<&str, Vec<Taken>> = BTreeMap::new();
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let mut watch = Watch::start(compiler, folder, example.job);
        watch.wait();
        let (clock, processors) = (start.elapsed().as_secs_f64() * 1e3, watch.processors());
        times.entry(COLD).or_default().push(Taken { clock, processors });
    }
    let mut watch = Watch::start(compiler, folder, example.job);
    watch.wait();
    for edit in example.edits() {
        let path = edit.file.map_or_else(|| job.clone(), |file| folder.join(file));
        for _ in 0..ROUNDS {
            std::thread::sleep(PAUSE);
            let text = fs::read_to_string(&path).expect("files can be read");
            let text = changed(&text, &edit);
            let (start, before) = (Instant::now(), watch.processors());
            save(&path, &text);
            watch.wait();
            times.entry(edit.kind).or_default().push(Taken {
                clock: start.elapsed().as_secs_f64() * 1e3,
                processors: watch.processors() - before,
            });
        }
    }
    let of = |kind: &str| times.get(kind).map(|taken| Taken::median(taken));
    let cold = of(COLD).expect("it was started");
    let cells = KINDS.map(|kind| {
        of(kind).map_or_else(
            || "-".to_owned(),
            |taken| {
                let ratio = taken.processors / cold.processors;
                format!("{:.0} / {:.0} ({ratio:.2}x)", taken.clock, taken.processors)
            },
        )
    });
    println!(
        "| {} | {:.0} / {:.0} | {} |",
        example.job,
        cold.clock,
        cold.processors,
        cells.join(" | ")
    );
}

/// The first run, of a process that has just been started.
const COLD: &str = "cold";

/// What a run took, in ms.
struct Taken {
    /// By the clock.
    clock: f64,
    /// On all processors together.
    processors: f64,
}

impl Taken {
    /// Each figure's median.
    fn median(taken: &[Self]) -> Self {
        Self {
            clock: median(taken.iter().map(|taken| taken.clock)),
            processors: median(taken.iter().map(|taken| taken.processors)),
        }
    }
}

/// Replaces the old file by a new one, as editors do: half a file is never seen.
fn save(path: &Path, text: &str) {
    let new = path.with_extension("new");
    fs::write(&new, text).expect("files can be written");
    fs::rename(&new, path).expect("files can be renamed");
}

/// The text with another number.
fn changed(text: &str, edit: &Edit) -> String {
    let (head, rest) = text
        .split_once(edit.before)
        .unwrap_or_else(|| panic!("no {:?}", edit.before));
    let length = rest
        .find(|letter: char| !(letter.is_ascii_digit() || letter == '.'))
        .unwrap_or(rest.len());
    let (number, rest) = rest.split_at(length);
    let number: f64 = number.parse().expect("a number");
    format!("{head}{}{}{rest}", edit.before, number + edit.by)
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A running watch.
struct Watch {
    child: Child,
    waiting: Receiver<String>,
}

impl Watch {
    fn start(compiler: &Path, folder: &Path, job: &str) -> Self {
        let mut child = Command::new(compiler)
            .current_dir(folder)
            .args(["watch", &format!("{job}.vcut"), "--target", "krl", "-o", "out"])
            .args(["--message-format", "json"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the compiler starts");
        let (sender, waiting) = channel();
        let stdout = child.stdout.take().expect("it is piped");
        let stderr = child.stderr.take().expect("it is piped");
        for pipe in [
            Box::new(stdout) as Box<dyn std::io::Read + Send>,
            Box::new(stderr),
        ] {
            let sender = sender.clone();
            std::thread::spawn(move || {
                for line in BufReader::new(pipe).lines().map_while(Result::ok) {
                    let _ = sender.send(line);
                }
            });
        }
        Self { child, waiting }
    }

    /// How long its threads have been on processors so far, in ms; on Linux, elsewhere 0.
    fn processors(&self) -> f64 {
        let threads = fs::read_dir(format!("/proc/{}/task", self.child.id()));
        let of = |thread: fs::DirEntry| {
            let text = fs::read_to_string(thread.path().join("schedstat")).ok()?;
            text.split(' ').next()?.parse::<f64>().ok()
        };
        let threads = threads.into_iter().flatten().flatten();
        threads.filter_map(of).sum::<f64>() / 1e6
    }

    /// Waits until a run is over.
    fn wait(&mut self) {
        loop {
            let line = self.waiting.recv_timeout(LIMIT).expect("the watch goes on");
            assert!(!line.contains("\"severity\":\"error\""), "{line}");
            if line.contains("\"kind\":\"waiting\"") {
                return;
            }
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
