//! LinuxCNC 2.9.
//!
//! Tool-centre-point control is a property of the kinematics module: while one is active that is not the identity, X, Y, Z are
//! those of the tip. Which M codes switch between the two depends on the configuration (in the sample
//! configurations M428 and M429, in either order), so the job has to say them [L-SW, L-BC]. The kinematics
//! takes the tool offset at hand for the tool's length, so the offset changes only while the identity is
//! active: `G43` stands before the switch and `G49` after the switch back, for otherwise the axes would have
//! to jump.
//!
//! `G53` moves in machine coordinates with `G0` and `G1`, without the tool offset; with inverse time the whole block takes the
//! time that F says. `M64` and `M65` wait for the motion before them. `M66` gives up after the time Q, with -1 in `#5399`, and goes
//! on; so it is in a loop that waits again.
//!
//! I, J and K of an arc count from its start under `G91.1`, which a program before may have changed. F is the speed along the arc in
//! X, Y and Z, and the rotary axes turn in proportion to it [L-GC].
//!
//! Checked with the interpreter of LinuxCNC 2.9.
//!
//! What switches the kinematics is given by the job ([`codes`](crate::read)), so nothing here says that the tip is
//! controlled. `G61` stops at corners only, and `M62` switches with the next motion, so neither is what is needed.

use crate::controller::{Codes, Controller, Facts, File, Heads, Letters, TcpCodes};
use crate::iso::{american_g_code, m_code, rounding, seconds};
use crate::statement::{
    Act, Block, Convention, Cursor, Cycle, Flow, Mode, Order, Parsed, ReadError, Routine, Scope, Style,
    block, expected,
};
use vcutc_backend_api::ir::Switch;
use vcutc_backend_api::readback::{End, normalized};
use vcutc_backend_api::script::{Layout, trimmed_text};
use vcutc_backend_api::units::Length;

pub(super) struct LinuxCnc;

/// The loop around a wait may be carried out once a day, or more seldom: in s.
const LONG: f64 = 86_400.0;

/// What the name of such a loop begins with.
const READY: &str = "ready";

/// `M66` waits until the input is high.
const HIGH: u32 = 3;

/// What the files of parts end with.
const EXTENSION: &str = ".ngc";

const FACTS: Facts = Facts {
    name: "LinuxCNC",
    extensions: ["ngc", "ngc"],
    layout: Layout {
        line_end: b"\n",
        longest_comment: 100,
        // Parentheses end a comment, and `%` at the start of a line would end the program.
        kept_out_of_comments: b"()%",
    },
    // Names of subroutines are looked for in small letters [L-MC].
    name_letters: Letters::Small,
    longest_line: 255,
    work_offsets: 9,
    tcp_codes: TcpCodes::Given,
    centres_from_start: Some("G91.1"),
    exact: Some("G61.1"),
    exact_in_block: Some("G61.1 "),
    exact_word: "G61.1",
    // `M68 E3 Q1` and `M66 E0 L0` are in the sample configurations.
    beside_m: "ELPQS",
    // M100 to M199 run what the integrator wrote.
    example_codes: ["M101", "M102", "M103"],
    // M100 to M199 run programs of the builder's [L-MC].
    builders_codes: &[100..=199],
    signals: 0..=63,
    conventions: &[
        (Convention::Absolute, "G90"),
        (Convention::Millimetres, "G21"),
        (Convention::CentresFromStart, "G91.1"),
    ],
    heads: Heads::OfParts,
    endings: ["M2", "endsub"],
    ..Facts::STANDARD
};

