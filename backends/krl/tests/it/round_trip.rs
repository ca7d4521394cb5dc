//! Random programs come back from the text as they went in.

use crate::support::expected::{self, Rounding, compare};
use crate::support::{emit, reachable, reader, status};
use proptest::prelude::*;
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{AxisValues, Edges, Inertia, Load, PlacedFrame, Ready, Registered, Stock};
use vcutc_backend_api::testkit::{CellRecipe, Crossing, Passes, Recipe};
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Mass, Speed};

fn frame() -> impl Strategy<Value = Frame> {
    let number = -1.0..1.0_f64;
    let quaternion = [number.clone(), number.clone(), number.clone(), number];
    let far = -5000.0..5000.0_f64;
    (quaternion, [far.clone(), far.clone(), far]).prop_map(|([w, x, y, z], [px, py, pz])| Frame {
        origin: Point3::new(px, py, pz),
        orientation: Orientation::from_quaternion(w, x, y, z).unwrap_or(Orientation::IDENTITY),
    })
}

fn placed(most: u32) -> impl Strategy<Value = PlacedFrame> {
    (frame(), proptest::option::of(1..=most)).prop_map(|(frame, number)| PlacedFrame { frame, number })
}

/// Of the moments of a body, those about x and y come from how far its mass is from two planes, and that about z from both.
fn inertia() -> impl Strategy<Value = Inertia> {
    [0.0..20.0_f64, 0.0..20.0_f64, 0.0..20.0_f64].prop_map(|[x, y, z]| Inertia {
        x: y + z,
        y: x + z,
        z: x + y,
    })
}

fn load() -> impl Strategy<Value = Registered<Load>> {
    prop_oneof![
        (1..=16_u32).prop_map(Registered::Number),
        (0.1..200.0_f64, -300.0..300.0_f64, proptest::option::of(inertia())).prop_map(
            |(mass, z, inertia)| {
                Registered::Value(Load {
                    mass: Mass::kg(mass),
                    centre: Point3::new(0.0, 0.0, z),
                    inertia,
                })
            }
        ),
    ]
}

fn cell() -> impl Strategy<Value = CellRecipe> {
    (
        placed(16),
        placed(32),
        proptest::option::of(load()),
        [(); 6].map(|()| -350.0..350.0_f64),
        (1..=4096_u32).prop_map(Some),
        prop_oneof![
            (1..=1024_u32).prop_map(Ready::Input),
            (0.0..100.0_f64).prop_map(|s| Ready::After(Duration::s(s)))
        ],
    )
        .prop_map(|(tool, base, load, home, ultrasonic, ready)| CellRecipe {
            kind: vcutc_backend_api::ir::MachineKind::Robot,
            maker: vcutc_backend_api::ir::Maker::Kuka,
            tool,
            base,
            load,
            home: AxisValues(home.map(f64::to_radians)),
            ultrasonic,
            ready,
        })
}

fn process() -> impl Strategy<Value = Recipe> {
    (
        prop_oneof![Just(Passes::Point), Just(Passes::Layer)],
        prop_oneof![Just(Edges::Double), Just(Edges::Single)],
        5.0..60.0_f64,
        45.0..90.0_f64,
        0.1..20.0_f64,
        0.5..60.0_f64,
        (50.0..900.0_f64, 20.0..900.0_f64),
        prop_oneof![Just(Crossing::Straight), Just(Crossing::ByAxes)],
    )
        .prop_map(
            |(passes, edges, swing, rake, step, clearance, (depth, height), crossing)| Recipe {
                crossing,
                passes,
                edges,
                swing: Angle::deg(swing),
                rake: Angle::deg(rake),
                step: Length::mm(step),
                clearance: Length::mm(clearance),
                stock: Stock {
                    width: Length::mm(400.0),
                    depth: Length::mm(depth),
                    height: Length::mm(height),
                },
                ..Recipe::default()
            },
        )
}

