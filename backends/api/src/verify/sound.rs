//! Whether the numbers of a machine, and of the bodies of its blades, are ones that they can have.

use crate::ir::{
    Axis, AxisValues, Blade, BodyStage, Cell, Changer, Crusher, Disc, Inertia, MOST_AXES, PlacedFrame, Ready,
    Registered, Shape, Spindle, Straight, Tool,
};
use crate::units::{Angle, AngularSpeed, Duration, Length, Mass};

/// Whether all numbers of a machine but those of its axes are ones that it can have.
pub(super) fn has_sound_numbers(cell: &Cell) -> bool {
    let ready = match cell.ready {
        Ready::Input(input) => input > 0,
        Ready::After(time) => is_sound_time(time),
    };
    let finite = |values: AxisValues| values.0.iter().all(|value| value.is_finite());
    let change = cell
        .change
        .is_none_or(|change| finite(change.at) && is_sound_time(change.time));
    is_sound_frame(&cell.base)
        && cell.tools.iter().all(|(_, tool)| is_sound_tool(tool))
        && ready
        && change
        && cell.home.is_none_or(finite)
        && cell.ultrasonic.is_none_or(|output| output > 0)
        && match cell.spindle {
            Some(Spindle::Output(output)) => output > 0 && Some(output) != cell.ultrasonic,
            Some(Spindle::Own) | None => true,
        }
}

fn is_sound_tool(tool: &Tool) -> bool {
    let load = match tool.load {
        Some(Registered::Value(load)) => {
            load.mass.is_finite()
                && load.mass >= Mass::ZERO
                && load.centre.is_finite()
                && load.inertia.is_none_or(Inertia::is_possible)
        }
        Some(Registered::Number(number)) => number > 0,
        None => true,
    };
    is_sound_frame(&tool.frame) && load && tool.place.is_none_or(|place| place > 0)
}

fn is_sound_frame(placed: &PlacedFrame) -> bool {
    placed.frame.origin.is_finite() && placed.number.is_none_or(|number| number > 0)
}

fn is_sound_time(time: Duration) -> bool {
    time.is_finite() && time >= Duration::ZERO
}

/// Whether a machine has one tool for each blade; of several that its changer is to put in, each with a place of its own.
pub(super) fn has_a_tool_for_each(cell: &Cell, blades: usize) -> bool {
    let mut places: Vec<Option<u32>> = cell.tools.iter().map(|(_, tool)| tool.place).collect();
    places.sort_unstable();
    let distinct = places.windows(2).all(|pair| match pair {
        [Some(one), Some(other)] => one != other,
        _ => true,
    });
    let placed = match cell.change.map(|change| change.by) {
        Some(Changer::Program) => places.iter().all(Option::is_some),
        Some(Changer::Hand) | None => true,
    };
    // A program without operations has no blade, and its machine a tool all the same.
    cell.tools.count() == blades.max(1) && distinct && (placed || !cell.tools.are_several())
}

/// Whether a machine has a number of axes that it can have, each with a range, and rates that are positive.
pub(super) fn has_sound_axes(axes: &[Axis]) -> bool {
    let positive = |value: Option<f64>| value.is_none_or(|value| value.is_finite() && value > 0.0);
    (1..=MOST_AXES).contains(&axes.len())
        && axes.iter().all(|axis| {
            axis.min.is_finite()
                && axis.max.is_finite()
                && axis.min <= axis.max
                && positive(axis.rate)
                && positive(axis.acceleration)
        })
}

/// Whether all numbers of a blade are ones that it can have.
pub(super) fn is_sound_blade(blade: &Blade) -> bool {
    let acute = |angle: Angle| angle.is_finite() && angle < Angle::deg(90.0);
    let spins = |spin: AngularSpeed| spin.is_finite() && spin.to_rad_per_s() > 0.0;
    let shape = match blade.shape {
        Shape::Straight(Straight {
            cutting_length,
            half_apex,
            thickness,
            edges: _,
        }) => {
            is_positive(cutting_length)
                && acute(half_apex)
                && half_apex >= Angle::ZERO
                && thickness.is_finite()
                && thickness >= Length::ZERO
        }
        Shape::Disc(Disc {
            radius,
            thickness,
            spin,
        }) => is_positive(radius) && is_positive(thickness) && spins(spin),
        Shape::Crusher(Crusher {
            radius,
            height,
            spin,
            ramp,
        }) => is_positive(radius) && is_positive(height) && spins(spin) && acute(ramp) && ramp > Angle::ZERO,
    };
    shape && blade.body.as_deref().is_none_or(has_sound_stages)
}

fn is_positive(length: Length) -> bool {
    length.is_finite() && length > Length::ZERO
}

/// Whether the stages of a body are round, and rise.
fn has_sound_stages(stages: &[BodyStage]) -> bool {
    let sound = |stage: &BodyStage| is_positive(stage.from) && is_positive(stage.radius);
    !stages.is_empty()
        && stages.iter().all(sound)
        && stages.is_sorted_by(|below, above| below.from < above.from)
}
