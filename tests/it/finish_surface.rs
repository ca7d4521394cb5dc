//! `finish disc` on surfaces through all stages and targets: what the programs do to a dome and to a bowl, by points of the disc in
//! space; read back, changed and refused.

use crate::finish::{USUAL, compiled_on, proven, roughed_and_finished};
use crate::pipeline::compile;
use crate::rect::{is_same, machines, mended};
use crate::repository::read;
use crate::shop::folder;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver;
use vcutc::geometry::curve::Point2;
use vcutc::process::verdict::replay;
use vcutc::registry;
use vcutc::simulation::prove::{CutFault, Findings};
use vcutc_backend_api::ir::{Action, Joint, Op, Program};
use vcutc_backend_api::verify::verify;

/// An arch across the tracks, with a fall of 0.67 mm to both ends of them.
const DOME: &str = "z(x, y) = 30 mm - (x - 60 mm)^2 / 400 mm - (y - 50 mm)^2 / 3750 mm";
/// Hollow across the tracks with a radius of 200 mm, and hardly along them.
const BOWL: &str = "z(x, y) = 16 mm + (x - 60 mm)^2 / 400 mm + (y - 50 mm)^2 / 5000 mm";

fn dome(x: f64, y: f64) -> f64 {
    30.0 - (x - 60.0) * (x - 60.0) / 400.0 - (y - 50.0) * (y - 50.0) / 3750.0
}

fn bowl(x: f64, y: f64) -> f64 {
    16.0 + (x - 60.0) * (x - 60.0) / 400.0 + (y - 50.0) * (y - 50.0) / 5000.0
}

fn job(surface: &str, finish: &str) -> String {
    let part =
        format!("job \"shell\"\n\nstock {{ size = (120 mm, 100 mm, 40 mm) }}\n\nsurface {{ {surface} }}");
    roughed_and_finished(&part, 4, finish)
}

/// The disc in a place: the centre of its edge, and two directions square to its axis.
type Disc = [[f64; 3]; 3];

/// The disc along all tracks, at places no farther apart than this along y, as a controller takes it from pose to pose.
fn places(program: &Program, apart: f64) -> Vec<Disc> {
    let mut places = Vec::new();
    for segment in program.segments() {
        let (Action::Follow { .. }, Some(line)) = (segment.op.action, segment.line()) else {
            continue;
        };
        let count = ((line.to.tip.y - line.from.tip.y).abs() / apart).ceil().max(1.0);
        for step in 0..=(count as u32) {
            let frame = line.frame_at(program, f64::from(step) / count).unwrap();
            let matrix = frame.orientation.matrix();
            places.push([
                frame.origin.to_array(),
                matrix.map(|row| row[0]),
                matrix.map(|row| row[1]),
            ]);
        }
    }
    places
}

/// A point of a disc, so far from its centre.
fn point([centre, u, v]: &Disc, radius: f64, turn: f64) -> [f64; 3] {
    let (sine, cosine) = libm::sincos(turn);
    core::array::from_fn(|i| centre[i] + radius * (u[i] * cosine + v[i] * sine))
}

/// The height of a contour over a place; at a step the upper end.
fn contour(corners: &[Point2], x: f64) -> f64 {
    let over = corners.windows(2).filter(|pair| pair[0].x <= x && x <= pair[1].x);
    let heights = over.map(|pair| {
        let long = pair[1].x - pair[0].x;
        let share = if long > 0.0 { (x - pair[0].x) / long } else { 1.0 };
        pair[0].z + share * (pair[1].z - pair[0].z)
    });
    heights.fold(f64::NEG_INFINITY, f64::max)
}

/// A part by its height.
type Height = fn(f64, f64) -> f64;

