//! Regions that are hard for programs that clear pockets: exact ties, touches, spikes, and what is almost parallel. Programs are held
//! against walls that the tests work out from their own numbers.

use crate::drawn::{Corner, Form, Sheet};
use crate::pipeline::rendered;
use crate::seen_from_above::{Boundary, Spot, distance, ways, ways_of};
use crate::trap::{
    CHOSEN, DEPTH, FLOOR, KEEP, PATTERNS, RADIUS, Trap, WIDTH, assert_cleared, clear, codes, compiled, fault,
    job, plain, rectangle,
};
use core::f64::consts::{PI, TAU};
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;

/// Two rooms with a corridor 20 mm long between.
fn dumbbell(width: f64) -> Vec<Corner> {
    let (low, high) = (40.0 - width / 2.0, 40.0 + width / 2.0);
    plain(&[
        [10.0, 10.0],
        [60.0, 10.0],
        [60.0, low],
        [80.0, low],
        [80.0, 15.0],
        [125.0, 15.0],
        [125.0, 65.0],
        [80.0, 65.0],
        [80.0, high],
        [60.0, high],
        [60.0, 70.0],
        [10.0, 70.0],
    ])
}

/// Two rooms with a waist between two points.
fn waist(width: f64) -> Vec<Corner> {
    let (low, high) = (40.0 - width / 2.0, 40.0 + width / 2.0);
    plain(&[
        [10.0, 10.0],
        [60.0, 10.0],
        [70.0, low],
        [80.0, 10.0],
        [125.0, 10.0],
        [125.0, 70.0],
        [80.0, 70.0],
        [70.0, high],
        [60.0, 70.0],
        [10.0, 70.0],
    ])
}

/// Two rooms with a waist between two half circles.
fn round_waist(width: f64) -> Vec<Corner> {
    let (low, high) = (40.0 - width / 2.0, 40.0 + width / 2.0);
    vec![
        (10.0, 10.0, 0.0),
        (60.0, 10.0, 0.0),
        (60.0, low - 10.0, -1.0),
        (80.0, low - 10.0, 0.0),
        (80.0, 10.0, 0.0),
        (125.0, 10.0, 0.0),
        (125.0, 70.0, 0.0),
        (80.0, 70.0, 0.0),
        (80.0, high + 10.0, -1.0),
        (60.0, high + 10.0, 0.0),
        (60.0, 70.0, 0.0),
        (10.0, 70.0, 0.0),
    ]
}

/// A region with a neck of some width.
type Shape = fn(f64) -> Vec<Corner>;

/// Widths near the tool's, with what passes keep from walls, and what the proof asks of them.
#[test]
fn necks_about_as_wide_as_the_tool() {
    let widths = [-1e-3, 0.0, 0.0102, 0.0138, 0.014, 0.0142];
    let shapes: [(&str, Shape); 3] = [
        ("corridor", dumbbell),
        ("waist", waist),
        ("round waist", round_waist),
    ];
    let traps = shapes.into_iter().flat_map(|(name, shape)| {
        let trap = move |more: f64| {
            let width = 2.0 * RADIUS + more;
            Trap::polygon(format!("{name} of {width} mm"), &shape(width))
        };
        widths.into_iter().map(trap)
    });
    assert_cleared(&CHOSEN, traps);
}

/// Corridors in which the last levels are lines.
#[test]
fn corridors_as_wide_as_two_levels() {
    let traps = [0.0, 2.0].into_iter().flat_map(|level| {
        [0.0, 1e-9, -1e-6, 1e-3].map(|more| {
            let width = 2.0 * (KEEP + 4.0 * level) + more;
            Trap::polygon(format!("corridor of {width} mm"), &dumbbell(width)).with("step = 4 mm")
        })
    });
    assert_cleared(&CHOSEN, traps);
}

