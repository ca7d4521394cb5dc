//! All offset levels of pockets, by us and by others, in one run: `cargo run --release --bin pockets`.
//!
//! Each answer is compared before a time counts: the lengths of all levels agree to a thousandth. Times are the least of many rounds,
//! the parties taking turns, so that what else the machine does hits all of them. A second table has what no other party does: the
//! rim's engagement, the proof that nothing stays, and passes along a field.

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use clipper2_rust::core::{PathsD, PointD};
use clipper2_rust::{EndType, JoinType, inflate_paths_d};
use std::hint::black_box;
use std::time::{Duration, Instant};
use vcutc_field::axis::Detail;
use vcutc_field::passes::{Wanted, passes as field_passes};
use vcutc_region::coverage::{self, coverage};
use vcutc_region::engagement::engagement;
use vcutc_region::offset::{Kind, Offsets};
use vcutc_region::pattern::{Pattern, Tool, passes};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::{Edge, Region, Side};

/// A corner, and the tangent of a quarter of the angle of the arc to the next one.
type Corner = (f64, f64, f64);

/// How far chords leave arcs in polygons for Clipper2, in mm.
const CHORD: f64 = 0.01;

/// How many rounds are measured; Clipper2 takes part in every tenth.
const ROUNDS: u32 = 400;

/// How many rounds of the second table are measured.
const PROOF_ROUNDS: u32 = 30;

const TOOL: Tool = Tool {
    radius: 5.0,
    standoff: 0.0,
    run_out: 0.0,
};

const QUARTER: f64 = 0.414_213_562_373_095_03;

struct Pocket {
    name: &'static str,
    loops: Vec<Vec<Corner>>,
    step: f64,
}

fn pockets() -> Vec<Pocket> {
    let line = |corners: &[(f64, f64)]| corners.iter().map(|&(x, y)| (x, y, 0.0)).collect::<Vec<_>>();
    let circle = |x: f64, y: f64, r: f64| vec![(x + r, y, -1.0), (x - r, y, -1.0)];
    let rounded = |x: f64, y: f64, w: f64, h: f64, r: f64| {
        vec![
            (x + r, y, 0.0),
            (x + w - r, y, QUARTER),
            (x + w, y + r, 0.0),
            (x + w, y + h - r, QUARTER),
            (x + w - r, y + h, 0.0),
            (x + r, y + h, QUARTER),
            (x, y + h - r, 0.0),
            (x, y + r, QUARTER),
        ]
    };
    let island = |corners: Vec<Corner>| {
        let count = corners.len();
        (0..count)
            .rev()
            .map(|i| (corners[i].0, corners[i].1, -corners[(i + count - 1) % count].2))
            .collect::<Vec<_>>()
    };
    vec![
        Pocket {
            name: "2, an L",
            loops: vec![line(&[
                (0.0, 0.0),
                (120.0, 0.0),
                (120.0, 50.0),
                (60.0, 50.0),
                (60.0, 90.0),
                (0.0, 90.0),
            ])],
            step: 4.0,
        },
        Pocket {
            name: "3, convex arc",
            loops: vec![vec![
                (0.0, 0.0, 0.0),
                (120.0, 0.0, 0.0),
                (120.0, 45.0, 0.5),
                (0.0, 45.0, 0.0),
            ]],
            step: 4.0,
        },
        Pocket {
            name: "4, concave arc",
            loops: vec![vec![
                (0.0, 0.0, 0.0),
                (120.0, 0.0, 0.0),
                (120.0, 80.0, -0.4),
                (0.0, 80.0, 0.0),
            ]],
            step: 4.0,
        },
        Pocket {
            name: "5, island",
            loops: vec![
                rounded(0.0, 0.0, 120.0, 90.0, 15.0),
                island(rounded(45.0, 35.0, 30.0, 20.0, 5.0)),
            ],
            step: 4.0,
        },
        Pocket {
            name: "200 x 150, two islands",
            loops: vec![
                rounded(0.0, 0.0, 200.0, 150.0, 10.0),
                circle(65.0, 95.0, 15.0),
                island(rounded(115.0, 35.0, 40.0, 25.0, 6.0)),
            ],
            step: 1.65,
        },
    ]
}

