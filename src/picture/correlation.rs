//! How two contours correlate when one is shifted against the other, as in figure 15 of [Cui 2020].

use super::palette::{BLUE, VERMILION};
use super::plot::{BELOW, Plot};
use super::sheet::{self, Entry, Room};
use super::svg::{Anchor, number};

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
    let points: Vec<[f64; 2]> = (0_u32..)
        .zip(correlation.values)
        .map(|(index, &value)| [f64::from(index) - farthest, value])
        .collect();
    let highest = points
        .iter()
        .copied()
        .max_by(|a, b| a[1].total_cmp(&b[1]))
        .unwrap_or_default();
    let room = Room::of(correlation.heading.ids);
    let bottom = room.top + HEIGHT;
    // Heights are positive, and so are their products.
    let plot = Plot::new(
        room,
        [-farthest, farthest.max(1.0)],
        [0.0, 1.1],
        [room.top, bottom],
    );
    let words = format!("{:.4} at lag {}", highest[1], number(highest[0]));
    let description = format!(
        "{}. Normalised cross-correlation over the lag in points: a hill that is highest, {words}.",
        correlation.heading.subtitle
    );
    let legend = [
        Entry::line(CURVE, "normalised cross-correlation"),
        Entry::line(marked(), "lag zero"),
    ];
    let mut svg = sheet::sheet(correlation.heading, room, &description, bottom + BELOW, &legend);
    plot.ground(&mut svg);
    let zero = format!(
        "M{} {}V{}",
        number(plot.x.at(0.0)),
        number(room.top),
        number(bottom)
    );
    svg.path(&zero, &marked());
    svg.path(plot.curve(&points).text(), CURVE);
    let [x, y] = plot.at(highest);
    svg.line(&format!(
        "  <circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"{BLUE}\" stroke=\"#ffffff\" stroke-width=\"1.5\"/>",
        number(x),
        number(y)
    ));
    let bold = format!("font-weight=\"bold\" {}", sheet::HALO);
    svg.text((x + 12.0, y + 1.0), Anchor::Start, &bold, &words);
    plot.frame(&mut svg, "lag, points", "correlation");
    svg.finish()
}

fn marked() -> String {
    format!("fill=\"none\" stroke=\"{VERMILION}\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"")
}
