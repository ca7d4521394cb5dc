//! Lines of a machine's profile, which stand in the main program as they are.
//!
//! What they may be is a short list, and all else is refused: a list of what could move the machine, set its zero, call
//! another program or switch the generator would never be complete. On the list are comments, messages, M codes that pause,
//! control the coolant or belong to the builder of the machine, S words, and settings of the control that only make its axes
//! run more smoothly. Which M codes belong to the builder is a question for the dialect
//! ([`Facts::builders_codes`]); those that the job has named for the generator, its
//! readiness or the kinematics are the program's own.

use crate::controller::{Controller, Facts};
use crate::options::Settings;
use crate::statement::Code;

/// Stop, optional stop, coolant on and off.
const COMMON_CODES: [u32; 5] = [0, 1, 7, 8, 9];

/// What speaks against a line.
pub(crate) fn objection(line: &str, settings: &Settings<'_>) -> Option<String> {
    let controller = settings.controller;
    let is_fine = match statement_of_line(line, settings.facts()) {
        Some("") => true,
        Some(code) => {
            let code = code.to_ascii_uppercase();
            is_listed(&code, controller)
                || is_message(&code, controller)
                || has_harmless_words(&code, settings)
        }
        None => false,
    };
    (!is_fine).then(|| {
        format!(
            "`{line}` may change what the program does; a line may be {}",
            allowed(controller)
        )
    })
}

/// The statement of a line that is to be one block as it stands, empty for a comment. None where the control would read
/// something else into it: a number of its own, a comment in front, signs that mean something even in comments.
fn statement_of_line<'l>(line: &'l str, facts: &Facts) -> Option<&'l str> {
    let is_sign = |byte: &u8| !matches!(byte, b'(' | b')');
    let signs = facts.layout.kept_out_of_comments;
    let has_sign = |byte| {
        signs
            .iter()
            .filter(|sign| is_sign(sign))
            .any(|sign| *sign == byte)
    };
    if line.bytes().any(has_sign) {
        return None;
    }
    let line = line.trim();
    match facts.style.code(line, 0) {
        Code::Is(span, code) => (span.start == 0).then_some(code),
        Code::None => line.starts_with(['(', ';', '*']).then_some(""),
        Code::Broken(..) | Code::Active(_) => None,
    }
}

fn allowed(controller: &dyn Controller) -> String {
    let ranges = controller.facts().builders_codes.iter();
    let codes: Vec<String> = ranges
        .map(|range| format!("M{} to M{}", range.start(), range.end()))
        .collect();
    let mut words = format!(
        "a comment, an S word, or one of M0, M1, M7, M8, M9, {} that the job does not use itself",
        codes.join(", ")
    );
    for statement in controller.facts().smoothing {
        words.push_str(&format!(", `{statement}`"));
    }
    if controller.facts().has_messages {
        words.push_str(", `MSG(\"...\")`");
    }
    words
}

fn is_listed(code: &str, controller: &dyn Controller) -> bool {
    let words = |text: &str| text.split_ascii_whitespace().collect::<String>();
    let code = words(code);
    controller
        .facts()
        .smoothing
        .iter()
        .any(|listed| words(listed) == code)
}

/// `MSG("...")`, or `MSG()`, which takes it away.
fn is_message(code: &str, controller: &dyn Controller) -> bool {
    let inner = code
        .strip_prefix("MSG")
        .and_then(|rest| rest.trim_start().strip_prefix('(')?.strip_suffix(')'))
        .map(str::trim);
    let is_text = |inner: &str| {
        let text = inner.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
        inner.is_empty() || text.is_some_and(|text| !text.contains('"'))
    };
    controller.facts().has_messages && inner.is_some_and(is_text)
}

/// Whether a statement in capitals is nothing but M codes that are allowed, and S words.
fn has_harmless_words(code: &str, settings: &Settings<'_>) -> bool {
    let mut rest = code;
    while let Some(letter) = rest.chars().next() {
        let after = rest.get(letter.len_utf8()..).unwrap_or_default().trim_start();
        let end = after.find(|c: char| !(c.is_ascii_digit() || c == '.'));
        let (number, further) = after.split_at(end.unwrap_or(after.len()));
        let is_fine = match letter {
            'M' => number
                .parse()
                .is_ok_and(|number| is_harmless_code(number, settings)),
            'S' => number.parse::<f64>().is_ok() && settings.facts().has_spindle_words,
            _ => false,
        };
        if !is_fine {
            return false;
        }
        rest = further.trim_start();
    }
    true
}

fn is_harmless_code(number: u32, settings: &Settings<'_>) -> bool {
    let mut own = settings.codes.all().into_iter().flat_map(|(_, lines)| lines);
    let is_own = own.any(|line| names_code(line, number));
    let builders = settings.facts().builders_codes;
    let is_allowed = COMMON_CODES.contains(&number) || builders.iter().any(|range| range.contains(&number));
    is_allowed && !is_own
}

