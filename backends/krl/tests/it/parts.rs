//! Programs in parts.

use crate::support::expected::{self, Rounding, compare};
use crate::support::reader::{self, Event};
use crate::support::{emit, lines, reachable, status};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{Action, Edges};
use vcutc_backend_api::testkit::{Recipe, samples};

fn limit(lines: u32) -> [(&'static str, OptionValue); 1] {
    [("lines_per_part", OptionValue::Integer(lines))]
}

/// Lines between the setup and `END`, which is what the option counts.
fn body(bundle: &Bundle, module: &str) -> Vec<String> {
    let lines = lines(bundle, &format!("{module}.src"));
    let start = lines.iter().position(|line| line == ";ENDFOLD (SETUP)").unwrap() + 1;
    lines[start..lines.len() - 1].to_vec()
}

fn part_names(bundle: &Bundle) -> Vec<String> {
    bundle
        .files()
        .iter()
        .filter_map(|(name, _)| name.strip_suffix(".src"))
        .skip(1)
        .map(str::to_owned)
        .collect()
}

#[test]
fn a_program_is_split_one_line_beyond_the_limit_and_not_before() {
    let program = reachable(Recipe::default().program());
    let whole = emit(&program, &limit(0));
    let length = u32::try_from(body(&whole, "sample").len()).unwrap();
    for (lines, files) in [(length + 1, 2), (length, 2), (length - 1, 6)] {
        assert_eq!(
            emit(&program, &limit(lines)).files().len(),
            files,
            "limit {lines}"
        );
    }
}

#[test]
fn parts_keep_to_the_limit_and_begin_with_another_cut() {
    for (name, program) in samples().unwrap() {
        let whole = emit(&program, &limit(0));
        for lines in [25, 40] {
            let bundle = emit(&program, &limit(lines));
            if bundle.files().len() == whole.files().len() {
                continue;
            }
            for part in part_names(&bundle) {
                // What a part repeats at its start comes on top: a pose, an output, a wait.
                let length = body(&bundle, &part).len();
                assert!(length <= lines as usize + 3, "{name} {part}: {length}");
            }
        }
    }
}

#[test]
fn parts_together_do_what_the_whole_does() {
    for (name, program) in samples().unwrap() {
        for lines in [1, 7, 20, 33] {
            let bundle = emit(&program, &limit(lines));
            let main = bundle.files()[0].0.trim_end_matches(".src");
            let got = reader::run(&bundle, main).unwrap();
            compare(
                &got,
                &expected::steps(&program, &status),
                Rounding::of_decimals(3),
            )
            .unwrap_or_else(|problem| panic!("{name}, {lines} lines: {problem}"));
        }
    }
}

#[test]
fn the_flanks_of_a_v_stay_together() {
    let program = reachable(Recipe::default().program());
    let bundle = emit(&program, &limit(1));
    let parts = part_names(&bundle);
    assert_eq!(parts.len(), 8, "home, the way to the stock, and six cuts");
    for part in parts.iter().skip(2) {
        let cuts: Vec<String> = body(&bundle, part)
            .into_iter()
            .filter(|line| line.starts_with("; layer"))
            .collect();
        assert_eq!(cuts.len(), 1, "{part}: {cuts:?}");
    }
}

#[test]
fn the_way_back_through_the_air_does_not_part_the_flanks_of_a_v() {
    let recipe = Recipe {
        edges: Edges::Single,
        ..Recipe::default()
    };
    let bundle = emit(&reachable(recipe.program()), &limit(1));
    for part in part_names(&bundle).iter().skip(2) {
        let body = body(&bundle, part);
        let feeds = body.iter().filter(|line| *line == "$VEL.CP=0.2").count();
        assert_eq!(feeds, 2, "{part}: {body:?}");
    }
}

#[test]
fn a_part_sets_everything_up_again() {
    let program = reachable(Recipe::default().program());
    let bundle = emit(&program, &limit(30));
    let setup = |module: &str| {
        let lines = lines(&bundle, &format!("{module}.src"));
        let start = lines.iter().position(|line| line == ";FOLD INI").unwrap();
        let end = lines.iter().position(|line| line == ";ENDFOLD (SETUP)").unwrap();
        lines[start..end].to_vec()
    };
    let parts = part_names(&bundle);
    assert!(parts.len() > 1);
    for part in &parts {
        assert_eq!(setup(part), setup(&parts[0]));
    }
}

#[test]
fn a_part_alone_starts_from_a_known_pose_with_the_blade_vibrating() {
    let program = reachable(Recipe::default().program());
    let bundle = emit(&program, &limit(30));
    for part in part_names(&bundle).iter().skip(1) {
        let body = body(&bundle, part);
        let place = |start: &str| body.iter().position(|line| line.starts_with(start)).unwrap();
        let (pose, output, motion) = (place("PTP {X "), place("$OUT[12]=TRUE"), place("LIN"));
        assert!(pose < output && output < motion, "{body:?}");
        assert!(place("$VEL.CP") < motion && place("$VEL.ORI1") < motion && place("$VEL.ORI2") < motion);
        assert_eq!(body[output + 1], "WAIT SEC 0.5");
    }
}

#[test]
fn parts_are_declared_for_old_releases() {
    let program = reachable(Recipe::default().program());
    let values = [
        ("lines_per_part", OptionValue::Integer(30)),
        ("declare_parts", OptionValue::Choice("yes")),
    ];
    let bundle = emit(&program, &values);
    let main = lines(&bundle, "sample.src");
    for part in part_names(&bundle) {
        let declared = main
            .iter()
            .position(|line| *line == format!("EXT {part}( )"))
            .unwrap();
        let init = main.iter().position(|line| line.starts_with("BAS")).unwrap();
        let called = main
            .iter()
            .position(|line| *line == format!("{part}( )"))
            .unwrap();
        assert!(declared < init && init < called);
    }
}

#[test]
fn the_main_program_calls_each_part_once_in_order() {
    let program = reachable(Recipe::default().program());
    let bundle = emit(&program, &limit(20));
    let called: Vec<String> = reader::run(&bundle, "sample")
        .unwrap()
        .into_iter()
        .filter_map(|event| match event {
            Event::Module(name) => Some(name),
            _ => None,
        })
        .skip(1)
        .collect();
    assert_eq!(called, part_names(&bundle));
    assert_eq!(called[0], "sample_p001");
}

#[test]
fn a_part_that_begins_while_the_generator_starts_does_not_wait_for_it_early() {
    let mut program = Recipe::default().program();
    let ready = program
        .ops
        .iter()
        .position(|op| op.action == Action::AwaitReady)
        .unwrap();
    assert!(matches!(program.ops[ready + 1].action, Action::Travel { .. }));
    program.ops.swap(ready, ready + 1);
    let program = reachable(program);
    let bundle = emit(&program, &limit(1));
    let got = reader::run(&bundle, "sample").unwrap();
    compare(
        &got,
        &expected::steps(&program, &status),
        Rounding::of_decimals(3),
    )
    .unwrap();
    let body = body(&bundle, "sample_p003");
    let output = body.iter().position(|line| line == "$OUT[12]=TRUE").unwrap();
    let after = body[output + 1..].iter().find(|line| !line.starts_with(';'));
    assert!(after.unwrap().starts_with("LIN"), "{body:?}");
}
