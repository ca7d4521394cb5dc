//! Where the axes of a machine are all along a program: a panel for each, with its angle, how near it comes to its limits, and
//! its rate.

use super::band::{Band, MANY};
use super::palette::{BLUE, INK, VERMILION};
use super::plot::Plot;
use super::scale::Scale;
use super::section::most_ticks;
use super::sheet::{self, Entry, Room};
use super::svg::{Along, Anchor, Svg, number};
use super::times::KINDS;
use super::trace::Trace;
use super::{Prefix, Setting};

pub use super::sheet::Heading;

/// Columns that curves are looked at in: as many as the widest plot is wide.
pub const COLUMNS: u32 = 1050;
/// The narrowest columns in which the turns of many cuts are looked at.
const NARROWEST: f64 = 2.0;
/// An axis with less than this share of half its range left, or with less than this share of its rate, is marked.
const SCARCE: f64 = 0.05;

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
    /// How many cuts there are. What the axes do in a hundred and more is drawn as the band that it fills.
    pub cuts: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub name: String,
    /// `deg` or `mm`.
    pub unit: &'static str,
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
const NEAR: &str = "fill=\"#d55e00\"";
const BAND: &str = "fill=\"#0072b2\" fill-opacity=\"0.35\"";
const USED: &str = "fill=\"#8a8577\"";
const RATE: &str = "fill=\"#6d5a8c\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(joints: &Joints<'_>) -> String {
    let room = Room::of(joints.heading.ids);
    let panels = room.top + STRIP + 34.0;
    let margins = panels + PANEL * joints.axes.len() as f64;
    let bottom = margins + HEAD + VALUES;
    let time = Scale::new([0.0, joints.seconds], [room.left, room.right]);
    let mut svg = sheet::sheet(
        joints.heading,
        room,
        &description(joints),
        bottom + 66.0,
        &legend(joints),
    );
    strip(&mut svg, joints, &time, room);
    for (index, axis) in (0_u32..).zip(joints.axes) {
        panel(&mut svg, joints, axis, room, panels + PANEL * f64::from(index));
    }
    let plot = margin(&mut svg, joints, room, [margins, bottom]);
    plot.frame_over_time(&mut svg);
    svg.cursor(Along::Time, &time, [room.top, bottom]);
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

/// The words above a panel. A telephone has no room for all of them.
fn headline(axis: &Axis, ids: Prefix) -> String {
    let [low, high] = extremes(&axis.values);
    match ids.setting {
        Setting::Alone | Setting::Page => words(axis),
        Setting::Phone => {
            let rate = axis
                .highest_rate
                .map(|rate| format!("; rate {:.0} %", rate * 100.0));
            format!(
                "{}: {low:.1} to {high:.1} {}{}",
                axis.name,
                axis.unit,
                rate.unwrap_or_default()
            )
        }
    }
}

/// What an axis has little left of, if anything.
fn scarcity(axis: &Axis) -> Option<Scarce> {
    let ([low, high], [min, max]) = (extremes(&axis.values), axis.limits);
    let left = (low - min).min(max - high) / ((max - min) / 2.0).max(f64::MIN_POSITIVE);
    let is_fast = axis.highest_rate.is_some_and(|rate| rate > 1.0 - SCARCE);
    match (left < SCARCE, is_fast) {
        (true, true) => Some(Scarce::Both),
        (true, false) => Some(Scarce::Range),
        (false, true) => Some(Scarce::Rate),
        (false, false) => None,
    }
}

/// What an axis has little left of.
#[derive(Clone, Copy)]
enum Scarce {
    Range,
    Rate,
    Both,
}

impl Scarce {
    const fn words(self) -> &'static str {
        match self {
            Self::Range => "near a limit",
            Self::Rate => "near its highest rate",
            Self::Both => "near a limit and its highest rate",
        }
    }
}

/// The band that what many cuts do over time fills: in columns of more than a cut each, so that there are no gaps between them.
fn turns(joints: &Joints<'_>, room: Room, curve: &[[f64; 2]]) -> Band {
    let most = joints.cuts as f64 / 1.3;
    Band::of(curve, most.min(room.across() / NARROWEST) as u32)
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
        if joints.cuts >= MANY {
            Entry::area(
                format!("{BAND} stroke=\"{BLUE}\""),
                "value (turns drawn as a band)",
            )
        } else {
            Entry::line(CURVE, "value")
        },
        Entry::area(RATE, "rate, of the axis' highest"),
        Entry::area(BEYOND, "out of its limits"),
        Entry::area(USED, "range used (bar at the right)"),
        Entry::area(NEAR, "less than 5 % left"),
    ]);
    legend
}

