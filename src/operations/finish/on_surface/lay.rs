//! One track on a surface: the poses of the disc from where it is clear of the stock on one side to where it is on the other.
//!
//! Over the part they are those of `vcutc_surface::track`. Before the first and after the last the disc goes on straight, as it is held
//! there, until all of its edge is beyond the stock. A track that might enter the part deeper than it may is raised by as much as
//! it might.

use super::entry::{deepest, turns};
use super::way::{Way, pose_of};
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Blade, Joint};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::{LARGEST_KINK, goes_face_first};
use vcutc_geometry::grid;
use vcutc_process::beside::Stand;
use vcutc_process::lower::BLEND;
use vcutc_process::posture::Feed;
use vcutc_surface::disc::{Disc, Pose};
use vcutc_surface::gouge::Moves;
use vcutc_surface::normals::Normals;
use vcutc_surface::posture::{Lean, frame_towards};
use vcutc_surface::section::{Section, Upright};
use vcutc_surface::surface::Surface;
use vcutc_surface::track::{Demand, Layer, NoTrack, Stop};

/// How deep the disc may enter the part between two poses, along z: far below what a scallop is. A judgement, from no source.
pub(crate) const GOUGE: Length = Length::mm(0.02);

/// What entry the moves are laid for: the blend ([`BLEND`]) comes on top, the more the steeper the part is.
const MOVES: Length = Length::mm(0.013);

/// How fast the lead may change along a track.
const RATE: Angle = Angle::deg(0.1);

/// How far poses may be apart, in mm: the first of these with which the way bends by less than a kink from one to the next.
const WIDEST: [f64; 3] = [8.0, 4.0, 2.0];

/// Poses nearer to each other get none between them, in mm.
const FINEST: Length = Length::mm(1.0);

/// The share of the largest kink that a way may bend by from piece to piece: places are rounded.
const BEND: f64 = 0.8;

/// A track.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The x of its contacts, in mm.
    pub x: f64,
    /// Its poses, in turn.
    pub stands: Vec<Stand>,
    /// The same as a way.
    pub way: Way,
    /// Its highest contact, in mm.
    pub highest: Point3,
    /// The pose there.
    pub pose: Pose,
    /// Where the disc touches the part, and how it leans from its normal there, in the order of the way.
    pub leans: Vec<(Point3, Lean)>,
}

/// What a track is to be like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    /// The x of its contacts, in mm.
    pub(super) x: f64,
    pub(super) feed: Feed,
    /// How far the axis leans towards +x.
    pub(super) side: Angle,
    /// The least and the greatest lead.
    pub(super) leads: [Angle; 2],
    /// How far the part may lift the disc off its contacts.
    pub(super) lift: Length,
}

/// How carefully tracks are laid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Care {
    /// Moves between poses are not bounded: enough to see what comes free and what stays.
    Draft,
    /// As they are cut.
    Final,
}

/// Why a track cannot be laid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unlaid {
    /// The disc does not come down to the part, or the part has no height or no slope.
    NoTrack(NoTrack),
    /// The way before or after the part leads below the bottom of the stock.
    Below {
        /// The pose there.
        tip: Point3,
        /// How far below.
        by: Length,
    },
    /// No pose that a program may hold.
    Posture { place: Point3 },
    /// The disc would go down through its own face: the part is so hollow along the track that the disc, which turns up with it, sinks
    /// faster at its heel than its lead keeps that up.
    FaceFirst { place: Point3 },
}

/// Lays tracks.
pub(super) struct Layout<'l, 'd, 's> {
    pub(super) surface: &'s Surface,
    pub(super) moves: &'l Moves<'d, 's>,
    pub(super) normals: &'l Normals<'s>,
    pub(super) blade: &'l Blade,
    pub(super) disc: &'l Disc,
    /// How far beyond the stock a track begins and ends.
    pub(super) run_out: Length,
}

