//! Small programs as a whole, to be read by people.

use crate::support::{cell, emit, numbered, reachable, recipe};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::Ready;
use vcutc_backend_api::testkit::{CellRecipe, Recipe};
use vcutc_backend_api::units::Length;

/// All files, each under its name.
fn shown(bundle: &Bundle) -> String {
    let mut text = String::new();
    for (name, bytes) in bundle.files() {
        text += &format!(
            "=== {name} ===\n{}",
            String::from_utf8_lossy(bytes).replace("\r\n", "\n")
        );
    }
    text
}

fn small() -> Recipe {
    Recipe {
        name: "spoiler rib 12".to_owned(),
        layers: 1,
        cuts: 2,
        ..recipe()
    }
}

#[test]
fn in_parts() {
    let values = [
        ("lines_per_part", OptionValue::Integer(12)),
        (
            "header",
            OptionValue::Lines(vec!["Drawing 4711, issue B".to_owned()]),
        ),
    ];
    insta::assert_snapshot!(shown(&emit(&reachable(small().program()), &values)));
}

#[test]
fn with_numbered_frames_and_rounded_corners() {
    let recipe = Recipe {
        cell: CellRecipe {
            tool: numbered(3),
            base: numbered(2),
            load: None,
            ready: Ready::Input(7),
            ..cell()
        },
        ..small()
    };
    let values = [
        ("approximation", OptionValue::Length(Length::mm(2.5))),
        ("decimals", OptionValue::Integer(4)),
        ("ultrasonic_signal", OptionValue::Text("doKnife".to_owned())),
    ];
    insta::assert_snapshot!(shown(&emit(&reachable(recipe.program()), &values)));
}
