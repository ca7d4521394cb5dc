//! What is different between an op and a deed.

use super::{Deed, End, Grain, Held, Pace, Reader, Stance, Target};
use crate::corners::may_round;
use crate::geometry::{Frame, Orientation, Point3};
use crate::ir::{Action, AxisKind, AxisValues, MOST_AXES, OpId, Program, Ready, Switch};
use crate::motion::{ReachableProgram, Waypoint};
use crate::segments::LinearSegment;
use crate::state::{Generator, State, TipPose};
use crate::swivel::Apart;
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// A difference between an op and a deed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mismatch {
    /// Another kind of deed.
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
    Stance {
        /// Which; none when it is not said.
        is: Option<Stance>,
        /// Which it should be.
        should: Option<Stance>,
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
    /// Another output is switched, or to another state.
    Output {
        /// Which and to what.
        is: (u32, Switch),
        /// Which and to what it should be; no number where the machine has no output.
        should: (Option<u32>, Switch),
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

/// Compares ops with deeds.
#[derive(Clone, Copy)]
pub struct Judge<'p> {
    reachable: &'p ReachableProgram,
    reader: &'p dyn Reader,
    grain: Grain,
}

/// Numbers may differ by half of what is printed last, and by the rounding of the arithmetic.
fn within(is: f64, should: f64, grain: f64) -> bool {
    let rounding = 1e-9 * should.abs().max(1.0);
    (is - should).abs() <= grain * (1.0 + 1e-6) + rounding
}

/// Numbers that are rounded down may be less by all that is printed last, twice the grain, and more by nothing but the rounding of
/// the arithmetic.
fn is_at_most(is: f64, should: f64, grain: f64) -> bool {
    let rounding = 1e-9 * should.abs().max(1.0);
    let below = should - is;
    (-(1e-3 * grain + rounding)..=2.0 * grain * (1.0 + 1e-6) + rounding).contains(&below)
}

impl<'p> Judge<'p> {
    /// A judge of a program that was printed so finely.
    #[must_use]
    pub const fn new(reachable: &'p ReachableProgram, reader: &'p dyn Reader, grain: Grain) -> Self {
        Self {
            reachable,
            reader,
            grain,
        }
    }

    /// The program.
    #[must_use]
    pub const fn reachable(&self) -> &'p ReachableProgram {
        self.reachable
    }

    fn program(&self) -> &'p Program {
        self.reachable.program()
    }

    /// Everything in which a deed is not what the op at a moment says; nothing when it is.
    #[must_use]
    pub fn mismatches(&self, moment: Moment, deed: &Deed) -> Vec<Mismatch> {
        let mut found = Vec::new();
        let program = self.program();
        let Some(op) = program.op(moment.op) else {
            return vec![Mismatch::Kind];
        };
        let axes = self.reachable.axes_after(moment.op);
        let cell = program.cell.as_ref();
        match (op.action, deed, axes) {
            (Action::Home, Deed::Axes(is), Some(should)) => self.axes(is, &should, Which::All, &mut found),
            (Action::AxisTravel { to: tip, orientation }, deed, Some(should)) => match deed {
                Deed::Axes(is) => self.axes(is, &should, Which::All, &mut found),
                Deed::AxesToPose(target) => {
                    self.target(moment.op, target, TipPose { tip, orientation }, &mut found);
                }
                Deed::Straight { .. } | Deed::Switch { .. } | Deed::AwaitInput(_) | Deed::Wait(_) => {
                    found.push(Mismatch::Kind);
                }
            },
            (
                Action::Travel { .. }
                | Action::Approach { .. }
                | Action::Retract { .. }
                | Action::Cut { .. }
                | Action::Turn { .. },
                Deed::Straight { to, pace, end },
                Some(_),
            ) => match self.line(moment) {
                Some(line) => {
                    self.target(moment.op, to, line.to, &mut found);
                    self.pace(moment.op, &line, *pace, &mut found);
                    self.end(moment, &op.action, *end, &mut found);
                }
                None => found.push(Mismatch::Kind),
            },
            (Action::Ultrasonic { state }, Deed::Switch { output, state: is }, _) => {
                let should = cell.and_then(|cell| cell.ultrasonic);
                if (Some(*output), *is) != (should, state) {
                    found.push(Mismatch::Output {
                        is: (*output, *is),
                        should: (should, state),
                    });
                }
            }
            (Action::AwaitReady, deed, _) => match (cell.map(|cell| cell.ready), deed) {
                (Some(Ready::Input(should)), Deed::AwaitInput(is)) if *is == should => {}
                (Some(Ready::Input(should)), &Deed::AwaitInput(is)) => {
                    found.push(Mismatch::Input { is, should });
                }
                (Some(Ready::After(should)), Deed::Wait(is)) => self.wait(*is, should, &mut found),
                (Some(Ready::Input(_) | Ready::After(_)) | None, _) => found.push(Mismatch::Kind),
            },
            (Action::Dwell { time }, Deed::Wait(is), _) => self.wait(*is, time, &mut found),
            (
                Action::Home
                | Action::Travel { .. }
                | Action::AxisTravel { .. }
                | Action::Approach { .. }
                | Action::Retract { .. }
                | Action::Cut { .. }
                | Action::Turn { .. }
                | Action::Ultrasonic { .. }
                | Action::Dwell { .. }
                | Action::ToolChange { .. },
                _,
                _,
            ) => found.push(Mismatch::Kind),
        }
        found
    }

    /// Whether a deed brings the machine to a waypoint on the way of the op at a moment, as the op itself would go on.
    #[must_use]
    pub fn passes(&self, moment: Moment, waypoint: &Waypoint, deed: &Deed) -> bool {
        self.mismatches_on_the_way(moment, waypoint, deed).is_empty()
    }

    /// Whether every waypoint has to be named.
    #[must_use]
    pub fn needs_waypoints(&self) -> bool {
        self.reader.says_waypoints()
    }

    /// Everything in which a deed is not the motion to a waypoint of the op at a moment.
    #[must_use]
    pub fn mismatches_on_the_way(&self, moment: Moment, waypoint: &Waypoint, deed: &Deed) -> Vec<Mismatch> {
        let (Deed::Straight { to, pace, .. }, Some(line)) = (deed, self.line(moment)) else {
            return vec![Mismatch::Kind];
        };
        let mut found = Vec::new();
        let branch = self.reachable.branch_after(moment.op);
        let stance = branch.and_then(|branch| self.reader.stance(branch, waypoint.axes));
        self.pose(to, waypoint.frame.origin, waypoint.frame.orientation, &mut found);
        self.stance(to, stance, &mut found);
        self.pace(moment.op, &line, *pace, &mut found);
        found
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

    /// Whether a deed leaves everything as it is before an op: the move to where the machine stands already, the state of
    /// the generator once more.
    #[must_use]
    pub fn restates(&self, moment: Moment, deed: &Deed) -> bool {
        let program = self.program();
        let cell = program.cell.as_ref();
        let before = moment.op.0.checked_sub(1).map(OpId);
        let stands = before.and_then(|before| self.reachable.axes_after(before));
        let generator = moment.before.generator;
        let mut found = Vec::new();
        match (deed, before, moment.before.place.pose()) {
            (Deed::Axes(is), _, _) => match stands {
                Some(should) => self.axes(is, &should, Which::All, &mut found),
                None => return false,
            },
            (Deed::AxesToPose(target), Some(before), Some(pose)) => {
                self.target(before, target, pose, &mut found);
            }
            (Deed::Switch { output, state }, _, _) => {
                let running = match generator {
                    Generator::Off => Switch::Off,
                    Generator::Starting | Generator::Running => Switch::On,
                };
                return *state == running && cell.is_some_and(|cell| cell.ultrasonic == Some(*output));
            }
            (Deed::AwaitInput(is), _, _) => {
                return generator == Generator::Running
                    && cell.is_some_and(|cell| cell.ready == Ready::Input(*is));
            }
            (Deed::Wait(is), _, _) => match (generator, cell.map(|cell| cell.ready)) {
                (Generator::Running, Some(Ready::After(should))) => self.wait(*is, should, &mut found),
                (Generator::Running | Generator::Starting | Generator::Off, _) => return false,
            },
            (Deed::AxesToPose(_) | Deed::Straight { .. }, _, _) => return false,
        }
        found.is_empty()
    }

    /// Whether two frames are the same within what is printed.
    pub(super) fn is_same_frame(&self, is: &Frame, should: &Frame) -> bool {
        let mut found = Vec::new();
        self.tip(is.origin, should.origin, &mut found);
        let by = is.orientation.angle_to(should.orientation);
        found.is_empty() && within(by.to_rad(), 0.0, self.grain.attitude.to_rad())
    }

    fn wait(&self, is: Duration, should: Duration, found: &mut Vec<Mismatch>) {
        if !within(is.to_s(), should.to_s(), self.grain.time.to_s()) {
            found.push(Mismatch::Time { is, should });
        }
    }

    fn axes(&self, is: &AxisValues, should: &AxisValues, which: Which, found: &mut Vec<Mismatch>) {
        let axes = self.program().cell.iter().flat_map(|cell| &cell.axes);
        for (axis, (known, (&is, &should))) in axes.zip(is.0.iter().zip(&should.0)).enumerate() {
            let grain = match (known.kind, which) {
                (AxisKind::Rotary, Which::All | Which::Rotary) => self.grain.axis.to_rad(),
                (AxisKind::Linear, Which::All) => self.grain.length.to_mm(),
                (AxisKind::Linear, Which::Rotary) => continue,
            };
            if !within(is, should, grain) {
                found.push(Mismatch::Axis { axis, is, should });
            }
        }
    }

    fn target(&self, op: OpId, is: &Target, should: TipPose, found: &mut Vec<Mismatch>) {
        let tip = should.tip;
        let orientation = self.program().orientation(should.orientation);
        let axes = self.reachable.axes_after(op);
        match (is.held, orientation, axes) {
            (Held::Orientation(_, stance), Some(orientation), Some(axes)) => {
                self.pose(is, tip, orientation, found);
                if stance.is_some() || self.must_say_stance(op) {
                    let branch = self.reachable.branch_after(op);
                    self.stance(
                        is,
                        branch.and_then(|branch| self.reader.stance(branch, axes)),
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
    fn must_say_stance(&self, op: OpId) -> bool {
        let action = self.program().op(op).map(|op| op.action);
        matches!(action, Some(Action::AxisTravel { .. }))
    }

    fn pose(&self, is: &Target, tip: Point3, orientation: Orientation, found: &mut Vec<Mismatch>) {
        self.tip(is.tip, tip, found);
        match is.held {
            Held::Orientation(held, _) => {
                let by = held.angle_to(orientation);
                if !within(by.to_rad(), 0.0, self.grain.attitude.to_rad()) {
                    found.push(Mismatch::Attitude { by });
                }
            }
            Held::Rotary(_) => found.push(Mismatch::Kind),
        }
    }

    fn stance(&self, is: &Target, should: Option<Stance>, found: &mut Vec<Mismatch>) {
        if let Held::Orientation(_, is) = is.held
            && is != should
        {
            found.push(Mismatch::Stance { is, should });
        }
    }

    fn tip(&self, is: Point3, should: Point3, found: &mut Vec<Mismatch>) {
        let grain = self.grain.length.to_mm();
        let near = [(is.x, should.x), (is.y, should.y), (is.z, should.z)]
            .into_iter()
            .all(|(is, should)| within(is, should, grain));
        if !near {
            found.push(Mismatch::Tip { is, should });
        }
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
                self.tip_speed(line, tip, found);
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
                if duration > Duration::ZERO && !is_at_most(is, should, self.grain.per_minute) {
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
        within(
            is.to_mm_per_s(),
            should.to_mm_per_s(),
            self.grain.speed.to_mm_per_s(),
        )
    }

    /// Whether a speed is the one that was proven, rounded down.
    fn is_rounded_down(&self, is: Speed, should: Speed) -> bool {
        is_at_most(
            is.to_mm_per_s(),
            should.to_mm_per_s(),
            self.grain.speed.to_mm_per_s(),
        )
    }

    /// Rates of turning are rounded down, so that no turn takes less than its proven time.
    fn is_rate(&self, is: AngularSpeed, should: AngularSpeed) -> bool {
        is_at_most(
            is.to_rad_per_s(),
            should.to_rad_per_s(),
            self.grain.rate.to_rad_per_s(),
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
        match end {
            End::Exact => {}
            End::Rounded if may_round(program.stock, before, action, next) => {}
            End::Rounded => found.push(Mismatch::NoStop),
        }
    }
}

/// Which axes are compared.
#[derive(Clone, Copy)]
enum Which {
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
