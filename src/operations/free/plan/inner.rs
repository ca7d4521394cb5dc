//! How the disc enters corners that are sharper than its rim.
//!
//! With the level `L` at the distance `r` from the walls, the rim of a disc whose centre goes along `L` moved outwards by `r - R` reaches
//! all that lies within `r` of it. So a slit along an arc of the radius `r - o` about a corner of `L` parts what this disc frees there. Along
//! the bisector of a corner of the angle `2 phi` that slit ends at `r (1 / sin(phi) - 1) + o` from the corner of the walls. From one level to the next
//! the disc may go on by the width `f` of a strip: from `r = R + m f` to `r = R` it takes
//!
//! ```text
//! m (1 / sin(phi) - 1)
//! ```
//!
//! levels, at least one, and a tenth more for squares of the proof: that is one at corners of 63 deg or more, with one strip beside the wall.

use vcutc_region::outward::{corners, outward};
use vcutc_region::piece::Piece;

/// Most levels: corners of less than 7 deg are not entered any farther.
const MOST: u32 = 16;

/// How many levels more there are than the shank needs, for squares of the proof on both sides of a slit.
const CARE: f64 = 1.1;

/// What rounding may take of a level.
const ROUNDING: f64 = 1e-6;

/// A level on which the disc enters corners.
#[derive(Clone, Debug)]
pub(super) struct Inner {
    /// Which one it is, counted from 1, and of how many.
    stage: [u32; 2],
    /// How far it lies from the one nearest to the walls, in mm.
    aside: f64,
    runs: Vec<Vec<Piece>>,
    /// How many strips lie beside each other.
    rings: u32,
}

/// How many levels there are inwards of so many strips, whose innermost level has these ways.
pub(super) fn levels(rings: u32, runs: &[Vec<Piece>]) -> u32 {
    let arcs = runs.iter().flat_map(|run| corners(run, 1.0));
    arcs.map(|arc| stages(arc, rings)).max().unwrap_or(1)
}

/// How far such a level lies from the one nearest to the walls, as a share of the width of the strips.
pub(super) fn share(stage: [u32; 2]) -> f64 {
    let [stage, of] = stage;
    f64::from(of.saturating_sub(stage)) / f64::from(of.max(1))
}

/// On how many levels the disc enters the corner about which this arc goes.
fn stages(arc: Piece, rings: u32) -> u32 {
    // Half the angle of the corner is what half of the turn lacks to a right angle.
    let further = CARE * f64::from(rings) * (1.0 / libm::cos(arc.sweep / 2.0) - 1.0);
    // The cast saturates.
    (libm::ceil(further - ROUNDING) as u32).clamp(1, MOST)
}

impl Inner {
    pub(super) const fn of(stage: [u32; 2], aside: f64, runs: Vec<Vec<Piece>>, rings: u32) -> Self {
        Self {
            stage,
            aside,
            runs,
            rings,
        }
    }

    pub(super) const fn is_last(&self) -> bool {
        self.stage[0] == self.stage[1]
    }

    /// The arcs of a way along which slits part what the disc frees on this level: corners that need fewer levels have some of them only.
    fn chosen(&self, run: &[Piece], by: f64) -> Vec<Piece> {
        let [stage, of] = self.stage;
        let arcs = corners(run, by).into_iter();
        let is_due = |arc: &Piece| {
            let own = stages(*arc, self.rings);
            stage * own / of > (stage - 1) * own / of
        };
        arcs.filter(is_due).collect()
    }

    /// The arcs of slits around what stays in corners, with this distance between slits and ways of the disc.
    pub(super) fn arcs(&self, reach: f64) -> Vec<Piece> {
        let arcs = self.runs.iter().map(|run| self.chosen(run, self.aside + reach));
        arcs.flatten().collect()
    }

    /// The ways of the disc: on the last level all, before it those with a corner that takes it.
    pub(super) fn passes(&self) -> Vec<Vec<Piece>> {
        if self.is_last() {
            return self.runs.clone();
        }
        let runs = self.runs.iter();
        let due = runs.filter(|run| !self.chosen(run, 1.0).is_empty());
        due.map(|run| outward(run, self.aside)).collect()
    }
}

/// Whether a way has corners.
pub(super) fn has_corners(run: &[Piece]) -> bool {
    !corners(run, 1.0).is_empty()
}
