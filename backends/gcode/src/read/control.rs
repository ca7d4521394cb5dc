//! What holds at a block, and what the block therefore does.
//!
//! A motion is reported only where the program has said everything that it depends on, and is what programs
//! of this crate have: absolute coordinates in mm, tool-centre-point control on or off as the motion needs
//! it, a tool and a work offset, a meaning of F, a way to stop. Coordinates that a block leaves out are those
//! of the block before, which is the controller's rule too; after a switch of tool-centre-point control the
//! linear ones mean something else and have to be said again.

use super::arcs::{self, About, Said};
use super::context::Context;
use super::rates::is_too_fast;
use crate::axes::WorkInOffset;
use crate::codes::Role;
use crate::controller::{AxisPace, Facts, TcpCodes, Unnumbered};
use crate::statement::{
    Act, CONVENTIONS, Convention, Coordinates, Cycle, FeedMode, Mode, Motion, Once, Order, Parsed, Plane,
    ReadError, Tcp, expected,
};
use crate::tools;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{AxisKind, AxisValues, Changer, MOST_AXES, Ready, Switch, ToolId};
use vcutc_backend_api::readback::{
    Circle, Command, Effect, End, FrameRole, FrameSetting, Held, Pace, Target,
};
use vcutc_backend_api::units::{AngularSpeed, Speed};

/// Number of the work offset when the job gives none.
const FIRST_OFFSET: u32 = 1;

const SECONDS_A_MINUTE: f64 = 60.0;

/// The state of a control.
pub(super) struct Control<'a> {
    context: Context<'a>,
    work_in_offset: WorkInOffset,
    modes: Modes,
    /// The kind of motion that was named last.
    motion: Option<Motion>,
    /// F, while its meaning is the same.
    feed: Option<f64>,
    /// Where the tip is said to be, in the frame of the work offset.
    tip: [Option<f64>; 3],
    /// Where the axes are said to be, in mm and degrees; linear ones while the tip is not controlled.
    axes: [Option<f64>; MOST_AXES],
    /// The cycle whose first line was the statement before.
    cycle: Option<Cycle>,
    reading: Reading,
    /// The tool at hand; none where a person has put in another, and the next number says which.
    tool: Option<ToolId>,
}

/// What holds, as far as it has been said.
#[derive(Clone, Copy, Debug, Default)]
struct Modes {
    conventions: [Once; CONVENTIONS],
    feed: Option<FeedMode>,
    stop: Option<End>,
    plane: Option<Plane>,
    pole: Option<[f64; 2]>,
    tcp: Option<Tcp>,
    tool: Option<u32>,
    work: Option<u32>,
}

/// Whether reading ahead has been stopped since the last motion.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reading {
    Ahead,
    Stopped,
}

impl Modes {
    fn convention(&mut self, convention: Convention) -> Option<&mut Once> {
        self.conventions.get_mut(convention as usize)
    }

    fn has(&self, convention: Convention) -> bool {
        self.conventions.get(convention as usize) == Some(&Once::Yes)
    }
}

impl<'a> Control<'a> {
    /// Nothing said yet.
    pub(super) fn new(context: Context<'a>) -> Self {
        let mut control = Self {
            context,
            work_in_offset: WorkInOffset::new(context.cell.base.frame.orientation),
            modes: Modes::default(),
            motion: None,
            feed: None,
            tip: [None; 3],
            axes: [None; MOST_AXES],
            cycle: None,
            reading: Reading::Ahead,
            tool: Some(ToolId::FIRST),
        };
        control.restart();
        control
    }

    /// A part begins, or others have changed the blade: everything has to be said again.
    pub(super) fn restart(&mut self) {
        self.modes = Modes::default();
        for &mode in self.facts().unsaid {
            self.set(mode);
        }
        (self.motion, self.feed) = (None, None);
        self.forget();
    }

    /// It is not known where the machine is.
    pub(super) fn forget(&mut self) {
        self.tip = [None; 3];
        self.axes = [None; MOST_AXES];
        self.cycle = None;
        self.reading = Reading::Ahead;
    }

    /// Whether the tip is controlled, or not, or being switched.
    pub(super) fn switch_tcp(&mut self, tcp: Option<Tcp>) {
        self.set(Mode::Tcp(tcp));
    }

