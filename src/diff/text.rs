//! Two texts line by line: hunks with context, as people know them from `diff -u`.
//!
//! Lines are compared without their ends, since tools that copy files change those; when nothing else differs, that is what is
//! reported. Programs can have a million lines and nothing in common, so the search is bounded ([`crate::align`]), and of what is
//! found only as much is kept as anybody reads.

use super::Change;
use core::ops::Range;
use similar::{Algorithm, DiffOp, DiffTag, capture_diff_slices, group_diff_ops};

/// Lines of context around a change.
const CONTEXT: usize = 3;
/// Most lines of hunks that are kept of one file.
pub const MOST_LINES: usize = 60;
/// Longest line that is kept, in characters.
const LONGEST_LINE: usize = 200;

/// How the text of a file differs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextChange {
    /// Lines of the earlier text that are gone.
    pub removed: usize,
    /// Lines of the fresh text that are new.
    pub added: usize,
    /// The first places that differ, in order.
    pub hunks: Vec<Hunk>,
    /// Lines of changes that are not among those.
    pub left_out: usize,
    /// Whether line ends differ as well.
    pub line_ends_differ: bool,
}

/// One place that differs, with lines of context around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hunk {
    /// Lines of the earlier text, counted from 0.
    pub earlier: Range<usize>,
    /// Lines of the fresh text, counted from 0.
    pub fresh: Range<usize>,
    /// What the program does there.
    pub about: Option<String>,
    /// The lines in order.
    pub lines: Vec<Line>,
}

/// A line of a hunk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    pub kind: LineKind,
    /// The line without its end; what is not text is replaced, what is too long is cut.
    pub text: String,
}

/// In which of two texts a line stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineKind {
    Same,
    /// In the earlier one.
    Removed,
    /// In the fresh one.
    Added,
}

impl LineKind {
    /// As unified diffs mark it.
    #[must_use]
    pub const fn mark(self) -> char {
        match self {
            Self::Same => ' ',
            Self::Removed => '-',
            Self::Added => '+',
        }
    }
}

/// How two texts differ that are not the same bytes. `about` says what the bytes at a place of the fresh text do.
pub(super) fn change(earlier: &[u8], fresh: &[u8], about: &dyn Fn(Range<usize>) -> Option<String>) -> Change {
    let (earlier, fresh) = (Lines::of(earlier), Lines::of(fresh));
    let ops = capture_diff_slices(Algorithm::Myers, &earlier.lines, &fresh.lines);
    let (mut removed, mut added) = (0, 0);
    for op in changes(&ops) {
        removed += op.old_range().len();
        added += op.new_range().len();
    }
    if removed + added == 0 {
        return Change::LineEnds {
            earlier_crlf: earlier.crlf,
            fresh_crlf: fresh.crlf,
        };
    }
    let (mut hunks, mut room, mut shown) = (Vec::new(), MOST_LINES, 0);
    for group in group_diff_ops(ops, CONTEXT) {
        if room == 0 {
            break;
        }
        let hunk = hunk(&group, &earlier, &fresh, about, room);
        room -= hunk.lines.len();
        shown += hunk
            .lines
            .iter()
            .filter(|line| line.kind != LineKind::Same)
            .count();
        hunks.push(hunk);
    }
    Change::Text(TextChange {
        removed,
        added,
        hunks,
        left_out: removed + added - shown,
        line_ends_differ: earlier.crlf != fresh.crlf,
    })
}

fn changes(ops: &[DiffOp]) -> impl Iterator<Item = &DiffOp> {
    ops.iter().filter(|op| op.tag() != DiffTag::Equal)
}

/// The lines of a text without their ends.
struct Lines<'t> {
    lines: Vec<&'t [u8]>,
    /// Where each begins, in bytes.
    starts: Vec<usize>,
    /// How many end in CR LF.
    crlf: usize,
}

impl<'t> Lines<'t> {
    fn of(text: &'t [u8]) -> Self {
        let (mut lines, mut starts) = (Vec::new(), Vec::new());
        let (mut crlf, mut start) = (0, 0);
        for piece in text.split_inclusive(|&byte| byte == b'\n') {
            let line = piece.strip_suffix(b"\n").unwrap_or(piece);
            let bare = line.strip_suffix(b"\r").unwrap_or(line);
            crlf += usize::from(bare.len() < line.len());
            lines.push(bare);
            starts.push(start);
            start += piece.len();
        }
        Self { lines, starts, crlf }
    }

    /// The bytes of some lines.
    fn bytes(&self, lines: Range<usize>) -> Range<usize> {
        let last = lines.end.saturating_sub(1);
        let end = self.starts.get(last).map_or(0, |start| {
            start + self.lines.get(last).map_or(0, |line| line.len())
        });
        let start = self.starts.get(lines.start).copied().unwrap_or(end);
        start..end.max(start)
    }
}

/// The hunk of a group of changes with their context, cut off where there is no more room for lines.
fn hunk(
    group: &[DiffOp],
    earlier: &Lines<'_>,
    fresh: &Lines<'_>,
    about: &dyn Fn(Range<usize>) -> Option<String>,
    room: usize,
) -> Hunk {
    let of = |lines: &Lines<'_>, range: Range<usize>, kind: LineKind| -> Vec<Line> {
        let lines = lines.lines.get(range).unwrap_or_default().iter().take(room);
        let line = |line: &&[u8]| Line {
            kind,
            text: shown(line),
        };
        lines.map(line).collect()
    };
    let lines_of = |op: &DiffOp| match op.tag() {
        DiffTag::Equal => of(earlier, op.old_range(), LineKind::Same),
        DiffTag::Delete | DiffTag::Insert | DiffTag::Replace => {
            let mut lines = of(earlier, op.old_range(), LineKind::Removed);
            lines.extend(of(fresh, op.new_range(), LineKind::Added));
            lines
        }
    };
    let whole = |range: fn(&DiffOp) -> Range<usize>| {
        let ends = group.first().zip(group.last());
        ends.map_or(0..0, |(first, last)| range(first).start..range(last).end)
    };
    let changed = changes(group).next().map_or(0..0, DiffOp::new_range);
    Hunk {
        earlier: whole(DiffOp::old_range),
        fresh: whole(DiffOp::new_range),
        about: about(fresh.bytes(changed)),
        lines: group.iter().flat_map(lines_of).take(room).collect(),
    }
}

/// A line as it can be shown: no control characters, which a terminal would obey, and not too long.
fn shown(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(line);
    let mut letters = text.chars();
    let mut shown: String = letters
        .by_ref()
        .take(LONGEST_LINE)
        .map(|letter| match letter {
            '\t' => ' ',
            letter if letter.is_control() => '\u{fffd}',
            letter => letter,
        })
        .collect();
    if letters.next().is_some() {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests;
