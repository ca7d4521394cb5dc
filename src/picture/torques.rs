//! What the axes of an arm need all along a program: a panel for each, with its torque over time, of its limit where that is known,
//! and the most that it needs anywhere.

use super::chart::{self, BELOW, FRAME, Plot, Series, Shape, TICK};
use super::over_time::{BEYOND, CURVE, Course, EDGED, HEAD, Panels, USED, extremes};
use super::palette::{VERMILION, job_limit};
use super::sheet::{self, Entry};
use super::svg::{Along, Mark, Svg};
use super::trace::number;
use super::{Point, Setting};

pub use super::sheet::Heading;

/// An axis with less than this share of its limit left is marked.
const SCARCE: f64 = 0.05;

/// What a picture of torques shows. Times are in s, torques in Nm; curves are thinned to [`super::over_time::COLUMNS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Torques<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    pub course: &'a Course<'a>,
    /// The axes, in the controller's order.
    pub axes: &'a [Axis],
    /// The share of its limit that an axis may use, when the job states one.
    pub allowed: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub name: String,
    /// What its drive gives either way, when known.
    pub limit: Option<f64>,
    /// What it needs over time.
    pub values: Vec<[f64; 2]>,
    /// It needs nowhere more, either way; none where that is not proven.
    pub most: Option<f64>,
    /// When it needs the most, and that with its sign; none where that is not proven or matters little.
    pub peak: Option<[f64; 2]>,
}

const VALUES: f64 = 100.0;
/// Room that a panel has at least above and below its values, in % or Nm.
const LEAST: f64 = 0.07;
const GAP: f64 = 16.0;
const PANEL: f64 = HEAD + VALUES + GAP;
const ZERO: &str = "fill=\"none\" stroke=\"#8a8577\"";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(torques: &Torques<'_>) -> String {
    let panels = Panels::new(torques.course, torques.heading.ids);
    let bottom = panels.top() + PANEL * torques.axes.len() as f64 - GAP;
    let (description, legend) = (description(torques), legend(torques));
    let mut svg = sheet::sheet(
        torques.heading,
        panels.room,
        &description,
        bottom + BELOW,
        &legend,
    );
    panels.strip(&mut svg);
    let picture = Picture { torques, panels };
    for (index, axis) in (0_u32..).zip(torques.axes) {
        picture.axis(&mut svg, axis, picture.panels.top() + PANEL * f64::from(index));
    }
    let time = picture.panels.plot([0.0, 1.0], [bottom - VALUES, bottom]);
    chart::ticks_below(&mut svg, &time.x, bottom, TICK[0]);
    time.label_below(&mut svg, time.x.time_label());
    svg.cursor(Along::Time, &time.x, [picture.panels.room.top, bottom]);
    svg.finish()
}

fn description(torques: &Torques<'_>) -> String {
    let axes = torques.axes.iter().map(|axis| axis.words(Setting::Alone));
    let axes: Vec<String> = axes.collect();
    let (subtitle, seconds) = (torques.heading.subtitle, torques.course.seconds);
    let allowed = torques.allowed.map_or_else(String::new, |allowed| {
        format!(" Allowed are {} % of the limits.", number(100.0 * allowed))
    });
    format!(
        "{subtitle}. Torques of the axes over {seconds:.1} s: {}.{allowed}",
        axes.join("; ")
    )
}

fn legend(torques: &Torques<'_>) -> Vec<Entry> {
    let any = |what: fn(&Axis) -> bool| torques.axes.iter().any(what);
    let mut legend = torques.course.legend();
    legend.push(torques.course.curve("torque"));
    if any(|axis| axis.peak.is_some()) {
        legend.push(Entry::mark(Mark::HOLLOW, "the most anywhere, proven"));
    }
    let beyond = |level: f64| any_beyond(torques.axes, level);
    if beyond(1.0) {
        legend.push(Entry::area(BEYOND, "above its limit"));
    }
    if let Some(allowed) = torques.allowed.filter(|allowed| beyond(*allowed)) {
        legend.push(Entry::line(
            job_limit(),
            format!("allowed, {} %", number(100.0 * allowed)),
        ));
    }
    if any(|axis| axis.limit.is_some()) {
        legend.push(Entry::area(USED, "used of its limit (bar at the right)"));
    }
    legend
}

/// Whether any panel shows what is above a share of its limit.
fn any_beyond(axes: &[Axis], share: f64) -> bool {
    axes.iter().any(|axis| {
        let [low, high] = axis.seen(&[share, 1.0]);
        axis.limit
            .is_some_and(|_| low <= -100.0 * share || high >= 100.0 * share)
    })
}

