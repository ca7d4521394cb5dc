//! Drops against polygons in place of rims, against witnesses, and against closed forms.

use super::*;
use crate::disc::Stage;
use crate::mesh::Mesh;
use crate::testkit::{FIXED, sampled, sheets, surface_over, wavy, with_needle};
use proptest::prelude::*;
use vcutc_backend_api::vector::{cross, dot};

const PLAN: [f64; 2] = [100.0, 60.0];

fn axes() -> impl Strategy<Value = Axis> {
    prop_oneof![
        1 => Just(Axis::UP),
        8 => (0.0..0.7f64, 0.0..6.3f64).prop_map(|(lean, turn)| {
            let sine = libm::sin(lean);
            Axis::new([sine * libm::cos(turn), sine * libm::sin(turn), libm::cos(lean)]).unwrap()
        }),
    ]
}

fn surfaces() -> impl Strategy<Value = Surface> {
    let needle = (5.0..95.0, 5.0..55.0, 0.0..25.0);
    (sheets(), needle, any::<bool>()).prop_map(|(sheets, (x, y, z), is_flat)| {
        let ground = if is_flat {
            sampled(PLAN[0], PLAN[1], [1, 1], &|x, y| x / 10.0 - y / 20.0)
        } else {
            wavy(PLAN[0], PLAN[1])
        };
        let mesh = with_needle(&sheets.over(ground), [x, y, 0.0], [x, y, z]);
        surface_over(&mesh, FIXED, PLAN[0], PLAN[1])
    })
}

fn disc(radius: f64) -> Disc {
    let stage = |radius, from, to| Stage {
        radius: Length::mm(radius),
        from: Length::mm(from),
        to: Length::mm(to),
    };
    let stages = vec![stage(radius * 0.4, 1.0, 6.0), stage(radius * 1.3, 6.0, 40.0)];
    Disc::new(Length::mm(radius), stages).unwrap()
}

/// Two directions square to an axis and to each other.
fn across(axis: Axis) -> [[f64; 3]; 2] {
    let a = axis.to_array();
    let u = cross(
        a,
        if a[0].abs() < 0.5 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        },
    );
    let length = dot(u, u).sqrt();
    let u = u.map(|part| part / length);
    [u, cross(a, u)]
}

