//! From the bytes of a DXF to its text.
//!
//! Since 2007 a DXF is UTF-8. Before, its letters beyond ASCII are those of the code page that `$DWGCODEPAGE` names; of
//! these the western one is read, which most files name whether or not they have such letters. In either form letters may be
//! written by codes: `\U+00E4` for ä, `%%d` for the sign of degrees.

use crate::import::western;

/// Why bytes are not the text of a DXF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoText {
    /// A DXF in binary form.
    Binary,
    Dwg,
    /// Letters of a code page that is not read, by its name.
    CodePage(String),
    /// No UTF-8, and no code page is named.
    NotUtf8(Vec<u8>),
}

/// What a binary DXF begins with.
const BINARY: &[u8] = b"AutoCAD Binary DXF";

/// The text of a DXF.
///
/// # Errors
/// See [`NoText`].
pub fn dxf_text(bytes: Vec<u8>) -> Result<String, NoText> {
    if bytes.starts_with(BINARY) {
        return Err(NoText::Binary);
    }
    if bytes.starts_with(b"AC10") {
        return Err(NoText::Dwg);
    }
    let bytes = match String::from_utf8(bytes) {
        Ok(text) => return Ok(without_codes(text)),
        Err(error) => error.into_bytes(),
    };
    match code_page(&bytes).as_deref() {
        Some("ANSI_1252" | "ansi_1252" | "ISO8859-1" | "iso8859-1") => {
            Ok(without_codes(bytes.into_iter().map(western).collect()))
        }
        Some(other) => Err(NoText::CodePage(super::super::shortened(other))),
        None => Err(NoText::NotUtf8(bytes)),
    }
}

/// A text with the letters that its codes stand for; what is not a code stays as it is.
fn without_codes(text: String) -> String {
    if !text.contains(UNICODE) && !text.contains(SIGN) {
        return text;
    }
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.as_str();
    while let Some(at) = rest.find(['\\', '%']) {
        let (before, after) = rest.split_at(at);
        plain.push_str(before);
        let (letter, length) =
            letter_of_code(after).unwrap_or_else(|| (after.chars().next().unwrap_or(' '), 1));
        plain.push(letter);
        rest = after.get(length..).unwrap_or_default();
    }
    plain.push_str(rest);
    plain
}

/// Begins the code of a letter by its number in Unicode, four digits of base 16.
const UNICODE: &str = "\\U+";

/// Begins the code of a sign.
const SIGN: &str = "%%";

/// The letter of the code that a text begins with, and how many bytes that has.
fn letter_of_code(text: &str) -> Option<(char, usize)> {
    if let Some(after) = text.strip_prefix(UNICODE) {
        let digits = after.get(..4)?;
        let is_number = digits.chars().all(|digit| digit.is_ascii_hexdigit());
        let number = u32::from_str_radix(digits, 16).ok().filter(|_| is_number)?;
        let letter = char::from_u32(number).filter(|letter| !letter.is_control())?;
        return Some((letter, UNICODE.len() + digits.len()));
    }
    let after = text.strip_prefix(SIGN)?;
    let letter = match after.chars().next()? {
        'd' | 'D' => '°',
        'p' | 'P' => '±',
        'c' | 'C' => '⌀',
        '%' => '%',
        _ => return None,
    };
    Some((letter, SIGN.len() + 1))
}

/// The code page that a file names: the value of the group after `$DWGCODEPAGE`.
fn code_page(bytes: &[u8]) -> Option<String> {
    // The header stands at the beginning.
    const HEAD: usize = 65_536;
    let head = String::from_utf8_lossy(bytes.get(..HEAD.min(bytes.len())).unwrap_or_default());
    let after = head.split_once("$DWGCODEPAGE")?.1;
    let value = after
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .nth(1)?;
    Some(value.to_owned())
}
