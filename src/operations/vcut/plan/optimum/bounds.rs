//! The bounds of a problem one by one: their values, other values for them, and what parameters come to in them.

use super::problem::{Bound, End, Optimum, Problem};
use vcutc_backend_api::units::{Angle, Duration, Length};

/// How near to a bound parameters touch it, as a share of it.
const TOUCHES: f64 = 1e-7;

/// An overlap that is relaxed by a hundredth moves by as much: in shares of nothing it would not move.
const SHARE: f64 = 0.01;

impl Bound {
    /// All of them, in order.
    pub const ALL: [Self; 12] = [
        Self::SwingLeast,
        Self::SwingMost,
        Self::LayerLeast,
        Self::LayerMost,
        Self::StepLeast,
        Self::StepMost,
        Self::OverlapLeast,
        Self::OverlapMost,
        Self::Scallop,
        Self::Edge,
        Self::Time,
        Self::Cuts,
    ];

    /// Which end of what it bounds it is.
    #[must_use]
    pub const fn end(self) -> End {
        match self {
            Self::SwingLeast | Self::LayerLeast | Self::StepLeast | Self::OverlapLeast => End::Least,
            Self::SwingMost
            | Self::LayerMost
            | Self::StepMost
            | Self::OverlapMost
            | Self::Scallop
            | Self::Edge
            | Self::Time
            | Self::Cuts => End::Most,
        }
    }

    /// Its value in a problem, in mm, rad, s or 1, if there is such a bound.
    #[must_use]
    pub fn value(self, problem: &Problem) -> Option<f64> {
        match self {
            Self::SwingLeast => Some(problem.swing.least.to_rad()),
            Self::SwingMost => Some(problem.swing.most.to_rad()),
            Self::LayerLeast => Some(problem.layer.least.to_mm()),
            Self::LayerMost => Some(problem.layer.most.to_mm()),
            Self::StepLeast => Some(problem.step.least.to_mm()),
            Self::StepMost => Some(problem.step.most.to_mm()),
            Self::OverlapLeast => Some(problem.overlap.least),
            Self::OverlapMost => Some(problem.overlap.most),
            Self::Scallop => problem.scallop.map(Length::to_mm),
            Self::Edge => Some(problem.longest_edge().to_mm()),
            Self::Time => problem.time.map(Duration::to_s),
            Self::Cuts => problem.cuts,
        }
    }

    /// What parameters come to in what is bounded, in the same unit.
    #[must_use]
    pub const fn attained(self, optimum: &Optimum) -> f64 {
        match self {
            Self::SwingLeast | Self::SwingMost => optimum.swing.to_rad(),
            Self::LayerLeast | Self::LayerMost => optimum.layer.to_mm(),
            Self::StepLeast | Self::StepMost => optimum.step.to_mm(),
            Self::OverlapLeast | Self::OverlapMost => optimum.overlap,
            Self::Scallop => optimum.scallop.to_mm(),
            Self::Edge => optimum.edge.to_mm(),
            Self::Time => optimum.time.to_s(),
            Self::Cuts => optimum.cuts,
        }
    }

    /// The problem with another value for it. An edge longer than the blade's takes a longer blade.
    #[must_use]
    pub fn replaced(self, problem: &Problem, value: f64) -> Problem {
        let mut other = problem.clone();
        match self {
            Self::SwingLeast => other.swing.least = Angle::rad(value),
            Self::SwingMost => other.swing.most = Angle::rad(value),
            Self::LayerLeast => other.layer.least = Length::mm(value),
            Self::LayerMost => other.layer.most = Length::mm(value),
            Self::StepLeast => other.step.least = Length::mm(value),
            Self::StepMost => other.step.most = Length::mm(value),
            Self::OverlapLeast => other.overlap.least = value,
            Self::OverlapMost => other.overlap.most = value,
            Self::Scallop => other.scallop = Some(Length::mm(value)),
            Self::Edge => {
                other.edge = Some(Length::mm(value));
                other.work.cutting_length = other.work.cutting_length.max(Length::mm(value));
            }
            Self::Time => other.time = Some(Duration::s(value)),
            Self::Cuts => other.cuts = Some(value),
        }
        other
    }

    /// The problem without it, as far as that makes sense: swings within a degree of flat and upright, overlaps from a gap
    /// as wide as the step.
    pub(in crate::plan) fn dropped(self, problem: &Problem) -> Problem {
        let mut other = problem.clone();
        match self {
            Self::SwingLeast => other.swing.least = other.swing.least.min(Angle::deg(1.0)),
            Self::SwingMost => other.swing.most = other.swing.most.max(Angle::deg(89.0)),
            Self::LayerLeast => other.layer.least = Length::ZERO,
            Self::LayerMost => other.layer.most = Length::m(1000.0),
            Self::StepLeast => other.step.least = Length::ZERO,
            Self::StepMost => other.step.most = Length::m(1000.0),
            Self::OverlapLeast => other.overlap.least = other.overlap.least.min(-1.0),
            Self::OverlapMost => other.overlap.most = other.overlap.most.max(0.999),
            Self::Scallop => other.scallop = None,
            Self::Edge => {
                let long = other.work.cutting_length.max(Length::m(1.0));
                return self.replaced(&other, long.to_mm());
            }
            Self::Time => other.time = None,
            Self::Cuts => other.cuts = None,
        }
        other
    }

    /// Its value relaxed by a hundredth of it, or for an overlap by a hundredth.
    pub(super) fn relaxed(self, value: f64) -> f64 {
        match self {
            Self::SwingLeast | Self::LayerLeast | Self::StepLeast => value * (1.0 - SHARE),
            Self::SwingMost
            | Self::LayerMost
            | Self::StepMost
            | Self::Scallop
            | Self::Edge
            | Self::Time
            | Self::Cuts => value * (1.0 + SHARE),
            Self::OverlapLeast => value - SHARE,
            Self::OverlapMost => (value + SHARE).min(0.999),
        }
    }

    /// Whether parameters touch it.
    pub(super) fn touched(self, problem: &Problem, optimum: &Optimum) -> bool {
        let Some(value) = self.value(problem) else {
            return false;
        };
        let off = (self.attained(optimum) - value).abs();
        match self {
            // Of the overlap the share of the widest step counts.
            Self::OverlapLeast | Self::OverlapMost => off <= TOUCHES * (1.0 - value),
            Self::SwingLeast
            | Self::SwingMost
            | Self::LayerLeast
            | Self::LayerMost
            | Self::StepLeast
            | Self::StepMost
            | Self::Scallop
            | Self::Edge
            | Self::Time
            | Self::Cuts => off <= TOUCHES * value.abs(),
        }
    }
}

impl Problem {
    /// The longest edge that may be in use: what is allowed of the blade.
    #[must_use]
    pub fn longest_edge(&self) -> Length {
        let whole = self.work.cutting_length;
        self.edge.map_or(whole, |edge| edge.min(whole))
    }
}
