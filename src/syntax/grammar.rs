//! The parser that is made of `grammar/vcut.pest`, and the bounds it works within.

use pest::Parser;
use pest::error::{Error, ErrorVariant, InputLocation};
use pest::iterators::Pairs;
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};

pub(super) use generated::Rule;

/// The code that the derive writes.
#[allow(unreachable_pub)]
mod generated {
    /// The parser of `grammar/vcut.pest`.
    #[derive(pest_derive::Parser)]
    #[grammar = "../../grammar/vcut.pest"]
    pub struct Grammar;
}

/// Why a text does not follow a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Mismatch {
    /// It is right up to a place, where one of these should follow.
    At {
        /// The place, in bytes.
        position: usize,
        /// What could follow.
        expected: Vec<Rule>,
    },
    /// The parser gave up.
    TooMuchWork,
}

/// Reads `text` by a rule.
pub(super) fn read(rule: Rule, text: &str) -> Result<Pairs<'_, Rule>, Mismatch> {
    allow_work_for(text.len());
    generated::Grammar::parse(rule, text).map_err(mismatch)
}

fn mismatch(error: Error<Rule>) -> Mismatch {
    let position = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    };
    match error.variant {
        ErrorVariant::ParsingError { positives, .. } => Mismatch::At {
            position,
            expected: positives,
        },
        ErrorVariant::CustomError { .. } => Mismatch::TooMuchWork,
    }
}

/// Calls of the parser's functions that are allowed for each byte of text. Right jobs take about ten, jobs full of mistakes
/// about fifty.
const CALLS_PER_BYTE: usize = 200;

/// The least number of calls that is allowed.
const FEWEST_CALLS: usize = 100_000;

/// Bounds the parser's work by the length of what it reads: a guard against a grammar that goes back and forth.
///
/// The bound belongs to the process, so parsers in other threads get it too. It only ever grows, so none of them gets
/// less than it needs.
fn allow_work_for(bytes: usize) {
    static ALLOWED: Mutex<usize> = Mutex::new(0);
    let needed = bytes.saturating_mul(CALLS_PER_BYTE).max(FEWEST_CALLS);
    let mut allowed = ALLOWED.lock().unwrap_or_else(PoisonError::into_inner);
    if needed > *allowed {
        *allowed = needed;
        pest::set_call_limit(NonZeroUsize::new(needed));
    }
}
