//! What the forces of discs and crushers ask of an arm: against an oracle that places each bit of a rim and each bit of a tooth in space,
//! and knows the kinematics of the arm alone.

use crate::forces::{JOB, STATED, arm, compiled, moved};
use crate::pipeline::{Files, all_diagnostics, compile, rendered};
use crate::repository::root;
use core::f64::consts::{PI, TAU};
use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::collections::BTreeMap;
use vcutc::diagnostics::{Code, Severity};
use vcutc::driver::Outcome;
use vcutc::driver::dynamics::{cut_by_cut, in_places};
use vcutc::dynamics::arms::Arms;
use vcutc::dynamics::blade::EngagedPart;
use vcutc::dynamics::cuts::Face;
use vcutc::dynamics::drives::Drives;
use vcutc::dynamics::figures::{Cutting, LookedAt};
use vcutc::machine::kinematics::Joints;
use vcutc::motion::rig::Rig;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::trajectory::Spacing;
use vcutc::picture::Prefix;
use vcutc_backend_api::ir::{Action, OpId, ToolId};

const RADIUS: f64 = 6.0;
const TEETH: u32 = 3;
/// As tan(helix) / radius.
const LAG: f64 = 0.577_350_269_189_625_8 / RADIUS;
/// 100 mm/s at 6000 rev/min with three teeth.
const CHIP: f64 = 100.0 / (100.0 * 3.0);
const CUTTING: [f64; 3] = [20.0, 8.0, 6.0];
const EDGE: [f64; 3] = [0.4, 0.5, 0.1];
const SPREAD: f64 = 0.2;
const STIFFNESS: [f64; 6] = [2.2e6, 3.4e6, 2.8e6, 2.4e6, 2.2e6, 0.47e6];

const OF_TEETH: &str = "forces { teeth = 3, helix = 30 deg, \
    cutting = pressure(tangential = 20 N/mm2, radial = 8 N/mm2, axial = 6 N/mm2), \
    edge = force(tangential = 0.4 N/mm, radial = 0.5 N/mm, axial = 0.1 N/mm), spread = 20 %, \
    measured { chip = 0.35 mm, spin = 6000 rev/min }, source = \"this test\" }";

const OF_THE_RIM: &str = "forces { drag = 1.2 N/mm, axial = 0.7 N/mm, radial = 0.4 N/mm, spread = 20 %, \
    measured { feed = 100 mm/s, spin = 3000 rev/min }, source = \"this test\" }";
const RIM: [f64; 3] = [1.2, 0.7, 0.4];
const DISC: f64 = 25.0;

/// How a blade is held, and what hangs on the flange with it.
const HELD: &str = "frame = frame(x = 20 mm, y = -10 mm, z = 310 mm, a = 0 deg, b = 30 deg, c = 0 deg), \
    load = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)";

/// The arm of `tests/it/forces.rs`, which carries blades that spin.
fn cell(tools: &str) -> String {
    format!(
        "machine cell = robot \"arm.toml\" {{\n  {tools}\n  \
         base = frame(x = 1700 mm, y = -30 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)\n  \
         home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)\n  \
         ultrasonic = output(12)\n  spindle = output(13)\n}}\n"
    )
}

fn files(text: String) -> Files {
    Files::default().with(JOB, text).with("arm.toml", arm())
}

/// A pocket with a round end, in two layers.
fn pocket(forces: &str, limits: &str) -> Files {
    files(pocket_text(forces, limits))
}

fn pocket_text(forces: &str, limits: &str) -> String {
    format!(
        "job \"pocket\"\nstock {{ size = (120 mm, 90 mm, 30 mm) }}\n\
         blade hog = crusher {{ radius = 6 mm, height = 24 mm, spin = 6000 rev/min, ramp = 5 deg, {forces} }}\n\
         region seat {{ start (20 mm, 20 mm) line to (80 mm, 20 mm) arc to (80 mm, 70 mm) radius 25 mm line to (20 mm, 70 mm) }}\n\
         clear pocket {{ region = seat, blade = hog, floor = 8 mm, layer = 12 mm, step = 4 mm, pattern = offset, {limits}\n  \
         feed {{ cut = 100 mm/s, plunge = 30 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}, clearance = 10 mm }}\n{}",
        cell(&HELD.replacen("frame =", "tool =", 1))
    )
}