    /// What a block does. A block that says where things go on does nothing else, and is not handled by the
    /// control.
    pub(super) fn carry_out(&mut self, order: &Order<'_>) -> Parsed<Effect> {
        let cycle = self.cycle.take();
        if let Some(missing) = missing(cycle, order.act) {
            return expected(missing);
        }
        let effect = self.modes(&order.modes)?;
        if let Some(motion) = order.motion {
            self.motion = Some(motion);
        }
        let moves = order.has_axes();
        if order.has_arc() && !moves {
            return Err(ReadError::Unknown);
        }
        if usize::from(moves) + usize::from(order.act.is_some()) + usize::from(order.flow.is_some()) > 1 {
            return expected("one thing that is done in a block");
        }
        if moves {
            if order.modes.iter().any(|mode| matches!(mode, Mode::Tcp(_))) {
                return expected("the switch of tool-centre-point control in a block of its own");
            }
            let command = match order.coordinates {
                Coordinates::Work => self.of_tip(order)?,
                Coordinates::Machine => self.all_axes(order)?,
            };
            self.reading = Reading::Ahead;
            return Ok(Effect::Command(command));
        }
        if order.coordinates == Coordinates::Machine || order.exact_once == Once::Yes {
            return expected("coordinates");
        }
        if order.feed.is_some() {
            self.feed = order.feed;
        }
        match order.act {
            Some(act) => self.act(act, order.after_stop, cycle),
            None => Ok(effect),
        }
    }

    /// Sets modes. Returns the effect to report if the block has nothing else.
    fn modes(&mut self, modes: &[Mode]) -> Parsed<Effect> {
        let mut effect = Effect::Setting;
        let mut error = None;
        for &mode in modes {
            self.set(mode);
            match self.judged(mode) {
                Ok(Effect::Setting) => {}
                Ok(other) => effect = other,
                Err(wrong) => error = Some(wrong),
            }
        }
        error.map_or(Ok(effect), Err)
    }

    fn set(&mut self, mode: Mode) {
        match mode {
            Mode::Convention(convention) | Mode::Not(convention) => {
                let is_kept = matches!(mode, Mode::Convention(_));
                if let Some(held) = self.modes.convention(convention) {
                    *held = if is_kept { Once::Yes } else { Once::No };
                }
            }
            Mode::Feed(feed) => {
                if self.modes.feed != feed {
                    self.feed = None;
                }
                self.modes.feed = feed;
            }
            Mode::Stop(stop) => self.modes.stop = stop,
            Mode::Plane(plane) => self.modes.plane = Some(plane),
            Mode::Pole(pole) => self.modes.pole = Some(pole),
            Mode::Tcp(tcp) => {
                if self.modes.tcp != tcp {
                    self.tip = [None; 3];
                    self.forget_linear_axes();
                }
                self.modes.tcp = tcp;
            }
            Mode::Tool(tool) => {
                // A kinematics that the machine's builder switches takes the offset at hand: the axes would have to jump.
                let jumps = self.facts().tcp_codes == TcpCodes::Given && self.modes.tool != tool;
                if jumps && self.modes.tcp == Some(Tcp::On) {
                    self.set(Mode::Tcp(None));
                }
                self.modes.tool = tool;
                if let (None, Some(number @ 1..)) = (self.tool, tool) {
                    self.tool = tools::numbered(self.context.cell, self.context.settings, number);
                }
            }
            Mode::Work(work) => self.modes.work = Some(work),
            Mode::Cycle(cycle) => self.cycle = Some(cycle),
        }
    }

    fn forget_linear_axes(&mut self) {
        for word in self.context.words {
            match (word.kind, self.axes.get_mut(word.place)) {
                (AxisKind::Linear, Some(axis)) => *axis = None,
                (AxisKind::Rotary | AxisKind::Linear, _) => {}
            }
        }
    }

