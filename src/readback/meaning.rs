//! What a statement says, however it is written.

use vcutc_backend_api::readback::{Command, Effect, Held, Target};

/// What a command says, equal for equal ones however they are written.
pub(super) fn meaning(command: &Command) -> String {
    match command {
        Command::AxesToPose(target) => format!("to {}", target_meaning(target)),
        Command::Straight { to, pace, end } => format!("straight {} {pace:?} {end:?}", target_meaning(to)),
        Command::Round { on, to, pace, end } => {
            format!("round {on:?} {} {pace:?} {end:?}", target_meaning(to))
        }
        Command::Axes(_)
        | Command::Switch { .. }
        | Command::Spin(_)
        | Command::AwaitInput(_)
        | Command::Wait(_)
        | Command::ChangeTool(_) => format!("{command:?}"),
    }
}

fn target_meaning(target: &Target) -> String {
    match target.held {
        Held::Orientation(orientation, configuration) => {
            // A quaternion and its opposite are the same turn; adding 0 takes the sign off zeros.
            let matrix = orientation.matrix().map(|row| row.map(|entry| entry + 0.0));
            format!("{:?} {matrix:?} {configuration:?}", target.tip)
        }
        Held::Rotary(_) => format!("{target:?}"),
    }
}

/// Whether two statements do the same.
pub(super) fn says_the_same(should: &Effect, is: &Effect) -> bool {
    match (should, is) {
        (Effect::Command(should), Effect::Command(is)) => should == is || meaning(should) == meaning(is),
        (_, _) => should == is,
    }
}
