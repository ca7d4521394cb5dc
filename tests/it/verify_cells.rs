//! What `vcutc verify` reports of changed programs on all kinds of machines: KRL, RAPID and G-code say the
//! same edit in different ways, and the same has to be reported of it.

use crate::pipeline::{Files, compile_on, numbers};
use crate::repository::root;
use std::fs;
use vcutc::diagnostics::Diagnostic;
use vcutc::driver::{self, Outcome};
use vcutc::readback::{Fresh, Reference, Verdict, Written};
use vcutc::registry;
use vcutc_backend_api::readback::ProgramFile;

const JOB: &str = "fairing.vcut";
const CELLS: &str = "shop/cells.vcut";

/// The machines of the shop, with their targets.
const MACHINES: [(&str, &str); 3] = [("large_cell", "krl"), ("abb_cell", "rapid"), ("gantry", "gcode")];

/// A job on a machine, compiled and written.
struct Cell {
    target: &'static str,
    outcome: Outcome,
    written: Written,
}

impl Cell {
    fn new(machine: &str, target: &'static str) -> Self {
        Self::with(machine, target, "")
    }

    /// With an option of the target.
    fn with(machine: &str, target: &'static str, option: &str) -> Self {
        let folder = root().join("examples");
        let cells = fs::read_to_string(folder.join(CELLS)).unwrap();
        let block = format!("  {target} {{");
        assert!(cells.contains(&block), "{cells}");
        let cells = cells.replace(&block, &format!("{block}\n{option}"));
        // The cuts that the edits are made to, whatever `auto` would make of them.
        let job = fs::read_to_string(folder.join(JOB)).unwrap();
        let fixed = [
            ("lattice   = auto", "lattice = orthogonal"),
            ("swing     = auto", "swing = 35 deg"),
            ("layer     = auto", "layer = 3.488 mm"),
            ("step      = auto", "overlap = 0 %"),
            (
                "residual  = auto",
                "residual = lift\n  order = point\n  sequence = rows",
            ),
        ];
        let job = fixed
            .into_iter()
            .fold(job, |job, (open, given)| job.replace(open, given));
        let outcome = compile_on(
            Some(machine),
            JOB,
            &Files::of(folder).with(CELLS, cells).with(JOB, job),
        );
        let written = driver::write(&outcome, registry::backend(target).unwrap())
            .unwrap()
            .unwrap();
        Self {
            target,
            outcome,
            written,
        }
    }

    fn files(&self) -> &[ProgramFile] {
        &self.written.files
    }

    /// What is reported of a program, and what its messages point at in the job's files.
    fn verify(&self, files: &[ProgramFile]) -> (Verdict, Vec<String>) {
        let reader = registry::backend(self.target).unwrap().reader().unwrap();
        let (job, plan) = (self.outcome.job.as_ref(), self.outcome.plan.as_ref());
        let reached = self.outcome.compiled.as_ref().unwrap().program.reached();
        let fresh = Fresh::of(job, plan, reached, &self.written, reader).unwrap();
        let mut sources = self.outcome.sources.clone();
        let verdict = Reference::new(fresh).verify(files, &[], &mut sources);
        let labels = verdict.diagnostics.iter().flat_map(|found| &found.secondary);
        let pointed = labels.map(|label| {
            let source = sources.get(label.span.file).unwrap();
            source.text[label.span.start as usize..label.span.end as usize].to_owned()
        });
        let pointed = pointed.collect();
        (verdict, pointed)
    }

    /// The program with one text in it replaced, once.
    fn changed(&self, from: &str, to: &str) -> Vec<ProgramFile> {
        let mut files = self.files().to_vec();
        let file = files.iter_mut().find(|file| file.text.contains(from)).unwrap();
        file.text = file.text.replacen(from, to, 1);
        files
    }
}

fn differences(verdict: &Verdict) -> Vec<&Diagnostic> {
    let found = verdict.diagnostics.iter();
    found.filter(|found| found.code.number() <= "VC0707").collect()
}

