//! Heidenhain TNC (iTNC 530, TNC 640, TNC7) in Klartext.
//!
//! Every line has a number, from 0 and without gaps, and every coordinate a sign [H-430]. `FUNCTION TCPM` holds the tip; with
//! `F TCP` F is the speed of the tip, with `F CONT` that along the way of the axes that the block names [H-620]. The dialect has
//! no inverse time, so a turn about the still tip names the rotary axes alone under `F CONT`, and F is their rate in deg/min.
//!
//! `M91` makes the words of one block positions of the axes, without the tool's length [H-620]; before it TCPM is reset. Their
//! speed is that along the way of all axes, mm and degrees counted alike.
//!
//! Cycle 247 activates a preset where the job gives its number; without one that is the operator's. `~` at the end of its line
//! says that the block goes on in the next line, which has no number of its own (TNC 640, Cycle Programming).
//!
//! `R0` blocks stop at corners; there is no word that allows rounding at one of them and not at the next. M codes for outputs
//! are the builder's.

use super::{AxisPace, Comments, Dialect, FeedMode, File, Letters, Numbering, Signs, Unnumbered, standard_m};
use crate::options::Settings;
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::script::Layout;
use vcutc_backend_api::units::Length;

pub(super) struct Heidenhain;

const F_TCP: &str = "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS";
const F_CONT: &str = "FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS";

impl Dialect for Heidenhain {
    fn name(&self) -> &'static str {
        "Heidenhain"
    }

    fn extensions(&self) -> [&'static str; 2] {
        ["H", "H"]
    }

    fn layout(&self) -> Layout {
        Layout {
            line_end: b"\n",
            longest_comment: 80,
            // `~` goes on in the next line.
            kept_out_of_comments: b"~%",
        }
    }

    fn comments(&self) -> Comments {
        Comments {
            open: "; ",
            close: "",
            letters: Letters::Any,
        }
    }

    fn numbering(&self) -> Numbering {
        Numbering::Lines
    }

    fn signs(&self) -> Signs {
        Signs::Always
    }

    fn longest_line(&self) -> usize {
        127
    }

    fn most_decimals(&self) -> u8 {
        4
    }

    fn fine_decimals(&self) -> u8 {
        3
    }

    fn most_tools(&self) -> u32 {
        9999
    }

    fn opening(&self, file: File<'_>) -> Vec<String> {
        vec![format!("BEGIN PGM {} MM", file.name)]
    }

    fn setup(&self, _: &Settings<'_>, tool: u32) -> Vec<String> {
        // M127: rotary axes go to the value that is written, not the shorter way round.
        vec![format!("TOOL CALL {tool} Z"), "M127".to_owned()]
    }

    fn work_offsets(&self) -> u32 {
        9999
    }

    fn unnumbered(&self) -> Unnumbered {
        Unnumbered::Operators
    }

    /// Cycle 247 activates a preset; its parameter stands in a line without number.
    fn work_offset(&self, _: u32) -> Option<String> {
        Some("CYCL DEF 247 DATUM SETTING ~".to_owned())
    }

    fn rest_of_work_offset(&self, number: u32) -> Option<String> {
        Some(format!("  Q339=+{number} ;DATUM NUMBER"))
    }

    fn work_offset_name(&self, number: u32) -> String {
        format!("preset {number}")
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        let end = format!("END PGM {} MM", file.name);
        match file.place {
            0 => vec!["M30".to_owned(), end],
            _ => vec![end],
        }
    }

    fn call(&self, part: File<'_>) -> String {
        format!("CALL PGM {}", part.name)
    }

    fn tcp_on(&self, _: &Settings<'_>, _: u32) -> Vec<String> {
        vec![F_TCP.to_owned()]
    }

    fn tcp_off(&self, _: &Settings<'_>) -> Vec<String> {
        vec!["FUNCTION RESET TCPM".to_owned()]
    }

    fn feed_mode_of_tcp(&self) -> Option<FeedMode> {
        Some(FeedMode::Tip)
    }

    fn straight(&self) -> &'static str {
        "L"
    }

    fn before_feed(&self) -> &'static str {
        " R0"
    }

    fn axis_move(&self) -> [&'static str; 2] {
        ["L", " M91"]
    }

    fn axis_pace(&self) -> AxisPace {
        AxisPace::Path
    }

    fn still_tip(&self) -> FeedMode {
        FeedMode::Rotary
    }

    fn feed_mode(&self, mode: FeedMode) -> &'static str {
        match mode {
            FeedMode::Tip | FeedMode::InverseTime => F_TCP,
            FeedMode::Rotary => F_CONT,
        }
    }

    fn exact(&self) -> Option<&'static str> {
        None
    }

    fn rounded(&self, _: Length) -> Option<String> {
        None
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![
            "CYCL DEF 9.0 DWELL TIME".to_owned(),
            format!("CYCL DEF 9.1 DWELL {seconds}"),
        ]
    }

    fn switch(&self, _: u32, _: Switch) -> Option<Vec<String>> {
        None
    }

    fn await_input(&self, input: u32, _: u32) -> Option<Vec<String>> {
        Some(vec![format!("FN 20: WAIT FOR I{input}==1")])
    }

    /// From M89 on the control's own codes say how it moves [H-620].
    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            89..=149 | 197 | 198 => Some("changes how the control moves or calls"),
            _ => standard_m(code),
        }
    }

    fn beside_m(&self) -> &'static str {
        ""
    }

    /// Not M13 and M14 (spindle on), M19, M30, M60 (pallet), nor M89 and above, which are the control's own.
    fn builders_codes(&self) -> &'static [RangeInclusive<u32>] {
        &[10..=12, 15..=18, 20..=29, 31..=59, 61..=88]
    }

    fn has_spindle_words(&self) -> bool {
        false
    }

    fn signals(&self) -> RangeInclusive<u32> {
        0..=152
    }
}
