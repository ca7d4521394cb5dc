//! How far the machined contour stands off the part, along the whole profile.

use super::plot::{BELOW, Plot};
use super::sheet::{self, BLUE, Entry, GREEN, Swatch, TOP, VERMILION};
use super::svg::{Anchor, Svg, number};
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
    /// The mean.
    pub mean: f64,
    /// The limit, when the job has one.
    pub limit: Option<f64>,
}

const HEIGHT: f64 = 240.0;
/// Columns that the curve is looked at in.
const COLUMNS: u32 = 1140;
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
    let bottom = TOP + HEIGHT;
    let plot = Plot::new([from, to], [0.0, highest * 1.12], [TOP, bottom]);
    let mut svg = sheet::sheet(
        deviation.heading,
        &description(deviation),
        bottom + BELOW,
        &legend(deviation),
    );
    plot.ground(&mut svg);
    let curve = Thinned::of(deviation.curve, COLUMNS);
    svg.path(
        plot.area(&curve).text(),
        &format!("fill=\"{BLUE}\" fill-opacity=\"0.18\""),
    );
    svg.path(plot.curve(&curve).text(), CURVE);
    svg.path(&plot.level(deviation.mean), &mean());
    if let Some(limit) = deviation.limit {
        svg.path(&plot.level(limit), &self::limit());
    }
    let circle = format!("r=\"5\" fill=\"{BLUE}\" stroke=\"#ffffff\" stroke-width=\"1.5\"");
    // The hollow's mark is the higher one: the words of the other make room for it.
    let side_by_side = deviation.hollow.is_some_and(|hollow| {
        let ([x, y], [other_x, other_y]) = (plot.at(hollow), plot.at(deviation.largest));
        (x - other_x).abs() < WORDS[0] && (y - other_y).abs() < WORDS[1]
    });
    let below = if side_by_side { Words::Below } else { Words::Above };
    mark(&mut svg, deviation.largest, &plot, &circle, below);
    if let Some(hollow) = deviation.hollow {
        mark(&mut svg, hollow, &plot, &ring(), Words::Above);
    }
    plot.frame(&mut svg, "x, mm", "distance from the part, mm");
    svg.finish()
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
            format!(" The part lies up to {height:.2} mm from the machined contour, at x {x:.1} mm.")
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
    let mut legend = vec![
        Entry::line(CURVE, "distance"),
        Entry::line(mean(), format!("mean, {:.2} mm", deviation.mean)),
    ];
    if deviation.hollow.is_some() {
        legend.push(Entry {
            swatch: Swatch::Mark(
                "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z".to_owned(),
                format!("fill=\"#ffffff\" stroke=\"{VERMILION}\" stroke-width=\"2\""),
            ),
            words: "part from contour".to_owned(),
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

/// How much room the words of a mark take, to the side and upwards.
const WORDS: [f64; 2] = [160.0, 16.0];

/// Where the words of a mark stand.
#[derive(Clone, Copy)]
enum Words {
    Above,
    Below,
}

/// A circle at a place, with its distance and x.
fn mark(svg: &mut Svg, place: [f64; 2], plot: &Plot, circle: &str, words: Words) {
    let [x, y] = plot.at(place);
    svg.line(&format!(
        "  <circle cx=\"{}\" cy=\"{}\" {circle}/>",
        number(x),
        number(y)
    ));
    let [left, right] = plot.x.places;
    let anchor = if x > f64::midpoint(left, right) {
        Anchor::End
    } else {
        Anchor::Start
    };
    let side = match anchor {
        Anchor::End => -10.0,
        Anchor::Start | Anchor::Middle => 10.0,
    };
    let down = match words {
        Words::Above => -4.0,
        Words::Below => 16.0,
    };
    svg.text(
        (x + side, y + down),
        anchor,
        &format!("font-weight=\"bold\" {}", sheet::HALO),
        &format!("{:.2} mm at x {:.1}", place[1], place[0]),
    );
}
