//! What a replay found, of each kind the worst.

use super::{CutFault, Finding};
use core::mem::{Discriminant, discriminant};

/// All faults of one kind, of which the worst is kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// How many cuts have a chip that is not freed, and the worst of them.
    pub not_freed: Option<(usize, Finding)>,
    /// How many cuts are blocked, and the first of them.
    pub blocked: Option<(usize, Finding)>,
    /// The deepest overcut.
    pub overcut: Option<Finding>,
    /// How many cuts leave their spine, and the one that does so farthest.
    pub strays: Option<(usize, Finding)>,
    /// How many faults passes of a disc have, and the first of them.
    pub strips: Option<(usize, Finding)>,
    /// In how many sections too much stays beside tracks on a surface, and the most of that.
    pub stays: Option<(usize, Finding)>,
    /// What is wrong with passes over regions and slits along walls, of each operation and kind the first.
    pub of_regions: Vec<(usize, Finding)>,
}

impl Findings {
    pub fn iter(&self) -> impl Iterator<Item = (usize, Finding)> {
        let overcut = self.overcut.map(|finding| (1, finding));
        let cuts = self.not_freed.into_iter().chain(self.blocked).chain(overcut);
        let others = cuts.chain(self.strays).chain(self.strips).chain(self.stays);
        others.chain(self.of_regions.iter().copied())
    }

    /// Counts a fault of passes over a region, or of slits along its walls, and keeps the first of its kind.
    pub fn note_of_region(&mut self, finding: Finding) {
        let is_known = |known: &Finding| {
            known.operation == finding.operation && Kind::of(known.fault) == Kind::of(finding.fault)
        };
        match self.of_regions.iter_mut().find(|(_, known)| is_known(known)) {
            Some((count, _)) => *count += 1,
            None => self.of_regions.push((1, finding)),
        }
    }
}

/// What faults of regions are alike in.
#[derive(PartialEq, Eq)]
enum Kind {
    Clearing(Discriminant<super::ClearingFault>),
    Slit(Discriminant<super::SlitFault>),
    Other(Discriminant<CutFault>),
}

impl Kind {
    const fn of(fault: CutFault) -> Self {
        match fault {
            CutFault::Clearing(fault) => Self::Clearing(discriminant(&fault)),
            CutFault::Slit(fault) => Self::Slit(discriminant(&fault)),
            other => Self::Other(discriminant(&other)),
        }
    }
}

/// Counts a finding and keeps the worse one.
pub(super) fn note(
    kept: &mut Option<(usize, Finding)>,
    finding: Finding,
    worse: impl Fn(&Finding, &Finding) -> bool,
) {
    match kept {
        Some((count, known)) => {
            *count += 1;
            if worse(&finding, known) {
                *known = finding;
            }
        }
        None => *kept = Some((1, finding)),
    }
}

/// Whether clearly more stands above the flank of one cut than above that of another; the earlier one stands for equals.
pub(super) fn is_more_blocked(a: &Finding, b: &Finding) -> bool {
    let stands = |finding: &Finding| match finding.fault {
        CutFault::Blocked { by, .. } => by.to_mm(),
        _ => 0.0,
    };
    stands(a) > stands(b) + 1e-6
}

/// Whether one cut needs clearly more edge than another; the earlier one stands for equals.
pub(super) fn is_longer(a: &Finding, b: &Finding) -> bool {
    let needed = |finding: &Finding| match finding.fault {
        CutFault::NotFreed { needed, .. } => needed.to_mm(),
        CutFault::Blocked { .. }
        | CutFault::Overcut { .. }
        | CutFault::Strays { .. }
        | CutFault::Strip(_)
        | CutFault::Clearing(_)
        | CutFault::Slit(_)
        | CutFault::Stays { .. } => 0.0,
    };
    needed(a) > needed(b) + 1e-6
}
