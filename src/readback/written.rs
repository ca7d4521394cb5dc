//! A program as a backend wrote it, read back at once.

use super::listing::text_at;
use super::wording::{divergence_words, op_words};
use core::ops::Range;
use vcutc_backend_api::backend::{Backend, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Comparator, Place, ProgramFile, Replay, Sources, program_files};

/// A program as it was written.
#[derive(Clone, Debug)]
pub struct Written {
    /// The options of the backend that wrote it.
    pub options: Options,
    /// Its files, byte for byte.
    pub bundle: Bundle,
    pub files: Vec<ProgramFile>,
    /// Where each op stands in the text; none where the dialect cannot be read.
    pub places: Option<Vec<Place>>,
}

/// What a program that was read back differently says: the op in question, and what is wrong, a line each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RoundTripError(pub Vec<String>);

impl Written {
    /// Reads what a backend wrote and follows it op by op.
    ///
    /// # Errors
    /// Where it is not the program that it was made from.
    pub fn read_back(
        program: &ReachableProgram,
        backend: &dyn Backend,
        options: Options,
        bundle: Bundle,
    ) -> Result<Self, RoundTripError> {
        let files = program_files(&bundle);
        let places = places(program, backend, &options, &files)?;
        Ok(Self {
            options,
            bundle,
            files,
            places,
        })
    }
}

impl Written {
    /// What the program does at a place of one of its files, in the words of the job: `the left flank of layer 1, cut 2`.
    /// Where nothing is done at the place itself, it is what comes next in the file; none where that is not
    /// known.
    #[must_use]
    pub fn about(&self, program: &Program, file: usize, bytes: &Range<usize>) -> Option<String> {
        let (op, _) = (0..)
            .map(OpId)
            .zip(self.places.as_ref()?)
            .filter(|(_, place)| place.file as usize == file && place.end as usize > bytes.start)
            .min_by_key(|(_, place)| place.start)?;
        Some(op_words(program, op))
    }
}

fn places(
    program: &ReachableProgram,
    backend: &dyn Backend,
    options: &Options,
    files: &[ProgramFile],
) -> Result<Option<Vec<Place>>, RoundTripError> {
    let (Some(reader), Some(cell)) = (backend.reader(), &program.program().cell) else {
        return Ok(None);
    };
    let comparator = Comparator::new(program, reader, reader.resolution(options));
    let mut replay = Replay::new(comparator, reader.frames());
    let sources = Sources { files, cell, options };
    reader.read(sources, &mut |statement| replay.take(&statement));
    match replay.finish() {
        Ok(places) => Ok(Some(places)),
        Err(divergence) => {
            let op = divergence.op.map(|op| {
                let words = op_words(program.program(), op);
                format!("it should say op {}, {words}", op.0)
            });
            let line = divergence.place.map(|place| {
                let name = files.get(place.file as usize).map_or("", |file| &file.name);
                format!("{name} says `{}`", text_at(files, place))
            });
            let what = divergence_words(&divergence.what, Some(cell));
            Err(RoundTripError(op.into_iter().chain(line).chain(what).collect()))
        }
    }
}
