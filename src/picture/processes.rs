//! The times of two ways to cut the same work over its depth, as figures 10 to 12 of [Yu 2019] show them: straight lines, and where
//! they cross.

use super::chart::{Chart, Plot, Series, Shape};
use super::palette::{BLUE, INK, ORANGE};
use super::scale::Scale;
use super::sheet::Room;
use super::svg::Mark;
use super::trace::number;
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::Duration;

pub use super::sheet::Heading;

/// What a picture of processes shows. Depths are in mm, times in s.
#[derive(Clone, Debug, PartialEq)]
pub struct Processes<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The way that was taken, and the other one.
    pub ways: [Way<'a>; 2],
    /// The depth of the job's stock.
    pub depth: f64,
    /// Up to which depth is shown; positive.
    pub deepest: f64,
    /// The depth at which both take as long, and that time.
    pub crossing: Option<[f64; 2]>,
}

/// A way to cut the work.
#[derive(Clone, Debug, PartialEq)]
pub struct Way<'a> {
    pub name: &'a str,
    /// Its times at the depths 0 and `deepest`.
    pub ends: [f64; 2],
    /// The same with other feeds of a blade that spins, with what they are called.
    pub others: Vec<(String, [f64; 2])>,
}

const HEIGHT: f64 = 320.0;
/// Room at the left for the units beside times.
const WORDS: f64 = 28.0;
/// Dashes of other feeds, in their order: from sparse to dense.
const DASHES: [&str; 3] = ["2 8", "6 6", "12 4"];

/// Writes the picture as SVG.
#[must_use]
pub fn draw(picture: &Processes<'_>) -> String {
    let room = Room::of(picture.heading.ids);
    let longest = picture.ways.iter().flat_map(Way::times).fold(0.0, f64::max);
    let y = Scale::clock([0.0, longest * 1.05], [room.top + HEIGHT, room.top]);
    let label = y.time_label();
    Chart {
        heading: picture.heading,
        description: description(picture),
        plot: Plot {
            x: Scale::new([0.0, picture.deepest], [room.left + WORDS, room.right]),
            y,
        },
        labels: ["depth of the work, mm", label],
        series: series(picture),
        along: None,
    }
    .draw()
}

impl Way<'_> {
    fn times(&self) -> impl Iterator<Item = f64> {
        let others = self.others.iter().flat_map(|(_, ends)| ends);
        self.ends.iter().chain(others).copied()
    }
}

/// The picture in words.
fn description(picture: &Processes<'_>) -> String {
    let [taken, other] = &picture.ways;
    let crossing = picture.crossing.map_or_else(
        || "They do not cross.".to_owned(),
        |[depth, time]| {
            format!(
                "They cross at a depth of {} mm, at {}.",
                number(depth),
                duration_words(Duration::s(time))
            )
        },
    );
    format!(
        "{}: time over the depth of the work, of {}, which was taken, and of {}. {crossing}",
        picture.heading.subtitle, taken.name, other.name
    )
}

fn series(picture: &Processes<'_>) -> Vec<Series> {
    let line = |[from, to]: [f64; 2]| Shape::Curve(vec![[0.0, from], [picture.deepest, to]]);
    let mut series = Vec::new();
    for (way, colour) in picture.ways.iter().zip([BLUE, ORANGE]) {
        for ((name, ends), dashes) in way.others.iter().zip(DASHES) {
            let paint = format!(
                "fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\" stroke-dasharray=\"{dashes}\""
            );
            series.push(Series::new(line(*ends), paint).named(name.as_str()));
        }
        let paint = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\"");
        series.push(Series::new(line(way.ends), paint).named(way.name));
    }
    let stock = format!("fill=\"none\" stroke=\"{INK}\" stroke-dasharray=\"6 4\"");
    series.push(Series::new(Shape::Upright(picture.depth), stock).named("depth of the stock"));
    if let Some([depth, time]) = picture.crossing {
        let words = format!("{} mm", number((depth * 10.0).round() / 10.0));
        series.push(Series::mark(Mark::DISC, [depth, time], Some(words)));
    }
    series
}
