//! The one writer of programs: files, headings and ops in their order. How each of them reads is the [`Dialect`]'s.

use super::dialect::{Dialect, File, JointMove, JointTarget, LinearMove, Source, ToolChange};
use super::head::head_lines;
use super::listing::{Lead, Modal, first_of};
use super::options::Common;
use super::split::Part;
use super::tables::operation_heading;
use super::text::{Written, digits};
use crate::backend::EmitError;
use crate::corners::may_round;
use crate::ir::{Action, Blade, Changer, CutKind, Joint, Op, OpId, Ready, Spindle, Switch, ToolId};
use crate::readback::End;
use crate::segments::{LinearSegment, Path, Segment};
use crate::state::{Drive, Place};
use crate::verify::{Capabilities, Capability};
use core::num::NonZeroU32;

/// The ops that are written: all but changes of the tool.
pub const CAPABILITIES: Capabilities = Capabilities::NONE
    .with(Capability::LinearMove)
    .with(Capability::JointMove)
    .with(Capability::StillTipTurn)
    .with(Capability::Output)
    .with(Capability::AwaitInput)
    .with(Capability::Dwell);

/// Writes all files of a program: the main program, and the parts that it calls where there are several.
///
/// # Errors
/// What the sink reports, or a fault of the compiler.
pub fn write<D: Dialect>(
    dialect: &mut D,
    source: Source<'_>,
    common: &Common<'_>,
    main: &str,
    parts: &[Part],
) -> Written {
    let (whole, called) = match parts {
        [only] => (Some(only), &[][..]),
        parts => (None, parts),
    };
    let names: Vec<String> = (1..=called.len())
        .map(|part| dialect.part_name(main, part))
        .collect();
    let file = |name, place, part| File {
        name,
        place,
        part,
        main,
        parts: parts.len(),
    };
    let called: Vec<File<'_>> = (1..)
        .zip(names.iter().zip(called))
        .map(|(place, (name, part))| file(name, place, Some(part)))
        .collect();
    let file = file(main, 0, whole);
    dialect.open(file)?;
    for line in head_lines(source.program(), &source.cell.name) {
        dialect.head_comment(&line.ours, line.theirs)?;
    }
    for line in common.header {
        dialect.note(line)?;
    }
    dialect.setup(file)?;
    for &part in &called {
        call(dialect, source, part)?;
    }
    if let Some(part) = whole {
        PartWriter::new(dialect, source, common).write(part)?;
    }
    for line in &common.profile.footer {
        dialect.verbatim(line)?;
    }
    dialect.close(file)?;
    for &file in &called {
        dialect.open(file)?;
        continuation(dialect, main, file, &called)?;
        dialect.setup(file)?;
        if let Some(part) = file.part {
            PartWriter::new(dialect, source, common).write(part)?;
        }
        dialect.close(file)?;
    }
    dialect.finish(main)
}

/// The call of a part.
fn call(dialect: &mut impl Dialect, source: Source<'_>, file: File<'_>) -> Written {
    if let Some((part, op)) = file.part.and_then(|part| Some((part, source.ops(part).first()?))) {
        let program = source.program();
        dialect.comment(&first_of(program, op, part.start.tool), "")?;
    }
    dialect.call(file)
}

/// What someone who opens a part should know.
fn continuation(dialect: &mut impl Dialect, main: &str, file: File<'_>, all: &[File<'_>]) -> Written {
    let File { place, parts, .. } = file;
    dialect.head_comment(&format!("part {place} of {parts}: start {main}, not this"), "")?;
    let before = place.checked_sub(2).and_then(|before| all.get(before));
    for line in before
        .map(|before| dialect.caution(before.name))
        .unwrap_or_default()
    {
        dialect.head_comment(&line, "")?;
    }
    Ok(())
}

/// Writes the ops of a part.
struct PartWriter<'a, 'd, D> {
    dialect: &'d mut D,
    source: Source<'a>,
    common: &'a Common<'a>,
    modal: Modal,
    heading: CutHeading,
}

