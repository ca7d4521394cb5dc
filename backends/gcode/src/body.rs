//! The ops of a part as blocks.

use crate::axes::{Word, WorkInOffset, printed};
use crate::blocks::{Blocks, fine, push_word};
use crate::dialect::FeedMode;
use crate::options::Settings;
use crate::pace::{self, Pace};
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, AxisKind, AxisValues, Cell, Op, OpId, Program, Ready, Switch};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::{
    Generator, Modal, Part, Place, State, Written, may_round, operation_heading,
};
use vcutc_backend_api::stroke::Stroke;
use vcutc_backend_api::units::{Duration, Length};

/// What the blocks are made from.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The program with its motion.
    pub(crate) reachable: &'a ReachableProgram,
    /// Its machine.
    pub(crate) cell: &'a Cell,
    /// The options.
    pub(crate) settings: &'a Settings<'a>,
    /// The machine's axes as words.
    pub(crate) words: &'a [Word],
    /// The way into the frame of the work offset.
    pub(crate) work_in_offset: WorkInOffset,
}

impl<'a> Source<'a> {
    /// The program.
    pub(crate) fn program(&self) -> &'a Program {
        self.reachable.program()
    }

    /// The number of the tool in the controller's table.
    pub(crate) fn tool(&self) -> u32 {
        self.cell.tool.number.unwrap_or(self.settings.tool_number)
    }
}

/// Whether tool-centre-point control is on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tcp {
    On,
    Off,
}

/// Writes the ops of a part, behind a setup that has left everything as the dialect's `setup` says.
pub(crate) fn write(source: Source<'_>, part: &Part, blocks: &mut Blocks<'_, '_>) -> Written {
    let ops = source.program().ops.get(part.ops.clone()).unwrap_or_default();
    let mut body = Body {
        source,
        blocks,
        modal: Modal::default(),
        state: part.start,
        tcp: Tcp::Off,
        mode: FeedMode::Tip,
        end: End::Exact,
        tip: Vec::new(),
        rotary: Vec::new(),
        last_tip: Vec::new(),
        labels: 0,
    };
    body.restate(part.ops.start)?;
    let mut rest = ops;
    let mut index = part.ops.start;
    while let [op, after @ ..] = rest {
        body.lead(op)?;
        body.op(index, op, after.first())?;
        rest = after;
        index += 1;
    }
    body.tcp_off()
}

struct Body<'a, 'b, 't, 's> {
    source: Source<'a>,
    blocks: &'b mut Blocks<'t, 's>,
    modal: Modal,
    state: State,
    tcp: Tcp,
    mode: FeedMode,
    end: End,
    /// Words of the tip and of the rotary axes of the block at hand.
    tip: Vec<u8>,
    rotary: Vec<u8>,
    /// Words of the tip of the block before, where that is known.
    last_tip: Vec<u8>,
    /// How many labels the file has.
    labels: u32,
}

impl Body<'_, '_, '_, '_> {
    /// The comments before an op.
    fn lead(&mut self, op: &Op) -> Written {
        let lead = self.modal.lead(op);
        if let Some(id) = lead.operation {
            let (ours, blade) = operation_heading(self.source.program(), id)?;
            self.blocks.comment(&ours, blade)?;
        }
        if let Some((layer, cut)) = lead.cut {
            let ours = format!("layer {} cut {cut}", layer.number);
            self.blocks.comment(&ours, "")?;
        }
        Ok(())
    }

    /// Repeats the state in which the part begins, whose first op has this index. Called from the main program this moves
    /// nothing; a part that is started alone is brought to where its first move was checked from, with the blade vibrating.
    fn restate(&mut self, first: usize) -> Written {
        match (self.state.place, first.checked_sub(1)) {
            (Place::Home | Place::Tip(..), Some(before)) => {
                let to = self.axes_after(before)?;
                self.axes(None, &to)?;
            }
            (Place::Unknown | Place::Home | Place::Tip(..), _) => {}
        }
        match self.state.generator {
            Generator::Off => Ok(()),
            Generator::Starting => self.switch(Switch::On),
            Generator::Running => {
                self.switch(Switch::On)?;
                self.await_ready()
            }
        }
    }

