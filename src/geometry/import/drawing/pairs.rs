//! Which of many things lie beside each other: a tree of boxes, and all pairs of things whose boxes meet.
//!
//! Things are halved by the middles of their boxes along the longer side, until few are left. Halves whose boxes do not
//! meet are passed over with all that they hold, so that an outline takes time in proportion to its segments. Things that
//! lie across each other's boxes without end would take the square of it; the work is bounded, and nothing is
//! reported of pairs beyond ([`Dense`]).

use crate::point::Point2;

/// Most boxes that are compared: so many for each thing, and some more.
const MOST_PER_THING: usize = 100;
const MOST_AT_LEAST: usize = 1_000_000;

/// How many things a leaf of the tree holds.
const LEAF: usize = 4;

/// A box that holds a thing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    low: Point2,
    high: Point2,
}

impl Extent {
    /// The smallest box around two points.
    pub(super) fn of(one: Point2, other: Point2) -> Self {
        Self {
            low: Point2::new(one.x.min(other.x), one.z.min(other.z)),
            high: Point2::new(one.x.max(other.x), one.z.max(other.z)),
        }
    }

    /// The smallest box around both.
    fn with(self, other: Self) -> Self {
        Self {
            low: Self::of(self.low, other.low).low,
            high: Self::of(self.high, other.high).high,
        }
    }

    /// The box that reaches so much farther to all sides.
    pub(super) fn grown(self, by: f64) -> Self {
        Self {
            low: Point2::new(self.low.x - by, self.low.z - by),
            high: Point2::new(self.high.x + by, self.high.z + by),
        }
    }

    /// Whether both have a point in common.
    pub(super) fn meets(self, other: Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.z <= other.high.z
            && other.low.z <= self.high.z
    }

    fn middle(self) -> Point2 {
        self.low.lerp(self.high, 0.5)
    }
}

/// More boxes meet than are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dense;

/// The first pair of which `found` makes something, among all pairs of things whose boxes meet. Each pair is shown
/// once, the earlier thing first, always in the same order.
///
/// # Errors
/// Too many boxes meet.
pub(super) fn first_pair<T>(
    extents: &[Extent],
    found: &mut dyn FnMut(usize, usize) -> Option<T>,
) -> Result<Option<T>, Dense> {
    let mut order: Vec<usize> = (0..extents.len()).collect();
    let mut nodes = Vec::new();
    let Some(root) = build(extents, &mut order, &mut nodes) else {
        return Ok(None);
    };
    let mut left = extents.len().saturating_mul(MOST_PER_THING) + MOST_AT_LEAST;
    let mut open = vec![(root, root)];
    while let Some((one, other)) = open.pop() {
        left = left.checked_sub(1).ok_or(Dense)?;
        let (a, b) = (&nodes[one], &nodes[other]);
        if !a.extent.meets(b.extent) {
            continue;
        }
        match (&a.content, &b.content) {
            (Content::Things(first), Content::Things(second)) => {
                left = left.checked_sub(first.len() * second.len()).ok_or(Dense)?;
                for (&i, &j) in first.iter().flat_map(|i| second.iter().map(move |j| (i, j))) {
                    let is_pair = one != other || i < j;
                    if is_pair && extents[i].meets(extents[j]) {
                        let result = found(i.min(j), i.max(j));
                        if result.is_some() {
                            return Ok(result);
                        }
                    }
                }
            }
            (Content::Halves(first, second), _) if one == other => {
                open.extend([(*first, *first), (*second, *second), (*first, *second)]);
            }
            (Content::Halves(first, second), _) => open.extend([(*first, other), (*second, other)]),
            (Content::Things(_), Content::Halves(first, second)) => {
                open.extend([(one, *first), (one, *second)]);
            }
        }
    }
    Ok(None)
}

struct Node {
    extent: Extent,
    content: Content,
}

enum Content {
    Things(Vec<usize>),
    Halves(usize, usize),
}

/// Builds the tree over the things of `order`; none when there are none. Halving bounds its depth.
fn build(extents: &[Extent], order: &mut [usize], nodes: &mut Vec<Node>) -> Option<usize> {
    let extent = order.iter().map(|&thing| extents[thing]).reduce(Extent::with)?;
    let content = if order.len() <= LEAF {
        order.sort_unstable();
        Content::Things(order.to_vec())
    } else {
        let is_wide = extent.high.x - extent.low.x >= extent.high.z - extent.low.z;
        let rank = |thing: &usize| {
            let middle = extents[*thing].middle();
            if is_wide { middle.x } else { middle.z }
        };
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, |a, b| rank(a).total_cmp(&rank(b)).then(a.cmp(b)));
        let (first, second) = order.split_at_mut(half);
        let first = build(extents, first, nodes)?;
        let second = build(extents, second, nodes)?;
        Content::Halves(first, second)
    };
    nodes.push(Node { extent, content });
    Some(nodes.len() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn all_pairs_that_meet_are_shown_once(
            corners in prop::collection::vec((-9..9i32, -9..9i32, 0..4i32, 0..4i32), 0..60),
        ) {
            let at = |x: i32, z: i32| Point2::new(f64::from(x), f64::from(z));
            let extents: Vec<Extent> = corners
                .iter()
                .map(|&(x, z, w, h)| Extent::of(at(x, z), at(x + w, z + h)))
                .collect();
            let mut shown = Vec::new();
            let none: Option<()> = first_pair(&extents, &mut |i, j| {
                shown.push((i, j));
                None
            }).unwrap();
            prop_assert!(none.is_none());
            shown.sort_unstable();
            let mut expected = Vec::new();
            for (j, &(x, z, w, h)) in corners.iter().enumerate() {
                for (i, &(p, q, v, g)) in corners.iter().enumerate().take(j) {
                    if x <= p + v && p <= x + w && z <= q + g && q <= z + h {
                        expected.push((i, j));
                    }
                }
            }
            expected.sort_unstable();
            prop_assert_eq!(shown, expected);
        }
    }

    #[test]
    fn things_that_all_lie_on_each_other_end_the_search() {
        let extents = vec![Extent::of(Point2::new(0.0, 0.0), Point2::new(1.0, 1.0)); 20_000];
        let searched: Result<Option<()>, Dense> = first_pair(&extents, &mut |_, _| None);
        assert_eq!(searched, Err(Dense));
    }
}
