//! The least lead at which a disc comes to rest on a surface with its contact.
//!
//! A disc that stands at a contact as its [posture](crate::posture) says may enter the surface elsewhere. The exact drop puts it
//! where it clears all triangles; what that lifts it by stays uncut at the contact. A larger lead turns the disc up about
//! the line across the feed through the contact. So what was clear of it stays clear, unless the surface is so steep there
//! that it faces the turning face, more than 90 degrees less the lead against the tangent plane: the search takes the lift to fall
//! as the lead grows. Its answer is a drop in any case, so that a disc put there enters nothing.

use crate::disc::{Axis, Pose};
use crate::drop::{Dropper, Rest};
use crate::posture::{Contact, Lean};
use core::fmt;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::cone::clearance;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

/// The first step of the search, in rad. Each further one is twice as wide.
const FIRST_STEP: f64 = 0.004;

/// Leads nearer to each other, in rad, are the same: 0.001 degrees.
const FINEST: f64 = 1.7e-5;

/// What is asked of a disc at a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// Of the edge.
    pub radius: Length,
    /// How far the axis leans about the feed, to its left.
    pub side: Angle,
    /// The least lead.
    pub least: Angle,
    /// The greatest one.
    pub most: Angle,
    /// How far the surface may lift the disc off its contact.
    pub lift: Length,
}

/// A disc that rests on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// How it leans.
    pub lean: Lean,
    /// Where its face lies: clear of the surface.
    pub pose: Pose,
    /// How far it was lifted off its contact.
    pub lift: Length,
    /// Where it touches the surface.
    pub touch: Option<Point3>,
}

/// No lead brings the disc down to its contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoLead {
    /// The least and the greatest lead make no range, or the axis does not point up.
    Range,
    /// The greatest lead does not, either.
    Lifted {
        /// What happens there.
        standing: Standing,
    },
}

impl fmt::Display for NoLead {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range => write!(f, "there is no lead to choose from"),
            Self::Lifted { standing } => write!(
                f,
                "with a lead of {:.2} deg the part lifts the disc by {:.4} mm",
                standing.lean.lead.to_deg(),
                standing.lift.to_mm()
            ),
        }
    }
}

impl core::error::Error for NoLead {}

/// Lets a disc that leans so come down over its contact. None if its axis does not point up.
///
/// A disc over nothing stays where the contact says.
#[must_use]
pub fn stand(dropper: &Dropper<'_>, contact: &Contact, radius: Length, lean: Lean) -> Option<Standing> {
    let pose = contact.pose(radius, lean)?;
    let Pose { centre, axis } = pose;
    let rest = dropper.face(radius, [centre.x, centre.y], axis);
    Some(standing(centre, axis, lean, rest))
}

fn standing(centre: Point3, axis: Axis, lean: Lean, rest: Option<Rest>) -> Standing {
    let height = rest.map_or(centre.z, |rest| rest.height.to_mm().max(centre.z));
    Standing {
        lean,
        pose: Pose {
            centre: Point3::new(centre.x, centre.y, height),
            axis,
        },
        lift: Length::mm(height - centre.z),
        touch: rest.map(|rest| rest.touch),
    }
}

/// The least lead at which the surface lifts a disc off its contact by no more than is wished, within 0.001 degrees.
///
/// # Errors
/// See [`NoLead`].
pub fn least_lead(dropper: &Dropper<'_>, contact: &Contact, wish: &Wish) -> Result<Standing, NoLead> {
    let (least, most) = (wish.least.to_rad(), wish.most.to_rad());
    // Also refuses what is not a number.
    if !(least <= most && least.is_finite() && most.is_finite()) {
        return Err(NoLead::Range);
    }
    let at = |lead: f64| {
        let lean = Lean {
            lead: Angle::rad(lead),
            side: wish.side,
        };
        stand(dropper, contact, wish.radius, lean).ok_or(NoLead::Range)
    };
    let is_down = |standing: &Standing| standing.lift.to_mm() <= wish.lift.to_mm();
    let mut found = at(least)?;
    let (mut low, mut step) = (least, FIRST_STEP);
    while !is_down(&found) {
        if found.lean.lead.to_rad() >= most {
            return Err(NoLead::Lifted { standing: found });
        }
        low = found.lean.lead.to_rad();
        found = at((low + step).min(most))?;
        step *= 2.0;
    }
    while found.lean.lead.to_rad() - low > FINEST {
        let middle = at(f64::midpoint(low, found.lean.lead.to_rad()))?;
        if is_down(&middle) {
            found = middle;
        } else {
            low = middle.lean.lead.to_rad();
        }
    }
    Ok(found)
}

/// The least leads that are nowhere below others, and change along the track by no more than a rate, an angle for each mm.
/// `along` says how far along the track each of them is. None if these do not ascend, or the rate is not above 0.
#[must_use]
pub fn smoothed(along: &[Length], leads: &[Angle], rate: Angle) -> Option<Vec<Angle>> {
    if along.len() != leads.len() || rate.to_rad() <= 0.0 || !rate.is_finite() {
        return None;
    }
    let point = |(along, lead): (&Length, &Angle)| Point2::new(along.to_mm(), lead.to_rad());
    let profile = Profile::new(along.iter().zip(leads).map(point).collect()).ok()?;
    let smooth = clearance(&profile, rate.to_rad());
    // Rounding does not lower a lead.
    let above = |(along, lead): (&Length, &Angle)| Angle::rad(smooth.height(along.to_mm())).max(*lead);
    Some(along.iter().zip(leads).map(above).collect())
}

#[cfg(test)]
mod tests;
