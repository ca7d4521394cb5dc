//! Regions for tests: the five test pockets, and random ones (feature `testkit`).

#![allow(clippy::unwrap_used, reason = "the regions of tests are sound")]

use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Edge, Inside, Loop, Region, Side};
use proptest::prelude::*;

pub mod passes;

/// A loop from corners and bulges: the tangent of a quarter of the angle of the arc to the next corner, positive to the left.
pub fn bulged(corners: &[(f64, f64, f64)]) -> Loop {
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .map(|(from, to)| Edge {
            piece: Piece::arc(
                Place::new(from.0, from.1),
                Place::new(to.0, to.1),
                4.0 * libm::atan(from.2),
            ),
            side: Side::Wall,
        })
        .collect()
}

pub fn polygon(corners: &[(f64, f64)]) -> Loop {
    let corners: Vec<_> = corners.iter().map(|&(x, y)| (x, y, 0.0)).collect();
    bulged(&corners)
}

pub fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Loop {
    polygon(&[(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
}

pub fn circle(x: f64, y: f64, radius: f64) -> Loop {
    bulged(&[(x + radius, y, 1.0), (x - radius, y, 1.0)])
}

pub fn region(loops: &[Loop]) -> Region {
    Region::new(loops.to_vec()).unwrap()
}

/// A quarter turn.
const QUARTER: f64 = 0.414_213_562_373_095_03;

/// One of five test pockets, counted from 1: open and chamfered, an L, with a convex and a concave arc, rounded with an island.
pub fn pocket(number: usize) -> Region {
    match number {
        1 => {
            let corners = [
                (20.0, 0.0),
                (120.0, 0.0),
                (120.0, 80.0),
                (20.0, 80.0),
                (0.0, 60.0),
                (0.0, 25.0),
            ];
            let mut edges = polygon(&corners);
            edges[1].side = Side::Open;
            region(&[edges])
        }
        2 => {
            let corners = [
                (0.0, 0.0),
                (120.0, 0.0),
                (120.0, 50.0),
                (60.0, 50.0),
                (60.0, 90.0),
                (0.0, 90.0),
            ];
            region(&[polygon(&corners)])
        }
        3 => region(&[bulged(&[
            (0.0, 0.0, 0.0),
            (120.0, 0.0, 0.0),
            (120.0, 45.0, 0.5),
            (0.0, 45.0, 0.0),
        ])]),
        4 => region(&[bulged(&[
            (0.0, 0.0, 0.0),
            (120.0, 0.0, 0.0),
            (120.0, 80.0, -0.4),
            (0.0, 80.0, 0.0),
        ])]),
        _ => {
            let outline = [
                (15.0, 0.0, 0.0),
                (105.0, 0.0, QUARTER),
                (120.0, 15.0, 0.0),
                (120.0, 75.0, QUARTER),
                (105.0, 90.0, 0.0),
                (15.0, 90.0, QUARTER),
                (0.0, 75.0, 0.0),
                (0.0, 15.0, QUARTER),
            ];
            let island = [
                (45.0, 40.0, 0.0),
                (45.0, 50.0, -QUARTER),
                (50.0, 55.0, 0.0),
                (70.0, 55.0, -QUARTER),
                (75.0, 50.0, 0.0),
                (75.0, 40.0, -QUARTER),
                (70.0, 35.0, 0.0),
                (50.0, 35.0, -QUARTER),
            ];
            region(&[bulged(&outline), bulged(&island)])
        }
    }
}

/// What a random region is made of: an outline round the origin and islands round other places, each as radii and bulges.
#[derive(Clone, Debug)]
pub struct Blob {
    pub centre: (f64, f64),
    pub corners: Vec<(f64, f64)>,
}

impl Blob {
    fn edges(&self) -> Loop {
        let count = self.corners.len() as f64;
        let corner = |(number, &(radius, bulge)): (usize, &(f64, f64))| {
            let (sin, cos) = libm::sincos(number as f64 / count * core::f64::consts::TAU);
            (self.centre.0 + radius * cos, self.centre.1 + radius * sin, bulge)
        };
        let corners: Vec<_> = self.corners.iter().enumerate().map(corner).collect();
        bulged(&corners)
    }
}

fn blob(radii: core::ops::Range<f64>, centre: f64) -> impl Strategy<Value = Blob> {
    // Radii on a coarse grid half of the time, so that walls are parallel and corners in line.
    let low = radii.start;
    let grid = (radii.end - low) / 4.0;
    let radius = prop_oneof![
        radii.clone(),
        (0..4i32).prop_map(move |i| low + f64::from(i) * grid)
    ];
    let bulge = prop_oneof![Just(0.0), Just(0.0), -0.6..0.6f64, Just(1e-5), Just(0.2)];
    let corners = prop::collection::vec((radius, bulge), 3..10);
    ((-centre..=centre, -centre..=centre), corners).prop_map(|(centre, corners)| Blob { centre, corners })
}

/// Random regions with up to three islands.
pub fn any_region() -> impl Strategy<Value = Region> {
    let islands = prop::collection::vec(blob(2.0..12.0, 25.0), 0..4);
    (blob(20.0..60.0, 0.0), islands).prop_filter_map("loops that cross", |(outline, islands)| {
        let mut loops = vec![outline.edges()];
        let mut region = Region::new(loops.clone()).ok()?;
        // Islands that cross something are left out.
        for island in &islands {
            loops.push(island.edges());
            match Region::new(loops.clone()) {
                Ok(more) => region = more,
                Err(_) => {
                    loops.pop();
                }
            }
        }
        Some(region)
    })
}

/// Pieces as places no farther apart than a tolerance lets chords leave their arcs, the last place left out.
pub fn flat(pieces: impl IntoIterator<Item = Piece>, tolerance: f64) -> Vec<Place> {
    let mut places = Vec::new();
    for piece in pieces {
        let count = piece.radius().map_or(1.0, |radius| {
            let widest = 2.0 * libm::acos((1.0 - tolerance / radius).max(0.0));
            libm::ceil(piece.sweep.abs() / widest).max(1.0)
        });
        let steps = (0..count as u32).map(f64::from);
        places.extend(steps.map(|step| piece.at(step / count)));
    }
    places
}

/// Whether a place lies within polygons, by even-odd.
pub fn is_within(polygons: &[Vec<Place>], place: Place) -> bool {
    let sides = polygons
        .iter()
        .flat_map(|polygon| polygon.iter().zip(polygon.iter().cycle().skip(1)));
    let crossed = sides.filter(|(a, b)| {
        (a.y > place.y) != (b.y > place.y) && place.x < (b.x - a.x) * (place.y - a.y) / (b.y - a.y) + a.x
    });
    crossed.count() % 2 == 1
}

/// The area of what lies in a region, at least `inside` from its walls, and farther than `reach` from all of some pieces, in mm2, and
/// the largest distance of such a place, by a quadtree: distances change no faster than places.
pub fn uncut(region: &Region, inside: f64, pieces: &[Piece], reach: f64, finest: f64) -> (f64, f64) {
    let walls = Walls::of(region);
    let ways = Walls::of_pieces(pieces.iter().copied().enumerate());
    let within = Inside::of(region);
    let bounds = region.bounds();
    let size = (bounds.high.x - bounds.low.x).max(bounds.high.y - bounds.low.y);
    let is_closed = region.edges().all(|edge| edge.side == Side::Wall);
    let edges = Walls::of_pieces(region.edges().map(|edge| edge.piece).enumerate());
    let mut open = vec![(bounds.middle(), size / 2.0)];
    let (mut area, mut farthest) = (0.0, 0.0);
    while let Some((middle, half)) = open.pop() {
        let diagonal = half * 1.415;
        let to_way = ways.distance(middle);
        if to_way + diagonal <= reach {
            continue;
        }
        let to_wall = walls.distance(middle);
        let is_inside = within.contains(middle);
        // A place of the region is no farther from the walls than the way there from within, or through a wall from outside.
        let is_shallow = is_inside && to_wall + diagonal < inside;
        let is_beyond = !is_inside && is_closed && 2.0 * diagonal < inside;
        if is_shallow || is_beyond || !is_inside && edges.distance(middle) > diagonal {
            continue;
        }
        if half <= finest {
            if to_way > reach && is_inside && to_wall >= inside {
                area += 4.0 * half * half;
                farthest = f64::max(farthest, to_way);
            }
            continue;
        }
        let quarter = half / 2.0;
        for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            open.push((middle.plus(Place::new(x, y).times(quarter)), quarter));
        }
    }
    (area, farthest)
}

/// Regions of square cells: walls in line, corridors of equal width, and corners that touch.
pub fn any_cells(size: f64) -> impl Strategy<Value = Region> {
    prop::collection::vec(prop::collection::vec(prop::bool::weighted(0.7), 6), 6)
        .prop_filter_map("no cells", move |cells| {
            Region::new(around_cells(&cells, size)).ok()
        })
}

/// The boundary of cells, with the cells to its left; where two cells touch in a corner it turns to the left.
fn around_cells(cells: &[Vec<bool>], size: f64) -> Vec<Loop> {
    let is_full = |x: i32, y: i32| {
        let row = usize::try_from(y).ok().and_then(|y| cells.get(y));
        row.zip(usize::try_from(x).ok()).and_then(|(row, x)| row.get(x)) == Some(&true)
    };
    let mut sides: Vec<((i32, i32), (i32, i32))> = Vec::new();
    for y in 0..6 {
        for x in (0..6).filter(|&x| is_full(x, y)) {
            let corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
            let beyond = [(x, y - 1), (x + 1, y), (x, y + 1), (x - 1, y)];
            let open = (0..4).filter(|&i| !is_full(beyond[i].0, beyond[i].1));
            sides.extend(open.map(|i| (corners[i], corners[(i + 1) % 4])));
        }
    }
    let mut loops = Vec::new();
    while let Some(first) = sides.pop() {
        let mut corners = vec![first.0];
        let mut last = first;
        while last.1 != first.0 {
            let turn = |next: &((i32, i32), (i32, i32))| {
                let (a, b) = (
                    (last.1.0 - last.0.0, last.1.1 - last.0.1),
                    (next.1.0 - next.0.0, next.1.1 - next.0.1),
                );
                a.0 * b.1 - a.1 * b.0
            };
            let next = (0..sides.len())
                .filter(|&i| sides[i].0 == last.1)
                .max_by_key(|&i| turn(&sides[i]));
            last = sides.remove(next.unwrap());
            corners.push(last.0);
        }
        let corners: Vec<_> = corners
            .iter()
            .map(|&(x, y)| (f64::from(x) * size, f64::from(y) * size))
            .collect();
        loops.push(polygon(&corners));
    }
    loops
}
