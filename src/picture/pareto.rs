//! A Pareto picture: the least time for each largest scallop, a curve for each lattice, and where the job stands.
//!
//! What lies above and to the right of a curve can be had, what lies below cannot. A scallop half as high costs several times the time,
//! so time grows by factors on its axis: jobs of an hour and of a minute can both be read. Curves differ in their dashes as well as in
//! their colours, so that they can be told apart without seeing colours.

use super::Prefix;
use super::marks::{cross, ring};
use super::svg::{Anchor, Svg, number};
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::Duration;

/// What a Pareto picture shows. Places are scallop in mm and time in s.
#[derive(Clone, Debug, PartialEq)]
pub struct Pareto<'a> {
    /// What it is about, in a line.
    pub title: &'a str,
    /// What holds for the whole picture.
    pub subtitle: &'a str,
    /// The curves; where the first one lies, the ground above it is tinted.
    pub curves: &'a [Curve<'a>],
    /// What was chosen, by the model.
    pub chosen: [f64; 2],
    /// What it came out as: the simulated scallop and the planned time.
    pub planned: Option<[f64; 2]>,
    /// The largest scallop that the job allows.
    pub limit: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Curve<'a> {
    pub name: &'a str,
    /// Its points, by growing scallop.
    pub points: Vec<[f64; 2]>,
}

/// Height of letters.
const FONT: u32 = 13;
/// The plot's upper left corner.
const CORNER: (f64, f64) = (86.0, 74.0);
/// The plot's width and height.
const SIZE: (f64, f64) = (480.0, 340.0);
/// Room for the legend, beside the plot.
const LEGEND: f64 = 236.0;
/// Distance of lines in the legend.
const LINE: f64 = 24.0;
/// Air around what is shown, as a share of it.
const AIR: f64 = 0.08;
/// Paint of the curves, in their order: dark to light, whole to dotted.
const STROKES: [&str; 3] = [
    "stroke=\"#3b528b\" stroke-width=\"2.5\"",
    "stroke=\"#21918c\" stroke-width=\"2.5\" stroke-dasharray=\"9 5\"",
    "stroke=\"#b5761a\" stroke-width=\"2.5\" stroke-dasharray=\"2 5\"",
];
const TINT: &str = "fill=\"#3b528b\" fill-opacity=\"0.08\"";
const BEYOND: &str = "fill=\"url(#hatch)\" fill-opacity=\"0.55\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(pareto: &Pareto<'_>) -> String {
    let plot = Plot::of(pareto);
    let mut svg = Svg::new(
        [CORNER.0 + SIZE.0 + LEGEND, CORNER.1 + SIZE.1 + 60.0],
        FONT,
        Prefix::NONE,
        pareto.title,
        &description(pareto),
    );
    svg.define_hatch();
    svg.text(
        (24.0, 32.0),
        Anchor::Start,
        "font-size=\"17\" font-weight=\"bold\"",
        pareto.title,
    );
    svg.text((24.0, 53.0), Anchor::Start, "", pareto.subtitle);
    grounds(&mut svg, pareto, &plot);
    ticks(&mut svg, &plot);
    for (curve, stroke) in pareto.curves.iter().zip(STROKES) {
        draw_curve(&mut svg, curve, &plot, stroke);
    }
    limit_line(&mut svg, pareto, &plot);
    if let Some(planned) = pareto.planned {
        ring(&mut svg, plot.at(planned));
    }
    cross(&mut svg, plot.at(pareto.chosen));
    legend(&mut svg, pareto);
    svg.finish()
}

/// The picture in words.
fn description(pareto: &Pareto<'_>) -> String {
    let words = |[scallop, time]: [f64; 2]| (number(scallop), duration_words(Duration::s(time)));
    let (scallop, time) = words(pareto.chosen);
    let limit = pareto.limit.map_or(String::new(), |limit| {
        format!(" The limit of the scallop is {} mm.", number(limit))
    });
    let planned = pareto.planned.map_or(String::new(), |planned| {
        let (scallop, time) = words(planned);
        format!(" Planned and simulated it takes {time} and leaves {scallop} mm.")
    });
    format!(
        "{}: least time against the largest scallop. Chosen is {time} at {scallop} mm.{planned}{limit}",
        pareto.subtitle
    )
}

/// How mm of scallop and seconds become places in the picture.
struct Plot {
    x: Axis,
    y: TimeAxis,
}

