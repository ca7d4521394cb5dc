//! The deepest entry of cuts into the part, and the cut that it is of.

use super::entry::{below_top, deepest_entry};
use super::flank::flanks;
use super::{Cut, CutFault, Finding, OVERCUT, Player};
use crate::surface::Vee;
use vcutc_backend_api::ir::{OperationId, ToolId};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

impl Player<'_> {
    /// The deepest entry of any operation into its bound, and how deep that is.
    pub(super) fn overcut(&self) -> Option<(Finding, f64)> {
        let top = self.program.stock.height.to_mm();
        let guarded = (0..).map(OperationId).zip(self.bounds.iter().zip(&self.guards));
        let entries = guarded.map(|(operation, (bound, guard))| {
            let corners: Vec<Point2> = guard.corners().collect();
            (operation, deepest_entry(&corners, &below_top(bound.part, top)))
        });
        let (operation, (at, gap)) = entries.min_by(|(_, (_, a)), (_, (_, b))| a.total_cmp(b))?;
        if gap >= -OVERCUT {
            return None;
        }
        let depth = Length::mm(-gap);
        let finding = self.cut_through(operation, at, CutFault::Overcut { at, depth })?;
        Some((finding, -gap))
    }

    /// The cut of an operation whose V passes lowest through a point's x.
    fn cut_through(&self, operation: OperationId, at: Point2, fault: CutFault) -> Option<Finding> {
        let program = self.program;
        let tools = (0..).map(ToolId).take(self.program.blades.len());
        let flanks: Vec<_> = tools.map(|tool| flanks(self.program, tool)).collect();
        let mut lowest: Option<(f64, Cut)> = None;
        let cuts = Cut::all(self.program).map(|(_, cut)| self.under_load(cut));
        for cut in cuts.filter(|cut| cut.operation == operation) {
            let of_blade = flanks.get(usize::from(cut.tool.0));
            let Some(geometry) = of_blade.and_then(|flanks| flanks.get(cut.held.0 as usize)) else {
                continue;
            };
            let height = Vee::one(cut.tip, cut.side(), geometry.slope).height(at.x);
            if lowest.as_ref().is_none_or(|(known, _)| height < *known) {
                lowest = Some((height, cut));
            }
        }
        let along = self.along.lowest_through(operation, at.x);
        match (lowest, along) {
            (Some((height, cut)), Some((lower, along))) => {
                Some(if lower < height { along } else { &cut }.finding(program, fault))
            }
            (Some((_, cut)), None) => Some(cut.finding(program, fault)),
            (None, Some((_, cut))) => Some(cut.finding(program, fault)),
            (None, None) => None,
        }
    }
}
