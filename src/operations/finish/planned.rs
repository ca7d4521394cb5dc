//! The plan of finishing as the stages after planning see it.

use crate::asked::AIR;
use crate::decided::Planned;
use crate::words::Chosen;
use crate::{lower, words};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::SourceRef;
use vcutc_backend_api::units::{Area, Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::PlannedOperation;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{CutShape, Estimate, PlannedTip, TipOrigin};
use vcutc_process::verdict::words::explained;
use vcutc_simulation::prove::{Bound, Finding, Passes, Skin};
use vcutc_simulation::report::{Report, area_under};

impl PlannedOperation for Planned {
    fn asked(&self) -> &dyn Operation {
        &self.asked
    }

    fn asked_mut(&mut self) -> &mut dyn Operation {
        &mut self.asked
    }

    fn cuts(&self) -> usize {
        self.plan.tracks.len()
    }

    fn tips(&self) -> Vec<PlannedTip> {
        let tips = self.plan.tracks.iter().map(|track| PlannedTip {
            layer: 1,
            tip: track.centre,
            origin: TipOrigin::Lattice,
            shape: CutShape::Track {
                contact: track.contact,
                lead: self.plan.lead,
                roll: track.roll,
            },
        });
        tips.collect()
    }

    fn extension(&self) -> Length {
        lower::extension(self)
    }

    fn bound(&self) -> Bound<'_> {
        Bound {
            passes: Some(Passes::Skin(Skin {
                depth: self.asked.disc.depth.value,
                width: self.asked.disc.width.value,
                over_hub: self.asked.over_hub.value,
                clearance: AIR,
            })),
            ..Bound::of(&self.bound)
        }
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.time(),
            cuts: self.cuts() as f64,
        }
    }

    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder) {
        lower::lower(self, source, builder);
    }

    fn explain(
        &self,
        finding: Finding,
        count: usize,
        _: &mut dyn Trials,
        _: &mut WorksThere<'_>,
    ) -> Diagnostic {
        explained(&self.asked, finding).and_more(count, "the same holds for", ["track", "tracks"])
    }

    fn to_remove(&self, _: &Profile, top: &[Point2]) -> Area {
        Area::mm2((area_under(top) - area_under(self.bound.points())).max(0.0))
    }

    fn parameters(&self) -> Vec<ParameterFigure> {
        words::parameters(Chosen::of(self))
    }

    fn tables(&self) -> Vec<ParameterTable> {
        words::tables(Chosen::of(self))
    }

    fn summary(&self, _: &Report) -> Vec<(&'static str, String)> {
        words::summary(self)
    }

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        words::chosen(Chosen::of(self), field)
    }

    fn layout(&self) -> [String; 2] {
        words::layout(Chosen::of(self))
    }
}

impl Planned {
    /// Tracks through the work, and the ways between them at the speed of travel.
    fn time(&self) -> Duration {
        let tracks = &self.plan.tracks;
        let ways = tracks.iter().zip(tracks.iter().skip(1));
        let way: f64 = ways
            .map(|(from, to)| libm::hypot(to.centre.x - from.centre.x, to.centre.z - from.centre.z))
            .sum();
        let track = self.depth + lower::extension(self) * 2.0;
        Length::mm(way) / self.asked.setup.travel_feed.value
            + track * self.cuts() as f64 / self.asked.setup.cut_feed.value
    }
}
