//! Every code has an example that fails with it.

use crate::repository::{read, root};
use std::collections::BTreeSet;
use std::fs;
use vcutc::diagnostics::Code;

/// Codes that no job can cause, with the test that does and the reason.
const WITHOUT_A_JOB: &[(Code, &str, &str, &str)] = &[
    (
        Code::Unsupported,
        "tests/it/cli/outside.rs",
        "problems_become_diagnostics_at_their_places",
        "only outside targets lack anything",
    ),
    (
        Code::Overcut,
        "src/operations/vcut/replayed.rs",
        "a_cut_into_the_part_is_found_with_its_place_and_depth",
        "the planner keeps every cut out of the part; the proof is there to find its mistakes",
    ),
    (
        Code::AirCut,
        "tests/it/air.rs",
        "a_height_that_does_not_do_is_refused_with_one_that_does",
        "it takes a height on the command line",
    ),
    (
        Code::ChainPosture,
        "tests/it/five_axis.rs",
        "a_chain_on_tilted_work_takes_the_blade_off_its_place",
        "no operation makes chains",
    ),
    (
        Code::ManyAxisMoves,
        "tests/it/help.rs",
        "many_moves_of_all_axes_are_warned_of",
        "it takes a robot that no program of these tests is written for",
    ),
    (
        Code::OutsideProgram,
        "tests/it/cli/outside.rs",
        "what_is_not_a_program_is_not_written",
        "it takes a program beside the job",
    ),
    (
        Code::BadManifest,
        "tests/it/cli/build.rs",
        "faults_of_a_list_are_reported_at_their_places",
        "it is about vcut.toml",
    ),
    (
        Code::NoSuchJob,
        "tests/it/cli/build.rs",
        "missing_jobs_are_reported",
        "it is about vcut.toml",
    ),
    (
        Code::NoSuchTarget,
        "tests/it/cli/build.rs",
        "a_missing_target_is_reported",
        "it is about vcut.toml",
    ),
    (
        Code::SameFile,
        "tests/it/cli/build.rs",
        "two_programs_for_one_file_are_refused_before_anything_is_written",
        "it takes two jobs",
    ),
    (
        Code::StaleParts,
        "tests/it/cli/snapshot.rs",
        "parts_of_an_earlier_version_are_named_and_left",
        "it takes a folder with older files",
    ),
    (
        Code::WorseNumbers,
        "tests/it/cli/baseline.rs",
        "a_program_that_takes_longer_is_not_written",
        "it is about vcut.toml",
    ),
    (
        Code::BadBaseline,
        "tests/it/cli/baseline.rs",
        "a_baseline_that_cannot_be_used_is_reported_at_its_place",
        "it is about vcut.toml",
    ),
    (
        Code::NoBaseline,
        "tests/it/cli/baseline.rs",
        "a_program_that_is_new_is_reported",
        "it is about vcut.toml",
    ),
    (
        Code::Internal,
        "src/driver/lib.rs",
        "a_program_that_breaks_a_rule_is_the_compilers_fault",
        "a job that shows a fault of the compiler would be mended",
    ),
    (
        Code::NoPass,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::NotFollowed,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::NothingToConvert,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::Unclear,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::LeftOut,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::BesideBlank,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::MissingRoutine,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::ExternalAxis,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::NotWhole,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::AboveBlank,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
    (
        Code::Plunge,
        "tests/it/convert/refusals.rs",
        "what_is_not_a_raster_is_reported_at_its_line",
        "it is about a milling program",
    ),
];

#[test]
fn every_code_has_a_failing_example() {
    // By their names: one of them is not text.
    let folders = ["tests/check/err", "tests/process/err", "tests/verify"];
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(root().join(folder)).unwrap());
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let examples: BTreeSet<String> = names
        .filter(|name| name.starts_with("VC") && (name.ends_with(".vcut") || name.ends_with(".diff")))
        .filter_map(|name| Some(name.get(..6)?.to_owned()))
        .collect();
    let tested: BTreeSet<&str> = WITHOUT_A_JOB.iter().map(|(code, ..)| code.number()).collect();
    for code in Code::ALL {
        let has_example = examples.contains(code.number());
        assert_ne!(has_example, tested.contains(code.number()), "{}", code.number());
    }
}

#[test]
fn codes_without_a_job_are_tested_elsewhere() {
    for (code, file, test, _) in WITHOUT_A_JOB {
        assert!(
            read(file).contains(test),
            "{}: no {test} in {file}",
            code.number()
        );
    }
}
