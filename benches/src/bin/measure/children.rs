//! What is measured, each in a process of its own.

use crate::Figures;
use crate::clock::{medians, time};
use crate::machine::peak_memory;
use std::path::PathBuf;
use vcutc::machine::kinematics::batch::{Answers, BranchAnswers};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::readback::program_files;
use vcutc_benches::contour::{self, Axes, Height, Polygons};
use vcutc_benches::emission::{self, Folder, Lines};
use vcutc_benches::jobs;
use vcutc_benches::kinematics::Task;
use vcutc_benches::stages::{self, Discard};

/// Runs one of them.
pub(crate) fn run(what: &str, cuts: u32) -> Figures {
    if what == "kinematics" {
        return named(kinematics(cuts as usize));
    }
    let text = jobs::text(cuts);
    let figures = match what {
        "stages" => stages(&text),
        "memory" => memory(&text),
        "emission" => emission(&text),
        "contour" => contour(&text),
        "instructions" => {
            instructions(&text);
            Vec::new()
        }
        _ => panic!("nothing is called {what}"),
    };
    named(figures)
}

fn named(figures: Vec<(&'static str, f64)>) -> Figures {
    figures
        .into_iter()
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}

/// A folder for files, beside those of other runs.
fn folder(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("vcutc-measure-{}-{name}", std::process::id()))
}

/// Time of each stage in ns.
fn stages(text: &str) -> Vec<(&'static str, f64)> {
    let options = stages::options();
    let path = folder("stages");
    let mut cuts = 0;
    let [parse, check, plan, lower, contour, report, emit, to_files] = medians(|| {
        let (parse, _) = time(|| stages::parse(text));
        let (check, (sources, job)) = time(|| stages::check(text));
        let (plan, planned) = time(|| stages::plan(&job));
        cuts = stages::cuts(&planned);
        let (lower, program) = time(|| stages::lower(&planned, &sources));
        let (contour, replay) = time(|| stages::contour(&planned, &program));
        let (report, _) = time(|| stages::report(&planned, &program, replay));
        let program = stages::reachable(&program);
        let (emit, ()) = time(|| stages::emit(&program, &options, &mut Discard::default()));
        let mut folder = Folder::new(&path);
        let (to_files, ()) = time(|| stages::emit(&program, &options, &mut folder));
        [parse, check, plan, lower, contour, report, emit, to_files]
    });
    remove(&path);
    vec![
        ("cuts", cuts as f64),
        ("parse", parse),
        ("check", check),
        ("plan", plan),
        ("lower", lower),
        ("contour", contour),
        ("report", report),
        ("emit", emit),
        ("to_files", to_files),
    ]
}

/// Peak memory after each stage in KiB above that at the start, everything being kept as the driver keeps it.
fn memory(text: &str) -> Vec<(&'static str, f64)> {
    let before = peak_memory();
    let peak = || peak_memory() - before;
    let _ast = stages::parse(text);
    let (sources, job) = stages::check(text);
    let check = peak();
    let planned = stages::plan(&job);
    let plan = peak();
    let program = stages::lower(&planned, &sources);
    let lower = peak();
    let replay = stages::contour(&planned, &program);
    let contour = peak();
    let _removed = stages::report(&planned, &program, replay);
    let path = folder("memory");
    let program = stages::reachable(&program);
    stages::emit(&program, &stages::options(), &mut Folder::new(&path));
    let emit = peak();
    remove(&path);
    let cuts = stages::cuts(&planned) as f64;
    vec![
        ("cuts", cuts),
        ("check", check),
        ("plan", plan),
        ("lower", lower),
        ("contour", contour),
        ("emit", emit),
    ]
}

/// Time of each way of writing the same files, in ns.
fn emission(text: &str) -> Vec<(&'static str, f64)> {
    let (sources, job) = stages::check(text);
    let program = stages::reachable(&stages::lower(&stages::plan(&job), &sources));
    let options = stages::options();
    let mut bundle = Bundle::default();
    stages::emit(&program, &options, &mut bundle);
    let lines = Lines::of(&bundle);

    let path = folder("emission");
    let to_files = |write: &dyn Fn(&mut Folder)| {
        let mut folder = Folder::new(&path);
        time(|| write(&mut folder)).0
    };
    let backend = |folder: &mut Folder| stages::emit(&program, &options, folder);
    let formatted = |folder: &mut Folder| lines.write(folder);
    let finished = |folder: &mut Folder| emission::write_finished(&bundle, folder);
    let ways: [&dyn Fn(&mut Folder); 3] = [&backend, &formatted, &finished];
    for way in ways {
        to_files(way);
        emission::assert_same_files(&bundle, &path);
    }
    let files = program_files(&bundle);
    let [memory, read, retrace, backend, formatted, finished] = medians(|| {
        let (memory, ()) = time(|| stages::emit(&program, &options, &mut Discard::default()));
        let (read, _) = time(|| stages::read(&program, &options, &files));
        let (retrace, ()) = time(|| stages::retrace(&program, &options, &files));
        let [backend, formatted, finished] = ways.map(to_files);
        [memory, read, retrace, backend, formatted, finished]
    });
    remove(&path);
    vec![
        ("lines", lines.count() as f64),
        ("moves", lines.moves() as f64),
        ("files", bundle.files().len() as f64),
        (
            "bytes",
            bundle.files().iter().map(|(_, bytes)| bytes.len()).sum::<usize>() as f64,
        ),
        ("memory", memory),
        ("read", read),
        ("retrace", retrace),
        ("backend", backend),
        ("formatted", formatted),
        ("finished", finished),
    ]
}