/// The upward direction: times that grow by factors, from the least to the largest.
struct TimeAxis {
    /// Logarithm of the least time in s.
    least: f64,
    /// Logarithm of the largest over the least.
    height: f64,
}

/// The shortest time that is told from none, in s.
const SHORTEST: f64 = 0.01;
/// The longest, about thirty years.
const LONGEST: f64 = 1e9;
/// Least distance of the words beside the axis.
const APART: f64 = 24.0;

impl TimeAxis {
    fn of(seconds: impl Iterator<Item = f64>) -> Self {
        let ends = seconds.map(|time| libm::log(time.clamp(SHORTEST, LONGEST))).fold(
            None,
            |ends: Option<[f64; 2]>, time| {
                let [least, most] = ends.unwrap_or([time, time]);
                Some([least.min(time), most.max(time)])
            },
        );
        let [least, most] = ends.unwrap_or_default();
        // Times that are nearly the same still have room, and words at both sides.
        let air = (AIR * (most - least)).max(libm::log(1.6));
        Self {
            least: least - air,
            height: most - least + 2.0 * air,
        }
    }

    /// From 0 at the least time to 1 at the largest.
    fn share(&self, seconds: f64) -> f64 {
        let time = libm::log(seconds.clamp(SHORTEST, LONGEST));
        ((time - self.least) / self.height).clamp(-0.02, 1.02)
    }

    /// Round times within, in s, that do not come too close to each other: those of the roundest kind come first.
    fn ticks(&self) -> Vec<f64> {
        const ROUND: [&[f64]; 4] = [
            &[0.1, 1.0, 10.0, 60.0, 600.0, 3600.0, 36e3, 36e4, 36e5, 36e6, 36e7],
            &[0.5, 5.0, 30.0, 300.0, 1800.0, 18e3, 18e4, 18e5, 18e6, 18e7],
            &[0.2, 2.0, 20.0, 120.0, 1200.0, 7200.0, 72e3, 72e4, 72e5, 72e6],
            &[
                0.3, 3.0, 15.0, 40.0, 90.0, 180.0, 240.0, 420.0, 900.0, 2400.0, 10_800.0, 14_400.0, 28_800.0,
                108e3, 144e3, 108e4,
            ],
        ];
        let mut ticks: Vec<f64> = Vec::new();
        for &time in ROUND.into_iter().flatten() {
            let share = (libm::log(time) - self.least) / self.height;
            let is_apart = |other: &f64| (self.share(*other) - share).abs() * SIZE.1 >= APART;
            if (0.0..=1.0).contains(&share) && ticks.iter().all(is_apart) {
                ticks.push(time);
            }
        }
        ticks.sort_by(f64::total_cmp);
        ticks
    }
}

/// A round time as people say it: `30 s`, `2 min`, `5 h`.
fn time_words(seconds: f64) -> String {
    if seconds >= 3600.0 {
        format!("{} h", number(seconds / 3600.0))
    } else if seconds >= 60.0 {
        format!("{} min", number(seconds / 60.0))
    } else {
        format!("{} s", number(seconds))
    }
}

/// A direction of the plot, from its least value to its largest.
struct Axis {
    least: f64,
    width: f64,
}

impl Axis {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let least = values.clone().fold(f64::INFINITY, f64::min).clamp(0.0, 1e9);
        let most = values.fold(0.0, f64::max).clamp(0.0, 1e9);
        let air = (AIR * (most - least)).max(AIR * most).max(1e-3);
        let least = (least - air).max(0.0);
        Self {
            least,
            width: (most + air - least).max(1e-3),
        }
    }

    /// From 0 at the least value to 1 at the largest.
    fn share(&self, value: f64) -> f64 {
        ((value - self.least) / self.width).clamp(-0.02, 1.02)
    }

    /// Round values within, at most about eight.
    fn ticks(&self) -> Vec<f64> {
        let decade = libm::pow(10.0, libm::log10(self.width / 8.0).floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|by| by * decade)
            .into_iter()
            .find(|step| self.width / step <= 8.0)
            .unwrap_or(self.width);
        let first = (self.least / step).ceil();
        (0..10)
            .map(|tick| (first + f64::from(tick)) * step)
            .take_while(|&tick| tick <= self.least + self.width)
            .collect()
    }
}

