//! The habits of a machine, as far as KRL programs can have them.
//!
//! Lines at the head and at the end of the main program are written as they are. They stand in front of
//! `BAS (#INITMOV,0 )` and behind the last motion, so nothing that they set changes how the program moves; what moves the
//! robot, jumps, or switches the generator is refused, because the program would no longer be what was proven.

use crate::keywords::HOME;
use crate::read::syntax::{Phrase, Statement, is_same_name, statements};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::ir::Cell;
use vcutc_backend_api::profile::Profile;

/// Longest line that every release reads.
const LONGEST_LINE: usize = 131;

/// Words of statements that move the robot, or make it leave or repeat lines.
#[rustfmt::skip]
const MOVES_AND_JUMPS: [&str; 41] = [
    "CASE", "CIRC", "CIRC_REL", "CONTINUE", "DEFAULT", "DEFFCT", "ELSE", "ENDFCT", "ENDFOR", "ENDIF", "ENDLOOP",
    "ENDSPLINE", "ENDSWITCH", "ENDWHILE", "EXIT", "FOR", "GOTO", "IF", "INTERRUPT", "LIN", "LIN_REL", "LOOP", "PTP",
    "PTP_REL", "REPEAT", "RESUME", "RETURN", "SCIRC", "SCIRC_REL", "SLIN", "SLIN_REL", "SPL", "SPL_REL", "SPLINE",
    "SPTP", "SPTP_REL", "STRUC", "SWITCH", "TRIGGER", "UNTIL", "WHILE",
];

/// Everything in a profile that a KRL program cannot have.
pub(crate) fn issues(profile: &Profile, cell: Option<&Cell>) -> Vec<BackendIssue> {
    let mut found = Vec::new();
    let mut refuse = |key, why| found.push(BackendIssue::Profile { key, why });
    if let Some(extension) = &profile.extension
        && !is_same_name(extension, "src")
    {
        let why =
            format!("a controller finds the instructions of a KRL program in `.src`, not in `.{extension}`");
        refuse("extension", why);
    }
    if profile.line_numbers.is_some() {
        refuse("line_numbers", "lines of KRL have no numbers".to_owned());
    }
    if profile.reserved.iter().any(|name| is_same_name(name, HOME)) {
        let why = format!("the data list of every KRL program keeps its home angles as `{HOME}`");
        refuse("reserved", why);
    }
    let output = cell.and_then(|cell| cell.ultrasonic);
    for line in &profile.header {
        if let Some(why) = objection(line, Place::Head, output) {
            refuse("header", why);
        }
    }
    for line in &profile.footer {
        if let Some(why) = objection(line, Place::End, output) {
            refuse("footer", why);
        }
    }
    found
}

/// Where a line is to stand.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Head,
    End,
}

/// What speaks against a line.
fn objection(line: &str, place: Place, generator: Option<u32>) -> Option<String> {
    if line.len() > LONGEST_LINE {
        return Some(format!(
            "`{line}` has {} characters; controllers read up to {LONGEST_LINE}",
            line.len()
        ));
    }
    if !line.bytes().all(|byte| matches!(byte, b' '..=b'~' | b'\t')) {
        return Some(format!("{line:?} is not one line of ASCII"));
    }
    let Statement { phrase, .. } = statements(line).next()?;
    let why = match phrase {
        Phrase::Motion(_) => "moves the robot, and nothing has proven where",
        Phrase::Other(word) if MOVES_AND_JUMPS.iter().any(|name| is_same_name(word, name)) => {
            "moves the robot or makes it leave out lines"
        }
        Phrase::Assignment { to, .. } if generator.is_some() && to.index_in("$OUT") == generator => {
            "switches the ultrasonic generator, which the program does itself"
        }
        Phrase::Def { .. } | Phrase::End | Phrase::DefDat { .. } | Phrase::EndDat => {
            "begins or ends a routine or a data list"
        }
        Phrase::Mark(_) => "is a record of the editor, and those stand in front of the program",
        Phrase::Ext { .. } | Phrase::Declaration(_) if place == Place::End => {
            "is a declaration, and those stand in front of all instructions"
        }
        Phrase::Unreadable { expected } => return Some(format!("`{line}` is no KRL: expected {expected}")),
        Phrase::Ext { .. }
        | Phrase::Declaration(_)
        | Phrase::Assignment { .. }
        | Phrase::Bas { .. }
        | Phrase::Call { .. }
        | Phrase::WaitSec(_)
        | Phrase::WaitFor(_)
        | Phrase::Halt
        | Phrase::Other(_) => return None,
    };
    Some(format!("`{line}` {why}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::profile::LineNumbers;

    fn keys(profile: &Profile) -> Vec<&'static str> {
        let issues = issues(profile, None);
        let keys = issues.iter().map(|issue| match issue {
            BackendIssue::Profile { key, .. } => *key,
            other => panic!("{other:?}"),
        });
        keys.collect()
    }

    #[test]
    fn what_krl_does_not_have_is_refused() {
        let profile = Profile {
            header: vec!["LIN {X 1.0}".to_owned()],
            footer: vec!["DECL INT I".to_owned()],
            extension: Some("mod".to_owned()),
            decimals: Some(4),
            line_numbers: Some(LineNumbers { start: 10, step: 10 }),
            reserved: vec!["xvc_home".to_owned()],
        };
        assert_eq!(
            keys(&profile),
            ["extension", "line_numbers", "reserved", "header", "footer"]
        );
    }

    #[test]
    fn its_own_extension_is_no_wish() {
        let profile = Profile {
            extension: Some("SRC".to_owned()),
            ..Profile::default()
        };
        assert_eq!(keys(&profile), [""; 0]);
    }

    #[test]
    fn lines_that_move_jump_or_end_are_refused_and_others_not() {
        for line in [
            "PTP XHOME",
            "SPTP XHOME WITH $VEL_AXIS[1]=10",
            "circ {X 1},{X 2}",
            "IF $IN[3] THEN",
            "GOTO OUT",
            "END",
            "&PARAM EDITMASK = *",
            "one two",
            "a\nb",
        ] {
            assert!(objection(line, Place::Head, Some(1)).is_some(), "{line}");
        }
        for line in [
            "; a word",
            "",
            "CELL_READY( )",
            "$OUT[12]=TRUE",
            "DECL INT COUNT",
            "COUNT=COUNT+1",
            "PULSE ($OUT[7],TRUE,0.5)",
            "WAIT SEC 0.5",
        ] {
            assert_eq!(objection(line, Place::Head, Some(1)), None, "{line}");
        }
    }

    #[test]
    fn the_generator_is_the_programs_own() {
        assert!(objection("$OUT[1]=TRUE", Place::End, Some(1)).is_some());
        assert!(objection("$OUT[2]=TRUE", Place::End, Some(1)).is_none());
    }
}
