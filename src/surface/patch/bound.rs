//! Bounds on the derivatives of Bezier patches, from differences of their control points.

use super::{Piece, Weighted};

/// How often to divide a patch in u and v so that two triangles a cell are within the tolerance of it, as whole numbers.
/// Infinite where nothing bounds it.
pub(super) fn divisions(piece: &Piece, tolerance: f64) -> [f64; 2] {
    let Seconds { uu, uv, vv } = seconds(piece);
    // 2 uv/(m n) <= uv (r/m^2 + 1/(r n^2)) for any r; this one keeps cells in proportion.
    let ratio = if uu > 0.0 && vv > 0.0 {
        (uu / vv).sqrt().clamp(1e-3, 1e3)
    } else {
        1.0
    };
    // Each term gets half of the tolerance; a little is left for rounding.
    let count = |second: f64| (second / (4.0 * 0.999 * tolerance)).sqrt().ceil().max(1.0);
    [count(uu + uv * ratio), count(vv + uv / ratio)]
}

/// Bounds on the lengths of the second derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seconds {
    pub(super) uu: f64,
    pub(super) uv: f64,
    pub(super) vv: f64,
}

/// The greatest length in space, and the greatest magnitude of the weight, of a derivative of the homogeneous patch.
#[derive(Clone, Copy, Debug, Default)]
struct Most {
    space: f64,
    weight: f64,
}

pub(super) fn seconds(piece: &Piece) -> Seconds {
    let weights = || piece.control.iter().map(|point| point[3]);
    let least = weights().fold(f64::INFINITY, f64::min);
    let most = weights().fold(0.0, f64::max);
    let moved = moved_to_centre(piece);
    let [u, v] = [[1, 0], [0, 1]].map(|order| derivative(&moved, order));
    let [uu, uv, vv] = [[2, 0], [1, 1], [0, 2]].map(|order| derivative(&moved, order));
    if least == most {
        return Seconds {
            uu: uu.space / least,
            uv: uv.space / least,
            vv: vv.space / least,
        };
    }
    // The patch lies within the hull of its control points.
    let radius = moved
        .control
        .iter()
        .map(|point| length(*point) / point[3])
        .fold(0.0, f64::max);
    let [su, sv] = [u, v].map(|first| (first.space + first.weight * radius) / least);
    Seconds {
        uu: (uu.space + 2.0 * u.weight * su + uu.weight * radius) / least,
        uv: (uv.space + u.weight * sv + v.weight * su + uv.weight * radius) / least,
        vv: (vv.space + 2.0 * v.weight * sv + vv.weight * radius) / least,
    }
}

/// The patch with the middle of its control points at the origin.
fn moved_to_centre(piece: &Piece) -> Piece {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for point in &piece.control {
        for i in 0..3 {
            low[i] = low[i].min(point[i] / point[3]);
            high[i] = high[i].max(point[i] / point[3]);
        }
    }
    let centre: [f64; 3] = core::array::from_fn(|i| low[i] + (high[i] - low[i]) / 2.0);
    let moved = |point: &Weighted| {
        let [x, y, z, w] = *point;
        [x - centre[0] * w, y - centre[1] * w, z - centre[2] * w, w]
    };
    Piece {
        degrees: piece.degrees,
        control: piece.control.iter().map(moved).collect(),
    }
}

/// Bounds on a derivative of the homogeneous patch, so many times in u and in v.
fn derivative(piece: &Piece, order: [usize; 2]) -> Most {
    let [p, q] = piece.degrees;
    if order[0] > p || order[1] > q {
        return Most::default();
    }
    let mut rows: Vec<Vec<Weighted>> = piece.control.chunks(q + 1).map(<[Weighted]>::to_vec).collect();
    let mut factor = 1.0;
    for k in 0..order[0] {
        factor *= (p - k) as f64;
        rows = rows
            .windows(2)
            .map(|pair| pair[0].iter().zip(&pair[1]).map(|(a, b)| minus(*b, *a)).collect())
            .collect();
    }
    for k in 0..order[1] {
        factor *= (q - k) as f64;
        for row in &mut rows {
            *row = row.windows(2).map(|pair| minus(pair[1], pair[0])).collect();
        }
    }
    rows.iter().flatten().fold(Most::default(), |most, &point| Most {
        space: most.space.max(length(point) * factor),
        weight: most.weight.max(point[3].abs() * factor),
    })
}

fn minus(a: Weighted, b: Weighted) -> Weighted {
    core::array::from_fn(|i| a[i] - b[i])
}

fn length([x, y, z, _]: Weighted) -> f64 {
    libm::hypot(libm::hypot(x, y), z)
}
