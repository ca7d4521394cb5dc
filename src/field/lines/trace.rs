//! Marching squares: where a field's real part changes its sign on a grid.

use crate::complex::Complex;
use crate::domain::{Grid, Ground};
use std::collections::BTreeMap;
use vcutc_region::place::Place;

/// A point of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    column: usize,
    row: usize,
}

impl Node {
    pub(super) fn place(self, grid: &Grid) -> Place {
        grid.place(self.column, self.row)
    }
}

/// An edge of the grid on which the sign changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub(super) from: Node,
    pub(super) to: Node,
    /// The field at both.
    pub(super) values: [Complex; 2],
    /// The crossings it is joined to, in the cells on both sides.
    joined: [Option<usize>; 2],
}

impl Crossing {
    fn join(&mut self, other: usize) {
        if let Some(free) = self.joined.iter_mut().find(|joined| joined.is_none()) {
            *free = Some(other);
        }
    }
}

/// Crossings in their order along a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Chain {
    pub(super) crossings: Vec<usize>,
}

impl Chain {
    /// Whether its last crossing is its first one.
    pub(super) fn is_closed(&self) -> bool {
        self.crossings.len() > 1 && self.crossings.first() == self.crossings.last()
    }
}

/// All crossings and chains of a grid.
#[derive(Clone, Debug)]
pub(super) struct Traced {
    pub(super) crossings: Vec<Crossing>,
    pub(super) chains: Vec<Chain>,
}

/// Traces the lines between the signs. Where both diagonals of a cell have one sign each, the sign of the real part in its
/// middle decides, which `middle` gives.
pub(super) fn trace(
    grid: &Grid,
    grounds: &[Ground],
    values: &[Complex],
    middle: impl Fn(Place) -> f64,
) -> Traced {
    let mut cells = Cells {
        grid,
        grounds,
        values,
        numbers: BTreeMap::new(),
        crossings: Vec::new(),
    };
    for row in 0..grid.rows.saturating_sub(1) {
        for column in 0..grid.columns.saturating_sub(1) {
            cells.cell(column, row, &middle);
        }
    }
    let crossings = cells.crossings;
    let chains = chains(&crossings);
    Traced { crossings, chains }
}

struct Cells<'a> {
    grid: &'a Grid,
    grounds: &'a [Ground],
    values: &'a [Complex],
    /// Crossings by the point their edge begins at, and the row and column it ends in.
    numbers: BTreeMap<(usize, usize), usize>,
    crossings: Vec<Crossing>,
}

impl Cells<'_> {
    /// The value at a point that is open to lines.
    fn value(&self, node: Node) -> Option<Complex> {
        let index = node.row * self.grid.columns + node.column;
        let is_open = self.grounds.get(index)?.is_open_to_lines();
        is_open.then(|| self.values.get(index).copied())?
    }

    fn cell(&mut self, column: usize, row: usize, middle: impl Fn(Place) -> f64) {
        // Counter-clockwise.
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(right, up)| Node {
            column: column + right,
            row: row + up,
        });
        let [Some(a), Some(b), Some(c), Some(d)] = corners.map(|node| self.value(node)) else {
            return;
        };
        let values = [a, b, c, d];
        let mut crossings = Vec::with_capacity(4);
        for (index, next) in [(0, 1), (1, 2), (3, 2), (0, 3)] {
            if (values[index].re >= 0.0) != (values[next].re >= 0.0) {
                crossings.push(self.crossing([corners[index], corners[next]], [values[index], values[next]]));
            }
        }
        match *crossings {
            [one, other] => self.join(one, other),
            // Below, right, above, left. The middle goes with the corner between left and below, or without it.
            [below, right, above, left] => {
                let at = corners[0].place(self.grid).lerp(corners[2].place(self.grid), 0.5);
                let is_with_first = (middle(at) >= 0.0) == (a.re >= 0.0);
                if is_with_first {
                    self.join(below, right);
                    self.join(above, left);
                } else {
                    self.join(left, below);
                    self.join(right, above);
                }
            }
            _ => {}
        }
    }

    fn crossing(&mut self, [from, to]: [Node; 2], values: [Complex; 2]) -> usize {
        let index = |node: Node| node.row * self.grid.columns + node.column;
        let next = self.crossings.len();
        let number = *self.numbers.entry((index(from), index(to))).or_insert(next);
        if number == next {
            self.crossings.push(Crossing {
                from,
                to,
                values,
                joined: [None; 2],
            });
        }
        number
    }

    fn join(&mut self, one: usize, other: usize) {
        for (number, neighbour) in [(one, other), (other, one)] {
            if let Some(crossing) = self.crossings.get_mut(number) {
                crossing.join(neighbour);
            }
        }
    }
}

/// The chains, first those with ends, by the number of their first crossing.
fn chains(crossings: &[Crossing]) -> Vec<Chain> {
    let mut is_used = vec![false; crossings.len()];
    let is_end = |crossing: &Crossing| crossing.joined.iter().flatten().count() == 1;
    let ends = (0..crossings.len()).filter(|&number| crossings.get(number).is_some_and(is_end));
    ends.chain(0..crossings.len())
        .filter_map(|start| follow(start, crossings, &mut is_used))
        .collect()
}

fn follow(start: usize, crossings: &[Crossing], is_used: &mut [bool]) -> Option<Chain> {
    let mut chain = Vec::new();
    let mut at = start;
    loop {
        if core::mem::replace(is_used.get_mut(at)?, true) {
            break;
        }
        chain.push(at);
        let joined = crossings.get(at)?.joined;
        let mut ahead = joined.into_iter().flatten();
        let Some(next) = ahead.find(|&next| is_used.get(next) == Some(&false)) else {
            // Back at the beginning, unless the chain has ends.
            if chain.len() > 2 && joined.contains(&Some(start)) {
                chain.push(start);
            }
            break;
        };
        at = next;
    }
    (chain.len() > 1).then_some(Chain { crossings: chain })
}
