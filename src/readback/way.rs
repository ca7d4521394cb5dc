//! The way from one program to another, whether or not both are split into parts alike.

use super::scene::Scene;
use super::split;
use super::steps::{Step, steps_between};
use super::told::Names;
use vcutc_diff::align::common;

/// The way from one program to another.
pub(super) struct Way {
    /// In the order of the given program.
    pub(super) steps: Vec<Step>,
    pub(super) parts: Parts,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parts {
    /// Where the compiler begins them.
    AsWritten,
    Otherwise,
}

/// The way from the fresh program of a scene to the given one.
pub(super) fn way(scene: &Scene<'_>) -> Way {
    let (fresh, given) = (scene.fresh, scene.given);
    let mut names = Names::default();
    let essences = [fresh.essences(&mut names), given.essences(&mut names)];
    let [fresh_essences, given_essences] = &essences;
    if split::is_split_otherwise(scene, &common(fresh_essences, given_essences)) {
        return Way {
            steps: split::steps(scene),
            parts: Parts::Otherwise,
        };
    }
    let mut names = Names::default();
    let skeletons = [fresh.skeletons(&mut names), given.skeletons(&mut names)];
    Way {
        steps: steps_between(&essences, &skeletons),
        parts: Parts::AsWritten,
    }
}
