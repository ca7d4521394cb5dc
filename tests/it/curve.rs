//! A small operation that only this test has: `mark curve`, a slit that goes into the work along y, turns aside on a quarter
//! circle, turns back on another one and leaves along y. It is one chain, so it shows that chains go through every stage.

use crate::own_operation::{self, Emitted};
use core::num::NonZeroU32;
use glam::DQuat;
use vcutc::diagnostics::source::Span;
use vcutc::diagnostics::{Code, Diagnostic, has_errors};
use vcutc::driver::Outcome;
use vcutc::geometry::curve::Point2;
use vcutc::geometry::grid;
use vcutc::geometry::profile::Profile;
use vcutc::job::description::{ParameterRow, ParameterTable, length_text};
use vcutc::job::operation::{Ground, Laid, Operation, Trials, Unplanned, WorksThere};
use vcutc::job::planned::{CutShape, Estimate, PlannedTip, TipOrigin};
use vcutc::job::sema::field_ranges::SIZE;
use vcutc::job::sema::fields::{BlockSpec, Fields, Inner, value};
use vcutc::job::sema::kind::{Kind, Operations};
use vcutc::job::sema::read::Reader;
use vcutc::job::sema::report::Checked;
use vcutc::job::sema::session::Session;
use vcutc::job::sema::setup;
use vcutc::job::sema::written::Written;
use vcutc::job::{BladeRef, PlannedOperation, Setup, Sourced, StraightBlade};
use vcutc::process::posture::{Feed, Holder};
use vcutc::process::verdict::words::explained;
use vcutc::report;
use vcutc::report::page::Further;
use vcutc::simulation::prove::{Bound, Finding};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, FeedId, Flank, Joint, OperationKind, OrientationId, RateId, Site, SourceRef, Stock, Switch, ViaId,
};
use vcutc_backend_api::units::{Angle, Duration, Length};

#[derive(Debug)]
struct Curve;

const SPEC: BlockSpec = BlockSpec {
    title: "`mark curve`",
    fields: &[
        setup::BLADE,
        setup::RAKE_FIELD,
        value("at", "30 mm").required().within(SIZE),
        value("depth", "3 mm").required().within(SIZE),
        value("radius", "10 mm").required().within(SIZE),
        setup::DIRECTION,
        setup::FEED,
        setup::CLEARANCE,
        setup::EXTENSION,
        setup::RUN_OUT_FIELD,
    ],
    inner: Inner::Refused,
};

impl Kind for Curve {
    fn head(&self) -> &'static str {
        "mark curve"
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        let fields = Fields::sort(&SPEC, written.place, &written.block.entries, session);
        let setup = setup::check(&fields, written, session);
        let blade = setup::blade("blade", &fields, written, session);
        let mut reader = Reader::new(written.scope, &mut session.reports);
        let [at, depth, radius] = ["at", "depth", "radius"].map(|name| reader.required(&fields, name));
        Ok(Box::new(Mark {
            setup: setup?,
            blade: blade?,
            at: at?,
            depth: depth?,
            radius: radius?,
        }))
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Mark {
    setup: Setup,
    blade: StraightBlade,
    at: Sourced<Length>,
    depth: Sourced<Length>,
    radius: Sourced<Length>,
}

impl Mark {
    /// The blade in the plane of its way along y.
    fn along(&self) -> Orientation {
        let holder = Holder {
            swing: Angle::ZERO,
            rake: self.setup.rake.value,
            edges: self.blade.edges,
        };
        holder.cutting(Flank::Right, Feed::Forward)
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
        self.at.forget_place(place);
        self.depth.forget_place(place);
        self.radius.forget_place(place);
    }

    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        Ok(Laid {
            planned: Box::new(Marked {
                asked: self.clone(),
                part: (*ground.job.profile).clone(),
                tip: Point2 {
                    x: grid::nearest(self.at.value.to_mm()),
                    z: grid::nearest((ground.job.stock.height - self.depth.value).to_mm()),
                },
            }),
            after: ground.before,
        })
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Marked {
    asked: Mark,
    part: Profile,
    tip: Point2,
}

const KIND: OperationKind = OperationKind::named("mark_curve").unwrap();

/// How far the chain begins before the stock, and ends after it.
const OUT: f64 = 40.0;

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
            tip: self.tip,
            origin,
            shape: CutShape::Plain,
        }]
    }

    fn extension(&self) -> Length {
        Length::mm(OUT)
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
        let one = NonZeroU32::MIN;
        let site = Site::Cut {
            operation,
            layer: one,
            cut: one,
        };
        let way = Site::Layer {
            operation,
            layer: one,
        };
        let [feed, travel] = [&setup.cut_feed, &setup.travel_feed].map(|feed| builder.feed(feed.value));
        let rate = builder.rate(setup.reorient_rate.value);
        let held = self.asked.along();
        let along = builder.orientation(held);
        let across = builder.orientation(turned_right(held));
        let Stock { height, depth, .. } = builder.stock();
        let safe = (height + setup.clearance.value).to_mm();
        let (Point2 { x, z }, radius) = (self.tip, self.asked.radius.value.to_mm());
        let (middle, right) = (depth.to_mm() / 2.0, x + 2.0 * radius);
        let (short, long) = (radius * (1.0 - 0.5_f64.sqrt()), radius * 0.5_f64.sqrt());
        let first = builder.via(Point3::new(x + short, middle - radius + long, z));
        let second = builder.via(Point3::new(x + radius + long, middle + short, z));
        let start = Point3::new(x, -OUT, safe);
        own_operation::start(builder, way, (start, along), (travel, rate));
        let to = Point3::new(x, -OUT, z);
        builder.op(site, Action::Approach { to, feed: travel });
        let piece = |to: [f64; 2], via: Option<ViaId>, orientation: OrientationId, joint: Joint| {
            let [x, y] = to;
            follow(Point3::new(x, y, z), via, orientation, (feed, rate), joint)
        };
        let through = Joint::Through;
        builder.op(site, piece([x, middle - radius], None, along, through));
        builder.op(site, piece([x + radius, middle], Some(first), across, through));
        builder.op(
            site,
            piece([right, middle + radius], Some(second), along, through),
        );
        builder.op(
            site,
            piece([right, depth.to_mm() + OUT], None, along, Joint::Stop),
        );
        let to = Point3::new(right, depth.to_mm() + OUT, safe);
        builder.op(way, Action::Retract { to, feed: travel });
        builder.op(
            Site::Operation(operation),
            Action::Ultrasonic { state: Switch::Off },
        );
        builder.blend(Length::mm(0.5));
    }

    fn explain(&self, finding: Finding, _: usize, _: &mut dyn Trials, _: &mut WorksThere<'_>) -> Diagnostic {
        explained(&self.asked, finding)
    }

    fn tables(&self) -> Vec<ParameterTable> {
        vec![ParameterTable {
            caption: "Curve",
            rows: vec![ParameterRow::of("depth", self.asked.depth, length_text)],
        }]
    }

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        (field == "extension").then(|| (length_text(self.extension()), String::new()))
    }

    fn layout(&self) -> [String; 2] {
        ["a curve".to_owned(), length_text(self.asked.depth.value)]
    }
}

