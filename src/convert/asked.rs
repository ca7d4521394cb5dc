//! What the user says about a conversion: quantities as the language writes them, lengths in mm unless a unit follows.

use super::axes::{Axis, Direction, Sense};
use core::f64::consts::FRAC_PI_2;
use core::fmt;
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};
use vcutc_job::sema::units;

/// The words of the user: each field is the text of the option with its name.
#[derive(Clone, Copy, Debug, Default)]
pub struct Words<'a> {
    pub rake: &'a str,
    pub swing: &'a str,
    pub extension: &'a str,
    pub stock: &'a str,
    pub origin: Option<&'a str>,
    pub along: Option<&'a str>,
    pub up: Option<&'a str>,
    pub feed_unit: Option<&'a str>,
    pub feed: Option<&'a str>,
    pub travel: Option<&'a str>,
    pub reorient: Option<&'a str>,
    pub clearance: Option<&'a str>,
    pub edge: Option<&'a str>,
    pub half_apex: Option<&'a str>,
    pub thickness: Option<&'a str>,
    pub tolerance: Option<&'a str>,
}

/// What they mean. Ranges are those of the language, which the job that is written is held to.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// Angle between tool axis and feed.
    pub rake: Angle,
    /// Half the opening angle of the V.
    pub swing: Angle,
    /// How far cuts run out beyond the stock.
    pub extension: Length,
    /// Width, depth and height of the blank in mm, as in a job.
    pub stock: [f64; 3],
    /// Its lowest corner in the axes of the program, in mm.
    pub origin: Option<[f64; 3]>,
    /// The axis of the program that cuts run along.
    pub along: Option<Axis>,
    /// The direction of the program that points up.
    pub up: Direction,
    /// The unit of the program's speeds.
    pub feed_unit: Option<FeedUnit>,
    /// Speed in the material.
    pub feed: Option<Speed>,
    /// Speed in the air.
    pub travel: Option<Speed>,
    /// Rate of turning.
    pub reorient: Option<AngularSpeed>,
    /// Height of the safe plane above the stock.
    pub clearance: Option<Length>,
    /// The blade's cutting length.
    pub edge: Option<Length>,
    pub half_apex: Option<Angle>,
    pub thickness: Option<Length>,
    /// How close to one another the points of a pass lie, across and in height.
    pub tolerance: Length,
}

/// The tolerance where none is given: programs are printed with two or three decimals.
pub(super) const TOLERANCE: Length = Length::mm(0.01);

/// The largest tolerance: steps of passes are longer.
const COARSEST: Length = Length::mm(1.0);

/// Units that post processors write speeds in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedUnit {
    /// m/s, as KRL takes them.
    MetresPerSecond,
    /// mm/s.
    MillimetresPerSecond,
    /// mm/min.
    MillimetresPerMinute,
}

impl FeedUnit {
    const WORDS: [(&'static str, Self); 3] = [
        ("m/s", Self::MetresPerSecond),
        ("mm/s", Self::MillimetresPerSecond),
        ("mm/min", Self::MillimetresPerMinute),
    ];

    /// A speed written in it.
    #[must_use]
    pub fn speed(self, value: f64) -> Speed {
        Speed::mm_per_s(match self {
            Self::MetresPerSecond => value * 1000.0,
            Self::MillimetresPerSecond => value,
            Self::MillimetresPerMinute => value / 60.0,
        })
    }
}

/// An option that cannot be understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadOption {
    /// The option, such as `--rake`.
    pub option: &'static str,
    pub given: String,
    /// What would be right.
    pub why: String,
}

