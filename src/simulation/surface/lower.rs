//! Lowering a stretch of the surface at once: what a disc frees between slits.

use super::{Side, Surface, TOUCH, is_same};
use vcutc_geometry::curve::Point2;

impl Surface {
    /// Lowers the surface to a polyline from left to right. Where its ends lie below the surface, it leaves walls. Flanks of
    /// later cuts may meet these.
    pub(crate) fn lower(&mut self, floor: &[Point2]) {
        let (Some(&first), Some(&last)) = (floor.first(), floor.last()) else {
            return;
        };
        if last.x - first.x <= TOUCH {
            return;
        }
        let start = self.end_left(first.x);
        let before = self.take_until(last.x, start);
        self.begin_right(last.x, before);
        for &corner in floor {
            self.left.drop_level(corner);
            self.left.push_corner(corner);
        }
        if let (Some(left), Some(right)) = (self.left.last(), self.right.last())
            && is_same(left, right)
        {
            self.right.drop_nearest(1);
        }
        if let Some(right) = self.right.last() {
            self.left.drop_level(right);
        }
        self.steepest = f64::INFINITY;
    }

    /// Ends what stands left of x with a corner there, and returns the surface's point just right of it. At the side of the
    /// stock nothing stands.
    fn end_left(&mut self, x: f64) -> Point2 {
        let [left, right] = self.heights(x);
        if self.is_at_side(x, Side::Left) {
            self.left.drop_nearest(usize::MAX);
        } else if self.left.last().is_none_or(|last| (last.x - x).abs() > TOUCH) {
            self.left.push(Point2::new(x, left));
        }
        Point2::new(x, right)
    }

    /// Takes the corners right of the place of work away, up to x. Returns the last one, or where there is none the start.
    fn take_until(&mut self, x: f64, start: Point2) -> Point2 {
        let mut before = start;
        let is_at_side = self.is_at_side(x, Side::Right);
        let goes = |corner: &Point2| is_at_side || corner.x < x - TOUCH;
        while let Some(corner) = self.right.pop_if(goes) {
            before = corner;
        }
        before
    }

    /// Begins what stands right of x with a corner there, on the line from the corner before.
    fn begin_right(&mut self, x: f64, before: Point2) {
        let Some(next) = self.right.last() else {
            return;
        };
        if next.x > x + TOUCH {
            let share = ((x - before.x) / (next.x - before.x)).clamp(0.0, 1.0);
            self.right
                .push(Point2::new(x, before.z + (next.z - before.z) * share));
        } else if self.right.second().is_some_and(|second| second.x <= x + TOUCH) {
            // Of a wall the corner beyond it stays.
            self.right.drop_nearest(1);
        }
    }
}
