//! What must never be in the output, whatever the program: each a scan of its own over all samples and option sets.

use crate::chains;
use crate::support::{cell, emit, lines, reachable, recipe};
use std::collections::BTreeSet;
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::Maker;
use vcutc_backend_api::testkit::{CellRecipe, Recipe, samples_for};
use vcutc_backend_api::units::{Angle, Length};

/// Samples under option sets that change the text most, a long name, and turns that are taken apart.
fn bundles() -> Vec<Bundle> {
    let sets: [Vec<(&str, OptionValue)>; 2] = [
        vec![("approximation", OptionValue::Length(Length::mm(3.0)))],
        vec![
            ("lines_per_part", OptionValue::Integer(12)),
            ("decimals", OptionValue::Integer(6)),
            ("header", OptionValue::Lines(vec!["Ä\n1,5 \u{7f}".repeat(40)])),
        ],
    ];
    let long = Recipe {
        name: "a_very_long_name_of_a_job_that_never_ends".to_owned(),
        ..recipe()
    };
    let far = Recipe {
        swing: Angle::deg(60.0),
        rake: Angle::deg(89.0),
        cell: CellRecipe {
            load: cell().load,
            ..cell()
        },
        ..recipe()
    };
    let samples = samples_for(Maker::Abb)
        .unwrap()
        .into_iter()
        .map(|(_, program)| program);
    let programs: Vec<_> = samples
        .chain([long, far].map(|recipe| reachable(recipe.program())))
        .chain([reachable(chains::program())])
        .collect();
    programs
        .iter()
        .flat_map(|program| sets.iter().map(|values| emit(program, values)))
        .collect()
}

/// The lines of all modules, comments and indentation taken off, with the name of the module's file.
fn code(bundle: &Bundle) -> Vec<(String, String)> {
    let modules = bundle.files().iter().filter(|(name, _)| name.ends_with(".mod"));
    modules
        .flat_map(|(name, _)| {
            lines(bundle, name)
                .into_iter()
                .map(move |line| (name.clone(), line))
        })
        .map(|(name, line)| (name, line.split('!').next().unwrap_or_default().trim().to_owned()))
        .filter(|(_, line)| !line.is_empty())
        .collect()
}

fn moves() -> Vec<String> {
    let all = bundles()
        .iter()
        .flat_map(code)
        .map(|(_, line)| line)
        .collect::<Vec<_>>();
    all.into_iter().filter(|line| line.starts_with("Move")).collect()
}

/// The lists of numbers in brackets, the innermost.
fn lists(line: &str) -> Vec<Vec<&str>> {
    let parts = line
        .split('[')
        .filter_map(|part| part.split_once(']').map(|(list, _)| list));
    parts.map(|list| list.split(',').collect()).collect()
}

#[test]
fn quaternions_that_are_not_of_length_one() {
    let mut seen = 0;
    for line in moves().iter().chain(
        bundles()
            .iter()
            .flat_map(code)
            .map(|(_, line)| line)
            .collect::<Vec<_>>()
            .iter(),
    ) {
        for list in lists(line).into_iter().filter(|list| list.len() == 4) {
            let Ok(numbers) = list
                .iter()
                .map(|part| part.parse())
                .collect::<Result<Vec<f64>, _>>()
            else {
                continue;
            };
            // Lists of four: confdata are whole numbers.
            if list.iter().any(|part| part.contains('.')) && !line.contains("speeddata") {
                let length: f64 = numbers.iter().map(|part| part * part).sum();
                assert!((length - 1.0).abs() < 3e-8, "{line}");
                seen += 1;
            }
        }
    }
    assert!(seen > 100);
}

/// Quaternions of consecutive straight moves take the nearer of two signs.
#[test]
fn quaternions_that_jump_from_one_sign_to_the_other() {
    for bundle in bundles() {
        let mut last: Option<Vec<f64>> = None;
        for (_, line) in code(&bundle) {
            // The end of a move on an arc stands in a line of its own.
            if !["MoveL", "MoveC", "[["].iter().any(|word| line.starts_with(word)) {
                last = None;
                continue;
            }
            let now: Vec<f64> = lists(&line)[1].iter().map(|part| part.parse().unwrap()).collect();
            if let Some(last) = &last {
                let along: f64 = last.iter().zip(&now).map(|(a, b)| a * b).sum();
                assert!(along >= 0.0, "{line}");
            }
            last = Some(now);
        }
    }
}

