//! How far the machined contour stands off the part, along the whole profile.

use super::band::{Band, MANY};
use super::palette::{BLUE, GREEN, VERMILION};
use super::plot::{BELOW, Plot};
use super::sheet::{self, Entry, Room, Swatch};
use super::svg::{Along, Anchor, Svg, number};
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
    let [from, to] =
        [deviation.curve.first(), deviation.curve.last()].map(|end| end.map_or(0.0, |end| end[0]));
    let highest = deviation.largest[1]
        .max(deviation.limit.unwrap_or_default())
        .max(deviation.hollow.map_or(0.0, |[_, height]| height))
        .max(1e-3);
    let room = Room::of(deviation.heading.ids);
    let bottom = room.top + HEIGHT;
    // Above the highest there is room for its words.
    let plot = Plot::new(room, [from, to], [0.0, highest * 1.2], [room.top, bottom]);
    let mut svg = sheet::sheet(
        deviation.heading,
        room,
        &description(deviation),
        bottom + BELOW,
        &legend(deviation),
    );
    plot.ground(&mut svg);
    curve(&mut svg, deviation, &plot, room);
    svg.path(&plot.level(deviation.mean), &mean());
    if let Some(limit) = deviation.limit {
        svg.path(&plot.level(limit), &self::limit());
    }
    let circle = format!("r=\"5\" fill=\"{BLUE}\" stroke=\"#ffffff\" stroke-width=\"1.5\"");
    let levels: Vec<f64> = deviation
        .limit
        .into_iter()
        .chain([deviation.mean])
        .map(|level| plot.y.at(level))
        .collect();
    let mut taken = Vec::new();
    if let Some(hollow) = deviation.hollow {
        mark(&mut svg, hollow, &plot, &ring(), &levels, &mut taken);
    }
    mark(&mut svg, deviation.largest, &plot, &circle, &levels, &mut taken);
    plot.frame(&mut svg, "x, mm", "distance from the part, mm");
    svg.cursor(Along::Width, &plot.x, [room.top, bottom]);
    svg.finish()
}

/// How many teeth the contour has.
fn teeth(deviation: &Deviation<'_>) -> usize {
    let is_tip = |three: &[[f64; 2]]| matches!(three, [a, b, c] if b[1] > a[1] && b[1] >= c[1]);
    deviation.curve.windows(3).filter(|three| is_tip(three)).count()
}

/// Whether the teeth are so many, or so close, that they are drawn as the band that they fill.
fn are_many(deviation: &Deviation<'_>) -> bool {
    let teeth = teeth(deviation);
    let across = Room::of(deviation.heading.ids).across();
    teeth >= MANY || teeth as f64 * NARROWEST > across
}

/// The distances: their curve, or of many teeth the band that they fill.
fn curve(svg: &mut Svg, deviation: &Deviation<'_>, plot: &Plot, room: Room) {
    if are_many(deviation) {
        // More than a tooth a column, so that there are no gaps between them.
        let columns = (teeth(deviation) as f64 / 1.3)
            .min(room.across() / NARROWEST)
            .max(1.0);
        let band = Band::of(deviation.curve, columns as u32);
        svg.path(plot.between(&band).text(), BAND);
        svg.path(plot.curve(&band.upper).text(), CURVE);
    } else {
        let curve = Thinned::of(deviation.curve, 2 * room.columns());
        svg.path(plot.area(&curve).text(), BAND);
        svg.path(plot.curve(&curve).text(), CURVE);
    }
}

fn mean() -> String {
    format!("fill=\"none\" stroke=\"{GREEN}\" stroke-width=\"2\" stroke-dasharray=\"2 4\"")
}

fn limit() -> String {
    format!("fill=\"none\" stroke=\"{VERMILION}\" stroke-width=\"2\" stroke-dasharray=\"9 4\"")
}

