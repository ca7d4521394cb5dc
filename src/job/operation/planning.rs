//! A checked job as planning takes it.

use crate::{CheckedJob, Part};
use core::ops::Deref;
use std::sync::Arc;
use vcutc_backend_api::units::Area;
use vcutc_geometry::profile::Profile;

/// A checked job with its part tessellated within [`Part::TOLERANCE`].
#[derive(Clone, Debug)]
pub struct PlanningJob<'j> {
    job: &'j CheckedJob,
    /// The part's polyline, spanning the stock from side to side and lying within it.
    pub profile: Arc<Profile>,
}

impl<'j> PlanningJob<'j> {
    /// Tessellates a job's part. Of a job that was checked there is always a polyline.
    #[must_use]
    pub fn of(job: &'j CheckedJob) -> Option<Self> {
        let profile = Arc::new(job.part.tessellated(Part::TOLERANCE)?);
        Some(Self { job, profile })
    }

    /// The job itself.
    #[must_use]
    pub const fn job(&self) -> &'j CheckedJob {
        self.job
    }

    /// Area of the cross-section above the part (A_C).
    #[must_use]
    pub fn area_to_remove(&self) -> Area {
        let width = self.stock.width.to_mm();
        Area::mm2(width * self.stock.height.to_mm()) - self.profile.area_below(0.0, width)
    }
}

impl Deref for PlanningJob<'_> {
    type Target = CheckedJob;

    fn deref(&self) -> &CheckedJob {
        self.job
    }
}
