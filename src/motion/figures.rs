//! What a program asks of its machine: the [`ReachFigures`], for programs too.

use crate::axis_range::axis_margin;
use crate::demand::Extreme;
use crate::describe::{branch_words, site_words};
use crate::solve::{Reached, SlowerTurns};
use serde::{Serialize, Serializer};
use vcutc_backend_api::ir::{Axis, AxisKind, Maker, OpId, Program};
use vcutc_backend_api::motion::{Branch, Stretch};
use vcutc_backend_api::status::kuka_status;

/// What a program asks of its machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReachFigures {
    /// The branches, in order.
    pub branches: Vec<BranchFigure>,
    /// How many travels through the air became axis moves, because no branch carries the program without.
    pub changes: usize,
    /// The smallest share that anything has left; see `src/motion/demand.rs`.
    #[serde(serialize_with = "rounded")]
    pub margin: f64,
    /// What has the smallest share: an axis or a kind of singular pose.
    pub least: Least,
    /// The axes, in the controller's order.
    pub axes: Vec<AxisFigure>,
    /// How near the arm comes to its singular poses; nothing for a machine without such poses.
    pub singular: Vec<SingularFigure>,
    /// The turns that are slower than the job allows; none where the axes follow all of them as they are stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slower: Option<SlowerFigure>,
    /// How many times the inverse kinematics was solved to prove it.
    pub solves: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BranchFigure {
    /// The op that ends on it first.
    pub op: u32,
    /// How many ops end on it before the next begins.
    pub ops: u32,
    pub words: String,
    /// Whether it has a number only, of a machine whose branches have no names.
    #[serde(skip)]
    pub is_numbered: bool,
    /// KUKA's status bits, for KUKA robots.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kuka_status: Option<u8>,
}

/// A place in the program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaceFigure {
    pub op: u32,
    /// What of the job it serves.
    pub words: String,
}

/// What has the smallest share left.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Least {
    /// The axis, or the kind of singular pose.
    pub of: String,
    pub at: PlaceFigure,
}

/// What is asked of an axis, in deg or mm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisFigure {
    pub name: String,
    /// `deg` or `mm`.
    pub unit: &'static str,
    /// Its lowest value.
    #[serde(serialize_with = "rounded")]
    pub low: f64,
    #[serde(serialize_with = "rounded")]
    pub high: f64,
    /// Its lower limit.
    #[serde(serialize_with = "rounded")]
    pub min: f64,
    /// Its upper limit.
    #[serde(serialize_with = "rounded")]
    pub max: f64,
    /// Its distance to the nearer limit over half of its range.
    #[serde(serialize_with = "rounded")]
    pub margin: f64,
    /// Where it is nearest to a limit.
    pub margin_at: PlaceFigure,
    /// Its highest rate, in units a second.
    #[serde(serialize_with = "rounded")]
    pub rate: f64,
    /// Its highest rate by its maker, when known.
    #[serde(serialize_with = "rounded_if_known")]
    pub rate_limit: Option<f64>,
    /// Where it is fastest.
    pub rate_at: PlaceFigure,
}

/// How near the arm comes to a kind of singular pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SingularFigure {
    /// `wrist`, `elbow` or `shoulder`.
    pub kind: &'static str,
    /// `deg` or `mm`.
    pub unit: &'static str,
    /// How far it stays away.
    #[serde(serialize_with = "rounded")]
    pub distance: f64,
    /// The same as a share of all one could wish for.
    #[serde(serialize_with = "rounded")]
    pub share: f64,
    /// Where it is nearest.
    pub at: PlaceFigure,
}

/// How many motions turn the blade more slowly than the job allows, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlowerFigure {
    /// How many do.
    pub motions: usize,
    /// How many motions turn the blade.
    pub of: usize,
    /// The lowest rate of turning, in deg/s.
    #[serde(serialize_with = "rounded")]
    pub lowest: f64,
    /// The first motion that has it.
    pub at: PlaceFigure,
    /// The axis that was too slow.
    pub axis: String,
    /// `deg` or `mm`.
    pub unit: &'static str,
    /// How fast it would have to move, in units a second.
    #[serde(serialize_with = "rounded")]
    pub needed: f64,
    /// Its highest rate by its maker.
    #[serde(serialize_with = "rounded_if_known")]
    pub limit: Option<f64>,
}

/// To a ten thousandth, of a degree, a millimetre or a share: what is less is noise of the arithmetic.
fn rounded<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(ten_thousandths(*value))
}

fn rounded_if_known<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    value.map(ten_thousandths).serialize(serializer)
}

fn ten_thousandths(value: f64) -> f64 {
    // Adding nothing takes the sign from a zero.
    (value * 1e4).round() / 1e4 + 0.0
}

