//! Profiles on their way from a file into a program.

use super::jobs::RIB;
use super::{Run, folder, vcutc};
use std::fs;
use tempfile::TempDir;

/// The job with this block, and a profile.
fn compiled(block: &str, profile: &str) -> (TempDir, Run) {
    let folder = folder();
    let job = RIB.replace("output(12)\n", &format!("output(12)\n  {block}\n"));
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    fs::create_dir(folder.path().join("shop")).unwrap();
    fs::write(folder.path().join("shop/arm.toml"), profile).unwrap();
    let run = vcutc(folder.path(), &["rib.vcut", "--target", "krl", "-q"]);
    (folder, run)
}

/// Decimals of the first coordinate of a program.
fn decimals(block: &str, profile: &str) -> usize {
    let (folder, run) = compiled(block, profile);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let text = fs::read_to_string(folder.path().join("rib.src")).unwrap();
    let (_, coordinate) = text.split_once("LIN {X ").unwrap();
    let number = coordinate.split(',').next().unwrap();
    number.split_once('.').unwrap().1.len()
}

#[test]
fn an_option_goes_before_the_profile_and_that_before_the_default() {
    assert_eq!(decimals("krl { profile = \"shop/arm.toml\" }", ""), 3);
    assert_eq!(decimals("krl { profile = \"shop/arm.toml\" }", "decimals = 5"), 5);
    assert_eq!(
        decimals(
            "krl { profile = \"shop/arm.toml\", decimals = 4 }",
            "decimals = 5"
        ),
        4
    );
    assert_eq!(
        decimals(
            "krl { decimals = 6, profile = \"shop/arm.toml\" }",
            "decimals = 5"
        ),
        6
    );
}

#[test]
fn a_profile_that_is_not_there_is_told_where_it_is_named() {
    let (_folder, run) = compiled("krl { profile = \"shop/leg.toml\" }", "");
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr.contains("VC0212") && run.stderr.contains("`shop/leg.toml`"),
        "{}",
        run.stderr
    );
    let (_folder, run) = compiled("krl { profile = arm }", "");
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr
            .contains("`profile` takes the name of a file in quotes"),
        "{}",
        run.stderr
    );
}
