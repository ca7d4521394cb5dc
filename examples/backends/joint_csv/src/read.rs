//! Rows to statements. Nothing is taken from the writer but the names of the columns.

use crate::{AXES, COLUMNS, COMMENT, DECIMALS, EXTENSION};
use vcutc_backend_api::backend::Options;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{AxisValues, Switch};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::readback::{
    Command, Configuration, Effect, End, Frames, Held, Pace, Place, Reader, Resolution, Sources, Statement,
    Target,
};
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// Reads tables.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CsvReader;

impl Reader for CsvReader {
    fn recognises(&self, file: &str) -> bool {
        file.rsplit_once('.')
            .is_some_and(|(_, extension)| extension.eq_ignore_ascii_case(EXTENSION))
    }

    fn resolution(&self, options: &Options) -> Resolution {
        let unit = (0..options.integer(DECIMALS)).fold(1.0, |unit, _| unit / 10.0);
        let half = 0.5 * unit;
        Resolution {
            length: Length::mm(half),
            attitude: Angle::deg(half),
            axis: Angle::deg(half),
            speed: Speed::mm_per_s(half),
            rate: AngularSpeed::deg_per_s(half),
            per_minute: half,
            time: Duration::s(half),
        }
    }

    fn frames(&self) -> Frames {
        Frames::OnMachine
    }

    /// A row says all axes, and with them the way to stand.
    fn configuration(&self, _branch: Branch, _axes: AxisValues) -> Option<Configuration> {
        None
    }

    fn read(&self, sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
        for (number, file) in (0..).zip(sources.files) {
            let mut start = 0;
            for whole in file.text.split_inclusive('\n') {
                let line = whole.trim_end();
                let place = place(number, start, line.len());
                start += whole.len();
                if !(line.is_empty() || line.starts_with(COMMENT)) {
                    visit(Statement {
                        place,
                        effect: effect(line),
                    });
                }
            }
        }
    }
}

fn place(file: u32, start: usize, length: usize) -> Place {
    let byte = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    Place {
        file,
        start: byte(start),
        end: byte(start.saturating_add(length)),
    }
}

fn effect(line: &str) -> Effect {
    let columns: Vec<&str> = line.split(',').map(str::trim).collect();
    let Ok(columns) = <[&str; COLUMNS.len()]>::try_from(columns) else {
        let count = COLUMNS.len();
        return unreadable(format!("{count} columns"));
    };
    if columns == COLUMNS {
        return Effect::Setting;
    }
    let [_, _, does, x, y, z, a1, a2, a3, a4, a5, a6, tip, turn, value] = columns;
    let axes = || axes([a1, a2, a3, a4, a5, a6]);
    let command = match does {
        "axes" => axes().map(Command::Axes),
        "move" => target([x, y, z], axes()).and_then(|to| {
            Some(Command::Straight {
                to,
                pace: Pace::Speeds {
                    tip: optional(tip)?.map(Speed::mm_per_s),
                    turn: optional(turn)?.map(AngularSpeed::deg_per_s),
                },
                end: End::Exact,
            })
        }),
        "switch" => switch(value),
        "await" => value.parse().ok().map(Command::AwaitInput),
        "wait" => number(value).map(|seconds| Command::Wait(Duration::s(seconds))),
        _ => return Effect::Unknown,
    };
    command.map_or_else(|| unreadable(format!("the columns of `{does}`")), Effect::Command)
}

fn unreadable(expected: String) -> Effect {
    Effect::Unreadable { expected }
}

fn axes(columns: [&str; AXES]) -> Option<AxisValues> {
    let mut values = [0.0; AXES];
    for (value, column) in values.iter_mut().zip(columns) {
        *value = Angle::deg(number(column)?).to_rad();
    }
    Some(AxisValues(values))
}

/// All axes of an arm are rotary, so they say how the blade is held.
fn target([x, y, z]: [&str; 3], axes: Option<AxisValues>) -> Option<Target> {
    Some(Target {
        tip: Point3::new(number(x)?, number(y)?, number(z)?),
        held: Held::Rotary(axes?),
    })
}

fn switch(value: &str) -> Option<Command> {
    let (output, state) = value.split_once('=')?;
    let state = match state {
        "on" => Switch::On,
        "off" => Switch::Off,
        _ => return None,
    };
    Some(Command::Switch {
        output: output.parse().ok()?,
        state,
    })
}

/// A number that may be left out; none when there is something else.
fn optional(column: &str) -> Option<Option<f64>> {
    if column.is_empty() {
        Some(None)
    } else {
        number(column).map(Some)
    }
}

fn number(column: &str) -> Option<f64> {
    let is_plain = column
        .chars()
        .all(|letter| letter.is_ascii_digit() || "+-.".contains(letter));
    let number: f64 = column.parse().ok().filter(|_| is_plain)?;
    number.is_finite().then_some(number)
}
