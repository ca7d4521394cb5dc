//! What the writer asks a dialect: how a program of the trade is put in the words of one controller.
//!
//! [`write`](super::write) walks the program, once for all dialects, and decides what is written and in which order. A dialect
//! answers how. It keeps no account of the program, only of what its own words make last: a speed, a sign, a mode.

use super::listing::Layer;
use super::split::Part;
use super::text::Written;
use crate::backend::EmitError;
use crate::ir::{Action, AxisValues, Cell, FeedId, Op, OpId, Program, RateId, Switch, Tool, ToolId};
use crate::motion::ReachableProgram;
use crate::readback::End;
use crate::segments::LinearSegment;
use crate::state::TipPose;
use crate::units::{AngularSpeed, Duration};
use core::num::NonZeroU32;

/// What a program is written from.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The program with its motion.
    pub reachable: &'a ReachableProgram,
    /// Its machine.
    pub cell: &'a Cell,
}

impl<'a> Source<'a> {
    /// The program.
    #[must_use]
    pub const fn program(&self) -> &'a Program {
        self.reachable.program()
    }

    /// The ops of a part.
    #[must_use]
    pub fn ops(&self, part: &Part) -> &'a [Op] {
        self.program().ops.get(part.ops.clone()).unwrap_or_default()
    }

    /// The axes at the end of an op.
    ///
    /// # Errors
    /// That the motion ends before this op.
    pub fn axes_after(&self, op: OpId) -> Result<AxisValues, EmitError> {
        let known = self.reachable.axes_after(op);
        known.ok_or(EmitError::Internal("an op has no axis values"))
    }
}

/// A file of a program.
#[derive(Clone, Copy, Debug)]
pub struct File<'a> {
    /// Its name without extension.
    pub name: &'a str,
    /// Its place among the program's files: 0 for the main program, parts from 1.
    pub place: usize,
    /// The part whose ops it holds; none for a main program that calls its parts.
    pub part: Option<&'a Part>,
    /// The name of the main program.
    pub main: &'a str,
    /// How many parts the program has.
    pub parts: usize,
}

/// A motion of all axes together.
#[derive(Clone, Copy, Debug)]
pub struct JointMove {
    /// The op at whose end the machine is there.
    pub op: OpId,
    /// Where it leads.
    pub to: JointTarget,
    /// Where the axes come from, if that is known.
    pub from: Option<AxisValues>,
    /// Where they go.
    pub axes: AxisValues,
}

/// Where a motion of all axes leads.
#[derive(Clone, Copy, Debug)]
pub enum JointTarget {
    /// To the axis values of home.
    Home,
    /// To those at which blades are changed.
    Change,
    /// To a pose.
    Pose(TipPose),
}

/// A motion of the tip on a straight line, or a turn about the still tip.
#[derive(Clone, Copy, Debug)]
pub struct LinearMove<'a> {
    /// The op.
    pub op: OpId,
    /// What it does.
    pub action: &'a Action,
    /// Where it leads, and how fast.
    pub line: &'a LinearSegment,
    /// How it ends.
    pub end: End,
}

/// A blade that takes the place of another.
#[derive(Clone, Copy, Debug)]
pub struct ToolChange<'a> {
    /// The op.
    pub op: OpId,
    /// Its number.
    pub id: ToolId,
    /// How the machine holds it.
    pub tool: &'a Tool,
    /// What the job calls it.
    pub blade: &'a str,
    /// The place of the changer that it comes from; none where a person puts it in.
    pub place: Option<u32>,
}

/// How a program lies in files.
pub trait Files {
    /// The name of a part, counted from 1.
    fn part_name(&self, main: &str, part: usize) -> String;

    /// Begins a file, down to the comments at its head.
    ///
    /// # Errors
    /// Of this question and all that follow: what the sink reports, or a fault of the compiler.
    fn open(&mut self, file: File<'_>) -> Written;

    /// Everything that the ops or calls of a file depend on. In the main program the lines that the profile puts at its head
    /// are among it.
    fn setup(&mut self, file: File<'_>) -> Written;

    /// Calls a part.
    fn call(&mut self, part: File<'_>) -> Written;

    /// Ends a file.
    fn close(&mut self, file: File<'_>) -> Written;

    /// Ends the program: files that come after all others, and what is still to be handed to the sink.
    fn finish(&mut self, main: &str) -> Written;

    /// What someone should know who starts a part alone and not the part before it, as comments.
    fn caution(&self, before: &str) -> Vec<String>;
}

/// The words of a controller: comments, motions, signals.
pub trait Dialect: Files {
    /// A comment among the ops: words of ours, and words that people wrote after them.
    fn comment(&mut self, ours: &str, theirs: &str) -> Written;

    /// A comment at the head of a file.
    fn head_comment(&mut self, ours: &str, theirs: &str) -> Written {
        self.comment(ours, theirs)
    }

    /// A comment line that the job puts at the head.
    fn note(&mut self, line: &str) -> Written {
        self.head_comment("", line)
    }

    /// A line of the profile, as it is.
    fn verbatim(&mut self, line: &str) -> Written;

    /// The ops of a part follow. A part that is started alone finds nothing set, so nothing written before counts. `rate` is
    /// the rate at which its motions turn first.
    fn part_begins(&mut self, part: &Part, rate: Option<RateId>) -> Written;

    /// The ops of a part are written.
    fn part_ends(&mut self) -> Written {
        Ok(())
    }

    /// A layer begins, with this cut if it begins with one. Operations and cuts are comments in every dialect.
    fn layer_begins(&mut self, _layer: Layer, _cut: Option<NonZeroU32>) -> Written {
        Ok(())
    }

    /// A layer ends.
    fn layer_ends(&mut self, _layer: Layer) -> Written {
        Ok(())
    }

    /// The speed of the tip changes, where a dialect sets it apart from the motions.
    fn feed(&mut self, _feed: FeedId) -> Written {
        Ok(())
    }

    /// A motion of all axes.
    fn joint_move(&mut self, motion: &JointMove) -> Written;

    /// A straight motion or a turn.
    fn linear_move(&mut self, motion: &LinearMove<'_>) -> Written;

    /// Changes the blade at the change place, and sets up the tool that holds the new one.
    fn change_tool(&mut self, _change: &ToolChange<'_>) -> Written {
        Err(EmitError::Internal("a tool change was not refused"))
    }

    /// Turns the control's own spindle at a speed, or stops it.
    fn spin(&mut self, _speed: Option<AngularSpeed>) -> Written {
        Err(EmitError::Internal("a spindle was not refused"))
    }

    /// Switches the output of generator or spindle where it stands, not ahead of it.
    fn switch(&mut self, output: u32, state: Switch) -> Written;

    /// Waits until an input is high.
    fn await_input(&mut self, input: u32) -> Written;

    /// Waits.
    fn wait(&mut self, time: Duration) -> Written;
}
