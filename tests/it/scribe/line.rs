//! `mark line`: one groove along y at a given x and depth.

use crate::own_operation::start;
use core::num::NonZeroU32;
use vcutc::diagnostics::source::Span;
use vcutc::diagnostics::{Code, Diagnostic};
use vcutc::geometry::curve::Point2;
use vcutc::geometry::grid;
use vcutc::geometry::profile::Profile;
use vcutc::job::description::{ParameterRow, ParameterTable, length_text};
use vcutc::job::operation::{Ground, Laid, Operation, Trials, Unplanned, WorksThere};
use vcutc::job::planned::{CutShape, Estimate, PlannedTip, TipOrigin};
use vcutc::job::sema::field_ranges::{SIZE, SWING};
use vcutc::job::sema::fields::{BlockSpec, Fields, Inner, value};
use vcutc::job::sema::kind::Kind;
use vcutc::job::sema::read::Reader;
use vcutc::job::sema::report::Checked;
use vcutc::job::sema::session::Session;
use vcutc::job::sema::setup;
use vcutc::job::sema::written::Written;
use vcutc::job::{BladeRef, PlannedOperation, Setup, Sourced, StraightBlade};
use vcutc::process::posture::{Feed, Holder};
use vcutc::process::verdict::words::explained;
use vcutc::simulation::prove::{Bound, Finding};
use vcutc::simulation::report::Report;
use vcutc::simulation::surface::Vee;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Flank, OperationKind, Site, SourceRef, Stock, Switch};
use vcutc_backend_api::units::{Angle, Area, Duration, Length};

#[derive(Debug)]
pub(super) struct Line;

const SPEC: BlockSpec = BlockSpec {
    title: "`mark line`",
    fields: &[
        setup::BLADE,
        setup::RAKE_FIELD,
        value("swing", "30 deg").required().within(SWING),
        value("at", "40 mm").required().within(SIZE),
        value("depth", "3 mm").required().within(SIZE),
        setup::DIRECTION,
        setup::FEED,
        setup::CLEARANCE,
        setup::EXTENSION,
        setup::RUN_OUT_FIELD,
    ],
    inner: Inner::Refused,
};

impl Kind for Line {
    fn head(&self) -> &'static str {
        "mark line"
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        let fields = Fields::sort(&SPEC, written.place, &written.block.entries, session);
        let setup = setup::check(&fields, written, session);
        let blade = setup::blade("blade", &fields, written, session);
        let mut reader = Reader::new(written.scope, &mut session.reports);
        let (swing, at) = (reader.required(&fields, "swing"), reader.required(&fields, "at"));
        let depth = reader.required(&fields, "depth");
        Ok(Box::new(Mark {
            setup: setup?,
            blade: blade?,
            swing: swing?,
            at: at?,
            depth: depth?,
        }))
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Mark {
    setup: Setup,
    blade: StraightBlade,
    swing: Sourced<Angle>,
    at: Sourced<Length>,
    depth: Sourced<Length>,
}

impl Mark {
    fn vee(&self, stock: Stock) -> Vee {
        let tip = Point2 {
            x: grid::nearest(self.at.value.to_mm()),
            z: grid::nearest((stock.height - self.depth.value).to_mm()),
        };
        let slope = 1.0 / self.swing.value.to_rad().tan();
        Vee::even(tip, slope)
    }

    const fn holder(&self) -> Holder {
        Holder {
            swing: self.swing.value,
            rake: self.setup.rake.value,
            edges: self.blade.edges,
        }
    }

    /// What keeps it from being marked: the part.
    fn refused(&self, ground: &Ground<'_>) -> Option<Diagnostic> {
        let vee = self.vee(ground.job.stock);
        let part = &ground.job.profile;
        let corners = part.points().iter().any(|point| point.z > vee.height(point.x));
        let enters = corners || part.height(vee.tip.x) > vee.tip.z;
        let span = self.depth.span.unwrap_or(self.setup.head_span);
        enters.then(|| {
            Diagnostic::new(
                Code::Overcut,
                "the line would enter the part",
                span,
                "too deep here",
            )
        })
    }
}

impl Operation for Mark {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn blades(&self) -> Vec<BladeRef<'_>> {
        vec![BladeRef::Straight(&self.blade)]
    }

    fn setup_mut(&mut self) -> &mut Setup {
        &mut self.setup
    }

    fn forget_places(&mut self, place: Span) {
        self.blade.forget_places(place);
        self.swing.forget_place(place);
        self.at.forget_place(place);
        self.depth.forget_place(place);
    }

