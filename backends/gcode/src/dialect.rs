//! How a program is put in blocks.

mod rounds;

use self::rounds::Tip;
use crate::arcs;
use crate::axes::printed;
use crate::blocks::{Blocks, fine, push_word};
use crate::chains::printed_blend;
use crate::controller::Changes;
use crate::job::Job;
use crate::pace::{self, Pace};
use crate::statement::{FeedMode, Once, Plane, Tcp};
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{AxisKind, AxisValues, OpId, RateId, Switch, ToolId};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::{Dialect, JointMove, LinearMove, Part, ToolChange, Written};
use vcutc_backend_api::units::{AngularSpeed, Duration, Length};

/// G-code, as far as a program is written.
pub(crate) struct GcodeDialect<'a, 't, 's> {
    /// What it is written from.
    pub(crate) job: Job<'a>,
    /// Where blocks go.
    pub(crate) blocks: Blocks<'t, 's>,
    /// What holds in the part at hand.
    modes: Modes,
    /// Words of the tip and of the rotary axes of the block at hand.
    tip: Vec<u8>,
    rotary: Vec<u8>,
}

/// What holds in a part.
struct Modes {
    tcp: Tcp,
    feed: FeedMode,
    end: End,
    plane: Plane,
    /// Whether I, J and K have been said to count from the start of an arc.
    centres_from_start: Once,
    /// Words of the tip of the block before, where that is known.
    last_tip: Vec<u8>,
    /// How many labels the file has.
    labels: u32,
    tool: ToolId,
    start: Start,
}

/// Where a motion of all axes begins.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Start {
    /// Where the one before it ended.
    AsProven,
    /// Where the machine was left by what changes its blade: that may move axes, and no two machines do it alike.
    Anywhere,
}

impl Modes {
    /// As the controller's `setup` leaves them.
    const SET_UP: Self = Self {
        tcp: Tcp::Off,
        feed: FeedMode::Tip,
        end: End::Exact,
        plane: Plane::Xy,
        centres_from_start: Once::No,
        last_tip: Vec::new(),
        labels: 0,
        tool: ToolId::FIRST,
        start: Start::AsProven,
    };
}

impl<'a, 't, 's> GcodeDialect<'a, 't, 's> {
    /// Nothing written yet.
    pub(crate) const fn new(job: Job<'a>, blocks: Blocks<'t, 's>) -> Self {
        Self {
            job,
            blocks,
            modes: Modes::SET_UP,
            tip: Vec::new(),
            rotary: Vec::new(),
        }
    }
}

