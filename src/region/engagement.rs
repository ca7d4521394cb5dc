//! How much of a tool's rim works in the material along its passes.
//!
//! A pass cuts what the passes before it left. Of the rim, the half that goes ahead can be in the material: what follows is over
//! ground that the tool has just cut. Of that half all lies in the material that no earlier piece of the tool's way has within the
//! radius, and that does not lie beyond an open side. Walls take no part, as the centre keeps from them. At a place the angle is
//! exact, by the crossings of the rim with the outlines of what earlier pieces cut.
//!
//! **Between places** a bound is proven. While the centre moves by at most `m` from the middle of a stretch, a place of the rim moves
//! by at most `m`; so it stays cut if an earlier piece has it within `radius - m`. Where the tool goes along an earlier piece, straight
//! or about the same centre, nothing changes but where that piece ends: so it stays cut if a piece shortened by `m` has it within the
//! radius. The angle that is left by such a narrower cut, taken about the middle, is never exceeded on the stretch. Stretches
//! are halved until the bound is close to what is found at their ends.

use crate::curve::Curve;
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::Region;
use core::f64::consts::FRAC_PI_2;

mod rim;

use rim::Cleared;

/// How close the bound over a stretch comes to the angles at its ends, in rad, unless the stretch is the shortest: 1 deg.
const CLOSE: f64 = core::f64::consts::PI / 180.0;

/// The same where less than a quarter of a turn works, as a share of what is missing to that: there feeds do not change.
const LOOSE: f64 = 0.25;

/// The longest and the shortest stretch, in radii of the tool.
const LONGEST: f64 = 1.0;
const SHORTEST: f64 = 1.0 / 512.0;

/// Most places and stretches that are looked at.
const MOST_LOOKS: usize = 4_000_000;

/// So many near pieces are the work of one more look.
const NEAR_PER_LOOK: usize = 8;

/// How much of the rim works along all passes.
#[derive(Clone, Debug, PartialEq)]
pub struct Engagement {
    /// The mean over the length of all passes, in rad.
    pub mean: f64,
    /// The largest angle at a place that was looked at, in rad.
    pub largest: f64,
    /// That place.
    pub at: Place,
    /// The angle that is never exceeded, in rad.
    pub bound: f64,
    /// The stretches of each pass.
    pub profiles: Vec<Vec<Stretch>>,
}

/// A stretch of a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Which piece of the pass it belongs to.
    pub piece: usize,
    /// Where it begins and ends, in mm from the beginning of the pass.
    pub way: [f64; 2],
    /// The angles at its beginning, in its middle and at its end, in rad: exact.
    pub angles: [f64; 3],
    /// The angle that is never exceeded along it, in rad.
    pub bound: f64,
}

/// The stretches of a pass, each with its piece and how long the pass is before that, in mm.
pub fn on_pieces<'s>(
    pass: &'s Pass,
    profile: &'s [Stretch],
) -> impl Iterator<Item = (&'s Stretch, Piece, f64)> {
    let mut begun = 0.0;
    let mut at = 0;
    profile.iter().filter_map(move |stretch| {
        while at < stretch.piece {
            begun += pass.pieces.get(at).map_or(0.0, |piece| piece.length());
            at += 1;
        }
        Some((stretch, *pass.pieces.get(stretch.piece)?, begun))
    })
}

/// Why no angles are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngagementFault {
    /// The tool has no radius.
    Tool,
    /// The passes are so long, change so often or have so short pieces that more places are needed than are looked at.
    Long {
        /// How many are looked at.
        most: usize,
    },
}

/// Finds how much of the rim works in the material, along passes in the order in which they are cut.
///
/// # Errors
/// The tool is not valid, or the work is beyond its bound.
pub fn engagement(region: &Region, passes: &[Pass], radius: f64) -> Result<Engagement, EngagementFault> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(EngagementFault::Tool);
    }
    let pieces: Vec<Piece> = passes
        .iter()
        .flat_map(|pass| pass.pieces.iter().copied())
        .collect();
    let mut follower = Follower::new(region, &pieces, radius);
    let (mut first, mut profiles) = (0, Vec::with_capacity(passes.len()));
    for pass in passes {
        let mut way = 0.0;
        let mut profile = Vec::new();
        for (number, &piece) in pass.pieces.iter().enumerate() {
            follower.follow(piece, first, number, way, &mut profile)?;
            way += piece.length();
            first += 1;
        }
        profiles.push(profile);
    }
    let (mut sum, mut length, mut bound) = (0.0, 0.0, 0.0_f64);
    for stretch in profiles.iter().flatten() {
        let [start, middle, end] = stretch.angles;
        let way = stretch.way[1] - stretch.way[0];
        // Simpson's rule.
        sum += way * (start + 4.0 * middle + end) / 6.0;
        length += way;
        bound = bound.max(stretch.bound);
    }
    let mean = if length > 0.0 { sum / length } else { 0.0 };
    let (largest, at) = follower.largest;
    Ok(Engagement {
        mean,
        largest,
        at,
        bound,
        profiles,
    })
}

