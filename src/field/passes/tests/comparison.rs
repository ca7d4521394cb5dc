//! The tables in `docs/pocket_patterns.md`: they compare patterns of passes on five pockets.
//!
//! `UPDATE_DOCS=1 cargo test -p vcutc-field comparison` rewrites them.

use super::figures::{Figures, Slot};
use super::*;
use crate::lines::Line;
use core::f64::consts::{FRAC_PI_2, PI};
use rayon::prelude::*;
use std::path::Path;
use vcutc_region::pattern::{self, Pattern};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/pocket_patterns.md");

/// The tool: its rim may touch the walls.
const BARE: Tool = Tool {
    radius: 5.0,
    standoff: 0.0,
    run_out: 0.0,
};

/// The largest radius of corners in mm: at twice the acceleration and twice the feed what the time model needs, `v^2 / a`.
const CORNER: f64 = 5.0;

const STEPS: [f64; 2] = [4.0, 5.0];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Offset,
    Zigzag,
    Sfs,
    /// The lines of the field, lifted by half a step.
    Lifted,
    /// The same, hardly lifted.
    Flat,
}

const KINDS: [Kind; 5] = [Kind::Offset, Kind::Zigzag, Kind::Sfs, Kind::Lifted, Kind::Flat];

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Offset => "`offset`",
            Self::Zigzag => "`zigzag`",
            Self::Sfs => "`sfs`",
            Self::Lifted => "field, lift s/2",
            Self::Flat => "field, lift 0.2 mm",
        }
    }

    fn figures(self, region: &Region, step: f64) -> Figures {
        let planned = |pattern, slot| {
            let passes = pattern::passes(region, &BARE, pattern).unwrap();
            Figures::of(region, &passes, BARE.radius, slot)
        };
        let field = |lift| {
            let found = passes(region, &BARE, &wanted(step, lift, Detail::True)).unwrap();
            Figures::of(region, &found.all(), BARE.radius, Slot::Pass)
        };
        match self {
            Self::Offset => planned(Pattern::Offset { step }, Slot::Pass),
            Self::Sfs => planned(Pattern::Smooth { step, corner: CORNER }, Slot::Pass),
            Self::Zigzag => {
                let rows = |angle| planned(Pattern::Zigzag { step, angle }, Slot::Row);
                let (across, along) = (rows(0.0), rows(FRAC_PI_2));
                if across.time <= along.time { across } else { along }
            }
            Self::Lifted => field(step / 2.0),
            Self::Flat => field(0.2),
        }
    }
}

/// The figures of a pattern for all pockets.
struct Row {
    kind: Kind,
    pockets: Vec<Figures>,
}

impl Row {
    fn sum(&self) -> Figures {
        self.pockets.iter().copied().reduce(Figures::with).unwrap()
    }
}

fn rows(step: f64) -> Vec<Row> {
    let pairs: Vec<(Kind, usize)> = KINDS
        .into_iter()
        .flat_map(|kind| (1..=5).map(move |number| (kind, number)))
        .collect();
    let figures: Vec<Figures> = pairs
        .par_iter()
        .map(|&(kind, number)| kind.figures(&pocket(number), step))
        .collect();
    KINDS
        .into_iter()
        .zip(figures.chunks(5))
        .map(|(kind, pockets)| Row {
            kind,
            pockets: pockets.to_vec(),
        })
        .collect()
}

fn degrees(angle: f64) -> f64 {
    angle * 180.0 / PI
}

/// What all tables say of passes.
fn cells(figures: &Figures) -> String {
    format!(
        "{:.1} | {:.2} | {} | {:.2} | {:.0} | {:.0} | {:.0} |\n",
        figures.length,
        figures.time,
        figures.corners,
        figures.uncut,
        degrees(figures.mean()),
        degrees(figures.largest),
        figures.much,
    )
}

fn sums(rows: &[(f64, Vec<Row>)]) -> String {
    let mut table = "| Step s, mm | Pattern | Length, mm | Time, s | Against `offset` | Corners | Uncut, mm2 | Mean engagement, deg | Largest, deg | Above 120 deg, mm |\n\
        | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
        .to_owned();
    for (step, rows) in rows {
        let offset = rows[0].sum();
        for row in rows {
            let sum = row.sum();
            table += &format!(
                "| {step} | {} | {:.1} | {:.2} | {:+.1} % | {} | {:.2} | {:.0} | {:.0} | {:.0} |\n",
                row.kind.name(),
                sum.length,
                sum.time,
                (sum.time / offset.time - 1.0) * 100.0,
                sum.corners,
                sum.uncut,
                degrees(sum.mean()),
                degrees(sum.largest),
                sum.much,
            );
        }
    }
    table
}

fn pocket_by_pocket(rows: &[(f64, Vec<Row>)]) -> String {
    let mut table = "| Step s, mm | Pocket | Pattern | Length, mm | Time, s | Corners | Uncut, mm2 | Mean engagement, deg | Largest, deg | Above 120 deg, mm |\n\
        | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
        .to_owned();
    for (step, rows) in rows {
        for number in 0..5 {
            for row in rows {
                let figures = &row.pockets[number];
                table += &format!(
                    "| {step} | {} | {} | {}",
                    number + 1,
                    row.kind.name(),
                    cells(figures)
                );
            }
        }
    }
    table
}

/// The lines of a field by themselves.
struct Alone {
    name: &'static str,
    number: usize,
    lines: Vec<Line>,
    /// What was added to make passes of them.
    found: FieldPasses,
}

const ALONE: [(&str, Detail, f64); 3] = [
    ("simplified axis, lift 0.2 mm", Detail::Simplified, 0.2),
    ("true axis, lift 0.2 mm", Detail::True, 0.2),
    ("true axis, lift 2 mm", Detail::True, 2.0),
];

