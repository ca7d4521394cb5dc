//! From what a program was read to do back to a program of ops, so that it can be proven like any other.
//!
//! Statements that read as they should keep the exact values of their ops. Others take the values as read, and are the kind
//! of op that they act like: a circular move and one that continues without a stop are pieces of a chain, a straight move along y through the stock with the blade held still is a cut, one that only
//! turns the blade is a turn, any other goes through the air, and must prove that it does.

use super::comparison::Comparison;
use super::meaning::says_the_same;
use super::steps::Step;
use core::num::NonZeroU32;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, AxisKind, AxisValues, Cell, FeedId, Flank, Joint, Op, OpId, OrientationId, Program, RateId,
    Ready, Site, Spindle, Switch, ToolId, ViaId,
};
use vcutc_backend_api::readback::{
    Circle, Command, Effect, End, FrameRole, Held, Mismatch, Moment, Pace, Target, rotary_way,
};
use vcutc_backend_api::state::{Drive, State, TipPose};
use vcutc_backend_api::swivel::Apart;
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Speed};
use vcutc_motion::rigs::Rigs;

/// A program as it was read.
pub(super) struct Rebuilt {
    pub(super) program: Program,
    /// For every op the statement of the given program that it came from.
    pub(super) origins: Vec<usize>,
    /// For every op that of the fresh program in whose place it stands.
    pub(super) partners: Vec<Option<OpId>>,
}

/// Why a program cannot be rebuilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Obstacle {
    /// A statement, by its number, is not understood.
    NotUnderstood(usize),
    /// Statements that are as they should be depend on one that is not, by its number.
    Depends(usize),
    /// A statement sets a frame that is not the job's.
    OtherFrame(usize),
    /// It says more postures or speeds than are compared.
    TooManyKinds(usize),
    /// How fast a motion goes is not said, or in a way that depends on the control.
    SpeedUnknown(usize),
}

/// Most entries of each table: no program of a job has so many.
const MOST_KINDS: usize = 4096;

/// Rebuilds the given program of a scene.
///
/// # Errors
/// The first statement that stands in the way.
pub(super) fn rebuild(
    comparison: &Comparison<'_>,
    steps: &[Step],
    rigs: &Rigs<'_>,
) -> Result<Rebuilt, Obstacle> {
    let fresh = comparison.program();
    let mut differs = None;
    let mut builder = Builder {
        comparison,
        rigs,
        moments: comparison.moments(),
        program: Program {
            ops: Vec::with_capacity(fresh.ops.len()),
            ..fresh.clone()
        },
        origins: Vec::new(),
        partners: Vec::new(),
        state: State::START,
        axes: None,
        site: Site::Program,
    };
    for &step in steps {
        match step {
            Step::Same { .. } | Step::OfPart { .. } => {}
            Step::Changed { given, .. }
            | Step::Moved { given, .. }
            | Step::Missing { given, .. }
            | Step::Added { given, .. } => differs = differs.or(Some(given)),
        }
        match step {
            Step::Same { fresh, given } => {
                let done = builder.statement(Some((fresh, Order::Kept)), given);
                done.map_err(|obstacle| match (obstacle, differs) {
                    (Obstacle::NotUnderstood(_), Some(cause)) => Obstacle::Depends(cause),
                    (obstacle, _) => obstacle,
                })?;
            }
            Step::Changed { fresh, given } => {
                let done = builder.statement(Some((fresh, Order::Kept)), given);
                let should = comparison
                    .fresh
                    .statements
                    .get(fresh)
                    .map(|should| &should.effect);
                done.map_err(|obstacle| match (obstacle, should) {
                    (Obstacle::NotUnderstood(given), Some(Effect::Frame(..) | Effect::Setting)) => {
                        Obstacle::Depends(given)
                    }
                    (obstacle, _) => obstacle,
                })?;
            }
            Step::Moved { fresh, given } => builder.statement(Some((fresh, Order::Lost)), given)?,
            Step::Added { given, .. } => builder.statement(None, given)?,
            Step::OfPart { given } => builder.of_part(given)?,
            Step::Missing { .. } => {}
        }
    }
    Ok(Rebuilt {
        program: builder.program,
        origins: builder.origins,
        partners: builder.partners,
    })
}

/// Whether a statement stands where it stood.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    Kept,
    Lost,
}

