//! What a replay found, of each kind the worst.

use super::{CutFault, Finding};

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
}

impl Findings {
    pub fn iter(&self) -> impl Iterator<Item = (usize, Finding)> {
        let overcut = self.overcut.map(|finding| (1, finding));
        let cuts = self.not_freed.into_iter().chain(self.blocked).chain(overcut);
        cuts.chain(self.strays).chain(self.strips).chain(self.stays)
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

/// Whether one cut needs clearly more edge than another; the earlier one stands for equals.
pub(super) fn is_longer(a: &Finding, b: &Finding) -> bool {
    let needed = |finding: &Finding| match finding.fault {
        CutFault::NotFreed { needed, .. } => needed.to_mm(),
        CutFault::Blocked { .. }
        | CutFault::Overcut { .. }
        | CutFault::Strays { .. }
        | CutFault::Strip(_)
        | CutFault::Stays { .. } => 0.0,
    };
    needed(a) > needed(b) + 1e-6
}
