//! The deviations of a program for people and for programs.

use super::{Deviations, Extreme, Unknown};
use crate::arms::Arms;
use crate::blade::{EngagedPart, PushedBlade};
use crate::condition::{Condition, hundredths, thousandths};
use crate::cuts::{Cuts, Known, LargestForce};
use crate::figures::word;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{OpId, OperationId};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::{number, show};
use vcutc_geometry::number::Interval;
use vcutc_job::{BladeRef, Gravity};
use vcutc_machine::masses::Backing;
use vcutc_motion::describe::site_words;
use vcutc_motion::figures::PlaceFigure;

/// How far the forces of its blades push the cuts of a program off.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeviationFigures {
    pub force: ForceFigure,
    /// Of the operations whose blades state their forces.
    pub operations: Vec<OperationDeviation>,
    /// How far the stiffness of the joints is backed.
    #[serde(serialize_with = "word")]
    pub stiffness: Backing,
    /// What the weight of the arm does; none where its masses or the load are not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<GravityFigure>,
    /// Cuts that differ from how the forces were measured, blade by blade.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub elsewhere: Vec<Elsewhere>,
}

/// The largest force on a blade, in N.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForceFigure {
    #[serde(serialize_with = "hundredths")]
    pub force: f64,
    #[serde(serialize_with = "hundredths")]
    pub drag: f64,
    #[serde(serialize_with = "hundredths")]
    pub axial: f64,
    #[serde(serialize_with = "hundredths")]
    pub side: f64,
    /// How much of the blade is in the material, in mm.
    #[serde(serialize_with = "hundredths")]
    pub engaged: f64,
    /// What of it that is.
    pub part: EngagedPart,
    /// The largest moment about the tip of any blade, in Nm.
    #[serde(serialize_with = "thousandths")]
    pub moment: f64,
    pub at: PlaceFigure,
}

/// How far the cuts of an operation are off at most.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OperationDeviation {
    /// Which, from 0.
    pub operation: u16,
    pub into_waste: ShiftFigure,
    pub into_part: ShiftFigure,
    /// While the edge comes into the material and the arm swings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_entry: Option<EntryFigure>,
    /// How far its tips are offset; none where it is not compensated. Where they are, `into_waste` and `into_part` are meant under
    /// load: while all of the edge that a cut uses is in the material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensation: Option<CompensationFigure>,
    /// How many times as much where the ultrasound fails, when that is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failed: Option<f64>,
    /// The most that it may be, in mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
}

/// How far tips are offset against the forces of the blade.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CompensationFigure {
    /// At most, in mm.
    #[serde(serialize_with = "tenths_of_um")]
    pub offset: f64,
    pub at: PlaceFigure,
    /// How far flanks lie deeper than planned, at most, in mm, whatever stretches of the edge are in the material.
    #[serde(serialize_with = "tenths_of_um")]
    pub deeper: f64,
}

/// The most that cuts are off to one side: nowhere more.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShiftFigure {
    /// In mm.
    #[serde(serialize_with = "tenths_of_um")]
    pub most: f64,
    pub at: PlaceFigure,
    /// The axis that yields most there.
    pub axis: String,
    /// Its share of what all axes yield.
    #[serde(serialize_with = "hundredths")]
    pub share: f64,
}

/// How far the cuts of an operation may be off while the edge comes into the material from rest, or leaves it from rest: nowhere on them
/// more, whatever the masses and the damping of the arm are.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EntryFigure {
    pub into_waste: SwingFigure,
    pub into_part: SwingFigure,
}

/// The most that cuts are off to one side while the arm swings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SwingFigure {
    /// In mm.
    #[serde(serialize_with = "tenths_of_um")]
    pub most: f64,
    pub at: PlaceFigure,
}

/// What the weight of the arm does to the flanks of the cuts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GravityFigure {
    /// By how much the sag along the normals of the flanks changes over the cuts, at most, in mm.
    #[serde(serialize_with = "tenths_of_um")]
    pub change: f64,
    pub counted: Counted,
}

/// Whether the change of sag is part of the deviation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Counted {
    /// The control takes the sag out.
    Compensated,
    /// It does not: half of the change counts, either way.
    Uncompensated,
    /// The job does not state what the control does: it does not count.
    NotStated,
}

/// A cut that is farthest from how the forces of its blade were measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Elsewhere {
    pub blade: String,
    pub cut: Condition,
    pub at: PlaceFigure,
}

/// What figures are asked of.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The blades that state their forces, by their names.
    pub blades: &'a BTreeMap<&'a str, PushedBlade<'a>>,
    /// The limits of the operations, in order.
    pub limits: &'a [Option<Length>],
    pub gravity: Option<Gravity>,
}

fn tenths_of_um<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64((value * 1e4).ceil() / 1e4 + 0.0)
}

