//! Programs that were changed: what `vcutc verify` reports of them.
//!
//! A case is a change of the program of `tests/verify/bench.vcut`, in the form of a diff: after the first
//! line, which names the codes that are expected, each block is some lines of the program, with `-` in front
//! of those that were taken out and `+` in front of those that were put in.

use crate::pipeline::{Files, compile, krl, numbers, rendered};
use crate::repository::{expected_codes, root};
use std::collections::BTreeSet;
use std::fs;
use vcutc::diagnostics::fix;
use vcutc::driver::{self, EmitFailure, Outcome};
use vcutc::readback::{Fresh, Reference, Verdict, Written};
use vcutc_backend_api::backend::{Backend, BackendIssue, Emission, EmitError, OptionSpec, Options};
use vcutc_backend_api::bundle::{Bundle, Sink};
use vcutc_backend_api::ir::Action;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{ProgramFile, Reader};
use vcutc_backend_api::verify::Capabilities;

const JOB: &str = "bench.vcut";

/// The job of all cases, compiled.
pub(crate) struct Bench {
    outcome: Outcome,
    written: Written,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self::of(&Files::of(root().join("tests/verify")))
    }

    fn of(files: &Files) -> Self {
        let outcome = compile(JOB, files);
        let written = driver::write(&outcome, krl()).unwrap().unwrap();
        Self { outcome, written }
    }

    fn files(&self) -> &[ProgramFile] {
        &self.written.files
    }

    /// What is reported of a program, with the texts that it points into.
    fn verify(&self, files: &[ProgramFile]) -> (Verdict, Outcome) {
        let (job, plan) = (self.outcome.job.as_ref(), self.outcome.plan.as_ref());
        let reached = self.outcome.compiled.as_ref().unwrap().program.reached();
        let fresh = Fresh::of(job, plan, reached, &self.written, krl().reader().unwrap()).unwrap();
        let mut sources = self.outcome.sources.clone();
        let verdict = Reference::new(fresh).verify(files, &[], &mut sources);
        let outcome = Outcome {
            sources,
            ..Outcome::default()
        };
        (verdict, outcome)
    }
}

/// The program of the bench with the blocks of a case applied.
fn changed(files: &[ProgramFile], case: &str) -> Vec<ProgramFile> {
    let mut files = files.to_vec();
    for block in case.split("\n\n").skip(1) {
        let lines = || block.lines().filter(|line| !line.is_empty());
        let side = |mark: char| {
            let kept = lines().filter(|line| line.starts_with([' ', mark]));
            kept.map(|line| format!("{}\r\n", &line[1..])).collect::<String>()
        };
        let (old, new) = (side('-'), side('+'));
        let file = files.iter_mut().find(|file| file.text.contains(&old));
        let file = file.unwrap_or_else(|| panic!("no file has these lines:\n{old}"));
        file.text = file.text.replacen(&old, &new, 1);
    }
    files
}

#[test]
fn changed_programs_are_explained() {
    let bench = Bench::new();
    let mut surprises = Vec::new();
    insta::glob!("../verify", "*.diff", |path| {
        let case = fs::read_to_string(path).unwrap();
        let (verdict, outcome) = bench.verify(&changed(bench.files(), &case));
        let messages = rendered(&verdict.diagnostics, &outcome);
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(format!("{case}\n{messages}{}", verdict.lines.join("\n")));
        });
        let found: BTreeSet<_> = numbers(&verdict.diagnostics).into_iter().collect();
        if found.into_iter().collect::<Vec<_>>() != expected_codes(&case) {
            surprises.push(format!("{}\n{messages}", path.display()));
        }
    });
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

/// With hardly any room, cuts that lie half a millimetre deeper take the body of the blade into the stock. They stay out of
/// the part.
#[test]
fn lowered_cuts_take_the_body_of_the_blade_into_the_stock() {
    let files = Files::of(root().join("tests/verify"));
    let job = fs::read_to_string(root().join("tests/verify").join(JOB)).unwrap();
    let edges = "edges          = double";
    let job = job.replace(edges, &format!("{edges}\n  body           (28.6 mm, 10 mm)"));
    let bench = Bench::of(&files.with(JOB, job));
    let (verdict, _) = bench.verify(bench.files());
    assert_eq!(numbers(&verdict.diagnostics), [""; 0]);
    let mut lowered = bench.files().to_vec();
    for file in &mut lowered {
        file.text = file.text.replace(",Z 8.000,A", ",Z 7.500,A");
    }
    let (verdict, outcome) = bench.verify(&lowered);
    let messages = rendered(&verdict.diagnostics, &outcome);
    let expected = "error[VC0709]: the body of `sabre` enters the stock by 0.4";
    assert!(messages.contains(expected), "{messages}");
    assert!(!messages.contains("enters the part"), "{messages}");
}

