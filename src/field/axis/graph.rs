//! The axis as a graph of branch points and ends.

use super::{Branch, segment};
use crate::source::Segment;
use crate::touch::Circle;
use vcutc_region::place::Place;

/// Ends of branches so near, in mm, are one node. Walls that are nearly tangent have branches between them as short as that:
/// they are left out.
const SAME_NODE: f64 = 1e-4;

/// The simplified axis: between nodes that are not mere changes of the wall, one straight piece, or two where
/// the axis is off it by more than the tolerance.
pub(super) fn simplified(branches: &[Branch], tolerance: f64) -> Vec<Segment> {
    let is_long = |branch: &&Branch| {
        branch
            .windows(2)
            .filter_map(segment)
            .map(|piece| piece.length())
            .sum::<f64>()
            > 2.0 * SAME_NODE
    };
    let branches: Vec<Branch> = branches.iter().filter(is_long).cloned().collect();
    let graph = Graph::new(&branches);
    let mut chains = Chains {
        graph: &graph,
        branches: &branches,
        is_used: vec![false; branches.len()],
    };
    let mut segments = Vec::new();
    // From ends and branch points first. What is left then are rings, which are taken branch by branch.
    for (number, node) in graph.nodes.iter().enumerate() {
        if node.branches.len() != 2 {
            for &branch in &node.branches {
                if let Some(chain) = chains.follow(number, branch) {
                    straighten(&chain, tolerance, &mut segments);
                }
            }
        }
    }
    for (branch, is_used) in branches.iter().zip(&chains.is_used) {
        if !is_used {
            straighten(branch, tolerance, &mut segments);
        }
    }
    segments
}

/// A place where branches meet, with their numbers; a branch that is a ring is there twice.
struct Node {
    place: Place,
    branches: Vec<usize>,
}

struct Graph {
    nodes: Vec<Node>,
    /// The nodes at the beginning and at the end of every branch.
    ends: Vec<[usize; 2]>,
}

impl Graph {
    fn new(branches: &[Branch]) -> Self {
        let mut graph = Self {
            nodes: Vec::new(),
            ends: Vec::new(),
        };
        for (number, branch) in branches.iter().enumerate() {
            let place = |circle: Option<&Circle>| circle.map_or(Place::new(0.0, 0.0), |circle| circle.centre);
            let from = graph.node(place(branch.first()), number);
            let to = graph.node(place(branch.last()), number);
            graph.ends.push([from, to]);
        }
        graph
    }

    /// The node at a place, which a branch ends in.
    fn node(&mut self, place: Place, branch: usize) -> usize {
        let is_here = |node: &Node| node.place.distance(place) < SAME_NODE;
        let found = self.nodes.iter().position(is_here).unwrap_or(self.nodes.len());
        match self.nodes.get_mut(found) {
            Some(node) => node.branches.push(branch),
            None => self.nodes.push(Node {
                place,
                branches: vec![branch],
            }),
        }
        found
    }
}

struct Chains<'a> {
    graph: &'a Graph,
    branches: &'a [Branch],
    is_used: Vec<bool>,
}

impl Chains<'_> {
    /// The circles from a node along a branch up to the next node that ends a chain; none where it was gone before.
    fn follow(&mut self, start: usize, first: usize) -> Option<Branch> {
        let mut chain = Branch::new();
        let (mut at, mut branch) = (start, first);
        loop {
            let is_used = self.is_used.get_mut(branch)?;
            if core::mem::replace(is_used, true) {
                break;
            }
            let &[from, to] = self.graph.ends.get(branch)?;
            let circles = self.branches.get(branch)?;
            if at == from {
                chain.extend(circles);
                at = to;
            } else {
                chain.extend(circles.iter().rev());
                at = from;
            }
            let node = self.graph.nodes.get(at)?;
            let &[one, other] = node.branches.as_slice() else {
                break;
            };
            branch = if one == branch { other } else { one };
        }
        (!chain.is_empty()).then_some(chain)
    }
}

/// One straight piece along a chain, or two that meet in its middle.
fn straighten(chain: &[Circle], tolerance: f64, segments: &mut Vec<Segment>) {
    let (Some(&first), Some(&last)) = (chain.first(), chain.last()) else {
        return;
    };
    let is_straight = chain
        .iter()
        .all(|circle| super::off_chord(&first, circle, &last) <= tolerance);
    let middle = if is_straight { None } else { halfway(chain) };
    let ends = [Some(first), middle, Some(last)];
    let ends: Vec<Circle> = ends.into_iter().flatten().collect();
    segments.extend(
        ends.windows(2)
            .filter_map(segment)
            .filter(|piece| piece.length() > super::POINT),
    );
}

/// The circle after half of the length of a chain.
fn halfway(chain: &[Circle]) -> Option<Circle> {
    let lengths = chain.windows(2).filter_map(segment).map(|piece| piece.length());
    let half = lengths.clone().sum::<f64>() / 2.0;
    let mut gone = 0.0;
    for (length, circle) in lengths.zip(chain.iter().skip(1)) {
        gone += length;
        if gone >= half {
            return Some(*circle);
        }
    }
    None
}
