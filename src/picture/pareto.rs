//! A Pareto picture: the least time for each largest scallop, a curve for each lattice, and where the job stands.
//!
//! What lies above and to the right of a curve can be had, what lies below cannot. A scallop half as high costs several times the time,
//! so time grows by factors on its axis: jobs of an hour and of a minute can both be read. Curves differ in their dashes as well as in
//! their colours, so that they can be told apart without seeing colours.

use super::Point;
use super::chart::{Chart, Plot, Series, Shape};
use super::palette::INK;
use super::scale::Scale;
use super::sheet::{Heading, Room};
use super::svg::Mark;
use super::trace::number;
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

const HEIGHT: f64 = 340.0;
/// Air around what is shown, as a share of it.
const AIR: f64 = 0.08;
/// Room at the left for the units beside times.
const WORDS: f64 = 28.0;
/// The greatest scallop that is shown.
const HIGHEST: f64 = 1e9;
/// The shortest time that is told from none, in s, and about thirty years.
const TIMES: [f64; 2] = [0.01, 1e9];
/// Paint of the curves, in their order: dark to light, whole to dotted.
const STROKES: [&str; 3] = [
    "fill=\"none\" stroke=\"#3b528b\" stroke-width=\"2.5\"",
    "fill=\"none\" stroke=\"#21918c\" stroke-width=\"2.5\" stroke-dasharray=\"9 5\"",
    "fill=\"none\" stroke=\"#b5761a\" stroke-width=\"2.5\" stroke-dasharray=\"2 5\"",
];
const TINT: &str = "fill=\"#3b528b\" fill-opacity=\"0.08\"";
const BEYOND: &str = "fill=\"url(#hatch)\" fill-opacity=\"0.55\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(pareto: &Pareto<'_>) -> String {
    let heading = Heading::alone(pareto.title, pareto.subtitle);
    let plot = plot(pareto, Room::of(heading.ids));
    Chart {
        heading,
        description: description(pareto),
        labels: ["largest scallop, mm", "time, growing by factors"],
        series: series(pareto, &plot),
        plot,
        along: None,
    }
    .draw()
}

/// The picture in words.
fn description(pareto: &Pareto<'_>) -> String {
    let words = |[scallop, time]: Point| (number(scallop), duration_words(Duration::s(time)));
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

/// A place that can be shown.
fn shown([scallop, time]: Point) -> Point {
    [scallop.clamp(0.0, HIGHEST), time.clamp(TIMES[0], TIMES[1])]
}

/// The axes, with room for all that is shown and air around it.
fn plot(pareto: &Pareto<'_>, room: Room) -> Plot {
    let points = pareto.curves.iter().flat_map(|curve| &curve.points);
    let places: Vec<Point> = points
        .chain([&pareto.chosen])
        .chain(&pareto.planned)
        .map(|&place| shown(place))
        .collect();
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, 0.0], |[least, most], value| {
            [value.min(least), value.max(most)]
        })
    };
    let scallops = places.iter().map(|place| place[0]);
    let limit = pareto.limit.map(|limit| limit.clamp(0.0, HIGHEST));
    let [least, most] = ends(&mut scallops.chain(limit));
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

/// What can be had by the first curve, what lies beyond the limit, and the curves.
fn series(pareto: &Pareto<'_>, plot: &Plot) -> Vec<Series> {
    let ([_, right], [bottom, top]) = (plot.x.values, plot.y.values);
    let shown_of = |curve: &Curve<'_>| curve.points.iter().copied().map(shown).collect::<Vec<_>>();
    let curves = || pareto.curves.iter().zip(STROKES);
    let mut series = Vec::new();
    if let Some((curve, _)) = curves().next() {
        let points = shown_of(curve);
        if let (Some(&first), Some(&last)) = (points.first(), points.last()) {
            let corners = [[right, last[1]], [right, top], [first[0], top]];
            let had = Series::new(Shape::Polygon([&points[..], &corners].concat()), TINT);
            series.push(had.named(format!("can be had ({})", curve.name)));
        }
    }
    if let Some(limit) = pareto.limit.map(|limit| limit.clamp(0.0, HIGHEST)) {
        let beyond = Series::new(Shape::Boxes(vec![[limit, right, bottom, top]]), BEYOND);
        let line = format!("fill=\"none\" stroke=\"{INK}\" stroke-dasharray=\"6 4\"");
        series.push(beyond.named("beyond the limit"));
        series.push(Series::new(Shape::Upright(limit), line));
    }
    for (curve, stroke) in curves() {
        series.push(Series::new(Shape::Curve(shown_of(curve)), stroke).named(curve.name));
    }
    let dots = curves().flat_map(|(curve, _)| shown_of(curve)).collect();
    let round = format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"5\" stroke-linecap=\"round\"");
    series.push(Series::new(Shape::Dots(dots), round));
    if let Some(planned) = pareto.planned.map(shown) {
        series.push(Series::mark(Mark::RING, planned, None).named("planned and simulated"));
    }
    let chosen = Series::mark(Mark::CROSS, shown(pareto.chosen), None);
    series.push(chosen.named("chosen, by the model"));
    series
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
}
