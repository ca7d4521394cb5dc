//! How far the machined contour stands off the part, along the whole profile.

use super::band::{Band, MANY};
use super::chart::{Chart, Plot, Series, Shape};
use super::palette::{BLUE, GREEN, VERMILION};
use super::sheet::Room;
use super::svg::{Along, Mark};
use super::thin::Thinned;

pub use super::sheet::Heading;

/// What a picture of deviations shows; lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// Distances of the machined contour from the part over x, from left to right.
    pub curve: &'a [[f64; 2]],
    /// The largest one, which may lie between the points of the curve.
    pub largest: [f64; 2],
    /// Where the part is farther from the contour than the contour is anywhere from the part, and how far.
    pub hollow: Option<[f64; 2]>,
    pub mean: f64,
    /// The limit, when the job has one.
    pub limit: Option<f64>,
}

const HEIGHT: f64 = 240.0;
/// The narrowest columns that many teeth are looked at in.
const NARROWEST: f64 = 6.0;
const BAND: &str = "fill=\"#0072b2\" fill-opacity=\"0.2\"";
const CURVE: &str = "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\" stroke-linejoin=\"round\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(deviation: &Deviation<'_>) -> String {
    let (first, last) = (deviation.curve.first(), deviation.curve.last());
    let highest = deviation.largest[1]
        .max(deviation.limit.unwrap_or_default())
        .max(deviation.hollow.map_or(0.0, |[_, height]| height))
        .max(1e-3);
    let room = Room::of(deviation.heading.ids);
    Chart {
        heading: deviation.heading,
        description: description(deviation),
        // Above the highest there is room for its words.
        plot: Plot::new(
            room,
            [first, last].map(|end| end.map_or(0.0, |end| end[0])),
            [0.0, highest * 1.2],
            [room.top, room.top + HEIGHT],
        ),
        labels: ["x, mm", "distance from the part, mm"],
        series: series(deviation, room),
        along: Some(Along::Width),
    }
    .draw()
}

fn series(deviation: &Deviation<'_>, room: Room) -> Vec<Series> {
    let mut series = Vec::from(distances(deviation, room));
    let dashed = |colour, dashes| {
        format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dashes}\"")
    };
    let mean = Series::new(Shape::Level(deviation.mean), dashed(GREEN, "2 4"));
    series.push(mean.named(format!("mean, {:.2} mm", deviation.mean)));
    let words = |[x, height]: [f64; 2]| Some(format!("{height:.2} mm at x {x:.1}"));
    if let Some(hollow) = deviation.hollow {
        let hollow = Series::mark(Mark::HOLLOW, hollow, words(hollow));
        series.push(hollow.named("deepest corner no cut reaches"));
    }
    if let Some(limit) = deviation.limit {
        let line = Series::new(Shape::Level(limit), dashed(VERMILION, "9 4"));
        series.push(line.named(format!("limit, {limit:.2} mm")));
    }
    series.push(Series::mark(
        Mark::DISC,
        deviation.largest,
        words(deviation.largest),
    ));
    series
}

/// The distances, and the area below: their curve, or of many teeth the band that they fill.
fn distances(deviation: &Deviation<'_>, room: Room) -> [Series; 2] {
    let is_tip = |three: &&[[f64; 2]]| matches!(three, [a, b, c] if b[1] > a[1] && b[1] >= c[1]);
    let teeth = deviation.curve.windows(3).filter(is_tip).count();
    if teeth >= MANY || teeth as f64 * NARROWEST > room.across() {
        // More than a tooth a column, so that there are no gaps between them.
        let columns = (teeth as f64 / 1.3).min(room.across() / NARROWEST).max(1.0);
        let band = Band::of(deviation.curve, columns as u32);
        let upper = Series::new(Shape::Curve(band.upper.clone()), CURVE);
        let paint = format!("{BAND} stroke=\"{BLUE}\"");
        [
            Series::new(Shape::Polygon(band.outline()), paint).named("distance (teeth drawn as a band)"),
            upper,
        ]
    } else {
        let curve = Thinned::of(deviation.curve, 2 * room.columns());
        let line = Series::new(Shape::Curve(curve.clone()), CURVE);
        let words = "distance of the contour from the part";
        [Series::new(Shape::Area(curve), BAND), line.named(words)]
    }
}

fn description(deviation: &Deviation<'_>) -> String {
    let limit = deviation
        .limit
        .map(|limit| format!("; the limit is {limit:.2} mm"));
    let hollow = deviation.hollow.map(|[x, height]| {
        format!(" The deepest corner that no cut reaches is {height:.2} mm from the machined contour, at x {x:.1} mm.")
    });
    let (limit, hollow) = (limit.unwrap_or_default(), hollow.unwrap_or_default());
    format!(
        "{}. Distance of the machined contour from the part over x: at most {:.2} mm, at x {:.1} mm, and {:.2} mm on \
         average{limit}.{hollow}",
        deviation.heading.subtitle, deviation.largest[1], deviation.largest[0], deviation.mean
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;
    use crate::chart::{ASCENT, DESCENT};

    /// Where words of a picture stand that hold a text.
    fn line_of(picture: &str, words: &str) -> f64 {
        let line = picture
            .lines()
            .find(|line| line.contains(&format!(">{words}")))
            .unwrap();
        line.split(" y=\"")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap()
            .parse()
            .unwrap()
    }

    fn level_of(picture: &str, paint: &str) -> f64 {
        let line = picture
            .lines()
            .find(|line| line.contains(paint) && line.contains('H'))
            .unwrap();
        let path = line.split("d=\"M").nth(1).unwrap();
        path.split(' ')
            .nth(1)
            .unwrap()
            .split('H')
            .next()
            .unwrap()
            .parse()
            .unwrap()
    }

    #[test]
    fn words_stand_clear_of_lines_and_of_each_other() {
        for (largest, hollow) in [
            (9.86, None),
            (9.9, Some(10.1)),
            (10.0, Some(10.4)),
            (4.0, None),
            (0.2, Some(0.3)),
        ] {
            let picture = draw(&Deviation {
                heading: Heading {
                    ids: Prefix::new("a-"),
                    title: "a rib",
                    subtitle: "",
                },
                curve: &[[0.0, 0.0], [100.0, largest], [200.0, 0.0]],
                largest: [100.0, largest],
                hollow: hollow.map(|height| [99.0, height]),
                mean: largest / 2.0,
                limit: Some(10.0),
            });
            let mut lines = vec![line_of(&picture, &format!("{largest:.2} mm at"))];
            lines.extend(hollow.map(|height| line_of(&picture, &format!("{height:.2} mm at"))));
            let levels = ["9 4", "2 4"].map(|dashes| level_of(&picture, dashes));
            for line in &lines {
                let clear = levels
                    .iter()
                    .all(|level| *level < line - ASCENT || *level > line + DESCENT);
                assert!(clear, "{largest}: words at {line}, lines at {levels:?}");
            }
            if let [a, b] = lines.as_slice() {
                assert!((a - b).abs() >= ASCENT + DESCENT, "{lines:?}");
            }
        }
    }
}
