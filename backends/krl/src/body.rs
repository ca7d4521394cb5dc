//! The ops of a part as lines of KRL.

use crate::attitude::Attitudes;
use crate::keywords::HOME;
use crate::listing::{Layer, Lead, Modal};
use crate::options::Settings;
use crate::split::Part;
use crate::state::{Generator, Place, State, may_round};
use crate::text::{Text, Written};
use core::num::NonZeroU32;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, Cell, FeedId, Op, OperationId, OperationKind, OrientationId, Program, RateId, Ready, Switch,
};
use vcutc_backend_api::units::Duration;

/// How a move ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// At a standstill on the point.
    Exact,
    /// Somewhere near it, on the way to the next.
    Rounded,
}

/// What the lines are made from.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The program.
    pub(crate) program: &'a Program,
    /// Its machine.
    pub(crate) cell: &'a Cell,
    /// The options.
    pub(crate) settings: &'a Settings<'a>,
    /// Its orientations as text.
    pub(crate) attitudes: &'a Attitudes,
}

/// Writes the ops of a part.
pub(crate) fn write(source: Source<'_>, part: &Part, text: &mut Text<'_>) -> Written {
    let ops = source.program.ops.get(part.ops.clone()).unwrap_or_default();
    let mut body = Body {
        source,
        text,
        modal: Modal::default(),
        state: part.start,
    };
    let mut rest = ops;
    if let [first, after @ ..] = rest {
        body.lead(first)?;
        body.first_speeds(ops)?;
        body.restate()?;
        body.op(first, after.first())?;
        rest = after;
    }
    while let [op, after @ ..] = rest {
        body.lead(op)?;
        body.op(op, after.first())?;
        rest = after;
    }
    body.finish()
}

struct Body<'a, 's, 't> {
    source: Source<'a>,
    text: &'t mut Text<'s>,
    modal: Modal,
    state: State,
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
            rate,
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
        if let Some(rate) = rate {
            self.rate(rate)?;
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
        let operation = self
            .source
            .program
            .operations
            .get(usize::from(id.0))
            .ok_or(EmitError::Internal("an operation is not in its table"))?;
        let what = match operation.kind {
            OperationKind::RoughVcut => "rough vcut",
        };
        self.text.put(b"; operation ");
        self.text.whole(u32::from(id.0) + 1);
        self.text.put(b": ");
        self.text.put(what.as_bytes());
        Ok(self.text.comment(" with blade ", &operation.blade.name)?)
    }

    fn cut(&mut self, layer: Layer, cut: NonZeroU32) -> Written {
        self.text.put(b"; layer ");
        self.text.whole(layer.number.get());
        self.text.put(b" cut ");
        self.text.whole(cut.get());
        Ok(self.text.end_line()?)
    }

    fn feed(&mut self, id: FeedId) -> Written {
        let feed = self
            .source
            .program
            .feeds
            .get(usize::from(id.0))
            .ok_or(EmitError::Internal("a feed is not in its table"))?;
        self.assign(b"$VEL.CP=", feed.to_m_per_s())
    }

    fn rate(&mut self, id: RateId) -> Written {
        let rate = self
            .source
            .program
            .rates
            .get(usize::from(id.0))
            .ok_or(EmitError::Internal("a rate is not in its table"))?
            .to_deg_per_s();
        // The controller limits the swivel of the tool axis (ORI1) and the turn about it (ORI2) apart [K-SI].
        self.assign(b"$VEL.ORI1=", rate)?;
        self.assign(b"$VEL.ORI2=", rate)
    }

    fn assign(&mut self, target: &[u8], value: f64) -> Written {
        self.text.put(target);
        self.text.trimmed(value)?;
        Ok(self.text.end_line()?)
    }

    /// The speeds of the move that repeats the pose in which the part begins.
    fn first_speeds(&mut self, ops: &[Op]) -> Written {
        if self.state.place.tip().is_none() {
            return Ok(());
        }
        let (feed, rate) = self.modal.first_speeds(ops);
        if let Some(feed) = feed {
            self.feed(feed)?;
        }
        if let Some(rate) = rate {
            self.rate(rate)?;
        }
        Ok(())
    }

    /// Repeats the state in which the part begins. Called from the main program this changes nothing; a part started
    /// alone is brought to the pose, and with the blade vibrating, that its first move was checked from.
    fn restate(&mut self) -> Written {
        match self.state.place {
            Place::Unknown => {}
            Place::Home => self.home()?,
            Place::Tip(tip, held) => {
                self.stay()?;
                self.straight(tip, held, End::Exact)?;
            }
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

    fn op(&mut self, op: &Op, next: Option<&Op>) -> Written {
        let before = self.state;
        self.state = before.after(&op.action);
        match op.action {
            Action::Home => self.home(),
            Action::AxisTravel { .. } => Err(EmitError::Internal("a move of all axes was not refused")),
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
        if self.source.settings.approximation.is_some() && may_round(stock, before, action, next) {
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
        let Source {
            settings, attitudes, ..
        } = self.source;
        let text = &mut *self.text;
        text.put(settings.planner.straight());
        text.fixed(settings.lengths, to.x)?;
        text.put(b",Y ");
        text.fixed(settings.lengths, to.y)?;
        text.put(b",Z ");
        text.fixed(settings.lengths, to.z)?;
        text.put(attitudes.text(held)?);
        text.put(b"}");
        match end {
            End::Exact => {}
            End::Rounded => text.put(settings.planner.approximate()),
        }
        Ok(text.end_line()?)
    }

    fn home(&mut self) -> Written {
        self.axes(HOME)
    }

    /// A move of all axes.
    fn axes(&mut self, target: &str) -> Written {
        self.text.put(self.source.settings.planner.axes().as_bytes());
        self.text.put(b" ");
        Ok(self.text.line(target)?)
    }

    /// A move of all axes to where they are. A straight move must not be the first motion of a module (K-SI: the controller
    /// first brings the robot onto the path of the program, which takes a complete point); this one goes nowhere, and is the
    /// usual way to have one.
    fn stay(&mut self) -> Written {
        self.axes("$AXIS_ACT")
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
