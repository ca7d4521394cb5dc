//! Values and units that can be written at the cursor. What fits follows from the dimension of the place, as far as it can be
//! said: of a factor it cannot.

use super::analysis::Analysis;
use super::manual::{self, Table};
use super::offer::{Offer, Rank, offer, verbatim};
use super::slots::{Owner, Part, Rest, Slot, Within};
use lsp_types::CompletionItemKind;
use vcutc_backend_api::backend::{Backend, OptionKind};
use vcutc_backend_api::ir::{Axis, AxisKind, MachineKind};
use vcutc_job::BladeKind;
use vcutc_job::sema::study::{Definition, Meaning};
use vcutc_job::sema::vocabulary::{self, Dimension, FieldSpec, Inside, Leaving, Signature, Takes};
use vcutc_machine::{catalogue, usual_home};

/// What is known of the place of a value.
pub(super) struct Place<'a> {
    /// The names of the job.
    pub(super) analysis: &'a Analysis,
    pub(super) slot: &'a Slot,
    /// The field that the value belongs to, if it is one with a row in a table.
    pub(super) field: Option<&'static FieldSpec>,
    /// The target whose option the value belongs to.
    pub(super) target: Option<&'static dyn Backend>,
    /// The block as the reference calls it.
    pub(super) title: String,
    /// The kind of the machine around it.
    pub(super) machine: Option<MachineKind>,
    /// Its model.
    pub(super) model: Option<&'a str>,
    /// Whether a word has been begun.
    pub(super) begun: Begun,
}

/// Whether a word has been begun at the cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Begun {
    /// Some letters are there.
    Word,
    Nothing,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fit {
    /// Anything: nothing can be said.
    Anything,
    /// Values of a dimension.
    Of(Dimension),
    /// A call that describes a thing, with an example.
    Call(&'static str, &'static str),
}

