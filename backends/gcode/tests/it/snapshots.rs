//! Whole programs of every dialect as people read them.

use crate::support::{DIALECTS, emit, reachable, recipe, rounds, text};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::testkit::Recipe;
use vcutc_backend_api::units::{Duration, Length};

#[test]
fn one_cut_in_every_dialect() {
    let program = reachable(
        Recipe {
            name: "Rib 12".to_owned(),
            layers: 1,
            cuts: 1,
            dwell: Some(Duration::s(0.25)),
            ..recipe()
        }
        .program(),
    );
    for dialect in DIALECTS {
        insta::assert_snapshot!(format!("one_cut_{dialect}"), text(&emit(&program, dialect, &[])));
    }
}

#[test]
fn parts_and_rounded_corners() {
    let program = reachable(
        Recipe {
            layers: 1,
            cuts: 2,
            ..recipe()
        }
        .program(),
    );
    for dialect in DIALECTS {
        let mut given = vec![("lines_per_part", OptionValue::Integer(8))];
        if rounds(dialect) {
            given.push(("approximation", OptionValue::Length(Length::mm(2.0))));
        }
        insta::assert_snapshot!(format!("parts_{dialect}"), text(&emit(&program, dialect, &given)));
    }
}
