//! Curvature and class of parts that change along y, against closed forms of their heights.

use crate::pictures::picture;
use crate::pipeline::{Files, compile};
use crate::shop::folder;
use crate::surfaces::{VCUT, job};
use vcutc::driver::Outcome;
use vcutc::picture::Prefix;
use vcutc::report::page::{Further, page};
use vcutc::report::pictures::Curved;
use vcutc::report::{Material, pictures};
use vcutc::surface::bend::Bend;
use vcutc::surface::class::Class;
use vcutc::surface::map::Cells;

/// Cells of 1 mm over the stock of 120 mm by 80 mm.
const CELLS: Cells = Cells {
    columns: 120,
    rows: 80,
};

/// A height with its derivatives: `[z, zx, zy, zxx, zxy, zyy]`.
type Height<'a> = &'a dyn Fn(f64, f64) -> [f64; 6];

fn dome(x: f64, y: f64) -> [f64; 6] {
    let (u, v) = (x - 60.0, y - 40.0);
    [
        40.0 - u * u / 900.0 - v * v / 1200.0,
        -u / 450.0,
        -v / 600.0,
        -1.0 / 450.0,
        0.0,
        -1.0 / 600.0,
    ]
}
const DOME: &str = "40 mm - (x - 60 mm)^2 / 900 mm - (y - 40 mm)^2 / 1200 mm";

fn bowl(x: f64, y: f64) -> [f64; 6] {
    let [z, slopes @ ..] = dome(x, y);
    let [a, b, c, d, e] = slopes.map(|slope| -slope);
    [60.0 - z, a, b, c, d, e]
}
const BOWL: &str = "20 mm + (x - 60 mm)^2 / 900 mm + (y - 40 mm)^2 / 1200 mm";

fn hypar(x: f64, y: f64) -> [f64; 6] {
    let (u, v) = (x - 60.0, y - 40.0);
    [30.0 + u * v / 300.0, v / 300.0, u / 300.0, 0.0, 1.0 / 300.0, 0.0]
}
const HYPAR: &str = "30 mm + (x - 60 mm) * (y - 40 mm) / 300 mm";

fn wave(x: f64, _: f64) -> [f64; 6] {
    let (sine, cosine) = libm::sincos(x / 30.0);
    [30.0 + 9.0 * sine, 0.3 * cosine, 0.0, -0.01 * sine, 0.0, 0.0]
}
const WAVE: &str = "30 mm + 9 mm * sin(x / 30 mm * 1 rad) + 0 * y";

fn plane(x: f64, y: f64) -> [f64; 6] {
    [20.0 + x / 10.0 + y / 20.0, 0.1, 0.05, 0.0, 0.0, 0.0]
}
const PLANE: &str = "20 mm + x / 10 + y / 20";

/// The greatest and the least curvature by mean and Gaussian curvature [Yang 5 to 8], positive where the part is hollow.
fn principal([_, p, q, r, s, t]: [f64; 6]) -> [f64; 2] {
    let w = 1.0 + p * p + q * q;
    let gaussian = (r * t - s * s) / (w * w);
    let mean = ((1.0 + q * q) * r - 2.0 * p * q * s + (1.0 + p * p) * t) / (2.0 * w * w.sqrt());
    let root = (mean * mean - gaussian).max(0.0).sqrt();
    [mean + root, mean - root]
}

fn middle(cell: usize) -> [f64; 2] {
    [(cell % 120) as f64 + 0.5, (cell / 120) as f64 + 0.5]
}

fn checked(part: &str, files: Files) -> Outcome {
    compile("job.vcut", &files.with("job.vcut", job(part, VCUT)))
}

fn bends(part: &str, files: Files) -> Vec<Option<Bend>> {
    let outcome = checked(part, files);
    let job = outcome
        .job
        .as_ref()
        .unwrap_or_else(|| panic!("{part}: {:?}", outcome.diagnostics));
    job.part.bends(CELLS).unwrap()
}