#[test]
fn loops_that_touch() {
    let touching_itself = plain(&[
        [10.0, 10.0],
        [70.0, 40.0],
        [130.0, 10.0],
        [130.0, 70.0],
        [70.0, 40.0],
        [10.0, 70.0],
    ]);
    let room = |sheet: &mut Sheet| rectangle(sheet, [10.0, 10.0], [120.0, 90.0]);
    let traps = [
        Trap::polygon("a loop that touches itself", &touching_itself),
        Trap::of("two round islands that touch", |sheet| {
            room(sheet);
            sheet.circle("SEAT", [50.0, 50.0], 12.0);
            sheet.circle("SEAT", [74.0, 50.0], 12.0);
        }),
        Trap::of("square islands that touch in a corner", |sheet| {
            room(sheet);
            rectangle(sheet, [40.0, 35.0], [20.0, 20.0]);
            rectangle(sheet, [60.0, 55.0], [20.0, 20.0]);
        }),
        Trap::of("an island that touches a side", |sheet| {
            room(sheet);
            sheet.circle("SEAT", [118.0, 50.0], 12.0);
        }),
        Trap::of("an island that touches a side with a corner", |sheet| {
            room(sheet);
            sheet.polyline(
                "SEAT",
                Form::Light,
                &plain(&[[60.0, 10.0], [75.0, 40.0], [45.0, 40.0]]),
            );
        }),
        Trap::of("an island in the corner", |sheet| {
            room(sheet);
            sheet.polyline(
                "SEAT",
                Form::Light,
                &plain(&[[10.0, 10.0], [40.0, 20.0], [20.0, 40.0]]),
            );
        }),
        Trap::of("a circle in a circle that touches it", |sheet| {
            sheet.circle("SEAT", [60.0, 55.0], 45.0);
            sheet.circle("SEAT", [75.0, 55.0], 30.0);
        }),
        Trap::of("two outlines that touch in a corner", |sheet| {
            rectangle(sheet, [10.0, 10.0], [50.0, 40.0]);
            rectangle(sheet, [60.0, 50.0], [50.0, 40.0]);
        }),
    ];
    assert_cleared(&PATTERNS, traps);
}

#[test]
fn basins_and_rings() {
    // Three equal rooms around a hub.
    let mut trefoil = Vec::new();
    for k in 0..3 {
        let turn = TAU * f64::from(k) / 3.0 + 0.2;
        let (sin, cos) = turn.sin_cos();
        let at = |x: f64, y: f64| [68.0 + cos * x - sin * y, 50.0 + sin * x + cos * y];
        let aside = 7.0;
        let hub = aside / (PI / 3.0).tan();
        trefoil.extend([
            at(hub + 0.5, -aside),
            at(15.0, -aside),
            at(15.0, -13.0),
            at(45.0, -13.0),
            at(45.0, 13.0),
            at(15.0, 13.0),
            at(15.0, aside),
        ]);
    }
    let ring = |name: &str, out: f64, inner: f64| {
        Trap::of(name.to_owned(), |sheet| {
            sheet.circle("SEAT", [60.0, 55.0], out);
            sheet.circle("SEAT", [60.0, 55.0], inner);
        })
    };
    let round = |radius: f64| {
        Trap::of(format!("a circle of {radius} mm"), |sheet| {
            sheet.circle("SEAT", [60.0, 55.0], radius)
        })
    };
    let traps = [
        Trap::polygon("three equal basins", &plain(&trefoil)),
        ring("a ring", 45.0, 20.0),
        ring("a ring as wide as two levels", 40.0, 40.0 - 2.0 * (KEEP + RADIUS)),
        round(50.0),
        round(KEEP + 2.0 * RADIUS),
        round(KEEP + 2.0 * RADIUS + 0.01),
        round(KEEP + 2.0 * RADIUS + 0.1),
    ];
    assert_cleared(&PATTERNS, traps);
}