    /// Whether a mode is one that programs of this crate have.
    fn judged(&self, mode: Mode) -> Parsed<Effect> {
        let cell = self.context.cell;
        match mode {
            Mode::Convention(_)
            | Mode::Feed(Some(_))
            | Mode::Stop(Some(_))
            | Mode::Plane(_)
            | Mode::Pole(_)
            | Mode::Tcp(_)
            | Mode::Cycle(_) => Ok(Effect::Setting),
            Mode::Not(convention) => match self
                .facts()
                .conventions
                .iter()
                .find(|(known, _)| *known == convention)
            {
                Some((_, words)) => expected(format!("`{words}`")),
                None => Err(ReadError::Unknown),
            },
            Mode::Feed(None) => expected("a speed in mm/min or inverse time"),
            Mode::Stop(None) => expected(match self.context.settings.common.approximation {
                Some(distance) => format!(
                    "`{}`, or rounding by {} mm",
                    self.facts().exact_word,
                    distance.to_mm()
                ),
                None => format!("`{}`", self.facts().exact_word),
            }),
            Mode::Tool(None | Some(0)) => Ok(Effect::Setting),
            Mode::Tool(Some(is)) => {
                let number = cell.tools.at(self.tool()).frame.number;
                frame(FrameRole::Tool, is, number, self.tool_number())
            }
            Mode::Work(is) => frame(FrameRole::Base, is, cell.base.number, FIRST_OFFSET),
        }
    }

