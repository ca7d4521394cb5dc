//! Siemens Sinumerik 840D, 840D sl, 828D with the option, and ONE.
//!
//! `TRAORI` switches the five-axis transformation on; `ORIAXES` and `ORIMKS` make the rotary axes go straight to their values,
//! whichever of the two a machine's data asks for [S-840b]. `FGROUP` makes F the speed of the tip alone. `TRAFOOF` cancels
//! tool corrections in part, so D stands after every switch [S-840].
//!
//! No tool is selected, because the knife is in the spindle; D is one of its edges, of which a tool has nine
//! where D numbers are not managed apart from tools.
//!
//! `SUPA` suppresses all offsets for one block, and with `D0` the words are positions of the axes. Outputs
//! are written after `STOPRE`, so that they switch where they stand and not when the block is read ahead.
//!
//! `CIP` leads through the point I1, J1, K1, which is absolute under `G90` as the end is, in any plane [S-JP]. In a plane of two axes
//! arcs are `G2` and `G3`. With `ORIAXES` the rotary axes turn along with either.
//!
//! In addition to letters with numbers it has words, values after `=`, and labels. A word that stands alone
//! and does not belong to the control is the name of a part.

use crate::controller::{Arcs, Codes, Controller, Facts, File, Heads, NumberOf, ToolNumbers};
use crate::iso::{g_code, m_code, rounding, seconds};
use crate::statement::{
    Act, Block, Convention, Coordinates, Cursor, Flow, Mode, Motion, Number, Once, Order, Parsed, ReadError,
    Routine, Scope, Style, Tcp, expected,
};
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::readback::{End, stem};
use vcutc_backend_api::script::{Layout, trimmed_text};
use vcutc_backend_api::units::Length;

pub(super) struct Sinumerik;

/// M codes that a block may have.
const MOST_M_CODES: usize = 5;

const FACTS: Facts = Facts {
    name: "Sinumerik",
    extensions: ["MPF", "SPF"],
    style: Style::Semicolon,
    layout: Layout {
        line_end: b"\n",
        longest_comment: 100,
        // `;$PATH=` and the like mean something to the archive.
        kept_out_of_comments: b"$%",
    },
    longest_line: 255,
    most_tools: 9,
    number_of: NumberOf::Edge,
    tool_number_name: "D number (the edge of the tool in the spindle, not the number of a tool)",
    work_offsets: 99,
    arcs: Arcs::InAnyPlane,
    axis_move: ["SUPA G1", " D0"],
    exact: Some("G60"),
    exact_in_block: Some("G60 "),
    exact_word: "G60",
    beside_m: "HS",
    // Not M17, M19, M20, M30, M40 to M45, M70 (end, orientation, strokes, gears, axis) and M98, M99 of the ISO mode.
    builders_codes: &[10..=16, 21..=29, 31..=39, 46..=69, 71..=95, 100..=197],
    smoothing: &["SOFT", "FFWON", "FFWOF"],
    has_messages: true,
    signals: 1..=1024,
    conventions: &[
        (Convention::Absolute, "G90"),
        (Convention::Millimetres, "G710"),
        (Convention::ByAxes, "ORIAXES"),
        (Convention::MachineAngles, "ORIMKS"),
        (Convention::FeedOfTip, "FGROUP(X,Y,Z)"),
    ],
    // With `D0` the words after `SUPA` are positions of the axes.
    tool_of_axis_moves: Some(0),
    heads: Heads::None,
    endings: ["M30", "M17"],
    ..Facts::STANDARD
};

