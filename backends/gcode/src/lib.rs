//! Five-axis G-code output: LinuxCNC, Fanuc, Sinumerik and Heidenhain.
//!
//! # The dialects
//!
//! All four are one language as far as a knife needs it: blocks of words with a letter and a number, modes that hold until they
//! are changed, and tool-centre-point control, under which X, Y, Z are those of the tip and the control moves its linear axes
//! along while the rotary ones turn. So all four are one dialect to the writer (the module `dialect`), and what a controller says
//! in its own words it answers by the small questions of the trait `Controller`, a file for each in the module `controllers`.
//!
//! | | LinuxCNC 2.9 | Fanuc 30i | Sinumerik 840D | Heidenhain TNC |
//! |---|---|---|---|---|
//! | files | `.ngc` | `.nc` | `.MPF`, `.SPF` | `.H` |
//! | frame and end | `M2` | `%`, `O0001`, `M30`, `%` | `M30` | `BEGIN PGM`, `END PGM`, numbered lines |
//! | tip control on, off | `G43 H` and the job's `tcp_on`; `tcp_off` and `G49` | `G43.4 H`, `G49` | `TRAORI`, `TRAFOOF` | `FUNCTION TCPM`, `FUNCTION RESET TCPM` |
//! | all axes | `G53 G1`, inverse time | `G53 G0` | `SUPA G1 D0`, inverse time | `L M91`, feed |
//! | exact stop, rounding | `G61.1`, `G64 P` | `G61`, `G64` | `G60`, `G641 ADIS=` | always, never |
//! | arcs | `G2`, `G3`, I J K | the same | the same, `CIP` | `CC`, `C` |
//! | chains | `G64 P` | one piece | `G641 ADIS=` | `CYCL DEF 32` |
//! | turn about the still tip | `G93` | `G93` | `G93` | `F CONT`, deg/min |
//! | output | `M64 P`, `M65 P` | the job's codes | `STOPRE`, `$A_OUT[]=` | the job's codes |
//! | input | `M66 P L3 Q` | the job's code | `IF $A_IN[]==FALSE GOTOB` | `FN 20: WAIT FOR` |
//! | wait | `G4 P` | `G4 X` | `G4 F` | `CYCL DEF 9` |
//! | part | `o<name> call` | `M98 P` | its name | `CALL PGM` |
//!
//! # How an op is written
//!
//! | op | blocks |
//! |---|---|
//! | `Home`, `AxisTravel` | tip control off, then one block with the positions of all axes as the machine counts them |
//! | `Travel`, `Approach`, `Retract`, `Cut` | tip control on, then `G1` with the tip, all rotary axes and `F` in mm/min |
//! | `Follow` | the same, or an arc (the module `arcs`); what makes it continue is written before the first (the module `chains`) |
//! | `Turn` | the same with the tip of the block before, and `F` as inverse time |
//! | `Ultrasonic`, `AwaitReady`, `Dwell` | as in the table above |
//! | `Spin` | `S n M3`, `M5`; Heidenhain `TOOL CALL S n` and `M3`; or the spindle's output |
//! | `ToolChange` | `T n M6` with the place of the tool, or `M0`; Heidenhain `TOOL CALL n Z`; the axes are then taken to be anywhere |
//!
//! Every block of a motion is complete, so that it means the same wherever a program is entered, and modes stand on lines of
//! their own, written where they change.
//!
//! The tip is seen from the work offset, a frame parallel to the machine's axes with the origin of the workpiece frame; how the
//! work lies turned on the machine is in the coordinates (the module `axes`). Rotary words are the axis values of the program's
//! motion: continuous, never wrapped, so that no control has to choose a way round.
//!
//! F says exactly the time that the proof of reach assumed for a motion (the module `pace`). Where the tip moves that is its
//! way divided by the time. A turn about the still tip has no such way: under a speed its time would depend
//! on the control.
//!
//! # Machines
//!
//! Machines with linear axes X, Y, Z and two rotary ones among A, B, C. An orientable spindle (axis S of a machine's sheet) has
//! to be an axis of the control too, because the blade turns during motions; `spindle_axis` gives its letter.
//! `M19` and `SPOS` only go from stand to stand and are never written.
//!
//! # Sources
//!
//! * [L-GC], [L-MC], [L-OV] LinuxCNC documentation: `g-code.adoc`, `m-code.adoc`, `overview.adoc`; [L-SW], [L-BC] switchable
//!   kinematics, commit 135b0ce522 and `xyzbc-trt-kins.c`
//! * [F-30] Fanuc B-63942EN "Series 30i descriptions"; [F-TCP] A-79348E "Tool center point control for 5-axis machining";
//!   [F-5AX] "Fanuc 5-axis machining functions"
//! * [S-B1] Siemens 6FC5397-0BP40, function manual "Basic functions", B1
//! * [S-840], [S-840b], [S-JP] Siemens 6FC5398-2BP20, -2BP10, -2EP40: "Programming Manual Job Planning", "NC programming"
//! * [H-430], [H-620] Heidenhain user manuals TNC 426/430, TNC 620
//!
//! Of this output only LinuxCNC's has been run, by its interpreter; `docs/backends/gcode.md` says what to check on a control.

mod arcs;
mod axes;
mod blocks;
mod chains;
mod codes;
mod controller;
mod controllers;
mod demands;
mod dialect;
mod files;
mod given;
mod iso;
mod job;
mod limits;
mod names;
mod options;
mod pace;
mod profile;
mod read;
mod statement;
mod tools;

use crate::blocks::Blocks;
use crate::dialect::GcodeDialect;
use crate::job::Job;
use crate::limits::Sayable;
use crate::names::{MOST_PARTS, main_name};
use crate::options::{OPTIONS, Settings};
use crate::read::GcodeReader;
use vcutc_backend_api::backend::{Backend, BackendIssue, Emission, MachineMismatch, OptionSpec, Options};
use vcutc_backend_api::ir::{MachineKind, Maker};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::script::{Borders, CAPABILITIES, Lead, Source, Text, emission, split, write};
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
        CAPABILITIES
            .with(Capability::ToolChange)
            .with(Capability::Chain)
            .with(Capability::Spindle)
    }

    fn options(&self) -> &'static [OptionSpec] {
        OPTIONS
    }

    fn mismatch(&self, kind: MachineKind, _: Maker) -> Option<MachineMismatch> {
        limits::foreign(kind)
    }

    fn reader(&self) -> Option<&dyn Reader> {
        Some(&GcodeReader)
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        let settings = Settings::read(options).of(program.program().purpose);
        let parts = split(
            &program.program().ops,
            settings.common.lines_per_part,
            // Tool-centre-point control is off while a part goes to its first pose: where it was held at another place than
            // the axes say by themselves, the blade would jump beside the core.
            Borders::AboveStock(program.program().stock),
            &|_, lead| headings(lead),
        );
        let Sayable { cell, words } = limits::check(program, &settings, &parts)?;
        let source = Source {
            reachable: program,
            cell,
        };
        emission(parts, MOST_PARTS, move |parts, sink| {
            let main = main_name(&source.program().name, &settings);
            let mut text = Text::new(sink, settings.facts().layout);
            let blocks = Blocks::new(&mut text, &settings);
            let mut gcode = GcodeDialect::new(Job::new(source, &settings, &words), blocks);
            write(&mut gcode, source, &settings.common, &main, parts)
        })
    }
}

/// Lines of comments before an op: the operation and the cut. Words that set a mode are not counted.
const fn headings(lead: Lead) -> u64 {
    lead.operation.is_some() as u64 + lead.cut.is_some() as u64
}
