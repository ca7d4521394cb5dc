//! Slits along walls: what their programs leave, by samples of the blade in space, which know neither outlines nor bounds; programs
//! that were changed; and the values that messages offer.

use crate::pipeline::{Files, compile};
use proptest::prelude::*;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::process::verdict::replay;
use vcutc::simulation::prove::{CutFault, Findings, SlitFault};
use vcutc_backend_api::ir::{Action, Joint, Program, Site};
use vcutc_backend_api::verify::verify;

const HEIGHT: f64 = 30.0;
const FLOOR: f64 = 10.0;
const HALF_APEX: f64 = 7.13;
const THICKNESS: f64 = 1.5;

/// A rounded rectangle with a bump at its upper side and a round island.
#[derive(Clone, Copy, Debug)]
struct Region {
    /// From and to along x, from and to along y.
    sides: [f64; 4],
    /// The radius of its right lower corner.
    corner: f64,
    /// How far the bump at the upper side comes in, and how wide it is.
    bump: [f64; 2],
    /// The centre and the radius of the island.
    island: [f64; 3],
    /// Whether the right side is open.
    is_open: bool,
}

impl Region {
    fn text(&self) -> String {
        let Self {
            sides: [left, right, low, high],
            corner,
            bump: [_, wide],
            island: [x, y, radius],
            is_open,
        } = *self;
        let middle = f64::midpoint(left, right);
        let bump = self.bump_radius();
        let word = if is_open { "open" } else { "line" };
        let begin = if is_open {
            format!("line to ({right} mm, {low} mm)")
        } else {
            format!(
                "line to ({} mm, {low} mm)\n  arc to ({right} mm, {} mm) radius {corner} mm",
                right - corner,
                low + corner
            )
        };
        format!(
            "region seat {{
  start ({left} mm, {low} mm)
  {begin}
  {word} to ({right} mm, {high} mm)
  line to ({} mm, {high} mm)
  arc to ({} mm, {high} mm) radius -{bump} mm
  line to ({left} mm, {high} mm)
  island {{ circle ({x} mm, {y} mm) radius {radius} mm }}
}}",
            middle + wide / 2.0,
            middle - wide / 2.0,
        )
    }

    fn bump_radius(&self) -> f64 {
        let [deep, wide] = self.bump;
        (wide * wide / 4.0 + deep * deep) / (2.0 * deep)
    }

    /// Walls as places close to each other.
    fn walls(&self) -> Vec<[f64; 2]> {
        let Self {
            sides: [left, right, low, high],
            corner,
            bump: [deep, wide],
            island: [x, y, radius],
            is_open,
        } = *self;
        let middle = f64::midpoint(left, right);
        let mut walls = Vec::new();
        let mut line = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
            let count = ((bx - ax).hypot(by - ay) / 0.05).ceil().max(1.0) as u32;
            walls.extend((0..=count).map(|k| {
                let t = f64::from(k) / f64::from(count);
                [ax + (bx - ax) * t, ay + (by - ay) * t]
            }));
        };
        if is_open {
            line([left, low], [right, low]);
        } else {
            line([left, low], [right - corner, low]);
            line([right, low + corner], [right, high]);
        }
        line([right, high], [middle + wide / 2.0, high]);
        line([middle - wide / 2.0, high], [left, high]);
        line([left, high], [left, low]);
        let mut arc = |[cx, cy]: [f64; 2], radius: f64, [from, to]: [f64; 2]| {
            let count = ((to - from).abs() * radius / 0.05).ceil() as u32;
            walls.extend((0..=count).map(|k| {
                let angle = from + (to - from) * f64::from(k) / f64::from(count);
                [cx + radius * angle.cos(), cy + radius * angle.sin()]
            }));
        };
        let turn = core::f64::consts::TAU;
        if !is_open {
            arc([right - corner, low + corner], corner, [0.75 * turn, turn]);
        }
        arc([x, y], radius, [0.0, turn]);
        let bump = self.bump_radius();
        let half = (wide / 2.0 / bump).asin();
        arc(
            [middle, high - deep + bump],
            bump,
            [0.75 * turn - half, 0.75 * turn + half],
        );
        walls
    }
}

