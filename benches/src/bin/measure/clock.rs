//! Medians of repeated, interleaved runs.

use std::time::{Duration, Instant};

/// Rounds that are always made.
const FEWEST: usize = 7;

/// Rounds that are never exceeded.
const MOST: usize = 501;

/// Time after which no further round is begun.
const ENOUGH: Duration = Duration::from_secs(4);

/// How long something takes; its result is dropped off the clock.
pub(crate) fn time<T>(run: impl FnOnce() -> T) -> (Duration, T) {
    let start = Instant::now();
    let result = std::hint::black_box(run());
    (start.elapsed(), result)
}

/// Repeats rounds of several measurements and gives the median of each, in ns. Slow spells of the machine then hit all
/// measurements of a round alike.
pub(crate) fn medians<const N: usize>(mut round: impl FnMut() -> [Duration; N]) -> [f64; N] {
    // The first round warms caches and the allocator up.
    round();
    let begun = Instant::now();
    let mut rounds = Vec::new();
    while rounds.len() < FEWEST || (begun.elapsed() < ENOUGH && rounds.len() < MOST) {
        rounds.push(round());
    }
    std::array::from_fn(|place| {
        let mut times: Vec<Duration> = rounds.iter().map(|round| round[place]).collect();
        times.sort_unstable();
        times[times.len() / 2].as_secs_f64() * 1e9
    })
}
