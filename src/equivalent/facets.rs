//! The solid of an equivalent tool as facets: STL in its text form, in mm, the tip at the origin and the axis along +z.
//!
//! A circle becomes a polygon with its corners on the circle, so the facets lie within the solid, by a hundredth of a millimetre at
//! most. Corners that facets share are written from one number each, so that every edge is shared by two facets to the last digit.

use crate::{Equivalent, Solid};
use core::f64::consts::{PI, TAU};
use core::fmt::Write;

/// How far the facets lie within the solid at most, in mm, unless that takes more corners than there may be.
const WITHIN: f64 = 0.01;

/// The fewest and the most corners of a circle; multiples of four, so that the axes of the tool frame meet corners.
const CORNERS: [u32; 2] = [24, 1024];

/// A corner of a facet, in mm.
pub type Corner = [f64; 3];

/// The facets of a solid, each with its corners counted anticlockwise as they are seen from outside.
#[must_use]
pub fn facets(solid: Solid) -> Vec<[Corner; 3]> {
    let (radius, height) = (solid.radius().to_mm(), solid.height().to_mm());
    let corners = corners(radius);
    let ring = |z: f64| -> Vec<Corner> {
        let step = TAU / f64::from(corners);
        let corner = |number| {
            let (sine, cosine) = libm::sincos(f64::from(number) * step);
            [radius * cosine, radius * sine, z]
        };
        (0..corners).map(corner).collect()
    };
    let (tip, top) = ([0.0; 3], [0.0, 0.0, height]);
    let upper = ring(height);
    let mut facets = Vec::new();
    for (&a, &b) in pairs(&upper) {
        facets.push([top, a, b]);
    }
    match solid {
        Solid::Cylinder { .. } => {
            let lower = ring(0.0);
            for ((&a, &b), (&above_a, &above_b)) in pairs(&lower).zip(pairs(&upper)) {
                facets.push([tip, b, a]);
                facets.push([a, b, above_b]);
                facets.push([a, above_b, above_a]);
            }
        }
        Solid::Cone { .. } => {
            for (&a, &b) in pairs(&upper) {
                facets.push([tip, b, a]);
            }
        }
    }
    facets
}

/// How many corners stand for a circle. Between two of them a chord is off by `R (1 - cos(pi / n))`.
fn corners(radius: f64) -> u32 {
    let [fewest, most] = CORNERS;
    let half_step = libm::acos((1.0 - WITHIN / radius).max(0.0));
    let is_fine = |&corners: &u32| PI / f64::from(corners) <= half_step;
    (fewest..most).step_by(4).find(is_fine).unwrap_or(most)
}

/// Neighbours on a ring, the last with the first.
fn pairs(ring: &[Corner]) -> impl Iterator<Item = (&Corner, &Corner)> {
    ring.iter().zip(ring.iter().cycle().skip(1))
}

/// The text of an STL file.
#[must_use]
pub fn stl(tool: &Equivalent) -> String {
    let mut text = format!("solid {}\n", tool.name);
    for facet in facets(tool.solid) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  facet normal {}\n    outer loop", numbers(normal(facet)));
        for corner in facet {
            let _ = writeln!(text, "      vertex {}", numbers(corner));
        }
        text.push_str("    endloop\n  endfacet\n");
    }
    let _ = writeln!(text, "endsolid {}", tool.name);
    text
}

/// The unit vector that points out of the solid.
fn normal([a, b, c]: [Corner; 3]) -> Corner {
    let [u, v] = [b, c].map(|corner| [corner[0] - a[0], corner[1] - a[1], corner[2] - a[2]]);
    let cross = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    let length = libm::sqrt(cross.iter().map(|part| part * part).sum());
    cross.map(|part| part / length)
}

fn numbers(values: Corner) -> String {
    values.map(decimal).join(" ")
}

