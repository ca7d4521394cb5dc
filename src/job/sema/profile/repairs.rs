//! What was repaired in a file of an airfoil, in words: one warning with a label for each place.
//!
//! Lengths are stated in mm of the job, for its chord. A repair that would change the shape is refused with
//! the same figures.

use crate::sema::quantity::{mm, number};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::position::position;
use vcutc_diagnostics::source::{FileId, SourceMap, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::import::{Altered, Repair, Side};

/// Most places that are shown.
const MOST_PLACES: usize = 6;

/// What a job takes of an airfoil.
pub(super) struct Taken<'a> {
    pub(super) file: FileId,
    pub(super) path: &'a Spanned<String>,
    pub(super) side: Side,
    pub(super) chord: Length,
}

/// Warns of repairs, or refuses those that go too far. Those of the other side are of no account.
pub(super) fn report(repairs: &[Repair], taken: &Taken<'_>, session: &mut Session<'_>) -> Checked<()> {
    let repairs: Vec<&Repair> = repairs
        .iter()
        .filter(|repair| repair.concerns(taken.side))
        .collect();
    let too_far = repairs
        .iter()
        .find_map(|repair| Some((*repair, repair.goes_too_far()?)));
    if let Some((repair, most)) = too_far {
        let diagnostic = taken.refused(repair, most, session.sources);
        return Err(session.reports.push(diagnostic));
    }
    if let Some(diagnostic) = taken.repaired(&repairs, session.sources) {
        session.reports.push(diagnostic);
    }
    Ok(())
}

impl Taken<'_> {
    fn refused(&self, repair: &Repair, most: f64, sources: &SourceMap) -> Diagnostic {
        Diagnostic::new(
            Code::BadData,
            format!("`{}` has an error", self.path.node),
            self.span(repair),
            self.fault(repair, sources),
        )
        .and(self.path.span, "the file is named here")
        .note(format!(
            "up to {} ({} % of the chord) would be repaired; more changes the shape",
            self.mm(most),
            number(most * 100.0)
        ))
        .help("correct this place in the file")
    }

    fn repaired(&self, repairs: &[&Repair], sources: &SourceMap) -> Option<Diagnostic> {
        let (first, others) = repairs.split_first()?;
        let mut diagnostic = Diagnostic::new(
            Code::AirfoilRepaired,
            match others.len() {
                0 => format!("`{}` is repaired in one place", self.path.node),
                more => format!("`{}` is repaired in {} places", self.path.node, more + 1),
            },
            self.span(first),
            self.made(first, sources),
        );
        for repair in others.iter().take(MOST_PLACES - 1) {
            diagnostic = diagnostic.and(self.span(repair), self.made(repair, sources));
        }
        let hidden = repairs.len().saturating_sub(MOST_PLACES);
        if hidden > 0 {
            diagnostic = diagnostic.note(format!("and {hidden} more"));
        }
        let diagnostic = diagnostic
            .and(self.path.span, "the file is named here")
            .help("correct the file to remove this warning");
        let moved = repairs
            .iter()
            .filter_map(|repair| moved(&repair.altered))
            .fold(0.0, f64::max);
        let fitted = repairs
            .iter()
            .map(|repair| Fitted::of(&repair.altered))
            .find(|fitted| *fitted != Fitted::No);
        let chord = mm(self.chord.to_mm());
        let note = match fitted.unwrap_or(Fitted::No) {
            // The chord is fitted first, so what it moves adds to the rest.
            Fitted::By(by) => Some(format!(
                "at a chord of {chord} no point is moved by more than {}, {} of it to fit the chord",
                self.mm(moved + by),
                self.mm(by)
            )),
            Fitted::FromItsUnit if moved > 0.0 => Some(format!(
                "once scaled to a chord of {chord}, no point is moved by more than {}",
                self.mm(moved)
            )),
            Fitted::No if moved > 0.0 => Some(format!(
                "at a chord of {chord} no point is moved by more than {}",
                self.mm(moved)
            )),
            Fitted::FromItsUnit | Fitted::No => None,
        };
        Some(match note {
            Some(note) => diagnostic.note(note),
            None => diagnostic,
        })
    }

    fn span(&self, repair: &Repair) -> Span {
        Span {
            file: self.file,
            start: repair.start,
            end: repair.end,
        }
    }

    /// A share of the chord in mm of the job.
    fn mm(&self, share: f64) -> String {
        // To the micrometre, and small ones to two digits.
        let length = share * self.chord.to_mm();
        mm(if length >= 0.01 {
            (length * 1000.0).round() / 1000.0
        } else {
            length
        })
    }

    /// The first and the last line of a repair's place.
    fn lines(&self, repair: &Repair, sources: &SourceMap) -> (usize, usize) {
        let text = sources.get(self.file).map_or("", |file| file.text.as_str());
        (position(text, repair.start).line, position(text, repair.end).line)
    }

    /// What is wrong at a place.
    fn fault(&self, repair: &Repair, sources: &SourceMap) -> String {
        let (first, last) = self.lines(repair, sources);
        match repair.altered {
            Altered::Doubled { count, apart } if apart > 0.0 => {
                format!(
                    "{count} points at lines {first} to {last} are at most {} apart",
                    self.mm(apart)
                )
            }
            Altered::Doubled { count: 2, .. } => {
                format!("2 points at line {first} and {last} are the same")
            }
            Altered::Doubled { count, .. } => {
                format!("{count} points at lines {first} to {last} are the same")
            }
            Altered::Chord { to, gap, .. } if repair.goes_too_far().is_some() => format!(
                "the points end at x = {}, where the sides are still {} apart: the airfoil is cut off before its \
                 trailing edge",
                number(to),
                self.mm(gap)
            ),
            Altered::Chord { from, to, .. } => {
                format!(
                    "the chord runs from x = {} to {}, not from 0 to 1",
                    number(from),
                    number(to)
                )
            }
            Altered::Inside { side, count, deep } => format!(
                "x runs back: {} of the {} side inside its outline, up to {} deep",
                if count == 1 {
                    "1 point is".to_owned()
                } else {
                    format!("{count} points are")
                },
                name(side),
                self.mm(deep)
            ),
            Altered::Joined { side, by } => format!(
                "the {} side begins here, {} after the leading edge",
                name(side),
                self.mm(by)
            ),
            Altered::LedOn { side, by } => format!(
                "the {} side ends here, {} before the trailing edge",
                name(side),
                self.mm(by)
            ),
            Altered::Crossed { from, by } => format!(
                "the sides cross at x = {}: from there the lower side lies up to {} above the upper one",
                self.mm(from),
                self.mm(by)
            ),
            Altered::Words => "words between the points".to_owned(),
            Altered::Trailing { count: 1 } => "this line after the last point is not a point".to_owned(),
            Altered::Trailing { count } => {
                format!("{count} lines of words and digits after the last point are not points")
            }
            Altered::Counts { stated, found } => {
                format!(
                    "the file says that it has {} points, and has {found}",
                    number(stated)
                )
            }
            Altered::Column { value } => {
                format!("every line has a third number, {}", number(value))
            }
        }
    }

    /// What is wrong at a place and what was done about it.
    fn made(&self, repair: &Repair, sources: &SourceMap) -> String {
        let done = match repair.altered {
            Altered::Doubled { .. } => "one is used".to_owned(),
            Altered::Chord { from, to, .. } if from.abs() < 0.01 && (to - 100.0).abs() < 1.0 => {
                "read as percent of the chord".to_owned()
            }
            Altered::Chord { from, to, .. } => {
                format!("x and z are scaled by {}", number(1.0 / (to - from)))
            }
            Altered::Inside { .. } => "the outline skips".to_owned(),
            Altered::Joined { .. } => "joined to it by a straight line".to_owned(),
            Altered::LedOn { .. } => "extended straight".to_owned(),
            Altered::Crossed { by, .. } => {
                format!(
                    "both follow the line midway between them, {} from either",
                    self.mm(by / 2.0)
                )
            }
            Altered::Words | Altered::Trailing { .. } => "passed over".to_owned(),
            Altered::Counts { .. } => "all of its points are used".to_owned(),
            Altered::Column { .. } => "left out".to_owned(),
        };
        format!("{}: {done}", self.fault(repair, sources))
    }
}

