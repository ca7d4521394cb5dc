//! The checks in words, and as data for other programs.

use super::{About, Check, Checks, Outcome, Reason, Standing};
use serde::Serialize;

/// A check as data.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CheckFigure {
    /// Its permanent name.
    pub check: &'static str,
    /// The axis that it is about, if it is about one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<String>,
    /// The blades that it is about, where it is about some of the job's only.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub blades: Vec<String>,
    pub made: bool,
    /// The permanent name of the reason, where it was not made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
    /// The reason in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub words: Option<&'static str>,
}

impl Checks {
    /// What is proven, as a sentence without a full stop.
    #[must_use]
    pub fn proven(&self) -> String {
        let mut parts = Vec::new();
        if self.is_made(&Check::Chips) && self.is_made(&Check::Part) {
            let by = if self.is_made(&Check::Tracks) {
                " of roughing"
            } else {
                ""
            };
            parts.push(format!(
                "every chip{by} comes free and no cut{by} enters the part or its allowance"
            ));
        }
        if self.is_made(&Check::Tracks) {
            parts.push(
                "in sections across the tracks on the surface every strip comes free and no more stays than may, and on its way \
                 from pose to pose the disc enters the surface by no more than is allowed"
                    .to_owned(),
            );
        }
        if self.is_made(&Check::Pockets) {
            parts.push(
                "the tool keeps off the walls and floors of its pockets, and leaves no more uncut of what it reaches than may stay"
                    .to_owned(),
            );
        }
        if self.is_made(&Check::Walls) {
            parts.push(
                "the blade keeps off the walls that it slits, and leaves no more at their foot than may stay, acute corners apart"
                    .to_owned(),
            );
        }
        if self.is_made(&Check::AboveStock) {
            parts.push("the tip stays above the stock".to_owned());
        }
        if self.is_made(&Check::Holder(Vec::new())) {
            parts.push("the body of the blade stays out of the stock".to_owned());
        }
        if self.is_made(&Check::AxisLimits) {
            parts.push(self.of_motions());
        }
        if self.is_made(&Check::Torques) {
            parts.push("at programmed speeds no axis needs more torque than its drive gives".to_owned());
        }
        if self.is_made(&Check::Deviation) {
            parts.push(
                "at rest, the forces of its blades push no flank or wall off by more than the stated deviation"
                    .to_owned(),
            );
        }
        if self.is_made(&Check::Unloaded) {
            parts.push("where less pushes the blade, no compensated cut enters the part".to_owned());
        }
        if self.is_made(&Check::ReadBack) {
            parts.push("the written text reads back as the same program".to_owned());
        }
        parts.join("; ")
    }

    /// What is proven of the motions of the machine.
    fn of_motions(&self) -> String {
        let (kept, unknown) = self.axes();
        let bounds = match (kept.as_slice(), unknown.as_slice()) {
            ([], _) => "the position limits of its axes".to_owned(),
            (_, []) => "the position and speed limits of its axes".to_owned(),
            (kept, _) => format!(
                "the position limits of its axes and the speed limits of {}",
                listed(kept)
            ),
        };
        let clear = if self.is_made(&Check::SingularPoses) {
            " and clear of singularities"
        } else {
            ""
        };
        format!("the machine carries out every motion within {bounds}{clear}")
    }

    /// What is not checked, each with the reason; nothing where all is.
    #[must_use]
    pub fn not_checked(&self) -> Option<String> {
        let mut by_reason: Vec<(Reason, Vec<String>)> = Vec::new();
        let (kept, unknown) = self.axes();
        let mut add =
            |reason: Reason, what: String| match by_reason.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, all)) if all.contains(&what) => {}
                Some((_, all)) => all.push(what),
                None => by_reason.push((reason, vec![what])),
            };
        for checked in self.iter() {
            if let Outcome::NotMade(reason) = checked.outcome {
                add(
                    reason,
                    match &checked.check {
                        Check::AxisRate(_) if kept.is_empty() => "the speeds of all axes".to_owned(),
                        Check::AxisRate(_) => format!("the speeds of {}", listed(&unknown)),
                        Check::Holder(blades) => format!("shank and holder of {}", bodies_of(blades)),
                        other => other.what().to_owned(),
                    },
                );
            }
        }
        let parts: Vec<String> = by_reason
            .iter()
            .map(|(reason, what)| format!("{} ({})", what.join(", "), reason.words()))
            .collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The names of the axes whose rates are kept, and of those whose rates are not known.
    pub(super) fn axes(&self) -> (Vec<&str>, Vec<&str>) {
        let (mut kept, mut unknown) = (Vec::new(), Vec::new());
        for checked in self.iter() {
            if let Check::AxisRate(axis) = &checked.check {
                match checked.outcome {
                    Outcome::Made => kept.push(axis.as_str()),
                    Outcome::NotMade(_) => unknown.push(axis.as_str()),
                }
            }
        }
        (kept, unknown)
    }

    /// All of them as data.
    #[must_use]
    pub fn figures(&self) -> Vec<CheckFigure> {
        let figure = |checked: &super::Checked| {
            let reason = match checked.outcome {
                Outcome::Made => None,
                Outcome::NotMade(reason) => Some(reason),
            };
            let (axis, blades) = match checked.check.about() {
                About::Rate(axis) => (Some(axis.to_owned()), Vec::new()),
                About::Bodies(blades) => (None, blades.to_vec()),
                About::SingularPoses | About::ElbowAngle | About::Motions | About::Others => {
                    (None, Vec::new())
                }
            };
            CheckFigure {
                check: checked.check.name(),
                axis,
                blades,
                made: reason.is_none(),
                reason: reason.map(Reason::name),
                words: reason.map(Reason::words),
            }
        };
        self.iter().map(figure).collect()
    }
}