#[test]
fn sizes_far_apart() {
    let fillet = |radius: f64, side: f64| {
        let bulge = (PI / 8.0).tan();
        let (left, low, right, high) = (10.0, 10.0, 120.0, 80.0);
        vec![
            (left + radius, low, side),
            (right - radius, low, bulge),
            (right, low + radius, 0.0),
            (right, high - radius, bulge),
            (right - radius, high, side),
            (left + radius, high, bulge),
            (left, high - radius, 0.0),
            (left, low + radius, bulge),
        ]
    };
    let mut traps: Vec<Trap> = Vec::new();
    for radius in [1e-3, RADIUS, KEEP, KEEP + 1e-6, 8.0] {
        for side in [0.0, 110.0 / 4e5, -110.0 / 4e5] {
            traps.push(Trap::polygon(
                format!("corners of {radius} mm, sides of {side}"),
                &fillet(radius, side),
            ));
        }
    }
    for radius in [1e-3, 0.1, 1.0, RADIUS, KEEP] {
        traps.push(Trap::of(format!("an island of {radius} mm"), |sheet| {
            rectangle(sheet, [10.0, 10.0], [110.0, 80.0]);
            sheet.circle("SEAT", [60.0, 47.0], radius);
        }));
    }
    for more in [0.05, 0.2, 1.0] {
        let side = 2.0 * (KEEP + 4.0 * RADIUS) + more;
        traps.push(Trap::of(format!("a last loop of {} mm", 4.0 * more), |sheet| {
            rectangle(sheet, [20.0, 20.0], [side, side]);
        }));
    }
    for (width, depth) in [(14.0, 14.0), (14.0, 90.0), (11.0, 50.0), (10.2, 60.0)] {
        traps.push(
            Trap::of(format!("{width} x {depth} mm with a step of 9.9 mm"), |sheet| {
                rectangle(sheet, [20.0, 10.0], [width, depth]);
            })
            .with("step = 9.9 mm"),
        );
    }
    for tilt in [1e-9, -1e-9, 1e-7, 1e-5] {
        for width in [2.0 * KEEP, 2.0 * (KEEP + RADIUS)] {
            let corners = [
                [10.0, 20.0],
                [110.0, 20.0],
                [110.0, 20.0 + width + tilt],
                [10.0, 20.0 + width - tilt],
            ];
            traps.push(Trap::polygon(
                format!("walls {width} mm apart, {tilt} mm off"),
                &plain(&corners),
            ));
        }
    }
    let stairs: Vec<Spot> = (0..20)
        .flat_map(|k| {
            let at = 10.0 + 4.0 * f64::from(k);
            [
                [at, 10.0 + 2.0 * f64::from(k)],
                [at + 4.0, 10.0 + 2.0 * f64::from(k)],
            ]
        })
        .chain([[90.0, 100.0], [10.0, 100.0]])
        .collect();
    assert_cleared(&CHOSEN, traps);
    let rounded = Trap::polygon("corners larger than their legs", &plain(&stairs)).with("corners = 30 mm");
    assert_cleared(&["sfs"], [rounded]);
}

#[test]
fn open_sides() {
    let window = [
        [10.0, 0.0],
        [40.0, 0.0],
        [90.0, 0.0],
        [120.0, 0.0],
        [120.0, 70.0],
        [10.0, 70.0],
    ];
    let traps = [
        Trap::of("a window between two walls in line", |sheet| {
            sheet.polyline("SEAT", Form::Light, &plain(&window));
            sheet.line("OPEN", [40.0, 0.0], [90.0, 0.0]);
        }),
        Trap::of("all sides open around an island", |sheet| {
            rectangle(sheet, [0.0, 0.0], [WIDTH, DEPTH]);
            sheet.circle("SEAT", [60.0, 50.0], 15.0);
            sheet.polyline(
                "OPEN",
                Form::Light,
                &plain(&[[0.0, 0.0], [WIDTH, 0.0], [WIDTH, DEPTH], [0.0, DEPTH]]),
            );
        }),
        Trap::of("an open side in three pieces", |sheet| {
            sheet.polyline("SEAT", Form::Light, &plain(&window));
            sheet.line("OPEN", [10.0, 0.0], [120.0, 0.0]);
        }),
        Trap::of("an island at an open side", |sheet| {
            sheet.polyline("SEAT", Form::Light, &plain(&window));
            sheet.circle("SEAT", [65.0, 12.0], 12.0);
            sheet.line("OPEN", [40.0, 0.0], [90.0, 0.0]);
        }),
        Trap::of("a window as wide as the tool", |sheet| {
            let middle = [
                [10.0, 0.0],
                [50.0, 0.0],
                [50.0 + 2.0 * KEEP, 0.0],
                [120.0, 0.0],
                [120.0, 70.0],
                [10.0, 70.0],
            ];
            sheet.polyline("SEAT", Form::Light, &plain(&middle));
            sheet.line("OPEN", [50.0, 0.0], [50.0 + 2.0 * KEEP, 0.0]);
        }),
    ];
    assert_cleared(&CHOSEN, traps);
}

