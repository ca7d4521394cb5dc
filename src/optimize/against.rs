//! What time is traded against: a measure of plans, and the limits of the job on it.

use super::trials::Plan;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_job::Sourced;
use vcutc_vcut::asked::{Objective, RoughVcut};
use vcutc_vcut::plan::optimum::Problem;

/// A measure of plans that more time makes smaller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Against {
    /// The most material that is left on the part, in mm.
    #[default]
    Scallop,
    /// The number of V cuts.
    Cuts,
    /// The longest edge in use, in mm.
    Edge,
}

/// The lowest limit, as a share of the job's own; the highest one is the inverse of it above.
const LEAST_SHARE: f64 = 0.25;

/// Limits nearer to each other are printed alike: half of the last digit of a limit in mm.
const ALIKE: f64 = 0.005;

impl Against {
    /// As it is written in `limits`, on the command line, and in file names.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Scallop => "scallop",
            Self::Cuts => "cuts",
            Self::Edge => "edge",
        }
    }

    /// What a picture calls it, with its unit.
    #[must_use]
    pub const fn label(self) -> &'static str {
        match self {
            Self::Scallop => "most that is left, mm",
            Self::Cuts => "cuts",
            Self::Edge => "longest edge in use, mm",
        }
    }

    /// A limit or what a plan comes to, with its unit.
    #[must_use]
    pub fn shown(self, value: f64) -> String {
        match self {
            Self::Scallop | Self::Edge => format!("{value:.2} mm"),
            Self::Cuts => show(value),
        }
    }

    /// What a plan comes to.
    pub(super) const fn of(self, plan: &Plan) -> f64 {
        plan.value(match self {
            Self::Scallop => Objective::Scallop,
            Self::Cuts => Objective::Cuts,
            Self::Edge => Objective::BladeLoad,
        })
    }

    /// The job's own limit.
    pub(super) fn limit(self, asked: &RoughVcut) -> Option<f64> {
        let limits = &asked.limits;
        match self {
            Self::Scallop => limits.scallop.map(|limit| limit.value.to_mm()),
            Self::Cuts => limits.cuts.map(|limit| limit.value),
            Self::Edge => limits.edge.map(|limit| limit.value.to_mm()),
        }
    }

    /// Puts an operation under a limit.
    pub(super) const fn put(self, asked: &mut RoughVcut, limit: f64) {
        let limits = &mut asked.limits;
        match self {
            Self::Scallop => limits.scallop = Some(chosen(Length::mm(limit))),
            Self::Cuts => limits.cuts = Some(chosen(limit)),
            Self::Edge => limits.edge = Some(chosen(Length::mm(limit))),
        }
    }

    /// Puts the problem of the formulas under a limit.
    pub(super) const fn put_in(self, problem: &mut Problem, limit: f64) {
        match self {
            Self::Scallop => problem.scallop = Some(Length::mm(limit)),
            Self::Cuts => problem.cuts = Some(limit),
            Self::Edge => problem.edge = Some(Length::mm(limit)),
        }
    }

    /// So many limits about one, each by the same factor above the one before, without that one itself. A limit on the edge is at
    /// most what the blade has.
    pub(super) fn limits_about(self, own: f64, points: u32, asked: &RoughVcut) -> Vec<f64> {
        let most = match self {
            Self::Scallop | Self::Cuts => f64::INFINITY,
            Self::Edge => asked.blade.cutting_length.value.to_mm(),
        };
        let mut limits: Vec<f64> = about(own, points)
            .map(|limit| self.rounded(limit).min(most))
            .collect();
        limits.dedup();
        limits.retain(|&limit| limit > 0.0 && !self.is_alike(limit, own));
        limits
    }

    /// As limits are written: to a hundredth of a millimetre, and whole cuts.
    fn rounded(self, limit: f64) -> f64 {
        match self {
            Self::Scallop | Self::Edge => hundredths(limit),
            Self::Cuts => limit.ceil(),
        }
    }

    fn is_alike(self, one: f64, other: f64) -> bool {
        match self {
            Self::Scallop | Self::Edge => (one - other).abs() < ALIKE,
            Self::Cuts => (one - other).abs() < 1.0,
        }
    }
}

const fn chosen<T>(value: T) -> Sourced<T> {
    Sourced { value, span: None }
}

/// A length in mm, up to a hundredth.
pub(super) fn hundredths(mm: f64) -> f64 {
    // What is a hundredth but for rounding stays one.
    (mm * 100.0 - 1e-6).ceil() / 100.0
}

/// So many values about one, each by the same factor above the one before.
pub(super) fn about(own: f64, points: u32) -> impl Iterator<Item = f64> {
    let middle = f64::from(points.max(2) - 1) / 2.0;
    (0..points).map(move |point| own * libm::pow(LEAST_SHARE, 1.0 - f64::from(point) / middle))
}
