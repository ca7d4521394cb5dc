//! How much of its edge or its rim each cut uses, and whether the blade has as much.

use super::findings::is_longer;
use super::{Cut, CutFault, Finding, Player, note};
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::units::Length;

/// How much of a blade is in the material at most while an op cuts: from the tip on of its edge, or of the height of its teeth, and
/// anywhere of the rim of a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UsedEdge {
    pub op: OpId,
    pub length: Length,
}

impl Player<'_> {
    /// Notes how much edge a flank uses.
    #[inline]
    pub(super) fn use_edge(&mut self, needed: f64, cut: &Cut) {
        let program = self.program;
        self.note_edge(needed, |fault| cut.finding(program, fault));
        self.measure_edge(needed);
    }

    /// Keeps how much edge the op uses that is played.
    pub(super) fn measure_edge(&mut self, used: f64) {
        self.longest_edge = self.longest_edge.max(used);
        self.keep_engaged(Length::mm(used));
    }

    /// Keeps how much of its blade the op has in the material that is played.
    pub(super) fn keep_engaged(&mut self, length: Length) {
        self.edges.push(UsedEdge {
            op: self.playing,
            length,
        });
    }

    /// Notes a cut that needs more edge than there is.
    #[inline]
    pub(super) fn note_edge(&mut self, needed: f64, finding: impl Fn(CutFault) -> Finding) {
        let Some(available) = self.usable_edge else {
            return;
        };
        // The plan leaves out nothing below a nanometre; neither does the proof.
        if needed > available + 1e-6 {
            let fault = CutFault::NotFreed {
                needed: Length::mm(needed),
                available: Length::mm(available),
            };
            note(&mut self.findings.not_freed, finding(fault), is_longer);
        }
    }

    /// The edge of the blade at work, or what of it may be used, in mm.
    pub(super) fn edge_at_hand(&self) -> Option<f64> {
        let (operation, tool) = self.at_work?;
        let blade = self.program.blade(tool)?.straight()?.cutting_length;
        let limit = self.bounds.get(usize::from(operation.0));
        let limit = limit.and_then(|bound| bound.edge);
        Some(limit.map_or(blade, |limit| limit.min(blade)).to_mm())
    }
}