impl Plot {
    fn of(pareto: &Pareto<'_>) -> Self {
        let curves = pareto.curves.iter().take(STROKES.len());
        let places = curves
            .flat_map(|curve| &curve.points)
            .chain([&pareto.chosen])
            .chain(&pareto.planned);
        Self {
            x: Axis::of(places.clone().map(|place| place[0]).chain(pareto.limit)),
            y: TimeAxis::of(places.map(|place| place[1])),
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        (
            CORNER.0 + SIZE.0 * self.x.share(x),
            CORNER.1 + SIZE.1 * (1.0 - self.y.share(y)),
        )
    }
}

/// What can be had by the first curve, and what lies beyond the limit.
fn grounds(svg: &mut Svg, pareto: &Pareto<'_>, plot: &Plot) {
    let (right, top) = (CORNER.0 + SIZE.0, CORNER.1);
    let points = pareto.curves.first().map(|curve| curve.points.as_slice());
    if let Some([first, .., last] | [first @ last]) = points {
        let along = path(points.unwrap_or_default(), plot);
        let (x, y) = (plot.at(*first).0, plot.at(*last).1);
        let [right, top, x, y] = [right, top, x, y].map(number);
        svg.path(&format!("{along}L{right} {y}V{top}H{x}Z"), TINT);
    }
    if let Some(limit) = pareto.limit {
        let x = plot.at([limit, 0.0]).0;
        svg.rect([x, top, (right - x).max(0.0), SIZE.1], BEYOND);
    }
}

fn path(points: &[[f64; 2]], plot: &Plot) -> String {
    let mut path = String::new();
    for &point in points {
        let (x, y) = plot.at(point);
        let letter = if path.is_empty() { 'M' } else { 'L' };
        path += &format!("{letter}{} {}", number(x), number(y));
    }
    path
}

fn draw_curve(svg: &mut Svg, curve: &Curve<'_>, plot: &Plot, stroke: &str) {
    svg.path(&path(&curve.points, plot), &format!("fill=\"none\" {stroke}"));
    for &point in &curve.points {
        let (x, y) = plot.at(point);
        svg.line(&format!(
            "  <circle cx=\"{}\" cy=\"{}\" r=\"2.5\" fill=\"#2b2a27\"/>",
            number(x),
            number(y)
        ));
    }
}

fn limit_line(svg: &mut Svg, pareto: &Pareto<'_>, plot: &Plot) {
    let Some(limit) = pareto.limit else { return };
    let x = plot.at([limit, 0.0]).0;
    svg.path(
        &format!("M{} {}v{}", number(x), number(CORNER.1), number(SIZE.1)),
        "fill=\"none\" stroke=\"#2b2a27\" stroke-dasharray=\"6 4\"",
    );
}

fn ticks(svg: &mut Svg, plot: &Plot) {
    let (left, top) = CORNER;
    let bottom = top + SIZE.1;
    let (mut marks, mut grid) = (String::new(), String::new());
    for value in plot.x.ticks() {
        let x = left + SIZE.0 * plot.x.share(value);
        marks += &format!("M{} {}v6", number(x), number(bottom));
        svg.text((x, bottom + 21.0), Anchor::Middle, "", &number(value));
    }
    for value in plot.y.ticks() {
        let y = top + SIZE.1 * (1.0 - plot.y.share(value));
        marks += &format!("M{} {}h-6", number(left), number(y));
        grid += &format!("M{} {}h{}", number(left), number(y), number(SIZE.0));
        svg.text((left - 10.0, y + 4.5), Anchor::End, "", &time_words(value));
    }
    svg.path(&grid, "stroke=\"#dcd6c8\" fill=\"none\"");
    svg.path(&marks, "stroke=\"#2b2a27\" fill=\"none\"");
    svg.rect([left, top, SIZE.0, SIZE.1], "fill=\"none\" stroke=\"#2b2a27\"");
    svg.text(
        (left + SIZE.0 / 2.0, bottom + 43.0),
        Anchor::Middle,
        "",
        "largest scallop, mm",
    );
    let middle = top + SIZE.1 / 2.0;
    svg.text(
        (16.0, middle),
        Anchor::Middle,
        &format!("transform=\"rotate(-90 16 {})\"", number(middle)),
        "time, growing by factors",
    );
}

fn legend(svg: &mut Svg, pareto: &Pareto<'_>) {
    let left = CORNER.0 + SIZE.0 + 26.0;
    let mut y = CORNER.1 + 10.0;
    let mut entry = |svg: &mut Svg, words: &str, mark: &dyn Fn(&mut Svg, f64)| {
        mark(svg, y);
        svg.text((left + 36.0, y), Anchor::Start, "", words);
        y += LINE;
    };
    for (curve, stroke) in pareto.curves.iter().zip(STROKES) {
        entry(svg, curve.name, &|svg, y| {
            let path = format!("M{} {}h26", number(left), number(y - 4.5));
            svg.path(&path, &format!("fill=\"none\" {stroke}"));
        });
    }
    entry(svg, "chosen, by the model", &|svg, y| {
        cross(svg, (left + 13.0, y - 4.5));
    });
    if pareto.planned.is_some() {
        entry(svg, "planned and simulated", &|svg, y| {
            ring(svg, (left + 13.0, y - 4.5));
        });
    }
    let swatch = |svg: &mut Svg, y: f64, paint: &str| {
        svg.rect([left, y - 13.0, 26.0, 16.0], paint);
    };
    if let Some(curve) = pareto.curves.first() {
        let words = format!("can be had ({})", curve.name);
        entry(svg, &words, &|svg, y| swatch(svg, y, TINT));
    }
    if pareto.limit.is_some() {
        entry(svg, "beyond the limit", &|svg, y| swatch(svg, y, BEYOND));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_looks_as_it_was_reviewed() {
        let hyperbola = |by: f64| (4..=12).map(|i| [f64::from(i), by / f64::from(i)]).collect();
        let svg = draw(&Pareto {
            title: "Time against scallop of <rib>",
            subtitle: "operation 1, exact formulas",
            curves: &[
                Curve {
                    name: "interlaced",
                    points: hyperbola(1800.0),
                },
                Curve {
                    name: "orthogonal",
                    points: hyperbola(2500.0),
                },
            ],
            chosen: [10.0, 180.0],
            planned: Some([9.31, 186.5]),
            limit: Some(10.0),
        });
        insta::assert_snapshot!(svg);
    }

    #[test]
    fn anything_is_drawn_within_its_picture() {
        let lone = [Curve {
            name: "",
            points: vec![[5.0, 7.0]],
        }];
        let wild = [Curve {
            name: "",
            points: vec![[0.0, f64::MAX], [f64::MAX, 0.0]],
        }];
        for (curves, chosen) in [(&lone[..], [5.0, 7.0]), (&wild, [f64::MIN, 0.0]), (&[], [0.0; 2])] {
            let svg = draw(&Pareto {
                title: "",
                subtitle: "",
                curves,
                chosen,
                planned: None,
                limit: Some(0.0),
            });
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.ends_with("</svg>\n"));
        }
    }

    #[test]
    fn times_of_every_size_have_words_beside_them() {
        let ticks = |least: f64, most: f64| {
            let axis = TimeAxis::of([least, most].into_iter());
            let ticks = axis.ticks();
            let shares: Vec<f64> = ticks.iter().map(|&time| axis.share(time)).collect();
            assert!(
                shares
                    .windows(2)
                    .all(|pair| (pair[1] - pair[0]) * SIZE.1 >= APART - 1e-9)
            );
            assert!(!ticks.is_empty(), "{least} to {most}: {ticks:?}");
            ticks.into_iter().map(time_words).collect::<Vec<_>>().join(", ")
        };
        assert_eq!(
            ticks(300.0, 186_000.0),
            "5 min, 10 min, 30 min, 1 h, 2 h, 5 h, 10 h, 20 h, 50 h"
        );
        let mut least = 0.5;
        while least < 1e6 {
            for factor in [1.0, 1.3, 7.0, 1e3] {
                let _ = ticks(least, least * factor);
            }
            least *= 1.7;
        }
    }

    #[test]
    fn a_time_twice_as_long_is_always_as_far_above() {
        let axis = TimeAxis::of([10.0, 10_000.0].into_iter());
        let step = axis.share(20.0) - axis.share(10.0);
        for time in [15.0, 100.0, 4000.0] {
            assert!((axis.share(2.0 * time) - axis.share(time) - step).abs() < 1e-12);
        }
    }

    #[test]
    fn ticks_are_round_and_few() {
        let ticks = Axis {
            least: 3.6,
            width: 9.3,
        }
        .ticks();
        assert_eq!(ticks, [4.0, 6.0, 8.0, 10.0, 12.0]);
    }
}
