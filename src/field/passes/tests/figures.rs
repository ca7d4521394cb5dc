//! Figures of passes in the order in which they are cut: length, time, corners, engagement.

use crate::wall::angle;
use std::f64::consts::PI;
use vcutc_region::clearance::clearance;
use vcutc_region::coverage::{self, coverage};
use vcutc_region::distance::Walls;
use vcutc_region::engagement::{Stretch, engagement};
use vcutc_region::order::{Links, inside_out};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::region::Region;

/// Feed in mm/s and acceleration in mm/s2, along the way and across.
const FEED: f64 = 100.0;
const ACCELERATION: f64 = 2000.0;

/// Joints that turn further are stops, in rad.
const STOP: f64 = 0.5 * PI / 180.0;

/// Turning by more than this, in rad, over a way in mm is a corner.
const CORNER: f64 = PI / 9.0;
const CORNER_WAY: f64 = 0.5;

/// Engagement above this is much, in rad: 120 deg.
const MUCH: f64 = PI * 2.0 / 3.0;

/// How far apart corners are looked for, in mm.
const LOOK: f64 = 0.05;

/// What is left out of engagement: there the tool cuts its first slot.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Slot {
    /// The first pass of each basin.
    Pass,
    /// The first row.
    Row,
}

/// Figures of the passes of one pocket, or sums over several. Lengths in mm, times in s, areas in mm2, angles in rad.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figures {
    pub(super) length: f64,
    pub(super) time: f64,
    pub(super) corners: usize,
    pub(super) uncut: f64,
    /// The least distance from the walls less the radius.
    pub(super) clear: f64,
    /// Engagement times way beside cleared ground, and that way.
    pub(super) engaged: [f64; 2],
    pub(super) largest: f64,
    /// The way on which it is above [`MUCH`].
    pub(super) much: f64,
}

impl Figures {
    pub(super) fn of(region: &Region, passes: &[Pass], radius: f64, slot: Slot) -> Self {
        let walls = Walls::of(region);
        let links = Links {
            walls: &walls,
            distance: radius,
            longest: 3.0 * radius,
        };
        let steps = inside_out(passes, links).unwrap();
        assert_eq!(steps.len(), passes.len());
        let ways: Vec<Pass> = steps.iter().map(|step| step.way.clone()).collect();
        let rim = engagement(region, &ways, radius).unwrap();
        let (mut engaged, mut largest, mut much, mut basin) = ([0.0; 2], 0.0_f64, 0.0, None);
        for (step, profile) in steps.iter().zip(&rim.profiles) {
            let is_first = basin.replace(step.basin) != Some(step.basin);
            let is_beside = |stretch: &&Stretch| !is_first || slot == Slot::Row && stretch.piece > 0;
            for stretch in profile.iter().filter(is_beside) {
                let [start, middle, end] = stretch.angles;
                let way = stretch.way[1] - stretch.way[0];
                engaged[0] += way * (start + 4.0 * middle + end) / 6.0;
                engaged[1] += way;
                much += if middle > MUCH { way } else { 0.0 };
                largest = largest.max(start).max(middle).max(end);
            }
        }
        let clear = clearance(region, &ways);
        assert_eq!(clear.astray, Vec::<usize>::new());
        Self {
            length: ways.iter().map(Pass::length).sum(),
            time: ways.iter().map(|pass| time(&pass.pieces)).sum(),
            corners: ways.iter().map(corners).sum(),
            uncut: coverage(region, &ways, coverage::Tool::touching(radius))
                .unwrap()
                .uncut,
            clear: clear.least.unwrap().distance - radius,
            engaged,
            largest,
            much,
        }
    }

    pub(super) fn with(self, other: Self) -> Self {
        Self {
            length: self.length + other.length,
            time: self.time + other.time,
            corners: self.corners + other.corners,
            uncut: self.uncut + other.uncut,
            clear: self.clear.min(other.clear),
            engaged: [
                self.engaged[0] + other.engaged[0],
                self.engaged[1] + other.engaged[1],
            ],
            largest: self.largest.max(other.largest),
            much: self.much + other.much,
        }
    }

    pub(super) fn mean(&self) -> f64 {
        self.engaged[0] / self.engaged[1]
    }
}

