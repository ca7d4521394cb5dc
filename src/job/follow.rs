//! How cuts follow a part that changes along y.

use std::sync::Arc;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::spine::{Deviation, Spine};

/// How cuts follow the part along y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follow {
    /// They are level.
    Straight,
    /// They rise or fall at one slope, the same for all of them.
    Pitched,
    /// They rise and fall along a polyline, the same for all of them.
    Spine,
    /// The first of these that leaves hardly more than the best.
    Auto,
}

crate::words! {
    Follow { Straight = "straight", Pitched = "pitched", Spine = "spine", Auto = "auto" }
}

/// The spine of the cuts of an operation, and how its blade keeps to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// The spine.
    pub spine: Arc<Spine>,
    /// How far flanks lie off the Vs of their tips where the blade is where it is to be.
    deviation: Deviation,
    edge: Length,
    /// How far the tip may leave its way.
    blend: Length,
    /// How much higher than their Vs say other blades may have left the work, in mm.
    others: f64,
}

impl Along {
    /// Of a blade with an edge of that length, at an angle to its way (rake less half apex), that may leave the way by `blend`.
    ///
    /// Seen along the work, such an edge reaches `L cos(angle)` ahead of its tip where the way is level, and up to
    /// `L sin(angle) sin(mu)` more where it rises by `mu`. The other edge of the blade lies nearer.
    ///
    /// `others` is the longest edge of the other operations that follow the spine, if there are any.
    #[must_use]
    pub fn new(
        spine: &Arc<Spine>,
        edge: Length,
        angle: Angle,
        blend: Length,
        others: Option<Length>,
    ) -> Self {
        let pitch = Angle::rad(libm::atan(spine.steepest()));
        let overhang = edge * (angle.cos().abs() + angle.sin() * pitch.sin());
        Self {
            spine: Arc::clone(spine),
            deviation: spine.deviation(overhang.to_mm()),
            edge,
            blend,
            others: others.map_or(0.0, |longest| spine.left_above(longest, blend)),
        }
    }

    /// How far flanks that rise by `slope` across the cuts may lie off the Vs of their tips.
    #[must_use]
    pub fn deviation(&self, slope: f64) -> Deviation {
        let off = self.spine.off(self.edge, self.blend, slope);
        Deviation {
            above: self.deviation.above + off,
            below: self.deviation.below + off,
        }
    }

    /// How much lower than their Vs say flanks have to come out: by what they may lie lower themselves, and others have left more.
    #[must_use]
    pub fn lower(&self, slope: f64) -> f64 {
        let Deviation { above, below } = self.deviation(slope);
        below + above.max(self.others)
    }

    /// How much more of a distance counts along z than where cuts are level.
    #[must_use]
    pub fn steepness(&self) -> f64 {
        libm::hypot(1.0, self.spine.steepest())
    }
}
