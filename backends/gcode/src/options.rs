//! The options block `gcode { ... }` of a job.
//!
//! [`OPTIONS`] is what the compiler checks a job against; [`Settings`] is the same as types, so that the rest of the
//! crate never asks for a key by its name.

use crate::codes::Role;
use crate::controller::{Codes, Controller, Facts};
use crate::controllers;
use vcutc_backend_api::backend::{OptionSpec, Options};
use vcutc_backend_api::ir::Purpose;
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::script::{Common, approximation, decimals, header, lines_per_part};

const DIALECT: &str = "dialect";
/// In percent. A job that gives it cannot be distinguished from one that leaves it out.
pub(crate) const DEFAULT_HOME_SPEED: u32 = 10;
pub(crate) const HOME_SPEED: &str = "home_speed";
pub(crate) const TOOL_NUMBER: &str = "tool_number";
pub(crate) const PROGRAM_NUMBER: &str = "program_number";
pub(crate) const SPINDLE_AXIS: &str = "spindle_axis";

pub(crate) const PERCENT: f64 = 100.0;

/// The letters by which a controller may know the spindle as an axis; the first says that it does not.
const SPINDLE_LETTERS: &[&str] = &["none", "a", "b", "c"];

/// All options, in the order of the documentation.
pub(crate) const OPTIONS: &[OptionSpec] = &[
    OptionSpec::choice(
        DIALECT,
        controllers::WORDS,
        "The controller that is to read the program.",
    ),
    decimals("Decimals of lengths in mm; angles get one more where the dialect reads it, up to six."),
    lines_per_part(
        0,
        "Lines after which the program is split into subprograms, where the tip is above the stock; 0 never splits.",
    ),
    header("Comment lines put at the head of the main program."),
    approximation("How far corners in the air may be rounded; 0 mm stops at every point."),
    OptionSpec::integer(
        HOME_SPEED,
        (1, 100),
        DEFAULT_HOME_SPEED,
        "Speed of the moves of all axes, to home and from there, in percent of the axes' rates; Fanuc makes them at its rapid rate.",
    ),
    OptionSpec::integer(
        TOOL_NUMBER,
        (1, 9999),
        1,
        "Entry of the controller's tool table that holds the blade's length, when the machine's `tool` has no number; on Sinumerik the edge D of the tool in the spindle, 1 to 9.",
    ),
    OptionSpec::integer(
        PROGRAM_NUMBER,
        (1, 9999),
        1,
        "Fanuc's O number of the main program; parts have the numbers after it. An air cut adds 4000, or takes 3999 away from 4000 on.",
    ),
    OptionSpec::choice(
        SPINDLE_AXIS,
        SPINDLE_LETTERS,
        "Letter by which the controller moves an orientable spindle (axis S) as an axis.",
    ),
    OptionSpec::lines(
        Role::TcpOn.key(),
        "LinuxCNC: what switches to the kinematics with tool-centre-point control, such as \"M429\".",
    ),
    OptionSpec::lines(
        Role::TcpOff.key(),
        "LinuxCNC: what switches back to the kinematics in which words are axis values, such as \"M428\".",
    ),
    OptionSpec::lines(
        Role::On.key(),
        "Block that switches the ultrasonic generator on, such as \"M50\", where the dialect has no word for an output.",
    ),
    OptionSpec::lines(Role::Off.key(), "Block that switches it off, such as \"M51\"."),
    OptionSpec::lines(
        Role::Ready.key(),
        "Block that ends when the generator is ready, such as \"M52\", where the dialect has no word that waits for an input.",
    ),
];

/// The options as types.
#[derive(Clone)]
pub(crate) struct Settings<'p> {
    /// What every dialect takes.
    pub(crate) common: Common<'p>,
    /// The controller that reads the program.
    pub(crate) controller: &'static dyn Controller,
    /// Format of angles in degrees.
    pub(crate) angles: FixedDecimal,
    /// Speed of the moves of all axes as a part of the axes' rates.
    pub(crate) home_speed: f64,
    /// Entry of the tool table for a tool without a number.
    pub(crate) tool_number: u32,
    /// O number of the main program.
    pub(crate) program_number: u32,
    /// Letter of the spindle as an axis.
    pub(crate) spindle_letter: Option<u8>,
    /// What only the builder of the machine knows.
    pub(crate) codes: Codes<'p>,
}

/// How far the O number of an air cut is from that of its job: half the numbers that are free for programs of users.
const AIR_NUMBERS: u32 = 4000;

