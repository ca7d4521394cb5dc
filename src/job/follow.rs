//! How cuts follow a part that changes along y.

use crate::{Auto, Sourced};
use std::sync::Arc;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::columns::Columns;
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
    /// Each is straight and rises or falls at a slope of its own.
    Fan,
    /// Each rises and falls along a polyline of its own.
    Columns,
    /// As the best of these does, which planning finds out.
    Auto,
}

/// A way for all cuts of a job to follow its part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// [`Follow::Straight`].
    Straight,
    /// [`Follow::Pitched`].
    Pitched,
    /// [`Follow::Spine`].
    Spine,
    /// [`Follow::Fan`].
    Fan,
    /// [`Follow::Columns`].
    Columns,
}

crate::words! {
    Follow {
        Straight = "straight", Pitched = "pitched", Spine = "spine", Fan = "fan", Columns = "columns", Auto = "auto"
    }
    Family {
        Straight = "straight", Pitched = "pitched", Spine = "spine", Fan = "fan", Columns = "columns"
    }
}

impl Follow {
    /// The family that it names; none where the choice is left open.
    #[must_use]
    pub const fn family(self) -> Option<Family> {
        match self {
            Self::Straight => Some(Family::Straight),
            Self::Pitched => Some(Family::Pitched),
            Self::Spine => Some(Family::Spine),
            Self::Fan => Some(Family::Fan),
            Self::Columns => Some(Family::Columns),
            Self::Auto => None,
        }
    }
}

impl Sourced<Follow> {
    /// The family, as a value that may be left to the compiler.
    #[must_use]
    pub fn open(self) -> Sourced<Auto<Family>> {
        Sourced {
            value: self.value.family().map_or(Auto::Auto, Auto::Given),
            span: self.span,
        }
    }
}

/// What the cuts of a job follow.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// All of them the same polyline.
    Spine(Arc<Spine>),
    /// Each the way of its place.
    Columns(Arc<Columns>),
}

impl Guide {
    /// The spine, if it is one.
    #[must_use]
    pub fn spine(&self) -> Option<&Spine> {
        match self {
            Self::Spine(spine) => Some(spine),
            Self::Columns(_) => None,
        }
    }

    /// The columns, if it is those.
    #[must_use]
    pub fn columns(&self) -> Option<&Columns> {
        match self {
            Self::Spine(_) => None,
            Self::Columns(columns) => Some(columns),
        }
    }

    /// The largest slope, up or down.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        match self {
            Self::Spine(spine) => spine.steepest(),
            Self::Columns(columns) => columns.steepest(),
        }
    }

    /// The largest slope at the sides of the stock, up or down.
    #[must_use]
    pub fn steepest_at_sides(&self) -> f64 {
        match self {
            Self::Spine(spine) => spine.end_slopes().map(f64::abs).into_iter().fold(0.0, f64::max),
            Self::Columns(columns) => columns.steepest_at_sides(),
        }
    }

    /// How far cuts go down at most over so many mm beyond a side of the stock: from there on, and below their lowest place over the
    /// stock.
    #[must_use]
    pub fn down_beyond(&self, extension: f64) -> [f64; 2] {
        match self {
            Self::Spine(spine) => {
                let ends = [(0.0, -extension), (spine.depth(), spine.depth() + extension)];
                let fall = ends.map(|(side, end)| spine.rise(side) - spine.rise(end));
                let sink = ends.map(|(_, end)| -spine.rise(end));
                [fall, sink].map(|lengths| lengths.into_iter().fold(0.0, f64::max))
            }
            Self::Columns(columns) => columns.down_beyond(extension),
        }
    }
}

/// Where ways rise differently by more of the slope of flanks, on a few places at most, plans count on so much: more would rule all of them
/// out, and the proof measures what is needed. A judgement, from no source.
const MOST_SHEARED: f64 = 0.5;

/// What the cuts of an operation follow, and how its blade keeps to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// What they follow.
    pub guide: Guide,
    /// How far flanks lie off the Vs of their tips where the blade is where it is to be.
    deviation: Deviation,
    edge: Length,
    /// What of the edge shows itself across the cuts.
    across: Length,
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
    /// `others` is the longest edge of the other operations that follow it, if there are any.
    #[must_use]
    pub fn new(guide: &Guide, edge: Length, angle: Angle, blend: Length, others: Option<Length>) -> Self {
        let pitch = Angle::rad(libm::atan(guide.steepest()));
        let overhang = edge * (angle.cos().abs() + angle.sin() * pitch.sin());
        let deviation = match guide {
            Guide::Spine(spine) => spine.deviation(overhang.to_mm()),
            Guide::Columns(columns) => columns.deviation(overhang.to_mm()),
        };
        // Columns have their job to themselves.
        let spine = guide.spine();
        let left_above = |spine: &Spine| others.map_or(0.0, |longest| spine.left_above(longest, blend));
        Self {
            guide: guide.clone(),
            deviation,
            edge,
            across: edge * angle.sin(),
            blend,
            others: spine.map_or(0.0, left_above),
        }
    }

    /// How far flanks that rise by `slope` across the cuts may lie off the Vs of their tips.
    #[must_use]
    pub fn deviation(&self, slope: f64) -> Deviation {
        let off = match &self.guide {
            Guide::Spine(spine) => spine.off(self.edge, self.blend, slope),
            Guide::Columns(columns) => columns.off(self.edge, self.blend, slope),
        };
        Deviation {
            above: self.deviation.above + off,
            below: self.deviation.below + off,
        }
    }

    /// How much lower than their Vs say flanks have to come out: by what they may lie lower themselves, and others have left more.
    #[must_use]
    pub fn lower(&self, slope: f64) -> f64 {
        let Deviation { above, below } = self.deviation(slope);
        below + above.max(self.others) + self.reserve(slope)
    }

    /// How much of their reach flanks along columns may need because older tips beside them rise otherwise. Towards steeper ways a
    /// flank meets them as if it rose by less than its slope `c`, by up to the shear `l` of the columns: of a reach that all its edge makes,
    /// that takes the share `l / (c + l)` (derived here). The proof measures it.
    fn reserve(&self, slope: f64) -> f64 {
        let reach = self.across.to_mm() * slope / libm::hypot(1.0, slope);
        let shear = self
            .guide
            .columns()
            .map_or(0.0, Columns::shear)
            .min(slope * MOST_SHEARED);
        reach * shear / (slope + shear)
    }

    /// How much more of a distance counts along z than where cuts are level.
    #[must_use]
    pub fn steepness(&self) -> f64 {
        libm::hypot(1.0, self.guide.steepest())
    }
}
