//! A program as its reader reports it: statements in the order in which they are carried out.

use std::collections::BTreeMap;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_backend_api::readback::{Effect, Place, ProgramFile, Reader, Sources, Statement, normalized};

/// The statements of a program.
pub(super) struct Listing<'f> {
    pub(super) files: &'f [ProgramFile],
    pub(super) statements: Vec<Statement>,
    /// How many more there are than are held.
    pub(super) beyond: usize,
}

impl<'f> Listing<'f> {
    /// Reads a program, and keeps so many of its statements at most.
    pub(super) fn read(reader: &dyn Reader, sources: Sources<'f>, most: usize) -> Self {
        let mut listing = Self {
            files: sources.files,
            statements: Vec::new(),
            beyond: 0,
        };
        reader.read(sources, &mut |statement| {
            if listing.statements.len() < most {
                listing.statements.push(statement);
            } else {
                listing.beyond += 1;
            }
        });
        listing
    }

    /// What a statement does; none where there is no statement of that number.
    pub(super) fn effect(&self, index: usize) -> Option<&Effect> {
        self.statements.get(index).map(|statement| &statement.effect)
    }

    /// The text of a statement; empty where a place does not fit the files.
    pub(super) fn text(&self, index: usize) -> &'f str {
        self.statements
            .get(index)
            .map_or("", |statement| text_at(self.files, statement.place))
    }

    /// The elements to compare: equal numbers for statements of the same normalized text. The table is shared by both programs.
    pub(super) fn normalized_texts(&self, known: &mut Numbering) -> Vec<u32> {
        self.named(known, normalized)
    }

    /// The same for statements that differ in their numbers only.
    pub(super) fn skeletons(&self, known: &mut Numbering) -> Vec<u32> {
        self.named(known, skeleton)
    }

    fn named(&self, known: &mut Numbering, name: impl Fn(&str) -> String) -> Vec<u32> {
        let places = 0..self.statements.len();
        places.map(|index| known.number(name(self.text(index)))).collect()
    }

    /// For every statement the op that it says, by where the ops of a fresh program stand.
    pub(super) fn owners(&self, places: &[Place], program: &Program) -> Vec<Option<OpId>> {
        let mut ops = (0..).map(OpId).zip(places).take(program.ops.len()).peekable();
        let owner = |statement: &Statement| {
            // A move that names another tool stands for two statements: the frame that it takes, and the move.
            if matches!(statement.effect, Effect::Frame(..)) {
                return None;
            }
            ops.next_if(|(_, place)| **place == statement.place)
                .map(|(op, _)| op)
        };
        self.statements.iter().map(owner).collect()
    }
}

/// A statement's normalized text without its numbers.
pub(super) fn skeleton(text: &str) -> String {
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    normalized(text).split(is_of_number).collect()
}

/// The text at a place.
pub(super) fn text_at(files: &[ProgramFile], place: Place) -> &str {
    files
        .get(place.file as usize)
        .and_then(|file| file.text.get(place.start as usize..place.end as usize))
        .unwrap_or_default()
}

/// Numbers for texts, in the order in which they first come.
#[derive(Default)]
pub(super) struct Numbering {
    numbers: BTreeMap<String, u32>,
}

impl Numbering {
    pub(super) fn number(&mut self, name: String) -> u32 {
        let next = u32::try_from(self.numbers.len()).unwrap_or(u32::MAX);
        *self.numbers.entry(name).or_insert(next)
    }
}
