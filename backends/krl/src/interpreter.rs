//! KRL carried out, for all who read it: the strict read-back of programs of this crate, and the conversion
//! of milling programs, whoever wrote them.
//!
//! [`Execution`] is the control flow: it gives the statements of a program in the order in which a controller carries them
//! out. [`State`] is what they change: variables ([`variables`]), and where the tool is ([`position`]). What a statement
//! means for a program as a whole is for the user of both to say. So is which calls are followed, and where reading stops.

pub mod execution;
pub mod index;
pub mod position;
pub mod speeds;
pub mod variables;

pub use execution::{BreaksOff, Execution, Line};
pub use variables::Context;

use crate::syntax::{Coordinates, Target};
use position::Position;
use variables::Variables;

/// What the statements of a program change.
#[derive(Debug, Default)]
pub struct State {
    /// Positions and frames with names.
    pub variables: Variables,
    /// Where the tool is.
    pub position: Position,
}

impl State {
    /// The coordinates of a target; none for a name that is not declared.
    #[must_use]
    pub fn coordinates(&self, context: Context<'_>, target: &Target<'_>) -> Option<Coordinates> {
        match target {
            Target::Literal(coordinates) => Some(*coordinates),
            Target::Variable(variable) => self.variables.get(context, variable),
        }
    }
}
