//! What an operation says of itself to people and to other programs: its parameters with their values and where these are
//! from, and the words of summary and report.

use super::{Auto, Setup, Sourced};
use serde::Serialize;
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};
use vcutc_diagnostics::number::{rounded, show};
use vcutc_diagnostics::source::Span;

/// A parameter as it is in the program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterFigure {
    /// The field of the language.
    pub name: &'static str,
    /// Its value.
    pub value: Value,
    /// Its unit; none for shares and words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<&'static str>,
    /// Who decided.
    pub origin: Decider,
}

/// A value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number, rounded to what the planner distinguishes: a micrometre, a thousandth of a degree.
    Number(f64),
    /// A word of the language.
    Word(&'static str),
}

/// Who decided a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decider {
    /// It is written in the job.
    Given,
    /// The compiler chose it.
    Auto,
    /// It is not written, and the language has a default.
    Default,
}

/// A value with its unit.
pub type Measured = (Value, Option<&'static str>);

/// A length as a figure.
#[must_use]
pub fn millimetres(length: Length) -> Measured {
    number(length.to_mm(), Some("mm"))
}

/// An angle as a figure.
#[must_use]
pub fn degrees(angle: Angle) -> Measured {
    number(angle.to_deg(), Some("deg"))
}

/// A number with its unit, rounded to thousandths.
#[must_use]
pub fn number(value: f64, unit: Option<&'static str>) -> Measured {
    (Value::Number(rounded(value, 1e3)), unit)
}

/// A word as a figure.
#[must_use]
pub const fn word(word: &'static str) -> Measured {
    (Value::Word(word), None)
}

impl ParameterFigure {
    /// A parameter that may be left to the compiler.
    #[must_use]
    pub const fn open<T>(name: &'static str, asked: &Sourced<Auto<T>>, (value, unit): Measured) -> Self {
        let origin = match &asked.value {
            Auto::Given(_) => Decider::Given,
            Auto::Auto => Decider::Auto,
        };
        Self {
            name,
            value,
            unit,
            origin,
        }
    }

    /// A parameter that the job or the language states.
    #[must_use]
    pub const fn fixed<T>(name: &'static str, asked: &Sourced<T>, (value, unit): Measured) -> Self {
        let origin = match asked.span {
            Some(_) => Decider::Given,
            None => Decider::Default,
        };
        Self {
            name,
            value,
            unit,
            origin,
        }
    }
}

/// A table of parameters for people.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterTable {
    /// What they are of: `Blade`, `Cut`.
    pub caption: &'static str,
    /// The parameters.
    pub rows: Vec<ParameterRow>,
}

/// A parameter for people.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRow {
    /// What it is called.
    pub name: &'static str,
    /// Value and unit.
    pub value: String,
    /// Where the value is from.
    pub origin: Origin,
}

/// Where a value is from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// Written in a text.
    Written(Span),
    /// Chosen by the compiler; where `auto` is written, if it is, and why it chose this.
    Chosen(Option<Span>, String),
    /// Not written: the default of the language.
    Default,
}

impl ParameterRow {
    /// A value of the job.
    pub fn of<T>(name: &'static str, sourced: Sourced<T>, words: impl FnOnce(T) -> String) -> Self {
        Self {
            name,
            value: words(sourced.value),
            origin: sourced.span.map_or(Origin::Default, Origin::Written),
        }
    }

    /// A value that may have been left open, and what was chosen for it.
    pub fn open<T>(
        name: &'static str,
        asked: &Sourced<Auto<T>>,
        value: String,
        why: impl Into<String>,
    ) -> Self {
        let origin = match (&asked.value, asked.span) {
            (Auto::Given(_), Some(span)) => Origin::Written(span),
            (Auto::Given(_), None) => Origin::Default,
            (Auto::Auto, span) => Origin::Chosen(span, why.into()),
        };
        Self { name, value, origin }
    }

    /// A value that is written in the job.
    #[must_use]
    pub const fn written(name: &'static str, value: String, span: Span) -> Self {
        Self {
            name,
            value,
            origin: Origin::Written(span),
        }
    }
}

/// The rows of an operation whose blade goes down into the material, on how it moves.
#[must_use]
pub fn motion_rows(setup: &Setup, plunge: Sourced<Speed>) -> Vec<ParameterRow> {
    vec![
        ParameterRow::of("feed cut", setup.cut_feed, speed_text),
        ParameterRow::of("feed plunge", plunge, speed_text),
        ParameterRow::of("feed travel", setup.travel_feed, speed_text),
        ParameterRow::of("clearance", setup.clearance, length_text),
        ParameterRow::of("run_out", setup.run_out, length_text),
    ]
}

/// A length with its unit: `2.5 mm`.
#[must_use]
pub fn length_text(length: Length) -> String {
    format!("{} mm", show(length.to_mm()))
}

/// A speed with its unit: `50 mm/s`.
#[must_use]
pub fn speed_text(speed: Speed) -> String {
    format!("{} mm/s", show(speed.to_mm_per_s()))
}

/// How fast something turns, with its unit: `10 deg/s`.
#[must_use]
pub fn rate_text(rate: AngularSpeed) -> String {
    format!("{} deg/s", show(rate.to_deg_per_s()))
}

/// An angle with its unit: `34 deg`.
#[must_use]
pub fn angle_text(angle: Angle) -> String {
    format!("{} deg", show(angle.to_deg()))
}
