//! Slits of a straight blade as motions: down, along each with the blade in the plane of its way, and up.

use super::turns::Yaw;
use crate::beside::{Entrance, Paces, Step, Writer};
use crate::pen::{Pace, Path, Pen};
use crate::posture::{Feed, Holder};
use core::f64::consts::FRAC_PI_2;
use core::num::NonZeroU32;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Edges, OperationId, Site};
use vcutc_backend_api::units::Angle;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::slits::{Begin, Slit};

/// Arcs are cut in parts that turn by no more, so that no turn of the blade could go either way.
const LARGEST_TURN: f64 = FRAC_PI_2;

/// Lines on which the blade turns in its plane are cut in parts on which it turns by no more, in rad: rotary axes of a gantry that go from
/// end to end at constant rates leave that plane in between, by the square of the turn.
const LARGEST_LEAN: f64 = 1.5 * core::f64::consts::PI / 180.0;

/// Heights, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heights {
    /// Where the blade begins to cut.
    pub top: f64,
    /// Of the ground of the slits.
    pub floor: f64,
    /// From which on all is air.
    pub air: f64,
}

/// Slits of one depth, in the order of cutting.
#[derive(Clone, Copy, Debug)]
pub struct Series<'s> {
    pub slits: &'s [Slit],
    pub heights: Heights,
    pub edges: Edges,
    pub operation: OperationId,
    pub layer: NonZeroU32,
}

impl Series<'_> {
    /// Writes them; leaves the blade above the stock, turned as operations find it.
    pub fn write(&self, mut writer: Writer<'_>, paces: Paces) {
        let mut yaw = Yaw::default();
        let mut number = NonZeroU32::MIN;
        for slit in self.slits {
            let drawn = Drawn::of(slit, self.heights);
            let turned = yaw.along(&drawn.headings);
            let held = |at: usize| {
                let rake = drawn.rakes.get(at).copied().unwrap_or(FRAC_PI_2);
                let yaw = turned.yaws.get(at).copied().unwrap_or(0.0);
                self.posture(rake, yaw, turned.feed)
            };
            let stretches = drawn.path.stretches.iter().enumerate();
            let steps: Vec<Step> = stretches
                .map(|(at, stretch)| paces.step(stretch, held(at + 1)))
                .collect();
            let by_way_of: Vec<Orientation> = turned.before.iter().map(|&yaw| self.upright(yaw)).collect();
            let site = Site::Cut {
                operation: self.operation,
                layer: self.layer,
                cut: number,
            };
            let entrance = Entrance {
                tip: drawn.path.from,
                held: held(0),
                by_way_of: &by_way_of,
            };
            writer.path(site, entrance, &steps);
            number = number.saturating_add(1);
        }
        let back: Vec<Orientation> = yaw.back().into_iter().map(|yaw| self.upright(yaw)).collect();
        writer.leave_turned(&back);
    }

    /// The blade in the plane of its way, at a rake and a yaw, in rad.
    fn posture(&self, rake: f64, yaw: f64, feed: Feed) -> Orientation {
        let holder = Holder {
            swing: Angle::ZERO,
            rake: Angle::rad(rake),
            edges: self.edges,
        };
        holder.turned(Angle::rad(yaw), feed)
    }

    /// The blade upright at a yaw, in rad: either edge may lead.
    fn upright(&self, yaw: f64) -> Orientation {
        self.posture(FRAC_PI_2, yaw, Feed::Forward)
    }
}

/// A slit as a path in space, with where it heads and how the blade leans at each of its points.
struct Drawn {
    path: Path,
    /// Of the wall that it follows, in rad from the x axis, at its first point and after each stretch.
    headings: Vec<f64>,
    /// In rad, likewise.
    rakes: Vec<f64>,
}

impl Drawn {
    fn of(slit: &Slit, heights: Heights) -> Self {
        let Heights { top, floor, air } = heights;
        let first = slit
            .pieces
            .first()
            .map(|piece| (piece.way.from, heading(piece.way, 0.0), piece.rakes[0]));
        let (begin, heading_there, rake) = first.unwrap_or((Place::new(0.0, 0.0), 0.0, FRAC_PI_2));
        let mut pen = match slit.begins {
            Begin::Beside => Pen::at(begin, floor),
            Begin::Within => {
                let mut pen = Pen::at(begin, air);
                pen.line(begin, top, Pace::Travel);
                pen.line(begin, floor, Pace::Plunge);
                pen.stop();
                pen
            }
        };
        let mut headings = vec![heading_there; pen.count() + 1];
        let mut rakes = vec![rake; pen.count() + 1];
        for piece in &slit.pieces {
            let [begins, ends] = piece.rakes;
            let turns = (piece.way.sweep.abs() / LARGEST_TURN).max((ends - begins).abs() / LARGEST_LEAN);
            // No slit turns by more than a few times around.
            let parts = libm::ceil(turns).max(1.0) as u32;
            for part in 0..parts {
                let share = |part: u32| f64::from(part) / f64::from(parts);
                let way = piece.way.part(share(part), share(part + 1));
                let before = pen.count();
                pen.piece(way, floor, Pace::Cut);
                let drawn = pen.count() - before;
                for stretch in 1..=drawn {
                    let done = stretch as f64 / drawn as f64;
                    headings.push(heading(way, done));
                    let gone = (f64::from(part) + done) / f64::from(parts);
                    rakes.push(begins + (ends - begins) * gone);
                }
            }
        }
        pen.stop();
        let end = slit.pieces.last().map_or(begin, |piece| piece.way.to);
        pen.line(end, air, Pace::Travel);
        // Straight up it is held as at the end of the slit.
        headings.extend(headings.last().copied());
        rakes.extend(rakes.last().copied());
        Self {
            path: pen.finish(),
            headings,
            rakes,
        }
    }
}

/// Where a way heads after a share of it, in rad from the x axis.
fn heading(way: Piece, share: f64) -> f64 {
    let ahead = way.direction(share);
    libm::atan2(ahead.y, ahead.x)
}
