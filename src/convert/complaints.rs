//! What a conversion has to say of a program, in the user's words.

use super::axes::{Axes, Axis, Direction};
use super::milling::{Milling, Move, Written};
use super::runs::{Kind, Run, Stretch};
use super::types::{Pass, Plunge, SAME, Start};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};

/// At the program as a whole: at its first motion, or where its text begins.
fn at_the_program(milling: &Milling) -> Span {
    milling.moves.first().map_or(milling.start, |first| first.place)
}

pub(super) fn no_routine(start: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NothingToConvert,
        "there is no routine in this program",
        start,
        "no `DEF NAME( )` in the files given",
    )
    .help("give the `.src` file of a KUKA program, and its `.dat` file if it has one")
}

pub(super) fn unreadable(place: Span, expected: &str) -> Diagnostic {
    Diagnostic::new(
        Code::UnreadableStatement,
        "this is not a statement of KRL",
        place,
        format!("expected {expected}"),
    )
    .help("fix the line, or make it a comment with `;` if no motion depends on it")
}

pub(super) fn cut_short(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::UnreadableStatement,
        "the program ends in the middle of this statement",
        place,
        "the last of it; there is no `END` after it",
    )
    .help("the file was cut short when it was written or copied: get the whole of it, which ends with `END`")
}

pub(super) fn outside(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::UnreadableStatement,
        "this is outside all routines, so no controller carries it out",
        place,
        "expected `DEF NAME( )` before it",
    )
    .help(
        "a program begins with `DEF NAME( )` and ends with `END`: add or move the line that is missing or too early",
    )
}

pub(super) fn curve(place: Span, word: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NoPass,
        format!("`{word}` moves on a curve, and V-cuts are straight"),
        place,
        "a curve",
    )
    .help("set the post processor to write curves as lines (`LIN`), and keep those out of the material")
}

pub(super) fn unknown_arc(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "the end of an arc with `CA` follows from its circle, which is unknown here",
        place,
        "its start is not known, or its points lie on one line",
    )
    .help("set the post processor to write curves as lines (`LIN`), or arcs without `CA`")
}

pub(super) fn unknown_start(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "this motion is relative, but its start is not known",
        place,
        "start or orientation of the tool unknown",
    )
    .help("let a motion to a point with all of X, Y, Z, A, B and C come before it, or write its end in the base (`LIN`)")
}

pub(super) fn with(place: Span, name: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        format!("`WITH` sets `{name}` for this motion, which is not supported"),
        place,
        "more than a speed, a frame or how the motion is planned",
    )
    .help(format!("take `{name}` out of the motion"))
}

pub(super) fn block_with(place: Span, word: &str) -> Diagnostic {
    let word = word.to_ascii_uppercase();
    Diagnostic::new(
        Code::NotFollowed,
        format!("`{word}` sets something for all segments of its block, which is not supported"),
        place,
        "holds to the end of the block",
    )
    .help(format!(
        "write what follows `{word}` before the block, as statements such as `$VEL.CP = 0.2`, or after each segment"
    ))
}

pub(super) fn missing_routine(place: Span, name: &str, first: &str) -> Diagnostic {
    let file = format!("{}.src", name.to_ascii_lowercase());
    Diagnostic::new(
        Code::MissingRoutine,
        format!("the routine `{name}` is not in any of the files given, and its motions would be missing"),
        place,
        "called here",
    )
    .help(format!("give its file too: `vcutc convert {first} {file} ...`"))
    .help("if it does not move anything, comment out the call with `;`")
}

pub(super) fn external_axis(place: Span, first: Span, (name, from, to): (&str, f64, f64)) -> Diagnostic {
    Diagnostic::new(
        Code::ExternalAxis,
        format!(
            "the external axis {name} goes from {} to {}, which is not supported",
            show(from),
            show(to)
        ),
        place,
        format!("{name} is {} here", show(to)),
    )
    .and(first, format!("and {} from here on", show(from)))
    .help(format!(
        "set the post processor to write each stand of {name} as a separate program, and convert them one by one"
    ))
}

pub(super) fn unknown_end(place: Span, why: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "the end of this motion is not known",
        place,
        why.to_owned(),
    )
    .help("give the `.dat` file with the positions too, or write X, Y and Z into the motion")
}

pub(super) fn too_far(place: Span, value: f64) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        format!("this motion goes to a coordinate of {value:e} mm, but no cell is larger than 100 m"),
        place,
        "beyond every cell",
    )
    .help("correct the number; coordinates are in mm")
}

