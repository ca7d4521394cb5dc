//! `vcutc report`: all there is to see of a job as one page, its set-up sheet, and its pictures by themselves.

#[macro_use]
mod html;
mod base64;
mod digest;
mod facts;
mod packing;
pub mod page;
pub mod pictures;
pub mod playback;
pub mod sheet;
pub mod space;

use vcutc_driver::ways::Comparison;
use vcutc_driver::{Compiled, Outcome};
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;

/// What a report is made from: a job that compiled, with its whole result.
#[derive(Clone, Copy, Debug)]
pub struct Material<'a> {
    pub job: &'a CheckedJob,
    pub plan: &'a PlannedJob,
    /// Its program and figures.
    pub compiled: &'a Compiled,
    /// How other ways to do its operations compare.
    pub comparisons: &'a [Comparison],
}

impl<'a> Material<'a> {
    /// The material of an outcome; none when errors kept the job from compiling.
    #[must_use]
    pub fn of(outcome: &'a Outcome) -> Option<Self> {
        Some(Self {
            job: outcome.job.as_ref()?,
            plan: outcome.plan.as_ref()?,
            compiled: outcome.compiled.as_ref()?,
            comparisons: &outcome.comparisons,
        })
    }
}