fn job(region: &str, more: &str) -> String {
    format!(
        "job \"seat\"
stock {{ size = (120 mm, 90 mm, {HEIGHT} mm) }}
blade dagger {{ cutting_length = 25 mm, half_apex = {HALF_APEX} deg, thickness = {THICKNESS} mm, edges = double }}
{region}
slit walls {{
  region = seat
  blade = dagger
  floor = {FLOOR} mm
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

fn codes(outcome: &Outcome) -> Vec<Code> {
    outcome.diagnostics.iter().map(|found| found.code).collect()
}

fn program_of(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

/// Places of the blade's flat sides, below the top of the stock, at many times of all ways through the work; and the tip at its floor.
fn blade(program: &Program) -> (Vec<[f64; 3]>, Vec<[f64; 2]>) {
    let (mut places, mut tips) = (Vec::new(), Vec::new());
    for segment in program.segments() {
        let (Site::Cut { .. }, Action::Follow { .. }) = (segment.op.site, segment.op.action) else {
            continue;
        };
        let line = segment.line().unwrap();
        let count = (line.length().to_mm() / 0.25).ceil().max(8.0) as u32;
        for step in 0..=count {
            let frame = line
                .frame_at(program, f64::from(step) / f64::from(count))
                .unwrap();
            let matrix = frame.orientation.matrix();
            let tip = [frame.origin.x, frame.origin.y, frame.origin.z];
            if (tip[2] - FLOOR).abs() < 1e-6 {
                tips.push([tip[0], tip[1]]);
            }
            // The blade in its own frame: x towards the leading edge, y off its plane, z out through the tip.
            for along in (0..=10).map(|k| 2.5 * f64::from(k)) {
                let wide = along * HALF_APEX.to_radians().tan();
                for across in [-1.0, -0.5, 0.0, 0.5, 1.0] {
                    for side in [-0.5, 0.5] {
                        let own = [across * wide, side * THICKNESS, -along];
                        let place: [f64; 3] = core::array::from_fn(|row| {
                            tip[row]
                                + (0..3)
                                    .map(|column| matrix[row][column] * own[column])
                                    .sum::<f64>()
                        });
                        if place[2] <= HEIGHT {
                            places.push(place);
                        }
                    }
                }
            }
        }
    }
    (places, tips)
}

/// No place of the blade crosses a wall, which its places on both sides of it would show: every place lies within the region, by
/// at least what samples of walls can say, or beyond the open side.
fn slits(region: Region, allowance: f64) -> Result<(), TestCaseError> {
    let text = job(
        &region.text(),
        &format!("allowance = {allowance} mm, limits {{ residual <= 0.4 mm }}"),
    );
    let outcome = compiled(&text);
    prop_assert!(
        !has_errors(&outcome.diagnostics),
        "{:?}\n{text}",
        outcome.diagnostics.first()
    );
    let (places, tips) = blade(program_of(&outcome));
    for [x, y, z] in places {
        prop_assert!(z >= FLOOR - 1e-9);
        let inside = region.depth([x, y]);
        prop_assert!(
            inside >= allowance - 1e-6,
            "({x}, {y}, {z}) is {inside} mm inside"
        );
    }
    for [x, y] in region.walls() {
        let near = tips
            .iter()
            .map(|tip| (tip[0] - x).hypot(tip[1] - y))
            .fold(f64::INFINITY, f64::min);
        let stays = near - THICKNESS / 2.0 - allowance;
        // Samples of ways are an eighth of a millimetre off at most.
        prop_assert!(stays <= 0.4 + 0.02, "{stays} mm stay at ({x}, {y})");
    }
    let slit = outcome.compiled.as_ref().unwrap().report.slit[0];
    prop_assert!(slit.to_wall.to_mm() >= allowance && slit.stays.to_mm() <= 0.4);
    Ok(())
}

impl Region {
    /// How far a place is inside of the walls, negative beyond them; beyond the open side it is inside.
    fn depth(&self, [x, y]: [f64; 2]) -> f64 {
        let Self {
            sides: [left, right, low, high],
            corner,
            bump: [deep, wide],
            island: [ix, iy, radius],
            is_open,
        } = *self;
        let middle = f64::midpoint(left, right);
        let mut depth = (x - left).min(y - low).min(high - y);
        if !is_open {
            depth = depth.min(right - x);
            let (cx, cy) = (right - corner, low + corner);
            if x > cx && y < cy {
                depth = depth.min(corner - (x - cx).hypot(y - cy));
            }
        }
        depth = depth.min((x - ix).hypot(y - iy) - radius);
        let bump = self.bump_radius();
        if (x - middle).abs() < wide / 2.0 {
            depth = depth.min((x - middle).hypot(y - (high - deep + bump)) - bump);
        }
        depth
    }
}

fn regions() -> impl Strategy<Value = Region> {
    let round = |value: f64| (value * 1e3).round() / 1e3;
    (
        (8.0..20.0_f64, 95.0..110.0_f64, 8.0..15.0_f64, 70.0..80.0_f64),
        9.0..30.0_f64,
        (3.0..8.0_f64, 20.0..40.0_f64),
        (45.0..65.0_f64, 32.0..40.0_f64, 3.0..10.0_f64),
        any::<bool>(),
    )
        .prop_map(
            move |((left, right, low, high), corner, (deep, wide), (x, y, radius), is_open)| Region {
                sides: [left, if is_open { 120.0 } else { right }, low, high].map(round),
                corner: round(corner),
                bump: [deep, wide].map(round),
                island: [x, y, radius].map(round),
                is_open,
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn the_blade_stays_out_of_walls_and_parts_them(
        region in regions(),
        allowance in prop::sample::select(vec![0.0, 0.3]),
    ) {
        slits(region, allowance)?;
    }
}

const PLAIN: Region = Region {
    sides: [15.0, 105.0, 12.0, 75.0],
    corner: 40.0,
    bump: [5.0, 30.0],
    island: [55.0, 35.0, 8.0],
    is_open: false,
};

fn plain() -> Outcome {
    compiled(&job(&PLAIN.text(), ""))
}

fn faults_of(outcome: &Outcome, change: impl Fn(&mut Program)) -> Vec<SlitFault> {
    let mut program = program_of(outcome).clone();
    change(&mut program);
    let verified = verify(program).expect("only the proof has something against it");
    let findings: Findings = replay(outcome.plan.as_ref().unwrap(), &verified).findings;
    let faults = findings.iter().filter_map(|(_, finding)| match finding.fault {
        CutFault::Slit(fault) => Some(fault),
        _ => None,
    });
    faults.collect()
}

/// Moves everything. All pieces end in a stop then, so that no joint has to be smooth.
fn moved(program: &mut Program, [x, y, z]: [f64; 3]) {
    let change = |at: &mut vcutc_backend_api::geometry::Point3| {
        (at.x, at.y) = (at.x + x, at.y + y);
        if at.z < HEIGHT - 1.0 {
            at.z += z;
        }
    };
    for op in &mut program.ops {
        match &mut op.action {
            Action::Follow { to, joint, .. } => {
                *joint = Joint::Stop;
                change(to);
            }
            Action::Approach { to, .. }
            | Action::Travel { to, .. }
            | Action::Retract { to, .. }
            | Action::AxisTravel { to, .. } => change(to),
            _ => {}
        }
    }
    program.vias.iter_mut().for_each(change);
}

#[test]
fn a_program_moved_by_micrometres_enters_a_wall() {
    let outcome = plain();
    assert_eq!(faults_of(&outcome, |_| {}), []);
    // Slits keep 4 um more than they must, and 5 um for what a control cuts off at joints.
    let by = |micrometres: f64| faults_of(&outcome, |program| moved(program, [micrometres * 1e-3, 0.0, 0.0]));
    assert_eq!(by(2.0), []);
    let found = by(8.0);
    assert!(
        matches!(found.as_slice(), [SlitFault::Wall { by }] if (1e-3..4e-3).contains(&by.to_mm())),
        "{found:?}"
    );
}

#[test]
fn a_program_lowered_goes_below_the_floor_and_one_raised_leaves_the_foot() {
    let outcome = plain();
    let lowered = faults_of(&outcome, |program| moved(program, [0.0, 0.0, -0.01]));
    assert!(
        lowered
            .iter()
            .any(|fault| matches!(fault, SlitFault::Floor { .. })),
        "{lowered:?}"
    );
    let raised = faults_of(&outcome, |program| moved(program, [0.0, 0.0, 0.01]));
    assert!(
        matches!(raised.as_slice(), [SlitFault::Stays { by, .. }] if !by.is_finite()),
        "{raised:?}"
    );
}

/// Without one of the slits its wall is not parted.
#[test]
fn a_program_that_leaves_out_a_slit_leaves_a_wall() {
    let outcome = plain();
    let cut = |op: &vcutc_backend_api::ir::Op| match op.site {
        Site::Cut { cut, .. } => Some(cut.get()),
        _ => None,
    };
    let last = program_of(&outcome).ops.iter().filter_map(cut).max();
    let found = faults_of(&outcome, |program| {
        program.ops.retain(|op| cut(op).is_none() || cut(op) != last)
    });
    assert!(
        matches!(found.as_slice(), [SlitFault::Stays { by, .. }] if by.to_mm() > 1.0),
        "{found:?}"
    );
}

/// A program whose operation makes no slit at all parts nothing.
#[test]
fn a_program_without_slits_leaves_all_walls() {
    let found = faults_of(&plain(), |program| {
        program.ops.retain(|op| !matches!(op.site, Site::Cut { .. }));
    });
    assert!(
        matches!(found.as_slice(), [SlitFault::Stays { by, .. }] if !by.is_finite()),
        "{found:?}"
    );
}

/// A blade turned out of the plane of its way, as far as chains allow, sweeps more than its outline.
#[test]
fn a_leaning_plane_is_found() {
    let outcome = plain();
    let found = faults_of(&outcome, |program| {
        for orientation in &mut program.orientations {
            let [w, x, y, z] = orientation.quaternion();
            let (s, c) = (0.001_f64.sin(), 0.001_f64.cos());
            // About x, by two thousandths.
            let turned = [c * w - s * x, c * x + s * w, c * y - s * z, c * z + s * y];
            let [w, x, y, z] = turned;
            *orientation = vcutc_backend_api::geometry::Orientation::from_quaternion(w, x, y, z).unwrap();
        }
    });
    assert!(found.contains(&SlitFault::Strays), "{found:?}");
}

#[test]
fn values_that_are_offered_for_a_hollow_wall_work() {
    let hollow = |radius: f64| {
        let corner = |at: f64| at - radius;
        format!(
            "region seat {{ start (10 mm, 10 mm) line to (90 mm, 10 mm) line to (90 mm, {} mm) arc to ({} mm, 60 mm) radius {radius} mm line to (10 mm, 60 mm) }}",
            corner(60.0),
            corner(90.0)
        )
    };
    let tight = compiled(&job(&hollow(10.0), ""));
    assert_eq!(codes(&tight), [Code::WallLeft]);
    let help = format!("{:?}", tight.diagnostics[0]);
    assert!(
        help.contains("at least 35.22 mm") && help.contains("a floor at 19.37 mm or above"),
        "{help}"
    );
    let with_floor =
        |floor: &str| job(&hollow(10.0), "").replace("floor = 10 mm", &format!("floor = {floor} mm"));
    for (text, is_good) in [
        (job(&hollow(35.22), ""), true),
        (job(&hollow(34.0), ""), false),
        (with_floor("19.37"), true),
        (with_floor("19.1"), false),
        (job(&hollow(10.0), "limits { residual <= 0.33 mm }"), true),
    ] {
        let outcome = compiled(&text);
        assert_eq!(
            !has_errors(&outcome.diagnostics),
            is_good,
            "{text}\n{:?}",
            codes(&outcome)
        );
    }
}

/// Walls in all directions, short and long: rounding of points turns none of them into a wall.
#[test]
fn short_walls_in_all_directions_are_slit() {
    for (number, side) in [8.0, 15.0, 30.0, 45.0].into_iter().enumerate() {
        for turn in 0..6 {
            let angle = 0.1 + f64::from(turn) * 0.37 + number as f64 * 0.05;
            let corners = (0..4).map(|corner| {
                let at = angle + f64::from(corner) * core::f64::consts::FRAC_PI_2;
                let round = |value: f64| (value * 1e4).round() / 1e4;
                let far = side / 2.0_f64.sqrt();
                format!(
                    "({} mm, {} mm)",
                    round(60.0 + far * at.cos()),
                    round(45.0 + far * at.sin())
                )
            });
            let corners: Vec<String> = corners.collect();
            let region = format!(
                "region seat {{ start {} line to {} }}",
                corners[0],
                corners[1..].join(" line to ")
            );
            let outcome = compiled(&job(&region, ""));
            assert!(
                !has_errors(&outcome.diagnostics),
                "{region}: {:?}",
                outcome.diagnostics.first()
            );
        }
    }
}

/// An operation finds the blade as it holds it, however the slits before it have turned it.
#[test]
fn roughing_goes_on_after_slits_around() {
    let text = job(
        "region seat { circle (60 mm, 45 mm) radius 35 mm }",
        "limits { residual <= 0.2 mm }",
    )
    .replace(
        "slit walls",
        "profile { start (0 mm, 24 mm) line to (120 mm, 28 mm) }\nslit walls",
    ) + "rough vcut {
  blade = dagger
  rake = 60 deg
  feed { cut = 75 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";
    let outcome = compiled(&text);
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
}

/// With an allowance the corners of the wall are farther from the slits than its sides, and nothing stays beyond it.
#[test]
fn a_wide_allowance_leaves_no_more() {
    let region = "region seat { start (10 mm, 10 mm) line to (110 mm, 10 mm) line to (110 mm, 80 mm) line to (10 mm, 80 mm) }";
    for allowance in ["0.5", "1", "12"] {
        let outcome = compiled(&job(
            region,
            &format!("allowance = {allowance} mm, limits {{ residual <= 0.02 mm }}"),
        ));
        assert!(
            !has_errors(&outcome.diagnostics),
            "{allowance}: {:?}",
            outcome.diagnostics
        );
    }
}

#[test]
fn the_floor_that_is_offered_is_within_the_edge() {
    let short = job(&PLAIN.text(), "").replace("cutting_length = 25 mm", "cutting_length = 18 mm");
    let outcome = compiled(&short);
    assert_eq!(codes(&outcome), [Code::LayerTooThick]);
    let help = format!("{:?}", outcome.diagnostics[0]);
    assert!(help.contains("a floor at 12.56 mm or above"), "{help}");
    let with_floor = |floor: &str| compiled(&short.replace("floor = 10 mm", &format!("floor = {floor} mm")));
    assert!(!has_errors(&with_floor("12.56").diagnostics));
    assert_eq!(codes(&with_floor("12.5")), [Code::LayerTooThick]);
}

/// A shaft wider than the slit cannot go into it.
#[test]
fn a_body_below_the_top_of_the_wall_is_found() {
    let with = |body: &str| {
        job(&PLAIN.text(), "").replace("edges = double", &format!("edges = double, body {body}"))
    };
    let wide = compiled(&with("(25 mm, 9 mm)"));
    assert!(!has_errors(&wide.diagnostics), "{:?}", codes(&wide));
    // Where the blade leans by its half apex angle the rim of a wide holder is lower than its middle.
    let wider = compiled(&with("(25 mm, 60 mm)"));
    assert_eq!(codes(&wider), [Code::BodyInWork]);
}

#[test]
fn walls_and_pocket_have_one_program() {
    let text = job(&PLAIN.text(), "")
        + "blade hog = crusher { radius = 6 mm, height = 24 mm, spin = 18000 rev/min, ramp = 5 deg }
clear pocket {
  region = seat
  blade = hog
  floor = 10 mm
  feed { cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";
    let outcome = compiled(&text);
    assert!(!has_errors(&outcome.diagnostics), "{:?}", codes(&outcome));
    let report = &outcome.compiled.as_ref().unwrap().report;
    assert_eq!((report.slit.len(), report.cleared.len()), (1, 1));
    let alone = compiled(&job(&PLAIN.text(), ""));
    assert_eq!(alone.compiled.as_ref().unwrap().report.slit, report.slit);
}