/// Nothing is wrong with the motions of such a program, and it is not cleared all the same.
#[test]
fn speeds_that_are_not_of_the_job_are_never_a_clearance() {
    let bench = Bench::new();
    let mut files = bench.files().to_vec();
    for file in &mut files {
        file.text = file.text.replace("$VEL.CP=0.2\r\n", "$VEL.CP=0.6\r\n");
    }
    let (verdict, _) = bench.verify(&files);
    let lines = verdict.lines.join("\n");
    assert!(
        numbers(&verdict.diagnostics)
            .iter()
            .all(|number| *number == "VC0705")
    );
    assert!(lines.contains("proven at the speeds it states"), "{lines}");
    assert!(
        lines.contains("24 cuts at 600 mm/s instead of 200 mm/s"),
        "{lines}"
    );
    assert!(lines.ends_with("or change the job and compile it"), "{lines}");
    let case = "\n\n-LIN {X 25.000,Y -14.314,Z 28.000,A 67.7923,B -20.7048,C -130.8934}";
    let (verdict, _) = bench.verify(&changed(bench.files(), case));
    let lines = verdict.lines.join("\n");
    assert!(!lines.contains("not those of the job"), "{lines}");
    assert!(lines.contains("the differences remain"), "{lines}");
}

/// What puts back a line leaves one difference less. What the program does may get worse on the way.
#[test]
fn fixes_of_changed_programs_mend() {
    let bench = Bench::new();
    insta::glob!("../verify", "*.diff", |path| {
        let case = fs::read_to_string(path).unwrap();
        let files = changed(bench.files(), &case);
        let (verdict, outcome) = bench.verify(&files);
        for diagnostic in &verdict.diagnostics {
            for offered in &diagnostic.fixes {
                let span = offered.edits[0].span;
                let source = outcome.sources.get(span.file).unwrap();
                let mut mended = files.clone();
                let file = mended.iter_mut().find(|file| file.text == source.text).unwrap();
                file.text = fix::apply(&source.text, span.file, &offered.edits).unwrap();
                let (after, _) = bench.verify(&mended);
                let differences = |verdict: &Verdict| {
                    let found = numbers(&verdict.diagnostics);
                    found.into_iter().filter(|number| *number <= "VC0707").count()
                };
                assert!(differences(&after) < differences(&verdict), "{}", path.display());
            }
        }
    });
}

#[test]
fn layout_and_comments_are_free() {
    let bench = Bench::new();
    let (same, _) = bench.verify(bench.files());
    assert_eq!(same.diagnostics, []);
    assert!(same.lines[1].contains("byte for byte"), "{:?}", same.lines);
    let mut files = bench.files().to_vec();
    for file in &mut files {
        file.text = file
            .text
            .replace("\r\n", "\n")
            .replace("LIN {X ", "lin  { X ")
            .replace(".000,", ".0,")
            .replace("; layer 1 cut 1", "; Schräg von Müller geprüft\n\n;");
    }
    assert_ne!(files, bench.files());
    let (other, outcome) = bench.verify(&files);
    assert_eq!(rendered(&other.diagnostics, &outcome), "");
    assert!(other.lines[1].contains("layout or comments"), "{:?}", other.lines);
}

#[test]
fn of_many_differences_the_first_are_reported_and_all_are_counted() {
    let bench = Bench::new();
    let mut files = bench.files().to_vec();
    files[0].text = files[0].text.replace("C 130.8934}", "C 130.8935}");
    let (verdict, _) = bench.verify(&files);
    let changed = verdict
        .diagnostics
        .iter()
        .filter(|found| found.code.number() == "VC0701");
    let changed: Vec<_> = changed.collect();
    assert_eq!(changed.len(), 20);
    let counted = changed[19]
        .notes
        .iter()
        .find(|note| note.contains("more differences"));
    assert!(counted.is_some(), "{:?}", changed[19].notes);
}

