//! Measures everything in one run and prints it as Markdown: `cargo run --release --bin measure`.
//!
//! Each size is measured in a process of its own, which this program starts from itself, so that the memory of one does
//! not disturb another. With `measure <what> <cuts>` only that child runs; `measure instructions <cuts>` runs the stages
//! once and prints nothing, for a profiler to look at, and so does `measure job <path>` with a whole job.

mod children;
mod clock;
mod machine;
mod tables;

use std::collections::BTreeMap;
use std::process::Command;

/// Sizes of jobs, in cuts.
const SIZES: [u32; 3] = [1_000, 100_000, 1_000_000];

/// Sizes at which the contour is compared with polygon clipping.
const PEER_SIZES: [u32; 2] = [10_000, 100_000];

/// Size at which ways of writing are compared.
const EMISSION_SIZE: u32 = 100_000;

/// Poses in a round of inverse kinematics: few, so that a round is over before the system gives the core to others.
const POSES: u32 = 512;

/// What a child measured: a name and a value for each.
type Figures = BTreeMap<String, f64>;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => tables::print(),
        ["job", path] => {
            std::hint::black_box(vcutc_benches::stages::compile_file(path));
        }
        [what, cuts] => {
            let cuts = cuts.parse().expect("a number of cuts");
            for (name, value) in children::run(what, cuts) {
                println!("{name} {value}");
            }
        }
        _ => eprintln!(
            "usage: measure [stages|memory|emission|contour|instructions <cuts>], kinematics <poses>, or job <path>"
        ),
    }
}

/// Runs a child in a process of its own.
fn child(what: &str, cuts: u32) -> Figures {
    eprintln!("measuring {what} at {cuts} cuts ...");
    let program = std::env::current_exe().expect("this program has a path");
    let output = Command::new(program)
        .args([what, &cuts.to_string()])
        .output()
        .expect("it can be started");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8_lossy(&output.stdout);
    let figure = |line: &str| {
        let (name, value) = line.rsplit_once(' ')?;
        Some((name.to_owned(), value.parse().ok()?))
    };
    text.lines().filter_map(figure).collect()
}
