//! Five-axis G-code output: LinuxCNC, Fanuc, Sinumerik and Heidenhain.

mod axes;
mod blocks;
mod body;
mod demands;
mod dialect;
mod limits;
mod names;
mod options;
mod pace;
mod program;

use crate::axes::{Word, WorkInOffset};
use crate::blocks::Blocks;
use crate::body::Source;
use crate::limits::Sayable;
use crate::names::{MOST_PARTS, main_name};
use crate::options::{LINES_PER_PART, OPTIONS, Settings};
use vcutc_backend_api::backend::{Backend, BackendIssue, Emission, EmitError, OptionSpec, Options};
use vcutc_backend_api::bundle::Sink;
use vcutc_backend_api::ir::Cell;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::script::{Lead, Part, Text, split};
use vcutc_backend_api::verify::{Capabilities, Capability};

/// The G-code backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gcode;

impl Backend for Gcode {
    fn id(&self) -> &'static str {
        "gcode"
    }

    fn summary(&self) -> &'static str {
        "five-axis G-code: LinuxCNC, Fanuc, Sinumerik or Heidenhain, with tool-centre-point control"
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities::NONE
            .with(Capability::LinearMove)
            .with(Capability::JointMove)
            .with(Capability::StillTipTurn)
            .with(Capability::Output)
            .with(Capability::AwaitInput)
            .with(Capability::Dwell)
    }

    fn options(&self) -> &'static [OptionSpec] {
        OPTIONS
    }

    fn reader(&self) -> Option<&dyn Reader> {
        None
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        let settings = Settings::read(options);
        let parts = split(&program.program().ops, settings.lines_per_part, headings);
        let Sayable { cell, words } = limits::check(program, &settings, &parts)?;
        if parts.len() > MOST_PARTS {
            return Err(vec![too_many_parts(parts.len())]);
        }
        Ok(Box::new(GcodeEmission {
            reachable: program,
            cell,
            settings,
            words,
            parts,
        }))
    }
}

/// Lines of comments before an op: the operation and the cut. Words that set a mode are not counted.
const fn headings(lead: Lead) -> u64 {
    lead.operation.is_some() as u64 + lead.cut.is_some() as u64
}

fn too_many_parts(count: usize) -> BackendIssue {
    BackendIssue::OptionConflict {
        key: LINES_PER_PART,
        why: format!("the program would need {count} parts, and part names have room for {MOST_PARTS}"),
    }
}

/// A program that G-code can say, and how.
struct GcodeEmission<'p> {
    reachable: &'p ReachableProgram,
    cell: &'p Cell,
    settings: Settings<'p>,
    words: Vec<Word>,
    parts: Vec<Part>,
}

impl Emission for GcodeEmission<'_> {
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError> {
        let source = Source {
            reachable: self.reachable,
            cell: self.cell,
            settings: &self.settings,
            words: &self.words,
            work_in_offset: WorkInOffset::new(self.cell.base.frame.orientation),
        };
        let name = main_name(&self.reachable.program().name, &self.settings);
        let mut text = Text::new(sink, self.settings.dialect.layout());
        let mut blocks = Blocks::new(&mut text, &self.settings);
        program::write(source, &name, &self.parts, &mut blocks)
    }
}
