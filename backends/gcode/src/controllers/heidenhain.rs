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
//! says that the block continues in the next line, which has no number of its own (TNC 640, Cycle Programming).
//!
//! `R0` blocks stop at corners, as exactly as the machine's tolerance says. Cycle 32 sets another tolerance, under which a chain goes
//! on, and without a value the machine's again [H-620]; for single corners in the air it is not written. M codes for outputs are the
//! builder's.
//!
//! `C` goes about the pole of `CC`, in the plane square to the axis of `TOOL CALL` [H-430]; `DR+` is counterclockwise. Every axis that
//! the block names moves along.
//!
//! Every statement begins with a word. Lengths are in mm where `BEGIN PGM` says so, coordinates are absolute without an `I`
//! before their letter, and blocks with `R0` end at a standstill.

use crate::controller::{
    Arcs, AxisPace, Changes, Codes, Controller, Facts, File, Signs, ToolNumbers, Unnumbered,
};
use crate::iso::{m_code, seconds};
use crate::statement::{
    Act, Block, Convention, Coordinates, Cursor, Cycle, FeedMode, Flow, Mode, Motion, Number, Order, Parsed,
    ReadError, Routine, Scope, Sense, Style, Tcp, expected,
};
use vcutc_backend_api::readback::{End, stem};
use vcutc_backend_api::script::{Layout, trimmed_text};
use vcutc_backend_api::units::Length;

pub(super) struct Heidenhain;

const F_TCP: &str = "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS";

const TOLERANCE: &str = "CYCL DEF 32.0 TOLERANCE";

const F_CONT: &str = "FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS";

/// M codes that a block may have.
const MOST_M_CODES: usize = 2;

const FACTS: Facts = Facts {
    name: "Heidenhain",
    extensions: ["H", "H"],
    style: Style::Numbered,
    layout: Layout {
        line_end: b"\n",
        longest_comment: 80,
        // `~` continues in the next line.
        kept_out_of_comments: b"~%",
    },
    signs: Signs::Always,
    most_decimals: 4,
    fine_decimals: 3,
    work_offsets: 9999,
    unnumbered: Unnumbered::Operators,
    feed_mode_of_tcp: Some(FeedMode::Tip),
    arcs: Arcs::AboutPole,
    straight: "L",
    before_feed: " R0",
    axis_move: ["L", " M91"],
    axis_pace: AxisPace::Path,
    still_tip: FeedMode::Rotary,
    exact: None,
    exact_word: "R0",
    // Not M13 and M14 (spindle on), M19, M30, M60 (pallet), nor M89 and above, which are the control's own.
    builders_codes: &[10..=12, 15..=18, 20..=29, 31..=59, 61..=88],
    has_spindle_words: false,
    signals: 0..=152,
    conventions: &[
        (Convention::Millimetres, "BEGIN PGM ... MM"),
        (Convention::AsWritten, "M127"),
    ],
    unsaid: &[
        Mode::Convention(Convention::Absolute),
        Mode::Stop(Some(End::Exact)),
    ],
    changes: Changes::ByTheControl,
    endings: ["M30", "END PGM"],
    ..Facts::STANDARD
};

