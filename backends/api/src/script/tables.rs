//! Entries of a program's tables by their numbers. A verified program has them all, so one that is missing is a fault of the
//! compiler.

use crate::backend::EmitError;
use crate::ir::{FeedId, OperationId, Program, RateId};
use crate::units::{AngularSpeed, Speed};

/// The comment above the first line of an operation, `operation 1: rough vcut with blade ` and the names of its blades, which are
/// the user's text.
///
/// # Errors
/// That the program has no such operation.
pub fn operation_heading(program: &Program, id: OperationId) -> Result<(String, String), EmitError> {
    let operation = program
        .operation(id)
        .ok_or(EmitError::Internal("an operation is not in its table"))?;
    let what = operation.kind.head();
    let names: Vec<&str> = program.blades_of(id).map(|blade| blade.name.as_str()).collect();
    let with = match names.as_slice() {
        [] => return Err(EmitError::Internal("a blade is not in its table")),
        [_] => "blade",
        [_, _, ..] => "blades",
    };
    let ours = format!("operation {}: {what} with {with} ", u32::from(id.0) + 1);
    Ok((ours, names.join(", ")))
}

/// A speed of the tip.
///
/// # Errors
/// That the program has no such feed.
pub fn feed(program: &Program, id: FeedId) -> Result<Speed, EmitError> {
    program
        .feed(id)
        .ok_or(EmitError::Internal("a feed is not in its table"))
}

/// A rate of turning.
///
/// # Errors
/// That the program has no such rate.
pub fn rate(program: &Program, id: RateId) -> Result<AngularSpeed, EmitError> {
    program
        .rate(id)
        .ok_or(EmitError::Internal("a rate is not in its table"))
}