impl Layout<'_, '_, '_> {
    pub(super) fn track(&self, asked: &Asked, care: Care) -> Result<Track, Unlaid> {
        let section = self.section(asked)?;
        // Seen along the feed, +x is to the right of +y and to the left of -y.
        let side = match asked.feed {
            Feed::Forward => Angle::ZERO - asked.side,
            Feed::Backward => asked.side,
        };
        let demand = Demand {
            side,
            least: asked.leads[0],
            most: asked.leads[1],
            rate: RATE,
            lift: asked.lift,
            gouge: match care {
                Care::Draft => self.disc.radius(),
                Care::Final => MOVES,
            },
            widest: Length::mm(widest(&section)),
            finest: FINEST,
            beyond: Length::ZERO,
        };
        let layer = Layer {
            moves: self.moves,
            normals: self.normals,
            disc: self.disc,
        };
        let track = layer.track(&section, &demand).map_err(Unlaid::NoTrack)?;
        self.finished(asked, &track.stops, care)
    }

    fn section(&self, asked: &Asked) -> Result<Section, Unlaid> {
        let (heading, offset) = match asked.feed {
            Feed::Forward => (Angle::deg(90.0), -asked.x),
            Feed::Backward => (Angle::deg(-90.0), asked.x),
        };
        let section = self.surface.section_by(Upright::new(heading, Length::mm(offset)));
        let place = Point3::new(asked.x, 0.0, 0.0);
        section
            .ok()
            .flatten()
            .ok_or(Unlaid::NoTrack(NoTrack::Contact { place }))
    }

    /// The poses with those before and after the part, on the grid, raised by as much as they might enter the part.
    fn finished(&self, asked: &Asked, stops: &[Stop], care: Care) -> Result<Track, Unlaid> {
        let (Some(first), Some(last)) = (stops.first(), stops.last()) else {
            let place = Point3::new(asked.x, 0.0, 0.0);
            return Err(Unlaid::Posture { place });
        };
        let (second, last_but_one) = (
            stops.get(1).unwrap_or(last),
            stops.iter().rev().nth(1).unwrap_or(first),
        );
        let before = self.beyond(asked.feed, [first, second], first, End::Before)?;
        let after = self.beyond(asked.feed, [last_but_one, last], last, End::After)?;
        let within = stops.iter().map(|stop| stop.placed.pose());
        let poses = core::iter::once(before).chain(within).chain([after]);
        let mut held: Vec<(Point3, Orientation)> = poses
            .map(|pose| {
                let frame = frame_towards(&pose, [0.0, 1.0, 0.0]);
                let tip = pose.centre;
                let tip = Point3::new(grid::nearest(tip.x), grid::nearest(tip.y), grid::up(tip.z));
                frame
                    .map(|frame| (tip, frame.orientation))
                    .ok_or(Unlaid::Posture { place: tip })
            })
            .collect::<Result<_, _>>()?;
        let posture = Unlaid::Posture { place: first.contact };
        if care == Care::Final {
            let poses = as_poses(&held).ok_or(posture)?;
            let orientations: Vec<Orientation> = held.iter().map(|(_, orientation)| *orientation).collect();
            let turns = turns(&orientations);
            let entry = deepest(self.moves, self.disc, &poses, &turns, [MOVES, BLEND]).ok_or(posture)?;
            if entry.depth > GOUGE {
                for (tip, _) in &mut held {
                    tip.z = grid::up(tip.z + entry.depth.to_mm());
                }
            }
        }
        let moves = held.windows(2).map(|pair| <[_; 2]>::try_from(pair).ok());
        if let Some(number) = moves
            .into_iter()
            .position(|pair| pair.is_some_and(goes_face_first))
        {
            // The first pose is that before the part.
            let stop = number.checked_sub(1).and_then(|number| stops.get(number));
            let place = stop.unwrap_or(first).contact;
            return Err(Unlaid::FaceFirst { place });
        }
        let way = as_poses(&held).and_then(Way::new).ok_or(posture)?;
        let ends = [held.first(), held.last()].into_iter().flatten();
        for (tip, orientation) in ends {
            let low = tip.z - self.blade.extent([*orientation; 2]).down;
            if low < 0.0 {
                let by = Length::mm(-low);
                return Err(Unlaid::Below { tip: *tip, by });
            }
        }
        let highest = stops
            .iter()
            .max_by(|a, b| a.contact.z.total_cmp(&b.contact.z))
            .unwrap_or(first);
        Ok(Track {
            x: asked.x,
            stands: stands(&held),
            way,
            highest: highest.contact,
            pose: highest.placed.pose(),
            leans: stops.iter().map(|stop| (stop.contact, stop.lean)).collect(),
        })
    }

    /// The disc straight before its first pose over the part, or straight after its last one, as far as its edge is clear of the stock:
    /// on the line of the first or the last move, so that the way does not bend there.
    fn beyond(&self, feed: Feed, line: [&Stop; 2], stop: &Stop, end: End) -> Result<Pose, Unlaid> {
        let pose = stop.placed.pose();
        let refused = Unlaid::Posture { place: stop.contact };
        let held = frame_towards(&pose, [0.0, 1.0, 0.0]).ok_or(refused)?;
        let [near, far] = self.blade.extent([held.orientation; 2]).y;
        let depth = self.surface.plan().depth.to_mm();
        let [from, to] = line.map(|stop| stop.placed.pose().centre.to_array());
        let along = feed.along(to[1] - from[1]);
        if along <= 0.0 {
            return Err(refused);
        }
        let way: [f64; 3] = core::array::from_fn(|i| (to[i] - from[i]) / along);
        // How far along y the edge has to go, to the side on which it leaves the stock.
        let is_far_side = matches!(
            (feed, end),
            (Feed::Forward, End::After) | (Feed::Backward, End::Before)
        );
        let out = if is_far_side {
            depth - (pose.centre.y + near)
        } else {
            pose.centre.y + far
        };
        let out = (out + self.run_out.to_mm()).max(self.run_out.to_mm());
        let scale = match end {
            End::Before => -out,
            End::After => out,
        };
        let from = pose.centre.to_array();
        let centre: [f64; 3] = core::array::from_fn(|i| from[i] + scale * way[i]);
        Ok(Pose {
            centre: centre.into(),
            ..pose
        })
    }
}

