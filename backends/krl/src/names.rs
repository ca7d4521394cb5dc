//! Names that a module must not take.
//!
//! A module whose name is a KRL keyword does not compile; one whose name equals a module or a global name of the
//! controller's own software replaces or shadows it, because all folders of the controller form one name space
//! [K-QG, K-FOLD]. Case does not matter.

use vcutc_backend_api::namer::{NameRules, Namer};

/// Longest name of a module or variable [K-QG].
pub(crate) const LONGEST_NAME: usize = 24;

/// Longest name of a main program: room is left for the suffix of a part, so that a program keeps its name when it
/// grows.
pub(crate) const LONGEST_MAIN_NAME: usize = LONGEST_NAME - LONGEST_SUFFIX;

/// `_p` and four digits.
const LONGEST_SUFFIX: usize = 6;

/// Most parts that such a suffix can distinguish.
pub(crate) const MOST_PARTS: usize = 9999;

/// Name of the variable in a data list that holds the home angles.
pub(crate) const HOME: &str = "XVC_HOME";

/// Name of the variable there that holds the angles at which the blade is changed.
pub(crate) const CHANGE: &str = "XVC_CHANGE";

const RULES: NameRules = NameRules {
    max_length: LONGEST_MAIN_NAME,
    prefix: "VC_",
    reserved: RESERVED,
};

/// The name of the main program for a job of that name, in so many parts, on a machine that keeps some names for itself.
pub(crate) fn main_name(job: &str, parts: usize, reserved: &[String]) -> String {
    let mut namer = Namer::new(RULES);
    namer.avoid(reserved);
    let mut name = namer.name(job);
    // A name that is kept may be that of a part of one main program, so these are more than enough.
    for _ in reserved {
        if !has_kept_part(&name, parts, reserved) {
            break;
        }
        name = namer.name(job);
    }
    name
}

/// Whether one of the parts would bear a name that the machine keeps.
fn has_kept_part(main: &str, parts: usize, reserved: &[String]) -> bool {
    let starts_alike = |kept: &&String| {
        kept.get(..main.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(main))
    };
    let alike: Vec<_> = reserved.iter().filter(starts_alike).collect();
    let is_kept = |part| {
        let name = part_name(main, part);
        alike.iter().any(|kept| kept.eq_ignore_ascii_case(&name))
    };
    parts > 1 && !alike.is_empty() && (1..=parts).any(is_kept)
}

/// Whether a text is a name that a routine of the cell can have.
pub(crate) fn is_name(text: &str) -> bool {
    let upper = text.to_ascii_uppercase();
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && text.len() <= LONGEST_NAME
        && !RESERVED.contains(&upper.as_str())
}

/// The name of a part, counted from 1.
pub(crate) fn part_name(main: &str, part: usize) -> String {
    format!("{main}_p{part:03}")
}

