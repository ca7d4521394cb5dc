//! Where the axes of a machine are all along a program: a panel for each, with its angle, how near it comes to its limits, and
//! its rate.

use super::plot::Plot;
use super::scale::Scale;
use super::section::most_ticks;
use super::sheet::{self, BLUE, Entry, INK, LEFT, RIGHT, TOP, VERMILION};
use super::svg::{Anchor, Svg, number};
use super::times::KINDS;
use super::trace::Trace;

pub use super::sheet::Heading;

/// Columns that curves are looked at in: as many as the plot is wide.
pub const COLUMNS: u32 = 570;

/// What a picture of axes shows. Times are in s, values in the axis' unit; curves are thinned to [`COLUMNS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Joints<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// How long the program takes.
    pub seconds: f64,
    /// The axes, in the controller's order.
    pub axes: &'a [Axis],
    /// The smallest margin of all axes over time, from 0 to 1.
    pub margin: &'a [[f64; 2]],
    /// Names of the kinds of motion.
    pub kinds: &'a [&'static str],
    /// What is done when: stretches in the order of time.
    pub spans: &'a [Span],
    /// When layers begin, and what they are called.
    pub layers: &'a [(f64, String)],
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its name.
    pub name: String,
    /// `deg` or `mm`.
    pub unit: &'static str,
    /// Its limits.
    pub limits: [f64; 2],
    /// Its values over time.
    pub values: Vec<[f64; 2]>,
    /// Its rate over time as a share of the highest; nothing where that is not known.
    pub rates: Option<Vec<[f64; 2]>>,
    /// Its highest rate as a share of what it can do, as proven: the curve's samples may miss it by a little.
    pub highest_rate: Option<f64>,
}

/// A stretch of time in which motions of one kind are done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// When it begins and ends.
    pub time: [f64; 2],
    /// Which of the kinds.
    pub kind: usize,
}

const STRIP: f64 = 16.0;
const HEAD: f64 = 30.0;
const VALUES: f64 = 70.0;
const RATES: f64 = 30.0;
const GAP: f64 = 16.0;
const PANEL: f64 = HEAD + VALUES + RATES + GAP;
const CURVE: &str = "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.4\" stroke-linejoin=\"round\"";
const BEYOND: &str = "fill=\"#d55e00\" fill-opacity=\"0.25\"";
const USED: &str = "fill=\"#8a8577\"";
const RATE: &str = "fill=\"#6d5a8c\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(joints: &Joints<'_>) -> String {
    let panels = TOP + STRIP + 34.0;
    let margins = panels + PANEL * joints.axes.len() as f64;
    let bottom = margins + HEAD + VALUES;
    let time = Scale::new([0.0, joints.seconds], [LEFT, RIGHT]);
    let mut svg = sheet::sheet(
        joints.heading,
        &description(joints),
        bottom + 66.0,
        &legend(joints),
    );
    strip(&mut svg, joints, &time);
    for (index, axis) in (0_u32..).zip(joints.axes) {
        panel(&mut svg, axis, &time, panels + PANEL * f64::from(index));
    }
    let plot = margin(&mut svg, joints, margins, bottom);
    plot.frame(&mut svg, "time, s", "");
    svg.finish()
}

fn description(joints: &Joints<'_>) -> String {
    let axes: Vec<String> = joints.axes.iter().map(words).collect();
    format!(
        "{}. Axes over {:.1} s: {}.",
        joints.heading.subtitle,
        joints.seconds,
        axes.join("; ")
    )
}

fn words(axis: &Axis) -> String {
    let [low, high] = extremes(&axis.values);
    let [min, max] = axis.limits;
    let rate = match axis.highest_rate {
        Some(rate) => format!(", rate up to {:.0} %", rate * 100.0),
        None => String::new(),
    };
    format!(
        "{}: {low:.1} to {high:.1} {}, limits {} to {}{rate}",
        axis.name,
        axis.unit,
        number(min),
        number(max)
    )
}

