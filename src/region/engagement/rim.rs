//! The rim of a tool, and what of it earlier pieces of its way leave in the material.

use crate::boxes::{Extent, Tree};
use crate::curve::Curve;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Inside, Region, Side};
use crate::rounded::{Few, circle, outline_crossings, part};
use core::f64::consts::FRAC_PI_2;

/// What lies so close to the outline of what is cut, in mm, touches it.
const TOUCHING: f64 = 1e-9;

/// Angles up to this, in rad, count as 0: at the sides of the way, where the rim touches what is cut, its
/// chips are a 200 millionth of the radius thick.
const NOTHING: f64 = 1e-4;

/// How much farther off, in mm, what surely cuts nothing of the rim is: far more than rounding makes of crossings.
const SPARE: f64 = 1e-6;

/// Arcs about centres this close to each other, in mm, turn about one.
const ONE_CENTRE: f64 = 0.01;

/// The sine of the angle below which a line goes along another.
const ALONG: f64 = 0.1;

/// What is cut, and where material is.
pub(super) struct Cleared {
    radius: f64,
    /// All pieces of the way in the order of cutting.
    pieces: Vec<Curve>,
    tree: Tree,
    /// Open sides, and where the region is, if there are any.
    air: Option<(Inside, Vec<Curve>)>,
    /// Numbers of those that are near to the stretch that is looked at, first those that cut something last.
    near: Vec<u32>,
    left: Left,
}

/// The front half of a rim about a place.
#[derive(Clone, Copy)]
struct Rim {
    at: Place,
    ahead: Place,
    radius: f64,
    /// By so much what is cut is grown, in mm, so that its outline counts as cut or not. A tool that leaves the end of an earlier
    /// piece finds all ahead in the material, one that arrives there nothing; in that place its rim lies on the outline both times.
    /// The outline counts as cut over stretches and where pieces end, and not at other places.
    grown: f64,
}

impl Rim {
    fn place(&self, angle: f64) -> Place {
        let (sin, cos) = libm::sincos(angle);
        let out = self.ahead.times(cos).plus(self.ahead.left().times(sin));
        self.at.plus(out.times(self.radius))
    }

    /// The angle between the way ahead and a place on the front half, positive to the left.
    fn angle(&self, place: Place) -> Option<f64> {
        let out = place.minus(self.at);
        let ahead = self.ahead.dot(out);
        (ahead > 0.0).then(|| libm::atan2(self.ahead.cross(out), ahead))
    }

    /// Takes away the parts of the front half that a piece has within a distance, shortened at both ends by an angle.
    fn cut(&self, piece: &Curve, reach: f64, less: f64, left: &mut Left) {
        if reach <= TOUCHING || piece.distance(self.at) >= self.radius + reach {
            return;
        }
        let mut crossings = Few::new();
        outline_crossings(piece, reach, &circle(self.at, self.radius), &mut |place| {
            if let Some(angle) = self.angle(place) {
                crossings.push(angle);
            }
        });
        crossings.push(-FRAC_PI_2);
        crossings.push(FRAC_PI_2);
        for pair in crossings.sorted().windows(2) {
            if let &[from, to] = pair
                && left.meets(from + less, to - less)
                && piece.distance(self.place(f64::midpoint(from, to))) < reach + self.grown
            {
                left.take(self, from + less, to - less);
            }
        }
    }
}

/// What is left of the front half of a rim: parts of it in order.
#[derive(Default)]
struct Left {
    gaps: Vec<Gap>,
    spare: Vec<Gap>,
    /// How often something was taken away.
    cuts: usize,
}

/// A part of a rim.
#[derive(Clone, Copy)]
struct Gap {
    from: f64,
    to: f64,
    /// A circle about it.
    middle: Place,
    size: f64,
}

impl Gap {
    fn of(rim: &Rim, from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            middle: rim.place(f64::midpoint(from, to)),
            size: rim.radius * (to - from) / 2.0,
        }
    }
}

impl Left {
    fn restart(&mut self, rim: &Rim) {
        self.gaps.clear();
        self.gaps.push(Gap::of(rim, -FRAC_PI_2, FRAC_PI_2));
    }

    /// Whether something between two angles is left.
    fn meets(&self, from: f64, to: f64) -> bool {
        to > from && self.gaps.iter().any(|gap| from < gap.to && to > gap.from)
    }

