//! Fanuc 30i, 31i, 32i and 0i-MF with tool centre point control (`G43.4`, rotary angles programmed).
//!
//! `G43.4` is switched on only where the axes stand as they should and the tip is clear, and only `G0` to `G3` go with it
//! [F-5AX]. `G53` is rapid and for one block; all axes arrive together if parameter 1401.1 (LRP) is 1, and how fast is set by
//! the rapid override. A number without a point may be read in thousandths, so every one has a point [F-30].
//!
//! The control has no words for digital signals: M codes are the builder's.

use super::{AxisPace, Dialect, File, standard_m};
use crate::options::Settings;
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::script::Layout;
use vcutc_backend_api::units::Length;

pub(super) struct Fanuc;

impl Dialect for Fanuc {
    fn name(&self) -> &'static str {
        "Fanuc"
    }

    fn extensions(&self) -> [&'static str; 2] {
        ["nc", "nc"]
    }

    fn layout(&self) -> Layout {
        Layout {
            line_end: b"\n",
            longest_comment: 80,
            kept_out_of_comments: b"()%;",
        }
    }

    fn longest_line(&self) -> usize {
        127
    }

    /// With increment system IS-B angles are read to the same place as lengths.
    fn angle_decimals(&self, lengths: u8) -> u8 {
        lengths
    }

    fn most_decimals(&self) -> u8 {
        4
    }

    fn fine_decimals(&self) -> u8 {
        3
    }

    /// Eight digits [F-30].
    fn farthest(&self, decimals: u8) -> f64 {
        if decimals > 3 { 9_999.0 } else { 99_999.0 }
    }

    fn most_tools(&self) -> u32 {
        999
    }

    fn numbers_programs(&self) -> bool {
        true
    }

    fn opening(&self, file: File<'_>) -> Vec<String> {
        vec!["%".to_owned(), format!("O{:04} ({})", number(file), file.name)]
    }

    fn setup(&self, _: &Settings<'_>, _: u32) -> Vec<String> {
        vec!["G17 G21 G40 G80 G90 G94".to_owned(), "G61".to_owned()]
    }

    fn work_offsets(&self) -> u32 {
        54
    }

    fn work_offset(&self, number: u32) -> Option<String> {
        match number {
            1..=6 => Some(format!("G{}", 53 + number)),
            7..=54 => Some(format!("G54.1 P{}", number - 6)),
            _ => None,
        }
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        let end = if file.place == 0 { "M30" } else { "M99" };
        vec![end.to_owned(), "%".to_owned()]
    }

    fn call(&self, part: File<'_>) -> String {
        format!("M98 P{:04}", number(part))
    }

    fn tcp_on(&self, _: &Settings<'_>, tool: u32) -> Vec<String> {
        vec![format!("G43.4 H{tool}")]
    }

    fn tcp_off(&self, _: &Settings<'_>) -> Vec<String> {
        vec!["G49".to_owned()]
    }

    fn axis_move(&self) -> [&'static str; 2] {
        ["G53 G0", ""]
    }

    fn note_of_axis_moves(&self) -> Option<&'static str> {
        Some("moves of all axes are rapid: parameter 1401.1, LRP, must be 1")
    }

    fn axis_pace(&self) -> AxisPace {
        AxisPace::Rapid
    }

    fn exact(&self) -> Option<&'static str> {
        Some("G61")
    }

    /// `G64` has no distance: how far it rounds is a matter of parameters and speed, and nothing that could be promised.
    fn rounded(&self, _: Length) -> Option<String> {
        None
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![format!("G4 X{seconds}")]
    }

    fn switch(&self, _: u32, _: Switch) -> Option<Vec<String>> {
        None
    }

    fn await_input(&self, _: u32, _: u32) -> Option<Vec<String>> {
        None
    }

    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            96 | 97 => Some("switches the interruption of programs"),
            198 => Some("calls a program"),
            _ => standard_m(code),
        }
    }

    fn beside_m(&self) -> &'static str {
        "PQS"
    }

    /// Not M19 (orients), M29 (rigid tapping), M30, M96 to M99 and M198 (jump, call, return).
    fn builders_codes(&self) -> &'static [RangeInclusive<u32>] {
        &[10..=18, 20..=28, 31..=95, 100..=197]
    }

    fn smoothing(&self) -> &'static [&'static str] {
        &["G05.1 Q1", "G05.1 Q0", "G5.1 Q1", "G5.1 Q0"]
    }

    fn signals(&self) -> RangeInclusive<u32> {
        0..=u32::MAX
    }
}

/// The O number of a file.
fn number(file: File<'_>) -> u64 {
    u64::from(file.program_number).saturating_add(file.place as u64)
}
