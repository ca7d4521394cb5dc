//! The few postures of an operation, computed once each: most of its thousands of cuts hold the blade in four ways. Those of
//! narrower flanks are computed when they are asked for.

use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::Flank;
use vcutc_backend_api::units::Angle;
use vcutc_process::posture::{Feed, Holder};

/// So many ways from one posture to another are kept: those of cuts that are held alike.
const MOST_WAYS: usize = 64;

/// What an operation's postures are.
pub(super) struct Postures {
    holder: Holder,
    /// Of the left flank and of the right one at the operation's swing, each forward and backward.
    cutting: [[Orientation; 2]; 2],
    /// By way of what the blade turns from one posture to another, where that was asked.
    ways: Vec<(Orientation, Orientation, Option<Orientation>)>,
}

impl Postures {
    pub(super) fn of(holder: Holder) -> Self {
        let of = |flank| [Feed::Forward, Feed::Backward].map(|feed| holder.cutting(flank, feed));
        Self {
            holder,
            cutting: [Flank::Left, Flank::Right].map(of),
            ways: Vec::new(),
        }
    }

    /// As [`Holder::cutting`] at that swing.
    pub(super) fn cutting(&self, swing: Angle, flank: Flank, feed: Feed) -> Orientation {
        if swing != self.holder.swing {
            let narrower = Holder { swing, ..self.holder };
            return narrower.cutting(flank, feed);
        }
        let [left, right] = self.cutting;
        let [forward, backward] = match flank {
            Flank::Left => left,
            Flank::Right => right,
        };
        match feed {
            Feed::Forward => forward,
            Feed::Backward => backward,
        }
    }

    /// As [`Holder::cutting_along`] at that swing.
    pub(super) fn cutting_along(&self, swing: Angle, flank: Flank, feed: Feed, slope: f64) -> Orientation {
        if slope == 0.0 {
            return self.cutting(swing, flank, feed);
        }
        let holder = Holder { swing, ..self.holder };
        holder.cutting_along(flank, feed, slope)
    }

    /// As [`Holder::by_way_of`].
    pub(super) fn by_way_of(&mut self, from: Orientation, to: Orientation) -> Option<Orientation> {
        let known = self.ways.iter().find(|way| (way.0, way.1) == (from, to));
        if let Some((_, _, way)) = known {
            return *way;
        }
        let way = self.holder.by_way_of(from, to);
        // Along columns every cut has postures of its own.
        if self.ways.len() < MOST_WAYS {
            self.ways.push((from, to, way));
        }
        way
    }
}