impl Controller for Heidenhain {
    fn facts(&self) -> &'static Facts {
        &FACTS
    }

    fn opening(&self, file: File<'_>) -> Vec<String> {
        vec![format!("BEGIN PGM {} MM", file.name)]
    }

    fn setup(&self, tool: u32) -> Vec<String> {
        // M127: rotary axes go to the value that is written, not the shorter way round.
        vec![format!("TOOL CALL {tool} Z"), "M127".to_owned()]
    }

    fn tool_name(&self, tool: ToolNumbers) -> String {
        format!("tool {}", tool.number)
    }

    /// The control asks a person to put the tool in where no changer has it [H-620].
    fn change(&self, tool: ToolNumbers) -> String {
        format!("TOOL CALL {} Z", tool.number)
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

    fn spin(&self, speed: Option<u32>) -> Vec<String> {
        match speed {
            Some(speed) => vec![format!("TOOL CALL S{speed}"), "M3".to_owned()],
            None => vec!["M5".to_owned()],
        }
    }

    fn tcp_on(&self, _: Codes<'_>, _: u32) -> Vec<String> {
        vec![F_TCP.to_owned()]
    }

    fn tcp_off(&self, _: Codes<'_>) -> Vec<String> {
        vec!["FUNCTION RESET TCPM".to_owned()]
    }

    fn feed_mode(&self, mode: FeedMode) -> &'static str {
        match mode {
            FeedMode::Tip | FeedMode::InverseTime => F_TCP,
            FeedMode::Rotary => F_CONT,
        }
    }

    fn through(&self, within: Length) -> Option<Vec<String>> {
        let distance = trimmed_text(within.to_mm());
        Some(vec![TOLERANCE.to_owned(), format!("CYCL DEF 32.1 T{distance}")])
    }

    /// Without a value the tolerance is the machine's again [H-620].
    fn through_ends(&self) -> Vec<String> {
        vec![TOLERANCE.to_owned(), "CYCL DEF 32.1".to_owned()]
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![
            "CYCL DEF 9.0 DWELL TIME".to_owned(),
            format!("CYCL DEF 9.1 DWELL {seconds}"),
        ]
    }

    fn await_input(&self, input: u32, _: u32) -> Option<Vec<String>> {
        Some(vec![format!("FN 20: WAIT FOR I{input}==1")])
    }

    /// From M89 on the control's own codes say how it moves [H-620].
    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            89..=149 | 197 | 198 => Some("changes how the control moves or calls"),
            _ => m_code(code),
        }
    }

    fn routine<'t>(&self, file: &'t str, _: &'t str) -> Option<Routine<'t>> {
        Some(Routine::Name(stem(file).0))
    }

    fn order<'t>(&self, code: &'t str, scope: Scope<'_>) -> Parsed<Order<'t>> {
        let mut cursor = Cursor::new(code, FACTS.style);
        if cursor.word("L") {
            let order = Order {
                motion: Some(Motion::AtFeed),
                ..Order::default()
            };
            return line(&mut cursor, order, scope);
        }
        if cursor.word("C") {
            return line(&mut cursor, Order::default(), scope).and_then(round);
        }
        // The second line of a cycle begins with a parameter.
        if cursor.word("Q339") {
            return preset(&mut cursor);
        }
        // A block of M codes alone has no word of its own.
        if cursor.letters_ahead() == 1 && code.starts_with(['M', 'm']) {
            return line(&mut cursor, Order::default(), scope);
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
        } else if cursor.word("CC") {
            pole(&mut cursor, scope)?
        } else if cursor.word("CYCL") {
            cycle(&mut cursor)?
        } else if cursor.word("FN") {
            await_input(&mut cursor)?
        } else {
            return Err(ReadError::Unknown);
        };
        match cursor.peek() {
            None => Ok(order),
            Some(_) => Err(ReadError::Unknown),
        }
    }
}

/// What follows `L`, or a block of M codes.
fn line<'t>(cursor: &mut Cursor<'_>, mut order: Order<'t>, scope: Scope<'_>) -> Parsed<Order<'t>> {
    let mut words = Block::default();
    while cursor.peek().is_some() {
        if cursor.word("FMAX") {
            order.motion = order.motion.map(|_| Motion::Rapid);
            continue;
        }
        if cursor.word("DR") {
            order.moves(direction(cursor)?)?;
            continue;
        }
        let Some(letter) = cursor.letter() else {
            return expected("a letter with a number");
        };
        let Some(number) = cursor.number() else {
            return match letter {
                // `IX+1` is incremental, `RL` and `RR` correct for a radius, `Q` begins a variable.
                b'I' | b'R' => Err(ReadError::Unknown),
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
            30 => order.does(Act::CycleSpin)?,
            50 => order.does(Act::Spin(None))?,
            910 => order.coordinates = Coordinates::Machine,
            1260 => order.set(Mode::Not(Convention::AsWritten))?,
            1270 => order.set(Mode::Convention(Convention::AsWritten))?,
            _ => return Err(ReadError::Unknown),
        }
    }
    if words.g.count() > 0 || words.take(b'R').is_some_and(|radius| radius.value != 0.0) {
        return Err(ReadError::Unknown);
    }
    words.finish(scope, &mut order)?;
    Ok(order)
}

/// The sign after `DR`.
fn direction(cursor: &mut Cursor<'_>) -> Parsed<Motion> {
    if cursor.skip(b'+') {
        Ok(Motion::Round(Sense::Counterclockwise))
    } else if cursor.skip(b'-') {
        Ok(Motion::Round(Sense::Clockwise))
    } else {
        expected("`DR+` or `DR-`")
    }
}

