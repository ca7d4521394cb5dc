//! Ways to cut an operation, written down as programs of their own and measured.

use super::{Contender, Latitude};
use crate::job::{CheckedJob, Objective};
use crate::lower::lower;
use crate::plan::decision::Standing;
use crate::plan::{LaidOut, PlannedJob, PlannedOperation, PlannedVcut};
use crate::sim::contour::farthest;
use crate::sim::prove::{Bound, replay_on};
use crate::sim::report::area_under;
use crate::sim::surface::Surface;
use crate::sim::timing::timing;
use crate::source::SourceMap;
use crate::wanted::Wanted;
use vcutc_backend_api::units::{Area, Duration, Length};
use vcutc_backend_api::verify::{VerifiedProgram, verify};

/// What a plan comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Figures {
    pub(super) time: Duration,
    pub(super) cuts: usize,
    /// The most that is left: the machined contour's largest distance from the part.
    pub(super) height: Length,
    /// The longest edge in use.
    pub(super) edge: Length,
}

impl Figures {
    /// What an objective makes small: seconds, cuts, or millimetres.
    pub(super) const fn merit(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Time => self.time.to_s(),
            Objective::Cuts => self.cuts as f64,
            Objective::Scallop => self.height.to_mm(),
            Objective::BladeLoad => self.edge.to_mm(),
        }
    }
}

/// A job, and what the operations decided so far leave of its stock.
pub(super) struct Bench<'j> {
    pub(super) job: &'j CheckedJob,
    pub(super) before: Surface,
    pub(super) latitude: Latitude,
    /// Plans that nobody wants any more are not made.
    pub(super) wanted: Wanted,
}

impl<'j> Bench<'j> {
    pub(super) fn new(job: &'j CheckedJob, latitude: Latitude) -> Self {
        Self {
            job,
            before: Surface::flat(job.stock.width.to_mm(), job.stock.height.to_mm()),
            latitude,
            wanted: Wanted::ALWAYS,
        }
    }

    /// An operation as a program of its own.
    fn program(&self, vcut: &PlannedVcut) -> Option<VerifiedProgram> {
        let alone = PlannedJob {
            name: self.job.name.clone(),
            stock: self.job.stock,
            profile: self.job.profile.clone(),
            machine: self.job.machine.clone(),
            operations: vec![PlannedOperation::RoughVcut(vcut.clone())],
        };
        verify(lower(&alone, &SourceMap::default())).ok()
    }

    /// How long an operation takes; none where the compiler is at fault, which the proof of the whole then shows.
    pub(super) fn time(&self, vcut: &PlannedVcut) -> Option<Duration> {
        self.program(vcut).map(|program| timing(&program).all.total())
    }

    /// What comes of an operation.
    pub(super) fn weigh(&self, laid: LaidOut) -> Contender {
        let vcut = &laid.vcut;
        let cuts = vcut.cuts.len();
        let Some(program) = self.program(vcut) else {
            return Contender {
                laid,
                standing: Standing::Impossible,
                figures: Figures {
                    time: Duration::ZERO,
                    cuts,
                    height: Length::ZERO,
                    edge: Length::ZERO,
                },
                residual: Area::ZERO,
            };
        };
        let bound = Bound {
            part: &vcut.bound,
            drop: vcut.parameters.drop,
            edge: vcut.asked.limits.edge.map(|limit| limit.value),
        };
        let replay = replay_on(self.before.clone(), &program, &[bound]);
        let time = timing(&program).all.total();
        let failing = replay.findings.iter().map(|(count, _)| count).sum();
        let corners: Vec<_> = replay.surface.corners().collect();
        let part = self.job.profile.area_below(0.0, self.job.stock.width.to_mm());
        let height = farthest(&corners, &self.job.profile).height;
        Contender {
            laid,
            standing: match failing {
                0 => Standing::Takes(time),
                _ => Standing::Fails(failing),
            },
            figures: Figures {
                time,
                cuts,
                height,
                edge: replay.longest_edge,
            },
            residual: Area::mm2(area_under(&corners)) - part,
        }
    }
}
