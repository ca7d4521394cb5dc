//! Whether a disc enters a surface, in its poses and on its way between them.
//!
//! Poses are looked at by exact drops, moves by a bound that holds at every moment ([`Moves::between`]). A controller that does
//! not stop where pieces of a chain meet leaves the way there by the blend of the program, which comes on top, measured along z:
//! `sqrt(1 + g^2)` times, with the steepest slope g of the part below the disc.

use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Blade, Shape};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_surface::disc::{Axis, Disc, Pose, Stage};
use vcutc_surface::gouge::{Entry, Moves, Placed};

/// Nothing of a body is longer: beyond the largest stock.
const LONGEST: Length = Length::mm(1e4);

/// The disc of a blade with its body, for surfaces; none for other blades.
#[must_use]
pub fn solid(blade: &Blade) -> Option<Disc> {
    let Shape::Disc(edge) = blade.shape else {
        return None;
    };
    let body = blade.body.as_deref().unwrap_or_default();
    let ends = body.iter().skip(1).map(|next| next.from).chain([LONGEST]);
    let stages = body.iter().zip(ends).filter(|(stage, to)| stage.from < *to);
    let stages = stages.map(|(stage, to)| Stage {
        radius: stage.radius,
        from: stage.from,
        to,
    });
    Disc::new(edge.radius, stages.collect()).ok()
}

/// By how much a tool turns from each of these orientations to the next one.
#[must_use]
pub fn turns(held: &[Orientation]) -> Vec<Angle> {
    let pairs = held.iter().zip(held.iter().skip(1));
    pairs.map(|(from, to)| from.angle_to(*to)).collect()
}

/// How deep a disc may enter the surface on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deepest {
    /// Along z, at most; 0 where it enters nothing.
    pub depth: Length,
    /// The number of the pose before the place, in the order of the way.
    pub after: usize,
    /// The pose there.
    pub pose: Pose,
}

/// Moves up to this length are not halved to see more of them, in mm. Where the edge comes to a side of the plan, the bound is that of
/// its plane, which falls by the lead over the length of the move.
const SHORT: f64 = 0.1;

/// How often a move is halved at most.
const HALVINGS: u32 = 10;

/// The bound on a move; on both halves of it where it is not small enough, because a bound falls with the
/// square of the length.
fn bounded(
    moves: &Moves<'_, '_>,
    disc: &Disc,
    [from, to]: [&Placed; 2],
    turn: Angle,
    enough: Length,
    halvings: u32,
) -> Entry {
    let entry = moves.between(disc, [from, to], turn, enough);
    let [a, b] = [from, to].map(|end| end.pose().centre);
    if entry.depth <= enough || halvings == 0 || a.distance(b).to_mm() <= SHORT {
        return entry;
    }
    let middle = middle(from.pose(), to.pose()).and_then(|pose| moves.place(disc, pose));
    let Some(middle) = middle else { return entry };
    let [first, second] = [[from, &middle], [&middle, to]]
        .map(|half| bounded(moves, disc, half, turn * 0.5, enough, halvings - 1));
    let slope = first.slope.max(second.slope);
    let deeper = if first.depth >= second.depth {
        first
    } else {
        second
    };
    Entry { slope, ..deeper }
}

/// The pose halfway between two: the centre goes evenly, and the axis turns evenly.
fn middle(from: Pose, to: Pose) -> Option<Pose> {
    let half = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { core::array::from_fn(|i| f64::midpoint(a[i], b[i])) };
    Some(Pose {
        centre: half(from.centre.to_array(), to.centre.to_array()).into(),
        // Of two vectors of length 1 the sum lies halfway.
        axis: Axis::new(half(from.axis.to_array(), to.axis.to_array()))?,
    })
}

/// The bound over all poses of a way and all moves between them, on which the whole tool turns by `turns`, about its own axis too. A move that is bounded by less than `enough` is not looked at
/// more closely. None without poses, or with one that is not finite.
#[must_use]
pub fn deepest(
    moves: &Moves<'_, '_>,
    disc: &Disc,
    poses: &[Pose],
    turns: &[Angle],
    [enough, blend]: [Length; 2],
) -> Option<Deepest> {
    let placed: Option<Vec<Placed>> = poses.iter().map(|pose| moves.place(disc, *pose)).collect();
    let placed = placed?;
    let first = placed.first()?;
    let mut deepest = Deepest {
        depth: Length::ZERO,
        after: 0,
        pose: first.pose(),
    };
    let mut note = |after: usize, pose: Pose, depth: Length| {
        if depth > deepest.depth {
            deepest = Deepest { depth, after, pose };
        }
    };
    for (number, one) in placed.iter().enumerate() {
        note(number, one.pose(), one.depth().unwrap_or(Length::ZERO));
    }
    let pairs = placed.iter().zip(placed.iter().skip(1)).zip(turns);
    for (number, ((from, to), turn)) in pairs.enumerate() {
        let entry = bounded(moves, disc, [from, to], *turn, enough, HALVINGS);
        let aside = blend * (1.0 + entry.slope * entry.slope).sqrt();
        let is_over_part = from.depth().is_some() || to.depth().is_some() || entry.depth > Length::ZERO;
        if is_over_part {
            note(number, from.pose(), entry.depth + aside);
        }
    }
    Some(deepest)
}
