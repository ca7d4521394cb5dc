//! Tracks of a disc along a section of a surface.
//!
//! 1. Along a section the disc is to touch at places no farther apart than wished ([Yang fig. 4]).
//! 2. At each it gets the least lead at which it comes down to its contact ([`crate::lead`]); along the track leads are raised so
//!    that they change no faster than a rate.
//! 3. There it comes down on the surface, with its body. So no pose enters the part.
//! 4. Between poses the depth of entry is bounded ([`crate::gouge`]); where that is above the limit, another pose is put in between,
//!    and all is done again for it, until poses are as near to each other as they may be.
//!
//! Beyond the plan a track goes straight on, along the surface at its side.

use crate::disc::{Axis, Disc};
use crate::gouge::{Entry, Moves, Placed};
use crate::lead::{NoLead, Wish, least_lead, smoothed};
use crate::normals::Normals;
use crate::posture::{Contact, Lean};
use crate::section::Section;
use core::fmt;
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::units::{Angle, Length};

/// The most poses of a track.
const MOST_POSES: usize = 100_000;

/// Axes that differ by less, in rad, are not turned in more steps: 0.1 degrees.
const LEAST_TURN: f64 = 0.001_75;

/// Places nearer to each other, in mm, get none between them at all.
const LEAST_STEP: f64 = 1e-4;

/// What is asked of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// How far the axis leans about the feed, to its left.
    pub side: Angle,
    /// The least lead, above 0.
    pub least: Angle,
    /// The greatest one.
    pub most: Angle,
    /// How fast leads may change, an angle for each mm of the track.
    pub rate: Angle,
    /// How far the part may lift the disc off a contact for the sake of a smaller lead.
    pub lift: Length,
    /// How deep the disc may enter the part between two poses, along z.
    pub gouge: Length,
    /// How far contacts may lie apart, in plan.
    pub widest: Length,
    /// Contacts nearer to each other get no further pose between them, but where the disc turns over an edge of the part.
    pub finest: Length,
    /// How far contacts go on beyond the plan, before the first place of the section and after the last one, in plan. A disc is past the
    /// side of the plan after its radius.
    pub beyond: Length,
}

/// A pose of a track.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Where along the section, in plan.
    pub along: Length,
    /// The place of the surface that the disc was to touch.
    pub contact: Point3,
    /// How the disc leans.
    pub lean: Lean,
    /// How far the surface lifts it off its contact: more than wished where its body meets the surface, or where smooth leads do not
    /// suit it.
    pub lift: Length,
    /// Where it is.
    pub placed: Placed,
    /// The frame of the tool there, with x to the contact: what turns from one pose to the next.
    pub frame: Frame,
}

/// A track along a section.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The poses in the order of the section.
    pub stops: Vec<Stop>,
    /// How deep the disc may enter the part between two of them, at most. Above what was asked for where poses are as near to each
    /// other as they may be: raised by that, the track enters nothing.
    pub entry: Length,
    /// Where along the section the first of these two is.
    pub deepest: Length,
    /// The steepest slope under the disc, as height for length. What else deviates from the way counts `sqrt(1 + slope^2)` times.
    pub slope: f64,
}

/// Why there is no track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoTrack {
    /// Lengths that are not above 0, or a finest one above the widest.
    Demand,
    /// No lead within the limits lets the disc down to its contact.
    Lead {
        /// The contact.
        contact: Point3,
        /// The greatest lead.
        lead: Angle,
        /// How far the surface lifts the disc there.
        lift: Length,
    },
    /// The leads make no range, or the axis of the disc does not point up.
    Posture {
        /// The contact.
        contact: Point3,
    },
    /// The surface has no normal.
    Contact {
        /// Where.
        place: Point3,
    },
    /// More than 100 000 poses.
    TooLong,
}

impl fmt::Display for NoTrack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Demand => write!(f, "the distances of poses make no range above 0 mm"),
            Self::Lead { contact, lead, lift } => write!(
                f,
                "at ({:.3}, {:.3}) the part lifts the disc by {:.4} mm even with a lead of {:.2} deg",
                contact.x,
                contact.y,
                lift.to_mm(),
                lead.to_deg()
            ),
            Self::Posture { contact } => {
                write!(
                    f,
                    "at ({:.3}, {:.3}) no lead has an axis that points up",
                    contact.x, contact.y
                )
            }
            Self::Contact { place } => write!(
                f,
                "the surface stands upright at ({:.3}, {:.3})",
                place.x, place.y
            ),
            Self::TooLong => write!(f, "the track takes more than {MOST_POSES} poses"),
        }
    }
}

