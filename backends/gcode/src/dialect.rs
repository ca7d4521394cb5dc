//! What the dialects of G-code say differently.
//!
//! [`Dialect`] asks the small questions and answers each in the way of the standard (ISO 6983, as Fanuc's controls read it); a
//! dialect overrides what it says in its own way. The writer and the reader of programs are the same for all.

mod fanuc;
mod heidenhain;
mod linuxcnc;
mod sinumerik;

use crate::options::Settings;
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::script::Layout;
use vcutc_backend_api::units::Length;

/// Whose programs are written and read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Controller {
    /// LinuxCNC 2.9.
    #[default]
    LinuxCnc,
    /// Fanuc 30i, 31i, 0i-MF.
    Fanuc,
    /// Siemens Sinumerik 840D, ONE.
    Sinumerik,
    /// Heidenhain TNC in Klartext.
    Heidenhain,
}

impl Controller {
    /// All of them, the default first.
    const ALL: [Self; 4] = [Self::LinuxCnc, Self::Fanuc, Self::Sinumerik, Self::Heidenhain];

    /// Their words in a job.
    pub(crate) const WORDS: &[&str] = &{
        let [first, second, third, fourth] = Self::ALL;
        [first.word(), second.word(), third.word(), fourth.word()]
    };

    const fn word(self) -> &'static str {
        match self {
            Self::LinuxCnc => "linuxcnc",
            Self::Fanuc => "fanuc",
            Self::Sinumerik => "sinumerik",
            Self::Heidenhain => "heidenhain",
        }
    }

    /// The one of that word; the default for words of nobody, which the compiler does not let through.
    pub(crate) fn of(word: &str) -> Self {
        let mut all = Self::ALL.into_iter();
        all.find(|controller| controller.word() == word)
            .unwrap_or_default()
    }

    /// How its programs are written.
    pub(crate) const fn dialect(self) -> &'static dyn Dialect {
        match self {
            Self::LinuxCnc => &linuxcnc::LinuxCnc,
            Self::Fanuc => &fanuc::Fanuc,
            Self::Sinumerik => &sinumerik::Sinumerik,
            Self::Heidenhain => &heidenhain::Heidenhain,
        }
    }
}

/// What the word F means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FeedMode {
    /// Speed of the tip, in mm/min.
    Tip,
    /// Inverse time: the block takes a minute divided by F.
    InverseTime,
    /// Rate of the rotary axes together, in deg/min.
    Rotary,
}

/// How a move of all axes with tool-centre-point control off gets its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AxisPace {
    /// By inverse time.
    InverseTime,
    /// By a speed along the way of all axes, mm and degrees counted alike.
    Path,
    /// It is rapid; the control's override sets its speed.
    Rapid,
}

/// Whose words switch tool-centre-point control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TcpCodes {
    /// The dialect's own; the job has none to add.
    Own,
    /// Those of the machine's configuration, which the job has to give.
    Given,
}

/// How comments look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Comments {
    /// Before the words.
    pub(crate) open: &'static str,
    /// Behind them.
    pub(crate) close: &'static str,
    /// Which letters they may have.
    pub(crate) letters: Letters,
}

/// Which letters are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Letters {
    /// Capitals only.
    Capital,
    /// Small ones only.
    Small,
    /// Both.
    Any,
}

/// How blocks are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Numbering {
    /// With N words, where the profile asks for them.
    Words,
    /// Every line, from 0 and without gaps.
    Lines,
}

/// When numbers have a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signs {
    /// Where they are negative.
    Negative,
    /// Always.
    Always,
}

/// Who calls the work offset up when the job gives it no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unnumbered {
    /// The program: it is the first.
    First,
    /// The operator, before the program is started.
    Operators,
}

/// A file of a program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct File<'a> {
    /// Its name without extension.
    pub(crate) name: &'a str,
    /// Its place among the program's files: 0 for the main program, parts from 1.
    pub(crate) place: usize,
    /// Fanuc's number of the main program.
    pub(crate) program_number: u32,
}

/// A way of writing G-code. Statements are lines without number and comment.
pub(crate) trait Dialect: Sync {
    /// What it is called.
    fn name(&self) -> &'static str;

    /// Extensions of the main program's file and of those of its parts, without the dot.
    fn extensions(&self) -> [&'static str; 2];

    /// Lines and what comments must not hold.
    fn layout(&self) -> Layout;

    /// How comments look.
    fn comments(&self) -> Comments {
        Comments {
            open: "(",
            close: ")",
            letters: Letters::Capital,
        }
    }

    /// The letters of names.
    fn name_letters(&self) -> Letters {
        Letters::Capital
    }

    /// How blocks are numbered.
    fn numbering(&self) -> Numbering {
        Numbering::Words
    }

    /// When coordinates have a sign.
    fn signs(&self) -> Signs {
        Signs::Negative
    }

    /// Longest line, in characters.
    fn longest_line(&self) -> usize;

    /// Decimals of angles where lengths have so many: 0.001 deg at the end of a 300 mm blade is 5 um, so one more.
    fn angle_decimals(&self, lengths: u8) -> u8 {
        lengths.saturating_add(1)
    }

    /// Most decimals of lengths that the control reads.
    fn most_decimals(&self) -> u8 {
        6
    }

    /// Most decimals of speeds, inverse times and waits.
    fn fine_decimals(&self) -> u8 {
        6
    }

    /// Largest coordinate, in mm or degrees, with so many decimals.
    fn farthest(&self, _decimals: u8) -> f64 {
        99_999.0
    }

    /// Largest F word: mm/min, 1/min or deg/min.
    fn largest_feed(&self) -> f64 {
        99_999.0
    }

    /// Largest number of a tool.
    fn most_tools(&self) -> u32;

    /// What that number is, for messages.
    fn tool_number_name(&self) -> &'static str {
        "tool number"
    }

