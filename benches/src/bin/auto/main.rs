//! How fast the programs are that compilers find for jobs which leave all parameters to them.
//!
//! `cargo run --release --bin auto -- [robots] fixed JOBS COMPILER` compiles each of so many random jobs as it is, and once more with
//! each of eight choices made that it leaves open, such as a lattice or a swing. It lists the choices with the jobs whose programs are
//! faster by more than [`SLOWER`]: the compiler should have found these.
//!
//! `cargo run --release --bin auto -- [robots] JOBS COMPILER [OTHER]` has each of so many random jobs compiled by one compiler, and by
//! another one beside it, and prints the sums: planned times of the programs, and the time that it took to find them, on one
//! thread. With another compiler it lists the jobs whose programs are slower by more than [`SLOWER`]. With `robots` each job has a
//! robot, and time includes what its axes ask for.

mod compile;
mod fixed;

use compile::{Found, compile};
use std::path::PathBuf;
use std::process::ExitCode;
use vcutc_benches::auto;

/// By which share of itself a program may be slower and not be listed.
const SLOWER: f64 = 0.005;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).peekable();
    let robot: fn(u64) -> String = match arguments.next_if_eq("robots") {
        Some(_) => auto::robot,
        None => |_| String::new(),
    };
    let is_fixed = arguments.next_if_eq("fixed").is_some();
    let jobs = arguments.next().and_then(|jobs| jobs.parse::<u64>().ok());
    let compilers: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    let (Some(jobs), false) = (jobs, compilers.is_empty()) else {
        eprintln!("usage: auto [robots] [fixed] JOBS COMPILER [OTHER]");
        return ExitCode::FAILURE;
    };
    let file = std::env::temp_dir().join(format!("vcutc-auto-{}.vcut", std::process::id()));
    if let (true, [compiler]) = (is_fixed, &compilers[..]) {
        fixed::compare(compiler, jobs, &file, robot);
        let _ = std::fs::remove_file(&file);
        return ExitCode::SUCCESS;
    }
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