    fn plan<'j>(&'j self, mut ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        if let Some(diagnostic) = self.refused(&ground) {
            return Err(Box::new(diagnostic));
        }
        let blade = &self.blade;
        let overhang = self
            .holder()
            .turning_overhang(blade.cutting_length.value, blade.half_apex.value);
        let extension = self
            .setup
            .extension()
            .value
            .or(overhang + self.setup.run_out.value);
        let vee = self.vee(ground.job.stock);
        ground.before.release(vee);
        Ok(Laid {
            planned: Box::new(Marked {
                asked: self.clone(),
                part: (*ground.job.profile).clone(),
                vee,
                extension: Length::mm(grid::up(extension.to_mm())),
            }),
            after: ground.before,
        })
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Marked {
    asked: Mark,
    part: Profile,
    vee: Vee,
    extension: Length,
}

const KIND: OperationKind = OperationKind::named("mark_line").unwrap();

impl PlannedOperation for Marked {
    fn asked(&self) -> &dyn Operation {
        &self.asked
    }

    fn asked_mut(&mut self) -> &mut dyn Operation {
        &mut self.asked
    }

    fn tips(&self) -> Vec<PlannedTip> {
        let origin = TipOrigin::Given;
        vec![PlannedTip {
            layer: 1,
            tip: self.vee.tip,
            origin,
            shape: CutShape::Plain,
        }]
    }

    fn swing(&self) -> Angle {
        self.asked.swing.value
    }

    fn extension(&self) -> Length {
        self.extension
    }

    fn bound(&self) -> Bound<'_> {
        Bound::of(&self.part)
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: Duration::s(2.0),
            cuts: 1.0,
        }
    }

    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder) {
        let setup = &self.asked.setup;
        let operation = builder.operation(KIND, self.asked.blade.in_program(), source);
        let (layer, cut) = (NonZeroU32::MIN, NonZeroU32::MIN);
        let site = Site::Cut {
            operation,
            layer,
            cut,
        };
        let way = Site::Layer { operation, layer };
        let [feed, travel] = [&setup.cut_feed, &setup.travel_feed].map(|feed| builder.feed(feed.value));
        let rate = builder.rate(setup.reorient_rate.value);
        let holder = self.asked.holder();
        let there = builder.orientation(holder.cutting(Flank::Left, Feed::Forward));
        let back = builder.orientation(holder.cutting(Flank::Right, Feed::Backward));
        let Stock { height, depth, .. } = builder.stock();
        let safe = grid::up((height + setup.clearance.value).to_mm());
        let at = |y: f64, z: f64| Point3::new(self.vee.tip.x, y, z);
        let low = self.vee.tip.z;
        let (front, behind) = (
            -self.extension.to_mm(),
            grid::up((depth + self.extension).to_mm()),
        );
        start(builder, way, (at(front, safe), there), (travel, rate));
        let cut = |flank: Flank, y: f64| Action::Cut {
            flank,
            to: at(y, low),
            feed,
        };
        let to = at(front, low);
        builder.op(site, Action::Approach { to, feed: travel });
        builder.op(site, cut(Flank::Left, behind));
        builder.op(site, Action::Turn { to: back, rate });
        builder.op(site, cut(Flank::Right, front));
        let to = at(front, safe);
        builder.op(way, Action::Retract { to, feed: travel });
        let state = Switch::Off;
        builder.op(Site::Operation(operation), Action::Ultrasonic { state });
    }

    fn explain(&self, finding: Finding, _: usize, _: &mut dyn Trials, _: &mut WorksThere<'_>) -> Diagnostic {
        explained(&self.asked, finding)
    }

    fn to_remove(&self, _: &Profile, _: &[Point2]) -> Area {
        Area::mm2(self.asked.depth.value.to_mm().powi(2) / self.vee.right.unwrap())
    }

    fn tables(&self) -> Vec<ParameterTable> {
        let rows = vec![ParameterRow::of("depth", self.asked.depth, length_text)];
        vec![ParameterTable {
            caption: "Line",
            rows,
        }]
    }

    fn summary(&self, _: &Report) -> Vec<(&'static str, String)> {
        vec![("line", format!("{} deep", length_text(self.asked.depth.value)))]
    }

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        (field == "extension").then(|| (length_text(self.extension), String::new()))
    }

    fn layout(&self) -> [String; 2] {
        ["a line".to_owned(), length_text(self.asked.depth.value)]
    }
}
