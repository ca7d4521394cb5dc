//! The post-processor profile of a machine, as far as KRL programs can follow it.
//!
//! Lines at the head and at the end of the main program are written as they are. They stand in front of
//! `BAS (#INITMOV,0 )` and after the last motion, so nothing that they set changes how the program moves.
//! They may call, assign, declare and wait; all else is refused, and so is every line that names the output
//! of the generator or the program's home, because the program would no longer be what was proven.

use crate::names::HOME;
use crate::syntax::{Phrase, Statement, is_same_name, statements};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::ir::Cell;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::readback::normalized;

/// Longest line that every release reads.
const LONGEST_LINE: usize = 131;

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
    let outputs: Vec<u32> = cell.into_iter().flat_map(Cell::outputs).collect();
    for line in &profile.header {
        if let Some(why) = objection(line, Place::Head, &outputs) {
            refuse("header", why);
        }
    }
    for line in &profile.footer {
        if let Some(why) = objection(line, Place::End, &outputs) {
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
fn objection(line: &str, place: Place, own: &[u32]) -> Option<String> {
    if line.len() > LONGEST_LINE {
        return Some(format!(
            "`{line}` has {} characters; controllers read up to {LONGEST_LINE}",
            line.len()
        ));
    }
    if !line.bytes().all(|byte| matches!(byte, b' '..=b'~' | b'\t')) {
        return Some(format!("{line:?} is not one line of ASCII"));
    }
    let Statement { phrase, text, .. } = statements(line).next()?;
    if names_own_output(text, own) {
        return Some(format!(
            "`{line}` may switch the generator or the spindle, which the program does itself; outputs are named by plain numbers, as \
             in `$OUT[30]=TRUE`"
        ));
    }
    if normalized(text).to_ascii_uppercase().contains(HOME) {
        return Some(format!(
            "`{line}` names the home of the program, which is its own"
        ));
    }
    let why = match phrase {
        Phrase::Motion(_) | Phrase::Arc(_) => "moves the robot, and nothing has proven where",
        Phrase::Other(_) if !is_assignment(text) => {
            "may move the robot, or make it leave out lines; a line may call a routine, assign, declare or wait"
        }
        Phrase::Def { .. } | Phrase::End | Phrase::DefDat { .. } | Phrase::EndDat => {
            "begins or ends a routine or a data list"
        }
        Phrase::Mark(_) => "is a record of the editor, and those stand in front of the program",
        Phrase::Ext { .. } | Phrase::Declaration(_) if place == Place::End => {
            "is a declaration, and those stand in front of all instructions"
        }
        Phrase::Unreadable { expected } => return Some(format!("`{line}` is not KRL: expected {expected}")),
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

/// Whether a statement names the output of the generator, or outputs that cannot be identified: by a
/// calculated number, as a range, or by a number alone.
fn names_own_output(text: &str, own: &[u32]) -> bool {
    let text = normalized(text).to_ascii_uppercase();
    let mut outputs = text.split("$OUT").skip(1);
    let is_other = |rest: &str| {
        let rest = rest.strip_prefix("_C").unwrap_or(rest);
        let number = rest.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        number.is_some_and(|(number, _)| number.parse::<u32>().is_ok_and(|number| !own.contains(&number)))
    };
    outputs.any(|rest| !is_other(rest))
}

/// `name=...`, `name[...].field=...`.
fn is_assignment(text: &str) -> bool {
    let is_of_variable = |c: char| c.is_ascii_alphanumeric() || "$_.[],".contains(c);
    text.split_once('=').is_some_and(|(to, value)| {
        let to = to.trim();
        !to.is_empty() && to.chars().all(is_of_variable) && !value.starts_with('=')
    })
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
    fn its_own_extension_is_accepted() {
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
            "PULSE($OUT[12],TRUE,1)",
            "PULSE ($OUT[7],TRUE,0.5)",
            "TRIGGER WHEN DISTANCE=0 DELAY=0 DO $OUT[7]=TRUE",
            "CONTINUE",
            "INTERRUPT DECL 4 WHEN $IN[1]==TRUE DO STOPPED( )",
            "FOR I=1 TO 5",
            "LOOP",
            "SIGNAL LAMP $OUT[1] TO $OUT[16]",
            "XVC_HOME={A1 0.0}",
            "xvc_home.A1=5",
        ] {
            assert!(objection(line, Place::Head, &[1]).is_some(), "{line}");
        }
        for line in [
            "; a word",
            "",
            "CELL_READY( )",
            "$OUT[12]=TRUE",
            "DECL INT COUNT",
            "COUNT=COUNT+1",
            "$OUT[7]=$IN[3]",
            "WAIT SEC 0.5",
        ] {
            assert_eq!(objection(line, Place::Head, &[1]), None, "{line}");
        }
    }

    #[test]
    fn the_generator_is_the_programs_own() {
        for line in [
            "$OUT[12]=TRUE",
            "$out[ 012 ]=TRUE",
            "$OUT[12+0]=TRUE",
            "$OUT[COUNT]=TRUE",
            "$OUT[6*2]=TRUE",
            "$OUT_C[12]=TRUE",
            "PULSE($OUT[12],TRUE,1)",
            "SWITCH_ON( $OUT[12] )",
            "SIGNAL LAMP $OUT[12]",
            "LAMP=$OUT[12]",
        ] {
            for place in [Place::Head, Place::End] {
                assert!(objection(line, place, &[12]).is_some(), "{line}");
            }
        }
        assert!(objection("$OUT[2]=TRUE", Place::End, &[12]).is_none());
        assert!(objection("$OUT[12]=TRUE", Place::End, &[2]).is_none());
    }
}