/// What `C` begins: it says which way round.
fn round(order: Order<'_>) -> Parsed<Order<'_>> {
    match order.motion {
        Some(_) => Ok(order),
        None => expected("`DR+` or `DR-`"),
    }
}

/// `CC X+10 Y+20`: the pole of the arcs that follow.
fn pole<'t>(cursor: &mut Cursor<'_>, scope: Scope<'_>) -> Parsed<Order<'t>> {
    let order = line(cursor, Order::default(), scope)?;
    let at = |letter| {
        let word = scope.words.iter().find(|word| word.letter == letter)?;
        order.axes.get(word.place).copied().flatten()
    };
    let said = order.axes.iter().flatten().count();
    match (at(b'X'), at(b'Y'), said, order.feed) {
        (Some(x), Some(y), 2, None) if order.modes.is_empty() && !order.has_arc() => {
            Ok(Order::modes(vec![Mode::Pole([x, y])]))
        }
        (_, _, _, _) => expected("X and Y of the centre after `CC`"),
    }
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

/// `PGM NAME MM` or `PGM NAME INCH`, after the word that begins the statement.
fn program<'t>(cursor: &mut Cursor<'t>) -> Parsed<(Routine<'t>, Mode)> {
    must(cursor, &["PGM"])?;
    let Some(name) = cursor.token() else {
        return expected("the name of the program");
    };
    let unit = if cursor.word("MM") {
        Mode::Convention(Convention::Millimetres)
    } else if cursor.word("INCH") {
        Mode::Not(Convention::Millimetres)
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
        return Err(ReadError::Unknown);
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

/// `TOOL CALL 1 Z`, or `TOOL CALL S3000`, which changes the speed of the spindle alone.
fn tool_call<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    must(cursor, &["CALL"])?;
    if cursor.peek().is_some_and(|byte| byte.eq_ignore_ascii_case(&b'S')) {
        let _ = cursor.letter();
        return match cursor.number().and_then(Number::whole) {
            Some(speed) => Ok(Order::modes(vec![Mode::Cycle(Cycle::Speed(speed))])),
            None => expected("a whole speed after `S`"),
        };
    }
    let number = cursor.number().and_then(Number::whole);
    let Some(number) = number else {
        return expected("the number of a tool");
    };
    must(cursor, &["Z"])?;
    Ok(Order::act(Act::CallTool(number)))
}

/// `CYCL DEF 9.0 DWELL TIME` and `CYCL DEF 9.1 DWELL 0.5`, `CYCL DEF 32.0 TOLERANCE` and `CYCL DEF 32.1 T0.1`, or `CYCL DEF 247 DATUM SETTING ~`.
fn cycle<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    must(cursor, &["DEF"])?;
    let cycle = cursor.token();
    if cycle == Some("247") {
        must(cursor, &["DATUM", "SETTING"])?;
        cursor.must(b'~')?;
        return Ok(Order::modes(vec![Mode::Cycle(Cycle::WorkOffset)]));
    }
    match cycle {
        Some("9.0") => {
            must(cursor, &["DWELL", "TIME"])?;
            Ok(Order::modes(vec![Mode::Cycle(Cycle::Dwell)]))
        }
        Some("9.1") => {
            must(cursor, &["DWELL"])?;
            match cursor.number() {
                Some(time) => Ok(Order::act(Act::CycleWait(seconds(time)?))),
                None => expected("a time in seconds"),
            }
        }
        Some("32.0") => {
            must(cursor, &["TOLERANCE"])?;
            Ok(Order::modes(vec![Mode::Cycle(Cycle::Tolerance)]))
        }
        Some("32.1") => tolerance(cursor),
        Some(_) | None => Err(ReadError::Unknown),
    }
}

/// `T0.1` after `CYCL DEF 32.1`, or nothing.
fn tolerance<'t>(cursor: &mut Cursor<'_>) -> Parsed<Order<'t>> {
    if cursor.peek().is_none() {
        return Ok(Order::act(Act::CycleTolerance(None)));
    }
    let is_of_way = cursor.letter() == Some(b'T');
    match cursor.number().filter(|_| is_of_way).map(|number| number.value) {
        Some(distance) if distance > 0.0 => Ok(Order::act(Act::CycleTolerance(Some(Length::mm(distance))))),
        Some(_) | None => expected("`T` with a distance above 0"),
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
        return Err(ReadError::Unknown);
    }
    must(cursor, &["WAIT", "FOR"])?;
    if cursor.letter() != Some(b'I') {
        return Err(ReadError::Unknown);
    }
    let input = cursor
        .number()
        .and_then(Number::whole)
        .ok_or(ReadError::Unknown)?;
    cursor.must(b'=')?;
    cursor.must(b'=')?;
    match cursor.number().map(|state| state.value) {
        Some(1.0) => Ok(Order::act(Act::Await(input))),
        Some(_) | None => expected("`1`, for the generator's input is high when it is ready"),
    }
}
