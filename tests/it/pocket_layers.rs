//! Pockets from layers of DXF drawings as engineers draw them, from the file to the program. What a program clears is compared with
//! walls that the test works out from the drawing's own numbers.

use crate::drawn::{Corner, Form, Sheet, regular};
use crate::krl_text;
use crate::pipeline::{Files, compile, emit, rendered};
use crate::repository::{read, root};
use crate::seen_from_above::{Boundary, Spot, distance, ways};
use core::f64::consts::{PI, TAU};
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;

const WIDTH: f64 = 240.0;
const DEPTH: f64 = 180.0;
const FLOOR: f64 = 12.0;
/// Of the shop's smaller crusher.
const RADIUS: f64 = 6.0;

/// A quarter turn as the bulge of a polyline.
const QUARTER: f64 = 0.414_213_562_373_095_03;

const PATTERNS: [&str; 5] = ["offset", "sfs", "zigzag", "field", "auto"];

/// A layer that is cleared.
struct Layer {
    sheet: Sheet,
    name: &'static str,
    /// The layer of open sides, if there is one.
    open: Option<&'static str>,
    /// More fields of the drawing.
    more: &'static str,
    /// How far walls of the region may be from what is drawn, in mm: ends are joined over gaps.
    off: f64,
}

impl Layer {
    fn of(sheet: &Sheet, name: &'static str) -> Self {
        Self {
            sheet: sheet.clone(),
            name,
            open: None,
            more: "",
            off: 0.0,
        }
    }

    fn job(&self, pattern: &str) -> String {
        let open = self.open.map(|open| format!("open = \"{open}\","));
        let drawing = format!(
            "dxf \"plate.dxf\" {{ layer = \"{}\", {} {} }}",
            self.name,
            open.unwrap_or_default(),
            self.more
        );
        job(&drawing, pattern)
    }

    fn compiled(&self, pattern: &str) -> Outcome {
        compiled(&self.job(pattern), &self.sheet.text())
    }

    fn boundary(&self) -> Boundary {
        // Marks of open sides lie on these, which are drawn among the walls too.
        let marks = self.open.map_or_else(Vec::new, |open| self.sheet.sides(open));
        let is_marked = |side: &[Spot; 2]| {
            marks.iter().any(|mark| {
                mark.iter()
                    .all(|end| side.iter().any(|at| distance(*at, *end) < 0.01))
            })
        };
        let (open, walls) = self.sheet.sides(self.name).into_iter().partition(is_marked);
        Boundary::of(walls, open)
    }
}

