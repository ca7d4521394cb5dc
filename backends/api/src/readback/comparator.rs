//! What is different between an op and a command.

use super::{Circle, Command, Configuration, End, Held, Pace, Reader, Resolution, Target};
use crate::corners::may_round;
use crate::geometry::{Frame, Orientation, Point3};
use crate::ir::{Action, AxisKind, AxisValues, Joint, MOST_AXES, OpId, Program, Switch};
use crate::motion::{ReachableProgram, Waypoint};
use crate::number::is_within;
use crate::segments::{LimitedBy, LinearSegment};
use crate::state::{State, TipPose};
use crate::swivel::Apart;
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};
use crate::vector::dot;

/// A difference between an op and a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mismatch {
    /// Another kind of command.
    Kind,
    /// The tip ends elsewhere.
    Tip {
        /// Where.
        is: Point3,
        /// Where it should.
        should: Point3,
    },
    /// The blade is held in another way.
    Attitude {
        /// The angle between the two.
        by: Angle,
    },
    /// Another way to stand.
    Configuration {
        /// Which; none when it is not said.
        is: Option<Configuration>,
        /// Which it should be.
        should: Option<Configuration>,
    },
    /// An axis ends elsewhere: in rad or mm.
    Axis {
        /// Its place among the machine's axes.
        axis: usize,
        /// Where.
        is: f64,
        /// Where it should.
        should: f64,
    },
    /// The tip goes at another speed.
    Feed {
        /// At which; none when it is not said.
        is: Option<Speed>,
        /// At which it should.
        should: Speed,
    },
    /// The blade, or the rotary axes together, turn at another rate.
    Rate {
        /// At which; none when it is not said.
        is: Option<AngularSpeed>,
        /// At which it should.
        should: AngularSpeed,
    },
    /// The motion takes another time.
    Time {
        /// How much.
        is: Duration,
        /// How much it should.
        should: Duration,
    },
    /// The machine does not stop where it must.
    NoStop,
    /// The machine stops where a chain continues.
    Stops,
    /// The tip may leave a chain further than it should where it continues.
    Blend {
        /// How far.
        is: Length,
        /// How far it should at most.
        should: Length,
    },
    /// The tip goes on another arc.
    Arc {
        /// How far the point between the ends, or the centre, is from where it should be.
        by: Length,
    },
    /// Another output is switched, or to another state.
    Output {
        /// Which and to what.
        is: (u32, Switch),
        /// Which and to what it should be; no number where the machine has no output.
        should: (Option<u32>, Switch),
    },
    /// The spindle turns at another speed, or stands.
    Spin {
        /// In the program; none where it stops.
        is: Option<AngularSpeed>,
        /// As it should be.
        should: Option<AngularSpeed>,
    },
    /// Another blade is put in, or it is put in another way.
    ToolPlace {
        /// From which place; none by hand.
        is: Option<u32>,
        /// From which it should.
        should: Option<u32>,
    },
    /// Another input is awaited.
    Input {
        /// Which.
        is: u32,
        /// Which it should be.
        should: u32,
    },
}

/// The state of the program in front of an op.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// The op.
    pub op: OpId,
    /// What the machine is doing.
    pub before: State,
}

/// Compares ops with commands.
#[derive(Clone, Copy)]
pub struct Comparator<'p> {
    reachable: &'p ReachableProgram,
    reader: &'p dyn Reader,
    resolution: Resolution,
}

/// Numbers that are rounded down may be less by all that is printed last, twice the resolution, and more by nothing but the rounding of
/// the arithmetic.
fn is_at_most(is: f64, should: f64, resolution: f64) -> bool {
    let rounding = 1e-9 * should.abs().max(1.0);
    let below = should - is;
    (-(1e-3 * resolution + rounding)..=2.0 * resolution * (1.0 + 1e-6) + rounding).contains(&below)
}

/// Least cosine between the axes of arcs that are one: dialects state main axes exactly, and the sense is what may be wrong.
const ALONG: f64 = 1.0 - 1e-6;

/// By how much a blend may be larger than stated, in mm: rounding.
const BLEND_SLACK: f64 = 1e-9;