    fn op(&mut self, index: usize, op: &Op, next: Option<&Op>) -> Written {
        let before = self.state;
        self.state = before.after(&op.action);
        match op.action {
            Action::Home | Action::AxisTravel { .. } => {
                let from = match index.checked_sub(1) {
                    Some(last) if before.place != Place::Unknown => Some(self.axes_after(last)?),
                    Some(_) | None => None,
                };
                let to = self.axes_after(index)?;
                self.axes(from.as_ref(), &to)
            }
            Action::Travel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Cut { .. }
            | Action::Turn { .. } => {
                let stock = self.source.program().stock;
                let next = next.map(|next| &next.action);
                let end = match self.source.settings.common.approximation {
                    Some(_) if may_round(stock, before.place, &op.action, next) => End::Rounded,
                    Some(_) | None => End::Exact,
                };
                self.straight(index, &op.action, before.place, end)
            }
            Action::Ultrasonic { state } => self.switch(state),
            Action::AwaitReady => self.await_ready(),
            Action::Dwell { time } => self.wait(time),
            Action::ToolChange { .. } => Err(EmitError::Internal("a tool change was not refused")),
        }
    }

    /// A straight motion of the tip, or a turn about it. Every block is complete: it says where the tip and all rotary axes go
    /// and how fast, so that it means the same wherever a program is entered.
    fn straight(&mut self, index: usize, action: &Action, from: Place, end: End) -> Written {
        let Source {
            settings,
            words,
            reachable,
            ..
        } = self.source;
        let Place::Tip(tip, held) = from else {
            return Err(EmitError::Internal("a move starts from an unknown pose"));
        };
        let stroke = Stroke::of(reachable.program(), (tip, held), action)
            .ok_or(EmitError::Internal("a move is not in the program's tables"))?;
        let before = index
            .checked_sub(1)
            .ok_or(EmitError::Internal("the first op is not a move from a pose"))?;
        let (from, to) = (self.axes_after(before)?, self.axes_after(index)?);
        let pace = pace::of_stroke(settings, words, &stroke, &from, &to)
            .ok_or(EmitError::Internal("a motion has no speed"))?;
        self.tip_words(stroke.to.0)?;
        self.rotary_words(&to)?;
        self.tcp_on()?;
        self.ending(end)?;
        self.feed_mode(pace.mode)?;
        self.blocks.begin();
        self.blocks.put(settings.dialect.straight());
        // Under the rate of rotary axes a block names these alone, for F is that of the axes which it names.
        if pace.mode != FeedMode::Rotary || self.tip != self.last_tip {
            self.blocks.put_bytes(&self.tip);
        }
        self.blocks.put_bytes(&self.rotary);
        self.blocks.put(settings.dialect.before_feed());
        self.feed(pace)?;
        core::mem::swap(&mut self.tip, &mut self.last_tip);
        self.blocks.end()
    }

    /// A move of all axes to their values, tool-centre-point control being off.
    fn axes(&mut self, from: Option<&AxisValues>, to: &AxisValues) -> Written {
        let Source {
            settings,
            words,
            cell,
            ..
        } = self.source;
        let pace = pace::of_axes(settings, cell, words, from, to);
        let [start, end] = settings.dialect.axis_move();
        self.tcp_off()?;
        self.ending(End::Exact)?;
        if let Some(pace) = pace {
            self.feed_mode_without_tcp(pace.mode)?;
        }
        self.linear_words(to)?;
        self.rotary_words(to)?;
        self.blocks.begin();
        self.blocks.put(start);
        self.blocks.put_bytes(&self.tip);
        self.blocks.put_bytes(&self.rotary);
        self.blocks.put(settings.dialect.before_feed());
        if let Some(pace) = pace {
            self.feed(pace)?;
        }
        self.blocks.put(end);
        // Coordinates of the tip mean something else from here on, so the next block says all of them.
        self.last_tip.clear();
        self.blocks.end()
    }

    fn feed(&mut self, pace: Pace) -> Written {
        self.blocks.put(" F");
        // Never faster than proven.
        let format = self.source.settings.fine();
        let feed = fine(format.floored(pace.feed), format)?;
        self.blocks.put_bytes(&feed);
        Ok(())
    }

    fn tip_words(&mut self, tip: Point3) -> Written {
        let Point3 { x, y, z } = self.source.work_in_offset.in_offset(tip);
        let settings = self.source.settings;
        self.tip.clear();
        for (letter, value) in [(b'X', x), (b'Y', y), (b'Z', z)] {
            push_word(
                &mut self.tip,
                letter,
                value,
                settings.common.lengths,
                settings.dialect.signs(),
            )?;
        }
        Ok(())
    }

    fn linear_words(&mut self, axes: &AxisValues) -> Written {
        self.tip.clear();
        axis_words(&mut self.tip, self.source, AxisKind::Linear, axes)
    }

