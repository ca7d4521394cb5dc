//! Boxes around things of the plan, and a static tree of them: what lies near a place, and which things lie beside each other.
//!
//! Things are halved by the middles of their boxes along the longer side, until few are left. Searches pass over halves with all
//! that they hold. Searches for pairs and along rays have a budget: things that lie across each other without end would take the
//! square of the work.

use crate::place::Place;

/// How many things a leaf of the tree holds.
const LEAF: usize = 4;

/// Most boxes that are compared in a search for pairs: so many for each thing, and some more.
const MOST_PER_THING: usize = 200;
const MOST_AT_LEAST: usize = 1_000_000;

/// A box with sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The corner of the least coordinates.
    pub low: Place,
    /// The corner of the greatest.
    pub high: Place,
}

impl Extent {
    /// The smallest box around two places.
    #[must_use]
    pub fn of(one: Place, other: Place) -> Self {
        Self {
            low: Place::new(one.x.min(other.x), one.y.min(other.y)),
            high: Place::new(one.x.max(other.x), one.y.max(other.y)),
        }
    }

    /// The smallest box around both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            low: Place::new(self.low.x.min(other.low.x), self.low.y.min(other.low.y)),
            high: Place::new(self.high.x.max(other.high.x), self.high.y.max(other.high.y)),
        }
    }

    /// The box that reaches so much farther to all sides, in mm.
    #[must_use]
    pub fn grown(self, by: f64) -> Self {
        Self {
            low: Place::new(self.low.x - by, self.low.y - by),
            high: Place::new(self.high.x + by, self.high.y + by),
        }
    }

    /// Whether both have a place in common.
    #[must_use]
    pub fn meets(self, other: Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
    }

    /// The square of the distance to a place, in mm2: 0 within.
    #[must_use]
    pub fn squared_distance(self, place: Place) -> f64 {
        let x = (self.low.x - place.x).max(place.x - self.high.x).max(0.0);
        let y = (self.low.y - place.y).max(place.y - self.high.y).max(0.0);
        x * x + y * y
    }

    /// The place in its middle.
    #[must_use]
    pub fn middle(self) -> Place {
        self.low.lerp(self.high, 0.5)
    }

    /// Whether a ray from a place towards greater x may meet what is in the box.
    fn meets_ray(self, from: Place) -> bool {
        self.low.y <= from.y && from.y <= self.high.y && from.x <= self.high.x
    }
}

/// More boxes meet than are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dense;

/// A tree over things that are known by their numbers.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    nodes: Vec<Node>,
    /// The things, leaf by leaf.
    things: Vec<(u32, Extent)>,
}

/// A node; its first half follows it.
#[derive(Clone, Copy, Debug)]
struct Node {
    extent: Extent,
    content: Content,
}

#[derive(Clone, Copy, Debug)]
enum Content {
    /// Things from a place in their list on, so many.
    Things(u32, u32),
    /// Where the second half is.
    Halves(u32),
}

impl Tree {
    /// The tree over boxes; each is known by its place in their list.
    #[must_use]
    pub fn of(extents: &[Extent]) -> Self {
        let mut tree = Self::default();
        tree.rebuild(extents);
        tree
    }

    /// The same, with the memory of an earlier tree.
    pub fn rebuild(&mut self, extents: &[Extent]) {
        self.nodes.clear();
        self.things.clear();
        let numbered = (0..u32::MAX).zip(extents.iter().copied());
        self.things.extend(numbered);
        let mut things = core::mem::take(&mut self.things);
        self.build(&mut things, 0);
        self.things = things;
    }

