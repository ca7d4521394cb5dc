//! What every backend promises, and what this one does with the edges of its world.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use vcutc_backend_api::backend::{Backend, BackendIssue, OptionValue, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::Maker;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::{LineNumbers, Profile};
use vcutc_backend_api::readback::{Comparator, Divergence, ProgramFile, Replay, Sources, program_files};
use vcutc_backend_api::testkit::{conformance, samples_for};
use vcutc_backend_joint_csv::JointCsv;

#[test]
fn it_keeps_the_promises_of_the_trait_for_every_maker() {
    for maker in [Maker::Kuka, Maker::Abb, Maker::Other] {
        conformance(&JointCsv, &samples_for(maker).unwrap()).unwrap();
    }
}

fn sample() -> ReachableProgram {
    let samples = samples_for(Maker::Other).unwrap();
    let (_, program) = samples
        .into_iter()
        .find(|(name, _)| *name == "several_operations")
        .unwrap();
    program
}

fn written(program: &ReachableProgram, options: &Options) -> Vec<ProgramFile> {
    let mut bundle = Bundle::default();
    JointCsv
        .check(program, options)
        .unwrap()
        .write(&mut bundle)
        .unwrap();
    program_files(&bundle)
}

fn replayed(program: &ReachableProgram, options: &Options, files: &[ProgramFile]) -> Result<(), Divergence> {
    let reader = JointCsv.reader().unwrap();
    let comparator = Comparator::new(program, reader, reader.resolution(options));
    let mut replay = Replay::new(comparator, reader.frames());
    let cell = program.program().cell.as_ref().unwrap();
    reader.read(Sources { files, cell, options }, &mut |statement| {
        replay.take(&statement)
    });
    replay.finish().map(|_| ())
}

#[test]
fn every_row_that_is_dropped_or_changed_is_missed() {
    let program = sample();
    let options = Options::defaults(JointCsv.options());
    let files = written(&program, &options);
    let [file] = files.as_slice() else {
        panic!("{files:?}")
    };
    let with = |lines: Vec<String>| {
        [ProgramFile {
            name: file.name.clone(),
            text: lines.join("\n"),
        }]
    };
    let lines: Vec<String> = file.text.lines().map(str::to_owned).collect();
    assert_eq!(replayed(&program, &options, &with(lines.clone())), Ok(()));
    let first_row = lines.len() - program.program().ops.len();
    for row in first_row..lines.len() {
        let mut dropped = lines.clone();
        dropped.remove(row);
        assert!(
            replayed(&program, &options, &with(dropped)).is_err(),
            "{}",
            lines[row]
        );
        // The last digit of every number behind the label of the op.
        let numbers = lines[row]
            .match_indices(['.', '='])
            .map(|(at, _)| at)
            .skip_while(|at| lines[row][..*at].matches(',').count() < 2);
        for at in numbers.filter(|at| lines[row].as_bytes()[at + 1].is_ascii_digit()) {
            let mut changed = lines.clone();
            let digit = if lines[row].as_bytes()[at + 1] == b'7' {
                "3"
            } else {
                "7"
            };
            changed[row].replace_range(at + 1..at + 2, digit);
            assert!(
                replayed(&program, &options, &with(changed.clone())).is_err(),
                "{}",
                changed[row]
            );
        }
    }
}

#[test]
fn decimals_are_those_asked_for_and_read_back() {
    let program = sample();
    for decimals in 3..=6 {
        let mut options = Options::defaults(JointCsv.options());
        options
            .set(&JointCsv.options()[0], OptionValue::Integer(decimals))
            .unwrap();
        let files = written(&program, &options);
        let column = files[0]
            .text
            .lines()
            .last()
            .unwrap()
            .split(',')
            .nth(6)
            .unwrap()
            .to_owned();
        assert_eq!(
            column.split_once('.').unwrap().1.len(),
            decimals as usize,
            "{column}"
        );
        assert_eq!(replayed(&program, &options, &files), Ok(()));
    }
}

#[test]
fn a_profile_is_followed_or_refused() {
    let program = sample();
    let with = |profile| Options::defaults(JointCsv.options()).with_profile(profile);
    let name = program.program().name.clone();
    let options = with(Profile {
        header: vec!["# cell 4".to_owned()],
        footer: vec!["# end".to_owned()],
        reserved: vec![name.to_ascii_uppercase()],
        ..Profile::default()
    });
    let files = written(&program, &options);
    assert!(files[0].text.contains("\n# cell 4\nop,site,do,") && files[0].text.ends_with("\n# end\n"));
    assert_ne!(
        files[0].name.to_ascii_lowercase(),
        format!("{}.csv", name.to_ascii_lowercase())
    );
    assert_eq!(replayed(&program, &options, &files), Ok(()));

    let options = with(Profile {
        header: vec!["G54".to_owned()],
        extension: Some("txt".to_owned()),
        line_numbers: Some(LineNumbers { start: 10, step: 10 }),
        ..Profile::default()
    });
    let issues = JointCsv.check(&program, &options).err().unwrap();
    let keys: Vec<&str> = issues
        .iter()
        .map(|issue| match issue {
            BackendIssue::Profile { key, .. } => *key,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(keys, ["header", "extension", "line_numbers"]);
}

/// Tables that no writer made: every line is told once, and none stops the reader.
#[test]
fn nonsense_is_told_as_such() {
    let program = sample();
    let cell = program.program().cell.as_ref().unwrap();
    let options = Options::defaults(JointCsv.options());
    let text = "op,site\n1,x,move,1,2,3,4,5,6,7,8,9,1e5,,\n1,x,jump,,,,,,,,,,,,\n\n# comment\n1,x,wait,,,,,,,,,,,,inf\n";
    let files = [ProgramFile {
        name: "a.csv".to_owned(),
        text: text.to_owned(),
    }];
    let mut told = Vec::new();
    let sources = Sources {
        files: &files,
        cell,
        options: &options,
    };
    JointCsv.reader().unwrap().read(sources, &mut |statement| {
        let place = statement.place.start as usize..statement.place.end as usize;
        told.push(format!("{} <- {:?}", &text[place], statement.effect));
    });
    assert_eq!(
        told,
        [
            "op,site <- Unreadable { expected: \"15 columns\" }",
            "1,x,move,1,2,3,4,5,6,7,8,9,1e5,, <- Unreadable { expected: \"the columns of `move`\" }",
            "1,x,jump,,,,,,,,,,,, <- Unknown",
            "1,x,wait,,,,,,,,,,,,inf <- Unreadable { expected: \"the columns of `wait`\" }",
        ]
    );
}