    /// Whether a piece may have something of it within a distance.
    fn is_near(&self, piece: &Curve, reach: f64) -> bool {
        let mut gaps = self.gaps.iter();
        gaps.any(|gap| piece.distance(gap.middle) <= gap.size + reach + SPARE)
    }

    /// Takes away what lies between two angles.
    fn take(&mut self, rim: &Rim, from: f64, to: f64) {
        self.cuts += 1;
        self.spare.clear();
        for &gap in &self.gaps {
            if from >= gap.to || to <= gap.from {
                self.spare.push(gap);
                continue;
            }
            if from > gap.from {
                self.spare.push(Gap::of(rim, gap.from, from));
            }
            if to < gap.to {
                self.spare.push(Gap::of(rim, to, gap.to));
            }
        }
        core::mem::swap(&mut self.gaps, &mut self.spare);
    }

    /// All that is left, in rad.
    fn angle(&self) -> f64 {
        let left = self.gaps.iter().fold(0.0, |sum, gap| sum + (gap.to - gap.from));
        if left > NOTHING { left } else { 0.0 }
    }
}

impl Cleared {
    pub(super) fn new(region: &Region, pieces: &[Piece], radius: f64) -> Self {
        let pieces: Vec<Curve> = pieces.iter().map(|&piece| Curve::of(piece)).collect();
        // What has no length cuts nothing that its neighbours do not.
        let nowhere = Extent::of(Place::new(f64::NAN, f64::NAN), Place::new(f64::NAN, f64::NAN));
        let extent = |curve: &Curve| {
            if curve.piece.is_sound() {
                curve.extent()
            } else {
                nowhere
            }
        };
        let extents: Vec<Extent> = pieces.iter().map(extent).collect();
        let open = region.edges().filter(|edge| edge.side == Side::Open);
        let open: Vec<Curve> = open.map(|edge| Curve::of(edge.piece)).collect();
        let air = (!open.is_empty()).then(|| (Inside::of(region), open));
        let tree = Tree::of(&extents);
        Self {
            radius,
            pieces,
            tree,
            air,
            near: Vec::new(),
            left: Left::default(),
        }
    }

    pub(super) const fn radius(&self) -> f64 {
        self.radius
    }

    /// How many pieces are near to the stretch that is looked at.
    pub(super) const fn near(&self) -> usize {
        self.near.len()
    }

    /// Whether a place lies on one of the first pieces, give or take some mm.
    pub(super) fn has_been_at(&self, place: Place, within: f64, first: usize) -> bool {
        let mut is_found = false;
        self.tree
            .meeting(Extent::of(place, place).grown(within), &mut |piece| {
                let curve = self.pieces.get(piece as usize);
                let is_near = curve.is_some_and(|curve| curve.distance(place) <= within);
                is_found |= is_near && (piece as usize) < first;
            });
        is_found
    }

    /// Comes near to a stretch of a way: finds which of the first pieces cut something of the rim within `aside` mm from its middle.
    pub(super) fn approach(&mut self, way: &Curve, share: f64, aside: f64, first: usize) {
        let at = way.piece.at(share);
        let reach = 2.0 * self.radius + aside;
        let Self {
            pieces, tree, near, ..
        } = self;
        near.clear();
        tree.meeting(Extent::of(at, at).grown(reach), &mut |piece| {
            let is_near = |curve: &Curve| curve.distance(at) < reach;
            if (piece as usize) < first && pieces.get(piece as usize).is_some_and(is_near) {
                near.push(piece);
            }
        });
    }

    /// How much of the rim is left in the material by the pieces that are near, at a share of the way along one more; at most, while the
    /// centre is no more than `aside` from there along that way.
    pub(super) fn angle_left(&mut self, way: &Curve, share: f64, aside: f64) -> f64 {
        let rim = Rim {
            at: way.piece.at(share),
            ahead: way.piece.direction(share),
            radius: self.radius,
            grown: if aside > 0.0 || share >= 1.0 {
                TOUCHING
            } else {
                -TOUCHING
            },
        };
        // How far the way turns while it goes by `aside`.
        let turn = aside * way.bend.abs();
        let mut left = core::mem::take(&mut self.left);
        left.restart(&rim);
        self.take_air(&rim, aside, turn, &mut left);
        let mut first = 0;
        for number in 0..self.near.len() {
            let cuts = left.cuts;
            if let Some(&piece) = self.near.get(number)
                && let Some(piece) = self.pieces.get(piece as usize)
            {
                cut_while_moving(&rim, way, piece, aside, &mut left);
            }
            if left.cuts > cuts {
                self.near.swap(first, number);
                first += 1;
            }
        }
        if let Some(older) = older_part(way, share, turn) {
            cut_while_moving(&rim, way, &older, aside, &mut left);
        }
        let angle = left.angle();
        self.left = left;
        angle
    }

