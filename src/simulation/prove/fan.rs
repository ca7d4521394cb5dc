//! Cuts along a fan: chains of one straight piece, each at a slope of its own.
//!
//! The line of a tip and the plane of its blade are taken from the program. Such a blade cuts a V at every y; what its way or its
//! posture is off by rounding is allowed for. Chips come out by the rule of [`crate::slab`], at every y at once. The part
//! is entered where the lower side of a V is below its cover at one of both ends ([`vcutc_geometry::fan`]): at a tip that is below
//! the cover raised so that no flank is steeper.
//!
//! What the cuts leave is shown as it is seen from the lower ends of lines, and there by Vs that open less than these do, as the
//! steepest section of each shows it: what is left is nowhere higher.

use super::along::{ChainPiece, OFF, Plane, Strayed, edge_on};
use super::flank::FlankGeometry;
use super::{Cut, Player, VNumber};
use crate::slab::{Columns, Walls};
use crate::surface::{Side, Vee};
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Flank, Joint, OrientationId, Straight};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::units::Length;
use vcutc_geometry::cone::clearance;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::fan::{Fan, Ruling};
use vcutc_geometry::profile::Profile;

/// The fan that the cuts of an operation keep to.
#[derive(Clone, Copy, Debug)]
pub struct FanBound<'p> {
    /// The fan, whose cover is that of the part.
    pub fan: &'p Fan,
    /// What is to stay on the part.
    pub allowance: Length,
}

/// How much the slopes of flanks may differ: rounding of postures.
const ALIKE: f64 = 1e-6;

/// Cuts along a fan.
#[derive(Default)]
pub(super) struct AlongFan {
    /// The Vs that are out.
    columns: Columns,
    /// Flanks of Vs whose other flank is not cut yet.
    half_done: BTreeMap<VNumber, (Cut, Line)>,
    /// Vs of which a flank left its line.
    strayed: BTreeSet<VNumber>,
    /// Whether a chain goes on.
    is_open: bool,
    /// How far any flank so far may lie above its V.
    above: f64,
    /// The slope of all flanks, and where tips must stay for them, at both ends.
    clear: Option<(f64, [Profile; 2])>,
}

impl AlongFan {
    pub(super) fn into_rulings(self) -> Vec<Ruling> {
        self.columns.into_rulings()
    }
}

/// A flank along a line.
#[derive(Clone, Copy, Debug)]
struct Line {
    ruling: Ruling,
    side: Side,
    geometry: FlankGeometry,
    /// How far it may lie above its V, and below.
    off: f64,
}

