//! Where the axes of a machine are all along a program: a panel for each, with its angle, how near it comes to its limits, and
//! its rate.

use super::band::{Band, MANY};
use super::chart::{self, BELOW, FRAME, Plot, Series, Shape};
use super::palette::VERMILION;
use super::scale::Scale;
use super::sheet::{self, Entry, Room};
use super::svg::{Along, Anchor, Svg};
use super::times::KINDS;
use super::trace::{Trace, number};
use super::{Point, Setting};

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
const EDGED: &str = "fill=\"#0072b2\" fill-opacity=\"0.35\" stroke=\"#0072b2\" stroke-width=\"0.8\"";
const BELOW_CURVE: &str = "fill=\"#0072b2\" fill-opacity=\"0.18\"";
const USED: &str = "fill=\"#8a8577\"";
const RATE: &str = "fill=\"#6d5a8c\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(joints: &Joints<'_>) -> String {
    let room = Room::of(joints.heading.ids);
    let panels = room.top + STRIP + 34.0;
    let margins = panels + PANEL * joints.axes.len() as f64;
    let bottom = margins + HEAD + VALUES;
    let (description, legend) = (description(joints), legend(joints));
    let mut svg = sheet::sheet(joints.heading, room, &description, bottom + BELOW, &legend);
    let picture = Panels { joints, room };
    picture.strip(&mut svg);
    for (index, axis) in (0_u32..).zip(joints.axes) {
        picture.axis(&mut svg, axis, panels + PANEL * f64::from(index));
    }
    picture.margin(&mut svg, margins);
    svg.cursor(Along::Time, &picture.time(), [room.top, bottom]);
    svg.finish()
}

fn description(joints: &Joints<'_>) -> String {
    let axes: Vec<String> = joints
        .axes
        .iter()
        .map(|axis| axis.words(Setting::Alone))
        .collect();
    let (subtitle, axes) = (joints.heading.subtitle, axes.join("; "));
    format!("{subtitle}. Axes over {:.1} s: {axes}.", joints.seconds)
}

fn legend(joints: &Joints<'_>) -> Vec<Entry> {
    let is_done = |kind: &usize| joints.spans.iter().any(|span| span.kind == *kind);
    let kinds = joints.kinds.iter().zip(KINDS).enumerate();
    let mut legend: Vec<Entry> = kinds
        .filter(|(number, _)| is_done(number))
        .map(|(_, (kind, colour))| Entry::area(format!("fill=\"{colour}\""), *kind))
        .collect();
    legend.extend([
        if joints.cuts >= MANY {
            Entry::area(EDGED, "value (turns drawn as a band)")
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

impl Axis {
    /// A telephone has no room for all words.
    fn words(&self, setting: Setting) -> String {
        let [low, high] = extremes(&self.values);
        let [min, max] = self.limits.map(number);
        let (limits, rate) = match setting {
            Setting::Alone | Setting::Page => (format!(", limits {min} to {max}"), ", rate up to"),
            Setting::Phone => (String::new(), "; rate"),
        };
        let rate = self
            .highest_rate
            .map(|share| format!("{rate} {:.0} %", share * 100.0));
        let (name, unit, rate) = (&self.name, self.unit, rate.unwrap_or_default());
        format!("{name}: {low:.1} to {high:.1} {unit}{limits}{rate}")
    }

    /// Whether it has little left of its range, and of its rate.
    fn scarcity(&self) -> [bool; 2] {
        let ([low, high], [min, max]) = (extremes(&self.values), self.limits);
        let left = (low - min).min(max - high) / ((max - min) / 2.0).max(f64::MIN_POSITIVE);
        [
            left < SCARCE,
            self.highest_rate.is_some_and(|rate| rate > 1.0 - SCARCE),
        ]
    }

    /// The values that its panel shows: those that are taken, widened, and the limits where these are near.
    fn seen(&self) -> [f64; 2] {
        let [low, high] = extremes(&self.values);
        let room = ((high - low) * 0.15).max(1.0);
        let near = (high - low).max(10.0);
        let [min, max] = self.limits;
        let least = if low - min < near { low.min(min) } else { low };
        let most = if max - high < near { high.max(max) } else { high };
        [least - room, most + room]
    }
}

fn extremes(points: &[Point]) -> [f64; 2] {
    let values = points.iter().map(|point| [point[1], point[1]]);
    let found = values.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)]);
    found.unwrap_or_default()
}

/// A picture under construction.
struct Panels<'a> {
    joints: &'a Joints<'a>,
    room: Room,
}

