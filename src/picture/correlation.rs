//! How two contours correlate when one is shifted against the other, as in figure 15 of [Cui 2020].

use super::chart::{Chart, Plot, Series, Shape};
use super::palette::VERMILION;
use super::sheet::Room;
use super::svg::Mark;
use super::trace::number;

pub use super::sheet::Heading;

/// What a picture of a correlation shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The normalised cross-correlation at every lag from -(n - 1) to n - 1.
    pub values: &'a [f64],
}

const HEIGHT: f64 = 260.0;
const CURVE: &str = "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2\" stroke-linejoin=\"round\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(correlation: &Correlation<'_>) -> String {
    let farthest = (correlation.values.len().saturating_sub(1) / 2) as f64;
    let lags = (0_u32..).map(|index| f64::from(index) - farthest);
    let points: Vec<[f64; 2]> = lags
        .zip(correlation.values)
        .map(|(lag, &value)| [lag, value])
        .collect();
    let highest = points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]));
    let highest = highest.unwrap_or_default();
    let room = Room::of(correlation.heading.ids);
    let words = format!("{:.4} at lag {}", highest[1], number(highest[0]));
    let zero = format!("fill=\"none\" stroke=\"{VERMILION}\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"");
    Chart {
        heading: correlation.heading,
        description: format!(
            "{}. Normalised cross-correlation over the lag in points: a hill that is highest, {words}.",
            correlation.heading.subtitle
        ),
        // Heights are positive, and so are their products.
        plot: Plot::new(
            room,
            [-farthest, farthest.max(1.0)],
            [0.0, 1.1],
            [room.top, room.top + HEIGHT],
        ),
        labels: ["lag, points", "correlation"],
        series: vec![
            Series::new(Shape::Upright(0.0), zero).named("lag zero"),
            Series::new(Shape::Curve(points), CURVE).named("normalised cross-correlation"),
            Series::mark(Mark::DISC, highest, Some(words)),
        ],
        along: None,
    }
    .draw()
}
