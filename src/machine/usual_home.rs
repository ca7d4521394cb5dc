//! A home to begin with, where a job has none yet: a pose of the model that is clear of its limits.

use super::Model;
use vcutc_backend_api::ir::{Axis, AxisKind, MachineKind, Maker};

/// Upright upper arm, level forearm, bent wrist, as KUKA counts its axes.
const AS_KUKA_COUNTS: [f64; 6] = [0.0, -90.0, 90.0, 0.0, 45.0, 0.0];

/// The same for arms whose axes are zero in that pose.
const FROM_ZERO: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 45.0, 0.0];

/// How far an axis is kept from its limits, as a share of its range.
const CLEAR: f64 = 0.05;

/// The home as a job writes it: `joints(0 deg, ...)` of a robot, `axes(x = 0 mm, ...)` of a five-axis machine, there with Z at
/// its upper end. Whether the way from it to the work is clear depends on the job.
#[must_use]
pub fn usual_home(model: &Model) -> String {
    match model.kind() {
        MachineKind::Robot => joints(model),
        MachineKind::FiveAxis => axes(model),
    }
}

fn joints(model: &Model) -> String {
    let pose = match model.maker {
        Maker::Kuka => AS_KUKA_COUNTS,
        Maker::Abb => FROM_ZERO,
        Maker::Other if is_clear(model, AS_KUKA_COUNTS) => AS_KUKA_COUNTS,
        Maker::Other => FROM_ZERO,
    };
    let values = model.axes.iter().zip(pose);
    let values: Vec<String> = values
        .map(|(axis, degrees)| format!("{} deg", clear(axis, degrees)))
        .collect();
    format!("joints({})", values.join(", "))
}

fn axes(model: &Model) -> String {
    let places = model.axes.iter().map(|axis| {
        let name = axis.name.to_lowercase();
        match axis.kind {
            AxisKind::Linear if axis.name == "Z" => format!("{name} = {} mm", axis.max),
            AxisKind::Linear => format!("{name} = 0 mm"),
            AxisKind::Rotary => format!("{name} = 0 deg"),
        }
    });
    format!("axes({})", places.collect::<Vec<_>>().join(", "))
}

fn is_clear(model: &Model, pose: [f64; 6]) -> bool {
    let mut values = model.axes.iter().zip(pose);
    values.all(|(axis, degrees)| (clear(axis, degrees) - degrees).abs() < 1e-9)
}

/// An angle, or the nearest whole one that is clear of the limits.
fn clear(axis: &Axis, degrees: f64) -> f64 {
    let (least, most) = (axis.min.to_degrees(), axis.max.to_degrees());
    let room = CLEAR * (most - least);
    let (least, most) = ((least + room).ceil(), (most - room).floor());
    if least > most {
        return degrees;
    }
    // Adding zero makes a positive zero of a negative one.
    degrees.clamp(least, most) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    #[test]
    fn the_home_of_every_robot_of_the_catalogue_is_within_its_limits() {
        for name in catalogue::names() {
            let model = catalogue::find(name).unwrap();
            if model.kind() != MachineKind::Robot {
                continue;
            }
            let text = usual_home(&model);
            let inner = text
                .strip_prefix("joints(")
                .and_then(|text| text.strip_suffix(')'));
            let values: Vec<f64> = inner
                .unwrap()
                .split(", ")
                .map(|value| {
                    value
                        .strip_suffix(" deg")
                        .unwrap()
                        .parse::<f64>()
                        .unwrap()
                        .to_radians()
                })
                .collect();
            assert_eq!(values.len(), model.axes.len(), "{name}");
            for (axis, value) in model.axes.iter().zip(values) {
                assert!(
                    axis.min < value && value < axis.max,
                    "{name} {}: {text}",
                    axis.name
                );
            }
        }
    }
}