/// The words over a cut. They stand over every one of them, so they are put together without formatting.
#[derive(Default)]
struct CutHeading(String);

impl CutHeading {
    fn set(&mut self, layer: NonZeroU32, kind: CutKind, cut: NonZeroU32) {
        self.0.clear();
        self.0.push_str("layer ");
        self.whole(layer);
        self.0.push(' ');
        self.0.push_str(kind.noun());
        self.0.push(' ');
        self.whole(cut);
    }

    fn whole(&mut self, number: NonZeroU32) {
        let mut room = [0; 10];
        let digits = digits(number.get(), &mut room);
        self.0.extend(digits.iter().copied().map(char::from));
    }
}

impl<'a, 'd, D: Dialect> PartWriter<'a, 'd, D> {
    fn new(dialect: &'d mut D, source: Source<'a>, common: &'a Common<'a>) -> Self {
        Self {
            dialect,
            source,
            common,
            modal: Modal::default(),
            heading: CutHeading::default(),
        }
    }

    fn write(mut self, part: &Part) -> Written {
        let ops = self.source.ops(part);
        // Both speeds are written at the head of a part, because its first motion may set only one of them.
        let (feed, rate) = self.modal.first_speeds(ops);
        if let Some(feed) = feed {
            self.dialect.feed(feed)?;
        }
        self.dialect.part_begins(part, rate)?;
        self.restate(part)?;
        let segments = self.source.program().segments_of(part.ops.clone(), part.start);
        let followers = ops.iter().skip(1).map(Some).chain([None]);
        for (segment, next) in segments.zip(followers) {
            self.lead(segment.op, segment.before.tool)?;
            self.op(&segment, next.map(|next| &next.action))?;
        }
        if let Some(layer) = self.modal.open_layer() {
            self.dialect.layer_ends(layer)?;
        }
        self.dialect.part_ends()
    }

    /// Repeats the state in which the part begins. Called from the main program this changes nothing; a part started alone is
    /// brought to the pose, on the branch and with the blade vibrating and spinning, that its first move was checked from.
    fn restate(&mut self, part: &Part) -> Written {
        let target = match part.start.place {
            Place::Unknown => None,
            Place::Home => Some(JointTarget::Home),
            Place::Change => Some(JointTarget::Change),
            Place::Pose(pose) => Some(JointTarget::Pose(pose)),
        };
        if let (Some(before), Some(to)) = (part.ops.start.checked_sub(1), target) {
            self.joint_move(op_id(before)?, to, None)?;
        }
        let (spindle, generator) = (part.start.spindle, part.start.generator);
        if spindle != Drive::Off {
            self.spin(part.start.tool, Switch::On)?;
        }
        if generator != Drive::Off {
            self.switch(Switch::On)?;
        }
        if [spindle, generator].contains(&Drive::Running) {
            self.await_ready()?;
        }
        Ok(())
    }

    /// What comes before an op: headings and speeds.
    fn lead(&mut self, op: &Op, tool: ToolId) -> Written {
        let Lead {
            close,
            operation,
            open,
            cut,
            feed,
            rate: _,
        } = self.modal.lead(op);
        if let Some(layer) = close {
            self.dialect.layer_ends(layer)?;
        }
        if let Some(operation) = operation {
            let (ours, blades) = operation_heading(self.source.program(), operation)?;
            self.dialect.comment(&ours, &blades)?;
        }
        if let Some(layer) = open {
            self.dialect.layer_begins(layer, cut.map(|(_, cut)| cut))?;
        }
        if let Some((layer, cut)) = cut {
            let kind = self.source.program().cut_kind(layer.operation, tool);
            self.heading.set(layer.number, kind, cut);
            self.dialect.comment(&self.heading.0, "")?;
        }
        match feed {
            Some(feed) => self.dialect.feed(feed),
            None => Ok(()),
        }
    }

