//! Small whole jobs: one folder each in `tests/jobs`, with everything that the compiler makes of it as files beside it.
//!
//! The folder of a job holds `job.vcut` and what it uses, its tree (`ast.txt`), its cuts (`plan.csv`), its intermediate
//! program (`ir.json`), its figures (`summary.txt`) and its robot program (`krl/`). A line `// also: MACHINE TARGET` asks for
//! the program of another of its machines, too. All of them are compared byte for byte, so a change anywhere in the compiler shows in a diff that people can read. With `UPDATE_JOBS=1` in the
//! environment the files are rewritten instead: read them before committing.

use crate::cli::vcutc;
use crate::krl_text;
use crate::pipeline::{Files, compile, compile_on, emit, emit_for, rendered};
use crate::repository::root;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use vcutc::driver::Outcome;
use vcutc::job::Auto;
use vcutc::registry;
use vcutc::vcut::RoughVcut;
use vcutc::vcut::plan::{PlannedVcut, TipOrigin, Way};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::exchange::Exchange;

/// The file that a folder is about.
const JOB: &str = "job.vcut";

/// The folders of all jobs, in order.
fn folders() -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join("tests/jobs")).unwrap();
    let mut folders: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    folders
}

/// Compiles the job of a folder, which must be without errors.
fn compiled(folder: &Path) -> Outcome {
    let outcome = compile(JOB, &Files::of(folder));
    let messages = rendered(&outcome.diagnostics, &outcome);
    assert!(outcome.compiled.is_some(), "{}\n{messages}", folder.display());
    outcome
}

/// Everything that the compiler makes of a job, by the path of its file.
fn products(folder: &Path, outcome: &Outcome) -> BTreeMap<String, Vec<u8>> {
    let summary = outcome.compiled.as_ref().unwrap().summary.join("\n") + "\n";
    let mut products = BTreeMap::from([("summary.txt".to_owned(), summary.into_bytes())]);
    for (form, name) in [("ast", "ast.txt"), ("plan", "plan.csv"), ("ir", "ir.json")] {
        let run = vcutc(folder, &[JOB, "--emit", form, "--output", "-"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        products.insert(name.to_owned(), run.stdout.into_bytes());
    }
    if has_machine(outcome) {
        for (name, bytes) in emit(outcome).unwrap().files() {
            products.insert(format!("krl/{name}"), bytes.clone());
        }
    }
    for (machine, target) in also(folder) {
        let outcome = compile_on(Some(&machine), JOB, &Files::of(folder));
        let bundle = emit_for(registry::backend(&target).unwrap(), &outcome).unwrap();
        for (name, bytes) in bundle.files() {
            products.insert(format!("{target}/{name}"), bytes.clone());
        }
    }
    products
}

/// The other machines of a job whose programs are wanted, each with its target.
fn also(folder: &Path) -> Vec<(String, String)> {
    let text = fs::read_to_string(folder.join(JOB)).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix("// also: "));
    let pairs = lines.map(|line| line.split_once(' ').unwrap());
    pairs
        .map(|(machine, target)| (machine.to_owned(), target.to_owned()))
        .collect()
}

fn has_machine(outcome: &Outcome) -> bool {
    outcome.job.as_ref().is_some_and(|job| job.machine.is_some())
}

/// The files of a folder, by their paths within it.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            for (inner, bytes) in self::files(&path) {
                files.insert(format!("{name}/{inner}"), bytes);
            }
        } else {
            files.insert(name, fs::read(path).unwrap());
        }
    }
    files
}

/// The files that the job itself consists of.
fn sources(outcome: &Outcome) -> BTreeSet<String> {
    outcome
        .sources
        .iter()
        .map(|(_, file)| file.name.clone())
        .collect()
}

#[test]
fn jobs_come_out_as_they_did() {
    let updates = std::env::var_os("UPDATE_JOBS").is_some_and(|value| value == "1");
    let mut differences = Vec::new();
    for folder in folders() {
        let outcome = compiled(&folder);
        let products = products(&folder, &outcome);
        if updates {
            update(&folder, &products, &sources(&outcome));
        } else {
            differences.extend(compare(&folder, &products, &sources(&outcome)));
        }
    }
    assert!(
        differences.is_empty(),
        "{}\nset UPDATE_JOBS=1 to rewrite the files",
        differences.join("\n")
    );
}

