//! Whatever stands in the files, the compiler ends, and ends with a program or with reasons why there is none.
//!
//! No test here has a clock: one that took too long would hang the suite, and that shows.

use crate::pipeline::{Files, all_diagnostics, compile, emit, numbers, rendered};
use crate::repository::{files, read};
use proptest::prelude::*;
use proptest::sample::Index;
use std::fmt::Write;
use vcutc::diagnostics::{Code, has_errors};

const JOB: &str = "job.vcut";

/// Takes a job through everything, messages included; gives the codes of its diagnostics.
fn survive(files: &Files) -> Vec<&'static str> {
    let outcome = compile(JOB, files);
    let diagnostics = all_diagnostics(&outcome);
    let messages = rendered(&diagnostics, &outcome);
    assert_eq!(messages.is_empty(), diagnostics.is_empty());
    let has_program = outcome.compiled.is_some() && emit(&outcome).is_ok();
    assert_ne!(has_program, has_errors(&diagnostics), "{messages}");
    let numbers = numbers(&diagnostics);
    let internal = Code::Internal.number();
    assert!(!numbers.contains(&internal), "{messages}");
    assert!(!numbers.contains(&Code::Overcut.number()), "{messages}");
    numbers
}

fn survive_text(text: impl Into<Vec<u8>>) -> Vec<&'static str> {
    survive(&library().with(JOB, text))
}

/// The files that examples use.
fn library() -> Files {
    let mut library = Files::default();
    for name in [
        "shop/blades.vcut",
        "shop/cells.vcut",
        "shop/speeds.vcut",
        "points/imprint.csv",
    ] {
        library = library.with(name, read(&format!("examples/{name}")));
    }
    library
}

/// A small sound job to change in one place.
fn sound() -> String {
    read("tests/jobs/two_operations/job.vcut").replace(
        "use \"blades.vcut\"",
        &read("tests/jobs/two_operations/blades.vcut"),
    )
}

/// The examples and the jobs of this folder, without the long ones.
fn seeds() -> Vec<String> {
    let mut seeds: Vec<String> = files("tests/jobs", "job.vcut")
        .into_iter()
        .map(|file| file.text)
        .collect();
    for name in ["block_cui", "broken", "imprint", "wavy_panel", "too_deep"] {
        seeds.push(read(&format!("examples/{name}.vcut")));
    }
    seeds
}

/// A change of a text.
#[derive(Clone, Debug)]
enum Change {
    DropLine(Index),
    DoubleLine(Index),
    SwapLines(Index, Index),
    DropByte(Index),
    SetByte(Index, u8),
    Cut(Index),
    /// A number, by its place among all numbers.
    SetNumber(Index, &'static str),
    /// A word takes the place of another.
    SwapWords(Index, Index),
}

fn a_change() -> impl Strategy<Value = Change> {
    let index = any::<Index>;
    let numbers = [
        "0", "-1", "1e308", "1e-308", "0.001", "89.999", "90", "180", "1e9", "(0/0)", "99999", "1/3",
        "2^0.5", "auto",
    ];
    prop_oneof![
        index().prop_map(Change::DropLine),
        index().prop_map(Change::DoubleLine),
        (index(), index()).prop_map(|(a, b)| Change::SwapLines(a, b)),
        index().prop_map(Change::DropByte),
        (index(), any::<u8>()).prop_map(|(at, byte)| Change::SetByte(at, byte)),
        index().prop_map(Change::Cut),
        (index(), prop::sample::select(numbers.to_vec())).prop_map(|(at, text)| Change::SetNumber(at, text)),
        (index(), prop::sample::select(numbers.to_vec())).prop_map(|(at, text)| Change::SetNumber(at, text)),
        (index(), index()).prop_map(|(a, b)| Change::SwapWords(a, b)),
    ]
}

fn make(change: &Change, text: Vec<u8>) -> Vec<u8> {
    if text.is_empty() {
        return text;
    }
    let by_lines = |edit: &dyn Fn(&mut Vec<&[u8]>)| {
        let mut lines: Vec<&[u8]> = text.split_inclusive(|&byte| byte == b'\n').collect();
        edit(&mut lines);
        lines.concat()
    };
    match change {
        Change::DropLine(at) => by_lines(&|lines| {
            lines.remove(at.index(lines.len()));
        }),
        Change::DoubleLine(at) => by_lines(&|lines| {
            let at = at.index(lines.len());
            lines.insert(at, lines[at]);
        }),
        Change::SwapLines(a, b) => by_lines(&|lines| {
            let count = lines.len();
            lines.swap(a.index(count), b.index(count));
        }),
        Change::DropByte(at) => {
            let mut text = text;
            text.remove(at.index(text.len()));
            text
        }
        Change::SetByte(at, byte) => {
            let mut text = text;
            let at = at.index(text.len());
            text[at] = *byte;
            text
        }
        Change::Cut(at) => text[..at.index(text.len())].to_vec(),
        Change::SetNumber(at, number) => {
            let pieces = pieces(&text, |byte| byte.is_ascii_digit() || byte == b'.');
            swap_piece(&pieces, at, |piece| piece[0].is_ascii_digit(), number.as_bytes())
        }
        Change::SwapWords(a, b) => {
            let pieces = pieces(&text, |byte| byte.is_ascii_alphabetic() || byte == b'_');
            let words: Vec<&[u8]> = pieces
                .iter()
                .copied()
                .filter(|piece| piece[0].is_ascii_alphabetic())
                .collect();
            let word = if words.is_empty() {
                b"a".as_slice()
            } else {
                words[b.index(words.len())]
            };
            swap_piece(&pieces, a, |piece| piece[0].is_ascii_alphabetic(), word)
        }
    }
}

/// A text in pieces that are, in turn, of a kind of bytes and of other bytes.
fn pieces(text: &[u8], is_kind: impl Fn(u8) -> bool) -> Vec<&[u8]> {
    text.chunk_by(|&a, &b| is_kind(a) == is_kind(b)).collect()
}

fn swap_piece(pieces: &[&[u8]], at: &Index, is_wanted: impl Fn(&[u8]) -> bool, by: &[u8]) -> Vec<u8> {
    let places: Vec<usize> = (0..pieces.len())
        .filter(|&place| is_wanted(pieces[place]))
        .collect();
    let mut pieces = pieces.to_vec();
    if !places.is_empty() {
        pieces[places[at.index(places.len())]] = by;
    }
    pieces.concat()
}

fn a_token() -> impl Strategy<Value = String> {
    let words = [
        "job", "use", "let", "stock", "profile", "blade", "rough", "vcut", "machine", "robot", "start",
        "line", "to", "arc", "bezier", "spline", "polyline", "points", "airfoil", "radius", "center", "tips",
        "surface", "mesh", "grid", "step", "loft", "nurbs", "row", "degree", "at", "y", ",", "through", "z",
        "x", "size", "feed", "limits", "swing", "layer", "auto", "frame", "joints", "output", "number",
        "krl", "mm", "deg", "s", "(", ")", "{", "}", "=", "<=", ",", "+", "-", "*", "/", "^", "\"", "//",
        "\n", "0", "1", "85", "1e308", "\u{fffd}",
    ];
    prop::sample::select(words.to_vec()).prop_map(str::to_owned)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(160))]

    #[test]
    fn bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        survive_text(bytes);
    }

    #[test]
    fn tokens(tokens in prop::collection::vec(a_token(), 0..120)) {
        survive_text(tokens.join(" "));
    }

    #[test]
    fn changed_jobs(seed in any::<Index>(), changes in prop::collection::vec(a_change(), 1..5)) {
        let seeds = seeds();
        let text = seeds[seed.index(seeds.len())].clone().into_bytes();
        survive_text(changes.iter().fold(text, |text, change| make(change, text)));
    }
}

