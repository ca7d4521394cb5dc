//! The quadtree of boxes: what is cut, and what is not, box by box.

use super::clip::{Scrap, half_diagonal, middle};
use super::grid::{Grid, cuts};
use super::{CoverageFault, Square, Tool};
use crate::boxes::{Extent, Tree};
use crate::curve::Curve;
use crate::place::Place;
use crate::region::{Inside, Region, Side};
use core::ops::Range;

/// How often boxes are quartered. Boxes of a 128th of the radius depart from arcs of it by a 16,000th of that.
const MOST_QUARTERINGS: u32 = 6;

/// Boxes of the grid, chunks of passes, and boxes that are looked into.
const MOST_BOXES: usize = 2_000_000;

/// So many pieces near to a box are the work of one more box.
const NEAR_PER_BOX: usize = 64;

/// What is to be proven cut, by what.
pub(super) struct Ground {
    /// Passes, or what stands for them.
    pub(super) passes: Vec<Curve>,
    /// The boundary of the region, walls and open sides.
    pub(super) edges: Vec<(Curve, Side)>,
    /// Parts of the edge of where the centre may go that no pass follows.
    missed: Vec<Curve>,
    inside: Inside,
    pub(super) tool: Tool,
    domain: Domain,
    grid: Grid,
}

/// Which places are looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Domain {
    /// Those where the centre may go, and all that is reachable from parts of the edge that were missed.
    Reachable,
    /// Those where the centre may not go.
    Beyond,
}

/// A box that is not cut, or not proven to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub(super) square: Square,
    /// What of it may be uncut, in mm2.
    pub(super) area: f64,
    /// Its least corner and its side, counted in the sides of the smallest boxes.
    pub(super) column: u32,
    pub(super) row: u32,
    pub(super) size: u32,
}

/// All of them.
pub(super) struct Left {
    pub(super) leaves: Vec<Leaf>,
}

impl Left {
    /// Their area, in mm2.
    pub(super) fn area(&self) -> f64 {
        self.leaves.iter().fold(0.0, |sum, leaf| sum + leaf.area)
    }
}

impl Ground {
    pub(super) fn new(region: &Region, passes: Vec<Curve>, missed: Vec<Curve>, tool: Tool) -> Self {
        Self::of(region, passes, missed, tool, Domain::Reachable)
    }

    /// Asks for what lies beyond the reach of a tool whose centre goes along the given edge.
    pub(super) fn beyond(region: &Region, edge: Vec<Curve>, tool: Tool) -> Self {
        Self::of(region, edge, Vec::new(), tool, Domain::Beyond)
    }

    fn of(region: &Region, passes: Vec<Curve>, missed: Vec<Curve>, tool: Tool, domain: Domain) -> Self {
        let grid = Grid::over(region.bounds(), tool.radius);
        let edges = region
            .edges()
            .map(|edge| (Curve::of(edge.piece), edge.side))
            .collect();
        let inside = Inside::of(region);
        Self {
            passes,
            edges,
            missed,
            inside,
            tool,
            domain,
            grid,
        }
    }

    /// All boxes that are not proven cut.
    pub(super) fn uncut(&self) -> Result<Left, CoverageFault> {
        let fault = CoverageFault::Fine { most: MOST_BOXES };
        let count = self.grid.columns.saturating_mul(self.grid.rows);
        if count > MOST_BOXES {
            return Err(fault);
        }
        let mut cut = vec![false; count];
        self.grid
            .mark(&self.passes, self.tool.radius, &mut cut, MOST_BOXES)
            .ok_or(fault)?;
        let mut search = Search {
            ground: self,
            near: Vec::new(),
            scrap: Scrap::new(),
            leaves: Vec::new(),
            budget: MOST_BOXES,
        };
        let trees = Trees::of(self);
        for (row, marks) in cut.chunks(self.grid.columns).enumerate() {
            for (column, _) in marks.iter().enumerate().filter(|(_, cut)| !**cut) {
                search.start(&trees, column, row).ok_or(fault)?;
            }
        }
        Ok(Left {
            leaves: search.leaves,
        })
    }
}

/// Trees over what decides about boxes.
struct Trees {
    passes: Tree,
    edges: Tree,
    missed: Tree,
}

impl Trees {
    fn of(ground: &Ground) -> Self {
        let tree = |curves: &mut dyn Iterator<Item = &Curve>| {
            let extents: Vec<Extent> = curves.map(Curve::extent).collect();
            Tree::of(&extents)
        };
        Self {
            passes: tree(&mut ground.passes.iter()),
            edges: tree(&mut ground.edges.iter().map(|(curve, _)| curve)),
            missed: tree(&mut ground.missed.iter()),
        }
    }
}

