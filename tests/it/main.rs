//! The integration tests of the compiler, one module a subject.
#![allow(
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "tests read files and fail loudly"
)]

mod check;
