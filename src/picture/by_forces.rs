//! How far the forces of blades push the cuts of a program off, along the profile: from where to where, cut by cut.

use super::Setting;
use super::chart::{Chart, Plot, Series, Shape};
use super::palette::{BLUE, GREEN, ORANGE, job_limit};
use super::sheet::Room;
use super::svg::{Along, Mark};

pub use super::sheet::Heading;

/// What a picture of such deviations shows; lengths in mm, positive into the waste.
#[derive(Clone, Debug, PartialEq)]
pub struct ByForces<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// Width of the stock.
    pub width: f64,
    pub cuts: &'a [Cut],
    /// The most into the waste and into the part, with its x; none where nothing is pushed that way.
    pub most: &'a [[f64; 2]],
    /// What operations may deviate either way: different ones, in order.
    pub limits: &'a [f64],
}

/// What a cut deviates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The place of its tip.
    pub x: f64,
    pub face: Face,
    /// From where to where.
    pub range: [f64; 2],
}

/// The side of the V that a cut makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Face {
    Left,
    Right,
    /// None: the blade is upright.
    Upright,
}

impl Face {
    const ALL: [Self; 3] = [Self::Left, Self::Right, Self::Upright];

    const fn words(self) -> &'static str {
        match self {
            Self::Left => "left flank",
            Self::Right => "right flank",
            Self::Upright => "upright cut",
        }
    }

    const fn colour(self) -> &'static str {
        match self {
            Self::Left => BLUE,
            Self::Right => ORANGE,
            Self::Upright => GREEN,
        }
    }

    /// Where its bars stand beside the tip, in their widths.
    const fn beside(self) -> [f64; 2] {
        match self {
            Self::Left => [-1.0, 0.0],
            Self::Right => [0.0, 1.0],
            Self::Upright => [-0.5, 0.5],
        }
    }
}

const HEIGHT: f64 = 240.0;
/// Width of the bar of a cut. Cuts that are no farther apart share one.
const BAR: f64 = 5.0;
/// A limit is in the picture up to so many times what cuts deviate: otherwise nothing could be seen of that.
const NEAR: f64 = 5.0;
/// Below this many mm, values are in um.
const SMALL: f64 = 0.1;

/// What values are shown in.
#[derive(Clone, Copy)]
struct Unit {
    name: &'static str,
    per_mm: f64,
    /// What values are rounded to, in parts of it.
    parts: f64,
}

impl Unit {
    const fn of(largest: f64) -> Self {
        if largest < SMALL {
            Self {
                name: "um",
                per_mm: 1000.0,
                parts: 10.0,
            }
        } else {
            Self {
                name: "mm",
                per_mm: 1.0,
                parts: 1000.0,
            }
        }
    }

    /// A value, upward.
    fn words(self, value: f64) -> String {
        decimal((value * self.parts - 1e-7).ceil() / self.parts)
    }
}

impl ByForces<'_> {
    fn largest(&self) -> f64 {
        let all = self.cuts.iter().flat_map(|cut| cut.range);
        let all = all.chain(self.most.iter().map(|[_, most]| *most));
        all.fold(0.0, |largest, value| value.abs().max(largest))
    }

    /// Width of a bar in mm.
    fn bar(&self, room: Room) -> f64 {
        BAR * self.width / room.across()
    }

    /// From where to where the picture goes in x: tips may be beside the stock.
    fn across(&self, room: Room) -> [f64; 2] {
        let bar = self.bar(room);
        self.cuts.iter().fold([0.0, self.width], |[left, right], cut| {
            [left.min(cut.x - bar), right.max(cut.x + bar)]
        })
    }

    /// Limits that are not out of the picture.
    fn near_limits(&self) -> impl Iterator<Item = f64> {
        let most = NEAR * self.largest();
        self.limits.iter().copied().filter(move |limit| *limit <= most)
    }
}

/// Writes the picture as SVG.
#[must_use]
pub fn draw(shown: &ByForces<'_>) -> String {
    let room = Room::of(shown.heading.ids);
    let unit = Unit::of(shown.largest());
    let limits = shown.near_limits().flat_map(|limit| [-limit, limit]);
    let values = shown.cuts.iter().flat_map(|cut| cut.range);
    let values = values
        .chain(limits)
        .chain(shown.most.iter().map(|[_, most]| *most));
    let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    // There is room for words above and below.
    let more = 0.2 * (high - low).max(1e-6);
    // A telephone has no room for words beside the values.
    let [below, beside] = match shown.heading.ids.setting {
        Setting::Phone => [
            format!("x of the tip, mm; up: into the waste, {}", unit.name),
            String::new(),
        ],
        Setting::Alone | Setting::Page => [
            "x of the tip, mm".to_owned(),
            format!("{}, + into the waste", unit.name),
        ],
    };
    Chart {
        heading: shown.heading,
        description: description(shown),
        plot: Plot::new(
            room,
            shown.across(room),
            [low - more, high + more].map(|value| unit.per_mm * value),
            [room.top, room.top + HEIGHT],
        ),
        labels: [&below, &beside],
        series: series(shown, unit, room),
        along: Some(Along::Width),
    }
    .draw()
}

