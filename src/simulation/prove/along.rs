//! Cuts along a spine: chains of which each is one flank of a V, the same in all sections with the spine taken off.
//!
//! A chain is compared with the spine place by place: its tip runs at one x and at one height above the spine, and at each of the
//! spine's stations the blade's plane has the slope of the station along the work and one and the same slope across it. Then
//! the flank is that of a V, but for [`Spine::deviation`], for what rounding and blending move the edge by, and for the turn from station
//! to station: on its way, each point of the blade leaves its chord by an eighth of its distance times the turn squared.
//!
//! A flank may lie lower by all of that, and what others have left higher by all of theirs: so a flank comes out where one comes
//! out that lies lower by both.

use super::flank::FlankGeometry;
use super::{Cut, CutFault, Player, VNumber, note};
use crate::surface::{Side, Vee};
use core::num::NonZeroU32;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Action, Flank, Joint, OperationId, OrientationId, Site, Straight};
use vcutc_backend_api::segments::{LinearSegment, Segment};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::spine::{Deviation, Spine, Station};

/// How far a tip, or by its turn the end of the edge, may be off its spine, in mm: rounding of what programs print.
pub(super) const OFF: f64 = 0.002;

/// Chains along spines.
#[derive(Default)]
pub(super) struct AlongSpine {
    /// The chain that is not at its end.
    open: OpenChain,
    /// Flanks of Vs whose other flank is not cut yet.
    half_done: BTreeMap<VNumber, (Cut, Followed)>,
    /// All flanks, with their slopes.
    cut: Vec<(Cut, f64)>,
    /// Vs of which a flank left the spine.
    strayed: BTreeSet<VNumber>,
    /// How far any flank so far may lie above its V.
    above: f64,
    /// How far an arc of the open chain leaves the spine, if it has one.
    bow: Option<Strayed>,
    /// How far flanks lie off their Vs, by the bits of how far the blade reaches: there are few postures.
    deviations: BTreeMap<u64, Deviation>,
}

impl AlongSpine {
    /// The cut of an operation whose flank passes lowest through an x, and how high.
    pub(super) fn lowest_through(&self, operation: OperationId, x: f64) -> Option<(f64, &Cut)> {
        let of_operation = self.cut.iter().filter(|(cut, _)| cut.operation == operation);
        let heights = of_operation.map(|(cut, slope)| (Vee::one(cut.tip, cut.side(), *slope).height(x), cut));
        heights.min_by(|(one, _), (other, _)| one.total_cmp(other))
    }
}

/// A flank along a spine, as it is seen with the spine taken off.
#[derive(Clone, Copy, Debug)]
struct Followed {
    tip: Point2,
    side: Side,
    geometry: FlankGeometry,
    deviation: Deviation,
}

impl Followed {
    fn off_by(self, Deviation { above, below }: Deviation) -> Self {
        Self {
            deviation: Deviation {
                above: self.deviation.above + above,
                below: self.deviation.below + below,
            },
            ..self
        }
    }
}

/// Where a chain is not where its spine is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strayed {
    pub(super) y: f64,
    pub(super) by: f64,
}

/// A chain that is not at its end.
#[derive(Default)]
pub(super) struct OpenChain {
    places: Vec<(Point3, OrientationId)>,
    has_arc: bool,
}

impl OpenChain {
    /// Adds a piece. Where that ends the chain, its places, and whether a piece of it is an arc.
    pub(super) fn add(&mut self, piece: &ChainPiece) -> Option<(Vec<(Point3, OrientationId)>, bool)> {
        let [from, to] = [piece.line.from, piece.line.to].map(|pose| (pose.tip, pose.orientation));
        if self.places.last() != Some(&from) {
            self.places = vec![from];
            self.has_arc = false;
        }
        self.places.push(to);
        self.has_arc |= piece.line.via.is_some();
        match piece.joint {
            Joint::Through => None,
            Joint::Stop => {
                let Self { places, has_arc } = core::mem::take(self);
                Some((places, has_arc))
            }
        }
    }
}

/// A piece of a chain through the work.
pub(super) struct ChainPiece {
    pub(super) operation: OperationId,
    pub(super) layer: NonZeroU32,
    pub(super) cut: NonZeroU32,
    pub(super) joint: Joint,
    pub(super) line: LinearSegment,
}

impl ChainPiece {
    pub(super) fn of(segment: &Segment<'_>) -> Option<Self> {
        match (segment.op.site, segment.op.action) {
            (
                Site::Cut {
                    operation,
                    layer,
                    cut,
                },
                Action::Follow { joint, .. },
            ) => Some(Self {
                operation,
                layer,
                cut,
                joint,
                line: segment.line()?,
            }),
            _ => None,
        }
    }
}