    fn rotary_words(&mut self, axes: &AxisValues) -> Written {
        self.rotary.clear();
        axis_words(&mut self.rotary, self.source, AxisKind::Rotary, axes)
    }

    fn tcp_on(&mut self) -> Written {
        if self.tcp == Tcp::On {
            return Ok(());
        }
        let (dialect, settings) = (self.source.settings.dialect, self.source.settings);
        for block in dialect.tcp_on(settings, self.source.tool()) {
            self.blocks.block(&block)?;
        }
        if let Some(mode) = dialect.feed_mode_of_tcp() {
            self.mode = mode;
        }
        self.tcp = Tcp::On;
        Ok(())
    }

    fn tcp_off(&mut self) -> Written {
        if self.tcp == Tcp::Off {
            return Ok(());
        }
        for block in self.source.settings.dialect.tcp_off(self.source.settings) {
            self.blocks.block(&block)?;
        }
        self.tcp = Tcp::Off;
        Ok(())
    }

    fn feed_mode(&mut self, mode: FeedMode) -> Written {
        if self.mode != mode {
            self.blocks.block(self.source.settings.dialect.feed_mode(mode))?;
            self.mode = mode;
        }
        Ok(())
    }

    /// Where the meaning of F is a matter of tool-centre-point control, it has only one without.
    fn feed_mode_without_tcp(&mut self, mode: FeedMode) -> Written {
        match self.source.settings.dialect.feed_mode_of_tcp() {
            Some(_) => Ok(()),
            None => self.feed_mode(mode),
        }
    }

    /// How the next moves end.
    fn ending(&mut self, end: End) -> Written {
        if self.end == end {
            return Ok(());
        }
        let dialect = self.source.settings.dialect;
        let approximation = self.source.settings.common.approximation.unwrap_or(Length::ZERO);
        match end {
            End::Exact => {
                if let Some(block) = dialect.exact() {
                    self.blocks.block(block)?;
                }
            }
            End::Rounded => {
                if let Some(block) = dialect.rounded(approximation) {
                    self.blocks.block(&block)?;
                }
            }
        }
        self.end = end;
        Ok(())
    }

    fn switch(&mut self, state: Switch) -> Written {
        let Source { settings, cell, .. } = self.source;
        let given = match state {
            Switch::On => settings.codes.on,
            Switch::Off => settings.codes.off,
        };
        let output = cell
            .ultrasonic
            .ok_or(EmitError::Internal("no ultrasonic output"))?;
        self.given_or(given, settings.dialect.switch(output, state))
    }

    fn await_ready(&mut self) -> Written {
        let Source { settings, cell, .. } = self.source;
        match cell.ready {
            Ready::Input(input) => {
                self.labels = self.labels.saturating_add(1);
                let own = settings.dialect.await_input(input, self.labels);
                self.given_or(settings.codes.ready, own)
            }
            Ready::After(time) => self.wait(time),
        }
    }

    /// Blocks that the job gives, or else those of the dialect.
    fn given_or(&mut self, given: &[String], own: Option<Vec<String>>) -> Written {
        let own = own.unwrap_or_default();
        let blocks = if given.is_empty() { &own } else { given };
        if blocks.is_empty() {
            return Err(EmitError::Internal(
                "a signal that cannot be said was not refused",
            ));
        }
        for block in blocks {
            self.blocks.block(block)?;
        }
        Ok(())
    }

    fn wait(&mut self, time: Duration) -> Written {
        let seconds = fine(time.to_s(), self.source.settings.fine())?;
        for block in self
            .source
            .settings
            .dialect
            .dwell(&String::from_utf8_lossy(&seconds))
        {
            self.blocks.block(&block)?;
        }
        Ok(())
    }

    fn axes_after(&self, index: usize) -> Result<AxisValues, EmitError> {
        let op = u32::try_from(index).ok().map(OpId);
        op.and_then(|op| self.source.reachable.axes_after(op))
            .ok_or(EmitError::Internal("an op has no axis values"))
    }
}

/// Words of the axes of a kind.
fn axis_words(out: &mut Vec<u8>, source: Source<'_>, kind: AxisKind, axes: &AxisValues) -> Written {
    let settings = source.settings;
    let format = match kind {
        AxisKind::Linear => settings.common.lengths,
        AxisKind::Rotary => settings.angles,
    };
    for &word in source.words.iter().filter(|word| word.kind == kind) {
        let value = printed(word, axes).ok_or(EmitError::Internal("an axis has no value"))?;
        push_word(out, word.letter, value, format, settings.dialect.signs())?;
    }
    Ok(())
}