impl Axis {
    /// A torque as it is shown: in % of the limit, or in Nm.
    fn shown(&self, torque: f64) -> f64 {
        self.limit.map_or(torque, |limit| 100.0 * torque / limit)
    }

    fn shown_at(&self, [time, torque]: Point) -> Point {
        [time, self.shown(torque)]
    }

    /// The most that it needs, upward.
    fn most_words(&self) -> Option<String> {
        let most = self.most?;
        Some(match self.limit {
            Some(_) => format!("{} %", number((self.shown(most) - 1e-7).ceil())),
            None => format!("{} Nm", number((most - 1e-7).ceil())),
        })
    }

    /// A telephone has no room for all words.
    fn words(&self, setting: Setting) -> String {
        let [low, high] = extremes(&self.values).map(|torque| self.shown(torque));
        let unit = match (self.limit, setting) {
            (None, _) => "Nm".to_owned(),
            (Some(_), Setting::Phone) => "%".to_owned(),
            (Some(limit), Setting::Alone | Setting::Page) => format!("% of {} Nm", number(limit)),
        };
        let most = self
            .most_words()
            .map_or_else(String::new, |most| format!(", at most {most}"));
        format!("{}: {} to {} {unit}{most}", self.name, tenths(low), tenths(high))
    }

    /// What there is to warn of.
    fn warning(&self, allowed: Option<f64>) -> &'static str {
        match (self.limit, self.most) {
            (Some(limit), Some(most)) if most > limit => "above its limit",
            (Some(limit), Some(most)) if allowed.is_some_and(|allowed| most > allowed * limit) => {
                "above what is allowed"
            }
            (Some(limit), Some(most)) if most > (1.0 - SCARCE) * limit => "near its limit",
            (_, _) => "",
        }
    }

    /// What it needs at least and at most, as it is shown.
    fn needed(&self) -> [f64; 2] {
        let [low, high] = extremes(&self.values).map(|torque| self.shown(torque));
        let peak = self.peak.map_or(low, |[_, torque]| self.shown(torque));
        [low.min(peak), high.max(peak)]
    }

    /// What its panel shows: what it needs, zero, and those of its limits that are near, as shares.
    fn seen(&self, limits: &[f64]) -> [f64; 2] {
        let [low, high] = self.needed();
        let (low, high) = (low.min(0.0), high.max(0.0));
        let span = high - low;
        let near = |end: f64| {
            let limits = limits.iter().map(|share| 100.0 * share);
            let near = limits.filter(|limit| limit - end < span);
            near.fold(end, f64::max)
        };
        let (least, most) = match self.limit {
            Some(_) => (-near(-low), near(high)),
            None => (low, high),
        };
        let room = ((most - least) * 0.15).max(LEAST);
        [least - room, most + room]
    }
}

/// With a decimal, and never minus zero.
fn tenths(value: f64) -> String {
    format!("{:.1}", (value * 10.0).round() / 10.0 + 0.0)
}

/// A picture under construction.
struct Picture<'a> {
    torques: &'a Torques<'a>,
    panels: Panels<'a>,
}

