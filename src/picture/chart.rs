//! Charts: series over two axes, with a legend of those that have words.

use super::Point;
use super::palette::INK;
use super::scale::Scale;
use super::sheet::{self, Entry, HALO, Heading, Room};
use super::svg::{Along, Anchor, Mark, Svg, head};
use super::trace::{Trace, number};

/// Room below a plot for its axis.
pub(super) const BELOW: f64 = 66.0;
/// Room that a value needs along the lower axis, and along the left one.
pub(super) const TICK: [f64; 2] = [80.0, 32.0];

/// A chart: one plot with its axes, from the ground up.
pub(super) struct Chart<'a> {
    pub(super) heading: Heading<'a>,
    pub(super) description: String,
    pub(super) plot: Plot,
    /// What is written beside the lower axis and beside the left one.
    pub(super) labels: [&'a str; 2],
    pub(super) series: Vec<Series>,
    /// What the page's cursor follows in it.
    pub(super) along: Option<Along>,
}

/// Where values are in the picture.
pub(super) struct Plot {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

/// What a chart shows.
pub(super) struct Series {
    shape: Shape,
    paint: String,
    /// What the legend calls it, if it has it.
    words: Option<String>,
}

/// What a series looks like.
pub(super) enum Shape {
    /// A curve.
    Curve(Vec<Point>),
    /// The area between a curve and the lowest value.
    Area(Vec<Point>),
    /// An area.
    Polygon(Vec<Point>),
    /// Discs as wide as the stroke, where lines have round ends.
    Dots(Vec<Point>),
    /// Lines, each from a point to another one.
    Lines(Vec<[Point; 2]>),
    /// Lines through points.
    Ways(Vec<Vec<Point>>),
    /// The heads of arrows, each from a point to another one.
    Heads(Vec<[Point; 2]>),
    /// A line at a height.
    Level(f64),
    /// A line at a value of the lower axis.
    Upright(f64),
    /// Rectangles: from and to along the lower axis, from and to along the left one.
    Boxes(Vec<[f64; 4]>),
    /// A point, and the words beside it.
    Mark(Mark, Point, Option<String>),
}

impl Series {
    /// In a paint; a mark has its own.
    pub(super) fn new(shape: Shape, paint: impl Into<String>) -> Self {
        Self {
            shape,
            paint: paint.into(),
            words: None,
        }
    }

    pub(super) fn mark(mark: Mark, at: Point, beside: Option<String>) -> Self {
        Self::new(Shape::Mark(mark, at, beside), "")
    }

    /// With words in the legend.
    pub(super) fn named(self, words: impl Into<String>) -> Self {
        Self {
            words: Some(words.into()),
            ..self
        }
    }

    /// Its entry in the legend.
    fn entry(&self) -> Option<Entry> {
        let words = self.words.clone()?;
        Some(match self.shape {
            Shape::Curve(_)
            | Shape::Lines(_)
            | Shape::Ways(_)
            | Shape::Dots(_)
            | Shape::Level(_)
            | Shape::Upright(_) => Entry::line(self.paint.as_str(), words),
            Shape::Area(_) | Shape::Polygon(_) | Shape::Boxes(_) => Entry::area(self.paint.as_str(), words),
            Shape::Heads(_) => Entry::head(self.paint.as_str(), words),
            Shape::Mark(mark, ..) => Entry::mark(mark, words),
        })
    }
}

impl Chart<'_> {
    /// Writes the chart as SVG.
    pub(super) fn draw(&self) -> String {
        let ([bottom, top], room) = (self.plot.y.places, Room::of(self.heading.ids));
        let legend: Vec<Entry> = self.series.iter().filter_map(Series::entry).collect();
        let mut svg = sheet::sheet(self.heading, room, &self.description, bottom + BELOW, &legend);
        if self
            .series
            .iter()
            .any(|series| series.paint.contains("url(#hatch)"))
        {
            svg.define_hatch();
        }
        self.plot.ground(&mut svg);
        for series in &self.series {
            self.plot.draw(&mut svg, series);
        }
        self.words(&mut svg);
        self.plot.frame(&mut svg, self.labels);
        if let Some(along) = self.along {
            svg.cursor(along, &self.plot.x, [top, bottom]);
        }
        svg.finish()
    }

