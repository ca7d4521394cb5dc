//! The examples' shop: its jobs, its machines, and the controls that its gantries may have.

use crate::pipeline::{Files, compile_on};
use crate::repository::{files, root};
use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock};
use vcutc::driver::Outcome;

/// The examples that are meant to fail, with the codes they show.
pub(crate) const FAILING: &[(&str, &[&str])] = &[
    ("broken.vcut", &["VC0102", "VC0201", "VC0203", "VC0205", "VC0209"]),
    ("out_of_reach.vcut", &["VC0510"]),
    ("too_deep.vcut", &["VC0401"]),
];

/// The machines of the shop, with the target that drives each.
pub(crate) const CELLS: &[(&str, &str)] = &[
    ("large_cell", "krl"),
    ("abb_cell", "rapid"),
    ("gantry", "gcode"),
    ("knife_gantry", "gcode"),
];

/// The machines of the shop that change blades, with the target that drives each.
pub(crate) const CHANGING_CELLS: &[(&str, &str)] = &[
    ("changing_cell", "krl"),
    ("abb_changing_cell", "rapid"),
    ("changing_gantry", "gcode"),
];

/// The shop's cells with a crusher.
pub(crate) const POCKET_CELLS: &[(&str, &str)] = &[
    ("pocket_cell", "krl"),
    ("abb_pocket_cell", "rapid"),
    ("pocket_gantry", "gcode"),
];

/// What a machine of the shop cannot hold the blade for: half a turn of a blade about itself, a blade that is pitched, and one that
/// follows walls in all directions.
pub(crate) const NOT_ON: &[(&str, &str)] = &[
    ("spoiler_rae2822.vcut", "gantry"),
    ("crown.vcut", "gantry"),
    ("twist.vcut", "gantry"),
    ("shell.vcut", "changing_gantry"),
    ("window.vcut", "pocket_gantry"),
    ("bay.vcut", "changing_gantry"),
];

/// What a dialect of G-code has no words for: chains that go on without a stop.
pub(crate) const NOT_IN: &[(&str, &str)] = &[
    ("finished_dome.vcut", "fanuc"),
    ("crown.vcut", "fanuc"),
    ("seat.vcut", "fanuc"),
    ("tray.vcut", "fanuc"),
];

/// The dialects of G-code, each with the options that a gantry under such a control has. M codes of Fanuc and Heidenhain
/// controls are their builder's.
pub(crate) const DIALECTS: &[(&str, &str)] = &[
    (
        "linuxcnc",
        r#"dialect = linuxcnc approximation = 2 mm tcp_on = ("M429") tcp_off = ("M428")"#,
    ),
    ("fanuc", r#"dialect = fanuc on_code = ("M50") off_code = ("M51")"#),
    ("sinumerik", "dialect = sinumerik approximation = 2 mm"),
    (
        "heidenhain",
        r#"dialect = heidenhain on_code = ("M50") off_code = ("M51")"#,
    ),
];

/// An example on a machine that can cut it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pairing {
    /// The machine of the shop; none when the job has one of its own.
    pub(crate) machine: Option<&'static str>,
    /// The target that drives it.
    pub(crate) target: &'static str,
}

/// The jobs among the examples, name and text: what lies in their folder itself, without the files they use.
pub(crate) fn jobs() -> Vec<(String, String)> {
    let jobs = files("examples", ".vcut").into_iter().filter_map(|file| {
        let name = file.path.strip_prefix("examples/")?.to_owned();
        (!name.contains('/')).then_some((name, file.text))
    });
    jobs.collect()
}

/// The examples that compile, each with the machines that can cut it.
pub(crate) fn compiling() -> Vec<(String, Vec<Pairing>)> {
    let is_meant_to_fail = |name: &str| FAILING.iter().any(|&(failing, _)| failing == name);
    let with_machines = jobs().into_iter().filter_map(|(name, text)| {
        if is_meant_to_fail(&name) {
            return None;
        }
        let cells = if text.contains("shop/cells.vcut") {
            CELLS
        } else if text.contains("shop/changing_cells.vcut") {
            CHANGING_CELLS
        } else if text.contains("shop/pocket_cells.vcut") {
            POCKET_CELLS
        } else {
            &[]
        };
        let able = cells
            .iter()
            .filter(|(machine, _)| !NOT_ON.contains(&(name.as_str(), machine)));
        let pairing = |&(machine, target)| Pairing {
            machine: Some(machine),
            target,
        };
        let mut machines: Vec<Pairing> = able.map(pairing).collect();
        if cells.is_empty() {
            let (machine, target) = (None, "krl");
            machines.push(Pairing { machine, target });
        }
        Some((name, machines))
    });
    with_machines.collect()
}

/// Whether programs for that dialect can say all that an example does.
pub(crate) fn has_words_for(dialect: &str, example: &str) -> bool {
    !NOT_IN.contains(&(example, dialect))
}

/// The files of the examples.
pub(crate) fn folder() -> Files {
    Files::of(root().join("examples"))
}

/// The files of the examples with gantries under that control.
pub(crate) fn folder_for(dialect: &str) -> Files {
    let (_, options) = DIALECTS.iter().find(|(name, _)| *name == dialect).unwrap();
    let mut all = folder();
    for name in [
        "shop/cells.vcut",
        "shop/changing_cells.vcut",
        "shop/pocket_cells.vcut",
    ] {
        let path = format!("examples/{name}");
        let mut found = files("examples", ".vcut").into_iter();
        let cells = found.find(|file| file.path == path).unwrap();
        let mut blocks = cells.text.split("gcode {");
        let head = blocks.next().unwrap().to_owned();
        let text = blocks.fold(head, |text, block| {
            let (_, rest) = block.split_once('}').unwrap();
            text + "gcode { " + options + " }" + rest
        });
        assert_ne!(text, cells.text);
        all = all.with(name, text);
    }
    all
}

/// Examples that were compiled: for a control of gantries, on a machine, by name.
type Compiled = BTreeMap<(Option<String>, Option<String>, String), &'static OnceLock<Outcome>>;

/// An example on one of its machines. Many tests look at the same ones, and to compile them takes most of their time: a run of
/// the tests compiles each once, and keeps it.
pub(crate) fn compiled(machine: Option<&str>, job: &str) -> &'static Outcome {
    compiled_once(None, machine, job)
}

/// As [`compiled`], with gantries under that control.
pub(crate) fn compiled_for(dialect: &str, machine: Option<&str>, job: &str) -> &'static Outcome {
    compiled_once(Some(dialect), machine, job)
}

fn compiled_once(dialect: Option<&str>, machine: Option<&str>, job: &str) -> &'static Outcome {
    static COMPILED: Mutex<Compiled> = Mutex::new(BTreeMap::new());
    let key = (
        dialect.map(str::to_owned),
        machine.map(str::to_owned),
        job.to_owned(),
    );
    // The lock is free again before the example is compiled, so that other ones can be compiled at the same time.
    let cell: &'static OnceLock<Outcome> = COMPILED
        .lock()
        .unwrap()
        .entry(key)
        .or_insert_with(|| Box::leak(Box::default()));
    cell.get_or_init(|| {
        let files = dialect.map_or_else(folder, folder_for);
        compile_on(machine, job, &files)
    })
}