fn by_formula(text: &str) -> Vec<Option<Bend>> {
    bends(&format!("surface {{ z(x, y) = {text} }}"), Files::default())
}

/// Heights so many mm apart along x and y.
fn by_grid(height: Height<'_>, apart: usize) -> Vec<Option<Bend>> {
    let mut points = "x,y,z\n".to_owned();
    for y in (0..=80).step_by(apart) {
        for x in (0..=120).step_by(apart) {
            let [z, ..] = height(x as f64, y as f64);
            points += &format!("{x},{y},{z:.6}\n");
        }
    }
    let files = Files::default().with("heights.csv", points);
    bends("surface { grid \"heights.csv\" }", files)
}

const ALL: [(&str, Height<'static>); 5] = [
    (DOME, &dome),
    (BOWL, &bowl),
    (HYPAR, &hypar),
    (WAVE, &wave),
    (PLANE, &plane),
];

#[test]
fn formulas_have_the_curvatures_of_their_derivatives() {
    for (text, height) in ALL {
        for (cell, bend) in by_formula(text).into_iter().enumerate() {
            let [x, y] = middle(cell);
            let (found, wanted) = (bend.unwrap().principal, principal(height(x, y)));
            for (found, wanted) in found.iter().zip(wanted) {
                // Where both are equal, the roots of [Yang 5, 6] cancel.
                assert!(
                    (found - wanted).abs() < 1e-9,
                    "{text} {x} {y}: {found}, not {wanted}"
                );
            }
        }
    }
}

#[test]
fn heights_on_a_grid_suggest_the_same() {
    for (text, height) in ALL {
        for (cell, bend) in by_grid(height, 4).into_iter().enumerate() {
            let [x, y] = middle(cell);
            let (found, wanted) = (bend.unwrap().principal, principal(height(x, y)));
            for (found, wanted) in found.iter().zip(wanted) {
                // The waves change by 0.33 1/m for each mm; the fit reaches up to 12 mm to one side.
                assert!(
                    (found - wanted).abs() < 3e-3,
                    "{text} {x} {y}: {found}, not {wanted}"
                );
            }
        }
    }
}

#[test]
fn places_are_in_the_class_of_their_form() {
    for (text, height, class) in [
        (DOME, &dome as Height<'_>, Class::Dome),
        (BOWL, &bowl, Class::Bowl),
        (HYPAR, &hypar, Class::Saddle),
        (PLANE, &plane, Class::Flat),
    ] {
        for bends in [by_formula(text), by_grid(height, 4), by_grid(height, 10)] {
            for (cell, bend) in bends.into_iter().enumerate() {
                assert_eq!(bend.unwrap().class(), class, "{text} {:?}", middle(cell));
            }
        }
    }
    // A profile as a surface is straight along y everywhere, and changes where the sine changes its sign.
    for (cell, bend) in by_formula(WAVE).into_iter().enumerate() {
        let [x, y] = middle(cell);
        let [_, _, _, bent, ..] = wave(x, y);
        let class = bend.unwrap().class();
        assert_eq!(
            class,
            if bent > 0.0 { Class::Trough } else { Class::Ridge },
            "{x}"
        );
    }
    for (cell, bend) in by_grid(&wave, 4).into_iter().enumerate() {
        let class = bend.unwrap().class();
        let straight = [Class::Trough, Class::Ridge, Class::Flat];
        assert!(straight.contains(&class), "{:?}: {class:?}", middle(cell));
    }
}

/// A bicubic patch, whose curvatures in the middle an independent computation gives by its derivatives.
#[test]
fn control_points_suggest_the_curvature_of_their_patch() {
    let heights = [
        [10, 12, 13, 11],
        [14, 22, 20, 12],
        [13, 21, 26, 15],
        [9, 13, 16, 8],
    ];
    let mut part = "surface { nurbs { degree = (3, 3)\n".to_owned();
    for (x, row) in heights.iter().enumerate() {
        part += "row";
        for (y, z) in row.iter().enumerate() {
            part += &format!(" ({} mm, {} mm, {z} mm)", 30 * x, 20 * y);
        }
        part += "\n";
    }
    let text = job(&(part + "} }"), VCUT).replace("(120 mm, 80 mm, 60 mm)", "(90 mm, 60 mm, 60 mm)");
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    let cells = Cells {
        columns: 45,
        rows: 15,
    };
    let job = outcome
        .job
        .as_ref()
        .unwrap_or_else(|| panic!("{:?}", outcome.diagnostics));
    let bends = job.part.bends(cells).unwrap();
    // The cell whose middle is at (45, 30).
    let bend = bends[7 * 45 + 22].unwrap();
    assert!((bend.principal[0] + 5.411641719e-3).abs() < 3e-4, "{bend:?}");
    assert!((bend.principal[1] + 1.277668116e-2).abs() < 3e-4, "{bend:?}");
    assert_eq!(bend.class(), Class::Dome);
    // At the corner it is a saddle.
    assert_eq!(bends[0].unwrap().class(), Class::Saddle);
}

#[test]
fn maps_say_where_the_part_is_the_most_hollow() {
    let surface = |text: &str| format!("surface {{ z(x, y) = {text} }}");
    for (part, curvature, class) in [
        (
            surface(BOWL),
            "; smallest hollow radius 450 mm",
            "bowl everywhere",
        ),
        (surface(DOME), "; nowhere hollow", "dome everywhere"),
        (
            surface(HYPAR),
            "; smallest hollow radius 300 mm",
            "saddle everywhere",
        ),
        (
            surface(PLANE),
            "0.000 1/m everywhere; nowhere hollow",
            "flat everywhere",
        ),
    ] {
        let outcome = checked(&part, Files::default());
        let material = Material::of(&outcome).unwrap();
        let curved = Curved::of(&material).unwrap();
        let figures = curved.curvature.figures();
        assert!(figures.ends_with(curvature), "{part}: {figures}");
        assert_eq!(curved.class.figures(), class, "{part}");
    }
}

#[test]
fn maps_are_in_the_page_as_by_themselves() {
    let outcome = compile("finished_dome.vcut", &folder());
    let page = page(&outcome, Further::NOTHING).unwrap();
    for (ids, what) in [("curvature-", "curvature"), ("class-", "class")] {
        assert!(
            page.contains(&picture(what, &outcome, Prefix::new(ids))),
            "{what}"
        );
        assert!(page.contains(&format!("id=\"{what}-phone-title\"")), "{what}");
    }
    let material = Material::of(&outcome).unwrap();
    let curved = Curved::of(&material).unwrap();
    // The radius of the disc is the limit: what is more hollow takes no disc of that size.
    let limit = curved.curvature.limit().unwrap();
    assert!(limit.starts_with("curvature of the disc, "), "{limit}");
    let svg = curved.curvature.draw(Prefix::NONE);
    assert!(svg.contains("nothing above the curvature of the disc, "));

    let straight = compile("fairing.vcut", &folder());
    let material = Material::of(&straight).unwrap();
    assert_eq!(pictures::curvature(&material, Prefix::NONE), None);
    assert_eq!(pictures::class(&material, Prefix::NONE), None);
}

#[test]
fn an_edge_of_a_formula_has_no_curvature() {
    let part = "surface { z(x, y) = 40 mm - abs(x - 60 mm) / 3 + y^2 / 2000 mm }";
    let outcome = checked(part, Files::default());
    let cells = Cells { columns: 3, rows: 2 };
    let bends = outcome.job.as_ref().unwrap().part.bends(cells).unwrap();
    // The middles are at 20, 60 and 100 mm across; the edge is at 60 mm.
    for row in bends.chunks(3) {
        assert_eq!(row[1], None);
        for bend in [row[0].unwrap(), row[2].unwrap()] {
            assert_eq!(bend.class(), Class::Trough, "{bend:?}");
        }
    }
}
