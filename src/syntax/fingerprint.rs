//! The hash of a job: what a program's head says it was made from.
//!
//! It covers everything that the user wrote and the compilation read: the job file, the files that it uses, profiles, drawings
//! and machine descriptions, and what `--set` and `--machine` say over them. Of job files it covers the tokens, so that neither
//! a comment nor the layout changes a program; of other files the text, whatever the ends of its lines. It covers no names of
//! files and no folders, which are others on another computer, no `--option`, which changes how a program is written and not
//! what it does, and nothing of the compiler: where another version makes the same program, that program stays the same.

use crate::lexical::{TokenKind, tokens};
use core::fmt::Write;
use hmac_sha256::Hash;
use vcutc_diagnostics::source::SourceMap;

/// How the names of texts begin that the command line gives, and the one that is left out.
const COMMAND_LINE: &str = "--";
const OPTION: &str = "--option ";

/// The hash of the job whose texts these are, the job file first among the files: 64 hexadecimal digits.
#[must_use]
pub fn of_job(sources: &SourceMap) -> String {
    let (given, files): (Vec<_>, Vec<_>) = sources
        .iter()
        .map(|(_, file)| (file.name.as_str(), file.text.as_str()))
        .filter(|(name, _)| !name.starts_with(OPTION))
        .partition(|(name, _)| name.starts_with(COMMAND_LINE));
    let mut hash = Hash::new();
    for (place, (name, text)) in files.into_iter().enumerate() {
        let is_job = place == 0 || name.ends_with(".vcut");
        hash.update(if is_job { of_tokens(text) } else { of_lines(text) });
    }
    // In which order values are set says nothing.
    let mut given: Vec<[u8; 32]> = given.into_iter().map(|(name, _)| of_tokens(name)).collect();
    given.sort_unstable();
    for one in given {
        hash.update(one);
    }
    hexadecimal(&hash.finalize())
}

/// What stands for a file of data that is not text, or too large to be kept: its length and its hash.
#[must_use]
pub fn of_data(bytes: &[u8]) -> String {
    format!(
        "{} bytes, SHA-256 {}\n",
        bytes.len(),
        hexadecimal(&Hash::hash(bytes))
    )
}

fn hexadecimal(digest: &[u8]) -> String {
    let room = String::with_capacity(2 * digest.len());
    digest.iter().fold(room, |mut all, byte| {
        // Writing into a string does not fail.
        let _ = write!(all, "{byte:02x}");
        all
    })
}

/// Each token with its length before it, so that `a b` is not `ab`. Of a path only its last part counts.
fn of_tokens(text: &str) -> [u8; 32] {
    let mut hash = Hash::new();
    let said = tokens(text).filter(|token| match token.kind {
        TokenKind::Comment | TokenKind::UnclosedComment => false,
        TokenKind::Word
        | TokenKind::Number
        | TokenKind::Text
        | TokenKind::UnclosedText
        | TokenKind::InchMark
        | TokenKind::Open(_)
        | TokenKind::Close(_)
        | TokenKind::Symbol => true,
    });
    for token in said {
        let word = text.get(token.start..token.end).unwrap_or_default();
        let token = match token.kind {
            // The same file beside another folder; what it holds is hashed itself.
            TokenKind::Text => word.rsplit(['/', '\\']).next().unwrap_or(word),
            TokenKind::Word
            | TokenKind::Number
            | TokenKind::UnclosedText
            | TokenKind::InchMark
            | TokenKind::Comment
            | TokenKind::UnclosedComment
            | TokenKind::Open(_)
            | TokenKind::Close(_)
            | TokenKind::Symbol => word,
        };
        hash.update((token.len() as u64).to_le_bytes());
        hash.update(token.as_bytes());
    }
    hash.finalize()
}

fn of_lines(text: &str) -> [u8; 32] {
    let mut hash = Hash::new();
    for line in text.lines() {
        hash.update(line.as_bytes());
        hash.update(b"\n");
    }
    hash.finalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hash(files: &[(&str, &str)]) -> String {
        let mut sources = SourceMap::default();
        for (name, text) in files {
            sources.add(*name, *text);
        }
        of_job(&sources)
    }

    const JOB: (&str, &str) = ("rib.vcut", "job rib { stock = 1 mm }");

    #[test]
    fn comments_layout_folders_and_ends_of_lines_do_not_count() {
        let plain = hash(&[JOB, ("shop/points.csv", "1,2\n3,4\n")]);
        let other = hash(&[
            ("C:/jobs/rib.vcut", "// a rib\r\njob rib {\r\n  stock = 1 mm\r\n}"),
            ("points.csv", "1,2\r\n3,4"),
        ]);
        assert_eq!(plain, other);
        assert_eq!(plain.len(), 64);
    }

    #[test]
    fn the_folder_of_a_file_that_a_job_names_does_not_count() {
        let of = |text: &'static str| hash(&[("rib.vcut", text), ("cells.vcut", "let a = 1 mm")]);
        assert_eq!(of("use \"shop/cells.vcut\""), of("use \"../../shop/cells.vcut\""));
        assert_ne!(of("use \"shop/cells.vcut\""), of("use \"shop/blades.vcut\""));
    }

    #[test]
    fn everything_that_changes_the_job_does() {
        let texts = [
            vec![JOB],
            vec![("rib.vcut", "job rib { stock = 2 mm }")],
            vec![("rib.vcut", "job ri b { stock = 1 mm }")],
            vec![JOB, ("points.csv", "1,2")],
            vec![JOB, ("points.csv", "1,3")],
            vec![JOB, ("points.csv", "1\n2")],
            vec![JOB, ("--set a=1 mm", "a=1 mm")],
            vec![JOB, ("--set a=2 mm", "a=2 mm")],
            vec![JOB, ("--machine gantry", "gantry")],
        ];
        let hashes: Vec<String> = texts.iter().map(|files| hash(files)).collect();
        for (place, one) in hashes.iter().enumerate() {
            assert!(
                !hashes.iter().skip(place + 1).any(|other| other == one),
                "{place}"
            );
        }
    }

    #[test]
    fn the_order_of_overrides_and_the_options_of_targets_do_not() {
        let (a, b) = (("--set a=1 mm", "a=1 mm"), ("--set b=1 mm", "b=1 mm"));
        assert_eq!(hash(&[JOB, a, b]), hash(&[b, a, JOB]));
        assert_eq!(hash(&[JOB]), hash(&[JOB, ("--option decimals=4", "decimals=4")]));
    }

    /// By `sha256sum`, of the parts that the module's text describes.
    #[test]
    fn it_is_sha_256() {
        let inner = Hash::hash(b"\x03\0\0\0\0\0\0\0job");
        let outer = Hash::hash(&inner);
        let hex: String = outer.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(hash(&[("a", "job")]), hex);
    }
}
