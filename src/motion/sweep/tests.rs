//! Tests of the sweep check against dense samples of the blade, turned by products of rotations of another package.

use super::*;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use proptest::prelude::*;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::five_axis::{Arrangement, Direction, FiveAxis, Rotary, SpindleSense};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_simulation::surface::{Side, Vee};

/// What turns the blade and the work, outermost first, and the work on its mount.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// A head with B carrying A.
    HeadBa,
    /// A head with C carrying A.
    HeadCa,
    /// A head with A over a table with B.
    HeadATableB,
    /// A table with A carrying C.
    TableAc,
}

fn rotary(about: Direction) -> Rotary {
    Rotary {
        about,
        centre: DVec3::new(3.0, -4.0, 250.0),
    }
}

fn machine(kind: Kind) -> Mechanism {
    use Direction::{MinusX, MinusY, MinusZ, PlusX, PlusY, PlusZ};
    let arrangement = match kind {
        Kind::HeadBa => Arrangement::HeadHead([rotary(PlusY), rotary(PlusX)]),
        Kind::HeadCa => Arrangement::HeadHead([rotary(PlusZ), rotary(PlusX)]),
        Kind::HeadATableB => Arrangement::HeadTable {
            head: rotary(PlusX),
            table: rotary(MinusY),
        },
        Kind::TableAc => Arrangement::TableTable([rotary(MinusX), rotary(MinusZ)]),
    };
    let machine = FiveAxis::new(
        arrangement,
        Some(SpindleSense::PlusZ),
        DVec3::new(4.0, -2.0, 30.0),
        DVec3::new(480.0, 290.0, -10.0),
    );
    Mechanism::FiveAxis(machine.unwrap())
}

/// How far the spindle is from the tip.
const TOOL: f64 = 60.0;

fn rig(mechanism: &Mechanism) -> Rig<'_> {
    Rig {
        mechanism,
        axes: &[],
        flange_in_blade: Pose {
            rotation: DMat3::from_rotation_z(-core::f64::consts::FRAC_PI_2),
            position: DVec3::new(0.0, 0.0, TOOL),
        }
        .inverse(),
        work_in_root: Pose {
            rotation: DMat3::from_rotation_z(0.4),
            position: DVec3::new(40.0, 20.0, 15.0),
        },
    }
}

/// The blade frame in the work by the matrices of its rotations.
fn held(kind: Kind, joints: &Joints) -> Matrix3<f64> {
    let turned = |axis: Vector3<f64>, angle: f64| {
        *Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle).matrix()
    };
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let (first, second) = (joints[3], joints[4]);
    let (table, head) = match kind {
        Kind::HeadBa => (Matrix3::identity(), turned(y, first) * turned(x, second)),
        Kind::HeadCa => (Matrix3::identity(), turned(z, first) * turned(x, second)),
        Kind::HeadATableB => (turned(-y, second), turned(x, first)),
        Kind::TableAc => (turned(-x, first) * turned(-z, second), Matrix3::identity()),
    };
    let nose = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    let tool = turned(z, -core::f64::consts::FRAC_PI_2);
    turned(z, 0.4).transpose() * table.transpose() * head * turned(z, joints[5]) * nose * tool
}

const STOCK: Stock = Stock {
    width: Length::mm(80.0),
    depth: Length::mm(100.0),
    height: Length::mm(40.0),
};

#[derive(Clone, Debug)]
struct Scene {
    kind: Kind,
    axes: [Joints; 2],
    tip: [DVec3; 2],
    outline: Outline,
    vees: Vec<(f64, f64, f64)>,
}