    /// The words beside marks: clear of lines across the plot and of each other.
    fn words(&self, svg: &mut Svg) {
        let levels = self.series.iter().filter_map(|series| match series.shape {
            Shape::Level(level) => Some(self.plot.y.at(level)),
            _ => None,
        });
        let levels: Vec<f64> = levels.collect();
        let mut taken = Vec::new();
        for series in &self.series {
            if let Shape::Mark(_, at, Some(words)) = &series.shape {
                beside(svg, &self.plot, *at, words, &levels, &mut taken);
            }
        }
    }
}

/// How high words are above and below their line.
pub(super) const ASCENT: f64 = 12.0;
pub(super) const DESCENT: f64 = 4.0;

/// Words beside a point. `taken` holds the ends and the lines of words that are there.
pub(super) fn beside(
    svg: &mut Svg,
    plot: &Plot,
    point: Point,
    words: &str,
    levels: &[f64],
    taken: &mut Vec<([f64; 2], f64)>,
) {
    let [x, y] = plot.at(point);
    let width = sheet::text_width(words);
    let (anchor, start, ends) = if x > plot.x.places[0].midpoint(plot.x.places[1]) {
        (Anchor::End, x - 10.0, [x - 10.0 - width, x - 10.0])
    } else {
        (Anchor::Start, x + 10.0, [x + 10.0, x + 10.0 + width])
    };
    let [bottom, top] = plot.y.places;
    let is_free = |line: &f64| {
        let around = line - ASCENT - 3.0..line + DESCENT + 3.0;
        let meets = |(other, at): &([f64; 2], f64)| {
            ends[0] < other[1] && other[0] < ends[1] && (line - at).abs() < ASCENT + DESCENT
        };
        let is_within = line - ASCENT > top && line + DESCENT < bottom;
        is_within && !levels.iter().any(|level| around.contains(level)) && !taken.iter().any(meets)
    };
    // On the side away from zero, where no curve can be, before on the other one.
    let away = [-8.0, -14.0, -24.0, -36.0, 5.0, 16.0, 26.0, 36.0, -50.0, 50.0];
    let middle = 0.5 * (ASCENT - DESCENT);
    let lines = away.map(|down| {
        if point[1] < 0.0 {
            y + 2.0 * middle - down
        } else {
            y + down
        }
    });
    let line = lines.into_iter().find(is_free).unwrap_or(y - 4.0);
    taken.push((ends, line));
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.text([start, line], anchor, &bold, words);
}

impl Plot {
    /// A plot over the whole width of a room, from `top` to `bottom`.
    pub(super) fn new(room: Room, xs: [f64; 2], ys: [f64; 2], [top, bottom]: [f64; 2]) -> Self {
        Self {
            x: Scale::new(xs, [room.left, room.right]),
            y: Scale::new(ys, [bottom, top]),
        }
    }

    /// Where a point is.
    pub(super) fn at(&self, [x, y]: Point) -> Point {
        [self.x.at(x), self.y.at(y)]
    }

    /// Draws a series, but for words beside marks.
    pub(super) fn draw(&self, svg: &mut Svg, series: &Series) {
        let (paint, [bottom, top]) = (series.paint.as_str(), self.y.places);
        let at = |&point: &Point| self.at(point);
        match &series.shape {
            Shape::Curve(points) => svg.open(points.iter().map(at), paint),
            Shape::Area(points) => {
                let ends =
                    [points.last(), points.first()].map(|end| end.map(|end| [end[0], self.y.values[0]]));
                svg.closed(points.iter().chain(ends.iter().flatten()).map(at), paint);
            }
            Shape::Polygon(points) => svg.closed(points.iter().map(at), paint),
            Shape::Dots(points) => svg.path(Trace::dots(points.iter().map(at)).text(), paint),
            Shape::Lines(lines) => {
                let lines = lines.iter().map(|line| line.map(|point| self.at(point)));
                svg.path(Trace::pieces(lines).text(), paint);
            }
            Shape::Ways(ways) => {
                let ways = ways.iter().map(|way| way.iter().map(at));
                svg.path(Trace::pieces(ways).text(), paint);
            }
            Shape::Heads(arrows) => {
                let mut heads = Trace::default();
                for arrow in arrows {
                    heads.closed(head(arrow.map(|point| self.at(point))));
                }
                svg.path(heads.text(), paint);
            }
            Shape::Level(level) => svg.path(&self.level(*level), paint),
            Shape::Upright(x) => {
                let upright = format!("M{} {}V{}", number(self.x.at(*x)), number(top), number(bottom));
                svg.path(&upright, paint);
            }
            Shape::Boxes(boxes) => {
                let area = |&[from, to, low, high]: &[f64; 4]| {
                    let ([left, upper], [right, lower]) = (self.at([from, high]), self.at([to, low]));
                    [left, upper, right - left, lower - upper]
                };
                svg.rects(&boxes.iter().map(area).collect::<Vec<_>>(), paint);
            }
            Shape::Mark(mark, point, _) => svg.mark(self.at(*point), *mark),
        }
    }

