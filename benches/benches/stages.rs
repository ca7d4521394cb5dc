//! The compiler's stages for 10^3, 10^5 and 10^6 cuts; the throughput shown is cuts per second.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use vcutc_benches::jobs;
use vcutc_benches::stages::{self, Discard};

fn all(criterion: &mut Criterion) {
    for cuts in [1_000, 100_000, 1_000_000] {
        let text = jobs::text(cuts);
        let (sources, job) = stages::check(&text);
        let plan = stages::plan(&job);
        let program = stages::lower(&plan, &sources);
        let reachable = stages::reachable(&program);
        let options = stages::options();

        let mut group = criterion.benchmark_group("stages");
        group.sample_size(10).measurement_time(Duration::from_secs(8));
        group.throughput(Throughput::Elements(stages::cuts(&plan) as u64));
        let id = |stage: &str| BenchmarkId::new(stage, cuts);
        group.bench_function(id("parse"), |bench| {
            bench.iter(|| stages::parse(black_box(&text)))
        });
        group.bench_function(id("parse and check"), |bench| {
            bench.iter(|| stages::check(black_box(&text)))
        });
        group.bench_function(id("plan"), |bench| {
            bench.iter_with_large_drop(|| stages::plan(black_box(&job)))
        });
        group.bench_function(id("lower and verify"), |bench| {
            bench.iter_with_large_drop(|| stages::lower(black_box(&plan), &sources));
        });
        group.bench_function(id("contour"), |bench| {
            bench.iter_with_large_drop(|| stages::contour(&plan, black_box(&program)));
        });
        let replay = stages::contour(&plan, &program);
        group.bench_function(id("figures"), |bench| {
            let input = || replay.clone();
            bench.iter_batched(
                input,
                |replay| stages::report(&plan, &program, replay),
                BatchSize::LargeInput,
            );
        });
        group.bench_function(id("emit"), |bench| {
            bench.iter(|| stages::emit(black_box(&reachable), &options, &mut Discard::default()));
        });
        group.finish();
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
