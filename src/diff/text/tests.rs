//! Hunks against a patch that is applied, and what is reported of line ends and of texts with nothing in
//! common.

use super::*;
use proptest::prelude::*;

fn diff(earlier: &str, fresh: &str) -> Change {
    change(earlier.as_bytes(), fresh.as_bytes(), &|_| None)
}

fn text(earlier: &str, fresh: &str) -> TextChange {
    match diff(earlier, fresh) {
        Change::Text(change) => change,
        other => panic!("{other:?}"),
    }
}

fn numbered(count: usize) -> Vec<String> {
    (0..count).map(|i| format!("LIN {{X {i}}}")).collect()
}

/// What `patch` makes of a text: an independent reading of hunks.
fn patched(earlier: &[String], change: &TextChange) -> Vec<String> {
    let mut lines = Vec::new();
    let mut at = 0;
    for hunk in &change.hunks {
        lines.extend_from_slice(&earlier[at..hunk.earlier.start]);
        assert_eq!(lines.len(), hunk.fresh.start);
        at = hunk.earlier.start;
        for line in &hunk.lines {
            match line.kind {
                LineKind::Added => lines.push(line.text.clone()),
                LineKind::Same => {
                    assert_eq!(earlier[at], line.text);
                    lines.push(line.text.clone());
                    at += 1;
                }
                LineKind::Removed => {
                    assert_eq!(earlier[at], line.text);
                    at += 1;
                }
            }
        }
        assert_eq!(at, hunk.earlier.end);
        assert_eq!(lines.len(), hunk.fresh.end);
    }
    lines.extend_from_slice(&earlier[at..]);
    lines
}

proptest! {
    #[test]
    fn hunks_turn_one_text_into_the_other(
        earlier in prop::collection::vec(0_u8..6, 0..40),
        edits in prop::collection::vec((0_usize..40, 0_u8..8, any::<bool>()), 1..4),
    ) {
        let file = |lines: &[String]| lines.iter().fold(String::new(), |text, line| text + line + "\n");
        let lines = |numbers: &[u8]| -> Vec<String> { numbers.iter().map(u8::to_string).collect() };
        let mut fresh = earlier.clone();
        for (at, value, inserts) in edits {
            let at = at.min(fresh.len());
            if inserts || at == fresh.len() { fresh.insert(at, value) } else { fresh[at] = value }
        }
        prop_assume!(earlier != fresh);
        let (earlier, fresh) = (lines(&earlier), lines(&fresh));
        let change = text(&file(&earlier), &file(&fresh));
        prop_assume!(change.left_out == 0);
        prop_assert_eq!(patched(&earlier, &change), fresh);
        let kinds = |kind| change.hunks.iter().flat_map(|hunk| &hunk.lines).filter(|line| line.kind == kind).count();
        prop_assert_eq!((kinds(LineKind::Removed), kinds(LineKind::Added)), (change.removed, change.added));
    }
}

#[test]
fn changes_near_each_other_share_a_hunk_and_far_ones_do_not() {
    let earlier = numbered(40);
    let mut fresh = earlier.clone();
    for line in [5, 12, 30] {
        fresh[line] += " ; changed";
    }
    let change = text(&earlier.join("\n"), &fresh.join("\n"));
    let places: Vec<_> = change.hunks.iter().map(|hunk| hunk.earlier.clone()).collect();
    assert_eq!(places, [2..16, 27..34]);
    assert_eq!((change.removed, change.added, change.left_out), (3, 3, 0));
}

#[test]
fn line_ends_alone_are_reported_as_such() {
    let found = diff("a\nb\n", "a\r\nb\r\n");
    let expected = Change::LineEnds {
        earlier_crlf: 0,
        fresh_crlf: 2,
    };
    assert_eq!(found, expected);
    assert!(matches!(diff("a\nb", "a\nb\n"), Change::LineEnds { .. }));
    let both = text("a\nb\nc\n", "a\r\nx\r\nc\r\n");
    assert!(both.line_ends_differ);
    assert_eq!((both.removed, both.added), (1, 1));
}

#[test]
fn long_differences_are_cut_and_counted() {
    let change = text(
        &numbered(3000).join("\n"),
        &numbered(3000).join("\n").replace("LIN", "PTP"),
    );
    let shown: usize = change.hunks.iter().map(|hunk| hunk.lines.len()).sum();
    assert_eq!(shown, MOST_LINES);
    assert_eq!((change.removed, change.added), (3000, 3000));
    assert_eq!(change.left_out, 6000 - MOST_LINES);
}

#[test]
fn a_million_lines_with_nothing_in_common_come_to_an_end() {
    let text = |from: u32| -> String {
        (from..from + 300_000)
            .map(|i| format!("{}\n", i % 70_000 + from))
            .collect()
    };
    let Change::Text(change) = diff(&text(0), &text(1_000_000)) else {
        panic!("these differ");
    };
    assert_eq!((change.removed, change.added), (300_000, 300_000));
}

#[test]
fn what_a_terminal_would_obey_is_not_shown() {
    let found = change(b"a\n", b"\x1b[2J\xff\tb\n", &|_| None);
    let Change::Text(found) = found else {
        panic!("{found:?}")
    };
    assert_eq!(found.hunks[0].lines[1].text, "\u{fffd}[2J\u{fffd} b");
    let long = "x".repeat(10_000);
    let found = text("a\n", &long);
    assert_eq!(found.hunks[0].lines[1].text.len(), LONGEST_LINE + 3);
}

#[test]
fn a_hunk_says_what_the_fresh_text_does_there() {
    let about = |bytes: Range<usize>| Some(format!("{bytes:?}"));
    let Change::Text(found) = change(b"a\nb\nc\n", b"a\r\nbb\r\nc\r\n", &about) else {
        panic!("these differ")
    };
    assert_eq!(found.hunks[0].about.as_deref(), Some("3..5"));
}