/// A part that is roughed and finished.
fn strips(forces: &str) -> Files {
    files(format!(
        "job \"cap\"\nstock {{ size = (120 mm, 200 mm, 40 mm) }}\nprofile {{ z(x) = 30 mm - (x - 60 mm)^2 / 300 mm }}\n\
         blade wheel = disc {{ radius = 25 mm, thickness = 1 mm, depth = 20 mm, width = 40 mm, spin = 3000 rev/min, \
         body (1 mm, 8 mm) (60 mm, 25 mm), {forces} }}\n\
         blade dagger {{ cutting_length = 30 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double, {} }}\n\
         rough vcut {{ blade = dagger, rake = 60 deg, limits {{ swing <= 50 deg, scallop <= 6 mm }}, allowance = 0.3 mm, residual = lift\n  \
         feed {{ cut = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}, clearance = 10 mm }}\n\
         finish disc {{ blade = wheel, limits {{ scallop <= 0.1 mm, lead <= 12 deg }}, over_hub = 9 mm\n  \
         feed {{ cut = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}, clearance = 10 mm }}\n{}",
        STATED,
        cell(&format!(
            "tool dagger {{ {HELD} }} tool wheel {{ {HELD} }} \
             change {{ at = joints(60 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg), time = 10 s, by = hand }}"
        ))
    ))
}

/// A place at which a blade cuts.
#[derive(Clone, Copy, Debug)]
struct Place {
    op: OpId,
    tool: ToolId,
    joints: Joints,
    /// Which way its tip goes, and where its shank is.
    way: DVec3,
    up: DVec3,
    /// What the axes need without forces, in Nm.
    without: [f64; 6],
}

impl Place {
    /// Of a way along the axis, any side.
    fn left(&self) -> DVec3 {
        let left = self.up.cross(self.way);
        left.try_normalize()
            .unwrap_or_else(|| self.up.any_orthonormal_vector())
    }
}

/// The arm of a program with each of its blades.
fn rigs(outcome: &Outcome) -> Rigs<'_> {
    let machine = outcome.job.as_ref().unwrap().machine.as_ref().unwrap();
    let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
    let program = reached.program.program();
    Rigs::of(&machine.model, program.cell.as_ref().unwrap(), program)
}

/// The places of a program at which a round blade cuts.
fn places(outcome: &Outcome) -> Vec<Place> {
    let machine = outcome.job.as_ref().unwrap().machine.as_ref().unwrap();
    let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
    let program = reached.program.program();
    let cell = program.cell.as_ref().unwrap();
    let rigs = rigs(outcome);
    let arms = Arms::of(&machine.model, cell).unwrap();
    let spacing = Spacing {
        way: 9.0,
        ..Spacing::CLOSE
    };
    let mut found = Vec::new();
    let Ok(()) = Drives::of(&rigs, &arms, program).along(&reached.program, &spacing, |sample, torques| {
        let segment = program.segment(sample.op).unwrap();
        if let Action::Follow { .. } = segment.op.action {
            let line = segment.line().unwrap();
            let at = |done: f64| {
                let tip = line.frame_at(program, done.clamp(0.0, 1.0)).unwrap().origin;
                DVec3::new(tip.x, tip.y, tip.z)
            };
            let way = (at(sample.done + 1e-4) - at(sample.done - 1e-4)).normalize();
            let tool = segment.before.tool;
            let blade = rigs.with(tool).blade_in_work(&sample.joints);
            found.push(Place {
                op: sample.op,
                tool,
                joints: sample.joints,
                way,
                up: -blade.rotation.z_axis,
                without: core::array::from_fn(|axis| torques.of(axis)),
            });
        }
        Ok::<(), core::convert::Infallible>(())
    });
    found
}

