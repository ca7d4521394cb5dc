//! Values as a job writes them, rounded to what people like to paste.
//!
//! What is offered has been tried in exactly the form in which it is offered, so values are rounded first and tried then.

use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{Axis, AxisKind, AxisValues, MachineKind, PlacedFrame};
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::number::show;
use vcutc_machine::Model;

/// A frame with the decimals that [`frame_text`] writes: lengths and angles to thousandths of mm and deg.
#[must_use]
pub fn rounded(frame: &Frame) -> Frame {
    let Zyx { a, b, c } = frame.orientation.to_zyx();
    let [x, y, z] = [frame.origin.x, frame.origin.y, frame.origin.z].map(thousandths);
    let [a, b, c] = [a, b, c].map(|angle| Angle::deg(thousandths(angle.to_deg())));
    Frame {
        origin: Point3::new(x, y, z),
        orientation: Orientation::from_zyx(Zyx { a, b, c }),
    }
}

fn thousandths(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// `frame(x = 1700 mm, y = 0 mm, z = 650 mm, a = 90 deg, b = 0 deg, c = 0 deg)`, in the controller's table where it has a
/// number.
#[must_use]
pub fn frame_text(placed: &PlacedFrame) -> String {
    let Point3 { x, y, z } = placed.frame.origin;
    let Zyx { a, b, c } = placed.frame.orientation.to_zyx();
    let [x, y, z] = [x, y, z].map(show);
    let [a, b, c] = [a, b, c].map(|angle| show(angle.to_deg()));
    let frame = format!("frame(x = {x} mm, y = {y} mm, z = {z} mm, a = {a} deg, b = {b} deg, c = {c} deg)");
    match placed.number {
        Some(number) => format!("number({number}, {frame})"),
        None => frame,
    }
}

/// The home of a robot in whole degrees, as far as that stays within the axes' ranges.
#[must_use]
pub fn rounded_home(axes: &[Axis], home: &AxisValues) -> AxisValues {
    let mut rounded = *home;
    for (value, axis) in rounded.0.iter_mut().zip(axes) {
        let step = match axis.kind {
            AxisKind::Rotary => 1.0_f64.to_radians(),
            AxisKind::Linear => 1.0,
        };
        *value = (*value / step).round() * step;
        if *value < axis.min {
            *value += step;
        } else if *value > axis.max {
            *value -= step;
        }
    }
    rounded
}

/// `joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)` of a robot, `axes(x = 0 mm, ...)` of a five-axis machine.
#[must_use]
pub fn home_text(model: &Model, home: &AxisValues) -> String {
    let values = model
        .axes
        .iter()
        .zip(home.0)
        .map(|(axis, value)| match axis.kind {
            AxisKind::Rotary => format!("{} deg", show(value.to_degrees())),
            AxisKind::Linear => format!("{} mm", show(value)),
        });
    match model.kind() {
        MachineKind::Robot => format!("joints({})", values.collect::<Vec<_>>().join(", ")),
        MachineKind::FiveAxis => {
            let named = model.axes.iter().zip(values);
            let named: Vec<String> = named
                .map(|(axis, value)| format!("{} = {value}", axis.name.to_ascii_lowercase()))
                .collect();
            format!("axes({})", named.join(", "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_what_was_rounded() {
        let frame = rounded(&Frame {
            origin: Point3::new(1700.00049, -0.0001, 650.5),
            orientation: Orientation::from_zyx(Zyx {
                a: Angle::deg(12.34567),
                b: Angle::deg(-20.0),
                c: Angle::deg(180.0),
            }),
        });
        let placed = PlacedFrame {
            frame,
            number: Some(3),
        };
        assert_eq!(
            frame_text(&placed),
            "number(3, frame(x = 1700 mm, y = 0 mm, z = 650.5 mm, a = 12.346 deg, b = -20 deg, c = 180 deg))"
        );
        assert_eq!(rounded(&frame), frame, "rounding again changes nothing");
    }
}
