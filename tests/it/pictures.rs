//! Pictures of jobs: what they show is what the report says, they stay within their sheets, and those in the documentation are
//! true.

use crate::pipeline::compile;
use crate::repository::{read, root};
use crate::shop::{compiled, compiling, folder};
use std::collections::BTreeSet;
use std::fs;
use vcutc::driver::Outcome;
use vcutc::geometry::curve::Point2;
use vcutc::picture::over_time::{COLUMNS, Course, Span};
use vcutc::picture::strips::Strips;
use vcutc::picture::thin::Thinned;
use vcutc::picture::{PAGE_WIDTH, PHONE_WIDTH, Prefix, contour, joints, lattice};
use vcutc::process::verdict;
use vcutc::report::{Material, pictures};
use vcutc::simulation::cross_section::Taken;
use vcutc::simulation::prove;
use vcutc_backend_api::ir::{Action, Site};
use vcutc_machine::kinematics::pose::Pose;

/// A job whose part changes along y, for maps.
pub(crate) const BENT_HILL: &str = "job \"bent_hill\"
stock { size = (120 mm, 80 mm, 50 mm) }
surface { z(x, y) = 22 mm + 14 mm * sin(x / 120 mm * 180 deg) - (y - 30 mm)^2 / 250 mm }
blade dagger {
  cutting_length = 25 mm
  half_apex      = 7.13 deg
  thickness      = 1.5 mm
  edges          = double
}
rough vcut {
  blade     = dagger
  lattice   = orthogonal
  rake      = 60 deg
  limits    { swing <= 50 deg, scallop <= 3 mm }
  allowance = 0.5 mm
  feed      { cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";

/// The pictures of `docs/pictures.md`: example, what is drawn.
const SHOWN: [(&str, &str); 14] = [
    ("fairing", "lattice"),
    ("fairing", "contour"),
    ("fairing", "deviation"),
    ("wavy_panel", "correlation"),
    ("wavy_panel", "joints"),
    ("spoiler_clarky", "torques"),
    ("wavy_panel", "time"),
    ("bent_hill", "surface"),
    ("canopy", "curvature"),
    ("canopy", "class"),
    ("bent_hill", "residual"),
    ("finished_dome", "finished"),
    ("finished_dome", "tracks"),
    ("seat", "passes"),
];

fn outcome(example: &str) -> Outcome {
    let files = folder().with("bent_hill.vcut", BENT_HILL);
    compile(&format!("{example}.vcut"), &files)
}

pub(crate) fn picture(what: &str, outcome: &Outcome, ids: Prefix) -> String {
    let material = Material::of(outcome).unwrap();
    match what {
        "lattice" => pictures::lattice(&material, ids),
        "contour" => pictures::contour(&material, ids),
        "deviation" => pictures::deviation(&material, ids),
        "correlation" => pictures::correlation(&material, ids),
        "joints" => pictures::joints(&material, ids).unwrap(),
        "time" => pictures::time(&material, ids),
        "surface" => pictures::surface(&material, ids).unwrap(),
        "curvature" => pictures::curvature(&material, ids).unwrap(),
        "class" => pictures::class(&material, ids).unwrap(),
        "residual" => pictures::residual(&material, ids).unwrap(),
        "finished" => pictures::finished(&material, ids).unwrap(),
        "tilt" => pictures::tilt(&material, ids).unwrap(),
        "tracks" => pictures::tracks(&material, ids).unwrap(),
        "passes" => pictures::passes(&material, ids).unwrap(),
        "torques" => {
            let [picture] = pictures::torques(&material, [ids]).unwrap().pictures;
            picture
        }
        "deviation-by-forces" => {
            let [picture] = pictures::by_forces(&material, [ids]).unwrap();
            picture
        }
        what => panic!("{what}"),
    }
}

const ALL: [&str; 6] = ["lattice", "contour", "deviation", "correlation", "joints", "time"];
const MAPS: [&str; 4] = ["surface", "curvature", "class", "residual"];

#[test]
fn pictures_in_the_documentation_are_true() {
    let mut stale = Vec::new();
    for (example, what) in SHOWN {
        let path = format!("docs/images/{example}_{what}.svg");
        let drawn = picture(what, &outcome(example), Prefix::NONE);
        if std::env::var_os("UPDATE_PICTURES").is_some() {
            fs::write(root().join(&path), drawn).unwrap();
        } else if fs::read_to_string(root().join(&path)).unwrap_or_default() != drawn {
            stale.push(path);
        }
        let page = read("docs/pictures.md");
        assert!(
            page.contains(&format!("images/{example}_{what}.svg")),
            "{example} {what}"
        );
        assert!(page.contains(&format!("--what {what}")), "{what}");
    }
    assert_eq!(
        stale, [""; 0],
        "UPDATE_PICTURES=1 cargo test --test it pictures writes them again; look at them before"
    );
}

/// The area of a polygon, by the sum of its trapezoids.
fn area(outline: &[Point2]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let strips = outline.iter().zip(next).map(|(a, b)| (b.x - a.x) * (a.z + b.z));
    strips.sum::<f64>() / 2.0
}

/// Whether an example is cut in Vs only.
fn is_of_vs((example, _): &(String, Vec<crate::shop::Pairing>)) -> bool {
    let others = ["_rect.vcut", "_auto.vcut"];
    !others.iter().any(|end| example.ends_with(end))
        && !example.starts_with("finished_")
        && !["seat.vcut", "window.vcut", "bay.vcut"].contains(&example.as_str())
}

#[test]
fn chips_add_up_to_what_is_removed() {
    // Strips are not chips of a V, and pockets free none.
    for (example, pairings) in compiling().into_iter().filter(is_of_vs) {
        let outcome = compiled(pairings[0].machine, &example);
        let material = Material::of(outcome).unwrap();
        let program = material.compiled.program.verified();
        let mut all = Vec::new();
        let (last, _) = prove::watched(program, &verdict::bounds(material.plan), &mut |_, _, taken| {
            all.extend(taken)
        });
        all.extend(last);
        let (mut chips, mut count) = (0.0, 0);
        for taken in all {
            let Taken::Chip(chip) = taken else { continue };
            count += 1;
            chips += area(&chip.outline());
            let lowest = |line: &[Point2]| line.iter().map(|corner| corner.z).fold(f64::INFINITY, f64::min);
            assert!(lowest(&chip.floor) <= lowest(&chip.top), "{example}: {chip:?}");
        }
        let report = &material.compiled.report;
        let removed = report.removed.to_mm2();
        assert!(
            (chips - removed).abs() < 1e-6 * removed,
            "{example}: {chips} {removed}"
        );
        assert!(count <= report.cuts(), "{example}: {count}");
    }
}

#[test]
fn what_is_marked_is_what_the_report_says() {
    for (example, pairings) in compiling() {
        let outcome = compiled(pairings[0].machine, &example);
        let material = Material::of(outcome).unwrap();
        let report = &material.compiled.report;
        let scallop = report.scallop.height.to_mm();
        let marked = format!("{scallop:.2} mm");
        for what in ["contour", "deviation"] {
            assert!(
                picture(what, outcome, Prefix::NONE).contains(&marked),
                "{example} {what}"
            );
        }
        let curve = pictures::deviation_curve(&material);
        assert_eq!(curve.len(), 1000, "{example}");
        let highest = curve.iter().map(|point| point[1]).fold(0.0, f64::max);
        assert!(highest <= scallop + 1e-3, "{example}: {highest} {scallop}");
        assert!(report.largest_deviation() >= report.scallop.height);
        let share = format!(">{:.4} at lag ", report.correlation);
        assert!(
            picture("correlation", outcome, Prefix::NONE).contains(&share),
            "{example}"
        );
    }
}

/// Every picture of every example is a document with a title and a description, has ids of its own, and draws nothing beside
/// its sheet.
#[test]
fn pictures_stay_within_their_sheets() {
    // The lattice shows a strip by the centre of its disc, which may run beside the stock and the sheet.
    for (example, pairings) in compiling().into_iter().filter(is_of_vs) {
        let outcome = compiled(pairings[0].machine, &example);
        for what in ALL {
            assert_within_its_sheet(&example, what, outcome);
        }
    }
    let outcome = outcome("bent_hill");
    for what in MAPS {
        assert_within_its_sheet("bent_hill", what, &outcome);
    }
}

pub(crate) fn assert_within_its_sheet(example: &str, what: &str, outcome: &Outcome) {
    let svg = picture(what, outcome, Prefix::new("here-"));
    assert!(svg.len() < 300_000, "{example} {what}: {} bytes", svg.len());
    let document = roxmltree::Document::parse(&svg).unwrap();
    let sheet = document.root_element();
    let ids: Vec<&str> = document
        .descendants()
        .filter_map(|node| node.attribute("id"))
        .collect();
    assert!(ids.iter().all(|id| id.starts_with("here-")), "{ids:?}");
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
    assert_eq!(
        sheet.attribute("aria-labelledby"),
        Some("here-title here-description")
    );
    assert!(ids.contains(&"here-title") && ids.contains(&"here-description"));
    let size = ["width", "height"].map(|side| sheet.attribute(side).unwrap().parse::<f64>().unwrap());
    for node in document.descendants() {
        for [x, y] in node.attribute("d").map(corners).unwrap_or_default() {
            let shift = if node.attribute("transform").is_some() {
                20.0
            } else {
                0.0
            };
            let within = |value: f64, size: f64| (-shift..=size).contains(&value);
            assert!(
                within(x, size[0]) && within(y, size[1]),
                "{example} {what}: {x} {y}"
            );
        }
    }
}

/// Maps of a part that changes along y, in its page as by themselves; none of a part that is a profile.
#[test]
fn maps_are_of_parts_that_change_along_y() {
    let bent = outcome("bent_hill");
    let material = Material::of(&bent).unwrap();
    let page = vcutc::report::page::page(&bent, vcutc::report::page::Further::NOTHING).unwrap();
    for (ids, name) in [
        (Prefix::new("surface-"), "surface"),
        (Prefix::new("residual-"), "residual"),
    ] {
        assert!(page.contains(&picture(name, &bent, ids)), "{name}");
        assert!(page.contains(&format!("id=\"{name}-phone-title\"")), "{name}");
    }
    assert!(page.contains("<a href=\"#surface\">Surface</a>"));
    // The part is highest at (60, 30) and falls off by 10 mm to y = 80, where at least that much stays.
    let heights = pictures::SurfaceMap::of_part(&material).unwrap().figures();
    assert!(heights.ends_with(", most 36.00 mm"), "{heights}");
    let left = pictures::SurfaceMap::of_residual(&material).unwrap().figures();
    let (_, most) = left.split_once("most ").unwrap();
    let most: f64 = most.trim_end_matches(" mm").parse().unwrap();
    assert!((10.0..16.0).contains(&most), "{left}");

    let straight = outcome("fairing");
    let material = Material::of(&straight).unwrap();
    assert_eq!(pictures::surface(&material, Prefix::NONE), None);
    assert_eq!(pictures::residual(&material, Prefix::NONE), None);
    let page = vcutc::report::page::page(&straight, vcutc::report::page::Further::NOTHING).unwrap();
    assert!(!page.contains("id=\"surface\"") && !page.contains("residual-title"));
}

/// What finishing leaves over a surface, in its page as by itself; none where nothing is finished, or only a profile.
#[test]
fn maps_show_what_finishing_leaves() {
    let dome = outcome("finished_dome");
    let material = Material::of(&dome).unwrap();
    let page = vcutc::report::page::page(&dome, vcutc::report::page::Further::NOTHING).unwrap();
    assert!(page.contains(&picture("finished", &dome, Prefix::new("finished-"))));
    assert!(page.contains("contour after finishing, at this y"));
    // Straight above the part more stands than its distance from there, by no more than the steepest slope makes of it.
    let figures = pictures::SurfaceMap::of_finished(&material).unwrap().figures();
    let (_, most) = figures.split_once("most ").unwrap();
    let most: f64 = most.trim_end_matches(" mm").parse().unwrap();
    let tracked = &dome.compiled.as_ref().unwrap().report.tracked[0];
    let left = tracked.left.to_mm();
    assert!((left - 0.005..1.3 * left).contains(&most), "{figures} {left}");

    for other in ["bent_hill", "finished_hood"] {
        let outcome = outcome(other);
        let material = Material::of(&outcome).unwrap();
        assert_eq!(pictures::finished(&material, Prefix::NONE), None, "{other}");
        let page = vcutc::report::page::page(&outcome, vcutc::report::page::Further::NOTHING).unwrap();
        assert!(
            !page.contains("finished-title") && !page.contains("after finishing"),
            "{other}"
        );
    }
}

/// The tilt of a map and the length of tracks are those of the poses in the program, computed from the formula of the dome; in its page
/// both pictures are as by themselves.
#[test]
fn tilts_and_tracks_are_those_of_the_program() {
    let dome = outcome("finished_dome");
    let material = Material::of(&dome).unwrap();
    let program = dome.compiled.as_ref().unwrap().program.verified().program();
    let (mut tilts, mut length, mut cuts): (Vec<f64>, f64, BTreeSet<u32>) =
        (Vec::new(), 0.0, BTreeSet::new());
    for segment in program.segments() {
        let (Action::Follow { .. }, Site::Cut { cut, .. }) = (segment.op.action, segment.op.site) else {
            continue;
        };
        let line = segment.line().unwrap();
        cuts.insert(cut.get());
        length += line.from.tip.distance(line.to.tip).to_mm();
        let frame = program.frame(line.to).unwrap();
        let (x, y) = (frame.origin.x, frame.origin.y);
        if (0.0..=140.0).contains(&x) && (0.0..=160.0).contains(&y) {
            let normal = glam::DVec3::new((x - 70.0) / 450.0, (y - 80.0) / 10_000.0, 1.0).normalize();
            let axis = Pose::from(frame).rotation.z_axis;
            tilts.push(libm::acos(axis.dot(normal).abs()).to_degrees());
        }
    }
    assert!(tilts.len() > 300, "{}", tilts.len());
    // The disc touches the part a radius ahead of the centre of its edge, where the normal of the flat dome is nearly the same.
    let figures = pictures::SurfaceMap::of_tilt(&material).unwrap().figures();
    let tilt: f64 = figures.strip_suffix(" deg everywhere").unwrap().parse().unwrap();
    let least = tilts.iter().copied().fold(f64::INFINITY, f64::min);
    let most = tilts.iter().copied().fold(0.0, f64::max);
    assert!(
        tilt > least - 0.15 && tilt < most + 0.15,
        "{figures}, {least} to {most} deg"
    );
    let tracks = pictures::DiscTracks::of(&material).unwrap().figures();
    let words = format!("{} tracks, {:.2} m in all;", cuts.len(), length / 1000.0);
    assert!(tracks.starts_with(&words), "{tracks}, {words}");
    let page = vcutc::report::page::page(&dome, vcutc::report::page::Further::NOTHING).unwrap();
    for (what, prefix) in [("tilt", "tilt-"), ("tracks", "tracks-")] {
        assert!(
            page.contains(&picture(what, &dome, Prefix::new(prefix))),
            "{what}"
        );
    }

    // Tracks on a profile are drawn, their tilt is the same everywhere; without tracks there are neither.
    let hood = outcome("finished_hood");
    let hood = Material::of(&hood).unwrap();
    assert!(pictures::tracks(&hood, Prefix::NONE).is_some());
    assert_eq!(pictures::tilt(&hood, Prefix::NONE), None);
    let hill = outcome("bent_hill");
    let hill = Material::of(&hill).unwrap();
    assert_eq!(pictures::tracks(&hill, Prefix::NONE), None);
    assert_eq!(pictures::tilt(&hill, Prefix::NONE), None);
}

/// In a page on a dark ground every colour of every picture has a partner, and pictures for telephones are as wide as these.
#[test]
fn every_colour_is_another_one_in_the_dark() {
    for (example, pairings) in compiling() {
        let outcome = compiled(pairings[0].machine, &example);
        let page = vcutc::report::page::page(outcome, vcutc::report::page::Further::NOTHING).unwrap();
        let (_, dark) = page
            .split_once("(prefers-color-scheme: dark) {\n.view svg")
            .unwrap();
        let (dark, _) = dark.split_once("</style>").unwrap();
        for what in ALL {
            assert_dark(&example, what, outcome, dark);
        }
    }
    let outcome = outcome("bent_hill");
    for what in MAPS {
        assert_dark("bent_hill", what, &outcome, &vcutc::picture::dark(".view svg"));
    }
}

pub(crate) fn assert_dark(example: &str, what: &str, outcome: &Outcome, dark: &str) {
    for ids in [Prefix::new("page-"), Prefix::for_phones("phone-")] {
        let svg = picture(what, outcome, ids);
        let document = roxmltree::Document::parse(&svg).unwrap();
        for node in document.descendants() {
            for paint in ["fill", "stroke"] {
                if let Some(colour) = node.attribute(paint).filter(|colour| colour.starts_with('#')) {
                    let rule = format!("[{paint}=\"{colour}\"]");
                    assert!(dark.contains(&rule), "{example} {what}: {rule}");
                }
            }
        }
        let width: f64 = document
            .root_element()
            .attribute("width")
            .unwrap()
            .parse()
            .unwrap();
        let most = if ids == Prefix::new("page-") {
            PAGE_WIDTH
        } else {
            PHONE_WIDTH
        };
        assert!(width <= most, "{example} {what}: {width}");
    }
}

/// The corners of a path of any of the commands that are used.
fn corners(path: &str) -> Vec<[f64; 2]> {
    let mut corners = Vec::new();
    let (mut at, mut start) = ([0.0, 0.0], [0.0, 0.0]);
    let mut rest = path;
    while let Some(command) = rest.chars().next() {
        let end = rest[1..]
            .find(|c: char| c.is_ascii_alphabetic())
            .map_or(rest.len(), |end| end + 1);
        let spaced = rest[1..end].replace('-', " -").replace(',', " ");
        let numbers: Vec<f64> = spaced
            .split_whitespace()
            .map(|number| number.parse().unwrap())
            .collect();
        rest = &rest[end..];
        let relative = command.is_ascii_lowercase();
        match command.to_ascii_uppercase() {
            'Z' => at = start,
            'H' | 'V' => {
                for number in numbers {
                    let axis = usize::from(command.eq_ignore_ascii_case(&'v'));
                    at[axis] = if relative { at[axis] + number } else { number };
                    corners.push(at);
                }
            }
            'M' | 'L' => {
                for (index, pair) in numbers.chunks(2).enumerate() {
                    let [dx, dy] = [pair[0], pair[1]];
                    at = if relative {
                        [at[0] + dx, at[1] + dy]
                    } else {
                        [dx, dy]
                    };
                    if index == 0 && command.eq_ignore_ascii_case(&'m') {
                        start = at;
                    }
                    corners.push(at);
                }
            }
            // The end of an arc: the last two of its seven numbers. Half circles stay within a diameter of it.
            'A' => {
                for arc in numbers.chunks(7) {
                    at = if relative {
                        [at[0] + arc[5], at[1] + arc[6]]
                    } else {
                        [arc[5], arc[6]]
                    };
                    corners.push(at);
                }
            }
            command => panic!("{command} in {path}"),
        }
    }
    corners
}

const HEADING: lattice::Heading<'_> = lattice::Heading {
    ids: Prefix::NONE,
    title: "a large job",
    subtitle: "",
};

/// Tips of so many cuts in layers of a hundred, with the V of each.
fn many(count: u32) -> (Vec<lattice::Tip>, Vec<[[f64; 2]; 3]>) {
    let at = |number: u32| {
        let (column, layer) = (number % 100, number / 100);
        [f64::from(column) * 10.0 + 5.0, 100.0 - 0.0007 * f64::from(layer)]
    };
    let origin = |number: u32| match number % 7 {
        0 => lattice::Origin::Lifted,
        1 => lattice::Origin::Shifted,
        2 => lattice::Origin::Relieved,
        _ => lattice::Origin::Lattice,
    };
    let tip = |number: u32| lattice::Tip {
        at: at(number),
        origin: origin(number),
    };
    let vee = |number: u32| {
        let [x, z] = at(number);
        [[x - 4.13, z + 3.77], [x, z], [x + 4.13, z + 3.77]]
    };
    ((0..count).map(tip).collect(), (0..count).map(vee).collect())
}

#[test]
fn pictures_of_large_jobs_stay_small() {
    let part = [[0.0, 10.0], [1000.0, 10.0]];
    for (count, drawn) in [(99, true), (100, false), (20_001, false), (400_000, false)] {
        let (tips, vees) = many(count);
        let surface = |number: i32| {
            (0..5000)
                .map(|i| [f64::from(i) / 5.0, 100.0 - f64::from(number) - f64::from(i % 2)])
                .collect()
        };
        let surfaces: Vec<Vec<[f64; 2]>> = (0..60).map(surface).collect();
        let picture = lattice::draw(&lattice::Lattice {
            heading: HEADING,
            stock: [1000.0, 120.0],
            part: &part,
            bounds: &[],
            tips: &tips,
            vees: &vees,
            strips: Strips::default(),
            surfaces: &surfaces,
            layers: &[],
        });
        assert!(
            picture.len() < 3_000_000,
            "lattice of {count}: {} bytes",
            picture.len()
        );
        assert_eq!(picture.contains("flanks, as far as they cut"), drawn, "{count}");
        assert_eq!(picture.contains("layer by layer"), !drawn, "{count}");
        let chip = |(number, vee): (usize, &[[f64; 2]; 3])| contour::Chip {
            layer: number as u32 / 100,
            outline: vec![
                vee[0],
                [vee[1][0] - 2.0, vee[0][1]],
                [vee[1][0] + 2.0, vee[0][1]],
                vee[2],
                vee[1],
            ],
        };
        let chips: Vec<contour::Chip> = vees.iter().enumerate().map(chip).collect();
        let machined: Vec<[f64; 2]> = (0..count)
            .map(|i| [f64::from(i) * 1000.0 / f64::from(count), 20.0 + f64::from(i % 2)])
            .collect();
        let picture = contour::draw(&contour::Contour {
            heading: HEADING,
            stock: [1000.0, 120.0],
            part: &part,
            machined: &machined,
            chips: &chips,
            surfaces: &surfaces,
            highest: contour::Highest {
                peak: [500.0, 21.0],
                height: 11.0,
            },
        });
        assert!(
            picture.len() < 3_000_000,
            "contour of {count}: {} bytes",
            picture.len()
        );
        assert_eq!(picture.contains("chips of odd layers"), drawn, "{count}");
    }
}

#[test]
fn axes_of_large_jobs_stay_small_and_keep_their_extremes() {
    let samples = 600_000_u32;
    let curve = |axis: u32| {
        let mut thinned = Thinned::new(0.0, f64::from(samples), COLUMNS);
        for sample in 0..samples {
            let spike = if sample == 123_456 { 60.0 } else { 0.0 };
            let value = f64::from(sample.wrapping_mul(2_654_435_761 + axis) >> 8) / f64::from(1 << 24) * 50.0;
            thinned.push([f64::from(sample), value + spike]);
        }
        thinned.finish()
    };
    let axes: Vec<joints::Axis> = (0..6)
        .map(|axis| joints::Axis {
            name: format!("A{}", axis + 1),
            unit: "deg",
            limits: [-120.0, 185.0],
            values: curve(axis),
            rates: Some(
                curve(axis)
                    .into_iter()
                    .map(|[time, value]| [time, value / 120.0])
                    .collect(),
            ),
            highest_rate: Some(0.9),
        })
        .collect();
    let span = |number: u32| Span {
        time: [f64::from(number) * 10.0, f64::from(number + 1) * 10.0],
        kind: number as usize % 3,
    };
    let spans: Vec<Span> = (0..samples / 10).map(span).collect();
    let course = Course {
        seconds: f64::from(samples),
        kinds: &["cutting", "turning", "travel"],
        spans: &spans,
        layers: &[(0.0, "1".to_owned())],
        cuts: 60_000,
    };
    let picture = joints::draw(&joints::Joints {
        heading: HEADING,
        course: &course,
        axes: &axes,
        margin: &curve(9)
            .into_iter()
            .map(|[time, value]| [time, value / 200.0])
            .collect::<Vec<_>>(),
    });
    assert!(picture.len() < 300_000, "{} bytes", picture.len());
    let highest = axes
        .iter()
        .flat_map(|axis| &axis.values)
        .map(|point| point[1])
        .fold(0.0, f64::max);
    assert!(highest >= 60.0 && picture.contains(&format!(" to {highest:.1} deg")));
}

/// What stays in a pocket whose passes are too far apart: both areas of the picture are those of the proof, and places between passes
/// have the first numbers.
#[test]
fn the_ground_of_a_pocket_that_stays_is_numbered() {
    let job = "job \"tray\"
stock { size = (180 mm, 120 mm, 30 mm) }
blade hog = crusher { radius = 6 mm, height = 24 mm, spin = 18000 rev/min, ramp = 5 deg }
region seat {
  start (20 mm, 15 mm) line to (150 mm, 20 mm) line to (120 mm, 100 mm) line to (20 mm, 90 mm)
  island { circle (70 mm, 55 mm) radius 12 mm }
}
clear pocket {
  region = seat, blade = hog, floor = 8 mm, pattern = offset, step = 10 mm, entry = ramp
  limits { uncut <= 400 mm2 }
  feed { cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";
    let tray = compile("tray.vcut", &folder().with("tray.vcut", job));
    let material = Material::of(&tray).unwrap();
    let picture = pictures::ground(&material, Prefix::NONE).unwrap();
    let cleared = tray.compiled.as_ref().unwrap().report.cleared[0];
    let area = |what: &str| -> f64 {
        let before = picture.split(what).next().unwrap();
        let number = before.split_whitespace().nth_back(1).unwrap();
        number.parse().unwrap()
    };
    let uncut = area(" that no pass cuts");
    assert!(
        uncut > 10.0 && (uncut - cleared.uncut.to_mm2()).abs() < 0.1,
        "{uncut} {cleared:?}"
    );
    let beyond = area(" that no tool of its radius reaches");
    assert!(
        (beyond - cleared.beyond_reach.to_mm2()).abs() < 0.1,
        "{beyond} {cleared:?}"
    );
    for number in 1..=9 {
        assert!(picture.contains(&format!(">{number}</text>")), "{number}");
    }
    // The widest place between passes is the first.
    let first = picture.split("1: ").nth(1).unwrap();
    let first: f64 = first.split_whitespace().next().unwrap().parse().unwrap();
    assert!(first < uncut && first > 20.0, "{first}");
    let hill = outcome("bent_hill");
    assert_eq!(
        pictures::ground(&Material::of(&hill).unwrap(), Prefix::NONE),
        None
    );
}
