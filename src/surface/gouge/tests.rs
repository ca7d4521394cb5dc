//! Moves, against drops at many places on the way.

use super::*;
use crate::disc::{Axis, Stage};
use crate::posture::Contact;
use crate::surface::Surface;
use crate::testkit::{FIXED, sampled, sheets, surface_over, wavy, with_needle};
use proptest::prelude::*;
use vcutc_backend_api::geometry::{Orientation, Point3};

const PLAN: [f64; 2] = [100.0, 60.0];

fn disc(radius: f64) -> Disc {
    let stage = |radius, from, to| Stage {
        radius: Length::mm(radius),
        from: Length::mm(from),
        to: Length::mm(to),
    };
    let stages = vec![stage(radius * 0.4, 1.0, 8.0), stage(radius * 1.4, 8.0, 60.0)];
    Disc::new(Length::mm(radius), stages).unwrap()
}

/// Smooth ones, rough ones, and such with jumps.
fn surfaces() -> impl Strategy<Value = Surface> {
    let needle = (5.0..95.0, 5.0..55.0, 0.0..25.0);
    let rough = prop::collection::vec(-2.0..2.0f64, 21 * 13);
    prop_oneof![
        (0..5usize, 10..60u32).prop_map(|(kind, cells)| {
            let height = |x: f64, y: f64| {
                let (x, y) = (x - 50.0, y - 30.0);
                match kind {
                    0 => -(x * x + y * y) / 400.0,
                    1 => (x * x - y * y) / 600.0,
                    2 => (x * x + y * y) / 1000.0,
                    // A cliff without a border.
                    3 => {
                        if x + y / 3.0 < 0.0 {
                            0.0
                        } else {
                            12.0
                        }
                    }
                    _ => 3.0 * libm::sin(x / 15.0) * libm::cos(y / 20.0),
                }
            };
            surface_over(
                &sampled(PLAN[0], PLAN[1], [cells, cells], &height),
                FIXED,
                PLAN[0],
                PLAN[1],
            )
        }),
        rough.prop_map(|heights| {
            let height =
                |x: f64, y: f64| heights[(x / 5.0).round() as usize * 13 + (y / 5.0).round() as usize];
            surface_over(
                &sampled(PLAN[0], PLAN[1], [20, 12], &height),
                FIXED,
                PLAN[0],
                PLAN[1],
            )
        }),
        (sheets(), needle).prop_map(|(sheets, (x, y, z))| {
            let mesh = with_needle(&sheets.over(wavy(PLAN[0], PLAN[1])), [x, y, 0.0], [x, y, z]);
            surface_over(&mesh, FIXED, PLAN[0], PLAN[1])
        }),
    ]
}

fn leaning(lean: f64, turn: f64) -> Axis {
    let sine = libm::sin(lean);
    Axis::new([sine * libm::cos(turn), sine * libm::sin(turn), libm::cos(lean)]).unwrap()
}

/// A frame about a disc, with x to where it would touch something with a normal.
fn framed(placed: &Placed, normal: [f64; 2]) -> Orientation {
    let pose = placed.pose();
    let contact = Contact::new(pose.centre, [normal[0], normal[1], 1.0], [1.0, 0.0]).unwrap();
    contact.frame(&pose).unwrap().orientation
}

/// A disc that came down over a place, and was lifted by so much.
fn down(moves: &Moves<'_, '_>, disc: &Disc, place: [f64; 2], axis: Axis, lifted: f64) -> Option<Placed> {
    let rest = moves.dropper.disc(disc, place, axis)?;
    let centre = Point3::new(place[0], place[1], rest.height.to_mm() + lifted);
    moves.place(disc, Pose { centre, axis })
}

/// How deep a disc comes on a move on which it turns evenly from one orientation to the next, by drops at places on the way.
fn deepest(
    dropper: &Dropper<'_>,
    disc: &Disc,
    [from, to]: [&Placed; 2],
    frames: [Orientation; 2],
    places: u32,
) -> f64 {
    let [a, b] = [from.pose(), to.pose()];
    let depth = |k: u32| {
        let share = f64::from(k) / f64::from(places);
        let between = |a: f64, b: f64| a + (b - a) * share;
        let place = [between(a.centre.x, b.centre.x), between(a.centre.y, b.centre.y)];
        let matrix = frames[0].towards(frames[1], share).matrix();
        let axis = Axis::new(matrix.map(|row| -row[2]))?;
        let rest = dropper.disc(disc, place, axis)?;
        Some(rest.height.to_mm() - between(a.centre.z, b.centre.z))
    };
    (0..=places).filter_map(depth).fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn no_move_enters_by_more_than_its_bound(
        surface in surfaces(), radius in 2.0..20.0f64, x in -15.0..115.0f64, y in -15.0..75.0f64, lean in 0.0..0.3f64,
        turn in 0.0..6.3f64, by in prop::array::uniform2(-9.0..9.0f64), more in -0.1..0.1f64, about in -0.3..0.3f64,
        normals in prop::array::uniform2(prop::array::uniform2(-0.05..0.05f64)), enough in prop_oneof![Just(0.0), 0.0..0.1f64], lifted in prop_oneof![Just([0.0, 0.0]), prop::array::uniform2(0.0..0.5f64)],
    ) {
        let dropper = Dropper::new(&surface);
        let moves = Moves::new(&dropper).unwrap();
        let disc = disc(radius);
        let from = down(&moves, &disc, [x, y], leaning(lean, turn), lifted[0]);
        let to = down(&moves, &disc, [x + by[0], y + by[1]], leaning(lean + more, turn + about), lifted[1]);
        let (Some(from), Some(to)) = (from, to) else { return Ok(()) };
        let frames = [framed(&from, normals[0]), framed(&to, normals[1])];
        let angle = frames[0].angle_to(frames[1]);
        let bound = moves.between(&disc, [&from, &to], angle, Length::mm(enough)).depth.to_mm();
        let found = deepest(&dropper, &disc, [&from, &to], frames, 200);
        prop_assert!(found <= bound + 1e-9, "{found} above {bound}");
    }
}

#[test]
fn bounds_on_domes_are_useful() {
    for (r, cells, step) in [
        (200.0, 60, 3.0),
        (500.0, 60, 5.0),
        (500.0, 60, 2.0),
        (3000.0, 60, 10.0),
    ] {
        let height = |x: f64, y: f64| {
            let (x, y) = (x - 60.0, y - 60.0);
            libm::sqrt(r * r - x * x - y * y) - r
        };
        let surface = surface_over(
            &sampled(120.0, 120.0, [cells, cells], &height),
            FIXED,
            120.0,
            120.0,
        );
        let dropper = Dropper::new(&surface);
        let moves = Moves::new(&dropper).unwrap();
        let disc = Disc::new(Length::mm(25.0), vec![]).unwrap();
        let axis = leaning(0.09, 0.0);
        let (mut worst, mut deep) = (0.0_f64, 0.0_f64);
        for k in 0..4 {
            let x = 30.0 + step * f64::from(k);
            let from = down(&moves, &disc, [x, 60.3], axis, 0.0).unwrap();
            let to = down(&moves, &disc, [x + step, 60.3], axis, 0.0).unwrap();
            worst = worst.max(
                moves
                    .between(&disc, [&from, &to], Angle::ZERO, Length::ZERO)
                    .depth
                    .to_mm(),
            );
            deep = deep.max(deepest(
                &dropper,
                &disc,
                [&from, &to],
                [&from, &to].map(|end| framed(end, [0.0; 2])),
                100,
            ));
        }
        assert!(deep > 0.0 && worst <= 15.0 * deep, "{worst} for {deep}");
    }
}
