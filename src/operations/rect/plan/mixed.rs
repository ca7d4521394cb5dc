//! *Mixed*: at every place what keeps the limit on scallop with the fewest strips.
//!
//! A column is cut on its own, as far as the material that stays on the part over it goes: some of its whole layers, all of them
//! and a strip lifted onto the part, or all of them and some strips up to the part. What a column leaves does not depend on the
//! others, so the fewest strips of each are the fewest of all. Whether they can be freed does depend on the others. So this is
//! one of several layouts, and the strategies that do the same everywhere are the others; they are handed over in the order in
//! which they are to be tried.

use super::blades::TOUCH;
use super::ground::Ground;
use super::layout::{Column, Layout, Piece};
use super::slits::Through;

/// A limit on what may stay, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerated(pub(crate) f64);

/// Shares of the limit that are tolerated one after the other: the fewest strips within a limit may stand in each other's way where a few
/// more do not.
const TIGHTER: [f64; 4] = [1.0, 0.85, 0.7, 0.5];

impl Tolerated {
    fn holds(self, left: f64) -> bool {
        left <= self.0 + TOUCH
    }
}

/// The layouts from the best one on: those that keep the limit, by their strips; then the others, by what they leave.
pub(crate) fn layouts(ground: &Ground<'_>, tolerated: Tolerated, through: Through) -> Vec<Layout> {
    let fewest_within = TIGHTER.map(|share| {
        let tolerated = Tolerated(tolerated.0 * share);
        Layout::of_columns(ground, |column| fewest(column, tolerated, through))
    });
    let mut all = Vec::from(fewest_within);
    all.extend([
        Layout::of_columns(ground, |column| lifted_or_not(column, tolerated)),
        Layout::discard(ground),
        Layout::lift(ground),
    ]);
    if through == Through::One {
        all.push(Layout::shift(ground));
    }
    let mut judged: Vec<(Layout, f64)> = all
        .into_iter()
        .map(|layout| {
            let left = ground.left_by(&layout.after(ground).corners(0.0, ground.width));
            (layout, left)
        })
        .collect();
    judged.sort_by(|(one, left), (other, leaves)| {
        let kept = tolerated.holds(*leaves).cmp(&tolerated.holds(*left));
        let strips = one.pieces.len().cmp(&other.pieces.len());
        let by_rest = left.total_cmp(leaves);
        if tolerated.holds(*left) {
            kept.then(strips).then(by_rest)
        } else {
            kept.then(by_rest).then(strips)
        }
    });
    judged.into_iter().map(|(layout, _)| layout).collect()
}

/// The fewest strips of a column that keep the limit; where none do, what leaves the least without more strips than a lifted one.
fn fewest(column: &Column<'_, '_>, tolerated: Tolerated, through: Through) -> Vec<Piece> {
    let lifted = column.lifted();
    let most = lifted.len();
    let mut judged: Vec<(Vec<Piece>, f64)> = Vec::new();
    let mut judge = |pieces: Vec<Piece>| {
        let left = column.left_by(&pieces);
        judged.push((pieces, left));
        tolerated.holds(left)
    };
    judge(lifted);
    // Fewer layers leave more, and more strips at the part leave less.
    for count in (0..=column.whole()).rev() {
        if !judge(column.layers(count)) {
            break;
        }
    }
    if through == Through::One {
        for more in 1..=column.below() {
            if judge(column.shifted(more)) {
                break;
            }
        }
    }
    let kept = judged.iter().filter(|(_, left)| tolerated.holds(*left));
    let best = kept.min_by(|(one, left), (other, leaves)| {
        let strips = one.len().cmp(&other.len());
        strips.then(left.total_cmp(leaves))
    });
    let few = judged.iter().filter(|(pieces, _)| pieces.len() <= most);
    let least = few.min_by(|(_, left), (_, leaves)| left.total_cmp(leaves));
    best.or(least)
        .map(|(pieces, _)| pieces.clone())
        .unwrap_or_default()
}

/// The whole layers where they keep the limit, else with a lifted strip: no column stands in the way of its neighbours.
fn lifted_or_not(column: &Column<'_, '_>, tolerated: Tolerated) -> Vec<Piece> {
    let pieces = column.whole_layers();
    if tolerated.holds(column.left_by(&pieces)) {
        pieces
    } else {
        column.lifted()
    }
}
