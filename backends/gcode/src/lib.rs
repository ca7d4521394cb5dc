//! Five-axis G-code output: LinuxCNC, Fanuc, Sinumerik and Heidenhain.

mod dialect;
mod options;

use crate::options::{OPTIONS, Settings};
use vcutc_backend_api::backend::{Backend, BackendIssue, Emission, MachineMismatch, OptionSpec, Options};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
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
        _program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        let _settings = Settings::read(options);
        Err(vec![BackendIssue::WrongMachine {
            mismatch: MachineMismatch::Kind,
            drives: "five-axis machines",
        }])
    }
}
