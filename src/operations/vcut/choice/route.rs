//! Order of the flanks and sequence of the Vs: all that the job leaves open, the fastest taken.

use super::bench::Bench;
use super::{MOST_CUTS_COMPARED, RouteSet, not_compared};
use crate::asked::{RoughVcut, Sequence};
use crate::plan::decision::{Candidate, Decision, Standing};
use crate::plan::{LaidOut, PlannedVcut};
use rayon::prelude::*;
use vcutc_backend_api::units::Duration;
use vcutc_job::{Auto, Order};

const ORDERS: [Order; 2] = [Order::Point, Order::Layer];

const SEQUENCES: [Sequence; 3] = [Sequence::Rows, Sequence::Boustrophedon, Sequence::Nearest];

/// A sequence with an order.
pub(super) type Route = (Sequence, Order);

/// The operation along its fastest route; the first among equals.
pub(super) fn best(bench: &Bench<'_>, laid: LaidOut) -> LaidOut {
    let along = |vcut: PlannedVcut, (sequence, order): Route| {
        vcut.along(order, sequence, bench.work().before, bench.job.stock)
    };
    let LaidOut {
        vcut,
        after,
        strategies,
    } = laid;
    let open = Open::of(&vcut.asked);
    let routes: Vec<Route> = routes(&vcut)
        .into_iter()
        .filter(|&route| allows(bench.latitude, &vcut.asked, route))
        .collect();
    let usual = usual_route(bench.latitude, &vcut.asked, Order::Point);
    let vcut = match (open, &routes[..]) {
        (Open::Nothing, _) => along(vcut, usual),
        (Open::Something(field), [only]) => match bench.latitude {
            RouteSet::Full => along(vcut, *only),
            RouteSet::ByPoint | RouteSet::RowsByPoint | RouteSet::ByLayer | RouteSet::RowsByLayer => {
                beyond_the_rest(along(vcut, *only), field, *only)
            }
        },
        (Open::Something(field), _) if vcut.cuts.len() > MOST_CUTS_COMPARED || bench.wanted.is_needless() => {
            let decision = not_compared(field, words(&vcut.asked, usual));
            remembering(along(vcut, usual), decision)
        }
        (Open::Something(field), _) => fastest(bench, vcut, field, &routes, along),
    };
    LaidOut {
        vcut,
        after,
        strategies,
    }
}

/// The operation along the route that is taken where nothing is compared, with the flanks in this order where that is open.
pub(super) fn usual(bench: &Bench<'_>, mut laid: LaidOut, order: Order) -> LaidOut {
    let (sequence, order) = usual_route(bench.latitude, &laid.vcut.asked, order);
    laid.vcut = laid
        .vcut
        .along(order, sequence, bench.work().before, bench.job.stock);
    laid
}

fn usual_route(latitude: RouteSet, asked: &RoughVcut, order: Order) -> Route {
    let sequence = match latitude {
        RouteSet::Full | RouteSet::ByPoint | RouteSet::ByLayer => Sequence::Boustrophedon,
        RouteSet::RowsByPoint | RouteSet::RowsByLayer => Sequence::Rows,
    };
    (
        asked.sequence.value.or(sequence),
        asked.order.value.or(latitude.order().unwrap_or(order)),
    )
}

/// Whether both orders of the flanks are considered.
pub(super) fn is_order_open(bench: &Bench<'_>, asked: &RoughVcut) -> bool {
    asked.order.value == Auto::Auto && bench.latitude.order().is_none()
}

/// Whether a route is one of those that are considered.
pub(super) fn allows(latitude: RouteSet, asked: &RoughVcut, (sequence, order): Route) -> bool {
    let is_ordered = latitude
        .order()
        .is_none_or(|only| order == only || asked.order.value != Auto::Auto);
    let in_rows = sequence == Sequence::Rows || asked.sequence.value != Auto::Auto;
    is_ordered
        && match latitude {
            RouteSet::Full | RouteSet::ByPoint | RouteSet::ByLayer => true,
            RouteSet::RowsByPoint | RouteSet::RowsByLayer => in_rows,
        }
}

