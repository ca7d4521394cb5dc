//! Programs that follow a chain.

use super::recipe::{posture, product};
use crate::geometry::{Orientation, Point3};
use crate::ir::{
    Action, FeedId, Joint, Op, OperationId, OrientationId, Program, RateId, Site, Switch, ViaId,
};
use crate::units::{Angle, Length};
use core::f64::consts::FRAC_1_SQRT_2;
use core::num::NonZeroU32;

/// The same program with a chain at the end of its first operation: along y into the stock, to the side on two arcs, the blade
/// following the way, and along y out of it. The program has a cut, from which the chain takes its heights and speeds.
#[must_use]
pub fn chained(mut program: Program, rake: Angle, blend: Length) -> Program {
    let is_off = |op: &Op| {
        matches!(
            op.action,
            Action::Ultrasonic { state: Switch::Off } | Action::Home
        )
    };
    let started = program.ops.iter().position(|op| op.site.operation().is_some());
    let Some(first) = started else { return program };
    let later = program.ops.iter().skip(first).position(is_off);
    let place = later.map_or(program.ops.len(), |at| first + at);
    let ways = program.ops.iter().take(place);
    let safe = ways
        .filter_map(|op| op.action.tip())
        .fold(0.0, |most: f64, tip| most.max(tip.z));
    let chain = Chain::new(&mut program, rake, safe);
    program.blend = blend;
    program.ops.splice(place..place, chain);
    program
}

struct Chain {
    site: Site,
    ops: Vec<Op>,
}

impl Chain {
    #[expect(clippy::new_ret_no_self, reason = "what is made is its ops")]
    fn new(program: &mut Program, rake: Angle, safe: f64) -> Vec<Op> {
        let stock = program.stock;
        let [width, depth, height] = [stock.width, stock.depth, stock.height].map(Length::to_mm);
        let radius = 0.2 * width.min(depth);
        let (left, middle, z) = (0.25 * width, 0.5 * depth, 0.9 * height);
        let (front, back) = (-0.5 * height - 20.0, depth + 0.5 * height + 20.0);
        let along = add_orientation(program, posture(Angle::ZERO, rake, 1.0));
        let across = add_orientation(program, turned_right(posture(Angle::ZERO, rake, 1.0)));
        let (short, long) = (radius * (1.0 - FRAC_1_SQRT_2), radius * FRAC_1_SQRT_2);
        let first = add_via(program, Point3::new(left + short, middle - radius + long, z));
        let second = add_via(program, Point3::new(left + radius + long, middle + short, z));
        let mut chain = Self {
            site: Site::Cut {
                operation: OperationId(0),
                layer: NonZeroU32::MIN,
                cut: NonZeroU32::MIN,
            },
            ops: Vec::new(),
        };
        let feed = FeedId(1);
        chain.push(Action::Travel {
            to: Point3::new(left, front, safe),
            orientation: along,
            feed,
            rate: RateId(0),
        });
        let to = Point3::new(left, front, z);
        chain.push(Action::Approach { to, feed });
        chain.follow((left, middle - radius, z), None, along, Joint::Through);
        chain.follow((left + radius, middle, z), Some(first), across, Joint::Through);
        let right = left + 2.0 * radius;
        chain.follow((right, middle + radius, z), Some(second), along, Joint::Through);
        chain.follow((right, back, z), None, along, Joint::Stop);
        let to = Point3::new(right, back, safe);
        chain.push(Action::Retract { to, feed });
        chain.ops
    }

    fn follow(
        &mut self,
        (x, y, z): (f64, f64, f64),
        via: Option<ViaId>,
        orientation: OrientationId,
        joint: Joint,
    ) {
        self.push(Action::Follow {
            to: Point3::new(x, y, z),
            orientation,
            via,
            feed: FeedId(0),
            rate: RateId(0),
            joint,
        });
    }

    fn push(&mut self, action: Action) {
        let site = self.site;
        self.ops.push(Op { site, action });
    }
}

/// Turned about the vertical from facing +y to facing +x.
fn turned_right(orientation: Orientation) -> Orientation {
    let quarter = [FRAC_1_SQRT_2, 0.0, 0.0, -FRAC_1_SQRT_2];
    let [w, x, y, z] = product(quarter, orientation.quaternion());
    Orientation::from_quaternion(w, x, y, z).unwrap_or(orientation)
}

fn add_orientation(program: &mut Program, orientation: Orientation) -> OrientationId {
    program.orientations.push(orientation);
    OrientationId(u32::try_from(program.orientations.len() - 1).unwrap_or(u32::MAX))
}

fn add_via(program: &mut Program, via: Point3) -> ViaId {
    program.vias.push(via);
    let number = u32::try_from(program.vias.len()).ok().and_then(NonZeroU32::new);
    ViaId(number.unwrap_or(NonZeroU32::MAX))
}
