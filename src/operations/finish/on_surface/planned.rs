//! Tracks on a surface as the stages after planning see them.

use super::plan::{PlannedTracks, held_to};
use super::proof;
use crate::asked::FinishDisc;
use crate::lower::KIND;
use crate::words::{self, Chosen};
use core::num::NonZeroU32;
use std::sync::Arc;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{Site, SourceRef};
use vcutc_backend_api::units::{Angle, Area, Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::Spine;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::judged::{Judged, TiltLimit, Tilts};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{CutShape, Estimate, PlannedTip, TipOrigin};
use vcutc_job::{Auto, PlannedOperation};
use vcutc_process::beside::{Drive, Stage, Writer};
use vcutc_process::lower::BLEND;
use vcutc_process::verdict::words::explained;
use vcutc_simulation::prove::{Bound, Finding, Passes, Replay};
use vcutc_simulation::report::{Report, area_under};
use vcutc_surface::map::Band;
use vcutc_surface::posture::Lean;

/// Finishing a surface with a disc, planned.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedOnSurface {
    pub asked: FinishDisc,
    pub plan: PlannedTracks,
    /// The greatest height of the part over each x, with the spine of the cuts before taken off.
    pub shadow: Profile,
    pub spine: Option<Arc<Spine>>,
}

impl PlannedOnSurface {
    const fn chosen(&self) -> Chosen<'_> {
        Chosen {
            asked: &self.asked,
            step: self.plan.step,
            lead: self.plan.lead,
            side: self.plan.side,
            sequence: self.plan.sequence,
        }
    }

    /// All tracks at the speed of cutting, and about as long ways back at that of travel.
    fn time(&self) -> Duration {
        let long = self.plan.tracks.iter().flat_map(|track| {
            let moves = track.stands.iter().zip(track.stands.iter().skip(1));
            moves.map(|(from, to)| from.tip.distance(to.tip).to_mm())
        });
        let cut = Length::mm(long.sum());
        let back = match self.asked.setup.direction().value {
            vcutc_job::Direction::Alternate => Length::ZERO,
            vcutc_job::Direction::Forward | vcutc_job::Direction::Backward => cut,
        };
        cut / self.asked.setup.cut_feed.value + back / self.asked.setup.travel_feed.value
    }
}

impl PlannedOperation for PlannedOnSurface {
    fn asked(&self) -> &dyn Operation {
        &self.asked
    }

    fn asked_mut(&mut self) -> &mut dyn Operation {
        &mut self.asked
    }

    fn cuts(&self) -> usize {
        self.plan.tracks.len()
    }

    /// Where each track is highest: there it touches the part's shadow, which pictures of sections show.
    fn tips(&self) -> Vec<PlannedTip> {
        let rise = |y: f64| self.spine.as_ref().map_or(0.0, |spine| spine.rise(y));
        let tips = self.plan.tracks.iter().map(|track| {
            let [aside, _, up] = track.pose.axis.to_array();
            let rise = rise(track.highest.y);
            PlannedTip {
                layer: 1,
                tip: Point2::new(track.pose.centre.x, track.pose.centre.z - rise),
                origin: TipOrigin::Lattice,
                shape: CutShape::Track {
                    contact: Point2::new(track.highest.x, track.highest.z - rise),
                    lead: self.plan.lead,
                    roll: Angle::rad(libm::atan2(-aside, up)),
                },
            }
        });
        tips.collect()
    }

    fn extension(&self) -> Length {
        self.asked.disc.radius.value + self.asked.setup.run_out.value
    }

    fn bound(&self) -> Bound<'_> {
        Bound {
            passes: Some(Passes::Tracks(held_to(&self.asked))),
            ..Bound::of(&self.shadow)
        }
    }

    fn judge(&self, judged: Judged<'_>, replay: &mut Replay) {
        proof::judge(held_to(&self.asked), judged, replay);
    }

    /// A track finishes the part halfway to both of its neighbours.
    fn tilts(&self) -> Option<Tilts> {
        let plan = &self.plan;
        let half = plan.step.to_mm() / 2.0;
        let bands = plan.tracks.iter().map(|track| {
            let leans = track.leans.iter();
            let mut angles: Vec<(f64, Angle)> = leans.map(|(at, lean)| (at.y, lean.tilt())).collect();
            angles.sort_by(|(one, _), (other, _)| one.total_cmp(other));
            Band {
                x: [track.x - half, track.x + half],
                angles,
            }
        });
        Some(Tilts {
            bands: bands.collect(),
            limit: match self.asked.lead.value {
                Auto::Given(_) => None,
                Auto::Auto => {
                    let lead = self.asked.limits.lead.value;
                    let side = plan.side;
                    let tilt = Lean { lead, side }.tilt();
                    Some(TiltLimit { lead, tilt })
                }
            },
        })
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.time(),
            cuts: self.cuts() as f64,
        }
    }

    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder) {
        let asked = &self.asked;
        let operation = builder.operation(KIND, asked.disc.in_program(), source);
        builder.blend(BLEND);
        let stage = Stage {
            operation,
            feed: builder.feed(asked.setup.cut_feed.value),
            extension: self.extension(),
            hang: asked.disc.radius.value,
            drives: &[Drive::Spindle, Drive::Generator],
        };
        let mut writer = Writer::new(stage, &asked.setup, builder);
        let mut cut = NonZeroU32::MIN;
        for track in &self.plan.tracks {
            let layer = NonZeroU32::MIN;
            let site = Site::Cut {
                operation,
                layer,
                cut,
            };
            writer.chain(site, &track.stands);
            cut = cut.saturating_add(1);
        }
        writer.leave();
    }

    fn explain(
        &self,
        finding: Finding,
        count: usize,
        _: &mut dyn Trials,
        _: &mut WorksThere<'_>,
    ) -> Diagnostic {
        explained(&self.asked, finding).and_more(count, "the same was found in", ["place", "places"])
    }

    fn to_remove(&self, _: &Profile, top: &[Point2]) -> Area {
        Area::mm2((area_under(top) - area_under(self.shadow.points())).max(0.0))
    }

    fn parameters(&self) -> Vec<ParameterFigure> {
        words::parameters(self.chosen())
    }

    fn tables(&self) -> Vec<ParameterTable> {
        words::tables(self.chosen())
    }

    fn summary(&self, _: &Report) -> Vec<(&'static str, String)> {
        let mut lines: Vec<_> = words::chosen_line(self.chosen()).into_iter().collect();
        let text = format!(
            "{} tracks, {} mm apart, side tilt {} deg",
            self.plan.tracks.len(),
            show((self.plan.step.to_mm() * 1e3).round() / 1e3),
            show(self.plan.side.to_deg()),
        );
        lines.push(("finish", text));
        lines
    }

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        words::chosen(self.chosen(), field)
    }

    fn layout(&self) -> [String; 2] {
        words::layout(self.chosen())
    }
}
