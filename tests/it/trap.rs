//! Regions that are drawn for a tool of 5 mm in a stock of 20 mm, and what is wrong with programs that clear them.

use crate::drawn::{Corner, Form, Sheet};
use crate::pipeline::{Files, compile, rendered};
use crate::seen_from_above::{Boundary, Spot, distance, ways};
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;

pub(crate) const WIDTH: f64 = 140.0;
pub(crate) const DEPTH: f64 = 110.0;
pub(crate) const HEIGHT: f64 = 20.0;
pub(crate) const FLOOR: f64 = 10.0;
pub(crate) const RADIUS: f64 = 5.0;
/// What passes keep from walls: the radius, what controls cut off at joints, and what rounding takes.
pub(crate) const KEEP: f64 = RADIUS + 0.007;

pub(crate) const PATTERNS: [&str; 5] = ["offset", "sfs", "zigzag", "field", "auto"];

/// Those that `auto` chooses from.
pub(crate) const CHOSEN: [&str; 3] = ["offset", "sfs", "zigzag"];

pub(crate) fn job(region: &str, fields: &str) -> String {
    format!(
        "job \"trap\"
stock {{ size = ({WIDTH} mm, {DEPTH} mm, {HEIGHT} mm) }}
blade hog = crusher {{ radius = {RADIUS} mm, height = 12 mm, spin = 18000 rev/min, ramp = 5 deg }}
{region}
{}",
        clear("seat", fields)
    )
}

pub(crate) fn clear(region: &str, fields: &str) -> String {
    format!(
        "clear pocket {{
  region = {region}
  blade = hog
  {fields}
  feed {{ cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
"
    )
}

pub(crate) fn compiled(text: &str, drawing: &str) -> Outcome {
    let files = Files::default().with("job.vcut", text).with("trap.dxf", drawing);
    compile("job.vcut", &files)
}

pub(crate) fn codes(outcome: &Outcome) -> Vec<Code> {
    outcome.diagnostics.iter().map(|found| found.code).collect()
}

/// Drawn on layer SEAT; its open sides on layer OPEN.
pub(crate) struct Trap {
    name: String,
    sheet: Sheet,
    /// More fields of the operation.
    fields: String,
}

impl Trap {
    pub(crate) fn of(name: impl Into<String>, draw: impl FnOnce(&mut Sheet)) -> Self {
        let mut sheet = Sheet::in_mm();
        draw(&mut sheet);
        Self {
            name: name.into(),
            sheet,
            fields: String::new(),
        }
    }

    pub(crate) fn polygon(name: impl Into<String>, corners: &[Corner]) -> Self {
        Self::of(name, |sheet| sheet.polyline("SEAT", Form::Light, corners))
    }

    pub(crate) fn with(self, fields: &str) -> Self {
        Self {
            fields: fields.to_owned(),
            ..self
        }
    }

    pub(crate) fn has_open_sides(&self) -> bool {
        !self.sheet.sides("OPEN").is_empty()
    }

    pub(crate) fn compiled(&self, pattern: &str) -> Outcome {
        let open = if self.has_open_sides() {
            "open = \"OPEN\""
        } else {
            ""
        };
        let region = format!("region seat {{ dxf \"trap.dxf\" {{ layer = \"SEAT\" {open} }} }}");
        let fields = format!("floor = {FLOOR} mm\n  pattern = {pattern}\n  {}", self.fields);
        compiled(&job(&region, &fields), &self.sheet.text())
    }

    /// Walls, and open sides: those that lie along a mark.
    pub(crate) fn boundary(&self) -> Boundary {
        let marks = self.sheet.sides("OPEN");
        let is_marked = |side: &[Spot; 2]| {
            let is_on = |mark: &[Spot; 2]| {
                let long = distance(mark[0], mark[1]);
                side.iter()
                    .all(|at| distance(*at, mark[0]) + distance(*at, mark[1]) < long + 1e-6)
            };
            marks.iter().any(is_on)
        };
        let (open, walls) = self.sheet.sides("SEAT").into_iter().partition(is_marked);
        Boundary::of(walls, open)
    }

    /// What is wrong with its programs by some patterns.
    pub(crate) fn faults(&self, patterns: &[&str]) -> Vec<String> {
        let boundary = self.boundary();
        let fault = |pattern: &&str| {
            let outcome = self.compiled(pattern);
            let fault = fault(&outcome, &boundary);
            fault.map(|fault| format!("{} by {pattern}: {fault}", self.name))
        };
        patterns.iter().filter_map(fault).collect()
    }
}

/// What is wrong with a program: it enters a wall, leaves the region or leaves core, by samples of its ways.
pub(crate) fn fault(outcome: &Outcome, boundary: &Boundary) -> Option<String> {
    if has_errors(&outcome.diagnostics) {
        return Some(rendered(&outcome.diagnostics, outcome));
    }
    let ways = ways(outcome.compiled.as_ref()?.program.verified().program());
    for (_, at) in &ways {
        if at.z < FLOOR - 1e-9 {
            return Some(format!("{at:?} is below the floor"));
        }
        let to_wall = boundary.to_wall([at.x, at.y], RADIUS);
        if to_wall < RADIUS - 1e-6 {
            return Some(format!("{at:?} is {to_wall} mm from a wall"));
        }
        let is_beside = at.x <= 0.0 || at.y <= 0.0 || at.x >= WIDTH || at.y >= DEPTH;
        if !is_beside && !boundary.contains([at.x, at.y]) {
            return Some(format!("{at:?} is not in the region"));
        }
    }
    let flat = ways.iter().filter(|(_, at)| (at.z - FLOOR).abs() < 1e-3);
    let uncut = boundary.uncut(RADIUS, RADIUS, flat.map(|(_, at)| [at.x, at.y]));
    (uncut > 1.0).then(|| format!("{uncut} mm2 stay"))
}

pub(crate) fn assert_cleared(patterns: &[&str], traps: impl IntoIterator<Item = Trap>) {
    let faults = traps.into_iter().flat_map(|trap| trap.faults(patterns));
    let faults: Vec<String> = faults.collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

pub(crate) fn rectangle(sheet: &mut Sheet, [x, y]: Spot, [width, depth]: Spot) {
    let corners = [
        (x, y, 0.0),
        (x + width, y, 0.0),
        (x + width, y + depth, 0.0),
        (x, y + depth, 0.0),
    ];
    sheet.polyline("SEAT", Form::Light, &corners);
}

pub(crate) fn plain(corners: &[Spot]) -> Vec<Corner> {
    corners.iter().map(|&[x, y]| (x, y, 0.0)).collect()
}
