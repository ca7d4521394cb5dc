//! Programs that go on with a blade that spins.

use super::recipe::posture;
use super::two_blades::hold_two;
use crate::geometry::Point3;
use crate::ir::{
    Action, Blade, BodyStage, Changer, Disc, FeedId, Joint, Op, OperationId, OrientationId, Program, RateId,
    Shape, Site, Spindle, Switch, ToolId,
};
use crate::units::{Angle, AngularSpeed, Length};
use core::num::NonZeroU32;

/// The same program with a disc pass at the end of its first operation, for which the disc takes the place of the blade: along y
/// through the stock, 2 mm below its top, with a lead of 3 degrees. The program has a cut, from which the pass takes its speeds.
#[must_use]
pub fn with_disc(mut program: Program, by: Changer, spindle: Spindle) -> Program {
    let disc = ToolId(1);
    program.blades.truncate(1);
    program.blades.push(wheel());
    if let Some(cell) = &mut program.cell {
        hold_two(cell, by);
        cell.spindle = Some(spindle);
    }
    if let Some(operation) = program.operations.first_mut() {
        operation.tools.push(disc);
    }
    let is_off = |op: &Op| matches!(op.action, Action::Ultrasonic { state: Switch::Off });
    let Some(off) = program.ops.iter().position(is_off) else {
        return program;
    };
    let pass = pass(&mut program, disc);
    program.ops.splice(off + 1..off + 1, pass);
    program
}

const RADIUS: Length = Length::mm(25.0);

fn wheel() -> Blade {
    Blade {
        name: "wheel".to_owned(),
        shape: Shape::Disc(Disc {
            radius: RADIUS,
            thickness: Length::mm(1.5),
            spin: AngularSpeed::rev_per_min(3000.0),
        }),
        body: Some(vec![BodyStage {
            from: Length::mm(1.5),
            radius: Length::mm(8.0),
        }]),
    }
}

fn pass(program: &mut Program, disc: ToolId) -> Vec<Op> {
    let held = OrientationId(u32::try_from(program.orientations.len()).unwrap_or(u32::MAX));
    program
        .orientations
        .push(posture(Angle::ZERO, Angle::deg(87.0), 1.0));
    let stock = program.stock;
    let [width, depth, height] = [stock.width, stock.depth, stock.height].map(Length::to_mm);
    let air = RADIUS.to_mm() + 10.0;
    let at = |y: f64, z: f64| Point3::new(0.5 * width, y, z);
    let (front, back) = (-air, depth + air);
    let (safe, low) = (height + air, height - 2.0);
    let (feed, way) = (FeedId(0), FeedId(1));
    let change = [Action::ChangePlace, Action::ToolChange { tool: disc }];
    let on = [
        Action::Spin { state: Switch::On },
        Action::Ultrasonic { state: Switch::On },
        Action::AwaitReady,
    ];
    let there = [
        Action::AxisTravel {
            to: at(front, safe),
            orientation: held,
        },
        Action::Approach {
            to: at(front, low),
            feed: way,
        },
    ];
    let through = [
        Action::Follow {
            to: at(back, low),
            orientation: held,
            via: None,
            feed,
            rate: RateId(0),
            joint: Joint::Stop,
        },
        Action::Retract {
            to: at(back, safe),
            feed: way,
        },
    ];
    let off = [
        Action::Spin { state: Switch::Off },
        Action::Ultrasonic { state: Switch::Off },
    ];
    let ways = on.into_iter().chain(there).chain(through).chain(off);
    let site = Site::Cut {
        operation: OperationId(0),
        layer: NonZeroU32::MIN,
        cut: NonZeroU32::MIN,
    };
    let of_program = change.map(|action| Op {
        site: Site::Program,
        action,
    });
    of_program
        .into_iter()
        .chain(ways.map(|action| Op { site, action }))
        .collect()
}
