//! The cross-section while slits and discs cut it: a height field with vertical walls, and the cracks in it.
//!
//! A slit takes no material out. It is a crack from its bottom up to the surface. A disc cuts along the lower half of its rim,
//! and what hangs on nothing any more comes free: columns between cracks, walls and places where the rim comes out of the
//! surface. As long as slits are vertical and reach up to the surface, what comes free are whole columns, so the rest stays a
//! height field (`docs/process.md`, "The cross-section of rectangular cutting"). What a rim has cut below material that still
//! stands is remembered, for later cuts may free that.
//!
//! A lens that two such rims cut out below a neighbour counts as standing.

mod body;
mod crack;
mod engaged;
mod guard;
mod judge;
mod pass;
mod skin;
mod sorted;
mod sweep;
mod taken;
#[cfg(test)]
mod tests;
mod undercut;

pub use crack::Crack;
pub use guard::Guard;
pub use taken::{Chip, Taken};

use super::surface::{Side, Single, Surface, Vee};
use sorted::Sorted;
use sweep::Piece;
use undercut::Undercut;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

/// Heights and places this close are equal: a nanometre, as on the surface.
const TOUCH: f64 = 1e-6;

/// The section of a stock in which slits, discs and Vs cut.
#[derive(Clone, Debug)]
pub struct CrossSection {
    surface: Surface,
    cracks: Sorted<Crack>,
    undercuts: Sorted<Undercut>,
    /// No undercut is wider, in mm.
    widest: f64,
    scratch: Scratch,
    /// What cuts take, where it is recorded.
    taken: Option<Vec<Taken>>,
}

/// Lists that are filled for each pass.
#[derive(Clone, Debug, Default)]
struct Scratch {
    line: Vec<Point2>,
    pieces: Vec<Piece>,
    floor: Vec<Point2>,
    cracks: Vec<Crack>,
}

impl CrossSection {
    /// Of a stock before the first cut.
    #[must_use]
    pub fn untouched(stock: Stock) -> Self {
        Self::new(Surface::untouched(stock))
    }

    /// Of what earlier cuts have left.
    #[must_use]
    pub fn new(surface: Surface) -> Self {
        Self {
            surface,
            cracks: Sorted::new(),
            undercuts: Sorted::new(),
            widest: 0.0,
            scratch: Scratch::default(),
            taken: None,
        }
    }

    /// The surface, to ask it. Cuts go through the section, or cracks are ignored.
    pub const fn surface(&mut self) -> &mut Surface {
        &mut self.surface
    }

    /// The cracks below the surface, from left to right.
    pub fn cracks(&mut self) -> Vec<Crack> {
        self.cracks_deeper(TOUCH)
    }

    /// Those that reach down farther than this below the lower surface beside them, in mm.
    pub fn cracks_deeper(&mut self, than: f64) -> Vec<Crack> {
        let all: Vec<Crack> = self.cracks.all().collect();
        let is_open = |crack: &Crack| {
            let [left, right] = self.surface.heights(crack.x);
            crack.bottom < left.min(right) - than
        };
        all.into_iter().filter(is_open).collect()
    }

    /// The surface, with nothing more to be cut.
    #[must_use]
    pub fn into_surface(self) -> Surface {
        self.surface
    }

    /// How much a slit down to a bottom has to cut, in mm: up to the lower surface beside it, or to a crack that is there.
    pub fn uncut(&mut self, x: f64, bottom: f64) -> f64 {
        let [left, right] = self.surface.heights(x);
        let lower = left.min(right);
        self.cracks.go_to(x - TOUCH);
        let crack = self.cracks.ahead().next().filter(|crack| crack.x <= x + TOUCH);
        crack.map_or(lower, |crack| lower.min(crack.bottom)) - bottom
    }

