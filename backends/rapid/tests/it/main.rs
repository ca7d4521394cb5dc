//! Tests of the RAPID backend from outside.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that meets the unexpected should stop"
)]

mod support;

mod chains;
mod changes;
mod dialect;
mod edits;
mod never;
mod refusals;
mod round_trip;
mod snapshots;
mod spindles;
