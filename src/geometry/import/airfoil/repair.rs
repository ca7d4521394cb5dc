//! From what a file of an airfoil says to two sides that a profile can be made of, and what was changed for that.
//!
//! Nothing here bends a side where its points stand well: the chord is scaled as a whole, a side that ends early is led on, and
//! only where the sides cross are points moved. Each repair has its size as a share of the chord, and a bound
//! ([`Repair::goes_too_far`]) above which the file does not say what is meant.

use super::sheet::Sheet;
use super::sides::{Outline, Pair, height};
use super::{NOISE, Range, Side, Vertex};
use crate::point::Point2;

/// A place where an airfoil is not what its file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Repair {
    /// First byte of the place in the file.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// What differs.
    pub altered: Altered,
}

/// What is not as a file of an airfoil says. Lengths are shares of the chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Altered {
    /// Points that follow one another at one place, of which one is used.
    Doubled {
        count: usize,
        /// How far apart they are at most.
        apart: f64,
    },
    /// A chord that does not run from 0 to 1: x and z are scaled, x is moved.
    Chord {
        /// Where it begins in the file.
        from: f64,
        /// Where it ends in the file.
        to: f64,
        /// How far apart the sides are there.
        gap: f64,
    },
    /// Points of a side inside its outline, where x runs back: they are left out.
    Inside {
        side: Side,
        count: usize,
        /// How deep the deepest lies.
        deep: f64,
    },
    /// A side that begins after the other one: a straight line joins it to the leading edge.
    Joined {
        side: Side,
        /// The length of that line in x.
        by: f64,
    },
    /// A side that ends before the other one: it is extended straight.
    LedOn {
        side: Side,
        /// By so much of x.
        by: f64,
    },
    /// Sides that cross: where the lower one is above the upper, both run in the middle between them.
    Crossed {
        /// From this x on.
        from: f64,
        /// By how much the lower one is above the upper at most.
        by: f64,
    },
    /// A line of words between points.
    Words,
    /// Lines of words and digits after the last point, which may be points that are written wrong.
    Trailing { count: usize },
    /// Numbers of points that are not those of the file.
    Counts { stated: f64, found: usize },
    /// A third number, the same in all lines.
    Column { value: f64 },
}

/// How much of the chord may be added at the leading edge: little, for noses are round.
const LONGEST_JOINT: f64 = 0.005;

/// How far a side may be led on to the trailing edge.
const LONGEST_LEAD: f64 = 0.02;

/// How deep points may lie inside of the outline that passes over them: deeper ones are as likely the shape that is meant.
const DEEPEST_INSIDE: f64 = 0.02;

/// Trailing edges of whole airfoils are not thicker, but for a few that are blunt on purpose.
const THICKEST_END: f64 = 0.01;

/// By how much sides may cross; each is moved by half of it.
const DEEPEST_CROSSING: f64 = 0.01;

impl Repair {
    pub(super) fn new(range: Range<usize>, altered: Altered) -> Self {
        let offset = |place: usize| u32::try_from(place).unwrap_or(u32::MAX);
        Self {
            start: offset(range.start),
            end: offset(range.end),
            altered,
        }
    }

    /// The share of the chord up to which such a repair is made, where it is above that: more changes the shape.
    #[must_use]
    pub fn goes_too_far(&self) -> Option<f64> {
        let (size, most) = match self.altered {
            Altered::Joined { by, .. } => (by, LONGEST_JOINT),
            Altered::LedOn { by, .. } => (by, LONGEST_LEAD),
            Altered::Crossed { by, .. } => (by, DEEPEST_CROSSING),
            Altered::Inside { deep, .. } => (deep, DEEPEST_INSIDE),
            Altered::Chord { from, to, gap } => (missing(from, to, gap)?, LONGEST_LEAD),
            // These leave the shape as it is.
            Altered::Doubled { .. }
            | Altered::Words
            | Altered::Trailing { .. }
            | Altered::Counts { .. }
            | Altered::Column { .. } => return None,
        };
        (size > most).then_some(most)
    }

    /// Whether it bears on what is taken of an airfoil when that is one of its sides.
    #[must_use]
    pub fn concerns(&self, taken: Side) -> bool {
        match self.altered {
            Altered::Inside { side, .. } | Altered::Joined { side, .. } | Altered::LedOn { side, .. } => {
                side == taken
            }
            Altered::Doubled { .. }
            | Altered::Chord { .. }
            | Altered::Crossed { .. }
            | Altered::Words
            | Altered::Trailing { .. }
            | Altered::Counts { .. }
            | Altered::Column { .. } => true,
        }
    }
}

