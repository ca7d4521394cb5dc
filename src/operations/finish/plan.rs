//! The plan of finishing: tracks along y, one beside the other, on each of which the disc stands on the part.
//!
//! On a track the disc is rolled to the slope of the part there and leans along its feed, and if need be to the side that tracks
//! step to (`tracks`). It is let down until its rim touches the part with its allowance, so no track enters it (exact,
//! `simulation::cross_section::Guard`). What tracks leave, and whether all strips come free, is not computed by formulas but by
//! passing them through the section of the work as it is (`CrossSection::skim`).
//!
//! More lead makes the rim rise more at its ends, so that strips come free between grooves that end higher; and it makes the rim more
//! pointed, so that more tracks are needed for the same scallop, `R / sin(lead)` being the radius under the disc. So the least lead
//! with which everything comes free has the fewest tracks, and is taken. A disc without side tilt takes its strips over the hub. Where
//! they are too thick for that it leans to the side, so that they pass the hub; the rim is then lower on that side.

pub mod model;
pub(crate) mod order;
pub(crate) mod tracks;

use crate::asked::Sequence;
use tracks::{Hold, Tilt, least_tilted};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::Auto;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::cross_section::{CrossSection, Guard};
use vcutc_simulation::disc::{Disc, PassFault, SkinPass};
use vcutc_simulation::rim::Drift;
use vcutc_simulation::surface::Surface;

/// Most tracks that are planned.
pub const MOST_TRACKS: usize = 20_000;

/// By how much the lead grows from one that is tried to the next, in degrees.
pub(crate) const LEAD_STEP: f64 = 0.5;

/// How often tracks are put closer to keep the limit on scallop, each time by a twentieth.
pub(crate) const TRIES: usize = 60;

/// What is to be finished.
#[derive(Clone, Copy, Debug)]
pub struct Work<'w> {
    pub part: &'w Profile,
    /// The part with its allowance.
    pub bound: &'w Profile,
    /// What the operations before have left.
    pub before: &'w Surface,
}

/// What is asked of the plan.
#[derive(Clone, Debug)]
pub struct Wish {
    pub disc: Disc,
    pub step: Auto<Length>,
    pub lead: Auto<Angle>,
    pub side: Auto<Angle>,
    pub sequence: Auto<Sequence>,
    pub relief: Angle,
    pub steepest: Angle,
    pub over_hub: Length,
    pub clearance: Length,
    pub scallop: Length,
}

/// One way of the disc along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Track {
    /// Where it stands on the part with its allowance, in mm.
    pub contact: Point2,
    /// The centre of its edge.
    pub centre: Point2,
    /// By how much the axis leans towards -x, seen along the feed.
    pub roll: Angle,
}

/// Finishing with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedFinish {
    /// In the order in which they are cut.
    pub tracks: Vec<Track>,
    pub lead: Angle,
    /// How far the axis leans to the side that tracks step to.
    pub side: Angle,
    pub sequence: Sequence,
    /// Distance of tracks over x.
    pub step: Length,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Nothing stands above the part.
    Nothing,
    /// It would take too many tracks.
    TooMany { tracks: usize },
    /// More than the limit would stay on the part.
    Scallop { left: Length },
    /// A pass is not possible.
    Fault {
        /// With this lead.
        lead: Angle,
        track: Track,
        fault: PassFault,
    },
}

/// Plans the tracks, and gives what they leave.
///
/// # Errors
/// Why there is no plan; where several leads were tried, what is wrong with the greatest.
pub fn plan(work: Work<'_>, wish: &Wish) -> Result<(PlannedFinish, Surface), Refusal> {
    let mut corners = work.before.corners();
    if corners.all(|corner| corner.z <= work.bound.height(corner.x) + 1e-6) {
        return Err(Refusal::Nothing);
    }
    let mut refusal = Refusal::Nothing;
    for lead in leads(wish) {
        match with_lead(work, wish, lead) {
            Ok(planned) => return Ok(planned),
            Err(why) => refusal = why,
        }
    }
    Err(refusal)
}

