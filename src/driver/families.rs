//! A job that leaves open how its cuts follow its part (`follow = auto`), compiled in the families that may suit it: the best that compiles
//! is taken.
//!
//! The geometry alone does not say which that is: flanks along steep ways need more edge than a blade may have, a machine may not reach
//! pitched cuts, and what stays depends on the lattice, too. So each family is planned, proven and put to the machine, in the order of
//! what it is expected to leave. One that is expected to leave far more than another has left is not planned, which changes nothing:
//! what cuts leave that are infinitely close, any others leave as well.
//!
//! What stays is compared first. Families that exceed the job's limit on the scallop nowhere on the surface by more than hardly anything are
//! alike. Where all do, those are that leave hardly more than the best, at their highest place and then on average. Of these the simplest is taken that is as good as the
//! best by what the job makes least.

use super::routes::{Ended, Made, along_its_routes};
use super::ways::{self, Came, Decided, first_error};
use super::{Run, Stage};
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::follow::Family;
use vcutc_job::operation::Aim;
use vcutc_job::sema::families::hardly_more;
use vcutc_job::{Candidate, CheckedJob};

/// A family is not planned if it is expected to leave so many times as much as is enough: a grid of heights shows what stays to less
/// than that, and takes the blade as long as most are.
const FAR_MORE: f64 = 1.5;

/// Up to so many times the time, or what else is made least, counts as good as that.
const AS_GOOD: f64 = 1.005;

/// A family, compared with others.
#[derive(Clone, Debug)]
pub struct ComparedFamily {
    pub family: Family,
    pub came: FamilyCame,
}

/// The result of a family.
#[derive(Clone, Debug)]
pub enum FamilyCame {
    /// It compiles.
    Compiled(FamilyFigures),
    /// It does not, for this reason.
    Refused(Option<Diagnostic>),
    /// It was not planned, for so much would stay at most where cuts are infinitely close.
    LeavesMore(Length),
}

/// Figures of a job cut in one family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FamilyFigures {
    /// The time of the whole program, as its machine takes it.
    pub time: Duration,
    pub cuts: usize,
    /// How high material stays on the part at most.
    pub highest: Length,
    /// How high it is on average over the plan of the stock.
    pub mean: Length,
    /// The longest edge that any cut uses.
    pub edge: Length,
}

/// A job with all choices made.
pub(super) struct Chosen {
    pub(super) decided: Decided,
    /// How its cuts may follow the part, the family that is taken first; none where the job does not leave that open.
    pub(super) families: Vec<ComparedFamily>,
}

/// A family that was planned.
struct Tried {
    family: Family,
    decided: Decided,
}

/// A family that compiles.
struct Compiles {
    tried: Tried,
    figures: FamilyFigures,
}

