//! The compiler with one more target: `vcutc-joint-csv rib.vcut --target joint_csv -o out`.

use std::process::ExitCode;
use vcutc_backend_joint_csv::JointCsv;

fn main() -> ExitCode {
    let mut targets = vcutc::registry::backends();
    targets.push(&JointCsv);
    vcutc::cli::run(&targets)
}
