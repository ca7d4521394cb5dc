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
//! # How an op is written
//!
//! | op | RAPID |
//! |---|---|
//! | `Home` | `MoveAbsJ vc_home\NoEOffs,..` |
//! | `AxisTravel` | `MoveAbsJ [[j1, .. j6],[9E9, ..]]\NoEOffs,..`; `MoveJ` to the pose where tool or work object are the controller's |
//! | `Travel`, `Approach`, `Retract`, `Cut` | `MoveL [[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[9E9, ..]],vc_speed1,fine,vc_tool\WObj:=vc_wobj;` |
//! | `Follow` | `MoveL` or `MoveC`, with the zone `vc_blend` where the chain continues |
//! | `Turn` | the same with the position of the move before, timed by `v_ori` |
//! | `Ultrasonic` | `SetDO do12,1;`, `SetDO do12,0;` after a stop point |
//! | `AwaitReady` | `WaitDI di7,1;` or `WaitTime t;` |
//! | `Dwell` | `WaitTime t;` |
//! | `ChangePlace` | `MoveAbsJ vc_change\NoEOffs,vc_axes,fine` |
//! | `ToolChange` | the cell's routine `NAME n;` with the place of the tool, or `TPWrite` and `Stop;`; moves after it name another tool |
//!
//! A move of all axes to axis values leaves no doubt about how the arm stands, whatever a controller takes cfx for; should
//! it take it for something else, the first `MoveL` stops. With frames that the controller keeps, and that
//! may be calibrated again, the pose is meant, and `MoveJ` says it with `ConfJ\On`.
//!
//! # Chains
//!
//! On an arc `CirPathMode\ObjectFrame` has the blade turn as on a line: about one axis, seen from the work object, in even steps. The
//! default, `\PathFrame`, would turn it relative to the way; for a blade that stands in the plane of its way both are the same turn,
//! but only the former is timed like that of a line. Where a chain continues, the zone is as large as the blend: within it of the
//! joint the robot goes from the one piece to the next, and never farther from both. Waypoints on a chain are passed likewise, and an
//! arc that has some is read as several, each by the point in its middle.
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

mod change;
mod dialect;
mod files;
mod limits;
mod names;
mod options;
mod orient;
mod profile;
mod read;
mod speeds;

use crate::dialect::RapidDialect;
use crate::names::{MOST_PARTS, main_name};
use crate::options::{OPTIONS, Settings};
use crate::read::RapidReader;
use vcutc_backend_api::arm::foreign;
use vcutc_backend_api::backend::{Backend, BackendIssue, Emission, MachineMismatch, OptionSpec, Options};
use vcutc_backend_api::ir::{MachineKind, Maker};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::script::{Borders, CAPABILITIES, Layout, Lead, Source, Text, emission, split, write};
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
        CAPABILITIES.with(Capability::ToolChange).with(Capability::Chain)
    }

    fn options(&self) -> &'static [OptionSpec] {
        OPTIONS
    }

    fn mismatch(&self, kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
        foreign(kind, maker, Maker::Abb)
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
            &|at, lead| lines_before(program, at, lead),
        );
        let cell = limits::check(program, &settings, parts.len())?;
        let source = Source {
            reachable: program,
            cell,
        };
        emission(parts, MOST_PARTS, move |parts, sink| {
            let main = main_name(
                &source.program().name,
                &limits::taken_names(&settings, source.cell),
            );
            let mut text = Text::new(sink, LAYOUT);
            let mut rapid = RapidDialect::new(source, &settings, &mut text);
            write(&mut rapid, source, &settings.common, &main, parts)
        })
    }
}

/// How many lines stand before the line of an op itself: comments and waypoints, for speeds are named by the moves.
fn lines_before(program: &ReachableProgram, at: usize, lead: Lead) -> u64 {
    let comments = u64::from(lead.operation.is_some()) + u64::from(lead.open.is_some() || lead.cut.is_some());
    let on_way = waypoints_of(program, at);
    let action = program.program().ops.get(at).map(|op| op.action);
    // On an arc every move has a line more, with the point on the way.
    match action.and_then(|action| action.via()) {
        Some(_) => comments + 2 * on_way + 1,
        None => comments + on_way,
    }
}

/// How many points on the way the op at this place has: each is a line.
fn waypoints_of(program: &ReachableProgram, at: usize) -> u64 {
    let waypoints = &program.motion().waypoints;
    let before = |at| waypoints.partition_point(|waypoint| (waypoint.op.0 as usize) < at);
    (before(at.saturating_add(1)) - before(at)) as u64
}
