//! Two ways to cut the same work, compared: the times that they take for every depth of the work and every feed of the disc.
//!
//! A plan is a plan of the cross-section, and cuts run through the work. So its time is a straight line over the depth of the
//! work, and the part of it that a spinning blade spends in the material falls with that blade's feed. Both are read off the
//! program itself, written down for the depth of the stock and for twice that: nothing is left out, and nothing fitted. All
//! times are those at programmed speeds. [Yu 2019, 17 to 20] has the same with fitted counts of cuts, `docs/process.md` R1 to R3
//! with counted ones.

use crate::lower;
use vcutc_backend_api::ir::{Action, FeedId, OperationId};
use vcutc_backend_api::state::Drive;
use vcutc_backend_api::units::{Duration, Length, Speed};
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::PlannedJob;
use vcutc_simulation::timing::{Kind, op_times};

/// The time of a plan as it depends on the depth of the work and on the feed of what spins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanTime {
    /// The depth of the work that was planned for.
    pub depth: Length,
    /// All but cutting with a blade that spins in the operation that is compared.
    still: Line,
    /// Cutting with a blade that spins in that operation.
    spinning: Line,
    /// How fast blades that do not spin cut, if there are such cuts: the fastest of them.
    pub still_feed: Option<Speed>,
    /// How fast blades that spin cut, if there are such cuts: the fastest of them.
    pub spinning_feed: Option<Speed>,
    /// How often the blade is changed.
    pub changes: usize,
    /// The time of these changes, without the ways to and from their place.
    pub changing: Duration,
}

/// A time in s over a depth in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Line {
    start: f64,
    slope: f64,
}

impl Line {
    /// Through two times, one at a depth and one at twice that.
    fn through(depth: f64, [once, twice]: [f64; 2]) -> Self {
        Self {
            start: 2.0 * once - twice,
            slope: (twice - once) / depth,
        }
    }

    fn at(self, depth: f64) -> f64 {
        self.slope.mul_add(depth, self.start)
    }
}

/// Where one way is faster than another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Faster {
    /// Whatever the depth.
    Everywhere,
    /// Nowhere.
    Nowhere,
    /// Beyond this depth.
    Beyond(Length),
    /// Below this depth.
    Below(Length),
}

impl PlanTime {
    /// Reads it off a plan, of which one operation is compared: only its blades that spin are fed otherwise. None where the program
    /// breaks a rule of the IR, which its proof reports.
    #[must_use]
    pub fn of(plan: &PlannedJob, compared: OperationId) -> Option<Self> {
        let once = program(plan)?;
        let mut deeper = plan.clone();
        deeper.stock.depth = plan.stock.depth + plan.stock.depth;
        let twice = program(&deeper)?;
        let depth = plan.stock.depth;
        let [(still, spinning), (still_twice, spinning_twice)] =
            [&once, &twice].map(|program| spent(program, compared));
        let line = |times| Line::through(depth.to_mm(), times);
        let feed_of = |drive| fastest(&once, compared, drive);
        let is_change = |action: &Action| matches!(action, Action::ToolChange { .. });
        let actions = once.program().ops.iter().map(|op| &op.action);
        let changing = once.program().ops.iter().zip(op_times(&once));
        let changing = changing.filter(|(op, _)| is_change(&op.action));
        Some(Self {
            depth,
            still: line([still, still_twice]),
            spinning: line([spinning, spinning_twice]),
            still_feed: feed_of(Drive::Off),
            spinning_feed: feed_of(Drive::Running),
            changes: actions.filter(|action| is_change(action)).count(),
            changing: changing.map(|(_, time)| time).sum(),
        })
    }

    /// The same of a program that takes so long at the depth that is planned. What else its machine needs,
    /// for moves of all axes and for speeding up, is taken not to depend on the depth.
    #[must_use]
    pub fn taking(mut self, time: Duration) -> Self {
        self.still.start += (time - self.at(self.depth, 1.0)).to_s();
        self
    }

    /// The time for a depth of the work, where blades that spin are fed this many times as fast as planned; the depth and the
    /// factor are positive.
    #[must_use]
    pub fn at(&self, depth: Length, feed: f64) -> Duration {
        let depth = depth.to_mm();
        Duration::s(self.still.at(depth) + self.spinning.at(depth) / feed)
    }

    /// Where this is faster than another way, at the feeds that are planned.
    #[must_use]
    pub fn is_faster_than(&self, other: &Self) -> Faster {
        let start = self.still.start + self.spinning.start - other.still.start - other.spinning.start;
        let slope = self.still.slope + self.spinning.slope - other.still.slope - other.spinning.slope;
        if slope == 0.0 {
            return if start < 0.0 {
                Faster::Everywhere
            } else {
                Faster::Nowhere
            };
        }
        let even = -start / slope;
        match (even > 0.0, slope < 0.0) {
            (true, true) => Faster::Beyond(Length::mm(even)),
            (true, false) => Faster::Below(Length::mm(even)),
            (false, true) => Faster::Everywhere,
            (false, false) => Faster::Nowhere,
        }
    }

    /// The feed of blades that spin at which this takes as long as another way, for the depth that is planned; none where no feed
    /// does it, or nothing spins.
    #[must_use]
    pub fn even_feed(&self, other: &Self) -> Option<Speed> {
        let depth = self.depth.to_mm();
        let feed = self.spinning_feed?;
        let left = other.at(self.depth, 1.0).to_s() - self.still.at(depth);
        (left > 0.0).then(|| Speed::mm_per_s(feed.to_mm_per_s() * self.spinning.at(depth) / left))
    }
}

fn program(plan: &PlannedJob) -> Option<VerifiedProgram> {
    verify(lower::lower(plan, &SourceMap::default())).ok()
}

/// The times in s of all but cutting with a blade that spins in an operation, and of that.
fn spent(program: &VerifiedProgram, compared: OperationId) -> (f64, f64) {
    let (mut still, mut spinning) = (0.0, 0.0);
    for (segment, time) in program.program().segments().zip(op_times(program)) {
        let is_compared = segment.op.site.operation() == Some(compared);
        match (Kind::of(&segment.op.action), segment.before.spindle) {
            (Some(Kind::Cutting), Drive::Starting | Drive::Running) if is_compared => {
                spinning += time.to_s();
            }
            (Some(_), _) => still += time.to_s(),
            (None, _) => {}
        }
    }
    (still, spinning)
}

/// The fastest feed of an operation's cuts while the spindle is in a state.
fn fastest(program: &VerifiedProgram, compared: OperationId, spindle: Drive) -> Option<Speed> {
    let program = program.program();
    let feed = |FeedId(id)| program.feeds.get(usize::from(id)).copied();
    let cuts = program.segments().filter(|segment| {
        Kind::of(&segment.op.action) == Some(Kind::Cutting)
            && segment.before.spindle == spindle
            && segment.op.site.operation() == Some(compared)
    });
    let feeds = cuts.filter_map(|segment| feed(segment.op.action.feed()?));
    feeds.max_by(Speed::total_cmp)
}