    /// What the operator calls the entry with the blade's length.
    fn tool_name(&self, number: u32) -> String {
        format!("tool {number}")
    }

    /// Whether programs are called by numbers.
    fn numbers_programs(&self) -> bool {
        false
    }

    /// What stands before everything else in a file, comments included.
    fn opening(&self, file: File<'_>) -> Vec<String>;

    /// What sets up everything that motions depend on; tool-centre-point control is off.
    fn setup(&self, settings: &Settings<'_>, tool: u32) -> Vec<String>;

    /// How many work offsets there are.
    fn work_offsets(&self) -> u32;

    /// Who calls the work offset up when the job gives it no number.
    fn unnumbered(&self) -> Unnumbered {
        Unnumbered::First
    }

    /// The block that makes the work offset of that number hold, counted from 1; none beyond the last.
    fn work_offset(&self, number: u32) -> Option<String>;

    /// The line that continues this block, where one does.
    fn rest_of_work_offset(&self, _number: u32) -> Option<String> {
        None
    }

    /// What the operator calls it.
    fn work_offset_name(&self, number: u32) -> String {
        self.work_offset(number).unwrap_or_default()
    }

    /// What ends a file, tool-centre-point control being off.
    fn closing(&self, file: File<'_>) -> Vec<String>;

    /// What calls a part.
    fn call(&self, part: File<'_>) -> String;

    /// What the job has to say about switching tool-centre-point control.
    fn tcp_codes(&self) -> TcpCodes {
        TcpCodes::Own
    }

    /// Tool-centre-point control on, with the length of that tool.
    fn tcp_on(&self, settings: &Settings<'_>, tool: u32) -> Vec<String>;

    /// Tool-centre-point control off.
    fn tcp_off(&self, settings: &Settings<'_>) -> Vec<String>;

    /// What F means when tool-centre-point control has been switched on; none if as before.
    fn feed_mode_of_tcp(&self) -> Option<FeedMode> {
        None
    }

    /// The word of a straight move of the tip.
    fn straight(&self) -> &'static str {
        "G1"
    }

    /// What stands between the coordinates and F of a straight move.
    fn before_feed(&self) -> &'static str {
        ""
    }

    /// The words around the coordinates of a move of all axes, which are those of the machine: before and behind them.
    fn axis_move(&self) -> [&'static str; 2];

    /// What the operator has to know of it, as a comment at the head.
    fn note_of_axis_moves(&self) -> Option<&'static str> {
        None
    }

    /// How it gets its time.
    fn axis_pace(&self) -> AxisPace {
        AxisPace::InverseTime
    }

    /// How turns about the still tip get their time.
    fn still_tip(&self) -> FeedMode {
        FeedMode::InverseTime
    }

    /// What sets the meaning of F.
    fn feed_mode(&self, mode: FeedMode) -> &'static str {
        match mode {
            // With rotary axes alone in a block it is deg/min.
            FeedMode::Tip | FeedMode::Rotary => "G94",
            FeedMode::InverseTime => "G93",
        }
    }

    /// Moves from here on end at a standstill; none where there is no other way.
    fn exact(&self) -> Option<&'static str>;

    /// Corners from here on are rounded as far as this; none where that cannot be said.
    fn rounded(&self, approximation: Length) -> Option<String>;

    /// A wait; the time in s is printed already.
    fn dwell(&self, seconds: &str) -> Vec<String>;

    /// What switches an output; none where only the builder of the machine knows.
    fn switch(&self, output: u32, state: Switch) -> Option<Vec<String>>;

    /// What waits until an input is high; none where only the builder of the machine knows. The label is new in its file.
    fn await_input(&self, input: u32, label: u32) -> Option<Vec<String>>;

    /// What the control does by an M code of its own that a block of the job must not do, as the rest of a sentence; none for
    /// the codes of builders.
    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        standard_m(code)
    }

    /// Letters of the words that may stand beside an M code of the builder.
    fn beside_m(&self) -> &'static str;

    /// Codes as a builder may choose them, for messages: generator on, off, and ready.
    fn example_codes(&self) -> [&'static str; 3] {
        ["M50", "M51", "M52"]
    }

    /// The M codes that a control leaves to the builder of the machine, as far as none of them is known to end, call, orient,
    /// change tools or switch outputs. Lines of a profile may have them.
    fn builders_codes(&self) -> &'static [RangeInclusive<u32>];

    /// Statements of a profile that make axes run more smoothly and change neither ways nor stops.
    fn smoothing(&self) -> &'static [&'static str] {
        &[]
    }

    /// Whether `MSG("...")` shows a message.
    fn has_messages(&self) -> bool {
        false
    }

    /// Whether a block may have an S word.
    fn has_spindle_words(&self) -> bool {
        true
    }

    /// Smallest and largest number of an output or input.
    fn signals(&self) -> RangeInclusive<u32>;
}

/// What M codes do on all controls.
const fn standard_m(code: u32) -> Option<&'static str> {
    match code {
        0 | 1 => Some("stops the program"),
        2 | 30 => Some("ends the program"),
        6 => Some("changes the tool"),
        19 => Some("turns the spindle"),
        98 => Some("calls a program"),
        99 => Some("ends a part"),
        _ => None,
    }
}
