//! Reading a TOML table of a sheet or a profile, with a flaw for everything that does not fit.
//!
//! A [`Table`] is told the keys that its form has and reports others; after that each value is asked for by key. What is missing or faulty comes back as `None`, and faults are among the [`Flaw`]s then: a reader
//! goes on to the end, so that one run shows all of them.

use super::flaw::Flaw;
use crate::suggest::nearest;
use core::ops::{Range, RangeInclusive};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Numbers of one kind: their unit, and the span of values that can mean something.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Unit, with which keys end too.
    pub unit: &'static str,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

/// Lengths and coordinates.
pub const LENGTH: Measure = measure("mm", -100_000.0, 100_000.0);
/// Angles of axes and offsets.
pub const ANGLE: Measure = measure("deg", -720.0, 720.0);
/// Rates of rotary axes.
pub const TURNING_RATE: Measure = measure("deg/s", 0.001, 100_000.0);
/// Accelerations of rotary axes.
pub const TURNING_ACCELERATION: Measure = measure("deg/s2", 0.001, 10_000_000.0);
/// Rates of linear axes.
pub const SLIDING_RATE: Measure = measure("mm/s", 0.001, 1_000_000.0);
/// Accelerations of linear axes.
pub const SLIDING_ACCELERATION: Measure = measure("mm/s2", 0.001, 100_000_000.0);
/// Jerks of rotary axes.
pub const TURNING_JERK: Measure = measure("deg/s3", 0.001, 1e9);
/// Jerks of linear axes.
pub const SLIDING_JERK: Measure = measure("mm/s3", 0.001, 1e10);
/// Masses.
pub const MASS: Measure = measure("kg", 0.0, 1_000_000.0);
/// Pure numbers from -1 to 1.
pub const SHARE: Measure = measure("", -1.0, 1.0);

const fn measure(unit: &'static str, min: f64, max: f64) -> Measure {
    Measure { unit, min, max }
}

impl Measure {
    fn holds(self, value: f64) -> bool {
        (self.min..=self.max).contains(&value)
    }

    fn with_unit(self, value: f64) -> String {
        format!("{value} {}", self.unit).trim_end().to_owned()
    }
}

/// Most unknown keys of a table that are told: a file of another kind has nothing else.
const MOST_UNKNOWN: usize = 10;

/// A table that is being read.
#[derive(Clone)]
pub struct Table<'t> {
    /// What it is a table of, such as `sheet`.
    document: &'static str,
    /// How the document writes it, such as `[opw]`; empty for the document as a whole.
    title: String,
    /// Where complaints about the table as a whole point.
    span: Range<usize>,
    entries: &'t DeTable<'t>,
}

impl<'t> Table<'t> {
    /// The document as a whole, whatever keys it has.
    pub(crate) const fn root(entries: &'t DeTable<'t>, document: &'static str) -> Self {
        Self {
            document,
            title: String::new(),
            span: 0..0,
            entries,
        }
    }

    /// Reports keys other than these.
    pub fn allow(&self, known: &[&str], flaws: &mut Vec<Flaw>) {
        let unknown = self
            .entries
            .keys()
            .filter(|key| !known.contains(&key.get_ref().as_ref()))
            .take(MOST_UNKNOWN);
        flaws.extend(unknown.map(|key| self.unknown(key.get_ref(), key.span(), known)));
    }

    fn unknown(&self, key: &str, span: Range<usize>, known: &[&str]) -> Flaw {
        let holder = if self.title.is_empty() {
            format!("a {}", self.document)
        } else {
            format!("`{}`", self.title)
        };
        let flaw = Flaw::new(
            span,
            format!("{holder} has no `{}`", shown(key)),
            "not a key of this form",
        );
        let near: Vec<String> = nearest(key, known.iter().copied())
            .into_iter()
            .map(|name| format!("`{name}`"))
            .collect();
        if near.is_empty() {
            flaw.help(format!("its keys are {}", known.join(", ")))
        } else {
            flaw.help(format!("did you mean {}?", near.join(" or ")))
        }
    }