impl Place<'_> {
    /// Values, words and names.
    pub(super) fn values(&self) -> Vec<Offer> {
        if let Some(target) = self.target {
            return self.option_values(target);
        }
        let is_whole = self.slot.rest == Rest::Begins && self.slot.part == Part::Summand;
        let whole = self.field.filter(|_| is_whole);
        let Some(spec) = whole else {
            return self.parts();
        };
        let mut offers = Vec::new();
        if spec.leaving == Leaving::Open {
            offers.push(Offer {
                detail: "left to the compiler".to_owned(),
                documentation: manual::row(Table::Auto(self.title.trim_matches('`')), spec.name)
                    .map(manual::Row::text),
                ..offer("auto", CompletionItemKind::KEYWORD, Rank::Fitting)
            });
        }
        match spec.takes {
            Takes::Words(words) => offers.extend(words().iter().map(|word| self.word(spec.name, word))),
            Takes::Blade(kind) => offers.extend(self.blades(kind)),
            Takes::Region => offers.extend(self.named(Meaning::Region)),
            Takes::Machine => offers.extend(self.named(Meaning::Machine)),
            Takes::Calls(calls) => offers.extend(self.calls(spec.name, calls)),
            Takes::Quantity(range) => {
                offers.extend(self.typical(spec));
                offers.extend(self.numbers(range.dimension, spec));
                offers.extend(self.parts());
            }
            Takes::Anything | Takes::Fields(_) => offers.extend(self.typical(spec)),
        }
        offers
    }

    /// The calls that a field takes; the home of a machine with straight axes is a position of those.
    fn calls(&self, field: &str, calls: &[(&str, &str)]) -> Vec<Offer> {
        if field == "home" && self.machine == Some(MachineKind::FiveAxis) {
            let axes = self.labels_of("axes");
            let values: Vec<String> = axes
                .iter()
                .map(|(axis, value)| format!("{axis} = {value}"))
                .collect();
            return vec![call_offer("axes", &format!("axes({})", values.join(", ")))];
        }
        if field == "home"
            && let Some(model) = self.model.and_then(catalogue::find)
        {
            return vec![call_offer("joints", &usual_home(&model))];
        }
        calls
            .iter()
            .map(|(name, example)| call_offer(name, example))
            .collect()
    }

    /// A typical value of the field.
    fn typical(&self, spec: &FieldSpec) -> Option<Offer> {
        let is_wanted = spec.typical != "auto" && self.begun == Begun::Nothing;
        is_wanted.then(|| Offer {
            detail: "a typical value".to_owned(),
            ..offer(spec.typical, CompletionItemKind::VALUE, Rank::Fitting)
        })
    }

    /// A number with each unit that fits, for fields whose typical value says none.
    fn numbers(&self, dimension: Dimension, spec: &FieldSpec) -> Vec<Offer> {
        if spec.typical != "auto" || self.begun == Begun::Word {
            return Vec::new();
        }
        let units = vocabulary::units_for(dimension);
        let number = |unit: String| Offer {
            snippet: format!("${{1:0}} {}", verbatim(&unit)),
            detail: "a number with this unit".to_owned(),
            ..offer(&format!("0 {unit}"), CompletionItemKind::UNIT, Rank::Possible)
        };
        units.into_iter().map(number).collect()
    }

    fn word(&self, field: &str, word: &str) -> Offer {
        Offer {
            documentation: super::hover::word_explained(&self.title, field, word),
            ..offer(word, CompletionItemKind::ENUM_MEMBER, Rank::Fitting)
        }
    }

    /// The blades of the job that are of this kind.
    fn blades(&self, kind: &str) -> Vec<Offer> {
        let kinds = BladeKind::WORDS.iter().filter(|(word, _)| *word == kind);
        kinds
            .flat_map(|(_, kind)| self.named(Meaning::Blade(*kind)))
            .collect()
    }

    fn named(&self, meaning: Meaning) -> Vec<Offer> {
        let names = self.analysis.study.definitions.iter();
        names
            .filter(|definition| definition.meaning == meaning)
            .map(|definition| offer(&definition.name.node, CompletionItemKind::CLASS, Rank::Fitting))
            .collect()
    }

    /// The parts of a calculation that fit: names of values, functions, or the call that is wanted.
    fn parts(&self) -> Vec<Offer> {
        let fit = self.fit();
        if let Fit::Call(name, example) = fit {
            return vec![call_offer(name, example)];
        }
        let mut offers: Vec<Offer> = Vec::new();
        if let Owner::Formula(variable) = &self.slot.owner {
            offers.push(Offer {
                detail: "the variable of the formula, a length".to_owned(),
                ..offer(variable, CompletionItemKind::VARIABLE, Rank::Fitting)
            });
        }
        let names = self.analysis.study.definitions.iter();
        offers.extend(names.filter_map(|definition| value(definition, fit)));
        let functions = vocabulary::functions().filter(|(name, _)| gives(name, fit));
        offers.extend(functions.map(|(name, example)| Offer {
            snippet: format!("{name}($1)"),
            detail: example.to_owned(),
            documentation: manual::row(Table::Functions, name).map(|row| format!("takes {}", row.text())),
            ..offer(name, CompletionItemKind::FUNCTION, Rank::Possible)
        }));
        if matches!(fit, Fit::Anything | Fit::Of(Dimension::PURE)) {
            offers.push(offer("pi", CompletionItemKind::CONSTANT, Rank::Possible));
        }
        offers
    }

    /// Units that fit, or all of them.
    pub(super) fn units(&self) -> Vec<Offer> {
        let units: Vec<String> = match self.fit() {
            Fit::Of(dimension) => vocabulary::units_for(dimension),
            Fit::Anything => vocabulary::units().map(|(name, _, _)| name.to_owned()).collect(),
            Fit::Call(..) => Vec::new(),
        };
        // Whole numbers, which options count in, have no share.
        let units = units
            .into_iter()
            .filter(|unit| self.target.is_none() || unit != "%");
        let units: Vec<String> = units.collect();
        let unit = |unit: &String| Offer {
            detail: vocabulary::unit_in_words(unit)
                .map_or(String::new(), |(kind, one)| format!("{kind}; 1 {unit} = {one}")),
            ..offer(unit, CompletionItemKind::UNIT, Rank::Fitting)
        };
        units.iter().map(unit).collect()
    }

    /// The labels that a call has not got yet, or the values that it takes without one.
    pub(super) fn labels(&self, given: &[String]) -> Vec<Offer> {
        let call = self.slot.call().and_then(|within| within.call.as_deref());
        let all = call.map_or_else(Vec::new, |call| self.labels_of(call));
        if all.is_empty() {
            return self.parts();
        }
        // Angles and a quaternion say the same: one of them is there.
        let turned = |label: &String| matches!(label.as_str(), "a" | "b" | "c");
        let is_quaternion = call == Some("frame") && given.iter().any(|label| label == "q");
        let quaternion = (call == Some("frame") && !given.iter().any(turned))
            .then(|| ("q".to_owned(), "(1, 0, 0, 0)".to_owned()));
        let is_new =
            |(label, _): &(String, String)| !(given.contains(label) || is_quaternion && turned(label));
        all.into_iter()
            .chain(quaternion)
            .filter(is_new)
            .map(|(label, value)| Offer {
                snippet: format!("{label} = ${{1:{}}}", verbatim(&value)),
                detail: "required".to_owned(),
                ..offer(&label, CompletionItemKind::FIELD, Rank::Needed)
            })
            .collect()
    }

    /// The labels of a call, each with a typical value; of a position those of the machine's axes.
    fn labels_of(&self, call: &str) -> Vec<(String, String)> {
        if call != "axes" {
            let labels = vocabulary::labels(call).into_iter();
            return labels
                .map(|(label, value)| (label.to_owned(), value.to_owned()))
                .collect();
        }
        let axes = self.model.and_then(catalogue::find).map(|model| model.axes);
        let known = axes.map(|axes| {
            let axis = |axis: Axis| (axis.name.to_lowercase(), zero(axis.kind).to_owned());
            axes.into_iter().map(axis).collect()
        });
        // The machine of a file: the names that most have, with a head that turns about B and A.
        known.unwrap_or_else(|| {
            let straight = ["x", "y", "z"].map(|name| (name, AxisKind::Linear));
            let turning = ["b", "a"].map(|name| (name, AxisKind::Rotary));
            let all = straight.into_iter().chain(turning);
            all.map(|(name, kind)| (name.to_owned(), zero(kind).to_owned()))
                .collect()
        })
    }

    /// What fits: from the field inwards, bracket by bracket.
    fn fit(&self) -> Fit {
        let mut fit = match &self.slot.owner {
            Owner::Let => Fit::Anything,
            Owner::Coordinate | Owner::Formula(_) => Fit::Of(Dimension::LENGTH),
            Owner::Field(key) => self.fit_of_field(key),
        };
        for within in &self.slot.within {
            fit = fit_within(alone(fit, within.part), within);
        }
        alone(fit, self.slot.part)
    }

    fn fit_of_field(&self, key: &str) -> Fit {
        if let Some(target) = self.target {
            return match option_kind(target, key) {
                Some(OptionKind::Length { .. }) => Fit::Of(Dimension::LENGTH),
                Some(OptionKind::Integer { .. }) => Fit::Of(Dimension::PURE),
                Some(OptionKind::Choice { .. } | OptionKind::Lines | OptionKind::Text) | None => {
                    Fit::Anything
                }
            };
        }
        match self.field.and_then(FieldSpec::quantity) {
            Some(range) => Fit::Of(range.dimension),
            None => Fit::Anything,
        }
    }

    fn option_values(&self, target: &'static dyn Backend) -> Vec<Offer> {
        let Owner::Field(key) = &self.slot.owner else {
            return Vec::new();
        };
        let Some(kind) = option_kind(target, key) else {
            return Vec::new();
        };
        let words: Vec<String> = match kind {
            OptionKind::Choice { of } => of.iter().map(|word| (*word).to_owned()).collect(),
            OptionKind::Integer { default, .. } => vec![default.to_string()],
            OptionKind::Length { default, .. } => vec![format!("{} mm", default.to_mm())],
            OptionKind::Lines | OptionKind::Text => vec!["\"\"".to_owned()],
        };
        words
            .into_iter()
            .chain(["default".to_owned()])
            .map(|word| offer(&word, CompletionItemKind::ENUM_MEMBER, Rank::Fitting))
            .collect()
    }
}