/// A force somewhere on a blade, in the work, in N and mm from its tip.
#[derive(Clone, Copy, Debug)]
struct Bit {
    place: DVec3,
    force: DVec3,
}

/// What these push each axis with, in Nmm.
fn pushed(rig: &Rig<'_>, place: &Place, bits: &[Bit]) -> [f64; 6] {
    let blade = rig.blade_in_work(&place.joints);
    // A place of the blade moves as its tip does and turns with the blade: both are linear in it.
    let axes = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    core::array::from_fn(|axis| {
        let [tip, x, y, z] =
            axes.map(|off| moved(rig, &place.joints, blade.rotation.transpose() * off, axis));
        let of = |off: DVec3| tip + (x - tip) * off.x + (y - tip) * off.y + (z - tip) * off.z;
        bits.iter().map(|bit| of(bit.place).dot(bit.force)).sum()
    })
}

/// How teeth are in the material: the tool turned so far, between which angles, up to which share of the layer, with such chips, and
/// with the material on one side or the other.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    angle: f64,
    engaged: [f64; 2],
    deep: f64,
    thin: f64,
    side: f64,
    spread: f64,
}

/// The teeth as bits.
fn teeth(place: &Place, depth: f64, drawn: Drawn) -> Vec<Bit> {
    let slices = 60;
    let height = depth * drawn.deep / f64::from(slices);
    let left = place.left() * drawn.side;
    // Along its axis a tooth does not advance into the material.
    let chip = CHIP * drawn.thin * place.up.cross(place.way).length();
    let ahead = left.cross(place.up) * drawn.side;
    let mut bits = Vec::new();
    for tooth in 0..TEETH {
        for slice in 0..slices {
            let up = (f64::from(slice) + 0.5) * height;
            let turned = drawn.angle + f64::from(tooth) * TAU / f64::from(TEETH) - LAG * up;
            let turned = turned.rem_euclid(TAU);
            if turned < drawn.engaged[0] || turned > drawn.engaged[1] {
                continue;
            }
            let (sine, cosine) = libm::sincos(turned);
            let outward = ahead * sine + left * cosine;
            let motion = ahead * cosine - left * sine;
            let [tangential, radial, axial] = [0, 1, 2].map(|part| {
                (CUTTING[part] * chip * sine + EDGE[part]) * height * (1.0 + SPREAD * drawn.spread)
            });
            bits.push(Bit {
                place: outward * RADIUS + place.up * up,
                force: -motion * tangential - outward * radial + place.up * axial * drawn.side,
            });
        }
    }
    bits
}

fn any_drawn() -> impl Strategy<Value = Drawn> {
    (
        0.0..TAU,
        prop::array::uniform2(0.0..=PI),
        prop_oneof![Just(1.0), 0.0..=1.0_f64],
        prop_oneof![Just(1.0), 0.0..=1.0_f64],
        any::<bool>(),
        prop_oneof![Just(1.0), -1.0..=1.0_f64],
    )
        .prop_map(|(angle, [from, to], deep, thin, is_left, spread)| Drawn {
            angle,
            engaged: [from.min(to), from.max(to)],
            deep,
            thin,
            side: if is_left { 1.0 } else { -1.0 },
            spread,
        })
}

/// What teeth in the material do in a place: the torques that axes then need, in Nm, and how far the tool is pushed to its left, in mm, so
/// far up the layer.
fn done(rig: &Rig<'_>, place: &Place, bits: &[Bit], springs: [f64; 6], up: f64) -> ([f64; 6], f64) {
    let pushed = pushed(rig, place, bits);
    let blade = rig.blade_in_work(&place.joints);
    let at = blade.rotation.transpose() * (place.up * up);
    let each = (0..6).map(|axis| {
        let spring = 1000.0 * STIFFNESS[axis] * (1.0 + 0.1 * springs[axis]);
        moved(rig, &place.joints, at, axis).dot(place.left()) * pushed[axis] / spring
    });
    // The drives hold against what pushes.
    let needed = core::array::from_fn(|axis| place.without[axis] - pushed[axis] / 1000.0);
    (needed, each.sum())
}

