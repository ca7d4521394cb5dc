//! Siemens Sinumerik 840D and ONE.
//!
//! Besides letters with numbers it has words, values behind `=`, and labels. A word that stands alone and is none of the
//! control's is the name of a part.

use super::{Heads, Tongue, WorkOffset, rounding, seconds, standard_g, stem};
use crate::read::lines::Style;
use crate::read::order::{
    Act, Context, Coordinates, Flow, Habit, Mode, Once, Order, Parsed, Routine, Tcp, Trouble, expected,
};
use crate::read::words::{Block, Cursor, Number};
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::readback::End;

pub(super) struct Sinumerik;

/// M codes that a block may have.
const MOST_M_CODES: usize = 5;

impl Tongue for Sinumerik {
    fn style(&self) -> Style {
        Style::Semicolon
    }

    fn habits(&self) -> &'static [(Habit, &'static str)] {
        &[
            (Habit::Absolute, "G90"),
            (Habit::Millimetres, "G710"),
            (Habit::ByAxes, "ORIAXES"),
            (Habit::MachineAngles, "ORIMKS"),
            (Habit::FeedOfTip, "FGROUP(X,Y,Z)"),
        ]
    }

    fn unsaid(&self) -> &'static [Mode] {
        &[]
    }

    fn work_offset(&self) -> WorkOffset {
        WorkOffset::Said
    }

    /// With `D0` the words behind `SUPA` are positions of the axes.
    fn tool_of_axis_moves(&self) -> Option<u32> {
        Some(0)
    }

    fn exact(&self) -> &'static str {
        "G60"
    }

    fn heads(&self) -> Heads {
        Heads::None
    }

    fn endings(&self) -> [&'static str; 2] {
        ["M30", "M17"]
    }

    fn routine<'t>(&self, file: &'t str, _: &'t str) -> Option<Routine<'t>> {
        Some(Routine::Name(stem(file)))
    }

    fn order<'t>(&self, code: &'t str, context: Context<'_>) -> Parsed<Order<'t>> {
        let mut cursor = Cursor::new(code, self.style());
        if cursor.peek() == Some(b'$') {
            return output(&mut cursor);
        }
        if code.contains(':') {
            return labelled(&mut cursor);
        }
        let mut order = Order::default();
        let mut words = Block::default();
        let mut rounded = None;
        while let Some(byte) = cursor.peek() {
            match cursor.letters_ahead() {
                0 if matches!(byte, b'[' | b'/' | b'$' | b'=') => return Err(Trouble::Unknown),
                0 => return expected("a word"),
                1 => address(&mut cursor, &mut words)?,
                _ => keyword(&mut cursor, &mut order, &mut rounded)?,
            }
        }
        if words.m.count() > MOST_M_CODES {
            return expected("five M codes in a block");
        }
        for code in words.g.iter() {
            g(
                code,
                &mut words,
                &mut order,
                rounded.take_if(|_| code == 6410),
                context,
            )?;
        }
        for code in words.m.iter() {
            m(code, &mut order)?;
        }
        if let Some(tool) = words.take(b'D') {
            let number = tool.whole().ok_or(Trouble::Unknown)?;
            order.set(Mode::Tool(Some(number)))?;
        }
        if rounded.is_some() {
            return expected("`G641` before `ADIS`");
        }
        words.finish(context, &mut order)?;
        Ok(order)
    }
}

/// A letter with its value: `X10`, `X=10`, `X=AC(10)`.
fn address(cursor: &mut Cursor<'_>, words: &mut Block) -> Parsed<()> {
    let Some(letter) = cursor.letter() else {
        return expected("a word");
    };
    let number = if cursor.skip(b'=') {
        assigned(cursor)?
    } else {
        cursor.number()
    };
    let Some(number) = number else {
        return expected(format!("a number after `{}`", char::from(letter)));
    };
    // `A3=0.5` is an address of its own.
    if cursor.skip(b'=') {
        return Err(Trouble::Unknown);
    }
    words.add(letter, number)
}

fn assigned(cursor: &mut Cursor<'_>) -> Parsed<Option<Number>> {
    if cursor.word("AC") {
        cursor.must(b'(')?;
        let number = cursor.number();
        cursor.must(b')')?;
        return Ok(number);
    }
    match cursor.letters_ahead() {
        0 => Ok(cursor.number()),
        // `DC`, `ACP`, `ACN`, `IC` and variables.
        _ => Err(Trouble::Unknown),
    }
}