/// Outlines of many segments, a clockwise one among them.
#[test]
fn outlines_of_many_segments() {
    let round = |count: u32, way: f64| {
        let corner = |k: u32| {
            let (sin, cos) = (way * TAU * f64::from(k) / f64::from(count)).sin_cos();
            (65.0 + 55.0 * cos, 55.0 + 45.0 * sin, 0.0)
        };
        (0..count).map(corner).collect::<Vec<Corner>>()
    };
    let traps = [(2_000, -1.0), (7, -1.0)]
        .map(|(count, way)| Trap::polygon(format!("{count} segments"), &round(count, way)));
    assert_cleared(&["offset", "zigzag"], traps);
}

/// A crusher does not go straight down, so that it has to have a line to go along.
#[test]
fn a_ring_as_wide_as_its_tool_has_no_room_to_go_down() {
    let ring = |width: f64| {
        Trap::of("a ring", |sheet| {
            sheet.circle("SEAT", [60.0, 55.0], 40.0);
            sheet.circle("SEAT", [60.0, 55.0], 40.0 - width);
        })
    };
    for pattern in PATTERNS {
        let outcome = ring(2.0 * KEEP).compiled(pattern);
        assert_eq!(codes(&outcome), [Code::PocketTooNarrow], "{pattern}");
        let text = rendered(&outcome.diagnostics, &outcome);
        assert!(
            text.contains("no room to go down") && text.contains("use a narrower tool"),
            "{text}"
        );
        let outcome = ring(2.0 * KEEP - 1e-3).compiled(pattern);
        assert_eq!(codes(&outcome), [Code::PocketTooNarrow], "{pattern}");
        let text = rendered(&outcome.diagnostics, &outcome);
        assert!(
            text.contains("use a tool with a radius of at most 4.99 mm"),
            "{text}"
        );
    }
    assert_cleared(&CHOSEN, [ring(2.0 * KEEP + 0.1)]);
}

/// A region that is all of the stock has no walls: it is faced in rows, which other patterns offer.
#[test]
fn ground_without_walls_is_cleared_in_rows() {
    let corners = plain(&[[0.0, 0.0], [WIDTH, 0.0], [WIDTH, DEPTH], [0.0, DEPTH]]);
    let trap = Trap::of("all sides open", |sheet| {
        sheet.polyline("SEAT", Form::Light, &corners);
        sheet.polyline("OPEN", Form::Light, &corners);
    });
    let boundary = trap.boundary();
    for pattern in ["zigzag", "auto"] {
        assert_eq!(fault(&trap.compiled(pattern), &boundary), None);
    }
    for pattern in ["offset", "sfs", "field"] {
        let outcome = trap.compiled(pattern);
        assert_eq!(codes(&outcome), [Code::PocketTooNarrow], "{pattern}");
        let [fix] = outcome.diagnostics[0].fixes.as_slice() else {
            panic!("{}", rendered(&outcome.diagnostics, &outcome))
        };
        assert_eq!(fix.edits[0].replacement, "zigzag");
    }
}

const ROOM: &str =
    "start (10 mm, 10 mm) line to (130 mm, 10 mm) line to (130 mm, 100 mm) line to (10 mm, 100 mm)";

/// The region in the job, not in a drawing.
fn with_islands(islands: &str) -> Outcome {
    let fields = format!("floor = {FLOOR} mm pattern = offset");
    compiled(&job(&format!("region seat {{ {ROOM} {islands} }}"), &fields), "")
}

