//! Tests of the KRL backend from outside: what comes out is read back by a reader that knows nothing of the writer.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that meets the unexpected should stop"
)]

mod support;

mod chains;
mod changes;
mod dialect;
mod never;
mod oddities;
mod parts;
mod profile;
mod read_back;
mod refusals;
mod round_trip;
mod snapshots;
mod spindles;
