//! Loops in loops: which are outlines, which islands, and which are given twice.

use super::{Drawn, Edge, Loop, RegionFault, Ring, toggles};
use crate::boxes::Dense;
use crate::place::Place;
use core::cmp::Ordering;

/// Most boxes that are looked at to nest loops: so many for each edge, and some more.
const MOST_PER_EDGE: usize = 1_000;
const MOST_AT_LEAST: usize = 10_000_000;

/// How many places of a loop are tried as one that lies off the others.
const TRIALS: usize = 8;

/// Rings without those that go the same way as an earlier one, or the same way back.
pub(super) fn without_repeats(rings: Vec<Ring>) -> Vec<Ring> {
    let keys: Vec<Vec<[f64; 3]>> = rings.iter().map(key).collect();
    let mut order: Vec<usize> = (0..rings.len()).collect();
    let compare = |one: &usize, other: &usize| match (keys.get(*one), keys.get(*other)) {
        (Some(one), Some(other)) => compare_keys(one, other),
        _ => Ordering::Equal,
    };
    order.sort_by(|one, other| compare(one, other).then(one.cmp(other)));
    order.dedup_by(|later, earlier| compare(later, earlier) == Ordering::Equal);
    order.sort_unstable();
    let mut kept = order.into_iter().peekable();
    let numbered = rings.into_iter().enumerate();
    let is_kept = |(number, ring)| kept.next_if_eq(&number).map(|_| ring);
    numbered.filter_map(is_kept).collect()
}

fn compare_keys(one: &[[f64; 3]], other: &[[f64; 3]]) -> Ordering {
    let mut pairs = one.iter().flatten().zip(other.iter().flatten());
    let first = pairs.find_map(|(a, b)| Some(a.total_cmp(b)).filter(|order| order.is_ne()));
    one.len().cmp(&other.len()).then(first.unwrap_or(Ordering::Equal))
}

/// The way of a ring, counter-clockwise from its least place: the same for all that go the same way.
fn key(ring: &Ring) -> Vec<[f64; 3]> {
    let mut edges = ring.edges.clone();
    if twice_area(&edges) < 0.0 {
        turn_round(&mut edges);
    }
    // No -0.
    let mut key: Vec<[f64; 3]> = edges
        .iter()
        .map(|edge| {
            [
                edge.piece.from.x + 0.0,
                edge.piece.from.y + 0.0,
                edge.piece.sweep + 0.0,
            ]
        })
        .collect();
    let least = (0..key.len()).min_by(|&a, &b| match (key.get(a), key.get(b)) {
        (Some(a), Some(b)) => a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])),
        _ => Ordering::Equal,
    });
    key.rotate_left(least.unwrap_or(0));
    key
}

fn twice_area(edges: &[Edge]) -> f64 {
    edges.iter().map(|edge| edge.piece.twice_area()).sum()
}

fn turn_round(edges: &mut Loop) {
    edges.reverse();
    for edge in edges {
        edge.piece = edge.piece.reversed();
    }
}

/// The loops with the region to their left.
pub(super) fn orientated(rings: Vec<Ring>, drawn: &Drawn) -> Result<Vec<Loop>, RegionFault> {
    let mut left = drawn.curves.len() * MOST_PER_EDGE + MOST_AT_LEAST;
    let depths: Result<Vec<bool>, Dense> = (0..rings.len())
        .map(|number| is_island(number, &rings, drawn, &mut left))
        .collect();
    let mut loops = Vec::with_capacity(rings.len());
    for (ring, is_island) in rings.into_iter().zip(depths?) {
        let mut edges = ring.edges;
        let area = twice_area(&edges);
        if area == 0.0 {
            let ring = ring.names.first().map_or(0, |name| name.ring);
            return Err(RegionFault::Flat { ring });
        }
        if (area < 0.0) != is_island {
            turn_round(&mut edges);
        }
        loops.push(edges);
    }
    Ok(loops)
}

/// Whether an odd number of other loops lies around one.
fn is_island(number: usize, rings: &[Ring], drawn: &Drawn, left: &mut usize) -> Result<bool, Dense> {
    let Some(place) = rings.get(number).map(|ring| apart(number, ring, drawn)) else {
        return Ok(false);
    };
    let mut is_inside = false;
    let looked_at = drawn.tree.along_ray(place, &mut |candidate| {
        let candidate = candidate as usize;
        let owner = drawn.owners.get(candidate).map(|owner| owner.0);
        if let Some(curve) = drawn.curves.get(candidate)
            && owner != Some(number)
        {
            is_inside ^= toggles(&curve.piece, place);
        }
    });
    *left = left.checked_sub(looked_at).ok_or(Dense)?;
    Ok(is_inside)
}

/// A place of a loop that lies off the others: loops touch in places only, so some of a few does.
fn apart(number: usize, ring: &Ring, drawn: &Drawn) -> Place {
    let step = (ring.edges.len() / TRIALS).max(1);
    let mut best = (f64::NEG_INFINITY, Place::new(0.0, 0.0));
    for edge in ring.edges.iter().step_by(step) {
        for share in [0.5, 0.3] {
            let place = edge.piece.at(share);
            let mut distance = f64::INFINITY;
            drawn.tree.around(place, distance, &mut |candidate| {
                let candidate = candidate as usize;
                let owner = drawn.owners.get(candidate).map(|owner| owner.0);
                if let Some(curve) = drawn.curves.get(candidate)
                    && owner != Some(number)
                {
                    distance = distance.min(curve.distance(place));
                }
                distance
            });
            if distance > best.0 {
                best = (distance, place);
            }
        }
    }
    best.1
}
