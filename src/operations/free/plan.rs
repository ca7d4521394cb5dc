//! The plan of a pocket to be freed: layers, and in each the same strips, slits and passes of the disc.
//!
//! The disc comes in through an open side at depth, where its shank is outside of the stock. It frees strips in rows along that side, one
//! after the other, so that its shank is always over those before. Around these rows strips along the walls stay, which it frees last,
//! the one beside the rows first. Corners that are sharper than its rim stand as pillars: slits part them from the strips. Acute
//! corners it enters level by level.

mod crossing;
mod gentle;
mod inner;
mod layout;
mod measures;
mod rows;
mod strips;

use crate::asked::FreePocket;
use crate::refused::Why;
use layout::Laid;
use measures::Measures;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_job::operation::Ground;
use vcutc_job::planned::{PlannedWay, WayEntry, WayKind};
use vcutc_job::{Machine, Setup};
use vcutc_process::from_above::{THINNEST, highest, layers};
use vcutc_process::slits::fit::{self, Unfit};
use vcutc_process::slits::ways::ways as slits_as_planned;
use vcutc_region::freed::{FreedFault, Slits, Wheel, freed};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::slits::Slit;

/// A pocket with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The height of the stock over the region, in mm.
    pub top: f64,
    /// The height from which on all is air, in mm.
    pub air: f64,
    /// From the top, at least one.
    pub stages: Vec<Stage>,
    /// The width of the strips along walls.
    pub step: Length,
    /// The width of the rows.
    pub row: Length,
    /// How many rows there are.
    pub rows: usize,
    /// How many strips lie along each wall.
    pub rings: u32,
    /// The ways of the disc in each layer, in their order: each begins and ends beside the stock.
    pub passes: Vec<Pass>,
    /// How thick a layer is.
    pub layer: Length,
    /// How long all takes, about.
    pub time: Duration,
}

/// Layers that are slit at once and then freed one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// In the order of cutting, all down to the lowest floor.
    pub slits: Vec<Slit>,
    /// The floors from the top, in mm; at least one.
    pub floors: Vec<f64>,
}

/// How many strips along walls are tried at most.
const MOST_RINGS: u32 = 3;

/// Plans a pocket in what the operations before it have left.
///
/// # Errors
/// Why there is no plan.
pub(crate) fn plan(asked: &FreePocket, ground: &Ground<'_>) -> Result<Plan, Why> {
    let mut before = ground.before.clone();
    let region = &asked.region.region;
    let reach = asked.blade.cutting_length.value.max(asked.disc.radius.value);
    let top = highest(&mut before, region, reach.to_mm());
    let floor = asked.floor.value.to_mm();
    if top - floor < THINNEST {
        return Err(Why::NothingThere { top: Length::mm(top) });
    }
    let thickest = asked.layer.value.or(asked.disc.depth.value).to_mm();
    let floors = layers(top, floor, thickest).ok_or(Why::TooLarge)?;
    let thick = floors.first().map_or(0.0, |first| top - first);
    let measures = Measures::of(asked, [thick, top - floor])?;
    let laid = best(asked, measures, ground)?;
    let stages = stages(asked, &laid, top, &floors)?;
    let mut plan = Plan {
        top,
        air: ground.job.stock.height.to_mm(),
        stages,
        step: Length::mm(measures.step),
        row: Length::mm(laid.row),
        rows: laid.rows,
        rings: laid.rings,
        passes: laid.passes,
        layer: Length::mm(thick),
        time: Duration::ZERO,
    };
    plan.time = plan.time(asked, ground.job.machine.as_ref());
    Ok(plan)
}

/// The fastest layout of those in which the disc finds its way.
fn best(asked: &FreePocket, measures: Measures, ground: &Ground<'_>) -> Result<Laid, Why> {
    let fronts = layout::fronts(&asked.region.region);
    if fronts.is_empty() {
        return Err(Why::Closed);
    }
    let mut best: Option<(Duration, Laid)> = None;
    let mut fault: Option<Why> = None;
    for front in fronts {
        for rings in 1..=MOST_RINGS {
            let laid = layout::lay(asked, measures, (front, rings), ground.job.stock).and_then(|laid| {
                is_followed(&laid.slits)?;
                goes_free(asked, measures, &laid)?;
                Ok(laid)
            });
            match laid {
                Ok(laid) => {
                    let time = layer_time(asked, &laid.slits, &laid.passes);
                    if best.as_ref().is_none_or(|(known, _)| time < *known) {
                        best = Some((time, laid));
                    }
                }
                Err(why) => fault = Some(fault.map_or(why, |known: Why| known.worth_more(why))),
            }
        }
    }
    match best {
        Some((_, laid)) => Ok(laid),
        None => Err(fault.unwrap_or(Why::TooLarge)),
    }
}

/// Whether the straight blade follows the slits between strips.
fn is_followed(slits: &[Slit]) -> Result<(), Why> {
    fit::can_be_followed(slits).map_err(|unfit| match unfit {
        Unfit::Short { way } => Why::Bent { way },
        other => Why::Unfit(other),
    })
}