    /// Where complaints about the table as a whole point.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Reports those of these keys that the table lacks. Each comes with a line that would do.
    pub fn require(&self, lines: &[(&str, &str)], flaws: &mut Vec<Flaw>) {
        let lacking: Vec<_> = lines.iter().filter(|(key, _)| self.get(key).is_none()).collect();
        if lacking.is_empty() {
            return;
        }
        let list = |parts: Vec<String>| parts.join(", ");
        let keys = list(lacking.iter().map(|(key, _)| format!("`{key}`")).collect());
        let lines = list(lacking.iter().map(|(_, line)| format!("`{line}`")).collect());
        let holder = if self.title.is_empty() {
            format!("the {}", self.document)
        } else {
            format!("`{}`", self.title)
        };
        flaws.push(
            Flaw::new(
                self.span(),
                format!("{holder} lacks {keys}"),
                format!("missing: {keys}"),
            )
            .help(format!("add, with the values of your machine: {lines}")),
        );
    }

    fn get(&self, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        self.entries.get(key)
    }

    /// Whether the key is there.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// Where the value of a key stands.
    #[must_use]
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.get(key).map_or_else(|| self.span(), Spanned::span)
    }

    /// Where the elements of a list under a key are; none where it is not a list.
    #[must_use]
    pub fn spans_of_elements(&self, key: &str) -> Vec<Range<usize>> {
        match self.get(key).map(Spanned::get_ref) {
            Some(DeValue::Array(elements)) => elements.iter().map(Spanned::span).collect(),
            Some(_) | None => Vec::new(),
        }
    }

    fn path(&self, key: &str) -> String {
        match self.title.trim_matches(['[', ']']) {
            "" => format!("[{key}]"),
            outer => format!("[{outer}.{key}]"),
        }
    }

    /// The table under a key, which has these keys.
    pub fn table(&self, key: &str, known: &[&str], flaws: &mut Vec<Flaw>) -> Option<Self> {
        let table = self.loose_table(key, flaws)?;
        table.allow(known, flaws);
        Some(table)
    }

    /// The table under a key, whatever it holds: sections that only people read.
    pub fn loose_table(&self, key: &str, flaws: &mut Vec<Flaw>) -> Option<Self> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::Table(entries) => Some(Self {
                document: self.document,
                title: self.path(key),
                span: value.span(),
                entries,
            }),
            other => {
                flaws.push(wrong_kind(key, "a table", value.span(), other));
                None
            }
        }
    }

    /// The tables under a key that stands in double brackets; empty when there is none.
    pub fn tables(&self, key: &str, known: &[&str], flaws: &mut Vec<Flaw>) -> Vec<Self> {
        let mut tables = Vec::new();
        for value in self.elements(key, "tables in double brackets", flaws) {
            match value.get_ref() {
                DeValue::Table(entries) => {
                    let table = Self {
                        document: self.document,
                        title: format!("[{}]", self.path(key)),
                        span: value.span(),
                        entries,
                    };
                    table.allow(known, flaws);
                    tables.push(table);
                }
                other => flaws.push(wrong_kind(key, "a table", value.span(), other)),
            }
        }
        tables
    }

    /// The text under a key.
    pub fn text(&self, key: &str, flaws: &mut Vec<Flaw>) -> Option<&'t str> {
        text(key, "a text in quotes", self.get(key)?, flaws)
    }

    /// The texts under a key: a list, or a single one.
    pub fn texts(&self, key: &str, flaws: &mut Vec<Flaw>) -> Vec<String> {
        let texts = self.placed_texts(key, flaws).into_iter();
        texts.map(|(text, _)| text.to_owned()).collect()
    }

    /// The same, each with where it stands.
    pub fn placed_texts(&self, key: &str, flaws: &mut Vec<Flaw>) -> Vec<(&'t str, Range<usize>)> {
        let single = self
            .get(key)
            .filter(|value| matches!(value.get_ref(), DeValue::String(_)));
        let all = match single {
            Some(single) => core::slice::from_ref(single),
            None => self.elements(key, "a list of texts", flaws),
        };
        all.iter()
            .filter_map(|value| Some((text(key, "texts in quotes", value, flaws)?, value.span())))
            .collect()
    }

    /// The names in a list under a key.
    pub fn names(&self, key: &str, flaws: &mut Vec<Flaw>) -> Vec<&'t str> {
        let mut names = Vec::new();
        for value in self.elements(key, "a list of names", flaws) {
            match value.get_ref() {
                DeValue::String(name) => names.push(name.as_ref()),
                other => flaws.push(wrong_kind(key, "names in quotes", value.span(), other)),
            }
        }
        names
    }

    /// The word under a key, one of a few.
    pub fn word<T: Copy>(&self, key: &str, words: &[(&str, T)], flaws: &mut Vec<Flaw>) -> Option<T> {
        let given = self.text(key, flaws)?;
        if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == given) {
            return Some(*meaning);
        }
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let flaw = Flaw::new(
            self.span_of(key),
            format!("`{key}` cannot be \"{}\"", shown(given)),
            "not one of its words",
        );
        let near = nearest(given, known.iter().copied());
        flaws.push(match near.first() {
            Some(near) => flaw.help(format!("did you mean \"{near}\"?")),
            None => flaw.help(format!("write one of {}", known.join(", "))),
        });
        None
    }

    /// `true` or `false` under a key.
    pub fn truth(&self, key: &str, flaws: &mut Vec<Flaw>) -> Option<bool> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::Boolean(truth) => Some(*truth),
            other => {
                flaws.push(wrong_kind(key, "`true` or `false`", value.span(), other));
                None
            }
        }
    }

    /// The whole number under a key, within this range.
    pub fn whole(&self, key: &str, range: RangeInclusive<u32>, flaws: &mut Vec<Flaw>) -> Option<u32> {
        let (min, max) = (f64::from(*range.start()), f64::from(*range.end()));
        let number = self.number(key, measure("", min, max), flaws)?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "within the range of the type, and what has a fraction is refused"
        )]
        let whole = number as u32;
        if f64::from(whole) == number {
            return Some(whole);
        }
        let flaw = Flaw::new(
            self.span_of(key),
            format!("`{key}` takes a whole number, not {number}"),
            "not a whole number",
        );
        flaws.push(flaw.help(format!("write `{key} = {whole}`")));
        None
    }

    /// The number under a key.
    pub fn number(&self, key: &str, measure: Measure, flaws: &mut Vec<Flaw>) -> Option<f64> {
        number(key, self.get(key)?, measure, flaws)
    }

    /// A fixed count of numbers under a key.
    pub fn numbers<const N: usize>(
        &self,
        key: &str,
        measure: Measure,
        flaws: &mut Vec<Flaw>,
    ) -> Option<[f64; N]> {
        numbers(key, self.get(key)?, measure, flaws)
    }

    /// A fixed count of ranges `[min, max]` under a key, each at most `widest` wide.
    pub fn ranges<const N: usize>(
        &self,
        key: &str,
        measure: Measure,
        widest: f64,
        flaws: &mut Vec<Flaw>,
    ) -> Option<[(f64, f64); N]> {
        let value = self.get(key)?;
        let rows = self.elements(key, "a list of ranges `[min, max]`", flaws);
        let ranges: Vec<_> = rows
            .iter()
            .map(|row| range(key, row, measure, widest, flaws))
            .collect();
        counted(key, ranges, value.span(), flaws)
    }

    /// A range `[min, max]` under a key, at most `widest` wide.
    pub fn range(
        &self,
        key: &str,
        measure: Measure,
        widest: f64,
        flaws: &mut Vec<Flaw>,
    ) -> Option<(f64, f64)> {
        range(key, self.get(key)?, measure, widest, flaws)
    }

    fn elements(&self, key: &str, what: &str, flaws: &mut Vec<Flaw>) -> &'t [Spanned<DeValue<'t>>] {
        let Some(value) = self.get(key) else { return &[] };
        match value.get_ref() {
            DeValue::Array(elements) => elements,
            other => {
                flaws.push(wrong_kind(key, what, value.span(), other));
                &[]
            }
        }
    }
}

