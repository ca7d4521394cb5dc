//! Solids in space, by a parallel projection: x to the right and down a little, y to the right and up, z up.

use super::Point;

/// The right of the view: turned by 30 deg from x towards y.
const RIGHTWARDS: [f64; 3] = [0.866_025, 0.5, 0.0];
/// The up of the view: 25 deg from above the level.
const UPWARDS: [f64; 3] = [-0.211_309, 0.366_000, 0.906_308];

/// A projection onto a part of a picture.
pub(super) struct View {
    /// Places to a mm.
    pub(super) scale: f64,
    /// Least coordinates of what is projected, and where these are in the picture.
    least: Point,
    corner: Point,
    /// How far everything reaches upwards.
    pub(super) height: f64,
}

impl View {
    /// The largest view in which all of these points are seen, on the lower edge of an area and in its middle.
    pub(super) fn of(points: impl Iterator<Item = [f64; 3]>, [left, bottom]: Point, size: [f64; 2]) -> Self {
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in points.map(projected) {
            least = [0, 1].map(|side| place[side].min(least[side]));
            most = [0, 1].map(|side| place[side].max(most[side]));
        }
        let [width, height] = [most[0] - least[0], most[1] - least[1]];
        let scale = (size[0] / width).min(size[1] / height);
        Self {
            scale,
            least,
            corner: [left + (size[0] - width * scale) / 2.0, bottom],
            height: height * scale,
        }
    }

    /// Where a point is.
    pub(super) fn at(&self, point: [f64; 3]) -> Point {
        let [right, up] = projected(point);
        [
            self.corner[0] + (right - self.least[0]) * self.scale,
            self.corner[1] - (up - self.least[1]) * self.scale,
        ]
    }

    /// How long a length along x is in the picture, from side to side.
    pub(super) fn along_x(&self, length: f64) -> f64 {
        length * self.scale * RIGHTWARDS[0]
    }
}

fn projected(point: [f64; 3]) -> Point {
    let along = |axis: [f64; 3]| axis.iter().zip(point).map(|(axis, value)| axis * value).sum();
    [along(RIGHTWARDS), along(UPWARDS)]
}

/// The corners of a block at the origin: the one of number n is at the far end of x, y, z where n has the bits 1, 2, 4.
pub(super) fn corners([x, y, z]: [f64; 3]) -> [[f64; 3]; 8] {
    let along = |number: usize, bit: usize, length: f64| if number & bit == 0 { 0.0 } else { length };
    [0, 1, 2, 3, 4, 5, 6, 7].map(|number| [along(number, 1, x), along(number, 2, y), along(number, 4, z)])
}
