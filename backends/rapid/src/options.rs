//! The options block `rapid { ... }` of a job, and the habits of its machine.
//!
//! [`OPTIONS`] is what the compiler checks a job against; [`Settings`] is the same as types, so that the rest of the crate
//! never asks for a key by its name.

use crate::keywords::{TOOL, WORK_OBJECT};
use core::num::NonZeroU32;
use vcutc_backend_api::backend::{OptionKind, OptionSpec, Options};
use vcutc_backend_api::ir::{Cell, PlacedFrame};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::units::Length;

const DECIMALS: &str = "decimals";
pub(crate) const LINES_PER_PART: &str = "lines_per_part";
const HEADER: &str = "header";
const APPROXIMATION: &str = "approximation";
const HOME_SPEED: &str = "home_speed";
pub(crate) const TOOL_NAME: &str = "tool_name";
pub(crate) const WORK_OBJECT_NAME: &str = "wobj_name";
pub(crate) const ULTRASONIC_SIGNAL: &str = "ultrasonic_signal";
pub(crate) const READY_SIGNAL: &str = "ready_signal";

/// All options, in the order of the documentation.
pub(crate) const OPTIONS: &[OptionSpec] = &[
    OptionSpec {
        key: DECIMALS,
        kind: OptionKind::Integer {
            min: 3,
            max: 6,
            default: 3,
        },
        help: "Decimals of lengths in mm; axis angles get one more, up to six.",
    },
    OptionSpec {
        key: LINES_PER_PART,
        kind: OptionKind::Integer {
            min: 0,
            max: 1_000_000,
            default: 5000,
        },
        help: "Lines after which the program is split into parts at the next travel move; 0 never splits.",
    },
    OptionSpec {
        key: HEADER,
        kind: OptionKind::Lines,
        help: "Comment lines put at the head of the main module.",
    },
    OptionSpec {
        key: APPROXIMATION,
        kind: OptionKind::Length {
            min: Length::ZERO,
            max: Length::mm(50.0),
            default: Length::ZERO,
        },
        help: "Zone in which a corner in the air may be rounded; 0 mm stops at every point.",
    },
    OptionSpec {
        key: HOME_SPEED,
        kind: OptionKind::Integer {
            min: 1,
            max: 5000,
            default: 250,
        },
        help: "Tip speed of the moves of all axes, to home and from there, in mm/s.",
    },
    OptionSpec {
        key: TOOL_NAME,
        kind: OptionKind::Text,
        help: "Name of the tooldata; tool3 when the job gives the number 3, vc_tool when it gives values.",
    },
    OptionSpec {
        key: WORK_OBJECT_NAME,
        kind: OptionKind::Text,
        help: "Name of the wobjdata; wobj2 when the job gives the number 2, vc_wobj when it gives values.",
    },
    OptionSpec {
        key: ULTRASONIC_SIGNAL,
        kind: OptionKind::Text,
        help: "Name of the output of the generator; do12 for output(12) when not given.",
    },
    OptionSpec {
        key: READY_SIGNAL,
        kind: OptionKind::Text,
        help: "Name of the input that tells the generator is up; di7 for input(7) when not given.",
    },
];

/// The options as types.
#[derive(Clone, Debug)]
pub(crate) struct Settings<'p> {
    /// Format of lengths in mm.
    pub(crate) lengths: FixedDecimal,
    /// Format of axis angles in degrees: 0.001 deg over 3 m of arm is 0.05 mm, so one decimal more than lengths.
    pub(crate) angles: FixedDecimal,
    /// Longest body of a part, when there is a limit.
    pub(crate) lines_per_part: Option<NonZeroU32>,
    /// Comment lines at the head.
    pub(crate) header: &'p [String],
    /// Rounding of corners in the air, when wanted.
    pub(crate) approximation: Option<Length>,
    /// Tip speed of the moves of all axes, in mm/s.
    pub(crate) home_speed: u32,
    /// The habits of the machine.
    pub(crate) profile: &'p Profile,
    options: &'p Options,
}

