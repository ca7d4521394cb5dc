//! The test programs that every dialect should be covered by, one by one.

use crate::support::{cell, emit, lines, one_cut, reachable, recipe};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{AxisValues, Edges, Maker, Ready, Stock};
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::testkit::{CellRecipe, Passes, Recipe, conformance, samples_for};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_rapid::Rapid;

/// The instructions of the main module, without what stands in front of them.
fn code(bundle: &Bundle) -> Vec<String> {
    let main = lines(bundle, &bundle.files()[0].0).into_iter();
    main.map(|line| line.trim().to_owned())
        .filter(|line| !line.starts_with('!'))
        .collect()
}

/// Positions, quaternions and confdata of all straight moves.
fn targets(bundle: &Bundle) -> Vec<[Vec<f64>; 3]> {
    let files = bundle.files().iter().filter(|(name, _)| name.ends_with(".mod"));
    files
        .flat_map(|(name, _)| lines(bundle, name))
        .filter_map(|line| {
            let target = line.trim().strip_prefix("MoveL [")?.to_owned();
            let mut parts = target.split("],[").map(numbers_of);
            Some([parts.next()?, parts.next()?, parts.next()?])
        })
        .collect()
}

fn numbers_of(part: &str) -> Vec<f64> {
    let inner = part.trim_start_matches('[');
    inner
        .split([',', ']'])
        .map_while(|number| number.parse().ok())
        .collect()
}

#[test]
fn the_backend_keeps_the_promises_of_all_backends() {
    assert_eq!(conformance(&Rapid, &samples_for(Maker::Abb).unwrap()), Ok(()));
}

#[test]
fn a_program_without_any_op_is_still_a_module_with_an_entry() {
    let mut program = recipe().program();
    program.ops.clear();
    let code = code(&emit(&reachable(program), &[]));
    let modes = ["ConfJ\\On;", "ConfL\\On;", "SingArea\\Off;"];
    assert_eq!(code[..3], ["MODULE sample", "", "PROC main()"]);
    assert_eq!(code[3..6], modes);
    assert_eq!(code[6..], ["ENDPROC", "ENDMODULE"]);
}

#[test]
fn an_empty_list_of_cuts_only_goes_home() {
    let recipe = Recipe {
        layers: 0,
        ..recipe()
    };
    let code = code(&emit(&reachable(recipe.program()), &[]));
    let moves: Vec<_> = code.iter().filter(|line| line.starts_with("Move")).collect();
    assert_eq!(
        moves,
        ["MoveAbsJ vc_home\\NoEOffs,vc_axes,fine,vc_tool\\WObj:=vc_wobj;"]
    );
}

#[test]
fn one_cut_turns_about_the_still_tip_and_comes_back() {
    let targets = targets(&emit(&reachable(one_cut().program()), &[]));
    let tips: Vec<&Vec<f64>> = targets.iter().map(|target| &target[0]).collect();
    let [_, front, back, turned, returned, away] = tips.as_slice() else {
        panic!("{tips:?}");
    };
    assert_eq!((back, front), (turned, returned));
    assert!(front[1] < 0.0 && back[1] > 50.0 && away[2] > 50.0);
}

/// Turns of 90 deg and more of a wrist axis have points on the way, with the confdata of each.
#[test]
fn far_turns_of_the_wrist_are_taken_apart() {
    let recipe = Recipe {
        swing: Angle::deg(60.0),
        rake: Angle::deg(89.0),
        ..one_cut()
    };
    let program = reachable(recipe.program());
    let waypoints = program.motion().waypoints.len();
    assert!(waypoints > 0);
    let targets = targets(&emit(&program, &[]));
    assert_eq!(targets.len(), 6 + waypoints);
    let quarters: Vec<f64> = targets.iter().map(|target| target[2][2]).collect();
    assert!(
        quarters.windows(2).all(|pair| (pair[0] - pair[1]).abs() <= 1.0),
        "{quarters:?}"
    );
}

#[test]
fn confdata_distinguishes_full_turns() {
    let conf = |home: [f64; 6]| {
        let cell = CellRecipe {
            home: AxisValues(home.map(f64::to_radians)),
            ..cell()
        };
        targets(&emit(&reachable(Recipe { cell, ..one_cut() }.program()), &[]))[0][2].clone()
    };
    let near = conf([0.0, -90.0, 90.0, 0.0, 45.0, 0.0]);
    let far = conf([0.0, -90.0, 90.0, -340.0, 45.0, -340.0]);
    assert_eq!((far[1], far[2]), (near[1] - 4.0, near[2] - 4.0));
    assert_eq!(far[3], near[3]);
}

#[test]
fn the_generator_runs_before_the_first_cut_and_stops_after_the_last() {
    let recipe = Recipe {
        cell: CellRecipe {
            ready: Ready::Input(7),
            ..cell()
        },
        ..one_cut()
    };
    let values = [
        ("ultrasonic_signal", OptionValue::Text("doKnife".to_owned())),
        ("ready_signal", OptionValue::Text("diKnife".to_owned())),
    ];
    let code = code(&emit(&reachable(recipe.program()), &values));
    let place = |wanted: &str| code.iter().position(|line| line == wanted).unwrap();
    let first = code.iter().position(|line| line.starts_with("MoveL")).unwrap();
    let last = code.iter().rposition(|line| line.starts_with("MoveL")).unwrap();
    assert!(place("SetDO doKnife,1;") < place("WaitDI diKnife,1;"));
    assert!(place("WaitDI diKnife,1;") < first && last < place("SetDO doKnife,0;"));
}

