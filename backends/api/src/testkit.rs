//! Programs to test backends with, and the check that every backend must pass (feature `testkit`).
//!
//! [`Recipe`] describes a program by a few numbers, all of which give a program that [`verify`] accepts, so that a
//! property test can draw recipes at random. [`reachable`] gives a program the motion of a pretend machine. [`samples`] is a
//! fixed set with the corner cases. [`conformance`] is what the trait [`Backend`](crate::backend::Backend) promises, checked against those samples.

mod chain;
mod conformance;
mod disc;
mod pretend;
mod pretend_five_axis;
mod recipe;
mod two_blades;

pub use chain::chained;
pub use conformance::{conformance, conformance_with};
pub use disc::with_disc;
pub use pretend::{axes, axes_at, blade_in_work, reachable};
pub use pretend_five_axis::five_axes;
pub use recipe::{CellRecipe, Crossing, Passes, Recipe};
pub use two_blades::two_blades;

use crate::geometry::{Frame, Orientation, Point3};
use crate::ir::{AxisValues, Edges, Maker, PlacedFrame, Ready, Registered};
use crate::motion::ReachableProgram;
use crate::units::Duration;
use crate::verify::verify;

/// Sample programs with a name each, for a KUKA robot: from an empty one to one with several operations.
///
/// # Errors
/// The name of a recipe that gave a program with faults (a fault of this module).
pub fn samples() -> Result<Vec<(&'static str, ReachableProgram)>, String> {
    samples_for(Maker::Kuka)
}

/// The same for a robot of this maker.
///
/// # Errors
/// The name of a recipe that gave a program with faults (a fault of this module).
pub fn samples_for(maker: Maker) -> Result<Vec<(&'static str, ReachableProgram)>, String> {
    let cell = CellRecipe {
        maker,
        ..CellRecipe::default()
    };
    let mut recipes = common(&cell);
    recipes.push((
        "beyond_half_a_turn",
        Recipe {
            cell: CellRecipe {
                home: AxisValues([0.0, -90.0, 90.0, -340.0, 45.0, -340.0].map(f64::to_radians)),
                ..cell.clone()
            },
            ..Recipe::default()
        },
    ));
    recipes.push((
        "numbered_cell",
        Recipe {
            cell: CellRecipe {
                tool: numbered(3),
                base: numbered(2),
                load: Some(Registered::Number(1)),
                ready: Ready::Input(7),
                ..cell
            },
            ..Recipe::default()
        },
    ));
    programs(recipes)
}

/// Sample programs with a name each, for a five-axis machine.
///
/// # Errors
/// The name of a recipe that gave a program with faults (a fault of this module).
pub fn five_axis_samples() -> Result<Vec<(&'static str, ReachableProgram)>, String> {
    let cell = CellRecipe::five_axis();
    let mut recipes = common(&cell);
    recipes.push((
        "numbered_cell",
        Recipe {
            cell: CellRecipe {
                tool: numbered(3),
                base: numbered(2),
                ..cell
            },
            ..Recipe::default()
        },
    ));
    programs(recipes)
}

/// What every machine can do.
fn common(cell: &CellRecipe) -> Vec<(&'static str, Recipe)> {
    let plain = Recipe {
        cell: cell.clone(),
        ..Recipe::default()
    };
    vec![
        (
            "empty",
            Recipe {
                layers: 0,
                ..plain.clone()
            },
        ),
        (
            "one_cut",
            Recipe {
                layers: 1,
                cuts: 1,
                ..plain.clone()
            },
        ),
        ("still_tip_turns", plain.clone()),
        (
            "layer_by_layer",
            Recipe {
                passes: Passes::Layer,
                ..plain.clone()
            },
        ),
        (
            "single_edge",
            Recipe {
                edges: Edges::Single,
                ..plain.clone()
            },
        ),
        (
            "several_operations",
            Recipe {
                operations: 3,
                dwell: Some(Duration::s(0.25)),
                ..plain.clone()
            },
        ),
        (
            "branch_changes",
            Recipe {
                operations: 3,
                crossing: Crossing::ByAxes,
                ..plain
            },
        ),
    ]
}

fn programs(recipes: Vec<(&'static str, Recipe)>) -> Result<Vec<(&'static str, ReachableProgram)>, String> {
    recipes
        .into_iter()
        .map(|(name, recipe)| {
            let program = verify(recipe.program()).map_err(|faults| format!("sample {name}: {faults:?}"))?;
            let program = reachable(program).map_err(|faults| format!("sample {name}: {faults:?}"))?;
            Ok((name, program))
        })
        .collect()
}

/// A frame that the controller keeps.
const fn numbered(number: u32) -> PlacedFrame {
    PlacedFrame {
        frame: Frame {
            origin: Point3::new(0.0, 0.0, 250.0),
            orientation: Orientation::IDENTITY,
        },
        number: Some(number),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_samples_of_both_machines_are_reachable() {
        assert_eq!(samples().map(|samples| samples.len()), Ok(9));
        assert_eq!(five_axis_samples().map(|samples| samples.len()), Ok(8));
    }
}
