//! When the ops of a program are done.
//!
//! Within an op the machine is taken to go on evenly in time.

use super::time::name;
use crate::Material;
use vcutc_backend_api::ir::{OpId, Site};
use vcutc_motion::trajectory::Spacing;
use vcutc_picture::over_time::{COLUMNS, Course, Span};
use vcutc_simulation::timing::Kind;

/// From so many ops a column of a picture, samples within an op need not be close.
const NARROW: usize = 4;

/// When ops begin, in s.
pub(super) struct Clock {
    starts: Vec<f64>,
    /// How long each takes.
    lengths: Vec<f64>,
    /// How long each takes at its programmed speeds; none where the tip follows no line or arc.
    programmed: Vec<Option<f64>>,
    total: f64,
    kinds: [&'static str; Kind::ALL.len()],
    spans: Vec<Span>,
    layers: Vec<(f64, String)>,
    cuts: usize,
}

impl Clock {
    pub(super) fn of(material: &Material<'_>) -> Self {
        let program = material.compiled.program.verified().program();
        let mut clock = Self {
            starts: Vec::with_capacity(program.ops.len()),
            lengths: Vec::with_capacity(program.ops.len()),
            programmed: Vec::with_capacity(program.ops.len()),
            total: 0.0,
            spans: Vec::new(),
            layers: Vec::new(),
            kinds: Kind::ALL.map(name),
            cuts: material.compiled.report.cuts(),
        };
        let several = program.operations.len() > 1;
        let mut layer = None;
        for (segment, time) in program.segments().zip(&material.compiled.op_times) {
            let length = time.to_s();
            let line = segment.line();
            clock.starts.push(clock.total);
            clock.lengths.push(length);
            clock.programmed.push(line.map(|line| line.duration().to_s()));
            let now = layer_of(segment.op.site);
            if let Some((operation, number)) = now.filter(|_| now != layer) {
                let name = if several {
                    format!("{operation}.{number}")
                } else {
                    number.to_string()
                };
                clock.layers.push((clock.total, name));
            }
            layer = now.or(layer);
            if let Some(kind) = Kind::of(&segment.op.action).filter(|_| length > 0.0) {
                let time = [clock.total, clock.total + length];
                let kind = kind as usize;
                clock.spans.push(Span { time, kind });
            }
            clock.total += length;
        }
        clock
    }

    /// How long the program takes.
    pub(super) const fn total(&self) -> f64 {
        self.total
    }

    /// How long an op takes at its programmed speed; none where the tip follows no line or arc.
    pub(super) fn programmed(&self, op: OpId) -> Option<f64> {
        self.programmed.get(op.0 as usize).copied().flatten()
    }

    /// How close samples are that a picture needs.
    pub(super) fn spacing(&self) -> Spacing {
        if self.starts.len() > NARROW * COLUMNS as usize {
            Spacing::APART
        } else {
            Spacing::CLOSE
        }
    }

    /// What is done when.
    pub(super) fn course(&self) -> Course<'_> {
        Course {
            seconds: self.total,
            kinds: &self.kinds,
            spans: &self.spans,
            layers: &self.layers,
            cuts: self.cuts,
        }
    }

    /// When so much of an op is done.
    pub(super) fn time(&self, op: OpId, done: f64) -> f64 {
        let index = op.0 as usize;
        match (self.starts.get(index), self.lengths.get(index)) {
            (Some(start), Some(length)) => start + length * done,
            (_, _) => self.total,
        }
    }
}

/// Operation and layer of a site, both from 1.
fn layer_of(site: Site) -> Option<(u32, u32)> {
    match site {
        Site::Program | Site::Operation(_) => None,
        Site::Layer { operation, layer } | Site::Cut { operation, layer, .. } => {
            Some((u32::from(operation.0) + 1, layer.get()))
        }
    }
}
