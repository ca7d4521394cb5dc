//! The options block `krl { ... }` of a job.
//!
//! [`OPTIONS`] is what the compiler checks a job against; [`Settings`] is the same as types, so that the rest of the
//! crate never asks for a key by its name.

use crate::syntax::Planner;
use vcutc_backend_api::backend::{OptionSpec, Options};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::script::{Common, approximation, decimals, header, lines_per_part};

const MOTION: &str = "motion";
const DECLARE_PARTS: &str = "declare_parts";
const HOME_SPEED: &str = "home_speed";
/// Key of the name of the routine that changes blades.
pub(crate) const CHANGE_ROUTINE: &str = "change_routine";

const CLASSIC: &str = "classic";
const SPLINE: &str = "spline";
const NO: &str = "no";
const YES: &str = "yes";

/// All options, in the order of the documentation.
pub(crate) const OPTIONS: &[OptionSpec] = &[
    decimals("Decimals of lengths in mm; angles get one more, up to six."),
    lines_per_part(
        2500,
        "Lines after which the program is split into parts at the next travel move; 0 never splits.",
    ),
    header("Comment lines put at the head of the main program."),
    approximation(
        "How far from a corner in the air the robot may start rounding it; 0 mm stops at every point.",
    ),
    OptionSpec::choice(
        MOTION,
        &[CLASSIC, SPLINE],
        "Motion planner: classic writes PTP and LIN, spline writes SPTP and SLIN (KSS 8 and later).",
    ),
    OptionSpec::choice(
        DECLARE_PARTS,
        &[NO, YES],
        "Whether the main program declares its parts with EXT lines, as old releases demand.",
    ),
    OptionSpec::text(
        CHANGE_ROUTINE,
        "Routine of the cell that changes the blade; it is called with the place of the new one.",
    ),
    OptionSpec::integer(
        HOME_SPEED,
        (1, 100),
        10,
        "Axis speed of the moves of all axes, to home and from there, in percent of the greatest.",
    ),
];

impl Planner {
    /// The word of a move of all axes.
    pub(crate) const fn axes(self) -> &'static [u8] {
        match self {
            Self::Classic => b"PTP",
            Self::Spline => b"SPTP",
        }
    }

    /// The word of a straight move, with the start of its target.
    pub(crate) const fn straight(self) -> &'static [u8] {
        match self {
            Self::Classic => b"LIN {X ",
            Self::Spline => b"SLIN {X ",
        }
    }

    /// The word of a move on an arc, with the start of its auxiliary point.
    pub(crate) const fn round(self) -> &'static [u8] {
        match self {
            Self::Classic => b"CIRC {X ",
            Self::Spline => b"SCIRC {X ",
        }
    }

    /// The word after a move that may be rounded.
    pub(crate) const fn approximate(self) -> &'static [u8] {
        match self {
            Self::Classic => b" C_DIS",
            Self::Spline => b" C_SPL",
        }
    }
}

/// How the main program makes its parts known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartNames {
    /// The controller finds them by their file names.
    Global,
    /// By `EXT` lines.
    Declared,
}

/// The options as types.
#[derive(Clone, Debug)]
pub(crate) struct Settings<'p> {
    /// What every dialect takes.
    pub(crate) common: Common<'p>,
    /// Format of angles in degrees: 0.001 deg at the end of a 300 mm blade is 5 um, so one decimal more than lengths.
    pub(crate) angles: FixedDecimal,
    /// Which motion planner of the controller moves the robot. The two do not blend into each other, so a program keeps to one
    /// [K-SI].
    pub(crate) planner: Planner,
    /// How parts are made known.
    pub(crate) part_names: PartNames,
    /// The routine of the cell that changes the blade; empty where none is named.
    pub(crate) change_routine: &'p str,
    /// Speed of the moves of all axes, in percent.
    pub(crate) home_speed: u32,
}

impl<'p> Settings<'p> {
    /// Reads the options of a job.
    pub(crate) fn read(options: &'p Options) -> Self {
        // The compiler has set them to what the profile says, unless the job says otherwise.
        let common = Common::read(options);
        Self {
            common,
            angles: FixedDecimal::new(common.decimals.saturating_add(1)),
            planner: match options.choice(MOTION) {
                SPLINE => Planner::Spline,
                _ => Planner::Classic,
            },
            part_names: match options.choice(DECLARE_PARTS) {
                YES => PartNames::Declared,
                _ => PartNames::Global,
            },
            change_routine: options.text(CHANGE_ROUTINE),
            home_speed: options.integer(HOME_SPEED),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::backend::OptionValue;
    use vcutc_backend_api::script::{APPROXIMATION, DECIMALS, LINES_PER_PART};
    use vcutc_backend_api::units::Length;

    #[test]
    fn what_is_set_is_read() {
        let mut options = Options::defaults(OPTIONS);
        let values = [
            (DECIMALS, OptionValue::Integer(4)),
            (LINES_PER_PART, OptionValue::Integer(0)),
            (APPROXIMATION, OptionValue::Length(Length::mm(2.5))),
            (MOTION, OptionValue::Choice(SPLINE)),
            (DECLARE_PARTS, OptionValue::Choice(YES)),
            (HOME_SPEED, OptionValue::Integer(30)),
        ];
        for (key, value) in values {
            let spec = OPTIONS.iter().find(|spec| spec.key == key).unwrap();
            options.set(spec, value).unwrap();
        }
        let settings = Settings::read(&options);
        assert_eq!(
            (settings.common.lengths.decimals(), settings.angles.decimals()),
            (4, 5)
        );
        assert_eq!(settings.common.lines_per_part, None);
        assert_eq!(settings.common.approximation, Some(Length::mm(2.5)));
        assert_eq!(settings.planner, Planner::Spline);
        assert_eq!(settings.part_names, PartNames::Declared);
        assert_eq!(settings.home_speed, 30);
    }
}