impl fmt::Display for BadOption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{} {}`: {}", self.option, self.given, self.why)
    }
}

impl Words<'_> {
    /// What the options mean.
    ///
    /// # Errors
    /// The first that cannot be understood.
    pub fn asked(&self) -> Result<Asked, BadOption> {
        let asked = Asked {
            rake: angle("--rake", self.rake)?,
            swing: angle("--swing", self.swing)?,
            extension: length("--extension", self.extension)?,
            stock: three("--stock", self.stock, is_times, "85x50x50")?,
            origin: optional(self.origin, |text| {
                three("--origin", text, |sign| sign == ',', "0,0,0")
            })?,
            along: optional(self.along, along)?,
            up: optional(self.up, up)?.unwrap_or(Direction::along(Axis::Z)),
            feed_unit: optional(self.feed_unit, feed_unit)?,
            feed: optional(self.feed, |text| speed("--feed", text))?,
            travel: optional(self.travel, |text| speed("--travel", text))?,
            reorient: optional(self.reorient, |text| {
                let rate = positive("--reorient", text, ("deg/s", "90deg/s"))?;
                Ok(AngularSpeed::deg_per_s(Angle::rad(rate).to_deg()))
            })?,
            clearance: optional(self.clearance, |text| length("--clearance", text))?,
            edge: optional(self.edge, |text| length("--edge", text))?,
            half_apex: optional(self.half_apex, |text| {
                quantity("--half-apex", text, ("deg", "7.13deg")).map(Angle::rad)
            })?,
            thickness: optional(self.thickness, |text| {
                quantity("--thickness", text, ("mm", "1.5mm")).map(Length::mm)
            })?,
            tolerance: optional(self.tolerance, tolerance)?.unwrap_or(TOLERANCE),
        };
        asked.checked(self)
    }
}

impl Asked {
    fn checked(self, words: &Words<'_>) -> Result<Self, BadOption> {
        if let Some(&size) = self.stock.iter().find(|&&size| !(size > 0.0 && size <= LONGEST)) {
            let why = format!("sizes are above 0 mm and at most 100 m, not {size} mm");
            return Err(bad("--stock", words.stock, why));
        }
        if self.rake.to_rad() > FRAC_PI_2 + 1e-12 {
            return Err(bad(
                "--rake",
                words.rake,
                "a rake must be greater than 0 deg and at most 90 deg".to_owned(),
            ));
        }
        if self.swing.to_rad() > FRAC_PI_2 - 1e-6 {
            return Err(bad(
                "--swing",
                words.swing,
                "a swing must be at least 0.001 deg and below 90 deg".to_owned(),
            ));
        }
        let half_apex = self.half_apex.unwrap_or(super::HALF_APEX);
        if half_apex.to_rad() < 0.0 || half_apex.to_rad() >= self.rake.to_rad() {
            let why = "half the apex angle is at least 0 deg and below the rake, or the edge would not lead"
                .to_owned();
            return Err(bad("--half-apex", words.half_apex.unwrap_or("7.13deg"), why));
        }
        if self.along == Some(self.up.axis) {
            let why = format!("cuts do not run along {}, which points up", self.up.axis.letter());
            return Err(bad("--along", words.along.unwrap_or_default(), why));
        }
        match self.thickness {
            Some(thickness) if thickness < Length::ZERO => Err(bad(
                "--thickness",
                words.thickness.unwrap_or_default(),
                "it is at least 0 mm".to_owned(),
            )),
            Some(_) | None => Ok(self),
        }
    }
}

/// Nothing in a cell is longer, in mm.
pub(super) const LONGEST: f64 = 100_000.0;

fn bad(option: &'static str, given: &str, why: String) -> BadOption {
    BadOption {
        option,
        given: given.to_owned(),
        why,
    }
}

fn optional<T>(
    text: Option<&str>,
    read: impl Fn(&str) -> Result<T, BadOption>,
) -> Result<Option<T>, BadOption> {
    text.map(read).transpose()
}

/// A quantity in mm, rad, mm/s or rad/s; without a unit it is in the usual one.
fn quantity(option: &'static str, text: &str, (usual, example): (&str, &str)) -> Result<f64, BadOption> {
    let wrong = || bad(option, text, format!("write a value such as `{example}`"));
    let trimmed = text.trim();
    let end = trimmed
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '+' | '-')))
        .unwrap_or(trimmed.len());
    let (number, unit) = trimmed.split_at(end);
    let number: f64 = number.parse().map_err(|_| wrong())?;
    let unit = match unit.trim() {
        // A number alone is a length; anything else says what it is in.
        "" if usual == "mm" => usual,
        unit => unit,
    };
    let found = units::quantity(number, unit).ok_or_else(wrong)?;
    let one = units::quantity(1.0, usual).ok_or_else(wrong)?;
    if found.dimension == one.dimension && found.value.is_finite() {
        Ok(found.value)
    } else {
        Err(wrong())
    }
}

fn positive(option: &'static str, text: &str, usual: (&str, &str)) -> Result<f64, BadOption> {
    let value = quantity(option, text, usual)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err(bad(option, text, "it is above 0".to_owned()))
    }
}

fn angle(option: &'static str, text: &str) -> Result<Angle, BadOption> {
    positive(option, text, ("deg", "60deg")).map(Angle::rad)
}

fn length(option: &'static str, text: &str) -> Result<Length, BadOption> {
    positive(option, text, ("mm", "8mm")).map(Length::mm)
}

fn speed(option: &'static str, text: &str) -> Result<Speed, BadOption> {
    positive(option, text, ("mm/s", "200mm/s")).map(Speed::mm_per_s)
}

fn tolerance(text: &str) -> Result<Length, BadOption> {
    let tolerance = Length::mm(quantity("--tolerance", text, ("mm", "0.05mm"))?);
    if (Length::ZERO..=COARSEST).contains(&tolerance) {
        Ok(tolerance)
    } else {
        Err(bad("--tolerance", text, "it is from 0 mm to 1 mm".to_owned()))
    }
}

/// The signs that people write between the sizes of a blank.
fn is_times(sign: char) -> bool {
    matches!(sign, 'x' | 'X' | '\u{d7}' | '*')
}

/// Three lengths; a unit after the last holds for those before it without one.
fn three(
    option: &'static str,
    text: &str,
    is_between: fn(char) -> bool,
    example: &str,
) -> Result<[f64; 3], BadOption> {
    let wrong = || bad(option, text, format!("write three lengths such as `{example}`"));
    let parts: Vec<&str> = text.split(is_between).map(str::trim).collect();
    let [x, y, z] = parts.as_slice() else {
        return Err(wrong());
    };
    let unit = z.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-'));
    let read = |part: &str| {
        let has_unit = part.ends_with(|c: char| c.is_alphabetic());
        let whole = if has_unit {
            part.to_owned()
        } else {
            format!("{part}{unit}")
        };
        quantity(option, &whole, ("mm", example)).map_err(|_| wrong())
    };
    Ok([read(x)?, read(y)?, read(z)?])
}

fn along(text: &str) -> Result<Axis, BadOption> {
    axis(text).ok_or_else(|| bad("--along", text, "it is x, y or z".to_owned()))
}

fn up(text: &str) -> Result<Direction, BadOption> {
    let (sense, letter) = match text.strip_prefix('-') {
        Some(letter) => (Sense::Negative, letter),
        None => (Sense::Positive, text),
    };
    let axis = axis(letter).ok_or_else(|| bad("--up", text, "it is x, y, z, -x, -y or -z".to_owned()))?;
    Ok(Direction { axis, sense })
}

fn axis(text: &str) -> Option<Axis> {
    Axis::ALL
        .into_iter()
        .find(|axis| text.chars().eq([axis.letter()]))
}

fn feed_unit(text: &str) -> Result<FeedUnit, BadOption> {
    FeedUnit::WORDS
        .into_iter()
        .find_map(|(word, unit)| (word == text).then_some(unit))
        .ok_or_else(|| bad("--feed-unit", text, "it is m/s, mm/s or mm/min".to_owned()))
}
