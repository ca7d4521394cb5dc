//! Discs that come down on a waved sheet.

use super::surface::PLAN;
use vcutc::surface::disc::{Axis, Disc, Pose, Stage};
use vcutc::surface::drop::Dropper;
use vcutc::surface::gouge::{Moves, Placed};
use vcutc::surface::surface::Surface;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::{Angle, Length};

/// Places at which a disc comes down.
pub const PLACES: u64 = 10_000;

/// Of the edge, in mm.
pub const RADIUS: f64 = 25.0;

/// The surface, prepared.
#[must_use]
pub fn dropper(surface: &Surface) -> Dropper<'_> {
    Dropper::new(surface)
}

/// Fractional parts of multiples of irrational numbers fill a range evenly.
fn share(k: u32, step: f64) -> f64 {
    (f64::from(k) * step).fract()
}

/// Places all over the plan.
pub fn places() -> impl Iterator<Item = [f64; 2]> {
    let place = |k: u32| {
        [
            PLAN[0] * share(k, 0.754_877_666),
            PLAN[1] * share(k, 0.569_840_291),
        ]
    };
    (0..PLACES as u32).map(place)
}

/// These, and an axis that leans by 5 degrees in a direction of its own at each.
fn postures() -> impl Iterator<Item = ([f64; 2], Axis)> {
    (0_u32..).zip(places()).map(|(k, place)| {
        let (sine, cosine) = (std::f64::consts::TAU * share(k, 0.618_033_989)).sin_cos();
        let axis = Axis::new([0.087 * cosine, 0.087 * sine, 1.0]).expect("it points up");
        (place, axis)
    })
}

/// The sum of the heights at which the face of a disc rests, in mm.
#[must_use]
pub fn faces(dropper: &Dropper<'_>) -> f64 {
    let rests = postures().filter_map(|(place, axis)| dropper.face(Length::mm(RADIUS), place, axis));
    rests.map(|rest| rest.height.to_mm()).sum()
}

/// The disc with a hub and a holder on it.
///
/// # Panics
/// Never: the disc is a good one.
#[must_use]
pub fn disc() -> Disc {
    let stage = |radius, from, to| Stage {
        radius: Length::mm(radius),
        from: Length::mm(from),
        to: Length::mm(to),
    };
    let stages = vec![stage(8.0, 1.2, 30.0), stage(30.0, 30.0, 200.0)];
    Disc::new(Length::mm(RADIUS), stages).expect("it is a disc")
}

/// The sum of the heights at which the whole disc rests, in mm.
#[must_use]
pub fn discs(dropper: &Dropper<'_>) -> f64 {
    let disc = disc();
    let rests = postures().filter_map(|(place, axis)| dropper.disc(&disc, place, axis));
    rests.map(|rest| rest.height.to_mm()).sum()
}

/// Poses of a track, every 5 mm.
pub const POSES: u64 = 500;

/// The face of a disc all along a track over the middle of the plan.
///
/// # Panics
/// Never: the track lies over the plan.
#[must_use]
pub fn track(moves: &Moves<'_, '_>, disc: &Disc) -> Vec<Placed> {
    let axis = Axis::new([0.0, 0.087, 1.0]).expect("it points up");
    let placed = |k: u32| {
        let [x, y] = [PLAN[0] / 2.0, 100.0 + 5.0 * f64::from(k)];
        let rest = moves.dropper().face(disc.radius(), [x, y], axis)?;
        let centre = Point3::new(x, y, rest.height.to_mm());
        moves.place(disc, Pose { centre, axis })
    };
    let placed = (0..POSES as u32).map(|k| placed(k).expect("it lies over the plan"));
    placed.collect()
}

/// The deepest that it may come on any of the moves of a track, in mm.
#[must_use]
pub fn deepest(moves: &Moves<'_, '_>, disc: &Disc, track: &[Placed]) -> f64 {
    let bounds = track
        .windows(2)
        .map(|pair| moves.between(disc, [&pair[0], &pair[1]], Angle::ZERO, Length::ZERO));
    bounds.map(|entry| entry.depth.to_mm()).fold(0.0, f64::max)
}
