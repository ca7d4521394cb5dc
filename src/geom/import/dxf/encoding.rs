//! From the bytes of a DXF to its text.
//!
//! Since 2007 a DXF is UTF-8. Before, its letters beyond ASCII are those of the code page that `$DWGCODEPAGE` names; of
//! these the western one is read, which most files name whether or not they have such letters.

/// Why bytes are no text of a DXF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoText {
    /// A DXF in binary form.
    Binary,
    /// A DWG.
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
        Ok(text) => return Ok(text),
        Err(error) => error.into_bytes(),
    };
    match code_page(&bytes).as_deref() {
        Some("ANSI_1252" | "ansi_1252" | "ISO8859-1" | "iso8859-1") => {
            Ok(bytes.into_iter().map(western).collect())
        }
        Some(other) => Err(NoText::CodePage(super::super::shortened(other))),
        None => Err(NoText::NotUtf8(bytes)),
    }
}

/// The code page that a file names: the value of the group behind `$DWGCODEPAGE`.
fn code_page(bytes: &[u8]) -> Option<String> {
    // The header stands at the beginning.
    const HEAD: usize = 65_536;
    let head = String::from_utf8_lossy(bytes.get(..HEAD.min(bytes.len())).unwrap_or_default());
    let behind = head.split_once("$DWGCODEPAGE")?.1;
    let value = behind
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .nth(1)?;
    Some(value.to_owned())
}

/// A character of the code page Windows-1252.
fn western(byte: u8) -> char {
    // 0x80 to 0x9f; five places are empty.
    const PUNCTUATION: [char; 32] = [
        '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
        '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
    ];
    match byte {
        0x80..=0x9f => PUNCTUATION[usize::from(byte - 0x80)],
        _ => char::from(byte),
    }
}
