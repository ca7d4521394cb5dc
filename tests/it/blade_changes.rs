//! Programs that change the blade, through the whole compiler: what `vcutc verify` reports of changed ones, and which frame the
//! axes are computed for.

use crate::pipeline::{Files, compile_on};
use crate::repository::root;
use vcutc::diagnostics::has_errors;
use vcutc::driver::{self, Outcome};
use vcutc::machine::kinematics::pose::Pose;
use vcutc::motion::rig::Rig;
use vcutc::readback::{Fresh, Reference, Written};
use vcutc::registry;
use vcutc_backend_api::ir::{Action, ToolId};
use vcutc_backend_api::readback::ProgramFile;

const JOB: &str = "job.vcut";

/// The machines of the job, each with its target.
const CELLS: [(&str, &str); 3] = [("bench", "krl"), ("hall", "rapid"), ("gantry", "gcode")];

fn files() -> Files {
    Files::of(root().join("tests/jobs/two_tools"))
}

struct Bench {
    target: &'static str,
    outcome: Outcome,
    written: Written,
}

impl Bench {
    fn new(machine: &str, target: &'static str) -> Self {
        Self::of(&files(), machine, target)
    }

    fn of(files: &Files, machine: &str, target: &'static str) -> Self {
        let outcome = compile_on(Some(machine), JOB, files);
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        Self {
            target,
            outcome,
            written,
        }
    }

    /// Whether verification finds nothing wrong in a program.
    fn is_clear(&self, files: &[ProgramFile]) -> bool {
        let (job, plan) = (self.outcome.job.as_ref(), self.outcome.plan.as_ref());
        let reached = self.outcome.compiled.as_ref().unwrap().program.reached();
        let reader = registry::backend(self.target).unwrap().reader().unwrap();
        let fresh = Fresh::of(job, plan, reached, &self.written, reader).unwrap();
        let mut sources = self.outcome.sources.clone();
        let verdict = Reference::new(fresh).verify(files, &[], &mut sources);
        !has_errors(&verdict.diagnostics)
    }

    /// The program with one text in the place of another, wherever it stands.
    fn edited(&self, from: &str, to: &str) -> Vec<ProgramFile> {
        let mut files = self.written.files.clone();
        let has_it = files.iter().any(|file| file.text.contains(from));
        assert!(has_it, "{}: {from}", self.target);
        for file in &mut files {
            file.text = file.text.replace(from, to);
        }
        files
    }
}

#[test]
fn a_program_as_it_was_written_is_clear() {
    for (machine, target) in CELLS {
        let bench = Bench::new(machine, target);
        assert!(bench.is_clear(&bench.written.files), "{target}");
    }
}

#[test]
fn changes_that_were_edited_are_found() {
    let edits: [&[(&str, &str)]; 3] = [
        &[
            // Dropped, of another tool, elsewhere; another frame, another load, none.
            ("CHANGE_TOOL(2)\r\n", ""),
            ("CHANGE_TOOL(2)", "CHANGE_TOOL(1)"),
            ("CHANGE_TOOL(2)", "CHANGE_TOOL(3)"),
            ("CHANGE_TOOL(2)", "HALT"),
            ("PTP XVC_CHANGE\r\n", ""),
            ("PTP XVC_CHANGE", "PTP XVC_HOME"),
            ("XVC_CHANGE={A1 60.0", "XVC_CHANGE={A1 61.0"),
            ("BAS (#TOOL,2 )", "BAS (#TOOL,1 )"),
            ("BAS (#TOOL,2 )\r\n", ""),
            ("$LOAD=LOAD_DATA[2]", "$LOAD=LOAD_DATA[1]"),
            ("$LOAD=LOAD_DATA[2]\r\n", ""),
        ],
        &[
            ("    Stop;\r\n", ""),
            ("MoveAbsJ vc_change", "MoveAbsJ vc_home"),
            ("vc_change:=[[60.0", "vc_change:=[[61.0"),
            (",vc_tool2\\WObj", ",vc_tool\\WObj"),
            ("vc_tool2:=[TRUE,[[5.000", "vc_tool2:=[TRUE,[[5.100"),
            (
                "vc_tool2:=[TRUE,[[5.000,0.000,280",
                "vc_tool2:=[TRUE,[[0.000,0.000,310",
            ),
            ("],[13.0,[", "],[14.5,["),
        ],
        &[
            ("T2 M6\n", ""),
            ("T2 M6", "T1 M6"),
            ("T2 M6", "M0"),
            ("T2 M6", "M6"),
            ("T2 M6", "T2"),
            ("G43 H2", "G43 H1"),
            ("G43 H2\n", ""),
            ("G53 G1 X0.000 Y0.000 Z0.000", "G53 G1 X1.000 Y0.000 Z0.000"),
        ],
    ];
    for ((machine, target), edits) in CELLS.into_iter().zip(edits) {
        let bench = Bench::new(machine, target);
        for (from, to) in edits {
            assert!(
                !bench.is_clear(&bench.edited(from, to)),
                "{target}: {from} -> {to}"
            );
        }
    }
}

