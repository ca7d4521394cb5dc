//! The upper envelope of segments in x-z.
//!
//! Envelopes of halves are merged (Hershberger: Finding the upper envelope of n line segments in O(n log n) time, 1989, says
//! how large they get). A piece of an envelope keeps the segment that it is of, so that heights never drift however
//! often a piece is cut. Where two segments change places is computed in one way for the same segments in the same order.

use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::{Profile, height_between};

/// Steps in x that a profile cannot hold are drawn this wide, in mm, or a few times the resolution of a double where that
/// is coarser.
fn narrow(x: f64) -> f64 {
    (x.abs() * 4e-15).max(2e-9)
}

/// A segment from its lesser x to its greater x.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment {
    from: Point2,
    to: Point2,
}

impl Segment {
    fn height(self, x: f64) -> f64 {
        height_between(self.from, self.to, x)
    }
}

/// The part of a segment between two x.
#[derive(Clone, Copy, Debug)]
struct Piece {
    segment: Segment,
    start: f64,
    end: f64,
}

/// The upper envelope of segments: a height over x, with steps and gaps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Envelope {
    /// From left to right, without overlap.
    pieces: Vec<Piece>,
    /// Points above all pieces, from left to right: upper ends of segments that stand upright.
    spikes: Vec<Point2>,
}

/// Ranges of x over which an envelope has no height.
pub(crate) type Holes = Vec<[f64; 2]>;

impl Envelope {
    /// The upper envelope of segments, each with either end first. Of equal heights that of the earlier segment counts.
    pub(crate) fn of(segments: impl Iterator<Item = [Point2; 2]>) -> Self {
        let mut upright = Vec::new();
        // Envelopes of 2^rank segments, as the digits of a binary number: equal ones merge at once, so that there are few.
        let mut stack: Vec<(u32, Vec<Piece>)> = Vec::new();
        for [a, b] in segments {
            let (from, to) = if a.x <= b.x { (a, b) } else { (b, a) };
            if from.x < to.x {
                let mut rank = 0;
                let mut merged = vec![Piece {
                    segment: Segment { from, to },
                    start: from.x,
                    end: to.x,
                }];
                while let Some((_, before)) = stack.pop_if(|(of, _)| *of == rank) {
                    merged = merge(&before, &merged);
                    rank += 1;
                }
                stack.push((rank, merged));
            } else {
                upright.push(if from.z >= to.z { from } else { to });
            }
        }
        let mut pieces = Vec::new();
        while let Some((_, before)) = stack.pop() {
            pieces = merge(&before, &pieces);
        }
        let mut envelope = Self {
            pieces,
            spikes: Vec::new(),
        };
        envelope.stand(upright);
        envelope
    }

    /// The upper envelope of two; of equal heights that of the first counts.
    pub(crate) fn with(&self, other: &Self) -> Self {
        let mut envelope = Self {
            pieces: merge(&self.pieces, &other.pieces),
            spikes: Vec::new(),
        };
        envelope.stand(self.spikes.iter().chain(&other.spikes).copied().collect());
        envelope
    }

    /// Keeps of upright segments what stands above all pieces.
    fn stand(&mut self, mut upright: Vec<Point2>) {
        upright.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(b.z.total_cmp(&a.z)));
        // Of those at one place the highest comes first.
        upright.dedup_by(|next, kept| next.x == kept.x);
        self.spikes.clear();
        upright.retain(|top| self.highest(top.x, top.x).is_none_or(|height| height < top.z));
        self.spikes = upright;
    }

    /// The greatest height over a range of x, ends included.
    pub(crate) fn highest(&self, from: f64, to: f64) -> Option<f64> {
        let first = self.pieces.partition_point(|piece| piece.end < from);
        let pieces = self.pieces.get(first..)?.iter();
        let pieces = pieces.take_while(|piece| piece.start <= to).flat_map(|piece| {
            let [a, b] = [piece.start.max(from), piece.end.min(to)];
            [piece.segment.height(a), piece.segment.height(b)]
        });
        let spikes = self.spikes.iter().filter(|spike| (from..=to).contains(&spike.x));
        pieces.chain(spikes.map(|spike| spike.z)).reduce(f64::max)
    }

    /// The ranges between two x, wider than `weld`, over which there is nothing.
    pub(crate) fn holes(&self, from: f64, to: f64, weld: f64) -> Holes {
        let starts = self.pieces.iter().map(|piece| piece.start).chain([to]);
        let mut reached = from;
        let mut holes = Vec::new();
        for (place, start) in starts.enumerate() {
            if start - reached > weld {
                holes.push([reached, start]);
            }
            if let Some(piece) = self.pieces.get(place) {
                reached = piece.end;
            }
        }
        holes
    }

    /// The envelope as a profile between two x: nowhere below it, places in x right within 1e-8 mm. Steps become nearly
    /// upright; gaps are bridged by straight lines, level ones at the ends. None without any piece.
    pub(crate) fn profile(&self, from: f64, to: f64) -> Option<Profile> {
        let mut clusters: Vec<Cluster> = Vec::with_capacity(self.pieces.len() + 1);
        let mut add = |point: Point2| {
            let step = narrow(point.x);
            match clusters.last_mut() {
                Some(last) if point.x - last.first < step => last.take(point),
                _ => clusters.push(Cluster::new(point)),
            }
        };
        let mut spikes = self.spikes.iter().copied().peekable();
        let first = self.pieces.first()?;
        add(Point2::new(from, first.segment.height(first.start)));
        let mut last = *first;
        for piece in &self.pieces {
            let start = Point2::new(piece.start, piece.segment.height(piece.start));
            while let Some(spike) = spikes.next_if(|spike| spike.x <= start.x) {
                // In a gap it stands on the line across.
                add(spike);
            }
            add(start);
            // A spike within a piece stands on it.
            while let Some(spike) = spikes.next_if(|spike| spike.x < piece.end) {
                let foot = Point2::new(spike.x, piece.segment.height(spike.x));
                for point in [foot, spike, foot] {
                    add(point);
                }
            }
            add(Point2::new(piece.end, piece.segment.height(piece.end)));
            last = *piece;
        }
        spikes.for_each(&mut add);
        add(Point2::new(to, last.segment.height(last.end)));
        if let Some(end) = clusters.last_mut() {
            end.first = to;
        }
        Profile::new(drawn(&clusters)).ok()
    }
}

