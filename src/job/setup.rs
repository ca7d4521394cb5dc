//! What all operations state: the rake and the speeds of their blades, and how far these keep from the stock.

use super::{Auto, Direction, Sourced};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};
use vcutc_diagnostics::source::Span;

/// The set-up of an operation. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Where its head (such as `rough vcut`) is written: the place for messages about the operation as a whole.
    pub head_span: Span,
    /// Angle between tool axis and feed; above 0 to 90 degrees.
    pub rake: Sourced<Angle>,
    /// Direction of the cuts. Default `alternate`; none of operations that always cut to and fro.
    pub direction: Option<Sourced<Direction>>,
    /// Cutting speed; positive.
    pub cut_feed: Sourced<Speed>,
    /// Speed through the air; positive.
    pub travel_feed: Sourced<Speed>,
    /// Rate of turning the blade; positive.
    pub reorient_rate: Sourced<AngularSpeed>,
    /// Height of the safe plane above the stock; positive.
    pub clearance: Sourced<Length>,
    /// How far cuts run out beyond the stock; `auto` is the blade's overhang plus `run_out`. None of operations that do not ask for
    /// it: their cuts run out as far as `run_out` says.
    pub extension: Option<Sourced<Auto<Length>>>,
    /// Air between the blade and the stock where it turns; zero or more. Default 2 mm.
    pub run_out: Sourced<Length>,
}

impl Setup {
    /// The direction of the cuts: to and fro in operations that do not ask for one.
    #[must_use]
    pub fn direction(&self) -> Sourced<Direction> {
        let both = Sourced {
            value: Direction::Alternate,
            span: None,
        };
        self.direction.unwrap_or(both)
    }

    /// The extension that is asked for: the compiler's choice in operations that do not ask for one.
    #[must_use]
    pub fn extension(&self) -> Sourced<Auto<Length>> {
        let open = Sourced {
            value: Auto::Auto,
            span: None,
        };
        self.extension.unwrap_or(open)
    }

    /// What puts the turns of the blade farther beside the stock: the name of the field, and where it is written.
    #[must_use]
    pub fn turning_field(&self) -> (&'static str, Option<Span>) {
        match self.extension {
            Some(extension) => ("extension", extension.span),
            None => ("run_out", self.run_out.span),
        }
    }

    /// How far beside the stock its field puts the turns of a plan with this extension.
    #[must_use]
    pub fn turning_room(&self, planned: Length) -> Length {
        match self.extension {
            Some(_) => planned,
            None => self.run_out.value,
        }
    }

    /// Gives that field another value.
    pub fn set_turning_room(&mut self, room: Length) {
        match &mut self.extension {
            Some(extension) => extension.value = Auto::Given(room),
            None => self.run_out.value = room,
        }
    }

    /// Whether the compiler chooses how far beside the stock the blade turns.
    #[must_use]
    pub fn leaves_turning_room(&self) -> bool {
        match self.extension {
            Some(extension) => extension.value == Auto::Auto,
            None => self.run_out.span.is_none(),
        }
    }

    /// What to write so that the job states a field: in place of the value that it has, or as a new line after the rake.
    #[must_use]
    pub fn stated(&self, field: &str, span: Option<Span>, word: &str) -> Vec<(Span, String)> {
        let edit = match (span, self.rake.span) {
            (Some(span), _) => Some((span, word.to_owned())),
            (None, Some(rake)) => Some((rake.after(), format!("\n  {field} = {word}"))),
            (None, None) => None,
        };
        edit.into_iter().collect()
    }
}

/// A speed of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpeedField {
    /// Of cuts.
    Cut,
    /// Of ways beside and above the work.
    Travel,
    /// Of turns of the blade.
    Reorient,
}

impl SpeedField {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Cut, Self::Travel, Self::Reorient];

    /// What a job asks for, in mm/s or deg/s.
    #[must_use]
    pub fn value(self, setup: &Setup) -> f64 {
        match self {
            Self::Cut => setup.cut_feed.value.to_mm_per_s(),
            Self::Travel => setup.travel_feed.value.to_mm_per_s(),
            Self::Reorient => setup.reorient_rate.value.to_rad_per_s().to_degrees(),
        }
    }

    /// Asks for another speed, in mm/s or deg/s.
    pub fn set(self, setup: &mut Setup, speed: f64) {
        match self {
            Self::Cut => setup.cut_feed.value = Speed::mm_per_s(speed),
            Self::Travel => setup.travel_feed.value = Speed::mm_per_s(speed),
            Self::Reorient => {
                setup.reorient_rate.value = AngularSpeed::rad_per_s(Angle::deg(speed).to_rad());
            }
        }
    }

    /// What it is called in the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cut => "cut",
            Self::Travel => "travel",
            Self::Reorient => "reorient",
        }
    }

    /// Its unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Cut | Self::Travel => "mm/s",
            Self::Reorient => "deg/s",
        }
    }

    /// Where the job states it.
    #[must_use]
    pub const fn span(self, setup: &Setup) -> Option<Span> {
        match self {
            Self::Cut => setup.cut_feed.span,
            Self::Travel => setup.travel_feed.span,
            Self::Reorient => setup.reorient_rate.span,
        }
    }
}