/// The leads to try, from the least on.
pub(crate) fn leads(wish: &Wish) -> Vec<Angle> {
    match wish.lead {
        Auto::Given(lead) => vec![lead],
        Auto::Auto => {
            let (least, most) = (wish.relief.to_deg(), wish.steepest.to_deg());
            let count = ((most - least) / LEAD_STEP).floor().max(0.0) as u32;
            let steps = (0..=count).map(|step| LEAD_STEP.mul_add(f64::from(step), least));
            steps.map(Angle::deg).collect()
        }
    }
}

/// With a lead, and without side tilt where strips may run over the hub.
fn with_lead(work: Work<'_>, wish: &Wish, lead: Angle) -> Result<(PlannedFinish, Surface), Refusal> {
    least_tilted(wish.side, |tilt| with_tilt(work, wish, lead, tilt), is_over_body)
}

fn is_over_body(refusal: &Refusal) -> bool {
    matches!(
        refusal,
        Refusal::Fault {
            fault: PassFault::OverBody { .. },
            ..
        }
    )
}

/// As many tracks as the limit on scallop asks for.
fn with_tilt(
    work: Work<'_>,
    wish: &Wish,
    lead: Angle,
    tilt: Tilt,
) -> Result<(PlannedFinish, Surface), Refusal> {
    let (from, to) = work.part.span();
    let width = to - from;
    let mut count = match wish.step {
        Auto::Given(step) => (width / step.to_mm() - 1e-9).ceil(),
        Auto::Auto => (width / tracks::first_step(wish, lead, tilt)).ceil(),
    }
    .max(1.0);
    let mut found = Err(Refusal::Nothing);
    for _ in 0..TRIES {
        if count > MOST_TRACKS as f64 {
            return Err(Refusal::TooMany {
                tracks: count as usize,
            });
        }
        found = passed(work, wish, lead, tilt, count as u32);
        match (&found, wish.step) {
            (Err(Refusal::Scallop { .. }), Auto::Auto) => count = (count * 1.05).ceil().max(count + 1.0),
            (Ok(_) | Err(_), _) => break,
        }
    }
    found
}

/// So many tracks in the first order in which all strips come free.
fn passed(
    work: Work<'_>,
    wish: &Wish,
    lead: Angle,
    tilt: Tilt,
    count: u32,
) -> Result<(PlannedFinish, Surface), Refusal> {
    let sequences = match wish.sequence {
        Auto::Given(sequence) => vec![sequence],
        Auto::Auto => Sequence::WORDS.iter().map(|(_, sequence)| *sequence).collect(),
    };
    let guard = Guard::new(work.bound);
    let (from, to) = work.part.span();
    let step = Length::mm((to - from) / f64::from(count));
    let side = tracks::side(work, wish, lead, tilt, step);
    let hold = Hold { lead, side };
    let mut refusal = None;
    for sequence in sequences {
        let planned = PlannedFinish {
            tracks: tracks::laid(work, &guard, wish, hold, sequence, count),
            lead,
            side,
            sequence,
            step,
        };
        match simulated(work, wish, &planned) {
            Ok(after) => return Ok((planned, after)),
            Err(why @ Refusal::Fault { .. }) => refusal = Some(why),
            Err(why) => return Err(why),
        }
    }
    Err(refusal.unwrap_or(Refusal::Nothing))
}

/// What tracks leave, if all strips come free and no more than the limit stays.
fn simulated(work: Work<'_>, wish: &Wish, planned: &PlannedFinish) -> Result<Surface, Refusal> {
    let mut section = CrossSection::new(work.before.clone());
    let lead = planned.lead;
    for &track in &planned.tracks {
        let pass = SkinPass {
            centre: track.centre,
            contact: track.contact.x,
            lead,
            roll: track.roll,
            drift: Drift::NONE,
            over_hub: wish.over_hub,
            clearance: wish.clearance,
        };
        if let Some(&fault) = section.skim(&wish.disc, &pass).faults.first() {
            return Err(Refusal::Fault { lead, track, fault });
        }
    }
    let surface = section.into_surface();
    let corners: Vec<Point2> = surface.corners().collect();
    let left = farthest(&corners, work.part).height;
    if left > wish.scallop {
        return Err(Refusal::Scallop { left });
    }
    Ok(surface)
}