impl Panels<'_> {
    fn time(&self) -> Scale {
        Scale::clock([0.0, self.joints.seconds], [self.room.left, self.room.right])
    }

    fn plot(&self, values: [f64; 2], [top, bottom]: [f64; 2]) -> Plot {
        Plot {
            x: self.time(),
            y: Scale::new(values, [bottom, top]),
        }
    }

    /// The band that what many cuts do over time fills: in columns of more than a cut each, so that there are no gaps between them.
    fn turns(&self, curve: &[Point]) -> Option<Band> {
        let most = self.joints.cuts as f64 / 1.3;
        let columns = most.min(self.room.across() / NARROWEST) as u32;
        (self.joints.cuts >= MANY).then(|| Band::of(curve, columns))
    }

    /// What is done when: each column divided by the shares of kinds, and where layers begin.
    fn strip(&self, svg: &mut Svg) {
        let mut rects: Vec<Vec<[f64; 4]>> = vec![Vec::new(); self.joints.kinds.len()];
        let width = self.room.across() / f64::from(self.room.columns());
        let mut left = self.room.left;
        for run in shares(self.joints, self.room.columns()).chunk_by(|a, b| a == b) {
            let right = left + width * run.len() as f64;
            let mut top = self.room.top;
            for (share, rects) in run.iter().take(1).flatten().zip(&mut rects) {
                if *share > 0.0 {
                    rects.push([left, top, right - left, share * STRIP]);
                    top += share * STRIP;
                }
            }
            left = right;
        }
        for (rects, colour) in rects.iter().zip(KINDS) {
            svg.rects(
                rects,
                &format!("fill=\"{colour}\" shape-rendering=\"crispEdges\""),
            );
        }
        self.layers(svg, self.room.top + STRIP);
    }

    /// Names of layers above where they begin, as many as there is room for.
    fn layers(&self, svg: &mut Svg, top: f64) {
        let (time, mut marks, mut free_from) = (self.time(), Trace::default(), self.room.left);
        for (start, name) in self.joints.layers {
            let x = time.at(*start);
            let width = sheet::text_width(name);
            if x >= free_from - 1e-9 && x + width <= self.room.right {
                marks.open([[x, top], [x, top + 5.0]]);
                svg.text([x, top + 20.0], Anchor::Start, "", name);
                free_from = x + width + 10.0;
            }
        }
        svg.path(marks.text(), FRAME);
        svg.text([self.room.left - 10.0, top + 20.0], Anchor::End, "", "layer");
    }

    /// The panel of an axis.
    fn axis(&self, svg: &mut Svg, axis: &Axis, top: f64) {
        let near = axis.scarcity();
        self.headline(svg, axis, near, top);
        let (upper, lower) = (top + HEAD, top + HEAD + VALUES);
        let [low, high] = axis.seen();
        let plot = self.plot([low, high], [upper, lower]);
        plot.ground(svg);
        let [min, max] = axis.limits;
        let beyond = [[low, min], [max, high]]
            .into_iter()
            .filter(|[from, to]| to > from);
        let boxes = beyond
            .map(|[from, to]| [0.0, self.joints.seconds, from, to])
            .collect();
        plot.draw(svg, &Series::new(Shape::Boxes(boxes), BEYOND));
        plot.draw(
            svg,
            &match self.turns(&axis.values) {
                Some(band) => Series::new(Shape::Polygon(band.outline()), EDGED),
                None => Series::new(Shape::Curve(axis.values.clone()), CURVE),
            },
        );
        let paint = |near, usual| if near { NEAR } else { usual };
        let bottom = lower + RATES;
        if let Some(rates) = &axis.rates {
            let (left, plot) = (self.room.left, self.plot([0.0, 1.0], [lower, bottom]));
            svg.rect([left, lower, self.room.across(), RATES], "fill=\"#f3f0fa\"");
            let rates = self.turns(rates).map_or_else(|| rates.clone(), |band| band.upper);
            plot.draw(svg, &Series::new(Shape::Area(rates), paint(near[1], RATE)));
            svg.text([left - 9.0, bottom - 8.0], Anchor::End, "", "rate");
        }
        chart::ticks_beside(svg, &plot.y, self.room.left, 20.0);
        svg.rect([self.room.left, upper, self.room.across(), VALUES], FRAME);
        gauge(
            svg,
            axis,
            paint(near[0], USED),
            [self.room.right + 12.0, upper, bottom],
        );
    }

    /// The words above a panel, and what its axis has little left of.
    fn headline(&self, svg: &mut Svg, axis: &Axis, near: [bool; 2], top: f64) {
        let at = [self.room.left - 42.0, top + 20.0];
        let scarce = match near {
            [false, false] => "",
            [true, false] => "near a limit",
            [false, true] => "near its highest rate",
            [true, true] => "near a limit and its highest rate",
        };
        let setting = self.joints.heading.ids.setting;
        let words = axis.words(setting);
        svg.text(at, Anchor::Start, "", &words);
        match setting {
            Setting::Phone => {}
            Setting::Alone | Setting::Page => {
                let after = [at[0] + sheet::text_width(&words) + 12.0, at[1]];
                svg.coloured(after, Anchor::Start, VERMILION, "font-weight=\"bold\"", scarce);
            }
        }
    }

    /// The smallest margin over time.
    fn margin(&self, svg: &mut Svg, top: f64) {
        let words = "smallest margin of any axis, %";
        svg.text([self.room.left - 42.0, top + 20.0], Anchor::Start, "", words);
        let percent: Vec<Point> = self
            .joints
            .margin
            .iter()
            .map(|[time, share]| [*time, share * 100.0])
            .collect();
        let most = (extremes(&percent)[1] * 1.1).clamp(10.0, 100.0);
        let plot = self.plot([0.0, most], [top + HEAD, top + HEAD + VALUES]);
        plot.ground(svg);
        let (area, lower) = match self.turns(&percent) {
            Some(band) => (Series::new(Shape::Polygon(band.outline()), BAND), band.lower),
            None => (Series::new(Shape::Area(percent.clone()), BELOW_CURVE), percent),
        };
        plot.draw(svg, &area);
        plot.draw(svg, &Series::new(Shape::Curve(lower), CURVE));
        let none = format!("stroke=\"{VERMILION}\" stroke-width=\"2\" fill=\"none\"");
        plot.draw(svg, &Series::new(Shape::Level(0.0), none));
        plot.frame(svg, [plot.x.time_label(), ""]);
    }
}

