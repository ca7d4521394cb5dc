//! Fanuc 30i, 31i, 32i and 0i-MF with tool centre point control (`G43.4`, rotary angles programmed).
//!
//! `G43.4` is switched on only where the axes stand as they should and the tip is clear, and only `G0` to `G3` go with it
//! [F-5AX]. `G53` is rapid and for one block; all axes arrive together if parameter 1401.1 (LRP) is 1, and how fast is set by
//! the rapid override. A number without a point may be read in thousandths, so every one has a point [F-30].
//!
//! Arcs go with `G43.4` too, and the rotary axes of a head turn along with them; those of a table as long as the coordinates are
//! those of the table [F-TCP]. How far the tip leaves its way under `G64`, no word states, so a chain has one piece.
//!
//! The control has no words for digital signals: M codes are the builder's.
//!
//! A coordinate without a point may be read in thousandths of a mm, as a parameter says [F-30], so it is refused. One M code is
//! what a block may have without other parameters. `;` is the end of a block, as the screen shows it, and no comment.

use crate::controller::{AxisPace, Codes, Controller, FARTHEST, Facts, File, Letters};
use crate::iso::{american_g_code, m_code, seconds};
use crate::statement::{
    Act, Block, Code, Cursor, Flow, Mode, Number, Once, Order, Parsed, Point, ReadError, Routine, Scope,
    Style, Tcp, block, expected, line,
};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::Layout;
use vcutc_backend_api::units::Duration;

pub(super) struct Fanuc;

const MILLISECONDS: f64 = 1000.0;

const FACTS: Facts = Facts {
    name: "Fanuc",
    style: Style::Blocks,
    layout: Layout {
        line_end: b"\n",
        longest_comment: 80,
        kept_out_of_comments: b"()%;",
    },
    comment_letters: Letters::Capital,
    // With increment system IS-B angles are read to the same place as lengths.
    more_decimals_of_angles: 0,
    most_decimals: 4,
    fine_decimals: 3,
    most_tools: 999,
    numbers_programs: true,
    work_offsets: 54,
    axis_move: ["G53 G0", ""],
    note_of_axis_moves: Some("moves of all axes are rapid: parameter 1401.1, LRP, must be 1"),
    axis_pace: AxisPace::Rapid,
    beside_m: "PQS",
    // Not M19 (orients), M29 (rigid tapping), M30, M96 to M99 and M198 (jump, call, return).
    builders_codes: &[10..=18, 20..=28, 31..=95, 100..=197],
    smoothing: &["G05.1 Q1", "G05.1 Q0", "G5.1 Q1", "G5.1 Q0"],
    ..Facts::STANDARD
};

impl Controller for Fanuc {
    fn facts(&self) -> &'static Facts {
        &FACTS
    }

    /// Eight digits [F-30].
    fn farthest(&self, decimals: u8) -> f64 {
        if decimals > 3 { 9_999.0 } else { FARTHEST }
    }

    fn opening(&self, file: File<'_>) -> Vec<String> {
        vec!["%".to_owned(), format!("O{:04} ({})", file.number, file.name)]
    }

    fn setup(&self, _: u32) -> Vec<String> {
        vec!["G17 G21 G40 G80 G90 G94".to_owned(), "G61".to_owned()]
    }

    fn work_offset(&self, number: u32) -> Option<String> {
        match number {
            1..=6 => Some(format!("G{}", 53 + number)),
            7..=54 => Some(format!("G54.1 P{}", number - 6)),
            _ => None,
        }
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        vec![file.ending(&FACTS), "%".to_owned()]
    }

    fn call(&self, part: File<'_>) -> String {
        format!("M98 P{:04}", part.number)
    }

    fn tcp_on(&self, _: Codes<'_>, tool: u32) -> Vec<String> {
        vec![format!("G43.4 H{tool}")]
    }

    fn tcp_off(&self, _: Codes<'_>) -> Vec<String> {
        vec!["G49".to_owned()]
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![format!("G4 X{seconds}")]
    }

    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            96 | 97 => Some("switches the interruption of programs"),
            198 => Some("calls a program"),
            _ => m_code(code),
        }
    }

    /// The number after O, which is the first statement but for `%`.
    fn routine<'t>(&self, _: &'t str, text: &'t str) -> Option<Routine<'t>> {
        let mut at = 0;
        while let Some((line, next)) = line(text, at) {
            match FACTS.style.code(line, at) {
                Code::None => {}
                Code::Is(_, "%") => {}
                Code::Is(_, code) => return head(code),
                Code::Broken(..) | Code::Active(_) => return None,
            }
            at = next;
        }
        None
    }

    fn order<'t>(&self, code: &'t str, scope: Scope<'_>) -> Parsed<Order<'t>> {
        if code == "%" {
            return Ok(Order::flow(Flow::Tape));
        }
        if let Some(routine) = head(code) {
            return Ok(Order::flow(Flow::Head(routine)));
        }
        let mut order = Order::default();
        let mut words = block(code, FACTS.style)?;
        if words.m.count() > 1 {
            return expected("one M code in a block");
        }
        for code in words.g.iter() {
            g(code, &mut words, &mut order)?;
        }
        for code in words.m.iter() {
            m(code, &mut words, &mut order)?;
        }
        let axes = scope.words.iter().map(|word| word.letter);
        let mut letters = axes.chain(*b"IJK");
        if let Some(letter) = letters.find(|&letter| words.lacks_a_point(letter)) {
            return expected(format!("a number with a point after `{}`", char::from(letter)));
        }
        words.finish(scope, &mut order)?;
        Ok(order)
    }
}

