//! A page of Markdown as people read it on a terminal: without marks, wrapped, code indented, and what to read on at the end.

use std::collections::BTreeSet;

/// How far code and the lines after the first of a list's item are moved in.
const INDENT: &str = "    ";

/// The page in lines of at most this width; code and tables keep their lines.
pub(super) fn plain(page: &str, width: usize) -> String {
    let mut text = String::new();
    let mut paragraph = String::new();
    let mut in_code = false;
    for line in page.lines() {
        let is_fence = line.starts_with("```");
        let is_apart = is_fence || in_code || line.is_empty() || line.starts_with(['#', '|', '-']);
        if is_apart {
            flush(&mut paragraph, width, &mut text);
        }
        if is_fence {
            in_code = !in_code;
        } else if in_code {
            text += &format!("{INDENT}{line}\n");
        } else if line.starts_with('#') {
            text += &format!(
                "{}\n",
                unmarked(line.trim_start_matches('#').trim()).to_uppercase()
            );
        } else if line.is_empty() || line.starts_with('|') {
            text += &format!("{}\n", unmarked(line));
        } else {
            let glue = if paragraph.is_empty() { "" } else { " " };
            paragraph += &format!("{glue}{}", line.trim());
        }
    }
    flush(&mut paragraph, width, &mut text);
    text + &see_also(page)
}

fn flush(paragraph: &mut String, width: usize, text: &mut String) {
    let words = unmarked(&core::mem::take(paragraph));
    let hanging = if words.starts_with("- ") { "  " } else { "" };
    let mut column = 0;
    for word in words.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > width {
            text.push('\n');
            *text += hanging;
            column = hanging.len();
        } else if column > 0 {
            text.push(' ');
            column += 1;
        }
        *text += word;
        column += length;
    }
    if column > 0 {
        text.push('\n');
    }
}

/// The text of links without their addresses.
fn unmarked(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, words, _, after)) = link(rest) {
        plain += before;
        plain += words;
        rest = after;
    }
    plain + rest
}

/// What stands before a link, its words, its address, and what follows.
fn link(text: &str) -> Option<(&str, &str, &str, &str)> {
    let (head, tail) = text.split_once("](")?;
    let (before, words) = head.rsplit_once('[')?;
    let (address, after) = tail.split_once(')')?;
    Some((before, words, address, after))
}

/// The codes and documents that a page mentions.
fn see_also(page: &str) -> String {
    let own = page.trim_start_matches("# ").get(..6).unwrap_or_default();
    let mut codes = BTreeSet::new();
    for word in page.split(|letter: char| !letter.is_ascii_alphanumeric()) {
        let digits = word.strip_prefix("VC").unwrap_or_default();
        if word != own && digits.len() == 4 && digits.bytes().all(|byte| byte.is_ascii_digit()) {
            codes.insert(format!("vcutc explain {word}"));
        }
    }
    let mut rest = page;
    while let Some((_, _, address, after)) = link(rest) {
        let document = address
            .split('#')
            .next()
            .unwrap_or_default()
            .trim_start_matches("../");
        if !document.starts_with("VC") && !document.starts_with("diagnostics/") && document.ends_with(".md") {
            codes.insert(format!("docs/{document}"));
        }
        rest = after;
    }
    if codes.is_empty() {
        return String::new();
    }
    let lines: String = codes.iter().map(|line| format!("{INDENT}{line}\n")).collect();
    format!("\nSEE ALSO\n\n{lines}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# VC0401: a chip\n\nA flank of a `V-cut` must come out, see [VC0403](VC0403.md)\nand [the \
                        process](../process.md#chips).\n\n- one item that is long enough to be wrapped\n\n```vcut\nrough \
                        vcut { }\n```\n";

    #[test]
    fn a_page_is_wrapped_without_its_marks() {
        assert_eq!(
            plain(PAGE, 30),
            "VC0401: A CHIP\n\nA flank of a `V-cut` must come\nout, see VC0403 and the\nprocess.\n\n- one item that is \
             long enough\n  to be wrapped\n\n    rough vcut { }\n\nSEE ALSO\n\n    docs/process.md\n    vcutc explain VC0403\n"
        );
    }

    #[test]
    fn no_page_has_marks_or_long_lines_left() {
        for code in vcutc_diagnostics::Code::ALL {
            let shown = plain(code.page(), 80);
            let is_text = |line: &&str| !line.starts_with([' ', '|']);
            for line in shown.lines().filter(is_text) {
                let is_short = line.chars().count() <= 80 || !line.contains(' ');
                let is_plain = !line.starts_with("```") && !line.starts_with('#') && !line.contains("](");
                let is_heading = line.to_uppercase() == line;
                assert!((is_short || is_heading) && is_plain, "{}: {line}", code.number());
            }
        }
    }
}