fn update(folder: &Path, products: &BTreeMap<String, Vec<u8>>, sources: &BTreeSet<String>) {
    for name in files(folder).keys() {
        if !sources.contains(name) {
            fs::remove_file(folder.join(name)).unwrap();
        }
    }
    for (name, bytes) in products {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
}

/// What differs between a folder and what was made of its job.
fn compare(folder: &Path, products: &BTreeMap<String, Vec<u8>>, sources: &BTreeSet<String>) -> Vec<String> {
    let there = files(folder);
    let mut differences = Vec::new();
    for (name, made) in products {
        let path = folder.join(name);
        match there.get(name) {
            None => differences.push(format!("{} is missing", path.display())),
            Some(known) if known != made => {
                differences.push(format!("{} has changed:\n{}", path.display(), diff(known, made)));
            }
            Some(_) => {}
        }
    }
    let strays = there
        .keys()
        .filter(|&name| !products.contains_key(name) && !sources.contains(name));
    differences
        .extend(strays.map(|name| format!("{}: nothing makes or uses it", folder.join(name).display())));
    differences
}

/// Lines around the first difference: those that were there with `-`, those that are now with `+`.
fn diff(known: &[u8], made: &[u8]) -> String {
    const LINES: usize = 6;
    let [known, made] = [known, made].map(String::from_utf8_lossy);
    let [known, made] = [&known, &made].map(|text| text.split('\n').collect::<Vec<_>>());
    let same = known.iter().zip(&made).take_while(|(a, b)| a == b).count();
    let show = |sign: char, lines: &[&str]| -> Vec<String> {
        let shown = lines.iter().skip(same).take(LINES);
        shown
            .map(|line| format!("  {sign} {}", line.escape_debug()))
            .collect()
    };
    let place = format!("  line {}:", same + 1);
    [vec![place], show('-', &known), show('+', &made)]
        .concat()
        .join("\n")
}

#[test]
fn programs_say_what_was_planned() {
    for folder in folders() {
        let outcome = compiled(&folder);
        if has_machine(&outcome) {
            krl_text::check(&outcome, &emit(&outcome).unwrap());
        }
    }
}

#[test]
fn intermediate_programs_come_back_from_json() {
    for folder in folders() {
        let text = fs::read_to_string(folder.join("ir.json")).unwrap();
        let form: Exchange<'_> = serde_json::from_str(&text).unwrap();
        let compiled = compiled(&folder).compiled.unwrap();
        assert_eq!(
            &*form.program,
            compiled.program.verified().program(),
            "{}",
            folder.display()
        );
        let motion = compiled.program.reached().map(|reached| reached.program.motion());
        assert_eq!(form.motion.as_deref(), motion, "{}", folder.display());
    }
}

#[test]
fn compiling_again_gives_the_same_bytes() {
    for folder in folders() {
        let bundle = || -> Bundle {
            let outcome = compiled(&folder);
            if has_machine(&outcome) {
                emit(&outcome).unwrap()
            } else {
                Bundle::default()
            }
        };
        assert_eq!(bundle(), bundle(), "{}", folder.display());
    }
}

/// What the jobs are there to cover, as words.
fn subjects(outcome: &Outcome) -> BTreeSet<String> {
    let job = outcome.job.as_ref().unwrap();
    let mut subjects = BTreeSet::new();
    let auto = |name: &str, is_auto: bool| format!("{name} {}", if is_auto { "auto" } else { "given" });
    for asked in job.operations.iter().filter_map(|asked| RoughVcut::of(&**asked)) {
        subjects.extend([
            format!("{:?} {:?}", asked.blade.edges, asked.setup.direction().value),
            auto("lattice", asked.lattice.value == Auto::Auto),
            auto("order", asked.order.value == Auto::Auto),
            auto("sequence", asked.sequence.value == Auto::Auto),
            match asked.residual.value {
                Auto::Auto => "residual Auto".to_owned(),
                Auto::Given(residual) => format!("residual {residual:?}"),
            },
            auto("swing", asked.swing.value == Auto::Auto),
            auto("layer", asked.layer.value == Auto::Auto),
            auto("step", asked.step.value == Auto::Auto),
            auto("extension", asked.setup.extension().value == Auto::Auto),
            auto("standoff", asked.standoff.value == Auto::Auto),
        ]);
    }
    let planned = &outcome.plan.as_ref().unwrap().operations;
    for vcut in planned.iter().filter_map(|planned| PlannedVcut::of(&**planned)) {
        subjects.extend([
            format!("{:?} {:?}", vcut.parameters.lattice, vcut.order),
            format!("{:?} by {:?}", vcut.sequence, vcut.order),
        ]);
        subjects.extend(
            vcut.decisions
                .iter()
                .map(|decision| format!("{} compared", decision.field)),
        );
        for cut in &vcut.cuts {
            subjects.insert(match cut.origin {
                TipOrigin::Lattice => "tip on the lattice".to_owned(),
                TipOrigin::Given => "tip given".to_owned(),
                TipOrigin::Lifted => "tip lifted".to_owned(),
                TipOrigin::Shifted => "tip shifted".to_owned(),
                TipOrigin::Relieved => "tip relieved".to_owned(),
            });
        }
        for pair in vcut.cuts.windows(2) {
            if pair[0].layer == pair[1].layer && pair[1].way == Way::Over {
                subjects.insert(format!("over the safe plane, {:?}", vcut.order));
            }
        }
    }
    subjects
}

/// The jobs are few; this keeps them from losing what they are there for.
#[test]
fn jobs_cover_the_process() {
    let covered: BTreeSet<String> = folders()
        .iter()
        .flat_map(|folder| subjects(&compiled(folder)))
        .collect();
    let wanted = [
        "Orthogonal Point",
        "Orthogonal Layer",
        "Interlaced Point",
        "Interlaced Layer",
        "Free Point",
        "Double Alternate",
        "Double Forward",
        "Double Backward",
        "Single Alternate",
        "Single Forward",
        "residual Discard",
        "residual Lift",
        "residual Shift",
        "residual Mixed",
        "residual Auto",
        "residual compared",
        "lattice auto",
        "lattice compared",
        "order auto",
        "sequence auto",
        "sequence compared",
        "Rows by Point",
        "Rows by Layer",
        "Boustrophedon by Point",
        "Boustrophedon by Layer",
        "Nearest by Point",
        "swing auto",
        "swing given",
        "layer auto",
        "layer given",
        "step auto",
        "step given",
        "extension auto",
        "extension given",
        "standoff auto",
        "standoff given",
        "tip on the lattice",
        "tip given",
        "tip lifted",
        "tip shifted",
        "tip relieved",
        "over the safe plane, Point",
        "over the safe plane, Layer",
    ];
    let missing: Vec<_> = wanted
        .into_iter()
        .filter(|&subject| !covered.contains(subject))
        .collect();
    assert!(missing.is_empty(), "no job covers {missing:?}");
}
