//! Surfaces of a million triangles; the throughput shown is triangles per second.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use vcutc_benches::surface;

fn all(criterion: &mut Criterion) {
    let triangles = surface::triangles(1_000_000);
    let (binary, ascii) = (surface::binary(&triangles), surface::ascii(&triangles));
    let read = surface::read(&binary);
    let placed = surface::placed(&read);
    let mut group = criterion.benchmark_group("surface");
    group.sample_size(10).measurement_time(Duration::from_secs(8));
    group.throughput(Throughput::Elements(triangles.len() as u64));
    group.bench_function("read binary STL", |bench| {
        bench.iter_with_large_drop(|| surface::read(black_box(&binary)));
    });
    group.bench_function("read text STL", |bench| {
        bench.iter_with_large_drop(|| surface::read(black_box(&ascii)));
    });
    group.bench_function("place and check", |bench| {
        bench.iter_with_large_drop(|| surface::placed(black_box(&read)));
    });
    group.bench_function("shadow", |bench| {
        bench.iter_with_large_drop(|| black_box(&placed).shadow());
    });
    group.bench_function("235 sections", |bench| {
        bench.iter(|| surface::sections(black_box(&placed), 235));
    });
    group.bench_function("what 150 teeth leave", |bench| {
        bench.iter(|| surface::standing(black_box(&placed), 150));
    });
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