impl Player<'_> {
    /// A piece of a chain along a spine.
    pub(super) fn follow(&mut self, segment: &Segment<'_>, spine: &Spine, blade: Straight) {
        let Some(piece) = ChainPiece::of(segment) else {
            return;
        };
        let line = piece.line;
        let [from, to] = [line.from, line.to].map(|pose| (pose.tip, pose.orientation));
        if let Some(via) = line.via {
            let off = via.z - from.0.z - (spine.rise(via.y) - spine.rise(from.0.y));
            let by = off.abs().max((via.x - from.0.x).abs()).max(OFF);
            self.along.bow = Some(Strayed { y: via.y, by });
        }
        let Some((places, has_arc)) = self.along.open.add(&piece) else {
            return;
        };
        let held: Option<Vec<(Point3, Orientation)>> = places
            .iter()
            .map(|&(tip, held)| Some((tip, self.program.orientation(held)?)))
            .collect();
        let Some(held) = held else { return };
        let overhang = overhang(&held, blade);
        let known = &mut self.along.deviations;
        let deviation = *known
            .entry(overhang.to_bits())
            .or_insert_with(|| spine.deviation(overhang));
        let followed = match self.along.bow.take().filter(|_| has_arc) {
            Some(strayed) => Err(strayed),
            None => followed(&held, spine, blade, self.program.blend).map(|exact| exact.off_by(deviation)),
        };
        let cut = Cut {
            operation: piece.operation,
            layer: piece.layer,
            cut: piece.cut,
            flank: match followed.map(|followed| followed.side) {
                Ok(Side::Left) | Err(_) => Flank::Left,
                Ok(Side::Right) => Flank::Right,
            },
            tip: followed.map_or_else(|_| Point2::new(to.0.x, to.0.z), |followed| followed.tip),
            held: to.1,
            tool: segment.before.tool,
        };
        match followed {
            Ok(followed) => self.flank_along(cut, followed),
            Err(strayed) => {
                let place = (cut.layer, cut.cut);
                self.along.half_done.remove(&place);
                self.along.strayed.insert(place);
                self.note_strayed(&cut, strayed);
            }
        }
    }

    fn flank_along(&mut self, cut: Cut, followed: Followed) {
        let Followed {
            tip,
            side,
            geometry,
            deviation,
        } = followed;
        let slope = geometry.slope;
        self.along.above = self.along.above.max(deviation.above);
        let lower = deviation.below + self.along.above;
        self.come_out(&cut, side, geometry, (lower, 0.0));
        self.along.cut.push((cut.clone(), slope));
        let place = (cut.layer, cut.cut);
        if self.along.strayed.contains(&place) {
            return;
        }
        match self.along.half_done.remove(&place) {
            Some((_, other)) if other.side != side && other.tip == tip => {
                let vee = Vee::one(tip, side, slope).with(side.opposite(), other.geometry.slope);
                let below = deviation.below.max(other.deviation.below);
                self.release(&cut, vee, Length::mm(below));
            }
            Some((before, _)) => {
                self.note_unfreed(&before);
                self.along.half_done.insert(place, (cut, followed));
            }
            None => {
                self.along.half_done.insert(place, (cut, followed));
            }
        }
    }

    /// Notes a level cut of an operation whose cuts follow a spine.
    pub(super) fn note_level(&mut self, cut: &Cut, spine: &Spine) {
        let by = spine.highest(0.0, spine.depth());
        self.note_strayed(cut, Strayed { y: 0.0, by });
    }

    pub(super) fn note_strayed(&mut self, cut: &Cut, Strayed { y, by }: Strayed) {
        let [y, by] = [y, by].map(Length::mm);
        let finding = cut.finding(self.program, CutFault::Strays { y, by });
        note(&mut self.findings.strays, finding, |a, b| {
            off(a.fault) > off(b.fault)
        });
    }

    /// Notes Vs along a spine of which only one flank was cut.
    pub(super) fn note_half_done(&mut self) {
        for (cut, _) in core::mem::take(&mut self.along.half_done).into_values() {
            self.note_unfreed(&cut);
        }
        self.along.strayed.clear();
    }

    pub(super) fn note_unfreed(&mut self, cut: &Cut) {
        let program = self.program;
        self.note_edge(f64::INFINITY, |fault| cut.finding(program, fault));
    }
}

/// How far a finding says that a cut is off.
const fn off(fault: CutFault) -> f64 {
    match fault {
        CutFault::Strays { by, .. } => by.to_mm(),
        _ => 0.0,
    }
}

