//! The plan of a pocket: layers, and in each the same passes in the same order.

mod clock;
mod entry;
pub mod helix;
mod hole;
mod lay;
mod limits;
mod order;
pub mod path;
mod room;

use crate::asked::{ClearPocket, Pattern, WayIn};
use crate::refused::{Remedy, Why};
use clock::Clock;
use entry::Ways;
use helix::Helix;
use lay::Laid;
use limits::Standing;
use room::Room;
use vcutc_backend_api::units::{Angle, Area, Duration, Length};
use vcutc_job::Auto;
use vcutc_job::operation::Ground;
use vcutc_job::planned::{PlannedWay, WayEntry, WayKind};
use vcutc_process::from_above::{THINNEST, highest, layers};
use vcutc_process::lower::{BLEND, ROUNDING_ROOM};
use vcutc_region::distance::Walls;
use vcutc_region::pattern::Tool;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// A pocket with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub pattern: Pattern,
    pub step: Length,
    /// The largest radius of rounded corners, as far as the job asks for one.
    pub corners: Option<Length>,
    /// Where rows go.
    pub angle: Angle,
    /// The height of the stock over the region, in mm.
    pub top: f64,
    /// The height from which on all is air, in mm.
    pub air: f64,
    /// The floors of the layers from the top, in mm.
    pub floors: Vec<f64>,
    /// How many passes a layer has.
    pub passes: usize,
    /// What the lines of a sound field came to, where passes follow them.
    pub field: Option<FieldFigures>,
    /// What is cut in each layer.
    pub runs: Vec<Run>,
    /// How long a layer takes by each pattern that was compared.
    pub tried: Vec<(Pattern, Duration)>,
}

/// What the lines of a sound field came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldFigures {
    /// How far they lie over the sources.
    pub lift: Length,
    /// How many there are.
    pub lines: usize,
    /// How many of them end within the region.
    pub broken: usize,
    /// How many passes clear what they leave.
    pub extra: usize,
    /// How much ground these clear.
    pub cleared: Area,
}

/// A way of the tool in the plan from where it goes down to where it goes up.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub entry: Entry,
    pub legs: Vec<Leg>,
}

/// How the tool gets to the floor of a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Down to and fro along a line, from where it begins.
    Ramp { line: Piece },
    /// Down round and round.
    Helix { helix: Helix },
    /// Straight down to this place in a hole that is open.
    Hole { at: Place },
    /// Straight down to this place, where the tool has been in this layer.
    Return { at: Place },
    /// Through an open side: at depth from this place beside the stock.
    Open { from: Place },
}

/// A piece of a run at the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    pub piece: Piece,
    pub kind: Kind,
}

/// What a leg is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It clears uncut ground, with half the rim in the material, or with more of it than the limit allows at the speed of cutting.
    Opening,
    /// It clears ground beside what is cleared.
    Pass,
    /// It leads from pass to pass.
    Link,
}

impl Kind {
    /// Whether the tool has to be slow.
    #[must_use]
    pub const fn is_slow(self) -> bool {
        match self {
            Self::Opening | Self::Link => true,
            Self::Pass => false,
        }
    }
}

/// Plans a pocket in what the operations before it have left.
///
/// # Errors
/// Why there is no plan.
pub(crate) fn plan(asked: &ClearPocket, ground: &Ground<'_>) -> Result<Plan, Why> {
    let stock = ground.job.stock;
    let mut before = ground.before.clone();
    let top = highest(
        &mut before,
        &asked.region.region,
        asked.crusher.radius.value.to_mm(),
    );
    let floors = floors(asked, top)?;
    let region = &asked.region.region;
    let walls = Walls::of(region);
    let radius = asked.crusher.radius.value.to_mm();
    let step = step(asked)?;
    let keep = radius + asked.allowance.value.to_mm() + BLEND.to_mm();
    let tool = Tool {
        radius,
        standoff: keep + ROUNDING_ROOM.to_mm() - radius,
        run_out: asked.setup.run_out.value.to_mm(),
    };
    let room = Room {
        walls: &walls,
        stock: [stock.width, stock.depth].map(Length::to_mm),
        run_out: asked.setup.run_out.value.to_mm(),
        keep: keep + ROUNDING_ROOM.to_mm() / 2.0,
        step,
        radius,
        ramp: asked.crusher.ramp.value.to_rad(),
    };
    let deep = floors.first().map_or(0.0, |floor| top - floor);
    let Compared { best, tried, fault } = compared(asked, &tool, room, (keep, deep));
    let Some(Candidate { laid, runs, .. }) = best else {
        return Err(fault.unwrap_or(Why::TooLarge));
    };
    Ok(Plan {
        pattern: laid.pattern,
        step: Length::mm(step),
        corners: laid.corners,
        angle: laid.angle,
        top,
        air: stock.height.to_mm(),
        floors,
        passes: laid.passes.len() + laid.extra.len(),
        field: laid.field,
        runs,
        tried,
    })
}

/// Radii that are tried, as shares of the tool's.
const NARROWER: [f64; 5] = [0.9, 0.8, 0.7, 0.6, 0.5];