#[test]
fn points_of_the_disc_neither_enter_the_part_nor_leave_more_than_the_limit() {
    let parts: [(&str, Height); 2] = [(DOME, dome), (BOWL, bowl)];
    for (surface, part) in parts {
        let outcome = proven(&job(surface, USUAL));
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let compiled = outcome.compiled.unwrap();
        let program = compiled.program.verified().program();
        let is_over = |[x, y, _]: [f64; 3]| (0.0..=120.0).contains(&x) && (0.0..=100.0).contains(&y);
        let turns = || (0..180_u32).map(|k| f64::from(k).to_radians() * 2.0);
        let mut deepest = 0.0_f64;
        for disc in places(program, 1.0) {
            for (turn, radius) in turns().flat_map(|turn| [(turn, 25.0), (turn, 12.0)]) {
                let at = point(&disc, radius, turn);
                if is_over(at) {
                    deepest = deepest.max(part(at[0], at[1]) - at[2]);
                }
            }
        }
        // The triangles lie within a hundredth of a millimetre of the part.
        assert!(deepest < 0.03, "{surface}: {deepest}");
        // The lowest point of any edge over each half millimetre of some lines across the tracks.
        let lines = [0.0, 17.0, 50.0, 83.0, 100.0];
        let mut lowest = vec![[f64::INFINITY; 240]; lines.len()];
        for disc in places(program, 0.2) {
            for turn in (0..3600_u32).map(|k| f64::from(k).to_radians() / 10.0) {
                let at = point(&disc, 25.0, turn);
                let line = lines.iter().position(|y| (at[1] - y).abs() < 0.15);
                if let (Some(line), true) = (line, (0.0..120.0).contains(&at[0])) {
                    let slot = &mut lowest[line][(at[0] * 2.0) as usize];
                    *slot = slot.min(at[2] - part(at[0], at[1]));
                }
            }
        }
        let highest = lowest.iter().flatten().copied().fold(0.0, f64::max);
        assert!(highest < 0.1 + 0.03, "{surface}: {highest}");
        let [tracked] = compiled.report.tracked.as_slice() else {
            panic!("{:?}", compiled.report.tracked);
        };
        assert!(
            tracked.left.to_mm() <= 0.1 && tracked.entry.to_mm() <= 0.0203,
            "{tracked:?}"
        );
        assert!(tracked.leads[0].to_deg() > 2.9, "{tracked:?}");
        // The sections of the proof, where they lie on those lines: points of the edge are 0.2 mm apart along y.
        let mut compared = 0;
        for (y, lowest) in lines.into_iter().zip(&lowest) {
            let Some(across) = tracked.across.iter().find(|across| across.y == y) else {
                continue;
            };
            compared += 1;
            for (slot, lowest) in (0..).zip(lowest) {
                let [from, to] = [slot, slot + 1].map(|number| f64::from(number) / 2.0);
                let inside = (0..=20).map(|share| from + (to - from) * f64::from(share) / 20.0);
                let left = inside.map(|x| contour(&across.machined, x) - part(x, y));
                let left = left.fold(f64::INFINITY, f64::min);
                // Points of the edge miss the lowest place by some hundredths of a millimetre.
                let missed = lowest - left;
                assert!(
                    (-0.005..0.03).contains(&missed),
                    "{surface}: {from} {y}: {left} {lowest}"
                );
            }
        }
        assert_eq!((compared, tracked.across.len()), (3, tracked.sections));
        let is_reported = compiled.summary.iter().any(|line| line.contains("finished"));
        assert!(is_reported, "{:?}", compiled.summary);
    }
}

/// [Yang 10] on a bowl of the radius r: the lead is `asin(R / r)`, 7.18 degrees for 25 and 200 mm. A quarter of the limit on the scallop
/// may be left by a smaller one, and half a degree is tried at a time.
#[test]
fn a_bowl_gets_the_lead_that_its_curvature_asks_for() {
    let outcome = proven(&job(BOWL, USUAL).replace("scallop <= 4 mm", "scallop <= 1.6 mm"));
    let compiled = outcome.compiled.unwrap();
    let [tracked] = compiled.report.tracked.as_slice() else {
        panic!("{:?}", compiled.report.tracked);
    };
    for lead in tracked.leads.map(|lead| lead.to_deg()) {
        assert!((6.5..8.5).contains(&lead), "{lead}");
    }
}

