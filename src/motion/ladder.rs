//! The ladder: which way to stand in each run of a program.
//!
//! A program falls into runs, within which the axes move on without a break, and a machine can stand in several ways (a
//! branch of the inverse kinematics, and turns of its axes) through each of them. In the ladder graph of path planning
//! (as in Descartes of ROS-Industrial) the ways through a run are the rungs, and links lead from each rung to those of the
//! next run. Wanted is the way up
//!
//! 1. with the largest smallest margin, then
//! 2. with the fewest changes of the way to stand, then
//! 3. with the least travel of the axes, then
//! 4. with the first rungs.
//!
//! Smallest margins and sums do not go together in one pass of dynamic programming (the best way to a rung by margin need
//! not be part of the way that is best by travel), so there are two: the first finds the largest smallest margin, the second
//! the cheapest way among the rungs and links that have at least that.
//!
//! Whether a link really can be taken may be expensive to say, so links are taken on trust first; those of the best way
//! are then put to the test, and where one fails the climb begins again without it (lazy shortest paths: Dellin and
//! Srinivasa, A unifying formalism for shortest path problems with expensive edge evaluations, 2016). The way found is the
//! best all the same, for every way that was better has a link that failed.

use std::collections::BTreeSet;

/// What a rung or a link costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The smallest margin on it.
    pub margin: f64,
    /// How many changes of the way to stand.
    pub changes: u32,
    /// How far the axes travel.
    pub travel: f64,
}

/// Runs with their rungs, and links between the rungs of neighbours.
pub trait Ladder {
    fn runs(&self) -> usize;
    /// The rungs of a run.
    fn rungs(&self, run: usize) -> &[Cost];
    /// The link from a rung of the run before `run` to one of its own, if there may be one.
    fn link(&self, run: usize, from: usize, to: usize) -> Option<Cost>;
    /// Puts a link to the test.
    fn holds(&mut self, run: usize, from: usize, to: usize) -> bool;
}

/// Why there is no way up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stuck {
    /// A run without rungs, or without links to it.
    At(usize),
    /// The links into this run failed when put to the test.
    Refuted(usize),
}

/// Most climbs before giving up; each but the last has found a link that fails.
const MOST_CLIMBS: usize = 400;

/// Most links that are looked at in all climbs together, but for the first two: it bounds the work on long programs with many
/// ways to stand.
const MOST_LOOKS: usize = 120_000_000;

/// A link: the run it leads to, from which rung, to which.
type Link = (usize, usize, usize);

/// The best way up: a rung for each run.
///
/// # Errors
/// Where it ends when there is none.
pub fn climb(ladder: &mut dyn Ladder) -> Result<Vec<usize>, Stuck> {
    let mut links = Links::of(ladder);
    let mut proven = BTreeSet::new();
    let mut last_refuted = None;
    let mut known = Known::default();
    let affordable = MOST_LOOKS / links.count().max(1);
    for _ in 0..MOST_CLIMBS.min(affordable.max(2)) {
        let way = match best(ladder, &links, &mut known) {
            Ok(way) => way,
            Err(run) => return Err(last_refuted.map_or(Stuck::At(run), Stuck::Refuted)),
        };
        let mut all_hold = true;
        for (run, pair) in (1..).zip(way.windows(2)) {
            let &[from, to] = pair else { continue };
            let link: Link = (run, from, to);
            if proven.contains(&link) {
                continue;
            }
            if ladder.holds(run, from, to) {
                proven.insert(link);
            } else {
                links.refute(link);
                known.forget_from(run);
                last_refuted = Some(run);
                all_hold = false;
            }
        }
        if all_hold {
            return Ok(way);
        }
    }
    Err(Stuck::Refuted(last_refuted.unwrap_or_default()))
}

/// All links, each asked for once: a long program is climbed many times.
struct Links {
    /// For each run, and for each of its rungs, the links from the rungs before.
    into: Vec<Vec<Vec<Option<Cost>>>>,
}

impl Links {
    fn of(ladder: &dyn Ladder) -> Self {
        let rungs = |run: usize| ladder.rungs(run).len();
        let into = (0..ladder.runs()).map(|run| {
            let before = run.checked_sub(1).map_or(0, rungs);
            let to_rung = |to| (0..before).map(|from| ladder.link(run, from, to)).collect();
            (0..rungs(run)).map(to_rung).collect()
        });
        Self { into: into.collect() }
    }

    fn count(&self) -> usize {
        self.into.iter().flatten().map(Vec::len).sum()
    }

    /// Takes a link away.
    fn refute(&mut self, (run, from, to): Link) {
        let links = self.into.get_mut(run).and_then(|run| run.get_mut(to));
        if let Some(link) = links.and_then(|links| links.get_mut(from)) {
            *link = None;
        }
    }

    /// The links to a rung that are not refuted, with the rungs they come from.
    fn to(&self, run: usize, to: usize) -> impl Iterator<Item = (usize, Cost)> + '_ {
        let links = self.into.get(run).and_then(|run| run.get(to));
        let links = links.map_or(&[][..], Vec::as_slice);
        links
            .iter()
            .enumerate()
            .filter_map(|(from, link)| Some((from, (*link)?)))
    }
}

