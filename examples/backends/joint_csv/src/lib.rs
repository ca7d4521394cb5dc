//! A small but complete backend: the joint trajectory of an arm as a table in CSV.
//!
//! One row for every op. What a row does is one of five words:
//!
//! | `do` | Columns in use | Ops |
//! | --- | --- | --- |
//! | `axes` | `A1` to `A6` in deg | `Home`, `AxisTravel` |
//! | `move` | `x`, `y`, `z` in mm; `A1` to `A6` in deg; `tip` in mm/s and `turn` in deg/s where they matter | all straight moves and turns |
//! | `switch` | `value`: output and state, such as `12=on` | `Ultrasonic` |
//! | `await` | `value`: the input | `AwaitReady` |
//! | `wait` | `value`: seconds | `AwaitReady`, `Dwell` |
//!
//! Every move ends in a standstill. `op` and `site` are for people. Lines that begin with `#` are comments.
//!
//! `docs/backends.md` walks through this crate.

mod read;
mod write;

use read::CsvReader;
use vcutc_backend_api::backend::{
    Backend, BackendIssue, Emission, MachineMismatch, OptionKind, OptionSpec, Options,
};
use vcutc_backend_api::ir::{Action, AxisKind, Cell, MachineKind, OpId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::verify::{Capabilities, Capability};

/// The axes of the machines that this drives.
pub(crate) const AXES: usize = 6;

/// The columns, in order.
pub(crate) const COLUMNS: [&str; 15] = [
    "op", "site", "do", "x", "y", "z", "A1", "A2", "A3", "A4", "A5", "A6", "tip", "turn", "value",
];

pub(crate) const DECIMALS: &str = "decimals";
pub(crate) const EXTENSION: &str = "csv";
pub(crate) const COMMENT: char = '#';

const OPTIONS: &[OptionSpec] = &[OptionSpec {
    key: DECIMALS,
    kind: OptionKind::Integer {
        min: 3,
        max: 6,
        default: 4,
    },
    help: "Decimals of all numbers.",
}];

/// The backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct JointCsv;

impl Backend for JointCsv {
    fn id(&self) -> &'static str {
        "joint_csv"
    }

    fn summary(&self) -> &'static str {
        "joint trajectory as CSV: NAME.csv, a row for every op (arms with six axes)"
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
        Some(&CsvReader)
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        let mut issues: Vec<BackendIssue> = match &program.program().cell {
            Some(cell) => machine_issues(cell),
            None => vec![wrong_machine(MachineMismatch::Kind)],
        };
        issues.extend(profile_issues(options.profile()));
        let ops = (0..).map(OpId).zip(&program.program().ops);
        issues.extend(ops.filter_map(|(op, said)| match said.action {
            Action::ToolChange { .. } => Some(BackendIssue::Unsupported {
                op,
                what: Capability::ToolChange.words(),
            }),
            _ => None,
        }));
        if issues.is_empty() {
            Ok(write::emission(program, options))
        } else {
            Err(issues)
        }
    }
}

fn wrong_machine(mismatch: MachineMismatch) -> BackendIssue {
    BackendIssue::WrongMachine {
        mismatch,
        drives: "arms with six rotary axes",
    }
}

fn machine_issues(cell: &Cell) -> Vec<BackendIssue> {
    let mut issues = Vec::new();
    if cell.kind != MachineKind::Robot {
        issues.push(wrong_machine(MachineMismatch::Kind));
    } else if cell.axes.len() != AXES || cell.axes.iter().any(|axis| axis.kind != AxisKind::Rotary) {
        issues.push(wrong_machine(MachineMismatch::Arm));
    }
    if cell.ultrasonic.is_none() {
        issues.push(BackendIssue::MissingMachineField {
            field: "ultrasonic",
            why: "a row says which output is switched",
        });
    }
    issues
}

/// What of a profile a table cannot have. `reserved` is honoured where the file gets its name, and `decimals` sets the option.
fn profile_issues(profile: &Profile) -> Vec<BackendIssue> {
    let comments = |lines: &[String]| lines.iter().all(|line| line.starts_with(COMMENT));
    let refused = [
        (
            "header",
            !comments(&profile.header),
            "in a table all lines that are no rows begin with `#`",
        ),
        (
            "footer",
            !comments(&profile.footer),
            "in a table all lines that are no rows begin with `#`",
        ),
        (
            "extension",
            profile
                .extension
                .as_deref()
                .is_some_and(|extension| extension != EXTENSION),
            "tables are known by `csv`",
        ),
        (
            "line_numbers",
            profile.line_numbers.is_some(),
            "rows have the numbers of their ops",
        ),
    ];
    let refused = refused.into_iter().filter(|(_, is_refused, _)| *is_refused);
    refused
        .map(|(key, _, why)| BackendIssue::Profile {
            key,
            why: why.to_owned(),
        })
        .collect()
}
