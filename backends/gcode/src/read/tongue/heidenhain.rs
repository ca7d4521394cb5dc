//! Heidenhain TNC in Klartext.
//!
//! Every statement begins with a word. Lengths are in mm where `BEGIN PGM` says so, coordinates are absolute without an `I`
//! before their letter, and blocks with `R0` end at a standstill.

use super::{Heads, Tongue, WorkOffset, seconds, stem};
use crate::dialect::FeedMode;
use crate::read::lines::Style;
use crate::read::order::{
    Act, Context, Coordinates, Cycle, Flow, Habit, Mode, Motion, Order, Parsed, Routine, Tcp, Trouble,
    expected,
};
use crate::read::words::{Block, Cursor, Number};
use vcutc_backend_api::readback::End;

pub(super) struct Heidenhain;

/// M codes that a block may have.
const MOST_M_CODES: usize = 2;

impl Tongue for Heidenhain {
    fn style(&self) -> Style {
        Style::Numbered
    }

    fn habits(&self) -> &'static [(Habit, &'static str)] {
        &[
            (Habit::Millimetres, "BEGIN PGM ... MM"),
            (Habit::AsWritten, "M127"),
        ]
    }

    fn unsaid(&self) -> &'static [Mode] {
        &[Mode::Habit(Habit::Absolute), Mode::Stop(Some(End::Exact))]
    }

    fn work_offset(&self) -> WorkOffset {
        WorkOffset::Preset
    }

    fn exact(&self) -> &'static str {
        "R0"
    }

    fn heads(&self) -> Heads {
        Heads::All
    }

    fn endings(&self) -> [&'static str; 2] {
        ["M30", "END PGM"]
    }

    fn routine<'t>(&self, file: &'t str, _: &'t str) -> Option<Routine<'t>> {
        Some(Routine::Name(stem(file)))
    }

    fn order<'t>(&self, code: &'t str, context: Context<'_>) -> Parsed<Order<'t>> {
        let mut cursor = Cursor::new(code, self.style());
        if cursor.word("L") {
            let order = Order {
                motion: Some(Motion::AtFeed),
                ..Order::default()
            };
            return line(&mut cursor, order, context);
        }
        // The second line of a cycle begins with a parameter.
        if cursor.word("Q339") {
            return preset(&mut cursor);
        }
        // A block of M codes alone has no word of its own.
        if cursor.letters_ahead() == 1 && code.starts_with(['M', 'm']) {
            return line(&mut cursor, Order::default(), context);
        }
        let order = if cursor.word("FUNCTION") {
            function(&mut cursor)?
        } else if cursor.word("BEGIN") {
            begin(&mut cursor)?
        } else if cursor.word("END") {
            Order::flow(Flow::Close(program(&mut cursor)?.0))
        } else if cursor.word("CALL") {
            call(&mut cursor)?
        } else if cursor.word("TOOL") {
            tool_call(&mut cursor)?
        } else if cursor.word("CYCL") {
            cycle(&mut cursor)?
        } else if cursor.word("FN") {
            await_input(&mut cursor)?
        } else {
            return Err(Trouble::Unknown);
        };
        match cursor.peek() {
            None => Ok(order),
            Some(_) => Err(Trouble::Unknown),
        }
    }
}

/// What follows `L`, or a block of M codes.
fn line<'t>(cursor: &mut Cursor<'_>, mut order: Order<'t>, context: Context<'_>) -> Parsed<Order<'t>> {
    let mut words = Block::default();
    while cursor.peek().is_some() {
        if cursor.word("FMAX") {
            order.motion = order.motion.map(|_| Motion::Rapid);
            continue;
        }
        let Some(letter) = cursor.letter() else {
            return expected("a letter with a number");
        };
        let Some(number) = cursor.number() else {
            return match letter {
                // `IX+1` is incremental, `RL` and `RR` correct for a radius, `Q` begins a variable.
                b'I' | b'R' => Err(Trouble::Unknown),
                _ => expected(format!("a number after `{}`", char::from(letter))),
            };
        };
        words.add(letter, number)?;
    }
    if words.m.count() > MOST_M_CODES {
        return expected("two M codes in a block");
    }
    for code in words.m.iter() {
        match code {
            20 | 300 => order.goes(Flow::End)?,
            910 => order.coordinates = Coordinates::Machine,
            1260 => order.set(Mode::Not(Habit::AsWritten))?,
            1270 => order.set(Mode::Habit(Habit::AsWritten))?,
            _ => return Err(Trouble::Unknown),
        }
    }
    if words.g.count() > 0 || words.take(b'R').is_some_and(|radius| radius.value != 0.0) {
        return Err(Trouble::Unknown);
    }
    words.finish(context, &mut order)?;
    Ok(order)
}

