//! Which routines there are, and where they stand: found by the first words of lines, before anything is carried out.

use crate::syntax::cursor::Cursor;
use crate::syntax::{Phrase, Scope, Span, is_same_name, statements};
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::readback::{ProgramFile, has_extension};

/// A routine of a source file.
#[derive(Clone, Copy, Debug)]
pub struct Routine<'t> {
    /// Place of its file among those that were indexed.
    pub file: usize,
    /// Its name; empty when its head has none that could be called.
    pub name: &'t str,
    /// From the line of its head up to and including the line that ends it.
    pub span: Span,
    /// The module's own routine is its first.
    pub rank: Rank,
    /// Who may call a routine that is not the first.
    scope: Scope,
}

/// A routine's place in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// The module's routine, which bears the name of the file.
    First,
    /// A subprogram after it.
    Further,
}

/// The routines of all files.
#[derive(Debug, Default)]
pub struct Index<'t> {
    /// File by file, in the order of their text.
    pub routines: Vec<Routine<'t>>,
    /// What stands in source files outside of routines.
    pub gaps: Vec<(usize, Span)>,
    /// Names, in upper case, of what everyone may call.
    open: BTreeMap<String, usize>,
    /// Names, in upper case, of what only routines of a file may call.
    local: BTreeMap<(usize, String), usize>,
    /// Names, in upper case, after which brackets follow.
    called: BTreeSet<String>,
}

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Routines.
    Source,
    Data,
}

impl FileKind {
    /// By the name of the file: what does not end in `.dat` is taken for routines.
    #[must_use]
    pub fn of(file: &ProgramFile) -> Self {
        if has_extension(&file.name, &["dat"]) {
            Self::Data
        } else {
            Self::Source
        }
    }
}

impl<'t> Index<'t> {
    /// The routines of these files.
    #[must_use]
    pub fn of(files: &'t [ProgramFile]) -> Self {
        let mut index = Self::default();
        for (place, file) in files.iter().enumerate() {
            match FileKind::of(file) {
                FileKind::Source => index.source(place, &file.text),
                FileKind::Data => {}
            }
        }
        for (place, routine) in index.routines.iter().enumerate() {
            let name = routine.name.to_ascii_uppercase();
            let open = match (routine.rank, routine.scope) {
                (Rank::First, _) | (Rank::Further, Scope::Global) => true,
                (Rank::Further, Scope::Module) => false,
            };
            if open {
                index.open.entry(name.clone()).or_insert(place);
            }
            index.local.entry((routine.file, name)).or_insert(place);
        }
        index
    }

    fn source(&mut self, file: usize, text: &'t str) {
        let mut at = 0;
        // Where what comes before the next routine began, and the routine that is open.
        let mut gap = 0;
        let mut open: Option<Routine<'t>> = None;
        let mut rank = Rank::First;
        while at < text.len() {
            let start = at;
            let rest = text.get(start..).unwrap_or_default();
            let length = rest.find('\n').unwrap_or(rest.len());
            at = (start + length + 1).min(text.len());
            let line = rest.get(..length).unwrap_or_default();
            match Head::of(line) {
                Head::Begins => {
                    if let Some(routine) = open.take() {
                        self.close(routine, start);
                    } else {
                        self.gap(file, gap, start);
                    }
                    let (name, scope) = named(line);
                    let span = Span { start, end: start };
                    open = Some(Routine {
                        file,
                        name,
                        span,
                        rank,
                        scope,
                    });
                    rank = Rank::Further;
                }
                Head::Ends => {
                    if let Some(routine) = open.take() {
                        self.close(routine, at);
                        gap = at;
                    }
                }
                Head::Calls(name) => {
                    // That a routine calls itself does not make it one that others call.
                    if !open.is_some_and(|routine| is_same_name(routine.name, name)) {
                        self.called.insert(name.to_ascii_uppercase());
                    }
                }
                Head::Other => {}
            }
        }
        match open {
            Some(routine) => self.close(routine, text.len()),
            None => self.gap(file, gap, text.len()),
        }
    }

    fn close(&mut self, routine: Routine<'t>, end: usize) {
        let start = routine.span.start;
        self.routines.push(Routine {
            span: Span { start, end },
            ..routine
        });
    }

    fn gap(&mut self, file: usize, start: usize, end: usize) {
        if start < end {
            self.gaps.push((file, Span { start, end }));
        }
    }

    /// The routine of that name, as a file calls it.
    #[must_use]
    pub fn find(&self, file: usize, name: &str) -> Option<usize> {
        let name = name.to_ascii_uppercase();
        let open = self.open.get(&name).copied();
        self.local.get(&(file, name)).copied().or(open)
    }

    /// The routine to begin with: the first of a file that is not called.
    #[must_use]
    pub fn main(&self) -> Option<usize> {
        let firsts = || {
            let all = self.routines.iter().enumerate();
            all.filter(|(_, routine)| routine.rank == Rank::First)
        };
        let uncalled =
            firsts().find(|(_, routine)| !self.called.contains(&routine.name.to_ascii_uppercase()));
        uncalled.or_else(|| firsts().next()).map(|(place, _)| place)
    }
}

/// What the first words of a line make it.
enum Head<'t> {
    Begins,
    Ends,
    Calls(&'t str),
    Other,
}

impl<'t> Head<'t> {
    fn of(line: &'t str) -> Self {
        let mut cursor = Cursor::new(line);
        let Some(word) = cursor.word() else {
            return Self::Other;
        };
        if cursor.peek() == Some(b'(') {
            return Self::Calls(word);
        }
        let is = |name| is_same_name(word, name);
        match word.as_bytes() {
            [b'D' | b'd', ..] if is("DEF") || is("DEFFCT") => Self::Begins,
            [b'E' | b'e', ..] if is("END") || is("ENDFCT") => Self::Ends,
            [b'G' | b'g', ..] if is("GLOBAL") => match cursor.word() {
                Some(word) if is_same_name(word, "DEF") || is_same_name(word, "DEFFCT") => Self::Begins,
                Some(_) | None => Self::Other,
            },
            _ => Self::Other,
        }
    }
}

/// Name and scope in the head of a routine. Functions give a value, which only arithmetic could use: they have none here.
fn named(line: &str) -> (&str, Scope) {
    match statements(line).next().map(|head| head.phrase) {
        Some(Phrase::Def { name, scope }) => (name, scope),
        _ => ("", Scope::Module),
    }
}