/// Six decimals, and zero without a sign.
fn decimal(value: f64) -> String {
    let text = format!("{value:.6}");
    if text == "-0.000000" {
        "0.000000".to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Role;
    use std::collections::BTreeMap;
    use vcutc_backend_api::units::{Angle, Length};

    const SOLIDS: [Solid; 3] = [
        Solid::Cylinder {
            radius: Length::mm(25.0),
            height: Length::mm(10.0),
        },
        Solid::Cone {
            half_angle: Angle::deg(34.0),
            height: Length::mm(20.7),
        },
        Solid::Cylinder {
            radius: Length::mm(0.05),
            height: Length::mm(30.0),
        },
    ];

    fn tool(solid: Solid) -> Equivalent {
        Equivalent {
            name: "tool".to_owned(),
            blade: "blade".to_owned(),
            solid,
            role: Role::Crusher,
            shank: None,
            spin: None,
        }
    }

    /// The corners as the file has them.
    fn written(solid: Solid) -> Vec<[[String; 3]; 3]> {
        let text = stl(&tool(solid));
        let vertices: Vec<[String; 3]> = text
            .lines()
            .filter_map(|line| line.trim().strip_prefix("vertex "))
            .map(|line| {
                let numbers: Vec<String> = line.split(' ').map(str::to_owned).collect();
                numbers.try_into().unwrap()
            })
            .collect();
        vertices
            .chunks(3)
            .map(|facet| facet.to_vec().try_into().unwrap())
            .collect()
    }

    #[test]
    fn every_edge_is_shared_by_two_facets_that_run_along_it_in_turn() {
        for solid in SOLIDS {
            let mut edges = BTreeMap::new();
            for facet in written(solid) {
                for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                    assert_ne!(facet[from], facet[to]);
                    let key = (facet[from].clone(), facet[to].clone());
                    *edges.entry(key).or_insert(0) += 1;
                }
            }
            for ((from, to), count) in &edges {
                assert_eq!(*count, 1, "{from:?} {to:?}");
                assert_eq!(
                    edges.get(&(to.clone(), from.clone())),
                    Some(&1),
                    "{from:?} {to:?}"
                );
            }
        }
    }

    /// By the divergence theorem, from the corners in the file; the closed form is that of the circle, less what chords leave out.
    #[test]
    fn the_volume_is_that_of_the_solid() {
        for solid in SOLIDS {
            let volume: f64 = written(solid)
                .iter()
                .map(|facet| {
                    let [a, b, c] = facet
                        .clone()
                        .map(|corner| corner.map(|number| number.parse::<f64>().unwrap()));
                    let cross = [
                        b[1] * c[2] - b[2] * c[1],
                        b[2] * c[0] - b[0] * c[2],
                        b[0] * c[1] - b[1] * c[0],
                    ];
                    a.iter().zip(cross).map(|(a, b)| a * b).sum::<f64>() / 6.0
                })
                .sum();
            let (radius, height) = (solid.radius().to_mm(), solid.height().to_mm());
            let share = match solid {
                Solid::Cylinder { .. } => 1.0,
                Solid::Cone { .. } => 1.0 / 3.0,
            };
            let of_radius = |radius: f64| PI * radius * radius * height * share;
            assert!(volume < of_radius(radius), "{solid:?}");
            // A hundredth of a millimetre; less where even the fewest corners are nearer.
            let within = WITHIN.min(radius * (1.0 - libm::cos(PI / 24.0)));
            assert!(volume > of_radius(radius - within), "{solid:?}: {volume}");
        }
    }

    #[test]
    fn normals_point_out() {
        for solid in SOLIDS {
            let middle = solid.height().to_mm() * 0.6;
            for facet in facets(solid) {
                let normal = normal(facet);
                let out: f64 = (0..3)
                    .map(|axis| normal[axis] * (facet[0][axis] - if axis == 2 { middle } else { 0.0 }))
                    .sum();
                assert!(out > 0.0, "{facet:?}");
            }
        }
    }
}