/// What is done when: each column divided by the shares of kinds, and where layers begin.
fn strip(svg: &mut Svg, joints: &Joints<'_>, time: &Scale, room: Room) {
    let mut traces: Vec<Vec<[f64; 4]>> = vec![Vec::new(); joints.kinds.len()];
    let shares = shares(joints, room.columns());
    let width = room.across() / f64::from(room.columns());
    let mut left = room.left;
    for run in shares.chunk_by(|a, b| a == b) {
        let right = left + width * run.len() as f64;
        let mut top = room.top;
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
    layers(svg, joints, time, room);
}

/// Names of layers above where they begin, as many as there is room for.
fn layers(svg: &mut Svg, joints: &Joints<'_>, time: &Scale, room: Room) {
    let mut marks = String::new();
    let mut free_from = room.left;
    for (start, name) in joints.layers {
        let x = time.at(*start);
        let width = sheet::text_width(name);
        if x >= free_from - 1e-9 && x + width <= room.right {
            marks += &format!("M{} {}v5", number(x), number(room.top + STRIP));
            svg.text((x, room.top + STRIP + 20.0), Anchor::Start, "", name);
            free_from = x + width + 10.0;
        }
    }
    if !marks.is_empty() {
        svg.path(&marks, &format!("stroke=\"{INK}\" fill=\"none\""));
    }
    svg.text(
        (room.left - 10.0, room.top + STRIP + 20.0),
        Anchor::End,
        "",
        "layer",
    );
}

/// For each column, how much of its time each kind takes, in steps of a sixteenth so that neighbours are often alike.
fn shares(joints: &Joints<'_>, count: u32) -> Vec<Vec<f64>> {
    let width = joints.seconds.max(f64::MIN_POSITIVE) / f64::from(count);
    let mut columns = vec![vec![0.0; joints.kinds.len()]; count as usize];
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
fn panel(svg: &mut Svg, joints: &Joints<'_>, axis: &Axis, room: Room, top: f64) {
    let heading = headline(axis, joints.heading.ids);
    let scarce = scarcity(axis);
    svg.text((room.left - 42.0, top + 20.0), Anchor::Start, "", &heading);
    if let Some(scarce) = scarce.filter(|_| joints.heading.ids.setting != Setting::Phone) {
        let x = room.left - 42.0 + sheet::text_width(&heading) + 12.0;
        let style = "font-weight=\"bold\"";
        svg.coloured((x, top + 20.0), Anchor::Start, VERMILION, style, scarce.words());
    }
    let [low, high] = seen(axis);
    let plot = Plot::new(
        room,
        [0.0, joints.seconds],
        [low, high],
        [top + HEAD, top + HEAD + VALUES],
    );
    plot.ground(svg);
    let [min, max] = axis.limits;
    for [from, to] in [[low, min], [max, high]] {
        if to > from {
            let (upper, lower) = (plot.y.at(to), plot.y.at(from));
            svg.rect([room.left, upper, room.across(), lower - upper], BEYOND);
        }
    }
    let is_many = joints.cuts >= MANY;
    if is_many {
        let paint = format!("{BAND} stroke=\"{BLUE}\" stroke-width=\"0.8\"");
        svg.path(plot.between(&turns(joints, room, &axis.values)).text(), &paint);
    } else {
        svg.path(plot.curve(&axis.values).text(), CURVE);
    }
    let mut marks = String::new();
    for (value, text) in plot.y.ticks(most_ticks(VALUES, 20.0)) {
        let y = plot.y.at(value);
        marks += &format!("M{} {}h-5", number(room.left), number(y));
        svg.text((room.left - 9.0, y + 5.0), Anchor::End, "", &text);
    }
    let bottom = top + HEAD + VALUES + RATES;
    if let Some(rates) = &axis.rates {
        let plot = Plot::new(room, [0.0, joints.seconds], [0.0, 1.0], [bottom - RATES, bottom]);
        svg.rect(
            [room.left, bottom - RATES, room.across(), RATES],
            "fill=\"#f3f0fa\"",
        );
        let area = if is_many {
            plot.area(&turns(joints, room, rates).upper)
        } else {
            plot.area(rates)
        };
        let paint = match scarce {
            Some(Scarce::Rate | Scarce::Both) => NEAR,
            Some(Scarce::Range) | None => RATE,
        };
        svg.path(area.text(), paint);
        svg.text((room.left - 9.0, bottom - 8.0), Anchor::End, "", "rate");
    }
    let frame = format!("stroke=\"{INK}\" fill=\"none\"");
    svg.path(&marks, &frame);
    svg.rect([room.left, top + HEAD, room.across(), VALUES], &frame);
    let used = match scarce {
        Some(Scarce::Range | Scarce::Both) => NEAR,
        Some(Scarce::Rate) | None => USED,
    };
    gauge(svg, axis, used, [room.right + 12.0, top + HEAD, bottom]);
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
fn gauge(svg: &mut Svg, axis: &Axis, used: &str, [left, top, bottom]: [f64; 3]) {
    let range = Scale::new(axis.limits, [bottom, top]);
    let [low, high] = extremes(&axis.values).map(|value| value.clamp(range.values[0], range.values[1]));
    svg.rect([left, top, 16.0, bottom - top], "fill=\"#ffffff\"");
    let (upper, lower) = (range.at(high), range.at(low));
    svg.rect([left, upper, 16.0, (lower - upper).max(1.5)], used);
    svg.rect(
        [left, top, 16.0, bottom - top],
        &format!("fill=\"none\" stroke=\"{INK}\""),
    );
}

/// The smallest margin over time.
fn margin(svg: &mut Svg, joints: &Joints<'_>, room: Room, [top, bottom]: [f64; 2]) -> Plot {
    let [_, most] = extremes(joints.margin);
    let words = "smallest margin of any axis, %";
    svg.text((room.left - 42.0, top + 20.0), Anchor::Start, "", words);
    let percent: Vec<[f64; 2]> = joints
        .margin
        .iter()
        .map(|[time, share]| [*time, share * 100.0])
        .collect();
    let plot = Plot::new(
        room,
        [0.0, joints.seconds],
        [0.0, (most * 110.0).clamp(10.0, 100.0)],
        [top + HEAD, bottom],
    );
    plot.ground(svg);
    if joints.cuts >= MANY {
        let band = turns(joints, room, &percent);
        svg.path(plot.between(&band).text(), BAND);
        svg.path(plot.curve(&band.lower).text(), CURVE);
    } else {
        svg.path(
            plot.area(&percent).text(),
            &format!("fill=\"{BLUE}\" fill-opacity=\"0.18\""),
        );
        let line: Trace = plot.curve(&percent);
        svg.path(line.text(), CURVE);
    }
    svg.path(
        &plot.level(0.0),
        &format!("stroke=\"{VERMILION}\" stroke-width=\"2\" fill=\"none\""),
    );
    plot
}
