//! The polyline of a part, cut off at the sides of the stock: what is drawn beyond them does not matter.

use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::{Profile, ProfileError};

/// Places closer than this count as one, in mm: a nanometre.
pub(crate) const SAME: f64 = 1e-6;

/// How far from a side of the stock a profile may end and still reach it, in mm: where a curve touches the side, the polyline
/// in its place may stay away from it by the tolerance of curves.
pub(crate) const REACHES: f64 = super::Part::TOLERANCE.to_mm();

/// What of a polyline lies between the sides of the stock.
pub(crate) struct Strip {
    pub(crate) points: Vec<Point2>,
    /// For each point the point of the polyline to which it belongs.
    pub(crate) sources: Vec<usize>,
}

impl Strip {
    /// The strip from x = 0 to a width in mm. Ends that are as near a side as a curve's polyline may be are moved onto it.
    pub(crate) fn cut(line: &[Point2], width: f64) -> Self {
        let mut strip = Self {
            points: Vec::new(),
            sources: Vec::new(),
        };
        for (index, pair) in line.windows(2).enumerate() {
            let [from, to] = pair else { continue };
            let Some((first, last)) = segment_within(*from, *to, width) else {
                continue;
            };
            if strip.points.last() != Some(&first) {
                strip.push(first, index + 1);
            }
            strip.push(last, index + 1);
        }
        strip.led_to_the_sides(width)
    }

    fn led_to_the_sides(mut self, width: f64) -> Self {
        let by_x = |one: &&mut Point2, other: &&mut Point2| one.x.total_cmp(&other.x);
        if let Some(leftmost) = self.points.iter_mut().min_by(by_x)
            && leftmost.x <= REACHES
        {
            leftmost.x = 0.0;
        }
        if let Some(rightmost) = self.points.iter_mut().max_by(by_x)
            && rightmost.x >= width - REACHES
        {
            rightmost.x = width;
        }
        self
    }

    /// The strip as a height at every x.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub(crate) fn profile(&self, width: f64) -> Result<Profile, ProfileError> {
        let whole = Profile::new(self.points.clone())?;
        whole.clipped(0.0, width).ok_or(ProfileError::TooFew)
    }

    fn push(&mut self, point: Point2, source: usize) {
        self.points.push(point);
        self.sources.push(source);
    }
}

/// The part of a straight line between x = 0 and x = width; none when it only touches a side or runs along it.
fn segment_within(from: Point2, to: Point2, width: f64) -> Option<(Point2, Point2)> {
    let dx = to.x - from.x;
    let at = |side: f64| from.lerp(to, (side - from.x) / dx);
    let inside = |point: Point2| (0.0..=width).contains(&point.x);
    let cut = |point: Point2| match point {
        point if inside(point) => point,
        point if point.x < 0.0 => Point2 { x: 0.0, ..at(0.0) },
        _ => Point2 {
            x: width,
            ..at(width)
        },
    };
    if from.x.max(to.x) <= 0.0 || from.x.min(to.x) >= width {
        return None;
    }
    Some((cut(from), cut(to)))
}