    /// Cuts a slit at an x from the surface down to a bottom, both in mm. Returns how deep it is below the higher surface beside
    /// it; none where it ends in the air.
    pub fn slit(&mut self, x: f64, bottom: f64) -> Option<Length> {
        if x <= TOUCH || x >= self.surface.width() - TOUCH {
            return None;
        }
        let [left, right] = self.surface.heights(x);
        let depth = left.max(right) - bottom;
        if depth <= TOUCH {
            return None;
        }
        if left.min(right) - bottom > TOUCH {
            self.insert(Crack { x, bottom });
            self.note(|_| Some(Taken::Slit(Crack { x, bottom })));
            self.free_undercuts(x, x);
        }
        Some(Length::mm(depth))
    }

    fn insert(&mut self, crack: Crack) {
        self.cracks.go_to(crack.x - TOUCH);
        if let Some(known) = self.cracks.next_mut()
            && known.x <= crack.x + TOUCH
        {
            known.bottom = known.bottom.min(crack.bottom);
        } else {
            self.cracks.insert(crack);
        }
    }

    /// What the only flank of a cut does. One whose tip lies in the material frees what is beyond the first crack that it
    /// crosses.
    pub fn single(&mut self, vee: Vee) -> Single {
        let found = self.surface.single(vee);
        if found != Single::Inside {
            return found;
        }
        let Some((vee, side)) = self.beyond_crack(vee) else {
            return found;
        };
        Single::Frees(self.surface.flank(vee, side))
    }

    /// Takes out what a V or a single flank frees. Vertical flanks alone are slits.
    pub fn release(&mut self, vee: Vee) {
        if is_slit(vee) {
            self.slit(vee.tip.x, vee.tip.z);
            return;
        }
        let vee = if vee.is_single() && self.surface.single(vee) == Single::Inside {
            match self.beyond_crack(vee) {
                Some((vee, _)) => vee,
                None => return,
            }
        } else {
            vee
        };
        let span = (!self.undercuts.is_empty())
            .then(|| self.chip_span(vee))
            .flatten();
        self.note(|surface| Some(Taken::Chip(Chip::of(vee, surface.chip(vee)?))));
        self.surface.release(vee);
        if let Some([from, to]) = span {
            self.free_undercuts(from, to);
        }
    }

    /// From where to where a cut takes the surface off.
    fn chip_span(&mut self, vee: Vee) -> Option<[f64; 2]> {
        let chip = self.surface.chip(vee)?;
        let xs = || chip.iter().map(|corner| corner.x);
        Some([
            xs().fold(f64::INFINITY, f64::min),
            xs().fold(f64::NEG_INFINITY, f64::max),
        ])
    }

    /// A single flank in the material, from the first crack on that it crosses: a V of which that crack is the other flank.
    fn beyond_crack(&mut self, vee: Vee) -> Option<(Vee, Side)> {
        let (side, slope) = match (vee.left, vee.right) {
            (Some(slope), None) => (Side::Left, slope),
            (None, Some(slope)) => (Side::Right, slope),
            (Some(_), Some(_)) | (None, None) => return None,
        };
        let exit = self.surface.flank_from(vee.tip, side, slope)?.exit;
        let height = |x: f64| vee.tip.z + (x - vee.tip.x).abs() * slope;
        let crosses = |crack: &Crack| crack.bottom <= height(crack.x) + TOUCH;
        let crack = match side {
            Side::Left => {
                self.cracks.go_to(vee.tip.x + TOUCH);
                let near = self.cracks.behind().take_while(|crack| crack.x > exit.x + TOUCH);
                near.into_iter().find(crosses)
            }
            Side::Right => {
                self.cracks.go_to(vee.tip.x - TOUCH);
                let near = self.cracks.ahead().take_while(|crack| crack.x < exit.x - TOUCH);
                near.into_iter().find(crosses)
            }
        }?;
        let tip = Point2::new(crack.x, height(crack.x));
        Some((Vee::one(tip, side, slope).walled(), side))
    }
}

/// Whether a cut has vertical flanks only.
fn is_slit(vee: Vee) -> bool {
    let is_wall = |slope: f64| slope.is_infinite();
    vee.left.is_none_or(is_wall) && vee.right.is_none_or(is_wall)
}
