//! The options block `rapid { ... }` of a job.
//!
//! [`OPTIONS`] is what the compiler checks a job against; [`Settings`] is the same as types, so that the rest of the crate
//! never asks for a key by its name.

use crate::names::{TOOL, WORK_OBJECT};
use vcutc_backend_api::backend::{OptionSpec, Options};
use vcutc_backend_api::ir::{Cell, PlacedFrame, Spindle, ToolId};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::script::{Common, approximation, decimals, header, lines_per_part};
use vcutc_backend_api::units::Length;

const HOME_SPEED: &str = "home_speed";
pub(crate) const TOOL_NAME: &str = "tool_name";
pub(crate) const WORK_OBJECT_NAME: &str = "wobj_name";
pub(crate) const ULTRASONIC_SIGNAL: &str = "ultrasonic_signal";
pub(crate) const SPINDLE_SIGNAL: &str = "spindle_signal";
pub(crate) const READY_SIGNAL: &str = "ready_signal";
pub(crate) const CHANGE_ROUTINE: &str = "change_routine";

/// All options, in the order of the documentation.
pub(crate) const OPTIONS: &[OptionSpec] = &[
    decimals("Decimals of lengths in mm; axis angles get one more, up to six."),
    lines_per_part(
        5000,
        "Lines after which the program is split into parts at the next travel move; 0 never splits.",
    ),
    header("Comment lines put at the head of the main module."),
    approximation("Zone in which a corner in the air may be rounded; 0 mm stops at every point."),
    OptionSpec::integer(
        HOME_SPEED,
        (1, 5000),
        250,
        "Tip speed of the moves of all axes, to home and from there, in mm/s.",
    ),
    OptionSpec::text(
        TOOL_NAME,
        "Name of the tooldata; tool3 when the job gives the number 3, vc_tool when it gives values.",
    ),
    OptionSpec::text(
        WORK_OBJECT_NAME,
        "Name of the wobjdata; wobj2 when the job gives the number 2, vc_wobj when it gives values.",
    ),
    OptionSpec::text(
        ULTRASONIC_SIGNAL,
        "Name of the output of the generator; do12 for output(12) when not given.",
    ),
    OptionSpec::text(
        SPINDLE_SIGNAL,
        "Name of the output of the spindle; do13 for output(13) when not given.",
    ),
    OptionSpec::text(
        READY_SIGNAL,
        "Name of the input that says that the generator is up; di7 for input(7) when not given.",
    ),
    OptionSpec::text(
        CHANGE_ROUTINE,
        "Routine of the cell that changes the blade; it is called with the place of the new one.",
    ),
];

/// The options as types.
#[derive(Clone, Debug)]
pub(crate) struct Settings<'p> {
    /// What every dialect takes.
    pub(crate) common: Common<'p>,
    /// Format of axis angles in degrees: 0.001 deg over 3 m of arm is 0.05 mm, so one decimal more than lengths.
    pub(crate) angles: FixedDecimal,
    /// Tip speed of the moves of all axes, in mm/s.
    pub(crate) home_speed: u32,
    options: &'p Options,
}

impl<'p> Settings<'p> {
    /// Reads the options of a job.
    pub(crate) fn read(options: &'p Options) -> Self {
        // The compiler has set them to what the profile says, unless the job says otherwise.
        let common = Common::read(options);
        Self {
            common,
            angles: FixedDecimal::new(common.decimals.saturating_add(1)),
            home_speed: options.integer(HOME_SPEED),
            options,
        }
    }

    /// A name that the job may give; none when it leaves it open.
    pub(crate) fn given(&self, key: &str) -> Option<&'p str> {
        Some(self.options.text(key)).filter(|text| !text.is_empty())
    }

    /// The name of the tooldata that moves with a tool refer to.
    pub(crate) fn tool(&self, cell: &Cell, id: ToolId) -> String {
        let placed = cell.tools.at(id).frame;
        match (id, placed.number) {
            (ToolId::FIRST, _) => self.frame(TOOL_NAME, placed, "tool", TOOL),
            (_, Some(number)) => format!("tool{number}"),
            (ToolId(index), None) => format!("{TOOL}{}", u32::from(index) + 1),
        }
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
    pub(crate) fn output(&self, cell: &Cell, number: u32) -> String {
        let named = || format!("do{number}");
        let key = match cell.spindle {
            Some(Spindle::Output(spindle)) if spindle == number => SPINDLE_SIGNAL,
            Some(_) | None => ULTRASONIC_SIGNAL,
        };
        self.given(key).map_or_else(named, str::to_owned)
    }

    /// The name of a digital input.
    pub(crate) fn input(&self, number: u32) -> String {
        let named = || format!("di{number}");
        self.given(READY_SIGNAL).map_or_else(named, str::to_owned)
    }

    /// Extension of modules.
    pub(crate) fn extension(&self) -> &'p str {
        self.common.profile.extension.as_deref().unwrap_or("mod")
    }
}

/// The six members of the zone of rounded corners after its first, in the proportions of ABB's own z1:
/// reorientation and external axes begin to be rounded where the tip does, and turns at a tenth of it in
/// degrees.
pub(crate) fn zone_members(distance: Length) -> [f64; 6] {
    let path = distance.to_mm();
    let turn = path / 10.0;
    [path, path, path, turn, path, turn]
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::backend::OptionValue;
    use vcutc_backend_api::script::{APPROXIMATION, DECIMALS, LINES_PER_PART};

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
        assert_eq!(
            (settings.common.lengths.decimals(), settings.angles.decimals()),
            (4, 5)
        );
        assert_eq!(settings.common.lines_per_part, None);
        assert_eq!(settings.common.approximation, Some(Length::mm(2.5)));
        assert_eq!(settings.home_speed, 30);
        assert_eq!(
            (
                settings.given(ULTRASONIC_SIGNAL).map(str::to_owned),
                settings.input(7)
            ),
            (Some("doKnife".to_owned()), "di7".to_owned())
        );
    }
}
