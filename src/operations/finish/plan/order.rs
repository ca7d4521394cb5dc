//! In which order tracks are cut: runs along x, each from one place to another.

use crate::asked::Sequence;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::surface::Side;

/// Crests that stand out less than this make no runs of their own, in mm.
const WORTH: f64 = 1.0;

/// Tracks one after the other towards a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Run {
    /// The side that it goes to.
    pub(crate) fn side(self) -> Side {
        if self.to >= self.from {
            Side::Right
        } else {
            Side::Left
        }
    }

    /// Whether it goes over an x.
    pub(crate) fn covers(self, x: f64) -> bool {
        (self.from.min(self.to)..=self.from.max(self.to)).contains(&x)
    }
}

/// The runs of an order, in turn. Each begins at a side of the stock or at a crest, and ends at a side or in a valley. Which
/// tracks go down to which side is the same in both orders that go down.
pub(crate) fn runs(part: &Profile, sequence: Sequence) -> Vec<Run> {
    let (start, end) = part.span();
    match sequence {
        Sequence::Rightwards => vec![Run { from: start, to: end }],
        Sequence::Leftwards => vec![Run { from: end, to: start }],
        Sequence::Crests | Sequence::Descending => descending(part),
    }
}

/// From every crest to both sides, the highest crest first.
fn descending(part: &Profile) -> Vec<Run> {
    let turns = turning_points(part);
    let mut crests: Vec<(f64, Vec<Run>)> = Vec::new();
    for (number, &(at, kind)) in turns.iter().enumerate() {
        if kind == Turn::Valley {
            continue;
        }
        let beside = |step: Option<usize>| step.and_then(|step| turns.get(step)).map(|(beside, _)| beside.x);
        let ends = [beside(number.checked_add(1)), beside(number.checked_sub(1))];
        let runs = ends.into_iter().flatten().map(|to| Run { from: at.x, to });
        crests.push((at.z, runs.collect()));
    }
    crests.sort_by(|a, b| b.0.total_cmp(&a.0));
    crests.into_iter().flat_map(|(_, runs)| runs).collect()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    Crest,
    Valley,
}

/// Crests and valleys in turn from side to side, both sides among them.
fn turning_points(part: &Profile) -> Vec<(Point2, Turn)> {
    let points = part.points();
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let mut turns: Vec<(Point2, Turn)> = Vec::new();
    let (mut highest, mut lowest) = (first, first);
    // Where the part goes after the last turn, as far as that is known.
    let mut rises: Option<Turn> = None;
    for &point in points {
        highest = if point.z > highest.z { point } else { highest };
        lowest = if point.z < lowest.z { point } else { lowest };
        let fell = highest.z - point.z > WORTH && rises != Some(Turn::Valley);
        let rose = point.z - lowest.z > WORTH && rises != Some(Turn::Crest);
        if fell {
            turns.push((highest, Turn::Crest));
            (rises, lowest) = (Some(Turn::Valley), point);
        } else if rose {
            turns.push((lowest, Turn::Valley));
            (rises, highest) = (Some(Turn::Crest), point);
        }
    }
    let ending = match rises {
        Some(kind) => kind,
        // All of it nearly level: from the left to the right.
        None => {
            return vec![(first, Turn::Crest), (last, Turn::Valley)];
        }
    };
    turns.push((last, ending));
    if let Some(begin) = turns.first_mut() {
        begin.0 = Point2::new(first.x, begin.0.z);
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(heights: &[f64]) -> Profile {
        let points = (0_u32..)
            .zip(heights)
            .map(|(i, &z)| Point2::new(f64::from(i) * 10.0, z));
        Profile::new(points.collect()).unwrap()
    }

    fn descend(heights: &[f64]) -> Vec<[f64; 2]> {
        let runs = runs(&part(heights), Sequence::Crests);
        runs.into_iter().map(|run| [run.from, run.to]).collect()
    }

    #[test]
    fn runs_go_down_from_crests() {
        assert_eq!(descend(&[0.0, 5.0, 10.0]), [[20.0, 0.0]]);
        assert_eq!(descend(&[10.0, 5.0, 0.0]), [[0.0, 20.0]]);
        assert_eq!(descend(&[0.0, 10.0, 0.0]), [[10.0, 20.0], [10.0, 0.0]]);
        assert_eq!(descend(&[8.0, 0.0, 9.0]), [[20.0, 10.0], [0.0, 10.0]]);
        // Ripples are not crests.
        assert_eq!(descend(&[10.0, 6.0, 6.5, 0.0]), [[0.0, 30.0]]);
        assert_eq!(descend(&[5.0, 5.0]), [[0.0, 10.0]]);
        assert_eq!(
            descend(&[0.0, 6.0, 2.0, 9.0, 1.0]),
            [[30.0, 40.0], [30.0, 20.0], [10.0, 20.0], [10.0, 0.0]]
        );
    }
}