#[test]
fn deep_nesting() {
    for (open, close) in [
        ("(", ")"),
        ("-", ""),
        ("abs(", ")"),
        ("2^", ""),
        ("1+", ""),
        ("(1 mm, ", ")"),
    ] {
        let text = format!(
            "{}let a = {}1{}\n",
            sound(),
            open.repeat(30_000),
            close.repeat(30_000)
        );
        survive_text(text);
    }
    let blocks = format!("{}{}", "a { ".repeat(30_000), "} ".repeat(30_000));
    survive_text(blocks);
    let mut lets = String::new();
    for number in 0..20_000 {
        writeln!(lets, "let a{number} = a{} + 1 mm", number + 1).unwrap();
    }
    survive_text(sound() + &lets);
    survive_text(sound() + &lets + "let a20000 = 1 mm\n");
}

/// Every field of a sound job takes every one of these values, one at a time.
#[test]
fn absurd_values() {
    let values = [
        "0 mm",
        "-1 mm",
        "1e308 mm",
        "1e-308 mm",
        "1e-100 mm",
        "1 um",
        "100 m",
        "0 deg",
        "-30 deg",
        "89.9999 deg",
        "90 deg",
        "1e300 deg",
        "1e-9 deg",
        "1e-100 deg",
        "1e-308 deg",
        "(0 mm / 0)",
        "1 mm / 0",
        "1 / 0",
        "sqrt(-1)",
        "0 / 0",
        "1e308 * 10",
        "1e308 mm/s",
        "1e-300 mm/s",
        "1e-9 deg/s",
        "auto",
        "100 %",
        "99.9999 %",
        "\"\"",
        "()",
    ];
    let sound = sound();
    let lines: Vec<&str> = sound.lines().collect();
    for (place, line) in lines.iter().enumerate() {
        let Some((name, _)) = line
            .split_once('=')
            .filter(|_| line.starts_with("  ") && !line.contains('{'))
        else {
            continue;
        };
        for value in values {
            let changed = format!("{name}= {value}");
            let mut lines = lines.clone();
            lines[place] = &changed;
            survive_text(lines.join("\n") + "\n");
        }
    }
}

