//! The ops of a part as instructions of RAPID.

use crate::keywords::{AXES_SPEED, HOME, SPEED, ZONE};
use crate::options::Settings;
use crate::orient::Quaternion;
use crate::speeds::Speeds;
use core::num::NonZeroU32;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::confdata::confdata;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, AxisValues, Cell, Op, OpId, OperationId, OrientationId, Program, Ready, Switch,
};
use vcutc_backend_api::motion::{ReachableProgram, Waypoint};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::{
    Generator, Layer, Lead, Modal, Part, Place, State, Text, Written, may_round, operation_heading,
};
use vcutc_backend_api::units::Duration;

/// External axes that no machine of the program has [A-INS].
pub(crate) const NO_EXTERNAL_AXES: &[u8] = b"[9E9,9E9,9E9,9E9,9E9,9E9]";

/// Instructions stand so far in.
pub(crate) const INDENT: &[u8] = b"    ";

/// How a move of all axes says where it leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AxisTarget {
    /// By the axis values, which leave no doubt about how the arm stands.
    Axes,
    /// By the pose, because the frames are those of the controller, which may be calibrated anew.
    Pose,
}

/// What the lines are made from.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The program.
    pub(crate) program: &'a Program,
    /// The program with its motion.
    pub(crate) reachable: &'a ReachableProgram,
    /// Its machine.
    pub(crate) cell: &'a Cell,
    /// The options.
    pub(crate) settings: &'a Settings<'a>,
    /// Its speeddata.
    pub(crate) speeds: &'a Speeds,
    /// Its orientations, rounded.
    pub(crate) quaternions: &'a [Quaternion],
    /// What ends every move: `,TOOL\WObj:=WOBJ;`.
    pub(crate) frames: &'a str,
}

impl Source<'_> {
    /// How moves of all axes say where they lead.
    pub(crate) const fn axis_target(&self) -> AxisTarget {
        match (self.cell.tool.number, self.cell.base.number) {
            (None, None) => AxisTarget::Axes,
            (Some(_), _) | (_, Some(_)) => AxisTarget::Pose,
        }
    }
}

/// Writes the ops of a part.
pub(crate) fn write(source: Source<'_>, part: &Part, text: &mut Text<'_>) -> Written {
    let ops = source.program.ops.get(part.ops.clone()).unwrap_or_default();
    let first = op_id(part.ops.start)?;
    let waypoints = &source.reachable.motion().waypoints;
    let passed = waypoints.partition_point(|waypoint| waypoint.op < first);
    let mut body = Body {
        source,
        text,
        modal: Modal::default(),
        state: part.start,
        turned: None,
        waypoints: waypoints.get(passed..).unwrap_or_default(),
    };
    body.restate(first)?;
    let mut rest = ops;
    let mut id = first;
    while let [op, after @ ..] = rest {
        body.lead(op)?;
        body.op(id, op, after.first())?;
        rest = after;
        id = OpId(id.0.saturating_add(1));
    }
    Ok(())
}

fn op_id(index: usize) -> Result<OpId, EmitError> {
    let id = u32::try_from(index).map_err(|_| EmitError::Internal("more ops than have numbers"))?;
    Ok(OpId(id))
}

/// How many lines of its own a lead takes: comments only, for speeds are named by the moves.
pub(crate) fn lines_of(lead: Lead) -> u64 {
    u64::from(lead.operation.is_some()) + u64::from(lead.open.is_some() || lead.cut.is_some())
}

struct Body<'a, 's, 't> {
    source: Source<'a>,
    text: &'t mut Text<'s>,
    modal: Modal,
    state: State,
    /// The quaternion written last, whose sign the next one follows.
    turned: Option<Quaternion>,
    /// Those that are not passed yet.
    waypoints: &'a [Waypoint],
}