/// For each column, how much of its time each kind takes, in steps of a sixteenth so that neighbours are often alike.
fn shares(joints: &Joints<'_>, count: u32) -> Vec<Vec<f64>> {
    let width = joints.seconds.max(f64::MIN_POSITIVE) / f64::from(count);
    let mut columns = vec![vec![0.0; joints.kinds.len()]; count as usize];
    for span in joints.spans {
        let [from, to] = span.time;
        let first = (from / width) as usize;
        for (column, shares) in columns.iter_mut().enumerate().skip(first) {
            let [start, end] = [column as f64 * width, (column + 1) as f64 * width];
            if start >= to {
                break;
            }
            if let Some(share) = shares.get_mut(span.kind) {
                *share += (end.min(to) - start.max(from)).max(0.0) / width;
            }
        }
    }
    for share in columns.iter_mut().flatten() {
        *share = (*share * 16.0).round() / 16.0;
    }
    columns
}

/// The whole range of an axis, and what is used of it.
fn gauge(svg: &mut Svg, axis: &Axis, used: &str, [left, top, bottom]: [f64; 3]) {
    let range = Scale::new(axis.limits, [bottom, top]);
    let [low, high] = extremes(&axis.values).map(|value| value.clamp(range.values[0], range.values[1]));
    let [upper, lower] = [high, low].map(|value| range.at(value));
    let whole = [left, top, 16.0, bottom - top];
    svg.rect(whole, "fill=\"#ffffff\"");
    svg.rect([left, upper, 16.0, (lower - upper).max(1.5)], used);
    svg.rect(whole, FRAME);
}
