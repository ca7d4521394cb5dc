//! A heat map of places for the base: the plane of x and y from above, each cell in the colour of its margin.
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
    /// Margins from 0 to 1, row by row from the least y, each from the least x; none where something is out of reach.
    pub margins: &'a [Option<f64>],
    /// Where the base is now: x and y in mm.
    pub now: [f64; 2],
    /// Where it is best, when anywhere.
    pub best: Option<[f64; 2]>,
}

const HATCHED: &str = "fill=\"url(#hatch)\" shape-rendering=\"crispEdges\"";
/// Widths of a class of margins, in percent.
const CLASSES: [u32; 5] = [1, 2, 5, 10, 20];

/// Writes the map as SVG.
#[must_use]
pub fn draw(map: &HeatMap<'_>) -> String {
    let heading = Heading::alone(map.title, map.subtitle);
    let classes = Classes::of(map.margins);
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
    let reached = map.margins.iter().flatten().count();
    let whole = map.margins.len();
    let best = map.best.map_or(String::new(), |[x, y]| {
        format!(" The best place is at x {} mm, y {} mm.", number(x), number(y))
    });
    format!(
        "{}: {reached} of {whole} places reach everything, with margins up to {} percent.{best}",
        map.subtitle,
        classes.count * classes.width
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

/// Margins in classes of so many percent.
#[derive(Clone, Copy)]
struct Classes {
    width: u32,
    count: u32,
}

impl Classes {
    fn of(margins: &[Option<f64>]) -> Self {
        let largest = margins.iter().flatten().copied().fold(0.0, f64::max).min(1.0);
        let percent = ((largest * 100.0).ceil() as u32).max(1);
        let fits = |width: &u32| percent.div_ceil(*width) <= MOST_CLASSES;
        let width = CLASSES.into_iter().find(fits).unwrap_or(20);
        Self {
            width,
            count: percent.div_ceil(width),
        }
    }

    fn class(self, margin: f64) -> u32 {
        ((margin * 100.0 / f64::from(self.width)) as u32).min(self.count - 1)
    }

    fn words(self, class: u32) -> String {
        format!("{} to {} %", class * self.width, (class + 1) * self.width)
    }
}

/// Cells of one class are one series.
fn cells(map: &HeatMap<'_>, tiles: Tiles<'_>, classes: Classes) -> Vec<Series> {
    let class = |margin: &Option<f64>| margin.map(|margin| classes.class(margin));
    let mut boxes = tiles.by_class(&map.margins.iter().map(class).collect::<Vec<_>>());
    let out_of_reach = boxes.remove(&None).unwrap_or_default();
    let coloured = (0..classes.count).rev().map(|class| {
        let boxes = boxes.remove(&Some(class)).unwrap_or_default();
        Series::new(Shape::Boxes(boxes), tiles::paint(class, classes.count))
            .named(format!("margin {}", classes.words(class)))
    });
    let coloured: Vec<Series> = coloured.collect();
    let hatched = Series::new(Shape::Boxes(out_of_reach), HATCHED).named("out of reach");
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
            margins: &margins,
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
                margins,
                now: [1e9, f64::MIN],
                best: None,
            });
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.ends_with("</svg>\n"));
        }
    }

    #[test]
    fn a_margin_falls_into_the_class_that_names_it() {
        let classes = Classes::of(&[Some(0.231), None, Some(0.1)]);
        assert_eq!((classes.width, classes.count), (5, 5));
        assert_eq!(classes.words(classes.class(0.1)), "10 to 15 %");
        assert_eq!(classes.words(classes.class(0.0)), "0 to 5 %");
        assert_eq!(classes.words(classes.class(0.231)), "20 to 25 %");
    }
}