    /// Builds the nodes over things from `first` on. Halving bounds the depth.
    fn build(&mut self, things: &mut [(u32, Extent)], first: u32) {
        let boxes = things.iter().map(|&(_, extent)| extent);
        let Some(extent) = boxes.reduce(Extent::with) else {
            return;
        };
        if things.len() <= LEAF {
            let content = Content::Things(first, things.len() as u32);
            self.nodes.push(Node { extent, content });
            return;
        }
        let is_wide = extent.high.x - extent.low.x >= extent.high.y - extent.low.y;
        let rank = |thing: &(u32, Extent)| {
            let middle = thing.1.middle();
            if is_wide { middle.x } else { middle.y }
        };
        let half = things.len() / 2;
        things.select_nth_unstable_by(half, |a, b| rank(a).total_cmp(&rank(b)).then(a.0.cmp(&b.0)));
        let here = self.nodes.len();
        let content = Content::Halves(0);
        self.nodes.push(Node { extent, content });
        let (one, other) = things.split_at_mut(half);
        self.build(one, first);
        let second = self.nodes.len() as u32;
        if let Some(node) = self.nodes.get_mut(here) {
            node.content = Content::Halves(second);
        }
        self.build(other, first + half as u32);
    }

    /// The box around all things.
    #[must_use]
    pub fn extent(&self) -> Option<Extent> {
        self.nodes.first().map(|node| node.extent)
    }

    fn leaf(&self, first: u32, count: u32) -> &[(u32, Extent)] {
        let first = first as usize;
        self.things.get(first..first + count as usize).unwrap_or(&[])
    }

    /// Shows things that may lie within a distance of a place, in mm; `visit` looks at one and returns the distance within
    /// which the search goes on. Near halves come first, so that the search for the nearest thing looks at few.
    pub fn around(&self, place: Place, within: f64, visit: &mut dyn FnMut(u32) -> f64) {
        self.around_node(0, place, within * within, visit);
    }

    fn around_node(&self, at: u32, place: Place, limit: f64, visit: &mut dyn FnMut(u32) -> f64) -> f64 {
        let mut limit = limit;
        match self.nodes.get(at as usize).map(|node| node.content) {
            Some(Content::Things(first, count)) => {
                for &(thing, extent) in self.leaf(first, count) {
                    if extent.squared_distance(place) <= limit {
                        let within = visit(thing);
                        limit = limit.min(within * within.abs());
                    }
                }
            }
            Some(Content::Halves(second)) => {
                let away = |at: u32| {
                    let node = self.nodes.get(at as usize);
                    node.map_or(f64::INFINITY, |node| node.extent.squared_distance(place))
                };
                let (first, one, other) = (at + 1, away(at + 1), away(second));
                let order = if other < one {
                    [(second, other), (first, one)]
                } else {
                    [(first, one), (second, other)]
                };
                for (half, away) in order {
                    if away <= limit {
                        limit = self.around_node(half, place, limit, visit);
                    }
                }
            }
            None => {}
        }
        limit
    }

    /// Shows all things whose boxes meet a box.
    pub fn meeting(&self, extent: Extent, visit: &mut dyn FnMut(u32)) {
        self.select(&|candidate| candidate.meets(extent), visit);
    }

    /// Shows all things that a ray from a place towards greater x may meet; returns how many boxes it looked at.
    pub fn along_ray(&self, from: Place, visit: &mut dyn FnMut(u32)) -> usize {
        self.select(&|candidate| candidate.meets_ray(from), visit)
    }