/// A text that can be shown on a terminal: one that came in as `"\u001b[2J"` would clear it.
fn text<'t>(
    key: &str,
    wanted: &str,
    value: &'t Spanned<DeValue<'t>>,
    flaws: &mut Vec<Flaw>,
) -> Option<&'t str> {
    let DeValue::String(text) = value.get_ref() else {
        flaws.push(wrong_kind(key, wanted, value.span(), value.get_ref()));
        return None;
    };
    let is_hidden = |letter: char| letter.is_control() && !letter.is_whitespace();
    if text.contains(is_hidden) {
        flaws.push(Flaw::new(
            value.span(),
            format!("the text of `{key}` has a character that cannot be shown"),
            "a control character is in here",
        ));
        return None;
    }
    Some(text)
}

/// The beginning of a name that may be of any length, without what cannot be shown.
fn shown(name: &str) -> String {
    const MOST: usize = 40;
    let mut letters = name.chars().filter(|letter| !letter.is_control());
    let mut text: String = letters.by_ref().take(MOST).collect();
    if letters.next().is_some() {
        text.push_str("...");
    }
    text
}

/// A value of another kind than the key takes.
fn wrong_kind(key: &str, wanted: &str, span: Range<usize>, found: &DeValue<'_>) -> Flaw {
    let found = match found {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "a truth value",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    };
    Flaw::new(
        span,
        format!("`{key}` takes {wanted}, not {found}"),
        format!("expected {wanted} here"),
    )
}

