//! Machines: what axes a machine has and how they carry the blade. The catalogue, sheets of users, and robots described
//! by URDF all end as a [`Model`].

pub mod body;
pub mod catalogue;
pub mod elasticity;
pub mod facts;
pub mod habits;
pub mod kinematics;
mod limit_places;
pub mod masses;
pub mod path_limits;
pub mod payload;
mod ranges;
mod reach;
pub mod sheet;
pub mod urdf;
mod usual_home;

pub use limit_places::LimitPlaces;
pub use usual_home::usual_home;

use crate::kinematics::Mechanism;
use elasticity::Elasticity;
use masses::{Masses, Torques};
use path_limits::PathLimits;
use payload::Payload;
use vcutc_backend_api::ir::{Axis, MachineKind, Maker};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::FileId;

/// A machine as the compiler needs it, wherever its description came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The name under which a job asks for it, such as `kuka/kr210_r3100_ultra`.
    pub name: String,
    /// Who made its controller.
    pub maker: Maker,
    /// Its axes, in the controller's order and sense.
    pub axes: Vec<Axis>,
    /// How the axes move the flange (of a robot) or the spindle nose (of a five-axis machine).
    pub mechanism: Mechanism,
    /// What its controller keeps along the way of the tip.
    pub path: PathLimits,
    /// What its flange may carry, as far as that is known.
    pub payload: Payload,
    /// The masses of its links, when known.
    pub masses: Option<Masses>,
    /// The torques of its drives, when known.
    pub torques: Option<Torques>,
    /// How its joints yield, when known.
    pub elasticity: Option<Elasticity>,
}

impl Model {
    #[must_use]
    pub const fn kind(&self) -> MachineKind {
        self.mechanism.kind()
    }
}

/// Where a machine that a job names is described.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    Catalogue,
    File(FileKind),
}

/// Kinds of files that describe machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A sheet in TOML, ending in `.toml`.
    Sheet,
    /// A robot in URDF, ending in `.urdf`.
    Urdf,
}

impl Origin {
    /// Where the machine of that name is described.
    #[must_use]
    pub fn of(name: &str) -> Self {
        match name.rsplit_once('.') {
            Some((_, "toml")) => Self::File(FileKind::Sheet),
            Some((_, "urdf")) => Self::File(FileKind::Urdf),
            Some(_) | None => Self::Catalogue,
        }
    }
}

/// Reads the machine that a file describes. `name` is what the job calls it.
///
/// # Errors
/// What is wrong with the description, in the order of the text.
pub fn read(name: &str, kind: FileKind, file: FileId, text: &str) -> Result<Model, Vec<Diagnostic>> {
    match kind {
        FileKind::Sheet => sheet::parse(file, text).map(|sheet| sheet.machine(name)),
        FileKind::Urdf => urdf::parse(name, file, text, urdf::Flange::ByConvention),
    }
}

/// The places of the limits of all axes of a machine that was read from this text.
#[must_use]
pub fn limit_places(kind: FileKind, file: FileId, text: &str, axes: &[Axis]) -> Vec<LimitPlaces> {
    match kind {
        FileKind::Sheet => sheet::limit_places(file, text, axes),
        FileKind::Urdf => urdf::limit_places(file, text, axes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_the_ending_of_a_description_are_files() {
        assert_eq!(Origin::of("kuka/kr210_r3100_ultra"), Origin::Catalogue);
        assert_eq!(Origin::of("irb6700-200/2.60"), Origin::Catalogue);
        assert_eq!(Origin::of("../shop/arm.v2.toml"), Origin::File(FileKind::Sheet));
        assert_eq!(Origin::of("arm.urdf"), Origin::File(FileKind::Urdf));
        assert_eq!(Origin::of(""), Origin::Catalogue);
    }
}
