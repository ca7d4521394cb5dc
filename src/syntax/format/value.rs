//! The words of one statement as a [`Doc`]: where a value may be broken, and where its comments go.
//!
//! A value that is too long is broken before its operators, a piece of a profile before its points, a list of values in
//! brackets at its commas, all of them: then a value that is added later is one line of a diff. A comment stays after
//! the word that it is after; in a list it stays with the value on its line.

use super::doc::Doc;
use super::spacing::{Spacing, between};
use super::types::{Comment, Gap, Kind, Role, Word};

/// A statement's words in two parts: those up to where neighbours share a column, and the rest.
pub(super) struct Parts<'w, 't> {
    pub(super) name: &'w [Word<'t>],
    pub(super) rest: &'w [Word<'t>],
}

/// Where a statement's words are cut for the column that it shares with its neighbours.
pub(super) fn cut<'w, 't>(kind: Kind, words: &'w [Word<'t>]) -> Parts<'w, 't> {
    let at = match kind {
        Kind::Plain | Kind::Block => words.len(),
        Kind::Let | Kind::Value => words
            .iter()
            .position(|word| word.role == Role::Relation)
            .unwrap_or(words.len()),
        Kind::Curve => words.len().min(1),
    };
    let (name, rest) = words.split_at(at);
    Parts { name, rest }
}