pub(super) fn frame_changes(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "the tool or the base changes between motions, which is not supported",
        place,
        "another frame from here on",
    )
    .help("set the post processor to write the whole program in one base with one tool, or convert its parts one by one")
}

pub(super) fn arguments(place: Span, name: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        format!("`{name}` is called with arguments, which is not supported"),
        place,
        "this call",
    )
    .help("write the motions of the routine with numbers, or convert it by itself")
}

pub(super) fn unknown_motion(place: Span, said: &str) -> Diagnostic {
    let what = if said.contains(':') && !said.contains("POS:") {
        "frames joined by `:`"
    } else if said.contains(['+', '*', '/', '(']) {
        "a computed target"
    } else if said.contains('[') {
        "a position in a list with a computed index"
    } else {
        "a target with values that are not numbers"
    };
    Diagnostic::new(
        Code::NotFollowed,
        "the end of this motion is computed while the program runs",
        place,
        what,
    )
    .help("set the post processor to write the motion with numbers, such as `{X 1.0,Y 2.0,Z 3.0}`")
}

pub(super) fn jump(place: Span, word: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        format!("`{word}` leads away from here, which is not supported"),
        place,
        "not followed",
    )
    .help("write the motions one after the other")
}

pub(super) fn fork(place: Span, fork: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "whether and how often this motion is made is decided while the program runs",
        place,
        "this motion",
    )
    .and(fork, "depends on this")
    .help("write the motions one after the other, without branches and loops")
}

pub(super) fn endless(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "this program is too long, or calls itself",
        place,
        "given up here",
    )
    .help("convert its parts one by one")
}

pub(super) fn speed_unknown(place: Span) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        "this speed is not a number above 0",
        place,
        "what is it?",
    )
    .help("write the number, or give the speeds with `--feed 200mm/s` and `--travel 200mm/s`")
    .into()
}

const COORDINATES: &str = "coordinates are those of the job: x across the passes, y along them, z up, from the blank's lowest corner";

/// A motion in the material that is not a pass.
pub(super) fn no_pass(stretch: &Stretch<'_>) -> Diagnostic {
    let ([x0, y0, z0], [x1, y1, z1]) = (stretch.from, stretch.to);
    let headline = match stretch.kind {
        Kind::Across => "this motion cuts across the passes",
        Kind::Curve => "this motion cuts along an arc, but V-cuts are straight",
        Kind::Oblique if (z1 - z0).abs() > SAME => "this motion cuts along a slope",
        Kind::Oblique | Kind::Still | Kind::Along | Kind::Upright | Kind::Landing => {
            "this motion cuts obliquely to the passes"
        }
    };
    let help = match stretch.kind {
        Kind::Curve => {
            "keep arcs above the blank or beside it, or give the place of the blank with `--origin X,Y,Z`"
        }
        Kind::Across | Kind::Oblique | Kind::Still | Kind::Along | Kind::Upright | Kind::Landing => {
            "let the tool leave the blank before it goes to the next pass, or give the place of the blank with `--origin X,Y,Z`"
        }
    };
    Diagnostic::new(
        Code::NoPass,
        headline,
        stretch.said.place,
        format!(
            "through the blank from ({}, {}, {}) to ({}, {}, {})",
            show(x0),
            show(y0),
            show(z0),
            show(x1),
            show(y1),
            show(z1)
        ),
    )
    .note(COORDINATES)
    .help(help)
}

/// A plunge into what no pass cuts.
pub(super) fn plunge(plunge: &Plunge) -> Diagnostic {
    let headline = match plunge.start {
        Start::Above => {
            "this motion goes straight into the blank where no pass cuts, but V-cuts run through it"
        }
        Start::Unknown => "this motion ends in the blank where no pass cuts, and its start is not known",
    };
    let [x, y, z] = plunge.low.map(show);
    Diagnostic::new(Code::NoPass, headline, plunge.place, format!("down to ({x}, {y}, {z})"))
        .note(COORDINATES)
        .help("let a pass run as deep there, keep the tool above the blank, or give the place of the blank with `--origin X,Y,Z`")
}

pub(super) fn leans(place: Span, earlier: Option<Span>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::NoPass,
        "the tool leans here, but V-cuts have their own tilt",
        place,
        "none of the tool's axes is upright, or another one than before",
    );
    let diagnostic = match earlier {
        Some(earlier) => diagnostic.and(earlier, "upright here"),
        None => diagnostic,
    };
    diagnostic
        .help("use a three-axis operation of the CAM system; if another axis points up, use `--up AXIS`")
}

