//! Arcs in the words of a control: `G2` and `G3` about a centre in a plane of two axes, or `CIP` through a point in any plane.
//!
//! Planes are those of the frame of the work offset, where coordinates are. The control knows the printed coordinates alone, so the
//! offset of a centre is counted from the printed start, and the arc that the printed words make is compared with the one that
//! was proven. The ends of that arc are not equally far from its centre, by no more than some units of the last decimal: at 3
//! decimals 0.002 mm, far within what controls take (LinuxCNC 0.028 mm, `CENTER_ARC_RADIUS_TOLERANCE_MM` [L-GC]; Sinumerik
//! 0.01 mm, MD21000 [S-840]).

use crate::controller::Arcs;
use crate::job::Job;
use crate::statement::{Plane, Sense};
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::vector::{minus, plus};

/// An arc as it is written, in the frame of the work offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WrittenArc {
    /// About a centre in a plane of two axes.
    About {
        plane: Plane,
        sense: Sense,
        /// The centre as the control computes it from the printed words.
        centre: [f64; 3],
        /// From the printed start to it; 0 across the plane.
        offset: [f64; 3],
    },
    /// Through a point.
    Through(Point3),
}

/// Why an arc is not written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoArc {
    /// It lies in no plane that the control has.
    Oblique,
    /// Its printed words make another arc, or none.
    Lost,
}

/// How far a point may lie out of a plane to be in it, in units of the last decimal: what turning a frame leaves.
const FLAT_UNITS: f64 = 0.1;

/// Least cosine between the axis of an arc and that of its plane.
const SQUARE: f64 = 1.0 - 1e-7;

/// By how much printing may change the length of an arc and its radius, in units of the last decimal: each of its points is off by
/// less than one, and an arc goes round by less than six radii.
const FAITHFUL_UNITS: f64 = 10.0;

/// A move of the tip as an arc; none for one on a line.
pub(crate) fn written(job: &Job<'_>, line: &LinearSegment) -> Result<Option<WrittenArc>, NoArc> {
    let Some(via) = line.via else { return Ok(None) };
    let lengths = job.settings.common.lengths;
    let [from, via, to] =
        [line.from.tip, via, line.to.tip].map(|point| job.work_in_offset.in_offset(point).to_array());
    let arc = CircularArc::through([from, via, to]).ok_or(NoArc::Lost)?;
    let plane = Plane::ALL.into_iter().find(|&plane| is_in(&arc, plane, lengths));
    let printed = |point: [f64; 3]| as_printed(point, lengths).ok_or(NoArc::Lost);
    let ends = [printed(from)?, printed(to)?];
    let written = match (job.settings.facts().arcs, plane) {
        (Arcs::InPlanes | Arcs::InAnyPlane, Some(plane)) => {
            let offset = printed(plane.within(minus(arc.centre(), ends[0])))?;
            about(&arc, plane, plus(ends[0], offset), ends)
        }
        // `C` leaves Z as it was printed.
        (Arcs::AboutPole, Some(plane @ Plane::Xy)) if ends[0][2] == ends[1][2] => {
            let centre = printed(arc.centre())?;
            about(&arc, plane, [centre[0], centre[1], ends[0][2]], ends)
        }
        (Arcs::InAnyPlane, None) => {
            let through = printed(via)?;
            let point = Point3::from(through);
            (
                CircularArc::through([ends[0], through, ends[1]]),
                WrittenArc::Through(point),
            )
        }
        (Arcs::InPlanes, None) | (Arcs::AboutPole, _) => {
            return Err(NoArc::Oblique);
        }
    };
    match written {
        (Some(is), written) if is_faithful(&is, &arc, lengths) => Ok(Some(written)),
        (Some(_) | None, _) => Err(NoArc::Lost),
    }
}

/// An arc about a centre, with what the control makes of it.
fn about(
    arc: &CircularArc,
    plane: Plane,
    centre: [f64; 3],
    ends: [[f64; 3]; 2],
) -> (Option<CircularArc>, WrittenArc) {
    let turns_up = arc.axis().get(plane.normal()).is_some_and(|along| *along > 0.0);
    let sense = if turns_up {
        Sense::Counterclockwise
    } else {
        Sense::Clockwise
    };
    // The end may be printed beside the plane of the start, by what turning the frame leaves.
    let in_plane = |point: [f64; 3]| plus(ends[0], plane.within(minus(point, ends[0])));
    let is = CircularArc::about(in_plane(centre), sense.axis(plane), ends.map(in_plane));
    let offset = plane.within(minus(centre, ends[0]));
    (
        is,
        WrittenArc::About {
            plane,
            sense,
            centre,
            offset,
        },
    )
}

/// Whether an arc lies in a plane of two axes.
fn is_in(arc: &CircularArc, plane: Plane, lengths: FixedDecimal) -> bool {
    let across = |vector: [f64; 3]| vector.get(plane.normal()).copied().unwrap_or_default().abs();
    let out: f64 = arc.radii().into_iter().map(across).sum();
    out <= FLAT_UNITS * lengths.unit() && across(arc.axis()) >= SQUARE
}

/// Whether the arc of the printed words is the one that was meant.
fn is_faithful(is: &CircularArc, should: &CircularArc, lengths: FixedDecimal) -> bool {
    let within = FAITHFUL_UNITS * lengths.unit();
    let is_near = |is: f64, should: f64| (is - should).abs() <= within;
    let radius = should.radius().to_mm();
    let middle = |arc: &CircularArc| arc.at(0.5 * arc.sweep().to_rad());
    let ways = middle(is).into_iter().zip(middle(should));
    // The direction of an arc as small as its decimals is random; an end that is printed on the start makes a
    // full circle; a point of an arc beside one of its ends says little of how far it bends.
    radius > within
        && is_near(is.length().to_mm(), should.length().to_mm())
        && ways.into_iter().all(|(is, should)| is_near(is, should))
}

/// A point as the control reads it; none for what is not a number.
fn as_printed(point: [f64; 3], format: FixedDecimal) -> Option<[f64; 3]> {
    let mut out = [0.0; 3];
    for (printed, value) in out.iter_mut().zip(point) {
        let mut text = Vec::with_capacity(12);
        format.push(&mut text, value).ok()?;
        *printed = core::str::from_utf8(&text).ok()?.parse().ok()?;
    }
    Some(out)
}
