//! LinuxCNC 2.9.
//!
//! Tool-centre-point control is a property of the kinematics module: while one is active that is not the identity, X, Y, Z are
//! those of the tip. Which M codes switch between the two is a matter of each configuration (in the sample configurations
//! M428 and M429, in either order), so the job has to say them [L-SW, L-BC]. The kinematics takes the tool offset at hand for
//! the tool's length, so the offset changes only while the identity is active: `G43` stands before the switch and `G49` behind
//! the switch back, for otherwise the axes would have to jump.
//!
//! `G53` moves in machine coordinates with `G0` and `G1`, without the tool offset; with inverse time the whole block takes the
//! time that F says. `M64` and `M65` wait for the motion before them. `M66` gives up after the time Q, with -1 in `#5399`, and goes
//! on; so it is in a loop that waits again.
//!
//! Checked with the interpreter of LinuxCNC 2.9.

use super::{Comments, Dialect, File, Letters, TcpCodes, standard_m};
use crate::options::Settings;
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::script::{Layout, trimmed_text};
use vcutc_backend_api::units::Length;

pub(super) struct LinuxCnc;

impl Dialect for LinuxCnc {
    fn name(&self) -> &'static str {
        "LinuxCNC"
    }

    fn extensions(&self) -> [&'static str; 2] {
        ["ngc", "ngc"]
    }

    fn layout(&self) -> Layout {
        Layout {
            line_end: b"\n",
            longest_comment: 100,
            // Parentheses end a comment, and `%` at the start of a line would end the program.
            kept_out_of_comments: b"()%",
        }
    }

    fn comments(&self) -> Comments {
        Comments {
            open: "(",
            close: ")",
            letters: Letters::Any,
        }
    }

    fn name_letters(&self) -> Letters {
        // Names of subroutines are looked for in small letters [L-MC].
        Letters::Small
    }

    fn longest_line(&self) -> usize {
        255
    }

    fn most_tools(&self) -> u32 {
        9999
    }

    fn opening(&self, file: File<'_>) -> Vec<String> {
        match file.place {
            0 => Vec::new(),
            _ => vec![format!("o<{}> sub", file.name)],
        }
    }

    fn setup(&self, _: &Settings<'_>, _: u32) -> Vec<String> {
        vec!["G17 G21 G40 G80 G90 G94".to_owned(), "G61.1".to_owned()]
    }

    fn work_offsets(&self) -> u32 {
        9
    }

    fn work_offset(&self, number: u32) -> Option<String> {
        match number {
            1..=6 => Some(format!("G{}", 53 + number)),
            7..=9 => Some(format!("G59.{}", number - 6)),
            _ => None,
        }
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        match file.place {
            0 => vec!["M2".to_owned()],
            _ => vec![format!("o<{}> endsub", file.name), "M2".to_owned()],
        }
    }

    fn call(&self, part: File<'_>) -> String {
        format!("o<{}> call", part.name)
    }

    fn tcp_codes(&self) -> TcpCodes {
        TcpCodes::Given
    }

    fn tcp_on(&self, settings: &Settings<'_>, tool: u32) -> Vec<String> {
        let mut lines = vec![format!("G43 H{tool}")];
        lines.extend_from_slice(settings.codes.tcp_on);
        lines
    }

    fn tcp_off(&self, settings: &Settings<'_>) -> Vec<String> {
        let mut lines = settings.codes.tcp_off.to_vec();
        lines.push("G49".to_owned());
        lines
    }

    fn axis_move(&self) -> [&'static str; 2] {
        ["G53 G1", ""]
    }

    fn exact(&self) -> Option<&'static str> {
        Some("G61.1")
    }

    /// Without Q the interpreter would also drop points that lie within P of a line.
    fn rounded(&self, approximation: Length) -> Option<String> {
        Some(format!("G64 P{} Q0", trimmed_text(approximation.to_mm())))
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![format!("G4 P{seconds}")]
    }

    fn switch(&self, output: u32, state: Switch) -> Option<Vec<String>> {
        let code = match state {
            Switch::On => "M64",
            Switch::Off => "M65",
        };
        Some(vec![format!("{code} P{output}")])
    }

    /// After the time Q the interpreter would go on, with -1 in `#5399` [L-MC]; then the wait begins again.
    fn await_input(&self, input: u32, label: u32) -> Option<Vec<String>> {
        Some(vec![
            format!("o<ready{label}> do"),
            format!("M66 P{input} L3 Q86400"),
            format!("o<ready{label}> while [#5399 LT 0]"),
        ])
    }

    /// [L-MC].
    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            48..=53 => Some("switches the overrides"),
            60 => Some("stops the program"),
            61 => Some("changes the tool"),
            62 | 63 | 67 => Some("switches with the next motion"),
            70..=73 => Some("saves modes or brings them back"),
            _ => standard_m(code),
        }
    }

    /// `M68 E3 Q1` and `M66 E0 L0` are in the sample configurations.
    fn beside_m(&self) -> &'static str {
        "ELPQS"
    }

    /// M100 to M199 run what the integrator wrote.
    fn example_codes(&self) -> [&'static str; 3] {
        ["M101", "M102", "M103"]
    }

    /// M100 to M199 run programs of the builder's [L-MC].
    fn builders_codes(&self) -> &'static [RangeInclusive<u32>] {
        &[100..=199]
    }

    fn signals(&self) -> RangeInclusive<u32> {
        0..=63
    }
}
