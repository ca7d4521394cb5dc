//! Leaning discs on surfaces, and bounds of their moves; the throughput shown is drops, and moves, per second.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use vcutc::surface::disc::Disc;
use vcutc::surface::gouge::Moves;
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
        group.bench_function(
            format!("disc with hub and holder on {count} triangles"),
            |bench| {
                bench.iter(|| drop::discs(black_box(&dropper)));
            },
        );
        let moves = Moves::new(&dropper).expect("it is a sheet");
        let face = Disc::new(drop::disc().radius(), Vec::new()).expect("it is a disc");
        let track = drop::track(&moves, &face);
        group.throughput(Throughput::Elements(drop::POSES - 1));
        group.bench_function(format!("moves of 5 mm on {count} triangles"), |bench| {
            bench.iter(|| drop::deepest(black_box(&moves), &face, &track));
        });
    }
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
