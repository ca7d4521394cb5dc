//! The ops of a part as lines of KRL.

use crate::attitude::Attitudes;
use crate::configuration::Configuration;
use crate::keywords::HOME;
use crate::options::Settings;
use crate::turns::{Rates, Turns, rounded_down};
use core::num::NonZeroU32;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, Cell, FeedId, Op, OpId, OperationId, OrientationId, Program, Ready, Switch,
};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::{
    Generator, Layer, Lead, Modal, Part, Place, State, Text, Written, feed, may_round, operation_heading,
    rate as rate_of,
};
use vcutc_backend_api::units::Duration;

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
    /// Its orientations as text.
    pub(crate) attitudes: &'a Attitudes,
    /// How fast its turns are.
    pub(crate) turns: &'a Turns,
}

/// Writes the ops of a part.
pub(crate) fn write(source: Source<'_>, part: &Part, text: &mut Text<'_>) -> Written {
    let ops = source.program.ops.get(part.ops.clone()).unwrap_or_default();
    let mut body = Body {
        source,
        text,
        modal: Modal::default(),
        state: part.start,
        rates: None,
    };
    body.first_speeds(part, ops)?;
    body.restate(part.ops.start)?;
    let mut rest = ops;
    let mut index = part.ops.start;
    while let [op, after @ ..] = rest {
        body.lead(op)?;
        body.turn_rates(source.turns.at(index))?;
        body.op(index, op, after.first())?;
        rest = after;
        index += 1;
    }
    body.finish()
}

struct Body<'a, 's, 't> {
    source: Source<'a>,
    text: &'t mut Text<'s>,
    modal: Modal,
    state: State,
    /// The rates of swivel and twist as last said.
    rates: Option<Rates>,
}