#[test]
fn islands_that_are_drawn_twice_count_once() {
    let once = with_islands("island { circle (50 mm, 50 mm) radius 12 mm }");
    let program = |outcome: &Outcome| {
        let compiled = outcome.compiled.as_ref().unwrap();
        compiled.program.verified().program().ops.clone()
    };
    let circle = "island { circle (50 mm, 50 mm) radius 12 mm }";
    let twice = with_islands(&format!("{circle} {circle}"));
    assert!(
        !has_errors(&twice.diagnostics),
        "{}",
        rendered(&twice.diagnostics, &twice)
    );
    assert_eq!(program(&once), program(&twice));
    // From another corner, the other way round.
    let square = "start (40 mm, 40 mm) line to (60 mm, 40 mm) line to (60 mm, 60 mm) line to (40 mm, 60 mm)";
    let again = "start (60 mm, 60 mm) line to (60 mm, 40 mm) line to (40 mm, 40 mm) line to (40 mm, 60 mm)";
    let twice = with_islands(
        &format!("island {{ {square} }} island {{ {again} }} {circle}")
            .replace("(50 mm, 50 mm)", "(90 mm, 50 mm)"),
    );
    assert!(
        !has_errors(&twice.diagnostics),
        "{}",
        rendered(&twice.diagnostics, &twice)
    );
    // What is not an island is named, wherever it stands among others.
    for (islands, named) in [
        (format!("{circle} island {{ {ROOM} }}"), "line to (130 mm, 10 mm)"),
        (format!("island {{ circle (50 mm, 50 mm) radius 5 mm }} {circle} island {{ circle (90 mm, 50 mm) radius 9 mm }}"), "circle (50 mm, 50 mm) radius 5 mm"),
        ("island { circle (160 mm, 100 mm) radius 8 mm } island { circle (50 mm, 50 mm) radius 12 mm }".to_owned(), "circle (160 mm, 100 mm) radius 8 mm"),
        ("island { start (5 mm, 5 mm) line to (135 mm, 5 mm) line to (135 mm, 105 mm) line to (5 mm, 105 mm) }".to_owned(), "line to (135 mm, 5 mm)"),
    ] {
        let outcome = with_islands(&islands);
        assert_eq!(codes(&outcome), [Code::RegionTangled], "{islands}");
        let span = outcome.diagnostics[0].primary.span;
        let text = &outcome.sources.get(span.file).unwrap().text;
        assert_eq!(&text[span.start as usize..span.end as usize], named, "{islands}");
    }
}

/// Each is cleared as if the other were not there, and neither enters a wall of its own.
#[test]
fn pockets_that_overlap_are_both_cleared() {
    let sides = |corners: &[Spot]| {
        let next = corners.iter().cycle().skip(1);
        corners
            .iter()
            .zip(next)
            .map(|(a, b)| [*a, *b])
            .collect::<Vec<_>>()
    };
    let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
    let text = |name: &str, corners: [Spot; 4]| {
        let polygon = corners.map(|[x, y]| format!("({x} mm, {y} mm)"));
        let [first, rest @ ..] = polygon;
        format!(
            "region {name} {{ start {first} line to {} }}\n",
            rest.join(" line to ")
        )
    };
    let (one, other) = (square(10.0, 70.0), square(40.0, 100.0));
    for (low, high) in [(10.0, 10.0), (10.0, 14.0), (14.0, 10.0)] {
        let regions = text("seat", one) + &text("bay", other);
        let job = job(&regions, &format!("floor = {low} mm")) + &clear("bay", &format!("floor = {high} mm"));
        let outcome = compiled(&job, "");
        assert!(
            !has_errors(&outcome.diagnostics),
            "{}",
            rendered(&outcome.diagnostics, &outcome)
        );
        let program = outcome.compiled.as_ref().unwrap().program.verified().program();
        for (number, (corners, floor)) in [(one, low), (other, high)].into_iter().enumerate() {
            let boundary = Boundary::of(sides(&corners), Vec::new());
            let ways = ways_of(program, |operation| usize::from(operation.0) == number);
            assert!(
                ways.iter()
                    .all(|(_, at)| at.z >= floor - 1e-9 && boundary.contains([at.x, at.y]))
            );
            let nearest = ways.iter().map(|(_, at)| boundary.to_wall([at.x, at.y], RADIUS));
            assert!(nearest.fold(f64::INFINITY, f64::min) >= RADIUS - 1e-6);
            let flat = ways.iter().filter(|(_, at)| (at.z - floor).abs() < 1e-3);
            assert!(boundary.uncut(RADIUS, RADIUS, flat.map(|(_, at)| [at.x, at.y])) <= 1.0);
        }
    }
}

