//! What LinuxCNC's interpreter makes of a program: its canonical functions, as `rs274` prints them, a line each.
//!
//! Every function is known here by name. One that is not fails the test: what it does would not have been
//! looked at.

/// Axis values in the order X Y Z A B C, in mm and degrees.
pub(super) type Position = [f64; 6];

/// What the machine would do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Canon {
    /// A straight motion with a speed.
    Feed {
        /// Where it ends.
        to: Position,
        /// How fast: mm a minute along X, Y, Z where these move, degrees a minute along the rotary axes otherwise.
        rate: f64,
    },
    /// A motion on an arc with a speed along it.
    Arc {
        /// Where it ends.
        to: Position,
        /// The point about which X, Y, Z go.
        centre: [f64; 3],
        /// The axis about which they go, by the rule of the right hand.
        axis: [f64; 3],
        /// How fast: mm a minute along the arc.
        rate: f64,
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
    /// What X, Y, Z are is chosen.
    Kinematics(Kinematics),
    /// How motions end from here on is chosen.
    Control(Control),
    /// The blade is said to have this length, in mm.
    ToolLength(f64),
    /// The tool of this place is put into the spindle.
    ChangeTool(u32),
    /// The program stands until a person lets it go on.
    Stop,
    /// A wait, in s.
    Dwell(f64),
    /// The end of the program.
    End,
}

/// What X, Y, Z of a motion are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kinematics {
    /// Positions of the axes.
    Axes,
    /// The place of the tip: tip control is on.
    Tip,
}

/// How a motion ends that another follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Control {
    /// It stands still at its end.
    ExactStop,
    /// It goes through its end, and need not stand still.
    ExactPath,
    /// It may cut the corner.
    Continuous {
        /// By how much, in mm; infinite when not said.
        tolerance: f64,
    },
}

/// The output that chooses the kinematics, as in the sample configurations.
pub(super) const KINEMATICS: u32 = 3;

/// Functions that move nothing and switch nothing. The feed rate, which is followed, is not among them.
const SETTINGS: &[&str] = &[
    "COMMENT",
    "MESSAGE",
    "ON_RESET",
    "PALLET_SHUTTLE",
    "SELECT_TOOL",
    "SET_FEED_MODE",
    "SET_FEED_REFERENCE",
    "SET_G5X_OFFSET",
    "SET_G92_OFFSET",
    "SET_NAIVECAM_TOLERANCE",
    "SET_SPINDLE_MODE",
    "SET_SPINDLE_SPEED",
    "SET_XY_ROTATION",
    "START_CHANGE",
    "USE_LENGTH_UNITS",
];

/// The output that stands for the control's own spindle.
pub(super) const SPINDLE: u32 = u32::MAX;

/// The largest motion that counts as none: half of what is printed.
pub(super) const NOTHING: f64 = 0.000_05;

