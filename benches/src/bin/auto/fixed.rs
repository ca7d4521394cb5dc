//! Whether programs become faster by a choice that was left to the compiler.

use crate::SLOWER;
use crate::compile::compile;
use std::path::Path;
use vcutc_benches::auto;

/// What a choice comes to in all jobs.
struct Tally {
    choice: &'static str,
    compiled: u32,
    /// The jobs that are faster with it, and by what share of themselves without it.
    faster: Vec<(u64, f64)>,
}

/// Compiles so many jobs as they are, and with each of some choices made, and prints how many programs are faster with it. `end` is
/// what follows each job.
pub(crate) fn compare(compiler: &Path, jobs: u64, file: &Path, end: fn(u64) -> String) {
    let mut tallies: Vec<Tally> = Vec::new();
    let compiled = |text: &str, number: u64| {
        std::fs::write(file, text.to_owned() + &end(number))
            .expect("the folder for temporary files can be written to");
        compile(compiler, file)
    };
    for number in 0..jobs {
        let open = compiled(&auto::text(number), number);
        for (choice, text) in auto::fixed(number) {
            let tally = match tallies.iter_mut().position(|tally| tally.choice == choice) {
                Some(place) => &mut tallies[place],
                None => {
                    tallies.push(Tally {
                        choice,
                        compiled: 0,
                        faster: Vec::new(),
                    });
                    tallies.last_mut().expect("it has just been added")
                }
            };
            let Some(fixed) = compiled(&text, number) else {
                continue;
            };
            tally.compiled += 1;
            let Some(open) = &open else {
                println!("job {number}: compiles only with {choice}");
                continue;
            };
            let faster = open.planned / fixed.planned - 1.0;
            if faster > SLOWER {
                tally.faster.push((number, faster));
            }
        }
    }
    for Tally {
        choice,
        compiled,
        mut faster,
    } in tallies
    {
        faster.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        let all = faster
            .iter()
            .map(|(number, by)| format!("{number} by {:.1} %", 100.0 * by));
        let all: Vec<String> = all.collect();
        println!(
            "{choice}: {} of {compiled} faster; {}",
            faster.len(),
            all.join(", ")
        );
    }
}
