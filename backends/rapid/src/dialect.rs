//! How a program is put in RAPID.

use crate::names::{AXES_SPEED, BLEND, CHANGE, HOME, SPEED, ZONE};
use crate::options::Settings;
use crate::orient::Quaternion;
use crate::speeds::Speeds;
use core::num::NonZeroU32;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::chains::has_arcs;
use vcutc_backend_api::confdata::confdata;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, AxisValues, Cell, OpId, OrientationId, RateId, Switch, ToolId};
use vcutc_backend_api::motion::Waypoint;
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::{
    Dialect, JointMove, JointTarget, Layer, LinearMove, Part, Source, Text, ToolChange, Written,
};
use vcutc_backend_api::state::TipPose;
use vcutc_backend_api::units::Duration;

/// External axes that no machine of the program has [A-INS].
pub(crate) const NO_EXTERNAL_AXES: &[u8] = b"[9E9,9E9,9E9,9E9,9E9,9E9]";

/// Instructions stand so far in.
const INDENT: &[u8] = b"    ";

/// How a move of all axes says where it leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AxisTarget {
    /// By the axis values, which leave no doubt about how the arm stands.
    Axes,
    /// By the pose, because the frames are those of the controller, which may be calibrated again.
    Pose,
}

impl AxisTarget {
    fn of(cell: &Cell) -> Self {
        let mut tools = cell.tools.iter();
        let is_kept = tools.any(|(_, tool)| tool.frame.number.is_some()) || cell.base.number.is_some();
        if is_kept { Self::Pose } else { Self::Axes }
    }
}

/// Whether a program follows arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arcs {
    None,
    Some,
}

/// RAPID, as far as a program is written.
pub(crate) struct RapidDialect<'a, 't, 's> {
    /// What it is written from.
    pub(crate) source: Source<'a>,
    /// The options.
    pub(crate) settings: &'a Settings<'a>,
    /// Its speeddata.
    pub(crate) speeds: Speeds,
    /// Its orientations, rounded.
    pub(crate) quaternions: Vec<Quaternion>,
    /// What ends every move: `,TOOL\WObj:=WOBJ;`.
    pub(crate) frames: String,
    /// Where lines go.
    pub(crate) text: &'t mut Text<'s>,
    /// The files of modules so far.
    pub(crate) modules: Vec<String>,
    /// Whether the program follows arcs.
    pub(crate) arcs: Arcs,
    /// The quaternion written last, whose sign the next one follows.
    turned: Option<Quaternion>,
    /// Those that are not passed yet.
    waypoints: &'a [Waypoint],
}

impl<'a, 't, 's> RapidDialect<'a, 't, 's> {
    /// Nothing written yet.
    pub(crate) fn new(source: Source<'a>, settings: &'a Settings<'a>, text: &'t mut Text<'s>) -> Self {
        let program = source.program();
        let rounded = program.orientations.iter().copied().map(Quaternion::rounded);
        Self {
            source,
            settings,
            speeds: Speeds::of(program),
            quaternions: rounded.collect(),
            frames: frames(source, settings, ToolId::FIRST),
            text,
            modules: Vec::new(),
            arcs: if has_arcs(program) { Arcs::Some } else { Arcs::None },
            turned: None,
            waypoints: &[],
        }
    }
}

/// What ends every move with a tool.
fn frames(source: Source<'_>, settings: &Settings<'_>, tool: ToolId) -> String {
    let (tool, work_object) = (
        settings.tool(source.cell, tool),
        settings.work_object(source.cell),
    );
    format!(",{tool}\\WObj:={work_object};")
}

