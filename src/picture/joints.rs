//! Where the axes of a machine are all along a program: a panel for each, with its angle, how near it comes to its limits, and
//! its rate.

use super::chart::{self, BELOW, FRAME, Series, Shape};
use super::over_time::{BEYOND, CURVE, Course, EDGED, HEAD, Panels, USED, extremes};
use super::palette::VERMILION;
use super::sheet::{self, Entry};
use super::svg::{Along, Anchor, Svg};
use super::trace::number;
use super::{Point, Setting};

pub use super::sheet::Heading;

/// An axis with less than this share of half its range left, or with less than this share of its rate, is marked.
const SCARCE: f64 = 0.05;

/// What a picture of axes shows. Times are in s, values in the axis' unit; curves are thinned to [`super::over_time::COLUMNS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Joints<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    pub course: &'a Course<'a>,
    /// The axes, in the controller's order.
    pub axes: &'a [Axis],
    /// The smallest margin of all axes over time, from 0 to 1.
    pub margin: &'a [[f64; 2]],
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

const VALUES: f64 = 70.0;
const RATES: f64 = 30.0;
const GAP: f64 = 16.0;
const PANEL: f64 = HEAD + VALUES + RATES + GAP;
const NEAR: &str = "fill=\"#d55e00\"";
const BAND: &str = "fill=\"#0072b2\" fill-opacity=\"0.35\"";
const BELOW_CURVE: &str = "fill=\"#0072b2\" fill-opacity=\"0.18\"";
const RATE: &str = "fill=\"#6d5a8c\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(joints: &Joints<'_>) -> String {
    let panels = Panels::new(joints.course, joints.heading.ids);
    let room = panels.room;
    let margins = panels.top() + PANEL * joints.axes.len() as f64;
    let bottom = margins + HEAD + VALUES;
    let (description, legend) = (description(joints), legend(joints));
    let mut svg = sheet::sheet(joints.heading, room, &description, bottom + BELOW, &legend);
    panels.strip(&mut svg);
    let picture = Picture { joints, panels };
    for (index, axis) in (0_u32..).zip(joints.axes) {
        picture.axis(&mut svg, axis, picture.panels.top() + PANEL * f64::from(index));
    }
    picture.margin(&mut svg, margins);
    svg.cursor(Along::Time, &picture.panels.time(), [room.top, bottom]);
    svg.finish()
}

fn description(joints: &Joints<'_>) -> String {
    let axes: Vec<String> = joints
        .axes
        .iter()
        .map(|axis| axis.words(Setting::Alone))
        .collect();
    let (subtitle, axes) = (joints.heading.subtitle, axes.join("; "));
    format!("{subtitle}. Axes over {:.1} s: {axes}.", joints.course.seconds)
}

fn legend(joints: &Joints<'_>) -> Vec<Entry> {
    let mut legend = joints.course.legend();
    legend.extend([
        joints.course.curve("value"),
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

/// A picture under construction.
struct Picture<'a> {
    joints: &'a Joints<'a>,
    panels: Panels<'a>,
}

impl Picture<'_> {
    /// The panel of an axis.
    fn axis(&self, svg: &mut Svg, axis: &Axis, top: f64) {
        let (near, room) = (axis.scarcity(), self.panels.room);
        let warning = match near {
            [false, false] => "",
            [true, false] => "near a limit",
            [false, true] => "near its highest rate",
            [true, true] => "near a limit and its highest rate",
        };
        let words = axis.words(self.joints.heading.ids.setting);
        self.panels.headline(svg, &words, warning, top);
        let (upper, lower) = (top + HEAD, top + HEAD + VALUES);
        let [low, high] = axis.seen();
        let plot = self.panels.plot([low, high], [upper, lower]);
        plot.ground(svg);
        let [min, max] = axis.limits;
        let beyond = [[low, min], [max, high]]
            .into_iter()
            .filter(|[from, to]| to > from);
        let boxes = beyond
            .map(|[from, to]| [0.0, self.joints.course.seconds, from, to])
            .collect();
        plot.draw(svg, &Series::new(Shape::Boxes(boxes), BEYOND));
        plot.draw(
            svg,
            &match self.panels.turns(&axis.values) {
                Some(band) => Series::new(Shape::Polygon(band.outline()), EDGED),
                None => Series::new(Shape::Curve(axis.values.clone()), CURVE),
            },
        );
        let paint = |near, usual| if near { NEAR } else { usual };
        let bottom = lower + RATES;
        if let Some(rates) = &axis.rates {
            let (left, plot) = (room.left, self.panels.plot([0.0, 1.0], [lower, bottom]));
            svg.rect([left, lower, room.across(), RATES], "fill=\"#f3f0fa\"");
            let rates = self
                .panels
                .turns(rates)
                .map_or_else(|| rates.clone(), |band| band.upper);
            plot.draw(svg, &Series::new(Shape::Area(rates), paint(near[1], RATE)));
            svg.text([left - 9.0, bottom - 8.0], Anchor::End, "", "rate");
        }
        chart::ticks_beside(svg, &plot.y, room.left, 20.0);
        svg.rect([room.left, upper, room.across(), VALUES], FRAME);
        let (used, paint) = (extremes(&axis.values), paint(near[0], USED));
        self.panels.gauge(svg, axis.limits, used, paint, [upper, bottom]);
    }

    /// The smallest margin over time.
    fn margin(&self, svg: &mut Svg, top: f64) {
        let words = "smallest margin of any axis, %";
        self.panels.headline(svg, words, "", top);
        let percent: Vec<Point> = self
            .joints
            .margin
            .iter()
            .map(|[time, share]| [*time, share * 100.0])
            .collect();
        let most = (extremes(&percent)[1] * 1.1).clamp(10.0, 100.0);
        let plot = self.panels.plot([0.0, most], [top + HEAD, top + HEAD + VALUES]);
        plot.ground(svg);
        let (area, lower) = match self.panels.turns(&percent) {
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
