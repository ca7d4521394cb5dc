//! Reading a TOML table of a sheet or a profile, with a fault for everything that does not fit.
//!
//! A [`Table`] knows the fields that it may have, and reports others and those that are missing; after that each value is
//! read by its key. What is missing or faulty is `None`, and its fault is in the list: a reader continues to the end, so that
//! one run shows all faults.

use super::Wording;
use crate::Diagnostic;
use crate::schema::dimension::Dimension;
use crate::schema::faults;
use crate::schema::field::{FieldSpec, Form, Need};
use crate::schema::range::Range;
use crate::source::{self, FileId, Span};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Most unknown keys of a table that are reported: a file of another kind has nothing else.
const MOST_UNKNOWN: usize = 10;

/// A table that is being read.
#[derive(Clone)]
pub struct Table<'t> {
    wording: Wording,
    /// How the document writes it, such as `[opw]`; empty for the document as a whole.
    title: String,
    /// Where faults of the table as a whole point.
    span: Span,
    entries: &'t DeTable<'t>,
    fields: Vec<FieldSpec>,
}

impl<'t> Table<'t> {
    /// The document as a whole, whatever keys it has.
    pub(crate) fn root(entries: &'t DeTable<'t>, file: FileId, wording: Wording) -> Self {
        Self {
            wording,
            title: String::new(),
            span: Span::of_bytes(file, 0..0),
            entries,
            fields: Vec::new(),
        }
    }

    /// The same table, which has these fields: reports others, and those that it lacks.
    #[must_use]
    pub fn with(mut self, fields: &[FieldSpec], faults: &mut Vec<Diagnostic>) -> Self {
        let names: Vec<&str> = fields.iter().map(|field| field.name).collect();
        self.allow(&names, faults);
        self.require(fields, faults);
        self.fields = fields.to_vec();
        self
    }

    /// Reports keys other than these.
    pub fn allow(&self, known: &[&str], faults: &mut Vec<Diagnostic>) {
        let is_unknown = |key: &&Spanned<_>| !known.contains(&AsRef::<str>::as_ref(key.get_ref()));
        let unknown = self.entries.keys().filter(is_unknown).take(MOST_UNKNOWN);
        faults.extend(unknown.map(|key| {
            let key = source::Spanned::new(shown(key.get_ref()), self.in_file(key.span()));
            let name = source::Spanned::new(key.node.as_str(), key.span);
            faults::unknown(self.wording.code, &self.holder(), name, known).0
        }));
    }

    fn require(&self, fields: &[FieldSpec], faults: &mut Vec<Diagnostic>) {
        let is_missing = |field: &&FieldSpec| field.need == Need::Required && !self.has(field.name);
        let missing: Vec<&FieldSpec> = fields.iter().filter(is_missing).collect();
        if missing.is_empty() {
            return;
        }
        let names: Vec<&str> = missing.iter().map(|field| field.name).collect();
        let lines = missing.iter().map(|field| match field.form {
            Form::Block => format!("`{}`", field.typical),
            Form::Value | Form::Limit | Form::Bounds | Form::Points => format!("`{}`", field.sample()),
        });
        let lines = lines.collect::<Vec<_>>().join(", ");
        let fault = faults::missing(self.wording.code, &self.holder(), &names, self.span);
        faults.push(fault.help(format!("add, with your own values: {lines}")));
    }

    /// What the table is called in a sentence.
    fn holder(&self) -> String {
        match self.title.as_str() {
            "" => format!("a {}", self.wording.name),
            title => format!("`{title}`"),
        }
    }

    /// A fault at a place of the document.
    pub fn fault(&self, span: Span, message: impl Into<String>, label: impl Into<String>) -> Diagnostic {
        Diagnostic::new(self.wording.code, message, span, label)
    }

    /// Where faults of the table as a whole point.
    #[must_use]
    pub const fn span(&self) -> Span {
        self.span
    }

    fn in_file(&self, bytes: core::ops::Range<usize>) -> Span {
        Span::of_bytes(self.span.file, bytes)
    }

    fn span_of_value(&self, value: &Spanned<DeValue<'_>>) -> Span {
        self.in_file(value.span())
    }

    fn get(&self, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        self.entries.get(key)
    }

    /// Whether the key is there.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// Where the value of a key is; the table as a whole where it has none.
    #[must_use]
    pub fn span_of(&self, key: &str) -> Span {
        self.get(key).map_or(self.span, |value| self.span_of_value(value))
    }

    /// Where the elements of a list under a key are; none where it is not a list.
    #[must_use]
    pub fn spans_of_elements(&self, key: &str) -> Vec<Span> {
        let elements = self.elements(key, "a list", &mut Vec::new());
        elements.iter().map(|value| self.span_of_value(value)).collect()
    }

    fn path(&self, key: &str) -> String {
        match self.title.trim_matches(['[', ']']) {
            "" => format!("[{key}]"),
            outer => format!("[{outer}.{key}]"),
        }
    }

