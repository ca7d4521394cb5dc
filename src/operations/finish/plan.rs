//! The plan of finishing: tracks along y, one beside the other, on each of which the disc stands on the part.
//!
//! On a track the disc is rolled to the slope of the part there and leans along its feed. It is let down until its rim touches
//! the part with its allowance, so no track enters it (exact, `simulation::cross_section::Guard`). What tracks leave, and whether
//! all strips come free, is not computed by formulas but by passing them through the section of the work as it is
//! (`CrossSection::skim`).
//!
//! More lead makes the rim rise more at its ends, so that strips come free between grooves that end higher; and it makes the rim more
//! pointed, so that more tracks are needed for the same scallop, `R / sin(lead)` being the radius under the disc. So the least lead
//! with which everything comes free has the fewest tracks, and is taken.

use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::Auto;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::cross_section::{CrossSection, Guard};
use vcutc_simulation::disc::{Disc, PassFault, SkinPass};
use vcutc_simulation::rim::Rim;
use vcutc_simulation::surface::Surface;

/// Most tracks that are planned.
pub const MOST_TRACKS: usize = 20_000;

/// By how much the lead grows from one that is tried to the next, in degrees.
const LEAD_STEP: f64 = 0.5;

/// How often tracks are put closer to keep the limit on scallop, each time by a twentieth.
const TRIES: usize = 60;

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
    pub relief: Angle,
    pub steepest: Angle,
    pub over_hub: Length,
    pub clearance: Length,
    pub scallop: Length,
}

/// One way of the disc along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Track {
    /// Where it stands on the part, before it is let down, in mm.
    pub contact: Point2,
    /// The centre of its edge.
    pub centre: Point2,
    /// The slope angle of the part there.
    pub roll: Angle,
}

/// Finishing with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedFinish {
    /// In the order in which they are cut.
    pub tracks: Vec<Track>,
    pub lead: Angle,
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
/// Why there is no plan; of several leads that were tried, for the greatest.
pub fn plan(work: Work<'_>, wish: &Wish) -> Result<(PlannedFinish, Surface), Refusal> {
    if work
        .before
        .corners()
        .all(|corner| corner.z <= work.bound.height(corner.x) + 1e-6)
    {
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
fn leads(wish: &Wish) -> Vec<Angle> {
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

fn with_lead(work: Work<'_>, wish: &Wish, lead: Angle) -> Result<(PlannedFinish, Surface), Refusal> {
    let (from, to) = work.part.span();
    let width = to - from;
    let mut count = match wish.step {
        Auto::Given(step) => (width / step.to_mm() - 1e-9).ceil(),
        Auto::Auto => (width / first_step(wish, lead)).ceil(),
    }
    .max(1.0);
    let mut found = Err(Refusal::Nothing);
    for _ in 0..TRIES {
        if count > MOST_TRACKS as f64 {
            return Err(Refusal::TooMany {
                tracks: count as usize,
            });
        }
        let tracks = tracks(work, wish, lead, count as u32);
        found = passed(work, wish, lead, tracks, Length::mm(width / count));
        match (&found, wish.step) {
            (Err(Refusal::Scallop { .. }), Auto::Auto) => count = (count * 1.05).ceil().max(count + 1.0),
            (Ok(_) | Err(_), _) => break,
        }
    }
    found
}

/// The distance of tracks that leave the limit on a plane: `2 sqrt(R^2 - (R - h / sin(lead))^2)`, in mm.
fn first_step(wish: &Wish, lead: Angle) -> f64 {
    let radius = wish.disc.radius.to_mm();
    let rest = (radius - wish.scallop.to_mm() / lead.sin()).max(0.0);
    2.0 * (radius * radius - rest * rest).sqrt()
}

/// So many tracks, from left to right.
fn tracks(work: Work<'_>, wish: &Wish, lead: Angle, count: u32) -> Vec<Track> {
    let guard = Guard::new(work.bound);
    let (from, to) = work.part.span();
    let step = (to - from) / f64::from(count);
    let at = |number: u32| {
        let x = step.mul_add(f64::from(number) + 0.5, from);
        track(work.bound, &guard, wish.disc.radius, lead, [x, step])
    };
    (0..count).map(at).collect()
}

/// The track at an x: rolled to the slope of the part over its step, and let down on the part.
fn track(bound: &Profile, guard: &Guard<'_>, radius: Length, lead: Angle, [x, step]: [f64; 2]) -> Track {
    let (from, to) = bound.span();
    let ends = [(x - step / 2.0).max(from), (x + step / 2.0).min(to)];
    let [left, right] = ends.map(|x| bound.height(x));
    let slope = (right - left) / (ends[1] - ends[0]).max(f64::MIN_POSITIVE);
    let roll = Angle::rad(libm::atan(slope));
    let contact = Point2::new(x, bound.height(x));
    let below = Rim::rolled(Point2::new(0.0, 0.0), radius, lead, roll).touching(slope);
    let centre = Point2::new(contact.x - below.x, contact.z - below.z);
    let lift = guard.deepest(&Rim::rolled(centre, radius, lead, roll));
    let centre = Point2::new(centre.x, centre.z + lift.map_or(0.0, |(_, depth)| depth));
    Track {
        contact,
        centre,
        roll,
    }
}

/// Passes tracks through the work: those over high places first, or from side to side where only that frees all strips.
fn passed(
    work: Work<'_>,
    wish: &Wish,
    lead: Angle,
    tracks: Vec<Track>,
    step: Length,
) -> Result<(PlannedFinish, Surface), Refusal> {
    let mut descending = tracks.clone();
    descending.sort_by(|a, b| b.contact.z.total_cmp(&a.contact.z));
    let backwards: Vec<Track> = tracks.iter().rev().copied().collect();
    let mut refusal = Refusal::Nothing;
    for tracks in [descending, tracks, backwards] {
        match in_order(work, wish, lead, tracks, step) {
            Err(why @ Refusal::Fault { .. }) => refusal = why,
            other => return other,
        }
    }
    Err(refusal)
}

fn in_order(
    work: Work<'_>,
    wish: &Wish,
    lead: Angle,
    tracks: Vec<Track>,
    step: Length,
) -> Result<(PlannedFinish, Surface), Refusal> {
    let mut section = CrossSection::new(work.before.clone());
    for &track in &tracks {
        let pass = SkinPass {
            centre: track.centre,
            lead,
            roll: track.roll,
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
    let planned = PlannedFinish { tracks, lead, step };
    Ok((planned, surface))
}