impl core::error::Error for NoTrack {}

/// A place of a track, before leads are smooth.
#[derive(Clone, Copy, Debug)]
struct Place {
    along: f64,
    contact: Contact,
    /// The least lead at which the disc comes down to it.
    lead: Angle,
}

/// A pose, and the bound of the move to the next one if it is known.
#[derive(Clone, Debug)]
struct Stood {
    stop: Stop,
    next: Option<Entry>,
}

/// A track of bounded moves.
fn finished(stops: Vec<Stood>) -> Track {
    let mut track = Track {
        entry: Length::ZERO,
        deepest: stops.first().map_or(Length::ZERO, |first| first.stop.along),
        slope: 0.0,
        stops: Vec::with_capacity(stops.len()),
    };
    for Stood { stop, next } in stops {
        if let Some(entry) = next {
            track.slope = track.slope.max(entry.slope);
            if entry.depth > track.entry {
                track.entry = entry.depth;
                track.deepest = stop.along;
            }
        }
        track.stops.push(stop);
    }
    track
}

/// Lays tracks of a disc over a surface.
#[derive(Clone, Copy, Debug)]
pub struct Layer<'a, 'd, 's> {
    /// The surface with its slopes.
    pub moves: &'a Moves<'d, 's>,
    /// Its normals.
    pub normals: &'a Normals<'s>,
    /// The disc.
    pub disc: &'a Disc,
}