    fn facts(&self) -> &'static Facts {
        self.context.settings.facts()
    }

    /// The tool at hand; the first one where a person has put in another and no number says which.
    fn tool(&self) -> ToolId {
        self.tool.unwrap_or(ToolId::FIRST)
    }

    /// Its number in the control's table.
    fn tool_number(&self) -> u32 {
        tools::number(self.context.cell, self.context.settings, self.tool())
    }

    /// A tool that is called by its number, and put in unless it is in the spindle.
    fn call(&mut self, number: u32) -> Parsed<Effect> {
        let Context { cell, settings, .. } = self.context;
        let other = tools::numbered(cell, settings, number).filter(|&tool| tool != self.tool());
        let (Some(tool), Some(_)) = (other, cell.changer()) else {
            return self.modes(&[Mode::Tool(Some(number))]);
        };
        self.put_in(Some(tool));
        self.modes(&[Mode::Tool(Some(number))])?;
        Ok(Effect::Command(Command::ChangeTool(cell.named_place(tool))))
    }

    /// A blade is changed, which may leave the axes anywhere.
    fn put_in(&mut self, tool: Option<ToolId>) {
        self.tool = tool;
        self.forget();
    }

    /// What a kind of motion depends on.
    fn conventions(&self, needs: impl Fn(Convention) -> bool) -> Parsed<()> {
        let mut conventions = self.facts().conventions.iter();
        let is_missing = |convention| needs(convention) && !self.modes.has(convention);
        match conventions.find(|(convention, _)| is_missing(*convention)) {
            Some((_, words)) => expected(format!("`{words}` before a motion")),
            None => Ok(()),
        }
    }

    /// A motion of the tip.
    fn of_tip(&mut self, order: &Order<'_>) -> Parsed<Command> {
        self.is_set_for_tip()?;
        let motion = match self.motion {
            Some(motion @ (Motion::AtFeed | Motion::Round(_) | Motion::Via)) => motion,
            Some(Motion::Rapid) | None => return expected("a motion with a speed"),
        };
        let end = match (order.exact_once, self.modes.stop) {
            (Once::Yes, _) => End::Exact,
            (Once::No, Some(end)) => end,
            (Once::No, None) => return expected(format!("`{}` before a motion", self.facts().exact_word)),
        };
        let before = self.tip;
        self.take(order);
        let [Some(x), Some(y), Some(z)] = self.tip else {
            return expected("all of X, Y and Z after a switch of tool-centre-point control");
        };
        let mut rotary = AxisValues([0.0; MOST_AXES]);
        self.values(&mut rotary, AxisKind::Rotary)?;
        let pace = self.pace(order, before)?;
        self.forget_linear_axes();
        let on = self.circle(motion, order, (before, [x, y, z]))?;
        let tip = self.work_in_offset.in_work(Point3::new(x, y, z));
        let to = Target {
            tip,
            held: Held::Rotary(rotary),
        };
        Ok(match on {
            None => Command::Straight { to, pace, end },
            Some(on) => Command::Round { on, to, pace, end },
        })
    }

    /// The arc on which the tip moves; none for a straight motion.
    fn circle(
        &self,
        motion: Motion,
        order: &Order<'_>,
        (before, to): ([Option<f64>; 3], [f64; 3]),
    ) -> Parsed<Option<Circle>> {
        let in_work = |point: [f64; 3]| self.work_in_offset.in_work(Point3::from(point));
        let sense = match motion {
            Motion::Round(sense) => sense,
            Motion::Via => return Ok(Some(Circle::Via(in_work(arcs::via(order)?)))),
            Motion::AtFeed | Motion::Rapid if order.has_arc() => return Err(ReadError::Unknown),
            Motion::AtFeed | Motion::Rapid => return Ok(None),
        };
        self.conventions(|convention| convention == Convention::CentresFromStart)?;
        let [Some(x), Some(y), Some(z)] = before else {
            return expected("a motion to all of X, Y and Z before an arc");
        };
        let Modes { plane, pole, .. } = self.modes;
        let said = (sense, Said { plane, pole });
        let About { centre, axis } = arcs::about(order, said, self.context.settings, [[x, y, z], to])?;
        // A frame that is only turned turns directions as it turns points.
        Ok(Some(Circle::About {
            centre: in_work(centre),
            axis: in_work(axis),
        }))
    }

    /// What a motion of the tip depends on.
    fn is_set_for_tip(&self) -> Parsed<()> {
        self.conventions(|convention| convention != Convention::CentresFromStart)?;
        if self.modes.tcp != Some(Tcp::On) {
            return expected("tool-centre-point control on, or coordinates of the machine");
        }
        let tool = self.tool_number();
        if self.modes.tool != Some(tool) {
            return expected(format!("tool {tool} before a motion of the tip"));
        }
        let offset = self.context.cell.base.number.unwrap_or(FIRST_OFFSET);
        let is_said = match (self.facts().unnumbered, self.context.cell.base.number) {
            (Unnumbered::First, _) | (Unnumbered::Operators, Some(_)) => true,
            (Unnumbered::Operators, None) => false,
        };
        if is_said && self.modes.work != Some(offset) {
            return expected(format!("work offset {offset} before a motion of the tip"));
        }
        Ok(())
    }

    /// A motion of all axes.
    fn all_axes(&mut self, order: &Order<'_>) -> Parsed<Command> {
        if order.has_arc() {
            return Err(ReadError::Unknown);
        }
        self.conventions(is_of_axes)?;
        if self.modes.tcp != Some(Tcp::Off) {
            return expected("tool-centre-point control off before coordinates of the machine");
        }
        if let Some(tool) = self.facts().tool_of_axis_moves
            && self.modes.tool != Some(tool)
        {
            return expected("`D0` with coordinates of the machine");
        }
        if order.exact_once == Once::No && self.modes.stop != Some(End::Exact) {
            return expected(format!(
                "`{}` before a motion of all axes",
                self.facts().exact_word
            ));
        }
        let from = self.axes;
        self.tip = [None; 3];
        for (known, said) in self.axes.iter_mut().zip(order.axes) {
            *known = said.or(*known);
        }
        let pace = self.facts().axis_pace;
        match (pace, self.motion) {
            (AxisPace::Rapid, Some(Motion::Rapid)) => {}
            (AxisPace::Rapid, _) => {
                return expected("`G0` with coordinates of the machine");
            }
            (AxisPace::InverseTime, Some(Motion::AtFeed))
                if self.modes.feed != Some(FeedMode::InverseTime) =>
            {
                return expected("`G93` before a motion of all axes");
            }
            (AxisPace::InverseTime | AxisPace::Path, Some(Motion::AtFeed)) => {
                let feed = self.speed(order)?;
                if is_too_fast(self.context, pace, feed, &from, &self.axes) {
                    let percent = self.context.settings.home_speed * 100.0;
                    return expected(format!(
                        "a lower `F`: no axis faster than {percent:.0} % of its rate"
                    ));
                }
            }
            (
                AxisPace::InverseTime | AxisPace::Path,
                Some(Motion::Rapid | Motion::Round(_) | Motion::Via) | None,
            ) => {
                return expected("a motion with a speed");
            }
        }
        let mut axes = AxisValues([0.0; MOST_AXES]);
        self.values(&mut axes, AxisKind::Linear)?;
        self.values(&mut axes, AxisKind::Rotary)?;
        Ok(Command::Axes(axes))
    }

    /// Takes over the coordinates of a motion of the tip.
    fn take(&mut self, order: &Order<'_>) {
        for word in self.context.words {
            let Some(&Some(said)) = order.axes.get(word.place) else {
                continue;
            };
            let known = match word.kind {
                AxisKind::Linear => tip_place(word.letter).and_then(|place| self.tip.get_mut(place)),
                AxisKind::Rotary => self.axes.get_mut(word.place),
            };
            if let Some(known) = known {
                *known = Some(said);
            }
        }
    }

    /// The axes of a kind, in mm and rad.
    fn values(&self, into: &mut AxisValues, kind: AxisKind) -> Parsed<()> {
        for word in self.context.words.iter().filter(|word| word.kind == kind) {
            let known = self.axes.get(word.place).copied().flatten();
            let (Some(value), Some(place)) = (known, into.0.get_mut(word.place)) else {
                return expected(format!("the word `{}`", char::from(word.letter)));
            };
            *place = match kind {
                AxisKind::Linear => value,
                AxisKind::Rotary => value.to_radians(),
            };
        }
        Ok(())
    }

    /// The number after F that counts for a block.
    fn speed(&mut self, order: &Order<'_>) -> Parsed<f64> {
        let said = match self.modes.feed {
            // Inverse time is that of one block.
            Some(FeedMode::InverseTime) => order.feed,
            Some(FeedMode::Tip | FeedMode::Rotary) => {
                self.feed = order.feed.or(self.feed);
                self.feed
            }
            None => return expected("the meaning of `F` before a motion"),
        };
        match said {
            Some(feed) if feed > 0.0 => Ok(feed),
            Some(_) => expected("a speed above 0 after `F`"),
            None => expected("the word `F`"),
        }
    }

    fn pace(&mut self, order: &Order<'_>, before: [Option<f64>; 3]) -> Parsed<Pace> {
        let feed = self.speed(order)?;
        match self.modes.feed {
            Some(FeedMode::Tip) => Ok(Pace::Tip(Speed::mm_per_s(feed / SECONDS_A_MINUTE))),
            Some(FeedMode::InverseTime) => Ok(Pace::PerMinute(feed)),
            Some(FeedMode::Rotary) if self.moves_the_tip(before) => {
                expected("rotary axes alone, for `F` is the speed of all axes that are named")
            }
            Some(FeedMode::Rotary) => Ok(Pace::Rotary(AngularSpeed::deg_per_s(feed / SECONDS_A_MINUTE))),
            None => expected("the meaning of `F` before a motion"),
        }
    }

    /// Whether the tip goes farther than by its last decimal.
    fn moves_the_tip(&self, before: [Option<f64>; 3]) -> bool {
        let unit = self.context.settings.common.lengths.unit();
        let ways = self.tip.into_iter().zip(before);
        ways.filter_map(|(to, from)| Some((to? - from?).abs()))
            .any(|way| way > unit * 1.5)
    }

    fn act(&mut self, act: Act, after_stop: Once, cycle: Option<Cycle>) -> Parsed<Effect> {
        if after_stop == Once::Yes && self.reading == Reading::Ahead {
            return expected("`STOPRE` before an output");
        }
        let cell = self.context.cell;
        let command = match act {
            Act::Switch(output, state) => Command::Switch { output, state },
            Act::Generator(state) => match cell.ultrasonic {
                Some(output) => Command::Switch { output, state },
                None => return Err(ReadError::Unknown),
            },
            Act::Await(input) => Command::AwaitInput(input),
            Act::AwaitReady => match cell.ready {
                Ready::Input(input) => Command::AwaitInput(input),
                Ready::After(_) => return Err(ReadError::Unknown),
            },
            Act::Wait(time) => Command::Wait(time),
            Act::ChangeTool(place) => match (cell.changer(), place) {
                (Some(Changer::Program), Some(place)) => {
                    let tool = cell.tools.at_place(place);
                    let tool = tool.ok_or(ReadError::Unknown)?;
                    self.restart();
                    self.put_in(Some(tool));
                    Command::ChangeTool(Some(place))
                }
                (Some(Changer::Hand), None) => {
                    self.restart();
                    self.put_in(None);
                    Command::ChangeTool(None)
                }
                (_, _) => return Err(ReadError::Unknown),
            },
            Act::CallTool(number) => return self.call(number),
            Act::Spin(speed) => Command::Spin(speed.map(AngularSpeed::rev_per_min)),
            Act::CycleSpin => match cycle {
                Some(Cycle::Speed(speed)) => Command::Spin(Some(AngularSpeed::rev_per_min(f64::from(speed)))),
                Some(_) | None => return expected("`TOOL CALL S` with the speed before"),
            },
            Act::CycleWait(time) => match cycle {
                Some(Cycle::Dwell) => Command::Wait(time),
                Some(_) | None => return expected("`CYCL DEF 9.0 DWELL TIME` before"),
            },
            Act::CycleTolerance(within) => match cycle {
                Some(Cycle::Tolerance) => {
                    let end = within.map_or(End::Exact, |within| End::Through { within });
                    return self.modes(&[Mode::Stop(Some(end))]);
                }
                Some(_) | None => return expected("`CYCL DEF 32.0 TOLERANCE` before"),
            },
            Act::LoopWait(input) => match cycle {
                Some(Cycle::Loop(number)) => {
                    self.cycle = Some(Cycle::Waited(number, input));
                    return Ok(Effect::Setting);
                }
                Some(_) | None => {
                    return expected(
                        "`o<ready1> do` before it, because the program would go on after the time-out",
                    );
                }
            },
            Act::LoopEnds(number) => match cycle {
                Some(Cycle::Waited(begun, input)) if begun == number => Command::AwaitInput(input),
                Some(_) | None => return expected("the end of a loop that has begun"),
            },
            Act::CycleWork(number) => match cycle {
                Some(Cycle::WorkOffset) => return self.modes(&[Mode::Work(number)]),
                Some(_) | None => return expected("`CYCL DEF 247 DATUM SETTING ~` before"),
            },
            Act::StopReading => {
                self.reading = Reading::Stopped;
                return Ok(Effect::Setting);
            }
        };
        Ok(Effect::Command(command))
    }
}

