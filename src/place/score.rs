//! What places are compared by.

use core::cmp::Ordering;
use vcutc_backend_api::units::Length;
use vcutc_dynamics::deviation::moved_base::MovedBase;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_motion::critical::margin::{self, Effort, Judge};

/// What a place is to be best in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Objective {
    /// The largest margin.
    #[default]
    Margin,
    /// The smallest deviation of the cuts, of all places with a margin of [`LEAST_MARGIN`].
    Deviation,
}

/// The margin that a place keeps that is chosen for its deviation, from 0 to 1.
pub const LEAST_MARGIN: f64 = 0.1;

/// The margin of taught poses that a search asks for: on the motions between them it is a little smaller.
const SOUGHT_MARGIN: f64 = LEAST_MARGIN + 0.01;

/// How good a place is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// What room the poses leave there.
    pub room: margin::Score,
    /// How far the forces of blades push cuts off there, by a few places of them. None where that is not asked, or the margin is too small.
    pub deviation: Option<Length>,
}

impl Score {
    /// The margin where all poses are reached within the limits.
    #[must_use]
    pub fn reached(self) -> Option<f64> {
        self.room.reached()
    }

    /// Orders scores: the better is the greater.
    #[must_use]
    pub fn better(&self, other: &Self) -> Ordering {
        let by_deviation = match (self.deviation, other.deviation) {
            (Some(one), Some(other)) => other.to_mm().total_cmp(&one.to_mm()),
            (Some(_), None) => Ordering::Greater,
            (None, Some(_)) => Ordering::Less,
            (None, None) => Ordering::Equal,
        };
        by_deviation.then(self.room.better(&other.room))
    }
}

/// Scores places.
#[derive(Clone, Copy)]
pub struct Scorer<'s, 'm> {
    pub judge: &'s Judge<'m>,
    /// Deviations, where places are compared by them.
    pub moved: Option<&'s MovedBase<'s, 's>>,
}

impl<'s, 'm> Scorer<'s, 'm> {
    /// By the margin.
    #[must_use]
    pub const fn by_margin(judge: &'s Judge<'m>) -> Self {
        Self { judge, moved: None }
    }

    /// How good a place is where the work stands so.
    #[must_use]
    pub fn score(&self, work_in_root: &Pose) -> Score {
        let Some((room, branch)) = self.judge.best(work_in_root) else {
            return Score {
                room: margin::Score::WORST,
                deviation: None,
            };
        };
        let has_room = room.reached().is_some_and(|margin| margin >= SOUGHT_MARGIN);
        let moved = self.moved.filter(|_| has_room);
        Score {
            room,
            deviation: moved.and_then(|moved| moved.most(work_in_root, branch)),
        }
    }

    /// What places are compared by.
    #[must_use]
    pub const fn objective(&self) -> Objective {
        match self.moved {
            Some(_) => Objective::Deviation,
            None => Objective::Margin,
        }
    }

    /// How much a search may ask.
    #[must_use]
    pub const fn effort(&self) -> Effort {
        self.judge.effort()
    }
}