fn extremes(points: &[[f64; 2]]) -> [f64; 2] {
    let values = points.iter().map(|point| point[1]);
    let found = values.fold(None, |known: Option<[f64; 2]>, value| {
        let [low, high] = known.unwrap_or([value, value]);
        Some([low.min(value), high.max(value)])
    });
    found.unwrap_or_default()
}

fn legend(joints: &Joints<'_>) -> Vec<Entry> {
    let kinds = joints.kinds.iter().zip(KINDS).enumerate();
    let mut legend: Vec<Entry> = kinds
        .filter(|(number, _)| joints.spans.iter().any(|span| span.kind == *number))
        .map(|(_, (kind, colour))| Entry::area(format!("fill=\"{colour}\""), *kind))
        .collect();
    legend.extend([
        Entry::line(CURVE, "value"),
        Entry::area(RATE, "rate as share of the highest"),
        Entry::area(BEYOND, "beyond a limit"),
        Entry::area(USED, "used of the range (right)"),
    ]);
    legend
}

/// What is done when: each column divided by the shares of kinds, and where layers begin.
fn strip(svg: &mut Svg, joints: &Joints<'_>, time: &Scale) {
    let mut traces: Vec<Vec<[f64; 4]>> = vec![Vec::new(); joints.kinds.len()];
    let shares = shares(joints);
    let width = (RIGHT - LEFT) / f64::from(COLUMNS);
    let mut left = LEFT;
    for run in shares.chunk_by(|a, b| a == b) {
        let right = left + width * run.len() as f64;
        let mut top = TOP;
        for (share, rects) in run.iter().take(1).flatten().zip(&mut traces) {
            if *share > 0.0 {
                rects.push([left, top, right - left, share * STRIP]);
                top += share * STRIP;
            }
        }
        left = right;
    }
    for (rects, colour) in traces.iter().zip(KINDS) {
        if !rects.is_empty() {
            svg.rects(
                rects,
                &format!("fill=\"{colour}\" shape-rendering=\"crispEdges\""),
            );
        }
    }
    layers(svg, joints, time);
}

/// Names of layers above where they begin, as many as there is room for.
fn layers(svg: &mut Svg, joints: &Joints<'_>, time: &Scale) {
    let mut marks = String::new();
    let mut free_from = LEFT;
    for (start, name) in joints.layers {
        let x = time.at(*start);
        let width = sheet::text_width(name);
        if x >= free_from - 1e-9 && x + width <= RIGHT {
            marks += &format!("M{} {}v5", number(x), number(TOP + STRIP));
            svg.text((x, TOP + STRIP + 20.0), Anchor::Start, "", name);
            free_from = x + width + 10.0;
        }
    }
    if !marks.is_empty() {
        svg.path(&marks, &format!("stroke=\"{INK}\" fill=\"none\""));
    }
    svg.text((LEFT - 10.0, TOP + STRIP + 20.0), Anchor::End, "", "layer");
}

/// For each column, how much of its time each kind takes, in steps of a sixteenth so that neighbours are often alike.
fn shares(joints: &Joints<'_>) -> Vec<Vec<f64>> {
    let width = joints.seconds.max(f64::MIN_POSITIVE) / f64::from(COLUMNS);
    let mut columns = vec![vec![0.0; joints.kinds.len()]; COLUMNS as usize];
    for span in joints.spans {
        let [from, to] = span.time;
        let mut at = from;
        let mut column = (from / width) as usize;
        while at < to && column < columns.len() {
            let end = to.min((column + 1) as f64 * width);
            if let Some(share) = columns
                .get_mut(column)
                .and_then(|shares| shares.get_mut(span.kind))
            {
                *share += (end - at).max(0.0) / width;
            }
            at = end;
            column += 1;
        }
    }
    for shares in &mut columns {
        for share in shares.iter_mut() {
            *share = (*share * 16.0).round() / 16.0;
        }
    }
    columns
}

