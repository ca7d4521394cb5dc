//! The test programs that every dialect should be covered by, one by one.

use crate::support::expected::{Rounding, compare, steps};
use crate::support::reader::{self, Event};
use crate::support::{emit, lines, reachable, status};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{Action, AxisValues, Edges, Ready, Stock};
use vcutc_backend_api::testkit::{CellRecipe, Crossing, Passes, Recipe, conformance, samples};
use vcutc_backend_api::units::Length;
use vcutc_backend_krl::Krl;

fn events(recipe: &Recipe, values: &[(&str, OptionValue)]) -> Vec<Event> {
    let bundle = emit(&reachable(recipe.program()), values);
    reader::run(&bundle, &recipe.name).unwrap()
}

fn one_cut() -> Recipe {
    Recipe {
        layers: 1,
        cuts: 1,
        ..Recipe::default()
    }
}

/// Tips of the straight moves.
fn tips(events: &[Event]) -> Vec<[f64; 3]> {
    events
        .iter()
        .filter_map(|event| match event {
            Event::Line { to, .. } => Some(to.tip),
            _ => None,
        })
        .collect()
}

#[test]
fn the_backend_keeps_the_promises_of_all_backends() {
    assert_eq!(conformance(&Krl, &samples().unwrap()), Ok(()));
}

#[test]
fn a_program_without_any_op_is_still_a_module() {
    let mut program = Recipe::default().program();
    program.ops.clear();
    let bundle = emit(&reachable(program), &[]);
    assert_eq!(lines(&bundle, "sample.src").last().unwrap(), "END");
    assert_eq!(lines(&bundle, "sample.dat").last().unwrap(), "ENDDAT");
    let events = reader::run(&bundle, "sample").unwrap();
    assert!(
        !events
            .iter()
            .any(|event| matches!(event, Event::Axes(_) | Event::Line { .. }))
    );
}

#[test]
fn an_empty_list_of_cuts_only_goes_home() {
    let recipe = Recipe {
        layers: 0,
        ..Recipe::default()
    };
    let motions: Vec<Event> = events(&recipe, &[])
        .into_iter()
        .filter(|event| matches!(event, Event::Axes(_) | Event::Line { .. }))
        .collect();
    assert_eq!(motions, [Event::Axes([0.0, -90.0, 90.0, 0.0, 45.0, 0.0])]);
}

#[test]
fn one_cut_turns_about_the_still_tip_and_comes_back() {
    let events = events(&one_cut(), &[]);
    let tips = tips(&events);
    let [_, front, back, turned, returned, away] = tips.as_slice() else {
        panic!("{tips:?}");
    };
    assert_eq!(back.map(f64::to_bits), turned.map(f64::to_bits));
    assert_eq!(front.map(f64::to_bits), returned.map(f64::to_bits));
    assert!(front[1] < 0.0 && back[1] > 50.0);
    assert_eq!((away[0], away[1]), (front[0], front[1]));
    assert!(away[2] > 50.0);
}

/// Wherever a turn of an axis beyond 180 deg is meant, `T` says so.
#[test]
fn the_same_pose_on_another_turn_differs_in_t_only() {
    let point = |home: [f64; 6]| {
        let cell = CellRecipe {
            home: AxisValues(home.map(f64::to_radians)),
            ..CellRecipe::default()
        };
        let found = events(&Recipe { cell, ..one_cut() }, &[])
            .into_iter()
            .find_map(|event| match event {
                Event::Point { to, status, turn } => Some((to, status, turn)),
                _ => None,
            });
        found.unwrap()
    };
    let (pose, status, turn) = point([0.0, -90.0, 90.0, 0.0, 45.0, 0.0]);
    let (again, same_status, other_turn) = point([0.0, -90.0, 90.0, -340.0, 45.0, -340.0]);
    assert_eq!((pose, status), (again, same_status));
    assert_eq!((turn ^ other_turn), 8 + 32, "{turn} {other_turn}");
}

#[test]
fn a_branch_changes_at_a_move_of_all_axes_above_the_stock() {
    let recipe = Recipe {
        operations: 3,
        crossing: Crossing::ByAxes,
        ..one_cut()
    };
    let points: Vec<_> = events(&recipe, &[])
        .into_iter()
        .filter_map(|event| match event {
            Event::Point { to, status, .. } => Some((to.tip[2] >= 50.0, status)),
            _ => None,
        })
        .collect();
    assert_eq!(points, [(true, 2), (true, 6), (true, 2)]);
}

/// A program that turns the blade in such moves only has no rate to say.
#[test]
fn every_way_through_the_air_may_be_a_move_of_all_axes() {
    let mut program = Recipe {
        edges: Edges::Single,
        ..Recipe::default()
    }
    .program();
    for op in &mut program.ops {
        if let Action::Travel { to, orientation, .. } = op.action {
            op.action = Action::AxisTravel { to, orientation };
        }
    }
    let program = reachable(program);
    for lines in [0, 1] {
        let bundle = emit(&program, &[("lines_per_part", OptionValue::Integer(lines))]);
        let got = reader::run(&bundle, "sample").unwrap();
        compare(&got, &steps(&program, &status), Rounding::of_decimals(3)).unwrap();
        let text = lines_of_code(&bundle);
        assert!(!text.iter().any(|line| line.contains("ORI1")), "{text:?}");
    }
}