fn follow(
    to: Point3,
    via: Option<ViaId>,
    orientation: OrientationId,
    (feed, rate): (FeedId, RateId),
    joint: Joint,
) -> Action {
    Action::Follow {
        to,
        orientation,
        via,
        feed,
        rate,
        joint,
    }
}

/// Turned about the vertical from facing +y to facing +x.
fn turned_right(held: Orientation) -> Orientation {
    let [w, x, y, z] = held.quaternion();
    let quarter = DQuat::from_rotation_z(-core::f64::consts::FRAC_PI_2);
    let turned = quarter * DQuat::from_xyzw(x, y, z, w);
    Orientation::from_quaternion(turned.w, turned.x, turned.y, turned.z).unwrap()
}

const KNOWN: Operations = Operations(&[&vcutc::vcut::Vcut, &Curve]);

fn job(depth: &str) -> String {
    format!(
        "job \"curve\"\n\nuse \"shop/cells.vcut\"\nuse \"shop/blades.vcut\"\n\nstock {{ size = (85 mm, 60 mm, 50 mm) }}\n\n\
         profile {{ start (0 mm, 30 mm) line to (85 mm, 30 mm) }}\n\nmark curve {{\n  blade = long_dagger\n  rake = 90 deg\n  \
         at = 30 mm\n  depth = {depth}\n  radius = 10 mm\n  \
         feed {{ cut = 100 mm/s, travel = 100 mm/s, reorient = 45 deg/s }}\n  clearance = 10 mm\n}}\n\n\
         cell {{ machine = large_cell }}\n"
    )
}

fn compiled(depth: &str, machine: &str) -> Outcome {
    own_operation::compiled(KNOWN, job(depth), machine)
}

/// A text, and what takes its place.
type Edit = (&'static str, &'static str);

/// A machine for each target, what it writes for an arc, and edits that change the chain.
const CELLS: [(&str, &str, &str, [Edit; 2]); 3] = [
    (
        "large_cell",
        "krl",
        "CIRC ",
        [(" C_DIS", ""), ("X 32.929", "X 33.929")],
    ),
    (
        "abb_cell",
        "rapid",
        "MoveC ",
        [("MoveC [[30.908", "MoveC [[31.908"), (",fine,", ",z1,")],
    ),
    ("knife_gantry", "gcode", "G2 ", [("G2 ", "G3 "), ("G641", "G60")]),
];

/// Writing a program reads it again and compares it.
#[test]
fn a_chain_goes_through_all_stages_and_targets() {
    for (machine, target, arc, edits) in CELLS {
        let outcome = compiled("3 mm", machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let done = outcome.compiled.as_ref().unwrap();
        assert!(done.report.removed.to_mm2() < 1e-9);
        let page = report::page::page(&outcome, Further::NOTHING).unwrap();
        assert!(page.contains("<caption>Curve</caption>"));
        let emitted = Emitted::of(&outcome, target);
        let text = emitted.text();
        assert!(text.contains("operation 1: mark curve with blade"), "{target}");
        assert!(text.contains(arc), "{target}: {text}");
        assert!(emitted.is_kept_by("", ""), "{target}");
        for (from, to) in edits {
            assert!(text.contains(from), "{target}: no {from} in {text}");
            assert!(!emitted.is_kept_by(from, to), "{target}: {from} to {to}");
        }
    }
}

#[test]
fn a_chain_into_the_part_is_refused_and_one_deeper_than_the_edge() {
    let codes = |depth: &str| -> Vec<Code> {
        let outcome = compiled(depth, "large_cell");
        let codes = outcome.diagnostics.iter().map(|diagnostic| diagnostic.code);
        codes.collect()
    };
    assert_eq!(codes("21 mm"), [Code::Overcut]);
    assert_eq!(codes("45 mm"), [Code::ChipNotFreed, Code::Overcut]);
}