/// Time of a way from rest to rest: along arcs `v <= sqrt(a rho)`, stops at joints that turn.
fn time(pieces: &[Piece]) -> f64 {
    let limit = |piece: &Piece| {
        piece
            .radius()
            .map_or(FEED, |radius| (ACCELERATION * radius).sqrt().min(FEED))
    };
    // Squares of the speeds at all joints.
    let mut squares = vec![0.0];
    for pair in pieces.windows(2) {
        let turned = angle(pair[0].direction(1.0), pair[1].direction(0.0)).abs();
        let speed = if turned > STOP {
            0.0
        } else {
            limit(&pair[0]).min(limit(&pair[1]))
        };
        squares.push(speed * speed);
    }
    squares.push(0.0);
    for (number, piece) in pieces.iter().enumerate() {
        squares[number + 1] = f64::min(
            squares[number + 1],
            squares[number] + 2.0 * ACCELERATION * piece.length(),
        );
    }
    for (number, piece) in pieces.iter().enumerate().rev() {
        squares[number] = f64::min(
            squares[number],
            squares[number + 1] + 2.0 * ACCELERATION * piece.length(),
        );
    }
    let one = |(number, piece): (usize, &Piece)| {
        let (from, to, length) = (squares[number], squares[number + 1], piece.length());
        let highest = f64::midpoint(from, to) + ACCELERATION * length;
        let top = highest.min(limit(piece) * limit(piece));
        let ramps = (2.0 * top - from - to) / (2.0 * ACCELERATION);
        let top = top.sqrt();
        (2.0 * top - from.sqrt() - to.sqrt()) / ACCELERATION + (length - ramps) / top
    };
    pieces.iter().enumerate().map(one).sum()
}

/// How often a pass turns far in a short way.
fn corners(pass: &Pass) -> usize {
    let length = pass.length();
    // Ways from the beginning and directions there, in rad, unwound; of a closed pass a little over its end.
    let (mut way, mut heading) = (0.0, 0.0);
    let mut turns = vec![(0.0, 0.0)];
    let mut last: Option<&Piece> = None;
    let again = pass.pieces.iter().filter(|_| pass.is_closed());
    for piece in pass.pieces.iter().chain(again) {
        heading += last.map_or(0.0, |last| angle(last.direction(1.0), piece.direction(0.0)));
        turns.push((way, heading));
        way += piece.length();
        heading += piece.sweep;
        turns.push((way, heading));
        last = Some(piece);
        if way > length + CORNER_WAY {
            break;
        }
    }
    let heading_at = |at: f64| {
        let after = turns.partition_point(|turn| turn.0 <= at).min(turns.len() - 1);
        let ((from, low), (to, high)) = (turns[after - 1], turns[after]);
        if to > from {
            low + (high - low) * ((at - from) / (to - from)).min(1.0)
        } else {
            high
        }
    };
    let count = (length / LOOK) as usize;
    let (mut corners, mut was) = (0, false);
    for number in 0..count {
        let at = number as f64 * LOOK;
        let is = (heading_at(at + CORNER_WAY) - heading_at(at)).abs() > CORNER;
        corners += usize::from(is && !was);
        was = is;
    }
    corners
}

#[test]
fn times_of_known_ways() {
    use vcutc_region::place::Place;
    // 2.5 mm to the feed and 2.5 mm to rest again; a way of 1 mm reaches `sqrt(a l)` only.
    let line = |from: f64, to: f64| Piece::line(Place::new(from, 0.0), Place::new(to, 0.0));
    assert!((time(&[line(0.0, 105.0)]) - 1.1).abs() < 1e-12);
    assert!((time(&[line(0.0, 40.0), line(40.0, 105.0)]) - 1.1).abs() < 1e-12);
    assert!((time(&[line(0.0, 1.0)]) - 2.0 * (1.0 / ACCELERATION).sqrt()).abs() < 1e-12);
    // A corner is a stop.
    let up = Piece::line(Place::new(105.0, 0.0), Place::new(105.0, 105.0));
    assert!((time(&[line(0.0, 105.0), up]) - 2.2).abs() < 1e-12);
    // Half a circle of 2 mm is run at `sqrt(a rho)`: to it and from it at the feed.
    let half = Piece::arc(Place::new(105.0, 0.0), Place::new(105.0, 4.0), PI);
    let back = Piece::line(Place::new(105.0, 4.0), Place::new(0.0, 4.0));
    let slow = (ACCELERATION * 2.0_f64).sqrt();
    let braking = (FEED - slow) / ACCELERATION;
    let leg = 0.05 + braking + (105.0 - 2.5 - f64::midpoint(FEED, slow) * braking) / FEED;
    let found = time(&[line(0.0, 105.0), half, back]);
    assert!((found - 2.0 * leg - 2.0 * PI / slow).abs() < 1e-12, "{found}");
    let pass = |pieces: &[Piece]| Pass {
        level: 0,
        pieces: pieces.to_vec(),
    };
    assert_eq!(corners(&pass(&[line(0.0, 105.0), up])), 1);
    // Turning by 14.3 deg over half a millimetre.
    assert_eq!(corners(&pass(&[line(0.0, 105.0), half, back])), 0);
    let small = Piece::arc(Place::new(105.0, 0.0), Place::new(105.0, 2.0), PI);
    assert_eq!(corners(&pass(&[line(0.0, 105.0), small, back])), 1);
}
