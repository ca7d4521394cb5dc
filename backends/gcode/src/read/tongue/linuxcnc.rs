//! LinuxCNC 2.9.
//!
//! What switches the kinematics is given by the job ([`codes`](crate::read::codes)), so nothing here says that the tip is
//! controlled. `G61` stops at corners only, and `M62` switches with the next motion, so neither is what is needed.

use super::{Heads, Tongue, WorkOffset, american_g, rounding, seconds};
use crate::read::lines::Style;
use crate::read::order::{
    Act, Context, Coordinates, Cycle, Flow, Habit, Mode, Order, Parsed, Routine, Trouble, expected,
};
use crate::read::words::{Block, Cursor, block};
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::readback::{End, essence};

pub(super) struct LinuxCnc;

/// The loop around a wait may be carried out once a day, or more seldom: in s.
const LONG: f64 = 86_400.0;

/// What the name of such a loop begins with.
const READY: &str = "ready";

/// `M66` waits until the input is high.
const HIGH: u32 = 3;

/// What the files of parts end with.
const EXTENSION: &str = ".ngc";

impl Tongue for LinuxCnc {
    fn style(&self) -> Style {
        Style::Brackets
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
        "G61.1"
    }

    fn heads(&self) -> Heads {
        Heads::OfParts
    }

    fn endings(&self) -> [&'static str; 2] {
        ["M2", "endsub"]
    }

    /// The control looks for the name in small letters, whichever the call has [L-MC], on a disk that tells them apart.
    fn routine<'t>(&self, file: &'t str, _: &'t str) -> Option<Routine<'t>> {
        let name = file.strip_suffix(EXTENSION)?;
        let is_found = !name.bytes().any(|byte| byte.is_ascii_uppercase());
        is_found.then_some(Routine::Name(name))
    }

    fn callable(&self, routine: Routine<'_>) -> String {
        match routine {
            Routine::Name(name) => format!(
                "the name of a part, called once, in the file `{}{EXTENSION}`",
                name.to_ascii_lowercase()
            ),
            Routine::Number(number) => format!("the name of a part and not {number}"),
        }
    }

    fn order<'t>(&self, code: &'t str, context: Context<'_>) -> Parsed<Order<'t>> {
        if code == "%" {
            return Ok(Order::flow(Flow::Tape));
        }
        if code.starts_with(['o', 'O']) {
            return o_word(code);
        }
        let mut order = Order::default();
        let mut words = block(code, self.style())?;
        for code in words.g.iter() {
            g(code, &mut words, &mut order, context)?;
        }
        for code in words.m.iter() {
            m(code, &mut words, &mut order)?;
        }
        words.finish(context, &mut order)?;
        Ok(order)
    }
}

/// `o<name> sub`, `o<name> endsub`, `o<name> call`; `o<ready1> do` and `o<ready1> while [#5399 LT 0]`.
fn o_word(code: &str) -> Parsed<Order<'_>> {
    let mut cursor = Cursor::new(code, Style::Brackets);
    cursor.letter();
    if !cursor.skip(b'<') {
        return Err(Trouble::Unknown);
    }
    let Some(name) = cursor.name() else {
        return expected("a name after `o<`");
    };
    cursor.must(b'>')?;
    if let Some(number) = name.strip_prefix(READY).and_then(|number| number.parse().ok()) {
        let rest = essence(cursor.rest());
        return match rest.as_str() {
            "DO" => Ok(Order::modes(vec![Mode::Cycle(Cycle::Loop(number))])),
            "WHILE[#5399 LT 0]" => Ok(Order::act(Act::LoopEnds(number))),
            _ => Err(Trouble::Unknown),
        };
    }
    let flow = if cursor.word("sub") {
        Flow::PartHead(Routine::Name(name))
    } else if cursor.word("endsub") {
        Flow::ReturnFrom(Routine::Name(name))
    } else if cursor.word("call") {
        Flow::Call(Routine::Name(name))
    } else {
        return Err(Trouble::Unknown);
    };
    match cursor.peek() {
        None => Ok(Order::flow(flow)),
        Some(_) => Err(Trouble::Unknown),
    }
}

fn g(code: u32, words: &mut Block, order: &mut Order<'_>, context: Context<'_>) -> Parsed<()> {
    match code {
        40 => order.does(Act::Wait(seconds(words.must(b'P')?)?)),
        430 => order.set(Mode::Tool(Some(words.whole(b'H')?))),
        490 => order.set(Mode::Tool(Some(0))),
        530 => {
            order.coordinates = Coordinates::Machine;
            Ok(())
        }
        540 | 550 | 560 | 570 | 580 | 590 => order.set(Mode::Work(code / 10 - 53)),
        591..=593 => order.set(Mode::Work(code - 584)),
        611 => order.set(Mode::Stop(Some(End::Exact))),
        610 => order.set(Mode::Stop(None)),
        640 => {
            let mode = rounding(words.take(b'P'), context);
            // Without `Q0` points that lie near a line are dropped as well.
            let keeps_all = words.take(b'Q').is_some_and(|dropped| dropped.value == 0.0);
            order.set(if keeps_all { mode } else { Mode::Stop(None) })
        }
        _ => known(american_g(code, order)?),
    }
}

fn m(code: u32, words: &mut Block, order: &mut Order<'_>) -> Parsed<()> {
    match code {
        20 | 300 => order.goes(Flow::End),
        640 => order.does(Act::Switch(words.whole(b'P')?, Switch::On)),
        650 => order.does(Act::Switch(words.whole(b'P')?, Switch::Off)),
        660 => {
            let input = words.whole(b'P')?;
            if words.whole(b'L')? != HIGH {
                return expected("`L3`, which waits until the input is high");
            }
            if words.must(b'Q')?.value < LONG {
                return expected("`Q86400`");
            }
            order.does(Act::LoopWait(input))
        }
        _ => Err(Trouble::Unknown),
    }
}

fn known(is: bool) -> Parsed<()> {
    if is { Ok(()) } else { Err(Trouble::Unknown) }
}