impl Body<'_, '_, '_> {
    /// The comments that come before an op.
    fn lead(&mut self, op: &Op) -> Written {
        let Lead {
            close: _,
            operation,
            open,
            cut,
            feed: _,
            rate: _,
        } = self.modal.lead(op);
        if let Some(operation) = operation {
            self.operation(operation)?;
        }
        match (open, cut) {
            (_, Some((layer, cut))) => self.cut(layer, cut),
            (Some(layer), None) => self.layer(layer),
            (None, None) => Ok(()),
        }
    }

    /// Starts a line of the routine.
    fn begin(&mut self, start: &[u8]) {
        self.text.put(INDENT);
        self.text.put(start);
    }

    fn operation(&mut self, id: OperationId) -> Written {
        let (ours, blade) = operation_heading(self.source.program, id)?;
        self.begin(b"! ");
        Ok(self.text.comment(&ours, blade)?)
    }

    fn layer(&mut self, layer: Layer) -> Written {
        self.begin(b"! layer ");
        self.text.whole(layer.number.get());
        Ok(self.text.end_line()?)
    }

    fn cut(&mut self, layer: Layer, cut: NonZeroU32) -> Written {
        self.begin(b"! layer ");
        self.text.whole(layer.number.get());
        self.text.put(b" cut ");
        self.text.whole(cut.get());
        Ok(self.text.end_line()?)
    }

    /// Repeats the state in which the part begins, whose first op is that. Called from the main routine this changes nothing;
    /// a part started alone is brought to the pose, on the branch and with the blade vibrating, that its first move was
    /// checked from.
    fn restate(&mut self, first: OpId) -> Written {
        match (self.state.place, first.0.checked_sub(1)) {
            (Place::Tip(tip, held), Some(before)) => self.axis_travel(OpId(before), tip, held)?,
            (Place::Home, _) => self.home()?,
            (Place::Unknown | Place::Tip(..), _) => {}
        }
        match self.state.generator {
            Generator::Off => Ok(()),
            Generator::Starting => self.ultrasonic(Switch::On),
            Generator::Running => {
                self.ultrasonic(Switch::On)?;
                self.await_ready()
            }
        }
    }

    fn op(&mut self, id: OpId, op: &Op, next: Option<&Op>) -> Written {
        let before = self.state;
        self.state = before.after(&op.action);
        match op.action {
            Action::Home => self.home(),
            Action::AxisTravel { to, orientation } => self.axis_travel(id, to, orientation),
            Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } | Action::Cut { .. } => {
                let end = self.end(before.place, &op.action, next.map(|next| &next.action));
                self.go(id, &op.action, end)
            }
            Action::Turn { .. } => self.go(id, &op.action, End::Exact),
            Action::Ultrasonic { state } => self.ultrasonic(state),
            Action::AwaitReady => self.await_ready(),
            Action::Dwell { time } => self.wait(time),
            Action::ToolChange { .. } => Err(EmitError::Internal("a tool change was not refused")),
        }
    }

    fn end(&self, before: Place, action: &Action, next: Option<&Action>) -> End {
        let stock = self.source.program.stock;
        if self.source.settings.common.approximation.is_some() && may_round(stock, before, action, next) {
            End::Rounded
        } else {
            End::Exact
        }
    }

    /// Moves past the waypoints of an op to where the state says it ends. The robot stops at waypoints.
    fn go(&mut self, id: OpId, action: &Action, end: End) -> Written {
        let Place::Tip(tip, held) = self.state.place else {
            return Err(EmitError::Internal("a move starts from an unknown pose"));
        };
        let speed = self
            .source
            .speeds
            .number(action)
            .ok_or(EmitError::Internal("a move has no speed"))?;
        while let [waypoint, rest @ ..] = self.waypoints
            && waypoint.op == id
        {
            let quaternion = Quaternion::rounded(waypoint.frame.orientation);
            self.straight(
                id,
                waypoint.frame.origin,
                quaternion,
                waypoint.axes,
                speed,
                End::Exact,
            )?;
            self.waypoints = rest;
        }
        let quaternion = self.quaternion(held)?;
        self.straight(id, tip, quaternion, self.axes(id)?, speed, end)
    }

    fn straight(
        &mut self,
        id: OpId,
        tip: Point3,
        quaternion: Quaternion,
        axes: AxisValues,
        speed: u32,
        end: End,
    ) -> Written {
        self.begin(b"MoveL ");
        self.target(id, tip, quaternion, axes)?;
        self.text.put(b",");
        self.text.put(SPEED.as_bytes());
        self.text.whole(speed);
        self.text.put(b",");
        self.text.put(match end {
            End::Exact => b"fine",
            End::Rounded => ZONE.as_bytes(),
        });
        Ok(self.text.line(self.source.frames)?)
    }

    /// A robtarget on the branch of an op.
    fn target(&mut self, id: OpId, tip: Point3, quaternion: Quaternion, axes: AxisValues) -> Written {
        let branch = self.source.reachable.branch_after(id);
        let conf = branch
            .and_then(|branch| confdata(branch, &axes))
            .ok_or(EmitError::Internal("a pose has no confdata"))?;
        let quaternion = self.turned.map_or(quaternion, |last| quaternion.nearer_to(last));
        self.turned = Some(quaternion);
        let lengths = self.source.settings.common.lengths;
        let text = &mut *self.text;
        for (start, value) in [(b"[[" as &[u8], tip.x), (b",", tip.y), (b",", tip.z)] {
            text.put(start);
            text.fixed(lengths, value)?;
        }
        text.put(b"],");
        quaternion.push(text.buffer());
        for (start, quarter) in [",[", ",", ",", ","].into_iter().zip(conf) {
            text.put(start.as_bytes());
            if quarter < 0 {
                text.put(b"-");
            }
            text.whole(quarter.unsigned_abs());
        }
        text.put(b"],");
        text.put(NO_EXTERNAL_AXES);
        text.put(b"]");
        Ok(())
    }

    fn quaternion(&self, held: OrientationId) -> Result<Quaternion, EmitError> {
        let known = self.source.quaternions.get(held.0 as usize).copied();
        known.ok_or(EmitError::Internal("an orientation is not in its table"))
    }

    fn axes(&self, id: OpId) -> Result<AxisValues, EmitError> {
        let known = self.source.reachable.axes_after(id);
        known.ok_or(EmitError::Internal("an op has no axis values"))
    }

    fn home(&mut self) -> Written {
        self.begin(b"MoveAbsJ ");
        self.text.put(HOME.as_bytes());
        self.text.put(b"\\NoEOffs");
        self.turned = None;
        self.axis_speed()
    }

    /// A move of all axes to where an op ends.
    fn axis_travel(&mut self, id: OpId, to: Point3, held: OrientationId) -> Written {
        let axes = self.axes(id)?;
        match self.source.axis_target() {
            AxisTarget::Axes => {
                self.begin(b"MoveAbsJ [");
                joints(self.source, axes, self.text)?;
                self.text.put(b",");
                self.text.put(NO_EXTERNAL_AXES);
                self.text.put(b"]\\NoEOffs");
                self.turned = Some(self.quaternion(held)?);
            }
            AxisTarget::Pose => {
                self.begin(b"MoveJ ");
                let quaternion = self.quaternion(held)?;
                self.target(id, to, quaternion, axes)?;
            }
        }
        self.axis_speed()
    }

    fn axis_speed(&mut self) -> Written {
        self.text.put(b",");
        self.text.put(AXES_SPEED.as_bytes());
        self.text.put(b",fine");
        Ok(self.text.line(self.source.frames)?)
    }

    /// Every move before this ends in a stop point, where the controller waits for the arm [A-IO].
    fn ultrasonic(&mut self, state: Switch) -> Written {
        let output = self
            .source
            .cell
            .ultrasonic
            .ok_or(EmitError::Internal("no ultrasonic output"))?;
        self.begin(b"SetDO ");
        self.text.put(self.source.settings.output(output).as_bytes());
        Ok(self.text.line(match state {
            Switch::On => ",1;",
            Switch::Off => ",0;",
        })?)
    }

    fn await_ready(&mut self) -> Written {
        match self.source.cell.ready {
            Ready::Input(input) => {
                self.begin(b"WaitDI ");
                self.text.put(self.source.settings.input(input).as_bytes());
                Ok(self.text.line(",1;")?)
            }
            Ready::After(time) => self.wait(time),
        }
    }

    fn wait(&mut self, time: Duration) -> Written {
        self.begin(b"WaitTime ");
        self.text.trimmed(time.to_s())?;
        Ok(self.text.line(";")?)
    }
}

/// The angles of axes, `[j1,j2,j3,j4,j5,j6]` in degrees.
pub(crate) fn joints(source: Source<'_>, axes: AxisValues, text: &mut Text<'_>) -> Written {
    for (start, angle) in [b'[', b',', b',', b',', b',', b','].into_iter().zip(axes.0) {
        text.put(&[start]);
        text.fixed(source.settings.angles, angle.to_degrees())?;
    }
    text.put(b"]");
    Ok(())
}