/// Time of the replay and of polygon clipping, in ns.
fn contour(text: &str) -> Vec<(&'static str, f64)> {
    let (sources, job) = stages::check(text);
    let planned = stages::plan(&job);
    let program = stages::lower(&planned, &sources);
    let replay = stages::contour(&planned, &program);
    let ours = contour::ours(&replay);

    let ways = |height| [Axes::AsDrawn, Axes::Swapped].map(|axes| Polygons::new(&planned, height, axes));
    let clipper = [Height::BladeReach, Height::Chip].map(|height| {
        faster(ways(height).map(|way| way.for_clipper()), |way| {
            contour::clipper(way)
        })
    });
    let i_overlay = [Height::BladeReach, Height::Chip].map(|height| {
        faster(ways(height).map(|way| way.for_i_overlay()), |way| {
            contour::i_overlay(way)
        })
    });
    let times = medians(|| {
        let (replay, replayed) = time(|| stages::contour(&planned, &program));
        let op_times = stages::times(&program);
        let (figures, _) = time(|| stages::deviation(&planned, replayed, op_times));
        let (clipper_reach, a) = time(|| contour::clipper(&clipper[0]));
        let (clipper_chip, b) = time(|| contour::clipper(&clipper[1]));
        let (i_overlay_reach, c) = time(|| contour::i_overlay(&i_overlay[0]));
        let (i_overlay_chip, d) = time(|| contour::i_overlay(&i_overlay[1]));
        for (peer, theirs) in [
            ("Clipper2", a),
            ("Clipper2", b),
            ("i_overlay", c),
            ("i_overlay", d),
        ] {
            contour::assert_same_area(peer, theirs, ours);
        }
        [
            replay,
            replay + figures,
            clipper_reach,
            clipper_chip,
            i_overlay_reach,
            i_overlay_chip,
        ]
    });
    let names = [
        "replay",
        "deviation",
        "clipper_reach",
        "clipper_chip",
        "i_overlay_reach",
        "i_overlay_chip",
    ];
    let cuts = ("cuts", stages::cuts(&planned) as f64);
    names.into_iter().zip(times).chain([cuts]).collect()
}

/// Time of inverse kinematics of so many poses in ns, and the worst residuals in m.
///
/// A round must be short: on a machine with other work, one that outlasts the scheduler's slice is timed with that work.
fn kinematics(poses: usize) -> Vec<(&'static str, f64)> {
    let task = Task::new(poses);
    let (mut answers, mut branch_answers) = (Answers::default(), BranchAnswers::default());
    #[cfg(feature = "ik-geo")]
    let geo = vcutc_benches::kinematics::geo::GeoTask::new(&task);
    let times = medians(|| {
        [
            time(|| task.all()).0,
            time(|| task.batches(&mut answers)).0,
            time(|| task.on_branch()).0,
            time(|| task.branch_batches(&mut branch_answers)).0,
            time(|| task.forward()).0,
            time(|| task.peer_all()).0,
            time(|| task.peer_continuing()).0,
            #[cfg(feature = "ik-geo")]
            time(|| geo.all()).0,
        ]
    });
    let names = [
        "all",
        "batches",
        "on_branch",
        "branch_batches",
        "forward",
        "peer_all",
        "peer_continuing",
        #[cfg(feature = "ik-geo")]
        "geo",
    ];
    let [worst, peer_worst] = Task::new(100_000).worst();
    let rest = [
        ("poses", task.count() as f64),
        ("worst", worst),
        ("peer_worst", peer_worst),
        #[cfg(feature = "ik-geo")]
        ("geo_worst", geo.worst()),
    ];
    names.into_iter().zip(times).chain(rest).collect()
}

/// The one of two inputs that takes less time.
fn faster<T>([a, b]: [T; 2], run: impl Fn(&T) -> f64) -> T {
    if time(|| run(&a)).0 <= time(|| run(&b)).0 {
        a
    } else {
        b
    }
}

/// Each stage once.
fn instructions(text: &str) {
    let (sources, job) = stages::check(text);
    let planned = stages::plan(&job);
    let program = stages::lower(&planned, &sources);
    let replay = stages::contour(&planned, &program);
    let _removed = stages::report(&planned, &program, replay);
    let program = stages::reachable(&program);
    stages::emit(&program, &stages::options(), &mut Discard::default());
}

fn remove(path: &PathBuf) {
    std::fs::remove_dir_all(path).expect("files can be removed");
}
