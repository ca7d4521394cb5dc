//! Which corners between two moves may be rounded.

use crate::geometry::Point3;
use crate::ir::{Action, Stock};
use crate::state::Place;

/// Whether the robot may round the corner between two moves of the tip.
///
/// The first must be a move through the air that need not end exactly, the second another one. The controller leaves
/// the first move up to `$APO.CDIS` before its end and joins the second as far after it, inside the triangle
/// of the three tips. That triangle must be clear of the stock: all three tips on one outer side of the box,
/// which is convex. (The two moves alone are checked by the verifier, each on a side of its own; the chord
/// between them is not.)
pub fn may_round(stock: Stock, before: Place, first: &Action, second: Option<&Action>) -> bool {
    let (Action::Travel { to: corner, .. } | Action::Retract { to: corner, .. }) = *first else {
        return false;
    };
    let Some(Action::Travel { to, .. } | Action::Approach { to, .. } | Action::Retract { to, .. }) = second
    else {
        return false;
    };
    let from = before.pose();
    from.is_some_and(|from| beside_stock(stock, [from.tip, corner, *to]))
}

/// Whether all points lie on one outer side of the stock (in front, behind or above; the sides that blades come from).
fn beside_stock(stock: Stock, tips: [Point3; 3]) -> bool {
    let all = |outside: &dyn Fn(Point3) -> bool| tips.into_iter().all(outside);
    all(&|tip| tip.y <= 0.0)
        || all(&|tip| tip.y >= stock.depth.to_mm())
        || all(&|tip| tip.z >= stock.height.to_mm())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{FeedId, OrientationId, RateId, Switch};
    use crate::state::TipPose;
    use crate::units::Length;

    const STOCK: Stock = Stock {
        width: Length::mm(85.0),
        depth: Length::mm(50.0),
        height: Length::mm(50.0),
    };

    fn at(y: f64, z: f64) -> Place {
        Place::Pose(TipPose {
            tip: Point3::new(10.0, y, z),
            orientation: OrientationId(0),
        })
    }

    fn travel(y: f64, z: f64) -> Action {
        Action::Travel {
            to: Point3::new(10.0, y, z),
            orientation: OrientationId(0),
            feed: FeedId(0),
            rate: RateId(0),
        }
    }

    fn retract(y: f64, z: f64) -> Action {
        Action::Retract {
            to: Point3::new(10.0, y, z),
            feed: FeedId(0),
        }
    }

    fn approach(y: f64, z: f64) -> Action {
        Action::Approach {
            to: Point3::new(10.0, y, z),
            feed: FeedId(0),
        }
    }

    #[test]
    fn corners_beside_the_stock_are_rounded() {
        assert!(may_round(
            STOCK,
            at(-5.0, 20.0),
            &retract(-5.0, 60.0),
            Some(&travel(-9.0, 60.0))
        ));
        assert!(may_round(
            STOCK,
            at(20.0, 60.0),
            &travel(-9.0, 70.0),
            Some(&approach(-9.0, 55.0))
        ));
    }

    #[test]
    fn a_corner_whose_chord_cuts_the_stock_is_not() {
        // Up in front of the stock, then over it: the chord from (-5, 10) to (45, 60) passes through the box.
        assert!(!may_round(
            STOCK,
            at(-5.0, 10.0),
            &retract(-5.0, 60.0),
            Some(&travel(100.0, 60.0))
        ));
    }

    #[test]
    fn moves_that_must_end_exactly_are_not() {
        let here = at(-5.0, 60.0);
        let cut = Action::Cut {
            flank: crate::ir::Flank::Left,
            to: Point3::new(10.0, 60.0, 10.0),
            feed: FeedId(0),
        };
        let turn = Action::Turn {
            to: OrientationId(0),
            rate: RateId(0),
        };
        for next in [
            cut,
            turn,
            Action::Home,
            Action::AwaitReady,
            Action::Ultrasonic { state: Switch::Off },
        ] {
            assert!(
                !may_round(STOCK, here, &travel(-9.0, 60.0), Some(&next)),
                "{next:?}"
            );
            assert!(
                !may_round(STOCK, here, &next, Some(&travel(-9.0, 60.0))),
                "{next:?}"
            );
        }
        assert!(!may_round(
            STOCK,
            here,
            &approach(-5.0, 55.0),
            Some(&travel(-9.0, 60.0))
        ));
        assert!(!may_round(STOCK, here, &travel(-9.0, 60.0), None));
        assert!(!may_round(
            STOCK,
            Place::Home,
            &travel(-9.0, 60.0),
            Some(&travel(-5.0, 60.0))
        ));
    }
}
