//! Where lines, blocks and files begin and end, as controls see it.

use crate::by_hand::{departs, one_cut};
use crate::read_back::replayed;
use crate::support::{DIALECTS, emit, needed, options, reachable, recipe};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::readback::{Effect, ProgramFile, program_files};

#[test]
fn line_ends_of_every_system_and_ends_of_blocks() {
    let program = one_cut();
    for dialect in DIALECTS {
        let mut files = program_files(&emit(&program, dialect, &[]));
        let end = if dialect == "fanuc" { " ;\r\n" } else { "\r\n" };
        files[0].text = files[0].text.replace('\n', end);
        let found = replayed(&program, &files, &options(&needed(dialect))).0;
        assert!(found.is_ok(), "{dialect}: {found:?}");
        files[0].text = files[0].text.replace("\r\n", "\r");
        let found = replayed(&program, &files, &options(&needed(dialect))).0;
        assert!(found.is_err(), "{dialect}");
    }
}

/// After a comment it is a bad character, after another one the end of the program.
#[test]
fn marks_of_a_tape_stand_first() {
    for dialect in ["linuxcnc", "fanuc"] {
        for head in ["%\n%\n", "(words)\n%\n", "N10 %\n"] {
            let (text, what) = departs(dialect, &[], |text| {
                format!("{head}{}", text.strip_prefix("%\n").unwrap_or(text))
            });
            assert_eq!(text, "%", "{dialect} {head:?} {what:?}");
        }
    }
}

/// LinuxCNC looks for the file of a part in small letters, whichever the call has.
#[test]
fn files_of_linuxcnc_s_parts_have_small_letters() {
    let program = reachable(recipe().program());
    let parts = [("lines_per_part", OptionValue::Integer(10))];
    let read = |edit: &dyn Fn(&mut ProgramFile)| {
        let mut files = program_files(&emit(&program, "linuxcnc", &parts));
        assert!(files.len() > 2);
        files.iter_mut().for_each(edit);
        let (result, statements) = replayed(&program, &files, &options(&needed("linuxcnc")));
        let missing = statements
            .into_iter()
            .find_map(|statement| match statement.effect {
                Effect::Unreadable { expected } => Some(expected),
                _ => None,
            });
        (result.is_ok(), missing.unwrap_or_default())
    };
    let in_capitals = |file: &mut ProgramFile| {
        for word in ["call", "sub", "endsub"] {
            for part in ["_p001", "_p002"] {
                file.text = file.text.replace(
                    &format!("{part}> {word}"),
                    &format!("{}> {word}", part.to_uppercase()),
                );
            }
        }
    };
    assert_eq!(read(&|_| {}), (true, String::new()));
    assert_eq!(read(&in_capitals), (true, String::new()));
    for becomes in ["_p002.NGC", "_P002.ngc", "_P002.NGC"] {
        let (is_read, missing) = read(&|file| file.name = file.name.replace("_p002.ngc", becomes));
        assert!(!is_read && missing.contains("_p002.ngc`"), "{becomes}: {missing}");
    }
}
