//! Studies of a job: its trade-offs, and where the work should be

pub mod placement;