    /// The table under a key, which has these fields.
    pub fn table(&self, key: &str, fields: &[FieldSpec], faults: &mut Vec<Diagnostic>) -> Option<Self> {
        Some(self.loose_table(key, faults)?.with(fields, faults))
    }

    /// The table under a key, whatever it holds: sections that only people read.
    pub fn loose_table(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Option<Self> {
        self.inner(key, self.path(key), self.get(key)?, faults)
    }

    /// The tables with these fields under a key in double brackets; empty when there is none.
    pub fn tables(&self, key: &str, fields: &[FieldSpec], faults: &mut Vec<Diagnostic>) -> Vec<Self> {
        let values = self.elements(key, "tables in double brackets", faults).iter();
        values
            .filter_map(|value| {
                let table = self.inner(key, format!("[{}]", self.path(key)), value, faults)?;
                Some(table.with(fields, faults))
            })
            .collect()
    }

    fn inner(
        &self,
        key: &str,
        title: String,
        value: &'t Spanned<DeValue<'t>>,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let DeValue::Table(entries) = value.get_ref() else {
            faults.push(self.wrong_kind(key, "a table", value));
            return None;
        };
        Some(Self {
            wording: self.wording,
            title,
            span: self.span_of_value(value),
            entries,
            fields: Vec::new(),
        })
    }

    /// The text under a key.
    pub fn text(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Option<&'t str> {
        self.text_in(key, "a text in quotes", self.get(key)?, faults)
    }

    /// The texts under a key: a list, or a single one.
    pub fn texts(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Vec<String> {
        let texts = self.placed_texts(key, faults).into_iter();
        texts.map(|text| text.node.to_owned()).collect()
    }

    /// The same, each with its place.
    pub fn placed_texts(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Vec<source::Spanned<&'t str>> {
        let single = self
            .get(key)
            .filter(|value| matches!(value.get_ref(), DeValue::String(_)));
        let all = match single {
            Some(single) => core::slice::from_ref(single),
            None => self.elements(key, "a list of texts", faults),
        };
        all.iter()
            .filter_map(|value| {
                let text = self.text_in(key, "texts in quotes", value, faults)?;
                Some(source::Spanned::new(text, self.span_of_value(value)))
            })
            .collect()
    }

    /// The names in a list under a key.
    pub fn names(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Vec<&'t str> {
        let values = self.elements(key, "a list of names", faults).iter();
        values
            .filter_map(|value| self.text_in(key, "names in quotes", value, faults))
            .collect()
    }

    /// The word under a key, one of a few.
    pub fn word<T: Copy>(&self, key: &str, words: &[(&str, T)], faults: &mut Vec<Diagnostic>) -> Option<T> {
        let given = self.text(key, faults)?;
        if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == given) {
            return Some(*meaning);
        }
        let given = shown(given);
        let given = source::Spanned::new(given.as_str(), self.span_of(key));
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let quoted = |word: &str| format!("\"{word}\"");
        faults.push(faults::unknown_word(
            self.wording.code,
            &taker(key),
            given,
            &known,
            quoted,
        ));
        None
    }

    /// `true` or `false` under a key.
    pub fn truth(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Option<bool> {
        let value = self.get(key)?;
        if let DeValue::Boolean(truth) = value.get_ref() {
            return Some(*truth);
        }
        faults.push(self.wrong_kind(key, "`true` or `false`", value));
        None
    }

    /// The whole number under a key.
    pub fn whole(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Option<u32> {
        let number = self.number(key, faults)?;
        let whole = faults::whole(self.wording.code, &taker(key), number, self.span_of(key));
        whole.map_err(|fault| faults.push(*fault)).ok()
    }

    /// The number under a key.
    pub fn number(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Option<f64> {
        self.number_in(key, self.get(key)?, faults)
    }

    /// A fixed count of numbers under a key.
    pub fn numbers<const N: usize>(&self, key: &str, faults: &mut Vec<Diagnostic>) -> Option<[f64; N]> {
        self.numbers_in(key, self.get(key)?, faults)
    }

    /// A fixed count of ranges `[min, max]` under a key, each at most `widest` wide.
    pub fn ranges<const N: usize>(
        &self,
        key: &str,
        widest: f64,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<[(f64, f64); N]> {
        let value = self.get(key)?;
        let rows = self.elements(key, "a list of ranges `[min, max]`", faults).iter();
        let ranges: Vec<_> = rows.map(|row| self.range_in(key, row, widest, faults)).collect();
        self.counted(key, ranges, value, faults)
    }

    /// A range `[min, max]` under a key, at most `widest` wide.
    pub fn range(&self, key: &str, widest: f64, faults: &mut Vec<Diagnostic>) -> Option<(f64, f64)> {
        self.range_in(key, self.get(key)?, widest, faults)
    }

    fn elements(&self, key: &str, what: &str, faults: &mut Vec<Diagnostic>) -> &'t [Spanned<DeValue<'t>>] {
        let Some(value) = self.get(key) else { return &[] };
        let DeValue::Array(elements) = value.get_ref() else {
            faults.push(self.wrong_kind(key, what, value));
            return &[];
        };
        elements
    }

    /// A text that can be shown on a terminal: one that came in as `"\u001b[2J"` would clear it.
    fn text_in(
        &self,
        key: &str,
        wanted: &str,
        value: &'t Spanned<DeValue<'t>>,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<&'t str> {
        let DeValue::String(text) = value.get_ref() else {
            faults.push(self.wrong_kind(key, wanted, value));
            return None;
        };
        let is_hidden = |letter: char| letter.is_control() && !letter.is_whitespace();
        if text.contains(is_hidden) {
            let message = format!("the text of `{key}` has a character that cannot be shown");
            let label = "a control character is in here";
            faults.push(self.fault(self.span_of_value(value), message, label));
            return None;
        }
        Some(text)
    }

    /// A value of another kind than the key takes.
    fn wrong_kind(&self, key: &str, wanted: &str, value: &Spanned<DeValue<'_>>) -> Diagnostic {
        let found = match value.get_ref() {
            DeValue::String(_) => "a text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "a truth value",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        let span = self.span_of_value(value);
        faults::wrong_kind(self.wording.code, &taker(key), wanted, found, span)
    }

    /// The range of the numbers under a key.
    fn legal(&self, key: &str) -> Range {
        let field = self.fields.iter().find(|field| field.name == key);
        let all = Dimension::PURE;
        field.map_or(Range::all(all), |field| field.range(all))
    }

    fn number_in(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<f64> {
        let parsed = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .ok()
                .map(lossy),
            DeValue::String(_)
            | DeValue::Boolean(_)
            | DeValue::Datetime(_)
            | DeValue::Array(_)
            | DeValue::Table(_) => {
                faults.push(self.wrong_kind(key, "a number", value));
                return None;
            }
        };
        let (legal, span) = (self.legal(key), self.span_of_value(value));
        faults.push(match parsed {
            Some(number) if number.is_finite() && legal.holds_number(number) => return Some(number),
            Some(number) if number.is_finite() => {
                let found = legal.dimension.show(number);
                faults::out_of_range(self.wording.code, &taker(key), legal, &found, span)
            }
            Some(_) | None => {
                let message = format!("`{key}` takes a finite number");
                self.fault(span, message, "not a finite number").help(
                    "write it in digits, such as `120.5`; leave an optional key out when its value is not known",
                )
            }
        });
        None
    }

    fn numbers_in<const N: usize>(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<[f64; N]> {
        let DeValue::Array(elements) = value.get_ref() else {
            faults.push(self.wrong_kind(key, &format!("a list of {N} numbers"), value));
            return None;
        };
        let numbers = elements.iter();
        let found = numbers
            .map(|element| self.number_in(key, element, faults))
            .collect();
        self.counted(key, found, value, faults)
    }

    /// All of a list, if there are as many as wanted.
    fn counted<T, const N: usize>(
        &self,
        key: &str,
        found: Vec<Option<T>>,
        list: &Spanned<DeValue<'_>>,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<[T; N]> {
        let count = found.len();
        if count != N {
            let message = format!("`{key}` takes {N} entries, not {count}");
            faults.push(self.fault(self.span_of_value(list), message, format!("{count} entries")));
        }
        let all: Option<Vec<T>> = found.into_iter().collect();
        all?.try_into().ok()
    }

    fn range_in(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        widest: f64,
        faults: &mut Vec<Diagnostic>,
    ) -> Option<(f64, f64)> {
        let [min, max] = self.numbers_in(key, value, faults)?;
        let (span, unit) = (self.span_of_value(value), self.legal(key).dimension);
        if min >= max {
            let (low, high) = (unit.show(min), unit.show(max));
            let message = format!("a range of `{key}` ends before it begins: {low} is not below {high}");
            let fault = self.fault(span, message, "the first number is the lower end");
            faults.push(if min > max {
                fault.help(format!("write `[{max:?}, {min:?}]`"))
            } else {
                fault
            });
            return None;
        }
        if max - min > widest {
            let (wide, most) = (unit.show(max - min), unit.show(widest));
            let message = format!("a range of `{key}` is {wide} wide, at most {most} can be handled");
            let fault = self.fault(span, message, format!("{wide} wide"));
            faults.push(
                fault.help("give a narrower range; for an axis that turns without end, `[-360.0, 360.0]`"),
            );
            return None;
        }
        Some((min, max))
    }
}

fn taker(key: &str) -> String {
    format!("`{key}`")
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

#[expect(
    clippy::cast_precision_loss,
    reason = "integers of a sheet beyond 2^53 are out of every range"
)]
const fn lossy(integer: i64) -> f64 {
    integer as f64
}