fn a_scene() -> impl Strategy<Value = Scene> {
    let kinds = vec![Kind::HeadBa, Kind::HeadCa, Kind::HeadATableB, Kind::TableAc];
    let turned = || prop::array::uniform3(-1.6..1.6_f64);
    let tip = || {
        (
            5.0..75.0_f64,
            prop_oneof![-25.0..0.0_f64, 100.0..125.0_f64, 20.0..80.0_f64],
            15.0..50.0_f64,
        )
    };
    (
        prop::sample::select(kinds),
        (turned(), turned()),
        (tip(), -10.0..10.0_f64, any::<bool>()),
        (5.0..25.0_f64, 0.03..0.3_f64),
        prop::option::of((0.0..10.0_f64, 2.0..20.0_f64)),
        prop::collection::vec((0.0..80.0_f64, 15.0..40.0_f64, 0.6..2.5_f64), 0..12),
    )
        .prop_map(
            |(kind, (from, to), ((x, y, z), aside, moves), (length, half_apex), body, vees)| {
                let (half_width, edge_height) =
                    (length * libm::sin(half_apex), length * libm::cos(half_apex));
                let strip_height = body.map_or(TOOL, |(gap, _)| edge_height + gap);
                let stages = body.map(|(_, radius)| Stage {
                    heights: [strip_height, TOOL].map(Length::mm),
                    radius: Length::mm(radius),
                });
                let joints = |[a, b, c]: [f64; 3]| [0.0, 0.0, 0.0, a, b, c];
                let tip = DVec3::new(x, y, z);
                let there = if moves { tip + DVec3::X * aside } else { tip };
                Scene {
                    kind,
                    axes: [joints(from), joints(to)],
                    tip: [tip, there],
                    outline: Outline {
                        stages: stages.into_iter().collect(),
                        ..Outline::straight(half_width, edge_height, strip_height)
                    },
                    vees,
                }
            },
        )
}

impl Scene {
    fn surface(&self) -> Surface {
        let mut surface = Surface::untouched(STOCK);
        for &(x, z, slope) in &self.vees {
            let vee = Vee::even(Point2 { x, z }, slope);
            // Some have a wall on one side.
            let wall = f64::INFINITY;
            surface.release(match libm::floor(x) % 3.0 {
                0.0 => vee.with(Side::Left, wall),
                1.0 => vee.with(Side::Right, wall),
                _ => vee,
            });
        }
        surface
    }

