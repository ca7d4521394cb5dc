//! ABB RAPID output (RobotWare 6 and 7).
//!
//! # The dialect
//!
//! A RAPID program is a list of *modules*, `NAME.pgf`, with the modules beside it. A module holds data and routines; the
//! routine `main` is the entry of the task. All modules share one name space; names have at most 32 characters and do not
//! mind case. Statements end with `;`, comments begin with `!`.
//!
//! Every move names all that it depends on: the target, the speed (`speeddata`: of the tip, and of turning), how exactly it
//! ends (`fine` or a `zonedata`), the tool and the work object. Targets are literals: their positions, a unit quaternion,
//! the confdata ([`vcutc_backend_api::confdata`]) of the branch that was proven, and `9E9` for external axes that are not
//! there. With `ConfL\On` the controller checks the confdata of straight moves and stops where it would stand otherwise; it
//! objects to axes that turn by 90 deg or more in one move, so such moves come with waypoints
//! ([`vcutc_backend_api::motion::Waypoint`]), each a `MoveL` of its own. With `SingArea\Off` it stops rather than bend the
//! way of the blade.
//!
//! # How an op is said
//!
//! | op | RAPID |
//! |---|---|
//! | `Home` | `MoveAbsJ vc_home\NoEOffs,..` |
//! | `AxisTravel` | `MoveAbsJ [[j1, .. j6],[9E9, ..]]\NoEOffs,..`; `MoveJ` to the pose where tool or work object are the controller's |
//! | `Travel`, `Approach`, `Retract`, `Cut` | `MoveL [[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[9E9, ..]],vc_speed1,fine,vc_tool\WObj:=vc_wobj;` |
//! | `Turn` | the same with the position of the move before, timed by `v_ori` |
//! | `Ultrasonic` | `SetDO do12,1;`, `SetDO do12,0;` behind a stop point |
//! | `AwaitReady` | `WaitDI di7,1;` or `WaitTime t;` |
//! | `Dwell` | `WaitTime t;` |
//! | `ToolChange` | refused |
//!
//! A move of all axes to axis values leaves no doubt about how the arm stands, whatever a controller takes cfx for; should
//! it take it for something else, the first `MoveL` stops. With frames that the controller keeps, and that may be calibrated
//! anew, it is the pose that is meant, and `MoveJ` says it with `ConfJ\On`.
//!
//! # Long programs
//!
//! A long program is a main module whose `main` calls `NAME_part001`, `NAME_part002`, ..., each in a module of its own
//! ([`vcutc_backend_api::script::split`] has the rule). Each part sets the modes again, and repeats the pose and the state of the
//! generator that the part before it ended with, so that a part that is started alone gets there on the branch that its straight
//! moves are proven on. The data stand in the main module once, where people adjust them.
//!
//! # Machines
//!
//! ABB robots with six rotary axes and a spherical wrist: confdata is defined for those.
//!
//! # Sources
//!
//! * [A-KER] ABB 3HAC050946, RAPID kernel; [A-OV] ABB 3HAC050947, RAPID overview
//! * [A-INS] ABB, RAPID instructions, functions and data types
//! * [A-BASIC] ABB, RAPID reference manual, basic characteristics
//! * [A-CONF], [A-IO] articles on industrialmonitordirect.com on `ConfL` and on the timing of outputs
//!
//! No output of this crate has been run on a controller by its authors; `docs/backends/rapid.md` says what to check first.

mod body;
mod keywords;
mod limits;
mod module;
mod options;
mod orient;
mod profile;
mod read;
mod speeds;

use crate::body::Source;
use crate::keywords::{MOST_PARTS, main_name};
use crate::options::{OPTIONS, Settings};
use crate::orient::Quaternion;
use crate::read::RapidReader;
use crate::speeds::Speeds;
use vcutc_backend_api::backend::{
    Backend, BackendIssue, Emission, EmitError, MachineMismatch, OptionSpec, Options,
};
use vcutc_backend_api::bundle::Sink;
use vcutc_backend_api::ir::{Cell, MachineKind, Maker};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::script::{Borders, LINES_PER_PART, Layout, Part, Text, split};
use vcutc_backend_api::verify::{Capabilities, Capability};

/// Lines end as those that RobotStudio writes.
const LAYOUT: Layout = Layout {
    line_end: b"\r\n",
    longest_comment: 110,
    kept_out_of_comments: b"",
};

/// The RAPID backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rapid;

impl Backend for Rapid {
    fn id(&self) -> &'static str {
        "rapid"
    }

    fn summary(&self) -> &'static str {
        "ABB RAPID: NAME.mod and NAME.pgf, in parts when long (RobotWare 6 and 7)"
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities::NONE
            .with(Capability::LinearMove)
            .with(Capability::JointMove)
            .with(Capability::StillTipTurn)
            .with(Capability::Output)
            .with(Capability::AwaitInput)
            .with(Capability::Dwell)
    }

    fn options(&self) -> &'static [OptionSpec] {
        OPTIONS
    }

    fn mismatch(&self, kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
        limits::foreign(kind, maker)
    }

    fn reader(&self) -> Option<&dyn Reader> {
        Some(&RapidReader)
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        let settings = Settings::read(options);
        let parts = split(
            &program.program().ops,
            settings.common.lines_per_part,
            Borders::BetweenCuts,
            &|at, lead| body::lines_of(lead) + waypoints_of(program, at),
        );
        let cell = limits::check(program, &settings, parts.len())?;
        if parts.len() > MOST_PARTS {
            return Err(vec![too_many_parts(parts.len())]);
        }
        Ok(Box::new(RapidEmission {
            reachable: program,
            cell,
            settings,
            parts,
        }))
    }
}

/// How many points on the way the op at this place has: each is a line.
fn waypoints_of(program: &ReachableProgram, at: usize) -> u64 {
    let waypoints = &program.motion().waypoints;
    let before = |at| waypoints.partition_point(|waypoint| (waypoint.op.0 as usize) < at);
    (before(at.saturating_add(1)) - before(at)) as u64
}

fn too_many_parts(count: usize) -> BackendIssue {
    BackendIssue::OptionConflict {
        key: LINES_PER_PART,
        why: format!("the program would need {count} parts, and part names have room for {MOST_PARTS}"),
    }
}

/// A program that RAPID can say, and how.
struct RapidEmission<'p> {
    reachable: &'p ReachableProgram,
    cell: &'p Cell,
    settings: Settings<'p>,
    parts: Vec<Part>,
}

impl Emission for RapidEmission<'_> {
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError> {
        let program = self.reachable.program();
        let rounded = program.orientations.iter().copied().map(Quaternion::rounded);
        let quaternions: Vec<Quaternion> = rounded.collect();
        let (tool, work_object) = (
            self.settings.tool(self.cell),
            self.settings.work_object(self.cell),
        );
        let source = Source {
            program,
            reachable: self.reachable,
            cell: self.cell,
            settings: &self.settings,
            speeds: &Speeds::of(program),
            quaternions: &quaternions,
            frames: &format!(",{tool}\\WObj:={work_object};"),
        };
        let name = main_name(&program.name, &limits::taken_names(&self.settings, self.cell));
        module::write(source, &name, &self.parts, &mut Text::new(sink, LAYOUT))
    }
}
