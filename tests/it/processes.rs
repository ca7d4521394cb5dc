//! `rough auto`: both processes compiled, and the faster taken. The numbers are those of the paper and of plans that were checked
//! by an independent model.

use crate::optimum_table::keep;
use crate::pipeline::Files;
use crate::repository::root;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::ways::{Came, ComparedWay};
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::optimize;
use vcutc::process::comparison::{Faster, PlanTime};
use vcutc::process::plan::plan;
use vcutc::registry;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;

/// A machine that says how long a change takes.
const ROBOT: &str = "machine kuka = robot \"kuka/kr210_r3100_ultra\" {
  tool dagger { frame = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 1 }
  tool wheel { frame = frame(x = 0 mm, y = 0 mm, z = 280 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 2 }
  base = frame(x = 1700 mm, y = -600 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  change { at = joints(60 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg), time = 10 s, by = hand }
  ultrasonic = output(12)
  spindle = output(13)
  ready = after(0 s)
}
";

/// What differs between jobs.
#[derive(Clone, Copy)]
struct Job {
    size: [f64; 3],
    profile: &'static str,
    /// Feeds other than in cuts: `travel` and `reorient`.
    quick: &'static str,
    scallop: f64,
    vcut: &'static str,
    rect: &'static str,
    /// Feed of the disc, in m/min.
    free: f64,
}

/// The flat block of the paper's comparison, without ways through the air.
const FLAT: Job = Job {
    size: [60.0, 1000.0, 70.0],
    profile: "start (0 mm, 10 mm)  line to (60 mm, 10 mm)",
    quick: "travel = 6000 m/min, reorient = 10000 deg/s",
    scallop: 9.9,
    vcut: "swing = 30 deg",
    rect: "layer = 10 mm, step = 10 mm, lead = 0 deg, beyond = 0 mm, through = 1",
    free: 10.0,
};

impl Job {
    fn text(self) -> String {
        let Self {
            size: [width, depth, height],
            profile,
            quick,
            scallop,
            vcut,
            rect,
            free,
        } = self;
        format!(
            "job \"block\"\n\nstock {{ size = ({width} mm, {depth} mm, {height} mm) }}\n\nprofile {{ {profile} }}\n\n\
             blade dagger {{ cutting_length = 12.543 mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }}\n\
             blade wheel = disc {{\n  radius = 25 mm, thickness = 1 mm, depth = 12 mm, width = 20 mm, spin = 3000 rev/min\n  \
             body (1 mm, 8 mm) (60 mm, 25 mm)\n}}\n\n\
             rough auto {{\n  blade = dagger\n  rake = 60 deg\n  limits {{ scallop <= {scallop} mm }}\n  \
             feed {{ cut = 10 m/min, {quick} }}\n  clearance = 10 mm\n  run_out = 0 mm\n  vcut {{ {vcut}\n redundant = keep }}\n  \
             rect {{ disc = wheel, {rect}, feed {{ free = {free} m/min }} }}\n}}\n\n{ROBOT}"
        )
    }

    /// Both ways as planned: V cuts, then slits and strips.
    fn planned(self) -> [PlanTime; 2] {
        self.counted().map(|(_, time)| time)
    }

    /// The same with how many cuts each has.
    fn counted(self) -> [(usize, PlanTime); 2] {
        let files = Files::of(root().join("examples")).with("block.vcut", self.text());
        let job = driver::understood(request(&files)).unwrap();
        let ways = job.each_way().unwrap();
        let times = ways.iter().map(|(_, job)| {
            let (planned, found) = plan(job);
            assert!(!has_errors(&found), "{found:?}");
            let planned = planned.unwrap();
            let time = PlanTime::of(&planned, OperationId(0)).unwrap();
            (planned.operations[0].cuts(), time)
        });
        times.collect::<Vec<_>>().try_into().unwrap()
    }

    fn compiled(self) -> Outcome {
        compiled(self.text())
    }
}

fn request(files: &Files) -> Request<'_> {
    Request {
        path: "block.vcut",
        loader: files,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: registry::OPERATIONS,
        targets: &[],
    }
}

fn compiled(text: String) -> Outcome {
    let files = Files::of(root().join("examples")).with("block.vcut", text);
    driver::compile(request(&files), &mut |_| {}).unwrap()
}

/// Within half a percent.
fn near(found: f64, published: f64) {
    assert!(
        (found / published - 1.0).abs() < 0.005,
        "{found} instead of {published}"
    );
}

fn seconds(planned: &PlanTime) -> f64 {
    planned.at(planned.depth, 1.0).to_s()
}