impl Player<'_> {
    /// A piece of a chain of an operation whose cuts keep to a fan.
    pub(super) fn follow_line(&mut self, segment: &Segment<'_>, bound: FanBound<'_>, blade: Straight) {
        let Some(ChainPiece {
            operation,
            layer,
            cut,
            joint,
            line,
        }) = ChainPiece::of(segment)
        else {
            return;
        };
        let whole = joint == Joint::Stop && !self.fan.is_open && line.via.is_none();
        self.fan.is_open = joint == Joint::Through;
        let places = [line.from, line.to].map(|pose| (pose.tip, pose.orientation));
        let edge = blade.cutting_length.to_mm();
        let followed = if whole {
            self.line(places, bound.fan, blade)
        } else {
            Err(Strayed {
                y: line.to.tip.y,
                by: edge,
            })
        };
        let tip = line.to.tip;
        let cut = Cut {
            operation,
            layer,
            cut,
            flank: match followed.map(|followed| followed.side) {
                Ok(Side::Left) | Err(_) => Flank::Left,
                Ok(Side::Right) => Flank::Right,
            },
            tip: followed.map_or_else(|_| Point2::new(tip.x, tip.z), |line| lower_end(line.ruling)),
            held: line.to.orientation,
            tool: segment.before.tool,
        };
        match followed {
            Ok(line) => self.flank_on(cut, line, bound),
            Err(strayed) => {
                let place = (cut.layer, cut.cut);
                self.fan.half_done.remove(&place);
                self.fan.strayed.insert(place);
                self.note_strayed(&cut, strayed);
            }
        }
    }

    /// The flank that a blade cuts on its way between two places, if it is one along a straight line over all of the stock.
    fn line(
        &self,
        places: [(Point3, OrientationId); 2],
        fan: &Fan,
        blade: Straight,
    ) -> Result<Line, Strayed> {
        let edge = blade.cutting_length.to_mm();
        let [mut from, mut to] = places;
        if from.0.y > to.0.y {
            (from, to) = (to, from);
        }
        let [front, back] = [from.0, to.0];
        let stray = |by: f64| Strayed { y: front.y, by };
        let short = front.y.max(fan.depth() - back.y);
        if short > 0.0 {
            return Err(stray(short));
        }
        let held = [from.1, to.1].map(|held| self.program.orientation(held));
        let [Some(held), Some(other)] = held else {
            return Err(stray(edge));
        };
        let plane = Plane::of(held);
        if !plane.is_inclined() {
            return Err(stray(edge));
        }
        let slope = (back.z - front.z) / (back.y - front.y);
        let flank = plane.across.abs();
        let known = self.fan.clear.as_ref().map_or(flank, |(known, _)| *known);
        let apart = |one: f64, other: f64| (libm::atan(one) - libm::atan(other)).abs();
        let turned = apart(plane.along, slope) + apart(flank, known) + held.angle_to(other).to_rad();
        let moved = (back.x - front.x).abs().max(edge * turned);
        if moved > OFF || (flank - known).abs() > ALIKE {
            return Err(stray(moved));
        }
        Ok(Line {
            ruling: Ruling {
                x: front.x,
                ends: [0.0, fan.depth()].map(|y| front.z + slope * (y - front.y)),
                flank: known,
            },
            // Looking along y, a plane that rises to the left is that of a left flank.
            side: if plane.across < 0.0 {
                Side::Left
            } else {
                Side::Right
            },
            geometry: FlankGeometry {
                slope: known,
                edge_per_height: edge_on(held, slope, blade, flank),
            },
            off: moved * (1.0 + flank * flank + slope * slope).sqrt(),
        })
    }

    fn flank_on(&mut self, cut: Cut, line: Line, bound: FanBound<'_>) {
        let stock = self.program.stock;
        let stock = Walls {
            width: stock.width.to_mm(),
            height: stock.height.to_mm(),
        };
        self.fan.above = self.fan.above.max(line.off);
        let lower = lowered(line.ruling, line.off + self.fan.above);
        let reach = self.fan.columns.reach(lower, line.side, stock);
        self.use_edge(reach * line.geometry.edge_per_height, &cut);
        self.note_below_cover(&cut, line, bound);
        let place = (cut.layer, cut.cut);
        if self.fan.strayed.contains(&place) {
            return;
        }
        match self.fan.half_done.remove(&place) {
            Some((_, other)) if other.side != line.side && other.ruling == line.ruling => {
                self.release_line(line.ruling, bound.fan);
            }
            Some((before, _)) => {
                self.note_unfreed(&before);
                self.fan.half_done.insert(place, (cut, line));
            }
            None => {
                self.fan.half_done.insert(place, (cut, line));
            }
        }
    }

    /// Notes where the lower side of a V is below the cover of the part at one of both ends.
    fn note_below_cover(&mut self, cut: &Cut, line: Line, bound: FanBound<'_>) {
        let drop = self.bounds.get(usize::from(cut.operation.0));
        let drop = drop.map_or(0.0, |bound| bound.drop.to_mm()) + line.off;
        let flank = line.ruling.flank;
        let clear = self.fan.clear.get_or_insert_with(|| {
            let ends = bound.fan.ends_with(bound.allowance);
            (flank, ends.map(|end| clearance(&end, flank)))
        });
        let entries = clear.1.iter().zip(line.ruling.ends);
        let depth = entries.map(|(clear, tip)| clear.height(line.ruling.x) - (tip - drop));
        let depth = depth.fold(f64::NEG_INFINITY, f64::max);
        let program = self.program;
        self.note_entry(lower_end(line.ruling), depth, |fault| cut.finding(program, fault));
    }

    /// Takes the chip of a V out both flanks of which are cut.
    fn release_line(&mut self, ruling: Ruling, fan: &Fan) {
        self.fan.columns.release(ruling);
        let seen = ruling.ends.iter().zip([0.0, fan.depth()]);
        let tip = Point2 {
            x: ruling.x,
            z: seen
                .map(|(z, y)| z - fan.rise(ruling.x, y))
                .fold(f64::NEG_INFINITY, f64::max),
        };
        let [left, right] = fan.opening(ruling.x).map(|more| ruling.flank + more);
        self.section
            .release(Vee::one(tip, Side::Left, left).with(Side::Right, right));
    }

    /// Notes a level cut of an operation whose cuts keep to a fan.
    pub(super) fn note_off_fan(&mut self, cut: &Cut, bound: FanBound<'_>) {
        let by = bound.fan.steepest() * bound.fan.depth();
        self.note_strayed(cut, Strayed { y: 0.0, by });
    }

    /// Notes Vs along a fan of which only one flank was cut.
    pub(super) fn note_half_done_of_fan(&mut self) {
        for (cut, _) in core::mem::take(&mut self.fan.half_done).into_values() {
            self.note_unfreed(&cut);
        }
        self.fan.strayed.clear();
    }
}

/// Where the lower end of a line runs.
fn lower_end(ruling: Ruling) -> Point2 {
    let [front, back] = ruling.ends;
    Point2::new(ruling.x, front.min(back))
}

fn lowered(ruling: Ruling, by: f64) -> Ruling {
    Ruling {
        ends: ruling.ends.map(|z| z - by),
        ..ruling
    }
}
