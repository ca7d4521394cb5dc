//! `vcutc report`: all there is to see of a job as one page, and its pictures by themselves.

pub mod page;
pub mod pictures;
pub mod playback;