/// The figures of a program.
#[must_use]
pub fn figures(reached: &Reached) -> ReachFigures {
    let program = reached.program.program();
    let (axes, is_kuka) = program.cell.as_ref().map_or((&[][..], false), |cell| {
        (&cell.axes[..], cell.maker == Maker::Kuka)
    });
    let demand = &reached.report.demand;
    let axes: Vec<AxisFigure> = axes
        .iter()
        .enumerate()
        .filter_map(|(index, axis)| {
            let (low, high) = (demand.low.get(index)?, demand.high.get(index)?);
            Some(axis_figure(program, axis, *low, *high, *demand.rate.get(index)?))
        })
        .collect();
    let kinds = [("wrist", "deg"), ("elbow", "deg"), ("shoulder", "mm")];
    let nearest = demand.clearance.iter().zip(demand.singular_shares());
    let singular: Vec<SingularFigure> = kinds
        .into_iter()
        .zip(nearest)
        .filter(|(_, (nearest, _))| nearest.value.is_finite())
        .map(|((kind, unit), (nearest, share))| SingularFigure {
            kind,
            unit,
            distance: match unit {
                "deg" => nearest.value.to_degrees(),
                _ => nearest.value,
            },
            share,
            at: place(program, nearest.op),
        })
        .collect();
    let axis_shares = axes
        .iter()
        .map(|axis| (axis.margin, axis.name.clone(), &axis.margin_at));
    let singular_shares = singular
        .iter()
        .map(|kind| (kind.share, kind.kind.to_owned(), &kind.at));
    let least = axis_shares
        .chain(singular_shares)
        .min_by(|(a, ..), (b, ..)| a.total_cmp(b))
        .map_or_else(
            || Least {
                of: String::new(),
                at: PlaceFigure {
                    op: 0,
                    words: String::new(),
                },
            },
            |(_, of, at)| Least { of, at: at.clone() },
        );
    ReachFigures {
        branches: branches(&reached.report.stretches, program.ops.len(), is_kuka),
        changes: reached.report.changes.len(),
        margin: reached.report.margin,
        least,
        slower: reached
            .report
            .slower
            .and_then(|slower| slower_figure(program, &slower)),
        axes,
        singular,
        solves: demand.solves,
    }
}

fn slower_figure(program: &Program, slower: &SlowerTurns) -> Option<SlowerFigure> {
    let (index, needed) = slower.too_slow;
    let axis = program.cell.as_ref()?.axes.get(index)?;
    let (lowest, op) = slower.lowest;
    Some(SlowerFigure {
        motions: slower.slower,
        of: slower.turning,
        lowest: lowest.to_deg_per_s(),
        at: place(program, op),
        axis: axis.name.clone(),
        unit: unit(axis.kind),
        needed: shown(axis.kind, needed),
        limit: axis.rate.map(|rate| shown(axis.kind, rate)),
    })
}

const fn unit(kind: AxisKind) -> &'static str {
    match kind {
        AxisKind::Rotary => "deg",
        AxisKind::Linear => "mm",
    }
}

/// A value of an axis in its unit.
fn shown(kind: AxisKind, value: f64) -> f64 {
    match kind {
        AxisKind::Rotary => value.to_degrees(),
        AxisKind::Linear => value,
    }
}

fn branches(stretches: &[Stretch], ops: usize, is_kuka: bool) -> Vec<BranchFigure> {
    let end = u32::try_from(ops).unwrap_or(u32::MAX);
    let ends = stretches.iter().skip(1).map(|next| next.from.0);
    stretches
        .iter()
        .zip(ends.chain(core::iter::once(end)))
        .map(|(stretch, end)| BranchFigure {
            op: stretch.from.0,
            ops: end.saturating_sub(stretch.from.0),
            words: branch_words(stretch.branch),
            is_numbered: matches!(stretch.branch, Branch::Numbered(_)),
            kuka_status: kuka_status(stretch.branch).filter(|_| is_kuka),
        })
        .collect()
}

fn axis_figure(program: &Program, axis: &Axis, low: Extreme, high: Extreme, rate: Extreme) -> AxisFigure {
    let shown = |value: f64| shown(axis.kind, value);
    let nearest = if low.value - axis.min < axis.max - high.value {
        low
    } else {
        high
    };
    AxisFigure {
        name: axis.name.clone(),
        unit: unit(axis.kind),
        low: shown(low.value),
        high: shown(high.value),
        min: shown(axis.min),
        max: shown(axis.max),
        margin: axis_margin(axis, low.value, high.value),
        margin_at: place(program, nearest.op),
        rate: shown(rate.value),
        rate_limit: axis.rate.map(shown),
        rate_at: place(program, rate.op),
    }
}

fn place(program: &Program, op: OpId) -> PlaceFigure {
    let words = program
        .ops
        .get(op.0 as usize)
        .map_or_else(String::new, |op| site_words(program, op.site));
    PlaceFigure { op: op.0, words }
}

impl AxisFigure {
    /// The share of its rate that is used, when its rate is known.
    #[must_use]
    pub fn rate_share(&self) -> Option<f64> {
        self.rate_limit.map(|limit| self.rate / limit)
    }
}