impl Layer<'_, '_, '_> {
    /// The track along a section.
    ///
    /// # Errors
    /// See [`NoTrack`].
    pub fn track(&self, section: &Section, demand: &Demand) -> Result<Track, NoTrack> {
        let (finest, widest) = (demand.finest.to_mm(), demand.widest.to_mm());
        // Also refuses what is not a number.
        if !(finest > 0.0 && finest <= widest && widest.is_finite() && demand.gouge.to_mm() > 0.0) {
            return Err(NoTrack::Demand);
        }
        let beyond = demand.beyond.to_mm();
        if !(beyond >= 0.0 && beyond.is_finite()) {
            return Err(NoTrack::Demand);
        }
        let (from, to) = section.profile.span();
        let (from, to) = (from - beyond, to + beyond);
        let count = ((to - from) / widest).ceil().max(1.0);
        if count >= MOST_POSES as f64 {
            return Err(NoTrack::TooLong);
        }
        let at = |k: u32| from + (to - from) * (f64::from(k) / count);
        let places = (0..=count as u32).map(|k| self.place(section, at(k), demand));
        let mut places: Vec<Place> = places.collect::<Result<_, _>>()?;
        let mut stops: Vec<Stood> = Vec::new();
        // Each round halves distances, so that there are few.
        loop {
            stops = self.stops(&places, &stops, demand)?;
            self.prove(&mut stops, demand);
            let between = self.between(section, &places, &stops, demand)?;
            if between.is_empty() {
                return Ok(finished(stops));
            }
            if places.len() + between.len() > MOST_POSES {
                return Err(NoTrack::TooLong);
            }
            places.extend(between);
            places.sort_by(|a, b| a.along.total_cmp(&b.along));
        }
    }

    /// Bounds the moves that are not bounded yet.
    fn prove(&self, stops: &mut [Stood], demand: &Demand) {
        for place in 1..stops.len() {
            if let [from, to] = &mut stops[place - 1..=place]
                && from.next.is_none()
            {
                let angle = from.stop.frame.orientation.angle_to(to.stop.frame.orientation);
                let ends = [&from.stop.placed, &to.stop.placed];
                from.next = Some(self.moves.between(self.disc, ends, angle, demand.gouge));
            }
        }
    }

    /// Places between poses where the disc may enter too deep.
    fn between(
        &self,
        section: &Section,
        places: &[Place],
        stops: &[Stood],
        demand: &Demand,
    ) -> Result<Vec<Place>, NoTrack> {
        let mut between = Vec::new();
        for (pair, stood) in places.windows(2).zip(stops.windows(2)) {
            let [a, b] = [pair[0], pair[1]];
            if stood[0].next.is_none_or(|entry| entry.depth <= demand.gouge) {
                continue;
            }
            let middle = f64::midpoint(a.along, b.along);
            let [from, to] = [0, 1].map(|end| stood[end].stop.placed.pose().axis);
            if b.along - a.along >= 2.0 * demand.finest.to_mm() {
                between.push(self.place(section, middle, demand)?);
            } else if from.angle_to(to).to_rad() > LEAST_TURN && b.along - a.along > LEAST_STEP {
                // Over an edge of the part the disc turns nearly in place.
                let normal = core::array::from_fn(|i| a.contact.normal()[i] + b.contact.normal()[i]);
                between.push(self.at(section, middle, Some(normal), demand)?);
            }
        }
        Ok(between)
    }

    fn place(&self, section: &Section, along: f64, demand: &Demand) -> Result<Place, NoTrack> {
        let place = section.point(along);
        self.at(section, along, self.normals.at([place.x, place.y]), demand)
    }

    fn at(
        &self,
        section: &Section,
        along: f64,
        normal: Option<[f64; 3]>,
        demand: &Demand,
    ) -> Result<Place, NoTrack> {
        let place = section.point(along);
        let contact = normal.and_then(|normal| Contact::new(place, normal, section.plane.heading()));
        let mut contact = contact.ok_or(NoTrack::Contact { place })?;
        let (from, to) = section.profile.span();
        let past = along - along.max(from).min(to);
        if past != 0.0 {
            let feed = contact.feed();
            let far = past / libm::hypot(feed[0], feed[1]);
            let from = place.to_array();
            contact.place = core::array::from_fn(|i| from[i] + far * feed[i]).into();
        }
        let wish = Wish {
            radius: self.disc.radius(),
            side: demand.side,
            least: demand.least,
            most: demand.most,
            lift: demand.lift,
        };
        let found = least_lead(self.moves.dropper(), &contact, &wish).map_err(|reason| match reason {
            NoLead::Range => NoTrack::Posture { contact: place },
            NoLead::Lifted { standing } => NoTrack::Lead {
                contact: place,
                lead: standing.lean.lead,
                lift: standing.lift,
            },
        })?;
        Ok(Place {
            along,
            contact,
            lead: found.lean.lead,
        })
    }

    /// The poses at all places, with smooth leads. What stays as it was in an earlier round is kept.
    fn stops(&self, places: &[Place], before: &[Stood], demand: &Demand) -> Result<Vec<Stood>, NoTrack> {
        let along: Vec<Length> = places.iter().map(|place| Length::mm(place.along)).collect();
        let leads: Vec<Angle> = places.iter().map(|place| place.lead).collect();
        let leads = smoothed(&along, &leads, demand.rate).ok_or(NoTrack::Demand)?;
        let mut known = before.iter().peekable();
        let mut stops: Vec<Stood> = Vec::with_capacity(places.len());
        // Whether the last one is as it was, and was followed by the next of those before.
        let mut is_followed = false;
        for ((place, along), lead) in places.iter().zip(along).zip(leads) {
            let lean = Lean {
                lead,
                side: demand.side,
            };
            let same = known.next_if(|stood| stood.stop.along == along);
            let kept = same.filter(|stood| stood.stop.lean == lean);
            if let Some(last) = stops.last_mut().filter(|_| !is_followed || kept.is_none()) {
                last.next = None;
            }
            is_followed = kept.is_some();
            stops.push(match kept {
                Some(stood) => stood.clone(),
                None => Stood {
                    stop: self.stop(place, lean)?,
                    next: None,
                },
            });
        }
        Ok(stops)
    }

    /// The disc on the surface, with its body.
    fn stop(&self, place: &Place, lean: Lean) -> Result<Stop, NoTrack> {
        let contact = place.contact.place;
        let refused = NoTrack::Posture { contact };
        let mut pose = place.contact.pose(self.disc.radius(), lean).ok_or(refused)?;
        let wanted = pose.centre.z;
        let rest = self.rest([pose.centre.x, pose.centre.y], pose.axis);
        pose.centre.z = rest.map_or(wanted, |height| height.max(wanted));
        Ok(Stop {
            along: Length::mm(place.along),
            contact,
            lean,
            lift: Length::mm(pose.centre.z - wanted),
            frame: place.contact.frame(&pose).ok_or(refused)?,
            placed: self.moves.place(self.disc, pose).ok_or(refused)?,
        })
    }

    fn rest(&self, place: [f64; 2], axis: Axis) -> Option<f64> {
        let rest = self.moves.dropper().disc(self.disc, place, axis)?;
        Some(rest.height.to_mm())
    }
}

#[cfg(test)]
mod tests;
