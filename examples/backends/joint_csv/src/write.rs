//! Ops to rows.

use crate::{AXES, COLUMNS, COMMENT, DECIMALS, EXTENSION};
use vcutc_backend_api::backend::{Emission, EmitError, Options};
use vcutc_backend_api::bundle::Sink;
use vcutc_backend_api::ir::{Action, Cell, OpId, Program, Ready, Site, Switch};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::namer::{NameRules, Namer};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::script::{Layout, Text};
use vcutc_backend_api::segments::{LinearSegment, Path, Segment};
use vcutc_backend_api::units::{Angle, Length};

const LAYOUT: Layout = Layout {
    line_end: b"\n",
    longest_comment: 200,
    kept_out_of_comments: b"",
};

const NAMES: NameRules = NameRules {
    max_length: 40,
    prefix: "job_",
    reserved: &["CON", "PRN", "AUX", "NUL"],
};

/// The writer of a program that has been checked.
pub(crate) fn emission<'p>(reachable: &'p ReachableProgram, options: &'p Options) -> Box<dyn Emission + 'p> {
    Box::new(Table { reachable, options })
}

struct Table<'p> {
    reachable: &'p ReachableProgram,
    options: &'p Options,
}

impl Emission for Table<'_> {
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError> {
        let program = self.reachable.program();
        let mut namer = Namer::new(NAMES);
        namer.avoid(&self.options.profile().reserved);
        let mut text = Text::new(sink, LAYOUT);
        text.file(&format!("{}.{EXTENSION}", namer.name(&program.name)))?;
        text.comment(&format!("{COMMENT} "), "joint trajectory; mm, deg, s")?;
        for line in &self.options.profile().header {
            text.line(line)?;
        }
        text.line(&COLUMNS.join(","))?;
        for segment in program.segments() {
            let row = self.row(&segment)?;
            text.line(&format!("{},{},{row}", segment.id.0, site(segment.op.site)))?;
        }
        for line in &self.options.profile().footer {
            text.line(line)?;
        }
        text.flush()?;
        Ok(())
    }
}

/// A cell of the table that does not apply.
const NOTHING: &str = "";

impl Table<'_> {
    fn program(&self) -> &Program {
        self.reachable.program()
    }

    /// The columns from `do` on.
    fn row(&self, segment: &Segment<'_>) -> Result<String, EmitError> {
        let cell = self
            .program()
            .cell
            .as_ref()
            .ok_or(EmitError::Internal("a program without a machine"))?;
        match segment.path() {
            Path::Home | Path::Change | Path::Axes(_) => return self.motion("axes", segment.id, None),
            Path::Linear(line) => return self.motion("move", segment.id, Some(&line)),
            Path::Still => {}
        }
        let value = match segment.op.action {
            Action::Ultrasonic { state } => ("switch", self.output(cell, state)?),
            Action::AwaitReady => match cell.ready {
                Ready::Input(input) => ("await", input.to_string()),
                Ready::After(time) => ("wait", self.number(time.to_s())?),
            },
            Action::Dwell { time } => ("wait", self.number(time.to_s())?),
            Action::ToolChange { .. } => {
                return Err(EmitError::Internal("a tool change in a checked program"));
            }
            _ => return Err(EmitError::Internal("a straight move from nowhere")),
        };
        let (does, value) = value;
        let unused = ",".repeat(3 + AXES + 2);
        Ok(format!("{does}{unused},{value}"))
    }

    fn output(&self, cell: &Cell, state: Switch) -> Result<String, EmitError> {
        let output = cell
            .ultrasonic
            .ok_or(EmitError::Internal("a machine without output"))?;
        Ok(match state {
            Switch::On => format!("{output}=on"),
            Switch::Off => format!("{output}=off"),
        })
    }

    /// A motion to the axes at the end of an op; a line also says where the tip goes, and how fast.
    fn motion(&self, does: &str, id: OpId, line: Option<&LinearSegment>) -> Result<String, EmitError> {
        let axes = self
            .reachable
            .axes_after(id)
            .ok_or(EmitError::Internal("an op without axes"))?;
        let mut row = vec![does.to_owned()];
        match line.map(|line| line.to.tip) {
            Some(tip) => {
                for coordinate in [tip.x, tip.y, tip.z] {
                    row.push(self.number(coordinate)?);
                }
            }
            None => row.extend([NOTHING; 3].map(str::to_owned)),
        }
        for axis in axes.0 {
            row.push(self.number(Angle::rad(axis).to_deg())?);
        }
        let feed = line
            .filter(|line| line.length() > Length::ZERO)
            .and_then(|line| line.feed);
        let rate = line
            .filter(|line| line.turn > Angle::ZERO)
            .and_then(|line| line.rate);
        for pace in [
            feed.map(|feed| feed.to_mm_per_s()),
            rate.map(|rate| rate.to_deg_per_s()),
        ] {
            row.push(match pace {
                Some(pace) => self.number(pace)?,
                None => NOTHING.to_owned(),
            });
        }
        row.push(NOTHING.to_owned());
        Ok(row.join(","))
    }

    fn number(&self, value: f64) -> Result<String, EmitError> {
        let decimals = u8::try_from(self.options.integer(DECIMALS)).unwrap_or(u8::MAX);
        let mut digits = Vec::new();
        FixedDecimal::new(decimals).push(&mut digits, value)?;
        String::from_utf8(digits).map_err(|_| EmitError::Internal("digits that are no text"))
    }
}

/// Operations, layers and cuts are counted from 1.
fn site(site: Site) -> String {
    match site {
        Site::Program => "program".to_owned(),
        Site::Operation(operation) => format!("operation {}", u32::from(operation.0) + 1),
        Site::Layer { operation, layer } => format!("layer {}.{layer}", u32::from(operation.0) + 1),
        Site::Cut {
            operation,
            layer,
            cut,
        } => format!("cut {}.{layer}.{cut}", u32::from(operation.0) + 1),
    }
}