impl Body<'_, '_, '_> {
    /// What comes before an op: headings and speeds.
    fn lead(&mut self, op: &Op) -> Written {
        let Lead {
            close,
            operation,
            open,
            cut,
            feed,
            rate: _,
        } = self.modal.lead(op);
        if let Some(layer) = close {
            self.close(layer)?;
        }
        if let Some(operation) = operation {
            self.operation(operation)?;
        }
        if let Some(layer) = open {
            self.text.put(b";FOLD layer ");
            self.text.whole(layer.number.get());
            self.text.end_line()?;
        }
        if let Some((layer, cut)) = cut {
            self.cut(layer, cut)?;
        }
        if let Some(feed) = feed {
            self.feed(feed)?;
        }
        Ok(())
    }

    fn close(&mut self, layer: Layer) -> Written {
        self.text.put(b";ENDFOLD (layer ");
        self.text.whole(layer.number.get());
        self.text.put(b")");
        Ok(self.text.end_line()?)
    }

    fn operation(&mut self, id: OperationId) -> Written {
        let (ours, blade) = operation_heading(self.source.program, id)?;
        self.text.put(b"; ");
        Ok(self.text.comment(&ours, blade)?)
    }

    fn cut(&mut self, layer: Layer, cut: NonZeroU32) -> Written {
        self.text.put(b"; layer ");
        self.text.whole(layer.number.get());
        self.text.put(b" cut ");
        self.text.whole(cut.get());
        Ok(self.text.end_line()?)
    }

    fn feed(&mut self, id: FeedId) -> Written {
        let feed = feed(self.source.program, id)?;
        self.assign(b"$VEL.CP=", feed.to_m_per_s())
    }

    /// The rates of a turn, where they are others than before. The controller limits the swivel of the tool's direction
    /// (ORI1) and the twist about it (ORI2) apart [K-SI].
    fn turn_rates(&mut self, rates: Option<Rates>) -> Written {
        match rates {
            Some(now) if self.rates != rates => {
                self.rates = rates;
                self.assign(b"$VEL.ORI1=", now.swivel)?;
                self.assign(b"$VEL.ORI2=", now.twist)
            }
            Some(_) | None => Ok(()),
        }
    }

    fn assign(&mut self, target: &[u8], value: f64) -> Written {
        self.text.put(target);
        self.text.trimmed(value)?;
        Ok(self.text.end_line()?)
    }

    /// The speeds that the straight moves of the part run at first. Both stand at its head, because the first move may set
    /// only one of them, and what `BAS (#INITMOV,0 )` leaves in the other is the fastest there is.
    fn first_speeds(&mut self, part: &Part, ops: &[Op]) -> Written {
        let (feed, rate) = self.modal.first_speeds(ops);
        if let Some(feed) = feed {
            self.feed(feed)?;
        }
        let first = part.ops.clone().find_map(|index| self.source.turns.at(index));
        match (first, rate) {
            (Some(_), _) => self.turn_rates(first),
            (None, Some(id)) => {
                // The part turns nothing, and does not leave the rates open all the same.
                let swivel = rounded_down(rate_of(self.source.program, id)?);
                let twist = swivel;
                self.turn_rates(Some(Rates { swivel, twist }))
            }
            (None, None) => Ok(()),
        }
    }

    /// Repeats the state in which the part begins, whose first op has this index. Called from the main program this changes
    /// nothing; a part started alone is brought to the pose, on the branch and with the blade vibrating, that its first move
    /// was checked from.
    fn restate(&mut self, first: usize) -> Written {
        match (self.state.place, first.checked_sub(1)) {
            (Place::Tip(tip, held), Some(before)) => self.axis_travel(before, tip, held)?,
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

    fn op(&mut self, index: usize, op: &Op, next: Option<&Op>) -> Written {
        let before = self.state;
        self.state = before.after(&op.action);
        match op.action {
            Action::Home => self.home(),
            Action::AxisTravel { to, orientation } => self.axis_travel(index, to, orientation),
            Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } | Action::Cut { .. } => {
                let end = self.end(before.place, &op.action, next.map(|next| &next.action));
                self.go(end)
            }
            Action::Turn { .. } => self.go(End::Exact),
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

    /// Moves to where the state says the op at hand ends.
    fn go(&mut self, end: End) -> Written {
        match self.state.place {
            Place::Tip(tip, held) => self.straight(tip, held, end),
            Place::Unknown | Place::Home => Err(EmitError::Internal("a move starts from an unknown pose")),
        }
    }

    fn straight(&mut self, to: Point3, held: OrientationId, end: End) -> Written {
        let planner = self.source.settings.planner;
        self.text.put(planner.straight());
        self.pose(to, held)?;
        self.text.put(b"}");
        match end {
            End::Exact => {}
            End::Rounded => self.text.put(planner.approximate()),
        }
        Ok(self.text.end_line()?)
    }

    /// A target from the value of X on, without its closing bracket.
    #[inline]
    fn pose(&mut self, tip: Point3, held: OrientationId) -> Written {
        let Source {
            settings, attitudes, ..
        } = self.source;
        let text = &mut *self.text;
        text.fixed(settings.common.lengths, tip.x)?;
        text.put(b",Y ");
        text.fixed(settings.common.lengths, tip.y)?;
        text.put(b",Z ");
        text.fixed(settings.common.lengths, tip.z)?;
        text.put(attitudes.text(held)?);
        Ok(())
    }

    fn home(&mut self) -> Written {
        self.text.put(self.source.settings.planner.axes());
        self.text.put(b" ");
        Ok(self.text.line(HOME)?)
    }

    /// A move of all axes to the pose in which the op of that index ends, with the status and turn that the arm has there.
    fn axis_travel(&mut self, index: usize, to: Point3, held: OrientationId) -> Written {
        let Configuration { status, turn } =
            configuration(self.source.reachable, index).ok_or(EmitError::Internal("a pose has no status"))?;
        self.text.put(self.source.settings.planner.axes());
        self.text.put(b" {X ");
        self.pose(to, held)?;
        self.text.put(b",S ");
        self.text.whole(status);
        self.text.put(b",T ");
        self.text.whole(turn);
        Ok(self.text.line("}")?)
    }

    /// Without `CONTINUE`: the output waits for the robot to arrive (advance run stop) [K-SI].
    fn ultrasonic(&mut self, state: Switch) -> Written {
        let output = self
            .source
            .cell
            .ultrasonic
            .ok_or(EmitError::Internal("no ultrasonic output"))?;
        self.text.put(b"$OUT[");
        self.text.whole(output);
        Ok(self.text.line(match state {
            Switch::On => "]=TRUE",
            Switch::Off => "]=FALSE",
        })?)
    }

    fn await_ready(&mut self) -> Written {
        match self.source.cell.ready {
            Ready::Input(input) => {
                self.text.put(b"WAIT FOR $IN[");
                self.text.whole(input);
                Ok(self.text.line("]")?)
            }
            Ready::After(time) => self.wait(time),
        }
    }

    fn wait(&mut self, time: Duration) -> Written {
        self.assign(b"WAIT SEC ", time.to_s())
    }

    fn finish(&mut self) -> Written {
        match self.modal.open_layer() {
            Some(layer) => self.close(layer),
            None => Ok(()),
        }
    }
}

/// Status and turn at the end of the op of that index.
fn configuration(reachable: &ReachableProgram, index: usize) -> Option<Configuration> {
    let op = OpId(u32::try_from(index).ok()?);
    Configuration::of(reachable.branch_after(op)?, reachable.axes_after(op)?)
}
