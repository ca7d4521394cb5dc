//! Leaning discs on a surface of a million triangles; the throughput shown is drops per second.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use vcutc_benches::{drop, surface};

fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("drop");
    group.sample_size(10).measurement_time(Duration::from_secs(3));
    for count in [50_000, 1_000_000] {
        let triangles = surface::triangles(count);
        let placed = surface::placed(&surface::read(&surface::binary(&triangles)));
        let dropper = drop::dropper(&placed);
        group.throughput(Throughput::Elements(drop::PLACES));
        group.bench_function(format!("face on {count} triangles"), |bench| {
            bench.iter(|| drop::faces(black_box(&dropper)));
        });
        group.bench_function(format!("disc with hub and holder on {count} triangles"), |bench| {
            bench.iter(|| drop::discs(black_box(&dropper)));
        });
    }
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
