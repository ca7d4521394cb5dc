//! `rough auto` against its V cuts alone, and cuts along a spine against level ones; whole jobs without a machine.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use vcutc_benches::processes::{PARTS, Roughing, dome, text};
use vcutc_benches::stages;

fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("processes");
    group.sample_size(10).measurement_time(Duration::from_secs(8));
    for part in PARTS {
        for (name, roughing) in [("vcut", Roughing::Vcut), ("auto", Roughing::Auto)] {
            let job = text(part, roughing);
            group.bench_function(BenchmarkId::new(name, part.0), |bench| {
                bench.iter_with_large_drop(|| stages::compile(black_box(&job)));
            });
        }
    }
    group.finish();
    let mut group = criterion.benchmark_group("follow");
    group.sample_size(10).measurement_time(Duration::from_secs(8));
    for follow in ["straight", "spine"] {
        let job = dome(follow);
        group.bench_function(follow, |bench| {
            bench.iter_with_large_drop(|| stages::compile(black_box(&job)));
        });
    }
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