/// What fitting the chord does to the points.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fitted {
    /// Nothing: the chord runs from 0 to 1.
    No,
    /// It moves points by up to this share of the chord.
    By(f64),
    /// It reads them in their unit, such as percent or mm. That moves nothing.
    FromItsUnit,
}

impl Fitted {
    fn of(altered: &Altered) -> Self {
        /// Chords within this share of 1 are meant to be 1.
        const NEAR_ONE: f64 = 0.1;
        match *altered {
            // Both ends move the most: in between, x moves by a mean of the two, and z by less than it would at a height of 1.
            Altered::Chord { from, to, .. } if (to - from - 1.0).abs() <= NEAR_ONE => {
                Self::By(from.abs().max((to - 1.0).abs()))
            }
            Altered::Chord { .. } => Self::FromItsUnit,
            Altered::Doubled { .. }
            | Altered::Inside { .. }
            | Altered::Joined { .. }
            | Altered::LedOn { .. }
            | Altered::Crossed { .. }
            | Altered::Words
            | Altered::Trailing { .. }
            | Altered::Counts { .. }
            | Altered::Column { .. } => Self::No,
        }
    }
}

/// By how much a repair may move the surface, as a share of the chord; none for those that leave it where it is, and for the chord
/// ([`Fitted`]).
fn moved(altered: &Altered) -> Option<f64> {
    match *altered {
        Altered::Crossed { by, .. } => Some(by / 2.0),
        Altered::Doubled { apart, .. } => Some(apart),
        Altered::Chord { .. }
        | Altered::Inside { .. }
        | Altered::Joined { .. }
        | Altered::LedOn { .. }
        | Altered::Words
        | Altered::Trailing { .. }
        | Altered::Counts { .. }
        | Altered::Column { .. } => None,
    }
}

const fn name(side: Side) -> &'static str {
    match side {
        Side::Upper => "upper",
        Side::Lower => "lower",
    }
}
