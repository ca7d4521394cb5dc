//! Siemens Sinumerik 840D, 840D sl, 828D with the option, and ONE.
//!
//! `TRAORI` switches the five-axis transformation on; `ORIAXES` and `ORIMKS` make the rotary axes go straight to their values,
//! whichever of the two a machine's data asks for [S-840b]. `FGROUP` makes F the speed of the tip alone. `TRAFOOF` cancels
//! tool corrections in part, so D stands behind every switch [S-840].
//!
//! No tool is selected, for the knife is in the spindle; D is one of its edges, of which a tool has nine where D numbers are
//! not managed apart from tools.
//!
//! `SUPA` suppresses all offsets for one block, and with `D0` the words are positions of the axes. Outputs are written behind
//! `STOPRE`, so that they switch where they stand and not when the block is read ahead.

use super::{Comments, Dialect, File, Letters, standard_m};
use crate::options::Settings;
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::script::{Layout, trimmed_text};
use vcutc_backend_api::units::Length;

pub(super) struct Sinumerik;

impl Dialect for Sinumerik {
    fn name(&self) -> &'static str {
        "Sinumerik"
    }

    fn extensions(&self) -> [&'static str; 2] {
        ["MPF", "SPF"]
    }

    fn layout(&self) -> Layout {
        Layout {
            line_end: b"\n",
            longest_comment: 100,
            // `;$PATH=` and the like mean something to the archive.
            kept_out_of_comments: b"$%",
        }
    }

    fn comments(&self) -> Comments {
        Comments {
            open: "; ",
            close: "",
            letters: Letters::Any,
        }
    }

    fn longest_line(&self) -> usize {
        255
    }

    fn most_tools(&self) -> u32 {
        9
    }

    fn tool_number_name(&self) -> &'static str {
        "D number (the edge of the tool in the spindle, not the number of a tool)"
    }

    fn tool_name(&self, number: u32) -> String {
        format!("the tool in the spindle, edge D{number}")
    }

    fn opening(&self, _: File<'_>) -> Vec<String> {
        Vec::new()
    }

    fn setup(&self, _: &Settings<'_>, _: u32) -> Vec<String> {
        vec!["G17 G40 G90 G94 G710".to_owned(), "G60 G601".to_owned()]
    }

    fn work_offsets(&self) -> u32 {
        99
    }

    fn work_offset(&self, number: u32) -> Option<String> {
        match number {
            1..=4 => Some(format!("G{}", 53 + number)),
            5..=99 => Some(format!("G{}", 500 + number)),
            _ => None,
        }
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        let end = if file.place == 0 { "M30" } else { "M17" };
        vec![end.to_owned()]
    }

    fn call(&self, part: File<'_>) -> String {
        part.name.to_owned()
    }

    fn tcp_on(&self, _: &Settings<'_>, tool: u32) -> Vec<String> {
        vec![
            "TRAORI".to_owned(),
            "ORIAXES ORIMKS".to_owned(),
            "FGROUP(X,Y,Z)".to_owned(),
            format!("D{tool}"),
        ]
    }

    fn tcp_off(&self, _: &Settings<'_>) -> Vec<String> {
        vec!["TRAFOOF".to_owned()]
    }

    fn axis_move(&self) -> [&'static str; 2] {
        ["SUPA G1", " D0"]
    }

    fn exact(&self) -> Option<&'static str> {
        Some("G60")
    }

    fn rounded(&self, approximation: Length) -> Option<String> {
        Some(format!("G641 ADIS={}", trimmed_text(approximation.to_mm())))
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![format!("G4 F{seconds}")]
    }

    fn switch(&self, output: u32, state: Switch) -> Option<Vec<String>> {
        let value = match state {
            Switch::On => 1,
            Switch::Off => 0,
        };
        Some(vec!["STOPRE".to_owned(), format!("$A_OUT[{output}]={value}")])
    }

    fn await_input(&self, input: u32, label: u32) -> Option<Vec<String>> {
        Some(vec![format!(
            "READY{label}: IF $A_IN[{input}]==FALSE GOTOB READY{label}"
        )])
    }

    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            17 => Some("ends a part"),
            70 => Some("makes an axis of the spindle"),
            _ => standard_m(code),
        }
    }

    fn beside_m(&self) -> &'static str {
        "HS"
    }

    /// Not M17, M19, M20, M30, M40 to M45, M70 (end, orientation, strokes, gears, axis) and M98, M99 of the ISO mode.
    fn builders_codes(&self) -> &'static [RangeInclusive<u32>] {
        &[10..=16, 21..=29, 31..=39, 46..=69, 71..=95, 100..=197]
    }

    fn smoothing(&self) -> &'static [&'static str] {
        &["SOFT", "FFWON", "FFWOF"]
    }

    fn has_messages(&self) -> bool {
        true
    }

    fn signals(&self) -> RangeInclusive<u32> {
        1..=1024
    }
}