/// Says that it came out so because the machine does not follow anything else.
fn beyond_the_rest(vcut: PlannedVcut, field: &'static str, route: Route) -> PlannedVcut {
    let taken = Candidate {
        what: words(&vcut.asked, route),
        standing: Standing::Last,
    };
    let others = Vec::new();
    remembering(vcut, Decision { field, taken, others })
}

fn fastest(
    bench: &Bench<'_>,
    vcut: PlannedVcut,
    field: &'static str,
    routes: &[Route],
    along: impl Fn(PlannedVcut, Route) -> PlannedVcut + Sync,
) -> PlannedVcut {
    let planned: Vec<(Route, PlannedVcut)> = routes
        .par_iter()
        .map(|&route| (route, along(vcut.clone(), route)))
        .collect();
    let mut different: Vec<(Route, PlannedVcut)> = Vec::new();
    for (route, planned) in planned {
        let same =
            |(_, known): &(Route, PlannedVcut)| (known.order, &known.runs) == (planned.order, &planned.runs);
        if !different.iter().any(same) {
            different.push((route, planned));
        }
    }
    let mut timed: Vec<(Candidate, PlannedVcut, Duration)> = different
        .into_par_iter()
        .filter_map(|(route, planned)| {
            let (standing, time) = bench.timed(&planned)?;
            let candidate = Candidate {
                what: words(&vcut.asked, route),
                standing,
            };
            Some((candidate, planned, time))
        })
        .collect();
    timed.sort_by(|(one, _, a), (other, _, b)| one.standing.compare(&other.standing).then(a.total_cmp(b)));
    let mut timed = timed.into_iter();
    let Some((taken, planned, _)) = timed.next() else {
        return vcut;
    };
    let left_out = left_out(bench.latitude, &vcut.asked);
    let others: Vec<Candidate> = timed.map(|(candidate, ..)| candidate).chain(left_out).collect();
    if others.is_empty() {
        return planned;
    }
    remembering(planned, Decision { field, taken, others })
}

/// The order that is not considered because the machine does not follow the best plan that has it.
fn left_out(latitude: RouteSet, asked: &RoughVcut) -> Option<Candidate> {
    let only = latitude.order().filter(|_| asked.order.value == Auto::Auto)?;
    Some(Candidate {
        what: format!("by {}", only.other().word()),
        standing: Standing::LeftOut,
    })
}

fn remembering(mut vcut: PlannedVcut, decision: Decision) -> PlannedVcut {
    vcut.decisions.push(decision);
    vcut
}

/// What of the route is open.
#[derive(Clone, Copy)]
enum Open {
    Nothing,
    /// The field that the decision is reported for.
    Something(&'static str),
}

impl Open {
    const fn of(asked: &RoughVcut) -> Self {
        match (asked.sequence.value, asked.order.value) {
            (Auto::Given(_), Auto::Given(_)) => Self::Nothing,
            (Auto::Given(_), Auto::Auto) => Self::Something("order"),
            (Auto::Auto, _) => Self::Something("sequence"),
        }
    }
}

/// The routes that the operation leaves open. Those that come out as another are found by their runs.
fn routes(vcut: &PlannedVcut) -> Vec<Route> {
    let sequences: Vec<Sequence> = match vcut.asked.sequence.value {
        Auto::Given(sequence) => vec![sequence],
        Auto::Auto => SEQUENCES.to_vec(),
    };
    let orders: Vec<Order> = match vcut.asked.order.value {
        Auto::Given(order) => vec![order],
        Auto::Auto => ORDERS.to_vec(),
    };
    let with_orders = |sequence| orders.iter().map(move |&order| (sequence, order));
    sequences.into_iter().flat_map(with_orders).collect()
}

/// A route as far as it was open: `boustrophedon by point`.
fn words(asked: &RoughVcut, (sequence, order): Route) -> String {
    let (sequence, order) = (sequence.word(), order.word());
    match (asked.sequence.value, asked.order.value) {
        (Auto::Auto, Auto::Given(_)) => sequence.to_owned(),
        (Auto::Given(_), Auto::Auto) => order.to_owned(),
        (Auto::Auto, Auto::Auto) | (Auto::Given(_), Auto::Given(_)) => format!("{sequence} by {order}"),
    }
}
