//! A heat map of places for the base: the plane of x and y from above, each cell in the colour of its margin or of its deviation.
//!
//! Cells out of reach are hatched, not coloured.

use super::Point;
use super::chart::{Chart, Plot, Series, Shape};
use super::sheet::{Heading, Room};
use super::svg::Mark;
use super::tiles::{self, MOST_CLASSES, Tiles};
use super::trace::number;

/// What a heat map shows.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap<'a> {
    /// What it is about, in a line.
    pub title: &'a str,
    /// What holds for the whole map, such as the height.
    pub subtitle: &'a str,
    /// x of the middles of the cells, in mm, growing.
    pub xs: &'a [i32],
    /// y of the middles of the cells, in mm, growing.
    pub ys: &'a [i32],
    /// What the values are.
    pub measure: Measure,
    /// Row by row from the least y, each from the least x; none where something is out of reach.
    pub values: &'a [Option<f64>],
    /// Where the base is now: x and y in mm.
    pub now: [f64; 2],
    /// Where it is best, when anywhere.
    pub best: Option<[f64; 2]>,
}

/// What the values of a map are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Margins from 0 to 1; the greater the better.
    Margin,
    /// Deviations in mm; the smaller the better.
    Deviation,
}

impl Measure {
    const fn word(self) -> &'static str {
        match self {
            Self::Margin => "margin",
            Self::Deviation => "deviation",
        }
    }

    const fn unit(self) -> &'static str {
        match self {
            Self::Margin => "%",
            Self::Deviation => "um",
        }
    }

    /// A value in the smallest width of a class.
    fn in_steps(self, value: f64) -> f64 {
        match self {
            Self::Margin => value.min(1.0) * 100.0,
            // A metre is more than any arm yields.
            Self::Deviation => value.min(1000.0) * 10_000.0,
        }
    }

    /// So many of these steps, in the unit.
    fn words(self, steps: u32) -> String {
        match self {
            Self::Margin => steps.to_string(),
            Self::Deviation => number(f64::from(steps) / 10.0),
        }
    }

    /// What a cell without a value is.
    const fn without(self) -> &'static str {
        match self {
            Self::Margin => "out of reach",
            Self::Deviation => "out of reach, or too small a margin",
        }
    }
}

const HATCHED: &str = "fill=\"url(#hatch)\" shape-rendering=\"crispEdges\"";
/// Widths of a class, in steps; wider ones are ten times, a hundred times as wide.
const CLASSES: [u32; 3] = [1, 2, 5];

/// Writes the map as SVG.
#[must_use]
pub fn draw(map: &HeatMap<'_>) -> String {
    let heading = Heading::alone(map.title, map.subtitle);
    let classes = Classes::of(map.measure, map.values);
    let (columns, rows) = (edges(map.xs), edges(map.ys));
    let tiles = Tiles {
        columns: &columns,
        rows: &rows,
    };
    let plot = tiles.plot(Room::of(heading.ids));
    let mut series = cells(map, tiles, classes);
    series.extend(marks(map, &plot));
    Chart {
        heading,
        description: description(map, classes),
        plot,
        labels: ["x of the base in the machine's root, mm", "y, mm"],
        series,
        along: None,
    }
    .draw()
}

/// The map in words.
fn description(map: &HeatMap<'_>, classes: Classes) -> String {
    let reached = map.values.iter().flatten().count();
    let whole = map.values.len();
    let best = map.best.map_or(String::new(), |[x, y]| {
        format!(" The best place is at x {} mm, y {} mm.", number(x), number(y))
    });
    let [least, most] = classes.ends().map(|steps| map.measure.words(steps));
    let values = match map.measure {
        Measure::Margin => format!("margins up to {most} percent"),
        Measure::Deviation => format!("deviations from {least} to {most} um"),
    };
    format!(
        "{}: {reached} of {whole} places reach everything, with {values}.{best}",
        map.subtitle
    )
}