impl<'p> Settings<'p> {
    /// Reads the options of a job.
    pub(crate) fn read(options: &'p Options) -> Self {
        let profile = options.profile();
        let asked = u8::try_from(options.integer(DECIMALS)).unwrap_or(u8::MAX);
        let decimals = profile.decimals.unwrap_or(asked);
        let approximation = options.length(APPROXIMATION);
        Self {
            lengths: FixedDecimal::new(decimals),
            angles: FixedDecimal::new(decimals.saturating_add(1)),
            lines_per_part: NonZeroU32::new(options.integer(LINES_PER_PART)),
            header: options.lines(HEADER),
            approximation: (approximation > Length::ZERO).then_some(approximation),
            home_speed: options.integer(HOME_SPEED),
            profile,
            options,
        }
    }

    /// A name that the job may give; none when it leaves it open.
    pub(crate) fn given(&self, key: &str) -> Option<&'p str> {
        Some(self.options.text(key)).filter(|text| !text.is_empty())
    }

    /// The name of the tooldata that the moves of a program refer to.
    pub(crate) fn tool(&self, cell: &Cell) -> String {
        self.frame(TOOL_NAME, cell.tool, "tool", TOOL)
    }

    /// The name of the wobjdata that the moves of a program refer to.
    pub(crate) fn work_object(&self, cell: &Cell) -> String {
        self.frame(WORK_OBJECT_NAME, cell.base, "wobj", WORK_OBJECT)
    }

    fn frame(&self, key: &str, placed: PlacedFrame, numbered: &str, own: &str) -> String {
        match (self.given(key), placed.number) {
            (Some(name), _) => name.to_owned(),
            (None, Some(number)) => format!("{numbered}{number}"),
            (None, None) => own.to_owned(),
        }
    }

    /// The name of a digital output.
    pub(crate) fn output(&self, number: u32) -> String {
        let named = || format!("do{number}");
        self.given(ULTRASONIC_SIGNAL).map_or_else(named, str::to_owned)
    }

    /// The name of a digital input.
    pub(crate) fn input(&self, number: u32) -> String {
        let named = || format!("di{number}");
        self.given(READY_SIGNAL).map_or_else(named, str::to_owned)
    }

    /// Extension of modules.
    pub(crate) fn extension(&self) -> &'p str {
        self.profile.extension.as_deref().unwrap_or("mod")
    }
}

/// The six members of the zone of rounded corners behind its first, in the proportions of ABB's own z1: reorientation and
/// external axes begin to be rounded where the tip does, and turns at a tenth of it in degrees.
pub(crate) fn zone_members(distance: Length) -> [f64; 6] {
    let path = distance.to_mm();
    let turn = path / 10.0;
    [path, path, path, turn, path, turn]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use vcutc_backend_api::backend::OptionValue;

    #[test]
    fn keys_are_unique() {
        let keys: BTreeSet<_> = OPTIONS.iter().map(|spec| spec.key).collect();
        assert_eq!(keys.len(), OPTIONS.len());
    }

    #[test]
    fn what_is_set_is_read() {
        let mut options = Options::defaults(OPTIONS);
        let values = [
            (DECIMALS, OptionValue::Integer(4)),
            (LINES_PER_PART, OptionValue::Integer(0)),
            (APPROXIMATION, OptionValue::Length(Length::mm(2.5))),
            (HOME_SPEED, OptionValue::Integer(30)),
            (ULTRASONIC_SIGNAL, OptionValue::Text("doKnife".to_owned())),
        ];
        for (key, value) in values {
            let spec = OPTIONS.iter().find(|spec| spec.key == key).unwrap();
            options.set(spec, value).unwrap();
        }
        let settings = Settings::read(&options);
        assert_eq!((settings.lengths.decimals(), settings.angles.decimals()), (4, 5));
        assert_eq!(settings.lines_per_part, None);
        assert_eq!(settings.approximation, Some(Length::mm(2.5)));
        assert_eq!(settings.home_speed, 30);
        assert_eq!(
            (settings.output(12), settings.input(7)),
            ("doKnife".to_owned(), "di7".to_owned())
        );
    }

    #[test]
    fn the_profile_of_the_machine_has_the_last_word_on_decimals() {
        let profile = Profile {
            decimals: Some(5),
            ..Profile::default()
        };
        let options = Options::defaults(OPTIONS).with_profile(profile);
        assert_eq!(Settings::read(&options).lengths.decimals(), 5);
    }
}
