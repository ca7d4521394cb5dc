//! The argument for air cuts.

use clap::Args;
use vcutc_backend_api::units::Length;
use vcutc_driver::air_cut_height;

/// What a program is for.
#[derive(Debug, Args)]
pub(in crate::cli) struct AirArgs {
    /// Lift the program by this height, such as 100mm, with the generator off, for a first run in the air
    ///
    /// The same cuts, in a program named NAME_air, at no more than 100 mm/s and 30 deg/s. The compiler proves that the
    /// blade stays above the stock and that the machine can carry out the lifted program.
    #[arg(long, value_name = "HEIGHT", value_parser = air_cut_height, allow_hyphen_values = true)]
    pub(in crate::cli) air_cut: Option<Length>,
}