/// The edges of cells: half-way between their middles; the outer cells are as wide on either side.
fn edges(middles: &[i32]) -> Vec<f64> {
    let middles: Vec<f64> = middles.iter().copied().map(f64::from).collect();
    let between = middles.windows(2).map(|pair| pair.iter().sum::<f64>() / 2.0);
    let mut edges: Vec<f64> = between.collect();
    let [first, last] = [middles.first(), middles.last()].map(|end| end.copied().unwrap_or_default());
    let start = edges.first().map_or(first - 50.0, |&edge| 2.0 * first - edge);
    let end = edges.last().map_or(last + 50.0, |&edge| 2.0 * last - edge);
    edges.insert(0, start);
    edges.push(end);
    edges
}

/// Values in classes of so many steps.
#[derive(Clone, Copy)]
struct Classes {
    measure: Measure,
    width: u32,
    /// How many classes from zero on have no values and are left out.
    skipped: u32,
    count: u32,
}

impl Classes {
    fn of(measure: Measure, values: &[Option<f64>]) -> Self {
        let in_steps = || values.iter().flatten().map(|&value| measure.in_steps(value));
        let most = in_steps().fold(0.0, f64::max);
        let least = match measure {
            Measure::Margin => 0.0,
            Measure::Deviation => in_steps().fold(most, f64::min),
        };
        let widths = (0..8).flat_map(|power| CLASSES.map(|width| width * 10_u32.pow(power)));
        let classes = widths.map(|width| {
            let skipped = (least / f64::from(width)) as u32;
            let last = (most / f64::from(width)).ceil() as u32;
            Self {
                measure,
                width,
                skipped,
                count: last.saturating_sub(skipped).max(1),
            }
        });
        let widest = Self {
            measure,
            width: u32::MAX,
            skipped: 0,
            count: 1,
        };
        classes
            .into_iter()
            .find(|classes| classes.count <= MOST_CLASSES)
            .unwrap_or(widest)
    }

    fn class(self, value: f64) -> u32 {
        let class = (self.measure.in_steps(value) / f64::from(self.width)) as u32;
        class.saturating_sub(self.skipped).min(self.count - 1)
    }

    /// From where to where all classes go, in steps.
    const fn ends(self) -> [u32; 2] {
        let from = self.skipped.saturating_mul(self.width);
        [from, from.saturating_add(self.count.saturating_mul(self.width))]
    }

    fn words(self, class: u32) -> String {
        let edge = |class: u32| {
            self.measure
                .words((self.skipped + class).saturating_mul(self.width))
        };
        format!(
            "{} {} to {} {}",
            self.measure.word(),
            edge(class),
            edge(class + 1),
            self.measure.unit()
        )
    }

    /// Better classes have the colours of higher ones.
    fn paint(self, class: u32) -> String {
        let rank = match self.measure {
            Measure::Margin => class,
            Measure::Deviation => self.count - 1 - class,
        };
        tiles::paint(rank, self.count)
    }

    /// The best first.
    fn best_first(self) -> Vec<u32> {
        match self.measure {
            Measure::Margin => (0..self.count).rev().collect(),
            Measure::Deviation => (0..self.count).collect(),
        }
    }
}

/// Cells of one class are one series.
fn cells(map: &HeatMap<'_>, tiles: Tiles<'_>, classes: Classes) -> Vec<Series> {
    let class = |value: &Option<f64>| value.map(|value| classes.class(value));
    let mut boxes = tiles.by_class(&map.values.iter().map(class).collect::<Vec<_>>());
    let out_of_reach = boxes.remove(&None).unwrap_or_default();
    let coloured = classes.best_first().into_iter().map(|class| {
        let boxes = boxes.remove(&Some(class)).unwrap_or_default();
        Series::new(Shape::Boxes(boxes), classes.paint(class)).named(classes.words(class))
    });
    let coloured: Vec<Series> = coloured.collect();
    let hatched = Series::new(Shape::Boxes(out_of_reach), HATCHED).named(map.measure.without());
    coloured.into_iter().chain([hatched]).collect()
}

