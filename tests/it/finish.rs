//! `finish disc` through all stages and targets: what the programs leave, by points of the disc in space; read back; and refused.

use crate::pipeline::Files;
use crate::rect::{is_same, machines, mended};
use crate::repository::root;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::geometry::curve::Point2;
use vcutc::registry;
use vcutc::simulation::cross_section::Taken;
use vcutc::simulation::prove::watched;
use vcutc_backend_api::ir::{Action, Program};

const CAP: &str = "z(x) = 30 mm - (x - 60 mm)^2 / 300 mm";
/// Hollow with a radius of 150 mm.
const TROUGH: &str = "z(x) = 16 mm + (x - 60 mm)^2 / 300 mm";

/// A job that roughs its part by straight cuts up to that scallop and finishes it with a disc, on the machines of [`machines`].
pub(crate) fn roughed_and_finished(part: &str, scallop: u32, finish: &str) -> String {
    format!(
        "{part}\n\n\
         blade dagger {{ cutting_length = 30 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n\
         blade wheel = disc {{\n  radius = 25 mm, thickness = 1 mm, depth = 10 mm, width = 50 mm, spin = 3000 rev/min\n  \
         body (1 mm, 8 mm) (60 mm, 25 mm)\n}}\n\n\
         rough vcut {{\n  blade = dagger\n  rake = 60 deg\n  limits {{ swing <= 50 deg, scallop <= {scallop} mm }}\n  \
         allowance = 0.3 mm\n  residual = lift\n  feed {{ cut = 150 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  \
         clearance = 10 mm\n}}\n\n\
         finish disc {{\n  blade = wheel\n  {finish}\n  feed {{ cut = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  \
         clearance = 10 mm\n}}\n\n{}",
        machines()
    )
}

fn job(profile: &str, finish: &str) -> String {
    let part =
        format!("job \"cap\"\n\nstock {{ size = (120 mm, 200 mm, 40 mm) }}\n\nprofile {{ {profile} }}");
    roughed_and_finished(&part, 6, finish)
}

pub(crate) const USUAL: &str = "limits { scallop <= 0.1 mm, lead <= 12 deg }\n  over_hub = 9 mm";

fn compiled(text: String, machine: &str) -> Outcome {
    compiled_on(text, Some(machine))
}

/// As [`compiled`], as far as a job without a machine is.
pub(crate) fn proven(text: &str) -> Outcome {
    compiled_on(text.replace(&machines(), ""), None)
}

pub(crate) fn compiled_on(text: String, machine: Option<&str>) -> Outcome {
    let files = Files::of(root().join("examples")).with("part.vcut", text);
    let request = Request {
        path: "part.vcut",
        loader: &files,
        overrides: &[],
        machine,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: registry::OPERATIONS,
        targets: &registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}

/// Points of the disc's edge on all its ways through the work, over x and z.
fn edge(program: &Program, radius: f64) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for op in &program.ops {
        let Action::Follow { to, orientation, .. } = op.action else {
            continue;
        };
        let held = program.orientation(orientation).unwrap().matrix();
        for i in 0..2000_u32 {
            let (sine, cosine) = libm::sincos(f64::from(i) / 2000.0 * core::f64::consts::TAU);
            let off = |row: usize| radius * (held[row][0] * cosine + held[row][1] * sine);
            points.push((to.x + off(0), to.z + off(2)));
        }
    }
    points
}

#[test]
fn no_point_of_the_disc_enters_the_part_and_all_of_it_is_covered() {
    for (profile, sense) in [(CAP, -1.0), (TROUGH, 1.0)] {
        let part = |x: f64| {
            let off = (x - 60.0) * (x - 60.0) / 300.0;
            if sense < 0.0 { 30.0 - off } else { 16.0 + off }
        };
        let outcome = compiled(job(profile, USUAL), "kuka");
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let compiled = outcome.compiled.unwrap();
        let points = edge(compiled.program.verified().program(), 25.0);
        // The polyline of the part is within a hundredth of a millimetre of it.
        for &(x, z) in points.iter().filter(|(x, _)| (0.0..=120.0).contains(x)) {
            assert!(z >= part(x) - 0.011, "{profile}: {z} at x {x}");
        }
        // The lowest point of any edge over each half millimetre is at most the scallop above the part.
        let mut lowest = [f64::INFINITY; 240];
        for (x, z) in points {
            let place = (x * 2.0).floor();
            if (0.0..240.0).contains(&place) {
                let above = z - part(x);
                let lowest = &mut lowest[place as usize];
                *lowest = lowest.min(above);
            }
        }
        let highest = lowest.iter().copied().fold(0.0, f64::max);
        assert!(highest < 0.125, "{profile}: {highest}");
        // A replay without faults, as for pictures, gives the same surface.
        let (_, left) = watched(compiled.program.verified(), &[], &mut |_, _, _| {});
        for corner in left.corners() {
            assert!(corner.z <= part(corner.x) + 0.125, "{corner:?}");
        }
        assert!(compiled.report.scallop.height.to_mm() <= 0.1);
    }
}

