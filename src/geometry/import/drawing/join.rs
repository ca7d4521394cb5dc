//! Which ends of lines belong together.
//!
//! Ends that coincide are paired first. Where more than two do the drawing branches, and it is not clear
//! which way the outline goes. Ends that are still loose are then paired within the tolerance, the nearest
//! first.
//!
//! Neighbours are found in a grid whose cells are so small that two ends in one cell are within reach of each other; so
//! the work is bounded by the number of ends in a cell, and that is bounded too.

use crate::point::Point2;
use std::collections::BTreeMap;

/// Ends closer than this coincide, in mm: a nanometre, as everywhere in profiles.
pub(super) const SAME: f64 = 1e-6;

/// Most pairs of loose ends within the tolerance. A tolerance that allows more is larger than what is drawn.
const MOST_PAIRS: usize = 4_000_000;

/// Most ends within a cell.
const MOST_IN_A_CELL: usize = 64;

/// An end of a line that may be joined.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// The line, as a place in a list.
    pub(super) line: usize,
    pub(super) at: Point2,
}

/// Why ends cannot be paired.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum JoinError {
    /// More than two ends meet.
    Branch {
        at: Point2,
        /// Lines that do, three or more unless a line meets itself there.
        lines: Vec<usize>,
    },
    /// So many ends are near each other that the tolerance says nothing.
    Crowded { at: Point2 },
}

/// For each end the one it is joined to, if any. `ends` holds the two ends of each line in turn; `may_close` says whether
/// the two ends of a line may be joined to each other within the tolerance.
pub(super) fn join(
    ends: &[End],
    tolerance: f64,
    may_close: &dyn Fn(usize) -> bool,
) -> Result<Vec<Option<usize>>, JoinError> {
    let mut partners = vec![None; ends.len()];
    let all: Vec<usize> = (0..ends.len()).collect();
    for pair in pairs(ends, &all, SAME)? {
        let is_own = ends[pair.one].line == ends[pair.other].line;
        if is_own && !may_close(ends[pair.one].line) {
            continue;
        }
        match (partners[pair.one], partners[pair.other]) {
            (None, None) => connect(&mut partners, pair),
            (first, second) => {
                let met = [Some(pair.one), Some(pair.other), first, second];
                return Err(branch(ends, ends[pair.one].at, met.into_iter().flatten()));
            }
        }
    }
    let loose: Vec<usize> = all.into_iter().filter(|&end| partners[end].is_none()).collect();
    for pair in pairs(ends, &loose, tolerance)? {
        let is_own = ends[pair.one].line == ends[pair.other].line;
        let is_free = partners[pair.one].is_none() && partners[pair.other].is_none();
        if is_free && (!is_own || may_close(ends[pair.one].line)) {
            connect(&mut partners, pair);
        }
    }
    Ok(partners)
}

fn connect(partners: &mut [Option<usize>], pair: Pair) {
    partners[pair.one] = Some(pair.other);
    partners[pair.other] = Some(pair.one);
}

fn branch(ends: &[End], at: Point2, met: impl Iterator<Item = usize>) -> JoinError {
    let mut lines: Vec<usize> = met.map(|end| ends[end].line).collect();
    lines.sort_unstable();
    lines.dedup();
    JoinError::Branch { at, lines }
}

/// Two ends that are near each other.
#[derive(Clone, Copy, Debug)]
struct Pair {
    distance: f64,
    one: usize,
    other: usize,
}

/// All pairs within reach of each other, the nearest first.
fn pairs(ends: &[End], candidates: &[usize], reach: f64) -> Result<Vec<Pair>, JoinError> {
    let cell = reach / core::f64::consts::SQRT_2;
    // Coordinates end at 1e9 and reaches begin at 1e-6, so that the numbers of cells are exact.
    let key = |at: Point2| (libm::floor(at.x / cell) as i64, libm::floor(at.z / cell) as i64);
    let mut grid: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for &end in candidates {
        let members = grid.entry(key(ends[end].at)).or_default();
        if members.len() >= MOST_IN_A_CELL {
            return Err(JoinError::Crowded { at: ends[end].at });
        }
        members.push(end);
    }
    let mut found = Vec::new();
    for &one in candidates {
        let (column, row) = key(ends[one].at);
        let near = (column - 2..=column + 2)
            .flat_map(|column| grid.range((column, row - 2)..=(column, row + 2)))
            .flat_map(|(_, members)| members);
        for &other in near {
            let distance = ends[one].at.distance(ends[other].at);
            if one < other && distance <= reach {
                if found.len() >= MOST_PAIRS {
                    return Err(JoinError::Crowded { at: ends[one].at });
                }
                found.push(Pair { distance, one, other });
            }
        }
    }
    found.sort_by(|a, b| {
        let order = a.distance.total_cmp(&b.distance);
        order.then((a.one, a.other).cmp(&(b.one, b.other)))
    });
    Ok(found)
}
