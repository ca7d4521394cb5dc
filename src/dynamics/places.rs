//! What happens in places along a program: the torques of the axes, what pushes the blade, and how far that pushes the flank off.
//!
//! All of it is by the numbers as they are stated. Between places nothing is proven.

use crate::arms::Arms;
use crate::cuts::{Cuts, InPlace, Known};
use crate::deviation::Deviations;
use crate::drives::{Drives, Torques};
use crate::push::Shift;
use vcutc_motion::trajectory::{Sample, Spacing};

/// A program on an arm of known weight, and its cuts by blades whose forces are known.
pub struct Places<'p> {
    known: Known<'p>,
    drives: Drives<'p>,
    cuts: Option<&'p Cuts<'p>>,
    deviations: Option<Deviations<'p>>,
}

/// A place along a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub sample: Sample,
    /// What the axes need there, against the forces of the blade as well where these are known.
    pub torques: Torques,
    /// What pushes the blade; none where it does not cut, or its forces are not known.
    pub pushed: Option<InPlace>,
    /// How far that pushes the flank off, in mm, where the stiffness of the arm is known.
    pub shift: Option<Shift>,
}

impl<'p> Places<'p> {
    #[must_use]
    pub fn of(known: Known<'p>, arms: &'p Arms, cuts: Option<&'p Cuts<'p>>) -> Self {
        Self {
            drives: Drives::of(known.rigs, arms, known.reached.program()),
            deviations: cuts.and_then(|cuts| Deviations::of(cuts, Some(arms))),
            known,
            cuts,
        }
    }

    /// The program and what carries it out.
    #[must_use]
    pub const fn known(&self) -> &Known<'p> {
        &self.known
    }

    /// Whether it may have places with [`Place::pushed`].
    #[must_use]
    pub const fn have_forces(&self) -> bool {
        self.cuts.is_some()
    }

    /// Whether it may have places with [`Place::shift`].
    #[must_use]
    pub const fn have_shifts(&self) -> bool {
        self.deviations.is_some()
    }

    /// All places, in order.
    ///
    /// # Errors
    /// What `take` returns.
    pub fn along<E>(
        &self,
        spacing: &Spacing,
        mut take: impl FnMut(&Place) -> Result<(), E>,
    ) -> Result<(), E> {
        self.drives.along(self.known.reached, spacing, |sample, torques| {
            let Sample { op, done, joints } = sample;
            let pushed = self.cuts.and_then(|cuts| cuts.in_place(*op, *done, joints));
            let deviations = self.deviations.as_ref();
            take(&Place {
                sample: *sample,
                torques: Torques {
                    cutting: pushed.map_or(torques.cutting, |pushed| pushed.torques),
                    ..*torques
                },
                pushed,
                shift: deviations.and_then(|deviations| deviations.in_place(*op, *done, joints)),
            })
        })
    }
}
