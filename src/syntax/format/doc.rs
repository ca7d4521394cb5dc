//! Text with places where it may be broken, and the choice of those where it is.
//!
//! A group stays on one line if it fits there; if not, all its own places are broken, and the groups in it are asked in turn.
//! This is the way of Wadler ("A prettier printer", 2003), without its search: a group is either flat or broken.

/// A piece of text that knows where it may be broken.
#[derive(Clone, Debug)]
pub(super) enum Doc {
    /// Text as it is. One with line ends in it (a long comment) breaks the groups around it.
    Text(String),
    /// A comment that needs the rest of its line, in the column of such comments. It breaks the groups around it.
    Trailing(String),
    /// A blank, or a line end in a broken group.
    Line,
    /// Nothing, or a line end in a broken group.
    Soft,
    /// A line end.
    Hard,
    /// Nothing, but the groups around it are broken.
    Breaks,
    /// Nothing, or a text in a broken group.
    OnlyBroken(&'static str),
    /// What is broken as a whole.
    Group(Group),
    /// What is indented further where it is broken.
    Indent(Vec<Self>),
}

/// What is broken as a whole.
#[derive(Clone, Debug)]
pub(super) struct Group {
    parts: Vec<Doc>,
    /// The width on one line; none if it cannot be on one.
    flat: Option<usize>,
}

/// The column of comments after code, counted from 0; after longer code they are two blanks away.
const COMMENT_COLUMN: usize = 46;

/// How many blanks are before a comment after code that ends in a column.
pub(super) fn blanks_before_comment(column: usize) -> usize {
    COMMENT_COLUMN.saturating_sub(column).max(2)
}

/// Blanks for each step of indentation.
pub(super) const STEP: usize = 2;

impl Doc {
    pub(super) fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A blank that is never broken.
    pub(super) fn blank() -> Self {
        Self::text(" ")
    }

    /// These parts, broken as a whole.
    pub(super) fn group(parts: Vec<Self>) -> Self {
        let flat = flat_width(&parts);
        Self::Group(Group { parts, flat })
    }

    /// The width on one line; none if it cannot be on one.
    fn flat(&self) -> Option<usize> {
        match self {
            Self::Text(text) if text.contains('\n') => None,
            Self::Text(text) => Some(text.chars().count()),
            Self::Line => Some(1),
            Self::Soft | Self::OnlyBroken(_) => Some(0),
            Self::Hard | Self::Breaks | Self::Trailing(_) => None,
            Self::Group(group) => group.flat,
            Self::Indent(parts) => flat_width(parts),
        }
    }
}

impl Doc {
    /// The width of what belongs to the text before it; none where a line can end.
    fn unbreakable(&self) -> Option<usize> {
        match self {
            Self::Text(text) => Some(text.lines().next().map_or(0, |line| line.chars().count())),
            Self::OnlyBroken(text) => Some(text.len()),
            Self::Line
            | Self::Soft
            | Self::Hard
            | Self::Breaks
            | Self::Trailing(_)
            | Self::Group(_)
            | Self::Indent(_) => None,
        }
    }
}

fn flat_width(parts: &[Doc]) -> Option<usize> {
    parts.iter().map(Doc::flat).sum()
}

/// The text on one line, if it can be on one.
pub(super) fn on_one_line(parts: &[Doc]) -> Option<String> {
    flat_width(parts)?;
    let mut printer = Printer {
        text: String::new(),
        column: 0,
        width: usize::MAX,
    };
    printer.parts(parts, Mode::Flat, 0);
    Some(printer.text)
}

/// The text from a column on, broken where lines would be longer than `width`; its lines after the first begin at `indent`.
pub(super) fn wrapped(parts: &[Doc], column: usize, indent: usize, width: usize) -> String {
    let mut printer = Printer {
        text: String::new(),
        column,
        width,
    };
    printer.parts(parts, Mode::Broken, indent);
    printer.text
}

#[derive(Clone, Copy, PartialEq)]
enum Mode {
    Flat,
    Broken,
}

struct Printer {
    text: String,
    column: usize,
    width: usize,
}

impl Printer {
    /// Depth of recursion is that of brackets, which the parser bounds.
    fn parts(&mut self, parts: &[Doc], mode: Mode, indent: usize) {
        for (at, part) in parts.iter().enumerate() {
            match (part, mode) {
                (Doc::Text(text), _) => self.put(text),
                (Doc::Trailing(text), _) => {
                    self.put(&" ".repeat(blanks_before_comment(self.column)));
                    self.put(text);
                }
                (Doc::Line, Mode::Flat) => self.put(" "),
                (Doc::Soft | Doc::OnlyBroken(_), Mode::Flat) | (Doc::Breaks, _) => {}
                (Doc::OnlyBroken(text), Mode::Broken) => self.put(text),
                (Doc::Line | Doc::Soft, Mode::Broken) | (Doc::Hard, _) => self.end_line(indent),
                (Doc::Group(group), _) => {
                    let after = parts.get(at + 1..).unwrap_or_default();
                    let mode = if self.fits(group, after) {
                        Mode::Flat
                    } else {
                        Mode::Broken
                    };
                    self.parts(&group.parts, mode, indent);
                }
                (Doc::Indent(parts), _) => self.parts(parts, mode, indent + STEP),
            }
        }
    }

    /// Whether a group fits on the line, with what cannot be broken off after it.
    fn fits(&self, group: &Group, after: &[Doc]) -> bool {
        let tail: usize = after.iter().map_while(Doc::unbreakable).sum();
        group
            .flat
            .is_some_and(|flat| self.column.saturating_add(flat).saturating_add(tail) <= self.width)
    }

    fn put(&mut self, text: &str) {
        self.text.push_str(text);
        self.column = match text.rsplit_once('\n') {
            Some((_, last)) => last.chars().count(),
            None => self.column.saturating_add(text.chars().count()),
        };
    }

    fn end_line(&mut self, indent: usize) {
        // A line never ends in blanks.
        self.text.truncate(self.text.trim_end_matches(' ').len());
        self.text.push('\n');
        self.text.extend(std::iter::repeat_n(' ', indent));
        self.column = indent;
    }
}
