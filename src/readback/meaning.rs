//! What a statement says, however it is written.

use vcutc_backend_api::readback::{Deed, Held, Says, Target};

/// What a deed says, equal for equal ones however they are written.
pub(super) fn meaning(deed: &Deed) -> String {
    match deed {
        Deed::AxesToPose(target) => format!("to {}", target_meaning(target)),
        Deed::Straight { to, pace, end } => format!("straight {} {pace:?} {end:?}", target_meaning(to)),
        Deed::Axes(_) | Deed::Switch { .. } | Deed::AwaitInput(_) | Deed::Wait(_) => format!("{deed:?}"),
    }
}

fn target_meaning(target: &Target) -> String {
    match target.held {
        Held::Orientation(orientation, stance) => {
            // A quaternion and its opposite are the same turn; adding 0 takes the sign off zeros.
            let matrix = orientation.matrix().map(|row| row.map(|entry| entry + 0.0));
            format!("{:?} {matrix:?} {stance:?}", target.tip)
        }
        Held::Rotary(_) => format!("{target:?}"),
    }
}

/// Whether two statements do the same.
pub(super) fn says_the_same(should: &Says, is: &Says) -> bool {
    match (should, is) {
        (Says::Deed(should), Says::Deed(is)) => should == is || meaning(should) == meaning(is),
        (_, _) => should == is,
    }
}