impl<'p> Comparator<'p> {
    /// A comparator of a program that was printed so finely.
    #[must_use]
    pub const fn new(
        reachable: &'p ReachableProgram,
        reader: &'p dyn Reader,
        resolution: Resolution,
    ) -> Self {
        Self {
            reachable,
            reader,
            resolution,
        }
    }

    /// The program.
    #[must_use]
    pub const fn reachable(&self) -> &'p ReachableProgram {
        self.reachable
    }

    pub(super) fn program(&self) -> &'p Program {
        self.reachable.program()
    }

    /// Everything in which a command is not what the op at a moment says; nothing when it is.
    #[must_use]
    pub fn mismatches(&self, moment: Moment, command: &Command) -> Vec<Mismatch> {
        let mut found = Vec::new();
        let program = self.program();
        let Some(op) = program.op(moment.op) else {
            return vec![Mismatch::Kind];
        };
        let axes = self.reachable.axes_after(moment.op);
        match (op.action, command, axes) {
            (
                Action::Home | Action::ChangePlace | Action::AxisTravel { .. },
                Command::Axes(is),
                Some(should),
            ) => {
                self.axes(is, &should, Which::All, &mut found);
            }
            (Action::AxisTravel { to: tip, orientation }, Command::AxesToPose(target), Some(_)) => {
                self.target(moment.op, target, TipPose { tip, orientation }, &mut found);
            }
            (action, Command::Straight { to, pace, end } | Command::Round { to, pace, end, .. }, Some(_)) => {
                match (self.line(moment), command) {
                    (Some(line @ LinearSegment { via: None, .. }), Command::Straight { .. }) => {
                        self.motion(moment, &line, (to, *pace), &mut found);
                        self.end(moment, &action, *end, &mut found);
                    }
                    (Some(line), Command::Round { on, .. }) if line.via.is_some() => {
                        self.circle(&line, on, self.last_via(moment.op, &line), &mut found);
                        self.motion(moment, &line, (to, *pace), &mut found);
                        self.end(moment, &action, *end, &mut found);
                    }
                    (_, _) => found.push(Mismatch::Kind),
                }
            }
            (action, command, _) => self.signal(moment, action, command, &mut found),
        }
        found
    }

    /// Whether a command brings the machine to a waypoint on the way of the op at a moment, as the op itself would go on.
    #[must_use]
    pub fn passes(&self, moment: Moment, waypoint: &Waypoint, command: &Command) -> bool {
        self.waypoint_mismatches(moment, waypoint, command).is_empty()
    }

    /// Whether every waypoint has to be named.
    #[must_use]
    pub fn needs_waypoints(&self) -> bool {
        self.reader.states_waypoints()
    }

    /// Everything in which a command is not the motion to a waypoint of the op at a moment.
    #[must_use]
    pub fn waypoint_mismatches(
        &self,
        moment: Moment,
        waypoint: &Waypoint,
        command: &Command,
    ) -> Vec<Mismatch> {
        let Some(line) = self.line(moment) else {
            return vec![Mismatch::Kind];
        };
        let mut found = Vec::new();
        let (to, pace, end) = match (command, line.via) {
            (Command::Straight { to, pace, end }, None) => (to, pace, *end),
            (Command::Round { on, to, pace, end }, Some(_)) => {
                let earlier = self.waypoints_of(moment.op).iter();
                let earlier = earlier.take_while(|other| other.done < waypoint.done);
                let from = earlier.last().map_or(0.0, |last| last.done);
                self.circle(&line, on, line.via_between([from, waypoint.done]), &mut found);
                (to, pace, *end)
            }
            (_, _) => return vec![Mismatch::Kind],
        };
        let action = self.program().op(moment.op).map(|op| op.action);
        if matches!(action, Some(Action::Follow { .. })) {
            self.goes_on(end, &mut found);
        }
        let branch = self.reachable.branch_after(moment.op);
        let configuration = branch.and_then(|branch| self.reader.configuration(branch, waypoint.axes));
        self.pose(to, waypoint.frame.origin, waypoint.frame.orientation, &mut found);
        self.configuration(to, configuration, &mut found);
        self.pace(moment.op, &line, *pace, &mut found);
        found
    }

    /// Where a motion of the tip leads, and how fast.
    fn motion(
        &self,
        moment: Moment,
        line: &LinearSegment,
        (to, pace): (&Target, Pace),
        found: &mut Vec<Mismatch>,
    ) {
        self.target(moment.op, to, line.to, found);
        self.pace(moment.op, line, pace, found);
    }

    /// The waypoints of an op.
    fn waypoints_of(&self, op: OpId) -> &'p [Waypoint] {
        let all = &self.reachable.motion().waypoints;
        let first = all.partition_point(|waypoint| waypoint.op < op);
        let end = all.partition_point(|waypoint| waypoint.op <= op);
        all.get(first..end).unwrap_or_default()
    }

    /// The point by which a dialect knows the last stretch of an arc: the program's own where the arc is one stretch, the middle of
    /// the stretch where waypoints divide it.
    fn last_via(&self, op: OpId, line: &LinearSegment) -> Option<Point3> {
        match self.waypoints_of(op).last() {
            Some(last) if self.needs_waypoints() => line.via_between([last.done, 1.0]),
            Some(_) | None => line.via,
        }
    }

    /// The arc on which the tip goes, with a point of it.
    fn circle(&self, line: &LinearSegment, is: &Circle, via: Option<Point3>, found: &mut Vec<Mismatch>) {
        let (Some(via), Some(arc)) = (via, line.arc()) else {
            found.push(Mismatch::Kind);
            return;
        };
        let (is, should) = match is {
            Circle::Via(is) => (*is, via),
            Circle::About { centre, axis } => {
                if dot(axis.to_array(), arc.axis()) < ALONG {
                    // The other way round, or in another plane.
                    found.push(Mismatch::Kind);
                }
                (*centre, Point3::from(arc.centre()))
            }
        };
        if !self.is_at(is, should) {
            let by = is.distance(should);
            found.push(Mismatch::Arc { by });
        }
    }

    /// The straight motion of the op at a moment.
    fn line(&self, moment: Moment) -> Option<LinearSegment> {
        let program = self.program();
        LinearSegment::of(
            program,
            moment.before.place.pose()?,
            &program.op(moment.op)?.action,
        )
    }

    /// Whether two frames are the same within what is printed.
    pub(super) fn is_same_frame(&self, is: &Frame, should: &Frame) -> bool {
        let mut found = Vec::new();
        self.tip(is.origin, should.origin, &mut found);
        let by = is.orientation.angle_to(should.orientation);
        found.is_empty() && is_within(by.to_rad(), 0.0, self.resolution.attitude.to_rad())
    }

    pub(super) fn wait(&self, is: Duration, should: Duration, found: &mut Vec<Mismatch>) {
        if !is_within(is.to_s(), should.to_s(), self.resolution.time.to_s()) {
            found.push(Mismatch::Time { is, should });
        }
    }

    pub(super) fn axes(&self, is: &AxisValues, should: &AxisValues, which: Which, found: &mut Vec<Mismatch>) {
        let axes = self.program().cell.iter().flat_map(|cell| &cell.axes);
        for (axis, (known, (&is, &should))) in axes.zip(is.0.iter().zip(&should.0)).enumerate() {
            let resolution = match (known.kind, which) {
                (AxisKind::Rotary, Which::All | Which::Rotary) => self.resolution.axis.to_rad(),
                (AxisKind::Linear, Which::All) => self.resolution.length.to_mm(),
                (AxisKind::Linear, Which::Rotary) => continue,
            };
            if !is_within(is, should, resolution) {
                found.push(Mismatch::Axis { axis, is, should });
            }
        }
    }

    pub(super) fn target(&self, op: OpId, is: &Target, should: TipPose, found: &mut Vec<Mismatch>) {
        let tip = should.tip;
        let orientation = self.program().orientation(should.orientation);
        let axes = self.reachable.axes_after(op);
        match (is.held, orientation, axes) {
            (Held::Orientation(_, configuration), Some(orientation), Some(axes)) => {
                self.pose(is, tip, orientation, found);
                if configuration.is_some() || self.must_state_configuration(op) {
                    let branch = self.reachable.branch_after(op);
                    self.configuration(
                        is,
                        branch.and_then(|branch| self.reader.configuration(branch, axes)),
                        found,
                    );
                }
            }
            (Held::Rotary(rotary), _, Some(should)) => {
                self.tip(is.tip, tip, found);
                self.axes(&rotary, &should, Which::Rotary, found);
            }
            (Held::Orientation(..) | Held::Rotary(_), _, _) => found.push(Mismatch::Kind),
        }
    }

    /// A move of all axes to a pose has no other way to say which way is meant.
    fn must_state_configuration(&self, op: OpId) -> bool {
        let action = self.program().op(op).map(|op| op.action);
        matches!(action, Some(Action::AxisTravel { .. }))
    }

    fn pose(&self, is: &Target, tip: Point3, orientation: Orientation, found: &mut Vec<Mismatch>) {
        self.tip(is.tip, tip, found);
        match is.held {
            Held::Orientation(held, _) => {
                let by = held.angle_to(orientation);
                if !is_within(by.to_rad(), 0.0, self.resolution.attitude.to_rad()) {
                    found.push(Mismatch::Attitude { by });
                }
            }
            Held::Rotary(_) => found.push(Mismatch::Kind),
        }
    }

    fn configuration(&self, is: &Target, should: Option<Configuration>, found: &mut Vec<Mismatch>) {
        if let Held::Orientation(_, is) = is.held
            && is != should
        {
            found.push(Mismatch::Configuration { is, should });
        }
    }

    fn tip(&self, is: Point3, should: Point3, found: &mut Vec<Mismatch>) {
        if !self.is_at(is, should) {
            found.push(Mismatch::Tip { is, should });
        }
    }

    fn is_at(&self, is: Point3, should: Point3) -> bool {
        let resolution = self.resolution.length.to_mm();
        [(is.x, should.x), (is.y, should.y), (is.z, should.z)]
            .into_iter()
            .all(|(is, should)| is_within(is, should, resolution))
    }

    fn pace(&self, op: OpId, line: &LinearSegment, pace: Pace, found: &mut Vec<Mismatch>) {
        let duration = line.duration();
        match pace {
            Pace::Speeds { tip, turn } => {
                self.tip_speed(line, tip, found);
                if let Some(should) = line.rate
                    && line.turn > Angle::ZERO
                    && !turn.is_some_and(|is| self.is_rate(is, should))
                {
                    found.push(Mismatch::Rate { is: turn, should });
                }
            }
            Pace::Apart { tip, swivel, twist } => {
                match line.limited_by() {
                    Some(LimitedBy::Rate(_)) if line.via.is_some() => {
                        let should = line.length() / duration;
                        if !tip.is_some_and(|is| self.is_rounded_down(is, should)) {
                            found.push(Mismatch::Feed { is: tip, should });
                        }
                    }
                    _ => self.tip_speed(line, tip, found),
                }
                self.turns_apart(line, [swivel, twist], found);
            }
            Pace::Tip(is) => {
                let should = line.length() / duration;
                // A move that goes nowhere takes no time at any speed.
                let goes = line.length() > Length::ZERO;
                if (goes && !self.is_rounded_down(is, should)) || (!goes && line.turn > Angle::ZERO) {
                    found.push(Mismatch::Feed { is: Some(is), should });
                }
            }
            Pace::PerMinute(is) => {
                let should = 60.0 / duration.to_s();
                if duration > Duration::ZERO && !is_at_most(is, should, self.resolution.per_minute) {
                    found.push(Mismatch::Time {
                        is: Duration::s(60.0 / is),
                        should: duration,
                    });
                }
            }
            Pace::Rotary(is) => {
                let should = self.rotary_way(op) / duration;
                if !self.is_rate(is, should) {
                    found.push(Mismatch::Rate { is: Some(is), should });
                }
            }
        }
    }

    fn tip_speed(&self, line: &LinearSegment, is: Option<Speed>, found: &mut Vec<Mismatch>) {
        if let Some(should) = line.feed
            && line.length() > Length::ZERO
            && !is.is_some_and(|is| self.is_feed(is, should))
        {
            found.push(Mismatch::Feed { is, should });
        }
    }

    /// Swivel and twist each at the rate at which the turn takes its time, rounded down by less than a unit.
    fn turns_apart(&self, line: &LinearSegment, is: [Option<AngularSpeed>; 2], found: &mut Vec<Mismatch>) {
        let orientation = |pose: TipPose| self.program().orientation(pose.orientation);
        let (Some(rate), Some(from), Some(to)) = (line.rate, orientation(line.from), orientation(line.to))
        else {
            return;
        };
        if line.turn == Angle::ZERO {
            return;
        }
        let Apart { swivel, twist } = Apart::rates(from, to, rate);
        for (is, should) in is.into_iter().zip([swivel, twist]) {
            if !is.is_some_and(|is| self.is_rate(is, should)) {
                found.push(Mismatch::Rate { is, should });
            }
        }
    }

    fn is_feed(&self, is: Speed, should: Speed) -> bool {
        is_within(
            is.to_mm_per_s(),
            should.to_mm_per_s(),
            self.resolution.speed.to_mm_per_s(),
        )
    }

    /// Whether a speed is the one that was proven, rounded down.
    fn is_rounded_down(&self, is: Speed, should: Speed) -> bool {
        is_at_most(
            is.to_mm_per_s(),
            should.to_mm_per_s(),
            self.resolution.speed.to_mm_per_s(),
        )
    }

    /// Rates of turning are rounded down, so that no turn takes less than its proven time.
    fn is_rate(&self, is: AngularSpeed, should: AngularSpeed) -> bool {
        is_at_most(
            is.to_rad_per_s(),
            should.to_rad_per_s(),
            self.resolution.rate.to_rad_per_s(),
        )
    }

    /// How far the rotary axes turn in an op, as the root of the sum of their squares.
    fn rotary_way(&self, op: OpId) -> Angle {
        let before = op.0.checked_sub(1).map(OpId);
        let before = before.and_then(|before| self.reachable.axes_after(before));
        let axes = self.program().cell.iter().flat_map(|cell| &cell.axes);
        let (Some(before), Some(after)) = (before, self.reachable.axes_after(op)) else {
            return Angle::ZERO;
        };
        Angle::rad(rotary_way(axes.map(|axis| axis.kind), &before, &after))
    }

    fn end(&self, moment: Moment, action: &Action, end: End, found: &mut Vec<Mismatch>) {
        let program = self.program();
        let next = program.ops.get(moment.op.0 as usize + 1).map(|op| &op.action);
        let before = moment.before.place;
        let joint = match action {
            Action::Follow { joint, .. } => *joint,
            _ => Joint::Stop,
        };
        match (joint, end) {
            (Joint::Stop, End::Exact) => {}
            (Joint::Stop, End::Rounded) if may_round(program.stock, before, action, next) => {}
            (Joint::Stop, End::Rounded | End::Through { .. }) => found.push(Mismatch::NoStop),
            (Joint::Through, end) => self.goes_on(end, found),
        }
    }

    /// A chain continues without a stop, near its ways.
    fn goes_on(&self, end: End, found: &mut Vec<Mismatch>) {
        match end {
            End::Through { within } => {
                // A dialect rounds it down.
                let should = self.program().blend;
                if within.to_mm() > should.to_mm() + BLEND_SLACK {
                    found.push(Mismatch::Blend { is: within, should });
                }
            }
            End::Exact => found.push(Mismatch::Stops),
            End::Rounded => found.push(Mismatch::NoStop),
        }
    }
}

/// Which axes are compared.
#[derive(Clone, Copy)]
pub(super) enum Which {
    All,
    Rotary,
}

/// How far rotary axes turn, in rad, as the root of the sum of their squares.
#[must_use]
pub fn rotary_way(kinds: impl Iterator<Item = AxisKind>, from: &AxisValues, to: &AxisValues) -> f64 {
    let squares = kinds.zip(from.0.iter().zip(&to.0)).take(MOST_AXES);
    let turned = squares.filter(|(kind, _)| *kind == AxisKind::Rotary);
    let sum: f64 = turned.map(|(_, (from, to))| (to - from) * (to - from)).sum();
    sum.sqrt()
}