/// Whether an M code is among the words of a line of the job. Its comments count as well: better one code too many is the
/// program's own.
fn names_code(line: &str, number: u32) -> bool {
    let line = line.to_ascii_uppercase();
    let mut words = line.split('M').skip(1);
    words.any(|word| {
        let word = word.trim_start();
        let end = word.find(|c: char| !c.is_ascii_digit());
        let digits = word.get(..end.unwrap_or(word.len())).unwrap_or_default();
        digits.parse() == Ok(number)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controller::Codes;
    use crate::controllers;
    use crate::options::OPTIONS;
    use vcutc_backend_api::backend::Options;

    fn is_refused(line: &str, controller: &str) -> bool {
        let options = Options::defaults(OPTIONS);
        let (on, off) = (["M50".to_owned()], ["M 051 (off)".to_owned()]);
        let settings = Settings {
            controller: controllers::of(controller),
            codes: Codes {
                on: &on,
                off: &off,
                ..Settings::read(&options).codes
            },
            ..Settings::read(&options)
        };
        objection(line, &settings).is_some()
    }

    const LINUXCNC: &str = "linuxcnc";
    const FANUC: &str = "fanuc";
    const SINUMERIK: &str = "sinumerik";
    const HEIDENHAIN: &str = "heidenhain";

    const ALL: [&str; 4] = [LINUXCNC, FANUC, SINUMERIK, HEIDENHAIN];

    #[test]
    fn nothing_that_changes_the_program_gets_through() {
        for line in [
            "G92 X10",
            "G0 X0",
            "X10",
            "G1 Z-5 F100",
            "G10 L2 P1 X5",
            "G28",
            "G38.2 Z-5 F10",
            "G53 G0 Z0",
            "G68 X0 Y0 R5",
            "G91",
            "G20",
            "G04.1",
            "CYCLE832(0.1)",
            "M98 P5",
            "M6 T2",
            "M19",
            "M2",
            "M30",
            "M3",
            "M99",
            "M50",
            "m051",
            "M64 P3",
            "M65 P3",
            "M62 P3",
            "M68 E0 Q1",
            "M429",
            "M140 MB MAX",
            "M8 X10",
            "M8 G92 X0",
            "(a) G0 X0",
            "(a (b) X0)",
            "o100 call",
            "O<sub> CALL",
            "#5221=10",
            "#1=[1+2]",
            "R1=5",
            "$A_OUT[12]=1",
            "$P_UIFR[1]=CTRANS(X,10)",
            "MSG(\"a\") X10",
            "MSG(\"a\" << R1)",
            "MSG(\"a\"",
            "TRANS X10",
            "SPOS=10",
            "S1=500",
            "L X+10 FMAX",
            "CALL PGM OTHER",
            "CYCL DEF 7.0 DATUM SHIFT",
            "FN 0: Q1 = 5",
            "T2",
            "D5",
            "F100",
            "%",
            "/M8",
            "N10 M8",
            "N10",
            "12",
            "12 M8",
            "(unclosed",
            "M8 %",
            "GOTO 100",
            "IF [#1 EQ 1] GOTO 5",
        ] {
            for dialect in ALL {
                assert!(is_refused(line, dialect), "{dialect:?}: {line}");
            }
        }
        assert!(is_refused("(LOGOPEN,/tmp/x)", LINUXCNC), "it writes a file");
        assert!(is_refused("(PROBEOPEN x)", LINUXCNC), "it writes a file");
        assert!(is_refused("M8 ; G0", FANUC), "`;` ends a block there");
        assert!(is_refused(";$PATH=/_N_WKS_DIR", SINUMERIK));
        assert!(is_refused("M8 ~", HEIDENHAIN));
        assert!(is_refused("M128", HEIDENHAIN));
        assert!(is_refused("G05.1 Q1", LINUXCNC));
    }

    #[test]
    fn what_is_listed_does() {
        for (line, dialects) in [
            ("M8", &ALL[..]),
            ("m08 M9", &ALL[..]),
            ("(cell 2, hall B)", &ALL[..2]),
            ("M8 (coolant)", &ALL[..2]),
            ("; cell 2", &ALL[2..]),
            ("M7 ; mist", &ALL[2..]),
            ("S1200", &ALL[..3]),
            ("M101", &ALL[..2]),
            ("M61 M22", &ALL[1..]),
            ("G5.1 Q1", &ALL[1..2]),
            ("G05.1 Q1", &ALL[1..2]),
            ("MSG(\"cell 2; wait\")", &ALL[2..3]),
            ("MSG()", &ALL[2..3]),
            ("FFWON", &ALL[2..3]),
        ] {
            for dialect in dialects {
                assert!(!is_refused(line, dialect), "{dialect:?}: {line}");
            }
        }
    }
}
