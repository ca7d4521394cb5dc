//! Regions and programs seen from above, by samples: how far ways of the tool are from walls, and what they leave. Knows neither
//! offsets nor boxes nor arcs of the compiler; a boundary is a list of short straight sides.

use core::f64::consts::TAU;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, OperationId, Program, Site};

pub(crate) type Spot = [f64; 2];

pub(crate) fn distance(a: Spot, b: Spot) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

pub(crate) fn to_segment(at: Spot, [a, b]: [Spot; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let share = ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / (dx * dx + dy * dy);
    let share = share.clamp(0.0, 1.0);
    distance(at, [a[0] + share * dx, a[1] + share * dy])
}

/// Places of the tool's centre along all ways through the work: layer, height, and place.
pub(crate) fn ways(program: &Program) -> Vec<(u32, Point3)> {
    ways_of(program, |_| true)
}

/// The same of some operations.
pub(crate) fn ways_of(program: &Program, is_wanted: impl Fn(OperationId) -> bool) -> Vec<(u32, Point3)> {
    let mut places = Vec::new();
    for segment in program.segments() {
        let (Site::Cut { layer, operation, .. }, Action::Follow { .. }) =
            (segment.op.site, segment.op.action)
        else {
            continue;
        };
        if !is_wanted(operation) {
            continue;
        }
        let line = segment.line().unwrap();
        let [from, to] = [line.from.tip, line.to.tip];
        let long = from.distance(to).to_mm();
        match line.via {
            None => {
                let count = (long / 0.2).ceil().max(1.0) as u32;
                for k in 0..=count {
                    let t = f64::from(k) / f64::from(count);
                    let at = |a: f64, b: f64| a + (b - a) * t;
                    places.push((
                        layer.get(),
                        Point3::new(at(from.x, to.x), at(from.y, to.y), at(from.z, to.z)),
                    ));
                }
            }
            Some(via) => places.extend(arc([from, via, to]).map(|at| (layer.get(), at))),
        }
    }
    places
}

/// Places on the circle through three, all at one height, from the first to the last.
fn arc([a, b, c]: [Point3; 3]) -> impl Iterator<Item = Point3> {
    let (bx, by, cx, cy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    let twice = 2.0 * (bx * cy - by * cx);
    let (bb, cc) = (bx * bx + by * by, cx * cx + cy * cy);
    let (ux, uy) = ((cy * bb - by * cc) / twice, (bx * cc - cx * bb) / twice);
    let radius = ux.hypot(uy);
    let angle = |x: f64, y: f64| (y - uy).atan2(x - ux);
    let (first, middle, last) = (angle(0.0, 0.0), angle(bx, by), angle(cx, cy));
    let turn = |from: f64, to: f64| (to - from).rem_euclid(TAU);
    let sweep = if turn(first, middle) <= turn(first, last) {
        turn(first, last)
    } else {
        -turn(last, first)
    };
    let count = (radius * sweep.abs() / 0.1).ceil().max(4.0) as u32;
    (0..=count).map(move |k| {
        let angle = first + sweep * f64::from(k) / f64::from(count);
        Point3::new(
            a.x + ux + radius * angle.cos(),
            a.y + uy + radius * angle.sin(),
            a.z,
        )
    })
}

/// Largest distance of chords from their curves, in mm.
const CHORD: f64 = 5e-4;

/// Places on a circle, to the left from an angle on, in rad.
pub(crate) fn along_circle(centre: Spot, radius: f64, from: f64, sweep: f64) -> Vec<Spot> {
    let longest = (8.0 * radius * CHORD).sqrt();
    let count = (radius * sweep.abs() / longest).ceil().max(1.0) as u32;
    let at = |k: u32| {
        let (sin, cos) = (from + sweep * f64::from(k) / f64::from(count)).sin_cos();
        [centre[0] + radius * cos, centre[1] + radius * sin]
    };
    (0..=count).map(at).collect()
}

/// Side of the squares that are looked at, in mm.
const SQUARE: f64 = 0.5;

/// Longest piece of a side in a cell, and how wide cells are, in mm.
const CELL: f64 = 1.0;

/// The boundary of a region.
#[derive(Clone, Debug)]
pub(crate) struct Boundary {
    walls: Vec<[Spot; 2]>,
    open: Vec<[Spot; 2]>,
    low: Spot,
    columns: usize,
    rows: usize,
    /// Pieces of walls, no longer than a cell, by the cell of their middle.
    cells: Vec<Vec<[Spot; 2]>>,
    inside: Raster,
}

impl Boundary {
    /// Sides between cleared ground and core, and sides beyond which there is none.
    pub(crate) fn of(walls: Vec<[Spot; 2]>, open: Vec<[Spot; 2]>) -> Self {
        let ends = || walls.iter().chain(&open).flatten();
        let least = |axis: usize| ends().map(|at| at[axis]).fold(f64::INFINITY, f64::min) - 30.0;
        let most = |axis: usize| ends().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max) + 30.0;
        let low = [least(0), least(1)];
        let count = |axis: usize| ((most(axis) - low[axis]) / CELL).ceil() as usize;
        let (columns, rows) = (count(0), count(1));
        let mut boundary = Self {
            low,
            columns,
            rows,
            cells: vec![Vec::new(); columns * rows],
            inside: Raster::empty(low, columns * 2, rows * 2),
            walls,
            open,
        };
        for [from, to] in boundary.walls.clone() {
            let count = (distance(from, to) / CELL).ceil().max(1.0);
            let at = |k: f64| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * k / count);
            for k in 0..count as u32 {
                let ends = [at(f64::from(k)), at(f64::from(k + 1))];
                let [column, row] = boundary.cell(at(f64::from(k) + 0.5), 0.0);
                boundary.cells[row * columns + column].push(ends);
            }
        }
        boundary.fill();
        boundary
    }

    /// The cell of a place moved along both axes.
    fn cell(&self, at: Spot, by: f64) -> [usize; 2] {
        let cell = |axis: usize, count: usize| {
            let number = (at[axis] + by - self.low[axis]) / CELL;
            (number.max(0.0) as usize).min(count - 1)
        };
        [cell(0, self.columns), cell(1, self.rows)]
    }

    /// How far a place is from the nearest wall, if that is less than `most`, else no less than that.
    pub(crate) fn to_wall(&self, at: Spot, most: f64) -> f64 {
        let ([left, under], [right, over]) = (self.cell(at, -most - CELL), self.cell(at, most + CELL));
        let mut nearest = f64::INFINITY;
        for row in under..=over {
            let cells = &self.cells[row * self.columns + left..=row * self.columns + right];
            for side in cells.iter().flatten() {
                nearest = nearest.min(to_segment(at, *side));
            }
        }
        nearest
    }

    /// Marks all squares whose middles lie in the region, by even-odd.
    fn fill(&mut self) {
        let inside = &mut self.inside;
        for row in 0..inside.rows {
            let y = inside.middle(0, row)[1];
            let sides = self.walls.iter().chain(&self.open);
            let crossed = sides.filter(|[a, b]| (a[1] > y) != (b[1] > y));
            let crossing = |[a, b]: &[Spot; 2]| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            let mut crossings: Vec<f64> = crossed.map(crossing).collect();
            crossings.sort_by(f64::total_cmp);
            for column in 0..inside.columns {
                let x = inside.middle(column, row)[0];
                let before = crossings.partition_point(|crossing| *crossing < x);
                inside.marks[row * inside.columns + column] = before % 2 == 1;
            }
        }
    }

    /// Whether the square of a place lies in the region.
    pub(crate) fn contains(&self, at: Spot) -> bool {
        let [column, row] = [0, 1].map(|axis| ((at[axis] - self.low[axis]) / SQUARE) as usize);
        self.inside.marks[row * self.inside.columns + column]
    }

    /// The area of the region, by squares.
    pub(crate) fn area(&self) -> f64 {
        self.inside.area()
    }

    /// The area, by squares, of what a tool reaches whose centre keeps a distance from walls, and does not sweep at some places.
    pub(crate) fn uncut(&self, radius: f64, keep: f64, places: impl Iterator<Item = Spot>) -> f64 {
        let inside = &self.inside;
        let mut reached = Raster::empty(self.low, inside.columns, inside.rows);
        for at in inside.marked() {
            if self.to_wall(at, keep + 0.1) >= keep + 0.02 {
                reached.stamp(at, radius - SQUARE);
            }
        }
        let mut swept = Raster::empty(self.low, inside.columns, inside.rows);
        let mut last = [f64::INFINITY; 2];
        for at in places {
            if at != last {
                swept.stamp(at, radius + 0.01);
            }
            last = at;
        }
        let of = |number: usize| inside.marks[number] && reached.marks[number] && !swept.marks[number];
        let count = (0..inside.marks.len()).filter(|number| of(*number)).count();
        count as f64 * SQUARE * SQUARE
    }
}

