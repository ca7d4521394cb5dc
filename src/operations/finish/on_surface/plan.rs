//! The plan of tracks on a surface.
//!
//! Each track has a lead of its own at each place: the least one with which the disc comes down to the part there, not below that of the
//! plan. What tracks leave, and whether strips come free, is found in sections across them ([`super::sections`]).
//! As on profiles the least lead with which everything comes free is taken, and tracks are put closer until no more stays than
//! may. The first step is that which leaves the limit where the part asks for the least, by its curvature and slope across.

use super::entry::solid;
use super::lay::{Asked, Care, GOUGE, Layout, Track, Unlaid};
use super::sections::{Fault, Left, Sections};
use super::way::Way;
use crate::asked::{AIR, FinishDisc, Sequence};
use crate::plan::model;
use crate::plan::order::{Run, runs};
use crate::plan::tracks::{Tilt, clear_of_hub, least_tilted, past_hub};
use crate::plan::{LEAD_STEP, MOST_TRACKS, TRIES, Wish, leads};
use core::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::Blade;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::profile::Profile;
use vcutc_job::operation::Ground;
use vcutc_job::{Auto, BladeRef, Direction};
use vcutc_process::lower::BLEND;
use vcutc_process::posture::Feed;
use vcutc_simulation::disc::{Disc, PassFault};
use vcutc_simulation::prove::{Skin, Tracks};
use vcutc_simulation::surface::{Side, Surface as Stock};
use vcutc_surface::drop::Dropper;
use vcutc_surface::gouge::Moves;
use vcutc_surface::normals::Normals;
use vcutc_surface::scallop::widest_step;
use vcutc_surface::surface::Surface;

/// Over what length slopes and curvatures across count for the first step, in mm.
const LOOKED_OVER: f64 = 10.0;

/// What share of the limit on the scallop the part may lift the disc off a contact by, for the sake of a smaller lead.
const LIFTED: f64 = 0.25;

/// Most poses of all tracks, so that planning ends: some days of cutting.
const MOST_POSES: usize = 4_000_000;

/// Tracks with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedTracks {
    /// In the order in which they are cut.
    pub tracks: Vec<Track>,
    /// The least lead.
    pub lead: Angle,
    /// How far the axis leans to the side that tracks step to.
    pub side: Angle,
    pub sequence: Sequence,
    /// Distance of tracks over x.
    pub step: Length,
    /// In how many sections they were looked at.
    pub sections: usize,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Tracks on a surface keep no allowance.
    Allowance,
    /// Another operation comes after this one.
    NotLast,
    /// Nothing stands above the part.
    Nothing,
    /// It would take too many tracks, or poses.
    TooMany { tracks: usize },
    /// More than the limit would stay on the part.
    Scallop { left: Left },
    /// A track cannot be laid.
    Unlaid { x: f64, why: Unlaid },
    /// A track is not possible.
    Fault { lead: Angle, x: f64, fault: Fault },
}

/// What an operation is held to.
pub(super) const fn held_to(asked: &FinishDisc) -> Tracks {
    Tracks {
        skin: Skin {
            depth: asked.disc.depth.value,
            width: asked.disc.width.value,
            over_hub: asked.over_hub.value,
            clearance: AIR,
        },
        scallop: asked.limits.scallop.value,
        gouge: GOUGE,
    }
}

/// The longest edge of the straight blades that rough the part.
fn longest_edge(ground: &Ground<'_>) -> Length {
    let blades = ground
        .job
        .operations
        .iter()
        .flat_map(|operation| operation.blades());
    blades.filter_map(BladeRef::edge).fold(Length::ZERO, Length::max)
}

/// Plans the tracks.
///
/// # Errors
/// Why there is no plan; where several leads were tried, what is wrong with the greatest.
pub(super) fn plan(
    asked: &FinishDisc,
    wish: &Wish,
    surface: &Surface,
    ground: &Ground<'_>,
) -> Result<PlannedTracks, Refusal> {
    if asked.allowance.value > Length::ZERO {
        return Err(Refusal::Allowance);
    }
    let last = ground.job.operations.last();
    if last.is_some_and(|last| last.setup().head_span != asked.setup.head_span) {
        return Err(Refusal::NotLast);
    }
    let blade = asked.disc.in_program();
    let dropper = Dropper::new(surface);
    let normals = Normals::new(surface);
    // Checking a job refuses surfaces that are too tangled, or have no height somewhere.
    let spine = ground.job.part.spine().map(|spine| &**spine);
    let spine = spine.map(|spine| (spine, spine.left_above(longest_edge(ground), BLEND)));
    let sections = Sections::of(surface, spine);
    let (Ok(moves), Ok(sections), Some(disc)) = (Moves::new(&dropper), sections, solid(&blade)) else {
        return Err(Refusal::Nothing);
    };
    let planner = Planner {
        wish,
        tracks: held_to(asked),
        direction: asked.setup.direction().value,
        shadow: &ground.job.profile,
        before: &ground.before,
        sections: &sections,
        layout: Layout {
            surface,
            moves: &moves,
            normals: &normals,
            blade: &blade,
            disc: &disc,
            run_out: asked.setup.run_out.value,
        },
        blade: &blade,
        is_wanted: &|| !ground.wanted.is_needless(),
        trials: Cell::new(MOST_TRIALS),
    };
    planner.plan()
}