/// The blades whose shank and holder a check is about.
pub(super) fn bodies_of(blades: &[String]) -> String {
    let quoted: Vec<String> = blades.iter().map(|blade| format!("`{blade}`")).collect();
    let names: Vec<&str> = quoted.iter().map(String::as_str).collect();
    match names.as_slice() {
        [] => "the blade".to_owned(),
        names => listed(names),
    }
}

impl Check {
    /// Its permanent name in messages for programs.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Chips => "chips",
            Self::Part => "part",
            Self::Tracks => "tracks",
            Self::Pockets => "pockets",
            Self::Walls => "walls",
            Self::BetweenSections => "between_sections",
            Self::AboveStock => "above_stock",
            Self::AxisLimits => "axis_limits",
            Self::AxisRate(_) => "axis_rate",
            Self::SingularPoses => "singular_poses",
            Self::Branch => "configuration",
            Self::ElbowAngle => "elbow_angle",
            Self::Turns => "turns",
            Self::Torques => "torques",
            Self::Deviation => "deviation",
            Self::Unloaded => "unloaded",
            Self::Accelerations => "accelerations",
            Self::Holder(_) => "holder",
            Self::Collisions => "collisions",
            Self::ReadBack => "read_back",
        }
    }

    /// What is not checked where it was not made.
    const fn what(&self) -> &'static str {
        match self {
            Self::Chips => "whether chips come free",
            Self::Part => "whether cuts enter the part",
            Self::Tracks => "tracks on the surface",
            Self::Pockets => "passes over pockets",
            Self::Walls => "slits along walls",
            Self::BetweenSections => "what comes free and what stays between sections across the tracks",
            Self::AboveStock => "whether the tip stays above the stock",
            Self::AxisLimits => "reach and the limits of axes",
            Self::AxisRate(_) => "the speed of an axis",
            Self::SingularPoses => "the distance from singularities",
            Self::Branch => "the configuration of the arm",
            Self::ElbowAngle => "the angle between the arms, J3 - J2",
            Self::Turns => "the sweep of the edge where the blade turns beside the work",
            Self::Torques => "torques of the axes",
            Self::Deviation => "how far the forces of the blade push it off",
            Self::Unloaded => "whether compensated cuts enter the part where less pushes the blade",
            Self::Accelerations => "times with accelerations",
            Self::Holder(_) => "shank and holder of the blade",
            Self::Collisions => "collisions of the machine",
            Self::ReadBack => "the written text",
        }
    }
}

impl Reason {
    /// Its permanent name in messages for programs.
    const fn name(self) -> &'static str {
        match self {
            Self::NoMachine => "no_machine",
            Self::NotStated => "not_stated",
            Self::NoPlaceForIt => "no_place_for_it",
            Self::NotMeasured => "not_measured",
            Self::NoBody => "no_body",
            Self::Indicative => "indicative",
            Self::NoHome => "no_home",
            Self::AirCut => "air_cut",
            Self::NoReader => "no_reader",
            Self::SectionsOnly => "sections_only",
            Self::NoLoad => "no_load",
            Self::NotComputed => "not_computed",
            Self::Disc => "disc",
            Self::NoForces => "no_forces",
            Self::PlacesOnly => "places_only",
        }
    }

    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::NoMachine => "the job has no machine",
            Self::NotStated => "not known for this machine",
            Self::NoPlaceForIt => "descriptions of machines cannot state its range",
            Self::NotMeasured => "not measured for an arm without a closed-form solution",
            Self::NoBody => "their shapes are not known",
            Self::NoHome => "the job states no home, so where the first motion starts is not known",
            Self::Indicative => "the masses and limits are not all those of this machine",
            Self::AirCut => "an air cut is compared with nothing but the top of the stock",
            Self::NoReader => "the target has no reader",
            Self::SectionsOnly => "sections are looked at, 10 mm apart or 200 of them",
            Self::NoLoad => "the job does not state the load on the flange",
            Self::NotComputed => "not computed for such a machine",
            Self::Disc => "not computed for surfaces under a disc",
            Self::NoForces => "not all blades state their forces",
            Self::PlacesOnly => {
                "places are looked at, at most 25 mm of the tip's way or 5 deg of turning apart"
            }
        }
    }
}

impl Standing {
    /// The word before what is proven.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Proven => "Proven",
            Self::InPart => "Proven in part",
        }
    }

    /// Its permanent name in messages for programs.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Proven => "proven",
            Self::InPart => "in_part",
        }
    }
}

/// `A1, A2 and A3`.
pub(super) fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
