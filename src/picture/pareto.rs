//! A Pareto picture: the least time as planned for each limit on a measure, and what the formulas say of the same limits.
//!
//! What lies above and to the right of the steps of the plans can be had: a plan within a limit is also within each wider one. A scallop
//! half as high costs several times the time, so time grows by factors on its axis: jobs of an hour and of a minute can both be read.
//! Curves of the formulas are thin, and differ in their dashes as well as in their colours, so that they can be distinguished without
//! seeing colours.

use super::Point;
use super::chart::{Chart, Plot, Series, Shape};
use super::palette::INK;
use super::scale::Scale;
use super::sheet::{Heading, Room};
use super::svg::Mark;
use super::trace::number;
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::Duration;

/// What a Pareto picture shows. Places are the measure and time in s.
#[derive(Clone, Debug, PartialEq)]
pub struct Pareto<'a> {
    /// What it is about, in a line.
    pub title: &'a str,
    /// What holds for the whole picture.
    pub subtitle: &'a str,
    /// The measure, with its unit.
    pub label: &'a str,
    /// Plans, by growing measure and falling time.
    pub front: &'a [Point],
    /// The job as it is.
    pub now: Option<Point>,
    /// The job's own limit on the measure.
    pub limit: Option<f64>,
    /// What the formulas say: limits and least times.
    pub models: &'a [Curve<'a>],
}

#[derive(Clone, Debug, PartialEq)]
pub struct Curve<'a> {
    pub name: &'a str,
    /// Its points, by growing measure.
    pub points: Vec<Point>,
}

const HEIGHT: f64 = 340.0;
/// Air around what is shown, as a share of it.
const AIR: f64 = 0.08;
/// Room at the left for the units beside times.
const WORDS: f64 = 28.0;
/// The greatest measure that is shown.
const HIGHEST: f64 = 1e9;
/// The shortest time that is shown as such, in s, and about thirty years.
const TIMES: [f64; 2] = [0.01, 1e9];
/// Paint of the formulas' curves, in their order: dark to light, whole to dotted.
const STROKES: [&str; 3] = [
    "fill=\"none\" stroke=\"#3b528b\" stroke-width=\"1\"",
    "fill=\"none\" stroke=\"#21918c\" stroke-width=\"1\" stroke-dasharray=\"9 5\"",
    "fill=\"none\" stroke=\"#b5761a\" stroke-width=\"1\" stroke-dasharray=\"2 5\"",
];
const TINT: &str = "fill=\"#3b528b\" fill-opacity=\"0.12\"";
const BEYOND: &str = "fill=\"url(#hatch)\" fill-opacity=\"0.55\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(pareto: &Pareto<'_>) -> String {
    let heading = Heading::alone(pareto.title, pareto.subtitle);
    let plot = plot(pareto, Room::of(heading.ids));
    Chart {
        heading,
        description: description(pareto),
        labels: [pareto.label, "time, growing by factors"],
        series: series(pareto, &plot),
        plot,
        along: None,
    }
    .draw()
}

/// The picture in words.
fn description(pareto: &Pareto<'_>) -> String {
    let words = |[measure, time]: Point| {
        let time = duration_words(Duration::s(time));
        format!("{time} at {}", number(measure))
    };
    let front: Vec<String> = pareto.front.iter().map(|&place| words(place)).collect();
    let plans = match &front[..] {
        [] => " No plan was made.".to_owned(),
        plans => format!(" Plans: {}.", plans.join(", ")),
    };
    let now = pareto
        .now
        .map_or(String::new(), |now| format!(" The job: {}.", words(now)));
    let limit = pareto.limit.map_or(String::new(), |limit| {
        format!(" The limit of the job is {}.", number(limit))
    });
    format!(
        "{}: least time against {}.{plans}{now}{limit}",
        pareto.subtitle, pareto.label
    )
}

/// A place that can be shown.
fn shown([measure, time]: Point) -> Point {
    [measure.clamp(0.0, HIGHEST), time.clamp(TIMES[0], TIMES[1])]
}