#[test]
fn a_program_that_has_nothing_to_do_with_the_job_comes_to_an_end() {
    let bench = Bench::new();
    let mut files = bench.files().to_vec();
    let head = files[0].text.split("PTP XVC_HOME").next().unwrap().to_owned();
    let lines: String = (0..200_000)
        .map(|i| format!("LIN {{X {i},Y 3,Z 9}}\r\n"))
        .collect();
    files[0].text = format!("{head}{lines}END\r\n");
    let (verdict, _) = bench.verify(&files);
    let found = numbers(&verdict.diagnostics);
    assert!(found.len() <= 30 && !found.is_empty(), "{found:?}");
}

/// The cuts of programs that are as planned enter nothing: what is looked at cut by cut agrees with the proof of whole Vs.
#[test]
fn no_slit_of_a_proven_program_enters_the_part() {
    use vcutc::simulation::slit::{deepest, edge};
    use vcutc_backend_api::ir::Action;
    for job in ["block_cui.vcut", "spoiler_naca2412.vcut", "wavy_panel.vcut"] {
        let outcome = compile(job, &Files::of(root().join("examples")));
        let (plan, compiled) = (outcome.plan.as_ref().unwrap(), outcome.compiled.as_ref().unwrap());
        let bounds = vcutc::process::verdict::bounds(plan);
        let program = compiled.program.verified().program();
        let mut cuts = 0;
        for segment in program.segments() {
            let op = segment.op;
            if let (Action::Cut { .. }, Some(line)) = (op.action, segment.line()) {
                let operation = usize::from(op.site.operation().unwrap().0);
                let blade = program.blade(segment.before.tool).unwrap().straight().unwrap();
                let edge = edge(blade, program.orientation(line.to.orientation).unwrap());
                assert_eq!(
                    deepest(&bounds[operation], edge, line.from.tip, line.to.tip),
                    None,
                    "{job}: {:?}",
                    op.site
                );
                cuts += 1;
            }
        }
        assert!(cuts > 50, "{job}");
    }
}

/// KRL with two digits of every file swapped.
struct Careless;

impl Backend for Careless {
    fn id(&self) -> &'static str {
        krl().id()
    }

    fn summary(&self) -> &'static str {
        krl().summary()
    }

    fn capabilities(&self) -> Capabilities {
        krl().capabilities()
    }

    fn options(&self) -> &'static [OptionSpec] {
        krl().options()
    }

    fn reader(&self) -> Option<&dyn Reader> {
        krl().reader()
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        Ok(Box::new(CarelessEmission(krl().check(program, options)?)))
    }
}

struct CarelessEmission<'p>(Box<dyn Emission + 'p>);

impl Emission for CarelessEmission<'_> {
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError> {
        let mut right = Bundle::default();
        self.0.write(&mut right)?;
        for (name, bytes) in right.files() {
            let wrong = String::from_utf8_lossy(bytes).replace("Y 34.314", "Y 43.314");
            sink.file(name)?;
            sink.write(wrong.as_bytes())?;
        }
        Ok(())
    }
}

#[test]
fn a_program_that_is_not_what_it_was_made_from_is_never_handed_on() {
    let bench = Bench::new();
    let mut taken = Bundle::default();
    let Err(EmitFailure::Diagnostics(diagnostics)) = driver::emit(&bench.outcome, &Careless, &mut taken)
    else {
        panic!("it was written");
    };
    assert_eq!(numbers(&diagnostics), ["VC0901"]);
    assert_eq!(taken.files(), []);
    insta::with_settings!({ omit_expression => true }, {
        insta::assert_snapshot!(rendered(&diagnostics, &bench.outcome));
    });
}

#[test]
fn every_op_has_its_place_in_the_text() {
    let bench = Bench::new();
    let program = bench
        .outcome
        .compiled
        .as_ref()
        .unwrap()
        .program
        .verified()
        .program();
    let places = bench.written.places.as_ref().unwrap();
    assert_eq!(places.len(), program.ops.len());
    for (op, place) in program.ops.iter().zip(places) {
        let text = &bench.files()[place.file as usize].text[place.start as usize..place.end as usize];
        let word = match op.action {
            Action::Home | Action::ChangePlace | Action::AxisTravel { .. } => "PTP ",
            Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } => "LIN ",
            Action::Cut { .. } | Action::Follow { .. } | Action::Turn { .. } => "LIN {",
            Action::Ultrasonic { .. } => "$OUT[12]=",
            Action::AwaitReady | Action::Dwell { .. } => "WAIT SEC ",
            Action::Spin { .. } | Action::ToolChange { .. } => "none",
        };
        assert!(text.starts_with(word), "{op:?} at {text}");
    }
}
