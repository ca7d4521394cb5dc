//! A small operation that only this test has: `skim top`, one pass of a disc along y. It takes a blade that spins through every
//! stage, every target, the read-back and the report.

use crate::own_operation::{self, Emitted};
use core::num::NonZeroU32;
use vcutc::diagnostics::source::Span;
use vcutc::diagnostics::{Code, Diagnostic, has_errors};
use vcutc::driver::Outcome;
use vcutc::geometry::curve::Point2;
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
use vcutc::job::{BladeRef, Disc, PlannedOperation, Setup, Sourced};
use vcutc::process::posture::{Feed, Holder};
use vcutc::process::verdict::words::explained;
use vcutc::report;
use vcutc::report::page::Further;
use vcutc::simulation::prove::{Bound, Finding};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Edges, Flank, Joint, OperationKind, Site, SourceRef, Switch};
use vcutc_backend_api::units::{Angle, Duration, Length};

#[derive(Debug)]
struct Top;

const SPEC: BlockSpec = BlockSpec {
    title: "`skim top`",
    fields: &[
        setup::BLADE,
        setup::RAKE_FIELD,
        value("at", "40 mm").required().within(SIZE),
        value("depth", "1 mm").required().within(SIZE),
        setup::FEED,
        setup::CLEARANCE,
    ],
    inner: Inner::Refused,
};

impl Kind for Top {
    fn head(&self) -> &'static str {
        "skim top"
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        let fields = Fields::sort(&SPEC, written.place, &written.block.entries, session);
        let setup = setup::check(&fields, written, session);
        let disc = setup::blade("blade", &fields, written, session);
        let mut reader = Reader::new(written.scope, &mut session.reports);
        let [at, depth] = ["at", "depth"].map(|name| reader.required(&fields, name));
        Ok(Box::new(Skim {
            setup: setup?,
            disc: disc?,
            at: at?,
            depth: depth?,
        }))
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Skim {
    setup: Setup,
    disc: Disc,
    at: Sourced<Length>,
    depth: Sourced<Length>,
}

impl Operation for Skim {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn blades(&self) -> Vec<BladeRef<'_>> {
        vec![BladeRef::Disc(&self.disc)]
    }

    fn setup_mut(&mut self) -> &mut Setup {
        &mut self.setup
    }

    fn forget_places(&mut self, place: Span) {
        self.disc.forget_places(place);
        self.at.forget_place(place);
        self.depth.forget_place(place);
    }

    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        Ok(Laid {
            planned: Box::new(Skimmed {
                asked: self.clone(),
                part: (*ground.job.profile).clone(),
                centre: Point2 {
                    x: self.at.value.to_mm(),
                    z: (ground.job.stock.height - self.depth.value).to_mm(),
                },
            }),
            after: ground.before,
        })
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Skimmed {
    asked: Skim,
    part: Profile,
    centre: Point2,
}

const KIND: OperationKind = OperationKind::named("skim_top").unwrap();

impl PlannedOperation for Skimmed {
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
            tip: self.centre,
            origin,
            shape: CutShape::Plain,
        }]
    }

    fn extension(&self) -> Length {
        self.asked.disc.radius.value + self.asked.setup.run_out.value
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
        let operation = builder.operation(KIND, self.asked.disc.in_program(), source);
        let (layer, cut) = (NonZeroU32::MIN, NonZeroU32::MIN);
        let site = Site::Cut {
            operation,
            layer,
            cut,
        };
        let way = Site::Layer { operation, layer };
        let [feed, travel] = [&setup.cut_feed, &setup.travel_feed].map(|feed| builder.feed(feed.value));
        let rate = builder.rate(setup.reorient_rate.value);
        let holder = Holder {
            swing: Angle::ZERO,
            rake: setup.rake.value,
            edges: Edges::Double,
        };
        let orientation = builder.orientation(holder.cutting(Flank::Right, Feed::Forward));
        let stock = builder.stock();
        let out = self.extension().to_mm();
        let (back, safe) = (
            stock.depth.to_mm() + out,
            (stock.height + setup.clearance.value).to_mm(),
        );
        let at = |y: f64, z: f64| Point3::new(self.centre.x, y, z);
        let start = at(-out, safe);
        own_operation::start(builder, way, (start, orientation), (travel, rate));
        let to = at(-out, self.centre.z);
        builder.op(site, Action::Approach { to, feed: travel });
        let through = Action::Follow {
            to: at(back, self.centre.z),
            orientation,
            via: None,
            feed,
            rate,
            joint: Joint::Stop,
        };
        builder.op(site, through);
        let to = at(back, safe);
        builder.op(way, Action::Retract { to, feed: travel });
        builder.op(way, Action::Spin { state: Switch::Off });
        builder.op(way, Action::Ultrasonic { state: Switch::Off });
    }

    fn explain(&self, finding: Finding, _: usize, _: &mut dyn Trials, _: &mut WorksThere<'_>) -> Diagnostic {
        explained(&self.asked, finding)
    }

    fn tables(&self) -> Vec<ParameterTable> {
        vec![ParameterTable {
            caption: "Pass",
            rows: vec![ParameterRow::of("depth", self.asked.depth, length_text)],
        }]
    }

    fn layout(&self) -> [String; 2] {
        ["a pass".to_owned(), length_text(self.asked.depth.value)]
    }
}

const KNOWN: Operations = Operations(&[&vcutc::vcut::Vcut, &Top]);

const ROBOT: &str = "base = frame(x = 1700 mm, y = -700 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)\n  \
                     tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)\n  \
                     home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)\n  ultrasonic = output(12)";