pub(super) fn too_short_pass(pass: &Pass, depth: f64) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(
        Code::NoPass,
        format!(
            "this pass runs from y {} mm to {} mm, but a V-cut must run through the whole blank of {} mm",
            show(pass.y[0]),
            show(pass.y[1]),
            show(depth)
        ),
        pass.places[0],
        "ends within the blank",
    );
    diagnostic
        .help("extend the passes beyond the blank in the CAM system")
        .into()
}

pub(super) fn below_the_blank(pass: &Pass) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::NoPass,
        format!(
            "this pass lies {} mm below the bottom of the blank, but a V-cut ends within it",
            show(-pass.z)
        ),
        pass.places[0],
        "below the bottom",
    )
    .help("let the lowest passes end at the bottom of the blank")
    .into()
}

pub(super) fn nothing_straight(milling: &Milling) -> Box<Diagnostic> {
    let mut lines = milling.moves.windows(2).filter_map(|pair| match pair {
        [before, said] if before.to.is_some() && said.to.is_some() && before.to != said.to => {
            Some(said.place)
        }
        _ => None,
    });
    let (place, label) = match lines.next() {
        Some(place) => (
            place,
            "its first motion between two points goes in another direction",
        ),
        None => (at_the_program(milling), "this program"),
    };
    Diagnostic::new(
        Code::NothingToConvert,
        "there is no straight motion along an axis in this program",
        place,
        label,
    )
    .help("passes have to run along x or y of the program's base; if an axis other than z points up, use `--up AXIS`")
    .into()
}

pub(super) fn no_passes(milling: &Milling, lowest: Option<&Run>, top: f64) -> Box<Diagnostic> {
    let (place, label) = match lowest {
        Some(run) => (
            run.places[0],
            format!("the lowest runs at z {} mm", show(run.height())),
        ),
        None => (at_the_program(milling), "this program".to_owned()),
    };
    Diagnostic::new(
        Code::NothingToConvert,
        format!(
            "no pass of this program lies below the blank's top at z {} mm",
            show(top)
        ),
        place,
        label,
    )
    .help(
        "give the size of the blank with `--stock`, and the place of its lowest corner with `--origin X,Y,Z`",
    )
    .into()
}

pub(super) fn too_low(lowest: &Run, height: f64) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "the lowest pass lies at z {} mm, deeper than a blank of {} mm whose top is at 0",
            show(lowest.height()),
            show(height)
        ),
        lowest.places[0],
        "the lowest pass",
    )
    .help(SAY_WHERE)
    .into()
}

/// Passes on both sides of the file's zero.
pub(super) fn both_sides([deepest, highest]: [&Run; 2], [below, above]: [usize; 2]) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "passes lie on both sides of the file's zero, {below} below it and {above} above, so its height in the blank is \
             ambiguous"
        ),
        deepest.places[0],
        format!("the lowest pass, at z {} mm", show(deepest.height())),
    )
    .and(
        highest.places[0],
        format!("as long as a pass, at z {} mm", show(highest.height())),
    )
    .help(SAY_WHERE)
    .into()
}

/// That nothing but the user says where the blank lies; offers follow.
const SAY_WHERE: &str = "give the place of the blank's lowest corner in the file with `--origin X,Y,Z`";

/// Passes over no blank of that width with its zero at an edge or in the middle.
pub(super) fn unclear_place(
    milling: &Milling,
    axis: (Direction, f64),
    range: [f64; 2],
    ends: [Option<&Run>; 2],
) -> Box<Diagnostic> {
    let why = format!("the place of a blank {} mm wide is ambiguous there", show(axis.1));
    over_a_range(milling, axis.0, range, ends, &why)
}

/// Passes over a blank with its zero at an edge, and over one with its zero in the middle.
pub(super) fn two_places(
    milling: &Milling,
    axis: (Direction, f64),
    range: [f64; 2],
    ends: [Option<&Run>; 2],
) -> Box<Diagnostic> {
    let why = format!(
        "a blank {} mm wide may have the file's zero at an edge or in its middle then",
        show(axis.1)
    );
    over_a_range(milling, axis.0, range, ends, &why)
}