/// At disc feeds of 0.3, 0.6 and 1 of that of the blade: 1048.73, 670.73 and 519.53 s, and V cuts 554.4 s (without ways).
#[test]
fn times_of_the_flat_block_are_the_published_ones() {
    for (free, published) in [(3.0, 1048.73), (6.0, 670.73), (10.0, 519.53)] {
        let [vcut, rect] = Job { free, ..FLAT }.planned();
        near(seconds(&vcut), 554.4);
        near(seconds(&rect), published);
        assert_eq!((rect.changes, rect.changing.to_s()), (11, 110.0));
    }
}

/// With `r* = 0.6000` both need as long per mm of depth, so they differ by the changes of blade and the extensions alone.
#[test]
fn at_the_even_ratio_of_feeds_neither_gains_with_the_depth() {
    let [vcut, rect] = Job { free: 6.0, ..FLAT }.planned();
    let gap = |depth| rect.at(depth, 1.0).to_s() - vcut.at(depth, 1.0).to_s();
    let [near_gap, far_gap] = [1000.0, 5000.0].map(|depth| gap(Length::mm(depth)));
    near(near_gap, 116.31);
    near(far_gap, near_gap);
}

/// Rectangular cutting wins from 757.73 mm on against V cuts at 30 deg, and from 1150.53 mm on against the best ones; at a depth of
/// 1000 mm it does so from a disc feed of 8.667 and of 10.681 m/min on.
#[test]
fn processes_are_even_where_the_independent_model_says() {
    for (vcut, depth, feed) in [
        ("swing = 30 deg", 757.73, 8.667),
        ("limits { swing <= 50 deg }", 1150.53, 10.681),
    ] {
        let [vcut, rect] = Job { vcut, ..FLAT }.planned();
        let Faster::Beyond(found) = rect.is_faster_than(&vcut) else {
            panic!("{:?}", rect.is_faster_than(&vcut));
        };
        near(found.to_mm(), depth);
        let even = rect.even_feed(&vcut).unwrap();
        near(even.to_mm_per_s() * 0.06, feed);
        // Both answers against the times themselves.
        let times = [&vcut, &rect].map(|way| way.at(found, 1.0).to_s());
        assert!((times[0] - times[1]).abs() < 1e-6, "{times:?}");
        let share = even.to_mm_per_s() * 0.06 / 10.0;
        let times = [vcut.at(vcut.depth, 1.0), rect.at(rect.depth, share)].map(|time| time.to_s());
        assert!((times[0] - times[1]).abs() < 1e-6, "{times:?}");
    }
}

/// The parts of the comparison that are not blocks, 1000 mm deep, with the best V cuts in s and the feed of
/// the disc in m/min at which both processes are even.
const CURVED: [(&str, f64, &str, f64, f64); 3] = [
    (
        "curve",
        85.0,
        "start (0 mm, 18 mm) bezier (20 mm, 30 mm) (60 mm, 34 mm) to (85 mm, 14 mm)",
        283.4,
        10.183,
    ),
    (
        "slope",
        100.0,
        "start (0 mm, 10 mm) line to (100 mm, 40 mm)",
        308.0,
        9.714,
    ),
    (
        "hill",
        100.0,
        "z(x) = 40 mm - 30 mm * ((x - 50 mm) / 50 mm) ^ 2",
        271.1,
        9.651,
    ),
];

const fn curved(width: f64, profile: &'static str) -> Job {
    Job {
        size: [width, 1000.0, 50.0],
        profile,
        vcut: "limits { swing <= 50 deg }",
        rect: "residual = shift, layer = 10 mm, step = 10 mm, lead = 0 deg, beyond = 0 mm, through = 1",
        ..FLAT
    }
}

/// On parts that are not blocks: strips up to the part against the best V cuts, 1000 mm deep.
#[test]
fn on_curved_parts_the_disc_has_to_be_as_fast_as_the_independent_model_says() {
    for (_, width, profile, vcut_s, feed) in CURVED {
        let [vcut, rect] = curved(width, profile).planned();
        near(seconds(&vcut), vcut_s);
        near(rect.even_feed(&vcut).unwrap().to_mm_per_s() * 0.06, feed);
        assert_eq!(rect.changes, 5);
    }
}

