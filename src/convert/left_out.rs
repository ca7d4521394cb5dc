//! What a conversion does not carry over, and what may be missing: warnings, with every line of it.

use super::milling::Milling;
use super::raster::Raster;
use super::types::{Pass, Plunge};
use super::write::Numbered;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic};

/// All warnings about a program.
pub(super) fn warnings(milling: &Milling, raster: &Raster, sources: &SourceMap) -> Vec<Diagnostic> {
    let numbered = Numbered::of(sources);
    let lines = |place: Span| numbered.line(place);
    let mut warnings: Vec<Diagnostic> = milling
        .ends_early
        .iter()
        .map(|&place| ends_early(place))
        .collect();
    warnings.extend(left_out(&milling.left_out, &lines));
    warnings.extend(milling.uncalled.iter().map(|&place| uncalled(place)));
    warnings.extend(plunges(&raster.plunges, &lines));
    warnings.extend(above(&raster.above, &lines));
    warnings.extend(beside(&raster.beside, &lines));
    warnings
}

/// Most statements that a warning shows.
const SHOWN: usize = 4;

/// Statements that are not carried over.
fn left_out(places: &[Span], lines: &dyn Fn(Span) -> usize) -> Option<Diagnostic> {
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
    if let Some(further) = further(rest.get(SHOWN - 1..).unwrap_or_default(), lines) {
        diagnostic = diagnostic.note(format!("so are those in {further}"));
    }
    Some(
        diagnostic.help(
            "make sure that nothing depends on them; the `machine` block can state what the machine needs",
        ),
    )
}

/// Most lines that a warning lists.
const LISTED: usize = 40;

/// `lines 12, 14, 16 and more`.
fn further(places: &[Span], lines: &dyn Fn(Span) -> usize) -> Option<String> {
    let listed: Vec<String> = places
        .iter()
        .take(LISTED)
        .map(|&place| lines(place).to_string())
        .collect();
    let word = match listed.len() {
        0 => return None,
        1 => "line",
        _ => "lines",
    };
    let more = match places.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    Some(format!("{word} {}{more}", listed.join(", ")))
}

/// Passes that are left out, where the first lies and in which lines the others are.
fn passes_left_out(
    code: Code,
    passes: &[Pass],
    (where_they_lie, first_lies): (&str, &dyn Fn(&Pass) -> String),
    lines: &dyn Fn(Span) -> usize,
) -> Option<Diagnostic> {
    let (first, rest) = passes.split_first()?;
    let headline = match rest.len() {
        0 => format!(
            "the pass at {} lies {where_they_lie} and is left out",
            first_lies(first)
        ),
        more => format!(
            "{} passes lie {where_they_lie} and are left out, the first at {}",
            more + 1,
            first_lies(first)
        ),
    };
    let diagnostic = Diagnostic::new(code, headline, first.places[0], where_they_lie);
    let rest: Vec<Span> = rest.iter().map(|pass| pass.places[0]).collect();
    let diagnostic = match further(&rest, lines) {
        Some(further) => diagnostic.note(format!("the others begin in {further}")),
        None => diagnostic,
    };
    Some(diagnostic.help(
        "if the blank lies elsewhere in the file, give the place of its lowest corner with `--origin X,Y,Z`",
    ))
}

fn beside(passes: &[Pass], lines: &dyn Fn(Span) -> usize) -> Option<Diagnostic> {
    let lies = |pass: &Pass| format!("x {} mm", show(pass.x));
    passes_left_out(Code::BesideBlank, passes, ("beside the blank", &lies), lines)
}

fn above(passes: &[Pass], lines: &dyn Fn(Span) -> usize) -> Option<Diagnostic> {
    let lies = |pass: &Pass| format!("z {} mm", show(pass.z));
    passes_left_out(Code::AboveBlank, passes, ("above the blank", &lies), lines)
}

/// Plunges, which passes make good.
fn plunges(plunges: &[Plunge], lines: &dyn Fn(Span) -> usize) -> Option<Diagnostic> {
    let (first, rest) = plunges.split_first()?;
    let headline = match rest.len() {
        0 => "a motion goes straight into the uncut blank and is left out".to_owned(),
        more => format!(
            "{} motions go straight into the uncut blank and are left out",
            more + 1
        ),
    };
    let [x, y, z] = first.low.map(show);
    let label = format!("down to ({x}, {y}, {z}) of the job");
    let diagnostic = Diagnostic::new(Code::Plunge, headline, first.place, label).note(
        "a pass cuts there later, and V-cuts come from beside the blank: no part of the shape is missing",
    );
    let rest: Vec<Span> = rest.iter().map(|plunge| plunge.place).collect();
    let diagnostic = match further(&rest, lines) {
        Some(further) => diagnostic.note(format!("the others are in {further}")),
        None => diagnostic,
    };
    Some(
        diagnostic
            .help("let the tool go down beside the blank if the program is to be compared with its job"),
    )
}

/// A routine that breaks off.
fn ends_early(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotWhole,
        "a routine of the program has no `END`, so its file may have been cut short",
        place,
        "the last statement that there is",
    )
    .help("compare the file with that of the CAM system; if it is whole, write `END` after this line")
}

/// A routine that is never called.
fn uncalled(place: Span) -> Diagnostic {
    Diagnostic::new(
        Code::LeftOut,
        "this routine is never called; its motions are left out",
        place,
        "never called",
    )
    .help("call it where needed, or convert it as a separate program")
}
