//! How fast the programs are that compilers find for jobs which leave all parameters to them.
//!
//! `cargo run --release --bin auto -- [robots] JOBS COMPILER [OTHER]` has each of so many random jobs compiled by one compiler, and by
//! another one beside it, and prints the sums: planned times of the programs, and the time that it took to find them, on one
//! thread. With another compiler it lists the jobs whose programs are slower by more than [`SLOWER`]. With `robots` each job has a
//! robot, and time includes what its axes ask for.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;
use vcutc_benches::auto;

/// By which share of itself a program may be slower and not be listed.
const SLOWER: f64 = 0.005;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).peekable();
    let robot: fn(u64) -> String = match arguments.next_if_eq("robots") {
        Some(_) => auto::robot,
        None => |_| String::new(),
    };
    let jobs = arguments.next().and_then(|jobs| jobs.parse::<u64>().ok());
    let compilers: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    let (Some(jobs), false) = (jobs, compilers.is_empty()) else {
        eprintln!("usage: auto [robots] JOBS COMPILER [OTHER]");
        return ExitCode::FAILURE;
    };
    let file = std::env::temp_dir().join(format!("vcutc-auto-{}.vcut", std::process::id()));
    let mut sums = vec![Sum::default(); compilers.len()];
    let mut slower = Vec::new();
    for number in 0..jobs {
        std::fs::write(&file, auto::text(number) + &robot(number))
            .expect("the folder for temporary files can be written to");
        let found: Vec<Option<Found>> = compilers
            .iter()
            .map(|compiler| compile(compiler, &file))
            .collect();
        // What only one of them compiles cannot be compared.
        let Some(found) = found.iter().cloned().collect::<Option<Vec<Found>>>() else {
            let by = compilers.iter().zip(&found).find(|(_, found)| found.is_some());
            let by = by.map_or("none".to_owned(), |(one, _)| format!("{} alone", one.display()));
            println!("job {number}: compiled by {by}");
            continue;
        };
        for (sum, found) in sums.iter_mut().zip(&found) {
            sum.add(found);
        }
        if let [one, other] = &found[..]
            && one.planned > other.planned * (1.0 + SLOWER)
        {
            slower.push((number, one.planned / other.planned - 1.0));
        }
    }
    let _ = std::fs::remove_file(&file);
    for (compiler, sum) in compilers.iter().zip(&sums) {
        println!(
            "{}: {} programs of {:.0} s with {} cuts, found in {:.1} s",
            compiler.display(),
            sum.jobs,
            sum.planned,
            sum.cuts,
            sum.taken
        );
    }
    if let [one, other] = &sums[..] {
        println!(
            "planned time {:+.2} %, cuts {:+.2} %, time to find them x {:.2}",
            100.0 * (one.planned / other.planned - 1.0),
            100.0 * (one.cuts as f64 / other.cuts as f64 - 1.0),
            one.taken / other.taken
        );
    }
    for (number, by) in slower {
        println!("job {number}: slower by {:.1} %", 100.0 * by);
    }
    ExitCode::SUCCESS
}

/// What comes of a job.
#[derive(Clone)]
struct Found {
    /// The planned time of its program, in s.
    planned: f64,
    cuts: u64,
    /// How long it took to compile, in s.
    taken: f64,
}

#[derive(Clone, Default)]
struct Sum {
    jobs: u32,
    planned: f64,
    cuts: u64,
    taken: f64,
}

impl Sum {
    fn add(&mut self, found: &Found) {
        self.jobs += 1;
        self.planned += found.planned;
        self.cuts += found.cuts;
        self.taken += found.taken;
    }
}

/// Has a job compiled; none where that fails.
fn compile(compiler: &Path, job: &Path) -> Option<Found> {
    let start = Instant::now();
    let output = Command::new(compiler)
        .arg("check")
        .arg(job)
        .arg("-v")
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .expect("the compiler can be started");
    let taken = start.elapsed().as_secs_f64();
    if !output.status.success() {
        return None;
    }
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    let line = text
        .lines()
        .find_map(|line| line.trim_start().strip_prefix("time "))?;
    let (planned, _) = line.split_once('=')?;
    let cuts = text.lines().find_map(|line| {
        let (before, _) = line
            .split_once(" cuts in ")
            .or_else(|| line.split_once(" cut in "))?;
        before.rsplit(' ').next()?.parse().ok()
    })?;
    Some(Found {
        planned: seconds(planned)?,
        cuts,
        taken,
    })
}

/// A time as the summary has it, such as `1 h 03 min 23.3 s`, in s.
fn seconds(words: &str) -> Option<f64> {
    let words: Vec<&str> = words.split_whitespace().collect();
    let each = words.chunks(2).map(|pair| {
        let [number, unit] = pair else { return None };
        let in_seconds = match *unit {
            "h" => 3600.0,
            "min" => 60.0,
            "s" => 1.0,
            _ => return None,
        };
        Some(number.parse::<f64>().ok()? * in_seconds)
    });
    each.sum()
}