/// How much of a chord from 0 to 1 a file lacks at its end, where it looks cut off there: it begins at 0, reaches past the middle, and
/// the sides are still apart. Any other chord is in a unit of its own.
fn missing(from: f64, to: f64, gap: f64) -> Option<f64> {
    let is_cut_off = from.abs() <= LONGEST_LEAD && (0.5..1.0).contains(&to) && gap > THICKEST_END;
    is_cut_off.then_some(1.0 - to)
}

/// Leaves one of points that follow one another at the same place.
pub(super) fn join_doubled(sheet: &mut Sheet) {
    let (low, high) = super::sides::reach(&sheet.points);
    let chord = high - low;
    let mut kept: Vec<Vertex> = Vec::with_capacity(sheet.points.len());
    let mut runs: Vec<Run> = Vec::new();
    for vertex in &sheet.points {
        let last = kept.last().copied();
        let near = last.map(|last| (last, last.at.distance(vertex.at)));
        let Some((first, apart)) = near.filter(|(_, apart)| *apart <= NOISE * chord) else {
            kept.push(*vertex);
            continue;
        };
        match runs.last_mut().filter(|run| run.first == first.row) {
            Some(run) => {
                run.last = vertex.row;
                run.count += 1;
                run.apart = run.apart.max(apart);
            }
            None => runs.push(Run {
                first: first.row,
                last: vertex.row,
                count: 2,
                apart,
            }),
        }
    }
    for run in runs {
        let apart = if chord > 0.0 { run.apart / chord } else { 0.0 };
        let count = run.count;
        sheet.repaired(run.first, run.last, Altered::Doubled { count, apart });
    }
    sheet.points = kept;
}

/// Points that follow one another at one place.
struct Run {
    first: usize,
    last: usize,
    count: usize,
    apart: f64,
}

/// Moves and scales both sides so that the chord is 0 to 1, unless it is that or hardly longer.
pub(super) fn fit_the_chord(pair: &mut Pair, sheet: &mut Sheet) {
    /// How far the chord of a file may stand out at either end: such a profile is cut at the side of the stock.
    const OVER: f64 = 1e-4;
    let (from, to) = (pair.start, pair.end);
    if (-OVER..=0.0).contains(&from) && (1.0..=1.0 + OVER).contains(&to) {
        return;
    }
    let chord = to - from;
    for outline in [&mut pair.upper, &mut pair.lower] {
        for vertex in &mut outline.points {
            let (x, z) = ((vertex.at.x - from) / chord, vertex.at.z / chord);
            vertex.at = Point2::new(x, z);
        }
    }
    let differs = from.abs() > NOISE || (to - 1.0).abs() > NOISE;
    let last = |outline: &Outline| outline.points.last().map_or(0.0, |vertex| vertex.at.z);
    let gap = last(&pair.upper) - last(&pair.lower);
    if let (true, Some(nose)) = (differs, pair.leading()) {
        sheet.repaired(nose.row, nose.row, Altered::Chord { from, to, gap });
    }
    (pair.start, pair.end) = (0.0, 1.0);
}

/// Leads both sides to the leading and to the trailing edge.
pub(super) fn reach_both_edges(pair: &mut Pair, sheet: &mut Sheet) {
    let (upper, lower) = (&mut pair.upper, &mut pair.lower);
    join_at_the_nose(upper, lower, Side::Upper, sheet);
    join_at_the_nose(lower, upper, Side::Lower, sheet);
    lead_to_the_end(upper, lower, Side::Upper, sheet);
    lead_to_the_end(lower, upper, Side::Lower, sheet);
}

/// Noses are round, so a side that begins late is joined to the point where the other one begins.
fn join_at_the_nose(outline: &mut Outline, other: &Outline, side: Side, sheet: &mut Sheet) {
    let (Some(first), Some(nose)) = (outline.points.first().copied(), other.points.first().copied()) else {
        return;
    };
    let by = first.at.x - nose.at.x;
    if first.at.x <= 0.0 || by <= 0.0 {
        return;
    }
    outline.points.insert(0, nose);
    if by > NOISE {
        sheet.repaired(first.row, first.row, Altered::Joined { side, by });
    }
}