impl DeviationFigures {
    /// Of cuts by an arm that weighs so, where that is known.
    ///
    /// # Errors
    /// Why its deviations are not known.
    pub fn of(cuts: &Cuts<'_>, arms: Option<&Arms>, asked: Asked<'_>) -> Result<Self, Unknown> {
        let known = *cuts.known();
        let largest = cuts.largest_force().ok_or(Unknown::Forces)?;
        let deviations = Deviations::of(cuts, arms).ok_or(Unknown::Elasticity)?;
        let backing = known
            .model
            .elasticity
            .as_ref()
            .ok_or(Unknown::Elasticity)?
            .backing;
        let sag = deviations.sag();
        if sag.is_none() && asked.gravity == Some(Gravity::Uncompensated) {
            return Err(Unknown::Weight);
        }
        let gravity = sag.map(|sag| sagging(sag, asked.gravity));
        let sag = Length::mm(gravity.map_or(0.0, GravityFigure::either_way));
        let operations = (0..).map(OperationId).zip(asked.limits);
        let operation = |(operation, limit): (OperationId, &Option<Length>)| {
            let bounds = deviations.bounds(operation, limit.map(|limit| limit - sag))?;
            Some(OperationDeviation {
                operation: operation.0,
                into_waste: shift(known, bounds.at_rest.into_waste, sag),
                into_part: shift(known, bounds.at_rest.into_part, sag),
                at_entry: bounds.at_entry.map(|extremes| EntryFigure {
                    into_waste: swing(known, extremes.into_waste, sag),
                    into_part: swing(known, extremes.into_part, sag),
                }),
                compensation: deviations.offsets(operation).map(|offset| CompensationFigure {
                    offset: offset.most.to_mm(),
                    at: place(known, offset.op),
                    deeper: offset.deeper.to_mm(),
                }),
                failed: failed(known, asked, operation),
                limit: limit.map(Length::to_mm),
            })
        };
        Ok(Self {
            force: force(known, largest),
            operations: operations.filter_map(operation).collect(),
            stiffness: backing,
            gravity,
            elsewhere: cuts
                .elsewhere()
                .into_iter()
                .map(|(blade, op, cut)| Elsewhere {
                    blade,
                    cut,
                    at: place(known, op),
                })
                .collect(),
        })
    }

    /// The deviation of an operation; none of one that no forces are known of, or whose deviation is not computed.
    #[must_use]
    pub fn of_operation(&self, operation: OperationId) -> Option<&OperationDeviation> {
        self.operations.iter().find(|of| of.operation == operation.0)
    }

    /// The lines of a summary: names and texts.
    #[must_use]
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let mut lines = vec![("force", self.force.line())];
        let worst = |side: fn(&OperationDeviation) -> &ShiftFigure| {
            let all = self.operations.iter().map(|of| (of, side(of)));
            all.max_by(|(_, one), (_, other)| one.most.total_cmp(&other.most))
        };
        let side = |(of, shift): (&OperationDeviation, &ShiftFigure), into: &str| {
            let under_load = of.compensation.as_ref().map_or("", |_| " under load");
            format!(
                "{}{under_load} into the {into} ({})",
                millimetres(shift.most),
                shift.words()
            )
        };
        if let (Some(waste), Some(part)) = (worst(|of| &of.into_waste), worst(|of| &of.into_part)) {
            let failed = self.operations.iter().filter_map(|of| of.failed);
            let failed = failed.reduce(f64::max).map_or_else(String::new, |times| {
                format!(", {} times as much where the ultrasound fails", show(times))
            });
            let sag = self.gravity.map_or(0.0, GravityFigure::either_way);
            let sag = if sag > 0.0 {
                format!(", {} of it by the sag of the arm", millimetres(sag))
            } else {
                String::new()
            };
            lines.push((
                "deviation",
                format!(
                    "{}, {}, at most, by the forces of the blade{sag}{failed}; stiffness {}",
                    side(waste, "waste"),
                    side(part, "part"),
                    self.stiffness.word(),
                ),
            ));
        }
        lines.extend(self.compensation_line().map(|line| ("compensated", line)));
        lines.extend(self.entry_line().map(|line| ("at entry", line)));
        lines.extend(self.gravity.map(|gravity| ("gravity", gravity.line())));
        lines
    }

    /// `tips offset by up to 0.034 mm (layer 1, cut 4); flanks lie up to 0.031 mm deeper than planned where less pushes the blade`.
    fn compensation_line(&self) -> Option<String> {
        let all = self.operations.iter().filter_map(|of| of.compensation.as_ref());
        let farthest = all
            .clone()
            .max_by(|one, other| one.offset.total_cmp(&other.offset))?;
        let deeper = all.map(|of| of.deeper).fold(0.0, f64::max);
        Some(format!(
            "tips offset by up to {} ({}); flanks lie up to {} deeper than planned where less pushes the blade",
            millimetres(farthest.offset),
            farthest.at.words,
            millimetres(deeper),
        ))
    }

    /// `up to 0.0103 mm into the waste (layer 1, cut 4), 0.0082 mm into the part (layer 1, cut 4), as the edge comes in and the arm swings`.
    fn entry_line(&self) -> Option<String> {
        let worst = |side: fn(&EntryFigure) -> &SwingFigure| {
            let all = self.operations.iter().filter_map(|of| of.at_entry.as_ref());
            all.map(side).max_by(|one, other| one.most.total_cmp(&other.most))
        };
        let (waste, part) = (
            worst(|entry| &entry.into_waste)?,
            worst(|entry| &entry.into_part)?,
        );
        Some(format!(
            "up to {} into the waste ({}), {} into the part ({}), while the edge comes in from rest and the arm swings",
            millimetres(waste.most),
            waste.at.words,
            millimetres(part.most),
            part.at.words,
        ))
    }
}

