//! Straight links between passes, at depth: the centre goes on without lifting the tool.
//!
//! A link is proven as a pass is. Its distance from walls is a closed form, and how much of the rim works along it has a bound. A
//! bound of 0 says that the whole disc stays within what was cut: it stands within it at the beginning, and comes upon material
//! with the front half of its rim only.

use crate::distance::Walls;
use crate::engagement::{EngagementFault, Follower};
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::Region;

/// A place this close to a pass, in mm, lies on it: arcs through rounded places return to them only so closely.
const ON_IT: f64 = 1e-6;

/// A straight way from one pass to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The way of the centre.
    pub piece: Piece,
    /// How much of the rim works along it at most, in rad.
    pub engagement: f64,
}

/// Passes that are cut one after another, ready to be linked.
pub struct Links {
    walls: Walls,
    follower: Follower,
    /// How many pieces the first passes have: none of them, one, two, and so on.
    counts: Vec<usize>,
    keep: f64,
}

impl Links {
    /// Prepares passes of a tool of this radius, in mm, whose centre keeps so many mm from walls.
    #[must_use]
    pub fn new(region: &Region, passes: &[Pass], radius: f64, keep: f64) -> Self {
        let pieces: Vec<Piece> = passes
            .iter()
            .flat_map(|pass| pass.pieces.iter().copied())
            .collect();
        let mut counts = vec![0];
        let mut count = 0;
        for pass in passes {
            count += pass.pieces.len();
            counts.push(count);
        }
        Self {
            walls: Walls::of(region),
            follower: Follower::new(region, &pieces, radius),
            counts,
            keep,
        }
    }

    /// The straight way between two places after the first passes are cut, so many of them; none where it comes too near to a wall,
    /// where it does not begin on one of these passes, or where more of the rim may work than `limit`, in rad.
    ///
    /// # Errors
    /// The work is beyond its bound.
    pub fn link(
        &mut self,
        cut: usize,
        from: Place,
        to: Place,
        limit: f64,
    ) -> Result<Option<Link>, EngagementFault> {
        let count = self.counts.get(cut).or(self.counts.last()).copied().unwrap_or(0);
        let piece = Piece::line(from, to);
        if !self.follower.has_been_at(from, ON_IT, count) || !self.keeps_off(piece) {
            return Ok(None);
        }
        let engagement = self.follower.bound(piece, count)?;
        Ok((engagement <= limit).then_some(Link { piece, engagement }))
    }

    fn keeps_off(&self, piece: Piece) -> bool {
        if !piece.is_sound() {
            return self.walls.distance(piece.from) >= self.keep;
        }
        self.walls
            .nearest_to(piece)
            .is_none_or(|(_, nearest)| nearest.distance >= self.keep)
    }
}

/// The straight way between two places after passes are cut, as [`Links::link`] finds it for a tool whose rim may touch the walls.
///
/// # Errors
/// The work is beyond its bound.
pub fn link(
    region: &Region,
    cleared: &[Pass],
    radius: f64,
    (from, to): (Place, Place),
    limit: f64,
) -> Result<Option<Link>, EngagementFault> {
    Links::new(region, cleared, radius, radius).link(cleared.len(), from, to, limit)
}

#[cfg(test)]
mod tests;