/// `O1234`.
fn head(code: &str) -> Option<Routine<'static>> {
    let mut cursor = Cursor::new(code, Style::Blocks);
    let number = match cursor.letter() {
        Some(b'O') => cursor.number()?.whole()?,
        Some(_) | None => return None,
    };
    cursor.end().is_ok().then_some(Routine::Number(number))
}

fn g(code: u32, words: &mut Block, order: &mut Order<'_>) -> Parsed<()> {
    match code {
        40 => {
            let time = dwell(words)?;
            order.does(Act::Wait(time))
        }
        90 => {
            order.exact_once = Once::Yes;
            Ok(())
        }
        434 => {
            order.set(Mode::Tcp(Some(Tcp::On)))?;
            order.set(Mode::Tool(Some(words.whole(b'H')?)))
        }
        490 => {
            order.set(Mode::Tcp(Some(Tcp::Off)))?;
            order.set(Mode::Tool(Some(0)))
        }
        541 => {
            let more = words.whole(b'P')?;
            order.set(Mode::Work(more.saturating_add(6)))
        }
        610 => order.set(Mode::Stop(Some(End::Exact))),
        // How far depends on parameters.
        640 => order.set(Mode::Stop(None)),
        _ if american_g_code(code, order)? => Ok(()),
        _ => Err(ReadError::Unknown),
    }
}

/// `G4 X1.5` in seconds, `G4 P1500` in milliseconds.
fn dwell(words: &mut Block) -> Parsed<Duration> {
    match (words.take(b'X'), words.take(b'P')) {
        (
            Some(Number {
                point: Point::LeftOut,
                ..
            }),
            None,
        ) => expected("a number with a point after `X`"),
        (Some(time), None) => seconds(time),
        (None, Some(time)) => match time.whole() {
            Some(whole) => Ok(Duration::s(f64::from(whole) / MILLISECONDS)),
            None => expected("a whole number of milliseconds after `P`"),
        },
        (Some(_), Some(_)) | (None, None) => expected("one time after `G4`"),
    }
}

fn m<'t>(code: u32, words: &mut Block, order: &mut Order<'t>) -> Parsed<()> {
    match code {
        0 => order.does(Act::ChangeTool(None)),
        20 | 300 => order.goes(Flow::End),
        30 => order.does(Act::Spin(Some(words.must(b'S')?.value))),
        50 => order.does(Act::Spin(None)),
        60 => order.does(Act::ChangeTool(Some(words.whole(b'T')?))),
        980 => {
            let part = words.whole(b'P')?;
            match words.take(b'L').map(|times| times.value) {
                None | Some(1.0) => order.goes(Flow::Call(Routine::Number(part))),
                Some(_) => Err(ReadError::Unknown),
            }
        }
        990 => order.goes(Flow::Return),
        _ => Err(ReadError::Unknown),
    }
}
