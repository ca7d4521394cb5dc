//! The section under slits and passes of a disc; the throughput shown is slits and passes per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use vcutc_backend_api::units::Angle;
use vcutc_benches::strips::{self, Strips};

fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("strips");
    group.sample_size(10).measurement_time(Duration::from_secs(8));
    for cuts in [1_000, 10_000, 100_000, 1_000_000] {
        for lead in [0.0, 3.0] {
            let job = Strips::new(cuts, Angle::deg(lead));
            group.throughput(Throughput::Elements(job.cuts()));
            let id = BenchmarkId::new(format!("lead {lead} deg"), cuts);
            group.bench_function(id, |bench| bench.iter_with_large_drop(|| job.ours()));
        }
    }
    for cuts in [1_000, 10_000] {
        let job = Strips::new(cuts, Angle::deg(0.0));
        let polygons = job.for_clipper();
        let (theirs, ours) = (strips::clipper(&polygons), Strips::area(&mut job.ours()));
        assert!(
            (theirs - ours).abs() <= 1e-9 * ours,
            "Clipper2 leaves {theirs} mm2, we {ours}"
        );
        group.throughput(Throughput::Elements(job.cuts()));
        let id = BenchmarkId::new("Clipper2, all strips at once", cuts);
        group.bench_function(id, |bench| bench.iter(|| strips::clipper(&polygons)));
    }
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
