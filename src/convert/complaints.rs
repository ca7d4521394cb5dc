//! What a conversion has to say of a program, in the user's words.

use super::axes::{Axis, Direction};
use super::milling::{Milling, Written};
use super::raster::{Kind, Pass, Stretch};
use crate::diag::{Code, Diagnostic};
use crate::plan::parameters::show;
use crate::source::Span;

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
        "this is no statement of KRL",
        place,
        format!("expected {expected}"),
    )
    .help("mend the line, or make it a comment with `;` if no motion depends on it")
}

pub(super) fn arc(place: Span, word: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NoPass,
        format!("`{word}` moves on a curve, and V-cuts are straight"),
        place,
        "a curve",
    )
    .help("let the post processor write curves as lines (`LIN`), and keep those out of the material")
}

pub(super) fn unknown_end(place: Span, why: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "where this motion ends is not known",
        place,
        why.to_owned(),
    )
    .help("give the `.dat` file with the positions too, or write X, Y and Z into the motion")
}

pub(super) fn frame_changes(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "the tool or the base changes between motions, and what that does to the motions behind it is not followed",
        place,
        "another frame from here on",
    )
    .help("let the post processor write the whole program in one base with one tool, or convert its parts one by one")
}

pub(super) fn arguments(place: Span, name: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        format!("`{name}` is called with arguments, and what its motions do with them is not followed"),
        place,
        "this call",
    )
    .help("write the motions of the routine with numbers, or convert it by itself")
}

pub(super) fn unknown_motion(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        "what this motion does is not known",
        place,
        "a target that is worked out, or more behind it than `C_DIS` and its like",
    )
    .help("write the motion with a target such as `{X 1.0,Y 2.0,Z 3.0}` and nothing behind it")
}

pub(super) fn jump(place: Span, word: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotFollowed,
        format!("`{word}` leads away from here, and where the program goes on is not followed"),
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
        "this speed is no number above 0",
        place,
        "what is it?",
    )
    .help("write the number, or give the speeds with `--feed 200mm/s` and `--travel 200mm/s`")
    .into()
}

/// A motion in the material that is no pass.
pub(super) fn no_pass(stretch: &Stretch<'_>) -> Diagnostic {
    let ([x0, y0, z0], [x1, y1, z1]) = (stretch.from, stretch.to);
    let headline = match stretch.kind() {
        Kind::Across => "this motion cuts across the passes",
        Kind::Oblique if (z1 - z0).abs() > super::raster::SAME => "this motion cuts along a slope",
        Kind::Oblique | Kind::Still | Kind::Along | Kind::Upright => {
            "this motion cuts obliquely to the passes"
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
    .note("coordinates are those of the job: x across the passes, y along them, z up, from the blank's lowest corner")
    .help("let the tool leave the blank before it goes to the next pass, or say where the blank lies with `--origin`")
}

pub(super) fn leans(place: Span, earlier: Option<Span>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::NoPass,
        "the tool leans here, and V-cuts have a tilt of their own",
        place,
        "none of the tool's axes is upright, or another one than before",
    );
    let diagnostic = match earlier {
        Some(earlier) => diagnostic.and(earlier, "upright here"),
        None => diagnostic,
    };
    diagnostic
        .help("use a three-axis operation of the CAM system; if another axis points up, say so with `--up`")
}

pub(super) fn too_short_pass(pass: &Pass, depth: f64) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(
        Code::NoPass,
        format!(
            "this pass runs from y {} mm to {} mm, and a V-cut needs to run through the whole blank of {} mm",
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

pub(super) fn nothing_straight(milling: &Milling) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::NothingToConvert,
        "there is no straight motion along an axis in this program",
        at_the_program(milling),
        "this program",
    )
    .help("passes have to run along x or y of the program's base; if another axis than z points up, say so with `--up`")
    .into()
}

pub(super) fn no_passes(milling: &Milling, top: f64) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::NothingToConvert,
        format!(
            "no pass of this program lies below the blank's top at z {} mm",
            show(top)
        ),
        at_the_program(milling),
        "this program",
    )
    .help("give the size of the blank with `--stock`, and where its lowest corner lies with `--origin X,Y,Z`")
    .into()
}

pub(super) fn too_low(milling: &Milling, lowest: f64, height: f64) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "the lowest pass lies at z {} mm, deeper than a blank of {} mm whose top is at 0",
            show(lowest),
            show(height)
        ),
        at_the_program(milling),
        "this program",
    )
    .help("say where the blank's lowest corner lies in the file with `--origin X,Y,Z`, or mend `--stock`")
    .into()
}