fn depth(outcome: &Outcome, op: OpId) -> f64 {
    let edges = &outcome.compiled.as_ref().unwrap().report.edges;
    edges.iter().find(|used| used.op == op).unwrap().length.to_mm()
}

#[test]
fn no_tooth_asks_for_more_torque_or_pushes_a_wall_farther_off_than_the_figures() {
    all_teeth_are_within_the_figures(&compiled(&pocket(OF_TEETH, "")));
}

/// Ways down along which a tooth hardly advances into the material, but the tool goes fast.
#[test]
fn no_tooth_on_a_steep_way_down_asks_for_more() {
    let steep = pocket_text(OF_TEETH, "").replace("ramp = 5 deg", "ramp = 60 deg");
    let fast = steep.replace("plunge = 30 mm/s", "plunge = 100 mm/s");
    all_teeth_are_within_the_figures(&compiled(&files(fast)));
}

fn all_teeth_are_within_the_figures(outcome: &Outcome) {
    let compiled = outcome.compiled.as_ref().unwrap();
    let torques = compiled.dynamics.torques.as_ref().unwrap();
    assert_eq!(
        (torques.looked_at, torques.cutting),
        (LookedAt::Everywhere, Cutting::Counted)
    );
    let figures = compiled.dynamics.deviation.as_ref().unwrap();
    let [of] = figures.operations.as_slice() else {
        panic!("one operation")
    };
    assert_eq!(of.into_part.most, of.into_waste.most);
    assert!(of.at_entry.is_none());
    let rigs = rigs(outcome);
    let places = places(outcome);
    assert!(places.len() > 80);
    let mut runner = TestRunner::new(Config {
        cases: 600,
        ..Config::default()
    });
    let springs = prop::array::uniform6(-1.0..=1.0_f64);
    let drawn = (any_drawn(), any::<prop::sample::Index>(), springs, 0.0..=1.0_f64);
    runner
        .run(&drawn, |(drawn, at, springs, up)| {
            let place = places[at.index(places.len())];
            let depth = depth(outcome, place.op);
            prop_assert!(depth <= 12.0 + 1e-9, "{depth}");
            let bits = teeth(&place, depth, drawn);
            let (needed, off) = done(rigs.with(place.tool), &place, &bits, springs, up * depth);
            for (needed, axis) in needed.iter().zip(&torques.axes) {
                prop_assert!(needed.abs() <= axis.most + 1e-6, "{needed} {axis:?}");
            }
            prop_assert!(off.abs() <= of.into_part.most + 1e-7, "{off} {of:?}");
            Ok(())
        })
        .unwrap();
}

/// A moment as pairs of forces.
fn pairs(moment: DVec3) -> Vec<Bit> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let pair = |axis: usize| {
        let (place, force) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3] * moment[axis]);
        let opposite = Bit {
            place: DVec3::ZERO,
            force: -force,
        };
        [Bit { place, force }, opposite]
    };
    (0..3).flat_map(pair).collect()
}