/// Each part of a program states the tool that is at hand when it begins.
#[test]
fn a_part_that_begins_with_another_tool_is_found() {
    let cells = std::fs::read_to_string(root().join("tests/jobs/two_tools/cells.vcut")).unwrap();
    let in_parts = cells.replacen("krl        {", "krl {\n    lines_per_part = 60", 1);
    assert_ne!(cells, in_parts);
    let bench = Bench::of(&files().with("cells.vcut", in_parts), "bench", "krl");
    assert!(bench.is_clear(&bench.written.files));
    let tools = ["BAS (#TOOL,1 )", "BAS (#TOOL,2 )"];
    let states = |file: &ProgramFile| tools.map(|tool| file.text.matches(tool).count());
    let parts: Vec<usize> = (0..bench.written.files.len())
        .filter(|&index| matches!(states(&bench.written.files[index]), [1, 0] | [0, 1]))
        .collect();
    assert!(parts.len() > 2, "{parts:?}");
    for index in parts {
        let mut files = bench.written.files.clone();
        let [from, to] = match states(&files[index]) {
            [1, _] => tools,
            _ => [tools[1], tools[0]],
        };
        files[index].text = files[index].text.replace(from, to);
        assert!(!bench.is_clear(&files), "{}", files[index].name);
    }
}

/// The axes hold each blade's own frame where the op says, by a rig of that frame alone; with the other one the tip would be
/// elsewhere.
#[test]
fn the_axes_are_those_of_the_blade_at_hand() {
    for (machine, _) in CELLS {
        let outcome = compile_on(Some(machine), JOB, &files());
        let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
        let reached = &outcome
            .compiled
            .as_ref()
            .unwrap()
            .program
            .reached()
            .unwrap()
            .program;
        let program = reached.program();
        let cell = program.cell.as_ref().unwrap();
        let rig = |tool: ToolId| Rig::new(model, cell.tools.at(tool).frame.frame, cell.base.frame);
        let rigs = [rig(ToolId(0)), rig(ToolId(1))];
        let change = program
            .ops
            .iter()
            .position(|op| matches!(op.action, Action::ToolChange { .. }));
        let mut poses = [0, 0];
        for (index, (segment, end)) in program.segments().zip(&reached.motion().ends).enumerate() {
            let Some(pose) = segment.target() else {
                continue;
            };
            let own = usize::from(index > change.unwrap());
            poses[own] += 1;
            let should = Pose::from(program.frame(pose).unwrap());
            let off = |rig: &Rig<'_>| rig.blade_in_work(&end.0).apart(&should).0;
            assert!(off(&rigs[own]) < 1e-5, "{machine} {index}: {}", off(&rigs[own]));
            assert!(off(&rigs[1 - own]) > 1.0, "{machine} {index}");
        }
        assert!(poses.iter().all(|count| *count > 20), "{poses:?}");
    }
}

/// The second blade is turned half round in its holder. Axis 6, which turns by less than that, cannot hold both blades in one branch.
#[test]
fn the_branch_changes_with_the_blade() {
    let read = |path: &str| std::fs::read_to_string(root().join(path)).unwrap();
    let instead = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    };
    let sheet = instead(
        &read("src/machine/robots/kuka/kr10_r1100_2.toml"),
        "[-185.0, 185.0], [-120.0, 120.0], [-350.0, 350.0]",
        "[-350.0, 350.0], [-120.0, 120.0], [-130.0, 130.0]",
    );
    let cells = read("tests/jobs/two_tools/cells.vcut");
    let cells = instead(&cells, "kuka/kr10_r1100_2", "narrow.toml");
    let cells = instead(&cells, "z = 280 mm, a = 30 deg", "z = 280 mm, a = 210 deg");
    let files = files().with("cells.vcut", cells).with("narrow.toml", sheet);
    let bench = Bench::of(&files, "bench", "krl");
    assert!(bench.is_clear(&bench.written.files));
    let reached = bench
        .outcome
        .compiled
        .as_ref()
        .unwrap()
        .program
        .reached()
        .unwrap();
    let ops = &reached.program.program().ops;
    let change = ops
        .iter()
        .position(|op| matches!(op.action, Action::ToolChange { .. }));
    let [first, second] = reached.report.stretches[..] else {
        panic!("{:?}", reached.report.stretches)
    };
    assert_ne!(first.branch, second.branch);
    // At the change itself, or on the way from it.
    let begins = usize::try_from(second.from.0).unwrap();
    let change = change.unwrap();
    assert!((change..=change + 2).contains(&begins), "{begins} and {change}");
}