pub(super) fn unclear_place(
    milling: &Milling,
    (axis, size): (Direction, f64),
    [least, most]: [f64; 2],
) -> Box<Diagnostic> {
    let [low, high] = match axis.of([1.0; 3]) < 0.0 {
        true => [-most, -least],
        false => [least, most],
    };
    Diagnostic::new(
        Code::Unclear,
        format!(
            "passes lie at {} from {} to {} mm of the file, and where a blank {} mm wide lies there is not clear",
            axis.axis.letter(),
            show(low),
            show(high),
            show(size)
        ),
        at_the_program(milling),
        "this program",
    )
    .help("say where the blank's lowest corner lies in the file, for example `--origin 0,0,0`")
    .into()
}

pub(super) fn too_short(milling: &Milling, length: f64, size: f64) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::NoPass,
        format!(
            "the passes of this program reach over {} mm, and the blank is {} mm deep",
            show(length),
            show(size)
        ),
        at_the_program(milling),
        "this program",
    )
    .help("the sizes of `--stock` are width across the passes, depth along them, height; passes have to run through")
    .into()
}

pub(super) fn both_ways(
    milling: &Milling,
    (one, first): (Axis, f64),
    (other, second): (Axis, f64),
) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "this program moves {} mm along {} and {} mm along {}, so along which its passes run is not clear",
            show(first),
            one.letter(),
            show(second),
            other.letter()
        ),
        at_the_program(milling),
        "this program",
    )
    .help(format!("say it: `--along {}` or `--along {}`", one.letter(), other.letter()))
    .into()
}

pub(super) fn no_speed(place: Span) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        "the program says no speed for this pass",
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
        "this one holds for later passes",
    )
    .and(one.place, "and this one for the first")
    .help("give the one speed in the material with `--feed`, for example `--feed 200mm/s`")
    .into()
}

pub(super) fn unclear_speed(fastest: Written) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        format!(
            "a speed of {} m/s is more than a robot has, and whether it is in mm/s or mm/min is not clear",
            show(fastest.value)
        ),
        fastest.place,
        "in which unit?",
    )
    .help("say it: `--feed-unit mm/min` or `--feed-unit mm/s`")
    .into()
}

pub(super) fn no_clearance(milling: &Milling) -> Box<Diagnostic> {
    Diagnostic::new(
        Code::Unclear,
        "the program never goes above the blank, so how high the safe plane lies is not clear",
        at_the_program(milling),
        "this program",
    )
    .help("give its height above the blank, for example `--clearance 10mm`")
    .into()
}

/// Most statements that a warning shows.
const SHOWN: usize = 4;

/// Statements that are not carried over.
pub(super) fn left_out(places: &[Span], lines: &dyn Fn(Span) -> usize) -> Option<Diagnostic> {
    let (&first, rest) = places.split_first()?;
    let headline = match rest.len() {
        0 => "a statement of the program has no place in a job and is left out".to_owned(),
        more => format!(
            "{} statements of the program have no place in a job and are left out",
            more + 1
        ),
    };
    let mut diagnostic = Diagnostic::new(Code::LeftOut, headline, first, "left out");
    for &place in rest.iter().take(SHOWN - 1) {
        diagnostic = diagnostic.and(place, "left out");
    }
    let further: Vec<String> = rest
        .iter()
        .skip(SHOWN - 1)
        .take(LISTED)
        .map(|&place| lines(place).to_string())
        .collect();
    if !further.is_empty() {
        let dots = if rest.len() > SHOWN - 1 + LISTED {
            " and more"
        } else {
            ""
        };
        diagnostic = diagnostic.note(format!("so are those in lines {}{dots}", further.join(", ")));
    }
    Some(diagnostic.help(
        "see to it that nothing depends on them; what the machine needs can be said in its `machine` block",
    ))
}

/// Most lines that a warning lists.
const LISTED: usize = 40;

pub(super) fn beside(passes: &[Pass]) -> Option<Diagnostic> {
    let first = passes.first()?;
    let headline = match passes.len() {
        1 => format!(
            "the pass at x {} mm lies beside the blank and is left out",
            show(first.x)
        ),
        count => format!(
            "{count} passes lie beside the blank and are left out, the first at x {} mm",
            show(first.x)
        ),
    };
    Some(
        Diagnostic::new(Code::BesideBlank, headline, first.places[0], "beside the blank").help(
            "if the blank lies elsewhere in the file, say where its lowest corner is with `--origin X,Y,Z`",
        ),
    )
}
