//! Names of programs and their files.
//!
//! One rule serves all dialects: letters, digits and `_`, two letters first [S-JP], at most 18 characters so that the name of a
//! part has at most 24, which every control takes. Case is the dialect's.

use crate::controller::Letters;
use crate::options::Settings;
use vcutc_backend_api::namer::{NameRules, Namer};

/// Longest name of a main program: a program keeps its name when it grows into parts.
const LONGEST_MAIN_NAME: usize = 18;

/// Most parts that a suffix of six characters can distinguish.
pub(crate) const MOST_PARTS: usize = 9999;

const PREFIX: &str = "VC_";

const RULES: NameRules = NameRules {
    max_length: LONGEST_MAIN_NAME,
    prefix: PREFIX,
    reserved: RESERVED,
};

/// The name of the main program for a job of that name.
pub(crate) fn main_name(job: &str, settings: &Settings<'_>) -> String {
    let mut namer = Namer::new(RULES);
    namer.avoid(&settings.common.profile.reserved);
    let two_letters = job.chars().take(2).filter(char::is_ascii_alphabetic).count() == 2;
    let wanted = if two_letters {
        job.to_owned()
    } else {
        format!("{PREFIX}{job}")
    };
    cased(&namer.name(&wanted), settings.facts().name_letters)
}

/// The name of a part, counted from 1.
pub(crate) fn part_name(main: &str, part: usize, settings: &Settings<'_>) -> String {
    cased(&format!("{main}_p{part:03}"), settings.facts().name_letters)
}

/// Text with the letters that are allowed.
pub(crate) fn cased(text: &str, letters: Letters) -> String {
    match letters {
        Letters::Capital => text.to_ascii_uppercase(),
        Letters::Small => text.to_ascii_lowercase(),
        Letters::Any => text.to_owned(),
    }
}

/// Words of Sinumerik's language of two letters and more, which a call by name would be taken for, and names that DOS and
/// Windows keep for devices. Upper case.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    "AC", "ACN", "ACP", "ADIS", "AND", "AUX", "AX", "BLOCK", "CALL", "CASE", "CIP", "CON", "CONTPRON", "CYCLE", "DC", "DEF",
    "DEFAULT", "DEFINE", "DELETE", "DISABLE", "DIV", "DO", "ELSE", "ENABLE", "ENDFOR", "ENDIF", "ENDLOOP", "ENDPROC",
    "ENDWHILE", "EXECUTE", "EXTERN", "FALSE", "FFWON", "FGROUP", "FOR", "FRAME", "FXS", "GOTO", "GOTOB", "GOTOF", "IC", "ID",
    "IDS", "IF", "INT", "LEAD", "LF", "LOOP", "MCALL", "MEAS", "MIRROR", "MOD", "MOV", "MSG", "NOT", "NUL", "OF", "OR", "ORIAXES",
    "ORIMKS", "ORIVECT", "ORIWKS", "PCALL", "POS", "POSA", "PRN", "PROC", "PROTD", "REAL", "REP", "REPEAT", "REPEATB", "RET",
    "ROT", "SAVE", "SCALE", "SET", "SETAL", "SOFT", "SPOS", "STOPRE", "STRING", "SUPA", "TILT", "TO", "TRAFOOF", "TRANS",
    "TRAORI", "TRUE", "UNTIL", "VAR", "WAITE", "WAITM", "WAITP", "WALIMON", "WHEN", "WHENEVER", "WHILE", "WRITE", "XOR",
    "COM1", "COM2", "COM3", "COM4", "LPT1", "LPT2", "LPT3", "LPT4",
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::OPTIONS;
    use proptest::prelude::*;
    use vcutc_backend_api::backend::{OptionValue, Options};
    use vcutc_backend_api::profile::Profile;

    fn named(job: &str, dialect: &'static str, reserved: &[&str]) -> String {
        let profile = Profile {
            reserved: reserved.iter().map(|&name| name.to_owned()).collect(),
            ..Profile::default()
        };
        let mut options = Options::defaults(OPTIONS).with_profile(profile);
        let spec = OPTIONS.iter().find(|spec| spec.key == "dialect").unwrap();
        options.set(spec, OptionValue::Choice(dialect)).unwrap();
        main_name(job, &Settings::read(&options))
    }

    #[test]
    fn names_are_made_fit() {
        for (job, name) in [
            ("rib", "RIB"),
            ("spoiler rib 12", "SPOILER_RIB_12"),
            ("r12", "VC_R12"),
            ("12", "VC_12"),
            ("traori", "VC_TRAORI"),
            ("", "VC"),
            ("a_very_long_name_of_a_job", "VC_A_VERY_LON_YOO2"),
        ] {
            assert_eq!(named(job, "sinumerik", &[]), name, "{job}");
        }
        assert_eq!(named("Rib", "linuxcnc", &[]), "rib");
        assert_eq!(named("Rib", "fanuc", &["rib"]), "RIB_2");
    }

    #[test]
    fn reserved_words_are_in_upper_case_and_cannot_come_from_cutting_a_longer_name() {
        for word in RESERVED {
            assert_eq!(word.to_ascii_uppercase(), *word);
            assert!(word.len() < LONGEST_MAIN_NAME, "{word}");
        }
    }

    proptest! {
        #[test]
        fn any_job_name_gives_a_name_with_two_letters_first(job in ".{0,40}") {
            let name = named(&job, "sinumerik", &[]);
            prop_assert!(name.len() <= LONGEST_MAIN_NAME);
            prop_assert!(name.chars().take(2).filter(char::is_ascii_uppercase).count() == 2, "{}", name);
            prop_assert!(name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_'));
            prop_assert!(!RESERVED.contains(&name.as_str()));
        }
    }
}
