//! Statements as lines: indentation, empty lines, shared columns, blocks on one line, comments after statements.
//!
//! Nothing here depends on what a line of another statement looks like, with one exception: neighbours share the column of
//! their `=`, so that a name longer than all its neighbours moves them. Empty lines and comments of their own line end such a
//! neighbourhood, and names beyond [`LONGEST_NAME`] stay out of it.

use super::WIDTH;
use super::doc::{Doc, STEP, blanks_before_comment, on_one_line, wrapped};
use super::types::{Body, Comment, Extent, Gap, Kind, Source, Statement};
use super::value::{cut, statement};

/// Longest name that shares a column with its neighbours, in characters.
const LONGEST_NAME: usize = 24;
/// More bytes than a line has that fits, whatever its characters. Blocks nested in one another are not looked through beyond.
const MOST_BYTES: usize = 4 * (WIDTH + LONGEST_NAME);

/// The lines of a whole text.
pub(super) fn file(source: &Source<'_>) -> String {
    let mut writer = Writer {
        text: String::new(),
        depth: 0,
    };
    writer.statements(&source.statements, &source.closing);
    if !writer.text.is_empty() {
        writer.text.push('\n');
    }
    writer.text
}

struct Writer {
    text: String,
    depth: usize,
}

impl Writer {
    fn indent(&self) -> usize {
        self.depth * STEP
    }

    /// Begins a line, with an empty one before it if there was one.
    fn begin_line(&mut self, gap: Gap, is_first: bool) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
        if gap == Gap::Apart && !is_first {
            self.text.push('\n');
        }
        self.text.extend(std::iter::repeat_n(' ', self.depth * STEP));
    }

    /// How many characters the last line has.
    fn column(&self) -> usize {
        let start = self.text.rfind('\n').map_or(0, |at| at + 1);
        self.text.get(start..).unwrap_or_default().chars().count()
    }

    /// Statements of one block or of the file, and the comments after them.
    fn statements(&mut self, statements: &[Statement<'_>], closing: &[Comment]) {
        let columns = columns(statements, self.depth);
        for (at, (statement, column)) in statements.iter().zip(columns).enumerate() {
            let is_begun = self.comments_before(&statement.leading, statement.gap, at == 0);
            if !is_begun {
                self.begin_line(statement.gap, at == 0 && statement.leading.is_empty());
            }
            self.statement(statement, column);
            self.comments_after(&statement.trailing);
        }
        self.comments_before(closing, Gap::Below, statements.is_empty());
    }

    /// Comments before a statement. Returns whether the statement goes on their last line.
    fn comments_before(&mut self, comments: &[Comment], gap: Gap, is_first: bool) -> bool {
        let mut is_begun = false;
        for (at, comment) in comments.iter().enumerate() {
            if !is_begun {
                self.begin_line(comment.gap, is_first && at == 0);
            }
            self.text.push_str(&comment.text);
            let next = comments.get(at + 1).map_or(gap, |next| next.gap);
            is_begun = next == Gap::Beside;
            if is_begun {
                self.text.push(' ');
            }
        }
        is_begun
    }

    /// Comments on the line that a statement or a brace ends.
    fn comments_after(&mut self, comments: &[Comment]) {
        for (at, comment) in comments.iter().enumerate() {
            let blanks = match at {
                0 => blanks_before_comment(self.column()),
                _ => 1,
            };
            self.text.extend(std::iter::repeat_n(' ', blanks));
            self.text.push_str(&comment.text);
        }
    }

    fn statement(&mut self, found: &Statement<'_>, column: usize) {
        if let Some(line) = one_line(found, self.depth, column) {
            self.text.push_str(&line);
            return;
        }
        let words = statement(found.kind, &found.words, column);
        let text = wrapped(&words, self.column(), self.indent(), WIDTH);
        self.text.push_str(&text);
        if let Some(body) = &found.body {
            self.body(body);
        }
    }

    /// Comments between a head and its brace, and what is before the brace.
    fn comments_before_brace(&mut self, comments: &[Comment]) {
        let mut line_ends = false;
        for comment in comments {
            if line_ends || comment.is_below() {
                self.depth += 1;
                self.begin_line(Gap::Below, false);
                self.depth -= 1;
                self.text.push_str(&comment.text);
            } else if comment.ends_its_line() {
                self.comments_after(std::slice::from_ref(comment));
            } else {
                self.text.push(' ');
                self.text.push_str(&comment.text);
            }
            line_ends = comment.ends_its_line() || comment.is_below();
        }
        if line_ends {
            self.begin_line(Gap::Below, false);
        } else {
            self.text.push(' ');
        }
    }

    fn body(&mut self, body: &Body<'_>) {
        self.comments_before_brace(&body.before);
        self.text.push('{');
        self.comments_after(&body.opening);
        self.depth += 1;
        self.statements(&body.statements, &body.closing);
        self.depth -= 1;
        self.begin_line(Gap::Below, false);
        self.text.push('}');
    }
}