/// What must follow the lines of a loop that waits, where it does not.
const fn missing(cycle: Option<Cycle>, act: Option<Act>) -> Option<&'static str> {
    match (cycle, act) {
        (Some(Cycle::Loop(_)), Some(Act::LoopWait(_)))
        | (Some(Cycle::Waited(..)), Some(Act::LoopEnds(_)))
        | (Some(Cycle::WorkOffset), Some(Act::CycleWork(_)))
        | (Some(Cycle::Tolerance), Some(Act::CycleTolerance(_)))
        | (Some(Cycle::Speed(_)), Some(Act::CycleSpin))
        | (Some(Cycle::Dwell) | None, _) => None,
        (Some(Cycle::WorkOffset), _) => Some("`Q339=` after `CYCL DEF 247 DATUM SETTING ~`"),
        (Some(Cycle::Speed(_)), _) => Some("`M3` after `TOOL CALL S`"),
        (Some(Cycle::Tolerance), _) => Some("`CYCL DEF 32.1` after `CYCL DEF 32.0 TOLERANCE`"),
        (Some(Cycle::Loop(_)), _) => Some("`M66` after the beginning of a loop"),
        (Some(Cycle::Waited(..)), _) => Some("the end of the loop, `o<ready1> while [#5399 LT 0]`"),
    }
}