/// The greatest height of triangles above the plane of a face with its centre at height 0, over a polygon of so many
/// corners in its rim, or around it.
fn over_polygon(surface: &Surface, radius: f64, place: [f64; 2], axis: Axis, sides: u32) -> Option<f64> {
    let [u, v] = across(axis);
    let a = axis.to_array();
    let rim: Vec<[f64; 2]> = (0..sides)
        .map(|k| {
            let (sine, cosine) = libm::sincos(core::f64::consts::TAU * f64::from(k) / f64::from(sides));
            [0, 1].map(|i| place[i] + radius * (cosine * u[i] + sine * v[i]))
        })
        .collect();
    let plane = |x: f64, y: f64| -(a[0] * (x - place[0]) + a[1] * (y - place[1])) / a[2];
    let mut most: Option<f64> = None;
    for face in surface.mesh().faces() {
        let mut polygon: Vec<[f64; 3]> = face.iter().map(|p| p.to_array()).collect();
        for (k, from) in rim.iter().enumerate() {
            let to = rim[(k + 1) % rim.len()];
            let inside =
                |p: &[f64; 3]| (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
            let mut kept = Vec::new();
            for (i, p) in polygon.iter().enumerate() {
                let q = polygon[(i + 1) % polygon.len()];
                let (here, there) = (inside(p), inside(&q));
                if here >= 0.0 {
                    kept.push(*p);
                }
                if (here >= 0.0) != (there >= 0.0) {
                    let share = here / (here - there);
                    kept.push(core::array::from_fn(|i| p[i] + (q[i] - p[i]) * share));
                }
            }
            polygon = kept;
            if polygon.is_empty() {
                break;
            }
        }
        for [x, y, z] in polygon {
            let height = z - plane(x, y);
            most = Some(most.map_or(height, |before| before.max(height)));
        }
    }
    most
}

/// Where a point lies in a disc that rests: along its axis, and away from it.
fn in_disc(rest: &Rest, place: [f64; 2], axis: Axis) -> [f64; 2] {
    let from = [
        rest.touch.x - place[0],
        rest.touch.y - place[1],
        rest.touch.z - rest.height.to_mm(),
    ];
    let along = dot(from, axis.to_array());
    [along, (dot(from, from) - along * along).max(0.0).sqrt()]
}

/// The touched point is of the disc, and no higher than the surface.
fn is_witnessed(
    surface: &Surface,
    disc: &Disc,
    rest: &Rest,
    place: [f64; 2],
    axis: Axis,
) -> Result<(), TestCaseError> {
    let [along, away] = in_disc(rest, place, axis);
    let (radius, [from, to]) = match rest.part {
        Part::Face => (disc.radius().to_mm(), [0.0, 0.0]),
        Part::Stage(index) => {
            let stage = disc.stages()[index];
            (stage.radius.to_mm(), [stage.from.to_mm(), stage.to.to_mm()])
        }
    };
    prop_assert!(away <= radius + 1e-9, "{away} beyond {radius}");
    prop_assert!(
        along >= from - 1e-9 && along <= to + 1e-9,
        "{along} beyond {from} to {to}"
    );
    let distance = surface.distance(rest.touch, &mut 0);
    // Of slivers the last digits are lost.
    prop_assert!(distance < 1e-6, "{distance} off the surface");
    Ok(())
}

proptest! {
    #[test]
    fn faces_come_down_as_polygons_do(
        surface in surfaces(), axis in axes(), radius in 1.0..30.0f64, x in -20.0..120.0f64, y in -20.0..80.0f64,
    ) {
        let dropper = Dropper::new(&surface);
        let disc = disc(radius);
        let rest = dropper.face(disc.radius(), [x, y], axis);
        let inner = over_polygon(&surface, radius, [x, y], axis, 64);
        let outer = over_polygon(&surface, radius / libm::cos(core::f64::consts::PI / 64.0), [x, y], axis, 64);
        let Some(rest) = rest else {
            prop_assert_eq!(inner, None);
            return Ok(());
        };
        is_witnessed(&surface, &disc, &rest, [x, y], axis)?;
        let height = rest.height.to_mm();
        prop_assert!(inner.is_none_or(|inner| height >= inner - 1e-9), "{height} below {inner:?}");
        prop_assert!(outer.is_some_and(|outer| height <= outer + 1e-9), "{height} above {outer:?}");
    }

    #[test]
    fn bodies_clear_all_sampled_points_and_touch_one(
        surface in surfaces(), axis in axes(), radius in 2.0..20.0f64, x in -5.0..105.0f64, y in -5.0..65.0f64,
    ) {
        let disc = disc(radius);
        let dropper = Dropper::new(&surface);
        let Some(rest) = dropper.disc(&disc, [x, y], axis) else {
            return Ok(());
        };
        is_witnessed(&surface, &disc, &rest, [x, y], axis)?;
        let centre = [x, y, rest.height.to_mm()];
        let ([u, v], a) = (across(axis), axis.to_array());
        let inside = |p: &Point3| (0.0..=PLAN[0]).contains(&p.x) && (0.0..=PLAN[1]).contains(&p.y);
        for stage in disc.stages() {
            for k in 0..9 {
                let up = stage.from.to_mm() + (stage.to - stage.from).to_mm() * f64::from(k) / 8.0;
                for turn in 0..48 {
                    let (sine, cosine) = libm::sincos(core::f64::consts::TAU * f64::from(turn) / 48.0);
                    for share in [1.0, 0.6] {
                        let out = stage.radius.to_mm() * share;
                        let at = |i: usize| centre[i] + up * a[i] + out * (cosine * u[i] + sine * v[i]);
                        let point = Point3::new(at(0), at(1), at(2));
                        if inside(&point) && let Some(height) = surface.height(point.x, point.y) {
                            // Needles and borders are too thin for the last digits of a place.
                            let slack = 1e-6;
                            prop_assert!(point.z >= height - slack, "{point:?} below {height}");
                        }
                    }
                }
            }
        }
    }
}

proptest! {
    /// Nothing that matters is passed over.
    #[test]
    fn bins_change_nothing(
        heights in prop::collection::vec(-25.0..25.0f64, 26 * 16), axis in axes(), radius in 2.0..20.0f64,
        x in -5.0..105.0f64, y in -5.0..65.0f64,
    ) {
        let height = |x: f64, y: f64| heights[(x / 4.0).round() as usize * 16 + (y / 4.0).round() as usize];
        let surface = surface_over(&sampled(PLAN[0], PLAN[1], [25, 15], &height), FIXED, PLAN[0], PLAN[1]);
        let disc = disc(radius);
        let plate = Plate::face(radius, [x, y], axis);
        let stages: Vec<Cylinder> = disc.stages().iter().map(|&stage| Cylinder::new(stage, [x, y], axis)).collect();
        let mut most: Option<f64> = None;
        for face in surface.mesh().faces() {
            let above = f64::NEG_INFINITY;
            let asked = stages.iter().map(|stage| stage.clear(face, above)).chain([plate.clear(face, above)]);
            most = asked.flatten().map(|(height, _)| height).chain(most).reduce(f64::max);
        }
        let rest = Dropper::new(&surface).disc(&disc, [x, y], axis).map(|rest| rest.height.to_mm());
        match (rest, most) {
            (Some(rest), Some(most)) => prop_assert!((rest - most).abs() < 1e-9, "{rest} {most}"),
            (rest, most) => prop_assert_eq!(rest, most),
        }
    }

    /// What lies under a level ceiling asks for no more than the ceiling does.
    #[test]
    fn ceilings_ask_for_most(
        corners in prop::array::uniform3((-30.0..30.0f64, -30.0..30.0f64, 0.0..1.0f64)), size in 0.01..1.0f64,
        axis in axes(), radius in 2.0..20.0f64, x in -30.0..30.0f64, y in -30.0..30.0f64,
    ) {
        let face = corners.map(|(u, v, z)| Point3::new(50.0 + size * u, 30.0 + size * v, z));
        let range = |part: fn(Point3) -> f64| {
            let [a, b, c] = face.map(part);
            [a.min(b).min(c), a.max(b).max(c)]
        };
        let [x_range, y_range, z_range] = [range(|p| p.x), range(|p| p.y), range(|p| p.z)];
        let ceiling = Roofed {
            middle: [x_range, y_range].map(|[low, high]| f64::midpoint(low, high)),
            half: [x_range, y_range].map(|[low, high]| (high - low) / 2.0),
            height: z_range[1],
            slope: [0.0; 2],
        };
        let place = [50.0 + x, 30.0 + y];
        let disc = disc(radius);
        let check = |asked: Option<(f64, Point3)>, most: Option<f64>| {
            let is_less = asked.is_none_or(|(asked, _)| most.is_some_and(|most| asked <= most + 1e-9));
            prop_assert!(is_less, "{asked:?} above {most:?}");
            Ok(())
        };
        let plate = Plate::face(radius, place, axis);
        check(plate.clear(face, f64::NEG_INFINITY), plate.most(ceiling))?;
        for &stage in disc.stages() {
            let cylinder = Cylinder::new(stage, place, axis);
            check(cylinder.clear(face, f64::NEG_INFINITY), cylinder.most(ceiling))?;
        }
    }

    /// A body of revolution reaches as far towards a plane as the nearer of the ends of a stage, and its radius there.
    #[test]
    fn bodies_stand_on_planes_as_their_support_says(
        axis in axes(), radius in 2.0..20.0f64, slope in prop::array::uniform2(-6.0..6.0f64),
    ) {
        let size = 1000.0;
        let height = |x: f64, y: f64| slope[0] * x + slope[1] * y;
        let surface = surface_over(&sampled(size, size, [1, 1], &height), FIXED, size, size);
        let disc = disc(radius);
        let place = [500.0, 500.0];
        let rest = Dropper::new(&surface).disc(&disc, place, axis).unwrap();
        let normal = [-slope[0], -slope[1], 1.0];
        let along = dot(normal, axis.to_array());
        let across = (dot(normal, normal) - along * along).max(0.0).sqrt();
        let stages = disc.stages().iter().map(|s| [s.radius, s.from, s.to].map(Length::to_mm));
        let lowest = stages
            .chain([[radius, 0.0, 0.0]])
            .map(|[radius, from, to]| (from * along).min(to * along) - radius * across)
            .fold(f64::INFINITY, f64::min);
        let expected = height(500.0, 500.0) - lowest;
        prop_assert!((rest.height.to_mm() - expected).abs() < 1e-8, "{rest:?} {expected}");
    }
}

/// One triangle of `z = height(x, y)` that covers the plan.
fn plane(height: &dyn Fn(f64, f64) -> f64) -> Surface {
    let corner = |x, y| Point3::new(x, y, height(x, y));
    let corners = vec![
        corner(-1000.0, -1000.0),
        corner(2000.0, -1000.0),
        corner(-1000.0, 2000.0),
    ];
    surface_over(
        &Mesh::new(corners, vec![[0, 1, 2]]).unwrap(),
        FIXED,
        PLAN[0],
        PLAN[1],
    )
}

#[test]
fn a_disc_on_a_plane_touches_with_the_rim() {
    let surface = plane(&|x, _| x / 10.0);
    let dropper = Dropper::new(&surface);
    // Upright: the rim at the greatest x.
    let rest = dropper.face(Length::mm(20.0), [50.0, 30.0], Axis::UP).unwrap();
    assert!((rest.height.to_mm() - 7.0).abs() < 1e-12);
    // Square to the plane: all of the face.
    let axis = Axis::new([-0.1, 0.0, 1.0]).unwrap();
    let rest = dropper.face(Length::mm(20.0), [50.0, 30.0], axis).unwrap();
    assert!((rest.height.to_mm() - 5.0).abs() < 1e-12);
    // Leaning by 5 degrees more, along x: the leading rim, and the centre R sin(5 deg) above the plane, along its normal.
    let lean = libm::atan(-0.1) + 5.0 * core::f64::consts::PI / 180.0;
    let axis = Axis::new([libm::sin(lean), 0.0, libm::cos(lean)]).unwrap();
    let rest = dropper.face(Length::mm(20.0), [50.0, 30.0], axis).unwrap();
    let above = 20.0 * libm::sin(5.0 * core::f64::consts::PI / 180.0) * 1.01f64.sqrt();
    assert!((rest.height.to_mm() - 5.0 - above).abs() < 1e-12, "{rest:?}");
}

#[test]
fn a_needle_stops_what_is_over_it() {
    let flat = sampled(PLAN[0], PLAN[1], [50, 30], &|_, _| 0.0);
    let surface = surface_over(
        &with_needle(&flat, [40.0, 30.0, 0.0], [40.0, 30.0, 5.0]),
        FIXED,
        PLAN[0],
        PLAN[1],
    );
    let dropper = Dropper::new(&surface);
    let disc = disc(10.0);
    let height = |x: f64| {
        dropper
            .disc(&disc, [x, 30.0], Axis::UP)
            .map(|rest| (rest.height.to_mm(), rest.part))
    };
    assert_eq!(height(30.0), Some((5.0, Part::Face)));
    // The holder, 13 mm wide and 6 mm above, does not come down to it.
    assert_eq!(height(29.98), Some((0.0, Part::Face)));
    assert_eq!(dropper.face(Length::mm(10.0), [111.0, 30.0], Axis::UP), None);
    assert_eq!(dropper.face(Length::mm(10.0), [f64::NAN, 30.0], Axis::UP), None);
}