impl Controller for Sinumerik {
    fn facts(&self) -> &'static Facts {
        &FACTS
    }

    fn tool_name(&self, tool: ToolNumbers) -> String {
        let number = tool.number;
        match tool.place {
            Some(place) => format!("tool T{place}, edge D{number}"),
            None => format!("the tool in the spindle, edge D{number}"),
        }
    }

    fn opening(&self, _: File<'_>) -> Vec<String> {
        Vec::new()
    }

    fn setup(&self, _: u32) -> Vec<String> {
        vec!["G17 G40 G90 G94 G710".to_owned(), "G60 G601".to_owned()]
    }

    fn work_offset(&self, number: u32) -> Option<String> {
        match number {
            1..=4 => Some(format!("G{}", 53 + number)),
            5..=99 => Some(format!("G{}", 500 + number)),
            _ => None,
        }
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        vec![file.ending(&FACTS)]
    }

    fn call(&self, part: File<'_>) -> String {
        part.name.to_owned()
    }

    fn tcp_on(&self, _: Codes<'_>, tool: u32) -> Vec<String> {
        vec![
            "TRAORI".to_owned(),
            "ORIAXES ORIMKS".to_owned(),
            "FGROUP(X,Y,Z)".to_owned(),
            format!("D{tool}"),
        ]
    }

    fn tcp_off(&self, _: Codes<'_>) -> Vec<String> {
        vec!["TRAFOOF".to_owned()]
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
            _ => m_code(code),
        }
    }

    fn routine<'t>(&self, file: &'t str, _: &'t str) -> Option<Routine<'t>> {
        Some(Routine::Name(stem(file).0))
    }

    fn order<'t>(&self, code: &'t str, scope: Scope<'_>) -> Parsed<Order<'t>> {
        let mut cursor = Cursor::new(code, FACTS.style);
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
                0 if matches!(byte, b'[' | b'/' | b'$' | b'=') => return Err(ReadError::Unknown),
                0 => return expected("a word"),
                1 => address(&mut cursor, &mut words, &mut order)?,
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
                scope,
            )?;
        }
        for code in words.m.iter() {
            m(code, &mut words, &mut order)?;
        }
        if let Some(tool) = words.take(b'D') {
            let number = tool.whole().ok_or(ReadError::Unknown)?;
            order.set(Mode::Tool(Some(number)))?;
        }
        if rounded.is_some() {
            return expected("`G641` before `ADIS`");
        }
        words.finish(scope, &mut order)?;
        Ok(order)
    }
}

/// A letter with its value: `X10`, `X=10`, `X=AC(10)`.
fn address(cursor: &mut Cursor<'_>, words: &mut Block, order: &mut Order<'_>) -> Parsed<()> {
    let Some(letter) = cursor.letter() else {
        return expected("a word");
    };
    let of_arc = b"IJK".iter().position(|&known| known == letter);
    let number = if cursor.skip(b'=') {
        // `I=AC(10)` is the centre itself, and not the way to it.
        if of_arc.is_some() && cursor.letters_ahead() > 0 {
            return Err(ReadError::Unknown);
        }
        assigned(cursor)?
    } else {
        cursor.number()
    };
    let Some(number) = number else {
        return expected(format!("a number after `{}`", char::from(letter)));
    };
    // `A3=0.5` is an address of its own, and so is `I1=10`, a coordinate of the point of an arc.
    if cursor.skip(b'=') {
        let via = of_arc.and_then(|place| order.via.get_mut(place));
        return match (via, number.whole()) {
            (Some(via), Some(1)) => point(cursor, letter, via),
            (_, _) => Err(ReadError::Unknown),
        };
    }
    words.add(letter, number)
}

/// A coordinate of the point through which an arc leads.
fn point(cursor: &mut Cursor<'_>, letter: u8, via: &mut Option<f64>) -> Parsed<()> {
    let name = char::from(letter);
    let Some(number) = assigned(cursor)? else {
        return expected(format!("a number after `{name}1=`"));
    };
    match via.replace(number.value) {
        Some(_) => expected(format!("`{name}1` once in a block")),
        None => Ok(()),
    }
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
        _ => Err(ReadError::Unknown),
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
        "ORIAXES" => order.set(Mode::Convention(Convention::ByAxes)),
        "ORIVECT" => order.set(Mode::Not(Convention::ByAxes)),
        "ORIMKS" => order.set(Mode::Convention(Convention::MachineAngles)),
        "ORIWKS" => order.set(Mode::Not(Convention::MachineAngles)),
        "FGROUP" => {
            let mode = feed_group(cursor)?;
            order.set(mode)
        }
        "SUPA" => {
            order.coordinates = Coordinates::Machine;
            Ok(())
        }
        "CIP" => order.moves(Motion::Via),
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
            Some(_) => Err(ReadError::Unknown),
        },
    }
}