/// In places the force, its moment about the tip and what the axes need are the means over a turn of teeth in space.
#[test]
fn forces_and_moments_in_places_are_the_means_of_teeth_in_space() {
    let outcome = compiled(&pocket(OF_TEETH, ""));
    let compiled = outcome.compiled.as_ref().unwrap();
    let reached = compiled.program.reached().unwrap();
    let rigs = rigs(&outcome);
    let oracle: BTreeMap<(u32, u64), Place> = places(&outcome)
        .into_iter()
        .map(|place| ((place.op.0, place.joints[0].to_bits()), place))
        .collect();
    let (mut seen, mut largest) = (0, 0.0_f64);
    let spacing = Spacing {
        way: 9.0,
        ..Spacing::CLOSE
    };
    in_places(outcome.job.as_ref().unwrap(), reached, &compiled.report, |all| {
        all.along(&spacing, |there| {
            let key = (there.sample.op.0, there.sample.joints[0].to_bits());
            let (Some(found), Some(place)) = (there.pushed, oracle.get(&key)) else {
                return Ok(());
            };
            assert_eq!(found.part, EngagedPart::Teeth);
            if place.way.z.abs() > 1e-9 {
                return Ok(()); // Down, where the chips of a tooth are not those of a level way.
            }
            let program = reached.program.program();
            let Some(Action::Follow { feed, .. }) = program.op(place.op).map(|op| op.action) else {
                return Ok(());
            };
            let thin = program.feed(feed).unwrap().to_mm_per_s() / 100.0;
            let depth = found.engaged.to_mm();
            let turns = 180;
            let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
            for turn in 0..turns {
                let drawn = Drawn {
                    angle: (f64::from(turn) + 0.5) * TAU / f64::from(turns),
                    engaged: [0.0, PI],
                    deep: 1.0,
                    thin,
                    side: 1.0,
                    spread: 0.0,
                };
                for bit in teeth(place, depth, drawn) {
                    force += bit.force / f64::from(turns);
                    moment += bit.place.cross(bit.force) / f64::from(turns);
                }
            }
            let about = found.moment.unwrap() * 1000.0;
            assert!(
                (found.force - force).length() <= 0.02 * force.length(),
                "{force} {found:?}"
            );
            assert!(
                (about - moment).length() <= 0.02 * moment.length(),
                "{moment} {found:?}"
            );
            let mut bits = pairs(about);
            bits.push(Bit {
                place: DVec3::ZERO,
                force: found.force,
            });
            let axes = pushed(rigs.with(place.tool), place, &bits);
            for (torque, of) in found.torques.iter().zip(axes) {
                assert!((torque + of / 1000.0).abs() < 1e-6, "{torque} {of}");
            }
            (seen, largest) = (seen + 1, largest.max(about.dot(place.up)));
            Ok::<(), core::convert::Infallible>(())
        })
    })
    .unwrap()
    .unwrap();
    assert!(seen > 40, "{seen}");
    // Against the turning of the tool.
    assert!(largest > 100.0, "{largest}");
    let moment = compiled.dynamics.deviation.as_ref().unwrap().force.moment;
    assert!(moment * 1000.0 > largest, "{moment} {largest}");
}

/// In the worst place, with soft springs, the whole layer and the thickest chips: by whatever half of the front.
#[test]
fn the_figures_of_teeth_are_nearly_reached() {
    let outcome = compiled(&pocket(OF_TEETH, ""));
    let figures = outcome
        .compiled
        .as_ref()
        .unwrap()
        .dynamics
        .deviation
        .as_ref()
        .unwrap();
    let most = figures.operations[0].into_part.most;
    let worst = OpId(figures.operations[0].into_part.at.op);
    let rigs = rigs(&outcome);
    let mut farthest = 0.0_f64;
    for place in places(&outcome).into_iter().filter(|place| place.op == worst) {
        let depth = depth(&outcome, worst);
        for turn in 0..24 {
            let angle = f64::from(turn) * TAU / 24.0;
            for (engaged, side) in [
                ([0.0, PI], 1.0),
                ([PI / 3.0, PI], 1.0),
                ([0.0, PI], -1.0),
                ([PI / 3.0, PI], -1.0),
            ] {
                let drawn = Drawn {
                    angle,
                    engaged,
                    deep: 1.0,
                    thin: 1.0,
                    side,
                    spread: 1.0,
                };
                let bits = teeth(&place, depth, drawn);
                for up in [0.0, depth] {
                    let (_, off) = done(rigs.with(place.tool), &place, &bits, [-1.0; 6], up);
                    farthest = farthest.max(off.abs());
                }
            }
        }
    }
    assert!(farthest > 0.6 * most, "{farthest} {most}");
}

/// Bits of the rim, on an arc of it.
fn rim(place: &Place, from: f64, arc: f64, parts: [f64; 3]) -> Vec<Bit> {
    let slices = 40;
    let left = place.left();
    let [drag, axial, radial] = [0, 1, 2].map(|part| RIM[part] * (1.0 + SPREAD * parts[part]));
    (0..slices)
        .map(|slice| {
            let turned = from + arc * (f64::from(slice) + 0.5) / f64::from(slices);
            let (sine, cosine) = libm::sincos(turned);
            let length = DISC * arc / f64::from(slices);
            Bit {
                place: (place.way * cosine + left * sine) * DISC,
                force: (-place.way * drag + place.up * axial + left * radial * parts[2].signum()) * length,
            }
        })
        .collect()
}

