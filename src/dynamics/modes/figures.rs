//! The modes of an arm over the cuts of a program, for people and for programs.

use super::Mode;
use crate::chain::JOINTS;
use crate::condition::hundredths;
use crate::figures::word;
use crate::springs::Springs;
use serde::{Serialize, Serializer};
use vcutc_diagnostics::number::{rounded, show};
use vcutc_machine::Model;
use vcutc_machine::masses::Backing;

/// How many modes the summary states.
const STATED: usize = 3;

/// How an arm swings by itself over the cuts of a program: at samples of each, with masses and stiffness as they are stated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModeFigures {
    /// From the slowest on.
    pub modes: Vec<ModeFigure>,
    /// How far the masses are backed.
    #[serde(serialize_with = "word")]
    pub masses: Backing,
    /// How far the stiffness of the joints is backed.
    #[serde(serialize_with = "word")]
    pub stiffness: Backing,
}

/// A mode over the cuts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModeFigure {
    /// Its lowest frequency, in Hz.
    #[serde(serialize_with = "thousandths")]
    pub lowest: f64,
    /// Its highest, in Hz.
    #[serde(serialize_with = "thousandths")]
    pub highest: f64,
    /// The axis whose joint yields most where the mode is slowest.
    pub axis: String,
    /// Its share of the energy in all joints.
    #[serde(serialize_with = "hundredths")]
    pub share: f64,
}

/// What is found of a mode.
#[derive(Clone, Copy)]
struct Range {
    slowest: Mode,
    highest: f64,
}

impl Range {
    const fn of(mode: Mode) -> Self {
        Self {
            slowest: mode,
            highest: mode.frequency,
        }
    }

    fn extend(&mut self, mode: Mode) {
        if mode.frequency < self.slowest.frequency {
            self.slowest = mode;
        }
        self.highest = self.highest.max(mode.frequency);
    }
}

fn thousandths<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value, 1e3))
}

/// The modes over the cuts of a program, as far as they have been looked at.
#[derive(Default)]
pub(super) struct Ranges(Option<[Range; JOINTS]>);

impl Ranges {
    /// Takes the modes at a sample.
    pub(super) fn take(&mut self, here: &[Mode; JOINTS]) {
        let ranges = self.0.get_or_insert_with(|| here.map(Range::of));
        for (range, mode) in ranges.iter_mut().zip(here) {
            range.extend(*mode);
        }
    }

    /// None where nothing is cut.
    pub(super) fn figures(self, model: &Model) -> Option<ModeFigures> {
        let masses = model.masses.as_ref()?;
        let elasticity = model.elasticity.as_ref()?;
        let springs = Springs::from(elasticity);
        let ranges = self.0?;
        Some(ModeFigures {
            modes: ranges
                .iter()
                .map(|range| figure(range, model, &springs))
                .collect(),
            masses: masses.backing,
            stiffness: elasticity.backing,
        })
    }
}

impl ModeFigures {
    /// `the slowest at 7.7 to 9.9 Hz, 10.3 to 11.8 Hz, 20.2 to 25.4 Hz over the cuts, at samples; masses published, stiffness measured`.
    #[must_use]
    pub fn line(&self) -> String {
        let slowest: Vec<String> = self.modes.iter().take(STATED).map(ModeFigure::words).collect();
        format!(
            "the slowest at {} over the cuts, at samples; {}",
            slowest.join(", "),
            self.backing(),
        )
    }

    /// `masses published, stiffness measured`.
    #[must_use]
    pub fn backing(&self) -> String {
        format!(
            "masses {}, stiffness {}",
            self.masses.word(),
            self.stiffness.word()
        )
    }
}

fn figure(range: &Range, model: &Model, springs: &Springs) -> ModeFigure {
    let (axis, share) = range.slowest.softest(springs);
    let axis = model.axes.get(axis);
    ModeFigure {
        lowest: range.slowest.frequency,
        highest: range.highest,
        axis: axis.map_or_else(String::new, |axis| axis.name.clone()),
        share,
    }
}

impl ModeFigure {
    /// `7.7 to 9.9 Hz`.
    #[must_use]
    pub fn words(&self) -> String {
        let [lowest, highest] = [self.lowest, self.highest].map(|frequency| show(rounded(frequency, 10.0)));
        if lowest == highest {
            format!("{lowest} Hz")
        } else {
            format!("{lowest} to {highest} Hz")
        }
    }
}
