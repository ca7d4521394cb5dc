//! Which statement comes next: the main routine, and others where they are called.

use super::index::{FileKind, Index, Rank, Routine};
use super::variables::Context;
use crate::syntax::{Span, Statement, Statements, statements};
use vcutc_backend_api::readback::{ProgramFile, stem};

/// The way through a program. Nothing is entered until the caller does so.
#[derive(Debug)]
pub struct Execution<'t> {
    files: &'t [ProgramFile],
    index: Index<'t>,
    /// Which routines have been entered.
    entered: Vec<bool>,
    calls: Vec<Call<'t>>,
}

/// A routine that is carried out.
#[derive(Debug)]
struct Call<'t> {
    routine: Routine<'t>,
    context: Context<'t>,
    lines: Statements<'t>,
    /// The statement before the next one.
    last: Option<Span>,
}

/// A statement that is carried out.
#[derive(Clone, Debug)]
pub struct Line<'t> {
    /// Place of its file among those of the program.
    pub file: usize,
    /// Place of its routine in its file.
    pub rank: Rank,
    /// Where it stands, for names.
    pub context: Context<'t>,
    /// The statement.
    pub statement: Statement<'t>,
}

/// A routine breaks off without `END`, and has been left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BreaksOff {
    /// Its file.
    pub file: usize,
    /// Its last statement.
    pub last: Option<Span>,
    /// Where its text ends.
    pub end: usize,
}

impl<'t> Execution<'t> {
    /// Before the first statement of a program.
    #[must_use]
    pub fn of(files: &'t [ProgramFile]) -> Self {
        let index = Index::of(files);
        Self {
            files,
            entered: vec![false; index.routines.len()],
            index,
            calls: Vec::new(),
        }
    }

    fn text(&self, file: usize) -> &'t str {
        self.files.get(file).map_or("", |file| &file.text)
    }

    /// The module that a file is, or belongs to.
    fn module(&self, file: usize) -> &'t str {
        self.files.get(file).map_or("", |file| stem(&file.name).0)
    }

    /// The data lists, by their files. Their variables are there before anything is carried out.
    pub fn data_lists(&self) -> impl Iterator<Item = (usize, Context<'t>, Statements<'t>)> {
        let files = self.files.iter().enumerate();
        let lists = files.filter(|(_, file)| FileKind::of(file) == FileKind::Data);
        lists.map(|(place, file)| {
            let context = Context {
                routine: None,
                module: stem(&file.name).0,
            };
            (place, context, statements(&file.text))
        })
    }

    /// The statements outside of routines, which no controller carries out: each with its file, and where the gap between
    /// routines begins that it stands in.
    pub fn outside(&self) -> impl Iterator<Item = (usize, usize, Statement<'t>)> {
        self.index.gaps.iter().flat_map(|&(file, gap)| {
            let lines = Statements::within(self.text(file), gap);
            lines.map(move |statement| (file, gap.start, statement))
        })
    }

    /// The routine to begin with.
    #[must_use]
    pub fn main(&self) -> Option<usize> {
        self.index.main()
    }

    /// The routine of a name, as a file calls it.
    #[must_use]
    pub fn find(&self, file: usize, name: &str) -> Option<usize> {
        self.index.find(file, name)
    }

    /// A routine.
    #[must_use]
    pub fn routine(&self, place: usize) -> Option<&Routine<'t>> {
        self.index.routines.get(place)
    }

    /// Whether a routine has been entered.
    #[must_use]
    pub fn has_entered(&self, place: usize) -> bool {
        self.entered.get(place) == Some(&true)
    }

    /// The routines that have not been entered, by their files.
    pub fn never_called(&self) -> impl Iterator<Item = (usize, Statements<'t>)> {
        let routines = self.index.routines.iter().zip(&self.entered);
        let others = routines.filter(|(_, entered)| !**entered);
        others.map(|(routine, _)| {
            let lines = Statements::within(self.text(routine.file), routine.span);
            (routine.file, lines)
        })
    }

    /// Goes on in a routine, and after its end where it was called.
    pub fn enter(&mut self, place: usize) {
        let (Some(&routine), Some(entered)) = (self.index.routines.get(place), self.entered.get_mut(place))
        else {
            return;
        };
        *entered = true;
        self.calls.push(Call {
            routine,
            context: Context {
                routine: Some(place),
                module: self.module(routine.file),
            },
            lines: Statements::within(self.text(routine.file), routine.span),
            last: None,
        });
    }

    /// Goes on where the routine was called.
    pub fn leave(&mut self) {
        self.calls.pop();
    }

    /// How many routines are open.
    #[must_use]
    pub const fn depth(&self) -> usize {
        self.calls.len()
    }

    /// Whether no statement follows in the routine.
    #[must_use]
    pub fn is_at_end(&self) -> bool {
        let call = self.calls.last();
        call.is_none_or(|call| call.lines.clone().next().is_none())
    }
}

impl<'t> Iterator for Execution<'t> {
    type Item = Result<Line<'t>, BreaksOff>;

    fn next(&mut self) -> Option<Self::Item> {
        let call = self.calls.last_mut()?;
        let Routine { file, rank, span, .. } = call.routine;
        let Some(statement) = call.lines.next() else {
            let last = call.last;
            self.leave();
            let end = span.end;
            return Some(Err(BreaksOff { file, last, end }));
        };
        call.last = Some(statement.span);
        Some(Ok(Line {
            file,
            rank,
            context: call.context,
            statement,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::Phrase;

    #[test]
    fn routines_are_left_at_their_end_or_where_the_text_breaks_off() {
        let file = ProgramFile {
            name: "main.src".to_owned(),
            text: "DEF main()\nsub()\nEND\nDEF sub()\nHALT\n".to_owned(),
        };
        let files = [file];
        let mut execution = Execution::of(&files);
        execution.enter(execution.main().unwrap());
        let mut seen = Vec::new();
        while let Some(step) = execution.next() {
            let line = match step {
                Ok(line) => line,
                Err(BreaksOff { end, .. }) => {
                    seen.push(format!("breaks off at {end}"));
                    continue;
                }
            };
            seen.push(line.statement.text.to_owned());
            match line.statement.phrase {
                Phrase::Call { name, .. } => execution.enter(execution.find(line.file, name).unwrap()),
                Phrase::End => execution.leave(),
                _ => {}
            }
        }
        let expected = [
            "DEF main()",
            "sub()",
            "DEF sub()",
            "HALT",
            "breaks off at 36",
            "END",
        ];
        assert_eq!(seen, expected);
        assert_eq!(execution.never_called().count(), 0);
    }
}