impl Dialect for GcodeDialect<'_, '_, '_> {
    fn comment(&mut self, ours: &str, theirs: &str) -> Written {
        self.blocks.comment(ours, theirs)
    }

    /// LinuxCNC carries out comments that begin with words such as MSG or LOGOPEN [L-OV].
    fn note(&mut self, line: &str) -> Written {
        self.comment("note: ", line)
    }

    fn verbatim(&mut self, line: &str) -> Written {
        self.blocks.block(line)
    }

    fn part_begins(&mut self, part: &Part, _: Option<RateId>) -> Written {
        self.modes = Modes {
            tool: part.start.tool,
            ..Modes::SET_UP
        };
        Ok(())
    }

    fn part_ends(&mut self) -> Written {
        self.tcp_off()
    }

    /// To the values of all axes, tool-centre-point control being off.
    fn joint_move(&mut self, motion: &JointMove) -> Written {
        let Job { settings, .. } = self.job;
        let from = motion.from.filter(|_| self.modes.start == Start::AsProven);
        let pace = pace::of_axes(&self.job, from.as_ref(), &motion.axes);
        self.modes.start = Start::AsProven;
        let [start, end] = settings.facts().axis_move;
        self.tcp_off()?;
        let stop = self.ending(End::Exact)?;
        if let Some(pace) = pace {
            self.feed_mode_without_tcp(pace.mode)?;
        }
        self.tip.clear();
        axis_words(&mut self.tip, &self.job, AxisKind::Linear, &motion.axes)?;
        self.rotary_words(&motion.axes)?;
        self.blocks.begin();
        self.blocks.put(stop);
        self.blocks.put(start);
        self.blocks.put_bytes(&self.tip);
        self.blocks.put_bytes(&self.rotary);
        self.blocks.put(settings.facts().before_feed);
        if let Some(pace) = pace {
            self.feed_word(pace)?;
        }
        self.blocks.put(end);
        // Coordinates of the tip mean something else from here on, so the next block says all of them.
        self.modes.last_tip.clear();
        self.blocks.end()
    }

    /// Every block is complete: it says where the tip and all rotary axes go and how fast, so that it means the same wherever
    /// a program is entered.
    fn linear_move(&mut self, motion: &LinearMove<'_>) -> Written {
        let Job { source, settings, .. } = self.job;
        let before = motion
            .op
            .0
            .checked_sub(1)
            .ok_or(EmitError::Internal("the first op is not a move from a pose"))?;
        let (from, to) = (source.axes_after(OpId(before))?, source.axes_after(motion.op)?);
        let pace = pace::of_line(&self.job, motion.line, &from, &to)
            .ok_or(EmitError::Internal("a motion has no speed"))?;
        let arc = arcs::written(&self.job, motion.line)
            .map_err(|_| EmitError::Internal("an arc was not refused"))?;
        self.tip_words(motion.line.to.tip)?;
        self.rotary_words(&to)?;
        self.tcp_on()?;
        let stop = self.ending(motion.end)?;
        self.feed_mode(pace.mode)?;
        // Under the rate of rotary axes a block names these alone, for F is that of the axes which it names.
        let tip = match pace.mode {
            FeedMode::Rotary if self.tip == self.modes.last_tip => Tip::LeftOut,
            FeedMode::Tip | FeedMode::InverseTime | FeedMode::Rotary => Tip::Named,
        };
        match arc {
            Some(arc) => self.round(stop, arc)?,
            None => self.straight(stop, tip),
        }
        self.blocks.put(settings.facts().before_feed);
        self.feed_word(pace)?;
        core::mem::swap(&mut self.tip, &mut self.modes.last_tip);
        self.blocks.end()
    }

    fn change_tool(&mut self, change: &ToolChange<'_>) -> Written {
        let asks = match change.place {
            Some(_) => "change to blade ",
            None => "put in blade ",
        };
        self.comment(asks, change.blade)?;
        let controller = self.job.settings.controller;
        self.blocks.block(&controller.change(self.job.tool(change.id)))?;
        self.modes.tool = change.id;
        self.modes.start = Start::Anywhere;
        match controller.facts().changes {
            Changes::ByTheControl => Ok(()),
            Changes::ByOthers => {
                self.modes = Modes {
                    tool: change.id,
                    start: Start::Anywhere,
                    labels: self.modes.labels,
                    ..Modes::SET_UP
                };
                self.motion_setup(change.id)
            }
        }
    }

    fn spin(&mut self, speed: Option<AngularSpeed>) -> Written {
        let controller = self.job.settings.controller;
        let whole = speed.map(|speed| speed.to_rev_per_min().round() as u32);
        self.blocks.all(&controller.spin(whole))
    }

    fn switch(&mut self, output: u32, state: Switch) -> Written {
        let settings = self.job.settings;
        let is_generator = self.job.source.cell.ultrasonic == Some(output);
        let given = match state {
            Switch::On if is_generator => settings.codes.on,
            Switch::Off if is_generator => settings.codes.off,
            Switch::On | Switch::Off => &[],
        };
        self.given_or(given, settings.controller.switch(output, state))
    }

    fn await_input(&mut self, input: u32) -> Written {
        let settings = self.job.settings;
        self.modes.labels = self.modes.labels.saturating_add(1);
        let own = settings.controller.await_input(input, self.modes.labels);
        self.given_or(settings.codes.ready, own)
    }

    fn wait(&mut self, time: Duration) -> Written {
        let settings = self.job.settings;
        let seconds = fine(time.to_s(), settings.fine())?;
        self.blocks
            .all(&settings.controller.dwell(&String::from_utf8_lossy(&seconds)))
    }
}