/// The flank that a chain through these places cuts, seen with the spine taken off, but for what its blade lies off a bending spine.
fn followed(
    places: &[(Point3, Orientation)],
    spine: &Spine,
    blade: Straight,
    blend: Length,
) -> Result<Followed, Strayed> {
    let edge = blade.cutting_length.to_mm();
    let mut places = places.to_vec();
    if places.first().map(|place| place.0.y) > places.last().map(|place| place.0.y) {
        places.reverse();
    }
    let stations = spine.stations(0.0);
    let x = places.first().map_or(0.0, |(tip, _)| tip.x);
    // Most places are right, so the height in the middle of all is that of the tip.
    let mut heights: Vec<f64> = places.iter().map(|(tip, _)| tip.z - spine.rise(tip.y)).collect();
    heights.sort_by(f64::total_cmp);
    let middle = heights.get(heights.len() / 2).copied().unwrap_or_default();
    let tip = Point2::new(x, grid::nearest(middle));
    if places.len() != stations.len() {
        // A chain that has other places than its spine turns its blade otherwise.
        let y = places.last().map_or(0.0, |(tip, _)| tip.y);
        return Err(Strayed { y, by: edge });
    }
    let planes: Vec<Plane> = places.iter().map(|(_, held)| Plane::of(*held)).collect();
    let across = planes.first().map_or(0.0, |plane| plane.across);
    let mut moved = 0.0_f64;
    for (number, (((place, _), station), plane)) in places.iter().zip(&stations).zip(&planes).enumerate() {
        let is_end = number == 0 || number + 1 == stations.len();
        let aside = if is_end {
            place.y.clamp(0.0, spine.depth()) - station.y
        } else {
            place.y - station.y
        };
        let by_place = [place.x - x, aside, place.z - spine.rise(place.y) - tip.z];
        let by_place = by_place.into_iter().map(f64::abs).fold(0.0, f64::max);
        let turned = if plane.is_inclined() {
            plane.turned_from(station, across)
        } else {
            core::f64::consts::FRAC_PI_2
        };
        let by = by_place.max(edge * turned);
        if by > OFF {
            return Err(Strayed { y: place.y, by });
        }
        moved = moved.max(by);
    }
    let turns = places
        .windows(2)
        .map(|pair| pair[0].1.angle_to(pair[1].1).to_rad());
    let turn = turns.fold(0.0, f64::max);
    let off = moved + blend.to_mm() + edge * turn * turn / 8.0;
    let slope = across.abs();
    let off = off * (1.0 + slope * slope + spine.steepest() * spine.steepest()).sqrt();
    Ok(Followed {
        tip,
        // Looking along y, a plane that rises to the left is that of a left flank.
        side: if across < 0.0 { Side::Left } else { Side::Right },
        geometry: FlankGeometry {
            slope,
            edge_per_height: edge_per_height(&places, &stations, blade, slope),
        },
        deviation: Deviation {
            above: off,
            below: off,
        },
    })
}

/// The plane of a blade by its slopes: rise over x, and rise over y.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) across: f64,
    pub(super) along: f64,
}

impl Plane {
    pub(super) fn of(held: Orientation) -> Self {
        let m = held.matrix();
        let [x, y, z] = [m[0][1], m[1][1], m[2][1]];
        Self {
            across: -x / z,
            along: -y / z,
        }
    }

    /// Whether it leans, so that it rises across the cuts by a slope that flanks along spines may have.
    pub(super) const fn is_inclined(self) -> bool {
        self.along.is_finite() && self.across != 0.0 && self.across.abs() <= Spine::STEEPEST_FLANK
    }

    /// How far it is turned from that at a station, in rad.
    pub(super) fn turned_from(self, station: &Station, across: f64) -> f64 {
        let apart = |one: f64, other: f64| (libm::atan(one) - libm::atan(other)).abs();
        apart(self.along, station.slope).max(apart(self.across, across))
    }
}

/// How far the edges reach along y from their tip at most.
pub(super) fn overhang(places: &[(Point3, Orientation)], blade: Straight) -> f64 {
    let reaches = places.iter().flat_map(|(_, held)| {
        let m = held.matrix();
        let along_y = move |end: [f64; 3]| m[1].iter().zip(end).map(|(part, end)| part * end).sum::<f64>();
        blade.edge_ends().into_iter().map(along_y)
    });
    reaches.map(f64::abs).fold(0.0, f64::max)
}

/// Edge length for each millimetre of height of a flank, at most. At an angle `theta` of shank and way, an edge of length `L` shows
/// itself across a level way as `L sin(theta - beta)`, and across one that rises as no less.
fn edge_per_height(
    places: &[(Point3, Orientation)],
    stations: &[Station],
    blade: Straight,
    slope: f64,
) -> f64 {
    let most = places
        .iter()
        .zip(stations)
        .map(|((_, held), station)| edge_on(*held, station.slope, blade, slope));
    most.fold(0.0, f64::max)
}

/// Edge length for each millimetre of height of a flank of that slope whose tip runs along a way that rises so, at most.
pub(super) fn edge_on(held: Orientation, way: f64, blade: Straight, flank: f64) -> f64 {
    let m = held.matrix();
    let cos_swing = flank / libm::hypot(1.0, flank);
    let along = (m[1][2] + m[2][2] * way) / libm::hypot(1.0, way);
    let rake = Angle::rad(libm::acos(along.abs().min(1.0)));
    1.0 / (cos_swing * (rake - blade.half_apex).sin())
}