    /// A line at a height, over the whole width.
    fn level(&self, y: f64) -> String {
        let [left, right] = self.x.places;
        format!("M{} {}H{}", number(left), number(self.y.at(y)), number(right))
    }

    fn area(&self) -> [f64; 4] {
        let ([left, _], [_, top]) = (self.x.places, self.y.places);
        [left, top, self.x.length(), self.y.length()]
    }

    /// The ground with its grid. Comes before series.
    pub(super) fn ground(&self, svg: &mut Svg) {
        svg.rect(self.area(), "fill=\"#ffffff\"");
        let ticks = self.y.ticks(TICK[1]);
        let grid: String = ticks.iter().map(|(value, _)| self.level(*value)).collect();
        svg.path(&grid, "stroke=\"#dcd6c8\" fill=\"none\"");
    }

    /// The frame with its values. Comes after series.
    pub(super) fn frame(&self, svg: &mut Svg, [x_label, y_label]: [&str; 2]) {
        let ([left, _], [bottom, top]) = (self.x.places, self.y.places);
        ticks_below(svg, &self.x, bottom, TICK[0]);
        ticks_beside(svg, &self.y, left, TICK[1]);
        svg.rect(self.area(), FRAME);
        self.label_below(svg, x_label);
        svg.upwards([18.0, top.midpoint(bottom)], y_label);
    }

    /// What is written below the lower axis.
    pub(super) fn label_below(&self, svg: &mut Svg, label: &str) {
        let ([left, right], bottom) = (self.x.places, self.y.places[0]);
        svg.text([left.midpoint(right), bottom + 47.0], Anchor::Middle, "", label);
    }
}

/// The paint of axes.
pub(super) const FRAME: &str = "stroke=\"#2b2a27\" fill=\"none\"";

/// The values of an axis below a plot, each with so much room.
pub(super) fn ticks_below(svg: &mut Svg, scale: &Scale, bottom: f64, room: f64) {
    let mut marks = Trace::default();
    for (value, text) in scale.ticks(room) {
        let x = scale.at(value);
        marks.open([[x, bottom], [x, bottom + 6.0]]);
        svg.text([x, bottom + 23.0], Anchor::Middle, "", &text);
    }
    svg.path(marks.text(), FRAME);
}

/// The values of an axis at the left of a plot.
pub(super) fn ticks_beside(svg: &mut Svg, scale: &Scale, left: f64, room: f64) {
    let mut marks = Trace::default();
    for (value, text) in scale.ticks(room) {
        let y = scale.at(value);
        marks.open([[left, y], [left - 6.0, y]]);
        svg.text([left - 10.0, y + 5.0], Anchor::End, "", &text);
    }
    svg.path(marks.text(), FRAME);
}

/// A bar of so many units along a scale, for comparison: it ends at a point.
pub(super) fn bar(svg: &mut Svg, [right, y]: Point, length: f64, words: &str) {
    let path = format!("M{} {}v-5m0 5h-{}v-5", number(right), number(y), number(length));
    svg.path(
        &path,
        &format!("stroke=\"{INK}\" stroke-width=\"2\" fill=\"none\""),
    );
    svg.text([right - length - 9.0, y + 5.0], Anchor::End, "", words);
}