/// The panel of an axis.
fn panel(svg: &mut Svg, axis: &Axis, time: &Scale, top: f64) {
    svg.text((24.0, top + 20.0), Anchor::Start, "", &words(axis));
    let [low, high] = seen(axis);
    let plot = Plot::new(time.values, [low, high], [top + HEAD, top + HEAD + VALUES]);
    plot.ground(svg);
    let [min, max] = axis.limits;
    for [from, to] in [[low, min], [max, high]] {
        if to > from {
            let (upper, lower) = (plot.y.at(to), plot.y.at(from));
            svg.rect([LEFT, upper, RIGHT - LEFT, lower - upper], BEYOND);
        }
    }
    svg.path(plot.curve(&axis.values).text(), CURVE);
    let mut marks = String::new();
    for (value, text) in plot.y.ticks(most_ticks(VALUES, 22.0)) {
        let y = plot.y.at(value);
        marks += &format!("M{} {}h-5", number(LEFT), number(y));
        svg.text((LEFT - 9.0, y + 5.0), Anchor::End, "", &text);
    }
    let bottom = top + HEAD + VALUES + RATES;
    if let Some(rates) = &axis.rates {
        let plot = Plot::new(time.values, [0.0, 1.0], [bottom - RATES, bottom]);
        svg.rect([LEFT, bottom - RATES, RIGHT - LEFT, RATES], "fill=\"#f3f0fa\"");
        svg.path(plot.area(rates).text(), RATE);
        svg.text((LEFT - 9.0, bottom - 8.0), Anchor::End, "", "rate");
    }
    let frame = format!("stroke=\"{INK}\" fill=\"none\"");
    svg.path(&marks, &frame);
    svg.rect([LEFT, top + HEAD, RIGHT - LEFT, VALUES], &frame);
    gauge(svg, axis, [top + HEAD, bottom]);
}

/// The values that a panel shows: those that are taken, widened, and the limits where these are near.
fn seen(axis: &Axis) -> [f64; 2] {
    let [low, high] = extremes(&axis.values);
    let room = ((high - low) * 0.15).max(1.0);
    let near = (high - low).max(10.0);
    let [min, max] = axis.limits;
    let least = if low - min < near {
        (min - room).min(low - room)
    } else {
        low - room
    };
    let most = if max - high < near {
        (max + room).max(high + room)
    } else {
        high + room
    };
    [least, most]
}

/// The whole range of an axis, and what is used of it.
fn gauge(svg: &mut Svg, axis: &Axis, [top, bottom]: [f64; 2]) {
    let range = Scale::new(axis.limits, [bottom, top]);
    let [low, high] = extremes(&axis.values).map(|value| value.clamp(range.values[0], range.values[1]));
    let left = RIGHT + 12.0;
    svg.rect([left, top, 16.0, bottom - top], "fill=\"#ffffff\"");
    let (upper, lower) = (range.at(high), range.at(low));
    svg.rect([left, upper, 16.0, (lower - upper).max(1.5)], USED);
    svg.rect(
        [left, top, 16.0, bottom - top],
        &format!("fill=\"none\" stroke=\"{INK}\""),
    );
}

/// The smallest margin over time.
fn margin(svg: &mut Svg, joints: &Joints<'_>, top: f64, bottom: f64) -> Plot {
    let [_, most] = extremes(joints.margin);
    let words = "smallest margin of any axis, %";
    svg.text((24.0, top + 20.0), Anchor::Start, "", words);
    let percent: Vec<[f64; 2]> = joints
        .margin
        .iter()
        .map(|[time, share]| [*time, share * 100.0])
        .collect();
    let plot = Plot::new(
        [0.0, joints.seconds],
        [0.0, (most * 110.0).clamp(10.0, 100.0)],
        [top + HEAD, bottom],
    );
    plot.ground(svg);
    svg.path(
        plot.area(&percent).text(),
        &format!("fill=\"{BLUE}\" fill-opacity=\"0.18\""),
    );
    let line: Trace = plot.curve(&percent);
    svg.path(line.text(), CURVE);
    svg.path(
        &plot.level(0.0),
        &format!("stroke=\"{VERMILION}\" stroke-width=\"2\" fill=\"none\""),
    );
    plot
}
