//! Programs of the four dialects read back.
//!
//! A line is read in three steps that know nothing of each other's business. [`lines`](crate::statement) finds what of it is
//! statement. The controller turns the statement into an [`Order`](crate::statement::Order): what the block says, in terms that
//! all controllers share. [`control`] keeps what was said before, as a control does, and says what the block
//! therefore does; [`walk`] goes from file to file ([`scripts`]).
//!
//! # What is understood
//!
//! * Motions of the tip on lines and arcs, every coordinate of which is known, and motions of all axes in coordinates of the machine.
//! * Absolute coordinates in mm, and what each dialect says of tool-centre-point control, exact stops, rounding, tools, work
//!   offsets, the meaning of F, outputs, inputs and waits, where it is that of the job. A motion for which one of these was not
//!   said, in the same part, is not understood.
//! * Parts in files of their own, each called once.
//! * Blocks that the job gives (`tcp_on`, `on_code`, ...) and lines of the machine's profile, as texts.
//!
//! Letters may be small, blanks and zeros missing, coordinates left out that stay as they were. Everything else (`G91`,
//! `G20`, variables, loops, other M codes) is reported as not understood: nothing is guessed. Motions of all axes are compared with the
//! job's `home_speed` ([`rates`]).

mod arcs;
mod codes;
mod context;
mod control;
mod profile;
mod rates;
mod scripts;
mod walk;

use crate::options::Settings;
use vcutc_backend_api::backend::Options;
use vcutc_backend_api::ir::AxisValues;
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::readback::{
    Configuration, Frames, Reader, Resolution, Sources, Statement, has_extension,
};
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// The reader of all dialects.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GcodeReader;

/// Extensions of programs, in small letters.
const EXTENSIONS: [&str; 8] = ["ngc", "nc", "mpf", "spf", "h", "cnc", "tap", "gcode"];

const SECONDS_A_MINUTE: f64 = 60.0;

impl Reader for GcodeReader {
    fn recognises(&self, file: &str) -> bool {
        has_extension(file, &EXTENSIONS)
    }

    fn resolution(&self, options: &Options) -> Resolution {
        let settings = Settings::read(options);
        let fine = settings.fine().half_unit();
        let angle = Angle::deg(settings.angles.half_unit());
        Resolution {
            // Printed in the frame of the machine, compared in that of the work: a coordinate of one may be made of all three
            // of the other.
            length: Length::mm(settings.common.lengths.half_unit() * 3.0_f64.sqrt()),
            attitude: angle,
            axis: angle,
            speed: Speed::mm_per_s(fine / SECONDS_A_MINUTE),
            rate: AngularSpeed::deg_per_s(fine / SECONDS_A_MINUTE),
            per_minute: fine,
            time: Duration::s(fine),
        }
    }

    fn frames(&self) -> Frames {
        Frames::OnMachine
    }

    /// Rotary axes are stated by their values, so nothing is left open.
    fn configuration(&self, _: Branch, _: AxisValues) -> Option<Configuration> {
        None
    }

    fn read(&self, sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
        walk::read(sources, visit);
    }
}