    /// Takes away what of the rim lies beyond open sides. No wall meets the rim, so it leaves the region through open sides only.
    fn take_air(&self, rim: &Rim, aside: f64, turn: f64, left: &mut Left) {
        let Some((inside, open)) = &self.air else {
            return;
        };
        let near = || {
            open.iter()
                .filter(|edge| edge.distance(rim.at) <= rim.radius + aside)
        };
        let mut crossings = Vec::new();
        for edge in near() {
            outline_crossings(edge, aside, &circle(rim.at, rim.radius), &mut |place| {
                crossings.extend(rim.angle(place));
            });
        }
        crossings.extend([-FRAC_PI_2, FRAC_PI_2]);
        crossings.sort_unstable_by(f64::total_cmp);
        for pair in crossings.windows(2) {
            if let &[from, to] = pair
                && to > from
            {
                let middle = rim.place(f64::midpoint(from, to));
                let is_air = || !inside.contains(middle) && near().all(|edge| edge.distance(middle) >= aside);
                if left.meets(from + turn, to - turn) && is_air() {
                    left.take(rim, from + turn, to - turn);
                }
            }
        }
    }
}

/// Takes away what an earlier piece cuts of the rim, whichever way the centre goes from here along its own way, by at most `aside`.
fn cut_while_moving(rim: &Rim, way: &Curve, piece: &Curve, aside: f64, left: &mut Left) {
    if !left.is_near(piece, rim.radius) {
        return;
    }
    if aside <= 0.0 {
        rim.cut(piece, rim.radius, 0.0, left);
        return;
    }
    if way.piece.is_line() && piece.piece.is_line() {
        // Along the piece the centre goes by the cosine, across by the sine.
        let (cos, sin) = (
            way.ahead.dot(piece.ahead).abs(),
            way.ahead.cross(piece.ahead).abs(),
        );
        if let Some(shorter) = shortened(piece, aside * cos) {
            rim.cut(&shorter, rim.radius - aside * sin, 0.0, left);
            if sin < ALONG {
                return;
            }
        }
    } else if let Some(off) = off_centre(way, piece) {
        // With the tool's way ahead as the direction from which angles count, the piece turns about the tool's centre of turning.
        let turn = aside * way.bend.abs();
        if let Some(shorter) = shortened(piece, turn / piece.bend.abs()) {
            rim.cut(&shorter, rim.radius - off * turn, 0.0, left);
        }
        return;
    }
    rim.cut(piece, rim.radius - aside, aside * way.bend.abs(), left);
}

/// How far apart the centres of two arcs are, if that is little.
fn off_centre(way: &Curve, piece: &Curve) -> Option<f64> {
    if way.piece.is_line() || piece.piece.is_line() {
        return None;
    }
    let [one, other] = [way, piece].map(|arc| arc.middle.plus(arc.normal.times(1.0 / arc.bend)));
    Some(one.distance(other)).filter(|off| *off < ONE_CENTRE)
}

/// A piece that is shorter at both ends; none where nothing is left.
fn shortened(piece: &Curve, by: f64) -> Option<Curve> {
    let share = by / piece.piece.length();
    let rest = part(piece.piece, share, 1.0 - share);
    (share < 0.5 && rest.is_sound()).then(|| Curve::of(rest))
}

/// The part of an arc's way that lies a quarter of a turn and more behind, with a further angle to spare. What is nearer never cuts
/// the front half of the rim, or cuts of it what can be left out without loss.
fn older_part(way: &Curve, share: f64, spare: f64) -> Option<Curve> {
    let sweep = way.piece.sweep.abs();
    if way.piece.is_line() {
        return None;
    }
    let end = share - (FRAC_PI_2 + spare) / sweep;
    let older = part(way.piece, 0.0, end);
    (end > 0.0 && older.is_sound()).then(|| Curve::of(older))
}