/// The faster one changes between disc feeds of 10 and 10.4 m/min on the curve, and between depths of 1120 and 1180 mm on the block.
#[test]
fn the_faster_process_changes_where_the_independent_model_says() {
    let (_, width, profile, ..) = CURVED[0];
    let at_feed = |free| Job {
        free,
        ..curved(width, profile)
    };
    let best = Job {
        vcut: "limits { swing <= 50 deg }",
        ..FLAT
    };
    let at_depth = |depth| Job {
        size: [60.0, depth, 70.0],
        ..best
    };
    for (job, rect_wins) in [
        (at_feed(10.0), false),
        (at_feed(10.4), true),
        (at_depth(1120.0), false),
        (at_depth(1180.0), true),
    ] {
        let [vcut, rect] = job.planned();
        assert_eq!(seconds(&rect) < seconds(&vcut), rect_wins);
    }
    near(seconds(&best.planned()[0]), 505.07);
    for (feed, published) in [(6.0, 369.6), (10.0, 285.6), (10.5, 279.6), (12.0, 264.6)] {
        near(seconds(&at_feed(feed).planned()[1]), published);
    }
}

/// Without a machine it is not known how long a change takes, and the summary says that it is not counted.
#[test]
fn changes_without_a_machine_are_said_not_to_count() {
    let text = SLOW.text();
    let outcome = compiled(text.replace(ROBOT, ""));
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let summary = &outcome.compiled.as_ref().unwrap().summary;
    for words in [
        "11 changes of blade, not counted)",
        "(programmed speeds, without the time of changes)",
    ] {
        assert!(summary.iter().any(|line| line.contains(words)), "{summary:?}");
    }
}

/// A program takes what the formula of rectangular cutting adds up, term by term:
/// `N_s (D + 2 b_s) / v_t + N_p (D + 2 b_p) / v_d + C t_c`, a step aside after every pass but the last of a run, and the ways from
/// layer to layer.
#[test]
fn a_program_takes_as_long_as_the_terms_of_the_formula() {
    let outcome = Job {
        size: [60.0, 600.0, 70.0],
        free: 6.0,
        // No V cuts in so little time.
        vcut: "limits { time <= 1 s }",
        ..SLOW
    }
    .compiled();
    let compiled = outcome.compiled.unwrap();
    let times = compiled.report.times.all;
    let [slits, strips, changes] = [30.0, 36.0, 11.0];
    let (edge, leading) = (12.543, (60.0_f64 - 7.13).to_radians());
    let slitting = slits * (600.0 + 2.0 * edge * leading.cos()) / (10_000.0 / 60.0);
    let freeing = strips * (600.0 + 2.0 * 25.0) / (6_000.0 / 60.0);
    // Extensions are rounded up to the micrometre that programs print.
    let rounding = (slits + strips) * 2.0 * 1e-3 / 100.0;
    let cutting = times.cutting.to_s() - slitting - freeing;
    assert!((0.0..=rounding).contains(&cutting), "{cutting}");
    assert!((times.changes.to_s() - changes * 10.0).abs() < 1e-9);
    assert_eq!(times.waiting.to_s(), 0.0);
    // Between slits the blade turns by 60 deg at 90 deg/s, which takes longer than 10 mm at 200 mm/s; the disc without a lead does
    // not turn. A run is what one blade does between two changes.
    let runs = changes + 1.0;
    let (slit_runs, strip_runs) = (runs / 2.0, runs / 2.0);
    let aside = (slits - slit_runs) * (60.0 / 90.0) + (strips - strip_runs) * (10.0 / 200.0);
    let ways = times.travel.to_s() + times.turning.to_s() - aside;
    // Down from the safe plane and up again, at most from the lowest layer.
    let lowest = 2.0 * (10.0 + 60.0) / 200.0;
    assert!((0.0..=runs * lowest + 1e-6).contains(&ways), "{ways}");
}

/// The table of both processes in `docs/optimum.md`. `UPDATE_DOCS=1 cargo test --test it processes` rewrites
/// it.
#[test]
fn the_table_of_processes_is_current() {
    let best = Job {
        vcut: "limits { swing <= 50 deg }",
        ..FLAT
    };
    let blocks = [("block, swing of 30 deg", FLAT), ("block", best)];
    let curved = CURVED.map(|(name, width, profile, ..)| (name, curved(width, profile)));
    let lines: String = blocks
        .into_iter()
        .chain(curved)
        .map(|(name, job)| {
            let [(vees, vcut), (cuts, rect)] = job.counted();
            let feed = rect.even_feed(&vcut).unwrap().to_mm_per_s() * 0.06;
            let depth = match rect.is_faster_than(&vcut) {
                Faster::Beyond(depth) => format!("from {:.0}", depth.to_mm()),
                Faster::Below(depth) => format!("up to {:.0}", depth.to_mm()),
                Faster::Everywhere => "all".to_owned(),
                Faster::Nowhere => "none".to_owned(),
            };
            format!(
                "| {name} | {vees} | {:.1} | {cuts} | {} | {:.1} | {:.1} | {feed:.2} | {depth} |\n",
                seconds(&vcut),
                rect.changes,
                rect.at(rect.depth, 0.6).to_s(),
                seconds(&rect),
            )
        })
        .collect();
    keep(
        "docs/optimum.md",
        "<!-- table: written by tests/it/processes.rs -->",
        &format!(
            "| Part | Vs | V cuts, s | Slits and strips | Changes | Disc at 6 m/min, s | at 10 m/min, s | Even at a disc feed of, m/min | Strips faster at 10 m/min, depths in mm |\n\
            | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n{lines}"
        ),
    );
}