/// Towards the trailing edge sides run straight, so one that ends early continues as it ends, as far as the other side.
fn lead_to_the_end(outline: &mut Outline, other: &Outline, side: Side, sheet: &mut Sheet) {
    /// The steepest way on: at rounded ends the last points say nothing about the side.
    const STEEPEST: f64 = 1.0;
    let (Some(end), Some(last)) = (other.points.last().copied(), outline.points.last().copied()) else {
        return;
    };
    let by = 1.0 - last.at.x;
    if by <= 0.0 {
        return;
    }
    let before = outline
        .points
        .iter()
        .rev()
        .nth(1)
        .map_or(last.at, |before| before.at);
    let slope = match last.at.x - before.x {
        run if run > 0.0 => ((last.at.z - before.z) / run).clamp(-STEEPEST, STEEPEST),
        _ => 0.0,
    };
    let onward = last.at.z + slope * by;
    // Not through the other side, unless the sides have crossed already.
    let z = match side {
        Side::Upper => onward.max(end.at.z.min(last.at.z)),
        Side::Lower => onward.min(end.at.z.max(last.at.z)),
    };
    outline.points.push(Vertex {
        at: Point2::new(1.0, z),
        row: last.row,
    });
    if by > NOISE {
        sheet.repaired(last.row, last.row, Altered::LedOn { side, by });
    }
}

/// Where the lower side is above the upper one, leads both through the middle between them.
pub(super) fn uncross(pair: &mut Pair, sheet: &mut Sheet) {
    let Some(crossing) = Crossing::of(&pair.upper.points, &pair.lower.points) else {
        return;
    };
    let is_within = |vertex: &Vertex| {
        crossing
            .middle
            .iter()
            .any(|other| other.at.x.total_cmp(&vertex.at.x).is_eq())
    };
    for outline in [&mut pair.upper, &mut pair.lower] {
        outline.points.retain(|vertex| !is_within(vertex));
        outline.points.extend(&crossing.middle);
        outline
            .points
            .sort_by(|one, other| one.at.x.total_cmp(&other.at.x));
    }
    let altered = Altered::Crossed {
        from: crossing.from,
        by: crossing.by,
    };
    sheet.repaired(crossing.row, crossing.row, altered);
}

/// Where two sides cross.
struct Crossing {
    /// The points in the middle between the sides, wherever they have crossed.
    middle: Vec<Vertex>,
    from: f64,
    by: f64,
    /// The row of the first point that is on the wrong side.
    row: usize,
}

impl Crossing {
    fn of(upper: &[Vertex], lower: &[Vertex]) -> Option<Self> {
        let mut stands: Vec<Stand> = upper
            .iter()
            .chain(lower)
            .filter_map(|vertex| {
                let x = vertex.at.x;
                Some(Stand {
                    x,
                    upper: height(upper, x)?,
                    lower: height(lower, x)?,
                    row: vertex.row,
                })
            })
            .collect();
        stands.sort_by(|one, other| one.x.total_cmp(&other.x));
        stands.dedup_by(|one, other| one.x.total_cmp(&other.x).is_eq());
        let wrong = |stand: &&Stand| stand.over() > 0.0;
        let by = stands.iter().map(Stand::over).fold(0.0, f64::max);
        if by <= NOISE {
            return None;
        }
        let first = stands.iter().find(wrong)?;
        let mut middle: Vec<Vertex> = stands.iter().filter(wrong).map(Stand::middle).collect();
        for pair in stands.windows(2) {
            if let [before, after] = pair {
                middle.extend(before.meets(after));
            }
        }
        middle.sort_by(|one, other| one.at.x.total_cmp(&other.at.x));
        middle.dedup_by(|one, other| one.at.x.total_cmp(&other.at.x).is_eq());
        Some(Self {
            from: middle.first()?.at.x,
            by,
            row: first.row,
            middle,
        })
    }
}

/// The heights of both sides at one x.
struct Stand {
    x: f64,
    upper: f64,
    lower: f64,
    row: usize,
}

impl Stand {
    /// By how much the lower side is above the upper one.
    fn over(&self) -> f64 {
        self.lower - self.upper
    }

    fn middle(&self) -> Vertex {
        Vertex {
            at: Point2::new(self.x, f64::midpoint(self.upper, self.lower)),
            row: self.row,
        }
    }

    /// Where the sides meet between this x and the next, if they cross there.
    fn meets(&self, next: &Self) -> Option<Vertex> {
        let (before, after) = (self.over(), next.over());
        if before * after >= 0.0 {
            return None;
        }
        let share = before / (before - after);
        let at = Point2::new(self.x, self.upper).lerp(Point2::new(next.x, next.upper), share);
        (at.x > self.x && at.x < next.x).then_some(Vertex { at, row: next.row })
    }
}