impl Dialect for RapidDialect<'_, '_, '_> {
    fn comment(&mut self, ours: &str, theirs: &str) -> Written {
        self.begin(b"! ");
        Ok(self.text.comment(ours, theirs)?)
    }

    fn head_comment(&mut self, ours: &str, theirs: &str) -> Written {
        self.text.put(b"  ! ");
        Ok(self.text.comment(ours, theirs)?)
    }

    fn verbatim(&mut self, line: &str) -> Written {
        Ok(self.text.line(line)?)
    }

    fn part_begins(&mut self, part: &Part, _: Option<RateId>) -> Written {
        let waypoints = &self.source.reachable.motion().waypoints;
        let passed = waypoints.partition_point(|waypoint| (waypoint.op.0 as usize) < part.ops.start);
        self.waypoints = waypoints.get(passed..).unwrap_or_default();
        self.turned = None;
        self.frames = frames(self.source, self.settings, part.start.tool);
        Ok(())
    }

    /// The comment of a cut names its layer.
    fn layer_begins(&mut self, layer: Layer, cut: Option<NonZeroU32>) -> Written {
        match cut {
            Some(_) => Ok(()),
            None => self.comment(&format!("layer {}", layer.number), ""),
        }
    }

    fn joint_move(&mut self, motion: &JointMove) -> Written {
        match (motion.to, AxisTarget::of(self.source.cell)) {
            (place @ (JointTarget::Home | JointTarget::Change), _) => {
                self.begin(b"MoveAbsJ ");
                self.text.put(match place {
                    JointTarget::Change => CHANGE.as_bytes(),
                    JointTarget::Home | JointTarget::Pose(_) => HOME.as_bytes(),
                });
                self.text.put(b"\\NoEOffs");
                self.turned = None;
            }
            (JointTarget::Pose(pose), AxisTarget::Axes) => {
                self.begin(b"MoveAbsJ [");
                self.joints(motion.axes)?;
                self.text.put(b",");
                self.text.put(NO_EXTERNAL_AXES);
                self.text.put(b"]\\NoEOffs");
                self.turned = Some(self.quaternion(pose.orientation)?);
            }
            (JointTarget::Pose(pose), AxisTarget::Pose) => {
                self.begin(b"MoveJ ");
                let quaternion = self.quaternion(pose.orientation)?;
                self.target(motion.op, pose.tip, quaternion, motion.axes)?;
            }
        }
        self.text.put(b",");
        self.text.put(AXES_SPEED.as_bytes());
        self.text.put(b",fine");
        Ok(self.text.line(&self.frames)?)
    }

    /// Past the waypoints of an op to where it ends. The robot stops at waypoints, but for those of chains.
    fn linear_move(&mut self, motion: &LinearMove<'_>) -> Written {
        let speed = self.speeds.number(motion.action);
        let speed = speed.ok_or(EmitError::Internal("a move has no speed"))?;
        let passes = match motion.action {
            Action::Follow { .. } => End::Through {
                within: self.source.program().blend,
            },
            _ => End::Exact,
        };
        let mut done = 0.0;
        while let [waypoint, rest @ ..] = self.waypoints
            && waypoint.op == motion.op
        {
            let quaternion = Quaternion::rounded(waypoint.frame.orientation);
            let via = motion.line.via_between([done, waypoint.done]);
            self.begin_move(motion, via, waypoint.axes)?;
            self.target(motion.op, waypoint.frame.origin, quaternion, waypoint.axes)?;
            self.motion_end(speed, passes)?;
            (done, self.waypoints) = (waypoint.done, rest);
        }
        let TipPose { tip, orientation } = motion.line.to;
        let quaternion = self.quaternion(orientation)?;
        let axes = self.source.axes_after(motion.op)?;
        let via = if done > 0.0 {
            motion.line.via_between([done, 1.0])
        } else {
            motion.line.via
        };
        self.begin_move(motion, via, axes)?;
        self.target(motion.op, tip, quaternion, axes)?;
        self.motion_end(speed, motion.end)
    }

    /// Every move before this ends in a stop point, where the controller waits for the arm [A-IO].
    fn switch(&mut self, output: u32, state: Switch) -> Written {
        self.begin(b"SetDO ");
        self.text
            .put(self.settings.output(self.source.cell, output).as_bytes());
        Ok(self.text.line(match state {
            Switch::On => ",1;",
            Switch::Off => ",0;",
        })?)
    }

    fn change_tool(&mut self, change: &ToolChange<'_>) -> Written {
        self.put_in(change)?;
        self.turned = None;
        self.frames = frames(self.source, self.settings, change.id);
        Ok(())
    }

    fn await_input(&mut self, input: u32) -> Written {
        self.begin(b"WaitDI ");
        self.text.put(self.settings.input(input).as_bytes());
        Ok(self.text.line(",1;")?)
    }

    fn wait(&mut self, time: Duration) -> Written {
        self.begin(b"WaitTime ");
        self.text.trimmed(time.to_s())?;
        Ok(self.text.line(";")?)
    }
}