#[test]
fn all_targets_write_tracks_on_surfaces_and_read_them_back() {
    for (machine, target) in [("kuka", "krl"), ("abb", "rapid"), ("gantry", "gcode")] {
        let outcome = compiled_on(job(DOME, USUAL), Some(machine));
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let program = outcome
            .compiled
            .as_ref()
            .unwrap()
            .program
            .verified()
            .program()
            .clone();
        let through = program.ops.iter().filter(|op| {
            matches!(
                op.action,
                Action::Follow {
                    joint: Joint::Through,
                    ..
                }
            )
        });
        assert!(through.count() > 100, "{machine}");
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        assert!(is_same(&outcome, backend, &written.files), "{target}");
    }
}

#[test]
fn refusals_offer_what_was_tried() {
    let refused = |text: &str| {
        let outcome = proven(text);
        let [refused] = outcome.diagnostics.as_slice() else {
            panic!("{:?}", outcome.diagnostics);
        };
        refused.clone()
    };
    // The bowl asks for more than 4 degrees.
    let text = job(
        BOWL,
        "limits { scallop <= 0.1 mm, lead <= 4 deg }\n  over_hub = 9 mm",
    )
    .replace(&machines(), "")
    .replace("scallop <= 4 mm", "scallop <= 1.6 mm");
    let lead = refused(&text);
    assert_eq!(lead.code, Code::ScallopOverLimit, "{lead:?}");
    let fix = lead.fixes.first().unwrap();
    let after = proven(&mended(&text, fix));
    assert!(!has_errors(&after.diagnostics), "{:?}", after.diagnostics);
    // Tracks keep no allowance, and come last.
    let kept = refused(&job(DOME, &format!("{USUAL}\n  allowance = 0.05 mm")));
    assert_eq!(kept.code, Code::Misplaced, "{kept:?}");
}

/// The proof takes the poses from the program: one that is lower is found, with its place.
#[test]
fn a_pose_that_is_lower_than_planned_enters_the_part() {
    let outcome = proven(&job(DOME, USUAL));
    let (plan, compiled) = (outcome.plan.unwrap(), outcome.compiled.unwrap());
    let mut program = compiled.program.verified().program().clone();
    assert_eq!(
        replay(&plan, compiled.program.verified()).findings,
        Findings::default()
    );
    let of_cuts = |op: &&Op| matches!(op.action, Action::Follow { .. });
    let last = program.ops.iter().rfind(of_cuts).unwrap().site;
    // All of the last track, so that its way bends no more than before.
    for op in program.ops.iter_mut().filter(|op| op.site == last) {
        if let Action::Follow { to, .. } | Action::Approach { to, .. } = &mut op.action {
            to.z -= 0.03;
        }
    }
    let found = replay(&plan, &verify(program).unwrap()).findings.overcut.unwrap();
    assert!(
        matches!(found.fault, CutFault::Overcut { depth, .. } if depth.to_mm() > 0.02),
        "{found:?}"
    );
    assert!(found.y.is_some_and(|y| (-30.0..130.0).contains(&y)), "{found:?}");
}

/// Where the part is hollow along the track, the heel of the disc goes down while its front goes up, and a small lead would lead it
/// through its own face.
/// A larger one is then chosen; where none is allowed, the place is named.
#[test]
fn a_disc_never_goes_down_through_its_own_face() {
    let shell = read("examples/shell.vcut");
    let wave = "3 mm * sin((y - 20 mm) / 240 mm * 360 deg)";
    let wave = shell.replace("(y - 80 mm)^2 / 4000 mm", wave);
    assert_ne!(wave, shell);
    let outcome = compile("wave.vcut", &folder().with("wave.vcut", wave.clone()));
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);

    let low = wave.replace("lead <= 12 deg", "lead <= 6 deg");
    let outcome = compile("wave.vcut", &folder().with("wave.vcut", low));
    let [found] = &outcome.diagnostics[..] else {
        panic!("{:?}", outcome.diagnostics);
    };
    assert_eq!(found.code, Code::BladesTooSmall);
    // Where the wave is hollow.
    let (_, y) = found.message.split_once("mm, y ").unwrap();
    let y: f64 = y.split_once(" mm").unwrap().0.parse().unwrap();
    assert!((20.0..=140.0).contains(&y), "{}", found.message);
    assert!(
        found.message.contains("go down through its own face"),
        "{}",
        found.message
    );
}
