//! Lists of numbers on the command line: axis values, poses, quaternions.

use crate::cli::console::Failure;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{Axis, AxisKind};
use vcutc_backend_api::units::Angle;

/// Largest number that can be meant, in mm or deg.
const LARGEST: f64 = 1e6;

/// How far the length of a quaternion may be from 1. Pendants show four to six digits.
const LENGTH_TOLERANCE: f64 = 1e-3;

/// Poses are written so.
const POSE: &[&str] = &["mm", "mm", "mm", "deg", "deg", "deg"];

/// Numbers with commas between them, each with or without its unit.
fn numbers(option: &str, text: &str, units: &[&str], example: &str) -> Result<Vec<f64>, Failure> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let help = |failure: Failure| failure.help(format!("write {option} {example}"));
    if parts.len() != units.len() {
        let (wanted, found) = (units.len(), parts.len());
        return Err(help(Failure::new(format!(
            "{option} takes {wanted} numbers separated by commas, not {found}"
        ))));
    }
    let pairs = parts.iter().zip(units);
    pairs
        .map(|(part, unit)| number(option, part, unit).map_err(help))
        .collect()
}

fn number(option: &str, part: &str, unit: &str) -> Result<f64, Failure> {
    let refused = |why: String| Err(Failure::new(format!("{option}: {why}")));
    let digits = part.strip_suffix(unit).unwrap_or(part).trim_end();
    match digits.parse::<f64>() {
        Ok(number) if number.abs() <= LARGEST => Ok(number),
        Ok(number) if number.is_finite() => refused(format!("`{part}` is larger than {LARGEST}")),
        Ok(_) => refused(format!("`{part}` is not a finite number")),
        Err(_) if part.is_empty() => refused("a number is missing beside a comma".to_owned()),
        Err(_) => refused(format!("`{part}` is not a number{}", in_unit(unit))),
    }
}

fn in_unit(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" in {unit}")
    }
}

/// Values of a machine's axes, in mm and rad.
pub(super) fn axis_values(option: &str, text: &str, axes: &[Axis]) -> Result<Vec<f64>, Failure> {
    let units: Vec<&str> = axes
        .iter()
        .map(|axis| match axis.kind {
            AxisKind::Linear => "mm",
            AxisKind::Rotary => "deg",
        })
        .collect();
    let pairs = axes.iter().zip(&units);
    let names: Vec<String> = pairs
        .map(|(axis, unit)| format!("{} in {unit}", axis.name))
        .collect();
    let example = vec!["0"; axes.len()].join(",");
    let values = numbers(option, text, &units, &example)
        .map_err(|failure| failure.help(format!("they are {}", names.join(", "))))?;
    let in_rad = values.iter().zip(axes).map(|(value, axis)| match axis.kind {
        AxisKind::Linear => *value,
        AxisKind::Rotary => value.to_radians(),
    });
    Ok(in_rad.collect())
}

/// A frame with angles. `example` is one that fits the option.
pub(super) fn frame(option: &str, text: &str, example: &str) -> Result<Frame, Failure> {
    let numbers = numbers(option, text, POSE, example)?;
    let &[x, y, z, a, b, c] = numbers.as_slice() else {
        return Err(Failure::new(format!("{option} takes 6 numbers")));
    };
    let [a, b, c] = [a, b, c].map(Angle::deg);
    Ok(Frame {
        origin: Point3::new(x, y, z),
        orientation: Orientation::from_zyx(Zyx { a, b, c }),
    })
}

/// A frame with a quaternion.
pub(super) fn frame_with(option: &str, text: &str, quaternion: &str) -> Result<Frame, Failure> {
    let place = numbers(option, text, &["mm"; 3], "1500,0,1200")
        .map_err(|failure| failure.help("with --quaternion, --pose is x, y, z only"))?;
    const OPTION: &str = "--quaternion";
    let parts = numbers(OPTION, quaternion, &[""; 4], "0.707107,0,0.707107,0")?;
    let (&[x, y, z], &[w, i, j, k]) = (place.as_slice(), parts.as_slice()) else {
        return Err(Failure::new(format!("{OPTION} takes 4 numbers")));
    };
    let length = libm::sqrt(w * w + i * i + j * j + k * k);
    let orientation = Orientation::from_quaternion(w, i, j, k);
    match orientation {
        Some(orientation) if (length - 1.0).abs() <= LENGTH_TOLERANCE => Ok(Frame {
            origin: Point3::new(x, y, z),
            orientation,
        }),
        Some(near) => {
            let [w, i, j, k] = near.quaternion();
            Err(
                Failure::new(format!("{OPTION} has the length {length:.4}, a rotation has 1")).help(format!(
                    "if only the length is off, write {OPTION} {w:.6},{i:.6},{j:.6},{k:.6}"
                )),
            )
        }
        None => Err(Failure::new(format!(
            "{OPTION} has the length 0, a rotation has 1"
        ))),
    }
}
