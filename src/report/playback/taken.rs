//! What slits and discs take out of the section, for a viewer that follows flanks only.
//!
//! It gets what comes free as the proof has it: the op, and the surface that stays there instead. Then it need not know how
//! strips hang on, and shows what is proven.

use vcutc_backend_api::ir::{Action, OpId};
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::cross_section::{self, Crack};
use vcutc_simulation::prove::{self, Bound};

/// All slits, and all chips in the order in which they come free. Lengths are in mm, in W.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    pub slits: Vec<(usize, Crack)>,
    /// The op after which it is free, and what lies below it, from left to right.
    pub chips: Vec<(usize, Vec<Point2>)>,
}

impl Taken {
    /// Of a program; none where it has Vs only.
    #[must_use]
    pub fn of(program: &VerifiedProgram, bounds: &[Bound<'_>]) -> Option<Self> {
        let ops = &program.program().ops;
        let has_chains = ops.iter().any(|op| matches!(op.action, Action::Follow { .. }));
        has_chains.then(|| {
            let mut all = Self::default();
            let mut last = None;
            let (taken, _) = prove::watched(program, bounds, &mut |op: OpId, _, taken| {
                all.add(last, taken);
                last = Some(op.0 as usize);
            });
            all.add(last, taken);
            all
        })
    }

    fn add(&mut self, op: Option<usize>, taken: Vec<cross_section::Taken>) {
        let Some(op) = op else { return };
        for taken in taken {
            match taken {
                cross_section::Taken::Slit(slit) => self.slits.push((op, slit)),
                cross_section::Taken::Chip(chip) => self.chips.push((op, chip.floor)),
            }
        }
    }
}