/// Goes along pieces.
pub(crate) struct Follower {
    cleared: Cleared,
    largest: (f64, Place),
    budget: usize,
}

/// A piece that is followed.
struct Way {
    curve: Curve,
    length: f64,
    /// Its number in the pass, and how far from the pass's beginning it begins.
    number: usize,
    from: f64,
}

impl Follower {
    pub(crate) fn new(region: &Region, pieces: &[Piece], radius: f64) -> Self {
        let cleared = Cleared::new(region, pieces, radius);
        let largest = (0.0, Place::new(0.0, 0.0));
        Self {
            cleared,
            largest,
            budget: MOST_LOOKS,
        }
    }

    /// Bounds how much of the rim works along a piece, after the first ones were cut, in rad.
    ///
    /// # Errors
    /// The work is beyond its bound.
    pub(crate) fn bound(&mut self, piece: Piece, first: usize) -> Result<f64, EngagementFault> {
        self.budget = MOST_LOOKS;
        let mut profile = Vec::new();
        self.follow(piece, first, 0, 0.0, &mut profile)?;
        Ok(profile.iter().map(|stretch| stretch.bound).fold(0.0, f64::max))
    }

    /// Whether a place lies on one of the first pieces, give or take some mm.
    pub(crate) fn has_been_at(&self, place: Place, within: f64, first: usize) -> bool {
        self.cleared.has_been_at(place, within, first)
    }

    fn follow(
        &mut self,
        piece: Piece,
        first: usize,
        number: usize,
        from: f64,
        profile: &mut Vec<Stretch>,
    ) -> Result<(), EngagementFault> {
        let length = piece.length();
        if !piece.is_sound() || length <= 0.0 {
            return Ok(());
        }
        let way = Way {
            curve: Curve::of(piece),
            length,
            number,
            from,
        };
        let count = libm::ceil(length / (LONGEST * self.cleared.radius())).max(1.0);
        if count > MOST_LOOKS as f64 {
            return Err(EngagementFault::Long { most: MOST_LOOKS });
        }
        for step in 0..count as usize {
            let shares = [step, step + 1].map(|step| step as f64 / count);
            let middle = f64::midpoint(shares[0], shares[1]);
            // A little more than half of it, for rounding.
            let aside = 0.51 * length / count;
            self.cleared.approach(&way.curve, middle, aside, first);
            let ends = [self.angle(&way, shares[0])?, self.angle(&way, shares[1])?];
            self.halve(&way, shares, ends, profile)?;
        }
        Ok(())
    }

    /// Looks at a stretch between two shares of a way, or at both of its halves.
    fn halve(
        &mut self,
        way: &Way,
        shares: [f64; 2],
        angles: [f64; 2],
        profile: &mut Vec<Stretch>,
    ) -> Result<(), EngagementFault> {
        let [from, to] = shares;
        let middle = f64::midpoint(from, to);
        let half = (to - from) / 2.0 * way.length;
        let [start, end] = angles;
        let between = self.angle(way, middle)?;
        self.look()?;
        let found = start.max(end).max(between);
        let slack = CLOSE.max(LOOSE * (FRAC_PI_2 - found));
        let is_even = (between - f64::midpoint(start, end)).abs() <= slack;
        let is_shortest = 2.0 * half <= SHORTEST * self.cleared.radius();
        if is_even || is_shortest {
            let bound = self.cleared.angle_left(&way.curve, middle, half).max(found);
            if is_shortest || bound - found <= slack {
                profile.push(Stretch {
                    piece: way.number,
                    way: shares.map(|share| way.from + share * way.length),
                    angles: [start, between, end],
                    bound,
                });
                return Ok(());
            }
        }
        self.halve(way, [from, middle], [start, between], profile)?;
        self.halve(way, [middle, to], [between, end], profile)
    }

    /// The angle at a place.
    fn angle(&mut self, way: &Way, share: f64) -> Result<f64, EngagementFault> {
        self.look()?;
        let angle = self.cleared.angle_left(&way.curve, share, 0.0);
        if angle > self.largest.0 {
            self.largest = (angle, way.curve.piece.at(share));
        }
        Ok(angle)
    }

    fn look(&mut self) -> Result<(), EngagementFault> {
        let fault = EngagementFault::Long { most: MOST_LOOKS };
        let cost = 1 + self.cleared.near() / NEAR_PER_LOOK;
        self.budget = self.budget.checked_sub(cost).ok_or(fault)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
