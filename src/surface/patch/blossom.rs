//! B-spline surfaces as grids of Bezier patches.

use super::{Nurbs, Piece, Weighted, lerp};

/// The Bezier patches of a surface, row by row of u, and how many there are in v.
pub(super) fn pieces(
    surface: &Nurbs,
    [rows, columns]: [usize; 2],
    control: &[Weighted],
) -> (Vec<Piece>, usize) {
    let [p, q] = surface.degrees;
    let [in_u, in_v] = &surface.knots;
    let (spans_u, spans_v) = (spans(in_u, p, rows), spans(in_v, q, columns));
    let mut pieces = Vec::with_capacity(spans_u.len() * spans_v.len());
    for &u in &spans_u {
        // Bezier points in u, of all columns.
        let lines: Vec<Vec<Weighted>> = (0..columns)
            .map(|column| {
                let points: Vec<Weighted> = (u - p..=u).map(|row| control[row * columns + column]).collect();
                bezier_points(in_u, p, u, &points)
            })
            .collect();
        for &v in &spans_v {
            let mut net = Vec::with_capacity((p + 1) * (q + 1));
            for place in 0..=p {
                let points: Vec<Weighted> = lines[v - q..=v].iter().map(|line| line[place]).collect();
                net.extend(bezier_points(in_v, q, v, &points));
            }
            pieces.push(Piece {
                degrees: surface.degrees,
                control: net,
            });
        }
    }
    (pieces, spans_v.len())
}

/// The intervals between knots that have an extent, by the knots at their starts.
pub(super) fn spans(knots: &[f64], degree: usize, count: usize) -> Vec<usize> {
    (degree..count)
        .filter(|&span| knots[span] < knots[span + 1])
        .collect()
}

/// The Bezier points of the polynomial over `knots[span]..knots[span + 1]`, from its `degree + 1` control points.
pub(super) fn bezier_points(
    knots: &[f64],
    degree: usize,
    span: usize,
    control: &[Weighted],
) -> Vec<Weighted> {
    let (start, end) = (knots[span], knots[span + 1]);
    (0..=degree)
        .map(|ends| {
            let mut row = control.to_vec();
            for level in 1..=degree {
                // The last `ends` of the arguments are the end of the interval.
                let argument = if level + ends > degree { end } else { start };
                for i in 0..=degree - level {
                    let low = knots[span - degree + level + i];
                    let high = knots[span + 1 + i];
                    row[i] = lerp(row[i], row[i + 1], (argument - low) / (high - low));
                }
            }
            row[0]
        })
        .collect()
}