/// A statement with its block on one line: if it was written so, and fits.
///
/// The blanks that fill its name up to the column do not count: otherwise a neighbour's name would decide.
fn one_line(found: &Statement<'_>, depth: usize, column: usize) -> Option<String> {
    let body = found.body.as_ref()?;
    let plain = block_on_one_line(found, body, 0)?;
    let fits = depth * STEP + plain.chars().count() <= WIDTH;
    match (fits, column) {
        (false, _) => None,
        (true, 0) => Some(plain),
        (true, _) => block_on_one_line(found, body, column),
    }
}

fn block_on_one_line(found: &Statement<'_>, body: &Body<'_>, column: usize) -> Option<String> {
    let is_empty = body.statements.is_empty() && body.opening.is_empty() && body.closing.is_empty();
    let breaks =
        |comment: &Comment| comment.ends_its_line() || comment.is_below() || comment.text.contains('\n');
    if (body.extent == Extent::ManyLines && !is_empty) || body.before.iter().any(breaks) {
        return None;
    }
    let mut line = on_one_line(&statement(found.kind, &found.words, column))?;
    if found.kind == Kind::Block {
        let width = line.chars().count();
        line.extend(std::iter::repeat_n(' ', column.saturating_sub(width)));
    }
    for comment in &body.before {
        line.push(' ');
        line += &comment.text;
    }
    line += " {";
    for (at, entry) in body.statements.iter().enumerate() {
        line += if at == 0 { " " } else { ", " };
        line += &entry_on_one_line(entry)?;
        if line.len() > MOST_BYTES {
            return None;
        }
    }
    for comment in body.opening.iter().chain(&body.closing) {
        line.push(' ');
        line += &comment.text;
    }
    line += if is_empty { "}" } else { " }" };
    Some(line)
}

fn entry_on_one_line(entry: &Statement<'_>) -> Option<String> {
    let mut line: String = entry
        .leading
        .iter()
        .map(|comment| format!("{} ", comment.text))
        .collect();
    line += &match &entry.body {
        Some(body) => block_on_one_line(entry, body, 0)?,
        None => on_one_line(&statement(entry.kind, &entry.words, 0))?,
    };
    line.extend(entry.trailing.iter().map(|comment| format!(" {}", comment.text)));
    Some(line)
}

/// What shares a column.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Lets,
    Fields,
    Curves,
}

/// To how many characters the name of each statement is filled up; 0 for those that share no column.
fn columns(statements: &[Statement<'_>], depth: usize) -> Vec<usize> {
    let mut columns = Vec::with_capacity(statements.len());
    let mut members = statements
        .iter()
        .map(|statement| (statement, member(statement, depth)))
        .peekable();
    while let Some((_, first)) = members.next() {
        let Some((family, mut width)) = first else {
            columns.push(0);
            continue;
        };
        let mut count = 1;
        while let Some((_, Some((_, next)))) = members.next_if(|(statement, next)| {
            let is_of_the_family = next.is_some_and(|(next, _)| next == family);
            is_of_the_family && statement.gap != Gap::Apart && statement.leading.is_empty()
        }) {
            width = width.max(next);
            count += 1;
        }
        columns.extend(std::iter::repeat_n(width, count));
    }
    columns
}

/// The family of a statement that shares a column, and the width of its name.
fn member(found: &Statement<'_>, depth: usize) -> Option<(Family, usize)> {
    let family = match (found.kind, &found.body) {
        (Kind::Let, _) => Family::Lets,
        (Kind::Value, _) => Family::Fields,
        (Kind::Curve, _) => Family::Curves,
        (Kind::Block, Some(_)) if depth > 0 && one_line(found, depth, 0).is_some() => Family::Fields,
        (Kind::Block | Kind::Plain, _) => return None,
    };
    let begins_its_line = found.leading.last().is_none_or(|_| found.gap != Gap::Beside);
    let name = cut(found.kind, &found.words).name;
    let has_comments = name.iter().any(|word| !word.comments.is_empty());
    let docs: Vec<Doc> = super::value::name(name);
    let width = on_one_line(&docs)?.chars().count();
    (begins_its_line && !has_comments && width <= LONGEST_NAME).then_some((family, width))
}