/// Both switches cancel the tool's corrections in part, so it has to be said again [S-840].
fn switched(tcp: Tcp, cursor: &mut Cursor<'_>, order: &mut Order<'_>) -> Parsed<()> {
    if cursor.peek() == Some(b'(') {
        return Err(ReadError::Unknown);
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
            return Err(ReadError::Unknown);
        }
        axes.push(letter);
        if !cursor.skip(b',') {
            break;
        }
    }
    cursor.must(b')')?;
    axes.sort_unstable();
    Ok(if axes == *b"XYZ" {
        Mode::Convention(Convention::FeedOfTip)
    } else {
        Mode::Not(Convention::FeedOfTip)
    })
}

/// `$A_OUT[12]=1`.
fn output<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    cursor.must(b'$')?;
    if !cursor.word("A_OUT") {
        return Err(ReadError::Unknown);
    }
    let number = index(cursor)?;
    cursor.must(b'=')?;
    let state = match cursor.number().and_then(Number::whole) {
        Some(0) => Switch::Off,
        Some(1) => Switch::On,
        Some(_) => return expected("0 or 1"),
        None => return Err(ReadError::Unknown),
    };
    cursor.end()?;
    Ok(Order {
        after_stop: Once::Yes,
        ..Order::act(Act::Switch(number, state))
    })
}

/// `[12]`.
fn index(cursor: &mut Cursor<'_>) -> Parsed<u32> {
    cursor.must(b'[')?;
    let number = cursor.number().and_then(Number::whole);
    cursor.must(b']')?;
    number.ok_or(ReadError::Unknown)
}

/// `READY1: IF $A_IN[7]==FALSE GOTOB READY1` stays in its line until the input is high. No other label is known.
fn labelled<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    let label = cursor.name().ok_or(ReadError::Unknown)?;
    if !cursor.skip(b':') || !cursor.word("IF") || !cursor.skip(b'$') || !cursor.word("A_IN") {
        return Err(ReadError::Unknown);
    }
    let input = index(cursor)?;
    if !cursor.skip(b'=') || !cursor.skip(b'=') || !cursor.word("FALSE") || !cursor.word("GOTOB") {
        return Err(ReadError::Unknown);
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
    scope: Scope<'_>,
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
        700 | 710 | 7000 => order.set(Mode::Not(Convention::Millimetres)),
        7100 => order.set(Mode::Convention(Convention::Millimetres)),
        540 | 550 | 560 | 570 => order.set(Mode::Work(code / 10 - 53)),
        5050..=5990 if code.is_multiple_of(10) => order.set(Mode::Work(code / 10 - 500)),
        600 => order.set(Mode::Stop(Some(End::Exact))),
        // The fine window of the exact stop.
        6010 => Ok(()),
        640 => order.set(Mode::Stop(None)),
        6410 => order.set(rounding(rounded, scope)),
        _ if g_code(code, order)? => Ok(()),
        _ => Err(ReadError::Unknown),
    }
}

fn m(code: u32, words: &mut Block, order: &mut Order<'_>) -> Parsed<()> {
    match code {
        0 => order.does(Act::ChangeTool(None)),
        30 => order.does(Act::Spin(Some(words.must(b'S')?.value))),
        50 => order.does(Act::Spin(None)),
        60 => order.does(Act::ChangeTool(Some(words.whole(b'T')?))),
        20 | 300 => order.goes(Flow::End),
        170 => order.goes(Flow::Return),
        _ => Err(ReadError::Unknown),
    }
}
