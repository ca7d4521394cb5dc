//! Sheets: descriptions of machines as TOML, of the catalogue and of users alike.
//!
//! What a sheet needs is its `model`, the geometry, and the limits of the axes; all the rest explains where the
//! numbers come from and how far to trust them ([`Facts`]). `docs/machines.md` has the form. One form is read for robots
//! and one for five-axis machines; the key `kind` says which.

mod five_axis;
mod robot;
mod types;

use super::LimitPlaces;
use super::Model;
use super::elasticity::Elasticity;
use super::facts::{self, Facts, FkCheck};
use super::masses::{Masses, Torques};
use super::path_limits::{self, PathLimits};
use super::payload::{self, Payload};
use super::ranges;
use crate::kinematics::Mechanism;
use vcutc_backend_api::ir::{Axis, MachineKind, Maker};
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::document::{self, Wording};
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};
use vcutc_diagnostics::source::FileId;
use vcutc_diagnostics::{Code, Diagnostic};

/// A machine with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Its model as its maker writes it, such as `KUKA KR 210 R3100 ultra`.
    pub model: String,
    pub manufacturer: Option<String>,
    /// What its flange may carry, as far as it is stated.
    pub payload: Payload,
    /// How far the numbers are backed, when stated.
    pub confidence: Option<Confidence>,
    /// Its axes, in the controller's order and sense.
    pub axes: Vec<Axis>,
    /// How the axes move the flange or the spindle nose.
    pub mechanism: Mechanism,
    /// What its controller keeps along the way of the tip.
    pub path: PathLimits,
    /// The masses of its links, when stated.
    pub masses: Option<Masses>,
    /// The torques of its drives, when stated.
    pub torques: Option<Torques>,
    /// How its joints yield, when stated.
    pub elasticity: Option<Elasticity>,
    /// For people.
    pub facts: Facts,
}

/// How far the numbers of a sheet are backed. No level means "measured on a controller".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confidence {
    /// Two or more sources agree on all lengths.
    High,
    /// They agree except for one length (by half a millimetre at most) or one range, or no document of the maker backs
    /// them.
    MediumHigh,
    /// One source, or incomplete limits or speeds.
    Medium,
    /// Made up to show an arrangement; the sizes are those of no real machine.
    Example,
}

const CONFIDENCES: &[(&str, Confidence)] = &[
    ("high", Confidence::High),
    ("medium-high", Confidence::MediumHigh),
    ("medium", Confidence::Medium),
    ("example", Confidence::Example),
];

impl Confidence {
    /// As sheets write it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::High => "high",
            Self::MediumHigh => "medium-high",
            Self::Medium => "medium",
            Self::Example => "example",
        }
    }
}

/// Kinds of machine, as sheets write them; the first when a sheet does not say.
const KINDS: &[(&str, MachineKind)] = &[
    ("robot", MachineKind::Robot),
    ("five_axis", MachineKind::FiveAxis),
];

/// The fields of every sheet.
const FIELDS: &[FieldSpec] = &[
    optional("id"),
    optional("kind"),
    optional("manufacturer"),
    value("model", "\"KUKA KR 210 R3100 ultra\"").required(),
    optional("rated_payload_kg").within(ranges::RATED_PAYLOAD),
    optional("payload_source"),
    optional("confidence"),
    optional(path_limits::KEY),
];

/// How messages speak of sheets.
const WORDING: Wording = Wording {
    name: "sheet",
    looks: "`c2_mm = 1350.0` below headings such as `[opw]`",
    code: Code::BadMachineFile,
};

/// Reads a sheet.
///
/// # Errors
/// What is wrong with it, in the order of the text; the first [`document::MOST_FAULTS`] of it.
pub fn parse(file: FileId, text: &str) -> Result<Sheet, Vec<Diagnostic>> {
    document::parse(file, text, WORDING, read)
}