#[test]
fn all_targets_write_tracks_and_read_them_back() {
    for (machine, target) in [("kuka", "krl"), ("abb", "rapid"), ("gantry", "gcode")] {
        let outcome = compiled(job(CAP, USUAL), machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        assert!(is_same(&outcome, backend, &written.files), "{target}");
        // One digit of the last place at which the tip goes through the work.
        let mut files = written.files.clone();
        let file = files
            .iter_mut()
            .find(|file| file.text.contains("21.003"))
            .unwrap();
        file.text = file.text.replacen("21.003", "20.003", 1);
        assert!(!is_same(&outcome, backend, &files), "{target}");
    }
}

fn codes(finish: &str) -> Vec<Code> {
    let outcome = proven(&job(CAP, finish));
    outcome.diagnostics.iter().map(|one| one.code).collect()
}

/// Compiles a job that is refused with a code and one change, and compiles it with that change.
fn assert_mended(text: &str, code: Code, change: &str) {
    let text = text.replace(&machines(), "");
    let outcome = proven(&text);
    let [refused] = outcome.diagnostics.as_slice() else {
        panic!("{change}: {:?}", outcome.diagnostics);
    };
    assert_eq!(refused.code, code, "{change}");
    assert!(
        refused.fixes.iter().any(|fix| fix.title.contains(change)),
        "{change}: {refused:?}"
    );
    let [fix] = refused.fixes.as_slice() else {
        panic!("{change}: {refused:?}");
    };
    let outcome = proven(&mended(&text, fix));
    assert!(
        !has_errors(&outcome.diagnostics),
        "{change}: {:?}",
        outcome.diagnostics
    );
}

#[test]
fn what_does_not_go_is_refused_with_what_does() {
    // Strips run over the hub, which has to let them pass.
    let at_hub = job(CAP, "limits { scallop <= 0.1 mm }");
    assert_mended(&at_hub, Code::BladesTooSmall, "`scallop <= ");
    // Roughing that states its sizes is not changed.
    let coarse = at_hub.replace(
        "limits { swing <= 50 deg, scallop <= 6 mm }",
        "swing = 50 deg, layer = 6 mm, step = 10 mm",
    );
    assert_mended(&coarse, Code::BladesTooSmall, "over_hub = ");
    // A side tilt that is given carries no strip past the hub.
    let upright = finely_roughed("side = 0 deg, limits { scallop <= 0.1 mm }");
    assert_mended(&upright, Code::BladesTooSmall, "`side = auto`");
    let little = finely_roughed("side = 1 deg, limits { scallop <= 0.1 mm }");
    assert_mended(&little, Code::BladesTooSmall, "`side = auto`");
    // Tracks go the other way.
    let uphill = finely_roughed("sequence = descending, limits { scallop <= 0.1 mm }");
    assert_mended(&uphill, Code::BladesTooSmall, "`sequence = auto`");
    // Grooves end too high for so little lead.
    let high = job(
        CAP,
        "lead = 3 deg, limits { scallop <= 0.1 mm }\n  over_hub = 9 mm",
    )
    .replace("allowance = 0.3 mm", "allowance = 2 mm");
    assert_mended(&high, Code::ChipNotFreed, "`lead = auto`");
    // With more lead they are refused all the same: roughing has to come nearer.
    let higher = job(
        CAP,
        "limits { scallop <= 0.1 mm, lead <= 4 deg }\n  over_hub = 9 mm",
    )
    .replace("allowance = 0.3 mm", "allowance = 2 mm");
    assert_mended(&higher, Code::ChipNotFreed, "`allowance = ");
    // Tracks too far apart for the limit.
    let apart = job(
        CAP,
        "step = 30 mm, limits { scallop <= 0.1 mm }\n  over_hub = 9 mm",
    );
    assert_mended(&apart, Code::ScallopOverLimit, "`step = auto`");
    // A hollow with a radius of 150 mm asks for 9.59 deg [Yang 10]: with less, the disc stands on its sides.
    let hollow = job(
        TROUGH,
        "limits { scallop <= 0.1 mm, lead <= 5 deg }\n  over_hub = 9 mm",
    );
    assert_mended(&hollow, Code::ChipNotFreed, "`lead <= ");
    for (finish, code) in [
        (
            "limits { scallop <= 0.1 mm, lead <= 2 deg }",
            Code::LimitsConflict,
        ),
        ("lead = 0 deg, limits { scallop <= 0.1 mm }", Code::OutOfRange),
        ("side = 31 deg, limits { scallop <= 0.1 mm }", Code::OutOfRange),
        ("over_hub = 9 mm", Code::MissingField),
        (
            "allowance = 0.2 mm, limits { scallop <= 0.2 mm }",
            Code::LimitsConflict,
        ),
    ] {
        assert_eq!(codes(finish), [code]);
    }
}

/// A job whose roughing ends its grooves so near to the part that a rim with side tilt comes out in them.
fn finely_roughed(finish: &str) -> String {
    job(CAP, finish).replace("scallop <= 6 mm", "scallop <= 2 mm")
}

/// Without `over_hub` every strip passes the hub: what comes free lies beside it, by points along the program's own ways.
#[test]
fn strips_pass_the_hub_of_a_disc_that_leans_to_the_side() {
    let outcome = compiled(finely_roughed("limits { scallop <= 0.1 mm }"), "kuka");
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let compiled = outcome.compiled.unwrap();
    let program = compiled.program.verified().program();
    let part = |x: f64| 30.0 - (x - 60.0) * (x - 60.0) / 300.0;
    let points = edge(program, 25.0);
    for &(x, z) in points.iter().filter(|(x, _)| (0.0..=120.0).contains(x)) {
        assert!(z >= part(x) - 0.011, "{z} at x {x}");
    }
    let mut chips = Vec::new();
    let mut op_before = None;
    let (last, _) = watched(compiled.program.verified(), &[], &mut |op, _, taken| {
        if let Some(before) = op_before.replace(op) {
            chips.push((before, taken));
        }
    });
    chips.extend(op_before.map(|op| (op, last)));
    let mut strips = 0;
    for (op, taken) in chips {
        let Action::Follow { to, orientation, .. } = program.ops[op.0 as usize].action else {
            continue;
        };
        // The axis leans to +x of the normal: tracks go that way.
        let axis = program.orientation(orientation).unwrap().matrix();
        let [aside, up] = [-axis[0][2], -axis[2][2]];
        for chip in taken {
            let Taken::Chip(chip) = chip else { continue };
            strips += 1;
            for place in 0..=200_u32 {
                let share = f64::from(place) / 200.0;
                let (first, last) = (chip.floor[0], chip.floor[chip.floor.len() - 1]);
                let x = first.x + (last.x - first.x) * share;
                let thick = height(&chip.top, x) - height(&chip.floor, x);
                // How far it is from the axis, seen along the feed, at the height of the rim.
                let off = (x - to.x) * up - (height(&chip.floor, x) - to.z) * aside;
                assert!(
                    off.abs() > 8.0 || thick < 1.0,
                    "{thick} mm at x {x} of op {}",
                    op.0
                );
            }
        }
    }
    assert!(strips >= 15, "{strips}");
}

/// The height of a polyline over x.
fn height(line: &[Point2], x: f64) -> f64 {
    let next = line.partition_point(|point| point.x < x).clamp(1, line.len() - 1);
    let (from, to) = (line[next - 1], line[next]);
    if to.x > from.x {
        from.z + (to.z - from.z) * ((x - from.x) / (to.x - from.x)).clamp(0.0, 1.0)
    } else {
        from.z.max(to.z)
    }
}

#[test]
fn tracks_keep_to_a_direction() {
    for (direction, forwards, backwards) in [("forward", 13, 0), ("backward", 0, 13), ("alternate", 7, 6)] {
        let outcome = compiled(job(CAP, &format!("{USUAL}\n  direction = {direction}")), "kuka");
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let compiled = outcome.compiled.unwrap();
        let program = compiled.program.verified().program();
        let ways = program.ops.iter().filter_map(|op| match op.action {
            Action::Follow { to, .. } => Some(to.y > 100.0),
            _ => None,
        });
        let (there, back): (Vec<bool>, Vec<bool>) = ways.partition(|there| *there);
        assert_eq!((there.len(), back.len()), (forwards, backwards), "{direction}");
    }
}

/// The disc that has just freed strips leans farther for finishing: where it was left it has no room to turn, so it goes up first.
#[test]
fn a_disc_that_stays_in_hand_turns_above_the_stock() {
    let text = "job \"m\"
        stock { size = (60 mm, 100 mm, 50 mm) }
        profile { start (0 mm, 29 mm) line to (60 mm, 28 mm) }
        blade dagger { cutting_length = 12.543 mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }
        blade wheel = disc { radius = 25 mm, thickness = 1 mm, depth = 11 mm, width = 40 mm, spin = 3000 rev/min
            body (1 mm, 8 mm) (60 mm, 25 mm) }
        rough rect { blade = dagger, disc = wheel, rake = 60 deg, allowance = 0.3 mm, limits { scallop <= 5 mm }, layer = 9 mm
            feed { cut = 10 m/min, free = 6 m/min, travel = 500 mm/s, reorient = 60 deg/s }, clearance = 10 mm }
        finish disc { blade = wheel, limits { scallop <= 0.3 mm, lead <= 25 deg }, over_hub = 0 mm
            feed { cut = 100 mm/s, travel = 300 mm/s, reorient = 60 deg/s }, clearance = 10 mm }";
    let outcome = proven(text);
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
}

/// Strips and then tracks, with what roughing and finishing state.
fn strips_then_tracks(rough: &str, finish: &str) -> String {
    format!(
        "job \"m\"
        stock {{ size = (120 mm, 300 mm, 40 mm) }}
        profile {{ z(x) = 30 mm - (x - 60 mm)^2 / 400 mm }}
        blade dagger {{ cutting_length = 40 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}
        blade wheel = disc {{ radius = 25 mm, thickness = 1.2 mm, depth = 12 mm, width = 30 mm, spin = 3000 rev/min
            body (1.2 mm, 8 mm) (60 mm, 25 mm) }}
        rough rect {{ blade = dagger, disc = wheel, rake = 60 deg, {rough}
            feed {{ cut = 10 m/min, free = 6 m/min, travel = 500 mm/s, reorient = 60 deg/s }}, clearance = 10 mm }}
        finish disc {{ blade = wheel, {finish}
            feed {{ cut = 100 mm/s, travel = 300 mm/s, reorient = 60 deg/s }}, clearance = 10 mm }}"
    )
}

#[test]
fn changes_of_roughing_and_lead_are_offered_together() {
    // Vs that end higher than more lead makes up for, and whose strips pass the hub only with more lead than they get.
    let both = job(CAP, "limits { scallop <= 0.1 mm }").replace(
        "limits { swing <= 50 deg, scallop <= 6 mm }",
        "swing = 50 deg, layer = 4 mm, step = 7 mm",
    );
    assert_mended(&both, Code::BladesTooSmall, "mm`, and allow `lead <= 20 deg`");
    let alone = strips_then_tracks(
        "layer = 6 mm, step = 12 mm, allowance = 0.3 mm, residual = discard",
        "limits { scallop <= 0.1 mm, lead <= 12 deg }",
    );
    assert_mended(
        &alone,
        Code::BladesTooSmall,
        "leave less on the part: `residual = lift`",
    );
}

/// Without a limit of its own, roughing leaves no more than the disc of the finishing takes off; a limit that the job states stands.
#[test]
fn roughing_leaves_what_the_disc_takes_off() {
    let left = |rough: &str, depth: &str| {
        let text = strips_then_tracks(
            rough,
            "limits { scallop <= 0.1 mm, lead <= 12 deg }, over_hub = 20 mm",
        )
        .replace("depth = 12 mm", &format!("depth = {depth} mm"));
        let outcome = proven(&text);
        let plan = outcome
            .plan
            .unwrap_or_else(|| panic!("{depth}: {:?}", outcome.diagnostics));
        let rect: &dyn core::any::Any = &*plan.operations[0];
        rect.downcast_ref::<vcutc::rect::Planned>()
            .unwrap()
            .plan
            .left
            .to_mm()
    };
    assert!(left("layer = 4 mm", "6") <= 6.0);
    assert!(left("layer = 4 mm", "9") <= 9.0);
    assert!(left("layer = 4 mm, limits { scallop <= 3 mm }", "9") <= 3.0);
}