/// Keywords of KRL (KSS 8 quick guide), words of the motion planners, types and names that KSS predefines, and
/// modules that come with it. Upper case.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    // Keywords.
    "AND", "ANIN", "ANOUT", "B_AND", "B_EXOR", "B_NOT", "B_OR", "BRAKE", "BOOL", "CASE", "CCLOSE", "CHANNEL", "CHAR",
    "CIRC", "CIRC_REL", "CIRC_TYPE", "CONFIRM", "CONST", "CONST_KEY", "CONTINUE", "COPEN", "CREAD", "CWRITE", "C_DIS",
    "C_ORI", "C_PTP", "C_SPL", "C_VEL", "DECL", "DEF", "DEFAULT", "DEFDAT", "DEFFCT", "DELAY", "DIGIN", "DISTANCE",
    "DO", "ELSE", "END", "ENDDAT", "ENDFCT", "ENDFOR", "ENDIF", "ENDLOOP", "ENDSPLINE", "ENDSWITCH", "ENDTIME_BLOCK",
    "ENDWHILE", "ENUM", "ERR_RAISE", "EXIT", "EXOR", "EXT", "EXTFCT", "EXTFCTP", "EXTP", "FALSE", "FOR", "GLOBAL",
    "GOTO", "HALT", "IF", "IMPORT", "IN", "INT", "INTERRUPT", "IS", "LIN", "LIN_REL", "LOOP", "MAXIMUM", "MINIMUM",
    "NOT", "OFF", "ON", "ONSTART", "OR", "OUT", "PATH", "PRIO", "PTP", "PTP_REL", "PUBLIC", "PULSE", "REAL", "REF",
    "REPEAT", "RESUME", "RETURN", "SCIRC", "SCIRC_REL", "SEC", "SIGNAL", "SLIN", "SLIN_REL", "SPL", "SPL_REL",
    "SPLINE", "SPTP", "SPTP_REL", "SREAD", "STEP", "STRUC", "SWITCH", "SWRITE", "SYNC", "THEN", "TIME_BLOCK", "TO",
    "TRIGGER", "TRUE", "UNTIL", "WAIT", "WHEN", "WHILE", "WITH",
    // Types and built-in functions.
    "ABS", "ACOS", "ASIN", "ATAN2", "AXIS", "COS", "E3AXIS", "E3POS", "E6AXIS", "E6POS", "FDAT", "FORWARD", "FRAME",
    "INVERSE", "LDAT", "LOAD", "PDAT", "POS", "ROUND", "SIN", "SQRT", "TAN", "VARSTATE", "VARTYPE",
    // Variables of $CONFIG.DAT.
    "BASE_DATA", "BASE_NAME", "DEF_ACC_CP", "DEF_ACC_PTP", "DEF_VEL_CP", "DEF_VEL_PTP", "FDAT_ACT", "LDAT_ACT",
    "LDEFAULT", "LOAD_DATA", "MACHINE_DEF", "PDAT_ACT", "PDEFAULT", "SUCCESS", "TOOL_DATA", "TOOL_NAME", "XHOME",
    "XHOME1", "XHOME2", "XHOME3", "XHOME4", "XHOME5",
    // Modules of the controller.
    "A10", "A20", "A50", "BAS", "BASISTECH", "BAS_COMMAND", "CELL", "FLT_SERV", "H50", "H70", "IR_STOPM", "LASER",
    "MASREF_MAIN", "MASREF_USER", "MSG_DEMO", "NEW_SERV", "P00", "PERCEPT", "SPS", "STAT_SERV", "TM_USER", "TOUCHSENSE",
    "USERSPOT", "USER_GLOB", "USER_GRP", "VORGABE", "WEAV_DEF",
    // Names that DOS and Windows keep for devices: no file of a controller can be called so.
    "AUX", "COM1", "COM2", "COM3", "COM4", "COM5", "COM6", "COM7", "COM8", "COM9", "CON", "LPT1", "LPT2", "LPT3",
    "LPT4", "LPT5", "LPT6", "LPT7", "LPT8", "LPT9", "NUL", "PRN",
    // Our own variables.
    HOME, CHANGE,
];

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn reserved_words_are_in_upper_case_and_cannot_come_from_cutting_a_longer_name() {
        for word in RESERVED {
            assert_eq!(word.to_ascii_uppercase(), *word);
            assert!(word.len() < LONGEST_MAIN_NAME, "{word}");
        }
    }

    #[test]
    fn the_longest_part_name_just_fits() {
        let main = main_name(&"x".repeat(100), 1, &[]);
        assert_eq!(main.len(), LONGEST_MAIN_NAME);
        assert_eq!(part_name(&main, MOST_PARTS).len(), LONGEST_NAME);
        assert_eq!(part_name("rib", 7), "rib_p007");
    }

    #[test]
    fn names_of_the_controller_are_avoided() {
        for name in ["lin", "Bas", "SPS", "xvc_home", "con", "Spline"] {
            assert_eq!(main_name(name, 1, &[]), format!("VC_{name}"));
        }
    }

    #[test]
    fn names_that_the_machine_keeps_are_avoided_for_parts_as_well() {
        let kept = ["RIB".to_owned(), "rib_2_P003".to_owned()];
        assert_eq!(main_name("rib", 1, &kept), "rib_2");
        assert_eq!(main_name("rib", 2, &kept), "rib_2");
        assert_eq!(main_name("rib", 3, &kept), "rib_3");
    }

    proptest! {
        #[test]
        fn any_job_name_gives_a_module_name(job in ".{0,40}") {
            let name = main_name(&job, 1, &[]);
            prop_assert!(!name.is_empty() && name.len() <= LONGEST_MAIN_NAME);
            prop_assert!(name.starts_with(|c: char| c.is_ascii_alphabetic()));
            prop_assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'));
            prop_assert!(!RESERVED.contains(&name.to_ascii_uppercase().as_str()));
        }
    }
}
