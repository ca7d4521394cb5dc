//! The way of a disc on a track, and how it shows in a section.
//!
//! A section at y is passed by each point of the edge at a time of its own. All of the disc is taken to go on straight, as its point at
//! the contact does at the moment at which it touches the part in that section: then all that the disc sweeps shows as one
//! ellipse ([`SkinPass`]). That point moves along the part, while the centre also turns about it: on a dome its way is less
//! steep, in a bowl steeper. What this leaves out is the bend k of the way over the distance d by which a point of the edge lies
//! before or after the contact: heights are off by about `k d^2 / 2`. Without side tilt d is `w^2 / 2R` beside the contact by w,
//! which makes half a micrometre for tracks 16 mm apart on a dome of 3 m, with a disc of 25 mm; with side tilt it is larger on the
//! side of the strip.

use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::units::Angle;
use vcutc_backend_api::vector::cross;
use vcutc_geometry::curve::Point2;
use vcutc_process::posture::Feed;
use vcutc_simulation::cross_section::Guard;
use vcutc_simulation::disc::{Disc, SkinPass};
use vcutc_simulation::prove::Skin;
use vcutc_simulation::rim::Drift;
use vcutc_surface::disc::{Axis, Pose};

/// How often the place of the contact is looked for: its distance from the centre hardly changes along a track.
const ROUNDS: usize = 3;

/// A disc that goes from pose to pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    poses: Vec<Pose>,
    feed: Feed,
}

/// The disc in a place of its way, and where it goes.
struct Held {
    centre: [f64; 3],
    axis: [f64; 3],
    /// How much the centre moves with each mm that it goes along y, in the sense of the feed.
    velocity: [f64; 3],
    /// The same of the axis.
    turn: [f64; 3],
    feed: Feed,
}

impl Held {
    /// How much x and z of a point of the disc change with each mm that it goes along y, in the sense of the feed: it moves with the
    /// centre, and turns with the axis. The point lies so far to the right of the centre, and ahead.
    fn drift(&self, right: f64, ahead: f64) -> Drift {
        let a = self.axis;
        let along = self.feed.along(ahead);
        // Of the face, so square to the axis.
        let off = [right, along, -(a[0] * right + a[1] * along) / a[2]];
        let spin = cross(a, self.turn);
        let round = cross(spin, off);
        let moved: [f64; 3] = core::array::from_fn(|i| self.velocity[i] + round[i]);
        let along = self.feed.along(moved[1]);
        Drift {
            right: moved[0] / along,
            climb: moved[2] / along,
        }
    }
}

/// The pose of a disc whose tool is held so; none if its axis does not point up.
#[must_use]
pub fn pose_of(tip: Point3, held: Orientation) -> Option<Pose> {
    let axis = Axis::new(held.matrix().map(|row| -row[2]))?;
    Some(Pose { centre: tip, axis })
}

impl Way {
    /// Through at least two poses, each farther along y than the one before; none otherwise.
    #[must_use]
    pub fn new(poses: Vec<Pose>) -> Option<Self> {
        let (first, last) = (poses.first()?, poses.last()?);
        let feed = if last.centre.y > first.centre.y {
            Feed::Forward
        } else {
            Feed::Backward
        };
        let mut pairs = poses.iter().zip(poses.iter().skip(1));
        let goes_on = |(from, to): (&Pose, &Pose)| feed.along(to.centre.y) > feed.along(from.centre.y);
        (poses.len() > 1 && pairs.all(goes_on)).then_some(Self { poses, feed })
    }

    /// The poses in turn.
    #[must_use]
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Which way along y it leads.
    #[must_use]
    pub const fn feed(&self) -> Feed {
        self.feed
    }

    /// From where to where the axis leans along the way, over all moves. The lead, seen from the way itself.
    #[must_use]
    pub fn leads(&self) -> Option<[Angle; 2]> {
        let moves = self.poses.iter().zip(self.poses.iter().skip(1));
        let leads = moves.map(|(from, to)| {
            let way: [f64; 3] = core::array::from_fn(|i| to.centre.to_array()[i] - from.centre.to_array()[i]);
            let long = way.iter().map(|part| part * part).sum::<f64>().sqrt();
            let along = |pose: &Pose| {
                let axis = pose.axis.to_array();
                axis.iter().zip(way).map(|(a, b)| a * b).sum::<f64>() / long
            };
            [along(from), along(to)].map(|sine| libm::asin(sine.clamp(-1.0, 1.0)))
        });
        let all = leads.reduce(|[a, b], [c, d]| [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))])?;
        Some([all[0].min(all[1]), all[0].max(all[1])].map(Angle::rad))
    }

    /// The disc with its centre so far along y, in the sense of the feed; none before and after the way.
    fn at(&self, along: f64) -> Option<Held> {
        let place = |pose: &Pose| self.feed.along(pose.centre.y);
        let next = self.poses.partition_point(|pose| place(pose) < along).max(1);
        let (from, to) = (self.poses.get(next - 1)?, self.poses.get(next)?);
        let (begin, end) = (place(from), place(to));
        if along < begin || along > end {
            return None;
        }
        let done = (along - begin) / (end - begin);
        let between = |a: [f64; 3], b: [f64; 3]| core::array::from_fn(|i| a[i] + (b[i] - a[i]) * done);
        let rate = |a: [f64; 3], b: [f64; 3]| core::array::from_fn(|i| (b[i] - a[i]) / (end - begin));
        let (a, b) = (from.centre, to.centre);
        let axis: [f64; 3] = between(from.axis.to_array(), to.axis.to_array());
        let long = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
        Some(Held {
            centre: between(a.to_array(), b.to_array()),
            axis: axis.map(|part| part / long),
            velocity: rate(a.to_array(), b.to_array()),
            turn: rate(from.axis.to_array(), to.axis.to_array()),
            feed: self.feed,
        })
    }

    /// The pass that it shows as in the section at y of a part, at the moment at which the disc touches the part there, and where
    /// the disc is then. None if the way begins after it or ends before it.
    #[must_use]
    pub fn pass(&self, y: f64, disc: &Disc, skin: Skin, part: &Guard<'_>) -> Option<(SkinPass, Point3)> {
        let section = self.feed.along(y);
        let (mut right, mut ahead) = (0.0, disc.radius.to_mm());
        let mut found = None;
        for _ in 0..ROUNDS {
            let held = self.at(section - ahead)?;
            let pass = seen(&held, [right, ahead], skin);
            let nearest = part.nearest(&pass.rim(disc));
            let contact = nearest.map_or(pass.centre.x, |(at, _)| at.x);
            (right, ahead) = (contact - held.centre[0], pass.ahead(disc, contact));
            found = Some((SkinPass { contact, ..pass }, held.centre.into()));
        }
        found
    }
}

/// What a disc on its way shows as in a section in which it touches the part so far to the right of its centre, and ahead.
fn seen(held: &Held, [beside, ahead]: [f64; 2], skin: Skin) -> SkinPass {
    let [x, _, z] = held.centre;
    // Along the feed: the axis leans to either side of the plane of x and z.
    let [aside, along, up] = held.axis;
    let along = held.feed.along(along);
    let drift = held.drift(beside, ahead);
    SkinPass {
        centre: Point2::new(x + drift.right * ahead, z + drift.climb * ahead),
        contact: x,
        lead: Angle::rad(libm::atan2(along, libm::hypot(aside, up))),
        roll: Angle::rad(libm::atan2(-aside, up)),
        drift,
        over_hub: skin.over_hub,
        clearance: skin.clearance,
    }
}

#[cfg(test)]
mod tests;