/// `FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS`, `FUNCTION RESET TCPM`.
fn function<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    if cursor.word("RESET") {
        must(cursor, &["TCPM"])?;
        // Without it F is along the way of all axes, and only positions of these are moved to.
        return Ok(Order::modes(vec![
            Mode::Tcp(Some(Tcp::Off)),
            Mode::Feed(Some(FeedMode::Tip)),
        ]));
    }
    must(cursor, &["TCPM", "F"])?;
    let mode = if cursor.word("TCP") {
        FeedMode::Tip
    } else if cursor.word("CONT") {
        FeedMode::Rotary
    } else {
        return expected("`F TCP` or `F CONT`");
    };
    must(cursor, &["AXIS", "POS", "PATHCTRL", "AXIS"])?;
    Ok(Order::modes(vec![
        Mode::Tcp(Some(Tcp::On)),
        Mode::Feed(Some(mode)),
    ]))
}

fn must(cursor: &mut Cursor<'_>, words: &[&str]) -> Parsed<()> {
    match words.iter().find(|word| !cursor.word(word)) {
        Some(missing) => expected(format!("`{missing}`")),
        None => Ok(()),
    }
}

/// `PGM NAME MM` or `PGM NAME INCH`, behind the word that begins the statement.
fn program<'t>(cursor: &mut Cursor<'t>) -> Parsed<(Routine<'t>, Mode)> {
    must(cursor, &["PGM"])?;
    let Some(name) = cursor.token() else {
        return expected("the name of the program");
    };
    let unit = if cursor.word("MM") {
        Mode::Habit(Habit::Millimetres)
    } else if cursor.word("INCH") {
        Mode::Not(Habit::Millimetres)
    } else {
        return expected("`MM`");
    };
    Ok((Routine::Name(name), unit))
}

fn begin<'t>(cursor: &mut Cursor<'t>) -> Parsed<Order<'t>> {
    let (name, unit) = program(cursor)?;
    Ok(Order {
        flow: Some(Flow::Head(name)),
        ..Order::modes(vec![unit])
    })
}

/// `CALL PGM NAME`.
fn call<'t>(cursor: &mut Cursor<'t>) -> Parsed<Order<'t>> {
    if !cursor.word("PGM") {
        return Err(Trouble::Unknown);
    }
    match cursor.token() {
        Some(name) => Ok(Order::flow(Flow::Call(Routine::Name(stem_of_part(name))))),
        None => expected("the name of a program"),
    }
}

/// A part may be called with its extension.
fn stem_of_part(name: &str) -> &str {
    let at = name.len().saturating_sub(2);
    match (name.get(..at), name.get(at..)) {
        (Some(stem), Some(".H" | ".h")) => stem,
        (_, _) => name,
    }
}

/// `TOOL CALL 1 Z`.
fn tool_call<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    must(cursor, &["CALL"])?;
    let number = cursor.number().and_then(Number::whole);
    let Some(number) = number else {
        return expected("the number of a tool");
    };
    must(cursor, &["Z"])?;
    Ok(Order::modes(vec![Mode::Tool(Some(number))]))
}

/// `CYCL DEF 9.0 DWELL TIME` and `CYCL DEF 9.1 DWELL 0.5`, or `CYCL DEF 247 DATUM SETTING ~`.
fn cycle<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    must(cursor, &["DEF"])?;
    let cycle = cursor.token();
    if cycle == Some("247") {
        must(cursor, &["DATUM", "SETTING"])?;
        cursor.must(b'~')?;
        return Ok(Order::modes(vec![Mode::Cycle(Cycle::WorkOffset)]));
    }
    must(cursor, &["DWELL"])?;
    match cycle {
        Some("9.0") => {
            must(cursor, &["TIME"])?;
            Ok(Order::modes(vec![Mode::Cycle(Cycle::Dwell)]))
        }
        Some("9.1") => match cursor.number() {
            Some(time) => Ok(Order::act(Act::CycleWait(seconds(time)?))),
            None => expected("a time in seconds"),
        },
        Some(_) | None => Err(Trouble::Unknown),
    }
}

/// `Q339=+3`, what continues `CYCL DEF 247 DATUM SETTING ~`.
fn preset<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    cursor.must(b'=')?;
    let Some(number) = cursor.number().and_then(Number::whole) else {
        return expected("the number of a preset");
    };
    cursor.end()?;
    Ok(Order::act(Act::CycleWork(number)))
}

/// `FN 20: WAIT FOR I7==1`.
fn await_input<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    let function = cursor.number().and_then(Number::whole);
    if function != Some(20) || !cursor.skip(b':') {
        return Err(Trouble::Unknown);
    }
    must(cursor, &["WAIT", "FOR"])?;
    if cursor.letter() != Some(b'I') {
        return Err(Trouble::Unknown);
    }
    let input = cursor.number().and_then(Number::whole).ok_or(Trouble::Unknown)?;
    cursor.must(b'=')?;
    cursor.must(b'=')?;
    match cursor.number().map(|state| state.value) {
        Some(1.0) => Ok(Order::act(Act::Await(input))),
        Some(_) | None => expected("`1`, for the generator's input is high when it is ready"),
    }
}
