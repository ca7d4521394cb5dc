//! What happens when: the ops of a program as columns, an entry an op.
//!
//! Tips lie on the grid of a micrometre (`src/geometry/grid.rs`), so they are kept as whole micrometres: a
//! reader that divides by 1000 has the program's own numbers again, to the last bit, and can replay the cuts
//! as the proof did.

use vcutc_backend_api::ir::{OpId, Program, Site};
use vcutc_backend_api::state::TipPose;
use vcutc_backend_api::units::Duration;

/// The columns. What counts from 1 has 0 where there is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timeline {
    /// Place of the op's kind in [`ActionKind::NAMES`](vcutc_backend_api::ir::ActionKind::NAMES).
    pub kinds: Vec<u8>,
    /// The operation that it serves, counted from 1.
    pub operations: Vec<u16>,
    /// The layer, counted from 1 in its operation.
    pub layers: Vec<u32>,
    /// The cut, counted from 1 in its layer.
    pub cuts: Vec<u32>,
    /// Where the tip is when the op ends, in W, in micrometres: three entries an op. Where no pose is known, the last.
    pub tips: Vec<i32>,
    /// How the blade is held when the op ends, as a number of the program's orientations counted from 1.
    pub held: Vec<u32>,
    /// The ops whose tip follows an arc.
    pub arcs: Vec<u32>,
    /// A place on the way of each of these, in W, in micrometres: three entries an arc.
    pub vias: Vec<i32>,
    /// How long it takes, in s.
    pub seconds: Vec<f64>,
}

impl Timeline {
    /// Of a program and the times of its ops.
    #[must_use]
    pub fn of(program: &Program, times: &[Duration]) -> Self {
        let mut timeline = Self::default();
        let mut tip = [0; 3];
        let times = times
            .iter()
            .map(|time| time.to_s())
            .chain(core::iter::repeat(0.0));
        for (segment, seconds) in program.segments().zip(times) {
            let pose = segment.end();
            if let Some(TipPose { tip: at, .. }) = pose {
                tip = [at.x, at.y, at.z].map(micrometres);
            }
            if let Some(via) = segment.op.action.via().and_then(|via| program.via(via)) {
                timeline.arcs.push(segment.id.0);
                timeline.vias.extend([via.x, via.y, via.z].map(micrometres));
            }
            timeline.kinds.push(segment.op.action.kind() as u8);
            timeline.site(segment.op.site);
            timeline.tips.extend(tip);
            timeline
                .held
                .push(pose.map_or(0, |pose| pose.orientation.0.saturating_add(1)));
            timeline.seconds.push(seconds);
        }
        timeline
    }

    fn site(&mut self, site: Site) {
        let operation = site.operation().map_or(0, |id| id.0.saturating_add(1));
        let (layer, cut) = match site {
            Site::Program | Site::Operation(_) => (0, 0),
            Site::Layer { layer, .. } => (layer.get(), 0),
            Site::Cut { layer, cut, .. } => (layer.get(), cut.get()),
        };
        self.operations.push(operation);
        self.layers.push(layer);
        self.cuts.push(cut);
    }

    /// How many ops there are.
    #[must_use]
    pub fn ops(&self) -> usize {
        self.kinds.len()
    }
}

/// The place of an op among others, which never exceeds what an [`OpId`] counts.
pub(super) const fn place(op: OpId) -> usize {
    op.0 as usize
}

/// The nearest whole number of micrometres, held within what 32 bits count: two kilometres.
fn micrometres(mm: f64) -> i32 {
    // The bounds make the conversion exact.
    (mm * 1000.0)
        .round()
        .clamp(f64::from(i32::MIN), f64::from(i32::MAX)) as i32
}
