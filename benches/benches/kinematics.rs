//! Inverse kinematics by us and by others; the throughput shown is poses per second.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use vcutc::machine::kinematics::batch::{Answers, BranchAnswers};
use vcutc_benches::kinematics::Task;

fn all(criterion: &mut Criterion) {
    let task = Task::new(4096);
    let (mut answers, mut branch_answers) = (Answers::default(), BranchAnswers::default());
    let mut group = criterion.benchmark_group("kinematics");
    group.throughput(Throughput::Elements(task.count() as u64));
    group.bench_function("all solutions", |bench| bench.iter(|| task.all()));
    group.bench_function("all solutions, batches", |bench| {
        bench.iter(|| task.batches(&mut answers));
    });
    group.bench_function("one branch", |bench| bench.iter(|| task.on_branch()));
    group.bench_function("one branch, batches", |bench| {
        bench.iter(|| task.branch_batches(&mut branch_answers));
    });
    group.bench_function("forward", |bench| bench.iter(|| task.forward()));
    group.bench_function("rs-opw-kinematics, inverse", |bench| {
        bench.iter(|| task.peer_all());
    });
    group.bench_function("rs-opw-kinematics, inverse_continuing", |bench| {
        bench.iter(|| task.peer_continuing());
    });
    #[cfg(feature = "ik-geo")]
    {
        let geo = vcutc_benches::kinematics::geo::GeoTask::new(&task);
        group.bench_function("ik-geo", |bench| bench.iter(|| geo.all()));
    }
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