fn job(drawing: &str, pattern: &str) -> String {
    format!(
        "job \"plate\"
use \"shop/pocket_cells.vcut\"
stock {{ size = ({WIDTH} mm, {DEPTH} mm, 30 mm) }}
region seat {{ {drawing} }}
clear pocket {{
  region = seat
  blade = hog_12
  floor = {FLOOR} mm
  pattern = {pattern}
  feed {{ cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
cell {{ machine = pocket_cell }}
"
    )
}

fn compiled(job: &str, drawing: &str) -> Outcome {
    let files = Files::of(root().join("examples"));
    let files = files.with("job.vcut", job).with("plate.dxf", drawing);
    compile("job.vcut", &files)
}

/// Samples of the tool's ways: none leaves the region or comes too near to a wall, and nothing that the tool reaches stays.
fn assert_cleared(outcome: &Outcome, boundary: &Boundary, off: f64, what: &str) {
    assert!(
        !has_errors(&outcome.diagnostics),
        "{what}: {}",
        rendered(&outcome.diagnostics, outcome)
    );
    let others = |code| code != Code::FieldBroken;
    let mut codes = outcome.diagnostics.iter().map(|found| found.code);
    assert!(
        !codes.any(others),
        "{what}: {}",
        rendered(&outcome.diagnostics, outcome)
    );
    krl_text::check(outcome, &emit(outcome).unwrap());
    let program = outcome.compiled.as_ref().unwrap().program.verified().program();
    let ways = ways(program);
    assert!(!ways.is_empty());
    for (_, at) in &ways {
        assert!(at.z >= FLOOR - 1e-9, "{what}: {at:?}");
        let to_wall = boundary.to_wall([at.x, at.y], RADIUS);
        assert!(
            to_wall >= RADIUS - off - 1e-6,
            "{what}: {at:?} is {to_wall} mm from a wall"
        );
        let is_beside = at.x <= 0.0 || at.y <= 0.0 || at.x >= WIDTH || at.y >= DEPTH;
        assert!(is_beside || boundary.contains([at.x, at.y]), "{what}: {at:?}");
    }
    let flat = ways.iter().filter(|(_, at)| (at.z - FLOOR).abs() < 1e-3);
    let uncut = boundary.uncut(RADIUS, RADIUS, flat.map(|(_, at)| [at.x, at.y]));
    // Without a limit of the job 1 mm2 may stay.
    assert!(uncut <= 1.0, "{what}: {uncut} mm2 stay");
}

/// All patterns clear a layer, whose area is known.
fn clears(layer: &Layer, area: Option<f64>) {
    let boundary = layer.boundary();
    if let Some(area) = area {
        let found = boundary.area();
        assert!((found - area).abs() < 1e-3 * area, "{}: {found} mm2", layer.name);
    }
    for pattern in PATTERNS {
        let what = format!("{} by {pattern}", layer.name);
        assert_cleared(&layer.compiled(pattern), &boundary, layer.off, &what);
    }
}

/// Lines and arcs in no order and in both directions, around a circle and a square.
fn frame(sheet: &mut Sheet) -> Layer {
    let name = "FRAME";
    sheet.arc(name, [125.0, 35.0], 15.0, [270.0, 0.0]);
    sheet.line(name, [35.0, 100.0], [125.0, 100.0]);
    sheet.line(name, [140.0, 35.0], [140.0, 85.0]);
    sheet.circle(name, [60.0, 60.0], 9.0);
    sheet.arc(name, [35.0, 85.0], 15.0, [90.0, 180.0]);
    sheet.line(name, [35.0, 20.0], [125.0, 20.0]);
    let square = [[95.0, 50.0], [115.0, 50.0], [115.0, 70.0], [95.0, 70.0]];
    sheet.line(name, square[2], square[1]);
    sheet.line(name, square[0], square[1]);
    sheet.arc(name, [125.0, 85.0], 15.0, [0.0, 90.0]);
    sheet.line(name, [20.0, 85.0], [20.0, 35.0]);
    sheet.line(name, square[3], square[2]);
    sheet.arc(name, [35.0, 35.0], 15.0, [180.0, 270.0]);
    sheet.line(name, square[0], square[3]);
    Layer::of(sheet, name)
}

/// A polyline with bulges that goes round to the right, around a slot and a hexagon.
fn seat(sheet: &mut Sheet) -> Layer {
    let name = "SEAT";
    let outline = [
        (20.0, 30.0, 0.0),
        (20.0, 120.0, QUARTER * 0.5),
        (150.0, 120.0, -QUARTER),
        (170.0, 100.0, 0.0),
        (170.0, 30.0, 0.0),
    ];
    sheet.polyline(name, Form::Light, &outline);
    let slot = [
        (50.0, 52.0, 0.0),
        (80.0, 52.0, 1.0),
        (80.0, 68.0, 0.0),
        (50.0, 68.0, 1.0),
    ];
    sheet.polyline(name, Form::Light, &slot);
    sheet.polyline(name, Form::Light, &regular([125.0, 75.0], 14.0, 6));
    Layer::of(sheet, name)
}

/// A full circle drawn as two arcs, around an ellipse.
fn round(sheet: &mut Sheet) -> Layer {
    let name = "ROUND";
    let centre = [120.0, 90.0];
    sheet.arc(name, centre, 55.0, [10.0, 190.0]);
    sheet.ellipse(name, [115.0, 95.0], ([18.0, 6.0], 0.5), [0.0, TAU]);
    sheet.arc(name, centre, 55.0, [190.0, 10.0]);
    Layer::of(sheet, name)
}

/// Half of an ellipse, a spline, and lines.
fn spoon(sheet: &mut Sheet) -> Layer {
    let name = "SPOON";
    sheet.line(name, [60.0, 30.0], [160.0, 30.0]);
    sheet.ellipse(name, [60.0, 75.0], ([0.0, 45.0], 0.8), [0.0, PI]);
    let controls = [
        [60.0, 120.0],
        [85.0, 120.0],
        [95.0, 95.0],
        [120.0, 80.0],
        [140.0, 110.0],
        [160.0, 110.0],
    ];
    sheet.spline(name, &controls);
    sheet.line(name, [160.0, 110.0], [160.0, 30.0]);
    Layer::of(sheet, name)
}

/// A keyhole with a boss and a bone, as blocks: one turned and mirrored, the other stretched.
fn blocks(sheet: &mut Sheet) -> Layer {
    sheet.block("KEYHOLE", |sheet| {
        // A circle of 30 mm about the origin that opens into a neck 18 mm wide, which ends in a half circle.
        let aside = 9.0;
        let angle = (aside / 30.0_f64).asin();
        let out = 30.0 * angle.cos();
        let around = ((TAU - 2.0 * angle) / 4.0).tan();
        let keyhole: [Corner; 4] = [
            (out, aside, around),
            (out, -aside, 0.0),
            (60.0, -aside, 1.0),
            (60.0, aside, 0.0),
        ];
        sheet.polyline("0", Form::Light, &keyhole);
        sheet.circle("0", [-6.0, 4.0], 8.0);
    });
    sheet.block("BONE", |sheet| {
        let bone = [
            (-20.0, -12.0, 0.0),
            (20.0, -12.0, 0.6),
            (20.0, 12.0, 0.0),
            (-20.0, 12.0, 0.6),
        ];
        sheet.polyline("0", Form::Vertices, &bone);
    });
    sheet.insert("BLOCKS", "KEYHOLE", [70.0, 65.0], [-1.0, 1.0], 210.0);
    sheet.insert("BLOCKS", "BONE", [170.0, 130.0], [1.4, 0.9], -15.0);
    Layer::of(sheet, "BLOCKS")
}

/// A bay that is open at the side of the stock, around a boss, with its open side on a layer of its own.
fn bay(sheet: &mut Sheet) -> Layer {
    let name = "BAY";
    let outline = [
        (0.0, 40.0, 0.0),
        (90.0, 40.0, QUARTER),
        (110.0, 60.0, 0.0),
        (110.0, 120.0, 0.0),
        (0.0, 120.0, 0.0),
    ];
    sheet.polyline(name, Form::Light, &outline);
    sheet.circle(name, [55.0, 85.0], 10.0);
    sheet.line("BAY_OPEN", [0.0, 120.0], [0.0, 40.0]);
    Layer {
        open: Some("BAY_OPEN"),
        ..Layer::of(sheet, name)
    }
}

/// Loops in loops: ground within an island.
fn nested(sheet: &mut Sheet) -> Layer {
    let name = "NESTED";
    sheet.circle(name, [120.0, 90.0], 26.0);
    let ring = [
        (80.0, 50.0, 0.0),
        (80.0, 130.0, 0.0),
        (160.0, 130.0, 0.0),
        (160.0, 50.0, 0.0),
    ];
    sheet.polyline(name, Form::Light, &ring);
    sheet.polyline(name, Form::Vertices, &regular([120.0, 90.0], 85.0, 9));
    Layer::of(sheet, name)
}

/// A pocket for a plate, its corners relieved like the ends of a bone, in inches; lines miss each other by a few micrometres.
fn jig() -> Layer {
    let (name, mut sheet) = ("JIG", Sheet::in_inches());
    let (left, right, low, high) = (30.0, 150.0, 30.0, 110.0);
    // Reliefs are circles of 7 mm about points 4 mm off both walls; they meet the walls where these are 4 mm away.
    let far = 4.0 + (49.0_f64 - 16.0).sqrt();
    let angle = (4.0_f64 / 7.0).asin().to_degrees();
    let corners = [
        (left, low, 0.0),
        (right, low, 90.0),
        (right, high, 180.0),
        (left, high, 270.0),
    ];
    for (x, y, turn) in corners {
        let [dx, dy] = [
            if x == left { 4.0 } else { -4.0 },
            if y == low { 4.0 } else { -4.0 },
        ];
        sheet.arc(
            name,
            [x + dx, y + dy],
            7.0,
            [turn + 90.0 + angle, turn + 360.0 - angle],
        );
    }
    let gap = 0.004;
    sheet.line(name, [left + far + gap, low], [right - far, low - gap]);
    sheet.line(name, [right + gap, high - far], [right, low + far]);
    sheet.line(name, [right - far, high], [left + far, high + gap]);
    sheet.line(name, [left, low + far - gap], [left, high - far]);
    Layer {
        off: 0.005,
        ..Layer::of(&sheet, name)
    }
}

/// Polylines with vertices, in inches that only the job knows of.
fn old() -> Layer {
    let (name, mut sheet) = ("OLD", Sheet::of_old());
    let outline = [
        (25.4, 25.4, -0.1),
        (127.0, 25.4, 0.0),
        (127.0, 63.5, 0.25),
        (114.3, 101.6, 0.0),
        (25.4, 88.9, 0.0),
    ];
    sheet.polyline(name, Form::Vertices, &outline);
    let island = [(60.0, 55.0, 0.3), (80.0, 50.0, 0.3), (75.0, 70.0, -0.1)];
    sheet.polyline(name, Form::Vertices, &island);
    Layer {
        more: "unit = in",
        ..Layer::of(&sheet, name)
    }
}

/// A number below one that looks like any.
fn noise(number: u32) -> f64 {
    f64::from(number.wrapping_mul(2_654_435_761) >> 12) / f64::from(1_u32 << 20)
}

/// A flower as a scanner sees it, in hundreds of short lines, around a star.
fn logo(sheet: &mut Sheet) -> Layer {
    let name = "LOGO";
    let count = 200;
    let places: Vec<Spot> = (0..count)
        .map(|k| {
            let angle = TAU * f64::from(k) / f64::from(count);
            let radius = 52.0 + 9.0 * (5.0 * angle).cos() + 3.0 * (11.0 * angle).sin() + 0.04 * noise(k);
            [105.0 + 1.3 * radius * angle.cos(), 88.0 + radius * angle.sin()]
        })
        .collect();
    let mut lines: Vec<[Spot; 2]> = (0..places.len())
        .map(|k| [places[k], places[(k + 1) % places.len()]])
        .collect();
    // In no order, and every third one backwards.
    lines.sort_by_key(|[from, _]| (from[0] * 1e4) as i64 % 997);
    for (number, [from, to]) in lines.into_iter().enumerate() {
        if number % 3 == 0 {
            sheet.line(name, to, from);
        } else {
            sheet.line(name, from, to);
        }
    }
    let star: Vec<Corner> = (0..90_u32)
        .map(|k| {
            let angle = TAU * f64::from(k) / 90.0;
            let radius = 14.0 + 4.0 * (3.0 * angle).sin();
            (105.0 + radius * angle.cos(), 88.0 + radius * angle.sin(), 0.0)
        })
        .collect();
    sheet.polyline(name, Form::Light, &star);
    Layer::of(sheet, name)
}

/// A large outline of hundreds of segments, with six bosses.
fn plate() -> Layer {
    let (name, mut sheet) = ("PLATE", Sheet::in_mm());
    let along = |from: Spot, to: Spot| {
        (0..100_u32).map(move |k| {
            let share = f64::from(k) / 100.0;
            let wave = (share * TAU * 8.0).sin();
            let aside = [(to[1] - from[1]), (from[0] - to[0])].map(|by| by / distance(from, to) * wave);
            let at = |axis: usize| from[axis] + (to[axis] - from[axis]) * share - 1.5 * aside[axis];
            (at(0), at(1), 0.0)
        })
    };
    let corners = [[12.0, 12.0], [228.0, 12.0], [228.0, 168.0], [12.0, 168.0]];
    let outline: Vec<Corner> = (0..4)
        .flat_map(|k| along(corners[k], corners[(k + 1) % 4]))
        .collect();
    sheet.polyline(name, Form::Light, &outline);
    for k in 0..6 {
        let centre = [45.0 + 75.0 * f64::from(k % 3), 60.0 + 60.0 * f64::from(k / 3)];
        sheet.circle(name, centre, 7.0 + f64::from(k));
    }
    Layer::of(&sheet, name)
}

/// Draws a layer.
type Draw = fn(&mut Sheet) -> Layer;

/// The layers of one drawing lie one on top of the other.
fn layers() -> [(Layer, Option<f64>); 8] {
    let draw: [(Draw, Option<f64>); 8] = [
        (frame, Some(9600.0 - (4.0 - PI) * 225.0 - 81.0 * PI - 400.0)),
        (seat, None),
        (round, Some(PI * (55.0 * 55.0 - 0.5 * (18.0 * 18.0 + 36.0)))),
        (spoon, None),
        (blocks, None),
        (bay, Some(110.0 * 80.0 - (1.0 - PI / 4.0) * 400.0 - PI * 100.0)),
        (
            nested,
            Some(4.5 * 85.0 * 85.0 * (TAU / 9.0).sin() - 6400.0 + PI * 676.0),
        ),
        (logo, None),
    ];
    let mut sheet = Sheet::in_mm();
    let layers = draw.map(|(draw, area)| (draw(&mut sheet), area));
    // Everything is on the sheet by now.
    layers.map(|(layer, area)| {
        let sheet = sheet.clone();
        (Layer { sheet, ..layer }, area)
    })
}

#[test]
fn layers_of_one_drawing_are_cleared() {
    for (layer, area) in &layers()[..5] {
        clears(layer, *area);
    }
}

#[test]
fn more_layers_of_that_drawing_are_cleared() {
    for (layer, area) in &layers()[5..] {
        clears(layer, *area);
    }
}

#[test]
fn drawings_of_their_own_are_cleared() {
    clears(&jig(), None);
    clears(&old(), None);
    clears(&plate(), None);
}

/// Drawings in the layouts of other programs, with points on their outlines that another reader has found.
#[test]
fn drawings_of_other_programs_are_cleared() {
    for (name, layer) in [("autocad", "SKIN"), ("qcad", "Rib")] {
        let drawing = read(&format!("tests/data/drawings/{name}.dxf"));
        let points = read(&format!("tests/data/drawings/{name}.points"));
        let points: Vec<Spot> = points
            .lines()
            .filter(|line| !line.starts_with('#'))
            .map(|line| {
                let (x, y) = line.split_once(',').unwrap();
                [x, y].map(|number| 50.0 + number.parse::<f64>().unwrap())
            })
            .collect();
        let drawing_of = format!("dxf \"plate.dxf\" {{ layer = \"{layer}\", x = 50 mm, y = 50 mm }}");
        for pattern in PATTERNS {
            let outcome = compiled(&job(&drawing_of, pattern), &drawing);
            assert!(
                !has_errors(&outcome.diagnostics),
                "{name}: {}",
                rendered(&outcome.diagnostics, &outcome)
            );
            let program = outcome.compiled.as_ref().unwrap().program.verified().program();
            for (_, at) in ways(program) {
                let near = points.iter().map(|point| distance([at.x, at.y], *point));
                let near = near.fold(f64::INFINITY, f64::min);
                assert!(
                    near >= RADIUS - 1e-6,
                    "{name} by {pattern}: {at:?} is {near} mm from a wall"
                );
            }
        }
    }
}

/// What the messages offer is enough.
#[test]
fn drawings_that_are_refused_are_mended_by_what_is_offered() {
    // A gap of 0.3 mm.
    let mut sheet = Sheet::in_mm();
    sheet.line("SEAT", [20.0, 20.3], [20.0, 90.0]);
    sheet.line("SEAT", [120.0, 20.0], [20.0, 20.0]);
    sheet.arc("SEAT", [70.0, 90.0], 50.0, [0.0, 180.0]);
    sheet.line("SEAT", [120.0, 20.0], [120.0, 90.0]);
    let seat = |more: &str| format!("dxf \"plate.dxf\" {{ layer = \"SEAT\" {more} }}");
    let outcome = compiled(&job(&seat(""), "auto"), &sheet.text());
    let text = rendered(&outcome.diagnostics, &outcome);
    assert_eq!(outcome.diagnostics[0].code, Code::RegionTangled);
    assert!(text.contains("`tolerance = 0.301 mm`"), "{text}");
    let mut walls = sheet.sides("SEAT");
    walls.push([[20.0, 20.0], [20.0, 20.3]]);
    let boundary = Boundary::of(walls, Vec::new());
    let mended = compiled(&job(&seat(", tolerance = 0.301 mm"), "auto"), &sheet.text());
    assert_cleared(&mended, &boundary, 0.15, "joined");
    // Too narrow for the tool, but not for one of the radius that is stated.
    let mut sheet = Sheet::in_mm();
    let slot = [
        (30.0, 30.0, 0.0),
        (90.0, 30.0, 1.0),
        (90.0, 41.0, 0.0),
        (30.0, 41.0, 1.0),
    ];
    sheet.polyline("SEAT", Form::Light, &slot);
    let narrow = job(&seat(""), "auto");
    let outcome = compiled(&narrow, &sheet.text());
    let text = rendered(&outcome.diagnostics, &outcome);
    assert_eq!(outcome.diagnostics[0].code, Code::PocketTooNarrow);
    assert!(text.contains("a radius of at most 5.49 mm"), "{text}");
    let slim = |radius: f64| {
        let blade = format!(
            "blade slim = crusher {{ radius = {radius} mm, height = 24 mm, spin = 18000 rev/min, ramp = 5 deg }}\nregion"
        );
        let job = narrow.replacen("region", &blade, 1).replace("hog_12", "slim");
        let job = job
            .replace("cell { machine = pocket_cell }", "")
            .replace("use \"shop/pocket_cells.vcut\"", "");
        compiled(&job, &sheet.text())
    };
    assert!(!has_errors(&slim(5.49).diagnostics));
    assert!(has_errors(&slim(5.5).diagnostics));
    // Beyond the stock.
    let outcome = compiled(&job(&seat(", x = 150 mm"), "auto"), &sheet.text());
    assert_eq!(outcome.diagnostics[0].code, Code::PocketOutside);
}