/// Its leading side points along Y while the head is upright.
const GANTRY: &str = "base = frame(x = 350 mm, y = 300 mm, z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)\n  \
                      tool = frame(x = 0 mm, y = 0 mm, z = 160 mm, a = -90 deg, b = 0 deg, c = 0 deg)\n  \
                      home = axes(x = 300 mm, y = 200 mm, z = -200 mm, b = 0 deg, a = 0 deg, c = 0 deg)\n  \
                      ultrasonic = output(3)\n  gcode { dialect = sinumerik }";

fn job(depth: &str, spindle: &str) -> String {
    let abb = ROBOT.replace("-90 deg, 90 deg", "0 deg, 0 deg")
        + "\n  load = load(mass = 14 kg, x = 0 mm, y = 0 mm, z = 140 mm)";
    format!(
        "job \"skim\"\n\nstock {{ size = (85 mm, 60 mm, 50 mm) }}\n\nprofile {{ start (0 mm, 30 mm) line to (85 mm, 30 mm) }}\n\n\
         blade wheel = disc {{\n  radius = 25 mm, thickness = 1.5 mm, depth = 10 mm, width = 12 mm, spin = 3000 rev/min\n  \
         body (1.5 mm, 8 mm) (60 mm, 25 mm)\n}}\n\n\
         skim top {{\n  blade = wheel\n  rake = 87 deg\n  at = 30 mm\n  depth = {depth}\n  \
         feed {{ cut = 100 mm/s, travel = 100 mm/s, reorient = 45 deg/s }}\n  clearance = 10 mm\n}}\n\n\
         machine kuka = robot \"kuka/kr210_r3100_ultra\" {{\n  {ROBOT}\n  {spindle}\n}}\n\n\
         machine abb = robot \"abb/irb6700_155_285\" {{\n  {abb}\n  {spindle}\n}}\n\n\
         machine gantry = five_axis \"shop/knife_gantry.toml\" {{\n  {GANTRY}\n}}\n\ncell {{ machine = kuka }}\n"
    )
}

const SPINDLE: &str = "spindle = output(13)";

fn compiled(text: String, machine: &str) -> Outcome {
    own_operation::compiled(KNOWN, text, machine)
}

/// A text, and what takes its place.
type Edit = (&'static str, &'static str);

/// Of each machine its target, the words that start and stop its spindle, and an edit of these.
const CELLS: [(&str, &str, [&str; 2], Edit); 3] = [
    (
        "kuka",
        "krl",
        ["$OUT[13]=TRUE", "$OUT[13]=FALSE"],
        ("$OUT[13]=TRUE", "$OUT[14]=TRUE"),
    ),
    (
        "abb",
        "rapid",
        ["SetDO do13,1;", "SetDO do13,0;"],
        ("SetDO do13,0;", ""),
    ),
    ("gantry", "gcode", ["S3000 M3", "M5"], ("S3000", "S2000")),
];

#[test]
fn a_disc_goes_through_all_stages_and_targets() {
    for (machine, target, words, (from, to)) in CELLS {
        let outcome = compiled(job("1 mm", SPINDLE), machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let page = report::page::page(&outcome, Further::NOTHING).unwrap();
        assert!(page.contains("<caption>Pass</caption>"));
        let emitted = Emitted::of(&outcome, target);
        let text = emitted.text();
        let heading = "operation 1: skim top with blade wheel";
        assert!(text.to_lowercase().contains(heading), "{target}: {text}");
        for word in words {
            assert!(text.contains(word), "{target}: no {word} in {text}");
        }
        assert!(emitted.is_kept_by("", ""), "{target}");
        assert!(!emitted.is_kept_by(from, to), "{target}: {from} to {to}");
    }
}

fn codes(outcome: &Outcome) -> Vec<Code> {
    let codes = outcome.diagnostics.iter().map(|diagnostic| diagnostic.code);
    codes.collect()
}

/// Its hub begins 1.5 mm above the edge, and the part 20 mm below the top.
#[test]
fn a_hub_in_the_stock_and_a_rim_in_the_part_are_refused() {
    let outcome = compiled(job("3 mm", SPINDLE), "kuka");
    assert_eq!(codes(&outcome), [Code::BodyInWork]);
    let deep = compiled(job("19 mm", SPINDLE), "kuka");
    assert!(codes(&deep).contains(&Code::Overcut), "{:?}", deep.diagnostics);
}

/// A gantry's control has a spindle; a robot says which output runs a drive.
#[test]
fn a_robot_that_spins_nothing_is_refused() {
    let outcome = compiled(job("1 mm", ""), "kuka");
    assert_eq!(codes(&outcome), [Code::BladeWithoutTool]);
    let message = &outcome.diagnostics[0].message;
    assert_eq!(message, "`kuka` does not say what spins disc `wheel`");
    assert_eq!(codes(&compiled(job("1 mm", ""), "gantry")), []);
}

/// An operation of straight blades is not cut with a disc, and the other way round.
#[test]
fn a_blade_of_another_kind_is_refused() {
    let text = job("1 mm", SPINDLE);
    let text = text.replace("blade = wheel", "blade = dagger")
        + "\nblade dagger { cutting_length = 10 mm, half_apex = 7 deg, thickness = 1 mm, edges = double }\n";
    let outcome = compiled(text, "kuka");
    assert_eq!(codes(&outcome), [Code::WrongBlade]);
    let message = &outcome.diagnostics[0].message;
    assert_eq!(
        message,
        "`skim top` cuts with a disc; `dagger` is a straight blade"
    );
    assert!(
        outcome.diagnostics[0].fixes[0]
            .title
            .contains("use `wheel`, which is a disc"),
        "{:?}",
        outcome.diagnostics[0].fixes
    );
}