#[test]
fn no_rim_asks_for_more_torque_than_the_figures() {
    let outcome = compiled(&strips(OF_THE_RIM));
    let compiled = outcome.compiled.as_ref().unwrap();
    let torques = compiled.dynamics.torques.as_ref().unwrap();
    assert_eq!(
        (torques.looked_at, torques.cutting),
        (LookedAt::Everywhere, Cutting::Counted)
    );
    let deviation = compiled.dynamics.deviation.as_ref().unwrap();
    assert_eq!(deviation.operations.len(), 1);
    let rigs = rigs(&outcome);
    let places = places(&outcome);
    assert!(places.len() > 100);
    let mut runner = TestRunner::new(Config {
        cases: 600,
        ..Config::default()
    });
    let drawn = (
        any::<prop::sample::Index>(),
        0.0..TAU,
        0.0..=1.0_f64,
        prop::array::uniform3(-1.0..=1.0_f64),
    );
    runner
        .run(&drawn, |(at, from, share, parts)| {
            let place = places[at.index(places.len())];
            let arc = share * depth(&outcome, place.op) / DISC;
            let pushed = pushed(rigs.with(place.tool), &place, &rim(&place, from, arc, parts));
            for (number, axis) in torques.axes.iter().enumerate() {
                let needed = (place.without[number] - pushed[number] / 1000.0).abs();
                prop_assert!(needed <= axis.most + 1e-6, "{needed} {axis:?}");
            }
            Ok(())
        })
        .unwrap();
    let not_checked = compiled.checks.not_checked().unwrap();
    assert!(
        not_checked
            .contains("how far the forces of the blade push it off (not computed for surfaces under a disc)"),
        "{not_checked}"
    );
}

#[test]
fn a_limit_on_the_deviation_of_walls_is_kept_or_broken() {
    let most = |files: &Files| {
        let outcome = compiled(files);
        let figures = outcome.compiled.unwrap().dynamics.deviation.unwrap();
        figures.operations[0].into_part.most
    };
    let most = most(&pocket(OF_TEETH, ""));
    let found = |limit: f64| {
        let outcome = compile(
            JOB,
            &pocket(OF_TEETH, &format!("limits {{ deviation <= {limit} mm }}")),
        );
        let all = all_diagnostics(&outcome);
        let above = all.iter().find(|diagnostic| {
            matches!(
                diagnostic.code,
                Code::DeviationAboveLimit | Code::DeviationIndicative
            )
        });
        above.map(|_| rendered(&all, &outcome))
    };
    assert_eq!(found(most * 1.001), None);
    let broken = found(most * 0.98).expect("above the limit");
    assert!(broken.contains("the blade yields by up to"), "{broken}");
}

#[test]
fn thinner_layers_lower_chips_and_more_teeth_push_less() {
    let force = |files: &Files| {
        let outcome = compiled(files);
        let figures = outcome.compiled.unwrap().dynamics.deviation.unwrap();
        (figures.force.force, figures.force.engaged)
    };
    let (whole, deep) = force(&pocket(OF_TEETH, ""));
    assert!((deep - 11.0).abs() < 1e-9, "{deep}");
    let (light, _) = force(&pocket(
        &OF_TEETH.replace("tangential = 20", "tangential = 10"),
        "",
    ));
    assert!(light < whole);
    let (certain, _) = force(&pocket(&OF_TEETH.replace("spread = 20 %", "spread = 0 %"), ""));
    assert!((certain * 1.2 - whole).abs() < 1e-6, "{certain} {whole}");
}