/// The words before the shared column.
pub(super) fn name(words: &[Word<'_>]) -> Vec<Doc> {
    row(words, None)
}

/// All words of a statement; a name is filled up to `column` characters.
pub(super) fn statement(kind: Kind, words: &[Word<'_>], column: usize) -> Vec<Doc> {
    let Parts { name, rest } = cut(kind, words);
    let mut docs = vec![Doc::Indent(row(name, None))];
    let mut before = name.last();
    if rest.is_empty() {
        return docs;
    }
    let width: usize = super::doc::on_one_line(&docs).map_or(0, |name| name.chars().count());
    docs.push(Doc::text(" ".repeat(column.saturating_sub(width))));
    let mut value = Vec::new();
    let rest = match rest {
        [relation, value_words @ ..] if relation.role == Role::Relation => {
            lead_in(relation, Spacing::Blank, &mut value);
            value.push(Doc::text(relation.text));
            before = Some(relation);
            value_words
        }
        _ => rest,
    };
    let mut words = row(rest, before);
    let mut begins_below = false;
    if let Some(first) = rest.first() {
        let is_point = kind == Kind::Curve && first.role == Role::Open;
        if is_point && first.comments.is_empty() && words.iter().any(|doc| matches!(doc, Doc::Line)) {
            // Broken before one point, a piece is broken before all.
            words.insert(0, Doc::Line);
        } else {
            lead_in(first, Spacing::Blank, &mut value);
            begins_below = matches!(value.last(), Some(Doc::Hard));
        }
    }
    docs.push(Doc::Indent(value));
    let rest = words;
    // A list alone closes below the name that it belongs to.
    let is_one_piece = !begins_below && !rest.iter().any(|doc| matches!(doc, Doc::Line | Doc::Hard));
    let rest = Doc::group(rest);
    docs.push(if is_one_piece {
        rest
    } else {
        Doc::Indent(vec![rest])
    });
    docs
}

/// Words one after the other, after the word `before`. What is before the first of them is left to the caller.
fn row(words: &[Word<'_>], before: Option<&Word<'_>>) -> Vec<Doc> {
    let mut docs = Vec::new();
    let mut previous = before;
    let mut at = 0;
    while let Some(word) = words.get(at) {
        if let Some(previous) = previous.filter(|_| at > 0) {
            lead_in(word, between(previous, word), &mut docs);
        }
        if matches!(word.role, Role::Open | Role::CallOpen) {
            let length = list_length(words.get(at..).unwrap_or_default());
            let list = words.get(at..at + length).unwrap_or_default();
            docs.push(bracketed(list, previous));
            at += length;
        } else {
            docs.push(Doc::text(word.text));
            at += 1;
        }
        previous = words.get(at.saturating_sub(1));
    }
    docs
}

/// What is before a word: the comments there, on the line of the word before or on lines of their own as they were, or
/// the spacing.
fn lead_in(word: &Word<'_>, spacing: Spacing, docs: &mut Vec<Doc>) {
    let mut line_ends = false;
    for comment in &word.comments {
        if line_ends || comment.is_below() {
            docs.extend([Doc::Hard, Doc::text(comment.text.clone())]);
        } else {
            beside(comment, Line::Words, docs);
        }
        line_ends = comment.ends_its_line();
    }
    let is_alone = |comment: &Comment| comment.is_below() && word.gap != Gap::Beside;
    match (word.comments.last(), spacing) {
        (Some(comment), _) if line_ends || is_alone(comment) => docs.push(Doc::Hard),
        (Some(_), _) | (None, Spacing::Blank) => docs.push(Doc::blank()),
        (None, Spacing::Breakable) => docs.push(Doc::Line),
        (None, Spacing::None) => {}
    }
}

/// What a line begins with.
#[derive(Clone, Copy)]
enum Line {
    Words,
    /// A comment. Those after it are not moved to the column of comments after words: read again, they are all before the
    /// next word.
    Comment,
}

/// A comment on the line of what is before it.
fn beside(comment: &Comment, line: Line, docs: &mut Vec<Doc>) {
    match line {
        Line::Words if comment.ends_its_line() => docs.push(Doc::Trailing(comment.text.clone())),
        Line::Words | Line::Comment => docs.extend([Doc::blank(), Doc::text(comment.text.clone())]),
    }
}

/// How many words a bracket at their beginning takes, to its partner.
fn list_length(words: &[Word<'_>]) -> usize {
    let mut depth: usize = 0;
    for (at, word) in words.iter().enumerate() {
        match word.role {
            Role::Open | Role::CallOpen => depth += 1,
            Role::Close => depth = depth.saturating_sub(1),
            Role::Plain
            | Role::Lead
            | Role::Unit
            | Role::UnitRest
            | Role::Operator
            | Role::Power
            | Role::Sign
            | Role::Relation
            | Role::Comma
            | Role::Odd => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    words.len()
}

/// Comments on the line of what is before them, if that line ends after them, and the others.
fn split_at_line_end(comments: &[Comment], gap: Gap) -> (&[Comment], &[Comment]) {
    let count = comments
        .iter()
        .take_while(|comment| comment.gap == Gap::Beside)
        .count();
    let line_ends = count < comments.len() || gap != Gap::Beside;
    comments.split_at(if line_ends { count } else { 0 })
}

/// A value of a list: its words, and the comma after it.
type Value<'w, 't> = (&'w [Word<'t>], Option<&'w Word<'t>>);

/// The values of a list.
fn values<'w, 't>(inside: &'w [Word<'t>]) -> Vec<Value<'w, 't>> {
    let mut values = Vec::new();
    let (mut start, mut at) = (0, 0);
    while let Some(word) = inside.get(at) {
        match word.role {
            Role::Comma => {
                values.push((inside.get(start..at).unwrap_or_default(), Some(word)));
                at += 1;
                start = at;
            }
            Role::Open | Role::CallOpen => at += list_length(inside.get(at..).unwrap_or_default()),
            Role::Plain
            | Role::Lead
            | Role::Unit
            | Role::UnitRest
            | Role::Operator
            | Role::Power
            | Role::Sign
            | Role::Relation
            | Role::Close
            | Role::Odd => at += 1,
        }
    }
    if start < inside.len() {
        values.push((inside.get(start..).unwrap_or_default(), None));
    }
    values
}

/// A bracket, its values, and its partner.
fn bracketed(words: &[Word<'_>], before: Option<&Word<'_>>) -> Doc {
    let [open, inside @ .., close] = words else {
        return Doc::group(words.iter().map(|word| Doc::text(word.text)).collect());
    };
    let values = values(inside);
    let is_point = before.is_some_and(|word| matches!(word.role, Role::Lead | Role::Close));
    let last_comma = match (open.role, values.len(), is_point) {
        (Role::CallOpen, 1.., _) | (_, 2.., false) => ",",
        _ => "",
    };
    let first = inside.first().unwrap_or(close);
    let (opening, _) = split_at_line_end(&first.comments, first.gap);
    let mut docs = Vec::new();
    trailing(opening.iter(), &mut docs);
    if !opening.is_empty() {
        docs.push(Doc::Breaks);
    }
    docs.push(Doc::Soft);
    let mut done = Done {
        comments: opening.len(),
        tail: tail(opening.last()),
    };
    for (at, &(value, end)) in values.iter().enumerate() {
        let next = values
            .get(at + 1)
            .and_then(|(value, _)| value.first())
            .unwrap_or(close);
        let ending = Ending {
            end,
            next,
            last_comma,
        };
        let is_last = at + 1 == values.len();
        done = one_value(value, done.comments, &ending, &mut docs);
        if !is_last {
            docs.push(Doc::Line);
        }
    }
    let rest = close.comments.get(done.comments..).unwrap_or_default();
    dangling(rest, &values, done.tail, &mut docs);
    Doc::group(vec![
        Doc::text(open.text),
        Doc::Indent(docs),
        Doc::Soft,
        Doc::text(close.text),
    ])
}

/// What is after a value of a list.
struct Ending<'w, 't> {
    /// The comma.
    end: Option<&'w Word<'t>>,
    /// The first word of the next value, or the closing bracket.
    next: &'w Word<'t>,
    /// What is after the last value of a broken list.
    last_comma: &'static str,
}

/// How far a list has been written.
struct Done {
    /// How many of the comments before the next word.
    comments: usize,
    tail: Tail,
}

/// What the last line ends with so far.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tail {
    /// Something that more can follow.
    Open,
    /// A comment that needs the rest of the line.
    LineComment,
}

fn tail(last: Option<&Comment>) -> Tail {
    match last {
        Some(comment) if comment.ends_its_line() => Tail::LineComment,
        Some(_) | None => Tail::Open,
    }
}

/// One value with the comments that belong to it. `done` comments before it have been written. Returns what has been
/// written of those before the next word.
fn one_value(value: &[Word<'_>], done: usize, ending: &Ending<'_, '_>, docs: &mut Vec<Doc>) -> Done {
    if let Some(first) = value.first() {
        leading(first.comments.get(done..).unwrap_or_default(), first.gap, docs);
    }
    docs.push(Doc::group(row(value, None)));
    let before_comma = ending.end.map_or(&[][..], |comma| &comma.comments);
    let kept = before_comma
        .iter()
        .take_while(|comment| !comment.ends_its_line() && !comment.is_below())
        .count();
    let (kept, moved) = before_comma.split_at(kept);
    trailing(kept.iter(), docs);
    let is_last = ending.next.role == Role::Close;
    docs.push(match is_last {
        true => Doc::OnlyBroken(ending.last_comma),
        false => Doc::text(","),
    });
    let (after, _) = split_at_line_end(&ending.next.comments, ending.next.gap);
    trailing(moved.iter().chain(after), docs);
    Done {
        comments: after.len(),
        tail: tail(moved.iter().chain(after).last()),
    }
}

/// Comments after a value of a list. The line of one that needs it ends with the next place where it can.
fn trailing<'c>(comments: impl Iterator<Item = &'c Comment>, docs: &mut Vec<Doc>) {
    let mut line_ends = false;
    let mut line = Line::Words;
    for comment in comments {
        if line_ends || comment.is_below() {
            docs.extend([Doc::Hard, Doc::text(comment.text.clone())]);
            line = Line::Comment;
        } else {
            beside(comment, line, docs);
        }
        line_ends = comment.ends_its_line() || comment.is_below();
    }
    if line_ends {
        docs.push(Doc::Breaks);
    }
}

/// Comments before a value of a list, and what is between them and the value.
fn leading(comments: &[Comment], gap: Gap, docs: &mut Vec<Doc>) {
    for (at, comment) in comments.iter().enumerate() {
        let next = comments.get(at + 1).map_or(gap, |next| next.gap);
        docs.push(Doc::text(comment.text.clone()));
        docs.push(match next {
            Gap::Beside => Doc::blank(),
            Gap::Below | Gap::Apart => Doc::Hard,
        });
    }
}

/// Comments before a closing bracket that no value has taken.
fn dangling(comments: &[Comment], values: &[Value<'_, '_>], tail: Tail, docs: &mut Vec<Doc>) {
    let mut after_line_end = tail == Tail::LineComment;
    let mut line = Line::Words;
    for (at, comment) in comments.iter().enumerate() {
        let is_on_the_line = comment.gap == Gap::Beside && !after_line_end;
        match (is_on_the_line, !values.is_empty() || at > 0) {
            (true, true) => beside(comment, line, docs),
            (false, true) => {
                docs.extend([Doc::Hard, Doc::text(comment.text.clone())]);
                line = Line::Comment;
            }
            (true | false, false) => docs.push(Doc::text(comment.text.clone())),
        }
        after_line_end = comment.ends_its_line();
    }
    if after_line_end {
        docs.push(Doc::Breaks);
    }
}
