//! Derivatives of Bezier patches without weights, and so their exact curvatures.

use super::Bezier;
use crate::curvature::{Curvature, Derivatives};

/// The value and the first two derivatives of a Bezier curve, by the last steps of de Casteljau's construction.
fn curve(control: &[[f64; 3]], share: f64) -> [[f64; 3]; 3] {
    let mut points = control.to_vec();
    let degree = points.len().saturating_sub(1) as f64;
    let mut out = [[0.0; 3]; 3];
    loop {
        match *points.as_slice() {
            [] => return out,
            [a] => {
                out[0] = a;
                return out;
            }
            [a, b] => out[1] = core::array::from_fn(|i| degree * (b[i] - a[i])),
            [a, b, c] => {
                let factor = degree * (degree - 1.0);
                out[2] = core::array::from_fn(|i| factor * (c[i] - 2.0 * b[i] + a[i]));
            }
            _ => {}
        }
        let steps = points.windows(2);
        points = steps
            .map(|pair| core::array::from_fn(|i| pair[0][i] * (1.0 - share) + pair[1][i] * share))
            .collect();
    }
}

impl Bezier {
    /// Its curvature at parameters from 0 to 1. None where its tangent plane is not defined or stands upright, and of a patch
    /// with another number of control points than its degrees ask for.
    #[must_use]
    pub fn curvature(&self, u: f64, v: f64) -> Option<Curvature> {
        let columns = self.degrees[1].checked_add(1)?;
        let rows = self.degrees[0].checked_add(1)?;
        if rows.checked_mul(columns) != Some(self.control.len()) {
            return None;
        }
        let control: Vec<[f64; 3]> = self.control.iter().map(|p| p.to_array()).collect();
        let along_v: Vec<[[f64; 3]; 3]> = control.chunks(columns).map(|row| curve(row, v)).collect();
        // How each of value, first and second derivative by v changes along u.
        let [values, firsts, seconds] =
            [0, 1, 2].map(|order| curve(&along_v.iter().map(|row| row[order]).collect::<Vec<_>>(), u));
        Curvature::of(&Derivatives {
            u: values[1],
            v: firsts[0],
            uu: values[2],
            uv: firsts[1],
            vv: seconds[0],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::geometry::Point3;

    #[test]
    fn a_bicubic_patch_and_its_mirror() {
        let heights = [
            10.0, 12.0, 13.0, 11.0, 14.0, 22.0, 20.0, 12.0, 13.0, 21.0, 26.0, 15.0, 9.0, 13.0, 16.0, 8.0,
        ];
        let point = |i: usize, j: usize| Point3::new(30.0 * i as f64, 20.0 * j as f64, heights[4 * i + j]);
        let patch = |at: &dyn Fn(usize, usize) -> Point3| Bezier {
            degrees: [3, 3],
            control: (0..16).map(|k| at(k / 4, k % 4)).collect(),
        };
        // With the parameters exchanged the normal would point down.
        for patch in [patch(&point), patch(&|i, j| point(j, i))] {
            let middle = patch.curvature(0.5, 0.5).unwrap();
            let [most, least] = middle.principal();
            assert!((most + 5.411641719e-3).abs() < 1e-12 && (least + 1.277668116e-2).abs() < 1e-11);
            assert!((middle.gaussian() - 6.914282e-5).abs() < 1e-11);
            assert!((middle.mean() + 9.094161e-3).abs() < 1e-9);
            let corner = patch.curvature(0.0, 0.0).unwrap();
            assert!((corner.principal()[0] - 7.077011982e-3).abs() < 1e-12);
            assert!((corner.gaussian() + 8.882396e-5).abs() < 1e-11);
        }
        let short = Bezier {
            degrees: [3, 3],
            control: vec![],
        };
        assert_eq!(short.curvature(0.5, 0.5), None);
    }
}