/// The axes, with room for all that is shown and air around it.
fn plot(pareto: &Pareto<'_>, room: Room) -> Plot {
    let points = pareto.models.iter().flat_map(|curve| &curve.points);
    let mut places: Vec<Point> = points
        .chain(pareto.front)
        .chain(&pareto.now)
        .map(|&place| shown(place))
        .collect();
    if places.is_empty() {
        places.push(shown([0.0, 1.0]));
    }
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, 0.0], |[least, most], value| {
            [value.min(least), value.max(most)]
        })
    };
    let measures = places.iter().map(|place| place[0]);
    let limit = pareto.limit.map(|limit| limit.clamp(0.0, HIGHEST));
    let [least, most] = ends(&mut measures.chain(limit));
    let air = (AIR * (most - least)).max(AIR * most).max(1e-3);
    let [shortest, longest] = ends(&mut places.iter().map(|place| place[1]));
    // Times that are nearly the same still have room, and words at both sides.
    let factor = libm::pow(longest / shortest, AIR).max(1.6);
    Plot {
        x: Scale::new(
            [(least - air).max(0.0), most + air],
            [room.left + WORDS, room.right],
        ),
        y: Scale::factors(
            [shortest / factor, longest * factor],
            [room.top + HEIGHT, room.top],
        ),
    }
}

/// What can be had, what lies beyond the limit, the formulas' curves, and the plans.
fn series(pareto: &Pareto<'_>, plot: &Plot) -> Vec<Series> {
    let ([_, right], [bottom, top]) = (plot.x.values, plot.y.values);
    let front: Vec<Point> = pareto.front.iter().copied().map(shown).collect();
    let steps = steps(&front, right);
    let mut series = Vec::new();
    if let Some(&first) = steps.first() {
        let corners = [[right, top], [first[0], top]];
        let had = Series::new(Shape::Polygon([&steps[..], &corners].concat()), TINT);
        series.push(had.named("can be had, as planned"));
    }
    if let Some(limit) = pareto.limit.map(|limit| limit.clamp(0.0, HIGHEST)) {
        let beyond = Series::new(Shape::Boxes(vec![[limit, right, bottom, top]]), BEYOND);
        let line = format!("fill=\"none\" stroke=\"{INK}\" stroke-dasharray=\"6 4\"");
        series.push(beyond.named("beyond the limit"));
        series.push(Series::new(Shape::Upright(limit), line));
    }
    for (curve, stroke) in pareto.models.iter().zip(STROKES) {
        let points = curve.points.iter().copied().map(shown).collect();
        let name = format!("{}, by the formulas", curve.name);
        series.push(Series::new(Shape::Curve(points), stroke).named(name));
    }
    let line = format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"2\"");
    series.push(Series::new(Shape::Curve(steps), line));
    let round = format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"7\" stroke-linecap=\"round\"");
    series.push(Series::new(Shape::Dots(front), round));
    if let Some(now) = pareto.now.map(shown) {
        series.push(Series::mark(Mark::RING, now, None).named("the job"));
    }
    series
}

/// From each plan to the right, up to the limit from which on the next one is within it, and down to that.
fn steps(front: &[Point], right: f64) -> Vec<Point> {
    let mut steps: Vec<Point> = Vec::new();
    for &place in front {
        if let Some(last) = steps.last().copied() {
            steps.push([place[0], last[1]]);
        }
        steps.push(place);
    }
    steps.extend(steps.last().map(|last| [right, last[1]]));
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_looks_as_it_was_reviewed() {
        let hyperbola = |by: f64| (4..=12).map(|i| [f64::from(i), by / f64::from(i)]).collect();
        let svg = draw(&Pareto {
            title: "Time against scallop of <rib>",
            subtitle: "operation 1, at programmed speeds",
            label: "most that is left, mm",
            front: &[[4.0, 420.0], [6.5, 260.0], [9.31, 186.5], [11.0, 150.0]],
            now: Some([9.31, 186.5]),
            limit: Some(10.0),
            models: &[
                Curve {
                    name: "interlaced",
                    points: hyperbola(1800.0),
                },
                Curve {
                    name: "orthogonal",
                    points: hyperbola(2500.0),
                },
            ],
        });
        insta::assert_snapshot!(svg);
    }

    #[test]
    fn steps_go_right_and_then_down() {
        assert_eq!(
            steps(&[[1.0, 9.0], [3.0, 5.0]], 4.0),
            [[1.0, 9.0], [3.0, 9.0], [3.0, 5.0], [4.0, 5.0]]
        );
        assert!(steps(&[], 4.0).is_empty());
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
        let cases: [(&[Curve<'_>], &[Point]); 4] = [
            (&lone, &[[5.0, 7.0]]),
            (&wild, &[[f64::MIN, f64::MAX], [f64::MAX, 0.0]]),
            (&[], &[[0.0, 0.0]]),
            (&[], &[]),
        ];
        for (models, front) in cases {
            let svg = draw(&Pareto {
                title: "",
                subtitle: "",
                label: "",
                front,
                now: front.first().copied(),
                limit: Some(0.0),
                models,
            });
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.ends_with("</svg>\n"));
        }
    }
}