impl Controller for LinuxCnc {
    fn facts(&self) -> &'static Facts {
        &FACTS
    }

    fn opening(&self, file: File<'_>) -> Vec<String> {
        match file.place {
            0 => Vec::new(),
            _ => vec![format!("o<{}> sub", file.name)],
        }
    }

    fn setup(&self, _: u32) -> Vec<String> {
        vec!["G17 G21 G40 G80 G90 G94".to_owned(), "G61.1".to_owned()]
    }

    fn work_offset(&self, number: u32) -> Option<String> {
        match number {
            1..=6 => Some(format!("G{}", 53 + number)),
            7..=9 => Some(format!("G59.{}", number - 6)),
            _ => None,
        }
    }

    fn closing(&self, file: File<'_>) -> Vec<String> {
        match file.place {
            0 => vec!["M2".to_owned()],
            _ => vec![format!("o<{}> endsub", file.name), "M2".to_owned()],
        }
    }

    fn call(&self, part: File<'_>) -> String {
        format!("o<{}> call", part.name)
    }

    fn tcp_on(&self, codes: Codes<'_>, tool: u32) -> Vec<String> {
        let mut lines = vec![format!("G43 H{tool}")];
        lines.extend_from_slice(codes.tcp_on);
        lines
    }

    fn tcp_off(&self, codes: Codes<'_>) -> Vec<String> {
        let mut lines = codes.tcp_off.to_vec();
        lines.push("G49".to_owned());
        lines
    }

    /// Without Q the interpreter would also drop points that lie within P of a line.
    fn rounded(&self, approximation: Length) -> Option<String> {
        Some(format!("G64 P{} Q0", trimmed_text(approximation.to_mm())))
    }

    fn dwell(&self, seconds: &str) -> Vec<String> {
        vec![format!("G4 P{seconds}")]
    }

    fn switch(&self, output: u32, state: Switch) -> Option<Vec<String>> {
        let code = match state {
            Switch::On => "M64",
            Switch::Off => "M65",
        };
        Some(vec![format!("{code} P{output}")])
    }

    /// After the time Q the interpreter would go on, with -1 in `#5399` [L-MC]; then the wait begins again.
    fn await_input(&self, input: u32, label: u32) -> Option<Vec<String>> {
        Some(vec![
            format!("o<ready{label}> do"),
            format!("M66 P{input} L3 Q86400"),
            format!("o<ready{label}> while [#5399 LT 0]"),
        ])
    }

    /// [L-MC].
    fn does_by_m(&self, code: u32) -> Option<&'static str> {
        match code {
            48..=53 => Some("switches the overrides"),
            60 => Some("stops the program"),
            61 => Some("changes the tool"),
            62 | 63 | 67 => Some("switches with the next motion"),
            70..=73 => Some("saves modes or brings them back"),
            _ => m_code(code),
        }
    }

    /// The control looks for the name in small letters, whichever the call has [L-MC], on a disk that
    /// distinguishes them.
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

    fn order<'t>(&self, code: &'t str, scope: Scope<'_>) -> Parsed<Order<'t>> {
        if code == "%" {
            return Ok(Order::flow(Flow::Tape));
        }
        if code.starts_with(['o', 'O']) {
            return o_word(code);
        }
        let mut order = Order::default();
        let mut words = block(code, FACTS.style)?;
        for code in words.g.iter() {
            g(code, &mut words, &mut order, scope)?;
        }
        for code in words.m.iter() {
            m(code, &mut words, &mut order)?;
        }
        words.finish(scope, &mut order)?;
        Ok(order)
    }
}

/// `o<name> sub`, `o<name> endsub`, `o<name> call`; `o<ready1> do` and `o<ready1> while [#5399 LT 0]`.
fn o_word(code: &str) -> Parsed<Order<'_>> {
    let mut cursor = Cursor::new(code, Style::Brackets);
    cursor.letter();
    if !cursor.skip(b'<') {
        return Err(ReadError::Unknown);
    }
    let Some(name) = cursor.name() else {
        return expected("a name after `o<`");
    };
    cursor.must(b'>')?;
    if let Some(number) = name.strip_prefix(READY).and_then(|number| number.parse().ok()) {
        let rest = normalized(cursor.rest());
        return match rest.as_str() {
            "DO" => Ok(Order::modes(vec![Mode::Cycle(Cycle::Loop(number))])),
            "WHILE[#5399 LT 0]" => Ok(Order::act(Act::LoopEnds(number))),
            _ => Err(ReadError::Unknown),
        };
    }
    let flow = if cursor.word("sub") {
        Flow::PartHead(Routine::Name(name))
    } else if cursor.word("endsub") {
        Flow::ReturnFrom(Routine::Name(name))
    } else if cursor.word("call") {
        Flow::Call(Routine::Name(name))
    } else {
        return Err(ReadError::Unknown);
    };
    match cursor.peek() {
        None => Ok(Order::flow(flow)),
        Some(_) => Err(ReadError::Unknown),
    }
}

fn g(code: u32, words: &mut Block, order: &mut Order<'_>, scope: Scope<'_>) -> Parsed<()> {
    match code {
        40 => order.does(Act::Wait(seconds(words.must(b'P')?)?)),
        430 => order.set(Mode::Tool(Some(words.whole(b'H')?))),
        490 => order.set(Mode::Tool(Some(0))),
        591..=593 => order.set(Mode::Work(code - 584)),
        901 => order.set(Mode::Not(Convention::CentresFromStart)),
        911 => order.set(Mode::Convention(Convention::CentresFromStart)),
        611 => order.set(Mode::Stop(Some(End::Exact))),
        610 => order.set(Mode::Stop(None)),
        640 => {
            let mode = rounding(words.take(b'P'), scope);
            // Without `Q0` points that lie near a line are dropped as well.
            let keeps_all = words.take(b'Q').is_some_and(|dropped| dropped.value == 0.0);
            order.set(if keeps_all { mode } else { Mode::Stop(None) })
        }
        _ if american_g_code(code, order)? => Ok(()),
        _ => Err(ReadError::Unknown),
    }
}

fn m(code: u32, words: &mut Block, order: &mut Order<'_>) -> Parsed<()> {
    match code {
        0 => order.does(Act::ChangeTool(None)),
        20 | 300 => order.goes(Flow::End),
        30 => order.does(Act::Spin(Some(words.must(b'S')?.value))),
        50 => order.does(Act::Spin(None)),
        60 => order.does(Act::ChangeTool(Some(words.whole(b'T')?))),
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
        _ => Err(ReadError::Unknown),
    }
}
