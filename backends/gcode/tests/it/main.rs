//! Tests of the G-code backend from outside.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that meets the unexpected should stop"
)]

mod by_hand;
mod chains;
mod changes;
mod dialect;
mod head;
mod hostile;
mod lines;
mod mutations;
mod read_back;
mod refusals;
mod snapshots;
mod spindles;
mod support;
mod words;
