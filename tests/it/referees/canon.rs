//! What LinuxCNC's interpreter makes of a program: its canonical functions, as `rs274` prints them, a line each.
//!
//! Every function is known here by name. One that is not fails the test, for nobody would have looked at what it does.

/// Axis values in the order X Y Z A B C, in mm and degrees.
pub(super) type Position = [f64; 6];

/// What the machine would do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Canon {
    /// A straight motion with a speed.
    Feed {
        /// Where it ends.
        to: Position,
        /// How long it takes, by LinuxCNC's rule: F counts along X, Y, Z where these move, along the rotary axes otherwise.
        seconds: f64,
    },
    /// A straight motion at the rates of the axes.
    Traverse {
        /// Where it ends.
        to: Position,
    },
    /// A digital output is switched.
    Output {
        /// Its number.
        number: u32,
        /// On or off.
        on: bool,
    },
    /// A number is put out: the sample configurations choose their kinematics by one.
    Value {
        /// The number of the output.
        number: u32,
        /// What is put out.
        value: f64,
    },
    /// A wait, in s.
    Dwell(f64),
    /// The end of the program.
    End,
}

/// Functions that move nothing and switch nothing. The feed rate, which is followed, is not among them.
const SETTINGS: &[&str] = &[
    "COMMENT",
    "MESSAGE",
    "ON_RESET",
    "PALLET_SHUTTLE",
    "SELECT_PLANE",
    "SET_FEED_MODE",
    "SET_FEED_REFERENCE",
    "SET_G5X_OFFSET",
    "SET_G92_OFFSET",
    "SET_MOTION_CONTROL_MODE",
    "SET_NAIVECAM_TOLERANCE",
    "SET_SPINDLE_MODE",
    "SET_XY_ROTATION",
    "STOP_SPINDLE_TURNING",
    "USE_LENGTH_UNITS",
    "USE_TOOL_LENGTH_OFFSET",
];

/// The largest motion that counts as none: half of what is printed.
pub(super) const NOTHING: f64 = 0.000_05;

/// Reads what `rs274` printed.
pub(super) fn read(text: &str) -> Result<Vec<Canon>, String> {
    let mut canon = Vec::new();
    let mut at: Option<Position> = None;
    let mut feed = 0.0;
    for line in text.lines() {
        let fault = || format!("cannot read `{line}`");
        // A number of the line, the N word of the block or dots, and the function.
        let call = line
            .trim_start()
            .splitn(3, char::is_whitespace)
            .nth(2)
            .ok_or_else(fault)?;
        let (name, arguments) = call.trim().split_once('(').ok_or_else(fault)?;
        let arguments = arguments.strip_suffix(')').ok_or_else(fault)?;
        if SETTINGS.contains(&name) {
            continue;
        }
        let numbers: Result<Vec<f64>, _> = arguments
            .split(',')
            .filter(|text| !text.trim().is_empty())
            .map(|text| text.trim().parse::<f64>())
            .collect();
        let numbers = numbers.map_err(|_| fault())?;
        canon.push(match (name, &numbers[..]) {
            ("SET_FEED_RATE", &[rate]) => {
                feed = rate;
                continue;
            }
            ("STRAIGHT_FEED", _) => {
                let to = Position::try_from(numbers).map_err(|_| fault())?;
                let seconds = at.map_or(f64::NAN, |from| way(&from, &to) / feed * 60.0);
                at = Some(to);
                Canon::Feed { to, seconds }
            }
            ("STRAIGHT_TRAVERSE", _) => {
                let to = Position::try_from(numbers).map_err(|_| fault())?;
                at = Some(to);
                Canon::Traverse { to }
            }
            ("SET_AUX_OUTPUT_BIT" | "SET_MOTION_OUTPUT_BIT", &[number]) => output(number, true),
            ("CLEAR_AUX_OUTPUT_BIT" | "CLEAR_MOTION_OUTPUT_BIT", &[number]) => output(number, false),
            ("SET_AUX_OUTPUT_VALUE" | "SET_MOTION_OUTPUT_VALUE", &[number, value]) => Canon::Value {
                number: number as u32,
                value,
            },
            ("DWELL", &[seconds]) => Canon::Dwell(seconds),
            ("PROGRAM_END", []) => Canon::End,
            _ => return Err(fault()),
        });
    }
    Ok(canon)
}

fn output(number: f64, on: bool) -> Canon {
    let number = number as u32;
    Canon::Output { number, on }
}

/// The way that F counts along.
fn way(from: &Position, to: &Position) -> f64 {
    let length = |axes: core::ops::Range<usize>| {
        let squares = axes.map(|axis| (to[axis] - from[axis]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    match length(0..3) {
        along if along > NOTHING => along,
        _ => length(3..6),
    }
}