/// Makes the choices that a job leaves open: how its cuts follow the part, and then which of its ways its operations are done in. None
/// where it leaves none open, or the answer is not wanted.
pub(super) fn decided(
    job: &CheckedJob,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Option<Chosen> {
    if job.families.is_empty() {
        let decided = ways::decided(job, sources, run, progress)?;
        return Some(Chosen {
            decided,
            families: Vec::new(),
        });
    }
    let mut compared: Vec<ComparedFamily> = Vec::new();
    let mut found: Vec<Compiles> = Vec::new();
    let mut refused: Option<Tried> = None;
    for Candidate { family, expected } in job.families.iter().copied() {
        if enough(&found, job).is_some_and(|enough| expected > FAR_MORE * enough) {
            let came = FamilyCame::LeavesMore(Length::mm(expected));
            compared.push(ComparedFamily { family, came });
            continue;
        }
        let Some(followed) = job.following(family) else {
            continue;
        };
        let (decided, why) = whole(followed, sources, run, progress)?;
        let figures = decided.made.as_ref();
        let figures = figures.map(|made| self::figures(&decided, made, expected));
        let came = figures.map_or(FamilyCame::Refused(why), FamilyCame::Compiled);
        compared.push(ComparedFamily { family, came });
        let tried = Tried { family, decided };
        match figures {
            Some(figures) => found.push(Compiles { tried, figures }),
            None => refused = refused.or(Some(tried)),
        }
    }
    let Tried { family, decided } = best(found, job).or(refused)?;
    if let Some(place) = compared.iter().position(|one| one.family == family) {
        compared[..=place].rotate_right(1);
    }
    Some(Chosen {
        decided,
        families: compared,
    })
}

/// A job whose cuts follow its part in one family, with what else it leaves open decided; and why it does not compile, where it does not.
fn whole(
    job: CheckedJob,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Option<(Decided, Option<Diagnostic>)> {
    if let Some(decided) = ways::decided(&job, sources, run, progress) {
        let mut ways = decided.comparisons.iter().flat_map(|comparison| &comparison.ways);
        let why = ways.find_map(|way| match &way.came {
            Came::Refused(why) => why.clone(),
            Came::Compiled(_) => None,
        });
        return Some((decided, why));
    }
    let (made, why) = match along_its_routes(&job, sources, run, progress) {
        Ended::Compiled(made) => (Some(made), None),
        Ended::Refused(refused) => (None, first_error(refused.at_once(&job))),
        Ended::Cancelled => return None,
    };
    let decided = Decided {
        job,
        comparisons: Vec::new(),
        made,
    };
    (!run.wanted.is_needless()).then_some((decided, why))
}

fn figures(decided: &Decided, made: &Made, expected: f64) -> FamilyFigures {
    let job = &decided.job;
    let plan = job.stock.width.to_mm() * job.stock.depth.to_mm();
    let left = made.compiled.left_over.map(|left| left.all);
    let highest = left.map_or(Length::mm(expected), |left| left.highest.height);
    FamilyFigures {
        time: made.time(),
        cuts: made.plan.cuts(),
        highest,
        mean: left.map_or(Length::mm(expected), |left| {
            Length::mm(left.volume.to_mm3() / plan)
        }),
        edge: made.compiled.report.longest_edge,
    }
}

/// The tightest limit on what stays on the part, in mm.
fn limit(job: &CheckedJob) -> Option<f64> {
    let limits = job
        .operations
        .iter()
        .filter_map(|operation| operation.scallop_limit());
    limits.map(|limit| limit.value.to_mm()).reduce(f64::min)
}

/// How high as much stays as is enough, in mm; none where nothing compiles yet.
fn enough(found: &[Compiles], job: &CheckedJob) -> Option<f64> {
    let highest = found.iter().map(|one| one.figures.highest.to_mm());
    let enough = hardly_more(highest.reduce(f64::min)?);
    Some(limit(job).map_or(enough, |limit| enough.max(hardly_more(limit))))
}

/// The best of all that compile, or the simplest that is as good.
fn best(found: Vec<Compiles>, job: &CheckedJob) -> Option<Tried> {
    let mut found = leaving_little(found, limit(job));
    let aim = aim(job);
    let measures = found.iter().map(|one| measure(&one.figures, aim));
    let least = measures.fold(f64::INFINITY, f64::min);
    found.retain(|one| measure(&one.figures, aim) <= least * AS_GOOD);
    let simplest = found.into_iter().min_by_key(|one| one.tried.family);
    simplest.map(|best| best.tried)
}

/// Those that keep the limit; where none does, those that leave hardly more than the best.
fn leaving_little(mut found: Vec<Compiles>, limit: Option<f64>) -> Vec<Compiles> {
    let keeps = |one: &Compiles| limit.is_some_and(|limit| one.figures.highest.to_mm() <= hardly_more(limit));
    if found.iter().any(keeps) {
        found.retain(keeps);
        return found;
    }
    let heights: [fn(&FamilyFigures) -> f64; 2] = [|one| one.highest.to_mm(), |one| one.mean.to_mm()];
    for height in heights {
        let least = found
            .iter()
            .map(|one| height(&one.figures))
            .fold(f64::INFINITY, f64::min);
        found.retain(|one| height(&one.figures) <= hardly_more(least));
    }
    found
}

/// What the operations that follow the part make least; the time where they differ.
fn aim(job: &CheckedJob) -> Aim {
    let following = job
        .operations
        .iter()
        .filter(|operation| operation.follows().is_some());
    let mut aims = following.map(|operation| operation.aim());
    match aims.next() {
        Some(first) if aims.all(|aim| aim == first) => first,
        Some(_) | None => Aim::Time,
    }
}

fn measure(figures: &FamilyFigures, aim: Aim) -> f64 {
    match aim {
        Aim::Time => figures.time.to_s(),
        Aim::Scallop => figures.highest.to_mm(),
        Aim::Cuts => figures.cuts as f64,
        Aim::Edge => figures.edge.to_mm(),
    }
}
