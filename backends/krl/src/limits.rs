//! What a controller does not take, found before anything is written.
//!
//! Sources: [K-SI] KUKA, KSS 8.3 Operating and Programming Instructions for System Integrators; [K-SYS] KUKA, System
//! Variables for KSS 8.1 to 8.4. Of each kind of problem the first is told, with its op: a stock placed too far away
//! would otherwise be told a million times.

use crate::configuration::status;
use vcutc_backend_api::backend::{BackendIssue, MachineMismatch};
use vcutc_backend_api::findings::{Findings, Number};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, AxisKind, AxisValues, Cell, FeedId, Load, MOST_AXES, MachineKind, Maker, OpId, PlacedFrame,
    Program, RateId, Ready, Registered,
};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::script::Part;
use vcutc_backend_api::units::Duration;

/// Largest coordinate, in mm. KRL's `REAL` has seven digits, so beyond this a hundredth of a millimetre is lost; no
/// robot reaches a tenth of it.
const FARTHEST_MM: f64 = 99_999.0;

/// Largest axis angle, in degrees: beyond it T does not tell which turn is meant. Arms with six axes end at 350 or before.
const LARGEST_AXIS_DEG: f64 = 360.0;

/// Tip speed `$VEL.CP` in m/s: zero is refused, and `$VEL_MA.CP` is 3 as delivered [K-SYS].
const TIP_SPEED: (f64, f64) = (0.000_001, 3.0);

/// The rate of a turn in deg/s. Neither of its parts is faster, and `$VEL_MA.ORI1` and `.ORI2` are 400 as delivered [K-SYS];
/// neither is below a tenth of it, and four decimals say that to a hundredth.
const RATE: (f64, f64) = (0.1, 400.0);

/// `WAIT SEC` in s; a day.
const LONGEST_WAIT_S: f64 = 86_400.0;

/// `$LOAD.M` in kg; the largest arm is rated for 1300.
const LOAD_MASS_KG: (f64, f64) = (0.001, 1300.0);

/// `TOOL_DATA[16]` and `LOAD_DATA[16]` [K-SYS].
const TOOLS: u32 = 16;

/// `BASE_DATA[32]` [K-SYS].
const BASES: u32 = 32;

/// `$IN[4096]` and `$OUT[4096]` [K-SYS].
const SIGNALS: u32 = 4096;

/// Inputs that the controller itself holds at TRUE and FALSE: the one never waits, the other waits for ever.
const FIXED_INPUTS: [u32; 2] = [1025, 1026];

const HOME_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "home",
    why: "a KRL program begins and ends with a move of all six axes to angles that the job states, so that it does not \
          depend on where the arm happens to stand",
};

const GENERATOR_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "ultrasonic",
    why: "the program switches the generator on before the blade enters; a blade that does not vibrate breaks",
};

/// What a program needs to run on.
const DRIVES: &str = "KUKA robots with six rotary axes and a spherical wrist";

/// The cell of a program, or everything that stands in the way of writing it.
pub(crate) fn check<'p>(
    program: &'p ReachableProgram,
    parts: &[Part],
) -> Result<&'p Cell, Vec<BackendIssue>> {
    let wrong = |mismatch| {
        let drives = DRIVES;
        vec![BackendIssue::WrongMachine { mismatch, drives }]
    };
    // No program is assembled without a machine; if one were, it would have no arm to drive.
    let Some(cell) = &program.program().cell else {
        return Err(wrong(MachineMismatch::Arm));
    };
    if let Some(mismatch) = mismatch(cell, program) {
        return Err(wrong(mismatch));
    }
    let mut limits = Limits::default();
    limits.cell(cell);
    limits.ops(program);
    limits.restarts(program, parts);
    limits.found.result().map(|()| cell)
}

/// What sets machines of a kind and maker apart from those that KRL programs are for.
pub(crate) const fn foreign(kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
    match (kind, maker) {
        (MachineKind::FiveAxis, _) => Some(MachineMismatch::Kind),
        (MachineKind::Robot, Maker::Abb | Maker::Other) => Some(MachineMismatch::Maker),
        (MachineKind::Robot, Maker::Kuka) => None,
    }
}

/// What sets a machine apart from those that KRL programs are for.
fn mismatch(cell: &Cell, program: &ReachableProgram) -> Option<MachineMismatch> {
    if let Some(mismatch) = foreign(cell.kind, cell.maker) {
        return Some(mismatch);
    }
    let turns = |kind| match kind {
        AxisKind::Rotary => true,
        AxisKind::Linear => false,
    };
    let is_arm = cell.axes.len() == MOST_AXES && cell.axes.iter().all(|axis| turns(axis.kind));
    let mut branches = program.motion().stretches.iter().map(|stretch| stretch.branch);
    let has_status = branches.all(|branch| status(branch).is_some());
    (!(is_arm && has_status)).then_some(MachineMismatch::Arm)
}

/// What KRL does not take of a program.
#[derive(Default)]
struct Limits {
    found: Findings,
}