/// Squares of the plan.
#[derive(Clone, Debug)]
struct Raster {
    low: Spot,
    columns: usize,
    rows: usize,
    marks: Vec<bool>,
}

impl Raster {
    fn empty(low: Spot, columns: usize, rows: usize) -> Self {
        Self {
            low,
            columns,
            rows,
            marks: vec![false; columns * rows],
        }
    }

    fn middle(&self, column: usize, row: usize) -> Spot {
        let at = |low: f64, number: usize| low + (number as f64 + 0.5) * SQUARE;
        [at(self.low[0], column), at(self.low[1], row)]
    }

    fn marked(&self) -> impl Iterator<Item = Spot> {
        let numbers = (0..self.marks.len()).filter(|number| self.marks[*number]);
        numbers.map(|number| self.middle(number % self.columns, number / self.columns))
    }

    fn area(&self) -> f64 {
        self.marked().count() as f64 * SQUARE * SQUARE
    }

    /// Marks all squares whose middles are within a reach of a place.
    fn stamp(&mut self, at: Spot, reach: f64) {
        let number = |axis: usize, by: f64| ((at[axis] + by - self.low[axis]) / SQUARE).max(0.0) as usize;
        let top = number(1, reach).min(self.rows - 1);
        for row in number(1, -reach)..=top {
            let aside = (self.middle(0, row)[1] - at[1]).abs();
            if aside > reach {
                continue;
            }
            let half = (reach * reach - aside * aside).sqrt();
            let first = ((at[0] - half - self.low[0]) / SQUARE - 0.5).ceil().max(0.0) as usize;
            let end = ((at[0] + half - self.low[0]) / SQUARE + 0.5).floor().max(0.0) as usize;
            let end = end.min(self.columns);
            if first < end {
                self.marks[row * self.columns + first..row * self.columns + end].fill(true);
            }
        }
    }
}