/// That passes lie over a range, and what follows from that.
fn over_a_range(
    milling: &Milling,
    axis: Direction,
    [least, most]: [f64; 2],
    ends: [Option<&Run>; 2],
    why: &str,
) -> Box<Diagnostic> {
    let is_turned = axis.of([1.0; 3]) < 0.0;
    let [low, high] = if is_turned { [-most, -least] } else { [least, most] };
    let [first, last] = if is_turned { [ends[1], ends[0]] } else { ends };
    let place = |run: Option<&Run>| run.map_or_else(|| at_the_program(milling), |run| run.places[0]);
    let letter = axis.axis.letter();
    let label = |value: f64| format!("a pass at {letter} {} mm", show(value));
    Diagnostic::new(
        Code::Unclear,
        format!(
            "passes lie at {letter} from {} to {} mm of the file, and {why}",
            show(low),
            show(high)
        ),
        place(first),
        label(low),
    )
    .and(place(last), label(high))
    .help(SAY_WHERE)
    .into()
}

pub(super) fn too_short(milling: &Milling, longest: Option<&Run>, length: f64, size: f64) -> Box<Diagnostic> {
    let (place, label) = match longest {
        Some(run) => (
            run.places[0],
            format!("the longest pass, of {} mm", show(run.length())),
        ),
        None => (at_the_program(milling), "this program".to_owned()),
    };
    Diagnostic::new(
        Code::NoPass,
        format!(
            "the passes of this program reach over {} mm, and the blank is {} mm deep",
            show(length),
            show(size)
        ),
        place,
        label,
    )
    .help("the sizes of `--stock` are width across the passes, depth along them, height; passes have to run through")
    .into()
}

pub(super) fn both_ways(
    milling: &Milling,
    (one, first, first_run): (Axis, f64, Option<&Run>),
    (other, second, second_run): (Axis, f64, Option<&Run>),
) -> Box<Diagnostic> {
    let place = |run: Option<&Run>| run.map_or_else(|| at_the_program(milling), |run| run.places[0]);
    let label = |axis: Axis| format!("the longest along {}", axis.letter());
    Diagnostic::new(
        Code::Unclear,
        format!(
            "this program moves {} mm along {} and {} mm along {}, so the direction of its passes is ambiguous",
            show(first),
            one.letter(),
            show(second),
            other.letter()
        ),
        place(first_run),
        label(one),
    )
    .and(place(second_run), label(other))
    .help("choose one with `--along AXIS`")
    .into()
}

pub(super) fn no_speed(place: Span) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        "the program states no speed for this pass",
        place,
        "no `$VEL.CP` with a number before it",
    )
    .help("give the speed in the material with `--feed`, for example `--feed 200mm/s`")
    .into()
}

pub(super) fn two_speeds(one: Written, other: Written) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "passes have different speeds, {} and {}",
            show(one.value),
            show(other.value)
        ),
        other.place,
        "this one applies to later passes",
    )
    .and(one.place, "and this one for the first")
    .help("give the one speed in the material with `--feed`, for example `--feed 200mm/s`")
    .into()
}

pub(super) fn unclear_speed(fastest: Written) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "a speed of {} m/s is more than a robot has, and may be in mm/s or mm/min",
            show(fastest.value)
        ),
        fastest.place,
        "in which unit?",
    )
    .help("if it is in mm/min: `--feed-unit mm/min`")
    .help("if it is in mm/s: `--feed-unit mm/s`")
    .into()
}

pub(super) fn too_fast(fastest: Written) -> Box<Diagnostic> {
    let value = fastest.value;
    let value = if value < 1e9 {
        show(value)
    } else {
        format!("{value:e}")
    };
    Diagnostic::new(
        Code::Unclear,
        format!("a speed of {value} is more than a robot has, even in mm/min"),
        fastest.place,
        "what is it?",
    )
    .help("write the speed that is meant, or give the speeds with `--feed 200mm/s` and `--travel 200mm/s`")
    .into()
}

pub(super) fn no_clearance(milling: &Milling, axes: Axes, top: f64) -> Box<Diagnostic> {
    let height = |step: &Move| step.to.map(|to| axes.point(to)[2]);
    let known = milling
        .moves
        .iter()
        .filter_map(|step| Some((height(step)?, step.place)));
    let highest = known.reduce(|one, other| if other.0 > one.0 { other } else { one });
    let (place, label) = match highest {
        Some((height, place)) => (place, format!("its highest motion, to z {} mm", show(height))),
        None => (at_the_program(milling), "this program".to_owned()),
    };
    Diagnostic::new(
        Code::Unclear,
        format!(
            "the program never goes above the blank, whose top is at z {} mm, so the height of the safe plane is unknown",
            show(top)
        ),
        place,
        label,
    )
    .help("give its height above the blank with `--clearance LENGTH`, or give the place of the blank")
    .into()
}