/// An end of a track.
#[derive(Clone, Copy)]
enum End {
    Before,
    After,
}

fn as_poses(held: &[(Point3, Orientation)]) -> Option<Vec<Pose>> {
    held.iter().map(|(tip, held)| pose_of(*tip, *held)).collect()
}

/// How far poses may lie apart so that the way bends little from one to the next; the narrowest but one where the part has an edge
/// across the track, at which the disc stops anyhow.
fn widest(section: &Section) -> f64 {
    let (from, to) = section.profile.span();
    let bends = |apart: f64| {
        let count = ((to - from) / apart).floor().max(0.0) as u32;
        let height = |k: u32| section.profile.height((from + apart * f64::from(k)).min(to));
        (1..count).any(|k| {
            let bend = (height(k + 1) - 2.0 * height(k) + height(k - 1)) / apart;
            bend.abs() > BEND * LARGEST_KINK.to_rad()
        })
    };
    WIDEST.into_iter().find(|apart| !bends(*apart)).unwrap_or(4.0)
}

/// The poses as stands: with a stop at the end, and where the way bends by more than a chain may.
fn stands(held: &[(Point3, Orientation)]) -> Vec<Stand> {
    let way = |from: usize, to: usize| -> Option<[f64; 3]> {
        let (a, b) = (held.get(from)?.0.to_array(), held.get(to)?.0.to_array());
        let along: [f64; 3] = core::array::from_fn(|i| b[i] - a[i]);
        let long = along.iter().map(|part| part * part).sum::<f64>().sqrt();
        Some(along.map(|part| part / long))
    };
    let joint = |number: usize| {
        let before = number.checked_sub(1).and_then(|before| way(before, number));
        let (Some(before), Some(after)) = (before, way(number, number + 1)) else {
            return Joint::Stop;
        };
        let apart: f64 = before.iter().zip(after).map(|(a, b)| (a - b) * (a - b)).sum();
        if apart.sqrt() < 0.98 * LARGEST_KINK.to_rad() {
            Joint::Through
        } else {
            Joint::Stop
        }
    };
    let numbered = held.iter().enumerate();
    numbered
        .map(|(number, (tip, held))| Stand {
            tip: *tip,
            held: *held,
            joint: joint(number),
        })
        .collect()
}
