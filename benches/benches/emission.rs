//! Ways of writing the files of 10^5 cuts; the throughput shown is bytes per second.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use vcutc_backend_api::bundle::Bundle;
use vcutc_benches::emission::{self, Folder, Lines};
use vcutc_benches::jobs;
use vcutc_benches::stages::{self, Discard};

fn all(criterion: &mut Criterion) {
    let (sources, job) = stages::check(&jobs::text(100_000));
    let program = stages::reachable(&stages::lower(&stages::plan(&job), &sources));
    let options = stages::options();
    let mut bundle = Bundle::default();
    stages::emit(&program, &options, &mut bundle);
    let lines = Lines::of(&bundle);

    let path = std::env::temp_dir().join(format!("vcutc-bench-{}", std::process::id()));
    let mut group = criterion.benchmark_group("emission");
    group.sample_size(20).measurement_time(Duration::from_secs(10));
    group.throughput(Throughput::Bytes(
        bundle.files().iter().map(|(_, bytes)| bytes.len() as u64).sum(),
    ));
    group.bench_function("backend, bytes discarded", |bench| {
        bench.iter(|| stages::emit(&program, &options, &mut Discard::default()));
    });
    let backend = |folder: &mut Folder| stages::emit(&program, &options, folder);
    let formatted = |folder: &mut Folder| lines.write(folder);
    let finished = |folder: &mut Folder| emission::write_finished(&bundle, folder);
    let ways: [Way<'_>; 3] = [
        ("backend, to files", &backend),
        ("write! through a BufWriter, to files", &formatted),
        ("finished bytes, to files", &finished),
    ];
    for (name, way) in ways {
        way(&mut Folder::new(&path));
        emission::assert_same_files(&bundle, &path);
        group.bench_function(name, |bench| {
            bench.iter_batched(
                || Folder::new(&path),
                |mut folder| way(&mut folder),
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
    std::fs::remove_dir_all(&path).expect("files can be removed");
}

/// A way of writing, by name.
type Way<'a> = (&'a str, &'a dyn Fn(&mut Folder));

criterion_group!(benches, all);
criterion_main!(benches);