#[test]
fn zones_without_all_members() {
    for (_, line) in bundles().iter().flat_map(code) {
        if line.contains("zonedata") {
            assert_eq!(line.split(',').count(), 7, "{line}");
        }
    }
}

#[test]
fn external_axes_at_zero() {
    for line in moves() {
        let is_literal = line.contains("[[");
        assert_eq!(is_literal, line.contains(",[9E9,9E9,9E9,9E9,9E9,9E9]]"), "{line}");
    }
}

#[test]
fn names_that_are_too_long_or_there_twice() {
    for bundle in bundles() {
        let mut names = BTreeSet::new();
        let mut mains = 0;
        for (file, line) in code(&bundle) {
            let words: Vec<&str> = line.split([' ', '(', ':', ';']).collect();
            let name = match words.as_slice() {
                ["MODULE", name, ..] => {
                    assert_eq!(format!("{name}.mod"), file);
                    name
                }
                ["PROC", name, ..] => {
                    mains += usize::from(*name == "main");
                    name
                }
                ["CONST" | "PERS", _, name, ..] => name,
                _ => continue,
            };
            assert!(name.len() <= 32, "{name}");
            assert!(names.insert(name.to_ascii_uppercase()), "{name}");
        }
        assert_eq!(mains, 1);
        let list = bundle
            .files()
            .iter()
            .find(|(name, _)| name.ends_with(".pgf"))
            .unwrap();
        let list = String::from_utf8(list.1.clone()).unwrap();
        let modules = bundle.files().iter().filter(|(name, _)| name.ends_with(".mod"));
        assert!(
            modules
                .into_iter()
                .all(|(name, _)| list.contains(&format!("<Module>{name}</Module>")))
        );
    }
}

#[test]
fn moves_without_work_object_or_with_another_tool() {
    for line in moves().into_iter().filter(|line| !line.starts_with("MoveC")) {
        let frames = [",vc_tool\\WObj:=vc_wobj;", ",tool3\\WObj:=wobj2;"];
        assert!(frames.iter().any(|frames| line.ends_with(frames)), "{line}");
    }
}

#[test]
fn statements_without_their_end_and_lines_that_are_too_long() {
    for (_, line) in bundles().iter().flat_map(code) {
        assert!(line.len() < 200, "{line}");
        let is_border = ["MODULE ", "PROC ", "ENDPROC", "ENDMODULE"]
            .iter()
            .any(|word| line.starts_with(word));
        let goes_on = line.starts_with("MoveC");
        assert_eq!(line.ends_with(';'), !is_border && !goes_on, "{line}");
    }
}

#[test]
fn text_that_is_not_ascii_and_negative_zeros() {
    for bundle in bundles() {
        for (name, bytes) in bundle.files() {
            assert!(bytes.is_ascii(), "{name}");
        }
        for (_, line) in code(&bundle) {
            for number in line
                .split([',', '[', ']'])
                .filter(|number| number.starts_with("-0"))
            {
                assert!(number.contains(|c: char| ('1'..='9').contains(&c)), "{line}");
            }
        }
    }
}

/// A rounded corner before an output, a turn or a cut would be too early.
#[test]
fn outputs_and_waits_after_a_move_that_does_not_stop() {
    for bundle in bundles() {
        let code = code(&bundle);
        for pair in code.windows(2) {
            if pair[0].1.contains(",vc_zone,") {
                assert!(pair[1].1.starts_with("MoveL"), "{pair:?}");
            }
            if pair[0].1.contains(",vc_blend,") {
                let goes_on = pair[1].1.starts_with("MoveL") || pair[1].1.starts_with("MoveC");
                assert!(goes_on, "{pair:?}");
            }
        }
    }
}

#[test]
fn straight_moves_before_one_of_all_axes_and_modes_left_open() {
    for bundle in bundles() {
        let mut said = BTreeSet::new();
        let mut stands = false;
        for (_, line) in code(&bundle) {
            if line.starts_with("PROC") {
                (said, stands) = (BTreeSet::new(), false);
            }
            if ["ConfJ\\On;", "ConfL\\On;", "SingArea\\Off;"].contains(&line.as_str()) {
                said.insert(line.clone());
            }
            if line.starts_with("Move") {
                assert_eq!(said.len(), 3, "{line}");
                stands |= !line.starts_with("MoveL") && !line.starts_with("MoveC");
                assert!(stands, "{line}");
            }
        }
    }
}
