//! What a controller of the family is asked: how it is written and how it is read.
//!
//! [`Controller`] asks small questions and answers each in the way of the standard (ISO 6983, as Fanuc's controls read it); a
//! controller overrides what it says in its own way. The writer and the reader of programs are the same for all.

use crate::iso::m_code;
use crate::statement::{Convention, FeedMode, Mode, Order, Parsed, Routine, Scope, Style};
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::script::Layout;
use vcutc_backend_api::units::Length;

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

/// Which arcs a control has, and how it states their centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arcs {
    /// In the three planes; I, J, K lead from the start to the centre.
    InPlanes,
    /// The same, and in any plane through a point between the ends.
    InAnyPlane,
    /// In the plane of X and Y, about a pole of its own block.
    AboutPole,
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

/// What the number is by which a control finds the length of a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NumberOf {
    /// That of the tool in the control's table.
    Tool,
    /// That of an edge of the tool in the spindle.
    Edge,
}

/// What a control knows a tool by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToolNumbers {
    /// Its place in the changer; none where nothing or a person changes it.
    pub(crate) place: Option<u32>,
    /// The number of its length.
    pub(crate) number: u32,
}

/// When numbers have a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signs {
    /// Where they are negative.
    Negative,
    /// Always.
    Always,
}

/// What calls up the work offset when the job gives it no number.
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
    /// Fanuc's number of it.
    pub(crate) number: u64,
}

impl File<'_> {
    /// What ends it.
    pub(crate) fn ending(&self, facts: &Facts) -> String {
        let [main, part] = facts.endings;
        let ending = if self.place == 0 { main } else { part };
        ending.to_owned()
    }
}

/// Which files begin with their name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Heads {
    None,
    OfParts,
    All,
}

/// Blocks that only the builder of a machine knows. Empty where the job gives none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Codes<'p> {
    /// Tool-centre-point control on.
    pub(crate) tcp_on: &'p [String],
    /// Tool-centre-point control off.
    pub(crate) tcp_off: &'p [String],
    /// Generator on.
    pub(crate) on: &'p [String],
    /// Generator off.
    pub(crate) off: &'p [String],
    /// Until the generator is ready.
    pub(crate) ready: &'p [String],
}