/// A box on its way down.
#[derive(Clone)]
struct Open {
    leaf: Leaf,
    quarterings: u32,
    /// Whether no edge meets it, and it is known to lie in the region.
    is_within: bool,
    /// What is near to it, as parts of one list: passes, edges, missed parts.
    passes: Range<usize>,
    edges: Range<usize>,
    missed: Range<usize>,
}

struct Search<'a> {
    ground: &'a Ground,
    /// Numbers of what is near to the boxes from the root to the one that is looked at.
    near: Vec<u32>,
    scrap: Scrap,
    leaves: Vec<Leaf>,
    budget: usize,
}

/// What is known about a box from distances to its middle.
struct Nearby {
    pass: f64,
    wall: f64,
    missed: f64,
    /// How many edges may meet it.
    meeting: usize,
}

impl Search<'_> {
    /// Looks into a box of the grid; none where the work is beyond its bound.
    fn start(&mut self, trees: &Trees, column: usize, row: usize) -> Option<()> {
        let square = self.ground.grid.square(column, row);
        let (at, half) = (middle(square), half_diagonal(square));
        let tool = self.ground.tool;
        self.near.clear();
        let mut list = |tree: &Tree, reach: f64| {
            let first = self.near.len();
            tree.around(at, reach, &mut |thing| {
                self.near.push(thing);
                reach
            });
            first..self.near.len()
        };
        let edges = list(&trees.edges, tool.keep + half);
        let passes = list(&trees.passes, tool.radius + half);
        let missed = list(&trees.missed, tool.radius + half);
        let unit = 1_u32 << MOST_QUARTERINGS;
        let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX).saturating_mul(unit);
        let leaf = Leaf {
            square,
            area: 0.0,
            column: count(column),
            row: count(row),
            size: unit,
        };
        self.look(&Open {
            leaf,
            quarterings: 0,
            is_within: false,
            passes,
            edges,
            missed,
        })
    }

    fn look(&mut self, open: &Open) -> Option<()> {
        let near = open.passes.len() + open.edges.len() + open.missed.len();
        self.budget = self.budget.checked_sub(1 + near / NEAR_PER_BOX)?;
        let (ground, square) = (self.ground, open.leaf.square);
        let (at, half) = (middle(square), half_diagonal(square));
        let kept = self.near.len();
        let (radius, keep) = (ground.tool.radius, ground.tool.keep);
        let mut nearby = Nearby {
            pass: f64::INFINITY,
            wall: f64::INFINITY,
            missed: f64::INFINITY,
            meeting: 0,
        };
        let edges = self.select(
            &open.edges,
            keep + half,
            |i| ground.edges.get(i).map(|(curve, _)| curve),
            at,
        );
        for i in edges.clone() {
            let edge = self.near.get(i).and_then(|&i| ground.edges.get(i as usize));
            if let Some((curve, side)) = edge {
                let distance = curve.distance(at);
                nearby.meeting += usize::from(distance <= half);
                if *side == Side::Wall {
                    nearby.wall = nearby.wall.min(distance);
                }
            }
        }
        let missed = self.select(&open.missed, radius + half, |i| ground.missed.get(i), at);
        nearby.missed = self.least(&missed, |i| ground.missed.get(i), at);
        if self.is_outside(&nearby, half) {
            self.near.truncate(kept);
            return Some(());
        }
        let passes = self.select(&open.passes, radius + half, |i| ground.passes.get(i), at);
        nearby.pass = self.least(&passes, |i| ground.passes.get(i), at);
        let below = Open {
            leaf: open.leaf,
            quarterings: open.quarterings,
            is_within: open.is_within,
            passes,
            edges,
            missed,
        };
        let result = self.decide(below, &nearby, half);
        self.near.truncate(kept);
        result
    }

    /// Decides about a box, or about its quarters.
    fn decide(&mut self, mut open: Open, nearby: &Nearby, half: f64) -> Option<()> {
        let (ground, square) = (self.ground, open.leaf.square);
        let radius = ground.tool.radius;
        if nearby.pass + half <= radius || self.is_cut(&open.passes, square) {
            return Some(());
        }
        if nearby.meeting == 0 && !open.is_within {
            if !ground.inside.contains(middle(square)) {
                return Some(());
            }
            open.is_within = true;
        }
        if nearby.meeting == 0 && nearby.pass - half >= radius && self.is_wanted(nearby, half) {
            let area = square.side * square.side;
            self.leaves.push(Leaf { area, ..open.leaf });
            return Some(());
        }
        if open.quarterings == MOST_QUARTERINGS {
            self.clip(&open, nearby, half);
            return Some(());
        }
        let side = square.side / 2.0;
        let size = open.leaf.size / 2;
        for (right, up) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let aside = Place::new(f64::from(right) * side, f64::from(up) * side);
            let leaf = Leaf {
                square: Square {
                    low: square.low.plus(aside),
                    side,
                },
                area: 0.0,
                column: open.leaf.column.saturating_add(right * size),
                row: open.leaf.row.saturating_add(up * size),
                size,
            };
            let quarter = Open {
                leaf,
                quarterings: open.quarterings + 1,
                ..open.clone()
            };
            self.look(&quarter)?;
        }
        Some(())
    }

    /// Whether nothing of a box is looked at.
    fn is_outside(&self, nearby: &Nearby, half: f64) -> bool {
        let keep = self.ground.tool.keep;
        match self.ground.domain {
            Domain::Reachable => nearby.wall + half < keep && nearby.missed == f64::INFINITY,
            Domain::Beyond => nearby.wall - half >= keep,
        }
    }

    /// Whether all of a box is looked at, if it lies in the region.
    fn is_wanted(&self, nearby: &Nearby, half: f64) -> bool {
        let Tool { radius, keep } = self.ground.tool;
        match self.ground.domain {
            Domain::Reachable => nearby.wall - half >= keep || nearby.missed + half <= radius,
            Domain::Beyond => nearby.wall + half <= keep,
        }
    }

    fn is_cut(&self, passes: &Range<usize>, square: Square) -> bool {
        let near = self.near.get(passes.clone()).unwrap_or_default();
        let mut near = near.iter().filter_map(|&i| self.ground.passes.get(i as usize));
        near.any(|pass| cuts(pass, square, self.ground.tool.radius))
    }

    /// Takes away from a smallest box what half planes can.
    fn clip(&mut self, open: &Open, nearby: &Nearby, half: f64) {
        let Self {
            ground, near, scrap, ..
        } = self;
        let Tool { radius, keep } = ground.tool;
        let list = |range: &Range<usize>| near.get(range.clone()).unwrap_or_default();
        scrap.restart(open.leaf.square);
        for pass in list(&open.passes) {
            if let Some(pass) = ground.passes.get(*pass as usize) {
                scrap.cut_within(pass, radius);
            }
        }
        let edges = list(&open.edges)
            .iter()
            .filter_map(|&i| ground.edges.get(i as usize));
        let at = middle(open.leaf.square);
        let meeting: Vec<&Curve> = edges
            .clone()
            .map(|(curve, _)| curve)
            .filter(|curve| curve.distance(at) <= half)
            .collect();
        match meeting.as_slice() {
            [edge] => scrap.keep_left(edge),
            [one, other] if makes_corner(one, other) || makes_corner(other, one) => {
                scrap.keep_left(one);
                scrap.keep_left(other);
            }
            _ => {}
        }
        if ground.domain == Domain::Reachable {
            match list(&open.missed) {
                [] => {
                    for (wall, _) in edges.filter(|(_, side)| *side == Side::Wall) {
                        scrap.cut_within(wall, keep);
                    }
                }
                missed if nearby.wall + half < keep => {
                    let missed = missed.iter().filter_map(|&i| ground.missed.get(i as usize));
                    scrap.keep_within(&missed.collect::<Vec<_>>(), radius);
                }
                _ => {}
            }
        }
        let area = scrap.area();
        if area > 0.0 {
            self.leaves.push(Leaf { area, ..open.leaf });
        }
    }

    /// Lists, once more, what of a list is within a distance.
    fn select<'b>(
        &mut self,
        range: &Range<usize>,
        reach: f64,
        curve: impl Fn(usize) -> Option<&'b Curve>,
        at: Place,
    ) -> Range<usize> {
        let first = self.near.len();
        for place in range.clone() {
            if let Some(&number) = self.near.get(place)
                && curve(number as usize).is_some_and(|curve| curve.distance(at) <= reach)
            {
                self.near.push(number);
            }
        }
        first..self.near.len()
    }

    fn least<'b>(&self, range: &Range<usize>, curve: impl Fn(usize) -> Option<&'b Curve>, at: Place) -> f64 {
        let near = self.near.get(range.clone()).unwrap_or_default();
        let curves = near.iter().filter_map(|&i| curve(i as usize));
        curves
            .map(|curve| curve.distance(at))
            .fold(f64::INFINITY, f64::min)
    }
}

/// Whether an edge ends where another begins, in a corner that sticks out of the region.
fn makes_corner(one: &Curve, other: &Curve) -> bool {
    one.piece.to == other.piece.from && one.arrival.cross(other.ahead) > 0.0
}