fn number(key: &str, value: &Spanned<DeValue<'_>>, measure: Measure, flaws: &mut Vec<Flaw>) -> Option<f64> {
    let parsed = match value.get_ref() {
        DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(lossy),
        other @ (DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Array(_)
        | DeValue::Table(_)) => {
            flaws.push(wrong_kind(key, "a number", value.span(), other));
            return None;
        }
    };
    let flaw = match parsed {
        Some(number) if measure.holds(number) => return Some(number),
        Some(number) if number.is_finite() => Flaw::new(
            value.span(),
            format!(
                "`{key}` is from {} to {}, not {}",
                measure.min,
                measure.with_unit(measure.max),
                measure.with_unit(number)
            ),
            "out of range",
        ),
        Some(_) | None => Flaw::new(
            value.span(),
            format!("`{key}` takes a finite number"),
            "not a finite number",
        )
        .help("write it in digits, such as `120.5`; leave an optional key out when its value is not known"),
    };
    flaws.push(flaw);
    None
}

#[expect(
    clippy::cast_precision_loss,
    reason = "integers of a sheet beyond 2^53 are out of every range"
)]
const fn lossy(integer: i64) -> f64 {
    integer as f64
}

fn numbers<const N: usize>(
    key: &str,
    value: &Spanned<DeValue<'_>>,
    measure: Measure,
    flaws: &mut Vec<Flaw>,
) -> Option<[f64; N]> {
    let DeValue::Array(elements) = value.get_ref() else {
        let wanted = format!("a list of {N} numbers");
        flaws.push(wrong_kind(key, &wanted, value.span(), value.get_ref()));
        return None;
    };
    let found: Vec<_> = elements
        .iter()
        .map(|element| number(key, element, measure, flaws))
        .collect();
    counted(key, found, value.span(), flaws)
}

/// All of a list, if there are as many as wanted.
fn counted<T, const N: usize>(
    key: &str,
    found: Vec<Option<T>>,
    span: Range<usize>,
    flaws: &mut Vec<Flaw>,
) -> Option<[T; N]> {
    let count = found.len();
    if count != N {
        flaws.push(Flaw::new(
            span,
            format!("`{key}` takes {N} entries, not {count}"),
            format!("{count} entries"),
        ));
    }
    let all: Option<Vec<T>> = found.into_iter().collect();
    all?.try_into().ok()
}

fn range(
    key: &str,
    value: &Spanned<DeValue<'_>>,
    measure: Measure,
    widest: f64,
    flaws: &mut Vec<Flaw>,
) -> Option<(f64, f64)> {
    let [min, max] = numbers(key, value, measure, flaws)?;
    let (low, high) = (measure.with_unit(min), measure.with_unit(max));
    if min >= max {
        let flaw = Flaw::new(
            value.span(),
            format!("a range of `{key}` ends before it begins: {low} is not below {high}"),
            "the first number is the lower end",
        );
        flaws.push(if min > max {
            flaw.help(format!("write `[{max:?}, {min:?}]`"))
        } else {
            flaw
        });
        return None;
    }
    if max - min > widest {
        let (wide, most) = (measure.with_unit(max - min), measure.with_unit(widest));
        flaws.push(
            Flaw::new(
                value.span(),
                format!("a range of `{key}` is {wide} wide, at most {most} can be handled"),
                format!("{wide} wide"),
            )
            .help("give a narrower range; for an axis that turns without end, `[-360.0, 360.0]`"),
        );
        return None;
    }
    Some((min, max))
}