impl<'p> Settings<'p> {
    /// Reads the options of a job.
    pub(crate) fn read(options: &'p Options) -> Self {
        let controller = controllers::of(options.choice(DIALECT));
        // The compiler has set them to what the profile says, unless the job says otherwise.
        let common = Common::read(options);
        Self {
            common,
            controller,
            angles: FixedDecimal::new(
                common
                    .decimals
                    .saturating_add(controller.facts().more_decimals_of_angles),
            ),
            home_speed: f64::from(options.integer(HOME_SPEED)) / PERCENT,
            tool_number: options.integer(TOOL_NUMBER),
            program_number: options.integer(PROGRAM_NUMBER),
            spindle_letter: match options.choice(SPINDLE_AXIS) {
                "a" => Some(b'A'),
                "b" => Some(b'B'),
                "c" => Some(b'C'),
                _ => None,
            },
            codes: Codes {
                tcp_on: options.lines(Role::TcpOn.key()),
                tcp_off: options.lines(Role::TcpOff.key()),
                on: options.lines(Role::On.key()),
                off: options.lines(Role::Off.key()),
                ready: options.lines(Role::Ready.key()),
            },
        }
    }

    /// As a program for that purpose is written: an air cut has an O number of its own, or it would take the place of the
    /// program that cuts in the control's memory.
    pub(crate) const fn of(mut self, purpose: Purpose) -> Self {
        self.program_number = match purpose {
            Purpose::Work => self.program_number,
            Purpose::AirCut { .. } if self.program_number < AIR_NUMBERS => self.program_number + AIR_NUMBERS,
            Purpose::AirCut { .. } => self.program_number - AIR_NUMBERS + 1,
        };
        self
    }

    /// What is fixed of the controller.
    pub(crate) fn facts(&self) -> &'static Facts {
        self.controller.facts()
    }

    /// Format of speeds, inverse times and waits: written without trailing zeros, so these are the most decimals.
    pub(crate) fn fine(&self) -> FixedDecimal {
        FixedDecimal::new(self.controller.facts().fine_decimals)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use vcutc_backend_api::backend::OptionValue;
    use vcutc_backend_api::profile::Profile;
    use vcutc_backend_api::script::{APPROXIMATION, DECIMALS};
    use vcutc_backend_api::units::Length;

    #[test]
    fn what_is_set_is_read() {
        let mut options = Options::defaults(OPTIONS);
        for (key, value) in [
            (DIALECT, OptionValue::Choice("fanuc")),
            (DECIMALS, OptionValue::Integer(4)),
            (APPROXIMATION, OptionValue::Length(Length::mm(2.5))),
            (HOME_SPEED, OptionValue::Integer(30)),
            (SPINDLE_AXIS, OptionValue::Choice("b")),
            (Role::On.key(), OptionValue::Lines(vec!["M50".to_owned()])),
        ] {
            let spec = OPTIONS.iter().find(|spec| spec.key == key).unwrap();
            options.set(spec, value).unwrap();
        }
        let settings = Settings::read(&options);
        assert_eq!(settings.controller.facts().name, "Fanuc");
        assert_eq!(settings.common.lengths.decimals(), 4);
        assert_eq!(settings.common.approximation, Some(Length::mm(2.5)));
        assert_eq!(settings.home_speed.to_bits(), 0.3_f64.to_bits());
        assert_eq!(settings.spindle_letter, Some(b'B'));
        assert_eq!(settings.codes.on, ["M50"]);
        assert_eq!(settings.common.lines_per_part, None);
    }

    #[test]
    fn every_dialect_has_its_word() {
        let spec = OPTIONS.iter().find(|spec| spec.key == DIALECT).unwrap();
        let names: BTreeSet<&str> = controllers::WORDS
            .iter()
            .map(|word| {
                let mut options = Options::defaults(OPTIONS);
                options.set(spec, OptionValue::Choice(word)).unwrap();
                let name = Settings::read(&options).controller.facts().name;
                assert_eq!(name.to_ascii_lowercase(), *word);
                name
            })
            .collect();
        assert_eq!(names.len(), controllers::WORDS.len());
    }

    #[test]
    fn an_option_counts_more_than_a_profile() {
        let profile = Profile {
            decimals: Some(5),
            ..Profile::default()
        };
        let mut options = Options::defaults(OPTIONS).with_profile(profile);
        let spec = OPTIONS.iter().find(|spec| spec.key == DECIMALS).unwrap();
        options.set(spec, OptionValue::Integer(4)).unwrap();
        assert_eq!(Settings::read(&options).common.lengths.decimals(), 4);
    }
}
