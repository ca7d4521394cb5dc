//! What a machine's profile does to its programs.

use crate::support::{lines, options, reachable};
use vcutc_backend_api::backend::{Backend, BackendIssue, OptionValue};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::profile::{LineNumbers, Profile};
use vcutc_backend_api::testkit::Recipe;
use vcutc_backend_krl::Krl;

fn recipe() -> Recipe {
    Recipe {
        name: "rib".to_owned(),
        ..Recipe::default()
    }
}

fn emitted(profile: Profile, lines_per_part: u32) -> Result<Bundle, Vec<BackendIssue>> {
    let program = reachable(recipe().program());
    let values = [("lines_per_part", OptionValue::Integer(lines_per_part))];
    let options = options(&values).with_profile(profile);
    let mut bundle = Bundle::default();
    Krl.check(&program, &options)?.write(&mut bundle).unwrap();
    Ok(bundle)
}

fn shop() -> Profile {
    Profile {
        header: vec![
            "EXT CELL_READY( )".to_owned(),
            "CELL_READY( ) ; door, vacuum".to_owned(),
        ],
        footer: vec!["$OUT[30]=TRUE".to_owned(), "; done".to_owned()],
        ..Profile::default()
    }
}

fn place(lines: &[String], wanted: &str) -> usize {
    lines.iter().position(|line| line == wanted).unwrap()
}

#[test]
fn header_and_footer_stand_around_the_program() {
    let bundle = emitted(shop(), 0).unwrap();
    let lines = lines(&bundle, "rib.src");
    let reset = place(&lines, "BAS (#INITMOV,0 )");
    assert!(place(&lines, "DEF rib( )") < place(&lines, "EXT CELL_READY( )"));
    assert!(place(&lines, "CELL_READY( ) ; door, vacuum") < reset);
    let end: Vec<_> = lines.iter().rev().take(4).rev().collect();
    assert_eq!(end, ["PTP XVC_HOME", "$OUT[30]=TRUE", "; done", "END"]);
}

#[test]
fn parts_have_neither() {
    let bundle = emitted(shop(), 20).unwrap();
    let with: Vec<_> = bundle
        .files()
        .iter()
        .filter(|(_, bytes)| String::from_utf8_lossy(bytes).contains("CELL_READY"))
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(with, ["rib.src"]);
    let main = lines(&bundle, "rib.src");
    let last_call = main.iter().rposition(|line| line.starts_with("rib_p")).unwrap();
    assert!(last_call < place(&main, "$OUT[30]=TRUE"));
}

#[test]
fn names_that_are_kept_are_not_taken() {
    let profile = Profile {
        reserved: vec!["RIB".to_owned()],
        ..Profile::default()
    };
    let bundle = emitted(profile, 0).unwrap();
    assert_eq!(lines(&bundle, "rib_2.src")[3], "DEF rib_2( )");
}

#[test]
fn what_krl_cannot_have_is_refused() {
    let profile = Profile {
        extension: Some("mpf".to_owned()),
        line_numbers: Some(LineNumbers { start: 1, step: 1 }),
        footer: vec!["$OUT[12]=TRUE".to_owned()],
        ..Profile::default()
    };
    let issues = emitted(profile, 0).unwrap_err();
    let keys: Vec<_> = issues
        .iter()
        .map(|issue| match issue {
            BackendIssue::Profile { key, .. } => *key,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(keys, ["extension", "line_numbers", "footer"]);
}