    fn op(&mut self, segment: &Segment<'_>, next: Option<&Action>) -> Written {
        let from = match segment.before.place {
            Place::Unknown => None,
            Place::Home | Place::Change | Place::Pose(_) => segment.id.0.checked_sub(1).map(OpId),
        };
        match (segment.path(), segment.op.action) {
            (Path::Home, _) => self.joint_move(segment.id, JointTarget::Home, from),
            (Path::Change, _) => self.joint_move(segment.id, JointTarget::Change, from),
            (Path::Axes(to), _) => self.joint_move(segment.id, JointTarget::Pose(to), from),
            (Path::Linear(line), _) => self.linear_move(segment, &line, next),
            (Path::Still, Action::Ultrasonic { state }) => self.switch(state),
            (Path::Still, Action::Spin { state }) => self.spin(segment.before.tool, state),
            (Path::Still, Action::AwaitReady) => self.await_ready(),
            (Path::Still, Action::Dwell { time }) => self.dialect.wait(time),
            (Path::Still, Action::ToolChange { tool }) => self.change_tool(segment.id, tool),
            (Path::Still, _) => Err(EmitError::Internal("a move starts from an unknown pose")),
        }
    }

    /// A move of all axes to where they are after an op, from where they are after another.
    fn joint_move(&mut self, op: OpId, to: JointTarget, from: Option<OpId>) -> Written {
        let from = from.map(|from| self.source.axes_after(from)).transpose()?;
        let axes = self.source.axes_after(op)?;
        self.dialect.joint_move(&JointMove { op, to, from, axes })
    }

    fn linear_move(&mut self, segment: &Segment<'_>, line: &LinearSegment, next: Option<&Action>) -> Written {
        let (stock, action) = (self.source.program().stock, &segment.op.action);
        let end = match (self.common.approximation, action) {
            (
                _,
                Action::Follow {
                    joint: Joint::Through,
                    ..
                },
            ) => End::Through {
                within: self.source.program().blend,
            },
            (Some(_), _) if may_round(stock, segment.before.place, action, next) => End::Rounded,
            (Some(_) | None, _) => End::Exact,
        };
        self.dialect.linear_move(&LinearMove {
            op: segment.id,
            action,
            line,
            end,
        })
    }

    fn change_tool(&mut self, op: OpId, id: ToolId) -> Written {
        let Source { cell, .. } = self.source;
        let (Some(tool), Some(change), Some(blade)) =
            (cell.tools.get(id), cell.change, self.source.program().blade(id))
        else {
            return Err(EmitError::Internal("a tool is not in its table"));
        };
        let place = match change.by {
            Changer::Program => Some(tool.place.ok_or(EmitError::Internal("a tool has no place"))?),
            Changer::Hand => None,
        };
        self.dialect.change_tool(&ToolChange {
            op,
            id,
            tool,
            blade: &blade.name,
            place,
        })
    }

    fn switch(&mut self, state: Switch) -> Written {
        let output = self.source.cell.ultrasonic;
        self.dialect
            .switch(output.ok_or(EmitError::Internal("no ultrasonic output"))?, state)
    }

    /// Switches the spindle with a blade at hand.
    fn spin(&mut self, tool: ToolId, state: Switch) -> Written {
        let spindle = self.source.cell.spindle;
        match spindle.ok_or(EmitError::Internal("no spindle"))? {
            Spindle::Output(output) => self.dialect.switch(output, state),
            Spindle::Own => {
                let blade = self.source.program().blade(tool);
                let speed = blade.and_then(Blade::spin).filter(|_| state == Switch::On);
                self.dialect.spin(speed)
            }
        }
    }

    fn await_ready(&mut self) -> Written {
        match self.source.cell.ready {
            Ready::Input(input) => self.dialect.await_input(input),
            Ready::After(time) => self.dialect.wait(time),
        }
    }
}

fn op_id(index: usize) -> Result<OpId, EmitError> {
    let id = u32::try_from(index).map_err(|_| EmitError::Internal("more ops than have numbers"))?;
    Ok(OpId(id))
}
