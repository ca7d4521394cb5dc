//! A job as a compiler compiles it.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// The result of a job.
#[derive(Clone)]
pub(crate) struct Found {
    /// The planned time of its program, in s.
    pub(crate) planned: f64,
    pub(crate) cuts: u64,
    /// How long it took to compile, in s.
    pub(crate) taken: f64,
}

/// Has a job compiled; none where that fails.
pub(crate) fn compile(compiler: &Path, job: &Path) -> Option<Found> {
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