/// A hole within a pocket that is a pocket of its own, deeper: an island of the one, the region of the other.
#[test]
fn a_hole_is_drawn_as_a_region_of_its_own() {
    let hole = "circle (60 mm, 50 mm) radius 15 mm";
    let regions = format!("region seat {{ {ROOM} island {{ {hole} }} }}\nregion hole {{ {hole} }}");
    let job = job(&regions, "floor = 12 mm") + &clear("hole", "floor = 9 mm");
    let outcome = compiled(&job, "");
    assert!(
        !has_errors(&outcome.diagnostics),
        "{}",
        rendered(&outcome.diagnostics, &outcome)
    );
    let program = outcome.compiled.as_ref().unwrap().program.verified().program();
    let away = |(_, at): &(u32, vcutc_backend_api::geometry::Point3)| distance([at.x, at.y], [60.0, 50.0]);
    let of = |number: u16| ways_of(program, move |operation| operation.0 == number);
    assert!(of(0).iter().map(away).fold(f64::INFINITY, f64::min) >= 15.0 + RADIUS - 1e-6);
    assert!(of(1).iter().map(away).fold(0.0, f64::max) <= 15.0 - RADIUS + 1e-6);
}

type Map = fn(Spot) -> Spot;

/// Passes of a pattern over regions that are mirrored or turned lie where mirrored or turned passes do, but for where they begin.
#[test]
fn mirrored_and_turned_regions_have_mirrored_and_turned_passes() {
    let outline = [
        (15.0, 15.0, 0.0),
        (90.0, 15.0, 0.35),
        (95.0, 60.0, 0.0),
        (60.0, 60.0, 0.0),
        (60.0, 90.0, -0.2),
        (20.0, 95.0, 0.0),
    ];
    let island = [(40.0, 35.0, 0.3), (55.0, 35.0, 0.0), (50.0, 48.0, 0.0)];
    let maps: [(Map, f64); 3] = [
        (|[x, y]| [110.0 - x, y], -1.0),
        (|[x, y]| [110.0 - y, x], 1.0),
        (|[x, y]| [110.0 - x, 110.0 - y], 1.0),
    ];
    let flat = |map: Map, sign: f64, pattern: &str| {
        let moved = |corners: &[Corner]| {
            let at = |&(x, y, bulge): &Corner| (map([x, y])[0], map([x, y])[1], sign * bulge);
            corners.iter().map(at).collect::<Vec<Corner>>()
        };
        let trap = Trap::of("turned", |sheet| {
            sheet.polyline("SEAT", Form::Light, &moved(&outline));
            sheet.polyline("SEAT", Form::Light, &moved(&island));
        });
        let outcome = trap.compiled(pattern);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{}",
            rendered(&outcome.diagnostics, &outcome)
        );
        let ways = ways(outcome.compiled.as_ref().unwrap().program.verified().program());
        let flat = ways.into_iter().filter(|(_, at)| (at.z - FLOOR).abs() < 1e-3);
        flat.map(|(_, at)| [at.x, at.y]).collect::<Vec<Spot>>()
    };
    for pattern in ["offset", "sfs"] {
        let plain = flat(|at| at, 1.0, pattern);
        for (map, sign) in maps {
            let found = flat(map, sign, pattern);
            let moved: Vec<Spot> = plain.iter().map(|at| map(*at)).collect();
            for (one, other) in [(&found, &moved), (&moved, &found)] {
                let is_alone = |at: &&Spot| !other.iter().any(|with| distance(**at, *with) < 0.25);
                let alone = one.iter().filter(is_alone).count();
                // Ways from pass to pass differ, as passes begin elsewhere.
                assert!(alone * 50 < one.len(), "{pattern}: {alone} of {}", one.len());
            }
        }
    }
}
