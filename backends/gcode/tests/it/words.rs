//! A scanner of blocks that knows nothing of the writer: letters with numbers, and the words of more letters that a dialect has.

use std::collections::BTreeSet;

/// A block taken apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Block {
    /// Letters with their numbers, in order. G and M words too.
    pub(crate) words: Vec<(char, String)>,
}

impl Block {
    /// The number after a letter.
    pub(crate) fn number(&self, letter: char) -> Option<f64> {
        let found = self.words.iter().find(|(known, _)| *known == letter);
        found.map(|(_, number)| number.parse().unwrap())
    }

    /// Whether a word such as `G53` is in it.
    pub(crate) fn has(&self, word: &str) -> bool {
        self.words
            .iter()
            .any(|(letter, number)| format!("{letter}{number}") == word)
    }
}

/// Texts of a file that are not blocks of letters and numbers, and whole blocks that have words of more
/// letters.
const OTHERS: &[&str] = &[
    "%",
    "STOPRE",
    "TRAORI",
    "TRAFOOF",
    "ORIAXES ORIMKS",
    "FGROUP(X,Y,Z)",
    "FUNCTION RESET TCPM",
    "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
    "FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS",
    "CYCL DEF 9.0 DWELL TIME",
    "CYCL DEF 247 DATUM SETTING ~",
    "CYCL DEF 32.0 TOLERANCE",
];

/// How such blocks begin that hold a name or a number.
const BEGINNINGS: &[&str] = &[
    "O0",
    "O1",
    "o<",
    "BEGIN PGM ",
    "END PGM ",
    "CALL PGM ",
    "SAMPLE_P",
    "TOOL CALL ",
    "Q339=+",
    "CYCL DEF 9.1 DWELL ",
    "CYCL DEF 32.1",
    "FN 20: WAIT FOR I",
    "$A_OUT[",
    "READY",
];

/// Words of more letters among those of one: `SUPA G1 X..`, `L X.. R0 M91`, `G641 ADIS=2.0`.
const LONG_WORDS: &[&str] = &["SUPA", "L", "ADIS=", "CIP", "CC", "C", "DR+", "DR-"];

/// The block on a line without its comment; none for a line without block.
pub(crate) fn block(line: &str, dialect: &str) -> Option<Block> {
    let line = match dialect {
        // What continues a block has no number.
        "heidenhain" if line.starts_with("  ") => line,
        "heidenhain" => line.split_once(' ').unwrap_or(("", "")).1,
        _ => line,
    };
    let code = match dialect {
        "linuxcnc" | "fanuc" if line.starts_with('(') => "",
        "sinumerik" | "heidenhain" => line.split(';').next().unwrap_or_default(),
        _ => line,
    }
    .trim();
    let other = OTHERS.contains(&code) || BEGINNINGS.iter().any(|start| code.starts_with(start));
    if code.is_empty() || other {
        return None;
    }
    let mut block = Block::default();
    for word in code.split(' ').filter(|word| !LONG_WORDS.contains(word)) {
        let long = [("ADIS=", "P"), ("I1=", "I"), ("J1=", "J"), ("K1=", "K")];
        let long = long
            .into_iter()
            .find_map(|(long, letter)| Some((letter, word.strip_prefix(long)?)));
        let word = long.map_or(word.to_owned(), |(letter, value)| format!("{letter}{value}"));
        let (letter, number) = word.split_at(1);
        assert!(is_number(number), "{word:?} in {line:?}");
        block
            .words
            .push((letter.chars().next().unwrap(), number.to_owned()));
    }
    Some(block)
}

fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let is_zero = digits.bytes().all(|byte| matches!(byte, b'0' | b'.'));
    digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
        && digits.bytes().filter(|&byte| byte == b'.').count() <= 1
        && digits.starts_with(|c: char| c.is_ascii_digit())
        && digits.ends_with(|c: char| c.is_ascii_digit())
        && !(is_zero && text.starts_with('-'))
}

/// Letters, G words and M words that a dialect's programs may have, with the options that the tests give.
pub(crate) struct Vocabulary {
    letters: &'static str,
    codes: BTreeSet<&'static str>,
}

impl Vocabulary {
    /// Of a dialect, from the manuals and not from the writer.
    pub(crate) fn of(dialect: &str) -> Self {
        let (letters, codes): (_, &[&str]) = match dialect {
            "linuxcnc" => (
                "XYZABCFHPLQIJK",
                &[
                    "G1", "G2", "G3", "G4", "G17", "G18", "G19", "G21", "G40", "G43", "G49", "G53", "G54",
                    "G55", "G61.1", "G64", "G91.1", "G80", "G90", "G93", "G94", "M2", "M64", "M65", "M66",
                    "M428", "M429",
                ],
            ),
            "fanuc" => (
                "XYZABCFHPIJK",
                &[
                    "G0", "G1", "G2", "G3", "G4", "G17", "G18", "G19", "G21", "G40", "G43.4", "G49", "G53",
                    "G54", "G55", "G61", "G64", "G80", "G90", "G93", "G94", "M30", "M50", "M51", "M52",
                    "M98", "M99",
                ],
            ),
            "sinumerik" => (
                "XYZABCFDPIJK",
                &[
                    "G1", "G2", "G3", "G4", "G17", "G18", "G19", "G40", "G54", "G55", "G60", "G601", "G641",
                    "G90", "G93", "G94", "G710", "M17", "M30",
                ],
            ),
            _ => ("XYZABCFR", &["M30", "M50", "M51", "M91", "M127"]),
        };
        Self {
            letters,
            codes: codes.iter().copied().collect(),
        }
    }

    /// What is wrong with a block.
    pub(crate) fn breach(&self, block: &Block) -> Option<String> {
        let mut seen = BTreeSet::new();
        for (letter, number) in &block.words {
            let code = format!("{letter}{number}");
            match letter {
                'G' | 'M' if self.codes.contains(code.as_str()) => {}
                'G' | 'M' => return Some(format!("{code} is no word of the dialect")),
                _ if !self.letters.contains(*letter) => return Some(format!("{letter} is no letter of it")),
                _ if !seen.insert(*letter) => return Some(format!("{letter} stands twice")),
                _ => {}
            }
        }
        None
    }
}