struct Builder<'b> {
    comparison: &'b Comparison<'b>,
    rigs: &'b Rigs<'b>,
    /// The moments before the ops of the fresh program.
    moments: Vec<Moment>,
    program: Program,
    origins: Vec<usize>,
    partners: Vec<Option<OpId>>,
    state: State,
    /// Where the rotary axes are, where the dialect says it.
    axes: Option<AxisValues>,
    site: Site,
}

/// The op in whose place a command stands, and what differs.
#[derive(Clone)]
struct Partner {
    moment: Moment,
    op: Op,
    differs: Vec<Mismatch>,
}

impl Partner {
    fn differs_in(&self, is_such: impl Fn(&Mismatch) -> bool) -> bool {
        self.differs.iter().any(is_such)
    }
}

impl Builder<'_> {
    fn statement(&mut self, partner: Option<(usize, Order)>, given: usize) -> Result<(), Obstacle> {
        let Some(is) = self.comparison.given.effect(given) else {
            return Ok(());
        };
        let should = partner.and_then(|(fresh, _)| self.comparison.fresh.effect(fresh));
        let reads_as_it_should = should.is_some_and(|should| says_the_same(should, is));
        match is {
            Effect::Setting | Effect::PartBegins => Ok(()),
            Effect::Frame(role, setting) => {
                let cell = self.program.cell.as_ref();
                let job = cell.map(|cell| match role {
                    FrameRole::Tool => cell.tools.at(self.state.tool).frame,
                    FrameRole::Base => cell.base,
                });
                if job.is_some_and(|job| self.comparison.comparator.is_frame(setting, &job)) {
                    Ok(())
                } else {
                    Err(Obstacle::OtherFrame(given))
                }
            }
            Effect::Command(command) => {
                let owner = partner.and_then(|(fresh, _)| self.comparison.owner(fresh));
                let order = partner.map_or(Order::Lost, |(_, order)| order);
                // A restatement, or a point on the way of an op.
                if owner.is_none() && reads_as_it_should && order == Order::Kept {
                    return Ok(());
                }
                let partner = owner.and_then(|id| self.partner(id, command));
                self.command(command, partner, given)
            }
            Effect::Unknown | Effect::Unreadable { .. } => Err(Obstacle::NotUnderstood(given)),
        }
    }

    /// What a part restates is not an op.
    fn of_part(&mut self, given: usize) -> Result<(), Obstacle> {
        match self.comparison.given.effect(given) {
            Some(Effect::Command(_)) => Ok(()),
            _ => self.statement(None, given),
        }
    }

    fn partner(&self, id: OpId, command: &Command) -> Option<Partner> {
        let op = *self.comparison.program().op(id)?;
        let moment = *self.moments.get(id.0 as usize)?;
        let differs = self.comparison.comparator.mismatches(moment, command);
        Some(Partner { moment, op, differs })
    }

    fn command(&mut self, command: &Command, partner: Option<Partner>, given: usize) -> Result<(), Obstacle> {
        let (id, site) = match &partner {
            Some(partner) => (Some(partner.moment.op), partner.op.site),
            None => (None, self.site),
        };
        // One that does another kind of thing is not a model for what it does.
        let partner = partner.filter(|partner| !partner.differs_in(|found| matches!(found, Mismatch::Kind)));
        let action = match command {
            Command::Axes(axes) => Some(self.axes(axes, partner.as_ref(), given)?),
            Command::AxesToPose(target) => {
                let TipPose { tip, orientation } = self.pose(target, partner.as_ref(), given)?;
                Some(Action::AxisTravel { to: tip, orientation })
            }
            Command::Straight { to, pace, end } => {
                let pose = self.pose(to, partner.as_ref(), given)?;
                let speeds = self.speeds(pose, to, *pace, partner.as_ref(), given)?;
                self.note_axes(to);
                Some(match (end, partner.as_ref().map(|partner| partner.op.action)) {
                    (End::Through { .. }, _) | (_, Some(Action::Follow { .. })) => {
                        self.piece(pose, None, speeds, (*end, given))?
                    }
                    (End::Exact | End::Rounded, _) => self.straight(pose, speeds, partner.as_ref()),
                })
            }
            Command::Round { on, to, pace, end } => {
                let pose = self.pose(to, partner.as_ref(), given)?;
                let via = self.via(*on, pose.tip, partner.as_ref(), given)?;
                let speeds = self.speeds(pose, to, *pace, partner.as_ref(), given)?;
                self.note_axes(to);
                Some(self.piece(pose, Some(via), speeds, (*end, given))?)
            }
            Command::Switch { output, state } => self.switch(*output, *state),
            Command::Spin(speed) => self.spin(*speed, partner.as_ref()),
            Command::AwaitInput(input) => self.await_input(*input),
            Command::Wait(time) => self.wait(*time, partner.as_ref()),
            Command::ChangeTool(place) => {
                let tool = self.tool(*place, partner.as_ref());
                let tool = tool.ok_or(Obstacle::NotUnderstood(given))?;
                Some(Action::ToolChange { tool })
            }
        };
        if let Some(action) = action {
            self.site = site;
            self.state = self.state.after(&action);
            self.program.ops.push(Op { site, action });
            self.origins.push(given);
            self.partners.push(id);
        }
        Ok(())
    }

    fn note_axes(&mut self, target: &Target) {
        if let Held::Rotary(rotary) = target.held {
            self.axes = Some(rotary);
        }
    }

    /// An axis move: home, to the change place, or to the pose that they give.
    fn axes(
        &mut self,
        axes: &AxisValues,
        partner: Option<&Partner>,
        given: usize,
    ) -> Result<Action, Obstacle> {
        self.axes = Some(*axes);
        if let Some(Partner { op, differs, .. }) = partner
            && differs.is_empty()
        {
            return Ok(op.action);
        }
        for action in [Action::Home, Action::ChangePlace] {
            if self.is_at(action, axes) {
                return Ok(action);
            }
        }
        let blade = Frame::from(self.rigs.with(self.state.tool).blade_in_work(&axes.0));
        let orientation = self.orientation(blade.orientation, given)?;
        Ok(Action::AxisTravel {
            to: blade.origin,
            orientation,
        })
    }

    /// Whether axis values are those of an action, home or the change place.
    fn is_at(&self, action: Action, axes: &AxisValues) -> bool {
        let ops = &self.comparison.program().ops;
        let there = ops.iter().position(|op| op.action == action);
        let there = there.and_then(|there| self.moments.get(there));
        there.is_some_and(|there| {
            self.comparison
                .comparator
                .mismatches(*there, &Command::Axes(*axes))
                .is_empty()
        })
    }

    /// The tool that a change puts in: the one that is kept at a place. By hand it is the one that the job says.
    fn tool(&self, place: Option<u32>, partner: Option<&Partner>) -> Option<ToolId> {
        let cell = self.program.cell.as_ref()?;
        match (place, partner.map(|partner| partner.op.action)) {
            (Some(place), _) => cell.tools.at_place(place),
            (None, Some(Action::ToolChange { tool })) => Some(tool),
            (None, Some(_) | None) => None,
        }
    }

    /// The pose of a target: exact where it is that of its partner within what is printed.
    fn pose(
        &mut self,
        target: &Target,
        partner: Option<&Partner>,
        given: usize,
    ) -> Result<TipPose, Obstacle> {
        let exact = partner.and_then(|partner| {
            let after = partner.moment.before.after(&partner.op.action);
            Some((partner, after.place.pose()?))
        });
        let tip = match exact {
            Some((partner, pose)) if !partner.differs_in(|found| matches!(found, Mismatch::Tip { .. })) => {
                pose.tip
            }
            Some(_) | None => target.tip,
        };
        let is_of_attitude =
            |found: &Mismatch| matches!(found, Mismatch::Attitude { .. } | Mismatch::Axis { .. });
        let orientation = match exact {
            Some((partner, pose)) if !partner.differs_in(is_of_attitude) => pose.orientation,
            Some(_) | None => {
                let orientation = match target.held {
                    Held::Orientation(orientation, _) => orientation,
                    Held::Rotary(rotary) => {
                        Frame::from(self.rigs.with(self.state.tool).blade_in_work(&rotary.0)).orientation
                    }
                };
                self.orientation(orientation, given)?
            }
        };
        Ok(TipPose { tip, orientation })
    }

    /// The entry of the table that is this orientation within what is printed, or a new one.
    fn orientation(&mut self, orientation: Orientation, given: usize) -> Result<OrientationId, Obstacle> {
        let resolution = self.comparison.resolution.attitude.to_rad() + SAME_ATTITUDE;
        let is_known = |known: &Orientation| known.angle_to(orientation).to_rad() <= resolution;
        number(&mut self.program.orientations, orientation, is_known)
            .map(|number| OrientationId(u32::from(number)))
            .ok_or(Obstacle::TooManyKinds(given))
    }

    fn feed(&mut self, feed: Speed, given: usize) -> Result<FeedId, Obstacle> {
        let resolution = self.comparison.resolution.speed.to_mm_per_s() + SAME_SPEED;
        let is_known = |known: &Speed| (known.to_mm_per_s() - feed.to_mm_per_s()).abs() <= resolution;
        number(&mut self.program.feeds, feed, is_known)
            .map(FeedId)
            .ok_or(Obstacle::TooManyKinds(given))
    }

    fn rate(&mut self, rate: AngularSpeed, given: usize) -> Result<RateId, Obstacle> {
        let resolution = self.comparison.resolution.rate.to_rad_per_s() + SAME_SPEED;
        let is_known =
            |known: &AngularSpeed| (known.to_rad_per_s() - rate.to_rad_per_s()).abs() <= resolution;
        number(&mut self.program.rates, rate, is_known)
            .map(RateId)
            .ok_or(Obstacle::TooManyKinds(given))
    }

    /// The speeds of a straight motion: those of its partner where they are the same within what is printed.
    fn speeds(
        &mut self,
        to: TipPose,
        target: &Target,
        pace: Pace,
        partner: Option<&Partner>,
        given: usize,
    ) -> Result<(FeedId, RateId), Obstacle> {
        let is_of_speed = |found: &Mismatch| {
            matches!(
                found,
                Mismatch::Feed { .. } | Mismatch::Rate { .. } | Mismatch::Time { .. }
            )
        };
        let asked =
            partner
                .filter(|partner| !partner.differs_in(is_of_speed))
                .map_or((None, None), |partner| {
                    let action = &partner.op.action;
                    (action.feed(), action.rate())
                });
        let (feed, rate) = self.as_read(to, target, pace);
        let feed = match (asked.0, feed) {
            (Some(feed), _) => feed,
            (None, Some(feed)) => self.feed(feed, given)?,
            (None, None) if self.moves(to) => return Err(Obstacle::SpeedUnknown(given)),
            (None, None) => FeedId(0),
        };
        let rate = match (asked.1, rate) {
            (Some(rate), _) => rate,
            (None, Some(rate)) => self.rate(rate, given)?,
            (None, None) if self.turns(to) => return Err(Obstacle::SpeedUnknown(given)),
            (None, None) => RateId(0),
        };
        Ok((feed, rate))
    }

    /// The pose of the blade here, where that is known.
    const fn here(&self) -> Option<TipPose> {
        self.state.place.pose()
    }

    /// Whether the tip is elsewhere at a pose than here.
    fn moves(&self, to: TipPose) -> bool {
        self.here().is_some_and(|from| from.tip != to.tip)
    }

    /// Whether the blade is held otherwise at a pose than here.
    fn turns(&self, to: TipPose) -> bool {
        self.here().is_some_and(|from| from.orientation != to.orientation)
    }

    /// The speeds that a pace comes to between here and a pose, as far as it decides them.
    fn as_read(&self, to: TipPose, target: &Target, pace: Pace) -> (Option<Speed>, Option<AngularSpeed>) {
        if let Pace::Speeds { tip, turn } = pace {
            return (tip, turn);
        }
        let Some(from) = self.here() else {
            return (None, None);
        };
        let held = |pose: TipPose| self.program.orientation(pose.orientation);
        let ends = held(from).zip(held(to));
        if let Pace::Apart { tip, swivel, twist } = pace {
            let rates = swivel.zip(twist).map(|(swivel, twist)| Apart { swivel, twist });
            let ends = ends.filter(|_| self.turns(to));
            let turn = rates.zip(ends).map(|(rates, (from, to))| rates.whole(from, to));
            return (tip, turn);
        }
        let length = from.tip.distance(to.tip);
        let turn = ends.map_or(Angle::ZERO, |(from, to)| from.angle_to(to));
        let duration = match pace {
            Pace::Speeds { .. } | Pace::Apart { .. } => return (None, None),
            Pace::Tip(feed) => {
                let duration = length / feed;
                let turns = turn > Angle::ZERO && duration > Duration::ZERO && duration.is_finite();
                return (Some(feed), turns.then(|| turn / duration));
            }
            Pace::PerMinute(times) => Duration::s(60.0 / times),
            Pace::Rotary(rate) => Angle::rad(self.rotary_way(target)) / rate,
        };
        let moves = |amount: f64| amount > 0.0 && duration.is_finite() && duration > Duration::ZERO;
        (
            moves(length.to_mm()).then(|| length / duration),
            moves(turn.to_rad()).then(|| turn / duration),
        )
    }

    fn rotary_way(&self, target: &Target) -> f64 {
        let cell = self.program.cell.as_ref();
        let kinds = cell.iter().flat_map(|cell| &cell.axes).map(|axis| axis.kind);
        match (target.held, self.axes) {
            (Held::Rotary(to), Some(from)) => rotary_way(kinds, &only_rotary(cell, &from), &to),
            (Held::Orientation(..) | Held::Rotary(_), _) => 0.0,
        }
    }

    fn straight(&self, pose: TipPose, speeds: (FeedId, RateId), partner: Option<&Partner>) -> Action {
        let TipPose { tip: to, orientation } = pose;
        let (feed, rate) = speeds;
        let travel = Action::Travel {
            to,
            orientation,
            feed,
            rate,
        };
        let Some(TipPose { tip: from, .. }) = self.here() else {
            return travel;
        };
        let keeps_attitude = !self.turns(pose);
        match partner.map(|partner| partner.op.action) {
            Some(Action::Cut { flank, .. }) if keeps_attitude => Action::Cut { flank, to, feed },
            Some(Action::Approach { .. }) if keeps_attitude => Action::Approach { to, feed },
            Some(Action::Retract { .. }) if keeps_attitude => Action::Retract { to, feed },
            Some(Action::Turn { .. }) if from == to => Action::Turn {
                to: orientation,
                rate,
            },
            Some(_) => travel,
            None if keeps_attitude && self.is_through_stock(from, to) => Action::Cut {
                flank: self.flank(orientation),
                to,
                feed,
            },
            None if from == to => Action::Turn {
                to: orientation,
                rate,
            },
            None => travel,
        }
    }

    /// A piece of a chain to a pose.
    fn piece(
        &mut self,
        TipPose { tip: to, orientation }: TipPose,
        via: Option<ViaId>,
        (feed, rate): (FeedId, RateId),
        (end, given): (End, usize),
    ) -> Result<Action, Obstacle> {
        let joint = match end {
            End::Exact => Joint::Stop,
            // Nothing says how far the tip leaves the chain.
            End::Rounded => return Err(Obstacle::NotUnderstood(given)),
            End::Through { within } => {
                self.program.blend = self.program.blend.max(within);
                Joint::Through
            }
        };
        Ok(Action::Follow {
            to,
            orientation,
            via,
            feed,
            rate,
            joint,
        })
    }

    /// The point by which an arc is known: that of its partner where it is the same within what is printed.
    fn via(
        &mut self,
        on: Circle,
        to: Point3,
        partner: Option<&Partner>,
        given: usize,
    ) -> Result<ViaId, Obstacle> {
        let asked =
            partner.filter(|partner| !partner.differs_in(|found| matches!(found, Mismatch::Arc { .. })));
        if let Some(via) = asked.and_then(|partner| partner.op.action.via()) {
            return Ok(via);
        }
        let via = match on {
            Circle::Via(via) => Some(via),
            Circle::About { centre, axis } => self.here().and_then(|from| {
                let arc = CircularArc::about(
                    centre.to_array(),
                    axis.to_array(),
                    [from.tip, to].map(Point3::to_array),
                )?;
                Some(Point3::from(arc.at(0.5 * arc.sweep().to_rad())))
            }),
        };
        let via = via.ok_or(Obstacle::NotUnderstood(given))?;
        self.program.vias.push(via);
        let number = u32::try_from(self.program.vias.len())
            .ok()
            .and_then(NonZeroU32::new);
        number.map(ViaId).ok_or(Obstacle::TooManyKinds(given))
    }

    /// Whether a straight way runs along y through the whole stock, below its top.
    fn is_through_stock(&self, from: Point3, to: Point3) -> bool {
        let stock = self.program.stock;
        let along_y = (to.x - from.x).abs() < SAME_PLACE && (to.z - from.z).abs() < SAME_PLACE;
        along_y
            && from.y.min(to.y) <= SAME_PLACE
            && from.y.max(to.y) >= stock.depth.to_mm() - SAME_PLACE
            && from.z < stock.height.to_mm() - SAME_PLACE
    }

    /// The flank that a posture cuts: the shank leans to its side.
    fn flank(&self, orientation: OrientationId) -> Flank {
        let leans_left = self.program.orientation(orientation).is_some_and(|held| {
            let [[_, _, along_x], ..] = held.matrix();
            -along_x < 0.0
        });
        if leans_left { Flank::Left } else { Flank::Right }
    }

    /// A switch of generator or spindle; other outputs do nothing to the blade, and neither does what is so already.
    fn switch(&self, output: u32, state: Switch) -> Option<Action> {
        let cell = self.program.cell.as_ref()?;
        if cell.ultrasonic == Some(output) {
            return (self.state.generator.is_on() != state).then_some(Action::Ultrasonic { state });
        }
        let is_spindle = cell.spindle == Some(Spindle::Output(output));
        (is_spindle && self.state.spindle.is_on() != state).then_some(Action::Spin { state })
    }

    /// The control's own spindle at a speed. The speed is the blade's: at another one it stands still, as the proof sees it.
    fn spin(&self, speed: Option<AngularSpeed>, partner: Option<&Partner>) -> Option<Action> {
        let is_off =
            partner.is_some_and(|partner| partner.differs_in(|found| matches!(found, Mismatch::Spin { .. })));
        let state = match speed {
            Some(_) if !is_off => Switch::On,
            Some(_) | None => Switch::Off,
        };
        (self.state.spindle.is_on() != state).then_some(Action::Spin { state })
    }

    fn await_input(&self, input: u32) -> Option<Action> {
        let cell = self.program.cell.as_ref()?;
        (cell.ready == Ready::Input(input) && self.is_starting()).then_some(Action::AwaitReady)
    }

    fn wait(&self, time: Duration, partner: Option<&Partner>) -> Option<Action> {
        let cell = self.program.cell.as_ref()?;
        let is_enough = match cell.ready {
            Ready::Input(_) => false,
            Ready::After(least) => time + self.comparison.resolution.time >= least,
        };
        if is_enough && self.is_starting() {
            return Some(Action::AwaitReady);
        }
        match partner {
            Some(Partner { op, differs, .. }) if differs.is_empty() => match op.action {
                // A wait that stands where nothing starts up.
                Action::AwaitReady => Some(Action::Dwell { time }),
                action => Some(action),
            },
            Some(_) | None => Some(Action::Dwell { time }),
        }
    }

    fn is_starting(&self) -> bool {
        [self.state.generator, self.state.spindle].contains(&Drive::Starting)
    }
}

/// Orientations nearer than this are the same, in rad, whatever a dialect prints.
const SAME_ATTITUDE: f64 = 1e-9;

/// Speeds nearer than this are the same, in mm/s and rad/s, whatever a dialect prints.
const SAME_SPEED: f64 = 1e-9;

/// Coordinates nearer than this are the same, in mm, as in the program's verifier.
const SAME_PLACE: f64 = 1e-6;

/// The place of a speed in its table, where it is put if it is not there.
fn number<T>(table: &mut Vec<T>, value: T, is_known: impl Fn(&T) -> bool) -> Option<u16> {
    let index = table.iter().position(is_known);
    let index = match index {
        Some(index) => index,
        None if table.len() < MOST_KINDS => {
            table.push(value);
            table.len() - 1
        }
        None => return None,
    };
    u16::try_from(index).ok()
}

/// Axis values with 0 for the linear axes.
fn only_rotary(cell: Option<&Cell>, values: &AxisValues) -> AxisValues {
    let mut rotary = *values;
    let axes = cell.iter().flat_map(|cell| &cell.axes);
    for (axis, value) in axes.zip(&mut rotary.0) {
        if axis.kind == AxisKind::Linear {
            *value = 0.0;
        }
    }
    rotary
}