fn read(root: Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Sheet> {
    let kind = if root.has("kind") {
        root.word("kind", KINDS, faults)?
    } else {
        MachineKind::Robot
    };
    let form = match kind {
        MachineKind::Robot => robot::FORM,
        MachineKind::FiveAxis => five_axis::FORM,
    };
    let root = &root.with(&[FIELDS, facts::FIELDS, form.fields].concat(), faults);
    root.text("id", faults);
    let model = root.text("model", faults);
    let manufacturer = root.text("manufacturer", faults);
    let rated = root.number("rated_payload_kg", faults);
    let confidence = root.word("confidence", CONFIDENCES, faults);
    let mut facts = facts::read(root, faults);
    let body = (form.read)(root, maker(manufacturer), faults)?;
    facts.sources.extend(body.sources);
    facts.remarks.extend(body.remarks);
    let path = path_limits::read(root, &mut facts.sources, &mut facts.remarks, faults);
    let mechanism = body.mechanism?;
    let arm = (kind == MachineKind::Robot).then_some(root);
    let opw = mechanism.ortho_parallel();
    let wrist = opw.and_then(|opw| payload::read(root, opw.c4, &mut facts.sources, faults));
    let masses = arm.and_then(|root| Masses::read(root, faults));
    if let (Some(masses), Some(arm)) = (&masses, mechanism.ortho_parallel()) {
        masses.check(root, arm.length(), faults);
    }
    let torques = arm.and_then(|root| Torques::read(root, faults));
    let elasticity = arm.and_then(|root| Elasticity::read(root, faults));
    let missed = |check: &FkCheck| check.missed(&mechanism, &body.axes);
    faults.extend(facts.fk_checks.iter().filter_map(missed));
    Some(Sheet {
        model: model?.to_owned(),
        manufacturer: manufacturer.map(str::to_owned),
        payload: Payload { rated, wrist },
        confidence,
        axes: body.axes,
        mechanism,
        path,
        masses,
        torques,
        elasticity,
        facts,
    })
}

/// Who makes the controller of a manufacturer's machines.
fn maker(manufacturer: Option<&str>) -> Maker {
    match manufacturer.map(str::to_lowercase).as_deref() {
        Some("kuka") => Maker::Kuka,
        Some("abb") => Maker::Abb,
        Some(_) | None => Maker::Other,
    }
}

impl Sheet {
    /// Who made its controller.
    #[must_use]
    pub fn maker(&self) -> Maker {
        maker(self.manufacturer.as_deref())
    }

    #[must_use]
    pub const fn kind(&self) -> MachineKind {
        self.mechanism.kind()
    }

    /// The machine under a name.
    #[must_use]
    pub fn machine(&self, name: impl Into<String>) -> Model {
        Model {
            name: name.into(),
            maker: self.maker(),
            axes: self.axes.clone(),
            mechanism: self.mechanism.clone(),
            path: self.path,
            payload: self.payload,
            masses: self.masses.clone(),
            torques: self.torques.clone(),
            elasticity: self.elasticity.clone(),
        }
    }
}

/// Where a sheet states the limits of its axes; nowhere in one that cannot be read.
pub(crate) fn limit_places(file: FileId, text: &str, axes: &[Axis]) -> Vec<LimitPlaces> {
    let places = |root: Table<'_>, faults: &mut Vec<Diagnostic>| Some(places_in(&root, axes, faults));
    document::parse(file, text, WORDING, places).unwrap_or_default()
}

fn places_in(root: &Table<'_>, axes: &[Axis], faults: &mut Vec<Diagnostic>) -> Vec<LimitPlaces> {
    if let Some(tables) = root.loose_table("axis", faults) {
        let of_axis = |axis: &Axis| {
            let table = tables.loose_table(&axis.name.to_lowercase(), &mut Vec::new())?;
            let stated = |keys: [&str; 2]| {
                keys.into_iter()
                    .find(|key| table.has(key))
                    .map(|key| table.span_of(key))
            };
            Some(LimitPlaces {
                range: stated(["travel_mm", "range_deg"]),
                rate: stated(["rate_mm_s", "rate_deg_s"]),
            })
        };
        return axes
            .iter()
            .map(|axis| of_axis(axis).unwrap_or_default())
            .collect();
    }
    let Some(limits) = root.loose_table("limits", faults) else {
        return Vec::new();
    };
    let ranges = limits.spans_of_elements("limits_deg");
    let rates = limits.spans_of_elements("speeds_deg_s");
    let places = |index: usize| LimitPlaces {
        range: ranges.get(index).copied(),
        rate: rates.get(index).copied(),
    };
    (0..axes.len()).map(places).collect()
}

#[cfg(test)]
pub(crate) mod tests;
