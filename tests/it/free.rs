//! Pockets that are freed strip by strip: an oracle that knows points of the ground, and whether lines between them cross a slit; programs
//! that were changed; and the limits that messages offer.

use crate::pipeline::{Files, compile, emit_for};
use crate::repository::root;
use crate::seen_from_above::{Spot, distance, to_segment};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::OnceLock;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::process::verdict::replay;
use vcutc::simulation::prove::{ClearingFault, CutFault, Findings, SlitFault};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Program, Site};
use vcutc_backend_api::verify::verify;

const HEIGHT: f64 = 30.0;
const FLOOR: f64 = 10.0;
const HALF_APEX: f64 = 7.13;
const THICKNESS: f64 = 1.5;
const WIDTH: f64 = 180.0;
const DEPTH: f64 = 180.0;
const AIR: f64 = 1.0;

/// A bay that is open at x = 180, convex beyond that side.
#[derive(Clone, Debug)]
struct Bay {
    /// Its corners, the first and the last at the open side.
    corners: Vec<Spot>,
    /// Other sides that are open, each by the corner where it begins.
    open: &'static [usize],
    /// The radius of the disc, and of its shank.
    radius: f64,
    shank: f64,
    more: &'static str,
}

impl Bay {
    fn text(&self) -> String {
        let place = |[x, y]: Spot| format!("({x} mm, {y} mm)");
        let [first, rest @ ..] = self.corners.as_slice() else {
            unreachable!()
        };
        let sides = rest.iter().enumerate();
        let walls: String = sides
            .map(|(side, at)| {
                let word = if self.open.contains(&side) { "open" } else { "line" };
                format!("  {word} to {}\n", place(*at))
            })
            .collect();
        let Self {
            radius, shank, more, ..
        } = self;
        format!(
            "job \"bay\"
stock {{ size = ({WIDTH} mm, {DEPTH} mm, {HEIGHT} mm) }}
blade dagger {{ cutting_length = 30 mm, half_apex = {HALF_APEX} deg, thickness = {THICKNESS} mm, edges = double }}
blade wheel = disc {{ radius = {radius} mm, thickness = 1.2 mm, depth = 10 mm, width = 20 mm, spin = 3000 rev/min,
  body (1.2 mm, {shank} mm) (40 mm, {radius} mm) }}
region bay {{
  start {}
{walls}  open to {}
}}
free pocket {{
  region = bay
  blade = dagger
  disc = wheel
  floor = {FLOOR} mm
  {more}
  feed {{ cut = 150 mm/s, free = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
",
            place(*first),
            place(*first)
        )
    }

    fn walls(&self) -> Vec<[Spot; 2]> {
        let sides = self.corners.windows(2).enumerate();
        let walls = sides.filter(|(side, _)| !self.open.contains(side));
        walls.map(|(_, ends)| [ends[0], ends[1]]).collect()
    }

    fn contains(&self, [x, y]: Spot) -> bool {
        let next = self.corners.iter().cycle().skip(1);
        let crossings = self.corners.iter().zip(next).filter(|(a, b)| {
            (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        });
        crossings.count() % 2 == 1
    }

    fn to_wall(&self, at: Spot) -> f64 {
        let walls = self.walls().into_iter().map(|wall| to_segment(at, wall));
        walls.fold(f64::INFINITY, f64::min)
    }

    fn assert_comes_free(&self) {
        let outcome = compiled(&self.text());
        assert!(
            !has_errors(&outcome.diagnostics),
            "{}\n{:?}",
            self.text(),
            outcome.diagnostics.first()
        );
        assert_frees(self, program(&outcome));
    }

    /// What a round rim leaves in the corners of the walls, in mm2.
    fn pillars(&self) -> f64 {
        let corners = self.corners.windows(3).enumerate();
        let corners =
            corners.filter(|(side, _)| [*side, side + 1].iter().all(|side| !self.open.contains(side)));
        let corners = corners.map(|(_, at)| {
            let direction = |a: Spot, b: Spot| (b[1] - a[1]).atan2(b[0] - a[0]);
            let turn = (direction(at[1], at[2]) - direction(at[0], at[1])).rem_euclid(core::f64::consts::TAU);
            // A corner that points into the bay leaves none.
            let half = (core::f64::consts::PI - turn).max(0.0) / 2.0;
            if half == 0.0 {
                return 0.0;
            }
            self.radius.powi(2) * (1.0 / half.tan() - (core::f64::consts::FRAC_PI_2 - half))
        });
        corners.sum()
    }
}

fn compiled(text: &str) -> Outcome {
    let files = Files::of(root().join("examples")).with("bay.vcut", text);
    compile("bay.vcut", &files)
}

fn program(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

/// A way of a blade at depth: its layer, the places of the tip, and where the blade has its normal and its edges.
struct Way {
    layer: u32,
    is_disc: bool,
    places: Vec<Spot>,
    height: f64,
    /// The corners of the straight blade at the top of the stock, at each place.
    corners: Vec<Spot>,
}

/// All ways at depth, in the order of the program, each piece by itself.
fn ways(program: &Program) -> Vec<Way> {
    let mut ways = Vec::new();
    for segment in program.segments() {
        let (Site::Cut { layer, .. }, Action::Follow { .. }) = (segment.op.site, segment.op.action) else {
            continue;
        };
        let line = segment.line().unwrap();
        let [from, to] = [line.from.tip, line.to.tip];
        if (from.z - to.z).abs() > 1e-9 {
            continue;
        }
        let straight = program.blade(segment.before.tool).unwrap().straight();
        let held = [line.from, line.to].map(|pose| program.orientation(pose.orientation).unwrap().matrix());
        let arc = line.arc();
        let long = arc.map_or_else(
            || from.distance(to).to_mm(),
            |arc| arc.radius().to_mm() * arc.sweep().to_rad(),
        );
        let count = (long / 0.1).ceil().max(1.0) as u32;
        let mut way = Way {
            layer: layer.get(),
            is_disc: straight.is_none(),
            places: Vec::new(),
            height: from.z,
            corners: Vec::new(),
        };
        for k in 0..=count {
            let t = f64::from(k) / f64::from(count);
            let at: Spot = match arc {
                Some(arc) => {
                    let [x, y, _] = arc.at(arc.sweep().to_rad() * t);
                    [x, y]
                }
                None => [from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t],
            };
            way.places.push(at);
            // Between the ends of an arc the blade turns with it; its corners are looked at at both ends.
            let end = if k == 0 { 0 } else { 1 };
            if straight.is_some() && (k == 0 || k == count || arc.is_none() && held[0] == held[1]) {
                let matrix = held[end];
                let axis = |column: usize| [matrix[0][column], matrix[1][column], matrix[2][column]];
                let [ahead, aside, down] = [axis(0), axis(1), axis(2)];
                let (sin, cos) = HALF_APEX.to_radians().sin_cos();
                for side in [1.0, -1.0] {
                    let edge: [f64; 3] =
                        core::array::from_fn(|row| side * sin * ahead[row] - cos * down[row]);
                    let up = (HEIGHT - from.z) / edge[2];
                    for half in [THICKNESS / 2.0, -THICKNESS / 2.0] {
                        let corner = |row: usize| at[row] + edge[row] * up + half * aside[row];
                        way.corners.push([corner(0), corner(1)]);
                    }
                }
            }
        }
        ways.push(way);
    }
    ways
}

/// Distance of points of the ground, in mm.
const APART: f64 = 0.8;

/// Points of the ground of a layer, and what holds them.
struct Ground {
    columns: usize,
    points: Vec<Option<Spot>>,
    /// Whether the lines from each point to the next one along x, and along y, cross a slit.
    is_parted: Vec<[bool; 2]>,
    is_undercut: Vec<bool>,
    stands: Vec<bool>,
}

fn crosses([a, b]: [Spot; 2], [c, d]: [Spot; 2]) -> bool {
    let side = |p: Spot, q: Spot, r: Spot| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

/// Whether a place lies beside a piece of a way, within half the thickness of the blade.
fn is_passed(at: Spot, [a, b]: [Spot; 2]) -> bool {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let along = (at[0] - a[0]) * dx + (at[1] - a[1]) * dy;
    (0.0..=dx * dx + dy * dy).contains(&along) && to_segment(at, [a, b]) < THICKNESS / 2.0
}

impl Ground {
    fn of(bay: &Bay, slits: &[&Way]) -> Self {
        let columns = (WIDTH / APART) as usize;
        let rows = (DEPTH / APART) as usize;
        let at = |square: usize| -> Spot {
            let of = |number: usize| (number as f64 + 0.317) * APART;
            [of(square % columns), of(square / columns)]
        };
        let mut points: Vec<Option<Spot>> = (0..columns * rows)
            .map(|square| Some(at(square)).filter(|at| bay.contains(*at)))
            .collect();
        let mut is_parted = vec![[false; 2]; points.len()];
        for slit in slits {
            let mut places = slit.places.clone();
            let others = || slits.iter().filter(|other| !core::ptr::eq(**other, *slit));
            // Slits that continue into each other meet where each of them ends; one that ends within the width of another one meets it.
            let beyond = |a: Spot, b: Spot| {
                let meets = others().any(|other| {
                    let mut along = other.places.windows(2);
                    along.any(|ends| to_segment(a, [ends[0], ends[1]]) < THICKNESS / 2.0)
                });
                let by = if meets { THICKNESS } else { 0.1 } / distance(a, b);
                [a[0] + (a[0] - b[0]) * by, a[1] + (a[1] - b[1]) * by]
            };
            places.insert(0, beyond(places[0], places[1]));
            places.push(beyond(places[places.len() - 1], places[places.len() - 2]));
            for ends in places.windows(2) {
                let number = |value: f64| ((value / APART - 0.317).floor() as i64 - 1).max(0) as usize;
                let low = [0, 1].map(|axis| number(ends[0][axis].min(ends[1][axis])));
                for row in low[1]..(low[1] + 4).min(rows) {
                    for column in low[0]..(low[0] + 4).min(columns) {
                        let square = row * columns + column;
                        for (axis, next) in [(0, square + 1), (1, square + columns)] {
                            is_parted[square][axis] |= crosses([at(square), at(next)], [ends[0], ends[1]]);
                        }
                    }
                }
            }
        }
        // What the blade passes is gone, half its thickness to either side of its way.
        for slit in slits {
            for ends in slit.places.windows(2) {
                let number =
                    |value: f64| ((value - THICKNESS / 2.0) / APART - 0.317).ceil().max(0.0) as usize;
                let low = [0, 1].map(|axis| number(ends[0][axis].min(ends[1][axis])));
                for row in low[1]..(low[1] + 4).min(rows) {
                    for column in low[0]..(low[0] + 4).min(columns) {
                        let point = &mut points[row * columns + column];
                        *point = point.filter(|at| !is_passed(*at, [ends[0], ends[1]]));
                    }
                }
            }
        }
        let count = points.len();
        Self {
            columns,
            stands: points.iter().map(Option::is_some).collect(),
            points,
            is_parted,
            is_undercut: vec![false; count],
        }
    }

    fn undercut(&mut self, way: &Way, radius: f64) {
        for (point, is_undercut) in self.points.iter().zip(&mut self.is_undercut) {
            let Some(at) = point else { continue };
            *is_undercut = *is_undercut || way.places.iter().any(|place| distance(*at, *place) <= radius);
        }
    }

    /// What hangs together with a point that is not undercut stands.
    fn spread(&mut self) {
        let stood = self.stands.clone();
        let mut open: Vec<usize> = (0..self.points.len())
            .filter(|&at| stood[at] && !self.is_undercut[at])
            .collect();
        self.stands = vec![false; stood.len()];
        for &at in &open {
            self.stands[at] = true;
        }
        while let Some(at) = open.pop() {
            let columns = self.columns;
            let mut links = vec![(at + columns, self.is_parted[at][1])];
            // A row of points ends at the sides of the stock.
            if (at + 1) % columns > 0 {
                links.push((at + 1, self.is_parted[at][0]));
            }
            if at % columns > 0 {
                links.push((at - 1, self.is_parted[at - 1][0]));
            }
            if at >= columns {
                links.push((at - columns, self.is_parted[at - columns][1]));
            }
            for (next, is_parted) in links {
                if next < stood.len() && !is_parted && stood[next] && !self.stands[next] {
                    self.stands[next] = true;
                    open.push(next);
                }
            }
        }
    }

    fn standing(&self) -> impl Iterator<Item = Spot> {
        self.points
            .iter()
            .zip(&self.stands)
            .filter_map(|(at, stands)| at.filter(|_| *stands))
    }
}

/// What an oracle says of a program: nothing is wrong.
fn assert_frees(bay: &Bay, program: &Program) {
    let ways = ways(program);
    // The rim, and the corners of the blade, never beyond a wall.
    for way in &ways {
        if way.is_disc {
            let near = way
                .places
                .iter()
                .map(|at| bay.to_wall(*at))
                .fold(f64::INFINITY, f64::min);
            assert!(
                near >= bay.radius - 1e-6,
                "the rim is {} mm beyond a wall",
                bay.radius - near
            );
        }
        for corner in &way.corners {
            let is_out = corner[0] >= WIDTH || !bay.open.is_empty() && corner[0] <= 0.0;
            let is_free = bay.contains(*corner) || is_out;
            assert!(
                is_free,
                "the blade is beyond a wall at {corner:?}, {} mm",
                bay.to_wall(*corner)
            );
        }
    }
    let mut layers: BTreeMap<u32, Vec<&Way>> = BTreeMap::new();
    for way in ways.iter().filter(|way| way.is_disc) {
        layers.entry(way.layer).or_default().push(way);
    }
    assert_eq!(layers.len(), 2, "two layers");
    let mut last = HEIGHT;
    for passes in layers.values() {
        let floor = passes[0].height;
        assert!(last - floor <= 10.0 + 1e-9);
        last = floor;
        // Slits before the first pass that reach the floor.
        let first = ways.iter().position(|way| core::ptr::eq(way, passes[0])).unwrap();
        let slits = ways[..first]
            .iter()
            .filter(|way| !way.is_disc && way.height <= floor + 1e-9);
        let mut ground = Ground::of(bay, &slits.collect::<Vec<&Way>>());
        ground.spread();
        for pass in passes {
            let too_near = |ground: &Ground| {
                ground.standing().find(|at| {
                    pass.places
                        .iter()
                        .any(|place| distance(*at, *place) < bay.shank + AIR - 0.02)
                })
            };
            if too_near(&ground).is_some() {
                ground.spread();
            }
            assert_eq!(
                too_near(&ground),
                None,
                "the shank meets ground from {:?}",
                pass.places[0]
            );
            ground.undercut(pass, bay.radius);
        }
        ground.spread();
        // Beside walls ground belongs to their slits.
        let left = ground
            .standing()
            .filter(|at| bay.to_wall(*at) > THICKNESS)
            .count() as f64
            * APART
            * APART;
        assert!(
            left <= bay.pillars() + 2.0,
            "{left} mm2 stand, pillars are {}",
            bay.pillars()
        );
    }
    assert!((last - FLOOR).abs() < 1e-9);
}

fn bays() -> impl Strategy<Value = Bay> {
    let sides = (5.0..30.0_f64, 110.0..170.0_f64, 10.0..50.0_f64);
    // Wider or narrower farther in, with a chamfer and a slanting end.
    let comes_in = (-4.5..40.0_f64, -4.5..40.0_f64, 0.0..20.0_f64, -30.0..30.0_f64);
    let tools = (10.5..16.0_f64, 0.2..0.33_f64);
    let more = prop_oneof![
        Just(""),
        Just("chip = 40 mm"),
        Just("through = 2"),
        Just("step = 5 mm")
    ];
    (sides, comes_in, tools, more).prop_map(
        |((low, high, end), (lower, upper, chamfer, slant), (radius, share), more)| {
            let round = |value: f64| (value * 100.0).round() / 100.0;
            let mut corners = vec![[WIDTH, high]];
            // The end is a few millimetres wide at least, and corners are convex.
            let most = (high - low - 30.0) / 2.0;
            let (lower, upper) = (lower.min(most), upper.min(most));
            if chamfer > 5.0 {
                corners.push([end + chamfer, high - upper]);
                corners.push([end, high - upper - chamfer]);
                corners.push([end, low + lower]);
            } else {
                corners.push([end + slant.max(0.0), high - upper]);
                corners.push([end - slant.min(0.0), low + lower]);
            }
            corners.push([WIDTH, low]);
            Bay {
                corners: corners.into_iter().map(|at| at.map(round)).collect(),
                open: &[],
                radius: round(radius),
                shank: round(radius * share),
                more,
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn strips_come_free(bay in bays()) {
        bay.assert_comes_free();
    }
}

/// Walls that open farther in, by less than a blade can follow as an arc, and by more.
#[test]
fn bays_that_open_farther_in_come_free() {
    for wider in [0.05, 1.0, 4.0, 12.0] {
        let corners = [[WIDTH, 150.0], [40.0, 150.0 + wider], [40.0, 20.0], [WIDTH, 20.0]];
        let corners = corners.to_vec();
        Bay { corners, ..plain() }.assert_comes_free();
    }
}

/// Convex bays that narrow to corners of less than 60 deg, into which the disc has to go on level by level.
#[test]
fn acute_corners_come_free() {
    let bays: [([Spot; 4], [f64; 2]); 2] = [
        (
            [[WIDTH, 115.41], [11.59, 90.68], [33.15, 66.31], [WIDTH, 21.76]],
            [9.89, 2.11],
        ),
        (
            [[WIDTH, 112.21], [21.65, 85.82], [87.24, 64.75], [WIDTH, 31.68]],
            [14.35, 4.4],
        ),
    ];
    for (corners, [radius, shank]) in bays {
        let bay = Bay {
            corners: corners.to_vec(),
            radius,
            shank,
            more: "through = 2",
            ..plain()
        };
        bay.assert_comes_free();
    }
}

/// A strip from one side of the stock to the other, open at both ends.
#[test]
fn a_strip_that_is_open_at_both_ends_comes_free() {
    let bay = Bay {
        corners: vec![[WIDTH, 150.0], [0.0, 140.0], [0.0, 30.0], [WIDTH, 20.0]],
        open: &[1],
        ..plain()
    };
    bay.assert_comes_free();
}

fn plain() -> Bay {
    Bay {
        corners: vec![
            [WIDTH, 150.0],
            [60.0, 150.0],
            [40.0, 130.0],
            [40.0, 20.0],
            [WIDTH, 20.0],
        ],
        open: &[],
        radius: 12.5,
        shank: 4.0,
        more: "",
    }
}

/// The plain one, compiled once.
fn outcome() -> &'static Outcome {
    static OUTCOME: OnceLock<Outcome> = OnceLock::new();
    OUTCOME.get_or_init(|| compiled(&plain().text()))
}

fn faults(findings: &Findings) -> Vec<CutFault> {
    findings.iter().map(|(_, finding)| finding.fault).collect()
}

/// What the proof finds in the program of the plain one, changed.
fn found(change: impl Fn(&mut Program)) -> Vec<CutFault> {
    let mut changed = program(outcome()).clone();
    change(&mut changed);
    let verified = verify(changed).unwrap();
    faults(&replay(outcome().plan.as_ref().unwrap(), &verified).findings)
}

/// Moves all of a cut of the first layer that is at depth.
fn moved(program: &mut Program, number: u32, by: impl Fn(&mut Point3)) {
    let mut count = 0;
    for op in &mut program.ops {
        let Site::Cut { layer, cut, .. } = op.site else {
            continue;
        };
        if layer.get() != 1 || cut.get() != number {
            continue;
        }
        let (to, via) = match &mut op.action {
            Action::Follow { to, via, .. } => (to, *via),
            Action::Approach { to, .. } => (to, None),
            _ => continue,
        };
        if to.z < HEIGHT - 1.0 {
            by(to);
            count += 1;
            if let Some(via) = via.and_then(|via| program.vias.get_mut(via.0.get() as usize - 1)) {
                by(via);
            }
        }
    }
    assert!(count > 0);
}

#[test]
fn a_slit_that_is_not_deep_enough_holds_its_strip() {
    // A slit between two rows, or one of the walls: which of them stands in the plan.
    let slits = outcome().compiled.as_ref().unwrap().report.slit[0].slits;
    let mut held = 0;
    // There are two layers of them.
    for slit in 1..=u32::try_from(slits).unwrap() / 4 {
        let found = found(|program| moved(program, slit, |to| to.z += 0.5));
        let is_held = found.iter().any(|fault| {
            matches!(
                fault,
                CutFault::Clearing(ClearingFault::Shank { .. } | ClearingFault::Attached { .. })
            )
        });
        held += u32::from(is_held);
    }
    assert!(held >= 10, "{held} of {slits}");
}

#[test]
fn a_disc_that_comes_too_near_to_a_wall_is_found() {
    let last = program(outcome()).ops.iter().filter_map(|op| match op.site {
        Site::Cut { layer, cut, .. } if layer.get() == 1 => Some(cut.get()),
        _ => None,
    });
    let last = last.max().unwrap();
    let found = found(|program| moved(program, last, |to| to.y += 0.004));
    assert!(
        found.iter().any(
            |fault| matches!(fault, CutFault::Clearing(ClearingFault::Wall { by }) if by.to_mm() < 3e-3)
        ),
        "{found:?}"
    );
    let below = self::found(|program| moved(program, last, |to| to.z -= 0.5));
    assert!(!below.is_empty());
}

#[test]
fn a_slit_that_enters_a_wall_is_found() {
    let is_found = |by: f64| {
        let found = found(|program| moved(program, 1, |to| to.y += by));
        found
            .iter()
            .any(|fault| matches!(fault, CutFault::Slit(SlitFault::Wall { .. })))
    };
    assert!(is_found(0.1) || is_found(-0.1));
}

fn codes(text: &str) -> Vec<Code> {
    compiled(text)
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code)
        .collect()
}

/// What the disc has no way into, each with what is wrong.
#[test]
fn regions_without_a_way_are_refused() {
    let text = plain().text();
    let closed = text.replace("open to (180 mm, 150 mm)", "line to (180 mm, 150 mm)");
    let island = text.replace(
        "open to (180 mm, 150 mm)",
        "open to (180 mm, 150 mm)\n  island { circle (110 mm, 85 mm) radius 10 mm }",
    );
    let wider = text.replace(
        "line to (60 mm, 150 mm)",
        "line to (120 mm, 130 mm)\n  line to (60 mm, 170 mm)",
    );
    for text in [closed, island, wider] {
        assert_eq!(codes(&text), [Code::NoWayForDisc], "{text}");
    }
    let narrow = text
        .replace("150 mm)", "50 mm)")
        .replace("(40 mm, 130 mm)", "(40 mm, 35 mm)");
    assert_eq!(codes(&narrow), [Code::PocketTooNarrow], "{narrow}");
}

/// A blade is longer than thin layers are thick, and may run out by nothing: what of it stands above the stock passes its sides. Slits keep
/// an allowance once.
#[test]
fn thin_layers_no_run_out_and_an_allowance_have_ways() {
    let text = plain().text();
    for (field, value) in [
        ("floor = 10 mm", "floor = 26 mm\n  layer = 2 mm"),
        ("clearance = 10 mm", "clearance = 10 mm\n  run_out = 0 mm"),
        ("clearance = 10 mm", "clearance = 10 mm\n  allowance = 2 mm"),
    ] {
        assert_eq!(codes(&text.replace(field, value)), [], "{value}");
    }
    assert_eq!(
        codes(&text.replace("floor = 10 mm", "floor = 10 mm\n  chip = 1 mm")),
        [Code::OutOfRange]
    );
}

/// The example is tried on robots with the others; here on a gantry that turns the blade about itself.
#[test]
fn a_gantry_frees_the_bay() {
    let machine = "machine bay_gantry = five_axis \"shop/knife_gantry.toml\" {
  tool long_dagger { frame = frame(x = 0 mm, y = 0 mm, z = 160 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 1 }
  tool disc_50 { frame = frame(x = 0 mm, y = 0 mm, z = 160 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 2 }
  change { at = axes(x = 2500 mm, y = -300 mm, z = 200 mm, b = 0 deg, a = 0 deg, c = 0 deg), time = 12 s, by = program }
  base = frame(x = 350 mm, y = 300 mm, z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home = axes(x = 300 mm, y = 200 mm, z = -200 mm, b = 0 deg, a = 0 deg, c = 0 deg)
  ultrasonic = output(3)
  ready = after(1.5 s)
  gcode { dialect = linuxcnc, approximation = 2 mm, tcp_on = (\"M429\"), tcp_off = (\"M428\") }
}
";
    let jobs = crate::shop::jobs();
    let (_, bay) = jobs.iter().find(|(name, _)| name == "bay.vcut").unwrap();
    let on_gantry = bay.replace("machine = changing_cell", "machine = bay_gantry") + machine;
    let files = crate::shop::folder().with("on_gantry.vcut", on_gantry);
    let outcome = compile("on_gantry.vcut", &files);
    assert!(
        !has_errors(&outcome.diagnostics),
        "{:?}",
        outcome.diagnostics.first()
    );
    let mut targets = vcutc::registry::backends().into_iter();
    let target = targets.find(|target| target.id() == "gcode").unwrap();
    assert!(emit_for(target, &outcome).is_ok());
}