/// Reads what `rs274` printed.
pub(super) fn read(text: &str) -> Result<Vec<Canon>, String> {
    let mut canon = Vec::new();
    let (mut feed, mut plane) = (0.0, None);
    let mut spins = false;
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
        if matches!(name, "START_SPINDLE_CLOCKWISE" | "STOP_SPINDLE_TURNING") {
            // The interpreter stops it at the end of every program, whether it turns or not.
            let on = name == "START_SPINDLE_CLOCKWISE";
            if core::mem::replace(&mut spins, on) != on {
                canon.push(Canon::Output { number: SPINDLE, on });
            }
            continue;
        }
        if name == "SET_MOTION_CONTROL_MODE" {
            canon.push(Canon::Control(control(arguments).ok_or_else(fault)?));
            continue;
        }
        if name == "SELECT_PLANE" {
            plane = Some(in_plane(arguments).ok_or_else(fault)?);
            continue;
        }
        if name == "USE_TOOL_LENGTH_OFFSET" {
            canon.push(Canon::ToolLength(tool_length(arguments).ok_or_else(fault)?));
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
                Canon::Feed { to, rate: feed }
            }
            ("ARC_FEED", numbers) => arc(numbers, plane, feed).ok_or_else(fault)?,
            ("STRAIGHT_TRAVERSE", _) => {
                let to = Position::try_from(numbers).map_err(|_| fault())?;
                Canon::Traverse { to }
            }
            ("SET_AUX_OUTPUT_BIT" | "SET_MOTION_OUTPUT_BIT", &[number]) => output(number, true),
            ("CLEAR_AUX_OUTPUT_BIT" | "CLEAR_MOTION_OUTPUT_BIT", &[number]) => output(number, false),
            ("SET_AUX_OUTPUT_VALUE", &[number, value]) if number == f64::from(KINEMATICS) => {
                Canon::Kinematics(kinematics(value).ok_or_else(fault)?)
            }
            ("CHANGE_TOOL", &[place]) => Canon::ChangeTool(place as u32),
            ("PROGRAM_STOP", []) => Canon::Stop,
            ("DWELL", &[seconds]) => Canon::Dwell(seconds),
            ("PROGRAM_END", []) => Canon::End,
            _ => return Err(fault()),
        });
    }
    Ok(canon)
}

/// The first and second axis of a plane and the one square to it, from 0.
fn in_plane(name: &str) -> Option<[usize; 3]> {
    match name {
        "CANON_PLANE_XY" => Some([0, 1, 2]),
        "CANON_PLANE_XZ" => Some([2, 0, 1]),
        "CANON_PLANE_YZ" => Some([1, 2, 0]),
        _ => None,
    }
}

/// The end in the plane, the centre there, turns to the left, the end along the axis, and the rotary axes.
fn arc(numbers: &[f64], plane: Option<[usize; 3]>, rate: f64) -> Option<Canon> {
    let &[to_first, to_second, first, second, turns, to_along, a, b, c] = numbers else {
        return None;
    };
    let [on_first, on_second, along] = plane?;
    let (mut to, mut centre, mut axis) = ([0.0, 0.0, 0.0, a, b, c], [0.0; 3], [0.0; 3]);
    (to[on_first], to[on_second], to[along]) = (to_first, to_second, to_along);
    (centre[on_first], centre[on_second], centre[along]) = (first, second, to_along);
    // More turns than one are not an arc of ours.
    axis[along] = if turns == 1.0 || turns == -1.0 {
        turns
    } else {
        return None;
    };
    Some(Canon::Arc {
        to,
        centre,
        axis,
        rate,
    })
}

fn output(number: f64, on: bool) -> Canon {
    let number = number as u32;
    Canon::Output { number, on }
}

/// The kinematics that a value of their output selects.
fn kinematics(value: f64) -> Option<Kinematics> {
    match value {
        0.0 => Some(Kinematics::Axes),
        1.0 => Some(Kinematics::Tip),
        _ => None,
    }
}

/// A mode of control and, for one, its tolerance, where 0 stands for none.
fn control(arguments: &str) -> Option<Control> {
    match arguments.split_once(',') {
        None if arguments == "CANON_EXACT_STOP" => Some(Control::ExactStop),
        None if arguments == "CANON_EXACT_PATH" => Some(Control::ExactPath),
        Some(("CANON_CONTINUOUS", tolerance)) => {
            let said: f64 = tolerance.trim().parse().ok()?;
            let tolerance = if said > 0.0 { said } else { f64::INFINITY };
            Some(Control::Continuous { tolerance })
        }
        None | Some(_) => None,
    }
}

/// The length of a tool that has nothing but a length: the third of nine numbers.
fn tool_length(arguments: &str) -> Option<f64> {
    let numbers: Result<Vec<f64>, _> = arguments
        .split([',', ' '])
        .filter(|text| !text.is_empty())
        .map(str::parse)
        .collect();
    match numbers.ok()?[..] {
        [0.0, 0.0, length, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0] => Some(length),
        _ => None,
    }
}