/// What is read off for another depth is what is planned for it.
#[test]
fn times_of_other_depths_are_those_of_plans() {
    let ways = FLAT.planned();
    for depth in [120.0, 777.0, 3000.0] {
        let deeper = Job {
            size: [60.0, depth, 70.0],
            ..FLAT
        };
        for (one, other) in ways.iter().zip(deeper.planned()) {
            let read_off = one.at(Length::mm(depth), 1.0).to_s();
            assert!((read_off / seconds(&other) - 1.0).abs() < 1e-9, "{depth} mm");
        }
    }
}

/// With speeds that the machine follows.
const SLOW: Job = Job {
    quick: "travel = 200 mm/s, reorient = 90 deg/s",
    size: [60.0, 400.0, 70.0],
    vcut: "limits { swing <= 50 deg }",
    ..FLAT
};

#[test]
fn the_faster_process_is_taken() {
    for (depth, first) in [(300.0, "vcut"), (800.0, "rect")] {
        let outcome = Job {
            size: [60.0, depth, 70.0],
            ..SLOW
        }
        .compiled();
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let [comparison] = outcome.comparisons.as_slice() else {
            panic!("{:?}", outcome.comparisons);
        };
        assert_eq!(comparison.ways[0].word, first);
        let time = |way: &ComparedWay| match &way.came {
            Came::Compiled(figures) => figures.time,
            Came::Refused(why) => panic!("{why:?}"),
        };
        assert!(time(&comparison.ways[0]) <= time(&comparison.ways[1]));
        let compiled = outcome.compiled.unwrap();
        assert_eq!(compiled.report.times.all.total(), time(&comparison.ways[0]));
        let kind = &compiled.program.verified().program().operations[0].kind;
        assert_eq!(String::from(kind.clone()), format!("rough_{first}"));
        assert!(outcome.job.unwrap().open.is_empty());
    }
}

/// A valley is closed to the disc, and steep walls are to V cuts: the process that is left is taken, and why the other one is not.
#[test]
fn a_process_that_does_not_compile_is_named_with_the_reason() {
    let outcome = Job {
        size: [100.0, 60.0, 50.0],
        profile: "start (0 mm, 40 mm) line to (30 mm, 10 mm) line to (70 mm, 10 mm) line to (100 mm, 40 mm)",
        ..SLOW
    }
    .compiled();
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let ways = &outcome.comparisons[0].ways;
    assert_eq!(ways[0].word, "vcut");
    let Came::Refused(Some(why)) = &ways[1].came else {
        panic!("{ways:?}");
    };
    assert_eq!(why.code, Code::NoAccess);
    let summary = outcome.compiled.unwrap().summary.join("\n");
    assert!(summary.contains("rect: no, layer 2 is closed"), "{summary}");
    assert!(!summary.contains("break even"), "{summary}");
}

#[test]
fn where_neither_compiles_the_first_is_explained() {
    let limited = SLOW
        .text()
        .replace("scallop <= 9.9 mm", "scallop <= 9.9 mm, time <= 9 s");
    let outcome = compiled(limited);
    assert!(has_errors(&outcome.diagnostics));
    assert!(outcome.compiled.is_none());
    let [vcut, rect] = outcome.comparisons[0].ways.as_slice() else {
        panic!("{:?}", outcome.comparisons);
    };
    assert_eq!((vcut.word, rect.word), ("vcut", "rect"));
    assert!(matches!(&vcut.came, Came::Refused(Some(why)) if outcome.diagnostics[0].code == why.code));
    assert!(matches!(rect.came, Came::Refused(Some(_))));
}