fn series(shown: &ByForces<'_>, unit: Unit, room: Room) -> Vec<Series> {
    let bar = shown.bar(room);
    let bars = Face::ALL.into_iter().filter_map(|face| {
        let boxes = bars(shown.cuts, face, bar);
        let boxes: Vec<[f64; 4]> = boxes
            .into_iter()
            .map(|([from, to], [low, high])| [from, to, unit.per_mm * low, unit.per_mm * high])
            .collect();
        let paint = format!("fill=\"{}\"", face.colour());
        (!boxes.is_empty()).then(|| Series::new(Shape::Boxes(boxes), paint).named(face.words()))
    });
    let mut series: Vec<Series> = bars.collect();
    series.push(Series::new(Shape::Level(0.0), "fill=\"none\" stroke=\"#2b2a27\""));
    let line = job_limit();
    for limit in shown.near_limits() {
        let level = |value: f64| Series::new(Shape::Level(unit.per_mm * value), line.as_str());
        series.push(level(-limit));
        series.push(level(limit).named(format!("limit, {} mm", decimal(limit))));
    }
    let marks = shown.most.iter().enumerate().map(|(place, [x, most])| {
        let most = unit.per_mm * most;
        let words = format!("{} {}", unit.words(most.abs()), unit.name);
        let mark = Series::mark(Mark::HOLLOW, [*x, most], Some(words));
        if place == 0 {
            mark.named("the most either way, proven")
        } else {
            mark
        }
    });
    series.extend(marks);
    series
}

/// The bars of the cuts of one face: from and to along x, and from where to where these are off. Those of neighbours that would cover
/// each other are one.
fn bars(cuts: &[Cut], face: Face, bar: f64) -> Vec<([f64; 2], [f64; 2])> {
    let mut those: Vec<&Cut> = cuts.iter().filter(|cut| cut.face == face).collect();
    those.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut bars: Vec<(f64, [f64; 2])> = Vec::new();
    for Cut { x, range, .. } in those {
        match bars.last_mut() {
            Some((first, all)) if x - *first < bar => {
                *all = [all[0].min(range[0]), all[1].max(range[1])];
            }
            Some(_) | None => bars.push((*x, *range)),
        }
    }
    bars.into_iter()
        .map(|(x, range)| (face.beside().map(|side| x + side * bar), range))
        .collect()
}

/// To a ten-thousandth, without zeros at the end.
fn decimal(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn description(shown: &ByForces<'_>) -> String {
    let of = |face: Face| {
        let ranges = shown.cuts.iter().filter(|cut| cut.face == face);
        let hull = ranges
            .map(|cut| cut.range)
            .reduce(|[low, high], range| [low.min(range[0]), high.max(range[1])])?;
        let [low, high] = hull.map(|value| number_of_um(1000.0 * value));
        Some(format!("{}s {low} to {high} um", face.words()))
    };
    let faces: Vec<String> = Face::ALL.into_iter().filter_map(of).collect();
    let limits = shown.limits.iter().map(|limit| format!("{} mm", decimal(*limit)));
    let limits: Vec<String> = limits.collect();
    let limits = if limits.is_empty() {
        String::new()
    } else {
        format!("; limit {}", limits.join(" and "))
    };
    format!(
        "{}. How far cuts are off along the normals of their flanks over x, positive into the waste: {}{limits}.",
        shown.heading.subtitle,
        faces.join(", ")
    )
}

fn number_of_um(value: f64) -> String {
    format!("{:.1}", (value * 10.0).round() / 10.0 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;
    use proptest::prelude::*;

    const CUTS: [Cut; 4] = [
        Cut {
            x: 10.0,
            face: Face::Left,
            range: [-0.001, 0.004],
        },
        Cut {
            x: 10.0,
            face: Face::Right,
            range: [0.0, 0.002],
        },
        Cut {
            x: 30.0,
            face: Face::Left,
            range: [-0.002, 0.003],
        },
        Cut {
            x: 20.0,
            face: Face::Upright,
            range: [-0.0015, 0.0015],
        },
    ];

    fn drawn(limits: &[f64]) -> String {
        draw(&ByForces {
            heading: Heading {
                ids: Prefix::NONE,
                title: "a rib: deviation by the forces of the blade",
                subtitle: "an arm",
            },
            width: 40.0,
            cuts: &CUTS,
            most: &[[10.0, 0.004], [30.0, -0.002]],
            limits,
        })
    }

    #[test]
    fn a_picture_looks_as_it_was_reviewed() {
        insta::assert_snapshot!(drawn(&[0.01]));
    }

    #[test]
    fn values_are_written_as_closely_as_they_matter() {
        let unit = Unit::of(0.05);
        assert_eq!(
            (unit.words(20.41), unit.words(7.0)),
            ("20.5".to_owned(), "7".to_owned())
        );
        assert_eq!(Unit::of(0.5).words(0.345_2), "0.346");
        assert_eq!([0.002, 0.2, 1.0, 10.0].map(decimal), ["0.002", "0.2", "1", "10"]);
    }

    #[test]
    fn limits_far_away_are_in_the_words_alone() {
        let far = drawn(&[0.2]);
        assert!(far.contains("; limit 0.2 mm."), "{far}");
        assert!(!far.contains(">limit, 0.2 mm<"), "{far}");
        assert!(drawn(&[0.02]).contains(">limit, 0.02 mm<"));
    }

    proptest! {
        /// Whatever shares a bar, no cut sticks out of it, and no two bars of a face cover each other.
        #[test]
        fn bars_hold_all_cuts(places in prop::collection::vec((0.0..100.0_f64, -1.0..0.0_f64, 0.0..1.0_f64), 1..60)) {
            let cuts: Vec<Cut> = places
                .iter()
                .map(|&(x, low, high)| Cut { x, face: Face::Left, range: [low, high] })
                .collect();
            let bars = bars(&cuts, Face::Left, 1.0);
            for cut in &cuts {
                let holds = bars.iter().any(|([_, at], [low, high])| {
                    (*at..*at + 1.0).contains(&cut.x) && *low <= cut.range[0] && *high >= cut.range[1]
                });
                prop_assert!(holds, "{:?}", cut);
            }
            prop_assert!(bars.windows(2).all(|pair| pair[0].0[1] <= pair[1].0[0] + 1e-9));
        }
    }
}