/// The first change that gives a plan where a way down is missing.
pub(crate) fn remedy(asked: &ClearPocket, ground: &Ground<'_>, why: Why) -> Option<Remedy> {
    let radii = NARROWER.map(|share| libm::floor(asked.crusher.radius.value.to_mm() * share * 10.0) / 10.0);
    let radii = radii.map(|radius| Remedy::Radius(Length::mm(radius)));
    let tried = match why {
        Why::NoHelix { .. } => core::iter::once(Remedy::Ramp).chain(radii).collect(),
        Why::NotOpen { .. } => vec![Remedy::Ramp],
        _ => Vec::new(),
    };
    tried.into_iter().find(|remedy| {
        let mut changed = asked.clone();
        match remedy {
            Remedy::Ramp => changed.entry.value = Auto::Given(WayIn::Ramp),
            Remedy::Radius(radius) => changed.crusher.radius.value = *radius,
        }
        plan(&changed, ground).is_ok()
    })
}

/// How far passes are apart, in mm.
fn step(asked: &ClearPocket) -> Result<f64, Why> {
    let step = match asked.step.value {
        Auto::Given(step) => step.to_mm(),
        // No place between two passes is farther from the outer one.
        Auto::Auto => asked.crusher.radius.value.to_mm(),
    };
    let bounds = asked.region.region.bounds();
    let narrow = (bounds.high.x - bounds.low.x).min(bounds.high.y - bounds.low.y);
    if narrow / 2.0 > MOST_LEVELS * step {
        return Err(Why::TooLarge);
    }
    Ok(step)
}

/// All patterns that the job allows. The tool keeps so far from the walls, and goes so deep.
fn compared(asked: &ClearPocket, tool: &Tool, room: Room<'_>, (keep, deep): (f64, f64)) -> Compared {
    let patterns: &[Pattern] = match &asked.pattern.value {
        Auto::Given(pattern) => core::slice::from_ref(pattern),
        Auto::Auto => &Pattern::COMPARED,
    };
    let ways = Ways {
        entry: asked.entry.value,
        hole: asked.opening.map(|opening| opening.value),
        clock: Clock::of(asked, deep),
    };
    let mut compared = Compared::default();
    for &pattern in patterns {
        let choices = match lay::lay(asked, &asked.region.region, tool, room.step, pattern) {
            Ok(choices) => choices,
            Err(why) => {
                compared.fault = Some(why);
                continue;
            }
        };
        for laid in choices {
            match order::runs(&laid.passes, &laid.extra, ways, room) {
                Ok(runs) => {
                    let runs = limits::slowed(runs, asked);
                    let standing = limits::standing(&runs, asked, keep);
                    let time = ways.clock.of_runs(&runs);
                    compared.take(laid, runs, (standing, time));
                }
                Err(why) => compared.fault = Some(why),
            }
        }
    }
    compared
}

/// What was compared.
#[derive(Default)]
struct Compared {
    best: Option<Candidate>,
    /// The least time of each pattern.
    tried: Vec<(Pattern, Duration)>,
    fault: Option<Why>,
}

/// A way to clear a layer.
struct Candidate {
    standing: Standing,
    time: Duration,
    laid: Laid,
    runs: Vec<Run>,
}

impl Compared {
    /// Keeps what takes the least time of all that keep the limits.
    fn take(&mut self, laid: Laid, runs: Vec<Run>, (standing, time): (Standing, Duration)) {
        match self
            .tried
            .iter_mut()
            .find(|(pattern, _)| *pattern == laid.pattern)
        {
            Some((_, known)) => *known = known.min(time),
            None => self.tried.push((laid.pattern, time)),
        }
        let is_better = self
            .best
            .as_ref()
            .is_none_or(|best| standing > best.standing || standing == best.standing && time < best.time);
        if is_better {
            self.best = Some(Candidate {
                standing,
                time,
                laid,
                runs,
            });
        }
    }
}

/// Floors of equal layers, each no thicker than the tool cuts.
fn floors(asked: &ClearPocket, top: f64) -> Result<Vec<f64>, Why> {
    let floor = asked.floor.value.to_mm();
    let deep = top - floor;
    if deep < THINNEST {
        return Err(Why::NothingThere { top: Length::mm(top) });
    }
    let thickest = asked.layer.value.or(asked.crusher.height.value).to_mm();
    layers(top, floor, thickest).ok_or(Why::TooLarge)
}

/// Most levels across a region.
const MOST_LEVELS: f64 = 1000.0;

impl Run {
    /// As plans show it: layer and number, bottom and top of its layer.
    pub(crate) fn planned(&self, [layer, number]: [u32; 2], heights: [f64; 2]) -> PlannedWay {
        let (from, entry) = match self.entry {
            Entry::Ramp { line } => (line.from, WayEntry::Ramp),
            Entry::Helix { helix } => (helix.last, WayEntry::Helix),
            Entry::Hole { at } => (at, WayEntry::Hole),
            Entry::Return { at } => (at, WayEntry::Return),
            Entry::Open { from } => (from, WayEntry::Open),
        };
        PlannedWay {
            layer,
            number,
            kind: WayKind::Pass,
            blade: 0,
            from: [from.x, from.y],
            heights,
            length: self.legs.iter().map(|leg| leg.piece.length()).sum(),
            entry,
        }
    }
}

impl Plan {
    /// Whether a run begins in the hole that the job names.
    pub(crate) fn uses_the_hole(&self) -> bool {
        let mut entries = self.runs.iter().map(|run| run.entry);
        entries.any(|entry| matches!(entry, Entry::Hole { .. }))
    }

    /// How long it takes at the programmed speeds, about.
    pub(crate) fn time(&self, asked: &ClearPocket) -> Duration {
        let deep = self.floors.first().map_or(0.0, |floor| self.top - floor);
        Clock::of(asked, deep).of_runs(&self.runs) * self.floors.len() as f64
    }
}