impl Alone {
    fn all() -> Vec<Self> {
        let pairs = ALONE
            .iter()
            .flat_map(|kind| (1..=5).map(move |number| (kind, number)));
        let pairs: Vec<_> = pairs.collect();
        let of = |&(&(name, detail, lift), number): &(&(&'static str, Detail, f64), usize)| {
            let (region, wanted) = (pocket(number), wanted(4.0, lift, detail));
            Self {
                name,
                number,
                lines: drawn(&region, &BARE, &wanted).unwrap(),
                found: passes(&region, &BARE, &wanted).unwrap(),
            }
        };
        pairs.par_iter().map(of).collect()
    }

    /// How much nearer to a wall than the radius they come, in mm.
    fn gouge(&self) -> f64 {
        let passes: Vec<Pass> = self.lines.iter().map(|line| line.pass.clone()).collect();
        BARE.radius - clearance(&pocket(self.number), &passes).least.unwrap().distance
    }

    /// What they leave, in mm2, on a grid: reachable places that no line has within the radius.
    fn uncut(&self) -> f64 {
        let region = pocket(self.number);
        let walls = Walls::of(&region);
        let ways = self
            .lines
            .iter()
            .flat_map(|line| line.pass.pieces.iter().copied());
        let ways = Walls::of_pieces(ways.enumerate());
        // The pass next to the walls and all deeper ones reach what is reachable.
        let all = pattern::passes(&region, &BARE, Pattern::Offset { step: BARE.radius }).unwrap();
        let all = Walls::of_pieces(
            all.iter()
                .flat_map(|pass| pass.pieces.iter().copied())
                .enumerate(),
        );
        let pitch = 0.2;
        let count = (0..450).into_par_iter().map(|row| {
            let y = (f64::from(row) + 0.5) * pitch;
            let places = (0..750).map(|column| Place::new((f64::from(column) + 0.5) * pitch, y));
            places
                .filter(|&place| {
                    region.contains(place)
                        && ways.nearer_than(place, BARE.radius).is_none()
                        && (walls.distance(place) > BARE.radius
                            || all.nearer_than(place, BARE.radius).is_some())
                })
                .count()
        });
        count.sum::<usize>() as f64 * pitch * pitch
    }

    fn line(&self) -> String {
        format!(
            "| {} | {} | {} | {} | {:.2} | {:.0} | {} | {:.1} |\n",
            self.name,
            self.number,
            self.lines.len(),
            self.found.broken,
            self.gouge().max(0.0),
            self.uncut(),
            self.found.extra.len(),
            self.found.cleared,
        )
    }
}

fn alone(fields: &[Alone]) -> String {
    let lines: String = fields.iter().map(Alone::line).collect();
    format!(
        "| Field | Pocket | Lines | End within it | Gouge, mm | Uncut, mm2 | Extra passes | They clear, mm2 |\n\
        | --- | --- | --- | --- | --- | --- | --- | --- |\n\
        {lines}"
    )
}

/// Compares a table of the page with a fresh one, or rewrites it when asked to.
#[allow(
    clippy::disallowed_methods,
    reason = "the test reads a committed file, and writes it when asked to"
)]
fn keep(tables: &[(&str, String)]) {
    let text = std::fs::read_to_string(Path::new(PAGE)).unwrap();
    let mut fresh = text.clone();
    for (name, table) in tables {
        let begin = format!("<!-- {name}: written by src/field/passes/tests/comparison.rs -->");
        let (before, rest) = fresh
            .split_once(&begin)
            .expect("the page has a place for the table");
        let (_, after) = rest.split_once("<!-- end -->").expect("the table ends");
        fresh = format!("{before}{begin}\n{table}<!-- end -->{after}");
    }
    if std::env::var("UPDATE_DOCS").is_ok() {
        std::fs::write(Path::new(PAGE), &fresh).unwrap();
    } else {
        assert!(
            text == fresh,
            "docs/pocket_patterns.md is out of date: run the test with UPDATE_DOCS=1 and commit it\n{fresh}"
        );
    }
}

#[test]
fn the_comparison_of_patterns_is_current() {
    let rows: Vec<(f64, Vec<Row>)> = STEPS.into_iter().map(|step| (step, rows(step))).collect();
    let fields = Alone::all();
    keep(&[
        ("sums", sums(&rows)),
        ("lines", alone(&fields)),
        ("pockets", pocket_by_pocket(&rows)),
    ]);
    for (step, rows) in &rows {
        for row in rows {
            let sum = row.sum();
            assert!(sum.clear > -1e-9, "{step} {:?}: {}", row.kind, sum.clear);
            assert!(sum.uncut <= 0.06, "{step} {:?}: {}", row.kind, sum.uncut);
        }
        // What the page says in words.
        let sums: Vec<Figures> = rows.iter().map(Row::sum).collect();
        let share = |number: usize| sums[number].time / sums[0].time;
        let [rows, sfs, lifted, flat] = [1, 2, 3, 4].map(share);
        assert!(rows > 1.1 && sfs <= 0.95 && lifted <= 0.95, "{step}");
        assert!((flat - 1.0).abs() < 0.015, "{step}: {flat}");
        assert!(sums[2].corners * 4 < sums[0].corners && sums[4].corners >= sums[0].corners);
    }
    let (one, other) = (rows[0].1[0].sum(), rows[1].1[0].sum());
    assert!(other.length < 0.82 * one.length && other.time < 0.82 * one.time);
    assert!(fields.iter().all(|field| field.uncut() > 1.0));
    let is_nearly_flat = |field: &&Alone| field.name == ALONE[1].0;
    assert!(
        fields
            .iter()
            .filter(is_nearly_flat)
            .all(|field| field.gouge() > 0.25)
    );
}
