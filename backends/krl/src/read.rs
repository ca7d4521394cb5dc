//! KRL programs read back.
//!
//! [`syntax`](crate::syntax) turns lines into statements with places, and [`interpreter`](crate::interpreter) carries them out: both serve any
//! reader of KRL. What is here is strict, and goes as far as the programs of this crate do: speeds and modes are kept, and
//! every statement is reported with what it does ([`Effect`](vcutc_backend_api::readback::Effect)).
//!
//! # What is understood
//!
//! * Modules of `.src` and `.dat`, subprograms of a file, `GLOBAL DEF`. The program is the first module that no other
//!   calls. A routine is followed where it is called first; a second call of it is not understood, nor is the
//!   head of one that is never called.
//! * `PTP`, `LIN`, `SPTP`, `SLIN` to literals and to positions with names, whose components may be given one by one. What a
//!   literal leaves out is what the last one said; S and T count for moves of all axes only. External axes may be given
//!   as 0, because the arms of this crate have none.
//! * `C_DIS` after `LIN` and `C_SPL` after `SLIN`. Other ways of rounding, and rounded moves of all axes, are
//!   not understood, because nothing says how far they cut a corner.
//! * `$VEL.CP`, `$VEL.ORI1` and `.ORI2`, `$TOOL` and `$BASE` by value or number, `$OUT[n]`,
//!   `WAIT SEC`, `WAIT FOR $IN[n]`.
//! * Calls of the cell's routine that changes the blade, or `HALT` where a person does. Tool and load have to be set again
//!   after it.
//! * Modes, load, rounding distance and axis speed, where they are those of the job; anything else is not understood, nor
//!   is a motion for which one of them was not said (the module `setup`).
//! * Lines of the machine's profile at the head and the end of the program.
//!
//! Everything else is reported as [`Unknown`](vcutc_backend_api::readback::Effect::Unknown): nothing is
//! guessed. Lines with `&` at the head of a file are records of the controller's editor, which counts there
//! how often it has saved a file; like comments, they are not statements.

mod controller;
mod profile;
mod program;
mod setup;
mod tools;

use crate::configuration::StatusAndTurn;
use crate::options::Settings;
use crate::turns::RATES;
use vcutc_backend_api::backend::Options;
use vcutc_backend_api::ir::AxisValues;
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::readback::{
    Configuration, Frames, Reader, Resolution, Sources, Statement, has_extension,
};
use vcutc_backend_api::script::TRIMMED;
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Speed};

#[derive(Clone, Copy, Debug, Default)]
pub struct KrlReader;

impl Reader for KrlReader {
    fn recognises(&self, file: &str) -> bool {
        has_extension(file, &["src", "dat"])
    }

    fn resolution(&self, options: &Options) -> Resolution {
        let settings = Settings::read(options);
        let angle = Angle::deg(settings.angles.half_unit());
        Resolution {
            length: Length::mm(settings.common.lengths.half_unit()),
            // A, B and C may each be off by as much, and at B = 90 deg A and C turn about the same line.
            attitude: angle * 3.0,
            axis: angle,
            speed: Speed::m_per_s(TRIMMED.half_unit()),
            rate: AngularSpeed::deg_per_s(RATES.half_unit()),
            per_minute: 0.0,
            time: Duration::s(TRIMMED.half_unit()),
        }
    }

    fn frames(&self) -> Frames {
        Frames::InProgram
    }

    fn configuration(&self, branch: Branch, axes: AxisValues) -> Option<Configuration> {
        StatusAndTurn::of(branch, axes)?.configuration()
    }

    fn read(&self, sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
        program::read(sources, visit);
    }
}