/// What both processes share is wrong once, and what one of them lacks is added in its own block.
#[test]
fn faults_are_reported_once_and_in_their_block() {
    let good = SLOW.text();
    let codes = |text: &str| -> Vec<Code> {
        let outcome = compiled(text.to_owned());
        outcome.diagnostics.iter().map(|one| one.code).collect()
    };
    assert_eq!(
        codes(&good.replace("rake = 60 deg", "rake = 100 deg")),
        [Code::OutOfRange]
    );
    assert_eq!(codes(&good.replace("disc = wheel, ", "")), [Code::MissingField]);
    assert_eq!(
        codes(&good.replace("limits { scallop <= 9.9 mm }", "limits { time <= 9 min }")),
        [Code::MissingField]
    );
    assert_eq!(
        codes(&good.replace("limits { swing <= 50 deg }", "limits { swung <= 50 deg }")),
        [Code::UnknownField]
    );
    assert_eq!(codes(&good.replace("vcut {", "vcuts {")), [Code::UnknownBlock]);
    assert_eq!(
        codes(&good.replace("blade = dagger", "blade = wheel")),
        [Code::WrongBlade]
    );
    assert_eq!(
        codes(&good.replace("rake = 60 deg", "rake = 60 mm")),
        [Code::WrongDimension]
    );
}

/// What a block within says stands for what is shared.
#[test]
fn a_process_may_have_what_is_shared_otherwise() {
    let text = SLOW
        .text()
        .replace("vcut { ", "vcut { rake = 70 deg, feed { cut = 5 m/min }, ");
    let files = Files::of(root().join("examples")).with("block.vcut", text);
    let ways = driver::understood(request(&files)).unwrap().each_way().unwrap();
    let set: Vec<(f64, f64, f64)> = ways
        .iter()
        .map(|(_, job)| {
            let setup = job.operations[0].setup();
            (
                setup.rake.value.to_deg().round(),
                setup.cut_feed.value.to_mm_per_s() * 0.06,
                setup.travel_feed.value.to_mm_per_s(),
            )
        })
        .collect();
    assert_eq!(set[0].0, 70.0);
    assert_eq!(set[1].0, 60.0);
    assert!(
        (set[0].1 - 5.0).abs() < 1e-9 && (set[1].1 - 10.0).abs() < 1e-9,
        "{set:?}"
    );
    assert_eq!((set[0].2, set[1].2), (200.0, 200.0));
}

#[test]
fn optimising_reports_what_has_no_formulas_and_both_processes() {
    let text = Job {
        size: [60.0, 800.0, 70.0],
        ..SLOW
    }
    .text();
    let files = Files::of(root().join("examples")).with("block.vcut", text);
    let optimised = optimize::optimise(
        request(&files),
        optimize::Wanted {
            against: optimize::Against::Scallop,
            points: 3,
        },
        &mut |_| {},
    )
    .unwrap();
    let text = optimize::report::text(&optimised);
    for line in [
        "rect           30 slits, 36 strips, 11 changes of blade",
        "break even     vcut is faster below",
    ] {
        assert!(text.contains(line), "{text}");
    }
    let body = serde_json::to_value(optimize::json::body(&optimised)).unwrap();
    assert_eq!(body["processes"][0]["process"], "rect");
    assert_eq!(body["processes"][1]["cuts"], 41);
    assert_eq!(body["others"][0]["operation"], 1);
    // Slits and strips under other limits are what the job comes to with such a limit.
    let points = body["rects"][0]["trade_off"].as_array().unwrap();
    assert!(!points.is_empty(), "{text}");
    for point in points {
        let planned = &point["planned"];
        let Some(slits) = planned["slits"].as_u64() else {
            continue;
        };
        let job = Job {
            size: [60.0, 600.0, 70.0],
            scallop: point["limit"].as_f64().unwrap(),
            ..SLOW
        };
        let [_, (cuts, _)] = job.counted();
        assert_eq!(slits + planned["strips"].as_u64().unwrap(), cuts as u64, "{text}");
    }
    // Each change that is shorter by a second saves a second.
    let changes = body["rects"][0]["planned"]["changes"].as_f64().unwrap();
    let time = |of: &serde_json::Value| of["planned"]["time"].as_f64().unwrap();
    let prices = body["rects"][0]["prices"].as_array().unwrap();
    let shorter = prices
        .iter()
        .find(|price| price["change"].as_str().unwrap().contains("1 s shorter"))
        .unwrap();
    let saved = time(&body["rects"][0]) - time(shorter);
    assert!((saved - changes).abs() < 1e-6, "{saved} {changes}");
}