fn description(deviation: &Deviation<'_>) -> String {
    let limit = match deviation.limit {
        Some(limit) => format!("; the limit is {limit:.2} mm"),
        None => String::new(),
    };
    let hollow = match deviation.hollow {
        Some([x, height]) => {
            format!(
                " The deepest corner that no cut reaches is {height:.2} mm from the machined contour, at x {x:.1} mm."
            )
        }
        None => String::new(),
    };
    format!(
        "{}. Distance of the machined contour from the part over x: at most {:.2} mm, at x {:.1} mm, and {:.2} mm on \
         average{limit}.{hollow}",
        deviation.heading.subtitle, deviation.largest[1], deviation.largest[0], deviation.mean
    )
}

fn legend(deviation: &Deviation<'_>) -> Vec<Entry> {
    let distance = if are_many(deviation) {
        Entry::area(
            format!("{BAND} stroke=\"{BLUE}\""),
            "distance (teeth drawn as a band)",
        )
    } else {
        Entry::line(CURVE, "distance of the contour from the part")
    };
    let mut legend = vec![
        distance,
        Entry::line(mean(), format!("mean, {:.2} mm", deviation.mean)),
    ];
    if deviation.hollow.is_some() {
        legend.push(Entry {
            swatch: Swatch::Mark(
                "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z".to_owned(),
                format!("fill=\"#ffffff\" stroke=\"{VERMILION}\" stroke-width=\"2\""),
            ),
            words: "deepest corner no cut reaches".to_owned(),
        });
    }
    if let Some(value) = deviation.limit {
        legend.push(Entry::line(limit(), format!("limit, {value:.2} mm")));
    }
    legend
}

fn ring() -> String {
    format!("r=\"5\" fill=\"#ffffff\" stroke=\"{VERMILION}\" stroke-width=\"2\"")
}

/// How high words are above and below their line.
const ASCENT: f64 = 12.0;
const DESCENT: f64 = 4.0;

/// A circle at a place, with its distance and x. The words stand clear of the lines at these levels and of words that are there:
/// `taken` holds their ends and their lines.
fn mark(
    svg: &mut Svg,
    place: [f64; 2],
    plot: &Plot,
    circle: &str,
    levels: &[f64],
    taken: &mut Vec<([f64; 2], f64)>,
) {
    let [x, y] = plot.at(place);
    svg.line(&format!(
        "  <circle cx=\"{}\" cy=\"{}\" {circle}/>",
        number(x),
        number(y)
    ));
    let words = format!("{:.2} mm at x {:.1}", place[1], place[0]);
    let [left, right] = plot.x.places;
    let width = sheet::text_width(&words);
    let (anchor, side, ends) = if x > f64::midpoint(left, right) {
        (Anchor::End, -10.0, [x - 10.0 - width, x - 10.0])
    } else {
        (Anchor::Start, 10.0, [x + 10.0, x + 10.0 + width])
    };
    let [bottom, top] = plot.y.places;
    let is_free = |line: &f64| {
        let crossed = levels
            .iter()
            .any(|level| (line - ASCENT - 3.0..line + DESCENT + 3.0).contains(level));
        let meets = |(other, at): &([f64; 2], f64)| {
            ends[0] < other[1] && other[0] < ends[1] && (line - at).abs() < ASCENT + DESCENT
        };
        !crossed && !taken.iter().any(meets) && line - ASCENT > top && line + DESCENT < bottom
    };
    // Above it, where no curve can be, before below it.
    let lines = [-8.0, -14.0, -24.0, -36.0, 5.0, 16.0, 26.0, 36.0, -50.0, 50.0].map(|down| y + down);
    let line = lines.into_iter().find(is_free).unwrap_or(y - 4.0);
    taken.push((ends, line));
    let style = format!("font-weight=\"bold\" {}", sheet::HALO);
    svg.text((x + side, line), anchor, &style, &words);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;

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
            .find(|line| line.contains(paint) && !line.contains("h24"))
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
            let levels = [level_of(&picture, &limit()), level_of(&picture, &mean())];
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