struct Planner<'p, 'd, 's> {
    wish: &'p Wish,
    tracks: Tracks,
    direction: Direction,
    shadow: &'p Profile,
    before: &'p Stock,
    sections: &'p Sections,
    layout: Layout<'p, 'd, 's>,
    blade: &'p Blade,
    is_wanted: &'p dyn Fn() -> bool,
    /// How often tracks may still be laid.
    trials: Cell<u32>,
}

/// How often all tracks are laid again for a plan at most, which ends a search without success.
const MOST_TRIALS: u32 = 40;

/// How all tracks of a plan are held, and how many there are.
#[derive(Clone, Copy)]
struct Hold {
    lead: Angle,
    side: Angle,
    count: u32,
}

/// Tracks that are laid, by their number from left to right, the side that they step to, and their feed.
type Known = RefCell<BTreeMap<(u32, bool, bool), Track>>;

impl Planner<'_, '_, '_> {
    fn plan(&self) -> Result<PlannedTracks, Refusal> {
        if self.is_finished() {
            return Err(Refusal::Nothing);
        }
        let mut refusal = Refusal::Nothing;
        for lead in leads(self.wish) {
            match self.with_lead(lead) {
                Ok(planned) => return Ok(planned),
                Err(why) => {
                    let is_final = !self.does_more_lead_help(&why) || self.trials.get() == 0;
                    // Where there was no trial any more, the one before says more.
                    if why != Refusal::Nothing {
                        refusal = why;
                    }
                    if is_final || !(self.is_wanted)() {
                        break;
                    }
                }
            }
        }
        Err(refusal)
    }

    /// Whether nothing stands above the part anywhere.
    fn is_finished(&self) -> bool {
        let mut parts = self.sections.parts();
        parts.all(|(_, part)| {
            let mut corners = self.before.corners();
            corners.all(|corner| corner.z <= part.height(corner.x) + 1e-6)
        })
    }

    /// Whether a greater least lead may change something about a refusal.
    fn does_more_lead_help(&self, refusal: &Refusal) -> bool {
        let is_open = self.wish.lead == Auto::Auto && LEAD_STEP > 0.0;
        is_open
            && match refusal {
                Refusal::Fault { fault, .. } => !matches!(
                    fault.fault,
                    PassFault::TooThick { .. } | PassFault::EntersPart { .. }
                ),
                Refusal::Scallop { .. }
                | Refusal::Unlaid {
                    why: Unlaid::FaceFirst { .. },
                    ..
                } => true,
                // All leads up to the limit were open to the track already.
                Refusal::Unlaid { .. }
                | Refusal::Allowance
                | Refusal::NotLast
                | Refusal::Nothing
                | Refusal::TooMany { .. } => false,
            }
    }

    /// With a least lead, and without side tilt where strips may run over the hub.
    fn with_lead(&self, lead: Angle) -> Result<PlannedTracks, Refusal> {
        let is_over_body = |why: &Refusal| matches!(why, Refusal::Fault { fault, .. } if matches!(fault.fault, PassFault::OverBody { .. }));
        least_tilted(self.wish.side, |tilt| self.with_tilt(lead, tilt), is_over_body)
    }

    /// As many tracks as the limit on scallop asks for.
    fn with_tilt(&self, lead: Angle, tilt: Tilt) -> Result<PlannedTracks, Refusal> {
        let (from, to) = self.shadow.span();
        let width = to - from;
        let mut count = match self.wish.step {
            Auto::Given(step) => (width / step.to_mm() - 1e-9).ceil(),
            Auto::Auto => (width / self.first_step(lead, tilt)).ceil(),
        }
        .max(1.0);
        let mut found = Err(Refusal::Nothing);
        for _ in 0..TRIES {
            if self.trials.replace(self.trials.get().saturating_sub(1)) == 0 {
                break;
            }
            if count > MOST_TRACKS as f64 {
                return Err(Refusal::TooMany {
                    tracks: count as usize,
                });
            }
            let side = self.side(lead, tilt, width / count);
            found = self.passed(Hold {
                lead,
                side,
                count: count as u32,
            });
            match (&found, self.wish.step) {
                (Err(Refusal::Scallop { left }), Auto::Auto) if (self.is_wanted)() => {
                    count = closer(count, left.height.to_mm() / self.wish.scallop.to_mm());
                }
                (Ok(_) | Err(_), _) => break,
            }
        }
        found
    }

    /// The step that leaves the limit where the part asks for the least, by curvature and slope across the tracks; no more than the
    /// strips that the disc takes, nor than have room beside its hub.
    fn first_step(&self, lead: Angle, tilt: Tilt) -> f64 {
        let (wish, radius) = (self.wish, self.wish.disc.radius);
        let most = wish
            .disc
            .width
            .map_or(f64::INFINITY, Length::to_mm)
            .min(radius.to_mm());
        let (most, side) = match tilt {
            Tilt::Fixed(side) => (most, side),
            Tilt::PastHub { share } => {
                let room = (radius.to_mm() - clear_of_hub(wish)) / share;
                let most = most.min(room).max(1e-3);
                (most, past_hub(wish, lead, share * most / 2.0).unwrap_or_default())
            }
        };
        let effective = model::effective_radius(radius.to_mm(), lead.to_rad(), side.to_rad());
        let along = |curvature: f64| match side {
            Angle::ZERO => widest_step(radius, lead, curvature, wish.scallop).map_or(most, Length::to_mm),
            _ => model::step(effective, curvature, wish.scallop.to_mm()),
        };
        let steps = self.sections.parts().flat_map(|(_, part)| shapes(part));
        // The step in plan: along the part it is longer where that is steep.
        let least = steps
            .map(|[curvature, long]| along(curvature) / long)
            .fold(most, f64::min);
        least.max(most / 1e3)
    }

    /// The side tilt of tracks so far apart; none where no tilt carries strips past the hub, which the sections then say.
    fn side(&self, lead: Angle, tilt: Tilt, step: f64) -> Angle {
        match tilt {
            Tilt::Fixed(side) => side,
            Tilt::PastHub { share } => {
                let shapes = self.sections.parts().flat_map(|(_, part)| shapes(part));
                let longest = shapes.map(|[_, long]| long).fold(1.0, f64::max);
                past_hub(self.wish, lead, share * step * longest / 2.0).unwrap_or_default()
            }
        }
    }

    /// So many tracks in the first order in which all strips come free.
    fn passed(&self, hold: Hold) -> Result<PlannedTracks, Refusal> {
        let sequences = match self.wish.sequence {
            Auto::Given(sequence) => vec![sequence],
            Auto::Auto => Sequence::WORDS.iter().map(|(_, sequence)| *sequence).collect(),
        };
        let known = Known::default();
        let mut refusal = None;
        for sequence in sequences {
            // Most of the work is in bounding moves, which only those tracks need that are cut.
            let planned = self
                .in_sequence(hold, sequence, &known, Care::Draft)
                .and_then(|_| self.in_sequence(hold, sequence, &Known::default(), Care::Final));
            match planned {
                Ok(planned) => return Ok(planned),
                Err(why @ Refusal::Fault { .. }) => refusal = Some(why),
                Err(why) => return Err(why),
            }
            if !(self.is_wanted)() {
                break;
            }
        }
        Err(refusal.unwrap_or(Refusal::Nothing))
    }

    fn in_sequence(
        &self,
        hold: Hold,
        sequence: Sequence,
        known: &Known,
        care: Care,
    ) -> Result<PlannedTracks, Refusal> {
        let (from, to) = self.shadow.span();
        let step = (to - from) / f64::from(hold.count);
        let at = |number: u32| step.mul_add(f64::from(number) + 0.5, from);
        let mut tracks: Vec<Track> = Vec::new();
        let mut poses = 0;
        for (place, (number, run)) in self.order(sequence, hold.count, &at).into_iter().enumerate() {
            let feed = match self.direction {
                Direction::Forward => Feed::Forward,
                Direction::Backward => Feed::Backward,
                Direction::Alternate if place % 2 == 0 => Feed::Forward,
                Direction::Alternate => Feed::Backward,
            };
            let key = (
                number,
                run.side() == Side::Right && hold.side != Angle::ZERO,
                feed == Feed::Forward,
            );
            let laid = known.borrow().get(&key).cloned();
            let track = match laid {
                Some(track) => track,
                None => {
                    let track = self.laid(hold, run.side(), at(number), feed, care)?;
                    known.borrow_mut().insert(key, track.clone());
                    track
                }
            };
            poses += track.stands.len();
            if poses > MOST_POSES {
                let tracks = hold.count as usize;
                return Err(Refusal::TooMany { tracks });
            }
            tracks.push(track);
        }
        self.judged(hold, sequence, tracks)
    }

    /// Which tracks are cut one after the other, by their number from left to right.
    fn order(&self, sequence: Sequence, count: u32, at: &dyn Fn(u32) -> f64) -> Vec<(u32, Run)> {
        let mut left: Vec<u32> = (0..count).collect();
        let mut order = Vec::with_capacity(left.len());
        for run in runs(self.shadow, sequence) {
            let mut numbers: Vec<u32> = left.extract_if(.., |number| run.covers(at(*number))).collect();
            if run.side() == Side::Left {
                numbers.reverse();
            }
            order.extend(numbers.into_iter().map(|number| (number, run)));
        }
        match sequence {
            Sequence::Descending => order.sort_by(|(a, _), (b, _)| {
                let height = |number: u32| self.shadow.height(at(number));
                height(*b).total_cmp(&height(*a))
            }),
            Sequence::Crests | Sequence::Rightwards | Sequence::Leftwards => {}
        }
        order
    }

    fn laid(&self, hold: Hold, towards: Side, x: f64, feed: Feed, care: Care) -> Result<Track, Refusal> {
        let side = match towards {
            Side::Right => hold.side,
            Side::Left => Angle::ZERO - hold.side,
        };
        let most = match self.wish.lead {
            Auto::Given(lead) => lead,
            Auto::Auto => self.wish.steepest,
        };
        let asked = Asked {
            x,
            feed,
            side,
            leads: [hold.lead, most],
            lift: self.wish.scallop * LIFTED,
        };
        let track = self.layout.track(&asked, care);
        track.map_err(|why| Refusal::Unlaid { x, why })
    }

    /// The tracks, if all strips come free and no more than the limit stays.
    fn judged(&self, hold: Hold, sequence: Sequence, tracks: Vec<Track>) -> Result<PlannedTracks, Refusal> {
        let ways: Vec<&Way> = tracks.iter().map(|track| &track.way).collect();
        let Some(disc) = self.disc() else {
            return Err(Refusal::Nothing);
        };
        let skimmed = self.sections.skim(self.before, &ways, &disc, self.tracks.skin);
        if let Some(&fault) = skimmed.first() {
            let x = tracks.get(fault.track).map_or(fault.centre.x, |track| track.x);
            return Err(Refusal::Fault {
                lead: hold.lead,
                x,
                fault,
            });
        }
        if let Some(&left) = skimmed.most().filter(|left| left.height > self.wish.scallop) {
            return Err(Refusal::Scallop { left });
        }
        let (from, to) = self.shadow.span();
        Ok(PlannedTracks {
            tracks,
            lead: hold.lead,
            side: hold.side,
            sequence,
            step: Length::mm((to - from) / f64::from(hold.count)),
            sections: self.sections.count(),
        })
    }

    fn disc(&self) -> Option<Disc> {
        self.tracks.disc(self.blade)
    }
}

/// So many more tracks where so many times the limit stays: what stays grows with the square of the step.
fn closer(count: f64, over: f64) -> f64 {
    // An excess of many times the limit is not caused by the step alone.
    let factor = if over > 4.0 { 1.05 } else { over.max(1.0).sqrt() };
    (count * factor).floor().max(count + 1.0)
}

/// Curvature of a section, positive where the part is hollow, and how long it is for each mm of x, at places along it.
fn shapes(part: &Profile) -> impl Iterator<Item = [f64; 2]> {
    let (from, to) = part.span();
    let apart = LOOKED_OVER.min((to - from) / 2.0);
    let count = ((to - from) / apart).floor() as u32;
    (1..count).map(move |number| {
        let x = from + apart * f64::from(number);
        let [left, here, right] = [x - apart, x, x + apart].map(|x| part.height(x));
        let slope = (right - left) / (2.0 * apart);
        let long = (1.0 + slope * slope).sqrt();
        let bend = (right - 2.0 * here + left) / (apart * apart);
        [bend / (long * long * long), long]
    })
}