#[test]
fn the_longest_name_is_kept_and_a_longer_one_is_cut() {
    for (name, module) in [
        ("rib_of_23_letters_in_all", "rib_of_23_letters_xfqj"),
        ("a_name_of_23_characters", "a_name_of_23_characters"),
        ("Flügel 7", "Fl_gel_7"),
        ("MoveL", "job_MoveL"),
        ("vc_tool", "job_vc_tool_2"),
        ("7th", "job_7th"),
    ] {
        let recipe = Recipe {
            name: name.to_owned(),
            ..one_cut()
        };
        let bundle = emit(&reachable(recipe.program()), &[]);
        assert_eq!(bundle.files()[0].0, format!("{module}.mod"));
    }
}

#[test]
fn the_largest_and_smallest_coordinates_are_written_out() {
    let recipe = Recipe {
        stock: Stock {
            width: Length::mm(85.0),
            depth: Length::mm(9000.0),
            height: Length::mm(9000.0),
        },
        step: Length::mm(0.002),
        clearance: Length::mm(900.0),
        edges: Edges::Single,
        passes: Passes::Layer,
        ..one_cut()
    };
    let targets = targets(&emit(&reachable(recipe.program()), &[]));
    let largest = targets
        .iter()
        .flat_map(|target| &target[0])
        .copied()
        .fold(0.0, f64::max);
    assert!(largest > 9900.0, "{largest}");
    assert!(targets.iter().any(|target| (target[0][0] - 0.001).abs() < 1e-9));
}

/// One move more than fits into a part makes two parts; one less does not.
#[test]
fn programs_are_split_at_the_limit() {
    let program = reachable(recipe().program());
    let files = |lines: u32| {
        emit(&program, &[("lines_per_part", OptionValue::Integer(lines))])
            .files()
            .len()
    };
    let longest = (1..200).find(|&lines| files(lines) == 2).unwrap();
    assert_eq!(files(longest - 1), 4, "main, two parts and the list");
}

#[test]
fn every_cut_has_its_comment() {
    let recipe = Recipe {
        layers: 2,
        cuts: 2,
        ..recipe()
    };
    let lines = lines(&emit(&reachable(recipe.program()), &[]), "sample.mod");
    let headings: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.trim().strip_prefix("! layer "))
        .collect();
    assert_eq!(headings, ["1 cut 1", "1 cut 2", "2 cut 1", "2 cut 2"]);
}

#[test]
fn corners_are_rounded_only_when_asked_for_and_only_in_the_air() {
    let rounded = |values: &[(&str, OptionValue)]| {
        let code = code(&emit(&reachable(recipe().program()), values));
        code.iter().filter(|line| line.contains(",vc_zone,")).count()
    };
    assert_eq!(rounded(&[]), 0);
    // Six cuts: each retract, and each travel but the last retract, which leads to an output.
    assert_eq!(
        rounded(&[("approximation", OptionValue::Length(Length::mm(2.0)))]),
        11
    );
}

#[test]
fn the_profile_of_a_machine_is_honoured() {
    let profile = Profile {
        header: vec!["    Set doLamp;".to_owned()],
        footer: vec!["    Reset doLamp;".to_owned()],
        extension: Some("modx".to_owned()),
        decimals: None,
        line_numbers: None,
        reserved: vec!["Sample".to_owned()],
    };
    let options = crate::support::options(&[("decimals", OptionValue::Integer(4))]).with_profile(profile);
    let bundle = crate::support::emit_with(&reachable(one_cut().program()), &options);
    let names: Vec<&str> = bundle.files().iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["sample_2.modx", "sample_2.pgf"]);
    let lines = lines(&bundle, "sample_2.modx");
    let place = |wanted: &str| lines.iter().position(|line| line.trim() == wanted).unwrap();
    assert_eq!(place("Set doLamp;"), place("SingArea\\Off;") + 1);
    assert_eq!(place("Reset doLamp;"), place("ENDPROC") - 1);
    assert!(lines.iter().any(|line| line.contains("[[2.9850,-16.0363,")));
}

/// Points on the way are lines: a limit that the ops alone would keep is one that splits.
#[test]
fn points_on_the_way_count_as_lines() {
    let recipe = Recipe {
        swing: Angle::deg(60.0),
        rake: Angle::deg(89.0),
        layers: 2,
        cuts: 4,
        ..recipe()
    };
    let program = reachable(recipe.program());
    let comments = 1 + 8;
    let ops = program.program().ops.len() + comments;
    let all = ops + program.motion().waypoints.len();
    assert!(all > ops);
    let files = |lines: usize| {
        let limit = OptionValue::Integer(u32::try_from(lines).unwrap());
        emit(&program, &[("lines_per_part", limit)]).files().len()
    };
    assert!(files(all - 1) > files(all));
}