fn region(pocket: &Pocket) -> Region {
    let loops = pocket.loops.iter().map(|corners| {
        let next = corners.iter().cycle().skip(1);
        corners
            .iter()
            .zip(next)
            .map(|(a, b)| Edge {
                piece: Piece::arc(Place::new(a.0, a.1), Place::new(b.0, b.1), 4.0 * a.2.atan()),
                side: Side::Wall,
            })
            .collect()
    });
    Region::new(loops.collect()).expect("it is a region")
}

fn shape(pocket: &Pocket) -> Shape<f64> {
    Shape::from_plines(pocket.loops.iter().map(|corners| {
        let mut line = Polyline::new_closed();
        for &(x, y, bulge) in corners {
            line.add(x, y, bulge);
        }
        line
    }))
}

fn polygons(pocket: &Pocket) -> PathsD {
    let flat = |corners: &Vec<Corner>| {
        let next = corners.iter().cycle().skip(1);
        let mut points = Vec::new();
        for (a, b) in corners.iter().zip(next) {
            let piece = Piece::arc(Place::new(a.0, a.1), Place::new(b.0, b.1), 4.0 * a.2.atan());
            let count = piece.radius().map_or(1.0, |radius| {
                (piece.sweep.abs() / (2.0 * (1.0 - CHORD / radius).acos())).ceil()
            });
            points.extend((0..count as u32).map(|i| piece.at(f64::from(i) / count)));
        }
        points
            .iter()
            .map(|place| PointD {
                x: place.x,
                y: place.y,
            })
            .collect()
    };
    pocket.loops.iter().map(flat).collect()
}

/// What a party found: levels, loops, pieces and length.
type Answer = (usize, usize, usize, f64);

fn add(answer: &mut Answer, loops: impl Iterator<Item = (usize, f64)>) -> bool {
    let mut is_empty = true;
    for (pieces, length) in loops {
        is_empty = false;
        answer.1 += 1;
        answer.2 += pieces;
        answer.3 += length;
    }
    answer.0 += usize::from(!is_empty);
    is_empty
}

fn distances(step: f64) -> impl Iterator<Item = f64> {
    (0..).map(move |n| 5.0 + step * f64::from(n))
}

fn ours(region: &Region, step: f64) -> Answer {
    let mut answer = Answer::default();
    let mut offsets = Offsets::of(region, 0.0);
    for distance in distances(step) {
        let ways = offsets.level(distance).expect("there is a level");
        let loops = ways.iter().filter(|way| way.kind == Kind::Loop);
        if add(&mut answer, loops.map(|way| (way.pieces.len(), way.length()))) {
            break;
        }
    }
    answer
}

fn lengths(shape: &Shape<f64>) -> impl Iterator<Item = (usize, f64)> + '_ {
    let lines = shape.ccw_plines.iter().chain(&shape.cw_plines);
    lines.map(|line| (line.polyline.vertex_count(), line.polyline.path_length()))
}

fn cavalier(shape: &Shape<f64>, step: f64) -> Answer {
    let options = ShapeOffsetOptions::default();
    let mut answer = Answer::default();
    for distance in distances(step) {
        if add(&mut answer, lengths(&shape.parallel_offset(distance, &options))) {
            break;
        }
    }
    answer
}

fn cavalier_chained(shape: &Shape<f64>, step: f64) -> Answer {
    let options = ShapeOffsetOptions::default();
    let mut answer = Answer::default();
    let mut level = shape.parallel_offset(5.0, &options);
    while !add(&mut answer, lengths(&level)) {
        level = level.parallel_offset(step, &options);
    }
    answer
}

fn clipper(polygons: &PathsD, step: f64) -> Answer {
    let mut answer = Answer::default();
    for distance in distances(step) {
        let level = inflate_paths_d(
            polygons,
            -distance,
            JoinType::Round,
            EndType::Polygon,
            2.0,
            4,
            CHORD,
        );
        let length = |path: &Vec<PointD>| {
            let next = path.iter().cycle().skip(1);
            path.iter()
                .zip(next)
                .map(|(a, b)| (a.x - b.x).hypot(a.y - b.y))
                .sum()
        };
        if add(&mut answer, level.iter().map(|path| (path.len(), length(path)))) {
            break;
        }
    }
    answer
}

fn least(best: &mut Duration, work: &mut dyn FnMut()) {
    let begin = Instant::now();
    work();
    *best = (*best).min(begin.elapsed());
}

fn consume<T>(answer: T) {
    black_box(answer);
}