    fn select(&self, is_wanted: &dyn Fn(Extent) -> bool, visit: &mut dyn FnMut(u32)) -> usize {
        let mut looked_at = 0;
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            looked_at += 1;
            match self.nodes.get(at as usize) {
                Some(node) if is_wanted(node.extent) => match node.content {
                    Content::Things(first, count) => {
                        for &(thing, extent) in self.leaf(first, count) {
                            if is_wanted(extent) {
                                visit(thing);
                            }
                        }
                    }
                    Content::Halves(second) => open.extend([second, at + 1]),
                },
                _ => {}
            }
        }
        looked_at
    }

    /// The first pair of which `found` makes something, among all pairs of things whose boxes, grown by so much, meet. Each pair
    /// is shown once, the lesser number first, always in the same order.
    ///
    /// # Errors
    /// Too many boxes meet.
    pub fn first_pair<T>(
        &self,
        slack: f64,
        found: &mut dyn FnMut(u32, u32) -> Option<T>,
    ) -> Result<Option<T>, Dense> {
        let mut left = self.things.len().saturating_mul(MOST_PER_THING) + MOST_AT_LEAST;
        let mut open = vec![(0_u32, 0_u32)];
        while let Some((one, other)) = open.pop() {
            left = left.checked_sub(1).ok_or(Dense)?;
            let nodes = self.nodes.get(one as usize).zip(self.nodes.get(other as usize));
            let Some((a, b)) = nodes.filter(|(a, b)| a.extent.grown(slack).meets(b.extent)) else {
                continue;
            };
            match (a.content, b.content) {
                (Content::Things(first, count), Content::Things(begin, size)) => {
                    let (first, second) = (self.leaf(first, count), self.leaf(begin, size));
                    left = left.checked_sub(first.len() * second.len()).ok_or(Dense)?;
                    for (&(i, box_i), &(j, box_j)) in
                        first.iter().flat_map(|i| second.iter().map(move |j| (i, j)))
                    {
                        let is_pair = one != other || i < j;
                        if is_pair && box_i.grown(slack).meets(box_j) {
                            let result = found(i.min(j), i.max(j));
                            if result.is_some() {
                                return Ok(result);
                            }
                        }
                    }
                }
                (Content::Halves(second), _) if one == other => {
                    open.extend([(one + 1, one + 1), (second, second), (one + 1, second)]);
                }
                (Content::Halves(second), _) => open.extend([(one + 1, other), (second, other)]),
                (Content::Things(..), Content::Halves(second)) => {
                    open.extend([(one, other + 1), (one, second)]);
                }
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn searches_show_what_they_shall(
            corners in prop::collection::vec((-9..9i32, -9..9i32, 0..4i32, 0..4i32), 0..60),
            (px, py) in (-9..9i32, -9..9i32),
        ) {
            let at = |x: i32, y: i32| Place::new(f64::from(x), f64::from(y));
            let extents: Vec<Extent> = corners
                .iter()
                .map(|&(x, y, w, h)| Extent::of(at(x, y), at(x + w, y + h)))
                .collect();
            let tree = Tree::of(&extents);
            let mut shown = Vec::new();
            let none: Option<()> = tree.first_pair(0.0, &mut |i, j| {
                shown.push((i, j));
                None
            }).unwrap();
            prop_assert!(none.is_none());
            shown.sort_unstable();
            let mut expected = Vec::new();
            for (j, &(x, y, w, h)) in (0..).zip(&corners) {
                for (i, &(p, q, v, g)) in (0..j).zip(&corners) {
                    if x <= p + v && p <= x + w && y <= q + g && q <= y + h {
                        expected.push((i, j));
                    }
                }
            }
            expected.sort_unstable();
            prop_assert_eq!(shown, expected);

            let place = at(px, py);
            let mut nearest = f64::INFINITY;
            tree.around(place, nearest, &mut |thing| {
                nearest = nearest.min(extents[thing as usize].squared_distance(place).sqrt());
                nearest
            });
            let all = extents.iter().map(|extent| extent.squared_distance(place).sqrt());
            prop_assert_eq!(nearest, all.fold(f64::INFINITY, f64::min));
        }
    }

    #[test]
    fn things_that_all_lie_on_each_other_end_the_search() {
        let extents = vec![Extent::of(Place::new(0.0, 0.0), Place::new(1.0, 1.0)); 20_000];
        let searched: Result<Option<()>, Dense> = Tree::of(&extents).first_pair(0.0, &mut |_, _| None);
        assert_eq!(searched, Err(Dense));
    }
}