/// A word of more letters than one.
fn keyword<'t>(cursor: &mut Cursor<'t>, order: &mut Order<'t>, rounded: &mut Option<Number>) -> Parsed<()> {
    let Some(name) = cursor.name() else {
        return expected("a word");
    };
    match name.to_ascii_uppercase().as_str() {
        "TRAORI" => switched(Tcp::On, cursor, order),
        "TRAFOOF" => switched(Tcp::Off, cursor, order),
        "ORIAXES" => order.set(Mode::Habit(Habit::ByAxes)),
        "ORIVECT" => order.set(Mode::Not(Habit::ByAxes)),
        "ORIMKS" => order.set(Mode::Habit(Habit::MachineAngles)),
        "ORIWKS" => order.set(Mode::Not(Habit::MachineAngles)),
        "FGROUP" => {
            let mode = feed_group(cursor)?;
            order.set(mode)
        }
        "SUPA" => {
            order.coordinates = Coordinates::Machine;
            Ok(())
        }
        "STOPRE" => order.does(Act::StopReading),
        "ADIS" => {
            cursor.must(b'=')?;
            match (cursor.number(), rounded.is_none()) {
                (Some(number), true) => {
                    *rounded = Some(number);
                    Ok(())
                }
                (Some(_), false) => expected("`ADIS` once in a block"),
                (None, _) => expected("a number after `ADIS=`"),
            }
        }
        "RET" => order.goes(Flow::Return),
        _ => match cursor.peek() {
            None => order.goes(Flow::Call(Routine::Name(name))),
            Some(_) => Err(Trouble::Unknown),
        },
    }
}

/// Both switches cancel the tool's corrections in part, so it has to be said again [S-840].
fn switched(tcp: Tcp, cursor: &mut Cursor<'_>, order: &mut Order<'_>) -> Parsed<()> {
    if cursor.peek() == Some(b'(') {
        return Err(Trouble::Unknown);
    }
    order.set(Mode::Tcp(Some(tcp)))?;
    order.set(Mode::Tool(None))
}

/// `FGROUP(X,Y,Z)` in any order.
fn feed_group(cursor: &mut Cursor<'_>) -> Parsed<Mode> {
    cursor.must(b'(')?;
    let mut axes = Vec::new();
    while let Some(letter) = cursor.letter() {
        if axes.len() > 8 {
            return Err(Trouble::Unknown);
        }
        axes.push(letter);
        if !cursor.skip(b',') {
            break;
        }
    }
    cursor.must(b')')?;
    axes.sort_unstable();
    Ok(if axes == *b"XYZ" {
        Mode::Habit(Habit::FeedOfTip)
    } else {
        Mode::Not(Habit::FeedOfTip)
    })
}

/// `$A_OUT[12]=1`.
fn output<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    cursor.must(b'$')?;
    if !cursor.word("A_OUT") {
        return Err(Trouble::Unknown);
    }
    let number = index(cursor)?;
    cursor.must(b'=')?;
    let state = match cursor.number().and_then(Number::whole) {
        Some(0) => Switch::Off,
        Some(1) => Switch::On,
        Some(_) => return expected("0 or 1"),
        None => return Err(Trouble::Unknown),
    };
    cursor.end()?;
    Ok(Order {
        behind_stop: Once::Yes,
        ..Order::act(Act::Switch(number, state))
    })
}

/// `[12]`.
fn index(cursor: &mut Cursor<'_>) -> Parsed<u32> {
    cursor.must(b'[')?;
    let number = cursor.number().and_then(Number::whole);
    cursor.must(b']')?;
    number.ok_or(Trouble::Unknown)
}

/// `READY1: IF $A_IN[7]==FALSE GOTOB READY1` stays in its line until the input is high. No other label is known.
fn labelled<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    let label = cursor.name().ok_or(Trouble::Unknown)?;
    if !cursor.skip(b':') || !cursor.word("IF") || !cursor.skip(b'$') || !cursor.word("A_IN") {
        return Err(Trouble::Unknown);
    }
    let input = index(cursor)?;
    if !cursor.skip(b'=') || !cursor.skip(b'=') || !cursor.word("FALSE") || !cursor.word("GOTOB") {
        return Err(Trouble::Unknown);
    }
    match cursor.name() {
        Some(to) if to.eq_ignore_ascii_case(label) => {}
        Some(_) => return expected(format!("`{label}`")),
        None => return expected("a label"),
    }
    cursor.end()?;
    Ok(Order::act(Act::Await(input)))
}

fn g(
    code: u32,
    words: &mut Block,
    order: &mut Order<'_>,
    rounded: Option<Number>,
    context: Context<'_>,
) -> Parsed<()> {
    match code {
        40 => {
            let time = seconds(words.must(b'F')?)?;
            order.does(Act::Wait(time))
        }
        90 => {
            order.exact_once = Once::Yes;
            Ok(())
        }
        // `G71` leaves speeds as they were.
        700 | 710 | 7000 => order.set(Mode::Not(Habit::Millimetres)),
        7100 => order.set(Mode::Habit(Habit::Millimetres)),
        540 | 550 | 560 | 570 => order.set(Mode::Work(code / 10 - 53)),
        5050..=5990 if code.is_multiple_of(10) => order.set(Mode::Work(code / 10 - 500)),
        600 => order.set(Mode::Stop(Some(End::Exact))),
        // The fine window of the exact stop.
        6010 => Ok(()),
        640 => order.set(Mode::Stop(None)),
        6410 => order.set(rounding(rounded, context)),
        _ if standard_g(code, order)? => Ok(()),
        _ => Err(Trouble::Unknown),
    }
}

fn m(code: u32, order: &mut Order<'_>) -> Parsed<()> {
    match code {
        20 | 300 => order.goes(Flow::End),
        170 => order.goes(Flow::Return),
        _ => Err(Trouble::Unknown),
    }
}
