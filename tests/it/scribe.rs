//! A small operation that only this test has: `mark line`, one groove along y at a given x and depth. It goes through every
//! stage, every target, the read-back, the report and the editor, and no stage knows of it: what an operation is, is said by
//! the traits that it implements here.

use crate::lsp::editor::{Editor, uri};
use crate::pipeline::Files;
use crate::repository::root;
use core::num::NonZeroU32;
use serde_json::json;
use vcutc::diagnostics::source::Span;
use vcutc::diagnostics::{Code, Diagnostic, has_errors};
use vcutc::driver::memory::Memory;
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::geometry::curve::Point2;
use vcutc::geometry::grid;
use vcutc::geometry::profile::Profile;
use vcutc::job::description::{ParameterRow, ParameterTable, length_text};
use vcutc::job::operation::{Ground, Laid, Operation, Trials, Unplanned, WorksThere};
use vcutc::job::planned::{CutShape, Estimate, PlannedTip, TipOrigin};
use vcutc::job::sema::field_ranges::{SIZE, SWING};
use vcutc::job::sema::fields::{BlockSpec, Fields, Inner, value};
use vcutc::job::sema::kind::{Kind, Operations};
use vcutc::job::sema::read::Reader;
use vcutc::job::sema::report::Checked;
use vcutc::job::sema::session::Session;
use vcutc::job::sema::setup;
use vcutc::job::sema::written::Written;
use vcutc::job::{BladeRef, PlannedOperation, Setup, Sourced, StraightBlade};
use vcutc::picture::Prefix;
use vcutc::process::posture::{Feed, Holder};
use vcutc::process::verdict::words::explained;
use vcutc::registry;
use vcutc::report::page::Further;
use vcutc::report::{self, Material};
use vcutc::simulation::prove::{Bound, Finding};
use vcutc::simulation::report::Report;
use vcutc::simulation::surface::Vee;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Flank, OperationKind, Site, SourceRef, Stock, Switch};
use vcutc_backend_api::units::{Angle, Area, Duration, Length};

#[derive(Debug)]
struct Line;

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
        let (site, way) = (
            Site::Cut {
                operation,
                layer,
                cut,
            },
            Site::Layer { operation, layer },
        );
        let (feed, travel) = (
            builder.feed(setup.cut_feed.value),
            builder.feed(setup.travel_feed.value),
        );
        let rate = builder.rate(setup.reorient_rate.value);
        let holder = self.asked.holder();
        let there = builder.orientation(holder.cutting(Flank::Left, Feed::Forward));
        let back = builder.orientation(holder.cutting(Flank::Right, Feed::Backward));
        let stock = builder.stock();
        let (front, behind) = (
            -self.extension.to_mm(),
            grid::up((stock.depth + self.extension).to_mm()),
        );
        let safe = grid::up((stock.height + setup.clearance.value).to_mm());
        let at = |y: f64, z: f64| Point3::new(self.vee.tip.x, y, z);
        let low = self.vee.tip.z;
        let start = match builder.knows_tip() {
            true => Action::Travel {
                to: at(front, safe),
                orientation: there,
                feed: travel,
                rate,
            },
            false => Action::AxisTravel {
                to: at(front, safe),
                orientation: there,
            },
        };
        builder.op(way, start);
        builder.op(way, Action::Ultrasonic { state: Switch::On });
        builder.op(way, Action::AwaitReady);
        builder.op(
            site,
            Action::Approach {
                to: at(front, low),
                feed: travel,
            },
        );
        builder.op(
            site,
            Action::Cut {
                flank: Flank::Left,
                to: at(behind, low),
                feed,
            },
        );
        builder.op(site, Action::Turn { to: back, rate });
        builder.op(
            site,
            Action::Cut {
                flank: Flank::Right,
                to: at(front, low),
                feed,
            },
        );
        builder.op(
            way,
            Action::Retract {
                to: at(front, safe),
                feed: travel,
            },
        );
        builder.op(
            Site::Operation(operation),
            Action::Ultrasonic { state: Switch::Off },
        );
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

const KNOWN: Operations = Operations(&[&vcutc::vcut::Vcut, &Line]);

fn job(depth: &str) -> String {
    format!(
        "job \"line\"\n\nuse \"shop/cells.vcut\"\nuse \"shop/blades.vcut\"\n\nstock {{ size = (85 mm, 50 mm, 50 mm) }}\n\n\
         profile {{ start (0 mm, 30 mm) line to (85 mm, 30 mm) }}\n\nmark line {{\n  blade = dagger\n  rake = 60 deg\n  \
         swing = 30 deg\n  at = 40 mm\n  depth = {depth}\n  extension = auto\n  \
         feed {{ cut = 100 mm/s, travel = 100 mm/s, reorient = 45 deg/s }}\n  clearance = 10 mm\n}}\n\n\
         cell {{ machine = large_cell }}\n"
    )
}