fn main() {
    println!(
        "| pocket | levels, loops, pieces | length mm | ours | cavalier, shape | cavalier, chained | Clipper2 | smooth passes |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for pocket in pockets() {
        let (region, shape, polygons, step) =
            (region(&pocket), shape(&pocket), polygons(&pocket), pocket.step);
        let answer = ours(&region, step);
        for (name, other) in [
            ("cavalier", cavalier(&shape, step)),
            ("cavalier, chained", cavalier_chained(&shape, step)),
            ("Clipper2", clipper(&polygons, step)),
        ] {
            if (other.3 - answer.3).abs() > 1e-3 * answer.3 {
                println!("{name} differs: {other:?}, ours {answer:?}");
            }
        }
        let mut times = [Duration::MAX; 5];
        for round in 0..ROUNDS {
            least(&mut times[0], &mut || consume(ours(black_box(&region), step)));
            least(&mut times[1], &mut || consume(cavalier(black_box(&shape), step)));
            least(&mut times[2], &mut || {
                consume(cavalier_chained(black_box(&shape), step))
            });
            if round % 10 == 0 {
                least(&mut times[3], &mut || {
                    consume(clipper(black_box(&polygons), step))
                });
            }
            let pattern = Pattern::Smooth { step, corner: 5.0 };
            least(&mut times[4], &mut || {
                consume(passes(black_box(&region), &TOOL, pattern))
            });
        }
        let time = |at: usize| {
            let ratio = times[at].as_secs_f64() / times[0].as_secs_f64();
            format!("{:.3} ms ({ratio:.2})", times[at].as_secs_f64() * 1e3)
        };
        let (levels, loops, pieces, length) = answer;
        println!(
            "| {} | {levels}, {loops}, {pieces} | {length:.1} | {} | {} | {} | {} | {} |",
            pocket.name,
            time(0),
            time(1),
            time(2),
            time(3),
            time(4)
        );
    }
    proofs();
}

/// Pocket 1, which is open on its right.
fn open_pocket() -> Region {
    let corners = [
        (20.0, 0.0),
        (120.0, 0.0),
        (120.0, 80.0),
        (20.0, 80.0),
        (0.0, 60.0),
        (0.0, 25.0),
    ];
    let place = |(x, y): (f64, f64)| Place::new(x, y);
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next).enumerate();
    let edges = edges.map(|(number, (&from, &to))| Edge {
        piece: Piece::line(place(from), place(to)),
        side: if number == 1 { Side::Open } else { Side::Wall },
    });
    Region::new(vec![edges.collect()]).expect("it is a region")
}

/// The least time of some rounds, in ms.
fn fastest<T>(mut work: impl FnMut() -> T) -> f64 {
    let mut best = Duration::MAX;
    for _ in 0..PROOF_ROUNDS {
        least(&mut best, &mut || consume(work()));
    }
    best.as_secs_f64() * 1e3
}

fn proofs() {
    println!(
        "\n| pocket | engagement, offset | sfs | coverage, offset | sfs | field, lift s/2 | lift 0.2 mm |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    let mut regions = vec![("1, open", open_pocket(), 4.0)];
    let closed = pockets();
    regions.extend(
        closed
            .iter()
            .map(|pocket| (pocket.name, region(pocket), pocket.step)),
    );
    for (name, region, step) in &regions {
        let step = *step;
        let mut row = format!("| {name}");
        let patterns = [Pattern::Offset { step }, Pattern::Smooth { step, corner: 5.0 }];
        // From the inside out, as they are cut.
        let cut = patterns.map(|pattern| {
            let mut cut = passes(region, &TOOL, pattern).expect("there are passes");
            cut.reverse();
            cut
        });
        for cut in &cut {
            row += &format!(
                " | {:.2}",
                fastest(|| engagement(region, black_box(cut), TOOL.radius))
            );
        }
        for cut in &cut {
            let tool = coverage::Tool::touching(TOOL.radius);
            row += &format!(" | {:.2}", fastest(|| coverage(region, black_box(cut), tool)));
        }
        // The large one has too fine steps for a field to be worth while.
        for lift in [step / 2.0, 0.2] {
            let wanted = Wanted {
                step,
                lift,
                detail: Detail::True,
                uncut: 0.01,
            };
            row += &if step < 2.0 {
                " | -".to_owned()
            } else {
                format!(
                    " | {:.1}",
                    fastest(|| field_passes(black_box(region), &TOOL, &wanted))
                )
            };
        }
        println!("{row} |");
    }
}