/// Where an axis is at zero.
const fn zero(kind: AxisKind) -> &'static str {
    match kind {
        AxisKind::Rotary => "0 deg",
        AxisKind::Linear => "0 mm",
    }
}

fn option_kind(target: &'static dyn Backend, key: &str) -> Option<OptionKind> {
    let option = target.options().iter().find(|option| option.key == key)?;
    Some(option.kind)
}

/// What fits a part of a value: of a factor nothing can be said.
const fn alone(fit: Fit, part: Part) -> Fit {
    match part {
        Part::Summand => fit,
        Part::Factor => Fit::Anything,
    }
}

/// What fits within a bracket, by what fits the whole of it.
fn fit_within(whole: Fit, within: &Within) -> Fit {
    let Some(call) = within.call.as_deref() else {
        return whole;
    };
    match vocabulary::signature(call) {
        Some(Signature::OfAngle) => Fit::Of(Dimension::ANGLE),
        Some(Signature::ToAngle) => Fit::Of(Dimension::PURE),
        Some(Signature::Bearing | Signature::Root) => Fit::Anything,
        Some(Signature::Alike) => whole,
        None => match vocabulary::inside(call, within.label.as_deref(), within.place) {
            Some(Inside::Of(dimension)) => Fit::Of(dimension),
            Some(Inside::Call(name, example)) => Fit::Call(name, example),
            None => Fit::Anything,
        },
    }
}

/// Whether a function gives what fits.
fn gives(function: &str, fit: Fit) -> bool {
    let Fit::Of(dimension) = fit else { return true };
    match vocabulary::signature(function) {
        Some(Signature::OfAngle) => dimension == Dimension::PURE,
        Some(Signature::ToAngle | Signature::Bearing) => dimension == Dimension::ANGLE,
        Some(Signature::Root | Signature::Alike) | None => true,
    }
}

fn call_offer(name: &str, example: &str) -> Offer {
    Offer {
        snippet: verbatim(example),
        detail: example.to_owned(),
        documentation: manual::row(Table::Calls, name).map(manual::Row::text),
        ..offer(name, CompletionItemKind::FUNCTION, Rank::Fitting)
    }
}

/// A name of a value, if it may be where that fits: pure numbers may begin a product of any dimension.
fn value(definition: &Definition, fit: Fit) -> Option<Offer> {
    let Meaning::Value(value) = definition.meaning else {
        return None;
    };
    let rank = match (fit, value.map(|value| value.dimension())) {
        (Fit::Of(wanted), Some(found)) if wanted == found => Rank::Fitting,
        (Fit::Of(_), Some(Dimension::PURE)) | (Fit::Of(_), None) | (Fit::Anything, _) => Rank::Possible,
        (Fit::Of(_) | Fit::Call(..), _) => return None,
    };
    Some(Offer {
        detail: value.map_or(String::new(), |value| value.text()),
        ..offer(&definition.name.node, CompletionItemKind::VARIABLE, rank)
    })
}
