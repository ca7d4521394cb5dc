//! What must never be in the output, whatever the program: each a scan of its own over all samples and option sets.

use crate::chains;
use crate::support::{emit, lines, reachable};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::testkit::{Recipe, samples};
use vcutc_backend_api::units::Length;

/// Samples under option sets that change the text most, and a long name with few lines a part.
fn bundles() -> Vec<Bundle> {
    let sets: [Vec<(&str, OptionValue)>; 3] = [
        vec![],
        vec![
            ("motion", OptionValue::Choice("spline")),
            ("approximation", OptionValue::Length(Length::mm(3.0))),
        ],
        vec![
            ("lines_per_part", OptionValue::Integer(12)),
            ("approximation", OptionValue::Length(Length::mm(3.0))),
            ("header", OptionValue::Lines(vec!["Ä\n1,5 \u{7f}".repeat(40)])),
            ("declare_parts", OptionValue::Choice("yes")),
        ],
    ];
    let long = Recipe {
        name: "a_very_long_name_of_a_job_that_never_ends".to_owned(),
        ..Recipe::default()
    };
    let mut programs: Vec<_> = samples()
        .unwrap()
        .into_iter()
        .map(|(_, program)| program)
        .collect();
    programs.push(reachable(long.program()));
    programs.push(reachable(chains::program(&Recipe::default())));
    programs
        .iter()
        .flat_map(|program| sets.iter().map(|values| emit(program, values)))
        .collect()
}

/// All lines of all files of one kind, comments taken off unless asked for.
fn code(bundle: &Bundle, extension: &str) -> Vec<(String, Vec<String>)> {
    bundle
        .files()
        .iter()
        .filter(|(name, _)| name.ends_with(extension))
        .map(|(name, _)| {
            let code = lines(bundle, name)
                .into_iter()
                .map(|line| line.split(';').next().unwrap_or_default().trim().to_owned())
                .filter(|line| !line.is_empty() && !line.starts_with('&'))
                .collect();
            (name.clone(), code)
        })
        .collect()
}

fn is_motion(line: &str) -> bool {
    ["PTP ", "SPTP ", "LIN ", "SLIN ", "CIRC ", "SCIRC "]
        .iter()
        .any(|word| line.starts_with(word))
}

#[test]
fn names_longer_than_a_controller_takes() {
    for bundle in bundles() {
        for (name, _) in bundle.files() {
            let (stem, _) = name.rsplit_once('.').unwrap();
            assert!(stem.len() <= 24, "{name}");
        }
    }
}

#[test]
fn a_module_name_other_than_the_file_name() {
    for bundle in bundles() {
        for (file, code) in code(&bundle, ".src") {
            assert_eq!(code[0], format!("DEF {}( )", file.trim_end_matches(".src")));
        }
        for (file, code) in code(&bundle, ".dat") {
            assert_eq!(code[0], format!("DEFDAT {}", file.trim_end_matches(".dat")));
        }
    }
}

#[test]
fn anything_but_marks_before_def() {
    for bundle in bundles() {
        for (name, _) in bundle.files() {
            let lines = lines(&bundle, name);
            let def = lines.iter().position(|line| line.starts_with("DEF")).unwrap();
            assert!(lines[..def].iter().all(|line| line.starts_with('&')), "{name}");
            assert!(lines[def..].iter().all(|line| !line.starts_with('&')), "{name}");
        }
    }
}

#[test]
fn a_declaration_after_an_instruction() {
    for bundle in bundles() {
        for (name, code) in code(&bundle, ".src") {
            let init = code.iter().position(|line| line.starts_with("BAS")).unwrap();
            for line in &code[init..] {
                let declares = ["DECL", "EXT ", "INT ", "REAL ", "SIGNAL"];
                assert!(
                    !declares.iter().any(|word| line.starts_with(word)),
                    "{name}: {line}"
                );
            }
        }
    }
}

#[test]
fn a_line_as_first_motion() {
    for bundle in bundles() {
        let sources = code(&bundle, ".src");
        let first = sources
            .iter()
            .flat_map(|(_, code)| code)
            .find(|line| is_motion(line));
        let word = first.map(|line| line.split(' ').collect::<Vec<_>>());
        assert!(
            matches!(word.as_deref(), Some(["PTP" | "SPTP", "XVC_HOME"])),
            "{word:?}"
        );
        // No module begins with a line, whoever starts it, and none with a pose that can be reached in several ways.
        for (name, code) in &sources {
            let first = code.iter().find(|line| is_motion(line));
            let is_complete = |line: &String| {
                let pose = line.contains("PTP {X") && line.contains(",S ") && line.contains(",T ");
                pose || line.ends_with("PTP XVC_HOME")
            };
            assert!(first.is_none_or(is_complete), "{name}: {first:?}");
        }
    }
}