/// Points so near to each other in x that a profile can hold only one of them.
#[derive(Clone, Copy, Debug)]
struct Cluster {
    /// The x of the first of them.
    first: f64,
    /// The height it begins at, the one it ends at, and the greatest.
    start: f64,
    end: f64,
    top: f64,
}

impl Cluster {
    const fn new(point: Point2) -> Self {
        Self {
            first: point.x,
            start: point.z,
            end: point.z,
            top: point.z,
        }
    }

    fn take(&mut self, point: Point2) {
        self.end = point.z;
        self.top = self.top.max(point.z);
    }
}

/// A polyline with strictly increasing x through the tops of clusters. Steps lie on the lower side of their place, so that
/// it is nowhere below.
fn drawn(clusters: &[Cluster]) -> Vec<Point2> {
    let mut points: Vec<Point2> = Vec::with_capacity(clusters.len());
    // Where the polyline comes down after the last cluster, if there is room.
    let mut down: Option<Point2> = None;
    for cluster in clusters {
        let step = narrow(cluster.first);
        if let Some(foot) = down.take()
            && cluster.first - foot.x >= step
        {
            points.push(foot);
        }
        let foot = Point2::new(cluster.first - step, cluster.start);
        if cluster.start < cluster.top && points.last().is_some_and(|last| foot.x - last.x >= step) {
            points.push(foot);
        }
        points.push(Point2::new(cluster.first, cluster.top));
        // Points of the cluster reach up to one step beyond its first.
        down = (cluster.end < cluster.top).then(|| Point2::new(cluster.first + 2.0 * step, cluster.end));
    }
    points
}

/// The upper envelope of two; of equal heights that of the first counts.
fn merge(first: &[Piece], second: &[Piece]) -> Vec<Piece> {
    if first.is_empty() || second.is_empty() {
        return [first, second].concat();
    }
    let mut out = Vec::with_capacity(first.len() + second.len());
    let (mut i, mut j) = (0, 0);
    let mut reached = f64::NEG_INFINITY;
    loop {
        match (first.get(i), second.get(j)) {
            (None, None) => return out,
            (Some(a), _) if a.end <= reached => i += 1,
            (_, Some(b)) if b.end <= reached => j += 1,
            (Some(a), None) => {
                push(&mut out, a.segment, a.start.max(reached), a.end);
                reached = a.end;
            }
            (None, Some(b)) => {
                push(&mut out, b.segment, b.start.max(reached), b.end);
                reached = b.end;
            }
            (Some(a), Some(b)) => {
                let (from, other) = (a.start.max(reached), b.start.max(reached));
                if from < other {
                    reached = a.end.min(other);
                    push(&mut out, a.segment, from, reached);
                } else if other < from {
                    reached = b.end.min(from);
                    push(&mut out, b.segment, other, reached);
                } else {
                    reached = a.end.min(b.end);
                    push_higher(&mut out, [a.segment, b.segment], from, reached);
                }
            }
        }
    }
}

/// Adds the higher of two segments between two x.
fn push_higher(out: &mut Vec<Piece>, [a, b]: [Segment; 2], from: f64, to: f64) {
    let before = a.height(from) - b.height(from);
    let after = a.height(to) - b.height(to);
    if before >= 0.0 && after >= 0.0 {
        push(out, a, from, to);
    } else if before <= 0.0 && after <= 0.0 {
        push(out, b, from, to);
    } else {
        let crossing = (from + (to - from) * (before / (before - after))).clamp(from, to);
        let [left, right] = if before > 0.0 { [a, b] } else { [b, a] };
        push(out, left, from, crossing);
        push(out, right, crossing, to);
    }
}

fn push(out: &mut Vec<Piece>, segment: Segment, start: f64, end: f64) {
    if start >= end {
        return;
    }
    match out.last_mut() {
        Some(last) if last.end == start && last.segment == segment => last.end = end,
        _ => out.push(Piece { segment, start, end }),
    }
}

#[cfg(test)]
mod tests;