impl Limits {
    fn cell(&mut self, cell: &Cell) {
        self.home(cell.home);
        self.frame(cell.tool, ["tool X", "tool Y", "tool Z"], ("tool number", TOOLS));
        self.frame(cell.base, ["base X", "base Y", "base Z"], ("base number", BASES));
        match cell.load {
            Some(Registered::Value(load)) => self.load(load),
            Some(Registered::Number(number)) => self.found.number("load number", number, 1..=TOOLS),
            None => {}
        }
        match cell.ultrasonic {
            Some(output) => self.found.number("output number", output, 1..=SIGNALS),
            None => self.found.tell("ultrasonic", GENERATOR_MISSING),
        }
        match cell.ready {
            Ready::Input(input) => self.input(input),
            Ready::After(time) => self.wait(None, "time until ready", time),
        }
    }

    fn home(&mut self, home: Option<AxisValues>) {
        let Some(angles) = home else {
            self.found.tell("home", HOME_MISSING);
            return;
        };
        self.axes(None, "home angle", angles);
    }

    fn axes(&mut self, op: Option<OpId>, what: &'static str, axes: AxisValues) {
        for angle in axes.0 {
            let number = Number {
                what,
                value: angle.to_degrees(),
                unit: "deg",
            };
            self.found
                .range(op, &number, (-LARGEST_AXIS_DEG, LARGEST_AXIS_DEG));
        }
    }

    fn frame(
        &mut self,
        placed: PlacedFrame,
        coordinates: [&'static str; 3],
        (what, highest): (&'static str, u32),
    ) {
        match placed.number {
            None => self.point(None, coordinates, placed.frame.origin),
            Some(number) => self.found.number(what, number, 1..=highest),
        }
    }

    fn load(&mut self, load: Load) {
        let mass = Number {
            what: "load mass",
            value: load.mass.to_kg(),
            unit: "kg",
        };
        self.found.range(None, &mass, LOAD_MASS_KG);
        self.point(None, ["load X", "load Y", "load Z"], load.centre);
    }

    fn input(&mut self, input: u32) {
        self.found.number("input number", input, 1..=SIGNALS);
        if FIXED_INPUTS.contains(&input) {
            self.found.tell(
                "input number",
                BackendIssue::OutOfRange {
                    op: None,
                    what: "input number",
                    value: input.to_string(),
                    allowed: "1 to 4096 but not 1025 and 1026, which the controller holds on and off"
                        .to_owned(),
                    range: None,
                },
            );
        }
    }

    fn ops(&mut self, program: &ReachableProgram) {
        let tables = program.program();
        for (id, op) in program.verified().ops() {
            if let Some(operation) = op.site.operation() {
                self.found.blade(tables, id, operation);
            }
            match op.action {
                Action::Home | Action::Ultrasonic { .. } | Action::AwaitReady => {}
                Action::AxisTravel { to, .. } => {
                    self.target(id, to);
                    self.turns(program, id);
                }
                Action::Travel { to, feed, rate, .. } => {
                    self.target(id, to);
                    self.feed(id, tables, feed);
                    self.rate(id, tables, rate);
                }
                Action::Approach { to, feed }
                | Action::Retract { to, feed }
                | Action::Cut { to, feed, .. } => {
                    self.target(id, to);
                    self.feed(id, tables, feed);
                }
                Action::Turn { rate, .. } => self.rate(id, tables, rate),
                Action::Dwell { time } => self.wait(Some(id), "waiting time", time),
                Action::ToolChange { .. } => {
                    let what = "a tool change within the program";
                    self.found.tell(what, BackendIssue::Unsupported { op: id, what });
                }
            }
        }
    }

    /// Parts begin with a move of all axes to where the op before them ended.
    fn restarts(&mut self, program: &ReachableProgram, parts: &[Part]) {
        let before = |part: &Part| u32::try_from(part.ops.start.checked_sub(1)?).ok();
        for op in parts.iter().filter_map(before) {
            self.turns(program, OpId(op));
        }
    }

    /// The axes at the end of an op, where T has to say which turn is meant.
    fn turns(&mut self, program: &ReachableProgram, op: OpId) {
        if let Some(axes) = program.axes_after(op) {
            self.axes(Some(op), "axis angle", axes);
        }
    }

    fn target(&mut self, op: OpId, to: Point3) {
        self.point(Some(op), ["X", "Y", "Z"], to);
    }

    fn point(&mut self, op: Option<OpId>, names: [&'static str; 3], point: Point3) {
        self.found.point(op, names, point, FARTHEST_MM);
    }

    fn feed(&mut self, op: OpId, program: &Program, feed: FeedId) {
        if let Some(feed) = program.feeds.get(usize::from(feed.0)) {
            let number = Number {
                what: "tip speed",
                value: feed.to_m_per_s(),
                unit: "m/s",
            };
            self.found.range(Some(op), &number, TIP_SPEED);
        }
    }

    fn rate(&mut self, op: OpId, program: &Program, rate: RateId) {
        if let Some(rate) = program.rates.get(usize::from(rate.0)) {
            let number = Number {
                what: "reorientation rate",
                value: rate.to_deg_per_s(),
                unit: "deg/s",
            };
            self.found.range(Some(op), &number, RATE);
        }
    }

    fn wait(&mut self, op: Option<OpId>, what: &'static str, time: Duration) {
        let number = Number {
            what,
            value: time.to_s(),
            unit: "s",
        };
        self.found.range(op, &number, (0.0, LONGEST_WAIT_S));
    }
}
