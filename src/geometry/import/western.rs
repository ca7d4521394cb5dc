//! The code page of Windows in the west: what files without UTF-8 are written in.

/// A character of the code page Windows-1252.
pub(super) fn western(byte: u8) -> char {
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
