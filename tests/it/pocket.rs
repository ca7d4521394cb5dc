//! Pockets: what their programs clear, by samples of the tool in the plan, which know neither offsets nor boxes; programs that were
//! changed; and the fixes that messages offer.

use crate::pipeline::{Files, compile};
use crate::seen_from_above::{Boundary, Spot, along_circle, distance, to_segment, ways};
use proptest::prelude::*;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::process::verdict::replay;
use vcutc::simulation::prove::{ClearingFault, CutFault, Findings};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Joint, Program, Site};
use vcutc_backend_api::verify::verify;

const HEIGHT: f64 = 30.0;
const FLOOR: f64 = 8.0;

/// A region with straight walls, of which one may be open, and a round island.
#[derive(Clone, Debug)]
struct Region {
    corners: Vec<[f64; 2]>,
    /// The side that begins at this corner lies along x = 120 and is open.
    open: Option<usize>,
    /// Its centre and its radius.
    island: Option<([f64; 2], f64)>,
}

/// The tool, and how it goes.
#[derive(Clone, Copy, Debug)]
struct Asked {
    radius: f64,
    step: f64,
    allowance: f64,
    pattern: &'static str,
}

impl Region {
    fn text(&self) -> String {
        let mut text = String::from("region seat {\n");
        let count = self.corners.len();
        for (number, [x, y]) in self.corners.iter().enumerate() {
            let word = match number {
                0 => "start",
                _ if self.open == Some(number - 1) => "open to",
                _ => "line to",
            };
            text += &format!("  {word} ({x} mm, {y} mm)\n");
        }
        if self.open == Some(count - 1) {
            let [x, y] = self.corners[0];
            text += &format!("  open to ({x} mm, {y} mm)\n");
        }
        if let Some(([x, y], radius)) = self.island {
            text += &format!("  island {{ circle ({x} mm, {y} mm) radius {radius} mm }}\n");
        }
        text + "}\n"
    }

    fn sides(&self) -> impl Iterator<Item = (usize, [[f64; 2]; 2])> {
        let count = self.corners.len();
        (0..count).map(move |side| (side, [self.corners[side], self.corners[(side + 1) % count]]))
    }

    /// Its sides, the island as chords.
    fn boundary(&self) -> Boundary {
        let (open, walls): (Vec<_>, Vec<_>) = self.sides().partition(|(side, _)| self.open == Some(*side));
        let of = |sides: Vec<(usize, [Spot; 2])>| sides.into_iter().map(|(_, side)| side).collect();
        let mut walls: Vec<[Spot; 2]> = of(walls);
        if let Some((centre, radius)) = self.island {
            let around = along_circle(centre, radius, 0.0, core::f64::consts::TAU);
            walls.extend(around.windows(2).map(|ends| [ends[0], ends[1]]));
        }
        Boundary::of(walls, of(open))
    }

    /// How far a place is from the nearest wall.
    fn to_wall(&self, at: [f64; 2]) -> f64 {
        let walls = self.sides().filter(|(side, _)| self.open != Some(*side));
        let nearest = walls
            .map(|(_, side)| to_segment(at, side))
            .fold(f64::INFINITY, f64::min);
        match self.island {
            Some((centre, radius)) => nearest.min((distance(at, centre) - radius).abs()),
            None => nearest,
        }
    }

    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let crossings = self.sides().filter(|(_, [a, b])| {
            (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        });
        let is_in_island = self
            .island
            .is_some_and(|(centre, radius)| distance([x, y], centre) < radius);
        crossings.count() % 2 == 1 && !is_in_island
    }
}

