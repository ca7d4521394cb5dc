//! What stands before the line of an op: folds, comments, and speeds that change.
//!
//! The same answer serves the writer, which writes it, and the splitter, which counts it.

use crate::ir::{Action, FeedId, Op, OperationId, Program, RateId, Site, ToolId};
use core::num::NonZeroU32;

/// A layer of the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The operation it belongs to.
    pub operation: OperationId,
    /// Its number within the operation.
    pub number: NonZeroU32,
}

/// What a reader at a line of the program knows: headings seen and speeds set so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Modal {
    operation: Option<OperationId>,
    layer: Option<Layer>,
    cut: Option<NonZeroU32>,
    feed: Option<FeedId>,
    rate: Option<RateId>,
}

/// What an op needs before its line, in the order of writing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lead {
    /// The fold of this layer ends.
    pub close: Option<Layer>,
    /// This operation begins.
    pub operation: Option<OperationId>,
    /// The fold of this layer begins.
    pub open: Option<Layer>,
    /// This cut of the layer begins.
    pub cut: Option<(Layer, NonZeroU32)>,
    /// The tip speed changes to this.
    pub feed: Option<FeedId>,
    /// The reorientation rate changes to this.
    pub rate: Option<RateId>,
}

impl Modal {
    /// What the op needs, given what was written before; then it is written.
    pub fn lead(&mut self, op: &Op) -> Lead {
        let (layer, cut) = place(op.site);
        let (feed, rate) = (op.action.feed(), op.action.rate());
        let mut lead = Lead::default();
        if layer != self.layer {
            lead.close = self.layer;
            lead.open = layer;
            self.layer = layer;
            self.cut = None;
        }
        if let Some(operation) = op.site.operation() {
            lead.operation = changed(&mut self.operation, operation);
        }
        if let (Some(layer), Some(cut)) = (layer, cut) {
            lead.cut = changed(&mut self.cut, cut).map(|cut| (layer, cut));
        }
        // What changes blades may leave other speeds.
        if matches!(op.action, Action::ToolChange { .. }) {
            (self.feed, self.rate) = (None, None);
        }
        lead.feed = feed.and_then(|feed| changed(&mut self.feed, feed));
        lead.rate = rate.and_then(|rate| changed(&mut self.rate, rate));
        lead
    }

    /// The speeds that these ops run at first, as far as they have not been written; then they are written.
    pub fn first_speeds(&mut self, ops: &[Op]) -> (Option<FeedId>, Option<RateId>) {
        let feed = ops.iter().find_map(|op| op.action.feed());
        let rate = ops.iter().find_map(|op| op.action.rate());
        (
            feed.and_then(|feed| changed(&mut self.feed, feed)),
            rate.and_then(|rate| changed(&mut self.rate, rate)),
        )
    }

    /// The fold that is still open.
    #[must_use]
    pub const fn open_layer(self) -> Option<Layer> {
        self.layer
    }
}

impl Lead {
    /// How many lines it takes, a line for each but a layer and a rate. The end of a fold is counted where the fold begins, so that a part's count is right
    /// wherever it stops.
    #[must_use]
    pub const fn lines(self, lines_of_a_rate: u64) -> u64 {
        let fold = if self.open.is_some() { 2 } else { 0 };
        let rate = if self.rate.is_some() { lines_of_a_rate } else { 0 };
        fold + rate + self.operation.is_some() as u64 + self.cut.is_some() as u64 + self.feed.is_some() as u64
    }
}

/// Sets a value, and returns it if it is a new one.
fn changed<T: Copy + PartialEq>(known: &mut Option<T>, now: T) -> Option<T> {
    (known.replace(now) != Some(now)).then_some(now)
}

/// The layer and the cut an op belongs to.
const fn place(site: Site) -> (Option<Layer>, Option<NonZeroU32>) {
    match site {
        Site::Program | Site::Operation(_) => (None, None),
        Site::Layer { operation, layer } => {
            let number = layer;
            (Some(Layer { operation, number }), None)
        }
        Site::Cut {
            operation,
            layer,
            cut,
        } => {
            let number = layer;
            (Some(Layer { operation, number }), Some(cut))
        }
    }
}

/// Where a part begins, in words, with this blade at hand.
#[must_use]
pub fn first_of(program: &Program, op: &Op, tool: ToolId) -> String {
    match op.site {
        Site::Program => "from the start".to_owned(),
        Site::Operation(operation) => format!("from operation {}", u32::from(operation.0) + 1),
        Site::Layer { operation, layer } => {
            format!("from operation {} layer {layer}", u32::from(operation.0) + 1)
        }
        Site::Cut {
            operation,
            layer,
            cut,
        } => format!(
            "from operation {} layer {layer} {} {cut}",
            u32::from(operation.0) + 1,
            program.cut_kind(operation, tool).noun()
        ),
    }
}
