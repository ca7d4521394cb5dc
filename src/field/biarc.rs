//! Two arcs that are tangent to each other (Bolton 1975): from place to place, in given directions at both.

use crate::wall::angle;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// Arcs no higher over their chord than this, in mm, are lines.
const FLAT: f64 = 1e-7;

/// Length of both arcs over the way, at most; half a circle has 1.57.
const LONGEST: f64 = 2.0;

/// A place of a line, and the direction in which the line passes it, of length 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    pub(crate) place: Place,
    pub(crate) along: Place,
}

/// Two tangent arcs between places.
pub(crate) struct Biarc {
    pub(crate) from: Place,
    /// Where both arcs meet.
    pub(crate) joint: Place,
    pub(crate) to: Place,
    /// Angles that the arcs turn through.
    sweeps: [f64; 2],
}

impl Biarc {
    pub(crate) fn new(from: Knot, to: Knot) -> Self {
        let way = to.place.minus(from.place);
        let (start, end) = (from.along, to.along);
        let both = start.plus(end);
        // Both arcs reach equally far along their tangents: |way - d both| = 2 d.
        let (square, ahead) = (way.dot(way), way.dot(both));
        let open = 1.0 - start.dot(end);
        let root = (ahead * ahead + 2.0 * open * square).sqrt();
        let d = square / (ahead + root);
        let joint = from
            .place
            .plus(start.times(d))
            .lerp(to.place.minus(end.times(d)), 0.5);
        Self {
            from: from.place,
            joint,
            to: to.place,
            sweeps: [
                2.0 * angle(start, joint.minus(from.place)),
                2.0 * angle(to.place.minus(joint), end),
            ],
        }
    }

    pub(crate) fn arcs(&self) -> [Piece; 2] {
        let piece = |from: Place, to: Place, sweep: f64| {
            let is_flat = from.distance(to) * sweep.abs() / 8.0 < FLAT;
            if is_flat {
                Piece::line(from, to)
            } else {
                Piece::arc(from, to, sweep)
            }
        };
        let [first, second] = self.sweeps;
        [
            piece(self.from, self.joint, first),
            piece(self.joint, self.to, second),
        ]
    }

    /// Its arcs, if they are sound and not much longer than the way: where directions point back, they swing far aside.
    pub(crate) fn sound(&self) -> Option<[Piece; 2]> {
        let arcs = self.arcs();
        let is_sound = arcs.iter().all(|arc| arc.is_sound());
        let length: f64 = arcs.iter().map(|arc| arc.length()).sum();
        (is_sound && length <= LONGEST * self.from.distance(self.to)).then_some(arcs)
    }

    /// Whether one of its arcs turns further than some rad.
    pub(crate) fn turns_further(&self, most: f64) -> bool {
        self.sweeps.iter().any(|sweep| sweep.abs() > most)
    }
}