/// What climbs before have found out: it holds up to the first run to which a link was refuted since.
#[derive(Default)]
struct Known {
    /// For each rung of each run, the largest smallest margin of a way to it.
    widest: Vec<Vec<Option<f64>>>,
    /// The cheapest ways to the rungs whose margins are nowhere below `least`.
    cheapest: Vec<Vec<Option<Arrival>>>,
    least: Option<f64>,
}

impl Known {
    fn forget_from(&mut self, run: usize) {
        self.widest.truncate(run);
        self.cheapest.truncate(run);
    }

    /// The cheapest ways that are known with this least margin.
    fn cheapest_with(&mut self, least: f64) -> &mut Vec<Vec<Option<Arrival>>> {
        if self.least != Some(least) {
            self.cheapest.clear();
            self.least = Some(least);
        }
        &mut self.cheapest
    }
}

/// The best way if every link that is not refuted holds; else the run that cannot be reached.
fn best(ladder: &dyn Ladder, links: &Links, known: &mut Known) -> Result<Vec<usize>, usize> {
    let widest = widest(ladder, links, &mut known.widest)?;
    let least = widest - SAME_MARGIN;
    cheapest(ladder, links, least, known.cheapest_with(least))
}

/// Margins that differ by less count as equal: rounding must not change the branch.
const SAME_MARGIN: f64 = 1e-6;

/// The largest smallest margin that any way has. `known` are the margins of the first runs, and of all afterwards.
fn widest(ladder: &dyn Ladder, links: &Links, known: &mut Vec<Vec<Option<f64>>>) -> Result<f64, usize> {
    for run in known.len()..ladder.runs() {
        let reached = known.last().map_or(&[][..], Vec::as_slice);
        let next = (0..).zip(ladder.rungs(run)).map(|(to, rung)| {
            let before = if run == 0 {
                Some(f64::INFINITY)
            } else {
                links
                    .to(run, to)
                    .filter_map(|(from, link)| Some(link.margin.min((*reached.get(from)?)?)))
                    .max_by(f64::total_cmp)
            };
            before.map(|margin| margin.min(rung.margin))
        });
        let next: Vec<_> = next.collect();
        if next.iter().flatten().next().is_none() {
            return Err(run);
        }
        known.push(next);
    }
    let widest = known
        .last()
        .and_then(|last| last.iter().flatten().copied().max_by(f64::total_cmp));
    Ok(widest.unwrap_or(f64::INFINITY))
}

/// A way to a rung: what it cost, and from which rung of the run before it came.
#[derive(Clone, Copy)]
struct Arrival {
    changes: u32,
    travel: f64,
    from: usize,
}

impl Arrival {
    fn is_cheaper(&self, other: &Self) -> bool {
        self.changes
            .cmp(&other.changes)
            .then(self.travel.total_cmp(&other.travel))
            .is_lt()
    }
}

/// The cheapest way whose margins are nowhere below `least`. `arrivals` are those of the first runs, and of all afterwards.
fn cheapest(
    ladder: &dyn Ladder,
    links: &Links,
    least: f64,
    arrivals: &mut Vec<Vec<Option<Arrival>>>,
) -> Result<Vec<usize>, usize> {
    for run in arrivals.len()..ladder.runs() {
        let before: &[Option<Arrival>] = arrivals.last().map_or(&[], Vec::as_slice);
        let here = (0..).zip(ladder.rungs(run)).map(|(to, rung)| {
            if rung.margin < least {
                return None;
            }
            if run == 0 {
                return Some(Arrival {
                    changes: rung.changes,
                    travel: rung.travel,
                    from: 0,
                });
            }
            let mut cheapest: Option<Arrival> = None;
            for (from, link) in links.to(run, to) {
                let Some(&Some(arrival)) = before.get(from) else {
                    continue;
                };
                if link.margin < least {
                    continue;
                }
                let candidate = Arrival {
                    changes: arrival
                        .changes
                        .saturating_add(link.changes)
                        .saturating_add(rung.changes),
                    travel: arrival.travel + link.travel + rung.travel,
                    from,
                };
                if cheapest.is_none_or(|known| candidate.is_cheaper(&known)) {
                    cheapest = Some(candidate);
                }
            }
            cheapest
        });
        let here: Vec<_> = here.collect();
        arrivals.push(here);
    }
    trace(arrivals)
}

/// The rungs of the cheapest way, from its end back to its beginning.
fn trace(arrivals: &[Vec<Option<Arrival>>]) -> Result<Vec<usize>, usize> {
    let mut way = Vec::with_capacity(arrivals.len());
    let mut at: Option<usize> = None;
    for (run, here) in arrivals.iter().enumerate().rev() {
        let rung = match at {
            Some(rung) => rung,
            None => cheapest_of(here).ok_or(run)?,
        };
        way.push(rung);
        let arrival = here.get(rung).copied().flatten().ok_or(run)?;
        at = Some(arrival.from);
    }
    way.reverse();
    Ok(way)
}

fn cheapest_of(arrivals: &[Option<Arrival>]) -> Option<usize> {
    let mut cheapest: Option<(usize, Arrival)> = None;
    for (rung, arrival) in arrivals.iter().enumerate() {
        if let Some(arrival) = arrival
            && cheapest.is_none_or(|(_, known)| arrival.is_cheaper(&known))
        {
            cheapest = Some((rung, *arrival));
        }
    }
    cheapest.map(|(rung, _)| rung)
}

#[cfg(test)]
mod tests;