fn job(region: &str, asked: Asked, more: &str) -> String {
    let Asked {
        radius,
        step,
        allowance,
        pattern,
    } = asked;
    format!(
        "job \"seat\"
stock {{ size = (120 mm, 90 mm, {HEIGHT} mm) }}
blade hog = crusher {{ radius = {radius} mm, height = 12 mm, spin = 18000 rev/min, ramp = 5 deg }}
{region}
clear pocket {{
  region = seat
  blade = hog
  floor = {FLOOR} mm
  pattern = {pattern}
  step = {step} mm
  allowance = {allowance} mm
  {more}
  feed {{ cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
"
    )
}

fn compiled(text: &str) -> Outcome {
    compile("job.vcut", &Files::default().with("job.vcut", text.to_owned()))
}

fn program_of(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

/// Samples of the tool's ways: none comes too near to a wall, none goes below the floor, each layer clears what the tool reaches.
fn clears(region: &Region, asked: Asked) -> Result<(), TestCaseError> {
    let outcome = compiled(&job(&region.text(), asked, ""));
    prop_assert!(
        !has_errors(&outcome.diagnostics),
        "{:?}\n{}",
        outcome.diagnostics.first(),
        job(&region.text(), asked, "")
    );
    let ways = ways(program_of(&outcome));
    let keep = asked.radius + asked.allowance;
    for (_, at) in &ways {
        prop_assert!(at.z >= FLOOR - 1e-9);
        let to_wall = region.to_wall([at.x, at.y]);
        prop_assert!(to_wall >= keep - 1e-6, "{at:?} is {to_wall} mm from a wall");
    }
    let layers = ways.iter().map(|(layer, _)| *layer).max().unwrap();
    prop_assert_eq!(layers, 2);
    let boundary = region.boundary();
    for layer in 1..=layers {
        let floor = HEIGHT - (HEIGHT - FLOOR) * f64::from(layer) / 2.0;
        let flat = ways
            .iter()
            .filter(|(of, at)| *of == layer && (at.z - floor).abs() < 1e-3);
        let uncut = boundary.uncut(asked.radius, keep, flat.map(|(_, at)| [at.x, at.y]));
        // Without a limit of the job 1 mm2 may stay.
        prop_assert!(uncut <= 1.0, "{uncut} mm2 of layer {layer} stay");
    }
    Ok(())
}

fn regions() -> impl Strategy<Value = Region> {
    let corners = (
        10.0..25.0,
        10.0..25.0,
        85.0..105.0,
        60.0..80.0,
        0.0..1.0_f64,
        30.0..60.0,
    );
    (
        corners,
        prop::bool::ANY,
        prop::option::of((40.0..80.0, 30.0..50.0, 3.0..9.0)),
    )
        .prop_map(|((left, low, right, high, notch, middle), is_open, island)| {
            let round = |value: f64| (value * 1e3).round() / 1e3;
            let right = if is_open { 120.0 } else { right };
            let inner = high - notch * 20.0;
            let corners = [
                [left, low],
                [right, low],
                [right, high],
                [middle + 20.0, high],
                [middle, inner],
                [left, high - 3.0],
            ];
            let outline = Region {
                corners: corners.map(|at| at.map(round)).to_vec(),
                open: is_open.then_some(1),
                island: None,
            };
            let island = island.map(|(x, y, radius)| ([round(x), round(y)], round(radius)));
            let fits = |(centre, radius): &([f64; 2], f64)| {
                outline.contains(*centre) && outline.to_wall(*centre) > radius + 0.1
            };
            Region {
                island: island.filter(fits),
                ..outline
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn what_a_tool_reaches_is_cleared_and_walls_stand(
        region in regions(),
        radius in 3.0..7.0_f64,
        share in 0.5..1.0_f64,
        allowance in prop::sample::select(vec![0.0, 0.4]),
        pattern in prop::sample::select(vec!["offset", "sfs", "zigzag", "auto"]),
    ) {
        let round = |value: f64| (value * 1e3).floor() / 1e3;
        let (radius, step) = (round(radius), round(radius * share));
        clears(&region, Asked { radius, step, allowance, pattern })?;
    }
}

fn plain() -> Region {
    Region {
        corners: vec![[15.0, 15.0], [105.0, 15.0], [105.0, 70.0], [15.0, 70.0]],
        open: None,
        island: Some(([60.0, 40.0], 8.0)),
    }
}

const ASKED: Asked = Asked {
    radius: 6.0,
    step: 5.0,
    allowance: 0.0,
    pattern: "offset",
};

fn findings_of(outcome: &Outcome, change: impl Fn(&mut Program)) -> Findings {
    let mut program = program_of(outcome).clone();
    change(&mut program);
    let verified = verify(program).expect("only the proof has something against it");
    replay(outcome.plan.as_ref().unwrap(), &verified).findings
}

fn faults(findings: &Findings) -> Vec<ClearingFault> {
    let faults = findings.iter().filter_map(|(_, finding)| match finding.fault {
        CutFault::Clearing(fault) => Some(fault),
        _ => None,
    });
    faults.collect()
}

/// Changes the end of every piece, and every place on an arc. All pieces end in a stop then, so that no joint has to be smooth.
fn moved(program: &mut Program, change: impl Fn(Point3) -> Point3) {
    for op in &mut program.ops {
        if let Action::Follow { joint, .. } = &mut op.action {
            *joint = Joint::Stop;
        }
        match &mut op.action {
            Action::Follow { to, .. } | Action::Approach { to, .. } | Action::Travel { to, .. } => {
                *to = change(*to)
            }
            Action::Retract { to, .. } | Action::AxisTravel { to, .. } => *to = change(*to),
            _ => {}
        }
    }
    for via in &mut program.vias {
        *via = change(*via);
    }
}

#[test]
fn a_program_moved_by_micrometres_enters_a_wall() {
    let outcome = compiled(&job(&plain().text(), ASKED, ""));
    assert_eq!(faults(&findings_of(&outcome, |_| {})), []);
    // Passes keep 2 um more than they must, and 5 um for what a control cuts off at joints.
    let by = |micrometres: f64| {
        let found = findings_of(&outcome, |program| {
            moved(program, |at| Point3::new(at.x + micrometres * 1e-3, at.y, at.z));
        });
        faults(&found)
    };
    assert_eq!(by(1.0), []);
    let found = by(4.0);
    assert!(
        matches!(found.as_slice(), [ClearingFault::Wall { by }] if (by.to_mm() - 0.002).abs() < 1e-3),
        "{found:?}"
    );
}

#[test]
fn a_program_lowered_goes_below_the_floor() {
    let outcome = compiled(&job(&plain().text(), ASKED, "entry = ramp"));
    let found = findings_of(&outcome, |program| {
        moved(program, |at| {
            let z = if at.z < HEIGHT - 1.0 { at.z - 0.01 } else { at.z };
            Point3::new(at.x, at.y, z)
        });
    });
    let is_floor = |fault: &ClearingFault| matches!(fault, ClearingFault::Floor { .. });
    assert!(faults(&found).iter().any(is_floor), "{found:?}");
}

#[test]
fn a_program_that_leaves_out_a_way_leaves_core() {
    let outcome = compiled(&job(&plain().text(), ASKED, ""));
    // A corner of the pass next to the walls, at the floor, is cut off.
    let is_corner = |at: Point3| at.x < 22.0 && at.y < 22.0;
    let found = findings_of(&outcome, |program| {
        moved(program, |at| {
            if is_corner(at) && at.z < HEIGHT {
                Point3::new(at.x + 9.0, at.y + 9.0, at.z)
            } else {
                at
            }
        });
    });
    let is_uncut = |fault: &ClearingFault| matches!(fault, ClearingFault::Uncut { .. });
    assert!(faults(&found).iter().any(is_uncut), "{:?}", faults(&found));
}

/// A program without its last layer, or without any, leaves the ground above the floor.
#[test]
fn a_program_that_leaves_out_layers_leaves_core() {
    let outcome = compiled(&job(&plain().text(), ASKED, ""));
    for from in [1, 2] {
        let found = findings_of(&outcome, |program| {
            program
                .ops
                .retain(|op| !matches!(op.site, Site::Cut { layer, .. } if layer.get() >= from));
        });
        let region = 90.0 * 55.0 - core::f64::consts::PI * 64.0;
        assert!(
            matches!(faults(&found).as_slice(), [ClearingFault::Uncut { area, .. }] if (area.to_mm2() - region).abs() < 1e-6),
            "from layer {from} on: {:?}",
            faults(&found)
        );
    }
}

/// The first diagnostic, and the job with its first fix applied.
fn fixed(text: &str) -> (Code, Option<String>) {
    let outcome = compiled(text);
    let found = outcome.diagnostics.first().expect("a fault");
    let fixed = found.fixes.first().map(|fix| {
        let mut text = text.to_owned();
        let mut edits = fix.edits.clone();
        edits.sort_by_key(|edit| core::cmp::Reverse(edit.span.start));
        for edit in edits {
            text.replace_range(
                edit.span.start as usize..edit.span.end as usize,
                &edit.replacement,
            );
        }
        text
    });
    (found.code, fixed)
}

#[test]
fn the_step_that_is_offered_leaves_nothing() {
    let asked = Asked { step: 11.5, ..ASKED };
    let (code, fixed) = fixed(&job(&plain().text(), asked, "limits { uncut <= 0.5 mm2 }"));
    assert_eq!(code, Code::PocketUncut);
    let outcome = compiled(&fixed.expect("a step that was tried"));
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
}

#[test]
fn the_tool_is_slow_where_much_of_its_rim_cuts() {
    let asked = Asked { step: 4.8, ..ASKED };
    let free = compiled(&job(&plain().text(), asked, ""));
    let limited = compiled(&job(&plain().text(), asked, "limits { engagement <= 110 deg }"));
    let engagement = |outcome: &Outcome| {
        let compiled = outcome.compiled.as_ref().unwrap();
        compiled.report.cleared[0].engagement.to_deg()
    };
    assert!(engagement(&free) > 150.0);
    assert!(engagement(&limited) <= 110.0);
    let time = |outcome: &Outcome| outcome.compiled.as_ref().unwrap().report.times.all.total().to_s();
    assert!(time(&limited) > time(&free));
}

/// Inside out, passes 0.8 radii apart have acos(1 - 0.8) of the rim in the material on straight ways.
#[test]
fn engagement_is_what_geometry_says() {
    let square = Region {
        corners: vec![[10.0, 10.0], [110.0, 10.0], [110.0, 80.0], [10.0, 80.0]],
        open: None,
        island: None,
    };
    let outcome = compiled(&job(&square.text(), Asked { step: 4.8, ..ASKED }, ""));
    let cleared = outcome.compiled.as_ref().unwrap().report.cleared[0];
    // At square corners pi - 2 phi more, which is a right angle.
    let expected = (1.0_f64 - 0.8).acos().to_degrees() + 90.0;
    assert!(
        (cleared.engagement.to_deg() - expected).abs() < 1.0,
        "{cleared:?}"
    );
    assert!(cleared.uncut.to_mm2() < 1e-3);
    // Four corners of 90 degrees: (4 - pi) r2, with the radius and what passes keep from walls.
    let beyond = (4.0 - core::f64::consts::PI) * 36.0;
    assert!(
        (cleared.beyond_reach.to_mm2() - beyond).abs() < 0.5,
        "{cleared:?}"
    );
}

#[test]
fn the_same_job_gives_the_same_program() {
    let text = job(
        &plain().text(),
        Asked {
            pattern: "auto",
            ..ASKED
        },
        "",
    );
    assert_eq!(program_of(&compiled(&text)), program_of(&compiled(&text)));
}

#[test]
fn a_wide_body_meets_the_walls_beside_it() {
    let text = job(&plain().text(), ASKED, "").replace("ramp = 5 deg", "ramp = 5 deg, body (12 mm, 9 mm)");
    let outcome = compiled(&text);
    let codes: Vec<Code> = outcome.diagnostics.iter().map(|found| found.code).collect();
    assert_eq!(codes, [Code::BodyInWork]);
    // The allowance that the help names is enough.
    let clear = text.replace("allowance = 0 mm", "allowance = 3 mm");
    assert!(!has_errors(&compiled(&clear).diagnostics));
}

fn on_a_wide_stock(region: &str, more: &str) -> Outcome {
    let text = job(&format!("region seat {{ {region} }}"), ASKED, more);
    compiled(
        &text
            .replace("(120 mm, 90 mm", "(180 mm, 140 mm")
            .replace("pattern = offset", ""),
    )
}

const RECTANGLE: &str =
    "start (20 mm, 20 mm) line to (140 mm, 20 mm) line to (140 mm, 65 mm) line to (20 mm, 65 mm)";

#[test]
fn islands_lie_within_the_outline_and_apart() {
    for islands in [
        format!("island {{ {RECTANGLE} }}"),
        "island { circle (160 mm, 100 mm) radius 8 mm }".to_owned(),
        "island { circle (60 mm, 42 mm) radius 15 mm } island { circle (60 mm, 42 mm) radius 8 mm }"
            .to_owned(),
    ] {
        let outcome = on_a_wide_stock(&format!("{RECTANGLE} {islands}"), "");
        let codes: Vec<Code> = outcome.diagnostics.iter().map(|found| found.code).collect();
        assert_eq!(codes, [Code::RegionTangled], "{islands}");
    }
}

/// Several open sides at corners of the stock, and all of them.
#[test]
fn any_sides_may_be_open() {
    let island = "island { circle (80 mm, 60 mm) radius 15 mm }";
    for region in [
        "start (20 mm, 0 mm) open to (180 mm, 0 mm) open to (180 mm, 140 mm) open to (20 mm, 140 mm) line to (20 mm, 0 mm)",
        "start (20 mm, 0 mm) open to (140 mm, 0 mm) line to (140 mm, 100 mm) line to (20 mm, 100 mm)",
        "start (20 mm, 20 mm) line to (180 mm, 20 mm) open to (180 mm, 100 mm) line to (20 mm, 100 mm)",
        "start (0 mm, 0 mm) open to (180 mm, 0 mm) open to (180 mm, 140 mm) open to (0 mm, 140 mm) open to (0 mm, 0 mm)",
    ] {
        for (island, pattern) in [("", "auto"), (island, "auto"), ("", "zigzag"), (island, "zigzag")] {
            let outcome = on_a_wide_stock(&format!("{region} {island}"), &format!("pattern = {pattern}"));
            assert!(
                !has_errors(&outcome.diagnostics),
                "{region} {island} {pattern}: {:?}",
                outcome.diagnostics
            );
        }
    }
}

/// A program whose tool cuts into the stock from beside it, past the end of an open side, is refused.
#[test]
fn a_way_beside_the_stock_must_not_cut_into_it() {
    let region = "start (20 mm, 0 mm) open to (100 mm, 0 mm) line to (100 mm, 60 mm) line to (20 mm, 60 mm)";
    let outcome = on_a_wide_stock(region, "pattern = zigzag");
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let found = findings_of(&outcome, |program| {
        // Ways beside the stock go along its side, nearer to it than the tool is wide.
        for op in &mut program.ops {
            if let Action::Follow { to, joint, .. } = &mut op.action {
                *joint = Joint::Stop;
                if to.y < -6.0 && to.z < HEIGHT {
                    *to = Point3::new(to.x + 60.0, to.y + 5.0, to.z);
                }
            }
        }
    });
    assert!(!faults(&found).is_empty());
}

#[test]
fn a_pocket_hardly_wider_than_its_tool_is_refused_or_cut() {
    for (radius, expected) in [
        ("6 mm", Some(Code::PocketTooNarrow)),
        ("6.01 mm", Some(Code::PocketTooNarrow)),
        ("6.1 mm", Some(Code::PocketTooNarrow)),
        ("7 mm", None),
    ] {
        let outcome = on_a_wide_stock(&format!("circle (50 mm, 50 mm) radius {radius}"), "");
        let code = outcome.diagnostics.first().map(|found| found.code);
        assert_eq!(code, expected, "{radius}");
    }
}
