//! How a crusher gets down into pockets: round a helix, and into holes. From the lines of finished programs, by samples, which know
//! neither circles nor polygons of the planner.

use crate::pipeline::{Files, compile};
use crate::seen_from_above::{Spot, distance, to_segment};
use core::f64::consts::PI;
use proptest::prelude::*;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::process::verdict::replay;
use vcutc::simulation::prove::{ClearingFault, CutFault};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Program, Site};
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::{Rule, verify};

const HEIGHT: f64 = 30.0;
const FLOOR: f64 = 8.0;
const RAMP: f64 = 5.0;

/// A region whose nearest wall is known at each place.
#[derive(Clone, Copy, Debug)]
enum Seat {
    Round { radius: f64 },
    Square { wide: f64, deep: f64 },
}

const MIDDLE: Spot = [90.0, 60.0];

impl Seat {
    fn text(self) -> String {
        let [x, y] = MIDDLE;
        match self {
            Self::Round { radius } => format!("circle ({x} mm, {y} mm) radius {radius} mm"),
            Self::Square { wide, deep } => {
                let [(left, right), (low, high)] =
                    [(x, wide), (y, deep)].map(|(at, size)| (at - size / 2.0, at + size / 2.0));
                format!(
                    "start ({left} mm, {low} mm) line to ({right} mm, {low} mm) line to ({right} mm, {high} mm) \
                     line to ({left} mm, {high} mm)"
                )
            }
        }
    }

    fn to_wall(self, at: Spot) -> f64 {
        match self {
            Self::Round { radius } => radius - distance(at, MIDDLE),
            Self::Square { wide, deep } => {
                (wide / 2.0 - (at[0] - MIDDLE[0]).abs()).min(deep / 2.0 - (at[1] - MIDDLE[1]).abs())
            }
        }
    }
}