impl GcodeDialect<'_, '_, '_> {
    fn feed_word(&mut self, pace: Pace) -> Written {
        self.blocks.put(" F");
        // Never faster than proven.
        let format = self.job.settings.fine();
        let feed = fine(format.floored(pace.feed), format)?;
        self.blocks.put_bytes(&feed);
        Ok(())
    }

    fn tip_words(&mut self, tip: Point3) -> Written {
        let Point3 { x, y, z } = self.job.work_in_offset.in_offset(tip);
        let settings = self.job.settings;
        let (lengths, signs) = (settings.common.lengths, settings.facts().signs);
        self.tip.clear();
        for (letter, value) in [(b'X', x), (b'Y', y), (b'Z', z)] {
            push_word(&mut self.tip, letter, value, lengths, signs)?;
        }
        Ok(())
    }

    fn rotary_words(&mut self, axes: &AxisValues) -> Written {
        self.rotary.clear();
        axis_words(&mut self.rotary, &self.job, AxisKind::Rotary, axes)
    }

    fn tcp_on(&mut self) -> Written {
        if self.modes.tcp == Tcp::On {
            return Ok(());
        }
        let settings = self.job.settings;
        self.blocks.all(
            &settings
                .controller
                .tcp_on(settings.codes, self.job.tool(self.modes.tool).number),
        )?;
        if let Some(mode) = settings.facts().feed_mode_of_tcp {
            self.modes.feed = mode;
        }
        self.modes.tcp = Tcp::On;
        Ok(())
    }

    fn tcp_off(&mut self) -> Written {
        if self.modes.tcp == Tcp::Off {
            return Ok(());
        }
        let settings = self.job.settings;
        self.blocks.all(&settings.controller.tcp_off(settings.codes))?;
        self.modes.tcp = Tcp::Off;
        Ok(())
    }

    fn feed_mode(&mut self, mode: FeedMode) -> Written {
        if self.modes.feed != mode {
            self.blocks.block(self.job.settings.controller.feed_mode(mode))?;
            self.modes.feed = mode;
        }
        Ok(())
    }

    /// Where the meaning of F depends on tool-centre-point control, it has only one without.
    fn feed_mode_without_tcp(&mut self, mode: FeedMode) -> Written {
        match self.job.settings.facts().feed_mode_of_tcp {
            Some(_) => Ok(()),
            None => self.feed_mode(mode),
        }
    }

    /// How the next moves end. At the end of a chain that is a word of the block itself, with the blank after it, where the
    /// control would stop at a block of that word alone.
    fn ending(&mut self, end: End) -> Result<&'static str, EmitError> {
        let before = core::mem::replace(&mut self.modes.end, end);
        if before == end {
            return Ok("");
        }
        let settings = self.job.settings;
        let approximation = settings.common.approximation.unwrap_or(Length::ZERO);
        let blocks = match (before, end) {
            (End::Through { .. }, End::Exact) => match settings.facts().exact_in_block {
                Some(word) => return Ok(word),
                None => settings.controller.through_ends(),
            },
            (_, End::Exact) => settings.facts().exact.map(str::to_owned).into_iter().collect(),
            (_, End::Rounded) => settings.controller.rounded(approximation).into_iter().collect(),
            (_, End::Through { within }) => {
                let lines = settings.controller.through(printed_blend(within, settings));
                lines.ok_or(EmitError::Internal("a chain was not refused"))?
            }
        };
        self.blocks.all(&blocks)?;
        Ok("")
    }

    /// Blocks that the job gives, or else those of the controller.
    fn given_or(&mut self, given: &[String], own: Option<Vec<String>>) -> Written {
        let own = own.unwrap_or_default();
        match if given.is_empty() { own.as_slice() } else { given } {
            [] => Err(EmitError::Internal(
                "a signal that cannot be said was not refused",
            )),
            blocks => self.blocks.all(blocks),
        }
    }
}

/// Words of the axes of a kind.
fn axis_words(out: &mut Vec<u8>, job: &Job<'_>, kind: AxisKind, axes: &AxisValues) -> Written {
    let settings = job.settings;
    let format = match kind {
        AxisKind::Linear => settings.common.lengths,
        AxisKind::Rotary => settings.angles,
    };
    for &word in job.words.iter().filter(|word| word.kind == kind) {
        let value = printed(word, axes).ok_or(EmitError::Internal("an axis has no value"))?;
        push_word(out, word.letter, value, format, settings.facts().signs)?;
    }
    Ok(())
}