pub(crate) fn recipe() -> impl Strategy<Value = Recipe> {
    (
        process(),
        cell(),
        (0..3_u16, 0..4_u32, 0..5_u32),
        (0.001..3.0_f64, 0.001..3.0_f64, 0.1..400.0_f64),
        proptest::option::of(0.0..10.0_f64),
        ".{0,30}",
    )
        .prop_map(|(process, cell, counts, speeds, dwell, name)| Recipe {
            name,
            operations: counts.0,
            layers: counts.1,
            cuts: counts.2,
            cut_feed: Speed::m_per_s(speeds.0),
            travel_feed: Speed::m_per_s(speeds.1),
            rate: AngularSpeed::deg_per_s(speeds.2),
            dwell: dwell.map(Duration::s),
            cell,
            ..process
        })
}

/// Values for all options.
pub(crate) fn values() -> impl Strategy<Value = Vec<(&'static str, OptionValue)>> {
    (
        3..=6_u32,
        prop_oneof![Just(0), 1..60_u32, Just(2500)],
        proptest::collection::vec(".{0,200}", 0..3),
        prop_oneof![Just(0.0), 0.1..50.0_f64],
        prop_oneof![Just("classic"), Just("spline")],
        prop_oneof![Just("no"), Just("yes")],
        1..=100_u32,
    )
        .prop_map(|(decimals, lines, header, distance, motion, declare, speed)| {
            vec![
                ("decimals", OptionValue::Integer(decimals)),
                ("lines_per_part", OptionValue::Integer(lines)),
                ("header", OptionValue::Lines(header)),
                ("approximation", OptionValue::Length(Length::mm(distance))),
                ("motion", OptionValue::Choice(motion)),
                ("declare_parts", OptionValue::Choice(declare)),
                ("home_speed", OptionValue::Integer(speed)),
            ]
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn the_text_says_what_the_ops_say(recipe in recipe(), values in values()) {
        let program = reachable(recipe.program());
        let bundle = emit(&program, &values);
        let main = bundle.files()[0].0.trim_end_matches(".src").to_owned();
        let got = reader::run(&bundle, &main).map_err(TestCaseError::fail)?;
        let Some((_, OptionValue::Integer(decimals))) = values.first() else {
            unreachable!("decimals come first");
        };
        let rounding = Rounding::of_decimals(i32::try_from(*decimals).unwrap());
        compare(&got, &expected::steps(&program, &status), rounding).map_err(TestCaseError::fail)?;
    }

    #[test]
    fn the_same_program_gives_the_same_bytes(recipe in recipe(), values in values()) {
        let program = reachable(recipe.program());
        prop_assert_eq!(emit(&program, &values), emit(&reachable(recipe.program()), &values));
    }

    #[test]
    fn the_frames_are_those_of_the_cell(recipe in recipe()) {
        let bundle = emit(&reachable(recipe.program()), &[]);
        let main = bundle.files()[0].0.trim_end_matches(".src").to_owned();
        let got = reader::run(&bundle, &main).map_err(TestCaseError::fail)?;
        for (is_tool, placed) in [(true, recipe.cell.tool), (false, recipe.cell.base)] {
            let set = got.iter().find_map(|event| match event {
                reader::Event::Tool(setting) if is_tool => Some(*setting),
                reader::Event::Base(setting) if !is_tool => Some(*setting),
                _ => None,
            });
            let agrees = match (set, placed.number) {
                (Some(reader::Setting::Number(got)), Some(want)) => got == want,
                (Some(reader::Setting::Value(got)), None) => {
                    let want = reader::Pose {
                        tip: [placed.frame.origin.x, placed.frame.origin.y, placed.frame.origin.z],
                        axes: placed.frame.orientation.matrix(),
                    };
                    expected::poses_agree(&got, &want, Rounding::of_decimals(3))
                }
                _ => false,
            };
            prop_assert!(agrees, "{set:?} instead of {placed:?}");
        }
    }
}