fn lines_of_code(bundle: &Bundle) -> Vec<String> {
    let sources = bundle.files().iter().filter(|(name, _)| name.ends_with(".src"));
    sources.flat_map(|(name, _)| lines(bundle, name)).collect()
}

#[test]
fn a_turn_writes_the_same_digits_for_the_tip() {
    let bundle = emit(&reachable(one_cut().program()), &[]);
    let lines = lines(&bundle, "sample.src");
    let tips: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.strip_prefix("LIN {")?.split(",A ").next())
        .collect();
    assert_eq!(tips[2], tips[3]);
}

#[test]
fn the_generator_runs_before_the_first_cut_and_stops_after_the_last() {
    let recipe = Recipe {
        cell: CellRecipe {
            ready: Ready::Input(7),
            ..CellRecipe::default()
        },
        ..one_cut()
    };
    let events = events(&recipe, &[]);
    let place = |wanted: &Event| events.iter().position(|event| event == wanted).unwrap();
    let inside: Vec<usize> = events
        .iter()
        .enumerate()
        .filter(|(_, event)| matches!(event, Event::Line { to, .. } if to.tip[2] < 50.0))
        .map(|(index, _)| index)
        .collect();
    let (on, ready, off) = (
        place(&Event::Output(12, true)),
        place(&Event::Await(7)),
        place(&Event::Output(12, false)),
    );
    assert!(on < ready && ready < inside[0]);
    assert!(inside[inside.len() - 1] < off);
}

#[test]
fn the_longest_name_is_kept_and_a_longer_one_is_cut() {
    for (name, module) in [
        ("rib_of_18_letters_", "rib_of_18_letters"),
        ("a_name_of_eighteen", "a_name_of_eighteen"),
        ("a_name_of_eighteen_and_more", "a_name_of_eig_0pz1"),
        ("Flügel 7", "Fl_gel_7"),
        ("lin", "VC_lin"),
        ("bas", "VC_bas"),
        ("7th", "VC_7th"),
    ] {
        let recipe = Recipe {
            name: name.to_owned(),
            ..one_cut()
        };
        let bundle = emit(&reachable(recipe.program()), &[]);
        assert_eq!(bundle.files()[0].0, format!("{module}.src"));
    }
}

#[test]
fn the_largest_and_smallest_coordinates_are_written_out() {
    let recipe = Recipe {
        stock: Stock {
            width: Length::mm(85.0),
            depth: Length::mm(99_000.0),
            height: Length::mm(99_000.0),
        },
        step: Length::mm(0.002),
        clearance: Length::mm(900.0),
        edges: Edges::Single,
        passes: Passes::Layer,
        ..one_cut()
    };
    let tips = tips(&events(&recipe, &[]));
    let largest = tips.iter().flatten().copied().fold(0.0, f64::max);
    assert!(largest > 99_900.0, "{largest}");
    assert!(tips.iter().any(|tip| (tip[0] - 0.001).abs() < 1e-9), "{tips:?}");
}

#[test]
fn speeds_are_written_where_they_change() {
    let bundle = emit(&reachable(one_cut().program()), &[]);
    let lines = lines(&bundle, "sample.src");
    let speeds: Vec<&str> = lines
        .iter()
        .filter(|line| line.starts_with("$VEL"))
        .map(String::as_str)
        .collect();
    assert_eq!(
        speeds,
        [
            "$VEL.CP=0.5",
            "$VEL.ORI1=49.7366",
            "$VEL.ORI2=77.4968",
            "$VEL.CP=0.2",
            "$VEL.CP=0.5"
        ]
    );
}

#[test]
fn every_cut_has_its_comment_within_the_fold_of_its_layer() {
    let recipe = Recipe {
        layers: 3,
        cuts: 1,
        ..Recipe::default()
    };
    let lines = lines(&emit(&reachable(recipe.program()), &[]), "sample.src");
    let headings: Vec<&str> = lines
        .iter()
        .filter(|line| line.contains("layer"))
        .map(String::as_str)
        .collect();
    assert_eq!(
        headings,
        [
            ";FOLD layer 1",
            "; layer 1 cut 1",
            ";ENDFOLD (layer 1)",
            ";FOLD layer 2",
            "; layer 2 cut 1",
            ";ENDFOLD (layer 2)",
            ";FOLD layer 3",
            "; layer 3 cut 1",
            ";ENDFOLD (layer 3)",
        ]
    );
}

#[test]
fn corners_are_rounded_only_when_asked_for_and_only_in_the_air() {
    let rounded = |values: &[(&str, OptionValue)]| {
        events(&Recipe::default(), values)
            .iter()
            .filter(|event| matches!(event, Event::Line { rounded: true, .. }))
            .count()
    };
    assert_eq!(rounded(&[]), 0);
    // Six cuts: each retract, and each travel but the last retract, which leads to an output.
    let distance = [("approximation", OptionValue::Length(Length::mm(2.0)))];
    assert_eq!(rounded(&distance), 11);
}