    fn turn<'t>(&self, rig: &'t Rig<'t>) -> Turn<'t, 't> {
        let angle = (3..6)
            .map(|axis| (self.axes[1][axis] - self.axes[0][axis]).abs())
            .sum();
        Turn {
            op: OpId(0),
            rig,
            stock: STOCK,
            tip: self.tip,
            axes: self.axes,
            angle,
            blade: self.outline.clone(),
        }
    }

    /// Tip and posture at a place of the motion.
    fn at(&self, place: f64) -> (Vector3<f64>, Matrix3<f64>) {
        let joints = core::array::from_fn(|axis| {
            self.axes[0][axis] + (self.axes[1][axis] - self.axes[0][axis]) * place
        });
        let tip = self.tip[0] + (self.tip[1] - self.tip[0]) * place;
        (Vector3::new(tip.x, tip.y, tip.z), held(self.kind, &joints))
    }

    /// Points of the blade in its frame, close to one another.
    fn points(&self) -> Vec<Vector3<f64>> {
        let Outline {
            half_width,
            edge_height,
            strip_height,
            ..
        } = self.outline;
        let across = |height: f64, half: f64| {
            (-8..=8).map(move |i| Vector3::new(half * f64::from(i) / 8.0, 0.0, -height))
        };
        let edges = (0..=20).flat_map(|i| {
            let share = f64::from(i) / 20.0;
            across(edge_height * share, half_width * share)
        });
        let body = (1..=30).flat_map(|i| {
            across(
                edge_height + (strip_height - edge_height) * f64::from(i) / 30.0,
                half_width,
            )
        });
        let round = self.outline.stages.iter().flat_map(|stage| {
            let ([from, to], radius) = (stage.heights.map(Length::to_mm), stage.radius.to_mm());
            let rings = (0..=12).map(move |i| (from + (to - from) * f64::from(i) / 12.0, radius));
            let rings = rings.chain([(from, radius / 2.0), (from, 0.0)]);
            rings.flat_map(|(height, radius)| {
                (0..36).map(move |i| {
                    let (sine, cosine) = libm::sincos(f64::from(10 * i).to_radians());
                    Vector3::new(radius * cosine, radius * sine, -height)
                })
            })
        });
        edges.chain(body).chain(round).collect()
    }

    /// Whether a place is on the blade and in the work, both within a hundredth of a millimetre.
    fn is_in_the_work(&self, hit: &Hit, moved: DVec3) -> bool {
        self.is_flat_in_the_work(hit, moved) || self.is_stage_in_the_work(hit, moved)
    }

    /// The same for the stages, of whose places x and z are known: each disc of them counts whole where any of it is over the stock.
    fn is_stage_in_the_work(&self, hit: &Hit, moved: DVec3) -> bool {
        let (tip, held) = self.at(hit.at);
        let tip = tip + Vector3::new(moved.x, moved.y, moved.z);
        self.outline.stages.iter().any(|stage| {
            let ([from, to], radius) = (stage.heights.map(Length::to_mm), stage.radius.to_mm());
            let is_in_section = [-0.01, 0.0, 0.01].into_iter().any(|aside| {
                let inside = Vector3::new(hit.place.x + aside, 50.0, hit.place.z);
                depth_of(inside, &mut self.surface()) > -0.01
            });
            let half = radius * libm::sqrt(1.0 - held.column(2).y * held.column(2).y);
            (-1200..=3200).any(|step| {
                let place = Vector3::new(hit.place.x, f64::from(step) / 20.0, hit.place.z);
                let on_blade = held.transpose() * (place - tip);
                let centre = (held * Vector3::new(0.0, 0.0, on_blade.z) + tip).y;
                (from - 0.03..=to + 0.03).contains(&-on_blade.z)
                    && libm::hypot(on_blade.x, on_blade.y) <= radius + 0.03
                    && centre + half > -0.03
                    && centre - half < 100.03
                    && is_in_section
            })
        })
    }

    fn is_flat_in_the_work(&self, hit: &Hit, moved: DVec3) -> bool {
        let place = Vector3::new(hit.place.x, hit.place.y, hit.place.z);
        let (tip, held) = self.at(hit.at);
        let on_blade = held.transpose() * (place - tip - Vector3::new(moved.x, moved.y, moved.z));
        let Outline {
            half_width,
            edge_height,
            strip_height,
            ..
        } = self.outline;
        let half = half_width * (-on_blade.z / edge_height).min(1.0);
        on_blade.y.abs() < 1e-6
            && (-strip_height - 1e-6..=1e-6).contains(&on_blade.z)
            && on_blade.x.abs() <= half + 1e-6
            // Beside a wall a place is as near to the work as it is to the wall.
            && [-0.01, 0.0, 0.01].into_iter().any(|aside| {
                let place = place + Vector3::new(aside, 0.0, 0.0);
                depth_of(place, &mut self.surface()) > -0.01
            })
    }

    /// How deep in the work any sample is at most: along y and x from the stock's sides, along z from the surface. Negative outside.
    fn depth(&self, moved: DVec3) -> f64 {
        let mut surface = self.surface();
        let points = self.points();
        let moved = Vector3::new(moved.x, moved.y, moved.z);
        let mut deepest = f64::NEG_INFINITY;
        for step in 0..=400 {
            let (tip, held) = self.at(f64::from(step) / 400.0);
            for point in &points {
                deepest = deepest.max(depth_of(held * point + tip + moved, &mut surface));
            }
        }
        deepest
    }
}

