//! A small operation that only this test has: `mark line`. It goes through every stage, every target, the read-back, the report and
//! the editor, and no stage knows of it: what an operation is, is said by the traits that it implements.

mod line;

use crate::lsp::editor::{Editor, uri};
use crate::own_operation;
use crate::repository::root;
use line::Line;
use serde_json::json;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::memory::Memory;
use vcutc::driver::{self, Outcome};
use vcutc::job::sema::kind::{Kind, Operations};
use vcutc::picture::Prefix;
use vcutc::registry;
use vcutc::report::page::Further;
use vcutc::report::{self, Material};
use vcutc_backend_api::bundle::Bundle;

const KNOWN: Operations = Operations(&[&vcutc::vcut::Vcut, &Line]);

fn job(depth: &str) -> String {
    format!(
        "job \"line\"\n\nuse \"shop/cells.vcut\"\nuse \"shop/blades.vcut\"\n\nstock {{ size = (85 mm, 50 mm, 50 mm) }}\n\n\
         profile {{ start (0 mm, 30 mm) line to (85 mm, 30 mm) }}\n\nmark line {{\n  blade = dagger\n  rake = 60 deg\n  \
         swing = 30 deg\n  at = 40 mm\n  depth = {depth}\n  extension = auto\n  \
         feed {{ cut = 100 mm/s, travel = 100 mm/s, reorient = 45 deg/s }}\n  clearance = 10 mm\n}}\n\n\
         cell {{ machine = large_cell }}\n"
    )
}

fn compiled(depth: &str, machine: &str) -> Outcome {
    own_operation::compiled(KNOWN, job(depth), machine)
}

/// A target for each machine; writing a program reads it again and compares it.
#[test]
fn goes_through_all_stages_and_targets() {
    for (machine, target) in [("large_cell", "krl"), ("abb_cell", "rapid"), ("gantry", "gcode")] {
        let outcome = compiled("3 mm", machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let compiled = outcome.compiled.as_ref().unwrap();
        // A groove 3 mm deep, as wide as its flanks of 30 deg are apart at the top.
        let groove = 9.0 * 30.0_f64.to_radians().tan();
        assert!((compiled.report.removed.to_mm2() - groove).abs() < 1e-3);
        assert!(compiled.summary.iter().any(|line| line.contains("3 mm deep")));
        let mut bundle = Bundle::default();
        driver::emit(&outcome, registry::backend(target).unwrap(), &mut bundle).unwrap();
        let files = bundle.files().iter();
        let texts: String = files.map(|(_, bytes)| String::from_utf8_lossy(bytes)).collect();
        assert!(texts.contains("operation 1: mark line with blade"), "{target}");
        let page = report::page::page(&outcome, Further::NOTHING).unwrap();
        assert!(page.contains("<caption>Line</caption>"));
        let drawn = report::pictures::lattice(&Material::of(&outcome).unwrap(), Prefix::new("p-"));
        assert!(drawn.contains("a line, 1 layer; 3 mm"));
    }
}

#[test]
fn a_line_into_the_part_is_refused_and_one_deeper_than_the_edge_is_not_proven() {
    let codes = |depth: &str| -> Vec<Code> {
        let outcome = compiled(depth, "large_cell");
        outcome
            .diagnostics
            .iter()
            .map(|diagnostic| diagnostic.code)
            .collect()
    };
    assert_eq!(codes("21 mm"), [Code::Overcut]);
    assert_eq!(codes("19 mm"), [Code::ChipNotFreed]);
}

#[test]
fn the_editor_knows_its_fields_and_what_was_chosen() {
    let shop = |name: &str| std::fs::read_to_string(root().join("examples/shop").join(name)).unwrap();
    let text = job("3 mm");
    let (cells, blades) = (shop("cells.vcut"), shop("blades.vcut"));
    let mut editor = Editor::knowing(
        KNOWN,
        &[
            ("line.vcut", &text),
            ("shop/cells.vcut", &cells),
            ("shop/blades.vcut", &blades),
            ("shop/gantry.toml", &shop("gantry.toml")),
            ("shop/knife_gantry.toml", &shop("knife_gantry.toml")),
        ],
    );
    editor.open("/shop/line.vcut");
    editor.settle();
    let task = editor.server.task().unwrap();
    let done = task.run(&editor.files, &registry::backends(), &mut Memory::none());
    let messages = editor.server.finish(done);
    editor.take(&messages);
    let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let params = json!({ "textDocument": { "uri": uri("/shop/line.vcut") }, "range": whole });
    let hints = editor.ask("textDocument/inlayHint", params).unwrap();
    // 10 mm of edge lean over the work by cos(60 deg - 7.13 deg), and `run_out` is 2 mm.
    assert_eq!(hints[0]["label"], "= 8.037 mm");
    let offers = editor
        .ask(
            "textDocument/completion",
            editor.at("/shop/line.vcut", "depth = 3 mm\n|"),
        )
        .unwrap();
    let offered = serde_json::to_string(&offers).unwrap();
    assert!(
        offered.contains("direction") && !offered.contains("lattice"),
        "{offered}"
    );
}

/// A job without operations is offered the first kind, with the fields that it must have.
#[test]
fn a_job_without_operations_is_offered_one() {
    let offered = Line.example("dagger");
    assert!(
        offered.starts_with("mark line {\n  blade = dagger\n"),
        "{offered}"
    );
    assert!(
        offered.contains("depth = 3 mm") && !offered.contains("direction"),
        "{offered}"
    );
}