fn job(seat: Seat, radius: f64, more: &str) -> String {
    format!(
        "job \"seat\"
stock {{ size = (180 mm, 120 mm, {HEIGHT} mm) }}
blade hog = crusher {{ radius = {radius} mm, height = 12 mm, spin = 18000 rev/min, ramp = {RAMP} deg }}
region seat {{ {} }}
clear pocket {{
  region = seat
  blade = hog
  floor = {FLOOR} mm
  {more}
  feed {{ cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
",
        seat.text()
    )
}

fn compiled(text: &str) -> Outcome {
    compile("job.vcut", &Files::default().with("job.vcut", text.to_owned()))
}

fn program_of(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

/// The lines of a layer's first chain, arcs left out: ways down have none.
fn lines(program: &Program, wanted: u32) -> Vec<[Point3; 2]> {
    let of_chain = program.segments().filter_map(|segment| {
        let (Site::Cut { layer, cut, .. }, Action::Follow { via: None, .. }) =
            (segment.op.site, segment.op.action)
        else {
            return None;
        };
        let line = segment.line()?;
        (layer.get() == wanted && cut.get() == 1).then_some([line.from.tip, line.to.tip])
    });
    of_chain.collect()
}

/// Places along a line, at most so far apart.
fn along([from, to]: [Point3; 2], apart: f64) -> impl Iterator<Item = Point3> {
    let count = (from.distance(to).to_mm() / apart).ceil().max(1.0) as u32;
    (0..=count).map(move |k| {
        let t = f64::from(k) / f64::from(count);
        let at = |a: f64, b: f64| a + (b - a) * t;
        Point3::new(at(from.x, to.x), at(from.y, to.y), at(from.z, to.z))
    })
}

/// What a way down round a helix does.
struct Seen {
    /// How wide it is, from its middle.
    radius: f64,
    /// Of the ground under the tool where it has got down, what the rim never passed, in mm2.
    pressed: f64,
    /// What stands in the middle, not passed by the tool at all, in mm2.
    post: f64,
}

/// The helix of a layer: the lines that go down, and those at the floor up to where the tool has been round once.
fn helix(seat: Seat, lines: &[[Point3; 2]], floor: f64, radius: f64) -> Result<Seen, TestCaseError> {
    let slopes: Vec<[Point3; 2]> = lines
        .iter()
        .copied()
        .filter(|[a, b]| b.z < a.z && (a.x, a.y) != (b.x, b.y))
        .collect();
    prop_assert!(!slopes.is_empty());
    for [from, to] in &slopes {
        let steep = (from.z - to.z) / distance([from.x, from.y], [to.x, to.y]);
        prop_assert!(steep <= RAMP.to_radians().tan(), "{steep}");
    }
    let last = slopes.last().unwrap()[1];
    prop_assert!((last.z - floor).abs() < 1e-3);
    let level = lines.iter().skip_while(|line| line[1] != last).skip(1);
    let mut round: Vec<[Point3; 2]> = Vec::new();
    for line in level {
        round.push(*line);
        if line[1] == last {
            break;
        }
    }
    prop_assert_eq!(
        round.last().map(|line| line[1]),
        Some(last),
        "once round at the floor"
    );
    let ways: Vec<Point3> = slopes
        .iter()
        .chain(&round)
        .flat_map(|line| along(*line, 0.05))
        .collect();
    for at in &ways {
        let to_wall = seat.to_wall([at.x, at.y]);
        prop_assert!(to_wall >= radius - 1e-6, "{at:?} is {to_wall} mm from a wall");
    }
    let level: Vec<Spot> = round
        .iter()
        .flat_map(|line| along(*line, 0.05))
        .map(|at| [at.x, at.y])
        .collect();
    let count = round.len() as f64;
    let middle = round.iter().fold([0.0, 0.0], |sum, line| {
        [sum[0] + line[0].x / count, sum[1] + line[0].y / count]
    });
    let wide = round
        .iter()
        .map(|line| distance([line[0].x, line[0].y], middle))
        .fold(0.0, f64::max);
    let pitch = 0.1;
    let (mut pressed, mut post) = (0.0, 0.0);
    let across = (wide / pitch).ceil() as i32 + (radius / pitch).ceil() as i32;
    for (column, row) in (-across..=across).flat_map(|x| (-across..=across).map(move |y| (x, y))) {
        let at = [
            middle[0] + f64::from(column) * pitch,
            middle[1] + f64::from(row) * pitch,
        ];
        let away = level.iter().map(|centre| distance(*centre, at));
        let (near, far) = away.fold((f64::INFINITY, 0.0_f64), |(near, far), away| {
            (near.min(away), far.max(away))
        });
        // The way is connected: the rim passes a place if it is now nearer than the radius, now farther.
        if far < radius - 0.02 {
            pressed += pitch * pitch;
        }
        if near > radius + 0.02 && distance(at, middle) < wide {
            post += pitch * pitch;
        }
    }
    Ok(Seen {
        radius: wide,
        pressed,
        post,
    })
}

fn seats() -> impl Strategy<Value = (Seat, f64)> {
    let round = |value: f64| (value * 1e3).round() / 1e3;
    let round_seat = (2.0..7.0_f64, 1.6..6.0_f64).prop_map(move |(radius, share)| {
        let radius = round(radius);
        let seat = Seat::Round {
            radius: round(radius * share),
        };
        (seat, radius)
    });
    let square = (2.0..7.0_f64, 3.2..8.0_f64, 3.2..8.0_f64).prop_map(move |(radius, wide, deep)| {
        let radius = round(radius);
        let seat = Seat::Square {
            wide: round(radius * wide),
            deep: round(radius * deep),
        };
        (seat, radius)
    });
    prop_oneof![round_seat, square]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Of the ground under the tool the rim passes all but a disc as wide as the circle lacks to the tool, and no post stays.
    #[test]
    fn a_helix_keeps_off_walls_and_leaves_no_post((seat, radius) in seats()) {
        let outcome = compiled(&job(seat, radius, "entry = helix"));
        prop_assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics.first());
        for (layer, floor) in [(1, 19.0), (2, FLOOR)] {
            let seen = helix(seat, &lines(program_of(&outcome), layer), floor, radius)?;
            prop_assert!(seen.radius <= radius + 0.002 && seen.radius >= radius / 2.0 - 0.002, "{}", seen.radius);
            prop_assert_eq!(seen.post, 0.0);
            let lacks = radius - seen.radius;
            // A polygon of at least six corners: its disc has room up to their sides.
            prop_assert!(seen.pressed <= PI * (lacks + 0.1).powi(2), "{} mm2, {lacks} mm", seen.pressed);
        }
    }
}

/// Where a line as long as the tool is wide and a circle of its radius have room, it is the faster of both; where only the line has, a ramp;
/// where neither has, a helix leaves less under the tool.
#[test]
fn the_faster_way_down_is_taken_of_those_that_leave_nothing() {
    let entry = |seat: Seat, more: &str| {
        let outcome = compiled(&job(seat, 6.0, more));
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let lines = lines(program_of(&outcome), 1);
        let slopes: Vec<[Point3; 2]> = lines
            .into_iter()
            .filter(|[a, b]| b.z < a.z && (a.x, a.y) != (b.x, b.y))
            .collect();
        // Of a ramp every second end is the same.
        let is_ramp = slopes
            .windows(2)
            .all(|pair| to_segment([pair[1][1].x, pair[1][1].y], pair[0].map(|at| [at.x, at.y])) < 1e-9);
        if is_ramp { "ramp" } else { "helix" }
    };
    for pattern in ["offset", "zigzag", "sfs"] {
        let pattern = format!("pattern = {pattern}");
        let wide = Seat::Round { radius: 20.0 };
        let time = |way: &str| {
            let outcome = compiled(&job(wide, 6.0, &format!("{pattern}\n  entry = {way}")));
            outcome.plan.unwrap().operations[0].estimate().time.to_s()
        };
        let [ramp, helix, auto] = ["ramp", "helix", "auto"].map(time);
        assert!((auto - ramp.min(helix)).abs() < 1e-9, "{auto} {ramp} {helix}");
        let faster = if helix < ramp { "helix" } else { "ramp" };
        assert_eq!(entry(wide, &pattern), faster);
        assert_eq!(
            entry(
                Seat::Square {
                    wide: 90.0,
                    deep: 13.0
                },
                &pattern
            ),
            "ramp"
        );
        assert_eq!(entry(Seat::Round { radius: 10.0 }, &pattern), "helix");
    }
    // Too narrow for a circle of half the radius: what little room there is makes a line.
    assert_eq!(entry(Seat::Round { radius: 8.0 }, ""), "ramp");
    assert_eq!(entry(Seat::Round { radius: 10.0 }, "entry = ramp"), "ramp");
}

const TRAY: Seat = Seat::Square {
    wide: 80.0,
    deep: 60.0,
};

/// Straight down in the hole, and from there along the floor.
#[test]
fn a_tool_goes_straight_down_into_a_hole() {
    for (more, slack) in [
        ("opening = hole(x = 70 mm, y = 50 mm, radius = 6 mm)", 0.0),
        (
            "opening = hole(x = 70 mm, y = 50 mm, radius = 9 mm), entry = open",
            3.0,
        ),
        (
            "opening = hole(x = 70 mm, y = 50 mm, radius = 9 mm), pattern = zigzag",
            3.0,
        ),
    ] {
        let outcome = compiled(&job(TRAY, 6.0, more));
        assert!(
            !has_errors(&outcome.diagnostics),
            "{more}: {:?}",
            outcome.diagnostics
        );
        for layer in [1, 2] {
            let lines = lines(program_of(&outcome), layer);
            let falls: Vec<&[Point3; 2]> = lines.iter().filter(|[a, b]| b.z < a.z).collect();
            assert_eq!(falls.len(), 1, "{more}");
            let [from, to] = *falls[0];
            assert!(from.x == to.x && from.y == to.y && from.z == HEIGHT);
            assert!(
                distance([to.x, to.y], [70.0, 50.0]) <= slack + 1e-6,
                "{more}: {to:?}"
            );
        }
    }
}

/// A program whose hole is narrower than its tool breaks a rule; one with a hole that the job does not name is not proven.
#[test]
fn holes_are_as_the_job_has_them() {
    let outcome = compiled(&job(
        TRAY,
        6.0,
        "opening = hole(x = 70 mm, y = 50 mm, radius = 6 mm)",
    ));
    let changed = |change: &dyn Fn(&mut Program)| {
        let mut program = program_of(&outcome).clone();
        change(&mut program);
        verify(program)
    };
    let rules = |change: &dyn Fn(&mut Program)| -> Vec<Rule> {
        let faults = changed(change).err().unwrap_or_default();
        faults.into_iter().map(|fault| fault.rule).collect()
    };
    assert!(changed(&|_| {}).is_ok());
    let narrower = rules(&|program| program.operations[0].openings[0].radius = Length::mm(5.999));
    assert_eq!(narrower, [Rule::ChainPosture, Rule::ChainPosture]);
    let beside = rules(&|program| program.operations[0].openings[0].ground.x += 0.01);
    assert_eq!(beside, [Rule::ChainPosture, Rule::ChainPosture]);
    let above = rules(&|program| program.operations[0].openings[0].ground.z += 1.0);
    assert_eq!(above, [Rule::ChainPosture]);
    assert!(
        rules(&|program| program.operations[0].openings[0].radius = Length::mm(f64::NAN))
            .contains(&Rule::Number)
    );
    let wider = changed(&|program| program.operations[0].openings[0].radius = Length::mm(6.5)).unwrap();
    let findings = replay(outcome.plan.as_ref().unwrap(), &wider).findings;
    let faults: Vec<CutFault> = findings.iter().map(|(_, finding)| finding.fault).collect();
    assert_eq!(faults, [CutFault::Clearing(ClearingFault::Unopened)]);
}

/// A round pocket of half the tool's radius more than it has room for a helix; by a little less it has none.
#[test]
fn a_helix_needs_half_the_radius_of_its_tool() {
    for (radius, code) in [(9.02, None), (8.99, Some(Code::NoEntry))] {
        let outcome = compiled(&job(Seat::Round { radius }, 6.0, "entry = helix"));
        assert_eq!(
            outcome.diagnostics.first().map(|found| found.code),
            code,
            "{radius}"
        );
    }
}