#[test]
fn blades_that_cut_otherwise_than_they_were_measured_are_named() {
    let warned = |files: &Files| {
        let outcome = compile(JOB, files);
        let all = all_diagnostics(&outcome);
        assert!(
            all.iter()
                .all(|diagnostic| diagnostic.severity() != Severity::Error),
            "{}",
            rendered(&all, &outcome)
        );
        let round = ["the forces of `hog`", "the forces of `wheel`"];
        let mut warnings = all
            .iter()
            .filter(|diagnostic| diagnostic.code == Code::ForcesElsewhere);
        let elsewhere = warnings.find(|diagnostic| round.iter().any(|of| diagnostic.message.starts_with(of)));
        elsewhere.map(|diagnostic| diagnostic.message.clone())
    };
    assert_eq!(warned(&pocket(OF_TEETH, "")), None);
    // The forces of thinner chips follow from those of thicker ones.
    assert_eq!(
        warned(&pocket(&OF_TEETH.replace("chip = 0.35", "chip = 3"), "")),
        None
    );
    let thin = warned(&pocket(&OF_TEETH.replace("chip = 0.35", "chip = 0.2"), "")).unwrap();
    assert!(
        thin.contains("measured with chips of 0.2 mm at 6000 rev/min") && thin.contains("chips of 0.333 mm"),
        "{thin}"
    );
    let slow = warned(&pocket(&OF_TEETH.replace("spin = 6000", "spin = 3000"), "")).unwrap();
    assert!(slow.contains("3000 rev/min"), "{slow}");
    assert_eq!(warned(&strips(OF_THE_RIM)), None);
    let fast = warned(&strips(&OF_THE_RIM.replace("feed = 100", "feed = 50"))).unwrap();
    assert!(fast.contains("50 mm/s and 3000 rev/min"), "{fast}");
}

/// A pocket has no profile: its ways are not in the picture of the cuts along it.
#[test]
fn the_picture_along_the_profile_has_no_pockets() {
    let example = compile("examples/yielding_arm.vcut", &Files::of(root()));
    let compiled = example.compiled.as_ref().unwrap();
    let mut figures = compiled.dynamics.deviation.clone().unwrap();
    assert_eq!(figures.operations.len(), 2);
    let all = cut_by_cut(example.job.as_ref().unwrap(), compiled, &figures).unwrap();
    figures.operations.truncate(1);
    let flanks = cut_by_cut(example.job.as_ref().unwrap(), compiled, &figures).unwrap();
    assert!(flanks.len() < all.len());
    assert!(flanks.iter().all(|cut| cut.face != Face::Upright));
    let pictures = crate::pictures::picture("deviation-by-forces", &example, Prefix::NONE);
    assert!(!pictures.contains("upright cut"), "{pictures}");
}

/// What later operations rough still stands while the pocket is cut.
#[test]
fn a_pocket_before_the_roughing_has_teeth_as_deep_as_the_stock_stands() {
    let rough = "rough vcut { blade = dagger, rake = 60 deg, limits { swing <= 50 deg, scallop <= 6 mm }, allowance = 0.3 mm, \
        residual = lift, feed { cut = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }, clearance = 10 mm }\n";
    let dagger = "profile { start (0 mm, 12 mm) line to (120 mm, 12 mm) }\n\
        blade dagger { cutting_length = 30 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }\n";
    let tools = format!(
        "tool dagger {{ {HELD} }} tool hog {{ {HELD} }} \
         change {{ at = joints(60 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg), time = 10 s, by = hand }}"
    );
    let held = HELD.replacen("frame =", "tool =", 1);
    let with = |before: &str, after: &str| {
        let text = pocket_text(OF_TEETH, "").replace("blade hog", &format!("{dagger}blade hog"));
        let text = text.replace(&held, &tools);
        let text = text.replace("clear pocket", &format!("{before}clear pocket"));
        let text = text.replace("machine cell", &format!("{after}machine cell"));
        let outcome = compiled(&files(text));
        outcome
            .compiled
            .unwrap()
            .dynamics
            .deviation
            .unwrap()
            .force
            .engaged
    };
    // 22 mm in two layers; roughed before, the pocket is less deep.
    assert!((with("", rough) - 11.0).abs() < 1e-9);
    assert!(with(rough, "") < 10.0);
}