/// Whether coordinates of the machine need a convention; the others are about the tip.
const fn is_of_axes(convention: Convention) -> bool {
    match convention {
        Convention::Absolute | Convention::Millimetres | Convention::AsWritten => true,
        Convention::ByAxes
        | Convention::MachineAngles
        | Convention::FeedOfTip
        | Convention::CentresFromStart => false,
    }
}

/// The place of a letter among the coordinates of the tip.
const fn tip_place(letter: u8) -> Option<usize> {
    match letter {
        b'X' => Some(0),
        b'Y' => Some(1),
        b'Z' => Some(2),
        _ => None,
    }
}

/// A number of a tool or work offset: that of the machine if it has one, or else the one that programs then have.
fn frame(role: FrameRole, is: u32, given: Option<u32>, otherwise: u32) -> Parsed<Effect> {
    match given {
        Some(_) => Ok(Effect::Frame(role, FrameSetting::Number(is))),
        None if is == otherwise => Ok(Effect::Setting),
        None => expected(match role {
            FrameRole::Tool => format!("tool {otherwise}"),
            FrameRole::Base => format!("work offset {otherwise}"),
        }),
    }
}

/// What a block that the job gives does.
pub(super) fn given(role: Role) -> Order<'static> {
    match role {
        Role::On => Order::act(Act::Generator(Switch::On)),
        Role::Off => Order::act(Act::Generator(Switch::Off)),
        Role::Ready => Order::act(Act::AwaitReady),
        Role::TcpOn => Order::modes(vec![Mode::Tcp(Some(Tcp::On))]),
        Role::TcpOff => Order::modes(vec![Mode::Tcp(Some(Tcp::Off))]),
    }
}
