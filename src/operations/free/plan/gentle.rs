//! Arcs that are too short for a blade that turns with its way, as longer ones.
//!
//! An arc of the length `l` that turns by the angle `a` lies within `l a / 8` of the corner of its tangents. So where a way hardly turns, a
//! longer arc between the same lines lies within a few hundredths of a millimetre of the shorter one.

use vcutc_process::slits::fit::is_followed;
use vcutc_region::piece::Piece;

/// What of a line beside an arc may become part of it.
const SHARE: f64 = 0.45;

/// How much longer an arc is made at once.
const LONGER: f64 = 1.25;

/// The shortest tangent of an arc that is looked at, in mm.
const SHORTEST: f64 = 0.05;

/// How often an arc is made longer: to far more than a metre.
const TRIALS: u32 = 64;

/// A way in which arcs between lines are as long as a blade needs them, as far as these lines go.
pub(super) fn gentle(mut way: Vec<Piece>) -> Vec<Piece> {
    for place in 1..way.len().saturating_sub(1) {
        let around = way.get(place - 1..=place + 1);
        let Some(&[before, arc, after]) = around else {
            continue;
        };
        if is_followed(arc) || !before.is_line() || !after.is_line() {
            continue;
        }
        if let Some(longer) = between(before, arc, after)
            && let Some([before, arc, after]) = way.get_mut(place - 1..=place + 1)
        {
            before.to = longer.from;
            after.from = longer.to;
            *arc = longer;
        }
    }
    way
}

/// The shortest arc that a blade follows from one line to another, which turns as much as one that it does not follow.
fn between(before: Piece, arc: Piece, after: Piece) -> Option<Piece> {
    let half = libm::tan(arc.sweep.abs() / 2.0);
    let own = arc.radius()? * half;
    let [on, off] = [arc.direction(0.0), arc.direction(1.0)];
    let corner = arc.from.plus(on.times(own));
    let most = own + SHARE * before.length().min(after.length());
    let mut tangent = own.max(SHORTEST);
    for _ in 0..TRIALS {
        let longer = Piece::arc(
            corner.minus(on.times(tangent)),
            corner.plus(off.times(tangent)),
            arc.sweep,
        );
        if tangent > most {
            return None;
        }
        if is_followed(longer) {
            return Some(longer);
        }
        tangent *= LONGER;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_region::outward::outward;
    use vcutc_region::place::Place;

    /// Two lines that turn by so much, in deg, moved outwards.
    fn bent(degrees: f64, by: f64) -> Vec<Piece> {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let corner = Place::new(50.0, 0.0);
        let end = corner.plus(Place::new(cos, sin).times(40.0));
        let way = [
            Piece::line(Place::new(0.0, 0.0), corner),
            Piece::line(corner, end),
        ];
        outward(&way, by)
    }

    #[test]
    fn short_arcs_become_longer_and_hardly_move() {
        for degrees in [0.01, 0.1, 0.4, 1.0, 2.0, 3.0, 3.9, 4.1, 5.0] {
            for by in [1.0, 8.0, 15.0] {
                let sharp = bent(degrees, by);
                let found = gentle(sharp.clone());
                assert_eq!(found.len(), sharp.len());
                for pair in found.windows(2) {
                    assert_eq!(pair[0].to, pair[1].from);
                    let turn = pair[0].direction(1.0).cross(pair[1].direction(0.0));
                    assert!(turn.abs() < 1e-9, "{degrees} {by}: {turn}");
                }
                assert!(
                    found.iter().all(|piece| is_followed(*piece)),
                    "{degrees} {by}: {found:?}"
                );
                // As far from the corner of the way as its tangents allow.
                let corner = Place::new(50.0, 0.0);
                let near = corner.distance(found[1].at(0.5));
                assert!((near - by).abs() < 0.08, "{degrees} {by}: {near}");
            }
        }
    }

    /// Between lines that are too short an arc stays as it is.
    #[test]
    fn short_lines_leave_arcs_as_they_are() {
        let mut way = bent(3.0, 8.0);
        let first = way.first_mut().unwrap();
        first.from = first.at(0.99);
        assert_eq!(gentle(way.clone()), way);
    }
}