/// A ring for now and a cross for the best place.
fn marks(map: &HeatMap<'_>, plot: &Plot) -> Vec<Series> {
    let shows = |[x, y]: Point| {
        let within = |[from, to]: [f64; 2], value| (from..=to).contains(&value);
        within(plot.x.values, x) && within(plot.y.values, y)
    };
    let mut marks = Vec::new();
    if shows(map.now) {
        marks.push(Series::mark(Mark::RING, map.now, None).named("base now"));
    } else {
        marks.push(Series::new(Shape::Dots(Vec::new()), "").named("base now: outside"));
    }
    if let Some(best) = map.best.filter(|&best| shows(best)) {
        marks.push(Series::mark(Mark::CROSS, best, None).named("best place"));
    }
    marks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(xs: &[i32], ys: &[i32]) -> Vec<Option<f64>> {
        let cells = ys.iter().flat_map(|&y| xs.iter().map(move |&x| (x, y)));
        cells
            .map(|(x, y)| Some(f64::from(x - 1000) / 4000.0 + f64::from(y) / 8000.0).filter(|m| *m > 0.05))
            .collect()
    }

    #[test]
    fn a_map_looks_as_it_was_reviewed() {
        let xs: Vec<i32> = (0..11).map(|i| 1000 + 100 * i).collect();
        let ys: Vec<i32> = (0..7).map(|i| -300 + 100 * i).collect();
        let margins = ramp(&xs, &ys);
        let svg = draw(&HeatMap {
            title: "Places for the base of <rib>",
            subtitle: "z 650 mm, turned by 15 deg",
            xs: &xs,
            ys: &ys,
            measure: Measure::Margin,
            values: &margins,
            now: [1100.5, -200.0],
            best: Some([1900.0, 250.0]),
        });
        insta::assert_snapshot!(svg);
    }

    #[test]
    fn any_map_is_drawn_within_its_picture() {
        let one = [Some(0.3)];
        for (xs, ys, margins) in [
            (&[5][..], &[7][..], &one[..]),
            (&[], &[], &[]),
            (&[i32::MIN, i32::MAX], &[0], &[None, Some(f64::MAX)]),
        ] {
            let svg = draw(&HeatMap {
                title: "",
                subtitle: "",
                xs,
                ys,
                measure: Measure::Margin,
                values: margins,
                now: [1e9, f64::MIN],
                best: None,
            });
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.ends_with("</svg>\n"));
        }
    }

    #[test]
    fn a_margin_falls_into_the_class_that_names_it() {
        let classes = Classes::of(Measure::Margin, &[Some(0.231), None, Some(0.1)]);
        assert_eq!((classes.width, classes.count), (5, 5));
        assert_eq!(classes.words(classes.class(0.1)), "margin 10 to 15 %");
        assert_eq!(classes.words(classes.class(0.0)), "margin 0 to 5 %");
        assert_eq!(classes.words(classes.class(0.231)), "margin 20 to 25 %");
    }

    #[test]
    fn classes_of_deviations_begin_at_the_least() {
        let classes = Classes::of(Measure::Deviation, &[Some(0.0213), None, Some(0.0349)]);
        assert_eq!((classes.width, classes.skipped, classes.count), (20, 10, 8));
        assert_eq!(classes.words(classes.class(0.0213)), "deviation 20 to 22 um");
        assert_eq!(classes.words(classes.class(0.0349)), "deviation 34 to 36 um");
        // The smallest deviation has the colour of the largest margin.
        assert_eq!(classes.paint(0), tiles::paint(7, 8));
        for value in [f64::MAX, 0.0, 1e-300] {
            let classes = Classes::of(Measure::Deviation, &[Some(value)]);
            assert!(classes.class(value) < classes.count);
        }
    }
}
