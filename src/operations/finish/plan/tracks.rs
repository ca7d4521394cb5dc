//! Where tracks lie, and how the disc is held on them.

use super::order::{Run, runs};
use super::{Track, Wish, Work, model};
use crate::asked::Sequence;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_job::Auto;
use vcutc_simulation::cross_section::Guard;
use vcutc_simulation::rim::Rim;
use vcutc_simulation::surface::Side;

/// How the axis of the disc leans to the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Tilt {
    Fixed(Angle),
    /// By the least with which strips of so many steps pass the hub.
    PastHub {
        share: f64,
    },
}

/// A plan with the least of the side tilts that may be taken: upright first, then so far that strips pass the hub.
///
/// # Errors
///
/// What keeps the upright disc from cutting, because that is what a user can fix. Other tilts are tried only
/// where it is the hub.
pub(crate) fn least_tilted<P, R>(
    side: Auto<Angle>,
    plan: impl Fn(Tilt) -> Result<P, R>,
    is_over_body: impl Fn(&R) -> bool,
) -> Result<P, R> {
    if let Auto::Given(side) = side {
        return plan(Tilt::Fixed(side));
    }
    let upright = match plan(Tilt::Fixed(Angle::ZERO)) {
        Err(why) if is_over_body(&why) => why,
        done => return done,
    };
    for share in [1.05, 1.5] {
        match plan(Tilt::PastHub { share }) {
            Ok(planned) => return Ok(planned),
            Err(why) if is_over_body(&why) => {}
            Err(_) => break,
        }
    }
    Err(upright)
}

/// How the disc is held on the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hold {
    /// How far its axis leans along the feed, from the normal of the part.
    pub(super) lead: Angle,
    /// How far it leans to the side that tracks step to.
    pub(super) side: Angle,
}

/// The distance of tracks that leave the limit on a plane, in mm; no more than the strips that the disc takes, nor than have room
/// beside its hub.
pub(super) fn first_step(wish: &Wish, lead: Angle, tilt: Tilt) -> f64 {
    let radius = wish.disc.radius.to_mm();
    let most = wish.disc.width.map_or(f64::INFINITY, Length::to_mm);
    let upright = model::plane_step(radius, lead.to_rad(), wish.scallop.to_mm()).min(most);
    let tilted = |side: Angle, most: f64| {
        let effective = model::effective_radius(radius, lead.to_rad(), side.to_rad());
        model::step(effective, 0.0, wish.scallop.to_mm()).min(most)
    };
    match tilt {
        Tilt::Fixed(Angle::ZERO) => upright,
        Tilt::Fixed(side) => tilted(side, upright),
        Tilt::PastHub { share } => {
            let most = upright.min((radius - clear_of_hub(wish)) / share).max(1e-3);
            let side = past_hub(wish, lead, share * most / 2.0).unwrap_or_default();
            tilted(side, most)
        }
    }
}

/// How far strips have to keep from the axis, in mm.
pub(crate) fn clear_of_hub(wish: &Wish) -> f64 {
    let hub = wish.disc.body.first().map(|stage| stage.radius);
    (hub.unwrap_or(Length::ZERO) + wish.clearance).to_mm()
}

/// The least side tilt with which strips that reach so far from the contact pass the hub.
pub(crate) fn past_hub(wish: &Wish, lead: Angle, reach: f64) -> Option<Angle> {
    let radius = wish.disc.radius.to_mm();
    let side = model::side_past_hub(radius, lead.to_rad(), clear_of_hub(wish), reach).map(Angle::rad);
    // As it is printed, so that a job that states it is cut alike.
    side.map(|side| Angle::deg((side.to_deg() * 1e3).ceil() / 1e3))
}

/// The side tilt of tracks so far apart; none where no tilt carries strips past the hub, which the simulation then says.
pub(super) fn side(work: Work<'_>, wish: &Wish, lead: Angle, tilt: Tilt, step: Length) -> Angle {
    match tilt {
        Tilt::Fixed(side) => side,
        Tilt::PastHub { share } => {
            // Along the part tracks are farther apart than over x.
            let points = work.bound.points();
            let pairs = points.iter().zip(points.iter().skip(1));
            let ratios = pairs.map(|(a, b)| libm::hypot(b.x - a.x, b.z - a.z) / (b.x - a.x));
            let steepest = ratios.fold(1.0, f64::max).min(STEEPEST);
            past_hub(wish, lead, share * step.to_mm() * steepest / 2.0).unwrap_or_default()
        }
    }
}

/// Places steeper than this do not decide the side tilt: there few tracks lie. As a ratio of lengths, 60 degrees.
const STEEPEST: f64 = 2.0;

/// So many tracks in an order.
pub(super) fn laid(
    work: Work<'_>,
    guard: &Guard<'_>,
    wish: &Wish,
    hold: Hold,
    sequence: Sequence,
    count: u32,
) -> Vec<Track> {
    let (from, to) = work.part.span();
    let step = (to - from) / f64::from(count);
    let mut left: Vec<f64> = (0..count)
        .map(|number| step.mul_add(f64::from(number) + 0.5, from))
        .collect();
    let mut tracks = Vec::with_capacity(left.len());
    for run in runs(work.part, sequence) {
        let mut xs: Vec<f64> = left.extract_if(.., |x| run.covers(*x)).collect();
        if run.side() == Side::Left {
            xs.reverse();
        }
        tracks.extend(
            xs.into_iter()
                .map(|x| track(work, guard, wish, hold, run, [x, step])),
        );
    }
    match sequence {
        Sequence::Descending => tracks.sort_by(|a, b| b.contact.z.total_cmp(&a.contact.z)),
        Sequence::Crests | Sequence::Rightwards | Sequence::Leftwards => {}
    }
    tracks
}

/// The track at an x: rolled to the slope of the part over its step, leaned to the side of its run, and let down on the part.
fn track(work: Work<'_>, guard: &Guard<'_>, wish: &Wish, hold: Hold, run: Run, [x, step]: [f64; 2]) -> Track {
    let (bound, radius) = (work.bound, wish.disc.radius);
    let (from, to) = bound.span();
    let ends = [(x - step / 2.0).max(from), (x + step / 2.0).min(to)];
    let [left, right] = ends.map(|x| bound.height(x));
    let slope = (right - left) / (ends[1] - ends[0]).max(f64::MIN_POSITIVE);
    let upright = Angle::rad(libm::atan(slope));
    let roll = match run.side() {
        Side::Right => upright - hold.side,
        Side::Left => upright + hold.side,
    };
    let rim = |centre| Rim::rolled(centre, radius, hold.lead, roll);
    let below = rim(Point2::new(0.0, 0.0)).touching(slope);
    let centre = Point2::new(x - below.x, bound.height(x) - below.z);
    // As it is printed, and never nearer to the part.
    let centre = Point2::new(grid::nearest(centre.x), centre.z);
    let nearest = guard.nearest(&rim(centre));
    let (at, depth) = nearest.unwrap_or((Point2::new(x, bound.height(x)), 0.0));
    Track {
        contact: Point2::new(at.x, bound.height(at.x)),
        centre: Point2::new(centre.x, grid::up(centre.z + depth)),
        roll,
    }
}
