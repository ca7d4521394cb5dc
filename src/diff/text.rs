//! Two texts line by line: hunks with context, as people know them from `diff -u`.
//!
//! Lines are compared without their ends, since tools that copy files change those; when nothing else differs, that is what is
//! told. Programs can have a million lines and nothing in common, so alignment is bounded ([`crate::align`]), and of what is
//! found only as much is kept as anybody reads.

use super::Change;
use crate::align::common;
use core::ops::Range;
use std::collections::BTreeMap;

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
    /// Whether line ends differ besides.
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
    /// The line without its end; what is no text is replaced, what is too long is cut.
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
    let regions = regions(&earlier, &fresh);
    let line_ends_differ = earlier.crlf != fresh.crlf;
    if regions.is_empty() {
        return Change::LineEnds {
            earlier_crlf: earlier.crlf,
            fresh_crlf: fresh.crlf,
        };
    }
    let mut change = TextChange {
        line_ends_differ,
        ..TextChange::default()
    };
    for region in &regions {
        change.removed += region.earlier.len();
        change.added += region.fresh.len();
    }
    let mut room = MOST_LINES;
    for group in groups(&regions) {
        let changed: usize = group
            .iter()
            .map(|region| region.earlier.len() + region.fresh.len())
            .sum();
        if room == 0 {
            change.left_out += changed;
            continue;
        }
        let hunk = hunk(group, &earlier, &fresh, about, room);
        let shown = hunk
            .lines
            .iter()
            .filter(|line| line.kind != LineKind::Same)
            .count();
        change.left_out += changed - shown;
        room = room.saturating_sub(hunk.lines.len());
        change.hunks.push(hunk);
    }
    Change::Text(change)
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

/// A stretch in which the texts differ.
#[derive(Clone, Debug)]
struct Region {
    earlier: Range<usize>,
    fresh: Range<usize>,
}

/// Where the texts differ, in order.
fn regions(earlier: &Lines<'_>, fresh: &Lines<'_>) -> Vec<Region> {
    let mut numbers: BTreeMap<&[u8], u32> = BTreeMap::new();
    let mut number_of = |line| {
        let next = u32::try_from(numbers.len()).unwrap_or(u32::MAX);
        *numbers.entry(line).or_insert(next)
    };
    let first: Vec<u32> = earlier.lines.iter().map(|line| number_of(*line)).collect();
    let second: Vec<u32> = fresh.lines.iter().map(|line| number_of(*line)).collect();
    let mut regions = Vec::new();
    let (mut at, mut place) = (0, 0);
    let end = (first.len(), second.len());
    for (earlier, fresh) in common(&first, &second).into_iter().chain([end]) {
        if at < earlier || place < fresh {
            regions.push(Region {
                earlier: at..earlier,
                fresh: place..fresh,
            });
        }
        (at, place) = (earlier + 1, fresh + 1);
    }
    regions
}

/// Regions whose context touches or overlaps, together.
fn groups(regions: &[Region]) -> impl Iterator<Item = &[Region]> {
    regions.chunk_by(|one, next| next.earlier.start - one.earlier.end <= 2 * CONTEXT)
}

/// The hunk of a group, cut off where there is no more room for lines.
fn hunk(
    group: &[Region],
    earlier: &Lines<'_>,
    fresh: &Lines<'_>,
    about: &dyn Fn(Range<usize>) -> Option<String>,
    room: usize,
) -> Hunk {
    let (from, place) = group
        .first()
        .map_or((0, 0), |first| (first.earlier.start, first.fresh.start));
    let lead = CONTEXT.min(from);
    let (from, place) = (from - lead, place - lead);
    let mut lines = Vec::new();
    let (mut at, mut to) = (from, place);
    let mut add = |kind: LineKind, line: Option<&&[u8]>| {
        if let (true, Some(line)) = (lines.len() < room, line) {
            lines.push(Line {
                kind,
                text: shown(line),
            });
        }
    };
    for region in group {
        for line in at..region.earlier.start {
            add(LineKind::Same, earlier.lines.get(line));
        }
        for line in region.earlier.clone() {
            add(LineKind::Removed, earlier.lines.get(line));
        }
        for line in region.fresh.clone() {
            add(LineKind::Added, fresh.lines.get(line));
        }
        (at, to) = (region.earlier.end, region.fresh.end);
    }
    let tail = CONTEXT.min(earlier.lines.len() - at);
    for line in at..at + tail {
        add(LineKind::Same, earlier.lines.get(line));
    }
    let changed = group.first().map_or(place..to, |first| first.fresh.clone());
    Hunk {
        earlier: from..at + tail,
        fresh: place..to + tail,
        about: about(fresh.bytes(changed)),
        lines,
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