impl RapidDialect<'_, '_, '_> {
    /// Starts a line of the routine.
    pub(crate) fn begin(&mut self, start: &[u8]) {
        self.text.put(INDENT);
        self.text.put(start);
    }

    /// Starts a move along a line, or along an arc with a point of it. That point has the confdata of where the move ends, as only its
    /// place counts; it stands in a line of its own, because two targets in one are too long to be read.
    fn begin_move(&mut self, motion: &LinearMove<'_>, via: Option<Point3>, axes: AxisValues) -> Written {
        let (Some(via), Some(arc)) = (via, motion.line.arc()) else {
            self.begin(b"MoveL ");
            return Ok(());
        };
        let done = arc.done_at(via.to_array());
        let held = motion.line.frame_at(self.source.program(), done);
        let held = held.ok_or(EmitError::Internal("an arc has no orientations"))?;
        self.begin(b"MoveC ");
        self.target(motion.op, via, Quaternion::rounded(held.orientation), axes)?;
        self.text.line(",")?;
        self.begin(b"  ");
        Ok(())
    }

    fn motion_end(&mut self, speed: u32, end: End) -> Written {
        self.text.put(b",");
        self.text.put(SPEED.as_bytes());
        self.text.whole(speed);
        self.text.put(b",");
        self.text.put(match end {
            End::Exact => b"fine",
            End::Rounded => ZONE.as_bytes(),
            End::Through { .. } => BLEND.as_bytes(),
        });
        Ok(self.text.line(&self.frames)?)
    }

    /// A robtarget on the branch of an op.
    fn target(&mut self, op: OpId, tip: Point3, quaternion: Quaternion, axes: AxisValues) -> Written {
        let branch = self.source.reachable.branch_after(op);
        let conf = branch
            .and_then(|branch| confdata(branch, &axes))
            .ok_or(EmitError::Internal("a pose has no confdata"))?;
        let quaternion = self.turned.map_or(quaternion, |last| quaternion.nearer_to(last));
        self.turned = Some(quaternion);
        self.text.put(b"[");
        self.point(tip)?;
        self.text.put(b",");
        quaternion.push(self.text.buffer());
        for (start, quarter) in [",[", ",", ",", ","].into_iter().zip(conf) {
            self.text.put(start.as_bytes());
            if quarter < 0 {
                self.text.put(b"-");
            }
            self.text.whole(quarter.unsigned_abs());
        }
        self.text.put(b"],");
        self.text.put(NO_EXTERNAL_AXES);
        self.text.put(b"]");
        Ok(())
    }

    /// `[x,y,z]` in mm.
    pub(crate) fn point(&mut self, point: Point3) -> Written {
        let lengths = self.settings.common.lengths;
        for (start, value) in [(b"[", point.x), (b",", point.y), (b",", point.z)] {
            self.text.put(start);
            self.text.fixed(lengths, value)?;
        }
        self.text.put(b"]");
        Ok(())
    }

    /// The angles of axes, `[j1,j2,j3,j4,j5,j6]` in degrees.
    pub(crate) fn joints(&mut self, axes: AxisValues) -> Written {
        for (start, angle) in [b'[', b',', b',', b',', b',', b','].into_iter().zip(axes.0) {
            self.text.put(&[start]);
            self.text.fixed(self.settings.angles, angle.to_degrees())?;
        }
        self.text.put(b"]");
        Ok(())
    }

    fn quaternion(&self, held: OrientationId) -> Result<Quaternion, EmitError> {
        let known = self.quaternions.get(held.0 as usize).copied();
        known.ok_or(EmitError::Internal("an orientation is not in its table"))
    }
}