fn depth_of(p: Vector3<f64>, surface: &mut Surface) -> f64 {
    let aside = p.x.min(80.0 - p.x).min(p.y).min(100.0 - p.y);
    let top = surface.height(p.x.clamp(0.0, 80.0));
    aside.min(top - p.z)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// What is proven to be clear no sample enters; where a motion is refused, the blade is in the work where it says; and with the
    /// room that is asked for it is clear, but with notably less it is not.
    #[test]
    fn holds_against_dense_samples(scene in a_scene()) {
        let mechanism = machine(scene.kind);
        let rig = rig(&mechanism);
        let turn = scene.turn(&rig);
        let work = turn.work(&mut scene.surface());
        match turn.prove(&work, DVec3::ZERO) {
            Ok(()) => prop_assert!(scene.depth(DVec3::ZERO) <= GRAZE + 1e-9),
            Err(hit) => {
                prop_assert!(scene.is_in_the_work(&hit, DVec3::ZERO), "{:?}", hit.place);
                // No blade reaches across the stock, so more room never takes it into the work again.
                let by = match turn.cure(&work, 0.0) {
                    Cure::FartherOut(by) | Cure::HigherUp(by) => by.to_mm(),
                    Cure::Unknown => return Err(TestCaseError::fail("no room is enough")),
                };
                let outwards = turn.stands().outwards();
                prop_assert!(scene.depth(outwards * by) <= GRAZE + 1e-9);
                let less = outwards * (by - 2.0 * ROOM_STEP);
                match turn.prove(&work, less) {
                    Ok(()) => prop_assert!(by < 2.0 * ROOM_STEP, "{by}"),
                    Err(hit) => prop_assert!(scene.is_in_the_work(&hit, less), "{:?}", hit.place),
                }
            }
        }
    }

    /// The orientation that is looked at is the one that the axes give.
    #[test]
    fn turns_as_the_matrices_do(scene in a_scene(), place in 0.0..=1.0_f64) {
        let mechanism = machine(scene.kind);
        let rig = rig(&mechanism);
        let ours = scene.turn(&rig).held(place).to_cols_array();
        let (_, theirs) = scene.at(place);
        for (ours, theirs) in ours.iter().zip(theirs.iter()) {
            prop_assert!((ours - theirs).abs() < 1e-12);
        }
    }
}

/// A blade without width, 20 mm long and tilted by 40 degrees, whose tip is so far beside the work and 20 mm below its top, while a C axis
/// goes round by half a turn: at both ends it leans along the side of the work.
fn led_round(out: f64, stages: Vec<Stage>) -> Scene {
    let half_turn = core::f64::consts::PI;
    // The work is turned by 0.4 rad, so C is too.
    let axes = [0.5, 1.5].map(|turns| [0.0, 0.0, 0.0, 0.4 + turns * half_turn, TILT, 0.0]);
    Scene {
        kind: Kind::HeadCa,
        axes,
        tip: [DVec3::new(40.0, -out, 20.0); 2],
        outline: Outline {
            stages,
            ..Outline::straight(0.0, 20.0, 20.0)
        },
        vees: Vec::new(),
    }
}

/// 40 degrees.
const TILT: f64 = core::f64::consts::PI * 2.0 / 9.0;

/// What is wrong with such a motion, and what would clear it.
fn judged(scene: &Scene) -> Option<(BladePart, Cure)> {
    let mechanism = machine(scene.kind);
    let rig = rig(&mechanism);
    let turn = scene.turn(&rig);
    let work = turn.work(&mut scene.surface());
    let hit = turn.prove(&work, DVec3::ZERO).err()?;
    Some((hit.part, turn.cure(&work, 0.0)))
}

/// Asserts that a motion clears the work at this distance, and that a millimetre less is too little by a millimetre.
fn assert_clears_from(overhang: f64, stages: &[Stage], part: BladePart) {
    assert_eq!(judged(&led_round(overhang, stages.to_vec())), None);
    match judged(&led_round(overhang - 1.0, stages.to_vec())) {
        Some((found, Cure::FartherOut(by))) => {
            assert_eq!(found, part);
            assert!((by.to_mm() - 1.0).abs() < 0.03, "{by:?}");
        }
        other => panic!("{other:?}"),
    }
}

/// In the middle of the way the blade leans over the work, by the sine of the tilt.
#[test]
fn a_c_axis_carries_the_blade_over_the_work() {
    assert_clears_from(20.0 * libm::sin(TILT), &[], BladePart::Edge);
}

/// The lower rim of a stage overhangs farthest where it is as high as the top of the work.
#[test]
fn a_c_axis_carries_the_body_over_the_work() {
    let radius = 5.0;
    let stage = Stage {
        heights: [20.0, 60.0].map(Length::mm),
        radius: Length::mm(radius),
    };
    let (sine, cosine) = libm::sincos(TILT);
    let along = (20.0 + radius * sine) / cosine;
    assert_clears_from(along * sine + radius * cosine, &[stage], BladePart::Body);
}
