//! Fanuc 30i, 31i, 32i and 0i-MF.
//!
//! A coordinate without a point may be read in thousandths of a mm, as a parameter says [F-30], so it is refused. One M code is
//! what a block may have without other parameters. `;` is the end of a block, as the screen shows it, and no comment.

use super::{Heads, Tongue, WorkOffset, american_g, seconds};
use crate::read::lines::{self, Code, Style};
use crate::read::order::{
    Act, Context, Coordinates, Flow, Habit, Mode, Once, Order, Parsed, Routine, Tcp, Trouble, expected,
};
use crate::read::words::{Block, Cursor, Number, Point, block};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::units::Duration;

pub(super) struct Fanuc;

const MILLISECONDS: f64 = 1000.0;

impl Tongue for Fanuc {
    fn style(&self) -> Style {
        Style::Blocks
    }

    fn habits(&self) -> &'static [(Habit, &'static str)] {
        &[(Habit::Absolute, "G90"), (Habit::Millimetres, "G21")]
    }

    fn unsaid(&self) -> &'static [Mode] {
        &[]
    }

    fn work_offset(&self) -> WorkOffset {
        WorkOffset::Said
    }

    fn exact(&self) -> &'static str {
        "G61"
    }

    fn heads(&self) -> Heads {
        Heads::All
    }

    fn endings(&self) -> [&'static str; 2] {
        ["M30", "M99"]
    }

    /// The number behind O, which is the first statement but for `%`.
    fn routine<'t>(&self, _: &'t str, text: &'t str) -> Option<Routine<'t>> {
        let mut at = 0;
        while let Some((line, next)) = lines::line(text, at) {
            match self.style().code(line, at) {
                Code::None => {}
                Code::Is(_, "%") => {}
                Code::Is(_, code) => return head(code),
                Code::Broken(..) | Code::Active(_) => return None,
            }
            at = next;
        }
        None
    }

    fn order<'t>(&self, code: &'t str, context: Context<'_>) -> Parsed<Order<'t>> {
        if code == "%" {
            return Ok(Order::flow(Flow::Tape));
        }
        if let Some(routine) = head(code) {
            return Ok(Order::flow(Flow::Head(routine)));
        }
        let mut order = Order::default();
        let mut words = block(code, self.style())?;
        if words.m.count() > 1 {
            return expected("one M code in a block");
        }
        for code in words.g.iter() {
            g(code, &mut words, &mut order)?;
        }
        for code in words.m.iter() {
            m(code, &mut words, &mut order)?;
        }
        let without = context.words.iter().find(|word| words.lacks_a_point(word.letter));
        if let Some(word) = without {
            return expected(format!(
                "a number with a point after `{}`",
                char::from(word.letter)
            ));
        }
        words.finish(context, &mut order)?;
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
        530 => {
            order.coordinates = Coordinates::Machine;
            Ok(())
        }
        540 | 550 | 560 | 570 | 580 | 590 => order.set(Mode::Work(code / 10 - 53)),
        541 => {
            let more = words.whole(b'P')?;
            order.set(Mode::Work(more.saturating_add(6)))
        }
        610 => order.set(Mode::Stop(Some(End::Exact))),
        // How far is a matter of parameters.
        640 => order.set(Mode::Stop(None)),
        _ if american_g(code, order)? => Ok(()),
        _ => Err(Trouble::Unknown),
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
        20 | 300 => order.goes(Flow::End),
        980 => {
            let part = words.whole(b'P')?;
            match words.take(b'L').map(|times| times.value) {
                None | Some(1.0) => order.goes(Flow::Call(Routine::Number(part))),
                Some(_) => Err(Trouble::Unknown),
            }
        }
        990 => order.goes(Flow::Return),
        _ => Err(Trouble::Unknown),
    }
}