/// Whether the shank goes over freed ground only. The proof says it again, of the program.
fn goes_free(asked: &FreePocket, measures: Measures, laid: &Laid) -> Result<(), Why> {
    let walls = fit::knife(asked.fit(), measures.thick)
        .and_then(|knife| fit::along_walls(asked.fit(), knife))
        .map_err(Why::Unfit)?;
    let slits = walls.iter().chain(&laid.slits);
    let ways: Vec<Vec<Piece>> = slits.map(ways_of).collect();
    let slits = Slits {
        ways: &ways,
        half: measures.half,
        beside_walls: measures.beside_walls(),
    };
    let wheel = Wheel {
        radius: measures.radius,
        shank: measures.shank,
    };
    let found = freed(&asked.region.region, slits, &laid.passes, wheel).map_err(|fault| match fault {
        FreedFault::Tool | FreedFault::Fine => Why::TooThin,
    })?;
    match found.met {
        None => Ok(()),
        Some(met) => Err(Why::Met {
            at: [met.at.x, met.at.y],
            by: met.by,
        }),
    }
}

fn ways_of(slit: &Slit) -> Vec<Piece> {
    slit.pieces.iter().map(|piece| piece.way).collect()
}

/// What is slit and freed, from the top.
fn stages(asked: &FreePocket, laid: &Laid, top: f64, floors: &[f64]) -> Result<Vec<Stage>, Why> {
    // A u32 fits.
    let through = asked.through.value.max(1) as usize;
    let stages = floors.chunks(through).map(|floors| {
        let lowest = floors.last().copied().unwrap_or(top);
        let knife = fit::knife(asked.fit(), top - lowest)?;
        let mut slits = fit::along_walls(asked.fit(), knife)?;
        slits.extend(laid.slits.iter().cloned());
        Ok(Stage {
            slits,
            floors: floors.to_vec(),
        })
    });
    stages.collect::<Result<_, _>>().map_err(Why::Unfit)
}

/// How long the slits and the passes of a layer take at the programmed speeds, about.
fn layer_time(asked: &FreePocket, slits: &[Slit], passes: &[Pass]) -> Duration {
    let setup: &Setup = &asked.setup;
    let long: f64 = slits.iter().flat_map(ways_of).map(Piece::length).sum();
    let ways: f64 = passes.iter().map(Pass::length).sum();
    let lifts = setup.clearance.value * (2.0 * (slits.len() + passes.len()) as f64);
    Length::mm(long) / setup.cut_feed.value
        + Length::mm(ways) / asked.free_feed.value
        + lifts / setup.travel_feed.value
}

/// A way of the disc as plans show it: layer and number, bottom and top of its layer.
fn strip_as_planned(pass: &Pass, [layer, number]: [u32; 2], heights: [f64; 2]) -> PlannedWay {
    let from = pass
        .pieces
        .first()
        .map_or([0.0; 2], |piece| [piece.from.x, piece.from.y]);
    PlannedWay {
        layer,
        number,
        kind: WayKind::Strip,
        blade: 1,
        from,
        heights,
        length: pass.length(),
        entry: WayEntry::Open,
    }
}

impl Plan {
    /// How many slits and ways of the disc there are.
    pub(crate) fn cuts(&self) -> usize {
        let of = |stage: &Stage| stage.slits.len() + stage.floors.len() * self.passes.len();
        self.stages.iter().map(of).sum()
    }

    /// How many layers there are.
    pub(crate) fn layers(&self) -> usize {
        self.stages.iter().map(|stage| stage.floors.len()).sum()
    }

    /// How often the blade is changed.
    pub(crate) fn changes(&self) -> usize {
        2 * self.stages.len() - 1
    }

    /// Slits and ways of the disc, in the order of the program.
    pub(crate) fn ways(&self) -> Vec<PlannedWay> {
        let mut ways = Vec::new();
        let (mut layer, mut above) = (1, self.top);
        for stage in &self.stages {
            let lowest = stage.floors.last().copied().unwrap_or(above);
            ways.extend(slits_as_planned(&stage.slits, layer, [lowest, above]));
            let mut number = u32::try_from(stage.slits.len()).unwrap_or(u32::MAX);
            for &floor in &stage.floors {
                for pass in &self.passes {
                    number = number.saturating_add(1);
                    ways.push(strip_as_planned(pass, [layer, number], [floor, above]));
                }
                (layer, above, number) = (layer + 1, floor, 0);
            }
        }
        ways
    }

    fn time(&self, asked: &FreePocket, machine: Option<&Machine>) -> Duration {
        let change = machine.and_then(|machine| machine.change);
        let change = change.map_or(Duration::ZERO, |held| held.change.time);
        let stages = self.stages.iter().map(|stage| {
            let lowest = stage.floors.last().copied().unwrap_or(self.top);
            let down = Length::mm(self.air - lowest) * stage.slits.len() as f64;
            let slits = layer_time(asked, &stage.slits, &[]) + down / asked.plunge_feed.value;
            slits + layer_time(asked, &[], &self.passes) * stage.floors.len() as f64
        });
        stages.sum::<Duration>() + change * self.changes() as f64
    }
}