/// A V of almost no width has no extension that could be stated.
#[test]
fn swings_of_next_to_nothing_are_out_of_range() {
    let sound = sound();
    assert!(sound.contains("swing     = 45 deg"), "{sound}");
    for swing in ["1e-308 deg", "1e-100 deg", "0.0009 deg"] {
        let text = sound.replacen("swing     = 45 deg", &format!("swing     = {swing}"), 1);
        assert_eq!(survive_text(text), ["VC0210"], "{swing}");
    }
    survive_text(sound.replacen("swing     = 45 deg", "swing     = 0.001 deg", 1));
}

#[test]
fn absurd_sizes() {
    let sound = sound();
    let stock = "(30 mm, 20 mm, 18 mm)";
    for size in [
        "(100 m, 100 m, 100 m)",
        "(100 m, 20 mm, 18 mm)",
        "(30 mm, 20 mm, 100 m)",
        "(1 um, 1 um, 1 um)",
        "(30 mm, 20 mm, 5.0001 mm)",
        "(1e308 mm, 1e308 mm, 1e308 mm)",
    ] {
        for layer in ["6 mm", "1 um", "auto", "100 m", "1e-300 mm"] {
            let text = sound
                .replace(stock, size)
                .replace("layer     = 6 mm", &format!("layer     = {layer}"));
            let text = text.replace("arc   to (30 mm, 5 mm) radius 60 mm", "line to (100 m, 5 mm)");
            survive_text(text);
        }
    }
}

#[test]
fn files_that_are_missing_or_use_each_other() {
    let using = |path: &str| format!("use \"{path}\"\n{}", sound());
    assert_eq!(survive_text(using("nowhere.vcut")), ["VC0212"]);
    assert_eq!(survive_text(using("../../../../../..")), ["VC0212"]);
    assert_eq!(survive_text(using(JOB)), ["VC0211"]);
    let ring = library()
        .with(JOB, using("a.vcut"))
        .with("a.vcut", "use \"b.vcut\"")
        .with("b.vcut", "use \"a.vcut\"");
    assert_eq!(survive(&ring), ["VC0211"]);
    let bytes = library()
        .with(JOB, using("a.vcut"))
        .with("a.vcut", [0xff, 0xfe, 0x00]);
    assert_eq!(survive(&bytes), ["VC0107"]);
    let mut chain = library().with(JOB, using("f0.vcut"));
    for number in 0..2000 {
        let next = format!("use \"f{}.vcut\"\n", number + 1);
        chain = chain.with(&format!("f{number}.vcut"), next);
    }
    survive(&chain);
    // Each file uses the next one twice: read once each, not 2^30 times.
    let mut fan = library().with(JOB, using("g0.vcut"));
    for number in 0..30 {
        let next = format!("use \"g{0}.vcut\"\nuse \"./g{0}.vcut\"\n", number + 1);
        fan = fan.with(&format!("g{number}.vcut"), next);
    }
    survive(&fan.with("g30.vcut", ""));
}

/// A job whose profile comes from a file of points.
fn with_points(text: impl Into<Vec<u8>>) -> Vec<&'static str> {
    let profile = "  start (0 mm, 5 mm)\n  arc   to (30 mm, 5 mm) radius 60 mm\n";
    let job = sound().replace(profile, "  points \"points.csv\"\n");
    assert_ne!(job, sound());
    survive(&library().with(JOB, job).with("points.csv", text))
}

#[test]
fn files_of_points() {
    let refused: [&[u8]; 9] = [
        b"",
        b"0,5\n",
        b"0,NaN\n30,5\n",
        b"0,5\n30,inf\n",
        b"0,5\n30,1e999\n",
        b"0,5\n10,6\n10,9\n30,5\n",
        b"\xff\xfe\x00",
        b"0;5;6\n30;5\n",
        b"30,5\n0,5\n30,5\n",
    ];
    for text in refused {
        assert!(!with_points(text).is_empty(), "{}", text.escape_ascii());
    }
    let points = |count: u32, wave: f64| {
        let mut text = String::new();
        for number in 0..=count {
            let share = f64::from(number) / f64::from(count);
            let z = 5.0 + wave * f64::from(number % 2);
            writeln!(text, "{},{z}", share * 30.0).unwrap();
        }
        text
    };
    assert_eq!(with_points(points(1_000_000, 0.0)), [""; 0]);
    assert_eq!(with_points(points(100_000, 0.3)), [""; 0]);
}

#[test]
fn profiles_of_many_pieces() {
    let mut bezier = "  bezier".to_owned();
    let mut spline = "  spline".to_owned();
    let mut lines = String::new();
    for number in 1..100_000_u32 {
        let x = f64::from(number) * 30.0 / 100_000.0;
        let z = 5.0 + f64::from(number % 7) / 10.0;
        write!(bezier, " ({x} mm, {z} mm)").unwrap();
        write!(spline, " ({x} mm, {z} mm)").unwrap();
        writeln!(lines, "  line to ({x} mm, {z} mm)").unwrap();
    }
    for pieces in [
        bezier + " to (30 mm, 5 mm)\n",
        spline + " to (30 mm, 5 mm)\n",
        lines + "  line to (30 mm, 5 mm)\n",
    ] {
        survive_text(sound().replace("  arc   to (30 mm, 5 mm) radius 60 mm\n", &pieces));
    }
}
