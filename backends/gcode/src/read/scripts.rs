//! The files of a program: their statements one by one, and which is called by which name.

use super::context::Context;
use crate::statement::{Code, Flow, ReadError, Routine, Span, Style, line};
use std::borrow::Cow;
use std::collections::BTreeMap;
use vcutc_backend_api::readback::{Place, ProgramFile};

/// A file on the way.
pub(super) struct Script<'t> {
    file: usize,
    text: &'t str,
    pub(super) routine: Option<Routine<'t>>,
    /// Where the next statement is looked for.
    at: usize,
    pub(super) entered: bool,
    /// Whether a statement has been carried out, but for the mark of a tape.
    pub(super) begun: bool,
}

impl<'t> Script<'t> {
    pub(super) fn new(file: usize, source: &'t ProgramFile, context: Context<'_>) -> Self {
        let text = source.text.as_str();
        Self {
            file,
            text,
            routine: context.settings.controller.routine(&source.name, text),
            at: 0,
            entered: false,
            begun: false,
        }
    }

    /// The next statement.
    pub(super) fn next(&mut self, style: Style) -> Option<Line<'t>> {
        loop {
            let (line, next) = line(self.text, self.at)?;
            let code = style.code(line, self.at);
            self.at = next;
            let (span, code) = match code {
                Code::None => continue,
                Code::Is(span, code) => (span, Ok(code)),
                Code::Broken(span, expected) => (span, Err(ReadError::Expected(expected.to_owned()))),
                Code::Active(span) => (span, Err(ReadError::Unknown)),
            };
            return Some(Line {
                place: self.place(span),
                length: line.len(),
                code,
            });
        }
    }

    fn place(&self, span: Span) -> Place {
        Place::of(self.file, span.start..span.end)
    }

    /// Whether nothing stands in front of a place, comments and numbers neither.
    pub(super) fn is_first(&self, place: Place) -> bool {
        let before = usize::try_from(place.start)
            .ok()
            .and_then(|start| self.text.get(..start));
        before.is_some_and(|before| before.trim_ascii().is_empty())
    }

    pub(super) fn end(&self) -> Place {
        let end = self.text.len();
        self.place(Span { start: end, end })
    }
}

/// A line with a statement.
pub(super) struct Line<'t> {
    pub(super) place: Place,
    /// Bytes of the whole line.
    pub(super) length: usize,
    /// The statement, or why none can be read.
    pub(super) code: Result<&'t str, ReadError>,
}

/// The files by the names under which they are called.
pub(super) struct Directory<'t> {
    scripts: BTreeMap<Key<'t>, usize>,
}

/// A name with which files are looked up.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Key<'t> {
    Name(Cow<'t, str>),
    Number(u32),
}

impl<'t> Key<'t> {
    fn of(routine: Routine<'t>) -> Self {
        match routine {
            Routine::Name(name) if name.bytes().any(|byte| byte.is_ascii_lowercase()) => {
                Self::Name(Cow::Owned(name.to_ascii_uppercase()))
            }
            Routine::Name(name) => Self::Name(Cow::Borrowed(name)),
            Routine::Number(number) => Self::Number(number),
        }
    }
}

impl<'t> Directory<'t> {
    pub(super) fn new(scripts: &[Script<'t>]) -> Self {
        let mut found = BTreeMap::new();
        for (place, script) in scripts.iter().enumerate() {
            if let Some(routine) = script.routine {
                found.entry(Key::of(routine)).or_insert(place);
            }
        }
        Self { scripts: found }
    }

    pub(super) fn find(&self, routine: Routine<'_>) -> Option<usize> {
        self.scripts.get(&Key::of(routine)).copied()
    }
}

/// The first file that no other calls.
pub(super) fn main(scripts: &[Script<'_>], directory: &Directory<'_>, context: Context<'_>) -> Option<usize> {
    if scripts.len() < 2 {
        return (!scripts.is_empty()).then_some(0);
    }
    let mut called = vec![false; scripts.len()];
    for (place, script) in scripts.iter().enumerate() {
        for routine in calls(script, context) {
            let to = directory.find(routine).filter(|&to| to != place);
            if let Some(called) = to.and_then(|to| called.get_mut(to)) {
                *called = true;
            }
        }
    }
    Some(called.iter().position(|called| !called).unwrap_or(0))
}

/// Longest call that is looked for: names are shorter than 100 characters.
const LONGEST_CALL: usize = 128;

/// The parts that a file calls.
fn calls<'t>(script: &Script<'t>, context: Context<'_>) -> Vec<Routine<'t>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some((line, next)) = line(script.text, at) {
        if let Code::Is(_, code) = context.settings.facts().style.code(line, at)
            && code.len() <= LONGEST_CALL
            && may_be_call(code)
            && let Ok(order) = context.settings.controller.order(code, context.scope())
            && let Some(Flow::Call(routine)) = order.flow
        {
            found.push(routine);
        }
        at = next;
    }
    found
}

/// Most statements are coordinates after a G code or `L`.
fn may_be_call(code: &str) -> bool {
    match code.as_bytes() {
        [b'G' | b'g' | b'L' | b'l' | b'X' | b'x', second, ..] => {
            second.is_ascii_alphabetic() || *second == b'_'
        }
        [_, ..] => true,
        [] => false,
    }
}