fn compiled(depth: &str, machine: &str) -> Outcome {
    let files = Files::of(root().join("examples")).with("line.vcut", job(depth));
    let request = Request {
        path: "line.vcut",
        loader: &files,
        overrides: &[],
        machine: Some(machine),
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: KNOWN,
        targets: &registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}

/// A target for each machine; writing a program reads it again and compares it.
#[test]
fn goes_through_all_stages_and_targets() {
    for (machine, target) in [("large_cell", "krl"), ("abb_cell", "rapid"), ("gantry", "gcode")] {
        let outcome = compiled("3 mm", machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let compiled = outcome.compiled.as_ref().unwrap();
        // A groove 3 mm deep, as wide as its flanks of 30 deg are apart at the top.
        let groove = 9.0 * 30.0_f64.to_radians().tan();
        assert!((compiled.report.removed.to_mm2() - groove).abs() < 1e-3);
        assert!(compiled.summary.iter().any(|line| line.contains("3 mm deep")));
        let mut bundle = Bundle::default();
        driver::emit(&outcome, registry::backend(target).unwrap(), &mut bundle).unwrap();
        let files = bundle.files().iter();
        let texts: String = files.map(|(_, bytes)| String::from_utf8_lossy(bytes)).collect();
        assert!(texts.contains("operation 1: mark line with blade"), "{target}");
        let page = report::page::page(&outcome, Further::NOTHING).unwrap();
        assert!(page.contains("<caption>Line</caption>"));
        let drawn = report::pictures::lattice(&Material::of(&outcome).unwrap(), Prefix::new("p-"));
        assert!(drawn.contains("a line, 1 layer; 3 mm"));
    }
}

#[test]
fn a_line_into_the_part_is_refused_and_one_deeper_than_the_edge_is_not_proven() {
    let codes = |depth: &str| -> Vec<Code> {
        let outcome = compiled(depth, "large_cell");
        outcome
            .diagnostics
            .iter()
            .map(|diagnostic| diagnostic.code)
            .collect()
    };
    assert_eq!(codes("21 mm"), [Code::Overcut]);
    assert_eq!(codes("19 mm"), [Code::ChipNotFreed]);
}

#[test]
fn the_editor_knows_its_fields_and_what_was_chosen() {
    let shop = |name: &str| std::fs::read_to_string(root().join("examples/shop").join(name)).unwrap();
    let text = job("3 mm");
    let (cells, blades) = (shop("cells.vcut"), shop("blades.vcut"));
    let mut editor = Editor::knowing(
        KNOWN,
        &[
            ("line.vcut", &text),
            ("shop/cells.vcut", &cells),
            ("shop/blades.vcut", &blades),
            ("shop/gantry.toml", &shop("gantry.toml")),
            ("shop/knife_gantry.toml", &shop("knife_gantry.toml")),
        ],
    );
    editor.open("/shop/line.vcut");
    editor.settle();
    let task = editor.server.task().unwrap();
    let done = task.run(&editor.files, &registry::backends(), &mut Memory::none());
    let messages = editor.server.finish(done);
    editor.take(&messages);
    let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let params = json!({ "textDocument": { "uri": uri("/shop/line.vcut") }, "range": whole });
    let hints = editor.ask("textDocument/inlayHint", params).unwrap();
    // 10 mm of edge lean over the work by cos(60 deg - 7.13 deg), and `run_out` is 2 mm.
    assert_eq!(hints[0]["label"], "= 8.037 mm");
    let offers = editor
        .ask(
            "textDocument/completion",
            editor.at("/shop/line.vcut", "depth = 3 mm\n|"),
        )
        .unwrap();
    let offered = serde_json::to_string(&offers).unwrap();
    assert!(
        offered.contains("direction") && !offered.contains("lattice"),
        "{offered}"
    );
}

/// A job without operations is offered the first kind, with the fields that it must have.
#[test]
fn a_job_without_operations_is_offered_one() {
    let offered = Line.example("dagger");
    assert!(
        offered.starts_with("mark line {\n  blade = dagger\n"),
        "{offered}"
    );
    assert!(
        offered.contains("depth = 3 mm") && !offered.contains("direction"),
        "{offered}"
    );
}