impl Picture<'_> {
    /// The panel of an axis.
    fn axis(&self, svg: &mut Svg, axis: &Axis, top: f64) {
        let (panels, allowed) = (&self.panels, self.torques.allowed);
        let warning = axis.warning(allowed);
        panels.headline(svg, &axis.words(self.torques.heading.ids.setting), warning, top);
        let ends = [top + HEAD, top + HEAD + VALUES];
        let [low, high] = axis.seen(&allowed.into_iter().chain([1.0]).collect::<Vec<_>>());
        let plot = panels.plot([low, high], ends);
        plot.ground(svg);
        plot.draw(svg, &Series::new(Shape::Level(0.0), ZERO));
        let limits = self.limits(svg, axis, &plot);
        let values: Vec<Point> = axis.values.iter().map(|point| axis.shown_at(*point)).collect();
        let curve = match panels.turns(&values) {
            Some(band) => Series::new(Shape::Polygon(band.outline()), EDGED),
            None => Series::new(Shape::Curve(values), CURVE),
        };
        plot.draw(svg, &curve);
        let room = panels.room;
        chart::ticks_beside(svg, &plot.y, room.left, 24.0);
        svg.rect([room.left, ends[0], room.across(), VALUES], FRAME);
        if let Some((peak, words)) = axis.peak.zip(axis.most_words()) {
            let peak = axis.shown_at(peak);
            svg.mark(plot.at(peak), Mark::HOLLOW);
            chart::beside(svg, &plot, peak, &words, &limits, &mut Vec::new());
        }
        if axis.limit.is_some() {
            let paint = if warning.is_empty() {
                USED.to_owned()
            } else {
                format!("fill=\"{VERMILION}\"")
            };
            panels.gauge(svg, [-100.0, 100.0], axis.needed(), &paint, ends);
        }
    }

    /// What is above the limits of an axis, and what is allowed of them. Returns where lines are.
    fn limits(&self, svg: &mut Svg, axis: &Axis, plot: &Plot) -> Vec<f64> {
        if axis.limit.is_none() {
            return Vec::new();
        }
        let ([low, high], seconds) = (plot.y.values, self.torques.course.seconds);
        let beyond = [[low, -100.0], [100.0, high]]
            .into_iter()
            .filter(|[from, to]| to > from);
        let boxes = beyond.map(|[from, to]| [0.0, seconds, from, to]).collect();
        plot.draw(svg, &Series::new(Shape::Boxes(boxes), BEYOND));
        let allowed = self.torques.allowed.map(|share| 100.0 * share);
        let each = allowed.into_iter().map(|level| (level, job_limit()));
        let limit = format!("fill=\"none\" stroke=\"{VERMILION}\" stroke-width=\"1.5\"");
        let mut lines = Vec::new();
        for (level, paint) in each.chain([(100.0, limit)]) {
            for level in [-level, level]
                .into_iter()
                .filter(|level| (low..=high).contains(level))
            {
                plot.draw(svg, &Series::new(Shape::Level(level), paint.as_str()));
                lines.push(plot.y.at(level));
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;
    use crate::over_time::Span;

    fn axis(limit: Option<f64>) -> Axis {
        Axis {
            name: "A2".to_owned(),
            limit,
            values: vec![[0.0, -200.0], [5.0, 300.0], [10.0, 100.0]],
            most: Some(400.0),
            peak: Some([5.0, 400.0]),
        }
    }

    fn drawn(axes: &[Axis], allowed: Option<f64>, ids: Prefix) -> String {
        draw(&Torques {
            heading: Heading {
                ids,
                title: "a rib: torques over time",
                subtitle: "an arm",
            },
            course: &Course {
                seconds: 10.0,
                kinds: &["cutting", "travel"],
                spans: &[
                    Span {
                        time: [0.0, 6.0],
                        kind: 0,
                    },
                    Span {
                        time: [6.0, 10.0],
                        kind: 1,
                    },
                ],
                layers: &[(0.0, "1".to_owned())],
                cuts: 3,
            },
            axes,
            allowed,
        })
    }

    #[test]
    fn a_picture_looks_as_it_was_reviewed() {
        let without = Axis {
            most: None,
            peak: None,
            ..axis(None)
        };
        insta::assert_snapshot!(drawn(&[axis(Some(500.0)), without], Some(0.7), Prefix::NONE));
    }

    #[test]
    fn torques_are_shares_of_limits_where_these_are_known() {
        let known = drawn(&[axis(Some(500.0))], None, Prefix::NONE);
        assert!(
            known.contains("A2: -40.0 to 60.0 % of 500 Nm, at most 80 %"),
            "{known}"
        );
        let unknown = drawn(&[axis(None)], None, Prefix::NONE);
        assert!(
            unknown.contains("A2: -200.0 to 300.0 Nm, at most 400 Nm"),
            "{unknown}"
        );
        assert!(!unknown.contains("limit"), "{unknown}");
    }

    #[test]
    fn limits_are_drawn_where_they_are_near() {
        for (limit, allowed, lines, warning) in [
            (500.0, None, 2, ""),
            (500.0, Some(0.7), 4, "above what is allowed"),
            (350.0, None, 2, "above its limit"),
            (410.0, None, 2, "near its limit"),
            (5000.0, Some(0.7), 0, ""),
        ] {
            let picture = drawn(&[axis(Some(limit))], allowed, Prefix::new("a-"));
            let levels = picture
                .lines()
                .filter(|line| line.contains(&format!("stroke=\"{VERMILION}\"")) && line.contains('H'));
            assert_eq!(levels.count(), lines, "{limit} {allowed:?} {picture}");
            assert!(picture.contains(warning), "{limit}");
            assert_eq!(
                picture.contains(&format!("fill=\"{VERMILION}\" font-weight")),
                !warning.is_empty()
            );
        }
    }
}