/// To a tenth of a micrometre, upward.
#[must_use]
pub fn millimetres(most: f64) -> String {
    format!("{} mm", number((most * 1e4).ceil() / 1e4))
}

/// How many times as much the blades of an operation push where the ultrasound fails: the most of them.
fn failed(known: Known<'_>, asked: Asked<'_>, operation: OperationId) -> Option<f64> {
    let blades = known.reached.program().blades_of(operation);
    let stating = blades.filter_map(|blade| asked.blades.get(blade.name.as_str()));
    // Of discs no deviation is computed.
    let deviating = stating.filter(|pushed| !matches!(pushed.blade, BladeRef::Disc(_)));
    let failed = deviating.filter_map(|pushed| pushed.blade.forces()?.failed());
    failed.reduce(f64::max)
}

fn place(known: Known<'_>, op: OpId) -> PlaceFigure {
    let program = known.reached.program();
    let words = program.op(op).map(|op| site_words(program, op.site));
    PlaceFigure {
        op: op.0,
        words: words.unwrap_or_default(),
    }
}

fn force(known: Known<'_>, largest: LargestForce) -> ForceFigure {
    ForceFigure {
        force: largest.force.to_n(),
        drag: largest.parts.drag.to_n(),
        axial: largest.parts.axial.to_n(),
        side: largest.parts.side.to_n(),
        engaged: largest.engaged.to_mm(),
        moment: largest.moment,
        part: largest.part,
        at: place(known, largest.op),
    }
}

fn shift(known: Known<'_>, extreme: Extreme, sag: Length) -> ShiftFigure {
    let (axis, share) = extreme.softest;
    ShiftFigure {
        most: (extreme.most + sag).to_mm(),
        at: place(known, extreme.op),
        axis: known
            .model
            .axes
            .get(axis)
            .map_or_else(String::new, |axis| axis.name.clone()),
        share,
    }
}

fn swing(known: Known<'_>, extreme: Extreme, sag: Length) -> SwingFigure {
    SwingFigure {
        most: (extreme.most + sag).to_mm(),
        at: place(known, extreme.op),
    }
}

fn sagging(sag: Interval, gravity: Option<Gravity>) -> GravityFigure {
    GravityFigure {
        change: sag.width(),
        counted: match gravity {
            Some(Gravity::Compensated) => Counted::Compensated,
            Some(Gravity::Uncompensated) => Counted::Uncompensated,
            None => Counted::NotStated,
        },
    }
}

impl GravityFigure {
    /// What of it counts as deviation either way, in mm.
    pub(super) const fn either_way(self) -> f64 {
        match self.counted {
            Counted::Compensated | Counted::NotStated => 0.0,
            Counted::Uncompensated => 0.5 * self.change,
        }
    }

    fn line(self) -> String {
        let counted = match self.counted {
            Counted::Compensated => "not counted, as the control compensates it",
            Counted::Uncompensated => "half of it counted either way",
            Counted::NotStated => "not counted, as the machine does not state `gravity`",
        };
        format!(
            "the sag of the arm along the normals of these flanks changes by up to {}; {counted}",
            millimetres(self.change),
        )
    }
}

impl ForceFigure {
    fn line(&self) -> String {
        let [force, drag, axial, side] = [self.force, self.drag, self.axial, self.side]
            .map(|newtons| show((newtons * 10.0).round() / 10.0));
        let [along, across] = match self.part {
            EngagedPart::Edge => ["drag", "side"],
            EngagedPart::Rim => ["drag", "radial"],
            EngagedPart::Teeth => ["along the feed", "across it"],
        };
        format!(
            "{force} N at most (parts: {along} up to {drag}, axial {axial}, {across} {side}) at {}, on {} mm of {}",
            self.at.words,
            show((self.engaged * 10.0).round() / 10.0),
            self.part.word(),
        )
    }
}

impl ShiftFigure {
    /// `layer 1, cut 4; 62 % of the push by A4`.
    #[must_use]
    pub fn words(&self) -> String {
        format!(
            "{}; {:.0} % of the push by {}",
            self.at.words,
            100.0 * self.share,
            self.axis
        )
    }
}
