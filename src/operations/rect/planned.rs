//! The plan of rectangular roughing as the stages after planning see it.

use crate::asked::AIR;
use crate::decided::Planned;
use crate::lower;
use crate::plan::StripOrigin;
use crate::{verdict, words};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::SourceRef;
use vcutc_backend_api::units::{Area, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{Balance, Compile, CutShape, Estimate, PlannedStrip, PlannedTip, TipOrigin};
use vcutc_job::{BladeRef, PlannedOperation};
use vcutc_simulation::prove::{Bound, Finding, Passes, Strips};
use vcutc_simulation::report::Report;

impl PlannedOperation for Planned {
    fn asked(&self) -> &dyn Operation {
        &self.asked
    }

    fn asked_mut(&mut self) -> &mut dyn Operation {
        &mut self.asked
    }

    fn cuts(&self) -> usize {
        self.plan.counts().cuts()
    }

    /// Of each layer its slits, then its strips, as they are numbered.
    fn tips(&self) -> Vec<PlannedTip> {
        let slits = lower::slits(&self.plan).map(|(layer, slit)| PlannedTip {
            layer,
            tip: Point2::new(slit.x, slit.bottom),
            origin: TipOrigin::Lattice,
            shape: CutShape::Slit { top: slit.top },
        });
        let strips = self.plan.strips().map(|strip| PlannedTip {
            layer: strip.layer,
            tip: strip.centre,
            origin: match strip.origin {
                StripOrigin::Layer => TipOrigin::Lattice,
                StripOrigin::Lifted => TipOrigin::Lifted,
                StripOrigin::Shifted => TipOrigin::Shifted,
            },
            shape: CutShape::Strip(PlannedStrip {
                low: Point2::new(strip.left, strip.floor),
                high: Point2::new(strip.right, strip.top),
                open: strip.open,
                radius: self.asked.disc.radius.value.to_mm(),
                lead: self.asked.lead.value,
            }),
        });
        let kinds = slits.map(|tip| (0, tip)).chain(strips.map(|tip| (1, tip)));
        let mut all: Vec<(u8, PlannedTip)> = kinds.collect();
        let order = |(kind, tip): &(u8, PlannedTip)| (tip.layer, *kind);
        all.sort_by(|a, b| order(a).cmp(&order(b)).then(a.1.tip.x.total_cmp(&b.1.tip.x)));
        all.into_iter().map(|(_, tip)| tip).collect()
    }

    fn blade_of(&self, shape: CutShape) -> Option<BladeRef<'_>> {
        Some(match shape {
            CutShape::Strip(_) | CutShape::Track { .. } => BladeRef::Disc(&self.asked.disc),
            CutShape::Plain | CutShape::Narrowed { .. } | CutShape::Slit { .. } => {
                BladeRef::Straight(&self.asked.blade)
            }
        })
    }

    fn extension(&self) -> Length {
        self.extensions.slits.max(self.extensions.strips)
    }

    fn bound(&self) -> Bound<'_> {
        Bound {
            aside: self.standoff,
            passes: Some(Passes::Strips(Strips {
                depth: self.asked.disc.depth.value,
                width: self.asked.disc.width.value,
                beyond: self.asked.beyond.value,
                clearance: AIR,
            })),
            ..Bound::of(&self.bound)
        }
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.plan.time,
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
        verdict::explain(self, finding, count)
    }

    fn to_remove(&self, _: &Profile, top: &[Point2]) -> Area {
        words::to_remove(self, top)
    }

    fn explain_what_stays(&self, balance: Balance<'_>, compile: &Compile<'_>) -> Option<Diagnostic> {
        verdict::much_stays(self, balance, compile)
    }

    fn parameters(&self) -> Vec<ParameterFigure> {
        words::parameters(self)
    }

    fn tables(&self) -> Vec<ParameterTable> {
        words::tables(self)
    }

    fn summary(&self, report: &Report) -> Vec<(&'static str, String)> {
        words::summary(self, report)
    }

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        words::chosen(self, field)
    }

    fn layout(&self) -> [String; 2] {
        words::layout(self)
    }
}