/// One setting that cannot be understood any more takes the meaning from all that depends on it.
#[test]
fn one_changed_setting_is_one_difference() {
    for ((machine, target), (from, to, field)) in MACHINES.into_iter().zip([
        ("$LOAD={M 14.5", "$LOAD={M 12.5", "load(mass = 14.5 kg"),
        ("[14.5,[", "[12.5,[", "load(mass = 14.5 kg"),
        ("\nG54", "\nG55", "machine gantry"),
    ]) {
        let cell = Cell::new(machine, target);
        let (verdict, pointed) = cell.verify(&cell.changed(from, to));
        assert_eq!(
            numbers(&verdict.diagnostics),
            ["VC0705", "VC0711"],
            "{target}: {verdict:?}"
        );
        assert!(
            pointed.iter().any(|text| text.starts_with(field)),
            "{target}: {pointed:?}"
        );
        let notes = &verdict.diagnostics[0].notes;
        assert!(
            notes.iter().any(|note| note.contains("depend on it")),
            "{target}: {notes:?}"
        );
    }
}

#[test]
fn a_lowered_tip_is_one_difference_and_enters_the_part() {
    for ((machine, target), (from, to)) in MACHINES.into_iter().zip([
        (
            "LIN {X 5.458,Y 188.350,Z 66.512",
            "LIN {X 5.458,Y 188.350,Z 6.512",
        ),
        ("MoveL [[5.458,188.350,66.512]", "MoveL [[5.458,188.350,6.512]"),
        ("G1 X5.458 Y188.350 Z66.512", "G1 X5.458 Y188.350 Z6.512"),
    ]) {
        let cell = Cell::new(machine, target);
        let (verdict, _) = cell.verify(&cell.changed(from, to));
        let found = differences(&verdict);
        assert_eq!(found.len(), 1, "{target}: {found:?}");
        assert_eq!(found[0].code.number(), "VC0701");
        assert!(verdict.diagnostics.len() > 1, "{target}: nothing wrong with it");
    }
}

#[test]
fn a_dropped_motion_is_reported() {
    for (machine, target) in MACHINES {
        let cell = Cell::new(machine, target);
        let mut files = cell.files().to_vec();
        let of = |line: &str| line.contains("5.458") && line.contains("188.350");
        let file = files.iter_mut().find(|file| file.text.lines().any(of)).unwrap();
        let at = file.text.lines().position(of).unwrap();
        let kept = file.text.lines().enumerate().filter(|(line, _)| *line != at);
        file.text = kept.map(|(_, line)| format!("{line}\r\n")).collect();
        let (verdict, _) = cell.verify(&files);
        let found = differences(&verdict);
        assert!(
            found.iter().any(|found| found.code.number() == "VC0702"),
            "{target}: {found:?}"
        );
    }
}

#[test]
fn files_that_were_not_given_are_named() {
    for ((machine, target), absent) in MACHINES.into_iter().zip([".dat", ".pgf", ""]) {
        let cell = Cell::with(
            machine,
            target,
            if absent.is_empty() {
                "lines_per_part = 500"
            } else {
                ""
            },
        );
        let mut files = cell.files().to_vec();
        let left_out = files
            .iter()
            .rposition(|file| file.name.ends_with(absent))
            .unwrap();
        let left_out = files.remove(left_out);
        let (verdict, _) = cell.verify(&files);
        assert_eq!(numbers(&verdict.diagnostics), ["VC0702"], "{target}: {verdict:?}");
        let message = &verdict.diagnostics[0].message;
        assert!(
            message.contains(&left_out.name) && message.contains("not given"),
            "{message}"
        );
    }
}

/// The order in which the files of a program are named says nothing about it.
#[test]
fn the_order_of_files_makes_no_difference() {
    for (machine, target) in [("abb_cell", "rapid"), ("gantry", "gcode")] {
        let cell = Cell::with(machine, target, "lines_per_part = 100");
        assert!(cell.files().len() > 2, "{target}");
        let mut files = cell.files().to_vec();
        files.reverse();
        let (verdict, _) = cell.verify(&files);
        assert_eq!(verdict.diagnostics, [], "{target}");
    }
}