/// What is fixed of a controller. [`Facts::STANDARD`] has what most of them share.
pub(crate) struct Facts {
    /// What it is called.
    pub(crate) name: &'static str,
    /// Extensions of the main program's file and of those of its parts, without the dot.
    pub(crate) extensions: [&'static str; 2],
    /// What comments and block numbers look like.
    pub(crate) style: Style,
    /// Lines and what comments must not hold.
    pub(crate) layout: Layout,
    /// The letters of comments.
    pub(crate) comment_letters: Letters,
    /// The letters of names.
    pub(crate) name_letters: Letters,
    /// When coordinates have a sign.
    pub(crate) signs: Signs,
    /// Longest line, in characters.
    pub(crate) longest_line: usize,
    /// How many decimals angles have more than lengths: 0.001 deg at the end of a 300 mm blade is 5 um, so one.
    pub(crate) more_decimals_of_angles: u8,
    /// Most decimals of lengths that the control reads.
    pub(crate) most_decimals: u8,
    /// Most decimals of speeds, inverse times and waits.
    pub(crate) fine_decimals: u8,
    /// Largest number of a tool.
    pub(crate) most_tools: u32,
    /// What that number counts.
    pub(crate) number_of: NumberOf,
    /// What it is called, for messages.
    pub(crate) tool_number_name: &'static str,
    /// Whether programs are called by numbers.
    pub(crate) numbers_programs: bool,
    /// How many work offsets there are.
    pub(crate) work_offsets: u32,
    /// What calls up the work offset when the job gives it no number.
    pub(crate) unnumbered: Unnumbered,
    /// What the job has to say about switching tool-centre-point control.
    pub(crate) tcp_codes: TcpCodes,
    /// What F means when tool-centre-point control has been switched on; none if as before.
    pub(crate) feed_mode_of_tcp: Option<FeedMode>,
    /// The arcs that it has.
    pub(crate) arcs: Arcs,
    /// The word that makes I, J and K count from the start of an arc; none where they always do.
    pub(crate) centres_from_start: Option<&'static str>,
    /// The word of a straight move of the tip.
    pub(crate) straight: &'static str,
    /// What stands between the coordinates and F of a straight move.
    pub(crate) before_feed: &'static str,
    /// The words around the coordinates of a move of all axes, which are those of the machine: before and after them.
    pub(crate) axis_move: [&'static str; 2],
    /// What the operator has to know of it, as a comment at the head.
    pub(crate) note_of_axis_moves: Option<&'static str>,
    /// How it gets its time.
    pub(crate) axis_pace: AxisPace,
    /// The tool that must be named for moves of all axes; none where it does not matter.
    pub(crate) tool_of_axis_moves: Option<u32>,
    /// How turns about the still tip get their time.
    pub(crate) still_tip: FeedMode,
    /// Moves from here on end at a standstill; none where they always do.
    pub(crate) exact: Option<&'static str>,
    /// The same in the block of a move, where a chain ends, with the blank after it; none where that takes blocks of its own.
    pub(crate) exact_in_block: Option<&'static str>,
    /// The word after which moves end at a standstill, for messages.
    pub(crate) exact_word: &'static str,
    /// Letters of the words that may stand beside an M code of the builder.
    pub(crate) beside_m: &'static str,
    /// Codes as a builder may choose them, for messages: generator on, off, and ready.
    pub(crate) example_codes: [&'static str; 3],
    /// The M codes that a control leaves to the builder of the machine, as far as none of them is known to end, call, orient,
    /// change tools or switch outputs. Lines of a profile may have them.
    pub(crate) builders_codes: &'static [RangeInclusive<u32>],
    /// Statements of a profile that make axes run more smoothly and change neither ways nor stops.
    pub(crate) smoothing: &'static [&'static str],
    /// Whether `MSG("...")` shows a message.
    pub(crate) has_messages: bool,
    /// Whether a block may have an S word.
    pub(crate) has_spindle_words: bool,
    /// Smallest and largest number of an output or input.
    pub(crate) signals: RangeInclusive<u32>,
    /// What a program has to say before the tip moves, each with the words that say it.
    pub(crate) conventions: &'static [(Convention, &'static str)],
    /// What holds without being said.
    pub(crate) unsaid: &'static [Mode],
    /// Which files begin with their name.
    pub(crate) heads: Heads,
    /// Who changes blades.
    pub(crate) changes: Changes,
    /// What ends the program and a part.
    pub(crate) endings: [&'static str; 2],
}

impl Facts {
    /// Those of the standard.
    pub(crate) const STANDARD: Self = Self {
        name: "ISO 6983",
        extensions: ["nc", "nc"],
        style: Style::Brackets,
        layout: Layout {
            line_end: b"\n",
            longest_comment: 80,
            kept_out_of_comments: b"()%",
        },
        comment_letters: Letters::Any,
        name_letters: Letters::Capital,
        signs: Signs::Negative,
        longest_line: 127,
        more_decimals_of_angles: 1,
        most_decimals: 6,
        fine_decimals: 6,
        most_tools: 9999,
        number_of: NumberOf::Tool,
        tool_number_name: "tool number",
        numbers_programs: false,
        work_offsets: 6,
        unnumbered: Unnumbered::First,
        tcp_codes: TcpCodes::Own,
        feed_mode_of_tcp: None,
        arcs: Arcs::InPlanes,
        centres_from_start: None,
        straight: "G1",
        before_feed: "",
        axis_move: ["G53 G1", ""],
        note_of_axis_moves: None,
        axis_pace: AxisPace::InverseTime,
        tool_of_axis_moves: None,
        still_tip: FeedMode::InverseTime,
        exact: Some("G61"),
        exact_in_block: None,
        exact_word: "G61",
        beside_m: "",
        example_codes: ["M50", "M51", "M52"],
        builders_codes: &[],
        smoothing: &[],
        has_messages: false,
        has_spindle_words: true,
        signals: 0..=u32::MAX,
        conventions: &[(Convention::Absolute, "G90"), (Convention::Millimetres, "G21")],
        unsaid: &[],
        heads: Heads::All,
        changes: Changes::ByOthers,
        endings: ["M30", "M99"],
    };
}

/// Who changes blades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Changes {
    /// The control's own cycle, after which all modes are as before.
    ByTheControl,
    /// A macro of the machine's builder, or a person: either may leave other modes.
    ByOthers,
}

