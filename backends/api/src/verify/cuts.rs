//! Rules of cuts: straight through the stock along y, with one flank of a straight blade.

use super::{Capability, Rule, SAME, Walk};
use crate::geometry::{Orientation, Point3};
use crate::ir::{Edges, Flank, OpId, Site, Straight};
use crate::segments::Segment;
use core::num::NonZeroU32;

/// A cut of one flank.
#[derive(Clone, Copy)]
pub(super) struct Pass {
    layer: NonZeroU32,
    cut: NonZeroU32,
    flank: Flank,
    op: OpId,
}

impl Walk<'_> {
    /// A cut.
    pub(super) fn cut(&mut self, segment: &Segment<'_>, flank: Flank, to: Point3) {
        self.needs = self.needs.with(Capability::LinearMove);
        self.require(to.is_finite(), Rule::Number);
        let Some(from) = segment.start() else {
            self.fault(Rule::KnownStart);
            return;
        };
        self.require(self.crosses_stock(from.tip, to), Rule::CutAcrossStock);
        self.is_driven(segment.before);
        let Site::Cut { layer, cut, .. } = segment.op.site else {
            self.fault(Rule::CutFlanks);
            return;
        };
        let program = self.program;
        if let (Some(blade), Some(held)) = (
            program.blade(segment.before.tool),
            program.orientation(from.orientation),
        ) {
            let good = (blade.straight())
                .is_some_and(|straight| posture_fits(straight, held, flank, to.y - from.tip.y));
            self.require(good, Rule::CutPosture);
        }
        self.passes.push(Pass {
            layer,
            cut,
            flank,
            op: self.current,
        });
    }

    /// Each cut has no flank twice, each layer its cuts from 1 on.
    pub(super) fn finish_operation(&mut self) {
        let mut passes = core::mem::take(&mut self.passes);
        passes.sort_by_key(|pass| (pass.layer, pass.cut, pass.flank as u8));
        let mut before: Option<(NonZeroU32, u32)> = None;
        for cut in passes.chunk_by(|a, b| (a.layer, a.cut) == (b.layer, b.cut)) {
            let [first, ..] = cut else { continue };
            let follows = match before {
                Some((layer, number)) if layer == first.layer => first.cut.get() == number.saturating_add(1),
                Some(_) | None => first.cut.get() == 1,
            };
            if !follows {
                self.fault_at(first.op, Rule::Order);
            }
            match cut {
                [single] => self.singles.push(single.op),
                [left, right] if left.flank != right.flank => {}
                [.., last] => self.fault_at(last.op, Rule::CutFlanks),
                [] => {}
            }
            before = Some((first.layer, first.cut.get()));
        }
    }

    fn crosses_stock(&self, from: Point3, to: Point3) -> bool {
        let depth = self.program.stock.depth.to_mm();
        let straight = (to.x - from.x).abs() < SAME && (to.z - from.z).abs() < SAME;
        let (low, high) = (from.y.min(to.y), from.y.max(to.y));
        straight && low <= SAME && high >= depth - SAME
    }
}

/// Swings this small, in rad, are 0.
pub const UPRIGHT: f64 = 1e-9;

/// Whether a cut along `dy` holds the blade as its flank wants, with an edge in front.
fn posture_fits(blade: Straight, held: Orientation, flank: Flank, dy: f64) -> bool {
    let m = held.matrix();
    // Tip to shank is -z_t.
    let (lean_x, lean_y, lean_z) = (-m[0][2], -m[1][2], -m[2][2]);
    // A flank of swing 0, a wall, leans to neither side but for rounding.
    let to_its_side = match flank {
        Flank::Left => lean_x <= UPRIGHT,
        Flank::Right => lean_x >= -UPRIGHT,
    };
    let edge_leads = match blade.edges {
        Edges::Double => true,
        Edges::Single => m[1][0] * dy > 0.0,
    };
    // The blade plane holds the feed direction: its normal y_t is square to y.
    let in_plane = m[1][1].abs() < 1e-9;
    to_its_side && lean_y * dy >= -SAME && lean_z > 0.0 && edge_leads && in_plane
}
