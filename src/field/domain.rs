//! A grid over a region, and where on it the lines of a field may run.

use rayon::prelude::*;
use vcutc_region::distance::Walls;
use vcutc_region::place::Place;
use vcutc_region::region::{Inside, Region, Side};

/// Points of a grid at most.
const MOST_POINTS: usize = 4_000_000;

/// Columns and rows of a grid around a region, on every side.
const MARGIN: f64 = 2.0;

/// How far beyond an edge lines are followed before they are cut at it, in pitches: past the diagonal of a cell.
const BEYOND: f64 = 1.5;

/// A grid of squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Its first point.
    pub origin: Place,
    /// Distance of neighbouring points, in mm.
    pub pitch: f64,
    /// Points along x.
    pub columns: usize,
    /// Points along y.
    pub rows: usize,
}

impl Grid {
    /// The point in a column and a row, counted from 0.
    #[must_use]
    pub fn place(&self, column: usize, row: usize) -> Place {
        let way = Place::new(column as f64 * self.pitch, row as f64 * self.pitch);
        self.origin.plus(way)
    }
}

/// What a point of a grid is to the lines of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// Core that stays: outside of the region.
    Outside,
    /// In the region, nearer to a wall than lines are wanted.
    NearWall,
    /// In the region, open to lines.
    Free,
    /// Just beyond an open side, or beyond a wall where lines may come as near as they like.
    Beyond,
}

impl Ground {
    pub(crate) const fn is_open_to_lines(self) -> bool {
        matches!(self, Self::Free | Self::Beyond)
    }
}

/// The region could not be gridded: the pitch is not above 0, or the points are more than this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridError {
    /// The most points.
    pub most: usize,
}

/// A region, ready to be asked about many places.
pub(crate) struct Domain<'a> {
    region: &'a Region,
    inside: Inside,
    walls: Walls,
    open: Walls,
}

impl<'a> Domain<'a> {
    pub(crate) fn new(region: &'a Region) -> Self {
        Self {
            region,
            inside: Inside::of(region),
            walls: Walls::of(region),
            open: open_sides(region),
        }
    }

    /// The grid of a pitch over the region.
    pub(crate) fn grid(&self, pitch: f64) -> Result<Grid, GridError> {
        let bounds = self.region.bounds();
        let size = bounds.high.minus(bounds.low);
        let count = |length: f64| libm::ceil(length / pitch) + 2.0 * MARGIN + 1.0;
        let (columns, rows) = (count(size.x), count(size.y));
        // What is not a number is not within bounds.
        if !(pitch > 0.0 && columns * rows <= MOST_POINTS as f64) {
            return Err(GridError { most: MOST_POINTS });
        }
        Ok(Grid {
            origin: bounds.low.minus(Place::new(MARGIN * pitch, MARGIN * pitch)),
            pitch,
            columns: columns as usize,
            rows: rows as usize,
        })
    }

    /// What the points of a grid are, row by row, for lines no nearer to walls than this, in mm.
    pub(crate) fn grounds(&self, grid: &Grid, nearest: f64) -> Vec<Ground> {
        let beyond = BEYOND * grid.pitch;
        let ground = |place: Place| {
            if self.inside.contains(place) {
                let is_near = nearest > 0.0 && self.walls.nearer_than(place, nearest).is_some();
                return if is_near { Ground::NearWall } else { Ground::Free };
            }
            // Of walls, places beyond are wanted only where no strip along them keeps lines away.
            let is_free = nearest <= 0.0 || self.walls.nearer_than(place, nearest).is_none();
            let is_by_wall = nearest <= 0.0 && self.walls.nearer_than(place, beyond).is_some();
            let is_just_beyond = is_by_wall || self.open.nearer_than(place, beyond).is_some();
            if is_free && is_just_beyond {
                Ground::Beyond
            } else {
                Ground::Outside
            }
        };
        let rows = (0..grid.rows).into_par_iter();
        rows.flat_map_iter(|row| (0..grid.columns).map(move |column| ground(grid.place(column, row))))
            .collect()
    }

    /// Whether a place lies in the region.
    pub(crate) fn contains(&self, place: Place) -> bool {
        self.inside.contains(place)
    }

    /// Distance to the nearest wall; infinite without walls.
    pub(crate) fn distance(&self, place: Place) -> f64 {
        self.walls.distance(place)
    }

    /// Whether an open side is nearer than this.
    pub(crate) fn is_by_open_side(&self, place: Place, limit: f64) -> bool {
        self.open.nearer_than(place, limit).is_some()
    }
}

/// The open sides of a region, ready to be asked how near they are.
pub(crate) fn open_sides(region: &Region) -> Walls {
    let edges = region.edges().enumerate();
    let open = edges.filter(|(_, edge)| edge.side == Side::Open);
    Walls::of_pieces(open.map(|(number, edge)| (number, edge.piece)))
}