/// Largest coordinate, in mm or degrees.
pub(crate) const FARTHEST: f64 = 99_999.0;

/// Largest F word: mm/min, 1/min or deg/min.
pub(crate) const LARGEST_FEED: f64 = 99_999.0;

/// A controller's way with G-code. Statements are lines without number and comment.
pub(crate) trait Controller: Sync {
    /// What is fixed of it.
    fn facts(&self) -> &'static Facts;

    /// Largest coordinate, in mm or degrees, with so many decimals.
    fn farthest(&self, _decimals: u8) -> f64 {
        FARTHEST
    }

    /// What the operator calls the entry with the blade's length.
    fn tool_name(&self, tool: ToolNumbers) -> String {
        match tool.place {
            Some(place) if place != tool.number => format!("tool T{place}, length H{}", tool.number),
            Some(_) | None => format!("tool {}", tool.number),
        }
    }

    /// What stands before everything else in a file, comments included.
    fn opening(&self, file: File<'_>) -> Vec<String>;

    /// What sets up everything that motions depend on; tool-centre-point control is off.
    fn setup(&self, tool: u32) -> Vec<String>;

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

    /// Tool-centre-point control on, with the length of that tool.
    fn tcp_on(&self, codes: Codes<'_>, tool: u32) -> Vec<String>;

    /// Tool-centre-point control off.
    fn tcp_off(&self, codes: Codes<'_>) -> Vec<String>;

    /// What changes the blade, tool-centre-point control being off: `M6` by the machine, and for a person a stop of the program.
    fn change(&self, tool: ToolNumbers) -> String {
        match tool.place {
            Some(place) => format!("T{place} M6"),
            None => "M0".to_owned(),
        }
    }

    /// What turns the spindle at a speed, in 1/min, or stops it.
    fn spin(&self, speed: Option<u32>) -> Vec<String> {
        vec![match speed {
            Some(speed) => format!("S{speed} M3"),
            None => "M5".to_owned(),
        }]
    }

    /// What sets the meaning of F.
    fn feed_mode(&self, mode: FeedMode) -> &'static str {
        match mode {
            // With rotary axes alone in a block it is deg/min.
            FeedMode::Tip | FeedMode::Rotary => "G94",
            FeedMode::InverseTime => "G93",
        }
    }

    /// Corners from here on are rounded as far as this; none where that cannot be said.
    fn rounded(&self, _approximation: Length) -> Option<String> {
        None
    }

    /// Motions from here on go on into each other, the tip never farther from them than this; none where that cannot be said.
    fn through(&self, within: Length) -> Option<Vec<String>> {
        self.rounded(within).map(|block| vec![block])
    }

    /// What ends this before the last motion of a chain, where the block of that motion does not say it.
    fn through_ends(&self) -> Vec<String> {
        Vec::new()
    }

    /// A wait; the time in s is printed already.
    fn dwell(&self, seconds: &str) -> Vec<String>;

    /// What switches an output; none where only the builder of the machine knows.
    fn switch(&self, _output: u32, _state: Switch) -> Option<Vec<String>> {
        None
    }

    /// What waits until an input is high; none where only the builder of the machine knows. The label is new in its file.
    fn await_input(&self, _input: u32, _label: u32) -> Option<Vec<String>> {
        None
    }

    /// What the control does by an M code of its own that a block of the job must not do, as the rest of a sentence; none for
    /// the codes of builders.
    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        m_code(code)
    }

    /// The name under which a file is called.
    fn routine<'t>(&self, file: &'t str, text: &'t str) -> Option<Routine<'t>>;

    /// What can be called by a name for which there is no part, for messages.
    fn callable(&self, _: Routine<'_>) -> String {
        "the name of a part, called once".to_owned()
    }

    /// What a statement orders.
    fn order<'t>(&self, code: &'t str, scope: Scope<'_>) -> Parsed<Order<'t>>;
}
