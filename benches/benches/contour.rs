//! The machined contour by replay and by polygon clipping; the throughput shown is cuts per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use vcutc_benches::contour::{self, Axes, Height, Polygons};
use vcutc_benches::{jobs, stages};

fn all(criterion: &mut Criterion) {
    for cuts in [1_000, 10_000, 100_000] {
        let (sources, job) = stages::check(&jobs::text(cuts));
        let plan = stages::plan(&job);
        let program = stages::lower(&plan, &sources);
        let area = contour::ours(&stages::contour(&plan, &program));

        let mut group = criterion.benchmark_group("contour");
        group.sample_size(10).measurement_time(Duration::from_secs(8));
        group.throughput(Throughput::Elements(stages::cuts(&plan) as u64));
        group.bench_function(BenchmarkId::new("replay", cuts), |bench| {
            bench.iter_with_large_drop(|| stages::contour(&plan, &program));
        });
        for (height, high) in [
            (Height::BladeReach, "high as the reach"),
            (Height::Chip, "high as a chip"),
        ] {
            for (axes, way) in [(Axes::AsDrawn, "as drawn"), (Axes::Swapped, "swapped")] {
                let polygons = Polygons::new(&plan, height, axes);
                let clipper = polygons.for_clipper();
                contour::assert_same_area("Clipper2", contour::clipper(&clipper), area);
                let id = BenchmarkId::new(format!("Clipper2, {high}, {way}"), cuts);
                group.bench_function(id, |bench| bench.iter(|| contour::clipper(&clipper)));
                let i_overlay = polygons.for_i_overlay();
                contour::assert_same_area("i_overlay", contour::i_overlay(&i_overlay), area);
                let id = BenchmarkId::new(format!("i_overlay, {high}, {way}"), cuts);
                group.bench_function(id, |bench| bench.iter(|| contour::i_overlay(&i_overlay)));
            }
        }
        group.finish();
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