#[test]
fn both_motion_planners_in_one_program() {
    for bundle in bundles() {
        let text: Vec<String> = code(&bundle, ".src")
            .into_iter()
            .flat_map(|(_, code)| code)
            .collect();
        let classic = text
            .iter()
            .any(|line| ["PTP", "LIN", "CIRC"].iter().any(|word| line.starts_with(word)));
        let spline = text.iter().any(|line| {
            ["SPTP", "SLIN", "SCIRC"]
                .iter()
                .any(|word| line.starts_with(word))
        });
        assert!(classic != spline);
    }
}

/// Every run of characters that a number could be made of, outside of names.
#[test]
fn numbers_that_are_none() {
    for bundle in bundles() {
        for (name, code) in code(&bundle, "") {
            for line in code.iter().filter(|line| !line.starts_with("DEF")) {
                let upper = line.to_ascii_uppercase();
                assert!(!upper.contains("NAN") && !upper.contains("INF"), "{name}: {line}");
                for word in line.split([' ', ',', '{', '}', '=', '(', ')', '[', ']']) {
                    if word.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '.' || c == '+') {
                        assert_number(word, line);
                    }
                }
            }
        }
    }
}

fn assert_number(word: &str, line: &str) {
    let digits = word.strip_prefix('-').unwrap_or(word);
    assert!(
        digits.bytes().all(|b| b.is_ascii_digit() || b == b'.'),
        "{word} in {line}"
    );
    assert!(
        digits.bytes().filter(|&b| b == b'.').count() <= 1,
        "{word} in {line}"
    );
    assert!(
        digits.starts_with(|c: char| c.is_ascii_digit()),
        "{word} in {line}"
    );
    assert!(digits.ends_with(|c: char| c.is_ascii_digit()), "{word} in {line}");
    let is_zero = digits.bytes().all(|b| b == b'0' || b == b'.');
    assert!(!(is_zero && word.starts_with('-')), "{word} in {line}");
}

#[test]
fn operators_of_other_languages() {
    for bundle in bundles() {
        for (name, code) in code(&bundle, "") {
            for line in code {
                assert!(!line.contains(":=") && !line.contains("=="), "{name}: {line}");
                assert!(!line.contains("CONTINUE"), "{name}: {line}");
            }
        }
    }
}

#[test]
fn rounding_before_something_exact() {
    for bundle in bundles() {
        for (name, code) in code(&bundle, ".src") {
            let steps: Vec<&String> = code
                .iter()
                .filter(|line| !line.starts_with("$VEL") && !line.starts_with("$APO"))
                .collect();
            for pair in steps.windows(2) {
                if pair[0].ends_with("C_DIS") || pair[0].ends_with("C_SPL") {
                    let words = ["LIN", "SLIN", "CIRC", "SCIRC"];
                    let straight = words.iter().any(|word| pair[1].starts_with(word));
                    assert!(straight, "{name}: {} before {}", pair[0], pair[1]);
                    let same_tip = target(pair[0]) == target(pair[1]);
                    assert!(!same_tip, "{name}: rounded before a turn: {}", pair[1]);
                }
            }
        }
    }
}

/// The X, Y, Z of a move as text.
fn target(line: &str) -> Option<&str> {
    let start = line.find("{X")?;
    let end = line.find(",A ")?;
    line.get(start..end)
}

#[test]
fn long_lines_or_other_characters_than_ascii() {
    for bundle in bundles() {
        for (name, bytes) in bundle.files() {
            assert!(
                bytes.iter().all(|b| matches!(b, b' '..=b'~' | b'\r' | b'\n')),
                "{name}"
            );
            for line in lines(&bundle, name) {
                // KSS 8, which alone has splines, writes longer lines itself.
                let longest = if line.starts_with("SCIRC") { 200 } else { 132 };
                assert!(line.len() < longest, "{name}: {line}");
            }
        }
    }
}

#[test]
fn folds_that_stay_open() {
    for bundle in bundles() {
        for (name, _) in bundle.files() {
            let mut depth = 0_i32;
            for line in lines(&bundle, name) {
                depth += i32::from(line.starts_with(";FOLD")) - i32::from(line.starts_with(";ENDFOLD"));
                assert!((0..=1).contains(&depth), "{name}: {line}");
            }
            assert_eq!(depth, 0, "{name}");
        }
    }
}
