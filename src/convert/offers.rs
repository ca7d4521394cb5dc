//! Options that would settle what a program leaves open. Each is tried before it is offered: what a message
//! says to write works.

use super::asked::Asked;
use super::axes::{Axis, Direction, Sense};
use super::feeds::feeds;
use super::milling::Milling;
use super::settled;
use core::fmt;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_geometry::grid;

/// A program that is not a raster as it is read, and what may make it one.
pub(super) struct Unsettled {
    /// What is wrong. The first is what the offers are for.
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) offers: Vec<Offer>,
}

/// An option, and when it is right.
#[derive(Clone, Debug)]
pub(super) struct Offer {
    /// `if the file's zero lies at its top in z`; without what follows from it.
    pub(super) when: String,
    pub(super) option: Choice,
}

/// What an option says.
#[derive(Clone, Copy, Debug)]
pub(super) enum Choice {
    Along(Axis),
    Up(Direction),
    /// In mm, in the axes of the file.
    Origin([f64; 3]),
    /// In mm.
    Stock([f64; 3]),
    Clearance(Length),
    Tolerance(Length),
}

impl From<Box<Diagnostic>> for Unsettled {
    fn from(diagnostic: Box<Diagnostic>) -> Self {
        Self {
            diagnostics: vec![*diagnostic],
            offers: Vec::new(),
        }
    }
}

impl Unsettled {
    /// With offers after those that there are.
    pub(super) fn offering(mut self, offers: impl IntoIterator<Item = Offer>) -> Self {
        self.offers.extend(offers);
        self
    }

    /// What is wrong, with a help line for every offer that makes a raster of the program.
    pub(super) fn tried(self, milling: &Milling, asked: &Asked) -> Vec<Diagnostic> {
        let offers = working(self.offers, milling, asked);
        let mut found = self.diagnostics;
        if let Some(first) = found.first_mut() {
            first.help.extend(offers.iter().map(Offer::to_string));
            if offers.is_empty()
                && let Some(noise) = noise(milling, asked)
            {
                first.help.push(noise);
            }
        }
        found
    }
}

/// The offers with which nothing is wrong; if there are none, those with which only speeds are.
fn working(offers: Vec<Offer>, milling: &Milling, asked: &Asked) -> Vec<Offer> {
    let mut whole = Vec::new();
    let mut without_speeds = Vec::new();
    for offer in offers {
        let asked = offer.option.with(asked);
        let Ok(settled) = settled(milling, &asked) else {
            continue;
        };
        match feeds(milling, &settled.raster, &asked, &mut Vec::new()) {
            Ok(_) => whole.push(offer),
            Err(_) => without_speeds.push(offer),
        }
    }
    let mut working = if whole.is_empty() { without_speeds } else { whole };
    working.truncate(MOST_OFFERS);
    working
}

/// With more ways to go on, none is offered.
const MOST_OFFERS: usize = 4;

/// Tolerances that are tried where a program is not a raster, in mm.
const COARSER: [f64; 6] = [0.02, 0.05, 0.1, 0.2, 0.5, 1.0];

/// The least tolerance by which the program is a raster, if it is noise that keeps it from being one.
fn noise(milling: &Milling, asked: &Asked) -> Option<String> {
    let mut coarser = COARSER
        .into_iter()
        .map(Length::mm)
        .filter(|&coarser| coarser > asked.tolerance);
    coarser.find_map(|coarser| {
        let option = Choice::Tolerance(coarser);
        let passes = settled(milling, &option.with(asked)).ok()?.raster.passes.len();
        Some(format!(
            "if this is rounding noise: with `{option}` the program is a raster of {passes} passes"
        ))
    })
}

impl Choice {
    fn with(self, asked: &Asked) -> Asked {
        let mut asked = asked.clone();
        match self {
            Self::Along(axis) => asked.along = Some(axis),
            Self::Up(direction) => asked.up = direction,
            Self::Origin(corner) => asked.origin = Some(corner.map(grid::nearest)),
            Self::Stock(sizes) => asked.stock = sizes.map(grid::nearest),
            Self::Clearance(height) => asked.clearance = Some(height),
            Self::Tolerance(tolerance) => asked.tolerance = tolerance,
        }
        asked
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Along(axis) => write!(f, "--along {}", axis.letter()),
            Self::Up(Direction { axis, sense }) => {
                let sign = match sense {
                    Sense::Positive => "",
                    Sense::Negative => "-",
                };
                write!(f, "--up {sign}{}", axis.letter())
            }
            Self::Origin(corner) => write!(f, "--origin {}", corner.map(show).join(",")),
            Self::Stock(sizes) => write!(f, "--stock {}", sizes.map(show).join("x")),
            Self::Clearance(height) => write!(f, "--clearance {}mm", show(height.to_mm())),
            Self::Tolerance(tolerance) => write!(f, "--tolerance {}mm", show(tolerance.to_mm())),
        }
    }
}

impl fmt::Display for Offer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: `{}`", self.when, self.option)
    }
}
